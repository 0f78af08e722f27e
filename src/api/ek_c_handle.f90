!> Data of the C interface for one ek_model: a session, the last message, and the strings returned last.
module ek_c_handle
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_f_pointer, c_int, c_loc, c_null_char, c_ptr, c_size_t
   use ek_error, only: error_t, message_list_t, exit_usage
   use ek_text, only: str, quoted
   use ek_table, only: table_t, name_length
   use ek_session, only: session_t
   use ek_model_remark, only: model_remarks_t
   use ek_words, only: begin_words, end_words
   implicit none(type, external)
   private
   public :: handle_t, handle_of, open_handle, take_handle, take_array, take_names, take_text, finish, refuse, say, &
      from_c, is_position

   integer(c_int), parameter, public :: ek_ok = 0_c_int      !! code of success; the other codes are the exit_… of ek_error

   integer, parameter :: kept = 16  !! number of returned strings that remain valid, so that one call of printf may have several

   type :: text_t
      character(:), allocatable :: text
   end type text_t

   type :: handle_t
      type(session_t) :: session
      logical :: is_open = .false.                           !! whether the deck could be read
      integer(c_int) :: code = ek_ok                         !! exit code of opening the deck
      character(:), allocatable :: message                   !! message of the last call, with its '\0'
      type(text_t) :: texts(kept)                            !! strings returned last, with their '\0'
      integer :: last = 0                                    !! index of the string returned last
      type(message_list_t) :: number_names, number_units, number_definitions      !! lists of key numbers, made at first request
      type(model_remarks_t) :: remarks                       !! messages on the model at the last request
      type(table_t), allocatable :: defined                  !! table of the last solution in other definitions, if requested
      character(10) :: program = ''                          !! the program of these definitions; '' for elastokin
      integer, allocatable :: defined_rows(:)                !! of each of its columns: index in `definitions`; 0 for none
   end type handle_t

   interface
      !> Length of a C string [bytes], without the final NUL.
      integer(c_size_t) function strlen(text) bind(c, name='strlen')
         import :: c_ptr, c_size_t
         implicit none(type, external)
         type(c_ptr), value :: text
      end function strlen
   end interface

