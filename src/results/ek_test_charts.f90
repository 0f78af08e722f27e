!> The charts that an engineer expects of a test, side by side: which quantities, in which order.
!>
!> A quantity whose column the table does not hold, or that never has a value, is left out.
module ek_test_charts
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_table, only: table_t, name_length, column_index, row_count
   use ek_test_result, only: test_result_t, converged_rows, design_row, wheel_column, has_column, wheel_word
   use ek_chart, only: chart_t, trace_t, new_chart, add_trace, append_chart
   implicit none(type, external)
   private
   public :: quantity_t, all_quantities, quantities_of, quantity_named, test_charts, quantity_chart

   !> A quantity as it is drawn: column without the wheel's name, title, unit and sign.
   type :: quantity_t
      character(36) :: column = ''
      character(34) :: title = ''
      character(60) :: label = ''
      real(wp) :: noise = 0.0_wp         !! unit of the column; a smaller span is drawn flat
   end type quantity_t

   real(wp), parameter :: longest_arm = 20000.0_wp   !! mm; a longer swing arm is as good as none, and passes infinity
   integer, parameter :: most_curves = 8       !! in one chart, then it becomes a thicket

   ! Every quantity with a name of its own, once
   type(quantity_t), parameter :: all_quantities(*) = [ &
      quantity_t('toe_deg', 'Toe', 'deg    (+ front edge inward)', 0.01_wp), &
      quantity_t('steer_deg', 'Steer', 'deg    (+ to the left)', 0.01_wp), &
      quantity_t('camber_deg', 'Camber', 'deg    (+ top outward)', 0.01_wp), &
      quantity_t('inclination_deg', 'Inclination to the road', 'deg    (+ top outward)', 0.01_wp), &
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
      quantity_t('wheel_rate_n_per_mm', 'Wheel rate', 'N/mm    (both wheels in phase)', 0.1_wp), &
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
      quantity_t('roll_steer_deg_per_deg', 'Roll steer, local slope', 'deg/deg', 0.001_wp), &
      quantity_t('ackermann_percent', 'Ackermann', '%    (100: wheels roll about one point)', 0.1_wp), &
      quantity_t('ackermann_error_deg', 'Ackermann error', 'deg', 0.01_wp), &
      quantity_t('turning_circle_m', 'Turning circle', 'm', 0.1_wp), &
      quantity_t('steering_ratio', 'Steering ratio', 'steering wheel over road wheel', 0.01_wp), &
      quantity_t('steering_wheel_deg', 'Steering wheel', 'deg    (+ left)', 0.1_wp), &
      quantity_t('lateral_in_steer_deg_per_kn', 'Lateral compliance, steer', 'deg/kN    (in phase)', 1e-4_wp), &
      quantity_t('lateral_in_camber_deg_per_kn', 'Lateral compliance, camber', 'deg/kN    (in phase)', 1e-4_wp), &
      quantity_t('lateral_in_deflection_mm_per_kn', 'Lateral compliance, patch', 'mm/kN    (in phase)', 1e-3_wp)]

