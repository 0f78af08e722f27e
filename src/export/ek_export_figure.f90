!> Figures of exported files. gnuplot reads the points from the exported file itself; the lines are curves that were solved
!> separately.
module ek_export_figure
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_decimal, only: decimal
   use ek_gnuplot, only: begin_script, begin_formats, end_formats, ink, on_derivative
   use ek_gnuplot_text, only: gnuplot_text
   implicit none(type, external)
   private
   public :: panel_t, panel_list_t, add_panel, export_script

   !> A panel: points of a file over a curve.
   type :: panel_t
      character(:), allocatable :: title, x_label, y_label
      character(:), allocatable :: points        !! plot element of the points: file, lines, columns
      real(wp), allocatable :: x(:), y(:)        !! values of the curve
   end type panel_t

   type :: panel_list_t
      type(panel_t), allocatable :: panels(:)
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

   !> The script NAME.gp, which draws NAME.png and NAME.svg.
   function export_script(list, name, title, separator) result(text)
      type(panel_list_t), intent(in) :: list
      character(*), intent(in) :: name, title
      character(1), intent(in) :: separator                !! separator of the columns of the file: ',' or ' '
      character(:), allocatable :: text
      type(buffer_t) :: script
      integer :: k, i, rows

      rows = (list%used + 2)/3
      call begin_script(script, name, title//': points of the exported file over curves that were solved separately', &
         trim(merge('comma     ', 'whitespace', separator == ',')))
      call script%line('set key at screen 0.008, screen 0.998 left top Left reverse horizontal')
      do k = 1, list%used
         call script%line('$curve'//str(k)//' << EOD')
         do i = 1, size(list%panels(k)%x)
            call script%line(decimal(list%panels(k)%x(i))//separator//decimal(list%panels(k)%y(i)))
         end do
         call script%line('EOD')
      end do
      call begin_formats(script, name, 1500, 420*rows + 60, 11)
      call script%line('   set multiplot layout '//str(rows)//', 3 title '//gnuplot_text(title))
      do k = 1, list%used
         associate (panel => list%panels(k))
            call script%line('   set title '//gnuplot_text(panel%title))
            call script%line('   set xlabel '//gnuplot_text(panel%x_label))
            call script%line('   set ylabel '//gnuplot_text(panel%y_label))
            call script%line('   set yrange '//range_of(panel%y))
            call script%line('   plot $curve'//str(k)//" using 1:2 with lines"//ink(on_derivative)//" linewidth 2 title "// &
               gnuplot_text(trim(merge('solved separately', '                 ', k == 1)))//', \')
            call script%line('      '//panel%points//' title '//gnuplot_text(trim(merge('written file', '            ', k == 1))))
         end associate
      end do
      call script%line('   unset multiplot')
      call end_formats(script)
      text = script%text()
   end function export_script

   !> The range of an axis: chosen by gnuplot, unless the values differ by rounding errors only.
   pure function range_of(values) result(range)
      real(wp), intent(in) :: values(:)
      character(:), allocatable :: range
      real(wp), parameter :: rounding = 1.0e-7_wp      ! mm, deg, N
      real(wp) :: middle

      range = '[*:*]'
      if (maxval(values) - minval(values) > rounding) return
      middle = 0.5_wp*(maxval(values) + minval(values))
      range = '['//str(middle - 1.0_wp, 10)//':'//str(middle + 1.0_wp, 10)//']'      ! without the digits of rounding
   end function range_of

end module ek_export_figure
