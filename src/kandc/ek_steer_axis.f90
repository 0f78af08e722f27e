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
   use ek_kinds, only: wp
   use ek_rotation, only: cross
   use ek_compliance, only: compliance_t
   use ek_attitude, only: steer_axis_t, steer_axis_of
   implicit none(type, external)
   private
   public :: locked_twist, instant_axis

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
      real(wp) :: twist(6)
      integer :: locked(max(compliance%springs, compliance%wheels)), n, k, steer, at
      real(wp) :: force(size(locked))

      n = compliance%springs
      do k = 1, n
         locked(k) = 6*compliance%wheels + k
      end do
      if (n == 0 .or. holds_heights) then
         n = compliance%wheels
         do k = 1, n
            locked(k) = 6*k - 3
         end do
      end if
      at = 6*(place - 1)
      steer = at + 6
      if (compliance%has_drive) steer = size(compliance%response, 2)
      call lock(compliance%response, locked(:n), steer, force(:n))
      twist = compliance%response(at + 1:at + 6, steer)
      do k = 1, n
         twist = twist + force(k)*compliance%response(at + 1:at + 6, locked(k))
      end do
   end function locked_twist

   !> Forces at some ports that undo their displacements under a load: A μ = −b by elimination, largest pivot first.
   !>
   !> A port that cannot move once others are locked (two springs on one arm) has no pivot left: below 1e-9
   !> of its own compliance is rounding, and its force remains 0.
   !> Equation (S.8) of docs/theory/suspension.md.
   pure subroutine lock(response, locked, load, force)
      real(wp), intent(in) :: response(:, :)
      integer, intent(in) :: locked(:), load
      real(wp), intent(out) :: force(:)
      real(wp) :: a(size(locked), size(locked) + 1), own(size(locked)), row(size(locked) + 1)
      logical :: is_done(size(locked))
      integer :: n, k, j, pivot

      n = size(locked)
      do k = 1, n
         a(:, k) = response(locked, locked(k))
         own(k) = abs(a(k, k))
      end do
      a(:, n + 1) = -response(locked, load)
      is_done = .false.
      force = 0.0_wp
      do k = 1, n
         pivot = 0
         do j = 1, n
            if (is_done(j) .or. abs(a(j, j)) <= 1.0e-9_wp*own(j) .or. own(j) <= tiny(own)) cycle
            if (pivot == 0) pivot = j
            if (abs(a(j, j)) > abs(a(pivot, pivot))) pivot = j
         end do
         if (pivot == 0) exit
         is_done(pivot) = .true.
         row = a(pivot, :)/a(pivot, pivot)
         do j = 1, n
            if (j /= pivot) a(j, :) = a(j, :) - a(j, pivot)*row
         end do
         a(pivot, :) = row
      end do
      do k = 1, n
         if (is_done(k)) force(k) = a(k, n + 1)
      end do
   end subroutine lock

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

end module ek_steer_axis
