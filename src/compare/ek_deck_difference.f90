!> The differences between the decks of several results: the facts of their runs, and the values by their paths.
module ek_deck_difference
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_decimal, only: get_decimal
   use ek_text, only: str
   use ek_deck_file, only: deck_record_t
   implicit none(type, external)
   private
   public :: deck_difference_t, few_changes, find_differences, difference_size, given, step_text

   integer, parameter :: few_changes = 20     !! a longer list of values that differ is after the results, on pages and terminal

   character(*), parameter :: left(2) = [character(12) :: '.left_', 'wheel.left.'], &
      right(2) = [character(12) :: '.right_', 'wheel.right.'], both(2) = [character(12) :: '.', 'wheel.']

   !> Keys that decks often give although the value is the default.
   character(*), parameter :: defaults(2, 7) = reshape([character(16) :: 'model.length', 'mm', 'model.force', 'N', &
      'model.angle', 'deg', 'model.axes', 'x-rear', 'model.balance', 'none', 'model.gravity', '0', &
      'model.mass', 'kg'], [2, 7])

   type :: deck_difference_t
      character(:), allocatable :: path           !! path of a value: 'point.left_tie_rod_outer.z'; or fact: 'Deck checksum'
      character(:), allocatable :: sides          !! 'both sides', 'both sides, mirrored; left shown', or ''
      type(message_list_t) :: texts               !! value in each result; '' if the result does not give it
   end type deck_difference_t

