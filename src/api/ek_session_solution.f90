!> A deck opened for a program that calls elastokin: the solution of a case, its derivatives, and key numbers by name. Part of the
!> Fortran interface (ek_api).
module ek_session_solution
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: str, quoted, is_like, did_you_mean
   use ek_reader, only: definition_t
   use ek_case_result, only: case_result_t, solve_options_t, add_remarks, failure_of
   use ek_remark, only: remark_t, remark_list_t, note, warning
   use ek_response, only: no_column
   use ek_table, only: name_length, column_index
   use ek_compliance, only: compliance_t, new_compliance
   use ek_schedule, only: new_schedule
   use ek_compliance_table, only: state_compliance
   use ek_wheel_side, only: deck_frame
   use ek_workspace, only: workspace_t, solve_numbers, solve_or_explain, succeeded, out_of_range, settle_numbers, &
      settle_or_explain
   use ek_workspace_cases, only: heads_of_case, case_number, report_cases
   use ek_session, only: session_t, without_option, prepared_t, take_new_numbers, reread, derived_t
   use ek_direction, only: direction_t, find_directions, refuse_shared
   use ek_defined_column, only: defined_t, define_columns, keep_named
   use ek_defined_table, only: needed_columns
   use ek_defined_slopes, only: begin_defined, define_derivatives
   use ek_derivatives, only: derivatives_t, begin_derivatives, find_derivatives, refuse_case
   use ek_case, only: case_t
   use ek_named_numbers, only: named_numbers_t, prepare_numbers, read_numbers, needed_tests, explain_missing
   use ek_words, only: begin_words, end_words
   implicit none(type, external)
   private
   public :: solve, result_of, read_remark, compliance_at, find_row, find_slopes, read_key_numbers

