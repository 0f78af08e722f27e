!> elastokin study runs a study, writes its tables, and draws its figures. elastokin merge writes the tables of a study whose shards
!> ran as separate jobs.
!>
!> The progress of a study is a line on the terminal that overwrites itself, one line per minute in a log, and --status.
module ek_study_command
   use ek_error, only: error_t, fail, exit_usage, exit_file, exit_stopped, message_list_t
   use ek_text, only: str, plural, quoted
   use ek_checksum, only: digits_of
   use ek_system, only: working_folder
   use ek_deck, only: deck_checksum
   use ek_file, only: make_folder, join_path, file_exists, is_terminal, write_standard_error
   use ek_interrupt, only: watch_for_stop
   use ek_writer, only: scratch_t, end_scratch
   use ek_study, only: step_size_kind
   use ek_factor_remark, only: factor_remarks, sample_remark
   use ek_ranks, only: ranks_t, start_ranks, end_ranks, agree, compare
   use ek_study_run, only: run_options_t, run_state_t, open_parts, run_chunks, count_parts, parts_folder, check_parts
   use ek_store, only: choose_store, store_name
   use ek_command_line, only: command_line_t
   use ek_opened_study, only: opened_study_t, open_study, plan_study, results_name
   use ek_tolerance_outcome, only: expand_study
   use ek_study_outcome, only: write_results, write_step_size, show_results
   use ek_model_remark, only: model_remarks_t, find_model_remarks
   use ek_console, only: print_note, print_warning, print_model_remarks, print_text
   use ek_run_log, only: drop_log
   use ek_kinds, only: wp
   use ek_threads, only: processor_count
   use ek_study_survey, only: survey_t, survey_parts
   use ek_study_tables, only: responses_name
   implicit none(type, external)
   private
   public :: run_study_command, run_merge_command, jobs_within

   real(wp), parameter :: pause = 60.0_wp            !! time between two lines of a log [s]

