!> The key numbers of a report, from all its tests: attitude at design, rates, ride and roll, compliance,
!> anti-dive, anti-lift, anti-squat, steering. Numbers without a column or test are omitted. Titles, units and signs come from
!> ek_quantity.
!> Springs have the motion ratio of each spring on two points and of each spring on a length measure, at design.
!> The definition of a slope is a sentence, from which its value follows: columns, and the factor on the slope of each wheel.
module ek_key_numbers
   use ek_kinds, only: wp
   use ek_table, only: stop_t, column_index
   use ek_quantity, only: quantity_t, number_t, number_rows, elastic_axis, quantity_named, without_phase, unit_of, unit_text
   use ek_test_result, only: test_result_t
   use ek_gradient, only: gradient_t
   use ek_gradient_definition, only: fitted
   use ek_key_number, only: key_number_t, key_source_t, nothing, read_source, add_stops, has_value, is_slope, needs_all, &
      at_design, largest, least, slope, in_phase, anti_phase, largest_of_all
   use ek_missing_number, only: missing_reason
   use ek_place_numbers, only: number_list_t, new_number, add_source, append, numbers_of, place_numbers
   use ek_text, only: spaced, str
   implicit none(type, external)
   private
   public :: key_number_t, key_numbers, stop_at_numbers, list_key_numbers, number_heads, wanted_gradients, without_side, number_name

   character(*), parameter :: ratio_ending = '_motion_ratio', gap_ending = '_gap_mm', instant = 'instant'

   character(*), parameter :: phases(slope:anti_phase) = [character(12) :: '', ', in phase', ', anti-phase']

