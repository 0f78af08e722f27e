!> The C interface (include/elastokin.h): the library, opening and closing a model, its cases.
module ek_c_model
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_int, c_loc, c_null_char, c_null_ptr, c_ptr
   use ek_error, only: error_t, exit_usage, exit_file
   use ek_version, only: version
   use ek_threads, only: use_one_thread
   use ek_session, only: open_file, open_text, checksum_of
   use ek_c_handle, only: handle_t, handle_of, open_handle, finish, say, from_c, is_position, ek_ok
   use ek_words, only: begin_words, end_words
   implicit none(type, external)
   private
   public :: ek_version_text, ek_use_one_thread, ek_open_file, ek_open_text, ek_close, ek_message, ek_name, ek_checksum, &
      ek_wheel_count, ek_case_count, ek_case_name, ek_case_is_of_deck, new_handle

   character(len=len(version) + 1, kind=c_char), save, target :: version_text = version//c_null_char      ! never changed

contains

   !> Version of the library as a C string.
   type(c_ptr) function ek_version_text() bind(c, name='ek_version') result(address)
      address = c_loc(version_text)
   end function ek_version_text

   !> Exit code after setting OpenBLAS to one thread (elastokin.h).
   integer(c_int) function ek_use_one_thread() bind(c) result(code)
      type(error_t), allocatable :: error

      call begin_words()
      call use_one_thread(error)
      call end_words()
      code = ek_ok
      if (allocated(error)) code = int(error%code, c_int)
   end function ek_use_one_thread

   !> Exit code after reading a deck from a file into a new handle (elastokin.h).
   integer(c_int) function ek_open_file(path, model) bind(c) result(code)
      type(c_ptr), value :: path
      type(c_ptr), value :: model                  !! address at which the handle is stored
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      character(:), allocatable :: name

      call new_handle(model, handle, code)
      if (code /= ek_ok) return
      if (.not. c_associated(path)) then
         code = int(exit_usage, c_int)
         handle%message = 'the path is NULL'//c_null_char
      else
         call from_c(path, name)
         call open_file(name, handle%session, error)
         code = finish(handle, error)
      end if
      handle%code = code
      handle%is_open = code == ek_ok
   end function ek_open_file

   !> Exit code after reading a deck from a string into a new handle (elastokin.h).
   integer(c_int) function ek_open_text(text, name, model) bind(c) result(code)
      type(c_ptr), value :: text, name
      type(c_ptr), value :: model                  !! address at which the handle is stored
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      character(:), allocatable :: deck, file

      call new_handle(model, handle, code)
      if (code /= ek_ok) return
      if (.not. c_associated(text)) then
         code = int(exit_usage, c_int)
         handle%message = 'the text is NULL'//c_null_char
      else
         call from_c(text, deck)
         call from_c(name, file)
         if (len(file) == 0) file = 'deck'
         call open_text(deck, file, handle%session, error)
         code = finish(handle, error)
      end if
      handle%code = code
      handle%is_open = code == ek_ok
   end function ek_open_text

   !> Creates a handle and stores its address in the variable of the caller.
   subroutine new_handle(model, handle, code)
      type(c_ptr), intent(in) :: model
      type(handle_t), pointer, intent(out) :: handle
      integer(c_int), intent(out) :: code
      type(c_ptr), pointer :: place
      integer :: status

      nullify (handle)
      code = int(exit_usage, c_int)
      if (.not. c_associated(model)) return
      call c_f_pointer(model, place)
      place = c_null_ptr
      allocate (handle, stat=status)
      code = merge(ek_ok, int(exit_file, c_int), status == 0)
      if (status /= 0) return
      handle%message = c_null_char
      place = c_loc(handle)
   end subroutine new_handle

   !> Closes a handle; does nothing for NULL (elastokin.h).
   subroutine ek_close(model) bind(c)
      type(c_ptr), value :: model
      type(handle_t), pointer :: handle

      handle => handle_of(model)
      if (associated(handle)) deallocate (handle)
   end subroutine ek_close

   !> Message of the last call as a C string; empty if the call succeeded.
   type(c_ptr) function ek_message(model) bind(c) result(address)
      type(c_ptr), value :: model
      character(len=22, kind=c_char), save, target :: no_model = 'there is no ek_model '//c_null_char      ! never changed
      type(handle_t), pointer :: handle

      handle => handle_of(model)
      address = c_loc(no_model)
      if (associated(handle)) address = c_loc(handle%message)
   end function ek_message

   !> Name of the model as a C string.
   type(c_ptr) function ek_name(model) bind(c) result(address)
      type(c_ptr), value :: model
      type(handle_t), pointer :: handle

      handle => open_handle(model)
      address = c_null_ptr
      if (.not. associated(handle)) return
      address = say(handle, handle%session%workspace%raw%name)
   end function ek_name

   !> Checksum of the deck with its present numbers as a C string.
   type(c_ptr) function ek_checksum(model) bind(c) result(address)
      type(c_ptr), value :: model
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      character(16) :: digits

      handle => open_handle(model)
      address = c_null_ptr
      if (.not. associated(handle)) return
      call checksum_of(handle%session, digits, error)
      if (finish(handle, error) == ek_ok) address = say(handle, digits)
   end function ek_checksum

   integer(c_int) function ek_wheel_count(model) bind(c) result(count)
      type(c_ptr), value :: model
      type(handle_t), pointer :: handle

      handle => open_handle(model)
      count = 0
      if (associated(handle)) count = int(size(handle%session%workspace%raw%wheels), c_int)
   end function ek_wheel_count

   integer(c_int) function ek_case_count(model) bind(c) result(count)
      type(c_ptr), value :: model
      type(handle_t), pointer :: handle

      handle => open_handle(model)
      count = 0
      if (associated(handle)) count = int(size(handle%session%workspace%cases), c_int)
   end function ek_case_count

   type(c_ptr) function ek_case_name(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      type(handle_t), pointer :: handle

      handle => open_handle(model)
      address = c_null_ptr
      if (.not. associated(handle)) return
      if (is_position(handle, k, size(handle%session%workspace%cases))) &
         address = say(handle, handle%session%workspace%cases(k + 1)%case%name)
   end function ek_case_name

   integer(c_int) function ek_case_is_of_deck(model, k) bind(c) result(answer)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      type(handle_t), pointer :: handle

      handle => open_handle(model)
      answer = 0
      if (.not. associated(handle)) return
      if (is_position(handle, k, size(handle%session%workspace%cases))) &
         answer = merge(1_c_int, 0_c_int, handle%session%workspace%cases(k + 1)%number > 0)
   end function ek_case_is_of_deck

end module ek_c_model
