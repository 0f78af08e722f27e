!> The C interface (include/elastokin.h): copies of a model, and the files that it was read from.
module ek_c_copy
   use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_int, c_null_ptr, c_ptr
   use ek_error, only: error_t
   use ek_kept_files, only: kept_files_t, add_file
   use ek_session, only: copy_session, open_files, used_deck
   use ek_c_handle, only: handle_t, open_handle, take_handle, finish, refuse, say, from_c, is_position, ek_ok
   use ek_c_model, only: new_handle
   use ek_words, only: begin_words, end_words
   implicit none(type, external)
   private
   public :: ek_copy, ek_file_count, ek_file_path, ek_file_text, ek_open_files, ek_deck_as_used

contains

   !> Exit code after copying a deck, with its changes, into a new handle (elastokin.h).
   integer(c_int) function ek_copy(model, copy) bind(c) result(code)
      type(c_ptr), value :: model
      type(c_ptr), value :: copy                   !! address at which the handle is stored
      type(handle_t), pointer :: handle, other
      type(error_t), allocatable :: error

      call take_handle(model, handle, code)
      if (code == ek_ok .and. .not. c_associated(copy)) code = refuse(handle, 'copy must not be NULL')
      if (code /= ek_ok) return
      call new_handle(copy, other, code)
      if (code /= ek_ok) return
      call copy_session(handle%session, other%session, error)
      code = finish(other, error)
      other%code = code
      other%is_open = code == ek_ok
   end function ek_copy

   !> Number of files of the deck: the deck and all files that it names. 0 if the deck could not be read.
   integer(c_int) function ek_file_count(model) bind(c) result(count)
      type(c_ptr), value :: model
      type(handle_t), pointer :: handle

      handle => open_handle(model)
      count = 0
      if (associated(handle)) count = int(handle%session%original%kept%count(), c_int)
   end function ek_file_count

   !> Path of file k, from 0, as a C string; NULL outside the list.
   type(c_ptr) function ek_file_path(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_file(open_handle(model), k, .true.)
   end function ek_file_path

   !> Content of file k, from 0, as a C string; NULL outside the list.
   type(c_ptr) function ek_file_text(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_file(open_handle(model), k, .false.)
   end function ek_file_text

   !> Path or content of file k of the deck as a C string.
   type(c_ptr) function text_of_file(handle, k, is_path) result(address)
      type(handle_t), pointer, intent(in) :: handle
      integer(c_int), intent(in) :: k
      logical, intent(in) :: is_path

      address = c_null_ptr
      if (.not. associated(handle)) return
      if (.not. is_position(handle, k, handle%session%original%kept%count())) return
      call begin_words()
      if (is_path) then
         address = say(handle, handle%session%original%kept%path(k + 1))
      else
         address = say(handle, handle%session%original%kept%text(k + 1))
      end if
      call end_words()
   end function text_of_file

   !> Exit code after reading a deck from given file contents into a new handle (elastokin.h).
   integer(c_int) function ek_open_files(n, paths, texts, model) bind(c) result(code)
      integer(c_int), value :: n
      type(c_ptr), value :: paths, texts
      type(c_ptr), value :: model                  !! address at which the handle is stored
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      type(kept_files_t) :: files
      type(c_ptr), pointer :: path(:), text(:)
      character(:), allocatable :: name, content
      logical :: is_good
      integer :: k

      call new_handle(model, handle, code)
      if (code /= ek_ok) return
      is_good = n > 0 .and. c_associated(paths) .and. c_associated(texts)
      if (is_good) then
         call c_f_pointer(paths, path, [n])
         call c_f_pointer(texts, text, [n])
         do k = 1, n
            is_good = is_good .and. c_associated(path(k)) .and. c_associated(text(k))
            call from_c(path(k), name)
            call from_c(text(k), content)
            call add_file(files, name, content)
         end do
      end if
      if (is_good) then
         call open_files(files, handle%session, error)
         code = finish(handle, error)
      else
         handle%is_open = .true.
         code = refuse(handle, 'n must be positive, and paths, texts and their entries must not be NULL')
      end if
      handle%code = code
      handle%is_open = code == ek_ok
   end function ek_open_files

   !> The deck with its present numbers as one C string; NULL if the model is not valid.
   type(c_ptr) function ek_deck_as_used(model) bind(c) result(address)
      type(c_ptr), value :: model
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      character(:), allocatable :: text

      handle => open_handle(model)
      address = c_null_ptr
      if (.not. associated(handle)) return
      call used_deck(handle%session, text, error)
      if (finish(handle, error) == ek_ok) address = say(handle, text)
   end function ek_deck_as_used

end module ek_c_copy
