!> Sets the number of threads of OpenBLAS to one while it is loaded: this function replaces the OpenBLAS function of the same
!> name that reads OPENBLAS_NUM_THREADS. No thread is then started; if threads are forbidden (`ulimit -u`), OpenBLAS would
!> otherwise end the process before the main program. Other libraries do not call it.
!>
!> A shared OpenBLAS finds it because the program shows it to libraries; in an archive of OpenBLAS (EK_BLAS_ARCHIVE) the linker
!> replaces the call (`ld --wrap`). This file is not compiled for optimisation at link time, which does not see these calls.
module ek_one_thread
   use, intrinsic :: iso_c_binding, only: c_int
   implicit none(type, external)
   private
   public :: openblas_num_threads_env

#ifdef EK_BLAS_ARCHIVE
   character(*), parameter :: symbol = '__wrap_openblas_num_threads_env'
#else
   character(*), parameter :: symbol = 'openblas_num_threads_env'
#endif

contains

   !> Returns one; called by OpenBLAS.
   integer(c_int) function openblas_num_threads_env() bind(c, name=symbol)
      openblas_num_threads_env = 1_c_int
   end function openblas_num_threads_env

end module ek_one_thread
