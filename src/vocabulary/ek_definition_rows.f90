!> The definitions of other programs and of SAE J670/ISO 8855: one row for each quantity of each program.
!>
!> A row has the name and the unit of the program, the meaning of a positive value, and a formula of columns of elastokin at the
!> same state (ek_formula). Everything else follows from the row: --definitions, `elastokin list --definitions`, input/NAMES.md. A
!> new row requires no other file. Variables of a formula, in SI and rad, % and mm/m as they are:
!>
!>     toe_deg, roll_centre_height_mm, …   a column of the same wheel without its prefix, or a column of the axle
!>     left_…, right_…                     a column or number of this wheel
!>     #_motion_ratio                      a column of every element that has one; the name in front is that of the element
!>     side                                −1 left wheel, +1 right wheel
!>     iso                                 +1: vectors are x forward, y left (iso deck); −1: x rearward, y right
!>     height                              height of the wheel centre above the contact point
!>     centre_x, centre_y, centre_z        position of the wheel centre, frame of the deck
!>     patch_x, patch_y, patch_z           position of the contact point, frame of the deck
!>     foot_x, foot_y, foot_z              contact point from the wheel centre at design in the axes of the wheel: ahead, outboard
!>                                         along the spin axis, up in the plane of the wheel
!>     design_toe, design_camber           static angles of the wheel at design
!>     wheelbase, cg_height, car_mass      of &axle
!>     front_brake_share, rear_brake_share, front_drive_share, rear_drive_share      share of this axle, if it is the front or rear
!>
!> A row whose columns or numbers the model does not have is left out.
!> A row without formula is not printed. Its `difference` then gives the reason, and begins with `unpublished`, `unconfirmed` or `beyond`.
!> No row is a guess: without a published definition there is no formula.
module ek_definition_rows
   implicit none(type, external)
   private
   public :: definition_t

   !> A quantity in the definition of another program.
   type :: definition_t
      character(10) :: program            !! one of `programs`
      character(56) :: ours               !! nearest column of elastokin, without the wheel's prefix
      character(48) :: name               !! name in the other program, without comma and quote
      character(12) :: unit = ''          !! unit in the other program, of `own_units` of ek_definition; '' for none
      character(40) :: positive = ''      !! meaning of a positive value
      character(320) :: formula = ''      !! the value in SI; '': not printed
      character(280) :: difference = ''   !! from the column of elastokin; '' if it is the same number
      character(200) :: errs = ''         !! what the program itself states otherwise than it computes
   end type definition_t

   character(10), parameter, public :: programs(*) = [character(10) :: 'adams', 'motionview', 'ipg', 'optimumk', 'lotus', &
      'mathworks', 'sae']
   character(48), parameter, public :: program_titles(*) = [character(48) :: 'Adams/Car', 'MotionView (SDF)', &
      'IPGKinematics', 'OptimumKinematics', 'Lotus Suspension Analysis', 'MathWorks Simscape Vehicle Templates', &
      'SAE J670 (2008) and ISO 8855 (2011)']

   ! reasons why a row has no formula
   character(*), parameter, public :: unpublished = 'definition not published', unconfirmed = 'definition not confirmed', &
      beyond = 'not a function of the columns of a state'

   character(*), parameter :: outward = 'top outward', inward = 'top inward', rearward = 'top rearward', &
      toe_in = 'front edge inward', toe_out = 'front edge outward', left = 'to the left', up = 'wheel up', &
      inboard = 'axis meets the ground inboard', ahead = 'axis meets the ground ahead', above = 'above the ground', &
      along_wheel = 'in the direction of the wheel, not of the car', none = 'never negative', &
      across = 'scrub_radius_mm*cos(toe_deg) - caster_trail_mm*sin(toe_deg)', &
      along = 'caster_trail_mm*cos(toe_deg) + scrub_radius_mm*sin(toe_deg)', &
      rotates = 'rotation of the carrier, not the slope of the angle: equal at zero toe and camber', &
      at_patch = 'vertical travel of the contact point, not of the wheel centre', &
      patch_travel = '(1 + bump_rotation_x_deg_per_m*(patch_y - centre_y)'// &
      ' - bump_rotation_y_deg_per_m*(patch_x - centre_x))', &
      path_arm = 'hypot(side_view_arm_centre_x_mm - patch_x, side_view_arm_centre_z_mm - patch_z)', &
      front_arm = 'hypot(front_view_arm_centre_y_mm - patch_y, front_view_arm_centre_z_mm - patch_z)', &
      side_slope = '(side_view_arm_centre_z_mm - patch_z)/abs(side_view_arm_centre_x_mm - patch_x)', &
      anti = '100*wheelbase/cg_height*iso*', drop_from_patch = '*(side_view_arm_centre_z_mm - patch_z)'// &
      '/(patch_x - side_view_arm_centre_x_mm)', rise_to_centre = '*(side_view_arm_centre_z_mm - centre_z)'// &
      '/(side_view_arm_centre_x_mm - centre_x)', &
      by_compliance = 'elastokin: from the compliance, equal for rigid links and a contact point straight below the centre', &
      sae_caster = '-side*steer_camber_deg_per_deg*cos(camber_deg)/cos(toe_deg)', &
      entries = '; entries of the compliance matrix are in compliance.csv', tyre_roll = beyond//': rolls about forces at the '// &
      'wheel centres, over the distance of the wheel centres'

   type(definition_t), parameter :: adams(*) = [ &
      definition_t('adams', 'wheel_travel_mm', 'Wheel Travel', 'mm', up, 'wheel_travel_mm'), &
      definition_t('adams', 'toe_deg', 'Toe Angle', 'deg', toe_in, 'toe_deg'), &
      definition_t('adams', 'steer_deg', 'Steer Angle', 'deg', left, 'steer_deg'), &
      definition_t('adams', 'camber_deg', 'Camber Angle', 'deg', outward, 'camber_deg'), &
      definition_t('adams', 'caster_deg', 'Caster Angle', 'deg', rearward, 'caster_deg', 'geometric method'), &
      definition_t('adams', 'instant_caster_deg', 'Caster Angle (instant axis)', 'deg', rearward, 'instant_caster_deg'), &
      definition_t('adams', 'kingpin_inclination_deg', 'Kingpin Inclination Angle', 'deg', inward, 'kingpin_inclination_deg'), &
      definition_t('adams', 'scrub_radius_mm', 'Scrub Radius', 'mm', inboard, across, along_wheel), &
      definition_t('adams', 'caster_trail_mm', 'Caster Moment Arm (Mechanical Trail)', 'mm', ahead, along, along_wheel), &
      definition_t('adams', 'wheel_rate_n_per_mm', 'Wheel Rate', 'N/mm', '', 'wheel_rate_n_per_mm'), &
      definition_t('adams', 'ride_rate_n_per_mm', 'Ride Rate', 'N/mm', '', 'ride_rate_n_per_mm'), &
      definition_t('adams', 'bump_steer_deg_per_m', 'Ride Steer', 'deg/mm', left, 'bump_rotation_z_deg_per_m', rotates), &
      definition_t('adams', 'aligning_in_load_held_steer_deg_per_100nm', 'Aligning Torque - Steer Compliance', 'deg/(N mm)', left, &
      '1/rotational_stiffness_z_nm_per_deg', rotates), &
      definition_t('adams', 'fore_aft_stiffness_n_per_mm', 'Fore-Aft Wheel Center Stiffness', 'N/mm', '', &
      'fore_aft_stiffness_n_per_mm'), &
      definition_t('adams', 'aligning_in_load_held_camber_deg_per_100nm', 'Aligning Torque - Camber Compliance', &
      difference=beyond//': C(4,6) + C(4,12) of the matrix'//entries), &
      definition_t('adams', 'roll_steer_deg_per_deg', 'Roll Steer', difference=tyre_roll), &
      definition_t('adams', 'roll_camber_deg_per_deg', 'Roll Camber Coefficient', difference=tyre_roll), &
      definition_t('adams', 'roll_caster_deg_per_deg', 'Roll Caster Coefficient', difference=tyre_roll), &
      definition_t('adams', 'suspension_roll_rate_nm_per_deg', 'Suspension Roll Rate', difference=tyre_roll), &
      definition_t('adams', 'total_roll_rate_nm_per_deg', 'Total Roll Rate', difference=tyre_roll), &
      definition_t('adams', 'roll_centre_height_mm', 'Roll Center Location', difference=tyre_roll//'; with tyre deflection'), &
      definition_t('adams', 'side_view_angle_deg', 'Side-View Angle', difference=unconfirmed//': sign'), &
      definition_t('adams', 'side_view_arm_angle_deg', 'Side-View Swing Arm Angle', difference=unconfirmed// &
      ': sign; the arm is that of elastokin'), &
      definition_t('adams', 'front_view_arm_angle_deg', 'Front-View Swing Arm Angle', difference=unconfirmed// &
      ': sign; the arm is that of elastokin'), &
      definition_t('adams', 'lateral_in_load_held_steer_deg_per_kn', 'Lateral Force - Steer Compliance', &
      difference=beyond//': rotation of the carrier'//entries), &
      definition_t('adams', 'anti_dive_percent', 'Percent Anti-dive Braking', difference=unconfirmed// &
      ': no published number'), &
      definition_t('adams', 'anti_squat_percent', 'Percent Anti-squat Acceleration', difference=unconfirmed// &
      ': no published number'), &
      definition_t('adams', 'ackermann_percent', 'Percent Ackerman', difference=unconfirmed//': theirs with static toe'), &
      definition_t('adams', 'ackermann_error_deg', 'Ackerman Error', difference=unconfirmed), &
      definition_t('adams', 'turning_circle_m', 'Outside Turn Diameter', difference=unconfirmed// &
      '; elastokin: circle of the contact point of the outer wheel'), &
      definition_t('adams', 'anti_lift_drive_percent', 'Percent Anti-lift Acceleration', difference=unconfirmed), &
      definition_t('adams', 'anti_lift_brake_percent', 'Percent Anti-lift Braking', difference=unconfirmed), &
      definition_t('adams', 'brake_dive_mm_per_g', 'Dive Braking', difference=unconfirmed), &
      definition_t('adams', 'drive_squat_mm_per_g', 'Squat Acceleration', difference=unconfirmed), &
      definition_t('adams', 'brake_lift_mm_per_g', 'Lift Braking', difference=unconfirmed), &
      definition_t('adams', 'drive_lift_mm_per_g', 'Lift Acceleration', difference=unconfirmed), &
      definition_t('adams', 'lateral_in_load_held_deflection_mm_per_kn', 'Lateral Force - Deflection Compliance', &
      difference=unconfirmed), &
      definition_t('adams', 'lateral_in_load_held_camber_deg_per_kn', 'Lateral Force - Camber Compliance', &
      difference=beyond//': rotation of the carrier'//entries)]

   type(definition_t), parameter :: motionview(*) = [ &
      definition_t('motionview', 'toe_deg', 'Toe-In (80000010)', 'deg', toe_in, 'toe_deg'), &
      definition_t('motionview', 'steer_deg', 'Steer Angle', 'deg', left, 'steer_deg'), &
      definition_t('motionview', 'camber_deg', 'Camber (80000010)', 'deg', outward, 'atan(tan(camber_deg)/cos(toe_deg))', &
      'angle of the spin axis seen from the front; elastokin: angle between wheel plane and vertical'), &
      definition_t('motionview', 'caster_deg', 'Caster (80000020)', 'deg', rearward, 'caster_deg'), &
      definition_t('motionview', 'kingpin_inclination_deg', 'Kingpin Inclination (80000020)', 'deg', inward, &
      'kingpin_inclination_deg'), &
      definition_t('motionview', 'scrub_radius_mm', 'Scrub Radius (80000030)', 'mm', inboard, 'scrub_radius_mm'), &
      definition_t('motionview', 'caster_trail_mm', 'Caster Trail (80000030)', 'mm', ahead, 'caster_trail_mm'), &
      definition_t('motionview', 'along_spindle_length_mm', 'Spindle Length (80000270)', 'mm', none, &
      'abs(along_spindle_length_mm)', 'a distance, without sign'), &
      definition_t('motionview', 'across_spindle_offset_mm', 'Spindle Offset (80000270)', 'mm', none, &
      'abs(across_spindle_offset_mm)', 'a distance, without sign'), &
      definition_t('motionview', 'axle_roll_deg', 'Roll Angle (80000040)', 'deg', 'right wheel up', &
      'atan((right_wheel_centre_z_mm - left_wheel_centre_z_mm)/abs(right_centre_y - left_centre_y))', &
      'of the wheel centres, positive the other way; elastokin: of the contact points'), &
      definition_t('motionview', 'total_track_mm', 'Tread Width (80000040)', 'mm', '', 'total_track_mm'), &
      definition_t('motionview', 'total_track_mm', 'Track Width (80000040)', 'mm', '', 'abs(right_centre_y - left_centre_y)', &
      'distance of the wheel centres'), &
      definition_t('motionview', 'bump_steer_deg_per_m', 'Ride Steer (80000180)', 'deg/m', left, 'bump_rotation_z_deg_per_m', &
      rotates), &
      definition_t('motionview', 'bump_caster_deg_per_m', 'Ride Caster (80000180)', 'deg/m', rearward, &
      '-iso*bump_rotation_y_deg_per_m', rotates), &
      definition_t('motionview', 'bump_camber_deg_per_m', 'Ride Camber (80000180)', 'deg/m', outward, &
      'side*iso*bump_rotation_x_deg_per_m', rotates), &
      definition_t('motionview', 'lateral_in_load_held_centre_deflection_mm_per_kn', 'Parallel Lateral Force Deflection', &
      'mm/kN', 'to the right', 'lateral_in_load_held_centre_deflection_mm_per_kn'), &
      definition_t('motionview', 'lateral_anti_load_held_centre_deflection_mm_per_kn', 'Converging Lateral Force Deflection', &
      'mm/kN', 'to the right', '-side*lateral_anti_load_held_centre_deflection_mm_per_kn', &
      'forces: to the right on the left wheel, to the left on the right wheel'), &
      definition_t('motionview', 'aligning_in_load_held_steer_deg_per_100nm', 'Parallel Aligning Torque Steer (80000100)', &
      'deg/100 N m', left, '1/rotational_stiffness_z_nm_per_deg', rotates), &
      definition_t('motionview', 'lateral_in_load_held_camber_deg_per_kn', 'Parallel Lateral Force Camber (80000090)', &
      difference=beyond//': rotation of the carrier about x'//entries), &
      definition_t('motionview', 'aligning_anti_load_held_steer_deg_per_100nm', 'Converging Aligning Torque Steer (80000100)', &
      difference=beyond//': rotation of the carrier'//entries), &
      definition_t('motionview', 'roll_steer_percent', 'Roll Steer % (80000190)', difference=tyre_roll), &
      definition_t('motionview', 'roll_camber_deg_per_deg', 'Roll Camber % (80000190)', difference=tyre_roll), &
      definition_t('motionview', 'roll_caster_deg_per_deg', 'Roll Caster % (80000190)', difference=tyre_roll), &
      definition_t('motionview', 'suspension_roll_rate_nm_per_deg', 'Suspension Roll Rate (80000220)', difference=tyre_roll), &
      definition_t('motionview', 'total_roll_rate_nm_per_deg', 'Total Roll Rate (80000220)', difference=tyre_roll), &
      definition_t('motionview', 'tramp_rate_nm_per_deg', 'Tramp Rate (80000220)', difference=tyre_roll), &
      definition_t('motionview', 'roll_centre_with_tyres_height_mm', 'Roll Center Height (80000220)', difference=tyre_roll), &
      definition_t('motionview', 'instant_caster_deg', 'Virtual Caster', difference=unconfirmed), &
      definition_t('motionview', 'ride_rate_n_per_mm', 'Ride Rate', difference=unconfirmed), &
      definition_t('motionview', 'braking_load_held_deflection_mm_per_kn', 'Longitudinal Force Deflection @ Tire patch', &
      difference=unconfirmed//': sign of the force'), &
      definition_t('motionview', 'braking_load_held_rotation_z_deg_per_kn', 'Longitudinal Compliance Steer @ Tire patch', &
      difference=unconfirmed//': sign of the force'), &
      definition_t('motionview', 'braking_load_held_rotation_y_deg_per_kn', 'Longitudinal Caster Compliance @ Tire patch', &
      difference=unconfirmed//': sign of the force'), &
      definition_t('motionview', 'traction_load_held_deflection_mm_per_kn', 'Longitudinal Force Deflection @ Wheel center', &
      difference=unconfirmed//': sign of the force'), &
      definition_t('motionview', 'traction_load_held_rotation_z_deg_per_kn', 'Longitudinal Compliance Steer @ Wheel center', &
      difference=unconfirmed//': sign of the force'), &
      definition_t('motionview', 'traction_load_held_rotation_y_deg_per_kn', 'Longitudinal Caster Compliance @ Wheel center', &
      difference=unconfirmed//': sign of the force'), &
      definition_t('motionview', 'fore_aft_stiffness_n_per_mm', 'Wheel Center X Stiffness (80000050)', difference=unconfirmed// &
      ': one wheel loaded, or both'), &
      definition_t('motionview', 'lateral_stiffness_n_per_mm', 'Wheel Center Y Stiffness (80000050)', difference=unconfirmed// &
      ': one wheel loaded, or both'), &
      definition_t('motionview', 'vertical_stiffness_n_per_mm', 'Wheel Center Z Stiffness (80000050)', difference=unconfirmed// &
      ': one wheel loaded, or both'), &
      definition_t('motionview', 'rotational_stiffness_x_nm_per_deg', 'Wheel Center XX Stiffness', difference=unconfirmed), &
      definition_t('motionview', 'rotational_stiffness_y_nm_per_deg', 'Wheel Center YY Stiffness', difference=unconfirmed), &
      definition_t('motionview', 'rotational_stiffness_z_nm_per_deg', 'Wheel Center ZZ Stiffness', difference=unconfirmed)]

   type(definition_t), parameter :: ipg(*) = [ &
      definition_t('ipg', 'wheel_centre_x_mm', 'x', 'mm', 'forward', 'iso*wheel_centre_x_mm', 'x forward'), &
      definition_t('ipg', 'wheel_centre_y_mm', 'y', 'mm', 'to the left', 'iso*wheel_centre_y_mm', 'y left'), &
      definition_t('ipg', 'wheel_centre_z_mm', 'z', 'mm', 'up', 'wheel_centre_z_mm'), &
      definition_t('ipg', 'camber_deg', 'rx', 'deg', 'about x forward', 'side*camber_deg', &
      'Cardan angle of R = Rz(rz) Rx(rx) Ry(ry), with static camber (left -camber, right camber)'), &
      definition_t('ipg', 'side_view_angle_deg', 'ry', 'deg', 'about y left (top forward)', &
      'asin((sin(toe_deg)*cos(camber_deg) - tan(side_view_angle_deg)*sin(camber_deg))*sin(design_camber)'// &
      '/hypot(cos(toe_deg), sin(toe_deg)*sin(camber_deg) + tan(side_view_angle_deg)*cos(camber_deg))/cos(design_camber))'// &
      ' - atan2(sin(toe_deg)*sin(camber_deg) + tan(side_view_angle_deg)*cos(camber_deg), cos(toe_deg))', &
      'Cardan angle about the spin axis from design; the side-view angle contains steer and camber'), &
      definition_t('ipg', 'toe_deg', 'rz', 'deg', left, 'side*toe_deg', &
      'Cardan angle, with static toe (left -toe, right toe)'), &
      definition_t('ipg', 'caster_deg', 'caster', 'deg', rearward, 'caster_deg'), &
      definition_t('ipg', 'kingpin_inclination_deg', 'kingpin inclination', 'deg', inward, 'kingpin_inclination_deg'), &
      definition_t('ipg', 'spindle_offset_mm', 'longitudinal hub offset', 'mm', 'centre aft of the axis', &
      'spindle_offset_mm*cos(toe_deg) + spindle_length_mm*sin(toe_deg)', along_wheel), &
      definition_t('ipg', 'spindle_length_mm', 'lateral hub offset', 'mm', 'centre outboard of the axis', &
      'spindle_length_mm*cos(toe_deg) - spindle_offset_mm*sin(toe_deg)', along_wheel), &
      definition_t('ipg', 'caster_trail_mm', 'caster trail', 'mm', ahead, &
      '(spindle_offset_mm + height*tan(caster_deg))*cos(toe_deg)'// &
      ' + (spindle_length_mm - height*tan(kingpin_inclination_deg))*sin(toe_deg) - foot_x', &
      along_wheel//'; from a contact point that does not turn with the carrier about the spin axis'), &
      definition_t('ipg', 'scrub_radius_mm', 'scrub radius', 'mm', inboard, &
      '(spindle_length_mm - height*tan(kingpin_inclination_deg))*cos(toe_deg)'// &
      ' - (spindle_offset_mm + height*tan(caster_deg))*sin(toe_deg) + foot_y*cos(camber_deg) + foot_z*sin(camber_deg)', &
      along_wheel//'; from a contact point that does not turn with the carrier about the spin axis'), &
      definition_t('ipg', 'total_track_change_mm', 'track change', 'mm', 'wider', &
      '2*(-side*iso*wheel_centre_y_mm + cos(toe_deg)*(foot_y*cos(camber_deg) + foot_z*sin(camber_deg))'// &
      ' - sin(toe_deg)*foot_x - cos(design_toe)*(foot_y*cos(design_camber) + foot_z*sin(design_camber))'// &
      ' + sin(design_toe)*foot_x)', 'twice that of the wheel; contact point as for the scrub radius'), &
      definition_t('ipg', 'vertical_force_n', 'wheel load', 'N', 'ground on wheel', 'vertical_force_n'), &
      definition_t('ipg', '<spring>_force_n', 'force', 'N', 'compression', '#_force_n'), &
      definition_t('ipg', '<bushing>_fx_n', 'joint force', difference=beyond//': only IPGKinematics halves the force along an '// &
      'arm between its two bushings; the sum of both is the same'), &
      definition_t('ipg', 'contact_patch_z_mm', 'road height', difference=beyond// &
      ': the tyre deflects as at 0.6 of the radius, so 0.4 of the rise of the contact point is missing in it', &
      errs='the force of the tyre acts at the whole radius, its deflection is taken at 0.6 of it'), &
      definition_t('ipg', 'roll_centre_height_mm', 'rc', difference=unpublished), &
      definition_t('ipg', 'anti_dive_percent', 'anti_brake', difference=unpublished), &
      definition_t('ipg', 'anti_lift_drive_percent', 'anti_drive', difference=unpublished), &
      definition_t('ipg', 'ackermann_percent', 'Ackermann', difference=unpublished), &
      definition_t('ipg', 'steering_rack_force_n', 'rack force', difference=unpublished// &
      ': depends on the contact point of the wheel load')]

   type(definition_t), parameter :: optimumk(*) = [ &
      definition_t('optimumk', 'wheel_travel_mm', 'Heave', 'mm', 'body up', '-contact_patch_z_mm', &
      'of the body; the lowest point of the tyre keeps its height'), &
      definition_t('optimumk', 'toe_deg', 'Toe Angle', 'deg', toe_out, '-atan(tan(toe_deg)*cos(camber_deg))', &
      'positive outward, and seen in the tilted plane of the wheel axis'), &
      definition_t('optimumk', 'camber_deg', 'Camber Angle', 'deg', outward, 'camber_deg'), &
      definition_t('optimumk', 'caster_deg', 'Caster Angle', 'deg', rearward, 'caster_deg'), &
      definition_t('optimumk', 'kingpin_inclination_deg', 'King Pin Angle', 'deg', inward, 'kingpin_inclination_deg'), &
      definition_t('optimumk', 'scrub_radius_mm', 'Scrub Radius', 'mm', inboard, 'scrub_radius_mm'), &
      definition_t('optimumk', 'caster_trail_mm', 'Mechanical Trail', 'mm', ahead, 'caster_trail_mm'), &
      definition_t('optimumk', 'front_view_arm_length_mm', 'Front View Swing Arm Length', 'mm', none, front_arm, &
      'from the contact point; elastokin: from the wheel centre'), &
      definition_t('optimumk', 'front_view_arm_angle_deg', 'Front View Swing Arm Angle', 'deg', &
      'instant centre above ground', 'atan((front_view_arm_centre_z_mm - patch_z)/abs(front_view_arm_centre_y_mm - patch_y))', &
      'of the line from the contact point; elastokin: from the wheel centre'), &
      definition_t('optimumk', 'side_view_arm_length_mm', 'Side View Swing Arm Length', 'mm', none, path_arm, &
      'from the contact point; elastokin: from the wheel centre'), &
      definition_t('optimumk', 'side_view_arm_angle_deg', 'Side View Swing Arm Angle', 'deg', 'instant centre above ground', &
      'atan('//side_slope//')', 'of the line from the contact point; elastokin: from the wheel centre'), &
      definition_t('optimumk', 'roll_centre_height_mm', 'Kinematic Roll Center Height', 'mm', above, 'roll_centre_height_mm'), &
      definition_t('optimumk', 'track_change_mm', 'Halftrack', 'mm', '', 'abs(patch_y)', &
      'distance of the contact point from the middle of the car, not its change'), &
      definition_t('optimumk', '<spring>_motion_ratio', 'Heave Motion Ratio', '', 'spring shortens in bump', &
      '-'//patch_travel//'/#_motion_ratio', 'travel of the contact point over length; elastokin: length over travel of the '// &
      'centre'), &
      definition_t('optimumk', 'anti_dive_percent', 'Anti-Dive', '%', '', anti//'front_brake_share'//drop_from_patch, &
      'of the line from the contact point to the instant centre; '//by_compliance), &
      definition_t('optimumk', 'anti_lift_brake_percent', 'Rear Anti-Lift', '%', '', '-'//anti//'rear_brake_share'// &
      drop_from_patch, 'of the line from the contact point to the instant centre; '//by_compliance), &
      definition_t('optimumk', 'anti_squat_percent', 'Anti-Squat', '%', '', anti//'rear_drive_share'//rise_to_centre, &
      'of the line from the wheel centre to the instant centre; '//by_compliance), &
      definition_t('optimumk', 'anti_lift_drive_percent', 'Front Anti-Lift', '%', '', '-'//anti//'front_drive_share'// &
      rise_to_centre, 'of the line from the wheel centre to the instant centre; '//by_compliance), &
      definition_t('optimumk', 'ackermann_percent', 'Ackerman Percentage', difference=unconfirmed), &
      definition_t('optimumk', 'roll_centre_y_mm', 'Kinematic Pitch Center', difference=beyond//': needs the other axle')]

   type(definition_t), parameter :: lotus(*) = [ &
      definition_t('lotus', 'wheel_travel_mm', 'Bump Travel', 'mm', up, 'contact_patch_z_mm', &
      'of the lowest point of the tyre (crown_radius = 0), from design; elastokin: of the wheel centre'), &
      definition_t('lotus', 'camber_deg', 'Camber Angle', 'deg', outward, 'camber_deg'), &
      definition_t('lotus', 'toe_deg', 'Toe Angle {SAE}', 'deg', toe_in, 'toe_deg'), &
      definition_t('lotus', 'toe_deg', 'Toe Angle {Plane}', difference=unconfirmed// &
      ': positive outward, and -1 times the SAE toe at zero camber; its value with camber is not known to us'), &
      definition_t('lotus', 'caster_deg', 'Castor Angle', 'deg', rearward, 'caster_deg'), &
      definition_t('lotus', 'spindle_offset_mm', 'Castor Trail (hub)', 'mm', 'axis aft of the centre', '-spindle_offset_mm', &
      'opposite sign'), &
      definition_t('lotus', 'caster_trail_mm', 'Castor Offset (grnd)', 'mm', ahead, 'caster_trail_mm'), &
      definition_t('lotus', 'kingpin_inclination_deg', 'Kingpin Angle', 'deg', inward, 'kingpin_inclination_deg'), &
      definition_t('lotus', 'spindle_length_mm', 'Kingpin Offset (w/c)', 'mm', 'centre outboard of the axis', &
      'spindle_length_mm'), &
      definition_t('lotus', 'scrub_radius_mm', 'Kingpin Offset (grnd)', 'mm', inboard, 'scrub_radius_mm'), &
      definition_t('lotus', 'caster_trail_mm', 'Mechanical Trail (grnd)', 'mm', ahead, 'caster_trail_mm*cos(caster_deg)', &
      'distance of the contact point from the axis in the side view, across the axis; elastokin: along the ground'), &
      definition_t('lotus', 'roll_centre_height_mm', 'Roll Centre Height', 'mm', above, 'roll_centre_height_mm'), &
      definition_t('lotus', '<spring>_motion_ratio', 'Ratio', '', none, 'abs('//patch_travel//'/#_motion_ratio)', &
      'travel of the contact point over length, without sign (Spring Ratio, Damper Ratio); elastokin: length over travel'), &
      definition_t('lotus', 'track_change_mm', 'Half Track Change', difference=unconfirmed//': sign'), &
      definition_t('lotus', 'wheelbase_change_mm', 'Wheelbase Change', difference=unconfirmed//': sign'), &
      definition_t('lotus', 'anti_dive_percent', 'Anti Dive', difference=unconfirmed//': no published number'), &
      definition_t('lotus', 'anti_squat_percent', 'Anti Squat', difference=unconfirmed//': no published number'), &
      definition_t('lotus', 'ackermann_percent', 'Ackermann', difference=unconfirmed)]

   type(definition_t), parameter :: mathworks(*) = [ &
      definition_t('mathworks', 'toe_deg', 'Toe', 'deg', toe_in, 'toe_deg'), &
      definition_t('mathworks', 'camber_deg', 'Camber', 'deg', outward, 'camber_deg'), &
      definition_t('mathworks', 'caster_deg', 'Caster', 'deg', rearward, 'atan('//sae_caster//')', &
      'measured as in SAE 850219: change of camber between two steer angles. This is the limit of a small steer angle'), &
      definition_t('mathworks', 'kingpin_inclination_deg', 'KPI', difference=beyond// &
      ': measured between two steer angles (SAE 850219)'), &
      definition_t('mathworks', 'steer_camber_deg_per_deg', 'Camber Change per Toe Change', 'deg/deg', outward//' with toe-in', &
      'side*steer_camber_deg_per_deg', 'over toe, not over steer; limit of a small steer angle'), &
      definition_t('mathworks', 'bump_toe_deg_per_m', 'Bump Steer', 'deg/m', toe_in, 'bump_toe_deg_per_m', &
      'a secant over some mm of travel; this is its limit'), &
      definition_t('mathworks', 'bump_camber_deg_per_m', 'Bump Camber', 'deg/m', outward, 'bump_camber_deg_per_m', &
      'a secant over some mm of travel; this is its limit'), &
      definition_t('mathworks', 'bump_caster_deg_per_m', 'Bump Caster', difference=beyond//': of three measured casters', &
      errs='described as positive for a decrease; the value is positive for an increase'), &
      definition_t('mathworks', 'caster_trail_mm', 'Caster Trail', 'mm', '', 'height*('//sae_caster//') - spindle_offset_mm', &
      'hub offset added with the wrong sign: it differs by twice the hub offset', &
      'the sign of the hub offset is wrong, so the number is not the trail that its description states'), &
      definition_t('mathworks', 'scrub_radius_mm', 'Scrub Radius', 'mm', inboard, &
      'abs(spindle_length_mm) - height*tan(kingpin_inclination_deg)', &
      'on the vertical line through the wheel centre, with their KPI; this is with the kingpin inclination'), &
      definition_t('mathworks', 'spindle_offset_mm', 'Hub Long Offset', 'mm', 'centre ahead of the axis', '-spindle_offset_mm', &
      'opposite sign; their axis is the centre of a circle through the path of the wheel centre', &
      'described as positive with the axis ahead of the centre; the value is positive with the axis aft'), &
      definition_t('mathworks', 'spindle_length_mm', 'Hub Lat Offset', 'mm', 'centre left of the axis', &
      '-side*spindle_length_mm', 'along y to the left; their axis is the centre of a circle through the path of the wheel '// &
      'centre', &
      'described as positive inboard; the value of a right wheel is negative'), &
      definition_t('mathworks', 'wheel_rate_n_per_mm', 'Suspension Rate', 'N/mm', '', 'wheel_rate_n_per_mm', &
      'a secant over 20 mm either way; this is its limit'), &
      definition_t('mathworks', 'ride_rate_n_per_mm', 'Ride Rate', 'N/mm', '', 'ride_rate_n_per_mm', &
      'a secant over 20 mm either way; this is its limit'), &
      definition_t('mathworks', 'ride_frequency_hz', 'Ride Frequency', 'Hz', '', 'sqrt(ride_rate_n_per_mm/1000/(car_mass/4))', &
      'a quarter of the mass of the car', 'without 1/(2 pi), and with N/mm in place of N/m; it is 0.199 of the frequency in Hz'), &
      definition_t('mathworks', 'recession_gradient_mm_per_m', 'WC Recession Long', 'mm/m', 'forward in bump', &
      '-recession_gradient_mm_per_m/1000', 'forward, in m/m', &
      'unit given as mm/m, value in m/m; described as positive rearward, value positive forward'), &
      definition_t('mathworks', '<spring>_motion_ratio', 'Spring Ratio', '', 'spring shortens in bump', '-#_motion_ratio', &
      'opposite sign', 'their Damper Ratio is computed from the length of the spring'), &
      definition_t('mathworks', 'roll_steer_deg_per_deg', 'Roll Steer', difference=beyond//': between 2 and -2 deg of roll'), &
      definition_t('mathworks', 'roll_camber_deg_per_deg', 'Roll Camber', difference=beyond//': between 2 and -2 deg of roll'), &
      definition_t('mathworks', 'steering_ratio', 'Steering Ratio', difference=beyond//': a secant to 20 deg of toe'), &
      definition_t('mathworks', 'ackermann_percent', 'Ackermann at 20 deg Inner', difference=beyond//': at 20 deg of toe'), &
      definition_t('mathworks', 'lateral_in_load_held_steer_deg_per_kn', 'Toe/Lat Force (In)', difference=beyond// &
      ': a secant at the largest force'), &
      definition_t('mathworks', 'aligning_in_load_held_steer_deg_per_100nm', 'Toe/Align Torque (In)', difference=beyond// &
      ': a secant at the largest torque', errs='unit given as deg/kN, value in deg per kN m')]

   type(definition_t), parameter :: sae(*) = [ &
      definition_t('sae', 'toe_deg', 'Toe Angle', 'deg', toe_in, 'toe_deg'), &
      definition_t('sae', 'steer_deg', 'Steer Angle', 'deg', left, 'steer_deg', 'ISO z up'), &
      definition_t('sae', 'camber_deg', 'Camber Angle', 'deg', outward, 'camber_deg'), &
      definition_t('sae', 'inclination_deg', 'Inclination Angle', 'deg', 'top to the right', 'side*inclination_deg', &
      'about the x axis of the wheel, so positive to the right on both sides'), &
      definition_t('sae', 'caster_deg', 'Caster Angle', 'deg', rearward, 'caster_deg'), &
      definition_t('sae', 'kingpin_inclination_deg', 'Steering-Axis Inclination Angle', 'deg', inward, 'kingpin_inclination_deg'), &
      definition_t('sae', 'caster_trail_mm', 'Caster Offset at Ground', 'mm', ahead, along, along_wheel), &
      definition_t('sae', 'scrub_radius_mm', 'Steering-Axis Offset at Ground', 'mm', inboard, across, along_wheel), &
      definition_t('sae', 'scrub_radius_mm', 'Scrub Radius', 'mm', none, 'hypot(scrub_radius_mm, caster_trail_mm)', &
      'distance of the contact point from the axis on the ground; elastokin: its lateral part'), &
      definition_t('sae', 'total_track_mm', 'Track', 'mm', '', 'total_track_mm'), &
      definition_t('sae', 'ride_rate_n_per_mm', 'Ride Rate', 'N/mm', '', 'ride_rate_n_per_mm'), &
      definition_t('sae', 'spindle_offset_mm', 'Caster Offset at Wheel Center', difference=unconfirmed//': sign'), &
      definition_t('sae', 'spindle_length_mm', 'Steering-Axis Offset at Wheel Center', difference=unconfirmed//': sign')]

   type(definition_t), parameter, public :: definitions(*) = [adams, motionview, ipg, optimumk, lotus, mathworks, sae]

end module ek_definition_rows
