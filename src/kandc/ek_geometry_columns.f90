!> Columns of the geometry of wheels and steering, of stops and of the rack: a list of names and values at a state.
!>
!> ek_kandc_columns appends the list to its own. A quantity that a model does not define has no column; a quantity without a
!> value at a state is not a number. input/QUANTITIES.md defines each of them.
module ek_geometry_columns
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_is_nan, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_units, only: degree, millimetre
   use ek_rotation, only: cross
   use ek_block, only: rotated
   use ek_measure, only: view_t, look, measure_value
   use ek_law, only: deflection
   use ek_element, only: stop_spring, measure_spring, is_of_angle
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, demand_t, design_state
   use ek_vehicle, only: vehicle_t
   use ek_wheel_side, only: is_axle, prefix_of
   use ek_wheel_force, only: vertical_force
   use ek_compliance, only: compliance_t
   use ek_characteristics, only: motion_ratio, quotient
   use ek_attitude, only: attitude_t, wheel_attitude
   use ek_steer_angle, only: steer_of, steer_rate, turning_circle
   use ek_steer_axis, only: locked_twist
   use ek_wheel_geometry, only: axis_distances_t, axis_distances, side_view_angle, camber_rate, ideal_outer_steer, outer_wheel, &
      wall_to_wall, ride_frequency
   use ek_table, only: name_length
   implicit none(type, external)
   private
   public :: column_list_t, geometry_columns

   real(wp), parameter :: standard_gravity = 9.80665_wp      !! m/s²
   real(wp), parameter :: least_compliance = 1.0e-12_wp      !! m/N, as in ek_characteristics
   real(wp), parameter :: least_turn = 1.0e-12_wp            !! rad/(N m), or rad/m of a rack: carrier does not steer
   real(wp), parameter :: least_ratio = 1.0e-6_wp            !! stop is independent of the wheels

   type :: column_list_t
      integer :: used = 0
      character(name_length), allocatable :: names(:)
      real(wp), allocatable :: values(:)
      logical, allocatable :: is_of_matrix(:)     !! the value comes from the compliance matrix
   end type column_list_t

