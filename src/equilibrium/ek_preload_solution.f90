!> Solves the linear problem of ek_preload_problem: forces in bushings (x), springs and joints (y) that hold the loads at design.
!>
!> `hold_by_elimination` solves the system of the problem by elimination (ek_saddle). The system is nearly as sparse as the tangent.
!> `hold_by_singular_values` needs twenty times as long, and is the way for problems without a unique solution: redundant rows,
!> dependent springs and joints, bodies that nothing holds.
module ek_preload_solution
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_block, only: add_gradient
   use ek_saddle, only: saddle_t, new_saddle, eliminate, reduce, spread_motion, solve_forces
   use ek_singular_values, only: singular_values_t, decompose, min_norm
   use ek_preload_problem, only: preload_problem_t
   implicit none(type, external)
   private
   public :: hold_by_elimination, hold_by_singular_values, rank_share

   real(wp), parameter :: rank_share = 1.0e-11_wp       !! limit of a singular value, as a share of the largest: smaller values are
                                                        !! rounding
   real(wp), parameter :: moderate = 1.0e100_wp         ! largest number whose products cannot overflow
   integer, parameter :: most_corrections = 3
   real(wp), parameter :: last_correction = 1.0e-8_wp   ! of the solution: the next is smaller by this factor, or its root
   real(wp), parameter :: closed = 1.0e-10_wp           ! of |b|: remainder of W x + F y = b

