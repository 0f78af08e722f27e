!> The options that say how a study is run.
module ek_study_options
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_usage
   use ek_text, only: quoted
   use ek_threads, only: processor_count
   use ek_ranks, only: ranks_t
   use ek_study_run, only: run_options_t
   use ek_command_line, only: command_line_t
   implicit none(type, external)
   private
   public :: read_options

contains

   !> --jobs (usually one thread per processor; of several ranks, one each), --shard and --time-limit.
   subroutine read_options(line, ranks, options, error)
      type(command_line_t), intent(in) :: line
      type(ranks_t), intent(in) :: ranks
      type(run_options_t), intent(out) :: options
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: text
      integer :: slash, status

      options%jobs = line%number('--jobs')
      if (options%jobs == 0) options%jobs = merge(processor_count(), 1, ranks%count == 1)
      text = line%value('--shard')
      if (text /= '') then
         slash = index(text, '/')
         status = 1
         if (slash > 1 .and. verify(text, '0123456789/') == 0) then
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

   !> '90' (seconds), '30:00' or '1:30:00'.
   subroutine read_time(text, time, error)
      character(*), intent(in) :: text
      real(wp), intent(out) :: time                  !! s
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: rest
      real(wp) :: part
      integer :: colon, status

      time = 0.0_wp
      rest = text//':'
      do
         colon = index(rest, ':')
         status = 1
         if (colon > 1 .and. verify(rest(:colon - 1), '0123456789.') == 0) read (rest(:colon - 1), *, iostat=status) part
         if (status /= 0) exit
         time = 60.0_wp*time + part
         rest = rest(colon + 1:)
         if (rest == '') exit
      end do
      if (status /= 0) call fail(error, exit_usage, '--time-limit: expected seconds or [hours:]minutes:seconds, found '// &
         quoted(text))
   end subroutine read_time

end module ek_study_options
