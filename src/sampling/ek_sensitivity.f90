!> Sensitivity of a response to the factors of a study: Sobol indices, Morris' elementary effects, the bars of a tornado.
!>
!> `responses` contains one number per design, in the order of the design numbers of the sampler. A failed design has the response
!> NaN or infinite. The design is omitted, and so is each row or effect that needs its response. `used` counts the remaining rows,
!> effects or designs.
module ek_sensitivity
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite
   use ek_kinds, only: wp, i8
   use ek_contract, only: are_checked, require
   use ek_sampler, only: sampler_t, factors_of, designs_of, is_kind, changed_factor, morris_change
   use ek_sampler_kind, only: morris_kind, one_at_a_time_kind
   use ek_sample_statistics, only: mean_and_deviation
   implicit none(type, external)
   private
   public :: sobol_indices_t, sobol_indices, saltelli_block, morris_effects_t, morris_effects, tornado_t, tornado

   real(wp), parameter :: normal_95 = 1.959963984540054_wp      !! number of standard errors in half of a 95 % interval

   !> Shares of the variance of a response due to each factor. The indices are NaN if fewer than two rows remain, or if the response
   !> is constant.
   type :: sobol_indices_t
      integer :: used = 0                                    !! number of rows: base points with all responses of their block
      real(wp), allocatable :: first(:), total(:)            !! first-order and total index of each factor
      real(wp), allocatable :: first_error(:), total_error(:)   !! half-width of the 95 % confidence interval of each index
   end type sobol_indices_t

   !> Statistics of the elementary effects of each factor: the change of the response per full range of the factor, one effect per
   !> trajectory.
   type :: morris_effects_t
      integer, allocatable :: used(:)            !! number of effects of each factor
      real(wp), allocatable :: mean(:)           !! μ, in the unit of the response
      real(wp), allocatable :: mean_size(:)      !! μ*, mean of the absolute values
      real(wp), allocatable :: deviation(:)      !! σ, with n − 1: 0 for a factor that acts linearly and without interactions
   end type morris_effects_t

   !> The smallest and the largest response when one factor changes alone. The nominal design is included.
   type :: tornado_t
      real(wp) :: nominal = 0.0_wp
      integer, allocatable :: used(:)            !! number of designs of each factor with a response, without the nominal design
      real(wp), allocatable :: lowest(:), highest(:)
   end type tornado_t

