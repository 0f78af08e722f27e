!> A response that a study reads from the table of a design: a value, a slope or a span, and its column name.
!>
!> A slope has the units of the report: deg/m over wheel travel, per kN over a force, per 100 N m over a moment,
!> otherwise those of its two columns; its column name ends with the unit.
module ek_response
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str, quoted, nearest_name, plural
   use ek_quantity, only: slope_unit
   use ek_table, only: table_t, column_index, name_length
   use ek_study, only: response_t
   implicit none(type, external)
   private
   public :: reading_t, needed_columns, no_column, prepare_reading, read_response

   !> A response, prepared for tables with given columns.
   type :: reading_t
      type(response_t) :: asked
      character(:), allocatable :: over      !! slope: the column over which it is taken
      character(:), allocatable :: head      !! name of its column, with the unit of a slope
      real(wp) :: size = 1.0_wp              !! factor from the slope in units of the columns
   end type reading_t

   character(*), parameter :: travel = 'wheel_travel_mm'

contains

   !> The columns from which a response may be read.
   subroutine needed_columns(asked, names)
      type(response_t), intent(in) :: asked
      character(*), intent(inout), allocatable :: names(:)      !! those that are needed are added
      integer :: mark

      call add(asked%column)
      if (asked%of /= 'slope') return
      call add(asked%over)
      if (asked%over /= '') return
      call add(travel)                                          ! as in usual_over
      call add('left_'//travel)
      mark = index(asked%column, '_')
      call add(asked%column(:mark)//travel)

   contains

      subroutine add(name)
         character(*), intent(in) :: name
         if (.not. any(names == name)) names = [character(len(names)) :: names, name]
      end subroutine add

   end subroutine needed_columns

   !> Checks a response against the table of the first design; `message` gives the reason if it cannot be read, else ''.
   subroutine prepare_reading(asked, table, factor_unit, reading, message, heads)
      type(response_t), intent(in) :: asked
      type(table_t), intent(in) :: table
      character(*), intent(in) :: factor_unit             !! of the column `factor`: 'mm', 'deg', 'N', 'N m', '-'
      type(reading_t), intent(out) :: reading
      character(:), allocatable, intent(out) :: message
      character(*), intent(in), optional :: heads(:)      !! all columns of the results, for suggestions; default those of the table
      character(name_length), allocatable :: names(:)
      character(:), allocatable :: unit
      real(wp) :: value
      integer :: at

      reading%asked = asked
      reading%over = asked%over
      reading%head = asked%name
      names = table%columns
      if (present(heads)) names = heads
      message = ''
      if (column_index(table, asked%column) == 0) message = no_column(asked%column, names)
      if (asked%of == 'slope') then
         if (reading%over == '') reading%over = usual_over(asked%column, table)
         if (message == '' .and. column_index(table, reading%over) == 0) then
            message = no_column(reading%over, names)
            if (asked%over == '') message = "give 'over': the results have no wheel travel, over which a slope is taken by default"
         end if
         call slope_unit(asked%column, reading%over, factor_unit, unit, reading%size)
         at = len(asked%name) - len(unit)
         if (index(asked%name, '_'//unit, back=.true.) /= max(at, 1)) reading%head = asked%name//'_'//unit
      end if
      if (message == '') call read_response(reading, table, value, message)
      if (message /= '') message = asked%where//': response '//quoted(asked%name)//': '//message
   end subroutine prepare_reading

   !> A response of one table: the value at a factor (linear between states), the least-squares slope in a window
   !> around it, or the span over all states. `message` gives the reason if there is no slope or no such factor.
   subroutine read_response(reading, table, value, message)
      type(reading_t), intent(in) :: reading
      type(table_t), intent(in) :: table
      real(wp), intent(out) :: value             !! nan if there is none
      character(:), allocatable, intent(out) :: message
      real(wp), parameter :: rounding = 1.0e-9_wp      ! of the range of a case, after conversion to SI
      real(wp) :: at, centre, mean_x, mean_y, spread
      real(wp) :: x(size(table%values, 2)), y(size(table%values, 2))
      logical :: is_near(size(table%values, 2))
      integer :: column, over

      message = ''
      value = ieee_value(1.0_wp, ieee_quiet_nan)
      column = column_index(table, reading%asked%column)
      over = 2                                   ! the factor
      if (reading%asked%of == 'slope') over = column_index(table, reading%over)
      if (column == 0) message = no_column(reading%asked%column, table%columns)
      if (over == 0) message = no_column(reading%over, table%columns)
      if (message /= '') return                  ! the model of this design does not define it
      y = table%values(column, :)
      if (reading%asked%of == 'span') then
         value = maxval(y) - minval(y)
         return
      end if
      x = table%values(2, :)
      at = reading%asked%at
      if (abs(at - minval(x)) <= rounding*(maxval(x) - minval(x))) at = minval(x)
      if (abs(at - maxval(x)) <= rounding*(maxval(x) - minval(x))) at = maxval(x)
      if (.not. (at >= minval(x) .and. at <= maxval(x))) then
         message = 'at = '//str(reading%asked%at)//' lies outside the range of the case, '// &
            str(minval(x))//' to '//str(maxval(x))
         return
      end if
      if (reading%asked%of == 'value') then
         value = between(x, y, at)
         return
      end if
      centre = between(x, table%values(over, :), at)
      x = table%values(over, :)
      if (.not. ieee_is_finite(centre)) return          ! the state did not converge, or the column is undefined there
      is_near = ieee_is_finite(x)
      where (is_near) is_near = abs(x - centre) <= reading%asked%window*(1.0_wp + rounding)
      if (count(is_near) < 2) then
         message = 'no slope: '//plural(count(is_near), 'state lies', 'states lie')//' within the window of ± '// &
            str(reading%asked%window)//', a slope needs 2; '//remedy(abs(x - centre), reading%asked%window)
         return
      end if
      mean_x = sum(x, mask=is_near)/count(is_near)
      mean_y = sum(y, mask=is_near)/count(is_near)
      spread = sum((x - mean_x)**2, mask=is_near)
      if (spread > 0.0_wp) then
         value = reading%size*sum((x - mean_x)*(y - mean_y), mask=is_near)/spread
      else
         message = 'no slope: '//quoted(reading%over)//' does not change within the window'
      end if
   end subroutine read_response

   !> Advice on how to have two states in the window.
   pure function remedy(distance, window) result(words)
      real(wp), intent(in) :: distance(:)      !! of the states from the centre of the window
      real(wp), intent(in) :: window
      character(:), allocatable :: words
      real(wp) :: second, unit
      logical :: is_left(size(distance))

      words = 'use more increments in the case'
      is_left = ieee_is_finite(distance)
      if (count(is_left) < 2) return
      is_left(minloc(distance, dim=1, mask=is_left)) = .false.
      second = minval(distance, mask=is_left)
      unit = 10.0_wp**(floor(log10(second)) - 2)          ! of the third digit
      words = 'use at least '//str(ceiling(second/window))//' times as many increments in the case, or a window of '// &
         str(ceiling(second/unit*(1.0_wp - 1.0e-9_wp))*unit, 3)//' or more in the response'
   end function remedy

   !> The default column over which a slope is taken: the travel of the only wheel; with two wheels, that on the side of the
   !> column, or else of the left wheel.
   pure function usual_over(column, table) result(over)
      character(*), intent(in) :: column
      type(table_t), intent(in) :: table
      character(:), allocatable :: over
      integer :: mark

      over = travel
      if (column_index(table, travel) > 0) return
      over = 'left_'//travel
      mark = index(column, '_')
      if (mark == 0) return
      if (column_index(table, column(:mark)//travel) > 0) over = column(:mark)//travel
   end function usual_over

   !> The message about a missing column, with a suggestion.
   pure function no_column(name, heads) result(words)
      character(*), intent(in) :: name, heads(:)
      character(:), allocatable :: words

      words = nearest_name(name, heads)
      if (words /= '') words = ' (did you mean '//quoted(words)//'?)'
      words = 'the results have no column '//quoted(name)//words
   end function no_column

   !> y at x = at, linear between the rows; NaN outside their range.
   pure real(wp) function between(x, y, at)
      real(wp), intent(in) :: x(:), y(:), at
      integer :: k

      between = ieee_value(1.0_wp, ieee_quiet_nan)
      do k = 1, size(x)
         if (abs(x(k) - at) <= 0.0_wp) then
            between = y(k)
            return
         end if
         if (k == size(x)) exit
         if ((x(k) - at)*(x(k + 1) - at) < 0.0_wp) then
            between = y(k) + (y(k + 1) - y(k))*(at - x(k))/(x(k + 1) - x(k))
            return
         end if
      end do
   end function between

end module ek_response
