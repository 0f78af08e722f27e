!> The range of states that a key number needs from a test, and whether a solution lacks one of these states.
module ek_number_reach
   use ek_kinds, only: wp, millimetre, degree
   use ek_rig_test, only: rig_test_t, rig_test, moves_heights, rolls, steers, of_one_wheel
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable
   use ek_rig, only: mount
   use ek_table, only: name_length
   use ek_case_result, only: case_result_t, solved
   use ek_sweep_table, only: open_states
   use ek_test_result, only: test_result_t
   use ek_key_number, only: key_source_t, needs_path, at_design
   implicit none(type, external)
   private
   public :: reach_of, lacks_state

   real(wp), parameter :: margin = 1.001_wp    !! factor on a window: its states may be off their swept values by the tolerance

contains

   !> The swept value beyond which a key number does not need a state of a source [SI]: 0 for a key number that is read at design,
   !> and the end of the window for a gradient if the abscissa of the test is the swept value times a constant. In all other cases
   !> all states are needed, and the result is huge.
   pure real(wp) function reach_of(how, suspension, case, source, test) result(reach)
      integer, intent(in) :: how                        !! of ek_key_number
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(key_source_t), intent(in) :: source
      type(test_result_t), intent(in) :: test
      type(suspension_t) :: on_rig
      type(case_t) :: this
      type(rig_test_t) :: rig
      character(name_length) :: over

      reach = huge(reach)
      if (how == at_design) reach = 0.0_wp
      if (needs_path(how) .or. how == at_design) return
      rig = rig_test(case%test)
      over = source%over(1)
      if (over == '') over = source%over(2)
      if (over == 'factor') then
         if (.not. (abs(test%factor_size) > 0.0_wp .and. is_mountable(case))) return
         call mount(suspension, case, on_rig, this)
         reach = margin*source%half/abs(test%factor_size)*this%unit
      else if (case%vertical /= '') then
         return
      else if (index(over, 'wheel_travel_mm') > 0) then
         if (case%drive == 'wheel_travel' .and. size(suspension%wheels) == 1) reach = margin*source%half*millimetre
         if (rig%action == moves_heights .and. .not. of_one_wheel(rig)) reach = margin*source%half*millimetre
      else if (over == 'axle_roll_deg') then
         if (rig%action == rolls) reach = margin*source%half*degree
      else if (over == 'steering_wheel_deg') then
         if (rig%action == steers) reach = margin*source%half/360.0_wp*abs(suspension%steering%ratio)
      end if

   end function reach_of

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
