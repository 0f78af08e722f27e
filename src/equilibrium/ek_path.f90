!> A sweep: from design outward to both ends of a case, one state after the other.
!>
!> A state that does not converge is approached by halved increments; if that fails too, the sweep in
!> that direction ends, and the states before it are kept. The rows of a table are independent states:
!> if one does not converge, the next is reached from design.
module ek_path
   use ek_kinds, only: wp
   use ek_case, only: case_t, follows_table
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, demand_t, design_state, coordinates, pack_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, demand_at
   use ek_kkt, only: kkt_t, condition
   use ek_reach, only: failure_t, reach, settle
   use ek_recursion, only: carry_t, start_recursion, recursive_increment, corrected_increment, &
      check_increment
   use ek_branch, only: branch_t, new_branch, leave, note_crossing, most_crossings
   use ek_confirm, only: confirm
   use ek_arc, only: arc_t, new_arc, begin
   use ek_arc_survey, only: survey_t, survey, go_to, length_at, tell_limits, most_limits, arrived
   use ek_predictor, only: predictor_t, new_predictor, remember, forget, depth
   implicit none(type, external)
   private
   public :: path_t, sweep, new_path, walk, progress_procedure

   real(wp), parameter :: least_step = 4.0e-10_wp     !! of the range: resolution of the end of a path
   real(wp), parameter :: crossing_step = 1.0e-6_wp   !! likewise; nearer at a bifurcation the matrix is too singular
   real(wp), parameter :: least_of_row = 0.0078125_wp    !! behind the first row of a table that was not found

   abstract interface
      !> Called at intervals with the number of states done and the total.
      subroutine progress_procedure(done, total)
         integer, intent(in) :: done, total
      end subroutine progress_procedure
   end interface

   !> All states of a sweep, in order from…to.
   type :: path_t
      integer :: states = 0
      integer :: start = 0                        !! index of the design state, 0 if the range leaves it out
      real(wp), allocatable :: value(:)           !! place: factor, or change of the driven value [m, rad]
      real(wp), allocatable :: packed(:, :)       !! (coordinate, state), see ek_state
      logical, allocatable :: is_reached(:)
      logical, allocatable :: is_stable(:)        !! no negative stiffness
      integer, allocatable :: iterations(:)       !! factorisations spent on a state
      real(wp), allocatable :: pivot_ratio(:)     !! cheap condition estimate; where that is tiny, the true one
      real(wp), allocatable :: settled(:)         !! packed state under the constant loads only
      logical :: is_settled = .false.             !! there is an equilibrium under the constant loads
      logical :: is_table = .false.               !! rows of a table, each an independent state
      integer :: crossings = 0                    !! number of bifurcations on the path
      real(wp) :: crossing_place(most_crossings) = 0.0_wp   !! their places
      integer :: limits = 0                       !! number of limit points (follow = 'arc'), and their places
      real(wp) :: limit_place(2*most_limits) = 0.0_wp
      integer :: limit_state(2*most_limits) = 0   !! index of the nearest state; 0: before the range begins
      type(failure_t) :: failure(2)               !! towards `to`, towards `from`; or while settling; or of a table's first lost row
   end type path_t

