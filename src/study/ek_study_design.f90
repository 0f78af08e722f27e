!> Solves one design of a study: the factors become a model, and the cases of the study are solved. Their tables become a row of
!> responses and the rows of the curves.
!>
!> solve_designs computes numbers only. After the last design of a chunk, complete_design completes the designs that failed or must
!> be read from the deck's strings. complete_design creates strings and is called by one thread at a time: gfortran stores the
!> length of a string that a function returns in one location for all threads.
module ek_study_design
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, exit_deck, exit_file
   use ek_text, only: quoted, replace
   use ek_deck, only: deck_t, set_value
   use ek_reader, only: definition_t
   use ek_case, only: copy_places
   use ek_case_result, only: case_result_t, solve_case, solve_mounted, add_remarks, solved
   use ek_table, only: table_t, column_index, scheduled_rows
   use ek_study, only: study_t, not_given, by_scale
   use ek_response_value, only: read_response, is_difference
   use ek_read_states, only: observe_read_states
   use ek_study_pack, only: walk_case, lanes
   use ek_workspace, only: workspace_t
   use ek_workspace_cases, only: open_cases
   use ek_factor_numbers, only: change_design
   use ek_factor_paths, only: setting_of, shortest
   use ek_chunk, only: chunk_t, add_reason, put_error, design_solved, design_incomplete, design_unsolvable, design_invalid
   use ek_designer, only: designer_t
   use ek_design_cause, only: cause_t, causes_t, add_cause, add_unread, find_cause, cause_text
   implicit none(type, external)
   private
   public :: solve_designs, complete_design

