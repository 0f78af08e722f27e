!> The reason why a key number has no value in the tables of its tests. Every caller that meets a key number without a value
!> (report, run, solve, fit, interfaces) gives the reason of this module.
module ek_missing_number
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_table, only: table_t, column_index, column_range, name_length, row_count, stop_row
   use ek_test_result, only: design_row, state_range
   use ek_table_reading, only: row_at
   use ek_gradient, only: fit_slope, slope_note, lacks_rate, rate_reason
   use ek_key_number, only: key_number_t, at_design, slope, anti_phase, at_place, to_contact, largest_of_all
   implicit none(type, external)
   private
   public :: missing_reason, missing_value

contains

   !> The reason why a key number has no value under its condition: 'only 1 of at least 3 states in the window'. Creates strings.
   function missing_reason(number, wheel, source, table) result(text)
      type(key_number_t), intent(in) :: number
      integer, intent(in) :: wheel              !! 1: left or single wheel, or axle; 2: right
      integer, intent(in) :: source             !! index of the source whose table is given
      type(table_t), intent(in) :: table        !! table of its test; without columns: the test was not solved
      character(:), allocatable :: text
      character(name_length) :: column
      real(wp) :: value
      integer :: place, over, points, undefined, reason

      column = number%sources(source)%column(wheel)
      if (column == '') column = number%sources(source)%column(3 - wheel)
      place = 0
      if (allocated(table%columns)) place = column_index(table, trim(column))
      over = 0
      if (place > 0 .and. number%sources(source)%over(wheel) /= '') over = column_index(table, &
         trim(number%sources(source)%over(wheel)))
      if (.not. allocated(table%columns)) then
         text = 'the test was not solved'
      else if (place == 0) then
         text = 'the model does not define '//trim(column)
      else if (lacks_rate(table, trim(column))) then
         text = rate_reason(table)
      else if (number%how >= slope .and. number%how <= anti_phase) then
         text = 'the model does not define '//trim(number%sources(source)%over(wheel))
         if (over > 0) then
            call fit_slope(table, place, over, number%sources(source)%factor_size, number%sources(source)%width, &
               number%sources(source)%half, value, reason, points, undefined)
            text = slope_note(table, reason, points, undefined, trim(column), trim(table%columns(over)), .true.)
         end if
      else if (number%how == at_design .or. number%how == to_contact .and. design_row(table) == 0) then
         text = missing_value(table, trim(column), 'factor', 0.0_wp)
      else if (number%how == at_place .or. number%how == to_contact) then
         text = missing_value(table, trim(column), trim(number%sources(source)%over(wheel)), number%sources(source)%wanted(wheel))
      else
         text = trim(column)//' is not a number (nan) at any state'
      end if
   end function missing_reason

   !> The reason why a column has no value where another column has a given value: the states do not reach this value, or the
   !> column is not defined there. Creates strings.
   function missing_value(table, column, over, at) result(text)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: column, over
      real(wp), intent(in) :: at                !! value of the column `over`, in its unit
      character(:), allocatable :: text

      if (over /= 'factor') then
         text = over//' does not reach '//str(at, 4)//range_of(table)
         if (has_passed(table, over, at)) text = 'no state was found where '//over//' is '//str(at, 4)
         if (table%is_of_rows) text = 'no row of the case has '//over//' = '//str(at, 4)
         if (stop_row(table, column_index(table, over), at) > 0) text = column//' is not a number (nan) where '//over//' is '// &
            str(at, 4)
      else if (lacks_rate(table, column)) then
         text = rate_reason(table)
      else if (row_at(table, at) > 0) then
         text = column//' is not a number (nan) at this state'
      else if (abs(at) > 0.0_wp) then
         text = 'no state at '//str(at, 6)//range_of(table)
      else
         text = no_design(table)
      end if
   end function missing_value

   !> Whether a column has values on both sides of a value.
   pure logical function has_passed(table, column, at)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: column
      real(wp), intent(in) :: at
      real(wp) :: range(2)

      range = column_range(table, column)
      has_passed = all(ieee_is_finite(range))
      if (has_passed) has_passed = range(1) <= at .and. at <= range(2)
   end function has_passed

   !> Why a table has no design state: it did not converge, or it lies outside the states.
   function no_design(table) result(text)
      type(table_t), intent(in) :: table
      character(:), allocatable :: text
      integer :: factor

      factor = column_index(table, 'factor')
      text = 'no state at design'//range_of(table)
      if (factor == 0 .or. row_count(table) == 0) return
      if (any(abs(table%values(factor, :)) <= 0.0_wp)) text = 'the state at design did not converge'
   end function no_design

   !> The range of the states of a table: ' (the states are from 20 to 100)'; '' without a state.
   function range_of(table) result(text)
      type(table_t), intent(in) :: table
      character(:), allocatable :: text
      real(wp) :: range(2)

      range = state_range(table)
      text = ''
      if (ieee_is_finite(range(1))) text = ' (the states are from '//str(range(1), 6)//' to '//str(range(2), 6)//')'
   end function range_of

end module ek_missing_number
