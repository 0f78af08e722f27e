!> elastokin report: deck → tests → gradients, charts, picture → one page and its files.
module ek_report
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_convergence
   use ek_text, only: str, plural
   use ek_version, only: version
   use ek_clock, only: date_text
   use ek_file, only: make_folder, write_whole, join_path, remove_file
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, default_tolerance
   use ek_balance, only: balance
   use ek_examination, only: examination_t
   use ek_standard_tests, only: standard_tests
   use ek_table, only: table_t, new_table
   use ek_test_charts, only: test_charts
   use ek_gradient, only: test_gradients, write_gradients
   use ek_report_files, only: write_contents, contents_file, gradients_file, compliance_file, numbers_file, test_line
   use ek_planned_test, only: planned_tests
   use ek_key_numbers, only: key_number_t, key_numbers
   use ek_key_number_table, only: write_key_numbers
   use ek_report_page, only: report_t, report_page, add_fact
   use ek_report_pictures, only: draw_pictures
   use ek_gradient_definition, only: windows_t
   use ek_command_line, only: command_line_t, refuse_stream, read_windows
   use ek_load_deck, only: deck_settings_t, read_deck_settings, load_deck, chosen_cases, examine_chosen
   use ek_console, only: print_note, print_error, print_path, print_model_remarks, write_table
   use ek_kinds, only: wp, millimetre
   use ek_path, only: path_t
   use ek_case_result, only: case_result_t, solve_options_t, solve_case, failure_of, add_header
   use ek_remark, only: remark_t, failure, on_case, on_end, on_stability, on_settling, on_rack, on_curve, on_closure
   use ek_sweep_table, only: compliance_table
   use ek_test_result, only: test_result_t, find_wheels, choose_abscissa
   implicit none(type, external)
   private
   public :: report, run_planned

   type, extends(deck_settings_t) :: settings_t
      type(windows_t) :: windows                     !! of gradients
      logical :: has_plots = .true., is_animated = .false.
   end type settings_t

