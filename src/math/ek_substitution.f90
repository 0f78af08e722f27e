!> The factors P L D Lᵀ Pᵀ of a symmetric indefinite matrix (Bunch and Kaufman), and the solution with them.
!>
!> LAPACK's dsytrf and dsytrs make several BLAS calls per column; at the few dozen unknowns of a suspension these calls cost more
!> than the arithmetic. These are the same algorithms, with the same format of the result, in plain loops that leave out the
!> zeros of a sparse matrix. For many right-hand sides dsytrs is faster.
module ek_substitution
   use ek_kinds, only: wp
   use ek_vector, only: add_multiple
   implicit none(type, external)
   private
   public :: factorise_indefinite, substitute

contains

   !> A ← P L D Lᵀ Pᵀ, lower triangle, as dsytf2('L', …) of LAPACK.
   !>
   !> A pivot is one element, or a 2 × 2 block if that is too small against the rest of its column: growth is bounded for
   !> the share (1 + √17)/8 of Bunch and Kaufman.
   pure subroutine factorise_indefinite(n, matrix, pivots, is_singular)
      integer, intent(in) :: n
      real(wp), intent(inout) :: matrix(n, n)
      integer, intent(out) :: pivots(n)          !! see `substitute`
      logical, intent(out) :: is_singular        !! a column is zero or not of numbers; it was passed over
      real(wp), parameter :: share = (1.0_wp + sqrt(17.0_wp))/8.0_wp
      real(wp) :: own, column, row
      integer :: k, largest, pivot, last

      is_singular = .false.
      k = 1
      do while (k <= n)
         own = abs(matrix(k, k))
         largest = min(k + maxloc(abs(matrix(k + 1:, k)), dim=1), n)
         column = 0.0_wp
         if (k < n) column = abs(matrix(largest, k))
         pivot = k
         last = k                ! of the block
         if (.not. (max(own, column) > 0.0_wp .and. own <= huge(own))) then
            is_singular = .true.
            pivots(k) = k
            k = k + 1
            cycle
         else if (own < share*column) then
            row = maxval(abs(matrix(largest, k:largest - 1)))
            if (largest < n) row = max(row, maxval(abs(matrix(largest + 1:, largest))))
            if (own < share*column*(column/row)) then
               pivot = largest
               if (abs(matrix(largest, largest)) < share*row) last = k + 1
            end if
         end if
         if (pivot /= last) then
            call exchange(matrix(pivot + 1:, last), matrix(pivot + 1:, pivot))
            call exchange(matrix(last + 1:pivot - 1, last), matrix(pivot, last + 1:pivot - 1))
            call exchange(matrix(last:last, last), matrix(pivot:pivot, pivot))
            if (last > k) call exchange(matrix(last:last, k), matrix(pivot:pivot, k))
         end if
         if (last == k) then
            call eliminate(n, k, matrix)
            pivots(k) = pivot
         else
            call eliminate_pair(n, k, matrix)
            pivots(k:last) = -pivot
         end if
         k = last + 1
      end do
   end subroutine factorise_indefinite

   !> Removes column k from those behind it: x ← x / d, A ← A − x d xᵀ.
   pure subroutine eliminate(n, k, matrix)
      integer, intent(in) :: n, k
      real(wp), intent(inout) :: matrix(n, n)
      real(wp) :: factor
      integer :: j

      do j = k + 1, n
         if (.not. abs(matrix(j, k)) > 0.0_wp) cycle
         factor = matrix(j, k)/matrix(k, k)
         call add_multiple(n - j + 1, -factor, matrix(j:, k), matrix(j:, j))
         matrix(j, k) = factor
      end do
   end subroutine eliminate

   !> The same of columns k and k + 1, whose block is divided by its off-diagonal element, the largest, to avoid overflow.
   pure subroutine eliminate_pair(n, k, matrix)
      integer, intent(in) :: n, k
      real(wp), intent(inout) :: matrix(n, n)
      real(wp) :: upper, lower, scale, first, second
      integer :: j

      lower = matrix(k + 1, k + 1)/matrix(k + 1, k)
      upper = matrix(k, k)/matrix(k + 1, k)
      scale = 1.0_wp/(lower*upper - 1.0_wp)/matrix(k + 1, k)
      do j = k + 2, n
         if (.not. max(abs(matrix(j, k)), abs(matrix(j, k + 1))) > 0.0_wp) cycle
         first = scale*(lower*matrix(j, k) - matrix(j, k + 1))
         second = scale*(upper*matrix(j, k + 1) - matrix(j, k))
         call add_both(n - j + 1, -first, matrix(j:, k), -second, matrix(j:, k + 1), matrix(j:, j))
         matrix(j, k) = first
         matrix(j, k + 1) = second
      end do
   end subroutine eliminate_pair

   !> z ← z + a x + b y
   pure subroutine add_both(n, a, x, b, y, z)
      integer, intent(in) :: n
      real(wp), intent(in) :: a, x(n), b, y(n)
      real(wp), intent(inout) :: z(n)
      integer :: i

      do i = 1, n
         z(i) = z(i) + a*x(i) + b*y(i)
      end do
   end subroutine add_both

   pure subroutine exchange(x, y)
      real(wp), intent(inout) :: x(:), y(:)
      real(wp) :: kept
      integer :: i

      do i = 1, size(x)
         kept = x(i)
         x(i) = y(i)
         y(i) = kept
      end do
   end subroutine exchange

   !> x ← A⁻¹ x with the factors and pivots of `factorise_indefinite`, or of dsytrf('L', …).
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

   !> Σ a b in eight partial sums, which the compiler can vectorise.
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
