!> An element as messages name it. It is not in `ek_element`: that is a kernel, and kernels make no texts.
module ek_element_label
   use ek_text, only: quoted
   use ek_element, only: element_t, element_kinds
   implicit none(type, external)
   private
   public :: element_label

contains

   !> "spring 'coil'"
   pure function element_label(element) result(text)
      type(element_t), intent(in) :: element
      character(:), allocatable :: text
      text = trim(element_kinds(element%kind)%label)//' '//quoted(element%name)
   end function element_label

end module ek_element_label
