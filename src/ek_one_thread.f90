!> Sets the number of threads of OpenBLAS to one while it is loaded: this function replaces the OpenBLAS function of the same
!> name that reads OPENBLAS_NUM_THREADS (the program is linked with ENABLE_EXPORTS, so that libraries see it). No thread is
!> then started; if threads are forbidden (`ulimit -u`), OpenBLAS would otherwise end the process before the main program.
!>
!> Other libraries do not call it. It is not linked if OpenBLAS is a static archive, as the function would be defined twice.
module ek_one_thread
   use, intrinsic :: iso_c_binding, only: c_int
   implicit none(type, external)
   private
   public :: openblas_num_threads_env

contains

   !> Returns one; called by OpenBLAS.
   integer(c_int) function openblas_num_threads_env() bind(c)
      openblas_num_threads_env = 1_c_int
   end function openblas_num_threads_env

end module ek_one_thread
