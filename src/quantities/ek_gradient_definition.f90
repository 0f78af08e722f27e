!> The gradients of each set of tests: column over column, with unit and sign; their windows around design, by the abscissa.
!>
!> A new gradient needs one line in `definitions`. ek_gradient computes its value, and slope_unit of ek_quantity gives its unit.
module ek_gradient_definition
   use ek_kinds, only: wp
   use ek_rig_test, only: rig_test_t, rig_test, steers, of_travel, of_tilt, of_roll, of_steer, of_lateral, of_braking, &
      of_traction, of_aligning, of_vertical
   implicit none(type, external)
   private
   public :: definition_t, definitions_of, fitted, windows_t, set_window, window_of

   !> Suffix of the name of every gradient: a least-squares slope over a window differs from the slope at a state, which a column of
   !> the compliance matrix gives.
   character(*), parameter :: fitted = ' (fitted)'

   !> Definition of a gradient, for the equation at the top of ek_gradient.
   type :: definition_t
      integer :: set                      !! set of tests: of_travel, of_roll, …
      character(52) :: quantity = ''
      character(28) :: column = ''
      character(72) :: sign = ''
      character(1) :: y_turn = ' '        !! 's': times side (toe → steer); 'd': x of the deck, reported forward;
      !!                                     'i': outward, reported to the right; 'o': x is mirrored on the right wheel,
      !!                                     positive towards the side of each wheel
      character(18) :: over = ''          !! column of x; '': abscissa of the test, or `factor` in units of the case (N, N m, mm)
   end type definition_t

   character(*), parameter :: in_bump = ' in bump', left_up = ' with the left wheel up', under = ' under a force to the right', &
      left_torque = ' under a torque to the left', inner = ', inner wheel', force_up = ' under a force up', &
      inward = '+ front edge moves inward', outward = '+ top moves outward', rearward = '+ top of the axis moves rearward', &
      to_left = '+ steers to the left'

   type(definition_t), parameter :: definitions(*) = [ &
      definition_t(of_travel, 'bump toe', 'toe_deg', inward//in_bump), &
      definition_t(of_travel, 'bump steer', 'toe_deg', to_left//in_bump, 's'), &
      definition_t(of_travel, 'bump camber', 'camber_deg', outward//in_bump), &
      definition_t(of_travel, 'bump caster', 'caster_deg', rearward//in_bump), &
      definition_t(of_travel, 'bump caster, instant axis', 'instant_caster_deg', rearward//in_bump), &
      definition_t(of_travel, 'half-track change', 'track_change_mm', '+ contact point moves outward'//in_bump), &
      definition_t(of_travel, 'wheelbase change', 'wheelbase_change_mm', '+ contact point moves rearward'//in_bump), &
      definition_t(of_travel, 'wheel rate', 'vertical_force_n', '+ load increases'//in_bump), &
      definition_t(of_travel, 'roll-centre height change', 'roll_centre_height_mm', '+ rises over the ground'//in_bump), &
      ! Per roll of the wheels relative to the body, positive with the left wheel up for both wheels, as the column axle_roll_deg;
      ! the columns wheel_roll_… of the matrix are the slopes at a state
      definition_t(of_roll, 'wheel roll steer', 'toe_deg', to_left//left_up, 's'), &
      definition_t(of_roll, 'wheel roll toe', 'toe_deg', inward//left_up), &
      definition_t(of_roll, 'wheel roll camber', 'camber_deg', outward//left_up), &
      definition_t(of_roll, 'camber relative to road in roll', 'inclination_deg', outward//' relative to the road'//left_up), &
      definition_t(of_roll, 'wheel roll caster', 'caster_deg', rearward//left_up), &
      definition_t(of_roll, 'wheel load in roll', 'vertical_force_n', '+ increases'//left_up), &
      definition_t(of_roll, 'roll rate', 'roll_moment_nm', '+ restoring'), &
      definition_t(of_lateral, 'lateral force steer', 'toe_deg', to_left//under, 's'), &
      definition_t(of_lateral, 'lateral force camber', 'camber_deg', outward//under), &
      definition_t(of_lateral, 'lateral deflection', 'track_change_mm', '+ contact point moves with the force', 'i'), &
      definition_t(of_aligning, 'aligning torque steer', 'toe_deg', to_left//left_torque, 's'), &
      definition_t(of_aligning, 'aligning torque camber', 'camber_deg', outward//left_torque), &
      definition_t(of_braking, 'braking deflection', 'wheelbase_change_mm', '+ contact point moves rearward'), &
      definition_t(of_braking, 'braking camber', 'camber_deg', outward), &
      definition_t(of_braking, 'braking steer', 'toe_deg', to_left, 's'), &
      definition_t(of_braking, 'braking toe', 'toe_deg', inward), &
      definition_t(of_braking, 'braking caster', 'caster_deg', rearward), &
      definition_t(of_traction, 'traction deflection', 'wheel_centre_x_mm', '+ wheel centre moves forward', 'd'), &
      definition_t(of_traction, 'traction camber', 'camber_deg', outward), &
      definition_t(of_traction, 'traction steer', 'toe_deg', to_left, 's'), &
      definition_t(of_traction, 'traction toe', 'toe_deg', inward), &
      definition_t(of_traction, 'traction caster', 'caster_deg', rearward), &
      definition_t(of_steer, 'steer per steering wheel', 'toe_deg', '+ to the left', 's', 'steering_wheel_deg'), &
      definition_t(of_steer, 'steer per steering input', 'toe_deg', '+ to the left', 's'), &
      definition_t(of_steer, 'steer camber', 'camber_deg', outward//inner, 'o'), &
      definition_t(of_steer, 'steer caster', 'caster_deg', '+ top moves rearward'//inner, 'o'), &
      definition_t(of_steer, 'scrub radius change', 'scrub_radius_mm', '+ increases'//inner, 'o'), &
      definition_t(of_steer, 'caster trail change', 'caster_trail_mm', '+ increases'//inner, 'o'), &
      definition_t(of_steer, 'wheel lift in steer', 'wheel_travel_mm', '+ wheel moves up'//inner, 'o'), &
      definition_t(of_vertical, 'vertical deflection', 'wheel_travel_mm', '+ wheel moves up'//force_up), &
      definition_t(of_vertical, 'vertical force toe', 'toe_deg', inward//force_up), &
      definition_t(of_vertical, 'vertical force camber', 'camber_deg', outward//force_up), &
      definition_t(of_vertical, 'vertical force caster', 'caster_deg', '+ top moves rearward'//force_up)]

   integer, parameter :: travel = 1, roll = 2, force = 3, torque = 4, rack = 5, wheel = 6
   character(*), parameter :: names(6) = [character(6) :: 'travel', 'roll', 'force', 'torque', 'rack', 'wheel']
   character(*), parameter :: units(6) = [character(3) :: 'mm', 'deg', 'N', 'N m', 'mm', 'deg']

   !> Half widths of the windows, in the units of `units`; each window is centred on 0. `rack` is the window of the steering input,
   !> `wheel` of the steering-wheel angle.
   type :: windows_t
      real(wp) :: half(6) = [15.0_wp, 1.0_wp, 1000.0_wp, 100.0_wp, 10.0_wp, 20.0_wp]
      logical :: is_given(6) = .false.       !! a user gives the window; otherwise it ends where the range of a test ends
   end type windows_t

contains

   !> The gradients of a test; empty for a test without gradients.
   pure function definitions_of(kind) result(list)
      character(*), intent(in) :: kind
      type(definition_t), allocatable :: list(:)
      type(rig_test_t) :: test
      integer :: k

      test = rig_test(kind)
      list = pack(definitions, definitions%set == merge(of_travel, test%charts, test%charts == of_tilt))
      do k = 1, size(list)
         list(k)%quantity = test%prefix(:len_trim(test%prefix) + merge(1, 0, test%prefix /= ''))//trim(list(k)%quantity)//fitted
         if (list(k)%over == '') list(k)%over = merge('factor            ', test%abscissa, test%action == steers)
      end do
   end function definitions_of

   !> Sets the half width of the window with a given name.
   pure subroutine set_window(windows, word, half, is_known)
      type(windows_t), intent(inout) :: windows
      character(*), intent(in) :: word
      real(wp), intent(in) :: half         !! mm, deg, N or N m; positive
      logical, intent(out) :: is_known

      is_known = any(names == word)
      where (names == word) windows%half = half
      where (names == word) windows%is_given = .true.
   end subroutine set_window

   !> Finds the window of a gradient. Over `factor`, this is the window of the quantity that the test scales: force, torque or rack.
   pure subroutine window_of(kind, over, windows, half, unit, is_given)
      character(*), intent(in) :: kind, over    !! kind of the test; column, without the wheel's name
      type(windows_t), intent(in) :: windows
      real(wp), intent(out) :: half             !! half width, in `unit`
      character(*), intent(out) :: unit         !! mm, deg, N or N m; 3 letters
      logical, intent(out), optional :: is_given        !! a user gives the window
      type(rig_test_t) :: test
      integer :: which

      test = rig_test(kind)
      which = force
      if (test%unit == 'N m') which = torque
      if (test%action == steers) which = rack
      if (over == 'wheel_travel_mm') which = travel
      if (over == 'axle_roll_deg') which = roll
      if (over == 'steering_wheel_deg') which = wheel
      half = windows%half(which)
      unit = units(which)
      if (present(is_given)) is_given = windows%is_given(which)
   end subroutine window_of

end module ek_gradient_definition
