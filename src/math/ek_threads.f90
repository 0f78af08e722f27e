!> One thread for the linear algebra: matrices of this size gain nothing from more, and OpenBLAS's second
!> thread, once woken, spins on a processor that another job of a batch queue could use.
module ek_threads
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_procpointer, c_funptr, c_int, c_null_char, c_null_ptr, c_ptr
   implicit none(type, external)
   private
   public :: use_one_thread

   abstract interface
      subroutine set_threads(count) bind(c)
         import :: c_int
         implicit none(type, external)
         integer(c_int), value :: count
      end subroutine set_threads
   end interface

   interface
      !> Address of a symbol in what is loaded (handle null: anywhere).
      type(c_funptr) function dlsym(handle, name) bind(c, name='dlsym')
         import :: c_char, c_funptr, c_ptr
         implicit none(type, external)
         type(c_ptr), value :: handle
         character(kind=c_char), intent(in) :: name(*)
      end function dlsym
   end interface

contains

   !> Tells OpenBLAS, if that is the library this process runs with; another has no such switch.
   subroutine use_one_thread()
      type(c_funptr) :: address
      procedure(set_threads), pointer :: openblas_set_num_threads

      address = dlsym(c_null_ptr, 'openblas_set_num_threads'//c_null_char)
      if (.not. c_associated(address)) return
      call c_f_procpointer(address, openblas_set_num_threads)
      call openblas_set_num_threads(1_c_int)
   end subroutine use_one_thread

end module ek_threads
