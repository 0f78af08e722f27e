!> elastokin-bench DECK: time of increments, designs, derivatives and K&C quantities of a deck; with --growth, of chains of bodies.
program elastokin_bench
   use ek_error, only: error_t, exit_usage
   use ek_command_line, only: command_t, option_t, command_line_t, read_command_line
   use ek_option_help, only: command_help
   use ek_version, only: version
   use ek_threads, only: use_one_thread
   use ek_system, only: prepare_surroundings
   use ek_console, only: print_error, print_text
   use ek_bench, only: bench
   implicit none(type, external)
   character(*), parameter :: nl = new_line('a')
   type(command_t), parameter :: commands(1) = [ &
      command_t('bench', 'bench DECK   or   elastokin-bench --growth N', 'bench DECK', &
      'measure the time of increments, relative to LAPACK', &
      'Measures the time of a complete increment and of its parts, for each method and each solver (lapack, sparse). The'//nl// &
      'unit is the time of LAPACK''s dsysv (factorisation and solution) on the same matrices in the same run.'//nl// &
      'Also measures:'//nl// &
      '  SIMD batches of four designs,'//nl// &
      '  the compliance matrix at one state,'//nl// &
      '  a complete design of 20 increments (as in a study), and its time minus the time of its states and one column,'//nl// &
      '  all steps from deck to CSV (omitted with --quiet).', '', alone='--growth')]
   type(option_t), parameter :: options(*) = [ &
      option_t('bench', '--case NAME', ''), option_t('bench', '--increments N', ''), option_t('bench', '--set path=value', ''), &
      option_t('bench', '--growth N', &
      'measure chains of bodies instead of a deck, with matrices of 100 to N rows (at most 2000)'), &
      option_t('bench', '--derivatives', &
      'measure the cost of derivatives instead; the unit is one sweep of the same states by LAPACK'), &
      option_t('bench', '--json', 'print one JSON object'), option_t('bench', '--quiet', ''), &
      option_t('bench', '--help', 'print this description'), option_t('bench', '--version', 'print the version')]
   type(command_line_t) :: line
   type(error_t), allocatable :: error
   integer :: status

   call prepare_surroundings()
   call read_command_line(commands, options, line, error)
   if (.not. allocated(error)) then
      if (line%has('--version')) then
         call print_text('elastokin-bench '//version//nl, error)
      else if (line%has('--help') .or. command_argument_count() == 0) then
         call print_text(command_help(commands, options, 1)//nl, error)
      else
         call use_one_thread(error)
         if (.not. allocated(error)) call bench(line, error)
      end if
   end if
   status = 0
   if (allocated(error)) then
      status = error%code
      call print_error(error%message)
      if (status == exit_usage) call print_error('see elastokin-bench --help')
   end if
   if (status /= 0) stop status, quiet=.true.

end program elastokin_bench
