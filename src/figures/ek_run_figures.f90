!> A figure as a gnuplot script that the user can read, edit and run again. In the folder of the script, `gnuplot name.gp`
!> draws name.png and name.svg from the data files in this folder. This module also lists the standard figures of one run.
module ek_run_figures
   use ek_kinds, only: wp
   use ek_file, only: base_name
   use ek_chart, only: chart_t, range_of
   use ek_figure, only: sheet_t => figure_t, panel_t, new_figure, add_source, title_height
   use ek_figure_script, only: script_of => figure_script
   use ek_gnuplot, only: ink, series_rgb, on_title
   use ek_gnuplot_text, only: gnuplot_text, gnuplot_name
   use ek_quantity, only: quantity_named
   use ek_table, only: table_t
   use ek_test_result, only: test_result_t, find_wheels, choose_abscissa, travel_column
   use ek_test_charts, only: quantity_chart, ending_chart, bushing_chart
   implicit none(type, external)
   private
   public :: figure_t, figure_script, run_figures

   integer, parameter :: full_picture = 900  !! height of a picture [pixels]
   integer, parameter :: legend_on_top = 3   !! most curves of a legend above the panel; a longer legend is at the right

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
   function figure_script(figure) result(text)
      type(figure_t), intent(in) :: figure
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      integer :: k, entries, longest, rows

      entries = 0                            ! of the legend; all panels share that of the first
      longest = len('design')                ! characters
      associate (traces => figure%panels(1)%traces)
         do k = 1, size(traces)
            if (len(traces(k)%title) > 0) entries = entries + 1
            longest = max(longest, len(traces(k)%title))
         end do
      end associate
      rows = (size(figure%panels) + 1)/2
      sheet = new_figure(figure%name, figure%title, figure%subtitle, size(figure%panels), height=(full_picture - title_height)/rows)
      sheet%columns = merge(1, 2, size(figure%panels) == 1)
      sheet%letters = merge(15, 12, size(figure%panels) == 1)
      sheet%separator = ','
      sheet%has_heads = .true.
      if (entries >= legend_on_top) sheet%key_width = 100 + 11*longest
      do k = 1, size(figure%panels)
         call fill_panel(sheet%panels(k), figure, k)
      end do
      text = script_of(sheet)
   end function figure_script

   !> Fills a panel with the curves of a chart, which gnuplot reads from the table of the figure, then with a ring at the design
   !> state of each curve that has a mark. The first panel has the legend.
   subroutine fill_panel(panel, figure, number)
      type(panel_t), intent(inout) :: panel
      type(figure_t), intent(in) :: figure
      integer, intent(in) :: number              !! index of the panel
      character(:), allocatable :: look
      logical :: has_mark
      integer :: k

      associate (chart => figure%panels(number))
         panel%title = chart%title
         if (figure%is_upward) then
            panel%x%label = chart%y_label
            panel%y%label = chart%x_label
            panel%x%free_range = range_of(chart)
         else
            panel%x%label = chart%x_label
            panel%y%label = chart%y_label
            panel%y%free_range = range_of(chart)
         end if
         k = index(panel%y%label, '    (')       ! in a small panel, the sign is on a separate line
         if (size(figure%panels) > 1 .and. k > 0) panel%y%label = panel%y%label(:k - 1)//nl//panel%y%label(k + 4:)
         do k = 1, size(chart%traces)
            associate (trace => chart%traces(k))
               look = ' with lines linewidth 2.6'
               if (trace%dash > 0) look = look//' dashtype (12, 7)'
               if (chart%has_points) look = ' with points pointtype 7 pointsize 0.7'
               call add_curve(trace%over, trace%column, look//' linecolor '//series_rgb(trace%colour), trace%title)
            end associate
         end do
         has_mark = .false.
         do k = 1, size(chart%traces)
            if (.not. allocated(chart%traces(k)%mark)) cycle
            call add_curve('(column("factor") == 0 ? column("'//chart%traces(k)%over//'") : NaN)', chart%traces(k)%column, &
               ' with points pointtype 6 pointsize 1.8 linewidth 2'//ink(on_title), trim(merge('      ', 'design', has_mark)))
            has_mark = .true.
         end do
      end associate

   contains

      !> Adds the columns x and y of the table of the figure.
      subroutine add_curve(over, column, look, title)
         character(*), intent(in) :: over, column, look, title
         character(:), allocatable :: source

         source = gnuplot_text(figure%file)//' using '//field(over)//':'//field(column)//look
         if (figure%is_upward) source = gnuplot_text(figure%file)//' using '//field(column)//':'//field(over)//look
         if (number == 1 .and. title /= '') call add_source(panel, source, title)
         if (number > 1 .or. title == '') call add_source(panel, source)
      end subroutine add_curve

   end subroutine fill_panel

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
