!> An elastic element in parts: each of its laws with slope and gradient of its measure, and the remainder of its tangent, the
!> geometric stiffness of its forces.
!>
!> The tangent of an element is Σ c g gᵀ + Σ F Hess: c the slope of a law, g the gradient of its measure. A bushing has six laws, of
!> displacements and rotations along and about the axes of its marker on body i; every other element has one law.
module ek_element_part
   use ek_kinds, only: wp
   use ek_relative_rotation, only: pose_t
   use ek_measure, only: measure_t, evaluation_t, evaluate, body_gap, rotation, is_of_angle
   use ek_element, only: element_t, bushing_element, is_linear
   use ek_element_force, only: element_evaluation_t, evaluate_element, add_element_tangent
   implicit none(type, external)
   private
   public :: element_part_t, count_parts, take_apart, add_geometric_stiffness, is_part_of_angle, has_rate, find_deflections

   !> One law of an element at a state.
   type :: element_part_t
      real(wp) :: slope = 0.0_wp             !! c: slope of the law [N/m, N m/rad]
      real(wp) :: gradient(12) = 0.0_wp      !! g: gradient of the deflection [-, m]
   end type element_part_t

contains

   !> The number of laws of an element.
   pure integer function count_parts(element)
      type(element_t), intent(in) :: element
      count_parts = merge(6, 1, element%kind == bushing_element)
   end function count_parts

   !> Whether a law acts on an angle or a cosine: its deflection is in rad or -, and its force in N m.
   pure logical function is_part_of_angle(element, part) result(is_angle)
      type(element_t), intent(in) :: element
      integer, intent(in) :: part

      is_angle = part > 3
      if (element%kind /= bushing_element) is_angle = is_of_angle(element%measure%kind)
   end function is_part_of_angle

   !> Whether a law is a rate: its force is proportional to its deflection, without a curve or a clearance.
   pure logical function has_rate(element, part)
      type(element_t), intent(in) :: element
      integer, intent(in) :: part

      if (element%kind /= bushing_element) then
         has_rate = is_linear(element)
      else
         has_rate = .true.
         if (element%bushing%has_curves) has_rate = .not. element%bushing%laws(part)%has_curve
      end if
   end function has_rate

   !> Finds the deflection of each law that is a rate: the change of the force per change of the rate. The deflection is counted
   !> from design, where the force is the preload. For a spring whose preload follows from rate and free length, the deflection is
   !> counted from the free length.
   pure subroutine find_deflections(element, pose_i, pose_j, deflection)
      type(element_t), intent(in) :: element
      type(pose_t), intent(in) :: pose_i, pose_j
      real(wp), intent(out) :: deflection(6)                !! the first count_parts are set [m, rad]
      real(wp), parameter :: same = 1.0e-9_wp               ! relative: a preload that balance has set is another one
      type(element_evaluation_t) :: whole
      real(wp) :: preload
      integer :: k

      deflection = 0.0_wp
      call evaluate_element(element, pose_i, pose_j, whole)
      if (element%kind == bushing_element) then
         do k = 1, 3
            deflection(k) = dot_product(element%bushing%axes(:, k), whole%bushing%gap)
            deflection(k + 3) = dot_product(element%bushing%axes(:, k), whole%bushing%rotation%theta)
         end do
         return
      end if
      deflection(1) = whole%measure%value - element%law%reference
      preload = element%law%rate*(element%free_length - element%design_length)
      if (element%free_length > 0.0_wp .and. abs(preload - element%preload) <= same*abs(preload)) &
         deflection(1) = whole%measure%value - element%free_length
   end subroutine find_deflections

   !> Lists the laws of an element at a pair of poses. The order for a bushing is along x, y, z, then about x, y, z of its marker.
   !> Equation (C.15) of docs/theory/compliance.md.
   pure subroutine take_apart(element, pose_i, pose_j, parts)
      type(element_t), intent(in) :: element
      type(pose_t), intent(in) :: pose_i, pose_j
      type(element_part_t), intent(inout) :: parts(6)       !! the first count_parts are set
      type(element_evaluation_t) :: whole
      type(evaluation_t) :: evaluation
      type(measure_t) :: measure
      integer :: k

      call evaluate_element(element, pose_i, pose_j, whole)
      if (element%kind /= bushing_element) then
         parts(1)%slope = whole%slope
         parts(1)%gradient = whole%measure%gradient
         return
      end if
      measure = element%measure
      do k = 1, 6
         measure%kind = merge(body_gap, rotation, k <= 3)
         associate (axis => element%bushing%axes(:, mod(k - 1, 3) + 1))
            measure%u = axis
            ! the axes are those of the law: E K Eᵀ is diagonal
            if (k <= 3) then
               parts(k)%slope = dot_product(axis, matmul(whole%bushing%stiffness_t, axis))
            else
               parts(k)%slope = dot_product(axis, matmul(whole%bushing%stiffness_r, axis))
            end if
         end associate
         call evaluate(measure, pose_i, pose_j, evaluation)
         parts(k)%gradient = evaluation%gradient
      end do
   end subroutine take_apart

   !> Adds the geometric stiffness of an element, force × Hessian: its tangent with all slopes 0.
   !> Equation (C.15) of docs/theory/compliance.md.
   pure subroutine add_geometric_stiffness(element, pose_i, pose_j, at, blocks)
      type(element_t), intent(in) :: element
      type(pose_t), intent(in) :: pose_i, pose_j
      integer, intent(in) :: at(3)
      real(wp), intent(inout) :: blocks(6, 6, *)
      type(element_evaluation_t) :: evaluation

      call evaluate_element(element, pose_i, pose_j, evaluation)
      evaluation%slope = 0.0_wp
      evaluation%bushing%stiffness_t = 0.0_wp
      evaluation%bushing%stiffness_r = 0.0_wp
      call add_element_tangent(element, evaluation, .false., at, blocks)
   end subroutine add_geometric_stiffness

end module ek_element_part
