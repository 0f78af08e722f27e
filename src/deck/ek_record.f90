!> What a deck says, before anybody asks what it means: records (namelist groups) of entries
!> (`key = values`), with the file and line of each.
module ek_record
   use ek_text, only: str, lower
   implicit none(type, external)
   private
   public :: value_t, entry_t, record_t, place_t, complaints_t
   public :: add_value, add_entry, add_record, entry_index, element, is_given, place_of, place_in, line_words, own_name, has_side
   public :: single, left_twin, right_twin, twin_prefix

   ! what &mirror makes of a record
   integer, parameter :: single = 0, left_twin = 1, right_twin = 2
   character(*), parameter :: twin_prefix(2) = [character(6) :: 'left_', 'right_']

   !> One value as it was written; a string without its quotes.
   type :: value_t
      character(:), allocatable :: text
      logical :: is_string = .false.
      logical :: is_empty = .false.       !! nothing between two commas
   end type value_t

   !> `key = values`, or `key(first) = values`.
   type :: entry_t
      character(:), allocatable :: key    !! lower case
      integer :: first = 1                !! subscript of the first value
      integer :: line = 0
      character(:), allocatable :: setting   !! 'path=value' when it came from --set
      integer :: used = 0
      type(value_t), allocatable :: values(:)
   end type entry_t

   !> One group, from `&` to `/`.
   type :: record_t
      character(:), allocatable :: group  !! lower case, without the &
      character(:), allocatable :: file   !! as messages name it
      integer :: source = 1               !! number of that file, in the order of reading
      integer :: line = 0
      integer :: twin = single
      integer :: used = 0
      type(entry_t), allocatable :: entries(:)
   end type record_t

   !> Where something stands.
   type :: place_t
      character(:), allocatable :: words  !! 'front.nml:41', '--set point.x.z=-105'
      integer :: source = 0, line = 0     !! messages are sorted by these
      integer :: twin = single
   end type place_t

   type :: complaint_t
      type(place_t) :: place
      character(:), allocatable :: text
   end type complaint_t

   !> Mistakes found so far; handed out in the order of files and lines.
   !>
   !> What &mirror doubled is told once and under the name that the deck uses: a message about the right twin
   !> is dropped where there is one about the left twin at the same place, and that one loses its prefixes.
   type :: complaints_t
      private
      integer :: used = 0
      type(complaint_t), allocatable :: list(:)
   contains
      procedure :: add => complaints_add
      procedure :: count => complaints_count
      procedure :: text => complaints_text
   end type complaints_t

