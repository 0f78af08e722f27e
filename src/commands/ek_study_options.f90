!> The options that control the run of a study.
module ek_study_options
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_usage
   use ek_text, only: quoted, str
   use ek_console, only: print_note
   use ek_threads, only: processor_count
   use ek_ranks, only: ranks_t
   use ek_study_run, only: run_options_t
   use ek_command_line, only: command_line_t
   implicit none(type, external)
   private
   public :: read_options, jobs_within

contains

   !> Reads --jobs, --shard and --time-limit. The default of --jobs is one thread per processor, but no more than the environment
   !> allows; with several ranks, one thread per rank.
   subroutine read_options(line, ranks, options, error)
      type(command_line_t), intent(in) :: line
      type(ranks_t), intent(in) :: ranks
      type(run_options_t), intent(out) :: options
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: text
      integer :: slash, status

      options%jobs = line%number('--jobs')
      if (options%jobs > processor_count() .and. ranks%is_first) call print_note(line%has('--quiet'), '--jobs '// &
         str(options%jobs)//': more threads than processors ('//str(processor_count())//') make a study no faster')
      if (options%jobs == 0) options%jobs = merge(usual_jobs(), 1, ranks%count == 1)
      text = line%value('--shard')
      if (text /= '') then
         slash = index(text, '/')
         status = 1
         if (slash > 1 .and. slash == index(text, '/', back=.true.) .and. verify(text, '0123456789/') == 0) then
            read (text(:slash - 1), *, iostat=status) options%shard
            if (status == 0) read (text(slash + 1:), *, iostat=status) options%shards
         end if
         if (status /= 0 .or. options%shard < 1 .or. options%shard > options%shards) then
            call fail(error, exit_usage, '--shard: expected i/n, 1 to n of n, for instance 2/4, found '//quoted(text))
            return
         end if
      end if
      text = line%value('--time-limit')
      if (text /= '') call read_time(text, options%time_limit, error)
      options%is_quiet = line%has('--quiet')
   end subroutine read_options

   !> Default number of threads: one per processor, but no more than the environment allows.
   integer function usual_jobs() result(jobs)
      jobs = jobs_within(processor_count(), variable('OMP_NUM_THREADS'), variable('SLURM_CPUS_PER_TASK'))
   end function usual_jobs

   !> The value of an environment variable; '' if it is not set.
   function variable(name) result(text)
      character(*), intent(in) :: name
      character(:), allocatable :: text
      integer :: length

      call get_environment_variable(name, length=length)
      allocate (character(length) :: text)
      if (length > 0) call get_environment_variable(name, value=text)
   end function variable

   !> Number of threads: the number of processors, or fewer if OMP_NUM_THREADS (the first number of its list) or the number of
   !> processors that Slurm assigned to the task is smaller.
   pure integer function jobs_within(processors, openmp, slurm) result(jobs)
      integer, intent(in) :: processors
      character(*), intent(in) :: openmp, slurm  !! '' if the variable is not set; a string that is not a number above 0 is ignored
      integer :: limit, status, k

      jobs = processors
      do k = 1, 2
         status = 1
         if (k == 1 .and. openmp /= '') read (openmp, *, iostat=status) limit
         if (k == 2 .and. slurm /= '') read (slurm, *, iostat=status) limit
         if (status /= 0) cycle
         if (limit > 0) jobs = min(jobs, limit)
      end do
   end function jobs_within

   !> Reads a time as '90' (seconds), '30:00' or '1:30:00'.
   subroutine read_time(text, time, error)
      character(*), intent(in) :: text
      real(wp), intent(out) :: time                  !! s
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: rest
      real(wp) :: part
      integer :: colon, status, parts

      time = 0.0_wp
      parts = 0
      rest = text//':'
      do
         colon = index(rest, ':')
         status = 1
         if (colon > 1 .and. verify(rest(:colon - 1), '0123456789.') == 0) read (rest(:colon - 1), *, iostat=status) part
         if (status /= 0) exit
         parts = parts + 1
         if (parts > 3) status = 1
         if (status /= 0) exit
         time = 60.0_wp*time + part
         rest = rest(colon + 1:)
         if (rest == '') exit
      end do
      if (status /= 0) call fail(error, exit_usage, '--time-limit: expected seconds or [hours:]minutes:seconds, found '// &
         quoted(text))
   end subroutine read_time

end module ek_study_options
