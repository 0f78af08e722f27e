!> The columns of the response of a wheel in bump, in roll and under the forces of a K&C rig: names, units and values.
!>
!> The ending of a column names the quantity whose slope it is: `…_steer`, `…_toe`, `…_camber`, `…_caster` are the
!> derivatives of the columns steer_deg, toe_deg, camber_deg and caster_deg; `…_rotation_x`, `…_y`, `…_z` are the
!> rotation of the carrier about an axis of the deck's frame; `…_deflection` is the movement of the contact point (of the
!> wheel centre in traction), `…_centre_deflection` that of the wheel centre. `load_held`: constant vertical forces;
!> `height_held`: constant heights of the wheel centres. input/QUANTITIES.md defines each of them.
module ek_response_columns
   use ek_kinds, only: wp
   use ek_units, only: degree, millimetre
   use ek_characteristics, only: wheel_characteristics_t, response_t, in_phase, anti_phase, load_held, height_held
   use ek_kandc_row, only: kandc_t, put_known
   implicit none(type, external)
   private
   public :: put_rates, put_arms, put_forces

   ! divisors of values in SI
   real(wp), parameter :: per_metre = degree                       !! deg/m
   real(wp), parameter :: n_per_mm = 1.0e3_wp                      !! N/mm
   real(wp), parameter :: mm_per_kn = 1.0e-6_wp                    !! mm/kN
   real(wp), parameter :: deg_per_kn = degree/1.0e3_wp             !! deg/kN
   real(wp), parameter :: deg_per_100nm = degree/100.0_wp          !! deg/(100 N m)
   real(wp), parameter :: nm_per_deg = 1.0_wp/degree               !! N m/deg
   real(wp), parameter :: n_per_kn = 1.0e-3_wp                     !! N/kN
   character(*), parameter :: conditions(2) = [character(12) :: 'load_held_', 'height_held_']
   character(*), parameter :: phases(2) = [character(5) :: 'in_', 'anti_']

