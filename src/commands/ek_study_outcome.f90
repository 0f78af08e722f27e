!> The output of a study: its tables or its store, the message about designs that failed, and its figures.
module ek_study_outcome
   use ek_error, only: error_t, fail, exit_convergence, exit_file, message_list_t
   use ek_text, only: str, plural
   use ek_file, only: join_path, file_exists, program_exists
   use ek_deck, only: deck_t
   use ek_writer, only: writer_t, begin_file, remove_stale, scratch_t
   use ek_drawing, only: run_plot_script
   use ek_system, only: facts_t, facts_of, device_file, other_file
   use ek_study, only: study_t, step_size_kind, kind_names
   use ek_study_data, only: yield_interval
   use ek_study_run, only: remove_parts, parts_folder, this_machine, other_machine
   use ek_study_tables, only: study_counts_t, write_tables, count_designs, curves_name, has_limits, kernels_text
   use ek_store, only: write_store
   use ek_chunk, only: status_names, design_invalid
   use ek_step_size, only: step_size_text
   use ek_command_line, only: command_line_t
   use ek_opened_study, only: opened_study_t, results_name
   use ek_tolerance_outcome, only: write_tolerance
   use ek_study_list, only: list_tables, list_figures
   use ek_plot, only: draw_study, draw_steps
   use ek_console, only: print_note, print_warning, print_error
   use ek_outbox, only: outbox_t, outbox_in, keep_first
   implicit none(type, external)
   private
   public :: write_results, write_step_size, show_results

