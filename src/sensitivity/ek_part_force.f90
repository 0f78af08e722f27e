!> ∂F/∂p at a state: the changes of the parts that a number p of the deck affects, times the responses of these parts at the state.
!> F is the right-hand side of the equations of the state (ek_kkt).
!>
!> The cost of ∂F/∂p is thus proportional to the number of affected parts, and no digits are lost in differences of large forces.
!> Only a law that is not linear in its numbers (a curve, a rounded contact) is evaluated in each of the neighbouring designs, at
!> the deflection of the state.
!>
!> The force g of an element is the generalised force dV/dz of its two bodies [N, N m]. For a term of a row, g is the gradient of
!> its measure. H is the derivative of g with respect to z: the tangent of the element, or the Hessian of the measure. A marker that
!> is moved by e on body i changes g by
!>
!>     δg = H[:, r_i] e + [0; e×g_r; 0; 0]
!>
!> The reason is that a marker that moves with its body and a marker that moves on its body differ in the arm only. In all other
!> numbers, g is linear: forces and moments of a bushing, the tension of an element of one measure, the directions of a measure.
module ek_part_force
   use ek_kinds, only: wp
   use ek_block, only: rotated, add_gradient
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t
   use ek_element, only: element_t, bushing_element, is_linear
   use ek_element_force, only: element_evaluation_t, spring_tension, evaluate_element, add_element_tangent
   use ek_measure, only: evaluation_t, measure_t, evaluate, add_measure_hessian, is_of_angle, distance, axis_axis, &
      global_gap, contact_gap
   use ek_lowest_point, only: turn_rim
   use ek_row, only: term_t
   use ek_load, only: wrench
   use ek_skew_system, only: factor_of
   use ek_part_change, only: change_t, term_change_t, element_change_t, load_change_t, mark_parts
   use ek_rotation, only: cross
   use ek_relative_rotation, only: pose_t
   use ek_elastic, only: bushing_force, bushing_load
   implicit none(type, external)
   private
   public :: part_forces_t, choose_parts, find_responses, find_force, turn_directions

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

   !> The parts of a model that some numbers affect, and their responses at a state.
   type :: part_forces_t
      logical, allocatable, private :: has_term(:), has_element(:)
      type(response_t), allocatable, private :: terms(:), elements(:)
   end type part_forces_t

