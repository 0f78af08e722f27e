!> elastokin run --responses: a deck as a black box of optimisers and drivers. Key numbers by name, one `value name` line each,
!> and no other file.
module ek_run_numbers
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_convergence
   use ek_buffer, only: buffer_t
   use ek_decimal, only: decimal
   use ek_file, only: write_whole, write_standard_output
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, default_tolerance
   use ek_balance, only: balance
   use ek_standard_tests, only: standard_tests
   use ek_examination, only: examination_t
   use ek_table, only: name_length
   use ek_named_numbers, only: named_numbers_t, prepare_numbers, read_numbers, needed_tests, lost_states
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: deck_settings_t, load_deck, chosen_cases, examine_chosen
   use ek_console, only: print_model_remarks
   implicit none(type, external)
   private
   public :: run_numbers, split_names

   character(*), parameter :: nl = new_line('a')

contains

   !> Writes the wanted numbers of a deck. If one of them has no value or a state that it needs was not found, the results say
   !> FAIL, which drivers look for, and the reason.
   subroutine run_numbers(line, settings, error)
      type(command_line_t), intent(in) :: line
      class(deck_settings_t), intent(in) :: settings
      type(error_t), allocatable, intent(out) :: error
      character(name_length), allocatable :: names(:)
      real(wp), allocatable :: values(:)
      type(error_t), allocatable :: unwritten
      type(buffer_t) :: text
      integer :: k

      call split_names(line%value('--responses'), names)
      allocate (values(size(names)))
      call find_values(settings, names, values, error)
      if (allocated(error)) then
         call text%line('FAIL')
         call text%add('# ')
         do k = 1, len(error%message)
            call text%add(error%message(k:k))
            if (error%message(k:k) == nl) call text%add('# ')
         end do
         call text%add(nl)
      else
         do k = 1, size(names)
            call text%line(decimal(values(k))//' '//trim(names(k)))
         end do
      end if
      call write_results(line%value('--results', '-'), text%text(), unwritten)
      if (.not. allocated(unwritten)) return
      if (allocated(error) .and. len(unwritten%message) > 0) unwritten%message = error%message//nl//unwritten%message
      if (.not. allocated(error)) call move_alloc(unwritten, error)
   end subroutine run_numbers

   !> The results of a design, whole or not at all.
   subroutine write_results(path, text, error)
      character(*), intent(in) :: path                     !! - is standard output
      character(*), intent(in) :: text
      type(error_t), allocatable, intent(out) :: error     !! exit_file

      if (path == '-') then
         call write_standard_output(text, error)
      else
         call write_whole(path, text, error, can_be_redrawn=.true.)      ! read at once: not worth waiting for the disk
      end if
   end subroutine write_results

   !> Solves what the numbers need.
   subroutine find_values(settings, names, values, error)
      class(deck_settings_t), intent(in) :: settings
      character(*), intent(in) :: names(:)
      real(wp), intent(out) :: values(:)
      type(error_t), allocatable, intent(out) :: error
      type(suspension_t) :: suspension
      type(case_t), allocatable :: cases(:), all_cases(:), chosen(:)
      type(named_numbers_t) :: numbers
      type(examination_t) :: found
      logical, allocatable :: is_needed(:), is_solvable(:)
      logical :: is_whole

      call load_deck(settings, suspension, cases, error=error)
      if (allocated(error)) return
      if (size(suspension%wheels) > 0) then
         call standard_tests(suspension, cases, all_cases)
      else
         allocate (all_cases(0))
      end if
      if (size(all_cases) > 0) then
         call chosen_cases(settings, all_cases, chosen, error)
      else
         allocate (chosen(0))
      end if
      if (.not. allocated(error)) call prepare_numbers(names, suspension, chosen, numbers, error)
      if (allocated(error)) return
      is_needed = needed_tests(numbers)
      call examine_chosen(settings%file, suspension, pack_cases(chosen, is_needed), found, error)
      if (.not. allocated(error)) call balance(suspension, default_tolerance, error)     ! as in a report
      if (allocated(error)) return
      call print_model_remarks(.true., suspension, cases, pack_cases(chosen, is_needed))     ! warnings, no notes
      allocate (is_solvable(size(chosen)), source=.true.)
      is_solvable = unpack(found%is_solvable, is_needed, is_solvable)
      call read_numbers(numbers, suspension, chosen, values, is_whole, is_solvable)
      if (is_whole) return
      call lost_states(numbers, error)
      if (.not. allocated(error)) call fail(error, exit_convergence, no_value(names, values, found))
   end subroutine find_values

   !> The cases that are needed.
   function pack_cases(cases, is_needed) result(some)
      type(case_t), intent(in) :: cases(:)
      logical, intent(in) :: is_needed(:)
      type(case_t), allocatable :: some(:)
      integer :: k, j

      allocate (some(count(is_needed)))
      j = 0
      do k = 1, size(cases)
         if (.not. is_needed(k)) cycle
         j = j + 1
         some(j) = cases(k)
      end do
   end function pack_cases

   !> Which numbers have no value; the model of this design does not define them.
   function no_value(names, values, found) result(words)
      character(*), intent(in) :: names(:)
      real(wp), intent(in) :: values(:)
      type(examination_t), intent(in) :: found
      character(:), allocatable :: words
      integer :: k

      words = 'no value of'
      do k = 1, size(names)
         if (decimal(values(k)) == 'nan') words = words//' '//trim(names(k))
      end do
      do k = 1, found%distinct%count()
         words = words//nl//found%distinct%line(k)
      end do
   end function no_value

   !> The names of a list with commas, without blanks around them.
   subroutine split_names(list, names)
      character(*), intent(in) :: list
      character(name_length), allocatable, intent(out) :: names(:)
      integer :: first, last

      allocate (names(0))
      first = 1
      do while (first <= len(list))
         last = first + index(list(first:)//',', ',') - 2
         if (list(first:last) /= '') names = [character(name_length) :: names, adjustl(list(first:last))]
         first = last + 2
      end do
   end subroutine split_names

end module ek_run_numbers
