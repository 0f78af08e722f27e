!> Poses of bodies, and the relative rotation of two of them with its derivatives.
!>
!> θ = log(A_iᵀ A_j) in the axes of body i. With (q0, qv) the unit quaternion of A_iᵀ A_j: p = 2 qv, t = pᵀp, θ = α(t) p,
!> α(t) = asin(√t/2)/(√t/2). δ = A_iᵀ(π_j − π_i − ½ π_i×π_j) is the change of the relative rotation.
!> Equation (R.11) of docs/theory/rotations.md.
module ek_relative_rotation
   use ek_kinds, only: wp
   use ek_number, only: num, mask, zero, one, some
   use ek_rotation, only: cross, identity3
   use ek_block, only: add_block, rotated, in_world, pi_i, pi_j
   implicit none(type, external)
   private
   public :: pose_t, relative_rotation_t, relative_rotation, rotation_gradient, rotation_jacobian, add_rotation_hessian

   !> The pose of a body. Stored contiguously (128 bytes), because every measure reads the complete pose.
   type :: pose_t
      real(num) :: r(3) = zero                          !! reference point, global [m]
      real(num) :: q(4) = [one, zero, zero, zero]  !! unit quaternion of a
      real(num) :: a(3, 3) = identity3                    !! body axes → global axes
   end type pose_t

   !> The relative rotation of two bodies: θ = α(t) p, p = 2 qv, t = pᵀp, in the axes of body i.
   type :: relative_rotation_t
      real(num) :: q0 = one, qv(3) = zero   !! quaternion of A_iᵀ A_j, q0 ≥ 0
      real(num) :: p(3) = zero
      real(num) :: alpha = one, alpha1 = zero, alpha2 = zero   !! α, dα/dt, d²α/dt²
      real(num) :: theta(3) = zero             !! rotation vector [rad]
   end type relative_rotation_t

