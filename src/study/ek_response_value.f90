!> Reads the value of a response from the table of a design. The value is a value at a swept value, a slope, a span, an extreme, the
!> deviation from a given curve, or a gradient of the report. ek_response has found the columns in the table of the design of the
!> deck. The responses of every design are read from these columns.
module ek_response_value
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite
   use ek_kinds, only: wp
   use ek_table, only: table_t, column_index, scheduled_rows
   use ek_window, only: window_points
   use ek_case, only: case_t, add_place, add_window
   use ek_table_reading, only: value_at_place, read_slope, rows_of_window, row_at, is_read, of_window_outside => is_outside, &
      of_window_undefined => is_undefined, of_window_flat => is_flat
   use ek_study, only: response_t
   implicit none(type, external)
   private
   public :: reading_t, read_response, mark_states, reads_all_states, stop_where_read, is_difference, is_slope, place_of_column

   !> A response, prepared for tables with given columns.
   type :: reading_t
      type(response_t) :: asked
      character(:), allocatable :: over      !! slope, gradient: name of the column over which it is taken
      character(:), allocatable :: head      !! column heading of the response, with the unit
      real(wp) :: size = 1.0_wp !! slope: factor from the units of the columns to the units of the response; gradient: its sign
      real(wp) :: width = 0.0_wp             !! slope, gradient: half width of the window [swept value]
      real(wp) :: noise = 0.0_wp !! gradient: a change of the column over half the window up to this number is rounded to zero
      integer :: of = 0                      !! kind of response, one of the constants below
      integer :: at_column = 0, at_over = 0  !! indices of the columns in the table of the design of the deck
      real(wp), allocatable :: curve(:, :)   !! rms: (swept value, given value; point)
   end type reading_t

   ! what is read: numbers of of_names
   integer, parameter, public :: a_value = 1, a_slope = 2, a_span = 3, a_least = 4, a_most = 5, an_rms = 6, a_gradient = 7, &
      a_difference = 8

   ! why it cannot be read
   integer, parameter, public :: no_fault = 0, column_is_missing = 1, over_is_missing = 2, is_outside = 3, &
      window_is_outside = 4, is_flat = 5, has_few_states = 6, is_undefined = 7, is_between = 8

   real(wp), parameter :: rounding = 1.0e-9_wp      !! of the range of a case, after conversion to SI

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

   !> Reads a response from one table, as ek_table_reading reads it. A value is that of the state at a swept value. A slope is read over a
   !> window around the swept value, a gradient over a window around design. A span or an extreme is read over all states of the
   !> schedule, and rms is the root mean square of the deviations from a curve at its points. The response has no value if the column
   !> is undefined at a state that is read. (minval and maxval would ignore such a state.)
   subroutine read_value(reading, table, value, fault)
      type(reading_t), intent(in) :: reading
      type(table_t), intent(in) :: table
      real(wp), intent(out) :: value             !! NaN if the response has no value
      integer, intent(out) :: fault              !! 0, or the reason code for fault_text
      real(wp) :: sum
      integer :: column, over, reason, states, undefined, k

      fault = no_fault
      value = ieee_value(1.0_wp, ieee_quiet_nan)
      column = place_of_column(table, reading%asked%column, reading%at_column)
      over = 2                                   ! the factor
      if (is_slope(reading)) over = place_of_column(table, reading%over, reading%at_over)
      if (column == 0) fault = column_is_missing
      if (over == 0) fault = over_is_missing
      if (fault /= no_fault) return              ! the model of this design does not define it
      select case (reading%of)
      case (a_span, a_least, a_most)
         associate (y => table%values(column, :), is_scheduled => scheduled_rows(table))
            if (any(is_scheduled .and. .not. ieee_is_finite(y))) return
            if (reading%of == a_span) value = maxval(y, mask=is_scheduled) - minval(y, mask=is_scheduled)
            if (reading%of == a_least) value = minval(y, mask=is_scheduled)
            if (reading%of == a_most) value = maxval(y, mask=is_scheduled)
         end associate
      case (a_value)
         call read_at(reading%asked%at, value)
      case (an_rms)
         sum = 0.0_wp
         do k = 1, size(reading%curve, 2)
            call read_at(reading%curve(1, k), value)
            sum = sum + (value - reading%curve(2, k))**2
         end do
         value = sqrt(sum/size(reading%curve, 2))
         if (fault /= no_fault) value = ieee_value(1.0_wp, ieee_quiet_nan)
      case default
         call read_slope(table, column, over, centre_of(reading), reading%width, reading%asked%window, value, reason, states, &
            undefined)
         select case (reason)
         case (is_read)
            if (reading%of == a_gradient .and. abs(value)*reading%asked%window <= reading%noise) value = 0.0_wp
         case (of_window_outside)
            fault = merge(is_outside, window_is_outside, lies_outside(centre_of(reading)))
         case (of_window_undefined)
            fault = is_undefined
         case (of_window_flat)
            fault = is_flat
         case default
            fault = has_few_states
         end select
         value = value*reading%size
      end select

   contains

      !> Reads the column at a swept value.
      subroutine read_at(place, value)
         real(wp), intent(in) :: place
         real(wp), intent(out) :: value

         value = value_at_place(table, column, place)
         if (ieee_is_finite(value) .or. row_at(table, place) > 0) return
         if (lies_outside(place)) then
            fault = is_outside
         else if (table%is_of_rows) then
            fault = is_between
         end if
      end subroutine read_at

      !> Whether a swept value lies outside the range of the case.
      pure logical function lies_outside(place)
         real(wp), intent(in) :: place
         real(wp) :: low, high

         low = minval(table%values(2, :))
         high = maxval(table%values(2, :))
         lies_outside = place < low - rounding*(high - low) .or. place > high + rounding*(high - low)
      end function lies_outside

   end subroutine read_value

   !> The swept value in the middle of the window of a slope. The window of a gradient lies around design.
   pure real(wp) function centre_of(reading) result(centre)
      type(reading_t), intent(in) :: reading
      centre = 0.0_wp
      if (reading%of == a_slope) centre = reading%asked%at
   end function centre_of

   !> Adds the swept values at which a response is read to the stops of its case.
   pure subroutine stop_where_read(reading, case)
      type(reading_t), intent(in) :: reading
      type(case_t), intent(inout) :: case
      integer :: k

      select case (reading%of)
      case (a_value)
         call add_place(reading%asked%at, case)
      case (an_rms)
         do k = 1, size(reading%curve, 2)
            call add_place(reading%curve(1, k), case)
         end do
      case (a_slope, a_gradient)
         call add_window(centre_of(reading), reading%width, case)
      end select
   end subroutine stop_where_read

   !> Whether a response reads its column at every state of the schedule.
   pure logical function reads_all_states(reading)
      type(reading_t), intent(in) :: reading
      reads_all_states = reading%of == a_span .or. reading%of == a_least .or. reading%of == a_most
   end function reads_all_states

   !> Marks the states at which read_response reads the column of a response: the state of a value, the states in the window of a
   !> slope, the states at the points of a curve. For all other kinds, and for a slope over the rows of a load table, all states are
   !> marked (see reads_all_states).
   pure subroutine mark_states(reading, table, is_marked)
      type(reading_t), intent(in) :: reading
      type(table_t), intent(in) :: table         !! swept values, and the column over which a slope is taken
      logical, intent(inout) :: is_marked(:)     !! whether each state is read; marks of other states are unchanged
      integer :: rows(window_points), side, k

      if (is_difference(reading)) return
      if (reads_all_states(reading)) then
         is_marked = is_marked .or. scheduled_rows(table)
      else if (reading%of == an_rms) then
         do k = 1, size(reading%curve, 2)
            call mark(row_at(table, reading%curve(1, k)), is_marked)
         end do
      else if (reading%of == a_value) then
         call mark(row_at(table, reading%asked%at), is_marked)
      else
         call rows_of_window(table, centre_of(reading), reading%width, rows, side)
         if (any(rows == 0)) is_marked = is_marked .or. table%is_of_rows
         do k = 1, window_points
            call mark(rows(k), is_marked)
         end do
      end if

   contains

      pure subroutine mark(row, is_marked)
         integer, intent(in) :: row              !! 0: none
         logical, intent(inout) :: is_marked(:)
         if (row > 0) is_marked(row) = .true.
      end subroutine mark

   end subroutine mark_states

   !> Whether a response is the difference of two other responses. A difference is not read from a table.
   pure logical function is_difference(reading)
      type(reading_t), intent(in) :: reading
      is_difference = reading%of == a_difference
   end function is_difference

   !> Whether a response is a slope or a gradient over a window.
   pure logical function is_slope(reading)
      type(reading_t), intent(in) :: reading
      is_slope = reading%of == a_slope .or. reading%of == a_gradient
   end function is_slope

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

end module ek_response_value
