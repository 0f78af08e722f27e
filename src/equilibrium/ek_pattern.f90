!> Positions of the entries of the KKT matrix: blocks, and every entry that may be nonzero.
!>
!> Assembly writes into a store: the 6×6 blocks of T (see ek_block: one per body, then one per pair of bodies that an element
!> or a row couples), then six numbers per row of Φ and body (its gradient), then the diagonal of the rows. `entries` lists the
!> entries of the lower triangle of the matrix that are written, and their positions in the store. The pattern follows from the
!> connections and from the kinds of measures, never from the values of one state.
module ek_pattern
   use ek_measure, only: axis_axis, body_gap, global_gap, distance, rotation, contact_gap
   use ek_element, only: element_t, bushing_element
   use ek_suspension, only: suspension_t
   implicit none(type, external)
   private
   public :: pattern_t, new_pattern, same_pattern
   public :: whole_tangent, material_only, residual_only

   ! what is assembled
   integer, parameter :: whole_tangent = 1   !! T with geometric stiffness: corrected, equilibrium
   integer, parameter :: material_only = 2   !! K = −(19) of the paper: recursive
   integer, parameter :: residual_only = 3   !! right-hand side only

   !> Positions of all entries of the system in its store.
   type :: pattern_t
      integer :: nq = 0, nc = 0, n = 0           !! number of unknowns of bodies, of rows of Φ, and their sum
      integer :: bodies = 0, blocks = 0          !! number of bodies; number of blocks of bodies and of pairs
      integer, allocatable :: pair(:, :)         !! (2, block): body of the rows, body of the columns
      integer, allocatable :: element_at(:, :)   !! (3, element): blocks of each element, see ek_block
      integer, allocatable :: term_at(:, :)      !! (3, term): blocks of each term, see ek_block
      integer, allocatable :: term_slot(:, :)    !! (2, term): slots of the gradient of the row at bodies i, j; 0: chassis
      integer, allocatable :: first_slot(:)      !! (rows + 1): first slot of each row
      integer, allocatable :: body_of_slot(:)
      integer :: jacobian = 0, diagonal = 0      !! position in the store before the gradients, before the diagonal
      integer :: stored = 0                      !! length of the store
      integer :: entries = 0
      integer, allocatable :: row(:), column(:), from(:)   !! row, column and position in the store of each entry
      ! what it was made from
      integer, allocatable, private :: element(:, :)   !! (kind_of_use, bodies i and j; element)
      integer, allocatable, private :: term(:, :)      !! (kind, bodies i and j; term)
      integer, allocatable, private :: row_terms(:, :) !! (first term, number of terms; row)
   end type pattern_t

