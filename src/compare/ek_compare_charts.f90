!> The charts of a comparison: one per quantity of a test, with the curves of all results and their distance from the curves of the
!> first result.
module ek_compare_charts
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_window, only: polynomial
   use ek_test_result, only: design_row
   use ek_chart, only: chart_t, trace_t, add_trace, append_chart, cut_of, both_sides
   use ek_test_charts, only: test_charts
   use ek_report_files, only: results_t, test_number
   use ek_change, only: change_of, verdict_of, has_changed, letter_of
   implicit none(type, external)
   private
   public :: chart_change_t, curve_difference_t, compare_charts, at_states, at_common, between_states

   real(wp), parameter :: invisible = 1.0e-5_wp     !! largest difference of curves drawn as one, as a share of the scale

   real(wp), parameter :: same_abscissa = 1.0e-7_wp   !! difference of abscissae that are the same, as a share of the largest one

   !> The largest difference of a curve, or of all curves of a chart, from the curves of the first result.
   type :: chart_change_t
      real(wp) :: change = 0.0_wp             !! largest difference as a share of the scale (change_of), with its sign
      real(wp) :: largest = 0.0_wp            !! largest difference in the unit of the chart, with its sign
      real(wp) :: at = 0.0_wp                 !! abscissa of the largest difference
      logical :: is_changed = .false.         !! the change is larger than the threshold
      logical :: is_known = .false.           !! some states can be compared
      character(14) :: compared = ''          !! where the curves were compared: at_states, at_common or between_states
   end type chart_change_t

   character(14), parameter :: at_states = 'states', at_common = 'common states', between_states = 'between states'
   integer, parameter :: min_common = 3     !! least states of two results at the same abscissae for a comparison there alone

   !> The difference of a curve of one result from the curve of the first result. A curve that one of the two lacks has the
   !> difference NaN.
   type :: curve_difference_t
      character(:), allocatable :: test, chart, title, label, curve
      integer :: result = 2
      real(wp) :: change = 0.0_wp, largest = 0.0_wp, at = 0.0_wp
      character(12) :: verdict = ''
      character(14) :: compared = ''          !! as of the change
   end type curve_difference_t

   type :: chart_list_t
      type(chart_t), allocatable :: list(:)
   end type chart_list_t

