!> A response of a study: the columns that it requires, its column heading, and the reason if it cannot be read from a table. The
!> value of a response is read by ek_response_value.
!>
!> A slope has the units of the report: deg/m over wheel travel, per kN over a force, per 100 N m over a moment, otherwise the units
!> of its two columns. The column heading ends with the unit.
module ek_response
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t
   use ek_text, only: str, quoted, nearest_name, plural
   use ek_rig_test, only: rig_tests
   use ek_quantity, only: slope_unit, unit_of, head_with_unit, column_hint
   use ek_table, only: table_t, column_index, name_length
   use ek_sheet, only: sheet_t, read_sheet, column_of, mistakes_of
   use ek_sheet_columns, only: take_columns
   use ek_unit_row, only: unit_of_heading
   use ek_test_result, only: test_result_t
   use ek_gradient_definition, only: definition_t, definitions_of, windows_t, fitted
   use ek_gradient, only: gradient_t, test_gradients, gradient_noise
   use ek_study, only: response_t, of_names
   use ek_table_reading, only: usual_width, min_points
   use ek_response_value, only: reading_t, read_response, mark_states, is_slope, place_of_column, an_rms, a_gradient, a_slope, &
      a_difference, no_fault, column_is_missing, over_is_missing, is_outside, window_is_outside, has_few_states, is_undefined, &
      is_between
   implicit none(type, external)
   private
   public :: needed_columns, no_column, prepare_reading, prepare_difference, check_reading, fault_text

   character(*), parameter :: travel = 'wheel_travel_mm'

