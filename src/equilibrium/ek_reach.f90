!> Reaching an equilibrium along a path: predict, iterate, halve the way where that fails, and say what
!> went wrong where even that does.
module ek_reach
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, demand_t, coordinates, pack_state, unpack_state
   use ek_schedule, only: schedule_t, demand_at
   use ek_kkt, only: kkt_t, assemble, residual_only
   use ek_newton, only: outcome_t, find_equilibrium
   use ek_predictor, only: predictor_t, new_predictor, remember, predict, judge
   implicit none(type, external)
   private
   public :: failure_t, reach, settle

   integer, parameter :: most_halvings = 12   !! an increment is cut to 1/4096 before a state is given up

   !> Where and how a sweep stopped.
   type :: failure_t
      integer :: state = 0                 !! index of the state that was not found, 0: all were
      real(wp) :: value = 0.0_wp           !! place that was last tried
      real(wp) :: reached = 0.0_wp         !! place of the last equilibrium
      logical :: is_singular = .false.
      integer :: body = 0                  !! which moved most in the failed attempt
      real(wp) :: moved = 0.0_wp           !! how far [m]
      integer :: row = 0                   !! constraint furthest from its value
      real(wp) :: gap = 0.0_wp             !! by how much [m, - or rad]
   end type failure_t

contains

   !> Reaches equilibrium at a place of the path from the states remembered, halving the way when needed.
   !>
   !> On failure `state` is the last equilibrium.
   subroutine reach(suspension, schedule, goal, tolerance, predictor, state, kkt, iterations, failure)
      type(suspension_t), intent(in) :: suspension
      type(schedule_t), intent(in) :: schedule
      real(wp), intent(in) :: goal               !! place
      real(wp), intent(in) :: tolerance          !! m
      type(predictor_t), intent(inout) :: predictor
      type(state_t), intent(inout) :: state
      type(kkt_t), intent(inout) :: kkt
      integer, intent(out) :: iterations         !! factorisations spent
      type(failure_t), intent(inout) :: failure

      call follow(suspension, schedule, goal, .false., tolerance, predictor, state, kkt, iterations, failure)
   end subroutine reach

   !> From design to equilibrium under the constant loads and preloads alone.
   !>
   !> Tried at once; if that fails the imbalance of the design position is let in little by little: its share is
   !> the place on the path.
   subroutine settle(suspension, tolerance, state, kkt, failure)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: tolerance          !! m
      type(state_t), intent(inout) :: state      !! design → equilibrium
      type(kkt_t), intent(inout) :: kkt
      type(failure_t), intent(inout) :: failure
      type(predictor_t) :: predictor
      integer :: iterations

      call assemble(suspension, state, demand_t(), residual_only, kkt)
      kkt%imbalance = kkt%rhs(:kkt%nq)
      predictor = new_predictor(coordinates(suspension))
      call store(predictor, 0.0_wp, state, .true.)
      call follow(suspension, schedule_t(), 1.0_wp, .true., tolerance, predictor, state, kkt, iterations, failure)
   end subroutine settle

   !> Walks from the newest state remembered to the place `goal` of a path.
   subroutine follow(suspension, schedule, goal, is_settling, tolerance, predictor, state, kkt, iterations, failure)
      type(suspension_t), intent(in) :: suspension
      type(schedule_t), intent(in) :: schedule
      real(wp), intent(in) :: goal
      logical, intent(in) :: is_settling         !! the place is the share of the imbalance, else that of the schedule
      real(wp), intent(in) :: tolerance
      type(predictor_t), intent(inout) :: predictor
      type(state_t), intent(inout) :: state
      type(kkt_t), intent(inout) :: kkt
      integer, intent(out) :: iterations
      type(failure_t), intent(inout) :: failure
      type(demand_t) :: demand
      type(outcome_t) :: outcome
      real(wp) :: here, place
      integer :: halvings, points

      here = predictor%abscissa(predictor%newest)
      iterations = 0
      halvings = 0
      points = predictor%trusted
      do
         place = here + (goal - here)*0.5_wp**halvings
         if (halvings == 0) place = goal
         if (is_settling) then
            demand%relief = 1.0_wp - place
         else
            call demand_at(schedule, place, demand)
         end if
         call predict(predictor, place, points)
         call unpack_state(predictor%guess, state)
         call find_equilibrium(suspension, demand, tolerance, state, kkt, outcome)
         iterations = iterations + outcome%factorisations
         if (outcome%is_converged) then
            call store(predictor, place, state, outcome%factorisations == 1)
            here = place
            if (halvings == 0) return
            halvings = halvings - 1
         else
            points = min(points, 2)     ! a bold guess may itself be the trouble
            halvings = halvings + 1
            if (halvings > most_halvings) exit
         end if
      end do
      call blame(suspension, predictor, demand, outcome, here, place, state, kkt, failure)
   end subroutine follow

   !> Hands an equilibrium to the predictor, and whether the guess of it was good.
   pure subroutine store(predictor, place, state, is_good)
      type(predictor_t), intent(inout) :: predictor
      real(wp), intent(in) :: place
      type(state_t), intent(in) :: state
      logical, intent(in) :: is_good

      call pack_state(state, predictor%guess)
      call judge(predictor, place, predictor%guess, 7*(size(state%poses) - 1), is_good)
      call remember(predictor, place, predictor%guess)
   end subroutine store

   !> Says which body moved most in a failed attempt, and which constraint is furthest off; `state` goes back to
   !> the last equilibrium.
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
