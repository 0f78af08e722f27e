!> Statistics of the factors of a fit: confidence, correlation, rank, and combinations of factors that the targets do not determine.
module ek_fit_statistics
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf, ieee_is_finite
   use ek_kinds, only: wp
   use ek_normal, only: normal_quantile
   use ek_singular_values, only: singular_values_t, decompose
   use ek_study, only: is_given
   use ek_fit_problem, only: fit_problem_t
   use ek_fit_solver, only: fit_result_t, difference_of, is_at_work
   implicit none(type, external)
   private
   public :: fit_statistics_t, find_statistics, student_quantile

   type :: fit_statistics_t
      integer :: used = 0                            !! number of points that have a target value or exceed a limit
      integer :: freedom = 0 !! degrees of freedom: points used and priors, less the factors that were fitted
      logical :: knows_sigma = .true.                !! .false.: no deviation is given, and there are not more points than factors
      real(wp) :: sigma = 1.0_wp                     !! standard deviation of a difference, divided by its deviation; 0 if unknown
      real(wp) :: quantile = 0.0_wp                  !! half width of a 95 % interval, as a multiple of the standard deviation
      real(wp), allocatable :: half(:) !! half width of the 95 % interval of each factor, with its prior; infinite: unknown
      real(wp), allocatable :: low(:), high(:)       !! 95 % interval of each factor; of a factor at a bound, cut at the bound
      logical, allocatable :: is_held_by_bound(:)    !! whether the sum of squares would be significantly smaller beyond the bound
      real(wp), allocatable :: half_alone(:)         !! half width of the 95 % interval from the targets alone
      real(wp), allocatable :: width(:) !! half width of each factor before the fit: from its bounds, its prior, or its value
      logical, allocatable :: has_effect(:)          !! whether the effect of each factor on the targets is not only rounding noise
      logical, allocatable :: is_learned(:)          !! whether the targets determine each factor within `width`
      real(wp), allocatable :: correlation(:, :)     !! correlations of the factors; 0 for unknown factors
      real(wp), allocatable :: singular(:)           !! singular values of the Jacobian (differences in deviations, factors in
                                                     !! widths), largest first
      integer :: rank = 0
      real(wp), allocatable :: unseen(:, :)          !! (factor, k): combinations of factors that the targets do not determine
   end type fit_statistics_t

   real(wp), parameter :: tiny_width = 1.0e-6_wp     !! least width, as a share of the scale of a factor; for a rate that has become
                                                     !! zero
   real(wp), parameter :: rank_share = 1.0e-9_wp     !! limit, as a share of the largest singular value: smaller singular values are
                                                     !! errors of the derivatives

