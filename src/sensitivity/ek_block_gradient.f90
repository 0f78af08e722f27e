!> The derivatives of columns with respect to the unknowns z of a state, block by block, at a fixed design:
!>
!>     dy/dp = ∂y/∂z dz/dp + ∂y/∂p
!>
!> A block of columns (a wheel, an element, a joint) follows from the poses of two bodies at most, and from some reactions. ∂y/∂z is
!> found by differences of the block alone, with the formula by which it is observed. For many numbers p this costs less than the
!> observation of all columns in two designs for each p.
module ek_block_gradient
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t
   use ek_relative_rotation, only: pose_t
   use ek_motion, only: move_all
   use ek_kkt, only: kkt_t
   use ek_stencil, only: stencils, differentiate
   use ek_column_gradient, only: step_of_place
   use ek_column_observer, only: column_observer_t, count_blocks, columns_of_block, find_reads, observe_block
   implicit none(type, external)
   private
   public :: block_gradients_t, begin_gradients, are_cheaper, find_block_gradients, add_motions

   !> ∂y/∂z of the columns of a block.
   type :: block_gradient_t
      integer :: first = 0, last = 0                       !! columns
      integer, allocatable :: unknowns(:)                  !! the unknowns that the block follows from
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
      integer :: b, u, k, j, body

      do k = 1, kkt%nq
         body = (k + 5)/6
         do j = 1, 4
            step = 0.0_wp
            step(k - 6*body + 6) = stencils(1)%at(j)*step_of(k)
            pair = state%poses(body:body + 1)
            call move_all(1, step, pair)
            self%poses(j, k) = pair(2)
         end do
      end do
      moved%poses(:) = state%poses
      moved%reaction(:) = state%reaction
      do b = 1, size(self%blocks)
         associate (this => self%blocks(b))
            do u = 1, size(this%unknowns)
               k = this%unknowns(u)
               h = step_of(k)
               body = (k + 5)/6
               do j = 1, 4
                  if (k <= kkt%nq) then
                     moved%poses(body + 1) = self%poses(j, k)
                  else
                     moved%reaction(k - kkt%nq) = state%reaction(k - kkt%nq) + stencils(1)%at(j)*h
                  end if
                  call observe_block(suspension, moved, kkt, observer, b, y(:, j))
               end do
               if (k <= kkt%nq) moved%poses(body + 1) = state%poses(body + 1)
               if (k > kkt%nq) moved%reaction(k - kkt%nq) = state%reaction(k - kkt%nq)
               call differentiate(stencils(1), h, values(this%first:this%last), y(this%first:this%last, :), this%slopes(u, :), &
                  this%errors(u, :))
            end do
         end associate
      end do

   contains

      !> The step of an unknown: step_of_place, or the step of equal work.
      pure real(wp) function step_of(unknown)
         integer, intent(in) :: unknown
         step_of = step_of_place*sqrt(kkt%stiffness)*kkt%scale(unknown)
      end function step_of

   end subroutine find_block_gradients

   !> Adds ∂y/∂z dz/dp of all numbers p to the slopes of all columns, and its error to the errors.
   !> Equation (E.9) of docs/theory/derivatives.md.
   subroutine add_motions(motions, self, slopes, errors)
      real(wp), intent(in) :: motions(:, :)                !! (unknown, number): dz/dp
      type(block_gradients_t), intent(in) :: self
      real(wp), intent(inout) :: slopes(:, :), errors(:, :)      !! (column, number)
      real(wp) :: rates(size(motions, 2), size(motions, 1)), sum_of(size(motions, 2)), limit(size(motions, 2))
      integer :: b, c

      rates = transpose(motions)
      do b = 1, size(self%blocks)
         associate (this => self%blocks(b))
            do c = this%first, this%last
               sum_of = slopes(c, :)
               limit = errors(c, :)
               call add_products(size(sum_of), size(this%unknowns), this%unknowns, this%slopes(:, c), this%errors(:, c), rates, &
                  sum_of, limit)
               slopes(c, :) = sum_of
               errors(c, :) = limit
            end do
         end associate
      end do
   end subroutine add_motions

   !> Adds ∂y/∂z dz/dp of one column for n numbers. Explicit shapes, and several unknowns at a time, let the compiler generate fast
   !> code.
   pure subroutine add_products(n, m, unknowns, slopes, errors, rates, sum_of, limit)
      integer, intent(in) :: n, m, unknowns(m)
      real(wp), intent(in) :: slopes(m), errors(m)         !! ∂y/∂z, and its error
      real(wp), intent(in) :: rates(n, *)                  !! (number, unknown): dz/dp
      real(wp), intent(inout) :: sum_of(n), limit(n)
      integer :: u, p

      do u = 1, m - 2, 3
         associate (i => unknowns(u), j => unknowns(u + 1), k => unknowns(u + 2))
            do p = 1, n
               sum_of(p) = sum_of(p) + slopes(u)*rates(p, i) + slopes(u + 1)*rates(p, j) + slopes(u + 2)*rates(p, k)
               limit(p) = limit(p) + errors(u)*abs(rates(p, i)) + errors(u + 1)*abs(rates(p, j)) + errors(u + 2)*abs(rates(p, k))
            end do
         end associate
      end do
      do u = 3*(m/3) + 1, m
         sum_of = sum_of + slopes(u)*rates(:, unknowns(u))
         limit = limit + errors(u)*abs(rates(:, unknowns(u)))
      end do
   end subroutine add_products

end module ek_block_gradient
