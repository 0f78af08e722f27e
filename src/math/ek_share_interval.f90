!> The confidence interval of a share that was counted in a sample.
module ek_share_interval
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: share_interval

contains

   !> Finds the 95 % interval of a share from the designs that were counted, if the designs are independent. Wilson's interval is
   !> inside 0 … 1 and is not empty for 0 of n and n of n. With p = count/n and z = 1.96, its ends are
   !>
   !>     (p + z²/2n ± z √(p (1 − p)/n + z²/4n²))/(1 + z²/n)
   !>
   !> Source: E. B. Wilson, J. Am. Stat. Assoc. 22 (1927) 209–212.
   !>
   !> Equation (D.18) of docs/theory/sampling.md.
   pure function share_interval(counted, n) result(ends)
      integer, intent(in) :: counted, n            !! 0 … n; number of designs, 1 or more
      real(wp) :: ends(2)
      real(wp), parameter :: normal_95 = 1.959963984540054_wp      ! half width of a 95 % interval [standard errors]
      real(wp) :: p, z2, half

      p = real(counted, wp)/n
      z2 = normal_95**2/n
      half = sqrt(z2*(p*(1.0_wp - p) + 0.25_wp*z2))
      ends = (p + 0.5_wp*z2 + [-half, half])/(1.0_wp + z2)
      if (counted == 0) ends(1) = 0.0_wp           ! exactly
      if (counted == n) ends(2) = 1.0_wp
   end function share_interval

end module ek_share_interval