contains

   !> Runs a study. Tables are written to DIR (default: out, in the folder of the study) when all designs are finished. Until then
   !> DIR/<study>.parts contains the finished chunks, with which the next run resumes. After the tables, gnuplot runs the study's
   !> plot script, in which the variable `out` is the folder of the tables and figures. Under mpirun all ranks compute; rank 0
   !> prints and writes the tables.
   subroutine run_study_command(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(ranks_t) :: ranks
      logical :: is_first

      if (line%value('--shard') == '') call start_ranks(ranks, error)      ! a shard is one process
      is_first = ranks%is_first
      if (.not. is_first) call drop_log()
      if (.not. allocated(error)) call run_as_rank(line, ranks, error)
      call end_ranks(ranks)
      if (.not. is_first .and. allocated(error)) deallocate (error)
   end subroutine run_study_command

   !> Runs one rank of a study.
   subroutine run_as_rank(line, ranks, error)
      type(command_line_t), intent(in) :: line
      type(ranks_t), intent(inout) :: ranks
      type(error_t), allocatable, intent(out) :: error
      class(opened_study_t), allocatable :: this
      type(run_options_t) :: options
      type(message_list_t) :: tables
      logical :: has_designs, asks_status

      call read_options(line, ranks, options, error)
      if (.not. allocated(error)) call open_study(line, this, error)
      has_designs = .not. allocated(error)
      if (has_designs) has_designs = this%study%kind /= step_size_kind
      if (has_designs) call plan_study(this, error, options%shards)
      asks_status = has_designs .and. line%has('--status')
      if (has_designs .and. .not. asks_status .and. .not. allocated(error)) &
         call choose_store(this%study, this%plan, this%has_store, error)
      call agree(ranks, error)
      if (allocated(error)) return
      call compare(ranks, label_of_run(this, has_designs, asks_status), 'study', error)
      if (allocated(error)) return
      if (.not. asks_status) call make_folder(this%out, error)
      if (has_designs .and. .not. asks_status .and. ranks%is_first .and. options%shards == 1 .and. .not. allocated(error)) &
         call expand_study(this, error)
      if (has_designs .and. .not. asks_status .and. ranks%is_first .and. .not. allocated(error)) call print_doubts(this)
      call agree(ranks, error)
      if (allocated(error)) return
      if (asks_status) then
         if (ranks%is_first) call print_status(this, error)
      else if (has_designs) then
         call run_designs(line, this, options, ranks, tables, error)
      else if (ranks%is_first) then
         call write_step_size(this%study, this%deck, this%out, line%has('--quiet'), tables, error)
      end if
      call show_results(line, this, tables, error)
   end subroutine run_as_rank

   !> Label of a run, which must be the same on all ranks: study, deck with its settings, task, and folder.
   function label_of_run(this, has_designs, asks_status) result(label)
      type(opened_study_t), intent(in) :: this
      logical, intent(in) :: has_designs, asks_status
      character(:), allocatable :: label

      label = digits_of(this%study%sum)
      if (has_designs) label = this%plan%identity
      label = quoted(this%study%name)//' ('//label//', deck checksum '//deck_checksum(this%deck)//') with results in '// &
         join_path(working_folder(), this%out)
      if (asks_status) label = label//' (--status)'
   end function label_of_run

   !> Prints the warnings on the factors, and the warnings and remarks on the deck's own design.
   subroutine print_doubts(this)
      type(opened_study_t), intent(in) :: this
      type(model_remarks_t) :: remarks
      type(message_list_t) :: words
      integer :: k

      associate (workspace => this%designer%workspace)
         if (sample_remark(this%study) /= '') call words%add(sample_remark(this%study))
         call factor_remarks(this%study, workspace%definition, this%designer%paths, words)
         call find_model_remarks(workspace%suspension, workspace%raw, workspace%deck_cases, workspace%cases%case, .true., remarks)
      end associate
      do k = 1, words%count()
         call print_warning(words%line(k))
      end do
      call print_model_remarks(.true., remarks)            ! no preloads
   end subroutine print_doubts

   !> Merges the chunks of a study into its tables, and draws the figures.
   subroutine run_merge_command(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      class(opened_study_t), allocatable :: this
      type(message_list_t) :: tables
      type(scratch_t) :: hold
      character(:), allocatable :: results
      logical :: is_missing
      integer :: done

      call open_study(line, this, error)
      if (.not. allocated(error) .and. this%study%kind == step_size_kind) call fail(error, exit_usage, &
         'merge: a study of kind ''step_size'' has no shards')
      if (.not. allocated(error)) call plan_study(this, error)
      if (.not. allocated(error)) call choose_store(this%study, this%plan, this%has_store, error)
      if (.not. allocated(error)) call check_parts(this%study, this%plan, this%out, error)
      if (allocated(error)) return
      call count_parts(this%study, this%plan, this%out, done)
      results = join_path(this%out, results_name(this))
      if (done == 0 .and. this%plan%designs > 0) then
         if (file_exists(results)) then
            call fail(error, exit_file, 'merge: nothing is to be merged: there is '//results// &
               ', and no finished design in '//parts_folder(this%study, this%out))
            return
         end if
      end if
      if (done < this%plan%designs) then
         call fail(error, exit_stopped, 'merge: '//str(this%plan%designs - done)//' of '//plural(this%plan%designs, &
            'design is', 'designs are')//' missing in '//this%out//'; run the shards that did not end (a run computes only '// &
            'what is missing), or elastokin study '//line%files%line(1))
         return
      end if
      call expand_study(this, error)
      if (allocated(error)) return
      call open_parts(this%study, this%plan, this%out, hold, error)
      if (.not. allocated(error)) call write_results(line, this, hold, tables, is_missing, error)
      call end_scratch(hold)
      call show_results(line, this, tables, error)
   end subroutine run_merge_command

   !> Runs the missing designs, then writes the tables unless this run is a shard.
   subroutine run_designs(line, this, options, ranks, tables, error)
      type(command_line_t), intent(in) :: line
      type(opened_study_t), intent(inout) :: this
      type(run_options_t), intent(in) :: options
      type(ranks_t), intent(inout) :: ranks
      type(message_list_t), intent(inout) :: tables
      type(error_t), allocatable, intent(out) :: error
      type(ranks_t) :: alone
      type(scratch_t) :: hold
      logical :: is_missing

      call watch_for_stop()
      is_missing = .false.
      call compute(line, this, options, ranks, hold, error)
      call end_ranks(ranks)
      if (ranks%is_first .and. options%shards == 1) then
         if (.not. allocated(error)) call write_results(line, this, hold, tables, is_missing, error)
         call end_scratch(hold)
         if (is_missing) call compute(line, this, options, alone, hold, error)         ! another run has removed them
         if (is_missing .and. .not. allocated(error)) call write_results(line, this, hold, tables, is_missing, error)
      end if
      call end_scratch(hold)
   end subroutine run_designs

   !> Runs the missing designs. All ranks must call this procedure.
   subroutine compute(line, this, options, ranks, hold, error)
      type(command_line_t), intent(in) :: line
      type(opened_study_t), intent(inout) :: this
      type(run_options_t), intent(in) :: options
      type(ranks_t), intent(inout) :: ranks
      type(scratch_t), intent(inout) :: hold               !! lock on the folder of the chunks
      type(error_t), allocatable, intent(out) :: error
      type(run_state_t) :: state
      logical :: is_quiet

      is_quiet = line%has('--quiet') .or. .not. ranks%is_first
      if (ranks%is_first) call open_parts(this%study, this%plan, this%out, hold, error)
      call agree(ranks, error)
      if (allocated(error)) return
      if (.not. ranks%is_first) then                       ! the same study? Rank 0 keeps the folder
         call open_parts(this%study, this%plan, this%out, hold, error)
         call end_scratch(hold)
      end if
      call agree(ranks, error)
      if (allocated(error)) return
      call run_chunks(this%study, this%plan, this%deck, this%out, hold, options, this%designer, ranks, state, show_state, error)
      call end_state(state)
      if (allocated(error)) return
      if (state%idle > 0) call print_note(is_quiet, 'the memory did not suffice for '//plural(state%idle, 'more thread', &
         'more threads')//' (a limit of the machine or of ulimit -v)')
      if (state%before > 0) call print_note(is_quiet, str(state%before)//' of '// &
         plural(state%wanted, 'design was', 'designs were')//' done before')
      if (state%is_stopped) then
         call fail(error, exit_stopped, 'stopped: '//str(state%done)//' of '//plural(state%wanted, 'design is', &
            'designs are')//' done and stored; run the same command again to resume')
         if (ranks%count == 1) return
         call print_note(is_quiet, error%message)          ! a launcher that was stopped may not let this process end in order
         error%message = 'the study is not complete'
      else if (options%shards > 1) then
         call print_note(is_quiet, 'shard '//str(options%shard)//' of '//str(options%shards)//' is done: '// &
            plural(state%wanted, 'design', 'designs')//'; when all are, elastokin merge '//line%files%line(1))
      end if
   end subroutine compute

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

   !> Shows the progress: on a terminal in a line that overwrites itself, otherwise as one line per minute.
   subroutine show_state(state)
      type(run_state_t), intent(inout) :: state

      if (state%is_quiet) return
      if (is_terminal(2)) then
         call write_standard_error(achar(13)//'  '//state_text(state)//'   ')
      else if (state%now - state%reported > pause) then
         state%reported = state%now
         call print_note(state%is_quiet, state_text(state))
      end if
   end subroutine show_state

   !> Clears the progress line.
   subroutine end_state(state)
      type(run_state_t), intent(in) :: state
      if (is_terminal(2) .and. .not. state%is_quiet) call write_standard_error(achar(13)//repeat(' ', 78)//achar(13))
   end subroutine end_state

   !> Progress as a line: '1200 of 5000 designs, 850/s, 4 s left, 3 failed'. The rate is the rate of this run only.
   function state_text(state) result(text)
      type(run_state_t), intent(in) :: state
      character(:), allocatable :: text
      real(wp) :: rate

      rate = (state%done - state%before)/max(state%now - state%begun, 1.0e-6_wp)
      text = str(state%done)//' of '//plural(state%wanted, 'design', 'designs')//', '// &
         rate_text(rate, state%wanted - state%done)//str(state%failed)//' failed'
   end function state_text

   !> Rate and remaining time: '850/s, 4 s left, '; '' if the rate is unknown.
   function rate_text(rate, left) result(text)
      real(wp), intent(in) :: rate                   !! designs per second
      integer, intent(in) :: left                    !! designs
      character(:), allocatable :: text

      text = ''
      if (.not. rate > 0.0_wp) return
      if (rate < 99.5_wp) text = str(rate, 2)
      if (.not. rate < 99.5_wp) text = str(nint(rate))
      text = text//'/s, '//time_text(left/rate)//' left, '
   end function rate_text

   !> A time in suitable units: '45 s', '12 min', '3.5 h'.
   function time_text(time) result(text)
      real(wp), intent(in) :: time                   !! s
      character(:), allocatable :: text

      if (time < 120.0_wp) then
         text = str(nint(time))//' s'
      else if (time < 7200.0_wp) then
         text = str(nint(time/60.0_wp))//' min'
      else
         text = str(time/3600.0_wp, 3)//' h'
      end if
   end function time_text

   !> Prints the progress of a study that another process may be running.
   subroutine print_status(this, error)
      type(opened_study_t), intent(in) :: this
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: name
      logical :: has_table, has_store
      type(survey_t) :: now

      call survey_parts(this%study, this%plan, this%out, now)
      call choose_store(this%study, this%plan, has_store, error)
      name = responses_name(this%study)
      if (has_store) name = store_name(this%study)
      if (allocated(error)) return
      has_table = file_exists(join_path(this%out, name))
      if (now%done == 0 .and. has_table) then
         call print_text('study '//this%study%name//': complete, '//join_path(this%out, name)//new_line('a'), error)
      else
         name = 'study '//this%study%name//': '//str(now%done)//' of '//plural(this%plan%designs, 'design', 'designs')// &
            ' done, '
         if (now%is_at_work) name = name//rate_text(now%rate, this%plan%designs - now%done)
         name = name//str(now%failed)//' failed'
         if (.not. now%is_at_work) name = name//'; no run is at work'
         call print_text(name//new_line('a'), error)
      end if
   end subroutine print_status

end module ek_study_command
