!> The C interface (include/elastokin.h): the numbers of a model, by position and by path.
module ek_c_parameters
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_null_ptr, c_ptr
   use ek_error, only: error_t, exit_usage
   use ek_parameter, only: parameter_path
   use ek_factor_unit, only: parameter_unit
   use ek_session, only: set_number, set_text, get_number, set_all, reset
   use ek_c_handle, only: handle_t, handle_of, is_usable, finish, refuse, say, from_c, is_position, ek_ok
   implicit none(type, external)
   private
   public :: ek_parameter_count, ek_parameter_path, ek_parameter_unit, ek_parameter_is_given, ek_parameter_twin, ek_get_at, &
      ek_set_at, ek_get_all, ek_set_all, ek_get, ek_set, ek_set_text, ek_reset

contains

   integer(c_int) function ek_parameter_count(model) bind(c) result(count)
      type(c_ptr), value :: model
      type(handle_t), pointer :: handle

      handle => handle_of(model)
      count = 0
      if (is_usable(handle)) count = int(size(handle%session%numbers%x), c_int)
   end function ek_parameter_count

   type(c_ptr) function ek_parameter_path(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      type(handle_t), pointer :: handle

      handle => handle_of(model)
      address = c_null_ptr
      if (.not. is_usable(handle)) return
      if (.not. is_position(handle, k, size(handle%session%numbers%x))) return
      associate (design => handle%session%solver%design)
         !$omp critical (ek_words)
         address = say(handle, parameter_path(design%parameters%list(k + 1), design%records))
         !$omp end critical (ek_words)
      end associate
   end function ek_parameter_path

   type(c_ptr) function ek_parameter_unit(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      type(handle_t), pointer :: handle

      handle => handle_of(model)
      address = c_null_ptr
      if (.not. is_usable(handle)) return
      if (.not. is_position(handle, k, size(handle%session%numbers%x))) return
      !$omp critical (ek_words)
      address = say(handle, parameter_unit(handle%session%solver%design, k + 1))
      !$omp end critical (ek_words)
   end function ek_parameter_unit

   integer(c_int) function ek_parameter_is_given(model, k) bind(c) result(answer)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      type(handle_t), pointer :: handle

      handle => handle_of(model)
      answer = 0
      if (.not. is_usable(handle)) return
      if (is_position(handle, k, size(handle%session%numbers%x))) &
         answer = merge(1_c_int, 0_c_int, handle%session%solver%design%parameters%list(k + 1)%is_given)
   end function ek_parameter_is_given

   integer(c_int) function ek_parameter_twin(model, k) bind(c) result(twin)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      type(handle_t), pointer :: handle

      handle => handle_of(model)
      twin = -1_c_int
      if (.not. is_usable(handle)) return
      if (is_position(handle, k, size(handle%session%numbers%x))) &
         twin = int(handle%session%solver%design%parameters%list(k + 1)%tied, c_int) - 1_c_int
   end function ek_parameter_twin

   integer(c_int) function ek_get_at(model, k, value) bind(c) result(code)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      real(c_double), intent(out) :: value
      type(handle_t), pointer :: handle

      handle => handle_of(model)
      value = ieee_value(value, ieee_quiet_nan)
      code = refuse(handle, '')
      if (.not. is_usable(handle)) return
      if (.not. is_position(handle, k, size(handle%session%numbers%x))) return
      value = handle%session%numbers%value(k + 1)
      code = ek_ok
   end function ek_get_at

   integer(c_int) function ek_set_at(model, k, value) bind(c) result(code)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      real(c_double), value :: value
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error

      handle => handle_of(model)
      code = refuse(handle, '')
      if (.not. is_usable(handle)) return
      if (.not. is_position(handle, k, size(handle%session%numbers%x))) return
      call set_all(handle%session, [value], error, first=k + 1)
      code = finish(handle, error)
   end function ek_set_at

   integer(c_int) function ek_get_all(model, n, values) bind(c) result(code)
      type(c_ptr), value :: model, values
      integer(c_int), value :: n
      type(handle_t), pointer :: handle
      real(c_double), pointer :: place(:)

      handle => handle_of(model)
      call take_array(handle, n, values, place, code)
      if (code == ek_ok) place = handle%session%numbers%value
   end function ek_get_all

   integer(c_int) function ek_set_all(model, n, values) bind(c) result(code)
      type(c_ptr), value :: model, values
      integer(c_int), value :: n
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      real(c_double), pointer :: place(:)

      handle => handle_of(model)
      call take_array(handle, n, values, place, code)
      if (code /= ek_ok) return
      call set_all(handle%session, place, error)
      code = finish(handle, error)
   end function ek_set_all

   !> The array of a caller, which must have as many numbers as there are parameters.
   subroutine take_array(handle, n, values, place, code)
      type(handle_t), pointer, intent(in) :: handle
      integer(c_int), intent(in) :: n
      type(c_ptr), intent(in) :: values
      real(c_double), pointer, intent(out) :: place(:)
      integer(c_int), intent(out) :: code

      nullify (place)
      code = refuse(handle, 'the array must have as many numbers as there are parameters (ek_parameter_count)')
      if (.not. associated(handle)) return
      if (.not. handle%is_open) return
      if (n /= size(handle%session%numbers%x) .or. .not. c_associated(values)) return
      call c_f_pointer(values, place, [n])
      code = ek_ok
   end subroutine take_array

   integer(c_int) function ek_get(model, path, value) bind(c) result(code)
      type(c_ptr), value :: model, path
      real(c_double), intent(out) :: value
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      character(:), allocatable :: name

      handle => handle_of(model)
      value = ieee_value(value, ieee_quiet_nan)
      code = refuse(handle, '')
      if (.not. is_usable(handle)) return
      call from_c(path, name)
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

      handle => handle_of(model)
      code = refuse(handle, '')
      if (.not. is_usable(handle)) return
      call from_c(path, name)
      call set_number(handle%session, name, value, error)
      code = finish(handle, error)
   end function ek_set

   integer(c_int) function ek_set_text(model, path, text) bind(c) result(code)
      type(c_ptr), value :: model, path, text
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      character(:), allocatable :: name, value

      handle => handle_of(model)
      code = refuse(handle, '')
      if (.not. is_usable(handle)) return
      call from_c(path, name)
      call from_c(text, value)
      call set_text(handle%session, name, value, error)
      code = finish(handle, error)
   end function ek_set_text

   integer(c_int) function ek_reset(model) bind(c) result(code)
      type(c_ptr), value :: model
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error

      handle => handle_of(model)
      code = refuse(handle, '')
      if (.not. is_usable(handle)) return
      call reset(handle%session, error)
      code = finish(handle, error)
   end function ek_reset

end module ek_c_parameters
