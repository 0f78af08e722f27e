!> The program: arguments → command → exit status.
program elastokin
   use ek_error, only: error_t, exit_usage
   use ek_command, only: commands, options, help_text, obey
   use ek_command_line, only: command_line_t, read_command_line
   use ek_version, only: version
   use ek_threads, only: use_one_thread
   use ek_system, only: prepare_surroundings
   use ek_console, only: print_error, print_text
   implicit none(type, external)
   type(command_line_t) :: line
   type(error_t), allocatable :: error

   call prepare_surroundings()
   call read_command_line(commands, options, line, error)
   if (.not. allocated(error)) then
      if (line%has('--version')) then
         call print_text('elastokin '//version//new_line('a'), error)
      else if (line%has('--help') .or. command_argument_count() == 0) then
         call print_text(help_text(line%command)//new_line('a'), error)
      else
         call use_one_thread(error)
         if (.not. allocated(error)) call obey(line, error)
      end if
   end if

   if (allocated(error)) then
      call print_error(error%message)
      if (error%code == exit_usage) call print_error('see elastokin --help')
      stop error%code, quiet=.true.
   end if

end program elastokin