contains

   !> Computes the rotation of body j relative to body i.
   !> Equation (R.10) of docs/theory/rotations.md.
   pure subroutine relative_rotation(pose_i, pose_j, turn)
      type(pose_t), intent(in) :: pose_i, pose_j
      type(relative_rotation_t), intent(out) :: turn
      real(num) :: i0, iv(3), j0, jv(3), qv(3), p(3), s, q0, alpha, alpha1, alpha2
      logical(mask) :: is_far, is_small

      i0 = pose_i%q(1); iv = pose_i%q(2:4)
      j0 = pose_j%q(1); jv = pose_j%q(2:4)
      q0 = i0*j0 + dot_product(iv, jv)
      qv = i0*jv - j0*iv - cross(iv, jv)
      is_far = q0 < 0.0_wp                 ! q and −q are the same rotation
      if (some(is_far)) then
         q0 = merge(-q0, q0, is_far)
         qv = merge(-qv, qv, is_far)
      end if
      p = 2.0_wp*qv
      s = dot_product(qv, qv)
      turn%q0 = q0
      turn%qv = qv
      turn%p = p
      is_small = s < 1.0e-3_wp
      if (some(is_small)) then
         ! asin(x)/x and its derivatives in t = 4 x²; s = x². Neglected terms are below 1e-17 of α
         turn%alpha = 1.0_wp + s*(1.0_wp/6 + s*(3.0_wp/40 + s*(5.0_wp/112 + s*(35.0_wp/1152 + s*63.0_wp/2816.0_wp))))
         turn%alpha1 = 0.25_wp*(1.0_wp/6 + s*(3.0_wp/20 + s*(15.0_wp/112 + s*(35.0_wp/288 + s*(315.0_wp/2816 &
            + s*231.0_wp*6.0_wp/13312.0_wp)))))
         turn%alpha2 = 0.0625_wp*(3.0_wp/20 + s*(15.0_wp/56 + s*(35.0_wp/96 + s*(315.0_wp/704 &
            + s*231.0_wp*30.0_wp/13312.0_wp))))
      end if
      if (some(.not. is_small)) then
         s = sqrt(merge(one, s, is_small))
         alpha = atan2(s, q0)/s
         ! q0 = cos(half angle): zero only at a relative rotation of exactly 180 deg, where θ itself jumps
         alpha1 = (1.0_wp/q0 - alpha)/(8.0_wp*s*s)
         alpha2 = (0.125_wp/q0**3 - 3.0_wp*alpha1)/(8.0_wp*s*s)
         turn%alpha = merge(turn%alpha, alpha, is_small)
         turn%alpha1 = merge(turn%alpha1, alpha1, is_small)
         turn%alpha2 = merge(turn%alpha2, alpha2, is_small)
      end if
      turn%theta = turn%alpha*p
   end subroutine relative_rotation

   !> The gradient g = Pᵀ w of m·θ with respect to δ, with P = q0 I − q̃v and w = (αI + 2α' p pᵀ) m.
   !> Equation (M.10) of docs/theory/measures.md.
   pure function rotation_gradient(turn, m) result(g)
      type(relative_rotation_t), intent(in) :: turn
      real(num), intent(in) :: m(3)
      real(num) :: g(3), w(3)
      w = turn%alpha*m + (2.0_wp*turn%alpha1*dot_product(turn%p, m))*turn%p
      g = turn%q0*w + cross(turn%qv, w)
   end function rotation_gradient

   !> The Jacobian G = ∂θ/∂δ = (αI + 2α' p pᵀ)(q0 I − q̃v), where δ = A_iᵀ(π_j − π_i) to first order.
   !> Equation (M.11) of docs/theory/measures.md.
   !> Equation (R.9) of docs/theory/rotations.md.
   pure function rotation_jacobian(turn) result(jacobian)
      type(relative_rotation_t), intent(in) :: turn
      real(num) :: jacobian(3, 3), w(3)
      integer :: k

      do k = 1, 3
         w = (2.0_wp*turn%alpha1*turn%p(k))*turn%p
         w(k) = w(k) + turn%alpha
         jacobian(k, :) = turn%q0*w + cross(turn%qv, w)
      end do
   end function rotation_jacobian

   !> Adds two terms to the rotation blocks of i and j: the Hessian of m·θ, and `inner`, a symmetric 3×3 stiffness in δ (body-i
   !> axes).
   !>
   !> With P = q0 I − q̃v, w = αm + 2α'(m·p)p and g = Pᵀw, the Hessian in δ is
   !> Pᵀ[2α'(m pᵀ + p mᵀ) + 2α'(m·p)I + 4α''(m·p) p pᵀ]P − ½(w·qv) I.
   !> The second-order part of δ = A_iᵀ(π_j − π_i − ½ π_i×π_j) adds ½ [A_i g]~ to the block π_iπ_j.
   !> Equations (M.8), (M.9), (M.10), (M.12) of docs/theory/measures.md.
   !> Equation (R.11) of docs/theory/rotations.md.
   pure subroutine add_rotation_hessian(turn, m, inner, a_i, at, blocks)
      type(relative_rotation_t), intent(in) :: turn
      real(num), intent(in) :: m(3)           !! body-i axes
      real(num), intent(in) :: inner(3, 3)
      real(num), intent(in) :: a_i(3, 3)      !! rotation of body i
      integer, intent(in) :: at(3)
      real(num), intent(inout) :: blocks(6, 6, *)
      real(num) :: h(3, 3), w(3), mp, c1, c2, core(3, 3), left(3, 3), g(3), b(3, 3), row(3), half_wq
      integer :: k

      mp = dot_product(m, turn%p)
      c1 = 2.0_wp*turn%alpha1
      c2 = 4.0_wp*turn%alpha2*mp
      do k = 1, 3
         core(:, k) = c1*(m*turn%p(k) + turn%p*m(k)) + (c2*turn%p(k))*turn%p
         core(k, k) = core(k, k) + c1*mp
      end do
      do k = 1, 3   ! left = Pᵀ core, Pᵀ x = q0 x + qv × x
         left(:, k) = turn%q0*core(:, k) + cross(turn%qv, core(:, k))
      end do
      do k = 1, 3   ! h = left P, row by row: (Pᵀ leftᵀ)ᵀ
         row = left(k, :)
         h(k, :) = turn%q0*row + cross(turn%qv, row)
      end do
      w = turn%alpha*m + (c1*mp)*turn%p
      half_wq = 0.5_wp*dot_product(w, turn%qv)
      h = h + inner
      do k = 1, 3
         h(k, k) = h(k, k) - half_wq
      end do
      b = in_world(a_i, h, at(1))
      call add_block(b, pi_i, pi_i, at, blocks)
      call add_block(b, pi_j, pi_j, at, blocks)
      if (at(3) == 0) return
      g = turn%q0*w + cross(turn%qv, w)
      g = 0.5_wp*rotated(a_i, g)
      b = -b
      b(2, 1) = b(2, 1) + g(3); b(3, 1) = b(3, 1) - g(2)
      b(1, 2) = b(1, 2) - g(3); b(3, 2) = b(3, 2) + g(1)
      b(1, 3) = b(1, 3) + g(2); b(2, 3) = b(2, 3) - g(1)
      call add_block(b, pi_i, pi_j, at, blocks)
   end subroutine add_rotation_hessian

end module ek_relative_rotation
