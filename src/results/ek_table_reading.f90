!> Reads a number from a table: a column at a swept value, or a slope over a window. Every caller reads in this way: key numbers and
!> gradients of the report, responses of studies, conditions of `solve`, targets of `fit`.
!>
!> A number at a swept value is that of the state there, where the path of the case has stopped (ek_path_states). A number where
!> another column has a given value is that of the state there, too (ek_value_stops). Nothing is interpolated between two states. A
!> slope is read from the five states of its window (ek_window). So the increments of a case have no influence. A window that the
!> states do not cover has no slope.
!>
!> The states of a path by arc length, and those of a load table, are not at swept values that can be chosen. There is no value at a
!> swept value between two of them, and a slope is that of the least-squares line through the states in the window.
module ek_table_reading
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_window, only: window_points, window_places, window_slope, has_place, both_sides
   use ek_table, only: table_t, column_index, keep_rows, stop_row
   use ek_test_result, only: unfolded_rows
   implicit none(type, external)
   private
   public :: row_at, value_at_place, read_slope, rows_of_window, states_of_windows, usual_width, value_where, min_points
   public :: is_read, is_outside, is_undefined, is_flat, has_few_states

   ! why a slope has no value
   integer, parameter :: is_read = 0           !! it has one
   integer, parameter :: is_outside = 1        !! the states do not cover the window
   integer, parameter :: is_undefined = 2      !! a column has no value at a state of the window
   integer, parameter :: is_flat = 3           !! the abscissa does not change in the window
   integer, parameter :: has_few_states = 4    !! along an arc, or in a load table: fewer than min_points states in the window

   integer, parameter :: min_points = 3

