!> A figure (ek_figure) as a gnuplot script that contains its data: `gnuplot name.gp` draws name.png and name.svg in the folder
!> where gnuplot runs.
module ek_figure_script
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_chart, only: add_coordinate
   use ek_gnuplot, only: begin_script, begin_formats, end_formats, ink, text_ink, fill, heading_style, subtitle_style, &
      value_colours, zero_axis, on_contour, on_contour_dots, on_label, on_soft, on_box
   use ek_gnuplot_text, only: gnuplot_text
   use ek_figure, only: figure_t, panel_t, axis_t, series_t, as_line, as_points, as_both, as_band, as_boxes, as_segments, &
      as_errors, as_labels, as_heat, gap_row, full_height, title_height, has_values, fold_at, drawn_range
   implicit none(type, external)
   private
   public :: figure_script, two_lines

   character(*), parameter :: nl = new_line('a')

contains

   !> The gnuplot script of a figure.
   function figure_script(figure) result(text)
      type(figure_t), intent(in) :: figure
      character(:), allocatable :: text
      type(buffer_t) :: script
      integer :: p, s

      call begin_script(script, figure%name, figure%title, trim(merge('comma     ', 'whitespace', figure%separator == ',')))
      if (figure%has_heads) call script%line('set datafile columnheaders')
      call script%line('unset key; set style fill solid 1 noborder')
      do p = 1, size(figure%panels)
         do s = 1, size(figure%panels(p)%series)
            call add_data(script, figure%panels(p), p, s, figure%separator)
         end do
      end do
      call begin_formats(script, figure%name, figure%width, full_height(figure), figure%letters)
      call script%line('set label 1 '//gnuplot_text(figure%title)//' at screen 0.02, screen '//below_top(figure, 30)// &
         heading_style(20))
      call script%line('set label 2 '//subtitle_of(figure)//' at screen 0.02, screen '//below_top(figure, 60)//subtitle_style())
      call script%line('set multiplot'//nl//value_colours)
      call add_key(script, figure)
      do p = 1, size(figure%panels)
         call add_panel(script, figure, p)
         if (p == 1) call script%line('unset label 1; unset label 2; unset label 9; unset key')
      end do
      call script%line('unset multiplot'//nl//'unset label')
      call end_formats(script)
      text = script%text()
   end function figure_script

   !> The name of the data block of a series.
   pure function block_of(panel, series) result(name)
      integer, intent(in) :: panel, series
      character(:), allocatable :: name
      name = '$s'//str(panel)//'_'//str(series)
   end function block_of

   !> Adds the data of a series, with seven digits. A gap is an empty line; in space, two empty lines.
   pure subroutine add_data(script, panel, p, s, separator)
      type(buffer_t), intent(inout) :: script
      type(panel_t), intent(in) :: panel
      integer, intent(in) :: p, s
      character(1), intent(in) :: separator
      integer :: row, column

      associate (series => panel%series(s))
         if (.not. has_values(series) .or. allocated(series%source)) return
         call script%line(block_of(p, s)//' << EOD')
         do row = 1, size(series%values, 2)
            if (gap_row(series%values(:, row))) then
               call script%line(trim(merge(nl, ' ', panel%is_space)))
               cycle
            end if
            do column = 1, size(series%values, 1)
               if (column > 1) call script%add(separator)
               call add_coordinate(script, series%values(column, row), 7)
            end do
            if (series%kind == as_labels) call script%add(' "'//field_of(series%labels%line(row))//'"')
            call script%line('')
         end do
         call script%line('EOD')
      end associate
   end subroutine add_data

   !> A string as a field of a data block: '_' replaces quotes, backslashes and control characters.
   pure function field_of(label) result(field)
      character(*), intent(in) :: label
      character(len(label)) :: field
      integer :: k

      field = label
      do k = 1, len(label)
         if (scan(label(k:k), '"\') == 1 .or. iachar(label(k:k)) < 32) field(k:k) = '_'
      end do
   end function field_of

   !> Adds the legend of the first panel, above the panels at the right, and the scale of the colours of all panels.
   subroutine add_key(script, figure)
      type(buffer_t), intent(inout) :: script
      type(figure_t), intent(in) :: figure
      logical :: has_key
      integer :: s

      has_key = .false.
      associate (first => figure%panels(1))
         do s = 1, size(first%series)
            if (allocated(first%series(s)%title)) has_key = .true.
         end do
         if (has_key .and. figure%key_width == 0) call script%line('set key at screen 0.97, screen '//below_top(figure, 12)// &
            ' right top samplen 1.6'//text_ink(on_label))
         if (has_key .and. figure%key_width > 0) call script%line('set key at screen '//str(1.0_wp - real(figure%key_width, wp)/ &
            figure%width, 4)//', screen '//below_top(figure, title_height + figure%top)// &
            ' left top Left reverse samplen 2.5'//text_ink(on_label))
         call script%line('unset colorbox')
         if (.not. allocated(figure%scale_label)) return
         call script%line('set cbtics '//tics_of(first%value))
         call script%line('set colorbox horizontal user origin screen 0.74, screen '//below_top(figure, 42)// &
            ' size screen 0.22, screen '//str(14.0_wp/full_height(figure), 4)//' noborder'//nl// &
            "set cbtics nomirror scale 0.4 font ',12'")
         call script%line('set label 9 '//gnuplot_text(figure%scale_label)//' at screen 0.74, screen '//below_top(figure, 14)// &
            " left font ',13'"//text_ink(on_label))
      end associate
   end subroutine add_key

   !> The tics of an axis for `set xtics`.
   pure function tics_of(axis) result(text)
      type(axis_t), intent(in) :: axis
      character(:), allocatable :: text
      integer :: k

      text = 'autofreq'
      if (allocated(axis%tics)) text = axis%tics
      if (axis%names%count() == 0) return
      text = ''
      do k = 1, axis%names%count()
         text = text//', '//gnuplot_text(axis%names%line(k))//' '//str(k)
      end do
      text = '('//text(3:)//') scale 0'
   end function tics_of

   !> The screen coordinate of a point `pixels` below the upper edge, as a gnuplot string.
   pure function below_top(figure, pixels) result(text)
      type(figure_t), intent(in) :: figure
      integer, intent(in) :: pixels
      character(:), allocatable :: text
      text = str(1.0_wp - real(pixels, wp)/full_height(figure), 5)
   end function below_top

   !> The subtitle as a gnuplot expression. It is split into two lines if it would reach the scale of colours or the edge of the
   !> picture.
   pure function subtitle_of(figure) result(expression)
      type(figure_t), intent(in) :: figure
      character(:), allocatable :: expression
      real(wp), parameter :: letter = 11.8_wp        ! width of a letter of size 14 in PNG, pixels
      integer :: most, at

      most = int(figure%width*merge(0.7_wp, 0.96_wp, allocated(figure%scale_label))/letter)
      at = 0
      if (len(figure%subtitle) > most) at = index(figure%subtitle(:most), '; ', back=.true.)
      expression = gnuplot_text(figure%subtitle)
      if (at > 0) expression = gnuplot_text(figure%subtitle(:at))//'."\n".'//gnuplot_text(figure%subtitle(at + 2:))
   end function subtitle_of

   !> A label as a gnuplot expression, of two lines if it has more letters than `most` (fold_at).
   pure function two_lines(label, most) result(expression)
      character(*), intent(in) :: label
      integer, intent(in) :: most
      character(:), allocatable :: expression
      integer :: at

      expression = gnuplot_text(label)
      at = fold_at(label, most)
      if (at > 0) expression = gnuplot_text(trim(label(:at)))//'."\n".'//gnuplot_text(label(at + 1:))
   end function two_lines

   !> Adds a panel: its margins, its axes and its series.
   subroutine add_panel(script, figure, p)
      type(buffer_t), intent(inout) :: script
      type(figure_t), intent(in) :: figure
      integer, intent(in) :: p
      character(:), allocatable :: label
      integer :: column, row, at
      real(wp) :: left, right, top, bottom, cell, high

      associate (panel => figure%panels(p))
         column = modulo(p - 1, figure%columns)
         row = (p - 1)/figure%columns
         cell = real(figure%width - figure%key_width, wp)/figure%columns
         high = full_height(figure)
         left = (column*cell + figure%left)/figure%width
         right = ((column + 1)*cell - figure%right)/figure%width
         top = 1.0_wp - (title_height + row*figure%height + figure%top)/high
         bottom = 1.0_wp - (title_height + (row + 1)*figure%height - figure%bottom)/high
         call script%line('')
         if (panel%is_space) then
            ! margins at fixed places would scale x and y alone
            call script%line('unset lmargin; unset rmargin; unset bmargin; unset tmargin; set size '// &
               str(1.0_wp/size(figure%panels), 4)//', 0.9; set origin '//str((p - 1.0_wp)/size(figure%panels), 4)//', 0')
         else
            call script%line('set lmargin at screen '//str(left, 5)//'; set rmargin at screen '//str(right, 5)// &
               '; set bmargin at screen '//str(bottom, 5)//'; set tmargin at screen '//str(top, 5))
         end if
         call script%line('set title '//gnuplot_text(panel%title)//' offset 0, -0.4'//heading_style(figure%letters))
         label = gnuplot_text(panel%x%label)
         if (panel%folds_after > 0) label = two_lines(panel%x%label, panel%folds_after)
         call script%line('set xlabel '//label//' offset 0, 0.3'//text_ink(on_label))
         label = gnuplot_text(panel%y%label)
         at = index(panel%y%label, nl)
         if (at > 0) label = gnuplot_text(panel%y%label(:at - 1))//'."\n".'//gnuplot_text(panel%y%label(at + 1:))
         call script%line('set ylabel '//label//' offset 0.6, 0'//text_ink(on_label))
         call add_axis(script, 'x', panel%x)
         call add_axis(script, 'y', panel%y)
         if (panel%is_space) then
            call add_axis(script, 'z', panel%z)
            call script%line('set view equal xyz; set border 4095 linewidth 0.5'//ink(on_box)//nl// &
               'set xyplane at '//str(panel%z%range(1), 6)//'; set view '//str(panel%tilt, 4)//', '//str(panel%turn, 4)//', 1.1')
         else
            if (panel%frame > 0) call script%line('set border '//str(panel%frame))
            if (panel%frame == 0) call script%line('unset border')
         end if
         if (panel%value%has_range) call script%line('set cbrange '//range_of(drawn_range(panel%value))//'; '// &
            trim(merge('set  ', 'unset', panel%value%is_log))//' logscale cb')
         call add_plot(script, panel, p)
      end associate
   end subroutine add_panel

   !> Adds the tics, lines, scale and range of an axis.
   pure subroutine add_axis(script, name, axis)
      type(buffer_t), intent(inout) :: script
      character(1), intent(in) :: name
      type(axis_t), intent(in) :: axis
      character(:), allocatable :: tics

      tics = 'unset '//name//'tics'
      if (axis%has_tics) then
         tics = 'set '//name//'tics scale 0.6 '//tics_of(axis)
         if (axis%names%count() > 0) tics = 'set '//name//'tics '//tics_of(axis)
      end if
      call script%line(tics//'; set grid '//trim(merge('  ', 'no', axis%has_grid))//name//'tics; '// &
         trim(merge('set  ', 'unset', axis%is_log))//' logscale '//name//'; set format '//name// &
         trim(merge(" '%g'", '     ', axis%is_log)))
      call script%line(zero_axis(merge('y', 'x', name == 'x'), axis%has_zero))
      if (axis%has_range) call script%line('set '//name//'range '//range_of(drawn_range(axis)))
      if (axis%has_range) return
      if (allocated(axis%free_range)) call script%line('set '//name//'range '//axis%free_range)
      if (.not. allocated(axis%free_range)) call script%line('set '//name//'range [*:*]')
   end subroutine add_axis

   !> A range for gnuplot: '[0:12.5]'.
   pure function range_of(range) result(text)
      real(wp), intent(in) :: range(2)
      character(:), allocatable :: text
      text = '['//str(range(1), 9)//':'//str(range(2), 9)//']'
   end function range_of

   !> Adds the plot command of a panel.
   subroutine add_plot(script, panel, p)
      type(buffer_t), intent(inout) :: script
      type(panel_t), intent(in) :: panel
      integer, intent(in) :: p
      character(:), allocatable :: line, title
      integer :: s

      do s = 1, size(panel%series)
         if (panel%series(s)%kind /= as_heat) cycle
         if (has_values(panel%series(s))) call add_heat(script, p, s)
         return
      end do
      line = ''
      do s = 1, size(panel%series)
         title = ' notitle'
         if (allocated(panel%series(s)%title)) title = ' title '//gnuplot_text(panel%series(s)%title)
         if (allocated(panel%series(s)%source)) then
            line = line//', \'//nl//'     '//panel%series(s)%source//title
         else if (has_values(panel%series(s))) then
            line = line//', \'//nl//'     '//block_of(p, s)//' '//look_of(panel, panel%series(s))//title
         else if (allocated(panel%series(s)%title)) then       ! gnuplot refuses data without a value; the legend has the name
            line = line//', \'//nl//'     NaN '//look_of(panel, panel%series(s), is_empty=.true.)//title
         end if
      end do
      if (.not. any([(has_values(panel%series(s)), s=1, size(panel%series))])) then
         call script%line('unset xtics; unset ytics; set label 3 '//gnuplot_text(panel%note)//' at graph 0.5, graph 0.5 center'// &
            text_ink(on_soft)//nl//'plot [0:1] [0:1] -1 notitle'//nl//'unset label 3')
      else
         call script%line(trim(merge('splot', 'plot ', panel%is_space))//' '//line(4 + len(nl) + 5:))
      end if
   end subroutine add_plot

   !> The columns and the style of a series in a plot command.
   pure function look_of(panel, series, is_empty) result(look)
      type(panel_t), intent(in) :: panel
      type(series_t), intent(in) :: series
      logical, intent(in), optional :: is_empty          !! without columns
      character(:), allocatable :: look
      character(:), allocatable :: using, colour
      character(6), parameter :: aligned(0:2) = [character(6) :: 'center', 'left', 'right']

      colour = ink(series%role)
      using = 'using 1:2'
      if (panel%is_space) using = 'using 1:2:3'
      select case (series%kind)
      case (as_line)
         if (series%is_by_value) then
            using = 'using 1:2:3'
            colour = ' linecolor palette'
         end if
         look = ' with lines linewidth '//str(series%weight)
         if (series%is_dashed) look = look//' dashtype (8, 6)'
         look = look//colour
      case (as_points)
         look = ' with points pointtype 7 pointsize '//str(series%weight)//colour
      case (as_both)
         look = ' with linespoints pointtype 7 pointsize 0.6 linewidth '//str(series%weight)//colour
      case (as_band)
         using = 'using 1:2:3'
         look = ' with filledcurves'//fill(series%role)
      case (as_boxes)
         using = 'using 1:3:1:2:3:4'
         look = ' with boxxyerror'//colour
      case (as_segments)
         using = trim(merge('using 1:2:3:4:5:6', 'using 1:2:3:4    ', panel%is_space))
         look = ' with vectors nohead linewidth '//str(series%weight)
         if (series%is_dashed) look = look//' dashtype (8, 6)'
         look = look//colour
      case (as_errors)
         using = 'using 1:2:3'
         look = ' with xerrorbars pointtype -1 linewidth '//str(series%weight)//colour
      case default
         using = 'using 1:2:3'
         look = ' with labels '//trim(aligned(series%align))//' offset '//str(series%offset(1))//', '//str(series%offset(2))
         if (series%is_small) look = look//" font ',12'"
         look = look//text_ink(series%role)
      end select
      if (present(is_empty)) using = ''
      look = trim(adjustl(using//look))
   end function look_of

   !> Adds the commands of a map: its colours between the points of the grid, the lines of equal value, which are computed first
   !> as a table, and the points.
   subroutine add_heat(script, p, s)
      type(buffer_t), intent(inout) :: script
      integer, intent(in) :: p, s
      character(:), allocatable :: data

      data = block_of(p, s)
      call script%line('set contour base; set cntrparam levels auto 8; unset surface; set table $lines'//nl// &
         'splot '//data//' using 1:2:3 with lines'//nl//'unset table; unset contour; set surface; set view map')
      call script%line('set colorbox default; set cbtics autofreq'//nl//'set xlabel offset 0, 0.7; set ylabel offset -1, 0')
      call script%line('set xtics offset 0, 0.5; set pm3d map interpolate 4, 4')
      call script%line('splot '//data//' using 1:2:3 with pm3d notitle, \'//nl// &
         "      $lines using 1:2:(0) with lines"//ink(on_contour)//" linewidth 1.2 notitle, \"//nl// &
         '      '//data//" using 1:2:(0) with points pointtype 7 pointsize 0.25"//ink(on_contour_dots)//" notitle")
      call script%line('unset pm3d; set xtics offset 0, 0; set view 60, 30; unset colorbox')
   end subroutine add_heat

end module ek_figure_script
