!> Checks that the joints of two states are in the same assembly: det(Φq(a) Φq(b)ᵀ) > 0, for the rigid rows.
!>
!> If Φq loses rank between them, the determinant changes sign, while the inertia of the matrix N of equilibrium is unchanged:
!> its determinant is proportional to the square of that of Φq. No memory is allocated after new_orientation.
module ek_orientation
   use ek_kinds, only: wp
   use ek_relative_rotation, only: pose_t
   use ek_vector, only: add_multiple
   use ek_measure, only: evaluation_t, evaluate
   use ek_block, only: add_gradient
   use ek_suspension, only: suspension_t
   use ek_lapack, only: dgesv
   implicit none(type, external)
   private
   public :: orientation_t, new_orientation, compare_orientation

   !> Of the largest pivot of Φq Φqᵀ: some 1e-5 rad from a loss of rank, where Newton's method loses half of its digits
   real(wp), parameter :: vanished = 2.5e-11_wp
   !> The share of the smallest pivot at a: b lies so much nearer to a loss of rank than a that its side means nothing
   real(wp), parameter :: near = 1.0e-4_wp
   !> m, and of a quaternion: poses as near as this are the same but for rounding
   real(wp), parameter :: same = 1.0e-12_wp

   !> The rigid rows (all except drivers with a stiffness), and work space.
   type :: orientation_t
      private
      real(wp), allocatable :: rows_a(:, :), rows_b(:, :)  !! scaled Φq: (unknown, row)
      type(pose_t), allocatable :: poses_b(:)              !! of rows_b
      real(wp) :: min_b = 0.0_wp                         !! smallest pivot of Φq Φqᵀ there, as a share of the largest
      real(wp), allocatable :: product(:, :), factors(:, :), unit(:, :)
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
      allocate (self%held, source=pack([(k, k=1, suspension%constraints())], .not. suspension%rows%compliance > 0.0_wp))
      allocate (self%rows_a(suspension%unknowns(), n), self%rows_b(suspension%unknowns(), n), self%product(n, n), &
         self%factors(n, n), self%unit(n, 1), source=0.0_wp)
      allocate (self%pivots(n), source=0)
      allocate (self%poses_b(size(suspension%bodies) + 1), source=pose_t(r=huge(1.0_wp)))     ! not those of any state
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
   !>
   !> x·Φq(a) Φq(b)ᵀ x > 0 for all x means a positive determinant; otherwise its sign is that of the LU factors.
   !> Equation (K.17) of docs/theory/kkt.md.
   pure subroutine compare_orientation(self, suspension, poses_a, poses_b, scale, is_turned_over, is_singular)
      type(orientation_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(pose_t), intent(in) :: poses_a(:), poses_b(:)   !! of the chassis and the bodies
      real(wp), intent(in) :: scale(:)                     !! of the unknowns, then of the rows: D of ek_scale
      logical, intent(out) :: is_turned_over, is_singular
      real(wp), allocatable :: rows(:, :)
      real(wp) :: min_a, least
      integer :: k, n, info

      n = size(self%held)
      is_turned_over = .false.
      is_singular = .false.
      if (n == 0) return
      min_a = self%min_b
      if (are_same(poses_a, self%poses_b)) then            ! b of the last comparison
         call move_alloc(self%rows_a, rows)
         call move_alloc(self%rows_b, self%rows_a)
         call move_alloc(rows, self%rows_b)
      else
         call gather_rows(self, suspension, poses_a, scale, self%rows_a)
         call multiply_out(self, self%rows_a, self%rows_a, self%factors)
         call eliminate(n, self%factors, min_a)
      end if
      call gather_rows(self, suspension, poses_b, scale, self%rows_b)
      call multiply_out(self, self%rows_b, self%rows_b, self%factors)
      call eliminate(n, self%factors, self%min_b)
      self%poses_b(:) = poses_b
      is_singular = self%min_b < vanished .or. self%min_b < near*min_a

      call multiply_out(self, self%rows_a, self%rows_b, self%product)
      do k = 1, n
         self%factors(k:, k) = self%product(k:, k) + self%product(k, k:)
      end do
      call eliminate(n, self%factors, least)
      if (least > 0.0_wp) return
      self%unit = 0.0_wp      ! for the LU factors; without a right-hand side OpenBLAS would not compute them
      call dgesv(n, 1, self%product, n, self%pivots, self%unit, n, info)
      if (info /= 0) return
      do k = 1, n
         if ((self%product(k, k) < 0.0_wp) .neqv. self%pivots(k) /= k) is_turned_over = .not. is_turned_over
      end do
   end subroutine compare_orientation

   !> Whether poses are the same but for rounding.
   pure logical function are_same(a, b)
      type(pose_t), intent(in) :: a(:), b(:)
      integer :: k

      are_same = .false.
      do k = 1, size(a)
         if (.not. (maxval(abs(a(k)%r - b(k)%r)) <= same .and. maxval(abs(a(k)%q - b(k)%q)) <= same)) return
      end do
      are_same = .true.
   end function are_same

   !> The products a·b of all rows.
   pure subroutine multiply_out(self, rows_a, rows_b, product)
      type(orientation_t), intent(in) :: self
      real(wp), intent(in) :: rows_a(6, size(self%count), *), rows_b(6, size(self%count), *)
      real(wp), intent(out) :: product(:, :)
      integer :: i, j, k, l, body

      product = 0.0_wp
      do body = 1, size(self%count)
         do j = 1, self%count(body)
            l = self%touching(j, body)
            do i = 1, self%count(body)
               k = self%touching(i, body)
               product(k, l) = product(k, l) + dot_product(rows_a(:, body, k), rows_b(:, body, l))
            end do
         end do
      end do
   end subroutine multiply_out

   !> Gauss's elimination of a sparse symmetric matrix, of which only the lower half is used.
   pure subroutine eliminate(n, matrix, least)
      integer, intent(in) :: n
      real(wp), intent(inout) :: matrix(n, n)
      real(wp), intent(out) :: least         !! the smallest pivot as a share of the largest; 0: it is not positive definite
      real(wp) :: most
      integer :: i, k

      least = huge(least)
      most = 0.0_wp
      do k = 1, n
         least = min(least, matrix(k, k))
         most = max(most, matrix(k, k))
         if (.not. matrix(k, k) > 0.0_wp) exit
         do i = k + 1, n
            if (.not. abs(matrix(i, k)) > 0.0_wp) cycle
            call add_multiple(n - i + 1, -matrix(i, k)/matrix(k, k), matrix(i:, k), matrix(i:, i))
         end do
      end do
      least = max(least, 0.0_wp)/max(most, tiny(most))
   end subroutine eliminate

   !> Scaled Φq of the rigid rows.
   pure subroutine gather_rows(self, suspension, poses, scale, rows)
      type(orientation_t), intent(in) :: self
      type(suspension_t), intent(in) :: suspension
      type(pose_t), intent(in) :: poses(0:)                  !! the chassis, then the bodies
      real(wp), intent(in) :: scale(:)
      real(wp), contiguous, intent(inout) :: rows(:, :)      !! (unknown, row)
      type(evaluation_t) :: evaluation
      integer :: k, t, nq

      nq = size(rows, 1)
      rows = 0.0_wp
      do k = 1, size(self%held)
         associate (row => suspension%rows(self%held(k)))
            do t = row%first, row%first + row%terms - 1
               associate (m => suspension%terms(t)%measure)
                  call evaluate(m, poses(m%body_i), poses(m%body_j), evaluation)
                  call add_gradient(suspension%terms(t)%coefficient, evaluation%gradient, 6*(m%body_i - 1), 6*(m%body_j - 1), &
                     rows(:, k))
               end associate
            end do
         end associate
         rows(:, k) = rows(:, k)*(scale(nq + self%held(k))*scale(:nq))
      end do
   end subroutine gather_rows

end module ek_orientation
