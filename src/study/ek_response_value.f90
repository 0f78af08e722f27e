!> Reads the value of a response from the table of a design. The value is a value at a swept value, a slope, a span, an extreme, the
!> deviation from a given curve, or a gradient of the report. ek_response has found the columns in the table of the design of the
!> deck. The responses of every design are read from these columns.
module ek_response_value
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite
   use ek_kinds, only: wp
   use ek_table, only: table_t, column_index
   use ek_gradient, only: slope_over_window
   use ek_study, only: response_t
   implicit none(type, external)
   private
   public :: reading_t, read_response, mark_states, reads_all_states, is_difference, is_slope, find_window, unplaced_states, &
      mark_neighbours, rounded, place_of_column

   !> A response, prepared for tables with given columns.
   type :: reading_t
      type(response_t) :: asked
      character(:), allocatable :: over      !! slope, gradient: name of the column over which it is taken
      character(:), allocatable :: head      !! column heading of the response, with the unit
      real(wp) :: size = 1.0_wp !! slope: factor from the units of the columns to the units of the response; gradient: its sign
      real(wp) :: noise = 0.0_wp !! gradient: a change of the column over half the window up to this number is rounded to zero
      integer :: of = 0                      !! kind of response, one of the constants below
      integer :: at_column = 0, at_over = 0, at_converged = 0     !! indices of the columns in the table of the design of the deck
      real(wp), allocatable :: curve(:, :)   !! rms: (swept value, given value; point)
   end type reading_t

   ! what is read: numbers of of_names
   integer, parameter, public :: a_value = 1, a_slope = 2, a_span = 3, a_least = 4, a_most = 5, an_rms = 6, a_gradient = 7, &
      a_difference = 8

   ! why it cannot be read
   integer, parameter, public :: no_fault = 0, column_is_missing = 1, over_is_missing = 2, is_outside = 3, has_no_slope = 4, &
      is_flat = 5, has_few_states = 6, is_undefined = 7

