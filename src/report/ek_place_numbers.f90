!> Key numbers at particular states of a test: ratio and Ackermann with the inner wheel at 20 deg, wheel travel to the contact
!> of a stop, and the maximum force on the rack over all tests.
module ek_place_numbers
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_text, only: spaced
   use ek_table, only: column_index
   use ek_test_result, only: test_result_t, design_row, unfolded_rows
   implicit none(type, external)
   private
   public :: key_number_t, new_number, nothing, set_value, append, is_good, place_numbers

   real(wp), parameter :: inner_steer = 20.0_wp        !! deg: a tight corner in town, a usual reference for steering
   character(*), parameter :: gap_ending = '_gap_mm'

   !> One key number of a report.
   type :: key_number_t
      character(:), allocatable :: group, quantity, unit, sign
      real(wp) :: left = 0.0_wp, right = 0.0_wp      !! not a number if missing
      logical :: is_of_axle = .false.                !! one number, in `left`
   end type key_number_t

contains

   !> The value of a missing number.
   pure real(wp) function nothing()
      nothing = ieee_value(1.0_wp, ieee_quiet_nan)
   end function nothing

   !> A number without values.
   subroutine new_number(group, quantity, unit, sign, number)
      character(*), intent(in) :: group, quantity, unit, sign
      type(key_number_t), intent(out) :: number

      number%group = group
      number%quantity = quantity
      number%unit = unit
      number%sign = sign
      number%left = nothing()
      number%right = nothing()
   end subroutine new_number

   !> Sets the value of a wheel: a single wheel has it in `left`.
   pure subroutine set_value(number, test, wheel, value)
      type(key_number_t), intent(inout) :: number
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: wheel
      real(wp), intent(in) :: value

      if (test%sides(wheel) > 0 .and. size(test%prefixes) > 1) then
         number%right = value
      else
         number%left = value
      end if
   end subroutine set_value

   pure logical function has_value(number)
      type(key_number_t), intent(in) :: number
      has_value = ieee_is_finite(number%left) .or. ieee_is_finite(number%right)
   end function has_value

   !> Appends these numbers as far as the tests provide them.
   subroutine place_numbers(tests, numbers)
      type(test_result_t), intent(in) :: tests(:)
      type(key_number_t), allocatable, intent(inout) :: numbers(:)
      integer :: t

      t = findloc([(tests(t)%kind == 'parallel_travel', t=1, size(tests))], .true., dim=1)
      if (t > 0) call add_stops(tests(t), numbers)
      t = findloc([(tests(t)%kind == 'steering', t=1, size(tests))], .true., dim=1)
      if (t > 0) then
         call add_at_steer(tests(t), 'steering_ratio', 'steering ratio at 20 deg', '–', numbers)
         call add_at_steer(tests(t), 'ackermann_percent', 'Ackermann at 20 deg', '%', numbers)
      end if
      call add_rack_force(tests, numbers)
   end subroutine place_numbers

   !> A column with the inner wheel at 20 deg: `left` is the turn to the left, with the left wheel inside.
   subroutine add_at_steer(test, column, quantity, unit, numbers)
      type(test_result_t), intent(in) :: test
      character(*), intent(in) :: column, quantity, unit
      type(key_number_t), allocatable, intent(inout) :: numbers(:)
      type(key_number_t) :: number
      real(wp) :: value
      integer :: k

      call new_number('Steering', quantity, unit, 'inner wheel at 20 deg: left in a turn to the left', number)
      do k = 1, size(test%prefixes)
         value = value_where(test, trim(test%prefixes(k))//'steer_deg', -test%sides(k)*inner_steer, column)
         call set_value(number, test, k, value)
      end do
      if (has_value(number)) call append(number, numbers)
   end subroutine add_at_steer

   !> Wheel travel from design to the contact of a stop on its side, both wheels in parallel.
   subroutine add_stops(test, numbers)
      type(test_result_t), intent(in) :: test
      type(key_number_t), allocatable, intent(inout) :: numbers(:)
      type(key_number_t) :: number
      character(:), allocatable :: stop
      integer :: c, ends

      do c = 1, size(test%table%columns)
         ends = len_trim(test%table%columns(c)) - len(gap_ending)
         if (ends < 1) cycle
         if (test%table%columns(c) (ends + 1:) /= gap_ending) cycle
         stop = test%table%columns(c) (:ends)
         if (column_index(test%table, stop//'_force_n') == 0) cycle
         ! with the left one
         if (index(stop, 'right_') == 1 .and. column_index(test%table, 'left_'//stop(7:)//gap_ending) > 0) cycle
         call new_number('Ride', '', 'mm', 'from design to contact, parallel travel', number)
         if (index(stop, 'right_') == 1) then
            number%right = travel_to(test, stop, 'right_')
            stop = stop(7:)
         else if (index(stop, 'left_') == 1) then
            stop = stop(6:)
            number%left = travel_to(test, 'left_'//stop, 'left_')
            number%right = travel_to(test, 'right_'//stop, 'right_')
         else
            number%left = travel_to(test, stop, '')
            number%is_of_axle = size(test%prefixes) > 1
         end if
         number%quantity = 'wheel travel to '//spaced(stop)
         if (has_value(number)) call append(number, numbers)
      end do
   end subroutine add_stops

   !> Wheel travel between design and the contact of a stop [mm], never negative; not a number without contact.
   real(wp) function travel_to(test, stop, prefix) result(travel)
      type(test_result_t), intent(in) :: test
      character(*), intent(in) :: stop, prefix       !! prefix: side of the stop, or ''
      character(:), allocatable :: column
      integer :: row

      column = prefix//'wheel_travel_mm'
      if (column_index(test%table, column) == 0) column = trim(test%prefixes(1))//'wheel_travel_mm'
      row = design_row(test%table)
      travel = nothing()
      if (row == 0) return
      travel = abs(value_where(test, stop//gap_ending, 0.0_wp, column) - test%table%values(column_index(test%table, column), row))
   end function travel_to

   !> The maximum magnitude of the force on the rack over all states of all tests.
   subroutine add_rack_force(tests, numbers)
      type(test_result_t), intent(in) :: tests(:)
      type(key_number_t), allocatable, intent(inout) :: numbers(:)
      type(key_number_t) :: number
      integer :: t, place

      call new_number('Steering', 'maximum rack force', 'N', 'magnitude, over all tests', number)
      do t = 1, size(tests)
         place = column_index(tests(t)%table, 'steering_rack_force_n')
         if (place == 0) cycle
         associate (force => tests(t)%table%values(place, :))
            if (.not. any(is_good(tests(t), place))) cycle
            if (.not. ieee_is_finite(number%left)) number%left = 0.0_wp
            number%left = max(number%left, maxval(abs(force), mask=is_good(tests(t), place)))
         end associate
      end do
      number%is_of_axle = .true.
      if (has_value(number)) call append(number, numbers)
   end subroutine add_rack_force

   !> A column at the point where another one has a given value, interpolated linearly between two neighbouring states; of
   !> several such points the one nearest to design. Not a number if there is none.
   real(wp) function value_where(test, over, wanted, column) result(value)
      type(test_result_t), intent(in) :: test
      character(*), intent(in) :: over, column
      real(wp), intent(in) :: wanted
      real(wp) :: share, nearest
      logical, allocatable :: is_usable(:)
      integer :: x, y, f, k

      value = nothing()
      x = column_index(test%table, over)
      y = column_index(test%table, column)
      f = column_index(test%table, 'factor')
      if (min(x, y, f) == 0) return
      is_usable = is_good(test, x) .and. is_good(test, y)
      nearest = huge(nearest)
      do k = 1, size(is_usable) - 1
         if (.not. all(is_usable(k:k + 1))) cycle
         associate (from => test%table%values(:, k), to => test%table%values(:, k + 1))
            if ((from(x) - wanted)*(to(x) - wanted) > 0.0_wp .or. .not. abs(to(x) - from(x)) > 0.0_wp) cycle
            share = (wanted - from(x))/(to(x) - from(x))
            if (abs(from(f) + share*(to(f) - from(f))) >= nearest) cycle
            nearest = abs(from(f) + share*(to(f) - from(f)))
            value = from(y) + share*(to(y) - from(y))
         end associate
      end do
   end function value_where

   !> The states that converged and have a number in a column.
   pure function is_good(test, place)
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: place
      logical :: is_good(size(test%table%values, 2))
      is_good = unfolded_rows(test%table) .and. ieee_is_finite(test%table%values(place, :))
   end function is_good

   !> Inserts a number behind the last of its group.
   subroutine append(number, numbers)
      type(key_number_t), intent(in) :: number
      type(key_number_t), allocatable, intent(inout) :: numbers(:)
      integer :: k, at

      at = findloc([(numbers(k)%group == number%group, k=1, size(numbers))], .true., dim=1, back=.true.)
      if (at == 0) at = size(numbers)
      numbers = [numbers(:at), number, numbers(at + 1:)]
   end subroutine append

end module ek_place_numbers
