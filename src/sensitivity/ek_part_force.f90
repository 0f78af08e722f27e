!> ∂F/∂p at a state: the changes of the parts that a number p of the deck affects, times the responses of these parts at the state.
!> F is the right-hand side of the equations of the state (ek_kkt).
!>
!> The cost of ∂F/∂p is thus proportional to the number of affected parts, and no digits are lost in differences of large forces.
!> Only a law that is not linear in its numbers (a curve, a rounded contact) is evaluated in each of the neighbouring designs, at
!> the deflection of the state.
module ek_part_force
   use ek_kinds, only: wp
   use ek_block, only: rotated, add_gradient
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t
   use ek_element, only: element_t, bushing_element, is_linear
   use ek_element_force, only: element_evaluation_t, spring_tension
   use ek_measure, only: evaluation_t
   use ek_row, only: term_t
   use ek_load, only: wrench
   use ek_skew_system, only: factor_of
   use ek_part_change, only: change_t, term_change_t, element_change_t, load_change_t, mark_parts
   use ek_part_response, only: response_t, respond_element, respond_measure, load_at, turn_directions
   implicit none(type, external)
   private
   public :: part_forces_t, choose_parts, find_responses, find_force

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
      integer :: k, at

      do k = 1, rates%loads
         associate (load => suspension%loads(rates%load(k)))
            if (.not. load%is_case) cycle
            call wrench(load, state%poses(load%body + 1), f, moment, arm)
            at = 6*(load%body - 1)
            force(at + 1:at + 3) = force(at + 1:at + 3) + rates%factor(k)*f
            force(at + 4:at + 6) = force(at + 4:at + 6) + rates%factor(k)*moment
         end associate
      end do
      do k = 1, rates%rows
         force(nq + rates%row(k)) = force(nq + rates%row(k)) + rates%change(k)
      end do
   end subroutine add_rates

end module ek_part_force
