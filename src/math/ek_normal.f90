!> The standard normal distribution: density, probability and quantile.
module ek_normal
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: normal_density, normal_probability, normal_between, normal_quantile

contains

   !> The density φ(z) = exp(−z²/2)/√(2π).
   elemental real(wp) function normal_density(z) result(density)
      real(wp), intent(in) :: z
      real(wp), parameter :: factor = 0.39894228040143267794_wp    ! 1/√(2π)

      density = factor*exp(-0.5_wp*min(abs(z), 40.0_wp)**2)    ! beyond 40 it underflows
   end function normal_density

   !> The probability Φ(z) of values below z: erfc(−z/√2)/2.
   elemental real(wp) function normal_probability(z) result(p)
      real(wp), intent(in) :: z
      real(wp), parameter :: half_root = 0.70710678118654752440_wp   ! 1/√2

      p = 0.5_wp*erfc(-half_root*z)
   end function normal_probability

   !> The probability Φ(b) − Φ(a) for a ≤ b, without loss of digits in the upper tail.
   elemental real(wp) function normal_between(a, b) result(p)
      real(wp), intent(in) :: a, b

      if (a > 0.0_wp) then
         p = normal_probability(-a) - normal_probability(-b)
      else
         p = normal_probability(b) - normal_probability(a)
      end if
   end function normal_between

   !> Φ⁻¹(p): the value below which a share p lies, to some 1e-15 of its size. p ≤ 0 gives −37.5,
   !> p ≥ 1 gives 37.5, where the probability of the tail underflows.
   !>
   !> Source: M. J. Wichura, Algorithm AS 241: the percentage points of the normal distribution, Applied Statistics 37 (1988)
   !> 477–484, PPND16: rational functions of q = p − 1/2 in the middle, of r = √(−ln min(p, 1 − p)) in the tails.
   elemental real(wp) function normal_quantile(p) result(z)
      real(wp), intent(in) :: p
      real(wp), parameter :: a(0:7) = [3.3871328727963666080e0_wp, 1.3314166789178437745e2_wp, 1.9715909503065514427e3_wp, &
         1.3731693765509461125e4_wp, 4.5921953931549871457e4_wp, 6.7265770927008700853e4_wp, 3.3430575583588128105e4_wp, &
         2.5090809287301226727e3_wp]
      real(wp), parameter :: b(0:7) = [1.0_wp, 4.2313330701600911252e1_wp, 6.8718700749205790830e2_wp, &
         5.3941960214247511077e3_wp, 2.1213794301586595867e4_wp, 3.9307895800092710610e4_wp, 2.8729085735721942674e4_wp, &
         5.2264952788528545610e3_wp]
      real(wp), parameter :: c(0:7) = [1.42343711074968357734e0_wp, 4.63033784615654529590e0_wp, 5.76949722146069140550e0_wp, &
         3.64784832476320460504e0_wp, 1.27045825245236838258e0_wp, 2.41780725177450611770e-1_wp, 2.27238449892691845833e-2_wp, &
         7.74545014278341407640e-4_wp]
      real(wp), parameter :: d(0:7) = [1.0_wp, 2.05319162663775882187e0_wp, 1.67638483018380384940e0_wp, &
         6.89767334985100004550e-1_wp, 1.48103976427480074590e-1_wp, 1.51986665636164571966e-2_wp, 5.47593808499534494600e-4_wp, &
         1.05075007164441684324e-9_wp]
      real(wp), parameter :: e(0:7) = [6.65790464350110377720e0_wp, 5.46378491116411436990e0_wp, 1.78482653991729133580e0_wp, &
         2.96560571828504891230e-1_wp, 2.65321895265761230930e-2_wp, 1.24266094738807843860e-3_wp, 2.71155556874348757815e-5_wp, &
         2.01033439929228813265e-7_wp]
      real(wp), parameter :: f(0:7) = [1.0_wp, 5.99832206555887937690e-1_wp, 1.36929880922735805310e-1_wp, &
         1.48753612908506148525e-2_wp, 7.86869131145613259100e-4_wp, 1.84631831751005468180e-5_wp, 1.42151175831644588870e-7_wp, &
         2.04426310338993978564e-15_wp]
      real(wp) :: q, r

      q = p - 0.5_wp
      if (abs(q) <= 0.425_wp) then
         r = 0.180625_wp - q*q
         z = q*polynomial(a, r)/polynomial(b, r)
         return
      end if
      r = sqrt(-log(max(min(p, 1.0_wp - p), tiny(p))))
      if (r <= 5.0_wp) then
         z = sign(polynomial(c, r - 1.6_wp)/polynomial(d, r - 1.6_wp), q)
      else
         z = sign(polynomial(e, r - 5.0_wp)/polynomial(f, r - 5.0_wp), q)
      end if
   end function normal_quantile

   !> The polynomial c₀ + c₁x + … + c₇x⁷, by Horner's scheme.
   pure real(wp) function polynomial(c, x) result(value)
      real(wp), intent(in) :: c(0:7), x
      integer :: k

      value = c(7)
      do k = 6, 0, -1
         value = value*x + c(k)
      end do
   end function polynomial

end module ek_normal
