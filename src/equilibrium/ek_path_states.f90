!> The states of a sweep, in storage that serves one design after the other: swept value and findings of
!> each state.
!>
!> These are the states of the schedule of a case, and those at the places where numbers are read: no number is interpolated
!> between two states. For a slope, these places are the five points of its window (ek_window).
module ek_path_states
   use ek_kinds, only: wp
   use ek_case, only: case_t, follows_table
   use ek_suspension, only: suspension_t
   use ek_state, only: coordinates
   use ek_reach, only: failure_t
   use ek_branch, only: max_crossings
   use ek_arc_survey, only: max_limits
   use ek_window, only: window_points, window_places, window_side, has_place, no_window
   implicit none(type, external)
   private
   public :: path_t, new_path, one_state, copy_state, insert_state, most_places, drop_readings, &
      nearest_state, nearest_reached, count_ways, ways, span

   !> All states of a sweep, in order from…to.
   type :: path_t
      integer :: states = 0
      integer :: start = 0                        !! index of the design state; 0 if the range does not contain design
      real(wp), allocatable :: value(:)           !! swept value: factor, change of the driven value [m, rad], or table row
      real(wp) :: step = 0.0_wp                   !! distance between two states of the schedule [swept value]
      logical, allocatable :: is_scheduled(:)     !! .false.: the state is not of the schedule; a number is read there
      logical, allocatable :: is_read(:)          !! a number is read at the state
      real(wp), allocatable :: packed(:, :)       !! (coordinate, state), see ek_state
      logical, allocatable :: is_reached(:)
      logical, allocatable :: is_stable(:)        !! no motion has a negative stiffness
      integer, allocatable :: iterations(:)       !! number of factorisations for each state
      real(wp), allocatable :: pivot_ratio(:)     !! smallest / largest pivot; if tiny, the condition estimate replaces a smaller
                                                  !! ratio
      real(wp), allocatable :: settled(:)         !! packed state under the constant loads only
      logical :: is_settled = .false.             !! there is an equilibrium under the constant loads
      logical :: is_table = .false.               !! the states are rows of a table, independent of each other
      integer :: crossings = 0                    !! number of bifurcations on the path
      real(wp) :: crossing_place(max_crossings) = 0.0_wp   !! swept values of these bifurcations
      integer :: limits = 0                       !! number of limit points (follow = 'arc')
      real(wp) :: limit_place(2*max_limits) = 0.0_wp
      integer :: limit_state(2*max_limits) = 0   !! index of the nearest state; 0: before the range begins
      type(failure_t) :: failure(2)               !! (1) towards `to`, or of the only direction; (2) towards `from`. (1) is also the
                                                  !! failure of static equilibrium, or of the first failed row of a table
   end type path_t

