!> elastokin study: runs a study, writes its tables, and draws its figures; elastokin merge: the tables of a study whose shards ran
!> as separate jobs.
module ek_study_command
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_usage, exit_convergence, message_list_t
   use ek_text, only: str, plural, quoted
   use ek_clock, only: seconds
   use ek_file, only: make_folder, join_path, folder_name, file_exists, program_exists, is_terminal, write_standard_error
   use ek_interrupt, only: watch_for_stop
   use ek_deck, only: deck_t
   use ek_writer, only: writer_t, begin_file, remove_stale, scratch_t, end_scratch
   use ek_drawing, only: run_plot_script
   use ek_sampler_kind, only: sampler_kinds
   use ek_study, only: study_t, step_size_kind, kind_names
   use ek_study_reader, only: read_study
   use ek_study_each, only: expand_factors
   use ek_study_design, only: designer_t, new_designer
   use ek_ranks, only: ranks_t, start_ranks, end_ranks, agree
   use ek_study_plan, only: study_plan_t, new_plan
   use ek_study_run, only: run_options_t, run_state_t, open_parts, run_chunks, count_parts, remove_parts, parts_folder
   use ek_study_tables, only: study_counts_t, write_tables, count_designs, responses_name, curves_name, has_limits
   use ek_store, only: store_texts_t, keep_texts, choose_store, write_store, store_name
   use ek_chunk, only: status_names, design_invalid
   use ek_step_size, only: step_size_text
   use ek_command_line, only: command_line_t
   use ek_study_options, only: read_options
   use ek_load_deck, only: read_changed
   use ek_plot, only: draw_study
   use ek_console, only: print_note, print_warning, print_error, print_path, print_text
   implicit none(type, external)
   private
   public :: run_study_command, run_merge_command

   character(*), parameter :: nl = new_line('a')

   !> A study that was read, with its folders.
   type :: opened_t
      type(study_t) :: study
      type(deck_t) :: deck
      character(:), allocatable :: home, out         !! folder of the study; of its results
      type(designer_t) :: designer
      type(study_plan_t) :: plan
      logical :: has_store = .false.                 !! the results go into a NetCDF file
      type(store_texts_t) :: texts
   end type opened_t

