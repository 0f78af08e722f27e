!> A small chart with its data, one of many on a page: all charts of a page are drawn by one gnuplot script.
!>
!> The script contains the data. The abscissa of every chart is horizontal, because a page of small charts is read in one
!> direction. A figure (ek_run_figures) shows the same charts from the result files in the same folder.
module ek_chart
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_file, only: join_path, remove_file
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_decimal, only: put_decimal, rounded, longest_decimal
   use ek_gnuplot, only: begin_charts_file, heading_style, ink, text_ink, fill, series_rgb, on_title, on_label, on_soft, on_contact
   use ek_gnuplot_text, only: gnuplot_text, file_letters
   use ek_chart_data, only: chart_t, trace_t, new_chart, add_trace, append_chart
   use ek_chart_axis, only: range_of, view_of, cut_of, contact_spans
   implicit none(type, external)
   private
   public :: chart_t, trace_t, new_chart, add_trace, append_chart, charts_script, add_coordinate, picture_file
   public :: pictures_of, remove_drawn, range_of, view_of, set_level, cut_of, both_sides

   character(*), parameter :: both_sides = 'left = right'     !! title of a curve that is the same for both wheels of an axle
   character(*), parameter :: nl = new_line('a')

   character(25), parameter :: dashes(0:3) = [character(25) :: '', ' dashtype (10, 6)', ' dashtype (2, 4)', &
      ' dashtype (10, 4, 2, 4)']
   integer, parameter :: chart_width = 460, chart_height = 330   !! size of a chart [pixels], at font size 13

