!> A curve through points: the law of a rubber bushing, a progressive spring or a bump stop.
!>
!> Between the points: piecewise cubics y = c1 + c2 t + c3 t² + c4 t³, t = x − x_k. Outside the points: straight lines with
!> the end slopes. The kinds differ only in the slopes d_k at the points (`linear` has two slopes at each point, left and right):
!>
!> | kind   | slopes                                                              | smooth |
!> |--------|---------------------------------------------------------------------|--------|
!> | linear | slopes of the chords; corners remain                                | C0     |
!> | akima  | weighted means of neighbouring chords: H. Akima, J. ACM 17 (1970) 589–602 | C1 |
!> | cubic  | natural spline: zero curvature at the ends, continuous with the straight line | C2 |
!>
!> An Akima curve depends on five neighbouring points: a distant corner causes no oscillation, and flat data remain flat.
module ek_curve
   use ek_kinds, only: wp
   use ek_number, only: num, mask, piece, zero, one, some, every, pieces_below, entry
   use ek_contract, only: are_checked, require
   implicit none(type, external)
   private
   public :: curve_t, copy_curve, look_up_curve, slopes_between

   !> A curve, in the units of its points.
   type :: curve_t
      character(:), allocatable :: name            !! name for messages; may be unallocated
      real(num), allocatable :: breaks(:)           !! x of the n points, increasing
      real(num), allocatable :: coefficients(:, :)  !! (4, n−1): c1 … c4 of each piece
      real(num) :: end_value = zero               !! y of the last point
      real(num) :: end_slope = zero               !! slope beyond the last point
   end type curve_t

contains

   !> Copies the numbers of a curve to another curve. The memory of the latter is used again if the number of points is equal.
   pure subroutine copy_curve(from, to)
      type(curve_t), intent(in) :: from
      type(curve_t), intent(inout) :: to          !! in this case the name is unchanged
      logical :: is_alike

      is_alike = allocated(to%breaks)
      if (is_alike) is_alike = size(to%breaks) == size(from%breaks)
      if (.not. is_alike) then
         to = from
         return
      end if
      to%breaks(:) = from%breaks
      to%coefficients(:, :) = from%coefficients
      to%end_value = from%end_value
      to%end_slope = from%end_slope
   end subroutine copy_curve

   !> Finds the value and the slope at x. At a corner of a linear curve, the slope is the slope to the right.
   pure subroutine look_up_curve(curve, x, value, slope)
      type(curve_t), intent(in) :: curve
      real(num), intent(in) :: x
      real(num), intent(out) :: value, slope
      real(num) :: t, v, s, c2, c3, c4
      logical(mask) :: is_beyond, is_before, is_outside
      integer(piece) :: k
      integer :: n

      if (are_checked) call require(allocated(curve%breaks), 'look_up_curve: the curve has no points')
      n = size(curve%breaks)
      t = x - curve%breaks(n)
      is_beyond = t >= 0.0_wp
      value = curve%end_value + curve%end_slope*t
      slope = curve%end_slope
      if (every(is_beyond)) return
      t = x - curve%breaks(1)
      is_before = t < 0.0_wp
      if (some(is_before)) then
         v = curve%coefficients(1, 1) + curve%coefficients(2, 1)*t
         value = merge(v, value, is_before)
         slope = merge(curve%coefficients(2, 1), slope, is_before)
      end if
      is_outside = is_beyond .or. is_before
      if (every(is_outside)) return
      t = merge(curve%breaks(1), x, is_outside)
      k = pieces_below(curve%breaks(:n - 1), t)
      t = t - entry(curve%breaks, k)
      c2 = entry(curve%coefficients(2, :), k)
      c3 = entry(curve%coefficients(3, :), k)
      c4 = entry(curve%coefficients(4, :), k)
      v = entry(curve%coefficients(1, :), k) + t*(c2 + t*(c3 + t*c4))
      s = c2 + t*(2.0_wp*c3 + t*(3.0_wp*c4))
      value = merge(value, v, is_outside)
      slope = merge(slope, s, is_outside)
   end subroutine look_up_curve

   !> Finds the smallest and the largest slope between two abscissae.
   pure subroutine slopes_between(curve, from, to, least, most)
      type(curve_t), intent(in) :: curve
      real(num), intent(in) :: from, to
      real(num), intent(out) :: least, most
      real(num) :: low, high, left, right, apex, c2, c3, c4, at_left, at_apex, at_right
      logical(mask) :: is_in_reach, is_straight
      integer :: k, n

      low = min(from, to)
      high = max(from, to)
      least = huge(1.0_wp)
      most = -huge(1.0_wp)
      n = size(curve%breaks)
      is_in_reach = low <= curve%breaks(1)
      least = merge(curve%coefficients(2, 1), least, is_in_reach)
      most = merge(curve%coefficients(2, 1), most, is_in_reach)
      is_in_reach = high >= curve%breaks(n)
      least = merge(min(least, curve%end_slope), least, is_in_reach)
      most = merge(max(most, curve%end_slope), most, is_in_reach)
      do k = 1, n - 1
         left = max(low, curve%breaks(k)) - curve%breaks(k)
         right = min(high, curve%breaks(k + 1)) - curve%breaks(k)
         is_in_reach = left <= right
         if (.not. some(is_in_reach)) cycle
         c2 = curve%coefficients(2, k)
         c3 = curve%coefficients(3, k)
         c4 = curve%coefficients(4, k)
         is_straight = abs(c4) <= 0.0_wp          ! the slope
         apex = min(max(-c3/(3.0_wp*merge(one, c4, is_straight)), left), right)
         apex = merge(left, apex, is_straight)
         at_left = c2 + left*(2.0_wp*c3 + 3.0_wp*left*c4)
         at_apex = c2 + apex*(2.0_wp*c3 + 3.0_wp*apex*c4)
         at_right = c2 + right*(2.0_wp*c3 + 3.0_wp*right*c4)
         least = merge(min(least, min(min(at_left, at_apex), at_right)), least, is_in_reach)
         most = merge(max(most, max(max(at_left, at_apex), at_right)), most, is_in_reach)
      end do
   end subroutine slopes_between

end module ek_curve
