!> The C interface (include/elastokin.h): solving a case, and the arrays of its results.
module ek_c_results
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_null_ptr, c_ptr
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_quantity, only: quantity_t, quantity_named, unit_of, unit_text
   use ek_response, only: no_column
   use ek_table, only: table_t, name_length, column_index
   use ek_definition_rows, only: definitions
   use ek_definition, only: check_program
   use ek_defined_table, only: defined_table
   use ek_case_result, only: case_result_t
   use ek_session_solution, only: solve, result_of, compliance_at, read_remark, find_slopes
   use ek_c_handle, only: handle_t, open_handle, take_handle, take_array, take_names, take_text, finish, refuse, say, &
      from_c, is_position, ek_ok
   use ek_words, only: begin_words, end_words
   implicit none(type, external)
   private
   public :: ek_solve, ek_define, ek_row_count, ek_column_count, ek_column_name, ek_column_unit, ek_column_title, ek_column_sign, &
      ek_values, ek_column_values, ek_remark_count, ek_remark_text, ek_remark_severity, ek_compliance, ek_derivatives, take_solution

   character(*), parameter :: no_solution = 'there is no solution'

contains

   !> Exit code after solving a case (elastokin.h).
   integer(c_int) function ek_solve(model, name, n_columns, columns) bind(c) result(code)
      type(c_ptr), value :: model, name, columns
      integer(c_int), value :: n_columns
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      character(:), allocatable :: case
      character(name_length), allocatable :: names(:)

      call take_handle(model, handle, code)
      if (code /= ek_ok) return
      if (n_columns < 0 .or. (n_columns > 0 .and. .not. c_associated(columns))) then
         code = refuse(handle, 'n_columns must be 0 or more, and columns must not be NULL')
         return
      end if
      call take_names(handle, columns, n_columns, names, code)
      if (code /= ek_ok) return
      call from_c(name, case)
      if (allocated(handle%defined)) deallocate (handle%defined, handle%defined_rows)
      handle%program = ''
      call solve(handle%session, case, error, names)
      code = finish(handle, error)
   end function ek_solve

   !> Exit code after converting the table of the last solution to the definitions of another program (elastokin.h).
   integer(c_int) function ek_define(model, program) bind(c) result(code)
      type(c_ptr), value :: model, program
      type(handle_t), pointer :: handle
      type(case_result_t), pointer :: last
      type(error_t), allocatable :: error
      character(:), allocatable :: name

      call take_solution(model, handle, last, code)
      if (code /= ek_ok) return
      call from_c(program, name)
      call begin_words()
      if (name /= '') call check_program(name, error)
      if (.not. allocated(error) .and. allocated(handle%defined)) deallocate (handle%defined, handle%defined_rows)
      if (.not. allocated(error)) handle%program = name
      if (.not. allocated(error) .and. name /= '') then
         allocate (handle%defined)
         call defined_table(last%suspension, last%table, name, handle%defined, handle%defined_rows)
      end if
      call end_words()
      code = finish(handle, error)
   end function ek_define

   !> The table of the last solution as the caller sees it: in the definitions of ek_define, else as solved.
   function table_of(handle, last) result(table)
      type(handle_t), pointer, intent(in) :: handle
      type(case_result_t), pointer, intent(in) :: last
      type(table_t), pointer :: table

      table => last%table
      if (allocated(handle%defined)) table => handle%defined
   end function table_of

   !> The last solution; not associated if there is no solution.
   function solution_of(handle) result(last)
      type(handle_t), pointer, intent(in) :: handle          !! handle of open_handle
      type(case_result_t), pointer :: last

      nullify (last)
      if (associated(handle)) last => result_of(handle%session)
   end function solution_of

   !> The last solution, for a call that returns a string. If there is no solution, a message is stored in the handle.
   function described_solution(handle) result(last)
      type(handle_t), pointer, intent(in) :: handle          !! handle of open_handle
      type(case_result_t), pointer :: last
      integer(c_int) :: code

      last => solution_of(handle)
      if (.not. associated(last)) code = refuse(handle, no_solution)
   end function described_solution

   !> Finds the last solution for a call that returns a code. The code is not ek_ok if there is no solution.
   subroutine take_solution(model, handle, last, code)
      type(c_ptr), intent(in) :: model
      type(handle_t), pointer, intent(out) :: handle
      type(case_result_t), pointer, intent(out) :: last
      integer(c_int), intent(out) :: code

      call take_handle(model, handle, code)
      last => solution_of(handle)
      if (code == ek_ok .and. .not. associated(last)) code = refuse(handle, no_solution)
   end subroutine take_solution

   !> Number of states of the last solution; 0 without a solution.
   integer(c_int) function ek_row_count(model) bind(c) result(count)
      type(c_ptr), value :: model
      type(case_result_t), pointer :: last

      last => solution_of(open_handle(model))
      count = 0
      if (associated(last)) count = int(size(last%table%values, 2), c_int)
   end function ek_row_count

   !> Number of columns of the last solution; 0 without a solution.
   integer(c_int) function ek_column_count(model) bind(c) result(count)
      type(c_ptr), value :: model
      type(handle_t), pointer :: handle
      type(case_result_t), pointer :: last
      type(table_t), pointer :: table

      handle => open_handle(model)
      last => solution_of(handle)
      count = 0
      if (.not. associated(last)) return
      table => table_of(handle, last)
      count = int(size(table%values, 1), c_int)
   end function ek_column_count

   !> Name of column k, from 0, as a C string; NULL outside the table.
   type(c_ptr) function ek_column_name(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_column(open_handle(model), k, 'name')
   end function ek_column_name

   !> Unit of column k, from 0, as a C string; NULL outside the table.
   type(c_ptr) function ek_column_unit(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_column(open_handle(model), k, 'unit')
   end function ek_column_unit

   !> Title of column k, from 0, as a C string; empty if the column has no title.
   type(c_ptr) function ek_column_title(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_column(open_handle(model), k, 'title')
   end function ek_column_title

   !> Sign convention of column k, from 0, as a C string; empty if the column has no sign convention.
   type(c_ptr) function ek_column_sign(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_column(open_handle(model), k, 'sign')
   end function ek_column_sign

   !> Name, unit, title or sign of a column of the last solution.
   type(c_ptr) function text_of_column(handle, k, what) result(address)
      type(handle_t), pointer, intent(in) :: handle
      integer(c_int), intent(in) :: k
      character(*), intent(in) :: what
      type(case_result_t), pointer :: last
      type(table_t), pointer :: table
      type(quantity_t) :: quantity
      character(:), allocatable :: name, text

      address = c_null_ptr
      last => described_solution(handle)
      if (.not. associated(last)) return
      table => table_of(handle, last)
      if (.not. is_position(handle, k, size(table%columns))) return
      if (allocated(handle%defined_rows)) then
         if (handle%defined_rows(k + 1) > 0) then
            address = text_of_defined(handle, k + 1, what)
            return
         end if
      end if
      call begin_words()
      name = trim(table%columns(k + 1))
      text = name
      select case (what)
      case ('unit')
         text = unit_text(unit_of(name))
         if (name == 'factor') text = last%case%unit_name
         if (text == '–' .or. text == '-') text = ''
      case ('title', 'sign')
         if (index(name, 'left_') == 1) name = name(6:)
         if (index(name, 'right_') == 1) name = name(7:)
         quantity = quantity_named(name)
         text = trim(merge(quantity%title, quantity%sign//repeat(' ', len(quantity%title) - len(quantity%sign)), what == 'title'))
         if (quantity%title == name) text = ''
      end select
      address = say(handle, text)
      call end_words()
   end function text_of_column

   !> Name, unit, title or sign of a column in the definitions of another program.
   type(c_ptr) function text_of_defined(handle, k, what) result(address)
      type(handle_t), pointer, intent(in) :: handle
      integer, intent(in) :: k
      character(*), intent(in) :: what
      character(:), allocatable :: text

      call begin_words()
      associate (row => definitions(handle%defined_rows(k)))
         select case (what)
         case ('unit')
            text = trim(row%unit)
         case ('title')
            text = trim(row%name)
         case ('sign')
            text = trim(row%positive)
         case default
            text = trim(handle%defined%columns(k))
         end select
      end associate
      address = say(handle, text)
      call end_words()
   end function text_of_defined

   !> Exit code after copying the table of the last solution, row after row.
   integer(c_int) function ek_values(model, n, values) bind(c) result(code)
      type(c_ptr), value :: model, values
      integer(c_int), value :: n
      type(handle_t), pointer :: handle
      type(case_result_t), pointer :: last
      type(table_t), pointer :: table
      real(c_double), pointer :: place(:)

      call take_solution(model, handle, last, code)
      if (code /= ek_ok) return
      table => table_of(handle, last)
      call take_array(handle, values, n, size(table%values), &
         'the array must have rows x columns numbers (ek_row_count, ek_column_count)', place, code)
      if (code == ek_ok) call put_grid(table%values, place)
   end function ek_values

   !> Copies a matrix column by column.
   pure subroutine put_grid(grid, place)
      real(wp), intent(in) :: grid(:, :)
      real(c_double), intent(inout) :: place(size(grid, 1), size(grid, 2))
      place = grid
   end subroutine put_grid

   integer(c_int) function ek_column_values(model, name, n, values) bind(c) result(code)
      type(c_ptr), value :: model, name, values
      integer(c_int), value :: n
      type(handle_t), pointer :: handle
      type(case_result_t), pointer :: last
      type(table_t), pointer :: table
      real(c_double), pointer :: place(:)
      character(:), allocatable :: head
      integer :: k

      call take_solution(model, handle, last, code)
      if (code == ek_ok) call take_text(handle, name, 'name must not be NULL', head, code)
      if (code /= ek_ok) return
      table => table_of(handle, last)
      k = column_index(table, head)
      if (k == 0) then
         call begin_words()
         code = refuse(handle, no_column(head, table%columns))
         call end_words()
         return
      end if
      call take_array(handle, values, n, size(table%values, 2), &
         'the array must have as many numbers as there are rows (ek_row_count)', place, code)
      if (code == ek_ok) place = table%values(k, :)
   end function ek_column_values

   integer(c_int) function ek_remark_count(model) bind(c) result(count)
      type(c_ptr), value :: model
      type(case_result_t), pointer :: last

      last => solution_of(open_handle(model))
      count = 0
      if (associated(last)) count = int(last%remarks%count(), c_int)
   end function ek_remark_count

   type(c_ptr) function ek_remark_text(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_remark(open_handle(model), k, is_severity=.false.)
   end function ek_remark_text

   type(c_ptr) function ek_remark_severity(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_remark(open_handle(model), k, is_severity=.true.)
   end function ek_remark_severity

   !> A message on the last solution, or the severity of the message; NULL outside the list.
   type(c_ptr) function text_of_remark(handle, k, is_severity) result(address)
      type(handle_t), pointer, intent(in) :: handle
      integer(c_int), intent(in) :: k
      logical, intent(in) :: is_severity
      type(case_result_t), pointer :: last
      character(:), allocatable :: text, severity

      address = c_null_ptr
      last => described_solution(handle)
      if (.not. associated(last)) return
      if (.not. is_position(handle, k, last%remarks%count())) return
      call begin_words()
      call read_remark(last%remarks, k + 1, text, severity)
      if (is_severity) text = severity
      address = say(handle, text)
      call end_words()
   end function text_of_remark

   integer(c_int) function ek_compliance(model, row, n, values) bind(c) result(code)
      type(c_ptr), value :: model, values
      integer(c_int), value :: row, n
      type(handle_t), pointer :: handle
      type(case_result_t), pointer :: last
      real(c_double), pointer :: place(:)
      type(error_t), allocatable :: error
      real(wp), allocatable :: c(:, :)
      integer :: wide

      call take_solution(model, handle, last, code)
      if (code /= ek_ok) return
      if (.not. is_position(handle, row, size(last%table%values, 2), code)) return
      wide = 6*size(last%suspension%wheels)
      call take_array(handle, values, n, wide**2, 'the array must have (6 x wheels) squared numbers (ek_wheel_count)', place, code)
      if (code /= ek_ok) return
      allocate (c(wide, wide))
      call compliance_at(handle%session, row + 1, c, error)
      code = finish(handle, error)
      if (code == ek_ok) call put_grid(transpose(c), place)
   end function ek_compliance

   integer(c_int) function ek_derivatives(model, row, n_columns, columns, n_numbers, paths, values, errors) bind(c) result(code)
      type(c_ptr), value :: model, columns, paths, values, errors
      integer(c_int), value :: row, n_columns, n_numbers
      type(handle_t), pointer :: handle
      type(case_result_t), pointer :: last
      type(error_t), allocatable :: error
      real(c_double), pointer :: place(:)
      character(name_length), allocatable :: names(:), numbers(:)
      real(wp), allocatable :: slopes(:, :), doubts(:, :)

      call take_solution(model, handle, last, code)
      if (code /= ek_ok) return
      if (.not. is_position(handle, row, size(last%table%values, 2), code)) return
      if (n_columns <= 0 .or. n_numbers <= 0 .or. .not. (c_associated(columns) .and. c_associated(paths) .and. &
         c_associated(values))) then
         code = refuse(handle, 'n_columns and n_numbers must be positive, and columns, paths and values must not be NULL')
         return
      end if
      call take_names(handle, columns, n_columns, names, code)
      if (code == ek_ok) call take_names(handle, paths, n_numbers, numbers, code)
      if (code /= ek_ok) return
      allocate (slopes(n_columns, n_numbers), doubts(n_columns, n_numbers))
      call find_slopes(handle%session, row + 1, names, numbers, slopes, doubts, error, trim(handle%program))
      code = finish(handle, error)
      if (code /= ek_ok) return
      call c_f_pointer(values, place, [n_columns*n_numbers])
      call put_grid(transpose(slopes), place)
      if (.not. c_associated(errors)) return
      call c_f_pointer(errors, place, [n_columns*n_numbers])
      call put_grid(transpose(doubts), place)
   end function ek_derivatives

end module ek_c_results
