!> The linear system of a quadratic cost under linear conditions, with K symmetric and positive semi-definite:
!>
!>     [ K   F ] [v]   [b]
!>     [ Fᵀ  0 ] [y] = [0]
!>
!> The columns of F are eliminated one after the other, with the largest element of the column as pivot: P F = L [U; 0]. The same
!> operations on rows and columns of K leave Zᵀ K Z, where the columns of Z span the null space of Fᵀ. Cholesky's method factorises
!> Zᵀ K Z. Zeros are skipped: for bodies with few connections this takes a fraction of the time of LAPACK's dsytrf on the whole.
!>
!> The matrix counts as regular only if its rank is beyond doubt: see `pivot_share` and `stiffness_share`. Other matrices
!> require a decomposition in singular values (ek_singular_values).
module ek_saddle
   use ek_kinds, only: wp
   use ek_lapack, only: dpotrf
   use ek_substitution, only: product_sum
   implicit none(type, external)
   private
   public :: saddle_t, new_saddle, eliminate, reduce, spread_motion, solve_forces

   ! A pivot of F up to this share of its largest element leaves a doubt. Columns count as dependent in ek_preload_problem where a
   ! singular value is below 1e-11: between the two there is room for the factor from pivots to singular values, seldom over 100.
   real(wp), parameter :: pivot_share = 1.0e-6_wp
   ! … and a pivot of Zᵀ K Z, in the units of K, up to this share of the largest diagonal element of K. It is a square: 1e-22
   ! of the largest counts as nothing there.
   real(wp), parameter :: stiffness_share = 1.0e-10_wp

   !> The matrix of a saddle-point system, later its factors.
   type :: saddle_t
      integer :: n = 0                           !! number of rows of K
      integer :: m = 0                           !! number of columns of F
      real(wp), allocatable :: k(:, :)           !! (n, n) lower triangle of K; after `eliminate` the factor of Zᵀ K Z, from row m +
                                                 !! 1 on
      real(wp), allocatable :: f(:, :)           !! (n, m) F; after `eliminate` U, and L below the diagonal
      integer, allocatable :: swapped(:)         !! (m): the row that was exchanged with row k
      logical :: is_regular = .false.            !! F and Zᵀ K Z have full rank beyond doubt
   end type saddle_t

