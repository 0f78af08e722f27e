!> elastokin report: runs the tests of a deck, and writes gradients, charts and pictures as one page and its files.
module ek_report
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_convergence, exit_outside
   use ek_text, only: str, plural
   use ek_version, only: version
   use ek_clock, only: date_text
   use ek_file, only: make_folder, join_path
   use ek_system, only: working_folder
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, default_tolerance
   use ek_workspace, only: workspace_t, balance_or_explain
   use ek_reader, only: definition_t
   use ek_examination, only: examination_t
   use ek_standard_tests, only: standard_tests
   use ek_table, only: table_t, stop_t, csv_text
   use ek_table_reading, only: states_of_windows
   use ek_test_charts, only: test_charts
   use ek_grid_figures, only: envelope_text
   use ek_chart, only: chart_t
   use ek_scales, only: read_scales, take_scales
   use ek_gradient, only: test_gradients, gradient_windows, gradients_csv, gradients_json
   use ek_report_files, only: contents_csv, name_files
   use ek_report_names, only: contents_file, gradients_file, gradients_json_file, compliance_file, numbers_file, &
      numbers_json_file, deck_file, used_deck_file, data_file, page_file, loads_file, peaks_file, list_file, files_of_reports, &
      files_of_loads, windows_folder, measured_file, definitions_folder, definitions_file, definitions_json_file, &
      files_of_definitions
   use ek_deck_file, only: deck_csv
   use ek_deck, only: deck_t
   use ek_deck_values, only: list_values
   use ek_deck_writer, only: write_deck_as_used
   use ek_planned_test, only: planned_tests
   use ek_key_numbers, only: key_numbers, stop_at_numbers
   use ek_number_names, only: plan_tables
   use ek_key_number_table, only: key_numbers_csv, key_numbers_json
   use ek_assessment, only: axle_kind_t
   use ek_report_test, only: run_planned
   use ek_report_content, only: report_t, add_fact
   use ek_report_data, only: report_data
   use ek_report_measured, only: read_measured, put_measured
   use ek_report_page, only: report_page
   use ek_verdict, only: verdict_t, verdict_lines, plain
   use ek_usual_range, only: outside
   use ek_report_pictures, only: draw_pictures, find_figures
   use ek_explanation, only: explanation_t
   use ek_live_reruns, only: measure_reruns
   use ek_turntable, only: make_turntable
   use ek_gradient_definition, only: windows_t
   use ek_model_remark, only: model_remarks_t, find_model_remarks
   use ek_command_line, only: command_line_t, refuse_stream, read_windows
   use ek_number_targets, only: set_targets
   use ek_load_deck, only: deck_settings_t, read_deck_settings, load_deck, chosen_cases, examine_chosen
   use ek_console, only: print_note, print_marked, print_error, print_model_remarks
   use ek_kinds, only: wp, millimetre
   use ek_defined_numbers, only: defined_numbers_t, defined_csv, defined_json
   use ek_definition, only: check_program
   use ek_member_loads, only: begin_loads, peak_loads
   use ek_part_record, only: has_names, begin_parts
   use ek_part_files, only: put_parts, remove_parts
   use ek_listed_files, only: renew_file_list
   use ek_outbox, only: outbox_t, outbox_in
   use ek_load_state, only: start_text
   use ek_rig, only: counts_from_start
   use ek_test_result, only: test_result_t
   implicit none(type, external)
   private
   public :: report

   integer, parameter :: most_live = 24      ! rates: more make the page slow and large

   type, extends(deck_settings_t) :: settings_t
      type(windows_t) :: windows                     !! windows of the gradients
      logical :: has_plots = .true., has_figures = .false., is_animated = .false., is_static = .false., has_loads = .false.
      logical :: fails_outside = .false.             !! a number outside its range is a failure
      integer :: live = 0                            !! number of rates that the page can change; 0: no sliders
   end type settings_t

