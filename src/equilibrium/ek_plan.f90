!> A plan of elimination for the factors L D Lᵀ of a sparse symmetric matrix. The order, the pattern with its fill, and the
!> positions of all updates are found once for all matrices of one pattern.
!>
!> D has blocks of one or two unknowns (ek_elimination_order). The factors are stored in one array x: per block the lower
!> triangle of D⁻¹, then the columns of L. ek_plan_factors computes the factors.
module ek_plan
   use ek_kinds, only: wp
   use ek_elimination_order, only: order_t, find_order, natural_order
   implicit none(type, external)
   private
   public :: plan_t, new_plan, new_natural_plan

   !> A plan of elimination: order, pattern with fill, and positions of all updates.
   type :: plan_t
      integer :: n = 0                        !! number of unknowns
      integer :: blocks = 0                   !! number of pivots
      integer :: length = 0                   !! length of x
      integer, allocatable :: pivot(:, :)     !! (2, block): unknowns; the second is 0 for a pivot of one unknown
      integer, allocatable :: start(:)        !! index in x of D⁻¹ of each block
      integer, allocatable :: first(:)        !! (blocks + 1): index in `rows` of the first row of each block
      integer, allocatable :: rows(:)         !! unknowns of the rows of L, block by block
      integer, allocatable :: places(:)       !! indices in x of all updates, one block after the other
      integer, allocatable :: slot(:)         !! index in x of each entry of the pattern
   end type plan_t

contains

   !> Creates the plan for a pattern of n unknowns. The entries are given as in find_order.
   subroutine new_plan(n, row, column, values, plan)
      integer, intent(in) :: n
      integer, intent(in) :: row(:), column(:)   !! of each entry
      real(wp), intent(in) :: values(:, :)       !! (sample, entry)
      type(plan_t), intent(out) :: plan
      type(order_t) :: order

      call find_order(n, row, column, values, order)
      call lay_out(n, row, column, order, plan)
   end subroutine new_plan

   !> Creates the plan that eliminates the unknowns one by one from first to last.
   subroutine new_natural_plan(n, row, column, plan)
      integer, intent(in) :: n
      integer, intent(in) :: row(:), column(:)   !! of each entry
      type(plan_t), intent(out) :: plan
      type(order_t) :: order

      call natural_order(n, row, column, order)
      call lay_out(n, row, column, order, plan)
   end subroutine new_natural_plan

   !> Finds the positions of all numbers and updates for an order of elimination.
   pure subroutine lay_out(n, row, column, order, plan)
      integer, intent(in) :: n
      integer, intent(in) :: row(:), column(:)   !! of each entry
      type(order_t), intent(in) :: order
      type(plan_t), intent(inout) :: plan
      integer :: position(n), owner(n), p, k, m, used, at, b, place_in(n)

      plan%n = n
      plan%blocks = order%blocks
      plan%pivot = order%pivot
      plan%first = order%first
      plan%rows = order%rows
      allocate (plan%start(plan%blocks), plan%slot(size(row)))
      used = 0
      at = 0
      do p = 1, plan%blocks
         do k = 1, 2
            if (plan%pivot(k, p) == 0) cycle
            used = used + 1
            position(plan%pivot(k, p)) = used
            owner(plan%pivot(k, p)) = p
         end do
         plan%start(p) = at + 1
         m = plan%first(p + 1) - plan%first(p)
         at = at + merge(1 + m, 3 + 2*m, plan%pivot(2, p) == 0)
      end do
      plan%length = at
      used = 0
      do p = 1, plan%blocks
         m = plan%first(p + 1) - plan%first(p)
         call sort_rows(position, plan%rows(plan%first(p):plan%first(p + 1) - 1))
         used = used + (m*(m + 1))/2
      end do
      allocate (plan%places(used))
      used = 0
      do p = 1, plan%blocks
         do b = plan%first(p), plan%first(p + 1) - 1
            call find_places(plan, owner(plan%rows(b)), place_in)
            do k = b, plan%first(p + 1) - 1
               used = used + 1
               plan%places(used) = place_of(plan, owner, place_in, plan%rows(b), plan%rows(k))
            end do
         end do
      end do
      do k = 1, size(row)
         b = merge(row(k), column(k), position(row(k)) < position(column(k)))
         call find_places(plan, owner(b), place_in)
         plan%slot(k) = place_of(plan, owner, place_in, b, row(k) + column(k) - b)
      end do
   end subroutine lay_out

   !> Sorts unknowns by their position in the order of elimination.
   pure subroutine sort_rows(position, rows)
      integer, intent(in) :: position(:)
      integer, intent(inout) :: rows(:)
      integer :: k, j, this

      do k = 2, size(rows)
         this = rows(k)
         do j = k - 1, 1, -1
            if (position(rows(j)) <= position(this)) exit
            rows(j + 1) = rows(j)
         end do
         rows(j + 1) = this
      end do
   end subroutine sort_rows

   !> Finds the position of each unknown among the rows of a block.
   pure subroutine find_places(plan, block, place_in)
      type(plan_t), intent(in) :: plan
      integer, intent(in) :: block
      integer, intent(inout) :: place_in(:)
      integer :: k

      do k = plan%first(block), plan%first(block + 1) - 1
         place_in(plan%rows(k)) = k - plan%first(block) + 1
      end do
   end subroutine find_places

   !> The position in x of the entry of two unknowns, of which `earlier` is eliminated before `later` or together with it.
   pure integer function place_of(plan, owner, place_in, earlier, later) result(place)
      type(plan_t), intent(in) :: plan
      integer, intent(in) :: owner(:), place_in(:)      !! place_in: of the block of `earlier`
      integer, intent(in) :: earlier, later
      integer :: p

      p = owner(earlier)
      associate (start => plan%start(p), m => plan%first(p + 1) - plan%first(p))
         if (owner(later) == p) then
            place = start + merge(1, 0, earlier /= later)          ! D: 11, 21, 22
            if (earlier == later .and. earlier == plan%pivot(2, p)) place = start + 2
         else if (plan%pivot(2, p) == 0) then
            place = start + place_in(later)
         else
            place = start + 2 + place_in(later) + merge(m, 0, earlier == plan%pivot(2, p))
         end if
      end associate
   end function place_of

end module ek_plan