contains

   !> The columns drawn for a kind of test, in order; the first ones matter most.
   pure function quantities_of(kind) result(columns)
      character(*), intent(in) :: kind
      character(36), allocatable :: columns(:)

      select case (kind)
      case ('roll')
         columns = [character(36) :: 'steer_deg', 'toe_deg', 'camber_deg', 'inclination_deg', 'caster_deg', &
            'track_change_mm', 'wheelbase_change_mm', 'vertical_force_n', 'roll_moment_nm', 'suspension_roll_rate_nm_per_deg', &
            'total_roll_rate_nm_per_deg', 'roll_centre_height_mm', 'roll_centre_y_mm', 'roll_steer_deg_per_deg', 'wheel_travel_mm']
      case ('steering')
         columns = [character(36) :: 'steer_deg', 'toe_deg', 'ackermann_percent', 'ackermann_error_deg', 'camber_deg', &
            'caster_deg', 'kingpin_inclination_deg', 'scrub_radius_mm', 'caster_trail_mm', 'instant_scrub_radius_mm', &
            'instant_caster_trail_mm', 'steering_ratio', 'turning_circle_m', 'wheel_travel_mm', 'vertical_force_n', &
            'track_change_mm', 'wheelbase_change_mm']
      case ('lateral_force')
         columns = [character(36) :: 'steer_deg', 'toe_deg', 'camber_deg', 'track_change_mm', 'wheelbase_change_mm', &
            'caster_deg', 'wheel_travel_mm', 'vertical_force_n']
      case ('aligning_torque')
         columns = [character(36) :: 'steer_deg', 'toe_deg', 'camber_deg', 'caster_deg', 'track_change_mm', 'wheelbase_change_mm']
      case ('braking', 'traction')
         columns = [character(36) :: 'wheelbase_change_mm', 'wheel_centre_x_mm', 'steer_deg', 'toe_deg', 'caster_deg', &
            'camber_deg', 'track_change_mm', 'wheel_travel_mm', 'vertical_force_n']
      case ('vertical_force')
         columns = [character(36) :: 'wheel_travel_mm', 'toe_deg', 'camber_deg', 'track_change_mm', 'wheelbase_change_mm', &
            'caster_deg', 'wheel_rate_n_per_mm', 'roll_centre_height_mm', 'scrub_radius_mm', 'caster_trail_mm']
      case default
         columns = [character(36) :: 'toe_deg', 'camber_deg', 'track_change_mm', 'wheelbase_change_mm', 'caster_deg', &
            'kingpin_inclination_deg', 'vertical_force_n', 'wheel_rate_n_per_mm', 'ride_rate_n_per_mm', 'roll_centre_height_mm', &
            'scrub_radius_mm', 'caster_trail_mm', 'bump_steer_deg_per_m', 'side_view_arm_angle_deg', &
            'side_view_arm_length_mm', 'front_view_arm_length_mm', 'anti_dive_percent', 'anti_lift_brake_percent', &
            'anti_squat_percent', 'anti_lift_drive_percent', 'instant_caster_deg', 'instant_kingpin_inclination_deg', &
            'instant_scrub_radius_mm', 'instant_caster_trail_mm', 'lateral_in_deflection_mm_per_kn', &
            'lateral_in_steer_deg_per_kn', 'lateral_in_camber_deg_per_kn']
         if (kind == 'opposite_travel' .or. kind == 'single_travel') columns = [character(36) :: columns(:13), &
            'suspension_roll_rate_nm_per_deg', 'roll_centre_y_mm']
         if (kind == 'other') columns = [character(36) :: 'steer_deg', columns]
      end select
   end function quantities_of

   !> A quantity by its column; one without a declared name is called by its column.
   pure type(quantity_t) function quantity_named(name) result(quantity)
      character(*), intent(in) :: name
      integer :: k

      quantity%column = name
      quantity%title = name
      do k = 1, size(all_quantities)
         if (all_quantities(k)%column == name) quantity = all_quantities(k)
      end do
   end function quantity_named

   !> All charts of a test, named <test>_<column>.
   pure subroutine test_charts(test, charts)
      type(test_result_t), intent(in) :: test
      type(chart_t), allocatable, intent(out) :: charts(:)
      character(36), allocatable :: columns(:)
      integer :: k

      allocate (charts(0))
      columns = quantities_of(test%kind)
      do k = 1, size(columns)
         if (columns(k) == test%abscissa) cycle
         if (columns(k) == 'toe_deg' .and. has_column(test, 'steer_deg') .and. any(columns == 'steer_deg')) cycle
         call append_if_drawn(charts, quantity_chart(test, quantity_named(columns(k))))
      end do
      call append_if_drawn(charts, ending_chart(test, 'motion_ratio', '_motion_ratio', 'Motion ratio', &
         'd(length)/d(wheel travel)    (− shortens in bump)'))
      call append_if_drawn(charts, ending_chart(test, 'force', '_force_n', 'Springs, dampers, stops', &
         'force, N    (+ compression)'))
      call append_if_drawn(charts, ending_chart(test, 'torsion', '_moment_nm', 'Anti-roll bar', 'moment, N m'))
      call append_if_drawn(charts, bushing_chart(test))
   end subroutine test_charts

   pure subroutine append_if_drawn(charts, chart)
      type(chart_t), allocatable, intent(inout) :: charts(:)
      type(chart_t), intent(in) :: chart

      if (size(chart%traces) > 0) call append_chart(charts, chart)
   end subroutine append_if_drawn

   !> A quantity of every wheel, or of the axle, over the abscissa of the test; without curves where there is none.
   pure type(chart_t) function quantity_chart(test, quantity) result(chart)
      type(test_result_t), intent(in) :: test
      type(quantity_t), intent(in) :: quantity
      integer :: wheel, place

      chart = new_chart(test%name//'_'//trim(quantity%column), trim(quantity%title), trim(quantity%label), test%label)
      chart%noise = quantity%noise
      if (index(quantity%column, '_arm_length_mm') > 0) chart%cap = longest_arm
      place = column_index(test%table, quantity%column)
      if (place > 0) then
         call add_column(chart, test, 1, place, '', merge(1, 3, size(test%prefixes) < 2), 0)
         return
      end if
      do wheel = 1, size(test%prefixes)
         place = column_index(test%table, trim(test%prefixes(wheel))//quantity%column)
         if (place > 0) call add_column(chart, test, wheel, place, wheel_word(test%prefixes(wheel)), wheel, merge(1, 0, wheel > 1))
      end do
   end function quantity_chart

   !> All columns with an ending, named by what stands before it; quantities of wheels and joints apart.
   pure type(chart_t) function ending_chart(test, name, ending, title, label) result(chart)
      type(test_result_t), intent(in) :: test
      character(*), intent(in) :: name, ending, title, label
      character(name_length) :: stem
      integer :: k, place

      chart = new_chart(test%name//'_'//name, title, label, test%label)
      chart%has_key = .true.
      do k = 1, size(test%table%columns)
         place = len_trim(test%table%columns(k)) - len(ending)
         if (place < 1 .or. size(chart%traces) >= most_curves) cycle
         if (test%table%columns(k) (place + 1:) /= ending) cycle
         stem = test%table%columns(k) (:place)
         if (any(stem == [character(14) :: 'vertical', 'roll', 'left_vertical', 'right_vertical'])) cycle   ! of the wheel, the axle
         call add_column(chart, test, side_of(test, stem), k, trim(stem), colour_of(chart, trim(stem)), &
            merge(1, 0, index(stem, 'right_') == 1))
      end do
   end function ending_chart

   !> The colour of the left twin of a right element, else the next that is free.
   pure integer function colour_of(chart, name) result(colour)
      type(chart_t), intent(in) :: chart
      character(*), intent(in) :: name
      integer :: k

      colour = 1
      do k = 1, size(chart%traces)
         colour = max(colour, chart%traces(k)%colour + 1)
      end do
      if (index(name, 'right_') /= 1) return
      do k = 1, size(chart%traces)
         if (chart%traces(k)%title == 'left_'//name(7:)) colour = chart%traces(k)%colour
      end do
   end function colour_of

   !> Magnitude of the force of every bushing, the strongest ones when there are many.
   pure type(chart_t) function bushing_chart(test) result(chart)
      type(test_result_t), intent(in) :: test
      character(*), parameter :: ending = '_fx_n'
      type(trace_t) :: trace
      real(wp), allocatable :: force(:, :), peak(:)
      character(name_length), allocatable :: names(:)
      integer, allocatable :: places(:, :)
      logical :: is_good(row_count(test%table))
      real(wp) :: least
      integer :: k, place, row, n, design

      chart = new_chart(test%name//'_bushings', 'Bushings and joints', 'force, magnitude, N', test%label)
      chart%has_key = .true.
      n = size(test%table%columns)
      allocate (names(n), places(3, n), peak(n), force(row_count(test%table), n))
      n = 0
      is_good = converged_rows(test%table)
      do k = 1, size(test%table%columns)
         place = len_trim(test%table%columns(k)) - len(ending)
         if (place < 1) cycle
         if (test%table%columns(k) (place + 1:) /= ending) cycle
         places(:, n + 1) = [k, column_index(test%table, test%table%columns(k) (:place)//'_fy_n'), &
            column_index(test%table, test%table%columns(k) (:place)//'_fz_n')]
         if (any(places(:, n + 1) == 0)) cycle
         n = n + 1
         names(n) = test%table%columns(k) (:place)
         peak(n) = 0.0_wp
         do row = 1, row_count(test%table)
            force(row, n) = ieee_value(1.0_wp, ieee_quiet_nan)
            if (.not. is_good(row) .or. .not. all(ieee_is_finite(test%table%values(places(:, n), row)))) cycle
            force(row, n) = norm2(test%table%values(places(:, n), row))
            peak(n) = max(peak(n), force(row, n))
         end do
      end do
      least = 0.0_wp
      do while (count(peak(:n) > least) > most_curves)
         least = minval(peak(:n), mask=peak(:n) > least)
      end do
      design = design_row(test%table)
      do k = 1, n
         if (.not. peak(k) > least) cycle
         trace%title = trim(names(k))
         trace%colour = size(chart%traces) + 1
         trace%x = abscissa_of(test, side_of(test, names(k)))
         if (size(trace%x) == 0) return
         trace%y = force(:, k)
         if (design > 0) trace%mark = [trace%x(design), trace%y(design)]
         call add_trace(chart, trace)
      end do
   end function bushing_chart

   !> A column as a curve, where it has any value.
   pure subroutine add_column(chart, test, wheel, place, title, colour, dash)
      type(chart_t), intent(inout) :: chart
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: wheel, place, colour, dash
      character(*), intent(in) :: title
      type(trace_t) :: trace
      logical :: is_good(row_count(test%table))
      integer :: design

      trace%title = title
      trace%colour = colour
      trace%dash = dash
      trace%x = abscissa_of(test, wheel)
      if (size(trace%x) == 0) return
      trace%y = test%table%values(place, :)
      is_good = converged_rows(test%table)
      where (.not. is_good) trace%y = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. any(ieee_is_finite(trace%y))) return
      design = design_row(test%table)
      if (design > 0) trace%mark = [trace%x(design), trace%y(design)]
      call add_trace(chart, trace)
   end subroutine add_column

   !> Values along the abscissa for a wheel; none when the table lacks it.
   pure function abscissa_of(test, wheel) result(values)
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: wheel
      real(wp), allocatable :: values(:)
      integer :: place

      place = wheel_column(test, wheel, test%abscissa)
      if (place == 0) then
         allocate (values(0))
         return
      end if
      values = test%table%values(place, :)
      where (ieee_is_finite(values)) values = values*test%abscissa_size
   end function abscissa_of

   !> The wheel on whose side an element is, by its name; the first when the name does not say.
   pure integer function side_of(test, name) result(wheel)
      type(test_result_t), intent(in) :: test
      character(*), intent(in) :: name
      integer :: k

      wheel = 1
      do k = 2, size(test%prefixes)
         if (index(name, trim(test%prefixes(k))) == 1) wheel = k
      end do
   end function side_of

end module ek_test_charts