contains

   !> Solves designs `first` … `last` of a chunk (at most `lanes`) with the factors in the chunk, and fills the rows of the designs.
   !> Adds the cause of each design that must be completed.
   subroutine solve_designs(study, designer, first, last, chunk, causes)
      type(study_t), intent(in) :: study
      type(designer_t), intent(inout) :: designer
      integer, intent(in) :: first, last
      type(chunk_t), intent(inout) :: chunk
      type(causes_t), intent(inout) :: causes !! causes of the designs to be completed by complete_design; emptied if first = 1
      logical :: is_done(lanes), is_walked(lanes, size(designer%options))
      integer :: k, l, c

      if (first == 1) causes%used = 0
      is_done = .false.
      do k = first, last
         l = k - first + 1
         if (l == 1) then
            call change_design(designer%paths, chunk%factors(:, k), designer%workspace, is_done(l))
         else
            call change_design(designer%paths, chunk%factors(:, k), designer%packs%workspaces(l - 1), is_done(l))
         end if
      end do
      is_walked = .false.
      do c = 1, size(designer%options)
         if (any(is_done)) call walk_case(c, designer%workspace, is_done, designer%packs, is_walked(:, c))
      end do
      do k = first, last
         l = k - first + 1
         if (.not. is_done(l)) then
            chunk%responses(:, k) = not_given()
            call add_unread(k, causes)
         else if (l == 1) then
            call finish_design(study, designer, is_walked(l, :), k, designer%workspace, chunk, causes)
         else
            call finish_design(study, designer, is_walked(l, :), k, designer%packs%workspaces(l - 1), chunk, causes)
         end if
      end do
   end subroutine solve_designs

   !> Completes a failed design after the last design of its chunk: reads the design from the deck's strings, or explains its
   !> failure.
   subroutine complete_design(study, deck, designer, cause, chunk)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(designer_t), intent(in) :: designer
      type(cause_t), intent(in) :: cause
      type(chunk_t), intent(inout) :: chunk

      if (cause%is_unread) then
         call solve_from_text(study, deck, designer, cause%design, chunk)
      else
         call add_reason(chunk, cause%design, cause_text(cause, designer%case_of, designer%readings, designer%workspace))
      end if
   end subroutine complete_design

   !> Solves the cases of a design that were not solved in a pack, and fills the row of the design. Adds the cause if the design
   !> failed.
   subroutine finish_design(study, designer, is_walked, k, workspace, chunk, causes)
      type(study_t), intent(in) :: study
      type(designer_t), intent(in) :: designer
      logical, intent(in) :: is_walked(:)         !! whether packs have solved each case
      integer, intent(in) :: k
      type(workspace_t), intent(inout) :: workspace     !! workspace with the numbers of the design; its cases are on the rig
      type(chunk_t), intent(inout) :: chunk
      type(causes_t), intent(inout) :: causes
      type(cause_t) :: cause
      integer :: faults(size(designer%readings)), c

      chunk%responses(:, k) = not_given()
      do c = 1, size(workspace%cases)
         associate (this => workspace%cases(c))
            call solve_mounted(designer%options(c), this%result, observer=this%observer, is_walked=is_walked(c))
         end associate
      end do
      if (any([(.not. workspace%cases(c)%result%is_run(), c=1, size(workspace%cases))])) then
         call add_unread(k, causes)               ! too little memory, perhaps not any more
         return
      end if
      call complete_tables(designer, workspace)
      call take_row(study, designer, workspace, k, chunk, faults)
      if (chunk%status(k) == design_solved) return
      call find_cause(k, designer%case_of, faults, workspace, cause)
      call add_cause(cause, causes)
   end subroutine finish_design

   !> Reads a design from the deck with its factors as settings, and solves the design in a separate workspace.
   subroutine solve_from_text(study, deck, designer, k, chunk)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(designer_t), intent(in) :: designer
      integer, intent(in) :: k
      type(chunk_t), intent(inout) :: chunk
      type(deck_t) :: changed
      class(workspace_t), allocatable :: workspace
      type(definition_t), target :: definition
      type(error_t), allocatable :: error
      type(cause_t) :: cause
      integer :: faults(size(designer%readings)), f, j, case

      allocate (workspace)
      changed = deck
      do f = 1, size(study%factors)
         do j = 1, size(designer%paths(f)%settings)
            associate (setting => designer%paths(f)%settings(j))
               if (.not. allocated(error)) call set_value(changed, setting%path, value_of(f, setting%sign), error)
            end associate
         end do
      end do
      if (.not. allocated(error)) call open_cases(changed, designer%case_names, definition, workspace, error, designer%increments)
      if (allocated(error)) then
         if (error%code == exit_file) call put_error(chunk, error)
         chunk%status(k) = merge(design_invalid, design_unsolvable, error%code == exit_deck)
         do f = 1, size(study%factors)          ! a number of the study, not of the command line
            associate (factor => study%factors(f), settings => designer%paths(f)%settings)
               do j = 1, size(settings)
                  call replace(error%message, '--set '//settings(j)%path//'='//value_of(f, settings(j)%sign), &
                     factor%where//': factor '//quoted(factor%name)//' = '//shortest(chunk%factors(f, k)))
               end do
            end associate
         end do
         call add_reason(chunk, k, error%message)
         return
      end if
      do case = 1, size(workspace%cases)
         associate (this => workspace%cases(case))
            call copy_places(designer%workspace%cases(case)%case, this%case)
            call solve_case(workspace%suspension, this%case, designer%options(case), this%result, observer=this%observer)
            if (.not. this%result%is_run()) call add_remarks(designer%options(case), this%result)
         end associate
      end do
      call complete_tables(designer, workspace)
      call take_row(study, designer, workspace, k, chunk, faults)
      if (chunk%status(k) == design_solved) return
      call find_cause(k, designer%case_of, faults, workspace, cause)
      if (allocated(cause%error%message) .and. cause%error%code == exit_file) call put_error(chunk, cause%error)
      call add_reason(chunk, k, cause_text(cause, designer%case_of, designer%readings, workspace))

   contains

      !> The value of factor f in this design as a setting; a factor that multiplies has no sign.
      function value_of(f, sign) result(text)
         integer, intent(in) :: f
         real(wp), intent(in) :: sign
         character(:), allocatable :: text

         text = setting_of(study%factors(f)%change, merge(1.0_wp, sign, study%factors(f)%change == by_scale)*chunk%factors(f, k))
      end function value_of

   end subroutine solve_from_text

   !> Computes the K&C quantities that solve_case omitted (defers_kandc), at the states from which a response is read.
   subroutine complete_tables(designer, workspace)
      type(designer_t), intent(in) :: designer
      type(workspace_t), intent(inout) :: workspace     !! workspace with solved cases
      integer :: c

      do c = 1, size(workspace%cases)
         if (.not. (designer%options(c)%defers_kandc .and. is_whole(workspace%cases(c)%result))) cycle
         call observe_read_states(designer%readings, designer%case_of, c, designer%options(c), workspace%cases(c)%observer, &
            workspace%cases(c)%result)
      end do
   end subroutine complete_tables

   !> Reads the responses and the curves of a design, and marks an incomplete design. A response of a case that did not reach all
   !> states has no value.
   subroutine take_row(study, designer, workspace, k, chunk, faults)
      type(study_t), intent(in) :: study
      type(designer_t), intent(in) :: designer
      type(workspace_t), intent(in) :: workspace        !! workspace with the results of its cases
      integer, intent(in) :: k
      type(chunk_t), intent(inout) :: chunk
      integer, intent(out) :: faults(:)           !! reason code of each response, see read_response
      integer :: j

      do j = 1, size(workspace%cases)
         if (.not. is_whole(workspace%cases(j)%result)) chunk%status(k) = design_incomplete
      end do
      faults = 0
      do j = 1, size(designer%readings)
         associate (result => workspace%cases(designer%case_of(j))%result, less => designer%readings(j)%asked%less)
            if (is_difference(designer%readings(j))) then
               chunk%responses(j, k) = chunk%responses(less(1), k) - chunk%responses(less(2), k)
            else if (is_whole(result)) then
               call read_response(designer%readings(j), result%table, chunk%responses(j, k), faults(j))
            end if
            if (.not. ieee_is_finite(chunk%responses(j, k))) chunk%status(k) = design_incomplete
         end associate
      end do
      if (workspace%cases(1)%result%is_run()) call take_curves(study, workspace%cases(1)%result%table, k, chunk)
   end subroutine take_row

   !> Whether all states of a case converged.
   pure logical function is_whole(result)
      type(case_result_t), intent(in) :: result

      is_whole = result%outcome == solved
   end function is_whole

   !> Inserts the states of a design after the states of the previous designs. Columns that the model of the design does not define
   !> are NaN.
   pure subroutine take_curves(study, table, k, chunk)
      type(study_t), intent(in) :: study
      type(table_t), intent(in) :: table
      integer, intent(in) :: k
      type(chunk_t), intent(inout) :: chunk
      real(wp), allocatable :: more(:, :)
      logical :: is_next, is_scheduled(size(table%values, 2))
      integer :: place, j, rows, before

      if (size(study%columns) == 0) return
      is_scheduled = scheduled_rows(table)
      rows = count(is_scheduled)
      if (chunk%rows + rows > size(chunk%curves, 2)) then
         allocate (more(size(chunk%curves, 1), 2*(chunk%rows + rows)))
         more(:, :chunk%rows) = chunk%curves(:, :chunk%rows)
         call move_alloc(more, chunk%curves)
      end if
      before = sum(chunk%states(:k - 1))
      do j = chunk%rows, before + 1, -1
         chunk%curves(:, j + rows) = chunk%curves(:, j)
      end do
      associate (curves => chunk%curves(:, before + 1:before + rows))
         curves(1, :) = pack(table%values(2, :), is_scheduled)
         place = 2
         do j = 1, size(study%columns)
            is_next = place < size(table%columns)
            if (is_next) is_next = table%columns(place + 1) == study%columns(j)       ! many columns stand in their order
            place = merge(place + 1, 0, is_next)
            if (.not. is_next) place = column_index(table, study%columns(j))
            if (place > 0) curves(1 + j, :) = pack(table%values(place, :), is_scheduled)
            if (place == 0) curves(1 + j, :) = not_given()
         end do
      end associate
      chunk%states(k) = rows
      chunk%rows = chunk%rows + rows
   end subroutine take_curves

end module ek_study_design
