!> elastokin study: runs a study, writes its tables, and draws its figures.
module ek_study_command
   use ek_error, only: error_t, fail, exit_convergence, message_list_t
   use ek_text, only: plural
   use ek_file, only: make_folder, join_path, folder_name, file_exists, program_exists
   use ek_deck, only: deck_t
   use ek_table, only: table_t
   use ek_writer, only: writer_t, begin_file
   use ek_drawing, only: run_plot_script
   use ek_study, only: study_t, read_study
   use ek_step_size, only: step_size_text
   use ek_factor_sweep, only: sweep_factors
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: read_changed
   use ek_console, only: print_note, print_warning, print_error, print_path
   implicit none(type, external)
   private
   public :: run_study_command

contains

   !> Tables are written to DIR (default: out, beside the study) row by row: if a study is killed, its finished rows stay in
   !> DIR/<table>.csv.<…>.part. gnuplot then runs the study's plot script; its variable `out` is the folder of the tables and
   !> figures.
   subroutine run_study_command(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: unprinted, undrawn
      type(message_list_t) :: tables
      type(study_t) :: study
      type(deck_t) :: deck
      character(:), allocatable :: home, out
      integer :: k

      call read_study(line%files%line(1), study, error)
      if (allocated(error)) return
      home = folder_name(line%files%line(1))
      out = line%value('--out', join_path(home, 'out'))
      call read_changed(join_path(home, study%deck), line%values('--set'), deck, error)
      if (.not. allocated(error)) call make_folder(out, error)
      if (allocated(error)) return
      call run_study(study, deck, out, tables, error)
      if (tables%count() == 0) return
      do k = 1, tables%count()
         call print_path(join_path(out, tables%line(k)), unprinted)
      end do
      call draw(line%has('--quiet'), join_path(home, study%plot), tables, out, undrawn)
      if (allocated(undrawn)) then
         if (allocated(error)) call print_error(undrawn%message)
         if (.not. allocated(error)) call move_alloc(undrawn, error)
      end if
      if (allocated(unprinted) .and. .not. allocated(error)) call move_alloc(unprinted, error)
   end subroutine run_study_command

   !> out/<study>.csv of a step-size study, out/<study>_curves.csv and out/<study>_responses.csv of the others.
   subroutine run_study(study, deck, out, tables, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: out
      type(message_list_t), intent(inout) :: tables      !! names of the tables written: all or none
      type(error_t), allocatable, intent(out) :: error
      type(message_list_t) :: names, troubles
      type(table_t) :: curves, responses
      type(writer_t) :: writers(2)
      character(:), allocatable :: text
      integer :: k

      if (study%kind == 'step_size') then
         call names%add(study%name//'.csv')
      else
         call names%add(study%name//'_curves.csv')
         call names%add(study%name//'_responses.csv')
      end if
      do k = 1, names%count()
         if (.not. allocated(error)) call begin_file(writers(k), join_path(out, names%line(k)), error, is_part=.true.)
      end do
      if (.not. allocated(error)) then
         if (study%kind == 'step_size') call step_size_text(study, deck, text, error, writers(1))
         if (study%kind /= 'step_size') call sweep_factors(study, deck, curves, responses, troubles, error, writers)
      end if
      do k = 1, names%count()
         if (.not. allocated(error)) call writers(k)%finish(error)
      end do
      do k = 1, names%count()
         call writers(k)%abandon()                       ! no effect on a finished table
      end do
      if (.not. allocated(error)) tables = names
      if (allocated(error)) return
      do k = 1, troubles%count()
         call print_warning(troubles%line(k))
      end do
      if (troubles%count() > 0) call fail(error, exit_convergence, plural(troubles%count(), 'design of the study is', &
         'designs of the study are')//' incomplete (see the warnings above); the others were written')
   end subroutine run_study

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
