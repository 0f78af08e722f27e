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
   use ek_curve, only: curve_t, look_up_curve, has_corner
   implicit none(type, external)
   private
   public :: law_t, look_up_law, deflection, bend_between
   public :: no_bend, steep, corner

   integer, parameter :: no_bend = 0, steep = 1, corner = 2

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

   !> How sharply the law bends between two values of the measure: not at all, like rubber in contact whose stiffness differs
   !> between the states, or at a corner (contact of a stop, or a corner of a curve).
   pure integer function bend_between(law, from, to) result(bend)
      type(law_t), intent(in) :: law
      real(wp), intent(in) :: from, to
      real(wp) :: e(2)

      e = [deflection(law, from), deflection(law, to)]
      bend = no_bend
      if (law%is_one_sided) then
         if (any(e > -0.5_wp*law%rounding)) bend = steep
         if (zone(e(1)) /= zone(e(2)) .or. zone(e(1)) == 1) bend = corner
      end if
      if (law%has_curve) then
         if (has_corner(law%curve, e(1), e(2))) bend = corner
      end if

   contains

      !> Before contact, within the rounding, or beyond it.
      pure integer function zone(e)
         real(wp), intent(in) :: e
         zone = 0
         if (abs(e) <= 0.5_wp*law%rounding) zone = 1
         if (e > 0.5_wp*law%rounding) zone = 2
      end function zone

   end function bend_between

end module ek_law
