!> Measured curves of a test of the rig, and their deviations from the curves of the model.
!>
!> The path of the case stops at every measured swept value, so that a measured point is compared with the state of the model at
!> this point; the model is not interpolated. A rig loads the axle forth and back, and friction separates the two branches: the loop.
!>
!>     rms    √(Σ (m − y)²/n) over the points m at which the model has a value y
!>     slope  of the least-squares line through the points in the window ±h around design
!>     loop   m on the way down minus m on the way up where the swept value is 0, each the mean over all passages; a passage lies on
!>            the line between two successive points
module ek_measurement
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: quoted, suggestion_by_part
   use ek_quantity, only: name_length
   use ek_case, only: case_t, add_place
   use ek_table, only: table_t, column_index
   use ek_table_reading, only: row_at, read_slope
   use ek_test_result, only: test_result_t
   use ek_frame, only: frame_t, new_frame
   implicit none(type, external)
   private
   public :: measurement_t, channel_t, stop_where_measured, compare_measured, measured_csv, put_measured, measured_heads

   character(*), parameter :: measured_heads = &
      'test,column,unit,points,rms,largest_deviation,measured_slope,slope,window,loop,file,heading'     !! of put_measured

   !> A measured curve, and its deviation from the curve of the model. Numbers without a value are NaN.
   type :: channel_t
      character(name_length) :: column = ''       !! column of the test, with the name of its wheel
      character(name_length) :: heading = ''      !! heading in the measured file
      character(16) :: unit = ''                  !! unit of the column
      logical :: is_zeroed = .false.              !! the channel was set to zero at design: the model adds its value at design
      real(wp), allocatable :: y(:)               !! measured values, in the unit of the column
      real(wp), allocatable :: model(:)           !! values of the model at the same swept values
      integer :: points = 0                       !! number of points that are compared
      real(wp) :: rms = 0.0_wp                    !! root of the mean square of measured minus computed
      real(wp) :: largest = 0.0_wp                !! largest of measured minus computed, with its sign
      real(wp) :: slope = 0.0_wp, model_slope = 0.0_wp   !! in the window [unit of the column per swept value]
      real(wp) :: loop = 0.0_wp                   !! height of the loop at design, see above
   end type channel_t

   !> The measured curves of one test.
   type :: measurement_t
      character(:), allocatable :: file, test     !! measured file; name of the test
      integer :: place = 0                        !! index of the test in the report
      real(wp), allocatable :: x(:)               !! swept value at each point, in the order of the measurement
      type(channel_t), allocatable :: channels(:)
      real(wp) :: half = 0.0_wp                   !! half width of the window of the slopes [swept value]; 0: none
      integer :: outside = 0                      !! number of points outside the range of the test
      integer, allocatable :: rows(:)             !! row of the table at each point; 0: the model has no state there
   end type measurement_t

