!> Sets one lane of a value for four designs from the value of one design.
!>
!> The numbers of a part are set as a list, so that no number can be forgotten. Kinds, bodies and other properties common to all
!> designs are also copied, so that the value is complete after every call. Names are not copied.
module ek_lane_copy
   use ek_contract, only: are_checked, require
   use ek_kinds, only: wp
   use ek_lanes, only: lanes_t
   use ek_curve, only: curve_t
   use ek_law, only: law_t, law_list_t
   use ek_relative_rotation, only: pose_t
   use ek_measure, only: measure_t, measure_list_t
   use ek_elastic, only: bushing_t, bushing_list_t
   use ek_element, only: element_t, element_list_t
   use ek_row, only: row_t, row_list_t, term_t, term_list_t
   use ek_load, only: load_t, load_list_t
   use ek_curve_lanes, only: curve_of_lanes_t => curve_t
   use ek_law_lanes, only: law_of_lanes_t => law_t, lists_of_law_t => law_list_t
   use ek_relative_rotation_lanes, only: pose_of_lanes_t => pose_t
   use ek_measure_lanes, only: measure_of_lanes_t => measure_t, lists_of_measure_t => measure_list_t
   use ek_elastic_lanes, only: bushing_of_lanes_t => bushing_t, lists_of_bushing_t => bushing_list_t
   use ek_element_lanes, only: element_of_lanes_t => element_t, lists_of_element_t => element_list_t
   use ek_row_lanes, only: row_of_lanes_t => row_t, lists_of_row_t => row_list_t, &
      term_of_lanes_t => term_t, lists_of_term_t => term_list_t
   use ek_load_lanes, only: load_of_lanes_t => load_t, lists_of_load_t => load_list_t
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
      type(measure_list_t) :: list
      type(lists_of_measure_t) :: lists

      x%kind = measure%kind
      x%body_i = measure%body_i
      x%body_j = measure%body_j
      list = transfer(measure%measure_numbers_t, list)
      lists = transfer(x%measure_numbers_t, lists)
      call set_number(lists%v, lane, list%v)
      x%measure_numbers_t = transfer(lists, x%measure_numbers_t)
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
      type(law_list_t) :: list
      type(lists_of_law_t) :: lists

      list = transfer(law%law_numbers_t, list)
      lists = transfer(x%law_numbers_t, lists)
      call set_number(lists%v, lane, list%v)
      x%law_numbers_t = transfer(lists, x%law_numbers_t)
      x%has_curve = law%has_curve
      x%is_one_sided = law%is_one_sided
      if (law%has_curve) call set_curve(x%curve, lane, law%curve)
   end subroutine set_law

   pure subroutine set_bushing(x, lane, bushing)
      type(bushing_of_lanes_t), intent(inout) :: x
      integer, intent(in) :: lane
      type(bushing_t), intent(in) :: bushing
      type(bushing_list_t) :: list
      type(lists_of_bushing_t) :: lists
      integer :: k

      list = transfer(bushing%bushing_numbers_t, list)
      lists = transfer(x%bushing_numbers_t, lists)
      call set_number(lists%v, lane, list%v)
      x%bushing_numbers_t = transfer(lists, x%bushing_numbers_t)
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
      type(element_list_t) :: list
      type(lists_of_element_t) :: lists

      x%kind = element%kind
      x%is_balanced = element%is_balanced
      call set_measure(x%measure, lane, element%measure)
      call set_law(x%law, lane, element%law)
      call set_bushing(x%bushing, lane, element%bushing)
      list = transfer(element%element_numbers_t, list)
      lists = transfer(x%element_numbers_t, lists)
      call set_number(lists%v, lane, list%v)
      x%element_numbers_t = transfer(lists, x%element_numbers_t)
   end subroutine set_element

   pure subroutine set_term(x, lane, term)
      type(term_of_lanes_t), intent(inout) :: x
      integer, intent(in) :: lane
      type(term_t), intent(in) :: term
      type(term_list_t) :: list
      type(lists_of_term_t) :: lists

      call set_measure(x%measure, lane, term%measure)
      list = transfer(term%term_numbers_t, list)
      lists = transfer(x%term_numbers_t, lists)
      call set_number(lists%v, lane, list%v)
      x%term_numbers_t = transfer(lists, x%term_numbers_t)
   end subroutine set_term

   pure subroutine set_row(x, lane, row)
      type(row_of_lanes_t), intent(inout) :: x
      integer, intent(in) :: lane
      type(row_t), intent(in) :: row
      type(row_list_t) :: list
      type(lists_of_row_t) :: lists

      x%first = row%first
      x%terms = row%terms
      x%joint = row%joint
      x%is_driver = row%is_driver
      list = transfer(row%row_numbers_t, list)
      lists = transfer(x%row_numbers_t, lists)
      call set_number(lists%v, lane, list%v)
      x%row_numbers_t = transfer(lists, x%row_numbers_t)
   end subroutine set_row

   pure subroutine set_load(x, lane, load)
      type(load_of_lanes_t), intent(inout) :: x
      integer, intent(in) :: lane
      type(load_t), intent(in) :: load
      type(load_list_t) :: list
      type(lists_of_load_t) :: lists

      x%body = load%body
      x%follows = load%follows
      x%is_case = load%is_case
      x%is_weight = load%is_weight
      x%wheel = load%wheel
      list = transfer(load%load_numbers_t, list)
      lists = transfer(x%load_numbers_t, lists)
      call set_number(lists%v, lane, list%v)
      x%load_numbers_t = transfer(lists, x%load_numbers_t)
   end subroutine set_load

end module ek_lane_copy
