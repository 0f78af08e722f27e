!> The data of a deck that one thread owns: present numbers, their model, and each case on its rig with its last solution.
!>
!> This module defines the ordered stages of a design. put_numbers resets all stages. Each stage is reached again on request, by one
!> procedure:
!>
!>     workspace:  numbers_given → realised → balanced        put_numbers, take_numbers, balance_once
!>     a case:     not_examined → examined → on_rig           prove_case or examine_again, put_on_rig
!>
!> solve_numbers and settle_numbers compute numbers and return a code. These two procedures, ready_cases and balance_once create no
!> strings. solve_or_explain and settle_or_explain examine the cases in full, call solve_numbers or settle_numbers, and explain a
!> failure. balance_or_explain calls balance_once and explains a failure. The procedures with `explain` in their names and
!> settle_model create strings. gfortran stores the length of a string that a function returns in one location for all threads, so
!> that only one thread at a time may call them.
module ek_workspace
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_model
   use ek_text, only: quoted
   use ek_parameter, only: all_in_range
   use ek_reader, only: definition_t
   use ek_realise, only: realise, realise_cases
   use ek_suspension, only: suspension_t, copy_numbers
   use ek_case, only: case_t, is_mountable, default_tolerance
   use ek_manoeuvre, only: can_drive
   use ek_balance, only: balance_failure_t, set_preloads, fail_balance, no_start
   use ek_start, only: start_space_t, find_start
   use ek_align, only: align_space_t, find_alignment
   use ek_preload_problem, only: preload_problem_t
   use ek_diagnosis, only: diagnosis_t
   use ek_case_result, only: solve_options_t, solve_case, solve_mounted, add_remarks, failure_of
   use ek_examination, only: examine_case, add_distinct, spring_hint
   use ek_case_work, only: case_work_t, renew_case, make_room, examine_again, put_on_rig, not_examined, examined
   implicit none(type, external)
   private
   public :: workspace_t, give_definition, put_numbers, ready_cases, mount_numbers, solve_numbers, solve_or_explain, &
      settle_numbers, settle_or_explain, settle_model, balance_or_explain
   public :: numbers_given, realised, balanced, succeeded, out_of_range, in_doubt, not_balanced

   ! stages of the numbers, each after the one before
   integer, parameter :: numbers_given = 0
   integer, parameter :: realised = 1       !! `raw` and the cases of the design have these numbers
   integer, parameter :: balanced = 2       !! `suspension` has these numbers, the preloads of the preload trim (`balance`), and
                                            !! the start state of the tests

   ! outcomes of solve_numbers and settle_numbers
   integer, parameter :: succeeded = 0
   integer, parameter :: out_of_range = 1   !! a number is outside the range of the blueprint: the design must be read from the
                                            !! deck's strings
   integer, parameter :: in_doubt = 2       !! the design may have a defect: prove_case decides
   integer, parameter :: not_balanced = 3   !! the preload trim failed: fail_balance gives the message

   type :: workspace_t
      type(definition_t), pointer :: definition => null()   !! of the deck; shared by all copies of the workspace, and never changed
      real(wp), allocatable :: x(:)                     !! present numbers [SI, axes of the deck]; changed by put_numbers
      type(case_t), allocatable :: deck_cases(:)        !! cases of the deck, with the present numbers
      logical :: keeps_origins = .false.                !! the reference points of the bodies stay where they are in `raw`
      integer :: stage = numbers_given
      type(suspension_t) :: raw                         !! model with these numbers, without the preload trim
      type(suspension_t) :: suspension                  !! model with the preload trim
      type(case_work_t), allocatable :: cases(:)        !! cases of the workspace, see ek_workspace_cases
      integer, allocatable :: report_order(:)           !! index in `cases` of each case of the report
      real(wp), private :: tolerance = 0.0_wp           !! tolerance of the last preload trim [m]
      type(balance_failure_t), private :: failure       !! outcome of the last preload trim
      type(preload_problem_t), private :: space         !! work space of the preload trim
      ! classes, as in case_work_t; allocated when the deck needs them
      class(start_space_t), allocatable, private :: start_space      !! work space of the start state
      class(align_space_t), allocatable, private :: align_space      !! work space of &align
      logical, private :: has_started = .false.         !! an earlier design has a start state: a later design without
                                                        !! one fails, so that all designs begin in states of one kind
   end type workspace_t