contains

   !> Index of the row with a swept value, on the branch through design; 0 if no state was found there.
   pure integer function row_at(table, place) result(row)
      type(table_t), intent(in) :: table
      real(wp), intent(in) :: place            !! in the unit of the column `factor`
      logical :: is_good(size(table%values, 2))

      row = 0
      if (size(is_good) == 0) return
      is_good = unfolded_rows(table)
      row = good_row(table, column_index(table, 'factor'), is_good, place)
   end function row_at

   !> Index of the usable row with a swept value; 0 without such a row.
   pure integer function good_row(table, factor, is_good, place) result(row)
      type(table_t), intent(in) :: table
      integer, intent(in) :: factor            !! index of the column; 0: no row
      logical, intent(in) :: is_good(:)
      real(wp), intent(in) :: place
      real(wp) :: range
      integer :: k

      row = 0
      if (factor == 0 .or. .not. any(is_good)) return
      range = maxval(abs(table%values(factor, :)), mask=is_good)
      do k = 1, size(is_good)
         if (.not. is_good(k)) cycle
         if (.not. has_place(table%values(factor, k), place, range)) cycle
         row = k
         if (abs(table%values(factor, k) - place) <= 0.0_wp) return
      end do
   end function good_row

   !> The value of a column at a swept value; NaN if there is no such state, or if it did not converge.
   pure real(wp) function value_at_place(table, column, place) result(value)
      type(table_t), intent(in) :: table
      integer, intent(in) :: column            !! index of the column
      real(wp), intent(in) :: place            !! in the unit of the column `factor`
      integer :: row

      value = ieee_value(1.0_wp, ieee_quiet_nan)
      row = row_at(table, place)
      if (row > 0) value = table%values(column, row)
   end function value_at_place

   !> Finds the rows of the five states of a window, and the side of the centre on which they lie; all rows are 0 if a state is missing.
   pure subroutine rows_of_window(table, centre, width, rows, side)
      type(table_t), intent(in) :: table
      real(wp), intent(in) :: centre, width    !! centre and half width [swept value]
      integer, intent(out) :: rows(window_points)
      integer, intent(out) :: side             !! both_sides, 1 or −1
      integer, parameter :: sides(3) = [both_sides, 1, -1]
      logical :: is_good(size(table%values, 2))
      real(wp) :: places(window_points)
      integer :: j, k, factor

      factor = column_index(table, 'factor')
      is_good = unfolded_rows(table)
      do k = 1, size(sides)
         side = sides(k)
         places = window_places(centre, width, side)
         do j = 1, window_points
            rows(j) = good_row(table, factor, is_good, places(j))
         end do
         if (all(rows > 0)) return
      end do
      rows = 0
      side = both_sides
   end subroutine rows_of_window

   !> Reduces a table to the states of the windows of its case, numbered from 0.
   pure subroutine states_of_windows(windows, table)
      real(wp), intent(in) :: windows(:, :)    !! (centre and half width, window) [swept value]
      type(table_t), intent(inout) :: table
      logical :: is_kept(size(table%values, 2))
      integer :: rows(window_points), side, k, j

      is_kept = .false.
      do k = 1, size(windows, 2)
         call rows_of_window(table, windows(1, k), windows(2, k), rows, side)
         do j = 1, window_points
            if (rows(j) > 0) is_kept(rows(j)) = .true.
         end do
      end do
      call keep_rows(is_kept, table)
      do k = 1, size(table%values, 2)
         table%values(1, k) = k - 1
      end do
   end subroutine states_of_windows

   !> Reads the slope of one column over another one, over a window around a swept value. Creates no strings.
   pure subroutine read_slope(table, column, over, centre, width, half, slope, reason, states, undefined)
      type(table_t), intent(in) :: table
      integer, intent(in) :: column, over      !! indices of the columns of y and x
      real(wp), intent(in) :: centre           !! swept value in the middle of the window
      real(wp), intent(in) :: width            !! half width of the window [swept value]
      real(wp), intent(in) :: half             !! half width of the window, in the unit of x
      real(wp), intent(out) :: slope           !! [unit of y per unit of x]; NaN without a value
      integer, intent(out) :: reason           !! is_read, or why there is no value
      integer, intent(out) :: states           !! number of states that are read and at which y has a value
      integer, intent(out) :: undefined        !! number of states in the window at which x or y has no value
      integer :: rows(window_points), side
      logical :: has_value(window_points), is_found

      slope = ieee_value(1.0_wp, ieee_quiet_nan)
      states = 0
      undefined = 0
      call rows_of_window(table, centre, width, rows, side)
      if (any(rows == 0)) then
         reason = is_outside
         if (.not. (table%is_along_arc .or. table%is_of_rows)) return
         call fit_rows(table, column, over, centre, half, slope, reason, states, undefined)
         return
      end if
      has_value = ieee_is_finite(table%values(column, rows)) .and. ieee_is_finite(table%values(over, rows))
      states = count(has_value)
      undefined = window_points - states
      reason = is_undefined
      if (undefined > 0) return
      call window_slope(table%values(over, rows), table%values(column, rows), half, side, slope, is_found)
      reason = merge(is_read, is_flat, is_found)
      if (.not. is_found) slope = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine read_slope

   !> The half width of a window in the swept value, for a slope over a column that is not known to be in proportion to it. The
   !> change of the column at the middle gives the width; it is rounded to a quarter of an octave, so that the increments of the case
   !> have no influence (ek_window needs no exact width). `half` if the column does not change.
   pure real(wp) function usual_width(table, over, centre, half) result(width)
      type(table_t), intent(in) :: table
      integer, intent(in) :: over              !! index of the column; 0: the table does not have it
      real(wp), intent(in) :: centre           !! swept value in the middle
      real(wp), intent(in) :: half             !! half width, in the unit of the column
      logical :: is_good(size(table%values, 2))
      integer, allocatable :: rows(:)
      integer :: factor, k, near

      width = half
      factor = column_index(table, 'factor')
      if (min(factor, over) == 0) return
      is_good = unfolded_rows(table) .and. ieee_is_finite(table%values(over, :))
      rows = pack([(k, k=1, size(is_good))], is_good)
      if (size(rows) < 2) return
      near = minloc(abs(table%values(factor, rows) - centre), dim=1)
      associate (a => table%values(:, rows(max(near - 1, 1))), b => table%values(:, rows(min(near + 1, size(rows)))))
         if (.not. (abs(b(over) - a(over)) > 0.0_wp .and. abs(b(factor) - a(factor)) > 0.0_wp)) return
         width = half*abs((b(factor) - a(factor))/(b(over) - a(over)))
      end associate
      width = 2.0_wp**(0.25_wp*anint(4.0_wp*log(width)/log(2.0_wp)))
   end function usual_width

   !> Fits the least-squares line through the states in a window, for states that are not at chosen swept values.
   pure subroutine fit_rows(table, column, over, centre, half, slope, reason, states, undefined)
      type(table_t), intent(in) :: table
      integer, intent(in) :: column, over
      real(wp), intent(in) :: centre, half     !! swept value in the middle; half width, in the unit of x
      real(wp), intent(inout) :: slope
      integer, intent(out) :: reason, states, undefined
      real(wp), parameter :: rim = 1.0_wp + 1.0e-6_wp      !! a state nominally on the edge is inside: travel is driven to 1e-7 mm
      logical :: is_inside(size(table%values, 2))
      real(wp) :: x(size(table%values, 2)), y(size(table%values, 2)), mean(2), middle, spread

      states = 0
      undefined = 0
      x = table%values(over, :)
      y = table%values(column, :)
      reason = is_outside
      if (row_at(table, centre) == 0) return
      middle = value_at_place(table, over, centre)
      reason = is_undefined
      if (.not. ieee_is_finite(middle)) return
      reason = has_few_states
      is_inside = unfolded_rows(table) .and. ieee_is_finite(x)
      where (is_inside) is_inside = abs(x - middle) <= half*rim
      states = count(is_inside .and. ieee_is_finite(y))
      undefined = count(is_inside) - states
      if (undefined > 0) reason = is_undefined
      if (undefined > 0 .or. states < min_points) return
      reason = is_flat
      if (maxval(x, mask=is_inside) - minval(x, mask=is_inside) <= 1.0e-3_wp*half) return
      mean = [sum(x, mask=is_inside), sum(y, mask=is_inside)]/states
      spread = sum((x - mean(1))**2, mask=is_inside)
      slope = sum((x - mean(1))*(y - mean(2)), mask=is_inside)/spread
      reason = is_read
   end subroutine fit_rows

   !> Value of column y where column x has a given value: that of the state there, at which the path of the case has stopped
   !> (ek_value_stops). NaN without such a state.
   pure real(wp) function value_where(table, x, at, y) result(value)
      type(table_t), intent(in) :: table
      integer, intent(in) :: x, y                          !! indices of the columns
      real(wp), intent(in) :: at                           !! given value, one of the stops of the table
      integer :: row

      value = ieee_value(1.0_wp, ieee_quiet_nan)
      row = stop_row(table, x, at)
      if (row > 0 .and. y > 0) value = table%values(y, row)
   end function value_where

end module ek_table_reading
