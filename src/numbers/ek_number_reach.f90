!> The range of states that a key number needs from a test, and whether a solution lacks one of these states.
module ek_number_reach
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_standard_tests, only: unit_of_swept_value
   use ek_case_result, only: case_result_t, solved
   use ek_sweep_table, only: open_states
   use ek_key_number, only: key_source_t, needs_path, needs_all, at_design
   implicit none(type, external)
   private
   public :: reach_of, reach_of_place, required_reach, lacks_state

   real(wp), parameter :: margin = 1.001_wp    !! factor on a window: its states may be off their swept values by the tolerance

contains

   !> The swept value beyond which a key number does not need a state of a source [SI]: 0 for a key number that is read at design,
   !> and the end of the window for a gradient. In all other cases all states are needed, and the result is huge.
   pure real(wp) function reach_of(how, suspension, case, source) result(reach)
      integer, intent(in) :: how                        !! of ek_key_number
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(key_source_t), intent(in) :: source

      reach = huge(reach)
      if (how == at_design) reach = 0.0_wp
      if (needs_path(how) .or. how == at_design .or. case%follows_arc) return
      reach = margin*source%width*unit_of_swept_value(suspension, case)
   end function reach_of

   !> The swept value within which no state may be missing [SI]. A number that is found anywhere on the path (a travel to contact)
   !> is searched for on all states, but exists if the states up to there were found.
   pure real(wp) function required_reach(how, reach) result(required)
      integer, intent(in) :: how                        !! of ek_key_number
      real(wp), intent(in) :: reach                     !! from reach_of

      required = reach
      if (needs_path(how) .and. .not. needs_all(how)) required = 0.0_wp
   end function required_reach

   !> The swept value beyond which a number that is read at a swept value does not need a state [SI].
   pure real(wp) function reach_of_place(suspension, case, place) result(reach)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      real(wp), intent(in) :: place                     !! in the unit of the swept value

      reach = margin*abs(place)*unit_of_swept_value(suspension, case)
      if (case%follows_arc) reach = huge(reach)
   end function reach_of_place

   !> Whether a case lacks a state within a reach from design: the case was not run, the path ends earlier on one side, or a state
   !> violates the joint constraints (converged = 0).
   pure logical function lacks_state(result, reach)
      type(case_result_t), intent(in) :: result
      real(wp), intent(in) :: reach                      !! swept value
      real(wp) :: needed
      integer :: side, state

      lacks_state = .not. result%is_run()
      if (lacks_state .or. result%outcome == solved) return
      needed = reach
      if (.not. result%path%is_settled .or. result%path%is_table .or. result%case%follows_arc) needed = huge(reach)
      do side = 1, 2
         state = result%path%failure(side)%state
         if (state > 0) lacks_state = lacks_state .or. abs(result%path%value(state)) <= needed
      end do
      lacks_state = lacks_state .or. any(open_states(result%table) .and. &
         abs(result%table%values(2, :)*result%case%unit) <= needed)
   end function lacks_state

end module ek_number_reach
