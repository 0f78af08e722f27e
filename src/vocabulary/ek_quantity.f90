!> The quantities of the results: name, unit, requirements on the model, title, sign, least span of a chart.
!>
!> Rows are in the order of the columns in the table of results, section by section. The kernel of a section returns the values in
!> SI, in the same order: ek_state_columns (wheel_position, steer_axis), ek_kandc_columns (wheel_now to of_rack) with
!> ek_wheel_columns and ek_geometry_columns. A section is computed as a whole, and only if one of its columns is requested. A new
!> quantity needs a row here and a value at the same position in the kernel; the unit is the end of the name. Headings, charts, key
!> numbers and reserved names follow from the row. input/QUANTITIES.md defines the quantities.
module ek_quantity
   use ek_kinds, only: wp, degree, millimetre
   implicit none(type, external)
   private
   public :: name_length, quantity_t, quantity_named, needs_rate, held_name, label_of, without_phase, column_of_stem
   public :: unit_of, unit_text, unit_ending, unit_size, slope_unit, head_with_unit

   integer, parameter :: name_length = 192    !! longest column name: two names of a deck (63 letters each) and their suffixes

   type :: quantity_t
      character(name_length) :: name = ''    !! column without the wheel's prefix; '*' stands for load_held and height_held
      integer :: needs = 0                   !! sum of the conditions below
      character(name_length) :: title = ''   !! as long as a name: a column without a title has its name
      character(56) :: sign = ''      !! meaning of a positive value, or a condition
      real(wp) :: span = 0.0_wp       !! least span of a chart, in the unit of the column; smaller spans are drawn flat; 0: no chart
   end type quantity_t

   ! Conditions: without one of them the model has no such column; without a known matrix the value is not a number. A quantity with
   ! `rate` depends on the rates of the springs that carry the wheels; if nothing carries the wheels, its value is not a number.
   ! With '*' in its name, this holds for load_held, and for height_held if forces deform the model
   integer, parameter, public :: matrix = 1, pair = 2, tyres = 4, axis = 8, rack = 16, ratio = 32, car = 64, front = 128, &
      rear = 256, mass = 512, sprung = 1024, width = 2048, corner = 4096, rate = 8192
   integer, parameter :: turning = pair + car + rack, own = matrix + pair, shod = matrix + tyres + rate, steered = matrix + axis, &
      soft = matrix + rate, both = own + rate, soft_axis = steered + rate

   real(wp), parameter :: fine = 0.05_wp, middle = 1.0_wp, wide = 10.0_wp
   character(*), parameter :: inward = '+ top inward', outward = '+ top outward', rearward = '+ top rearward', &
      right = '+ contact point moves with the force', to_left = '+ to the left', under = ' under a force to the right', &
      in_phase = ', in phase, *', at_centre = 'at the wheel centre', body_down = '+ body moves down', &
      body_up = '+ body moves up', shortest = 'shortest distance'

   type(quantity_t), parameter, public :: wheel_position(*) = [ &
      quantity_t('wheel_travel_mm', 0, 'Wheel travel', '+ bump', middle), &
      quantity_t('toe_deg', 0, 'Toe', '+ front edge inward', fine), &
      quantity_t('camber_deg', 0, 'Camber', outward, fine), &
      quantity_t('track_change_mm', 0, 'Half-track change', 'contact point, + outward', middle), &
      quantity_t('wheelbase_change_mm', 0, 'Wheelbase change', 'contact point, + rearward', middle), &
      quantity_t('wheel_centre_x_mm', 0, 'Wheel centre, longitudinal', 'x of the deck', middle), &
      quantity_t('wheel_centre_y_mm'), quantity_t('wheel_centre_z_mm'), &
      quantity_t('contact_patch_x_mm'), quantity_t('contact_patch_y_mm'), quantity_t('contact_patch_z_mm')]

   type(quantity_t), parameter, public :: steer_axis(*) = [ &
      quantity_t('caster_deg', axis, 'Caster', rearward, fine), &
      quantity_t('kingpin_inclination_deg', axis, 'Kingpin inclination', inward, fine), &
      quantity_t('scrub_radius_mm', axis, 'Scrub radius', '+ axis meets the ground inboard of the contact point', middle), &
      quantity_t('caster_trail_mm', axis, 'Mechanical trail', '+ axis meets the ground ahead of the contact point', middle), &
      quantity_t('spindle_length_mm', axis, 'Kingpin offset at the wheel centre', '+ wheel centre outboard of the axis', middle), &
      quantity_t('spindle_offset_mm', axis, 'Caster offset at the wheel centre', '+ wheel centre aft of the axis')]

   type(quantity_t), parameter, public :: wheel_now(*) = [ &
      quantity_t('steer_deg', 0, 'Steer', to_left, fine), &
      quantity_t('inclination_deg', pair, 'Camber relative to the road', outward, fine)]

   type(quantity_t), parameter, public :: wheel_load(*) = [ &
      quantity_t('vertical_force_n', rate, 'Wheel load', 'ground on wheel', wide)]

   type(quantity_t), parameter, public :: instant_axis(*) = [ &
      quantity_t('instant_caster_deg', matrix, 'Caster, instant axis', rearward, fine), &
      quantity_t('instant_kingpin_inclination_deg', matrix, 'Kingpin inclination, instant axis', inward, fine), &
      quantity_t('instant_scrub_radius_mm', matrix, 'Scrub radius, instant axis', '+ inboard of the contact point', middle), &
      quantity_t('instant_caster_trail_mm', matrix, 'Mechanical trail, instant axis', '+ ahead of the contact point', middle), &
      quantity_t('instant_spindle_length_mm', matrix), quantity_t('instant_spindle_offset_mm', matrix)]

   type(quantity_t), parameter, public :: wheel_rates(*) = [ &
      quantity_t('wheel_rate_n_per_mm', soft, 'Wheel rate', 'wheels in parallel travel', middle), &
      quantity_t('single_wheel_rate_load_held_n_per_mm', both), quantity_t('single_wheel_rate_height_held_n_per_mm', both), &
      quantity_t('ride_rate_n_per_mm', shod, 'Ride rate', 'with the tyre', middle), &
      quantity_t('hop_rate_n_per_mm', shod, 'Hop rate', 'tyre in parallel')]

   type(quantity_t), parameter, public :: wheel_bump(*) = [ &
      quantity_t('bump_steer_deg_per_m', matrix, 'Bump steer, local slope', '+ to the left in bump', middle), &
      quantity_t('bump_camber_deg_per_m', matrix), quantity_t('bump_caster_deg_per_m', steered), &
      quantity_t('bump_toe_deg_per_m', matrix), quantity_t('bump_rotation_x_deg_per_m', matrix), &
      quantity_t('bump_rotation_y_deg_per_m', matrix), quantity_t('bump_rotation_z_deg_per_m', matrix)]

   type(quantity_t), parameter, public :: wheel_roll(*) = [ &
      quantity_t('roll_steer_deg_per_deg', shod + pair, 'Roll steer with tyres, local slope', '', 0.01_wp), &
      quantity_t('roll_camber_deg_per_deg', shod + pair), quantity_t('roll_caster_deg_per_deg', shod + pair + axis), &
      quantity_t('roll_steer_percent', shod + pair), quantity_t('roll_rotation_x_deg_per_deg', shod + pair), &
      quantity_t('roll_rotation_y_deg_per_deg', shod + pair), quantity_t('roll_rotation_z_deg_per_deg', shod + pair), &
      quantity_t('wheel_roll_steer_deg_per_deg', own), quantity_t('wheel_roll_camber_deg_per_deg', own), &
      quantity_t('wheel_roll_caster_deg_per_deg', own + axis), quantity_t('wheel_roll_steer_percent', own), &
      quantity_t('wheel_roll_rotation_x_deg_per_deg', own), quantity_t('wheel_roll_rotation_y_deg_per_deg', own), &
      quantity_t('wheel_roll_rotation_z_deg_per_deg', own)]

   type(quantity_t), parameter, public :: swing_arms(*) = [ &
      quantity_t('side_view_arm_length_mm', matrix, 'Side-view swing arm length', '', wide), &
      quantity_t('side_view_arm_angle_deg', matrix, 'Side-view swing arm angle', '', fine), &
      quantity_t('side_view_arm_centre_x_mm', matrix), quantity_t('side_view_arm_centre_z_mm', matrix), &
      quantity_t('front_view_arm_length_mm', matrix, 'Front-view swing arm length', '', wide), &
      quantity_t('front_view_arm_angle_deg', matrix, 'Front-view swing arm angle', '', fine), &
      quantity_t('front_view_arm_centre_y_mm', matrix), quantity_t('front_view_arm_centre_z_mm', matrix)]

   ! twice: load_held: constant vertical forces; height_held: constant heights of the wheel centres
   type(quantity_t), parameter, public :: wheel_forces(*) = [ &
      quantity_t('lateral_in_*_deflection_mm_per_kn', soft, 'Lateral deflection'//in_phase, right, 0.02_wp), &
      quantity_t('lateral_in_*_centre_deflection_mm_per_kn', soft), &
      quantity_t('lateral_in_*_steer_deg_per_kn', soft, 'Lateral force steer'//in_phase, to_left//under, 0.002_wp), &
      quantity_t('lateral_in_*_camber_deg_per_kn', soft, 'Lateral force camber'//in_phase, outward//under, 0.002_wp), &
      quantity_t('lateral_in_trail_*_deflection_mm_per_kn', soft), &
      quantity_t('lateral_in_trail_*_centre_deflection_mm_per_kn', soft), &
      quantity_t('lateral_in_trail_*_steer_deg_per_kn', soft), quantity_t('lateral_in_trail_*_camber_deg_per_kn', soft), &
      quantity_t('aligning_in_*_steer_deg_per_100nm', soft, 'Aligning torque steer'//in_phase, &
      '+ to the left under a torque to the left'), &
      quantity_t('aligning_in_*_camber_deg_per_100nm', soft), &
      quantity_t('lateral_anti_*_deflection_mm_per_kn', both), quantity_t('lateral_anti_*_centre_deflection_mm_per_kn', both), &
      quantity_t('lateral_anti_*_steer_deg_per_kn', both), quantity_t('lateral_anti_*_camber_deg_per_kn', both), &
      quantity_t('lateral_anti_trail_*_deflection_mm_per_kn', both), &
      quantity_t('lateral_anti_trail_*_centre_deflection_mm_per_kn', both), &
      quantity_t('lateral_anti_trail_*_steer_deg_per_kn', both), quantity_t('lateral_anti_trail_*_camber_deg_per_kn', both), &
      quantity_t('aligning_anti_*_steer_deg_per_100nm', both), quantity_t('aligning_anti_*_camber_deg_per_100nm', both), &
      quantity_t('braking_*_deflection_mm_per_kn', soft, 'Braking deflection, *', '+ contact point moves rearward'), &
      quantity_t('braking_*_steer_deg_per_kn', soft, 'Braking steer, *', to_left), &
      quantity_t('braking_*_camber_deg_per_kn', soft), quantity_t('braking_*_caster_deg_per_kn', soft_axis), &
      quantity_t('braking_*_toe_deg_per_kn', soft), quantity_t('braking_*_rotation_x_deg_per_kn', soft), &
      quantity_t('braking_*_rotation_y_deg_per_kn', soft), quantity_t('braking_*_rotation_z_deg_per_kn', soft), &
      quantity_t('braking_*_centre_deflection_mm_per_kn', soft), quantity_t('traction_*_deflection_mm_per_kn', soft), &
      quantity_t('traction_*_steer_deg_per_kn', soft), quantity_t('traction_*_camber_deg_per_kn', soft), &
      quantity_t('traction_*_caster_deg_per_kn', soft_axis), quantity_t('traction_*_toe_deg_per_kn', soft), &
      quantity_t('traction_*_rotation_x_deg_per_kn', soft), &
      quantity_t('traction_*_rotation_y_deg_per_kn', soft, 'Traction wind-up, *', 'rotation of the carrier about y'), &
      quantity_t('traction_*_rotation_z_deg_per_kn', soft)]

   type(quantity_t), parameter, public :: wheel_jacking(*) = [ &
      quantity_t('lateral_in_jacking_n_per_kn', own, 'Jacking, in phase', '+ the ground pushes up'//under), &
      quantity_t('lateral_anti_jacking_n_per_kn', own)]

   type(quantity_t), parameter, public :: wheel_stiffness(*) = [ &
      quantity_t('fore_aft_stiffness_n_per_mm', soft, 'Fore-aft stiffness', at_centre), &
      quantity_t('lateral_stiffness_n_per_mm', soft, 'Lateral stiffness', at_centre), &
      quantity_t('vertical_stiffness_n_per_mm', soft, 'Vertical stiffness', at_centre), &
      quantity_t('rotational_stiffness_x_nm_per_deg', soft), quantity_t('rotational_stiffness_y_nm_per_deg', soft), &
      quantity_t('rotational_stiffness_z_nm_per_deg', soft)]

   type(quantity_t), parameter, public :: wheel_pitch(*) = [ &
      quantity_t('anti_dive_percent', matrix + front, 'Anti-dive', 'braking, front', middle), &
      quantity_t('anti_lift_drive_percent', matrix + front, 'Anti-lift, drive', 'drive, front', middle), &
      quantity_t('anti_lift_brake_percent', matrix + rear, 'Anti-lift, braking', 'braking, rear', middle), &
      quantity_t('anti_squat_percent', matrix + rear, 'Anti-squat', 'drive, rear', middle), &
      quantity_t('brake_dive_mm_per_g', soft + front + mass, 'Dive, braking', body_down), &
      quantity_t('drive_lift_mm_per_g', soft + front + mass, 'Lift, drive', body_up), &
      quantity_t('brake_lift_mm_per_g', soft + rear + mass, 'Lift, braking', body_up), &
      quantity_t('drive_squat_mm_per_g', soft + rear + mass, 'Squat, drive', body_down)]

   type(quantity_t), parameter, public :: axle_rates(*) = [ &
      quantity_t('suspension_roll_rate_nm_per_deg', both, 'Suspension roll rate', '', wide), &
      quantity_t('total_roll_rate_nm_per_deg', both + tyres, 'Total roll rate', 'with the tyres', wide), &
      quantity_t('tramp_rate_nm_per_deg', both + tyres, 'Tramp rate', 'tyres in parallel')]

   type(quantity_t), parameter, public :: axle_now(*) = [ &
      quantity_t('roll_moment_nm', pair + rate, 'Roll moment', '+ left wheel loaded', wide), quantity_t('axle_roll_deg', pair)]

   type(quantity_t), parameter, public :: roll_centres(*) = [ &
      quantity_t('roll_centre_y_mm', own, 'Roll centre, lateral', 'y of the deck', middle), &
      quantity_t('roll_centre_z_mm', own, 'Roll centre, vertical', 'z of the deck', middle), &
      quantity_t('roll_centre_height_mm', own, 'Roll centre height', '+ above the ground', middle), &
      quantity_t('roll_centre_with_tyres_y_mm', both + tyres), quantity_t('roll_centre_with_tyres_height_mm', both + tyres), &
      quantity_t('force_roll_centre_height_mm', own, 'Force-based roll centre height', '+ above the ground')]

   type(quantity_t), parameter, public :: of_turn(*) = [ &
      quantity_t('turning_circle_m', turning, 'Turning circle', '', middle), &
      quantity_t('ackermann_percent', turning, 'Ackermann', '100: wheels roll about one point', middle), &
      quantity_t('ackermann_error_deg', turning, 'Ackermann error', '', fine)]

   type(quantity_t), parameter, public :: of_steering(*) = [ &
      quantity_t('steering_ratio', matrix + rack + ratio, 'Steering ratio', 'steering wheel over road wheel', fine), &
      quantity_t('steering_wheel_deg', matrix + rack + ratio, 'Steering wheel', '+ left', middle)]

   type(quantity_t), parameter, public :: wheel_axis(*) = [ &
      quantity_t('side_view_angle_deg', 0, 'Side-view angle', rearward, fine), &
      quantity_t('centre_axis_distance_mm', axis, 'Distance of the steering axis, wheel centre', shortest), &
      quantity_t('patch_axis_distance_mm', axis, 'Distance of the steering axis, contact point', shortest), &
      quantity_t('along_spindle_length_mm', axis, 'Kingpin offset, along the spin axis', '+ wheel centre outboard'), &
      quantity_t('across_spindle_offset_mm', axis, 'Caster offset, across the spin axis', '+ spin axis aft of the steering axis'), &
      quantity_t('spin_axis_x'), quantity_t('spin_axis_y'), quantity_t('spin_axis_z')]

   type(quantity_t), parameter, public :: instant_distances(*) = [ &
      quantity_t('instant_centre_axis_distance_mm', matrix), quantity_t('instant_patch_axis_distance_mm', matrix), &
      quantity_t('instant_along_spindle_length_mm', matrix), quantity_t('instant_across_spindle_offset_mm', matrix)]

   type(quantity_t), parameter, public :: wheel_slopes(*) = [ &
      quantity_t('recession_gradient_mm_per_m', matrix, 'Recession gradient', '+ rearward in bump', middle), &
      quantity_t('steer_camber_deg_per_deg', matrix + rack, 'Camber per steer', '+ top outward, steer to the left', 0.01_wp), &
      quantity_t('ride_frequency_hz', soft + sprung, 'Ride frequency', 'ride rate; sprung mass or whole wheel load', 0.05_wp)]

   type(quantity_t), parameter, public :: axle_geometry(*) = [ &
      quantity_t('total_track_mm', pair, 'Total track', 'distance of the contact points', middle), &
      quantity_t('total_track_change_mm', pair), quantity_t('ideal_outer_steer_deg', turning), &
      quantity_t('outer_steer_error_deg', turning, 'Deviation of the outer wheel', '+ steers more than ideal', fine), &
      quantity_t('curb_to_curb_m', turning + width, 'Turning circle, curb to curb', '', middle), &
      quantity_t('wall_to_wall_m', turning + corner, 'Turning circle, wall to wall', '', middle)]

   type(quantity_t), parameter, public :: of_rack(*) = [ &
      quantity_t('steering_rack_force_n', rack + rate, 'Rack force', 'reaction of the driver', wide)]

   type(quantity_t), parameter, public :: of_state(*) = [quantity_t('state'), quantity_t('factor'), quantity_t('converged'), &
      quantity_t('stable'), quantity_t('near_singular'), quantity_t('iterations'), quantity_t('constraint_error')]

   type(quantity_t), parameter, public :: all_quantities(*) = [wheel_position, steer_axis, wheel_now, wheel_load, instant_axis, &
      wheel_rates, wheel_bump, wheel_roll, swing_arms, wheel_forces, wheel_jacking, wheel_stiffness, wheel_pitch, axle_rates, &
      axle_now, roll_centres, of_turn, of_steering, wheel_axis, instant_distances, wheel_slopes, axle_geometry, of_rack, of_state]

   character(*), parameter :: conditions(2) = [character(11) :: 'load_held', 'height_held']

   !> Suffixes of the columns of elements, measures and joints, after the name in the deck.
   character(*), parameter, public :: element_endings(*) = [character(15) :: '_mm', '_deg', '_cosine', '_length_mm', '_force_n', &
      '_angle_deg', '_moment_nm', '_motion_ratio', '_gap_mm', '_travel_left_mm', '_reaction_n', '_reaction_nm', '_fx_n', '_mx_nm']

   !> A unit as the suffix of a column name and as a label, with its SI value.
   type :: unit_t
      character(13) :: ending
      character(12) :: text
      real(wp) :: size = 1.0_wp
   end type unit_t

   type(unit_t), parameter :: units(*) = [unit_t('mm', 'mm', millimetre), unit_t('deg', 'deg', degree), unit_t('n', 'N'), &
      unit_t('nm', 'N m'), unit_t('m', 'm'), unit_t('percent', '%'), unit_t('hz', 'Hz'), unit_t('n_per_mm', 'N/mm', 1.0e3_wp), &
      unit_t('nm_per_deg', 'N m/deg', 1.0_wp/degree), unit_t('deg_per_m', 'deg/m', degree), unit_t('deg_per_deg', 'deg/deg'), &
      unit_t('deg_per_kn', 'deg/kN', degree/1.0e3_wp), unit_t('mm_per_kn', 'mm/kN', 1.0e-6_wp), &
      unit_t('deg_per_100nm', 'deg/100 N m', degree/100.0_wp), unit_t('n_per_kn', 'N/kN', 1.0e-3_wp), &
      unit_t('mm_per_m', 'mm/m'), unit_t('mm_per_g', 'mm/g', millimetre), unit_t('mm_per_mm', 'mm/mm'), &
      unit_t('deg_per_mm', 'deg/mm'), unit_t('n_per_deg', 'N/deg')]

contains

   !> The quantity of a column. If no title is declared, the column name is the title.
   pure type(quantity_t) function quantity_named(name) result(quantity)
      character(*), intent(in) :: name
      integer :: k, c

      do k = 1, size(all_quantities)
         if (index(name, all_quantities(k)%name(:1)) /= 1) cycle
         do c = 1, size(conditions)
            if (held_name(all_quantities(k)%name, c) /= name) cycle
            quantity = all_quantities(k)
            quantity%name = name
            if (index(quantity%title, '*') > 0) quantity%title = &
               quantity%title(:index(quantity%title, '*') - 1)//trim(merge('load held  ', 'height held', c == 1))
            if (quantity%title /= '') return
         end do
      end do
      quantity%name = name
      quantity%title = name
   end function quantity_named

   !> Whether a column depends on the rates of the springs that carry the wheels.
   pure logical function needs_rate(name)
      character(*), intent(in) :: name      !! column without the wheel's prefix
      integer :: k

      needs_rate = .false.
      do k = 1, size(all_quantities)
         if (iand(all_quantities(k)%needs, rate) /= 0) needs_rate = needs_rate .or. held_name(all_quantities(k)%name, 1) == name
      end do
   end function needs_rate

   !> A name in which '*' is replaced by the condition: load_held (1) or height_held (2).
   pure function held_name(name, condition) result(full)
      character(*), intent(in) :: name
      integer, intent(in) :: condition
      character(:), allocatable :: full
      integer :: star

      full = trim(name)
      star = index(name, '*')
      if (star > 0) full = name(:star - 1)//trim(conditions(condition))//trim(name(star + 1:))
   end function held_name

   !> Label of an axis, with unit and sign convention.
   pure function label_of(quantity) result(label)
      type(quantity_t), intent(in) :: quantity
      character(:), allocatable :: label
      label = unit_text(unit_of(trim(quantity%name)))
      if (quantity%sign /= '') label = label//'    ('//trim(quantity%sign)//')'
   end function label_of

   !> A title or label for a single wheel, without its note on the phase of two wheels.
   pure function without_phase(text) result(words)
      character(*), intent(in) :: text
      character(:), allocatable :: words
      ! the longest first: each contains parts of the next ones
      character(*), parameter :: phases(*) = [character(31) :: '    (wheels in parallel travel)', &
         'wheels in parallel travel', ', in phase']
      integer :: k, at, length

      words = trim(text)
      do k = 1, size(phases)
         length = len_trim(phases(k))
         at = index(words, phases(k) (:length))
         if (at > 0) words = words(:at - 1)//words(at + length:)
      end do
   end function without_phase

   !> The unit at the end of a column name: 'mm', 'n_per_mm'; '' if the name has no unit.
   pure function unit_of(column) result(unit)
      character(*), intent(in) :: column
      character(:), allocatable :: unit
      integer :: mark

      mark = index(column, '_per_')
      if (mark > 0) then
         unit = column(index(column(:mark - 1), '_', back=.true.) + 1:)
      else
         unit = column(index(column, '_', back=.true.) + 1:)
         if (.not. any(units%ending == unit)) unit = ''
      end if
   end function unit_of

   !> A unit as a label: 'N/mm' for 'n_per_mm'; '–' for no unit and for an unknown unit.
   pure function unit_text(unit) result(text)
      character(*), intent(in) :: unit
      character(:), allocatable :: text
      integer :: k

      k = findloc(units%ending, unit, dim=1)
      text = '–'
      if (k > 0) text = trim(units(k)%text)
   end function unit_text

   !> The suffix of the column names that have a unit: 'n_per_mm' for 'N/mm'; '' for an unknown unit.
   pure function unit_ending(text) result(ending)
      character(*), intent(in) :: text              !! unit as a label
      character(:), allocatable :: ending
      integer :: k

      k = findloc(units%text, text, dim=1)
      ending = ''
      if (k > 0) ending = trim(units(k)%ending)
   end function unit_ending

   !> SI value of the unit of a column. The value is 1 for a column without a known unit, for %, mm/m, deg/deg and mm/mm, and for
   !> deg/mm and N/deg, which are not converted.
   pure real(wp) function unit_size(column) result(size_of)
      character(*), intent(in) :: column
      integer :: k

      k = findloc(units%ending, unit_of(column), dim=1)
      size_of = 1.0_wp
      if (k > 0) size_of = units(k)%size
   end function unit_size

   !> Finds the unit of a slope as the suffix of a column name, 'deg_per_m', and the factor that converts the slope from the units
   !> of its two columns. Angles over wheel travel are in deg/m. Slopes over a force are per kN, except slopes of a force. Slopes
   !> over a moment are per 100 N m, except slopes of a moment. All other slopes have the units of the columns.
   pure subroutine slope_unit(column, over, factor_unit, unit, factor)
      character(*), intent(in) :: column, over
      character(*), intent(in) :: factor_unit             !! unit of the column `factor`: 'mm', 'deg', 'N', 'N m', '-'
      character(:), allocatable, intent(out) :: unit
      real(wp), intent(out) :: factor
      character(:), allocatable :: upper, lower
      integer :: k

      upper = unit_of(column)
      lower = unit_of(over)
      if (over == 'factor') then
         k = findloc(units%text, factor_unit, dim=1)
         if (k > 0) lower = trim(units(k)%ending)
      end if
      factor = 1.0_wp
      if (lower == 'mm' .and. upper == 'deg' .and. index(over//' ', trim(wheel_position(1)%name)//' ') > 0) then
         lower = 'm'
         factor = 1.0e3_wp
      else if (lower == 'n' .and. upper /= 'n') then
         lower = 'kn'
         factor = 1.0e3_wp
      else if (lower == 'nm' .and. upper /= 'nm') then
         lower = '100nm'
         factor = 100.0_wp
      else if (lower == '') then
         lower = over
      end if
      unit = 'per_'//lower
      if (upper /= '') unit = upper//'_'//unit
   end subroutine slope_unit

   !> A column heading with a unit as suffix: 'seat_mm' for 'seat' and 'mm'. The heading 'seat_mm' is unchanged.
   pure function head_with_unit(name, ending) result(head)
      character(*), intent(in) :: name
      character(*), intent(in) :: ending             !! unit as in column names; '': no unit
      character(:), allocatable :: head
      integer :: at

      head = name
      if (ending == '') return
      at = len(name) - len(ending)
      if (at > 0) then
         if (name(at:) == '_'//ending) return
      end if
      head = name//'_'//ending
   end function head_with_unit

   !> The column of a quantity that an element, a measure or a joint with the name `stem` would also have; '' if there is none.
   pure function column_of_stem(stem) result(column)
      character(*), intent(in) :: stem      !! lower case, without left_ and right_
      character(:), allocatable :: column
      integer :: k

      column = ''
      if (len(stem) > len(all_quantities%name)) return
      do k = 1, size(all_quantities)
         if (all_quantities(k)%name(:len(stem)) /= stem) cycle
         column = trim(all_quantities(k)%name)
         if (column == stem .or. any(column == stem//element_endings)) return
      end do
      column = ''
   end function column_of_stem

end module ek_quantity
