!> The characteristics of a wheel and of an axle, from the compliance matrix: rates, steer and camber in ride and
!> roll, swing arms, roll centre, compliances, anti features.
!>
!> C(i,j): displacement i per unit load j, 1–6 the wheel centre of this wheel (x y z, rotations about them), global
!> axes. M is C with the loads at the contact points, CP with the displacements there as well (ek_compliance).
!> Parallel (in phase): both wheels carry the load; opposed (anti phase): the other carries the opposite load. The
!> slopes of steer, toe, camber and caster are those of the columns of that name, by the chain rule of ek_attitude.
!>
!> Two conditions in the vertical direction: vertical force held (the unchanged matrix), or heights of the wheel centres held
!> (`hold` of ek_compliance).
!>
!> Everything is SI and radians. A quotient with a vanishing denominator is not a number. No suspension is stiffer
!> than a block of steel (about 1e10 N/m), so a compliance below 1e-12 m/N is rounding, and a swing arm longer than one
!> kilometre is equivalent to parallel guidance.
module ek_characteristics
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_rotation, only: cross
   use ek_suspension, only: axle_t
   use ek_steer_angle, only: steer_rate
   use ek_attitude, only: axes_t, toe_rate, camber_rate, caster_rate
   use ek_compliance, only: load_at_patch, read_at_patch, hold
   implicit none(type, external)
   private
   public :: wheel_characteristics_t, axle_characteristics_t, response_t, stand_t
   public :: wheel_characteristics, axle_characteristics, motion_ratio, quotient

   real(wp), parameter :: min_compliance = 1.0e-12_wp   !! m/N
   real(wp), parameter :: min_rotation = 1.0e-13_wp         !! rad/(N m): its inverse is stiffer than any block of steel
   real(wp), parameter :: longest_arm = 1.0e3_wp          !! m
   real(wp), parameter :: gravity = 9.80665_wp            !! m/s², the g of "per g"
   real(wp), parameter, public :: trail = 0.030_wp        !! m: distance of a lateral force behind the patch, typical of a tyre
   integer, parameter, public :: in_phase = 1, anti_phase = 2
   integer, parameter, public :: load_held = 1, height_held = 2

   !> Positions of the wheels at a state, in the order of C.
   type :: stand_t
      type(axes_t) :: axes(2)
      real(wp) :: centre(3, 2) = 0.0_wp      !! wheel centres [m]
      real(wp) :: arm(3, 2) = 0.0_wp         !! contact point less wheel centre [m]
      real(wp) :: tyre_rate(2) = 0.0_wp      !! N/m; 0: not given
      real(wp) :: track = 0.0_wp             !! distance of the contact points at design [m]
      real(wp) :: roll = 0.0_wp              !! axle roll at the state [rad]
   end type stand_t

   !> Response of a wheel per unit of an input (m, rad, N or N m).
   type :: response_t
      real(wp) :: patch(3) = 0.0_wp          !! displacement of the contact point [m]
      real(wp) :: centre(3) = 0.0_wp         !! of the wheel centre [m]
      real(wp) :: rotation(3) = 0.0_wp       !! of the carrier about global axes [rad]
      real(wp) :: steer = 0.0_wp, toe = 0.0_wp, camber = 0.0_wp, caster = 0.0_wp   !! rad; caster only of a geometric axis
   end type response_t

   !> Quantities of one wheel. Roll: per angle of the axle, positive left wheel up.
   type :: wheel_characteristics_t
      real(wp) :: wheel_rate = 0.0_wp, ride_rate = 0.0_wp, hop_rate = 0.0_wp      !! N/m
      real(wp) :: single_rate(2) = 0.0_wp      !! load on this wheel only; (load, height) of the other wheel held [N/m]
      type(response_t) :: bump                 !! per m of wheel travel
      type(response_t) :: wheel_roll           !! per rad of axle roll
      type(response_t) :: roll                 !! per rad of axle roll including tyre deflection
      real(wp) :: side_arm_length = 0.0_wp, front_arm_length = 0.0_wp    !! m
      real(wp) :: side_arm_angle = 0.0_wp      !! rad, positive: the arm rises rearward
      real(wp) :: front_arm_angle = 0.0_wp     !! rad, positive: the arm rises inward
      real(wp) :: side_arm_centre(2) = 0.0_wp  !! x, z [m]
      real(wp) :: front_arm_centre(2) = 0.0_wp !! y, z [m]
      type(response_t) :: lateral(2, 2), lateral_trail(2, 2)             !! (phase, held), per N to the right
      type(response_t) :: aligning(2, 2)                                 !! (phase, held), per N m to the left
      type(response_t) :: braking(2), traction(2)                        !! (held), per N rearward, forward
      real(wp) :: jacking(2) = 0.0_wp          !! (phase): vertical force per lateral force, patch heights held
      real(wp) :: anti_brake = 0.0_wp, anti_drive = 0.0_wp    !! −: anti-dive, anti-lift (drive) or anti-lift (brake), anti-squat
      real(wp) :: brake_travel = 0.0_wp, drive_travel = 0.0_wp           !! wheel travel per g [m]
      real(wp) :: stiffness(6) = 0.0_wp        !! 1/C(i,i), parallel loads, at the wheel centre [N/m, N m/rad]
   end type wheel_characteristics_t

   !> Quantities of both wheels together.
   type :: axle_characteristics_t
      real(wp) :: suspension_roll_rate = 0.0_wp, total_roll_rate = 0.0_wp, tramp_rate = 0.0_wp   !! N m/rad
      real(wp) :: roll_centre(2) = 0.0_wp, tyre_roll_centre(2) = 0.0_wp     !! y, z [m]
      real(wp) :: force_roll_centre = 0.0_wp                                !! height above the contact points [m]
   end type axle_characteristics_t

