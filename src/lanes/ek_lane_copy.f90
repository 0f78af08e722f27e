!> Sets one lane of a value for four designs from the value of one design.
!>
!> Kinds, bodies and other properties common to all designs are also copied, so that the value is complete after every call. Names
!> are not copied.
module ek_lane_copy
   use ek_contract, only: are_checked, require
   use ek_kinds, only: wp
   use ek_lanes, only: lanes_t
   use ek_curve, only: curve_t
   use ek_law, only: law_t
   use ek_relative_rotation, only: pose_t
   use ek_measure, only: measure_t
   use ek_elastic, only: bushing_t
   use ek_element, only: element_t
   use ek_row, only: row_t, term_t
   use ek_load, only: load_t
   use ek_curve_lanes, only: curve_of_lanes_t => curve_t
   use ek_law_lanes, only: law_of_lanes_t => law_t
   use ek_relative_rotation_lanes, only: pose_of_lanes_t => pose_t
   use ek_measure_lanes, only: measure_of_lanes_t => measure_t
   use ek_elastic_lanes, only: bushing_of_lanes_t => bushing_t
   use ek_element_lanes, only: element_of_lanes_t => element_t
   use ek_row_lanes, only: row_of_lanes_t => row_t, term_of_lanes_t => term_t
   use ek_load_lanes, only: load_of_lanes_t => load_t
   implicit none(type, external)
   private
   public :: set_lane

   !> set_lane(value of lanes, lane, value of one design): sets one lane.
   interface set_lane
      procedure :: set_number, set_pose, set_measure, set_curve, set_law, set_bushing, set_element, set_row, set_term, set_load
   end interface set_lane

contains

   elemental subroutine set_number(x, lane, number)
      type(lanes_t), intent(inout) :: x
      integer, intent(in) :: lane
      real(wp), intent(in) :: number
      x%v(lane) = number
   end subroutine set_number

   pure subroutine set_pose(x, lane, pose)
      type(pose_of_lanes_t), intent(inout) :: x
      integer, intent(in) :: lane
      type(pose_t), intent(in) :: pose

      call set_number(x%r, lane, pose%r)
      call set_number(x%q, lane, pose%q)
      call set_number(x%a, lane, pose%a)
   end subroutine set_pose

   pure subroutine set_measure(x, lane, measure)
      type(measure_of_lanes_t), intent(inout) :: x
      integer, intent(in) :: lane
      type(measure_t), intent(in) :: measure

      x%kind = measure%kind
      x%body_i = measure%body_i
      x%body_j = measure%body_j
      call set_number(x%u, lane, measure%u)
      call set_number(x%v, lane, measure%v)
      call set_number(x%arm_i, lane, measure%arm_i)
      call set_number(x%arm_j, lane, measure%arm_j)
   end subroutine set_measure

   !> Sets one lane of a curve. All designs have the same number of points.
   pure subroutine set_curve(x, lane, curve)
      type(curve_of_lanes_t), intent(inout) :: x
      integer, intent(in) :: lane
      type(curve_t), intent(in) :: curve
      integer :: n

      n = size(curve%breaks)
      if (.not. allocated(x%breaks)) allocate (x%breaks(n), x%coefficients(4, n - 1))
      if (are_checked) call require(size(x%breaks) == n, 'set_curve: curves with other numbers of points')
      call set_number(x%breaks, lane, curve%breaks)
      call set_number(x%coefficients, lane, curve%coefficients)
      call set_number(x%end_value, lane, curve%end_value)
      call set_number(x%end_slope, lane, curve%end_slope)
   end subroutine set_curve

   pure subroutine set_law(x, lane, law)
      type(law_of_lanes_t), intent(inout) :: x
      integer, intent(in) :: lane
      type(law_t), intent(in) :: law

      call set_number(x%sign, lane, law%sign)
      call set_number(x%reference, lane, law%reference)
      call set_number(x%rate, lane, law%rate)
      call set_number(x%rounding, lane, law%rounding)
      x%has_curve = law%has_curve
      x%is_one_sided = law%is_one_sided
      if (law%has_curve) call set_curve(x%curve, lane, law%curve)
   end subroutine set_law

   pure subroutine set_bushing(x, lane, bushing)
      type(bushing_of_lanes_t), intent(inout) :: x
      integer, intent(in) :: lane
      type(bushing_t), intent(in) :: bushing
      integer :: k

      call set_number(x%stiffness_t, lane, bushing%stiffness_t)
      call set_number(x%stiffness_r, lane, bushing%stiffness_r)
      call set_number(x%force0, lane, bushing%force0)
      call set_number(x%moment0, lane, bushing%moment0)
      call set_number(x%gap0, lane, bushing%gap0)
      call set_number(x%axes, lane, bushing%axes)
      call set_number(x%kt, lane, bushing%kt)
      call set_number(x%kr, lane, bushing%kr)
      call set_number(x%preload_force, lane, bushing%preload_force)
      call set_number(x%preload_moment, lane, bushing%preload_moment)
      x%has_curves = bushing%has_curves
      if (.not. bushing%has_curves) return
      if (.not. allocated(x%laws)) allocate (x%laws(size(bushing%laws)))
      do k = 1, size(bushing%laws)
         call set_law(x%laws(k), lane, bushing%laws(k))
      end do
   end subroutine set_bushing

   pure subroutine set_element(x, lane, element)
      type(element_of_lanes_t), intent(inout) :: x
      integer, intent(in) :: lane
      type(element_t), intent(in) :: element

      x%kind = element%kind
      x%is_balanced = element%is_balanced
      call set_measure(x%measure, lane, element%measure)
      call set_number(x%preload, lane, element%preload)
      call set_law(x%law, lane, element%law)
      call set_bushing(x%bushing, lane, element%bushing)
      call set_number(x%design_length, lane, element%design_length)
      call set_number(x%free_length, lane, element%free_length)
      call set_number(x%clearance, lane, element%clearance)
   end subroutine set_element

   pure subroutine set_term(x, lane, term)
      type(term_of_lanes_t), intent(inout) :: x
      integer, intent(in) :: lane
      type(term_t), intent(in) :: term

      call set_measure(x%measure, lane, term%measure)
      call set_number(x%coefficient, lane, term%coefficient)
   end subroutine set_term

   pure subroutine set_row(x, lane, row)
      type(row_of_lanes_t), intent(inout) :: x
      integer, intent(in) :: lane
      type(row_t), intent(in) :: row

      x%first = row%first
      x%terms = row%terms
      x%joint = row%joint
      x%is_driver = row%is_driver
      call set_number(x%target, lane, row%target)
      call set_number(x%compliance, lane, row%compliance)
   end subroutine set_row

   pure subroutine set_load(x, lane, load)
      type(load_of_lanes_t), intent(inout) :: x
      integer, intent(in) :: lane
      type(load_t), intent(in) :: load

      x%body = load%body
      x%follows = load%follows
      x%is_case = load%is_case
      x%is_weight = load%is_weight
      call set_number(x%arm, lane, load%arm)
      call set_number(x%force, lane, load%force)
      call set_number(x%moment, lane, load%moment)
   end subroutine set_load

end module ek_lane_copy
