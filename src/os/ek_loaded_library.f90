!> The shared libraries with which this process runs, found by the name of a symbol, for `--version`, for the plan of a study and
!> for the number of threads. The LAPACK library is selected when the program is started, by the system's alternatives or by
!> LD_LIBRARY_PATH, not when it is compiled.
module ek_loaded_library
   use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_null_char
   use ek_system_call, only: c_has_symbol, c_library_with, c_text_of, c_call, text_of
   implicit none(type, external)
   private
   public :: has_symbol, library_with, text_from_library, call_library

   integer(c_int32_t), parameter :: most = 4096       !! characters of the longest path or text

contains

   !> Whether a loaded library, or the program, contains a symbol.
   logical function has_symbol(symbol)
      character(*), intent(in) :: symbol              !! name in C: 'dgemm_'
      has_symbol = c_has_symbol(symbol//c_null_char) /= 0
   end function has_symbol

   !> Path of the loaded library (or program) that contains a symbol; '' if no library contains it.
   function library_with(symbol) result(path)
      character(*), intent(in) :: symbol              !! name in C
      character(:), allocatable :: path
      character(kind=c_char) :: letters(most)
      integer :: length

      length = c_library_with(symbol//c_null_char, letters, most)
      path = text_of(letters, length)
   end function library_with

   !> The string that a C function `const char *name(void)` of a loaded library returns; '' if there is no such function.
   function text_from_library(name) result(text)
      character(*), intent(in) :: name
      character(:), allocatable :: text
      character(kind=c_char) :: letters(most)
      integer :: length

      length = c_text_of(name//c_null_char, letters, most)
      text = trim(text_of(letters, length))
   end function text_from_library

   !> Runs a C function `void name(int)` of a loaded library; without such a function, there is no effect.
   subroutine call_library(name, argument)
      character(*), intent(in) :: name
      integer, intent(in) :: argument
      call c_call(name//c_null_char, int(argument, c_int32_t))
   end subroutine call_library

end module ek_loaded_library
