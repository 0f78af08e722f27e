!> Distributions of a factor: uniform, normal, log-normal and triangular, each with optional bounds.
!>
!> A distribution is evaluated through its quantile function x = F⁻¹(u), 0 < u < 1. Bounds truncate the distribution: values outside
!> the bounds are omitted, and the rest is scaled up to a probability of one. Values outside are not moved to the bounds.
!>
!> Meaning of `nominal ± tolerance` (`from_tolerance`): the tolerance is the half-width of a uniform or triangular distribution, and
!> three standard deviations of a normal or log-normal distribution. 99.73 % of a normal distribution lie within the tolerance. The
!> nominal value is the mean before truncation, for all kinds. All values are in the unit of the factor.
module ek_distribution
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_deck
   use ek_text, only: str
   use ek_normal, only: normal_density, normal_probability, normal_between, normal_quantile
   implicit none(type, external)
   private
   public :: distribution_t, new_distribution, from_tolerance, truncate
   public :: quantile, quantile_of_score, mean_of, deviation_of, ends_of, integration_points, acts_on_logarithm
   public :: distribution_kinds, uniform_kind, normal_kind, log_normal_kind, triangular_kind

   integer, parameter :: uniform_kind = 1, normal_kind = 2, log_normal_kind = 3, triangular_kind = 4
   character(10), parameter :: distribution_kinds(4) = [character(10) :: 'uniform', 'normal', 'log_normal', 'triangular']

   real(wp), parameter :: unbounded = huge(1.0_wp)
   real(wp), parameter :: tolerance_deviations = 3.0_wp   !! number of standard deviations in a tolerance

   type :: distribution_t
      private
      integer :: kind = uniform_kind
      real(wp) :: lower = 0.0_wp, upper = 1.0_wp       !! bounds, ∓`unbounded` if there is no bound
      real(wp) :: first = 0.0_wp, last = 1.0_wp        !! ends of a triangular distribution before it is truncated
      real(wp) :: center = 0.5_wp !! mean of x (normal) or of ln x (log-normal), peak of a triangular distribution
      real(wp) :: deviation = 1.0_wp                   !! standard deviation of x (normal) or of ln x (log-normal)
      real(wp) :: from = 0.0_wp, to = 1.0_wp           !! F of the bounds, before truncation; reflected: 1 − F(upper), 1 − F(lower)
      logical :: is_reflected = .false. !! both bounds are above the median of a normal distribution: the mirrored bounds are used
   end type distribution_t

