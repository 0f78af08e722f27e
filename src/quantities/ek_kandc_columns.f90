!> The values of the K&C quantities at a state.
!>
!> The sections of ek_quantity give names, units and conditions. The values of a section are computed in SI, in the same order, if
!> one of its columns is requested: in this module, in ek_wheel_columns or in ek_geometry_columns. A quantity without a value at a
!> state is NaN.
!>
!> The suffix of a column names the quantity whose slope the column is: `…_steer`, `…_toe`, `…_camber`, `…_caster` are the
!> derivatives of the columns steer_deg, toe_deg, camber_deg and caster_deg; `…_rotation_x`, `…_y`, `…_z` are the
!> rotation of the carrier about an axis of the deck's frame; `…_deflection` is the movement of the contact point (of the
!> wheel centre under driving force), `…_centre_deflection` is the movement of the wheel centre.
module ek_kandc_columns
   use ek_kinds, only: wp, pi, millimetre
   use ek_quantity, only: all_quantities, of_turn, of_steering, steer_columns => instant_axis
   use ek_measure, only: measure_value
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t
   use ek_kkt, only: kkt_t, assemble, whole_tangent
   use ek_attitude, only: attitude_t, wheel_attitude, axis_values, vertical_force
   use ek_compliance, only: respond
   use ek_port_response, only: find_lock
   use ek_loaded_wheels, only: stand_t, load_wheels, quotient
   use ek_characteristics, only: wheel_characteristics, motion_ratio, wheel_groups
   use ek_axle_characteristics, only: axle_characteristics
   use ek_kandc_list, only: kandc_t, begin_design, at_now, at_load, at_instant_axis, at_axle_rates, at_axle_now, at_roll_centres, &
      at_turn, at_steering, at_wheel_axis, at_instant_distances, at_slopes, at_axle_geometry, at_travel_left, at_motion_ratio, &
      at_rack, at_spring
   use ek_wheel_columns, only: wheel_values
   use ek_column_list, only: fill_block
   use ek_steer_angle, only: steer_of, steer_rate, axle_roll, inclination_of, ackermann_percent, ackermann_error, turning_circle
   use ek_geometry_columns, only: axis_geometry, instant_geometry, slope_values, axle_geometry_values, travel_left, length_ratio, &
      instant_axis, locked_twists
   implicit none(type, external)
   private
   public :: observe_kandc, fill_kandc

   real(wp), parameter :: min_rack_rate = 1.0e-6_wp              !! rad/m: a rack with a smaller rate does not steer
   integer, parameter :: most = size(all_quantities)             !! greatest number of values of a section

