!> From a path and settings to a model: the first step of every command.
module ek_load_deck
   use ek_error, only: error_t, fail, exit_usage, exit_model, exit_file
   use ek_text, only: str, quoted, nearest_name
   use ek_deck, only: deck_t, read_deck, set_value, deck_checksum
   use ek_setting, only: split_setting
   use ek_reader, only: build_model
   use ek_suspension, only: suspension_t
   use ek_case_inputs, only: check_inputs
   use ek_case, only: case_t, method_names, most_increments
   use ek_examination, only: examination_t, examine_cases
   use ek_arguments, only: arguments_t
   implicit none(type, external)
   private
   public :: load_deck, apply_settings, chosen_cases, examine_chosen, unsolvable_words

contains

   !> Reads a deck, applies --set, builds the model, and checks the tables and targets of its cases; reports all errors together.
   subroutine load_deck(arguments, suspension, cases, checksum, error)
      type(arguments_t), intent(in) :: arguments
      type(suspension_t), intent(out) :: suspension
      type(case_t), allocatable, intent(out) :: cases(:)
      character(:), allocatable, intent(out) :: checksum     !! of the deck as it was used
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: deck
      type(error_t), allocatable :: fault
      logical :: is_whole

      call read_deck(arguments%file, deck, error)
      if (allocated(error)) return
      call apply_settings(arguments, deck, error)
      if (allocated(error)) return
      call build_model(deck, suspension, cases, error, is_whole)
      call check_inputs(suspension, cases, fault, is_whole)
      if (allocated(fault) .and. allocated(error)) then
         error%message = error%message//new_line('a')//fault%message
      else if (allocated(fault)) then
         ! a missing file is reported by the case that needs it: the other cases can be run
         if (fault%code /= exit_file .or. arguments%command == 'check') call move_alloc(fault, error)
      end if
      if (allocated(error)) return
      checksum = deck_checksum(deck)
   end subroutine load_deck

   !> Applies --set path=value in the order given.
   subroutine apply_settings(arguments, deck, error)
      type(arguments_t), intent(in) :: arguments
      type(deck_t), intent(inout) :: deck
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: path, value
      integer :: k

      do k = 1, size(arguments%settings)
         call split_setting(arguments%settings(k)%text, path, value, error)
         if (allocated(error)) return
         call set_value(deck, path, value, error)
         if (allocated(error)) return
      end do
   end subroutine apply_settings

   !> The cases to run, with --case, --method and --increments applied.
   subroutine chosen_cases(arguments, cases, chosen, error)
      type(arguments_t), intent(in) :: arguments
      type(case_t), intent(in) :: cases(:)
      type(case_t), allocatable, intent(out) :: chosen(:)
      type(error_t), allocatable, intent(out) :: error
      character(64) :: names(size(cases))
      character(:), allocatable :: hint
      integer :: k

      if (size(cases) == 0) then
         call fail(error, exit_usage, arguments%file//': no &case group, so there is no case to run (check works without one)')
         return
      end if
      allocate (chosen(0))
      do k = 1, size(cases)
         names(k) = cases(k)%name
         if (len(arguments%case) == 0 .or. arguments%case == cases(k)%name) chosen = [chosen, cases(k)]
      end do
      if (size(chosen) == 0) then
         hint = nearest_name(arguments%case, names)
         if (len(hint) > 0) hint = ' (did you mean '//quoted(hint)//'?)'
         hint = hint//'; it has'
         do k = 1, size(names)
            hint = hint//' '//quoted(names(k))
         end do
         call fail(error, exit_usage, '--case: no case '//quoted(arguments%case)//' in '//arguments%file//hint)
         return
      end if
      if (len(arguments%method) > 0 .and. .not. any(method_names == arguments%method)) then
         call fail(error, exit_usage, '--method: expected recursive, corrected or equilibrium, found '//quoted(arguments%method))
         return
      end if
      if (arguments%increments > most_increments) then
         call fail(error, exit_usage, '--increments: expected 1 to '//str(most_increments)//', found '//str(arguments%increments))
         return
      end if
      do k = 1, size(chosen)
         if (chosen(k)%follows_arc .and. len(arguments%method) > 0 .and. arguments%method /= 'equilibrium') then
            call fail(error, exit_usage, '--method: case '//quoted(chosen(k)%name)//' has follow = ''arc'', which requires '// &
               'method equilibrium, found '//quoted(arguments%method))
            return
         end if
         if (len(arguments%method) > 0) chosen(k)%method = arguments%method
         if (arguments%increments > 0) chosen(k)%increments = arguments%increments
      end do
   end subroutine chosen_cases

   !> Examines the cases to run; an error if none can be solved.
   subroutine examine_chosen(arguments, suspension, chosen, found, error)
      type(arguments_t), intent(in) :: arguments
      type(suspension_t), intent(in) :: suspension      !! not balanced
      type(case_t), intent(in) :: chosen(:)
      type(examination_t), intent(out) :: found
      type(error_t), allocatable, intent(out) :: error  !! exit_model

      call examine_cases(suspension, chosen, found)
      if (found%none_solvable()) call fail(error, exit_model, unsolvable_words(arguments%file, found))
   end subroutine examine_chosen

   !> The reasons why no case of a deck can be run; each defect once.
   function unsolvable_words(file, found) result(words)
      character(*), intent(in) :: file
      type(examination_t), intent(in) :: found          !! no case can be solved
      character(:), allocatable :: words

      if (size(found%is_solvable) == 1) then
         words = found%faults%line(1)
      else
         words = file//': the model cannot be solved'//new_line('a')//found%distinct%text()
      end if
   end function unsolvable_words

end module ek_load_deck