contains

   !> Computes the statistics of a fit. Factors at a bound and factors that keep their value are free here, because none of them is
   !> known exactly.
   !> Equation (E.6) of docs/theory/derivatives.md.
   subroutine find_statistics(problem, found, statistics)
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(fit_statistics_t), intent(out) :: statistics
      type(singular_values_t) :: parts
      integer, allocatable :: rows(:), seen(:)
      real(wp), allocatable :: a(:, :), covariance(:, :), step(:)
      logical, allocatable :: is_fitted(:)
      integer :: f, k, n

      associate (variables => problem%variables, points => problem%points)
         n = size(variables)
         rows = pack([(k, k=1, size(points))], [(is_at_work(points(k), found%after(k)), k=1, size(points))])
         statistics%has_effect = [(any(abs(found%jacobian(:, f)) > 0.0_wp), f=1, n)]
         ! a satisfied limit says nothing
         seen = pack([(f, f=1, n)], [(any(abs(found%jacobian(rows, f)) > 0.0_wp) .or. is_given(variables(f)%deviation), f=1, n)])
         allocate (statistics%half(n), statistics%half_alone(n), source=ieee_value(1.0_wp, ieee_positive_inf))
         allocate (statistics%is_learned(n), statistics%is_held_by_bound(n), source=.false.)
         allocate (statistics%correlation(n, n), source=0.0_wp)
         call find_widths(problem, found, statistics)
         do f = 1, n
            statistics%correlation(f, f) = 1.0_wp
         end do
         is_fitted = found%held == 0 .and. .not. found%is_kept .and. statistics%has_effect
         statistics%used = size(rows)
         statistics%freedom = size(rows) - count(is_fitted) + count(is_fitted .and. is_given(variables%deviation))
         statistics%quantile = normal_quantile(0.975_wp)
         if (.not. problem%knows_deviation) then
            statistics%knows_sigma = statistics%freedom > 0
            statistics%sigma = 0.0_wp
            if (statistics%knows_sigma) then
               statistics%sigma = sqrt(found%sum_after/statistics%freedom)
               statistics%quantile = student_quantile(0.975_wp, statistics%freedom)
            end if
         end if
         call find_alone(problem, found, rows, statistics)
         allocate (a(size(rows) + size(seen), size(seen)), source=0.0_wp)
         do f = 1, size(seen)
            a(:size(rows), f) = found%jacobian(rows, seen(f))/points(rows)%deviation*statistics%width(seen(f))
            if (is_given(variables(seen(f))%deviation)) a(size(rows) + f, f) = &
               statistics%width(seen(f))/variables(seen(f))%deviation
            ! a factor that is not determined is somewhere within its width
            if (found%is_kept(seen(f))) a(size(rows) + f, f) = normal_quantile(0.975_wp)*statistics%sigma
         end do
         call decompose(a, rank_share, parts, wants_null_space=.true., wants_left=.false.)
         call covariance_of(parts, covariance)
         do f = 1, size(seen)
            statistics%half(seen(f)) = half_of(statistics, covariance(f, f), statistics%width(seen(f)))
            if (found%is_kept(seen(f))) statistics%half(seen(f)) = statistics%half_alone(seen(f))
            do k = 1, size(seen)
               if (ieee_is_finite(covariance(f, f)) .and. ieee_is_finite(covariance(k, k))) statistics%correlation(seen(f), &
                  seen(k)) = covariance(f, k)/sqrt(covariance(f, f)*covariance(k, k))
            end do
         end do
         call free_step(problem, found, rows, seen, a, parts, step)
         call find_intervals(problem, found, seen, step, statistics)
      end associate
   end subroutine find_statistics

   !> Computes what the targets alone determine: rank, intervals, and unseen combinations of the factors with an effect.
   subroutine find_alone(problem, found, rows, statistics)
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      integer, intent(in) :: rows(:)                       !! points that have a target value or exceed a limit
      type(fit_statistics_t), intent(inout) :: statistics
      type(singular_values_t) :: parts
      real(wp), allocatable :: a(:, :), covariance(:, :)
      logical, allocatable :: is_unseen(:)
      integer, allocatable :: seen(:)
      integer :: f, k

      seen = pack([(f, f=1, size(found%x))], [(any(abs(found%jacobian(rows, f)) > 0.0_wp), f=1, size(found%x))])
      allocate (a(size(rows), size(seen)))
      do f = 1, size(seen)
         a(:, f) = found%jacobian(rows, seen(f))/problem%points(rows)%deviation*statistics%width(seen(f))
      end do
      call decompose(a, rank_share, parts, wants_null_space=.true., wants_left=.false.)
      statistics%singular = parts%values
      statistics%rank = parts%rank
      call covariance_of(parts, covariance)
      do f = 1, size(seen)
         associate (alone => statistics%half_alone(seen(f)))
            alone = half_of(statistics, covariance(f, f), statistics%width(seen(f)))
            statistics%is_learned(seen(f)) = ieee_is_finite(covariance(f, f))
            if (ieee_is_finite(alone)) statistics%is_learned(seen(f)) = alone <= statistics%width(seen(f))
         end associate
      end do
      ! a direction is unseen if its interval is wider than what was possible before
      is_unseen = [(k > parts%rank, k=1, size(seen))]
      do k = 1, parts%rank
         is_unseen(k) = statistics%quantile*statistics%sigma > parts%values(k)
      end do
      allocate (statistics%unseen(size(found%x), count(is_unseen)), source=0.0_wp)
      statistics%unseen(seen, :) = spread(statistics%width(seen), 2, count(is_unseen))* &
         parts%right(:, pack([(k, k=1, size(seen))], is_unseen))
   end subroutine find_alone

   !> Half width of the 95 % interval of a factor, in the unit of the factor; infinite if it is unknown.
   pure real(wp) function half_of(statistics, variance, width) result(half)
      type(fit_statistics_t), intent(in) :: statistics
      real(wp), intent(in) :: variance, width
      half = variance
      if (ieee_is_finite(variance)) half = statistics%quantile*statistics%sigma*sqrt(variance)*width
      if (.not. statistics%knows_sigma) half = ieee_value(1.0_wp, ieee_positive_inf)
   end function half_of

   !> Computes half the width of the range of each factor before the fit.
   pure subroutine find_widths(problem, found, statistics)
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(fit_statistics_t), intent(inout) :: statistics
      integer :: f

      allocate (statistics%width(size(problem%variables)))
      do f = 1, size(problem%variables)
         associate (this => problem%variables(f), width => statistics%width(f))
            width = max(abs(found%x(f)), 0.5_wp*this%scale)
            if (is_given(this%deviation)) width = normal_quantile(0.975_wp)*this%deviation
            if (this%lower > -huge(1.0_wp) .and. this%upper < huge(1.0_wp)) width = 0.5_wp*(this%upper - this%lower)
            if (this%is_positive) width = min(width, abs(found%x(f)))
            width = max(width, tiny_width*this%scale)
         end associate
      end do
   end subroutine find_widths

   !> Computes the step from the result to the smallest sum of squares without bounds, to first order, in widths.
   pure subroutine free_step(problem, found, rows, seen, a, parts, step)
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      integer, intent(in) :: rows(:), seen(:)              !! points and factors of the matrix
      real(wp), intent(in) :: a(:, :)                      !! Jacobian of the differences, and the rows of priors
      type(singular_values_t), intent(in) :: parts         !! of the matrix
      real(wp), allocatable, intent(out) :: step(:)        !! of the factors `seen`
      real(wp) :: r(size(a, 1))
      integer :: f, k

      r = 0.0_wp
      do k = 1, size(rows)
         r(k) = difference_of(problem%points(rows(k)), found%after(rows(k)))
      end do
      do f = 1, size(seen)
         associate (this => problem%variables(seen(f)))
            if (is_given(this%deviation)) r(size(rows) + f) = (found%x(seen(f)) - this%nominal)/this%deviation
         end associate
      end do
      allocate (step(size(seen)), source=0.0_wp)
      do k = 1, parts%rank
         step = step - parts%right(:, k)*dot_product(parts%right(:, k), matmul(r, a))/parts%values(k)**2
      end do
   end subroutine free_step

   !> Sets the 95 % intervals. The interval of a factor at a bound is the interval of the free factor, cut at the bound. If all of
   !> it is beyond the bound, the bound holds the factor.
   pure subroutine find_intervals(problem, found, seen, step, statistics)
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      integer, intent(in) :: seen(:)
      real(wp), intent(in) :: step(:)                      !! free_step
      type(fit_statistics_t), intent(inout) :: statistics
      real(wp) :: centre
      integer :: f, k

      statistics%low = found%x - statistics%half
      statistics%high = found%x + statistics%half
      do k = 1, size(seen)
         f = seen(k)
         if (found%held(f) == 0 .or. .not. ieee_is_finite(statistics%half(f))) cycle
         centre = found%x(f) + step(k)*statistics%width(f)
         statistics%low(f) = max(centre - statistics%half(f), problem%variables(f)%lower)
         statistics%high(f) = min(centre + statistics%half(f), problem%variables(f)%upper)
         statistics%is_held_by_bound(f) = statistics%low(f) > statistics%high(f)
         if (found%held(f) < 0) statistics%low(f) = found%x(f)
         if (found%held(f) > 0) statistics%high(f) = found%x(f)
         if (statistics%is_held_by_bound(f)) then
            statistics%low(f) = found%x(f)
            statistics%high(f) = found%x(f)
         end if
      end do
   end subroutine find_intervals

   !> Computes (AᵀA)⁻¹ from the singular values of A. The diagonal entry of an unknown that is part of the null space is infinite.
   subroutine covariance_of(parts, covariance)
      type(singular_values_t), intent(in) :: parts
      real(wp), allocatable, intent(out) :: covariance(:, :)
      real(wp), parameter :: part_of = 1.0e-6_wp           !! limit of a component of a unit vector of the null space
      integer :: j, k, n

      n = size(parts%right, 1)
      allocate (covariance(n, n), source=0.0_wp)
      do k = 1, parts%rank
         do j = 1, n
            covariance(:, j) = covariance(:, j) + parts%right(:, k)*parts%right(j, k)/parts%values(k)**2
         end do
      end do
      do j = 1, n
         if (any(abs(parts%right(j, parts%rank + 1:)) > part_of)) covariance(j, j) = ieee_value(1.0_wp, ieee_positive_inf)
      end do
   end subroutine covariance_of

   !> The quantile of Student's distribution, p ≥ 1/2. The quantile is exact for one and two degrees of freedom. For three or more
   !> degrees of freedom, the quantile is the expansion in 1/freedom by Cornish and Fisher. The error of the expansion is below 1 %,
   !> and below 1e-3 from six degrees of freedom on. Source: M. Abramowitz, I. Stegun, Handbook of Mathematical Functions, 1964,
   !> 26.7.5.
   pure real(wp) function student_quantile(p, freedom) result(t)
      real(wp), intent(in) :: p
      integer, intent(in) :: freedom
      real(wp), parameter :: pi = acos(-1.0_wp)
      real(wp) :: z

      select case (freedom)
      case (:1)
         t = tan(pi*(p - 0.5_wp))
      case (2)
         t = (2.0_wp*p - 1.0_wp)/sqrt(2.0_wp*p*(1.0_wp - p))
      case default
         z = normal_quantile(p)
         t = z + (z**3 + z)/(4.0_wp*freedom) + (5.0_wp*z**5 + 16.0_wp*z**3 + 3.0_wp*z)/(96.0_wp*real(freedom, wp)**2) + &
            (3.0_wp*z**7 + 19.0_wp*z**5 + 17.0_wp*z**3 - 15.0_wp*z)/(384.0_wp*real(freedom, wp)**3)
      end select
   end function student_quantile

end module ek_fit_statistics
