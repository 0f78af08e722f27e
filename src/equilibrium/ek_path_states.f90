!> The states of a sweep, in storage that serves one design after the other: swept value and findings of
!> each state.
module ek_path_states
   use ek_kinds, only: wp
   use ek_case, only: case_t, follows_table
   use ek_suspension, only: suspension_t
   use ek_state, only: coordinates
   use ek_reach, only: failure_t
   use ek_branch, only: max_crossings
   use ek_arc_survey, only: max_limits
   implicit none(type, external)
   private
   public :: path_t, new_path, nearest_state, nearest_reached, count_ways, ways, span

   !> All states of a sweep, in order from…to.
   type :: path_t
      integer :: states = 0
      integer :: start = 0                        !! index of the design state; 0 if the range does not contain design
      real(wp), allocatable :: value(:)           !! swept value: factor, change of the driven value [m, rad], or table row
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
   !> A range on both sides of design is swept outward in both directions. Its increments are divided in proportion.
   subroutine new_path(suspension, case, path)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(inout) :: path        !! memory of a suitable size is used again
      integer :: n, before, k

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
      path%states = n + 1
      call clear(coordinates(suspension), path)
      do k = 1, n + 1
         if (path%start == 0) then
            path%value(k) = case%from + (case%to - case%from)*real(k - 1, wp)/n
         else if (k < path%start) then
            path%value(k) = case%from*real(path%start - k, wp)/(path%start - 1)
         else if (k > path%start) then
            path%value(k) = case%to*real(k - path%start, wp)/(n + 1 - path%start)
         end if
      end do
      if (path%start == 0) path%value(n + 1) = case%to      ! not just nearly, as from + (to − from) is
   end subroutine new_path

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
            path%pivot_ratio, path%settled)
         allocate (path%value(path%states), path%pivot_ratio(path%states), path%packed(numbers, path%states), &
            path%settled(numbers), path%is_reached(path%states), path%is_stable(path%states), path%iterations(path%states))
      end if
      path%value(:) = 0.0_wp
      path%packed(:, :) = 0.0_wp
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
