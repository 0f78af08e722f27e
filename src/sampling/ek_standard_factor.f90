!> A factor as a number u of mean 0 and standard deviation 1, in which a response is expanded. The factor is x = center + scale u,
!> or x = exp(center + scale u) if it is log-normal.
module ek_standard_factor
   use ek_kinds, only: wp
   use ek_distribution, only: integration_points, acts_on_logarithm, ends_of
   use ek_sampler_settings, only: factor_t
   implicit none(type, external)
   private
   public :: standard_factor_t, new_standard_factor, value_at, slope_at

   type :: standard_factor_t
      logical :: is_logarithmic = .false.
      real(wp) :: center = 0.0_wp, scale = 1.0_wp !! mean and standard deviation of x, or of ln x if log-normal; unit of the factor
      real(wp) :: moments(6) = [0.0_wp, 1.0_wp, 0.0_wp, 3.0_wp, 0.0_wp, 15.0_wp]      !! means of u, u², …, u⁶
      real(wp) :: ends(2) = [-3.0_wp, 3.0_wp]              !! u at the ends of the range of the factor (ends_of)
   end type standard_factor_t

contains

   !> Creates the standard form of a factor of a sampler. scale is 0 if the factor has only one value.
   pure subroutine new_standard_factor(factor, standard)
      type(factor_t), intent(in) :: factor
      type(standard_factor_t), intent(out) :: standard
      real(wp), parameter :: rounding = 1.0e-12_wp
      real(wp), allocatable :: x(:), weight(:)
      real(wp) :: ends(2)
      integer :: k

      if (allocated(factor%values)) then
         x = factor%values
         weight = [(1.0_wp/size(x), k=1, size(x))]
         ends = [minval(x), maxval(x)]
      else
         call integration_points(factor%distribution, x, weight)
         standard%is_logarithmic = acts_on_logarithm(factor%distribution)
         call ends_of(factor%distribution, ends(1), ends(2))
         if (standard%is_logarithmic) ends = log(ends)
      end if
      standard%center = sum(weight*x)
      standard%scale = sqrt(sum(weight*(x - standard%center)**2))
      if (.not. standard%scale > 0.0_wp) return
      x = (x - standard%center)/standard%scale
      standard%moments = [(sum(weight*x**k), k=1, 6)]
      where (abs(standard%moments) < rounding) standard%moments = 0.0_wp       ! a symmetric factor makes no skewness
      standard%ends = (ends - standard%center)/standard%scale
   end subroutine new_standard_factor

   !> The value x of the factor at u, in the unit of the factor.
   pure real(wp) function value_at(standard, u) result(x)
      type(standard_factor_t), intent(in) :: standard
      real(wp), intent(in) :: u

      x = standard%center + standard%scale*u
      if (standard%is_logarithmic) x = exp(x)
   end function value_at

   !> The derivative dx/du of a factor with respect to its standard variable u, in the unit of the factor.
   pure real(wp) function slope_at(standard, u) result(slope)
      type(standard_factor_t), intent(in) :: standard
      real(wp), intent(in) :: u

      slope = standard%scale
      if (standard%is_logarithmic) slope = slope*value_at(standard, u)
   end function slope_at

end module ek_standard_factor
