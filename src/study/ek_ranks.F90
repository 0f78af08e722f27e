!> The processes (ranks) that compute one study together, started by mpirun or srun. Without a launcher there is one process.
!>
!> MPI is called only if the environment shows a launcher, so that a usual run neither starts MPI nor waits for it. The ranks share
!> counters in the memory of rank 0. One counter distributes the work: the next chunk is given to the rank that requests it first.
!> Only one thread of a rank at a time may call the procedures. All ranks must call start_ranks, share, agree and end_ranks.
!>
!> The program elastokin is not linked with MPI, because the MPI libraries would make every start 2 ms longer. Under a launcher,
!> elastokin replaces itself by elastokin-mpi: the same program with this module compiled with EK_MPI. Both programs use the types
!> of this module.
module ek_ranks
   use ek_error, only: error_t, fail, exit_usage
   use ek_text, only: str
#ifndef EK_MPI
   use ek_system, only: program_folder
   use ek_file, only: join_path, file_exists
   use ek_process, only: go_on_as
#else
   use, intrinsic :: iso_c_binding, only: c_ptr, c_f_pointer
   use mpi_f08, only: MPI_Init_thread, MPI_Finalize, MPI_Comm_rank, MPI_Comm_size, MPI_Bcast, MPI_Allreduce, MPI_Barrier, &
      MPI_Iprobe, MPI_Win, MPI_Win_allocate, MPI_Win_free, MPI_Win_lock, MPI_Win_unlock, MPI_Fetch_and_op, MPI_Status, &
      MPI_COMM_WORLD, MPI_INFO_NULL, MPI_IN_PLACE, MPI_THREAD_SERIALIZED, MPI_INTEGER, MPI_CHARACTER, MPI_MIN, MPI_SUM, &
      MPI_LOCK_SHARED, MPI_LOCK_EXCLUSIVE, MPI_ADDRESS_KIND, MPI_ANY_SOURCE, MPI_ANY_TAG
#endif
   implicit none(type, external)
   private
   public :: ranks_t, start_ranks, end_ranks, count_up, share, agree, compare, help_others
   public :: ticket_counter, done_counter, failed_counter, stopped_counter

#ifndef EK_MPI
   character(*), parameter :: mpi_program = 'elastokin-mpi'
#endif

   ! what is counted over all ranks
   integer, parameter :: ticket_counter = 1, done_counter = 2, failed_counter = 3, stopped_counter = 4, counters = 4

   !> The position of this process among the processes of the study, and the access to the counters of the processes.
   type :: ranks_t
      integer :: rank = 0, count = 1              !! index of this process, 0 … count − 1; number of processes
      logical :: is_first = .true.                !! this process is rank 0, which prints and writes the tables
      logical :: has_threads = .true.             !! several threads of this rank may call MPI, one at a time
      integer, private :: values(counters) = 0    !! the counters, in a run without MPI
      logical, private :: is_started = .false.    !! MPI was started
      integer, private :: window = 0              !! MPI's handle of the window to the counters, which are in the memory of rank 0
   end type ranks_t

contains

   !> Starts all ranks. Under a launcher, elastokin first replaces itself by elastokin-mpi. If the processes of a launcher do not
   !> find each other, an error is returned, because each process would compute the whole study.
   subroutine start_ranks(ranks, error)
      type(ranks_t), intent(out) :: ranks
      type(error_t), allocatable, intent(out) :: error     !! exit_usage
      integer :: launched
      logical :: is_launched

      call look_for_launcher(is_launched, launched)
      if (.not. is_launched) then
         if (launched > 1) call fail(error, exit_usage, 'srun started this as one of '//str(launched)// &
            ' tasks without a connection: each would compute the whole study. Use '// &
            'srun --mpi=pmix, mpirun, --ntasks=1 or --shard. '// &
            'In a shell that srun --pty started: env -u SLURM_STEP_NUM_TASKS elastokin …')
         return
      end if
#ifdef EK_MPI
      call start_mpi(ranks)
      if (ranks%count == 1 .and. launched > 1) then
         call fail(error, exit_usage, 'started as one of '//str(launched)// &
            ' processes, but they do not find each other: mpirun or srun belongs to another MPI than the one with which '// &
            'this program was compiled')
      end if
