!> Opens a workspace: reads the numbers of a deck and the cases to be solved.
module ek_workspace_cases
   use ek_error, only: error_t, fail, exit_deck, exit_model, exit_file
   use ek_text, only: quoted, did_you_mean
   use ek_group, only: word_length
   use ek_deck, only: deck_t
   use ek_reader, only: definition_t, build_design
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable, prefer_plan
   use ek_diagnosis, only: diagnosis_t
   use ek_rig, only: mount, take_off
   use ek_standard_tests, only: standard_tests
   use ek_examination, only: examine_case, check_inputs
   use ek_sweep_table, only: sweep_columns
   use ek_table, only: name_length
   use ek_case_work, only: case_work_t, make_room, examined
   use ek_workspace, only: workspace_t, give_definition, balance_or_explain, numbers_given
   implicit none(type, external)
   private
   public :: open_model, open_workspace, open_cases, report_cases, restrict_cases, heads_of_case, case_number

contains

   !> Reads a deck without listing its cases, for a command that chooses its cases.
   subroutine open_model(deck, definition, workspace, error, needs_tables)
      type(deck_t), intent(in) :: deck
      type(definition_t), target, intent(inout) :: definition !! replaced; must outlive the workspace and its copies
      type(workspace_t), intent(inout) :: workspace          !! workspace, whose former content is deleted
      type(error_t), allocatable, intent(out) :: error       !! exit_deck, exit_file: all errors together
      logical, intent(in), optional :: needs_tables          !! if .true., a missing table is an error, also of a case not run

      call empty_workspace(workspace)
      call read_checked(deck, definition, workspace%raw, error, needs_tables)
      allocate (workspace%cases(0))
      if (.not. allocated(error)) call give_definition(definition, workspace)
   end subroutine open_model

   !> Reads a deck and collects all its errors, including errors in the tables and targets of its cases.
   subroutine read_checked(deck, definition, suspension, error, needs_tables)
      type(deck_t), intent(in) :: deck
      type(definition_t), intent(out) :: definition
      type(suspension_t), intent(out) :: suspension
      type(error_t), allocatable, intent(out) :: error
      logical, intent(in), optional :: needs_tables          !! if .true., a missing table is an error, also of a case not run
      type(error_t), allocatable :: fault
      logical :: is_whole, needs_all

      needs_all = .false.
      if (present(needs_tables)) needs_all = needs_tables
      call build_design(deck, definition, suspension, error, is_whole)
      call check_inputs(suspension, definition%cases, fault, is_whole)
      if (.not. allocated(fault)) return
      if (allocated(error)) then
         error%message = error%message//new_line('a')//fault%message
      else if (fault%code /= exit_file .or. needs_all) then
         ! a missing file is reported by the case that needs it: the other cases can be run
         call move_alloc(fault, error)
      end if
   end subroutine read_checked

   !> Reads a deck and lists its cases, then the standard tests that the deck does not define. Reports all errors together.
   subroutine open_workspace(deck, definition, workspace, error)
      type(deck_t), intent(in) :: deck
      type(definition_t), target, intent(inout) :: definition !! replaced; must outlive the workspace and its copies
      type(workspace_t), intent(inout) :: workspace          !! workspace, whose former content is deleted
      type(error_t), allocatable, intent(out) :: error       !! exit_deck
      type(case_t), allocatable :: tests(:), all(:)         ! of the report; with those on request
      integer :: own, k

      call open_model(deck, definition, workspace, error)
      if (allocated(error)) return
      deallocate (workspace%cases)
      call prefer_plan(workspace%deck_cases)
      workspace%deck_cases%has_all = .true.
      allocate (tests(0), all(0))
      if (size(workspace%raw%wheels) > 0) call standard_tests(workspace%raw, workspace%deck_cases, tests)
      if (size(workspace%raw%wheels) > 0) call standard_tests(workspace%raw, workspace%deck_cases, all, '*')
      own = size(workspace%deck_cases)
      allocate (workspace%cases(own + count([(is_standard(all(k)), k=1, size(all))])))
      do k = 1, own
         workspace%cases(k)%number = k
         workspace%cases(k)%case = workspace%deck_cases(k)
      end do
      do k = 1, size(all)
         if (.not. is_standard(all(k))) cycle
         own = own + 1
         workspace%cases(own)%case = all(k)
         call prefer_plan(workspace%cases(own)%case)
      end do
      workspace%report_order = [(case_number(tests(k)%name, workspace), k=1, size(tests))]

   contains

      !> Whether a test is a standard test that is not a case of the deck.
      pure logical function is_standard(test)
         type(case_t), intent(in) :: test
         integer :: j
         is_standard = .not. any([(workspace%deck_cases(j)%name == test%name, j=1, size(workspace%deck_cases))])
      end function is_standard

   end subroutine open_workspace

   !> Reads a deck for selected cases ('': the first case of the deck). Examines the deck on the rig of each case, and balances the
   !> model with the tolerance of the first case. Errors in other cases are ignored.
   subroutine open_cases(deck, names, definition, workspace, error, increments)
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: names(:)
      type(definition_t), target, intent(inout) :: definition !! replaced; must outlive the workspace and its copies
      type(workspace_t), intent(inout) :: workspace          !! workspace, whose former content is deleted
      type(error_t), allocatable, intent(out) :: error     !! exit_deck, exit_file, exit_model, exit_convergence
      integer, intent(in), optional :: increments !! number of increments of all cases; absent or 0: the increments of the deck
      type(diagnosis_t) :: diagnosis
      logical :: is_whole
      integer :: k

      call empty_workspace(workspace)
      call build_design(deck, definition, workspace%raw, error, is_whole)
      if (allocated(error)) return
      call give_definition(definition, workspace)
      call prefer_plan(workspace%deck_cases)
      allocate (workspace%cases(size(names)))
      do k = 1, size(names)
         call take_case(deck%file, trim(names(k)), workspace%deck_cases, workspace%raw, workspace%cases(k), error)
         if (allocated(error)) return
      end do
      if (present(increments)) then
         if (increments > 0) then
            workspace%deck_cases%increments = increments
            workspace%cases%case%increments = increments              ! also of a standard test
         end if
      end if
      do k = 1, size(workspace%cases)
         associate (this => workspace%cases(k))
            ! on the rig from now on: the order of elimination of all designs is that of this one
            call examine_case(workspace%raw, this%case, diagnosis, this%known, this%result%mounted_case_t)
            if (.not. diagnosis%is_solvable()) then
               call fail(error, exit_model, deck%file//': the model cannot be solved'//new_line('a')//diagnosis%words())
               return
            end if
            this%stage = examined
         end associate
      end do
      call balance_or_explain(workspace%cases(1)%case%tolerance, workspace, error)
   end subroutine open_cases

   !> Empties a workspace. This procedure exists because gfortran writes out the deallocation of a workspace at each call.
   subroutine empty_workspace(workspace)
      type(workspace_t), intent(out) :: workspace
      workspace%stage = numbers_given
   end subroutine empty_workspace

   !> Finds a case of the deck, or a standard test that the deck does not define. A case with follow = 'arc' is an error.
   subroutine take_case(file, name, cases, suspension, found, error)
      character(*), intent(in) :: file, name           !! name: '' for the first case of the deck
      type(case_t), intent(in) :: cases(:)
      type(suspension_t), intent(in) :: suspension
      type(case_work_t), intent(inout) :: found
      type(error_t), allocatable, intent(out) :: error
      type(case_t), allocatable :: tests(:)
      character(word_length), allocatable :: names(:)      !! names of all cases and tests that could be meant
      integer :: k, j

      call make_room(found)
      do k = 1, size(cases)
         if (len(name) == 0 .or. cases(k)%name == name) exit
      end do
      if (k > size(cases)) then
         call standard_tests(suspension, cases, tests)
         do j = 1, size(tests)
            if (len(name) > 0 .and. tests(j)%name == name) exit
         end do
         if (j > size(tests)) then
            allocate (names(size(tests)))
            do j = 1, size(tests)
               names(j) = tests(j)%name
            end do
            call fail(error, exit_deck, file//': there is no case '//quoted(name)//did_you_mean(name, names))
            return
         end if
         found%case = tests(j)
         call prefer_plan(found%case)
         return
      end if
      if (cases(k)%follows_arc) then
         call fail(error, exit_deck, file//': case '//quoted(cases(k)%name)//' has follow = ''arc'', where a factor '// &
            'may have several states; a study needs a case with follow = ''factor''')
         return
      end if
      call check_inputs(suspension, cases(k:k), error)
      if (allocated(error)) return
      found%number = k
      found%case = cases(k)
   end subroutine take_case

   !> Lists the cases of the report, in the order of the report, with the present numbers.
   subroutine report_cases(workspace, cases)
      type(workspace_t), intent(in) :: workspace
      type(case_t), allocatable, intent(out) :: cases(:)
      integer :: j

      allocate (cases(size(workspace%report_order)))
      do j = 1, size(cases)
         cases(j) = workspace%cases(workspace%report_order(j))%case
      end do
   end subroutine report_cases

   !> Restricts the report to the chosen cases, which replace the cases of the workspace with the same names.
   subroutine restrict_cases(chosen, workspace)
      type(case_t), intent(in) :: chosen(:)
      type(workspace_t), intent(inout) :: workspace
      integer :: j, k

      workspace%report_order = [(case_number(chosen(j)%name, workspace), j=1, size(chosen))]
      do j = 1, size(chosen)
         k = workspace%report_order(j)
         associate (this => workspace%cases(k))
            this%case = chosen(j)
            this%stage = min(this%stage, examined)
            if (allocated(this%result)) call take_off(this%result%mounted_case_t)
            if (this%number > 0) workspace%deck_cases(this%number) = chosen(j)
         end associate
      end do
   end subroutine restrict_cases

   !> Lists the headings of all columns of the table of a case.
   subroutine heads_of_case(k, workspace, heads)
      integer, intent(in) :: k
      type(workspace_t), intent(in) :: workspace
      character(name_length), allocatable, intent(out) :: heads(:)
      type(suspension_t) :: suspension
      type(case_t) :: case

      associate (given => workspace%cases(k)%case)
         if (is_mountable(given)) then
            call mount(workspace%raw, given, suspension, case)
            call sweep_columns(suspension, case, heads)
         else
            call sweep_columns(workspace%raw, given, heads)
         end if
      end associate
   end subroutine heads_of_case

   !> Index of the case with a name; 0 if no case has the name. The index is 1 for ''.
   pure integer function case_number(name, workspace) result(k)
      character(*), intent(in) :: name
      type(workspace_t), intent(in) :: workspace

      do k = 1, size(workspace%cases)
         if (len_trim(name) == 0 .or. workspace%cases(k)%case%name == name) return
      end do
      k = 0
   end function case_number

end module ek_workspace_cases
