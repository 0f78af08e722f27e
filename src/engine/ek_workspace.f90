!> The data of a deck that one thread owns: present numbers, their model, and each case on its rig with its last solution.
!>
!> This module defines the ordered stages of a design. put_numbers resets all of them; each is reached again on request, by one
!> procedure:
!>
!>     workspace:  numbers_given → realised → balanced        put_numbers, take_numbers, balance_once
!>     a case:     not_examined → examined → on_rig           examine_fully or examine_again, put_on_rig
!>
!> The first solution of a case, and any that may have a defect, makes texts (its columns, messages); further solutions compute
!> numbers only. gfortran stores the length of a text that a function returns in one location for all threads: the caller lets one
!> thread at a time make texts (solve_case_fully, settle_fully), and ready_cases, solve_case_again and settle_again make no texts.
module ek_workspace
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_model
   use ek_text, only: quoted
   use ek_parameter, only: all_in_range
   use ek_reader, only: design_t
   use ek_realise, only: realise, realise_cases
   use ek_suspension, only: suspension_t, copy_numbers
   use ek_case, only: is_mountable, default_tolerance
   use ek_balance, only: balance
   use ek_preload_problem, only: preload_problem_t
   use ek_diagnosis, only: diagnosis_t
   use ek_case_result, only: solve_options_t, solve_case, solve_mounted
   use ek_examination, only: examine_case, add_distinct
   use ek_case_work, only: case_work_t, renew_case, make_room, examine_again, put_on_rig, not_examined, examined
   implicit none(type, external)
   private
   public :: workspace_t, put_numbers, ready_cases, mount_numbers, solve_case_fully, solve_case_again, settle_fully, settle_again, &
      settle_model, balance_once
   public :: numbers_given, realised

   ! stages of the numbers, each after the one before
   integer, parameter :: numbers_given = 0
   integer, parameter :: realised = 1       !! raw and the cases of the design have these numbers
   integer, parameter :: balanced = 2       !! suspension has these numbers and the preloads of balance

   type :: workspace_t
      type(design_t) :: design
      real(wp), allocatable :: x(:)                     !! present numbers [SI, axes of the deck]; changed by put_numbers
      integer :: stage = numbers_given
      type(suspension_t) :: raw                         !! with these numbers, not balanced
      type(suspension_t) :: suspension                  !! balanced
      type(case_work_t), allocatable :: cases(:)        !! see ek_workspace_cases
      integer, allocatable :: report_order(:)           !! the cases in the order of the report
      real(wp), private :: tolerance = 0.0_wp           !! of the balance [m]
      type(preload_problem_t), private :: space         !! of balance
   end type workspace_t

