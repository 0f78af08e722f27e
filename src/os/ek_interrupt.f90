!> A condition that a long run reads repeatedly: whether a signal asks the run to stop. The signals are SIGINT (Ctrl-C), SIGTERM (a
!> batch system at its time limit), SIGHUP (a terminal that was closed), SIGUSR1, SIGUSR2 and SIGXCPU (warnings of batch systems),
!> and SIGQUIT.
!>
!> A run that waits for another program watches for the same signals while it waits:
!>
!>     call begin_wait()                      ! before the program is started
!>     if (stop_signal() /= 0) …              ! end the program and its children
!>     call end_wait()
!>     call obey_stop()                       ! after temporary files were removed: ends this process as the signal would have
module ek_interrupt
   use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr, c_int, c_intptr_t, c_null_funptr
   use ek_posix, only: c_signal, c_raise
   implicit none(type, external)
   private
   public :: watch_for_stop, is_stop_asked, begin_wait, stop_signal, end_wait, obey_stop

   integer(c_int), parameter :: sigint = 2, sigterm = 15
   !> SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGXCPU of Linux
   integer(c_int), parameter :: signals(*) = [sigint, sigterm, 1, 3, 10, 12, 24]
   integer, parameter :: always = 2                                   !! the first signals are watched also if they were ignored
   integer(c_intptr_t), parameter :: is_ignored = 1                   !! SIG_IGN, as nohup sets it
   logical, volatile :: is_asked = .false.      !! set by the handler of the signals
   integer(c_int), volatile :: latest = 0       !! number of the signal that arrived since the last call of begin_wait; 0: none
   logical :: is_watching = .false.             !! the run itself watches for signals (watch_for_stop)

contains

   !> Starts watching for signals. From this call on, the first signal of each kind does not end the process; a second signal of the
   !> same kind does. A signal that was ignored before, as SIGHUP is by nohup, stays ignored, except SIGINT and SIGTERM.
   subroutine watch_for_stop()
      is_asked = .false.
      is_watching = .true.
      call set_handlers()
   end subroutine watch_for_stop

   subroutine set_handlers()
      type(c_funptr) :: ignored, before
      integer :: k

      do k = 1, size(signals)
         before = c_signal(signals(k), c_funloc(note_stop))
         if (k > always .and. transfer(before, is_ignored) == is_ignored) ignored = c_signal(signals(k), before)
      end do
   end subroutine set_handlers

   !> Watches for signals while this process waits for another program. A signal that was ignored before stays ignored.
   subroutine begin_wait()
      type(c_funptr) :: ignored, before
      integer :: k

      latest = 0
      if (is_watching) return
      do k = 1, size(signals)
         before = c_signal(signals(k), c_funloc(note_stop))
         if (transfer(before, is_ignored) == is_ignored) ignored = c_signal(signals(k), before)
      end do
   end subroutine begin_wait

   !> Number of the signal that arrived since begin_wait; 0 without a signal.
   integer function stop_signal()
      stop_signal = int(latest)
   end function stop_signal

   !> Ends the watch of begin_wait.
   subroutine end_wait()
      type(c_funptr) :: ignored, before
      integer :: k

      if (is_watching) return
      do k = 1, size(signals)
         before = c_signal(signals(k), c_null_funptr)       ! the default action
         if (transfer(before, is_ignored) == is_ignored) ignored = c_signal(signals(k), before)
      end do
   end subroutine end_wait

   !> Ends this process by the signal that arrived during the last wait, unless the run itself watches for signals. Without such a
   !> signal, there is no effect.
   subroutine obey_stop()
      integer :: ignored

      if (latest == 0 .or. is_watching) return
      ignored = c_raise(latest)
   end subroutine obey_stop

   !> Whether a signal has arrived since the call of watch_for_stop.
   logical function is_stop_asked()
      is_stop_asked = is_asked
   end function is_stop_asked

   !> Handles a signal: records that the run should stop.
   subroutine note_stop(number) bind(c, name='elastokin_note_stop')
      integer(c_int), value :: number
      type(c_funptr) :: ignored

      is_asked = .true.
      latest = number
      ignored = c_signal(number, c_null_funptr)          ! the default action
   end subroutine note_stop

end module ek_interrupt
