!> A small chart with its data, one of many on a page: all charts of a page are drawn by one gnuplot script.
!>
!> Its script contains the data, and its abscissa is always horizontal, because a page of small charts is read in one
!> direction. A figure (ek_gnuplot) shows the same charts from the result files beside it.
module ek_chart
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_file, only: join_path, remove_file
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_decimal, only: put_decimal, longest_decimal
   use ek_gnuplot_text, only: gnuplot_text, file_letters
   implicit none(type, external)
   private
   public :: chart_t, trace_t, new_chart, add_trace, append_chart, charts_script, add_coordinate, picture_file
   public :: pictures_of, remove_drawn, range_of, palette, axes_style

   !> Okabe and Ito's colours, distinguishable with colour blindness; without the yellow, too light on white.
   character(7), parameter :: palette(8) = ['#0072B2', '#D55E00', '#009E73', '#CC79A7', &
      '#E69F00', '#56B4E9', '#4D4D4D', '#8C510A']

   character(*), parameter :: nl = new_line('a')
   character(*), parameter :: axes_style = "set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1"//nl// &
      "set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.2"//nl// &
      "set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.2"

   character(25), parameter :: dashes(0:3) = [character(25) :: '', ' dashtype (10, 6)', ' dashtype (2, 4)', &
      ' dashtype (10, 4, 2, 4)']
   integer, parameter :: chart_width = 460, chart_height = 330   !! pixels at font size 13

   !> One curve.
   type :: trace_t
      character(:), allocatable :: title
      !> Its columns in the table, or an expression of columns in parentheses: `(abs(column("toe_deg")))`
      character(:), allocatable :: over, column
      real(wp), allocatable :: x(:), y(:)
      real(wp), allocatable :: mark(:)       !! [x, y] of a ring: the design state
      integer :: colour = 1                  !! index in the palette
      integer :: dash = 0                    !! 0 solid, 1 dashed, 2 dotted, 3 dash-dotted
   end type trace_t

   type :: chart_t
      integer :: test = 0                    !! number of the test that it belongs to
      character(:), allocatable :: name      !! of the SVG, without extension
      character(:), allocatable :: title     !! the quantity
      character(:), allocatable :: y_label   !! its unit and sign
      character(:), allocatable :: x_label
      type(trace_t), allocatable :: traces(:)
      logical :: has_key = .false.           !! the curves are named in the chart
      logical :: has_points = .false.        !! the states are independent: points without a line
      real(wp) :: noise = 0.0_wp             !! a smaller span is drawn flat
      real(wp) :: cap = 0.0_wp               !! values beyond ± this are not drawn; 0: no limit
   end type chart_t

