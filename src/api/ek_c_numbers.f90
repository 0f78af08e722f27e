!> The C interface (include/elastokin.h): key numbers of the report by name.
module ek_c_numbers
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_null_ptr, c_ptr
   use ek_error, only: error_t
   use ek_case, only: case_t
   use ek_table, only: name_length
   use ek_workspace_cases, only: report_cases
   use ek_number_names, only: list_numbers
   use ek_session_solution, only: read_key_numbers
   use ek_c_handle, only: handle_t, open_handle, take_handle, take_names, finish, refuse, say, is_position, ek_ok
   use ek_words, only: begin_words, end_words
   implicit none(type, external)
   private
   public :: ek_numbers, ek_number_count, ek_number_name, ek_number_unit, ek_number_definition

contains

   !> Exit code after computing key numbers by name (elastokin.h).
   integer(c_int) function ek_numbers(model, n, names, values) bind(c) result(code)
      type(c_ptr), value :: model, names, values
      integer(c_int), value :: n
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      real(c_double), pointer :: place(:)
      character(name_length), allocatable :: wanted(:)

      call take_handle(model, handle, code)
      if (code /= ek_ok) return
      if (n <= 0 .or. .not. c_associated(names) .or. .not. c_associated(values)) then
         code = refuse(handle, 'n must be positive, and names and values must not be NULL')
         return
      end if
      call take_names(handle, names, n, wanted, code)
      if (code /= ek_ok) return
      call c_f_pointer(values, place, [n])
      call read_key_numbers(handle%session, wanted, place, error)
      code = finish(handle, error)
   end function ek_numbers

   !> Number of key numbers that the model may have; nothing is solved.
   integer(c_int) function ek_number_count(model) bind(c) result(count)
      type(c_ptr), value :: model
      type(handle_t), pointer :: handle

      handle => open_handle(model)
      count = 0
      if (.not. associated(handle)) return
      call list(handle)
      count = int(handle%number_names%count(), c_int)
   end function ek_number_count

   !> Name of key number k, from 0, as a C string; NULL outside the list.
   type(c_ptr) function ek_number_name(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_number(open_handle(model), k, 'name')
   end function ek_number_name

   !> Unit of key number k, from 0, as a C string; NULL outside the list.
   type(c_ptr) function ek_number_unit(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_number(open_handle(model), k, 'unit')
   end function ek_number_unit

   !> Definition of key number k, from 0, as a C string; NULL outside the list.
   type(c_ptr) function ek_number_definition(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_number(open_handle(model), k, 'definition')
   end function ek_number_definition

   !> Creates the list of key numbers of the open deck.
   subroutine list(handle)
      type(handle_t), intent(inout) :: handle
      type(case_t), allocatable :: cases(:)

      call begin_words()
      call report_cases(handle%session%workspace, cases)
      call list_numbers(handle%session%workspace%raw, cases, handle%number_names, handle%number_units, handle%number_definitions)
      call end_words()
   end subroutine list

   !> Name, unit or definition of a key number in the list of key numbers. The list is created if it is empty.
   type(c_ptr) function text_of_number(handle, k, what) result(address)
      type(handle_t), pointer, intent(in) :: handle
      integer(c_int), intent(in) :: k
      character(*), intent(in) :: what

      address = c_null_ptr
      if (.not. associated(handle)) return
      if (handle%number_names%count() == 0) call list(handle)
      if (.not. is_position(handle, k, handle%number_names%count())) return
      call begin_words()
      select case (what)
      case ('name')
         address = say(handle, handle%number_names%line(k + 1))
      case ('unit')
         address = say(handle, handle%number_units%line(k + 1))
      case default
         address = say(handle, handle%number_definitions%line(k + 1))
      end select
      call end_words()
   end function text_of_number

end module ek_c_numbers
