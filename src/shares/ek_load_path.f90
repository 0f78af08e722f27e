!> The paths of a load through a suspension: the change of force and moment in every element and joint per unit force at a contact
!> point.
!>
!> An element or joint with the energy V exerts −dV/dz on its bodies. Under a motion u of the bodies, the generalised force changes
!> by T_e u in exponential coordinates. The moment about global axes changes by ½ π×m more, m = dV/dπ (see ek_skew_system). Force
!> and moment are given as in the table of states: on the second body, at the point of the item, which moves with that body.
!> Equation (C.18) of docs/theory/compliance.md.
module ek_load_path
   use ek_kinds, only: wp
   use ek_rotation, only: cross, skew
   use ek_block, only: rotated, add_block, r_j, pi_j
   use ek_wheel_contact, only: contact_arm
   use ek_measure, only: evaluation_t, evaluate, add_measure_hessian
   use ek_element_part, only: element_part_t, count_parts, take_apart, add_geometric_stiffness
   use ek_element_force, only: element_evaluation_t, evaluate_element
   use ek_load, only: wrench, add_load_tangent
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t
   use ek_kkt, only: kkt_t
   use ek_compliance, only: compliance_t
   use ek_contribution, only: contribution_t, block_product, local_places
   use ek_port_response, only: load_at_patch
   use ek_skew_system, only: skew_part, factor_of
   implicit none(type, external)
   private
   public :: load_path_t, find_load_paths

   !> The load paths of all items of a model: first its elements, then its joints.
   type :: load_path_t
      real(wp), allocatable :: force(:, :, :)       !! (axis, load, item): on the second body, global axes [N/N]
      real(wp), allocatable :: moment(:, :, :)      !! (axis, load, item): at the point of the second body [N m/N]
      real(wp) :: unbalanced = 0.0_wp               !! largest unbalanced force [N/N] or moment [N m/N] on a body
   end type load_path_t

   !> The generalised force of an element or joint on its two bodies, and the change of this force under a motion u.
   type :: change_t
      real(wp) :: now(12) = 0.0_wp                  !! dV/dz at the state
      real(wp) :: more(12) = 0.0_wp                 !! change T_e u of dV/dz
   end type change_t

