!> The solution with the factors P L D Lᵀ Pᵀ of LAPACK's dsytrf, for one right-hand side.
!>
!> LAPACK's dsytrs makes two BLAS calls per column; at the few dozen unknowns of a suspension these calls cost more than
!> the arithmetic: 2.3 against 0.8 µs at 27 unknowns, 8 against 4 at 85. `substitute` is the same algorithm in plain loops. For
!> many right-hand sides dsytrs is faster.
module ek_substitution
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: substitute, product_sum

contains

   !> Computes x ← A⁻¹ x with the factors and pivots of dsytrf('L', …), info = 0.
   !>
   !> Column k of `factors` holds column k of L below the diagonal; a pair with pivots(k) = pivots(k+1) < 0 has a 2 × 2 block
   !> of D, whose off-diagonal element is factors(k+1, k).
   pure subroutine substitute(n, factors, pivots, x)
      integer, intent(in) :: n
      real(wp), intent(in) :: factors(n, n)
      integer, intent(in) :: pivots(n)
      real(wp), intent(inout) :: x(n)
      real(wp) :: upper, lower, determinant, first, second
      integer :: k

      ! x ← D⁻¹ L⁻¹ Pᵀ x
      k = 1
      do while (k <= n)
         if (pivots(k) > 0) then
            call swap(n, x, k, pivots(k))
            x(k + 1:n) = x(k + 1:n) - factors(k + 1:n, k)*x(k)
            x(k) = x(k)/factors(k, k)
            k = k + 1
         else
            call swap(n, x, k + 1, -pivots(k))
            x(k + 2:n) = x(k + 2:n) - factors(k + 2:n, k)*x(k) - factors(k + 2:n, k + 1)*x(k + 1)
            ! divide the block by its off-diagonal element, the largest, to avoid overflow
            upper = factors(k, k)/factors(k + 1, k)
            lower = factors(k + 1, k + 1)/factors(k + 1, k)
            determinant = upper*lower - 1.0_wp
            first = x(k)/factors(k + 1, k)
            second = x(k + 1)/factors(k + 1, k)
            x(k) = (lower*first - second)/determinant
            x(k + 1) = (upper*second - first)/determinant
            k = k + 2
         end if
      end do

      ! x ← P L⁻ᵀ x
      k = n
      do while (k >= 1)
         if (pivots(k) > 0) then
            x(k) = x(k) - product_sum(n - k, x(k + 1:n), factors(k + 1:n, k))
            call swap(n, x, k, pivots(k))
            k = k - 1
         else
            x(k) = x(k) - product_sum(n - k, x(k + 1:n), factors(k + 1:n, k))
            x(k - 1) = x(k - 1) - product_sum(n - k, x(k + 1:n), factors(k + 1:n, k - 1))
            call swap(n, x, k, -pivots(k))
            k = k - 2
         end if
      end do
   end subroutine substitute

   pure subroutine swap(n, x, i, j)
      integer, intent(in) :: n, i, j
      real(wp), intent(inout) :: x(n)
      real(wp) :: kept

      kept = x(i)
      x(i) = x(j)
      x(j) = kept
   end subroutine swap

   !> The sum Σ a b, computed in eight partial sums, which the compiler can vectorise.
   pure real(wp) function product_sum(n, a, b) result(total)
      integer, intent(in) :: n
      real(wp), intent(in) :: a(n), b(n)
      integer, parameter :: lanes = 8
      real(wp) :: part(lanes)
      integer :: i, j

      part = 0.0_wp
      do i = 1, n - lanes + 1, lanes
         do j = 1, lanes
            part(j) = part(j) + a(i + j - 1)*b(i + j - 1)
         end do
      end do
      total = ((part(1) + part(5)) + (part(2) + part(6))) + ((part(3) + part(7)) + (part(4) + part(8)))
      do i = n - mod(n, lanes) + 1, n
         total = total + a(i)*b(i)
      end do
   end function product_sum

end module ek_substitution
