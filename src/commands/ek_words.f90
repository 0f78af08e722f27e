!> Words for a person, on standard error; results go elsewhere, and their paths to standard output.
module ek_words
   use, intrinsic :: iso_fortran_env, only: error_unit
   use ek_error, only: error_t
   use ek_file, only: is_terminal, write_standard_output
   implicit none(type, external)
   private
   public :: say, warn, complain, tell_path, show_progress, clear_progress

contains

   !> A note, unless the user wants quiet.
   subroutine say(quiet, text)
      logical, intent(in) :: quiet
      character(*), intent(in) :: text
      if (.not. quiet) write (error_unit, '(a)') text
   end subroutine say

   !> Something that makes results doubtful.
   subroutine warn(text)
      character(*), intent(in) :: text
      write (error_unit, '(a)') 'warning: '//text
   end subroutine warn

   !> An error, before the program ends or goes on to the next case.
   subroutine complain(text)
      character(*), intent(in) :: text
      write (error_unit, '(a)') 'error: '//text
   end subroutine complain

   !> The path of a result, for whoever reads standard output. Where that is full or closed the work goes on: the result
   !> is there. The first such failure is kept.
   subroutine tell_path(path, unheard)
      character(*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: unheard      !! exit_file
      type(error_t), allocatable :: error

      if (allocated(unheard)) return
      call write_standard_output(path//new_line('a'), error)
      if (allocated(error)) call move_alloc(error, unheard)
   end subroutine tell_path

   !> A line that overwrites itself, on a terminal only.
   subroutine show_progress(done, total)
      integer, intent(in) :: done, total
      if (is_terminal(2)) write (error_unit, '(a,i0,a,i0,a)', advance='no') achar(13)//'  ', done, ' of ', total, ' states'
   end subroutine show_progress

   !> Takes the progress line away.
   subroutine clear_progress()
      if (is_terminal(2)) write (error_unit, '(a)', advance='no') achar(13)//repeat(' ', 40)//achar(13)
   end subroutine clear_progress

end module ek_words
