!> A figure as a gnuplot script that the user can read, edit and run again. In the folder of the script, `gnuplot name.gp`
!> draws name.png and name.svg from the data files in this folder. This module also lists the standard figures of one run.
module ek_run_figures
   use ek_kinds, only: wp
   use ek_buffer, only: buffer_t
   use ek_text, only: str
   use ek_file, only: base_name
   use ek_chart, only: chart_t, range_of
   use ek_gnuplot, only: begin_script, begin_formats, end_formats, ink, text_ink, heading_style, subtitle_style, series_rgb, &
      on_title
   use ek_gnuplot_text, only: gnuplot_text, gnuplot_name
   use ek_quantity, only: quantity_named
   use ek_table, only: table_t
   use ek_test_result, only: test_result_t, find_wheels, choose_abscissa, travel_column
   use ek_test_charts, only: quantity_chart, ending_chart, bushing_chart
   implicit none(type, external)
   private
   public :: figure_t, figure_script, run_figures

   integer, parameter :: width = 1200, height = 900   !! size of a picture [pixels]
   integer, parameter :: curve_styles = 8    !! the styles repeat after these curves
   integer, parameter :: legend_on_top = 3   !! most entries of a legend above the panel; a longer legend is at the right

   character(*), parameter :: nl = new_line('a')

   !> A figure, which one script draws: one panel, or several panels in two columns.
   type :: figure_t
      character(:), allocatable :: name      !! name of the files, without suffix
      character(:), allocatable :: title, subtitle
      character(:), allocatable :: file      !! table with the columns of all curves, relative to the script
      type(chart_t), allocatable :: panels(:)
      logical :: is_upward = .false.         !! abscissa upward and values to the right, as usual for wheel travel
   end type figure_t