contains

   !> Stores new numbers, which the next solution uses.
   pure subroutine put_numbers(x, workspace)
      real(wp), intent(in) :: x(:)                      !! of all parameters [SI, axes of the deck]
      type(workspace_t), intent(inout) :: workspace

      workspace%x(:) = x
      workspace%stage = numbers_given
      workspace%cases%stage = not_examined
   end subroutine put_numbers

   !> Realises the suspension and the cases with the present numbers, unless this was done. is_done is .false. if they are outside
   !> the range of the blueprint: then the design must be read from the text.
   subroutine take_numbers(workspace, is_done)
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_done

      is_done = .true.
      if (workspace%stage >= realised) return
      is_done = all_in_range(workspace%design%parameters, workspace%x)
      if (is_done) call realise(workspace%design%plan, workspace%x, workspace%raw, is_done)
      if (is_done) call realise_cases(workspace%design%plan, workspace%x, workspace%design%cases, is_done)
      if (is_done) workspace%stage = realised
   end subroutine take_numbers

   !> Balances the suspension, once for all cases of one tolerance.
   subroutine balance_once(tolerance, is_terse, workspace, error)
      real(wp), intent(in) :: tolerance                    !! m
      logical, intent(in) :: is_terse                      !! no texts
      type(workspace_t), intent(inout) :: workspace        !! realised
      type(error_t), allocatable, intent(out) :: error

      if (workspace%stage == balanced .and. abs(tolerance - workspace%tolerance) <= 0.0_wp) return
      if (allocated(workspace%suspension%bodies)) then
         call copy_numbers(workspace%raw, workspace%suspension)
      else
         workspace%suspension = workspace%raw
      end if
      call balance(workspace%suspension, tolerance, error, is_terse, workspace%space)
      workspace%stage = merge(realised, balanced, allocated(error))
      workspace%tolerance = tolerance
   end subroutine balance_once

   !> Examines a case with texts.
   subroutine examine_fully(k, workspace, defects)
      integer, intent(in) :: k
      type(workspace_t), intent(inout) :: workspace        !! realised
      character(:), allocatable, intent(out) :: defects    !! '' if the case can be solved
      type(diagnosis_t) :: diagnosis

      associate (this => workspace%cases(k))
         call examine_case(workspace%raw, this%case, diagnosis, this%known)
         this%stage = merge(examined, not_examined, diagnosis%is_solvable())
         defects = ''
         if (this%stage == not_examined) defects = diagnosis%words()
      end associate
   end subroutine examine_fully

   !> Takes the present numbers as far as all cases on the rig, balanced with the tolerance of the first. No text is made. is_done
   !> is .false. if the design must be read from the text: a number is outside its range, or the design may have a defect.
   subroutine ready_cases(workspace, is_done)
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_done
      type(error_t), allocatable :: error
      integer :: k

      call take_numbers(workspace, is_done)
      do k = 1, size(workspace%cases)
         if (is_done) call examine_again(workspace%raw, workspace%design, workspace%cases(k), is_done)
      end do
      if (is_done) call balance_once(workspace%cases(1)%case%tolerance, .true., workspace, error)
      is_done = is_done .and. .not. allocated(error)
      if (.not. is_done) return
      do k = 1, size(workspace%cases)
         call put_on_rig(workspace%suspension, workspace%cases(k))
      end do
   end subroutine ready_cases

   !> Puts a case on the rig with the present numbers, balanced, and solves nothing. No text is made, and the numbers are not
   !> examined: they are close to the numbers of an examined design. is_done is .false. if the numbers are outside the range of
   !> the blueprint.
   subroutine mount_numbers(k, tolerance, workspace, is_done)
      integer, intent(in) :: k
      real(wp), intent(in) :: tolerance                    !! of balance [m]
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_done
      type(error_t), allocatable :: error

      call take_numbers(workspace, is_done)
      if (.not. is_done) return
      call renew_case(workspace%raw, workspace%design, workspace%cases(k))
      call balance_once(tolerance, .true., workspace, error)
      is_done = .not. allocated(error)
      if (.not. is_done) return
      call put_on_rig(workspace%suspension, workspace%cases(k))
      workspace%cases(k)%stage = min(workspace%cases(k)%stage, examined)      ! the caller uses its work space
   end subroutine mount_numbers

   !> Solves a case at the present numbers, with full examination and messages. is_done is .false. if these numbers are outside the
   !> range of the blueprint: then the design must be read from the text.
   subroutine solve_case_fully(k, options, workspace, is_done, error)
      integer, intent(in) :: k
      type(solve_options_t), intent(in) :: options
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_done
      type(error_t), allocatable, intent(out) :: error     !! exit_model, exit_convergence: nothing was solved
      character(:), allocatable :: defects

      call take_numbers(workspace, is_done)
      if (.not. is_done) return
      associate (this => workspace%cases(k))
         call renew_case(workspace%raw, workspace%design, this)
         if (.not. is_mountable(this%case)) then           ! the result gives the reason
            call make_room(this)
            call solve_case(workspace%raw, this%case, options, this%result)
            return
         end if
         call examine_fully(k, workspace, defects)
         if (this%stage == not_examined) then
            call fail(error, exit_model, 'case '//quoted(this%case%name)//': the model cannot be solved'//new_line('a')// &
               defects)
            return
         end if
      end associate
      call solve_balanced(k, options, .false., workspace, error)
   end subroutine solve_case_fully

   !> Solves a case that was solved before, with the same columns, at the present numbers. No text is made. is_done is .false. if
   !> the design must be read from the text: a number is outside its range, or the design may have a defect.
   subroutine solve_case_again(k, options, workspace, is_done)
      integer, intent(in) :: k
      type(solve_options_t), intent(in) :: options       !! without remarks
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_done
      type(error_t), allocatable :: error

      call take_numbers(workspace, is_done)
      if (.not. is_done) return
      if (workspace%cases(k)%stage == not_examined) &
         call examine_again(workspace%raw, workspace%design, workspace%cases(k), is_done)
      if (.not. is_done) return
      call solve_balanced(k, options, .true., workspace, error)
      is_done = .not. allocated(error)
   end subroutine solve_case_again

   !> Mounts and solves a case of a design that was examined.
   subroutine solve_balanced(k, options, is_terse, workspace, error)
      integer, intent(in) :: k
      type(solve_options_t), intent(in) :: options
      logical, intent(in) :: is_terse                      !! no texts
      type(workspace_t), intent(inout) :: workspace
      type(error_t), allocatable, intent(out) :: error

      call balance_once(workspace%cases(k)%case%tolerance, is_terse, workspace, error)
      if (allocated(error)) return
      associate (this => workspace%cases(k))
         call put_on_rig(workspace%suspension, this)
         this%stage = examined                             ! the solution uses up the proof of soundness
         call solve_mounted(options, this%result, observer=this%observer)
      end associate
   end subroutine solve_balanced

   !> Examines the needed cases of the report at the present numbers and balances the suspension as the report does; with messages.
   subroutine settle_fully(is_needed, workspace, is_solvable, defects, is_done, error)
      logical, intent(in) :: is_needed(:)                  !! in the order of the report
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_solvable(:)
      type(message_list_t), intent(out) :: defects         !! defects of the other cases, without repetition
      logical, intent(out) :: is_done                      !! .false.: the design must be read from the text
      type(error_t), allocatable, intent(out) :: error     !! exit_model: no case can be solved
      character(:), allocatable :: name, words
      integer :: j, k

      is_solvable = .true.
      name = ''
      call take_numbers(workspace, is_done)
      if (.not. is_done) return
      do j = 1, size(is_needed)
         k = workspace%report_order(j)
         call renew_case(workspace%raw, workspace%design, workspace%cases(k))
         if (.not. is_needed(j) .or. .not. is_mountable(workspace%cases(k)%case)) cycle
         call examine_fully(k, workspace, words)
         call add_distinct(defects, words)
         is_solvable(j) = workspace%cases(k)%stage > not_examined
         name = workspace%cases(k)%case%name
      end do
      if (any(is_needed) .and. .not. any(is_solvable .and. is_needed)) then
         call fail_unsolvable(defects, error)
         if (count(is_needed) == 1) error%message = 'case '//quoted(name)//': '//error%message
      else
         call balance_once(default_tolerance, .false., workspace, error)
      end if
   end subroutine settle_fully

   !> Reports the defects of the model as one error.
   pure subroutine fail_unsolvable(defects, error)
      type(message_list_t), intent(in) :: defects
      type(error_t), allocatable, intent(out) :: error
      call fail(error, exit_model, 'the model cannot be solved'//new_line('a')//defects%text())
   end subroutine fail_unsolvable

   !> Settles as settle_fully does, for cases that were solved before: no text is made. is_done is .false. if there is a doubt.
   subroutine settle_again(is_needed, workspace, is_done)
      logical, intent(in) :: is_needed(:)                  !! in the order of the report
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_done
      type(error_t), allocatable :: error
      integer :: j, k

      call take_numbers(workspace, is_done)
      do j = 1, size(is_needed)
         if (.not. is_done) return
         k = workspace%report_order(j)
         if (.not. is_needed(j)) then
            call renew_case(workspace%raw, workspace%design, workspace%cases(k))
         else if (workspace%cases(k)%stage == not_examined) then
            call examine_again(workspace%raw, workspace%design, workspace%cases(k), is_done)
         end if
      end do
      if (is_done) call balance_once(default_tolerance, .true., workspace, error)
      is_done = is_done .and. .not. allocated(error)
   end subroutine settle_again

   !> Balances the model at the present numbers as the report does, if a case can be solved; with messages.
   subroutine settle_model(workspace, is_balanced, is_done, error)
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_balanced
      logical, intent(out) :: is_done                      !! .false.: the design must be read from the text
      type(error_t), allocatable, intent(out) :: error     !! exit_model, exit_convergence: why no case can be solved
      type(message_list_t) :: defects
      character(:), allocatable :: words
      integer :: k

      is_balanced = .false.
      call take_numbers(workspace, is_done)
      if (.not. is_done) return
      do k = 1, merge(0, size(workspace%cases), any(workspace%cases%stage > not_examined))
         call renew_case(workspace%raw, workspace%design, workspace%cases(k))
         if (.not. is_mountable(workspace%cases(k)%case)) cycle
         call examine_fully(k, workspace, words)
         if (workspace%cases(k)%stage > not_examined) exit
         call add_distinct(defects, words)
      end do
      if (defects%count() > 0 .and. all(workspace%cases%stage == not_examined)) then
         call fail_unsolvable(defects, error)
         return
      end if
      call balance_once(default_tolerance, .false., workspace, error)
      is_balanced = .not. allocated(error)
   end subroutine settle_model

end module ek_workspace