contains

   !> Adds the measured swept values to the stops of a case, and takes the window of its slopes.
   subroutine stop_where_measured(unit, measurement, case)
      real(wp), intent(in) :: unit                !! SI value of the unit of the swept value
      type(measurement_t), intent(inout) :: measurement
      type(case_t), intent(inout) :: case
      integer :: k

      do k = 1, size(measurement%x)
         if (is_in(measurement%x(k))) call add_place(measurement%x(k), case)
      end do
      measurement%outside = count([(.not. is_in(measurement%x(k)), k=1, size(measurement%x))])
      if (.not. allocated(case%windows)) return
      do k = 1, size(case%windows, 2)
         if (abs(case%windows(1, k)) <= 0.0_wp) measurement%half = max(measurement%half, case%windows(2, k))
      end do

   contains

      pure logical function is_in(x)
         real(wp), intent(in) :: x
         is_in = x >= min(case%from, case%to)/unit .and. x <= max(case%from, case%to)/unit
      end function is_in
   end subroutine stop_where_measured

   !> Compares the measured curves with the solved test. A column that the test does not have is an error.
   subroutine compare_measured(test, measurement, mistakes)
      type(test_result_t), intent(in) :: test
      type(measurement_t), intent(inout) :: measurement
      type(message_list_t), intent(inout) :: mistakes
      integer :: k

      if (allocated(test%read)) then
         call compare(test%read)
      else
         call compare(test%table)
      end if

   contains

      subroutine compare(table)
         type(table_t), intent(in) :: table
         integer :: place

         measurement%rows = [(row_at(table, measurement%x(k)), k=1, size(measurement%x))]
         do k = 1, size(measurement%channels)
            associate (channel => measurement%channels(k))
               place = column_index(table, trim(channel%column))
               if (place == 0) call mistakes%add(measurement%file//': column '//quoted(trim(channel%heading))//': test '// &
                  quoted(measurement%test)//' has no column '//quoted(trim(channel%column))// &
                  suggestion_by_part(trim(channel%column), table%columns))
               call judge(table, place, measurement, channel)
            end associate
         end do
      end subroutine compare
   end subroutine compare_measured

   !> Sets the deviations of one measured curve.
   subroutine judge(table, place, measurement, channel)
      type(table_t), intent(in) :: table
      integer, intent(in) :: place                !! index of the column; 0: the table does not have it
      type(measurement_t), intent(in) :: measurement
      type(channel_t), intent(inout) :: channel
      logical :: is_compared(size(measurement%x))
      real(wp) :: deviation(size(measurement%x)), undefined
      integer :: k, reason, states, missing, at

      undefined = ieee_value(1.0_wp, ieee_quiet_nan)
      allocate (channel%model(size(measurement%x)), source=undefined)
      channel%rms = undefined
      channel%largest = undefined
      channel%model_slope = undefined
      if (place > 0) then
         do k = 1, size(measurement%rows)
            if (measurement%rows(k) > 0) channel%model(k) = table%values(place, measurement%rows(k))
         end do
         if (channel%is_zeroed) then
            k = row_at(table, 0.0_wp)
            if (k > 0) channel%y = channel%y + table%values(place, k)
            if (k == 0) channel%y = undefined
         end if
         if (measurement%half > 0.0_wp) call read_slope(table, place, column_index(table, 'factor'), 0.0_wp, &
            measurement%half, measurement%half, channel%model_slope, reason, states, missing)
      end if
      is_compared = ieee_is_finite(channel%y) .and. ieee_is_finite(channel%model)
      channel%points = count(is_compared)
      deviation = 0.0_wp
      where (is_compared) deviation = channel%y - channel%model
      if (channel%points > 0) then
         channel%rms = sqrt(sum(deviation**2)/channel%points)
         at = maxloc(abs(deviation), dim=1, mask=is_compared)
         channel%largest = deviation(at)
      end if
      channel%slope = slope_of(measurement%x, channel%y, measurement%half)
      channel%loop = loop_of(measurement%x, channel%y)
   end subroutine judge

   !> The slope of the least-squares line through the points in a window around 0; NaN with fewer than three points, or without a
   !> width.
   pure real(wp) function slope_of(x, y, half) result(slope)
      real(wp), intent(in) :: x(:), y(:), half
      logical :: is_in(size(x))
      real(wp) :: mean(2), spread
      integer :: points

      slope = ieee_value(1.0_wp, ieee_quiet_nan)
      is_in = ieee_is_finite(y)
      where (is_in) is_in = abs(x) <= half*(1.0_wp + 1.0e-9_wp)
      points = count(is_in)
      if (points < 3) return
      mean = [sum(x, mask=is_in), sum(y, mask=is_in)]/points
      spread = sum((x - mean(1))**2, mask=is_in)
      if (spread <= (1.0e-3_wp*half)**2) return
      slope = sum((x - mean(1))*(y - mean(2)), mask=is_in)/spread
   end function slope_of

   !> The height of the loop where the swept value is 0: the curve on its way down minus the curve on its way up; NaN if one is
   !> missing.
   pure real(wp) function loop_of(x, y) result(loop)
      real(wp), intent(in) :: x(:), y(:)
      real(wp) :: sums(2)
      integer :: passages(2), way, k

      sums = 0.0_wp
      passages = 0
      do k = 1, size(x) - 1
         if (.not. (ieee_is_finite(y(k)) .and. ieee_is_finite(y(k + 1)))) cycle
         way = 0
         if (x(k) < 0.0_wp .and. x(k + 1) >= 0.0_wp) way = 1
         if (x(k) > 0.0_wp .and. x(k + 1) <= 0.0_wp) way = 2
         if (way == 0) cycle
         sums(way) = sums(way) + y(k) - x(k)*(y(k + 1) - y(k))/(x(k + 1) - x(k))
         passages(way) = passages(way) + 1
      end do
      loop = ieee_value(1.0_wp, ieee_quiet_nan)
      if (all(passages > 0)) loop = sums(2)/passages(2) - sums(1)/passages(1)
   end function loop_of

   !> The deviations of all measured curves as CSV.
   function measured_csv(measurements) result(text)
      type(measurement_t), intent(in) :: measurements(:)
      character(:), allocatable :: text
      type(frame_t) :: frame

      frame = new_frame(measured_heads)
      call put_measured(measurements, frame)
      text = frame%csv()
   end function measured_csv

   !> Appends a row for each measured curve, with the cells of measured_heads.
   subroutine put_measured(measurements, frame)
      type(measurement_t), intent(in) :: measurements(:)
      type(frame_t), intent(inout) :: frame
      integer :: k, l

      do k = 1, size(measurements)
         do l = 1, size(measurements(k)%channels)
            associate (channel => measurements(k)%channels(l))
               call frame%put(measurements(k)%test)
               call frame%put(trim(channel%column))
               call frame%put(trim(channel%unit))
               call frame%put(channel%points)
               call frame%put(channel%rms)
               call frame%put(channel%largest)
               call frame%put(channel%slope)
               call frame%put(channel%model_slope)
               call frame%put(measurements(k)%half)
               call frame%put(channel%loop)
               call frame%put(measurements(k)%file)
               call frame%put(trim(channel%heading))
            end associate
         end do
      end do
   end subroutine put_measured

end module ek_measurement
