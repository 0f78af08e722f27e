!> A message in place of a backtrace when an allocation without a `stat` fails, for instance under `ulimit -v`.
!>
!> gfortran compiles such an allocation into a call of `_gfortran_os_error_at` of its library. The program defines this procedure
!> itself, so that the loader does not use the procedure of the library. Other compilers do not call it. The libraries of elastokin
!> do not contain it: a program that calls them decides for itself.
module ek_no_memory
   use, intrinsic :: iso_c_binding, only: c_int, c_int32_t
   use ek_error, only: exit_file
   use ek_system_call, only: c_exit_now
   use ek_system, only: write_bytes
   implicit none(type, external)
   private

contains

#ifdef __GFORTRAN__
   !> Prints the message and ends the program with the exit status of files. The arguments of the call are a location in the source and
   !> a message of gfortran; they are not used, as are temporary files, which the next run in their folder removes.
   subroutine end_without_memory() bind(c, name='_gfortran_os_error_at')
      character(*), parameter :: text = 'error: not enough memory (a limit of the machine or of ulimit -v)'
      integer :: ignored

      call write_bytes(2_c_int32_t, text//new_line('a'), ignored)
      call c_exit_now(int(exit_file, c_int))
   end subroutine end_without_memory
#endif

end module ek_no_memory
