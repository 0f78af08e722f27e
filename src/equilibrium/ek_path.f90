!> A sweep: from design outward to both ends of a case, one state after the other.
!>
!> A state that does not converge is approached by halved increments; if no increment converges, the sweep in
!> that direction ends, and the states before it remain valid. The rows of a table are independent states:
!> if one state does not converge, the next is reached from design.
!>
!> The states of a linear method are checked: do they lie on the path from design?
!> The recursive and the corrected increment take one step without a check, and may step across a lock onto another assembly.
!> Therefore the exact path is followed again in a few long steps checked by ek_reach. At the end of each step, Newton's method
!> is started from the state of the linear method and must converge to the exact path. States beyond the last swept value at which
!> Newton's method converges are marked as not reached.
module ek_path
   use ek_kinds, only: wp
   use ek_case, only: case_t, default_tolerance
   use ek_suspension, only: suspension_t
   use ek_adjust, only: is_adjusted
   use ek_state, only: state_t, inputs_t, design_state, return_to_design, pack_state, unpack_state, motion_between, largest_motion
   use ek_schedule, only: schedule_t, make_schedule, inputs_at
   use ek_path_states, only: path_t, new_path, count_ways, ways, span
   use ek_kkt, only: kkt_t, condition, assemble, factorise, whole_tangent
   use ek_reach, only: failure_t, reach, settle
   use ek_recursion, only: start_recursion, recursive_increment, corrected_increment, check_increment
   use ek_branch, only: branch_t, renew_branch, leave, note_crossing, new_branch
   use ek_arc, only: arc_t, new_arc, begin
   use ek_arc_survey, only: survey_t, survey, go_to, length_at, print_limits, arrived
   use ek_predictor, only: predictor_t, remember, forget, depth
   use ek_newton, only: outcome_t, find_equilibrium
   implicit none(type, external)
   private
   public :: path_t, sweep, new_path, walk, begin_between, reach_place, walk_t, empty_walk, &
      progress_procedure, suspect, min_step, crossing_step, confirm

   integer, parameter :: max_evaluations = 10          !! largest number of comparisons per direction
   real(wp), parameter :: apart = 1.0e-6_wp       !! equilibria further apart are different [m]

   real(wp), parameter :: min_step = 4.0e-10_wp     !! shortest step, as a share of the range: resolution of the end of a path
   real(wp), parameter :: crossing_step = 1.0e-6_wp   !! width of a step across a bifurcation, as a share of the range: in a
                                                      !! narrower step the matrix is too singular
   real(wp), parameter :: min_of_row = 0.0078125_wp    !! shortest step after the first row of a table that did not converge [rows]

   real(wp), parameter :: suspect = 1.0e-12_wp         !! pivot ratio below which the condition number is computed

   abstract interface
      !> Reports progress: called at intervals with the number of states done and the total.
      subroutine progress_procedure(done, total)
         integer, intent(in) :: done, total
      end subroutine progress_procedure
   end interface

   !> The present state of a walk, and the data for the next increment. The memory is used again from design to design of a model.
   type :: walk_t
      type(state_t) :: state
      real(wp) :: here = 0.0_wp        !! swept value of `state`, and the inputs at this value; for the linear methods
      type(inputs_t) :: inputs
      type(schedule_t) :: schedule
      real(wp), allocatable :: held(:)     !! Φqᵀλ of the recursion [N, N m], see start_recursion
      type(branch_t) :: branch
      type(arc_t) :: arc
      logical :: is_along_arc = .false.
      integer :: negative = -1         !! negative eigenvalues of N under the constant loads; −1: not known
      integer :: done = 0              !! number of states stored
   end type walk_t

