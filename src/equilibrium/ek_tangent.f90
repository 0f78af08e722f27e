!> The tangent of a path at a state: how the bodies and the reactions change with the swept value.
module ek_tangent
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t, has_symmetric_loads
   use ek_state, only: state_t, inputs_t, design_state, move_as_screw, largest_motion
   use ek_kkt, only: kkt_t, assemble, assemble_rate, solve, residual_only
   use ek_motion, only: body_motion
   use ek_dyads, only: dyads_t, correct, resist
   implicit none(type, external)
   private
   public :: tangent_t, new_tangent, renew_tangent, find_tangent, is_bend

   real(wp), parameter :: bent = 5.0e-2_wp         !! error allowed in the shortest steps, as a share of the motion
   real(wp), parameter :: takes_part = 5.0e-2_wp   !! share of the largest motion: above this share, the direction of a body's
                                                   !! motion is checked
   real(wp), parameter :: min_cosine = 0.5_wp    !! least cosine between the directions of a body at both ends of a bend: 60 deg

   !> Work space, and whether the loads leave the true matrix symmetric.
   type :: tangent_t
      private
      real(wp), allocatable :: whole(:), defect(:)         !! tangent [Δq; Δλ] per swept value; a right-hand side
      real(wp), allocatable :: twist(:)                    !! twists of the bodies [m, rad]
      logical :: is_symmetric = .true.      !! no load makes the tangent unsymmetric
      type(state_t) :: shifted
   end type tangent_t

contains

   !> The work space of find_tangent for a model.
   function new_tangent(suspension) result(self)
      type(suspension_t), intent(in) :: suspension
      type(tangent_t) :: self

      allocate (self%whole(suspension%unknowns() + suspension%constraints()), &
         self%defect(suspension%unknowns() + suspension%constraints()), self%twist(suspension%unknowns()), source=0.0_wp)
      self%shifted = design_state(suspension)
      self%is_symmetric = has_symmetric_loads(suspension)
   end function new_tangent

   !> Renews the work space for other numbers of the model.
   pure subroutine renew_tangent(suspension, self)
      type(suspension_t), intent(in) :: suspension
      type(tangent_t), intent(inout) :: self      !! of new_tangent, for the same model
      self%is_symmetric = has_symmetric_loads(suspension)
   end subroutine renew_tangent

   !> Whether the motion lies between the tangents at both ends (within `bent`), and no body changes its direction of motion by more
   !> than 60 deg.
   pure logical function is_bend(motion, tangent_a, tangent_b, width, length)
      real(wp), contiguous, intent(in) :: motion(:), tangent_a(:), tangent_b(:)
      real(wp), intent(in) :: width, length
      real(wp) :: share, rest, along, square, twist(6), change(6), scale(6), largest, a, b
      integer :: k

      is_bend = .false.
      scale = [1.0_wp, 1.0_wp, 1.0_wp, length, length, length]
      largest = largest_motion(motion, length)
      along = 0.0_wp
      square = 0.0_wp
      do k = 1, size(motion), 6
         twist = (motion(k:k + 5) - width*tangent_b(k:k + 5))*scale
         change = width*(tangent_a(k:k + 5) - tangent_b(k:k + 5))*scale
         along = along + dot_product(twist, change)
         square = square + dot_product(change, change)
      end do
      if (.not. square < huge(square)) return
      share = 0.5_wp
      if (square > 0.0_wp) share = min(max(along/square, 0.0_wp), 1.0_wp)
      rest = 0.0_wp
      do k = 1, size(motion), 6
         twist = motion(k:k + 5) - width*(share*tangent_a(k:k + 5) + (1.0_wp - share)*tangent_b(k:k + 5))
         rest = max(rest, body_motion(twist, length))
         if (body_motion(motion(k:k + 5), length) < takes_part*largest) cycle
         a = norm2(tangent_a(k:k + 5)*scale)
         b = norm2(tangent_b(k:k + 5)*scale)
         if (dot_product(tangent_a(k:k + 5)*scale, tangent_b(k:k + 5)*scale) < min_cosine*a*b) return
      end do
      is_bend = rest <= bent*largest
   end function is_bend

   !> Computes the tangent dz/ds = N⁻¹ ∂F/∂s of bodies and reactions at a state, with the current factors of N (symbols as in
   !> ek_branch).
   !>
   !> With a constant moment, a load that rotates with its body, or the imbalance at design, the true matrix is not symmetric and N
   !> is its symmetric part. The derivative of the residual along the tangent then corrects the tangent.
   !> A singular N has no tangent: is_found is .false. and the tangent is zero.
   !> Equation (K.13) of docs/theory/kkt.md.
   subroutine find_tangent(self, suspension, state, inputs, rate, kkt, tangent, is_found, dyads)
      type(tangent_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs, rate
      type(kkt_t), intent(inout) :: kkt
      real(wp), intent(out) :: tangent(:)
      logical, intent(out) :: is_found                    !! N is not singular
      type(dyads_t), intent(inout), optional :: dyads     !! the matrix is N plus these dyads
      integer, parameter :: max_refinements = 6
      real(wp), parameter :: enough = 4.0e-4_wp           ! of the motion: a tenth of what a comparison of tangents allows
      real(wp), parameter :: small_motion = 1.0e-6_wp     ! of the characteristic length: the difference's step
      real(wp) :: step, largest
      integer :: k

      is_found = .not. kkt%is_singular
      if (.not. is_found) then
         tangent = 0.0_wp
         return
      end if
      call assemble_rate(suspension, state, rate, kkt)
      call solve(kkt)
      if (present(dyads)) call correct(dyads, kkt%rhs)
      self%whole = kkt%rhs
      if (self%is_symmetric .and. .not. abs(rate%homotopy) > 0.0_wp) then
         tangent = self%whole
         return
      end if
      do k = 1, max_refinements
         largest = largest_motion(self%whole(:kkt%nq), kkt%length)
         if (.not. (largest > 0.0_wp .and. largest < huge(largest))) exit
         step = small_motion*kkt%length/largest
         call shifted_residual(step)
         self%defect = kkt%rhs
         call shifted_residual(-step)
         self%defect = (self%defect - kkt%rhs)/(2.0_wp*step)
         if (present(dyads)) call resist(dyads, self%whole, self%defect)
         call assemble_rate(suspension, state, rate, kkt)
         kkt%rhs = kkt%rhs + self%defect
         call solve(kkt)
         if (present(dyads)) call correct(dyads, kkt%rhs)
         self%whole = self%whole + kkt%rhs
         if (largest_motion(kkt%rhs(:kkt%nq), kkt%length) <= enough*largest) exit
      end do
      tangent = self%whole

   contains

      !> Computes the residual at a small distance along the tangent, with the same inputs.
      subroutine shifted_residual(distance)
         real(wp), intent(in) :: distance     !! swept value

         self%shifted = state
         self%shifted%reaction = state%reaction + distance*self%whole(kkt%nq + 1:)
         self%twist = distance*self%whole(:kkt%nq)
         call move_as_screw(self%shifted, self%twist)
         call assemble(suspension, self%shifted, inputs, residual_only, kkt)
      end subroutine shifted_residual

   end subroutine find_tangent

end module ek_tangent
