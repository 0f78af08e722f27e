!> Curves and slopes of a map for simulators: columns over the travel of the wheel centre without steer, and slopes at design of
!> the angles of a wheel under loads at its contact point or its centre.
!>
!> ISO 8855, SI: see ek_wheel_motion. The wheels are held in the slopes as in the compliance of the map.
module ek_slopes
   use ek_kinds, only: wp
   use ek_port_response, only: load_at_patch
   use ek_attitude, only: axes_t, toe_rate, camber_rate
   use ek_kandc_map, only: kandc_map_t
   use ek_map_request, only: over_opposite
   use ek_wheel_motion, only: iso_frame, at_tz, at_load
   implicit none(type, external)
   private
   public :: travel_curve, steer_curve, slope_at_zero, load_response_t, load_response, wheel_rate, roll_rates, zero_of

   !> Slopes of one wheel under a unit of one load on this wheel [per N, per N m].
   type :: load_response_t
      real(wp) :: shift(3) = 0.0_wp      !! displacement of the wheel centre, ISO [m]
      real(wp) :: toe = 0.0_wp, camber = 0.0_wp   !! rad; toe positive: front edge inward, camber positive: top outward
      real(wp) :: spin = 0.0_wp          !! rotation about y, positive: top forward [rad]
   end type load_response_t

contains

   !> Index of the value 0 in a list that contains 0.
   pure integer function zero_of(values) result(place)
      real(wp), intent(in) :: values(:)
      place = minloc(abs(values), dim=1)
   end function zero_of

   !> A quantity over wheel travel, without steer. In a map over the travel of the other wheel, both wheels have equal travel.
   pure function travel_curve(map, quantity, side) result(curve)
      type(kandc_map_t), intent(in) :: map
      integer, intent(in) :: quantity, side
      real(wp) :: curve(size(map%travel))
      integer :: i, j

      j = zero_of(map%second)
      do i = 1, size(map%travel)
         if (map%kind == over_opposite) j = i
         curve(i) = map%value(quantity, j, i, side)
      end do
   end function travel_curve

   !> A quantity over the second argument at design height.
   pure function steer_curve(map, quantity, side) result(curve)
      type(kandc_map_t), intent(in) :: map
      integer, intent(in) :: quantity, side
      real(wp) :: curve(size(map%second))
      curve = map%value(quantity, :, zero_of(map%travel), side)
   end function steer_curve

   !> Slope dy/dx at the point where x is nearest to 0, from the parabola through this point and its neighbours; at an end of the
   !> list, through the three points at this end. With two points, the slope of the line through both.
   pure real(wp) function slope_at_zero(x, y) result(slope)
      real(wp), intent(in) :: x(:), y(:)        !! at least 2 points
      integer :: k
      real(wp) :: before, after, h(2)

      k = min(max(zero_of(x), 2), max(size(x) - 1, 2))       ! the middle of the three points
      before = (y(k) - y(k - 1))/(x(k) - x(k - 1))
      slope = before
      if (size(x) < 3) return
      after = (y(k + 1) - y(k))/(x(k + 1) - x(k))
      h = [x(k) - x(k - 1), x(k + 1) - x(k)]
      slope = (before*h(2) + after*h(1))/(h(1) + h(2)) + 2.0_wp*(after - before)/(h(1) + h(2))*(x(zero_of(x)) - x(k))
   end function slope_at_zero

   !> The response of a wheel to a unit of one load on this wheel: component 1–6 is Fx, Fy, Fz, Mx, My, Mz in ISO.
   pure type(load_response_t) function load_response(map, side, component, is_at_patch) result(response)
      type(kandc_map_t), intent(in) :: map
      integer, intent(in) :: side, component
      logical, intent(in) :: is_at_patch        !! the force acts at the contact point, otherwise at the wheel centre
      real(wp) :: own(6, 6), arm(3, 1), turn(3)
      type(axes_t) :: axes

      own = map%compliance(:, :6, side)
      arm(:, 1) = map%arm(:, side)
      if (is_at_patch) own = load_at_patch(own, arm)
      response%shift = own(:3, component)
      turn = iso_frame*own(4:, component)
      axes%side = merge(-1, 1, side == 1)
      axes%spin = iso_frame*map%spin(:, side)
      response%toe = toe_rate(axes, turn)
      response%camber = camber_rate(axes, turn)
      response%spin = own(5, component)
   end function load_response

   !> Vertical force per travel of the wheel centre at design, in parallel travel [N/m].
   pure real(wp) function wheel_rate(map, side)
      type(kandc_map_t), intent(in) :: map
      integer, intent(in) :: side
      real(wp) :: x(size(map%travel)), y(size(map%travel))

      x = travel_curve(map, at_tz, side)
      y = travel_curve(map, at_load, side)
      wheel_rate = slope_at_zero(x, y)
   end function wheel_rate

   !> Roll stiffness of the axle at design [N m/rad]: (1) with the bar, from equal and opposite vertical forces on the contact
   !> points; (2) without the bar, from the wheel rates in parallel travel, in which a bar is not loaded.
   pure function roll_rates(map) result(rates)
      type(kandc_map_t), intent(in) :: map
      real(wp) :: rates(2)
      real(wp) :: loaded(12, 12), opposite, parallel(2)
      integer :: k

      loaded = map%free
      ! displacements and forces at the patches: z of the patch moves by θ×a
      do k = 1, 12
         loaded(3, k) = map%free(3, k) + map%free(4, k)*map%arm(2, 1) - map%free(5, k)*map%arm(1, 1)
         loaded(9, k) = map%free(9, k) + map%free(10, k)*map%arm(2, 2) - map%free(11, k)*map%arm(1, 2)
      end do
      loaded(:, 3) = loaded(:, 3) + loaded(:, 4)*map%arm(2, 1) - loaded(:, 5)*map%arm(1, 1)
      loaded(:, 9) = loaded(:, 9) + loaded(:, 10)*map%arm(2, 2) - loaded(:, 11)*map%arm(1, 2)
      opposite = loaded(3, 3) - loaded(3, 9) - loaded(9, 3) + loaded(9, 9)
      parallel = [loaded(3, 3) + loaded(3, 9), loaded(9, 9) + loaded(9, 3)]
      rates = [map%track**2/opposite, 0.25_wp*map%track**2*sum(1.0_wp/parallel)]
   end function roll_rates

end module ek_slopes
