!> The instant steer axis: the line about which a carrier rotates when it steers with its springs at constant length.
!>
!> With a steering driver (a rack) in the model, the rack is moved by a unit: a free rack under a steer moment has no
!> stiffness, so its displacement dominates, and the elastic response of the other parts to the moment is negligible;
!> this limit is the response to a displacement of the rack. Without a rack, a unit steer moment
!> about z on the wheel gives the elastic axis (fixed tie rods, rear axles).
!>
!> Springs are locked by pairs of forces along them, found from a small system of known responses:
!> lengths(0) + A μ = 0. Without springs the heights of the wheel centres are held instead, as for the steering
!> ratio, which is measured on a rig with wheels at fixed heights.
!>
!> Carrier twist (v, ω) at the wheel centre p: the axis is ω/|ω| through p + ω×v/|ω|² (the pitch of the screw is ignored).
module ek_steer_axis
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_units, only: pi
   use ek_rotation, only: cross
   use ek_compliance, only: compliance_t, lock
   use ek_attitude, only: steer_axis_t, steer_axis_of
   implicit none(type, external)
   private
   public :: locked_twist, instant_axis, axis_distances, ride_frequency

   real(wp), parameter :: parallel = 1.0e-9_wp           !! sine of the angle of spin and steer axis: parallel below

   ! Below these a carrier does not rotate: stiffer than any steel about z, or a rack that steers 1e-6 rad per metre
   real(wp), parameter :: least_by_moment = 1.0e-12_wp   !! rad/(N m)
   real(wp), parameter :: least_by_rack = 1.0e-6_wp      !! rad/m

contains

   !> Twist (v, ω) of a wheel's carrier at the wheel centre while it steers, all springs locked or all wheels held.
   !> Equation (S.8) of docs/theory/suspension.md.
   pure function locked_twist(compliance, place, holds_heights) result(twist)
      type(compliance_t), intent(in) :: compliance   !! known
      integer, intent(in) :: place                   !! index of the wheel in it
      logical, intent(in) :: holds_heights           !! hold the heights of the wheel centres instead of the lengths of the springs
      real(wp) :: twist(6), moves(size(compliance%response, 1), 1)
      integer :: k, steer

      steer = 6*place
      if (compliance%has_drive) steer = size(compliance%response, 2)
      moves(:, 1) = compliance%response(:, steer)
      if (compliance%springs == 0 .or. holds_heights) then
         call lock(compliance%response, [(6*k - 3, k=1, compliance%wheels)], moves)
      else
         call lock(compliance%response, [(6*compliance%wheels + k, k=1, compliance%springs)], moves)
      end if
      twist = moves(6*place - 5:6*place, 1)
   end function locked_twist

   !> The instant steer axis of a wheel; is_known is false if the carrier does not rotate, or for a horizontal axis.
   !> Equation (S.9) of docs/theory/suspension.md.
   pure type(steer_axis_t) function instant_axis(compliance, place, side, centre, contact) result(axis)
      type(compliance_t), intent(in) :: compliance     !! known
      integer, intent(in) :: place, side
      real(wp), intent(in) :: centre(3), contact(3)    !! m, at the state
      real(wp) :: twist(6), turn(3), least

      twist = locked_twist(compliance, place, .false.)
      turn = twist(4:6)
      least = merge(least_by_rack, least_by_moment, compliance%has_drive)
      if (norm2(turn) <= least) return
      axis = steer_axis_of(side, centre + cross(turn, twist(1:3))/dot_product(turn, turn), turn, centre, contact)
   end function instant_axis

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

end module ek_steer_axis
