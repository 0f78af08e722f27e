!> Bushings: six components with an energy, so that all forces balance.
!>
!>     V = ½ dᵀK_t d + ½ θᵀK_r θ − f0·d − m0·θ
!>
!> d is the displacement from marker I to marker J minus its value at design, and θ the relative rotation vector, both in axes fixed
!> in body i. A component may have a curve c instead of a rate; ∫c then replaces ½ k d².
!>
!> The generalised force is dV/dz, the gradient of the energy; the force ON the bodies is −dV/dz.
module ek_elastic
   use ek_number, only: num, zero
   use ek_law, only: law_t, look_up_law
   use ek_measure, only: measure_t
   use ek_relative_rotation, only: pose_t, relative_rotation_t, relative_rotation, rotation_gradient, rotation_jacobian, &
      add_rotation_hessian
   use ek_block, only: add_gap_hessian, add_link_stiffness, add_block, rotated, in_world, pi_i, pi_j
   use ek_rotation, only: cross, identity3
   implicit none(type, external)
   private
   public :: bushing_t, bushing_numbers_t, bushing_list_t, bushing_evaluation_t, set_bushing_axes
   public :: evaluate_bushing, bushing_force, add_bushing_tangent, add_bushing_material, deflect_bushing, bushing_load, design_rates

   !> The numbers of a bushing. The numbers that every evaluation reads come first.
   type :: bushing_numbers_t
      ! set by set_bushing_axes: the same law in the axes of body i
      real(num) :: stiffness_t(3, 3) = zero, stiffness_r(3, 3) = zero
      real(num) :: force0(3) = zero, moment0(3) = zero
      real(num) :: gap0(3) = zero           !! displacement from I to J at design, axes of body i [m]
      real(num) :: axes(3, 3) = identity3     !! columns: marker axes x, y, z at design, global
      real(num) :: kt(3) = zero             !! rates along the marker axes [N/m]
      real(num) :: kr(3) = zero             !! rates about the marker axes [N m/rad]
      real(num) :: preload_force(3) = zero  !! force on body j at design, marker axes [N]
      real(num) :: preload_moment(3) = zero !! moment on body j at design, marker axes [N m]
   end type bushing_numbers_t

   !> The numbers of a bushing as a list (see law_list_t).
   type :: bushing_list_t
      real(num) :: v(storage_size(bushing_numbers_t())/storage_size(zero)) = zero
   end type bushing_list_t

   !> The law of a six-axis bushing from marker I on body i to marker J on body j. The markers are parallel at design. They may be
   !> at two points; the displacement between them at design causes no force.
   type, extends(bushing_numbers_t) :: bushing_t
      logical :: has_curves = .false.
      ! curves instead of rates, in the order: along x, y, z, about x, y, z of the marker
      type(law_t), allocatable :: laws(:)    !! six laws if has_curves; a law is used only if it has a curve
   end type bushing_t

   !> A bushing evaluated at one pair of poses.
   type :: bushing_evaluation_t
      real(num) :: a(3) = zero, b(3) = zero, d(3) = zero   !! arms, displacement from I to J; global [m]
      real(num) :: frame(3, 3) = identity3                      !! A_i: body-i axes → global axes
      real(num) :: gap(3) = zero        !! displacement minus its value at design, axes of body i [m]
      real(num) :: force(3) = zero      !! dV/dd, global [N]
      real(num) :: moment(3) = zero     !! dV/dθ, axes of body i [N m]
      type(relative_rotation_t) :: rotation
      ! the rates, or the slopes of curves at this deflection, in the axes of body i
      real(num) :: stiffness_t(3, 3) = zero, stiffness_r(3, 3) = zero
   end type bushing_evaluation_t