contains

   !> Solves a case of the deck or a standard test at the present numbers. The table has all columns, or only `state`, `factor`, the
   !> named columns and, at its end, the columns on convergence. The named columns are in the order of the program's tables.
   subroutine solve(session, name, error, columns)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: name                         !! '': the first case of the deck
      type(error_t), allocatable, intent(out) :: error         !! exit_usage, exit_deck, exit_model: there is no result;
      !!                                                          exit_convergence: there is one, with the states that converged
      character(*), intent(in), optional :: columns(:)         !! * stands for any characters; absent or of size 0: all
      character(name_length), allocatable :: asked(:)
      integer :: k, outcome

      session%solved = 0
      if (allocated(session%other)) then
         deallocate (session%other)
         if (allocated(session%derived)) session%derived%derivatives%case = 0      ! perhaps of it: kept as room
      end if
      allocate (asked(0))
      if (present(columns)) asked = columns
      k = case_number(name, session%workspace)
      outcome = out_of_range
      call take_new_numbers(session)
      if (k > 0) then
         if (is_ready(session%prepared(k), asked)) then
            call solve_numbers(k, session%prepared(k)%options, session%workspace, outcome)
            if (outcome == succeeded) session%solved = k
         end if
      end if
      call begin_words()
      if (outcome /= succeeded) call solve_with_words(session, name, asked, error)
      if (session%solved > 0) call end_solution(session, error)
      call end_words()
   end subroutine solve

   !> Whether a case was solved before with these columns.
   pure logical function is_ready(prepared, asked)
      type(prepared_t), intent(in) :: prepared
      character(name_length), intent(in) :: asked(:)

      is_ready = prepared%is_ready
      if (is_ready) is_ready = size(asked) == size(prepared%asked)
      if (is_ready) is_ready = all(asked == prepared%asked)
   end function is_ready

   !> Solves a case that was not solved before or that may fail. Creates strings.
   subroutine solve_with_words(session, name, asked, error)
      type(session_t), intent(inout), target :: session
      character(*), intent(in) :: name
      character(name_length), intent(in) :: asked(:)
      type(error_t), allocatable, intent(out) :: error
      type(prepared_t) :: prepared
      logical :: is_done
      integer :: k

      call find_case(name, session%workspace, session%deck%file, k, error)
      if (.not. allocated(error)) call prepare(session%workspace, k, asked, session%prepared(k), error)
      if (.not. allocated(error)) call solve_or_explain(k, session%prepared(k)%options, session%workspace, is_done, error)
      if (allocated(error)) return
      session%prepared(k)%is_ready = is_done
      if (.not. is_done) then
         if (allocated(session%other_definition)) deallocate (session%other_definition)
         allocate (session%other, session%other_definition)
         call reread(session%deck, session%numbers, session%workspace%definition, session%other_definition, session%other, error)
         if (.not. allocated(error)) call find_case(name, session%other, session%deck%file, k, error)
         if (.not. allocated(error)) call prepare(session%other, k, asked, prepared, error)
         if (.not. allocated(error)) call solve_or_explain(k, prepared%options, session%other, is_done, error)
         call without_option(error)
         if (allocated(error)) return
      end if
      session%solved = k
   end subroutine solve_with_words

   !> Finds a case by name; an unknown name is an error with a suggestion.
   subroutine find_case(name, workspace, file, k, error)
      character(*), intent(in) :: name, file
      type(workspace_t), intent(in) :: workspace
      integer, intent(out) :: k
      type(error_t), allocatable, intent(out) :: error
      character(name_length) :: names(size(workspace%cases))
      integer :: j

      k = case_number(name, workspace)
      if (k > 0) return
      do j = 1, size(names)
         names(j) = workspace%cases(j)%case%name
      end do
      call fail(error, exit_usage, 'no case '//quoted(name)//' in '//file//did_you_mean(name, names))
   end subroutine find_case

   !> Prepares the columns of the table of a case. Names with * are replaced by all matching names.
   subroutine prepare(workspace, k, asked, prepared, error)
      type(workspace_t), intent(in) :: workspace
      integer, intent(in) :: k
      character(name_length), intent(in) :: asked(:)
      type(prepared_t), intent(out) :: prepared
      type(error_t), allocatable, intent(out) :: error     !! exit_usage: columns that the case does not have
      type(message_list_t) :: mistakes
      character(name_length), allocatable :: heads(:)
      logical, allocatable :: is_wanted(:), fits(:)
      integer :: j, h

      allocate (prepared%asked, source=asked)              ! an assignment reads bounds of what is not allocated
      if (size(asked) == 0) return
      call heads_of_case(k, workspace, heads)
      allocate (is_wanted(size(heads)), source=.false.)
      do j = 1, size(asked)
         fits = [(is_like(trim(heads(h)), trim(asked(j))), h=1, size(heads))]
         if (.not. any(fits)) call mistakes%add('case '//quoted(workspace%cases(k)%case%name)//': '// &
            no_column(trim(asked(j)), heads))
         is_wanted = is_wanted .or. fits
      end do
      if (mistakes%count() > 0) call fail(error, exit_usage, mistakes%text())
      prepared%options%columns = pack(heads, is_wanted)
   end subroutine prepare

   !> Creates the messages on the last solution. Returns failures as an error.
   subroutine end_solution(session, error)
      type(session_t), intent(inout), target :: session
      type(error_t), allocatable, intent(inout) :: error
      type(solve_options_t) :: options
      type(case_result_t), pointer :: result

      result => result_of(session)
      call add_remarks(options, result)
      call failure_of(result, error)
      if (.not. result%is_run()) session%solved = 0
      if (allocated(session%other)) then
         session%solved_x = session%other%x
      else
         session%solved_x = session%workspace%x
      end if
   end subroutine end_solution

   !> The last solution. result%table has the columns, one row per state; result%remarks has the notes, warnings and failures. The
   !> pointer is not associated if there is no solution.
   function result_of(session) result(last)
      type(session_t), intent(inout), target :: session
      type(case_result_t), pointer :: last

      nullify (last)
      if (session%solved == 0) return
      if (allocated(session%other)) then
         last => session%other%cases(session%solved)%result
      else
         last => session%workspace%cases(session%solved)%result
      end if
   end function result_of

   !> Reads a message on a solution: its string, and its severity 'note', 'warning' or 'failure'. Both are '' if there is no
   !> message k.
   subroutine read_remark(remarks, k, text, severity)
      type(remark_list_t), intent(in) :: remarks
      integer, intent(in) :: k
      character(:), allocatable, intent(out) :: text, severity
      type(remark_t) :: remark

      text = ''
      severity = ''
      if (k < 1 .or. k > remarks%count()) return
      remark = remarks%item(k)
      text = remark%whole()
      severity = 'failure'
      if (remark%severity == note) severity = 'note'
      if (remark%severity == warning) severity = 'warning'
   end subroutine read_remark

   !> Finds the last solution and the state of the path that a row of its table shows.
   subroutine find_row(session, row, result, state, error)
      type(session_t), intent(inout), target :: session
      integer, intent(in) :: row
      type(case_result_t), pointer, intent(out) :: result
      integer, intent(out) :: state                        !! 0 after an error
      type(error_t), allocatable, intent(out) :: error     !! exit_usage: no solution, no such row, or other numbers since

      state = 0
      result => result_of(session)
      if (.not. associated(result)) then
         call fail(error, exit_usage, 'there is no solution')
         return
      end if
      associate (rows => size(result%table%values, 2))
         if (row < 1 .or. row > rows) then
            call fail(error, exit_usage, 'expected a row from 1 to '//str(rows)//', found '//str(row))
         else
            call refuse_other_numbers(session, error)
         end if
      end associate
      if (.not. allocated(error)) state = nint(result%table%values(column_index(result%table, 'state'), row)) + 1
   end subroutine find_row

   !> Rejects calls on the last solution if key numbers, or messages on the model, have since been read at changed numbers, because
   !> the model then has the changed numbers.
   subroutine refuse_other_numbers(session, error)
      type(session_t), intent(in) :: session
      type(error_t), allocatable, intent(out) :: error     !! exit_usage
      logical :: is_other

      if (allocated(session%other)) then
         is_other = any(abs(session%other%x - session%solved_x) > 0.0_wp)
      else
         is_other = any(abs(session%workspace%x - session%solved_x) > 0.0_wp)
      end if
      if (is_other) call fail(error, exit_usage, &
         'numbers were changed after the last solution, and K&C metrics or messages on the model were requested with them: '// &
         'solve again before the compliance matrix, poses or derivatives are requested')
   end subroutine refuse_other_numbers

   !> Computes the compliance matrix at the wheel centres in one row of the last solution: displacements x y z [m] and rotations
   !> [rad] per force [N] and moment [N m]. The left wheel is first; the frame is the frame of the deck. All entries are NaN if the
   !> state did not converge or the matrix is singular.
   subroutine compliance_at(session, row, c, error)
      type(session_t), intent(inout), target :: session
      integer, intent(in) :: row
      real(wp), intent(out) :: c(:, :)                     !! matrix of 6 × wheels rows and columns
      type(error_t), allocatable, intent(out) :: error     !! exit_usage: no solution or row, wrong shape, other numbers since
      type(case_result_t), pointer :: result
      type(compliance_t) :: compliance
      real(wp) :: arm(3, size(c, 1)/6), frame(3)
      integer :: state, wide, i, j

      c = ieee_value(1.0_wp, ieee_quiet_nan)
      call find_row(session, row, result, state, error)
      if (allocated(error)) return
      wide = 6*size(result%suspension%wheels)
      if (any(shape(c) /= wide)) then
         call fail(error, exit_usage, 'expected a matrix of '//str(wide)//' rows and columns, found '//str(size(c, 1))//' and '// &
            str(size(c, 2)))
         return
      end if
      if (.not. result%path%is_reached(state)) return
      compliance = new_compliance(result%suspension, .false.)
      call state_compliance(result%suspension, new_schedule(result%suspension, result%case), result%path, state, result%kkt, &
         compliance, c, arm)
      frame = deck_frame(result%suspension)
      do j = 1, size(c, 2)
         do i = 1, size(c, 1)
            c(i, j) = frame(mod(i - 1, 3) + 1)*frame(mod(j - 1, 3) + 1)*c(i, j)
         end do
      end do
   end subroutine compliance_at

   !> Computes the derivatives of columns in one row of the last solution with respect to numbers of the deck, and estimates of
   !> their errors [unit of the column per unit of the number]. No solution is repeated (ek_derivatives). A derivative is NaN if the
   !> state did not converge, if the column has no value at the state, or if the number cannot be changed.
   subroutine find_slopes(session, row, columns, paths, slopes, errors, error, program)
      type(session_t), intent(inout), target :: session
      integer, intent(in) :: row                               !! row of the table of the last solution
      character(*), intent(in) :: columns(:)  !! columns of the case (requested or not), or of its compliance matrix
      character(*), intent(in) :: paths(:)                     !! as in set_number, each of one number, or of both sides of an axle
      real(wp), intent(out) :: slopes(:, :), errors(:, :)      !! (column, path)
      type(error_t), allocatable, intent(out) :: error         !! exit_usage: wrong row, column or path; no derivatives of the case
      character(*), intent(in), optional :: program            !! other program, whose columns may also be named by their headings
      type(case_result_t), pointer :: result
      character(10) :: other
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
      other = ''
      if (present(program)) other = program
      is_ready = is_prepared(session, columns, paths, other)
      if (.not. is_ready) then
         call begin_words()
         call prepare_derivatives(session, columns, paths, other, error)
         call end_words()
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
         if (derived%program /= '') call define_derivatives(workspace, derived%list, derived%derivatives, derived%defined)
         do p = 1, size(paths)
            do c = 1, size(columns)
               associate (place => derived%column(c), direction => derived%direction(p))
                  if (place > 0) then
                     slopes(c, p) = derived%derivatives%slopes(place, direction, 1)
                     errors(c, p) = derived%derivatives%errors(place, direction, 1)
                  else
                     slopes(c, p) = derived%defined%slopes(-place, direction, 1)
                     errors(c, p) = derived%defined%errors(-place, direction, 1)
                  end if
               end associate
            end do
         end do
      end subroutine find

   end subroutine find_slopes

   !> Whether the last request had the same columns, paths, program, case and workspace.
   pure logical function is_prepared(session, columns, paths, program)
      type(session_t), intent(in) :: session
      character(*), intent(in) :: columns(:), paths(:), program

      is_prepared = .false.
      if (.not. allocated(session%derived) .or. allocated(session%other)) return
      associate (derived => session%derived)
         if (derived%derivatives%case /= session%solved .or. size(columns) /= size(derived%columns)) return
         if (size(paths) /= size(derived%paths)) return
         is_prepared = all(columns == derived%columns) .and. all(paths == derived%paths) .and. program == derived%program
      end associate
   end function is_prepared

   !> Prepares directions, columns and work space. Creates strings.
   subroutine prepare_derivatives(session, columns, paths, program, error)
      type(session_t), intent(inout), target :: session
      character(*), intent(in) :: columns(:), paths(:)
      character(*), intent(in) :: program                      !! '': none
      type(error_t), allocatable, intent(out) :: error
      type(direction_t), allocatable :: directions(:)
      type(message_list_t) :: mistakes
      class(workspace_t), pointer :: workspace
      character(name_length), allocatable :: heads(:), needed(:)
      integer :: c

      workspace => session%workspace
      if (allocated(session%other)) workspace => session%other
      call refuse_case(workspace%cases(session%solved)%case, error)
      if (allocated(error)) return
      if (.not. allocated(session%derived)) allocate (session%derived)
      associate (derived => session%derived)
         call place_paths(workspace, session, paths, directions, derived%direction, mistakes)
         needed = columns
         if (program /= '') call add_needed(workspace, session%solved, columns, trim(program), needed)
         if (mistakes%count() == 0) call begin_derivatives(workspace, session%solved, needed, directions, derived%derivatives)
         if (mistakes%count() == 0 .and. program /= '') call begin_defined(workspace, trim(program), columns, derived%derivatives, &
            derived%list, derived%defined)
         derived%column = spread(0, 1, size(columns))
         do c = 1, size(columns)
            if (mistakes%count() > 0) exit
            derived%column(c) = findloc(derived%derivatives%columns == columns(c), .true., dim=1)
            if (derived%column(c) == 0 .and. program /= '') &
               derived%column(c) = -findloc(derived%list%head == columns(c), .true., dim=1)
         end do
         if (mistakes%count() == 0 .and. any(derived%column == 0)) then
            call heads_of_case(session%solved, workspace, heads)
            if (program /= '') heads = [character(name_length) :: heads, heads_of_program(workspace, session%solved, trim(program))]
            do c = 1, size(columns)
               if (derived%column(c) /= 0) cycle
               if (any(heads == columns(c))) then
                  call mistakes%add(quoted(trim(columns(c)))//' describes the solution and has no derivative')
               else
                  call mistakes%add(no_column(trim(columns(c)), heads))
               end if
            end do
         end if
         derived%columns = columns
         derived%paths = paths
         derived%program = program
      end associate
      if (mistakes%count() == 0) return
      call fail(error, exit_usage, mistakes%text())
      session%derived%derivatives%case = 0        ! kept as room; is_prepared knows that it is no answer
   end subroutine prepare_derivatives

   !> Adds the columns of elastokin from which named columns of another program follow.
   subroutine add_needed(workspace, case, columns, program, needed)
      class(workspace_t), intent(in) :: workspace
      integer, intent(in) :: case
      character(*), intent(in) :: columns(:), program
      character(name_length), allocatable, intent(inout) :: needed(:)
      character(name_length), allocatable :: heads(:)
      type(defined_t), allocatable :: list(:)

      call heads_of_case(case, workspace, heads)
      call define_columns(workspace%cases(case)%result%suspension, heads, program, list)
      call keep_named(columns, list)
      call needed_columns(heads, list, needed)
   end subroutine add_needed

   !> The headings of all columns of another program in a case.
   function heads_of_program(workspace, case, program) result(names)
      class(workspace_t), intent(in) :: workspace
      integer, intent(in) :: case
      character(*), intent(in) :: program
      character(name_length), allocatable :: names(:), heads(:)
      type(defined_t), allocatable :: list(:)

      call heads_of_case(case, workspace, heads)
      call define_columns(workspace%cases(case)%result%suspension, heads, program, list)
      names = list%head
   end function heads_of_program

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
         call find_directions(workspace%definition, session%deck, one, these, error)
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
      call refuse_shared(workspace%definition, directions, error)
      if (allocated(error)) call mistakes%add(error%message)
   end subroutine place_paths

   !> Reads key numbers of the report by name, at the present numbers. Only the tests that these key numbers need are solved, as far
   !> as needed. The last solution is unchanged.
   subroutine read_key_numbers(session, names, values, error)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: names(:)
      real(wp), intent(out) :: values(:)                   !! one for each name, in the units of key_numbers.csv
      type(error_t), allocatable, intent(out) :: error     !! exit_usage, exit_deck, exit_model: none has a value; exit_convergence:
      !!                                                      some are not a number; the message names them and the states that
      !!                                                      they need and that were not found
      type(case_t), allocatable :: cases(:)
      type(message_list_t) :: none                         ! a case with a defect is not read from numbers alone
      logical :: is_done, is_whole
      integer :: k, outcome

      values = ieee_value(1.0_wp, ieee_quiet_nan)
      if (size(values) < size(names)) then
         call fail(error, exit_usage, 'expected an array of '//str(size(names))//' values, one for each name, found '// &
            str(size(values)))
         return
      end if
      call take_new_numbers(session)
      is_done = session%is_named_ready
      if (is_done) is_done = size(names) == size(session%names)
      do k = 1, size(names)
         if (is_done) is_done = session%names(k) == names(k)
      end do
      if (is_done) then
         call settle_numbers(needed_tests(session%named), session%workspace, outcome)
         is_done = outcome == succeeded
      end if
      if (is_done) then
         call report_cases(session%workspace, cases)
         call read_numbers(session%named, session%workspace%suspension, cases, values, is_whole)
         if (is_whole) return
      end if
      call begin_words()
      if (is_done) then
         call explain_missing(session%named, names, values, none, error)
      else
         call read_with_words(session, names, values, error)
      end if
      call end_words()
   end subroutine read_key_numbers

   !> Reads key numbers that were not requested before, or key numbers of a design that may have a defect. Creates strings.
   subroutine read_with_words(session, names, values, error)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: names(:)
      real(wp), intent(inout) :: values(:)
      type(error_t), allocatable, intent(out) :: error
      class(workspace_t), allocatable :: other
      type(definition_t), target :: definition
      class(named_numbers_t), allocatable :: named
      logical :: is_done

      session%is_named_ready = .false.
      session%names = names
      if (.not. allocated(session%named)) allocate (session%named)
      call read_of(session%workspace, session%named, is_done)
      if (allocated(error)) return
      session%is_named_ready = is_done
      if (is_done) return
      allocate (other, named)
      call reread(session%deck, session%numbers, session%workspace%definition, definition, other, error)
      if (.not. allocated(error)) call read_of(other, named, is_done)
      call without_option(error)

   contains

      subroutine read_of(workspace, numbers, is_done)
         type(workspace_t), intent(inout) :: workspace
         type(named_numbers_t), intent(inout) :: numbers
         logical, intent(out) :: is_done
         type(case_t), allocatable :: cases(:)
         type(message_list_t) :: defects
         logical :: is_solvable(size(workspace%report_order)), is_whole

         call report_cases(workspace, cases)
         call prepare_numbers(names, workspace%raw, cases, numbers, error)
         is_done = .false.
         if (.not. allocated(error)) call settle_or_explain(needed_tests(numbers), workspace, is_solvable, defects, is_done, error)
         if (allocated(error) .or. .not. is_done) return
         call report_cases(workspace, cases)                 ! with the present numbers
         call read_numbers(numbers, workspace%suspension, cases, values, is_whole, is_solvable)
         if (.not. is_whole) call explain_missing(numbers, names, values, defects, error)
      end subroutine read_of

   end subroutine read_with_words

end module ek_session_solution
