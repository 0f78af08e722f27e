!> The tests of a report before they are run: their names, kinds and titles, from their cases.
module ek_planned_test
   use ek_kinds, only: wp
   use ek_text, only: spaced
   use ek_suspension, only: suspension_t, load_number
   use ek_free_wheels, only: has_rates
   use ek_case, only: case_t
   use ek_standard_tests, only: test_title, held_text, describe_sweep
   use ek_test_result, only: test_result_t
   implicit none(type, external)
   private
   public :: planned_tests, kind_of_case

contains

   !> Lists name, kind and title of every test before a solution. The results of all cases are set to have all columns.
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
            test%is_iso = suspension%is_iso
            call describe_sweep(suspension, case, test)
            allocate (test%prefixes(0), test%sides(0))
            if (len(case%test) > 0) then
               test%kind = case%test
               test%title = test_title(case, size(suspension%wheels), .not. has_rates(suspension))
               test%is_anti = case%is_anti
               test%trail = case%offset
               test%held = held_text(case, .not. has_rates(suspension))
            else
               call kind_of_case(suspension, case, test%kind, test%factor_size)
               test%title = title_of(case%name)
            end if
         end associate
      end do
   end subroutine planned_tests

   !> Finds the kind of test to which a case of a deck corresponds, from the driver or load of the case; 'other' if the case does
   !> not correspond to a test.
   subroutine kind_of_case(suspension, case, kind, factor_size)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      character(:), allocatable, intent(out) :: kind
      real(wp), intent(out) :: factor_size      !! load at `factor` = 1 [N or N m]
      real(wp), parameter :: mostly = 0.99_wp   ! share of the load along one axis
      character(15), parameter :: kinds(6) = [character(15) :: 'braking', 'lateral_force', 'vertical_force', '', '', &
         'aligning_torque']
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
      if (.not. abs(load(axis)) > mostly*norm2(load) .or. kinds(axis) == '') return
      factor_size = load(axis)
      kind = trim(kinds(axis))
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

   !> The title of a case from its name: 'Wheel travel sweep' for 'wheel_travel_sweep'.
   pure function title_of(name) result(title)
      character(*), intent(in) :: name
      character(:), allocatable :: title

      title = spaced(name)
      if (len(title) == 0) return
      if (title(1:1) >= 'a' .and. title(1:1) <= 'z') title(1:1) = achar(iachar(title(1:1)) - 32)
   end function title_of

end module ek_planned_test
