!> The standard figures of one run: wheel attitude, steer axis and forces over the wheel travel.
module ek_plot
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_quantity, only: quantity_t, quantity_named, label_of
   use ek_table, only: table_t, name_length, column, column_index, column_range, row_count
   use ek_test_result, only: wheel_word, least_stroke, travel => travel_column
   use ek_figure, only: figure_t, panel_t, curve_t, new_figure, new_panel, new_curve, add_curve, add_panel
   use ek_test_charts, only: largest_forces, most_curves
   use ek_file, only: base_name
   implicit none(type, external)
   private
   public :: run_figures

   !> The properties of a run that its figures use.
   type :: view_t
      character(:), allocatable :: file, stem, subtitle
      character(name_length), allocatable :: wheels(:)   !! prefixes: '', or 'left_' and 'right_'
      character(:), allocatable :: abscissa, label       !! column and axis label
      logical :: is_travel = .false.                     !! the abscissa is the travel of each wheel, drawn upward
      logical :: has_design = .false.                    !! the table has a state with factor 0
   end type view_t

contains

   !> Figures for the table of a run. Quantities without a column or without a value are omitted.
   !>
   !> The wheel travel is drawn upward if the wheel moves by 1 mm or more; otherwise (for instance under a lateral force)
   !> the abscissa is the load factor, or `abscissa` if given.
   pure subroutine run_figures(table, model, case_name, csv_name, figures, abscissa, abscissa_label, elements, has_points)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: model, case_name          !! for the titles
      character(*), intent(in) :: csv_name                  !! file name of the table, in the folder of the scripts
      type(figure_t), allocatable, intent(out) :: figures(:)   !! named <csv without extension>_<quantity>
      character(*), intent(in), optional :: abscissa        !! column of the abscissa
      character(*), intent(in), optional :: abscissa_label  !! with its unit
      character(*), intent(in), optional :: elements(:)     !! bushings whose force is drawn; absent: all with _fx_n, _fy_n, _fz_n
      logical, intent(in), optional :: has_points           !! the states are independent: points without a line
      type(view_t) :: view
      real(wp), allocatable :: factors(:)
      real(wp) :: range(2)
      integer :: f, p, k, place

      allocate (figures(0))
      view%file = csv_name
      view%stem = base_name(csv_name)
      view%subtitle = trim(model)//', '//trim(case_name)
      allocate (view%wheels(0))
      do k = 1, size(table%columns)
         place = len_trim(table%columns(k)) - len(travel)
         if (place < 0) cycle
         if (table%columns(k) (place + 1:) /= travel) cycle
         view%wheels = [character(name_length) :: view%wheels, table%columns(k) (:place)]
         range = column_range(table, table%columns(k))
         if (ieee_is_finite(range(1))) view%is_travel = view%is_travel .or. range(2) - range(1) >= least_stroke
      end do
      factors = column(table, 'factor')
      view%has_design = any(abs(pack(factors, ieee_is_finite(factors))) <= 0.0_wp)
      if (present(abscissa)) then
         view%is_travel = .false.
         view%abscissa = trim(abscissa)
         view%label = trim(abscissa)
      else if (view%is_travel) then
         view%abscissa = travel
         view%label = 'wheel travel [mm]    (+ bump)'
      else
         view%abscissa = 'factor'
         view%label = 'load factor'
      end if
      if (present(abscissa_label)) view%label = abscissa_label
      call add_quantities(figures, table, view, 'overview', 'Overview', [character(23) :: 'toe_deg', 'camber_deg', &
         'track_change_mm', 'wheelbase_change_mm'])
      call add_quantities(figures, table, view, 'toe', 'Toe', ['toe_deg'])
      call add_quantities(figures, table, view, 'camber', 'Camber', ['camber_deg'])
      call add_quantities(figures, table, view, 'lateral', 'Lateral movement of the contact patch', &
         ['track_change_mm'])
      call add_quantities(figures, table, view, 'longitudinal', 'Longitudinal movement of the contact patch', &
         ['wheelbase_change_mm'])
      call add_quantities(figures, table, view, 'steer_axis', 'Steer axis', [character(23) :: 'caster_deg', &
         'kingpin_inclination_deg', 'scrub_radius_mm', 'caster_trail_mm'])
      call add_springs(figures, table, view)
      call add_bushings(figures, table, view, elements)
      if (present(has_points)) then
         if (.not. has_points) return
         do f = 1, size(figures)
            do p = 1, size(figures(f)%panels)
               associate (curves => figures(f)%panels(p)%curves)
                  do k = 1, size(curves)
                     if (curves(k)%style /= 'mark') curves(k)%style = 'points'
                  end do
               end associate
            end do
         end do
      end if
   end subroutine run_figures

   !> One figure with a panel for every quantity that has a column.
   pure subroutine add_quantities(figures, table, view, name, title, columns)
      type(figure_t), allocatable, intent(inout) :: figures(:)
      type(table_t), intent(in) :: table
      type(view_t), intent(in) :: view
      character(*), intent(in) :: name, title
      character(*), intent(in) :: columns(:)
      type(quantity_t) :: quantity
      type(figure_t) :: figure
      type(panel_t) :: panel
      character(name_length) :: wanted
      real(wp) :: range(2), middle, width
      integer :: k, wheel

      figure = new_figure(view%stem//'_'//name, title, view%subtitle)
      do k = 1, size(columns)
         quantity = quantity_named(columns(k))
         panel = view_panel(view, trim(quantity%title), trim(quantity%title)//', '//label_of(quantity))
         if (size(columns) == 1) panel%title = ''
         middle = 0.0_wp
         width = 0.0_wp
         do wheel = 1, size(view%wheels)
            wanted = trim(view%wheels(wheel))//columns(k)
            range = column_range(table, wanted)
            if (.not. ieee_is_finite(range(1))) cycle
            middle = sum(range)/2
            width = max(width, range(2) - range(1))
            call add_curve(panel, new_curve(view%file, abscissa_of(view, view%wheels(wheel)), trim(wanted), &
               wheel_word(view%wheels(wheel)), trim(merge('dashed', 'line  ', wheel > 1)), wheel))
         end do
         if (size(panel%curves) == 0) cycle
         if (width < quantity%span) panel%least_y = middle + quantity%span*[-1.0_wp, 1.0_wp]
         call mark_design(panel, view)
         call add_panel(figure, panel)
      end do
      if (size(figure%panels) == 0) return
      if (size(figure%panels) == 1 .and. size(columns) > 1) return    ! a single quantity already has its own figure
      figures = [figures, figure]
   end subroutine add_quantities

   !> Force of every spring, damper and stop: columns <name>_force_n beside <name>_length_mm or <name>_gap_mm.
   pure subroutine add_springs(figures, table, view)
      type(figure_t), allocatable, intent(inout) :: figures(:)
      type(table_t), intent(in) :: table
      type(view_t), intent(in) :: view
      character(*), parameter :: tail = '_force_n'
      type(figure_t) :: figure
      type(panel_t) :: panel
      integer :: k, place

      figure = new_figure(view%stem//'_spring_force', 'Spring force', view%subtitle)
      panel = view_panel(view, '', 'force [N]    (+ compression)')
      do k = 1, size(table%columns)
         place = len_trim(table%columns(k)) - len(tail)
         if (place < 1 .or. size(panel%curves) >= most_curves) cycle
         if (table%columns(k) (place + 1:) /= tail) cycle
         if (column_index(table, table%columns(k) (:place)//'_length_mm') == 0 .and. &     ! a wheel force has neither
            column_index(table, table%columns(k) (:place)//'_gap_mm') == 0) cycle
         if (.not. any(ieee_is_finite(table%values(k, :)))) cycle
         call add_curve(panel, new_curve(view%file, abscissa_of(view, table%columns(k)), &
            trim(table%columns(k)), table%columns(k) (:place)))
      end do
      if (size(panel%curves) == 0) return
      call mark_design(panel, view)
      call add_panel(figure, panel)
      figures = [figures, figure]
   end subroutine add_springs

   !> Magnitude of the force of every bushing; of many bushings those with the largest force.
   pure subroutine add_bushings(figures, table, view, elements)
      type(figure_t), allocatable, intent(inout) :: figures(:)
      type(table_t), intent(in) :: table
      type(view_t), intent(in) :: view
      character(*), intent(in), optional :: elements(:)
      character(name_length), allocatable :: names(:)
      real(wp), allocatable :: force(:, :)
      type(figure_t) :: figure
      type(panel_t) :: panel
      logical :: is_cut
      integer :: k

      call largest_forces(table, spread(.true., 1, row_count(table)), names, force, is_cut, elements)
      figure = new_figure(view%stem//'_bushing_force', 'Bushing force', view%subtitle)
      if (is_cut) figure%title = 'Bushing force, largest'
      panel = view_panel(view, '', 'force, magnitude [N]')
      do k = 1, size(names)
         call add_curve(panel, new_curve(view%file, abscissa_of(view, names(k)), &
            '(sqrt(column("'//trim(names(k))//'_fx_n")**2 + column("'//trim(names(k))//'_fy_n")**2 + column("'// &
            trim(names(k))//'_fz_n")**2))', trim(names(k))))
      end do
      if (size(panel%curves) == 0) return
      panel%least_y = [0.0_wp, 1.0_wp]
      call add_panel(figure, panel)
      figures = [figures, figure]
   end subroutine add_bushings


   !> Empty axes: wheel travel upward, a load factor to the right.
   pure type(panel_t) function view_panel(view, title, label) result(panel)
      type(view_t), intent(in) :: view
      character(*), intent(in) :: title, label

      panel = new_panel(title, view%label, label)
      panel%swap = view%is_travel
   end function view_panel

   !> Marks the state without case load by a ring on every curve.
   pure subroutine mark_design(panel, view)
      type(panel_t), intent(inout) :: panel
      type(view_t), intent(in) :: view
      type(curve_t) :: mark
      integer :: k

      if (.not. view%has_design) return
      do k = 1, size(panel%curves)
         mark = panel%curves(k)
         mark%x = '(column("factor") == 0 ? column("'//mark%x//'") : NaN)'
         mark%style = 'mark'
         mark%title = ''
         if (k == 1) mark%title = 'design'
         call add_curve(panel, mark)
      end do
   end subroutine mark_design

   !> The abscissa of a wheel, or of an element whose name begins with that of a wheel.
   pure function abscissa_of(view, element) result(name)
      type(view_t), intent(in) :: view
      character(*), intent(in) :: element
      character(:), allocatable :: name
      integer :: k

      name = view%abscissa
      if (.not. view%is_travel) return
      name = trim(view%wheels(1))//travel
      do k = 2, size(view%wheels)
         if (index(element, trim(view%wheels(k))) == 1) name = trim(view%wheels(k))//travel
      end do
   end function abscissa_of

end module ek_plot
