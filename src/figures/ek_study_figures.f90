!> The figures of a study. One table, `rules`, gives the conditions for drawing each figure: the kind of study, columns,
!> responses, and the numbers of factors and designs. A new figure needs a row in `rules`, a case in `script_of`, and a
!> procedure in ek_sample_figures, ek_effect_figures or a separate file.
!>
!> Drawn here: the curves of the designs, where each panel is coloured by the factor with the largest effect on its
!> curves, and parallel coordinates, one line per design across factors and responses.
module ek_study_figures
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_text, only: plural, str
   use ek_study_data, only: study_data_t, has_indices, is_geometric, range_of_values
   use ek_sample_figures, only: fan_script, histogram_script, convergence_script, thinned, add_scale, cut
   use ek_scatter_figure, only: pairs_script, matrix_script, most_columns, leading_factors
   use ek_study_panels, only: sheets_of, response_panels, column_panels, panels_text
   use ek_effect_figures, only: map_script, line_script, tornado_script, sobol_script, morris_script
   use ek_carpet_figure, only: carpet_script, study_carpet
   use ek_kinds, only: wp
   use ek_study_sheet, only: sheet_t, new_sheet, begin_data, add_numbers, end_data, begin_panels, begin_panel, end_panels, &
      two_lines
   use ek_gnuplot, only: ink, text_ink, value_colours, on_label, on_result, on_soft, on_title
   use ek_gnuplot_text, only: gnuplot_text
   implicit none(type, external)
   private
   public :: figure_rule_t, rules, applies, script_of, figure_name, sheets, others, family_script, curve_leader, parallel_script

   integer, parameter :: most_curves = 300           !! largest number of designs with curves in the figure

   character(*), parameter :: nl = new_line('a')
   integer, parameter :: most_lines = 300            !! largest number of lines of the figure

   !> The conditions for drawing a figure.
   type :: figure_rule_t
      character(11) :: name
      character(48) :: title
      character(80) :: kinds             !! kinds of study; '*': all
      character(9) :: panels             !! a panel for each of 'responses', 'columns', 'pairs' (response and factor); '': one
      logical :: needs_curves            !! the figure needs columns in &study and designs with curves
      logical :: needs_responses
      integer :: least_factors, most_factors
      integer :: least_designs
   end type figure_rule_t

   character(*), parameter :: samples = 'monte_carlo latin_hypercube sobol saltelli list tolerance'
   integer, parameter :: no_end = huge(1)

   type(figure_rule_t), parameter :: rules(*) = [ &
      figure_rule_t('tornado', 'Tornado: one factor at a time', 'one_at_a_time tolerance', 'responses', .false., .true., 1, &
      no_end, 2), &
      figure_rule_t('sobol', 'Sobol indices', 'saltelli list tolerance', 'responses', .false., .true., 1, no_end, 6), &
      figure_rule_t('morris', 'Morris'' elementary effects', 'morris', 'responses', .false., .true., 1, no_end, 4), &
      figure_rule_t('line', 'Responses over the factor', 'grid', 'responses', .false., .true., 1, 1, 2), &
      figure_rule_t('map', 'Contours over two factors', 'grid', 'responses', .false., .true., 2, 2, 4), &
      figure_rule_t('carpet', 'Carpet over two factors', 'grid', 'responses', .false., .true., 2, 2, 4), &
      figure_rule_t('fan', 'Band of the curves', samples, 'columns', .true., .false., 1, no_end, 10), &
      figure_rule_t('family', 'Family of curves', '*', 'columns', .true., .false., 1, no_end, 2), &
      figure_rule_t('histogram', 'Distribution of the responses', samples, 'responses', .false., .true., 1, no_end, 10), &
      figure_rule_t('scatter', 'Responses over factors', samples, 'pairs', .false., .true., 1, no_end, 5), &
      figure_rule_t('parallel', 'Parallel coordinates', samples//' grid', '', .false., .true., 2, no_end, 5), &
      figure_rule_t('convergence', 'Convergence of the mean', 'monte_carlo latin_hypercube sobol tolerance', 'responses', .false., &
      .true., 1, no_end, 10)]

contains

   !> Whether a figure applies to a study.
   pure logical function applies(rule, study)
      type(figure_rule_t), intent(in) :: rule
      type(study_data_t), intent(in) :: study

      applies = rule%kinds == '*' .or. index(' '//rule%kinds, ' '//trim(study%kind)//' ') > 0
      if (rule%needs_curves) applies = applies .and. size(study%columns) > 0 .and. size(study%drawn) > 0
      if (rule%needs_responses) applies = applies .and. any(study%summaries%used > 0)
      applies = applies .and. size(study%factors) >= rule%least_factors .and. size(study%factors) <= rule%most_factors .and. &
         study%designs >= rule%least_designs
      if (applies .and. rule%name == 'sobol') applies = has_indices(study)
      if (applies .and. rule%name == 'tornado' .and. study%kind == 'tolerance') applies = has_indices(study)
      if (applies .and. any([character(11) :: 'map', 'carpet'] == rule%name)) &
         applies = maxval(study%x(1, :)) > minval(study%x(1, :)) .and. maxval(study%x(2, :)) > minval(study%x(2, :))
   end function applies

   !> The number of panels that a figure would have if it had only one sheet.
   pure integer function panels_of(rule, study)
      type(figure_rule_t), intent(in) :: rule
      type(study_data_t), intent(in) :: study

      panels_of = 1
      if (rule%panels == 'responses') panels_of = size(study%responses)
      if (rule%panels == 'columns') panels_of = size(study%columns)
      if (rule%panels == 'pairs') panels_of = size(study%responses)*size(study%factors)
   end function panels_of

   !> Number of sheets of a figure that applies, 1 or 2. The first sheet has the strongest panels, the second the others.
   pure integer function sheets(rule, study)
      type(figure_rule_t), intent(in) :: rule
      type(study_data_t), intent(in) :: study
      sheets = sheets_of(panels_of(rule, study))
   end function sheets

   !> Description of the second sheet: 'the other responses', or 'the matrix'.
   pure function others(rule) result(text)
      type(figure_rule_t), intent(in) :: rule
      character(:), allocatable :: text

      text = 'the other '//trim(rule%panels)
      if (rule%panels == 'pairs') text = 'the matrix'
   end function others

   !> The base name of a figure's files: '<study>_<figure>'; '<study>_<figure>_more' for the second sheet.
   pure function figure_name(rule, study, sheet) result(name)
      type(figure_rule_t), intent(in) :: rule
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: sheet
      character(:), allocatable :: name

      name = study%name//'_'//trim(rule%name)
      if (sheet == 2) name = name//'_more'
   end function figure_name

   !> The gnuplot script of one sheet of a figure that applies.
   function script_of(rule, study, sheet) result(text)
      type(figure_rule_t), intent(in) :: rule
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: sheet
      character(:), allocatable :: text
      character(:), allocatable :: name, subtitle
      integer, allocatable :: panels(:)

      name = figure_name(rule, study, sheet)
      subtitle = study%name//', '//plural(study%designs, 'design', 'designs')
      if (rule%panels == 'responses' .or. rule%panels == 'columns') subtitle = subtitle// &
         panels_text(panels_of(rule, study), sheet, trim(rule%panels))
      if (rule%panels == 'responses') panels = response_panels(study, sheet)
      if (rule%panels == 'columns') panels = column_panels(study, sheet)
      select case (rule%name)
      case ('tornado')
         text = tornado_script(study, name, subtitle, panels)
      case ('sobol')
         text = sobol_script(study, name, subtitle, panels)
      case ('morris')
         text = morris_script(study, name, subtitle, panels)
      case ('line')
         text = line_script(study, name, subtitle, panels)
      case ('map')
         text = map_script(study, name, subtitle, panels)
      case ('carpet')
         text = carpet_script(study_carpet(study, panels), name, 'Carpet over two factors', subtitle)
      case ('fan')
         text = fan_script(study, name, subtitle, panels)
      case ('family')
         text = family_script(study, name, subtitle, panels)
      case ('histogram')
         text = histogram_script(study, name, subtitle, panels)
      case ('scatter')
         if (sheet == 1) text = pairs_script(study, name, subtitle)
         if (sheet == 2) text = matrix_script(study, name, subtitle)
      case ('parallel')
         text = parallel_script(study, name, subtitle)
      case ('convergence')
         text = convergence_script(study, name, subtitle, panels)
      case default
         text = ''
      end select
   end function script_of

   !> The gnuplot script of the curves, with one panel per column. Of more than 300 designs, only some are drawn.
   function family_script(study, name, subtitle, panels) result(text)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the columns
      character(*), intent(in) :: name, subtitle
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      integer, allocatable :: leaders(:)
      logical :: is_common
      integer :: c, every

      every = (size(study%drawn) + most_curves - 1)/most_curves
      sheet = new_sheet(name, 'The curves of all designs', '', size(panels))
      if (size(study%drawn)*every < study%designs .or. every > 1) sheet%title = 'The curves of some designs'
      allocate (leaders(sheet%panels))
      do c = 1, sheet%panels
         leaders(c) = curve_leader(study, panels(c))
      end do
      is_common = all(leaders == leaders(1))
      sheet%has_scale = is_common
      sheet%subtitle = subtitle// &
         thinned(every*max(1, study%designs/max(1, size(study%drawn))), study%designs)
      if (.not. is_common) sheet%subtitle = sheet%subtitle//'; colour: from dark to light the factor above each panel'
      call add_curves(sheet, study, panels, leaders, every)
      call begin_panels(sheet)
      call sheet%text%line(value_colours)
      if (is_common) call add_scale(sheet, study%factors(leaders(1))%label, study%x(leaders(1), :))
      do c = 1, sheet%panels
         call begin_panel(sheet, c, trim(above(c)), study%swept, study%columns(panels(c))%label)
         if (c == 2 .or. .not. is_common) call sheet%text%line('unset colorbox')
         call sheet%text%line('unset logscale cb')
         if (is_geometric(study%x(leaders(c), :))) call sheet%text%line('set logscale cb')
         call sheet%text%line('plot $curves using 1:'//str(1 + sheet%panels + c)//':'//str(1 + c)// &
            ' with lines linewidth 1 linecolor palette notitle')
      end do
      text = end_panels(sheet)

   contains

      !> Title above a panel if the panels have different factors: the factor of the panel and its range. Otherwise ''.
      function above(panel) result(words)
         integer, intent(in) :: panel
         character(:), allocatable :: words
         real(wp) :: range(2)

         words = ''
         if (is_common) return
         range = range_of_values(study%x(leaders(panel), :))
         words = study%factors(leaders(panel))%label//' '//str(range(1), 4)//' … '//str(range(2), 4)
      end function above

   end function family_script

   !> Adds the data of every `every`-th design: swept value, the factor of each panel, and the column of each panel.
   subroutine add_curves(sheet, study, panels, leaders, every)
      type(sheet_t), intent(inout) :: sheet
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:), leaders(:), every
      integer :: k, j

      call begin_data(sheet, 'curves')
      do k = 1, size(study%drawn), every
         do j = 1, size(study%sweep)
            if (.not. any(ieee_is_finite(study%curves(:, j, k)))) cycle
            call add_numbers(sheet, [study%sweep(j), study%x(leaders, study%drawn(k)), study%curves(panels, j, k)])
         end do
         call sheet%text%line('')
      end do
      call end_data(sheet)
   end subroutine add_curves

   !> Index of the factor that explains most of the scatter of a column. The measure is the squared correlation of factor and column
   !> over all swept values, weighted with the variance of the column at each swept value.
   pure integer function curve_leader(study, column) result(leader)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: column
      real(wp) :: explained(size(study%factors))
      integer :: f, j

      explained = 0.0_wp
      do j = 1, size(study%sweep)
         do f = 1, size(explained)
            explained(f) = explained(f) + explained_variance(study%x(f, study%drawn), study%curves(column, j, :))
         end do
      end do
      leader = maxloc(explained, dim=1)
   end function curve_leader

   !> The part of the variance of y that a straight line over x explains, times the number of designs. Designs without values
   !> are omitted; with less than two designs, the part is 0.
   pure real(wp) function explained_variance(x, y) result(part)
      real(wp), intent(in) :: x(:), y(:)
      logical :: is_used(size(x))
      real(wp) :: xx, xy, mean(2)
      integer :: n

      part = 0.0_wp
      is_used = ieee_is_finite(x) .and. ieee_is_finite(y)
      n = count(is_used)
      if (n < 2) return
      mean = [sum(x, mask=is_used), sum(y, mask=is_used)]/n
      xx = sum((x - mean(1))**2, mask=is_used)
      xy = sum((x - mean(1))*(y - mean(2)), mask=is_used)
      if (xx > 0.0_wp) part = xy**2/xx
   end function explained_variance

   !> The script of the parallel coordinates: one line per design across the leading factors and up to four responses,
   !> coloured by the first response. Of more than 300 designs, only some are drawn. Designs without a value of a response are
   !> omitted.
   function parallel_script(study, name, subtitle) result(text)
      type(study_data_t), intent(in) :: study
      character(*), intent(in) :: name, subtitle
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      integer, allocatable :: factors(:)
      real(wp), allocatable :: values(:, :), low(:), span(:)
      real(wp) :: range(2)
      character(:), allocatable :: place
      integer :: k, d, n, every

      allocate (factors(min(most_columns, size(study%factors))))
      factors(:) = leading_factors(study, most_columns)
      n = size(factors) + min(size(study%responses), 4)
      values = reshape([study%x(factors, :)], [size(factors), study%designs])
      allocate (low(n), span(n))
      every = max(1, (study%designs + most_lines - 1)/most_lines)
      sheet = new_sheet(name, 'Factors and responses of each design', subtitle// &
         '; one line per design'//thinned(every, study%designs)// &
         cut(size(factors), size(study%factors), 'factors')//cut(n - size(factors), size(study%responses), 'responses'), 1, &
         height=600)
      sheet%has_scale = .true.
      sheet%right = 95
      sheet%left = 95
      sheet%bottom = 24
      sheet%letters = merge(12, 14, n > 7)
      do k = 1, n
         if (k <= size(factors)) range = range_of_values(values(k, :))
         if (k > size(factors)) range = range_of_values(study%y(k - size(factors), :))
         low(k) = range(1)
         span(k) = max(range(2) - range(1), tiny(1.0_wp))
      end do
      call begin_data(sheet, 'lines')
      do d = 1, study%designs, every
         if (.not. all(ieee_is_finite(study%y(:n - size(factors), d)))) cycle
         do k = 1, n
            if (k <= size(factors)) range(1) = values(k, d)
            if (k > size(factors)) range(1) = study%y(k - size(factors), d)
            call add_numbers(sheet, [real(k, wp), (range(1) - low(k))/span(k), study%y(1, d)])
         end do
         call sheet%text%line('')
      end do
      call end_data(sheet)
      call begin_panels(sheet)
      call sheet%text%line(value_colours//nl// &
         'unset border; unset grid; unset xzeroaxis; unset yzeroaxis; unset ytics; unset xtics')
      call sheet%text%line('set xrange [0.8:'//str(n + 0.2_wp)//']; set yrange [-0.09:1.25]')
      call add_scale(sheet, study%responses(1)%label, study%y(1, :))
      do k = 1, n
         place = ' at first '//str(k)//', first '
         call sheet%text%line('set arrow '//str(k)//' from first '//str(k)//', first 0 to first '//str(k)// &
            ", first 1 nohead front linewidth 1.5"//ink(on_label))
         if (k <= size(factors)) then
            call sheet%text%line('set label '//str(10 + k)//' '//two_lines(study%factors(factors(k))%label, 18)//place// &
               trim(merge('1.21', '1.12', modulo(k, 2) == 1))//" center"//text_ink(on_title))
         else
            call sheet%text%line('set label '//str(10 + k)//' '//two_lines(study%responses(k - size(factors))%label, 18)//place// &
               trim(merge('1.21', '1.12', modulo(k, 2) == 1))//" center"//text_ink(on_result))
         end if
         call sheet%text%line('set label '//str(40 + k)//' '//gnuplot_text(str(low(k), 5))//place// &
            "-0.045 center"//text_ink(on_soft))
         call sheet%text%line('set label '//str(70 + k)//' '//gnuplot_text(str(low(k) + span(k), 5))//place// &
            "1.035 center"//text_ink(on_soft))
      end do
      call begin_panel(sheet, 1, '', '', '')
      call sheet%text%line("plot $lines using 1:2:3 with lines linewidth 1 linecolor palette notitle")
      call sheet%text%line('set cbtics autofreq; unset label; unset arrow; set border 3; set xrange [*:*]; set yrange [*:*]')
      text = end_panels(sheet)
   end function parallel_script

end module ek_study_figures
