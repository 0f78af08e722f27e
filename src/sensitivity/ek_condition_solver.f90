!> Finds numbers of a deck for which results have given values, by Newton's method within bounds.
!>
!> Minimised is the sum of squares of the deviations, each divided by the weight of its condition. The result is never worse than
!> the start. With fewer conditions than unknowns, the change of the unknowns, in widths of their bounds, is as small as the search
!> finds from the start. An unknown whose effect on every condition is rounding noise does not move. Conditions that cannot all be
!> satisfied are satisfied in the sense of least squares, and the findings give the reason.
module ek_condition_solver
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_convergence
   use ek_singular_values, only: singular_values_t, decompose
   use ek_workspace, only: workspace_t
   use ek_wanted_number, only: wanted_number_t
   use ek_condition_search, only: unknown_t, search_t, open_search, set_targets, evaluate, minimise, shorten, approach, &
      deviations, sum_of_squares, is_close, distance_of
   implicit none(type, external)
   private
   public :: findings_t, solve_conditions

   !> The result of the search: unknowns, values before and after, effects and conflicts.
   type :: findings_t
      real(wp), allocatable :: x(:)                  !! values of the unknowns, in the units of their directions
      integer, allocatable :: held(:)                !! −1, +1: an unknown is held at its lower or upper bound; 0: not held
      real(wp), allocatable :: before(:), after(:)   !! values of the wanted numbers at the start and at the end
      real(wp) :: sum_before = 0.0_wp, sum_after = 0.0_wp     !! sum of squares where the search began, and at the end
      logical :: begins_at_bound = .false.           !! a number of the deck is outside its bounds; the search began at the bound
      logical, allocatable :: is_reached(:)          !! whether each condition is satisfied
      logical, allocatable :: is_fixed(:)            !! whether no unknown can change the wanted number
      real(wp), allocatable :: effect(:, :)          !! (condition, unknown): change if the unknown moves by the width of its
                                                     !! bounds, by the derivative; 0 if it is rounding noise
      integer :: rank = 0                            !! rank of the effects
      real(wp), allocatable :: conflict(:, :)        !! (condition, k): unit vectors of conditions that the unknowns cannot change
      integer :: sweeps = 0                          !! number of designs that were solved
   end type findings_t

   real(wp), parameter :: no_effect = 1.0e-9_wp     !! singular value that is an error of the derivatives, as a share of the largest
   real(wp), parameter :: far = 0.2_wp              !! change of the unknowns, in widths, from which on a nearer solution is sought

