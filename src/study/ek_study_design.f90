!> Solves one design of a study: the factors become a model, its cases are solved, and the observations become a row of responses
!> and the rows of the curves.
!>
!> A design computes numbers only. A message (of a design that fails, or of a design that must be read from text) is
!> made by one thread at a time: gfortran stores the length of a text that a function returns in one location for all threads.
module ek_study_design
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, exit_deck, exit_file
   use ek_text, only: str, quoted, replace
   use ek_deck, only: deck_t, set_value
   use ek_case_result, only: case_result_t, solve_case, solve_mounted, failure_of
   use ek_table, only: table_t, column_index
   use ek_study, only: study_t, not_given
   use ek_response, only: fault_text
   use ek_response_value, only: read_response, is_difference
   use ek_read_states, only: observe_read_states
   use ek_study_pack, only: walk_case, lanes
   use ek_workspace, only: workspace_t
   use ek_workspace_cases, only: open_cases
   use ek_factor_numbers, only: change_design
   use ek_factor_paths, only: setting_of, shortest
   use ek_chunk, only: chunk_t, add_reason, put_error, design_solved, design_incomplete, design_unsolvable, design_invalid
   use ek_designer, only: designer_t
   implicit none(type, external)
   private
   public :: solve_designs

contains

   !> Solves some designs of a chunk, at most `lanes`, whose factors the chunk has, and fills their rows.
   subroutine solve_designs(study, deck, designer, first, last, chunk)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(designer_t), intent(inout) :: designer
      integer, intent(in) :: first, last
      type(chunk_t), intent(inout) :: chunk
      logical :: is_done(lanes), is_walked(lanes, size(designer%options))
      integer :: k, l, c

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
            !$omp critical (ek_words)
            call solve_from_text(study, deck, designer, k, chunk)
            !$omp end critical (ek_words)
         else if (l == 1) then
            call finish_design(study, designer, is_walked(l, :), k, designer%workspace, chunk)
         else
            call finish_design(study, designer, is_walked(l, :), k, designer%packs%workspaces(l - 1), chunk)
         end if
      end do
   end subroutine solve_designs

   !> Solves the cases of a design whose paths were not walked in a pack, and fills its row.
   subroutine finish_design(study, designer, is_walked, k, workspace, chunk)
      type(study_t), intent(in) :: study
      type(designer_t), intent(in) :: designer
      logical, intent(in) :: is_walked(:)         !! of each case
      integer, intent(in) :: k
      type(workspace_t), intent(inout) :: workspace     !! with the numbers of the design
      type(chunk_t), intent(inout) :: chunk
      integer :: faults(size(designer%readings)), c

      chunk%responses(:, k) = not_given()
      do c = 1, size(workspace%cases)
         associate (this => workspace%cases(c))
            call solve_mounted(designer%options(c), this%result, observer=this%observer, is_walked=is_walked(c))
         end associate
      end do
      call complete_tables(designer, workspace)
      call take_row(study, designer, workspace, k, chunk, faults)
      if (chunk%status(k) == design_solved) return
      !$omp critical (ek_words)
      call explain(designer, workspace, k, faults, chunk)
      !$omp end critical (ek_words)
   end subroutine finish_design

   !> Solves a design that is read from the deck with its factors as settings, with a workspace of its own.
   subroutine solve_from_text(study, deck, designer, k, chunk)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(designer_t), intent(in) :: designer
      integer, intent(in) :: k
      type(chunk_t), intent(inout) :: chunk
      type(deck_t) :: changed
      type(workspace_t) :: workspace
      type(error_t), allocatable :: error
      integer :: faults(size(designer%readings)), f, j, case

      changed = deck
      do f = 1, size(study%factors)
         do j = 1, size(study%factors(f)%paths)
            if (.not. allocated(error)) call set_value(changed, trim(study%factors(f)%paths(j)), &
               setting_of(study%factors(f)%change, chunk%factors(f, k)), error)
         end do
      end do
      if (.not. allocated(error)) call open_cases(changed, designer%case_names, workspace, error, designer%increments)
      if (allocated(error)) then
         if (error%code == exit_file) call put_error(chunk, error)
         chunk%status(k) = merge(design_invalid, design_unsolvable, error%code == exit_deck)
         do f = 1, size(study%factors)          ! a number of the study, not of the command line
            associate (factor => study%factors(f))
               do j = 1, size(factor%paths)
                  call replace(error%message, '--set '//trim(factor%paths(j))//'='// &
                     setting_of(factor%change, chunk%factors(f, k)), &
                     factor%where//': factor '//quoted(factor%name)//' = '//shortest(chunk%factors(f, k)))
               end do
            end associate
         end do
         call add_reason(chunk, k, error%message)
         return
      end if
      do case = 1, size(workspace%cases)
         associate (this => workspace%cases(case))
            call solve_case(workspace%suspension, this%case, designer%options(case), this%result, observer=this%observer)
         end associate
      end do
      call complete_tables(designer, workspace)
      call take_row(study, designer, workspace, k, chunk, faults)
      if (chunk%status(k) /= design_solved) call explain(designer, workspace, k, faults, chunk)
   end subroutine solve_from_text

   !> Observes the K&C quantities, which solving does not compute, at the states where a response reads them.
   subroutine complete_tables(designer, workspace)
      type(designer_t), intent(in) :: designer
      type(workspace_t), intent(inout) :: workspace     !! its cases are solved
      integer :: c

      do c = 1, size(workspace%cases)
         if (.not. (designer%options(c)%defers_kandc .and. is_whole(workspace%cases(c)%result))) cycle
         call observe_read_states(designer%readings, designer%case_of, c, workspace%cases(c)%observer, workspace%cases(c)%result)
      end do
   end subroutine complete_tables

   !> Reads the responses and the curves of a design. A response of a case that did not reach all states has no value.
   subroutine take_row(study, designer, workspace, k, chunk, faults)
      type(study_t), intent(in) :: study
      type(designer_t), intent(in) :: designer
      type(workspace_t), intent(in) :: workspace        !! with the results of its cases
      integer, intent(in) :: k
      type(chunk_t), intent(inout) :: chunk
      integer, intent(out) :: faults(:)           !! of each response, see read_response
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

      is_whole = result%is_run()
      if (is_whole) is_whole = all(result%path%failure%state == 0)
   end function is_whole

   !> Appends the states of a design; columns that its model does not define are nan.
   pure subroutine take_curves(study, table, k, chunk)
      type(study_t), intent(in) :: study
      type(table_t), intent(in) :: table
      integer, intent(in) :: k
      type(chunk_t), intent(inout) :: chunk
      real(wp), allocatable :: more(:, :)
      logical :: is_next
      integer :: place, j, rows

      if (size(study%columns) == 0) return
      rows = size(table%values, 2)
      if (chunk%rows + rows > size(chunk%curves, 2)) then
         allocate (more(size(chunk%curves, 1), 2*(chunk%rows + rows)))
         more(:, :chunk%rows) = chunk%curves(:, :chunk%rows)
         call move_alloc(more, chunk%curves)
      end if
      associate (curves => chunk%curves(:, chunk%rows + 1:chunk%rows + rows))
         curves(1, :) = table%values(2, :)
         place = 2
         do j = 1, size(study%columns)
            is_next = place < size(table%columns)
            if (is_next) is_next = table%columns(place + 1) == study%columns(j)       ! many columns stand in their order
            place = merge(place + 1, 0, is_next)
            if (.not. is_next) place = column_index(table, study%columns(j))
            if (place > 0) curves(1 + j, :) = table%values(place, :)
            if (place == 0) curves(1 + j, :) = not_given()
         end do
      end associate
      chunk%states(k) = rows
      chunk%rows = chunk%rows + rows
   end subroutine take_curves

   !> Explains why a design is incomplete.
   subroutine explain(designer, workspace, k, faults, chunk)
      type(designer_t), intent(in) :: designer
      type(workspace_t), intent(in) :: workspace        !! with the results of its cases
      integer, intent(in) :: k, faults(:)
      type(chunk_t), intent(inout) :: chunk
      type(message_list_t) :: words
      type(error_t), allocatable :: error
      integer :: j, side

      do j = 1, size(workspace%cases)
         associate (result => workspace%cases(j)%result, path => workspace%cases(j)%result%path)
            if (.not. result%is_run()) then
               call failure_of(result, error)
               call words%add(error%message)
               if (error%code == exit_file) call put_error(chunk, error)
               cycle
            end if
            do side = 1, 2
               if (path%failure(side)%state > 0) call words%add('case '//quoted(result%case%name)// &
                  ': no equilibrium at factor '//str(path%value(path%failure(side)%state)/result%case%unit))
            end do
         end associate
      end do
      do j = 1, size(faults)
         if (faults(j) /= 0) call words%add('response '//quoted(designer%readings(j)%asked%name)//': '// &
            fault_text(designer%readings(j), workspace%cases(designer%case_of(j))%result%table, faults(j)))
      end do
      if (words%count() == 0) call words%add('a response has no value')
      call add_reason(chunk, k, words%text())
   end subroutine explain

end module ek_study_design
