!> The program: arguments → command → exit status.
program elastokin
   use ek_error, only: error_t, exit_usage
   use ek_arguments, only: arguments_t, read_arguments
   use ek_help, only: help_text
   use ek_version, only: version
   use ek_threads, only: use_one_thread
   use ek_surroundings, only: prepare_surroundings
   use ek_words, only: complain, tell
   use ek_run, only: run
   use ek_check, only: check
   use ek_report, only: report
   use ek_compare, only: compare
   use ek_study_command, only: run_study_command
   use ek_bench, only: bench
   implicit none(type, external)
   type(arguments_t) :: arguments
   type(error_t), allocatable :: error

   call prepare_surroundings()
   call read_arguments(arguments, error)
   if (.not. allocated(error)) then
      if (arguments%version) then
         call tell('elastokin '//version//new_line('a'), error)
      else if (arguments%help) then
         call tell(help_text(arguments%command)//new_line('a'), error)
      else
         call use_one_thread(error)
         if (.not. allocated(error)) call obey(arguments, error)
      end if
   end if

   if (allocated(error)) then
      call complain(error%message)
      if (error%code == exit_usage) call complain('see elastokin --help')
      stop error%code, quiet=.true.
   end if

contains

   !> Runs the command given by the arguments.
   subroutine obey(arguments, error)
      type(arguments_t), intent(in) :: arguments
      type(error_t), allocatable, intent(out) :: error

      select case (arguments%command)
      case ('run')
         call run(arguments, error)
      case ('check')
         call check(arguments, error)
      case ('report')
         call report(arguments, error)
      case ('compare')
         call compare(arguments, error)
      case ('study')
         call run_study_command(arguments, error)
      case ('bench')
         call bench(arguments, error)
      end select
   end subroutine obey

end program elastokin
