!> The standard figures of one run: the charts of wheel attitude, steer axis and forces, over the wheel travel or the load.
module ek_plot
   use ek_kinds, only: wp
   use ek_quantity, only: quantity_named
   use ek_table, only: table_t
   use ek_test_result, only: test_result_t, find_wheels, choose_abscissa, travel_column
   use ek_chart, only: chart_t
   use ek_test_charts, only: quantity_chart, ending_chart, bushing_chart
   use ek_gnuplot, only: figure_t
   use ek_file, only: base_name
   implicit none(type, external)
   private
   public :: run_figures

contains

   !> Figures for the table of a run. Quantities without a column or without a value are omitted.
   !>
   !> The wheel travel is drawn upward if the wheel moves by 1 mm or more; otherwise (for instance under a lateral force), and
   !> with `factor_label`, the abscissa is the load factor.
   subroutine run_figures(table, model, case_name, csv_name, figures, factor_label, elements, has_points)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: model, case_name          !! for the titles
      character(*), intent(in) :: csv_name                  !! file name of the table, in the folder of the scripts
      type(figure_t), allocatable, intent(out) :: figures(:)   !! named <csv without extension>_<quantity>
      character(*), intent(in), optional :: factor_label    !! label of the load factor, with its unit
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
      if (present(factor_label)) then
         test%abscissa = 'factor'
         test%label = factor_label
      end if
      if (present(has_points)) test%kind = trim(merge('table', 'other', has_points))
      call find_wheels(test)
      call choose_abscissa(test)
      call add_quantities('overview', 'Overview', [character(23) :: 'toe_deg', 'camber_deg', 'track_change_mm', &
         'wheelbase_change_mm'])
      call add_quantities('toe', 'Toe', ['toe_deg'])
      call add_quantities('camber', 'Camber', ['camber_deg'])
      call add_quantities('lateral', 'Lateral movement of the contact patch', ['track_change_mm'])
      call add_quantities('longitudinal', 'Longitudinal movement of the contact patch', ['wheelbase_change_mm'])
      call add_quantities('steer_axis', 'Steer axis', [character(23) :: 'caster_deg', 'kingpin_inclination_deg', &
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

      !> One figure with a panel for every quantity that has a column; a single one of several has its own figure already.
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

end module ek_plot
