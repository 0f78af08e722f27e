!> Output on the console: messages on standard error; findings and the paths of results on standard output.
module ek_words
   use ek_error, only: error_t
   use ek_text, only: str, printable
   use ek_file, only: is_terminal, write_standard_output, write_standard_error
   implicit none(type, external)
   private
   public :: say, warn, complain, tell, tell_path, show_progress, clear_progress

contains

   !> An informational message; suppressed by --quiet.
   subroutine say(quiet, text)
      logical, intent(in) :: quiet
      character(*), intent(in) :: text
      if (.not. quiet) call to_person(text)
   end subroutine say

   !> A warning: results may be unreliable.
   subroutine warn(text)
      character(*), intent(in) :: text
      call to_person('warning: '//text)
   end subroutine warn

   !> An error, before the program ends or continues with the next case. An empty message prints nothing.
   subroutine complain(text)
      character(*), intent(in) :: text
      if (len(text) > 0) call to_person('error: '//text)
   end subroutine complain

   !> Writes every message to standard error. Control characters from a deck do not reach the terminal.
   subroutine to_person(text)
      character(*), intent(in) :: text
      call write_standard_error(printable(text)//new_line('a'))
   end subroutine to_person

   !> Prints findings on standard output.
   subroutine tell(text, error)
      character(*), intent(in) :: text                          !! including its line ends
      type(error_t), allocatable, intent(out) :: error          !! exit_file
      call write_standard_output(printable(text), error)
   end subroutine tell

   !> Prints the path of a result on standard output. If standard output is full or closed the work continues, because the
   !> result exists. The first such failure is kept; a reader that closes the pipe (`| head`) is no failure.
   subroutine tell_path(path, unheard)
      character(*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: unheard      !! exit_file
      type(error_t), allocatable :: error

      if (allocated(unheard)) return
      call write_standard_output(path//new_line('a'), error)
      if (.not. allocated(error)) return
      if (len(error%message) > 0) call move_alloc(error, unheard)
   end subroutine tell_path

   !> Progress line, which overwrites itself; on a terminal only.
   subroutine show_progress(done, total)
      integer, intent(in) :: done, total
      if (is_terminal(2)) call write_standard_error(achar(13)//'  '//str(done)//' of '//str(total)//' states')
   end subroutine show_progress

   !> Clears the progress line.
   subroutine clear_progress()
      if (is_terminal(2)) call write_standard_error(achar(13)//repeat(' ', 40)//achar(13))
   end subroutine clear_progress

end module ek_words
