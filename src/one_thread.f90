!> What OpenBLAS takes for the value of OPENBLAS_NUM_THREADS while it is loaded: in the program this function takes the place
!> of its own of the same name (the program is linked with ENABLE_EXPORTS, so that libraries see it). No thread is begun then;
!> where none is allowed (`ulimit -u`) OpenBLAS would end the process before its main program has begun.
!>
!> Another library never asks. Not linked where OpenBLAS is an archive, whose own function would be a second one.
integer(c_int) function openblas_num_threads_env() bind(c)
   use, intrinsic :: iso_c_binding, only: c_int
   implicit none(type, external)

   openblas_num_threads_env = 1_c_int
end function openblas_num_threads_env
