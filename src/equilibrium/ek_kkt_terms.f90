!> The terms of the KKT system at a state: loads, elements and rows of Φ, added to blocks and right-hand side.
module ek_kkt_terms
   use ek_kinds, only: wp
   use ek_number, only: num, one, some
   use ek_measure, only: evaluation_t, evaluate, add_measure_hessian
   use ek_relative_rotation, only: pose_t
   use ek_block, only: add_block, add_gradient, r_j, pi_j
   use ek_element, only: element_t
   use ek_element_force, only: element_evaluation_t, evaluate_element, add_element_tangent
   use ek_rotation, only: skew
   use ek_row, only: row_t, term_t
   use ek_load, only: load_t, wrench, add_load_tangent
   use ek_pattern, only: pattern_t, whole_tangent, material_only, residual_only
   implicit none(type, external)
   private
   public :: assemble_terms, assemble_rate_terms

contains

   !> Assembles blocks of T, gradients of the rows, and right-hand side at a state (see `assemble` of ek_kkt_system). The
   !> arrays have explicit shapes, which the compiler turns into fast code.
   !> Equations (K.3), (K.4) of docs/theory/kkt.md.
   !> Equation (M.19) of docs/theory/measures.md.
   !> Equation (R.13) of docs/theory/rotations.md.
   pure subroutine assemble_terms(pattern, loads, elements, rows, terms, poses, reaction, factor, change, mode, gradients, values, &
      blocks, jacobian, rhs)
      type(pattern_t), intent(in) :: pattern     !! of the suspension
      type(load_t), intent(in) :: loads(:)
      type(element_t), intent(in) :: elements(:)
      type(row_t), intent(in) :: rows(:)
      type(term_t), intent(in) :: terms(:)
      type(pose_t), intent(in) :: poses(0:*)     !! the chassis, then the bodies
      real(num), intent(in) :: reaction(*)
      real(num), intent(in) :: factor(*)          !! of each load
      real(num), intent(in) :: change(*)          !! of the value of each row
      integer, intent(in) :: mode                !! whole_tangent, material_only or residual_only
      real(num), intent(inout) :: gradients(12, *), values(*)
      real(num), intent(inout) :: blocks(6, 6, pattern%blocks)                !! of the store, see ek_pattern
      real(num), intent(inout) :: jacobian(6, *)                              !! gradients of the rows
      real(num), intent(inout) :: rhs(pattern%n)
      type(evaluation_t) :: evaluation
      type(element_evaluation_t) :: element_evaluation
      real(num) :: value, force(3), moment(3), arm(3), block(3, 3)
      integer :: k, t, i, j, at_i, at_j

      rhs = 0.0_wp
      if (mode /= residual_only) then
         call clear(36*pattern%blocks, blocks)
         call clear(6*(pattern%first_slot(pattern%nc + 1) - 1), jacobian)
      end if

      do k = 1, size(loads)
         if (.not. some(abs(factor(k)) > 0.0_wp)) cycle
         j = loads(k)%body
         at_j = 6*(j - 1)
         call wrench(loads(k), poses(j), force, moment, arm)
         force = factor(k)*force
         rhs(at_j + 1:at_j + 3) = rhs(at_j + 1:at_j + 3) + force
         rhs(at_j + 4:at_j + 6) = rhs(at_j + 4:at_j + 6) + factor(k)*moment
         if (mode == whole_tangent) call add_load_tangent(loads(k), poses(j), force, arm, j, blocks)
      end do

      do k = 1, size(elements)
         associate (element => elements(k))
            i = element%measure%body_i
            j = element%measure%body_j
            at_i = 6*(i - 1)
            at_j = 6*(j - 1)
            call evaluate_element(element, poses(i), poses(j), element_evaluation)
            call add_gradient(-one, element_evaluation%generalised_force, at_i, at_j, rhs)     ! ON the bodies: −dV/dz
            if (mode /= residual_only) &
               call add_element_tangent(element, element_evaluation, mode == material_only, pattern%element_at(:, k), blocks)
         end associate
      end do

      do k = 1, size(rows)
         value = 0.0_wp
         do t = rows(k)%first, rows(k)%first + rows(k)%terms - 1
            associate (term => terms(t))
               i = term%measure%body_i
               j = term%measure%body_j
               at_i = 6*(i - 1)
               at_j = 6*(j - 1)
               call evaluate(term%measure, poses(i), poses(j), evaluation)
               value = value + term%coefficient*evaluation%value
               gradients(:, t) = term%coefficient*evaluation%gradient
               call add_gradient(-reaction(k), gradients(:, t), at_i, at_j, rhs)
               if (mode /= residual_only) then
                  if (i > 0) jacobian(:, pattern%term_slot(1, t)) = jacobian(:, pattern%term_slot(1, t)) + gradients(1:6, t)
                  if (j > 0) jacobian(:, pattern%term_slot(2, t)) = jacobian(:, pattern%term_slot(2, t)) + gradients(7:12, t)
                  if (mode == whole_tangent) call add_measure_hessian(term%measure%kind, evaluation, &
                     reaction(k)*term%coefficient, pattern%term_at(:, t), blocks)
               end if
            end associate
         end do
         values(k) = value - rows(k)%target - rows(k)%compliance*reaction(k) - change(k)
         rhs(pattern%nq + k) = -values(k)
      end do

      if (mode == whole_tangent) then
         ! screw increments: r moves by Δr + ½ Δπ×Δr + …, so the unbalanced force g contributes ½ g̃
         do j = 1, pattern%bodies
            at_j = 6*(j - 1)
            block = -0.5_wp*skew(rhs(at_j + 1:at_j + 3))
            call add_block(block, r_j, pi_j, [0, j, 0], blocks)
         end do
      end if
   end subroutine assemble_terms

   !> Sets an array to zero in one operation. For an array with more dimensions, gfortran clears every column separately.
   pure subroutine clear(length, numbers)
      integer, intent(in) :: length
      real(num), intent(inout) :: numbers(length)
      numbers = 0.0_wp
   end subroutine clear

   !> Assembles the derivative of the right-hand side with respect to the path coordinate (see `assemble_rate` of ek_kkt_system).
   !> Equation (K.13) of docs/theory/kkt.md.
   pure subroutine assemble_rate_terms(nq, loads, poses, factor, change, rhs)
      integer, intent(in) :: nq                  !! unknowns of the bodies
      type(load_t), intent(in) :: loads(:)
      type(pose_t), intent(in) :: poses(0:*)     !! the chassis, then the bodies
      real(num), intent(in) :: factor(:)         !! derivative of the factor of each load
      real(num), intent(in) :: change(:)         !! derivative of the change of each row
      real(num), intent(inout) :: rhs(:)
      real(num) :: force(3), moment(3), arm(3)
      integer :: k, at

      rhs = 0.0_wp
      do k = 1, size(loads)
         if (.not. some(abs(factor(k)) > 0.0_wp)) cycle
         at = 6*(loads(k)%body - 1)
         call wrench(loads(k), poses(loads(k)%body), force, moment, arm)
         rhs(at + 1:at + 3) = rhs(at + 1:at + 3) + factor(k)*force
         rhs(at + 4:at + 6) = rhs(at + 4:at + 6) + factor(k)*moment
      end do
      do k = 1, size(change)
         rhs(nq + k) = rhs(nq + k) + change(k)
      end do
   end subroutine assemble_rate_terms

end module ek_kkt_terms
