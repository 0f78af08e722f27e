!> The figures of a study. One table, `rules`, gives the conditions for drawing each figure: the kind of study, columns,
!> responses, and the numbers of factors and designs. A new figure needs a row in `rules`, a case in `figure_of`, and a
!> procedure in ek_sample_figures, ek_effect_figures or a separate file.
!>
!> Drawn here: the curves of the designs, where each panel is coloured by the factor with the largest effect on its
!> curves, and parallel coordinates, one line per design across factors and responses.
module ek_study_figures
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_text, only: plural, str
   use ek_study_data, only: study_data_t, has_indices, is_geometric, range_of_values
   use ek_sample_figures, only: fan_figure, histogram_figure, convergence_figure, thinned, colour_by, cut
   use ek_scatter_figure, only: pairs_figure, matrix_figure, most_columns, leading_factors
   use ek_study_panels, only: sheets_of, response_panels, column_panels, panels_text
   use ek_effect_figures, only: map_figure, line_figure, tornado_figure, sobol_figure, morris_figure
   use ek_carpet_figure, only: carpet_figure, study_carpet
   use ek_kinds, only: wp
   use ek_figure, only: figure_t, new_figure, add_series, add_label, fold_at, as_line, as_segments
   use ek_gnuplot, only: on_level, on_label, on_result, on_soft, on_title
   implicit none(type, external)
   private
   public :: figure_rule_t, rules, applies, figure_of, figure_name, sheets, others, family_figure, curve_leader, parallel_figure

   integer, parameter :: most_curves = 300           !! largest number of designs with curves in the figure

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

   !> One sheet of a figure that applies.
   function figure_of(rule, study, sheet) result(figure)
      type(figure_rule_t), intent(in) :: rule
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: sheet
      type(figure_t) :: figure
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
         figure = tornado_figure(study, name, subtitle, panels)
      case ('sobol')
         figure = sobol_figure(study, name, subtitle, panels)
      case ('morris')
         figure = morris_figure(study, name, subtitle, panels)
      case ('line')
         figure = line_figure(study, name, subtitle, panels)
      case ('map')
         figure = map_figure(study, name, subtitle, panels)
      case ('carpet')
         figure = carpet_figure(study_carpet(study, panels), name, 'Carpet over two factors', subtitle)
      case ('fan')
         figure = fan_figure(study, name, subtitle, panels)
      case ('family')
         figure = family_figure(study, name, subtitle, panels)
      case ('histogram')
         figure = histogram_figure(study, name, subtitle, panels)
      case ('scatter')
         if (sheet == 1) figure = pairs_figure(study, name, subtitle)
         if (sheet == 2) figure = matrix_figure(study, name, subtitle)
      case ('parallel')
         figure = parallel_figure(study, name, subtitle)
      case ('convergence')
         figure = convergence_figure(study, name, subtitle, panels)
      end select
   end function figure_of

   !> The curves, with one panel per column. Of more than 300 designs, only some are drawn.
   function family_figure(study, name, subtitle, panels) result(figure)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the columns
      character(*), intent(in) :: name, subtitle
      type(figure_t) :: figure
      integer, allocatable :: leaders(:)
      logical :: is_common
      integer :: c, every

      every = (size(study%drawn) + most_curves - 1)/most_curves
      figure = new_figure(name, 'The curves of all designs', '', size(panels))
      if (size(study%drawn)*every < study%designs .or. every > 1) figure%title = 'The curves of some designs'
      allocate (leaders(size(panels)))
      do c = 1, size(panels)
         leaders(c) = curve_leader(study, panels(c))
      end do
      is_common = all(leaders == leaders(1))
      if (is_common) figure%scale_label = study%factors(leaders(1))%label
      figure%subtitle = subtitle// &
         thinned(every*max(1, study%designs/max(1, size(study%drawn))), study%designs)
      if (.not. is_common) figure%subtitle = figure%subtitle//'; colour: from dark to light the factor above each panel'
      do c = 1, size(panels)
         associate (panel => figure%panels(c))
            if (.not. is_common) panel%title = range_words(leaders(c))
            panel%x%label = study%swept
            panel%y%label = study%columns(panels(c))%label
            call colour_by(panel, study%x(leaders(c), :))
            call add_series(panel, as_line, on_level, curves_of(study, panels(c), leaders(c), every), weight=1.0_wp, &
               is_by_value=.true.)
         end associate
      end do

   contains

      !> A factor and its range.
      function range_words(factor) result(words)
         integer, intent(in) :: factor
         character(:), allocatable :: words
         real(wp) :: range(2)

         range = range_of_values(study%x(factor, :))
         words = study%factors(factor)%label//' '//str(range(1), 4)//' … '//str(range(2), 4)
      end function range_words

   end function family_figure

   !> The curves of every `every`-th design: swept value, column and factor, with a gap after each curve.
   function curves_of(study, column, factor, every) result(values)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: column, factor, every
      real(wp), allocatable :: values(:, :)
      integer :: k, j, rows

      allocate (values(3, size(study%drawn)*(size(study%sweep) + 1)))
      rows = 0
      do k = 1, size(study%drawn), every
         do j = 1, size(study%sweep)
            if (.not. any(ieee_is_finite(study%curves(:, j, k)))) cycle
            rows = rows + 1
            values(:, rows) = [study%sweep(j), study%curves(column, j, k), study%x(factor, study%drawn(k))]
         end do
         rows = rows + 1
         values(:, rows) = ieee_value(1.0_wp, ieee_quiet_nan)
      end do
      values = values(:, :rows)
   end function curves_of

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

   !> The parallel coordinates: one line per design across the leading factors and up to four responses, coloured by the first
   !> response. Of more than 300 designs, only some are drawn. Designs without a value of a response are omitted.
   function parallel_figure(study, name, subtitle) result(figure)
      type(study_data_t), intent(in) :: study
      character(*), intent(in) :: name, subtitle
      type(figure_t) :: figure
      integer, allocatable :: factors(:)
      real(wp), allocatable :: values(:, :), lines(:, :)
      real(wp) :: range(2), height
      character(:), allocatable :: label
      integer :: k, d, n, every, rows, role, at

      allocate (factors(min(most_columns, size(study%factors))))
      factors(:) = leading_factors(study, most_columns)
      n = size(factors) + min(size(study%responses), 4)
      allocate (values(n, study%designs))
      values(:size(factors), :) = study%x(factors, :study%designs)
      values(size(factors) + 1:, :) = study%y(:n - size(factors), :study%designs)
      every = max(1, (study%designs + most_lines - 1)/most_lines)
      figure = new_figure(name, 'Factors and responses of each design', subtitle// &
         '; one line per design'//thinned(every, study%designs)// &
         cut(size(factors), size(study%factors), 'factors')//cut(n - size(factors), size(study%responses), 'responses'), 1, &
         height=600)
      figure%right = 95
      figure%left = 95
      figure%bottom = 24
      figure%letters = merge(12, 14, n > 7)
      figure%scale_label = study%responses(1)%label
      associate (panel => figure%panels(1))
         panel%frame = 0
         panel%x%has_tics = .false.
         panel%y%has_tics = .false.
         panel%x%has_grid = .false.
         panel%y%has_grid = .false.
         panel%x%has_zero = .false.
         panel%y%has_zero = .false.
         panel%x%has_range = .true.
         panel%y%has_range = .true.
         panel%x%range = [0.8_wp, n + 0.2_wp]
         panel%y%range = [-0.09_wp, 1.25_wp]
         panel%note = 'no design has all values'
         call colour_by(panel, study%y(1, :))
         panel%value%is_log = .false.
         allocate (lines(3, (n + 1)*study%designs))
         rows = 0
         do d = 1, study%designs, every
            if (.not. all(ieee_is_finite(study%y(:n - size(factors), d)))) cycle
            do k = 1, n
               range = ends_of(k)
               rows = rows + 1
               lines(:, rows) = [real(k, wp), (values(k, d) - range(1))/max(range(2) - range(1), tiny(1.0_wp)), study%y(1, d)]
            end do
            rows = rows + 1
            lines(:, rows) = ieee_value(1.0_wp, ieee_quiet_nan)
         end do
         call add_series(panel, as_line, on_level, lines(:, :rows), weight=1.0_wp, is_by_value=.true.)
         do k = 1, n
            range = ends_of(k)
            call add_series(panel, as_segments, on_label, reshape([1.0_wp*k, 0.0_wp, 0.0_wp, 1.0_wp], [4, 1]), weight=1.5_wp)
            role = merge(on_title, on_result, k <= size(factors))
            height = merge(1.21_wp, 1.12_wp, modulo(k, 2) == 1)
            if (k <= size(factors)) label = study%factors(factors(k))%label
            if (k > size(factors)) label = study%responses(k - size(factors))%label
            at = fold_at(label, 18)
            if (at == 0) call add_label(panel, label, real(k, wp), height, role)
            if (at > 0) call add_label(panel, trim(label(:at)), real(k, wp), height + 0.025_wp, role)
            if (at > 0) call add_label(panel, label(at + 1:), real(k, wp), height - 0.025_wp, role)
            call add_label(panel, str(range(1), 5), real(k, wp), -0.045_wp, on_soft)
            call add_label(panel, str(range(2), 5), real(k, wp), 1.035_wp, on_soft)
         end do
      end associate

   contains

      !> The smallest and the largest value of a factor or response.
      function ends_of(k) result(range)
         integer, intent(in) :: k
         real(wp) :: range(2)
         range = range_of_values(values(k, :))
      end function ends_of

   end function parallel_figure

end module ek_study_figures
