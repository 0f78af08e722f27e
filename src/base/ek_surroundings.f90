!> Corrects the signal actions and file descriptors that a batch system, a shell or a pipe has set for this process. It
!> affects the whole process: only the main program may call it, once, before anything else.
module ek_surroundings
   use, intrinsic :: iso_c_binding, only: c_int, c_null_char, c_ptr
   use ek_posix, only: c_close, c_dup, c_fopen
   use ek_system, only: set_signal
   implicit none(type, external)
   private
   public :: prepare_surroundings

   integer, parameter :: sigpipe = 13       !! the same on all systems; so is the next
   integer, parameter :: sigxfsz = 25

contains

   !> A reader that closes the pipe (`| head`) and a file that reaches `ulimit -f` become write errors instead of ending the
   !> process. Descriptors 0, 1 and 2 are opened if they were closed (`>&-`), so that no results file receives one of these
   !> numbers and messages in the middle of it.
   subroutine prepare_surroundings()
      type(c_ptr) :: stays_open
      integer(c_int) :: descriptor, copy
      integer :: k, ignored

      call set_signal(sigpipe, is_ignored=.true.)
      call set_signal(sigxfsz, is_ignored=.true.)
      do k = 0, 2
         descriptor = int(k, c_int)
         copy = c_dup(descriptor)
         if (copy >= 0) then
            ignored = c_close(copy)
         else if (k == 0) then                                            ! open takes the lowest free number: this one
            stays_open = c_fopen('/dev/null'//c_null_char, 'w'//c_null_char)      ! reading fails, as it did
         else
            stays_open = c_fopen('/dev/null'//c_null_char, 'r'//c_null_char)      ! writing fails
         end if
      end do
   end subroutine prepare_surroundings

end module ek_surroundings
