!> A case on the rig with a model that is no design of a workspace: its columns, its range, its defects, its solution.
!>
!> The layers above put cases on the rig through this module and ek_workspace, and nowhere else. A workspace reuses the case of the
!> design before; these procedures begin anew.
module ek_lone_case
   use ek_error, only: error_t, fail, exit_model
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable
   use ek_diagnosis, only: diagnosis_t
   use ek_rig, only: mount, mounted_case_t, mount_case
   use ek_examination, only: examine_case
   use ek_table, only: name_length
   use ek_sweep_table, only: sweep_columns, observer_t
   use ek_case_result, only: case_result_t, solve_options_t, solve_case, solve_mounted
   implicit none(type, external)
   private
   public :: heads_on_rig, case_on_rig, examine_on_rig, solve_sound, solve_anew

contains

   !> Lists the headings of all columns of the table of a case.
   subroutine heads_on_rig(suspension, given, heads)
      type(suspension_t), intent(in) :: suspension           !! on no rig
      type(case_t), intent(in) :: given                      !! is_mountable
      character(name_length), allocatable, intent(out) :: heads(:)
      type(suspension_t) :: on_rig
      type(case_t) :: case

      call mount(suspension, given, on_rig, case)
      call sweep_columns(on_rig, case, heads)
   end subroutine heads_on_rig

   !> Finds the range, the unit and the name of the swept value of a case on the rig.
   subroutine case_on_rig(suspension, given, case)
      type(suspension_t), intent(in) :: suspension           !! on no rig
      type(case_t), intent(in) :: given                      !! is_mountable
      type(case_t), intent(out) :: case
      type(suspension_t) :: on_rig

      call mount(suspension, given, on_rig, case)
   end subroutine case_on_rig

   !> Diagnoses a model on the rig of a case, at design. A case that cannot be put on the rig has no defect.
   subroutine examine_on_rig(suspension, given, diagnosis, case)
      type(suspension_t), intent(in) :: suspension           !! before the preload trim
      type(case_t), intent(in) :: given
      type(diagnosis_t), intent(out) :: diagnosis
      type(case_t), intent(out) :: case                      !! as of case_on_rig; unchanged if it cannot be put on the rig
      type(mounted_case_t), allocatable :: mounted

      allocate (mounted)
      call examine_case(suspension, given, diagnosis, mounted=mounted)
      if (is_mountable(given)) then
         case = mounted%case
      else
         case = given
      end if
   end subroutine examine_on_rig

   !> Examines a model on the rig of a case, and solves the case if the model has no defect.
   subroutine solve_sound(suspension, case, options, result, error)
      type(suspension_t), intent(in) :: suspension           !! after the preload trim
      type(case_t), intent(in) :: case
      type(solve_options_t), intent(in) :: options
      type(case_result_t), intent(out) :: result
      type(error_t), allocatable, intent(out) :: error       !! exit_model: the defects; nothing was solved
      type(diagnosis_t) :: diagnosis

      call examine_case(suspension, case, diagnosis)
      if (diagnosis%is_solvable()) then
         call solve_case(suspension, case, options, result)
      else
         call fail(error, exit_model, 'the model cannot be solved'//new_line('a')//diagnosis%words())
      end if
   end subroutine solve_sound

   !> Solves a case of a model that was examined, in the memory of an earlier solution. No string is created.
   subroutine solve_anew(suspension, case, options, result, observer)
      type(suspension_t), intent(in) :: suspension           !! after the preload trim
      type(case_t), intent(in) :: case                       !! is_mountable
      type(solve_options_t), intent(in) :: options
      class(case_result_t), allocatable, intent(inout) :: result
      type(observer_t), allocatable, intent(inout) :: observer

      if (.not. allocated(result)) allocate (result)
      if (.not. allocated(observer)) allocate (observer)
      call mount_case(suspension, case, result%mounted_case_t)
      call solve_mounted(options, result, observer=observer)
   end subroutine solve_anew

end module ek_lone_case
