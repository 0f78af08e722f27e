!> Runs one test of a report, and takes from its result what a page and its files show: the table with its remarks, explanations,
!> loads, the data for sliders, and the columns of another program.
module ek_report_test
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_table, only: table_t, stop_t, new_table, name_length
   use ek_grid, only: is_grid
   use ek_grid_figures, only: find_grid
   use ek_report_files, only: test_line
   use ek_explanation, only: explanation_t, find_explanations
   use ek_live, only: live_t, add_live
   use ek_path, only: path_t
   use ek_case_result, only: case_result_t, solve_options_t, solve_with_remarks, add_header
   use ek_number_reach, only: lacks_state
   use ek_remark, only: remark_t, failure, on_case, on_end, on_stability, on_settling, on_rack, on_curve, on_closure
   use ek_compliance_table, only: compliance_table
   use ek_defined_table, only: defined_table
   use ek_defined_numbers, only: defined_numbers_t, read_defined
   use ek_member_loads, only: load_record_t, add_loads
   use ek_part_record, only: part_record_t, add_parts
   use ek_test_result, only: test_result_t, find_wheels, choose_abscissa
   implicit none(type, external)
   private
   public :: run_planned

contains

   !> Runs one test. If the test does not converge at every state, `error` has the code exit_convergence, the messages of the test
   !> contain each failure, and the table has the converged states. If the test cannot be run, the table is empty; `error` has the
   !> code exit_model if the model cannot be solved.
   subroutine run_planned(base, case, fault, checksum, test, path, error, compliance, loads, explanations, live, &
      parts, numbers, defined, stops)
      type(suspension_t), intent(in) :: base
      type(case_t), intent(in) :: case
      character(*), intent(in) :: fault            !! defect of the model in this test, which is then not run; '' for none
      character(*), intent(in) :: checksum
      type(test_result_t), intent(inout) :: test   !! test as planned; receives its result
      type(path_t), intent(out) :: path            !! states, for pictures
      type(error_t), allocatable, intent(out) :: error
      type(table_t), intent(out), optional :: compliance    !! the compliance matrix at every state; not set if the test is not run
      type(load_record_t), intent(inout), optional :: loads !! receives the loads of the members
      type(explanation_t), allocatable, intent(out), optional :: explanations(:)      !! explanations of the test, with compliance
      type(live_t), intent(inout), optional :: live         !! receives the data for the sliders of --live
      type(part_record_t), intent(inout), optional :: parts !! receives the loads on the parts
      type(defined_numbers_t), intent(inout), optional :: numbers      !! the program, if requested; receives the design state
      type(table_t), intent(inout), optional :: defined     !! receives the table in the definitions of the program
      type(stop_t), allocatable, intent(in), optional :: stops(:)      !! values of columns at which numbers are read
      integer, parameter :: topics(7) = [on_case, on_end, on_stability, on_settling, on_rack, on_curve, on_closure]
      type(solve_options_t) :: options
      class(case_result_t), allocatable :: result
      type(remark_t) :: remark
      integer, allocatable :: rows(:)
      character(name_length), allocatable :: of(:)
      integer :: topic, k

      allocate (result)
      options%fault = fault
      options%checksum = checksum
      if (present(stops)) then
         if (allocated(stops)) options%stops = stops
      end if
      options%is_compared = .false.
      options%min_settling = 1.0e-5_wp           ! m, seen on a rig: the design state should be in equilibrium
      call solve_with_remarks(base, case, options, result, error, read=test%read)
      do topic = 1, size(topics)
         do k = 1, result%remarks%count()
            remark = result%remarks%item(k)
            if (remark%topic /= topics(topic)) cycle
            if (remark%severity == failure) remark%text = remark%whole()
            call test%remarks%add(remark%text)
         end do
      end do
      test%is_run = result%is_run()
      test%is_whole = fault /= '' .or. .not. lacks_state(result, huge(1.0_wp))
      if (.not. test%is_run) then
         test%table = new_table([character(1) ::], 0)
         return
      end if
      if (present(compliance)) then
         call compliance_table(result%suspension, result%case, result%path, result%kkt, compliance)
         call add_header(compliance, result%suspension, result%case, checksum)
         if (present(explanations)) call find_explanations(result, explanations)
      end if
      if (present(numbers)) then
         call defined_table(result%suspension, result%table, numbers%program, defined, rows, of)
         call read_defined(defined, rows, of, test%title, numbers)
      end if
      if (present(loads)) call add_loads(result%suspension, result%case, result%path, result%kkt, loads)
      if (present(parts)) call add_parts(result%suspension, result%case, result%path, result%kkt, parts)
      if (present(live) .and. .not. is_grid(case)) call add_live(result, test, live)
      test%table = result%table
      call find_grid(base, case, test)
      path = result%path
      call test%table%header%add(test_line(test%kind, test%is_anti, test%factor_size))
      if (size(base%wheels) > 0) call find_wheels(test, base%wheels(1)%side)
      call choose_abscissa(test)
   end subroutine run_planned

end module ek_report_test
