!> Geometry of wheels, steer axes and steering, and of the elements whose length is no port of the compliance matrix: the values
!> of the sections wheel_geometry and axle_geometry of ek_quantity, in SI. A quantity without a value at a state is not a number.
module ek_geometry_columns
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_is_nan, ieee_quiet_nan
   use ek_kinds, only: wp, millimetre, pi
   use ek_quantity, only: wheel_geometry, axle_geometry
   use ek_rotation, only: cross
   use ek_measure, only: evaluation_t, evaluate, measure_value
   use ek_law, only: deflection
   use ek_element, only: element_kinds, measure_spring, is_of_angle
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t, design_state
   use ek_wheel_side, only: is_axle
   use ek_compliance, only: compliance_t, lock
   use ek_characteristics, only: motion_ratio, quotient
   use ek_attitude, only: attitude_t, static_toe, camber_rate, vertical_force, steer_axis_t, steer_axis_of
   use ek_steer_angle, only: steer_of, steer_rate, turning_circle, ideal_outer_steer, outer_wheel, wall_to_wall
   implicit none(type, external)
   private
   public :: wheel_geometry_values, axle_geometry_values, element_values, mass_on, locked_twist, instant_axis, axis_distances, &
      ride_frequency

   real(wp), parameter :: standard_gravity = 9.80665_wp      !! m/s²
   real(wp), parameter :: min_compliance = 1.0e-12_wp      !! m/N, as in ek_characteristics
   real(wp), parameter :: min_ratio = 1.0e-6_wp            !! stop is independent of the wheels

   real(wp), parameter :: parallel = 1.0e-9_wp           !! sine of the angle of spin and steer axis: parallel below

   ! Below these a carrier does not rotate: stiffer than any steel about z, or a rack that steers 1e-6 rad per metre
   real(wp), parameter :: min_rotation = 1.0e-12_wp        !! rad/(N m); also of a quotient, by moment or by rack
   real(wp), parameter :: min_by_rack = 1.0e-6_wp      !! rad/m

