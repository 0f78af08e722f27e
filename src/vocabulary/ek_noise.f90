!> Rounding noise of results. No other module decides whether a difference of two results is noise.
!>
!> A state is solved until the last correction of Newton is below the tolerance of its case. The convergence is quadratic, so the
!> remaining error of a length is at most a hundredth of the tolerance. An error of a length is an error of an angle at a lever,
!> of a force at a stiffness, and of any other quantity in proportion to its least span (ek_quantity). The noise of a result is
!> the larger of this error and of the rounding error of its own size:
!>
!>     noise = max(δ amount, δ/0.1 m · |size|),   δ = tolerance/100
!>
!> With the default tolerance of 1e-7 mm this is 1e-9 mm, 1e-10 deg, 1e-5 N, and 1e-11 of the size. Differences of solved designs
!> that cannot differ are 1 to 4 orders of magnitude smaller in the decks of `input`.
!>
!> A derivative has no error of Newton, but the rounding errors of a linear system. Its noise is that of a tolerance of 1e-8 mm,
!> for the change of the result over one step of differences (ek_direction: 0.1 mm, 1e-4 rad, 0.1 % of a rate).
module ek_noise
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_quantity, only: all_quantities, name_length
   implicit none(type, external)
   private
   public :: noise_of, is_noise, is_constant, is_flat, noise_of_slope, is_lost, widen, is_within, find_range

   real(wp), parameter, public :: solved = 1.0e-10_wp      !! usual tolerance of a solution [m], the default of a case
   real(wp), parameter, public :: derived = 1.0e-11_wp     !! tolerance that corresponds to the errors of derivatives [m];
                                                           !! a smaller tolerance of a case changes nothing

   real(wp), parameter :: remaining = 0.01_wp              !! error that Newton leaves, as a share of the tolerance
   real(wp), parameter :: shortest = 0.1_wp                !! length whose relative error is that of any result [m]
   real(wp), parameter :: usual_span = 0.01_wp             !! least span of a quantity without a unit

   !> The change of a quantity per metre of an error, by the suffix of its unit: angles at a lever of 573 mm, forces at 10 kN/mm,
   !> moments of these forces at 1 m.
   type :: amount_t
      character(4) :: ending
      real(wp) :: per_metre
   end type amount_t
   type(amount_t), parameter :: amounts(*) = [amount_t('mm', 1.0e3_wp), amount_t('deg', 100.0_wp), amount_t('n', 1.0e7_wp), &
      amount_t('nm', 1.0e7_wp), amount_t('m', 1.0_wp)]
   real(wp), parameter :: spans_per_metre = 1.0e3_wp       !! of other quantities: least spans per metre, as for a length

   !> The usual window of a slope, for each unit of an abscissa. It is used for units of slopes that no quantity has.
   type, public :: width_t
      character(8) :: unit, ending
      real(wp) :: width
   end type width_t
   type(width_t), parameter, public :: widths(*) = [width_t('m', 'm', 0.03_wp), width_t('mm', 'mm', 30.0_wp), &
      width_t('deg', 'deg', 2.0_wp), width_t('kN', 'kn', 2.0_wp), width_t('N', 'n', 2000.0_wp), &
      width_t('100 N m', '100nm', 2.0_wp), width_t('N m', 'nm', 200.0_wp), width_t('g', 'g', 1.0_wp)]

