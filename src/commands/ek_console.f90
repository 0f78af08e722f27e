!> Output on the console: messages on standard error; findings and the paths of results on standard output. All output except the
!> progress line is also added to the log of the run.
module ek_console
   use ek_error, only: error_t, message_list_t
   use ek_text, only: str, plural, printable
   use ek_file, only: is_terminal, write_standard_output, write_standard_error
   use ek_remark, only: remark_t, remark_list_t, note, warning
   use ek_model_remark, only: model_remarks_t, doubt_mark
   use ek_run_log, only: log_message, log_output
   implicit none(type, external)
   private
   public :: print_message, print_note, print_marked, print_warning, print_error, print_text, print_model_remarks, print_remarks, &
      show_progress, &
      clear_progress

contains

   !> Prints an informational message. With --quiet, the message is added to the log only.
   subroutine print_note(quiet, text)
      logical, intent(in) :: quiet
      character(*), intent(in) :: text
      if (.not. quiet) call print_message(text)
      if (quiet) call log_message(printable(text))
   end subroutine print_note

   !> Prints an informational message that begins with a word of an assessment: 'outside' in red, 'at the edge' in yellow, 'inside'
   !> in green; without a colour if standard error is not a terminal, or NO_COLOR is set. Without a word, blanks stand for it.
   subroutine print_marked(quiet, text, word)
      logical, intent(in) :: quiet
      character(*), intent(in) :: text, word
      character(*), parameter :: words(3) = [character(11) :: 'outside', 'at the edge', 'inside'], codes(3) = ['31', '33', '32']
      character(len(words)) :: mark
      integer :: k

      mark = word
      if (.not. quiet) then
         k = 0
         if (has_colours()) k = findloc(words, word, dim=1)
         if (k > 0) then
            call write_standard_error(achar(27)//'['//codes(k)//'m'//mark//achar(27)//'[0m  '//printable(text)//new_line('a'))
         else
            call write_standard_error(mark//'  '//printable(text)//new_line('a'))
         end if
      end if
      call log_message(trim(mark//'  '//printable(text)))
   end subroutine print_marked

   !> Whether standard error is a terminal and NO_COLOR is not set (https://no-color.org).
   logical function has_colours()
      integer :: length

      call get_environment_variable('NO_COLOR', length=length)
      has_colours = is_terminal(2) .and. length == 0
   end function has_colours

   !> Prints a warning: results may be unreliable.
   subroutine print_warning(text)
      character(*), intent(in) :: text
      call print_message('warning: '//text)
   end subroutine print_warning

   !> Prints an error, before the program ends or continues with the next case. An empty message prints nothing.
   subroutine print_error(text)
      character(*), intent(in) :: text
      if (len(text) > 0) call print_message('error: '//text)
   end subroutine print_error

   !> Writes a message to standard error and to the log. Control characters from a deck do not reach the terminal.
   subroutine print_message(text)
      character(*), intent(in) :: text
      call write_standard_error(printable(text)//new_line('a'))
      call log_message(printable(text))
   end subroutine print_message

   !> Prints findings to standard output and adds them to the log.
   subroutine print_text(text, error)
      character(*), intent(in) :: text                          !! including its line ends
      type(error_t), allocatable, intent(out) :: error          !! exit_file
      call write_standard_output(printable(text), error)
      call log_output(printable(text))
   end subroutine print_text

   !> Shows the progress '12 of 400 states' in a line that overwrites itself, if standard error is a terminal.
   subroutine show_progress(done, total)
      integer, intent(in) :: done, total
      if (is_terminal(2)) call write_standard_error(achar(13)//'  '//str(done)//' of '//str(total)//' states')
   end subroutine show_progress

   !> Clears the progress line.
   subroutine clear_progress()
      if (is_terminal(2)) call write_standard_error(achar(13)//repeat(' ', 40)//achar(13))
   end subroutine clear_progress

   !> Prints the messages on a model before its cases are run: the notes, the warnings, and the first remark on an implausible
   !> value, with the number of further remarks. `page` collects the warnings and all remarks, but no notes.
   subroutine print_model_remarks(quiet, remarks, page)
      logical, intent(in) :: quiet
      type(model_remarks_t), intent(in) :: remarks
      type(message_list_t), intent(inout), optional :: page
      character(:), allocatable :: more
      integer :: k

      do k = 1, remarks%notes%count()
         call print_note(quiet, remarks%notes%line(k))
      end do
      do k = 1, remarks%warnings%count()
         call print_warning(remarks%warnings%line(k))
         if (present(page)) call page%add(remarks%warnings%line(k))
      end do
      k = remarks%doubts%count()
      if (k == 0) return
      more = ''
      if (k > 1) more = '; and '//plural(k - 1, 'more remark', 'more remarks')//': see elastokin check'
      call print_warning(doubt_mark//remarks%doubts%line(1)//more)
      do k = 1, remarks%doubts%count()
         if (present(page)) call page%add(doubt_mark//remarks%doubts%line(k))
      end do
   end subroutine print_model_remarks

   !> Prints the notes and warnings on a case. The failures of the case are not printed here, because they become an error.
   subroutine print_remarks(quiet, remarks)
      logical, intent(in) :: quiet
      type(remark_list_t), intent(in) :: remarks
      type(remark_t) :: remark
      integer :: k

      do k = 1, remarks%count()
         remark = remarks%item(k)
         if (remark%severity == note) call print_note(quiet, remark%whole())
         if (remark%severity == warning) call print_warning(remark%whole())
      end do
   end subroutine print_remarks

end module ek_console