contains

   !> Rates, and the response in bump and roll.
   subroutine put_rates(self, prefix, is, frame, is_pair, is_shod, has_caster)
      type(kandc_t), intent(inout) :: self
      character(*), intent(in) :: prefix                 !! 'left_', 'right_' or ''
      type(wheel_characteristics_t), intent(in) :: is
      real(wp), intent(in) :: frame                      !! −1: x and y of the deck have the opposite sign
      logical, intent(in) :: is_pair, is_shod, has_caster

      call put_known(self, prefix//'wheel_rate_n_per_mm', is%wheel_rate/n_per_mm)
      if (is_pair) then
         call put_known(self, prefix//'single_wheel_rate_load_held_n_per_mm', is%single_rate(load_held)/n_per_mm)
         call put_known(self, prefix//'single_wheel_rate_height_held_n_per_mm', is%single_rate(height_held)/n_per_mm)
      end if
      if (is_shod) then
         call put_known(self, prefix//'ride_rate_n_per_mm', is%ride_rate/n_per_mm)
         call put_known(self, prefix//'hop_rate_n_per_mm', is%hop_rate/n_per_mm)
      end if
      call put_angles(self, prefix//'bump_', is%bump, '_deg_per_m', per_metre, has_caster)
      call put_known(self, prefix//'bump_toe_deg_per_m', is%bump%toe/per_metre)
      call put_rotation(self, prefix//'bump_', is%bump, '_deg_per_m', per_metre, frame)
      if (.not. is_pair) return
      if (is_shod) then
         call put_angles(self, prefix//'roll_', is%roll, '_deg_per_deg', 1.0_wp, has_caster)
         call put_known(self, prefix//'roll_steer_percent', 100.0_wp*is%roll%steer)
         call put_rotation(self, prefix//'roll_', is%roll, '_deg_per_deg', 1.0_wp, frame)
      end if
      call put_angles(self, prefix//'wheel_roll_', is%wheel_roll, '_deg_per_deg', 1.0_wp, has_caster)
      call put_known(self, prefix//'wheel_roll_steer_percent', 100.0_wp*is%wheel_roll%steer)
      call put_rotation(self, prefix//'wheel_roll_', is%wheel_roll, '_deg_per_deg', 1.0_wp, frame)
   end subroutine put_rates

   !> Swing arms and their centres.
   subroutine put_arms(self, prefix, is, frame)
      type(kandc_t), intent(inout) :: self
      character(*), intent(in) :: prefix
      type(wheel_characteristics_t), intent(in) :: is
      real(wp), intent(in) :: frame

      call put_known(self, prefix//'side_view_arm_length_mm', is%side_arm_length/millimetre)
      call put_known(self, prefix//'side_view_arm_angle_deg', is%side_arm_angle/degree)
      call put_known(self, prefix//'side_view_arm_centre_x_mm', frame*is%side_arm_centre(1)/millimetre)
      call put_known(self, prefix//'side_view_arm_centre_z_mm', is%side_arm_centre(2)/millimetre)
      call put_known(self, prefix//'front_view_arm_length_mm', is%front_arm_length/millimetre)
      call put_known(self, prefix//'front_view_arm_angle_deg', is%front_arm_angle/degree)
      call put_known(self, prefix//'front_view_arm_centre_y_mm', frame*is%front_arm_centre(1)/millimetre)
      call put_known(self, prefix//'front_view_arm_centre_z_mm', is%front_arm_centre(2)/millimetre)
   end subroutine put_arms

   !> The response to forces and moments under either condition, and the stiffnesses at the wheel centre.
   subroutine put_forces(self, prefix, is, frame, is_pair, has_caster)
      type(kandc_t), intent(inout) :: self
      character(*), intent(in) :: prefix
      type(wheel_characteristics_t), intent(in) :: is
      real(wp), intent(in) :: frame
      logical, intent(in) :: is_pair, has_caster
      integer :: held, k

      do held = load_held, height_held
         do k = in_phase, merge(anti_phase, in_phase, is_pair)
            call put_lateral('lateral_'//phases(k), is%lateral(k, held))
            call put_lateral('lateral_'//trim(phases(k))//'trail_', is%lateral_trail(k, held))
            call put_known(self, stem('aligning_'//phases(k))//'steer_deg_per_100nm', &
               is%aligning(k, held)%steer/deg_per_100nm)
            call put_known(self, stem('aligning_'//phases(k))//'camber_deg_per_100nm', &
               is%aligning(k, held)%camber/deg_per_100nm)
         end do
         call put_longitudinal(stem('braking_'), is%braking(held), is%braking(held)%patch(1))
         call put_known(self, stem('braking_')//'centre_deflection_mm_per_kn', is%braking(held)%centre(1)/mm_per_kn)
         call put_longitudinal(stem('traction_'), is%traction(held), -is%traction(held)%centre(1))      ! forward
      end do
      if (is_pair) then
         call put_known(self, prefix//'lateral_in_jacking_n_per_kn', is%jacking(in_phase)/n_per_kn)
         call put_known(self, prefix//'lateral_anti_jacking_n_per_kn', is%jacking(anti_phase)/n_per_kn)
      end if
      call put_known(self, prefix//'fore_aft_stiffness_n_per_mm', is%stiffness(1)/n_per_mm)
      call put_known(self, prefix//'lateral_stiffness_n_per_mm', is%stiffness(2)/n_per_mm)
      call put_known(self, prefix//'vertical_stiffness_n_per_mm', is%stiffness(3)/n_per_mm)
      call put_known(self, prefix//'rotational_stiffness_x_nm_per_deg', is%stiffness(4)/nm_per_deg)
      call put_known(self, prefix//'rotational_stiffness_y_nm_per_deg', is%stiffness(5)/nm_per_deg)
      call put_known(self, prefix//'rotational_stiffness_z_nm_per_deg', is%stiffness(6)/nm_per_deg)

   contains

      !> 'left_braking_load_held_' for 'braking_'
      function stem(load) result(text)
         character(*), intent(in) :: load
         character(:), allocatable :: text
         text = ''
         ! in every state it would cost as much as a number
         if (self%is_naming) text = prefix//trim(load)//trim(conditions(held))
      end function stem

      subroutine put_lateral(load, response)
         character(*), intent(in) :: load
         type(response_t), intent(in) :: response

         call put_known(self, stem(load)//'deflection_mm_per_kn', response%patch(2)/mm_per_kn)
         call put_known(self, stem(load)//'centre_deflection_mm_per_kn', response%centre(2)/mm_per_kn)
         call put_known(self, stem(load)//'steer_deg_per_kn', response%steer/deg_per_kn)
         call put_known(self, stem(load)//'camber_deg_per_kn', response%camber/deg_per_kn)
      end subroutine put_lateral

      subroutine put_longitudinal(load, response, deflection)
         character(*), intent(in) :: load
         type(response_t), intent(in) :: response
         real(wp), intent(in) :: deflection        !! m/N

         call put_known(self, load//'deflection_mm_per_kn', deflection/mm_per_kn)
         call put_angles(self, load, response, '_deg_per_kn', deg_per_kn, has_caster)
         call put_known(self, load//'toe_deg_per_kn', response%toe/deg_per_kn)
         call put_rotation(self, load, response, '_deg_per_kn', deg_per_kn, frame)
      end subroutine put_longitudinal

   end subroutine put_forces

   !> The slopes of steer, camber and, with a geometric steer axis, caster.
   subroutine put_angles(self, stem, response, ending, unit, has_caster)
      type(kandc_t), intent(inout) :: self
      character(*), intent(in) :: stem, ending
      type(response_t), intent(in) :: response
      real(wp), intent(in) :: unit
      logical, intent(in) :: has_caster

      call put_known(self, stem//'steer'//ending, response%steer/unit)
      call put_known(self, stem//'camber'//ending, response%camber/unit)
      if (has_caster) call put_known(self, stem//'caster'//ending, response%caster/unit)
   end subroutine put_angles

   !> The rotation of the carrier, in the deck's frame.
   subroutine put_rotation(self, stem, response, ending, unit, frame)
      type(kandc_t), intent(inout) :: self
      character(*), intent(in) :: stem, ending
      type(response_t), intent(in) :: response
      real(wp), intent(in) :: unit, frame

      call put_known(self, stem//'rotation_x'//ending, frame*response%rotation(1)/unit)
      call put_known(self, stem//'rotation_y'//ending, frame*response%rotation(2)/unit)
      call put_known(self, stem//'rotation_z'//ending, response%rotation(3)/unit)
   end subroutine put_rotation

end module ek_response_columns
