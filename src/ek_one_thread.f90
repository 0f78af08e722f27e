!> What OpenBLAS takes for the value of OPENBLAS_NUM_THREADS while it is loaded: in the program the function here takes the place
!> of its own of the same name (the program is linked with ENABLE_EXPORTS, so that libraries see it). No thread is begun then;
!> where none is allowed (`ulimit -u`) OpenBLAS would end the process before its main program has begun.
!>
!> Another library never asks. Not linked where OpenBLAS is an archive, whose own function would be a second one.
module ek_one_thread
   use, intrinsic :: iso_c_binding, only: c_int
   implicit none(type, external)
   private
   public :: openblas_num_threads_env

contains

   !> One; OpenBLAS calls it.
   integer(c_int) function openblas_num_threads_env() bind(c)
      openblas_num_threads_env = 1_c_int
   end function openblas_num_threads_env

end module ek_one_thread
