!> The C interface (include/elastokin.h): messages on a model.
module ek_c_remarks
   use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_int, c_null_ptr, c_ptr
   use ek_error, only: error_t
   use ek_model_remark, only: read_model_remark
   use ek_session, only: find_remarks
   use ek_c_handle, only: handle_t, open_handle, take_handle, finish, refuse, say, is_position, ek_ok
   use ek_words, only: begin_words, end_words
   implicit none(type, external)
   private
   public :: ek_model_remarks_c, ek_model_remark_text, ek_model_remark_severity

contains

   !> Exit code after examining the model; `count` receives the number of messages.
   integer(c_int) function ek_model_remarks_c(model, count) bind(c, name='ek_model_remarks') result(code)
      type(c_ptr), value :: model, count
      type(handle_t), pointer :: handle
      type(error_t), allocatable :: error
      integer(c_int), pointer :: place

      call take_handle(model, handle, code)
      if (code == ek_ok .and. .not. c_associated(count)) code = refuse(handle, 'count must not be NULL')
      if (code /= ek_ok) return
      call find_remarks(handle%session, handle%remarks, error)
      call c_f_pointer(count, place)
      place = int(handle%remarks%count(), c_int)
      code = finish(handle, error)
   end function ek_model_remarks_c

   !> Message k on the model, from 0, as a C string; NULL outside the list.
   type(c_ptr) function ek_model_remark_text(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_remark(open_handle(model), k, is_severity=.false.)
   end function ek_model_remark_text

   !> Severity of message k on the model, from 0, as a C string: note, warning or failure; NULL outside the list.
   type(c_ptr) function ek_model_remark_severity(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      address = text_of_remark(open_handle(model), k, is_severity=.true.)
   end function ek_model_remark_severity

   !> A message from the list that ek_model_remarks has created, or the severity of the message.
   type(c_ptr) function text_of_remark(handle, k, is_severity) result(address)
      type(handle_t), pointer, intent(in) :: handle
      integer(c_int), intent(in) :: k
      logical, intent(in) :: is_severity
      character(:), allocatable :: text, severity

      address = c_null_ptr
      if (.not. associated(handle)) return
      if (.not. is_position(handle, k, handle%remarks%count())) return
      call begin_words()
      call read_model_remark(handle%remarks, k + 1, text, severity)
      if (is_severity) text = severity
      address = say(handle, text)
      call end_words()
   end function text_of_remark

end module ek_c_remarks
