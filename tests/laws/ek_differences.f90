!> Gradient and Hessian by central differences, in the coordinates of ek_measure:
!> z = [Δr_i Δπ_i Δr_j Δπ_j], r ← r + Δr, A ← exp(Δπ̃) A.
!>
!> Fourth order, f' ≈ [f(−2h) − 8 f(−h) + 8 f(h) − f(2h)]/12h: with h about 1e-3 both the remainder and
!> the rounding are near 1e-12 of a gradient, with 5e-3 near 1e-10 of a Hessian.
module ek_differences
   use ek_kinds, only: wp
   use ek_relative_rotation, only: pose_t
   use ek_measure, only: measure_t, evaluation_t, evaluate
   use ek_rotation, only: rotate_quaternion, rotation_matrix
   implicit none(type, external)
   private
   public :: pair_function_t, difference_gradient, difference_hessian, measure_gradient, moved_pose, rigidly_moved, &
      symmetric_of_lower, symmetric_of_blocks, blocks_at

   integer, parameter :: place(4) = [-2, -1, 1, 2]
   real(wp), parameter :: weight(4) = [1.0_wp, -8.0_wp, 8.0_wp, -1.0_wp]/12.0_wp

   !> A scalar function of the poses of two bodies.
   type, abstract :: pair_function_t
   contains
      procedure(value_of_pair), deferred :: value
   end type pair_function_t

   abstract interface
      real(wp) function value_of_pair(self, pose_i, pose_j)
         import :: pair_function_t, pose_t, wp
         implicit none(type, external)
         class(pair_function_t), intent(in) :: self
         type(pose_t), intent(in) :: pose_i, pose_j
      end function value_of_pair
   end interface

contains

   !> The gradient of a measure, d(value)/d[Δr_i Δπ_i Δr_j Δπ_j].
   pure function measure_gradient(measure, pose_i, pose_j) result(gradient)
      type(measure_t), intent(in) :: measure
      type(pose_t), intent(in) :: pose_i, pose_j
      real(wp) :: gradient(12)
      type(evaluation_t) :: evaluation
      call evaluate(measure, pose_i, pose_j, evaluation)
      gradient = evaluation%gradient
   end function measure_gradient

   !> r + Δr, exp(Δπ̃) A
   pure function moved_pose(pose, step) result(moved)
      type(pose_t), intent(in) :: pose
      real(wp), intent(in) :: step(6)     !! [Δr Δπ]
      type(pose_t) :: moved
      moved%r = pose%r + step(1:3)
      moved%q = rotate_quaternion(step(4:6), pose%q)
      moved%a = rotation_matrix(moved%q)
   end function moved_pose

   !> The pose after the whole space was turned by the rotation vector about the global origin, then shifted.
   pure function rigidly_moved(pose, turn, shift) result(moved)
      type(pose_t), intent(in) :: pose
      real(wp), intent(in) :: turn(3), shift(3)
      type(pose_t) :: moved
      real(wp) :: r(3)
      r = pose%r
      moved = moved_pose(pose, [0.0_wp, 0.0_wp, 0.0_wp, turn])
      moved%r = matmul(rotation_matrix(rotate_quaternion(turn, [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])), r) + shift
   end function rigidly_moved

   real(wp) function value_at(f, pose_i, pose_j, z) result(value)
      class(pair_function_t), intent(in) :: f
      type(pose_t), intent(in) :: pose_i, pose_j
      real(wp), intent(in) :: z(12)
      value = f%value(moved_pose(pose_i, z(1:6)), moved_pose(pose_j, z(7:12)))
   end function value_at

   function difference_gradient(f, pose_i, pose_j, h) result(gradient)
      class(pair_function_t), intent(in) :: f
      type(pose_t), intent(in) :: pose_i, pose_j
      real(wp), intent(in) :: h           !! step [m, rad]
      real(wp) :: gradient(12), z(12)
      integer :: k, p

      gradient = 0.0_wp
      do k = 1, 12
         do p = 1, 4
            z = 0.0_wp
            z(k) = place(p)*h
            gradient(k) = gradient(k) + weight(p)*value_at(f, pose_i, pose_j, z)/h
         end do
      end do
   end function difference_gradient

   !> Second differences of the value, both steps taken at once: symmetric by construction.
   function difference_hessian(f, pose_i, pose_j, h) result(hessian)
      class(pair_function_t), intent(in) :: f
      type(pose_t), intent(in) :: pose_i, pose_j
      real(wp), intent(in) :: h           !! step [m, rad]
      real(wp) :: hessian(12, 12), z(12)
      integer :: k, l, p, q

      hessian = 0.0_wp
      do k = 1, 12
         do l = 1, k
            do p = 1, 4
               do q = 1, 4
                  z = 0.0_wp
                  z(k) = place(p)*h
                  z(l) = z(l) + place(q)*h
                  hessian(k, l) = hessian(k, l) + weight(p)*weight(q)*value_at(f, pose_i, pose_j, z)/h**2
               end do
            end do
            hessian(l, k) = hessian(k, l)
         end do
      end do
   end function difference_hessian

   !> The whole matrix of two bodies from its blocks: those of the bodies, and their coupling.
   pure function symmetric_of_blocks(blocks) result(whole)
      real(wp), intent(in) :: blocks(6, 6, 3)
      real(wp) :: whole(12, 12)
      whole = 0.0_wp
      whole(1:6, 1:6) = blocks(:, :, 1)
      whole(7:12, 7:12) = blocks(:, :, 2)
      whole(7:12, 1:6) = blocks(:, :, 3)
      whole = symmetric_of_lower(whole)
   end function symmetric_of_blocks

   !> The blocks of two bodies, of which one has the unknowns 1 to 6 (at = 0) and the other 7 to 12 (at = 6), see ek_block; at < 0: the
   !> chassis.
   pure function blocks_at(at_i, at_j) result(at)
      integer, intent(in) :: at_i, at_j
      integer :: at(3)
      at = [max(at_i/6 + 1, 0), max(at_j/6 + 1, 0), 0]
      if (at(1) > 0 .and. at(2) > 0) at(3) = merge(3, -3, at_j > at_i)
   end function blocks_at

   !> The whole of a symmetric matrix of which the lower triangle is kept.
   pure function symmetric_of_lower(lower) result(whole)
      real(wp), intent(in) :: lower(:, :)
      real(wp) :: whole(size(lower, 1), size(lower, 2))
      integer :: k
      whole = lower
      do k = 1, size(lower, 1)
         whole(k, k + 1:) = lower(k + 1:, k)
      end do
   end function symmetric_of_lower

end module ek_differences
