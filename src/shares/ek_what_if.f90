!> The compliance matrix of a state with other rates, exactly and without factorising again: the state is unchanged.
!>
!> Each law of an element acts along a deflection gᵀu. With the deflections G per unit load, A per unit load on the laws
!> themselves, and the changes D of their rates,
!>
!>     C' = C − G_vᵀ (I + D A)⁻¹ D G
!>
!> and, with the laws rigid, C' = C − G_vᵀ A⁻¹ G. G_v is G of the transpose. For an added spring, the rate before the change is 0.
!> With preload the state would also move; the result is exact for the unchanged state.
module ek_what_if
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_kkt, only: kkt_t
   use ek_compliance, only: compliance_t, solve_further
   use ek_contribution, only: contribution_t
   use ek_port_response, only: lock_t, find_lock, keep_locked
   use ek_lapack, only: dgesv
   implicit none(type, external)
   private
   public :: find_self_moves, changed_compliance, rigid_compliance

contains

   !> Computes A: the deflections of some laws per unit load on each of them. The cost is one solution per law.
   !> Equation (C.16) of docs/theory/compliance.md.
   subroutine find_self_moves(laws, kkt, compliance, shares, self_move)
      integer, intent(in) :: laws(:)                      !! indices of laws in `shares`
      type(kkt_t), intent(inout) :: kkt                   !! with the factors of the state
      type(compliance_t), intent(in) :: compliance        !! of the state
      type(contribution_t), intent(in) :: shares          !! of split_compliance, at the same state
      real(wp), allocatable, intent(out) :: self_move(:, :)   !! (law, law) [m/N, rad/(N m)]
      real(wp) :: columns(kkt%n, size(laws))

      if (are_checked) call require(size(shares%gradient, 1) == kkt%nq, 'find_self_moves: the shares are of another model')
      columns = 0.0_wp
      columns(:kkt%nq, :) = shares%gradient(:, laws)
      call solve_further(kkt, compliance, size(laws), columns)
      self_move = matmul(transpose(shares%gradient(:, laws)), columns(:kkt%nq, :))
   end subroutine find_self_moves

   !> Computes C' after changes of some rates. I + D A is singular if a rate becomes so negative that the suspension collapses.
   !> Equation (C.16) of docs/theory/compliance.md.
   subroutine changed_compliance(c, left_move, move, self_move, change, changed, is_known)
      real(wp), intent(in) :: c(:, :)                       !! at the wheel centres
      real(wp), intent(in) :: left_move(:, :), move(:, :)   !! (load, law): G_vᵀ, Gᵀ
      real(wp), intent(in) :: self_move(:, :)               !! A
      real(wp), intent(in) :: change(:)                     !! change of each rate [N/m, N m/rad]
      real(wp), allocatable, intent(out) :: changed(:, :)   !! C'
      logical, intent(out) :: is_known                      !! .false.: singular
      real(wp) :: matrix(size(change), size(change)), forces(size(change), size(c, 2))
      integer :: pivots(size(change)), k, j, info

      do k = 1, size(change)
         matrix(k, :) = change(k)*self_move(k, :)
         matrix(k, k) = matrix(k, k) + 1.0_wp
         do j = 1, size(c, 2)
            forces(k, j) = change(k)*move(j, k)
         end do
      end do
      call dgesv(size(change), size(c, 2), matrix, size(change), pivots, forces, size(change), info)
      is_known = info == 0
      changed = c - matmul(left_move, forces)
   end subroutine changed_compliance

   !> The compliance matrix C' with some laws rigid. The deflections of these laws are locked one after the other; a deflection that
   !> is already locked has no effect.
   !> Equation (C.17) of docs/theory/compliance.md.
   pure function rigid_compliance(c, left_move, move, self_move) result(changed)
      real(wp), intent(in) :: c(:, :)
      real(wp), intent(in) :: left_move(:, :), move(:, :)
      real(wp), intent(in) :: self_move(:, :)
      real(wp) :: changed(size(c, 1), size(c, 2))
      real(wp), allocatable :: response(:, :)
      type(lock_t) :: lock
      integer :: n, m, j, k

      n = size(c, 1)
      m = size(self_move, 1)
      allocate (response(n + m, n + m))
      response(:n, :n) = c
      response(:n, n + 1:) = left_move
      response(n + 1:, :n) = transpose(move)
      response(n + 1:, n + 1:) = self_move
      call find_lock(response, [(n + k, k=1, m)], lock)
      do j = 1, n
         call keep_locked(lock, response(:, j))
      end do
      changed = response(:n, :n)
   end function rigid_compliance

end module ek_what_if
