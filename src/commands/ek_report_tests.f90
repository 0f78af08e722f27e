!> The tests of a report: their selection, and the run of one test.
module ek_report_tests
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_text, only: spaced
   use ek_suspension, only: suspension_t, load_number
   use ek_standard_tests, only: test_title
   use ek_case, only: case_t
   use ek_path, only: path_t
   use ek_case_result, only: case_result_t, solve_options_t, solve_case, failure_of, add_header
   use ek_remark, only: remark_t, failure, on_case, on_end, on_stability, on_settling, on_rack, on_curve, on_closure
   use ek_compliance_table, only: compliance_table
   use ek_table, only: table_t, new_table
   use ek_test_result, only: test_result_t, find_wheels, choose_abscissa
   use ek_report_files, only: test_line, table_file
   implicit none(type, external)
   private
   public :: planned_tests, run_planned, kind_of_case

contains

   !> Name, kind and title of every test before it is run.
   subroutine planned_tests(suspension, cases, tests)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(inout) :: cases(:)      !! their results have all columns
      type(test_result_t), allocatable, intent(out) :: tests(:)
      integer :: k

      allocate (tests(size(cases)))
      cases%has_all = .true.
      do k = 1, size(cases)
         associate (test => tests(k), case => cases(k))
            test%name = case%name
            test%file = table_file(case%name)
            test%is_iso = suspension%is_iso
            allocate (test%prefixes(0), test%sides(0))
            if (len(case%test) > 0) then
               test%kind = case%test
               test%title = test_title(case, size(suspension%wheels))
               test%is_anti = case%is_anti
            else
               call kind_of_case(suspension, case, test%kind, test%factor_size)
               test%title = title_of(case%name)
            end if
         end associate
      end do
   end subroutine planned_tests

   !> The kind of test that a case of a deck amounts to, from its drive or load.
   subroutine kind_of_case(suspension, case, kind, factor_size)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      character(:), allocatable, intent(out) :: kind
      real(wp), intent(out) :: factor_size      !! load at `factor` = 1 [N or N m]
      real(wp), parameter :: mostly = 0.99_wp   ! share of the load along one axis
      real(wp) :: load(6)
      integer :: k, axis

      kind = 'other'
      factor_size = 1.0_wp
      if (case%drive == 'wheel_travel') then
         kind = 'parallel_travel'
         if (size(suspension%wheels) > 1) kind = 'single_travel'
      end if
      k = load_number(suspension, case%load)
      if (k == 0) return
      load = [suspension%loads(k)%force, suspension%loads(k)%moment]
      if (norm2(load(:3)) > 0.0_wp .and. norm2(load(4:)) > 0.0_wp) return
      axis = maxloc(abs(load), dim=1)
      if (.not. abs(load(axis)) > mostly*norm2(load) .or. axis == 4 .or. axis == 5) return
      factor_size = load(axis)
      if (axis == 1) kind = 'braking'
      if (axis == 2) kind = 'lateral_force'
      if (axis == 3) kind = 'vertical_force'
      if (axis == 6) kind = 'aligning_torque'
      if (axis /= 1 .or. .not. is_at_centre(suspension, k)) return
      kind = 'traction'
      factor_size = -load(1)
   end subroutine kind_of_case

   !> Whether a load acts at the centre of a wheel.
   pure logical function is_at_centre(suspension, load)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: load
      real(wp), parameter :: same = 1.0e-6_wp     ! m
      integer :: k

      is_at_centre = any([(suspension%wheels(k)%body == suspension%loads(load)%body .and. &
         norm2(suspension%wheels(k)%centre - suspension%loads(load)%arm) < same, k=1, size(suspension%wheels))])
   end function is_at_centre

   !> 'Wheel travel sweep' of 'wheel_travel_sweep'.
   pure function title_of(name) result(title)
      character(*), intent(in) :: name
      character(:), allocatable :: title

      title = spaced(name)
      if (len(title) == 0) return
      if (title(1:1) >= 'a' .and. title(1:1) <= 'z') title(1:1) = achar(iachar(title(1:1)) - 32)
   end function title_of

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
      options%least_settling = 1.0e-5_wp           ! m, seen on a rig: the design state should be in equilibrium
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

end module ek_report_tests
