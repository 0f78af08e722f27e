!> The help texts (--help), one per command.
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
            'Sweeps every case of a deck and writes DIR/<model>_<case>.csv, one row per state.'//nl// &
            'DECK may be - (standard input). File paths are printed to standard output, messages to standard error.'//nl//nl// &
            '  --out DIR          output folder (default: out); - writes the CSV to standard output'//nl// &
            '  --case NAME        run this case only'//nl// &
            '  --method M         recursive | corrected | equilibrium; overrides the deck'//nl// &
            '  --increments N     increments of the whole range; overrides the deck'//nl// &
            '  --set path=value   replace a value of the deck, with the same checks; may be repeated:'//nl// &
            '                     --set point.lower_ball_joint.z=-105 --set "bushing.top_mount.kt(1)=500"'//nl// &
            '  --compliance       also write DIR/<model>_<case>_compliance.csv: the compliance matrix at every state'//nl// &
            '  --plot             also write gnuplot scripts, and PNG and SVG figures if gnuplot is installed'//nl// &
            '  --quiet            suppress informational messages; warnings and errors remain'//nl//nl// &
            'Exit status: 0 success, 1 usage, 2 deck, 3 model (mechanism or redundant constraint),'//nl// &
            '4 a state did not converge (the converged states are written), 5 files.'
      case ('check')
         text = 'elastokin check DECK [--case NAME] [--set path=value]…'//nl//nl// &
            'Reads a deck, reports every error with file and line, and examines the model: bodies, unknowns,'//nl// &
            'constraints, degrees of freedom, mechanisms, redundant constraints, condition, unused points. A remark points'//nl// &
            'out a value that no road vehicle has, with a likely cause (disable with plausible = .false. in &model).'//nl// &
            'Exit status 3 if the model cannot be solved.'
      case ('report')
         text = 'elastokin report DECK [options]'//nl//nl// &
            'Runs the tests of a deck and writes into DIR: report.html (one self-contained page), one CSV file per'//nl// &
            'test, gradients.csv and gradients.json (slopes with window, unit and sign), compliance.csv'//nl// &
            '(the compliance matrix at every state of the first test), picture.png and picture.svg,'//nl// &
            'and figures/ with every chart as SVG and its gnuplot script.'//nl//nl// &
            '  --out DIR          output folder (default: out)'//nl// &
            '  --animate          also write animation.gif: the suspension moving through its travel and steering'//nl// &
            '  --window what=half half width of a gradient window; may be repeated; the defaults are:'//nl// &
            '                     travel=15 (mm) roll=1 (deg) force=1000 (N) torque=100 (N m) rack=10 (mm) wheel=20 (deg)'//nl// &
            '  --case NAME        run this test only'//nl// &
            '  --method M, --increments N, --set path=value   as for run'//nl// &
            '  --no-plots         tables only; gnuplot is not started'//nl// &
            '  --quiet            suppress informational messages; warnings and errors remain'
      case ('compare')
         text = 'elastokin compare A.csv B.csv …   or   elastokin compare REPORT_A REPORT_B …'//nl//nl// &
            'Overlays the results of one case, or two reports (folders written by report): compare.html shows all'//nl// &
            'common columns in shared charts, and a table of all gradients against those of the first result.'//nl// &
            'The table is also printed to standard output and written to differences.csv. Columns missing from one'//nl// &
            'result are listed.'//nl//nl// &
            '  --out DIR          output folder (default: out)'//nl// &
            '  --window what=half as for report, if gradients are computed from CSV files'//nl// &
            '  --no-plots         tables only; gnuplot is not started'//nl// &
            '  --quiet            suppress informational messages; warnings and errors remain'
      case ('study')
         text = 'elastokin study STUDY.nml [--out DIR] [--set path=value]… [--quiet]'//nl//nl// &
            'Runs a study: a convergence study (kind = ''step_size'') or a sweep of one or two factors of a deck'//nl// &
            '(kind = ''sweep''). Writes CSV files into DIR (default: out, next to the study) and, if gnuplot is'//nl// &
            'installed, runs the study''s plot script there. --set changes the deck of the study.'
      case ('bench')
         text = 'elastokin bench DECK [--case NAME] [--increments N] [--quiet]'//nl//nl// &
            'Times one complete increment of each method relative to LAPACK''s dsysv alone (factor and solve)'//nl// &
            'on the same matrices in the same run, and all steps from deck to CSV.'//nl// &
            '--quiet omits the latter.'
      case default
         text = 'elastokin: elastokinematics (kinematics and compliance) of vehicle suspensions'//nl//nl// &
            'usage: elastokin COMMAND FILE [options]'//nl//nl// &
            '  run DECK       sweep the cases of a deck; write CSV files (and plots)'//nl// &
            '  check DECK     examine a deck and its model'//nl// &
            '  report DECK    one page with curves, gradients and key numbers of a deck'//nl// &
            '  compare A B    overlay results and list the differences'//nl// &
            '  study STUDY    step-size convergence or a sweep of factors'//nl// &
            '  bench DECK     time per increment, relative to LAPACK''s solve alone'//nl//nl// &
            'elastokin COMMAND --help describes a command. elastokin --version prints the version.'
      end select
   end function help_text

end module ek_help
