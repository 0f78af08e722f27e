!> A deck opened for a program that calls elastokin: key numbers by name. Part of the Fortran interface (ek_api).
module ek_session_numbers
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: str
   use ek_deck, only: deck_t
   use ek_case, only: case_t
   use ek_named_numbers, only: named_numbers_t, prepare_numbers, read_numbers, needed_tests, explain_missing
   use ek_workspace, only: workspace_t, settle_numbers, settle_or_explain, succeeded
   use ek_workspace_cases, only: open_workspace, report_cases
   use ek_session, only: session_t, without_option, take_new_numbers, changed_deck
   implicit none(type, external)
   private
   public :: read_key_numbers

contains

   !> Reads key numbers of the report by name, at the present numbers. Only the tests that these key numbers need are solved, as far
   !> as needed. The last solution is unchanged.
   subroutine read_key_numbers(session, names, values, error)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: names(:)
      real(wp), intent(out) :: values(:)                   !! one for each name, in the units of key_numbers.csv
      type(error_t), allocatable, intent(out) :: error     !! exit_usage, exit_deck, exit_model: none has a value; exit_convergence:
      !!                                                      some are not a number; the message names them and the states that
      !!                                                      they need and that were not found
      type(case_t), allocatable :: cases(:)
      type(message_list_t) :: none                         ! a case with a defect is not read from numbers alone
      logical :: is_done, is_whole
      integer :: k, outcome

      values = ieee_value(1.0_wp, ieee_quiet_nan)
      if (size(values) < size(names)) then
         call fail(error, exit_usage, 'expected an array of '//str(size(names))//' values, one for each name, found '// &
            str(size(values)))
         return
      end if
      call take_new_numbers(session)
      is_done = session%is_named_ready
      if (is_done) is_done = size(names) == size(session%names)
      do k = 1, size(names)
         if (is_done) is_done = session%names(k) == names(k)
      end do
      if (is_done) then
         call settle_numbers(needed_tests(session%named), session%workspace, outcome)
         is_done = outcome == succeeded
      end if
      if (is_done) then
         call report_cases(session%workspace, cases)
         call read_numbers(session%named, session%workspace%suspension, cases, values, is_whole)
         if (is_whole) return
      end if
      !$omp critical (ek_words)
      if (is_done) then
         call explain_missing(session%named, names, values, none, error)
      else
         call read_with_words(session, names, values, error)
      end if
      !$omp end critical (ek_words)
   end subroutine read_key_numbers

   !> Reads key numbers that were not requested before, or key numbers of a design that may have a defect. Creates strings.
   subroutine read_with_words(session, names, values, error)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: names(:)
      real(wp), intent(inout) :: values(:)
      type(error_t), allocatable, intent(out) :: error
      class(workspace_t), allocatable :: other
      class(named_numbers_t), allocatable :: named
      type(deck_t) :: changed
      logical :: is_done

      session%is_named_ready = .false.
      session%names = names
      if (.not. allocated(session%named)) allocate (session%named)
      call read_of(session%workspace, session%named, is_done)
      if (allocated(error)) return
      session%is_named_ready = is_done
      if (is_done) return
      allocate (other, named)
      call changed_deck(session, changed, error)
      if (.not. allocated(error)) call open_workspace(changed, other, error)
      if (.not. allocated(error)) call read_of(other, named, is_done)
      call without_option(error)

   contains

      subroutine read_of(workspace, numbers, is_done)
         type(workspace_t), intent(inout) :: workspace
         type(named_numbers_t), intent(inout) :: numbers
         logical, intent(out) :: is_done
         type(case_t), allocatable :: cases(:)
         type(message_list_t) :: defects
         logical :: is_solvable(size(workspace%report_order)), is_whole

         call report_cases(workspace, cases)
         call prepare_numbers(names, workspace%raw, cases, numbers, error)
         is_done = .false.
         if (.not. allocated(error)) call settle_or_explain(needed_tests(numbers), workspace, is_solvable, defects, is_done, error)
         if (allocated(error) .or. .not. is_done) return
         call report_cases(workspace, cases)                 ! with the present numbers
         call read_numbers(numbers, workspace%suspension, cases, values, is_whole, is_solvable)
         if (.not. is_whole) call explain_missing(numbers, names, values, defects, error)
      end subroutine read_of

   end subroutine read_with_words

end module ek_session_numbers
