!> Factors of a matrix by a plan of elimination, and solutions with these factors.
!>
!> Per pivot: l = D⁻¹ a, x(place) ← x(place) − l a over the indices `places` of the plan, where a are the entries of
!> the columns of the pivot.
!> The order is fixed, so a matrix far from the samples may have large factors: the caller checks `growth` and uses LAPACK instead.
!> Equation (K.23) of docs/theory/kkt.md.
module ek_plan_factors
   use ek_kinds, only: wp
   use ek_number, only: num, mask, zero, one, some
   use ek_plan, only: plan_t
   implicit none(type, external)
   private
   public :: soundness_t, gather_and_factorise, factorise_by, solve_by, substitute_by, substitute_several_by, several

   ! A matrix is nearly singular at a ratio of 1e-12 of LAPACK's pivots: from a hundred times this LAPACK factorises, so that
   ! both solvers judge alike
   real(wp), parameter :: least_ratio = 1.0e-10_wp

   integer, parameter :: several = 6       !! number of right-hand sides solved together: six loads on a body; they fit in registers

   !> Properties of a factorisation: inertia, eigenvalues of D, determinant, growth.
   type :: soundness_t
      real(num) :: negative = zero            !! number of negative eigenvalues (Sylvester's law: of D)
      real(num) :: least = zero, most = zero    !! smallest and largest |eigenvalue| of D
      real(num) :: log_determinant = zero    !! ln |det|
      real(num) :: growth = zero             !! largest |l|; NaN or huge if the matrix is singular or nearly so
   end type soundness_t

contains

   !> Copies the scaled entries to their positions in x, and factorises the matrix. Explicit shapes let the compiler generate fast
   !> code.
   pure subroutine gather_and_factorise(entries, from, plan, store, scaling, x, soundness)
      integer, intent(in) :: entries, from(entries)
      type(plan_t), intent(in) :: plan
      real(num), intent(in) :: store(*)
      real(wp), intent(in) :: scaling(entries)
      real(num), intent(inout) :: x(plan%length)
      type(soundness_t), intent(out) :: soundness
      integer :: k

      x = 0.0_wp
      do k = 1, entries
         x(plan%slot(k)) = store(from(k))*scaling(k)
      end do
      call factorise_by(plan, x, soundness)
   end subroutine gather_and_factorise

   !> Solves y ← A⁻¹ y with the factors of the scaled matrix D A D.
   pure subroutine solve_by(plan, x, scale, y)
      type(plan_t), intent(in) :: plan
      real(num), intent(in) :: x(plan%length)
      real(wp), intent(in) :: scale(plan%n)      !! D
      real(num), intent(inout) :: y(plan%n)
      integer :: k

      do k = 1, plan%n
         y(k) = y(k)*scale(k)
      end do
      call substitute_by(plan, x, y)
      do k = 1, plan%n
         y(k) = y(k)*scale(k)
      end do
   end subroutine solve_by

   !> Factorises the matrix in x: D⁻¹ at the positions of D, and L. A pivot that is zero, or too small to divide by, is skipped, and
   !> growth is huge.
   !> Equation (K.23) of docs/theory/kkt.md.
   pure subroutine factorise_by(plan, x, soundness)
      type(plan_t), intent(in) :: plan
      real(num), intent(inout) :: x(plan%length)
      type(soundness_t), intent(out) :: soundness
      integer, parameter :: many = 8          ! blocks whose product neither overflows nor underflows
      real(wp), parameter :: vanished = 1.0e-30_wp   ! of a matrix scaled to the order of one: its inverse does not overflow
      real(num) :: d(3), inverse(3), determinant, mean, radius, l(2), product, total, unlimited, smallest, divisor
      real(num) :: negative, least, most, growth
      logical(mask) :: is_sound, is_good
      integer :: p, m, s, b, at, t

      unlimited = huge(1.0_wp)
      smallest = tiny(1.0_wp)
      negative = zero
      least = unlimited
      most = zero
      growth = zero
      is_sound = unlimited > 0.0_wp
      product = 1.0_wp
      total = 0.0_wp
      t = 1
      do p = 1, plan%blocks
         s = plan%start(p)
         m = plan%first(p + 1) - plan%first(p)
         if (plan%pivot(2, p) == 0) then
            d(1) = x(s)
            is_good = abs(d(1)) > vanished
            is_sound = is_sound .and. is_good
            divisor = merge(d(1), one, is_good)
            inverse(1) = merge(1.0_wp/divisor, zero, is_good)
            total = total + d(1)
            negative = negative + merge(one, zero, d(1) < 0.0_wp)
            least = min(least, abs(d(1)))
            most = max(most, abs(d(1)))
            product = product*d(1)
            do b = 1, m
               l(1) = x(s + b)*inverse(1)
               growth = max(growth, abs(l(1)))
               call subtract_one(m - b + 1, plan%places(t), l(1), x(s + b), x)
               t = t + m - b + 1
               x(s + b) = l(1)
            end do
            x(s) = inverse(1)
         else
            d = x(s:s + 2)
            total = total + d(1) + d(3)
            determinant = d(1)*d(3) - d(2)*d(2)
            is_good = abs(determinant) > vanished
            is_sound = is_sound .and. is_good
            divisor = merge(determinant, one, is_good)
            divisor = merge(1.0_wp/divisor, zero, is_good)
            inverse(1) = d(3)*divisor
            inverse(2) = -d(2)*divisor
            inverse(3) = d(1)*divisor
            mean = 0.5_wp*(d(1) + d(3))
            radius = sqrt((0.5_wp*(d(1) - d(3)))**2 + d(2)**2)
            ! the sign of the determinant is more exact than that of mean − radius
            negative = negative + merge(one, merge(2.0_wp*one, zero, mean < 0.0_wp), determinant < 0.0_wp)
            divisor = merge(abs(mean) + radius, one, is_good)
            least = min(least, abs(determinant)/divisor)
            most = max(most, abs(mean) + radius)
            product = product*determinant
            at = s + 2
            do b = 1, m
               l(1) = inverse(1)*x(at + b) + inverse(2)*x(at + m + b)
               l(2) = inverse(2)*x(at + b) + inverse(3)*x(at + m + b)
               growth = max(growth, max(abs(l(1)), abs(l(2))))
               call subtract_two(m - b + 1, plan%places(t), l(1), l(2), x(at + b), x(at + m + b), x)
               t = t + m - b + 1
               x(at + b) = l(1)
               x(at + m + b) = l(2)
            end do
            x(s:s + 2) = inverse
         end if
         if (mod(p, many) == 0 .or. p == plan%blocks) then
            soundness%log_determinant = soundness%log_determinant + log(max(abs(product), smallest))
            product = 1.0_wp
         end if
      end do
      ! min and max may drop what is not a number: the sum does not
      is_sound = is_sound .and. abs(total) < unlimited .and. least > least_ratio*most
      soundness%negative = negative
      soundness%least = least
      soundness%most = most
      soundness%growth = merge(growth, unlimited, is_sound)
   end subroutine factorise_by

   !> Subtracts the updates of a column: x(places) ← x(places) − l a. x(places) and a must not overlap.
   pure subroutine subtract_one(length, places, l, a, x)
      integer, intent(in) :: length, places(length)
      real(num), intent(in) :: l, a(length)
      real(num), intent(inout) :: x(*)
      integer :: k

      do k = 1, length
         x(places(k)) = x(places(k)) - l*a(k)
      end do
   end subroutine subtract_one

   !> Subtracts the updates of a pivot with two columns: x(places) ← x(places) − (l a + m b). x(places) must not overlap a or b.
   pure subroutine subtract_two(length, places, l, m, a, b, x)
      integer, intent(in) :: length, places(length)
      real(num), intent(in) :: l, m, a(length), b(length)
      real(num), intent(inout) :: x(*)
      integer :: k

      do k = 1, length
         x(places(k)) = x(places(k)) - (l*a(k) + m*b(k))
      end do
   end subroutine subtract_two

   !> Solves y ← A⁻¹ y for one right-hand side, with the factors of A.
   pure subroutine substitute_by(plan, x, y)
      type(plan_t), intent(in) :: plan
      real(num), intent(in) :: x(plan%length)
      real(num), intent(inout) :: y(plan%n)
      real(num) :: one, two
      integer :: p, m, s, a, at, i, j, k

      do p = 1, plan%blocks
         s = plan%start(p)
         at = plan%first(p) - 1
         m = plan%first(p + 1) - plan%first(p)
         i = plan%pivot(1, p)
         j = plan%pivot(2, p)
         if (j == 0) then
            one = y(i)
            do a = 1, m
               k = plan%rows(at + a)
               y(k) = y(k) - x(s + a)*one
            end do
            y(i) = one*x(s)
         else
            one = y(i)
            two = y(j)
            do a = 1, m
               k = plan%rows(at + a)
               y(k) = y(k) - (x(s + 2 + a)*one + x(s + 2 + m + a)*two)
            end do
            y(i) = x(s)*one + x(s + 1)*two
            y(j) = x(s + 1)*one + x(s + 2)*two
         end if
      end do
      do p = plan%blocks, 1, -1
         s = plan%start(p)
         at = plan%first(p) - 1
         m = plan%first(p + 1) - plan%first(p)
         i = plan%pivot(1, p)
         j = plan%pivot(2, p)
         if (j == 0) then
            one = y(i)
            do a = 1, m
               one = one - x(s + a)*y(plan%rows(at + a))
            end do
            y(i) = one
         else
            one = y(i)
            two = y(j)
            do a = 1, m
               k = plan%rows(at + a)
               one = one - x(s + 2 + a)*y(k)
               two = two - x(s + 2 + m + a)*y(k)
            end do
            y(i) = one
            y(j) = two
         end if
      end do
   end subroutine substitute_by

   !> Solves for several right-hand sides at a time. Most right-hand sides are loads on one body, so that blocks of zeros are
   !> skipped.
   pure subroutine substitute_several_by(plan, x, y)
      type(plan_t), intent(in) :: plan
      real(num), intent(in) :: x(plan%length)
      real(num), intent(inout) :: y(several, plan%n)      !! (right-hand side, unknown)
      real(num) :: first(several), second(several)
      integer :: p, m, s, a, at, i, j, k

      do p = 1, plan%blocks
         s = plan%start(p)
         at = plan%first(p) - 1
         m = plan%first(p + 1) - plan%first(p)
         i = plan%pivot(1, p)
         j = plan%pivot(2, p)
         first = y(:, i)
         if (j == 0) then
            if (.not. any(some(abs(first) > 0.0_wp))) cycle
            do a = 1, m
               k = plan%rows(at + a)
               y(:, k) = y(:, k) - x(s + a)*first
            end do
            y(:, i) = x(s)*first
         else
            second = y(:, j)
            if (.not. any(some(abs(first) + abs(second) > 0.0_wp))) cycle
            do a = 1, m
               k = plan%rows(at + a)
               y(:, k) = y(:, k) - (x(s + 2 + a)*first + x(s + 2 + m + a)*second)
            end do
            y(:, i) = x(s)*first + x(s + 1)*second
            y(:, j) = x(s + 1)*first + x(s + 2)*second
         end if
      end do
      do p = plan%blocks, 1, -1
         s = plan%start(p)
         at = plan%first(p) - 1
         m = plan%first(p + 1) - plan%first(p)
         i = plan%pivot(1, p)
         j = plan%pivot(2, p)
         first = y(:, i)
         if (j == 0) then
            do a = 1, m
               first = first - x(s + a)*y(:, plan%rows(at + a))
            end do
         else
            second = y(:, j)
            do a = 1, m
               k = plan%rows(at + a)
               first = first - x(s + 2 + a)*y(:, k)
               second = second - x(s + 2 + m + a)*y(:, k)
            end do
            y(:, j) = second
         end if
         y(:, i) = first
      end do
   end subroutine substitute_several_by

end module ek_plan_factors