contains

   !> Computes first-order and total indices from the responses of a Saltelli design. The designs come from a sampler, or from a
   !> list in the order of the sampler (see saltelli_block). Here f_A, f_B and f_i are the responses of a row in the blocks A, B and
   !> AB_i (A with factor i from B), less the mean of all responses. V is the variance of f_A and f_B together:
   !>
   !>     S_i = ⟨f_B (f_i − f_A)⟩ / V           Saltelli et al., Comput. Phys. Commun. 181 (2010) 259–270, table 2 (b)
   !>     T_i = ⟨(f_A − f_i)²⟩ / (2 V)          Jansen, Comput. Phys. Commun. 117 (1999) 35–43; Saltelli et al., table 2 (f)
   !>
   !> The confidence follows from the jackknife. With θ_r the index without row r and n rows, the standard error is √((n − 1)/n Σ
   !> (θ_r − θ̄)²) (B. Efron, C. Stein, Ann. Stat. 9 (1981) 586–596). For Sobol' points, which are more even than random points, the
   !> interval is too wide.
   !>
   !> A factor whose changes f_i − f_A are all noise has the indices 0, without an interval. A response whose differences are all
   !> noise is constant and has no indices.
   !>
   !> Equation (D.10) of docs/theory/sampling.md.
   subroutine sobol_indices(factors, responses, indices, block, noise)
      integer, intent(in) :: factors                         !! k: number of factors
      real(wp), intent(in) :: responses(:)
      type(sobol_indices_t), intent(out) :: indices
      integer, intent(in), optional :: block                 !! number of responses per row, from saltelli_block; default k + 2
      real(wp), intent(in), optional :: noise                !! largest difference of responses that is noise; default 0
      real(wp), allocatable :: f(:, :)                       ! (0: A, i: AB_i, k + 1: B; row)
      real(wp) :: nan, least
      real(wp) :: mean                                       ! of all responses of the rows
      integer :: k, i, r, rows, first, last

      k = factors
      rows = k + 2
      if (present(block)) rows = block
      if (are_checked) call require(rows >= k + 2 .and. mod(size(responses), rows) == 0, &
         'sobol_indices: responses of another design')
      nan = ieee_value(nan, ieee_quiet_nan)
      least = 0.0_wp
      if (present(noise)) least = noise
      allocate (indices%first(k), indices%total(k), indices%first_error(k), indices%total_error(k))
      allocate (f(0:k + 1, size(responses)/rows))
      mean = 0.0_wp
      do r = 1, size(f, 2)
         last = r*rows
         first = last - rows + 1
         if (.not. all(ieee_is_finite(responses(first:last)))) cycle
         indices%used = indices%used + 1
         f(:, indices%used) = [responses(first:first + k), responses(last)]
         mean = mean + sum(responses(first:last))/rows
      end do
      ! the products of S_i then carry no constant
      if (indices%used > 0) f(:, :indices%used) = f(:, :indices%used) - mean/indices%used
      do i = 1, k
         indices%first(i) = nan
         indices%total(i) = nan
         indices%first_error(i) = nan
         indices%total_error(i) = nan
         if (indices%used < 2) cycle
         if (maxval(f(:, :indices%used)) - minval(f(:, :indices%used)) <= least) cycle
         associate (a => f(0, :indices%used), b => f(k + 1, :indices%used), ab => f(i, :indices%used))
            call estimate(a, b, b*(ab - a), indices%first(i), indices%first_error(i))
            call estimate(a, b, 0.5_wp*(a - ab)**2, indices%total(i), indices%total_error(i))
            if (maxval(abs(a - ab)) > least) cycle
            indices%first(i) = 0.0_wp
            indices%total(i) = 0.0_wp
            indices%first_error(i) = 0.0_wp
            indices%total_error(i) = 0.0_wp
         end associate
      end do
   end subroutine sobol_indices

   !> The number of designs per row of a Saltelli design (written by a sampler of elastokin or by SALib). The number is k + 2
   !> without second order (A, AB₁ … AB_k, B), and 2 k + 2 with second order (A, AB₁ … AB_k, BA₁ … BA_k, B). The result is 0 if the
   !> designs are not a Saltelli design of two or more rows. AB_i is A with factor i from B; BA_i is B with factor i from A.
   pure integer function saltelli_block(x) result(block)
      real(wp), intent(in) :: x(:, :)                        !! (factor, design)
      integer :: k, k2, r, i
      logical :: is_one

      do k2 = 1, 2
         k = size(x, 1)
         block = k2*k + 2
         if (size(x, 2) < 2*block .or. mod(size(x, 2), block) /= 0) cycle
         is_one = .false.
         rows: do r = 0, size(x, 2) - block, block
            associate (a => x(:, r + 1), b => x(:, r + block))
               is_one = is_one .or. any(abs(a - b) > 0.0_wp)
               do i = 1, k
                  if (is_mixed(x(:, r + 1 + i), a, b, i) .and. (k2 == 1 .or. is_mixed(x(:, r + 1 + (k2 - 1)*k + i), b, a, i))) cycle
                  is_one = .false.
                  exit rows
               end do
            end associate
         end do rows
         if (is_one) return
      end do
      block = 0

   contains

      !> Whether a point equals `base` except in coordinate i, where the point equals `other`.
      pure logical function is_mixed(point, base, other, i)
         real(wp), intent(in) :: point(:), base(:), other(:)
         integer, intent(in) :: i
         integer :: j

         is_mixed = .not. abs(point(i) - other(i)) > 0.0_wp
         do j = 1, size(point)
            if (j /= i) is_mixed = is_mixed .and. .not. abs(point(j) - base(j)) > 0.0_wp
         end do
      end function is_mixed

   end function saltelli_block

   !> Computes the index ⟨share⟩/V with V = ⟨a² + b²⟩/2 − ⟨a + b⟩²/4, and its confidence by the jackknife. If V = 0, index and error
   !> are unchanged.
   !>
   !> Equation (D.11) of docs/theory/sampling.md.
   pure subroutine estimate(a, b, share, index, error)
      real(wp), intent(in) :: a(:), b(:), share(:)           !! one number per row, two rows or more
      real(wp), intent(inout) :: index
      real(wp), intent(inout) :: error                       !! half of the 95 % interval
      real(wp) :: sums(3), mean, square, without
      integer :: n, r

      n = size(a)
      sums = [sum(share), sum(a**2 + b**2), sum(a + b)]
      if (.not. variance(sums, n) > 0.0_wp) return
      index = sums(1)/n/variance(sums, n)
      mean = 0.0_wp
      square = 0.0_wp
      do r = 1, n
         without = without_row(r)
         mean = mean + (without - index)/n
         square = square + (without - index)**2
      end do
      error = normal_95*sqrt(max(0.0_wp, (n - 1.0_wp)/n*(square - n*mean**2)))

   contains

      !> A Sobol index computed without row r of the designs [-].
      pure real(wp) function without_row(r) result(value)
         integer, intent(in) :: r
         real(wp) :: rest(3)

         rest = sums - [share(r), a(r)**2 + b(r)**2, a(r) + b(r)]
         value = 0.0_wp
         if (variance(rest, n - 1) > 0.0_wp) value = rest(1)/(n - 1)/variance(rest, n - 1)
      end function without_row

   end subroutine estimate

   !> The variance V of the responses a and b of n rows, from Σ(a² + b²) and Σ(a + b).
   pure real(wp) function variance(sums, n)
      real(wp), intent(in) :: sums(3)
      integer, intent(in) :: n

      variance = sums(2)/(2.0_wp*n) - (sums(3)/(2.0_wp*n))**2
   end function variance

   !> Computes statistics of the elementary effects. Each step of factor i on a trajectory changes the factor by Δ of its range, and
   !> gives one effect d = (f(x + Δ range_i e_i) − f(x))/Δ:
   !>
   !>     μ_i = ⟨d⟩,   μ*_i = ⟨|d|⟩,   σ_i² = Σ (d − μ_i)²/(n − 1)
   !>
   !> Sources: M. D. Morris, Technometrics 33 (1991) 161–174; μ*: F. Campolongo, J. Cariboni, A. Saltelli, Environ. Model. Softw. 22
   !> (2007) 1509–1518. The statistics of a factor without effects are NaN. They are 0 if all differences of its responses are
   !> noise. A step between two equal entries of `values` gives no effect.
   !>
   !> Equation (D.12) of docs/theory/sampling.md.
   subroutine morris_effects(sampler, responses, effects, noise)
      type(sampler_t), intent(in) :: sampler                 !! sampler of kind morris
      real(wp), intent(in) :: responses(:)
      type(morris_effects_t), intent(out) :: effects
      real(wp), intent(in), optional :: noise                !! largest difference of responses that is noise; default 0
      real(wp), allocatable :: d(:, :)                       ! (effect, factor)
      logical :: has_moved(factors_of(sampler))
      real(wp) :: change, least
      integer :: k, i, n
      integer(i8) :: design

      if (are_checked) call require(is_kind(sampler, morris_kind) .and. size(responses, kind=i8) == designs_of(sampler), &
         'morris_effects: responses of another sampler')
      k = factors_of(sampler)
      allocate (effects%used(k), effects%mean(k), effects%mean_size(k), effects%deviation(k), d(size(responses)/(k + 1), k))
      effects%used(:) = 0
      has_moved = .false.
      least = 0.0_wp
      if (present(noise)) least = noise
      do design = 2, size(responses)
         i = changed_factor(sampler, design)
         if (i == 0) cycle
         if (.not. all(ieee_is_finite(responses(design - 1:design)))) cycle
         change = morris_change(sampler, design, i)
         if (.not. abs(change) > 0.0_wp) cycle
         effects%used(i) = effects%used(i) + 1
         d(effects%used(i), i) = (responses(design) - responses(design - 1))/change
         has_moved(i) = has_moved(i) .or. abs(responses(design) - responses(design - 1)) > least
      end do
      do i = 1, k
         n = effects%used(i)
         effects%mean(i) = ieee_value(1.0_wp, ieee_quiet_nan)
         effects%mean_size(i) = effects%mean(i)
         effects%deviation(i) = effects%mean(i)
         if (n == 0) cycle
         if (.not. has_moved(i)) d(:n, i) = 0.0_wp
         call mean_and_deviation(d(:n, i), effects%mean(i), effects%deviation(i))
         effects%mean_size(i) = sum(abs(d(:n, i)))/n
      end do
   end subroutine morris_effects

   !> Finds the range of the response for each factor when only this factor changes. A range that is only noise is the nominal
   !> response alone.
   subroutine tornado(sampler, responses, bars, noise)
      type(sampler_t), intent(in) :: sampler                 !! sampler of kind one_at_a_time
      real(wp), intent(in) :: responses(:)
      type(tornado_t), intent(out) :: bars
      real(wp), intent(in), optional :: noise                !! largest difference of responses that is noise; default 0
      integer(i8) :: design
      integer :: i, k

      if (are_checked) call require(is_kind(sampler, one_at_a_time_kind) .and. size(responses, kind=i8) == designs_of(sampler), &
         'tornado: responses of another sampler')
      k = factors_of(sampler)
      allocate (bars%used(k), bars%lowest(k), bars%highest(k))
      bars%nominal = responses(1)
      bars%used(:) = 0
      bars%lowest(:) = responses(1)
      bars%highest(:) = responses(1)
      do design = 2, size(responses)
         i = changed_factor(sampler, design)
         if (.not. ieee_is_finite(responses(design))) cycle
         bars%used(i) = bars%used(i) + 1
         if (.not. ieee_is_finite(bars%lowest(i))) then      ! the nominal design failed
            bars%lowest(i) = responses(design)
            bars%highest(i) = responses(design)
         end if
         bars%lowest(i) = min(bars%lowest(i), responses(design))
         bars%highest(i) = max(bars%highest(i), responses(design))
      end do
      if (.not. present(noise)) return
      do i = 1, k
         if (.not. ieee_is_finite(bars%lowest(i))) cycle
         if (bars%highest(i) - bars%lowest(i) > noise) cycle
         if (ieee_is_finite(bars%nominal)) bars%lowest(i) = bars%nominal
         bars%highest(i) = bars%lowest(i)
      end do
   end subroutine tornado

end module ek_sensitivity