contains

   !> Adds the columns from which a response may be read to a list of columns. A difference needs no column.
   subroutine needed_columns(asked, kind, names)
      type(response_t), intent(in) :: asked
      character(*), intent(in) :: kind                          !! kind of the rig test of its case; '' if the case is not a test
      character(*), intent(inout), allocatable :: names(:)      !! the list
      type(definition_t), allocatable :: list(:)
      integer :: mark, k

      if (asked%of == 'difference') return
      if (asked%of == 'gradient') then
         list = definitions_of(kind)
         do k = 1, size(list)
            if (list(k)%quantity /= asked%column//fitted) cycle
            call add_of_wheels(trim(list(k)%column))
            call add_of_wheels(trim(list(k)%over))
         end do
         call add_of_wheels(travel)                             ! gives the wheels
         return
      end if
      call add(asked%column)
      if (asked%of /= 'slope') return
      call add(asked%over)
      if (asked%over /= '') return
      call add(travel)                                          ! as in usual_over
      call add('left_'//travel)
      mark = index(asked%column, '_')
      call add(asked%column(:mark)//travel)

   contains

      !> Adds a column name, unless the name is already listed.
      subroutine add(name)
         character(*), intent(in) :: name
         if (.not. any(names == name)) names = [character(len(names)) :: names, name]
      end subroutine add

      !> Adds a column name, also with left_ and right_.
      subroutine add_of_wheels(name)
         character(*), intent(in) :: name
         call add(name)
         call add('left_'//name)
         call add('right_'//name)
      end subroutine add_of_wheels

   end subroutine needed_columns

   !> Finds the columns of a response in the table of its case, in the design of the deck, and prepares its reading. `message` gives
   !> the reason if the response cannot be read, and is '' otherwise. The case need not yet stop where the response is read:
   !> check_reading reads the response when it does.
   subroutine prepare_reading(asked, table, factor_unit, reading, message, heads, home, test)
      type(response_t), intent(in) :: asked
      type(table_t), intent(in) :: table
      character(*), intent(in) :: factor_unit             !! unit of the swept value: 'mm', 'deg', 'N', 'N m', '-'
      type(reading_t), intent(out) :: reading
      character(:), allocatable, intent(out) :: message
      character(*), intent(in), optional :: heads(:)      !! all columns of the results, for suggestions; default: the columns of
                                                          !! the table
      character(*), intent(in), optional :: home          !! folder of the study with its slash, for the file of rms
      type(test_result_t), intent(in), optional :: test   !! the case as a test of the report, for a gradient
      character(name_length), allocatable :: names(:)
      character(:), allocatable :: unit
      real(wp) :: size_of_slope

      reading%asked = asked
      reading%over = asked%over
      reading%head = head_with_unit(asked%name, unit_of(asked%column))
      reading%of = findloc(of_names == asked%of, .true., dim=1)
      names = table%columns
      if (present(heads)) names = heads
      message = ''
      if (reading%of == a_gradient) call find_gradient(test, reading, message)
      reading%at_column = column_index(table, reading%asked%column)
      if (message == '' .and. reading%at_column == 0) message = no_column(reading%asked%column, names)
      if (is_slope(reading)) then
         if (reading%over == '') reading%over = usual_over(asked%column, table)
         reading%at_over = column_index(table, reading%over)
         if (message == '' .and. reading%at_over == 0) then
            message = no_column(reading%over, names)
            if (asked%over == '') message = "give 'over': the results have no wheel travel, over which a slope is taken by default"
         end if
         if (reading%of == a_slope) call find_width(table, factor_unit, reading)
         call slope_unit(reading%asked%column, reading%over, factor_unit, unit, size_of_slope)
         reading%size = reading%size*size_of_slope
         reading%head = head_with_unit(asked%name, unit)
      end if
      if (reading%of == an_rms) call read_curve(asked, home, factor_unit, reading%curve, message)
      if (message /= '') message = asked%where//': response '//quoted(asked%name)//': '//message
   end subroutine prepare_reading

   !> Reads a response in the design of the deck. `message` gives the reason if it cannot be read, and is '' otherwise. A response
   !> that is only undefined in this design is accepted.
   subroutine check_reading(reading, table, message)
      type(reading_t), intent(in) :: reading
      type(table_t), intent(in) :: table                  !! of its case, which stops where the response is read
      character(:), allocatable, intent(out) :: message
      real(wp) :: value
      integer :: fault

      message = ''
      call read_response(reading, table, value, fault)
      if (fault /= no_fault .and. fault /= is_undefined) message = fault_text(reading, table, fault)
      if (message /= '') message = reading%asked%where//': response '//quoted(reading%asked%name)//': '//message
   end subroutine check_reading

   !> Finds the half width in the swept value of the window of a slope. A wheel travel has the unit of a swept value in mm. A window
   !> that the file does not give ends where the range of the case ends.
   subroutine find_width(table, factor_unit, reading)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: factor_unit
      type(reading_t), intent(inout) :: reading

      real(wp) :: reach, slack

      reading%width = reading%asked%window
      if (reading%at_over == 0) return
      if (.not. (reading%over == 'factor' .or. factor_unit == 'mm' .and. index(reading%over, travel) > 0)) &
         reading%width = usual_width(table, reading%at_over, reading%asked%at, reading%asked%window)
      if (reading%asked%has_window) return
      associate (low => minval(table%values(2, :)), high => maxval(table%values(2, :)), at => reading%asked%at)
         slack = 1.0e-9_wp*(high - low)
         reach = min(at - low, high - at)
         if (abs(reach) <= slack) reach = high - low          ! one side
      end associate
      if (reach < slack .or. reading%width <= reach) return
      reading%asked%window = reading%asked%window*(reach/reading%width)
      reading%width = reach
   end subroutine find_width

   !> Prepares a response that is a difference of two responses, which must already be prepared. `message` gives the error if the
   !> two responses have different units, and is '' otherwise.
   subroutine prepare_difference(asked, first, second, reading, message)
      type(response_t), intent(in) :: asked
      type(reading_t), intent(in) :: first, second
      type(reading_t), intent(out) :: reading
      character(:), allocatable, intent(out) :: message

      reading%asked = asked
      reading%of = a_difference
      reading%over = ''
      reading%head = head_with_unit(asked%name, unit_of(first%head))
      message = ''
      if (unit_of(first%head) /= unit_of(second%head)) message = asked%where//': response '//quoted(asked%name)//': '// &
         quoted(first%head)//' and '//quoted(second%head)//' have different units'
   end subroutine prepare_difference

   !> Finds the columns, the window, the sign and the zero limit of a gradient of the report. `message` gives the reason if the test
   !> does not have the gradient.
   subroutine find_gradient(test, reading, message)
      type(test_result_t), intent(in), optional :: test
      type(reading_t), intent(inout) :: reading
      character(:), allocatable, intent(inout) :: message
      type(gradient_t), allocatable :: gradients(:)
      type(definition_t), allocatable :: list(:)
      character(name_length), allocatable :: names(:)
      character(:), allocatable :: wanted
      integer :: k

      allocate (gradients(0), names(0))
      if (present(test)) then
         if (test%kind == '') message = 'a gradient belongs to a test of the rig, and case '//quoted(test%name)//' is not a test'
         call test_gradients(test, windows_t(), gradients)
         list = definitions_of(test%kind)
         names = [character(name_length) :: list%quantity]
      end if
      wanted = reading%asked%column//fitted
      do k = 1, size(gradients)
         if (gradients(k)%quantity /= wanted) cycle
         if (gradients(k)%side /= reading%asked%side .and. gradients(k)%side//reading%asked%side /= 'left') cycle
         reading%asked%column = gradients(k)%column
         reading%over = gradients(k)%over
         if (.not. reading%asked%window > 0.0_wp) reading%asked%window = gradients(k)%window_half
         reading%width = gradients(k)%width*(reading%asked%window/gradients(k)%window_half)
         reading%size = gradients(k)%turn
         reading%noise = gradient_noise(gradients(k)%column)
         return
      end do
      if (message /= '') return
      message = 'test '//quoted(test%kind)//' has no gradient '//quoted(reading%asked%column)
      if (any(names == wanted)) then
         if (reading%asked%side /= '') message = message//' of the '//reading%asked%side//' wheel'
      else
         wanted = nearest_name(wanted, names)
         if (wanted /= '') message = message//' (did you mean '//quoted(wanted(:index(wanted, fitted) - 1))//'?)'
         if (wanted == '') message = message//of_other_test(reading%asked%column//fitted)
      end if
   end subroutine find_gradient

   !> Phrase for a message about the tests that have a gradient, or '' if no test has the gradient. Example: "; this gradient
   !> belongs to 'lateral_force': give …".
   function of_other_test(quantity) result(words)
      character(*), intent(in) :: quantity
      character(:), allocatable :: words
      type(definition_t), allocatable :: list(:)
      integer :: k

      words = ''
      do k = 1, size(rig_tests)
         list = definitions_of(trim(rig_tests(k)%name))
         if (.not. any([(list%quantity == quantity)])) cycle
         if (words /= '') words = words//' and'
         words = words//' '//quoted(trim(rig_tests(k)%name))
      end do
      if (words /= '') words = '; this gradient belongs to'//words//': give the case of such a test in `case`'
   end function of_other_test

   !> Reads the given curve of a response of kind rms from a table with the columns `factor` and the column of the response.
   subroutine read_curve(asked, home, factor_unit, curve, message)
      type(response_t), intent(in) :: asked
      character(*), intent(in), optional :: home
      character(*), intent(in) :: factor_unit              !! unit of the swept value: 'mm', 'deg', 'N', 'N m', '-'
      real(wp), allocatable, intent(out) :: curve(:, :)
      character(:), allocatable, intent(inout) :: message
      type(sheet_t) :: sheet
      type(message_list_t) :: mistakes
      type(error_t), allocatable :: error
      character(:), allocatable :: path
      character(16) :: units(2)                  ! no array constructor: gfortran cuts the results of functions in it
      integer :: places(2)

      allocate (curve(2, 0))
      path = asked%file
      if (present(home) .and. index(path, '/') /= 1) path = home//path
      call read_sheet(path, sheet, error)
      if (allocated(error)) then
         message = error%message
         return
      end if
      places = [column_of(sheet, 'factor'), column_of(sheet, asked%column)]
      if (all(places > 0)) then
         units(1) = factor_unit
         units(2) = unit_of_heading(trim(asked%column))
         call take_columns(sheet, places, curve, units)
      else if (sheet%head_mistakes%count() == 0) then
         call sheet%head_mistakes%add(path//' must have the columns factor and '//trim(asked%column)//', and a row')
      end if
      call mistakes_of(sheet, mistakes)
      message = mistakes%text()
   end subroutine read_curve

   !> The reason why a response cannot be read from a table, for messages.
   function fault_text(reading, table, fault) result(text)
      type(reading_t), intent(in) :: reading
      type(table_t), intent(in) :: table
      integer, intent(in) :: fault               !! reason code of read_response, not 0
      character(:), allocatable :: text
      logical :: is_marked(size(table%values, 2))
      real(wp) :: x(size(table%values, 2))
      integer :: first, column

      select case (fault)
      case (column_is_missing)
         text = no_column(reading%asked%column, table%columns)
      case (over_is_missing)
         text = no_column(reading%over, table%columns)
      case (is_outside)
         x = table%values(2, :)
         text = 'at = '//str(reading%asked%at)
         if (reading%of == an_rms) text = 'a factor of '//reading%asked%file
         text = text//' lies outside the range of the case, '//str(minval(x))//' to '//str(maxval(x))
      case (is_between)
         text = 'at = '//str(reading%asked%at)
         if (reading%of == an_rms) text = 'a factor of '//reading%asked%file
         text = text//' lies between two rows of the load table of the case; expected the number of a row'
      case (window_is_outside)
         x = table%values(2, :)
         text = 'no slope: the states of the case, '//str(minval(x), 6)//' to '//str(maxval(x), 6)//', do not cover the window '// &
            'of ± '//str(reading%asked%window)//' around '//str(merge(reading%asked%at, 0.0_wp, reading%of == a_slope))// &
            '; expected a larger range of the case, or a smaller window of the response'
      case (is_undefined)
         column = place_of_column(table, reading%asked%column, reading%at_column)
         text = quoted(reading%asked%column)
         is_marked = .false.
         call mark_states(reading, table, is_marked)
         is_marked = is_marked .and. .not. ieee_is_finite(table%values(column, :))
         if (is_slope(reading) .and. .not. any(is_marked)) then
            call mark_states(reading, table, is_marked)
            is_marked = is_marked .and. .not. ieee_is_finite(table%values(place_of_column(table, reading%over, reading%at_over), :))
            text = quoted(reading%over)
         end if
         first = findloc(is_marked, .true., dim=1)
         text = text//' has no value at '//plural(max(1, count(is_marked)), 'state', 'states')
         if (first > 0) text = text//', the first at factor '//str(table%values(2, first))
      case (has_few_states)
         text = 'no slope: it needs '//str(min_points)//' states within the window of ± '//str(reading%asked%window)// &
            '; use more states in the case, or a larger window in the response'
      case default
         text = 'no slope: '//quoted(reading%over)//' does not change within the window'
      end select
   end function fault_text

   !> The default column over which a slope is taken: the wheel travel. With two wheels, the travel on the side of the column is
   !> used; if the column has no side, the left travel is used.
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

   !> The message about a missing column, with what a quantity requires, or with a suggestion.
   pure function no_column(name, heads) result(words)
      character(*), intent(in) :: name, heads(:)
      character(:), allocatable :: words

      words = 'the results have no column '//quoted(name)//column_hint(name, heads)
   end function no_column

end module ek_response
