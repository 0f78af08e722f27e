!> The charts of a report that are open, folded, or on its first screen. This is one table with a row for each quantity and set
!> of charts of a test (ek_rig_test).
!>
!> Of each test, the first six charts with a row are open, in the order of the rows. All other charts are folded: quantities
!> without a row hardly vary in the test, or repeat an open chart. A chart whose curves span less than their least span is folded,
!> too, unless it is a candidate for the first screen, where a flat curve is an answer: no bump toe, no steer under force. Constant
!> quantities are numbers, not charts.
module ek_chart_choice
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_rig_test, only: rig_test_t, rig_test, of_none, of_travel, of_tilt, of_roll, of_steer, of_lateral, of_aligning, &
      of_braking, of_traction, of_vertical, of_table
   use ek_test_result, only: test_result_t
   use ek_chart_data, only: chart_t
   implicit none(type, external)
   private
   public :: open_charts, first_charts, chart_row_t, chart_rows

   integer, parameter :: most_open = 6        !! largest number of open charts of a test
   integer, parameter :: most_first = 4       !! number of charts on the first screen

   type :: chart_row_t
      integer :: charts = of_none             !! set of charts of the test, one of the of_… of ek_rig_test
      character(48) :: quantity = ''          !! the chart: its name after the name of the test
      integer :: rank = 0                     !! rank among the candidates for the first screen; 0: no candidate
   end type chart_row_t

   type(chart_row_t), parameter :: chart_rows(*) = [ &
      chart_row_t(of_travel, 'toe_deg', 1), chart_row_t(of_travel, 'camber_deg', 2), &
      chart_row_t(of_travel, 'vertical_force_n', 4), chart_row_t(of_travel, 'wheel_rate_n_per_mm', 11), &
      chart_row_t(of_travel, 'roll_centre_height_mm', 12), chart_row_t(of_travel, 'motion_ratio', 13), &
      chart_row_t(of_travel, 'track_change_mm', 14), chart_row_t(of_travel, 'wheelbase_change_mm', 15), &
      chart_row_t(of_travel, 'caster_deg'), &
      chart_row_t(of_tilt, 'toe_deg', 16), chart_row_t(of_tilt, 'camber_deg', 17), &
      chart_row_t(of_tilt, 'vertical_force_n'), chart_row_t(of_tilt, 'suspension_roll_rate_nm_per_deg'), &
      chart_row_t(of_tilt, 'roll_centre_height_mm'), chart_row_t(of_tilt, 'torsion'), &
      chart_row_t(of_tilt, 'track_change_mm'), chart_row_t(of_tilt, 'wheel_rate_n_per_mm'), &
      chart_row_t(of_roll, 'steer_deg', 5), chart_row_t(of_roll, 'inclination_deg', 6), &
      chart_row_t(of_roll, 'vertical_force_n'), chart_row_t(of_roll, 'suspension_roll_rate_nm_per_deg'), &
      chart_row_t(of_roll, 'roll_centre_height_mm'), chart_row_t(of_roll, 'roll_centre_y_mm'), &
      chart_row_t(of_roll, 'camber_deg'), chart_row_t(of_roll, 'torsion'), &
      chart_row_t(of_steer, 'steer_deg', 10), chart_row_t(of_steer, 'ackermann_error_deg'), &
      chart_row_t(of_steer, 'steering_ratio'), chart_row_t(of_steer, 'turning_circle_m'), &
      chart_row_t(of_steer, 'camber_deg'), chart_row_t(of_steer, 'caster_trail_mm'), &
      chart_row_t(of_steer, 'ackermann_percent'), chart_row_t(of_steer, 'vertical_force_n'), &
      chart_row_t(of_lateral, 'steer_deg', 3), chart_row_t(of_lateral, 'toe_deg', 3), &
      chart_row_t(of_lateral, 'camber_deg', 18), chart_row_t(of_lateral, 'track_change_mm'), &
      chart_row_t(of_lateral, 'bushings'), &
      chart_row_t(of_aligning, 'steer_deg', 7), chart_row_t(of_aligning, 'toe_deg', 7), &
      chart_row_t(of_aligning, 'camber_deg'), chart_row_t(of_aligning, 'bushings'), &
      chart_row_t(of_braking, 'steer_deg', 8), chart_row_t(of_braking, 'toe_deg', 8), &
      chart_row_t(of_braking, 'wheel_centre_x_mm'), chart_row_t(of_braking, 'wheelbase_change_mm'), &
      chart_row_t(of_braking, 'caster_deg'), chart_row_t(of_braking, 'bushings'), &
      chart_row_t(of_traction, 'steer_deg', 9), chart_row_t(of_traction, 'toe_deg', 9), &
      chart_row_t(of_traction, 'wheel_centre_x_mm'), chart_row_t(of_traction, 'wheelbase_change_mm'), &
      chart_row_t(of_traction, 'bushings'), &
      chart_row_t(of_vertical, 'wheel_travel_mm', 19), chart_row_t(of_vertical, 'wheel_rate_n_per_mm'), &
      chart_row_t(of_vertical, 'toe_deg', 20), chart_row_t(of_vertical, 'camber_deg', 21), &
      chart_row_t(of_vertical, 'roll_centre_height_mm'), chart_row_t(of_vertical, 'force'), &
      chart_row_t(of_table, 'wheel_travel_mm', 22), chart_row_t(of_table, 'steer_deg', 23), &
      chart_row_t(of_table, 'toe_deg', 23), chart_row_t(of_table, 'camber_deg', 24), &
      chart_row_t(of_table, 'vertical_force_n', 25), chart_row_t(of_table, 'force'), &
      chart_row_t(of_table, 'bushings'), &
      chart_row_t(of_none, 'steer_deg', 26), chart_row_t(of_none, 'toe_deg', 26), &
      chart_row_t(of_none, 'camber_deg', 27), chart_row_t(of_none, 'vertical_force_n', 28), &
      chart_row_t(of_none, 'wheel_rate_n_per_mm', 29), chart_row_t(of_none, 'roll_centre_height_mm'), &
      chart_row_t(of_none, 'motion_ratio', 30), chart_row_t(of_none, 'force', 31), chart_row_t(of_none, 'torsion'), &
      chart_row_t(of_none, 'bushings', 32), chart_row_t(of_none, 'track_change_mm')]