contains

   !> Creates a saddle matrix of zeros.
   pure subroutine new_saddle(n, m, saddle)
      integer, intent(in) :: n, m
      type(saddle_t), intent(out) :: saddle

      saddle%n = n
      saddle%m = m
      allocate (saddle%k(n, n), saddle%f(n, m), source=0.0_wp)
      allocate (saddle%swapped(m), source=0)
   end subroutine new_saddle

   !> Factorises the matrix in place and sets is_regular. All elements and all products of two elements must be finite.
   pure subroutine eliminate(saddle)
      type(saddle_t), intent(inout) :: saddle

      saddle%is_regular = .false.
      if (saddle%m > saddle%n) return
      call eliminate_arrays(saddle%n, saddle%m, saddle%k, saddle%f, saddle%swapped, saddle%is_regular)
   end subroutine eliminate

   !> Factorises the arrays of a saddle matrix for `eliminate`, with explicit shapes. Returns early if the matrix is not regular.
   !> Equation (K.22) of docs/theory/kkt.md.
   pure subroutine eliminate_arrays(n, m, k, f, swapped, is_regular)
      integer, intent(in) :: n, m
      real(wp), intent(inout) :: k(n, n), f(n, m)
      integer, intent(out) :: swapped(m)
      logical, intent(out) :: is_regular
      real(wp) :: u(n), most, stiffest, least, factor
      integer :: list(n), c, i, j, l, p, listed, info

      is_regular = .false.
      most = 0.0_wp
      do c = 1, m
         most = max(most, maxval(abs(f(:, c))))
      end do
      stiffest = 0.0_wp
      do c = 1, n
         stiffest = max(stiffest, k(c, c))
      end do
      do c = 1, m
         p = c - 1 + maxloc(abs(f(c:n, c)), 1)
         if (.not. abs(f(p, c)) > pivot_share*most) return
         swapped(c) = p
         if (p /= c) call exchange(n, m, c, p, k, f)
         listed = 0
         do i = c + 1, n
            if (.not. abs(f(i, c)) > 0.0_wp) cycle
            f(i, c) = f(i, c)/f(c, c)
            listed = listed + 1
            list(listed) = i
         end do
         if (listed == 0) cycle
         do l = c + 1, m
            factor = f(c, l)
            if (.not. abs(factor) > 0.0_wp) cycle
            do i = 1, listed
               f(list(i), l) = f(list(i), l) - factor*f(list(i), c)
            end do
         end do
         ! K ← K − l uᵀ − u lᵀ, u = k_c − ½ k_cc l: rows and columns at once
         u(c + 1:n) = k(c + 1:n, c) - (0.5_wp*k(c, c))*f(c + 1:n, c)
         if (.not. any(abs(u(c + 1:n)) > 0.0_wp)) cycle
         do i = 1, listed
            j = list(i)
            factor = f(j, c)
            k(j:n, j) = k(j:n, j) - factor*u(j:n)
         end do
         l = 1        ! the first in the list from row j on
         do j = c + 1, list(listed)
            if (list(l) < j) l = l + 1
            if (.not. abs(u(j)) > 0.0_wp) cycle
            do i = l, listed
               k(list(i), j) = k(list(i), j) - u(j)*f(list(i), c)
            end do
         end do
      end do
      if (m < n) then
         call dpotrf('L', n - m, k(m + 1, m + 1), n, info)
         if (info /= 0) return
         least = k(m + 1, m + 1)
         do c = m + 2, n
            least = min(least, k(c, c))
         end do
         if (.not. least**2 > stiffness_share*stiffest) return
      end if
      is_regular = .true.
   end subroutine eliminate_arrays

   !> Exchanges rows c < p of F, and rows and columns c and p of K. Columns of K before c are not needed any more and are not
   !> exchanged.
   pure subroutine exchange(n, m, c, p, k, f)
      integer, intent(in) :: n, m, c, p
      real(wp), intent(inout) :: k(n, n), f(n, m)
      real(wp) :: kept
      integer :: i

      do i = 1, m
         kept = f(c, i)
         f(c, i) = f(p, i)
         f(p, i) = kept
      end do
      kept = k(c, c)
      k(c, c) = k(p, p)
      k(p, p) = kept
      do i = c + 1, p - 1
         kept = k(i, c)
         k(i, c) = k(p, i)
         k(p, i) = kept
      end do
      do i = p + 1, n
         kept = k(i, c)
         k(i, c) = k(i, p)
         k(i, p) = kept
      end do
   end subroutine exchange

   !> Computes b ← L⁻¹ P b. The first m entries are the part that y must balance; the entries from m + 1 on are the part that only v
   !> can balance.
   pure subroutine reduce(saddle, b)
      type(saddle_t), intent(in) :: saddle        !! is_regular
      real(wp), intent(inout) :: b(:)             !! n
      real(wp) :: kept
      integer :: c, p

      do c = 1, saddle%m
         p = saddle%swapped(c)
         kept = b(c)
         b(c) = b(p)
         b(p) = kept
      end do
      call apply(saddle%n, saddle%m, saddle%f, b)
   end subroutine reduce

   !> Applies the row operations of F to a vector.
   pure subroutine apply(n, m, f, b)
      integer, intent(in) :: n, m
      real(wp), intent(in) :: f(n, m)
      real(wp), intent(inout) :: b(n)
      integer :: c

      do c = 1, m
         if (abs(b(c)) > 0.0_wp) b(c + 1:n) = b(c + 1:n) - b(c)*f(c + 1:n, c)
      end do
   end subroutine apply

   !> Computes v in place from a reduced b.
   pure subroutine spread_motion(saddle, b)
      type(saddle_t), intent(in) :: saddle        !! is_regular
      real(wp), intent(inout) :: b(:)             !! n: from `reduce`; then v
      real(wp) :: kept
      integer :: c, p

      call substitute_back(saddle%n, saddle%m, saddle%k, saddle%f, b)
      do c = saddle%m, 1, -1
         p = saddle%swapped(c)
         kept = b(c)
         b(c) = b(p)
         b(p) = kept
      end do
   end subroutine spread_motion

   !> Computes b ← L⁻ᵀ [0; S⁻¹ b₂] with the factor of S = Zᵀ K Z.
   !> Equation (K.22) of docs/theory/kkt.md.
   pure subroutine substitute_back(n, m, k, f, b)
      integer, intent(in) :: n, m
      real(wp), intent(in) :: k(n, n), f(n, m)
      real(wp), intent(inout) :: b(n)
      integer :: c

      do c = m + 1, n
         b(c) = b(c)/k(c, c)
         b(c + 1:n) = b(c + 1:n) - b(c)*k(c + 1:n, c)
      end do
      do c = n, m + 1, -1
         b(c) = (b(c) - product_sum(n - c, k(c + 1:n, c), b(c + 1:n)))/k(c, c)
      end do
      do c = m, 1, -1
         b(c) = -product_sum(n - c, f(c + 1:n, c), b(c + 1:n))
      end do
   end subroutine substitute_back

   !> Finds y with F y = b from a reduced b. b(m+1:) is ignored, because it contains only rounding errors.
   pure subroutine solve_forces(saddle, b, y)
      type(saddle_t), intent(in) :: saddle        !! is_regular
      real(wp), intent(in) :: b(:)                !! n: from `reduce`
      real(wp), intent(out) :: y(:)               !! m
      integer :: c

      y(:) = b(:saddle%m)
      do c = saddle%m, 1, -1
         y(c) = y(c)/saddle%f(c, c)
         y(:c - 1) = y(:c - 1) - y(c)*saddle%f(:c - 1, c)
      end do
   end subroutine solve_forces

end module ek_saddle