contains

   !> The handle to which the caller's pointer points; not associated for NULL.
   function handle_of(model) result(handle)
      type(c_ptr), intent(in) :: model
      type(handle_t), pointer :: handle

      nullify (handle)
      if (c_associated(model)) call c_f_pointer(model, handle)
   end function handle_of

   !> The handle of a model with a deck; the last message is cleared. The pointer is not associated for NULL, or if the deck could
   !> not be read. In the latter case the message of opening the deck is unchanged.
   function open_handle(model) result(handle)
      type(c_ptr), intent(in) :: model
      type(handle_t), pointer :: handle

      handle => handle_of(model)
      if (.not. associated(handle)) return
      if (handle%is_open) then
         handle%message = c_null_char
      else
         nullify (handle)
      end if
   end function open_handle

   !> Finds a handle as open_handle does, for a call that returns a code. The code is not ek_ok if there is no deck.
   subroutine take_handle(model, handle, code)
      type(c_ptr), intent(in) :: model
      type(handle_t), pointer, intent(out) :: handle
      integer(c_int), intent(out) :: code

      handle => open_handle(model)
      code = ek_ok
      if (.not. associated(handle)) code = refuse(handle_of(model), '')
   end subroutine take_handle

   !> Sets a pointer to an array of the caller. If the array is NULL or does not have `wanted` numbers, stores a message and returns
   !> an error code.
   subroutine take_array(handle, values, n, wanted, message, place, code)
      type(handle_t), pointer, intent(in) :: handle
      type(c_ptr), intent(in) :: values
      integer(c_int), intent(in) :: n
      integer, intent(in) :: wanted
      character(*), intent(in) :: message
      real(c_double), pointer, intent(out) :: place(:)
      integer(c_int), intent(inout) :: code

      nullify (place)
      if (n == wanted .and. c_associated(values)) then
         call c_f_pointer(values, place, [n])
      else
         code = refuse(handle, message)
      end if
   end subroutine take_array

   !> Copies a string of the caller. If the string is NULL, stores a message and returns an error code.
   subroutine take_text(handle, address, message, text, code)
      type(handle_t), pointer, intent(in) :: handle
      type(c_ptr), intent(in) :: address
      character(*), intent(in) :: message
      character(:), allocatable, intent(out) :: text
      integer(c_int), intent(inout) :: code

      call from_c(address, text)
      if (.not. c_associated(address)) code = refuse(handle, message)
   end subroutine take_text

   !> Copies a list of n names of the caller. Rejects a name that is NULL or longer than a column name can be.
   subroutine take_names(handle, names, n, found, code)
      type(handle_t), pointer, intent(in) :: handle
      type(c_ptr), intent(in) :: names                       !! not NULL if n > 0
      integer(c_int), intent(in) :: n
      character(name_length), allocatable, intent(out) :: found(:)
      integer(c_int), intent(inout) :: code
      type(c_ptr), pointer :: addresses(:)
      character(:), allocatable :: text
      integer :: k

      allocate (found(n))
      if (n == 0) return
      call c_f_pointer(names, addresses, [n])
      do k = 1, n
         call from_c(addresses(k), text)
         found(k) = text
         if (.not. c_associated(addresses(k))) then
            code = refuse(handle, 'a name in a list must not be NULL')
         else if (len(text) > name_length) then
            call begin_words()
            code = refuse(handle, quoted(text)//' is longer than '//str(name_length)//' characters')
            call end_words()
         end if
         if (code /= ek_ok) return
      end do
   end subroutine take_names

   !> The exit code of a call. The message of the call is stored in the handle.
   integer(c_int) function finish(handle, error) result(code)
      type(handle_t), intent(inout) :: handle
      type(error_t), allocatable, intent(in) :: error

      code = ek_ok
      handle%message = c_null_char
      if (.not. allocated(error)) return
      code = int(error%code, c_int)
      handle%message = error%message//c_null_char
   end function finish

   !> Exit code of a call with wrong arguments. The message is stored in the handle. If the deck could not be read, returns the exit
   !> code of opening the deck instead, and the message of opening is unchanged.
   integer(c_int) function refuse(handle, message) result(code)
      type(handle_t), pointer, intent(in) :: handle
      character(*), intent(in) :: message

      code = int(exit_usage, c_int)
      if (.not. associated(handle)) return
      if (.not. handle%is_open) then
         code = handle%code                                  ! the message is that of opening
      else
         handle%message = message//c_null_char
      end if
   end function refuse

   !> Address of a C copy of a string. The handle stores the last 16 copies.
   type(c_ptr) function say(handle, text) result(address)
      type(handle_t), pointer, intent(in) :: handle
      character(*), intent(in) :: text

      handle%last = mod(handle%last, kept) + 1
      handle%texts(handle%last)%text = text//c_null_char
      address = c_loc(handle%texts(handle%last)%text)
   end function say

   !> Whether a position, counted from 0, is inside a list. If not, a message is stored in the handle.
   logical function is_position(handle, k, count, code)
      type(handle_t), pointer, intent(in) :: handle
      integer(c_int), intent(in) :: k
      integer, intent(in) :: count
      integer(c_int), intent(inout), optional :: code        !! exit code of the call

      is_position = k >= 0 .and. k < count
      if (is_position) return
      if (present(code)) code = int(exit_usage, c_int)
      call begin_words()
      handle%message = 'position '//str(int(k))//' lies outside the list, which has '//str(count)//' entries'//c_null_char
      call end_words()
   end function is_position

   !> Copies a C string; '' for NULL.
   subroutine from_c(address, text)
      type(c_ptr), intent(in) :: address
      character(:), allocatable, intent(out) :: text
      character(kind=c_char), pointer :: letters(:)
      integer :: length, k

      length = 0
      if (c_associated(address)) length = int(strlen(address))
      allocate (character(length) :: text)
      if (length == 0) return
      call c_f_pointer(address, letters, [length])
      do k = 1, length
         text(k:k) = letters(k)
      end do
   end subroutine from_c

end module ek_c_handle