contains

   !> Finds unknowns that satisfy the conditions: wanted numbers equal to targets. The workspace then contains the numbers found.
   !> The search contains the targets and weights that were used. Creates strings.
   subroutine solve_conditions(unknowns, wanted, targets, weights, max_sweeps, workspace, search, found, error)
      type(unknown_t), intent(in) :: unknowns(:)
      type(wanted_number_t), intent(in) :: wanted(:)
      real(wp), intent(in) :: targets(:)                    !! targets of the wanted numbers, in their units; NaN: the value at the
                                                            !! start
      real(wp), intent(in) :: weights(:)                    !! deviation of each condition that counts as 1, in its unit; NaN: the
                                                            !! noticeable change of the quantity
      integer, intent(in) :: max_sweeps                     !! limit of the sweeps of one search
      type(workspace_t), intent(inout) :: workspace
      type(search_t), intent(out) :: search                 !! the search, at the numbers found
      type(findings_t), intent(out) :: found
      type(error_t), allocatable, intent(out) :: error      !! a wanted number has no value or no derivative at the start
      real(wp), allocatable :: best(:), reach(:)
      integer, allocatable :: held(:)
      logical :: can_shorten

      call open_search(unknowns, wanted, targets, weights, workspace, search, error)
      if (allocated(error)) return
      call evaluate(search, search%start, workspace)
      call set_targets(search)
      found%before = search%values%values
      found%begins_at_bound = any(abs(search%origin - search%start) > 0.0_wp)
      if (found%begins_at_bound) call evaluate(search, search%origin, workspace)
      if (.not. search%is_valid .or. .not. all(ieee_is_finite(search%targets))) then
         call fail(error, exit_convergence, 'the wanted numbers have no value or no derivative where the search begins')
         return
      end if
      search%reach = matmul(abs(search%values%jacobian), search%width)
      found%sum_before = sum_of_squares(search)
      call minimise(search, search%origin, max_sweeps, workspace, held)
      reach = max(search%reach, matmul(abs(search%values%jacobian), search%width))
      if (any(reach > 0.0_wp .and. .not. search%reach > 0.0_wp)) then      ! an effect begins only beyond the start
         search%reach = reach
         call minimise(search, search%origin, max_sweeps, workspace, held)
      end if
      can_shorten = size(unknowns) > count(search%reach > 0.0_wp)
      if (can_shorten .and. is_solved(search)) call shorten(search, max_sweeps, workspace)
      if (can_shorten .and. (distance_of(search, search%x) > far .or. .not. is_solved(search))) then
         best = search%x
         call seek_nearer(search, best, max_sweeps, workspace)
      end if
      call settle(search, workspace)
      found%held = held
      where (search%x > search%lower .and. search%x < search%upper) found%held = 0
      call conclude(search, found)
   end subroutine solve_conditions

   !> Whether all conditions are satisfied that the unknowns can change.
   pure logical function is_solved(search)
      type(search_t), intent(in) :: search
      is_solved = all(is_close(search) .or. .not. search%reach > 0.0_wp)
   end function is_solved

   !> Looks for a solution nearer to the origin on another way; otherwise the design is `best` again.
   subroutine seek_nearer(search, best, max_sweeps, workspace)
      type(search_t), intent(inout) :: search
      real(wp), intent(in) :: best(:)                       !! unknowns of the solution so far, which was evaluated last
      integer, intent(in) :: max_sweeps
      type(workspace_t), intent(inout) :: workspace
      logical :: is_solution

      is_solution = is_solved(search)
      call approach(search, workspace)
      if (search%is_valid) call shorten(search, max_sweeps, workspace)
      if (search%is_valid) then
         if (is_solved(search) .and. (.not. is_solution .or. distance_of(search, search%x) < distance_of(search, best))) return
      end if
      call evaluate(search, best, workspace)
   end subroutine seek_nearer

   !> Moves each unknown that has hardly moved back to its origin, unless the design is then worse.
   subroutine settle(search, workspace)
      type(search_t), intent(inout) :: search
      type(workspace_t), intent(inout) :: workspace
      real(wp), parameter :: hardly = 1.0e-9_wp             !! share of the width
      real(wp) :: x(size(search%x)), y(size(search%x)), before
      logical :: was_close(size(search%targets))

      x = search%x
      y = x
      where (abs(x - search%origin) <= hardly*search%width) y = search%origin
      if (all(abs(y - x) <= 0.0_wp)) return
      was_close = is_close(search)
      before = sum_of_squares(search)
      call evaluate(search, y, workspace)
      if (search%is_valid) then
         if (all(is_close(search) .or. .not. was_close) .and. (all(was_close) .or. sum_of_squares(search) <= before)) return
      end if
      call evaluate(search, x, workspace)
   end subroutine settle

   !> Records the findings at the design that was evaluated last.
   subroutine conclude(search, found)
      type(search_t), intent(in) :: search
      type(findings_t), intent(inout) :: found
      type(singular_values_t) :: parts
      real(wp), allocatable :: scaled(:, :)
      integer :: j

      found%x = search%x
      found%sweeps = search%values%sweeps
      found%after = search%values%values
      found%sum_after = sum_of_squares(search)
      found%effect = search%values%jacobian*spread(search%width, 1, size(search%targets))
      found%is_reached = is_close(search)
      found%is_fixed = .not. search%reach > 0.0_wp
      ! a bound holds only if the sum of squares would become smaller beyond it
      do j = 1, size(found%x)
         if (abs(sum(deviations(search)/search%weights**2*found%effect(:, j))) <= no_effect*found%sum_after) found%held(j) = 0
      end do
      scaled = found%effect/spread(max(search%reach, tiny(1.0_wp)), 2, size(search%width))
      call decompose(scaled, no_effect, parts, whole=1.0_wp)
      found%rank = parts%rank
      found%conflict = parts%left(:, parts%rank + 1:)
   end subroutine conclude

end module ek_condition_solver
