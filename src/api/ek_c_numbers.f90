!> The C interface (include/elastokin.h): key numbers of the report by name.
module ek_c_numbers
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_null_ptr, c_ptr
   use ek_error, only: error_t, message_list_t
   use ek_case, only: case_t
   use ek_table, only: name_length
   use ek_design_solver, only: report_cases
   use ek_named_numbers, only: list_numbers
   use ek_session_numbers, only: read_key_numbers
   use ek_c_handle, only: handle_t, handle_of, is_usable, finish, refuse, say, from_c, is_position
   implicit none(type, external)
   private
   public :: ek_numbers, ek_number_count, ek_number_name, ek_number_unit, ek_number_definition

contains

   integer(c_int) function ek_numbers(model, n, names, values) bind(c) result(code)
      type(c_ptr), value :: model, names, values
      integer(c_int), value :: n
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      type(c_ptr), pointer :: addresses(:)
      real(c_double), pointer :: place(:)
      character(name_length), allocatable :: wanted(:)
      character(:), allocatable :: text
      integer :: k

      handle => handle_of(model)
      code = refuse(handle, 'n must be positive, and names and values must not be NULL')
      if (.not. is_usable(handle)) return
      code = refuse(handle, 'n must be positive, and names and values must not be NULL')
      if (n <= 0 .or. .not. c_associated(names) .or. .not. c_associated(values)) return
      call c_f_pointer(names, addresses, [n])
      call c_f_pointer(values, place, [n])
      allocate (wanted(n))
      do k = 1, n
         call from_c(addresses(k), text)
         wanted(k) = text
      end do
      call read_key_numbers(handle%session, wanted, place, error)
      code = finish(handle, error)
   end function ek_numbers

   integer(c_int) function ek_number_count(model) bind(c) result(count)
      type(c_ptr), value :: model
      type(handle_t), pointer :: handle

      handle => handle_of(model)
      count = 0
      if (.not. is_usable(handle)) return
      call list(handle)
      count = int(handle%number_names%count(), c_int)
   end function ek_number_count

   type(c_ptr) function ek_number_name(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_number(handle_of(model), k, 'name')
   end function ek_number_name

   type(c_ptr) function ek_number_unit(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_number(handle_of(model), k, 'unit')
   end function ek_number_unit

   type(c_ptr) function ek_number_definition(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_number(handle_of(model), k, 'definition')
   end function ek_number_definition

   !> Makes the list of the deck that is open.
   subroutine list(handle)
      type(handle_t), intent(inout) :: handle
      type(case_t), allocatable :: cases(:)

      !$omp critical (ek_words)
      call report_cases(handle%session%solver, cases)
      call list_numbers(handle%session%solver%raw, cases, handle%number_names, handle%number_units, handle%number_definitions)
      !$omp end critical (ek_words)
   end subroutine list

   !> Name, unit or definition of a number of the list that ek_number_count made.
   type(c_ptr) function text_of_number(handle, k, what) result(address)
      type(handle_t), pointer, intent(in) :: handle
      integer(c_int), intent(in) :: k
      character(*), intent(in) :: what

      address = c_null_ptr
      if (.not. is_usable(handle)) return
      if (handle%number_names%count() == 0) call list(handle)
      if (.not. is_position(handle, k, handle%number_names%count())) return
      !$omp critical (ek_words)
      select case (what)
      case ('name')
         address = say(handle, handle%number_names%line(k + 1))
      case ('unit')
         address = say(handle, handle%number_units%line(k + 1))
      case default
         address = say(handle, handle%number_definitions%line(k + 1))
      end select
      !$omp end critical (ek_words)
   end function text_of_number

end module ek_c_numbers
