!> The states of a case at which a column has a given value: the path stops there, and a number is read (ek_table_reading).
!>
!> The states of the schedule enclose the value. A curve through four of them gives the first swept value, where the equilibrium is
!> found and observed. Each further swept value follows from the states found so far, until the column has the value. The state is
!> then inserted into the path and the table, each stop with a state of its own. If several pairs of states enclose the value, the
!> pair nearest to design is used. The states of the schedule alone decide, so that other readings of a case have no influence.
!>
!> A state of a linear method depends on its increments: the path is followed again, and stops at the swept value on its way. Between
!> the rows of a load table there is no state: a stop is a row, or there is none.
module ek_value_stops
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, add_place
   use ek_kkt, only: kkt_t
   use ek_state, only: coordinates
   use ek_window, only: polynomial
   use ek_path, only: path_t, sweep, walk_t, begin_between, reach_place
   use ek_path_states, only: one_state, copy_state, insert_state, nearest_reached
   use ek_sweep_table, only: observer_t, observe_one
   use ek_table, only: table_t, stop_t, column_index, insert_row, scheduled_rows
   use ek_test_result, only: unfolded_rows
   implicit none(type, external)
   private
   public :: stop_at_values

   real(wp), parameter :: tight = 1.0e-11_wp      !! deviation of the column at a stop, as a share of its range
   real(wp), parameter :: noisy = 1.0e-8_wp       !! deviation of a column whose noise allows no smaller one
   real(wp), parameter :: driven = 1.0e-7_wp      !! deviation of a driven height at the end of the range, as a share of its range
   integer, parameter :: most = 24                !! largest number of states for one stop

   !> The search for one stop: the column over the swept value.
   type :: search_t
      integer :: column = 0                        !! index of the column
      real(wp) :: wanted = 0.0_wp                  !! value of the column
      real(wp) :: range = 0.0_wp                   !! range of the column over the states of the schedule
      integer :: rows(2) = 0                       !! rows of the table that enclose the value, the first nearer to design; 0: none
      integer :: points = 0
      real(wp) :: s(most + 4) = 0.0_wp             !! swept values in the unit of the case: states around the value, then trials
      real(wp) :: x(most + 4) = 0.0_wp             !! values of the column there
      real(wp) :: ends(2) = 0.0_wp                 !! swept values that enclose the value
      real(wp) :: rest(2) = 0.0_wp                 !! deviations of the column there
   end type search_t

