!> The quantities shown in charts: column, title, unit and sign, and the quantities of each kind of test.
module ek_quantity
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: quantity_t, all_quantities, quantities_of, quantity_named, without_phase

   !> A quantity of a chart: column without the wheel's name, title, unit and sign.
   type :: quantity_t
      character(48) :: column = ''
      character(34) :: title = ''
      character(60) :: label = ''
      real(wp) :: noise = 0.0_wp         !! in units of the column; a smaller span is drawn flat
   end type quantity_t

   ! Every quantity with a declared title, once
   type(quantity_t), parameter :: all_quantities(*) = [ &
      quantity_t('toe_deg', 'Toe', 'deg    (+ front edge inward)', 0.01_wp), &
      quantity_t('steer_deg', 'Steer', 'deg    (+ to the left)', 0.01_wp), &
      quantity_t('camber_deg', 'Camber', 'deg    (+ top outward)', 0.01_wp), &
      quantity_t('inclination_deg', 'Camber relative to the road', 'deg    (+ top outward)', 0.01_wp), &
      quantity_t('caster_deg', 'Caster', 'deg    (+ top rearward)', 0.01_wp), &
      quantity_t('kingpin_inclination_deg', 'Kingpin inclination', 'deg    (+ top inward)', 0.01_wp), &
      quantity_t('track_change_mm', 'Half-track change', 'contact patch, mm    (+ outward)', 0.1_wp), &
      quantity_t('wheelbase_change_mm', 'Wheelbase change', 'contact patch, mm    (+ rearward)', 0.1_wp), &
      quantity_t('wheel_centre_x_mm', 'Wheel centre, longitudinal', 'mm    (x of the deck)', 0.1_wp), &
      quantity_t('wheel_travel_mm', 'Wheel travel', 'mm    (+ bump)', 0.1_wp), &
      quantity_t('scrub_radius_mm', 'Scrub radius', 'mm    (+ axis inboard of the patch)', 0.1_wp), &
      quantity_t('caster_trail_mm', 'Caster trail', 'mm    (+ axis ahead of the patch)', 0.1_wp), &
      quantity_t('spindle_length_mm', 'Spindle length', 'mm    (+ wheel centre outboard)', 0.1_wp), &
      quantity_t('instant_caster_deg', 'Caster, instant axis', 'deg    (+ top rearward)', 0.01_wp), &
      quantity_t('instant_kingpin_inclination_deg', 'Kingpin inclination, instant axis', 'deg    (+ top inward)', 0.01_wp), &
      quantity_t('instant_scrub_radius_mm', 'Scrub radius, instant axis', 'mm    (+ axis inboard of the patch)', 0.1_wp), &
      quantity_t('instant_caster_trail_mm', 'Caster trail, instant axis', 'mm    (+ axis ahead of the patch)', 0.1_wp), &
      quantity_t('vertical_force_n', 'Wheel load', 'N    (ground on wheel, + up)', 1.0_wp), &
      quantity_t('wheel_rate_n_per_mm', 'Wheel rate', 'N/mm    (wheels parallel (in phase))', 0.1_wp), &
      quantity_t('ride_rate_n_per_mm', 'Ride rate', 'N/mm    (with the tyre)', 0.1_wp), &
      quantity_t('roll_centre_height_mm', 'Roll centre, height', 'mm    (+ above the ground)', 0.1_wp), &
      quantity_t('roll_centre_z_mm', 'Roll centre, vertical', 'mm    (z of the deck)', 0.1_wp), &
      quantity_t('roll_centre_y_mm', 'Roll centre, lateral', 'mm    (y of the deck)', 0.1_wp), &
      quantity_t('suspension_roll_rate_nm_per_deg', 'Suspension roll rate', 'N m/deg', 1.0_wp), &
      quantity_t('total_roll_rate_nm_per_deg', 'Total roll rate', 'N m/deg    (with the tyres)', 1.0_wp), &
      quantity_t('roll_moment_nm', 'Roll moment', 'N m    (+ left wheel loaded)', 1.0_wp), &
      quantity_t('side_view_arm_length_mm', 'Side-view swing arm length', 'mm', 1.0_wp), &
      quantity_t('side_view_arm_angle_deg', 'Side-view swing arm angle', 'deg', 0.01_wp), &
      quantity_t('front_view_arm_length_mm', 'Front-view swing arm length', 'mm', 1.0_wp), &
      quantity_t('front_view_arm_angle_deg', 'Front-view swing arm angle', 'deg', 0.01_wp), &
      quantity_t('anti_dive_percent', 'Anti-dive', '%', 0.1_wp), &
      quantity_t('anti_lift_drive_percent', 'Anti-lift, drive', '%', 0.1_wp), &
      quantity_t('anti_lift_brake_percent', 'Anti-lift, braking', '%', 0.1_wp), &
      quantity_t('anti_squat_percent', 'Anti-squat', '%', 0.1_wp), &
      quantity_t('bump_steer_deg_per_m', 'Bump steer, local slope', 'deg/m    (+ to the left in bump)', 0.1_wp), &
      quantity_t('roll_steer_deg_per_deg', 'Roll steer with tyres, local slope', 'deg/deg', 0.001_wp), &
      quantity_t('ackermann_percent', 'Ackermann', '%    (100: wheels roll about one point)', 0.1_wp), &
      quantity_t('ackermann_error_deg', 'Ackermann error', 'deg', 0.01_wp), &
      quantity_t('turning_circle_m', 'Turning circle', 'm', 0.1_wp), &
      quantity_t('curb_to_curb_m', 'Turning circle, curb to curb', 'm', 0.1_wp), &
      quantity_t('wall_to_wall_m', 'Turning circle, wall to wall', 'm', 0.1_wp), &
      quantity_t('outer_steer_error_deg', 'Deviation of the outer wheel', 'deg    (+ steers more than ideal)', 0.01_wp), &
      quantity_t('steer_camber_deg_per_deg', 'Camber per steer, local slope', 'deg/deg    (+ top outward)', 0.001_wp), &
      quantity_t('steering_rack_force_n', 'Rack force', 'N    (reaction of the driver)', 1.0_wp), &
      quantity_t('side_view_angle_deg', 'Side-view angle', 'deg    (+ top rearward)', 0.01_wp), &
      quantity_t('recession_gradient_mm_per_m', 'Recession gradient, local slope', 'mm/m    (+ rearward in bump)', 0.1_wp), &
      quantity_t('ride_frequency_hz', 'Ride frequency', 'Hz', 0.001_wp), &
      quantity_t('total_track_mm', 'Total track', 'mm', 0.1_wp), &
      quantity_t('steering_ratio', 'Steering ratio', 'steering wheel over road wheel', 0.01_wp), &
      quantity_t('steering_wheel_deg', 'Steering wheel', 'deg    (+ left)', 0.1_wp), &
      quantity_t('lateral_in_load_held_steer_deg_per_kn', 'Lateral compliance, steer', &
      'deg/kN    (load held, parallel (in phase))', 1e-4_wp), &
      quantity_t('lateral_in_load_held_camber_deg_per_kn', 'Lateral compliance, camber', &
      'deg/kN    (load held, parallel (in phase))', 1e-4_wp), &
      quantity_t('lateral_in_load_held_deflection_mm_per_kn', 'Lateral compliance, patch', &
      'mm/kN    (load held, parallel (in phase))', 1e-3_wp)]

