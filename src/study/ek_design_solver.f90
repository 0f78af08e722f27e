!> A deck whose numbers change: its cases are solved, one after the other, at any numbers of its design space.
!>
!> The first solution of a case, and any that may have a defect, makes texts (its columns, messages); the others are numbers
!> only. gfortran keeps the length of a text that a function returns in one place for all threads: the caller lets one thread at a
!> time make texts (solve_case_fully), and solve_case_again makes none.
module ek_design_solver
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_model, exit_file
   use ek_text, only: quoted
   use ek_deck, only: deck_t
   use ek_parameter, only: all_in_range
   use ek_reader, only: design_t, read_design, realise_deck
   use ek_realise, only: realise, realise_cases
   use ek_suspension, only: suspension_t, copy_numbers
   use ek_case, only: case_t, is_mountable, prefer_plan, default_tolerance
   use ek_balance, only: balance
   use ek_preload_problem, only: preload_problem_t
   use ek_diagnosis, only: diagnosis_t
   use ek_rig, only: mount, mount_again, take_off
   use ek_standard_tests, only: standard_tests
   use ek_case_result, only: solve_options_t, solve_case, solve_mounted
   use ek_examination, only: check_inputs, examine_case, add_distinct
   use ek_sweep_table, only: sweep_columns
   use ek_table, only: name_length
   use ek_worker, only: worker_case_t, examine_design, refresh_case
   implicit none(type, external)
   private
   public :: design_solver_t, begin_design_solver, read_checked, put_numbers, mount_numbers, solve_case_fully, solve_case_again, &
      settle_fully, settle_again, settle_model, report_cases, restrict_cases, heads_of_case, case_number

   !> A deck, its present numbers, and the last solution of each case.
   type :: design_solver_t
      type(design_t) :: design
      real(wp), allocatable :: x(:)                     !! present numbers [SI, axes of the deck]; changed by put_numbers
      type(suspension_t) :: raw                         !! with these numbers, not balanced
      type(suspension_t) :: suspension                  !! balanced
      type(worker_case_t), allocatable :: cases(:)      !! of the deck, then the standard tests that it does not have; with all columns
      logical, allocatable, private :: is_sound(:)      !! the case was examined at these numbers
      logical, private :: is_realised = .false.         !! raw has these numbers
      logical, private :: is_balanced = .false.         !! so has suspension, with this tolerance [m]
      real(wp), private :: tolerance = 0.0_wp
      type(preload_problem_t), private :: space         !! of balance
      integer, allocatable :: report_order(:)           !! the cases in the order of the report
   end type design_solver_t

