!> The lowest point of a wheel: a disc, or a torus with a crown.
!>
!> The core circle of a tyre has the radius R and the axis w. Its lowest point lies at R e from the wheel centre, with e the unit
!> vector in the plane of the wheel that points down, as steeply as the plane permits. The tyre touches a level road below this
!> point by the radius of its crown (0: a disc).
!>
!>     V = R w,  K = n·V,  σ = √(V·V − K²)         R e = (K V − (V·V) n)/σ         n: up, the normal of the road
!>
!> With the position u·(R e) along a constant direction u as a function f(K, m, Q), where m = u·V, ν = u·n and Q = V·V:
!>
!>     f = (K m − Q ν)/σ,   f_K = Q (m − ν K)/σ³,   f_m = K/σ,   f_Km = Q/σ³
!>     f_KK = Q (3 K (m − ν K)/σ² − ν)/σ³
!>
!> Degenerate only for a wheel that lies flat (σ = 0).
!> Equation (M.20) of docs/theory/measures.md.
module ek_lowest_point
   use ek_kinds, only: wp
   use ek_number, only: num
   use ek_block, only: add_s_block
   use ek_rotation, only: cross
   implicit none(type, external)
   private
   public :: lowest_point, lowest_gradient, add_lowest_hessian, turn_rim, add_patch_tangent, patch_moment

