!> The page of a study: its question, factors, responses with statistics, failures, figures, and the best and worst designs.
module ek_study_page
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str, plural
   use ek_version, only: version
   use ek_study_data, only: study_data_t, study_axis_t, summary_t, percents, methods, range_of_values, yield_interval
   use ek_study_figures, only: rules, applies, figure_of, sheets, others
   use ek_figure, only: figure_t
   use ek_figure_data, only: figures_json
   use ek_effect_table, only: add_effects
   use ek_factor_order, only: most_open, factor_order, strongest_names, effect_measure
   use ek_number_words, only: limits_text
   use ek_page, only: page_t, begin_page, begin_section, add_text, add_warnings, add_facts, put_fact, begin_table, add_cell, &
      add_numbers, add_group, begin_fold, end_fold, end_table, add_figure, set_data, page_text, page_number
   implicit none(type, external)
   private
   public :: study_page, page_name

   integer, parameter :: most_as_text = 100      !! largest number of responses whose table is also text without script

   character(*), parameter :: method_words(3) = [character(26) :: 'derivatives, first order', 'derivatives, second order', &
      'Monte Carlo']

contains

   !> The file name of the page: '<study>.html'.
   pure function page_name(study) result(name)
      type(study_data_t), intent(in) :: study
      character(:), allocatable :: name
      name = study%name//'.html'
   end function page_name

   !> The page of a study as HTML. Its script draws the figures that apply.
   function study_page(study) result(text)
      type(study_data_t), intent(in) :: study
      character(:), allocatable :: text
      type(page_t) :: page
      type(message_list_t) :: names, values
      character(:), allocatable :: title, name

      title = study%title
      if (title == '') title = study%name
      call begin_page(page, title, study%name//', a study of '//study%deck)
      call put_fact(names, values, 'Kind', study%kind)
      call put_fact(names, values, 'Designs', str(study%designs))
      call put_fact(names, values, 'Factors', str(size(study%factors)))
      call put_fact(names, values, 'Responses', str(size(study%responses)))
      call put_fact(names, values, 'Case', study%case)
      if (allocated(study%start)) then
         if (study%start /= '') call put_fact(names, values, 'Start state of the deck', study%start)
      end if
      call put_fact(names, values, 'Failed', str(study%failed))
      name = 'Within all limits'
      if (any(study%responses%is_target)) name = 'Within the limits of the study'
      if (any_limit(study, of_study=.true.)) call put_fact(names, values, name, str(study%within)//' ('// &
         share(study%within, study%designs)//')')
      call put_fact(names, values, 'Program', 'elastokin '//version)
      call add_facts(page, names, values)
      call add_warnings(page, plural(study%failed, 'design', 'designs')//' of '//str(study%designs)// &
         ' failed and '//trim(merge('is ', 'are', study%failed == 1))//' omitted below'//trim(merge( &
         ', but counted as outside in the shares within limits', repeat(' ', 52), any_limit(study, of_study=.false.))), &
         study%reasons)
      ! the summary, in the order of the first page on paper
      call add_responses(page, study)
      call add_extremes(page, study)
      call add_factors(page, study)
      call add_figures(page, study)
      call add_moments(page, study)
      call add_effects(page, study)
      text = page_text(page)
   end function study_page

   !> Whether any response has a limit.
   pure logical function any_limit(study, of_study)
      type(study_data_t), intent(in) :: study
      logical, intent(in) :: of_study                !! .true.: without the bands of the deck

      any_limit = any((study%responses%lower > -huge(1.0_wp) .or. study%responses%upper < huge(1.0_wp)) .and. &
         .not. (of_study .and. study%responses%is_target))
   end function any_limit

   !> A share in percent: '97.3 %'.
   pure function share(part, whole) result(text)
      integer, intent(in) :: part, whole
      character(:), allocatable :: text
      text = page_number(100.0_wp*part/max(1, whole))//' %'
   end function share

   !> A label in brackets after a blank; '' for an empty label.
   pure function in_brackets(words) result(text)
      character(*), intent(in) :: words
      character(:), allocatable :: text
      text = ''
      if (words /= '') text = ' ('//words//')'
   end function in_brackets

   !> The limits of a response: '−2.000 … 0.5000'; '' without limits. Limits from a band of the deck begin with 'target'.
   pure function limits_words(axis) result(text)
      type(study_axis_t), intent(in) :: axis
      character(:), allocatable :: text

      text = limits_text([axis%lower, axis%upper])
      if (axis%is_target .and. text /= '') text = 'target '//text
   end function limits_words

   !> Adds a cell with the verdict on the designs, by word and colour: all inside, some outside, or all outside.
   subroutine add_verdict(page, text, is_all, is_any)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: text
      logical, intent(in) :: is_all, is_any          !! all designs, some designs are inside

      if (is_all) call add_cell(page, text, verdict='inside')
      if (.not. is_all .and. is_any) call add_cell(page, text, verdict='partly outside')
      if (.not. is_any) call add_cell(page, text, verdict='outside')
   end subroutine add_verdict

   !> Adds the statistics of the responses.
   subroutine add_responses(page, study)
      type(page_t), intent(inout) :: page
      type(study_data_t), intent(in) :: study
      character(24), allocatable :: heads(:)
      logical :: has_limits
      integer :: r, k

      if (size(study%responses) == 0) return
      call begin_section(page, 'responses', 'Responses', has_text=size(study%responses) <= most_as_text)
      has_limits = any_limit(study, of_study=.false.)
      heads = [character(24) :: 'Response']
      if (has_limits) heads = [character(24) :: heads, 'Limits, share within']
      heads = [character(24) :: heads, '>designs', '>mean', '>deviation', '>smallest', &
         ('>'//str(percents(k))//' %', k=1, size(percents)), '>largest', '~What it is']
      call begin_table(page, heads)
      do r = 1, size(study%responses)
         associate (summary => study%summaries(r), axis => study%responses(r))
            call add_cell(page, axis%label)
            if (has_limits) call add_limits(axis, summary)
            call add_cell(page, str(summary%used))
            if (summary%used == 0) then
               do k = 1, 4 + size(percents)
                  call add_cell(page, '–')
               end do
            else
               call add_numbers(page, [summary%mean, summary%deviation, summary%lowest, summary%percentiles, summary%highest])
            end if
            call add_cell(page, axis%note)
         end associate
      end do
      call end_table(page)

   contains

      !> Adds a cell with the limits of a response, and the share of designs that satisfy them.
      subroutine add_limits(axis, summary)
         type(study_axis_t), intent(in) :: axis
         type(summary_t), intent(in) :: summary

         character(:), allocatable :: interval

         interval = yield_interval(study%kind, summary%within, study%designs)
         if (axis%is_constant) interval = ''
         if (limits_words(axis) == '') then
            call add_cell(page, '–')
         else if (summary%used == 0) then
            call add_cell(page, limits_words(axis))
         else
            call add_verdict(page, limits_words(axis)//': '//share(summary%within, study%designs)// &
               in_brackets(interval), &
               summary%within == study%designs, summary%within > 0)
         end if
      end subroutine add_limits

   end subroutine add_responses

   !> Adds the scatter of each response of a tolerance study, computed by derivatives and from the designs. Adds nothing for
   !> other studies.
   subroutine add_moments(page, study)
      type(page_t), intent(inout) :: page
      type(study_data_t), intent(in) :: study
      real(wp) :: half(2)              ! half widths of the intervals of mean and deviation
      integer :: m, r

      if (.not. allocated(study%moments)) return
      call begin_section(page, 'moments', 'Scatter by derivatives and by Monte Carlo')
      call begin_table(page, [character(16) :: 'Method', '>mean', '>± 95 %', '>deviation', '>± 95 %', '>skewness', '>5 %', &
         '>95 %', '>within', '>95 % interval'])
      do r = 1, size(study%responses)
         call add_group(page, study%responses(r)%label)
         do m = 1, size(methods)
            associate (row => study%moments(m, r))
               call add_cell(page, trim(method_words(m)))
               half = merge([row%mean_half, row%deviation_half], nothing(), m == size(methods))
               call add_numbers(page, [row%mean, half(1), row%deviation, half(2), row%skewness, row%low, row%high])
               call add_share(row%within)
               call add_interval(row%within_low, row%within_high, m == size(methods))
            end associate
         end do
      end do
      call end_table(page)

   contains

      subroutine add_share(value)
         real(wp), intent(in) :: value
         if (limits_words(study%responses(r)) == '' .or. .not. ieee_is_finite(value)) then
            call add_cell(page, '–')
         else
            call add_cell(page, page_number(100.0_wp*value)//' %')
         end if
      end subroutine add_share

      !> Adds the 95 % interval of the share within the limits.
      subroutine add_interval(low, high, is_known)
         real(wp), intent(in) :: low, high
         logical, intent(in) :: is_known

         if (limits_words(study%responses(r)) == '' .or. .not. is_known .or. .not. ieee_is_finite(low)) then
            call add_cell(page, '–')
         else
            call add_cell(page, page_number(100.0_wp*low)//' … '//page_number(100.0_wp*high)//' %')
         end if
      end subroutine add_interval

      pure real(wp) function nothing()
         nothing = ieee_value(1.0_wp, ieee_quiet_nan)
      end function nothing

   end subroutine add_moments

   !> Adds the strongest factors of each response, then all factors with the ranges that the designs cover, sorted by effect.
   !> After the 12 strongest factors, the others are folded.
   subroutine add_factors(page, study)
      type(page_t), intent(inout) :: page
      type(study_data_t), intent(in) :: study
      integer, allocatable :: order(:)
      integer :: k, r

      call begin_section(page, 'factors', 'Factors')
      allocate (order, source=factor_order(study))
      if (size(order) > 1 .and. size(study%responses) > 0) call add_text(page, 'p', 'Sorted '//effect_measure(study)//'.')
      if (size(order) > 1 .and. size(study%responses) > 0) then
         call begin_table(page, [character(24) :: 'Response', 'Strongest factors'])
         do r = 1, size(study%responses)
            call add_cell(page, study%responses(r)%label)
            call add_cell(page, or_none(strongest_names(study, r)))
         end do
         call end_table(page)
      end if
      call begin_ranges()
      do k = 1, size(order)
         if (k == most_open + 1) then
            call end_table(page)
            call begin_fold(page, plural(size(order) - most_open, 'more factor', 'more factors')//', by effect')
            call begin_ranges()
         end if
         call add_range(order(k))
      end do
      call end_table(page)
      if (size(order) > most_open) call end_fold(page)

   contains

      subroutine begin_ranges()
         call begin_table(page, [character(24) :: 'Factor', '~Parameters of the deck', '>smallest', '>largest'])
      end subroutine begin_ranges

      subroutine add_range(f)
         integer, intent(in) :: f
         real(wp) :: range(2)

         range = range_of_values(study%x(f, :))
         call add_cell(page, study%factors(f)%label)
         call add_cell(page, study%factors(f)%note)
         call add_numbers(page, range)
      end subroutine add_range

      pure function or_none(words) result(text)
         character(*), intent(in) :: words
         character(:), allocatable :: text

         text = words
         if (words == '') text = 'none'
      end function or_none

   end subroutine add_factors

   !> Adds the figures that apply, and their data. Second sheets are folded.
   subroutine add_figures(page, study)
      type(page_t), intent(inout) :: page
      type(study_data_t), intent(in) :: study
      type(figure_t), allocatable :: figures(:)
      integer :: k, sheet, used

      used = 0
      do k = 1, size(rules)
         if (applies(rules(k), study)) used = used + sheets(rules(k), study)
      end do
      if (used == 0) return
      allocate (figures(used))
      call begin_section(page, 'figures', 'Figures')
      used = 0
      do k = 1, size(rules)
         if (.not. applies(rules(k), study)) cycle
         do sheet = 1, sheets(rules(k), study)
            used = used + 1
            figures(used) = figure_of(rules(k), study, sheet)
            if (sheet == 1) call add_text(page, 'h3', trim(rules(k)%title))
            if (sheet == 2) call begin_fold(page, trim(rules(k)%title)//': '//others(rules(k)))
            call add_figure(page, figures(used)%name, 'figures/'//figures(used)%name//'.gp draws this figure.')
            if (sheet == 2) call end_fold(page)
         end do
      end do
      call set_data(page, figures_json(figures), has_figures=.true., has_charts=.false.)
   end subroutine add_figures

   !> Adds the best and the worst designs as a table, then, folded, the settings of these designs.
   subroutine add_extremes(page, study)
      type(page_t), intent(inout) :: page
      type(study_data_t), intent(in) :: study
      integer :: k

      if (size(study%extremes) == 0) return
      call begin_section(page, 'designs', 'Best and worst designs')
      call add_text(page, 'p', 'Best is farthest inside the limits of the response, or the smallest deviation; without limits, '// &
         'the smallest and the largest value are shown.')
      call begin_table(page, [character(12) :: 'Response', 'Which', '>value', '>design'])
      do k = 1, size(study%extremes)
         associate (extreme => study%extremes(k))
            call add_cell(page, study%responses(extreme%response)%label)
            call add_cell(page, extreme%what)
            call add_cell(page, page_number(extreme%value))
            call add_cell(page, str(extreme%design))
         end associate
      end do
      call end_table(page)
      call begin_fold(page, 'Settings of '//plural(size(study%extremes), 'design', 'designs')//', to copy')
      call add_text(page, 'p', 'The options make the design on the command line; the lines of the deck replace the keys of the '// &
         'same names.')
      do k = 1, size(study%extremes)
         associate (extreme => study%extremes(k))
            call add_text(page, 'h3', study%responses(extreme%response)%label//', '//extreme%what//': '// &
               page_number(extreme%value)//' (design '//str(extreme%design)//')')
            call add_text(page, 'pre', 'elastokin run '//study%deck//' '//extreme%settings)
            if (extreme%fragment /= '') call add_text(page, 'pre', extreme%fragment)
         end associate
      end do
      call end_fold(page)
   end subroutine add_extremes

end module ek_study_page
