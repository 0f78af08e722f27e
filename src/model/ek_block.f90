!> The blocks of the tangent matrix of the bodies, six unknowns per body [Δr Δπ], and procedures that add 3×3 parts to the blocks.
!>
!> `blocks(:, :, b)` for b up to the number of bodies is the diagonal block of body b. Only the lower triangle of this block is
!> used. The other blocks contain the coupling of two bodies: the rows are of the body with the larger index, the columns of the
!> other body. The array `at` locates the three blocks of an element or a measure between bodies i and j. at(1) = i and at(2) = j
!> are the diagonal blocks (0: the chassis, which has no unknowns). at(3) is the index of the coupling block, negative if body i has
!> the larger index, 0 without a coupling block. A 3×3 part is named by its rows and columns, each one of r_i, pi_i, r_j, pi_j.
!> Parts on the diagonal are added in full.
module ek_block
   use ek_kinds, only: wp
   use ek_number, only: num
   use ek_rotation, only: cross, skew
   implicit none(type, external)
   private
   public :: add_block, add_link_stiffness, add_gap_hessian, add_gradient
   public :: add_s_block, rotated, in_world, dyad, dyad_rest
   public :: r_i, pi_i, r_j, pi_j

   integer, parameter :: r_i = 1, pi_i = 2, r_j = 3, pi_j = 4      !! the unknowns of an element: Δr, Δπ of bodies i and j

