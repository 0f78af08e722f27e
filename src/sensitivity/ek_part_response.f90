!> The changes of the forces of the parts of a model with the numbers of these parts, at a state where the bodies do not move.
!>
!> The force g of an element is the generalised force dV/dz of its two bodies [N, N m]. For a term of a row, g is the gradient of
!> its measure. H is the derivative of g with respect to z: the tangent of the element, or the Hessian of the measure. A marker that
!> is moved by e on body i changes g by
!>
!>     δg = H[:, r_i] e + [0; e×g_r; 0; 0]
!>
!> The reason is that a marker that moves with its body and a marker that moves on its body differ in the arm only. In all other
!> numbers, g is linear: forces and moments of a bushing, the tension of an element of one measure, the directions of a measure.
module ek_part_response
   use ek_kinds, only: wp
   use ek_rotation, only: cross
   use ek_relative_rotation, only: pose_t
   use ek_measure, only: measure_t, evaluation_t, evaluate, add_measure_hessian, is_of_angle, distance, axis_axis, global_gap
   use ek_element, only: element_t, bushing_element
   use ek_element_force, only: element_evaluation_t, evaluate_element, add_element_tangent
   use ek_block, only: rotated
   use ek_elastic, only: bushing_force, bushing_load
   implicit none(type, external)
   private
   public :: response_t, respond_element, respond_measure, load_at, turn_directions

   !> The response of a part at one pair of poses.
   type :: response_t
      real(wp) :: value = 0.0_wp               !! value of the measure [m, rad, -]
      real(wp) :: tension = 0.0_wp, slope = 0.0_wp     !! tension of an element of one measure, and its derivative by the measure
      real(wp) :: gradient(12) = 0.0_wp        !! gradient of the measure
      real(wp) :: force(12) = 0.0_wp           !! force g
      real(wp) :: by_arms(12, 6) = 0.0_wp      !! ∂g with respect to the arms of both markers, axes of their bodies
      real(wp) :: value_by_arms(6) = 0.0_wp    !! derivatives of the value of the measure with respect to the arms
      real(wp) :: by_load(12, 6) = 0.0_wp      !! ∂g with respect to force and moment of a bushing, axes of body i
      real(wp) :: gap(3) = 0.0_wp, theta(3) = 0.0_wp   !! deflections of a bushing, axes of body i
      real(wp) :: stiffness(3, 3) = 0.0_wp     !! stiffness of a bushing in its gap, axes of body i
      real(wp) :: load(6) = 0.0_wp             !! force and moment of a bushing with curves, axes of body i
   end type response_t

   integer, parameter :: local(3) = [1, 2, 3]  !! indices of the tangent blocks of one part, see ek_block

