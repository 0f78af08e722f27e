!> Runs another program without a shell, in a given folder and with a time limit. A signal that stops this process also stops the
!> other program.
module ek_process
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_loc, c_long, c_null_char, c_null_ptr, c_ptr, c_associated
   use ek_kinds, only: wp
   use ek_clock, only: seconds
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_posix, only: c_fopen, c_fileno, c_fclose, c_dup2, c_fork, c_execvp, c_exit_now, c_chdir, c_setpgid, c_alarm, &
      c_kill, c_waitpid, c_poll
   use ek_interrupt, only: begin_wait, stop_signal, end_wait
   use ek_system, only: set_signal, system_reason, error_number, interrupted, sigpipe
   implicit none(type, external)
   private
   public :: run_program, go_on_as

   integer, parameter :: sigkill = 9, sigalrm = 14      !! numbers of signals, the same on all systems

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
      character(kind=c_char), allocatable, target :: letters(:)
      type(c_ptr), allocatable :: pointers(:)
      type(c_ptr) :: said, nothing
      character(:), allocatable :: place, program
      integer(c_int) :: process
      integer :: ignored

      status = 127
      trouble = ''
      call argument_list(words, letters, pointers)
      place = folder//c_null_char
      program = words%line(1)//c_null_char
      said = c_fopen(log//c_null_char, 'wbe'//c_null_char)
      nothing = c_fopen('/dev/null'//c_null_char, 'rbe'//c_null_char)
      if (.not. (c_associated(said) .and. c_associated(nothing))) then
         trouble = 'cannot write '''//log//''': '//system_reason()
      else
         call begin_wait()
         process = c_fork()
         if (process == 0) then                                ! from here to execvp only system calls are allowed
            ignored = c_setpgid(0_c_int, 0_c_int)
            call set_signal(sigpipe, is_ignored=.false.)
            call set_signal(sigalrm, is_ignored=.false.)
            ignored = c_alarm(int(limit + 5, c_int))
            ignored = c_dup2(c_fileno(nothing), 0_c_int)
            ignored = c_dup2(c_fileno(said), 1_c_int)
            ignored = c_dup2(c_fileno(said), 2_c_int)
            if (c_chdir(place) == 0) ignored = c_execvp(program, pointers)
            call c_exit_now(127_c_int)
         end if
         if (process < 0) then
            trouble = 'cannot start '//words%line(1)//': '//system_reason()
         else
            ignored = c_setpgid(process, process)              ! parent and child both set it: whichever runs first
            call wait_for(process, limit, status, trouble)
         end if
         call end_wait()
      end if
      if (c_associated(said)) ignored = c_fclose(said)
      if (c_associated(nothing)) ignored = c_fclose(nothing)
   end subroutine run_program

   !> Replaces this process by another program, with the same arguments, environment and open files. Returns only if the program
   !> cannot be started.
   subroutine go_on_as(path)
      character(*), intent(in) :: path                        !! of the program
      type(message_list_t) :: words
      character(kind=c_char), allocatable, target :: letters(:)
      type(c_ptr), allocatable :: pointers(:)
      character(:), allocatable :: word
      integer :: k, length, ignored

      call words%add(path)
      do k = 1, command_argument_count()
         call get_command_argument(k, length=length)
         word = repeat(' ', length)
         call get_command_argument(k, word)
         call words%add(word)
      end do
      call argument_list(words, letters, pointers)
      ignored = c_execvp(path//c_null_char, pointers)
   end subroutine go_on_as

   !> Waits for a process to end, and kills its group at the time limit.
   subroutine wait_for(process, limit, status, trouble)
      integer(c_int), intent(in) :: process
      integer, intent(in) :: limit                            !! s
      integer, intent(out) :: status
      character(:), allocatable, intent(inout) :: trouble
      integer(c_int), parameter :: at_once = 1, until_then = 0      ! WNOHANG
      integer(c_int) :: word, found
      integer :: nap, ignored
      real(wp) :: deadline

      status = 0                                              ! status collected elsewhere: the pictures themselves decide
      word = 0
      nap = 1
      deadline = seconds() + limit
      do
         found = c_waitpid(process, word, at_once)
         if (found == process) exit
         if (found < 0) then
            if (error_number() == interrupted) cycle
            return
         end if
         if (seconds() > deadline .or. stop_signal() /= 0) then
            ignored = c_kill(-process, int(sigkill, c_int))
            do
               found = c_waitpid(process, word, until_then)
               if (found >= 0) exit
               if (error_number() /= interrupted) exit
            end do
            trouble = 'it did not finish within '//str(limit)//' s and was stopped'
            if (stop_signal() /= 0) trouble = 'signal '//str(stop_signal())//' has stopped it'
            exit
         end if
         ignored = c_poll(c_null_ptr, 0_c_long, int(nap, c_int))
         nap = min(2*nap, 20)                                  ! ms
      end do
      status = iand(ishft(int(word), -8), 255)
      if (iand(int(word), 127) /= 0) status = 128 + iand(int(word), 127)
   end subroutine wait_for

   !> Converts the arguments to C strings.
   subroutine argument_list(words, letters, pointers)
      type(message_list_t), intent(in) :: words
      character(kind=c_char), allocatable, target, intent(out) :: letters(:)
      type(c_ptr), allocatable, intent(out) :: pointers(:)     !! into letters; a null at the end
      character(:), allocatable :: text
      integer :: k
      integer :: first(words%count())                          ! letter of each word

      text = ''
      do k = 1, words%count()
         first(k) = len(text) + 1
         text = text//words%line(k)//c_null_char
      end do
      allocate (letters(len(text)), pointers(words%count() + 1))
      letters(:) = [(text(k:k), k=1, len(text))]
      pointers = [(c_loc(letters(first(k))), k=1, words%count()), c_null_ptr]
   end subroutine argument_list

end module ek_process
