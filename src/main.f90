!> The program: arguments → command → exit status.
program elastokin
   use ek_error, only: error_t, exit_usage
   use ek_command, only: commands, options, exit_status_text, help_text, obey
   use ek_command_line, only: command_line_t, read_command_line
   use ek_build_facts, only: build
   use ek_version_text, only: program_name, version_text, build_text
   use ek_threads, only: use_one_thread
   use ek_clock, only: check_set_date
   use ek_system, only: prepare_surroundings
   use ek_console, only: print_error, print_message, print_text
   use ek_help_files, only: write_help_files
   use ek_run_log, only: begin_log, end_log
   implicit none(type, external)
   type(command_line_t) :: line
   type(error_t), allocatable :: error, unlogged
   integer :: status

   call prepare_surroundings()
   call read_command_line(commands, options, line, error)
   if (.not. allocated(error)) then
      if (line%has('--version')) then
         call print_text(version_text(build), error)
      else if (line%has('--help-files')) then
         call write_help_files(commands, options, exit_status_text, line%value('--help-files'), error)
      else if (line%has('--help') .or. command_argument_count() == 0) then
         call print_text(help_text(line%command)//new_line('a'), error)
      else
         call begin_log(line, error)
         if (.not. allocated(error)) call check_set_date(error)
         if (.not. allocated(error)) call use_one_thread(error)
         line%build = build_text(build)
         if (.not. allocated(error)) call obey(line, error)
      end if
   else
      call begin_log(line, unlogged)       ! as far as it could be read, a wrong command line is recorded too
   end if

   status = 0
   if (allocated(error)) then
      status = error%code
      call print_error(error%message)
      if (status == exit_usage) call print_message('see '//help_command())
   end if
   call end_log(program_name(build), status, unlogged)
   if (allocated(unlogged)) then
      call print_error(unlogged%message)
      if (status == 0) status = unlogged%code
   end if
   if (status /= 0) stop status, quiet=.true.

contains

   !> The command line that prints the help of this command.
   function help_command() result(text)
      character(:), allocatable :: text
      text = 'elastokin --help'
      if (.not. allocated(line%command)) return
      if (any(commands%name == line%command)) text = 'elastokin '//line%command//' --help'
   end function help_command

end program elastokin
