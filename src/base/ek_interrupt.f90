!> A condition that a long run reads repeatedly: whether a signal asks the run to stop. The signals are SIGINT (Ctrl-C), SIGTERM (a
!> batch system at its time limit), SIGHUP (a terminal that was closed), SIGUSR1, SIGUSR2 and SIGXCPU (warnings of batch systems),
!> and SIGQUIT.
module ek_interrupt
   use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr, c_int, c_intptr_t, c_null_funptr
   use ek_posix, only: c_signal
   implicit none(type, external)
   private
   public :: watch_for_stop, is_stop_asked

   integer(c_int), parameter :: sigint = 2, sigterm = 15
   integer(c_int), parameter :: further(*) = [1, 3, 10, 12, 24]       !! SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGXCPU of Linux
   integer(c_intptr_t), parameter :: is_ignored = 1                   !! SIG_IGN, as nohup sets it
   logical, volatile :: is_asked = .false.      !! set by the handler of the signals

contains

   !> Starts watching for signals. From this call on, the first signal of each kind does not end the process; a second signal of the
   !> same kind does. A signal that was ignored before, as SIGHUP is by nohup, stays ignored, except SIGINT and SIGTERM.
   subroutine watch_for_stop()
      type(c_funptr) :: ignored, before
      integer :: k

      is_asked = .false.
      ignored = c_signal(sigint, c_funloc(note_stop))
      ignored = c_signal(sigterm, c_funloc(note_stop))
      do k = 1, size(further)
         before = c_signal(further(k), c_funloc(note_stop))
         if (transfer(before, is_ignored) == is_ignored) ignored = c_signal(further(k), before)
      end do
   end subroutine watch_for_stop

   !> Whether a signal has arrived since the call of watch_for_stop.
   logical function is_stop_asked()
      is_stop_asked = is_asked
   end function is_stop_asked

   !> Handles a signal: records that the run should stop.
   subroutine note_stop(number) bind(c, name='elastokin_note_stop')
      integer(c_int), value :: number
      type(c_funptr) :: ignored

      is_asked = .true.
      ignored = c_signal(number, c_null_funptr)          ! the default action
   end subroutine note_stop

end module ek_interrupt