contains

   !> Writes the tables or the store, removes the chunks, and reports the designs that failed.
   subroutine write_results(line, this, hold, tables, is_missing, error)
      type(command_line_t), intent(in) :: line
      type(opened_study_t), intent(in) :: this
      type(scratch_t), intent(inout) :: hold             !! lock on the folder of the chunks; ended if the tables were written
      type(message_list_t), intent(inout) :: tables
      logical, intent(out) :: is_missing                 !! whether a chunk is missing: no table was written
      type(error_t), allocatable, intent(out) :: error   !! exit_convergence if a design failed, unless --accept-failed is given
      type(study_counts_t) :: counts
      character(:), allocatable :: list, name
      integer :: user, k, failed
      logical :: is_quiet

      is_quiet = line%has('--quiet')
      call remove_stale(this%out)
      if (this%has_store) then
         call count_designs(this%study, this%plan, this%out, counts, error)
         if (.not. allocated(error)) call write_store(this%study, this%plan, this%out, this%texts, counts, error)
      else
         call write_tables(this%study, this%plan, this%out, counts, error)
      end if
      is_missing = counts%is_missing
      if (allocated(error)) return
      name = results_name(this)
      if (this%plan%columns > 0 .and. .not. this%has_store) call tables%add(curves_name(this%study))
      call tables%add(name)
      call list_tables(this%study%name, this%out, tables, is_quiet, error)       ! the chunks stay until the list is complete
      if (allocated(error)) return
      call remove_parts(this%study, this%plan, this%out, hold, user)
      if (user == this_machine) call print_note(is_quiet, 'another run is at work in '//parts_folder(this%study, this%out)// &
         '; it removes that folder')
      if (user == other_machine) call print_note(is_quiet, parts_folder(this%study, this%out)//' is not deleted: a run on '// &
         'another machine is at work in it, or died there within a day; remove it if there is none')
      if (counts%kernels%count() > 1) call print_warning('the designs were computed with different BLAS kernels ('// &
         kernels_text(counts)//'): their last digits may differ; set OPENBLAS_CORETYPE='// &
         counts%kernels%line(1)//' on every machine to get equal digits')
      if (has_limits(this%study)) then
         list = yield_interval(trim(kind_names(this%study%kind)), counts%within, this%plan%designs)
         if (list /= '') list = ' ('//list//')'
         call print_note(is_quiet, str(counts%within)//' of '//plural(this%plan%designs, 'design satisfies', 'designs satisfy')// &
            ' all limits'//list)
      end if
      failed = sum(counts%designs(1:))
      if (failed == 0) return
      list = ''
      do k = 1, design_invalid
         if (counts%designs(k) > 0) list = list//', '//str(counts%designs(k))//' '//trim(status_names(k))
      end do
      do k = 1, counts%reasons%count()
         call print_warning(counts%reasons%line(k))
      end do
      list = plural(failed, 'design', 'designs')//' of '//str(this%plan%designs)//' failed ('//list(3:)// &
         '; columns status and reason of '//name//'); the others were written'
      if (line%has('--accept-failed')) call print_warning(list)
      if (.not. line%has('--accept-failed')) call fail(error, exit_convergence, list)
   end subroutine write_results

   !> Writes the table out/<study>.csv of a step-size study.
   subroutine write_step_size(study, deck, out, is_quiet, tables, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: out
      logical, intent(in) :: is_quiet
      type(message_list_t), intent(inout) :: tables      !! names of the tables written
      type(error_t), allocatable, intent(out) :: error
      type(writer_t) :: writer
      character(:), allocatable :: text

      call begin_file(writer, join_path(out, study%name//'.csv'), error, is_part=.true.)
      if (.not. allocated(error)) call step_size_text(study, deck, text, error, writer)
      if (.not. allocated(error)) call writer%finish(error)
      call writer%abandon()                              ! no effect on a finished table
      if (allocated(error)) return
      call tables%add(study%name//'.csv')
      call list_tables(study%name, out, tables, is_quiet, error)
   end subroutine write_step_size

   !> Prints the paths of the tables, writes the moments of a tolerance study, and draws the figures unless --no-plots is given.
   subroutine show_results(line, this, tables, error)
      type(command_line_t), intent(in) :: line
      type(opened_study_t), intent(in) :: this
      type(message_list_t), intent(in) :: tables
      type(error_t), allocatable, intent(inout) :: error
      type(error_t), allocatable :: trouble
      type(outbox_t) :: box
      logical :: is_quiet
      integer :: k

      if (tables%count() == 0) return
      box = outbox_in(this%out)
      do k = 1, tables%count()
         call box%announce(tables%line(k))
      end do
      is_quiet = line%has('--quiet')
      if (allocated(this%tolerance)) then
         call write_tolerance(this, is_quiet, trouble)
         call keep_first(error, trouble)
      end if
      if (line%has('--no-plots')) then
         call list_figures(this%study%name, this%out, message_list_t(), is_quiet, trouble)     ! none
         call keep_first(error, trouble)
         call box%finish(error)
         return
      end if
      if (this%study%kind /= step_size_kind) call draw_study(this%study, this%deck, join_path(this%home, ''), this%out, &
         message_list_t(), is_quiet, trouble)
      if (this%study%kind == step_size_kind) call draw_steps(this%study, this%out, is_quiet, trouble)
      if (.not. allocated(trouble) .and. .not. this%has_store) &          ! the script reads CSV
         call draw(is_quiet, join_path(this%home, this%study%plot), tables, this%out, trouble)
      if (allocated(trouble) .and. allocated(error)) call print_error(trouble%message)
      call keep_first(error, trouble)
      call box%finish(error)
   end subroutine show_results

   !> Runs the study's plot script on the tables.
   subroutine draw(is_quiet, script, tables, out, error)
      logical, intent(in) :: is_quiet
      character(*), intent(in) :: script, out
      type(message_list_t), intent(in) :: tables
      type(error_t), allocatable, intent(out) :: error

      type(facts_t) :: facts

      facts = facts_of(script, follow=.true.)
      if (facts%kind == device_file .or. facts%kind == other_file) then
         call fail(error, exit_file, 'plot: '//script//' is a pipe or a device, not a gnuplot script')
         return
      end if
      if (.not. file_exists(script)) return
      if (.not. program_exists('gnuplot')) then
         call print_note(is_quiet, 'gnuplot is not installed: no figures (later: gnuplot '//script//')')
         return
      end if
      call run_plot_script(script, tables, out, error)
      if (.not. allocated(error)) call print_note(is_quiet, 'figures in '//out)
   end subroutine draw

end module ek_study_outcome
