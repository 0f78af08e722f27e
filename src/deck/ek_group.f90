!> The groups of a deck and their keys: the single definition of legal input.
!>
!> A new key needs a row here, and a statement in the reader of its group that asks for its value. The row of a number has its
!> dimension, by which the reader converts the number to SI. `elastokin schema` prints the rows of the groups of a deck; ek_choices
!> lists the strings that a key accepts.
module ek_group
   use ek_text, only: quoted, did_you_mean
   use ek_quantity, only: name_length
   use ek_dimension, only: pure_number, length, force, angle, moment, rate, rotation_rate, mass, kilograms, acceleration, &
      gravities, deflection, reaction, reaction_rate, swept
   use ek_number_range, only: any_number, positive, not_negative, not_zero, share, acute
   implicit none(type, external)
   private
   public :: group_names, group_summaries, group_number, is_deck_group, has_results, names_of_groups, occurs_once, is_single
   public :: is_element, can_be_doubled, part_name
   public :: key_t, keys, find_key, record_head, unknown_key, spring_groups

   integer, parameter, public :: model_group = 1, point_group = 2, body_group = 3, measure_group = 4, joint_group = 5, &
      bushing_group = 6, spring_group = 7, wheel_group = 8, load_group = 9, case_group = 10, &
      study_group = 11, factor_group = 12, response_group = 13, include_group = 14, mirror_group = 15, &
      curve_group = 16, damper_group = 17, stop_group = 18, torsion_group = 19, axle_group = 20, steering_group = 21, &
      mass_group = 22, correlation_group = 23, hardpoints_group = 24, target_group = 25, fit_group = 26, fit_target_group = 27, &
      manoeuvre_group = 28, load_state_group = 29, adjuster_group = 30, align_group = 31, part_group = 32, channel_group = 33
   character(*), parameter :: group_names(*) = [character(11) :: 'model', 'point', 'body', 'measure', 'joint', &
      'bushing', 'spring', 'wheel', 'load', 'case', 'study', 'factor', 'response', 'include', 'mirror', 'curve', 'damper', &
      'stop', 'torsion', 'axle', 'steering', 'mass', 'correlation', 'hardpoints', 'target_band', &
      'fit', 'target', 'manoeuvre', 'load_state', 'adjuster', 'align', 'part', 'channel']

   !> What a record of each group describes, for `elastokin schema`; '' for groups of a study, a fit or a map.
   character(*), parameter :: group_summaries(*) = [character(90) :: 'the model: name, units, frame and preload trim', &
      'a hardpoint', 'a rigid body', 'a scalar between two bodies', 'a joint, driver or coupler', 'a bushing', &
      'a spring between two points, or on a measure', 'a wheel, with its carrier and tyre', 'a force and moment on a body', &
      'a sweep, or a test of the rig', '', '', '', 'a file with further groups of the deck', &
      'the deck is the left half of an axle', 'a law for springs, stops, torsion springs and bushings', &
      'a damper, of which the gas force acts', 'a bump stop or a rebound stop', 'a torsion spring between two bodies', &
      'the axle and the car around it', 'the steering wheel and the rack', 'an additional mass on a body', '', &
      'points from a file', 'a range in which a K&C metric should lie', '', '', 'load factor and accelerations of the car', &
      'a state from which all tests can start', 'a rod, shim, slot or seat by which the axle is set up', &
      'static angles of a wheel that adjusters give', 'a part whose end deviates from the drawing', '']

   integer, parameter :: every_group = 0      !! group, in the table of keys, of a key that every group has
   integer, parameter :: spring_groups(*) = [spring_group, damper_group, stop_group, torsion_group]   ! elements of one measure
   integer, parameter :: result_groups(*) = [measure_group, joint_group, bushing_group, spring_groups]   ! their names make columns
   ! groups of a study, of a fit, of a map of measured channels; all others belong to a deck
   integer, parameter, public :: study_groups(4) = [study_group, factor_group, response_group, correlation_group], &
      fit_groups(3) = [fit_group, factor_group, fit_target_group], map_groups(1) = [channel_group]

   ! types of value
   integer, parameter, public :: word = 1      !! quoted string of at most word_length characters: names and choices
   integer, parameter, public :: prose = 2     !! quoted string of at most note_length characters: titles, notes, paths
   integer, parameter, public :: number = 3
   integer, parameter, public :: whole = 4     !! integer
   integer, parameter, public :: switch = 5    !! .true. or .false.
   integer, parameter, public :: heading = 6   !! quoted string of at most name_length characters: columns of the results
   integer, parameter, public :: long_whole = 7       !! integer of up to 18 digits: seeds

   integer, parameter, public :: word_length = 63      !! longest name
   integer, parameter, public :: note_length = 2000    !! longest title, note or path
   integer, parameter, public :: longest(long_whole) = [word_length, note_length, 0, 0, 0, name_length, 0]   !! 0: not a string
   integer, parameter, public :: max_measures = 8     !! measures per coupler
   integer, parameter, public :: max_values = 200   !! values per factor, increments of a study, points of a curve, names in shared
   integer, parameter, public :: max_paths = 50       !! paths of the numbers that one factor changes
   integer, parameter, public :: max_loads = 12       !! loads scaled by one case
   integer, parameter, public :: max_adjusted = 12    !! points that one adjuster moves

   ! roles under &mirror, y → −y, of the keys that differ between the sides: the name of a record that may be duplicated (its
   ! group), a vector, and the rest
   integer, parameter, public :: polar = 101    !! (x, y, z) → (x, −y, z)
   integer, parameter, public :: axial = 102    !! (x, y, z) → (−x, y, −z)
   integer, parameter, public :: curves = 103   !! 'fy=name' → 'fy=-name' for the components that change sign
   integer, parameter, public :: wheel_side = 104     !! 'left' → 'right'

   type :: key_t
      integer :: group
      character(18) :: name
      integer :: type
      integer :: least, most     !! least and largest number of values
      logical :: is_required
      integer :: range = any_number     !! legal range of a number, see ek_number_range
      character(20) :: unit = ''   !! unit of the limits of the range, for messages
      integer :: role = 0
      logical :: has_zeros = .false.    !! a setting of one element sets the elements that the deck does not give to 0
      integer :: dimension = pure_number     !! dimension of a number, see ek_dimension: the reader converts by it
      character(12) :: default = ''     !! value of a key that is not given, as in a deck; '': none, or it depends on other keys
      character(100) :: about = ''      !! meaning of a key of a deck, a noun phrase, for `elastokin schema`
   end type key_t

   integer, parameter :: named(*) = [model_group, point_group, body_group, mass_group, measure_group, joint_group, &
      bushing_group, spring_group, curve_group, damper_group, stop_group, torsion_group, wheel_group, load_group, case_group, &
      study_group, factor_group, response_group, fit_group, fit_target_group, load_state_group, adjuster_group, part_group]
   integer :: j     ! implied-do index of the table, not used elsewhere

   type(key_t), parameter :: keys_of_names(*) = [(key_t(named(j), 'name', word, 1, 1, .true., about='name of the item'), &
      j=1, size(named))]

   type(key_t), parameter :: keys_of_parts(*) = [ &
      key_t(model_group, 'title', prose, 1, 1, .false., about='title of the figures'), &
      key_t(model_group, 'length', word, 1, 1, .false., default='mm', about='unit of length'), &
      key_t(model_group, 'force', word, 1, 1, .false., default='N', about='unit of force'), &
      key_t(model_group, 'angle', word, 1, 1, .false., default='deg', about='unit of angle'), &
      key_t(model_group, 'mass', word, 1, 1, .false., default='kg', about='unit of mass'), &
      key_t(model_group, 'axes', word, 1, 1, .false., default='x-rear', &
      about='frame: x-rear is x rearward, y to the right; iso is x forward, y to the left; z is up'), &
      key_t(model_group, 'balance', word, 1, 1, .false., default='none', &
      about='preload trim, by which the design position is an equilibrium under the constant loads'), &
      key_t(model_group, 'start', word, 1, 1, .false., &
      about='state from which all tests start, if neither balance nor the constant loads hold the design height'), &
      key_t(model_group, 'start_height', number, 1, 1, .false., dimension=length, &
      about='height of the wheels above design from which all tests start, instead of start'), &
      key_t(model_group, 'start_load', number, 1, 1, .false., positive, dimension=force, &
      about='vertical force of the road on each wheel from which all tests start, instead of start'), &
      key_t(model_group, 'state', word, 1, 1, .false., about='name of the &load_state from which all tests start'), &
      key_t(load_state_group, 'height', number, 1, 1, .false., dimension=length, about='height of the wheels above design'), &
      key_t(load_state_group, 'wheel_load', number, 1, 1, .false., positive, dimension=force, &
      about='vertical force of the road on each wheel'), &
      key_t(load_state_group, 'added_mass', number, 1, 1, .false., dimension=mass, &
      about='mass on each wheel in addition to the loads of the deck'), &
      key_t(model_group, 'gravity', number, 1, 1, .false., not_negative, ' (m/s², downward)', dimension=acceleration, &
      about='gravity, downward; 0 if not given'), &
      key_t(model_group, 'plausible', switch, 1, 1, .false., default='.true.', about='whether implausible numbers are reported'), &
      key_t(point_group, 'at', number, 3, 3, .true., role=polar, dimension=length, about='coordinates in the design position'), &
      key_t(body_group, 'origin', word, 1, 1, .false., role=point_group, about='reference point, for method recursive only'), &
      key_t(body_group, 'mass', number, 1, 1, .false., positive, dimension=mass, about='mass; requires centre'), &
      key_t(body_group, 'centre', word, 1, 1, .false., role=point_group, about='point at the centre of gravity; requires mass'), &
      key_t(mass_group, 'body', word, 1, 1, .true., role=body_group, about='body that carries the mass'), &
      key_t(mass_group, 'kg', number, 1, 1, .true., positive, dimension=kilograms, about='additional mass, in kg in every deck'), &
      key_t(mass_group, 'at', word, 1, 1, .true., role=point_group, about='point at the centre of gravity of this mass'), &
      key_t(measure_group, 'type', word, 1, 1, .true., about='type of the measure'), &
      key_t(measure_group, 'bodies', word, 2, 2, .true., role=body_group, about='first and second body'), &
      key_t(measure_group, 'at', word, 1, 2, .false., role=point_group, about='one point or two points, as the type requires'), &
      key_t(measure_group, 'axis', word, 2, 2, .false., role=point_group, about='two points: direction fixed in the first body'), &
      key_t(measure_group, 'axis_vector', number, 3, 3, .false., role=polar, &
      about='components of a vector of any length, instead of axis'), &
      key_t(measure_group, 'axis_2', word, 2, 2, .false., role=point_group, &
      about='two points: direction fixed in the second body'), &
      key_t(measure_group, 'axis_2_vector', number, 3, 3, .false., role=polar, &
      about='components of a vector of any length, instead of axis_2'), &
      key_t(joint_group, 'type', word, 1, 1, .true., about='type of the joint'), &
      key_t(joint_group, 'bodies', word, 2, 2, .false., role=body_group, &
      about='first and second body; not of a driver or coupler'), &
      key_t(joint_group, 'at', word, 1, 2, .false., role=point_group, about='one point or two points, as the type requires'), &
      key_t(joint_group, 'axis', word, 2, 2, .false., role=point_group, about='two points: direction fixed in the first body'), &
      key_t(joint_group, 'axis_vector', number, 3, 3, .false., role=polar, &
      about='components of a vector of any length, instead of axis'), &
      key_t(joint_group, 'axis_2', word, 2, 2, .false., role=point_group, about='two points: direction fixed in the second body'), &
      key_t(joint_group, 'axis_2_vector', number, 3, 3, .false., role=polar, &
      about='components of a vector of any length, instead of axis_2'), &
      key_t(joint_group, 'measure', word, 1, 1, .false., role=measure_group, about='driver: the prescribed measure'), &
      key_t(joint_group, 'measures', word, 1, max_measures, .false., role=measure_group, about='coupler: the measures'), &
      key_t(joint_group, 'ratios', number, 1, max_measures, .false., not_zero, &
      about='coupler: ratios; the sum of ratio x measure is constant'), &
      key_t(joint_group, 'stiffness', number, 1, 1, .false., positive, dimension=reaction_rate, &
      about='driver: stiffness between prescribed value and measure; rigid if not given'), &
      key_t(joint_group, 'balance', switch, 1, 1, .false., &
      about='driver with a stiffness: whether it may carry a force at design'), &
      key_t(joint_group, 'rating_angle', number, 1, 2, .false., positive, dimension=angle, &
      about='largest tilt of the joint; of a distance joint, of both ends'), &
      key_t(joint_group, 'rating_axis_vector', number, 3, 6, .false., role=polar, &
      about='axis of stud and housing at design; of a distance joint, of both ends'), &
      key_t(bushing_group, 'bodies', word, 2, 2, .true., role=body_group, about='first and second body'), &
      key_t(bushing_group, 'at', word, 1, 2, .true., role=point_group, about='one point for both markers, or one for each'), &
      key_t(bushing_group, 'z_axis', word, 2, 2, .false., role=point_group, &
      about='two points: z axis of the marker in the first body'), &
      key_t(bushing_group, 'z_vector', number, 3, 3, .false., role=polar, &
      about='components of a vector of any length, instead of z_axis'), &
      key_t(bushing_group, 'x_axis', word, 2, 2, .false., role=point_group, &
      about='two points: x axis of the marker in the first body'), &
      key_t(bushing_group, 'x_vector', number, 3, 3, .false., role=polar, &
      about='components of a vector of any length, instead of x_axis'), &
      key_t(bushing_group, 'mirrored', switch, 1, 1, .false., default='.false.', &
      about='choose the axis that is not given as on the right side of a mirrored axle'), &
      key_t(bushing_group, 'rating_angle', number, 1, 1, .false., positive, dimension=angle, &
      about='largest tilt of the bushing'), &
      key_t(bushing_group, 'rating_axis_vector', number, 3, 3, .false., role=polar, &
      about='axis whose tilt is rated; marker z if not given'), &
      key_t(bushing_group, 'kt', number, 3, 3, .false., not_negative, has_zeros=.true., dimension=rate, default='0', &
      about='rates along the marker axes x, y, z'), &
      key_t(bushing_group, 'kr', number, 3, 3, .false., not_negative, has_zeros=.true., dimension=rotation_rate, default='0', &
      about='rates about the marker axes x, y, z'), &
      key_t(bushing_group, 'curve', word, 1, 6, .false., role=curves, &
      about='curves instead of rates: fx=name, fy=-name (reflected through the origin), ... mz=name'), &
      key_t(bushing_group, 'property_file', prose, 1, 1, .false., &
      about='file of Adams/Car or IPGKinematics with the law of the element'), &
      key_t(bushing_group, 'property_scale', number, 1, 6, .false., positive, default='1', &
      about='factors of forces and moments of the file: fx, fy, fz, mx, my, mz'), &
      key_t(bushing_group, 'property_offset', number, 1, 6, .false., dimension=deflection, default='0', &
      about='deflections at which the curves of the file are read at design: lengths, then angles'), &
      key_t(bushing_group, 'property_kind', word, 1, 1, .false., default='akima', &
      about='interpolation of the curves of the file'), &
      key_t(bushing_group, 'preload_force', number, 3, 3, .false., role=polar, has_zeros=.true., dimension=force, default='0', &
      about='force on the second body at design, in marker axes'), &
      key_t(bushing_group, 'preload_moment', number, 3, 3, .false., role=axial, has_zeros=.true., dimension=moment, default='0', &
      about='moment on the second body at design, in marker axes'), &
      key_t(spring_group, 'bodies', word, 2, 2, .false., role=body_group, about='first and second body; not with measure'), &
      key_t(spring_group, 'at', word, 2, 2, .false., role=point_group, about='two points; not with measure'), &
      key_t(spring_group, 'measure', word, 1, 1, .false., role=measure_group, &
      about='measure on which the spring acts, instead of bodies and at'), &
      key_t(spring_group, 'rate', number, 1, 1, .false., not_negative, dimension=reaction_rate, &
      about='reaction per deflection; or curve or property_file'), &
      key_t(spring_group, 'curve', word, 1, 1, .false., about='curve of the reaction over the compression'), &
      key_t(spring_group, 'property_file', prose, 1, 1, .false., &
      about='file of Adams/Car or IPGKinematics with the law of the element'), &
      key_t(spring_group, 'property_scale', number, 1, 1, .false., positive, default='1', &
      about='factor of the force of the file'), &
      key_t(spring_group, 'property_offset', number, 1, 1, .false., dimension=deflection, default='0', &
      about='length added to the compression before the curve of the file is read'), &
      key_t(spring_group, 'property_kind', word, 1, 1, .false., default='akima', about='interpolation of the curves of the file'), &
      key_t(spring_group, 'preload', number, 1, 1, .false., dimension=reaction, default='0', &
      about='compressive reaction at design; or free_length'), &
      key_t(spring_group, 'balance', switch, 1, 1, .false., default='.true.', &
      about='whether the preload trim may change the preload'), &
      key_t(spring_group, 'free_length', number, 1, 1, .false., positive, dimension=length, about='length without force'), &
      key_t(curve_group, 'x', number, 2, max_values, .true., dimension=deflection, &
      about='increasing values, in the unit of the deflection of the element that uses the curve'), &
      key_t(curve_group, 'y', number, 2, max_values, .true., dimension=reaction, &
      about='as many values as x, in the unit of the reaction of the element that uses the curve'), &
      key_t(curve_group, 'kind', word, 1, 1, .false., default='linear', about='interpolation'), &
      key_t(damper_group, 'bodies', word, 2, 2, .true., role=body_group, about='first and second body'), &
      key_t(damper_group, 'at', word, 2, 2, .true., role=point_group, about='two points'), &
      key_t(damper_group, 'gas_force', number, 1, 1, .false., not_negative, dimension=force, default='0', &
      about='gas force at design'), &
      key_t(damper_group, 'gas_rate', number, 1, 1, .false., not_negative, dimension=rate, default='0', &
      about='increase of the gas force per length of compression'), &
      key_t(stop_group, 'type', word, 1, 1, .true., about='bump pushes the ends apart, rebound pulls them together'), &
      key_t(stop_group, 'bodies', word, 2, 2, .true., role=body_group, about='first and second body'), &
      key_t(stop_group, 'at', word, 2, 2, .true., role=point_group, about='two points'), &
      key_t(stop_group, 'clearance', number, 1, 1, .true., not_negative, dimension=length, &
      about='change of the distance of the points from design to contact'), &
      key_t(stop_group, 'rate', number, 1, 1, .false., not_negative, dimension=rate, &
      about='force per penetration; or curve or property_file'), &
      key_t(stop_group, 'curve', word, 1, 1, .false., about='curve of the force over the penetration'), &
      key_t(stop_group, 'property_file', prose, 1, 1, .false., &
      about='file of Adams/Car or IPGKinematics with the law of the element'), &
      key_t(stop_group, 'property_scale', number, 1, 1, .false., positive, default='1', about='factor of the force of the file'), &
      key_t(stop_group, 'property_offset', number, 1, 1, .false., dimension=length, default='0', &
      about='length added to the penetration before the curve of the file is read'), &
      key_t(stop_group, 'property_kind', word, 1, 1, .false., default='akima', about='interpolation of the curves of the file'), &
      key_t(stop_group, 'rounding', number, 1, 1, .false., positive, dimension=length, &
      about='length of the smooth transition at contact; 0.5 mm if not given'), &
      key_t(torsion_group, 'bodies', word, 2, 2, .true., role=body_group, about='first and second body'), &
      key_t(torsion_group, 'axis', word, 2, 2, .false., role=point_group, about='two points: axis fixed in the first body'), &
      key_t(torsion_group, 'axis_vector', number, 3, 3, .false., role=polar, &
      about='components of a vector of any length, instead of axis'), &
      key_t(torsion_group, 'rate', number, 1, 1, .false., not_negative, dimension=rotation_rate, &
      about='moment per angle; or curve'), &
      key_t(torsion_group, 'curve', word, 1, 1, .false., about='curve of the moment over the angle'), &
      key_t(torsion_group, 'preload', number, 1, 1, .false., dimension=moment, default='0', &
      about='moment on the second body about the axis at design')]

   type(key_t), parameter :: keys_of_tests(*) = [ &
      key_t(wheel_group, 'body', word, 1, 1, .true., role=body_group, about='wheel carrier'), &
      key_t(wheel_group, 'side', word, 1, 1, .true., role=wheel_side, about='side of the car'), &
      key_t(wheel_group, 'centre', word, 1, 1, .true., role=point_group, about='point: wheel centre'), &
      key_t(wheel_group, 'contact', word, 1, 1, .false., role=point_group, &
      about='point: contact point; computed with crown_radius'), &
      key_t(wheel_group, 'spin_vector', number, 3, 3, .false., role=polar, &
      about='spin axis, pointing outboard, instead of toe and camber'), &
      key_t(wheel_group, 'toe', number, 1, 1, .false., acute, ' deg', dimension=angle, default='0', about='static toe'), &
      key_t(wheel_group, 'camber', number, 1, 1, .false., acute, ' deg', dimension=angle, default='0', about='static camber'), &
      key_t(wheel_group, 'radius', number, 1, 1, .false., positive, dimension=length, &
      about='radius; height of the centre above the contact point if not given'), &
      key_t(wheel_group, 'crown_radius', number, 1, 1, .false., not_negative, dimension=length, &
      about='radius of the crown of the tyre: the contact point is the lowest point; 0: a disc'), &
      key_t(wheel_group, 'tyre_rate', number, 1, 1, .false., positive, dimension=rate, about='vertical stiffness of the tyre'), &
      key_t(wheel_group, 'tyre_width', number, 1, 1, .false., positive, dimension=length, about='width of the tyre'), &
      key_t(wheel_group, 'sprung_mass', number, 1, 1, .false., positive, dimension=mass, &
      about='sprung mass on this wheel; from the wheel load if not given'), &
      key_t(wheel_group, 'steer_axis', word, 2, 2, .false., role=point_group, about='two points on the geometric steering axis'), &
      key_t(axle_group, 'name', word, 1, 1, .false., about='name in messages'), &
      key_t(axle_group, 'position', word, 1, 1, .true., about='position in the car'), &
      key_t(axle_group, 'class', word, 1, 1, .false., about='class of the car, for the usual ranges of a report'), &
      key_t(axle_group, 'wheelbase', number, 1, 1, .true., positive, dimension=length, about='wheelbase'), &
      key_t(axle_group, 'cg_height', number, 1, 1, .true., positive, dimension=length, &
      about='height of the centre of gravity of the car above the ground'), &
      key_t(axle_group, 'mass', number, 1, 1, .false., positive, dimension=mass, about='mass of the car'), &
      key_t(axle_group, 'axle_load', number, 1, 1, .false., positive, dimension=force, &
      about='force of the road on both wheels when the car stands'), &
      key_t(axle_group, 'roll_share', number, 1, 1, .false., share, about='share of the lateral load transfer on this axle'), &
      key_t(axle_group, 'brake_share', number, 1, 1, .true., share, about='share of the braking force on the front axle'), &
      key_t(axle_group, 'drive_share', number, 1, 1, .false., share, default='1', &
      about='share of the driving force on this axle'), &
      key_t(axle_group, 'drive_reaction', word, 1, 1, .false., default='wheel_centre', about='where the driving force acts'), &
      key_t(axle_group, 'brake_reaction', word, 1, 1, .false., default='carrier', about='what takes the brake torque'), &
      key_t(axle_group, 'front_overhang', number, 1, 1, .false., positive, dimension=length, &
      about='front axle: distance from the wheels forward to the front corners of the car'), &
      key_t(axle_group, 'front_width', number, 1, 1, .false., positive, dimension=length, &
      about='front axle: lateral distance of the front corners of the car'), &
      key_t(steering_group, 'name', word, 1, 1, .false., about='name in messages'), &
      key_t(steering_group, 'driver', word, 1, 1, .true., role=joint_group, about='driver joint that moves the rack'), &
      key_t(steering_group, 'ratio', number, 1, 1, .true., not_zero, dimension=length, &
      about='rack travel per revolution of the steering wheel'), &
      key_t(steering_group, 'travel', number, 1, 1, .true., positive, dimension=length, &
      about='largest rack travel in each direction'), &
      key_t(load_group, 'body', word, 1, 1, .true., role=body_group, about='body on which the load acts'), &
      key_t(load_group, 'at', word, 1, 1, .true., role=point_group, about='point of the body'), &
      key_t(load_group, 'force', number, 3, 3, .false., role=polar, has_zeros=.true., dimension=force, default='0', &
      about='force in the frame of the deck'), &
      key_t(load_group, 'moment', number, 3, 3, .false., role=axial, has_zeros=.true., dimension=moment, default='0', &
      about='moment in the frame of the deck'), &
      key_t(load_group, 'follows', switch, 1, 1, .false., default='.false.', about='whether the load rotates with the body'), &
      key_t(load_group, 'factor', word, 1, 1, .false., default='constant', &
      about='case: scaled by the case that names the load; constant: acts in every case'), &
      key_t(adjuster_group, 'type', word, 1, 1, .true., about='kind of adjuster'), &
      key_t(adjuster_group, 'joint', word, 1, 1, .false., role=joint_group, about='rod: distance joint whose length changes'), &
      key_t(adjuster_group, 'spring', word, 1, 1, .false., role=spring_group, about='seat: spring on the seat'), &
      key_t(adjuster_group, 'body', word, 1, 1, .false., role=body_group, about='body whose points move, or chassis'), &
      key_t(adjuster_group, 'at', word, 1, max_adjusted, .false., role=point_group, &
      about='points that move; of a rod, the fixed and the moved end; of a shim, first its own point'), &
      key_t(adjuster_group, 'thread', whole, 1, 1, .false., &
      about='rod with a body: 1, the second point moves, or 2, both points move by a half; 1 if not given'), &
      key_t(adjuster_group, 'axis', word, 2, 2, .false., role=point_group, &
      about='two points: direction of the displacement, of a shim its normal'), &
      key_t(adjuster_group, 'axis_vector', number, 3, 3, .false., role=polar, &
      about='components of a vector of any length, instead of axis'), &
      key_t(adjuster_group, 'pivot', word, 1, 1, .false., role=point_group, &
      about='shim: point about which the points turn'), &
      key_t(adjuster_group, 'range', number, 2, 2, .true., dimension=length, about='lowest and highest value'), &
      key_t(adjuster_group, 'value', number, 1, 1, .false., dimension=length, default='0', &
      about='change of length, thickness or displacement; 0 as drawn'), &
      key_t(align_group, 'wheel', word, 1, 1, .true., role=wheel_group, about='wheel with these static angles'), &
      key_t(align_group, 'toe', number, 1, 1, .false., acute, ' deg', dimension=angle, about='static toe'), &
      key_t(align_group, 'camber', number, 1, 1, .false., acute, ' deg', dimension=angle, about='static camber'), &
      key_t(align_group, 'with', word, 1, 2, .true., role=adjuster_group, about='one adjuster for each angle'), &
      key_t(part_group, 'body', word, 1, 1, .false., role=body_group, about='body that deviates, or chassis'), &
      key_t(part_group, 'joint', word, 1, 1, .false., role=joint_group, about='rod that deviates: a distance joint'), &
      key_t(part_group, 'at', word, 1, 1, .false., role=point_group, about='point of this part that deviates'), &
      key_t(part_group, 'deviation', number, 3, 3, .false., role=polar, has_zeros=.true., dimension=length, default='0', &
      about='deviation of the point in this part; 0 as drawn'), &
      key_t(manoeuvre_group, 'name', word, 1, 1, .false., about='name of the manoeuvre in the results'), &
      key_t(manoeuvre_group, 'set', word, 1, 1, .false., about='set of manoeuvres; no other key is then allowed'), &
      key_t(manoeuvre_group, 'vertical', number, 1, 1, .false., not_negative, default='1', &
      about='load factor: force of the road per weight of the car'), &
      key_t(manoeuvre_group, 'longitudinal', number, 1, 1, .false., dimension=gravities, default='0', &
      about='acceleration of the car, positive forward'), &
      key_t(manoeuvre_group, 'lateral', number, 1, 1, .false., dimension=gravities, default='0', &
      about='acceleration of the car, positive to the left'), &
      key_t(manoeuvre_group, 'longitudinal_by', word, 1, 1, .false., &
      about='what gives the longitudinal force; brake if decelerated'), &
      key_t(manoeuvre_group, 'side', word, 1, 1, .false., about='the only wheel that the manoeuvre loads'), &
      key_t(manoeuvre_group, 'wheels', number, 2, 2, .false., not_negative, &
      about='load factors of the left and the right wheel, instead of vertical'), &
      key_t(manoeuvre_group, 'downforce', number, 1, 1, .false., dimension=force, &
      about='aerodynamic force on the axle, positive downward; 0 if not given'), &
      key_t(manoeuvre_group, 'steer', number, 1, 1, .false., dimension=deflection, &
      about='value of the steering driver; 0 if not given'), &
      key_t(case_group, 'load', word, 1, max_loads, .false., role=load_group, about='loads that the case scales'), &
      key_t(case_group, 'drive', word, 1, 1, .false., role=joint_group, &
      about='wheel_travel, the driver joint whose value changes, or the rod adjuster.<name>'), &
      key_t(case_group, 'wheel', word, 1, 1, .false., role=wheel_group, about='wheel whose travel is prescribed'), &
      key_t(case_group, 'test', word, 1, 1, .false., about='test of the rig'), &
      key_t(case_group, 'vertical', word, 1, 1, .false., about='how a test holds the wheels'), &
      key_t(case_group, 'pose', word, 1, 1, .false., default='settled', &
      about='test manoeuvres: the axle settles under the loads, or its springs keep their length at design'), &
      key_t(case_group, 'phase', word, 1, 1, .false., default='in', &
      about='forces or moments on both wheels: equal, or opposite on the right wheel'), &
      key_t(case_group, 'offset', number, 1, 1, .false., dimension=length, default='0', &
      about='test lateral_force: distance of the force aft of the contact point'), &
      key_t(case_group, 'file', prose, 1, 1, .false., about='table of loads of test table'), &
      key_t(case_group, 'target', prose, 1, 1, .false., about='column=value that the case solves for'), &
      key_t(case_group, 'quantities', word, 1, 1, .false., &
      about='columns; basic: from positions and forces only; all for a test, else basic'), &
      key_t(case_group, 'from', number, 1, 1, .false., dimension=swept, about='first swept value'), &
      key_t(case_group, 'to', number, 1, 1, .false., dimension=swept, about='last swept value'), &
      key_t(case_group, 'increments', whole, 1, 1, .false., about='number of increments; 100 if not given, in a grid 16'), &
      key_t(case_group, 'steer_from', number, 1, 1, .false., dimension=deflection, &
      about='grid: first value of the steering driver'), &
      key_t(case_group, 'steer_to', number, 1, 1, .false., dimension=deflection, about='grid: last value of the steering driver'), &
      key_t(case_group, 'steer_increments', whole, 1, 1, .false., &
      about='grid: number of increments of the steering driver; 12 if not given'), &
      key_t(case_group, 'method', word, 1, 1, .false., default='equilibrium', about='method of solution'), &
      key_t(case_group, 'solver', word, 1, 1, .false., &
      about='solver of linear systems; lapack if not given, in studies and programs sparse'), &
      key_t(case_group, 'follow', word, 1, 1, .false., default='factor', &
      about='equal steps of the factor, or along the path over limit points'), &
      key_t(case_group, 'tolerance', number, 1, 1, .false., positive, dimension=length, &
      about='limit of the last correction of a state; 1e-7 mm if not given')]

   type(key_t), parameter :: keys_of_studies(*) = [ &
      key_t(study_group, 'title', prose, 1, 1, .false.), &
      key_t(study_group, 'kind', word, 1, 1, .true.), &
      key_t(study_group, 'deck', prose, 1, 1, .true.), &
      key_t(study_group, 'case', word, 1, 1, .false.), &
      key_t(study_group, 'plot', prose, 1, 1, .false.), &
      key_t(study_group, 'end', word, 1, 1, .false.), &
      key_t(study_group, 'methods', word, 1, 3, .false.), &
      key_t(study_group, 'increments', whole, 1, max_values, .false.), &
      key_t(study_group, 'columns', heading, 1, 20, .false.), &
      key_t(study_group, 'definitions', word, 1, 1, .false.), &
      key_t(study_group, 'samples', whole, 1, 1, .false.), &
      key_t(study_group, 'levels', whole, 1, 1, .false.), &
      key_t(study_group, 'seed', long_whole, 1, 1, .false.), &
      key_t(study_group, 'scrambled', switch, 1, 1, .false.), &
      key_t(study_group, 'list', prose, 1, 1, .false.), &
      key_t(study_group, 'chunk', whole, 1, 1, .false.), &
      key_t(study_group, 'format', word, 1, 1, .false.), &
      key_t(factor_group, 'path', prose, 1, max_paths, .true.), &
      key_t(factor_group, 'bodies', word, 1, max_values, .false.), &
      key_t(factor_group, 'each', switch, 1, 1, .false.), &
      key_t(factor_group, 'change', word, 1, 1, .false.), &
      key_t(factor_group, 'lower', number, 1, 1, .false.), &
      key_t(factor_group, 'upper', number, 1, 1, .false.), &
      key_t(factor_group, 'nominal', number, 1, 1, .false.), &
      key_t(factor_group, 'tolerance', number, 1, 1, .false., positive), &
      key_t(factor_group, 'deviation', number, 1, 1, .false., positive), &
      key_t(factor_group, 'distribution', word, 1, 1, .false.), &
      key_t(factor_group, 'values', number, 1, max_values, .false.), &
      key_t(factor_group, 'from', number, 1, 1, .false.), &
      key_t(factor_group, 'to', number, 1, 1, .false.), &
      key_t(factor_group, 'count', whole, 1, 1, .false.), &
      key_t(factor_group, 'spacing', word, 1, 1, .false.), &
      key_t(factor_group, 'weights', number, 1, max_paths, .false.), &
      key_t(correlation_group, 'factors', word, 2, 2, .true.), &
      key_t(correlation_group, 'value', number, 1, 1, .true.), &
      key_t(response_group, 'case', word, 1, 1, .false.), &
      key_t(response_group, 'column', heading, 1, 1, .false.), &
      key_t(response_group, 'responses', word, 2, 2, .false.), &
      key_t(response_group, 'of', word, 1, 1, .false.), &
      key_t(response_group, 'side', word, 1, 1, .false.), &
      key_t(response_group, 'at', number, 1, 1, .false.), &
      key_t(response_group, 'over', heading, 1, 1, .false.), &
      key_t(response_group, 'window', number, 1, 1, .false., positive), &
      key_t(response_group, 'file', prose, 1, 1, .false.), &
      key_t(response_group, 'lower', number, 1, 1, .false.), &
      key_t(response_group, 'upper', number, 1, 1, .false.), &
      key_t(fit_group, 'title', prose, 1, 1, .false.), &
      key_t(fit_group, 'deck', prose, 1, 1, .true.), &
      key_t(fit_group, 'case', word, 1, 1, .false.), &
      key_t(fit_group, 'iterations', whole, 1, 1, .false.), &
      key_t(fit_target_group, 'quantity', heading, 1, 1, .true.), &
      key_t(fit_target_group, 'case', word, 1, 1, .false.), &
      key_t(fit_target_group, 'of', word, 1, 1, .false.), &
      key_t(fit_target_group, 'over', heading, 1, 1, .false.), &
      key_t(fit_target_group, 'at', number, 1, 1, .false.), &
      key_t(fit_target_group, 'window', number, 1, 1, .false., positive), &
      key_t(fit_target_group, 'value', number, 1, 1, .false.), &
      key_t(fit_target_group, 'low', number, 1, 1, .false.), &
      key_t(fit_target_group, 'high', number, 1, 1, .false.), &
      key_t(fit_target_group, 'file', prose, 1, 1, .false.), &
      key_t(fit_target_group, 'column', heading, 1, 1, .false.), &
      key_t(fit_target_group, 'deviation', number, 1, 1, .false., positive), &
      key_t(fit_target_group, 'map', prose, 1, 1, .false.), &
      key_t(fit_target_group, 'weight', number, 1, 1, .false., not_negative), &
      key_t(channel_group, 'heading', heading, 1, 1, .true.), &
      key_t(channel_group, 'quantity', heading, 1, 1, .true.), &
      key_t(channel_group, 'test', word, 1, 1, .false.), &
      key_t(channel_group, 'unit', word, 1, 1, .false.), &
      key_t(channel_group, 'scale', number, 1, 1, .false., not_zero), &
      key_t(channel_group, 'zeroed', switch, 1, 1, .false.)]

   type(key_t), parameter :: keys_of_files(*) = [ &
      key_t(include_group, 'file', prose, 1, 1, .true., about='file with further groups of the deck'), &
      key_t(hardpoints_group, 'file', prose, 1, 1, .true., about='CSV table, or subsystem or assembly of Adams/Car'), &
      key_t(hardpoints_group, 'length', word, 1, 1, .false., &
      about='unit of a CSV file without a unit; that of the deck if not given'), &
      key_t(hardpoints_group, 'axes', word, 1, 1, .false., about='frame of the file'), &
      key_t(hardpoints_group, 'side', word, 1, 1, .false., about='points that are read; left with mirror, else both'), &
      key_t(target_group, 'quantity', word, 1, 1, .true., about='name of a K&C metric of the report'), &
      key_t(target_group, 'low', number, 1, 1, .false., about='lower limit, in the unit of the K&C metric'), &
      key_t(target_group, 'high', number, 1, 1, .false., about='upper limit, in the unit of the K&C metric'), &
      key_t(mirror_group, 'shared', word, 1, max_values, .false., about='names of the items that exist only once'), &
      key_t(every_group, 'note', prose, 1, 1, .false., about='free text, for instance the source of a number')]

   type(key_t), parameter :: keys(*) = [keys_of_names, keys_of_parts, keys_of_tests, keys_of_studies, keys_of_files]

