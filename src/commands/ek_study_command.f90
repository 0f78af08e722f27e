!> elastokin study runs a study, writes its tables, and draws its figures. elastokin merge writes the tables of a study whose shards
!> ran as separate jobs.
module ek_study_command
   use ek_error, only: error_t, fail, exit_usage, exit_file, exit_stopped, message_list_t
   use ek_text, only: str, plural, quoted
   use ek_checksum, only: digits_of
   use ek_system, only: working_folder
   use ek_deck, only: deck_checksum
   use ek_file, only: make_folder, join_path, file_exists
   use ek_interrupt, only: watch_for_stop
   use ek_writer, only: scratch_t, end_scratch
   use ek_study, only: step_size_kind
   use ek_factor_remark, only: factor_remarks, sample_remark
   use ek_ranks, only: ranks_t, start_ranks, end_ranks, agree, compare
   use ek_study_run, only: run_options_t, run_state_t, open_parts, run_chunks, count_parts, parts_folder, &
      check_parts
   use ek_store, only: choose_store
   use ek_command_line, only: command_line_t
   use ek_study_options, only: read_options
   use ek_opened_study, only: opened_study_t, open_study, plan_study, results_name
   use ek_tolerance_outcome, only: expand_study
   use ek_study_progress, only: show_state, end_state, print_status
   use ek_study_outcome, only: write_results, write_step_size, show_results
   use ek_model_remark, only: model_remarks_t, find_model_remarks
   use ek_console, only: print_note, print_warning, print_model_remarks
   use ek_run_log, only: drop_log
   implicit none(type, external)
   private
   public :: run_study_command, run_merge_command

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
         call factor_remarks(this%study, workspace%design, this%designer%paths, words)
         call find_model_remarks(workspace%suspension, workspace%raw, workspace%design%cases, workspace%cases%case, .true., remarks)
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

end module ek_study_command
