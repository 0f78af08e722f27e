!> elastokin plot: the figures and the page of a finished study, from its tables; also called at the end of a study.
module ek_plot
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: quoted
   use ek_file, only: make_folder, join_path, folder_name, write_whole
   use ek_deck, only: deck_t
   use ek_drawing, only: run_gnuplot
   use ek_study, only: study_t, step_size_kind
   use ek_study_reader, only: read_study
   use ek_study_data, only: study_data_t
   use ek_study_figures, only: rules, applies, script_of, figure_name
   use ek_study_page, only: study_page, page_name
   use ek_study_results, only: read_results_of
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: read_changed
   use ek_console, only: print_note, print_path
   implicit none(type, external)
   private
   public :: run_plot_command, draw_study

contains

   !> Reads the tables of DIR, draws the figures that apply (or those of --kind) and writes the page.
   subroutine run_plot_command(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(study_t) :: study
      type(deck_t) :: deck
      character(:), allocatable :: home, out

      home = folder_name(line%files%line(1))
      out = line%value('--out', join_path(home, 'out'))
      call check_kinds(line%values('--kind'), error)
      if (.not. allocated(error)) call read_study(line%files%line(1), study, error)
      if (.not. allocated(error)) then
         if (study%kind == step_size_kind) call fail(error, exit_usage, &
            'plot: a study of kind ''step_size'' has only the figures of its plot script')
      end if
      if (.not. allocated(error)) call read_changed(join_path(home, study%deck), line%values('--set'), deck, error)
      if (.not. allocated(error)) call draw_study(study, deck, join_path(home, ''), out, line%values('--kind'), &
         line%has('--quiet'), error)
   end subroutine run_plot_command

   !> Every name after --kind is that of a figure.
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
      type(message_list_t), intent(in) :: kinds      !! of figures; none: all that apply
      logical, intent(in) :: is_quiet
      type(error_t), allocatable, intent(out) :: error
      type(study_data_t) :: data
      type(message_list_t) :: scripts, pictures
      type(error_t), allocatable :: undrawn
      character(:), allocatable :: folder, message, name
      integer :: k

      call read_results_of(study, deck, home, out, data, error)
      if (allocated(error)) return
      folder = join_path(out, 'figures')
      call make_folder(folder, error)
      if (allocated(error)) return
      do k = 1, size(rules)
         if (.not. applies(rules(k), data) .or. .not. is_asked(trim(rules(k)%name))) cycle
         name = figure_name(rules(k), data)
         call write_whole(join_path(folder, name//'.gp'), script_of(rules(k), data), error, can_be_redrawn=.true.)
         if (allocated(error)) return
         call scripts%add(name//'.gp')
         call pictures%add(name//'.png')
         call pictures%add(name//'.svg')
      end do
      if (kinds%count() > 0 .and. scripts%count() == 0) then
         call fail(error, exit_usage, '--kind: no such figure applies to this study (kind '//data%kind//')')
         return
      end if
      ! first without pictures: the page then exists even if gnuplot fails or hangs
      call write_whole(join_path(out, page_name(data)), study_page(data, '', 'gnuplot has not finished'), error)
      if (allocated(error)) return
      call run_gnuplot(scripts, pictures, folder, message, undrawn)
      if (len(message) > 0) call print_note(is_quiet, message)
      if (allocated(undrawn)) message = undrawn%message
      if (len(message) > 0) folder = ''
      call write_whole(join_path(out, page_name(data)), study_page(data, folder, message), error)
      if (allocated(error)) return
      call print_path(join_path(out, page_name(data)), error)
      if (allocated(undrawn)) call move_alloc(undrawn, error)

   contains

      logical function is_asked(name)
         character(*), intent(in) :: name
         integer :: j

         is_asked = kinds%count() == 0
         do j = 1, kinds%count()
            is_asked = is_asked .or. kinds%line(j) == name
         end do
      end function is_asked

   end subroutine draw_study

end module ek_plot
