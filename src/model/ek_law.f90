!> A law of one scalar measure other than rate × deflection: along a curve, one-sided, or reflected.
!>
!>     force = s y(p),   p = e or its one-sided part,   e = s (value − reference)
!>
!> s = −1 reflects the law through the origin: with the length of a spring as value, e is then its compression.
!> y is rate × p or a curve of p. A one-sided law is rounded over the length r so that the force has no corner at contact (C1):
!>
!>     p(e) = 0 for e ≤ −r/2,   (e + r/2)²/(2r) between,   e for e ≥ r/2
module ek_law
   use ek_kinds, only: wp
   use ek_curve, only: curve_t, look_up_curve, slopes_between
   implicit none(type, external)
   private
   public :: law_t, look_up_law, deflection, find_slopes

   !> Units depend on the measure: m and N, or rad and N m.
   type :: law_t
      real(wp) :: sign = 1.0_wp             !! s
      real(wp) :: reference = 0.0_wp        !! value at which e = 0
      real(wp) :: rate = 0.0_wp             !! used without a curve
      logical :: has_curve = .false.
      logical :: is_one_sided = .false.
      real(wp) :: rounding = 0.0_wp         !! r of a one-sided law, above 0
      type(curve_t) :: curve
   end type law_t

contains

   !> Force (derivative of the energy) at a value of the measure, and its slope.
   !> Equation (M.14) of docs/theory/measures.md.
   pure subroutine look_up_law(law, value, force, slope)
      type(law_t), intent(in) :: law
      real(wp), intent(in) :: value
      real(wp), intent(out) :: force, slope
      real(wp) :: p, share, y

      p = law%sign*(value - law%reference)
      share = 1.0_wp                       ! dp/de
      if (law%is_one_sided) then
         if (p <= -0.5_wp*law%rounding) then
            force = 0.0_wp
            slope = 0.0_wp
            return
         else if (p < 0.5_wp*law%rounding) then
            share = (p + 0.5_wp*law%rounding)/law%rounding
            p = 0.5_wp*law%rounding*share**2
         end if
      end if
      if (law%has_curve) then
         call look_up_curve(law%curve, p, y, slope)
      else
         y = law%rate*p
         slope = law%rate
      end if
      force = law%sign*y
      slope = slope*share
   end subroutine look_up_law

   !> e: compression of a spring, penetration of a stop (negative: its gap).
   pure real(wp) function deflection(law, value)
      type(law_t), intent(in) :: law
      real(wp), intent(in) :: value
      deflection = law%sign*(value - law%reference)
   end function deflection

   !> The least and the largest slope of the force between two values of the measure.
   pure subroutine find_slopes(law, from, to, least, most)
      type(law_t), intent(in) :: law
      real(wp), intent(in) :: from, to
      real(wp), intent(out) :: least, most
      real(wp) :: p(2), share(2), curve(2)
      integer :: k

      p = [deflection(law, from), deflection(law, to)]
      p = [minval(p), maxval(p)]
      share = 1.0_wp
      if (law%is_one_sided) then
         share = min(max((p + 0.5_wp*law%rounding)/law%rounding, 0.0_wp), 1.0_wp)
         do k = 1, 2
            if (p(k) < 0.5_wp*law%rounding) p(k) = 0.5_wp*law%rounding*share(k)**2
         end do
      end if
      curve = law%rate
      if (law%has_curve) call slopes_between(law%curve, p(1), p(2), curve(1), curve(2))
      least = min(curve(1)*share(1), curve(1)*share(2))
      most = max(curve(2)*share(1), curve(2)*share(2))
   end subroutine find_slopes

end module ek_law
