!> A condition that a long run reads repeatedly: whether a signal asks the run to stop. The signals are SIGINT (Ctrl-C), SIGTERM (a
!> batch system at its time limit), SIGHUP (a terminal that was closed), SIGUSR1, SIGUSR2 and SIGXCPU (warnings of batch systems),
!> and SIGQUIT. Their handler stands in elastokin_system.c.
!>
!> While a run waits for another program (ek_process), the same signals end that program. A signal that was ignored before stays
!> ignored. The caller removes its temporary files, and then calls obey_stop.
module ek_interrupt
   use ek_system_call, only: c_watch, c_is_asked, c_obey
   implicit none(type, external)
   private
   public :: watch_for_stop, is_stop_asked, obey_stop

contains

   !> Starts watching for signals. From this call on, the first signal of each kind does not end the process; a second signal of the
   !> same kind does. A signal that was ignored before, as SIGHUP is by nohup, stays ignored, except SIGINT and SIGTERM.
   subroutine watch_for_stop()
      call c_watch()
   end subroutine watch_for_stop

   !> Whether a signal has arrived since the call of watch_for_stop.
   logical function is_stop_asked()
      is_stop_asked = c_is_asked() /= 0
   end function is_stop_asked

   !> Ends this process by the signal that arrived during the last wait, unless the run itself watches for signals. Without such a
   !> signal, there is no effect.
   subroutine obey_stop()
      call c_obey()
   end subroutine obey_stop

end module ek_interrupt
