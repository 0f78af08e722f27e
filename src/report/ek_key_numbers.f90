!> The key numbers of a report, from all its tests: attitude at design, rates, ride and roll, compliance,
!> anti-dive, anti-lift, anti-squat, steering. Numbers without a column or test are omitted.
module ek_key_numbers
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_table, only: column_index
   use ek_quantity, only: without_phase
   use ek_test_result, only: test_result_t, design_row, unfolded_rows
   use ek_gradient, only: gradient_t
   use ek_gradient_definition, only: fitted
   use ek_key_number, only: key_number_t, nothing
   use ek_place_numbers, only: place_numbers
   implicit none(type, external)
   private
   public :: key_number_t, key_numbers

   !> The source of a key number.
   type :: source_t
      character(34) :: group = ''
      character(64) :: quantity = ''
      character(52) :: name = ''          !! column, or quantity of a gradient without its ' (fitted)'
      character(8) :: how = ''            !! 'design': column at design; 'gradient'; 'largest', 'least': over a test
      character(16) :: kind = ''          !! kind of the test; '': any
      character(4) :: phase = ''          !! parallel 'in', opposed 'anti'; '': any
      character(12) :: unit = ''
      character(56) :: sign = ''
      character(1) :: steered = ' '       !! 'y': only for an axle with &steering; 'n': only without
   end type source_t

   character(*), parameter :: attitude = 'Attitude at design', rates = 'Rates', ride = 'Ride', roll = 'Roll', &
      comply = 'Compliance', &
      held = 'Compliance at design', elastic = 'Elastic steer axis', anti = 'Anti-dive, anti-lift, anti-squat', steer = 'Steering'

   type(source_t), parameter :: attitude_list(*) = [ &
      source_t(attitude, 'toe', 'toe_deg', 'design', '', '', 'deg', '+ front edge inward'), &
      source_t(attitude, 'camber', 'camber_deg', 'design', '', '', 'deg', '+ top outward'), &
      source_t(attitude, 'caster', 'caster_deg', 'design', '', '', 'deg', '+ top rearward'), &
      source_t(attitude, 'kingpin inclination', 'kingpin_inclination_deg', 'design', '', '', 'deg', '+ top inward'), &
      source_t(attitude, 'scrub radius', 'scrub_radius_mm', 'design', '', '', 'mm', &
      '+ axis meets the ground inboard of the patch'), &
      source_t(attitude, 'caster trail', 'caster_trail_mm', 'design', '', '', 'mm', &
      '+ axis meets the ground ahead of the patch'), &
      source_t(attitude, 'spindle length', 'spindle_length_mm', 'design', '', '', 'mm', '+ wheel centre outboard of the axis'), &
      source_t(attitude, 'spindle offset', 'spindle_offset_mm', 'design', '', '', 'mm', '+ wheel centre behind the axis'), &
      source_t(attitude, 'caster, instant axis', 'instant_caster_deg', 'design', '', '', 'deg', &
      '+ top rearward', 'y'), &
      source_t(attitude, 'kingpin inclination, instant axis', 'instant_kingpin_inclination_deg', 'design', '', '', 'deg', &
      '+ top inward', 'y'), &
      source_t(attitude, 'scrub radius, instant axis', 'instant_scrub_radius_mm', 'design', '', '', 'mm', &
      '+ inboard of the patch', 'y'), &
      source_t(attitude, 'caster trail, instant axis', 'instant_caster_trail_mm', 'design', '', '', 'mm', &
      '+ ahead of the patch', 'y'), &
      source_t(attitude, 'steer-axis offset, wheel centre', 'centre_axis_distance_mm', 'design', '', '', 'mm', &
      'shortest distance'), &
      source_t(attitude, 'steer-axis offset, patch', 'patch_axis_distance_mm', 'design', '', '', 'mm', 'shortest distance'), &
      source_t(attitude, 'spindle length, along', 'along_spindle_length_mm', 'design', '', '', 'mm', &
      '+ wheel centre outboard, along the spin axis'), &
      source_t(attitude, 'spindle offset, across', 'across_spindle_offset_mm', 'design', '', '', 'mm', &
      '+ spin axis behind the steer axis'), &
      source_t(attitude, 'total track', 'total_track_mm', 'design', '', '', 'mm', 'distance of the patches'), &
      source_t(attitude, 'wheel load', 'vertical_force_n', 'design', '', '', 'N', 'ground on wheel'), &
      source_t(attitude, 'roll centre height', 'roll_centre_height_mm', 'design', '', '', 'mm', '+ above the ground'), &
      source_t(attitude, 'roll centre, lateral', 'roll_centre_y_mm', 'design', '', '', 'mm', 'y of the deck'), &
      source_t(attitude, 'force-based roll centre height', 'force_roll_centre_height_mm', 'design', '', '', 'mm', &
      '+ above the ground')]

   type(source_t), parameter :: rates_list(*) = [ &
      source_t(rates, 'wheel rate', 'wheel_rate_n_per_mm', 'design', '', '', 'N/mm', 'wheels parallel (in phase)'), &
      source_t(rates, 'wheel rate', 'wheel rate', 'gradient', 'parallel_travel', '', 'N/mm', ''), &
      source_t(rates, 'ride rate', 'ride_rate_n_per_mm', 'design', '', '', 'N/mm', 'with the tyre'), &
      source_t(rates, 'ride frequency', 'ride_frequency_hz', 'design', '', '', 'Hz', 'ride rate and sprung mass'), &
      source_t(rates, 'vertical deflection', 'vertical deflection', 'gradient', 'vertical_force', '', 'mm/kN', '+ up'), &
      source_t(rates, 'suspension roll rate', 'suspension_roll_rate_nm_per_deg', 'design', '', '', 'N m/deg', ''), &
      source_t(rates, 'total roll rate', 'total_roll_rate_nm_per_deg', 'design', '', '', 'N m/deg', 'with the tyres'), &
      source_t(rates, 'hop rate', 'hop_rate_n_per_mm', 'design', '', '', 'N/mm', 'tyre in parallel'), &
      source_t(rates, 'tramp rate', 'tramp_rate_nm_per_deg', 'design', '', '', 'N m/deg', 'tyres in parallel'), &
      source_t(rates, 'fore-aft stiffness', 'fore_aft_stiffness_n_per_mm', 'design', '', '', 'N/mm', 'at the wheel centre'), &
      source_t(rates, 'lateral stiffness', 'lateral_stiffness_n_per_mm', 'design', '', '', 'N/mm', 'at the wheel centre'), &
      source_t(rates, 'vertical stiffness', 'vertical_stiffness_n_per_mm', 'design', '', '', 'N/mm', 'at the wheel centre')]

   type(source_t), parameter :: ride_list(*) = [ &
      source_t(ride, 'bump steer', 'bump steer', 'gradient', 'parallel_travel', '', '', ''), &
      source_t(ride, 'bump toe', 'bump toe', 'gradient', 'parallel_travel', '', '', ''), &
      source_t(ride, 'bump camber', 'bump camber', 'gradient', 'parallel_travel', '', '', ''), &
      source_t(ride, 'bump caster', 'bump caster', 'gradient', 'parallel_travel', '', '', ''), &
      source_t(ride, 'half-track change', 'half-track change', 'gradient', 'parallel_travel', '', '', ''), &
      source_t(ride, 'wheelbase change', 'wheelbase change', 'gradient', 'parallel_travel', '', '', ''), &
      source_t(ride, 'roll-centre height change', 'roll-centre height change', 'gradient', 'parallel_travel', '', '', ''), &
      source_t(ride, 'recession gradient', 'recession_gradient_mm_per_m', 'design', '', '', 'mm/m', '+ rearward in bump'), &
      source_t(ride, 'side-view swing arm length', 'side_view_arm_length_mm', 'design', '', '', 'mm', ''), &
      source_t(ride, 'side-view swing arm angle', 'side_view_arm_angle_deg', 'design', '', '', 'deg', ''), &
      source_t(ride, 'front-view swing arm length', 'front_view_arm_length_mm', 'design', '', '', 'mm', ''), &
      source_t(ride, 'front-view swing arm angle', 'front_view_arm_angle_deg', 'design', '', '', 'deg', ''), &
      source_t(roll, 'wheel roll steer', 'wheel roll steer', 'gradient', 'roll', '', '', ''), &
      source_t(roll, 'wheel roll camber', 'wheel roll camber', 'gradient', 'roll', '', '', ''), &
      source_t(roll, 'camber relative to road in roll', 'camber relative to road in roll', 'gradient', 'roll', '', '', ''), &
      source_t(roll, 'wheel roll caster', 'wheel roll caster', 'gradient', 'roll', '', '', ''), &
      source_t(roll, 'wheel load in roll', 'wheel load in roll', 'gradient', 'roll', '', '', ''), &
      source_t(roll, 'roll rate', 'roll rate', 'gradient', 'roll', '', '', '')]

   type(source_t), parameter :: comply_list(*) = [ &
      source_t(comply, 'lateral deflection, parallel (in phase)', 'lateral deflection', 'gradient', 'lateral_force', 'in', &
      '', ''), &
      source_t(comply, 'lateral force steer, parallel (in phase)', 'lateral force steer', 'gradient', 'lateral_force', 'in', &
      '', ''), &
      source_t(comply, 'lateral force camber, parallel (in phase)', 'lateral force camber', 'gradient', 'lateral_force', &
      'in', '', ''), &
      source_t(comply, 'lateral deflection, opposed (anti phase)', 'lateral deflection', 'gradient', 'lateral_force', &
      'anti', '', ''), &
      source_t(comply, 'lateral force steer, opposed (anti phase)', 'lateral force steer', 'gradient', 'lateral_force', &
      'anti', '', ''), &
      source_t(comply, 'lateral force camber, opposed (anti phase)', 'lateral force camber', 'gradient', 'lateral_force', &
      'anti', '', ''), &
      source_t(comply, 'aligning torque steer, parallel (in phase)', 'aligning torque steer', 'gradient', 'aligning_torque', &
      'in', '', ''), &
      source_t(comply, 'aligning torque camber, parallel (in phase)', 'aligning torque camber', 'gradient', 'aligning_torque', &
      'in', '', ''), &
      source_t(comply, 'aligning torque steer, opposed (anti phase)', 'aligning torque steer', 'gradient', 'aligning_torque', &
      'anti', '', ''), &
      source_t(comply, 'braking deflection', 'braking deflection', 'gradient', 'braking', '', '', ''), &
      source_t(comply, 'braking steer', 'braking steer', 'gradient', 'braking', '', '', ''), &
      source_t(comply, 'braking caster', 'braking caster', 'gradient', 'braking', '', '', ''), &
      source_t(comply, 'traction deflection', 'traction deflection', 'gradient', 'traction', '', '', ''), &
      source_t(comply, 'traction steer', 'traction steer', 'gradient', 'traction', '', '', ''), &
      source_t(comply, 'traction caster', 'traction caster', 'gradient', 'traction', '', '', '')]

   ! at design, from the compliance matrix
   type(source_t), parameter :: held_list(*) = [ &
      source_t(held, 'lateral deflection, parallel (in phase), load held', 'lateral_in_load_held_deflection_mm_per_kn', 'design', &
      '', '', 'mm/kN', '+ patch moves with the force'), &
      source_t(held, 'lateral deflection, parallel (in phase), height held', 'lateral_in_height_held_deflection_mm_per_kn', &
      'design', '', '', 'mm/kN', '+ patch moves with the force'), &
      source_t(held, 'lateral force steer, parallel (in phase), load held', 'lateral_in_load_held_steer_deg_per_kn', 'design', &
      '', '', 'deg/kN', '+ to the left under a force to the right'), &
      source_t(held, 'lateral force steer, parallel (in phase), height held', 'lateral_in_height_held_steer_deg_per_kn', 'design', &
      '', '', 'deg/kN', '+ to the left under a force to the right'), &
      source_t(held, 'lateral force camber, parallel (in phase), load held', 'lateral_in_load_held_camber_deg_per_kn', 'design', &
      '', '', 'deg/kN', '+ top outward under a force to the right'), &
      source_t(held, 'lateral force camber, parallel (in phase), height held', 'lateral_in_height_held_camber_deg_per_kn', &
      'design', '', '', 'deg/kN', '+ top outward under a force to the right'), &
      source_t(held, 'aligning torque steer, parallel (in phase), load held', 'aligning_in_load_held_steer_deg_per_100nm', &
      'design', '', '', 'deg/100 N m', '+ to the left under a torque to the left'), &
      source_t(held, 'aligning torque steer, parallel (in phase), height held', &
      'aligning_in_height_held_steer_deg_per_100nm', 'design', &
      '', '', 'deg/100 N m', '+ to the left under a torque to the left'), &
      source_t(held, 'braking deflection, load held', 'braking_load_held_deflection_mm_per_kn', 'design', '', '', 'mm/kN', &
      '+ patch moves rearward'), &
      source_t(held, 'braking deflection, height held', 'braking_height_held_deflection_mm_per_kn', 'design', '', '', 'mm/kN', &
      '+ patch moves rearward'), &
      source_t(held, 'braking steer, load held', 'braking_load_held_steer_deg_per_kn', 'design', '', '', 'deg/kN', &
      '+ to the left'), &
      source_t(held, 'braking steer, height held', 'braking_height_held_steer_deg_per_kn', 'design', '', '', 'deg/kN', &
      '+ to the left'), &
      source_t(held, 'traction wind-up, load held', 'traction_load_held_rotation_y_deg_per_kn', 'design', '', '', 'deg/kN', &
      'rotation of the carrier about y'), &
      source_t(held, 'jacking, parallel (in phase)', 'lateral_in_jacking_n_per_kn', 'design', '', '', 'N/kN', &
      '+ the ground pushes up under a force to the right'), &
      source_t(elastic, 'caster, elastic axis', 'instant_caster_deg', 'design', '', '', 'deg', &
      '+ top rearward', 'n'), &
      source_t(elastic, 'kingpin inclination, elastic axis', 'instant_kingpin_inclination_deg', 'design', '', '', 'deg', &
      '+ top inward', 'n'), &
      source_t(elastic, 'scrub radius, elastic axis', 'instant_scrub_radius_mm', 'design', '', '', 'mm', &
      '+ inboard of the patch', 'n'), &
      source_t(elastic, 'caster trail, elastic axis', 'instant_caster_trail_mm', 'design', '', '', 'mm', &
      '+ ahead of the patch', 'n')]

   type(source_t), parameter :: last_list(*) = [ &
      source_t(anti, 'anti-dive', 'anti_dive_percent', 'design', '', '', '%', 'braking, front'), &
      source_t(anti, 'anti-lift, drive', 'anti_lift_drive_percent', 'design', '', '', '%', 'drive, front'), &
      source_t(anti, 'anti-lift, braking', 'anti_lift_brake_percent', 'design', '', '', '%', 'braking, rear'), &
      source_t(anti, 'anti-squat', 'anti_squat_percent', 'design', '', '', '%', 'drive, rear'), &
      source_t(anti, 'dive, braking', 'brake_dive_mm_per_g', 'design', '', '', 'mm/g', '+ body moves down'), &
      source_t(anti, 'lift, drive', 'drive_lift_mm_per_g', 'design', '', '', 'mm/g', '+ body moves up'), &
      source_t(anti, 'lift, braking', 'brake_lift_mm_per_g', 'design', '', '', 'mm/g', '+ body moves up'), &
      source_t(anti, 'squat, drive', 'drive_squat_mm_per_g', 'design', '', '', 'mm/g', '+ body moves down'), &
      source_t(steer, 'steering ratio', 'steering_ratio', 'design', '', '', '–', 'steering wheel over road wheel'), &
      source_t(steer, 'steer per steering input', 'steer per steering input', 'gradient', 'steering', '', '', ''), &
      source_t(steer, 'steer per steering wheel', 'steer per steering wheel', 'gradient', 'steering', '', '', ''), &
      source_t(steer, 'maximum steer to the left', 'steer_deg', 'largest', 'steering', '', 'deg', 'over the test'), &
      source_t(steer, 'maximum steer to the right', 'steer_deg', 'least', 'steering', '', 'deg', 'over the test'), &
      source_t(steer, 'maximum Ackermann', 'ackermann_percent', 'largest', 'steering', '', '%', 'over the test'), &
      source_t(steer, 'minimum turning circle', 'turning_circle_m', 'least', 'steering', '', 'm', 'over the test'), &
      source_t(steer, 'minimum turning circle, curb to curb', 'curb_to_curb_m', 'least', 'steering', '', 'm', 'over the test'), &
      source_t(steer, 'minimum turning circle, wall to wall', 'wall_to_wall_m', 'least', 'steering', '', 'm', 'over the test'), &
      source_t(steer, 'camber per steer', 'steer_camber_deg_per_deg', 'design', '', '', 'deg/deg', &
      '+ top outward, steer to the left'), &
      source_t(steer, 'steer camber', 'steer camber', 'gradient', 'steering', '', '', '')]

