!> Results and the differences between them: the decks, the gradients and key numbers, the curves.
module ek_comparison
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_quantity, only: unit_ending
   use ek_noise, only: is_noise, solved
   use ek_gradient, only: gradient_t
   use ek_report_files, only: results_t
   use ek_chart, only: chart_t, both_sides
   use ek_decimal, only: rounded
   use ek_page, only: page_number
   use ek_change, only: least_of, change_of, has_changed, relative_change
   use ek_compare_charts, only: chart_change_t, curve_difference_t
   use ek_deck_difference, only: deck_difference_t
   use ek_compare_targets, only: target_t
   implicit none(type, external)
   private
   public :: comparison_t, difference_t, compare_gradients, compare_numbers, results_shown, difference, percent, largest_change, &
      descending, counted, largest_lines

   character(*), parameter :: at_design = 'at design'

   !> One gradient or key number of all results. For a key number, `test` is its group and `column` its name for programs.
   type, extends(gradient_t) :: difference_t
      real(wp) :: least = 0.0_wp              !! least span of a chart; reference of a change if the value is smaller
      real(wp), allocatable :: values(:)      !! one per result; NaN if the result lacks the number
      logical, allocatable :: is_there(:)
   end type difference_t

   type :: comparison_t
      character(:), allocatable :: folder               !! folder of the page
      type(results_t), allocatable :: results(:)        !! compared results; the first is the reference
      real(wp) :: threshold = 0.01_wp                   !! limit above which a number or a chart counts as changed
      type(deck_difference_t), allocatable :: facts(:), deck(:)     !! differences of the runs and of the decks
      type(difference_t), allocatable :: rows(:), numbers(:)        !! gradients, key numbers
      type(difference_t), allocatable :: shown(:)       !! gradients and key numbers without repetition, sorted by change
      type(target_t), allocatable :: targets(:)         !! key numbers with a band in a deck
      type(chart_t), allocatable :: charts(:)           !! charts of the tests of the first result
      type(chart_change_t), allocatable :: changes(:)   !! largest change in each chart
      type(curve_difference_t), allocatable :: curves(:)
      type(message_list_t) :: missing                   !! messages on tests, columns and gradients that a result lacks
      logical :: is_static = .false.                    !! the page has the pictures of gnuplot, and no script
      logical :: has_pictures = .false.                 !! the pictures in the folder belong to this comparison
   end type comparison_t