contains

   !> Index of a group; 0 if there is no such group.
   pure integer function group_number(name)
      character(*), intent(in) :: name
      group_number = findloc(group_names, name, dim=1)
   end function group_number

   !> Whether a group belongs to a deck; .false. for groups of a study, of a fit or of a map, and for 0.
   pure logical function is_deck_group(group)
      integer, intent(in) :: group
      is_deck_group = group > 0 .and. .not. any([study_groups, fit_groups, map_groups] == group)
   end function is_deck_group

   !> Whether a deck may have at most one record of a group.
   elemental logical function occurs_once(group)
      integer, intent(in) :: group
      occurs_once = any([model_group, mirror_group, axle_group, steering_group] == group)
   end function occurs_once

   !> Whether records of a group have columns in the results. Their names must then differ, and &mirror duplicates the records that
   !> refer to duplicated parts.
   pure logical function has_results(group)
      integer, intent(in) :: group
      has_results = any(result_groups == group)
   end function has_results

   !> Whether records of a group are duplicated by &mirror together with the records to which they refer.
   pure logical function is_element(group)
      integer, intent(in) :: group
      is_element = has_results(group) .or. any([wheel_group, load_group, mass_group, adjuster_group, align_group, part_group] == &
         group)
   end function is_element

   !> Whether &mirror may duplicate records of a group.
   pure logical function can_be_doubled(group)
      integer, intent(in) :: group
      can_be_doubled = is_element(group) .or. group == point_group .or. group == body_group
   end function can_be_doubled

   !> The group names of a deck or of a study, for suggestions.
   pure function names_of_groups(of_deck) result(names)
      logical, intent(in) :: of_deck
      character(len(group_names)), allocatable :: names(:)
      integer :: k

      if (of_deck) names = pack(group_names, [(is_deck_group(k), k=1, size(group_names))])
      if (.not. of_deck) names = group_names(study_groups)
   end function names_of_groups

   !> Whether --set addresses a group without a record name: &model, and every group whose name is optional or does not exist,
   !> except &manoeuvre, whose records other than sets have names.
   pure logical function is_single(group)
      integer, intent(in) :: group
      is_single = group == model_group .or. .not. (group == manoeuvre_group .or. any(keys%group == group .and. &
         keys%name == 'name' .and. keys%is_required))
   end function is_single

   !> Finds the row of a key; is_known is .false. if the group has no such key.
   pure subroutine find_key(group, name, key, is_known)
      integer, intent(in) :: group
      character(*), intent(in) :: name
      type(key_t), intent(out) :: key
      logical, intent(out) :: is_known
      integer :: k

      is_known = .false.
      do k = 1, size(keys)
         if (keys(k)%group /= group .and. keys(k)%group /= every_group) cycle
         if (keys(k)%name /= name) cycle
         key = keys(k)
         is_known = .true.
         return
      end do
   end subroutine find_key

   !> The name of a &part, '<body or rod>.<point>', with the prefix of a side once: 'left_lca.lower_ball_joint', also for
   !> 'left_lca.left_lower_ball_joint' and 'lca.left_lower_ball_joint'.
   pure function part_name(given) result(name)
      character(*), intent(in) :: given
      character(:), allocatable :: name
      character(*), parameter :: sides(2) = [character(6) :: 'left_', 'right_']
      character(:), allocatable :: part, point
      logical :: has_part, has_point
      integer :: dot, k

      name = trim(given)
      dot = index(name, '.')
      if (dot == 0) return
      part = name(:dot - 1)
      point = name(dot + 1:)
      do k = 1, size(sides)
         has_part = index(part, trim(sides(k))) == 1
         has_point = index(point, trim(sides(k))) == 1
         if (.not. (has_part .or. has_point)) cycle
         if (index(part, trim(sides(3 - k))) == 1 .or. index(point, trim(sides(3 - k))) == 1) return
         if (has_part) part = part(len_trim(sides(k)) + 1:)
         if (has_point) point = point(len_trim(sides(k)) + 1:)
         name = trim(sides(k))//part//'.'//point
         return
      end do
   end function part_name

   !> The beginning of a message on a record: "bushing 'top_mount': ".
   pure function record_head(group, name) result(head)
      integer, intent(in) :: group
      character(*), intent(in) :: name     !! '' if the record has no name
      character(:), allocatable :: head

      head = trim(group_names(group))//': '
      if (name /= '') head = trim(group_names(group))//' '//quoted(name)//': '
   end function record_head

   !> Message about an unknown key: "there is no key 'rte' in &spring (did you mean 'rate'?)".
   pure function unknown_key(group, name) result(words)
      integer, intent(in) :: group
      character(*), intent(in) :: name
      character(:), allocatable :: words
      character(len(keys%name)) :: names(count(keys%group == group))

      names = pack(keys%name, keys%group == group)
      words = 'there is no key '//quoted(name)//' in &'//trim(group_names(group))// &
         did_you_mean(name, [character(len(names)) :: names(:1), 'note', names(2:)])
   end function unknown_key

end module ek_group
