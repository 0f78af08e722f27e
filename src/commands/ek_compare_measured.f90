!> elastokin compare DECK … --measured TEST=FILE --map FILE: decks beside measured curves. Each deck is solved at the measured
!> swept values.
module ek_compare_measured
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_convergence
   use ek_text, only: quoted
   use ek_file, only: make_folder, folder_exists, join_path
   use ek_reader, only: definition_t
   use ek_case, only: case_t, default_tolerance
   use ek_workspace, only: workspace_t, balance_or_explain
   use ek_standard_tests, only: standard_tests
   use ek_examination, only: examination_t
   use ek_planned_test, only: planned_tests
   use ek_gradient, only: gradient_windows
   use ek_gradient_definition, only: windows_t
   use ek_path, only: path_t
   use ek_report_names, only: used_deck_file
   use ek_report_measured, only: read_measured, compare_all_measured
   use ek_report_test, only: run_planned
   use ek_measured_difference, only: measured_model_t, measured_text, measured_json, measured_differences
   use ek_load_deck, only: deck_settings_t, read_deck_settings, load_deck, examine_chosen
   use ek_command_line, only: command_line_t, refuse_stream, read_windows, read_threshold
   use ek_console, only: print_note, print_text, print_error
   use ek_outbox, only: outbox_t, outbox_in, keep_first
   implicit none(type, external)
   private
   public :: compare_measurement

   character(*), parameter :: table_name = 'measured-differences.csv'

contains

   !> Solves each deck, prints the sentences and the rows, and writes the rows as CSV. If a test lacks a state, `error` has the code
   !> exit_convergence at the end; the points without a state are not compared.
   subroutine compare_measurement(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(measured_model_t), allocatable :: models(:)
      type(windows_t) :: windows
      type(error_t), allocatable :: incomplete, unprinted
      type(outbox_t) :: box
      real(wp) :: threshold
      integer :: k

      threshold = 0.01_wp
      call refuse(line, error)
      if (.not. allocated(error)) call read_windows(line, windows, error)
      if (.not. allocated(error)) call read_threshold(line, threshold, error)
      if (allocated(error)) return
      allocate (models(line%files%count()))
      do k = 1, size(models)
         call solve_model(line, line%files%line(k), windows, models(k), incomplete, error)
         if (allocated(error)) return
      end do
      if (line%has('--json')) call print_text(measured_json(models, threshold), unprinted)
      if (.not. line%has('--json')) call print_text(measured_text(models, threshold), unprinted)
      call make_folder(line%value('--out', 'out'), error)
      if (allocated(error)) return
      box = outbox_in(line%value('--out', 'out'))
      call box%write(table_name, measured_differences(models))
      call box%take(error)
      if (allocated(error)) return
      call print_note(line%has('--quiet'), join_path(line%value('--out', 'out'), table_name))
      call move_alloc(incomplete, error)
      call keep_first(error, unprinted)
   end subroutine compare_measurement

   !> Rejects options that belong to a comparison of reports.
   subroutine refuse(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      character(*), parameter :: of_reports(3) = [character(10) :: '--plots', '--no-plots', '--static']
      integer :: k

      call refuse_stream(line, error)
      if (.not. allocated(error) .and. line%files%count() == 0) &
         call fail(error, exit_usage, 'compare --measured needs a deck, which is solved at the measured swept values')
      do k = 1, size(of_reports)
         if (.not. allocated(error) .and. line%has(trim(of_reports(k)))) call fail(error, exit_usage, &
            trim(of_reports(k))//' and --measured are mutually exclusive; report --measured draws the curves')
      end do
   end subroutine refuse

   !> Solves the measured tests of a deck, and compares them with the measured curves. The deck of a report folder is its deck as
   !> used.
   subroutine solve_model(line, file, windows, model, incomplete, error)
      type(command_line_t), intent(in) :: line
      character(*), intent(in) :: file
      type(windows_t), intent(in) :: windows
      type(measured_model_t), intent(out) :: model
      type(error_t), allocatable, intent(inout) :: incomplete      !! a test lacks a state
      type(error_t), allocatable, intent(out) :: error
      class(workspace_t), allocatable :: workspace
      type(definition_t), target :: definition
      type(deck_settings_t) :: settings
      type(case_t), allocatable :: cases(:)
      type(message_list_t) :: warnings
      integer :: k

      call read_deck_settings(line, settings)
      settings%file = file
      if (folder_exists(file)) settings%file = join_path(file, used_deck_file)
      model%path = settings%file
      call load_deck(settings, definition, workspace, model%checksum, error)
      if (allocated(error)) return
      model%name = workspace%raw%name
      cases = workspace%deck_cases
      if (size(workspace%raw%wheels) > 0) call standard_tests(workspace%raw, workspace%deck_cases, cases)
      call balance_or_explain(default_tolerance, workspace, error)
      if (allocated(error)) return
      call planned_tests(workspace%suspension, cases, model%tests)
      do k = 1, size(cases)
         call gradient_windows(model%tests(k), windows, cases(k))
      end do
      call read_measured(line, workspace%suspension, model%tests, cases, model%measured, error)
      if (allocated(error)) return
      call solve_tests(workspace, cases, model, incomplete, error)
      if (allocated(error)) return
      call compare_all_measured(model%tests, model%measured, warnings, error)
      do k = 1, warnings%count()
         call print_note(.false., 'warning: '//warnings%line(k))
      end do
   end subroutine solve_model

   !> Solves the tests that have measured curves.
   subroutine solve_tests(workspace, cases, model, incomplete, error)
      type(workspace_t), intent(in) :: workspace
      type(case_t), intent(in) :: cases(:)
      type(measured_model_t), intent(inout) :: model
      type(error_t), allocatable, intent(inout) :: incomplete
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: trouble
      type(examination_t) :: found
      type(path_t) :: path
      integer :: k, t

      call examine_chosen(model%path, workspace%raw, cases(model%measured%place), found, error)
      if (allocated(error)) return
      do k = 1, size(model%measured)
         t = model%measured(k)%place
         if (any(model%measured(:k - 1)%place == t)) cycle
         call run_planned(workspace%suspension, cases(t), found%faults%line(k), model%checksum, model%tests(t), path, trouble)
         if (.not. allocated(trouble)) cycle
         if (trouble%code /= exit_convergence) then
            call move_alloc(trouble, error)
            return
         end if
         call print_error(trouble%message)
         if (.not. allocated(incomplete)) call fail(incomplete, exit_convergence, 'test '//quoted(model%tests(t)%name)//' of '// &
            model%path//' is incomplete; points at which it did not converge are not compared')
      end do
   end subroutine solve_tests

end module ek_compare_measured
