!> The shared libraries with which this process runs, found by the name of a symbol, for `--version` and for the plan of a study.
!> The LAPACK library is selected when the program is started, by the system's alternatives or by LD_LIBRARY_PATH, not when it is
!> compiled.
module ek_loaded_library
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_f_procpointer, c_funptr, c_null_char, c_null_ptr, &
      c_ptr
   use ek_posix, only: c_dlsym, c_dladdr, c_strlen
   implicit none(type, external)
   private
   public :: library_with, text_from_library

   abstract interface
      type(c_ptr) function text_function() bind(c)
         import :: c_ptr
         implicit none(type, external)
      end function text_function
   end interface

contains

   !> Path of the loaded library (or program) that contains a symbol; '' if no library contains it.
   function library_with(symbol) result(path)
      character(*), intent(in) :: symbol              !! name in C: 'dgemm_'
      character(:), allocatable :: path
      type(c_funptr) :: address
      type(c_ptr) :: facts(4)                         ! Dl_info: path, base address, name and address of the symbol

      path = ''
      address = c_dlsym(c_null_ptr, symbol//c_null_char)
      if (.not. c_associated(address)) return
      facts(:) = c_null_ptr
      if (c_dladdr(address, facts) /= 0) path = text_at(facts(1))
   end function library_with

   !> The string that a C function `const char *name(void)` of a loaded library returns; '' if there is no such function.
   function text_from_library(name) result(text)
      character(*), intent(in) :: name
      character(:), allocatable :: text
      type(c_funptr) :: address
      procedure(text_function), pointer :: ask

      text = ''
      address = c_dlsym(c_null_ptr, name//c_null_char)
      if (.not. c_associated(address)) return
      call c_f_procpointer(address, ask)
      text = trim(text_at(ask()))
   end function text_from_library

   !> The string at an address, up to its null character.
   function text_at(address) result(text)
      type(c_ptr), intent(in) :: address
      character(:), allocatable :: text
      character(kind=c_char), pointer :: letters(:)
      integer :: k, length

      text = ''
      if (.not. c_associated(address)) return
      length = int(c_strlen(address))
      call c_f_pointer(address, letters, [length])
      text = repeat(' ', length)
      do k = 1, length
         text(k:k) = letters(k)
      end do
   end function text_at

end module ek_loaded_library
