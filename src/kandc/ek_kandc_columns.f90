!> The columns of the K&C quantities: those that a model defines, and their values at a state.
!>
!> Name, unit and value of a column are given in one line below; the list is processed once without values for the
!> names, then once per state. input/QUANTITIES.md defines each of them.
module ek_kandc_columns
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_units, only: pi, degree, millimetre
   use ek_measure, only: measure_value
   use ek_block, only: rotated
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, demand_t, design_state
   use ek_kkt, only: kkt_t
   use ek_attitude, only: attitude_t, wheel_attitude, steer_axis_t
   use ek_vehicle, only: vehicle_t
   use ek_wheel_side, only: is_axle, prefix_of, design_track
   use ek_wheel_force, only: vertical_force
   use ek_compliance, only: new_compliance, wheel_compliance
   use ek_characteristics, only: wheel_characteristics_t, axle_characteristics_t, stand_t, wheel_characteristics, &
      axle_characteristics, motion_ratio, quotient
   use ek_angle_rate, only: axes_of
   use ek_kandc_row, only: kandc_t, put, put_known, choose, begin_block, end_block
   use ek_response_columns, only: put_rates, put_arms, put_forces
   use ek_steer_angle, only: steer_of, steer_rate, axle_roll, inclination_of, ackermann_percent, ackermann_error, &
      turning_circle
   use ek_steer_axis, only: instant_axis, locked_twist
   use ek_geometry_columns, only: geometry_columns
   implicit none(type, external)
   private
   public :: kandc_t, start_kandc, choose, tell_kandc, rig_rows

   real(wp), parameter :: nm_per_deg = 1.0_wp/degree               !! N m/deg
   real(wp), parameter :: least_rack_rate = 1.0e-6_wp              !! rad/m: a rack that does not steer

