!> The quantities of the results: name, unit, requirements on the model, title, sign, least span of a chart; and below them the
!> gradients, the key numbers and the charts in which they appear.
!>
!> Rows are in the order of the columns in the table of results, section by section. The kernel of a section returns the values in
!> SI, in the same order: ek_state_columns (wheel_position, steer_axis), ek_kandc_columns (wheel_now to of_rack) with
!> ek_wheel_columns and ek_geometry_columns. A section is computed as a whole, and only if one of its columns is requested. A new
!> quantity needs a row here and a value at the same position in the kernel; the unit is the end of the name (ek_unit_suffix).
!> Headings, labels and reserved names follow from the row. A gradient, a key number or a chart of the quantity is one more row in
!> this file. input/QUANTITIES.md defines the quantities.
module ek_quantity
   use ek_kinds, only: wp
   use ek_text, only: suggestion
   use ek_rig_test, only: rig_test_t, rig_test, of_travel, of_tilt, of_roll, of_steer, of_lateral, of_braking, of_traction, &
      of_aligning, of_vertical, of_table, of_grid
   use ek_unit_suffix, only: unit_of, unit_text, unit_ending, unit_size, slope_unit, head_with_unit
   implicit none(type, external)
   private
   public :: name_length, quantity_t, quantity_named, needs_rate, column_hint, held_name, label_of, without_phase
   public :: column_of_stem
   public :: gradient_row_t, number_t, charted
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
      together = ', in phase, *', at_centre = 'at the wheel centre', body_down = '+ body moves down', &
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
      quantity_t('lateral_in_*_deflection_mm_per_kn', soft, 'Lateral deflection'//together, right, 0.02_wp), &
      quantity_t('lateral_in_*_centre_deflection_mm_per_kn', soft), &
      quantity_t('lateral_in_*_steer_deg_per_kn', soft, 'Lateral force steer'//together, to_left//under, 0.002_wp), &
      quantity_t('lateral_in_*_camber_deg_per_kn', soft, 'Lateral force camber'//together, outward//under, 0.002_wp), &
      quantity_t('lateral_in_trail_*_deflection_mm_per_kn', soft), &
      quantity_t('lateral_in_trail_*_centre_deflection_mm_per_kn', soft), &
      quantity_t('lateral_in_trail_*_steer_deg_per_kn', soft), quantity_t('lateral_in_trail_*_camber_deg_per_kn', soft), &
      quantity_t('aligning_in_*_steer_deg_per_100nm', soft, 'Aligning torque steer'//together, &
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

   ! Where a quantity appears: gradients, key numbers, charts. The order on a page is that of these lists, not that of the columns

   !> Definition of a gradient, for the equation at the top of ek_gradient.
   type :: gradient_row_t
      integer :: set                      !! set of tests: of_travel, of_roll, …
      character(52) :: quantity = ''
      character(28) :: column = ''
      character(72) :: sign = ''
      character(1) :: y_turn = ' '        !! 's': times side (toe → steer); 'd': x of the deck, reported forward;
      !!                                     'i': outward, reported to the right; 'o': x is mirrored on the right wheel,
      !!                                     positive towards the side of each wheel
      character(18) :: over = ''          !! column of x; '': abscissa of the test, or `factor` in units of the case (N, N m, mm)
   end type gradient_row_t

   character(*), parameter :: in_bump = ' in bump', left_up = ' with the left wheel up', &
      left_torque = ' under a torque to the left', inner = ', inner wheel', force_up = ' under a force up', &
      toe_in = '+ front edge moves inward', top_out = '+ top moves outward', top_back = '+ top of the axis moves rearward', &
      left = '+ steers to the left'

   type(gradient_row_t), parameter, public :: gradient_rows(*) = [ &
      gradient_row_t(of_travel, 'bump toe', 'toe_deg', toe_in//in_bump), &
      gradient_row_t(of_travel, 'bump steer', 'toe_deg', left//in_bump, 's'), &
      gradient_row_t(of_travel, 'bump camber', 'camber_deg', top_out//in_bump), &
      gradient_row_t(of_travel, 'bump caster', 'caster_deg', top_back//in_bump), &
      gradient_row_t(of_travel, 'bump caster, instant axis', 'instant_caster_deg', top_back//in_bump), &
      gradient_row_t(of_travel, 'half-track change', 'track_change_mm', '+ contact point moves outward'//in_bump), &
      gradient_row_t(of_travel, 'wheelbase change', 'wheelbase_change_mm', '+ contact point moves rearward'//in_bump), &
      gradient_row_t(of_travel, 'wheel rate', 'vertical_force_n', '+ load increases'//in_bump), &
      gradient_row_t(of_travel, 'roll-centre height change', 'roll_centre_height_mm', '+ rises over the ground'//in_bump), &
      ! Per roll of the wheels relative to the body, positive with the left wheel up for both wheels, as the column axle_roll_deg;
      ! the columns wheel_roll_… of the matrix are the slopes at a state
      gradient_row_t(of_roll, 'wheel roll steer', 'toe_deg', left//left_up, 's'), &
      gradient_row_t(of_roll, 'wheel roll toe', 'toe_deg', toe_in//left_up), &
      gradient_row_t(of_roll, 'wheel roll camber', 'camber_deg', top_out//left_up), &
      gradient_row_t(of_roll, 'camber relative to road in roll', 'inclination_deg', top_out//' relative to the road'//left_up), &
      gradient_row_t(of_roll, 'wheel roll caster', 'caster_deg', top_back//left_up), &
      gradient_row_t(of_roll, 'wheel load in roll', 'vertical_force_n', '+ increases'//left_up), &
      gradient_row_t(of_roll, 'roll rate', 'roll_moment_nm', '+ restoring'), &
      gradient_row_t(of_lateral, 'lateral force steer', 'toe_deg', left//under, 's'), &
      gradient_row_t(of_lateral, 'lateral force camber', 'camber_deg', top_out//under), &
      gradient_row_t(of_lateral, 'lateral deflection', 'track_change_mm', '+ contact point moves with the force', 'i'), &
      gradient_row_t(of_aligning, 'aligning torque steer', 'toe_deg', left//left_torque, 's'), &
      gradient_row_t(of_aligning, 'aligning torque camber', 'camber_deg', top_out//left_torque), &
      gradient_row_t(of_braking, 'braking deflection', 'wheelbase_change_mm', '+ contact point moves rearward'), &
      gradient_row_t(of_braking, 'braking camber', 'camber_deg', top_out), &
      gradient_row_t(of_braking, 'braking steer', 'toe_deg', left, 's'), &
      gradient_row_t(of_braking, 'braking toe', 'toe_deg', toe_in), &
      gradient_row_t(of_braking, 'braking caster', 'caster_deg', top_back), &
      gradient_row_t(of_traction, 'traction deflection', 'wheel_centre_x_mm', '+ wheel centre moves forward', 'd'), &
      gradient_row_t(of_traction, 'traction camber', 'camber_deg', top_out), &
      gradient_row_t(of_traction, 'traction steer', 'toe_deg', left, 's'), &
      gradient_row_t(of_traction, 'traction toe', 'toe_deg', toe_in), &
      gradient_row_t(of_traction, 'traction caster', 'caster_deg', top_back), &
      gradient_row_t(of_steer, 'steer per steering wheel', 'toe_deg', '+ to the left', 's', 'steering_wheel_deg'), &
      gradient_row_t(of_steer, 'steer per steering input', 'toe_deg', '+ to the left', 's'), &
      gradient_row_t(of_steer, 'steer camber', 'camber_deg', top_out//inner, 'o'), &
      gradient_row_t(of_steer, 'steer caster', 'caster_deg', '+ top moves rearward'//inner, 'o'), &
      gradient_row_t(of_steer, 'scrub radius change', 'scrub_radius_mm', '+ increases'//inner, 'o'), &
      gradient_row_t(of_steer, 'caster trail change', 'caster_trail_mm', '+ increases'//inner, 'o'), &
      gradient_row_t(of_steer, 'wheel lift in steer', 'wheel_travel_mm', '+ wheel moves up'//inner, 'o'), &
      gradient_row_t(of_vertical, 'vertical deflection', 'wheel_travel_mm', '+ wheel moves up'//force_up), &
      gradient_row_t(of_vertical, 'vertical force toe', 'toe_deg', toe_in//force_up), &
      gradient_row_t(of_vertical, 'vertical force camber', 'camber_deg', top_out//force_up), &
      gradient_row_t(of_vertical, 'vertical force caster', 'caster_deg', '+ top moves rearward'//force_up)]

   !> The source of a key number: a column at design; its maximum or minimum over the test; a gradient, or a gradient with only
   !> in-phase or only anti-phase loads; a column where another column has a given value; the travel from design to the contact of a
   !> stop; the largest magnitude over all tests.
   integer, parameter, public :: at_design = 0, largest = 1, least = 2, slope = 3, in_phase = 4, anti_phase = 5, at_place = 6, &
      to_contact = 7, largest_of_all = 8

   !> One key number: its group, its column or gradient, and the way in which it is read.
   type :: number_t
      character(32) :: group = ''
      character(44) :: name = ''        !! name of a column, or of a gradient without the suffix ' (fitted)'
      character(15) :: kind = ''        !! kind of the test; '': any test that has the column
      integer :: how = at_design        !! source: at_design to anti_phase of ek_key_number
      character(38) :: title = ''       !! title of an extreme; '': the title of the column or gradient
   end type number_t

   character(*), parameter :: attitude = 'Attitude at design', rates = 'Rates', ride = 'Ride', roll = 'Roll', &
      comply = 'Compliance', held = 'Compliance at design', &
      anti = 'Anti-dive, anti-lift, anti-squat', steer = 'Steering', travel = 'parallel_travel', lateral = 'lateral_force', &
      torque = 'aligning_torque'
   character(*), parameter, public :: elastic_axis = 'Elastic steering axis'

   type(number_t), parameter, public :: number_rows(*) = [ &
      number_t(attitude, 'toe_deg'), number_t(attitude, 'camber_deg'), number_t(attitude, 'caster_deg'), &
      number_t(attitude, 'kingpin_inclination_deg'), number_t(attitude, 'scrub_radius_mm'), number_t(attitude, 'caster_trail_mm'), &
      number_t(attitude, 'spindle_length_mm'), number_t(attitude, 'spindle_offset_mm'), number_t(attitude, 'instant_caster_deg'), &
      number_t(attitude, 'instant_kingpin_inclination_deg'), number_t(attitude, 'instant_scrub_radius_mm'), &
      number_t(attitude, 'instant_caster_trail_mm'), number_t(attitude, 'centre_axis_distance_mm'), &
      number_t(attitude, 'patch_axis_distance_mm'), number_t(attitude, 'along_spindle_length_mm'), &
      number_t(attitude, 'across_spindle_offset_mm'), number_t(attitude, 'total_track_mm'), &
      number_t(attitude, 'vertical_force_n'), number_t(attitude, 'roll_centre_height_mm'), number_t(attitude, 'roll_centre_y_mm'), &
      number_t(attitude, 'force_roll_centre_height_mm'), number_t(rates, 'wheel_rate_n_per_mm'), &
      number_t(rates, 'wheel rate', travel, slope), number_t(rates, 'ride_rate_n_per_mm'), number_t(rates, 'ride_frequency_hz'), &
      number_t(rates, 'vertical deflection', 'vertical_force', slope), number_t(rates, 'suspension_roll_rate_nm_per_deg'), &
      number_t(rates, 'total_roll_rate_nm_per_deg'), number_t(rates, 'hop_rate_n_per_mm'), &
      number_t(rates, 'tramp_rate_nm_per_deg'), number_t(rates, 'fore_aft_stiffness_n_per_mm'), &
      number_t(rates, 'lateral_stiffness_n_per_mm'), number_t(rates, 'vertical_stiffness_n_per_mm'), &
      number_t(ride, 'bump steer', travel, slope), number_t(ride, 'bump toe', travel, slope), &
      number_t(ride, 'bump camber', travel, slope), number_t(ride, 'bump caster', travel, slope), &
      number_t(ride, 'half-track change', travel, slope), number_t(ride, 'wheelbase change', travel, slope), &
      number_t(ride, 'roll-centre height change', travel, slope), number_t(ride, 'recession_gradient_mm_per_m'), &
      number_t(ride, 'side_view_arm_length_mm'), number_t(ride, 'side_view_arm_angle_deg'), &
      number_t(ride, 'front_view_arm_length_mm'), number_t(ride, 'front_view_arm_angle_deg'), &
      number_t(roll, 'wheel roll steer', 'roll', slope), number_t(roll, 'wheel roll camber', 'roll', slope), &
      number_t(roll, 'camber relative to road in roll', 'roll', slope), number_t(roll, 'wheel roll caster', 'roll', slope), &
      number_t(roll, 'wheel load in roll', 'roll', slope), number_t(roll, 'roll rate', 'roll', slope), &
      number_t(comply, 'lateral deflection', lateral, in_phase), number_t(comply, 'lateral force steer', lateral, in_phase), &
      number_t(comply, 'lateral force camber', lateral, in_phase), number_t(comply, 'lateral deflection', lateral, anti_phase), &
      number_t(comply, 'lateral force steer', lateral, anti_phase), number_t(comply, 'lateral force camber', lateral, anti_phase), &
      number_t(comply, 'aligning torque steer', torque, in_phase), number_t(comply, 'aligning torque camber', torque, in_phase), &
      number_t(comply, 'aligning torque steer', torque, anti_phase), number_t(comply, 'braking deflection', 'braking', slope), &
      number_t(comply, 'braking steer', 'braking', slope), number_t(comply, 'braking caster', 'braking', slope), &
      number_t(comply, 'traction deflection', 'traction', slope), number_t(comply, 'traction steer', 'traction', slope), &
      number_t(comply, 'traction caster', 'traction', slope), number_t(held, 'lateral_in_load_held_deflection_mm_per_kn'), &
      number_t(held, 'lateral_in_height_held_deflection_mm_per_kn'), number_t(held, 'lateral_in_load_held_steer_deg_per_kn'), &
      number_t(held, 'lateral_in_height_held_steer_deg_per_kn'), number_t(held, 'lateral_in_load_held_camber_deg_per_kn'), &
      number_t(held, 'lateral_in_height_held_camber_deg_per_kn'), number_t(held, 'aligning_in_load_held_steer_deg_per_100nm'), &
      number_t(held, 'aligning_in_height_held_steer_deg_per_100nm'), number_t(held, 'braking_load_held_deflection_mm_per_kn'), &
      number_t(held, 'braking_height_held_deflection_mm_per_kn'), number_t(held, 'braking_load_held_steer_deg_per_kn'), &
      number_t(held, 'braking_height_held_steer_deg_per_kn'), number_t(held, 'traction_load_held_rotation_y_deg_per_kn'), &
      number_t(held, 'lateral_in_jacking_n_per_kn'), number_t(elastic_axis, 'instant_caster_deg'), &
      number_t(elastic_axis, 'instant_kingpin_inclination_deg'), number_t(elastic_axis, 'instant_scrub_radius_mm'), &
      number_t(elastic_axis, 'instant_caster_trail_mm'), number_t(anti, 'anti_dive_percent'), &
      number_t(anti, 'anti_lift_drive_percent'), number_t(anti, 'anti_lift_brake_percent'), number_t(anti, 'anti_squat_percent'), &
      number_t(anti, 'brake_dive_mm_per_g'), number_t(anti, 'drive_lift_mm_per_g'), &
      number_t(anti, 'brake_lift_mm_per_g'), number_t(anti, 'drive_squat_mm_per_g'), number_t(steer, 'steering_ratio'), &
      number_t(steer, 'steer per steering input', 'steering', slope), &
      number_t(steer, 'steer per steering wheel', 'steering', slope), &
      number_t(steer, 'steer_deg', 'steering', largest, 'maximum steer to the left'), &
      number_t(steer, 'steer_deg', 'steering', least, 'maximum steer to the right'), &
      number_t(steer, 'ackermann_percent', 'steering', largest, 'maximum Ackermann'), &
      number_t(steer, 'turning_circle_m', 'steering', least, 'minimum turning circle'), &
      number_t(steer, 'curb_to_curb_m', 'steering', least, 'minimum turning circle, curb to curb'), &
      number_t(steer, 'wall_to_wall_m', 'steering', least, 'minimum turning circle, wall to wall'), &
      number_t(steer, 'steer_camber_deg_per_deg'), number_t(steer, 'steer camber', 'steering', slope)]

   character(*), parameter :: conditions(2) = [character(11) :: 'load_held', 'height_held']

   !> Suffixes of the columns of elements, measures and joints, after the name in the deck.
   character(*), parameter, public :: element_endings(*) = [character(15) :: '_mm', '_deg', '_cosine', '_length_mm', '_force_n', &
      '_angle_deg', '_moment_nm', '_motion_ratio', '_gap_mm', '_travel_left_mm', '_reaction_n', '_reaction_nm', '_fx_n', '_mx_nm']

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
               quantity%title(:index(quantity%title, '*') - 1)//trim(merge('load constant  ', 'height constant', c == 1))
            if (quantity%title /= '') return
         end do
      end do
      quantity%name = name
      quantity%title = name
   end function quantity_named

   !> The columns drawn in the charts of a kind of test, in descending order of importance.
   pure function charted(kind) result(columns)
      character(*), intent(in) :: kind
      character(48), allocatable :: columns(:)
      type(rig_test_t) :: test

      test = rig_test(kind)
      select case (test%charts)
      case (of_roll)
         columns = [character(48) :: 'steer_deg', 'toe_deg', 'camber_deg', 'inclination_deg', 'caster_deg', &
            'track_change_mm', 'wheelbase_change_mm', 'vertical_force_n', 'roll_moment_nm', 'suspension_roll_rate_nm_per_deg', &
            'total_roll_rate_nm_per_deg', 'roll_centre_height_mm', 'roll_centre_y_mm', 'roll_steer_deg_per_deg', 'wheel_travel_mm']
      case (of_steer)
         columns = [character(48) :: 'steer_deg', 'toe_deg', 'ackermann_percent', 'ackermann_error_deg', 'camber_deg', &
            'caster_deg', 'kingpin_inclination_deg', 'scrub_radius_mm', 'caster_trail_mm', 'instant_scrub_radius_mm', &
            'instant_caster_trail_mm', 'steering_ratio', 'turning_circle_m', 'wheel_travel_mm', 'vertical_force_n', &
            'track_change_mm', 'wheelbase_change_mm', 'steer_camber_deg_per_deg', 'outer_steer_error_deg', 'curb_to_curb_m', &
            'wall_to_wall_m', 'steering_rack_force_n']
      case (of_lateral)
         columns = [character(48) :: 'steer_deg', 'toe_deg', 'camber_deg', 'track_change_mm', 'wheelbase_change_mm', &
            'caster_deg', 'wheel_travel_mm', 'vertical_force_n']
      case (of_aligning)
         columns = [character(48) :: 'steer_deg', 'toe_deg', 'camber_deg', 'caster_deg', 'track_change_mm', 'wheelbase_change_mm']
      case (of_braking, of_traction)
         columns = [character(48) :: 'wheelbase_change_mm', 'wheel_centre_x_mm', 'steer_deg', 'toe_deg', 'caster_deg', &
            'camber_deg', 'track_change_mm', 'wheel_travel_mm', 'vertical_force_n']
      case (of_vertical)
         columns = [character(48) :: 'wheel_travel_mm', 'toe_deg', 'camber_deg', 'track_change_mm', 'wheelbase_change_mm', &
            'caster_deg', 'wheel_rate_n_per_mm', 'roll_centre_height_mm', 'scrub_radius_mm', 'caster_trail_mm']
      case default
         columns = [character(48) :: 'toe_deg', 'camber_deg', 'track_change_mm', 'wheelbase_change_mm', 'caster_deg', &
            'kingpin_inclination_deg', 'vertical_force_n', 'wheel_rate_n_per_mm', 'ride_rate_n_per_mm', 'roll_centre_height_mm', &
            'scrub_radius_mm', 'caster_trail_mm', 'bump_steer_deg_per_m', 'side_view_arm_angle_deg', &
            'side_view_arm_length_mm', 'front_view_arm_length_mm', 'anti_dive_percent', 'anti_lift_brake_percent', &
            'anti_squat_percent', 'anti_lift_drive_percent', 'instant_caster_deg', 'instant_kingpin_inclination_deg', &
            'instant_scrub_radius_mm', 'instant_caster_trail_mm', 'lateral_in_load_held_deflection_mm_per_kn', &
            'lateral_in_load_held_steer_deg_per_kn', 'lateral_in_load_held_camber_deg_per_kn', 'side_view_angle_deg', &
            'recession_gradient_mm_per_m', 'ride_frequency_hz', 'total_track_mm']
         if (test%charts == of_tilt) columns = [character(48) :: columns(:13), &
            'suspension_roll_rate_nm_per_deg', 'roll_centre_y_mm']
         if (kind == 'other') columns = [character(48) :: 'steer_deg', columns]
         if (any(test%charts == [of_table, of_grid])) columns = [character(48) :: 'wheel_travel_mm', 'steer_deg', columns]
      end select
   end function charted

   !> Whether a column depends on the rates of the springs that carry the wheels.
   pure logical function needs_rate(name)
      character(*), intent(in) :: name      !! column without the wheel's prefix
      integer :: k

      needs_rate = .false.
      do k = 1, size(all_quantities)
         if (iand(all_quantities(k)%needs, rate) /= 0) needs_rate = needs_rate .or. held_name(all_quantities(k)%name, 1) == name
      end do
   end function needs_rate

   !> What follows a message about a missing column: the name for a wheel, what a quantity requires, or a similar name; '' otherwise.
   pure function column_hint(name, candidates, has_all) result(words)
      character(*), intent(in) :: name                     !! column, with or without 'left_' or 'right_'
      character(*), intent(in) :: candidates(:)            !! the columns that exist
      logical, intent(in), optional :: has_all             !! the case has quantities = 'all'
      character(:), allocatable :: words, bare

      bare = name(prefix_length(name) + 1:)
      words = ''
      if (any(candidates == bare)) words = bare
      if (any(candidates == 'left_'//bare)) words = 'left_'//bare
      if (words /= '' .and. words /= name) then
         words = " (did you mean '"//words//"'?)"
      else
         words = needs_text(bare, has_all)
         if (words == '') words = suggestion(name, candidates)
      end if
   end function column_hint

   !> The length of the wheel's prefix of a column, 'left_' or 'right_'; 0 without.
   pure integer function prefix_length(name) result(length)
      character(*), intent(in) :: name

      length = 0
      if (index(name, 'left_') == 1) length = len('left_')
      if (index(name, 'right_') == 1) length = len('right_')
   end function prefix_length

   !> What a model, or its case, must have for the column of a quantity: "(this column requires two wheels and quantities = 'all')";
   !> '' for a name that is no quantity.
   pure function needs_text(name, has_all) result(words)
      character(*), intent(in) :: name                     !! column without the wheel's prefix
      logical, intent(in), optional :: has_all             !! the case has quantities = 'all'
      character(:), allocatable :: words
      ! in the order of the conditions above; a matrix and rates are found if the others are there
      character(*), parameter :: parts(*) = [character(44) :: '', 'two wheels', 'a tyre_rate', 'a steer_axis', 'a rack', &
         'a ratio in &steering', '&axle with wheelbase and cg_height', "&axle with position = 'front'", &
         "&axle with position = 'rear'", 'a mass in &axle', 'a mass in &axle and a tyre_rate', 'a tyre_width', &
         'a front_overhang in &axle']
      integer :: k, b, needs, basic

      words = ''
      basic = size(wheel_position) + size(steer_axis)
      if (present(has_all)) basic = merge(size(all_quantities), basic, has_all)
      do k = 1, size(all_quantities)
         if (.not. any([held_name(all_quantities(k)%name, 1), held_name(all_quantities(k)%name, 2)] == name)) cycle
         needs = all_quantities(k)%needs
         if (k > basic) words = "quantities = 'all' of its case"
         do b = size(parts), 2, -1
            if (.not. btest(needs, b - 1)) cycle
            if (words /= '') words = ' and '//words
            words = trim(parts(b))//words
         end do
         if (words /= '') words = ' (this column requires '//words//')'
         return
      end do
   end function needs_text

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
