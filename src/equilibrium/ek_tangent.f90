!> The tangent of a path at a state: how the bodies and the reactions change with the swept value.
module ek_tangent
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t, has_symmetric_loads
   use ek_state, only: state_t, inputs_t, design_state, move_as_screw, largest_motion
   use ek_kkt, only: kkt_t, assemble, assemble_rate, solve, residual_only
   use ek_dyads, only: dyads_t, correct, resist
   implicit none(type, external)
   private
   public :: tangent_t, new_tangent, find_tangent, body_motion, trapezoidal_rest

   real(wp), parameter, public :: smooth = 4.0e-3_wp      !! of the motion: allowed error of the trapezoidal rule
   real(wp), parameter :: nothing = 1.0e-9_wp     !! m: ten times the error of Newton's method

   !> Work space, and what the loads do to the matrix.
   type :: tangent_t
      private
      real(wp), allocatable :: whole(:), defect(:)         !! [Δq; Δλ] per place, and a right-hand side
      real(wp), allocatable :: twist(:)                    !! of the bodies [m, rad]
      logical :: is_symmetric = .true.      !! no load makes the tangent unsymmetric
      type(state_t) :: shifted
   end type tangent_t

contains

   !> Allocates the work space for a model.
   function new_tangent(suspension) result(self)
      type(suspension_t), intent(in) :: suspension
      type(tangent_t) :: self

      allocate (self%whole(suspension%unknowns() + suspension%constraints()), &
         self%defect(suspension%unknowns() + suspension%constraints()), self%twist(suspension%unknowns()), source=0.0_wp)
      self%shifted = design_state(suspension)
      self%is_symmetric = has_symmetric_loads(suspension)
   end function new_tangent

   !> |Δr|, or |Δπ| × characteristic length, of a body [m].
   pure real(wp) function body_motion(twist, length)
      real(wp), intent(in) :: twist(6), length
      body_motion = sqrt(max(sum(twist(1:3)**2), length**2*sum(twist(4:6)**2)))
   end function body_motion

   !> The error of the trapezoidal rule as a share of the motion; huge if it is not a number.
   !> Equation (K.14) of docs/theory/kkt.md.
   pure real(wp) function trapezoidal_rest(motion, tangent_a, tangent_b, width, length) result(rest)
      real(wp), contiguous, intent(in) :: motion(:), tangent_a(:), tangent_b(:)
      real(wp), intent(in) :: width, length
      real(wp) :: twist(6), part
      integer :: k

      rest = 0.0_wp
      do k = 1, size(motion), 6
         twist = motion(k:k + 5) - 0.5_wp*width*(tangent_a(k:k + 5) + tangent_b(k:k + 5))
         part = body_motion(twist, length)
         if (.not. part < huge(rest)) part = huge(rest)
         rest = max(rest, part)
      end do
      if (rest <= nothing*smooth) then
         rest = 0.0_wp
      else if (rest < huge(rest)) then
         rest = rest/max(largest_motion(motion, length), nothing)
      end if
   end function trapezoidal_rest

   !> dz/ds = N⁻¹ dF/ds at a state, with the current factors; the part for the bodies.
   !>
   !> With a constant moment, a load that rotates with its body, or the imbalance at design, the true matrix is not
   !> symmetric and N is its symmetric part. The derivative of the residual along the tangent then corrects it.
   !> Equation (K.13) of docs/theory/kkt.md.
   subroutine find_tangent(self, suspension, state, inputs, rate, kkt, tangent, dyads)
      type(tangent_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs, rate
      type(kkt_t), intent(inout) :: kkt
      real(wp), intent(out) :: tangent(:)
      type(dyads_t), intent(inout), optional :: dyads     !! the matrix is N plus these
      integer, parameter :: max_refinements = 6
      real(wp), parameter :: enough = 4.0e-4_wp           ! of the motion: a tenth of what a comparison of tangents allows
      real(wp), parameter :: small_motion = 1.0e-6_wp     ! of the characteristic length: the difference's step
      real(wp) :: step, largest
      integer :: k

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

      !> The residual at a small distance along the tangent, with the same inputs.
      subroutine shifted_residual(distance)
         real(wp), intent(in) :: distance     !! place

         self%shifted = state
         self%shifted%reaction = state%reaction + distance*self%whole(kkt%nq + 1:)
         self%twist = distance*self%whole(:kkt%nq)
         call move_as_screw(self%shifted, self%twist)
         call assemble(suspension, self%shifted, inputs, residual_only, kkt)
      end subroutine shifted_residual

   end subroutine find_tangent

end module ek_tangent
