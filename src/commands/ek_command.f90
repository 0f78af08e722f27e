!> The commands and their options as tables, which define what a command line may say and what --help prints.
!>
!> A new command: its own file; here its row in `commands`, its options in `uses`, and its call in `obey`.
module ek_command
   use ek_error, only: error_t
   use ek_arguments, only: arguments_t
   use ek_run, only: run
   use ek_check, only: check
   use ek_report, only: report
   use ek_compare, only: compare
   use ek_study_command, only: run_study_command
   use ek_bench, only: bench
   implicit none(type, external)
   private
   public :: commands, options, uses, option_number, command_names, help_text, obey

   character(*), parameter :: nl = new_line('a'), indent = nl//repeat(' ', 21)
   character(*), parameter :: quiet_help = 'suppress informational messages; warnings and errors remain'
   character(*), parameter :: no_plots_help = 'tables only; gnuplot is not started'

   type :: command_t
      character(7) :: name
      character(80) :: usage      !! after 'elastokin'; options without a line of help are appended
      character(15) :: brief      !! the same in the overview
      character(60) :: summary    !! line of the overview
      character(420) :: text      !! description
      character(180) :: ending    !! after the options
   end type command_t

   type(command_t), parameter :: commands(*) = [ &
      command_t('run', 'run DECK [options]', 'run DECK', 'sweep the cases of a deck; write CSV files (and plots)', &
      'Sweeps every case of a deck and writes DIR/<model>_<case>.csv, one row per state.'//nl// &
      'DECK may be - (standard input). File paths are printed to standard output, messages to standard error.', &
      'Exit status: 0 success, 1 usage, 2 deck, 3 model (mechanism or redundant constraint),'//nl// &
      '4 a state did not converge (the converged states are written), 5 files.'), &
      command_t('check', 'check DECK', 'check DECK', 'examine a deck and its model', &
      'Reads a deck, reports every error with file and line, and examines the model: bodies, unknowns,'//nl// &
      'constraints, degrees of freedom, mechanisms, redundant constraints, condition, unused points. A remark points'//nl// &
      'out a value that no road vehicle has, with a likely cause (disable with plausible = .false. in &model).'//nl// &
      'Exit status 3 if the model cannot be solved.', ''), &
      command_t('report', 'report DECK [options]', 'report DECK', 'one page with curves, gradients and key numbers of a deck', &
      'Runs the tests of a deck and writes into DIR: report.html (one self-contained page), one CSV file per'//nl// &
      'test, gradients.csv and gradients.json (slopes with window, unit and sign), compliance.csv'//nl// &
      '(the compliance matrix at every state of the first test), picture.png and picture.svg,'//nl// &
      'and figures/ with every chart as SVG and its gnuplot script.', ''), &
      command_t('compare', 'compare A.csv B.csv …   or   elastokin compare REPORT_A REPORT_B …', 'compare A B', &
      'overlay results and list the differences', &
      'Overlays the results of one case, or two reports (folders written by report): compare.html shows all'//nl// &
      'common columns in shared charts, and a table of all gradients against those of the first result.'//nl// &
      'The table is also printed to standard output and written to differences.csv. Columns missing from one'//nl// &
      'result are listed.', ''), &
      command_t('study', 'study STUDY.nml', 'study STUDY', 'step-size convergence or a sweep of factors', &
      'Runs a study: a convergence study (kind = ''step_size'') or a sweep of one or two factors of a deck'//nl// &
      '(kind = ''sweep''). Writes CSV files into DIR (default: out, next to the study) and, if gnuplot is'//nl// &
      'installed, runs the study''s plot script there. --set changes the deck of the study.', ''), &
      command_t('bench', 'bench DECK', 'bench DECK', 'time per increment, relative to LAPACK''s solve alone', &
      'Times one complete increment of each method relative to LAPACK''s dsysv alone (factor and solve)'//nl// &
      'on the same matrices in the same run, a design of 20 increments from numbers to a column (as in a study)'//nl// &
      'relative to its states, and all steps from deck to CSV. --quiet omits the latter; --json prints one object.', '')]

   type :: option_t
      character(12) :: name
      character(10) :: value = ''          !! what follows it, in the help; '' for none
      logical :: is_repeatable = .false.
   end type option_t

   type(option_t), parameter :: options(*) = [option_t('--compliance'), option_t('--json'), option_t('--out', 'DIR'), &
      option_t('--method', 'M'), &
      option_t('--increments', 'N'), option_t('--case', 'NAME'), option_t('--set', 'path=value', .true.), option_t('--plot'), &
      option_t('--no-plots'), option_t('--animate'), option_t('--window', 'what=half', .true.), option_t('--quiet'), &
      option_t('--help'), option_t('--version')]

   !> An option that a command takes, and its line in the help of the command; '' if the line of usage suffices.
   type :: use_t
      character(7) :: command
      character(12) :: option
      character(190) :: help
   end type use_t

   ! In the order of the help; neighbours with the same help share a line
   type(use_t), parameter :: uses(*) = [ &
      use_t('run', '--out', 'output folder (default: out); - writes the CSV to standard output'), &
      use_t('run', '--case', 'run this case only'), &
      use_t('run', '--method', 'recursive | corrected | equilibrium; overrides the deck'), &
      use_t('run', '--increments', 'increments of the whole range; overrides the deck'), &
      use_t('run', '--set', 'replace a value of the deck, with the same checks; may be repeated:'//indent// &
      '--set point.lower_ball_joint.z=-105 --set "bushing.top_mount.kt(1)=500"'), &
      use_t('run', '--compliance', 'also write DIR/<model>_<case>_compliance.csv: the compliance matrix at every state'), &
      use_t('run', '--plot', 'also write gnuplot scripts, and PNG and SVG figures if gnuplot is installed'), &
      use_t('run', '--quiet', quiet_help), &
      use_t('check', '--case', ''), use_t('check', '--set', ''), &
      use_t('report', '--out', 'output folder (default: out)'), &
      use_t('report', '--animate', 'also write animation.gif: the suspension moving through its travel and steering'), &
      use_t('report', '--window', 'half width of a gradient window; may be repeated; the defaults are:'//indent// &
      'travel=15 (mm) roll=1 (deg) force=1000 (N) torque=100 (N m) rack=10 (mm) wheel=20 (deg)'), &
      use_t('report', '--case', 'run this test only'), &
      use_t('report', '--method', 'as for run'), use_t('report', '--increments', 'as for run'), &
      use_t('report', '--set', 'as for run'), &
      use_t('report', '--no-plots', no_plots_help), &
      use_t('report', '--quiet', quiet_help), &
      use_t('compare', '--out', 'output folder (default: out)'), &
      use_t('compare', '--window', 'as for report, if gradients are computed from CSV files'), &
      use_t('compare', '--no-plots', no_plots_help), &
      use_t('compare', '--quiet', quiet_help), &
      use_t('study', '--out', ''), use_t('study', '--set', ''), use_t('study', '--quiet', ''), &
      use_t('bench', '--case', ''), use_t('bench', '--increments', ''), use_t('bench', '--set', ''), &
      use_t('bench', '--json', ''), use_t('bench', '--quiet', '')]

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

   !> Help for a command; '' gives the overview.
   pure function help_text(name) result(text)
      character(*), intent(in) :: name
      character(:), allocatable :: text
      character(:), allocatable :: lines, label, shared
      type(option_t) :: option
      integer :: k, n, next

      text = 'elastokin: elastokinematics (kinematics and compliance) of vehicle suspensions'//nl//nl// &
         'usage: elastokin COMMAND FILE [options]'//nl
      do n = 1, size(commands)
         if (commands(n)%name == name) exit
         text = text//nl//'  '//commands(n)%brief//trim(commands(n)%summary)
      end do
      text = text//nl//nl//'elastokin COMMAND --help describes a command. elastokin --version prints the version.'
      if (n > size(commands)) return
      text = 'elastokin '//trim(commands(n)%usage)
      lines = ''
      shared = ''
      do k = 1, size(uses)
         if (uses(k)%command /= name) cycle
         option = options(option_number(uses(k)%option))
         label = trim(trim(option%name)//' '//option%value)
         if (uses(k)%help == '') then
            text = text//' ['//label//']'
            if (option%is_repeatable) text = text//'…'
            cycle
         end if
         shared = shared//label
         next = min(k + 1, size(uses))
         if (next > k .and. uses(next)%command == name .and. uses(next)%help == uses(k)%help) then
            shared = shared//', '
            cycle
         end if
         lines = lines//nl//'  '//shared//repeat(' ', merge(19 - len(shared), 3, len(shared) < 19))//trim(uses(k)%help)
         shared = ''
      end do
      text = text//nl//nl//trim(commands(n)%text)
      if (len(lines) > 0) text = text//nl//lines
      if (len_trim(commands(n)%ending) > 0) text = text//nl//nl//trim(commands(n)%ending)
   end function help_text

   !> The row of an option; 0 if there is none.
   pure integer function option_number(name) result(number)
      character(*), intent(in) :: name

      do number = size(options), 1, -1
         if (options(number)%name == name) return
      end do
   end function option_number

   !> 'run, check, report, compare, study or bench'
   pure function command_names() result(text)
      character(:), allocatable :: text
      integer :: k

      text = trim(commands(1)%name)
      do k = 2, size(commands) - 1
         text = text//', '//trim(commands(k)%name)
      end do
      text = text//' or '//trim(commands(size(commands))%name)
   end function command_names

end module ek_command