contains

   !> Finds the facts and values that differ between the records, in the order of the first record; names that the first
   !> record lacks follow. A value that only some decks give is a difference. If both sides of an axle changed equally or
   !> oppositely, they share a row. If the deck of a record is not known, no values are compared, and facts that a record
   !> lacks are omitted.
   subroutine find_differences(records, facts, values)
      type(deck_record_t), intent(in) :: records(:)
      type(deck_difference_t), allocatable, intent(out) :: facts(:), values(:)
      type(message_list_t) :: names(size(records)), texts(size(records))
      integer :: r, k

      do r = 1, size(records)
         names(r) = records(r)%names
         texts(r) = records(r)%facts
      end do
      call differing(names, texts, facts)
      allocate (values(0))
      if (.not. all(records%is_known)) then      ! of other sources: a fact that one lacks is no difference
         facts = pack(facts, [(is_in_all(facts(k)), k=1, size(facts))])
         return
      end if
      do r = 1, size(records)
         names(r) = records(r)%paths
         texts(r) = records(r)%texts
      end do
      call differing(names, texts, values)
      values = pack(values, [(.not. is_default(values(k)), k=1, size(values))])
      call join_sides(values)
   end subroutine find_differences

   !> Whether a row differs only in a default that one deck gives and the other omits: model.length = 'mm'.
   logical function is_default(row)
      type(deck_difference_t), intent(in) :: row
      integer :: d, r

      is_default = .false.
      do d = 1, size(defaults, 2)
         if (defaults(1, d) /= row%path) cycle
         is_default = all([(row%texts%line(r) == '' .or. row%texts%line(r) == defaults(2, d), r=1, row%texts%count())])
      end do
   end function is_default

   !> The size of a difference, for sorting: of numbers the largest change from the first result as a share of the larger number, 0 to
   !> 2; below 0 for strings, and if a result does not give the value.
   real(wp) function difference_size(row) result(share)
      type(deck_difference_t), intent(in) :: row
      real(wp) :: first, value
      logical :: is_number, is_other
      integer :: r

      share = -1.0_wp
      if (.not. is_in_all(row)) return
      share = 0.0_wp
      call get_decimal(row%texts%line(1), first, is_number)
      do r = 2, row%texts%count()
         call get_decimal(row%texts%line(r), value, is_other)
         if (.not. (is_number .and. is_other)) then
            share = -0.5_wp
            return
         else if (abs(value - first) > 0.0_wp) then
            share = max(share, abs(value - first)/max(abs(value), abs(first)))
         end if
      end do
   end function difference_size

   !> Whether every result gives a string for a row.
   logical function is_in_all(row)
      type(deck_difference_t), intent(in) :: row
      integer :: r

      is_in_all = all([(row%texts%line(r) /= '', r=1, row%texts%count())])
   end function is_in_all

   !> Lists the names whose strings differ between the results.
   subroutine differing(names, texts, list)
      type(message_list_t), intent(in) :: names(:), texts(:)     !! names and strings of each result
      type(deck_difference_t), allocatable, intent(out) :: list(:)
      type(deck_difference_t) :: row
      integer :: s, r, k, l, used

      allocate (list(16))
      used = 0
      do s = 1, size(names)
         do k = 1, names(s)%count()
            if (is_listed(s, k)) cycle
            row%path = names(s)%line(k)
            row%sides = ''
            row%texts = message_list_t()
            do r = 1, size(names)
               l = place_of(names(r), row%path, k)
               if (l > 0) call row%texts%add(texts(r)%line(l))
               if (l == 0) call row%texts%add('')
            end do
            if (.not. any([(.not. is_equal(row%texts%line(1), row%texts%line(r)), r=2, size(names))])) cycle
            if (used == size(list)) list = [list, list]      ! twice the size
            used = used + 1
            list(used) = row
         end do
      end do
      list = list(:used)

   contains

      !> Whether a result before result s has the name with index k.
      logical function is_listed(s, k)
         integer, intent(in) :: s, k
         integer :: r

         is_listed = .false.
         do r = 1, s - 1
            is_listed = is_listed .or. place_of(names(r), names(s)%line(k), k) > 0
         end do
      end function is_listed

   end subroutine differing

   !> Index of a name, searched first near the expected index; 0 if the list does not contain the name.
   integer function place_of(names, name, near) result(place)
      type(message_list_t), intent(in) :: names
      character(*), intent(in) :: name
      integer, intent(in) :: near
      integer :: k, n

      n = names%count()
      do k = 0, n - 1
         place = 1 + modulo(near - 1 + k, n)
         if (names%line(place) == name) return
      end do
      place = 0
   end function place_of

   !> Whether two strings are equal; numbers are compared by value.
   logical function is_equal(a, b)
      character(*), intent(in) :: a, b
      real(wp) :: x, y

      is_equal = a == b
      if (is_equal) return
      if (are_numbers(a, b, x, y)) is_equal = abs(x - y) <= 1.0e-12_wp*max(abs(x), abs(y))
   end function is_equal

   !> Whether two strings are both numbers; if so, x and y return their values.
   logical function are_numbers(a, b, x, y)
      character(*), intent(in) :: a, b
      real(wp), intent(out) :: x, y
      logical :: is_number

      y = 0.0_wp
      call get_decimal(a, x, are_numbers)
      if (.not. are_numbers) return
      call get_decimal(b, y, is_number)
      are_numbers = is_number
   end function are_numbers

   !> The difference b − a of two numbers, such as '+5'; '' if a or b is missing or is not a number.
   function step_text(a, b) result(text)
      character(*), intent(in) :: a, b
      character(:), allocatable :: text
      real(wp) :: x, y

      text = ''
      if (a == '' .or. b == '') return
      if (.not. are_numbers(a, b, x, y)) return
      text = str(y - x, 6)
      if (y > x) text = '+'//text
   end function step_text

   !> Joins the rows of the two sides of an axle if their values are equal or opposite.
   subroutine join_sides(list)
      type(deck_difference_t), allocatable, intent(inout) :: list(:)
      logical :: is_twin(size(list))
      character(:), allocatable :: path
      integer :: k, l, form, at

      is_twin = .false.
      do k = 1, size(list)
         do form = 1, size(left)
            at = index(list(k)%path, trim(left(form)))
            if (at == 0 .or. is_twin(k)) cycle
            path = list(k)%path(at + len_trim(left(form)):)
            do l = 1, size(list)
               if (list(l)%path /= list(k)%path(:at - 1)//trim(right(form))//path .or. is_twin(l)) cycle
               if (are_alike(list(k)%texts, list(l)%texts, 1.0_wp)) then
                  list(k)%sides = 'both sides'
               else if (are_alike(list(k)%texts, list(l)%texts, -1.0_wp)) then
                  list(k)%sides = 'both sides, mirrored; left shown'
               else
                  exit
               end if
               is_twin(l) = .true.
               list(k)%path = list(k)%path(:at - 1)//trim(both(form))//path
               exit
            end do
         end do
      end do
      list = pack(list, .not. is_twin)
   end subroutine join_sides

   !> Whether all numbers of the left side are `sign` times the numbers of the right side. Other strings must be equal.
   logical function are_alike(a, b, sign)
      type(message_list_t), intent(in) :: a, b
      real(wp), intent(in) :: sign
      real(wp) :: x, y
      integer :: r

      are_alike = .true.
      do r = 1, a%count()
         if (are_numbers(a%line(r), b%line(r), x, y)) then
            are_alike = are_alike .and. abs(x - sign*y) <= 1.0e-12_wp*abs(x)
         else
            are_alike = are_alike .and. a%line(r) == b%line(r)
         end if
      end do
   end function are_alike

   !> A value, or 'not given' for an empty value.
   pure function given(words) result(text)
      character(*), intent(in) :: words
      character(:), allocatable :: text

      text = words
      if (words == '') text = 'not given'
   end function given

end module ek_deck_difference
