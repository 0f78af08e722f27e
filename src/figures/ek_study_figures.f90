!> The figures of a study. One table, `rules`, gives the conditions for drawing each figure: the kind of study, columns,
!> responses, and the numbers of factors and designs. A new figure needs a row in `rules`, a case in `script_of`, and a
!> procedure in ek_sample_figures, ek_effect_figures or a separate file.
module ek_study_figures
   use ek_text, only: plural
   use ek_study_data, only: study_data_t, has_indices
   use ek_sample_figures, only: fan_script, histogram_script, convergence_script
   use ek_scatter_figure, only: pairs_script, matrix_script
   use ek_study_panels, only: sheets_of, response_panels, column_panels, panels_text
   use ek_family_figure, only: family_script
   use ek_parallel_figure, only: parallel_script
   use ek_effect_figures, only: map_script, line_script, tornado_script, sobol_script, morris_script
   use ek_carpet_figure, only: carpet_script, study_carpet
   implicit none(type, external)
   private
   public :: figure_rule_t, rules, applies, script_of, figure_name, sheets, others

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

end module ek_study_figures
