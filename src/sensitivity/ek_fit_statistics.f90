!> Statistics of the factors of a fit: confidence, correlation, rank, and combinations of factors that the targets do not determine.
module ek_fit_statistics
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf, ieee_is_finite
   use ek_kinds, only: wp
   use ek_normal, only: normal_quantile
   use ek_singular_values, only: singular_values_t, decompose
   use ek_study, only: is_given
   use ek_fit_problem, only: fit_problem_t
   use ek_fit_solver, only: fit_result_t, is_at_work
   implicit none(type, external)
   private
   public :: fit_statistics_t, find_statistics, student_quantile

   type :: fit_statistics_t
      integer :: used = 0                            !! number of points that have a target value or exceed a limit
      integer :: freedom = 0 !! degrees of freedom: points used and priors, less the factors between their bounds
      real(wp) :: sigma = 1.0_wp                     !! standard deviation of a difference, divided by its deviation
      real(wp) :: quantile = 0.0_wp                  !! half width of a 95 % interval, as a multiple of the standard deviation
      real(wp), allocatable :: half(:) !! half width of the 95 % interval of each factor, with its prior; infinite: unknown; 0: held
      real(wp), allocatable :: half_alone(:)         !! half width of the 95 % interval from the targets alone
      real(wp), allocatable :: width(:) !! half width of each factor before the fit: from its bounds, its prior, or its value
      logical, allocatable :: is_learned(:)          !! whether the targets determine each factor within `width`
      real(wp), allocatable :: correlation(:, :)     !! correlations of the factors; 0 for factors that are held or unknown
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

   !> Computes the statistics of a fit.
   !> Equation (E.6) of docs/theory/derivatives.md.
   subroutine find_statistics(problem, found, statistics)
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(fit_statistics_t), intent(out) :: statistics
      type(singular_values_t) :: parts
      integer, allocatable :: rows(:), free(:)
      real(wp), allocatable :: a(:, :), covariance(:, :), with_prior(:, :)
      logical, allocatable :: is_unseen(:)
      integer :: f, k, n

      associate (variables => problem%variables, points => problem%points)
         n = size(variables)
         rows = pack([(k, k=1, size(points))], [(is_at_work(points(k), found%after(k)), k=1, size(points))])
         free = pack([(f, f=1, n)], found%held == 0)
         allocate (statistics%half(n), statistics%half_alone(n), statistics%width(n), source=0.0_wp)
         allocate (statistics%is_learned(n), source=.true.)
         allocate (statistics%correlation(n, n), source=0.0_wp)
         do f = 1, n
            statistics%correlation(f, f) = 1.0_wp
            statistics%width(f) = max(abs(found%x(f)), 0.5_wp*variables(f)%scale)
            if (is_given(variables(f)%deviation)) statistics%width(f) = normal_quantile(0.975_wp)*variables(f)%deviation
            if (variables(f)%lower > -huge(1.0_wp) .and. variables(f)%upper < huge(1.0_wp)) &
               statistics%width(f) = 0.5_wp*(variables(f)%upper - variables(f)%lower)
            if (variables(f)%is_positive) statistics%width(f) = min(statistics%width(f), abs(found%x(f)))
            statistics%width(f) = max(statistics%width(f), tiny_width*variables(f)%scale)
         end do
         statistics%used = size(rows)
         statistics%freedom = size(rows) - size(free) + count(is_given(variables(free)%deviation))
         if (.not. problem%knows_deviation) then
            statistics%sigma = 0.0_wp
            if (statistics%freedom > 0) statistics%sigma = sqrt(found%sum_after/statistics%freedom)
         end if
         statistics%quantile = normal_quantile(0.975_wp)
         if (.not. problem%knows_deviation .and. statistics%freedom > 0) &
            statistics%quantile = student_quantile(0.975_wp, statistics%freedom)
         allocate (a(size(rows), size(free)))
         do f = 1, size(free)
            a(:, f) = found%jacobian(rows, free(f))/points(rows)%deviation*statistics%width(free(f))
         end do
         call decompose(a, rank_share, parts, wants_null_space=.true.)
         statistics%singular = parts%values
         statistics%rank = parts%rank
         call covariance_of(parts, covariance)
         do f = 1, size(free)
            statistics%half_alone(free(f)) = half(covariance(f, f), statistics%width(free(f)))
            statistics%is_learned(free(f)) = statistics%half_alone(free(f)) <= statistics%width(free(f))
         end do
         ! a direction is unseen if its interval is wider than what was possible before
         is_unseen = [(k > parts%rank, k=1, size(free))]
         do k = 1, parts%rank
            is_unseen(k) = statistics%quantile*statistics%sigma > parts%values(k)
         end do
         allocate (statistics%unseen(n, count(is_unseen)), source=0.0_wp)
         statistics%unseen(free, :) = spread(statistics%width(free), 2, count(is_unseen))* &
            parts%right(:, pack([(k, k=1, size(free))], is_unseen))
         allocate (with_prior(size(rows) + size(free), size(free)), source=0.0_wp)
         with_prior(:size(rows), :) = a
         do f = 1, size(free)
            if (is_given(variables(free(f))%deviation)) with_prior(size(rows) + f, f) = &
               statistics%width(free(f))/variables(free(f))%deviation
         end do
         call decompose(with_prior, rank_share, parts, wants_null_space=.true.)
         call covariance_of(parts, covariance)
         do f = 1, size(free)
            statistics%half(free(f)) = half(covariance(f, f), statistics%width(free(f)))
            do k = 1, size(free)
               if (ieee_is_finite(covariance(f, f)) .and. ieee_is_finite(covariance(k, k))) statistics%correlation(free(f), &
                  free(k)) = covariance(f, k)/sqrt(covariance(f, f)*covariance(k, k))
            end do
         end do
      end associate

   contains

      !> Half width of the 95 % interval of a factor, in the unit of the factor.
      pure real(wp) function half(variance, width)
         real(wp), intent(in) :: variance, width
         half = variance
         if (ieee_is_finite(variance)) half = statistics%quantile*statistics%sigma*sqrt(variance)*width
      end function half

   end subroutine find_statistics

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
