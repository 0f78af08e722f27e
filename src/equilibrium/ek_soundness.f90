!> A cheap proof that the diagnosis would not report a defect of a model: one factorisation instead of the decompositions of the
!> diagnosis.
!>
!> Let v be a motion that counts as a mechanism, or y a row of forces that counts as redundant. Then the scaled KKT matrix S gives
!> |S z| ≤ s |z| for z = (v, μ) or (0, y). s is the limit below which `diagnose` counts a stiffness or a singular value as zero. So
!> |S⁻¹| ≥ 1/s, and a condition number that is small enough excludes both v and y:
!>
!>     1/|S⁻¹|₁ > s,   s = max(stiffness that counts as zero, rank_tolerance |S|₁)
!>
!> The reverse is not true: a model without this proof may be sound. Only the full diagnosis decides.
module ek_soundness
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t
   use ek_kkt, only: kkt_t, condition
   use ek_diagnosis, only: softest_rate, rank_tolerance, no_stiffness, rounding
   implicit none(type, external)
   private
   public :: is_surely_sound

   real(wp), parameter :: doubt = 10.0_wp     !! safety factor: `condition` estimates |S⁻¹| from below, seldom by more than a factor
                                              !! of 3

contains

   !> Whether a state certainly has no mechanisms and no redundant constraints, and has the expected inertia.
   !>
   !> Factorises the matrix of the state; kkt%negative and kkt%pivot_ratio are set. The result is .false. if a number is not finite.
   logical function is_surely_sound(suspension, state, negative, kkt)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: negative            !! expected number of negative eigenvalues
      type(kkt_t), intent(inout) :: kkt
      real(wp) :: rcond, stiffness

      call condition(suspension, state, inputs_t(), kkt, rcond)
      stiffness = max(no_stiffness*softest_rate(suspension, kkt), rounding*kkt%nq*(kkt%norm + driver_stiffness(suspension, kkt)))
      is_surely_sound = .false.
      if (kkt%is_singular .or. kkt%negative /= negative) return
      is_surely_sound = rcond*kkt%norm > doubt*max(stiffness, rank_tolerance*kkt%norm)
   end function is_surely_sound

   !> An upper bound of the 1-norm of the stiffness of drivers with a compliance C: g gᵀ/C of each driver, scaled. S contains C
   !> instead of this stiffness.
   pure real(wp) function driver_stiffness(suspension, kkt) result(total)
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(in) :: kkt             !! with the gradients of the last assembly
      real(wp) :: size_of_g
      integer :: k, t, at

      total = 0.0_wp
      do k = 1, size(suspension%rows)
         if (.not. suspension%rows(k)%compliance > 0.0_wp) cycle
         size_of_g = 0.0_wp
         do t = suspension%rows(k)%first, suspension%rows(k)%first + suspension%rows(k)%terms - 1
            at = 6*(suspension%terms(t)%measure%body_i - 1)
            if (at >= 0) size_of_g = size_of_g + sum(abs(kkt%gradients(1:6, t)*kkt%scale(at + 1:at + 6)))
            at = 6*(suspension%terms(t)%measure%body_j - 1)
            if (at >= 0) size_of_g = size_of_g + sum(abs(kkt%gradients(7:12, t)*kkt%scale(at + 1:at + 6)))
         end do
         total = total + size_of_g**2/suspension%rows(k)%compliance
      end do
   end function driver_stiffness

end module ek_soundness
