!> Data for the figures and the page of a study: the rows of its tables and the results computed from them, as plain numbers.
module ek_study_data
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_share_interval, only: share_interval
   implicit none(type, external)
   private
   public :: study_data_t, study_axis_t, summary_t, effects_t, extreme_t, moment_row_t, percents, methods, basis_text
   public :: range_of_values, is_geometric, tic_step, has_indices, has_expected, yield_interval, looks_flat

   integer, parameter :: percents(5) = [5, 25, 50, 75, 95]      !! percentiles of a summary and of a band

   !> A factor, a response or a column of the curves.
   type :: study_axis_t
      character(:), allocatable :: name
      character(:), allocatable :: head                !! heading of the column of a factor
      character(:), allocatable :: label               !! name with unit
      character(:), allocatable :: unit                !! unit of a response or column; '' without a unit
      character(:), allocatable :: note                !! path of a factor; description of a response
      real(wp) :: lower = -huge(1.0_wp), upper = huge(1.0_wp)      !! limits of a response
      real(wp) :: widened(2) = [-huge(1.0_wp), huge(1.0_wp)]       !! limits of a response, widened by noise
      real(wp) :: noise = 0.0_wp                       !! largest difference of values of a response that is noise
      logical :: is_constant = .false.                 !! all values of a response are equal but for noise
      logical :: is_target = .false.                   !! the limits are the band of the deck, not of the study
   end type study_axis_t

   !> The statistics of a response over all designs that have a value of the response.
   type :: summary_t
      integer :: used = 0                              !! designs with a value
      real(wp) :: mean = 0.0_wp, deviation = 0.0_wp, lowest = 0.0_wp, highest = 0.0_wp
      real(wp) :: percentiles(size(percents)) = 0.0_wp
      integer :: within = 0                            !! designs that satisfy the limits of the response
      integer, allocatable :: counts(:)                !! histogram: designs in equal intervals from lowest to highest
      integer, allocatable :: steps(:)                 !! convergence: numbers of designs
      real(wp), allocatable :: running(:), half(:)     !! mean of the first `steps` designs; half-width of its 95 % interval
   end type summary_t

   !> The effects of the factors on a response; allocated for the kinds of study that give them.
   type :: effects_t
      real(wp) :: nominal = 0.0_wp
      real(wp), allocatable :: at_low(:), at_high(:)           !! tornado: response at smallest, largest value of each factor
      real(wp), allocatable :: lowest(:), highest(:)           !! tornado: smallest, largest response over all factor values
      real(wp), allocatable :: first(:), total(:), first_error(:), total_error(:)    !! Sobol indices; half-widths of 95 % intervals
      real(wp), allocatable :: mean_size(:), deviation(:)      !! Morris: μ* and σ
      real(wp), allocatable :: correlation(:)                  !! rank correlation with each factor
      integer, allocatable :: used(:)                          !! Sobol: base points used for the factor; Morris: effects
      integer :: planned = 0                                   !! value of `used` without failed designs
      ! tolerance: derivatives at the centre of each factor
      real(wp), allocatable :: slope(:)                        !! derivative per unit of the factor
      real(wp), allocatable :: effect(:)                       !! change per standard deviation of the factor
      real(wp), allocatable :: curvature(:)                    !! second derivative, per standard deviation squared
   end type effects_t

   !> The scatter of a response by one method, in the unit of the response.
   type :: moment_row_t
      real(wp) :: mean, deviation, skewness, low, high         !! low, high: percentiles 5 and 95
      real(wp) :: mean_half, deviation_half                    !! half-widths of 95 % intervals; 0 without sampling error
      real(wp) :: within = 0.0_wp                              !! share of designs within the limits
      real(wp) :: within_low = 0.0_wp, within_high = 0.0_wp    !! ends of its 95 % interval
   end type moment_row_t

   character(*), parameter :: methods(3) = [character(12) :: 'first_order', 'second_order', 'monte_carlo']

   !> A best or worst design, to be shown on the page.
   type :: extreme_t
      integer :: response = 0
      character(:), allocatable :: what                !! label of the design: 'smallest', 'best', …
      integer :: design = 0
      real(wp) :: value = 0.0_wp
      character(:), allocatable :: settings            !! options that set the factors: --set "a=1" --set "b=2"
      character(:), allocatable :: fragment            !! lines of the deck; '' if they are not known
   end type extreme_t

   type :: study_data_t
      character(:), allocatable :: name, title, kind, deck, case
      character(:), allocatable :: start               !! start state of the tests at the deck's own design; '': design position
      integer :: designs = 0, within = 0, failed = 0
      type(study_axis_t), allocatable :: factors(:), responses(:), columns(:)
      real(wp), allocatable :: x(:, :), y(:, :)        !! factors, responses: (factor or response, design); NaN: no value
      type(message_list_t) :: reasons                  !! reasons for failures, each with the number of designs that failed
      type(summary_t), allocatable :: summaries(:)     !! statistics of each response
      type(effects_t), allocatable :: effects(:)       !! effects on each response
      type(extreme_t), allocatable :: extremes(:)
      ! tolerance; not allocated if it was not computed
      type(moment_row_t), allocatable :: moments(:, :) !! scatter of each response by each method: (method, response)
      real(wp), allocatable :: centers(:), deviations(:)       !! centres and standard deviations of the factors
      !> Scatter of the curves by derivatives: (nominal, mean, deviation, percentiles 5 and 95; column; state).
      real(wp), allocatable :: expected(:, :, :)
      ! curves of some designs
      character(:), allocatable :: swept               !! label of the swept value
      real(wp), allocatable :: sweep(:)                !! swept value of each state
      integer, allocatable :: drawn(:)                 !! designs whose curves were read
      real(wp), allocatable :: curves(:, :, :)         !! curves of the drawn designs: (column, state, index in `drawn`)
      real(wp), allocatable :: bands(:, :, :)          !! percentiles of the curves: (index in `percents`, column, state)
   end type study_data_t

