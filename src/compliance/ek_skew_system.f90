!> The linear system of a state under loads that have no potential: a constant moment, or a load that rotates with its body.
!>
!> T does not contain the skew part N of these loads. N does not affect the equilibrium, but affects its derivative. Let g = dV/dπ
!> be the moment of all terms that have a potential. The derivative of the residual along a rotation is the derivative in
!> exponential coordinates less ½ g̃ (from the product of two rotations, exp(δ̃)exp(π̃) = exp((δ + π + ½ δ×π + …)~)). At
!> equilibrium, g is the moment M of the loads without a potential:
!>
!>     dead moment M:            N_ππ = −½ M̃
!>     force at the lowest point of a wheel: N_ππ = ½ m̃, m of moment_without_potential
!>     follower, force f, moment m about the reference point, arm included:
!>                               N_rπ = N_πr = ½ f̃,  N_ππ = ½ m̃     (½ m̃ = m̃ of its own rotation less ½ g̃)
!>
!> The matrix is then factorised in full (LAPACK dgetrf), and the compliance matrix is not symmetric.
!> Equation (C.4) of docs/theory/compliance.md.
!> Equation (R.7) of docs/theory/rotations.md.
module ek_skew_system
   use ek_kinds, only: wp
   use ek_rotation, only: skew
   use ek_relative_rotation, only: pose_t
   use ek_suspension, only: suspension_t, load_t
   use ek_state, only: state_t, inputs_t
   use ek_load, only: has_potential, moment_without_potential
   use ek_kkt, only: kkt_t, wrench, load_factor, whole_matrix
   use ek_lapack, only: dgetrf, dgetrs
   implicit none(type, external)
   private
   public :: skew_system_t, has_skew_part, factorise_skew, solve_skew, skew_part, factor_of

   type :: skew_system_t
      logical :: is_singular = .false.
      real(wp), allocatable :: matrix(:, :)                !! T + N and the rows, not scaled; allocated at the first use
      real(wp), allocatable, private :: factors(:, :)      !! LU factors of the scaled matrix
      integer, allocatable, private :: pivots(:)
   end type skew_system_t

contains

   !> Scale of load k under given inputs.
   pure real(wp) function factor_of(suspension, inputs, k) result(factor)
      type(suspension_t), intent(in) :: suspension
      type(inputs_t), intent(in) :: inputs
      integer, intent(in) :: k

      factor = 1.0_wp
      if (suspension%loads(k)%is_case) factor = load_factor(inputs, k)
   end function factor_of

   !> Whether any active load has no potential.
   pure logical function has_skew_part(suspension, inputs)
      type(suspension_t), intent(in) :: suspension
      type(inputs_t), intent(in) :: inputs
      integer :: k

      has_skew_part = .false.
      do k = 1, size(suspension%loads)
         if (has_potential(suspension%loads(k))) cycle
         if (abs(factor_of(suspension, inputs, k)) > 0.0_wp) has_skew_part = .true.
      end do
   end function has_skew_part

   !> The matrix N of a load, at the unknowns [Δr Δπ] of its body.
   !> Equation (C.4) of docs/theory/compliance.md.
   pure function skew_part(load, pose, factor) result(part)
      type(load_t), intent(in) :: load
      type(pose_t), intent(in) :: pose              !! pose of the body of the load
      real(wp), intent(in) :: factor
      real(wp) :: part(6, 6), force(3), moment(3), arm(3)

      part = 0.0_wp
      if (load%follows) then
         call wrench(load, pose, force, moment, arm)
         part(1:3, 4:6) = skew(0.5_wp*factor*force)
         part(4:6, 1:3) = skew(0.5_wp*factor*force)
         part(4:6, 4:6) = skew(0.5_wp*factor*moment)
      else
         part(4:6, 4:6) = skew((0.5_wp*factor)*moment_without_potential(load, pose))
      end if
   end function skew_part

   !> Factorises T + N, with the scaling of T.
   !> Equation (C.4) of docs/theory/compliance.md.
   subroutine factorise_skew(suspension, state, inputs, least, kkt, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      real(wp), intent(in) :: least                 !! pivot ratio below which the matrix is singular
      type(kkt_t), intent(in) :: kkt                !! T is assembled
      type(skew_system_t), intent(inout) :: self
      real(wp) :: pivots(kkt%n)
      integer :: j, k, at, info

      if (.not. allocated(self%factors)) then
         allocate (self%factors(kkt%n, kkt%n), self%matrix(kkt%n, kkt%n), source=0.0_wp)
         allocate (self%pivots(kkt%n), source=0)
      end if
      self%matrix(:, :) = whole_matrix(kkt)
      do k = 1, size(suspension%loads)
         associate (load => suspension%loads(k))
            at = 6*(load%body - 1)
            self%matrix(at + 1:at + 6, at + 1:at + 6) = self%matrix(at + 1:at + 6, at + 1:at + 6) + &
               skew_part(load, state%poses(load%body + 1), factor_of(suspension, inputs, k))
         end associate
      end do
      do j = 1, kkt%n
         self%factors(:, j) = self%matrix(:, j)*(kkt%scale*kkt%scale(j))
      end do
      call dgetrf(kkt%n, kkt%n, self%factors, kkt%n, self%pivots, info)
      pivots = [(abs(self%factors(j, j)), j=1, kkt%n)]
      self%is_singular = .not. (info == 0 .and. minval(pivots) > least*maxval(pivots))
   end subroutine factorise_skew

   !> Solves for columns [N, m] with the matrix or its transpose. Input and output are not scaled.
   subroutine solve_skew(self, kkt, is_transposed, many, columns)
      type(skew_system_t), intent(in) :: self
      type(kkt_t), intent(in) :: kkt
      logical, intent(in) :: is_transposed
      integer, intent(in) :: many                 !! the first columns are solved
      real(wp), intent(inout) :: columns(kkt%n, *)
      integer :: j, info

      do j = 1, many
         columns(:, j) = columns(:, j)*kkt%scale
      end do
      call dgetrs(merge('T', 'N', is_transposed), kkt%n, many, self%factors, kkt%n, self%pivots, columns, kkt%n, info)
      do j = 1, many
         columns(:, j) = columns(:, j)*kkt%scale
      end do
   end subroutine solve_skew

end module ek_skew_system
