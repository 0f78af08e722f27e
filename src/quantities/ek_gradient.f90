!> Gradients of a test: slopes of the least-squares line over a window around design.
!>
!>     slope = ∫ x y dx / ∫ x² dx       over |x| ≤ window
!>
!> The slope is read at five states of the window where the path stops (ek_table_reading), so that the increments have no influence.
!> If a path turns back, only the states of the branch through design are used (unfolded_rows). x is the travel, roll, steering
!> input, force or torque of the test, y a column. The reported value is
!>
!>     value = size · s_y/s_x · slope
!>
!> where `size` converts the unit (per m, per kN, per 100 N m) and the signs depend on the side of the wheel: steer is positive to
!> the left on both wheels (s_y = side for toe), and with anti-phase loads x is the force on the wheel itself. These are the signs
!> of the columns of the compliance matrix: in a small window the fitted slope equals the column, on either wheel. Only in
!> steering is the input mirrored on the right wheel (s_x): positive towards the side of the wheel.
!>
!> A column whose change over the window does not exceed the tolerance of Newton and rounding has the slope 0.
module ek_gradient
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_text, only: str, quoted, plural
   use ek_quantity, only: slope_unit, unit_text, needs_rate
   use ek_noise, only: noise_of, solved
   use ek_table, only: table_t, row_count, column_index, name_length
   use ek_case, only: case_t, add_window
   use ek_table_reading, only: read_slope, is_outside, is_undefined, is_flat, min_points
   use ek_test_result, only: test_result_t, wheel_column, state_range
   use ek_gradient_definition, only: definition_t, definitions_of, windows_t, window_of
   use ek_error, only: error_t, fail, exit_file
   use ek_decimal, only: get_decimal
   use ek_json, only: json_t, json_string, json_number, json_numbers
   use ek_frame, only: frame_t, new_frame
   use ek_text_table, only: text_table_t, read_text_table, cell_of
   implicit none(type, external)
   private
   public :: gradient_t, test_gradients, gradient_windows, fit_slope, slope_note, gradient_noise, lacks_rate, &
      rate_reason, is_of_springs
   public :: gradients_csv, gradients_json, read_gradients

   ! reasons of a column that depends on a rate
   character(*), parameter :: no_spring = 'no spring carries the wheels', &
      bushings_alone = 'depends on the spring: only bushings carry the wheels'

   !> One gradient of the report.
   type :: gradient_t
      character(:), allocatable :: test        !! name of the case
      character(:), allocatable :: quantity    !! name of the gradient: 'bump toe (fitted)'
      character(:), allocatable :: side        !! 'left', 'right', or '' for the axle and for a single wheel
      character(:), allocatable :: unit, sign  !! unit: 'deg/m'; sign: meaning of a positive value
      character(:), allocatable :: column, over   !! columns of y and of x in the table
      character(:), allocatable :: window      !! window with unit: '±15 mm'
      real(wp) :: window_half = 0.0_wp         !! half width of the window [mm, deg, N or N m]
      real(wp) :: width = 0.0_wp               !! half width of the window [swept value]
      real(wp) :: value = 0.0_wp               !! value in `unit`; NaN if there is a note
      real(wp) :: turn = 1.0_wp                !! sign s_y/s_x of the wheel, see above
      real(wp) :: size = 1.0_wp                !! factor that converts the slope to `unit`
      integer :: points = 0                    !! number of states in the window at which y is a number
      character(:), allocatable :: note        !! reason of a missing value, otherwise ''
   end type gradient_t

   character(*), parameter :: columns(11) = [character(12) :: 'test', 'quantity', 'side', 'value', 'unit', 'window', &
      'points', 'sign', 'column', 'over', 'note']

