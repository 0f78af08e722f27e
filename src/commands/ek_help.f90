!> The words of --help, one text a command.
module ek_help
   implicit none(type, external)
   private
   public :: help_text

   character(*), parameter :: nl = new_line('a')

contains

   !> Help for a command; '' gives the overview.
   pure function help_text(command) result(text)
      character(*), intent(in) :: command
      character(:), allocatable :: text

      select case (command)
      case ('run')
         text = 'elastokin run DECK [options]'//nl//nl// &
            'Sweeps every case of a deck and writes DIR/<model>_<case>.csv, one row a state.'//nl// &
            'DECK may be - (standard input). The paths of the files go to standard output, words to standard error.'//nl//nl// &
            '  --out DIR          where the results go (default: out); - writes the CSV to standard output'//nl// &
            '  --case NAME        this case only'//nl// &
            '  --method M         recursive | corrected | equilibrium, instead of the deck''s'//nl// &
            '  --increments N     increments of the whole range, instead of the deck''s'//nl// &
            '  --set path=value   changes a number of the deck, with the same checks; may be repeated:'//nl// &
            '                     --set point.lower_ball_joint.z=-105 --set "bushing.top_mount.kt(1)=500"'//nl// &
            '  --compliance       also DIR/<model>_<case>_compliance.csv: the compliance matrix of every state'//nl// &
            '  --plot             also gnuplot scripts, and PNG and SVG where gnuplot is installed'//nl// &
            '  --quiet            no words but warnings and errors'//nl//nl// &
            'Exit status: 0 done, 1 usage, 2 deck, 3 model (mechanism or redundant constraint),'//nl// &
            '4 a state was not found (those before it are written), 5 files.'
      case ('check')
         text = 'elastokin check DECK [--case NAME] [--set path=value]…'//nl//nl// &
            'Reads a deck, reports every mistake with file and line, and examines the model: bodies, unknowns,'//nl// &
            'constraints, degrees of freedom, mechanisms, redundant constraints, condition, unused points. A remark names'//nl// &
            'what no road vehicle has, and what it looks like (off with plausible = .false. in &model).'//nl// &
            'Exit status 3 where the model cannot be solved.'
      case ('report')
         text = 'elastokin report DECK [options]'//nl//nl// &
            'Runs the tests of a deck and writes, into DIR: report.html (one page, everything inside, nothing fetched), one'//nl// &
            'CSV a test, gradients.csv and gradients.json (slopes with window, unit and sign), compliance.csv'//nl// &
            '(the compliance matrix of every state of the first test), picture.png and picture.svg,'//nl// &
            'and figures/ with every chart as SVG and the gnuplot script that drew it.'//nl//nl// &
            '  --out DIR          where everything goes (default: out)'//nl// &
            '  --animate          also animation.gif: the suspension moving through its travel and steering'//nl// &
            '  --window what=half half width of the windows of the gradients; may be repeated; the defaults:'//nl// &
            '                     travel=15 (mm) roll=1 (deg) force=1000 (N) torque=100 (N m) rack=10 (mm) wheel=20 (deg)'//nl// &
            '  --case NAME        this test only'//nl// &
            '  --method M, --increments N, --set path=value   as for run'//nl// &
            '  --no-plots         tables only; gnuplot is not started'//nl// &
            '  --quiet            no words but warnings and errors'
      case ('compare')
         text = 'elastokin compare A.csv B.csv …   or   elastokin compare REPORT_A REPORT_B …'//nl//nl// &
            'Lays the results of one case, or two reports (folders written by report), over each other: compare.html'//nl// &
            'with all common columns drawn together, and a table of the gradients of all against those of the first,'//nl// &
            'which also goes to standard output and to differences.csv. Columns that one of them lacks are named.'//nl//nl// &
            '  --out DIR          where everything goes (default: out)'//nl// &
            '  --window what=half as for report, where gradients are made from CSV files'//nl// &
            '  --no-plots         tables only; gnuplot is not started'//nl// &
            '  --quiet            no words but warnings and errors'
      case ('study')
         text = 'elastokin study STUDY.nml [--out DIR] [--set path=value]… [--quiet]'//nl//nl// &
            'Runs a study: a convergence study (kind = ''step_size'') or a sweep of one or two factors of a deck'//nl// &
            '(kind = ''sweep''). Writes CSV files into DIR (default: out, next to the study) and, where gnuplot is'//nl// &
            'installed, runs the study''s plot script there. --set changes the deck that is studied.'
      case ('bench')
         text = 'elastokin bench DECK [--case NAME] [--increments N] [--quiet]'//nl//nl// &
            'Measures one increment of each method, everything included, in units of LAPACK''s dsysv alone'//nl// &
            '(factor and solve) on the same matrices, all in one run; and the whole way from deck to CSV.'//nl// &
            '--quiet leaves out the latter.'
      case default
         text = 'elastokin: elastokinematics (kinematics and compliance) of vehicle suspensions'//nl//nl// &
            'usage: elastokin COMMAND FILE [options]'//nl//nl// &
            '  run DECK       sweep the cases of a deck, write CSV (and plots)'//nl// &
            '  check DECK     examine a deck and its model'//nl// &
            '  report DECK    curves, gradients and key numbers of a deck as one page'//nl// &
            '  compare A B    lay results over each other and list what differs'//nl// &
            '  study STUDY    step-size convergence or a sweep of factors'//nl// &
            '  bench DECK     time per increment, as a ratio to LAPACK''s solve alone'//nl//nl// &
            'elastokin COMMAND --help tells more. elastokin --version prints the version.'
      end select
   end function help_text

end module ek_help