contains

   !> The values of wheel_geometry: side view, steer axes, slopes, frequency.
   function wheel_geometry_values(suspension, compliance, now, place) result(values)
      type(suspension_t), intent(in) :: suspension
      type(compliance_t), intent(in) :: compliance
      type(attitude_t), intent(in) :: now
      integer, intent(in) :: place                 !! index of the wheel in the compliance matrix
      real(wp) :: values(size(wheel_geometry))
      real(wp) :: twist(6), column(6), mass
      integer :: at

      values = ieee_value(1.0_wp, ieee_quiet_nan)
      values(1) = now%side_view
      associate (wheel => suspension%wheels(compliance%order(place)), turn => twist(4:6))
         if (wheel%has_steer_axis) values(2:5) = axis_distances(wheel%side, now%axis_point, now%axes%steer_axis, now%at_centre, &
            now%at_contact, now%axes%spin)
         if (.not. compliance%is_known) return      ! a comparison with NaN would trap
         twist = locked_twist(compliance, place, .false.)
         if (norm2(turn) > min_rotation) values(6:9) = axis_distances(wheel%side, &
            now%at_centre + cross(turn, twist(1:3))/dot_product(turn, turn), turn, now%at_centre, now%at_contact, now%axes%spin)
         at = 6*(place - 1)      ! response of the wheel centre per vertical force on every wheel [m/N, rad/N]
         column = compliance%response(at + 1:at + 6, at + 3)
         if (compliance%wheels == 2) column = column + compliance%response(at + 1:at + 6, 9 - at)
         values(10) = 1.0e3_wp*quotient(column(1), column(3), min_compliance)
         twist = locked_twist(compliance, place, .true.)
         values(11) = quotient(camber_rate(now%axes, turn), steer_rate(now%axes%spin, turn), min_rotation)
         mass = 0.0_wp
         if (wheel%tyre_rate > 0.0_wp) mass = mass_on(suspension, compliance%order(place))
         if (mass > 0.0_wp) values(12) = ride_frequency(1.0_wp/(column(3) + 1.0_wp/wheel%tyre_rate), mass)
      end associate
   end function wheel_geometry_values

   !> The values of axle_geometry: track, and with &axle and &steering the quantities of a turn; 0 unless there are two wheels.
   function axle_geometry_values(suspension, compliance, now) result(values)
      type(suspension_t), intent(in) :: suspension
      type(compliance_t), intent(in) :: compliance
      type(attitude_t), intent(in) :: now(:)       !! left, right
      real(wp) :: values(size(axle_geometry))
      real(wp) :: y(2), track, steer(2), static(2), inner, outer, ideal, turn(4)
      integer :: k, side

      values = 0.0_wp
      if (.not. is_axle(suspension)) return
      do k = 1, 2
         associate (wheel => suspension%wheels(compliance%order(k)))
            y(k) = now(k)%at_contact(2)
            steer(k) = steer_of(now(k)%toe, wheel%side)
            static(k) = steer_of(static_toe(wheel), wheel%side)
         end associate
      end do
      track = y(2) - y(1)
      turn = 0.0_wp
      associate (axle => suspension%axle)
         if (axle%has_axle .and. suspension%steering%has_steering) then
            call outer_wheel(steer(1) - static(1), steer(2) - static(2), inner, outer, side)
            ideal = ideal_outer_steer(inner, axle%wheelbase, track)
            turn(:2) = [ideal, outer - ideal]
            call outer_wheel(steer(1), steer(2), inner, outer, side)
            turn(3:) = [turning_circle(steer(1), steer(2), axle%wheelbase) + &
               suspension%wheels(compliance%order(side))%tyre_width, &
               wall_to_wall(outer, axle%wheelbase, track, axle%front_overhang, axle%front_width)]
         end if
      end associate
      values = [track, now(1)%track_change + now(2)%track_change, turn]
   end function axle_geometry_values

   !> Of every stop the remaining wheel travel to its contact [mm], with equal travel of all wheels: its gap over the change of
   !> the gap per travel; of every spring on a length measure its motion ratio.
   function element_values(suspension, compliance, state) result(values)
      type(suspension_t), intent(in) :: suspension
      type(compliance_t), intent(in) :: compliance
      type(state_t), intent(in) :: state
      real(wp), allocatable :: values(:)
      real(wp) :: ratio, gap
      integer :: k

      allocate (values(0))
      if (compliance%wheels == 0) return
      do k = 1, size(suspension%elements)
         associate (element => suspension%elements(k), m => suspension%elements(k)%measure)
            if (element_kinds(element%kind)%has_gap) then
               ratio = length_ratio(suspension, compliance, state, k)
               gap = -deflection(element%law, measure_value(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1)))
               values = [values, gap_over(gap, ratio)/millimetre]
            else if (element%kind == measure_spring) then
               if (.not. is_of_angle(m%kind)) values = [values, length_ratio(suspension, compliance, state, k)]
            end if
         end associate
      end do
   end function element_values

   !> gap/|ratio|; not a number for a stop that is independent of the wheels, or wheels that do not move.
   pure real(wp) function gap_over(gap, ratio)
      real(wp), intent(in) :: gap, ratio      !! m, -
      gap_over = ieee_value(1.0_wp, ieee_quiet_nan)
      if (ieee_is_nan(ratio)) return
      gap_over = quotient(gap, abs(ratio), min_ratio)
   end function gap_over

   !> Change of the length of an element per wheel travel, with equal travel of all wheels: the motion ratio of an element that
   !> is not a port of the compliance matrix. Not a number if the matrix is unknown.
   real(wp) function length_ratio(suspension, compliance, state, k) result(ratio)
      type(suspension_t), intent(in) :: suspension
      type(compliance_t), intent(in) :: compliance
      type(state_t), intent(in) :: state
      integer, intent(in) :: k                     !! number of the element
      type(evaluation_t) :: evaluation
      real(wp) :: length(6*compliance%wheels)      ! per unit of each load of C [m/N, m/(N m)]
      integer :: n, j, at

      ratio = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. compliance%is_known) return
      n = size(length)
      associate (m => suspension%elements(k)%measure)
         call evaluate(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), evaluation)
         length = 0.0_wp
         do j = 1, n
            at = 6*(m%body_i - 1)
            if (at >= 0) length(j) = dot_product(evaluation%gradient(1:6), compliance%columns(at + 1:at + 6, j))
            at = 6*(m%body_j - 1)
            if (at >= 0) length(j) = length(j) + dot_product(evaluation%gradient(7:12), compliance%columns(at + 1:at + 6, j))
         end do
      end associate
      ratio = motion_ratio(compliance%response(:n, :n), length)
   end function length_ratio

   !> The sprung mass of a wheel [kg]: from the deck, otherwise from the wheel load at design; 0 if there is neither.
   real(wp) function mass_on(suspension, wheel) result(mass)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: wheel

      mass = suspension%wheels(wheel)%sprung_mass
      if (.not. mass > 0.0_wp) mass = vertical_force(suspension, design_state(suspension), inputs_t(), wheel)/standard_gravity
   end function mass_on

   !> Twist (v, ω) of a wheel's carrier at the wheel centre while it steers, all springs locked or all wheels held.
   !>
   !> With a steering driver (a rack) in the model, the rack is moved by a unit: a free rack under a steer moment has no
   !> stiffness, so its displacement dominates, and the elastic response of the other parts to the moment is negligible;
   !> this limit is the response to a displacement of the rack. Without a rack, a unit steer moment
   !> about z on the wheel gives the elastic axis (fixed tie rods, rear axles).
   !>
   !> Springs are locked by pairs of forces along them, found from a small system of known responses:
   !> lengths(0) + A μ = 0. Without springs the heights of the wheel centres are held instead, as for the steering
   !> ratio, which is measured on a rig with wheels at fixed heights.
   !> Equation (S.8) of docs/theory/suspension.md.
   pure function locked_twist(compliance, place, holds_heights) result(twist)
      type(compliance_t), intent(in) :: compliance   !! known
      integer, intent(in) :: place                   !! index of the wheel in it
      logical, intent(in) :: holds_heights           !! hold the heights of the wheel centres instead of the lengths of the springs
      real(wp) :: twist(6), moves(size(compliance%response, 1), 1)
      integer :: k, steer

      steer = 6*place
      if (compliance%has_drive) steer = size(compliance%response, 2)
      moves(:, 1) = compliance%response(:, steer)
      if (compliance%springs == 0 .or. holds_heights) then
         call lock(compliance%response, [(6*k - 3, k=1, compliance%wheels)], moves)
      else
         call lock(compliance%response, [(6*compliance%wheels + k, k=1, compliance%springs)], moves)
      end if
      twist = moves(6*place - 5:6*place, 1)
   end function locked_twist

   !> The instant steer axis of a wheel: the line about which its carrier rotates when it steers with its springs at constant
   !> length, ω/|ω| through p + ω×v/|ω|² for the twist (v, ω) at the wheel centre p (the pitch of the screw is ignored).
   !> is_known is false if the carrier does not rotate, or for a horizontal axis.
   !> Equation (S.9) of docs/theory/suspension.md.
   pure type(steer_axis_t) function instant_axis(compliance, place, side, centre, contact) result(axis)
      type(compliance_t), intent(in) :: compliance     !! known
      integer, intent(in) :: place, side
      real(wp), intent(in) :: centre(3), contact(3)    !! m, at the state
      real(wp) :: twist(6), turn(3), least

      twist = locked_twist(compliance, place, .false.)
      turn = twist(4:6)
      least = merge(min_by_rack, min_rotation, compliance%has_drive)
      if (norm2(turn) <= least) return
      axis = steer_axis_of(side, centre + cross(turn, twist(1:3))/dot_product(turn, turn), turn, centre, contact)
   end function instant_axis

   !> Distances of a wheel from a steer axis, the line through `point` along `direction`: of the centre and of the patch, never
   !> negative; along the spin axis, from the foot of the common perpendicular, + outboard; length of the common perpendicular,
   !> + spin axis behind the line.
   !>
   !> With d = centre − point, k the unit direction upward, w the spin axis outboard, n = side w×k/|w×k|:
   !>
   !>     centre = |d×k|     patch = |(patch − point)×k|     across = d·n     along = side (d×k)·n/|w×k|
   !>
   !> which solves d = along w + μ k + across n. `along` and `across` are not numbers if w and k are parallel.
   !> Equation (S.10) of docs/theory/suspension.md.
   pure function axis_distances(side, point, direction, centre, patch, spin) result(is)
      integer, intent(in) :: side
      real(wp), intent(in) :: point(3), direction(3)       !! of the line [m, any length, not 0]
      real(wp), intent(in) :: centre(3), patch(3)          !! m
      real(wp), intent(in) :: spin(3)                      !! unit, outboard
      real(wp) :: is(4)                                    !! centre, patch, along, across [m]
      real(wp) :: k(3), n(3), d(3), turn

      k = direction/norm2(direction)
      if (k(3) < 0.0_wp) k = -k
      d = centre - point
      is = ieee_value(1.0_wp, ieee_quiet_nan)
      is(1) = norm2(cross(d, k))
      is(2) = norm2(cross(patch - point, k))
      n = cross(spin, k)
      turn = norm2(n)
      if (turn <= parallel) return
      n = side*n/turn
      is(4) = dot_product(d, n)
      is(3) = side*dot_product(cross(d, k), n)/turn
   end function axis_distances

   !> √(k/m)/2π [Hz]
   pure real(wp) function ride_frequency(rate, mass) result(frequency)
      real(wp), intent(in) :: rate      !! ride rate [N/m]
      real(wp), intent(in) :: mass      !! kg, above 0
      frequency = ieee_value(1.0_wp, ieee_quiet_nan)
      if (rate > 0.0_wp) frequency = sqrt(rate/mass)/(2.0_wp*pi)
   end function ride_frequency

end module ek_geometry_columns
