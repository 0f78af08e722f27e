!> One thread for the linear algebra: matrices of this size gain nothing from more threads, and a second thread of OpenBLAS,
!> once active, occupies a processor that another job of a batch queue could use. See also src/ek_one_thread.F90.
module ek_threads
   use ek_kinds, only: i8
   use ek_error, only: error_t
   use ek_system, only: ask_memory, blocks_in_memory
   use ek_loaded_library, only: has_symbol, call_library
   implicit none(type, external)
   private
   public :: use_one_thread, processor_count, threads_in_memory

   !> Bytes of the work space that OpenBLAS allocates at its first call, slightly more than 128 MB. If the allocation fails,
   !> OpenBLAS retries forever.
   integer(i8), parameter :: work_space = 2_i8**27 + 2_i8**22

   !> Bytes that a further thread requires in addition: its heap (an arena of glibc) and its stack.
   integer(i8), parameter :: heap_and_stack = 2_i8**26 + 2_i8**23

   character(*), parameter :: setter = 'openblas_set_num_threads'

contains

   !> The number of processors that this process may use; 1 in a build without OpenMP.
   integer function processor_count()
      !$ use omp_lib, only: omp_get_num_procs

      processor_count = 1
      !$ processor_count = omp_get_num_procs()
   end function processor_count

   !> The number of threads for which the free memory is sufficient, 1 to `wanted`. Without room for the work space of a thread,
   !> OpenBLAS would try again forever, and the process would not respond to SIGTERM. The first thread already has its
   !> work space, heap and stack.
   integer function threads_in_memory(wanted, bytes) result(threads)
      integer, intent(in) :: wanted
      integer(i8), intent(in) :: bytes                        !! required by a thread in addition
      integer(i8) :: further

      threads = wanted
      if (wanted < 2) return
      further = 2*bytes + heap_and_stack                      ! and the bytes of the first thread
      if (has_symbol(setter)) further = further + work_space
      threads = 1 + blocks_in_memory(wanted - 1, further)
   end function threads_in_memory

   !> Sets the number of threads of OpenBLAS to one if OpenBLAS is loaded. Other libraries have neither this function nor the work
   !> space.
   subroutine use_one_thread(error)
      type(error_t), allocatable, intent(out) :: error        !! exit_file: too little memory for the work space

      if (.not. has_symbol(setter)) return
      call ask_memory(work_space, 'the library for linear algebra', error)
      if (.not. allocated(error)) call call_library(setter, 1)
   end subroutine use_one_thread

end module ek_threads