contains

   !> Finds the charts of a test: first the open charts, then the folded charts in their order. Constant charts and charts without
   !> curves are omitted.
   pure subroutine open_charts(charts, test, number, places, opened)
      type(chart_t), intent(in) :: charts(:)
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: number                        !! index of the test
      integer, allocatable, intent(out) :: places(:)       !! indices of charts
      integer, intent(out) :: opened                       !! number of open charts, the first of `places`
      logical :: is_folded(size(charts))
      integer :: r, k

      is_folded = charts%test == number .and. .not. charts%is_level
      allocate (places(0))
      do r = 1, size(chart_rows)
         k = chart_of_row(chart_rows(r), charts, test, number)
         if (k == 0 .or. size(places) == most_open) cycle
         if (chart_rows(r)%rank == 0 .and. is_flat(charts(k))) cycle
         places = [places, k]
         is_folded(k) = .false.
      end do
      opened = size(places)
      places = [places, pack([(k, k=1, size(charts))], is_folded)]
   end subroutine open_charts

   !> The indices of the charts on the first screen of a report, at most four, by rank. Of several tests with the same set of
   !> charts, the chart is that of the first one.
   pure function first_charts(charts, tests) result(places)
      type(chart_t), intent(in) :: charts(:)
      type(test_result_t), intent(in) :: tests(:)
      integer, allocatable :: places(:)
      integer :: rank, r, t, k

      allocate (places(0))
      do rank = 1, maxval(chart_rows%rank)
         k = 0
         do r = 1, size(chart_rows)
            if (chart_rows(r)%rank /= rank) cycle
            do t = 1, size(tests)
               if (k == 0) k = chart_of_row(chart_rows(r), charts, tests(t), t)
            end do
         end do
         if (k > 0 .and. size(places) < most_first) places = [places, k]
      end do
   end function first_charts

   !> The index of the chart of a row in a test; 0 if the test has another set of charts, or no such chart that is drawn.
   pure integer function chart_of_row(row, charts, test, number) result(place)
      type(chart_row_t), intent(in) :: row
      type(chart_t), intent(in) :: charts(:)
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: number                        !! index of the test
      integer :: k

      place = 0
      if (rig_set(test%kind) /= row%charts) return
      do k = 1, size(charts)
         if (charts(k)%test /= number .or. charts(k)%is_level) cycle
         if (charts(k)%name == test%name//'_'//trim(row%quantity)) place = k
      end do
   end function chart_of_row

   !> The set of charts of a kind of test.
   pure integer function rig_set(kind)
      character(*), intent(in) :: kind
      type(rig_test_t) :: test

      test = rig_test(kind)
      rig_set = test%charts
   end function rig_set

   !> Whether every curve of a chart spans at most the least span of the axis, so that it looks flat.
   pure logical function is_flat(chart)
      type(chart_t), intent(in) :: chart
      integer :: k

      is_flat = .true.
      do k = 1, size(chart%traces)
         associate (y => chart%traces(k)%y)
            if (.not. any(ieee_is_finite(y))) cycle
            if (maxval(y, mask=ieee_is_finite(y)) - minval(y, mask=ieee_is_finite(y)) > chart%noise) is_flat = .false.
         end associate
      end do
   end function is_flat

end module ek_chart_choice
