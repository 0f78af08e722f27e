!> Contributions to the compliance matrix of a state: the share of each law of each element, of the geometric stiffness of
!> each element, joint and load, and of each driver with a stiffness.
!>
!> Let T u_j + Φᵀμ_j = b_j and Φ u_j = D μ_j for the unit load b_j, with the compliances D of the drivers on the diagonal. Let v_i
!> and ν_i be the solutions with the transpose. Then exactly
!>
!>     C_ij = v_iᵀ T u_j + ν_iᵀ D μ_j
!>
!> T is a sum: c g gᵀ of a law with slope c and gradient g, F Hess of the force F of an element, λ Hess of a row of Φ with the
!> reaction λ, the stiffness of loads that turn with their arms, and the unbalanced force of a state that is not an equilibrium.
!> The shares add up to C: no term is omitted. The derivative of C_ij with respect to the logarithm of a rate is the share of that
!> rate with the opposite sign.
module ek_contribution
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_rotation, only: skew
   use ek_block, only: add_block, r_j, pi_j
   use ek_measure, only: evaluation_t, evaluate, add_measure_hessian
   use ek_element_part, only: element_part_t, count_parts, take_apart, add_geometric_stiffness
   use ek_load, only: wrench, add_load_tangent
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t
   use ek_kkt, only: kkt_t
   use ek_compliance, only: compliance_t, unit_responses
   use ek_skew_system, only: skew_part, factor_of
   implicit none(type, external)
   private
   public :: contribution_t, share_t, new_contribution, split_compliance, block_product, local_places

   ! what a share belongs to
   integer, parameter, public :: of_element = 1, of_joint = 2, of_load = 3, of_state = 4
   ! its part: 1 to 6 the laws of an element, and
   integer, parameter, public :: geometric = 0, of_stiffness = 7

   !> The part of the model to which a contribution belongs.
   type :: share_t
      integer :: kind = of_element      !! of_element … of_state
      integer :: item = 0               !! index of the element, joint or load; 0 for of_state
      integer :: part = geometric       !! law 1 to 6 of an element; geometric; of_stiffness: of a driver
   end type share_t

   !> The contributions to the compliance matrix at one state.
   type :: contribution_t
      type(share_t), allocatable :: share(:)
      integer, allocatable :: law(:)               !! index in `share` of each law of the elements
      real(wp), allocatable :: matrix(:, :, :)     !! (displacement, load, share) at the wheel centres, global axes, SI
      real(wp), allocatable :: slope(:)            !! c of each law [N/m, N m/rad]
      real(wp), allocatable :: gradient(:, :)      !! g of each law: (unknown of all bodies, law)
      real(wp), allocatable :: move(:, :)          !! gᵀu: deflection of each law per unit load: (load, law)
      real(wp), allocatable :: left_move(:, :)     !! gᵀv: (load, law)
      real(wp), allocatable :: right(:, :), left(:, :)   !! [u; μ] and [v; ν]: (unknown, load)
   end type contribution_t

