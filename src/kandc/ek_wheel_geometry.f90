!> A wheel relative to its steer axis, and ride frequency: pure functions.
!>
!> Frame x rearward, y right, z up; side = −1 left, +1 right. SI and radians.
module ek_wheel_geometry
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_units, only: pi
   use ek_rotation, only: cross
   implicit none(type, external)
   private
   public :: axis_distances, ride_frequency

   real(wp), parameter :: parallel = 1.0e-9_wp        !! sine of the angle of spin and steer axis: parallel below

contains

   !> Distances of a wheel from a steer axis, the line through `point` along `direction`: of the centre and of the patch, never
   !> negative; along the spin axis, from the foot of the common perpendicular, + outboard; length of the common perpendicular,
   !> + spin axis behind the line.
   !>
   !> With d = centre − point, k the unit direction upward, w the spin axis outboard, n = side w×k/|w×k|:
   !>
   !>     centre = |d×k|     patch = |(patch − point)×k|     across = d·n     along = side (d×k)·n/|w×k|
   !>
   !> which solves d = along w + μ k + across n. `along` and `across` are not numbers if w and k are parallel.
   !> Equation (S.10) of docs/theory/suspension.md.
   pure function axis_distances(side, point, direction, centre, patch, spin) result(is)
      integer, intent(in) :: side
      real(wp), intent(in) :: point(3), direction(3)       !! of the line [m, any length, not 0]
      real(wp), intent(in) :: centre(3), patch(3)          !! m
      real(wp), intent(in) :: spin(3)                      !! unit, outboard
      real(wp) :: is(4)                                    !! centre, patch, along, across [m]
      real(wp) :: k(3), n(3), d(3), turn

      k = direction/norm2(direction)
      if (k(3) < 0.0_wp) k = -k
      d = centre - point
      is = ieee_value(1.0_wp, ieee_quiet_nan)
      is(1) = norm2(cross(d, k))
      is(2) = norm2(cross(patch - point, k))
      n = cross(spin, k)
      turn = norm2(n)
      if (turn <= parallel) return
      n = side*n/turn
      is(4) = dot_product(d, n)
      is(3) = side*dot_product(cross(d, k), n)/turn
   end function axis_distances

   !> √(k/m)/2π [Hz]
   pure real(wp) function ride_frequency(rate, mass) result(frequency)
      real(wp), intent(in) :: rate      !! ride rate [N/m]
      real(wp), intent(in) :: mass      !! kg, above 0
      frequency = ieee_value(1.0_wp, ieee_quiet_nan)
      if (rate > 0.0_wp) frequency = sqrt(rate/mass)/(2.0_wp*pi)
   end function ride_frequency

end module ek_wheel_geometry
