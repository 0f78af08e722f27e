!> The C interface (include/elastokin.h): the numbers of a model, by position and by path.
module ek_c_parameters
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use, intrinsic :: iso_c_binding, only: c_double, c_int, c_null_ptr, c_ptr
   use ek_error, only: error_t
   use ek_parameter, only: parameter_path
   use ek_factor_unit, only: parameter_unit
   use ek_session_settings, only: set_number, set_text, get_number, set_all, reset
   use ek_c_handle, only: handle_t, open_handle, take_handle, take_array, take_text, finish, refuse, say, &
      is_position, ek_ok
   use ek_words, only: begin_words, end_words
   implicit none(type, external)
   private
   public :: ek_parameter_count, ek_parameter_path, ek_parameter_unit, ek_parameter_is_given, ek_parameter_twin, ek_get_at, &
      ek_set_at, ek_get_all, ek_set_all, ek_get, ek_set, ek_set_text, ek_reset

   character(*), parameter :: no_value = 'value must not be NULL', no_path = 'path must not be NULL'

contains

   !> The handle of a model, if the model has a parameter with index k, counted from 0; otherwise the pointer is not associated.
   function handle_at(model, k, code) result(handle)
      type(c_ptr), intent(in) :: model
      integer(c_int), intent(in) :: k
      integer(c_int), intent(out), optional :: code
      type(handle_t), pointer :: handle
      integer(c_int) :: found

      call take_handle(model, handle, found)
      if (found == ek_ok) then
         if (.not. is_position(handle, k, size(handle%session%numbers%x), found)) nullify (handle)
      end if
      if (present(code)) code = found
   end function handle_at

   !> Number of parameters of the deck.
   integer(c_int) function ek_parameter_count(model) bind(c) result(count)
      type(c_ptr), value :: model
      type(handle_t), pointer :: handle

      handle => open_handle(model)
      count = 0
      if (associated(handle)) count = int(size(handle%session%numbers%x), c_int)
   end function ek_parameter_count

   !> Path of parameter k, from 0, as a C string; NULL outside the list.
   type(c_ptr) function ek_parameter_path(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      type(handle_t), pointer :: handle

      handle => handle_at(model, k)
      address = c_null_ptr
      if (.not. associated(handle)) return
      associate (design => handle%session%workspace%definition)
         call begin_words()
         address = say(handle, parameter_path(design%parameters%list(k + 1), design%records))
         call end_words()
      end associate
   end function ek_parameter_path

   !> Unit of parameter k, from 0, as a C string; empty for a dimensionless parameter.
   type(c_ptr) function ek_parameter_unit(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      type(handle_t), pointer :: handle

      handle => handle_at(model, k)
      address = c_null_ptr
      if (.not. associated(handle)) return
      call begin_words()
      address = say(handle, parameter_unit(handle%session%workspace%definition, k + 1))
      call end_words()
   end function ek_parameter_unit

   !> 1 if the deck gives parameter k, from 0; 0 if the parameter has its default.
   integer(c_int) function ek_parameter_is_given(model, k) bind(c) result(answer)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      type(handle_t), pointer :: handle

      handle => handle_at(model, k)
      answer = 0
      if (associated(handle)) answer = merge(1_c_int, 0_c_int, handle%session%workspace%definition%parameters%list(k + 1)%is_given)
   end function ek_parameter_is_given

   !> Position of the corresponding parameter of the left side of a mirrored axle; -1 if there is no such parameter.
   integer(c_int) function ek_parameter_twin(model, k) bind(c) result(twin)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      type(handle_t), pointer :: handle

      handle => handle_at(model, k)
      twin = -1_c_int
      if (associated(handle)) twin = int(handle%session%workspace%definition%parameters%list(k + 1)%tied, c_int) - 1_c_int
   end function ek_parameter_twin

   !> Exit code after reading parameter k, from 0, in the unit of the deck.
   integer(c_int) function ek_get_at(model, k, value) bind(c) result(code)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      real(c_double), intent(out), optional :: value       !! absent: a null pointer
      type(handle_t), pointer :: handle

      if (present(value)) value = ieee_value(value, ieee_quiet_nan)
      handle => handle_at(model, k, code)
      if (.not. associated(handle)) return
      if (.not. present(value)) then
         code = refuse(handle, no_value)
         return
      end if
      value = handle%session%numbers%value(k + 1)
   end function ek_get_at

   integer(c_int) function ek_set_at(model, k, value) bind(c) result(code)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      real(c_double), value :: value
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error

      handle => handle_at(model, k, code)
      if (.not. associated(handle)) return
      call set_all(handle%session, [value], error, first=k + 1)
      code = finish(handle, error)
   end function ek_set_at

   integer(c_int) function ek_get_all(model, n, values) bind(c) result(code)
      type(c_ptr), value :: model, values
      integer(c_int), value :: n
      type(handle_t), pointer :: handle
      real(c_double), pointer :: place(:)

      call take_all(model, n, values, handle, place, code)
      if (code == ek_ok) place = handle%session%numbers%value
   end function ek_get_all

   integer(c_int) function ek_set_all(model, n, values) bind(c) result(code)
      type(c_ptr), value :: model, values
      integer(c_int), value :: n
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      real(c_double), pointer :: place(:)

      call take_all(model, n, values, handle, place, code)
      if (code /= ek_ok) return
      call set_all(handle%session, place, error)
      code = finish(handle, error)
   end function ek_set_all

   !> Sets a pointer to the caller's array for the values of all parameters.
   subroutine take_all(model, n, values, handle, place, code)
      type(c_ptr), intent(in) :: model, values
      integer(c_int), intent(in) :: n
      type(handle_t), pointer, intent(out) :: handle
      real(c_double), pointer, intent(out) :: place(:)
      integer(c_int), intent(out) :: code

      nullify (place)
      call take_handle(model, handle, code)
      if (code == ek_ok) call take_array(handle, values, n, size(handle%session%numbers%x), &
         'the array must have as many numbers as there are parameters (ek_parameter_count)', place, code)
   end subroutine take_all

   integer(c_int) function ek_get(model, path, value) bind(c) result(code)
      type(c_ptr), value :: model, path
      real(c_double), intent(out), optional :: value       !! absent: a null pointer
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      character(:), allocatable :: name

      if (present(value)) value = ieee_value(value, ieee_quiet_nan)
      call take_handle(model, handle, code)
      if (code == ek_ok) call take_text(handle, path, no_path, name, code)
      if (code == ek_ok .and. .not. present(value)) code = refuse(handle, no_value)
      if (code /= ek_ok) return
      call get_number(handle%session, name, value, error)
      if (allocated(error)) value = ieee_value(value, ieee_quiet_nan)
      code = finish(handle, error)
   end function ek_get

   integer(c_int) function ek_set(model, path, value) bind(c) result(code)
      type(c_ptr), value :: model, path
      real(c_double), value :: value
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      character(:), allocatable :: name

      call take_handle(model, handle, code)
      if (code == ek_ok) call take_text(handle, path, no_path, name, code)
      if (code /= ek_ok) return
      call set_number(handle%session, name, value, error)
      code = finish(handle, error)
   end function ek_set

   integer(c_int) function ek_set_text(model, path, text) bind(c) result(code)
      type(c_ptr), value :: model, path, text
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      character(:), allocatable :: name, value

      call take_handle(model, handle, code)
      if (code == ek_ok) call take_text(handle, path, no_path, name, code)
      if (code == ek_ok) call take_text(handle, text, 'text must not be NULL', value, code)
      if (code /= ek_ok) return
      call set_text(handle%session, name, value, error)
      code = finish(handle, error)
   end function ek_set_text

   integer(c_int) function ek_reset(model) bind(c) result(code)
      type(c_ptr), value :: model
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error

      call take_handle(model, handle, code)
      if (code /= ek_ok) return
      call reset(handle%session, error)
      code = finish(handle, error)
   end function ek_reset

end module ek_c_parameters
