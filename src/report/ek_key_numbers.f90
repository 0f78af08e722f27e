!> The key numbers of a report, from all its tests: attitude at design, rates, ride and roll, compliance,
!> anti-dive, anti-lift, anti-squat, steering. Numbers without a column or test are omitted. Titles, units and signs are those of
!> ek_quantity and ek_gradient_definition.
module ek_key_numbers
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_table, only: column_index
   use ek_quantity, only: quantity_t, quantity_named, without_phase, unit_of, unit_text
   use ek_test_result, only: test_result_t, design_row
   use ek_gradient, only: gradient_t
   use ek_gradient_definition, only: fitted
   use ek_place_numbers, only: key_number_t, new_number, nothing, set_value, append, is_good, place_numbers
   implicit none(type, external)
   private
   public :: key_number_t, key_numbers

   !> One number: its group, what it is of, and how it is read.
   type :: entry_t
      character(32) :: group = ''
      character(44) :: name = ''        !! a column, or a gradient without its ending
      character(15) :: kind = ''        !! of the test; '': the first that has the column
      integer :: how = 0                !! at_design …
      character(38) :: title = ''       !! of an extreme; otherwise that of the column or gradient
   end type entry_t

   ! a column at design; its maximum and minimum over the test; a gradient, also of parallel or opposed loads alone
   integer, parameter :: at_design = 0, largest = 1, least = 2, slope = 3, in_phase = 4, anti_phase = 5
   character(*), parameter :: phases(slope:anti_phase) = [character(25) :: '', ', parallel (in phase)', ', opposed (anti phase)']

   character(*), parameter :: attitude = 'Attitude at design', rates = 'Rates', ride = 'Ride', roll = 'Roll', &
      comply = 'Compliance', held = 'Compliance at design', elastic = 'Elastic steer axis', &
      anti = 'Anti-dive, anti-lift, anti-squat', steer = 'Steering', travel = 'parallel_travel', lateral = 'lateral_force', &
      torque = 'aligning_torque', instant = 'instant'

   type(entry_t), parameter :: entries(*) = [ &
      entry_t(attitude, 'toe_deg'), entry_t(attitude, 'camber_deg'), entry_t(attitude, 'caster_deg'), &
      entry_t(attitude, 'kingpin_inclination_deg'), entry_t(attitude, 'scrub_radius_mm'), entry_t(attitude, 'caster_trail_mm'), &
      entry_t(attitude, 'spindle_length_mm'), entry_t(attitude, 'spindle_offset_mm'), entry_t(attitude, 'instant_caster_deg'), &
      entry_t(attitude, 'instant_kingpin_inclination_deg'), entry_t(attitude, 'instant_scrub_radius_mm'), &
      entry_t(attitude, 'instant_caster_trail_mm'), entry_t(attitude, 'centre_axis_distance_mm'), &
      entry_t(attitude, 'patch_axis_distance_mm'), entry_t(attitude, 'along_spindle_length_mm'), &
      entry_t(attitude, 'across_spindle_offset_mm'), entry_t(attitude, 'total_track_mm'), entry_t(attitude, 'vertical_force_n'), &
      entry_t(attitude, 'roll_centre_height_mm'), entry_t(attitude, 'roll_centre_y_mm'), &
      entry_t(attitude, 'force_roll_centre_height_mm'), entry_t(rates, 'wheel_rate_n_per_mm'), &
      entry_t(rates, 'wheel rate', travel, slope), entry_t(rates, 'ride_rate_n_per_mm'), entry_t(rates, 'ride_frequency_hz'), &
      entry_t(rates, 'vertical deflection', 'vertical_force', slope), entry_t(rates, 'suspension_roll_rate_nm_per_deg'), &
      entry_t(rates, 'total_roll_rate_nm_per_deg'), entry_t(rates, 'hop_rate_n_per_mm'), &
      entry_t(rates, 'tramp_rate_nm_per_deg'), entry_t(rates, 'fore_aft_stiffness_n_per_mm'), &
      entry_t(rates, 'lateral_stiffness_n_per_mm'), entry_t(rates, 'vertical_stiffness_n_per_mm'), &
      entry_t(ride, 'bump steer', travel, slope), entry_t(ride, 'bump toe', travel, slope), &
      entry_t(ride, 'bump camber', travel, slope), entry_t(ride, 'bump caster', travel, slope), &
      entry_t(ride, 'half-track change', travel, slope), entry_t(ride, 'wheelbase change', travel, slope), &
      entry_t(ride, 'roll-centre height change', travel, slope), entry_t(ride, 'recession_gradient_mm_per_m'), &
      entry_t(ride, 'side_view_arm_length_mm'), entry_t(ride, 'side_view_arm_angle_deg'), &
      entry_t(ride, 'front_view_arm_length_mm'), entry_t(ride, 'front_view_arm_angle_deg'), &
      entry_t(roll, 'wheel roll steer', 'roll', slope), entry_t(roll, 'wheel roll camber', 'roll', slope), &
      entry_t(roll, 'camber relative to road in roll', 'roll', slope), entry_t(roll, 'wheel roll caster', 'roll', slope), &
      entry_t(roll, 'wheel load in roll', 'roll', slope), entry_t(roll, 'roll rate', 'roll', slope), &
      entry_t(comply, 'lateral deflection', lateral, in_phase), entry_t(comply, 'lateral force steer', lateral, in_phase), &
      entry_t(comply, 'lateral force camber', lateral, in_phase), entry_t(comply, 'lateral deflection', lateral, anti_phase), &
      entry_t(comply, 'lateral force steer', lateral, anti_phase), entry_t(comply, 'lateral force camber', lateral, anti_phase), &
      entry_t(comply, 'aligning torque steer', torque, in_phase), entry_t(comply, 'aligning torque camber', torque, in_phase), &
      entry_t(comply, 'aligning torque steer', torque, anti_phase), entry_t(comply, 'braking deflection', 'braking', slope), &
      entry_t(comply, 'braking steer', 'braking', slope), entry_t(comply, 'braking caster', 'braking', slope), &
      entry_t(comply, 'traction deflection', 'traction', slope), entry_t(comply, 'traction steer', 'traction', slope), &
      entry_t(comply, 'traction caster', 'traction', slope), entry_t(held, 'lateral_in_load_held_deflection_mm_per_kn'), &
      entry_t(held, 'lateral_in_height_held_deflection_mm_per_kn'), entry_t(held, 'lateral_in_load_held_steer_deg_per_kn'), &
      entry_t(held, 'lateral_in_height_held_steer_deg_per_kn'), entry_t(held, 'lateral_in_load_held_camber_deg_per_kn'), &
      entry_t(held, 'lateral_in_height_held_camber_deg_per_kn'), entry_t(held, 'aligning_in_load_held_steer_deg_per_100nm'), &
      entry_t(held, 'aligning_in_height_held_steer_deg_per_100nm'), entry_t(held, 'braking_load_held_deflection_mm_per_kn'), &
      entry_t(held, 'braking_height_held_deflection_mm_per_kn'), entry_t(held, 'braking_load_held_steer_deg_per_kn'), &
      entry_t(held, 'braking_height_held_steer_deg_per_kn'), entry_t(held, 'traction_load_held_rotation_y_deg_per_kn'), &
      entry_t(held, 'lateral_in_jacking_n_per_kn'), entry_t(elastic, 'instant_caster_deg'), &
      entry_t(elastic, 'instant_kingpin_inclination_deg'), entry_t(elastic, 'instant_scrub_radius_mm'), &
      entry_t(elastic, 'instant_caster_trail_mm'), entry_t(anti, 'anti_dive_percent'), entry_t(anti, 'anti_lift_drive_percent'), &
      entry_t(anti, 'anti_lift_brake_percent'), entry_t(anti, 'anti_squat_percent'), entry_t(anti, 'brake_dive_mm_per_g'), &
      entry_t(anti, 'drive_lift_mm_per_g'), entry_t(anti, 'brake_lift_mm_per_g'), entry_t(anti, 'drive_squat_mm_per_g'), &
      entry_t(steer, 'steering_ratio'), entry_t(steer, 'steer per steering input', 'steering', slope), &
      entry_t(steer, 'steer per steering wheel', 'steering', slope), &
      entry_t(steer, 'steer_deg', 'steering', largest, 'maximum steer to the left'), &
      entry_t(steer, 'steer_deg', 'steering', least, 'maximum steer to the right'), &
      entry_t(steer, 'ackermann_percent', 'steering', largest, 'maximum Ackermann'), &
      entry_t(steer, 'turning_circle_m', 'steering', least, 'minimum turning circle'), &
      entry_t(steer, 'curb_to_curb_m', 'steering', least, 'minimum turning circle, curb to curb'), &
      entry_t(steer, 'wall_to_wall_m', 'steering', least, 'minimum turning circle, wall to wall'), &
      entry_t(steer, 'steer_camber_deg_per_deg'), entry_t(steer, 'steer camber', 'steering', slope)]