contains

   !> Reads a deck and lists its cases; reports all errors together.
   subroutine begin_design_solver(deck, solver, error)
      type(deck_t), intent(in) :: deck
      type(design_solver_t), intent(out) :: solver
      type(error_t), allocatable, intent(out) :: error       !! exit_deck
      type(case_t), allocatable :: tests(:), all(:)         ! of the report; with those on request
      integer :: own, k

      call read_checked(deck, solver%design, solver%raw, error)
      if (allocated(error)) return
      solver%x = solver%design%parameters%x(:solver%design%parameters%used)
      solver%design%cases%has_all = .true.
      call prefer_plan(solver%design%cases)
      solver%is_realised = .true.
      allocate (tests(0), all(0))
      if (size(solver%raw%wheels) > 0) call standard_tests(solver%raw, solver%design%cases, tests)
      if (size(solver%raw%wheels) > 0) call standard_tests(solver%raw, solver%design%cases, all, '*')
      own = size(solver%design%cases)
      allocate (solver%cases(own + count([(is_standard(all(k)), k=1, size(all))])))
      allocate (solver%is_sound(size(solver%cases)), source=.false.)
      do k = 1, own
         solver%cases(k)%number = k
         solver%cases(k)%case = solver%design%cases(k)
      end do
      do k = 1, size(all)
         if (.not. is_standard(all(k))) cycle
         own = own + 1
         solver%cases(own)%case = all(k)
         call prefer_plan(solver%cases(own)%case)
      end do
      solver%report_order = [(case_number(tests(k)%name, solver), k=1, size(tests))]

   contains

      !> Whether a test is not a case of the deck.
      pure logical function is_standard(test)
         type(case_t), intent(in) :: test
         integer :: j
         is_standard = .not. any([(solver%design%cases(j)%name == test%name, j=1, size(solver%design%cases))])
      end function is_standard

   end subroutine begin_design_solver

   !> Reads the design of a deck and its suspension, with all errors of the deck, of the tables and of the targets of its cases.
   subroutine read_checked(deck, design, suspension, error, needs_tables)
      type(deck_t), intent(in) :: deck
      type(design_t), intent(out) :: design
      type(suspension_t), intent(out) :: suspension
      type(error_t), allocatable, intent(out) :: error
      logical, intent(in), optional :: needs_tables          !! if .true., a missing table is an error, also of a case not run
      type(error_t), allocatable :: fault
      logical :: is_whole, needs_all

      needs_all = .false.
      if (present(needs_tables)) needs_all = needs_tables
      call read_design(deck, design, error, is_whole)
      if (is_whole) call realise_deck(deck%file, design, suspension, fault)
      if (allocated(fault)) then
         is_whole = .false.
         if (.not. allocated(error)) call move_alloc(fault, error)
      end if
      call check_inputs(suspension, design%cases, fault, is_whole)
      if (.not. allocated(fault)) return
      if (allocated(error)) then
         error%message = error%message//new_line('a')//fault%message
      else if (fault%code /= exit_file .or. needs_all) then
         ! a missing file is reported by the case that needs it: the other cases can be run
         call move_alloc(fault, error)
      end if
   end subroutine read_checked

   !> Stores new numbers, which the next solution uses.
   pure subroutine put_numbers(x, solver)
      real(wp), intent(in) :: x(:)                      !! of all parameters [SI, axes of the deck]
      type(design_solver_t), intent(inout) :: solver

      solver%x(:) = x
      solver%is_realised = .false.
      solver%is_balanced = .false.
      solver%is_sound = .false.
   end subroutine put_numbers

   !> Solves a case at the present numbers, with full examination and messages. is_done is .false. if these numbers are outside the
   !> range of the blueprint: then the design must be read from the text.
   subroutine solve_case_fully(k, options, solver, is_done, error)
      integer, intent(in) :: k
      type(solve_options_t), intent(in) :: options
      type(design_solver_t), intent(inout) :: solver
      logical, intent(out) :: is_done
      type(error_t), allocatable, intent(out) :: error     !! exit_model, exit_convergence: nothing was solved
      type(diagnosis_t) :: diagnosis

      call take_numbers(solver, is_done)
      if (.not. is_done) return
      associate (this => solver%cases(k))
         call refresh_case(solver%raw, solver%design, this)
         if (.not. is_mountable(this%case)) then           ! the result gives the reason
            call make_room(this)
            call solve_case(solver%raw, this%case, options, this%result)
            return
         end if
         call examine_case(solver%raw, this%case, diagnosis, this%known)
         if (.not. diagnosis%is_solvable()) then
            call fail(error, exit_model, 'case '//quoted(this%case%name)//': the model cannot be solved'//new_line('a')// &
               diagnosis%words())
            return
         end if
         solver%is_sound(k) = .true.
      end associate
      call solve_balanced(k, options, .false., solver, error)
   end subroutine solve_case_fully

   !> Solves a case that was solved before, with the same columns, at the present numbers. No text is made. is_done is .false. if the
   !> design must be read from the text: a number is outside its range, or the design may have a defect.
   subroutine solve_case_again(k, options, solver, is_done)
      integer, intent(in) :: k
      type(solve_options_t), intent(in) :: options       !! without remarks
      type(design_solver_t), intent(inout) :: solver
      logical, intent(out) :: is_done
      type(error_t), allocatable :: error

      call take_numbers(solver, is_done)
      if (.not. is_done) return
      if (.not. solver%is_sound(k)) call examine_design(solver%raw, solver%design, solver%cases(k), is_done)
      if (.not. is_done) return
      solver%is_sound(k) = .true.
      call solve_balanced(k, options, .true., solver, error)
      is_done = .not. allocated(error)
   end subroutine solve_case_again

   !> Puts a case on the rig with the present numbers, balanced, and solves nothing. No text is made, and the numbers are not examined:
   !> they are close to those of a design that was. is_done is .false. if they are outside the range of the blueprint.
   subroutine mount_numbers(k, tolerance, solver, is_done)
      integer, intent(in) :: k
      real(wp), intent(in) :: tolerance                    !! of balance [m]
      type(design_solver_t), intent(inout) :: solver
      logical, intent(out) :: is_done
      type(error_t), allocatable :: error

      call take_numbers(solver, is_done)
      if (.not. is_done) return
      call refresh_case(solver%raw, solver%design, solver%cases(k))
      call balance_once(tolerance, .true., solver, error)
      is_done = .not. allocated(error)
      if (is_done) call mount_again(solver%suspension, solver%cases(k)%case, solver%cases(k)%result%mounted_case_t)
   end subroutine mount_numbers

   !> Realises the suspension and the cases with the present numbers, unless this was done.
   subroutine take_numbers(solver, is_done)
      type(design_solver_t), intent(inout) :: solver
      logical, intent(out) :: is_done

      is_done = .true.
      if (solver%is_realised) return
      is_done = all_in_range(solver%design%parameters, solver%x)
      if (is_done) call realise(solver%design%plan, solver%x, solver%raw, is_done)
      if (is_done) call realise_cases(solver%design%plan, solver%x, solver%design%cases, is_done)
      solver%is_realised = is_done
   end subroutine take_numbers

   !> Makes the work space of a case that is solved for the first time.
   subroutine make_room(this)
      type(worker_case_t), intent(inout) :: this
      if (.not. allocated(this%result)) allocate (this%result)
      if (.not. allocated(this%observer)) allocate (this%observer)
   end subroutine make_room

   !> Mounts and solves a case of a design that was examined.
   subroutine solve_balanced(k, options, is_terse, solver, error)
      integer, intent(in) :: k
      type(solve_options_t), intent(in) :: options
      logical, intent(in) :: is_terse                      !! no texts
      type(design_solver_t), intent(inout) :: solver
      type(error_t), allocatable, intent(out) :: error

      call balance_once(solver%cases(k)%case%tolerance, is_terse, solver, error)
      if (allocated(error)) return
      associate (this => solver%cases(k))
         call make_room(this)
         call mount_again(solver%suspension, this%case, this%result%mounted_case_t)
         call solve_mounted(options, this%result, observer=this%observer)
      end associate
   end subroutine solve_balanced

   !> Balances the suspension, once for all cases of one tolerance.
   subroutine balance_once(tolerance, is_terse, solver, error)
      real(wp), intent(in) :: tolerance                    !! m
      logical, intent(in) :: is_terse                      !! no texts
      type(design_solver_t), intent(inout) :: solver
      type(error_t), allocatable, intent(out) :: error

      if (solver%is_balanced .and. abs(tolerance - solver%tolerance) <= 0.0_wp) return
      if (allocated(solver%suspension%bodies)) then
         call copy_numbers(solver%raw, solver%suspension)
      else
         solver%suspension = solver%raw
      end if
      call balance(solver%suspension, tolerance, error, is_terse, solver%space)
      solver%is_balanced = .not. allocated(error)
      solver%tolerance = tolerance
   end subroutine balance_once

   !> Examines the needed cases of the report at the present numbers and balances the suspension as the report does; with messages.
   subroutine settle_fully(is_needed, solver, is_solvable, defects, is_done, error)
      logical, intent(in) :: is_needed(:)                  !! in the order of the report
      type(design_solver_t), intent(inout) :: solver
      logical, intent(out) :: is_solvable(:)
      type(message_list_t), intent(out) :: defects         !! of the others, each once
      logical, intent(out) :: is_done                      !! .false.: the design must be read from the text
      type(error_t), allocatable, intent(out) :: error     !! exit_model: no case can be solved
      character(:), allocatable :: name
      integer :: j, k

      is_solvable = .true.
      name = ''
      call take_numbers(solver, is_done)
      if (.not. is_done) return
      do j = 1, size(is_needed)
         k = solver%report_order(j)
         call refresh_case(solver%raw, solver%design, solver%cases(k))
         if (.not. is_needed(j) .or. .not. is_mountable(solver%cases(k)%case)) cycle
         call examine_fully(k, solver, defects)
         is_solvable(j) = solver%is_sound(k)
         name = solver%cases(k)%case%name
      end do
      if (any(is_needed) .and. .not. any(is_solvable .and. is_needed)) then
         call fail_unsolvable(defects, error)
         if (count(is_needed) == 1) error%message = 'case '//quoted(name)//': '//error%message
      else
         call balance_once(default_tolerance, .false., solver, error)
      end if
   end subroutine settle_fully

   !> Examines a case, and adds its defects to the defects of other cases.
   subroutine examine_fully(k, solver, defects)
      integer, intent(in) :: k
      type(design_solver_t), intent(inout) :: solver
      type(message_list_t), intent(inout) :: defects
      type(diagnosis_t) :: diagnosis

      call examine_case(solver%raw, solver%cases(k)%case, diagnosis, solver%cases(k)%known)
      solver%is_sound(k) = diagnosis%is_solvable()
      if (.not. solver%is_sound(k)) call add_distinct(defects, diagnosis%words())
   end subroutine examine_fully

   pure subroutine fail_unsolvable(defects, error)
      type(message_list_t), intent(in) :: defects
      type(error_t), allocatable, intent(out) :: error
      call fail(error, exit_model, 'the model cannot be solved'//new_line('a')//defects%text())
   end subroutine fail_unsolvable

   !> Settles as settle_fully does, for cases that were solved before: no text is made. is_done is .false. if there is a doubt.
   subroutine settle_again(is_needed, solver, is_done)
      logical, intent(in) :: is_needed(:)                  !! in the order of the report
      type(design_solver_t), intent(inout) :: solver
      logical, intent(out) :: is_done
      type(error_t), allocatable :: error
      integer :: j, k

      call take_numbers(solver, is_done)
      do j = 1, size(is_needed)
         if (.not. is_done) return
         k = solver%report_order(j)
         if (.not. is_needed(j)) then
            call refresh_case(solver%raw, solver%design, solver%cases(k))
         else if (.not. solver%is_sound(k)) then
            call examine_design(solver%raw, solver%design, solver%cases(k), is_done)
            solver%is_sound(k) = is_done
         end if
      end do
      if (is_done) call balance_once(default_tolerance, .true., solver, error)
      is_done = is_done .and. .not. allocated(error)
   end subroutine settle_again

   !> Balances the model at the present numbers as the report does, if a case can be solved; with messages.
   subroutine settle_model(solver, is_balanced, is_done, error)
      type(design_solver_t), intent(inout) :: solver
      logical, intent(out) :: is_balanced
      logical, intent(out) :: is_done                      !! .false.: the design must be read from the text
      type(error_t), allocatable, intent(out) :: error     !! exit_model, exit_convergence: why no case can be solved
      type(message_list_t) :: defects
      integer :: k

      is_balanced = .false.
      call take_numbers(solver, is_done)
      if (.not. is_done) return
      do k = 1, merge(0, size(solver%cases), any(solver%is_sound))
         call refresh_case(solver%raw, solver%design, solver%cases(k))
         if (.not. is_mountable(solver%cases(k)%case)) cycle
         call examine_fully(k, solver, defects)
         if (solver%is_sound(k)) exit
      end do
      if (defects%count() > 0 .and. .not. any(solver%is_sound)) then
         call fail_unsolvable(defects, error)
         return
      end if
      call balance_once(default_tolerance, .false., solver, error)
      is_balanced = .not. allocated(error)
   end subroutine settle_model

   !> Lists the cases in the order of the report, with the present numbers.
   subroutine report_cases(solver, cases)
      type(design_solver_t), intent(in) :: solver
      type(case_t), allocatable, intent(out) :: cases(:)
      integer :: j

      allocate (cases(size(solver%report_order)))
      do j = 1, size(cases)
         cases(j) = solver%cases(solver%report_order(j))%case
      end do
   end subroutine report_cases

   !> Restricts the report to these of its cases, with their method and their increments.
   subroutine restrict_cases(chosen, solver)
      type(case_t), intent(in) :: chosen(:)
      type(design_solver_t), intent(inout) :: solver
      integer :: j, k

      solver%report_order = [(case_number(chosen(j)%name, solver), j=1, size(chosen))]
      do j = 1, size(chosen)
         k = solver%report_order(j)
         solver%cases(k)%case = chosen(j)
         if (allocated(solver%cases(k)%result)) call take_off(solver%cases(k)%result%mounted_case_t)
         if (solver%cases(k)%number > 0) solver%design%cases(solver%cases(k)%number) = chosen(j)
      end do
   end subroutine restrict_cases

   !> Lists all columns that the table of a case has.
   subroutine heads_of_case(k, solver, heads)
      integer, intent(in) :: k
      type(design_solver_t), intent(in) :: solver
      character(name_length), allocatable, intent(out) :: heads(:)
      type(suspension_t) :: suspension
      type(case_t) :: case

      if (is_mountable(solver%cases(k)%case)) then
         call mount(solver%raw, solver%cases(k)%case, suspension, case)
         call sweep_columns(suspension, case, heads)
      else
         call sweep_columns(solver%raw, solver%cases(k)%case, heads)
      end if
   end subroutine heads_of_case

   !> The number of a case; '' is the first. 0: there is none of this name.
   pure integer function case_number(name, solver) result(k)
      character(*), intent(in) :: name
      type(design_solver_t), intent(in) :: solver

      do k = 1, size(solver%cases)
         if (len_trim(name) == 0 .or. solver%cases(k)%case%name == name) return
      end do
      k = 0
   end function case_number

end module ek_design_solver
