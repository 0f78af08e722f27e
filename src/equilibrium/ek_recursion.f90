!> One load increment: the paper's linear recursive formula, and its corrected form.
module ek_recursion
   use ek_kinds, only: wp
   use ek_vector, only: add_multiple
   use ek_block, only: add_gradient
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t, inputs_rate, move, move_as_screw
   use ek_kkt, only: kkt_t, assemble, assemble_rate, factorise, solve, whole_tangent, material_only
   use ek_reach, only: failure_t
   implicit none(type, external)
   private
   public :: start_recursion, recursive_increment, corrected_increment, check_increment

contains

   !> Starts the recursion before the first increment: λ⁻¹ is the reaction in the design state (zero without preloads and
   !> constant loads).
   !>
   !> λ⁻¹ is the λ of [K Φqᵀ; Φq −C][Δq; λ] = [f_ext − f_el; c − Φ] at design; Δq vanishes if the preloads balance the constant
   !> loads.
   !> Equation (K.8) of docs/theory/kkt.md.
   subroutine start_recursion(suspension, state, kkt, held)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(inout) :: state
      type(kkt_t), intent(inout) :: kkt
      real(wp), allocatable, intent(out) :: held(:)      !! Φq(qⁿ⁻¹)ᵀ λⁿ⁻¹ [N, N m]: passed from increment to increment

      allocate (held(kkt%nq), source=0.0_wp)
      state%reaction = 0.0_wp
      call assemble(suspension, state, inputs_t(), material_only, kkt)
      call solve_and_hold(suspension, state, kkt, held)
   end subroutine start_recursion

   !> Computes one increment of Kang (2005), eqs. (25)–(29), literally:
   !>
   !>     [K(qⁿ) Φqᵀ; Φq −C][Δqⁿ; λⁿ] = [Δf; Δc] + [Φq(qⁿ⁻¹)ᵀ λⁿ⁻¹; −Cλⁿ⁻¹],  K = −(19)
   !>
   !> C is not in the paper: 1/stiffness of a driver with a stiffness, zero otherwise. The increment never evaluates the elastic
   !> forces or Φ(q) in the new configuration; this is a property of the paper's formula.
   !> Equations (K.8), (K.9) of docs/theory/kkt.md.
   pure subroutine recursive_increment(suspension, before, after, state, kkt, held)
      type(suspension_t), intent(in) :: suspension
      type(inputs_t), intent(in) :: before, after     !! the inputs at both ends, with the same items in the same order
      type(state_t), intent(inout) :: state
      type(kkt_t), intent(inout) :: kkt
      real(wp), intent(inout) :: held(:)              !! of start_recursion
      integer :: k

      call assemble(suspension, state, before, material_only, kkt)
      call assemble_rate(suspension, state, inputs_rate(before, after, 1.0_wp), kkt)
      call add_multiple(kkt%nq, 1.0_wp, held, kkt%rhs)
      do k = 1, kkt%nc
         kkt%rhs(kkt%nq + k) = kkt%rhs(kkt%nq + k) - suspension%rows(k)%compliance*state%reaction(k)
      end do
      call solve_and_hold(suspension, state, kkt, held)
      if (.not. kkt%is_singular) call move(state, kkt%rhs(:kkt%nq))
   end subroutine recursive_increment

   !> Makes one full Newton step towards the next inputs. The matrix has the size of the recursive formula, with one solution.
   !>
   !>     [T Φqᵀ; Φq −C][Δq; Δλ] = [f_ext(Fₙ₊₁, qⁿ) − f_el(qⁿ) − Φqᵀλⁿ; cₙ₊₁ − Φ(qⁿ) + Cλⁿ]
   !>
   !> Equation (K.10) of docs/theory/kkt.md.
   pure subroutine corrected_increment(suspension, after, state, kkt)
      type(suspension_t), intent(in) :: suspension
      type(inputs_t), intent(in) :: after
      type(state_t), intent(inout) :: state
      type(kkt_t), intent(inout) :: kkt

      call assemble(suspension, state, after, whole_tangent, kkt)
      call factorise(kkt)
      if (kkt%is_singular) return
      call solve(kkt)
      call add_multiple(kkt%nc, 1.0_wp, kkt%rhs(kkt%nq + 1:), state%reaction)
      call move_as_screw(state, kkt%rhs(:kkt%nq))
   end subroutine corrected_increment

   !> Solves the assembled system for the new λ, and computes Φqᵀλ. Nothing changes if the matrix is singular.
   pure subroutine solve_and_hold(suspension, state, kkt, held)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(inout) :: state
      type(kkt_t), intent(inout) :: kkt
      real(wp), intent(inout) :: held(:)
      integer :: k, t

      call factorise(kkt)
      if (kkt%is_singular) return
      call solve(kkt)
      state%reaction(:) = kkt%rhs(kkt%nq + 1:)
      held = 0.0_wp
      do k = 1, size(suspension%rows)
         do t = suspension%rows(k)%first, suspension%rows(k)%first + suspension%rows(k)%terms - 1
            associate (m => suspension%terms(t)%measure)
               call add_gradient(state%reaction(k), kkt%gradients(:, t), 6*(m%body_i - 1), 6*(m%body_j - 1), held)
            end associate
         end do
      end do
   end subroutine solve_and_hold

   !> Checks an increment of the linear methods. The increment has failed if the matrix was singular or a body moved too far.
   subroutine check_increment(kkt, state_number, before, value, failure)
      type(kkt_t), intent(in) :: kkt
      integer, intent(in) :: state_number
      real(wp), intent(in) :: before, value      !! swept value at either end of the increment
      type(failure_t), intent(inout) :: failure
      real(wp), parameter :: far = 3.0_wp        ! m: no suspension moves that far, certainly not in one increment
      real(wp) :: moved
      integer :: k

      if (.not. kkt%is_singular) then
         do k = 1, kkt%nq/6
            moved = norm2(kkt%rhs(6*k - 5:6*k - 3))
            if (moved <= failure%moved) cycle
            failure%moved = moved
            failure%body = k
         end do
         if (failure%moved <= far) then
            failure%moved = 0.0_wp
            return
         end if
      end if
      failure%state = state_number
      failure%is_singular = kkt%is_singular
      failure%value = value
      failure%reached = before
   end subroutine check_increment

end module ek_recursion