contains

   !> All key numbers that the tests provide.
   subroutine key_numbers(tests, gradients, numbers)
      type(test_result_t), intent(in) :: tests(:)
      type(gradient_t), intent(in) :: gradients(:)
      type(key_number_t), allocatable, intent(out) :: numbers(:)
      type(key_number_t) :: number
      type(entry_t) :: entry
      logical :: is_steered, is_pair, is_there
      integer :: k

      allocate (numbers(0))
      is_steered = any([(column_index(tests(k)%table, 'steering_ratio') > 0, k=1, size(tests))])
      is_pair = any([(size(tests(k)%prefixes) > 1, k=1, size(tests))])
      do k = 1, size(entries)
         entry = entries(k)
         if (index(entry%name, instant) == 1 .and. (entry%group == elastic .eqv. is_steered)) cycle
         if (entry%how >= slope) then
            call from_gradients(tests, gradients, entry, number, is_there)
         else
            call from_tables(tests, entry, is_steered, number, is_there)
         end if
         if (.not. is_there) cycle
         if (.not. is_pair) then
            number%quantity = without_phase(number%quantity)
            number%sign = without_phase(number%sign)
         end if
         call append(number, numbers)
      end do
      call place_numbers(tests, numbers)
   end subroutine key_numbers

   !> A gradient of the first test of the kind and phase.
   subroutine from_gradients(tests, gradients, entry, number, is_there)
      type(test_result_t), intent(in) :: tests(:)
      type(gradient_t), intent(in) :: gradients(:)
      type(entry_t), intent(in) :: entry
      type(key_number_t), intent(out) :: number
      logical, intent(out) :: is_there
      integer :: t, k

      is_there = .false.
      call new_number(trim(entry%group), trim(entry%name)//trim(phases(entry%how))//fitted, '', '', number)
      do t = 1, size(tests)
         if (tests(t)%kind /= entry%kind) cycle
         if (entry%how > slope .and. (tests(t)%is_anti .neqv. entry%how == anti_phase)) cycle
         do k = 1, size(gradients)
            if (gradients(k)%test /= tests(t)%name .or. gradients(k)%quantity /= trim(entry%name)//fitted) cycle
            is_there = .true.
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
   subroutine from_tables(tests, entry, is_steered, number, is_there)
      type(test_result_t), intent(in) :: tests(:)
      type(entry_t), intent(in) :: entry
      logical, intent(in) :: is_steered                 !! the instant axis is that of the steering, not of the elasticity
      type(key_number_t), intent(out) :: number
      logical, intent(out) :: is_there
      type(quantity_t) :: quantity
      integer :: t, wheel, place, at
      real(wp) :: value

      quantity = quantity_named(entry%name)
      if (entry%how == at_design) then
         quantity%title(1:1) = achar(iachar(quantity%title(1:1)) + 32)
         at = index(quantity%title, instant)
         if (at > 0 .and. .not. is_steered) quantity%title(at:at + len(instant) - 1) = 'elastic'
      else
         quantity%title = entry%title
         quantity%sign = 'over the test'
      end if
      call new_number(trim(entry%group), trim(quantity%title), unit_text(unit_of(trim(entry%name))), trim(quantity%sign), number)
      is_there = .false.
      do t = 1, size(tests)
         if (entry%kind /= '' .and. tests(t)%kind /= entry%kind) cycle
         do wheel = 1, size(tests(t)%prefixes)
            place = column_index(tests(t)%table, trim(tests(t)%prefixes(wheel))//entry%name)
            if (place == 0) cycle
            value = value_of(tests(t), place, entry%how)
            if (.not. ieee_is_finite(value)) cycle
            is_there = .true.
            call set_value(number, tests(t), wheel, value)
         end do
         place = column_index(tests(t)%table, entry%name)
         if (.not. is_there .and. place > 0) then
            number%left = value_of(tests(t), place, entry%how)
            is_there = ieee_is_finite(number%left)
            number%is_of_axle = size(tests(t)%prefixes) > 1
         end if
         if (is_there) return
      end do
   end subroutine from_tables

   !> A column at design, or its maximum or minimum over the converged states; not a number if there is none.
   pure real(wp) function value_of(test, place, how) result(value)
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: place, how
      integer :: row

      value = nothing()
      if (how == at_design) then
         row = design_row(test%table)
         if (row > 0) value = test%table%values(place, row)
      else if (any(is_good(test, place))) then
         if (how == largest) value = maxval(test%table%values(place, :), mask=is_good(test, place))
         if (how == least) value = minval(test%table%values(place, :), mask=is_good(test, place))
      end if
   end function value_of

end module ek_key_numbers
