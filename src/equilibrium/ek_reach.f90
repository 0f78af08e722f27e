!> Reaches an equilibrium along a path: predicts a state, iterates, halves the step if the iteration fails, and reports the cause if
!> no step succeeds.
module ek_reach
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_adjust, only: is_adjusted
   use ek_state, only: state_t, inputs_t, pack_state, unpack_state
   use ek_motion, only: squared_distance
   use ek_schedule, only: schedule_t, inputs_at
   use ek_kkt, only: kkt_t, holds, assemble, residual_only
   use ek_newton, only: outcome_t, find_equilibrium
   use ek_predictor, only: predictor_t, remember, predict, judge
   use ek_factors, only: keep
   use ek_branch, only: branch_t, renew_branch, compare, accept, note_crossing, go_along, is_overturning, is_uneven, &
      is_near_zero, long, tiny_step, same_branch, crossing, doubtful
   implicit none(type, external)
   private
   public :: failure_t, reach, settle, good_guess, quick

   real(wp), parameter :: good_guess = 1.0e-3_wp      !! error of a prediction that confirms a smooth path, as a share of the motion
   real(wp), parameter :: widest = 100.0_wp           !! × branch%width: longest step across a bifurcation too near for tangents
   integer, parameter :: quick = 6                    !! number of iterations: Newton's method needs more only where N is singular
   real(wp), parameter :: coarse = 10.0_wp            !! × branch%width: longest step across a loss of rank of the joints
   real(wp), parameter :: away = 0.6_wp               !! next step, as a share of a step that ends at a loss of rank
   integer, parameter :: max_attempts = 400          !! largest number of steps tried per increment

   !> The failure of a sweep: location, cause and last equilibrium.
   type :: failure_t
      integer :: state = 0                 !! index of the first state that did not converge, 0: none
      real(wp) :: value = 0.0_wp           !! swept value of the nearest attempt that failed
      real(wp) :: reached = 0.0_wp         !! swept value of the last equilibrium
      logical :: is_singular = .false.
      logical :: is_off_path = .false.     !! a linear method continued, but not along the path from design
      integer :: ending = 0                !! end of a walk by arc length, see ek_arc_survey; 0 for other walks
      integer :: body = 0                  !! index of the body that moved most in the failed attempt; 0: none
      real(wp) :: moved = 0.0_wp           !! motion of this body [m]
      integer :: row = 0                   !! index of the row of Φ with the largest violation; 0: none
      real(wp) :: gap = 0.0_wp             !! violation of this row [m, - or rad]
      real(wp), allocatable :: last(:)     !! packed state of the last equilibrium
   end type failure_t

   !> A step from the newest stored state, a, to b.
   type :: step_t
      real(wp) :: place = 0.0_wp                 !! swept value of b
      type(inputs_t) :: inputs_a, inputs_b
      type(outcome_t) :: outcome                 !! outcome of the iteration to b
      integer :: verdict = doubtful              !! same_branch, crossing or doubtful (ek_branch)
      logical :: was_compared = .false.
      integer :: iterations = 0                  !! number of factorisations in all attempts
   end type step_t

