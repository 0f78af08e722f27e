!> Runs another program without a shell, in a given folder and with a time limit. A signal that stops this process also stops the
!> other program.
module ek_process
   use, intrinsic :: iso_c_binding, only: c_int32_t, c_null_char
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_system_call, only: c_run, c_become, c_stop_signal, no_log, not_started, too_late, stopped
   use ek_system, only: system_reason
   implicit none(type, external)
   private
   public :: run_program, go_on_as

contains

   !> Runs a program, which is found in PATH, in `folder`. The output of the program goes to the file `log`; its standard input is
   !> empty.
   !>
   !> The program and its children form a process group, which is killed at the time limit, and when a signal asks this process to
   !> stop. The caller then removes its temporary files and calls obey_stop (ek_interrupt). If this process itself is killed first,
   !> an alarm ends the program soon after the limit.
   subroutine run_program(words, folder, log, limit, status, trouble)
      type(message_list_t), intent(in) :: words               !! the program and its arguments
      character(*), intent(in) :: folder, log                 !! log: path relative to the current folder
      integer, intent(in) :: limit                            !! s
      integer, intent(out) :: status                          !! exit status; 128 + number of a signal; 127: not started
      character(:), allocatable, intent(out) :: trouble       !! failure to start the program, the time limit or a signal; ''

      trouble = ''
      select case (c_run(argument_list(words), int(words%count(), c_int32_t), folder//c_null_char, log//c_null_char, &
         int(limit, c_int32_t), status))
      case (no_log)
         trouble = 'cannot write '''//log//''': '//system_reason()
      case (not_started)
         trouble = 'cannot start '//words%line(1)//': '//system_reason()
      case (too_late)
         trouble = 'it did not finish within '//str(limit)//' s and was stopped'
      case (stopped)
         trouble = 'signal '//str(int(c_stop_signal()))//' has stopped it'
      end select
   end subroutine run_program

   !> Replaces this process by another program, with the same arguments, environment and open files. Returns only if the program
   !> cannot be started.
   subroutine go_on_as(path)
      character(*), intent(in) :: path                        !! of the program
      type(message_list_t) :: words
      character(:), allocatable :: word
      integer :: k, length

      call words%add(path)
      do k = 1, command_argument_count()
         call get_command_argument(k, length=length)
         word = repeat(' ', length)
         call get_command_argument(k, word)
         call words%add(word)
      end do
      call c_become(argument_list(words), int(words%count(), c_int32_t))
   end subroutine go_on_as

   !> The arguments as one string, each ended by a null character.
   function argument_list(words) result(text)
      type(message_list_t), intent(in) :: words
      character(:), allocatable :: text
      integer :: k

      text = ''
      do k = 1, words%count()
         text = text//words%line(k)//c_null_char
      end do
   end function argument_list

end module ek_process
