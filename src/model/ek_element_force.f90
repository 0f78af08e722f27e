!> Force and tangent of elastic elements of any kind. The assembly of the system calls only evaluate_element and
!> add_element_tangent.
!>
!> The generalised force is dV/dz, the gradient of the energy; the force ON the bodies is −dV/dz.
module ek_element_force
   use ek_kinds, only: wp
   use ek_number, only: num, zero
   use ek_relative_rotation, only: pose_t
   use ek_measure, only: evaluation_t, evaluate, add_measure_hessian, is_of_angle, distance, global_gap
   use ek_block, only: add_link_stiffness, add_block, dyad
   use ek_elastic, only: bushing_evaluation_t, evaluate_bushing, bushing_force, add_bushing_tangent, add_bushing_material, &
      design_rates
   use ek_element, only: element_t, look_up_element, bushing_element
   implicit none(type, external)
   private
   public :: element_evaluation_t, evaluate_element, add_element_tangent, design_stiffness
   public :: spring_tension, add_spring_tangent, add_spring_material

   !> An element evaluated at one pair of poses.
   type :: element_evaluation_t
      real(num) :: generalised_force(12) = zero      !! dV/d[Δr_i Δπ_i Δr_j Δπ_j] [N, N m]
      real(num) :: tension = zero       !! dV/dvalue of an element of one measure; `slope` is its slope
      real(num) :: slope = zero
      type(evaluation_t) :: measure
      type(bushing_evaluation_t) :: bushing
   end type element_evaluation_t

contains

   !> Computes deflection, force and slope of an element.
   pure subroutine evaluate_element(element, pose_i, pose_j, evaluation)
      type(element_t), intent(in) :: element
      type(pose_t), intent(in) :: pose_i, pose_j
      type(element_evaluation_t), intent(inout) :: evaluation       !! only the components that this kind needs are set

      if (element%kind == bushing_element) then
         call evaluate_bushing(element%bushing, element%measure, pose_i, pose_j, evaluation%bushing)
         evaluation%generalised_force = bushing_force(evaluation%bushing)
      else
         call evaluate(element%measure, pose_i, pose_j, evaluation%measure)
         call spring_tension(element, evaluation%measure%value, evaluation%tension, evaluation%slope)
         evaluation%generalised_force = evaluation%tension*evaluation%measure%gradient
      end if
   end subroutine evaluate_element

   !> Computes the tension of a spring at a value of its measure, and the slope of the tension; for a torsion spring, the moment at
   !> an angle.
   !> Equation (M.14) of docs/theory/measures.md.
   pure subroutine spring_tension(spring, value, tension, slope)
      type(element_t), intent(in) :: spring
      real(num), intent(in) :: value     !! m, rad, -
      real(num), intent(out) :: tension  !! N, pulls the ends together; N m, reduces the angle
      real(num), intent(out) :: slope    !! N/m, N m/rad

      call look_up_element(spring, value, tension, slope)
      tension = tension - spring%preload
   end subroutine spring_tension

   !> Adds d²V/dz² of an element: the material part, and force × Hessian unless is_material.
   pure subroutine add_element_tangent(element, evaluation, is_material, at, blocks)
      type(element_t), intent(in) :: element
      type(element_evaluation_t), intent(in) :: evaluation          !! of evaluate_element
      logical, intent(in) :: is_material                !! the material part alone, −(19) of the paper
      integer, intent(in) :: at(3)
      real(num), intent(inout) :: blocks(6, 6, *)

      if (element%kind == bushing_element) then
         if (is_material) call add_bushing_material(evaluation%bushing, at, blocks)
         if (.not. is_material) call add_bushing_tangent(evaluation%bushing, at, blocks)
      else if (is_material) then
         call add_spring_material(element%measure%kind, evaluation%measure, evaluation%slope, at, blocks)
      else
         call add_spring_tangent(element%measure%kind, evaluation%measure, evaluation%tension, evaluation%slope, at, blocks)
      end if
   end subroutine add_element_tangent

   !> Adds slope g gᵀ + tension × Hessian of the measure, with g its gradient. For a distance the sum is Jᵀ[slope e eᵀ + tension/L
   !> (I − e eᵀ)]J and the arm terms, which equal the arm terms of a displacement along e.
   !> Equation (M.13) of docs/theory/measures.md.
   pure subroutine add_spring_tangent(kind, evaluation, tension, slope, at, blocks)
      integer, intent(in) :: kind                       !! of the measure
      type(evaluation_t), intent(in) :: evaluation
      real(num), intent(in) :: tension, slope
      integer, intent(in) :: at(3)
      real(num), intent(inout) :: blocks(6, 6, *)
      real(num) :: m(3, 3), across
      integer :: k

      if (kind /= distance) then
         call add_spring_material(kind, evaluation, slope, at, blocks)
         call add_measure_hessian(kind, evaluation, tension, at, blocks)
         return
      end if
      across = tension/evaluation%value
      do k = 1, 3
         m(:, k) = ((slope - across)*evaluation%u(k))*evaluation%u
         m(k, k) = m(k, k) + across
      end do
      call add_link_stiffness(m, evaluation%a, evaluation%b, at, blocks)
      call add_measure_hessian(global_gap, evaluation, tension, at, blocks)
   end subroutine add_spring_tangent

   !> Adds only slope g gᵀ, the material part.
   !> Equation (M.13) of docs/theory/measures.md.
   pure subroutine add_spring_material(kind, evaluation, slope, at, blocks)
      integer, intent(in) :: kind                       !! of the measure
      type(evaluation_t), intent(in) :: evaluation
      real(num), intent(in) :: slope                     !! N/m, N m/rad, N m
      integer, intent(in) :: at(3)
      real(num), intent(inout) :: blocks(6, 6, *)
      real(num) :: scaled(3), part(3, 3)
      integer :: k, l, step

      step = merge(2, 1, is_of_angle(kind))             ! the gradient of an angle has no translations
      do l = step, 4, step
         if (at((l + 1)/2) == 0) cycle
         scaled = slope*evaluation%gradient(3*l - 2:3*l)
         do k = step, l, step
            if (at((k + 1)/2) == 0) cycle
            part = dyad(scaled, evaluation%gradient(3*k - 2:3*k))
            call add_block(part, l, k, at, blocks)      ! l, k: unknowns r_i … pi_j
         end do
      end do
   end subroutine add_spring_material

   !> The stiffnesses of an element at design [N/m, N m/rad]: along and about x, y, z of the marker of a bushing. For an element
   !> with one measure, the slope is the first entry (the fourth for an angle), and the other entries are 0.
   pure function design_stiffness(element) result(rates)
      type(element_t), intent(in) :: element
      real(num) :: rates(6), tension, slope

      if (element%kind == bushing_element) then
         rates = design_rates(element%bushing)
      else
         rates = 0.0_wp
         call spring_tension(element, element%design_length, tension, slope)
         rates(merge(4, 1, is_of_angle(element%measure%kind))) = slope
      end if
   end function design_stiffness

end module ek_element_force
