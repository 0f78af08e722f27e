!> The attitude of a wheel: toe, camber, steer axis and the rest, from where its carrier is.
!>
!> Frame x rearward, y right, z up; side = −1 left, +1 right. All in SI and radians.
module ek_attitude
   use ek_kinds, only: wp
   use ek_turn, only: pose_t
   use ek_block, only: rotated
   use ek_suspension, only: wheel_t
   implicit none(type, external)
   private
   public :: attitude_t, attitude_of

   !> What one wheel shows at one state. Changes are against design.
   type :: attitude_t
      real(wp) :: centre(3) = 0.0_wp     !! wheel centre, change [m]; z is the wheel travel, bump positive
      real(wp) :: contact(3) = 0.0_wp    !! contact patch, change [m]
      real(wp) :: toe = 0.0_wp           !! rad, positive: front edges inward
      real(wp) :: camber = 0.0_wp        !! rad, positive: top outward
      real(wp) :: track_change = 0.0_wp       !! m, positive outward
      real(wp) :: wheelbase_change = 0.0_wp   !! m, positive rearward
      logical :: has_steer_axis = .false.
      real(wp) :: caster = 0.0_wp               !! rad, positive: top rearward
      real(wp) :: kingpin_inclination = 0.0_wp  !! rad, positive: top inward
      real(wp) :: scrub_radius = 0.0_wp         !! m, positive: axis meets the ground inboard of the patch
      real(wp) :: caster_trail = 0.0_wp         !! m, positive: axis meets the ground ahead of the patch
      real(wp) :: spindle_length = 0.0_wp       !! m, wheel centre to steer axis, lateral at its height, positive outboard
      real(wp) :: spindle_offset = 0.0_wp       !! m, likewise longitudinal, positive: centre behind the axis
   end type attitude_t

contains

   !> Attitude of a wheel whose carrier is now at a pose.
   !>
   !>     toe = atan2(−w_x, side·w_y)       camber = asin(−w_z)        w: spin axis, outboard
   !>     caster = atan2(k_x, k_z)          kingpin = atan2(−side·k_y, k_z)    k: steer axis, upward
   !>
   !> The ground is the level plane through the contact patch. A steer axis that lies level (k_z = 0)
   !> meets it nowhere: scrub radius and trail are then not a number.
   pure function attitude_of(wheel, origin, now) result(attitude)
      type(wheel_t), intent(in) :: wheel
      real(wp), intent(in) :: origin(3)     !! the carrier's reference point at design [m]
      type(pose_t), intent(in) :: now
      type(attitude_t) :: attitude
      real(wp) :: w(3), contact(3), centre(3), lower(3), k(3), foot(3), abeam(3)

      centre = now%r + rotated(now%a, wheel%centre)
      contact = now%r + rotated(now%a, wheel%contact)
      attitude%centre = centre - (origin + wheel%centre)
      attitude%contact = contact - (origin + wheel%contact)
      w = rotated(now%a, wheel%spin)
      attitude%toe = atan2(-w(1), wheel%side*w(2))
      attitude%camber = asin(max(-1.0_wp, min(1.0_wp, -w(3))))
      attitude%track_change = wheel%side*attitude%contact(2)
      attitude%wheelbase_change = attitude%contact(1)
      attitude%has_steer_axis = wheel%has_steer_axis
      if (.not. wheel%has_steer_axis) return

      lower = now%r + rotated(now%a, wheel%steer_axis(:, 1))
      k = rotated(now%a, wheel%steer_axis(:, 2) - wheel%steer_axis(:, 1))
      if (k(3) < 0.0_wp) k = -k
      attitude%caster = atan2(k(1), k(3))
      attitude%kingpin_inclination = atan2(-wheel%side*k(2), k(3))
      if (.not. k(3) > 0.0_wp) then
         attitude%has_steer_axis = .false.
         return
      end if
      foot = lower + k*((contact(3) - lower(3))/k(3))
      attitude%scrub_radius = wheel%side*(contact(2) - foot(2))
      attitude%caster_trail = contact(1) - foot(1)
      abeam = lower + k*((centre(3) - lower(3))/k(3))
      attitude%spindle_length = wheel%side*(centre(2) - abeam(2))
      attitude%spindle_offset = centre(1) - abeam(1)
   end function attitude_of

end module ek_attitude
