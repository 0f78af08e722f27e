!> Gradients of a test: least-squares slopes over a window around design.
!>
!>     slope = Σ (x − x̄)(y − ȳ) / Σ (x − x̄)²       over the rows with converged = 1 and |x| ≤ window
!>
!> x is the travel, roll, force or torque of the test, y a column. What is reported is
!>
!>     value = size · s_y/s_x · slope
!>
!> with `size` bringing the unit (per m, per kN, per 100 N m) and signs that depend on the side of the wheel:
!> steer is positive to the left on both wheels (s_y = side of toe), and what mirrors from left to right stands over
!> what mirrors too (s_x), the roll that lifts the wheel itself, the force that points inward. So both wheels of a
!> symmetric axle show the same number.
module ek_gradient
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_table, only: row_count, column_index, name_length
   use ek_test_result, only: test_result_t, converged_rows, wheel_column
   implicit none(type, external)
   private
   public :: gradient_t, definition_t, windows_t, test_gradients, slope_over_window, definitions_of, set_window

   integer, parameter :: least_points = 3     !! a line through fewer is no fit

   !> Half widths of the windows, each about 0.
   type :: windows_t
      real(wp) :: travel = 15.0_wp      !! mm
      real(wp) :: roll = 1.0_wp         !! deg
      real(wp) :: force = 1000.0_wp     !! N
      real(wp) :: torque = 100.0_wp     !! N m
      real(wp) :: rack = 10.0_wp        !! mm of steering input
      real(wp) :: wheel = 20.0_wp       !! deg of steering wheel
   end type windows_t

   !> One number of the gradient report.
   type :: gradient_t
      character(:), allocatable :: test        !! name of the case
      character(:), allocatable :: quantity    !! 'bump toe'
      character(:), allocatable :: side        !! 'left', 'right', or '' for the axle and for a single wheel
      character(:), allocatable :: unit, sign  !! 'deg/m'; when it is positive, in words
      character(:), allocatable :: column, over   !! the columns of the table
      character(:), allocatable :: window      !! '±15 mm'
      real(wp) :: window_half = 0.0_wp
      real(wp) :: value = 0.0_wp
      integer :: points = 0                    !! states in the window
      character(:), allocatable :: note        !! why there is no value; else ''
   end type gradient_t

   !> How a gradient is made.
   type :: definition_t
      character(36) :: quantity = ''
      character(28) :: column = ''
      character(20) :: over = ''          !! column; 'factor' in units of the case (N, N m, mm)
      real(wp) :: size = 1.0_wp           !! times the slope
      character(12) :: unit = ''
      character(72) :: sign = ''
      character(1) :: y_turn = ' '        !! 's': times side (toe → steer); 'd': x of the deck, wanted forward;
      !!                                     'i': outward, wanted to the right
      logical :: is_own = .false.         !! x counts as seen from the wheel: mirrored on the right one
   end type definition_t

   character(*), parameter :: in_bump = ' in bump', left_in_bump = '+ turns to the left in bump'

   type(definition_t), parameter :: travel_list(*) = [ &
      definition_t('bump toe', 'toe_deg', 'wheel_travel_mm', 1000.0_wp, 'deg/m', '+ front edge moves inward'//in_bump), &
      definition_t('bump steer', 'toe_deg', 'wheel_travel_mm', 1000.0_wp, 'deg/m', left_in_bump, 's'), &
      definition_t('bump camber', 'camber_deg', 'wheel_travel_mm', 1000.0_wp, 'deg/m', '+ top moves outward'//in_bump), &
      definition_t('bump caster', 'caster_deg', 'wheel_travel_mm', 1000.0_wp, 'deg/m', &
      '+ top of the axis moves rearward'//in_bump), &
      definition_t('bump caster, instant axis', 'instant_caster_deg', 'wheel_travel_mm', 1000.0_wp, 'deg/m', &
      '+ top of the axis moves rearward'//in_bump), &
      definition_t('half-track change', 'track_change_mm', 'wheel_travel_mm', 1.0_wp, 'mm/mm', '+ patch moves outward'//in_bump), &
      definition_t('wheelbase change', 'wheelbase_change_mm', 'wheel_travel_mm', 1.0_wp, 'mm/mm', &
      '+ patch moves rearward'//in_bump), &
      definition_t('wheel rate', 'vertical_force_n', 'wheel_travel_mm', 1.0_wp, 'N/mm', '+ load grows'//in_bump), &
      definition_t('roll-centre height change', 'roll_centre_height_mm', 'wheel_travel_mm', 1.0_wp, 'mm/mm', &
      '+ rises over the ground'//in_bump)]

   type(definition_t), parameter :: roll_list(*) = [ &
      definition_t('roll steer', 'toe_deg', 'axle_roll_deg', 1.0_wp, 'deg/deg', &
      '+ turns to the left when the left wheel goes up', 's'), &
      definition_t('roll toe', 'toe_deg', 'axle_roll_deg', 1.0_wp, 'deg/deg', &
      '+ front edge moves inward on the wheel that goes up', &
      is_own=.true.), &
      definition_t('roll camber', 'camber_deg', 'axle_roll_deg', 1.0_wp, 'deg/deg', &
      '+ top moves outward on the wheel that goes up', &
      is_own=.true.), &
      definition_t('roll inclination', 'inclination_deg', 'axle_roll_deg', 1.0_wp, 'deg/deg', &
      '+ top moves outward, against the road, on the wheel that goes up', is_own=.true.), &
      definition_t('roll caster', 'caster_deg', 'axle_roll_deg', 1.0_wp, 'deg/deg', &
      '+ top of the axis moves rearward on the wheel that goes up', is_own=.true.), &
      definition_t('wheel load in roll', 'vertical_force_n', 'axle_roll_deg', 1.0_wp, 'N/deg', &
      '+ grows on the wheel that goes up', &
      is_own=.true.), &
      definition_t('roll rate', 'roll_moment_nm', 'axle_roll_deg', 1.0_wp, 'N m/deg', '+ resists')]

   type(definition_t), parameter :: lateral_list(*) = [ &
      definition_t('lateral force steer', 'toe_deg', 'factor', 1000.0_wp, 'deg/kN', &
      '+ turns to the left under a force to the right', 's'), &
      definition_t('lateral force camber', 'camber_deg', 'factor', 1000.0_wp, 'deg/kN', &
      '+ top moves outward under a force inward', &
      is_own=.true.), &
      definition_t('lateral deflection', 'track_change_mm', 'factor', 1000.0_wp, 'mm/kN', '+ patch gives way along the force', 'i')]

   type(definition_t), parameter :: aligning_list(*) = [ &
      definition_t('aligning torque steer', 'toe_deg', 'factor', 100.0_wp, 'deg/100 N m', &
      '+ turns to the left under a torque to the left', 's'), &
      definition_t('aligning torque camber', 'camber_deg', 'factor', 100.0_wp, 'deg/100 N m', &
      '+ top moves outward under a torque that turns the front edge outward', is_own=.true.)]

   type(definition_t), parameter :: braking_list(*) = [ &
      definition_t('braking deflection', 'wheelbase_change_mm', 'factor', 1000.0_wp, 'mm/kN', '+ patch gives way rearward'), &
      definition_t('braking steer', 'toe_deg', 'factor', 1000.0_wp, 'deg/kN', '+ turns to the left', 's'), &
      definition_t('braking toe', 'toe_deg', 'factor', 1000.0_wp, 'deg/kN', '+ front edge moves inward'), &
      definition_t('braking caster', 'caster_deg', 'factor', 1000.0_wp, 'deg/kN', '+ top of the axis moves rearward')]

   type(definition_t), parameter :: traction_list(*) = [ &
      definition_t('traction deflection', 'wheel_centre_x_mm', 'factor', 1000.0_wp, 'mm/kN', &
      '+ wheel centre gives way forward', 'd'), &
      definition_t('traction steer', 'toe_deg', 'factor', 1000.0_wp, 'deg/kN', '+ turns to the left', 's'), &
      definition_t('traction toe', 'toe_deg', 'factor', 1000.0_wp, 'deg/kN', '+ front edge moves inward'), &
      definition_t('traction caster', 'caster_deg', 'factor', 1000.0_wp, 'deg/kN', '+ top of the axis moves rearward')]

   type(definition_t), parameter :: steering_list(*) = [ &
      definition_t('steer per steering wheel', 'toe_deg', 'steering_wheel_deg', 1.0_wp, 'deg/deg', '+ to the left', 's'), &
      definition_t('steer per steering input', 'toe_deg', 'factor', 1.0_wp, 'deg/mm', '+ to the left', 's'), &
      definition_t('steer camber', 'camber_deg', 'factor', 1.0_wp, 'deg/mm', &
      '+ top moves outward, steered to the own side', is_own=.true.), &
      definition_t('steer caster', 'caster_deg', 'factor', 1.0_wp, 'deg/mm', &
      '+ top moves rearward, steered to the own side', is_own=.true.), &
      definition_t('scrub radius change', 'scrub_radius_mm', 'factor', 1.0_wp, 'mm/mm', &
      '+ grows, steered to the own side', is_own=.true.), &
      definition_t('caster trail change', 'caster_trail_mm', 'factor', 1.0_wp, 'mm/mm', &
      '+ grows, steered to the own side', is_own=.true.), &
      definition_t('lift', 'wheel_travel_mm', 'factor', 1.0_wp, 'mm/mm', &
      '+ wheel moves up, steered to the own side', is_own=.true.)]

   type(definition_t), parameter :: vertical_list(*) = [ &
      definition_t('vertical deflection', 'wheel_travel_mm', 'factor', 1000.0_wp, 'mm/kN', '+ wheel moves up under a force up'), &
      definition_t('vertical force toe', 'toe_deg', 'factor', 1000.0_wp, 'deg/kN', '+ front edge moves inward under a force up'), &
      definition_t('vertical force camber', 'camber_deg', 'factor', 1000.0_wp, 'deg/kN', '+ top moves outward under a force up'), &
      definition_t('vertical force caster', 'caster_deg', 'factor', 1000.0_wp, 'deg/kN', '+ top moves rearward under a force up')]

contains

   !> Sets the half width of one window by its word: travel, roll, force, torque, rack, wheel.
   pure subroutine set_window(windows, word, half, is_known)
      type(windows_t), intent(inout) :: windows
      character(*), intent(in) :: word
      real(wp), intent(in) :: half         !! mm, deg, N or N m; positive
      logical, intent(out) :: is_known

      is_known = .true.
      select case (word)
      case ('travel')
         windows%travel = half
      case ('roll')
         windows%roll = half
      case ('force')
         windows%force = half
      case ('torque')
         windows%torque = half
      case ('rack')
         windows%rack = half
      case ('wheel')
         windows%wheel = half
      case default
         is_known = .false.
      end select
   end subroutine set_window

   !> The declared gradients of a kind of test.
   pure function definitions_of(kind) result(list)
      character(*), intent(in) :: kind
      type(definition_t), allocatable :: list(:)

      select case (kind)
      case ('parallel_travel', 'opposite_travel', 'single_travel')
         list = travel_list
         if (kind == 'opposite_travel') list%quantity = 'opposite '//list%quantity(:27)
         if (kind == 'single_travel') list%quantity = 'single '//list%quantity(:29)
      case ('roll')
         list = roll_list
      case ('lateral_force')
         list = lateral_list
      case ('aligning_torque')
         list = aligning_list
      case ('braking')
         list = braking_list
      case ('traction')
         list = traction_list
      case ('steering')
         list = steering_list
      case ('vertical_force')
         list = vertical_list
      case default
         allocate (list(0))
      end select
   end function definitions_of

   !> All gradients of a test that its table defines.
   subroutine test_gradients(test, windows, gradients)
      type(test_result_t), intent(in) :: test
      type(windows_t), intent(in) :: windows
      type(gradient_t), allocatable, intent(inout) :: gradients(:)   !! appended to
      type(definition_t), allocatable :: list(:)
      character(name_length) :: name
      integer :: k, wheel, place
      logical :: is_of_axle

      if (.not. allocated(gradients)) allocate (gradients(0))
      list = definitions_of(test%kind)
      do k = 1, size(list)
         do wheel = 1, size(test%prefixes)
            name = trim(test%prefixes(wheel))//list(k)%column
            place = column_index(test%table, name)
            is_of_axle = place == 0
            if (is_of_axle) then
               name = list(k)%column
               place = column_index(test%table, name)
               if (wheel > 1) place = 0         ! the axle has it once
            end if
            if (place == 0) cycle
            if (wheel_column(test, wheel, trim(list(k)%over)) == 0) cycle
            call append(one_gradient(test, windows, list(k), wheel, place, is_of_axle))
         end do
      end do

   contains

      subroutine append(gradient)
         type(gradient_t), intent(in) :: gradient
         type(gradient_t), allocatable :: grown(:)

         allocate (grown(size(gradients) + 1))
         grown(:size(gradients)) = gradients
         grown(size(grown)) = gradient
         call move_alloc(grown, gradients)
      end subroutine append

   end subroutine test_gradients

   !> One slope with all that has to be known of it.
   function one_gradient(test, windows, definition, wheel, place, is_of_axle) result(gradient)
      type(test_result_t), intent(in) :: test
      type(windows_t), intent(in) :: windows
      type(definition_t), intent(in) :: definition
      integer, intent(in) :: wheel, place
      logical, intent(in) :: is_of_axle
      type(gradient_t) :: gradient
      real(wp), allocatable :: x(:), y(:)
      logical :: is_good(row_count(test%table))
      character(8) :: unit
      real(wp) :: slope
      integer :: over, side

      over = wheel_column(test, wheel, trim(definition%over))
      side = test%sides(wheel)
      gradient%test = test%name
      gradient%quantity = trim(definition%quantity)
      gradient%side = ''
      if (.not. is_of_axle .and. size(test%prefixes) > 1) gradient%side = trim(merge('left ', 'right', side < 0))
      gradient%unit = trim(definition%unit)
      gradient%sign = trim(definition%sign)
      gradient%column = trim(test%table%columns(place))
      gradient%over = trim(test%table%columns(over))
      call window_of(test%kind, definition%over, windows, gradient%window_half, unit)
      gradient%window = '±'//str(gradient%window_half)//' '//trim(unit)

      is_good = converged_rows(test%table)
      x = pack(test%table%values(over, :), is_good)
      y = pack(test%table%values(place, :), is_good)
      if (definition%over == 'factor') then
         where (ieee_is_finite(x)) x = x*test%factor_size
      end if
      call slope_over_window(x, y, gradient%window_half, slope, gradient%points)
      gradient%note = ''
      gradient%value = slope
      if (.not. ieee_is_finite(slope)) then
         gradient%note = 'no state lies in the window'
         if (gradient%points > 0) gradient%note = 'only '//str(gradient%points)//' of at least '//str(least_points)// &
            ' states in the window'
         if (gradient%points >= least_points) gradient%note = trim(gradient%over)//' does not change'
         return
      end if
      gradient%value = slope*definition%size*turn_of(test, definition, side)
   end function one_gradient

   !> s_y/s_x of a wheel.
   pure real(wp) function turn_of(test, definition, side) result(turn)
      type(test_result_t), intent(in) :: test
      type(definition_t), intent(in) :: definition
      integer, intent(in) :: side

      turn = 1.0_wp
      select case (definition%y_turn)
      case ('s', 'i')
         turn = side
      case ('d')
         turn = merge(1.0_wp, -1.0_wp, test%is_iso)
      end select
      if (definition%is_own) turn = -side*turn                       ! + on the left wheel
      if (test%is_anti .and. side > 0) turn = -turn                  ! the load on the right wheel is −factor
   end function turn_of

   !> Half width and unit of the window of a gradient.
   pure subroutine window_of(kind, over, windows, half, unit)
      character(*), intent(in) :: kind, over
      type(windows_t), intent(in) :: windows
      real(wp), intent(out) :: half
      character(*), intent(out) :: unit

      select case (over)
      case ('wheel_travel_mm')
         half = windows%travel
         unit = 'mm'
      case ('axle_roll_deg')
         half = windows%roll
         unit = 'deg'
      case ('steering_wheel_deg')
         half = windows%wheel
         unit = 'deg'
      case default
         half = windows%force
         unit = 'N'
         if (kind == 'aligning_torque') then
            half = windows%torque
            unit = 'N m'
         else if (kind == 'steering') then
            half = windows%rack
            unit = 'mm'
         end if
      end select
   end subroutine window_of

   !> Least-squares slope of y over x where |x| ≤ half; not a number with fewer than three different x.
   pure subroutine slope_over_window(x, y, half, slope, points)
      real(wp), intent(in) :: x(:), y(:)
      real(wp), intent(in) :: half
      real(wp), intent(out) :: slope
      integer, intent(out) :: points       !! states in the window
      real(wp) :: mean_x, mean_y, across, along, low, high
      real(wp), parameter :: rim = 1.0_wp + 1.0e-6_wp   !! a state meant to lie on the edge is inside: travel is driven to 1e-7 mm
      logical :: is_inside(size(x))
      integer :: k

      slope = ieee_value(1.0_wp, ieee_quiet_nan)
      is_inside = .false.
      low = huge(1.0_wp)
      high = -huge(1.0_wp)
      mean_x = 0.0_wp
      mean_y = 0.0_wp
      do k = 1, size(x)
         if (.not. (ieee_is_finite(x(k)) .and. ieee_is_finite(y(k)))) cycle
         if (abs(x(k)) > half*rim) cycle
         is_inside(k) = .true.
         low = min(low, x(k))
         high = max(high, x(k))
         mean_x = mean_x + x(k)
         mean_y = mean_y + y(k)
      end do
      points = count(is_inside)
      if (points < least_points) return
      if (high - low <= 1.0e-3_wp*half) return        ! all at one place: no slope
      mean_x = mean_x/points
      mean_y = mean_y/points
      across = 0.0_wp
      along = 0.0_wp
      do k = 1, size(x)
         if (.not. is_inside(k)) cycle
         along = along + (x(k) - mean_x)**2
         across = across + (x(k) - mean_x)*(y(k) - mean_y)
      end do
      slope = across/along
   end subroutine slope_over_window

end module ek_gradient
