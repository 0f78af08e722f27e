!> A key number of a suspension: its definition, the columns and tests that contain it, and the way in which its value is read.
!>
!> ek_key_numbers lists the key numbers that tests can have, from the headings of their tables alone. read_source reads one key
!> number when the tests are solved. read_source creates no strings, so that several threads can call it at the same time.
module ek_key_number
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_quantity, only: at_design, largest, least, slope, in_phase, anti_phase, at_place, to_contact, largest_of_all
   use ek_table, only: table_t, stop_t, add_stop, column_index, name_length, scheduled_rows
   use ek_test_result, only: design_row, unfolded_rows
   use ek_table_reading, only: value_where
   use ek_gradient, only: fit_slope
   implicit none(type, external)
   private
   public :: key_number_t, key_source_t, nothing, read_source, add_stops, has_value, needs_path, needs_all, is_slope
   public :: at_design, largest, least, slope, in_phase, anti_phase, at_place, to_contact, largest_of_all

   !> The columns of a key number in the table of one test: first for the left wheel, the single wheel or the axle, then for the
   !> right wheel.
   type :: key_source_t
      integer :: test = 0                               !! index in the list of tests
      character(name_length) :: column(2) = ''          !! '': this wheel does not have the number
      character(name_length) :: over(2) = ''            !! abscissa of a gradient; or column that has a given value
      real(wp) :: wanted(2) = 0.0_wp                    !! given value of the column `over`, in the unit of this column
      real(wp) :: half = 0.0_wp                         !! half width of the window of a gradient, in the unit of `over`
      real(wp) :: width = 0.0_wp                        !! half width of the window of a gradient [swept value]
      real(wp) :: size(2) = 1.0_wp                      !! factor on the slope of the columns: unit and sign of a gradient
      real(wp) :: factor_size = 1.0_wp                  !! load or displacement at `factor` = 1
   end type key_source_t

   !> One key number of a report, with its values for the axle, a single wheel or both wheels.
   type :: key_number_t
      character(:), allocatable :: group, quantity, unit, sign
      character(:), allocatable :: name           !! name for programs, without left_ or right_: 'bump_toe', 'toe_deg'
      character(:), allocatable :: condition      !! test and window of the number: 'parallel_travel, within ±15 mm of design'
      character(:), allocatable :: definition     !! columns of the number, and its sign
      character(:), allocatable :: reason         !! reason of a missing value; not allocated: it has a value, or was not read
      character(48) :: held = ''                  !! condition of the wheels of a loaded axle: 'vertical force held'
      logical :: has_target = .false.
      real(wp) :: target(2) = 0.0_wp              !! lower and upper limit that the deck gives, in `unit`
      real(wp) :: left = 0.0_wp, right = 0.0_wp      !! values of the wheels; NaN if missing
      logical :: is_of_axle = .false.                !! one number, in `left`
      integer :: how = at_design                     !! one of the constants above
      type(key_source_t), allocatable :: sources(:)  !! tests that may have the number, in the order of reading
   end type key_number_t

