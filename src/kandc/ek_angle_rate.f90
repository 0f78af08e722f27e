!> Derivatives of the angles of a wheel with respect to a small rotation θ of its carrier about global axes, for the columns
!> steer, toe, camber and caster as defined in ek_attitude.
!>
!> The spin axis w and the steer axis k are fixed to the carrier, so δw = θ×w and δk = θ×k. By the chain rule, exact for
!> any attitude of the wheel (side = −1 left, +1 right; h² = w_x² + w_y²):
!>
!>     steer  = side·atan2(−w_x, side·w_y):   δsteer  = θ_z − w_z (θ_x w_x + θ_y w_y)/h²
!>     toe    = side·steer
!>     camber = asin(−w_z):                   δcamber = (θ_y w_x − θ_x w_y)/h
!>     caster = atan2(k_x, k_z):              δcaster = θ_y − k_y (θ_x k_x + θ_z k_z)/(k_x² + k_z²)
!>
!> Degenerate: a vertical spin axis has no toe, a steer axis along y no caster; the quotients are then
!> infinite or not a number, as the columns themselves are discontinuous there.
module ek_angle_rate
   use ek_kinds, only: wp
   use ek_turn, only: pose_t
   use ek_block, only: rotated
   use ek_suspension, only: wheel_t
   use ek_steer_angle, only: steer_rate
   implicit none(type, external)
   private
   public :: axes_t, axes_of, toe_rate, camber_rate, caster_rate

   !> The directions of a wheel at a state, global axes.
   type :: axes_t
      integer :: side = -1                                     !! −1 left, +1 right
      real(wp) :: spin(3) = [0.0_wp, -1.0_wp, 0.0_wp]          !! unit, outboard
      logical :: has_steer_axis = .false.                      !! the deck gives two points of the steer axis
      real(wp) :: steer_axis(3) = [0.0_wp, 0.0_wp, 1.0_wp]     !! of any length
   end type axes_t

contains

   !> The axes of a wheel whose carrier is at a pose.
   pure type(axes_t) function axes_of(wheel, pose) result(axes)
      type(wheel_t), intent(in) :: wheel
      type(pose_t), intent(in) :: pose

      axes%side = wheel%side
      axes%spin = rotated(pose%a, wheel%spin)
      axes%has_steer_axis = wheel%has_steer_axis
      if (wheel%has_steer_axis) axes%steer_axis = rotated(pose%a, wheel%steer_axis(:, 2) - wheel%steer_axis(:, 1))
   end function axes_of

   !> Change of toe [rad, positive inward].
   !> Equation (C.10) of docs/theory/compliance.md.
   pure real(wp) function toe_rate(axes, turn) result(rate)
      type(axes_t), intent(in) :: axes
      real(wp), intent(in) :: turn(3)
      rate = axes%side*steer_rate(axes%spin, turn)
   end function toe_rate

   !> Change of camber [rad, positive: top outward].
   !> Equation (C.11) of docs/theory/compliance.md.
   pure real(wp) function camber_rate(axes, turn) result(rate)
      type(axes_t), intent(in) :: axes
      real(wp), intent(in) :: turn(3)
      rate = (turn(2)*axes%spin(1) - turn(1)*axes%spin(2))/sqrt(axes%spin(1)**2 + axes%spin(2)**2)
   end function camber_rate

   !> Change of the caster of the geometric steer axis [rad, positive: top rearward].
   !> Equation (C.11) of docs/theory/compliance.md.
   pure real(wp) function caster_rate(axes, turn) result(rate)
      type(axes_t), intent(in) :: axes
      real(wp), intent(in) :: turn(3)
      associate (k => axes%steer_axis)
         rate = turn(2) - k(2)*(turn(1)*k(1) + turn(3)*k(3))/(k(1)**2 + k(3)**2)
      end associate
   end function caster_rate

end module ek_angle_rate
