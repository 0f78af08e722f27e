!> The characteristics of a wheel, from the compliance matrix: rates, steer and camber in ride and
!> roll, swing arms, compliances, anti features.
!>
!> C(i,j) is displacement i per unit load j at the wheel centres, global axes: x, y, z and the rotations about x, y, z are 1–6 for
!> the left wheel or a single wheel, 7–12 for the right wheel. M is C with the loads at the contact points. CP has the loads and
!> the displacements at the contact points (ek_loaded_wheels). In phase: both wheels carry the load. Anti-phase: the other wheel
!> carries the opposite load. The slopes of steer, toe, camber and caster are the slopes of the columns of these names, by the
!> chain rule of ek_attitude.
!>
!> There are two conditions in the vertical direction: vertical force held (the unchanged matrix), or heights of the wheel centres
!> held (ek_port_response).
!>
!> Everything is SI and radians. A quotient with a vanishing denominator is NaN (ek_loaded_wheels). A swing arm longer than
!> one kilometre counts as parallel guidance: its length and its centre are NaN.
module ek_characteristics
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_suspension, only: axle_t
   use ek_steer_angle, only: steer_gradient
   use ek_attitude, only: camber_gradient, caster_gradient
   use ek_loaded_wheels, only: loaded_t, stand_t, phase, quotient, min_compliance
   use ek_axle_characteristics, only: jacking_forces, roll_compliance
   implicit none(type, external)
   private
   public :: wheel_characteristics_t, response_t, wheel_characteristics, motion_ratio

   real(wp), parameter :: min_rotation = 1.0e-13_wp         !! least compliance in rotation [rad/(N m)]; no part is as stiff as this
   real(wp), parameter :: longest_arm = 1.0e3_wp          !! longest swing arm that has a length and a centre [m]
   real(wp), parameter :: gravity = 9.80665_wp            !! the g of "per g" [m/s²]
   real(wp), parameter, public :: trail = 0.030_wp        !! distance of a lateral force aft of the contact point [m], typical tyre
   integer, parameter, public :: in_phase = 1, anti_phase = 2
   integer, parameter, public :: load_held = 1, height_held = 2

   ! Groups of quantities of a wheel; each is computed if it is asked
   integer, parameter, public :: of_rates = 1, of_bump = 2, of_roll = 3, of_arms = 4, of_forces_load_held = 5, &
      of_forces_height_held = 6, of_jacking = 7, of_stiffness = 8, of_anti_features = 9, wheel_groups = 9

   !> Response of a wheel per unit of an input (m, rad, N or N m).
   type :: response_t
      real(wp) :: patch(3) = 0.0_wp          !! displacement of the contact point [m]
      real(wp) :: centre(3) = 0.0_wp         !! displacement of the wheel centre [m]
      real(wp) :: rotation(3) = 0.0_wp       !! rotation of the carrier about global axes [rad]
      real(wp) :: steer = 0.0_wp, toe = 0.0_wp, camber = 0.0_wp, caster = 0.0_wp   !! changes [rad]; caster 0 without axis points
   end type response_t

   !> Quantities of one wheel. Roll: per angle of the axle, positive left wheel up.
   type :: wheel_characteristics_t
      real(wp) :: wheel_rate = 0.0_wp, ride_rate = 0.0_wp, hop_rate = 0.0_wp      !! N/m
      real(wp) :: single_rate(2) = 0.0_wp      !! rate under load on this wheel only; other wheel: (load, height) held [N/m]
      type(response_t) :: bump                 !! response per m of wheel travel
      type(response_t) :: wheel_roll           !! response per rad of axle roll
      type(response_t) :: roll                 !! response per rad of axle roll including tyre deflection
      real(wp) :: side_arm_length = 0.0_wp, front_arm_length = 0.0_wp    !! swing arms in side and front view [m]
      real(wp) :: side_arm_angle = 0.0_wp      !! rad, positive: the arm rises rearward
      real(wp) :: front_arm_angle = 0.0_wp     !! rad, positive: the arm rises inward
      real(wp) :: side_arm_centre(2) = 0.0_wp  !! centre of the side view swing arm: x, z [m]
      real(wp) :: front_arm_centre(2) = 0.0_wp !! centre of the front view swing arm: y, z [m]
      type(response_t) :: lateral(2, 2), lateral_trail(2, 2)             !! (phase, held): response per N to the right
      type(response_t) :: aligning(2, 2)                                 !! (phase, held): response per N m to the left
      type(response_t) :: braking(2), traction(2)                        !! (held): response per N rearward, forward
      real(wp) :: jacking(2) = 0.0_wp          !! (phase): vertical per lateral force on this wheel [-], contact heights held
      real(wp) :: anti_brake = 0.0_wp, anti_drive = 0.0_wp    !! [-] anti-dive, anti-lift (front); anti-lift, anti-squat (rear)
      real(wp) :: brake_travel = 0.0_wp, drive_travel = 0.0_wp           !! wheel travel per g [m]
      real(wp) :: stiffness(6) = 0.0_wp        !! load per displacement at the wheel centre, loads in phase [N/m, N m/rad]
   end type wheel_characteristics_t

   !> The geometry of a wheel, and the slopes of its angles under small rotations of its carrier about x, y, z.
   type :: reader_t
      real(wp) :: arm(3) = 0.0_wp            !! contact point less wheel centre [m]
      integer :: side = -1
      real(wp) :: steer(3) = 0.0_wp, camber(3) = 0.0_wp, caster(3) = 0.0_wp
   end type reader_t