contains

   !> Adds factor × the gradient of a measure of two bodies to y, at the unknowns of the bodies. at_i and at_j are the numbers of
   !> unknowns before the unknowns of bodies i and j; a negative number is the chassis.
   pure subroutine add_gradient(factor, gradient, at_i, at_j, y)
      real(num), intent(in) :: factor, gradient(12)
      integer, intent(in) :: at_i, at_j
      real(num), intent(inout) :: y(*)

      if (at_i >= 0) y(at_i + 1:at_i + 6) = y(at_i + 1:at_i + 6) + factor*gradient(1:6)
      if (at_j >= 0) y(at_j + 1:at_j + 6) = y(at_j + 1:at_j + 6) + factor*gradient(7:12)
   end subroutine add_gradient

   !> The product A v.
   pure function rotated(a, v) result(w)
      real(num), intent(in) :: a(3, 3), v(3)
      real(num) :: w(3)
      w(1) = a(1, 1)*v(1) + a(1, 2)*v(2) + a(1, 3)*v(3)
      w(2) = a(2, 1)*v(1) + a(2, 2)*v(2) + a(2, 3)*v(3)
      w(3) = a(3, 1)*v(1) + a(3, 2)*v(2) + a(3, 3)*v(3)
   end function rotated

   !> The product A K Aᵀ; K for the chassis (body 0), which never rotates.
   pure function in_world(a, k, body) result(world)
      real(num), intent(in) :: a(3, 3), k(3, 3)
      integer, intent(in) :: body
      real(num) :: world(3, 3), ak(3, 3), row(3)
      integer :: j

      if (body <= 0) then
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

   !> Adds S(p,g) = ½(p gᵀ + g pᵀ) − (p·g) I to the diagonal block of rotations of a body.
   !> Equation (M.2) of docs/theory/measures.md.
   pure subroutine add_s_block(p, g, body, blocks)
      real(num), intent(in) :: p(3), g(3)
      integer, intent(in) :: body           !! 0: no action
      real(num), intent(inout) :: blocks(6, 6, *)
      real(num) :: x, y, z, xy, xz, yz

      if (body <= 0) return
      x = p(1)*g(1)
      y = p(2)*g(2)
      z = p(3)*g(3)
      blocks(4, 4, body) = blocks(4, 4, body) - (y + z)
      blocks(5, 5, body) = blocks(5, 5, body) - (x + z)
      blocks(6, 6, body) = blocks(6, 6, body) - (x + y)
      xy = 0.5_wp*(p(1)*g(2) + p(2)*g(1))
      blocks(5, 4, body) = blocks(5, 4, body) + xy
      blocks(4, 5, body) = blocks(4, 5, body) + xy
      xz = 0.5_wp*(p(1)*g(3) + p(3)*g(1))
      blocks(6, 4, body) = blocks(6, 4, body) + xz
      blocks(4, 6, body) = blocks(4, 6, body) + xz
      yz = 0.5_wp*(p(2)*g(3) + p(3)*g(2))
      blocks(6, 5, body) = blocks(6, 5, body) + yz
      blocks(5, 6, body) = blocks(5, 6, body) + yz
   end subroutine add_s_block

   !> Adds Jᵀ M J, J = [−I, ã, I, −b̃]: a symmetric stiffness M between two points.
   !> Equation (M.7) of docs/theory/measures.md.
   pure subroutine add_link_stiffness(m, a, b, at, blocks)
      real(num), intent(in) :: m(3, 3)       !! symmetric, global axes [N/m]
      real(num), intent(in) :: a(3), b(3)    !! arms, global axes [m]
      integer, intent(in) :: at(3)
      real(num), intent(inout) :: blocks(6, 6, *)
      real(num) :: m_a(3, 3), m_b(3, 3), x(3, 3)     ! M ã, M b̃
      integer :: k

      if (at(1) > 0) then
         do k = 1, 3
            m_a(k, :) = cross(m(:, k), a)
         end do
         do k = 1, 3
            x(:, k) = cross(m_a(:, k), a)
         end do
         call add_block(m, r_i, r_i, at, blocks)
         call add_block(x, pi_i, pi_i, at, blocks)
         x = -m_a
         call add_block(x, r_i, pi_i, at, blocks)
      end if
      if (at(2) > 0) then
         do k = 1, 3
            m_b(k, :) = cross(m(:, k), b)
         end do
         do k = 1, 3
            x(:, k) = cross(m_b(:, k), b)
         end do
         call add_block(m, r_j, r_j, at, blocks)
         call add_block(x, pi_j, pi_j, at, blocks)
         x = -m_b
         call add_block(x, r_j, pi_j, at, blocks)
      end if
      if (at(3) == 0) return
      do k = 1, 3
         x(:, k) = cross(a, m_b(:, k))
      end do
      call add_block(x, pi_i, pi_j, at, blocks)
      x = -m
      call add_block(x, r_i, r_j, at, blocks)
      call add_block(m_b, r_i, pi_j, at, blocks)
      x = transpose(m_a)
      call add_block(x, pi_i, r_j, at, blocks)
   end subroutine add_link_stiffness

   !> Adds the Hessian of f·d, with d the displacement between the points at the arms a and b, and f fixed in body i (f may have any
   !> length, as the measure is linear in f).
   !>
   !> π_iπ_i: S(a+d,f);  π_jπ_j: S(b,f);  π_i r_j = f̃ = −π_i r_i;  π_iπ_j = (f·b)I − b fᵀ
   !> Equation (M.5) of docs/theory/measures.md.
   pure subroutine add_gap_hessian(f, a, b, d, at, blocks)
      real(num), intent(in) :: f(3), a(3), b(3), d(3)   !! global axes
      integer, intent(in) :: at(3)
      real(num), intent(inout) :: blocks(6, 6, *)
      real(num) :: arm(3), block(3, 3)

      call add_s_block(b, f, at(2), blocks)
      if (at(1) == 0) return
      arm = a + d
      call add_s_block(arm, f, at(1), blocks)
      block = -skew(f)
      call add_block(block, pi_i, r_i, at, blocks)
      if (at(3) == 0) return
      block = skew(f)
      call add_block(block, pi_i, r_j, at, blocks)
      block = dyad_rest(b, f)
      call add_block(block, pi_i, pi_j, at, blocks)
   end subroutine add_gap_hessian

   !> Adds a 3×3 part; does nothing if one of its bodies is the chassis. The part is transposed where its transpose is stored.
   pure subroutine add_block(part, rows, columns, at, blocks)
      real(num), intent(in) :: part(3, 3)
      integer, intent(in) :: rows, columns      !! of the unknowns: r_i … pi_j
      integer, intent(in) :: at(3)
      real(num), intent(inout) :: blocks(6, 6, *)
      integer :: row, column, body_of_rows, body_of_columns

      body_of_rows = (rows + 1)/2
      body_of_columns = (columns + 1)/2
      row = 3*(1 - mod(rows, 2))
      column = 3*(1 - mod(columns, 2))
      if (body_of_rows == body_of_columns) then
         if (at(body_of_rows) <= 0) return
         if (row >= column) then
            call add_part(part, row, column, blocks(1, 1, at(body_of_rows)))
         else
            call add_transposed(part, column, row, blocks(1, 1, at(body_of_rows)))
         end if
      else if (at(3) > 0 .eqv. body_of_rows == 2) then
         if (at(3) /= 0) call add_part(part, row, column, blocks(1, 1, abs(at(3))))
      else if (at(3) /= 0) then
         call add_transposed(part, column, row, blocks(1, 1, abs(at(3))))
      end if
   end subroutine add_block

   !> Adds a part: block(row+1:row+3, column+1:column+3) += part.
   pure subroutine add_part(part, row, column, block)
      real(num), intent(in) :: part(3, 3)
      integer, intent(in) :: row, column
      real(num), intent(inout) :: block(6, 6)
      integer :: l

      do l = 1, 3
         block(row + 1, column + l) = block(row + 1, column + l) + part(1, l)
         block(row + 2, column + l) = block(row + 2, column + l) + part(2, l)
         block(row + 3, column + l) = block(row + 3, column + l) + part(3, l)
      end do
   end subroutine add_part

   !> Adds a transposed part: block(row+1:row+3, column+1:column+3) += partᵀ.
   pure subroutine add_transposed(part, row, column, block)
      real(num), intent(in) :: part(3, 3)
      integer, intent(in) :: row, column
      real(num), intent(inout) :: block(6, 6)
      integer :: l

      do l = 1, 3
         block(row + 1, column + l) = block(row + 1, column + l) + part(l, 1)
         block(row + 2, column + l) = block(row + 2, column + l) + part(l, 2)
         block(row + 3, column + l) = block(row + 3, column + l) + part(l, 3)
      end do
   end subroutine add_transposed

   !> The dyad x yᵀ.
   pure function dyad(x, y) result(m)
      real(num), intent(in) :: x(3), y(3)
      real(num) :: m(3, 3)
      m(:, 1) = x*y(1)
      m(:, 2) = x*y(2)
      m(:, 3) = x*y(3)
   end function dyad

   !> The matrix (x·y) I − x yᵀ.
   !> Equation (M.3) of docs/theory/measures.md.
   pure function dyad_rest(x, y) result(m)
      real(num), intent(in) :: x(3), y(3)
      real(num) :: m(3, 3), c
      c = dot_product(x, y)
      m = -dyad(x, y)
      m(1, 1) = m(1, 1) + c
      m(2, 2) = m(2, 2) + c
      m(3, 3) = m(3, 3) + c
   end function dyad_rest

end module ek_block
