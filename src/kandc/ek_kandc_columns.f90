!> The columns of the quantities of K&C: which of them a model defines, and their values at a state.
!>
!> Name, unit and value of a column stand in one line below; the list is gone through once without values for the
!> names, then once a state. input/QUANTITIES.md says what each of them means.
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
   use ek_wheel_side, only: is_axle, prefix_of
   use ek_wheel_force, only: vertical_force
   use ek_compliance, only: compliance_t, new_compliance, wheel_compliance
   use ek_characteristics, only: wheel_characteristics_t, axle_characteristics_t, sway_t, wheel_characteristics, &
      axle_characteristics, patch_matrix, motion_ratio, quotient
   use ek_steer_angle, only: steer_of, steer_rate, axle_roll, inclination_of, ackermann_percent, ackermann_error, &
      turning_circle
   use ek_steer_axis, only: instant_axis, locked_twist
   use ek_geometry_columns, only: column_list_t, geometry_columns
   use ek_table, only: name_length
   implicit none(type, external)
   private
   public :: kandc_t, start_kandc, tell_kandc

   ! what a value in SI is divided by
   real(wp), parameter :: per_metre = degree                       !! deg/m
   real(wp), parameter :: n_per_mm = 1.0e3_wp                      !! N/mm
   real(wp), parameter :: mm_per_kn = 1.0e-6_wp                    !! mm/kN
   real(wp), parameter :: deg_per_kn = degree/1.0e3_wp             !! deg/kN
   real(wp), parameter :: deg_per_100nm = degree/100.0_wp          !! deg/(100 N m)
   real(wp), parameter :: nm_per_deg = 1.0_wp/degree               !! N m/deg
   real(wp), parameter :: least_rack_rate = 1.0e-6_wp              !! rad/m: a rack that does not steer

   !> The columns of a model and the work space to fill them.
   type :: kandc_t
      integer :: used = 0                              !! columns
      character(name_length), allocatable :: names(:)
      real(wp), allocatable :: values(:)
      logical :: is_naming = .true.
      type(vehicle_t) :: vehicle
      type(compliance_t) :: compliance
      type(column_list_t) :: geometry
   end type kandc_t

