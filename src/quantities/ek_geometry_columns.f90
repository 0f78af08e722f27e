!> Geometry of wheels, steering axes and steering, and of the elements whose length is not a port of the compliance matrix: the
!> values of the sections wheel_axis to axle_geometry of ek_quantity, in SI. A quantity without a value at a state is NaN.
module ek_geometry_columns
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_is_nan, ieee_quiet_nan
   use ek_kinds, only: wp, pi
   use ek_quantity, only: wheel_axis, instant_distances, wheel_slopes, axle_geometry
   use ek_rotation, only: cross
   use ek_measure, only: evaluation_t, evaluate, measure_value
   use ek_law, only: deflection
   use ek_suspension, only: suspension_t, axle_t
   use ek_state, only: state_t, inputs_t, design_state
   use ek_compliance, only: compliance_t, move_of
   use ek_port_response, only: lock_t, keep_locked
   use ek_characteristics, only: motion_ratio
   use ek_loaded_wheels, only: quotient, min_compliance
   use ek_attitude, only: attitude_t, camber_rate, vertical_force, steer_axis_t, steer_axis_of
   use ek_steer_angle, only: steer_of, steer_rate, turning_circle, ideal_outer_steer, outer_wheel, wall_to_wall
   implicit none(type, external)
   private
   public :: axis_geometry, instant_geometry, slope_values, axle_geometry_values, travel_left, length_ratio, mass_on, &
      locked_twists, instant_axis, axis_distances, ride_frequency

   real(wp), parameter :: standard_gravity = 9.80665_wp      !! m/s²
   real(wp), parameter :: highest_ride = 50.0_wp           !! Hz: a higher frequency is that of an axle that carries no car
   real(wp), parameter :: min_ratio = 1.0e-6_wp            !! length per travel below which a stop does not depend on the wheels

   real(wp), parameter :: parallel = 1.0e-9_wp           !! sine of the angle up to which spin and steering axis are parallel

   ! Below these a carrier does not rotate: stiffer than any steel about z, or a rack that steers 1e-6 rad per metre
   real(wp), parameter :: min_rotation = 1.0e-12_wp        !! least rotation per moment [rad/(N m)]; also least divisor of slopes
   real(wp), parameter :: min_by_rack = 1.0e-6_wp      !! least rotation per rack travel [rad/m]

