!> A deck opened for a program that calls elastokin: derivatives of the last solution. Part of the Fortran interface (ek_api).
module ek_session_derivatives
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: quoted, str
   use ek_case_result, only: case_result_t
   use ek_response, only: no_column
   use ek_table, only: name_length
   use ek_direction, only: direction_t, find_directions, refuse_shared
   use ek_derivatives, only: derivatives_t, begin_derivatives, find_derivatives, refuse_case
   use ek_workspace, only: workspace_t
   use ek_workspace_cases, only: heads_of_case
   use ek_session, only: session_t, derived_t
   use ek_session_solution, only: find_row
   implicit none(type, external)
   private
   public :: find_slopes

contains

   !> Computes the derivatives of columns in one row of the last solution with respect to numbers of the deck, and estimates of
   !> their errors [unit of the column per unit of the number]. No solution is repeated (ek_derivatives). A derivative is NaN if the
   !> state did not converge, if the column has no value at the state, or if the number cannot be changed.
   subroutine find_slopes(session, row, columns, paths, slopes, errors, error)
      type(session_t), intent(inout), target :: session
      integer, intent(in) :: row                               !! row of the table of the last solution
      character(*), intent(in) :: columns(:)  !! columns of the case (requested or not), or of its compliance matrix
      character(*), intent(in) :: paths(:)                     !! as in set_number, each of one number, or of both sides of an axle
      real(wp), intent(out) :: slopes(:, :), errors(:, :)      !! (column, path)
      type(error_t), allocatable, intent(out) :: error         !! exit_usage: wrong row, column or path; no derivatives of the case
      type(case_result_t), pointer :: result
      integer :: state
      logical :: is_ready

      slopes = ieee_value(1.0_wp, ieee_quiet_nan)
      errors = ieee_value(1.0_wp, ieee_quiet_nan)
      if (any([shape(slopes), shape(errors)] < [size(columns), size(paths), size(columns), size(paths)])) then
         call fail(error, exit_usage, 'expected arrays of '//str(size(columns))//' x '//str(size(paths))// &
            ' numbers (columns x paths)')
         return
      end if
      call find_row(session, row, result, state, error)
      if (allocated(error)) return
      is_ready = is_prepared(session, columns, paths)
      if (.not. is_ready) then
         !$omp critical (ek_words)
         call prepare(session, columns, paths, error)
         !$omp end critical (ek_words)
         if (allocated(error)) return
      end if
      if (allocated(session%other)) then
         call find(session%other, session%derived)
      else
         call find(session%workspace, session%derived)
      end if

   contains

      !> Computes the derivatives at the row, and orders them by column and path.
      subroutine find(workspace, derived)
         class(workspace_t), intent(inout) :: workspace
         class(derived_t), intent(inout) :: derived
         integer :: c, p

         call find_derivatives(workspace, [state], derived%derivatives)
         do p = 1, size(paths)
            do c = 1, size(columns)
               slopes(c, p) = derived%derivatives%slopes(derived%column(c), derived%direction(p), 1)
               errors(c, p) = derived%derivatives%errors(derived%column(c), derived%direction(p), 1)
            end do
         end do
      end subroutine find

   end subroutine find_slopes

   !> Whether the last request had the same columns, paths, case and workspace.
   pure logical function is_prepared(session, columns, paths)
      type(session_t), intent(in) :: session
      character(*), intent(in) :: columns(:), paths(:)

      is_prepared = .false.
      if (.not. allocated(session%derived) .or. allocated(session%other)) return
      associate (derived => session%derived)
         if (derived%derivatives%case /= session%solved .or. size(columns) /= size(derived%columns)) return
         if (size(paths) /= size(derived%paths)) return
         is_prepared = all(columns == derived%columns) .and. all(paths == derived%paths)
      end associate
   end function is_prepared

   !> Prepares directions, columns and work space. Creates strings.
   subroutine prepare(session, columns, paths, error)
      type(session_t), intent(inout), target :: session
      character(*), intent(in) :: columns(:), paths(:)
      type(error_t), allocatable, intent(out) :: error
      type(direction_t), allocatable :: directions(:)
      type(message_list_t) :: mistakes
      class(workspace_t), pointer :: workspace
      character(name_length), allocatable :: heads(:)
      integer :: c

      workspace => session%workspace
      if (allocated(session%other)) workspace => session%other
      call refuse_case(workspace%cases(session%solved)%case, error)
      if (allocated(error)) return
      if (.not. allocated(session%derived)) allocate (session%derived)
      associate (derived => session%derived)
         call place_paths(workspace, session, paths, directions, derived%direction, mistakes)
         if (mistakes%count() == 0) call begin_derivatives(workspace, session%solved, columns, directions, derived%derivatives)
         derived%column = spread(0, 1, size(columns))
         do c = 1, size(columns)
            if (mistakes%count() > 0) exit
            derived%column(c) = findloc(derived%derivatives%columns == columns(c), .true., dim=1)
         end do
         if (mistakes%count() == 0 .and. any(derived%column == 0)) then
            call heads_of_case(session%solved, workspace, heads)
            do c = 1, size(columns)
               if (derived%column(c) > 0) cycle
               if (any(heads == columns(c))) then
                  call mistakes%add(quoted(trim(columns(c)))//' describes the solution and has no derivative')
               else
                  call mistakes%add(no_column(trim(columns(c)), heads))
               end if
            end do
         end if
         derived%columns = columns
         derived%paths = paths
      end associate
      if (mistakes%count() == 0) return
      call fail(error, exit_usage, mistakes%text())
      session%derived%derivatives%case = 0        ! kept as room; is_prepared knows that it is no answer
   end subroutine prepare

   !> Finds the direction of each path. A path that leads to more or fewer than one direction is an error.
   subroutine place_paths(workspace, session, paths, directions, place, mistakes)
      class(workspace_t), intent(in) :: workspace
      type(session_t), intent(in) :: session
      character(*), intent(in) :: paths(:)
      type(direction_t), allocatable, intent(out) :: directions(:)
      integer, allocatable, intent(out) :: place(:)            !! index of the direction of each path
      type(message_list_t), intent(inout) :: mistakes
      type(direction_t), allocatable :: these(:)
      type(message_list_t) :: one
      type(error_t), allocatable :: error
      integer :: p

      allocate (directions(0))
      allocate (place(size(paths)), source=0)
      do p = 1, size(paths)
         one = message_list_t()
         call one%add(trim(paths(p)))
         call find_directions(workspace%design, session%deck, one, these, error)
         if (allocated(error)) then
            call mistakes%add(error%message)
         else if (size(these) /= 1) then
            call mistakes%add(quoted(trim(paths(p)))//' leads to '//str(size(these))//' numbers; expected a path of one, or of '// &
               'both sides of an axle')
         else
            directions = [directions, these(1)]
            place(p) = size(directions)
         end if
      end do
      if (mistakes%count() > 0) return
      call refuse_shared(workspace%design, directions, error)
      if (allocated(error)) call mistakes%add(error%message)
   end subroutine place_paths

end module ek_session_derivatives
