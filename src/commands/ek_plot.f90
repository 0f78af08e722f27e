!> elastokin plot: the figures and the page of a finished study, from its tables; also called at the end of a study.
module ek_plot
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: quoted
   use ek_file, only: make_folder, join_path, read_whole, file_exists
   use ek_deck, only: deck_t
   use ek_study, only: study_t, step_size_kind
   use ek_study_data, only: study_data_t
   use ek_study_figures, only: figure_rule_t, rules, applies, figure_of, figure_name, sheets
   use ek_figure, only: figure_t
   use ek_figure_script, only: figure_script
   use ek_study_page, only: study_page, page_name
   use ek_step_page, only: step_page, step_figure, figure_ending
   use ek_text_table, only: text_table_t, read_text_table
   use ek_study_results, only: read_results_of
   use ek_study_list, only: list_figures, check_tables
   use ek_command_line, only: command_line_t
   use ek_opened_study, only: opened_study_t, open_study
   use ek_console, only: print_note
   use ek_outbox, only: outbox_t, outbox_in
   implicit none(type, external)
   private
   public :: run_plot_command, draw_study, draw_steps

contains

   !> Reads the tables of DIR, draws the figures that apply (or the figures of --kind) and writes the page.
   subroutine run_plot_command(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      class(opened_study_t), allocatable :: this
      type(message_list_t) :: kinds

      call check_kinds(line%values('--kind'), error)
      if (.not. allocated(error)) call check_file(line%files%line(1), error)
      if (.not. allocated(error)) call open_study(line, this, error)
      if (allocated(error)) return
      if (this%study%kind == step_size_kind) then
         kinds = line%values('--kind')
         if (kinds%count() > 0) call fail(error, exit_usage, 'plot: a study of kind ''step_size'' has one figure; omit --kind')
         if (.not. allocated(error)) call draw_steps(this%study, this%out, line%has('--quiet'), error)
         return
      end if
      call draw_study(this%study, this%deck, join_path(this%home, ''), this%out, line%values('--kind'), line%has('--quiet'), error)
   end subroutine run_plot_command

   !> Rejects a results file (.nc, .csv) in place of a study, because results alone do not define the figures.
   subroutine check_file(path, error)
      character(*), intent(in) :: path
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: ending

      ending = path(index(path, '.', back=.true.) + 1:)
      if (ending == 'nc' .or. ending == 'csv') call fail(error, exit_usage, 'plot: '//quoted(path)// &
         ' has results; give the study that they are of, and their folder with --out: elastokin plot STUDY.nml --out DIR')
   end subroutine check_file

   !> Checks that every name after --kind is the name of a figure.
   subroutine check_kinds(kinds, error)
      type(message_list_t), intent(in) :: kinds
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: names
      integer :: k

      names = ''
      do k = 1, size(rules)
         names = names//', '//trim(rules(k)%name)
      end do
      do k = 1, kinds%count()
         if (any(rules%name == kinds%line(k))) cycle
         call fail(error, exit_usage, '--kind: there is no figure '//quoted(kinds%line(k))//'; expected '//names(3:))
         return
      end do
   end subroutine check_kinds

   !> Draws the figures of a finished study into out/figures and writes out/<study>.html.
   subroutine draw_study(study, deck, home, out, kinds, is_quiet, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: home               !! folder of the study with its slash
      character(*), intent(in) :: out                !! folder of the tables
      type(message_list_t), intent(in) :: kinds      !! names of figures; none: all figures that apply
      logical, intent(in) :: is_quiet
      type(error_t), allocatable, intent(out) :: error
      class(study_data_t), allocatable :: data
      type(outbox_t) :: box, figures
      type(message_list_t) :: files
      character(:), allocatable :: folder, reason, name
      integer :: k, sheet

      allocate (data)
      call read_results_of(study, deck, home, out, data, error)
      if (allocated(error)) return
      folder = join_path(out, 'figures')
      call make_folder(folder, error)
      if (allocated(error)) return
      figures = outbox_in(folder)
      do k = 1, size(rules)
         do sheet = 1, 2
            name = figure_name(rules(k), data, sheet)
            if (.not. is_drawn(rules(k), sheet) .or. .not. is_asked(kinds, trim(rules(k)%name))) then
               call remove_old(rules(k), sheet, name)
               cycle
            end if
            call figures%add_script(name, figure_script(figure_of(rules(k), data, sheet)))
            call figures%finish(error)
            if (allocated(error)) return
            call add_files(name, files)
         end do
      end do
      if (kinds%count() > 0 .and. figures%files%count() == 0) then
         call fail(error, exit_usage, '--kind: no such figure applies to this study (kind '//data%kind//')')
         return
      end if
      ! the page needs no picture: it is there even if gnuplot fails or hangs
      box = outbox_in(out)
      name = page_name(data)
      call box%write(name, study_page(data))
      call box%take(error)
      if (allocated(error)) return
      call figures%draw(is_quiet, reason)
      call show_page(study%name, name, files, is_quiet, figures, box, error)

   contains

      !> Whether a sheet of a figure can be drawn from the results.
      logical function is_drawn(rule, sheet)
         type(figure_rule_t), intent(in) :: rule
         integer, intent(in) :: sheet

         is_drawn = applies(rule, data)
         if (is_drawn) is_drawn = sheet <= sheets(rule, data)
      end function is_drawn

      !> Removes a figure that is not drawn now, unless the figure shows the current results. The script contains the data; the
      !> figure is current if its script equals the new script.
      subroutine remove_old(rule, sheet, name)
         type(figure_rule_t), intent(in) :: rule
         integer, intent(in) :: sheet
         character(*), intent(in) :: name
         type(error_t), allocatable :: unread
         character(:), allocatable :: script
         logical :: is_current

         is_current = is_drawn(rule, sheet)
         if (is_current) is_current = file_exists(join_path(folder, name//'.gp'))
         if (is_current) then
            call read_whole(join_path(folder, name//'.gp'), script, unread)
            is_current = .not. allocated(unread)
            if (is_current) is_current = script == figure_script(figure_of(rule, data, sheet))
         end if
         if (is_current) then
            call add_files(name, files)
            return
         end if
         call figures%remove(files_of(name))
      end subroutine remove_old

   end subroutine draw_study

   !> Whether a figure is asked for: all are without names.
   pure logical function is_asked(kinds, name)
      type(message_list_t), intent(in) :: kinds
      character(*), intent(in) :: name
      integer :: j

      is_asked = kinds%count() == 0
      do j = 1, kinds%count()
         is_asked = is_asked .or. kinds%line(j) == name
      end do
   end function is_asked

   !> Adds the script and the pictures of a figure to a list of files.
   subroutine add_files(figure, files)
      character(*), intent(in) :: figure             !! name without extension
      type(message_list_t), intent(inout) :: files
      character(len(figure) + 4) :: names(3)
      integer :: k

      names = files_of(figure)
      do k = 1, 3
         call files%add('figures/'//trim(names(k)))
      end do
   end subroutine add_files

   !> The names of the script and the pictures of a figure.
   pure function files_of(figure) result(names)
      character(*), intent(in) :: figure             !! name without extension
      character(len(figure) + 4) :: names(3)
      names = [figure//'.gp ', figure//'.png', figure//'.svg']
   end function files_of

   !> Lists the page and the figures of a study, and prints the path of the page.
   subroutine show_page(study, name, files, is_quiet, figures, box, error)
      character(*), intent(in) :: study, name               !! names of the study and of the page
      type(message_list_t), intent(inout) :: files          !! figures, relative to the folder of the page
      logical, intent(in) :: is_quiet
      type(outbox_t), intent(inout) :: figures, box         !! box: of the page
      type(error_t), allocatable, intent(out) :: error

      call box%take(error)
      if (allocated(error)) return
      call files%add(name)
      call list_figures(study, box%folder, files, is_quiet, error)
      if (allocated(error)) return
      call box%announce(name)
      call figures%finish(error)
      call box%finish(error)
   end subroutine show_page

   !> Reads the table of a step-size study, draws its figure, and writes its page.
   subroutine draw_steps(study, out, is_quiet, error)
      type(study_t), intent(in) :: study
      character(*), intent(in) :: out                !! folder of the table
      logical, intent(in) :: is_quiet
      type(error_t), allocatable, intent(out) :: error
      type(text_table_t) :: table
      type(outbox_t) :: box, figures
      type(message_list_t) :: files
      type(figure_t), allocatable :: figure
      character(:), allocatable :: folder, reason, name

      call check_tables(study%name, out, study%name//'.csv', error)
      if (allocated(error)) return
      call read_text_table(join_path(out, study%name//'.csv'), table, error)
      if (allocated(error)) return
      folder = join_path(out, 'figures')
      call make_folder(folder, error)
      if (allocated(error)) return
      name = study%name//figure_ending
      call step_figure(study%name, table, figure)
      figures = outbox_in(folder)
      reason = ''
      if (.not. allocated(figure)) then
         reason = 'no error exceeds 1e-12, so that there is no figure'
         call print_note(is_quiet, reason)
         call figures%remove(files_of(name))
      else
         call figures%add_script(name, figure_script(figure))
         call figures%finish(error)
         if (allocated(error)) return
         call add_files(name, files)
      end if
      box = outbox_in(out)
      name = study%name//'.html'
      call box%write(name, step_page(study%title, study%name, study%deck, study%case, table, reason))
      call box%take(error)
      if (allocated(error)) return
      call figures%draw(is_quiet, reason)
      call show_page(study%name, name, files, is_quiet, figures, box, error)
   end subroutine draw_steps

end module ek_plot