contains

   !> Computes the values of the section wheel_axis: side-view rotation, distances from the deck's steering axis, and spin axis.
   pure subroutine axis_geometry(now, frame, values)
      type(attitude_t), intent(in) :: now
      real(wp), intent(in) :: frame(3)              !! signs of x, y, z from the program's frame to the deck's frame
      real(wp), intent(inout) :: values(size(wheel_axis))

      values(1) = now%side_view
      if (now%axes%has_steer_axis) values(2:5) = axis_distances(now%axes%side, now%axis_point, now%axes%steer_axis, &
         now%at_centre, now%at_contact, now%axes%spin)
      values(6:8) = frame*now%axes%spin
   end subroutine axis_geometry

   !> Computes the values of the section instant_distances, from the twist of the carrier during steering with locked springs. NaN
   !> if the carrier does not rotate.
   pure subroutine instant_geometry(twist, now, values)
      real(wp), intent(in) :: twist(6)
      type(attitude_t), intent(in) :: now
      real(wp), intent(inout) :: values(size(instant_distances))
      real(wp) :: point(3), turn(3)

      turn = twist(4:6)
      values = ieee_value(1.0_wp, ieee_quiet_nan)
      if (length_of(turn) <= min_rotation) return
      point = now%at_centre + cross(turn, twist(1:3))/dot_product(turn, turn)
      values = axis_distances(now%axes%side, point, turn, now%at_centre, now%at_contact, now%axes%spin)
   end subroutine instant_geometry

   !> Computes the values of the section wheel_slopes: recession, camber per steer, ride frequency.
   pure subroutine slope_values(lift, twist, tyre_rate, mass, now, values)
      real(wp), intent(in) :: lift(6)       !! twist at the wheel centre per vertical force on every wheel [m/N, rad/N]
      real(wp), intent(in) :: twist(6)      !! twist during steering with the wheel heights held; 0 without a rack
      real(wp), intent(in) :: tyre_rate     !! N/m, 0: not given
      real(wp), intent(in) :: mass          !! sprung mass of the wheel [kg], 0: not known
      type(attitude_t), intent(in) :: now
      real(wp), intent(inout) :: values(size(wheel_slopes))

      values(1) = 1.0e3_wp*quotient(lift(1), lift(3), min_compliance)
      values(2) = quotient(camber_rate(now%axes, twist(4:6)), steer_rate(now%axes%spin, twist(4:6)), min_rotation)
      values(3) = ieee_value(1.0_wp, ieee_quiet_nan)
      if (mass > 0.0_wp) values(3) = ride_frequency(1.0_wp/(lift(3) + 1.0_wp/tyre_rate), mass)
   end subroutine slope_values

   !> Computes the values of the section axle_geometry: track and its change; with &axle and &steering also the quantities of a
   !> turn.
   pure subroutine axle_geometry_values(axle, tyre_width, has_turn, static, left, right, values)
      type(axle_t), intent(in) :: axle
      real(wp), intent(in) :: tyre_width(2)        !! m
      logical, intent(in) :: has_turn              !! the deck has &axle and &steering
      real(wp), intent(in) :: static(2)            !! steer of both wheels at design [rad]
      type(attitude_t), intent(in) :: left, right
      real(wp), intent(inout) :: values(size(axle_geometry))
      real(wp) :: track, steer(2), inner, outer
      integer :: side

      steer(1) = steer_of(left%toe, left%axes%side)
      steer(2) = steer_of(right%toe, right%axes%side)
      track = right%at_contact(2) - left%at_contact(2)
      values(1) = track
      values(2) = left%track_change + right%track_change
      values(3:) = 0.0_wp
      if (.not. has_turn) return
      call outer_wheel(steer(1) - static(1), steer(2) - static(2), inner, outer, side)
      values(3) = ideal_outer_steer(inner, axle%wheelbase, track)
      values(4) = outer - values(3)
      call outer_wheel(steer(1), steer(2), inner, outer, side)
      values(5) = turning_circle(steer(1), steer(2), axle%wheelbase) + tyre_width(side)
      values(6) = wall_to_wall(outer, axle%wheelbase, track, axle%front_overhang, axle%front_width)
   end subroutine axle_geometry_values

   !> Remaining wheel travel to the contact of a stop [m], with equal travel of all wheels: the clearance of the stop divided by the
   !> magnitude of the change of clearance per travel. Negative in contact.
   pure real(wp) function travel_left(suspension, compliance, state, k) result(travel)
      type(suspension_t), intent(in) :: suspension
      type(compliance_t), intent(in) :: compliance
      type(state_t), intent(in) :: state
      integer, intent(in) :: k                     !! index of the element
      real(wp) :: ratio

      ratio = length_ratio(suspension, compliance, state, k)
      associate (m => suspension%elements(k)%measure)
         travel = gap_over(-deflection(suspension%elements(k)%law, measure_value(m, state%poses(m%body_i + 1), &
            state%poses(m%body_j + 1))), ratio)
      end associate
   end function travel_left

   !> The quotient clearance/|ratio| [m]; NaN for a stop that does not depend on the wheels, or for wheels that do not move.
   pure real(wp) function gap_over(gap, ratio)
      real(wp), intent(in) :: gap, ratio      !! m, -
      gap_over = ieee_value(1.0_wp, ieee_quiet_nan)
      if (ieee_is_nan(ratio)) return
      gap_over = quotient(gap, abs(ratio), min_ratio)
   end function gap_over

   !> Change of the length of an element per wheel travel [-], with equal travel of all wheels: the motion ratio of an element that
   !> is not a port of the compliance matrix. NaN if the matrix is unknown.
   pure real(wp) function length_ratio(suspension, compliance, state, k) result(ratio)
      type(suspension_t), intent(in) :: suspension
      type(compliance_t), intent(in) :: compliance
      type(state_t), intent(in) :: state
      integer, intent(in) :: k                     !! index of the element
      type(evaluation_t) :: evaluation
      real(wp) :: length(2)                        ! per unit of the vertical load on each wheel [m/N]
      integer :: n, w

      ratio = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. compliance%is_known) return
      length = 0.0_wp
      associate (m => suspension%elements(k)%measure)
         call evaluate(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), evaluation)
         do w = 1, min(compliance%wheels, 2)
            length(w) = move_of(compliance, 6*w - 3, evaluation%gradient, m%body_i, m%body_j)
         end do
      end associate
      n = 6*compliance%wheels
      ratio = motion_ratio(compliance%response(:n, :n), length)
   end function length_ratio

   !> The sprung mass of a wheel [kg]: from the deck, otherwise from the wheel load at design; 0 if neither is given.
   real(wp) function mass_on(suspension, wheel) result(mass)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: wheel

      mass = suspension%wheels(wheel)%sprung_mass
      if (.not. mass > 0.0_wp) mass = vertical_force(suspension, design_state(suspension), inputs_t(), wheel)/standard_gravity
   end function mass_on

   !> Computes the twist (v, ω) of each wheel carrier at the wheel centre during steering, with all springs locked or with the
   !> heights of all wheel centres held (`lock`).
   !>
   !> With a steering driver (a rack), the rack is moved by a unit. A steer moment would move a free rack without limit, so the
   !> elastic response of the other parts to the moment is negligible. Without a rack, a unit steer moment about z on the wheel
   !> gives the elastic axis (fixed tie rods, rear axles).
   !>
   !> Springs are locked by pairs of forces μ along them. A small system of known responses gives these forces:
   !> lengths(0) + A μ = 0, with the changes of length lengths(0) without μ, and A per unit of μ. Without springs, the heights of
   !> the wheel centres are held instead. These heights are also held for the steering ratio, which is measured on a rig with the
   !> wheels at fixed heights.
   !> Equation (S.8) of docs/theory/suspension.md.
   pure subroutine locked_twists(compliance, lock, moves, twists)
      type(compliance_t), intent(in) :: compliance   !! known
      type(lock_t), intent(in) :: lock               !! holds the springs, or the heights
      real(wp), contiguous, intent(inout) :: moves(:)      !! work space: displacements of all ports
      real(wp), intent(inout) :: twists(:, :)        !! twist of each wheel, in the order of the compliance matrix
      integer :: k, steer

      do k = 1, compliance%wheels
         steer = 6*k
         if (compliance%has_drive) steer = size(compliance%response, 2)
         if (k == 1 .or. .not. compliance%has_drive) then
            moves = compliance%response(:, steer)
            call keep_locked(lock, moves)
         end if
         twists(:, k) = moves(6*k - 5:6*k)
      end do
   end subroutine locked_twists

   !> The instant steering axis of a wheel: the line about which the wheel carrier rotates during steering with the springs at
   !> constant length. For the twist (v, ω) at the wheel centre p, the line has the direction ω/|ω| and passes through p + ω×v/|ω|²
   !> (the pitch of the screw is ignored). is_known is false if the carrier does not rotate, or if the axis is horizontal.
   !> Equation (S.9) of docs/theory/suspension.md.
   pure type(steer_axis_t) function instant_axis(twist, has_drive, now) result(axis)
      real(wp), intent(in) :: twist(6)                 !! twist from locked_twists
      logical, intent(in) :: has_drive                 !! the twist is per metre of rack, not per moment
      type(attitude_t), intent(in) :: now
      real(wp) :: point(3), turn(3), least

      turn = twist(4:6)
      least = merge(min_by_rack, min_rotation, has_drive)
      if (length_of(turn) <= least) return
      point = now%at_centre + cross(turn, twist(1:3))/dot_product(turn, turn)
      axis = steer_axis_of(now%axes%side, point, turn, now%at_centre, now%at_contact)
   end function instant_axis

   !> Distances of a wheel from a steering axis, the line through `point` along `direction` [m]. `centre` and `patch` are the
   !> distances of wheel centre and contact point from the line, never negative. `along` is the distance along the spin axis from
   !> the common perpendicular to the wheel centre, positive outboard. `across` is the length of the common perpendicular,
   !> positive: spin axis aft of the line.
   !>
   !> With d = centre − point, k the unit direction upward, w the spin axis outboard, n = side w×k/|w×k|:
   !>
   !>     centre = |d×k|     patch = |(patch − point)×k|     across = d·n     along = side (d×k)·n/|w×k|
   !>
   !> which solves d = along w + μ k + across n. `along` and `across` are NaN if w and k are parallel.
   !> Equation (S.10) of docs/theory/suspension.md.
   pure function axis_distances(side, point, direction, centre, patch, spin) result(is)
      integer, intent(in) :: side
      real(wp), intent(in) :: point(3), direction(3)       !! of the line [m, any length, not 0]
      real(wp), intent(in) :: centre(3), patch(3)          !! m
      real(wp), intent(in) :: spin(3)                      !! unit, outboard
      real(wp) :: is(4)                                    !! centre, patch, along, across [m]
      real(wp) :: k(3), n(3), d(3), moment(3), turn

      k = direction/length_of(direction)
      if (k(3) < 0.0_wp) k = -k
      d = centre - point
      is = ieee_value(1.0_wp, ieee_quiet_nan)
      moment = cross(d, k)
      is(1) = length_of(moment)
      is(2) = length_of(cross(patch - point, k))
      n = cross(spin, k)
      turn = length_of(n)
      if (turn <= parallel) return
      n = side*n/turn
      is(4) = dot_product(d, n)
      is(3) = side*dot_product(moment, n)/turn
   end function axis_distances

   !> The length |v| of a vector whose squares neither overflow nor underflow. norm2 guards against overflow at several times the
   !> cost.
   pure real(wp) function length_of(v)
      real(wp), intent(in) :: v(3)
      length_of = sqrt(v(1)**2 + v(2)**2 + v(3)**2)
   end function length_of

   !> The ride frequency √(rate/mass)/2π [Hz]; NaN if the rate is not positive, or if the axle carries no car: above 50 Hz, the
   !> mass would compress the spring by less than 0.1 mm.
   pure real(wp) function ride_frequency(rate, mass) result(frequency)
      real(wp), intent(in) :: rate      !! ride rate [N/m]
      real(wp), intent(in) :: mass      !! kg, above 0
      frequency = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. rate > 0.0_wp) return
      frequency = sqrt(rate/mass)/(2.0_wp*pi)
      if (frequency > highest_ride) frequency = ieee_value(1.0_wp, ieee_quiet_nan)
   end function ride_frequency

end module ek_geometry_columns
