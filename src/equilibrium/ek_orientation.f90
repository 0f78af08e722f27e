!> Checks that the joints of two states are in the same assembly: det(Φq(a) Φq(b)ᵀ) > 0, for the rigid rows.
!>
!> If Φq loses rank between them, the determinant changes sign, while the inertia of the matrix N of equilibrium is unchanged:
!> its determinant is proportional to the square of that of Φq. No memory is allocated after new_orientation.
module ek_orientation
   use ek_kinds, only: wp
   use ek_block, only: add_gradient
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, demand_t
   use ek_kkt, only: kkt_t, assemble, residual_only
   use ek_lapack, only: dgesv
   implicit none(type, external)
   private
   public :: orientation_t, new_orientation, compare_orientation

   !> Of the largest pivot of Φq Φqᵀ: some 1e-5 rad from a loss of rank, where Newton's method loses half of its digits
   real(wp), parameter :: vanished = 2.5e-11_wp
   !> The share of the same pivot of Φq(a) Φq(b)ᵀ: b lies so much nearer to a loss of rank than a that its side means nothing
   real(wp), parameter :: near = 1.0e-2_wp

   !> The rigid rows (all except drivers with a stiffness), and work space.
   type :: orientation_t
      private
      real(wp), allocatable :: rows_a(:, :), rows_b(:, :), product(:, :), unit(:, :)   !! scaled Φq
      integer, allocatable :: held(:), pivots(:)
      integer, allocatable :: touching(:, :), count(:)     !! held rows that touch a body, and how many
   end type orientation_t

contains

   !> Allocates the work space for a model.
   function new_orientation(suspension) result(self)
      type(suspension_t), intent(in) :: suspension
      type(orientation_t) :: self
      integer :: k, n, body

      n = count(.not. suspension%rows%compliance > 0.0_wp)
      allocate (self%held(n))
      self%held(:) = pack([(k, k=1, suspension%constraints())], .not. suspension%rows%compliance > 0.0_wp)
      allocate (self%rows_a(suspension%unknowns(), n), self%rows_b(suspension%unknowns(), n), self%product(n, n), &
         self%unit(n, 1), source=0.0_wp)
      allocate (self%pivots(n), source=0)
      allocate (self%touching(n, size(suspension%bodies)), self%count(size(suspension%bodies)), source=0)
      do body = 1, size(suspension%bodies)
         do k = 1, n
            associate (row => suspension%rows(self%held(k)))
               if (.not. any(suspension%terms(row%first:row%first + row%terms - 1)%measure%body_i == body .or. &
                  suspension%terms(row%first:row%first + row%terms - 1)%measure%body_j == body)) cycle
            end associate
            self%count(body) = self%count(body) + 1
            self%touching(self%count(body), body) = k
         end do
      end do
   end function new_orientation

   !> Compares two states: det(Φq(a) Φq(b)ᵀ) < 0, and whether Φq loses rank at b itself, where that sign means nothing.
   !> Equation (K.17) of docs/theory/kkt.md.
   subroutine compare_orientation(self, suspension, state_a, state_b, demand_a, demand_b, kkt, is_turned_over, is_singular)
      type(orientation_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state_a, state_b
      type(demand_t), intent(in) :: demand_a, demand_b
      type(kkt_t), intent(inout) :: kkt
      logical, intent(out) :: is_turned_over, is_singular
      real(wp) :: least, at_end

      call assemble(suspension, state_b, demand_b, residual_only, kkt)
      call gather_rows(self, suspension, kkt, self%rows_a)
      self%rows_b = self%rows_a
      call multiply_out(self, is_turned_over, least)
      at_end = least
      call assemble(suspension, state_a, demand_a, residual_only, kkt)
      call gather_rows(self, suspension, kkt, self%rows_a)
      call multiply_out(self, is_turned_over, least)
      is_singular = at_end < vanished .or. at_end < near*least
   end subroutine compare_orientation

   !> The sign of det(Φq(a) Φq(b)ᵀ), from the gathered rows, and the smallest of its pivots as a share of the largest.
   subroutine multiply_out(self, is_negative, least)
      type(orientation_t), intent(inout) :: self
      logical, intent(out) :: is_negative
      real(wp), intent(out) :: least
      real(wp) :: pivot, most
      integer :: i, j, k, l, body, n, info

      is_negative = .false.
      least = 1.0_wp
      n = size(self%held)
      if (n == 0) return
      self%product = 0.0_wp
      do body = 1, size(self%count)
         do j = 1, self%count(body)
            l = self%touching(j, body)
            do i = 1, self%count(body)
               k = self%touching(i, body)
               self%product(k, l) = self%product(k, l) &
                  + dot_product(self%rows_a(6*body - 5:6*body, k), self%rows_b(6*body - 5:6*body, l))
            end do
         end do
      end do
      ! for the LU factors; without a right-hand side OpenBLAS would not compute them
      self%unit = 0.0_wp
      call dgesv(n, 1, self%product, n, self%pivots, self%unit, n, info)
      least = 0.0_wp
      if (info /= 0) return
      least = huge(least)
      most = 0.0_wp
      do k = 1, n
         pivot = self%product(k, k)
         least = min(least, abs(pivot))
         most = max(most, abs(pivot))
         if (pivot < 0.0_wp) is_negative = .not. is_negative
         if (self%pivots(k) /= k) is_negative = .not. is_negative
      end do
      least = least/most
   end subroutine multiply_out

   !> Scaled Φq of the rigid rows, from the gradients of the last assembly.
   pure subroutine gather_rows(self, suspension, kkt, rows)
      type(orientation_t), intent(in) :: self
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(in) :: kkt
      real(wp), contiguous, intent(inout) :: rows(:, :)      !! (unknown, row)
      integer :: k, t

      rows = 0.0_wp
      do k = 1, size(self%held)
         associate (row => suspension%rows(self%held(k)))
            do t = row%first, row%first + row%terms - 1
               associate (m => suspension%terms(t)%measure)
                  call add_gradient(1.0_wp, kkt%gradients(:, t), 6*(m%body_i - 1), 6*(m%body_j - 1), rows(:, k))
               end associate
            end do
         end associate
         rows(:, k) = rows(:, k)*(kkt%scale(kkt%nq + self%held(k))*kkt%scale(:kkt%nq))
      end do
   end subroutine gather_rows

end module ek_orientation
