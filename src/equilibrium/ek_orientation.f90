!> Checks that the joints of two states are in the same assembly mode: det(Φq(a) Φq(b)ᵀ) > 0, for the rigid rows.
!>
!> If Φq loses rank between the two states, the determinant changes sign, while the inertia of the matrix N of equilibrium is
!> unchanged: det N is proportional to det(Φq Φqᵀ), which has a double zero there. The products of rows that share no body are
!> zero: only the other products are computed and eliminated, row by row (ek_plan). No memory is allocated after new_orientation,
!> except for the LU factors of a large model.
module ek_orientation
   use ek_kinds, only: wp
   use ek_relative_rotation, only: pose_t
   use ek_measure, only: evaluation_t, evaluate
   use ek_suspension, only: suspension_t
   use ek_plan, only: plan_t, new_natural_plan
   use ek_lapack, only: dgesv
   implicit none(type, external)
   private
   public :: orientation_t, new_orientation, renew_orientation, compare_orientation

   !> Limit of the smallest pivot of Φq Φqᵀ, as a share of the largest: some 1e-5 rad from a loss of rank, where Newton's method
   !> loses half of its digits
   real(wp), parameter :: vanished = 2.5e-11_wp
   !> Limit of the smallest pivot at b, as a share of the smallest pivot at a: below it, b is so near to a loss of rank that the
   !> sign of the determinant has no meaning
   real(wp), parameter :: near = 1.0e-4_wp
   !> Largest difference of reference points [m] and of quaternions [-] for which two poses are equal but for rounding
   real(wp), parameter :: same = 1.0e-12_wp

   !> Number of rows up to which the dense memory for LU factors is allocated at once: more than any suspension has
   integer, parameter :: usual = 250

   !> The rigid rows (all except drivers with a stiffness), and work space. The gradient of a row at a body has a slot.
   type :: orientation_t
      private
      integer, allocatable :: held(:)                      !! index of each rigid row in the suspension
      integer, allocatable :: first(:)                     !! (rows + 1): first slot of each rigid row
      integer, allocatable :: body(:), row(:)              !! body and rigid row of each slot
      integer, allocatable :: slot_of(:, :)                !! (2, term): slots of each term at bodies i and j; 0: chassis
      integer, allocatable :: entry_row(:), entry_column(:)   !! row and column of each product that may be nonzero; row ≥ column
      integer, allocatable :: pair(:, :)                   !! (3, pair): index of a product, two slots of one body that add to it
      type(plan_t) :: plan                                 !! plan of elimination of the products
      real(wp), allocatable :: rows_a(:, :), rows_b(:, :)  !! scaled Φq: (6, slot)
      type(pose_t), allocatable :: poses_b(:)              !! poses of the state of rows_b
      real(wp) :: min_b = 0.0_wp                           !! smallest pivot of Φq Φqᵀ at b, as a share of the largest
      real(wp), allocatable :: lower(:), upper(:)          !! products in the lower, upper triangle: (row of a) × (row of b)
      real(wp), allocatable :: factors(:)                  !! factors of the products, in the order of the plan
      real(wp), allocatable :: product(:, :), unit(:, :)   !! matrix of products and a right-hand side, for LU factors
      integer, allocatable :: pivots(:)
   end type orientation_t

