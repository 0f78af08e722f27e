!> Figures of exported files. gnuplot reads the points from the exported file itself; the lines are curves that were solved
!> separately.
module ek_export_figure
   use ek_kinds, only: wp
   use ek_figure, only: figure_t, new_figure, add_series, add_source, columns_of, as_line
   use ek_gnuplot, only: on_derivative
   implicit none(type, external)
   private
   public :: curve_t, panel_list_t, add_panel, export_figure

   !> A panel: points of a file over a curve.
   type :: curve_t
      character(:), allocatable :: title, x_label, y_label
      character(:), allocatable :: points        !! plot element of the points: file, lines, columns
      real(wp), allocatable :: x(:), y(:)        !! values of the curve
   end type curve_t

   type :: panel_list_t
      type(curve_t), allocatable :: panels(:)
      integer :: used = 0
   end type panel_list_t

   integer, parameter :: most = 12

contains

   !> Adds a panel. Adds nothing if the curve has no values, if x and y differ in number, or if the list already has 12 panels.
   subroutine add_panel(list, title, x_label, y_label, points, x, y)
      type(panel_list_t), intent(inout) :: list
      character(*), intent(in) :: title, x_label, y_label, points
      real(wp), intent(in) :: x(:), y(:)

      if (.not. allocated(list%panels)) allocate (list%panels(most))
      if (list%used == most .or. size(x) == 0 .or. size(x) /= size(y)) return
      list%used = list%used + 1
      associate (panel => list%panels(list%used))
         panel%title = title
         panel%x_label = x_label
         panel%y_label = y_label
         panel%points = points
         panel%x = x
         panel%y = y
      end associate
   end subroutine add_panel

   !> The figure of a file: its points over the curves.
   function export_figure(list, name, title, separator) result(figure)
      type(panel_list_t), intent(in) :: list
      character(*), intent(in) :: name, title
      character(1), intent(in) :: separator                !! separator of the columns of the file: ',' or ' '
      type(figure_t) :: figure
      real(wp), parameter :: rounding = 1.0e-7_wp           ! mm, deg, N
      integer :: k

      figure = new_figure(name, title, 'points of the exported file over curves that were solved separately', list%used, height=400)
      figure%columns = 3
      figure%width = 1500
      figure%letters = 12
      figure%separator = separator
      do k = 1, list%used
         associate (from => list%panels(k), panel => figure%panels(k))
            panel%title = from%title
            panel%x%label = from%x_label
            panel%y%label = from%y_label
            call add_series(panel, as_line, on_derivative, columns_of(from%x, from%y), title='solved separately')
            call add_source(panel, from%points, 'written file')
            if (maxval(from%y) - minval(from%y) > rounding) cycle
            panel%y%has_range = .true.                      ! the values differ by rounding errors only
            panel%y%range = 0.5_wp*(maxval(from%y) + minval(from%y)) + [-1.0_wp, 1.0_wp]
         end associate
      end do
   end function export_figure

end module ek_export_figure