contains

   !> Adds the states where columns have given values to a solved path and its table. A stop without a state has the row 0.
   subroutine stop_at_values(stops, suspension, case, kkt, space, observer, path, table)
      type(stop_t), intent(in) :: stops(:)
      type(suspension_t), intent(in) :: suspension         !! on the rig
      type(case_t), intent(in) :: case
      type(kkt_t), intent(inout) :: kkt                    !! of the path
      type(walk_t), intent(inout) :: space                 !! of the path
      type(observer_t), intent(inout) :: observer          !! of the table
      type(path_t), intent(inout) :: path
      type(table_t), intent(inout) :: table                !! of `observe`
      integer :: k

      allocate (table%stops, source=stops)
      table%stops%row = 0
      do k = 1, size(stops)
         call stop_once(k, suspension, case, kkt, space, observer, path, table)
      end do
   end subroutine stop_at_values

   !> Finds the state of one stop, and inserts it.
   subroutine stop_once(number, suspension, case, kkt, space, observer, path, table)
      integer, intent(in) :: number                        !! index of the stop
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(kkt_t), intent(inout) :: kkt
      type(walk_t), intent(inout) :: space
      type(observer_t), intent(inout) :: observer
      type(path_t), intent(inout) :: path
      type(table_t), intent(inout) :: table
      type(search_t) :: search
      type(path_t) :: one
      real(wp) :: row(size(table%columns))
      logical :: is_found
      integer :: r, after

      call begin_search(table%stops(number), path%is_table, table, search)
      if (search%rows(1) == 0) return
      call one_state(coordinates(suspension), one)
      if (search%rows(1) == search%rows(2)) then
         call copy_state(path, state_of(search%rows(1)), one)
         row = table%values(:, search%rows(1))
         is_found = .true.
      else
         call find_state(suspension, case, path, [state_of(search%rows(1)), state_of(search%rows(2))], kkt, space, observer, &
            search, one, row, is_found)
      end if
      if (.not. is_found) return
      after = place_of(row(2))
      call insert_state(state_of(after), one, path)
      call insert_row(after, row, table)
      table%stops(number)%row = after + 1
      table%values(1, after + 1) = table%values(1, after)
      do r = after + 1, size(table%values, 2)
         table%values(1, r) = table%values(1, r) + 1.0_wp
      end do

   contains

      !> Index in the path of a row of the table.
      pure integer function state_of(row)
         integer, intent(in) :: row
         state_of = nint(table%values(1, row)) + 1
      end function state_of

      !> The last row at or before a swept value, between the rows that enclose it.
      pure integer function place_of(place) result(last)
         real(wp), intent(in) :: place
         real(wp) :: way
         integer :: k

         last = minval(search%rows)
         way = table%values(2, maxval(search%rows)) - table%values(2, last)
         do k = last + 1, maxval(search%rows) - 1
            if ((place - table%values(2, k))*way >= 0.0_wp) last = k
         end do
      end function place_of

   end subroutine stop_once

   !> Finds the two rows of the schedule that enclose the value, and the rows around them. Both are the same if it has the value.
   pure subroutine begin_search(stop, is_table, table, search)
      type(stop_t), intent(in) :: stop
      logical, intent(in) :: is_table                      !! there is nothing between the rows
      type(table_t), intent(in) :: table
      type(search_t), intent(out) :: search
      logical :: is_good(size(table%values, 2))
      integer, allocatable :: rows(:)
      real(wp), allocatable :: s(:), rest(:)
      real(wp) :: nearest, place
      integer :: k, n

      search%column = column_index(table, trim(stop%column))
      search%wanted = stop%value
      if (search%column == 0) return
      is_good = unfolded_rows(table) .and. scheduled_rows(table)
      is_good = is_good .and. ieee_is_finite(table%values(search%column, :))
      rows = pack([(k, k=1, size(is_good))], is_good)
      n = size(rows)
      if (n == 0) return
      s = table%values(2, rows)
      rest = table%values(search%column, rows) - stop%value
      search%range = maxval(rest) - minval(rest)
      nearest = huge(nearest)
      do k = 1, n
         if (abs(rest(k)) <= tight*search%range .and. abs(s(k)) <= nearest) then
            nearest = abs(s(k))
            search%rows = rows(k)                          ! a row with the value
         end if
         if (is_table .or. k == n) cycle
         if (.not. is_between(rest(k), rest(k + 1), tight*search%range)) cycle
         place = s(k) - rest(k)*(s(k + 1) - s(k))/(rest(k + 1) - rest(k))
         if (abs(place) > nearest) cycle
         nearest = abs(place)
         search%rows = rows(k:k + 1)
         if (abs(s(k)) > abs(s(k + 1))) search%rows = rows(k + 1:k:-1)
         search%points = min(k + 2, n) - max(k - 1, 1) + 1
         search%s(:search%points) = s(max(k - 1, 1):min(k + 2, n))
         search%x(:search%points) = rest(max(k - 1, 1):min(k + 2, n))
         search%ends = s(k:k + 1)
         search%rest = rest(k:k + 1)
      end do
      if (search%rows(1) > 0) return
      k = minloc(abs(rest), dim=1)                         ! a driven height ends a little before the end of its range
      if (abs(rest(k)) <= driven*search%range) search%rows = rows(k)
   end subroutine begin_search

   !> Whether the value lies between two states, and at neither of them.
   pure logical function is_between(a, b, slack)
      real(wp), intent(in) :: a, b                         !! deviations of the column
      real(wp), intent(in) :: slack
      is_between = min(a, b) < -slack .and. max(a, b) > slack
   end function is_between

   !> Finds the state at which the column has the value, between two states of the path.
   subroutine find_state(suspension, case, path, between, kkt, space, observer, search, one, row, is_found)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      integer, intent(in) :: between(2)                    !! states that enclose the value, the first nearer to design
      type(kkt_t), intent(inout) :: kkt
      type(walk_t), intent(inout) :: space
      type(observer_t), intent(inout) :: observer
      type(search_t), intent(inout) :: search
      type(path_t), intent(inout) :: one
      real(wp), intent(out) :: row(:)                      !! of each column
      logical, intent(out) :: is_found
      real(wp) :: place
      integer :: trial

      is_found = .false.
      if (case%method == 'equilibrium') call begin_between(space, suspension, case, path, between(1), &
         sign(1, between(2) - between(1)), kkt)
      do trial = 1, most
         place = next_place(search, trial)
         if (case%method == 'equilibrium') then
            call reach_place(space, suspension, case, place*case%unit, kkt, one)
         else
            call sweep_to(place, suspension, case, kkt, space, one)
         end if
         if (.not. one%is_reached(1)) return
         call observe_one(suspension, case, one, kkt, observer, row)
         associate (rest => row(search%column) - search%wanted)
            if (.not. ieee_is_finite(rest)) return
            is_found = abs(rest) <= merge(tight, noisy, trial < most/2)*search%range
            if (is_found) return
            call take(place, rest, search)
         end associate
      end do
   end subroutine find_state

   !> The swept value of the next trial: where the curve through the points has the value, or the line through the last two; halfway
   !> if it lies outside of the states that enclose the value.
   pure real(wp) function next_place(search, trial) result(place)
      type(search_t), intent(in) :: search
      integer, intent(in) :: trial
      integer, parameter :: smooth = 4                     ! trials after which a column has a corner at the value
      integer :: n

      n = search%points
      place = search%ends(1)
      if (trial <= smooth) then
         place = polynomial(search%x(:n), search%s(:n), 0.0_wp)
      else if (abs(search%x(n) - search%x(n - 1)) > 0.0_wp) then
         place = search%s(n) - search%x(n)*(search%s(n) - search%s(n - 1))/(search%x(n) - search%x(n - 1))
      end if
      if (place > minval(search%ends) .and. place < maxval(search%ends)) return
      place = search%ends(1) - search%rest(1)*(search%ends(2) - search%ends(1))/(search%rest(2) - search%rest(1))
      if (trial > smooth .and. modulo(trial, 2) == 0) place = 0.5_wp*sum(search%ends)
   end function next_place

   !> Adds a trial to the points, and replaces one of the states that enclose the value.
   pure subroutine take(place, rest, search)
      real(wp), intent(in) :: place, rest
      type(search_t), intent(inout) :: search
      integer :: side

      search%points = search%points + 1
      search%s(search%points) = place
      search%x(search%points) = rest
      side = merge(1, 2, rest*search%rest(1) > 0.0_wp)
      search%ends(side) = place
      search%rest(side) = rest
   end subroutine take

   !> Follows the path of a linear method again, with a stop at a swept value.
   subroutine sweep_to(place, suspension, case, kkt, space, one)
      real(wp), intent(in) :: place                        !! in the unit of the case
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(kkt_t), intent(inout) :: kkt
      type(walk_t), intent(inout) :: space
      type(path_t), intent(inout) :: one
      type(case_t) :: with_stop
      type(path_t) :: again
      integer :: k

      with_stop = case
      call add_place(place, with_stop)
      call sweep(suspension, with_stop, again, kkt, space=space)
      k = nearest_reached(again, place*case%unit)
      one%is_reached = .false.
      if (k > 0) call copy_state(again, k, one)
   end subroutine sweep_to

end module ek_value_stops
