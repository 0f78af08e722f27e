!> A deck opened for a program that calls elastokin: messages on its model. Part of the Fortran interface (ek_api).
module ek_session_remarks
   use ek_error, only: error_t
   use ek_deck, only: deck_t
   use ek_case, only: case_t
   use ek_workspace, only: workspace_t, settle_model
   use ek_workspace_cases, only: open_workspace, report_cases
   use ek_model_remark, only: model_remarks_t, find_model_remarks
   use ek_session, only: session_t, without_option, take_new_numbers, changed_deck
   implicit none(type, external)
   private
   public :: find_remarks

contains

   !> Finds the messages on the model at the present numbers, as the command line prints them. Examples: no spring, contact points
   !> away from the ground, implausible values, preloads found by the preload trim (`balance`), or the reason why the model cannot
   !> be solved. No case is solved; the last solution is unchanged.
   subroutine find_remarks(session, remarks, error)
      type(session_t), intent(inout) :: session
      type(model_remarks_t), intent(out) :: remarks
      type(error_t), allocatable, intent(out) :: error     !! exit_usage, exit_deck: a number is outside its range
      class(workspace_t), allocatable :: other
      type(deck_t) :: changed
      logical :: is_done

      call take_new_numbers(session)
      !$omp critical (ek_words)
      call find_of(session%workspace, remarks, is_done)
      if (.not. is_done) then
         allocate (other)
         call changed_deck(session, changed, error)
         if (.not. allocated(error)) call open_workspace(changed, other, error)
         if (.not. allocated(error)) call find_of(other, remarks, is_done)
         call without_option(error)
      end if
      !$omp end critical (ek_words)
   end subroutine find_remarks

   !> Finds the messages at the numbers of a workspace. is_done is .false. if the design must be read from the deck's strings.
   subroutine find_of(workspace, remarks, is_done)
      type(workspace_t), intent(inout) :: workspace
      type(model_remarks_t), intent(out) :: remarks
      logical, intent(out) :: is_done
      type(case_t), allocatable :: cases(:)
      type(error_t), allocatable :: fault
      logical :: is_balanced

      call settle_model(workspace, is_balanced, is_done, fault)
      if (.not. is_done) return
      call report_cases(workspace, cases)
      if (is_balanced) then
         call find_model_remarks(workspace%suspension, workspace%raw, workspace%design%cases, cases, .true., remarks)
      else
         call find_model_remarks(workspace%raw, workspace%raw, workspace%design%cases, cases, .false., remarks)
      end if
      if (allocated(fault)) call remarks%faults%add(fault%message)
   end subroutine find_of

end module ek_session_remarks