contains

   !> Chooses the terms and elements that any of the numbers affects.
   subroutine choose_parts(suspension, changes, self)
      type(suspension_t), intent(in) :: suspension
      type(change_t), intent(in) :: changes(:)
      type(part_forces_t), intent(out) :: self
      integer :: p

      allocate (self%has_term(size(suspension%terms)), self%has_element(size(suspension%elements)), source=.false.)
      allocate (self%terms(size(suspension%terms)), self%elements(size(suspension%elements)))
      do p = 1, size(changes)
         if (allocated(changes(p)%terms)) call mark_parts(changes(p), self%has_term, self%has_element)
      end do
   end subroutine choose_parts

   !> Computes the responses of the chosen parts at a state.
   subroutine find_responses(suspension, state, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(part_forces_t), intent(inout) :: self
      type(element_evaluation_t) :: of_element
      type(evaluation_t) :: of_measure
      integer :: k

      do k = 1, size(self%terms)
         if (.not. self%has_term(k)) cycle
         associate (m => suspension%terms(k)%measure)
            call respond_measure(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), of_measure, self%terms(k))
         end associate
      end do
      do k = 1, size(self%elements)
         if (.not. self%has_element(k)) cycle
         associate (element => suspension%elements(k), m => suspension%elements(k)%measure)
            call respond_element(element, state%poses(m%body_i + 1), state%poses(m%body_j + 1), of_element, self%elements(k))
         end associate
      end do
   end subroutine find_responses

   !> Computes ∂F/∂p at a state [N, N m; m, -, rad, per unit of p].
   !> Equation (E.7) of docs/theory/derivatives.md.
   pure subroutine find_force(suspension, state, inputs, rate, change, self, force, corner)
      type(suspension_t), intent(in) :: suspension         !! suspension of the design
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs                 !! inputs of this state
      integer, intent(in) :: rate                          !! index of the state in change%rates
      type(change_t), intent(in) :: change
      type(part_forces_t), intent(in) :: self              !! responses from find_responses, at this state
      real(wp), intent(inout) :: force(:)                  !! ∂F/∂p, one number per unknown of the system
      real(wp), intent(inout) :: corner(:)                 !! half the change of the slope of F, one number per unknown; computed
                                                           !! only with has_curves
      integer :: nq, k

      force = 0.0_wp
      if (change%has_curves) corner = 0.0_wp
      nq = suspension%unknowns()
      do k = 1, size(change%rows)
         associate (this => change%rows(k))
            force(nq + this%row) = force(nq + this%row) + this%target + this%compliance*state%reaction(this%row)
         end associate
      end do
      do k = 1, size(change%terms)
         associate (this => change%terms(k))
            call add_term(suspension%terms(this%term), state, this, self%terms(this%term), nq, force)
         end associate
      end do
      do k = 1, size(change%elements)
         associate (this => change%elements(k))
            call add_element(suspension%elements(this%element), state, this, self%elements(this%element), change, force, corner)
         end associate
      end do
      do k = 1, size(change%loads)
         call add_load(suspension, state, inputs, change%loads(k), change%weight, force)
      end do
      if (allocated(change%rates)) call add_rates(suspension, state, change%rates(rate), nq, force)
   end subroutine find_force

   !> Adds the effect of a changed term of a row to ∂F/∂p.
   pure subroutine add_term(term, state, change, response, nq, force)
      type(term_t), intent(in) :: term
      type(state_t), intent(in) :: state
      type(term_change_t), intent(in) :: change
      type(response_t), intent(in) :: response
      integer, intent(in) :: nq
      real(wp), intent(inout) :: force(:)
      real(wp) :: gradient(12), turned(12), value

      associate (m => term%measure, at => nq + change%row)
         gradient = 0.0_wp
         if (change%has_arms) then
            call add_columns(response%by_arms, term%coefficient*change%arms, gradient)
            force(at) = force(at) - term%coefficient*dot_product(response%value_by_arms, change%arms)
         end if
         if (change%has_directions) then
            call turn_directions(m, change%u, change%v, state%poses(m%body_i + 1), state%poses(m%body_j + 1), value, turned)
            gradient = gradient + term%coefficient*turned
            force(at) = force(at) - term%coefficient*value
         end if
         if (abs(change%coefficient) > 0.0_wp) then
            gradient = gradient + change%coefficient*response%gradient
            force(at) = force(at) - change%coefficient*response%value
         end if
         call add_gradient(-state%reaction(change%row), gradient, 6*(m%body_i - 1), 6*(m%body_j - 1), force)
      end associate
   end subroutine add_term

   !> Computes y ← y + columns × x.
   pure subroutine add_columns(columns, x, y)
      real(wp), intent(in) :: columns(12, 6), x(6)
      real(wp), intent(inout) :: y(12)
      integer :: k

      do k = 1, 6
         if (abs(x(k)) > 0.0_wp) y = y + columns(:, k)*x(k)
      end do
   end subroutine add_columns

   !> Adds the effect of a changed element to ∂F/∂p.
   pure subroutine add_element(element, state, change, response, all, force, corner)
      type(element_t), intent(in) :: element
      type(state_t), intent(in) :: state
      type(element_change_t), intent(in) :: change
      type(response_t), intent(in) :: response
      type(change_t), intent(in) :: all
      real(wp), intent(inout) :: force(:), corner(:)
      real(wp) :: pull(12), turned(12), load(6), moved(6), jump(6), value, bend(12), tensions(4), slope
      integer :: k

      pull = 0.0_wp
      associate (m => element%measure, i => 6*(element%measure%body_i - 1), j => 6*(element%measure%body_j - 1))
         if (change%has_arms) call add_columns(response%by_arms, change%arms, pull)
         if (allocated(change%there) .and. element%kind /= bushing_element) then       ! the markers, and so the value, stay
            do k = 1, 4
               call spring_tension(change%there(k), response%value, tensions(k), slope)
            end do
            tensions = tensions - response%tension
            pull = pull + dot_product(all%weight, tensions)*response%gradient
            bend = dot_product(all%corner, tensions)*response%gradient
            call add_gradient(-1.0_wp, bend, i, j, corner)
         else if (allocated(change%there)) then
            load = 0.0_wp
            jump = 0.0_wp
            do k = 1, 4
               moved = load_at(change%there(k), element%bushing%gap0, response) - response%load
               load = load + all%weight(k)*moved
               jump = jump + all%corner(k)*moved
            end do
            call add_columns(response%by_load, load, pull)
            bend = 0.0_wp
            call add_columns(response%by_load, jump, bend)
            call add_gradient(-1.0_wp, bend, i, j, corner)
         else if (element%kind == bushing_element) then
            load = 0.0_wp
            if (change%has_load) then
               load = change%load
               load(1:3) = load(1:3) - rotated(response%stiffness, change%gap)
            end if
            if (change%has_stiffness) then
               load(1:3) = load(1:3) + rotated(change%stiffness_t, response%gap)
               load(4:6) = load(4:6) + rotated(change%stiffness_r, response%theta)
            end if
            if (change%has_load .or. change%has_stiffness) call add_columns(response%by_load, load, pull)
         else if (change%has_load) then
            value = -change%preload - response%slope*change%reference
            if (is_linear(element)) value = value + change%rate*(response%value - element%law%reference)
            pull = pull + value*response%gradient
         end if
         if (change%has_directions .and. element%kind /= bushing_element) then
            call turn_directions(m, change%u, change%v, state%poses(m%body_i + 1), state%poses(m%body_j + 1), value, turned)
            pull = pull + response%tension*turned + response%slope*value*response%gradient
         end if
         call add_gradient(-1.0_wp, pull, i, j, force)
      end associate
   end subroutine add_element

   !> Adds the effect of a changed load to ∂F/∂p.
   pure subroutine add_load(suspension, state, inputs, change, weight, force)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(load_change_t), intent(in) :: change
      real(wp), intent(in) :: weight(4)
      real(wp), intent(inout) :: force(:)
      real(wp) :: f(3), moment(3), arm(3), f0(3), moment0(3), factor
      integer :: at, k

      factor = factor_of(suspension, inputs, change%load)
      at = 6*(suspension%loads(change%load)%body - 1)
      associate (pose => state%poses(suspension%loads(change%load)%body + 1))
         call wrench(suspension%loads(change%load), pose, f0, moment0, arm)
         do k = 1, 4
            call wrench(change%there(k), pose, f, moment, arm)
            force(at + 1:at + 3) = force(at + 1:at + 3) + factor*weight(k)*(f - f0)
            force(at + 4:at + 6) = force(at + 4:at + 6) + factor*weight(k)*(moment - moment0)
         end do
      end associate
   end subroutine add_load

   !> Adds the effect of inputs that change with the number to ∂F/∂p.
   pure subroutine add_rates(suspension, state, rates, nq, force)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: rates
      integer, intent(in) :: nq
      real(wp), intent(inout) :: force(:)
      real(wp) :: f(3), moment(3), arm(3)
      integer :: k, l, at

      do k = 1, rates%loads
         do l = rates%load(k), rates%load(k) + rates%further(k)
            associate (load => suspension%loads(l))
               if (.not. load%is_case) cycle
               call wrench(load, state%poses(load%body + 1), f, moment, arm)
               at = 6*(load%body - 1)
               force(at + 1:at + 3) = force(at + 1:at + 3) + rates%factor(k)*f
               force(at + 4:at + 6) = force(at + 4:at + 6) + rates%factor(k)*moment
            end associate
         end do
      end do
      do k = 1, rates%rows
         force(nq + rates%row(k)) = force(nq + rates%row(k)) + rates%change(k)
      end do
   end subroutine add_rates

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
   !> each direction. A distance has no direction; only a cosine has the direction v, and a contact point the axis of its wheel.
   !> Equation (E.7) of docs/theory/derivatives.md.
   pure subroutine turn_directions(measure, u, v, pose_i, pose_j, value, gradient)
      type(measure_t), intent(in) :: measure
      real(wp), intent(in) :: u(3), v(3)                 !! changes of the directions
      type(pose_t), intent(in) :: pose_i, pose_j
      real(wp), intent(out) :: value, gradient(12)
      type(measure_t) :: turned
      type(evaluation_t) :: evaluation
      real(wp) :: by_v, gradient_by_v(3)

      value = 0.0_wp
      gradient = 0.0_wp
      if (measure%kind == distance) return
      turned = measure
      turned%u = u
      call evaluate(turned, pose_i, pose_j, evaluation)
      value = evaluation%value
      gradient = evaluation%gradient
      if (measure%kind == contact_gap) then              ! turned%u is a change: the term of v is not linear
         turned%v = rotated(pose_j%a, v)
         call turn_rim(measure%u, rotated(pose_j%a, measure%v), turned%v, by_v, gradient_by_v)
         value = value + by_v
         gradient(10:12) = gradient(10:12) + gradient_by_v
         return
      end if
      if (measure%kind /= axis_axis) return
      turned%u = measure%u
      turned%v = v
      call evaluate(turned, pose_i, pose_j, evaluation)
      value = value + evaluation%value
      gradient = gradient + evaluation%gradient
   end subroutine turn_directions

end module ek_part_force
