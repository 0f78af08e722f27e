!> The slope of a curve over a window, from the values at five fixed points of the window.
!>
!> The slope is that of the least-squares line of y(x) over centre − h ≤ x ≤ centre + h:
!>
!>     slope = ∫ (x − centre) y dx / ∫ (x − centre)² dx
!>
!> The points are those of Gauss–Lobatto, which integrate polynomials up to degree 7 exactly (M. Abramowitz, I. A. Stegun, Handbook
!> of Mathematical Functions, 25.4.32):
!>
!>     ξ = 0, ±√(3/7), ±1      weights 32/45, 49/90, 1/10
!>
!> The points are fixed in the swept value of a path, and x need not be proportional to the swept value. So y(x) is the polynomial
!> of degree four through the five points, and the integrals are taken over the exact window of x. Where the swept values begin or
!> end at the centre, the window is the half on the other side.
module ek_window
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: window_points, window_places, window_side, window_slope, polynomial, has_place, both_sides, no_window

   integer, parameter :: window_points = 5
   integer, parameter :: both_sides = 0, no_window = 2        !! sides of a window; 1 and −1: above and below its centre alone

   real(wp), parameter :: inner = sqrt(3.0_wp/7.0_wp)
   real(wp), parameter :: point(window_points) = [-1.0_wp, -inner, 0.0_wp, inner, 1.0_wp]
   real(wp), parameter :: weight(window_points) = [0.1_wp, 49.0_wp/90.0_wp, 32.0_wp/45.0_wp, 49.0_wp/90.0_wp, 0.1_wp]
   real(wp), parameter :: rounding = 1.0e-9_wp                !! of the range: swept values closer than this are the same

contains

   !> Whether two swept values are the same but for rounding.
   elemental logical function has_place(a, b, range)
      real(wp), intent(in) :: a, b
      real(wp), intent(in) :: range                           !! of the swept values
      has_place = abs(a - b) <= rounding*range
   end function has_place

   !> The side of its centre on which a window lies within a range of swept values: both_sides, 1, −1, or no_window if the range ends
   !> within the window.
   elemental integer function window_side(centre, half, low, high) result(side)
      real(wp), intent(in) :: centre, half                    !! half: half width of the window, positive
      real(wp), intent(in) :: low, high                       !! the range
      real(wp) :: slack
      logical :: is_below, is_above

      slack = rounding*(high - low)
      is_below = centre - half >= low - slack
      is_above = centre + half <= high + slack
      side = no_window
      if (is_below .and. is_above) then
         side = both_sides
      else if (is_above .and. abs(centre - low) <= slack) then
         side = 1
      else if (is_below .and. abs(centre - high) <= slack) then
         side = -1
      end if
   end function window_side

   !> The five points of a window, from one end of the window to the other.
   pure function window_places(centre, half, side) result(places)
      real(wp), intent(in) :: centre, half
      integer, intent(in) :: side                             !! both_sides, 1 or −1
      real(wp) :: places(window_points)

      if (side == both_sides) then
         places = centre + half*point
      else
         places = centre + real(side, wp)*half*0.5_wp*(1.0_wp + point)
      end if
   end function window_places

   !> Computes the slope of y over x in the window of half width `half` around the middle point, or on one side of the first point. The slope
   !> is not found if x does not change, or does not grow or fall, from point to point.
   pure subroutine window_slope(x, y, half, side, slope, is_found)
      real(wp), intent(in) :: x(window_points), y(window_points)      !! at the points of window_places
      real(wp), intent(in) :: half                            !! half width of the window, in the unit of x
      integer, intent(in) :: side                             !! both_sides, 1 or −1
      real(wp), intent(out) :: slope                          !! [unit of y per unit of x]; 0 if not found
      logical, intent(out) :: is_found
      real(wp) :: middle, reach, at, along, spread, step(window_points - 1)
      integer :: j

      slope = 0.0_wp
      step = x(2:) - x(:window_points - 1)
      is_found = minval(abs(step)) > 1.0e-3_wp*half .and. (all(step > 0.0_wp) .or. all(step < 0.0_wp))
      if (.not. is_found) return
      if (side == both_sides) then
         middle = x(3)
         reach = half
      else
         middle = x(1) + 0.5_wp*sign(half, step(1))
         reach = 0.5_wp*half
      end if
      along = 0.0_wp
      spread = 0.0_wp
      do j = 1, window_points
         at = reach*point(j)
         along = along + weight(j)*at*polynomial(x, y, middle + at)
         spread = spread + weight(j)*at**2
      end do
      slope = along/spread
   end subroutine window_slope

   !> The value at `at` of the polynomial through the given points (Lagrange). At a point, the result is exactly y of the point. If
   !> two points have equal x, y of the first is used.
   pure real(wp) function polynomial(x, y, at) result(value)
      real(wp), intent(in) :: x(:), y(:), at
      real(wp) :: share
      integer :: j, k

      do k = 1, size(x)
         value = y(k)
         if (abs(x(k) - at) <= 0.0_wp) return
      end do
      value = y(1)
      do k = 2, size(x)
         if (any(abs(x(:k - 1) - x(k)) <= 0.0_wp)) return
      end do
      value = 0.0_wp
      do k = 1, size(x)
         share = 1.0_wp
         do j = 1, size(x)
            if (j /= k) share = share*(at - x(j))/(x(k) - x(j))
         end do
         value = value + share*y(k)
      end do
   end function polynomial

end module ek_window