contains

   !> Compares all gradients of all results. Gradients with the same test, quantity and side share a row. Rows are in the order of
   !> the first result, followed by gradients that only other results have.
   subroutine compare_gradients(results, rows)
      type(results_t), intent(in) :: results(:)
      type(difference_t), allocatable, intent(out) :: rows(:)
      integer :: s, used

      allocate (rows(sum([(size(results(s)%gradients), s=1, size(results))])))
      used = 0
      do s = 1, size(results)
         call take_rows(results(s)%gradients, s, size(results), .false., rows, used)
      end do
      rows = rows(:used)
   end subroutine compare_gradients

   !> Compares all key numbers of all results, by name. If a result has no key numbers, as a single table, there are no rows.
   subroutine compare_numbers(results, rows)
      type(results_t), intent(in) :: results(:)
      type(difference_t), allocatable, intent(out) :: rows(:)
      integer :: s, used

      allocate (rows(sum([(size(results(s)%numbers), s=1, size(results))])))
      used = 0
      if (all([(size(results(s)%numbers) > 0, s=1, size(results))])) then
         do s = 1, size(results)
            call take_rows(results(s)%numbers, s, size(results), .true., rows, used)
         end do
      end if
      rows = rows(:used)
   end subroutine compare_numbers

   !> Adds the values of result s to the rows, and a new row for each gradient or key number that has no row.
   subroutine take_rows(list, s, results, is_by_name, rows, used)
      type(gradient_t), intent(in) :: list(:)
      integer, intent(in) :: s, results
      logical, intent(in) :: is_by_name             !! a row is identified by `column`; otherwise by test, quantity and side
      type(difference_t), intent(inout) :: rows(:)
      integer, intent(inout) :: used
      integer :: k, row

      do k = 1, size(list)
         associate (g => list(k))
            do row = 1, used
               if (is_by_name) then
                  if (rows(row)%column == g%column) exit
               else if (rows(row)%test == g%test .and. rows(row)%quantity == g%quantity .and. rows(row)%side == g%side) then
                  exit
               end if
            end do
            if (row > used) then
               used = row
               rows(row)%gradient_t = g
               rows(row)%least = least_of(g%unit)
               allocate (rows(row)%values(results), rows(row)%is_there(results))
               rows(row)%values = ieee_value(1.0_wp, ieee_quiet_nan)
               rows(row)%is_there = .false.
            end if
            rows(row)%values(s) = g%value
            rows(row)%is_there(s) = .true.
            ! the design position does not depend on the test that gives the value
            if (index(rows(row)%window, at_design) > 0 .and. index(g%window, at_design) > 0) cycle
            if (rows(row)%window /= g%window) rows(row)%window = 'different windows'
         end associate
      end do
   end subroutine take_rows

   !> The difference b − a; NaN if a or b is missing.
   elemental real(wp) function difference(a, b)
      real(wp), intent(in) :: a, b

      difference = ieee_value(1.0_wp, ieee_quiet_nan)
      if (ieee_is_finite(a) .and. ieee_is_finite(b)) difference = b - a
   end function difference

   !> The change 100 (b − a)/|a| [%]; NaN if a or b is missing, or if a is only rounding noise (ek_noise).
   elemental real(wp) function percent(a, b, unit)
      real(wp), intent(in) :: a, b              !! in the unit
      character(*), intent(in) :: unit          !! 'deg/m'

      percent = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. (ieee_is_finite(a) .and. ieee_is_finite(b))) return
      if (is_noise(a, unit_ending(unit), 0.0_wp, solved)) return
      if (abs(b - a) < huge(1.0_wp)*min(1.0_wp, abs(a))/100) percent = 100*((b - a)/abs(a))
   end function percent

   !> The change of largest magnitude among the results of a row, with its sign; NaN if no change can be computed because values are
   !> missing.
   real(wp) function largest_change(row) result(largest)
      type(difference_t), intent(in) :: row
      real(wp) :: change
      integer :: r

      largest = ieee_value(1.0_wp, ieee_quiet_nan)
      do r = 2, size(row%values)
         change = change_of(row%values(1), row%values(r), row%least, row%unit)
         if (.not. ieee_is_finite(change)) cycle
         if (.not. ieee_is_finite(largest)) largest = change
         if (abs(change) > abs(largest)) largest = change
      end do
   end function largest_change

   !> The key numbers and gradients for a page, sorted by the size of the change; numbers without a value are last. A gradient
   !> that is also a key number is listed once, and so is an angle that is both toe and steer. Both sides share a row if every
   !> result has equal or opposite numbers for them.
   function results_shown(numbers, rows) result(shown)
      type(difference_t), intent(in) :: numbers(:), rows(:)
      type(difference_t), allocatable :: shown(:), others(:), joined(:)
      real(wp), allocatable :: changes(:)
      logical :: is_twin(size(rows))
      integer :: k, l

      is_twin = .false.
      do k = 1, size(rows)
         do l = 1, size(numbers)
            if (numbers(l)%quantity /= rows(k)%quantity .or. numbers(l)%side /= rows(k)%side) cycle
            is_twin(k) = is_twin(k) .or. are_same(numbers(l), rows(k), 1.0_wp)
         end do
      end do
      shown = numbers
      call join_sides(shown)
      others = pack(rows, .not. is_twin)
      call join_sides(others)
      allocate (joined(size(shown) + size(others)))      ! gfortran 12 leaks an array constructor of these
      joined(:size(shown)) = shown
      joined(size(shown) + 1:) = others
      call move_alloc(joined, shown)
      call drop_repeated_angles(shown)
      allocate (changes(size(shown)))
      do k = 1, size(shown)
         changes(k) = abs(largest_change(shown(k)))
         if (.not. ieee_is_finite(changes(k))) changes(k) = -1.0_wp
      end do
      shown = shown(descending(changes))

   end function results_shown

   !> Removes the second row of an angle that is listed as both toe and steer with equal magnitudes.
   subroutine drop_repeated_angles(list)
      type(difference_t), allocatable, intent(inout) :: list(:)
      logical :: is_repeated(size(list))
      integer :: k, l, r

      is_repeated = .false.
      do k = 2, size(list)
         do l = 1, k - 1
            if (list(k)%quantity == list(l)%quantity .or. list(k)%unit /= list(l)%unit) cycle
            if (as_toe(list(k)%quantity) /= as_toe(list(l)%quantity)) cycle
            if (list(k)%side /= list(l)%side .and. (is_one_side(list(k)%side) .or. is_one_side(list(l)%side))) cycle
            if (any(list(k)%is_there .neqv. list(l)%is_there)) cycle
            is_repeated(k) = is_repeated(k) .or. all([(page_number(abs(list(k)%values(r))) == &
               page_number(abs(list(l)%values(r))), r=1, size(list(k)%values))])
         end do
      end do
      list = pack(list, .not. is_repeated)
   end subroutine drop_repeated_angles

   !> A title with 'toe' instead of 'steer': 'bump toe (fitted)' for 'bump steer (fitted)'.
   pure function as_toe(title) result(text)
      character(*), intent(in) :: title
      character(:), allocatable :: text
      integer :: at

      text = title
      at = index(title, 'steer')
      if (at > 0) text = title(:at - 1)//'toe'//title(at + len('steer'):)
   end function as_toe

   pure logical function is_one_side(side)
      character(*), intent(in) :: side
      is_one_side = side == 'left' .or. side == 'right'
   end function is_one_side

   !> The largest changes above the threshold, one per line, in at most `most` lines: 'bump toe left: -2.47 → -0.968 deg/m (-60.8
   !> %), parallel_travel'. The percentage is that of the magnitude; the order is by the change against the least span.
   function largest_lines(shown, threshold, most) result(lines)
      type(difference_t), intent(in) :: shown(:)       !! sorted by change
      real(wp), intent(in) :: threshold
      integer, intent(in) :: most
      type(message_list_t) :: lines
      character(:), allocatable :: line
      character(:), allocatable :: reason
      real(wp) :: change, percent_of_a
      integer :: k, r

      do k = 1, size(shown)
         change = largest_change(shown(k))
         if (lines%count() == most .or. .not. has_changed(change, threshold)) exit
         line = trim(shown(k)%quantity//' '//shown(k)%side)//': '//str(shown(k)%values(1), 4)
         do r = 2, size(shown(k)%values)
            line = line//' → '//str(shown(k)%values(r), 4)
         end do
         do r = 2, size(shown(k)%values) - 1      ! the result of the largest change
            if (abs(change_of(shown(k)%values(1), shown(k)%values(r), shown(k)%least, shown(k)%unit) - change) <= 0.0_wp) exit
         end do
         call relative_change(shown(k)%values(1), shown(k)%values(r), shown(k)%unit, percent_of_a, reason)
         if (ieee_is_finite(percent_of_a)) then
            reason = str(percent_of_a, 3)//' %'
            if (percent_of_a > 0.0_wp) reason = '+'//reason
         end if
         call lines%add(line//' '//shown(k)%unit//' ('//reason//'), '//shown(k)%test)
      end do
   end function largest_lines

   !> Joins the rows of both sides of an axle if they show equal or opposite numbers.
   subroutine join_sides(list)
      type(difference_t), allocatable, intent(inout) :: list(:)
      logical :: is_twin(size(list))
      integer :: k, l

      is_twin = .false.
      do k = 1, size(list)
         if (list(k)%side /= 'left') cycle
         do l = 1, size(list)
            if (list(l)%side /= 'right' .or. list(l)%quantity /= list(k)%quantity .or. list(l)%test /= list(k)%test) cycle
            if (is_twin(l)) cycle
            if (are_same(list(k), list(l), 1.0_wp)) then
               list(k)%side = both_sides
            else if (are_same(list(k), list(l), -1.0_wp)) then
               list(k)%side = 'left, right opposite'
            else
               cycle
            end if
            is_twin(l) = .true.
            exit
         end do
      end do
      list = pack(list, .not. is_twin)
   end subroutine join_sides

   !> Whether two rows show equal numbers for every result; with sign = −1, opposite numbers.
   logical function are_same(one, other, sign)
      type(difference_t), intent(in) :: one, other
      real(wp), intent(in) :: sign
      integer :: r

      are_same = all(one%is_there .eqv. other%is_there) .and. one%unit == other%unit
      do r = 1, size(one%values)
         if (are_same) are_same = page_number(one%values(r)) == page_number(sign*other%values(r))
      end do
   end function are_same

   !> The indices of values in descending order; values that are equal to six digits are in their original order.
   pure function descending(values) result(order)
      real(wp), intent(in) :: values(:)
      integer :: order(size(values))
      real(wp) :: sizes(size(values))
      integer :: k, j

      sizes = rounded(values, 6)
      do k = 1, size(values)
         do j = k - 1, 1, -1
            if (sizes(order(j)) >= sizes(k)) exit
            order(j + 1) = order(j)
         end do
         order(j + 1) = k
      end do
   end function descending

   !> A count for the page: '12 of 118 key numbers changed by more than 1 %'.
   function counted(some, all, what, threshold) result(text)
      integer, intent(in) :: some, all
      character(*), intent(in) :: what           !! in the plural
      real(wp), intent(in) :: threshold
      character(:), allocatable :: text

      text = str(some)//' of '//str(all)//' '//what//' changed by more than '//str(100*threshold, 4)//' %'
   end function counted

end module ek_comparison