contains

   !> Solves by elimination, and corrects the solution with the columns of W and F until the corrections are small. is_sure is
   !> .false., and x and y have no meaning, if the solution may not be unique or the corrections do not become small.
   !> Equation (K.21) of docs/theory/kkt.md.
   pure subroutine hold_by_elimination(problem, x, y, is_sure)
      type(preload_problem_t), intent(in) :: problem
      real(wp), intent(out) :: x(:), y(:)             !! (nx): forces divided by √rate; (ny): forces
      logical, intent(out) :: is_sure
      type(saddle_t) :: saddle
      real(wp) :: c(problem%nq), v(problem%nq), dx(problem%nx), dy(size(problem%used)), part(size(problem%used))
      integer :: step

      x = 0.0_wp
      y = 0.0_wp
      is_sure = .false.
      if (size(problem%used) > problem%nq .or. .not. is_moderate(problem)) return
      call new_saddle(problem%nq, size(problem%used), saddle)
      call add_stiffness(problem, saddle%k)
      call add_columns(problem, saddle%f)
      call eliminate(saddle)
      if (.not. saddle%is_regular) return
      c = problem%load
      do step = 1, most_corrections
         v = c
         call reduce(saddle, v)
         call spread_motion(saddle, v)
         call bushing_forces(problem, v, dx)
         x = x + dx
         call subtract_bushings(problem, dx, c)
         is_sure = norm2(dx) <= last_correction*norm2(x)
         if (is_sure) exit
      end do
      if (.not. is_sure) return
      part = 0.0_wp
      do step = 1, 2
         v = c
         call reduce(saddle, v)
         call solve_forces(saddle, v, dy)
         part = part + dy
         call subtract_free(problem, dy, c)
      end do
      y(problem%used) = part
      is_sure = norm2(dy) <= last_correction*norm2(part) .and. norm2(c) <= closed*norm2(problem%load)
   end subroutine hold_by_elimination

   !> Whether all numbers are finite, and so small that no product of two of them overflows.
   pure logical function is_moderate(problem)
      type(preload_problem_t), intent(in) :: problem

      is_moderate = are_moderate(size(problem%load), problem%load)
      if (is_moderate) is_moderate = are_moderate(size(problem%weighted), problem%weighted)
      if (is_moderate) is_moderate = are_moderate(12*problem%pieces, problem%piece)
   end function is_moderate

   pure logical function are_moderate(n, numbers)
      integer, intent(in) :: n
      real(wp), intent(in) :: numbers(n)

      are_moderate = all(ieee_is_finite(numbers))      ! first: a comparison with a NaN is a trap of debug builds
      if (are_moderate) are_moderate = all(abs(numbers) < moderate)
   end function are_moderate

   !> Adds W Wᵀ to the lower triangle of a matrix. The upper triangle is not used.
   pure subroutine add_stiffness(problem, matrix)
      type(preload_problem_t), intent(in) :: problem
      real(wp), intent(inout) :: matrix(:, :)
      real(wp) :: column(12)
      integer :: b, c, l, i, j, first

      do b = 1, problem%nx/6
         i = problem%at(1, b)
         j = problem%at(2, b)
         do l = 1, 12
            if (merge(i, j, l <= 6) < 0) cycle
            column = 0.0_wp
            do c = 6*b - 5, 6*b
               column = column + problem%weighted(l, c)*problem%weighted(:, c)
            end do
            first = merge(i + l, j + l - 6, l <= 6)
            if (i >= 0 .and. (l <= 6 .or. i > j)) matrix(i + 1:i + 6, first) = matrix(i + 1:i + 6, first) + column(1:6)
            if (j >= 0 .and. (l > 6 .or. j > i)) matrix(j + 1:j + 6, first) = matrix(j + 1:j + 6, first) + column(7:12)
         end do
      end do
   end subroutine add_stiffness

   !> Adds the columns of F that may carry a force.
   pure subroutine add_columns(problem, matrix)
      type(preload_problem_t), intent(in) :: problem
      real(wp), intent(inout) :: matrix(:, :)
      integer :: p

      do p = 1, problem%pieces
         call add_gradient(1.0_wp, problem%piece(:, p), problem%piece_at(1, p), problem%piece_at(2, p), &
            matrix(:, problem%piece_of(p)))
      end do
   end subroutine add_columns

   !> Computes x = Wᵀ v.
   pure subroutine bushing_forces(problem, v, x)
      type(preload_problem_t), intent(in) :: problem
      real(wp), intent(in) :: v(:)
      real(wp), intent(out) :: x(:)
      integer :: b, k, at

      x = 0.0_wp
      do b = 1, problem%nx/6
         do k = 6*b - 5, 6*b
            at = problem%at(1, b)
            if (at >= 0) x(k) = dot_product(problem%weighted(1:6, k), v(at + 1:at + 6))
            at = problem%at(2, b)
            if (at >= 0) x(k) = x(k) + dot_product(problem%weighted(7:12, k), v(at + 1:at + 6))
         end do
      end do
   end subroutine bushing_forces

   !> Computes c ← c − W x.
   pure subroutine subtract_bushings(problem, x, c)
      type(preload_problem_t), intent(in) :: problem
      real(wp), intent(in) :: x(:)
      real(wp), intent(inout) :: c(:)
      integer :: b, k

      do b = 1, problem%nx/6
         do k = 6*b - 5, 6*b
            call add_gradient(-x(k), problem%weighted(:, k), problem%at(1, b), problem%at(2, b), c)
         end do
      end do
   end subroutine subtract_bushings

   !> Computes c ← c − F y, with y of the columns in `used`.
   pure subroutine subtract_free(problem, y, c)
      type(preload_problem_t), intent(in) :: problem
      real(wp), intent(in) :: y(:)
      real(wp), intent(inout) :: c(:)
      integer :: p

      do p = 1, problem%pieces
         call add_gradient(-y(problem%piece_of(p)), problem%piece(:, p), problem%piece_at(1, p), problem%piece_at(2, p), c)
      end do
   end subroutine subtract_free

   !> Solves by singular values. Of all x with the smallest remainder, the smallest x is found, and then the smallest y for this x.
   pure subroutine hold_by_singular_values(problem, x, y, remainder, is_found)
      type(preload_problem_t), intent(in) :: problem
      real(wp), intent(out) :: x(:), y(:)             !! as in hold_by_elimination
      real(wp), intent(out) :: remainder              !! |b − W x − F y|
      logical, intent(out) :: is_found                !! .false.: a number is not finite
      type(singular_values_t) :: carried, held
      real(wp), allocatable :: weighted(:, :), free(:, :), uncarried(:, :)
      real(wp) :: c(problem%nq), part(size(problem%used))
      integer :: k

      x = 0.0_wp
      y = 0.0_wp
      remainder = huge(remainder)
      allocate (weighted(problem%nq, problem%nx), free(problem%nq, size(problem%used)), source=0.0_wp)
      do k = 1, problem%nx
         call add_gradient(1.0_wp, problem%weighted(:, k), problem%at(1, (k + 5)/6), problem%at(2, (k + 5)/6), weighted(:, k))
      end do
      call add_columns(problem, free)
      ! the part that springs and joints can carry without cost is projected out; the bushings carry the rest. If springs and
      ! joints can carry everything, only rounding is left of `weighted`, which is not a stiffness.
      call decompose(free, rank_share, carried)
      allocate (uncarried, source=transpose(carried%left(:, carried%rank + 1:)))
      call decompose(matmul(uncarried, weighted), rank_share, held, whole=norm2(weighted))
      is_found = carried%is_found .and. held%is_found .and. all(ieee_is_finite(problem%load))
      if (.not. is_found) return
      call min_norm(held, matmul(uncarried, problem%load), x)
      c = problem%load - matmul(weighted, x)
      call min_norm(carried, c, part)
      y(problem%used) = part
      remainder = norm2(c - matmul(free, part))
   end subroutine hold_by_singular_values

end module ek_preload_solution
