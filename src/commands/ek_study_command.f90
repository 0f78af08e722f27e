!> elastokin study: runs a study, writes its tables, draws its figures.
module ek_study_command
   use ek_error, only: error_t, fail, exit_convergence, message_list_t
   use ek_text, only: plural, quoted
   use ek_file, only: write_whole, make_folder, join_path, folder_name, file_exists, program_exists
   use ek_deck, only: deck_t, read_deck
   use ek_table, only: table_t
   use ek_csv, only: csv_text
   use ek_gnuplot, only: gnuplot_text, shell_word
   use ek_study, only: study_t, read_study
   use ek_step_size, only: step_size_text
   use ek_factor_sweep, only: sweep_factors
   use ek_arguments, only: arguments_t
   use ek_load_deck, only: apply_settings
   use ek_words, only: say, warn, tell_path
   implicit none(type, external)
   private
   public :: run_study_command

contains

   !> Tables go to DIR (default: out, beside the study); the study's plot script is run there by gnuplot
   !> with the variable `folder` set to the study's own folder.
   subroutine run_study_command(arguments, error)
      type(arguments_t), intent(in) :: arguments
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: unheard
      type(study_t) :: study
      type(deck_t) :: deck
      character(:), allocatable :: home, out, path
      logical :: is_written

      call read_study(arguments%file, study, error)
      if (allocated(error)) return
      home = folder_name(arguments%file)
      out = arguments%out
      if (len(out) == 0) out = join_path(home, 'out')
      path = study%deck
      if (path(1:1) /= '/') path = join_path(home, path)
      call read_deck(path, deck, error)
      if (allocated(error)) return
      call apply_settings(arguments, deck, error)
      if (allocated(error)) return
      call make_folder(out, error)
      if (allocated(error)) return

      if (study%kind == 'step_size') then
         call run_step_size(study, deck, out, unheard, is_written, error)
      else
         call run_sweep(study, deck, out, unheard, is_written, error)
      end if
      if (.not. is_written) return
      call draw(arguments, study, home, out)
      if (allocated(unheard) .and. .not. allocated(error)) call move_alloc(unheard, error)
   end subroutine run_study_command

   !> out/<study>.csv
   subroutine run_step_size(study, deck, out, unheard, is_written, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: out
      type(error_t), allocatable, intent(inout) :: unheard
      logical, intent(out) :: is_written
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: text

      is_written = .false.
      call step_size_text(study, deck, text, error)
      if (allocated(error)) return
      call write_table(join_path(out, study%name//'.csv'), text, unheard, error)
      is_written = .not. allocated(error)
   end subroutine run_step_size

   !> out/<study>_curves.csv and out/<study>_responses.csv
   subroutine run_sweep(study, deck, out, unheard, is_written, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: out
      type(error_t), allocatable, intent(inout) :: unheard
      logical, intent(out) :: is_written       !! both tables, whatever else went wrong
      type(error_t), allocatable, intent(out) :: error
      type(table_t) :: curves, responses
      type(message_list_t) :: troubles
      integer :: k

      is_written = .false.
      call sweep_factors(study, deck, curves, responses, troubles, error)
      if (allocated(error)) return
      call write_table(join_path(out, study%name//'_curves.csv'), blocks(csv_text(curves), 1), unheard, error)
      if (allocated(error)) return
      ! two factors make a grid: gnuplot wants an empty line after every row of it
      call write_table(join_path(out, study%name//'_responses.csv'), blocks(csv_text(responses), &
         merge(2, 0, size(study%factors) == 2)), unheard, error)
      if (allocated(error)) return
      is_written = .true.
      do k = 1, troubles%count()
         call warn(troubles%line(k))
      end do
      if (troubles%count() > 0) call fail(error, exit_convergence, plural(troubles%count(), 'design of the study is', &
         'designs of the study are')//' incomplete (see the warnings above); the others were written')
   end subroutine run_sweep

   !> Writes and tells the path.
   subroutine write_table(path, text, unheard, error)
      character(*), intent(in) :: path, text
      type(error_t), allocatable, intent(inout) :: unheard     !! the path could not be told
      type(error_t), allocatable, intent(out) :: error
      call write_whole(path, text, error)
      if (.not. allocated(error)) call tell_path(path, unheard)
   end subroutine write_table

   !> CSV text with an empty line wherever the value of a column changes; column 0: nowhere.
   pure function blocks(text, column) result(separated)
      character(*), intent(in) :: text
      integer, intent(in) :: column
      character(:), allocatable :: separated
      character(:), allocatable :: before, now
      integer :: from, length, rows, filled

      if (column == 0) then
         separated = text
         return
      end if
      allocate (character(2*len(text)) :: separated)
      filled = 0
      from = 1
      rows = 0
      before = ''
      do while (from <= len(text))
         length = index(text(from:), new_line('a'))
         if (length == 0) length = len(text) - from + 1
         if (text(from:from) /= '#') then
            now = field(text(from:from + length - 1), column)
            rows = rows + 1
            if (rows > 2 .and. now /= before) then
               separated(filled + 1:filled + 1) = new_line('a')
               filled = filled + 1
            end if
            before = now
         end if
         separated(filled + 1:filled + length) = text(from:from + length - 1)
         filled = filled + length
         from = from + length
      end do
      separated = separated(:filled)
   end function blocks

   !> Field number `column` of a line.
   pure function field(line, column) result(text)
      character(*), intent(in) :: line
      integer, intent(in) :: column
      character(:), allocatable :: text
      integer :: from, k, comma

      from = 1
      do k = 1, column
         comma = index(line(from:), ',')
         if (comma == 0) comma = len(line) - from + 2
         text = line(from:from + comma - 2)
         from = from + comma
      end do
   end function field

   !> Runs the study's plot script in the folder of the tables.
   subroutine draw(arguments, study, home, out)
      type(arguments_t), intent(in) :: arguments
      type(study_t), intent(in) :: study
      character(*), intent(in) :: home, out
      character(:), allocatable :: script
      integer :: status, started

      script = join_path(home, study%plot)
      if (.not. file_exists(script)) return
      if (.not. program_exists('gnuplot')) then
         call say(arguments%quiet, 'gnuplot is not installed: no figures (later: gnuplot '//script//')')
         return
      end if
      ! a locale that has UTF-8 (gnuplot complains of the degree sign in C) and writes a decimal point
      call execute_command_line('LC_ALL=C.UTF-8 gnuplot -e '//shell_word('out='//gnuplot_text(out))//' '//shell_word(script), &
         exitstat=status, cmdstat=started)
      if (status == 0 .and. started == 0) then
         call say(arguments%quiet, 'figures in '//out)
      else
         call warn('gnuplot could not run '//quoted(script))
      end if
   end subroutine draw

end module ek_study_command