contains

   !> Computes the response of an element at a pair of poses.
   !> Equation (E.7) of docs/theory/derivatives.md.
   pure subroutine respond_element(element, pose_i, pose_j, evaluation, response)
      type(element_t), intent(in) :: element
      type(pose_t), intent(in) :: pose_i, pose_j
      type(element_evaluation_t), intent(inout) :: evaluation        !! work space
      type(response_t), intent(inout) :: response
      real(wp) :: blocks(6, 6, 3)
      integer :: k

      call evaluate_element(element, pose_i, pose_j, evaluation)
      response%force = evaluation%generalised_force
      blocks = 0.0_wp
      call add_element_tangent(element, evaluation, .false., local, blocks)
      call move_markers(blocks, pose_i, pose_j, response)
      if (element%kind /= bushing_element) then
         response%value = evaluation%measure%value
         response%gradient = evaluation%measure%gradient
         response%tension = evaluation%tension
         response%slope = evaluation%slope
         return
      end if
      associate (bushing => evaluation%bushing)
         response%gap = bushing%gap
         response%theta = bushing%rotation%theta
         response%stiffness = bushing%stiffness_t
         if (element%bushing%has_curves) response%load = load_at(element, element%bushing%gap0, response)
         bushing%moment = 0.0_wp
         do k = 1, 3
            bushing%force = pose_i%a(:, k)
            response%by_load(:, k) = bushing_force(bushing)
         end do
         bushing%force = 0.0_wp
         do k = 1, 3
            bushing%moment = [merge(1.0_wp, 0.0_wp, k == 1), merge(1.0_wp, 0.0_wp, k == 2), merge(1.0_wp, 0.0_wp, k == 3)]
            response%by_load(:, k + 3) = bushing_force(bushing)
         end do
      end associate
   end subroutine respond_element

   !> Computes force and moment of the law of a bushing at a response's deflections, dV/d(gap) and dV/dθ, in axes of body i. The law
   !> may have another gap at design.
   pure function load_at(law, gap0, response) result(load)
      type(element_t), intent(in) :: law
      real(wp), intent(in) :: gap0(3)                    !! gap at design of the bushing to which the response belongs
      type(response_t), intent(in) :: response
      real(wp) :: load(6), force(3), moment(3)

      call bushing_load(law%bushing, response%gap + (gap0 - law%bushing%gap0), response%theta, force, moment)
      load(1:3) = -rotated(law%bushing%axes, force)
      load(4:6) = -rotated(law%bushing%axes, moment)
   end function load_at

   !> Computes the response of a measure at a pair of poses.
   !> Equation (E.7) of docs/theory/derivatives.md.
   pure subroutine respond_measure(measure, pose_i, pose_j, evaluation, response)
      type(measure_t), intent(in) :: measure
      type(pose_t), intent(in) :: pose_i, pose_j
      type(evaluation_t), intent(inout) :: evaluation                !! work space
      type(response_t), intent(inout) :: response
      real(wp) :: blocks(6, 6, 3)
      integer :: k

      call evaluate(measure, pose_i, pose_j, evaluation)
      response%value = evaluation%value
      response%gradient = evaluation%gradient
      response%force = evaluation%gradient
      if (is_of_angle(measure%kind)) return              ! it has no points
      blocks = 0.0_wp
      ! that of a gap along a global direction has rotations only
      if (measure%kind /= global_gap) call add_measure_hessian(measure%kind, evaluation, 1.0_wp, local, blocks)
      call move_markers(blocks, pose_i, pose_j, response)
      do k = 1, 3
         response%value_by_arms(k) = dot_product(evaluation%gradient(1:3), pose_i%a(:, k))
         response%value_by_arms(k + 3) = dot_product(evaluation%gradient(7:9), pose_j%a(:, k))
      end do
   end subroutine respond_measure

   !> Computes the derivatives of g with respect to the arms of both markers, from the blocks of H.
   !> Equation (E.7) of docs/theory/derivatives.md.
   pure subroutine move_markers(blocks, pose_i, pose_j, response)
      real(wp), intent(in) :: blocks(6, 6, 3)            !! blocks of H: diagonal blocks of i and j, lower triangle; block with rows
                                                         !! of j, columns of i
      type(pose_t), intent(in) :: pose_i, pose_j
      type(response_t), intent(inout) :: response
      real(wp) :: columns(12, 3)
      integer :: k

      columns(1:6, :) = blocks(:, 1:3, 1)
      columns(7:12, :) = blocks(:, 1:3, 3)
      do k = 1, 3
         response%by_arms(:, k) = columns(:, 1)*pose_i%a(1, k) + columns(:, 2)*pose_i%a(2, k) + columns(:, 3)*pose_i%a(3, k)
         response%by_arms(4:6, k) = response%by_arms(4:6, k) + cross(pose_i%a(:, k), response%force(1:3))
      end do
      columns(1:6, :) = transpose(blocks(1:3, :, 3))
      columns(7:12, :) = blocks(:, 1:3, 2)
      do k = 1, 3
         response%by_arms(:, k + 3) = columns(:, 1)*pose_j%a(1, k) + columns(:, 2)*pose_j%a(2, k) + columns(:, 3)*pose_j%a(3, k)
         response%by_arms(10:12, k + 3) = response%by_arms(10:12, k + 3) + cross(pose_j%a(:, k), response%force(7:9))
      end do
   end subroutine move_markers

   !> Computes the changes of the value and the gradient of a measure for changes of its directions u and v. A measure is linear in
   !> each direction. A distance has no direction; only a cosine has the direction v.
   !> Equation (E.7) of docs/theory/derivatives.md.
   pure subroutine turn_directions(measure, u, v, pose_i, pose_j, value, gradient)
      type(measure_t), intent(in) :: measure
      real(wp), intent(in) :: u(3), v(3)                 !! changes of the directions
      type(pose_t), intent(in) :: pose_i, pose_j
      real(wp), intent(out) :: value, gradient(12)
      type(measure_t) :: turned
      type(evaluation_t) :: evaluation

      value = 0.0_wp
      gradient = 0.0_wp
      if (measure%kind == distance) return
      turned = measure
      turned%u = u
      call evaluate(turned, pose_i, pose_j, evaluation)
      value = evaluation%value
      gradient = evaluation%gradient
      if (measure%kind /= axis_axis) return
      turned%u = measure%u
      turned%v = v
      call evaluate(turned, pose_i, pose_j, evaluation)
      value = value + evaluation%value
      gradient = gradient + evaluation%gradient
   end subroutine turn_directions

end module ek_part_response