contains

   !> Compares the charts of every test that the first result shares with another result. A curve that equals the curve of the first
   !> result is drawn once, as 'A = B'.
   subroutine compare_charts(results, threshold, charts, changes, curves)
      type(results_t), intent(in) :: results(:)
      real(wp), intent(in) :: threshold
      type(chart_t), allocatable, intent(out) :: charts(:)
      type(chart_change_t), allocatable, intent(out) :: changes(:)      !! largest change in each chart
      type(curve_difference_t), allocatable, intent(out) :: curves(:)
      type(chart_list_t) :: own(size(results))
      type(chart_t) :: chart
      type(chart_change_t) :: change
      integer :: t, u, r, k, used, places(size(results)), design(size(results))

      allocate (charts(0), changes(0), curves(0))
      used = 0
      do t = 1, size(results(1)%tests)
         design = 0
         do r = 1, size(results)
            u = test_number(results(r), results(1)%tests(t)%name)
            if (allocated(own(r)%list)) deallocate (own(r)%list)
            allocate (own(r)%list(0))
            if (u == 0) cycle
            call test_charts(results(r)%tests(u), own(r)%list, t)
            design(r) = design_row(results(r)%tests(u)%table)
         end do
         do k = 1, size(own(1)%list)
            do r = 1, size(results)
               places(r) = chart_number(own(r)%list, own(1)%list(k))
               if (r > 1 .and. places(r) > 0) call separate_sides(own(1)%list(k), own(r)%list(places(r)))
            end do
            call join(own, places, design, threshold, results(1)%tests(t)%name, chart, change, curves)
            if (all(places(2:) == 0)) cycle
            call append_chart(charts, used, chart)
            changes = [changes, change]
         end do
         do r = 2, size(results)
            do k = 1, size(own(r)%list)
               if (chart_number(own(1)%list, own(r)%list(k)) == 0) &
                  call add_lone(own(r)%list(k), results(1)%tests(t)%name, r, .false., curves)
            end do
         end do
      end do
      charts = charts(:used)
   end subroutine compare_charts

   !> Replaces each curve of both sides by a curve of either side where the chart of the first result has a curve of either side, so
   !> that each wheel is compared with the same wheel.
   pure subroutine separate_sides(mine, other)
      type(chart_t), intent(in) :: mine            !! chart of the first result
      type(chart_t), intent(inout) :: other
      type(chart_t) :: separated
      type(trace_t) :: trace
      integer, allocatable :: found(:)
      integer :: k, j

      separated = other
      separated%traces = other%traces(:0)
      do k = 1, size(other%traces)
         trace = other%traces(k)
         found = partners(mine, trace%title)
         if (size(found) < 2) call add_trace(separated, trace)
         do j = 1, merge(size(found), 0, size(found) > 1)
            trace%title = mine%traces(found(j))%title
            trace%colour = mine%traces(found(j))%colour
            trace%dash = mine%traces(found(j))%dash
            call add_trace(separated, trace)
         end do
      end do
      other = separated
   end subroutine separate_sides

   !> The index of the chart in a list that has the name and the abscissa of another chart; 0 if the list has no such chart.
   pure integer function chart_number(list, chart) result(number)
      type(chart_t), intent(in) :: list(:), chart

      do number = size(list), 1, -1
         if (list(number)%name == chart%name .and. list(number)%x_label == chart%x_label) return
      end do
   end function chart_number

   !> Adds to the list of differences every curve of a chart that only the first result or only result r has.
   subroutine add_lone(chart, test, r, is_of_first, curves)
      type(chart_t), intent(in) :: chart
      character(*), intent(in) :: test
      integer, intent(in) :: r                     !! the result that is compared with the first
      logical, intent(in) :: is_of_first
      type(curve_difference_t), allocatable, intent(inout) :: curves(:)
      integer :: k

      do k = 1, size(chart%traces)
         call add_curve(chart, test, chart%traces(k)%title, r, missing_change(), &
            verdict_of(0.0_wp, 0.0_wp, is_of_first, .not. is_of_first, r), curves)
      end do
   end subroutine add_lone

   !> The change of a curve or a chart that cannot be compared, or has not been compared yet: NaN.
   pure type(chart_change_t) function missing_change()
      real(wp) :: nothing

      nothing = ieee_value(1.0_wp, ieee_quiet_nan)
      missing_change = chart_change_t(nothing, nothing, nothing)
   end function missing_change

   subroutine add_curve(chart, test, title, r, change, verdict, curves)
      type(chart_t), intent(in) :: chart
      character(*), intent(in) :: test, title, verdict
      integer, intent(in) :: r
      type(chart_change_t), intent(in) :: change
      type(curve_difference_t), allocatable, intent(inout) :: curves(:)
      type(curve_difference_t) :: curve        ! one by one: gfortran 12 leaks texts in a structure constructor

      curve%test = test
      curve%chart = chart%name(len(test) + 2:)
      curve%title = chart%title
      curve%label = chart%y_label
      curve%curve = title
      curve%result = r
      curve%change = change%change
      curve%largest = change%largest
      curve%at = change%at
      curve%verdict = verdict
      curve%compared = change%compared
      curves = [curves, curve]
   end subroutine add_curve

   !> Joins the corresponding charts of all results into one chart. Finds the largest change, and adds the differences of the
   !> curves to their list.
   subroutine join(own, places, design, threshold, test, chart, change, curves)
      type(chart_list_t), intent(in) :: own(:)
      integer, intent(in) :: places(:)             !! index of the chart in each list; 0: not in the list
      integer, intent(in) :: design(:)             !! rows of the design state
      real(wp), intent(in) :: threshold
      character(*), intent(in) :: test
      type(chart_t), intent(out) :: chart
      type(chart_change_t), intent(out) :: change
      type(curve_difference_t), allocatable, intent(inout) :: curves(:)
      type(chart_change_t) :: one
      type(trace_t) :: trace
      integer, allocatable :: found(:)
      integer :: r, j, k, first
      logical :: is_elements
      character(:), allocatable :: letters

      chart = own(1)%list(places(1))
      first = size(chart%traces)
      chart%has_key = .true.
      is_elements = own(1)%list(places(1))%has_key
      do j = 1, first
         letters = letter_of(1)
         do r = 2, size(own)
            if (places(r) == 0) cycle
            associate (other => own(r)%list(places(r)))
               do k = 1, size(other%traces)
                  if (other%traces(k)%title /= chart%traces(j)%title) cycle
                  one = distance(chart%traces(j), other%traces(k), chart)
                  if (is_invisible(one)) letters = letters//' = '//letter_of(r)
               end do
            end associate
         end do
         call dress(chart%traces(j), letters, 1, is_elements)
      end do
      do r = 2, size(own)
         if (places(r) == 0) then
            call add_lone(own(1)%list(places(1)), test, r, .true., curves)
            cycle
         end if
         associate (mine => own(1)%list(places(1)), other => own(r)%list(places(r)))
            chart%is_level = chart%is_level .and. other%is_level
            do k = 1, size(other%traces)
               found = partners(mine, other%traces(k)%title)
               one = missing_change()
               do j = 1, size(found)
                  call take(distance(mine%traces(found(j)), other%traces(k), mine), one)
               end do
               call add_curve(mine, test, other%traces(k)%title, r, one, &
                  verdict_of(one%change, threshold, size(found) > 0, .true., r), curves)
               call take(one, change)
               if (is_invisible(one) .and. size(found) > 0) then
                  if (mine%traces(found(1))%title == other%traces(k)%title) cycle
               end if
               trace = other%traces(k)
               if (size(found) > 0) trace%reference = found(1)
               if (design(r) /= design(1)) trace%design = design(r)
               call name_columns(trace, mine, r)
               call dress(trace, letter_of(r), r, is_elements)
               call add_trace(chart, trace)
            end do
            do j = 1, first
               if (size(partners(other, mine%traces(j)%title)) == 0) &
                  call add_curve(mine, test, mine%traces(j)%title, r, missing_change(), &
                  verdict_of(0.0_wp, 0.0_wp, .true., .false., r), curves)
            end do
         end associate
      end do
      change%is_changed = has_changed(change%change, threshold)
   end subroutine join

   !> Whether the difference of two curves is invisible, so that they are drawn as one curve.
   pure logical function is_invisible(change)
      type(chart_change_t), intent(in) :: change

      is_invisible = change%is_known
      if (is_invisible) is_invisible = abs(change%change) <= invisible
   end function is_invisible

   !> Replaces the largest change by another change that is known and has a larger magnitude.
   pure subroutine take(one, largest)
      type(chart_change_t), intent(in) :: one
      type(chart_change_t), intent(inout) :: largest

      if (.not. one%is_known) return
      if (largest%is_known) then
         if (abs(one%change) <= abs(largest%change)) return
      end if
      largest = one
   end subroutine take

   !> Indices of the curves of a chart with which a curve of another result is compared: curves of the same name. A curve for
   !> both sides is compared with each side.
   pure function partners(chart, title) result(found)
      type(chart_t), intent(in) :: chart
      character(*), intent(in) :: title
      integer, allocatable :: found(:)
      integer :: k

      found = [integer ::]
      do k = 1, size(chart%traces)
         if (chart%traces(k)%title == title) then
            found = [k]
            return
         end if
         if (stands_for(chart%traces(k)%title, title) .or. stands_for(title, chart%traces(k)%title)) found = [found, k]
      end do
   end function partners

   !> Whether a curve of both sides, 'left = right' or 'coil (left = right)', includes the curve of one side, 'left' or
   !> 'right_coil'.
   pure logical function stands_for(joint, single)
      character(*), intent(in) :: joint, single
      integer :: at

      at = index(joint, ' ('//both_sides//')')
      stands_for = joint == both_sides .and. (single == 'left' .or. single == 'right')
      if (at > 0) stands_for = single == 'left_'//joint(:at - 1) .or. single == 'right_'//joint(:at - 1)
   end function stands_for

   !> Sets the name, colour and dash of a curve. The colour shows the result, and the right side is dashed. In a chart of several
   !> elements the colour shows the element, and dashes distinguish the results.
   pure subroutine dress(trace, letters, r, is_elements)
      type(trace_t), intent(inout) :: trace
      character(*), intent(in) :: letters
      integer, intent(in) :: r                  !! index of the result
      logical, intent(in) :: is_elements
      character(:), allocatable :: title

      title = letters
      if (len(trace%title) > 0) title = letters//', '//trace%title
      trace%title = title
      if (is_elements) then
         trace%dash = modulo(2*(r - 1) + min(trace%dash, 1), 4)
      else
         trace%colour = r
      end if
   end subroutine dress

   !> Sets the names under which the numbers of a curve are stored in the data of a page. Each result has separate names,
   !> except for an expression in parentheses. The abscissa of the first result is used if the abscissae are equal.
   pure subroutine name_columns(trace, chart, r)
      type(trace_t), intent(inout) :: trace
      type(chart_t), intent(in) :: chart
      integer, intent(in) :: r
      integer :: k
      logical :: is_same

      if (index(trace%column, '(') /= 1) trace%column = letter_of(r)//' '//trace%column
      is_same = .false.
      do k = 1, size(chart%traces)
         if (chart%traces(k)%over /= trace%over) cycle
         is_same = are_near(chart%traces(k)%x, trace%x)
         exit
      end do
      if (.not. is_same) trace%over = letter_of(r)//' '//trace%over
   end subroutine name_columns

   !> Whether two abscissae are equal to rounding.
   pure logical function are_near(a, b)
      real(wp), intent(in) :: a(:), b(:)
      real(wp) :: near

      are_near = size(a) == size(b)
      if (.not. are_near) return
      are_near = all(ieee_is_finite(a) .and. ieee_is_finite(b))
      if (.not. are_near) return
      near = same_abscissa*maxval(abs(a))
      are_near = all(abs(a - b) <= near)
   end function are_near

   !> The largest difference of curve b from curve a over their common range. Both are compared at their states: state by state if
   !> they have the same abscissae, otherwise at the abscissae where both have a state. A curve between the states of a would differ
   !> from the states of b by its own error. Only if there are fewer than min_common such abscissae, a is read at the states of b
   !> from a curve through six of its states (between_states). Independent states (has_points) are compared only if both have the
   !> same abscissae. The scale is the largest magnitude of a, or the least span of the chart if that is larger.
   pure type(chart_change_t) function distance(a, b, chart) result(change)
      type(trace_t), intent(in) :: a, b
      type(chart_t), intent(in) :: chart           !! chart of curve a
      real(wp) :: cut, scale, y, one, most, beyond
      character(:), allocatable :: unit
      integer :: k
      integer :: state(size(b%x))              ! of curve a, at the abscissa of each state of b; 0: none
      logical :: is_paired

      unit = unit_in(chart%y_label)
      change = missing_change()
      most = 0.0_wp
      beyond = 0.0_wp
      cut = cut_of(chart)
      if (.not. cut > 0.0_wp) cut = huge(1.0_wp)
      if (.not. any(ieee_is_finite(a%y))) return
      scale = max(chart%noise, min(cut, maxval(abs(a%y), mask=ieee_is_finite(a%y))))
      is_paired = are_near(a%x, b%x)
      if (chart%has_points .and. .not. is_paired) return     ! states without an order have nothing between them
      state = [(k, k=1, size(state))]
      change%compared = at_states
      if (.not. is_paired) then
         state = [(state_at(a, b%x(k)), k=1, size(state))]
         change%compared = merge(at_common, between_states, count(state > 0) >= min_common)
      end if
      do k = 1, size(b%y)
         if (.not. (ieee_is_finite(b%y(k)) .and. ieee_is_finite(b%x(k)))) cycle
         if (state(k) > 0) then
            y = a%y(state(k))
         else if (change%compared == between_states) then
            y = value_at(a, b%x(k))
         else
            cycle
         end if
         if (.not. ieee_is_finite(y)) cycle
         ! beyond the cut, towards a pole, a difference counts only by its part within the cut; it is given in full
         one = max(-cut, min(cut, b%y(k))) - max(-cut, min(cut, y))
         if (change%is_known) then
            if (abs(one) < most .or. abs(one) <= most .and. abs(b%y(k) - y) <= abs(change%largest)) cycle
         end if
         change%is_known = .true.
         most = abs(one)
         change%largest = b%y(k) - y
         change%at = b%x(k)
         change%change = change_of(scale, scale + one, scale, unit)
         beyond = max(abs(y), scale)
      end do
      if (.not. change%is_known) change%compared = ''
      ! every difference is beyond the cut
      if (change%is_known .and. .not. most > 0.0_wp) change%change = &
         change_of(beyond, beyond + change%largest, beyond, unit)
   end function distance

   !> The unit in the label of an axis: 'deg' of 'deg    (+ toe-in)', 'N' of 'force, N    (+ compression)'.
   pure function unit_in(label) result(unit)
      character(*), intent(in) :: label
      character(:), allocatable :: unit

      unit = label//'    ('
      unit = unit(:index(unit, '    (') - 1)
      unit = trim(unit(index(unit, ', ', back=.true.) + 1:))
      unit = trim(adjustl(unit))
   end function unit_in

   !> Index of the state of a curve at an abscissa; 0 if there is none, or if there are several.
   pure integer function state_at(curve, x) result(state)
      type(trace_t), intent(in) :: curve
      real(wp), intent(in) :: x
      real(wp) :: near
      integer :: k

      state = 0
      if (.not. (ieee_is_finite(x) .and. any(ieee_is_finite(curve%x)))) return
      near = same_abscissa*maxval(abs(curve%x), mask=ieee_is_finite(curve%x))
      do k = 1, size(curve%x)
         if (.not. (ieee_is_finite(curve%x(k)) .and. ieee_is_finite(curve%y(k)))) cycle
         if (abs(curve%x(k) - x) > near) cycle
         if (state > 0) then
            state = 0
            return
         end if
         state = k
      end do
   end function state_at

   !> The value of a curve at x, on the polynomial through three states on either side, or as many as there are with values and in
   !> order; NaN if no two adjacent states with values enclose x.
   pure real(wp) function value_at(curve, x)
      type(trace_t), intent(in) :: curve
      real(wp), intent(in) :: x
      integer :: k, first, last

      value_at = ieee_value(1.0_wp, ieee_quiet_nan)
      do k = 2, size(curve%x)
         if (.not. goes_on(k - 1, 1.0_wp) .and. .not. goes_on(k - 1, -1.0_wp)) cycle
         associate (p => curve%x(k - 1), q => curve%x(k))
            if (x < min(p, q) .or. x > max(p, q)) cycle
            first = k - 1
            last = k
            do while (first > max(1, k - 3))
               if (.not. goes_on(first - 1, q - p)) exit
               first = first - 1
            end do
            do while (last < min(size(curve%x), k + 2))
               if (.not. goes_on(last, q - p)) exit
               last = last + 1
            end do
         end associate
         value_at = polynomial(curve%x(first:last), curve%y(first:last), x)
         return
      end do

   contains

      !> Whether the curve has values at a state and the next one, and its abscissa changes in a direction.
      pure logical function goes_on(state, way)
         integer, intent(in) :: state
         real(wp), intent(in) :: way

         goes_on = all(ieee_is_finite([curve%x(state:state + 1), curve%y(state:state + 1)]))
         if (goes_on) goes_on = (curve%x(state + 1) - curve%x(state))*way > 0.0_wp
      end function goes_on

   end function value_at

end module ek_compare_charts
