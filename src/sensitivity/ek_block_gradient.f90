!> The derivatives of columns with respect to the unknowns z of a state, block by block, at a fixed design:
!>
!>     dy/dp = ∂y/∂z dz/dp + ∂y/∂p
!>
!> A block of columns (a wheel, an element, a joint) follows from the poses of two bodies at most, and from some reactions. ∂y/∂z is
!> found by differences of the block alone, with the formula by which it is observed. For many numbers p this costs less than the
!> observation of all columns in two designs for each p.
module ek_block_gradient
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t
   use ek_lapack, only: dgemm
   use ek_rotation, only: cross
   use ek_relative_rotation, only: pose_t
   use ek_motion, only: move_all
   use ek_kkt, only: kkt_t
   use ek_stencil, only: stencils, differentiate
   use ek_column_gradient, only: step_of_place
   use ek_column_observer, only: column_observer_t, count_blocks, columns_of_block, find_reads, find_pair, observe_block
   implicit none(type, external)
   private
   public :: block_gradients_t, begin_gradients, are_cheaper, find_block_gradients, find_shares

   !> ∂y/∂z of the columns of a block. If the block follows from the pose of body_j relative to body_i, only body_j is moved, and the
   !> unknowns of body_j stand for the motion of body_j relative to body_i.
   type :: block_gradient_t
      integer :: first = 0, last = 0                       !! columns
      integer, allocatable :: unknowns(:)                  !! the unknowns that the block follows from
      integer :: body_i = 0, body_j = 0                    !! 0: the block follows from the unknowns themselves
      real(wp) :: gap(3) = 0.0_wp                          !! from the reference point of body_i to that of body_j [m]
      real(wp), allocatable :: slopes(:, :), errors(:, :)  !! (unknown, column): ∂y/∂z, and the estimate of its error
   end type block_gradient_t

   !> ∂y/∂z of all columns at a state.
   type :: block_gradients_t
      type(block_gradient_t), allocatable, private :: blocks(:)
      type(pose_t), allocatable, private :: poses(:, :)    !! (point, unknown): pose of a body with one unknown moved
   end type block_gradients_t