contains

   !> Frees the work space of a walk.
   pure subroutine empty_walk(self)
      type(walk_t), intent(out) :: self
      self%done = 0
   end subroutine empty_walk

   !> Sweeps a case; failures are returned in path%failure and never stop the program. States of a linear method that are not
   !> on the path from design are rejected, except in tables.
   subroutine sweep(suspension, case, path, kkt, progress, reach, space)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(inout) :: path                      !! as of new_path
      type(kkt_t), intent(inout) :: kkt                        !! of new_kkt
      procedure(progress_procedure), optional :: progress
      real(wp), intent(in), optional :: reach                  !! swept value; states beyond it on either side are omitted
      type(walk_t), intent(inout), optional :: space           !! of an earlier design of this model on this rig, or empty
      type(schedule_t) :: schedule
      integer :: ends(2, 2), w

      call new_path(suspension, case, path)
      call walk(suspension, case, path, kkt, progress, reach, space)
      if (case%method == 'equilibrium' .or. path%is_table) return      ! the rows of a table do not form one path
      call make_schedule(suspension, case, schedule)
      ends = ways(path)
      do w = 1, count_ways(path)
         call confirm(suspension, schedule, path%value, path%packed, ends(1, w), ends(2, w), &
            min_step*span(path), kkt, path%is_reached, path%failure(w))
      end do
   end subroutine sweep

   !> Follows the complete path of new_path, or a path of equilibria around design only as far as `reach`. The states that
   !> both paths contain are identical bit for bit.
   subroutine walk(suspension, case, path, kkt, progress, reach, space)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(inout) :: path
      type(kkt_t), intent(inout) :: kkt
      procedure(progress_procedure), optional :: progress
      real(wp), intent(in), optional :: reach      !! swept value; 0: the design state only
      type(walk_t), intent(inout), optional :: space   !! as in `sweep`
      type(walk_t), allocatable :: own

      if (present(space)) then
         call go(space, suspension, case, path, kkt, progress, reach)
      else
         allocate (own)
         call go(own, suspension, case, path, kkt, progress, reach)
      end if
   end subroutine walk

   !> Follows a path like `walk`, with `self` as work space.
   subroutine go(self, suspension, case, path, kkt, progress, reach)
      type(walk_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(inout) :: path
      type(kkt_t), intent(inout) :: kkt
      procedure(progress_procedure), optional :: progress
      real(wp), intent(in), optional :: reach
      real(wp) :: far
      integer :: ends(2, 2), w

      far = huge(far)
      if (present(reach) .and. path%start > 0 .and. case%method == 'equilibrium' .and. .not. case%follows_arc) far = reach
      call start(self, suspension, case, path, kkt)
      if (.not. path%is_settled) return
      if (path%is_table) then
         call walk_rows()
      else
         if (path%start > 0) call keep(self, suspension, case, path%start, path, kkt, progress)
         ends = ways(path)
         do w = 1, count_ways(path)
            if (.not. far > 0.0_wp) exit
            if (self%is_along_arc) then
               call walk_arc(self, suspension, case, ends(1, w), ends(2, w), path, kkt, path%failure(w), progress)
            else
               call walk_way(ends(1, w), ends(2, w), merge(depth, 0, w < count_ways(path)), path%failure(w))
            end if
         end do
      end if
      path%crossings = self%branch%crossings
      path%crossing_place = self%branch%crossing_place

   contains

      !> Walks from row to row of a table. After a row that did not converge, continues from design.
      subroutine walk_rows()
         type(failure_t) :: failure
         integer :: k

         call restart(self, suspension, case, path, kkt)
         do k = 1, path%states
            failure = failure_t()
            call advance(self, suspension, case, path%value(k), k, path, kkt, failure)
            if (failure%state == 0) then
               call keep(self, suspension, case, k, path, kkt, progress)
               cycle
            end if
            if (path%failure(1)%state == 0) path%failure(1) = failure
            self%branch%least = min_of_row
            self%schedule%rest = nint(path%value(k))
            call restart(self, suspension, case, path, kkt)
         end do
      end subroutine walk_rows

      !> Walks from state `first` to state `last` in increments of equal size. Unless `first` is the design state, also walks from
      !> design to `first`.
      subroutine walk_way(first, last, least, failure)
         integer, intent(in) :: first, last
         integer, intent(in) :: least                 ! states that the way on the other side begins with (seed)
         type(failure_t), intent(inout) :: failure
         integer :: k, steps, direction

         direction = sign(1, last - first)
         call restart(self, suspension, case, path, kkt)
         if (first == path%start) then
            call seed(self%branch%predictor, path, first, -direction)
         else
            steps = 1
            if (path%step > 0.0_wp) steps = max(1, nint(abs(path%value(first))/path%step))
            do k = 1, steps
               call advance(self, suspension, case, path%value(first)*real(k, wp)/steps, first, path, kkt, failure)
               if (failure%state > 0) return
            end do
            call keep(self, suspension, case, first, path, kkt, progress)
         end if
         do k = first + direction, last, direction
            if (abs(path%value(k)) > far .and. abs(k - first) >= least) exit
            if (.not. (path%is_scheduled(k) .or. case%method == 'equilibrium')) then
               call advance_aside(self, suspension, case, k, path, kkt, progress)
               cycle
            end if
            call advance(self, suspension, case, path%value(k), k, path, kkt, failure)
            if (failure%state > 0) return
            call keep(self, suspension, case, k, path, kkt, progress)
         end do
      end subroutine walk_way

   end subroutine go

   !> Prepares the work space and finds the equilibrium under the constant loads. path%is_settled: the equilibrium was found.
   subroutine start(self, suspension, case, path, kkt)
      type(walk_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(inout) :: path
      type(kkt_t), intent(inout) :: kkt
      logical :: is_alike

      call make_schedule(suspension, case, self%schedule)
      self%here = 0.0_wp
      self%inputs = inputs_t()
      self%negative = -1
      self%done = 0
      self%is_along_arc = case%follows_arc .and. case%method == 'equilibrium' .and. .not. path%is_table
      if (self%is_along_arc) self%arc = new_arc(suspension, self%schedule, kkt%length, maxval(abs(path%value)), case%tolerance)
      is_alike = allocated(self%state%poses)
      if (is_alike) is_alike = size(self%state%poses) == size(suspension%bodies) + 1 .and. &
         size(self%state%reaction) == suspension%constraints()
      if (.not. is_alike) self%state = design_state(suspension)
      call return_to_design(suspension, self%state)
      path%limits = 0
      path%failure(1) = failure_t()
      path%failure(2) = failure_t()
      path%is_reached = .false.
      if (case%method == 'recursive' .and. .not. is_adjusted(suspension)) then
         call start_recursion(suspension, self%state, kkt, self%held)
      else
         call settle(suspension, case%tolerance, self%state, kkt, path%failure(1), self%branch)
         self%negative = kkt%negative
      end if
      call renew_branch(suspension, self%branch)
      self%branch%least = min_step*span(path)
      self%branch%width = crossing_step*span(path)
      path%is_settled = path%failure(1)%state == 0
      if (path%is_settled) call pack_state(self%state, path%settled)
   end subroutine start

   !> Prepares the way from a state of a solved path of equilibria to swept values beyond it (reach_place). Earlier states of the
   !> schedule serve the prediction, as in a sweep.
   subroutine begin_between(self, suspension, case, path, from, direction, kkt)
      type(walk_t), intent(inout) :: self        !! work space of the model
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      integer, intent(in) :: from                !! index of the state, which was reached
      integer, intent(in) :: direction           !! 1 or −1: side of the swept values in the order of the states
      type(kkt_t), intent(inout) :: kkt          !! of the path
      type(inputs_t) :: inputs
      integer :: before(depth), k, n

      call make_schedule(suspension, case, self%schedule)
      if (.not. allocated(self%state%poses)) self%state = design_state(suspension)
      call renew_branch(suspension, self%branch)
      self%branch%least = min_step*span(path)
      self%branch%width = crossing_step*span(path)
      call unpack_state(path%packed(:, from), self%state)
      call inputs_at(self%schedule, path%value(from), inputs)
      call assemble(suspension, self%state, inputs, whole_tangent, kkt)
      call factorise(kkt)
      call leave(self%branch, path%value(from), path%packed(:, from), kkt%negative)
      call forget(self%branch%predictor)
      n = 0
      k = from
      do while (n < depth .and. k >= 1 .and. k <= path%states)
         if (.not. path%is_reached(k)) exit
         if (path%is_scheduled(k)) then
            n = n + 1
            before(n) = k
         end if
         k = k - direction
      end do
      do k = n, 1, -1
         call remember(self%branch%predictor, path%value(before(k)), path%packed(:, before(k)))
      end do
   end subroutine begin_between

   !> Moves on to the equilibrium at a swept value, after begin_between or after another swept value.
   subroutine reach_place(self, suspension, case, place, kkt, one)
      type(walk_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      real(wp), intent(in) :: place              !! SI
      type(kkt_t), intent(inout) :: kkt
      type(path_t), intent(inout) :: one         !! path of one state; is_reached: the state was found
      type(failure_t) :: failure

      one%value(1) = place
      call reach(suspension, self%schedule, place, case%tolerance, self%branch, self%state, kkt, one%iterations(1), failure)
      one%is_reached(1) = failure%state == 0
      if (one%is_reached(1)) call keep(self, suspension, case, 1, one, kkt)
   end subroutine reach_place

   !> Stores the current state as state k.
   subroutine keep(self, suspension, case, k, path, kkt, progress)
      type(walk_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer, intent(in) :: k
      type(path_t), intent(inout) :: path
      type(kkt_t), intent(inout) :: kkt
      procedure(progress_procedure), optional :: progress
      real(wp) :: rcond

      call pack_state(self%state, path%packed(:, k))
      path%is_reached(k) = .true.
      path%is_stable(k) = kkt%negative == kkt%nc
      path%pivot_ratio(k) = kkt%pivot_ratio
      if (kkt%pivot_ratio < suspect .and. case%method /= 'recursive') then
         ! a small pivot may be one of a well-conditioned matrix
         call inputs_at(self%schedule, path%value(k), self%inputs)
         call condition(suspension, self%state, self%inputs, kkt, rcond)
         path%pivot_ratio(k) = max(path%pivot_ratio(k), rcond)
      end if
      self%done = self%done + 1
      if (present(progress)) then
         if (mod(self%done, 1000) == 0) call progress(self%done, path%states)
      end if
   end subroutine keep

   !> Finds states `first` to `last` at equal distances along the path. The last state is omitted if the path does not reach it.
   subroutine walk_arc(self, suspension, case, first, last, path, kkt, failure, progress)
      type(walk_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer, intent(in) :: first, last
      type(path_t), intent(inout) :: path
      type(kkt_t), intent(inout) :: kkt
      type(failure_t), intent(inout) :: failure
      procedure(progress_procedure), optional :: progress
      type(survey_t) :: found
      integer :: k, spent, direction
      logical :: is_found

      if (first == last) return
      direction = sign(1, last - first)
      associate (arc => self%arc)
         call survey(arc, suspension, path%settled, path%value(first), path%value(last), kkt, found)
         call print_limits(found, first, last, path%limits, path%limit_place, path%limit_state)
         do k = 1, found%crossings
            call note_crossing(self%branch, found%crossing_place(k))
         end do
         call begin(arc, suspension, path%settled, 0.0_wp, path%value(last) > 0.0_wp, kkt, is_found)
         do k = first, last, direction
            if (k == path%start) cycle
            if (.not. is_found .or. (k == last .and. found%ending /= arrived)) exit
            spent = arc%factorisations
            call go_to(arc, suspension, length_at(found, k, first, last), kkt, is_found)
            if (.not. is_found) exit
            self%state%poses(:) = arc%state%poses
            self%state%reaction(:) = arc%state%reaction
            if (k /= first .and. k /= last) path%value(k) = arc%place     ! the ends are exact
            path%iterations(k) = arc%factorisations - spent + 1
            call keep(self, suspension, case, k, path, kkt, progress)
         end do
         if (k == last + direction) return
         failure%state = k
         failure%ending = found%ending
         failure%value = found%last_place
         failure%reached = found%last_place
         failure%last = arc%packed_a
      end associate
   end subroutine walk_arc

   !> Returns to static equilibrium under the constant loads, where all inputs are zero.
   subroutine restart(self, suspension, case, path, kkt)
      type(walk_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(kkt_t), intent(inout) :: kkt

      call unpack_state(path%settled, self%state)
      self%here = self%schedule%rest
      call inputs_at(self%schedule, self%here, self%inputs)
      if (case%method == 'recursive') call start_recursion(suspension, self%state, kkt, self%held)
      call leave(self%branch, self%here, path%settled, self%negative)
   end subroutine restart

   !> Uses the states on the other side of design to predict the first states on this side.
   pure subroutine seed(predictor, path, first, direction)
      type(predictor_t), intent(inout) :: predictor
      type(path_t), intent(in) :: path
      integer, intent(in) :: first, direction
      integer :: k, last

      call forget(predictor)
      last = first
      do k = first, first + (depth - 1)*direction, direction
         if (k < 1 .or. k > path%states) exit
         if (.not. path%is_reached(k)) exit
         last = k
      end do
      do k = last, first, -direction
         call remember(predictor, path%value(k), path%packed(:, k))
      end do
   end subroutine seed

   !> Computes one increment to `value`, the swept value of state k, with the method of the case.
   subroutine advance(self, suspension, case, value, k, path, kkt, failure)
      type(walk_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      real(wp), intent(in) :: value
      integer, intent(in) :: k
      type(path_t), intent(inout) :: path
      type(kkt_t), intent(inout) :: kkt
      type(failure_t), intent(inout) :: failure
      type(inputs_t) :: next

      if (case%method == 'equilibrium') then
         call reach(suspension, self%schedule, value, case%tolerance, self%branch, self%state, kkt, &
            path%iterations(k), failure)
         if (failure%state > 0) failure%state = k
         return
      end if
      call inputs_at(self%schedule, value, next)
      if (case%method == 'recursive') then
         call recursive_increment(suspension, self%inputs, next, self%state, kkt, self%held)
      else
         call corrected_increment(suspension, next, self%state, kkt)
      end if
      path%iterations(k) = 1
      call check_increment(kkt, k, self%here, value, failure)
      self%inputs = next
      self%here = value
   end subroutine advance

   !> Computes one increment of a linear method to a state where a number is read. The next state of the schedule is reached from the
   !> state before, as without this reading: a linear method depends on its increments.
   subroutine advance_aside(self, suspension, case, k, path, kkt, progress)
      type(walk_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer, intent(in) :: k
      type(path_t), intent(inout) :: path
      type(kkt_t), intent(inout) :: kkt
      procedure(progress_procedure), optional :: progress
      type(state_t) :: state
      type(inputs_t) :: inputs
      type(failure_t) :: failure
      real(wp), allocatable :: held(:)
      real(wp) :: here

      state = self%state
      inputs = self%inputs
      here = self%here
      if (allocated(self%held)) allocate (held, source=self%held)
      call advance(self, suspension, case, path%value(k), k, path, kkt, failure)
      if (failure%state == 0) call keep(self, suspension, case, k, path, kkt, progress)
      self%state = state
      self%inputs = inputs
      self%here = here
      if (allocated(held)) self%held(:) = held
   end subroutine advance_aside

   !> Checks the states from `first` to `last`, outward from design, and marks states that are not on the path as not reached.
   !> Without static equilibrium under the constant loads, nothing is checked.
   subroutine confirm(suspension, schedule, place, packed, first, last, least, kkt, is_reached, failure)
      type(suspension_t), intent(in) :: suspension
      type(schedule_t), intent(in) :: schedule
      real(wp), intent(in) :: place(:)               !! swept value of each state
      real(wp), intent(in) :: packed(:, :)           !! (coordinate, state)
      integer, intent(in) :: first, last
      real(wp), intent(in) :: least                  !! shortest step [swept value]
      type(kkt_t), intent(inout) :: kkt
      logical, intent(inout) :: is_reached(:)
      type(failure_t), intent(inout) :: failure      !! state: the first rejected state
      type(state_t) :: exact, linear
      type(branch_t) :: branch
      type(inputs_t) :: inputs
      type(outcome_t) :: outcome
      type(failure_t) :: lost
      real(wp) :: motion(kkt%nq)
      real(wp), allocatable :: settled(:)
      integer :: k, sure, stride, iterations, end, direction

      direction = sign(1, last - first)
      end = first - direction
      do k = first, last, direction
         if (.not. is_reached(k)) exit
         end = k
      end do
      if ((end - first)*direction < 0) return
      exact = design_state(suspension)
      linear = exact
      call settle(suspension, default_tolerance, exact, kkt, lost)
      if (lost%state > 0) return
      allocate (settled(size(packed, 1)))
      call pack_state(exact, settled)
      branch = new_branch(suspension)
      branch%least = least
      branch%width = 1.0e3_wp*least
      call leave(branch, 0.0_wp, settled, kkt%negative)
      stride = max(1, (abs(end - first) + max_evaluations)/max_evaluations)
      sure = first - direction
      k = first
      if (abs(place(first)) <= 0.0_wp) then       ! design itself
         sure = first
         if (end == first) return
         k = first + sign(min(stride, abs(end - first)), direction)
      end if
      do
         call reach(suspension, schedule, place(k), default_tolerance, branch, exact, kkt, iterations, lost)
         if (lost%state > 0) then
            ! states before the end of the path are kept
            do while (sure /= k)
               if (abs(place(sure + direction)) > abs(lost%reached)) exit
               sure = sure + direction
            end do
            exit
         end if
         call unpack_state(packed(:, k), linear)
         call inputs_at(schedule, place(k), inputs)
         call find_equilibrium(suspension, inputs, default_tolerance, linear, kkt, outcome)
         if (.not. outcome%is_converged) exit
         call motion_between(exact, linear, motion)
         if (.not. largest_motion(motion, kkt%length) <= apart) exit
         sure = k
         if (k == end) return
         k = k + sign(min(stride, abs(end - k)), direction)
      end do
      is_reached(sure + direction:end:direction) = .false.
      if (lost%state == 0) then
         lost%value = place(sure + direction)
         lost%is_off_path = .true.
         if (sure - (first - direction) /= 0) lost%reached = place(sure)
      end if
      failure = lost
      failure%state = sure + direction
   end subroutine confirm

end module ek_path
