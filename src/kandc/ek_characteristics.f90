!> The characteristics of a wheel and of an axle, from the compliance matrix: rates, steer and camber in ride and
!> roll, swing arms, roll centre, compliances, anti features.
!>
!> C(i,j): displacement i per unit load j, 1–6 the wheel centre of this wheel (x y z, rotations about them), global
!> axes. "In phase": both wheels carry the load; "anti phase": the other carries its opposite. Signs of the results are
!> those of the columns toe, camber, caster, steer. With θ the rotation of the carrier and side = −1 left, +1 right:
!>
!>     toe = side θ_z     camber = −side θ_x     caster = θ_y     steer = θ_z        (first order, from δw = θ×w)
!>
!> The patch lies the radius r straight below the wheel centre, whatever the carrier does: it moves by
!> δx − r θ_y, δy + r θ_x, δz, and (Fx, Fy) there is the same at the centre with Mx = r Fy, My = −r Fx.
!>
!> Everything is SI and radians. A quotient whose denominator vanishes is not a number. No suspension is stiffer
!> than a block of steel (some 1e10 N/m), so a compliance below 1e-12 m/N is rounding, and no swing arm longer than a
!> kilometre differs from parallel guidance.
module ek_characteristics
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_suspension, only: axle_t
   implicit none(type, external)
   private
   public :: wheel_characteristics_t, axle_characteristics_t, sway_t
   public :: wheel_characteristics, axle_characteristics, patch_matrix, motion_ratio, quotient

   real(wp), parameter :: least_compliance = 1.0e-12_wp   !! m/N
   real(wp), parameter :: longest_arm = 1.0e3_wp          !! m
   real(wp), parameter, public :: trail = 0.030_wp        !! m: offset of a lateral force behind the patch, about that of a tyre

   !> What a lateral force or an aligning moment does.
   type :: sway_t
      real(wp) :: deflection = 0.0_wp      !! m/N, at the patch; of a moment not used
      real(wp) :: steer = 0.0_wp           !! rad/N, or rad/(N m)
      real(wp) :: camber = 0.0_wp
   end type sway_t

   !> One wheel. Roll: per angle of the axle, positive left wheel up; the second three per roll of the wheel
   !> centres, the first three of the patches, tyres included.
   type :: wheel_characteristics_t
      real(wp) :: wheel_rate = 0.0_wp, ride_rate = 0.0_wp          !! N/m
      real(wp) :: bump_steer = 0.0_wp, bump_toe = 0.0_wp, bump_camber = 0.0_wp, bump_caster = 0.0_wp    !! rad/m
      real(wp) :: roll_steer = 0.0_wp, roll_camber = 0.0_wp, roll_caster = 0.0_wp                       !! rad/rad
      real(wp) :: wheel_roll_steer = 0.0_wp, wheel_roll_camber = 0.0_wp, wheel_roll_caster = 0.0_wp     !! rad/rad
      real(wp) :: side_arm_length = 0.0_wp, front_arm_length = 0.0_wp    !! m
      real(wp) :: side_arm_angle = 0.0_wp      !! rad, positive: the arm rises rearward
      real(wp) :: front_arm_angle = 0.0_wp     !! rad, positive: the arm rises inward
      type(sway_t) :: lateral_in, lateral_anti, lateral_in_trail, lateral_anti_trail, aligning_in, aligning_anti
      real(wp) :: braking_deflection = 0.0_wp, braking_steer = 0.0_wp, braking_caster = 0.0_wp     !! per N rearward
      real(wp) :: traction_deflection = 0.0_wp, traction_steer = 0.0_wp, traction_caster = 0.0_wp  !! per N forward
      real(wp) :: anti_brake = 0.0_wp, anti_drive = 0.0_wp    !! −: anti-dive, anti-lift (drive) or anti-lift (brake), anti-squat
      real(wp) :: fore_aft_stiffness = 0.0_wp, lateral_stiffness = 0.0_wp, vertical_stiffness = 0.0_wp  !! N/m
   end type wheel_characteristics_t

   !> Both wheels together.
   type :: axle_characteristics_t
      real(wp) :: suspension_roll_rate = 0.0_wp, total_roll_rate = 0.0_wp   !! N m/rad
      real(wp) :: roll_centre(2) = 0.0_wp                                   !! y, z [m]
   end type axle_characteristics_t