contains

   !> Prepares the gradients of the columns of an observer (reads_states).
   subroutine begin_gradients(suspension, kkt, observer, self)
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(in) :: kkt
      type(column_observer_t), intent(in) :: observer
      type(block_gradients_t), intent(out) :: self
      logical :: is_read(kkt%n)
      integer :: b, k

      allocate (self%blocks(count_blocks(observer)), self%poses(4, kkt%nq))
      do b = 1, size(self%blocks)
         associate (this => self%blocks(b))
            call columns_of_block(observer, b, this%first, this%last)
            call find_reads(suspension, observer, b, is_read)
            call find_pair(suspension, observer, b, this%body_i, this%body_j)
            if (this%body_i > 0) is_read(6*this%body_i - 5:6*this%body_i) = .false.
            this%unknowns = pack([(k, k=1, kkt%n)], is_read)
            allocate (this%slopes(size(this%unknowns), this%first:this%last), this%errors(size(this%unknowns), &
               this%first:this%last))
         end associate
      end do
   end subroutine begin_gradients

   !> Whether the gradients cost less than the observation of all blocks in the designs next to a design, for each of n numbers.
   pure logical function are_cheaper(self, n)
      type(block_gradients_t), intent(in) :: self          !! from begin_gradients
      integer, intent(in) :: n                             !! count of the numbers
      integer :: b
      are_cheaper = sum([(size(self%blocks(b)%unknowns), b=1, size(self%blocks))]) < n*size(self%blocks)
   end function are_cheaper

   !> Finds ∂y/∂z of all columns at a state.
   !> Equation (E.9) of docs/theory/derivatives.md.
   subroutine find_block_gradients(suspension, state, kkt, values, observer, moved, self)
      type(suspension_t), intent(in) :: suspension         !! suspension on the rig
      type(state_t), intent(in) :: state
      type(kkt_t), intent(inout) :: kkt                    !! work space
      real(wp), intent(in) :: values(:)                    !! values of the columns at the state
      type(column_observer_t), intent(inout) :: observer
      type(state_t), intent(inout) :: moved                !! work space: any state of this model
      type(block_gradients_t), intent(inout) :: self
      real(wp) :: y(size(values), 4), h, step(6)
      type(pose_t) :: pair(2)
      integer :: b, u, k, i, j, body

      do k = 1, kkt%nq
         body = (k + 5)/6
         do j = 1, 4
            i = k - 6*body + 6
            pair = state%poses(body:body + 1)
            if (i <= 3) then
               pair(2)%r(i) = pair(2)%r(i) + stencils(1)%at(j)*step_of(k)
            else
               step = 0.0_wp
               step(i) = stencils(1)%at(j)*step_of(k)
               call move_all(1, step, pair)
            end if
            self%poses(j, k) = pair(2)
         end do
      end do
      moved%poses(:) = state%poses
      moved%reaction(:) = state%reaction
      do b = 1, size(self%blocks)
         associate (this => self%blocks(b))
            if (this%body_i > 0) this%gap = state%poses(this%body_j + 1)%r - state%poses(this%body_i + 1)%r
            do u = 1, size(this%unknowns)
               k = this%unknowns(u)
               if (k > kkt%nq) then
                  call observe_unit(k - kkt%nq, b, this%slopes(u, :), this%errors(u, :))
                  cycle
               end if
               h = step_of(k)
               body = (k + 5)/6
               do j = 1, 4
                  moved%poses(body + 1) = self%poses(j, k)
                  call observe_block(suspension, moved, kkt, observer, b, y(:, j))
               end do
               moved%poses(body + 1) = state%poses(body + 1)
               call differentiate(stencils(1), h, values(this%first:this%last), y(this%first:this%last, :), this%slopes(u, :), &
                  this%errors(u, :))
            end do
         end associate
      end do

   contains

      !> Finds the derivatives of columns with respect to a reaction. Columns that follow from reactions, the forces of joints, are
      !> proportional to them, so that the derivatives are the values for one reaction of 1, without the others.
      subroutine observe_unit(row, b, slopes, errors)
         integer, intent(in) :: row, b
         real(wp), intent(out) :: slopes(:), errors(:)

         moved%reaction(:) = 0.0_wp
         moved%reaction(row) = 1.0_wp
         call observe_block(suspension, moved, kkt, observer, b, y(:, 1))
         moved%reaction(:) = state%reaction
         slopes = y(self%blocks(b)%first:self%blocks(b)%last, 1)
         errors = 0.0_wp
      end subroutine observe_unit

      !> The step of an unknown: step_of_place, or the step of equal work.
      pure real(wp) function step_of(unknown)
         integer, intent(in) :: unknown
         step_of = step_of_place*sqrt(kkt%stiffness)*kkt%scale(unknown)
      end function step_of

   end subroutine find_block_gradients

   !> Finds ∂y/∂z dz/dp of all columns y and numbers p, and the errors. A column without a value has none: NaN.
   !> Equation (E.9) of docs/theory/derivatives.md.
   subroutine find_shares(motions, values, self, slopes, errors)
      real(wp), contiguous, intent(in) :: motions(:, :)    !! (unknown, number): dz/dp
      real(wp), intent(in) :: values(:)                    !! values of the columns at the state
      type(block_gradients_t), intent(in) :: self
      real(wp), contiguous, intent(inout) :: slopes(:, :), errors(:, :)      !! (column, number)
      real(wp) :: rates(size(motions, 1), size(motions, 2))
      integer :: b, m, c

      slopes = 0.0_wp
      errors = 0.0_wp
      do b = 1, size(self%blocks)
         associate (this => self%blocks(b))
            m = size(this%unknowns)
            call find_rates(this, size(rates, 1), size(rates, 2), motions, rates)
            call multiply(this%slopes, rates, size(slopes, 1), size(slopes, 2), slopes)
            rates(:m, :) = abs(rates(:m, :))
            call multiply(this%errors, rates, size(slopes, 1), size(slopes, 2), errors)
         end associate
      end do
      do c = 1, size(values)
         if (ieee_is_finite(values(c))) cycle
         slopes(c, :) = values(c) - values(c)
         errors(c, :) = slopes(c, :)
      end do

   contains

      !> Computes gradientᵀ × rates, the rows of a block; they are zero before (a factor β = 0 would cost more).
      subroutine multiply(gradient, factors, columns, numbers, product)
         integer, intent(in) :: columns, numbers
         real(wp), contiguous, intent(in) :: gradient(:, :)      !! (unknown of the block, column of the block)
         real(wp), contiguous, intent(in) :: factors(:, :)       !! (unknown of the block, number)
         real(wp), intent(inout) :: product(columns, numbers)
         call dgemm('T', 'N', size(gradient, 2), numbers, m, 1.0_wp, gradient, max(1, m), factors, size(factors, 1), 1.0_wp, &
            product(self%blocks(b)%first, 1), columns)
      end subroutine multiply

   end subroutine find_shares

   !> Finds the motions of the unknowns of a block: dz/dp, and of a pair of bodies the motion of body_j minus that of body_i, which
   !> carries body_j with it. Equation (E.10) of docs/theory/derivatives.md. Explicit shapes let the compiler generate fast code.
   pure subroutine find_rates(this, n, numbers, motions, rates)
      type(block_gradient_t), intent(in) :: this
      integer, intent(in) :: n, numbers
      real(wp), intent(in) :: motions(n, numbers)          !! dz/dp
      real(wp), intent(inout) :: rates(n, numbers)         !! (unknown of the block, number)
      integer :: p, u, i, k, m

      m = size(this%unknowns)
      if (m == 0) return
      k = this%unknowns(1)
      i = 6*this%body_i - 5
      do p = 1, numbers
         if (k + m - 1 == this%unknowns(m)) then            ! next to one another: most blocks
            rates(:m, p) = motions(k:k + m - 1, p)
         else
            do u = 1, m
               rates(u, p) = motions(this%unknowns(u), p)
            end do
         end if
         if (i < 0) cycle
         rates(1:3, p) = rates(1:3, p) - motions(i:i + 2, p) - cross(motions(i + 3:i + 5, p), this%gap)
         rates(4:6, p) = rates(4:6, p) - motions(i + 3:i + 5, p)
      end do
   end subroutine find_rates

end module ek_block_gradient