contains

   !> All columns at a state. Those from the compliance matrix are not numbers if it is unknown.
   subroutine geometry_columns(suspension, vehicle, compliance, state, list)
      type(suspension_t), intent(in) :: suspension
      type(vehicle_t), intent(in) :: vehicle
      type(compliance_t), intent(in) :: compliance
      type(state_t), intent(in) :: state
      type(column_list_t), intent(inout) :: list
      integer :: k

      list%used = 0
      do k = 1, compliance%wheels
         call list_wheel(suspension, vehicle, compliance, state, k, list)
      end do
      if (is_axle(suspension)) call list_axle(suspension, vehicle, compliance, state, list)
      if (compliance%wheels > 0) then
         do k = 1, size(suspension%elements)
            select case (suspension%elements(k)%kind)
            case (stop_spring)
               call list_stop(suspension, compliance, state, k, list)
            case (measure_spring)
               if (is_of_angle(suspension%elements(k)%measure%kind)) cycle
               call put(list, suspension%elements(k)%name//'_motion_ratio', &
                  length_ratio(suspension, compliance, state, k), .true.)
            end select
         end do
      end if
      if (vehicle%steer_row > 0) call put(list, 'steering_rack_force_n', -state%reaction(vehicle%steer_row))
   end subroutine geometry_columns

   !> One wheel: side view, steer axes, slopes, frequency.
   subroutine list_wheel(suspension, vehicle, compliance, state, place, list)
      type(suspension_t), intent(in) :: suspension
      type(vehicle_t), intent(in) :: vehicle
      type(compliance_t), intent(in) :: compliance
      type(state_t), intent(in) :: state
      integer, intent(in) :: place                 !! index of the wheel in the compliance matrix
      type(column_list_t), intent(inout) :: list
      type(axis_distances_t) :: is
      character(:), allocatable :: prefix
      real(wp) :: centre(3), patch(3), spin(3), twist(6), column(6), recession, steer_camber, frequency, mass
      integer :: w

      w = compliance%order(place)
      prefix = prefix_of(suspension, w)
      associate (wheel => suspension%wheels(w), pose => state%poses(suspension%wheels(w)%body + 1))
         centre = pose%r + rotated(pose%a, wheel%centre)
         patch = pose%r + rotated(pose%a, wheel%contact)
         spin = rotated(pose%a, wheel%spin)
         call put(list, prefix//'side_view_angle_deg', side_view_angle(pose%a)/degree)
         if (wheel%has_steer_axis) then
            is = axis_distances(wheel%side, pose%r + rotated(pose%a, wheel%steer_axis(:, 1)), &
               rotated(pose%a, wheel%steer_axis(:, 2) - wheel%steer_axis(:, 1)), centre, patch, spin)
            call put_distances(list, prefix, is, .false.)
         end if

         is = nothing()
         if (compliance%is_known) then
            twist = locked_twist(compliance, place, .false.)
            if (norm2(twist(4:6)) > least_turn) is = axis_distances(wheel%side, &
               centre + cross(twist(4:6), twist(1:3))/dot_product(twist(4:6), twist(4:6)), twist(4:6), centre, patch, spin)
         end if
         call put_distances(list, prefix//'instant_', is, .true.)

         ! a comparison with NaN would trap: such values are not computed
         column = 0.0_wp
         recession = ieee_value(1.0_wp, ieee_quiet_nan)
         steer_camber = recession
         if (compliance%is_known) then
            column = in_phase(compliance, place)
            recession = quotient(column(1), column(3), least_compliance)
            twist = locked_twist(compliance, place, .true.)
            steer_camber = quotient(camber_rate(spin, twist(4:6)), steer_rate(spin, twist(4:6)), least_turn)
         end if
         call put(list, prefix//'recession_gradient_mm_per_m', 1.0e3_wp*recession, .true.)
         if (vehicle%steer_row > 0) call put(list, prefix//'steer_camber_deg_per_deg', steer_camber, .true.)
         mass = 0.0_wp
         if (wheel%tyre_rate > 0.0_wp) mass = mass_on(suspension, w)
         if (mass > 0.0_wp) then
            frequency = ieee_value(1.0_wp, ieee_quiet_nan)
            if (compliance%is_known) frequency = ride_frequency(1.0_wp/(column(3) + 1.0_wp/wheel%tyre_rate), mass)
            call put(list, prefix//'ride_frequency_hz', frequency, .true.)
         end if
      end associate
   end subroutine list_wheel

   !> Both wheels: track, and with &axle and &steering the quantities of a turn.
   subroutine list_axle(suspension, vehicle, compliance, state, list)
      type(suspension_t), intent(in) :: suspension
      type(vehicle_t), intent(in) :: vehicle
      type(compliance_t), intent(in) :: compliance
      type(state_t), intent(in) :: state
      type(column_list_t), intent(inout) :: list
      type(attitude_t) :: now(2)
      real(wp) :: y(2), track, change, steer(2), static(2), inner, outer, ideal, circle
      integer :: k, w, side

      do k = 1, 2
         w = compliance%order(k)
         now(k) = wheel_attitude(suspension, state, w)
         associate (wheel => suspension%wheels(w))
            y(k) = suspension%bodies(wheel%body)%origin(2) + wheel%contact(2) + now(k)%contact(2)
            steer(k) = steer_of(now(k)%toe, wheel%side)
            static(k) = steer_of(atan2(-wheel%spin(1), wheel%side*wheel%spin(2)), wheel%side)
         end associate
      end do
      track = y(2) - y(1)
      change = now(1)%track_change + now(2)%track_change
      call put(list, 'total_track_mm', track/millimetre)
      call put(list, 'total_track_change_mm', change/millimetre)
      associate (axle => vehicle%axle)
         if (.not. axle%has_axle .or. vehicle%steer_row == 0) return
         call outer_wheel(steer(1) - static(1), steer(2) - static(2), inner, outer, side)
         ideal = ideal_outer_steer(inner, axle%wheelbase, track)
         call put(list, 'ideal_outer_steer_deg', ideal/degree)
         call put(list, 'outer_steer_error_deg', (outer - ideal)/degree)
         call outer_wheel(steer(1), steer(2), inner, outer, side)
         circle = turning_circle(steer(1), steer(2), axle%wheelbase)
         if (all(suspension%wheels%tyre_width > 0.0_wp)) &
            call put(list, 'curb_to_curb_m', circle + suspension%wheels(compliance%order(side))%tyre_width)
         if (axle%front_overhang > 0.0_wp) &
            call put(list, 'wall_to_wall_m', wall_to_wall(outer, axle%wheelbase, track, axle%front_overhang, axle%front_width))
      end associate
   end subroutine list_axle

   !> Remaining wheel travel to the contact of a stop, with equal travel of all wheels: its gap over the change of the gap
   !> per travel.
   subroutine list_stop(suspension, compliance, state, k, list)
      type(suspension_t), intent(in) :: suspension
      type(compliance_t), intent(in) :: compliance
      type(state_t), intent(in) :: state
      integer, intent(in) :: k                     !! number of the stop
      type(column_list_t), intent(inout) :: list
      real(wp) :: gap, left

      left = ieee_value(1.0_wp, ieee_quiet_nan)
      associate (stop => suspension%elements(k), m => suspension%elements(k)%measure)
         gap = -deflection(stop%law, measure_value(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1)))
         if (compliance%is_known) left = gap_over(gap, length_ratio(suspension, compliance, state, k))
         call put(list, stop%name//'_travel_left_mm', left/millimetre, .true.)
      end associate
   end subroutine list_stop

   !> gap/|ratio|; not a number for a stop that is independent of the wheels, or wheels that do not move.
   pure real(wp) function gap_over(gap, ratio)
      real(wp), intent(in) :: gap, ratio      !! m, -
      gap_over = ieee_value(1.0_wp, ieee_quiet_nan)
      if (ieee_is_nan(ratio)) return
      gap_over = quotient(gap, abs(ratio), least_ratio)
   end function gap_over

   !> Change of the length of an element per wheel travel, with equal travel of all wheels: the motion ratio of an element that
   !> is not a port of the compliance matrix. Not a number if the matrix is unknown.
   real(wp) function length_ratio(suspension, compliance, state, k) result(ratio)
      type(suspension_t), intent(in) :: suspension
      type(compliance_t), intent(in) :: compliance
      type(state_t), intent(in) :: state
      integer, intent(in) :: k                     !! number of the element
      type(view_t) :: view
      real(wp) :: length(6*compliance%wheels)      ! per unit of each load of C [m/N, m/(N m)]
      integer :: n, j, at

      ratio = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. compliance%is_known) return
      n = size(length)
      associate (m => suspension%elements(k)%measure)
         call look(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), view)
         length = 0.0_wp
         do j = 1, n
            at = 6*(m%body_i - 1)
            if (at >= 0) length(j) = dot_product(view%gradient(1:6), compliance%columns(at + 1:at + 6, j))
            at = 6*(m%body_j - 1)
            if (at >= 0) length(j) = length(j) + dot_product(view%gradient(7:12), compliance%columns(at + 1:at + 6, j))
         end do
      end associate
      ratio = motion_ratio(compliance%response(:n, :n), length)
   end function length_ratio

   !> Response of the wheel centre per vertical force on every wheel: the third column of C, parallel loads. [m/N, rad/N]
   pure function in_phase(compliance, place) result(column)
      type(compliance_t), intent(in) :: compliance     !! known
      integer, intent(in) :: place
      real(wp) :: column(6)
      integer :: at, k

      at = 6*(place - 1)
      column = compliance%response(at + 1:at + 6, at + 3)
      if (compliance%wheels /= 2) return
      k = 9 - at
      column = column + compliance%response(at + 1:at + 6, k)
   end function in_phase

   !> The sprung mass of a wheel [kg]: from the deck, otherwise from the wheel load at design; 0 if there is neither.
   real(wp) function mass_on(suspension, wheel) result(mass)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: wheel

      mass = suspension%wheels(wheel)%sprung_mass
      if (.not. mass > 0.0_wp) mass = vertical_force(suspension, design_state(suspension), demand_t(), wheel)/standard_gravity
   end function mass_on

   pure type(axis_distances_t) function nothing()
      nothing%centre = ieee_value(1.0_wp, ieee_quiet_nan)
      nothing%patch = nothing%centre
      nothing%along = nothing%centre
      nothing%across = nothing%centre
   end function nothing

   subroutine put_distances(list, stem, is, is_of_matrix)
      type(column_list_t), intent(inout) :: list
      character(*), intent(in) :: stem
      type(axis_distances_t), intent(in) :: is
      logical, intent(in) :: is_of_matrix
      call put(list, stem//'centre_axis_distance_mm', is%centre/millimetre, is_of_matrix)
      call put(list, stem//'patch_axis_distance_mm', is%patch/millimetre, is_of_matrix)
      call put(list, stem//'along_spindle_length_mm', is%along/millimetre, is_of_matrix)
      call put(list, stem//'across_spindle_offset_mm', is%across/millimetre, is_of_matrix)
   end subroutine put_distances

   subroutine put(list, name, value, is_of_matrix)
      type(column_list_t), intent(inout) :: list
      character(*), intent(in) :: name
      real(wp), intent(in) :: value
      logical, intent(in), optional :: is_of_matrix      !! default .false.
      character(name_length), allocatable :: names(:)
      real(wp), allocatable :: values(:)
      logical, allocatable :: of_matrix(:)

      if (.not. allocated(list%names)) allocate (list%names(64), list%values(64), list%is_of_matrix(64))
      if (list%used == size(list%names)) then
         allocate (names(2*list%used), values(2*list%used), of_matrix(2*list%used))
         names(:list%used) = list%names
         values(:list%used) = list%values
         call move_alloc(names, list%names)
         call move_alloc(values, list%values)
         of_matrix(:list%used) = list%is_of_matrix
         call move_alloc(of_matrix, list%is_of_matrix)
      end if
      list%used = list%used + 1
      list%names(list%used) = name
      list%values(list%used) = value
      list%is_of_matrix(list%used) = .false.
      if (present(is_of_matrix)) list%is_of_matrix(list%used) = is_of_matrix
   end subroutine put

end module ek_geometry_columns
