!> The singular value decomposition of a matrix (LAPACK dgesvd): its rank, its null spaces, and least-norm solutions for any
!> number of right-hand sides.
!>
!>     A = U S Vᵀ,   x = V S⁺ Uᵀ b
!>
!> The columns of U after the rank span the complement of the range of A: I − A A⁺ = U₀ U₀ᵀ. The columns of V after the rank span
!> the null space of A.
module ek_singular_values
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_lapack, only: dgesvd
   implicit none(type, external)
   private
   public :: singular_values_t, decompose, min_norm

   type :: singular_values_t
      logical :: is_found = .false.          !! false: A has elements that are not finite, or LAPACK did not converge
      integer :: rank = 0                    !! number of singular values that count as nonzero
      real(wp), allocatable :: values(:)     !! min(rows, columns) singular values, largest first
      real(wp), allocatable :: left(:, :)    !! U (rows, rows); without U (rows, 0)
      real(wp), allocatable :: right(:, :)   !! V (columns, columns); without null space (columns, min(rows, columns))
   end type singular_values_t

contains

   !> Decomposes a matrix. If this fails, U and V are unit matrices and the rank is 0, so that indices are within their bounds.
   pure subroutine decompose(a, share, parts, whole, wants_null_space, wants_left)
      real(wp), intent(in) :: a(:, :)
      real(wp), intent(in) :: share          !! singular values up to this share of the largest count as zero
      type(singular_values_t), intent(out) :: parts
      real(wp), intent(in), optional :: whole    !! … or of this number if larger: the norm of a matrix that contains A
      logical, intent(in), optional :: wants_null_space      !! all columns of V; default .false.
      logical, intent(in), optional :: wants_left            !! U, which has the square of the rows as elements; default .true.
      real(wp), allocatable :: copy(:, :), transposed(:, :), work(:)
      real(wp) :: query(1), most
      integer :: m, n, kept, rows, info
      character :: job, left_job

      m = size(a, 1)
      n = size(a, 2)
      left_job = 'A'
      if (present(wants_left)) left_job = merge('A', 'N', wants_left)
      rows = merge(m, 0, left_job == 'A')
      job = 'S'
      if (present(wants_null_space)) job = merge('A', 'S', wants_null_space)
      kept = merge(n, min(m, n), job == 'A')
      allocate (parts%values(min(m, n)), source=0.0_wp)
      call set_unit(m, rows, parts%left)
      call set_unit(n, kept, parts%right)
      parts%is_found = all(ieee_is_finite(a))
      if (size(a) == 0 .or. .not. parts%is_found) return
      allocate (copy, source=a)
      allocate (transposed(kept, n))
      call dgesvd(left_job, job, m, n, copy, m, parts%values, parts%left, m, transposed, kept, query, -1, info)
      allocate (work(max(1, int(query(1)))))
      call dgesvd(left_job, job, m, n, copy, m, parts%values, parts%left, m, transposed, kept, work, size(work), info)
      parts%is_found = info == 0
      if (.not. parts%is_found) then
         call set_unit(m, rows, parts%left)
         return
      end if
      parts%right = transpose(transposed)
      most = parts%values(1)
      if (present(whole)) most = max(most, whole)
      parts%rank = count(parts%values > share*most)
   end subroutine decompose

   !> Finds the shortest of all x with the smallest |A x − b|.
   pure subroutine min_norm(parts, b, x)
      type(singular_values_t), intent(in) :: parts       !! of A
      real(wp), intent(in) :: b(:)
      real(wp), intent(out) :: x(:)
      integer :: k

      x = 0.0_wp
      do k = 1, parts%rank
         x = x + parts%right(:, k)*(dot_product(parts%left(:, k), b)/parts%values(k))
      end do
   end subroutine min_norm

   !> Sets a matrix to zero with ones on its diagonal.
   pure subroutine set_unit(rows, columns, matrix)
      integer, intent(in) :: rows, columns
      real(wp), allocatable, intent(out) :: matrix(:, :)
      integer :: k

      allocate (matrix(rows, columns), source=0.0_wp)
      do k = 1, min(rows, columns)
         matrix(k, k) = 1.0_wp
      end do
   end subroutine set_unit

end module ek_singular_values