contains

   !> Creates a distribution from its parameters:
   !>
   !> | kind | a | b | c |
   !> |---|---|---|---|
   !> | uniform | lower end | upper end | |
   !> | normal, log-normal | mean of x | standard deviation of x | |
   !> | triangular | lower end | peak | upper end |
   !>
   !> Log-normal: ln x is normal with variance s² = ln(1 + (b/a)²) and mean ln a − s²/2 (Johnson, Kotz, Balakrishnan, Continuous
   !> univariate distributions 1, 1994, chapter 14).
   pure subroutine new_distribution(kind, a, b, distribution, error, c)
      integer, intent(in) :: kind                      !! one of *_kind
      real(wp), intent(in) :: a, b
      type(distribution_t), intent(out) :: distribution
      type(error_t), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: c              !! upper end of a triangular distribution
      real(wp) :: ratio

      distribution%kind = kind
      select case (kind)
      case (uniform_kind)
         if (.not. a < b) call fail(error, exit_deck, 'lower must be below upper, found '//str(a)//' and '//str(b))
         distribution%lower = a
         distribution%upper = b
      case (triangular_kind)
         if (.not. (a <= b .and. b <= c .and. a < c)) call fail(error, exit_deck, 'a triangular distribution requires '// &
            'lower <= peak <= upper and lower < upper, found '//str(a)//', '//str(b)//', '//str(c))
         distribution%lower = a
         distribution%first = a
         distribution%center = b
         distribution%last = c
         distribution%upper = c
      case (normal_kind, log_normal_kind)
         distribution%lower = -unbounded
         distribution%upper = unbounded
         distribution%center = a
         distribution%deviation = b
         if (.not. b > 0.0_wp) call fail(error, exit_deck, 'the standard deviation must be positive, found '//str(b))
         if (kind == normal_kind .or. allocated(error)) return
         distribution%lower = 0.0_wp
         if (.not. a > 0.0_wp) call fail(error, exit_deck, 'the mean of a log-normal distribution must be positive, found '//str(a))
         if (allocated(error)) return
         ratio = (b/a)**2
         distribution%deviation = sqrt(2.0_wp*atanh(ratio/(2.0_wp + ratio)))    ! ln(1 + ratio) without loss of digits
         distribution%center = log(a) - 0.5_wp*distribution%deviation**2
      end select
   end subroutine new_distribution

   !> Creates the distribution of nominal ± tolerance; see the comment at the beginning of this file.
   pure subroutine from_tolerance(kind, nominal, tolerance, distribution, error)
      integer, intent(in) :: kind
      real(wp), intent(in) :: nominal, tolerance       !! tolerance > 0
      type(distribution_t), intent(out) :: distribution
      type(error_t), allocatable, intent(out) :: error

      if (.not. tolerance > 0.0_wp) then
         call fail(error, exit_deck, 'the tolerance must be positive, found '//str(tolerance))
         return
      end if
      select case (kind)
      case (uniform_kind)
         call new_distribution(kind, nominal - tolerance, nominal + tolerance, distribution, error)
      case (triangular_kind)
         call new_distribution(kind, nominal - tolerance, nominal, distribution, error, c=nominal + tolerance)
      case default
         call new_distribution(kind, nominal, tolerance/tolerance_deviations, distribution, error)
      end select
   end subroutine from_tolerance

   !> Truncates a distribution below `lower` and above `upper`. Bounds in descending order, or a remaining probability of at most
   !> 10⁻¹², are errors.
   pure subroutine truncate(distribution, error, lower, upper)
      type(distribution_t), intent(inout) :: distribution
      type(error_t), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: lower, upper
      real(wp) :: a, b

      if (present(lower)) distribution%lower = max(distribution%lower, lower)
      if (present(upper)) distribution%upper = min(distribution%upper, upper)
      if (distribution%lower < distribution%upper) then
         select case (distribution%kind)
         case (normal_kind, log_normal_kind)
            a = score_of(distribution, distribution%lower)
            b = score_of(distribution, distribution%upper)
            distribution%is_reflected = a > 0.0_wp
            distribution%from = normal_probability(merge(-b, a, a > 0.0_wp))
            distribution%to = normal_probability(merge(-a, b, a > 0.0_wp))
         case (triangular_kind)
            distribution%from = triangle_probability(distribution, distribution%lower)
            distribution%to = triangle_probability(distribution, distribution%upper)
         end select
         if (distribution%to - distribution%from > 1.0e-12_wp) return
      end if
      call fail(error, exit_deck, 'the bounds '//str(distribution%lower)//' and '//str(distribution%upper)// &
         ' leave nothing of the distribution')
   end subroutine truncate

   !> The value x below which the share u of all values lies, in the unit of the factor; 0 < u < 1.
   !>
   !> Equation (D.7) of docs/theory/sampling.md.
   pure real(wp) function quantile(distribution, u) result(x)
      type(distribution_t), intent(in) :: distribution
      real(wp), intent(in) :: u
      real(wp) :: p

      associate (d => distribution)
         select case (d%kind)
         case (normal_kind, log_normal_kind)
            if (d%is_reflected) then
               x = of_score(d, -normal_quantile(d%from + (1.0_wp - u)*(d%to - d%from)))
            else
               x = of_score(d, normal_quantile(d%from + u*(d%to - d%from)))
            end if
         case (triangular_kind)
            p = d%from + u*(d%to - d%from)
            if (p*(d%last - d%first) < d%center - d%first) then
               x = d%first + sqrt(p*(d%last - d%first)*(d%center - d%first))
            else
               x = d%last - sqrt((1.0_wp - p)*(d%last - d%first)*(d%last - d%center))
            end if
         case default
            x = (1.0_wp - u)*d%lower + u*d%upper
         end select
         x = max(d%lower, min(d%upper, x))
      end associate
   end function quantile

   !> The value x = quantile(Φ(z)) at a standard normal number z, from which correlated factors are computed.
   pure real(wp) function quantile_of_score(distribution, z) result(x)
      type(distribution_t), intent(in) :: distribution
      real(wp), intent(in) :: z

      associate (d => distribution)
         if ((d%kind == normal_kind .or. d%kind == log_normal_kind) .and. .not. (d%from > 0.0_wp .or. d%to < 1.0_wp)) then
            x = max(d%lower, min(d%upper, of_score(d, z)))
         else
            x = quantile(d, normal_probability(z))
         end if
      end associate
   end function quantile_of_score

   !> The value x of a normal or log-normal distribution without bounds at the score z: z standard deviations above the mean of x
   !> (normal), or of ln x (log-normal).
   pure real(wp) function of_score(distribution, z) result(x)
      type(distribution_t), intent(in) :: distribution
      real(wp), intent(in) :: z

      x = distribution%center + distribution%deviation*z
      if (distribution%kind == log_normal_kind) x = exp(min(x, 700.0_wp))
   end function of_score

   !> The score z of a value x, the inverse of of_score; −`unbounded` or +`unbounded` at a bound that does not exist.
   pure real(wp) function score_of(distribution, x) result(z)
      type(distribution_t), intent(in) :: distribution
      real(wp), intent(in) :: x

      z = x
      if (abs(x) >= unbounded) return
      if (distribution%kind == log_normal_kind) then
         z = -unbounded
         if (.not. x > 0.0_wp) return
         z = log(x)
      end if
      z = (z - distribution%center)/distribution%deviation
   end function score_of

   !> The probability below x of a triangular distribution before truncation.
   pure real(wp) function triangle_probability(distribution, x) result(p)
      type(distribution_t), intent(in) :: distribution
      real(wp), intent(in) :: x

      associate (d => distribution)
         if (x <= d%first) then
            p = 0.0_wp
         else if (x >= d%last) then
            p = 1.0_wp
         else if (x < d%center) then
            p = (x - d%first)**2/((d%last - d%first)*(d%center - d%first))
         else
            p = 1.0_wp - (d%last - x)**2/((d%last - d%first)*(d%last - d%center))
         end if
      end associate
   end function triangle_probability

   !> The mean of a distribution, in the unit of the factor.
   pure real(wp) function mean_of(distribution) result(mean)
      type(distribution_t), intent(in) :: distribution
      real(wp) :: deviation

      call moments(distribution, mean, deviation)
   end function mean_of

   !> The standard deviation of a distribution, in the unit of the factor.
   pure real(wp) function deviation_of(distribution) result(deviation)
      type(distribution_t), intent(in) :: distribution
      real(wp) :: mean

      call moments(distribution, mean, deviation)
   end function deviation_of

   !> Computes the mean and the standard deviation of a distribution, in the unit of the factor.
   !>
   !> Truncated normal distribution between the scores α and β, with Z = Φ(β) − Φ(α): mean μ + σ m with m = (φ(α) − φ(β))/Z,
   !> variance σ²(1 + (α φ(α) − β φ(β))/Z − m²). Truncated log-normal distribution:
   !> E xʳ = exp(rμ + r²σ²/2) (Φ(β − rσ) − Φ(α − rσ))/Z. Both: Johnson, Kotz, Balakrishnan (1994), sections 13.10.1 and 14.
   !>
   !> Equation (D.8) of docs/theory/sampling.md.
   pure subroutine moments(distribution, mean, deviation)
      type(distribution_t), intent(in) :: distribution
      real(wp), intent(out) :: mean, deviation
      real(wp) :: alpha, beta, share, shift, s, first, second

      associate (d => distribution)
         s = d%deviation
         alpha = score_of(d, d%lower)
         beta = score_of(d, d%upper)
         share = normal_between(alpha, beta)
         select case (d%kind)
         case (normal_kind)
            shift = (normal_density(alpha) - normal_density(beta))/share
            mean = d%center + s*shift
            deviation = s*sqrt(max(0.0_wp, 1.0_wp + (weighted(alpha) - weighted(beta))/share - shift**2))
         case (log_normal_kind)
            first = normal_between(alpha - s, beta - s)/share
            second = normal_between(alpha - 2*s, beta - 2*s)/share
            mean = exp(d%center + 0.5_wp*s**2)*first
            ! (e^(s²) − 1) first² + e^(s²) (second − first²), the first difference without loss of digits
            deviation = exp(d%center + 0.5_wp*s**2)*sqrt(max(0.0_wp, 2.0_wp*exp(0.5_wp*s**2)*sinh(0.5_wp*s**2)*first**2 + &
               exp(s**2)*(second - first**2)))
         case (triangular_kind)
            call triangle_moments(d, mean, deviation)
         case default
            mean = 0.5_wp*d%lower + 0.5_wp*d%upper
            deviation = (d%upper - d%lower)/sqrt(12.0_wp)
         end select
      end associate
   end subroutine moments

   !> The product z φ(z) at the score z of a bound; 0 without a bound.
   pure real(wp) function weighted(z)
      real(wp), intent(in) :: z

      weighted = 0.0_wp
      if (abs(z) < unbounded) weighted = z*normal_density(z)
   end function weighted

   !> Computes the mean and the standard deviation of a truncated triangular distribution. The Gauss points are exact for this
   !> distribution.
   pure subroutine triangle_moments(distribution, mean, deviation)
      type(distribution_t), intent(in) :: distribution
      real(wp), intent(out) :: mean, deviation
      real(wp), allocatable :: x(:), weight(:)

      call integration_points(distribution, x, weight)
      mean = sum(weight*x)
      deviation = sqrt(sum(weight*(x - mean)**2))
   end subroutine triangle_moments

   !> Lists points x (ln x for a log-normal distribution) and weights, so that Σ weight f(x) is the mean of f. The points are four
   !> Gauss points in each of several intervals. The mean is exact for polynomials up to the sixth power over a triangular
   !> distribution, and to 1e-12 over a normal distribution.
   pure subroutine integration_points(distribution, x, weight)
      type(distribution_t), intent(in) :: distribution
      real(wp), allocatable, intent(out) :: x(:), weight(:)
      real(wp), parameter :: at(4) = [-0.86113631159405258_wp, -0.33998104358485626_wp, 0.33998104358485626_wp, &
         0.86113631159405258_wp]
      real(wp), parameter :: share(4) = [0.34785484513745386_wp, 0.65214515486254614_wp, 0.65214515486254614_wp, &
         0.34785484513745386_wp]
      integer, parameter :: intervals = 100                !! number of intervals of a normal distribution
      real(wp), parameter :: far = 10.0_wp                 !! limit of the scores [standard deviations]: nothing lies beyond
      real(wp), allocatable :: ends(:)
      real(wp) :: low, high
      integer :: k

      associate (d => distribution)
         if (d%kind == normal_kind .or. d%kind == log_normal_kind) then
            low = score_of(d, d%lower)
            high = score_of(d, d%upper)
            low = max(low, min(-far, high - far))
            high = min(high, max(far, low + far))
            ends = [((low*(intervals - k) + high*k)/intervals, k=0, intervals)]
         else
            ends = [d%lower, max(d%lower, min(d%upper, d%center)), d%upper]
         end if
         allocate (x(4*(size(ends) - 1)), weight(4*(size(ends) - 1)))
         do k = 1, size(ends) - 1
            x(4*k - 3:4*k) = 0.5_wp*(ends(k) + ends(k + 1)) + 0.5_wp*(ends(k + 1) - ends(k))*at
            weight(4*k - 3:4*k) = 0.5_wp*(ends(k + 1) - ends(k))*share
         end do
         select case (d%kind)
         case (normal_kind, log_normal_kind)
            weight = weight*normal_density(x)
            x = d%center + d%deviation*x
         case (triangular_kind)
            where (weight > 0.0_wp .and. x < d%center)
               weight = weight*(x - d%first)/max(d%center - d%first, tiny(1.0_wp))
            elsewhere (weight > 0.0_wp)
               weight = weight*(d%last - x)/max(d%last - d%center, tiny(1.0_wp))
            end where
         end select
         weight = weight/sum(weight)
      end associate
   end subroutine integration_points

   !> Whether integration_points gives ln x instead of x.
   pure logical function acts_on_logarithm(distribution)
      type(distribution_t), intent(in) :: distribution
      acts_on_logarithm = distribution%kind == log_normal_kind
   end function acts_on_logarithm

   !> Finds the range that grids, tornados and Morris' method explore: from bound to bound. Without a bound within three standard
   !> deviations from the mean (of ln x for a log-normal distribution), the range ends at three standard deviations. A normal
   !> `nominal ± tolerance` is thus explored over its tolerance. If the distribution lies completely beyond three standard
   !> deviations, the range begins at the nearer bound and is at most three standard deviations wide.
   pure subroutine ends_of(distribution, low, high)
      type(distribution_t), intent(in) :: distribution
      real(wp), intent(out) :: low, high
      real(wp) :: alpha, beta

      low = distribution%lower
      high = distribution%upper
      if (distribution%kind /= normal_kind .and. distribution%kind /= log_normal_kind) return
      alpha = score_of(distribution, low)
      beta = score_of(distribution, high)
      ! bounds further out are not the range; of a tail beyond three deviations, three more
      if (alpha < -tolerance_deviations) low = of_score(distribution, min(-tolerance_deviations, max(alpha, beta - 3.0_wp)))
      if (beta > tolerance_deviations) high = of_score(distribution, max(tolerance_deviations, min(beta, alpha + 3.0_wp)))
   end subroutine ends_of

end module ek_distribution