contains

   !> Appends the gradients that are defined for the kind of a test and whose columns are in the table of the test.
   subroutine test_gradients(test, windows, gradients, wanted)
      type(test_result_t), intent(in) :: test
      type(windows_t), intent(in) :: windows
      type(gradient_t), allocatable, intent(inout) :: gradients(:)   !! appended to
      character(*), intent(in), optional :: wanted(:)                !! only these quantities: 'bump toe (fitted)'
      type(definition_t), allocatable :: list(:)
      type(gradient_t) :: gradient
      character(name_length) :: name
      integer :: k, wheel, place
      logical :: is_of_axle

      if (.not. allocated(gradients)) allocate (gradients(0))
      list = definitions_of(test%kind)
      do k = 1, size(list)
         if (present(wanted)) then
            if (.not. any(wanted == list(k)%quantity)) cycle
         end if
         do wheel = 1, size(test%prefixes)
            name = trim(test%prefixes(wheel))//list(k)%column
            place = column_index(test%table, name)
            is_of_axle = place == 0
            if (is_of_axle) then
               name = list(k)%column
               place = column_index(test%table, name)
               if (wheel > 1) place = 0         ! once for the axle
            end if
            if (place == 0) cycle
            if (wheel_column(test, wheel, trim(list(k)%over)) == 0) cycle
            ! not in the list itself: gfortran 12 leaks it
            gradient = one_gradient(test, windows, list(k), wheel, place, is_of_axle)
            gradients = [gradients, gradient]
         end do
      end do

   end subroutine test_gradients

   !> Adds the windows of all gradients of a test to its case, so that its path stops where they are read.
   subroutine gradient_windows(test, windows, case)
      type(test_result_t), intent(in) :: test          !! as planned, not solved
      type(windows_t), intent(in) :: windows
      type(case_t), intent(inout) :: case
      type(definition_t), allocatable :: list(:)
      character(8) :: unit
      real(wp) :: half, width
      integer :: k

      allocate (list, source=definitions_of(test%kind))    ! an assignment warns of bounds that are not there, with -O1
      do k = 1, size(list)
         call find_window(test, trim(list(k)%over), windows, half, width, unit)
         call add_window(0.0_wp, width, case)
      end do
   end subroutine gradient_windows

   !> Finds the window of a gradient of a test. If the range of the test is smaller than a window that no user gives, the window ends with
   !> the range.
   pure subroutine find_window(test, over, windows, half, width, unit)
      type(test_result_t), intent(in) :: test
      character(*), intent(in) :: over                 !! column of the abscissa, without the name of its wheel
      type(windows_t), intent(in) :: windows
      real(wp), intent(out) :: half                    !! half width, in `unit`
      real(wp), intent(out) :: width                   !! half width [swept value]
      character(*), intent(out) :: unit                !! mm, deg, N or N m
      logical :: is_given

      call window_of(test%kind, over, windows, half, unit, is_given)
      width = swept_width(test, over, half)
      if (is_given .or. width <= test%reach) return
      half = half*(test%reach/width)
      width = test%reach
   end subroutine find_window

   !> The half width of a window in the swept value of a test, from the half width in the unit of the abscissa of a gradient. The
   !> swept value of a test of travel or roll has the unit of the abscissa.
   pure real(wp) function swept_width(test, over, half) result(width)
      type(test_result_t), intent(in) :: test
      character(*), intent(in) :: over                 !! column of the abscissa, without the name of its wheel
      real(wp), intent(in) :: half

      width = half
      if (over == 'factor' .and. abs(test%factor_size) > 0.0_wp) width = half/abs(test%factor_size)
      if (over == 'steering_wheel_deg' .and. test%wheel_size > 0.0_wp) width = half/test%wheel_size
   end function swept_width

   !> One gradient of a test, with its description.
   function one_gradient(test, windows, definition, wheel, place, is_of_axle) result(gradient)
      type(test_result_t), intent(in) :: test
      type(windows_t), intent(in) :: windows
      type(definition_t), intent(in) :: definition
      integer, intent(in) :: wheel, place
      logical, intent(in) :: is_of_axle
      type(gradient_t) :: gradient
      character(8) :: unit
      character(:), allocatable :: slope_ending
      real(wp) :: slope
      integer :: over, side, undefined, reason

      over = wheel_column(test, wheel, trim(definition%over))
      side = test%sides(wheel)
      gradient%test = test%name
      gradient%quantity = trim(definition%quantity)
      gradient%side = ''
      if (.not. is_of_axle .and. size(test%prefixes) > 1) gradient%side = trim(merge('left ', 'right', side < 0))
      gradient%sign = trim(definition%sign)
      gradient%column = trim(test%table%columns(place))
      gradient%over = trim(test%table%columns(over))
      call find_window(test, trim(definition%over), windows, gradient%window_half, gradient%width, unit)
      call slope_unit(trim(definition%column), trim(definition%over), trim(unit), slope_ending, gradient%size)
      gradient%unit = unit_text(slope_ending)
      gradient%window = '±'//str(gradient%window_half)//' '//trim(unit)

      if (allocated(test%read)) then
         call fit_slope(test%read, place, over, test%factor_size, gradient%width, gradient%window_half, slope, reason, &
            gradient%points, undefined)
      else
         call fit_slope(test%table, place, over, test%factor_size, gradient%width, gradient%window_half, slope, reason, &
            gradient%points, undefined)
      end if
      gradient%note = ''
      gradient%turn = turn_of(test, definition, side)
      gradient%value = slope
      if (.not. ieee_is_finite(slope)) then
         gradient%note = slope_note(test%table, reason, gradient%points, undefined, gradient%column, trim(gradient%over), .false.)
         return
      end if
      gradient%value = slope*(gradient%size*gradient%turn)
   end function one_gradient

   !> The reason why a slope has no value.
   function slope_note(table, reason, points, undefined, column, over, names_column) result(note)
      type(table_t), intent(in) :: table
      integer, intent(in) :: reason, points, undefined     !! of fit_slope
      character(*), intent(in) :: column, over     !! names of both columns
      logical, intent(in) :: names_column          !! whether the reader needs the name of the first
      character(:), allocatable :: note
      real(wp) :: range(2)

      if (lacks_rate(table, column)) then
         note = rate_reason(table)
         return
      end if
      select case (reason)
      case (is_outside)
         note = 'no state was found'
         range = state_range(table)
         if (ieee_is_finite(range(1))) note = 'the states, '//str(range(1), 6)//' to '//str(range(2), 6)// &
            ', do not cover the window'
      case (is_undefined)
         note = 'undefined at '//plural(undefined, 'state', 'states')//' in the window'
         if (names_column) note = column//' is '//note
      case (is_flat)
         note = over//' does not change'
      case default
         note = 'no state in the window'
         if (points > 0) note = 'only '//str(points)//' of at least '//str(min_points)//' states in the window'
         note = note//'; use more increments, or a range around design'
      end select
   end function slope_note

   !> The reason why a column that depends on a rate has no value (lacks_rate).
   function rate_reason(table) result(reason)
      type(table_t), intent(in) :: table
      character(:), allocatable :: reason

      reason = no_spring
      if (table%rests_on_bushings) reason = bushings_alone
   end function rate_reason

   !> Whether a reason is that the deck has no spring.
   pure logical function is_of_springs(reason)
      character(*), intent(in) :: reason
      is_of_springs = reason == no_spring .or. reason == bushings_alone
   end function is_of_springs

   !> Whether a column has no value because no spring carries the wheels.
   pure logical function lacks_rate(table, column)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: column
      integer :: first

      first = 1
      if (index(column, 'left_') == 1) first = 6
      if (index(column, 'right_') == 1) first = 7
      lacks_rate = table%lacks_springs .or. table%rests_on_bushings
      if (lacks_rate) lacks_rate = needs_rate(column(first:))
   end function lacks_rate

   !> Reads the slope of one column over another column in a window around design, in the units of both; 0 if the slope is within the
   !> noise. Creates no strings.
   pure subroutine fit_slope(table, place, over, factor_size, width, half, slope, reason, points, undefined)
      type(table_t), intent(in) :: table
      integer, intent(in) :: place, over           !! indices of the columns of y and x
      real(wp), intent(in) :: factor_size          !! load or displacement at `factor` = 1, if that is the abscissa
      real(wp), intent(in) :: width                !! half width of the window [swept value]
      real(wp), intent(in) :: half                 !! half width of the window, in the unit of the abscissa
      real(wp), intent(out) :: slope               !! NaN without a value
      integer, intent(out) :: reason               !! of read_slope
      integer, intent(out) :: points               !! states that are read and at which the column is defined
      integer, intent(out) :: undefined            !! states in the window at which a column is not a number

      if (table%columns(over) == 'factor') then
         call read_slope(table, place, over, 0.0_wp, width, half/abs(factor_size), slope, reason, points, undefined)
         slope = slope/factor_size
      else
         call read_slope(table, place, over, 0.0_wp, width, half, slope, reason, points, undefined)
      end if
      if (.not. ieee_is_finite(slope)) return
      if (abs(slope)*half <= gradient_noise(table%columns(place))) slope = 0.0_wp
   end subroutine fit_slope

   !> Noise of a column as the ordinate of a gradient, in the unit of the column. The abscissa is driven, and each state has its own
   !> error, so the noise is that of a tolerance which is a thousand times larger: 1e-6 mm, 1e-7 deg, 1e-2 N. Creates no strings.
   pure real(wp) function gradient_noise(column) result(noise)
      character(*), intent(in) :: column
      noise = noise_of(trim(column), 0.0_wp, 1.0e3_wp*solved)
   end function gradient_noise

   !> The sign s_y/s_x of a wheel in a gradient, −1 or 1.
   pure real(wp) function turn_of(test, definition, side) result(turn)
      type(test_result_t), intent(in) :: test
      type(definition_t), intent(in) :: definition
      integer, intent(in) :: side

      turn = 1.0_wp
      select case (definition%y_turn)
      case ('s', 'i')
         turn = side
      case ('o')
         turn = -side                                                ! + on the left wheel
      case ('d')
         turn = merge(1.0_wp, -1.0_wp, test%is_iso)
      end select
      if (test%is_anti .and. side > 0) turn = -turn                  ! the load on the right wheel is −factor
   end function turn_of

   !> The gradients as CSV, one line per gradient; `nan` for a missing value.
   pure function gradients_csv(gradients) result(text)
      type(gradient_t), intent(in) :: gradients(:)
      character(:), allocatable :: text
      type(frame_t) :: frame
      integer :: k

      frame = new_frame(columns)
      do k = 1, size(gradients)
         associate (g => gradients(k))
            call frame%put(g%test)
            call frame%put(g%quantity)
            call frame%put(g%side)
            call frame%put(g%value)
            call frame%put(g%unit)
            call frame%put(g%window)
            call frame%put(g%points)
            call frame%put(g%sign)
            call frame%put(g%column)
            call frame%put(g%over)
            call frame%put(g%note)
         end associate
      end do
      text = frame%csv()
   end function gradients_csv

   !> The gradients as JSON: { "model", "checksum", "gradients": [ { … } ] }.
   pure function gradients_json(gradients, model, checksum) result(text)
      type(gradient_t), intent(in) :: gradients(:)
      character(*), intent(in) :: model, checksum
      character(:), allocatable :: text
      type(json_t) :: json
      integer :: k

      call json%open('{')
      call json%item('model', json_string(model))
      call json%item('checksum', json_string(checksum))
      call json%open('[', 'gradients')
      do k = 1, size(gradients)
         associate (g => gradients(k))
            call json%open('{')
            call json%item('test', json_string(g%test))
            call json%item('quantity', json_string(g%quantity))
            call json%item('side', json_string(g%side))
            call json%item('value', json_number(g%value))
            call json%item('unit', json_string(g%unit))
            call json%item('sign', json_string(g%sign))
            call json%item('window', json_string(g%window))
            call json%item('window_limits', json_numbers([-g%window_half, g%window_half]))
            call json%item('points', str(g%points))
            call json%item('column', json_string(g%column))
            call json%item('over', json_string(g%over))
            if (len(g%note) > 0) call json%item('note', json_string(g%note))
            call json%close('}')
         end associate
      end do
      call json%close(']')
      call json%close('}')
      text = json%text()
   end function gradients_json

   !> Reads gradients.csv. The file does not contain window_half, turn and size.
   subroutine read_gradients(path, gradients, error)
      character(*), intent(in) :: path
      type(gradient_t), allocatable, intent(out) :: gradients(:)
      type(error_t), allocatable, intent(out) :: error     !! exit_file, with path and line
      type(text_table_t) :: table
      character(:), allocatable :: points
      logical :: is_number
      integer :: k, status

      call read_text_table(path, table, error)
      if (allocated(error)) return
      do k = 1, 6
         if (any(table%columns == columns(k))) cycle
         call fail(error, exit_file, path//': missing column '//quoted(columns(k)))
         return
      end do
      allocate (gradients(table%rows))
      do k = 1, table%rows
         associate (g => gradients(k))
            g%test = cell_of(table, k, 'test')
            g%quantity = cell_of(table, k, 'quantity')
            g%side = cell_of(table, k, 'side')
            g%unit = cell_of(table, k, 'unit')
            g%window = cell_of(table, k, 'window')
            g%sign = cell_of(table, k, 'sign')
            g%column = cell_of(table, k, 'column')
            g%over = cell_of(table, k, 'over')
            g%note = cell_of(table, k, 'note')
            call get_decimal(cell_of(table, k, 'value'), g%value, is_number)
            if (.not. is_number) then
               call fail(error, exit_file, path//':'//str(table%lines(k))//': '//quoted(cell_of(table, k, 'value'))// &
                  ' is not a number')
               return
            end if
            points = cell_of(table, k, 'points')
            read (points, *, iostat=status) g%points
            if (status /= 0) g%points = 0
         end associate
      end do
   end subroutine read_gradients

end module ek_gradient