contains

   !> A list of the contributions of a model on the rig, with memory for their values.
   function new_contribution(suspension, wheels) result(self)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: wheels                !! number of wheels of the compliance matrix
      type(contribution_t) :: self
      integer :: k, part, n, rows

      allocate (self%share(0), self%law(0))
      do k = 1, size(suspension%elements)
         do part = 1, count_parts(suspension%elements(k))
            call add(of_element, k, part)
            self%law = [self%law, size(self%share)]
         end do
         call add(of_element, k, geometric)
      end do
      do k = 1, size(suspension%joints)
         call add(of_joint, k, geometric)
         rows = suspension%joints(k)%first_row
         if (any(suspension%rows(rows:rows + suspension%joints(k)%rows - 1)%compliance > 0.0_wp)) &
            call add(of_joint, k, of_stiffness)
      end do
      do k = 1, size(suspension%loads)
         if (suspension%loads(k)%start_of > 0 .and. .not. norm2(suspension%loads(k)%force) > 0.0_wp) cycle
         call add(of_load, k, geometric)
      end do
      call add(of_state, 0, geometric)
      n = 6*wheels
      allocate (self%matrix(n, n, size(self%share)), self%slope(size(self%law)), self%move(n, size(self%law)), &
         self%left_move(n, size(self%law)), self%gradient(suspension%unknowns(), size(self%law)), source=0.0_wp)

   contains

      !> Appends the contribution of an element, joint or load to the list.
      subroutine add(kind, item, part)
         integer, intent(in) :: kind, item, part
         type(share_t) :: new

         new%kind = kind
         new%item = item
         new%part = part
         self%share = [self%share, new]
      end subroutine add

   end function new_contribution

   !> Splits the compliance matrix of a state.
   !> Equation (C.15) of docs/theory/compliance.md.
   subroutine split_compliance(suspension, state, inputs, kkt, compliance, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(inout) :: kkt                  !! with residual and factors of this state: after `respond`
      type(compliance_t), intent(inout) :: compliance    !! known, after `respond`; all loads at the wheel centres requested
      type(contribution_t), intent(inout) :: self        !! of new_contribution
      integer :: k, law

      if (are_checked) call require(size(self%gradient, 1) == kkt%nq, 'split_compliance: the shares are of another model')
      call unit_responses(kkt, compliance, self%right, self%left)
      self%matrix(:, :, :) = 0.0_wp
      law = 0
      do k = 1, size(self%share)
         associate (share => self%share(k), matrix => self%matrix(:, :, k))
            select case (share%kind)
            case (of_element)
               if (share%part == geometric) then
                  call add_element(suspension, state, share%item, self%left, self%right, matrix)
               else if (share%part == 1) then
                  call add_laws(suspension, state, share%item, k, law, self)
               end if
            case (of_joint)
               if (share%part == geometric) call add_joint(suspension, state, share%item, self%left, self%right, matrix)
               if (share%part == of_stiffness) call add_driver(suspension, share%item, kkt%nq, self%left, self%right, matrix)
            case (of_load)
               call add_load(suspension, state, factor_of(suspension, inputs, share%item), share%item, self%left, self%right, &
                  matrix)
            case default
               call add_unbalanced(size(suspension%bodies), kkt%rhs, self%left, self%right, matrix)
            end select
         end associate
      end do
   end subroutine split_compliance

   !> Adds the shares of all laws of an element: c (gᵀv)(gᵀu)ᵀ.
   subroutine add_laws(suspension, state, element, first, law, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: element
      integer, intent(in) :: first                  !! index of the share of its first law
      integer, intent(inout) :: law                 !! number of laws before this element; on return, including its laws
      type(contribution_t), intent(inout) :: self
      type(element_part_t) :: parts(6)
      integer :: p, j, i, n

      n = suspension%unknowns()
      associate (this => suspension%elements(element), m => suspension%elements(element)%measure)
         call take_apart(this, state%poses(m%body_i + 1), state%poses(m%body_j + 1), parts)
         do p = 1, count_parts(this)
            law = law + 1
            self%slope(law) = parts(p)%slope
            self%gradient(:, law) = 0.0_wp
            if (m%body_i > 0) self%gradient(6*m%body_i - 5:6*m%body_i, law) = parts(p)%gradient(1:6)
            if (m%body_j > 0) self%gradient(6*m%body_j - 5:6*m%body_j, law) = &
               self%gradient(6*m%body_j - 5:6*m%body_j, law) + parts(p)%gradient(7:12)
            do j = 1, size(self%right, 2)
               self%move(j, law) = dot_product(self%gradient(:, law), self%right(:n, j))
               self%left_move(j, law) = dot_product(self%gradient(:, law), self%left(:n, j))
            end do
            do j = 1, size(self%right, 2)
               do i = 1, size(self%left, 2)
                  self%matrix(i, j, first + p - 1) = parts(p)%slope*self%left_move(i, law)*self%move(j, law)
               end do
            end do
         end do
      end associate
   end subroutine add_laws

   !> Adds the share of an element's force × Hessian.
   subroutine add_element(suspension, state, element, left, right, matrix)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: element
      real(wp), intent(in) :: left(:, :), right(:, :)
      real(wp), intent(inout) :: matrix(:, :)
      real(wp) :: blocks(6, 6, 3)

      blocks = 0.0_wp
      associate (m => suspension%elements(element)%measure)
         call add_geometric_stiffness(suspension%elements(element), state%poses(m%body_i + 1), state%poses(m%body_j + 1), &
            local_places(m%body_i, m%body_j), blocks)
         call contract(blocks, m%body_i, m%body_j, left, right, matrix)
      end associate
   end subroutine add_element

   !> Adds the share of λ Hess of all rows of a joint.
   subroutine add_joint(suspension, state, joint, left, right, matrix)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: joint
      real(wp), intent(in) :: left(:, :), right(:, :)
      real(wp), intent(inout) :: matrix(:, :)
      real(wp) :: blocks(6, 6, 3)
      type(evaluation_t) :: evaluation
      integer :: r, t

      do r = suspension%joints(joint)%first_row, suspension%joints(joint)%first_row + suspension%joints(joint)%rows - 1
         do t = suspension%rows(r)%first, suspension%rows(r)%first + suspension%rows(r)%terms - 1
            associate (m => suspension%terms(t)%measure)
               blocks = 0.0_wp
               call evaluate(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), evaluation)
               call add_measure_hessian(m%kind, evaluation, state%reaction(r)*suspension%terms(t)%coefficient, &
                  local_places(m%body_i, m%body_j), blocks)
               call contract(blocks, m%body_i, m%body_j, left, right, matrix)
            end associate
         end do
      end do
   end subroutine add_joint

   !> Adds the share of a driver with the stiffness k: ν μ/k, with the changes ν, μ of its reaction in `left` and `right`.
   subroutine add_driver(suspension, joint, nq, left, right, matrix)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: joint, nq
      real(wp), intent(in) :: left(:, :), right(:, :)
      real(wp), intent(inout) :: matrix(:, :)
      integer :: r, j

      do r = suspension%joints(joint)%first_row, suspension%joints(joint)%first_row + suspension%joints(joint)%rows - 1
         do j = 1, size(matrix, 2)
            matrix(:, j) = matrix(:, j) + suspension%rows(r)%compliance*right(nq + r, j)*left(nq + r, :)
         end do
      end do
   end subroutine add_driver

   !> Adds the share of the stiffness of a load, and of its skew part.
   subroutine add_load(suspension, state, factor, load, left, right, matrix)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: factor
      integer, intent(in) :: load
      real(wp), intent(in) :: left(:, :), right(:, :)
      real(wp), intent(inout) :: matrix(:, :)
      real(wp) :: blocks(6, 6, 3), force(3), moment(3), arm(3)
      integer :: at

      associate (this => suspension%loads(load), pose => state%poses(suspension%loads(load)%body + 1))
         blocks = 0.0_wp
         call wrench(this, pose, force, moment, arm)
         force = factor*force
         call add_load_tangent(this, pose, force, arm, 2, blocks)
         call contract(blocks, 0, this%body, left, right, matrix)
         at = 6*(this%body - 1)
         matrix = matrix + matmul(transpose(left(at + 1:at + 6, :)), &
            matmul(skew_part(this, pose, factor), right(at + 1:at + 6, :)))
      end associate
   end subroutine add_load

   !> Adds the share of the unbalanced forces, as contained in the tangent of screw motions.
   subroutine add_unbalanced(bodies, rhs, left, right, matrix)
      integer, intent(in) :: bodies
      real(wp), intent(in) :: rhs(:)
      real(wp), intent(in) :: left(:, :), right(:, :)
      real(wp), intent(inout) :: matrix(:, :)
      real(wp) :: blocks(6, 6, 3)
      integer :: body

      do body = 1, bodies
         blocks = 0.0_wp
         call add_block(-0.5_wp*skew(rhs(6*body - 5:6*body - 3)), r_j, pi_j, [0, 2, 0], blocks)
         call contract(blocks, 0, body, left, right, matrix)
      end do
   end subroutine add_unbalanced

   !> Positions of the blocks of two bodies in a store of three blocks (see ek_block); 0 for a block of the chassis.
   pure function local_places(body_i, body_j) result(at)
      integer, intent(in) :: body_i, body_j
      integer :: at(3)
      at = [merge(1, 0, body_i > 0), merge(2, 0, body_j > 0), merge(3, 0, body_i > 0 .and. body_j > 0)]
   end function local_places

   !> Computes matrix ← matrix + vᵀ T u, with T in the blocks of two bodies (see local_places).
   subroutine contract(blocks, body_i, body_j, left, right, matrix)
      real(wp), intent(in) :: blocks(6, 6, 3)
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: left(:, :), right(:, :)
      real(wp), intent(inout) :: matrix(:, :)
      real(wp) :: y(12)
      integer :: i, j

      do j = 1, size(right, 2)
         y = block_product(blocks, body_i, body_j, right(:, j))
         do i = 1, size(left, 2)
            if (body_i > 0) matrix(i, j) = matrix(i, j) + dot_product(left(6*body_i - 5:6*body_i, i), y(1:6))
            if (body_j > 0) matrix(i, j) = matrix(i, j) + dot_product(left(6*body_j - 5:6*body_j, i), y(7:12))
         end do
      end do
   end subroutine contract

   !> The product T u at the unknowns of two bodies, with T in the blocks of local_places. Blocks on the diagonal are given by their
   !> lower triangles.
   pure function block_product(blocks, body_i, body_j, u) result(y)
      real(wp), intent(in) :: blocks(6, 6, 3)
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: u(:)                  !! motions of all unknowns
      real(wp) :: y(12)

      y = 0.0_wp
      if (body_i > 0) y(1:6) = whole_product(blocks(:, :, 1), u(6*body_i - 5:6*body_i))
      if (body_j > 0) y(7:12) = whole_product(blocks(:, :, 2), u(6*body_j - 5:6*body_j))
      if (body_i > 0 .and. body_j > 0) then
         y(1:6) = y(1:6) + matmul(u(6*body_j - 5:6*body_j), blocks(:, :, 3))
         y(7:12) = y(7:12) + matmul(blocks(:, :, 3), u(6*body_i - 5:6*body_i))
      end if
   end function block_product

   !> The product of a symmetric block, given by its lower triangle, and the vector u.
   pure function whole_product(block, u) result(y)
      real(wp), intent(in) :: block(6, 6), u(6)
      real(wp) :: y(6)
      integer :: k

      do k = 1, 6
         y(k) = dot_product(block(k, :k), u(:k)) + dot_product(block(k + 1:, k), u(k + 1:))
      end do
   end function whole_product

end module ek_contribution
