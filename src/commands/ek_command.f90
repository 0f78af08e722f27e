!> The commands and their options as tables, which define the valid command lines and the output of --help.
!>
!> A new command needs its own file and, in this module, its row in `commands`, its rows in `options`, and its call in `obey`.
module ek_command
   use ek_error, only: error_t
   use ek_command_line, only: command_t, option_t, command_line_t
   use ek_option_help, only: command_help
   use ek_run, only: run
   use ek_check, only: check
   use ek_report, only: report
   use ek_compare, only: compare
   use ek_study_command, only: run_study_command, run_merge_command
   use ek_plot, only: run_plot_command
   use ek_derivatives_command, only: derive
   use ek_solve_command, only: solve_for
   use ek_fit_command, only: run_fit
   use ek_import, only: import
   use ek_export, only: export, target_words, target_help
   use ek_explain, only: explain
   use ek_schema, only: print_schema
   use ek_list, only: list_names
   use ek_new, only: print_new_deck
   implicit none(type, external)
   private
   public :: commands, options, exit_status_text, help_text, obey

   character(*), parameter :: nl = new_line('a'), indent = nl//repeat(' ', 21)
   character(*), parameter :: quiet_help = 'suppress informational messages; warnings and errors remain'
   character(*), parameter :: no_plots_help = 'tables only; gnuplot is not started'

   character(*), parameter :: exit_status_text = &
      'Exit status: 0 success, 1 usage, 2 deck, 3 model (mechanism or redundant constraint),'//nl// &
      '4 a state did not converge (the converged states are written), 5 files,'//nl// &
      '6 a study was stopped (run the same command again to resume), 7 a number is outside (--fail-outside).'

   type(command_t), parameter :: commands(*) = [ &
      command_t('run', 'run DECK [options]', 'run DECK', 'sweep the cases of a deck; write CSV files (and plots)', &
      'Sweeps every case of a deck and writes DIR/<model>_<case>.csv, one row per state.'//nl// &
      'DECK may be - (standard input). File paths are printed to standard output, messages to standard error.', &
      exit_status_text), &
      command_t('check', 'check DECK', 'check DECK', 'examine a deck and its model', &
      'Reads a deck, reports every error with file and line, and examines the model: bodies, unknowns,'//nl// &
      'constraints, degrees of freedom, mechanisms, redundant constraints, reciprocal condition number,'//nl// &
      'unused points.'//nl// &
      'A remark reports a value outside the range of road vehicles and a likely cause (plausible = .false. in &model'//nl// &
      'disables these remarks). The last line is OK, or gives the counts of errors, warnings and remarks and the'//nl// &
      'most severe of these messages. The exit status is 3 if the model cannot be solved.', ''), &
      command_t('report', 'report DECK [options]', 'report DECK', 'write a report page: curves, gradients, K&C metrics', &
      'Runs the tests of a deck and writes into DIR:'//nl// &
      '  report.html: one self-contained page;'//nl// &
      '  one CSV file per test, and compliance.csv: the compliance matrix at every state of the first test;'//nl// &
      '  key_numbers.csv and .json; gradients.csv and .json: slopes with window, unit and sign;'//nl// &
      '  windows/: the states of each test from which the slopes were read;'//nl// &
      '  picture.png and .svg; figures/: every chart (SVG and gnuplot script), views.svg with hardpoint names;'//nl// &
      '  deck.csv: every parameter of the deck; deck_as_used.nml: one deck with the same results;'//nl// &
      '  report-files.csv: list of all files of the report.', ''), &
      command_t('loads', 'loads DECK [options]', 'loads DECK', 'write the loads on every part in load cases, for FEA', &
      'Solves the manoeuvres of a deck (&manoeuvre), and its load tables with a column `name`. Writes into DIR:'//nl// &
      '  <model>_<case>.csv: the results, one row per manoeuvre;'//nl// &
      '  parts/<part>.csv: all forces and moments on each part, which are in equilibrium, with weight and inertia;'//nl// &
      '  load-envelope.csv: smallest and largest value of each load, with the names of the manoeuvres;'//nl// &
      '  loads.csv and peak-loads.csv, as run --loads; loads.json: the loads on all parts and in all rods.', exit_status_text), &
      command_t('explain', 'explain DECK [options]', 'explain DECK', 'list contributions to each compliance, and load paths', &
      'Splits each column that is linear in the compliance matrix into exact contributions, at every state.'//nl// &
      'Contributions come from each axis of a bushing, each spring, bar, stop and preload, and each driver with a'//nl// &
      'stiffness. Prints the ten largest contributions at design. Writes into DIR:'//nl// &
      '<model>_<case>_contributions.csv, and <model>_<case>_load_paths.csv (force and moment in every element and joint'//nl// &
      'per newton at a contact point, with shares of strain energy).', exit_status_text), &
      command_t('compare', 'compare A.csv B.csv …   or   elastokin compare REPORT_A REPORT_B …', 'compare A B', &
      'overlay results and list the differences', &
      'Compares reports (folders written by report), or results of one case. compare.html lists the changes of the'//nl// &
      'deck, and the K&C metrics and gradients sorted by change. The charts contain the curves of all results.'//nl// &
      'The gradients are printed to standard output, and the ten largest changes to standard error.'//nl// &
      'Also writes tables with the columns change and verdict (changed, same, only in A, only in B,'//nl// &
      'not a number): differences.csv, number-differences.csv, curve-differences.csv, deck-differences.csv.'//nl// &
      'With --measured, compares decks with measured curves: compare DECK … --measured test=FILE --map FILE'//nl// &
      'prints rms, largest deviation, slopes and loops, and writes measured-differences.csv.', '', 2, '--measured'), &
      command_t('study', 'study STUDY.nml [options]', 'study STUDY', 'run many designs of a deck, or study step-size convergence', &
      'Runs the designs of a study. Writes CSV files and the page (as described for plot) into DIR. If gnuplot is'//nl// &
      'installed, draws the figures and runs the plot script of the study. DIR/<study>.parts stores the finished'//nl// &
      'designs: if the study was stopped or killed, run the same command again to resume.', &
      'Exit status 4: the study is complete, but a design failed (0 with --accept-failed). The columns status and'//nl// &
      'reason list failures. 6: the study was stopped; run the same command again to resume.'), &
      command_t('merge', 'merge STUDY.nml', 'merge STUDY', 'write the tables of a study that ran in shards', &
      'After all shards of a study (study --shard i/n) have ended, writes the tables of the study from DIR/<study>.parts.', &
      'Exit status 4: the study is complete, but a design failed (0 with --accept-failed). 6: designs are missing.'), &
      command_t('plot', 'plot STUDY.nml [options]', 'plot STUDY', 'draw figures and page of a finished study', &
      'Reads the tables of a finished study in DIR and solves nothing. Writes DIR/<study>.html (one self-contained'//nl// &
      'page with statistics, figures, best and worst designs) and DIR/figures: every figure as PNG, SVG and gnuplot script.'//nl// &
      'The kind, the columns and the responses of the study determine the figures.', ''), &
      command_t('import', 'import FILE … [options]', 'import FILE', 'convert tables of points or foreign files to a deck', &
      'Converts files of other programs to a deck:'//nl// &
      '  .kin files of IPGKinematics to a complete axle (with the .gum bushings in the same folder);'//nl// &
      '  hardpoints (CSV, JSON, TOML), a Chrono suspension (.json) or a Lotus model (.shk, .sdf) to a deck of points and'//nl// &
      '  links, if the points are those of a double wishbone, McPherson, five-link or trailing arm axle;'//nl// &
      '  .sub and .asy hardpoints to points;'//nl// &
      '  .bus, .spr, .bum, .reb and .gum property files to curves;'//nl// &
      '  .lcf load cases to a load table.'//nl// &
      'Every error in the files is reported with file and line.', '', 0), &
      command_t('export', 'export DECK --to TARGET [options]', 'export DECK', &
      'write kinematics and compliance for other simulators', &
      'Writes the axle of a deck in the format of a simulator into DIR:'//nl// &
      target_help//nl// &
      'docs/EXPORT.md describes frame, signs and units of each file. If a number cannot be computed, no file is written.', ''), &
      command_t('derivatives', 'derivatives DECK [options]', 'derivatives DECK', &
      'differentiate columns with respect to parameters of a deck', &
      'Solves one case and writes DIR/<model>_<case>_derivatives.csv: the derivative of every column with respect to every'//nl// &
      'parameter of the deck, in the unit of the column per unit of the number, and an estimate of the error. The error is'//nl// &
      'at most about 1e-7 of the largest derivative of the column, and large where a column has a corner. No solution is'//nl// &
      'repeated. Derivatives account for the change of the state, of the static equilibrium and of the trimmed preloads'//nl// &
      '(balance). A number of a mirrored half deck acts on both sides; the name point.left_lca_front.z selects one side.'//nl// &
      'With --of, the ten numbers with the largest effects on each column are printed. An effect is the change of a column'//nl// &
      'caused by 1 mm, 0.06 deg, or 1 % of a rate or force.', &
      exit_status_text), &
      command_t('solve', 'solve DECK [options]', 'solve DECK', 'find parameters of a deck that give requested values', &
      'Changes the numbers of --vary within their bounds until the quantities of --for have the requested values.'//nl// &
      'A quantity is a column of a case, an entry of its compliance matrix, or a K&C metric of the report. Derivatives are'// &
      nl//'exact, so Newton''s method needs only a few sweeps. Prints the values reached, the changed records, and the reason'// &
      nl//'for each value that was not reached. Writes DIR/<model>_solve.set for --set-file. If there are several solutions,'// &
      nl//'the solution with the smallest change found from this start is used.', &
      exit_status_text), &
      command_t('fit', 'fit FIT.nml [options]', 'fit FIT', 'fit factors of a deck to measured or required curves', &
      'Finds the factors of a deck, within their bounds, by weighted least squares. Targets are curves, slopes, K&C metrics'//nl// &
      'and limits of several cases. Examples: hardpoints for a required curve, bushing rates from a measured curve.'//nl// &
      'Prints and draws the start, the target and the result. Also prints the 95 % confidence interval of each factor,'//nl// &
      'the factors at a bound, and the undetermined factors. Writes DIR/<fit>_factors.csv, <fit>_points.csv, <fit>.set'//nl// &
      'for --set-file, and the figure <fit>.png and .svg.', &
      exit_status_text), &
      command_t('list', 'list DECK [options]', 'list DECK', 'list paths of numbers, cases and K&C metrics of a deck', &
      'Prints the names that other commands accept for a deck. Nothing is solved.'//nl// &
      '  parameters of the deck: path, value and unit; for settings, factors, derivatives and solve;'//nl// &
      '  cases and standard tests: name, kind, swept value, range, unit and increments;'//nl// &
      '  K&C metrics: name, unit and definition; for responses, fit and solve.'//nl// &
      'In a mirrored deck, a path without a side is the number of both sides. If only one of the lists is requested, it'//nl// &
      'is printed without a heading, and its first column contains the names alone.'//nl// &
      '--definitions lists the quantities of another program instead, for any deck: name, unit, sign, formula of columns'// &
      nl//'of elastokin, and how they differ.', '', alone='--definitions'), &
      command_t('new', 'new [KIND]', 'new [KIND]', 'print a commented deck of the library as a start', &
      'Prints a deck of the library to standard output: elastokin new mcpherson > front.nml. The deck is one file and gives'// &
      nl//'the parameters of the deck of the library. Without KIND, lists the kinds with one line each. KIND is'//nl// &
      'double_wishbone | mcpherson | mcpherson_split_link | five_link | integral_link | semi_trailing | trailing_arm |'//nl// &
      'twist_beam | solid | push_rod.', '', -2), &
      command_t('schema', 'schema', 'schema', 'print all keys of a deck as JSON Schema', &
      'Prints a JSON Schema (version 2020-12) of a deck as data: an object with a list of records for each group, and one'//nl// &
      'record for model, mirror, axle and steering. For each key, the schema gives type, number of values, range,'//nl// &
      'accepted strings, default, unit (x-unit) and meaning. Editors and scripts can complete and check a deck with it.'//nl// &
      'x-unit is a product of the units that model selects (length, force, angle, mass), or a fixed unit. deflection and'//nl// &
      'reaction are length and force, or angle and moment, of the measure, driver or element that the record names;'//nl// &
      'swept is the swept value of a case. The schema does not cover rules between keys; `elastokin check` covers all.', '', -1)]

   character(*), parameter :: program_words = 'adams | motionview | ipg | optimumk | lotus | mathworks | sae'    ! `programs` of ek_definition_rows

   ! In the order of the help; neighbours with the same help share a line
   type(option_t), parameter :: options(*) = [ &
      option_t('run', '--out DIR', 'output folder (default: out); --out - writes the CSV to standard output'), &
      option_t('run', '--case NAME', 'run only this case or standard test'), &
      option_t('run', '--method M', 'recursive | corrected | equilibrium; overrides the deck'), &
      option_t('run', '--solver S', 'lapack | sparse (faster; alias: plan); overrides the deck'), &
      option_t('run', '--increments N', 'number of increments over the range; overrides the deck'), &
      option_t('run', '--set path=value', &
      'change a parameter of the deck; the new value is checked as in the deck; may be repeated:'//indent// &
      '--set point.lower_ball_joint.z=-105 --set "bushing.top_mount.kt(1)=500"'), &
      option_t('run', '--set-file FILE', 'read settings from a file, one per line: path = value'), &
      option_t('run', '--height H', 'start all tests H above design height, in the unit of the deck (model.start_height)'), &
      option_t('run', '--state NAME', 'start all tests in this &load_state of the deck (model.state)'), &
      option_t('run', '--responses a,b', &
      'write only these K&C metrics of the report (names as in key_numbers.csv), and no other files'), &
      option_t('run', '--results FILE', &
      'file for --responses, with one line `value name` per number (default: -, standard output)'), &
      option_t('run', '--columns a,b,c', &
      'write only these columns; * stands for any letters;'//indent// &
      'state, factor and the columns on convergence are always written'), &
      option_t('run', '--definitions NAME', &
      'columns in the definitions, signs, units and names of another program:'//indent// &
      program_words), &
      option_t('run', '--json', 'also write DIR/<model>_run.json: tables, messages and status;'//indent// &
      'with "--out -", print only this JSON object'), &
      option_t('run', '--compliance', 'also write DIR/<model>_<case>_compliance.csv: the compliance matrix at every state'), &
      option_t('run', '--loads', &
      'also write loads.csv (loads of every member at every state) and peak-loads.csv, for all cases;'//indent// &
      'of states with names (manoeuvres) also the files of the command loads'), &
      option_t('run', '--plot', 'also write gnuplot scripts, and PNG and SVG figures if gnuplot is installed'), &
      option_t('run', '--quiet', quiet_help), &
      option_t('loads', '--out DIR', 'output folder (default: out)'), &
      option_t('loads', '--case NAME', 'solve only this case; without names of states, no parts, envelope and JSON'), &
      option_t('loads', '--solver S', 'as for run'), &
      option_t('loads', '--set path=value', 'as for run'), option_t('loads', '--set-file FILE', 'as for run'), &
      option_t('loads', '--height H', 'as for run'), option_t('loads', '--state NAME', 'as for run'), &
      option_t('loads', '--json', 'as for run'), option_t('loads', '--quiet', quiet_help), &
      option_t('check', '--case NAME', 'check only this case or standard test'), &
      option_t('check', '--set path=value', 'as for run'), &
      option_t('check', '--set-file FILE', 'as for run'), &
      option_t('check', '--height H', 'as for run'), option_t('check', '--state NAME', 'as for run'), &
      option_t('check', '--json', 'print the messages as one JSON object: severity, file, line, group, key, text'), &
      option_t('check', '--write-deck FILE', &
      'write to FILE the deck as it was used, with the contents of included, property and'// &
      indent//'hardpoint files, both sides and all settings; load tables are copied to the folder of FILE'), &
      option_t('check', '--quiet', 'print only warnings, remarks and the last line'), &
      option_t('report', '--out DIR', 'output folder (default: out)'), &
      option_t('report', '--animate', 'also write animation.gif: the suspension moving through its travel and steering'), &
      option_t('report', '--window what=half', 'half width of a gradient window; may be repeated; the defaults are:'//indent// &
      'travel=15 (mm) roll=1 (deg) force=1000 (N) torque=100 (N m) rack=10 (mm) wheel=20 (deg)'), &
      option_t('report', '--case NAME', 'run only this case or standard test'), &
      option_t('report', '--method M', 'as for run'), option_t('report', '--solver S', 'as for run'), &
      option_t('report', '--increments N', 'as for run'), &
      option_t('report', '--set path=value', 'as for run'), option_t('report', '--set-file FILE', 'as for run'), &
      option_t('report', '--height H', 'as for run'), option_t('report', '--state NAME', 'as for run'), &
      option_t('report', '--definitions NAME', &
      'also write numbers and tables in the definitions of another program:'//indent// &
      program_words), &
      option_t('report', '--loads', &
      'also write loads.csv (loads of every member at every state of every test) and peak-loads.csv'), &
      option_t('report', '--no-plots', 'without the picture in space; gnuplot is not started'), &
      option_t('report', '--plots', 'also draw the charts, views and carpets of the page as files in figures/, by gnuplot'), &
      option_t('report', '--scales DIR', 'draw the charts with the axes of the report in DIR, for comparison'), &
      option_t('report', '--measured test=FILE', 'compare measured curves (CSV) with this test; may be repeated; needs --map'), &
      option_t('report', '--map FILE', 'the meaning of the headings of --measured: &channel groups'), &
      option_t('report', '--static', 'write a page without scripts; its charts are pictures drawn by gnuplot'), &
      option_t('report', '--live N', &
      'add sliders for the N rates (1 to 24) that contribute most to the compliances;'// &
      indent//'the sliders change numbers and curves that are linear in the compliance matrix; not with --static'), &
      option_t('report', '--fail-outside', 'return exit status 7 if a number is outside its target or usual range'), &
      option_t('report', '--quiet', quiet_help), &
      option_t('explain', '--out DIR', 'output folder (default: out)'), &
      option_t('explain', '--case NAME', 'explain only this case or standard test'), &
      option_t('explain', '--of a,b,c', &
      'explain only these columns: responses to loads (lateral_in_load_held_steer_deg_per_kn), or'// &
      indent//'matrix entries (patch_z_by_fz_mm_per_kn); * stands for any letters; default: key columns'), &
      option_t('explain', '--at VALUE', 'explain only the state nearest to this swept value'//indent// &
      '(default: all states; the contributions at the design state are printed)'), &
      option_t('explain', '--rigid NAME', 'print the columns for a rigid element (arm_front), or for an element with'// &
      indent//'one rigid axis (arm_front.x); may be repeated'), &
      option_t('explain', '--scan', 'print the locations at which an added stiffness of 1 kN/mm changes the columns most'), &
      option_t('explain', '--json', 'also write DIR/<model>_contributions.json'), &
      option_t('explain', '--increments N', 'as for run'), option_t('explain', '--solver S', 'as for run'), &
      option_t('explain', '--set path=value', 'as for run'), option_t('explain', '--set-file FILE', 'as for run'), &
      option_t('explain', '--height H', 'as for run'), option_t('explain', '--state NAME', 'as for run'), &
      option_t('explain', '--quiet', quiet_help), &
      option_t('solve', '--vary path=lo:hi', 'a number that may change, and its bounds; may be repeated:'//indent// &
      '--vary point.tie_rod_inner.z=-80:-50'), &
      option_t('solve', '--for name=value', 'a quantity and its requested value: --for left_bump_steer=0; with'// &
      indent//'case and swept value: --for "roll:left_camber_deg@2=-1.5"; =keep: the present value; may be repeated'), &
      option_t('solve', '--weight name=size', 'deviation that counts as 1 if not all conditions can be met'//indent// &
      '(default: half the width of its &target_band, otherwise a noticeable change);'//indent//'may be repeated'), &
      option_t('solve', '--case NAME', 'case or standard test of the columns (default: the first case of the deck)'), &
      option_t('solve', '--at VALUE', 'swept value at which columns are read (default: design)'), &
      option_t('solve', '--out DIR', 'output folder (default: out)'), &
      option_t('solve', '--page', 'also write DIR/<model>_solve.html: before and after, contributions, what moved'), &
      option_t('solve', '--set path=value', 'as for run'), option_t('solve', '--set-file FILE', 'as for run'), &
      option_t('solve', '--height H', 'as for run'), option_t('solve', '--state NAME', 'as for run'), &
      option_t('solve', '--quiet', quiet_help), &
      option_t('fit', '--out DIR', 'output folder (default: out, in the folder of the fit file)'), &
      option_t('fit', '--set path=value', 'change a parameter of the deck of the fit'), &
      option_t('fit', '--height H', 'as for run'), option_t('fit', '--state NAME', 'as for run'), &
      option_t('fit', '--page', 'also write DIR/<fit>.html: targets, curves, intervals, contributions, what moved'), &
      option_t('fit', '--no-plots', no_plots_help), option_t('fit', '--quiet', quiet_help), &
      option_t('compare', '--out DIR', 'output folder (default: out)'), &
      option_t('compare', '--definitions NAME', &
      'of reports, compare tables and numbers at design in the definitions of another program (report --definitions):'//indent// &
      program_words), &
      option_t('compare', '--window what=half', 'as for report, if gradients are computed from CSV files'), &
      option_t('compare', '--threshold P%', &
      'smallest change that is listed, as a percentage of the value in A or of the least span of a chart;'//indent// &
      'default: 1%; without it, standard output also lists gradients that changed less'), &
      option_t('compare', '--no-plots', 'with --static: a page without charts; gnuplot is not started'), &
      option_t('compare', '--plots', 'also draw the charts of the page as files in figures/, by gnuplot'), &
      option_t('compare', '--static', 'as for report'), &
      option_t('compare', '--measured test=FILE', 'as for report, with decks instead of results'), &
      option_t('compare', '--map FILE', 'as for report'), &
      option_t('compare', '--json', 'with --measured: print one JSON object (schema/compare.schema.json)'), &
      option_t('compare', '--quiet', quiet_help), &
      option_t('study', '--out DIR', 'output folder (default: out, in the folder of the study file)'), &
      option_t('study', '--jobs N', 'number of threads (default: one per processor, at most OMP_NUM_THREADS and'//indent// &
      'SLURM_CPUS_PER_TASK; under mpirun one per process)'), &
      option_t('study', '--samples N', 'number of designs, instead of `samples` of the study; for a trial run'), &
      option_t('study', '--shard i/n', 'run only part i of n of the designs, for a job array; run elastokin merge afterwards'), &
      option_t('study', '--time-limit TIME', 'stop before this time has passed: seconds or [hours:]minutes:seconds'), &
      option_t('study', '--status', 'print the progress of the study and exit'), &
      option_t('study', '--accept-failed', 'return exit status 0 even if designs failed'), &
      option_t('study', '--set path=value', 'change a parameter of the deck of the study'), &
      option_t('study', '--height H', 'as for run'), option_t('study', '--state NAME', 'as for run'), &
      option_t('study', '--quiet', quiet_help), &
      option_t('study', '--no-plots', no_plots_help), &
      option_t('merge', '--out DIR', ''), option_t('merge', '--samples N', ''), option_t('merge', '--accept-failed', ''), &
      option_t('merge', '--set path=value', ''), &
      option_t('merge', '--height H', ''), option_t('merge', '--state NAME', ''), &
      option_t('merge', '--no-plots', ''), option_t('merge', '--quiet', ''), &
      option_t('plot', '--kind NAME', &
      'draw only this figure; may be repeated: tornado | sobol | morris | line | map | carpet |'//indent// &
      'fan | family | histogram | scatter | parallel | convergence'), &
      option_t('plot', '--out DIR', 'folder of the tables (default: out, in the folder of the study file)'), &
      option_t('plot', '--samples N', 'number of designs, as in the run of the study'), &
      option_t('plot', '--set path=value', 'change a parameter of the deck, as in the run of the study'), &
      option_t('plot', '--height H', 'as for run'), option_t('plot', '--state NAME', 'as for run'), &
      option_t('plot', '--quiet', quiet_help), &
      option_t('export', '--to TARGET', target_words), &
      option_t('export', '--out DIR', 'output folder (default: out)'), &
      option_t('export', '--travel from:to:n', &
      'wheel travel in mm with n points (default: range of test parallel_travel, 33 points)'), &
      option_t('export', '--steer from:to:n', 'travel of the steering driver in mm, positive: wheels to the left, with n points'// &
      indent//'(default: range of test steering, 17 points)'), &
      option_t('export', '--map KIND', &
      'second argument of the maps in addition to travel: steer | opposite (travel of the other wheel);'// &
      indent//'default: steer if the deck has &steering, else opposite for carmaker and csv'), &
      option_t('export', '--driver NAME', 'driver joint that steers (default: driver of &steering)'), &
      option_t('export', '--length what=NAME', &
      'element used as the spring, damper, stop or bar of a wheel, if the deck has several;'// &
      indent//'NAME is without left_ and right_, or is LEFT,RIGHT; may be repeated: --length spring=coil'), &
      option_t('export', '--vertical WORD', 'point whose height defines wheel travel: centre | patch | road (default: patch)'), &
      option_t('export', '--held WORD', &
      'wheels for compliance: on tyre rates (road), with height (centre) or vertical force (force) held:'// &
      indent//'road | centre | force (default: road if every wheel has a tyre_rate, else centre)'), &
      option_t('export', '--axle WORD', 'front | rear (default: position of &axle)'), &
      option_t('export', '--other DECK', 'deck of the other axle, for matlab-kc'), &
      option_t('export', '--definitions NAME', &
      'of target csv: also write <model>_definitions.csv, kinematics in the definitions of another program:'//indent// &
      program_words), &
      option_t('export', '--signs WORD', 'signs of target csv: iso | sae (default: iso)'), &
      option_t('export', '--loads F:M:n', &
      'largest force [N], largest moment [N m] and n points of target csv (default: 2000:100:21)'), &
      option_t('export', '--plot', 'also draw the written tables together with separately solved curves, for comparison'), &
      option_t('export', '--set path=value', 'as for run'), &
      option_t('export', '--height H', 'as for run'), option_t('export', '--state NAME', 'as for run'), &
      option_t('export', '--quiet', quiet_help), &
      option_t('import', '--out FILE', 'write this file (default: -, standard output)'), &
      option_t('import', '--axes WORD', &
      'directions of the columns x, y, z of a table: iso | x-rear | sae (or spelled out, as rear,right,up);'//indent// &
      'default: decided by the points, or rejected'), &
      option_t('import', '--length WORD', 'unit of length of a table: mm | cm | m | in | ft'), &
      option_t('import', '--datum WORD', &
      'road, if a table has no contact point: ground (height 0), a height, or radius:R (loaded radius)'), &
      option_t('import', '--axle WORD', 'axle of a table, if the table has both, or tie rods and no axle: front | rear'), &
      option_t('import', '--side WORD', 'mirror this side, if the sides of a table differ: left | right'), &
      option_t('import', '--quiet', quiet_help), &
      option_t('derivatives', '--case NAME', 'case or standard test (default: the first case of the deck)'), &
      option_t('derivatives', '--of a,b,c', 'write only these columns of the case or of the compliance matrix (names as in'// &
      indent//'run --compliance); * stands for any letters'), &
      option_t('derivatives', '--definitions NAME', &
      'columns in the definitions of another program, which --of then names; as for run:'//indent// &
      program_words), &
      option_t('derivatives', '--with paths', 'write only derivatives with respect to these numbers, as in --set:'//indent// &
      'point.lca_front.z,bushing.*.kt; may be repeated'), &
      option_t('derivatives', '--at a,b,c', &
      'write only the states nearest to these swept values; all: every state'//indent//'(default: 0, the design state)'), &
      option_t('derivatives', '--out DIR', 'output folder (default: out); --out - writes the CSV to standard output'), &
      option_t('derivatives', '--set path=value', 'as for run'), option_t('derivatives', '--set-file FILE', 'as for run'), &
      option_t('derivatives', '--height H', 'as for run'), option_t('derivatives', '--state NAME', 'as for run'), &
      option_t('derivatives', '--quiet', quiet_help), &
      option_t('new', '--points-only', 'print points and links only: no springs, joints instead of bushings'), &
      option_t('list', '--paths', 'print the parameters of the deck'), &
      option_t('list', '--cases', 'print the cases and standard tests'), &
      option_t('list', '--numbers', 'print the K&C metrics'), &
      option_t('list', '--definitions NAME', 'print the definitions of a program; a deck is not necessary:'//indent// &
      program_words), &
      option_t('list', '--like PATTERN', 'print only names that match; * stands for any letters: --like "bushing.*"'), &
      option_t('list', '--json', 'print one JSON object (schema/list.schema.json, definitions.schema.json)'), &
      option_t('list', '--set path=value', 'as for run'), option_t('list', '--set-file FILE', 'as for run'), &
      option_t('list', '--height H', 'as for run'), option_t('list', '--state NAME', 'as for run'), &
      ! of every command
      option_t('', '--log FILE', 'append a record of this run (one line of JSON: arguments, messages, results, exit status)'), &
      option_t('', '--help', 'print this description'), &
      option_t('', '--version', 'print the version, the compiler and the libraries in use'), &
      option_t('', '--help-files DIR', '')]      ! for the build: man pages and completion (ek_help_files)

contains

   !> Runs the command of a command line.
   subroutine obey(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error

      select case (line%command)
      case ('run', 'loads')
         call run(line, error)
      case ('check')
         call check(line, error)
      case ('report')
         call report(line, error)
      case ('explain')
         call explain(line, error)
      case ('compare')
         call compare(line, error)
      case ('study')
         call run_study_command(line, error)
      case ('merge')
         call run_merge_command(line, error)
      case ('plot')
         call run_plot_command(line, error)
      case ('import')
         call import(line, error)
      case ('export')
         call export(line, error)
      case ('derivatives')
         call derive(line, error)
      case ('solve')
         call solve_for(line, error)
      case ('fit')
         call run_fit(line, error)
      case ('schema')
         call print_schema(error)
      case ('list')
         call list_names(line, error)
      case ('new')
         call print_new_deck(line, error)
      end select
   end subroutine obey

   !> Help for a command; the overview for '' or an unknown name.
   pure function help_text(name) result(text)
      character(*), intent(in) :: name
      character(:), allocatable :: text
      integer :: k, n

      n = findloc(commands%name == name, .true., dim=1)
      if (n == 0) then
         text = 'elastokin: elastokinematics (kinematics and compliance) of vehicle suspensions'//nl//nl// &
            'usage: elastokin COMMAND FILE [options]'//nl
         do k = 1, size(commands)
            text = text//nl//'  '//commands(k)%brief//trim(commands(k)%summary)
         end do
         text = text//nl//nl//'elastokin COMMAND --help, or elastokin help COMMAND, describes a command. '// &
            'elastokin --version prints the version.'
         return
      end if
      text = command_help(commands, options, n)
   end function help_text

end module ek_command