contains

   !> Moves from design to equilibrium under the constant loads and preloads only.
   !>
   !> This takes one step if possible. Otherwise the imbalance of the design position is applied gradually (homotopy), together with
   !> the heights of the rig and the gaps that adjusters open: the share that acts is the swept value of the path.
   subroutine settle(suspension, tolerance, state, kkt, failure, space)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: tolerance          !! m
      type(state_t), intent(inout) :: state      !! design → equilibrium
      type(kkt_t), intent(inout) :: kkt
      type(failure_t), intent(inout) :: failure
      type(branch_t), intent(inout), optional, target :: space      !! work space, used again from design to design
      type(branch_t), allocatable, target :: own
      type(branch_t), pointer :: branch
      type(schedule_t) :: schedule
      real(wp), parameter :: min_share = 1.0e-6_wp
      integer :: iterations, rig

      if (present(space)) then
         branch => space
      else
         allocate (own)
         branch => own
      end if
      if (.not. holds(kkt, suspension, state, inputs_t())) call assemble(suspension, state, inputs_t(), residual_only, kkt)
      kkt%imbalance(:kkt%nq) = kkt%rhs(:kkt%nq)
      kkt%imbalance(kkt%nq + 1:) = 0.0_wp
      rig = kkt%nq + suspension%own_rows()
      if (is_adjusted(suspension)) rig = kkt%nq        ! the rows of adjusted parts, too
      kkt%imbalance(rig + 1:) = kkt%rhs(rig + 1:)      ! heights of the start state that are not the heights of design
      call renew_branch(suspension, branch)
      branch%least = min_share
      call store(branch%predictor, 0.0_wp, state, .true.)
      schedule%is_settling = .true.
      call reach(suspension, schedule, 1.0_wp, tolerance, branch, state, kkt, iterations, failure)
   end subroutine settle

   !> Moves from the newest stored state to equilibrium at the swept value `goal` of a path, in one step if the path allows it.
   !>
   !> A step is halved if no equilibrium is found, or if the equilibrium found is not on the path (ek_branch). The step is doubled
   !> again after an accepted step. A step shorter than branch%least means the end of the path: `state` is then the last
   !> equilibrium.
   subroutine reach(suspension, schedule, goal, tolerance, branch, state, kkt, iterations, failure, found)
      type(suspension_t), intent(in) :: suspension
      type(schedule_t), intent(in) :: schedule
      real(wp), intent(in) :: goal               !! swept value
      real(wp), intent(in) :: tolerance          !! m
      type(branch_t), intent(inout) :: branch    !! branch of the newest stored state
      type(state_t), intent(inout) :: state      !! result; with `found`, the equilibrium at the goal
      type(kkt_t), intent(inout) :: kkt          !! with `found`, factors near the goal
      integer, intent(out) :: iterations         !! factorisations spent
      type(failure_t), intent(inout) :: failure
      type(outcome_t), intent(in), optional :: found     !! outcome of the iteration from branch%predictor%guess to the goal
      type(step_t) :: step
      real(wp) :: here, width
      real(wp) :: lost        ! place of the nearest attempt that failed
      integer :: points, attempt
      real(wp) :: beyond      ! the nearest swept value known behind a bifurcation
      logical :: is_there, knows_beyond, is_last_try

      here = branch%predictor%abscissa(branch%predictor%newest)
      call inputs_at(schedule, here, step%inputs_a)
      knows_beyond = .false.
      is_last_try = .false.
      beyond = 0.0_wp
      lost = goal
      points = branch%predictor%trusted
      width = goal - here
      do attempt = 1, max_attempts
         step%place = here + width
         if (abs(width) >= abs(goal - here)) step%place = goal
         if (present(found) .and. attempt == 1) then
            call inputs_at(schedule, step%place, step%inputs_b)
            step%outcome = found
            step%iterations = found%factorisations
         else
            call find_end(suspension, schedule, points, branch%has_tangent, tolerance, branch, state, kkt, step)
         end if
         call judge_end(suspension, tolerance, branch, state, kkt, step)
         iterations = step%iterations
         if (step%verdict == crossing) then
            if (abs(step%place - here) > across(branch) .and. .not. is_last_try) then
               knows_beyond = .true.
               beyond = step%place
            else
               call note_crossing(branch, 0.5_wp*(here + step%place))
               step%verdict = same_branch
            end if
         end if
         if (step%verdict == same_branch) then
            call accept(branch, step%outcome, kkt, step%was_compared)
            call store(branch%predictor, step%place, state, step%outcome%factorisations == 1)
            ! no polynomial goes round a corner
            if (step%was_compared .and. branch%was_bent) branch%predictor%trusted = min(branch%predictor%trusted, 2)
            here = step%place
            if (abs(goal - here) <= 0.0_wp) return
            step%inputs_a = step%inputs_b
            width = 2.0_wp*width
            if (is_last_try) knows_beyond = .false.
            is_last_try = .false.
            cycle
         end if
         if (.not. is_last_try) lost = step%place
         points = min(points, 2)     ! the prediction may itself be the cause
         ! halves come to the same place again
         width = merge(away, 0.5_wp, branch%is_singular)*(step%place - here)
         if ((branch%is_singular .or. abs(width) < branch%least) .and. abs(goal - here) <= across(branch) &
            .and. .not. schedule%is_settling) then
            call step_over(suspension, schedule, goal, tolerance, branch, state, kkt, step, is_there)
            iterations = step%iterations
            if (is_there) return
         end if
         if (abs(width) < branch%least) then
            ! so near to a bifurcation the tangents say nothing: take the step across it that they explained last
            if (is_last_try .or. .not. knows_beyond) exit
            if ((beyond - here)*(goal - here) <= 0.0_wp .or. abs(beyond - here) > widest*branch%width) exit
            is_last_try = .true.
            width = beyond - here
         end if
      end do
      call blame(suspension, branch%predictor, lost, step, state, kkt, failure)
   end subroutine reach

   !> Predicts the state at step%place, along the tangent or from earlier states, and iterates to equilibrium.
   subroutine find_end(suspension, schedule, points, has_tangent, tolerance, branch, state, kkt, step)
      type(suspension_t), intent(in) :: suspension
      type(schedule_t), intent(in) :: schedule
      integer, intent(in) :: points              !! earlier states that may be used
      logical, intent(in) :: has_tangent         !! use the tangent instead of two states
      real(wp), intent(in) :: tolerance
      type(branch_t), intent(inout) :: branch
      type(state_t), intent(inout) :: state
      type(kkt_t), intent(inout) :: kkt
      type(step_t), intent(inout) :: step

      call inputs_at(schedule, step%place, step%inputs_b)
      if (has_tangent .and. min(points, branch%predictor%count) <= 2) then
         call go_along(branch, step%place, state)
         call pack_state(state, branch%predictor%guess)
      else
         call predict(branch%predictor, step%place, points)
         call unpack_state(branch%predictor%guess, state)
      end if
      call keep(branch%factors, kkt)
      call find_equilibrium(suspension, step%inputs_b, tolerance, state, kkt, step%outcome)
      step%iterations = step%iterations + step%outcome%factorisations
   end subroutine find_end

   !> Judges whether the end of a step is on the path: the prediction was close, or a comparison with the beginning
   !> confirms the step.
   subroutine judge_end(suspension, tolerance, branch, state, kkt, step)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: tolerance
      type(branch_t), intent(inout) :: branch
      type(state_t), intent(in) :: state
      type(kkt_t), intent(inout) :: kkt
      type(step_t), intent(inout) :: step
      logical :: is_long

      step%verdict = doubtful
      associate (outcome => step%outcome)
         branch%is_singular = is_near_zero(branch, outcome) .or. (outcome%factorisations > quick .and. is_uneven(branch, outcome))
         if (abs(step%place - branch%predictor%abscissa(branch%predictor%newest)) <= tiny_step*branch%least) &
            branch%is_singular = .false.
         if (branch%is_singular .or. .not. outcome%is_converged) return
         step%verdict = same_branch
         step%was_compared = .not. is_foreseen(branch%predictor, state, outcome%negative, branch%negative, tolerance, &
            kkt%length, is_long)
         is_long = is_long .or. is_uneven(branch, outcome)
         if (is_long .and. .not. step%was_compared) step%was_compared = is_overturning(branch, suspension, state, kkt%scale)
         if (.not. step%was_compared) return
         call compare(branch, suspension, step%inputs_a, step%inputs_b, step%place, state, outcome, kkt, step%verdict)
         step%iterations = step%iterations + branch%factorisations
         kkt%pivot_ratio = outcome%pivot_ratio
      end associate
   end subroutine judge_end

   !> Steps over a goal that is a bifurcation, where N is singular. The path continues just after the goal, and the state at the
   !> goal is interpolated. The step is so short that the path is straight.
   subroutine step_over(suspension, schedule, goal, tolerance, branch, state, kkt, step, is_there)
      type(suspension_t), intent(in) :: suspension
      type(schedule_t), intent(in) :: schedule
      real(wp), intent(in) :: goal, tolerance
      type(branch_t), intent(inout) :: branch
      type(state_t), intent(inout) :: state
      type(kkt_t), intent(inout) :: kkt
      type(step_t), intent(inout) :: step
      logical, intent(out) :: is_there           !! .false.: the path does not continue, and the branch has not advanced
      real(wp) :: here, share
      integer :: older

      is_there = .false.
      here = branch%predictor%abscissa(branch%predictor%newest)
      step%place = goal + sign(across(branch), goal - here)
      call find_end(suspension, schedule, 2, .false., tolerance, branch, state, kkt, step)
      if (.not. step%outcome%is_converged) return
      call compare(branch, suspension, step%inputs_a, step%inputs_b, step%place, state, step%outcome, kkt, step%verdict)
      step%iterations = step%iterations + branch%factorisations
      if (step%verdict == doubtful) return
      if (step%verdict == crossing) call note_crossing(branch, goal)
      call accept(branch, step%outcome, kkt, .true.)
      ! the next step begins behind the bifurcation: at it the joints may be on either side
      older = branch%predictor%newest
      share = (goal - here)/(step%place - here)
      call store(branch%predictor, step%place, state, .false.)
      associate (past => branch%predictor)
         past%guess = (1.0_wp - share)*past%packed(:, older) + share*past%packed(:, past%newest)
         call unpack_state(past%guess, state)
      end associate
      is_there = .true.
   end subroutine step_over

   !> Whether the path was smooth: the prediction from earlier states was close, or the motion is below 10 tolerances, and the
   !> inertia is unchanged.
   logical function is_foreseen(predictor, state, negative, negative_before, tolerance, length, is_long)
      type(predictor_t), intent(in) :: predictor     !! with the guess
      type(state_t), intent(in) :: state             !! result of Newton's method from the guess
      integer, intent(in) :: negative, negative_before
      real(wp), intent(in) :: tolerance, length      !! m
      logical, intent(out) :: is_long                !! the step may have passed over a narrow gap of the assembly
      real(wp) :: moved, missed

      moved = squared_distance(size(state%poses) - 1, state%poses, predictor%packed(:, predictor%newest), length)
      missed = squared_distance(size(state%poses) - 1, state%poses, predictor%guess, length)
      is_long = moved > (long*length)**2
      if (moved <= (10.0_wp*tolerance)**2) then
         is_foreseen = negative == negative_before .or. negative_before < 0
      else
         is_foreseen = negative == negative_before .and. missed <= good_guess**2*moved
      end if
   end function is_foreseen

   !> The largest width of a step across a bifurcation. Where joints lose rank, states are less exact than where only N is singular.
   pure real(wp) function across(branch)
      type(branch_t), intent(in) :: branch
      across = branch%width*merge(coarse, 1.0_wp, branch%is_over .or. branch%is_singular)
   end function across

   !> Passes an equilibrium to the predictor, together with the quality of its prediction.
   pure subroutine store(predictor, place, state, is_good)
      type(predictor_t), intent(inout) :: predictor
      real(wp), intent(in) :: place
      type(state_t), intent(in) :: state
      logical, intent(in) :: is_good

      call pack_state(state, predictor%guess)
      call judge(predictor, place, predictor%guess, 7*(size(state%poses) - 1), is_good)
      call remember(predictor, place, predictor%guess)
   end subroutine store

   !> Finds the body that moved most in a failed attempt, and the constraint that is violated most. Resets `state` to the last
   !> equilibrium.
   subroutine blame(suspension, predictor, lost, step, state, kkt, failure)
      type(suspension_t), intent(in) :: suspension
      type(predictor_t), intent(in) :: predictor
      real(wp), intent(in) :: lost               !! swept value of the nearest attempt that failed
      type(step_t), intent(in) :: step           !! the last attempt
      type(state_t), intent(inout) :: state
      type(kkt_t), intent(inout) :: kkt
      type(failure_t), intent(inout) :: failure
      type(state_t) :: before
      real(wp), parameter :: more = 1.0001_wp      ! left and right of a symmetric axle are equal but for rounding: the first
      real(wp), parameter :: rounding = 1.0e-12_wp   ! of a violation [m, - or rad]
      real(wp) :: moved
      integer :: k

      before = state
      call unpack_state(predictor%packed(:, predictor%newest), before)
      failure%last = predictor%packed(:, predictor%newest)
      failure%state = 1
      failure%value = lost
      failure%reached = predictor%abscissa(predictor%newest)
      failure%is_singular = step%outcome%is_singular
      do k = 2, size(state%poses)
         moved = norm2(state%poses(k)%r - before%poses(k)%r) &
            + kkt%length*norm2(state%poses(k)%a - before%poses(k)%a)/sqrt(2.0_wp)
         if (moved > more*failure%moved) then
            failure%moved = moved
            failure%body = k - 1
         end if
      end do
      call assemble(suspension, state, step%inputs_b, residual_only, kkt)
      if (any(abs(kkt%values) > rounding)) then
         failure%row = findloc(more*abs(kkt%values) >= maxval(abs(kkt%values)), .true., dim=1)
         failure%gap = kkt%values(failure%row)
      end if
      state = before
   end subroutine blame

end module ek_reach
