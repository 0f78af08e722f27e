!> Force and tangent of elastic elements of any kind: the only procedures that the assembly of the system calls.
!>
!> "Pull" is the generalised force dV/dz, the gradient of the energy; the force ON the bodies is −dV/dz.
module ek_element_force
   use ek_kinds, only: wp
   use ek_turn, only: pose_t
   use ek_measure, only: view_t, look, add_measure_hessian, distance, rotation
   use ek_elastic, only: bushing_view_t, look_bushing, bushing_pull, add_bushing_tangent, add_bushing_material, design_rates
   use ek_element, only: element_t, bushing_element, is_of_angle
   use ek_spring, only: spring_tension, add_spring_tangent, add_spring_material, add_torsion_tangent, add_torsion_material, &
      add_measure_material
   implicit none(type, external)
   private
   public :: element_view_t, look_element, add_element_tangent, add_element_material, design_stiffness

   !> An element at one pair of poses.
   type :: element_view_t
      real(wp) :: pull(12) = 0.0_wp      !! dV/d[Δr_i Δπ_i Δr_j Δπ_j] [N, N m]
      real(wp) :: tension = 0.0_wp       !! dV/dvalue and its slope, of an element of one measure
      real(wp) :: slope = 0.0_wp
      type(view_t) :: measure
      type(bushing_view_t) :: bushing
   end type element_view_t

contains

   !> Deflection, force and slope.
   pure subroutine look_element(element, pose_i, pose_j, view)
      type(element_t), intent(in) :: element
      type(pose_t), intent(in) :: pose_i, pose_j
      type(element_view_t), intent(inout) :: view       !! only the components that this kind needs are set

      if (element%kind == bushing_element) then
         call look_bushing(element%bushing, pose_i, pose_j, view%bushing)
         view%pull = bushing_pull(view%bushing)
      else
         call look(element%measure, pose_i, pose_j, view%measure)
         call spring_tension(element, view%measure%value, view%tension, view%slope)
         view%pull = view%tension*view%measure%gradient
      end if
   end subroutine look_element

   !> Adds d²V/dz²: the material part, and force × Hessian.
   pure subroutine add_element_tangent(element, view, at_i, at_j, ld, matrix)
      type(element_t), intent(in) :: element
      type(element_view_t), intent(in) :: view          !! of look_element
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)

      if (element%kind == bushing_element) then
         call add_bushing_tangent(element%bushing, view%bushing, at_i, at_j, ld, matrix)
         return
      end if
      select case (element%measure%kind)
      case (distance)
         call add_spring_tangent(view%measure, view%tension, view%slope, at_i, at_j, ld, matrix)
      case (rotation)
         call add_torsion_tangent(view%measure, view%tension, view%slope, at_i, at_j, ld, matrix)
      case default
         call add_measure_material(view%measure, view%slope, at_i, at_j, ld, matrix)
         call add_measure_hessian(element%measure%kind, view%measure, view%tension, at_i, at_j, ld, matrix)
      end select
   end subroutine add_element_tangent

   !> Adds the material part alone, −(19) of the paper.
   pure subroutine add_element_material(element, view, at_i, at_j, ld, matrix)
      type(element_t), intent(in) :: element
      type(element_view_t), intent(in) :: view          !! of look_element
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)

      if (element%kind == bushing_element) then
         call add_bushing_material(element%bushing, view%bushing, at_i, at_j, ld, matrix)
         return
      end if
      select case (element%measure%kind)
      case (distance)
         call add_spring_material(view%measure, view%slope, at_i, at_j, ld, matrix)
      case (rotation)
         call add_torsion_material(view%measure, view%slope, at_i, at_j, ld, matrix)
      case default
         call add_measure_material(view%measure, view%slope, at_i, at_j, ld, matrix)
      end select
   end subroutine add_element_material

   !> The stiffnesses at design: along x, y, z and about x, y, z of the marker of a bushing [N/m, N m/rad]. The slope of an
   !> element of one measure is the first or, of an angle, the fourth; the others are 0.
   pure function design_stiffness(element) result(rates)
      type(element_t), intent(in) :: element
      real(wp) :: rates(6), tension, slope

      if (element%kind == bushing_element) then
         rates = design_rates(element%bushing)
      else
         rates = 0.0_wp
         call spring_tension(element, element%design_length, tension, slope)
         rates(merge(4, 1, is_of_angle(element%measure%kind))) = slope
      end if
   end function design_stiffness

end module ek_element_force
