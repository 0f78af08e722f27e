!> Whether two parts have equal numbers, bit for bit. The parts are of two designs of one model.
module ek_same_parts
   use ek_kinds, only: wp
   use ek_curve, only: curve_t
   use ek_law, only: law_t
   use ek_measure, only: measure_t
   use ek_element, only: element_t, bushing_element
   use ek_suspension, only: wheel_t
   implicit none(type, external)
   private
   public :: same_measure, same_law, same_form, same_element, same_wheel

contains

   !> Whether two measures have equal arms and directions.
   pure logical function same_measure(a, b)
      type(measure_t), intent(in) :: a, b
      same_measure = .not. (any(abs(a%arm_i - b%arm_i) > 0.0_wp) .or. any(abs(a%arm_j - b%arm_j) > 0.0_wp) .or. &
         any(abs(a%u - b%u) > 0.0_wp) .or. any(abs(a%v - b%v) > 0.0_wp))
   end function same_measure

   !> Whether two elements have equal numbers.
   pure logical function same_element(a, b)
      type(element_t), intent(in) :: a, b
      integer :: c

      same_element = same_measure(a%measure, b%measure)
      if (.not. same_element) return
      if (a%kind /= bushing_element) then
         same_element = same_law(a%law, b%law) .and. .not. (abs(a%preload - b%preload) > 0.0_wp .or. &
            abs(a%design_length - b%design_length) > 0.0_wp)
         return
      end if
      associate (p => a%bushing, q => b%bushing)
         same_element = .not. (any(abs(p%axes - q%axes) > 0.0_wp) .or. any(abs(p%kt - q%kt) > 0.0_wp) .or. &
            any(abs(p%kr - q%kr) > 0.0_wp) .or. any(abs(p%gap0 - q%gap0) > 0.0_wp) .or. &
            any(abs(p%preload_force - q%preload_force) > 0.0_wp) .or. any(abs(p%preload_moment - q%preload_moment) > 0.0_wp) .or. &
            any(abs(p%force0 - q%force0) > 0.0_wp) .or. any(abs(p%moment0 - q%moment0) > 0.0_wp) .or. &
            any(abs(p%stiffness_t - q%stiffness_t) > 0.0_wp) .or. any(abs(p%stiffness_r - q%stiffness_r) > 0.0_wp))
         if (.not. p%has_curves) return
         do c = 1, size(p%laws)
            same_element = same_element .and. same_law(p%laws(c), q%laws(c))
         end do
      end associate
   end function same_element

   !> Whether two wheels have equal data for their attitude.
   elemental logical function same_wheel(a, b)
      type(wheel_t), intent(in) :: a, b
      same_wheel = .not. (any(abs(a%centre - b%centre) > 0.0_wp) .or. any(abs(a%contact - b%contact) > 0.0_wp) .or. &
         any(abs(a%spin - b%spin) > 0.0_wp) .or. any(abs(a%steer_axis - b%steer_axis) > 0.0_wp) .or. &
         any(abs(a%start_rise - b%start_rise) > 0.0_wp))
   end function same_wheel

   pure logical function same_law(a, b)
      type(law_t), intent(in) :: a, b
      same_law = same_form(a, b) .and. .not. (abs(a%reference - b%reference) > 0.0_wp .or. abs(a%rate - b%rate) > 0.0_wp)
   end function same_law

   !> Whether two laws differ at most by their reference and rate.
   pure logical function same_form(a, b)
      type(law_t), intent(in) :: a, b

      same_form = .not. (abs(a%sign - b%sign) > 0.0_wp .or. abs(a%rounding - b%rounding) > 0.0_wp)
      if (same_form .and. a%has_curve) same_form = same_curve(a%curve, b%curve)
   end function same_form

   pure logical function same_curve(a, b)
      type(curve_t), intent(in) :: a, b
      same_curve = .not. (any(abs(a%breaks - b%breaks) > 0.0_wp) .or. any(abs(a%coefficients - b%coefficients) > 0.0_wp) .or. &
         abs(a%end_value - b%end_value) > 0.0_wp .or. abs(a%end_slope - b%end_slope) > 0.0_wp)
   end function same_curve

end module ek_same_parts
