!> elastokin run --responses: evaluates a deck as a black box for optimisers and drivers. Writes key numbers by name, one line
!> `value name` each, to standard output or to one file.
module ek_run_numbers
   use ek_kinds, only: wp
   use ek_error, only: error_t, exit_convergence
   use ek_buffer, only: buffer_t
   use ek_decimal, only: decimal
   use ek_file, only: write_whole, write_standard_output
   use ek_case, only: case_t
   use ek_table, only: name_length
   use ek_workspace_cases, only: report_cases, restrict_cases
   use ek_session, only: session_t, find_remarks
   use ek_session_solution, only: read_key_numbers
   use ek_model_remark, only: model_remarks_t
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: deck_settings_t, load_session, chosen_cases
   use ek_console, only: print_model_remarks
   implicit none(type, external)
   private
   public :: run_numbers, split_names

   character(*), parameter :: nl = new_line('a')

contains

   !> Writes the requested key numbers of a deck. After an error, the results contain FAIL, for which drivers search, and the
   !> reason. For example, a key number has no value, or a required state did not converge.
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
      if (allocated(error)) then
         if (len(unwritten%message) == 0) return   ! nobody reads standard output any more
         unwritten%message = error%message//nl//unwritten%message
      end if
      call move_alloc(unwritten, error)
   end subroutine run_numbers

   !> Writes the complete results of a design, or no file.
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

   !> Solves the tests that the key numbers need in a session, reads the values, and prints the warnings on the model.
   subroutine find_values(settings, names, values, error)
      class(deck_settings_t), intent(in) :: settings
      character(*), intent(in) :: names(:)
      real(wp), intent(out) :: values(:)
      type(error_t), allocatable, intent(out) :: error
      class(session_t), allocatable :: session
      type(case_t), allocatable :: cases(:), chosen(:)
      type(model_remarks_t) :: remarks
      type(error_t), allocatable :: unread

      call load_session(settings, session, error)
      if (allocated(error)) return
      call report_cases(session%workspace, cases)
      if (size(cases) > 0) then
         call chosen_cases(settings, session%workspace%raw, cases, chosen, error)
         if (allocated(error)) return
         call restrict_cases(chosen, session%workspace)
      end if
      call read_key_numbers(session, names, values, error)
      if (allocated(error)) then
         if (error%code /= exit_convergence) return
      end if
      call find_remarks(session, remarks, unread)
      if (.not. allocated(unread)) call print_model_remarks(.true., remarks)     ! warnings, no notes
   end subroutine find_values

   !> Splits a comma-separated list into names, without surrounding blanks.
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
