!> The gradients of each kind of test: column over column, with unit and sign.
!>
!> A new gradient is one line below; ek_gradient computes its value, slope_unit of ek_quantity its unit.
module ek_gradient_definition
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
      character(72) :: sign = ''
      character(1) :: y_turn = ' '        !! 's': times side (toe → steer); 'd': x of the deck, reported forward;
      !!                                     'i': outward, reported to the right; 'o': x is positive towards the side of the
      !!                                     wheel, mirrored on the right one
      character(20) :: over = 'factor'    !! column of x; 'factor' in units of the case (N, N m, mm)
   end type definition_t

   character(*), parameter :: in_bump = ' in bump', left_up = ' with the left wheel up', under = ' under a force to the right', &
      torque = ' under a torque to the left', inner = ', inner wheel', force_up = ' under a force up', &
      inward = '+ front edge moves inward', outward = '+ top moves outward', rearward = '+ top of the axis moves rearward', &
      to_left = '+ steers to the left'

   type(definition_t), parameter :: travel_list(*) = [ &
      definition_t('bump toe', 'toe_deg', inward//in_bump), definition_t('bump steer', 'toe_deg', to_left//in_bump, 's'), &
      definition_t('bump camber', 'camber_deg', outward//in_bump), definition_t('bump caster', 'caster_deg', rearward//in_bump), &
      definition_t('bump caster, instant axis', 'instant_caster_deg', rearward//in_bump), &
      definition_t('half-track change', 'track_change_mm', '+ patch moves outward'//in_bump), &
      definition_t('wheelbase change', 'wheelbase_change_mm', '+ patch moves rearward'//in_bump), &
      definition_t('wheel rate', 'vertical_force_n', '+ load increases'//in_bump), &
      definition_t('roll-centre height change', 'roll_centre_height_mm', '+ rises over the ground'//in_bump)]

   ! Per roll of the wheels relative to the body, positive with the left wheel up for both wheels, as the column axle_roll_deg;
   ! the columns wheel_roll_… of the matrix are the slopes at a state
   type(definition_t), parameter :: roll_list(*) = [ &
      definition_t('wheel roll steer', 'toe_deg', to_left//left_up, 's'), &
      definition_t('wheel roll toe', 'toe_deg', inward//left_up), &
      definition_t('wheel roll camber', 'camber_deg', outward//left_up), &
      definition_t('camber relative to road in roll', 'inclination_deg', outward//' relative to the road'//left_up), &
      definition_t('wheel roll caster', 'caster_deg', rearward//left_up), &
      definition_t('wheel load in roll', 'vertical_force_n', '+ increases'//left_up), &
      definition_t('roll rate', 'roll_moment_nm', '+ restoring')]

   type(definition_t), parameter :: lateral_list(*) = [ &
      definition_t('lateral force steer', 'toe_deg', to_left//under, 's'), &
      definition_t('lateral force camber', 'camber_deg', outward//under), &
      definition_t('lateral deflection', 'track_change_mm', '+ patch moves with the force', 'i')]

   type(definition_t), parameter :: aligning_list(*) = [ &
      definition_t('aligning torque steer', 'toe_deg', to_left//torque, 's'), &
      definition_t('aligning torque camber', 'camber_deg', outward//torque)]

   type(definition_t), parameter :: braking_list(*) = [ &
      definition_t('braking deflection', 'wheelbase_change_mm', '+ patch moves rearward'), &
      definition_t('braking camber', 'camber_deg', outward), definition_t('braking steer', 'toe_deg', to_left, 's'), &
      definition_t('braking toe', 'toe_deg', inward), definition_t('braking caster', 'caster_deg', rearward)]

   type(definition_t), parameter :: traction_list(*) = [ &
      definition_t('traction deflection', 'wheel_centre_x_mm', '+ wheel centre moves forward', 'd'), &
      definition_t('traction camber', 'camber_deg', outward), definition_t('traction steer', 'toe_deg', to_left, 's'), &
      definition_t('traction toe', 'toe_deg', inward), definition_t('traction caster', 'caster_deg', rearward)]

   type(definition_t), parameter :: steering_list(*) = [ &
      definition_t('steer per steering wheel', 'toe_deg', '+ to the left', 's', 'steering_wheel_deg'), &
      definition_t('steer per steering input', 'toe_deg', '+ to the left', 's'), &
      definition_t('steer camber', 'camber_deg', outward//inner, 'o'), &
      definition_t('steer caster', 'caster_deg', '+ top moves rearward'//inner, 'o'), &
      definition_t('scrub radius change', 'scrub_radius_mm', '+ increases'//inner, 'o'), &
      definition_t('caster trail change', 'caster_trail_mm', '+ increases'//inner, 'o'), &
      definition_t('wheel lift in steer', 'wheel_travel_mm', '+ wheel moves up'//inner, 'o')]

   type(definition_t), parameter :: vertical_list(*) = [ &
      definition_t('vertical deflection', 'wheel_travel_mm', '+ wheel moves up'//force_up), &
      definition_t('vertical force toe', 'toe_deg', inward//force_up), &
      definition_t('vertical force camber', 'camber_deg', outward//force_up), &
      definition_t('vertical force caster', 'caster_deg', '+ top moves rearward'//force_up)]

contains

   !> The gradients of a kind of test; empty for a kind without list.
   pure function definitions_of(kind) result(list)
      character(*), intent(in) :: kind
      type(definition_t), allocatable :: list(:)
      integer :: k

      select case (kind)
      case ('parallel_travel', 'opposite_travel', 'single_travel')
         list = travel_list
         list%over = 'wheel_travel_mm'
         if (kind == 'opposite_travel') list%quantity = 'opposite '//list%quantity(:43)
         if (kind == 'single_travel') list%quantity = 'single '//list%quantity(:45)
      case ('roll')
         list = roll_list
         list%over = 'axle_roll_deg'
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
