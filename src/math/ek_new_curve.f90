!> Curves through points: the slopes at the points by the kind of a curve, and the cubics between the points.
module ek_new_curve
   use ek_kinds, only: wp
   use ek_curve, only: curve_t
   implicit none(type, external)
   private
   public :: new_curve, curve_kinds, has_points, min_step

   character(*), parameter :: curve_kinds(3) = [character(6) :: 'linear', 'akima', 'cubic']

   real(wp), parameter :: min_step = 1.0e-30_wp   !! smallest distance of two points; with numbers below 1e30 no slope overflows

contains

   !> The curve through points. x must increase strictly, and there must be at least two points (both checked by the reader).
   pure function new_curve(x, y, kind, x_unit, y_unit) result(curve)
      real(wp), intent(in) :: x(:), y(:)
      character(*), intent(in) :: kind         !! one of curve_kinds
      real(wp), intent(in), optional :: x_unit, y_unit   !! by which the curve is multiplied, both above 0
      type(curve_t) :: curve
      real(wp) :: left(size(x) - 1), right(size(x) - 1), chord(size(x) - 1), slope(size(x)), h
      integer :: k, n

      n = size(x)
      chord = (y(2:) - y(:n - 1))/(x(2:) - x(:n - 1))
      left = chord
      right = chord
      if (kind /= 'linear') then
         if (kind == 'akima') slope = akima_slopes(chord)
         if (kind == 'cubic') slope = natural_slopes(x, chord)
         left = slope(:n - 1)
         right = slope(2:)
      end if
      allocate (curve%breaks(n), curve%coefficients(4, n - 1))
      curve%breaks = x
      do k = 1, n - 1
         h = x(k + 1) - x(k)
         curve%coefficients(1, k) = y(k)
         curve%coefficients(2, k) = left(k)
         curve%coefficients(3, k) = (3.0_wp*chord(k) - 2.0_wp*left(k) - right(k))/h
         curve%coefficients(4, k) = (left(k) + right(k) - 2.0_wp*chord(k))/h**2
      end do
      curve%end_value = y(n)
      curve%end_slope = right(n - 1)
      if (.not. present(x_unit)) return
      curve%breaks = x*x_unit
      do k = 1, 4
         curve%coefficients(k, :) = curve%coefficients(k, :)*(y_unit/x_unit**(k - 1))
      end do
      curve%end_value = y(n)*y_unit
      curve%end_slope = right(n - 1)*(y_unit/x_unit)
   end function new_curve

   !> Whether a curve was created from these points and units by new_curve.
   pure logical function has_points(curve, x, y, x_unit, y_unit)
      type(curve_t), intent(in) :: curve
      real(wp), intent(in) :: x(:), y(:)
      real(wp), intent(in) :: x_unit, y_unit
      integer :: n

      n = size(x)
      has_points = .false.
      if (.not. allocated(curve%breaks)) return
      if (size(curve%breaks) /= n) return
      has_points = all(abs(curve%breaks - x*x_unit) <= 0.0_wp) .and. abs(curve%end_value - y(n)*y_unit) <= 0.0_wp .and. &
         all(abs(curve%coefficients(1, :) - y(:n - 1)*y_unit) <= 0.0_wp)
   end function has_points

   !> Slopes d of Akima (1970), eqs. 1, 8 and 9: d = (|m4 − m3| m2 + |m2 − m1| m3)/(|m4 − m3| + |m2 − m1|), with m1 … m4 the slopes
   !> of the two chords on either side. If both differences vanish, d is the mean of m2 and m3. Two chords are extrapolated beyond
   !> each end.
   pure function akima_slopes(chord) result(slope)
      real(wp), intent(in) :: chord(:)
      real(wp) :: slope(size(chord) + 1), m(-1:size(chord) + 2), before, after, least
      integer :: k, n

      n = size(chord)
      m(1:n) = chord
      ! extrapolation of the parabola through the last three points; with two points, of the line
      m(0) = 2.0_wp*m(1) - m(min(2, n))
      m(-1) = 2.0_wp*m(0) - m(1)
      m(n + 1) = 2.0_wp*m(n) - m(max(n - 1, 1))
      m(n + 2) = 2.0_wp*m(n + 1) - m(n)
      least = 1.0e-9_wp*maxval(abs(m))     ! chords that differ only by rounding count as equal
      do k = 1, n + 1
         before = abs(m(k - 1) - m(k - 2))
         after = abs(m(k + 1) - m(k))
         if (before + after > least) then
            slope(k) = (after*m(k - 1) + before*m(k))/(before + after)
         else
            slope(k) = 0.5_wp*(m(k - 1) + m(k))
         end if
      end do
   end function akima_slopes

   !> Slopes d of the natural cubic spline: continuous curvature, zero at the ends. h are the lengths in x and m the slopes of the
   !> chords:
   !>
   !>     d_{k−1}/h_{k−1} + 2 d_k (1/h_{k−1} + 1/h_k) + d_{k+1}/h_k = 3 (m_{k−1}/h_{k−1} + m_k/h_k)
   !>
   !> and 2 d_1 + d_2 = 3 m_1 at the first point, likewise at the last; the tridiagonal system is diagonally dominant and
   !> solved without pivoting.
   pure function natural_slopes(x, chord) result(slope)
      real(wp), intent(in) :: x(:), chord(:)
      real(wp) :: slope(size(x)), diagonal(size(x)), inverse(size(chord)), factor
      integer :: k, n

      n = size(x)
      inverse = 1.0_wp/(x(2:) - x(:n - 1))
      diagonal(1) = 2.0_wp*inverse(1)
      slope(1) = 3.0_wp*chord(1)*inverse(1)
      do k = 2, n
         factor = inverse(k - 1)/diagonal(k - 1)
         diagonal(k) = 2.0_wp*inverse(k - 1) - factor*inverse(k - 1)
         slope(k) = 3.0_wp*chord(k - 1)*inverse(k - 1) - factor*slope(k - 1)
         if (k == n) exit
         diagonal(k) = diagonal(k) + 2.0_wp*inverse(k)
         slope(k) = slope(k) + 3.0_wp*chord(k)*inverse(k)
      end do
      slope(n) = slope(n)/diagonal(n)
      do k = n - 1, 1, -1
         slope(k) = (slope(k) - inverse(k)*slope(k + 1))/diagonal(k)
      end do
   end function natural_slopes

end module ek_new_curve