contains

   !> The names of all columns that a model defines: self%names(:self%used).
   subroutine start_kandc(suspension, vehicle, self)
      type(suspension_t), intent(in) :: suspension
      type(vehicle_t), intent(in) :: vehicle
      type(kandc_t), intent(out) :: self

      self%vehicle = vehicle
      self%compliance = new_compliance(suspension, vehicle%steer_row > 0)
      allocate (self%names(128), self%is_of_matrix(128), self%last(0), self%is_passed_over(0))
      call list(suspension, design_state(suspension), demand_t(), self)
      self%is_naming = .false.
      allocate (self%values(self%used), source=0.0_wp)
   end subroutine start_kandc

   !> Fills self%values at an equilibrium: all of them, or those of `choose`.
   subroutine tell_kandc(suspension, state, demand, kkt, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(demand_t), intent(in) :: demand
      type(kkt_t), intent(inout) :: kkt          !! work space
      type(kandc_t), intent(inout) :: self

      if (self%is_matrix_wanted) &
         call wheel_compliance(suspension, state, demand, rig_rows(suspension), self%vehicle%steer_row, kkt, self%compliance)
      call list(suspension, state, demand, self)
   end subroutine tell_kandc

   !> The rows of Φ of the rig that hold a wheel at a height.
   pure function rig_rows(suspension) result(rows)
      type(suspension_t), intent(in) :: suspension
      integer, allocatable :: rows(:)
      integer :: k

      rows = pack([(k, k=1, size(suspension%rows))], suspension%joints(suspension%rows%joint)%is_rig)
   end function rig_rows

   !> Processes all columns: wheels, then the axle, then the springs.
   subroutine list(suspension, state, demand, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(demand_t), intent(in) :: demand
      type(kandc_t), intent(inout) :: self
      type(attitude_t) :: now(size(suspension%wheels))
      real(wp) :: lift(size(suspension%wheels)), ratio
      type(stand_t) :: stand
      integer :: w, k, n
      logical :: is_passed_over

      n = 6*size(suspension%wheels)
      self%used = 0
      self%blocks = 0
      do k = 1, size(suspension%wheels)
         w = self%compliance%order(k)
         now(k) = wheel_attitude(suspension, state, w)
         lift(k) = vertical_force(suspension, state, demand, w)
      end do
      if (is_axle(suspension)) stand = stand_of(suspension, state, self)
      do k = 1, size(suspension%wheels)
         call begin_block(self, is_passed_over)
         if (is_passed_over) cycle
         call list_wheel(suspension, state, k, now(k), lift(k), stand, self)
         call end_block(self)
      end do
      call begin_block(self, is_passed_over)
      if (.not. is_passed_over) then
         if (is_axle(suspension)) call list_axle(suspension, now, lift, stand, self)
         call list_steering(suspension, state, self)
         call end_block(self)
      end if
      call begin_block(self, is_passed_over)
      if (.not. is_passed_over) then
         call geometry_columns(suspension, self%vehicle, self%compliance, state, self%geometry)
         do k = 1, self%geometry%used
            call put(self, trim(self%geometry%names(k)), self%geometry%values(k), self%geometry%is_of_matrix(k))
         end do
         call end_block(self)
      end if
      if (n == 0) return                                ! without a wheel there is no travel
      call begin_block(self, is_passed_over)
      if (is_passed_over) return
      do k = 1, self%compliance%springs
         ratio = 0.0_wp
         if (self%compliance%is_known) ratio = motion_ratio(self%compliance%response(:n, :n), &
            self%compliance%response(n + k, :n))
         call put_known(self, suspension%elements(self%compliance%spring(k))%name//'_motion_ratio', ratio)
      end do
      call end_block(self)
   end subroutine list

   !> Positions of both wheels of an axle, in the order of the compliance matrix.
   type(stand_t) function stand_of(suspension, state, self) result(stand)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(kandc_t), intent(in) :: self
      integer :: k

      do k = 1, 2
         call stand_up(suspension, state, self, k, k, stand)
      end do
      stand%track = design_track(suspension)
      stand%roll = axle_roll(stand%centre(:, 1) + stand%arm(:, 1), stand%centre(:, 2) + stand%arm(:, 2), stand%track)
   end function stand_of

   !> Position of a wheel of the compliance matrix, at index `at` of a stand.
   pure subroutine stand_up(suspension, state, self, place, at, stand)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(kandc_t), intent(in) :: self
      integer, intent(in) :: place, at
      type(stand_t), intent(inout) :: stand

      associate (w => self%compliance%order(place))
         associate (wheel => suspension%wheels(w), pose => state%poses(suspension%wheels(w)%body + 1))
            stand%axes(at) = axes_of(wheel, pose)
            stand%centre(:, at) = pose%r + rotated(pose%a, wheel%centre)
            stand%arm(:, at) = rotated(pose%a, wheel%contact - wheel%centre)
         end associate
         if (allocated(self%vehicle%tyre_rate)) stand%tyre_rate(at) = self%vehicle%tyre_rate(w)
      end associate
   end subroutine stand_up

   !> The columns of one wheel.
   subroutine list_wheel(suspension, state, place, now, lift, pair, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: place               !! index of the wheel in the compliance matrix
      type(attitude_t), intent(in) :: now
      real(wp), intent(in) :: lift               !! force of the ground [N]
      type(stand_t), intent(in) :: pair          !! both wheels of an axle
      type(kandc_t), intent(inout) :: self
      type(wheel_characteristics_t) :: is
      type(steer_axis_t) :: axis
      type(stand_t) :: stand
      character(:), allocatable :: prefix
      real(wp) :: frame
      integer :: w, at
      logical :: is_pair, is_shod

      w = self%compliance%order(place)
      prefix = prefix_of(suspension, w)
      is_pair = is_axle(suspension)
      frame = merge(-1.0_wp, 1.0_wp, suspension%is_iso)
      if (is_pair) then
         stand = pair
         at = place
         is_shod = all(stand%tyre_rate > 0.0_wp)
      else
         call stand_up(suspension, state, self, place, 1, stand)
         at = 1
         is_shod = stand%tyre_rate(1) > 0.0_wp
      end if
      associate (wheel => suspension%wheels(w), axle => self%vehicle%axle, c => self%compliance%response)
         if (self%compliance%is_known) then
            axis = instant_axis(self%compliance, place, wheel%side, stand%centre(:, at), stand%centre(:, at) + stand%arm(:, at))
            if (is_pair) then
               is = wheel_characteristics(c(:12, :12), stand, place, axle)
            else
               is = wheel_characteristics(c(6*place - 5:6*place, 6*place - 5:6*place), stand, 1, axle)
            end if
         end if

         call put(self, prefix//'steer_deg', steer_of(now%toe, wheel%side)/degree)
         if (is_pair) call put(self, prefix//'inclination_deg', inclination_of(now%camber, wheel%side, stand%roll)/degree)
         call put(self, prefix//'vertical_force_n', lift)
         call put_axis(self, prefix//'instant_', axis)
         call put_rates(self, prefix, is, frame, is_pair, is_shod, wheel%has_steer_axis)
         call put_arms(self, prefix, is, frame)
         call put_forces(self, prefix, is, frame, is_pair, wheel%has_steer_axis)
         if (axle%has_axle .and. axle%is_front) then
            call put_known(self, prefix//'anti_dive_percent', 100.0_wp*is%anti_brake)
            call put_known(self, prefix//'anti_lift_drive_percent', 100.0_wp*is%anti_drive)
         else if (axle%has_axle) then
            call put_known(self, prefix//'anti_lift_brake_percent', 100.0_wp*is%anti_brake)
            call put_known(self, prefix//'anti_squat_percent', 100.0_wp*is%anti_drive)
         end if
         if (.not. (axle%has_axle .and. axle%mass > 0.0_wp)) return
         if (axle%is_front) then      ! the body moves down if the wheel moves up
            call put_known(self, prefix//'brake_dive_mm_per_g', is%brake_travel/millimetre)
            call put_known(self, prefix//'drive_lift_mm_per_g', -is%drive_travel/millimetre)
         else
            call put_known(self, prefix//'brake_lift_mm_per_g', -is%brake_travel/millimetre)
            call put_known(self, prefix//'drive_squat_mm_per_g', is%drive_travel/millimetre)
         end if
      end associate
   end subroutine list_wheel

   !> The columns of both wheels together.
   subroutine list_axle(suspension, now, lift, stand, self)
      type(suspension_t), intent(in) :: suspension
      type(attitude_t), intent(in) :: now(2)             !! left, right
      real(wp), intent(in) :: lift(2)
      type(stand_t), intent(in) :: stand
      type(kandc_t), intent(inout) :: self
      type(axle_characteristics_t) :: is
      real(wp) :: frame, left, right, ground
      logical :: is_shod

      associate (c => self%compliance%response, axle => self%vehicle%axle, track => stand%track)
         if (self%compliance%is_known) is = axle_characteristics(c(:12, :12), stand)
         is_shod = all(stand%tyre_rate > 0.0_wp)
         frame = merge(-1.0_wp, 1.0_wp, suspension%is_iso)
         ground = 0.5_wp*sum(stand%centre(3, :) + stand%arm(3, :))
         call put_known(self, 'suspension_roll_rate_nm_per_deg', is%suspension_roll_rate/nm_per_deg)
         if (is_shod) then
            call put_known(self, 'total_roll_rate_nm_per_deg', is%total_roll_rate/nm_per_deg)
            call put_known(self, 'tramp_rate_nm_per_deg', is%tramp_rate/nm_per_deg)
         end if
         call put(self, 'roll_moment_nm', 0.5_wp*track*(lift(1) - lift(2)))
         call put(self, 'axle_roll_deg', stand%roll/degree)
         call put_known(self, 'roll_centre_y_mm', frame*is%roll_centre(1)/millimetre)
         call put_known(self, 'roll_centre_z_mm', is%roll_centre(2)/millimetre)
         call put_known(self, 'roll_centre_height_mm', (is%roll_centre(2) - ground)/millimetre)
         if (is_shod) then
            call put_known(self, 'roll_centre_with_tyres_y_mm', frame*is%tyre_roll_centre(1)/millimetre)
            call put_known(self, 'roll_centre_with_tyres_height_mm', (is%tyre_roll_centre(2) - ground)/millimetre)
         end if
         call put_known(self, 'force_roll_centre_height_mm', is%force_roll_centre/millimetre)
         if (.not. axle%has_axle .or. self%vehicle%steer_row == 0) return
         left = steer_of(now(1)%toe, -1)
         right = steer_of(now(2)%toe, 1)
         call put(self, 'turning_circle_m', turning_circle(left, right, axle%wheelbase))
         ! the effect of the steering, without the static toe
         left = left - steer_of(design_toe(suspension, -1), -1)
         right = right - steer_of(design_toe(suspension, 1), 1)
         call put(self, 'ackermann_percent', ackermann_percent(left, right, axle%wheelbase, track))
         call put(self, 'ackermann_error_deg', ackermann_error(left, right, axle%wheelbase, track)/degree)
      end associate
   end subroutine list_axle

   !> Toe of the wheel of a side in the design position [rad].
   pure real(wp) function design_toe(suspension, side) result(toe)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: side
      integer :: k

      toe = 0.0_wp
      do k = 1, size(suspension%wheels)
         if (suspension%wheels(k)%side == side) &
            toe = atan2(-suspension%wheels(k)%spin(1), side*suspension%wheels(k)%spin(2))
      end do
   end function design_toe

   !> Ratio of steering wheel to road wheels, for a model with a rack and its ratio.
   subroutine list_steering(suspension, state, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(kandc_t), intent(inout) :: self
      real(wp) :: rate, twist(6), per_rack
      integer :: k, w

      if (self%vehicle%steer_row == 0 .or. .not. self%vehicle%steer_ratio > 0.0_wp) return
      per_rack = 2.0_wp*pi/self%vehicle%steer_ratio
      rate = 0.0_wp
      if (self%compliance%is_known) then
         do k = 1, self%compliance%wheels
            w = self%compliance%order(k)
            twist = locked_twist(self%compliance, k, .true.)
            rate = rate + steer_rate(rotated(state%poses(suspension%wheels(w)%body + 1)%a, suspension%wheels(w)%spin), &
               twist(4:6))/self%compliance%wheels
         end do
      end if
      call put_known(self, 'steering_ratio', quotient(per_rack, abs(rate), least_rack_rate))
      ! positive to the left for either direction of the rack
      call put(self, 'steering_wheel_deg', sign(per_rack, rate)*row_change(suspension, state, self%vehicle%steer_row)/degree, &
         .true.)
   end subroutine list_steering

   !> Prescribed value of a driver's row at a state, from design [m, rad]: its measure less the deflection of its compliance.
   pure real(wp) function row_change(suspension, state, row) result(change)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: row
      integer :: t

      change = -suspension%rows(row)%target - suspension%rows(row)%compliance*state%reaction(row)
      do t = suspension%rows(row)%first, suspension%rows(row)%first + suspension%rows(row)%terms - 1
         associate (m => suspension%terms(t)%measure)
            change = change + suspension%terms(t)%coefficient* &
               measure_value(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1))
         end associate
      end do
   end function row_change

   !> The six columns of a steer axis; not a number if the axis is unknown.
   subroutine put_axis(self, stem, axis)
      type(kandc_t), intent(inout) :: self
      character(*), intent(in) :: stem
      type(steer_axis_t), intent(in) :: axis
      real(wp) :: values(6)

      values = ieee_value(1.0_wp, ieee_quiet_nan)
      if (axis%is_known) values = [axis%caster/degree, axis%kingpin_inclination/degree, axis%scrub_radius/millimetre, &
         axis%caster_trail/millimetre, axis%spindle_length/millimetre, axis%spindle_offset/millimetre]
      call put(self, stem//'caster_deg', values(1), .true.)
      call put(self, stem//'kingpin_inclination_deg', values(2), .true.)
      call put(self, stem//'scrub_radius_mm', values(3), .true.)
      call put(self, stem//'caster_trail_mm', values(4), .true.)
      call put(self, stem//'spindle_length_mm', values(5), .true.)
      call put(self, stem//'spindle_offset_mm', values(6), .true.)
   end subroutine put_axis

end module ek_kandc_columns