contains

   !> The names of all columns that a model defines: self%names(:self%used).
   subroutine start_kandc(suspension, vehicle, self)
      type(suspension_t), intent(in) :: suspension
      type(vehicle_t), intent(in) :: vehicle
      type(kandc_t), intent(out) :: self

      self%vehicle = vehicle
      self%compliance = new_compliance(suspension, vehicle%steer_row > 0)
      allocate (self%names(128))
      call list(suspension, design_state(suspension), demand_t(), self)
      self%is_naming = .false.
      allocate (self%values(self%used), source=0.0_wp)
   end subroutine start_kandc

   !> Fills self%values at a state of equilibrium.
   subroutine tell_kandc(suspension, state, demand, kkt, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(demand_t), intent(in) :: demand
      type(kkt_t), intent(inout) :: kkt          !! work space
      type(kandc_t), intent(inout) :: self

      call wheel_compliance(suspension, state, demand, rig_rows(suspension), self%vehicle%steer_row, kkt, self%compliance)
      call list(suspension, state, demand, self)
   end subroutine tell_kandc

   !> The rows of Φ that are not the suspension's but the rig's: it holds a wheel at a height.
   pure function rig_rows(suspension) result(rows)
      type(suspension_t), intent(in) :: suspension
      integer, allocatable :: rows(:)
      integer :: k

      rows = pack([(k, k=1, size(suspension%rows))], suspension%joints(suspension%rows%joint)%is_rig)
   end function rig_rows

   !> Goes through all columns: wheels, then the axle, then the springs.
   subroutine list(suspension, state, demand, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(demand_t), intent(in) :: demand
      type(kandc_t), intent(inout) :: self
      type(attitude_t) :: now(size(suspension%wheels))
      real(wp) :: centre(3, size(suspension%wheels)), patch(3, size(suspension%wheels)), tyre(size(suspension%wheels))
      real(wp) :: radius(size(suspension%wheels)), lift(size(suspension%wheels)), roll, track, ratio
      integer :: w, k, n

      n = 6*size(suspension%wheels)
      self%used = 0
      do k = 1, size(suspension%wheels)
         w = self%compliance%order(k)
         now(k) = wheel_attitude(suspension, state, w)
         associate (wheel => suspension%wheels(w), pose => state%poses(suspension%wheels(w)%body + 1))
            centre(:, k) = pose%r + rotated(pose%a, wheel%centre)
            radius(k) = wheel%radius
         end associate
         patch(:, k) = centre(:, k) - [0.0_wp, 0.0_wp, radius(k)]
         lift(k) = vertical_force(suspension, state, demand, w)
         tyre(k) = 0.0_wp
         if (allocated(self%vehicle%tyre_rate)) tyre(k) = self%vehicle%tyre_rate(w)
      end do
      roll = 0.0_wp
      track = 0.0_wp
      if (is_axle(suspension)) then
         roll = axle_roll(patch(:, 1), patch(:, 2))
         track = patch(2, 2) - patch(2, 1)
      end if
      do k = 1, size(suspension%wheels)
         call list_wheel(suspension, state, k, now(k), centre(:, k), lift(k), radius, roll, track, tyre, self)
      end do
      if (is_axle(suspension)) call list_axle(suspension, now, patch, lift, radius, roll, track, tyre, self)
      call list_steering(suspension, state, self)
      call geometry_columns(suspension, self%vehicle, self%compliance, state, self%geometry)
      do k = 1, self%geometry%used
         call put(self, trim(self%geometry%names(k)), self%geometry%values(k))
      end do
      if (n == 0) return                                ! no wheel, no travel
      do k = 1, self%compliance%springs
         ratio = 0.0_wp
         if (self%compliance%is_known) ratio = motion_ratio(self%compliance%response(:n, :n), &
            self%compliance%response(n + k, :n))
         call put_known(self, suspension%springs(self%compliance%spring(k))%name//'_motion_ratio', ratio)
      end do
   end subroutine list

   !> One wheel.
   subroutine list_wheel(suspension, state, place, now, centre, lift, radius, roll, track, tyre, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: place               !! in the compliance matrix
      type(attitude_t), intent(in) :: now
      real(wp), intent(in) :: centre(3), lift, radius(:), roll, track, tyre(:)    !! lift: force of the ground [N]
      type(kandc_t), intent(inout) :: self
      type(wheel_characteristics_t) :: is
      type(steer_axis_t) :: axis
      character(:), allocatable :: prefix
      real(wp) :: contact(3)
      integer :: w
      logical :: is_pair, is_shod

      w = self%compliance%order(place)
      prefix = prefix_of(suspension, w)
      is_pair = is_axle(suspension)
      is_shod = all(tyre > 0.0_wp)
      associate (wheel => suspension%wheels(w), pose => state%poses(suspension%wheels(w)%body + 1), &
            axle => self%vehicle%axle, c => self%compliance%response)
         contact = pose%r + rotated(pose%a, wheel%contact)
         if (self%compliance%is_known) then
            axis = instant_axis(self%compliance, place, wheel%side, centre, contact)
            if (is_pair) then
               is = wheel_characteristics(c(:12, :12), patch_matrix(c(:12, :12), radius), place, wheel%side, track, tyre, axle)
            else
               associate (own => c(6*place - 5:6*place, 6*place - 5:6*place))
                  is = wheel_characteristics(own, patch_matrix(own, radius(place:place)), 1, wheel%side, track, &
                     tyre(place:place), axle)
               end associate
               is_shod = tyre(place) > 0.0_wp
            end if
         else if (.not. is_pair) then
            is_shod = tyre(place) > 0.0_wp
         end if

         call put(self, prefix//'steer_deg', steer_of(now%toe, wheel%side)/degree)
         if (is_pair) call put(self, prefix//'inclination_deg', inclination_of(now%camber, wheel%side, roll)/degree)
         call put(self, prefix//'vertical_force_n', lift)
         call put_axis(self, prefix//'instant_', axis)
         call put_known(self, prefix//'wheel_rate_n_per_mm', is%wheel_rate/n_per_mm)
         if (is_shod) call put_known(self, prefix//'ride_rate_n_per_mm', is%ride_rate/n_per_mm)
         call put_known(self, prefix//'bump_steer_deg_per_m', is%bump_steer/per_metre)
         call put_known(self, prefix//'bump_toe_deg_per_m', is%bump_toe/per_metre)
         call put_known(self, prefix//'bump_camber_deg_per_m', is%bump_camber/per_metre)
         call put_known(self, prefix//'bump_caster_deg_per_m', is%bump_caster/per_metre)
         if (is_pair .and. is_shod) then
            call put_known(self, prefix//'roll_steer_deg_per_deg', is%roll_steer)
            call put_known(self, prefix//'roll_camber_deg_per_deg', is%roll_camber)
            call put_known(self, prefix//'roll_caster_deg_per_deg', is%roll_caster)
         end if
         if (is_pair) then
            call put_known(self, prefix//'wheel_roll_steer_deg_per_deg', is%wheel_roll_steer)
            call put_known(self, prefix//'wheel_roll_camber_deg_per_deg', is%wheel_roll_camber)
            call put_known(self, prefix//'wheel_roll_caster_deg_per_deg', is%wheel_roll_caster)
         end if
         call put_known(self, prefix//'side_view_arm_length_mm', is%side_arm_length/millimetre)
         call put_known(self, prefix//'side_view_arm_angle_deg', is%side_arm_angle/degree)
         call put_known(self, prefix//'front_view_arm_length_mm', is%front_arm_length/millimetre)
         call put_known(self, prefix//'front_view_arm_angle_deg', is%front_arm_angle/degree)
         call put_lateral(self, prefix//'lateral_in_', is%lateral_in)
         if (is_pair) call put_lateral(self, prefix//'lateral_anti_', is%lateral_anti)
         call put_lateral(self, prefix//'lateral_in_trail_', is%lateral_in_trail)
         if (is_pair) call put_lateral(self, prefix//'lateral_anti_trail_', is%lateral_anti_trail)
         call put_known(self, prefix//'aligning_in_steer_deg_per_100nm', is%aligning_in%steer/deg_per_100nm)
         call put_known(self, prefix//'aligning_in_camber_deg_per_100nm', is%aligning_in%camber/deg_per_100nm)
         if (is_pair) then
            call put_known(self, prefix//'aligning_anti_steer_deg_per_100nm', is%aligning_anti%steer/deg_per_100nm)
            call put_known(self, prefix//'aligning_anti_camber_deg_per_100nm', is%aligning_anti%camber/deg_per_100nm)
         end if
         call put_known(self, prefix//'braking_deflection_mm_per_kn', is%braking_deflection/mm_per_kn)
         call put_known(self, prefix//'braking_steer_deg_per_kn', is%braking_steer/deg_per_kn)
         call put_known(self, prefix//'braking_caster_deg_per_kn', is%braking_caster/deg_per_kn)
         call put_known(self, prefix//'traction_deflection_mm_per_kn', is%traction_deflection/mm_per_kn)
         call put_known(self, prefix//'traction_steer_deg_per_kn', is%traction_steer/deg_per_kn)
         call put_known(self, prefix//'traction_caster_deg_per_kn', is%traction_caster/deg_per_kn)
         if (axle%has_axle .and. axle%is_front) then
            call put_known(self, prefix//'anti_dive_percent', 100.0_wp*is%anti_brake)
            call put_known(self, prefix//'anti_lift_drive_percent', 100.0_wp*is%anti_drive)
         else if (axle%has_axle) then
            call put_known(self, prefix//'anti_lift_brake_percent', 100.0_wp*is%anti_brake)
            call put_known(self, prefix//'anti_squat_percent', 100.0_wp*is%anti_drive)
         end if
         call put_known(self, prefix//'fore_aft_stiffness_n_per_mm', is%fore_aft_stiffness/n_per_mm)
         call put_known(self, prefix//'lateral_stiffness_n_per_mm', is%lateral_stiffness/n_per_mm)
         call put_known(self, prefix//'vertical_stiffness_n_per_mm', is%vertical_stiffness/n_per_mm)
      end associate
   end subroutine list_wheel

   !> Both wheels together.
   subroutine list_axle(suspension, now, patch, lift, radius, roll, track, tyre, self)
      type(suspension_t), intent(in) :: suspension
      type(attitude_t), intent(in) :: now(2)             !! left, right
      real(wp), intent(in) :: patch(3, 2), lift(2), radius(2), roll, track, tyre(2)
      type(kandc_t), intent(inout) :: self
      type(axle_characteristics_t) :: is
      real(wp) :: frame, left, right

      associate (c => self%compliance%response, axle => self%vehicle%axle)
         if (self%compliance%is_known) is = axle_characteristics(c(:12, :12), patch_matrix(c(:12, :12), radius), patch, tyre)
         frame = merge(-1.0_wp, 1.0_wp, suspension%is_iso)
         call put_known(self, 'suspension_roll_rate_nm_per_deg', is%suspension_roll_rate/nm_per_deg)
         if (all(tyre > 0.0_wp)) call put_known(self, 'total_roll_rate_nm_per_deg', is%total_roll_rate/nm_per_deg)
         call put(self, 'roll_moment_nm', 0.5_wp*track*(lift(1) - lift(2)))
         call put(self, 'axle_roll_deg', roll/degree)
         call put_known(self, 'roll_centre_y_mm', frame*is%roll_centre(1)/millimetre)
         call put_known(self, 'roll_centre_z_mm', is%roll_centre(2)/millimetre)
         call put_known(self, 'roll_centre_height_mm', (is%roll_centre(2) - 0.5_wp*(patch(3, 1) + patch(3, 2)))/millimetre)
         if (.not. axle%has_axle .or. self%vehicle%steer_row == 0) return
         left = steer_of(now(1)%toe, -1)
         right = steer_of(now(2)%toe, 1)
         call put(self, 'turning_circle_m', turning_circle(left, right, axle%wheelbase))
         ! what the steering does, without the static toe
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

   !> Steering wheel against road wheels, of a model with a rack and its ratio.
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
      ! positive to the left whichever way the rack has to go for that
      call put(self, 'steering_wheel_deg', sign(per_rack, rate)*row_change(suspension, state, self%vehicle%steer_row)/degree)
   end subroutine list_steering

   !> What a driver's row prescribes at a state, from design [m, rad]: its measure less what its own compliance gives way.
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

   !> The three columns of what a lateral force does.
   subroutine put_lateral(self, stem, sway)
      type(kandc_t), intent(inout) :: self
      character(*), intent(in) :: stem
      type(sway_t), intent(in) :: sway
      call put_known(self, stem//'deflection_mm_per_kn', sway%deflection/mm_per_kn)
      call put_known(self, stem//'steer_deg_per_kn', sway%steer/deg_per_kn)
      call put_known(self, stem//'camber_deg_per_kn', sway%camber/deg_per_kn)
   end subroutine put_lateral

   !> The six columns of a steer axis; not a number where the axis is not known.
   subroutine put_axis(self, stem, axis)
      type(kandc_t), intent(inout) :: self
      character(*), intent(in) :: stem
      type(steer_axis_t), intent(in) :: axis
      real(wp) :: values(6)

      values = ieee_value(1.0_wp, ieee_quiet_nan)
      if (axis%is_known) values = [axis%caster/degree, axis%kingpin_inclination/degree, axis%scrub_radius/millimetre, &
         axis%caster_trail/millimetre, axis%spindle_length/millimetre, axis%spindle_offset/millimetre]
      call put(self, stem//'caster_deg', values(1))
      call put(self, stem//'kingpin_inclination_deg', values(2))
      call put(self, stem//'scrub_radius_mm', values(3))
      call put(self, stem//'caster_trail_mm', values(4))
      call put(self, stem//'spindle_length_mm', values(5))
      call put(self, stem//'spindle_offset_mm', values(6))
   end subroutine put_axis

   !> A column from the compliance matrix: not a number where that is not known.
   subroutine put_known(self, name, value)
      type(kandc_t), intent(inout) :: self
      character(*), intent(in) :: name
      real(wp), intent(in) :: value

      if (self%compliance%is_known .or. self%is_naming) then
         call put(self, name, value)
      else
         call put(self, name, ieee_value(1.0_wp, ieee_quiet_nan))
      end if
   end subroutine put_known

   !> The next column: its name in the first pass, its value afterwards.
   subroutine put(self, name, value)
      type(kandc_t), intent(inout) :: self
      character(*), intent(in) :: name
      real(wp), intent(in) :: value
      character(name_length), allocatable :: more(:)

      self%used = self%used + 1
      if (.not. self%is_naming) then
         self%values(self%used) = value
         return
      end if
      if (self%used > size(self%names)) then
         allocate (more(2*size(self%names)))
         more(:self%used - 1) = self%names
         call move_alloc(more, self%names)
      end if
      self%names(self%used) = name
   end subroutine put

end module ek_kandc_columns
