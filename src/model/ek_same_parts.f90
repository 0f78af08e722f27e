!> Whether two parts have equal numbers, bit for bit. The parts are of two designs of one model.
module ek_same_parts
   use ek_kinds, only: wp
   use ek_curve, only: curve_t
   use ek_law, only: law_t, law_list_t, law_shape
   use ek_measure, only: measure_t, measure_list_t
   use ek_elastic, only: bushing_list_t
   use ek_element, only: element_t, element_list_t, bushing_element
   use ek_load, only: load_t, load_list_t
   use ek_suspension, only: wheel_t, wheel_place_list_t
   implicit none(type, external)
   private
   public :: same_measure, same_law, same_form, same_element, same_spring, same_load, same_wheel

contains

   !> Whether two measures have equal arms and directions.
   pure logical function same_measure(a, b)
      type(measure_t), intent(in) :: a, b
      type(measure_list_t) :: p, q

      p = transfer(a%measure_numbers_t, p)
      q = transfer(b%measure_numbers_t, q)
      same_measure = .not. any(abs(p%v - q%v) > 0.0_wp)
   end function same_measure

   !> Whether two elements have equal numbers.
   pure logical function same_element(a, b)
      type(element_t), intent(in) :: a, b
      type(bushing_list_t) :: p, q
      integer :: c

      same_element = same_measure(a%measure, b%measure)
      if (.not. same_element) return
      if (a%kind /= bushing_element) then
         same_element = same_spring(a, b, 1) .and. same_law(a%law, b%law)
         return
      end if
      p = transfer(a%bushing%bushing_numbers_t, p)
      q = transfer(b%bushing%bushing_numbers_t, q)
      same_element = .not. any(abs(p%v - q%v) > 0.0_wp)
      if (.not. a%bushing%has_curves) return
      do c = 1, size(a%bushing%laws)
         same_element = same_element .and. same_law(a%bushing%laws(c), b%bushing%laws(c))
      end do
   end function same_element

   !> Whether two elements have equal numbers of the list, from one position on. Numbers of measure, law and bushing are not compared.
   pure logical function same_spring(a, b, from)
      type(element_t), intent(in) :: a, b
      integer, intent(in) :: from          !! 1: all; element_shape: those that give the law its shape
      type(element_list_t) :: p, q

      p = transfer(a%element_numbers_t, p)
      q = transfer(b%element_numbers_t, q)
      same_spring = .not. any(abs(p%v(from:) - q%v(from:)) > 0.0_wp)
   end function same_spring

   !> Whether two loads have equal numbers.
   pure logical function same_load(a, b)
      type(load_t), intent(in) :: a, b
      type(load_list_t) :: p, q

      p = transfer(a%load_numbers_t, p)
      q = transfer(b%load_numbers_t, q)
      same_load = .not. any(abs(p%v - q%v) > 0.0_wp)
   end function same_load

   !> Whether two wheels have equal data for their attitude.
   elemental logical function same_wheel(a, b)
      type(wheel_t), intent(in) :: a, b
      type(wheel_place_list_t) :: p, q

      p = transfer(a%wheel_place_t, p)
      q = transfer(b%wheel_place_t, q)
      same_wheel = .not. any(abs(p%v - q%v) > 0.0_wp)
   end function same_wheel

   pure logical function same_law(a, b)
      type(law_t), intent(in) :: a, b
      same_law = same_form(a, b) .and. .not. (abs(a%reference - b%reference) > 0.0_wp .or. abs(a%rate - b%rate) > 0.0_wp)
   end function same_law

   !> Whether two laws differ at most by their reference and rate.
   pure logical function same_form(a, b)
      type(law_t), intent(in) :: a, b
      type(law_list_t) :: p, q

      p = transfer(a%law_numbers_t, p)
      q = transfer(b%law_numbers_t, q)
      same_form = .not. any(abs(p%v(law_shape:) - q%v(law_shape:)) > 0.0_wp)
      if (same_form .and. a%has_curve) same_form = same_curve(a%curve, b%curve)
   end function same_form

   pure logical function same_curve(a, b)
      type(curve_t), intent(in) :: a, b
      same_curve = .not. (any(abs(a%breaks - b%breaks) > 0.0_wp) .or. any(abs(a%coefficients - b%coefficients) > 0.0_wp) .or. &
         abs(a%end_value - b%end_value) > 0.0_wp .or. abs(a%end_slope - b%end_slope) > 0.0_wp)
   end function same_curve

end module ek_same_parts
