!> The columns of the K&C quantities: those that a model defines, and their values at a state.
!>
!> The sections of ek_quantity give names, units and conditions; each kernel here returns the values of its section in SI, in the
!> same order. A quantity without a value at a state is not a number.
!>
!> The ending of a column names the quantity whose slope it is: `…_steer`, `…_toe`, `…_camber`, `…_caster` are the
!> derivatives of the columns steer_deg, toe_deg, camber_deg and caster_deg; `…_rotation_x`, `…_y`, `…_z` are the
!> rotation of the carrier about an axis of the deck's frame; `…_deflection` is the movement of the contact point (of the
!> wheel centre in traction), `…_centre_deflection` that of the wheel centre.
module ek_kandc_columns
   use ek_kinds, only: wp, pi
   use ek_quantity, only: wheel_rates, wheel_forces, wheel_stiffness, of_axle, of_steering, wheel_geometry, axle_geometry, &
      of_rack
   use ek_measure, only: measure_value
   use ek_element, only: element_kinds, measure_spring, is_of_angle
   use ek_suspension, only: suspension_t, driver_row
   use ek_state, only: state_t, inputs_t
   use ek_kkt, only: kkt_t
   use ek_attitude, only: attitude_t, wheel_attitude, steer_axis_t, axis_values, static_toe, vertical_force
   use ek_wheel_side, only: is_axle, prefix_of, design_track, deck_frame
   use ek_compliance, only: compliance_t, new_compliance, wheel_compliance
   use ek_characteristics, only: wheel_characteristics_t, axle_characteristics_t, stand_t, response_t, wheel_characteristics, &
      axle_characteristics, motion_ratio, quotient, in_phase, anti_phase, load_held, height_held
   use ek_column_list, only: column_list_t, begin_list, add_quantities, add_column, end_block, fill_block, conditions_of
   use ek_steer_angle, only: steer_of, steer_rate, axle_roll, inclination_of, ackermann_percent, ackermann_error, &
      turning_circle
   use ek_geometry_columns, only: wheel_geometry_values, axle_geometry_values, element_values, instant_axis, locked_twist
   implicit none(type, external)
   private
   public :: kandc_t, start_kandc, same_columns, observe_kandc

   real(wp), parameter :: min_rack_rate = 1.0e-6_wp              !! rad/m: a rack that does not steer

   !> The columns of a model and the work space to fill them.
   type, extends(column_list_t) :: kandc_t
      integer :: steer_row = 0                 !! row of Φ of the steering driver, 0: none
      integer, allocatable :: has(:)           !! conditions of ek_quantity: of each wheel, and without a wheel
      real(wp), allocatable :: values(:)       !! of the columns, in their units
      type(compliance_t) :: compliance
   end type kandc_t

