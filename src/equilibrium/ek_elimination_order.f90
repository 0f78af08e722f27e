!> The order of elimination of a sparse symmetric indefinite matrix, found once for all matrices of its pattern.
!>
!> At each step the pivot of least cost is taken: one unknown, or a pair of connected unknowns (2×2). The cost is the square of
!> the number of unknowns that the pivot couples (rule of Markowitz, minimum degree). The pivot must be stable in every sample
!> matrix: |D⁻¹| × the largest entries of its columns, with D the pivot, is at most 1/threshold, as in I. S. Duff and J. K. Reid,
!> ACM TOMS 9 (1983) 302–325. Where no pivot is stable, the most stable pivot is taken; the factorisation then detects large
!> factors.
module ek_elimination_order
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: order_t, find_order, natural_order

   real(wp), parameter :: threshold = 0.02_wp     !! stability threshold: factors of the samples are below about 1/threshold
   real(wp), parameter :: vanished = 1.0e-30_wp   !! limit of a pivot of the scaled matrix: smaller pivots are not divided by

   !> Pivots in the order of elimination, and the unknowns that each pivot couples.
   type :: order_t
      integer :: blocks = 0
      integer, allocatable :: pivot(:, :)        !! (2, block): unknowns; the second is 0 for a pivot of one unknown
      integer, allocatable :: first(:)           !! (blocks + 1): index in `rows` of the first row of each block
      integer, allocatable :: rows(:)            !! unknowns that each pivot couples and that are eliminated later
   end type order_t

   !> The graph of the unknowns not yet eliminated, with the matrix entries of all samples.
   type :: graph_t
      integer :: n = 0, samples = 0, room = 0
      integer, allocatable :: degree(:)
      integer, allocatable :: next_to(:, :)      !! (neighbour, unknown): index of each neighbour of an unknown
      real(wp), allocatable :: value(:, :, :)    !! (sample, neighbour, unknown): entries off the diagonal
      real(wp), allocatable :: diagonal(:, :)    !! (sample, unknown): entries of the diagonal
      logical, allocatable :: is_left(:)
      integer, allocatable :: mark(:)            !! work space: index of a neighbour, or 0
   end type graph_t

   !> The best pivot that contains an unknown.
   type :: candidate_t
      integer :: partner = 0                     !! the other unknown; 0: a pivot of one unknown
      integer :: cost = huge(0)
      real(wp) :: size = huge(1.0_wp)            !! stability measure (factor_size): stable up to 1/threshold
   end type candidate_t

