!> Finds a state of equilibrium by Newton's method from an initial guess.
!>
!> Each iteration assembles N, factorises it once, and takes one full step. After a small step, the same factors are reused for
!> cheaper steps with new residuals, as long as each step is much shorter than the previous step. The length of the last step
!> estimates the remaining error, so convergence is measured, not assumed.
module ek_newton
   use ek_kinds, only: wp
   use ek_vector, only: add_multiple
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t, move_as_screw, largest_motion
   use ek_kkt, only: kkt_t, holds, assemble, factorise, solve, whole_tangent, residual_only
   implicit none(type, external)
   private
   public :: outcome_t, find_equilibrium, ends_here
   public :: max_iterations, max_chords, rest, good_chord

   integer, parameter :: max_iterations = 15   !! largest number of iterations: Newton's method does not need more
   integer, parameter :: max_chords = 4        !! largest number of steps with old factors: three cost less than one factorisation
   real(wp), parameter :: rest = 1.0e-6_wp      !! allowed error of a state found with old factors, as a share of the tolerance
   ! × step²/characteristic length: the error that a full step leaves. Some 0.2 on a smooth path, 130 in the stops of the examples;
   ! near the end of a path, where the stiffness vanishes, 200 has let 1e-12 m pass
   real(wp), parameter :: curvature = 2.0e4_wp
   real(wp), parameter :: good_chord = 0.03_wp  !! limit of step / previous step: above it, new factors are cheaper

   !> The outcome of an iteration.
   type :: outcome_t
      logical :: is_converged = .false.
      logical :: is_singular = .false.    !! a matrix could not be factorised
      integer :: factorisations = 0
      real(wp) :: first = 0.0_wp          !! length of the first correction: error of the guess [m]
      real(wp) :: missed = 0.0_wp         !! distance of the last factors from the result [m]
      real(wp) :: last = 0.0_wp           !! length of the last correction [m]
      integer :: negative = 0             !! negative eigenvalues of the last matrix
      real(wp) :: pivot_ratio = 1.0_wp    !! cheap condition estimate of the last matrix
      real(wp) :: log_determinant = 0.0_wp   !! ln |det| of the last matrix
   end type outcome_t

contains

   !> Iterates by Newton's method until the last correction of every body is within `tolerance` [m, rad × characteristic length].
   !> With a plan of elimination, `ends_here` decides after a full step.
   !> Equation (K.10) of docs/theory/kkt.md.
   pure subroutine find_equilibrium(suspension, inputs, tolerance, state, kkt, outcome)
      type(suspension_t), intent(in) :: suspension
      type(inputs_t), intent(in) :: inputs
      real(wp), intent(in) :: tolerance       !! m
      type(state_t), intent(inout) :: state   !! guess → equilibrium
      type(kkt_t), intent(inout) :: kkt
      type(outcome_t), intent(out) :: outcome
      real(wp) :: largest, previous, before
      integer :: iteration, chord
      logical :: is_done

      ! a correction longer than a quarter of the mechanism is useless: halve the increment
      largest = 0.25_wp*kkt%length + 0.05_wp
      previous = huge(previous)
      do iteration = 1, max_iterations
         if (.not. holds(kkt, suspension, state, inputs)) then
            call assemble(suspension, state, inputs, whole_tangent, kkt)
            call factorise(kkt)
         end if
         outcome%factorisations = iteration
         outcome%negative = kkt%negative
         outcome%pivot_ratio = kkt%pivot_ratio
         outcome%log_determinant = kkt%log_determinant
         outcome%is_singular = kkt%is_singular
         if (outcome%is_singular) return
         call take_step(state, kkt, huge(largest), outcome%last)
         if (iteration == 1) outcome%first = outcome%last
         outcome%missed = outcome%last      ! what follows is shorter
         if (.not. outcome%last <= largest) return      ! also if it is not a number
         outcome%is_converged = outcome%last <= tolerance
         if (kkt%has_plan) outcome%is_converged = ends_here(outcome%last, tolerance, kkt%length)
         if (outcome%is_converged) return
         if (0.5_wp*outcome%last > previous) return   ! not 2*previous: huge at first
         previous = outcome%last
         is_done = .false.
         do chord = 1, max_chords
            if (.not. outcome%last < 0.01_wp*kkt%length) exit
            before = outcome%last
            call assemble(suspension, state, inputs, residual_only, kkt)
            call take_step(state, kkt, before, outcome%last)
            if (.not. outcome%last <= good_chord*before) exit
            ! the next step would be shorter by the same ratio
            is_done = outcome%last**2 <= rest*tolerance*before
            if (is_done) exit
         end do
         if (is_done) exit
      end do
      outcome%is_converged = outcome%last <= tolerance
   end subroutine find_equilibrium

   !> Whether the iteration ends with this full step: the step is within the tolerance, or the estimated remaining error is within
   !> the error allowed with old factors (`rest` × tolerance).
   pure logical function ends_here(step, tolerance, length)
      real(wp), intent(in) :: step, tolerance   !! m
      real(wp), intent(in) :: length            !! characteristic length [m]
      ends_here = step <= tolerance .or. curvature*step**2 <= rest*tolerance*length
   end function ends_here

   !> Solves with the current factors, measures the step, and moves the state unless the step is too long.
   pure subroutine take_step(state, kkt, limit, length)
      type(state_t), intent(inout) :: state
      type(kkt_t), intent(inout) :: kkt
      real(wp), intent(in) :: limit       !! m
      real(wp), intent(out) :: length     !! largest |Δr|, |Δπ| × characteristic length [m]

      call solve(kkt)
      length = largest_motion(kkt%rhs(:kkt%nq), kkt%length)
      if (.not. length < limit) return
      call add_multiple(kkt%nc, 1.0_wp, kkt%rhs(kkt%nq + 1:), state%reaction)
      call move_as_screw(state, kkt%rhs(:kkt%nq))
   end subroutine take_step

end module ek_newton
