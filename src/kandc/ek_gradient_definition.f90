!> The gradients of each kind of test: column over column, with unit and sign.
!>
!> A new gradient is one line below; ek_gradient computes its value.
module ek_gradient_definition
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: definition_t, definitions_of, fitted

   !> Ends the name of every gradient, because a least-squares slope over a window differs from the slope at a state in a
   !> column of the compliance matrix.
   character(*), parameter :: fitted = ' (fitted)'

   !> Definition of a gradient, for the equation at the top of ek_gradient.
   type :: definition_t
      character(52) :: quantity = ''
      character(28) :: column = ''
      character(20) :: over = ''          !! column of x; 'factor' in units of the case (N, N m, mm)
      real(wp) :: size = 1.0_wp           !! factor on the slope
      character(12) :: unit = ''
      character(72) :: sign = ''
      character(1) :: y_turn = ' '        !! 's': times side (toe → steer); 'd': x of the deck, reported forward;
      !!                                     'i': outward, reported to the right
      logical :: is_own = .false.         !! x is positive towards the side of the wheel: mirrored on the right one
   end type definition_t

   character(*), parameter :: in_bump = ' in bump', left_in_bump = '+ steers to the left in bump', &
      left_up = ' with the left wheel up'

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
      definition_t('wheel rate', 'vertical_force_n', 'wheel_travel_mm', 1.0_wp, 'N/mm', '+ load increases'//in_bump), &
      definition_t('roll-centre height change', 'roll_centre_height_mm', 'wheel_travel_mm', 1.0_wp, 'mm/mm', &
      '+ rises over the ground'//in_bump)]

   ! Per roll of the wheels relative to the body, positive with the left wheel up for both wheels, as the column axle_roll_deg;
   ! the columns wheel_roll_… of the matrix are the slopes at a state
   type(definition_t), parameter :: roll_list(*) = [ &
      definition_t('wheel roll steer', 'toe_deg', 'axle_roll_deg', 1.0_wp, 'deg/deg', '+ steers to the left'//left_up, 's'), &
      definition_t('wheel roll toe', 'toe_deg', 'axle_roll_deg', 1.0_wp, 'deg/deg', '+ front edge moves inward'//left_up), &
      definition_t('wheel roll camber', 'camber_deg', 'axle_roll_deg', 1.0_wp, 'deg/deg', '+ top moves outward'//left_up), &
      definition_t('camber relative to road in roll', 'inclination_deg', 'axle_roll_deg', 1.0_wp, 'deg/deg', &
      '+ top moves outward relative to the road'//left_up), &
      definition_t('wheel roll caster', 'caster_deg', 'axle_roll_deg', 1.0_wp, 'deg/deg', &
      '+ top of the axis moves rearward'//left_up), &
      definition_t('wheel load in roll', 'vertical_force_n', 'axle_roll_deg', 1.0_wp, 'N/deg', '+ increases'//left_up), &
      definition_t('roll rate', 'roll_moment_nm', 'axle_roll_deg', 1.0_wp, 'N m/deg', '+ restoring')]

   type(definition_t), parameter :: lateral_list(*) = [ &
      definition_t('lateral force steer', 'toe_deg', 'factor', 1000.0_wp, 'deg/kN', &
      '+ steers to the left under a force to the right', 's'), &
      definition_t('lateral force camber', 'camber_deg', 'factor', 1000.0_wp, 'deg/kN', &
      '+ top moves outward under a force to the right'), &
      definition_t('lateral deflection', 'track_change_mm', 'factor', 1000.0_wp, 'mm/kN', '+ patch moves with the force', 'i')]

   type(definition_t), parameter :: aligning_list(*) = [ &
      definition_t('aligning torque steer', 'toe_deg', 'factor', 100.0_wp, 'deg/100 N m', &
      '+ steers to the left under a torque to the left', 's'), &
      definition_t('aligning torque camber', 'camber_deg', 'factor', 100.0_wp, 'deg/100 N m', &
      '+ top moves outward under a torque to the left')]

   type(definition_t), parameter :: braking_list(*) = [ &
      definition_t('braking deflection', 'wheelbase_change_mm', 'factor', 1000.0_wp, 'mm/kN', '+ patch moves rearward'), &
      definition_t('braking camber', 'camber_deg', 'factor', 1000.0_wp, 'deg/kN', '+ top moves outward'), &
      definition_t('braking steer', 'toe_deg', 'factor', 1000.0_wp, 'deg/kN', '+ steers to the left', 's'), &
      definition_t('braking toe', 'toe_deg', 'factor', 1000.0_wp, 'deg/kN', '+ front edge moves inward'), &
      definition_t('braking caster', 'caster_deg', 'factor', 1000.0_wp, 'deg/kN', '+ top of the axis moves rearward')]

   type(definition_t), parameter :: traction_list(*) = [ &
      definition_t('traction deflection', 'wheel_centre_x_mm', 'factor', 1000.0_wp, 'mm/kN', &
      '+ wheel centre moves forward', 'd'), &
      definition_t('traction camber', 'camber_deg', 'factor', 1000.0_wp, 'deg/kN', '+ top moves outward'), &
      definition_t('traction steer', 'toe_deg', 'factor', 1000.0_wp, 'deg/kN', '+ steers to the left', 's'), &
      definition_t('traction toe', 'toe_deg', 'factor', 1000.0_wp, 'deg/kN', '+ front edge moves inward'), &
      definition_t('traction caster', 'caster_deg', 'factor', 1000.0_wp, 'deg/kN', '+ top of the axis moves rearward')]

   type(definition_t), parameter :: steering_list(*) = [ &
      definition_t('steer per steering wheel', 'toe_deg', 'steering_wheel_deg', 1.0_wp, 'deg/deg', '+ to the left', 's'), &
      definition_t('steer per steering input', 'toe_deg', 'factor', 1.0_wp, 'deg/mm', '+ to the left', 's'), &
      definition_t('steer camber', 'camber_deg', 'factor', 1.0_wp, 'deg/mm', &
      '+ top moves outward, inner wheel', is_own=.true.), &
      definition_t('steer caster', 'caster_deg', 'factor', 1.0_wp, 'deg/mm', &
      '+ top moves rearward, inner wheel', is_own=.true.), &
      definition_t('scrub radius change', 'scrub_radius_mm', 'factor', 1.0_wp, 'mm/mm', &
      '+ increases, inner wheel', is_own=.true.), &
      definition_t('caster trail change', 'caster_trail_mm', 'factor', 1.0_wp, 'mm/mm', &
      '+ increases, inner wheel', is_own=.true.), &
      definition_t('wheel lift in steer', 'wheel_travel_mm', 'factor', 1.0_wp, 'mm/mm', &
      '+ wheel moves up, inner wheel', is_own=.true.)]

   type(definition_t), parameter :: vertical_list(*) = [ &
      definition_t('vertical deflection', 'wheel_travel_mm', 'factor', 1000.0_wp, 'mm/kN', '+ wheel moves up under a force up'), &
      definition_t('vertical force toe', 'toe_deg', 'factor', 1000.0_wp, 'deg/kN', '+ front edge moves inward under a force up'), &
      definition_t('vertical force camber', 'camber_deg', 'factor', 1000.0_wp, 'deg/kN', '+ top moves outward under a force up'), &
      definition_t('vertical force caster', 'caster_deg', 'factor', 1000.0_wp, 'deg/kN', '+ top moves rearward under a force up')]

contains

   !> The gradients of a kind of test; empty for a kind without list.
   pure function definitions_of(kind) result(list)
      character(*), intent(in) :: kind
      type(definition_t), allocatable :: list(:)
      integer :: k

      select case (kind)
      case ('parallel_travel', 'opposite_travel', 'single_travel')
         list = travel_list
         if (kind == 'opposite_travel') list%quantity = 'opposite '//list%quantity(:43)
         if (kind == 'single_travel') list%quantity = 'single '//list%quantity(:45)
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
      do k = 1, size(list)
         list(k)%quantity = trim(list(k)%quantity)//fitted
      end do
   end function definitions_of

end module ek_gradient_definition