contains

   !> Note a mistake.
   pure subroutine complaints_add(self, place, what)
      class(complaints_t), intent(inout) :: self
      type(place_t), intent(in) :: place
      character(*), intent(in) :: what
      type(complaint_t), allocatable :: grown(:)
      integer :: k

      if (place%twin == right_twin) then
         do k = 1, self%used
            if (self%list(k)%place%twin == left_twin .and. self%list(k)%place%words == place%words) return
         end do
      end if
      if (.not. allocated(self%list)) allocate (self%list(8))
      if (self%used == size(self%list)) then
         allocate (grown(2*self%used))
         do k = 1, self%used
            call move_complaint(self%list(k), grown(k))
         end do
         call move_alloc(grown, self%list)
      end if
      self%used = self%used + 1
      self%list(self%used)%place = place
      if (place%twin == left_twin) then
         self%list(self%used)%text = place%words//': '//without(what, "'"//trim(twin_prefix(left_twin)))
      else
         self%list(self%used)%text = place%words//': '//what
      end if
   end subroutine complaints_add

   !> Hands the texts over without a copy.
   pure subroutine move_complaint(from, to)
      type(complaint_t), intent(inout) :: from, to

      to%place%source = from%place%source
      to%place%line = from%place%line
      to%place%twin = from%place%twin
      call move_alloc(from%place%words, to%place%words)
      call move_alloc(from%text, to%text)
   end subroutine move_complaint

   !> A text in which a quote and a prefix have become the quote alone.
   pure function without(text, prefix) result(plain)
      character(*), intent(in) :: text, prefix
      character(:), allocatable :: plain
      integer :: first, found

      plain = ''
      first = 1
      do
         found = index(text(first:), prefix)
         if (found == 0) exit
         plain = plain//text(first:first + found - 1)
         first = first + found - 1 + len(prefix)
      end do
      plain = plain//text(first:)
   end function without

   !> How many mistakes were noted.
   pure integer function complaints_count(self)
      class(complaints_t), intent(in) :: self
      complaints_count = self%used
   end function complaints_count

   !> The messages, one a line, by file and line number; those of one line in the order they came. Who has so many has
   !> given a file that is no deck.
   pure function complaints_text(self) result(text)
      class(complaints_t), intent(in) :: self
      character(:), allocatable :: text
      integer, parameter :: most = 100
      integer :: order(self%used), k, j, this

      do k = 1, self%used
         this = k
         do j = k - 1, 1, -1
            if (.not. is_before(self%list(this)%place, self%list(order(j))%place)) exit
            order(j + 1) = order(j)
         end do
         order(j + 1) = this
      end do
      text = ''
      do k = 1, min(self%used, most)
         if (k > 1) text = text//new_line('a')
         text = text//self%list(order(k))%text
      end do
      if (self%used > most) text = text//new_line('a')//'and '//str(self%used - most)//' more mistakes: is this a deck?'
   end function complaints_text

   !> The order of messages: files as they were read, then lines.
   pure logical function is_before(a, b)
      type(place_t), intent(in) :: a, b
      is_before = a%source < b%source .or. (a%source == b%source .and. a%line < b%line)
   end function is_before

   !> Append one value to an entry.
   pure subroutine add_value(entry, text, is_string, is_empty)
      type(entry_t), intent(inout) :: entry
      character(*), intent(in) :: text
      logical, intent(in) :: is_string, is_empty
      type(value_t), allocatable :: grown(:)
      integer :: k

      if (.not. allocated(entry%values)) allocate (entry%values(3))
      if (entry%used == size(entry%values)) then
         allocate (grown(2*entry%used))
         do k = 1, entry%used
            grown(k)%is_string = entry%values(k)%is_string
            grown(k)%is_empty = entry%values(k)%is_empty
            call move_alloc(entry%values(k)%text, grown(k)%text)
         end do
         call move_alloc(grown, entry%values)
      end if
      entry%used = entry%used + 1
      entry%values(entry%used)%text = text
      entry%values(entry%used)%is_string = is_string
      entry%values(entry%used)%is_empty = is_empty
   end subroutine add_value

   !> Append an entry to a record; the values move over.
   pure subroutine add_entry(record, entry)
      type(record_t), intent(inout) :: record
      type(entry_t), intent(inout) :: entry   !! empty afterwards
      type(entry_t), allocatable :: grown(:)
      integer :: k

      if (.not. allocated(record%entries)) allocate (record%entries(8))
      if (record%used == size(record%entries)) then
         allocate (grown(2*record%used))
         do k = 1, record%used
            call move_entry(record%entries(k), grown(k))
         end do
         call move_alloc(grown, record%entries)
      end if
      record%used = record%used + 1
      call move_entry(entry, record%entries(record%used))
   end subroutine add_entry

   pure subroutine move_entry(from, to)
      type(entry_t), intent(inout) :: from, to

      to%first = from%first
      to%line = from%line
      to%used = from%used
      call move_alloc(from%key, to%key)
      call move_alloc(from%setting, to%setting)
      call move_alloc(from%values, to%values)
      from%used = 0
   end subroutine move_entry

   !> Append a record to a list of which the first `used` are in use; the entries move over.
   pure subroutine add_record(records, used, record)
      type(record_t), allocatable, intent(inout) :: records(:)
      integer, intent(inout) :: used
      type(record_t), intent(inout) :: record   !! empty afterwards
      type(record_t), allocatable :: grown(:)
      integer :: k

      if (.not. allocated(records)) allocate (records(32))
      if (used == size(records)) then
         allocate (grown(2*used))
         do k = 1, used
            call move_record(records(k), grown(k))
         end do
         call move_alloc(grown, records)
      end if
      used = used + 1
      call move_record(record, records(used))
   end subroutine add_record

   pure subroutine move_record(from, to)
      type(record_t), intent(inout) :: from, to

      to%line = from%line
      to%source = from%source
      to%twin = from%twin
      to%used = from%used
      call move_alloc(from%group, to%group)
      call move_alloc(from%file, to%file)
      call move_alloc(from%entries, to%entries)
      from%used = 0
   end subroutine move_record

   !> The entry that gives element `at` of a key (any element when `at` is 0); 0 if there is none.
   pure integer function entry_index(record, key, at)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      integer, intent(in) :: at
      integer :: k

      entry_index = 0
      do k = 1, record%used
         if (len(record%entries(k)%key) /= len_trim(key)) cycle
         if (record%entries(k)%key /= key) cycle
         if (at /= 0) then
            if (at < record%entries(k)%first) cycle
            if (at >= record%entries(k)%first + record%entries(k)%used) cycle
         end if
         entry_index = k
         return
      end do
   end function entry_index

   !> The text of element `at` of a key; '' if it is not given.
   pure function element(record, key, at) result(text)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      integer, intent(in) :: at
      character(:), allocatable :: text
      integer :: k

      text = ''
      k = entry_index(record, key, at)
      if (k > 0) text = record%entries(k)%values(at - record%entries(k)%first + 1)%text
   end function element

   !> Whether a record gives any element of a key.
   pure logical function is_given(record, key)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      is_given = entry_index(record, key, 0) > 0
   end function is_given

   !> The name of a record as the deck has it: a twin's without the prefix.
   pure function own_name(record) result(name)
      type(record_t), intent(in) :: record
      character(:), allocatable :: name

      name = element(record, 'name', 1)
      if (record%twin == single) return
      if (index(name, trim(twin_prefix(record%twin))) == 1) name = name(len_trim(twin_prefix(record%twin)) + 1:)
   end function own_name

   !> Whether a name begins with left_ or right_.
   pure logical function has_side(name)
      character(*), intent(in) :: name
      has_side = index(lower(name), trim(twin_prefix(left_twin))) == 1 .or. &
         index(lower(name), trim(twin_prefix(right_twin))) == 1
   end function has_side

   !> Where a record or one of its entries stands; --set comes after all files.
   pure subroutine place_of(record, entry, place)
      type(record_t), intent(in) :: record
      integer, intent(in) :: entry            !! 0: the record itself
      type(place_t), intent(out) :: place

      if (entry > 0) then
         call place_in(record%file, record%source, record%entries(entry)%line, place)
         if (allocated(record%entries(entry)%setting)) then
            place%words = '--set '//record%entries(entry)%setting
            place%source = huge(place%source)
         end if
      else
         call place_in(record%file, record%source, record%line, place)
      end if
      place%twin = record%twin
   end subroutine place_of

   !> 'line 12' of a record; 'line 12 of wheels.nml' where the one whose message says so is in another file.
   pure function line_words(record, seen_from) result(words)
      type(record_t), intent(in) :: record, seen_from
      character(:), allocatable :: words
      words = 'line '//str(record%line)
      if (record%source /= seen_from%source) words = words//' of '//record%file
   end function line_words

   !> A line of a file; line 0: the file itself.
   pure subroutine place_in(file, source, line, place)
      character(*), intent(in) :: file
      integer, intent(in) :: source, line
      type(place_t), intent(out) :: place

      place%words = file
      if (line > 0) place%words = file//':'//str(line)
      place%source = source
      place%line = line
   end subroutine place_in

end module ek_record
