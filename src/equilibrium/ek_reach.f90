!> Reaches an equilibrium along a path: predict, iterate, halve the step if that fails, and report the
!> cause if that fails too.
module ek_reach
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, demand_t, coordinates, pack_state, unpack_state
   use ek_schedule, only: schedule_t, demand_at
   use ek_kkt, only: kkt_t, assemble, residual_only
   use ek_newton, only: outcome_t, find_equilibrium
   use ek_predictor, only: predictor_t, new_predictor, remember, predict, judge, depth
   use ek_factors, only: keep
   use ek_branch, only: branch_t, new_branch, leave, compare, accept, note_crossing, go_along, is_overturning, is_uneven, &
      is_near_zero, long, tiny_step, same_branch, crossing, doubtful
   implicit none(type, external)
   private
   public :: failure_t, reach, settle

   real(wp), parameter :: good_guess = 1.0e-3_wp      !! of the motion: a prediction this close confirms that the path is smooth
   real(wp), parameter :: widest = 100.0_wp           !! of branch%width: a step across a bifurcation that is too near for tangents
   integer, parameter :: quick = 6                    !! iterations: Newton's method needs more only where N is singular
   real(wp), parameter :: coarse = 10.0_wp            !! of branch%width: a step across a loss of rank of the joints
   real(wp), parameter :: away = 0.6_wp               !! of a step that ends at one: the next
   integer, parameter :: most_attempts = 400          !! per increment

   !> Where and how a sweep stopped.
   type :: failure_t
      integer :: state = 0                 !! index of the first state that did not converge, 0: none
      real(wp) :: value = 0.0_wp           !! place of the last attempt
      real(wp) :: reached = 0.0_wp         !! place of the last equilibrium
      logical :: is_singular = .false.
      logical :: is_off_path = .false.     !! a linear method continued, but not along the path from design
      integer :: ending = 0                !! how a walk by arc length ended, see ek_arc_survey; 0: it was none
      integer :: body = 0                  !! body that moved most in the failed attempt
      real(wp) :: moved = 0.0_wp           !! its motion [m]
      integer :: row = 0                   !! constraint with the largest violation
      real(wp) :: gap = 0.0_wp             !! its violation [m, - or rad]
      real(wp), allocatable :: last(:)     !! packed state of the last equilibrium
   end type failure_t

