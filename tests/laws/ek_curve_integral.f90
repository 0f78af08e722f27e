!> The energy of a law along a curve: the integral of its pieces.
module ek_curve_integral
   use ek_kinds, only: wp
   use ek_curve, only: curve_t
   implicit none(type, external)
   private
   public :: curve_integral

contains

   !> ∫ y dx from the first point to x: an energy, up to a constant.
   pure real(wp) function curve_integral(curve, x) result(area)
      type(curve_t), intent(in) :: curve
      real(wp), intent(in) :: x
      real(wp) :: t
      integer :: k, n

      n = size(curve%breaks)
      t = x - curve%breaks(1)
      area = 0.0_wp
      if (t < 0.0_wp) area = t*(curve%coefficients(1, 1) + 0.5_wp*curve%coefficients(2, 1)*t)
      do k = 1, n - 1
         t = min(x, curve%breaks(k + 1)) - curve%breaks(k)
         if (t <= 0.0_wp) return
         associate (c => curve%coefficients(:, k))
            area = area + t*(c(1) + t*(c(2)/2 + t*(c(3)/3 + t*(c(4)/4))))
         end associate
      end do
      t = x - curve%breaks(n)
      if (t > 0.0_wp) area = area + t*(curve%end_value + 0.5_wp*curve%end_slope*t)
   end function curve_integral

end module ek_curve_integral