contains

   !> The vector R e from the wheel centre to the lowest point of the core circle [m].
   !> Equation (M.20) of docs/theory/measures.md.
   pure function lowest_point(rim) result(arm)
      real(num), intent(in) :: rim(3)        !! R w, global axes [m]
      real(num) :: arm(3), square, depth

      square = dot_product(rim, rim)
      depth = sqrt(square - rim(3)**2)
      arm = (rim(3)/depth)*rim
      arm(3) = arm(3) - square/depth
   end function lowest_point

   !> The gradient of u·(R e) with respect to a rotation of the wheel about global axes: V × (f_K n + f_m u).
   !> Equation (M.21) of docs/theory/measures.md.
   pure function lowest_gradient(u, rim) result(gradient)
      real(num), intent(in) :: u(3)          !! constant direction, global axes
      real(num), intent(in) :: rim(3)        !! R w, global axes [m]
      real(num) :: gradient(3), along(3), square, depth

      square = dot_product(rim, rim)
      depth = sqrt(square - rim(3)**2)
      along = (rim(3)/depth)*u
      along(3) = along(3) + square*(dot_product(u, rim) - u(3)*rim(3))/depth**3
      gradient = cross(rim, along)
   end function lowest_gradient

   !> Adds the Hessian of u·(R e) to the diagonal block of rotations of a body.
   !> Equation (M.21) of docs/theory/measures.md.
   pure subroutine add_lowest_hessian(u, rim, body, blocks)
      real(num), intent(in) :: u(3)          !! constant direction times its weight, global axes
      real(num), intent(in) :: rim(3)        !! R w, global axes [m]
      integer, intent(in) :: body            !! 0: no action
      real(num), intent(inout) :: blocks(6, 6, *)
      real(num) :: along(3), g(3), h(3), square, depth, side, kk, km
      integer :: i, j

      if (body <= 0) return
      square = dot_product(rim, rim)
      depth = sqrt(square - rim(3)**2)
      side = dot_product(u, rim) - u(3)*rim(3)
      km = square/depth**3
      kk = km*(3.0_wp*rim(3)*side/depth**2 - u(3))
      along = (rim(3)/depth)*u
      along(3) = along(3) + km*side
      call add_s_block(rim, along, body, blocks)
      g = up_from(rim)
      h = cross(rim, u)
      do j = 1, 3
         do i = 1, 3
            blocks(3 + i, 3 + j, body) = blocks(3 + i, 3 + j, body) + ((kk*g(i))*g(j) + km*(g(i)*h(j) + h(i)*g(j)))
         end do
      end do
   end subroutine add_lowest_hessian

   !> The gradient of K: V × n.
   pure function up_from(rim) result(g)
      real(num), intent(in) :: rim(3)
      real(num) :: g(3)

      g(1) = rim(2)
      g(2) = -rim(1)
      g(3) = 0.0_wp
   end function up_from

   !> Computes the derivatives of u·(R e) and of its gradient with respect to a change of V = R w that is not a rotation of the
   !> body: another radius, another axis of the wheel.
   !> Equation (M.22) of docs/theory/measures.md.
   pure subroutine turn_rim(u, rim, change, value, gradient)
      real(num), intent(in) :: u(3)          !! constant direction, global axes
      real(num), intent(in) :: rim(3)        !! R w, global axes [m]
      real(num), intent(in) :: change(3)     !! δV
      real(num), intent(out) :: value        !! δ(u·(R e))
      real(num), intent(out) :: gradient(3)  !! δ of lowest_gradient
      real(num) :: along(3), square, depth, side, k, m, q, by_k, by_m, by_q, slope

      square = dot_product(rim, rim)
      depth = sqrt(square - rim(3)**2)
      side = dot_product(u, rim) - u(3)*rim(3)
      k = change(3)
      m = dot_product(u, change)
      q = 2.0_wp*dot_product(rim, change)
      by_k = square*side/depth**3
      by_m = rim(3)/depth
      by_q = -u(3)/depth - 0.5_wp*(rim(3)*dot_product(u, rim) - square*u(3))/depth**3
      value = by_k*k + by_m*m + by_q*q
      along = by_m*u
      along(3) = along(3) + by_k
      gradient = cross(change, along)
      ! changes of f_m and f_K
      slope = square*k/depth**3 - 0.5_wp*rim(3)*q/depth**3
      along = slope*u
      slope = square*(3.0_wp*rim(3)*side/depth**2 - u(3))/depth**3*k + square*m/depth**3 + &
         (side/depth**3 - 1.5_wp*square*side/depth**5)*q
      along(3) = along(3) + slope
      gradient = gradient + cross(rim, along)
   end subroutine turn_rim

   !> Adds the stiffness of a force of constant direction at the lowest point, as far as this point moves in the wheel: the
   !> symmetric part of −∂(R e × F)/∂π.
   !> Equation (M.23) of docs/theory/measures.md.
   pure subroutine add_patch_tangent(force, rim, body, blocks)
      real(num), intent(in) :: force(3)      !! N
      real(num), intent(in) :: rim(3)        !! R w, global axes [m]
      integer, intent(in) :: body
      real(num), intent(inout) :: blocks(6, 6, *)
      real(num) :: along(3), g(3), p(3), square, depth
      integer :: i, j

      square = dot_product(rim, rim)
      depth = sqrt(square - rim(3)**2)
      along = (-rim(3)/depth)*rim
      call add_s_block(along, force, body, blocks)
      g = up_from(rim)
      p = cross(force, drift(rim))
      do j = 1, 3
         do i = 1, 3
            blocks(3 + i, 3 + j, body) = blocks(3 + i, 3 + j, body) + 0.5_wp*(p(i)*g(j) + g(i)*p(j))
         end do
      end do
   end subroutine add_patch_tangent

   !> The derivative of R e with respect to K, with V constant: (Q/σ³)(V − K n).
   pure function drift(rim) result(q)
      real(num), intent(in) :: rim(3)
      real(num) :: q(3), square, depth

      square = dot_product(rim, rim)
      depth = sqrt(square - rim(3)**2)
      q = (square/depth**3)*rim
      q(3) = 0.0_wp
   end function drift

   !> The moment m of the skew part N_ππ = ½ m̃ of such a force: (σ⁻¹ Q + r_t) n×F − q (g·F).
   !> Equation (M.23) of docs/theory/measures.md.
   pure function patch_moment(force, rim, crown) result(moment)
      real(num), intent(in) :: force(3)      !! N
      real(num), intent(in) :: rim(3)        !! R w, global axes [m]
      real(num), intent(in) :: crown         !! radius of the crown [m]
      real(num) :: moment(3), square, depth, reach

      square = dot_product(rim, rim)
      depth = sqrt(square - rim(3)**2)
      reach = square/depth + crown
      moment = (-dot_product(up_from(rim), force))*drift(rim)
      moment(1) = moment(1) - reach*force(2)
      moment(2) = moment(2) + reach*force(1)
   end function patch_moment

end module ek_lowest_point
