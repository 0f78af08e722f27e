!> Checks that the joints of two states are in the same assembly: det(Φq(a) Φq(b)ᵀ) > 0, for the rigid rows.
!>
!> If Φq loses rank between them, the determinant changes sign, while the inertia of the matrix N of equilibrium is unchanged:
!> its determinant is proportional to the square of that of Φq. No memory is allocated after new_orientation.
module ek_orientation
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, demand_t
   use ek_kkt, only: kkt_t, assemble, residual_only
   use ek_lapack, only: dgesv
   implicit none(type, external)
   private
   public :: orientation_t, new_orientation, is_turned_over

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

   !> Whether det(Φq(a) Φq(b)ᵀ) < 0.
   !> Equation (K.16) of docs/theory/kkt.md.
   logical function is_turned_over(self, suspension, state_a, state_b, demand_a, demand_b, kkt)
      type(orientation_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state_a, state_b
      type(demand_t), intent(in) :: demand_a, demand_b
      type(kkt_t), intent(inout) :: kkt
      integer :: i, j, k, l, body, n, info

      call assemble(suspension, state_a, demand_a, residual_only, kkt)
      call gather_rows(self, suspension, kkt, self%rows_a)
      call assemble(suspension, state_b, demand_b, residual_only, kkt)
      call gather_rows(self, suspension, kkt, self%rows_b)
      is_turned_over = .false.
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
      if (info /= 0) return
      do k = 1, n
         if (self%product(k, k) < 0.0_wp) is_turned_over = .not. is_turned_over
         if (self%pivots(k) /= k) is_turned_over = .not. is_turned_over
      end do
   end function is_turned_over

   !> Scaled Φq of the rigid rows, from the gradients of the last assembly.
   pure subroutine gather_rows(self, suspension, kkt, rows)
      type(orientation_t), intent(in) :: self
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(in) :: kkt
      real(wp), intent(inout) :: rows(:, :)      !! (unknown, row)
      integer :: k, t, i, j

      rows = 0.0_wp
      do k = 1, size(self%held)
         associate (row => suspension%rows(self%held(k)))
            do t = row%first, row%first + row%terms - 1
               i = 6*(suspension%terms(t)%measure%body_i - 1)
               j = 6*(suspension%terms(t)%measure%body_j - 1)
               if (i >= 0) rows(i + 1:i + 6, k) = rows(i + 1:i + 6, k) + kkt%gradients(1:6, t)
               if (j >= 0) rows(j + 1:j + 6, k) = rows(j + 1:j + 6, k) + kkt%gradients(7:12, t)
            end do
         end associate
         rows(:, k) = rows(:, k)*(kkt%scale(kkt%nq + self%held(k))*kkt%scale(:kkt%nq))
      end do
   end subroutine gather_rows

end module ek_orientation