#else
      if (program_folder() /= '') call go_on_as(join_path(program_folder(), mpi_program))
      if (launched > 1) call fail(error, exit_usage, 'started as one of '//str(launched)// &
         ' processes, but '//why_no_mpi()//'; use --jobs, or --shard and elastokin merge')
#endif
   end subroutine start_ranks

#ifndef EK_MPI
   !> The reason why this program was not replaced by elastokin-mpi.
   function why_no_mpi() result(text)
      character(:), allocatable :: text

      text = 'there is no '//mpi_program//' in the folder of this program (compiled without MPI)'
      if (program_folder() == '') return
      if (file_exists(join_path(program_folder(), mpi_program))) text = join_path(program_folder(), mpi_program)// &
         ' cannot be started (is it executable?)'
   end function why_no_mpi
#endif

   !> Finds whether mpirun or srun started this process with MPI, and the number of processes (1 if unknown). After srun without
   !> --mpi, is_launched is .false. and only the number of tasks is found.
   subroutine look_for_launcher(is_launched, launched)
      logical, intent(out) :: is_launched
      integer, intent(out) :: launched
      character(*), parameter :: of_slurm = 'SLURM_STEP_NUM_TASKS'
      character(*), parameter :: names(*) = [character(20) :: 'OMPI_COMM_WORLD_SIZE', 'PMI_SIZE', 'PMI_RANK', 'PMIX_RANK', &
         of_slurm]
      character(20) :: text
      integer :: k, length, status, number

      is_launched = .false.
      launched = 1
      do k = 1, size(names)
         call get_environment_variable(trim(names(k)), text, length, status)
         if (status /= 0 .or. length == 0) cycle
         if (names(k) /= of_slurm) is_launched = .true.
         if (index(names(k), 'RANK') > 0) cycle
         if (names(k) == of_slurm .and. launched > 1) cycle       ! that of mpirun, which srun has started once per node
         read (text, *, iostat=status) number
         if (status == 0) launched = max(launched, number)
      end do
   end subroutine look_for_launcher

   !> Increases a counter by `by`, which may be 0. Returns the value before the increase.
   subroutine count_up(ranks, counter, by, before)
      type(ranks_t), intent(inout) :: ranks
      integer, intent(in) :: counter              !! index of the counter, one of *_counter
      integer, intent(in) :: by
      integer, intent(out) :: before

#ifdef EK_MPI
      if (ranks%is_started) then
         call count_there(MPI_Win(ranks%window), counter, by, before)
         return
      end if
#endif
      before = ranks%values(counter)
      ranks%values(counter) = before + by
   end subroutine count_up

   !> Handles accesses of other ranks to the counters, on networks on which other ranks cannot read the memory of rank 0 without the
   !> help of rank 0. Rank 0 must call this procedure from time to time; on other ranks the procedure has no effect.
   subroutine help_others(ranks)
      type(ranks_t), intent(in) :: ranks
#ifdef EK_MPI
      type(MPI_Status) :: status
      logical :: is_there
#endif
      if (.not. ranks%is_started .or. .not. ranks%is_first) return
#ifdef EK_MPI
      call MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, is_there, status)
#endif
   end subroutine help_others

   !> Copies the list of rank 0 to all ranks. Without MPI, the list is unchanged.
   subroutine share(ranks, list)
      type(ranks_t), intent(in) :: ranks
      integer, allocatable, intent(inout) :: list(:)
      integer :: length

      length = 0
      if (allocated(list)) length = size(list)
      if (.not. ranks%is_started) return
#ifdef EK_MPI
      call MPI_Bcast(length, 1, MPI_INTEGER, 0, MPI_COMM_WORLD)
      if (.not. ranks%is_first) then
         if (allocated(list)) deallocate (list)
         allocate (list(length))
      end if
      call MPI_Bcast(list, length, MPI_INTEGER, 0, MPI_COMM_WORLD)
#endif
   end subroutine share

   !> Returns on all ranks the error of the lowest rank that has an error. On the other ranks, the message begins with the index of
   !> that rank; at most 1000 characters are returned. Without an error on any rank, no error is returned.
   subroutine agree(ranks, error)
      type(ranks_t), intent(in) :: ranks
      type(error_t), allocatable, intent(inout) :: error
      character(1000) :: text
      integer :: lowest, numbers(2)

      numbers(:) = 0
      text = ''
      if (allocated(error)) then
         numbers(:) = [error%code, min(len(error%message), len(text))]
         text = error%message
      end if
      lowest = merge(ranks%rank, ranks%count, allocated(error))
      if (.not. ranks%is_started) return
