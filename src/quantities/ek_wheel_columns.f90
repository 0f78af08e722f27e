!> The values of the sections of ek_quantity that come from the characteristics of a wheel, in SI and in the order of the section.
module ek_wheel_columns
   use ek_kinds, only: wp
   use ek_characteristics, only: wheel_characteristics_t, response_t, of_rates, of_bump, of_roll, of_arms, of_forces_load_held, &
      of_forces_height_held, of_jacking, of_stiffness, of_anti_features, in_phase, anti_phase, load_held, height_held
   implicit none(type, external)
   private
   public :: wheel_values

contains

   !> Computes the values of one group of characteristics: wheel_rates, wheel_bump, wheel_roll, swing_arms, wheel_forces (twice),
   !> wheel_jacking, wheel_stiffness, wheel_pitch.
   pure subroutine wheel_values(group, is, frame, values)
      integer, intent(in) :: group
      type(wheel_characteristics_t), intent(in) :: is
      real(wp), intent(in) :: frame(3)              !! signs of x, y, z from the program's frame to the deck's frame
      real(wp), intent(inout) :: values(:)          !! the first are set

      select case (group)
      case (of_rates)
         values(1) = is%wheel_rate
         values(2:3) = is%single_rate
         values(4) = is%ride_rate
         values(5) = is%hop_rate
      case (of_bump)
         values(1) = is%bump%steer
         values(2) = is%bump%camber
         values(3) = is%bump%caster
         values(4) = is%bump%toe
         values(5:7) = frame*is%bump%rotation
      case (of_roll)
         call roll_values(is%roll, frame, values(1:7))
         call roll_values(is%wheel_roll, frame, values(8:14))
      case (of_arms)
         values(1) = is%side_arm_length
         values(2) = is%side_arm_angle
         values(3) = frame(1)*is%side_arm_centre(1)
         values(4) = frame(3)*is%side_arm_centre(2)
         values(5) = is%front_arm_length
         values(6) = is%front_arm_angle
         values(7:8) = frame(2:3)*is%front_arm_centre
      case (of_forces_load_held)
         call force_values(is, load_held, frame, values)
      case (of_forces_height_held)
         call force_values(is, height_held, frame, values)
      case (of_jacking)
         values(1:2) = is%jacking
      case (of_stiffness)
         values(1:6) = is%stiffness
      case (of_anti_features)
         values(1) = 100.0_wp*is%anti_brake
         values(2) = 100.0_wp*is%anti_drive
         values(3:4) = values(1:2)
         values(5) = is%brake_travel           ! the body moves down if the wheel moves up
         values(6) = -is%drive_travel
         values(7) = -is%brake_travel
         values(8) = is%drive_travel
      end select
   end subroutine wheel_values

   !> Computes the responses to roll: steer, camber and caster per roll, steer in per cent of roll, and rotations.
   pure subroutine roll_values(roll, frame, values)
      type(response_t), intent(in) :: roll
      real(wp), intent(in) :: frame(3)
      real(wp), intent(inout) :: values(7)

      values(1) = roll%steer
      values(2) = roll%camber
      values(3) = roll%caster
      values(4) = 100.0_wp*roll%steer
      values(5:7) = frame*roll%rotation
   end subroutine roll_values

   !> Computes the values of wheel_forces under one condition.
   pure subroutine force_values(is, held, frame, values)
      type(wheel_characteristics_t), intent(in) :: is
      integer, intent(in) :: held
      real(wp), intent(in) :: frame(3)
      real(wp), intent(inout) :: values(:)
      integer :: phase, at

      do phase = in_phase, anti_phase
         at = 10*(phase - 1)
         call lateral_values(is%lateral(phase, held), values(at + 1:at + 4))
         call lateral_values(is%lateral_trail(phase, held), values(at + 5:at + 8))
         values(at + 9) = is%aligning(phase, held)%steer
         values(at + 10) = is%aligning(phase, held)%camber
      end do
      associate (braking => is%braking(held), traction => is%traction(held))
         values(21) = braking%patch(1)
         call turn_values(braking, frame, values(22:28))
         values(29) = braking%centre(1)
         values(30) = -traction%centre(1)
         call turn_values(traction, frame, values(31:37))
      end associate
   end subroutine force_values

   !> Computes deflections of contact point and wheel centre, steer, and camber under a lateral force.
   pure subroutine lateral_values(response, values)
      type(response_t), intent(in) :: response
      real(wp), intent(inout) :: values(4)

      values(1) = response%patch(2)
      values(2) = response%centre(2)
      values(3) = response%steer
      values(4) = response%camber
   end subroutine lateral_values

   !> Computes angles and rotations under a longitudinal force.
   pure subroutine turn_values(response, frame, values)
      type(response_t), intent(in) :: response
      real(wp), intent(in) :: frame(3)
      real(wp), intent(inout) :: values(7)

      values(1) = response%steer
      values(2) = response%camber
      values(3) = response%caster
      values(4) = response%toe
      values(5:7) = frame*response%rotation
   end subroutine turn_values

end module ek_wheel_columns
