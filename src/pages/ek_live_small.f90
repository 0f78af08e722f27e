!> The numbers of live states, reduced: numbers that follow from symmetry, or occur twice, are omitted. The two laws of a rate
!> of both sides change alike, so their deflections may be replaced by sum and difference (over √2). If the loads and the
!> state are symmetric, the loads act on the sums only, and the matrix A (ek_live_state) does not couple the sums with the
!> differences. The differences are then omitted, and a quarter of A remains. Columns with the same load, or with the same
!> reading, share one vector.
module ek_live_small
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_live, only: live_test_t
   use ek_live_state, only: live_state_t
   implicit none(type, external)
   private
   public :: small_t, make_small, entries

   real(wp), parameter :: nothing = 1.0e-8_wp       !! relative limit: smaller couplings are not seen in 7 digits
   real(wp), parameter :: same = 1.0e-12_wp         !! relative limit: vectors that differ less are equal

   !> Some columns of a test, and the reduced numbers from which they are computed.
   type :: small_t
      integer, allocatable :: of_law(:)             !! index of the rate of each law that is not omitted
      integer, allocatable :: column(:)             !! indices of the columns in the test
      integer, allocatable :: read(:), load(:)      !! index of the vector of each column: of its reading and of its load
      integer :: vectors = 0                        !! number of vectors
      logical :: has_self = .false., has_held = .false.      !! the columns need A; they need A with heights held
      logical :: is_whole = .false.                 !! a matrix is not symmetric: all are stored in full, not as lower triangles
      real(wp), allocatable :: numbers(:, :)        !! (number, state): values, A, A with heights held, vectors
   end type small_t