contains

   !> Finds the order for a pattern of n unknowns. Each entry of the pattern is given once, with its values in the samples; the
   !> entry may be above or below the diagonal.
   subroutine find_order(n, row, column, values, order)
      integer, intent(in) :: n
      integer, intent(in) :: row(:), column(:)   !! of each entry
      real(wp), intent(in) :: values(:, :)       !! (sample, entry)
      type(order_t), intent(out) :: order
      type(graph_t) :: graph
      type(candidate_t) :: best(n)
      logical :: is_known(n)
      integer :: coupled(n), next, many, k, j, left

      call new_graph(n, row, column, values, graph)
      allocate (order%pivot(2, n), order%first(n + 1), order%rows(0))
      is_known = .false.
      left = n
      do while (left > 0)
         do k = 1, n
            if (.not. graph%is_left(k) .or. is_known(k)) cycle
            call find_candidate(graph, k, best(k))
            is_known(k) = .true.
         end do
         next = 0
         do k = 1, n
            if (.not. graph%is_left(k)) cycle
            if (next == 0) then
               next = k
            else if (is_better(best(k), best(next))) then
               next = k
            end if
         end do
         order%blocks = order%blocks + 1
         order%pivot(:, order%blocks) = [next, best(next)%partner]
         order%first(order%blocks) = size(order%rows) + 1
         call eliminate(graph, next, best(next)%partner, coupled, many)
         order%rows = [order%rows, coupled(:many)]
         left = left - merge(1, 2, best(next)%partner == 0)
         do k = 1, many      ! what has changed, and what may pair with it
            is_known(coupled(k)) = .false.
            do j = 1, graph%degree(coupled(k))
               is_known(graph%next_to(j, coupled(k))) = .false.
            end do
         end do
      end do
      order%first(order%blocks + 1) = size(order%rows) + 1
      order%pivot = order%pivot(:, :order%blocks)
      order%first = order%first(:order%blocks + 1)
   end subroutine find_order

   !> Lists the unknowns one by one from first to last, with the fill of this order. The matrix must be positive definite.
   subroutine natural_order(n, row, column, order)
      integer, intent(in) :: n
      integer, intent(in) :: row(:), column(:)   !! of each entry, as in find_order
      type(order_t), intent(out) :: order
      integer :: start(n + 1), next(n), child(n), sibling(n), mark(n), below(size(row)), k, j, this, used, parent
      integer, allocatable :: longer(:)

      start = 0
      do k = 1, size(row)
         if (row(k) /= column(k)) start(min(row(k), column(k)) + 1) = start(min(row(k), column(k)) + 1) + 1
      end do
      start(1) = 1
      do k = 1, n
         start(k + 1) = start(k) + start(k + 1)
      end do
      next = start(:n)
      do k = 1, size(row)
         if (row(k) == column(k)) cycle
         this = min(row(k), column(k))
         below(next(this)) = max(row(k), column(k))
         next(this) = next(this) + 1
      end do
      order%blocks = n
      allocate (order%pivot(2, n), order%first(n + 1), source=0)
      allocate (order%rows(2*size(row) + n))
      child = 0
      mark = 0
      used = 0
      do k = 1, n
         order%pivot(1, k) = k
         order%first(k) = used + 1
         mark(k) = k
         if (used + n > size(order%rows)) then
            allocate (longer(2*size(order%rows) + n))
            longer(:used) = order%rows(:used)
            call move_alloc(longer, order%rows)
         end if
         do j = start(k), start(k + 1) - 1
            call add(below(j))
         end do
         this = child(k)                         ! columns whose first row is k hand their rows on
         do while (this > 0)
            do j = order%first(this), order%first(this + 1) - 1
               call add(order%rows(j))
            end do
            this = sibling(this)
         end do
         order%first(k + 1) = used + 1
         if (used < order%first(k)) cycle
         parent = minval(order%rows(order%first(k):used))
         sibling(k) = child(parent)
         child(parent) = k
      end do
      order%first(n + 1) = used + 1
      order%rows = order%rows(:used)

   contains

      !> Adds an unknown to the rows of pivot k, unless the pivot already couples this unknown.
      subroutine add(unknown)
         integer, intent(in) :: unknown
         if (mark(unknown) == k) return
         mark(unknown) = k
         used = used + 1
         order%rows(used) = unknown
      end subroutine add

   end subroutine natural_order

   !> Whether pivot a is better than pivot b. Stable pivots come before unstable pivots. Of two stable pivots the cheaper is better;
   !> of two unstable pivots, the more stable.
   pure logical function is_better(a, b)
      type(candidate_t), intent(in) :: a, b

      if (a%size <= 1.0_wp/threshold .and. b%size <= 1.0_wp/threshold) then
         is_better = a%cost < b%cost
      else
         is_better = a%size < b%size
      end if
   end function is_better

   !> Creates the graph of the complete matrix.
   pure subroutine new_graph(n, row, column, values, graph)
      integer, intent(in) :: n, row(:), column(:)
      real(wp), intent(in) :: values(:, :)
      type(graph_t), intent(out) :: graph
      integer :: k

      graph%n = n
      graph%samples = size(values, 1)
      allocate (graph%degree(n), graph%mark(n), source=0)
      allocate (graph%is_left(n), source=.true.)
      allocate (graph%diagonal(graph%samples, n), source=0.0_wp)
      do k = 1, size(row)
         if (row(k) == column(k)) cycle
         graph%degree(row(k)) = graph%degree(row(k)) + 1
         graph%degree(column(k)) = graph%degree(column(k)) + 1
      end do
      graph%room = 2*max(0, maxval(graph%degree)) + 8
      allocate (graph%next_to(graph%room, n), source=0)
      allocate (graph%value(graph%samples, graph%room, n), source=0.0_wp)
      graph%degree = 0
      do k = 1, size(row)
         if (row(k) == column(k)) then
            graph%diagonal(:, row(k)) = values(:, k)
         else
            call append(graph, row(k), column(k), values(:, k))
            call append(graph, column(k), row(k), values(:, k))
         end if
      end do
   end subroutine new_graph

   !> Adds a neighbour to an unknown of the graph.
   pure subroutine append(graph, at, other, values)
      type(graph_t), intent(inout) :: graph
      integer, intent(in) :: at, other
      real(wp), intent(in) :: values(:)
      integer, allocatable :: next_to(:, :)
      real(wp), allocatable :: value(:, :, :)

      if (graph%degree(at) == graph%room) then
         allocate (next_to(2*graph%room, graph%n), source=0)
         allocate (value(graph%samples, 2*graph%room, graph%n), source=0.0_wp)
         next_to(:graph%room, :) = graph%next_to
         value(:, :graph%room, :) = graph%value
         call move_alloc(next_to, graph%next_to)
         call move_alloc(value, graph%value)
         graph%room = 2*graph%room
      end if
      graph%degree(at) = graph%degree(at) + 1
      graph%next_to(graph%degree(at), at) = other
      graph%value(:, graph%degree(at), at) = values
   end subroutine append

   !> Removes an unknown from the neighbours of another unknown.
   pure subroutine remove(graph, at, other)
      type(graph_t), intent(inout) :: graph
      integer, intent(in) :: at, other
      integer :: k

      k = findloc(graph%next_to(:graph%degree(at), at), other, dim=1)
      if (k == 0) return
      associate (last => graph%degree(at))
         graph%next_to(k, at) = graph%next_to(last, at)
         graph%value(:, k, at) = graph%value(:, last, at)
         last = last - 1
      end associate
   end subroutine remove

   !> Finds the cheapest stable pivot that contains an unknown. If no pivot is stable, finds the most stable pivot.
   pure subroutine find_candidate(graph, at, best)
      type(graph_t), intent(inout) :: graph      !! graph%mark is used and cleared
      integer, intent(in) :: at
      type(candidate_t), intent(out) :: best
      type(candidate_t) :: this
      integer :: cost(0:graph%degree(at)), k, j, other, extra, tries

      associate (degree => graph%degree(at), near => graph%next_to(:graph%degree(at), at))
         cost(0) = degree**2
         graph%mark(near) = 1
         do k = 1, degree
            other = near(k)
            extra = 0
            do j = 1, graph%degree(other)
               if (graph%mark(graph%next_to(j, other)) == 0) extra = extra + 1
            end do
            cost(k) = (degree + extra - 2)**2      ! `at` itself is among the extra ones, its partner among the degree
         end do
         graph%mark(near) = 0
         do tries = 0, degree
            k = minloc(cost, dim=1) - 1
            this%cost = cost(k)
            this%partner = 0
            if (k > 0) this%partner = near(k)
            this%size = factor_size(graph, at, k)
            if (is_better(this, best)) best = this
            if (this%size <= 1.0_wp/threshold) return
            cost(k) = huge(0)
         end do
      end associate
   end subroutine find_candidate

   !> The stability measure of a pivot: the largest |D⁻¹| × (largest entries of its columns) over the samples. The pivot is an
   !> unknown, together with its neighbour k if k > 0.
   !> Equation (K.24) of docs/theory/kkt.md.
   pure real(wp) function factor_size(graph, at, k) result(largest)
      type(graph_t), intent(in) :: graph
      integer, intent(in) :: at, k
      real(wp) :: d(3), g(2), determinant
      integer :: s, j, other

      largest = 0.0_wp
      do s = 1, graph%samples
         g = 0.0_wp
         do j = 1, graph%degree(at)
            if (j /= k) g(1) = max(g(1), abs(graph%value(s, j, at)))
         end do
         d(1) = graph%diagonal(s, at)
         if (k == 0) then
            if (.not. abs(d(1)) > vanished) then
               largest = huge(largest)
               return
            end if
            largest = max(largest, g(1)/abs(d(1)))
            cycle
         end if
         other = graph%next_to(k, at)
         do j = 1, graph%degree(other)
            if (graph%next_to(j, other) /= at) g(2) = max(g(2), abs(graph%value(s, j, other)))
         end do
         d(2) = graph%value(s, k, at)
         d(3) = graph%diagonal(s, other)
         determinant = d(1)*d(3) - d(2)**2
         if (.not. abs(determinant) > max(vanished, 1.0e-12_wp*max(abs(d(1)*d(3)), d(2)**2))) then
            largest = huge(largest)
            return
         end if
         largest = max(largest, (abs(d(3))*g(1) + abs(d(2))*g(2))/abs(determinant), &
            (abs(d(2))*g(1) + abs(d(1))*g(2))/abs(determinant))
      end do
   end function factor_size

   !> Eliminates a pivot. The unknowns that the pivot couples become a clique, with the matrix entries of all samples.
   subroutine eliminate(graph, first, second, coupled, many)
      type(graph_t), intent(inout) :: graph
      integer, intent(in) :: first, second       !! second = 0: a pivot of one
      integer, intent(out) :: coupled(:), many
      real(wp) :: c(2, graph%samples, graph%n), l(2, graph%samples), d(3, graph%samples), change(graph%samples), determinant
      integer :: k, j, s, at, other

      many = 0
      d(1, :) = graph%diagonal(:, first)
      d(2, :) = 0.0_wp
      d(3, :) = 1.0_wp
      call collect(first, 1)
      if (second > 0) then
         d(3, :) = graph%diagonal(:, second)
         call collect(second, 2)
      end if
      graph%mark(coupled(:many)) = 0
      graph%is_left(first) = .false.
      if (second > 0) graph%is_left(second) = .false.
      do k = 1, many
         at = coupled(k)
         call remove(graph, at, first)
         if (second > 0) call remove(graph, at, second)
         do s = 1, graph%samples
            determinant = d(1, s)*d(3, s) - d(2, s)**2
            l(:, s) = 0.0_wp                      ! of a singular model, whose factors nobody uses
            if (.not. abs(determinant) > vanished) cycle
            l(1, s) = (d(3, s)*c(1, s, k) - d(2, s)*c(2, s, k))/determinant
            l(2, s) = (d(1, s)*c(2, s, k) - d(2, s)*c(1, s, k))/determinant
         end do
         do j = 1, graph%degree(at)
            graph%mark(graph%next_to(j, at)) = j
         end do
         do j = 1, many
            other = coupled(j)
            change = l(1, :)*c(1, :, j) + l(2, :)*c(2, :, j)
            if (other == at) then
               graph%diagonal(:, at) = graph%diagonal(:, at) - change
            else if (graph%mark(other) > 0) then
               graph%value(:, graph%mark(other), at) = graph%value(:, graph%mark(other), at) - change
            else
               call append(graph, at, other, -change)
            end if
         end do
         graph%mark(graph%next_to(:graph%degree(at), at)) = 0
      end do

   contains

      !> Collects the neighbours of an unknown of the pivot, and the column of this unknown.
      subroutine collect(from, part)
         integer, intent(in) :: from, part
         integer :: i, next, place

         do i = 1, graph%degree(from)
            next = graph%next_to(i, from)
            if (next == first .or. next == second) then
               d(2, :) = graph%value(:, i, from)
               cycle
            end if
            place = graph%mark(next)
            if (place == 0) then
               many = many + 1
               place = many
               coupled(place) = next
               graph%mark(next) = place
               c(:, :, place) = 0.0_wp
            end if
            c(part, :, place) = graph%value(:, i, from)
         end do
      end subroutine collect

   end subroutine eliminate

end module ek_elimination_order