contains

   !> Runs the tests of a deck and writes all files. If a test fails part way, its converged states are written. `error` then has
   !> the code exit_convergence at the end, or the code of a test that could not be run.
   subroutine report(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(settings_t) :: settings
      class(report_t), allocatable :: page
      class(workspace_t), allocatable :: workspace
      type(definition_t), target :: definition
      type(deck_t) :: deck
      type(case_t), allocatable :: cases(:), chosen(:)                  ! with the tests; those of this report
      type(examination_t) :: found
      type(model_remarks_t) :: remarks
      type(chart_t), allocatable :: scales(:)                           ! of another report
      type(error_t), allocatable :: incomplete, unmapped
      type(outbox_t) :: box
      character(:), allocatable :: checksum
      integer :: k

      allocate (page)
      call read_settings(line, settings, error)
      if (.not. allocated(error) .and. line%has('--scales')) &
         call read_scales(line%value('--scales'), settings%windows, scales, error)
      if (.not. allocated(error)) call load_deck(settings, definition, workspace, checksum, error, used_deck=deck)
      if (allocated(error)) return
      cases = workspace%deck_cases                        ! of a model without a wheel
      if (size(workspace%raw%wheels) > 0) call standard_tests(workspace%raw, workspace%deck_cases, cases, settings%case)
      call chosen_cases(settings, workspace%raw, cases, chosen, error)
      if (.not. allocated(error)) call examine_chosen(settings%file, workspace%raw, chosen, found, error)
      if (allocated(error)) return
      call begin_content(settings, workspace%raw, deck, page, error)
      if (.not. allocated(error)) call balance_or_explain(default_tolerance, workspace, error)
      if (allocated(error)) return
      box = outbox_in(page%folder)
      call planned_tests(workspace%suspension, chosen, page%tests)
      call name_files(page%tests)
      call stop_at_windows(settings%windows, page%tests, chosen)
      call read_measured(line, workspace%suspension, page%tests, chosen, page%measured, error)
      if (allocated(error)) return
      call find_model_remarks(workspace%suspension, workspace%raw, workspace%deck_cases, chosen, .true., remarks)
      call print_model_remarks(settings%is_quiet, remarks, page%warnings)
      if (any([(counts_from_start(chosen(k)), k=1, size(chosen))])) page%start = start_text(workspace%suspension)
      call box%remove([character(19) :: page_file, contents_file, compliance_file, deck_file, used_deck_file, measured_file, &
         files_of_loads, files_of_definitions])
      call remove_parts(workspace%suspension, page%folder)

      call begin_records(settings, line%value('--definitions'), workspace%suspension, chosen, checksum, page)
      call run_tests(settings%windows, workspace%suspension, chosen, found, checksum, page, box, incomplete)
      call put_loads(workspace%suspension, page, box)
      call box%take(error)
      if (allocated(error)) return
      if (allocated(page%live)) then
         if (.not. allocated(page%live%rates)) call page%warnings%add('--live: no rate can be changed on the page: no test has '// &
            'a design state at which a bushing, spring or bar with a constant rate contributes to a key compliance')
      end if
      if (allocated(page%measured)) call put_measured(page%tests, page%measured, page%warnings, box, unmapped)
      if (allocated(scales)) call take_scales(scales, page%charts)
      call put_numbers(workspace, checksum, page, box)
      call box%take(error)
      if (allocated(error)) return
      if (allocated(page%live)) call measure_reruns(workspace, chosen, page%tests, page%numbers, page%live)
      if (.not. page%is_static) call make_turntable(workspace%suspension, page%tests, page%paths, page%turntable)
      call find_figures(workspace%suspension, page)
      call set_head(settings, workspace%suspension, checksum, page)
      call put_page(settings, workspace%suspension, deck, page, box, error)
      if (allocated(error)) return
      call print_verdicts(settings%is_quiet, page)
      if (settings%fails_outside .and. .not. allocated(incomplete)) call fail_outside(page, incomplete)
      call move_alloc(incomplete, error)
      if (allocated(unmapped) .and. .not. allocated(error)) call fail(error, unmapped%code, &
         'measured curves have no column; see the errors above')
      call box%finish(error)
   end subroutine report

   !> Begins the content of a report with the values of the deck, and makes its folders.
   subroutine begin_content(settings, suspension, deck, page, error)
      type(settings_t), intent(in) :: settings
      type(suspension_t), intent(in) :: suspension
      type(deck_t), intent(in) :: deck
      type(report_t), intent(inout) :: page
      type(error_t), allocatable, intent(out) :: error

      page%folder = settings%out
      page%is_static = settings%is_static
      call list_values(deck, page%deck_paths, page%deck_texts)
      page%axle = kind_of(suspension, page%deck_paths)
      call make_folder(page%folder, error)
      if (.not. allocated(error)) call make_folder(join_path(page%folder, 'figures'), error)
   end subroutine begin_content

   !> Begins what a report collects over its tests: loads, parts, and the rates of the live page.
   subroutine begin_records(settings, definitions, suspension, chosen, checksum, page)
      type(settings_t), intent(in) :: settings
      character(*), intent(in) :: definitions           !! other program whose definitions are printed; '': none
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: chosen(:)
      character(*), intent(in) :: checksum
      type(report_t), intent(inout) :: page

      if (settings%has_loads) then
         allocate (page%loads)
         call begin_loads(suspension, suspension%name, checksum, page%loads, chosen)
      end if
      if (has_names(chosen)) then
         allocate (page%parts)
         call begin_parts(suspension, suspension%name, 'elastokin '//version, checksum, page%parts)
      end if
      if (definitions /= '') then
         allocate (page%defined)
         page%defined%program = definitions
         page%defined%test = ''
      end if
      if (settings%live <= 0) return
      allocate (page%live)
      page%live%most = settings%live
   end subroutine begin_records

   !> Writes the loads on the parts, if the report has them.
   subroutine put_loads(suspension, page, box)
      type(suspension_t), intent(in) :: suspension
      type(report_t), intent(in) :: page
      type(outbox_t), intent(inout) :: box

      if (.not. allocated(page%loads)) return
      call box%put(loads_file, page%loads%rows%csv())
      call box%put(peaks_file, peak_loads(page%loads))
      if (allocated(page%parts)) call put_parts(suspension, page%parts, box)
   end subroutine put_loads

   !> Writes the deck, the data and the page, and the list of all files.
   subroutine put_page(settings, suspension, deck, page, box, error)
      type(settings_t), intent(in) :: settings
      type(suspension_t), intent(in) :: suspension
      type(deck_t), intent(in) :: deck
      type(report_t), intent(inout) :: page
      type(outbox_t), intent(inout) :: box
      type(error_t), allocatable, intent(out) :: error

      call box%put(deck_file, deck_csv(page%names, page%values, page%deck_paths, page%deck_texts))
      call box%take(error)
      if (.not. allocated(error)) call write_deck_as_used(deck, join_path(page%folder, used_deck_file), error, page%copies)
      if (allocated(error)) return
      call box%announce(used_deck_file)
      call box%put(data_file, report_data(page))
      call write_page(settings, suspension, page, box)
      call box%take(error)
      if (.not. allocated(error)) call list_report(page, box, settings%is_quiet, error)
      if (.not. allocated(error)) call box%announce(page_file)
   end subroutine put_page

   !> The class and position of the axle, and what the deck gives of the drive and the sprung masses.
   type(axle_kind_t) function kind_of(suspension, given) result(kind)
      type(suspension_t), intent(in) :: suspension
      type(message_list_t), intent(in) :: given                 !! paths of the values that the deck gives
      integer :: k

      kind%gives_sprung_mass = all(suspension%wheels%sprung_mass > 0.0_wp)
      if (.not. suspension%axle%has_axle) return
      kind%position = merge(-1, 1, suspension%axle%is_front)
      kind%class = suspension%axle%class
      kind%is_driven = suspension%axle%drive_share > 0.0_wp
      do k = 1, given%count()
         if (given%line(k) == 'axle.drive_share') kind%gives_drive = .true.
      end do
   end function kind_of

   !> Checks that no number is outside its target or its usual range (--fail-outside).
   subroutine fail_outside(page, error)
      type(report_t), intent(in) :: page
      type(error_t), allocatable, intent(out) :: error          !! exit_outside
      type(verdict_t), allocatable :: lines(:)
      integer :: many

      call verdict_lines(page, lines)
      many = count(lines%verdict == outside)
      if (many > 0) call fail(error, exit_outside, '--fail-outside: '//plural(many, 'number is', 'numbers are')// &
         ' outside the target or the usual range')
   end subroutine fail_outside

   !> Adds the windows of the gradients to the stops of each test.
   subroutine stop_at_windows(windows, tests, cases)
      type(windows_t), intent(in) :: windows
      type(test_result_t), intent(in) :: tests(:)
      type(case_t), intent(inout) :: cases(:)
      integer :: k

      do k = 1, size(cases)
         call gradient_windows(tests(k), windows, cases(k))
      end do
   end subroutine stop_at_windows

   !> Writes the gradients, the key numbers with their targets, and the list of tests.
   subroutine put_numbers(workspace, checksum, page, box)
      type(workspace_t), intent(in) :: workspace                !! with trimmed preloads
      character(*), intent(in) :: checksum
      type(report_t), intent(inout) :: page                     !! report with the gradients; receives the key numbers
      type(outbox_t), intent(inout) :: box
      logical :: is_pair

      is_pair = size(workspace%suspension%wheels) > 1
      associate (model => workspace%suspension%name)
         call box%put(gradients_file, gradients_csv(page%gradients))
         call box%put(gradients_json_file, gradients_json(page%gradients, model, checksum))
         call key_numbers(page%tests, page%gradients, page%numbers, page%missing)
         call set_targets(workspace%definition%targets, page%numbers, page%warnings)
         call box%put(numbers_file, key_numbers_csv(page%numbers, is_pair))
         call box%put(numbers_json_file, key_numbers_json(page, is_pair, model, checksum))
         if (allocated(page%defined)) call put_defined(page%defined, model, checksum, page%warnings, box)
         call box%write(contents_file, contents_csv(page%tests))
      end associate
   end subroutine put_numbers

   !> Writes the numbers in the definitions of another program. Without a design state there are none, which is a warning.
   subroutine put_defined(defined, model, checksum, warnings, box)
      type(defined_numbers_t), intent(in) :: defined
      character(*), intent(in) :: model, checksum
      type(message_list_t), intent(inout) :: warnings
      type(outbox_t), intent(inout) :: box

      if (defined%test == '') then
         call warnings%add('--definitions: no test has a design state, so there are no numbers in the definitions of '// &
            defined%program)
         return
      end if
      call box%put(definitions_file, defined_csv(defined))
      call box%put(definitions_json_file, defined_json(defined, model, checksum))
   end subroutine put_defined

   !> Lists the files of the report, and removes the files of an earlier report from the folder.
   subroutine list_report(page, box, is_quiet, error)
      type(report_t), intent(in) :: page
      type(outbox_t), intent(in) :: box
      logical, intent(in) :: is_quiet
      type(error_t), allocatable, intent(out) :: error          !! exit_file: the list cannot be written
      type(message_list_t) :: files
      integer :: k

      do k = 1, size(files_of_reports)
         call files%add(trim(files_of_reports(k)))
      end do
      do k = 1, box%files%count()
         if (all(files_of_reports /= box%files%line(k))) call files%add(box%files%line(k))
      end do
      do k = 1, page%copies%count()
         call files%add(page%copies%line(k))
      end do
      do k = 1, page%drawn%count()
         call files%add(page%drawn%line(k))
      end do
      call renew_file_list(page%folder, list_file, files, 'report', is_quiet, error)
   end subroutine list_report

   !> Draws the pictures and writes the page. Missing pictures are a warning of the page and a failure of the outbox.
   subroutine write_page(settings, suspension, page, box)
      type(settings_t), intent(in) :: settings
      type(suspension_t), intent(in) :: suspension
      type(report_t), intent(inout) :: page
      type(outbox_t), intent(inout) :: box
      type(message_list_t) :: warnings
      type(error_t), allocatable :: undrawn
      character(:), allocatable :: message, lacks

      lacks = 'The page has no picture in space: '
      if (page%is_static) lacks = 'The page has no pictures: '
      ! first the page without pictures: it then exists even if gnuplot fails or never ends
      if (settings%has_plots) then
         warnings = page%warnings
         call page%warnings%add(lacks//'gnuplot has not finished')
         call box%write(page_file, report_page(page), can_be_redrawn=.true.)
         page%warnings = warnings
      end if
      if (box%has_failed()) return
      call draw_pictures(page, suspension, settings%has_plots, settings%has_figures, settings%is_animated, message, undrawn)
      if (allocated(undrawn)) then
         call print_error(undrawn%message)
         call page%warnings%add('The page lacks pictures: '//undrawn%message)
         call fail(box%undrawn, undrawn%code, 'the report was written, but some of its pictures are missing')
      else if (len(message) > 0) then
         if (settings%has_plots) call print_note(settings%is_quiet, message)
         call page%warnings%add(lacks//message)
      end if
      page%has_pictures = .not. allocated(undrawn) .and. len(message) == 0
      call box%write(page_file, report_page(page))
   end subroutine write_page

   subroutine read_settings(line, settings, error)
      type(command_line_t), intent(in) :: line
      type(settings_t), intent(out) :: settings
      type(error_t), allocatable, intent(out) :: error        !! exit_usage

      call read_deck_settings(line, settings)
      settings%has_plots = .not. line%has('--no-plots')
      settings%has_figures = line%has('--plots') .or. line%has('--static')
      settings%is_animated = line%has('--animate')
      settings%has_loads = line%has('--loads')
      settings%is_static = line%has('--static')
      settings%fails_outside = line%has('--fail-outside')
      call refuse_stream(line, error)
      if (.not. allocated(error) .and. line%has('--definitions')) call check_program(line%value('--definitions'), error)
      if (.not. allocated(error) .and. settings%is_animated .and. .not. settings%has_plots) &
         call fail(error, exit_usage, '--no-plots and --animate are mutually exclusive')
      if (.not. allocated(error) .and. line%has('--plots') .and. .not. settings%has_plots) &
         call fail(error, exit_usage, '--no-plots and --plots are mutually exclusive')
      if (.not. allocated(error) .and. line%has('--live')) call read_live(line, settings, error)
      if (.not. allocated(error)) call read_windows(line, settings%windows, error)
   end subroutine read_settings

   !> Reads the number of rates of --live.
   subroutine read_live(line, settings, error)
      type(command_line_t), intent(in) :: line
      type(settings_t), intent(inout) :: settings
      type(error_t), allocatable, intent(out) :: error        !! exit_usage

      settings%live = line%number('--live')
      if (settings%is_static) then
         call fail(error, exit_usage, '--live and --static are mutually exclusive: the rates are changed by the script of the '// &
            'page, and --static writes a page without script')
      else if (settings%live > most_live) then
         call fail(error, exit_usage, '--live: expected at most '//str(most_live)//' rates, found '//str(settings%live))
      end if
   end subroutine read_live

   !> Runs the tests, writes their tables and the envelopes of grid tests, and collects gradients and charts. Also writes the
   !> compliance matrix at every state of the first test that was run, for a suspension with wheels.
   subroutine run_tests(windows, suspension, chosen, found, checksum, page, box, incomplete)
      type(windows_t), intent(in) :: windows
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: chosen(:)
      type(examination_t), intent(in) :: found
      character(*), intent(in) :: checksum
      type(report_t), intent(inout) :: page
      type(outbox_t), intent(inout) :: box                        !! after a failure to write, no further test is run
      type(error_t), allocatable, intent(out) :: incomplete       !! tests that failed; the others are written
      type(error_t), allocatable :: trouble
      type(table_t), allocatable :: compliance
      type(explanation_t), allocatable :: explanations(:)
      type(test_result_t), allocatable :: planned(:)
      type(stop_t), allocatable :: stops(:)                       ! of the key numbers of the test
      type(table_t) :: defined                                    ! of the test in the definitions of another program
      integer :: k, failed, code

      allocate (page%paths(size(chosen)), page%charts(0), page%gradients(0))
      if (size(suspension%wheels) > 0) allocate (compliance)
      call plan_tables(suspension, chosen, planned)
      failed = 0
      code = exit_convergence
      do k = 1, size(chosen)
         if (allocated(stops)) deallocate (stops)
         call stop_at_numbers(planned, k, stops)
         call run_planned(suspension, chosen(k), found%faults%line(k), checksum, page%tests(k), page%paths(k), trouble, &
            compliance, page%loads, explanations, page%live, page%parts, page%defined, defined, stops)
         if (allocated(trouble)) then
            call print_error(trouble%message)
            failed = failed + 1
            if (trouble%code /= exit_convergence) code = trouble%code     ! the test was not run at all
            call page%warnings%add(page%tests(k)%title//': '//trouble%message)
         end if
         if (.not. page%tests(k)%is_run) cycle
         call box%put(page%tests(k)%file, page%tests(k)%table)
         call write_windows(chosen(k), page%tests(k), box)
         if (allocated(page%defined)) then
            call box%make_folder(definitions_folder)
            call box%write(definitions_folder//'/'//page%tests(k)%file, csv_text(defined))
         end if
         if (allocated(compliance)) then
            call box%put(compliance_file, compliance)
            deallocate (compliance)
            call move_alloc(explanations, page%explanations)
         end if
         call test_gradients(page%tests(k), windows, page%gradients)
         if (.not. allocated(page%tests(k)%grid)) then
            call test_charts(page%tests(k), page%charts, k)
         else
            call box%put(page%tests(k)%envelope, envelope_text(page%tests(k), suspension))
         end if
         if (box%has_failed()) return
      end do
      page%incomplete = failed
      if (size(suspension%tilts) > 0) allocate (page%tilts, source=suspension%tilts)
      if (failed > 0) call fail(incomplete, code, str(failed)//' of '//plural(size(chosen), 'test', 'tests')// &
         trim(merge(' is ', ' are', failed == 1))//' incomplete; see the warnings at the top of the report')
   end subroutine run_tests

   !> Writes the states at which the slopes of a test are read, if the test has slopes.
   subroutine write_windows(case, test, box)
      type(case_t), intent(in) :: case
      type(test_result_t), intent(in) :: test
      type(outbox_t), intent(inout) :: box
      type(table_t) :: table

      if (.not. allocated(case%windows)) return
      table = test%table
      if (allocated(test%read)) table = test%read
      call states_of_windows(case%windows, table)
      if (size(table%values, 2) == 0) return
      call box%make_folder(windows_folder)
      call box%write(windows_folder//'/'//test%file, csv_text(table))
   end subroutine write_windows

   !> Prints the lines of the assessment to standard error, aligned and coloured, and last the address of the page. Without a path of
   !> the working folder there is no address: a program for WebAssembly sees only its own root.
   subroutine print_verdicts(is_quiet, page)
      logical, intent(in) :: is_quiet
      type(report_t), intent(in) :: page
      type(verdict_t), allocatable :: lines(:)
      character(:), allocatable :: path
      integer :: k, width

      call verdict_lines(page, lines)
      width = maxval([(len_trim(lines(k)%domain), k=1, size(lines))])
      do k = 1, size(lines)
         call print_marked(is_quiet, lines(k)%domain(:width)//'  '//plain(lines(k)%text), trim(lines(k)%verdict))
      end do
      path = join_path(page%folder, page_file)
      if (index(path, '/') /= 1) then
         if (any(working_folder() == [character(1) :: '.', '/'])) return
         path = join_path(working_folder(), path)
      end if
      call print_note(is_quiet, 'file://'//path)
   end subroutine print_verdicts

   !> Sets title and facts of the page.
   subroutine set_head(settings, suspension, checksum, page)
      type(settings_t), intent(in) :: settings
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: checksum
      type(report_t), intent(inout) :: page
      character(:), allocatable :: changes
      integer :: k

      page%title = suspension%title
      if (len(page%title) == 0) page%title = suspension%name
      call add_fact(page, 'Deck', settings%file)
      call add_fact(page, 'Model', suspension%name)
      changes = ''
      do k = 1, settings%changes%count()
         changes = changes//settings%changes%line(k)//' '
      end do
      if (len(changes) > 0) call add_fact(page, 'Changed by --set', trim(changes))
      changes = ''
      do k = 1, settings%set_files%count()
         changes = changes//settings%set_files%line(k)//' '
      end do
      if (len(changes) > 0) call add_fact(page, 'Changed by --set-file', trim(changes))
      if (size(suspension%wheels) > 0) call add_fact(page, 'Road at design', 'z = '//str(( &
         suspension%bodies(suspension%wheels(1)%body)%origin(3) + suspension%wheels(1)%contact(3))/millimetre, 6)//' mm')
      call add_fact(page, 'Deck checksum', checksum)
      call add_fact(page, 'Program', 'elastokin '//version)
      call add_fact(page, 'Date', date_text())
   end subroutine set_head

end module ek_report