#ifdef EK_MPI
      call MPI_Allreduce(MPI_IN_PLACE, lowest, 1, MPI_INTEGER, MPI_MIN, MPI_COMM_WORLD)
      if (lowest == ranks%count) return
      call MPI_Bcast(numbers, 2, MPI_INTEGER, lowest, MPI_COMM_WORLD)
      call MPI_Bcast(text, len(text), MPI_CHARACTER, lowest, MPI_COMM_WORLD)
#endif
      if (lowest == ranks%rank) return
      if (allocated(error)) deallocate (error)
      call fail(error, numbers(1), 'rank '//str(lowest)//': '//text(:numbers(2)))
   end subroutine agree

   !> Checks that all ranks have the label of rank 0; `error` is set on all ranks if not. All ranks must call this procedure.
   subroutine compare(ranks, label, what, error)
      type(ranks_t), intent(in) :: ranks
      character(*), intent(in) :: label                    !! compared without trailing blanks, up to 4096 characters
      character(*), intent(in) :: what                     !! name of the labelled item, for the message
      type(error_t), allocatable, intent(out) :: error     !! exit_usage
      character(4096) :: first

      first = label
#ifdef EK_MPI
      if (ranks%is_started) call MPI_Bcast(first, len(first), MPI_CHARACTER, 0, MPI_COMM_WORLD)
#endif
      if (first /= label) call fail(error, exit_usage, 'the processes of one launcher must run the same study, but the '//what// &
         ' is '//trim(label)//', and of rank 0 '//trim(first)//'; to run separate studies under one launcher, give each '// &
         '--shard 1/1')
      call agree(ranks, error)
   end subroutine compare

   !> Ends MPI on all ranks. Each process then continues alone; a second call has no effect.
   subroutine end_ranks(ranks)
      type(ranks_t), intent(inout) :: ranks
#ifdef EK_MPI
      type(MPI_Win) :: window
#endif

      if (.not. ranks%is_started) return
#ifdef EK_MPI
      window = MPI_Win(ranks%window)
      call MPI_Win_free(window)
      call MPI_Finalize()
#endif
      ranks%is_started = .false.
   end subroutine end_ranks

#ifdef EK_MPI

   !> Starts MPI on all ranks, with all counters zero.
   subroutine start_mpi(ranks)
      type(ranks_t), intent(inout) :: ranks
      integer, pointer :: values(:)
      integer(MPI_ADDRESS_KIND) :: bytes
      integer :: level
      type(c_ptr) :: address
      type(MPI_Win) :: window

      call MPI_Init_thread(MPI_THREAD_SERIALIZED, level)
      ranks%is_started = .true.
      ranks%has_threads = level >= MPI_THREAD_SERIALIZED
      call MPI_Comm_rank(MPI_COMM_WORLD, ranks%rank)
      call MPI_Comm_size(MPI_COMM_WORLD, ranks%count)
      ranks%is_first = ranks%rank == 0
      bytes = counters*storage_size(1)/8
      call MPI_Win_allocate(merge(bytes, 0_MPI_ADDRESS_KIND, ranks%is_first), storage_size(1)/8, MPI_INFO_NULL, MPI_COMM_WORLD, &
         address, window)
      ranks%window = window%MPI_VAL
      if (ranks%is_first) then
         call c_f_pointer(address, values, [counters])
         call MPI_Win_lock(MPI_LOCK_EXCLUSIVE, 0, 0, window)
         values(:) = 0
         call MPI_Win_unlock(0, window)
      end if
      call MPI_Barrier(MPI_COMM_WORLD)
   end subroutine start_mpi

   !> Increases a counter in the memory of rank 0.
   subroutine count_there(window, counter, by, before)
      type(MPI_Win), intent(in) :: window
      integer, intent(in) :: counter, by
      integer, intent(out) :: before
      integer, asynchronous :: step, old

      step = by
      old = 0
      call MPI_Win_lock(MPI_LOCK_SHARED, 0, 0, window)
      call MPI_Fetch_and_op(step, old, MPI_INTEGER, 0, int(counter - 1, MPI_ADDRESS_KIND), MPI_SUM, window)
      call MPI_Win_unlock(0, window)
      before = old
   end subroutine count_there

#endif

end module ek_ranks