contains

   !> Takes from a test the first column that is still to be written, together with all such columns that need no other laws.
   !> Marks the taken columns as written: is_used becomes .false. With all digits (`is_exact`), takes all columns that are
   !> still to be written, and all laws.
   subroutine make_small(test, of_law, is_exact, is_used, small)
      type(live_test_t), intent(in) :: test
      integer, intent(in) :: of_law(:)
      logical, intent(in) :: is_exact               !! .false.: 7 digits are written
      logical, intent(inout) :: is_used(:)          !! columns that are still to be written
      type(small_t), intent(out) :: small
      type(live_state_t), allocatable :: state(:)
      logical, allocatable :: is_left(:), is_needed(:)
      integer :: k, c, first

      first = findloc(is_used, .true., dim=1)
      allocate (state, source=test%state)
      if (first > 0) call take_sums(of_law, first, state)
      allocate (small%column(0), is_left(size(of_law)))
      is_left = is_exact
      if (.not. is_exact) call find_left(state, first, is_left)
      do c = 1, size(is_used)
         if (.not. is_used(c)) cycle
         if (.not. is_exact) then
            allocate (is_needed(size(of_law)))
            call find_left(state, c, is_needed)
            if (any(is_needed .and. .not. is_left)) then
               deallocate (is_needed)
               cycle
            end if
            deallocate (is_needed)
         end if
         small%column = [small%column, c]
         is_used(c) = .false.
      end do
      small%has_self = any(.not. test%is_held(small%column))
      small%has_held = any(test%is_held(small%column))
      do k = 1, size(state)
         if (state(k)%is_known) call take_part(is_left, small%column, state(k))
      end do
      small%of_law = pack(of_law, is_left)
      call find_vectors(state, small)
      do k = 1, size(state)
         if (state(k)%is_known) small%is_whole = small%is_whole .or. .not. (is_symmetric(state(k)%self) .and. &
            is_symmetric(state(k)%held_self))
      end do
      call put_numbers(test, state, small)
   end subroutine make_small

   !> Replaces both laws of a rate by their sum and difference, at all known states. The load of a column gives the relative
   !> sign of the two sides.
   subroutine take_sums(of_law, column, state)
      integer, intent(in) :: of_law(:), column
      type(live_state_t), intent(inout) :: state(:)
      real(wp) :: sign
      integer :: l, k

      do l = 1, size(of_law) - 1
         if (of_law(l) /= of_law(l + 1)) cycle
         sign = 0.0_wp
         do k = 1, size(state)
            if (state(k)%is_known) sign = sign + state(k)%load(l, column)*state(k)%load(l + 1, column)
         end do
         sign = merge(-1.0_wp, 1.0_wp, sign < 0.0_wp)
         do k = 1, size(state)
            if (state(k)%is_known) call take_sum(l, sign, state(k))
         end do
      end do
   end subroutine take_sums

   !> Replaces laws l and l + 1 of a state by their sum and difference, over √2; law l + 1 is multiplied by `sign`.
   subroutine take_sum(l, sign, state)
      integer, intent(in) :: l                      !! the first law of a pair
      real(wp), intent(in) :: sign
      type(live_state_t), intent(inout) :: state

      call turn_rows(l, sign, state%self)
      call turn_columns(l, sign, state%self)
      call turn_rows(l, sign, state%held_self)
      call turn_columns(l, sign, state%held_self)
      call turn_rows(l, sign, state%read)
      call turn_rows(l, sign, state%load)
   end subroutine take_sum

   !> Replaces rows l and l + 1 of a matrix by their sum and difference, over √2; row l + 1 is multiplied by `sign`.
   pure subroutine turn_rows(l, sign, a)
      integer, intent(in) :: l
      real(wp), intent(in) :: sign
      real(wp), intent(inout) :: a(:, :)
      integer :: k

      do k = 1, size(a, 2)
         call turn(sign, a(l, k), a(l + 1, k))
      end do
   end subroutine turn_rows

   !> Replaces columns l and l + 1 of a matrix by their sum and difference, over √2; column l + 1 is multiplied by `sign`.
   pure subroutine turn_columns(l, sign, a)
      integer, intent(in) :: l
      real(wp), intent(in) :: sign
      real(wp), intent(inout) :: a(:, :)
      integer :: k

      do k = 1, size(a, 1)
         call turn(sign, a(k, l), a(k, l + 1))
      end do
   end subroutine turn_columns

   !> Replaces two numbers by their sum and difference, over √2; the second number is multiplied by `sign`.
   pure subroutine turn(sign, first, second)
      real(wp), intent(in) :: sign
      real(wp), intent(inout) :: first, second
      real(wp) :: sum

      sum = (first + sign*second)/sqrt(2.0_wp)
      second = (first - sign*second)/sqrt(2.0_wp)
      first = sum
   end subroutine turn

   !> Finds the laws on which the load of a column acts, and the laws that A couples with them, directly or through other
   !> laws.
   subroutine find_left(state, column, is_left)
      type(live_state_t), intent(in) :: state(:)
      integer, intent(in) :: column
      logical, intent(out) :: is_left(:)
      integer :: k, l, before

      is_left = .false.
      do k = 1, size(state)
         if (state(k)%is_known) is_left = is_left .or. abs(state(k)%load(:, column)) > nothing*maxval(abs(state(k)%load(:, column)))
      end do
      do
         before = count(is_left)
         do k = 1, size(state)
            if (.not. state(k)%is_known) cycle
            do l = 1, size(is_left)
               if (is_left(l)) is_left = is_left .or. is_coupled(state(k)%self, l) .or. is_coupled(state(k)%held_self, l)
            end do
         end do
         if (count(is_left) == before) exit
      end do

   contains

      !> Whether A couples each law with law l by more than rounding of the diagonal entries of both laws.
      pure function is_coupled(a, l)
         real(wp), intent(in) :: a(:, :)
         integer, intent(in) :: l
         logical :: is_coupled(size(a, 1))
         integer :: i

         do i = 1, size(a, 1)
            is_coupled(i) = max(abs(a(i, l)), abs(a(l, i))) > nothing*sqrt(abs(a(i, i)*a(l, l)))
         end do
      end function is_coupled

   end subroutine find_left

   !> Extracts selected laws and columns of a state.
   subroutine take_part(is_left, columns, state)
      logical, intent(in) :: is_left(:)
      integer, intent(in) :: columns(:)
      type(live_state_t), intent(inout) :: state
      type(live_state_t) :: whole
      integer, allocatable :: laws(:)
      integer :: l

      whole = state
      laws = pack([(l, l=1, size(is_left))], is_left)
      state%self = whole%self(laws, laws)
      state%held_self = whole%held_self(laws, laws)
      state%read = whole%read(laws, columns)
      state%load = whole%load(laws, columns)
   end subroutine take_part

   !> Finds the vectors of the columns and assigns indices to them: vectors of loads, then vectors of readings, without repetition.
   subroutine find_vectors(state, small)
      type(live_state_t), intent(in) :: state(:)
      type(small_t), intent(inout) :: small
      integer :: c, e

      allocate (small%read(size(small%column)), small%load(size(small%column)), source=0)
      do c = 1, size(small%column)
         do e = 1, c - 1
            if (is_same(c, e, .false.)) small%load(c) = small%load(e)
            if (small%load(c) > 0) exit
         end do
         if (small%load(c) == 0) call number(small%load(c))
      end do
      do c = 1, size(small%column)
         do e = 1, c - 1
            if (is_same(c, e, .true.)) small%read(c) = small%read(e)
            if (small%read(c) > 0) exit
         end do
         if (small%read(c) == 0) call number(small%read(c))
      end do

   contains

      !> Gives the next index to a vector.
      subroutine number(vector)
         integer, intent(out) :: vector
         small%vectors = small%vectors + 1
         vector = small%vectors
      end subroutine number

      !> Whether the vectors of columns c and e are equal at all known states.
      logical function is_same(c, e, is_read)
         integer, intent(in) :: c, e
         logical, intent(in) :: is_read
         integer :: k

         is_same = .true.
         do k = 1, size(state)
            if (.not. state(k)%is_known .or. .not. is_same) cycle
            if (is_read) is_same = all(abs(state(k)%read(:, c) - state(k)%read(:, e)) <= &
               same*maxval(abs(state(k)%read(:, c))))
            if (.not. is_read) is_same = all(abs(state(k)%load(:, c) - state(k)%load(:, e)) <= &
               same*maxval(abs(state(k)%load(:, c))))
         end do
      end function is_same

   end subroutine find_vectors

   pure logical function is_symmetric(a)
      real(wp), intent(in) :: a(:, :)
      is_symmetric = maxval(abs(a - transpose(a))) <= nothing*maxval(abs(a))
   end function is_symmetric

   !> Stores the numbers of all known states in `numbers`; 0 for a missing value.
   subroutine put_numbers(test, state, small)
      type(live_test_t), intent(in) :: test
      type(live_state_t), intent(in) :: state(:)
      type(small_t), intent(inout) :: small
      real(wp), allocatable :: list(:)
      integer :: k, v, m, n

      m = size(small%of_law)
      n = merge(m*m, m*(m + 1)/2, small%is_whole)
      n = size(small%column) + n*(count([small%has_self, small%has_held])) + m*small%vectors
      allocate (small%numbers(n, size(state)), source=0.0_wp)
      do k = 1, size(state)
         if (.not. state(k)%is_known) cycle
         list = test%value(small%column, k)
         if (small%has_self) list = [list, entries(state(k)%self, small%is_whole)]
         if (small%has_held) list = [list, entries(state(k)%held_self, small%is_whole)]
         do v = 1, small%vectors
            n = findloc(small%load, v, dim=1)
            if (n > 0) list = [list, state(k)%load(:, n)]
            if (n == 0) list = [list, state(k)%read(:, findloc(small%read, v, dim=1))]
         end do
         where (.not. ieee_is_finite(list)) list = 0.0_wp
         small%numbers(:, k) = list
      end do
   end subroutine put_numbers

   !> The entries of a matrix row by row: all entries if is_whole, otherwise the entries of the lower triangle.
   pure function entries(a, is_whole) result(list)
      real(wp), intent(in) :: a(:, :)
      logical, intent(in) :: is_whole
      real(wp), allocatable :: list(:)
      integer :: k

      allocate (list(0))
      do k = 1, size(a, 1)
         list = [list, a(k, :merge(size(a, 2), k, is_whole))]
      end do
   end function entries

end module ek_live_small
