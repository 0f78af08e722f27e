!> Bushings: six components with an energy, so that all forces balance.
!>
!>     V = ½ dᵀK_t d + ½ θᵀK_r θ − f0·d − m0·θ
!>
!> d is the gap from marker I to marker J and θ the relative rotation vector, both in the axes of marker I (fixed in body i).
!> A component may have a curve c instead of a rate; ∫c then takes the place of ½ k d².
!>
!> "Pull" below means the generalised force dV/dz, the gradient of the energy; the force ON the bodies is −dV/dz.
module ek_elastic
   use ek_kinds, only: wp
   use ek_law, only: law_t, look_up_law
   use ek_turn, only: pose_t, turn_t, relative_turn, turn_gradient, turn_jacobian, add_turn_hessian
   use ek_block, only: add_gap_hessian, add_link_stiffness, add_diagonal_block, add_block, rotated
   use ek_rotation, only: cross, identity3
   implicit none(type, external)
   private
   public :: bushing_t, bushing_view_t, set_bushing_axes
   public :: look_bushing, bushing_pull, add_bushing_tangent, add_bushing_material, bushing_load, design_rates

   !> A six-axis bushing from marker I on body i to marker J on body j. The markers are parallel
   !> at design. If two points are given they may be apart; the design gap causes no force.
   type :: bushing_t
      character(:), allocatable :: name, where
      integer :: body_i = 0, body_j = 0
      real(wp) :: arm_i(3) = 0.0_wp, arm_j(3) = 0.0_wp   !! markers from the reference points [m]
      real(wp) :: axes(3, 3) = identity3     !! columns: marker axes x, y, z at design, global
      real(wp) :: kt(3) = 0.0_wp             !! N/m along the marker axes
      real(wp) :: kr(3) = 0.0_wp             !! N m/rad about the marker axes
      real(wp) :: preload_force(3) = 0.0_wp  !! on body j at design, marker axes [N]
      real(wp) :: preload_moment(3) = 0.0_wp !! on body j at design, marker axes [N m]
      ! set by set_bushing_axes: the same law in the axes of body i
      real(wp) :: stiffness_t(3, 3) = 0.0_wp, stiffness_r(3, 3) = 0.0_wp
      real(wp) :: force0(3) = 0.0_wp, moment0(3) = 0.0_wp
      real(wp) :: gap0(3) = 0.0_wp           !! design gap, axes of body i [m]
      ! curves instead of rates, in the order: along x, y, z, about x, y, z of the marker
      logical :: has_curves = .false.
      type(law_t), allocatable :: laws(:)    !! six if has_curves; a component without a curve keeps its rate
   end type bushing_t

   !> A bushing at one pair of poses.
   type :: bushing_view_t
      real(wp) :: a(3) = 0.0_wp, b(3) = 0.0_wp, d(3) = 0.0_wp   !! arms and gap, global [m]
      real(wp) :: frame(3, 3) = identity3                      !! A_i
      real(wp) :: gap(3) = 0.0_wp        !! gap minus design gap, axes of body i [m]
      real(wp) :: force(3) = 0.0_wp      !! dV/dd, global [N]
      real(wp) :: moment(3) = 0.0_wp     !! dV/dθ, axes of body i [N m]
      type(turn_t) :: turn
      ! only with curves: the slopes at this deflection, in the axes of body i
      real(wp) :: stiffness_t(3, 3) = 0.0_wp, stiffness_r(3, 3) = 0.0_wp
   end type bushing_view_t

