!> SIGINT (Ctrl-C) and SIGTERM (a batch system at its time limit) as a question that a long run asks now and then.
module ek_interrupt
   use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr, c_int, c_null_funptr
   use ek_posix, only: c_signal
   implicit none(type, external)
   private
   public :: watch_for_stop, is_stop_asked

   integer(c_int), parameter :: sigint = 2, sigterm = 15
   logical, volatile :: is_asked = .false.      !! set by the handler: the only memory that a signal can reach

contains

   !> From now on these signals no longer end the process. A second one does.
   subroutine watch_for_stop()
      type(c_funptr) :: ignored

      is_asked = .false.
      ignored = c_signal(sigint, c_funloc(note_stop))
      ignored = c_signal(sigterm, c_funloc(note_stop))
   end subroutine watch_for_stop

   !> Whether such a signal has arrived.
   logical function is_stop_asked()
      is_stop_asked = is_asked
   end function is_stop_asked

   !> The handler.
   subroutine note_stop(number) bind(c, name='elastokin_note_stop')
      integer(c_int), value :: number
      type(c_funptr) :: ignored

      is_asked = .true.
      ignored = c_signal(number, c_null_funptr)          ! the default action
   end subroutine note_stop

end module ek_interrupt