contains

   !> Sets the swept values of all states and allocates storage for the states.
   !>
   !> A range on both sides of design is swept outward in both directions. Its increments are divided in proportion. The places of
   !> readings within the range are added. A table, and a path by arc length, have no states at given swept values: nothing is added.
   subroutine new_path(suspension, case, path)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(inout) :: path        !! memory of a suitable size is used again
      real(wp) :: places(most_places(case))
      integer :: n, before, k, more

      n = case%increments
      path%start = 0
      if (case%from*case%to <= 0.0_wp) then
         ! the half is rounded on the same side of design for either direction of the case
         before = 0
         if (abs(case%from) + abs(case%to) > 0.0_wp) before = nint(n*abs(min(case%from, case%to))/(abs(case%from) + abs(case%to)))
         if (case%from > case%to) before = n - before
         if (abs(case%from) > 0.0_wp) before = max(before, 1)
         if (abs(case%to) > 0.0_wp) then
            n = max(n, before + merge(1, 0, abs(case%from) > 0.0_wp .and. n == 1))
            before = min(before, n - 1)
         end if
         path%start = before + 1
      end if
      path%is_table = .false.
      if (allocated(case%actuations)) path%is_table = path%start == 0 .and. any(case%actuations%law == follows_table)
      path%step = abs(case%to - case%from)/n
      more = 0
      if (size(places) > 0 .and. .not. (path%is_table .or. case%follows_arc)) &
         call find_places(case, path%start, n + 1, places, more)
      path%states = n + 1 + more
      call clear(coordinates(suspension), path)
      do k = 1, n + 1
         path%value(k) = scheduled(case, path%start, n + 1, k)
      end do
      do k = 1, more
         call insert(places(k), n + k, path)
      end do
      if (size(places) > 0) call mark_read(case, path)
   end subroutine new_path

   !> Swept value of state k of the schedule.
   pure real(wp) function scheduled(case, start, states, k) result(value)
      type(case_t), intent(in) :: case
      integer, intent(in) :: start, states         !! index of the design state, or 0; number of states of the schedule
      integer, intent(in) :: k

      value = 0.0_wp
      if (start == 0) then
         value = case%from + (case%to - case%from)*real(k - 1, wp)/(states - 1)
         if (k == states) value = case%to          ! not just nearly, as from + (to − from) is
      else if (k < start) then
         value = case%from*real(start - k, wp)/(start - 1)
      else if (k > start) then
         value = case%to*real(k - start, wp)/(states - start)
      end if
   end function scheduled

   !> Largest number of states that the readings of a case add to its path.
   pure integer function most_places(case)
      type(case_t), intent(in) :: case

      most_places = 0
      if (allocated(case%places)) most_places = size(case%places)
      if (allocated(case%windows)) most_places = most_places + window_points*size(case%windows, 2)
   end function most_places

   !> Finds the swept values of the readings of a case that lie within its range and are not of its schedule.
   pure subroutine find_places(case, start, states, places, many)
      type(case_t), intent(in) :: case             !! on the rig
      integer, intent(in) :: start, states         !! as for `scheduled`
      real(wp), intent(inout) :: places(:)         !! [SI]
      integer, intent(out) :: many
      real(wp) :: wanted(most_places(case)), low, high
      integer :: j, k, all_places

      many = 0
      low = min(case%from, case%to)
      high = max(case%from, case%to)
      call list_places(case, wanted, all_places)
      each: do j = 1, all_places
         if (.not. (wanted(j) > low .and. wanted(j) < high)) cycle
         if (any(has_place(places(:many), wanted(j), high - low))) cycle
         do k = 1, states
            if (has_place(scheduled(case, start, states, k), wanted(j), high - low)) cycle each
         end do
         many = many + 1
         places(many) = wanted(j)
      end do each
   end subroutine find_places

   !> Lists the swept values of all readings of a case. A window that the range of the case does not contain is left out.
   pure subroutine list_places(case, places, many)
      type(case_t), intent(in) :: case             !! on the rig
      real(wp), intent(out) :: places(:)           !! [SI]
      integer, intent(out) :: many
      real(wp) :: low, high
      integer :: k, side

      many = 0
      places = 0.0_wp
      low = min(case%from, case%to)
      high = max(case%from, case%to)
      if (allocated(case%places)) then
         many = size(case%places)
         places(:many) = case%places*case%unit
      end if
      if (.not. allocated(case%windows)) return
      do k = 1, size(case%windows, 2)
         side = window_side(case%windows(1, k)*case%unit, case%windows(2, k)*case%unit, low, high)
         if (side == no_window) cycle
         places(many + 1:many + window_points) = window_places(case%windows(1, k)*case%unit, case%windows(2, k)*case%unit, side)
         many = many + window_points
      end do
   end subroutine list_places

   !> Marks the states at which a number is read.
   pure subroutine mark_read(case, path)
      type(case_t), intent(in) :: case             !! on the rig
      type(path_t), intent(inout) :: path
      real(wp) :: places(most_places(case))
      integer :: k, many

      call list_places(case, places, many)
      do k = 1, path%states
         path%is_read(k) = any(has_place(places(:many), path%value(k), abs(case%to - case%from)))
      end do
   end subroutine mark_read

   !> Inserts a state where a number is read.
   pure subroutine insert(place, used, path)
      real(wp), intent(in) :: place                !! [SI], between two states
      integer, intent(in) :: used                  !! number of states before
      type(path_t), intent(inout) :: path
      integer :: k, j

      do k = 1, used - 1
         if ((path%value(k) < place) .neqv. (path%value(k + 1) < place)) exit
      end do
      do j = used, k + 1, -1
         path%value(j + 1) = path%value(j)
         path%is_scheduled(j + 1) = path%is_scheduled(j)
      end do
      path%value(k + 1) = place
      path%is_scheduled(k + 1) = .false.
      if (path%start > k) path%start = path%start + 1
   end subroutine insert

   !> Creates a path of one state, not reached.
   pure subroutine one_state(numbers, path)
      integer, intent(in) :: numbers               !! length of a packed state
      type(path_t), intent(inout) :: path

      path%states = 1
      call clear(numbers, path)
      path%is_scheduled = .false.
      path%is_read = .true.
   end subroutine one_state

   !> Copies a state, with its findings, to a path of one state.
   pure subroutine copy_state(path, k, one)
      type(path_t), intent(in) :: path
      integer, intent(in) :: k
      type(path_t), intent(inout) :: one           !! of one_state

      one%value(1) = path%value(k)
      one%packed(:, 1) = path%packed(:, k)
      one%is_reached(1) = path%is_reached(k)
      one%is_stable(1) = path%is_stable(k)
      one%iterations(1) = path%iterations(k)
      one%pivot_ratio(1) = path%pivot_ratio(k)
   end subroutine copy_state

   !> Inserts a state where a number is read into a solved path.
   pure subroutine insert_state(after, one, path)
      integer, intent(in) :: after                 !! index of the state before
      type(path_t), intent(in) :: one              !! path of this one state
      type(path_t), intent(inout) :: path

      associate (n => path%states, a => after)
         path%value = [path%value(:a), one%value(1), path%value(a + 1:n)]
         path%packed = reshape([path%packed(:, :a), one%packed(:, 1), path%packed(:, a + 1:n)], [size(one%packed, 1), n + 1])
         path%is_reached = [path%is_reached(:a), one%is_reached(1), path%is_reached(a + 1:n)]
         path%is_stable = [path%is_stable(:a), one%is_stable(1), path%is_stable(a + 1:n)]
         path%iterations = [path%iterations(:a), one%iterations(1), path%iterations(a + 1:n)]
         path%pivot_ratio = [path%pivot_ratio(:a), one%pivot_ratio(1), path%pivot_ratio(a + 1:n)]
         path%is_scheduled = [path%is_scheduled(:a), .false., path%is_scheduled(a + 1:n)]
         path%is_read = [path%is_read(:a), .true., path%is_read(a + 1:n)]
      end associate
      path%states = path%states + 1
      if (path%start > after) path%start = path%start + 1
      where (path%failure%state > after) path%failure%state = path%failure%state + 1
      where (path%limit_state > after) path%limit_state = path%limit_state + 1
   end subroutine insert_state

   !> Removes the states that are not of the schedule from a solved path.
   subroutine drop_readings(path)
      type(path_t), intent(inout) :: path
      integer, allocatable :: kept(:)
      integer :: k, side

      if (all(path%is_scheduled)) return
      kept = pack([(k, k=1, path%states)], path%is_scheduled)
      do side = 1, 2
         if (path%failure(side)%state > 0) path%failure(side)%state = new_index(path%failure(side)%state, side)
      end do
      do k = 1, path%limits
         path%limit_state(k) = count(path%is_scheduled(:path%limit_state(k)))
      end do
      path%start = findloc(kept, path%start, dim=1)
      path%value = path%value(kept)
      path%packed = path%packed(:, kept)
      path%is_reached = path%is_reached(kept)
      path%is_stable = path%is_stable(kept)
      path%iterations = path%iterations(kept)
      path%pivot_ratio = path%pivot_ratio(kept)
      path%is_scheduled = spread(.true., 1, size(kept))
      path%is_read = path%is_read(kept)
      path%states = size(kept)

   contains

      !> Index of the first scheduled state from a state on, in the direction of the sweep.
      pure integer function new_index(state, side)
         integer, intent(in) :: state, side
         integer :: ends(2, 2), direction

         ends = ways(path)
         direction = 1
         if (ends(2, side) < ends(1, side)) direction = -1
         if (direction > 0) new_index = findloc(kept >= state, .true., dim=1)
         if (direction < 0) new_index = findloc(kept <= state, .true., dim=1, back=.true.)
      end function new_index

   end subroutine drop_readings

   !> Allocates storage for the states of a path, and marks all states as not reached.
   pure subroutine clear(numbers, path)
      integer, intent(in) :: numbers              !! length of a packed state
      type(path_t), intent(inout) :: path         !! with the number of its states
      logical :: is_alike
      integer :: side

      is_alike = allocated(path%packed)
      if (is_alike) is_alike = size(path%packed, 1) == numbers .and. size(path%packed, 2) == path%states
      if (.not. is_alike) then
         if (allocated(path%packed)) deallocate (path%value, path%packed, path%is_reached, path%is_stable, path%iterations, &
            path%pivot_ratio, path%settled, path%is_scheduled, path%is_read)
         allocate (path%value(path%states), path%pivot_ratio(path%states), path%packed(numbers, path%states), &
            path%settled(numbers), path%is_reached(path%states), path%is_stable(path%states), path%iterations(path%states), &
            path%is_scheduled(path%states), path%is_read(path%states))
      end if
      path%value(:) = 0.0_wp
      path%packed(:, :) = 0.0_wp
      path%is_scheduled(:) = .true.
      path%is_read(:) = .false.
      path%is_reached(:) = .false.
      path%is_stable(:) = .true.
      path%iterations(:) = 0
      path%pivot_ratio(:) = 0.0_wp
      path%settled(:) = 0.0_wp
      path%is_settled = .false.
      path%crossings = 0
      path%crossing_place = 0.0_wp
      path%limits = 0
      path%limit_place = 0.0_wp
      path%limit_state = 0
      do side = 1, 2
         path%failure(side) = failure_t()
      end do
   end subroutine clear

   !> Index of the state whose swept value is nearest to a value, whether reached or not.
   pure integer function nearest_state(path, place) result(nearest)
      type(path_t), intent(in) :: path
      real(wp), intent(in) :: place                        !! SI
      nearest = minloc(abs(path%value - place), dim=1)
   end function nearest_state

   !> Index of the reached state whose swept value is nearest to a value; 0 if no state was reached.
   pure integer function nearest_reached(path, place) result(nearest)
      type(path_t), intent(in) :: path
      real(wp), intent(in) :: place                        !! SI
      nearest = minloc(abs(path%value - place), dim=1, mask=path%is_reached)
   end function nearest_reached

   !> Number of directions of a sweep: two if its range contains design, otherwise one.
   pure integer function count_ways(path)
      type(path_t), intent(in) :: path
      count_ways = merge(2, 1, path%start > 0)
   end function count_ways

   !> The first and the last state of each direction of a sweep, outward from design: (first or last state, direction); 0 if the
   !> direction does not exist.
   pure function ways(path) result(ends)
      type(path_t), intent(in) :: path
      integer :: ends(2, 2)

      if (path%start > 0) then
         ends = reshape([path%start, path%states, path%start, 1], [2, 2])
      else
         ends = 0
         ends(:, 1) = merge([1, path%states], [path%states, 1], abs(path%value(1)) < abs(path%value(path%states)))
      end if
   end function ways

   !> The scale of a path [swept value]: its range plus its largest magnitude; 1 row for a table.
   pure real(wp) function span(path)
      type(path_t), intent(in) :: path
      span = 1.0_wp
      if (.not. path%is_table) span = maxval(abs(path%value)) + maxval(path%value) - minval(path%value)
   end function span

end module ek_path_states
