!> The motion of a wheel for simulators: translations and rotations at the wheel centre, lengths of spring, damper, stop and bar,
!> angles, translations of the contact point, and wheel load.
!>
!> Frame ISO 8855: x forward, y to the left, z up, regardless of the deck's axes. SI and radians.
!>
!> The rotation of the wheel from zero camber and toe to the attitude at a state is R = Rz(rz) Rx(rx) Ry(ry); this rotation
!> contains the static angles. rx and rz are the attitude of the spin axis, independent of the rotation ry of the carrier. On the
!> left wheel camber = −rx and toe = −rz, on the right wheel camber = rx and toe = rz (camber positive: top outward; toe positive:
!> front edge inward).
module ek_wheel_motion
   use ek_kinds, only: wp
   use ek_measure, only: measure_t, measure_value
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t
   use ek_attitude, only: attitude_t, wheel_attitude, vertical_force
   implicit none(type, external)
   private
   public :: wheel_motion, mirrored, cardan_angles, iso_frame, iso_loads, mirror_signs
   public :: lengths, length_names, spring_length, damper_length, stop_length, bar_length, length_choice_t
   public :: quantities, quantity_names
   public :: at_tx, at_ty, at_tz, at_rx, at_ry, at_rz, at_lengths, at_toe, at_camber, at_caster, at_patch, at_load

   ! lengths along which forces act
   integer, parameter :: spring_length = 1, damper_length = 2, stop_length = 3, bar_length = 4, lengths = 4
   character(6), parameter :: length_names(lengths) = [character(6) :: 'spring', 'damper', 'stop', 'bar']

   ! places of the quantities of a wheel
   integer, parameter :: at_tx = 1, at_ty = 2, at_tz = 3, at_rx = 4, at_ry = 5, at_rz = 6, at_lengths = 6, at_toe = 11, &
      at_camber = 12, at_caster = 13, at_patch = 13, at_load = 17, quantities = 17

   !> Names of the quantities: translations [m] of the wheel centre, rotations [rad], lengths [m], toe, camber and caster [rad],
   !> translations of the contact point [m], wheel load [N]. Without a steering axis, caster is the side-view rotation.
   character(8), parameter :: quantity_names(quantities) = [character(8) :: 'tx', 'ty', 'tz', 'rx', 'ry', 'rz', &
      'lSpring', 'lDamp', 'lBuf', 'lStabi', 'toe', 'camber', 'caster', 'px', 'py', 'pz', 'load']

   !> Signs of x, y, z from the frame of the program to ISO; signs of the six components of a load or displacement; signs of these
   !> components from a wheel to its mirror image.
   real(wp), parameter :: iso_frame(3) = [-1.0_wp, -1.0_wp, 1.0_wp]
   real(wp), parameter :: iso_loads(6) = [iso_frame, iso_frame]
   real(wp), parameter :: mirror_signs(6) = [1.0_wp, -1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp, -1.0_wp]

   !> The source of one length of one wheel: a measure of the model, another length, or the travel of the wheel.
   type :: length_choice_t
      logical :: has_measure = .false.
      type(measure_t) :: measure
      integer :: same_as = 0              !! index of another length; 0: the travel of the wheel
      real(wp) :: sign = 1.0_wp           !! sign of the travel as a length
      character(:), allocatable :: label   !! name for descriptions: 'left_coil', 'lSpring', 'tz'
   end type length_choice_t

contains

   !> The quantities of wheel k at a state, in the order of quantity_names.
   pure function wheel_motion(suspension, state, inputs, k, choices) result(values)
      type(suspension_t), intent(in) :: suspension           !! on the rig
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      integer, intent(in) :: k
      type(length_choice_t), intent(in) :: choices(lengths)   !! of this wheel
      real(wp) :: values(quantities)
      type(attitude_t) :: now
      real(wp) :: turned(3, 3), upright(3, 3)
      integer :: j

      now = wheel_attitude(suspension, state, k)
      associate (a => state%poses(suspension%wheels(k)%body + 1)%a)
         do j = 1, 3
            turned(:, j) = iso_frame*a(:, j)*iso_frame(j)
         end do
      end associate
      upright = static_attitude(suspension%wheels(k)%spin)
      turned = matmul(turned, upright)
      values(at_tx:at_tz) = iso_frame*now%centre
      values(at_rx:at_rz) = cardan_angles(turned)
      values(at_toe) = now%toe
      values(at_camber) = now%camber
      values(at_caster) = now%side_view
      if (now%axis%is_known) values(at_caster) = now%axis%caster
      values(at_patch + 1:at_patch + 3) = iso_frame*now%contact
      values(at_load) = vertical_force(suspension, state, inputs, k)
      do j = 1, lengths
         if (choices(j)%has_measure) then
            associate (m => choices(j)%measure)
               values(at_lengths + j) = measure_value(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1))
            end associate
         else if (choices(j)%same_as > 0) then
            values(at_lengths + j) = values(at_lengths + choices(j)%same_as)
         else
            values(at_lengths + j) = choices(j)%sign*values(at_tz)
         end if
      end do
   end function wheel_motion

   !> The rotation of a wheel from zero camber and toe to the spin axis at design, without a rotation about this axis: Rz Rx, in
   !> ISO.
   pure function static_attitude(spin) result(r)
      real(wp), intent(in) :: spin(3)      !! unit, outboard, frame of the program
      real(wp) :: r(3, 3)
      real(wp) :: left(3), flat

      left = iso_frame*spin
      if (left(2) < 0.0_wp) left = -left   ! the axis of a right wheel points to the right
      flat = sqrt(left(1)**2 + left(2)**2)
      r(:, 1) = [left(2)/flat, -left(1)/flat, 0.0_wp]
      r(:, 2) = left
      r(:, 3) = [-left(3)*left(1)/flat, -left(3)*left(2)/flat, flat]
   end function static_attitude

   !> The angles rx, ry, rz of a rotation R = Rz(rz) Rx(rx) Ry(ry) [rad].
   pure function cardan_angles(r) result(angles)
      real(wp), intent(in) :: r(3, 3)
      real(wp) :: angles(3)
      angles = [asin(max(-1.0_wp, min(1.0_wp, r(3, 2)))), atan2(-r(3, 1), r(3, 3)), atan2(-r(1, 2), r(2, 2))]
   end function cardan_angles

   !> The quantities of the mirror image of a wheel.
   pure function mirrored(values) result(image)
      real(wp), intent(in) :: values(quantities)
      real(wp) :: image(quantities)

      image = values
      image(at_tx:at_rz) = mirror_signs*values(at_tx:at_rz)
      image(at_patch + 2) = -values(at_patch + 2)
   end function mirrored

end module ek_wheel_motion
