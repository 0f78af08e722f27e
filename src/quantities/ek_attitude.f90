!> The attitude of a wheel from the pose of its carrier: toe, camber, steering axis and displacements. Also the vertical force on
!> a wheel.
!>
!> Frame x rearward, y right, z up; side = −1 left, +1 right. All in SI and radians.
!>
!> Derivatives of the angles with respect to a small rotation θ of the carrier about global axes: the spin axis w and the steering
!> axis k are fixed to the carrier, so δw = θ×w and δk = θ×k. The chain rule gives, exact for any attitude (h² = w_x² + w_y²):
!>
!>     steer  = side·atan2(−w_x, side·w_y):   δsteer  = θ_z − w_z (θ_x w_x + θ_y w_y)/h²,   δtoe = side δsteer
!>     camber = asin(−w_z):                   δcamber = (θ_y w_x − θ_x w_y)/h
!>     caster = atan2(k_x, k_z):              δcaster = θ_y − k_y (θ_x k_x + θ_z k_z)/(k_x² + k_z²)
!>
!> A vertical spin axis has no toe, and a steering axis along y has no caster: the quotients are then infinite or NaN.
module ek_attitude
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_quantity, only: axis_section => steer_axis
   use ek_relative_rotation, only: pose_t
   use ek_block, only: rotated
   use ek_suspension, only: suspension_t, wheel_t
   use ek_wheel_contact, only: contact_arm
   use ek_state, only: state_t, inputs_t
   use ek_kkt, only: load_factor, wrench
   use ek_wheel_side, only: share_on_wheel
   use ek_steer_angle, only: steer_rate
   implicit none(type, external)
   private
   public :: attitude_t, attitude_of, find_attitude, wheel_attitude, steer_axis_t, steer_axis_of, axis_values, static_toe
   public :: axes_t, axes_of, toe_rate, camber_rate, camber_gradient, caster_gradient, &
      vertical_force

   !> The directions of a wheel at a state, global axes.
   type :: axes_t
      integer :: side = -1                                     !! −1 left, +1 right
      real(wp) :: spin(3) = [0.0_wp, -1.0_wp, 0.0_wp]          !! unit vector of the spin axis, outboard
      logical :: has_steer_axis = .false.                      !! the deck gives two points of the steering axis
      real(wp) :: steer_axis(3) = [0.0_wp, 0.0_wp, 1.0_wp]     !! from first to second point of the steering axis, any length
   end type axes_t

   !> A steering axis relative to wheel centre and contact point.
   type :: steer_axis_t
      logical :: is_known = .false.
      real(wp) :: caster = 0.0_wp               !! rad, positive: top rearward
      real(wp) :: kingpin_inclination = 0.0_wp  !! rad, positive: top inward
      real(wp) :: scrub_radius = 0.0_wp         !! m, positive: axis meets the ground inboard of the contact point
      real(wp) :: caster_trail = 0.0_wp         !! m, positive: axis meets the ground ahead of the contact point
      real(wp) :: spindle_length = 0.0_wp       !! m, axis to wheel centre, lateral at the height of the centre, positive outboard
      real(wp) :: spindle_offset = 0.0_wp       !! m, axis to wheel centre, longitudinal at this height, positive: centre aft
   end type steer_axis_t

   !> The attitude of one wheel at one state. Changes are relative to design.
   type :: attitude_t
      real(wp) :: centre(3) = 0.0_wp     !! displacement of the wheel centre [m]
      real(wp) :: travel = 0.0_wp        !! wheel travel from the start state (ek_start) or from design [m], bump positive
      real(wp) :: contact(3) = 0.0_wp    !! displacement of the contact point [m]
      real(wp) :: toe = 0.0_wp           !! rad, positive: front edges inward
      real(wp) :: camber = 0.0_wp        !! rad, positive: top outward
      real(wp) :: track_change = 0.0_wp       !! lateral displacement of the contact point [m], positive outward
      real(wp) :: wheelbase_change = 0.0_wp   !! longitudinal displacement of the contact point [m], positive rearward
      type(steer_axis_t) :: axis         !! steering axis through the two points of the deck; unknown without these points
      type(axes_t) :: axes = axes_t()    !! spin axis, and the direction of the steering axis
      real(wp) :: at_centre(3) = 0.0_wp, at_contact(3) = 0.0_wp   !! wheel centre and contact point at the state [m]
      real(wp) :: axis_point(3) = 0.0_wp !! first point of the steering axis at the state [m]
      real(wp) :: side_view = 0.0_wp     !! side-view rotation [rad], positive top rearward: atan2(e_x, e_z), e vertical at design
   end type attitude_t

