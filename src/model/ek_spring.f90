!> The force of an elastic element of one measure, and its tangent.
!>
!> T is the tension dV/dvalue, the law of ek_element; g is the gradient of the measure. The tangent is T' g gᵀ + T × Hessian of
!> the measure. Distances and rotations have shorter forms of it.
module ek_spring
   use ek_kinds, only: wp
   use ek_measure, only: view_t, rotation, add_measure_hessian
   use ek_block, only: add_link_stiffness, add_diagonal_block, add_block, s_matrix, dyad
   use ek_law, only: look_up_law
   use ek_element, only: element_t
   implicit none(type, external)
   private
   public :: spring_tension, add_spring_tangent, add_spring_material, add_torsion_tangent, add_torsion_material
   public :: add_measure_material

contains

   !> Tension at a length, and its slope dT/dL; for a torsion spring, the moment at an angle.
   !> Equation (M.14) of docs/theory/measures.md.
   pure subroutine spring_tension(spring, length, tension, slope)
      type(element_t), intent(in) :: spring
      real(wp), intent(in) :: length    !! m, rad
      real(wp), intent(out) :: tension  !! N, pulls the ends together; N m, reduces the angle
      real(wp), intent(out) :: slope    !! N/m, N m/rad

      if (spring%has_law) then
         call look_up_law(spring%law, length, tension, slope)
         tension = tension - spring%preload
      else
         tension = spring%rate*(length - spring%design_length) - spring%preload
         slope = spring%rate
      end if
   end subroutine spring_tension

   !> Adds Jᵀ[slope e eᵀ + tension/L (I − e eᵀ)]J and the arm terms of the distance's Hessian.
   !> Equation (M.13) of docs/theory/measures.md.
   pure subroutine add_spring_tangent(view, tension, slope, at_i, at_j, ld, matrix)
      type(view_t), intent(in) :: view       !! of the spring's measure
      real(wp), intent(in) :: tension, slope
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: m(3, 3), pull(3), across
      integer :: k

      across = tension/view%value
      do k = 1, 3
         m(:, k) = ((slope - across)*view%u(k))*view%u
         m(k, k) = m(k, k) + across
      end do
      call add_link_stiffness(m, view%a, view%b, at_i, at_j, ld, matrix)
      pull = tension*view%u
      m = -s_matrix(view%a, pull)
      call add_diagonal_block(m, at_i + 3, at_i, ld, matrix)
      call add_diagonal_block(s_matrix(view%b, pull), at_j + 3, at_j, ld, matrix)
   end subroutine add_spring_tangent

   !> Adds Jᵀ slope e eᵀ J alone.
   pure subroutine add_spring_material(view, slope, at_i, at_j, ld, matrix)
      type(view_t), intent(in) :: view       !! of the spring's measure
      real(wp), intent(in) :: slope
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: m(3, 3)
      integer :: k

      do k = 1, 3
         m(:, k) = slope*(view%u(k)*view%u)
      end do
      call add_link_stiffness(m, view%a, view%b, at_i, at_j, ld, matrix)
   end subroutine add_spring_material

   !> Adds slope g gᵀ + moment × Hessian of the rotation.
   !> Equation (M.13) of docs/theory/measures.md.
   pure subroutine add_torsion_tangent(view, moment, slope, at_i, at_j, ld, matrix)
      type(view_t), intent(in) :: view       !! of the spring's measure
      real(wp), intent(in) :: moment, slope  !! N m, N m/rad
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)

      call add_torsion_material(view, slope, at_i, at_j, ld, matrix)
      call add_measure_hessian(rotation, view, moment, at_i, at_j, ld, matrix)
   end subroutine add_torsion_tangent

   !> Adds slope g gᵀ alone, g = [0, −v, 0, v].
   pure subroutine add_torsion_material(view, slope, at_i, at_j, ld, matrix)
      type(view_t), intent(in) :: view
      real(wp), intent(in) :: slope
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: k(3, 3), pull(3)

      pull = slope*view%v
      k = dyad(pull, view%v)
      call add_diagonal_block(k, at_i + 3, at_i, ld, matrix)
      call add_diagonal_block(k, at_j + 3, at_j, ld, matrix)
      if (at_i < 0 .or. at_j < 0) return
      k = -k
      call add_block(k, at_i + 3, at_j + 3, ld, matrix)
   end subroutine add_torsion_material

   !> Adds slope g gᵀ of any measure: the material part of its tangent (the other part is tension × Hessian).
   !> Equation (M.13) of docs/theory/measures.md.
   pure subroutine add_measure_material(view, slope, at_i, at_j, ld, matrix)
      type(view_t), intent(in) :: view        !! of the spring's measure
      real(wp), intent(in) :: slope           !! N/m, N m/rad, N m
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)

      call add_own(slope, view%gradient(1:6), at_i, ld, matrix)
      call add_own(slope, view%gradient(7:12), at_j, ld, matrix)
      if (at_i < 0 .or. at_j < 0) return
      call add_dyad(slope, view%gradient(1:3), view%gradient(7:9), at_i, at_j, ld, matrix)
      call add_dyad(slope, view%gradient(1:3), view%gradient(10:12), at_i, at_j + 3, ld, matrix)
      call add_dyad(slope, view%gradient(4:6), view%gradient(7:9), at_i + 3, at_j, ld, matrix)
      call add_dyad(slope, view%gradient(4:6), view%gradient(10:12), at_i + 3, at_j + 3, ld, matrix)
   end subroutine add_measure_material

   !> Adds slope g gᵀ of one body.
   pure subroutine add_own(slope, gradient, at, ld, matrix)
      real(wp), intent(in) :: slope, gradient(6)
      integer, intent(in) :: at, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: scaled(3), block(3, 3)

      if (at < 0) return
      scaled = slope*gradient(1:3)
      block = dyad(scaled, gradient(1:3))
      call add_diagonal_block(block, at, at, ld, matrix)
      scaled = slope*gradient(4:6)
      block = dyad(scaled, gradient(4:6))
      call add_diagonal_block(block, at + 3, at, ld, matrix)
      call add_dyad(slope, gradient(1:3), gradient(4:6), at, at + 3, ld, matrix)
   end subroutine add_own

   !> Adds slope p qᵀ to the rows after `row` and the columns after `column`, off the diagonal.
   pure subroutine add_dyad(slope, p, q, row, column, ld, matrix)
      real(wp), intent(in) :: slope, p(3), q(3)
      integer, intent(in) :: row, column, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: scaled(3), block(3, 3)

      scaled = slope*p
      block = dyad(scaled, q)
      call add_block(block, row, column, ld, matrix)
   end subroutine add_dyad

end module ek_spring