contains

   !> The largest difference of two values of a result that is noise, in the unit of the result. Creates no strings.
   pure real(wp) function noise_of(column, size, tolerance) result(noise)
      character(*), intent(in) :: column        !! column heading; its suffix is the unit: 'left_toe_deg'
      real(wp), intent(in) :: size              !! magnitude of the result, in its unit; NaN counts as 0
      real(wp), intent(in) :: tolerance         !! tolerance of the solution [m], or `derived`
      real(wp) :: error
      integer :: first, k

      error = remaining*max(tolerance, derived)
      first = start_of_unit(column)
      do k = 1, ubound(amounts, 1)
         if (column(first:) == amounts(k)%ending) exit
      end do
      if (k <= ubound(amounts, 1)) then
         noise = error*amounts(k)%per_metre
      else
         noise = error*spans_per_metre*least_span(column(first:))
      end if
      if (ieee_is_finite(size)) noise = max(noise, error/shortest*abs(size))
   end function noise_of

   !> Whether a difference of two values of a result is only noise. .false. for a difference that is not a number.
   pure logical function is_noise(difference, column, size, tolerance)
      real(wp), intent(in) :: difference        !! in the unit of the result
      character(*), intent(in) :: column        !! column heading of the result
      real(wp), intent(in) :: size              !! magnitude of the result, in its unit
      real(wp), intent(in) :: tolerance         !! tolerance of the solution [m], or `derived`

      is_noise = .false.
      if (ieee_is_finite(difference)) is_noise = abs(difference) <= noise_of(column, size, tolerance)
   end function is_noise

   !> Whether all finite values of a result are equal but for noise. .true. without a finite value.
   pure logical function is_constant(values, column, tolerance)
      real(wp), intent(in) :: values(:)         !! in the unit of the result
      character(*), intent(in) :: column        !! column heading of the result
      real(wp), intent(in) :: tolerance         !! tolerance of the solution [m]
      real(wp) :: low, high

      call find_range(values, low, high)
      is_constant = .true.
      if (high > low) is_constant = is_noise(high - low, column, max(abs(low), abs(high)), tolerance)
   end function is_constant

   !> Finds the smallest and the largest finite value; low is above high without a finite value.
   pure subroutine find_range(values, low, high)
      real(wp), intent(in) :: values(:)         !! in any unit
      real(wp), intent(out) :: low, high        !! in the unit of the values
      integer :: k

      low = huge(low)
      high = -huge(high)
      do k = 1, size(values)
         if (.not. ieee_is_finite(values(k))) cycle
         low = min(low, values(k))
         high = max(high, values(k))
      end do
   end subroutine find_range

   !> Whether a derivative is only noise: the change of the result over one step of differences. .false. for a derivative that is
   !> not a number.
   pure logical function is_flat(slope, step, column, size)
      real(wp), intent(in) :: slope             !! derivative, in the unit of the result per unit of the number
      real(wp), intent(in) :: step              !! step of differences of the number (direction_t%step), in the same unit
      character(*), intent(in) :: column        !! column heading of the result
      real(wp), intent(in) :: size              !! magnitude of the result, in its unit

      is_flat = .false.
      if (ieee_is_finite(slope)) is_flat = abs(slope) <= noise_of_slope(step, column, size)
   end function is_flat

   !> The largest derivative that is only noise, in the unit of the result per unit of the number. Creates no strings.
   pure real(wp) function noise_of_slope(step, column, size) result(noise)
      real(wp), intent(in) :: step              !! step of differences of the number (direction_t%step), above 0
      character(*), intent(in) :: column        !! column heading of the result
      real(wp), intent(in) :: size              !! magnitude of the result, in its unit

      noise = noise_of(column, size, derived)/step
   end function noise_of_slope

   !> Whether a term is too small to change the last digit of a sum: it is the rounding error of a term that is zero.
   elemental logical function is_lost(term, whole)
      real(wp), intent(in) :: term
      real(wp), intent(in) :: whole             !! sum of the magnitudes of all terms, in the same unit
      is_lost = abs(term) <= epsilon(whole)*whole
   end function is_lost

   !> Moves the limits of a result outward by noise, so that a value which touches a limit is inside. Limits that are not given
   !> (-huge, huge) are unchanged.
   pure subroutine widen(column, tolerance, lower, upper)
      character(*), intent(in) :: column        !! column heading of the result
      real(wp), intent(in) :: tolerance         !! tolerance of the solution [m]
      real(wp), intent(inout) :: lower, upper   !! limits, in the unit of the result

      if (lower > -huge(lower)) lower = lower - noise_of(column, lower, tolerance)
      if (upper < huge(upper)) upper = upper + noise_of(column, upper, tolerance)
   end subroutine widen

   !> Whether a value is within limits. A value that touches a limit but for noise is inside; NaN is not.
   pure logical function is_within(value, lower, upper, column, tolerance)
      real(wp), intent(in) :: value             !! in the unit of the result
      real(wp), intent(in) :: lower, upper      !! limits, ∓huge if not given
      character(*), intent(in) :: column        !! column heading of the result
      real(wp), intent(in) :: tolerance         !! tolerance of the solution [m]
      real(wp) :: limits(2)

      limits = [lower, upper]
      call widen(column, tolerance, limits(1), limits(2))
      is_within = .false.
      if (ieee_is_finite(value)) is_within = value >= limits(1) .and. value <= limits(2)
   end function is_within

   !> Index of the first letter of the unit in a column heading: of 'deg_per_m' in 'left_bump_steer_deg_per_m'. Without a known
   !> unit, it is the index of the last word.
   pure integer function start_of_unit(column) result(first)
      character(*), intent(in) :: column
      integer :: mark

      mark = index(column, '_per_')
      if (mark == 0) mark = len_trim(column) + 1
      first = index(column(:mark - 1), '_', back=.true.) + 1
   end function start_of_unit

   !> The smallest of the least spans of all quantities in a unit. For the unit of a slope that no quantity has, it is the span of
   !> the numerator over the usual window.
   pure recursive real(wp) function least_span(unit) result(span)
      character(*), intent(in) :: unit          !! suffix of a heading: 'deg_per_m'
      character(name_length) :: name
      integer :: k, mark

      span = huge(span)
      do k = 1, size(all_quantities)
         if (.not. all_quantities(k)%span > 0.0_wp) cycle
         name = all_quantities(k)%name
         if (name(start_of_unit(name):) == unit) span = min(span, all_quantities(k)%span)
      end do
      if (span < huge(span)) return
      span = usual_span
      mark = index(unit, '_per_')
      if (mark == 0) return
      span = least_span(unit(:mark - 1))
      k = findloc(widths%ending, unit(mark + 5:), dim=1)
      if (k > 0) span = span/widths(k)%width
   end function least_span

end module ek_noise