contains

   !> Tables are written to DIR (default: out, beside the study) when all designs are done; until then DIR/<study>.parts holds the
   !> finished chunks, with which the next run goes on. gnuplot then runs the study's plot script; its variable `out` is the
   !> folder of the tables and figures. Under mpirun all ranks compute; rank 0 prints and writes the tables.
   subroutine run_study_command(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(ranks_t) :: ranks
      logical :: is_first

      if (line%value('--shard') == '') call start_ranks(ranks, error)      ! a shard is one process
      is_first = ranks%is_first
      if (.not. allocated(error)) call run_as_rank(line, ranks, error)
      call end_ranks(ranks)
      if (.not. is_first .and. allocated(error)) deallocate (error)
   end subroutine run_study_command

   !> One rank of a study.
   subroutine run_as_rank(line, ranks, error)
      type(command_line_t), intent(in) :: line
      type(ranks_t), intent(inout) :: ranks
      type(error_t), allocatable, intent(out) :: error
      type(opened_t) :: this
      type(run_options_t) :: options
      type(message_list_t) :: tables
      logical :: has_designs, asks_status

      call read_options(line, ranks, options, error)
      if (.not. allocated(error)) call open_study(line, this, error)
      has_designs = .not. allocated(error)
      if (has_designs) has_designs = this%study%kind /= step_size_kind
      if (has_designs) call prepare(this, error)
      asks_status = has_designs .and. line%has('--status')
      if (has_designs .and. .not. asks_status .and. .not. allocated(error)) &
         call choose_store(this%study, this%plan, this%has_store, error)
      if (.not. asks_status .and. .not. allocated(error)) call make_folder(this%out, error)
      call agree(ranks, error)
      if (allocated(error)) return
      if (asks_status) then
         if (ranks%is_first) call print_status(this, error)
      else if (has_designs) then
         call run_designs(line, this, options, ranks, tables, error)
      else if (ranks%is_first) then
         call run_step_size(this%study, this%deck, this%out, tables, error)
      end if
      call show(line, this, tables, error)
   end subroutine run_as_rank

   !> Merges the chunks of a study into its tables.
   subroutine run_merge_command(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(opened_t) :: this
      type(message_list_t) :: tables
      type(scratch_t) :: hold
      logical :: is_missing
      integer :: done

      call open_study(line, this, error)
      if (.not. allocated(error) .and. this%study%kind == step_size_kind) call fail(error, exit_usage, &
         'merge: a study of kind ''step_size'' has no shards')
      if (.not. allocated(error)) call prepare(this, error)
      if (.not. allocated(error)) call choose_store(this%study, this%plan, this%has_store, error)
      if (allocated(error)) return
      call count_parts(this%study, this%plan, this%out, done)
      if (done < this%plan%designs) then
         call fail(error, exit_convergence, 'merge: '//str(this%plan%designs - done)//' of '//plural(this%plan%designs, &
            'design is', 'designs are')//' missing in '//this%out//'; run the shards that did not end (a run computes only '// &
            'what is missing), or elastokin study '//line%files%line(1))
         return
      end if
      call open_parts(this%study, this%plan, this%out, hold, error)
      if (.not. allocated(error)) call finish(line%has('--quiet'), this, hold, tables, is_missing, error)
      call end_scratch(hold)
      call show(line, this, tables, error)
   end subroutine run_merge_command

   !> Reads the study and its deck.
   subroutine open_study(line, this, error)
      type(command_line_t), intent(in) :: line
      type(opened_t), intent(out) :: this
      type(error_t), allocatable, intent(out) :: error

      this%home = folder_name(line%files%line(1))
      this%out = line%value('--out', join_path(this%home, 'out'))
      call read_study(line%files%line(1), this%study, error)
      if (.not. allocated(error) .and. line%has('--samples')) call set_samples(line%number('--samples'), this%study, error)
      if (.not. allocated(error)) call read_changed(join_path(this%home, this%study%deck), line%values('--set'), this%deck, error)
      if (.not. allocated(error)) call keep_texts(line%files%line(1), &
         join_path(this%home, this%study%deck), line%values('--set'), this%texts)
   end subroutine open_study

   !> --samples: a trial of a large study.
   subroutine set_samples(samples, study, error)
      integer, intent(in) :: samples
      type(study_t), intent(inout) :: study
      type(error_t), allocatable, intent(out) :: error

      if (study%kind < step_size_kind) then
         if (sampler_kinds(study%kind)%has_size) then
            study%settings%size = samples
            return
         end if
      end if
      call fail(error, exit_usage, '--samples: a study of kind '//quoted(trim(kind_names(study%kind)))//' has no samples')
   end subroutine set_samples

   !> The design of the deck, against which the study is checked, and the plan.
   subroutine prepare(this, error)
      type(opened_t), intent(inout) :: this
      type(error_t), allocatable, intent(out) :: error

      call expand_factors(this%study, this%deck, error)
      if (.not. allocated(error)) call new_designer(this%study, this%deck, join_path(this%home, ''), this%designer, error)
      if (.not. allocated(error)) call new_plan(this%study, this%deck, join_path(this%home, ''), this%designer, this%plan, error)
      if (allocated(error)) return
      this%texts%swept = this%designer%results(1)%case%place_name
      this%texts%swept_unit = this%designer%results(1)%case%unit_name
   end subroutine prepare

   !> Runs the designs that are missing, then writes the tables unless this is a shard.
   subroutine run_designs(line, this, options, ranks, tables, error)
      type(command_line_t), intent(in) :: line
      type(opened_t), intent(inout) :: this
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
         if (.not. allocated(error)) call finish(line%has('--quiet'), this, hold, tables, is_missing, error)
         call end_scratch(hold)
         if (is_missing) call compute(line, this, options, alone, hold, error)         ! another run has removed them
         if (is_missing .and. .not. allocated(error)) call finish(line%has('--quiet'), this, hold, tables, is_missing, error)
      end if
      call end_scratch(hold)
   end subroutine run_designs

   !> Runs the designs that are missing. All ranks.
   subroutine compute(line, this, options, ranks, hold, error)
      type(command_line_t), intent(in) :: line
      type(opened_t), intent(inout) :: this
      type(run_options_t), intent(in) :: options
      type(ranks_t), intent(inout) :: ranks
      type(scratch_t), intent(inout) :: hold               !! of the folder of the chunks
      type(error_t), allocatable, intent(out) :: error
      type(run_state_t) :: state
      real(wp) :: told
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
      told = seconds()
      call run_chunks(this%study, this%plan, this%deck, this%out, options, this%designer, ranks, state, show_state, error)
      if (is_terminal(2) .and. .not. is_quiet) call write_standard_error(achar(13)//repeat(' ', 78)//achar(13))
      if (allocated(error)) return
      if (state%before > 0) call print_note(is_quiet, str(state%before)//' of '// &
         plural(state%wanted, 'design was', 'designs were')//' done before')
      if (state%is_stopped) then
         call fail(error, exit_convergence, 'stopped: '//str(state%done)//' of '//plural(state%wanted, 'design is', &
            'designs are')//' done and kept; the same command goes on from there')
         if (ranks%count == 1) return
         call print_note(is_quiet, error%message)          ! a launcher that was stopped may not let this process end in order
         error%message = 'the study is not complete'
      else if (options%shards > 1) then
         call print_note(is_quiet, 'shard '//str(options%shard)//' of '//str(options%shards)//' is done: '// &
            plural(state%wanted, 'design', 'designs')//'; when all are, elastokin merge '//line%files%line(1))
      end if

   contains

      !> On a terminal a line that overwrites itself, else a line a minute.
      subroutine show_state(now)
         type(run_state_t), intent(in) :: now

         if (is_quiet) return
         if (is_terminal(2)) then
            call write_standard_error(achar(13)//'  '//state_text(now)//'   ')
         else if (now%now - told > 60.0_wp) then
            told = now%now
            call print_note(is_quiet, state_text(now))
         end if
      end subroutine show_state

   end subroutine compute

   !> '1200 of 5000 designs, 850/s, 4 s left, 3 failed'
   function state_text(state) result(text)
      type(run_state_t), intent(in) :: state
      character(:), allocatable :: text
      real(wp) :: rate

      rate = (state%done - state%before)/max(state%now - state%begun, 1.0e-6_wp)
      text = str(state%done)//' of '//plural(state%wanted, 'design', 'designs')//', '//str(rate, 3)//'/s, '// &
         time_text((state%wanted - state%done)/max(rate, 1.0e-9_wp))//' left, '//str(state%failed)//' failed'
   end function state_text

   !> '45 s', '12 min', '3.5 h'
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

   !> How far a study is, that another process may be running.
   subroutine print_status(this, error)
      type(opened_t), intent(in) :: this
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: name
      logical :: has_table, has_store
      integer :: done

      call count_parts(this%study, this%plan, this%out, done)
      call choose_store(this%study, this%plan, has_store, error)
      name = responses_name(this%study)
      if (has_store) name = store_name(this%study)
      if (allocated(error)) return
      has_table = file_exists(join_path(this%out, name))
      if (done == 0 .and. has_table) then
         call print_text('study '//this%study%name//': complete, '//join_path(this%out, name)//nl, error)
      else
         call print_text('study '//this%study%name//': '//str(done)//' of '//plural(this%plan%designs, 'design', 'designs')// &
            ' done'//nl, error)
      end if
   end subroutine print_status

   !> Writes the tables, removes the chunks, and counts the designs that failed.
   subroutine finish(is_quiet, this, hold, tables, is_missing, error)
      logical, intent(in) :: is_quiet
      type(opened_t), intent(in) :: this
      type(scratch_t), intent(inout) :: hold             !! of the folder of the chunks; ended if the tables were written
      type(message_list_t), intent(inout) :: tables
      logical, intent(out) :: is_missing                 !! a chunk is missing: no table was written
      type(error_t), allocatable, intent(out) :: error   !! exit_convergence if a design failed
      type(study_counts_t) :: counts
      character(:), allocatable :: list, name
      logical :: is_removed
      integer :: k, failed

      call remove_stale(this%out)
      if (this%has_store) then
         call count_designs(this%study, this%plan, this%out, counts, error)
         if (.not. allocated(error)) call write_store(this%study, this%plan, this%out, this%texts, counts, error)
      else
         call write_tables(this%study, this%plan, this%out, counts, error)
      end if
      is_missing = counts%is_missing
      if (allocated(error)) return
      call remove_parts(this%study, this%plan, this%out, hold, is_removed)
      if (.not. is_removed) call print_note(is_quiet, 'another run is at work in '//parts_folder(this%study, this%out)// &
         '; it removes that folder')
      name = store_name(this%study)
      if (.not. this%has_store) name = responses_name(this%study)
      if (this%plan%columns > 0 .and. .not. this%has_store) call tables%add(curves_name(this%study))
      call tables%add(name)
      if (has_limits(this%study)) call print_note(is_quiet, str(counts%within)//' of '//plural(this%plan%designs, &
         'design keeps', 'designs keep')//' all limits')
      failed = sum(counts%designs(1:))
      if (failed == 0) return
      list = ''
      do k = 1, design_invalid
         if (counts%designs(k) > 0) list = list//', '//str(counts%designs(k))//' '//trim(status_names(k))
      end do
      do k = 1, counts%reasons%count()
         call print_warning(counts%reasons%line(k))
      end do
      call fail(error, exit_convergence, plural(failed, 'design', 'designs')//' of '//str(this%plan%designs)//' failed ('// &
         list(3:)//'; columns status and reason of '//name//'); the others were written')
   end subroutine finish

   !> Prints the paths of the tables and draws the figures.
   subroutine show(line, this, tables, error)
      type(command_line_t), intent(in) :: line
      type(opened_t), intent(in) :: this
      type(message_list_t), intent(in) :: tables
      type(error_t), allocatable, intent(inout) :: error
      type(error_t), allocatable :: unprinted, undrawn
      integer :: k

      if (tables%count() == 0) return
      do k = 1, tables%count()
         call print_path(join_path(this%out, tables%line(k)), unprinted)
      end do
      if (line%has('--no-plots')) then
         if (allocated(unprinted) .and. .not. allocated(error)) call move_alloc(unprinted, error)
         return
      end if
      if (this%has_store) then
         call print_note(line%has('--quiet'), 'no figures: they are drawn from CSV tables (format = ''csv'' in the study)')
      else
         if (this%study%kind /= step_size_kind) call draw_study(this%study, this%deck, join_path(this%home, ''), this%out, &
            message_list_t(), line%has('--quiet'), undrawn)
         if (.not. allocated(undrawn)) call draw(line%has('--quiet'), join_path(this%home, this%study%plot), tables, &
            this%out, undrawn)
      end if
      if (allocated(undrawn)) then
         if (allocated(error)) call print_error(undrawn%message)
         if (.not. allocated(error)) call move_alloc(undrawn, error)
      end if
      if (allocated(unprinted) .and. .not. allocated(error)) call move_alloc(unprinted, error)
   end subroutine show

   !> out/<study>.csv
   subroutine run_step_size(study, deck, out, tables, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: out
      type(message_list_t), intent(inout) :: tables      !! names of the tables written
      type(error_t), allocatable, intent(out) :: error
      type(writer_t) :: writer
      character(:), allocatable :: text

      call begin_file(writer, join_path(out, study%name//'.csv'), error, is_part=.true.)
      if (.not. allocated(error)) call step_size_text(study, deck, text, error, writer)
      if (.not. allocated(error)) call writer%finish(error)
      call writer%abandon()                              ! no effect on a finished table
      if (.not. allocated(error)) call tables%add(study%name//'.csv')
   end subroutine run_step_size

   !> Runs the study's plot script over the tables.
   subroutine draw(is_quiet, script, tables, out, error)
      logical, intent(in) :: is_quiet
      character(*), intent(in) :: script, out
      type(message_list_t), intent(in) :: tables
      type(error_t), allocatable, intent(out) :: error

      if (.not. file_exists(script)) return
      if (.not. program_exists('gnuplot')) then
         call print_note(is_quiet, 'gnuplot is not installed: no figures (later: gnuplot '//script//')')
         return
      end if
      call run_plot_script(script, tables, out, error)
      if (.not. allocated(error)) call print_note(is_quiet, 'figures in '//out)
   end subroutine draw

end module ek_study_command
