!> The table of the effects of the factors of a study on its responses. For each response, the strongest factor is first.
!> Factors after the 12 strongest, and factors without an effect, are folded.
module ek_effect_table
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str, plural
   use ek_study_data, only: study_data_t, effects_t, has_indices
   use ek_effect_figures, only: ranked
   use ek_factor_order, only: most_open, effect_sizes, has_no_effect
   use ek_page, only: page_t, begin_section, add_text, begin_fold, end_fold, begin_table, add_cell, add_numbers, &
      add_group, end_table, page_number
   implicit none(type, external)
   private
   public :: add_effects

contains

   !> Adds the table of effects of the factors, for the kinds of study that yield effects. The 12 strongest factors of each
   !> response are shown; all others are folded.
   subroutine add_effects(page, study)
      type(page_t), intent(inout) :: page
      type(study_data_t), intent(in) :: study
      integer :: r, folded

      select case (study%kind)
      case ('saltelli', 'list')
         if (.not. has_indices(study)) return
         call begin_section(page, 'indices', 'Sobol indices')
      case ('tolerance')
         if (.not. has_indices(study)) return
         call begin_section(page, 'shares', 'Share of the variance')
      case ('morris')
         call begin_section(page, 'effects', 'Elementary effects')
      case ('one_at_a_time')
         call begin_section(page, 'effects', 'One factor at a time')
      case default
         return
      end select
      call begin_effects(page, study)
      folded = 0
      do r = 1, size(study%responses)
         call add_rows(page, study, r, 1, most_open)
         folded = folded + max(0, count_of(study, r) - most_open)
      end do
      call end_table(page)
      if (folded > 0) then
         call begin_fold(page, plural(folded, 'row', 'rows')//' with smaller effects')
         call begin_effects(page, study)
         do r = 1, size(study%responses)
            if (count_of(study, r) > most_open) call add_rows(page, study, r, most_open + 1, count_of(study, r))
         end do
         call end_table(page)
         call end_fold(page)
      end if
      call add_idle(page, study)
      if (study%failed == 0) return
      if (study%kind == 'one_at_a_time') call add_text(page, 'p', '–: the design at this end of the factor '// &
         'failed. The span covers the designs that were solved.')
      if (study%kind == 'morris') call add_text(page, 'p', 'An effect is the difference of two designs that were both solved.')
      if (study%kind == 'saltelli' .or. study%kind == 'list') call add_text(page, 'p', &
         'An index rests on the base points whose designs were all solved.')
   end subroutine add_effects

   !> Begins a table of effects with the headings of the kind of the study.
   subroutine begin_effects(page, study)
      type(page_t), intent(inout) :: page
      type(study_data_t), intent(in) :: study

      select case (study%kind)
      case ('saltelli', 'list')
         call begin_table(page, [character(24) :: 'Factor', '>first order', '>± 95 %', '>total', '>± 95 %', '>base points'])
      case ('tolerance')
         call begin_table(page, [character(32) :: 'Factor', '>at the centre', '>standard deviation', '>slope', &
            '>effect of one deviation', '>share', '>with interactions'])
      case ('morris')
         call begin_table(page, [character(24) :: 'Factor', '>μ*', '>σ', '>effects'])
      case default
         call begin_table(page, [character(24) :: 'Factor', '>at its smallest', '>at its largest', '>span'])
      end select
   end subroutine begin_effects

   !> The number of factors that have an effect on a response.
   pure integer function count_of(study, r)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: r
      real(wp), allocatable :: sizes(:)
      integer :: f

      allocate (sizes, source=effect_sizes(study, r))
      count_of = count([(.not. has_no_effect(sizes, f), f=1, size(sizes))])
   end function count_of

   !> Adds the rows of a response from rank `first` to rank `last`, strongest first. Factors without an effect have no row.
   subroutine add_rows(page, study, r, first, last)
      type(page_t), intent(inout) :: page
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: r, first, last
      real(wp), allocatable :: sizes(:)
      integer, allocatable :: order(:)
      integer :: f, k, rank

      call add_group(page, study%responses(r)%label)
      sizes = effect_sizes(study, r)
      order = ranked(sizes, size(sizes))
      rank = 0
      do k = 1, size(order)
         f = order(k)
         if (has_no_effect(sizes, f)) cycle
         rank = rank + 1
         if (rank < first .or. rank > last) cycle
         call add_cell(page, study%factors(f)%name)
         associate (effect => study%effects(r))
            select case (study%kind)
            case ('saltelli', 'list')
               call add_numbers(page, [effect%first(f), effect%first_error(f), effect%total(f), effect%total_error(f)])
               call add_cell(page, str(effect%used(f))//' of '//str(effect%planned))
            case ('tolerance')
               call add_numbers(page, [study%centers(f), study%deviations(f), effect%slope(f), effect%effect(f)])
               call add_cell(page, percent(effect%first(f)))
               call add_cell(page, percent(effect%total(f)))
            case ('morris')
               call add_numbers(page, [effect%mean_size(f), effect%deviation(f)])
               call add_cell(page, str(effect%used(f))//' of '//str(effect%planned))
            case default
               call add_numbers(page, [effect%at_low(f), effect%at_high(f), effect%highest(f) - effect%lowest(f)])
            end select
         end associate
      end do
   end subroutine add_rows

   !> A share in percent, '–' if it is unknown.
   function percent(share) result(text)
      real(wp), intent(in) :: share
      character(:), allocatable :: text

      text = page_number(100.0_wp*share)
      if (ieee_is_finite(share)) text = text//' %'
   end function percent

   !> Adds the factors without an effect, folded.
   subroutine add_idle(page, study)
      type(page_t), intent(inout) :: page
      type(study_data_t), intent(in) :: study
      character(:), allocatable :: names
      real(wp), allocatable :: sizes(:)
      integer :: r, f, idle, all

      all = 0
      do r = 1, size(study%responses)
         sizes = effect_sizes(study, r)
         all = all + count([(has_no_effect(sizes, f), f=1, size(sizes))])
      end do
      if (all == 0) return
      call begin_fold(page, plural(all, 'row', 'rows')//' without an effect')
      do r = 1, size(study%responses)
         sizes = effect_sizes(study, r)
         idle = 0
         names = ''
         do f = 1, size(sizes)
            if (.not. has_no_effect(sizes, f)) cycle
            idle = idle + 1
            if (idle > 1) names = names//', '
            names = names//study%factors(f)%name//rests_on(study%effects(r), f)
         end do
         if (study%kind == 'tolerance') names = names//', near the centre of the factors'
         if (idle > 0) call add_text(page, 'p', study%responses(r)%label//' does not depend on '//names//'.')
      end do
      call end_fold(page)
   end subroutine add_idle

   !> Number of base points or effects from which an effect was computed, if designs failed: ' (67 of 256)'; otherwise ''.
   pure function rests_on(effects, f) result(text)
      type(effects_t), intent(in) :: effects
      integer, intent(in) :: f
      character(:), allocatable :: text

      text = ''
      if (.not. allocated(effects%used)) return
      if (effects%used(f) < effects%planned) text = ' ('//str(effects%used(f))//' of '//str(effects%planned)//')'
   end function rests_on

end module ek_effect_table