contains

   !> Runs the tests of a deck and writes all files. Of a test that fails part way the converged states are written; the
   !> error at the end then has code exit_convergence.
   subroutine report(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(settings_t) :: settings
      type(report_t) :: page
      type(suspension_t) :: suspension
      type(case_t), allocatable :: cases(:), all_cases(:), chosen(:)      ! of the deck; those of this report
      type(examination_t) :: found
      type(key_number_t), allocatable :: numbers(:)
      type(message_list_t) :: warnings
      type(error_t), allocatable :: undrawn, unprinted, incomplete
      character(:), allocatable :: checksum, message

      call read_settings(line, settings, error)
      if (.not. allocated(error)) call load_deck(settings, suspension, cases, checksum, error)
      if (allocated(error)) return
      all_cases = cases                                     ! of a model without a wheel
      if (size(suspension%wheels) > 0) call standard_tests(suspension, cases, all_cases)
      call chosen_cases(settings, all_cases, chosen, error)
      if (.not. allocated(error)) call examine_chosen(settings%file, suspension, chosen, found, error)
      if (allocated(error)) return
      page%folder = settings%out
      call make_folder(page%folder, error)
      if (.not. allocated(error)) call make_folder(join_path(page%folder, 'figures'), error)
      if (.not. allocated(error)) call balance(suspension, default_tolerance, error)
      if (allocated(error)) return
      call planned_tests(suspension, chosen, page%tests)
      call print_model_remarks(settings%is_quiet, suspension, cases, chosen, page%warnings)
      call remove_file(join_path(page%folder, 'report.html'))     ! a page of an earlier report must not be mistaken for this one
      call remove_file(join_path(page%folder, contents_file))
      call remove_file(join_path(page%folder, compliance_file))

      call run_tests(settings%windows, suspension, chosen, found, checksum, page, unprinted, incomplete, error)
      if (allocated(error)) return
      call write_gradients(page%gradients, suspension%name, checksum, join_path(page%folder, gradients_file), &
         join_path(page%folder, 'gradients.json'), error)
      if (allocated(error)) return
      call print_path(join_path(page%folder, gradients_file), unprinted)
      call print_path(join_path(page%folder, 'gradients.json'), unprinted)
      call key_numbers(page%tests, page%gradients, numbers)
      call write_key_numbers(numbers, size(suspension%wheels) > 1, suspension%name, checksum, &
         join_path(page%folder, numbers_file), join_path(page%folder, 'key_numbers.json'), error)
      if (allocated(error)) return
      call print_path(join_path(page%folder, numbers_file), unprinted)
      call print_path(join_path(page%folder, 'key_numbers.json'), unprinted)
      call write_contents(page%tests, join_path(page%folder, contents_file), error)
      if (allocated(error)) return

      call set_head(settings, suspension, checksum, page)
      ! first the page without pictures: it then exists even if gnuplot fails or never ends
      if (settings%has_plots) then
         warnings = page%warnings
         call page%warnings%add('The page has no pictures: gnuplot has not finished')
         call write_whole(join_path(page%folder, 'report.html'), report_page(page), error)
         if (allocated(error)) return
         page%warnings = warnings
      end if
      call draw_pictures(page, suspension, settings%has_plots, settings%is_animated, message, undrawn)
      if (allocated(undrawn)) then
         call print_error(undrawn%message)
         call page%warnings%add('The page lacks pictures: '//undrawn%message)
      else if (len(message) > 0) then
         if (settings%has_plots) call print_note(settings%is_quiet, message)
         call page%warnings%add('The page has no pictures: '//message)
      end if
      page%has_pictures = .not. allocated(undrawn) .and. len(message) == 0
      call write_whole(join_path(page%folder, 'report.html'), report_page(page), error)
      if (allocated(error)) return
      call print_path(join_path(page%folder, 'report.html'), unprinted)
      if (allocated(incomplete)) then
         call move_alloc(incomplete, error)
      else if (allocated(undrawn)) then
         call fail(error, undrawn%code, 'the report was written, but some of its pictures are missing')
      else if (allocated(unprinted)) then
         call move_alloc(unprinted, error)
      end if
   end subroutine report

   subroutine read_settings(line, settings, error)
      type(command_line_t), intent(in) :: line
      type(settings_t), intent(out) :: settings
      type(error_t), allocatable, intent(out) :: error        !! exit_usage

      call read_deck_settings(line, settings)
      settings%has_plots = .not. line%has('--no-plots')
      settings%is_animated = line%has('--animate')
      call refuse_stream(line, error)
      if (.not. allocated(error) .and. settings%is_animated .and. .not. settings%has_plots) &
         call fail(error, exit_usage, '--no-plots and --animate are mutually exclusive')
      if (.not. allocated(error)) call read_windows(line, settings%windows, error)
   end subroutine read_settings

   !> Runs the tests and writes their tables, and the compliance matrix at every state of the first that is run: travel, with
   !> design.
   subroutine run_tests(windows, suspension, chosen, found, checksum, page, unprinted, incomplete, error)
      type(windows_t), intent(in) :: windows
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: chosen(:)
      type(examination_t), intent(in) :: found
      character(*), intent(in) :: checksum
      type(report_t), intent(inout) :: page
      type(error_t), allocatable, intent(inout) :: unprinted      !! a path could not be printed
      type(error_t), allocatable, intent(out) :: incomplete       !! tests that failed; the others are written
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: trouble
      type(table_t), allocatable :: compliance
      integer :: k, failed, code

      allocate (page%paths(size(chosen)), page%charts(0), page%gradients(0))
      if (size(suspension%wheels) > 0) allocate (compliance)
      failed = 0
      code = exit_convergence
      do k = 1, size(chosen)
         call run_planned(suspension, chosen(k), found%faults%line(k), checksum, page%tests(k), page%paths(k), trouble, compliance)
         if (allocated(trouble)) then
            call print_error(trouble%message)
            failed = failed + 1
            if (trouble%code /= exit_convergence) code = trouble%code     ! the test was not run at all
            call page%warnings%add(page%tests(k)%title//': '//trouble%message)
         end if
         if (.not. page%tests(k)%is_run) cycle
         call write_table(page%tests(k)%table, join_path(page%folder, page%tests(k)%file), unprinted, error)
         if (allocated(error)) return
         if (allocated(compliance)) then
            call write_table(compliance, join_path(page%folder, compliance_file), unprinted, error)
            if (allocated(error)) return
            deallocate (compliance)
         end if
         call test_gradients(page%tests(k), windows, page%gradients)
         call test_charts(page%tests(k), page%charts, k)
      end do
      if (failed > 0) call fail(incomplete, code, str(failed)//' of '//plural(size(chosen), 'test', 'tests')// &
         trim(merge(' is ', ' are', failed == 1))//' incomplete; see the warnings at the top of the report')
   end subroutine run_tests

   !> Title and facts of the page.
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
      if (size(suspension%wheels) > 0) call add_fact(page, 'Road at design', 'z = '//str(( &
         suspension%bodies(suspension%wheels(1)%body)%origin(3) + suspension%wheels(1)%contact(3))/millimetre, 6)//' mm')
      call add_fact(page, 'Deck checksum', checksum)
      call add_fact(page, 'Program', 'elastokin '//version)
      call add_fact(page, 'Date', date_text())
   end subroutine set_head

   !> Runs one test. Its remarks report every failure to converge; `error` then has exit_convergence (or exit_model if the
   !> model cannot be solved), and the table has the states before it.
   subroutine run_planned(base, case, fault, checksum, test, path, error, compliance)
      type(suspension_t), intent(in) :: base
      type(case_t), intent(in) :: case
      character(*), intent(in) :: fault            !! defect of the model in this test, which is then not run; '' for none
      character(*), intent(in) :: checksum
      type(test_result_t), intent(inout) :: test   !! as planned
      type(path_t), intent(out) :: path            !! states, for pictures
      type(error_t), allocatable, intent(out) :: error
      type(table_t), intent(out), optional :: compliance    !! the compliance matrix at every state; not set if the test is not run
      integer, parameter :: topics(7) = [on_case, on_end, on_stability, on_settling, on_rack, on_curve, on_closure]
      type(solve_options_t) :: options
      type(case_result_t) :: result
      type(remark_t) :: remark
      integer :: topic, k

      options%fault = fault
      options%checksum = checksum
      options%is_compared = .false.
      options%min_settling = 1.0e-5_wp           ! m, seen on a rig: the design state should be in equilibrium
      call solve_case(base, case, options, result)
      call failure_of(result, error)
      do topic = 1, size(topics)
         do k = 1, result%remarks%count()
            remark = result%remarks%item(k)
            if (remark%topic /= topics(topic)) cycle
            if (remark%severity == failure) remark%text = remark%whole()
            call test%remarks%add(remark%text)
         end do
      end do
      test%is_run = result%is_run()
      if (.not. test%is_run) then
         test%table = new_table([character(1) ::], 0)
         return
      end if
      if (present(compliance)) then
         call compliance_table(result%suspension, result%case, result%path, result%kkt, compliance)
         call add_header(compliance, result%suspension, result%case, checksum)
      end if
      test%table = result%table
      path = result%path
      call test%table%header%add(test_line(test%kind, test%is_anti, test%factor_size))
      if (size(base%wheels) > 0) call find_wheels(test, base%wheels(1)%side)
      call choose_abscissa(test)
   end subroutine run_planned

end module ek_report