contains

   !> a/b, not a number where |b| is at most `least`.
   pure real(wp) function quotient(a, b, least)
      real(wp), intent(in) :: a, b, least
      quotient = ieee_value(1.0_wp, ieee_quiet_nan)
      if (abs(b) > least) quotient = a/b
   end function quotient

   !> CP: C seen from points the given radii straight below the wheel centres, six rows and columns a wheel.
   !>
   !>     CP = Bᵀ C B,  B = [I 0; ã I], a = (0, 0, −r): Mx = r Fy, My = −r Fx
   pure function patch_matrix(c, radius) result(cp)
      real(wp), intent(in) :: c(:, :)
      real(wp), intent(in) :: radius(:)      !! of each wheel in the order of C [m]
      real(wp) :: cp(size(c, 1), size(c, 2))
      integer :: w, at

      cp = c
      do w = 1, size(radius)
         at = 6*(w - 1)
         cp(:, at + 1) = cp(:, at + 1) - radius(w)*cp(:, at + 5)
         cp(:, at + 2) = cp(:, at + 2) + radius(w)*cp(:, at + 4)
      end do
      do w = 1, size(radius)
         at = 6*(w - 1)
         cp(at + 1, :) = cp(at + 1, :) - radius(w)*cp(at + 5, :)
         cp(at + 2, :) = cp(at + 2, :) + radius(w)*cp(at + 4, :)
      end do
   end function patch_matrix

   !> What this wheel does when both carry a load (with = 1), or the other the opposite (with = −1).
   pure function phase(c, place, with) result(own)
      real(wp), intent(in) :: c(:, :)
      integer, intent(in) :: place       !! 1 or 2: place of the wheel in C
      real(wp), intent(in) :: with
      real(wp) :: own(6, 6)
      integer :: at, other

      at = 6*(place - 1)
      own = c(at + 1:at + 6, at + 1:at + 6)
      if (size(c, 1) < 12) return
      other = 6 - at
      own = own + with*c(at + 1:at + 6, other + 1:other + 6)
   end function phase

   !> All of one wheel. C and CP are 6×6 (a wheel alone: the other is taken as if it were not there) or 12×12, left
   !> wheel first. Ride rate and the first roll quotients mean something only with tyre rates, the roll quotients
   !> only with two wheels, the anti features only with data of the axle.
   pure function wheel_characteristics(c, cp, place, side, track, tyre_rate, axle) result(is)
      real(wp), intent(in) :: c(:, :), cp(:, :)
      integer, intent(in) :: place             !! of this wheel in C
      integer, intent(in) :: side              !! −1 left, +1 right
      real(wp), intent(in) :: track            !! m
      real(wp), intent(in) :: tyre_rate(:)     !! N/m, in the order of C; 0: not given
      type(axle_t), intent(in) :: axle
      type(wheel_characteristics_t) :: is
      real(wp) :: in(6, 6), anti(6, 6), patch_in(6, 6), patch_anti(6, 6), height, tyre

      in = phase(c, place, 1.0_wp)
      anti = phase(c, place, -1.0_wp)
      patch_in = phase(cp, place, 1.0_wp)
      patch_anti = phase(cp, place, -1.0_wp)

      is%wheel_rate = quotient(1.0_wp, in(3, 3), least_compliance)
      if (all(tyre_rate > 0.0_wp)) is%ride_rate = quotient(1.0_wp, in(3, 3) + 1.0_wp/tyre_rate(place), least_compliance)
      is%bump_steer = quotient(in(6, 3), in(3, 3), least_compliance)
      is%bump_toe = quotient(side*in(6, 3), in(3, 3), least_compliance)
      is%bump_camber = quotient(-side*in(4, 3), in(3, 3), least_compliance)
      is%bump_caster = quotient(in(5, 3), in(3, 3), least_compliance)

      if (size(c, 1) == 12) then
         ! loads +1 left, −1 right: of this wheel −side times the anti-phase column; camber's own −side makes it +1
         height = roll_compliance(c)
         tyre = 0.0_wp
         if (all(tyre_rate > 0.0_wp)) tyre = sum(1.0_wp/tyre_rate)
         is%wheel_roll_steer = quotient(-side*track*anti(6, 3), height, least_compliance)
         is%wheel_roll_camber = quotient(track*anti(4, 3), height, least_compliance)
         is%wheel_roll_caster = quotient(-side*track*anti(5, 3), height, least_compliance)
         is%roll_steer = quotient(-side*track*anti(6, 3), height + tyre, least_compliance)
         is%roll_camber = quotient(track*anti(4, 3), height + tyre, least_compliance)
         is%roll_caster = quotient(-side*track*anti(5, 3), height + tyre, least_compliance)
      end if

      call swing_arm(in(1, 3), in(3, 3), in(5, 3), is%side_arm_length, is%side_arm_angle)
      call swing_arm(-side*anti(2, 3), anti(3, 3), anti(4, 3), is%front_arm_length, is%front_arm_angle)

      is%lateral_in = sway_of(patch_in, 0.0_wp, side)
      is%lateral_anti = sway_of(patch_anti, 0.0_wp, side)
      is%lateral_in_trail = sway_of(patch_in, trail, side)
      is%lateral_anti_trail = sway_of(patch_anti, trail, side)
      is%aligning_in = sway_t(patch_in(2, 6), in(6, 6), -side*in(4, 6))
      is%aligning_anti = sway_t(patch_anti(2, 6), anti(6, 6), -side*anti(4, 6))
      is%braking_deflection = patch_in(1, 1)
      is%braking_steer = patch_in(6, 1)
      is%braking_caster = patch_in(5, 1)
      is%traction_deflection = in(1, 1)      ! forward, per force forward
      is%traction_steer = -in(6, 1)
      is%traction_caster = -in(5, 1)
      call anti_features(in, patch_in, axle, is%anti_brake, is%anti_drive)
      is%fore_aft_stiffness = quotient(1.0_wp, in(1, 1), least_compliance)
      is%lateral_stiffness = quotient(1.0_wp, in(2, 2), least_compliance)
      is%vertical_stiffness = is%wheel_rate
   end function wheel_characteristics

   !> Both wheels: roll rates and roll centre.
   pure function axle_characteristics(c, cp, patches, tyre_rate) result(is)
      real(wp), intent(in) :: c(:, :), cp(:, :)     !! 12×12, left wheel first
      real(wp), intent(in) :: patches(3, 2)         !! left, right [m]
      real(wp), intent(in) :: tyre_rate(:)          !! N/m, 0: not given
      type(axle_characteristics_t) :: is
      real(wp) :: height, track

      track = patches(2, 2) - patches(2, 1)
      height = roll_compliance(c)
      is%suspension_roll_rate = quotient(track**2, height, least_compliance)
      if (all(tyre_rate > 0.0_wp)) is%total_roll_rate = quotient(track**2, height + sum(1.0_wp/tyre_rate), least_compliance)
      is%roll_centre = roll_centre(cp, patches)
   end function axle_characteristics

   !> C33 − C39 − C93 + C99: difference in height of the wheels per force up on the left, down on the right.
   pure real(wp) function roll_compliance(c)
      real(wp), intent(in) :: c(:, :)
      roll_compliance = c(3, 3) - c(3, 9) - c(9, 3) + c(9, 9)
   end function roll_compliance

   !> Length √(dh² + dz²)/|dθ| and angle atan(−dh/dz) of the arm about whose end a wheel centre swings.
   pure subroutine swing_arm(dh, dz, turn, length, angle)
      real(wp), intent(in) :: dh, dz       !! horizontal and vertical displacement [m/N]
      real(wp), intent(in) :: turn         !! rotation [rad/N]
      real(wp), intent(out) :: length, angle
      real(wp) :: way

      way = sqrt(dh**2 + dz**2)
      length = quotient(way, turn, max(way/longest_arm, least_compliance/longest_arm))
      length = abs(length)
      angle = ieee_value(1.0_wp, ieee_quiet_nan)
      if (abs(dz) > least_compliance) angle = atan(-dh/dz)
   end subroutine swing_arm

   !> A lateral force to the right at the patch, its line `behind` the patch: Mz = behind × Fy.
   pure type(sway_t) function sway_of(cp, behind, side) result(sway)
      real(wp), intent(in) :: cp(6, 6)      !! of the patch, in phase or anti phase
      real(wp), intent(in) :: behind        !! m
      integer, intent(in) :: side

      sway%deflection = cp(2, 2) + behind*cp(2, 6)
      sway%steer = cp(6, 2) + behind*cp(6, 6)
      sway%camber = -side*(cp(4, 2) + behind*cp(4, 6))
   end function sway_of

   !> −Zf/Zw of brakes and of drive, per unit of the whole force on the vehicle.
   !>
   !> Braking with a force 1 rearward: this axle's wheels carry half its share each, at the patch, and the load
   !> transfer h/2L more (front) or less (rear). Driving with a force 1 forward: the other way round, at the centre
   !> or the patch. Zf, Zw: what the wheel centres move up under the one and under the other.
   pure subroutine anti_features(in, patch_in, axle, brake, drive)
      real(wp), intent(in) :: in(6, 6), patch_in(6, 6)
      type(axle_t), intent(in) :: axle
      real(wp), intent(out) :: brake, drive
      real(wp) :: share, transfer, lever, least

      brake = 0.0_wp
      drive = 0.0_wp
      if (.not. axle%has_axle) return
      share = axle%brake_share
      if (.not. axle%is_front) share = 1.0_wp - share
      transfer = 0.5_wp*axle%cg_height/axle%wheelbase
      least = least_compliance*transfer
      if (.not. axle%is_front) transfer = -transfer
      lever = in(3, 1)
      if (axle%drives_at_patch) lever = patch_in(3, 1)
      brake = quotient(-0.5_wp*share*patch_in(3, 1), transfer*in(3, 3), least)
      drive = quotient(0.5_wp*axle%drive_share*lever, -transfer*in(3, 3), least)
   end subroutine anti_features

   !> Where the instant axes of both patches in the front view meet: dz (z − z0) + dy (y − y0) = 0 through each, (dy, dz)
   !> the way of the patch in roll. Not a number where the two ways are parallel to 1e-8.
   pure function roll_centre(cp, patches) result(centre)
      real(wp), intent(in) :: cp(:, :), patches(3, 2)
      real(wp) :: centre(2), way(2, 2), right(2), determinant, size_of_both
      integer :: k

      way(:, 1) = [cp(2, 3) - cp(2, 9), cp(3, 3) - cp(3, 9)]
      way(:, 2) = [cp(8, 9) - cp(8, 3), cp(9, 9) - cp(9, 3)]
      do k = 1, 2
         right(k) = dot_product(way(:, k), patches(2:3, k))
      end do
      determinant = way(1, 1)*way(2, 2) - way(2, 1)*way(1, 2)
      size_of_both = norm2(way(:, 1))*norm2(way(:, 2))
      centre = ieee_value(1.0_wp, ieee_quiet_nan)
      if (abs(determinant) <= 1.0e-8_wp*size_of_both .or. size_of_both <= least_compliance**2) return
      centre(1) = (right(1)*way(2, 2) - right(2)*way(2, 1))/determinant
      centre(2) = (way(1, 1)*right(2) - way(1, 2)*right(1))/determinant
   end function roll_centre

   !> d(length)/d(wheel travel) with all wheels travelling alike: the loads f that lift each by one are found
   !> from C_zz f = 1, then the spring changes by its own response to them. Wheels that can only move together
   !> (C_zz singular) take the same load each.
   pure real(wp) function motion_ratio(c, length) result(ratio)
      real(wp), intent(in) :: c(:, :)        !! 6×6 or 12×12
      real(wp), intent(in) :: length(:)      !! of one spring per unit of each load of C [m/N, m/(N m)]
      real(wp) :: determinant

      if (size(c, 1) == 12) then
         determinant = c(3, 3)*c(9, 9) - c(3, 9)*c(9, 3)
         if (abs(determinant) > 1.0e-10_wp*abs(c(3, 3)*c(9, 9))) then
            ratio = quotient(length(3)*(c(9, 9) - c(3, 9)) + length(9)*(c(3, 3) - c(9, 3)), determinant, least_compliance**2)
         else
            ratio = quotient(2.0_wp*(length(3) + length(9)), c(3, 3) + c(3, 9) + c(9, 3) + c(9, 9), least_compliance)
         end if
      else
         ratio = quotient(length(3), c(3, 3), least_compliance)
      end if
   end function motion_ratio

end module ek_characteristics
