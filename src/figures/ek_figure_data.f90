!> A figure (ek_figure) as data, from which the script of a page (figure.js) draws it. Numbers have six significant digits, which
!> is more than a screen resolves. Colours are names of the style sheet of the pages.
module ek_figure_data
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_letters, only: as_utf8
   use ek_json, only: json_t, json_string, json_strings, json_number, json_numbers, without_tags
   use ek_gnuplot, only: role_name
   use ek_figure, only: figure_t, panel_t, axis_t, series_t, kinds, as_labels, centred, gap_row, drawn_range
   implicit none(type, external)
   private
   public :: add_figures, figures_json

   integer, parameter :: digits = 6

contains

   !> The data of a page that has figures alone.
   function figures_json(figures) result(text)
      type(figure_t), intent(in) :: figures(:)
      character(:), allocatable :: text
      type(json_t) :: json

      json%is_one_line = .true.
      call json%open('{')
      call json%item('format', json_string('elastokin figures 1'))
      call add_figures(json, figures)
      call json%close('}')
      text = without_tags(json%text())
   end function figures_json

   !> Adds the list of figures of a page.
   subroutine add_figures(json, figures)
      type(json_t), intent(inout) :: json
      type(figure_t), intent(in) :: figures(:)
      integer :: k, p

      call json%open('[', 'figures')
      do k = 1, size(figures)
         associate (figure => figures(k))
            call json%open('{')
            call json%item('name', json_string(as_utf8(figure%name)))
            call json%item('title', json_string(as_utf8(figure%title)))
            call json%item('subtitle', json_string(as_utf8(figure%subtitle)))
            call json%item('columns', str(figure%columns))
            call json%item('width', str(figure%width/figure%columns))
            call json%item('height', str(figure%height))
            call json%item('margins', json_numbers(real([figure%left, figure%right, figure%top, figure%bottom], wp)))
            call json%item('letters', str(figure%letters))
            if (allocated(figure%scale_label)) call json%item('scale', json_string(as_utf8(figure%scale_label)))
            call json%open('[', 'panels')
            do p = 1, size(figure%panels)
               call add_panel(json, figure%panels(p))
            end do
            call json%close(']')
            call json%close('}')
         end associate
      end do
      call json%close(']')
   end subroutine add_figures

   subroutine add_panel(json, panel)
      type(json_t), intent(inout) :: json
      type(panel_t), intent(in) :: panel
      integer :: s

      call json%open('{')
      if (panel%title /= '') call json%item('title', json_string(as_utf8(panel%title)))
      if (panel%note /= '') call json%item('note', json_string(as_utf8(panel%note)))
      call add_axis(json, 'x', panel%x)
      call add_axis(json, 'y', panel%y)
      if (panel%value%has_range) call add_axis(json, 'value', panel%value)
      if (panel%is_space) then
         call add_axis(json, 'z', panel%z)
         call json%item('view', json_numbers([panel%turn, panel%tilt]))
      end if
      call json%item('frame', str(panel%frame))
      call json%open('[', 'series')
      do s = 1, size(panel%series)
         call add_one(json, panel%series(s))
      end do
      call json%close(']')
      call json%close('}')
   end subroutine add_panel

   !> Adds an axis. Properties that most axes have are omitted.
   subroutine add_axis(json, name, axis)
      type(json_t), intent(inout) :: json
      character(*), intent(in) :: name
      type(axis_t), intent(in) :: axis

      call json%open('{', name)
      call json%item('label', json_string(as_utf8(axis%label)))
      if (axis%has_range) call json%item('range', json_numbers(drawn_range(axis), digits))
      if (axis%is_log) call json%item('log', 'true')
      if (axis%names%count() > 0) call json%item('names', json_strings(axis%names))
      if (.not. axis%has_tics) call json%item('bare', 'true')
      if (.not. axis%has_grid) call json%item('plain', 'true')
      if (axis%has_zero) call json%item('zero', 'true')
      call json%close('}')
   end subroutine add_axis

   !> Adds a series: its columns, each as a list; null is a gap. If all lines of a series have the same abscissae, these are listed
   !> once. The values by which lines are coloured are listed once for each line.
   subroutine add_one(json, series)
      type(json_t), intent(inout) :: json
      type(series_t), intent(in) :: series
      integer :: column

      call json%open('{')
      call json%item('kind', json_string(trim(kinds(series%kind))))
      call json%item('colour', json_string(trim(role_name(series%role))))
      call json%item('weight', json_number(series%weight))
      if (series%is_dashed) call json%item('dashed', 'true')
      if (series%is_by_value) call json%item('by_value', 'true')
      if (allocated(series%title)) call json%item('title', json_string(as_utf8(series%title)))
      if (series%kind == as_labels) then
         call json%item('labels', json_strings(series%labels))
         if (series%align /= centred) call json%item('align', str(series%align))
         if (any(abs(series%offset) > 0.0_wp)) call json%item('offset', json_numbers(series%offset))
         if (series%is_small) call json%item('small', 'true')
      end if
      call json%open('[', 'values')
      call json%item_of_list(json_numbers(series%values(1, :period_of(series%values)), digits, ','))
      do column = 2, size(series%values, 1)
         if (series%is_by_value .and. column == 3) then
            call json%item_of_list(json_numbers(pack(series%values(3, :), is_begin(series%values)), digits, ','))
         else
            call json%item_of_list(json_numbers(series%values(column, :), digits, ','))
         end if
      end do
      call json%close(']')
      call json%close('}')
   end subroutine add_one

   !> Number of rows after which the abscissae repeat: of the first line with its gap, or all rows.
   pure integer function period_of(values) result(period)
      real(wp), intent(in) :: values(:, :)
      integer :: k

      period = 0
      if (size(values, 2) == 0) return
      do period = 1, size(values, 2) - 1
         if (gap_row(values(:, period))) exit
      end do
      do k = period + 1, size(values, 2)
         if (abs(values(1, k) - values(1, k - period)) > 0.0_wp .or. &
            (gap_row(values(:, k)) .neqv. gap_row(values(:, k - period)))) then
            period = size(values, 2)
            return
         end if
      end do
   end function period_of

   !> Whether a line begins at a row.
   pure function is_begin(values)
      real(wp), intent(in) :: values(:, :)
      logical :: is_begin(size(values, 2))
      logical :: has_pen
      integer :: k

      has_pen = .false.
      do k = 1, size(values, 2)
         is_begin(k) = all(ieee_is_finite(values(:2, k))) .and. .not. has_pen
         has_pen = all(ieee_is_finite(values(:2, k)))
      end do
   end function is_begin

end module ek_figure_data