contains

   !> Gives a workspace its definition, with the numbers of the deck. The definition must outlive the workspace and all its copies.
   subroutine give_definition(definition, workspace)
      type(definition_t), target, intent(in) :: definition
      type(workspace_t), intent(inout) :: workspace        !! empty but for `raw`, the model of the definition

      workspace%definition => definition
      allocate (workspace%x, source=definition%parameters%x(:definition%parameters%used))
      allocate (workspace%deck_cases, source=definition%cases)
      workspace%stage = realised
   end subroutine give_definition

   !> Stores new numbers for the next solution. All stages are reset.
   pure subroutine put_numbers(x, workspace)
      real(wp), intent(in) :: x(:)                      !! numbers of all parameters [SI, axes of the deck]
      type(workspace_t), intent(inout) :: workspace

      workspace%x(:) = x
      workspace%stage = numbers_given
      workspace%cases%stage = not_examined
   end subroutine put_numbers

   !> Realises the suspension and the cases with the present numbers, unless this was already done. is_done is .false. if the
   !> numbers are outside the range of the blueprint; the design must then be read from the deck's strings.
   subroutine take_numbers(workspace, is_done)
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_done
      integer :: k

      is_done = .true.
      if (workspace%stage >= realised) return
      associate (definition => workspace%definition)
         is_done = all_in_range(definition%parameters, workspace%x)
         if (is_done) call realise(definition%plan, workspace%x, workspace%raw, is_done, workspace%keeps_origins)
         if (is_done) call realise_cases(definition%plan, workspace%x, workspace%deck_cases, is_done)
      end associate
      do k = 1, size(workspace%deck_cases)
         if (is_done) is_done = can_drive(workspace%raw, workspace%deck_cases(k))
      end do
      if (is_done) workspace%stage = realised
   end subroutine take_numbers

   !> Balances the suspension with a tolerance, unless the suspension is already balanced with this tolerance. `workspace%failure`
   !> is the outcome; its reason is 0 if the preload trim succeeded. No string is created.
   subroutine balance_once(tolerance, workspace)
      real(wp), intent(in) :: tolerance                    !! tolerance of the preload trim [m]
      type(workspace_t), intent(inout) :: workspace        !! realised
      logical :: is_found

      if (workspace%stage == balanced .and. abs(tolerance - workspace%tolerance) <= 0.0_wp) return
      if (allocated(workspace%suspension%bodies)) then
         call copy_numbers(workspace%raw, workspace%suspension)
      else
         workspace%suspension = workspace%raw
      end if
      call set_preloads(workspace%suspension, tolerance, workspace%space, workspace%failure)
      if (workspace%failure%reason == 0 .and. size(workspace%suspension%aligns) > 0) then
         if (.not. allocated(workspace%align_space)) allocate (workspace%align_space)
         call find_alignment(workspace%suspension, workspace%align_space, workspace%failure)
      end if
      if (workspace%failure%reason == 0) then
         if (.not. allocated(workspace%start_space)) allocate (workspace%start_space)
         call find_start(workspace%suspension, tolerance, workspace%start_space, is_found)
         if (.not. is_found .and. (workspace%suspension%must_start .or. workspace%has_started)) workspace%failure%reason = no_start
         workspace%has_started = workspace%has_started .or. is_found
      end if
      workspace%stage = merge(balanced, realised, workspace%failure%reason == 0)
      workspace%tolerance = tolerance
   end subroutine balance_once

   !> Balances the suspension as balance_once does. Returns a message if no preloads hold the suspension.
   subroutine balance_or_explain(tolerance, workspace, error)
      real(wp), intent(in) :: tolerance                    !! tolerance of the preload trim [m]
      type(workspace_t), intent(inout) :: workspace        !! realised
      type(error_t), allocatable, intent(out) :: error     !! exit_model, exit_convergence

      call balance_once(tolerance, workspace)
      call fail_balance(workspace%suspension, workspace%failure, error)
   end subroutine balance_or_explain

   !> Examines a case in full. If the case can be solved, its stage is `examined`; otherwise `defects` lists its defects.
   subroutine prove_case(k, workspace, defects)
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
   end subroutine prove_case

   !> Prepares the current numbers up to the mounted rigs of all cases, balanced with the tolerance of the first case. Creates no
   !> strings. is_done is .false. if a number is outside its range, if the design may have a defect, or if the preload trim failed.
   !> The design must then be read from the deck's strings.
   subroutine ready_cases(workspace, is_done)
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_done
      integer :: k

      call take_numbers(workspace, is_done)
      do k = 1, size(workspace%cases)
         if (is_done) call examine_again(workspace%raw, workspace%deck_cases, workspace%cases(k), is_done)
      end do
      if (is_done) call balance_once(workspace%cases(1)%case%tolerance, workspace)
      is_done = is_done .and. workspace%stage == balanced
      if (.not. is_done) return
      do k = 1, size(workspace%cases)
         call put_on_rig(workspace%suspension, workspace%cases(k))
      end do
   end subroutine ready_cases

   !> Puts a case on the rig with the present numbers, balanced, and solves nothing. No string is created. The numbers are not
   !> examined: they must be close to the numbers of an examined design, whose scales the system keeps. is_done is .false. if the
   !> numbers are outside the range of the blueprint, or if the preload trim failed.
   subroutine mount_numbers(k, tolerance, workspace, is_done)
      integer, intent(in) :: k
      real(wp), intent(in) :: tolerance                    !! tolerance of the preload trim [m]
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_done

      call take_numbers(workspace, is_done)
      if (.not. is_done) return
      call renew_case(workspace%raw, workspace%deck_cases, workspace%cases(k))
      call balance_once(tolerance, workspace)
      is_done = workspace%stage == balanced
      if (.not. is_done) return
      call put_on_rig(workspace%suspension, workspace%cases(k), keeps_scales=.true.)
      workspace%cases(k)%stage = min(workspace%cases(k)%stage, examined)      ! the caller uses its work space
   end subroutine mount_numbers

   !> Solves a case with the current numbers. Creates no strings if the case was solved before with the same columns.
   subroutine solve_numbers(k, options, workspace, outcome)
      integer, intent(in) :: k
      type(solve_options_t), intent(in) :: options
      type(workspace_t), intent(inout) :: workspace
      integer, intent(out) :: outcome                    !! `succeeded`, or the reason why nothing was solved
      logical :: is_done

      outcome = out_of_range
      call take_numbers(workspace, is_done)
      if (.not. is_done) return
      outcome = in_doubt
      if (workspace%cases(k)%stage == not_examined) &
         call examine_again(workspace%raw, workspace%deck_cases, workspace%cases(k), is_done)
      if (.not. is_done) return
      outcome = not_balanced
      call balance_once(workspace%cases(k)%case%tolerance, workspace)
      if (workspace%stage < balanced) return
      associate (this => workspace%cases(k))
         call put_on_rig(workspace%suspension, this)
         this%stage = examined                             ! the solution uses up the proof of soundness
         call solve_mounted(options, this%result, observer=this%observer)
      end associate
      outcome = succeeded
   end subroutine solve_numbers

   !> Solves a case at the present numbers, with full examination and messages. is_done is .false. if the numbers are outside the
   !> range of the blueprint; the design must then be read from the deck's strings.
   subroutine solve_or_explain(k, options, workspace, is_done, error)
      integer, intent(in) :: k
      type(solve_options_t), intent(in) :: options
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_done
      type(error_t), allocatable, intent(out) :: error     !! exit_model, exit_convergence, exit_file: nothing was solved
      character(:), allocatable :: defects
      integer :: outcome

      call take_numbers(workspace, is_done)
      if (.not. is_done) return
      associate (this => workspace%cases(k))
         call renew_case(workspace%raw, workspace%deck_cases, this)
         if (.not. is_mountable(this%case)) then           ! the result gives the reason
            call make_room(this)
            call solve_case(workspace%raw, this%case, options, this%result)
            call add_remarks(options, this%result)
            call failure_of(this%result, error)
            return
         end if
         call prove_case(k, workspace, defects)
         if (this%stage == not_examined) then
            call fail(error, exit_model, 'case '//quoted(this%case%name)//': the model cannot be solved'// &
               spring_hint(workspace%raw, this%case)//new_line('a')//defects)
            return
         end if
      end associate
      call solve_numbers(k, options, workspace, outcome)
      if (outcome == not_balanced) call fail_balance(workspace%suspension, workspace%failure, error)
   end subroutine solve_or_explain

   !> Examines the needed cases of the report at the present numbers, and balances the suspension as the report does. No string is
   !> created if the needed cases were examined before.
   subroutine settle_numbers(is_needed, workspace, outcome)
      logical, intent(in) :: is_needed(:)                  !! whether each case is needed, in the order of the report
      type(workspace_t), intent(inout) :: workspace
      integer, intent(out) :: outcome                      !! `succeeded`: the needed cases are examined, and the model is balanced
      logical :: is_done
      integer :: j, k

      outcome = out_of_range
      call take_numbers(workspace, is_done)
      if (.not. is_done) return
      outcome = in_doubt
      do j = 1, size(is_needed)
         k = workspace%report_order(j)
         if (.not. is_needed(j)) then
            call renew_case(workspace%raw, workspace%deck_cases, workspace%cases(k))
         else if (workspace%cases(k)%stage == not_examined) then
            call examine_again(workspace%raw, workspace%deck_cases, workspace%cases(k), is_done)
            if (.not. is_done) return
         end if
      end do
      call balance_once(default_tolerance, workspace)
      outcome = merge(succeeded, not_balanced, workspace%stage == balanced)
   end subroutine settle_numbers

   !> Examines and balances like settle_numbers, but examines the needed cases in full and creates messages. is_done is .false. if
   !> the design must be read from the deck's strings.
   subroutine settle_or_explain(is_needed, workspace, is_solvable, defects, is_done, error)
      logical, intent(in) :: is_needed(:)                  !! whether each case is needed, in the order of the report
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_solvable(:)
      type(message_list_t), intent(out) :: defects         !! defects of all needed cases, without repetition
      logical, intent(out) :: is_done
      type(error_t), allocatable, intent(out) :: error     !! exit_model: no case can be solved; exit_convergence
      character(:), allocatable :: name, words
      logical :: is_proved(size(is_needed))
      integer :: j, k, outcome

      is_solvable = .true.
      is_proved = .false.
      name = ''
      call take_numbers(workspace, is_done)
      if (.not. is_done) return
      do j = 1, size(is_needed)
         k = workspace%report_order(j)
         call renew_case(workspace%raw, workspace%deck_cases, workspace%cases(k))
         if (.not. is_needed(j) .or. .not. is_mountable(workspace%cases(k)%case)) cycle
         call prove_case(k, workspace, words)
         call add_distinct(defects, words)
         is_proved(j) = workspace%cases(k)%stage > not_examined
         is_solvable(j) = is_proved(j)
         name = workspace%cases(k)%case%name
      end do
      if (any(is_needed) .and. .not. any(is_solvable .and. is_needed)) then
         call fail_unsolvable(defects, error)
         if (count(is_needed) == 1) error%message = 'case '//quoted(name)//': '//error%message
         return
      end if
      call settle_numbers(is_proved, workspace, outcome)
      if (outcome == not_balanced) call fail_balance(workspace%suspension, workspace%failure, error)
   end subroutine settle_or_explain

   !> Reports all defects of the model as one error.
   pure subroutine fail_unsolvable(defects, error)
      type(message_list_t), intent(in) :: defects
      type(error_t), allocatable, intent(out) :: error
      call fail(error, exit_model, 'the model cannot be solved'//new_line('a')//defects%text())
   end subroutine fail_unsolvable

   !> Balances the model at the present numbers like the report, unless all examined cases have defects. Creates messages.
   subroutine settle_model(workspace, is_balanced, is_done, error)
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_balanced
      logical, intent(out) :: is_done                      !! .false.: the design must be read from the deck's strings
      type(error_t), allocatable, intent(out) :: error     !! exit_model, exit_convergence: reason why no case can be solved, or why
                                                           !! the preload trim failed
      type(message_list_t) :: defects
      character(:), allocatable :: words
      integer :: k

      is_balanced = .false.
      call take_numbers(workspace, is_done)
      if (.not. is_done) return
      do k = 1, merge(0, size(workspace%cases), any(workspace%cases%stage > not_examined))
         call renew_case(workspace%raw, workspace%deck_cases, workspace%cases(k))
         if (.not. is_mountable(workspace%cases(k)%case)) cycle
         call prove_case(k, workspace, words)
         if (workspace%cases(k)%stage > not_examined) exit
         call add_distinct(defects, words)
      end do
      if (defects%count() > 0 .and. all(workspace%cases%stage == not_examined)) then
         call fail_unsolvable(defects, error)
         return
      end if
      call balance_or_explain(default_tolerance, workspace, error)
      is_balanced = .not. allocated(error)
   end subroutine settle_model

end module ek_workspace