contains

   !> Transforms rates and preloads from marker axes to the axes of body i (A_i = I at design):
   !> K = E diag(k) Eᵀ. Call it after any change of axes, rates or preload.
   !> Equation (M.15) of docs/theory/measures.md.
   pure subroutine set_bushing_axes(bushing)
      type(bushing_t), intent(inout) :: bushing

      bushing%stiffness_t = in_body(bushing%axes, bushing%kt)
      bushing%stiffness_r = in_body(bushing%axes, bushing%kr)
      bushing%force0 = rotated(bushing%axes, bushing%preload_force)
      bushing%moment0 = rotated(bushing%axes, bushing%preload_moment)
   end subroutine set_bushing_axes

   !> E diag(k) Eᵀ
   pure function in_body(axes, k) result(matrix)
      real(wp), intent(in) :: axes(3, 3), k(3)
      real(wp) :: matrix(3, 3)
      integer :: i, j

      do j = 1, 3
         do i = 1, 3
            matrix(i, j) = sum(axes(i, :)*k*axes(j, :))
         end do
      end do
   end function in_body

   !> Gap, rotation, and the force and moment of the law.
   !> Equation (M.15) of docs/theory/measures.md.
   pure subroutine look_bushing(bushing, pose_i, pose_j, view)
      type(bushing_t), intent(in) :: bushing
      type(pose_t), intent(in) :: pose_i, pose_j
      type(bushing_view_t), intent(inout) :: view
      real(wp) :: a(3), b(3), d(3), force(3)

      a = rotated(pose_i%a, bushing%arm_i)
      b = rotated(pose_j%a, bushing%arm_j)
      d = (pose_j%r - pose_i%r) + (b - a)
      view%frame = pose_i%a
      view%a = a
      view%b = b
      view%d = d
      view%gap(1) = dot_product(pose_i%a(:, 1), d) - bushing%gap0(1)
      view%gap(2) = dot_product(pose_i%a(:, 2), d) - bushing%gap0(2)
      view%gap(3) = dot_product(pose_i%a(:, 3), d) - bushing%gap0(3)
      call relative_turn(pose_i, pose_j, view%turn)
      if (bushing%has_curves) then
         call look_curves(bushing, view)
         return
      end if
      force = rotated(bushing%stiffness_t, view%gap) - bushing%force0
      view%force = rotated(pose_i%a, force)
      view%moment = rotated(bushing%stiffness_r, view%turn%theta) - bushing%moment0
   end subroutine look_bushing

   !> Force, moment and slopes of a bushing with curves, evaluated per component in marker axes.
   pure subroutine look_curves(bushing, view)
      type(bushing_t), intent(in) :: bushing
      type(bushing_view_t), intent(inout) :: view
      real(wp) :: force(3), moment(3), slope_t(3), slope_r(3)

      call look_components(bushing, view, force, moment, slope_t, slope_r)
      view%force = rotated(view%frame, rotated(bushing%axes, force))
      view%moment = rotated(bushing%axes, moment)
      view%stiffness_t = in_body(bushing%axes, slope_t)
      view%stiffness_r = in_body(bushing%axes, slope_r)
   end subroutine look_curves

   !> dV/d(component) in marker axes, minus the preload; and the slopes.
   pure subroutine look_components(bushing, view, force, moment, slope_t, slope_r)
      type(bushing_t), intent(in) :: bushing
      type(bushing_view_t), intent(in) :: view
      real(wp), intent(out) :: force(3), moment(3), slope_t(3), slope_r(3)   !! N, N m, N/m, N m/rad
      real(wp) :: deflection
      integer :: k

      slope_t = bushing%kt
      slope_r = bushing%kr
      do k = 1, 3
         deflection = dot_product(bushing%axes(:, k), view%gap)
         force(k) = slope_t(k)*deflection
         if (bushing%laws(k)%has_curve) call look_up_law(bushing%laws(k), deflection, force(k), slope_t(k))
         deflection = dot_product(bushing%axes(:, k), view%turn%theta)
         moment(k) = slope_r(k)*deflection
         if (bushing%laws(k + 3)%has_curve) call look_up_law(bushing%laws(k + 3), deflection, moment(k), slope_r(k))
      end do
      force = force - bushing%preload_force
      moment = moment - bushing%preload_moment
   end subroutine look_components

   !> Force and moment of the bushing law on body j, marker axes: preload minus restoring force of rates or curves [N, N m].
   !> The force is the force on body j. The moment is conjugate to θ (−dV/dθ); the moment on body j is ∂θ/∂δᵀ times it, as in
   !> bushing_pull.
   pure subroutine bushing_load(bushing, view, force, moment)
      type(bushing_t), intent(in) :: bushing
      type(bushing_view_t), intent(in) :: view      !! of look_bushing
      real(wp), intent(out) :: force(3), moment(3)
      real(wp) :: slope(3), slope_r(3)
      integer :: k

      if (bushing%has_curves) then
         call look_components(bushing, view, force, moment, slope, slope_r)
         force = -force
         moment = -moment
         return
      end if
      do k = 1, 3
         force(k) = bushing%preload_force(k) - bushing%kt(k)*dot_product(bushing%axes(:, k), view%gap)
         moment(k) = bushing%preload_moment(k) - bushing%kr(k)*dot_product(bushing%axes(:, k), view%turn%theta)
      end do
   end subroutine bushing_load

   !> The six rates at design, marker axes; for curves, their slopes [N/m, N m/rad].
   pure function design_rates(bushing) result(rates)
      type(bushing_t), intent(in) :: bushing
      real(wp) :: rates(6), force
      integer :: k

      rates(1:3) = bushing%kt
      rates(4:6) = bushing%kr
      if (.not. bushing%has_curves) return
      do k = 1, 6
         if (bushing%laws(k)%has_curve) call look_up_law(bushing%laws(k), 0.0_wp, force, rates(k))
      end do
   end function design_rates

   !> dV/dz = [−f, −(a+d)×f − w, f, b×f + w], w = A_i ∂θ/∂δᵀ m.
   !> Equation (M.16) of docs/theory/measures.md.
   pure function bushing_pull(view) result(pull)
      type(bushing_view_t), intent(in) :: view
      real(wp) :: pull(12), w(3), arm(3)

      w = rotated(view%frame, turn_gradient(view%turn, view%moment))
      pull(1:3) = -view%force
      arm = view%a + view%d
      pull(4:6) = -cross(arm, view%force) - w
      pull(7:9) = view%force
      pull(10:12) = cross(view%b, view%force) + w
   end function bushing_pull

   !> Adds the full tangent d²V/dz²: material, and force × Hessian of the gap and of θ.
   !> Equation (M.17) of docs/theory/measures.md.
   pure subroutine add_bushing_tangent(bushing, view, at_i, at_j, ld, matrix)
      type(bushing_t), intent(in) :: bushing
      type(bushing_view_t), intent(in) :: view
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)

      if (bushing%has_curves) then
         call add_tangent(view%stiffness_t, view%stiffness_r, view, at_i, at_j, ld, matrix)
      else
         call add_tangent(bushing%stiffness_t, bushing%stiffness_r, view, at_i, at_j, ld, matrix)
      end if
   end subroutine add_bushing_tangent

   !> The same, with stiffnesses in the axes of body i.
   pure subroutine add_tangent(stiffness_t, stiffness_r, view, at_i, at_j, ld, matrix)
      real(wp), intent(in) :: stiffness_t(3, 3), stiffness_r(3, 3)
      type(bushing_view_t), intent(in) :: view
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: g(3, 3), kg(3, 3), inner(3, 3), arm(3)
      integer :: k, l

      arm = view%a + view%d
      call add_link_stiffness(in_world(view%frame, stiffness_t, at_i), arm, view%b, at_i, at_j, ld, matrix)
      call add_gap_hessian(view%force, view%a, view%b, view%d, at_i, at_j, ld, matrix)
      g = turn_jacobian(view%turn)
      do k = 1, 3
         kg(:, k) = rotated(stiffness_r, g(:, k))
      end do
      do k = 1, 3
         do l = k, 3
            inner(l, k) = dot_product(g(:, l), kg(:, k))
            inner(k, l) = inner(l, k)
         end do
      end do
      call add_turn_hessian(view%turn, view%moment, inner, view%frame, at_i, at_j, ld, matrix)
   end subroutine add_tangent

   !> Adds −(19) of the paper: Bᵀ C B with rows [−u, −a×u, u, b×u] and [0, −u, 0, u], for u = each of the three
   !> marker axes. Forces do not enter, and the rotation of the marker frame itself (u×d) is neglected.
   !> Equation (M.18) of docs/theory/measures.md.
   pure subroutine add_bushing_material(bushing, view, at_i, at_j, ld, matrix)
      type(bushing_t), intent(in) :: bushing
      type(bushing_view_t), intent(in) :: view
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)

      if (bushing%has_curves) then
         call add_material(view%stiffness_t, view%stiffness_r, view, at_i, at_j, ld, matrix)
      else
         call add_material(bushing%stiffness_t, bushing%stiffness_r, view, at_i, at_j, ld, matrix)
      end if
   end subroutine add_bushing_material

   !> The same, with stiffnesses in the axes of body i.
   pure subroutine add_material(stiffness_t, stiffness_r, view, at_i, at_j, ld, matrix)
      real(wp), intent(in) :: stiffness_t(3, 3), stiffness_r(3, 3)
      type(bushing_view_t), intent(in) :: view
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: k(3, 3)

      call add_link_stiffness(in_world(view%frame, stiffness_t, at_i), view%a, view%b, at_i, at_j, ld, matrix)
      k = in_world(view%frame, stiffness_r, at_i)
      call add_diagonal_block(k, at_i + 3, at_i, ld, matrix)
      call add_diagonal_block(k, at_j + 3, at_j, ld, matrix)
      if (at_i < 0 .or. at_j < 0) return
      k = -k
      call add_block(k, at_i + 3, at_j + 3, ld, matrix)
   end subroutine add_material

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

end module ek_elastic