contains

   !> The file name of a chart: the chart's name, which may come from a foreign table, restricted to the characters of file names.
   pure function picture_file(chart) result(name)
      type(chart_t), intent(in) :: chart
      character(:), allocatable :: name

      name = file_letters(chart%name)//'.svg'
   end function picture_file

   !> One gnuplot script that draws every chart as an SVG file (picture_file) in the folder where gnuplot runs. Charts without
   !> curves and constant charts (is_level) are omitted.
   pure function charts_script(charts) result(text)
      type(chart_t), intent(in) :: charts(:)
      character(:), allocatable :: text
      type(buffer_t) :: script
      integer :: k

      call begin_charts_file(script, chart_width, chart_height)
      call script%line('set lmargin at screen 0.135; set rmargin at screen 0.965; set bmargin at screen 0.165')
      call script%line("set xtics font ',12' offset 0, 0.25; set ytics font ',12'")
      do k = 1, size(charts)
         call add_chart(script, charts(k))
      end do
      call script%line('unset output')
      text = script%text()
   end function charts_script

   !> Adds the data and the plot command of one chart. A chart without curves or a constant chart (is_level) is omitted.
   pure subroutine add_chart(script, chart)
      type(buffer_t), intent(inout) :: script
      type(chart_t), intent(in) :: chart
      character(:), allocatable :: line, look, title
      integer :: k, row, keys, across, rows

      if (size(chart%traces) == 0 .or. chart%is_level) return
      call script%line(nl//'$data << EOD')
      do k = 1, size(chart%traces)
         associate (trace => chart%traces(k))
            do row = 1, size(trace%x)
               call add_pair(script, trace%x(row), trace%y(row))
            end do
            call script%line(nl)
            if (allocated(trace%mark)) then
               call add_pair(script, trace%mark(1), trace%mark(2))
            else
               call script%line('NaN NaN')
            end if
            call script%line(nl)
         end associate
      end do
      call script%line('EOD')

      call script%line('set output '//gnuplot_text(picture_file(chart)))
      call script%line('set label 1 '//gnuplot_text(chart%title)// &
         ' at screen 0.02, screen 0.945'//heading_style(15))
      call script%line('set label 2 '//gnuplot_text(chart%y_label)// &
         " at screen 0.02, screen 0.875 font ',12'"//text_ink(on_soft))
      call script%line('set xlabel '//gnuplot_text(chart%x_label)//" offset 0, 0.65 font ',12'"//text_ink(on_soft))
      call script%line('set yrange '//range_of(chart))
      call add_contact(script, chart)
      keys = 0
      if (chart%has_key) keys = size(chart%traces)
      if (keys > 0) then
         across = min(keys, merge(2, 3, any([(len(chart%traces(k)%title) > 13, k=1, keys)])))
         rows = (keys + across - 1)/across
         call script%line('set key at screen 0.02, screen 0.845 left top vertical Left reverse samplen 1.6 spacing 1.0 '// &
            "width -1 font ',11'"//text_ink(on_label)//" maxrows "//str(rows))
         call script%line('set tmargin at screen '//str(0.81_wp - 0.05_wp*rows, 3))
      else
         call script%line('unset key')
         call script%line('set tmargin at screen 0.82')
      end if
      do k = 1, size(chart%traces)
         associate (trace => chart%traces(k))
            line = '     '
            if (k == 1) line = 'plot '
            look = 'lines linewidth 2.2'//trim(dashes(min(trace%dash, 3)))
            if (chart%has_points) &
               look = 'points pointtype '//str(merge(7, 6, trace%dash == 0))//' pointsize 0.6 linewidth 1.6'
            title = ' notitle'
            if (keys > 0) title = ' title '//gnuplot_text(trace%title)
            call script%line(line//'$data index '//str(2*k - 2)//' using 1:2 with '//look//' linecolor '// &
               series_rgb(trace%colour)//title//', \')
            line = '     $data index '//str(2*k - 1)//" using 1:2 with points pointtype 6 pointsize 0.9 linewidth 1.6"// &
               ink(on_title)//" notitle"
            if (k < size(chart%traces)) line = line//', \'
            call script%line(line)
         end associate
      end do
   end subroutine add_chart

   !> Adds grey areas where a stop is in contact along the first curve of the chart.
   pure subroutine add_contact(script, chart)
      type(buffer_t), intent(inout) :: script
      type(chart_t), intent(in) :: chart
      real(wp), allocatable :: spans(:, :)
      integer :: k

      call script%line('unset object; unset label 3')
      allocate (spans, source=contact_spans(chart%traces(1)))
      if (size(spans, 2) == 0) return
      do k = 1, size(spans, 2)
         call script%line('set object '//str(k)//' rectangle from '//str(spans(1, k), 7)//', graph 0 to '//str(spans(2, k), 7)// &
            ", graph 1 behind"//fill(on_contact)//" fillstyle solid noborder")
      end do
      call script%line("set label 3 'grey: stop in contact' at screen 0.965, screen 0.875 right font ',11'"//text_ink(on_soft))
   end subroutine add_contact

   !> Sets is_level of a chart: whether it is constant to the printed digits. In such a chart, every curve spans at most a
   !> hundredth of the least span (chart%noise). Without curves or a least span, is_level is .false.
   elemental subroutine set_level(chart)
      type(chart_t), intent(inout) :: chart
      integer :: k

      chart%is_level = chart%noise > 0.0_wp .and. size(chart%traces) > 0
      do k = 1, size(chart%traces)
         associate (y => chart%traces(k)%y)
            if (count(ieee_is_finite(y)) == 0) cycle
            if (maxval(y, mask=ieee_is_finite(y)) - minval(y, mask=ieee_is_finite(y)) > chart%noise/100) chart%is_level = .false.
         end associate
      end do
   end subroutine set_level

   !> Adds x and y with seven digits, which is more than a picture resolves.
   pure subroutine add_pair(script, x, y)
      type(buffer_t), intent(inout) :: script
      real(wp), intent(in) :: x, y

      call add_coordinate(script, x, 7)
      call script%add(' ')
      call add_coordinate(script, y, 7)
      call script%line('')
   end subroutine add_pair

   !> Adds a number rounded to significant digits; NaN if it is not finite.
   pure subroutine add_coordinate(script, value, digits)
      type(buffer_t), intent(inout) :: script
      real(wp), intent(in) :: value
      integer, intent(in) :: digits
      character(longest_decimal) :: number
      integer :: used

      if (.not. ieee_is_finite(value)) then
         call script%add('NaN')
         return
      end if
      used = 0
      call put_decimal(rounded(value, digits), number, used)
      call script%add(number(:used))
   end subroutine add_coordinate

   !> Adds the picture files of charts to a list, every name once. Charts without curves and constant charts (is_level) are
   !> omitted.
   subroutine pictures_of(charts, pictures)
      type(chart_t), intent(in) :: charts(:)
      type(message_list_t), intent(inout) :: pictures
      character(:), allocatable :: file
      integer, allocatable :: listed(:)         ! the charts of the list
      integer :: k, n, used

      allocate (listed(size(charts)))
      used = 0
      do k = 1, size(charts)
         if (size(charts(k)%traces) == 0 .or. charts(k)%is_level) cycle
         file = picture_file(charts(k))
         do n = 1, used
            if (len(charts(listed(n))%name) /= len(charts(k)%name)) cycle
            if (picture_file(charts(listed(n))) == file) exit
         end do
         if (n <= used) cycle
         used = used + 1
         listed(used) = k
         call pictures%add(file)
      end do
   end subroutine pictures_of

   !> Removes the pictures that an earlier run has drawn of charts, for a page without pictures.
   subroutine remove_drawn(charts, folder)
      type(chart_t), intent(in) :: charts(:)
      character(*), intent(in) :: folder        !! folder of the page
      integer :: k

      do k = 1, size(charts)
         call remove_file(join_path(folder, 'figures/'//picture_file(charts(k))))
      end do
   end subroutine remove_drawn

end module ek_chart