contains

   !> The gnuplot script of a figure.
   pure function figure_script(figure) result(text)
      type(figure_t), intent(in) :: figure
      character(:), allocatable :: text
      type(buffer_t) :: script
      integer :: k, entries, longest
      real(wp) :: right
      logical :: is_single

      is_single = size(figure%panels) == 1
      entries = 0                            ! of the legend; all panels share that of the first
      longest = len('design')                ! characters
      associate (traces => figure%panels(1)%traces)
         do k = 1, size(traces)
            if (len(traces(k)%title) > 0) entries = entries + 1
            longest = max(longest, len(traces(k)%title))
         end do
         if (any([(allocated(traces(k)%mark), k=1, size(traces))])) entries = entries + 1
      end associate
      right = 0.97_wp
      if (entries > legend_on_top) right = 1.0_wp - real(120 + 11*longest, wp)/width

      call begin_script(script, figure%name, figure%title, 'comma')
      call script%line('set datafile columnheaders')
      do k = 1, curve_styles
         call script%line('set style line '//str(k)//' linecolor '//series_rgb(k)//" linewidth 2.6 pointtype 7 pointsize 0.7")
      end do
      call script%line("set style line 20"//ink(on_title)//" linewidth 2 pointtype 6 pointsize 1.8   # marks"//nl)
      if (entries > legend_on_top) then
         call script%line('set key at screen '//str(right + 0.015_wp)//', screen 0.88 left top vertical Left reverse samplen 2.5')
      else if (entries > 0) then
         call script%line('set key at screen 0.975, screen 0.965 right top horizontal Right noreverse samplen 2.5')
      end if
      if (is_single) then
         call script%line('set lmargin at screen 0.115; set rmargin at screen '//str(right))
         call script%line('set tmargin at screen 0.88; set bmargin at screen 0.115')
         call add_axes(script, figure%panels(1), figure%is_upward, '')
      end if
      call begin_formats(script, figure%name, width, height, merge(15, 12, is_single))
      call script%line('   set label 1 '//gnuplot_text(figure%title)// &
         " at screen 0.025, screen 0.965"//heading_style(20))
      if (len(figure%subtitle) > 0) call script%line('   set label 2 '//gnuplot_text(figure%subtitle)// &
         " at screen 0.025, screen 0.922"//subtitle_style())
      if (is_single) then
         call add_plot(script, figure, 1, entries > 0)
      else
         call script%line('   set multiplot layout '//str((size(figure%panels) + 1)/2)//', 2 margins 0.095, '// &
            str(right)//', 0.085, 0.85 spacing 0.115, 0.155')
         do k = 1, size(figure%panels)
            call script%line('')
            call add_axes(script, figure%panels(k), figure%is_upward, '   ')
            call add_plot(script, figure, k, k == 1 .and. entries > 0)
            if (k == 1) call script%line('   unset label 1; unset label 2')
         end do
         call script%line('   unset multiplot')
      end if
      call end_formats(script)
      text = script%text()
   end function figure_script

   !> Adds the title, the labels and the range of values of one panel.
   pure subroutine add_axes(script, panel, is_upward, indent)
      type(buffer_t), intent(inout) :: script
      type(chart_t), intent(in) :: panel
      logical, intent(in) :: is_upward
      character(*), intent(in) :: indent
      character(1) :: x, y

      x = merge('y', 'x', is_upward)
      y = merge('x', 'y', is_upward)
      if (len(panel%title) > 0) call script%line(indent//'set title '//gnuplot_text(panel%title)// &
         heading_style(14))
      call script%line(indent//'set '//x//'label '//label(panel%x_label, is_upward .and. len(indent) > 0)//text_ink(on_title))
      call script%line(indent//'set '//y//'label '//label(panel%y_label, .not. is_upward .and. len(indent) > 0)//text_ink(on_title))
      call script%line(indent//'set '//y//'range '//range_of(panel))
   end subroutine add_axes

   !> The string of a label. If is_folded, as in a small panel, the sign convention, '(+ …)' after four blanks, is placed on a
   !> separate line.
   pure function label(text, is_folded) result(words)
      character(*), intent(in) :: text
      logical, intent(in) :: is_folded
      character(:), allocatable :: words
      integer :: gap

      gap = index(text, '    (')
      words = gnuplot_text(text)
      if (is_folded .and. gap > 0) words = gnuplot_text(text(:gap - 1))//'."\n".'//gnuplot_text(text(gap + 4:))
   end function label

   !> Adds the plot command: the curves, then a ring at the design state of each curve that has a mark.
   pure subroutine add_plot(script, figure, number, has_legend)
      type(buffer_t), intent(inout) :: script
      type(figure_t), intent(in) :: figure
      integer, intent(in) :: number              !! index of the panel
      logical, intent(in) :: has_legend
      character(:), allocatable :: line, title
      integer :: k

      line = '   plot '
      associate (panel => figure%panels(number))
         do k = 1, size(panel%traces)
            associate (trace => panel%traces(k))
               line = line//data_of(trace%over, trace%column)//' with '//trim(merge('points', 'lines ', panel%has_points))// &
                  ' linestyle '//str(modulo(trace%colour - 1, curve_styles) + 1)
               if (trace%dash > 0 .and. .not. panel%has_points) line = line//' dashtype (12, 7)'
               title = ' notitle'
               if (has_legend .and. len(trace%title) > 0) title = ' title '//gnuplot_text(trace%title)
               line = line//title//', \'//nl//'        '
            end associate
         end do
         title = ' notitle'
         if (has_legend) title = ' title '//gnuplot_text('design')
         do k = 1, size(panel%traces)
            if (.not. allocated(panel%traces(k)%mark)) cycle
            line = line//data_of('(column("factor") == 0 ? column("'//panel%traces(k)%over//'") : NaN)', panel%traces(k)%column)// &
               ' with points linestyle 20'//title//', \'//nl//'        '
            title = ' notitle'
         end do
      end associate
      call script%line(line(:index(line, ', \', back=.true.) - 1))

   contains

      !> The gnuplot expression for the data of a curve: its columns x and y.
      pure function data_of(over, column) result(text)
         character(*), intent(in) :: over, column
         character(:), allocatable :: text

         text = gnuplot_text(figure%file)//' using '//field(over)//':'//field(column)
         if (figure%is_upward) text = gnuplot_text(figure%file)//' using '//field(column)//':'//field(over)
      end function data_of

   end subroutine add_plot

   !> The gnuplot expression for a column name; an expression in parentheses is unchanged.
   pure function field(name) result(text)
      character(*), intent(in) :: name
      character(:), allocatable :: text

      text = gnuplot_name(trim(name))
      if (index(name, '(') == 1) text = name
   end function field

   !> Lists the standard figures of a run: wheel attitude, steering axis and forces, over the wheel travel or the load.
   !> Quantities without a column or without a value are omitted. The wheel travel is drawn upward if the wheel moves by 1 mm
   !> or more. Otherwise (for instance under a lateral force), and with `factor_label` or `has_points`, the abscissa is the
   !> column `factor`.
   subroutine run_figures(table, model, case_name, csv_name, figures, factor_label, elements, has_points)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: model, case_name          !! names for the titles
      character(*), intent(in) :: csv_name                  !! file name of the table, in the folder of the scripts
      type(figure_t), allocatable, intent(out) :: figures(:)   !! named <csv without suffix>_<quantity>
      character(*), intent(in), optional :: factor_label    !! label of the load factor, with its unit; '' as if absent
      character(*), intent(in), optional :: elements(:)     !! bushings whose force is drawn; absent: all
      logical, intent(in), optional :: has_points           !! the states are independent: points without a line
      type(test_result_t) :: test
      type(chart_t) :: chart
      logical :: is_cut
      integer :: k

      allocate (figures(0))
      test%name = base_name(csv_name)
      test%table = table
      test%kind = 'other'
      test%label = ''
      if (present(factor_label)) test%label = factor_label
      if (len(test%label) > 0) test%abscissa = 'factor'
      if (present(has_points)) test%kind = trim(merge('table', 'other', has_points))
      call find_wheels(test)
      call choose_abscissa(test)
      call add_quantities('overview', 'Overview', [character(23) :: 'toe_deg', 'camber_deg', 'track_change_mm', &
         'wheelbase_change_mm'])
      call add_quantities('toe', 'Toe', ['toe_deg'])
      call add_quantities('camber', 'Camber', ['camber_deg'])
      call add_quantities('lateral', 'Lateral movement of the contact point', ['track_change_mm'])
      call add_quantities('longitudinal', 'Longitudinal movement of the contact point', ['wheelbase_change_mm'])
      call add_quantities('steer_axis', 'Steering axis', [character(23) :: 'caster_deg', 'kingpin_inclination_deg', &
         'scrub_radius_mm', 'caster_trail_mm'])
      chart = ending_chart(test, 'force', '_force_n', '', 'force, N    (+ compression)', 1.0_wp)
      chart%traces = pack(chart%traces, [(chart%traces(k)%title /= 'steering_rack', k=1, size(chart%traces))])
      call add_figure('spring_force', 'Spring force', [chart])
      chart = bushing_chart(test, elements)
      chart%title = ''
      is_cut = .false.
      if (present(elements)) is_cut = size(elements) > size(chart%traces)
      call add_figure('bushing_force', trim(merge('Bushing force, largest', 'Bushing force         ', is_cut)), [chart])

   contains

      !> Adds one figure with a panel for every quantity that has values; no figure if only one of several quantities has values.
      subroutine add_quantities(name, title, columns)
         character(*), intent(in) :: name, title, columns(:)
         type(chart_t), allocatable :: panels(:)
         integer :: k, used

         allocate (panels(size(columns)))
         used = 0
         do k = 1, size(columns)
            panels(used + 1) = quantity_chart(test, quantity_named(columns(k)))
            if (size(panels(used + 1)%traces) == 0) cycle
            used = used + 1
            panels(used)%y_label = panels(used)%title//', '//panels(used)%y_label
            if (size(columns) == 1) panels(used)%title = ''
         end do
         if (used > 1 .or. used == size(columns)) call add_figure(name, title, panels(:used))
      end subroutine add_quantities

      !> Appends a figure unless its first panel is empty.
      subroutine add_figure(name, title, panels)
         character(*), intent(in) :: name, title
         type(chart_t), intent(in) :: panels(:)
         type(figure_t) :: figure

         if (size(panels(1)%traces) == 0) return
         figure%name = test%name//'_'//name
         figure%title = title
         figure%subtitle = trim(model)//', '//trim(case_name)
         figure%file = csv_name
         figure%panels = panels
         figure%is_upward = test%abscissa == travel_column
         figures = [figures, figure]
      end subroutine add_figure

   end subroutine run_figures

end module ek_run_figures
