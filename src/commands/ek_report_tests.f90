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
   public :: planned_test_t, planned_tests, run_planned, kind_of_case

   !> A test before it is run.
   type :: planned_test_t
      character(:), allocatable :: name      !! unique; also the name of its CSV file
      character(:), allocatable :: kind      !! 'parallel_travel', 'roll', 'lateral_force', …; see ek_gradient
      character(:), allocatable :: title     !! heading of its section
      type(case_t) :: case
      real(wp) :: factor_size = 1.0_wp       !! load or displacement at `factor` = 1 [N, N m or mm]
      logical :: is_anti = .false.           !! the load on the right wheel is opposite to that on the left
   end type planned_test_t

contains

   !> Name, kind and title of every test before it is run.
   subroutine planned_tests(suspension, cases, tests)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(planned_test_t), allocatable, intent(out) :: tests(:)
      integer :: k

      allocate (tests(size(cases)))
      do k = 1, size(cases)
         tests(k)%name = cases(k)%name
         tests(k)%case = cases(k)
         tests(k)%case%has_all = .true.
         if (len(cases(k)%test) > 0) then
            tests(k)%kind = cases(k)%test
            tests(k)%title = test_title(cases(k), size(suspension%wheels))
            tests(k)%is_anti = cases(k)%is_anti
         else
            call kind_of_case(suspension, cases(k), tests(k)%kind, tests(k)%factor_size)
            tests(k)%title = title_of(cases(k)%name)
         end if
      end do
   end subroutine planned_tests

   !> The kind of test that a case of a deck amounts to, from its drive or load.
   subroutine kind_of_case(suspension, case, kind, factor_size)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      character(:), allocatable, intent(out) :: kind
      real(wp), intent(out) :: factor_size      !! load at `factor` = 1 [N or N m]
      real(wp), parameter :: mostly = 0.99_wp   ! share of the load along one axis
      real(wp) :: force(3), moment(3)
      integer :: k

      kind = 'other'
      factor_size = 1.0_wp
      if (case%drive == 'wheel_travel') then
         kind = 'parallel_travel'
         if (size(suspension%wheels) > 1) kind = 'single_travel'
      end if
      k = load_number(suspension, case%load)
      if (k == 0) return
      force = suspension%loads(k)%force
      moment = suspension%loads(k)%moment
      if (norm2(force) > 0.0_wp .and. norm2(moment) > 0.0_wp) return
      if (abs(force(3)) > mostly*norm2(force)) then
         kind = 'vertical_force'
         factor_size = force(3)
      else if (abs(force(2)) > mostly*norm2(force)) then
         kind = 'lateral_force'
         factor_size = force(2)
      else if (abs(force(1)) > mostly*norm2(force)) then
         kind = 'braking'
         factor_size = force(1)
         if (is_at_centre(suspension, k)) kind = 'traction'
         if (kind == 'traction') factor_size = -force(1)
      else if (abs(moment(3)) > mostly*norm2(moment)) then
         kind = 'aligning_torque'
         factor_size = moment(3)
      end if
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
   subroutine run_planned(base, planned, fault, checksum, test, path, error, compliance)
      type(suspension_t), intent(in) :: base
      type(planned_test_t), intent(in) :: planned
      character(*), intent(in) :: fault            !! defect of the model in this test, which is then not run; '' for none
      character(*), intent(in) :: checksum
      type(test_result_t), intent(out) :: test
      type(path_t), intent(out) :: path            !! states, for pictures
      type(error_t), allocatable, intent(out) :: error
      type(table_t), intent(out), optional :: compliance    !! the compliance matrix at every state; not set if the test is not run
      integer, parameter :: topics(7) = [on_case, on_end, on_stability, on_settling, on_rack, on_curve, on_closure]
      type(solve_options_t) :: options
      type(case_result_t) :: result
      type(remark_t) :: remark
      integer :: topic, k

      test%name = planned%name
      test%kind = planned%kind
      test%title = planned%title
      test%file = table_file(planned%name)
      test%factor_size = planned%factor_size
      test%is_anti = planned%is_anti
      test%is_iso = base%is_iso
      allocate (test%prefixes(0), test%sides(0))
      options%fault = fault
      options%checksum = checksum
      options%is_compared = .false.
      options%least_settling = 1.0e-5_wp           ! m, seen on a rig: the design state should be in equilibrium
      call solve_case(base, planned%case, options, result)
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
      call test%table%header%add(test_line(planned%kind, planned%is_anti, planned%factor_size))
      if (size(base%wheels) > 0) call find_wheels(test, base%wheels(1)%side)
      call choose_abscissa(test)
   end subroutine run_planned

end module ek_report_tests
