!> Mean, deviation, skewness and shares of a response that is quadratic in independent factors u of mean 0 and deviation 1:
!>
!>     y = y₀ + Σ a_i u_i + ½ Σ b_ij u_i u_j
!>
!> The formulas are exact for such a response, for any distributions of the factors.
module ek_moments
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_normal, only: normal_probability, normal_density, normal_quantile
   use ek_standard_factor, only: standard_factor_t
   implicit none(type, external)
   private
   public :: expansion_t, moments_t, find_moments, normal_yield, normal_percentile

   !> A response expanded about the centre of the factors.
   type :: expansion_t
      real(wp) :: value = 0.0_wp                   !! y₀: response at the centre of the factors
      real(wp), allocatable :: slopes(:)           !! a: derivative of the response by u, per standard deviation of each factor
      real(wp), allocatable :: curvatures(:, :)    !! b, second derivatives by u, symmetric; zero if only the slopes are known
   end type expansion_t

   !> The moments of a response: mean and standard deviations in its unit, the others without unit.
   type :: moments_t
      real(wp) :: mean = 0.0_wp
      real(wp) :: linear = 0.0_wp                  !! standard deviation from the slopes alone
      real(wp) :: deviation = 0.0_wp               !! standard deviation, with the curvatures
      real(wp) :: linear_skewness = 0.0_wp         !! skewness from the slopes alone: 0 if the factors are symmetric
      real(wp) :: skewness = 0.0_wp
      real(wp), allocatable :: first(:)            !! share of the variance due to each factor alone: first-order Sobol index;
                                                   !! NaN without a variance
      real(wp), allocatable :: total(:) !! share of the variance due to each factor, with its interactions: total Sobol index
      real(wp) :: interaction = 0.0_wp             !! share of the variance due to interactions of factors: 1 − Σ first
   end type moments_t

contains

   !> Computes the mean, deviations, skewness and shares of a response.
   !>
   !> Equation (D.15) of docs/theory/sampling.md. Equation (D.16) of docs/theory/sampling.md.
   pure subroutine find_moments(expansion, factors, moments)
      type(expansion_t), intent(in) :: expansion
      type(standard_factor_t), intent(in) :: factors(:)
      type(moments_t), intent(out) :: moments
      real(wp) :: b(size(factors), size(factors)), own(size(factors)), bend(size(factors)), pull(size(factors)), third
      integer :: i, j, k

      k = size(factors)
      if (are_checked) call require(size(expansion%slopes) == k, 'find_moments: slopes of other factors')
      b = expansion%curvatures
      associate (a => expansion%slopes)
         third = 0.0_wp
         do i = 1, k
            own(i) = b(i, i)
            b(i, i) = 0.0_wp
            associate (m => factors(i)%moments)
               ! w = a u + ½ b (u² − 1), what the factor does alone: its variance, its third moment, E wu, E wu²
               moments%linear = moments%linear + a(i)**2
               moments%linear_skewness = moments%linear_skewness + a(i)**3*m(3)
               bend(i) = a(i) + 0.5_wp*own(i)*m(3)
               pull(i) = a(i)*m(3) + 0.5_wp*own(i)*(m(4) - 1.0_wp)
               third = third + a(i)**3*m(3) + 1.5_wp*a(i)**2*own(i)*(m(4) - 1.0_wp) + &
                  0.75_wp*a(i)*own(i)**2*(m(5) - 2.0_wp*m(3)) + 0.125_wp*own(i)**3*(m(6) - 3.0_wp*m(4) + 2.0_wp)
            end associate
         end do
         moments%mean = expansion%value + 0.5_wp*sum(own)
         moments%first = [(a(i)**2 + a(i)*own(i)*factors(i)%moments(3) + &
            0.25_wp*own(i)**2*(factors(i)%moments(4) - 1.0_wp), i=1, k)]
      end associate
      moments%total = moments%first + sum(b**2, dim=1)
      moments%deviation = sqrt(sum(moments%first) + 0.5_wp*sum(b**2))
      ! of pairs and triples of factors
      third = third + 3.0_wp*dot_product(bend, matmul(b, bend)) + 3.0_wp*dot_product(pull, sum(b**2, dim=2)) + trace_of_cube(b)
      do i = 1, k
         do j = 1, i - 1
            third = third + b(i, j)**3*factors(i)%moments(3)*factors(j)%moments(3)
         end do
      end do
      moments%linear = sqrt(moments%linear)
      if (moments%linear > 0.0_wp) moments%linear_skewness = moments%linear_skewness/moments%linear**3
      if (.not. moments%deviation > 0.0_wp) then             ! no variance: no shares, no skewness
         moments%first = ieee_value(1.0_wp, ieee_quiet_nan)
         moments%total = moments%first
         return
      end if
      moments%skewness = third/moments%deviation**3
      moments%first = moments%first/moments%deviation**2
      moments%total = moments%total/moments%deviation**2
      moments%interaction = 0.5_wp*sum(b**2)/moments%deviation**2
   end subroutine find_moments

   !> Trace of b³ of a symmetric matrix b.
   pure real(wp) function trace_of_cube(b) result(trace)
      real(wp), intent(in) :: b(:, :)
      trace = sum(matmul(b, b)*b)
   end function trace_of_cube

   !> The share of designs between two limits, for a nearly normal response. The distribution function is expanded to the first term
   !> of Edgeworth's series. Without skewness, the result is the share for the normal distribution.
   !>
   !> Equation (D.17) of docs/theory/sampling.md.
   pure real(wp) function normal_yield(mean, deviation, skewness, lower, upper) result(share)
      real(wp), intent(in) :: mean, deviation, skewness
      real(wp), intent(in) :: lower, upper         !! limits, ∓huge if there is no limit

      share = max(0.0_wp, below(upper) - below(lower))

   contains

      !> The probability that the response is below a limit.
      pure real(wp) function below(limit)
         real(wp), intent(in) :: limit
         real(wp) :: z

         below = merge(1.0_wp, 0.0_wp, limit >= mean)
         if (abs(limit) >= huge(1.0_wp) .or. .not. deviation > 0.0_wp) return
         z = (limit - mean)/deviation
         below = normal_probability(z) - skewness/6.0_wp*(z**2 - 1.0_wp)*normal_density(z)
         below = max(0.0_wp, min(1.0_wp, below))
      end function below

   end function normal_yield

   !> The value below which a share of designs lies, for a nearly normal response, to the first term of the series of Cornish and
   !> Fisher.
   !>
   !> Equation (D.17) of docs/theory/sampling.md.
   pure real(wp) function normal_percentile(mean, deviation, skewness, share) result(value)
      real(wp), intent(in) :: mean, deviation, skewness
      real(wp), intent(in) :: share                !! 0 … 1
      real(wp) :: z

      z = normal_quantile(share)
      value = mean + deviation*(z + skewness/6.0_wp*(z**2 - 1.0_wp))
   end function normal_percentile

end module ek_moments