contains

   !> Computes self%values at an equilibrium: all values, or the values chosen by choose_kandc.
   subroutine observe_kandc(suspension, state, inputs, kkt, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(inout) :: kkt          !! work space
      type(kandc_t), intent(inout) :: self
      type(attitude_t) :: wheels(size(suspension%wheels))
      integer :: k

      do k = 1, size(wheels)
         wheels(k) = wheel_attitude(suspension, state, k)
      end do
      call begin_design(suspension, self)
      if (self%is_matrix_wanted) call assemble(suspension, state, inputs, whole_tangent, kkt)
      call fill_kandc(suspension, state, inputs, wheels, kkt, self)
   end subroutine observe_kandc

   !> Fills the requested columns. The attitudes of the wheels must be given, and the complete tangent must be assembled if
   !> self%is_matrix_wanted.
   subroutine fill_kandc(suspension, state, inputs, wheels, kkt, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(attitude_t), intent(in) :: wheels(:)  !! attitude of each wheel of the suspension, if self%has_wheels
      type(kkt_t), intent(inout) :: kkt          !! on return, with the factorised matrix
      type(kandc_t), intent(inout) :: self
      real(wp) :: values(most)
      integer :: b, k

      if (self%is_matrix_wanted) call respond(suspension, state, inputs, self%steer_row, kkt, self%compliance)
      if (self%is_pair .and. self%has_wheels) call set_stand(wheels, self)
      if (self%is_asked(at_load) .or. self%is_asked(at_axle_now)) then
         do k = 1, self%compliance%wheels
            self%vertical(k) = vertical_force(suspension, state, inputs, self%compliance%order(k))
         end do
      end if
      if (self%is_matrix_wanted .and. self%compliance%is_known) call characterise(suspension, wheels, self)
      values = 0.0_wp
      do k = 1, size(self%blocks)
         b = self%blocks(k)
         if (self%section(b) <= wheel_groups) then
            call wheel_values(self%section(b), self%wheel(self%item(b)), self%frame, values)
         else
            call section_values(suspension, state, wheels, self%section(b), self%item(b), self, values)
         end if
         call fill_block(self%column_list_t, b, values, self%compliance%is_known, self%values)
      end do
   end subroutine fill_kandc

   !> Sets the positions of both wheels of an axle, and the axle roll.
   pure subroutine set_stand(wheels, self)
      type(attitude_t), intent(in) :: wheels(:)
      type(kandc_t), intent(inout) :: self
      integer :: k

      do k = 1, 2
         call stand_wheel(wheels(self%compliance%order(k)), k, self%stand)
      end do
      self%stand%roll = axle_roll(wheels(self%compliance%order(1))%at_contact, wheels(self%compliance%order(2))%at_contact, &
         self%stand%track)
   end subroutine set_stand

   !> Stores axes, centre and arm of the contact point of wheel k.
   pure subroutine stand_wheel(now, k, stand)
      type(attitude_t), intent(in) :: now
      integer, intent(in) :: k
      type(stand_t), intent(inout) :: stand

      stand%axes(k) = now%axes
      stand%centre(:, k) = now%at_centre
      stand%arm(:, k) = now%at_contact - now%at_centre
   end subroutine stand_wheel

   !> Computes the quantities that several sections need, from a known compliance matrix.
   subroutine characterise(suspension, wheels, self)
      type(suspension_t), intent(in) :: suspension
      type(attitude_t), intent(in) :: wheels(:)
      type(kandc_t), intent(inout) :: self
      integer :: k, at

      associate (c => self%compliance%response)
         if (self%locks_heights) call find_lock(c, self%heights, self%held_heights)
         if (self%locks_springs) then
            if (self%compliance%springs > 0) then
               call find_lock(c, self%springs, self%held_springs)
               call locked_twists(self%compliance, self%held_springs, self%moves, self%free_twist)
            else
               call locked_twists(self%compliance, self%held_heights, self%moves, self%free_twist)
            end if
         end if
         if (self%is_asked(at_steering) .or. self%is_asked(at_slopes) .and. self%compliance%has_drive) &
            call locked_twists(self%compliance, self%held_heights, self%moves, self%held_twist)
         if (self%is_pair) then
            call load_wheels(c(:12, :12), self%stand%arm, self%has_patch, self%has_held, self%held_heights, self%loaded)
            do k = 1, 2
               if (any(self%is_group_asked(:, k))) call wheel_characteristics(self%loaded, self%stand, k, suspension%axle, &
                  self%is_group_asked(:, k), self%wheel(k))
            end do
            if (self%is_asked(at_axle_rates) .or. self%is_asked(at_roll_centres)) &
               call axle_characteristics(self%loaded, self%stand, self%is_asked(at_roll_centres), self%axle)
            return
         end if
         do k = 1, self%compliance%wheels       ! each by itself
            if (.not. any(self%is_group_asked(:, k))) cycle
            at = 6*(k - 1)
            call stand_wheel(wheels(self%compliance%order(k)), 1, self%stand)
            self%stand%tyre_rate(1) = suspension%wheels(self%compliance%order(k))%tyre_rate
            if (self%has_held) call find_lock(c(at + 1:at + 6, at + 1:at + 6), [3], self%held_wheel)
            call load_wheels(c(at + 1:at + 6, at + 1:at + 6), self%stand%arm(:, 1:1), self%has_patch, self%has_held, &
               self%held_wheel, self%loaded)
            call wheel_characteristics(self%loaded, self%stand, 1, suspension%axle, self%is_group_asked(:, k), self%wheel(k))
         end do
      end associate
   end subroutine characterise

   !> Computes the values of a section that is not a section of a wheel's characteristics, in SI; the travel to a stop is in mm.
   subroutine section_values(suspension, state, wheels, section, item, self, values)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(attitude_t), intent(in) :: wheels(:)
      integer, intent(in) :: section
      integer, intent(in) :: item             !! index of the wheel in the compliance matrix, or of the element
      type(kandc_t), intent(in) :: self
      real(wp), intent(inout) :: values(most) !! the first are set
      real(wp) :: lift(6), length(2)
      integer :: w, at

      associate (order => self%compliance%order, c => self%compliance%response, stand => self%stand, axle => suspension%axle, &
         is => self%axle)
         select case (section)
         case (at_now)
            associate (now => wheels(order(item)))
               values(1) = steer_of(now%toe, now%axes%side)
               values(2) = inclination_of(now%camber, now%axes%side, stand%roll)
            end associate
         case (at_load)
            values(1) = self%vertical(item)
         case (at_instant_axis)
            if (self%compliance%is_known) &
               values(:size(steer_columns)) = axis_values(instant_axis(self%free_twist(:, item), &
               self%compliance%has_drive, wheels(order(item))))
         case (at_instant_distances)
            if (self%compliance%is_known) call instant_geometry(self%free_twist(:, item), wheels(order(item)), values)
         case (at_wheel_axis)
            call axis_geometry(wheels(order(item)), self%frame, values)
         case (at_slopes)
            if (.not. self%compliance%is_known) return
            at = 6*(item - 1)
            lift = c(at + 1:at + 6, at + 3)
            if (self%compliance%wheels == 2) lift = lift + c(at + 1:at + 6, 9 - at)
            w = order(item)
            call slope_values(lift, self%held_twist(:, item), suspension%wheels(w)%tyre_rate, self%mass(item), wheels(w), values)
         case (at_axle_rates)
            values(1) = is%suspension_roll_rate
            values(2) = is%total_roll_rate
            values(3) = is%tramp_rate
         case (at_axle_now)
            values(1) = 0.5_wp*stand%track*(self%vertical(1) - self%vertical(2))
            values(2) = stand%roll
         case (at_roll_centres)
            values(1) = self%frame(2)*is%roll_centre(1)
            values(2) = is%roll_centre(2)
            values(3) = is%roll_centre(2) - ground()
            values(4) = self%frame(2)*is%tyre_roll_centre(1)
            values(5) = is%tyre_roll_centre(2) - ground()
            values(6) = is%force_roll_centre
         case (at_turn)
            call turn_values(wheels(order(1)), wheels(order(2)), axle%wheelbase, self, values)
         case (at_steering)
            call steering_values(suspension, state, wheels, self, values)
         case (at_axle_geometry)
            call axle_geometry_values(axle, self%tyre_width, self%has_turn, self%static, wheels(order(1)), wheels(order(2)), &
               values)
         case (at_travel_left)
            values(1) = travel_left(suspension, self%compliance, state, item)/millimetre
         case (at_motion_ratio)
            values(1) = length_ratio(suspension, self%compliance, state, item)
         case (at_rack)
            values(1) = -state%reaction(self%steer_row)
         case (at_spring)
            at = 6*self%compliance%wheels
            if (.not. self%compliance%is_known) return
            length = 0.0_wp
            do w = 1, min(self%compliance%wheels, 2)
               length(w) = c(at + item, 6*w - 3)
            end do
            values(1) = motion_ratio(c(:at, :at), length)
         end select
      end associate

   contains

      !> Mean height of the contact points [m].
      pure real(wp) function ground()
         ground = 0.5_wp*sum(self%stand%centre(3, :) + self%stand%arm(3, :))
      end function ground

   end subroutine section_values

   !> Computes the values of the section of_turn, for a model with &axle and a rack.
   pure subroutine turn_values(left_now, right_now, wheelbase, self, values)
      type(attitude_t), intent(in) :: left_now, right_now
      real(wp), intent(in) :: wheelbase
      type(kandc_t), intent(in) :: self
      real(wp), intent(inout) :: values(size(of_turn))
      real(wp) :: left, right

      left = steer_of(left_now%toe, -1)
      right = steer_of(right_now%toe, 1)
      values(1) = turning_circle(left, right, wheelbase)
      ! the effect of the steering, without the static toe
      left = left - self%static(1)
      right = right - self%static(2)
      values(2) = ackermann_percent(left, right, wheelbase, self%stand%track)
      values(3) = ackermann_error(left, right, wheelbase, self%stand%track)
   end subroutine turn_values

   !> Computes the values of the section of_steering: steering ratio and steering-wheel angle.
   pure subroutine steering_values(suspension, state, wheels, self, values)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(attitude_t), intent(in) :: wheels(:)
      type(kandc_t), intent(in) :: self
      real(wp), intent(inout) :: values(size(of_steering))
      real(wp) :: rate, per_rack
      integer :: k

      per_rack = 2.0_wp*pi/abs(suspension%steering%ratio)
      rate = 0.0_wp
      if (self%compliance%is_known) then
         do k = 1, self%compliance%wheels
            rate = rate + steer_rate(wheels(self%compliance%order(k))%axes%spin, self%held_twist(4:6, k))/self%compliance%wheels
         end do
      end if
      ! the angle of the steering wheel is positive to the left for either direction of the rack
      values(1) = quotient(per_rack, abs(rate), min_rack_rate)
      values(2) = sign(per_rack, rate)*row_change(suspension, state, self%steer_row)
   end subroutine steering_values

   !> Change of the prescribed value of a driver's row from design to a state [m, rad]: the change of the measures of the row, minus
   !> the deflection of the compliance of the row.
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