contains

   !> Attitude of a wheel for a pose of its carrier.
   !>
   !>     toe = atan2(−w_x, side·w_y)       camber = asin(−w_z)        w: spin axis, outboard
   !>     caster = atan2(k_x, k_z)          kingpin = atan2(−side·k_y, k_z)    k: steering axis, upward
   !>
   !> The ground is the horizontal plane through the contact point. A horizontal steering axis (k_z = 0) does not intersect the
   !> ground: attitude%axis%is_known is then false, and the distances of this axis remain 0.
   !> Equation (C.9) of docs/theory/compliance.md.
   pure function attitude_of(wheel, origin, now) result(attitude)
      type(wheel_t), intent(in) :: wheel
      real(wp), intent(in) :: origin(3)     !! reference point of the carrier at design [m]
      type(pose_t), intent(in) :: now
      type(attitude_t) :: attitude

      call find_attitude(wheel, origin, now, attitude)
   end function attitude_of

   !> Stores the attitude of a wheel in an existing variable; attitude_of returns the attitude as a function value.
   pure subroutine find_attitude(wheel, origin, now, attitude)
      type(wheel_t), intent(in) :: wheel
      real(wp), intent(in) :: origin(3)
      type(pose_t), intent(in) :: now
      type(attitude_t), intent(inout) :: attitude     !! default values, or an earlier attitude of this wheel

      attitude%at_centre = now%r + rotated(now%a, wheel%centre)
      attitude%at_contact = now%r + contact_arm(wheel, now%a)
      attitude%centre = attitude%at_centre - (origin + wheel%centre)
      attitude%travel = attitude%centre(3) - wheel%start_rise(1)
      attitude%contact = attitude%at_contact - (origin + wheel%contact)
      attitude%axes = axes_of(wheel, now)
      associate (w => attitude%axes%spin)
         attitude%toe = atan2(-w(1), wheel%side*w(2))
         attitude%camber = asin(max(-1.0_wp, min(1.0_wp, -w(3))))
      end associate
      attitude%side_view = atan2(now%a(1, 3), now%a(3, 3))
      attitude%track_change = wheel%side*attitude%contact(2)
      attitude%wheelbase_change = attitude%contact(1)
      if (.not. wheel%has_steer_axis) return
      attitude%axis_point = now%r + rotated(now%a, wheel%steer_axis(:, 1))
      attitude%axis = steer_axis_of(wheel%side, attitude%axis_point, attitude%axes%steer_axis, attitude%at_centre, &
         attitude%at_contact)
   end subroutine find_attitude

   !> Toe of a wheel in the design position [rad], positive: front edges inward.
   pure real(wp) function static_toe(wheel)
      type(wheel_t), intent(in) :: wheel
      static_toe = atan2(-wheel%spin(1), wheel%side*wheel%spin(2))
   end function static_toe

   !> Angles of a line, and the distances of contact point and wheel centre from the line. Each distance is measured in the
   !> horizontal plane through that point. For a horizontal line, is_known is false: the angles are set, the distances remain 0.
   !> Equation (S.7) of docs/theory/suspension.md.
   pure function steer_axis_of(side, point, direction, centre, contact) result(axis)
      integer, intent(in) :: side                           !! −1 left, +1 right
      real(wp), intent(in) :: point(3), direction(3)        !! point and direction of the line; any length, up or down
      real(wp), intent(in) :: centre(3), contact(3)         !! m
      type(steer_axis_t) :: axis
      real(wp), parameter :: level = 1.0e-9_wp              ! of its length: such a line intersects the ground too far away
      real(wp) :: k(3), foot(3), abeam(3)

      k = direction
      if (k(3) < 0.0_wp) k = -k
      axis%caster = atan2(k(1), k(3))
      axis%kingpin_inclination = atan2(-side*k(2), k(3))
      axis%is_known = k(3) > level*sqrt(k(1)**2 + k(2)**2 + k(3)**2)
      if (.not. axis%is_known) return
      foot = point + k*((contact(3) - point(3))/k(3))
      axis%scrub_radius = side*(contact(2) - foot(2))
      axis%caster_trail = contact(1) - foot(1)
      abeam = point + k*((centre(3) - point(3))/k(3))
      axis%spindle_length = side*(centre(2) - abeam(2))
      axis%spindle_offset = centre(1) - abeam(1)
   end function steer_axis_of

   !> The values of the six columns of a steering axis [rad, m]; NaN if the axis is unknown.
   pure function axis_values(axis) result(values)
      type(steer_axis_t), intent(in) :: axis
      real(wp) :: values(size(axis_section))
      values = ieee_value(1.0_wp, ieee_quiet_nan)
      if (axis%is_known) values = [axis%caster, axis%kingpin_inclination, axis%scrub_radius, axis%caster_trail, &
         axis%spindle_length, axis%spindle_offset]
   end function axis_values

   !> Attitude of wheel k of a model at a state.
   pure function wheel_attitude(suspension, state, k) result(attitude)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: k
      type(attitude_t) :: attitude

      associate (wheel => suspension%wheels(k))
         attitude = attitude_of(wheel, suspension%bodies(wheel%body)%origin, state%poses(wheel%body + 1))
      end associate
   end function wheel_attitude

   !> The directions of the axes of a wheel whose carrier has a given pose, global axes.
   pure type(axes_t) function axes_of(wheel, pose) result(axes)
      type(wheel_t), intent(in) :: wheel
      type(pose_t), intent(in) :: pose

      axes%side = wheel%side
      axes%spin = rotated(pose%a, wheel%spin)
      axes%has_steer_axis = wheel%has_steer_axis
      if (wheel%has_steer_axis) axes%steer_axis = rotated(pose%a, wheel%steer_axis(:, 2) - wheel%steer_axis(:, 1))
   end function axes_of

   !> Change of toe under a small rotation of the carrier about global axes [rad, positive: front edges inward].
   !> Equation (C.10) of docs/theory/compliance.md.
   pure real(wp) function toe_rate(axes, turn) result(rate)
      type(axes_t), intent(in) :: axes
      real(wp), intent(in) :: turn(3)
      rate = axes%side*steer_rate(axes%spin, turn)
   end function toe_rate

   !> Change of camber under a small rotation of the carrier about global axes [rad, positive: top outward].
   pure real(wp) function camber_rate(axes, turn) result(rate)
      type(axes_t), intent(in) :: axes
      real(wp), intent(in) :: turn(3)
      rate = dot_product(camber_gradient(axes%spin), turn)
   end function camber_rate

   !> The weights of the rotations about x, y, z in the change of camber [rad/rad, positive: top outward].
   !> Equation (C.11) of docs/theory/compliance.md.
   pure function camber_gradient(spin) result(gradient)
      real(wp), intent(in) :: spin(3)         !! unit, outboard
      real(wp) :: gradient(3), level

      level = sqrt(spin(1)**2 + spin(2)**2)
      gradient(1) = -spin(2)/level
      gradient(2) = spin(1)/level
      gradient(3) = 0.0_wp
   end function camber_gradient

   !> The weights of the rotations about x, y, z in the change of caster of the geometric steering axis [rad/rad, positive: top
   !> rearward].
   !> Equation (C.11) of docs/theory/compliance.md.
   pure function caster_gradient(axis) result(gradient)
      real(wp), intent(in) :: axis(3)         !! direction of any length
      real(wp) :: gradient(3), lean

      lean = axis(2)/(axis(1)**2 + axis(3)**2)
      gradient(1) = -lean*axis(1)
      gradient(2) = 1.0_wp
      gradient(3) = -lean*axis(3)
   end function caster_gradient

   !> Vertical force on wheel `wheel` [N], upward: the constant and the scaled loads on the carrier of this wheel, and the force of
   !> a rig that holds the height of this wheel. Weights of bodies are not included. If one body carries both wheels, a load counts
   !> for the wheel that is laterally nearer; a load in the middle counts half for each wheel.
   pure real(wp) function vertical_force(suspension, state, inputs, wheel) result(force)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      integer, intent(in) :: wheel
      real(wp) :: factor, share, f(3), moment(3), arm(3)
      integer :: k, t

      force = 0.0_wp
      do k = 1, size(suspension%loads)
         associate (load => suspension%loads(k))
            if (load%is_weight) cycle
            share = share_on_wheel(suspension, wheel, load%body, load%arm)
            if (.not. share > 0.0_wp) cycle
            factor = 1.0_wp
            if (load%is_case) factor = load_factor(inputs, k)
            call wrench(load, state%poses(load%body + 1), f, moment, arm)
            force = force + share*factor*f(3)
         end associate
      end do
      do k = suspension%own_rows() + 1, suspension%constraints()
         do t = suspension%rows(k)%first, suspension%rows(k)%first + suspension%rows(k)%terms - 1
            associate (term => suspension%terms(t))
               force = force - share_on_wheel(suspension, wheel, term%measure%body_j, term%measure%arm_j)* &
                  state%reaction(k)*term%coefficient*term%measure%u(3)
            end associate
         end do
      end do

   end function vertical_force

end module ek_attitude