contains

   !> NaN, the value of a missing key number.
   pure real(wp) function nothing()
      nothing = ieee_value(1.0_wp, ieee_quiet_nan)
   end function nothing

   !> Whether a key number has a finite value on the left or right side.
   pure logical function has_value(number)
      type(key_number_t), intent(in) :: number
      has_value = ieee_is_finite(number%left) .or. ieee_is_finite(number%right)
   end function has_value

   !> Whether a key number depends on states far from design.
   pure logical function needs_path(how)
      integer, intent(in) :: how
      needs_path = .not. (how == at_design .or. is_slope(how))
   end function needs_path

   !> Whether a key number needs every state of its tests: without a state, an extreme of the others is another number. A value
   !> where another column has a given value, and a travel to contact, need only the states up to there.
   pure logical function needs_all(how)
      integer, intent(in) :: how
      needs_all = how == largest .or. how == least .or. how == largest_of_all
   end function needs_all

   !> Whether a key number is a gradient.
   pure logical function is_slope(how)
      integer, intent(in) :: how
      is_slope = how >= slope .and. how <= anti_phase
   end function is_slope

   !> Reads a key number from one of its tests: first for the left wheel, the single wheel or the axle, then for the right wheel.
   !> For the largest magnitude over all tests, `values` contains the values from earlier tests. `is_final`: no further test needs
   !> to be read.
   subroutine read_source(how, source, table, values, is_final)
      integer, intent(in) :: how
      type(key_source_t), intent(in) :: source
      type(table_t), intent(in) :: table                !! of the test
      real(wp), intent(inout) :: values(2)              !! NaN before the first test
      logical, intent(out) :: is_final
      integer :: wheel, place, over, points, undefined, reason
      real(wp) :: value

      if (how /= largest_of_all) values = nothing()
      do wheel = 1, 2
         if (source%column(wheel) == '') cycle
         place = column_index(table, source%column(wheel))
         if (place == 0) cycle
         over = 0
         if (source%over(wheel) /= '') over = column_index(table, source%over(wheel))
         select case (how)
         case (at_design)
            values(wheel) = design_value(table, place)
         case (slope:anti_phase)
            if (over == 0) cycle
            call fit_slope(table, place, over, source%factor_size, source%width, source%half, value, reason, points, undefined)
            values(wheel) = value*source%size(wheel)
         case (at_place)
            values(wheel) = value_where(table, over, source%wanted(wheel), place)
         case (to_contact)
            values(wheel) = abs(value_where(table, over, source%wanted(wheel), place) - design_value(table, place))
         case default
            call take_extreme(how, table, place, values(wheel))
         end select
      end do
      is_final = is_slope(how) .or. (how /= largest_of_all .and. any(ieee_is_finite(values)))
   end subroutine read_source

   !> Adds the values of columns at which a key number is read to the stops of its test.
   pure subroutine add_stops(how, source, stops)
      integer, intent(in) :: how
      type(key_source_t), intent(in) :: source
      type(stop_t), allocatable, intent(inout) :: stops(:)
      integer :: wheel

      if (.not. (how == at_place .or. how == to_contact)) return
      do wheel = 1, 2
         if (source%over(wheel) /= '') call add_stop(trim(source%over(wheel)), source%wanted(wheel), stops)
      end do
   end subroutine add_stops

   !> The value of a column at design; NaN if the state did not converge.
   pure real(wp) function design_value(table, place) result(value)
      type(table_t), intent(in) :: table
      integer, intent(in) :: place
      integer :: row

      value = nothing()
      row = design_row(table)
      if (row > 0) value = table%values(place, row)
   end function design_value

   !> Finds the maximum or minimum of a column over the usable states (is_good), or the largest magnitude, which includes the value
   !> from earlier tests.
   subroutine take_extreme(how, table, place, value)
      integer, intent(in) :: how
      type(table_t), intent(in) :: table
      integer, intent(in) :: place
      real(wp), intent(inout) :: value
      logical :: is_usable(size(table%values, 2))

      is_usable = is_good(table, place)
      if (.not. any(is_usable)) return
      select case (how)
      case (largest)
         value = maxval(table%values(place, :), mask=is_usable)
      case (least)
         value = minval(table%values(place, :), mask=is_usable)
      case default
         if (.not. ieee_is_finite(value)) value = 0.0_wp
         value = max(value, maxval(abs(table%values(place, :)), mask=is_usable))
      end select
   end subroutine take_extreme

   !> Whether each state is of the schedule, converged, is on the branch through design (unfolded_rows), and has a finite value in a
   !> column.
   pure function is_good(table, place)
      type(table_t), intent(in) :: table
      integer, intent(in) :: place
      logical :: is_good(size(table%values, 2))
      is_good = unfolded_rows(table) .and. scheduled_rows(table) .and. ieee_is_finite(table%values(place, :))
   end function is_good

end module ek_key_number