contains

   !> Number of base points or effects used, if designs have failed: ' (67 of 256 base points)'; otherwise ''. If the number
   !> depends on the factor, it is a range: ' (60 to 67 of 256 base points)'.
   pure function basis_text(effects, what) result(text)
      type(effects_t), intent(in) :: effects
      character(*), intent(in) :: what                 !! 'base points'
      character(:), allocatable :: text

      text = ''
      if (.not. allocated(effects%used)) return
      if (all(effects%used == effects%planned)) return
      text = str(minval(effects%used))
      if (maxval(effects%used) > minval(effects%used)) text = text//' to '//str(maxval(effects%used))
      text = ' ('//text//' of '//str(effects%planned)//' '//what//')'
   end function basis_text

   !> The 95 % interval of the share of designs that were counted, as a label: '95 % interval 94.4 to 97.7 %'. The designs of a Latin
   !> hypercube and of Sobol' points are not independent, so their interval is only approximate. '' for kinds of study whose
   !> designs are not a sample.
   pure function yield_interval(kind, counted, designs) result(words)
      character(*), intent(in) :: kind                 !! kind of the study: 'monte_carlo'
      integer, intent(in) :: counted, designs          !! designs within the limits; all designs
      character(:), allocatable :: words
      real(wp) :: ends(2)

      words = ''
      if (designs == 0) return
      select case (kind)
      case ('monte_carlo', 'tolerance')
         words = '95 % interval '
      case ('latin_hypercube', 'sobol')
         words = 'approximate 95 % interval '
      case default
         return
      end select
      ends = 100.0_wp*share_interval(counted, designs)
      words = words//rounded(ends(1))//' to '//rounded(ends(2))//' %'

   contains

      !> A percentage with two decimal places, without trailing zeros.
      pure function rounded(percentage) result(text)
         real(wp), intent(in) :: percentage
         character(:), allocatable :: text
         text = str(0.01_wp*nint(100.0_wp*percentage), 5)
      end function rounded

   end function yield_interval

   !> Whether the study yields Sobol indices: from the designs of a saltelli study, from a list in the order of a Saltelli
   !> design, or from the derivatives of a tolerance study.
   pure logical function has_indices(study)
      type(study_data_t), intent(in) :: study

      has_indices = .false.
      if (size(study%effects) > 0) has_indices = allocated(study%effects(1)%first)
   end function has_indices

   !> Whether the scatter of the curves of a tolerance study was computed from derivatives.
   pure logical function has_expected(study)
      type(study_data_t), intent(in) :: study

      has_expected = allocated(study%expected)
      if (has_expected) has_expected = size(study%expected) > 0 .and. size(study%expected, 3) == size(study%sweep)
   end function has_expected

   !> The smallest and the largest finite value; 0 and 1 if there is no finite value.
   pure function range_of_values(values) result(range)
      real(wp), intent(in) :: values(:)
      real(wp) :: range(2)

      range = [0.0_wp, 1.0_wp]
      if (any(ieee_is_finite(values))) range = [minval(values, mask=ieee_is_finite(values)), &
         maxval(values, mask=ieee_is_finite(values))]
   end function range_of_values

   !> Whether two ends of a range are equal, or so close that the seven digits of a figure do not show their difference. gnuplot
   !> refuses an axis with such a range.
   pure logical function looks_flat(range)
      real(wp), intent(in) :: range(2)                 !! smallest and largest value
      real(wp), parameter :: shown = 1.0e-6_wp         ! share of the value: the seventh digit differs
      looks_flat = range(2) - range(1) <= shown*max(abs(range(1)), abs(range(2)))
   end function looks_flat

   !> Whether positive values span a factor of 4 or more and are spaced by equal ratios rather than equal steps, judged by their
   !> median.
   pure logical function is_geometric(values)
      real(wp), intent(in) :: values(:)
      real(wp) :: low, high

      is_geometric = .false.
      if (size(values) == 0) return
      low = minval(values)
      high = maxval(values)
      if (.not. low > 0.0_wp) return
      if (low > 0.25_wp*high) return
      is_geometric = 2*count(values < 0.42_wp*(low + high)) >= size(values)
   end function is_geometric

   !> A step between tics, as a string, that puts about four tics on an axis; 'autofreq' if all values are equal
   !> in a figure.
   pure function tic_step(values) result(text)
      real(wp), intent(in) :: values(:)
      character(:), allocatable :: text
      real(wp) :: range(2), step, decade

      range = range_of_values(values)
      text = 'autofreq'
      if (looks_flat(range)) return
      step = (range(2) - range(1))/3
      decade = 10.0_wp**floor(log10(step))
            step = step/decade
      text = str(decade*merge(1.0_wp, merge(2.0_wp, merge(5.0_wp, 10.0_wp, step < 7.5_wp), step < 3.5_wp), step < 1.6_wp), 3)
   end function tic_step

end module ek_study_data
