!> Adding 3×3 blocks to the lower triangle of a matrix of bodies, six unknowns each: [Δr Δπ].
!>
!> `at` is the number of unknowns before a block, `at_i` the number before body i; a negative value means the chassis, which
!> has no unknowns. Diagonal blocks are added as full 3×3 blocks for simplicity; the part above the diagonal is never read.
module ek_block
   use ek_kinds, only: wp
   use ek_rotation, only: cross, skew
   implicit none(type, external)
   private
   public :: add_block, add_diagonal_block, add_link_stiffness, add_gap_hessian, add_gradient
   public :: add_s_block, rotated, in_world, dyad, dyad_rest

contains

   !> y ← y + factor × gradient, that of a measure of two bodies, at their unknowns.
   pure subroutine add_gradient(factor, gradient, at_i, at_j, y)
      real(wp), intent(in) :: factor, gradient(12)
      integer, intent(in) :: at_i, at_j
      real(wp), intent(inout) :: y(*)

      if (at_i >= 0) y(at_i + 1:at_i + 6) = y(at_i + 1:at_i + 6) + factor*gradient(1:6)
      if (at_j >= 0) y(at_j + 1:at_j + 6) = y(at_j + 1:at_j + 6) + factor*gradient(7:12)
   end subroutine add_gradient

   !> A v
   pure function rotated(a, v) result(w)
      real(wp), intent(in) :: a(3, 3), v(3)
      real(wp) :: w(3)
      w(1) = a(1, 1)*v(1) + a(1, 2)*v(2) + a(1, 3)*v(3)
      w(2) = a(2, 1)*v(1) + a(2, 2)*v(2) + a(2, 3)*v(3)
      w(3) = a(3, 1)*v(1) + a(3, 2)*v(2) + a(3, 3)*v(3)
   end function rotated

   !> A K Aᵀ; the chassis (at_i < 0) never rotates.
   pure function in_world(a, k, at_i) result(world)
      real(wp), intent(in) :: a(3, 3), k(3, 3)
      integer, intent(in) :: at_i
      real(wp) :: world(3, 3), ak(3, 3), row(3)
      integer :: j

      if (at_i < 0) then
         world = k
         return
      end if
      do j = 1, 3
         ak(:, j) = rotated(a, k(:, j))
      end do
      do j = 1, 3
         row = ak(j, :)
         world(j, :) = rotated(a, row)
      end do
   end function in_world

   !> Adds S(p,g) = ½(p gᵀ + g pᵀ) − (p·g) I to a diagonal block; no action if the body has no unknowns.
   !> Equation (M.2) of docs/theory/measures.md.
   pure subroutine add_s_block(p, g, at, body_at, ld, matrix)
      real(wp), intent(in) :: p(3), g(3)
      integer, intent(in) :: at, body_at, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: x, y, z, xy, xz, yz

      if (body_at < 0) return
      x = p(1)*g(1)
      y = p(2)*g(2)
      z = p(3)*g(3)
      matrix(at + 1, at + 1) = matrix(at + 1, at + 1) - (y + z)
      matrix(at + 2, at + 2) = matrix(at + 2, at + 2) - (x + z)
      matrix(at + 3, at + 3) = matrix(at + 3, at + 3) - (x + y)
      xy = 0.5_wp*(p(1)*g(2) + p(2)*g(1))
      matrix(at + 2, at + 1) = matrix(at + 2, at + 1) + xy
      matrix(at + 1, at + 2) = matrix(at + 1, at + 2) + xy
      xz = 0.5_wp*(p(1)*g(3) + p(3)*g(1))
      matrix(at + 3, at + 1) = matrix(at + 3, at + 1) + xz
      matrix(at + 1, at + 3) = matrix(at + 1, at + 3) + xz
      yz = 0.5_wp*(p(2)*g(3) + p(3)*g(2))
      matrix(at + 3, at + 2) = matrix(at + 3, at + 2) + yz
      matrix(at + 2, at + 3) = matrix(at + 2, at + 3) + yz
   end subroutine add_s_block

   !> Adds Jᵀ M J, J = [−I, ã, I, −b̃]: a symmetric stiffness M between two points.
   !> Equation (M.7) of docs/theory/measures.md.
   pure subroutine add_link_stiffness(m, a, b, at_i, at_j, ld, matrix)
      real(wp), intent(in) :: m(3, 3)       !! symmetric, global axes [N/m]
      real(wp), intent(in) :: a(3), b(3)    !! arms, global axes [m]
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: m_arm(3, 3, 2), x(3, 3), arm(3)   ! M ã, M b̃
      integer :: at(2), k, end

      at = [at_i, at_j]
      do end = 1, 2
         if (at(end) < 0) cycle
         arm = merge(a, b, end == 1)
         do k = 1, 3
            m_arm(k, :, end) = cross(m(:, k), arm)
         end do
         do k = 1, 3
            x(:, k) = cross(m_arm(:, k, end), arm)
         end do
         call add_diagonal_block(m, at(end), at(end), ld, matrix)
         call add_diagonal_block(x, at(end) + 3, at(end), ld, matrix)
         x = -m_arm(:, :, end)
         call add_block(x, at(end), at(end) + 3, ld, matrix)
      end do
      if (at_i < 0 .or. at_j < 0) return
      do k = 1, 3
         x(:, k) = cross(a, m_arm(:, k, 2))
      end do
      call add_block(x, at_i + 3, at_j + 3, ld, matrix)
      x = -m
      call add_block(x, at_i, at_j, ld, matrix)
      call add_block(m_arm(:, :, 2), at_i, at_j + 3, ld, matrix)
      x = transpose(m_arm(:, :, 1))
      call add_block(x, at_i + 3, at_j, ld, matrix)
   end subroutine add_link_stiffness

   !> Adds the Hessian of f·d, f fixed in body i (any length: the measure is linear in f).
   !>
   !> π_iπ_i: S(a+d,f);  π_jπ_j: S(b,f);  π_i r_j = f̃ = −π_i r_i;  π_iπ_j = (f·b)I − b fᵀ
   !> Equation (M.5) of docs/theory/measures.md.
   pure subroutine add_gap_hessian(f, a, b, d, at_i, at_j, ld, matrix)
      real(wp), intent(in) :: f(3), a(3), b(3), d(3)   !! global axes
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: arm(3), block(3, 3)

      call add_s_block(b, f, at_j + 3, at_j, ld, matrix)
      if (at_i < 0) return
      arm = a + d
      call add_s_block(arm, f, at_i + 3, at_i, ld, matrix)
      block = -skew(f)
      call add_block(block, at_i + 3, at_i, ld, matrix)
      if (at_j < 0) return
      block = skew(f)
      call add_block(block, at_i + 3, at_j, ld, matrix)
      call add_block(dyad_rest(b, f), at_i + 3, at_j + 3, ld, matrix)
   end subroutine add_gap_hessian

   !> matrix(at+1:at+3, at+1:at+3) += block; no action if the body has no unknowns.
   pure subroutine add_diagonal_block(block, at, body_at, ld, matrix)
      real(wp), intent(in) :: block(3, 3)
      integer, intent(in) :: at, body_at, ld
      real(wp), intent(inout) :: matrix(ld, *)
      integer :: l

      if (body_at < 0) return
      do l = 1, 3
         matrix(at + 1, at + l) = matrix(at + 1, at + l) + block(1, l)
         matrix(at + 2, at + l) = matrix(at + 2, at + l) + block(2, l)
         matrix(at + 3, at + l) = matrix(at + 3, at + l) + block(3, l)
      end do
   end subroutine add_diagonal_block

   !> Adds an off-diagonal block at (row, column) to the lower triangle, transposed if it
   !> belongs above the diagonal.
   pure subroutine add_block(block, row, column, ld, matrix)
      real(wp), intent(in) :: block(3, 3)
      integer, intent(in) :: row, column, ld
      real(wp), intent(inout) :: matrix(ld, *)
      integer :: l

      if (row > column) then
         do l = 1, 3
            matrix(row + 1, column + l) = matrix(row + 1, column + l) + block(1, l)
            matrix(row + 2, column + l) = matrix(row + 2, column + l) + block(2, l)
            matrix(row + 3, column + l) = matrix(row + 3, column + l) + block(3, l)
         end do
      else
         do l = 1, 3
            matrix(column + 1, row + l) = matrix(column + 1, row + l) + block(l, 1)
            matrix(column + 2, row + l) = matrix(column + 2, row + l) + block(l, 2)
            matrix(column + 3, row + l) = matrix(column + 3, row + l) + block(l, 3)
         end do
      end if
   end subroutine add_block

   !> x yᵀ
   pure function dyad(x, y) result(m)
      real(wp), intent(in) :: x(3), y(3)
      real(wp) :: m(3, 3)
      m(:, 1) = x*y(1)
      m(:, 2) = x*y(2)
      m(:, 3) = x*y(3)
   end function dyad

   !> (x·y) I − x yᵀ
   !> Equation (M.3) of docs/theory/measures.md.
   pure function dyad_rest(x, y) result(m)
      real(wp), intent(in) :: x(3), y(3)
      real(wp) :: m(3, 3), c
      c = dot_product(x, y)
      m = -dyad(x, y)
      m(1, 1) = m(1, 1) + c
      m(2, 2) = m(2, 2) + c
      m(3, 3) = m(3, 3) + c
   end function dyad_rest

end module ek_block