contains

   !> Computes all key numbers that the tests provide. A key number without a value is omitted, except a gradient; `missing` lists
   !> the omitted key numbers. Every key number without a value has the reason.
   subroutine key_numbers(tests, gradients, numbers, missing)
      type(test_result_t), intent(in) :: tests(:)        !! solved
      type(gradient_t), intent(in) :: gradients(:)       !! of these tests
      type(key_number_t), allocatable, intent(out) :: numbers(:)
      type(key_number_t), allocatable, intent(out), optional :: missing(:)
      type(key_number_t), allocatable :: listed(:)
      logical, allocatable :: is_there(:)
      real(wp) :: values(2)
      logical :: is_final
      integer :: k, j

      call list_key_numbers(tests, gradients, listed)
      allocate (is_there(size(listed)))
      do k = 1, size(listed)
         values = nothing()
         is_final = .false.
         do j = 1, size(listed(k)%sources)
            if (needs_all(listed(k)%how) .and. .not. tests(listed(k)%sources(j)%test)%is_whole) then
               if (listed(k)%how /= largest_of_all) cycle
               values = nothing()
               exit
            end if
            call read_test(listed(k)%how, listed(k)%sources(j), tests(listed(k)%sources(j)%test), values, is_final)
            if (is_final) exit
         end do
         if (is_final .and. j > 1) call name_test(tests(listed(k)%sources(j)%test)%name, listed(k))
         listed(k)%left = values(1)
         listed(k)%right = values(2)
         ! a slope without a value remains, with the reason among the gradients
         is_there(k) = has_value(listed(k)) .or. is_slope(listed(k)%how)
         if (.not. has_value(listed(k))) listed(k)%reason = missing_in(listed(k), tests(listed(k)%sources(1)%test))
      end do
      allocate (numbers(count(is_there)))
      j = 0
      do k = 1, size(listed)
         if (.not. is_there(k)) cycle
         j = j + 1
         numbers(j) = listed(k)
      end do
      if (.not. present(missing)) return
      allocate (missing(count(.not. is_there)))
      j = 0
      do k = 1, size(listed)
         if (is_there(k)) cycle
         j = j + 1
         missing(j) = listed(k)
      end do
   end subroutine key_numbers

   !> Reads a key number from a test, at the states of the schedule and at those where numbers are read.
   subroutine read_test(how, source, test, values, is_final)
      integer, intent(in) :: how
      type(key_source_t), intent(in) :: source
      type(test_result_t), intent(in) :: test
      real(wp), intent(inout) :: values(2)
      logical, intent(out) :: is_final

      if (allocated(test%read)) then
         call read_source(how, source, test%read, values, is_final)
      else
         call read_source(how, source, test%table, values, is_final)
      end if
   end subroutine read_test

   !> Adds the values of columns at which the key numbers of tests are read to the stops of one of the tests.
   subroutine stop_at_numbers(tests, t, stops)
      type(test_result_t), intent(in) :: tests(:)        !! with the columns of their tables and their wheels
      integer, intent(in) :: t                           !! index of the test
      type(stop_t), allocatable, intent(inout) :: stops(:)
      type(number_list_t) :: list
      type(key_number_t), allocatable :: numbers(:)
      integer :: k, j

      call place_numbers(tests, list)
      call numbers_of(list, numbers)
      do k = 1, size(numbers)
         do j = 1, size(numbers(k)%sources)
            if (numbers(k)%sources(j)%test == t) call add_stops(numbers(k)%how, numbers(k)%sources(j), stops)
         end do
      end do
   end subroutine stop_at_numbers

   !> The reason why a key number has no value in its first test.
   function missing_in(number, test) result(text)
      type(key_number_t), intent(in) :: number
      type(test_result_t), intent(in) :: test
      character(:), allocatable :: text

      if (needs_all(number%how) .and. .not. test%is_whole) then
         text = 'a state of the test did not converge'
      else if (allocated(test%read)) then
         text = missing_reason(number, 1, 1, test%read)
      else
         text = missing_reason(number, 1, 1, test%table)
      end if
   end function missing_in

   !> Lists all key numbers that the tests may have, from the headings of their tables. Nothing is solved.
   subroutine list_key_numbers(tests, gradients, numbers, wanted)
      type(test_result_t), intent(in) :: tests(:)        !! with the columns of their tables and their wheels
      type(gradient_t), intent(in) :: gradients(:)       !! of these tests
      type(key_number_t), allocatable, intent(out) :: numbers(:)
      character(*), intent(in), optional :: wanted(:)    !! names without left_ and right_; absent: all
      type(key_number_t) :: number
      type(number_list_t) :: list
      type(number_t) :: entry
      logical :: is_steered, is_pair
      integer :: k

      is_steered = any([(column_index(tests(k)%table, 'steering_ratio') > 0, k=1, size(tests))])
      is_pair = any([(size(tests(k)%prefixes) > 1, k=1, size(tests))])
      do k = 1, size(number_rows)
         entry = number_rows(k)
         if (present(wanted)) then
            if (.not. any(wanted == name_of(entry))) cycle
         end if
         if (index(entry%name, instant) == 1 .and. (entry%group == elastic_axis .eqv. is_steered)) cycle
         if (entry%how >= slope) then
            call from_gradients(tests, gradients, entry, number)
         else
            call from_tables(tests, entry, is_steered, number)
         end if
         if (size(number%sources) == 0) cycle
         if (.not. is_pair) then
            number%quantity = without_phase(number%quantity)
            number%sign = without_phase(number%sign)
            number%definition = without_phase(number%definition)
            if (index(number%definition//'|', '; |') > 0) number%definition = number%definition(:len(number%definition) - 2)
         end if
         call append(number, list)
      end do
      call ratio_numbers(tests, list, wanted)
      call place_numbers(tests, list, wanted)
      call numbers_of(list, numbers)
   end subroutine list_key_numbers

   !> Lists the gradients that the requested key numbers read from a kind of test, such as 'bump toe (fitted)', and marks the names
   !> of these key numbers in is_gradient.
   subroutine wanted_gradients(kind, wanted, quantities, is_gradient)
      character(*), intent(in) :: kind, wanted(:)        !! names without left_ and right_
      character(64), allocatable, intent(out) :: quantities(:)
      logical, intent(inout) :: is_gradient(:)           !! of each name in `wanted`
      integer :: k

      allocate (quantities(0))
      do k = 1, size(number_rows)
         if (number_rows(k)%how < slope .or. number_rows(k)%kind /= kind) cycle
         associate (is_this => wanted == name_of(number_rows(k)))
            if (.not. any(is_this)) cycle
            is_gradient = is_gradient .or. is_this
         end associate
         quantities = [character(64) :: quantities, trim(number_rows(k)%name)//fitted]
      end do
   end subroutine wanted_gradients

   !> The name of the key number that is a column at design, or a gradient; '' without such a key number. Loads in phase and in
   !> anti-phase give two key numbers for one gradient; the result for such a gradient is ''.
   pure character(64) function number_name(source, is_slope) result(name)
      character(*), intent(in) :: source                 !! 'toe_deg', 'bump toe'
      logical, intent(in) :: is_slope                    !! source is a gradient
      integer :: k

      name = ''
      do k = 1, size(number_rows)
         associate (row => number_rows(k))
            if (row%name == source .and. row%how == merge(slope, at_design, is_slope)) name = name_of(row)
         end associate
      end do
   end function number_name

   !> The name of a key number for programs: 'toe_deg', 'bump_toe', 'lateral_deflection_anti', 'largest_steer_deg'.
   pure character(64) function name_of(entry) result(name)
      type(number_t), intent(in) :: entry
      integer :: k, code

      name = entry%name
      do k = 1, len_trim(name)                           ! the name of a gradient has blanks, hyphens and capitals
         code = iachar(name(k:k))
         if (scan(name(k:k), ' -') > 0) name(k:k) = '_'
         if (code >= iachar('A') .and. code <= iachar('Z')) name(k:k) = achar(code + 32)
      end do
      select case (entry%how)
      case (anti_phase)
         name = trim(name)//'_anti'
      case (largest)
         name = 'largest_'//trim(name)
      case (least)
         name = 'smallest_'//trim(name)
      end select
   end function name_of

   !> Lists the names of a key number for programs: one name for the axle or a single wheel, otherwise one per wheel, left first. A
   !> name is '' if the wheel does not have the number.
   subroutine number_heads(number, is_pair, heads)
      type(key_number_t), intent(in) :: number
      logical, intent(in) :: is_pair                     !! the model has two wheels
      character(*), intent(out) :: heads(2)
      integer :: wheel, k

      heads = ''
      if (number%is_of_axle .or. .not. is_pair) then
         heads(1) = number%name
         return
      end if
      do wheel = 1, 2
         if (any([(number%sources(k)%column(wheel) /= '', k=1, size(number%sources))])) &
            heads(wheel) = trim(merge('left_ ', 'right_', wheel == 1))//number%name
      end do
   end subroutine number_heads

   !> Defines a key number as a gradient of the tests of a kind and phase. Every test with the gradient becomes a source; unit,
   !> sign and condition come from the first of these tests.
   subroutine from_gradients(tests, gradients, entry, number)
      type(test_result_t), intent(in) :: tests(:)
      type(gradient_t), intent(in) :: gradients(:)
      type(number_t), intent(in) :: entry
      type(key_number_t), intent(out) :: number
      type(key_source_t) :: source
      character(:), allocatable :: column, over, unit, sign
      real(wp) :: times(2), per_factor
      integer :: t, k, wheel
      logical :: is_there

      times = 0.0_wp
      per_factor = 1.0_wp
      column = ''
      over = ''
      unit = ''
      sign = ''
      call new_number(trim(entry%group), trim(entry%name)//trim(phases(entry%how))//fitted, '', '', entry%how, number)
      number%name = trim(name_of(entry))
      do t = 1, size(tests)
         if (tests(t)%kind /= entry%kind) cycle
         if (entry%how > slope .and. (tests(t)%is_anti .neqv. entry%how == anti_phase)) cycle
         is_there = .false.
         source = key_source_t(test=t, factor_size=tests(t)%factor_size)
         do k = 1, size(gradients)
            if (gradients(k)%test /= tests(t)%name .or. gradients(k)%quantity /= trim(entry%name)//fitted) cycle
            is_there = .true.
            wheel = merge(2, 1, gradients(k)%side == 'right')
            source%column(wheel) = gradients(k)%column
            source%over(wheel) = gradients(k)%over
            source%half = gradients(k)%window_half
            source%width = gradients(k)%width
            source%size(wheel) = gradients(k)%size*gradients(k)%turn
            if (size(number%sources) > 0) cycle
            number%unit = gradients(k)%unit
            number%sign = gradients(k)%sign//' (over '//gradients(k)%window//')'
            number%is_of_axle = len(gradients(k)%side) == 0 .and. size(tests(t)%prefixes) > 1
            number%held = tests(t)%held
            number%condition = 'test '//tests(t)%name//', within '//gradients(k)%window//' of design'
            if (number%held /= '') number%condition = number%condition//', '//trim(number%held)
            column = without_side(gradients(k)%column)
            over = without_side(gradients(k)%over)
            per_factor = tests(t)%factor_size
            unit = gradients(k)%window(index(gradients(k)%window, ' '):)
            sign = sign_of(gradients(k)%sign)
            times(wheel) = gradients(k)%size*gradients(k)%turn
         end do
         if (is_there) call add_source(source, number)
      end do
      if (size(number%sources) == 0) return
      number%definition = slope_definition(column, over, per_factor, unit, times)//sign
   end subroutine from_gradients

   !> Replaces the test in the condition of a key number by the test that gave its value: 'test NAME, at design'.
   subroutine name_test(test, number)
      character(*), intent(in) :: test
      type(key_number_t), intent(inout) :: number

      if (all(number%how /= [at_design, largest, least])) return
      number%condition = 'test '//test//number%condition(index(number%condition, ','):)
   end subroutine name_test

   !> Defines a key number as a column at design, or as the maximum or minimum of a column. Every test that has the column becomes a
   !> source.
   subroutine from_tables(tests, entry, is_steered, number)
      type(test_result_t), intent(in) :: tests(:)
      type(number_t), intent(in) :: entry
      logical, intent(in) :: is_steered                 !! the instant axis belongs to steering, not to elasticity
      type(key_number_t), intent(out) :: number
      type(quantity_t) :: quantity
      type(key_source_t) :: source
      character(:), allocatable :: sign
      integer :: t, k, at

      quantity = quantity_named(entry%name)
      sign = sign_of(trim(quantity%sign))
      if (entry%how == at_design) then
         quantity%title(1:1) = achar(iachar(quantity%title(1:1)) + 32)
         at = index(quantity%title, instant)
         if (at > 0 .and. .not. is_steered) quantity%title(at:at + len(instant) - 1) = 'elastic'
      else
         quantity%title = entry%title
         quantity%sign = 'over the test'
      end if
      call new_number(trim(entry%group), trim(quantity%title), unit_text(unit_of(trim(entry%name))), trim(quantity%sign), &
         entry%how, number)
      number%name = trim(name_of(entry))
      number%condition = ', at design'
      number%definition = trim(entry%name)//sign
      if (entry%how /= at_design) then
         number%condition = ', over all states'
         number%definition = trim(merge('maximum', 'minimum', entry%how == largest))//' of '//trim(entry%name)//sign
      end if
      do t = 1, size(tests)
         if (entry%kind /= '' .and. tests(t)%kind /= entry%kind) cycle
         source = key_source_t(test=t)
         do k = 1, size(tests(t)%prefixes)
            if (column_index(tests(t)%table, trim(tests(t)%prefixes(k))//entry%name) == 0) cycle
            at = merge(2, 1, tests(t)%sides(k) > 0 .and. size(tests(t)%prefixes) > 1)
            source%column(at) = trim(tests(t)%prefixes(k))//entry%name
         end do
         if (all(source%column == '') .and. column_index(tests(t)%table, entry%name) > 0) then
            source%column(1) = entry%name
            if (size(number%sources) == 0) number%is_of_axle = size(tests(t)%prefixes) > 1
         end if
         if (.not. any(source%column /= '')) cycle
         if (size(number%sources) == 0) number%condition = 'test '//tests(t)%name//number%condition
         call add_source(source, number)
      end do
   end subroutine from_tables

   !> The sign convention as the end of a definition: '; + top outward'; '' without a sign convention.
   function sign_of(sign) result(text)
      character(*), intent(in) :: sign
      character(:), allocatable :: text

      text = ''
      if (sign /= '') text = '; '//sign
   end function sign_of

   !> A column name without the name of its wheel.
   pure function without_side(column) result(name)
      character(*), intent(in) :: column
      character(:), allocatable :: name

      name = column
      if (index(column, 'left_') == 1) name = column(6:)
      if (index(column, 'right_') == 1) name = column(7:)
   end function without_side

   !> Appends the motion ratio of each element with a column of motion ratio: the change of the length of the element per wheel
   !> travel. Stops are omitted, because they are without contact near design.
   subroutine ratio_numbers(tests, numbers, wanted)
      type(test_result_t), intent(in) :: tests(:)
      type(number_list_t), intent(inout) :: numbers
      character(*), intent(in), optional :: wanted(:)    !! names without left_ and right_; absent: all
      character(:), allocatable :: element, on_right
      type(key_number_t) :: number
      integer :: t, c, ends
      logical :: is_pair

      do t = 1, size(tests)
         if (tests(t)%kind == 'parallel_travel') exit
      end do
      if (t > size(tests)) return
      associate (test => tests(t), columns => tests(t)%table%columns)
         is_pair = size(test%prefixes) > 1
         do c = 1, size(columns)
            ends = len_trim(columns(c)) - len(ratio_ending)
            if (ends < 1) cycle
            if (columns(c) (ends + 1:) /= ratio_ending) cycle
            element = columns(c) (:ends)
            if (column_index(test%table, element//gap_ending) > 0) cycle
            on_right = ''
            if (is_pair .and. index(element, 'right_') == 1) then
               if (column_index(test%table, 'left_'//element(7:)//ratio_ending) > 0) cycle      ! with the left one
            else if (is_pair .and. index(element, 'left_') == 1) then
               on_right = 'right_'//element(6:)//ratio_ending
               if (column_index(test%table, on_right) == 0) on_right = ''
            end if
            call make(element, on_right)
            if (present(wanted)) then
               if (.not. any(wanted == number%name)) cycle
            end if
            call append(number, numbers)
         end do
      end associate

   contains

      subroutine make(element, on_right)
         character(*), intent(in) :: element, on_right        !! column of the element on the right; '': none
         character(:), allocatable :: stem
         type(key_source_t) :: source

         stem = element
         if (on_right /= '') stem = element(6:)
         call new_number('Motion ratios', 'motion ratio, '//spaced(stem), '–', '− shortens in bump', at_design, number)
         number%name = stem//ratio_ending
         number%condition = 'test '//tests(t)%name//', at design, wheels in parallel travel'
         number%definition = stem//ratio_ending//', d(length of '//stem//')/d(wheel travel); − shortens in bump'
         number%is_of_axle = is_pair .and. on_right == ''
         source = key_source_t(test=t)
         source%column(1) = element//ratio_ending
         source%column(2) = on_right
         call add_source(source, number)
      end subroutine make

   end subroutine ratio_numbers

   !> The definition of a slope: 'slope of the least-squares line of toe_deg over factor, times −1000 (left wheel), 1000 (right
   !> wheel)'. The value is the slope of the columns as they are in the table of the test, times the factor.
   function slope_definition(column, over, per_factor, unit, times) result(text)
      character(*), intent(in) :: column, over      !! columns of y and x, without the name of the wheel
      real(wp), intent(in) :: per_factor            !! load or displacement at `factor` = 1
      character(*), intent(in) :: unit              !! its unit, with a leading blank
      real(wp), intent(in) :: times(2)              !! factor of each wheel on the slope in the unit of the window; 0: no number
      character(:), allocatable :: text

      text = 'slope of the least-squares line of '//column//' over '//over
      if (over /= 'factor') then
         text = text//times_of(times)
         return
      end if
      if (abs(per_factor - 1.0_wp) > 0.0_wp) text = text//' (1: '//signed(per_factor)//unit//')'
      text = text//times_of(times/per_factor)
   end function slope_definition

   !> The factors on the slopes of the columns of both wheels, which include unit and sign: ', times 1000', or ', times −1000 (left
   !> wheel), 1000 (right wheel)'; '' if both are 1. The factor of a wheel without the number is 0.
   function times_of(times) result(text)
      real(wp), intent(in) :: times(2)
      character(:), allocatable :: text
      real(wp) :: both(2)

      both = times
      where (.not. abs(both) > 0.0_wp) both = times([2, 1])
      text = ''
      if (all(abs(both - 1.0_wp) <= 0.0_wp)) return
      if (abs(both(1) - both(2)) <= 0.0_wp) then
         text = ', times '//signed(both(1))
      else
         text = ', times '//signed(both(1))//' (left wheel), '//signed(both(2))//' (right wheel)'
      end if
   end function times_of

   !> A number with the minus sign of the page.
   function signed(number) result(text)
      real(wp), intent(in) :: number
      character(:), allocatable :: text

      text = str(abs(number), 9)
      if (number < 0.0_wp) text = '−'//text
   end function signed

end module ek_key_numbers