contains

   !> A chart without curves.
   pure type(chart_t) function new_chart(name, title, y_label, x_label) result(chart)
      character(*), intent(in) :: name, title, y_label, x_label

      chart%name = name
      chart%title = title
      chart%y_label = y_label
      chart%x_label = x_label
      allocate (chart%traces(0))
   end function new_chart

   !> Appends a curve.
   pure subroutine add_trace(chart, trace)
      type(chart_t), intent(inout) :: chart
      type(trace_t), intent(in) :: trace
      chart%traces = [chart%traces, trace]
   end subroutine add_trace

   !> Appends a chart to a list. (In place of the call gfortran 12 warns of uninitialised bounds.)
   pure subroutine append_chart(charts, chart)
      type(chart_t), allocatable, intent(inout) :: charts(:)
      type(chart_t), intent(in) :: chart
      charts = [charts, chart]
   end subroutine append_chart

   !> The file of a chart: its name, reduced to the characters of a file name, as it may come from a foreign table.
   pure function picture_file(chart) result(name)
      type(chart_t), intent(in) :: chart
      character(:), allocatable :: name

      name = file_letters(chart%name)//'.svg'
   end function picture_file

   !> One script that draws every chart as <name>.svg in the folder where gnuplot runs.
   pure function charts_script(charts) result(text)
      type(chart_t), intent(in) :: charts(:)
      character(:), allocatable :: text
      type(buffer_t) :: script
      integer :: k

      call script%line('# The charts of a page. Run gnuplot in this folder to draw them again.')
      call script%line('reset'//nl//'set encoding utf8')
      call script%line("set terminal svg size "//str(chart_width)//", "//str(chart_height)// &
         " dynamic font 'sans-serif,13' linewidth 1 noenhanced")
      call script%line("set border 3 linecolor rgb '#808080'")
      call script%line("set tics out nomirror scale 0.6 textcolor rgb '#404040'"//nl//axes_style)
      call script%line('set lmargin at screen 0.135; set rmargin at screen 0.965; set bmargin at screen 0.165')
      call script%line("set xtics font ',12' offset 0, 0.25; set ytics font ',12'")
      do k = 1, size(charts)
         call add_chart(script, charts(k))
      end do
      call script%line('unset output')
      text = script%text()
   end function charts_script

   !> Data and plot command of one chart.
   pure subroutine add_chart(script, chart)
      type(buffer_t), intent(inout) :: script
      type(chart_t), intent(in) :: chart
      character(:), allocatable :: line, look, title
      integer :: k, row, keys, across, rows

      if (size(chart%traces) == 0) return
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
         " at screen 0.02, screen 0.945 font 'sans-serif:Bold,15' textcolor rgb '#202020'")
      call script%line('set label 2 '//gnuplot_text(chart%y_label)// &
         " at screen 0.02, screen 0.875 font ',12' textcolor rgb '#606060'")
      call script%line('set xlabel '//gnuplot_text(chart%x_label)//" offset 0, 0.65 font ',12' textcolor rgb '#606060'")
      call script%line('set yrange '//range_of(chart))
      keys = 0
      if (chart%has_key) keys = size(chart%traces)
      if (keys > 0) then
         across = min(keys, merge(2, 3, any([(len(chart%traces(k)%title) > 13, k=1, keys)])))
         rows = (keys + across - 1)/across
         call script%line('set key at screen 0.02, screen 0.845 left top vertical Left reverse samplen 1.6 spacing 1.0 '// &
            "width -1 font ',11' textcolor rgb '#404040' maxrows "//str(rows))
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
            call script%line(line//'$data index '//str(2*k - 2)//' using 1:2 with '//look//" linecolor rgb '"// &
               palette(modulo(trace%colour - 1, size(palette)) + 1)//"'"//title//', \')
            line = '     $data index '//str(2*k - 1)//" using 1:2 with points pointtype 6 pointsize 0.9 linewidth 1.6"// &
               " linecolor rgb '#202020' notitle"
            if (k < size(chart%traces)) line = line//', \'
            call script%line(line)
         end associate
      end do
   end subroutine add_chart

   !> The range of y: of a span within the noise, and of a constant, the middle; otherwise that of the curves.
   pure function range_of(chart) result(range)
      type(chart_t), intent(in) :: chart
      character(:), allocatable :: range
      real(wp) :: low, high, margin
      integer :: k

      low = huge(1.0_wp)
      high = -huge(1.0_wp)
      do k = 1, size(chart%traces)
         associate (y => chart%traces(k)%y)
            low = min(low, minval(y, mask=ieee_is_finite(y)))
            high = max(high, maxval(y, mask=ieee_is_finite(y)))
         end associate
      end do
      range = '[*:*]'
      if (chart%cap > 0.0_wp) range = '['//str(-chart%cap)//' < * : * < '//str(chart%cap)//']'
      if (low > high) return
      margin = max(abs(low)/10, 1.0e-6_wp)
      if (high - low <= 0.0_wp) range = '['//str(low - margin, 6)//' : '//str(low + margin, 6)//']'
      if (high - low < chart%noise) &
         range = '[* < '//str((low + high)/2 - chart%noise, 6)//' : '//str((low + high)/2 + chart%noise, 6)//' < *]'
   end function range_of

   !> x and y with seven digits, more than a picture resolves.
   pure subroutine add_pair(script, x, y)
      type(buffer_t), intent(inout) :: script
      real(wp), intent(in) :: x, y

      call add_coordinate(script, x, 7)
      call script%add(' ')
      call add_coordinate(script, y, 7)
      call script%line('')
   end subroutine add_pair

   !> A number rounded to significant digits; NaN if it is not finite.
   pure subroutine add_coordinate(script, value, digits)
      type(buffer_t), intent(inout) :: script
      real(wp), intent(in) :: value
      integer, intent(in) :: digits
      character(longest_decimal) :: number
      real(wp) :: scale
      integer :: used

      if (.not. ieee_is_finite(value)) then
         call script%add('NaN')
         return
      end if
      used = 0
      if (abs(value) < 1.0e-12_wp .or. abs(value) > 1.0e12_wp) then
         call put_decimal(merge(0.0_wp, value, abs(value) < 1.0e-12_wp), number, used)
      else
         scale = 10.0_wp**(digits - 1 - floor(log10(abs(value))))
         call put_decimal(anint(value*scale)/scale, number, used)
      end if
      call script%add(number(:used))
   end subroutine add_coordinate

   !> The picture files of these charts. A chart without curves is not drawn; every name is listed once.
   subroutine pictures_of(charts, pictures)
      type(chart_t), intent(in) :: charts(:)
      type(message_list_t), intent(inout) :: pictures
      character(:), allocatable :: file
      integer :: k, n

      do k = 1, size(charts)
         if (size(charts(k)%traces) == 0) cycle
         file = picture_file(charts(k))
         do n = 1, pictures%count()
            if (pictures%line(n) == file) exit
         end do
         if (n > pictures%count()) call pictures%add(file)
      end do
   end subroutine pictures_of

   !> Removes pictures of these charts from an earlier run, for a page without pictures.
   subroutine remove_drawn(charts, folder)
      type(chart_t), intent(in) :: charts(:)
      character(*), intent(in) :: folder        !! of the page
      integer :: k

      do k = 1, size(charts)
         call remove_file(join_path(folder, 'figures/'//picture_file(charts(k))))
      end do
   end subroutine remove_drawn

end module ek_chart
