!> Values computed from the responses of a finished study: statistics, effects of the factors, best and worst designs.
module ek_study_findings
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp, i8
   use ek_study, only: study_t
   use ek_sampler, only: sampler_t, changed_factor
   use ek_sampler_kind, only: one_at_a_time_kind, list_kind, saltelli_kind, morris_kind
   use ek_designer, only: designer_t
   use ek_factor_paths, only: label_of
   use ek_sensitivity, only: sobol_indices_t, sobol_indices, saltelli_block, morris_effects_t, morris_effects, tornado_t, tornado
   use ek_sample_statistics, only: mean_and_deviation, ascending_order, percentile, rank_correlation
   use ek_study_data, only: study_data_t, study_axis_t, summary_t, effects_t, extreme_t, percents
   use ek_deck_fragment, only: deck_fragment
   implicit none(type, external)
   private
   public :: summarise, find_effects, find_extremes

   integer, parameter :: most_ranked = 20000         !! largest number of designs in a rank correlation
   integer, parameter :: most_steps = 120            !! approximate number of steps of the running mean
   real(wp), parameter :: normal_95 = 1.959963984540054_wp      !! half width of a 95 % interval [standard errors]

contains

   !> Computes the statistics of a response: number of values, mean, deviation, smallest and largest value, percentiles, number of
   !> values within the limits, histogram, and running mean.
   subroutine summarise(axis, all_values, summary)
      type(study_axis_t), intent(in) :: axis
      real(wp), intent(in) :: all_values(:)          !! values in the order of the designs; NaN without a value
      type(summary_t), intent(out) :: summary
      real(wp), allocatable :: values(:), sorted(:)
      integer, allocatable :: order(:)
      real(wp) :: width, sum_of, square
      integer :: k, n, bins, step

      n = count(ieee_is_finite(all_values))
      allocate (values(n), sorted(n))
      values(:) = pack(all_values, ieee_is_finite(all_values))
      summary%used = n
      allocate (summary%counts(0), summary%steps(0), summary%running(0), summary%half(0))
      if (n == 0) return
      call mean_and_deviation(values, summary%mean, summary%deviation)
      allocate (order(n))
      call ascending_order(values, order)
      sorted(:) = values(order)
      summary%lowest = sorted(1)
      summary%highest = sorted(n)
      do k = 1, size(percents)
         summary%percentiles(k) = percentile(sorted, 0.01_wp*percents(k))
      end do
      summary%within = count(values >= axis%widened(1) .and. values <= axis%widened(2))
      ! intervals after D. Freedman, P. Diaconis, Z. Wahrscheinlichkeitstheorie 57 (1981): 2 × interquartile range / ∛n
      width = 2.0_wp*(summary%percentiles(4) - summary%percentiles(2))/real(n, wp)**(1.0_wp/3.0_wp)
      bins = 8
      if (width*60.0_wp > summary%highest - summary%lowest) bins = ceiling((summary%highest - summary%lowest)/width)
      if (width > 0.0_wp .and. .not. width*60.0_wp > summary%highest - summary%lowest) bins = 60
      bins = max(1, min(60, bins))
      if (.not. summary%highest > summary%lowest) bins = 1
      summary%counts = spread(0, 1, bins)
      do k = 1, n
         step = 1
         if (bins > 1) step = min(bins, 1 + int(bins*((values(k) - summary%lowest)/(summary%highest - summary%lowest))))
         summary%counts(step) = summary%counts(step) + 1
      end do
      sum_of = 0.0_wp
      square = 0.0_wp
      step = 2
      do k = 1, n                                    ! relative to the mean of all: no cancellation
         sum_of = sum_of + (values(k) - summary%mean)
         square = square + (values(k) - summary%mean)**2
         if (k < step .and. k < n) cycle
         if (k < 2) cycle
         summary%steps = [summary%steps, k]
         summary%running = [summary%running, summary%mean + sum_of/k]
         summary%half = [summary%half, normal_95*sqrt(max(0.0_wp, (square - sum_of**2/k)/(k - 1.0_wp))/k)]
         step = max(k + 1, nint(k*real(n, wp)**(1.0_wp/most_steps)))
      end do
   end subroutine summarise

   !> Finds the rank correlations of the factors with a response, and the effects of the factors by the method of the study's kind.
   subroutine find_effects(study, sampler, data, r, effects)
      type(study_t), intent(in) :: study
      type(sampler_t), intent(in) :: sampler
      type(study_data_t), intent(in) :: data
      integer, intent(in) :: r
      type(effects_t), intent(out) :: effects
      type(sobol_indices_t) :: indices
      type(morris_effects_t) :: elementary
      type(tornado_t) :: bars
      logical, allocatable :: is_used(:)
      integer :: f, k, d, n, block

      k = size(data%factors)
      n = min(data%designs, most_ranked)
      allocate (effects%correlation(k))
      effects%correlation = ieee_value(1.0_wp, ieee_quiet_nan)
      is_used = ieee_is_finite(data%y(r, :n))
      if (count(is_used) > 2 .and. .not. data%responses(r)%is_constant) then
         do f = 1, k
            effects%correlation(f) = rank_correlation(pack(data%x(f, :n), is_used), pack(data%y(r, :n), is_used))
         end do
      end if
      select case (study%kind)
      case (saltelli_kind, list_kind)
         block = k + 2
         if (study%kind == list_kind) block = saltelli_block(data%x)
         if (block == 0) return
         call sobol_indices(k, data%y(r, :), indices, block, data%responses(r)%noise)
         effects%first = indices%first
         effects%total = indices%total
         effects%first_error = indices%first_error
         effects%total_error = indices%total_error
         effects%used = spread(indices%used, 1, k)
         effects%planned = data%designs/block
      case (morris_kind)
         call morris_effects(sampler, data%y(r, :), elementary, data%responses(r)%noise)
         effects%mean_size = elementary%mean_size
         effects%deviation = elementary%deviation
         effects%used = elementary%used
         effects%planned = data%designs/(k + 1)
      case (one_at_a_time_kind)
         call tornado(sampler, data%y(r, :), bars, data%responses(r)%noise)
         effects%nominal = bars%nominal
         effects%lowest = bars%lowest
         effects%highest = bars%highest
         effects%at_low = spread(ieee_value(1.0_wp, ieee_quiet_nan), 1, k)
         effects%at_high = effects%at_low
         do f = 1, k
            ! the response at the smallest and at the largest value of the factor, also of the nominal design if it is there; where
            ! these designs failed there is none
            associate (values => data%x(f, :))
               do d = 1, data%designs
                  if (d > 1 .and. changed_factor(sampler, int(d, i8)) /= f) cycle
                  if (.not. ieee_is_finite(data%y(r, d))) cycle
                  if (values(d) <= minval(values)) effects%at_low(f) = data%y(r, d)
                  if (values(d) >= maxval(values)) effects%at_high(f) = data%y(r, d)
               end do
            end associate
            if (.not. ieee_is_finite(bars%lowest(f))) cycle
            if (bars%highest(f) > bars%lowest(f)) cycle
            if (ieee_is_finite(effects%at_low(f))) effects%at_low(f) = bars%lowest(f)        ! equal but for noise
            if (ieee_is_finite(effects%at_high(f))) effects%at_high(f) = bars%lowest(f)
         end do
      end select
   end subroutine find_effects

   !> Finds the best and the worst design of a response. Designs are judged by the limits of the response. Without limits, the
   !> designs with the smallest and the largest value are found; for a response of type `rms`, the smallest value is best.
   subroutine find_extremes(study, designer, data, r, extremes, used)
      type(study_t), intent(in) :: study
      type(designer_t), intent(in) :: designer
      type(study_data_t), intent(in) :: data
      integer, intent(in) :: r
      type(extreme_t), intent(inout) :: extremes(:)     !! two for each response
      integer, intent(inout) :: used                    !! the first `used` are filled
      real(wp), allocatable :: margin(:)
      logical, allocatable :: is_known(:)
      logical :: is_judged
      integer :: d

      associate (y => data%y(r, :), axis => data%responses(r))
         allocate (is_known(size(y)))
         is_known(:) = ieee_is_finite(y)
         if (.not. any(is_known)) return
         is_judged = axis%lower > -huge(1.0_wp) .or. axis%upper < huge(1.0_wp)
         allocate (margin(size(y)), source=0.0_wp)
         do d = 1, size(y)
            if (.not. is_known(d)) cycle                   ! a comparison would trap in debug builds
            margin(d) = -y(d)
            if (is_judged) margin(d) = huge(1.0_wp)
            if (axis%lower > -huge(1.0_wp)) margin(d) = y(d) - axis%lower
            if (axis%upper < huge(1.0_wp)) margin(d) = min(margin(d), axis%upper - y(d))
         end do
         is_judged = is_judged .or. study%responses(r)%of == 'rms'
         call add(maxloc(margin, dim=1, mask=is_known), trim(merge('best    ', 'smallest', is_judged)))
         call add(minloc(margin, dim=1, mask=is_known), trim(merge('worst   ', 'largest ', is_judged)))
      end associate

   contains

      subroutine add(design, what)
         integer, intent(in) :: design
         character(*), intent(in) :: what
         type(extreme_t) :: one
         character(:), allocatable :: label
         integer :: k

         one%response = r
         one%what = what
         one%design = design
         one%value = data%y(r, design)
         label = label_of(study, data%x(:, design))
         one%settings = '--set "'
         do k = 1, len(label)
            if (label(k:k) == ' ') one%settings = one%settings//'" --set "'
            if (label(k:k) /= ' ') one%settings = one%settings//label(k:k)
         end do
         one%settings = one%settings//'"'
         one%fragment = deck_fragment(designer, data%x(:, design))
         used = used + 1
         extremes(used) = one
      end subroutine add

   end subroutine find_extremes

end module ek_study_findings