contains

   !> Reaches equilibrium at a swept value of the path from the stored states, halving the step if needed.
   !>
   !> On failure `state` is the last equilibrium.
   subroutine reach(suspension, schedule, goal, tolerance, predictor, branch, state, kkt, iterations, failure)
      type(suspension_t), intent(in) :: suspension
      type(schedule_t), intent(in) :: schedule
      real(wp), intent(in) :: goal               !! place
      real(wp), intent(in) :: tolerance          !! m
      type(predictor_t), intent(inout) :: predictor
      type(branch_t), intent(inout) :: branch    !! branch of the newest stored state
      type(state_t), intent(inout) :: state
      type(kkt_t), intent(inout) :: kkt
      integer, intent(out) :: iterations         !! factorisations spent
      type(failure_t), intent(inout) :: failure

      call follow(suspension, schedule, goal, .false., tolerance, predictor, branch, state, kkt, iterations, failure)
   end subroutine reach

   !> Goes from design to equilibrium under the constant loads and preloads only.
   !>
   !> In one step if possible; otherwise the imbalance of the design position is applied gradually (homotopy): its share
   !> is the swept value on the path.
   subroutine settle(suspension, tolerance, state, kkt, failure)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: tolerance          !! m
      type(state_t), intent(inout) :: state      !! design → equilibrium
      type(kkt_t), intent(inout) :: kkt
      type(failure_t), intent(inout) :: failure
      type(predictor_t) :: predictor
      type(branch_t) :: branch
      real(wp), parameter :: least_share = 1.0e-6_wp
      integer :: iterations

      call assemble(suspension, state, demand_t(), residual_only, kkt)
      kkt%imbalance = kkt%rhs(:kkt%nq)
      predictor = new_predictor(coordinates(suspension))
      branch = new_branch(suspension)
      branch%least = least_share
      call store(predictor, 0.0_wp, state, .true.)
      call follow(suspension, schedule_t(), 1.0_wp, .true., tolerance, predictor, branch, state, kkt, iterations, failure)
   end subroutine settle

   !> Goes from the newest stored state to the swept value `goal` of a path, in one step if the path allows it.
   !>
   !> A step is halved if no equilibrium is found, or one that is not on the path (ek_branch); it is doubled again after an
   !> accepted step. A step shorter than branch%least means the end of the path.
   subroutine follow(suspension, schedule, goal, is_settling, tolerance, predictor, branch, state, kkt, iterations, failure)
      type(suspension_t), intent(in) :: suspension
      type(schedule_t), intent(in) :: schedule
      real(wp), intent(in) :: goal
      logical, intent(in) :: is_settling         !! the swept value is the share of the imbalance; otherwise that of the schedule
      real(wp), intent(in) :: tolerance
      type(predictor_t), intent(inout) :: predictor
      type(branch_t), intent(inout) :: branch
      type(state_t), intent(inout) :: state
      type(kkt_t), intent(inout) :: kkt
      integer, intent(out) :: iterations
      type(failure_t), intent(inout) :: failure
      type(demand_t) :: here_demand, demand
      type(outcome_t) :: outcome
      real(wp) :: here, place, step
      real(wp) :: before      ! place of the newest state minus that of the one before it
      integer :: points, attempt, verdict, older
      real(wp) :: beyond      ! the nearest swept value known behind a bifurcation
      logical :: was_compared, here_is_goal, is_long, knows_beyond, is_last_try

      here = predictor%abscissa(predictor%newest)
      call demand_of(here, here_demand)
      iterations = 0
      here_is_goal = .false.
      knows_beyond = .false.
      is_last_try = .false.
      beyond = 0.0_wp
      points = predictor%trusted
      step = goal - here
      do attempt = 1, most_attempts
         place = here + step
         if (abs(step) >= abs(goal - here)) place = goal
         call demand_of(place, demand)
         if (branch%has_tangent .and. min(points, predictor%count) <= 2) then
            call unpack_state(predictor%packed(:, predictor%newest), state)
            call go_along(branch, place - here, state)
            call pack_state(state, predictor%guess)
         else
            call predict(predictor, place, points)
            call unpack_state(predictor%guess, state)
         end if
         call keep(branch%factors, kkt)
         call find_equilibrium(suspension, demand, tolerance, state, kkt, outcome)
         iterations = iterations + outcome%factorisations
         verdict = doubtful
         branch%is_singular = is_near_zero(branch, outcome%log_determinant) .or. &
            (outcome%factorisations > quick .and. is_uneven(branch, outcome%log_determinant))
         if (abs(place - here) <= tiny_step*branch%least) branch%is_singular = .false.
         if (outcome%is_converged .and. .not. branch%is_singular) then
            verdict = same_branch
            was_compared = .not. is_foreseen(predictor, state, outcome%negative, branch%negative, tolerance, kkt%length, is_long)
            is_long = is_long .or. is_uneven(branch, outcome%log_determinant)
            if (is_long .and. .not. was_compared) was_compared = is_overturning(branch, suspension, &
               predictor%packed(:, predictor%newest), here_demand, state, demand, kkt)
            if (was_compared) then
               older = modulo(predictor%newest - 2, depth) + 1
               before = 0.0_wp
               if (predictor%count > 1) before = here - predictor%abscissa(older)
               call compare(branch, suspension, predictor%packed(:, predictor%newest), here_demand, demand, place - here, &
                  predictor%packed(:, older), before, state, outcome%missed, outcome%log_determinant, kkt, verdict)
               iterations = iterations + branch%factorisations
               kkt%pivot_ratio = outcome%pivot_ratio
               if (verdict == crossing) then
                  if (abs(place - here) > across(branch) .and. .not. is_last_try) then
                     verdict = doubtful
                     knows_beyond = .true.
                     beyond = place
                  else
                     call note_crossing(branch, 0.5_wp*(here + place))
                     verdict = same_branch
                  end if
               end if
            end if
         end if
         if (verdict == same_branch) then
            call accept(branch, outcome%negative, outcome%log_determinant, kkt, was_compared)
            call store(predictor, place, state, outcome%factorisations == 1)
            ! no polynomial goes round a corner
            if (was_compared .and. branch%was_bent) predictor%trusted = min(predictor%trusted, 2)
            here = place
            here_demand = demand
            if (abs(goal - here) <= 0.0_wp) return
            step = 2.0_wp*step
            if (is_last_try) knows_beyond = .false.
            is_last_try = .false.
         else
            points = min(points, 2)     ! the prediction may itself be the cause
            step = 0.5_wp*(place - here)
            ! halves come to the same place again
            if (branch%is_singular) step = away*(place - here)
            if ((branch%is_singular .or. abs(step) < branch%least) .and. abs(goal - here) <= across(branch) &
               .and. .not. is_settling) call step_over()
            if (here_is_goal) return
            if (abs(step) < branch%least) then
               ! so near to a bifurcation the tangents say nothing: take the step across it that they explained last
               if (is_last_try .or. .not. knows_beyond) exit
               if ((beyond - here)*(goal - here) <= 0.0_wp .or. abs(beyond - here) > widest*branch%width) exit
               is_last_try = .true.
               step = beyond - here
            end if
         end if
      end do
      call blame(suspension, predictor, demand, outcome, here, place, state, kkt, failure)

   contains

      !> The goal itself is a bifurcation: N is singular there. The path is taken up again just behind it, and the state is what
      !> lies between; the width is so small that the path is straight.
      subroutine step_over()
         real(wp) :: share

         place = goal + sign(across(branch), goal - here)
         call demand_of(place, demand)
         call predict(predictor, place, 2)
         call unpack_state(predictor%guess, state)
         call keep(branch%factors, kkt)
         call find_equilibrium(suspension, demand, tolerance, state, kkt, outcome)
         iterations = iterations + outcome%factorisations
         if (.not. outcome%is_converged) return
         older = modulo(predictor%newest - 2, depth) + 1
         before = 0.0_wp
         if (predictor%count > 1) before = here - predictor%abscissa(older)
         call compare(branch, suspension, predictor%packed(:, predictor%newest), here_demand, demand, place - here, &
            predictor%packed(:, older), before, state, outcome%missed, outcome%log_determinant, kkt, verdict)
         iterations = iterations + branch%factorisations
         if (verdict == doubtful) return
         if (verdict == crossing) call note_crossing(branch, goal)
         call accept(branch, outcome%negative, outcome%log_determinant, kkt, .true.)
         ! the next step begins behind the bifurcation: at it the joints may be on either side
         older = predictor%newest
         share = (goal - here)/(place - here)
         call store(predictor, place, state, .false.)
         predictor%guess = (1.0_wp - share)*predictor%packed(:, older) + share*predictor%packed(:, predictor%newest)
         call unpack_state(predictor%guess, state)
         here_is_goal = .true.
      end subroutine step_over

      subroutine demand_of(place, demand)
         real(wp), intent(in) :: place
         type(demand_t), intent(inout) :: demand

         if (is_settling) then
            demand%relief = 1.0_wp - place
         else
            call demand_at(schedule, place, demand)
         end if
      end subroutine demand_of

   end subroutine follow

   !> Whether the prediction from earlier states was close and the inertia is unchanged: the path was smooth.
   logical function is_foreseen(predictor, state, negative, negative_before, tolerance, length, is_long)
      type(predictor_t), intent(in) :: predictor     !! with the guess
      type(state_t), intent(in) :: state             !! result of Newton's method from it
      integer, intent(in) :: negative, negative_before
      real(wp), intent(in) :: tolerance, length      !! m
      logical, intent(out) :: is_long                !! it may yet have passed over a narrow gap of the assembly
      real(wp) :: moved, missed
      integer :: k, at

      moved = 0.0_wp
      missed = 0.0_wp
      at = 0
      do k = 2, size(state%poses)
         associate (pose => state%poses(k), old => predictor%packed(at + 1:at + 7, predictor%newest), &
            guess => predictor%guess(at + 1:at + 7))
            ! a quaternion turns by half the angle
            moved = max(moved, sum((pose%r - old(1:3))**2), (2.0_wp*length)**2*sum((pose%q - old(4:7))**2))
            missed = max(missed, sum((pose%r - guess(1:3))**2), (2.0_wp*length)**2*sum((pose%q - guess(4:7))**2))
         end associate
         at = at + 7
      end do
      is_long = moved > (long*length)**2
      if (moved <= (10.0_wp*tolerance)**2) then
         is_foreseen = negative == negative_before .or. negative_before < 0
      else
         is_foreseen = negative == negative_before .and. missed <= good_guess**2*moved
      end if
   end function is_foreseen

   !> The widest step across a bifurcation: where joints lose rank, states are less exact than where N does alone.
   pure real(wp) function across(branch)
      type(branch_t), intent(in) :: branch
      across = branch%width*merge(coarse, 1.0_wp, branch%is_over .or. branch%is_singular)
   end function across

   !> Passes an equilibrium to the predictor, which also learns how good its prediction was.
   pure subroutine store(predictor, place, state, is_good)
      type(predictor_t), intent(inout) :: predictor
      real(wp), intent(in) :: place
      type(state_t), intent(in) :: state
      logical, intent(in) :: is_good

      call pack_state(state, predictor%guess)
      call judge(predictor, place, predictor%guess, 7*(size(state%poses) - 1), is_good)
      call remember(predictor, place, predictor%guess)
   end subroutine store

   !> Determines which body moved most in a failed attempt and which constraint is violated most; `state` is reset
   !> to the last equilibrium.
   subroutine blame(suspension, predictor, demand, outcome, here, place, state, kkt, failure)
      type(suspension_t), intent(in) :: suspension
      type(predictor_t), intent(in) :: predictor
      type(demand_t), intent(in) :: demand
      type(outcome_t), intent(in) :: outcome
      real(wp), intent(in) :: here, place        !! of the last equilibrium, and of the failed attempt
      type(state_t), intent(inout) :: state
      type(kkt_t), intent(inout) :: kkt
      type(failure_t), intent(inout) :: failure
      type(state_t) :: before
      real(wp) :: moved
      integer :: k

      before = state
      call unpack_state(predictor%packed(:, predictor%newest), before)
      failure%last = predictor%packed(:, predictor%newest)
      failure%state = 1
      failure%value = place
      failure%reached = here
      failure%is_singular = outcome%is_singular
      do k = 2, size(state%poses)
         moved = norm2(state%poses(k)%r - before%poses(k)%r) &
            + kkt%length*norm2(state%poses(k)%a - before%poses(k)%a)/sqrt(2.0_wp)
         if (moved > failure%moved) then
            failure%moved = moved
            failure%body = k - 1
         end if
      end do
      call assemble(suspension, state, demand, residual_only, kkt)
      do k = 1, kkt%nc
         if (abs(kkt%values(k)) > abs(failure%gap)) then
            failure%gap = kkt%values(k)
            failure%row = k
         end if
      end do
      state = before
   end subroutine blame

end module ek_reach