contains

   !> The columns drawn for a kind of test, the most important ones first.
   pure function quantities_of(kind) result(columns)
      character(*), intent(in) :: kind
      character(48), allocatable :: columns(:)

      select case (kind)
      case ('roll')
         columns = [character(48) :: 'steer_deg', 'toe_deg', 'camber_deg', 'inclination_deg', 'caster_deg', &
            'track_change_mm', 'wheelbase_change_mm', 'vertical_force_n', 'roll_moment_nm', 'suspension_roll_rate_nm_per_deg', &
            'total_roll_rate_nm_per_deg', 'roll_centre_height_mm', 'roll_centre_y_mm', 'roll_steer_deg_per_deg', 'wheel_travel_mm']
      case ('steering')
         columns = [character(48) :: 'steer_deg', 'toe_deg', 'ackermann_percent', 'ackermann_error_deg', 'camber_deg', &
            'caster_deg', 'kingpin_inclination_deg', 'scrub_radius_mm', 'caster_trail_mm', 'instant_scrub_radius_mm', &
            'instant_caster_trail_mm', 'steering_ratio', 'turning_circle_m', 'wheel_travel_mm', 'vertical_force_n', &
            'track_change_mm', 'wheelbase_change_mm', 'steer_camber_deg_per_deg', 'outer_steer_error_deg', 'curb_to_curb_m', &
            'wall_to_wall_m', 'steering_rack_force_n']
      case ('lateral_force')
         columns = [character(48) :: 'steer_deg', 'toe_deg', 'camber_deg', 'track_change_mm', 'wheelbase_change_mm', &
            'caster_deg', 'wheel_travel_mm', 'vertical_force_n']
      case ('aligning_torque')
         columns = [character(48) :: 'steer_deg', 'toe_deg', 'camber_deg', 'caster_deg', 'track_change_mm', 'wheelbase_change_mm']
      case ('braking', 'traction')
         columns = [character(48) :: 'wheelbase_change_mm', 'wheel_centre_x_mm', 'steer_deg', 'toe_deg', 'caster_deg', &
            'camber_deg', 'track_change_mm', 'wheel_travel_mm', 'vertical_force_n']
      case ('vertical_force')
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
         if (kind == 'opposite_travel' .or. kind == 'single_travel') columns = [character(48) :: columns(:13), &
            'suspension_roll_rate_nm_per_deg', 'roll_centre_y_mm']
         if (kind == 'other') columns = [character(48) :: 'steer_deg', columns]
         if (kind == 'table') columns = [character(48) :: 'wheel_travel_mm', 'steer_deg', columns]
      end select
   end function quantities_of

   !> The quantity of a column; without a declared title the column name is the title.
   pure type(quantity_t) function quantity_named(name) result(quantity)
      character(*), intent(in) :: name
      integer :: k

      quantity%column = name
      quantity%title = name
      do k = 1, size(all_quantities)
         if (all_quantities(k)%column == name) quantity = all_quantities(k)
      end do
   end function quantity_named

   !> A title or label for a single wheel: without its note on the phase of two wheels.
   pure function without_phase(text) result(words)
      character(*), intent(in) :: text
      character(:), allocatable :: words
      ! the longest first: each contains parts of the next ones
      character(*), parameter :: phases(*) = [character(32) :: '    (wheels parallel (in phase))', &
         'wheels parallel (in phase)', ', parallel (in phase)']
      integer :: k, at, length

      words = trim(text)
      do k = 1, size(phases)
         length = len_trim(phases(k))
         at = index(words, phases(k) (:length))
         if (at > 0) words = words(:at - 1)//words(at + length:)
      end do
   end function without_phase

end module ek_quantity