contains

   !> Finds the paths of unit forces along x, y, z at each contact point, in the order of the compliance matrix.
   !> Equation (C.18) of docs/theory/compliance.md.
   subroutine find_load_paths(suspension, state, inputs, kkt, compliance, shares, arm, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(in) :: kkt                     !! with the residual of this state
      type(compliance_t), intent(in) :: compliance
      type(contribution_t), intent(in) :: shares         !! of split_compliance, at this state
      real(wp), intent(in) :: arm(:, :)                  !! contact point less wheel centre, of each wheel in the order of C [m]
      type(load_path_t), intent(inout) :: self
      real(wp) :: moves(size(shares%right, 1), size(shares%right, 2)), sum_of(suspension%unknowns())
      type(change_t) :: change
      integer :: k, w, x, load, elements, items

      elements = size(suspension%elements)
      items = elements + size(suspension%joints)
      if (.not. allocated(self%force)) &
         allocate (self%force(3, 3*compliance%wheels, items), self%moment(3, 3*compliance%wheels, items))
      moves = load_at_patch(shares%right, arm)
      self%unbalanced = 0.0_wp
      do w = 1, compliance%wheels
         do x = 1, 3
            load = 3*(w - 1) + x
            associate (u => moves(:, 6*(w - 1) + x))
               sum_of = 0.0_wp
               do k = 1, items
                  if (k <= elements) then
                     call change_element(suspension, state, k, u, change)
                     associate (m => suspension%elements(k)%measure)
                        call place(state, m%body_i, m%body_j, m%arm_j, u, change, self%force(:, load, k), self%moment(:, load, k))
                        call add(m%body_i, m%body_j, change%more, sum_of)
                     end associate
                  else
                     call change_joint(suspension, state, k - elements, kkt%nq, u, sum_of, self%force(:, load, k), &
                        self%moment(:, load, k))
                  end if
               end do
               call add_loads(suspension, state, inputs, kkt%rhs, u, sum_of)
               call take_load(suspension, state, compliance%order(w), x, sum_of)
               self%unbalanced = max(self%unbalanced, maxval(abs(sum_of)))
            end associate
         end do
      end do
   end subroutine find_load_paths

   !> Computes dV/dz of an element, and its change T_e u.
   subroutine change_element(suspension, state, element, u, change)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: element
      real(wp), intent(in) :: u(:)
      type(change_t), intent(out) :: change
      type(element_part_t) :: parts(6)
      type(element_evaluation_t) :: evaluation
      real(wp) :: blocks(6, 6, 3), both(12)
      integer :: p

      associate (this => suspension%elements(element), m => suspension%elements(element)%measure)
         associate (pose_i => state%poses(m%body_i + 1), pose_j => state%poses(m%body_j + 1))
            call evaluate_element(this, pose_i, pose_j, evaluation)
            change%now = evaluation%generalised_force
            blocks = 0.0_wp
            call add_geometric_stiffness(this, pose_i, pose_j, local_places(m%body_i, m%body_j), blocks)
            change%more = block_product(blocks, m%body_i, m%body_j, u)
            call take_apart(this, pose_i, pose_j, parts)
            both = of_bodies(m%body_i, m%body_j, u)
            do p = 1, count_parts(this)
               change%more = change%more + (parts(p)%slope*dot_product(parts(p)%gradient, both))*parts(p)%gradient
            end do
         end associate
      end associate
   end subroutine change_element

   !> Adds Φᵀμ + λ Hess u of a joint to the sum, and finds the changes of force and moment of the joint. For a joint of measures,
   !> force and moment are the changes in the first measure.
   subroutine change_joint(suspension, state, joint, nq, u, sum_of, force, moment)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: joint, nq
      real(wp), intent(in) :: u(:)
      real(wp), intent(inout) :: sum_of(:)
      real(wp), intent(out) :: force(3), moment(3)
      type(change_t) :: change, whole
      type(evaluation_t) :: evaluation
      real(wp) :: blocks(6, 6, 3), arm(3)
      integer :: r, t, first

      associate (this => suspension%joints(joint))
         first = suspension%rows(this%first_row)%first
         do r = this%first_row, this%first_row + this%rows - 1
            do t = suspension%rows(r)%first, suspension%rows(r)%first + suspension%rows(r)%terms - 1
               associate (m => suspension%terms(t)%measure, factor => suspension%terms(t)%coefficient)
                  blocks = 0.0_wp
                  call evaluate(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), evaluation)
                  call add_measure_hessian(m%kind, evaluation, state%reaction(r)*factor, local_places(m%body_i, m%body_j), blocks)
                  change%now = state%reaction(r)*factor*evaluation%gradient
                  change%more = block_product(blocks, m%body_i, m%body_j, u) + u(nq + r)*factor*evaluation%gradient
                  call add(m%body_i, m%body_j, change%more, sum_of)
                  if (this%is_of_measures .and. t /= first) cycle
                  whole%now = whole%now + change%now
                  whole%more = whole%more + change%more
               end associate
            end do
         end do
         associate (m => suspension%terms(first)%measure)
            arm = this%arm_j
            if (this%is_of_measures) arm = m%arm_j
            call place(state, m%body_i, m%body_j, arm, u, whole, force, moment)
         end associate
      end associate
   end subroutine change_joint

   !> Computes the change of force and moment on the second body, at the point of this body.
   subroutine place(state, body_i, body_j, arm_j, u, change, force, moment)
      type(state_t), intent(in) :: state
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: arm_j(3)              !! point from the reference point of the body, body axes [m]
      real(wp), intent(in) :: u(:)
      type(change_t), intent(in) :: change
      real(wp), intent(out) :: force(3), moment(3)
      real(wp) :: lever(3), turn(3), now(3)
      integer :: at

      if (body_j > 0) then
         at = 6*(body_j - 1)
         turn = u(at + 4:at + 6)
         lever = rotated(state%poses(body_j + 1)%a, arm_j)
         now = -change%now(7:9)
         force = -change%more(7:9)
         moment = -(change%more(10:12) - 0.5_wp*cross(change%now(10:12), turn))
         moment = moment - cross(cross(turn, lever), now) - cross(lever, force)
      else
         ! on the chassis: minus that on the first body, at a point of the chassis
         at = 6*(body_i - 1)
         turn = u(at + 4:at + 6)
         lever = state%poses(body_i + 1)%r - (state%poses(1)%r + arm_j)
         now = -change%now(1:3)
         force = -change%more(1:3)
         moment = -(change%more(4:6) - 0.5_wp*cross(change%now(4:6), turn))
         moment = moment + cross(u(at + 1:at + 3), now) + cross(lever, force)
         force = -force
         moment = -moment
      end if
   end subroutine place

   !> Adds the products of u with the stiffness of loads and with the unbalanced force.
   subroutine add_loads(suspension, state, inputs, rhs, u, sum_of)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      real(wp), intent(in) :: rhs(:), u(:)
      real(wp), intent(inout) :: sum_of(:)
      real(wp) :: blocks(6, 6, 3), force(3), moment(3), arm(3), factor
      integer :: k, at

      do k = 1, size(suspension%loads)
         associate (load => suspension%loads(k))
            factor = factor_of(suspension, inputs, k)
            at = 6*(load%body - 1)
            blocks = 0.0_wp
            call wrench(load, state%poses(load%body + 1), force, moment, arm)
            force = factor*force
            call add_load_tangent(load, state%poses(load%body + 1), force, arm, 2, blocks)
            call add(0, load%body, block_product(blocks, 0, load%body, u), sum_of)
            sum_of(at + 1:at + 6) = sum_of(at + 1:at + 6) + matmul(skew_part(load, state%poses(load%body + 1), factor), &
               u(at + 1:at + 6))
         end associate
      end do
      do k = 1, size(suspension%bodies)
         blocks = 0.0_wp
         call add_block(-0.5_wp*skew(rhs(6*k - 5:6*k - 3)), r_j, pi_j, [0, 2, 0], blocks)
         call add(0, k, block_product(blocks, 0, k, u), sum_of)
      end do
   end subroutine add_loads

   !> Subtracts the unit force at a contact point from the sum.
   subroutine take_load(suspension, state, wheel, axis, sum_of)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: wheel, axis
      real(wp), intent(inout) :: sum_of(:)
      real(wp) :: force(3)
      integer :: at

      force = 0.0_wp
      force(axis) = 1.0_wp
      associate (this => suspension%wheels(wheel))
         at = 6*(this%body - 1)
         sum_of(at + 1:at + 3) = sum_of(at + 1:at + 3) - force
         sum_of(at + 4:at + 6) = sum_of(at + 4:at + 6) - cross(contact_arm(this, state%poses(this%body + 1)%a), force)
      end associate
   end subroutine take_load

   !> Adds a generalised force on two bodies to the sum.
   pure subroutine add(body_i, body_j, y, sum_of)
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: y(12)
      real(wp), intent(inout) :: sum_of(:)

      if (body_i > 0) sum_of(6*body_i - 5:6*body_i) = sum_of(6*body_i - 5:6*body_i) + y(1:6)
      if (body_j > 0) sum_of(6*body_j - 5:6*body_j) = sum_of(6*body_j - 5:6*body_j) + y(7:12)
   end subroutine add

   !> The unknowns of two bodies; 0 for the chassis.
   pure function of_bodies(body_i, body_j, u) result(both)
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: u(:)
      real(wp) :: both(12)

      both = 0.0_wp
      if (body_i > 0) both(1:6) = u(6*body_i - 5:6*body_i)
      if (body_j > 0) both(7:12) = u(6*body_j - 5:6*body_j)
   end function of_bodies

end module ek_load_path