contains

   !> Sweeps a case; failures are returned in path%failure and never stop the program.
   subroutine sweep(suspension, case, path, kkt, progress)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(out) :: path
      type(kkt_t), intent(inout) :: kkt                        !! of new_kkt
      procedure(progress_procedure), optional :: progress

      call new_path(suspension, case, path)
      call walk(suspension, case, path, kkt, progress)
      if (case%method /= 'equilibrium') call confirm_path(suspension, case, path, kkt)
   end subroutine sweep

   !> Rejects states of a linear method that are not on the path from design.
   subroutine confirm_path(suspension, case, path, kkt)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(inout) :: path
      type(kkt_t), intent(inout) :: kkt
      real(wp) :: least

      least = least_step*span(path)
      if (path%is_table) return        ! its rows do not form one path
      if (path%start > 0) then
         call one_way(path%start, path%states, 1, path%failure(1))
         call one_way(path%start, 1, -1, path%failure(2))
      else if (abs(path%value(1)) < abs(path%value(path%states))) then
         call one_way(1, path%states, 1, path%failure(1))
      else
         call one_way(path%states, 1, -1, path%failure(1))
      end if

   contains

      subroutine one_way(first, last, direction, failure)
         integer, intent(in) :: first, last, direction
         type(failure_t), intent(inout) :: failure

         call confirm(suspension, new_schedule(suspension, case), path%value, path%packed, first, last, direction, least, &
            kkt, path%is_reached, failure)
      end subroutine one_way

   end subroutine confirm_path

   !> Sets the places of all states and allocates storage for them.
   !>
   !> A range around design is swept outward in both directions, its increments divided in proportion.
   subroutine new_path(suspension, case, path)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(out) :: path
      integer :: n, before, k

      n = case%increments
      if (case%from*case%to <= 0.0_wp) then
         ! the half is rounded on the same side of design for either direction of the case
         before = nint(n*abs(min(case%from, case%to))/(abs(case%from) + abs(case%to)))
         if (case%from > case%to) before = n - before
         if (abs(case%from) > 0.0_wp) before = max(before, 1)
         if (abs(case%to) > 0.0_wp) then
            n = max(n, before + merge(1, 0, abs(case%from) > 0.0_wp .and. n == 1))
            before = min(before, n - 1)
         end if
         path%start = before + 1
      end if
      path%states = n + 1
      if (allocated(case%actuations)) path%is_table = path%start == 0 .and. any(case%actuations%law == follows_table)
      allocate (path%value(n + 1), path%pivot_ratio(n + 1), source=0.0_wp)
      allocate (path%packed(coordinates(suspension), n + 1), path%settled(coordinates(suspension)), source=0.0_wp)
      allocate (path%is_reached(n + 1), source=.false.)
      allocate (path%is_stable(n + 1), source=.true.)
      allocate (path%iterations(n + 1), source=0)
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

   !> Follows the whole path of new_path.
   subroutine walk(suspension, case, path, kkt, progress)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(inout) :: path
      type(kkt_t), intent(inout) :: kkt
      procedure(progress_procedure), optional :: progress
      type(state_t) :: state
      type(carry_t) :: carry
      type(predictor_t) :: predictor
      type(branch_t) :: branch
      type(schedule_t) :: schedule
      type(arc_t) :: arc
      type(demand_t) :: demand
      logical :: is_along_arc
      real(wp) :: here                   ! the place of `state`
      integer :: done, settled_negative

      schedule = new_schedule(suspension, case)
      here = 0.0_wp
      call demand_at(schedule, here, demand)
      predictor = new_predictor(size(path%settled))
      branch = new_branch(suspension)
      is_along_arc = case%follows_arc .and. case%method == 'equilibrium' .and. .not. path%is_table
      if (is_along_arc) arc = new_arc(suspension, kkt%length, maxval(abs(path%value)), case%tolerance)
      path%limits = 0
      branch%least = least_step*span(path)
      branch%width = crossing_step*span(path)
      settled_negative = -1
      state = design_state(suspension)
      path%failure = failure_t()
      path%is_reached = .false.
      if (case%method == 'recursive') then
         call start_recursion(suspension, state, kkt, carry)
      else
         call settle(suspension, case%tolerance, state, kkt, path%failure(1))
         if (path%failure(1)%state > 0) return
         settled_negative = kkt%negative
      end if
      call pack_state(state, path%settled)
      path%is_settled = .true.
      done = 0
      if (path%is_table) then
         call walk_rows(path%failure(1))
      else if (path%start > 0) then
         call keep(path%start)
         call walk_branch(path%start, path%states, 1, path%failure(1))
         call walk_branch(path%start, 1, -1, path%failure(2))
      else if (abs(path%value(1)) < abs(path%value(path%states))) then
         call approach(1)
         if (path%failure(1)%state == 0) call walk_branch(1, path%states, 1, path%failure(1))
      else
         call approach(path%states)
         if (path%failure(1)%state == 0) call walk_branch(path%states, 1, -1, path%failure(1))
      end if
      path%crossings = branch%crossings
      path%crossing_place = branch%crossing_place

   contains

      !> Stores the current state as state k.
      subroutine keep(k)
         integer, intent(in) :: k
         real(wp), parameter :: suspect = 1.0e-12_wp
         real(wp) :: rcond

         call pack_state(state, path%packed(:, k))
         path%is_reached(k) = .true.
         path%is_stable(k) = kkt%negative == kkt%nc
         path%pivot_ratio(k) = kkt%pivot_ratio
         if (kkt%pivot_ratio < suspect .and. case%method /= 'recursive') then
            ! a small pivot may be one of a well-conditioned matrix
            call condition(suspension, state, demand, kkt, rcond)
            path%pivot_ratio(k) = max(path%pivot_ratio(k), rcond)
         end if
         done = done + 1
         if (present(progress)) then
            if (mod(done, 1000) == 0) call progress(done, path%states)
         end if
      end subroutine keep

      !> Goes from design to the nearer end of a range that excludes design, in increments of the same size.
      subroutine approach(k)
         integer, intent(in) :: k
         integer :: step, steps
         real(wp) :: size_of_one

         if (is_along_arc) return      ! walk_arc starts at design
         size_of_one = abs(path%value(2) - path%value(1))
         steps = max(1, nint(abs(path%value(k))/size_of_one))
         call restart()
         do step = 1, steps
            call advance(path%value(k)*real(step, wp)/steps, k, path%failure(1))
            if (path%failure(1)%state > 0) return
         end do
         call keep(k)
      end subroutine approach

      !> Goes from row to row of a table, and from design again after a row that did not converge; `lost` is the first of those.
      subroutine walk_rows(lost)
         type(failure_t), intent(inout) :: lost
         type(failure_t) :: failure
         integer :: k

         call restart()
         do k = 1, path%states
            failure = failure_t()
            call advance(path%value(k), k, failure)
            if (failure%state == 0) then
               call keep(k)
               cycle
            end if
            if (lost%state == 0) lost = failure
            branch%least = least_of_row
            schedule%rest = nint(path%value(k))
            call restart()
         end do
      end subroutine walk_rows

      !> Goes from state `first` (known) to state `last`.
      subroutine walk_branch(first, last, direction, failure)
         integer, intent(in) :: first, last, direction
         type(failure_t), intent(inout) :: failure
         integer :: k

         if (is_along_arc) call walk_arc(first, last, direction, failure)
         if (is_along_arc) return
         if (first == path%start) then
            call restart()
            call seed(first, -direction)
         end if
         do k = first + direction, last, direction
            call advance(path%value(k), k, failure)
            if (failure%state > 0) return
            call keep(k)
         end do
      end subroutine walk_branch

      !> States `first` to `last` at equal distances along the path; the last is omitted if the path does not reach it.
      subroutine walk_arc(first, last, direction, failure)
         integer, intent(in) :: first, last, direction
         type(failure_t), intent(inout) :: failure
         type(survey_t) :: found
         integer :: k, spent
         logical :: is_found

         if (first == last) return
         call survey(arc, suspension, schedule, path%settled, path%value(first), path%value(last), kkt, found)
         call tell_limits(found, first, last, path%limits, path%limit_place, path%limit_state)
         do k = 1, found%crossings
            call note_crossing(branch, found%crossing_place(k))
         end do
         call begin(arc, suspension, schedule, path%settled, 0.0_wp, path%value(last) > 0.0_wp, kkt, is_found)
         do k = first, last, direction
            if (k == path%start) cycle
            if (.not. is_found .or. (k == last .and. found%ending /= arrived)) exit
            spent = arc%factorisations
            call go_to(arc, suspension, schedule, length_at(found, k, first, last), kkt, is_found)
            if (.not. is_found) exit
            state%poses(:) = arc%state%poses
            state%reaction(:) = arc%state%reaction
            if (k /= first .and. k /= last) path%value(k) = arc%place     ! the ends are exact
            path%iterations(k) = arc%factorisations - spent + 1
            call keep(k)
         end do
         if (k == last + direction) return
         failure%state = k
         failure%ending = found%ending
         failure%value = found%last_place
         failure%reached = found%last_place
         failure%last = arc%packed_a
      end subroutine walk_arc

      !> Returns to the settled state, where all inputs are zero.
      subroutine restart()
         call unpack_state(path%settled, state)
         here = schedule%rest
         call demand_at(schedule, here, demand)
         if (case%method == 'recursive') call start_recursion(suspension, state, kkt, carry)
         call forget(predictor)
         call remember(predictor, here, path%settled)
         call leave(branch, settled_negative)
      end subroutine restart

      !> Uses the states of the other direction to predict the first states of this one.
      subroutine seed(first, direction)
         integer, intent(in) :: first, direction
         integer :: k, last

         call forget(predictor)
         last = first
         do k = 1, depth - 1
            if (first + k*direction < 1 .or. first + k*direction > path%states) exit
            if (.not. path%is_reached(first + k*direction)) exit
            last = first + k*direction
         end do
         do k = last, first, -direction
            call remember(predictor, path%value(k), path%packed(:, k))
         end do
      end subroutine seed

      !> One increment to `value` with the method of the case.
      subroutine advance(value, k, failure)
         real(wp), intent(in) :: value
         integer, intent(in) :: k
         type(failure_t), intent(inout) :: failure
         type(demand_t) :: next

         call demand_at(schedule, value, next)
         select case (case%method)
         case ('recursive')
            call recursive_increment(suspension, demand, next, state, kkt, carry)
            path%iterations(k) = 1
            call check_increment(kkt, k, here, value, failure)
         case ('corrected')
            call corrected_increment(suspension, next, state, kkt)
            path%iterations(k) = 1
            call check_increment(kkt, k, here, value, failure)
         case default
            call reach(suspension, schedule, value, case%tolerance, predictor, branch, state, kkt, &
               path%iterations(k), failure)
            if (failure%state > 0) failure%state = k
         end select
         demand = next
         here = value
      end subroutine advance

   end subroutine walk

   !> The range of a path; for a table, 1 row [place].
   pure real(wp) function span(path)
      type(path_t), intent(in) :: path
      span = 1.0_wp
      if (.not. path%is_table) span = maxval(abs(path%value)) + maxval(path%value) - minval(path%value)
   end function span

end module ek_path
