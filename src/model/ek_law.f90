!> A law of one scalar measure: a rate × deflection or a curve, possibly one-sided or reflected.
!>
!>     force = s y(p),   p = e or its one-sided part,   e = s (value − reference)
!>
!> s = −1 reflects the law through the origin: with the length of a spring as value, e is then its compression.
!> y is rate × p or a curve of p. A one-sided law is rounded over the length r so that the force has no corner at contact (C1):
!>
!>     p(e) = 0 for e ≤ −r/2,   (e + r/2)²/(2r) between,   e for e ≥ r/2
module ek_law
   use ek_kinds, only: wp
   use ek_number, only: num, mask, zero, one, every
   use ek_curve, only: curve_t, copy_curve, look_up_curve, slopes_between
   implicit none(type, external)
   private
   public :: law_t, law_numbers_t, law_list_t, law_shape, copy_law, look_up_law, deflection, find_slopes

   !> The numbers of a law. Their units depend on the measure: m and N, or rad (or -) and N m.
   type :: law_numbers_t
      real(num) :: reference = zero        !! value at which e = 0
      real(num) :: rate = zero             !! rate of a law without a curve
      real(num) :: sign = one              !! sign s: 1, or −1 if e is a compression
      real(num) :: rounding = zero         !! r of a one-sided law, above 0
   end type law_numbers_t

   integer, parameter :: law_shape = 3     !! from here on, the numbers of the list that give a law its shape

   !> The numbers of a law as a list, by `transfer`: what copies or compares numbers does not name them.
   type :: law_list_t
      real(num) :: v(storage_size(law_numbers_t())/storage_size(zero)) = zero
   end type law_list_t

   !> A law of one measure.
   type, extends(law_numbers_t) :: law_t
      logical :: has_curve = .false.
      logical :: is_one_sided = .false.
      type(curve_t) :: curve
   end type law_t

contains

   !> Copies the numbers of a law to another law of the same kind; nothing is allocated.
   pure subroutine copy_law(from, to)
      type(law_t), intent(in) :: from
      type(law_t), intent(inout) :: to

      if (.not. from%has_curve) then
         to = from
         return
      end if
      to%law_numbers_t = from%law_numbers_t
      to%has_curve = from%has_curve
      to%is_one_sided = from%is_one_sided
      call copy_curve(from%curve, to%curve)
   end subroutine copy_law

   !> Finds the force (derivative of the energy) at a value of the measure, and the slope of the force.
   !> Equation (M.14) of docs/theory/measures.md.
   pure subroutine look_up_law(law, value, force, slope)
      type(law_t), intent(in) :: law
      real(num), intent(in) :: value
      real(num), intent(out) :: force, slope
      real(num) :: p, share, y, half
      logical(mask) :: is_free

      p = law%sign*(value - law%reference)
      if (law%is_one_sided) then
         half = 0.5_wp*law%rounding
         is_free = p <= -half
         if (every(is_free)) then
            force = zero
            slope = zero
            return
         end if
         share = min(max((p + half)/law%rounding, zero), one)         ! dp/de
         p = merge(half*share**2, p, p < half)
      end if
      if (law%has_curve) then
         call look_up_curve(law%curve, p, y, slope)
      else
         y = law%rate*p
         slope = law%rate
      end if
      force = law%sign*y
      if (.not. law%is_one_sided) return
      force = merge(zero, force, is_free)
      slope = slope*share
   end subroutine look_up_law

   !> The argument e of a law [m, rad or -]: compression of a spring, increase of an angle, or penetration of a stop (negative: the
   !> clearance).
   pure real(num) function deflection(law, value)
      type(law_t), intent(in) :: law
      real(num), intent(in) :: value
      deflection = law%sign*(value - law%reference)
   end function deflection

   !> Finds the smallest and the largest slope of the force between two values of the measure.
   pure subroutine find_slopes(law, from, to, least, most)
      type(law_t), intent(in) :: law
      real(num), intent(in) :: from, to
      real(num), intent(out) :: least, most
      real(num) :: p(2), share(2), curve(2), ends(2)

      ends(1) = deflection(law, from)
      ends(2) = deflection(law, to)
      p(1) = min(ends(1), ends(2))
      p(2) = max(ends(1), ends(2))
      share = one
      if (law%is_one_sided) then
         share = min(max((p + 0.5_wp*law%rounding)/law%rounding, zero), one)
         p = merge(0.5_wp*law%rounding*share**2, p, p < 0.5_wp*law%rounding)
      end if
      curve = law%rate
      if (law%has_curve) call slopes_between(law%curve, p(1), p(2), curve(1), curve(2))
      least = min(curve(1)*share(1), curve(1)*share(2))
      most = max(curve(2)*share(1), curve(2)*share(2))
   end subroutine find_slopes

end module ek_law