contains

   !> The pattern of a model.
   function new_pattern(suspension) result(self)
      type(suspension_t), intent(in) :: suspension
      type(pattern_t) :: self
      logical, allocatable :: is_used(:, :, :)   ! (row part, column part, block): 1 Δr, 2 Δπ
      logical, allocatable :: has_force(:)       ! gradients: with a part for Δr
      integer :: k, t, r, s, slots

      self%nq = suspension%unknowns()
      self%nc = suspension%constraints()
      self%n = self%nq + self%nc
      self%bodies = size(suspension%bodies)
      allocate (self%pair(2, self%bodies + size(suspension%elements) + size(suspension%terms)), source=0)
      allocate (self%element_at(3, size(suspension%elements)), self%term_at(3, size(suspension%terms)), &
         self%term_slot(2, size(suspension%terms)), self%first_slot(self%nc + 1), &
         self%body_of_slot(2*size(suspension%terms)), source=0)
      allocate (is_used(2, 2, size(self%pair, 2)), source=.false.)
      allocate (has_force(2*size(suspension%terms)), source=.false.)
      self%blocks = self%bodies
      do k = 1, self%bodies
         self%pair(:, k) = k
         is_used(2, :, k) = .true.               ! screw motions add ½ g̃ to every body, and a load its moment
      end do
      do k = 1, size(suspension%elements)
         associate (element => suspension%elements(k))
            call find_blocks(element%measure%body_i, element%measure%body_j, self%bodies, self%blocks, self%pair, &
               self%element_at(:, k))
            call use_parts(kind_of_use(element), self%element_at(:, k), is_used)
         end associate
      end do
      slots = 0
      do r = 1, size(suspension%rows)
         self%first_slot(r) = slots + 1
         do t = suspension%rows(r)%first, suspension%rows(r)%first + suspension%rows(r)%terms - 1
            associate (m => suspension%terms(t)%measure)
               call find_blocks(m%body_i, m%body_j, self%bodies, self%blocks, self%pair, self%term_at(:, t))
               call use_parts(m%kind, self%term_at(:, t), is_used)
               call find_slot(m%body_i, self%first_slot(r), slots, self%body_of_slot, self%term_slot(1, t))
               call find_slot(m%body_j, self%first_slot(r), slots, self%body_of_slot, self%term_slot(2, t))
               do k = 1, 2
                  s = self%term_slot(k, t)
                  if (s > 0) has_force(s) = has_force(s) .or. .not. any(m%kind == [axis_axis, rotation])
               end do
            end associate
         end do
      end do
      self%first_slot(size(self%first_slot)) = slots + 1
      self%jacobian = 36*self%blocks
      self%diagonal = self%jacobian + 6*slots
      self%stored = max(self%diagonal + self%nc, self%jacobian + 1)     ! without rows the gradients begin behind the blocks too
      self%pair = self%pair(:, :self%blocks)
      call list_entries(self, is_used, has_force)
      call note_connections(suspension, self)
   end function new_pattern

   !> The kind of measure that fills the blocks of the matrix in the same way as an element.
   pure integer function kind_of_use(element)
      type(element_t), intent(in) :: element

      kind_of_use = distance
      if (element%kind == bushing_element) return
      if (element%measure%kind == axis_axis .or. element%measure%kind == rotation) kind_of_use = rotation
   end function kind_of_use

   !> Stores the connections of a model, for comparison in same_pattern.
   pure subroutine note_connections(suspension, self)
      type(suspension_t), intent(in) :: suspension
      type(pattern_t), intent(inout) :: self
      integer :: k

      allocate (self%element(3, size(suspension%elements)), self%term(3, size(suspension%terms)), &
         self%row_terms(2, size(suspension%rows)))
      do k = 1, size(suspension%elements)
         associate (element => suspension%elements(k))
            self%element(:, k) = [kind_of_use(element), element%measure%body_i, element%measure%body_j]
         end associate
      end do
      do k = 1, size(suspension%terms)
         associate (m => suspension%terms(k)%measure)
            self%term(:, k) = [m%kind, m%body_i, m%body_j]
         end associate
      end do
      do k = 1, size(suspension%rows)
         self%row_terms(:, k) = [suspension%rows(k)%first, suspension%rows(k)%terms]
      end do
   end subroutine note_connections

   !> Finds the blocks of two bodies. A new pair of bodies gets the next index.
   pure subroutine find_blocks(i, j, bodies, blocks, pair, at)
      integer, intent(in) :: i, j                !! bodies, 0: chassis
      integer, intent(in) :: bodies
      integer, intent(inout) :: blocks           !! so far
      integer, intent(inout) :: pair(:, :)
      integer, intent(out) :: at(3)              !! see ek_block
      integer :: b

      at = [i, j, 0]
      if (i == 0 .or. j == 0 .or. i == j) return
      do b = bodies + 1, blocks
         if (pair(1, b) == max(i, j) .and. pair(2, b) == min(i, j)) exit
      end do
      if (b > blocks) then
         blocks = b
         pair(:, b) = [max(i, j), min(i, j)]
      end if
      at(3) = merge(b, -b, j > i)
   end subroutine find_blocks

   !> Marks the parts of blocks that the Hessian of a measure fills. For a distance (and for elements, see kind_of_use), also marks
   !> the parts that the product of the gradients fills.
   pure subroutine use_parts(kind, at, is_used)
      integer, intent(in) :: kind, at(3)
      logical, intent(inout) :: is_used(:, :, :)
      integer :: k

      do k = 1, 2
         if (at(k) == 0) cycle
         is_used(2, 2, at(k)) = .true.
         if (kind == distance) is_used(:, :, at(k)) = .true.
      end do
      if (at(3) == 0) return
      select case (kind)
      case (axis_axis, rotation)
         is_used(2, 2, abs(at(3))) = .true.
      case (body_gap)                            ! rotation of i with both unknowns of j
         is_used(2, 2, abs(at(3))) = .true.
         if (at(3) > 0) is_used(1, 2, at(3)) = .true.
         if (at(3) < 0) is_used(2, 1, -at(3)) = .true.
      case (global_gap, contact_gap)
      case default
         is_used(:, :, abs(at(3))) = .true.
      end select
   end subroutine use_parts

   !> Finds the slot of the gradient of a row at a body. A new body gets the next slot.
   pure subroutine find_slot(body, first, slots, body_of_slot, slot)
      integer, intent(in) :: body, first         !! first: of the row
      integer, intent(inout) :: slots            !! so far
      integer, intent(inout) :: body_of_slot(:)
      integer, intent(out) :: slot

      slot = 0
      if (body == 0) return
      do slot = first, slots
         if (body_of_slot(slot) == body) return
      end do
      slots = slots + 1
      slot = slots
      body_of_slot(slot) = body
   end subroutine find_slot

   !> Lists the entries of the lower triangle that may be nonzero, column by column of the blocks, and all entries of the diagonal.
   subroutine list_entries(self, is_used, has_force)
      type(pattern_t), intent(inout) :: self
      logical, intent(in) :: is_used(:, :, :), has_force(:)
      integer :: b, i, j, r, s

      allocate (self%row(36*self%blocks + 6*size(has_force) + self%nc), source=0)
      allocate (self%column(size(self%row)), self%from(size(self%row)), source=0)
      do b = 1, self%blocks
         associate (rows => 6*(self%pair(1, b) - 1), columns => 6*(self%pair(2, b) - 1))
            do j = 1, 6
               do i = merge(j, 1, b <= self%bodies), 6
                  if (.not. (is_used(merge(1, 2, i <= 3), merge(1, 2, j <= 3), b) .or. (b <= self%bodies .and. i == j))) cycle
                  call add_entry(rows + i, columns + j, 36*(b - 1) + 6*(j - 1) + i)
               end do
            end do
         end associate
      end do
      do r = 1, self%nc
         do s = self%first_slot(r), self%first_slot(r + 1) - 1
            do j = merge(1, 4, has_force(s)), 6
               call add_entry(self%nq + r, 6*(self%body_of_slot(s) - 1) + j, self%jacobian + 6*(s - 1) + j)
            end do
         end do
         call add_entry(self%nq + r, self%nq + r, self%diagonal + r)
      end do
      self%row = self%row(:self%entries)
      self%column = self%column(:self%entries)
      self%from = self%from(:self%entries)

   contains

      !> Appends an entry of the matrix with its position in the store.
      subroutine add_entry(row, column, from)
         integer, intent(in) :: row, column, from
         self%entries = self%entries + 1
         self%row(self%entries) = row
         self%column(self%entries) = column
         self%from(self%entries) = from
      end subroutine add_entry

   end subroutine list_entries

   !> Whether a model has the connections from which this pattern was created. Nothing is allocated.
   pure logical function same_pattern(self, suspension) result(is_same)
      type(pattern_t), intent(in) :: self        !! of new_pattern
      type(suspension_t), intent(in) :: suspension
      integer :: k

      is_same = self%bodies == size(suspension%bodies) .and. size(self%element, 2) == size(suspension%elements) .and. &
         size(self%term, 2) == size(suspension%terms) .and. size(self%row_terms, 2) == size(suspension%rows)
      if (.not. is_same) return
      do k = 1, size(suspension%elements)
         associate (element => suspension%elements(k))
            is_same = is_same .and. self%element(1, k) == kind_of_use(element) .and. &
               self%element(2, k) == element%measure%body_i .and. self%element(3, k) == element%measure%body_j
         end associate
      end do
      do k = 1, size(suspension%terms)
         associate (m => suspension%terms(k)%measure)
            is_same = is_same .and. self%term(1, k) == m%kind .and. self%term(2, k) == m%body_i .and. self%term(3, k) == m%body_j
         end associate
      end do
      do k = 1, size(suspension%rows)
         is_same = is_same .and. self%row_terms(1, k) == suspension%rows(k)%first .and. &
            self%row_terms(2, k) == suspension%rows(k)%terms
      end do
   end function same_pattern

end module ek_pattern
