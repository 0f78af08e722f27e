!> The factors of a study in the order of their effects on its responses.
module ek_factor_order
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_study_data, only: study_data_t
   use ek_effect_figures, only: ranked
   implicit none(type, external)
   private
   public :: most_open, effect_sizes, effect_measure, has_no_effect, factor_order, strongest_names, least_correlation

   integer, parameter :: most_open = 12           !! largest number of factors, in all or per response, that are not folded
   integer, parameter :: most_names = 4           !! largest number of factors named as the strongest of a response

contains

   !> The sizes of the effects of all factors on a response, by the best measure that the study yields: total index or share,
   !> μ*, or span. Without these, it is the magnitude of the rank correlation. NaN for a factor without a value.
   pure function effect_sizes(study, r) result(sizes)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: r                    !! response
      real(wp), allocatable :: sizes(:)

      associate (effect => study%effects(r))
         if (allocated(effect%total)) then
            sizes = effect%total
            ! without a variance there are no indices, and no factor has an effect
            if (study%kind == 'tolerance' .or. study%responses(r)%is_constant) sizes = merge(sizes, 0.0_wp, ieee_is_finite(sizes))
         else if (allocated(effect%mean_size)) then
            sizes = effect%mean_size
         else if (allocated(effect%highest)) then
            sizes = effect%highest - effect%lowest
         else
            sizes = abs(effect%correlation)
         end if
      end associate
   end function effect_sizes

   !> The magnitude of rank correlation that one or more of the factors reach by chance in at most one study of twenty, for
   !> designs drawn at random. With n designs, z = r √(n − 1) is normal for the rank correlation r by chance, and P(|z| > t) ≤
   !> exp(−t²/2). For k factors together, the probability is at most k times as large. The limit is 0 for kinds of study whose
   !> effects have another measure, and for a grid, where every factor is varied independently of the others.
   pure real(wp) function least_correlation(study)
      type(study_data_t), intent(in) :: study
      real(wp), parameter :: chance = 0.05_wp

      least_correlation = 0.0_wp
      if (size(study%effects) == 0 .or. study%kind == 'grid') return
      if (measure_of(study) /= 'rank correlation') return
      least_correlation = min(1.0_wp, sqrt(2.0_wp*log(size(study%factors)/chance)/max(1, study%designs - 1)))
   end function least_correlation

   !> Phrase about the order of the factors: 'by μ*', or 'by rank correlation; below 0.69 it may be chance'.
   pure function effect_measure(study) result(words)
      type(study_data_t), intent(in) :: study
      character(:), allocatable :: words

      words = 'by '//measure_of(study)
      if (least_correlation(study) > 0.0_wp) words = words//'; below '// &
         str(least_correlation(study), 2)//' it may be chance'
   end function effect_measure

   !> The name of the measure of effect_sizes.
   pure function measure_of(study) result(words)
      type(study_data_t), intent(in) :: study
      character(:), allocatable :: words

      words = 'rank correlation'
      if (size(study%effects) == 0) return
      if (allocated(study%effects(1)%highest)) words = 'span'
      if (allocated(study%effects(1)%mean_size)) words = 'μ*'
      if (allocated(study%effects(1)%total)) words = 'total index'
      if (allocated(study%effects(1)%total) .and. study%kind == 'tolerance') words = 'share of the variance'
   end function measure_of

   !> Whether a factor has no effect on a response. The measures of effects are computed from differences and derivatives of which
   !> rounding noise (ek_noise) has become 0, so that any other effect is real, however small. .false. if the effect is unknown.
   pure logical function has_no_effect(sizes, f)
      real(wp), intent(in) :: sizes(:)            !! of effect_sizes
      integer, intent(in) :: f                    !! factor

      has_no_effect = .false.
      if (ieee_is_finite(sizes(f))) has_no_effect = .not. abs(sizes(f)) > 0.0_wp
   end function has_no_effect

   !> Indices of all factors, sorted by the largest effect on any response, as a share of the largest effect on that response.
   !> Factors whose effects are equal or unknown are in the order of the study.
   pure function factor_order(study) result(order)
      type(study_data_t), intent(in) :: study
      integer, allocatable :: order(:)
      real(wp) :: shares(size(study%factors))
      real(wp), allocatable :: sizes(:)
      real(wp) :: largest
      integer :: r

      shares = 0.0_wp
      do r = 1, size(study%effects)
         sizes = effect_sizes(study, r)
         largest = 0.0_wp
         if (any(ieee_is_finite(sizes))) largest = maxval(abs(sizes), mask=ieee_is_finite(sizes))
         if (.not. largest > 0.0_wp) cycle
         where (ieee_is_finite(sizes)) shares = max(shares, abs(sizes)/largest)
      end do
      order = ranked(shares, size(shares))
   end function factor_order

   !> Names of the factors with the largest effects on a response, at most four, in order: 'tie_rod_inner_z, lca_rear_z'. Factors
   !> with less than a millionth of the largest effect are not named. '' if no factor has an effect that is more than chance.
   pure function strongest_names(study, r) result(names)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: r                    !! response
      character(:), allocatable :: names
      real(wp), allocatable :: sizes(:)
      integer, allocatable :: order(:)
      real(wp), parameter :: least_share = 1.0e-6_wp       ! of the largest effect: such a factor is not among the strongest
      integer :: k

      names = ''
      sizes = effect_sizes(study, r)
      order = ranked(sizes, most_names)
      do k = 1, size(order)
         if (.not. ieee_is_finite(sizes(order(k)))) exit
         if (has_no_effect(sizes, order(k)) .or. sizes(order(k)) < least_correlation(study)) exit
         if (sizes(order(k)) < least_share*sizes(order(1))) exit
         if (k > 1) names = names//', '
         names = names//study%factors(order(k))%name
      end do
   end function strongest_names

end module ek_factor_order
