!> Solution and inertia of N plus a few dyads, from the factors of N, without another factorisation of the size of N.
!>
!>     N' = N + Σ s_k g_k g_kᵀ = N + G Σ Gᵀ,   G = [√|s_k| g_k],  Σ = diag(sign s_k)
!>
!> With the small matrix W = −Σ − Gᵀ N⁻¹ G, one row per dyad:
!>
!> - N'⁻¹ x = N⁻¹ x + N⁻¹ G W⁻¹ Gᵀ N⁻¹ x (Sherman, Morrison and Woodbury);
!> - N' has as many negative eigenvalues as N and W together, minus the number of s_k > 0: N' and W are the Schur complements
!>   of [N G; Gᵀ −Σ] (Haynsworth 1968).
!>
!> An elastic element whose slope changes by s adds the dyad s g gᵀ, with g the gradient of its measure. No memory is allocated
!> after new_dyads.
module ek_dyads
   use ek_kinds, only: wp
   use ek_block, only: add_gradient
   use ek_kkt, only: kkt_t, solve, count_inertia
   use ek_lapack, only: dsytrf
   use ek_substitution, only: substitute
   implicit none(type, external)
   private
   public :: dyads_t, new_dyads, add_dyad, solve_columns, set_changes, correct, resist

   !> The dyads: gradients g, N⁻¹ g, and the small matrix W.
   type :: dyads_t
      integer :: number = 0                 !! number of dyads; 0 removes all dyads
      integer :: negative = -1              !! negative eigenvalues of N'; −1: N' is singular
      integer, allocatable :: at(:, :)      !! (2, dyad): number of unknowns before each of the two bodies; negative: chassis
      real(wp), allocatable :: gradient(:, :)    !! (12, dyad): gradients g
      real(wp), allocatable :: column(:, :)      !! (unknown, dyad): N⁻¹ g
      real(wp), allocatable :: product(:, :)     !! (dyad, dyad): gᵀ N⁻¹ g
      real(wp), allocatable :: change(:)    !! (dyad): changes s
      real(wp), allocatable :: root(:)      !! (dyad): √|s|
      real(wp), allocatable :: small(:)     !! W by columns, then its factors
      real(wp), allocatable :: part(:), work(:)
      integer, allocatable :: pivots(:)
   end type dyads_t

contains

   !> Work space for up to `most` dyads of a system with n rows.
   pure function new_dyads(n, most) result(self)
      integer, intent(in) :: n            !! rows of N
      integer, intent(in) :: most         !! largest number of dyads
      type(dyads_t) :: self

      allocate (self%at(2, most), self%pivots(most), source=0)
      allocate (self%gradient(12, most), self%column(n, most), self%product(most, most), source=0.0_wp)
      allocate (self%change(most), self%root(most), self%small(most**2), self%part(most), self%work(64*max(most, 1)), source=0.0_wp)
   end function new_dyads

   !> Adds a dyad: the gradient of a measure of two bodies.
   pure subroutine add_dyad(self, body_i, body_j, gradient)
      type(dyads_t), intent(inout) :: self
      integer, intent(in) :: body_i, body_j       !! 0: the chassis
      real(wp), intent(in) :: gradient(12)

      self%number = self%number + 1
      self%at(:, self%number) = [6*(body_i - 1), 6*(body_j - 1)]
      self%gradient(:, self%number) = gradient
   end subroutine add_dyad

   !> Computes N⁻¹ g of all dyads, with the current factors of N.
   pure subroutine solve_columns(self, kkt)
      type(dyads_t), intent(inout) :: self
      type(kkt_t), intent(inout) :: kkt
      integer :: j, k

      do k = 1, self%number
         kkt%rhs = 0.0_wp
         call add_gradient(1.0_wp, self%gradient(:, k), self%at(1, k), self%at(2, k), kkt%rhs)
         call solve(kkt)
         self%column(:, k) = kkt%rhs
         do j = 1, k
            self%product(j, k) = along(self, j, kkt%rhs)
            self%product(k, j) = self%product(j, k)
         end do
      end do
   end subroutine solve_columns

   !> Sets the changes s: factorises W and counts the negative eigenvalues of N'.
   !> Equation (K.16) of docs/theory/kkt.md.
   pure subroutine set_changes(self, change, negative)
      type(dyads_t), intent(inout) :: self
      real(wp), intent(in) :: change(:)           !! s of each dyad
      integer, intent(in) :: negative             !! negative eigenvalues of N
      real(wp) :: ratio, log_determinant
      integer :: k, n, info

      n = self%number
      self%change(:n) = change(:n)
      self%root(:n) = sqrt(abs(change(:n)))
      do k = 1, n
         self%small((k - 1)*n + 1:k*n) = -self%root(:n)*self%product(:n, k)*self%root(k)
         self%small((k - 1)*n + k) = self%small((k - 1)*n + k) - sign(1.0_wp, change(k))
      end do
      call dsytrf('L', n, self%small, max(n, 1), self%pivots, self%work, size(self%work), info)
      call count_inertia(n, self%small, self%pivots, self%negative, ratio, log_determinant)
      ! sign(1, +0) = 1: a dyad without a change counts in both and drops out
      self%negative = self%negative + negative - count(sign(1.0_wp, change(:n)) > 0.0_wp)
      if (n > 0 .and. (info /= 0 .or. .not. ratio > 0.0_wp)) self%negative = -1
   end subroutine set_changes

   !> Corrects N⁻¹ x → N'⁻¹ x; N' must not be singular.
   !> Equation (K.16) of docs/theory/kkt.md.
   pure subroutine correct(self, x)
      type(dyads_t), intent(inout) :: self
      real(wp), intent(inout) :: x(:)
      integer :: k

      do k = 1, self%number
         self%part(k) = self%root(k)*along(self, k, x)
      end do
      call substitute(self%number, self%small, self%pivots, self%part)
      do k = 1, self%number
         x = x + (self%root(k)*self%part(k))*self%column(:, k)
      end do
   end subroutine correct

   !> Subtracts the contribution of the dyads to N' x from a right-hand side: Σ s g gᵀ x.
   pure subroutine resist(self, x, rhs)
      type(dyads_t), intent(in) :: self
      real(wp), intent(in) :: x(:)
      real(wp), intent(inout) :: rhs(:)
      integer :: k

      do k = 1, self%number
         call add_gradient(-self%change(k)*along(self, k, x), self%gradient(:, k), self%at(1, k), self%at(2, k), rhs)
      end do
   end subroutine resist

   !> The product gᵀ x for the dyad with index `number`.
   pure real(wp) function along(self, number, x)
      type(dyads_t), intent(in) :: self
      integer, intent(in) :: number
      real(wp), intent(in) :: x(:)
      integer :: at

      along = 0.0_wp
      at = self%at(1, number)
      if (at >= 0) along = dot_product(self%gradient(1:6, number), x(at + 1:at + 6))
      at = self%at(2, number)
      if (at >= 0) along = along + dot_product(self%gradient(7:12, number), x(at + 1:at + 6))
   end function along

end module ek_dyads