contains

   !> The names of all columns that a model defines: self%names(:self%used). Blocks: each wheel, the axle with its steering,
   !> the geometry of each wheel, that of the axle, elements, springs.
   subroutine start_kandc(suspension, self)
      type(suspension_t), intent(in) :: suspension
      type(kandc_t), intent(out) :: self
      integer :: both, k, w, held

      if (suspension%steering%has_steering) self%steer_row = driver_row(suspension, suspension%steering%driver)
      self%compliance = new_compliance(suspension, self%steer_row > 0)
      allocate (self%has(0:size(suspension%wheels)))
      call conditions_of(suspension, self%compliance%order, self%steer_row > 0, self%has)
      both = self%has(0)
      call begin_list(self, 256)
      do k = 1, self%compliance%wheels
         w = self%compliance%order(k)
         call add_quantities(self, wheel_rates, prefix_of(suspension, w), self%has(k))
         do held = load_held, height_held
            call add_quantities(self, wheel_forces, prefix_of(suspension, w), self%has(k), held)
         end do
         call add_quantities(self, wheel_stiffness, prefix_of(suspension, w), self%has(k))
         call end_block(self)
      end do
      call add_quantities(self, of_axle, '', both)
      call add_quantities(self, of_steering, '', both)
      call end_block(self)
      do k = 1, self%compliance%wheels
         call add_quantities(self, wheel_geometry, prefix_of(suspension, self%compliance%order(k)), self%has(k))
         call end_block(self)
      end do
      call add_quantities(self, axle_geometry, '', both)
      call end_block(self)
      do k = 1, merge(size(suspension%elements), 0, self%compliance%wheels > 0)      ! without a wheel there is no travel
         associate (element => suspension%elements(k))
            if (element_kinds(element%kind)%has_gap) call add_column(self, element%name//'_travel_left_mm', .true.)
            if (element%kind == measure_spring) then
               if (.not. is_of_angle(element%measure%kind)) call add_column(self, element%name//'_motion_ratio', .true.)
            end if
         end associate
      end do
      call add_quantities(self, of_rack, '', both)
      call end_block(self)
      do k = 1, merge(self%compliance%springs, 0, self%compliance%wheels > 0)
         call add_column(self, suspension%elements(self%compliance%spring(k))%name//'_motion_ratio', .true.)
      end do
      call end_block(self)
      allocate (self%values(self%used), source=0.0_wp)
   end subroutine start_kandc

   !> Whether another design of the same parts has the columns of `self`.
   logical function same_columns(suspension, self)
      type(suspension_t), intent(in) :: suspension
      type(kandc_t), intent(in) :: self
      integer :: has(0:size(suspension%wheels))

      same_columns = .false.
      if (size(has) /= size(self%has)) return
      call conditions_of(suspension, self%compliance%order, self%steer_row > 0, has)
      same_columns = all(has == self%has)
   end function same_columns

   !> Fills self%values at an equilibrium: all of them, or those of `choose`.
   subroutine observe_kandc(suspension, state, inputs, kkt, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(inout) :: kkt          !! work space
      type(kandc_t), intent(inout) :: self
      type(attitude_t) :: now(size(suspension%wheels))
      real(wp) :: vertical(size(suspension%wheels)), springs(self%compliance%springs), rack
      type(stand_t) :: stand
      integer :: w, k, n

      if (self%is_matrix_wanted) call wheel_compliance(suspension, state, inputs, self%steer_row, kkt, self%compliance)
      n = size(suspension%wheels)
      do k = 1, n
         w = self%compliance%order(k)
         now(k) = wheel_attitude(suspension, state, w)
         vertical(k) = vertical_force(suspension, state, inputs, w)
      end do
      if (is_axle(suspension)) stand = stand_of(suspension, now, self%compliance%order)
      do k = 1, n
         if (self%is_wanted(k)) call fill(k, wheel_values(suspension, k, now(k), vertical(k), stand, self))
         if (self%is_wanted(n + 1 + k)) call fill(n + 1 + k, wheel_geometry_values(suspension, self%compliance, now(k), k))
      end do
      if (self%is_wanted(n + 1)) call fill(n + 1, [axle_values(suspension, now, vertical, stand, self), &
         steering_values(suspension, state, now, self)])
      if (self%is_wanted(2*n + 2)) call fill(2*n + 2, axle_geometry_values(suspension, self%compliance, now))
      rack = 0.0_wp
      if (self%steer_row > 0) rack = -state%reaction(self%steer_row)
      if (self%is_wanted(2*n + 3)) call fill(2*n + 3, [element_values(suspension, self%compliance, state), rack])
      if (.not. self%is_wanted(2*n + 4)) return
      springs = 0.0_wp
      if (self%compliance%is_known .and. n > 0) then
         do k = 1, size(springs)
            springs(k) = motion_ratio(self%compliance%response(:6*n, :6*n), self%compliance%response(6*n + k, :6*n))
         end do
      end if
      call fill(2*n + 4, springs)

   contains

      subroutine fill(block, vector)
         integer, intent(in) :: block
         real(wp), intent(in) :: vector(:)
         call fill_block(self%column_list_t, block, vector, self%compliance%is_known, self%values)
      end subroutine fill

   end subroutine observe_kandc

   !> Positions of wheels of the compliance matrix: both of an axle, or a single one.
   type(stand_t) function stand_of(suspension, now, order) result(stand)
      type(suspension_t), intent(in) :: suspension
      type(attitude_t), intent(in) :: now(:)
      integer, intent(in) :: order(:)          !! numbers of these wheels
      integer :: k

      do k = 1, size(now)
         stand%axes(k) = now(k)%axes
         stand%centre(:, k) = now(k)%at_centre
         stand%arm(:, k) = now(k)%at_contact - now(k)%at_centre
         stand%tyre_rate(k) = suspension%wheels(order(k))%tyre_rate
      end do
      if (size(now) < 2) return
      stand%track = design_track(suspension)
      stand%roll = axle_roll(now(1)%at_contact, now(2)%at_contact, stand%track)
   end function stand_of

   !> The values of wheel_rates, wheel_forces with loads and with heights held, and wheel_stiffness.
   function wheel_values(suspension, place, now, vertical, both, self) result(values)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: place               !! index of the wheel in the compliance matrix
      type(attitude_t), intent(in) :: now
      real(wp), intent(in) :: vertical               !! force of the ground [N]
      type(stand_t), intent(in) :: both          !! both wheels of an axle
      type(kandc_t), intent(in) :: self
      real(wp) :: values(size(wheel_rates) + 2*size(wheel_forces) + size(wheel_stiffness))
      type(wheel_characteristics_t) :: is
      type(steer_axis_t) :: instant
      type(stand_t) :: stand
      real(wp) :: frame(3)
      integer :: at

      frame = deck_frame(suspension)
      stand = both
      at = place
      if (.not. is_axle(suspension)) then
         at = 1
         stand = stand_of(suspension, [now], [self%compliance%order(place)])
      end if
      associate (side => now%axes%side, axle => suspension%axle, c => self%compliance%response)
         if (self%compliance%is_known) then
            instant = instant_axis(self%compliance, place, side, now%at_centre, now%at_contact)
            if (is_axle(suspension)) then
               is = wheel_characteristics(c(:12, :12), stand, place, axle)
            else
               is = wheel_characteristics(c(6*place - 5:6*place, 6*place - 5:6*place), stand, 1, axle)
            end if
         end if
         values = [steer_of(now%toe, side), inclination_of(now%camber, side, stand%roll), vertical, axis_values(instant), &
            is%wheel_rate, is%single_rate, is%ride_rate, is%hop_rate, &
            is%bump%steer, is%bump%camber, is%bump%caster, is%bump%toe, frame*is%bump%rotation, &
            is%roll%steer, is%roll%camber, is%roll%caster, 100.0_wp*is%roll%steer, frame*is%roll%rotation, &
            is%wheel_roll%steer, is%wheel_roll%camber, is%wheel_roll%caster, 100.0_wp*is%wheel_roll%steer, &
            frame*is%wheel_roll%rotation, &
            is%side_arm_length, is%side_arm_angle, frame([1, 3])*is%side_arm_centre, &
            is%front_arm_length, is%front_arm_angle, frame(2:3)*is%front_arm_centre, &
            force_values(is, load_held, frame), force_values(is, height_held, frame), &
            is%jacking, is%stiffness, &
            100.0_wp*is%anti_brake, 100.0_wp*is%anti_drive, 100.0_wp*is%anti_brake, 100.0_wp*is%anti_drive, &
            is%brake_travel, -is%drive_travel, -is%brake_travel, is%drive_travel]      ! the body moves down if the wheel moves up
      end associate
   end function wheel_values

   !> The values of wheel_forces under one condition.
   pure function force_values(is, held, frame) result(values)
      type(wheel_characteristics_t), intent(in) :: is
      integer, intent(in) :: held
      real(wp), intent(in) :: frame(3)
      real(wp) :: values(size(wheel_forces))

      associate (braking => is%braking(held), traction => is%traction(held))
         values = [lateral(is%lateral(in_phase, held)), lateral(is%lateral_trail(in_phase, held)), &
            is%aligning(in_phase, held)%steer, is%aligning(in_phase, held)%camber, &
            lateral(is%lateral(anti_phase, held)), lateral(is%lateral_trail(anti_phase, held)), &
            is%aligning(anti_phase, held)%steer, is%aligning(anti_phase, held)%camber, &
            braking%patch(1), braking%steer, braking%camber, braking%caster, braking%toe, frame*braking%rotation, &
            braking%centre(1), &
            -traction%centre(1), traction%steer, traction%camber, traction%caster, traction%toe, frame*traction%rotation]
      end associate

   contains

      pure function lateral(response)
         type(response_t), intent(in) :: response
         real(wp) :: lateral(4)
         lateral = [response%patch(2), response%centre(2), response%steer, response%camber]
      end function lateral

   end function force_values

   !> The values of of_axle; 0 unless there are two wheels.
   function axle_values(suspension, now, vertical, stand, self) result(values)
      type(suspension_t), intent(in) :: suspension
      type(attitude_t), intent(in) :: now(:)             !! left, right
      real(wp), intent(in) :: vertical(:)
      type(stand_t), intent(in) :: stand
      type(kandc_t), intent(in) :: self
      real(wp) :: values(size(of_axle))
      type(axle_characteristics_t) :: is
      real(wp) :: frame(3), ground, left, right, turn(3)

      values = 0.0_wp
      if (.not. is_axle(suspension)) return
      associate (c => self%compliance%response, axle => suspension%axle, track => stand%track)
         if (self%compliance%is_known) is = axle_characteristics(c(:12, :12), stand)
         frame = deck_frame(suspension)
         ground = 0.5_wp*sum(stand%centre(3, :) + stand%arm(3, :))
         turn = 0.0_wp
         if (axle%has_axle .and. self%steer_row > 0) then
            left = steer_of(now(1)%toe, -1)
            right = steer_of(now(2)%toe, 1)
            turn(1) = turning_circle(left, right, axle%wheelbase)
            ! the effect of the steering, without the static toe
            left = left - steer_of(static_toe(suspension%wheels(self%compliance%order(1))), -1)
            right = right - steer_of(static_toe(suspension%wheels(self%compliance%order(2))), 1)
            turn(2) = ackermann_percent(left, right, axle%wheelbase, track)
            turn(3) = ackermann_error(left, right, axle%wheelbase, track)
         end if
         values = [is%suspension_roll_rate, is%total_roll_rate, is%tramp_rate, 0.5_wp*track*(vertical(1) - vertical(2)), &
            stand%roll, frame(2)*is%roll_centre(1), is%roll_centre(2), is%roll_centre(2) - ground, &
            frame(2)*is%tyre_roll_centre(1), is%tyre_roll_centre(2) - ground, is%force_roll_centre, turn]
      end associate
   end function axle_values

   !> The values of of_steering; 0 without a rack and its ratio.
   function steering_values(suspension, state, now, self) result(values)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(attitude_t), intent(in) :: now(:)       !! in the order of the compliance matrix
      type(kandc_t), intent(in) :: self
      real(wp) :: values(size(of_steering)), rate, twist(6), per_rack
      integer :: k

      values = 0.0_wp
      if (self%steer_row == 0 .or. .not. abs(suspension%steering%ratio) > 0.0_wp) return
      per_rack = 2.0_wp*pi/abs(suspension%steering%ratio)
      rate = 0.0_wp
      if (self%compliance%is_known) then
         do k = 1, self%compliance%wheels
            twist = locked_twist(self%compliance, k, .true.)
            rate = rate + steer_rate(now(k)%axes%spin, twist(4:6))/self%compliance%wheels
         end do
      end if
      ! the angle of the steering wheel is positive to the left for either direction of the rack
      values = [quotient(per_rack, abs(rate), min_rack_rate), &
         sign(per_rack, rate)*row_change(suspension, state, self%steer_row)]
   end function steering_values

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

end module ek_kandc_columns