contains

   !> a/b, not a number where |b| is at most `least`.
   elemental real(wp) function quotient(a, b, least)
      real(wp), intent(in) :: a, b, least
      quotient = ieee_value(1.0_wp, ieee_quiet_nan)
      if (abs(b) > least) quotient = a/b
   end function quotient

   !> Response of this wheel if both carry a load (with = 1), or the other the opposite one (with = −1).
   !> Equation (C.8) of docs/theory/compliance.md.
   pure function phase(c, place, with) result(own)
      real(wp), intent(in) :: c(:, :)
      integer, intent(in) :: place       !! 1 or 2: index of the wheel in C
      real(wp), intent(in) :: with
      real(wp) :: own(6, 6)
      integer :: at, other

      at = 6*(place - 1)
      own = c(at + 1:at + 6, at + 1:at + 6)
      if (size(c, 1) < 12) return
      other = 6 - at
      own = own + with*c(at + 1:at + 6, other + 1:other + 6)
   end function phase

   !> The response of a wheel whose carrier moves by a twist (displacement of the wheel centre, rotation).
   pure type(response_t) function respond(stand, place, twist) result(is)
      type(stand_t), intent(in) :: stand
      integer, intent(in) :: place
      real(wp), intent(in) :: twist(6)

      is%centre = twist(1:3)
      is%rotation = twist(4:6)
      is%patch = twist(1:3) + cross(twist(4:6), stand%arm(:, place))
      is%steer = steer_rate(stand%axes(place)%spin, twist(4:6))
      is%toe = toe_rate(stand%axes(place), twist(4:6))
      is%camber = camber_rate(stand%axes(place), twist(4:6))
      if (stand%axes(place)%has_steer_axis) is%caster = caster_rate(stand%axes(place), twist(4:6))
   end function respond

   !> All quantities of one wheel. C is 6×6 (a single wheel, without the other) or 12×12, left wheel first. Ride and hop rate
   !> and the roll with tyres are defined only with tyre rates, roll only with two wheels, anti-dive, anti-lift and anti-squat
   !> only with data of the axle.
   !> Equation (C.12) of docs/theory/compliance.md.
   pure function wheel_characteristics(c, stand, place, axle) result(is)
      real(wp), intent(in) :: c(:, :)
      type(stand_t), intent(in) :: stand
      integer, intent(in) :: place             !! index of this wheel in C
      type(axle_t), intent(in) :: axle
      type(wheel_characteristics_t) :: is
      real(wp) :: m(size(c, 1), size(c, 1)), cp(size(c, 1), size(c, 1)), c_held(size(c, 1), size(c, 1)), &
         m_held(size(c, 1), size(c, 1)), in(6, 6), anti(6, 6), tyre
      integer :: k, wheels

      wheels = size(c, 1)/6
      m = load_at_patch(c, stand%arm(:, :wheels))
      cp = read_at_patch(m, stand%arm(:, :wheels))
      c_held = hold(c, c)
      m_held = hold(c, m)
      in = phase(c, place, 1.0_wp)
      anti = phase(c, place, -1.0_wp)
      tyre = stand%tyre_rate(place)

      is%stiffness = quotient(1.0_wp, [(in(k, k), k=1, 6)], [(merge(min_compliance, min_rotation, k <= 3), k=1, 6)])
      is%wheel_rate = is%stiffness(3)
      if (tyre > 0.0_wp) is%ride_rate = quotient(1.0_wp, in(3, 3) + 1.0_wp/tyre, min_compliance)
      is%hop_rate = is%wheel_rate + tyre
      is%bump = respond(stand, place, quotient(in(:, 3), in(3, 3), min_compliance))
      call swing_arm(in(1, 3), in(3, 3), in(5, 3), is%side_arm_length, is%side_arm_angle)
      call swing_arm(-stand%axes(place)%side*anti(2, 3), anti(3, 3), anti(4, 3), is%front_arm_length, is%front_arm_angle)
      is%side_arm_centre = arm_centre(stand%centre([1, 3], place), in([1, 3], 3), in(5, 3), -1.0_wp)
      is%front_arm_centre = arm_centre(stand%centre([2, 3], place), anti([2, 3], 3), anti(4, 3), 1.0_wp)
      if (wheels == 2) call in_roll(c, m, cp, stand, place, is)

      do k = 1, wheels      ! a single wheel has no opposed loads
         call loads(in_phase + k - 1, load_held, phase(m, place, 3.0_wp - 2.0_wp*k), phase(c, place, 3.0_wp - 2.0_wp*k), is)
         call loads(in_phase + k - 1, height_held, phase(m_held, place, 3.0_wp - 2.0_wp*k), &
            phase(c_held, place, 3.0_wp - 2.0_wp*k), is)
      end do
      call anti_features(in, phase(m, place, 1.0_wp), axle, is)

   contains

      !> Response to forces at the patch and at the centre, and to moments. m, c: loads at the patch and at the centre,
      !> displacements at the centre.
      pure subroutine loads(in, held, m, c, is)
         integer, intent(in) :: in, held        !! phase, condition
         real(wp), intent(in) :: m(6, 6), c(6, 6)
         type(wheel_characteristics_t), intent(inout) :: is   ! a pure procedure may not define a variable of its host

         is%lateral(in, held) = respond(stand, place, m(:, 2))
         is%lateral_trail(in, held) = respond(stand, place, m(:, 2) + trail*m(:, 6))
         is%aligning(in, held) = respond(stand, place, c(:, 6))
         if (in == anti_phase) return
         is%braking(held) = respond(stand, place, m(:, 1))
         is%traction(held) = respond(stand, place, -c(:, 1))
         if (axle%drives_at_patch) is%traction(held) = respond(stand, place, -m(:, 1))
      end subroutine loads

   end function wheel_characteristics

   !> Quantities that need two wheels: roll, the stiffness of one of them, jacking.
   !>
   !>     axle roll φ = atan(Δz/t), Δz the difference in height of the contact points: dφ = cos²φ dΔz/t
   !>
   !> Equation (C.12) of docs/theory/compliance.md.
   pure subroutine in_roll(c, m, cp, stand, place, is)
      real(wp), intent(in) :: c(12, 12), m(12, 12), cp(12, 12)
      type(stand_t), intent(in) :: stand
      integer, intent(in) :: place
      type(wheel_characteristics_t), intent(inout) :: is
      real(wp) :: twist(6), height, per_height, lift(2)
      integer :: at, other

      at = 6*(place - 1)
      other = 6 - at
      twist = m(at + 1:at + 6, 3) - m(at + 1:at + 6, 9)       ! loads +1 left, −1 right
      height = roll_compliance(cp)
      per_height = cos(stand%roll)**2/stand%track
      is%wheel_roll = respond(stand, place, quotient(twist, height*per_height, min_compliance*per_height))
      if (all(stand%tyre_rate > 0.0_wp)) is%roll = respond(stand, place, &
         quotient(twist, (height + sum(1.0_wp/stand%tyre_rate))*per_height, min_compliance*per_height))
      is%single_rate(load_held) = quotient(1.0_wp, c(at + 3, at + 3), min_compliance)
      is%single_rate(height_held) = ieee_value(1.0_wp, ieee_quiet_nan)
      if (abs(c(other + 3, other + 3)) > min_compliance) is%single_rate(height_held) = quotient(1.0_wp, &
         c(at + 3, at + 3) - c(at + 3, other + 3)*c(other + 3, at + 3)/c(other + 3, other + 3), min_compliance)
      lift = jacking_forces(cp, [1.0_wp, 1.0_wp])
      is%jacking(in_phase) = lift(place)
      lift = jacking_forces(cp, [1.0_wp, -1.0_wp])
      is%jacking(anti_phase) = lift(place)*merge(1.0_wp, -1.0_wp, place == 1)      ! per force on the wheel itself
   end subroutine in_roll

   !> Axle quantities: roll rates and roll centres.
   !>
   !> The roll moment is ½ t (F left − F right), so the pair of unit forces makes the moment t, and its slope over axle roll is
   !> t²/(cos²φ Δ), Δ as in in_roll.
   !>
   !> Force-based roll centre (W. C. Mitchell, "Asymmetric roll centers", SAE 983085; Milliken, Race Car Vehicle Dynamics, ch. 17):
   !> the height at which the lateral forces do not roll the body. With the patches held at their heights, a unit force to the
   !> right at each of them causes the vertical forces V of the ground: 2 h + y_left V_left + y_right V_right = 0.
   !> Equation (C.12) of docs/theory/compliance.md.
   !> Equation (S.6) of docs/theory/suspension.md.
   pure function axle_characteristics(c, stand) result(is)
      real(wp), intent(in) :: c(:, :)               !! 12×12, left wheel first
      type(stand_t), intent(in) :: stand
      type(axle_characteristics_t) :: is
      real(wp) :: cp(12, 12), patch(3, 2), height, moment, lift(2)
      real(wp) :: wheel(2), tyre(2)      ! compliances, wheel under opposed loads [m/N]

      cp = read_at_patch(load_at_patch(c, stand%arm), stand%arm)
      patch = stand%centre + stand%arm
      height = roll_compliance(cp)
      moment = (stand%track/cos(stand%roll))**2
      is%suspension_roll_rate = quotient(moment, height, min_compliance)
      is%roll_centre = roll_centre(cp, patch, [0.0_wp, 0.0_wp])
      if (all(stand%tyre_rate > 0.0_wp)) then
         tyre = 1.0_wp/stand%tyre_rate
         is%total_roll_rate = quotient(moment, height + sum(tyre), min_compliance)
         ! each wheel's suspension and tyre in parallel support the unsprung masses in tramp
         wheel = [cp(3, 3) - cp(3, 9), cp(9, 9) - cp(9, 3)]
         is%tramp_rate = ieee_value(1.0_wp, ieee_quiet_nan)
         if (minval(abs(wheel + tyre)) > min_compliance) &
            is%tramp_rate = quotient(moment, sum(wheel*tyre/(wheel + tyre)), min_compliance)
         is%tyre_roll_centre = roll_centre(cp, patch, tyre)
      end if
      lift = jacking_forces(cp, [1.0_wp, 1.0_wp])
      is%force_roll_centre = -0.5_wp*dot_product(patch(2, :), lift)
   end function axle_characteristics

   !> Vertical forces of the ground [N] on the left and the right patch that keep their heights under lateral forces to the right
   !> at the patches: V = −CP_zz⁻¹ CP_zy F. Not a number if the wheels cannot move independently in height.
   !> Equation (S.5) of docs/theory/suspension.md.
   pure function jacking_forces(cp, lateral) result(lift)
      real(wp), intent(in) :: cp(:, :)          !! 12×12
      real(wp), intent(in) :: lateral(2)        !! left, right [N]
      real(wp) :: lift(2), rise(2), determinant

      rise = [dot_product(cp(3, [2, 8]), lateral), dot_product(cp(9, [2, 8]), lateral)]
      determinant = cp(3, 3)*cp(9, 9) - cp(3, 9)*cp(9, 3)
      lift = ieee_value(1.0_wp, ieee_quiet_nan)
      if (abs(determinant) <= 1.0e-10_wp*abs(cp(3, 3)*cp(9, 9)) .or. abs(determinant) <= min_compliance**2) return
      lift(1) = -(cp(9, 9)*rise(1) - cp(3, 9)*rise(2))/determinant
      lift(2) = -(cp(3, 3)*rise(2) - cp(9, 3)*rise(1))/determinant
   end function jacking_forces

   !> CP33 − CP39 − CP93 + CP99: difference in height of the patches per force up on the left, down on the right.
   pure real(wp) function roll_compliance(cp)
      real(wp), intent(in) :: cp(:, :)
      roll_compliance = cp(3, 3) - cp(3, 9) - cp(9, 3) + cp(9, 9)
   end function roll_compliance

   !> Length √(dh² + dz²)/|dθ| and angle atan(−dh/dz) of the arm about whose end a wheel centre swings.
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

   !> The centre (h, z) about which a point swings in a plane: it moves by (dh, dz) while the carrier rotates by ω about the
   !> normal; `hand` is 1 if (h, z, normal) is right-handed as (y, z, x), −1 as (x, z, y).
   !>
   !>     dh = −hand ω (z − z0),  dz = hand ω (h − h0)
   !>
   !> Equation (S.1) of docs/theory/suspension.md.
   pure function arm_centre(point, way, turn, hand) result(centre)
      real(wp), intent(in) :: point(2), way(2), turn, hand
      real(wp) :: centre(2), size_of

      size_of = norm2(way)
      centre = ieee_value(1.0_wp, ieee_quiet_nan)
      if (abs(turn) <= max(size_of, min_compliance)/longest_arm) return
      centre = [point(1) - hand*way(2)/turn, point(2) + hand*way(1)/turn]
   end function arm_centre

   !> −Zf/Zw of brakes and of drive, per unit of the whole force on the vehicle, and the wheel travel per g.
   !>
   !> Braking with a force 1 rearward: this axle's wheels carry half its share each, at the patch, and the load
   !> transfer h/2L more (front) or less (rear). Driving with a force 1 forward: with opposite signs, at the
   !> centre or the patch. Zf, Zw: upward displacement of the wheel centres under the force and under the load transfer; their
   !> sum times the weight of the car is the travel per g.
   !> Equations (S.11), (S.12), (S.13) of docs/theory/suspension.md.
   pure subroutine anti_features(in, patch_in, axle, is)
      real(wp), intent(in) :: in(6, 6), patch_in(6, 6)      !! loads at the centre and at the patch, displacements at the centre
      type(axle_t), intent(in) :: axle
      type(wheel_characteristics_t), intent(inout) :: is
      real(wp) :: share, transfer, lever, least

      if (.not. axle%has_axle) return
      share = axle%brake_share
      if (.not. axle%is_front) share = 1.0_wp - share
      transfer = 0.5_wp*axle%cg_height/axle%wheelbase
      least = min_compliance*transfer
      if (.not. axle%is_front) transfer = -transfer
      lever = in(3, 1)
      if (axle%drives_at_patch) lever = patch_in(3, 1)
      is%anti_brake = quotient(-0.5_wp*share*patch_in(3, 1), transfer*patch_in(3, 3), least)
      is%anti_drive = quotient(0.5_wp*axle%drive_share*lever, -transfer*patch_in(3, 3), least)
      is%brake_travel = axle%mass*gravity*(transfer*patch_in(3, 3) + 0.5_wp*share*patch_in(3, 1))
      is%drive_travel = axle%mass*gravity*(-transfer*patch_in(3, 3) - 0.5_wp*axle%drive_share*lever)
   end subroutine anti_features

   !> Intersection of the normals to the paths of both patches in the front view: dz (z − z0) + dy (y − y0) = 0 through each,
   !> (dy, dz) the displacement of the patch in roll, plus the deflection of the tyre. Not a number if the two displacements are
   !> parallel to 1e-8.
   !> Equations (S.3), (S.4) of docs/theory/suspension.md.
   pure function roll_centre(cp, patches, tyre) result(centre)
      real(wp), intent(in) :: cp(:, :), patches(3, 2)
      real(wp), intent(in) :: tyre(2)                !! m/N
      real(wp) :: centre(2), way(2, 2), right(2), determinant, size_of_both
      integer :: k

      way(:, 1) = [cp(2, 3) - cp(2, 9), cp(3, 3) - cp(3, 9) + tyre(1)]
      way(:, 2) = [cp(8, 9) - cp(8, 3), cp(9, 9) - cp(9, 3) + tyre(2)]
      do k = 1, 2
         right(k) = dot_product(way(:, k), patches(2:3, k))
      end do
      determinant = way(1, 1)*way(2, 2) - way(2, 1)*way(1, 2)
      size_of_both = norm2(way(:, 1))*norm2(way(:, 2))
      centre = ieee_value(1.0_wp, ieee_quiet_nan)
      if (abs(determinant) <= 1.0e-8_wp*size_of_both .or. size_of_both <= min_compliance**2) return
      centre(1) = (right(1)*way(2, 2) - right(2)*way(2, 1))/determinant
      centre(2) = (way(1, 1)*right(2) - way(1, 2)*right(1))/determinant
   end function roll_centre

   !> d(length)/d(wheel travel) with equal travel of all wheels: the loads f that lift each by one follow
   !> from C_zz f = 1, and the change of length is the response of the spring to them. Wheels that can only move together
   !> (C_zz singular) carry equal loads.
   !> Equation (C.13) of docs/theory/compliance.md.
   pure real(wp) function motion_ratio(c, length) result(ratio)
      real(wp), intent(in) :: c(:, :)        !! 6×6 or 12×12
      real(wp), intent(in) :: length(:)      !! of one spring per unit of each load of C [m/N, m/(N m)]
      real(wp) :: determinant

      if (size(c, 1) == 12) then
         determinant = c(3, 3)*c(9, 9) - c(3, 9)*c(9, 3)
         if (abs(determinant) > 1.0e-10_wp*abs(c(3, 3)*c(9, 9))) then
            ratio = quotient(length(3)*(c(9, 9) - c(3, 9)) + length(9)*(c(3, 3) - c(9, 3)), determinant, min_compliance**2)
         else
            ratio = quotient(2.0_wp*(length(3) + length(9)), c(3, 3) + c(3, 9) + c(9, 3) + c(9, 9), min_compliance)
         end if
      else
         ratio = quotient(length(3), c(3, 3), min_compliance)
      end if
   end function motion_ratio

end module ek_characteristics