contains

   !> The rigid rows of a model, with work space.
   function new_orientation(suspension) result(self)
      type(suspension_t), intent(in) :: suspension
      type(orientation_t) :: self
      integer :: k

      allocate (self%held, source=pack([(k, k=1, suspension%constraints())], .not. suspension%rows%compliance > 0.0_wp))
      call find_slots(self, suspension)
      call find_products(self, size(suspension%bodies))
      call new_natural_plan(size(self%held), self%entry_row, self%entry_column, self%plan)
      allocate (self%rows_a(6, size(self%body)), self%rows_b(6, size(self%body)), self%lower(size(self%entry_row)), &
         self%upper(size(self%entry_row)), self%factors(self%plan%length), source=0.0_wp)
      allocate (self%poses_b(size(suspension%bodies) + 1), source=pose_t(r=huge(1.0_wp)))     ! not those of any state
      if (size(self%held) <= usual) call allocate_dense(self)
   end function new_orientation

   !> Renews the orientation for other numbers of the model. This is done in place unless a row has become rigid or elastic.
   subroutine renew_orientation(suspension, self)
      type(suspension_t), intent(in) :: suspension
      type(orientation_t), intent(inout) :: self      !! of new_orientation, for the same model
      logical :: is_alike
      integer :: k, n

      n = 0
      is_alike = .true.
      do k = 1, suspension%constraints()
         if (suspension%rows(k)%compliance > 0.0_wp) cycle
         n = n + 1
         is_alike = n <= size(self%held)
         if (is_alike) is_alike = self%held(n) == k
         if (.not. is_alike) exit
      end do
      if (.not. is_alike .or. n /= size(self%held)) then
         self = new_orientation(suspension)
         return
      end if
      do k = 1, size(self%poses_b)
         self%poses_b(k)%r = huge(1.0_wp)             ! not those of any state
      end do
      self%min_b = 0.0_wp
   end subroutine renew_orientation

   !> Finds the slots of the rigid rows: one slot per row and body of the row.
   subroutine find_slots(self, suspension)
      type(orientation_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      integer :: body(2*size(suspension%terms)), row(2*size(suspension%terms)), k, t, used

      allocate (self%first(size(self%held) + 1), self%slot_of(2, size(suspension%terms)), source=0)
      used = 0
      do k = 1, size(self%held)
         self%first(k) = used + 1
         associate (held => suspension%rows(self%held(k)))
            do t = held%first, held%first + held%terms - 1
               call find_slot(suspension%terms(t)%measure%body_i, self%slot_of(1, t))
               call find_slot(suspension%terms(t)%measure%body_j, self%slot_of(2, t))
            end do
         end associate
      end do
      self%first(size(self%first)) = used + 1
      self%body = body(:used)
      self%row = row(:used)

   contains

      !> Finds the slot of a body in row k; 0 for the chassis. A body without a slot in this row gets a new slot.
      subroutine find_slot(this, slot)
         integer, intent(in) :: this             ! body
         integer, intent(out) :: slot

         slot = 0
         if (this == 0) return
         do slot = self%first(k), used
            if (body(slot) == this) return
         end do
         used = slot
         body(slot) = this
         row(slot) = k
      end subroutine find_slot

   end subroutine find_slots

   !> Finds the products of rows that share a body, column by column of the matrix.
   pure subroutine find_products(self, bodies)
      type(orientation_t), intent(inout) :: self
      integer, intent(in) :: bodies
      integer :: start(bodies + 1), next(bodies), touching(size(self%body)), number(size(self%held)), k, s, j, b, pairs, used
      integer, allocatable :: row(:), column(:)

      start = 0                                  ! the slots of each body
      do s = 1, size(self%body)
         start(self%body(s) + 1) = start(self%body(s) + 1) + 1
      end do
      pairs = sum((start*(start + 1))/2)
      start(1) = 1
      do b = 1, bodies
         start(b + 1) = start(b) + start(b + 1)
      end do
      next = start(:bodies)
      do s = 1, size(self%body)
         touching(next(self%body(s))) = s
         next(self%body(s)) = next(self%body(s)) + 1
      end do
      allocate (self%pair(3, pairs), row(pairs + size(self%held)), column(pairs + size(self%held)))
      number = 0
      used = 0
      pairs = 0
      do k = 1, size(self%held)
         used = used + 1                         ! a row that holds no body has its zero, too
         number(k) = used
         row(used) = k
         column(used) = k
         do s = self%first(k), self%first(k + 1) - 1
            do j = start(self%body(s)), start(self%body(s) + 1) - 1
               associate (other => self%row(touching(j)))
                  if (other < k) cycle
                  if (number(other) < number(k)) then
                     used = used + 1
                     number(other) = used
                     row(used) = other
                     column(used) = k
                  end if
                  pairs = pairs + 1
                  self%pair(:, pairs) = [number(other), touching(j), s]
               end associate
            end do
         end do
      end do
      self%entry_row = row(:used)
      self%entry_column = column(:used)
   end subroutine find_products

   !> Compares two states: determines whether det(Φq(a) Φq(b)ᵀ) < 0, and whether Φq loses rank at or near b, where this
   !> sign has no meaning.
   !>
   !> x·Φq(a) Φq(b)ᵀ x > 0 for all x means a positive determinant; otherwise the LU factors give the sign.
   !> Equation (K.17) of docs/theory/kkt.md.
   pure subroutine compare_orientation(self, suspension, poses_a, poses_b, scale, is_turned_over, is_singular)
      type(orientation_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(pose_t), intent(in) :: poses_a(:), poses_b(:)   !! of the chassis and the bodies
      real(wp), intent(in) :: scale(:)                     !! of the unknowns, then of the rows: D of ek_scale
      logical, intent(out) :: is_turned_over, is_singular
      real(wp), allocatable :: rows(:, :)
      real(wp) :: min_a, least
      logical :: knows_a

      is_turned_over = .false.
      is_singular = .false.
      if (size(self%held) == 0) return
      min_a = self%min_b
      knows_a = are_same(poses_a, self%poses_b)
      if (knows_a) then                                    ! b of the last comparison
         call move_alloc(self%rows_a, rows)
         call move_alloc(self%rows_b, self%rows_a)
         call move_alloc(rows, self%rows_b)
      else
         call gather_rows(self, suspension, poses_a, scale, self%rows_a)
      end if
      call gather_rows(self, suspension, poses_b, scale, self%rows_b)
      call square(self, self%rows_b)
      call eliminate(self, self%lower, self%min_b)
      self%poses_b(:) = poses_b
      is_singular = self%min_b < vanished
      if (self%min_b < near) then                          ! a pivot of a is at most the largest
         if (.not. knows_a) then
            call square(self, self%rows_a)
            call eliminate(self, self%lower, min_a)
         end if
         is_singular = is_singular .or. self%min_b < near*min_a
      end if

      call multiply_out(self, self%rows_a, self%rows_b)
      call eliminate(self, self%lower, least, self%upper)
      if (.not. least > 0.0_wp) call find_sign(self, is_turned_over)
   end subroutine compare_orientation

   !> Whether two sets of poses are equal to rounding.
   pure logical function are_same(a, b)
      type(pose_t), intent(in) :: a(:), b(:)
      integer :: k

      are_same = .false.
      do k = 1, size(a)
         if (.not. (maxval(abs(a(k)%r - b(k)%r)) <= same .and. maxval(abs(a(k)%q - b(k)%q)) <= same)) return
      end do
      are_same = .true.
   end function are_same

   !> Computes the products of all rows of a state that share a body.
   pure subroutine square(self, rows)
      type(orientation_t), intent(inout) :: self
      real(wp), intent(in) :: rows(6, *)
      integer :: p

      self%lower = 0.0_wp
      do p = 1, size(self%pair, 2)
         associate (k => self%pair(1, p), later => self%pair(2, p), earlier => self%pair(3, p))
            self%lower(k) = self%lower(k) + dot_product(rows(:, later), rows(:, earlier))
         end associate
      end do
   end subroutine square

   !> Computes the products of the rows of a and the rows of b that share a body.
   pure subroutine multiply_out(self, rows_a, rows_b)
      type(orientation_t), intent(inout) :: self
      real(wp), intent(in) :: rows_a(6, *), rows_b(6, *)
      integer :: p

      self%lower = 0.0_wp
      self%upper = 0.0_wp
      do p = 1, size(self%pair, 2)
         associate (k => self%pair(1, p), later => self%pair(2, p), earlier => self%pair(3, p))
            self%lower(k) = self%lower(k) + dot_product(rows_a(:, later), rows_b(:, earlier))
            self%upper(k) = self%upper(k) + dot_product(rows_a(:, earlier), rows_b(:, later))
         end associate
      end do
   end subroutine multiply_out

   !> Eliminates a symmetric matrix by Gauss's method: `products`, or `products` + `others`, the sum of a matrix and its transpose.
   pure subroutine eliminate(self, products, least, others)
      type(orientation_t), intent(inout) :: self
      real(wp), intent(in) :: products(:)
      real(wp), intent(out) :: least         !! the smallest pivot as a share of the largest; 0: not positive definite
      real(wp), intent(in), optional :: others(:)
      real(wp) :: most, share
      integer :: k, a, b, m, t

      associate (plan => self%plan, x => self%factors)
         x = 0.0_wp
         do k = 1, size(products)
            x(plan%slot(k)) = products(k)
            if (present(others)) x(plan%slot(k)) = products(k) + others(k)
         end do
         least = huge(least)
         most = 0.0_wp
         t = 0
         do k = 1, plan%blocks
            associate (s => plan%start(k))
               least = min(least, x(s))
               most = max(most, x(s))
               if (.not. x(s) > 0.0_wp) exit
               m = plan%first(k + 1) - plan%first(k)
               do b = 1, m
                  share = x(s + b)/x(s)
                  do a = b, m
                     t = t + 1
                     x(plan%places(t)) = x(plan%places(t)) - share*x(s + a)
                  end do
               end do
            end associate
         end do
      end associate
      least = max(least, 0.0_wp)/max(most, tiny(most))
   end subroutine eliminate

   !> Allocates memory for LU factors.
   pure subroutine allocate_dense(self)
      type(orientation_t), intent(inout) :: self

      associate (n => size(self%held))
         allocate (self%product(n, n), self%unit(n, 1), self%pivots(n))
      end associate
   end subroutine allocate_dense

   !> Finds whether det(Φq(a) Φq(b)ᵀ) < 0, by LU factors of the complete matrix of products. For a singular matrix the
   !> result is .false.
   pure subroutine find_sign(self, is_negative)
      type(orientation_t), intent(inout) :: self
      logical, intent(out) :: is_negative
      integer :: k, n, info

      n = size(self%held)
      if (.not. allocated(self%product)) call allocate_dense(self)
      self%product = 0.0_wp
      do k = 1, size(self%lower)
         self%product(self%entry_column(k), self%entry_row(k)) = self%upper(k)
         self%product(self%entry_row(k), self%entry_column(k)) = self%lower(k)
      end do
      self%unit = 0.0_wp      ! without a right-hand side OpenBLAS would not compute the factors
      call dgesv(n, 1, self%product, n, self%pivots, self%unit, n, info)
      is_negative = .false.
      if (info /= 0) return
      do k = 1, n
         if ((self%product(k, k) < 0.0_wp) .neqv. self%pivots(k) /= k) is_negative = .not. is_negative
      end do
   end subroutine find_sign

   !> Computes scaled Φq of the rigid rows at the poses of a state.
   pure subroutine gather_rows(self, suspension, poses, scale, rows)
      type(orientation_t), intent(in) :: self
      type(suspension_t), intent(in) :: suspension
      type(pose_t), intent(in) :: poses(0:)                  !! the chassis, then the bodies
      real(wp), intent(in) :: scale(:)
      real(wp), contiguous, intent(inout) :: rows(:, :)      !! (6, slot)
      type(evaluation_t) :: evaluation
      integer :: k, t, s, nq, at

      nq = suspension%unknowns()
      rows = 0.0_wp
      do k = 1, size(self%held)
         associate (row => suspension%rows(self%held(k)))
            do t = row%first, row%first + row%terms - 1
               associate (m => suspension%terms(t)%measure, factor => suspension%terms(t)%coefficient)
                  call evaluate(m, poses(m%body_i), poses(m%body_j), evaluation)
                  s = self%slot_of(1, t)
                  if (s > 0) rows(:, s) = rows(:, s) + factor*evaluation%gradient(1:6)
                  s = self%slot_of(2, t)
                  if (s > 0) rows(:, s) = rows(:, s) + factor*evaluation%gradient(7:12)
               end associate
            end do
         end associate
         do s = self%first(k), self%first(k + 1) - 1
            at = 6*(self%body(s) - 1)
            rows(:, s) = rows(:, s)*(scale(nq + self%held(k))*scale(at + 1:at + 6))
         end do
      end do
   end subroutine gather_rows

end module ek_orientation
