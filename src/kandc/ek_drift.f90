!> Distance of the ends of a sweep from equilibrium: the accumulated error of a linear method.
module ek_drift
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, default_tolerance
   use ek_state, only: state_t, demand_t, design_state, unpack_state
   use ek_schedule, only: new_schedule, demand_at
   use ek_kkt, only: kkt_t
   use ek_path, only: path_t
   use ek_newton, only: outcome_t, find_equilibrium
   use ek_attitude, only: attitude_t, wheel_attitude
   implicit none(type, external)
   private
   public :: drift_t, drift_at

   !> A state relative to the equilibrium under the same inputs.
   type :: drift_t
      logical :: is_known = .false.       !! an equilibrium was found from this state
      real(wp) :: travel = 0.0_wp         !! m, state less equilibrium
      real(wp) :: toe = 0.0_wp            !! rad
      real(wp) :: camber = 0.0_wp         !! rad
      type(attitude_t) :: equilibrium     !! of the first wheel
   end type drift_t

contains

   !> Drift of state k of a sweep at the first wheel, by one equilibrium solution from this state.
   subroutine drift_at(suspension, case, path, k, kkt, drift)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      integer, intent(in) :: k
      type(kkt_t), intent(inout) :: kkt
      type(drift_t), intent(out) :: drift
      type(state_t) :: state
      type(demand_t) :: demand
      type(outcome_t) :: outcome
      type(attitude_t) :: before

      if (size(suspension%wheels) == 0) return
      state = design_state(suspension)
      call unpack_state(path%packed(:, k), state)
      call demand_at(new_schedule(suspension, case), path%value(k), demand)
      before = wheel_attitude(suspension, state, 1)
      call find_equilibrium(suspension, demand, min(case%tolerance, default_tolerance), state, kkt, outcome)
      drift%is_known = outcome%is_converged
      if (.not. drift%is_known) return
      drift%equilibrium = wheel_attitude(suspension, state, 1)
      drift%travel = before%centre(3) - drift%equilibrium%centre(3)
      drift%toe = before%toe - drift%equilibrium%toe
      drift%camber = before%camber - drift%equilibrium%camber
   end subroutine drift_at

end module ek_drift