contains

   !> Transforms rates and preloads from marker axes to the axes of body i (A_i = I at design): K = E diag(k) Eᵀ. Must be called
   !> after any change of axes, rates or preload.
   !> Equation (M.15) of docs/theory/measures.md.
   pure subroutine set_bushing_axes(bushing)
      type(bushing_t), intent(inout) :: bushing

      bushing%stiffness_t = in_body(bushing%axes, bushing%kt)
      bushing%stiffness_r = in_body(bushing%axes, bushing%kr)
      bushing%force0 = rotated(bushing%axes, bushing%preload_force)
      bushing%moment0 = rotated(bushing%axes, bushing%preload_moment)
   end subroutine set_bushing_axes

   !> The stiffness matrix E diag(k) Eᵀ, transformed from the axes of a marker to the axes of its body.
   pure function in_body(axes, k) result(matrix)
      real(num), intent(in) :: axes(3, 3), k(3)
      real(num) :: matrix(3, 3)
      integer :: i, j

      do j = 1, 3
         do i = 1, 3
            matrix(i, j) = sum(axes(i, :)*k*axes(j, :))
         end do
      end do
   end function in_body

   !> Computes displacement, rotation, force and moment of the law, and the slopes of the law.
   !> Equation (M.15) of docs/theory/measures.md.
   pure subroutine evaluate_bushing(bushing, measure, pose_i, pose_j, evaluation)
      type(bushing_t), intent(in) :: bushing
      type(measure_t), intent(in) :: measure            !! of the element: arms of the markers
      type(pose_t), intent(in) :: pose_i, pose_j
      type(bushing_evaluation_t), intent(inout) :: evaluation
      real(num) :: a(3), b(3), d(3), force(3), load(6), slope(6)

      a = rotated(pose_i%a, measure%arm_i)
      b = rotated(pose_j%a, measure%arm_j)
      d = (pose_j%r - pose_i%r) + (b - a)
      evaluation%frame = pose_i%a
      evaluation%a = a
      evaluation%b = b
      evaluation%d = d
      evaluation%gap = gap_of(bushing, pose_i, d)
      call relative_rotation(pose_i, pose_j, evaluation%rotation)
      if (bushing%has_curves) then
         call evaluate_components(bushing, evaluation%gap, evaluation%rotation%theta, load, slope)
         force = rotated(bushing%axes, load(1:3))
         evaluation%moment = rotated(bushing%axes, load(4:6))
         evaluation%stiffness_t = in_body(bushing%axes, slope(1:3))
         evaluation%stiffness_r = in_body(bushing%axes, slope(4:6))
      else
         force = rotated(bushing%stiffness_t, evaluation%gap) - bushing%force0
         evaluation%moment = rotated(bushing%stiffness_r, evaluation%rotation%theta) - bushing%moment0
         evaluation%stiffness_t = bushing%stiffness_t
         evaluation%stiffness_r = bushing%stiffness_r
      end if
      evaluation%force = rotated(pose_i%a, force)
   end subroutine evaluate_bushing

   !> Computes the deflections of a bushing alone, as evaluate_bushing does.
   !> Equation (M.15) of docs/theory/measures.md.
   pure subroutine deflect_bushing(bushing, measure, pose_i, pose_j, gap, theta)
      type(bushing_t), intent(in) :: bushing
      type(measure_t), intent(in) :: measure            !! of the element: arms of the markers
      type(pose_t), intent(in) :: pose_i, pose_j
      real(num), intent(out) :: gap(3)                  !! displacement minus its value at design, axes of body i [m]
      real(num), intent(out) :: theta(3)                !! rotation vector, axes of body i [rad]
      type(relative_rotation_t) :: turn

      gap = gap_of(bushing, pose_i, (pose_j%r - pose_i%r) + (rotated(pose_j%a, measure%arm_j) - rotated(pose_i%a, measure%arm_i)))
      call relative_rotation(pose_i, pose_j, turn)
      theta = turn%theta
   end subroutine deflect_bushing

   !> The displacement d between the markers minus its value at design, in the axes of body i.
   pure function gap_of(bushing, pose_i, d) result(gap)
      type(bushing_t), intent(in) :: bushing
      type(pose_t), intent(in) :: pose_i
      real(num), intent(in) :: d(3)                     !! global [m]
      real(num) :: gap(3)

      gap(1) = dot_product(pose_i%a(:, 1), d) - bushing%gap0(1)
      gap(2) = dot_product(pose_i%a(:, 2), d) - bushing%gap0(2)
      gap(3) = dot_product(pose_i%a(:, 3), d) - bushing%gap0(3)
   end function gap_of

   !> Computes dV/d(component) [N, N m], with the preload subtracted, along and about the marker axes. Also computes the slopes
   !> [N/m, N m/rad].
   pure subroutine evaluate_components(bushing, gap, theta, load, slope)
      type(bushing_t), intent(in) :: bushing
      real(num), intent(in) :: gap(3), theta(3)          !! axes of body i
      real(num), intent(out) :: load(6), slope(6)
      real(num) :: deflection(6)
      integer :: k

      slope(1:3) = bushing%kt
      slope(4:6) = bushing%kr
      do k = 1, 3
         deflection(k) = dot_product(bushing%axes(:, k), gap)
         deflection(k + 3) = dot_product(bushing%axes(:, k), theta)
      end do
      load = slope*deflection
      if (bushing%has_curves) then
         do k = 1, 6
            if (bushing%laws(k)%has_curve) call look_up_law(bushing%laws(k), deflection(k), load(k), slope(k))
         end do
      end if
      load(1:3) = load(1:3) - bushing%preload_force
      load(4:6) = load(4:6) - bushing%preload_moment
   end subroutine evaluate_components

   !> Computes force and moment of the bushing law on body j, marker axes: preload minus restoring force of rates or curves [N,
   !> N m]. The force is the force on body j. The moment is conjugate to θ (−dV/dθ); the moment on body j is ∂θ/∂δᵀ times this
   !> moment, as in bushing_force.
   pure subroutine bushing_load(bushing, gap, theta, force, moment)
      type(bushing_t), intent(in) :: bushing
      real(num), intent(in) :: gap(3), theta(3)          !! deflections, of deflect_bushing
      real(num), intent(out) :: force(3), moment(3)
      real(num) :: load(6), slope(6)

      call evaluate_components(bushing, gap, theta, load, slope)
      force = -load(1:3)
      moment = -load(4:6)
   end subroutine bushing_load

   !> The six rates at design in marker axes [N/m, N m/rad]; for curves, the slopes at design.
   pure function design_rates(bushing) result(rates)
      type(bushing_t), intent(in) :: bushing
      real(num) :: rates(6), load(6)
      real(num), parameter :: none(3) = zero

      call evaluate_components(bushing, none, none, load, rates)
   end function design_rates

   !> The generalised force dV/dz = [−f, −(a+d)×f − w, f, b×f + w], with f and m force and moment of the law, and
   !> w = A_i ∂θ/∂δᵀ m. Here d is the complete displacement from I to J.
   !> Equation (M.16) of docs/theory/measures.md.
   pure function bushing_force(evaluation) result(generalised_force)
      type(bushing_evaluation_t), intent(in) :: evaluation
      real(num) :: generalised_force(12), w(3), arm(3)

      w = rotated(evaluation%frame, rotation_gradient(evaluation%rotation, evaluation%moment))
      generalised_force(1:3) = -evaluation%force
      arm = evaluation%a + evaluation%d
      generalised_force(4:6) = -cross(arm, evaluation%force) - w
      generalised_force(7:9) = evaluation%force
      generalised_force(10:12) = cross(evaluation%b, evaluation%force) + w
   end function bushing_force

   !> Adds the full tangent d²V/dz²: material, and force × Hessian of the displacement and of θ.
   !> Equation (M.17) of docs/theory/measures.md.
   pure subroutine add_bushing_tangent(evaluation, at, blocks)
      type(bushing_evaluation_t), intent(in) :: evaluation
      integer, intent(in) :: at(3)
      real(num), intent(inout) :: blocks(6, 6, *)
      real(num) :: g(3, 3), kg(3, 3), inner(3, 3), arm(3)
      integer :: k, l

      arm = evaluation%a + evaluation%d
      call add_link_stiffness(in_world(evaluation%frame, evaluation%stiffness_t, at(1)), arm, evaluation%b, at, blocks)
      call add_gap_hessian(evaluation%force, evaluation%a, evaluation%b, evaluation%d, at, blocks)
      g = rotation_jacobian(evaluation%rotation)
      do k = 1, 3
         kg(:, k) = rotated(evaluation%stiffness_r, g(:, k))
      end do
      do k = 1, 3
         do l = k, 3
            inner(l, k) = dot_product(g(:, l), kg(:, k))
            inner(k, l) = inner(l, k)
         end do
      end do
      call add_rotation_hessian(evaluation%rotation, evaluation%moment, inner, evaluation%frame, at, blocks)
   end subroutine add_bushing_tangent

   !> Adds −(19) of the paper: Bᵀ C B with rows [−u, −a×u, u, b×u] and [0, −u, 0, u], for u = each of the three
   !> marker axes. Forces do not enter, and the rotation of the marker frame itself (u×d) is neglected.
   !> Equation (M.18) of docs/theory/measures.md.
   pure subroutine add_bushing_material(evaluation, at, blocks)
      type(bushing_evaluation_t), intent(in) :: evaluation
      integer, intent(in) :: at(3)
      real(num), intent(inout) :: blocks(6, 6, *)
      real(num) :: k(3, 3)

      call add_link_stiffness(in_world(evaluation%frame, evaluation%stiffness_t, at(1)), evaluation%a, evaluation%b, at, blocks)
      k = in_world(evaluation%frame, evaluation%stiffness_r, at(1))
      call add_block(k, pi_i, pi_i, at, blocks)
      call add_block(k, pi_j, pi_j, at, blocks)
      if (at(3) == 0) return
      k = -k
      call add_block(k, pi_i, pi_j, at, blocks)
   end subroutine add_bushing_material

end module ek_elastic