contains

   !> The geometry of wheel `place` and the slopes of its angles, from which `respond` computes responses under any load.
   pure type(reader_t) function reader_of(stand, place) result(reader)
      type(stand_t), intent(in) :: stand
      integer, intent(in) :: place

      reader%arm = stand%arm(:, place)
      reader%side = stand%axes(place)%side
      reader%steer = steer_gradient(stand%axes(place)%spin)
      reader%camber = camber_gradient(stand%axes(place)%spin)
      if (stand%axes(place)%has_steer_axis) reader%caster = caster_gradient(stand%axes(place)%steer_axis)
   end function reader_of

   !> Computes the response of a wheel whose carrier moves by a twist (displacement of the wheel centre, rotation).
   pure subroutine respond(reader, twist, is)
      type(reader_t), intent(in) :: reader
      real(wp), intent(in) :: twist(6)
      type(response_t), intent(inout) :: is

      is%centre = twist(1:3)
      is%rotation = twist(4:6)
      is%patch(1) = twist(1) + (twist(5)*reader%arm(3) - twist(6)*reader%arm(2))
      is%patch(2) = twist(2) + (twist(6)*reader%arm(1) - twist(4)*reader%arm(3))
      is%patch(3) = twist(3) + (twist(4)*reader%arm(2) - twist(5)*reader%arm(1))
      is%steer = reader%steer(1)*twist(4) + reader%steer(2)*twist(5) + reader%steer(3)*twist(6)
      is%toe = reader%side*is%steer
      is%camber = reader%camber(1)*twist(4) + reader%camber(2)*twist(5) + reader%camber(3)*twist(6)
      is%caster = reader%caster(1)*twist(4) + reader%caster(2)*twist(5) + reader%caster(3)*twist(6)
   end subroutine respond

   !> Computes the response per unit of the denominator `divisor`; NaN if the denominator is at most `least` in magnitude.
   pure subroutine respond_per(reader, twist, divisor, least, is)
      type(reader_t), intent(in) :: reader
      real(wp), intent(in) :: twist(6), divisor, least
      type(response_t), intent(inout) :: is
      real(wp) :: slope(6)

      slope = ieee_value(1.0_wp, ieee_quiet_nan)
      if (abs(divisor) > least) slope = twist/divisor
      call respond(reader, slope, is)
   end subroutine respond_per

   !> Computes the groups of quantities of one wheel that are requested. Ride rate, hop rate and the roll with tyres are defined
   !> only with tyre rates. Roll is defined only with two wheels. Anti-dive, anti-lift and anti-squat are defined only with data of
   !> the axle.
   !> Equation (C.12) of docs/theory/compliance.md.
   pure subroutine wheel_characteristics(loaded, stand, place, axle, is_asked, is)
      type(loaded_t), intent(in) :: loaded
      type(stand_t), intent(in) :: stand
      integer, intent(in) :: place             !! index of this wheel in C
      type(axle_t), intent(in) :: axle
      logical, intent(in) :: is_asked(wheel_groups)
      type(wheel_characteristics_t), intent(inout) :: is
      type(reader_t) :: reader
      real(wp) :: up(6), anti(6), load(6), tyre
      integer :: k, at

      at = 6*(place - 1)
      reader = reader_of(stand, place)
      tyre = stand%tyre_rate(place)
      up = phase(loaded%wheels, loaded%c, place, 3, 1.0_wp)
      if (is_asked(of_rates)) then
         is%wheel_rate = quotient(1.0_wp, up(3), min_compliance)
         if (tyre > 0.0_wp) is%ride_rate = quotient(1.0_wp, up(3) + 1.0_wp/tyre, min_compliance)
         is%hop_rate = is%wheel_rate + tyre
         if (loaded%wheels == 2) call single_rates(loaded%c, at, is%single_rate)
      end if
      if (is_asked(of_stiffness)) then
         do k = 1, 6
            load = phase(loaded%wheels, loaded%c, place, k, 1.0_wp)
            is%stiffness(k) = quotient(1.0_wp, load(k), merge(min_compliance, min_rotation, k <= 3))
         end do
      end if
      if (is_asked(of_bump)) call respond_per(reader, up, up(3), min_compliance, is%bump)
      if (is_asked(of_arms)) then
         anti = phase(loaded%wheels, loaded%c, place, 3, -1.0_wp)
         call swing_arm(up(1), up(3), up(5), is%side_arm_length, is%side_arm_angle)
         call swing_arm(-stand%axes(place)%side*anti(2), anti(3), anti(4), is%front_arm_length, is%front_arm_angle)
         is%side_arm_centre = arm_centre(stand%centre(1, place), stand%centre(3, place), up(1), up(3), up(5), -1.0_wp)
         is%front_arm_centre = arm_centre(stand%centre(2, place), stand%centre(3, place), anti(2), anti(3), anti(4), 1.0_wp)
      end if
      if (is_asked(of_roll) .and. loaded%wheels == 2) call in_roll(loaded, reader, stand, place, is)
      if (is_asked(of_jacking) .and. loaded%wheels == 2) call jacking(loaded%patch, place, is%jacking)
      if (is_asked(of_forces_load_held)) call under_forces(loaded%wheels, loaded%m, loaded%c, reader, place, axle, load_held, is)
      if (is_asked(of_forces_height_held)) call under_forces(loaded%wheels, loaded%m_held, loaded%c_held, reader, place, axle, &
         height_held, is)
      if (is_asked(of_anti_features)) call anti_features(loaded, place, axle, is)
   end subroutine wheel_characteristics

   !> Computes responses to forces at the contact point and at the centre, and to moments.
   pure subroutine under_forces(wheels, m, c, reader, place, axle, held, is)
      integer, intent(in) :: wheels
      real(wp), intent(in) :: m(12, 12), c(12, 12)   !! loads at the contact point and at the centre, displacements at the centre
      type(reader_t), intent(in) :: reader
      integer, intent(in) :: place
      type(axle_t), intent(in) :: axle
      integer, intent(in) :: held                    !! load_held or height_held
      type(wheel_characteristics_t), intent(inout) :: is
      real(wp) :: lateral(6), moment(6), twist(6), with
      integer :: k

      do k = in_phase, wheels      ! a single wheel has no anti-phase loads
         with = 3.0_wp - 2.0_wp*k
         lateral = phase(wheels, m, place, 2, with)
         moment = phase(wheels, c, place, 6, with)
         twist = lateral + trail*moment
         call respond(reader, lateral, is%lateral(k, held))
         call respond(reader, twist, is%lateral_trail(k, held))
         call respond(reader, moment, is%aligning(k, held))
      end do
      twist = phase(wheels, m, place, 1, 1.0_wp)
      if (axle%brakes_at_centre) twist = phase(wheels, c, place, 1, 1.0_wp)
      call respond(reader, twist, is%braking(held))
      twist = phase(wheels, m, place, 1, 1.0_wp)
      if (.not. axle%drives_at_patch) twist = phase(wheels, c, place, 1, 1.0_wp)
      twist = -twist
      call respond(reader, twist, is%traction(held))
   end subroutine under_forces

   !> Computes the stiffness of one wheel under two conditions: load at the other wheel held, and height of the other wheel held.
   pure subroutine single_rates(c, at, rate)
      real(wp), intent(in) :: c(12, 12)
      integer, intent(in) :: at              !! number of rows before the rows of the wheel
      real(wp), intent(out) :: rate(2)
      integer :: own, other

      own = at + 3
      other = 9 - at
      rate(load_held) = quotient(1.0_wp, c(own, own), min_compliance)
      rate(height_held) = ieee_value(1.0_wp, ieee_quiet_nan)
      if (abs(c(other, other)) > min_compliance) rate(height_held) = &
         quotient(1.0_wp, c(own, own) - c(own, other)*c(other, own)/c(other, other), min_compliance)
   end subroutine single_rates

   !> Computes the responses of a wheel to roll, without tyres and, if both tyre rates are given, with tyres.
   !>
   !>     axle roll φ = atan(Δz/t), Δz the difference in height of the contact points: dφ = cos²φ dΔz/t
   !>
   !> Equation (C.12) of docs/theory/compliance.md.
   pure subroutine in_roll(loaded, reader, stand, place, is)
      type(loaded_t), intent(in) :: loaded
      type(reader_t), intent(in) :: reader
      type(stand_t), intent(in) :: stand
      integer, intent(in) :: place
      type(wheel_characteristics_t), intent(inout) :: is
      real(wp) :: twist(6), height, per_height
      integer :: at

      at = 6*(place - 1)
      twist = loaded%m(at + 1:at + 6, 3) - loaded%m(at + 1:at + 6, 9)       ! loads +1 left, −1 right
      height = roll_compliance(loaded%patch)
      per_height = cos(stand%roll)**2/stand%track
      call respond_per(reader, twist, height*per_height, min_compliance*per_height, is%wheel_roll)
      if (.not. minval(stand%tyre_rate) > 0.0_wp) return
      height = height + (1.0_wp/stand%tyre_rate(1) + 1.0_wp/stand%tyre_rate(2))
      call respond_per(reader, twist, height*per_height, min_compliance*per_height, is%roll)
   end subroutine in_roll

   !> Computes the vertical force of the ground on a wheel per lateral force on the same wheel, in phase and anti-phase [-].
   pure subroutine jacking(patch, place, is)
      real(wp), intent(in) :: patch(2:3, 2, 2:3, 2)
      integer, intent(in) :: place
      real(wp), intent(out) :: is(2)
      real(wp) :: lift(2)

      lift = jacking_forces(patch, 1.0_wp)
      is(in_phase) = lift(place)
      lift = jacking_forces(patch, -1.0_wp)
      is(anti_phase) = lift(place)*merge(1.0_wp, -1.0_wp, place == 1)      ! per force on the wheel itself
   end subroutine jacking

   !> Computes the swing arm of a wheel centre: length √(dh² + dz²)/|dθ| and angle atan(−dh/dz).
   !> Equation (S.2) of docs/theory/suspension.md.
   pure subroutine swing_arm(dh, dz, turn, length, angle)
      real(wp), intent(in) :: dh, dz       !! horizontal and vertical displacement [m/N]
      real(wp), intent(in) :: turn         !! rotation [rad/N]
      real(wp), intent(out) :: length, angle
      real(wp) :: way

      way = sqrt(dh**2 + dz**2)
      length = abs(quotient(way, turn, max(way, min_compliance)/longest_arm))
      angle = ieee_value(1.0_wp, ieee_quiet_nan)
      if (abs(dz) > min_compliance) angle = atan(-dh/dz)
   end subroutine swing_arm

   !> The centre (h0, z0) about which the point (h, z) swings in a plane [m]; NaN if it is more than one kilometre away. The point
   !> moves by (dh, dz) while the carrier rotates by ω (`turn`) about the normal. `hand` is 1 if (h, z, normal) is right-handed
   !> as (y, z, x), −1 if it is left-handed as (x, z, y).
   !>
   !>     dh = −hand ω (z − z0),  dz = hand ω (h − h0)
   !>
   !> Equation (S.1) of docs/theory/suspension.md.
   pure function arm_centre(h, z, dh, dz, turn, hand) result(centre)
      real(wp), intent(in) :: h, z, dh, dz, turn, hand
      real(wp) :: centre(2)

      if (abs(turn) <= max(sqrt(dh**2 + dz**2), min_compliance)/longest_arm) then
         centre = ieee_value(1.0_wp, ieee_quiet_nan)
      else
         centre(1) = h - hand*dz/turn
         centre(2) = z + hand*dh/turn
      end if
   end function arm_centre

   !> Computes the ratio −Zf/Zw of braking and of driving, and the wheel travel per g. Zf and Zw are the upward displacements of a
   !> wheel centre under the longitudinal force and under the load transfer, per unit of the whole force on the vehicle.
   !>
   !> Braking is a force of 1 rearward. Each wheel of this axle carries half the share of the axle, and the load transfer h/2L, added
   !> (front) or removed (rear). The force acts at the contact point, or at the wheel centre if the body takes the brake torque.
   !> Driving is a force of 1 forward, at the wheel centre or the contact point; all signs are opposite. The travel per g is Zf + Zw
   !> times the weight of the car.
   !> Equations (S.11), (S.12), (S.13) of docs/theory/suspension.md.
   pure subroutine anti_features(loaded, place, axle, is)
      type(loaded_t), intent(in) :: loaded
      integer, intent(in) :: place
      type(axle_t), intent(in) :: axle
      type(wheel_characteristics_t), intent(inout) :: is
      real(wp) :: rearward(6), upward(6), at_centre(6), share, transfer, lever, brake, least

      if (.not. axle%has_axle) return
      rearward = phase(loaded%wheels, loaded%m, place, 1, 1.0_wp)
      upward = phase(loaded%wheels, loaded%m, place, 3, 1.0_wp)
      at_centre = phase(loaded%wheels, loaded%c, place, 1, 1.0_wp)
      share = axle%brake_share
      if (.not. axle%is_front) share = 1.0_wp - share
      transfer = 0.5_wp*axle%cg_height/axle%wheelbase
      least = min_compliance*transfer
      if (.not. axle%is_front) transfer = -transfer
      lever = at_centre(3)
      if (axle%drives_at_patch) lever = rearward(3)
      brake = rearward(3)
      if (axle%brakes_at_centre) brake = at_centre(3)
      is%anti_brake = quotient(-0.5_wp*share*brake, transfer*upward(3), least)
      is%anti_drive = quotient(0.5_wp*axle%drive_share*lever, -transfer*upward(3), least)
      is%brake_travel = axle%mass*gravity*(transfer*upward(3) + 0.5_wp*share*brake)
      is%drive_travel = axle%mass*gravity*(-transfer*upward(3) - 0.5_wp*axle%drive_share*lever)
   end subroutine anti_features

   !> Motion ratio d(length)/d(wheel travel) with equal travel of all wheels. The loads f that lift each wheel by 1 m follow from
   !> C_zz f = 1; the change of length is the response of the spring to these loads. Wheels that can only move together (C_zz
   !> singular) carry equal loads.
   !> Equation (C.13) of docs/theory/compliance.md.
   pure real(wp) function motion_ratio(c, length) result(ratio)
      real(wp), intent(in) :: c(:, :)        !! 6×6 or 12×12
      real(wp), intent(in) :: length(:)      !! length of one spring per unit of the vertical load on each wheel [m/N]
      real(wp) :: determinant

      if (size(c, 1) == 12) then
         determinant = c(3, 3)*c(9, 9) - c(3, 9)*c(9, 3)
         if (abs(determinant) > 1.0e-10_wp*abs(c(3, 3)*c(9, 9))) then
            ratio = quotient(length(1)*(c(9, 9) - c(3, 9)) + length(2)*(c(3, 3) - c(9, 3)), determinant, min_compliance**2)
         else
            ratio = quotient(2.0_wp*(length(1) + length(2)), c(3, 3) + c(3, 9) + c(9, 3) + c(9, 9), min_compliance)
         end if
      else
         ratio = quotient(length(1), c(3, 3), min_compliance)
      end if
   end function motion_ratio

end module ek_characteristics