contains

   !> All key numbers that the tests provide.
   subroutine key_numbers(tests, gradients, numbers)
      type(test_result_t), intent(in) :: tests(:)
      type(gradient_t), intent(in) :: gradients(:)
      type(key_number_t), allocatable, intent(out) :: numbers(:)
      type(key_number_t) :: number
      logical :: is_steered, is_pair
      integer :: used, k

      allocate (numbers(size(attitude_list) + size(rates_list) + size(ride_list) + size(comply_list) + &
         size(held_list) + size(last_list)))
      used = 0
      is_steered = .false.
      is_pair = .false.
      do k = 1, size(tests)
         is_steered = is_steered .or. column_index(tests(k)%table, 'steering_ratio') > 0
         if (allocated(tests(k)%prefixes)) is_pair = is_pair .or. size(tests(k)%prefixes) > 1
      end do
      call take(attitude_list)
      call take(rates_list)
      call take(ride_list)
      call take(comply_list)
      call take(held_list)
      call take(last_list)
      numbers = numbers(:used)
      call place_numbers(tests, numbers)

   contains

      subroutine take(list)
         type(source_t), intent(in) :: list(:)
         logical :: is_there
         integer :: k

         do k = 1, size(list)
            number%group = trim(list(k)%group)      ! one by one: gfortran 12 leaks a trimmed text in a structure constructor
            number%quantity = trim(list(k)%quantity)
            number%unit = trim(list(k)%unit)
            number%sign = trim(list(k)%sign)
            number%left = nothing()
            number%right = nothing()
            number%is_of_axle = .false.
            if (list(k)%steered == merge('n', 'y', is_steered)) cycle
            if (list(k)%how == 'gradient') then
               call from_gradients(tests, gradients, list(k), number, is_there)
            else
               call from_tables(tests, list(k), number, is_there)
            end if
            if (.not. is_there) cycle
            if (.not. is_pair) then
               number%quantity = without_phase(number%quantity)
               number%sign = without_phase(number%sign)
            end if
            used = used + 1
            numbers(used) = number
         end do
      end subroutine take

   end subroutine key_numbers

   !> A gradient of the first test of the kind and phase.
   subroutine from_gradients(tests, gradients, source, number, is_there)
      type(test_result_t), intent(in) :: tests(:)
      type(gradient_t), intent(in) :: gradients(:)
      type(source_t), intent(in) :: source
      type(key_number_t), intent(inout) :: number
      logical, intent(out) :: is_there
      integer :: t, k

      is_there = .false.
      do t = 1, size(tests)
         if (tests(t)%kind /= source%kind) cycle
         if (len_trim(source%phase) > 0 .and. ((source%phase == 'anti') .neqv. tests(t)%is_anti)) cycle
         do k = 1, size(gradients)
            if (gradients(k)%test /= tests(t)%name .or. gradients(k)%quantity /= trim(source%name)//fitted) cycle
            is_there = .true.
            number%quantity = trim(source%quantity)//fitted
            number%unit = gradients(k)%unit
            number%sign = gradients(k)%sign//' (over '//gradients(k)%window//')'
            if (gradients(k)%side == 'right') then
               number%right = gradients(k)%value
            else
               number%left = gradients(k)%value
               number%is_of_axle = len(gradients(k)%side) == 0 .and. size(tests(t)%prefixes) > 1
            end if
         end do
         if (is_there) return
      end do
   end subroutine from_gradients

   !> A column at design, or its maximum or minimum, in the first test that has it.
   subroutine from_tables(tests, source, number, is_there)
      type(test_result_t), intent(in) :: tests(:)
      type(source_t), intent(in) :: source
      type(key_number_t), intent(inout) :: number
      logical, intent(out) :: is_there
      integer :: t, wheel, place
      real(wp) :: value

      is_there = .false.
      do t = 1, size(tests)
         if (len_trim(source%kind) > 0 .and. tests(t)%kind /= source%kind) cycle
         do wheel = 1, size(tests(t)%prefixes)
            place = column_index(tests(t)%table, trim(tests(t)%prefixes(wheel))//source%name)
            if (place == 0) cycle
            value = value_of(tests(t), place, source%how)
            if (.not. ieee_is_finite(value)) cycle
            is_there = .true.
            if (tests(t)%sides(wheel) > 0 .and. size(tests(t)%prefixes) > 1) then
               number%right = value
            else
               number%left = value
            end if
         end do
         place = column_index(tests(t)%table, source%name)
         if (.not. is_there .and. place > 0) then
            value = value_of(tests(t), place, source%how)
            is_there = ieee_is_finite(value)
            number%left = value
            number%is_of_axle = size(tests(t)%prefixes) > 1
         end if
         if (is_there) return
      end do
   end subroutine from_tables

   !> A column at design, or its maximum or minimum over the converged states; not a number if there is none.
   pure real(wp) function value_of(test, place, how) result(value)
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: place
      character(*), intent(in) :: how
      logical :: is_good(size(test%table%values, 2))
      integer :: row

      value = nothing()
      if (how == 'design') then
         row = design_row(test%table)
         if (row > 0) value = test%table%values(place, row)
         return
      end if
      is_good = unfolded_rows(test%table) .and. ieee_is_finite(test%table%values(place, :))
      if (.not. any(is_good)) return
      if (how == 'largest') value = maxval(test%table%values(place, :), mask=is_good)
      if (how == 'least') value = minval(test%table%values(place, :), mask=is_good)
   end function value_of

end module ek_key_numbers