contains

   !> Reads a response from a table, or finds the reason why the response has no value.
   subroutine read_response(reading, table, value, fault)
      type(reading_t), intent(in) :: reading
      type(table_t), intent(in) :: table
      real(wp), intent(out) :: value             !! NaN if the response has no value
      integer, intent(out) :: fault              !! 0, or the reason code for fault_text

      call read_value(reading, table, value, fault)
      if (fault == no_fault .and. .not. ieee_is_finite(value)) fault = is_undefined
   end subroutine read_response

   !> Reads a response from one table. A value is read at a swept value, linear between states. A slope is the least-squares slope
   !> in a window around the swept value. A gradient is the slope that the report computes, over a window around design. A span or
   !> an extreme is read over all states, and rms is the root mean square of the deviations from a curve at its points.
   !> The response has no value if the column is undefined at a state that is read. (minval and maxval would ignore such a state.)
   subroutine read_value(reading, table, value, fault)
      type(reading_t), intent(in) :: reading
      type(table_t), intent(in) :: table
      real(wp), intent(out) :: value             !! NaN if the response has no value
      integer, intent(out) :: fault              !! 0, or the reason code for fault_text
      real(wp) :: at, centre, spread, low, high
      integer :: points, undefined
      real(wp) :: x(size(table%values, 2)), y(size(table%values, 2))
      logical :: is_near(size(table%values, 2))
      integer :: column, over, k

      fault = no_fault
      value = ieee_value(1.0_wp, ieee_quiet_nan)
      column = place_of_column(table, reading%asked%column, reading%at_column)
      over = 2                                   ! the factor
      if (is_slope(reading)) over = place_of_column(table, reading%over, reading%at_over)
      if (column == 0) fault = column_is_missing
      if (over == 0) fault = over_is_missing
      if (fault /= no_fault) return              ! the model of this design does not define it
      y = table%values(column, :)
      x = table%values(2, :)
      select case (reading%of)
      case (a_span, a_least, a_most)
         if (.not. all(ieee_is_finite(y))) return
         if (reading%of == a_span) value = maxval(y) - minval(y)
         if (reading%of == a_least) value = minval(y)
         if (reading%of == a_most) value = maxval(y)
      case (a_gradient)
         call slope_over_window(table%values(over, :), y, reading%asked%window, value, points, undefined)
         if (undefined > 0) return
         if (ieee_is_finite(value)) then
            if (abs(value)*reading%asked%window <= reading%noise) value = 0.0_wp
         else
            fault = merge(has_few_states, is_flat, points < 3)
         end if
         value = value*reading%size
      case (an_rms)
         spread = 0.0_wp
         do k = 1, size(reading%curve, 2)
            at = between(x, y, rounded(reading%curve(1, k), x))
            if (reading%curve(1, k) < minval(x) .or. reading%curve(1, k) > maxval(x)) fault = is_outside
            spread = spread + (at - reading%curve(2, k))**2
         end do
         if (fault == no_fault) value = sqrt(spread/size(reading%curve, 2))
      case default
         call find_ends(x, low, high)
         at = nearest_end(reading%asked%at, low, high)
         if (.not. (at >= low .and. at <= high)) then
            fault = is_outside
            return
         end if
         if (reading%of == a_value) then
            value = between(x, y, at)
            return
         end if
         call find_window(reading, table, over, at, centre, is_near)
         x = table%values(over, :)
         if (.not. ieee_is_finite(centre)) return       ! the state did not converge, or the column is undefined there
         if (any(unplaced_states(reading, table, over, is_near))) return
         if (count(is_near) < 2) then
            fault = has_no_slope
            return
         end if
         call fit_line(x, y, is_near, value, spread)
         if (spread > 0.0_wp) then
            value = reading%size*value/spread
         else
            value = ieee_value(1.0_wp, ieee_quiet_nan)
            fault = is_flat
         end if
      end select
   end subroutine read_value

   !> Whether a response counts as reading its column at every state: span, min, max and gradient. A gradient reads only the states
   !> in its window, but its columns need no compliance matrix.
   pure logical function reads_all_states(reading)
      type(reading_t), intent(in) :: reading
      reads_all_states = reading%of == a_span .or. reading%of == a_least .or. reading%of == a_most .or. reading%of == a_gradient
   end function reads_all_states

   !> Marks the states at which read_response reads the column of a response. For a value, these are its neighbours; for a slope,
   !> the states in its window; for rms, the neighbours of each point of the curve. For all other kinds, all states are marked (see
   !> reads_all_states).
   pure subroutine mark_states(reading, table, is_read)
      type(reading_t), intent(in) :: reading
      type(table_t), intent(in) :: table         !! swept values, and the column over which a slope is taken
      logical, intent(inout) :: is_read(:)       !! whether each state is read; marks of other states are unchanged
      logical :: is_near(size(is_read))
      real(wp) :: x(size(is_read)), centre
      integer :: over, k

      if (is_difference(reading)) return
      x = table%values(2, :)
      if (reads_all_states(reading)) then
         is_read = .true.
      else if (reading%of == an_rms) then
         do k = 1, size(reading%curve, 2)
            call mark_neighbours(x, rounded(reading%curve(1, k), x), is_read)
         end do
      else if (reading%of == a_value) then
         call mark_neighbours(x, rounded(reading%asked%at, x), is_read)
      else
         over = place_of_column(table, reading%over, reading%at_over)
         if (over == 0) return                   ! the model of this design does not define it
         call find_window(reading, table, over, rounded(reading%asked%at, x), centre, is_near)
         is_read = is_read .or. is_near
      end if
   end subroutine mark_states

   !> Marks the states from which `between` interpolates the value at the swept value x = at.
   pure subroutine mark_neighbours(x, at, is_read)
      real(wp), intent(in) :: x(:), at
      logical, intent(inout) :: is_read(:)
      integer :: first, last

      call neighbours(x, at, first, last)
      if (first > 0) is_read(first:last) = .true.
   end subroutine mark_neighbours

   !> Whether a response is the difference of two other responses. A difference is not read from a table.
   pure logical function is_difference(reading)
      type(reading_t), intent(in) :: reading
      is_difference = reading%of == a_difference
   end function is_difference

   !> Computes the sums `along` and `spread` of the least-squares line through the selected points. The slope of the line is
   !> along/spread.
   pure subroutine fit_line(x, y, is_near, along, spread)
      real(wp), contiguous, intent(in) :: x(:), y(:)
      logical, contiguous, intent(in) :: is_near(:)      !! whether each point is selected
      real(wp), intent(out) :: along, spread             !! Σ (x − mean x)(y − mean y), Σ (x − mean x)²
      real(wp) :: mean_x, mean_y
      integer :: k, points

      points = 0
      mean_x = 0.0_wp
      mean_y = 0.0_wp
      do k = 1, size(x)
         if (.not. is_near(k)) cycle
         points = points + 1
         mean_x = mean_x + x(k)
         mean_y = mean_y + y(k)
      end do
      mean_x = mean_x/points
      mean_y = mean_y/points
      along = 0.0_wp
      spread = 0.0_wp
      do k = 1, size(x)
         if (.not. is_near(k)) cycle
         spread = spread + (x(k) - mean_x)**2
         along = along + (x(k) - mean_x)*(y(k) - mean_y)
      end do
   end subroutine fit_line

   !> Whether a response is a slope or a gradient over a window.
   pure logical function is_slope(reading)
      type(reading_t), intent(in) :: reading
      is_slope = reading%of == a_slope .or. reading%of == a_gradient
   end function is_slope

   !> Finds the states in the window of a slope. No state is found if the centre of the window has no value.
   pure subroutine find_window(reading, table, over, at, centre, is_near)
      type(reading_t), intent(in) :: reading
      type(table_t), intent(in) :: table
      integer, intent(in) :: over                !! column over which the slope is taken
      real(wp), intent(in) :: at
      real(wp), intent(out) :: centre            !! centre of the window; NaN if it has no value
      logical, intent(out) :: is_near(:)
      real(wp), parameter :: rounding = 1.0e-9_wp
      real(wp) :: x(size(table%values, 2))
      integer :: k

      x = table%values(over, :)
      centre = between(table%values(2, :), x, at)
      is_near = .false.
      if (.not. ieee_is_finite(centre)) return
      do k = 1, size(x)
         is_near(k) = ieee_is_finite(x(k))
         if (is_near(k)) is_near(k) = abs(x(k) - centre) <= reading%asked%window*(1.0_wp + rounding)
      end do
   end subroutine find_window

   !> Whether each state may lie in the window of a slope although the state has no abscissa: the column over which the slope is
   !> taken is undefined. The result is .true. for a converged state next to a state in the window.
   pure function unplaced_states(reading, table, over, is_near) result(is_unplaced)
      type(reading_t), intent(in) :: reading
      type(table_t), intent(in) :: table
      integer, intent(in) :: over                !! column over which the slope is taken
      logical, intent(in) :: is_near(:)          !! result of find_window
      logical :: is_unplaced(size(is_near))
      integer :: converged, k, n

      n = size(is_near)
      is_unplaced = .not. ieee_is_finite(table%values(over, :))
      if (.not. any(is_unplaced)) return
      do k = 1, n
         if (is_unplaced(k)) is_unplaced(k) = is_near(max(k - 1, 1)) .or. is_near(min(k + 1, n))
      end do
      converged = place_of_column(table, 'converged', reading%at_converged)
      if (converged > 0) is_unplaced = is_unplaced .and. table%values(converged, :) > 0.5_wp
      if (converged == 0) is_unplaced = .false.
   end function unplaced_states

   !> The swept value `at`, or an end of the range of x if `at` equals this end within rounding.
   pure real(wp) function rounded(at, x)
      real(wp), intent(in) :: at, x(:)
      real(wp) :: low, high

      call find_ends(x, low, high)
      rounded = nearest_end(at, low, high)
   end function rounded

   !> Finds the smallest and the largest swept value.
   pure subroutine find_ends(x, low, high)
      real(wp), intent(in) :: x(:)
      real(wp), intent(out) :: low, high
      integer :: k

      low = huge(low)
      high = -huge(high)
      do k = 1, size(x)
         low = min(low, x(k))
         high = max(high, x(k))
      end do
   end subroutine find_ends

   !> The swept value `at`, or `low` or `high` if `at` equals this end of the range within rounding.
   pure real(wp) function nearest_end(at, low, high) result(rounded)
      real(wp), intent(in) :: at, low, high
      real(wp), parameter :: rounding = 1.0e-9_wp      ! of the range of a case, after conversion to SI

      rounded = at
      if (abs(at - low) <= rounding*(high - low)) rounded = low
      if (abs(at - high) <= rounding*(high - low)) rounded = high
   end function nearest_end

   !> Index of the column with a name; 0 if the table has no such column. The index `usual`, from the table of the design of the
   !> deck, is tried first.
   pure integer function place_of_column(table, name, usual) result(place)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: name
      integer, intent(in) :: usual
      integer :: letters

      place = usual
      if (place >= 1 .and. place <= size(table%columns)) then
         letters = len_trim(name)                ! a comparison of texts of one length is much the fastest
         if (len_trim(table%columns(place)) == letters) then
            if (table%columns(place)(:letters) == name(:letters)) return
         end if
      end if
      place = column_index(table, name)
   end function place_of_column

   !> Value of y at x = at, linear between the rows; NaN outside the range of x.
   pure real(wp) function between(x, y, at)
      real(wp), intent(in) :: x(:), y(:), at
      integer :: k, next

      between = ieee_value(1.0_wp, ieee_quiet_nan)
      call neighbours(x, at, k, next)
      if (k == 0) return
      between = y(k)
      if (next > k) between = y(k) + (y(next) - y(k))*(at - x(k))/(x(next) - x(k))
   end function between

   !> Finds the row with x = at, or the two rows between which x = at lies.
   pure subroutine neighbours(x, at, first, last)
      real(wp), intent(in) :: x(:), at
      integer, intent(out) :: first, last        !! indices of the rows; 0 outside the range of x
      integer :: k

      first = 0
      last = 0
      do k = 1, size(x)
         if (abs(x(k) - at) <= 0.0_wp) then
            first = k
            last = k
            return
         end if
         if (k == size(x)) exit
         if ((x(k) - at)*(x(k + 1) - at) < 0.0_wp) then
            first = k
            last = k + 1
            return
         end if
      end do
   end subroutine neighbours

end module ek_response_value
