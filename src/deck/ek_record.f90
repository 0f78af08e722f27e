!> The parsed content of a deck before interpretation: records (namelist groups) of entries
!> (`key = values`), with the file and line of each.
module ek_record
   use ek_text, only: str
   use ek_twin, only: single, twin_prefix
   use ek_complaint, only: place_t, place_in
   implicit none(type, external)
   private
   public :: value_t, entry_t, record_t
   public :: add_value, add_entry, add_record, entry_index, element, is_given, place_of, line_words, own_name

   !> One value as written; a string without its quotes.
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
      character(:), allocatable :: setting   !! 'path=value' if it came from --set
      logical :: is_bad = .false.         !! rejected by check_record
      integer :: used = 0
      type(value_t), allocatable :: values(:)
   end type entry_t

   !> One group, from `&` to `/`.
   type :: record_t
      character(:), allocatable :: group  !! lower case, without the &
      character(:), allocatable :: file   !! as shown in messages
      integer :: source = 1               !! number of that file, in the order of reading
      integer :: line = 0
      integer :: twin = single            !! side of a record duplicated by &mirror
      integer :: used = 0
      type(entry_t), allocatable :: entries(:)
   end type record_t

contains

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

   !> Append an entry to a record; the values are moved.
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
      to%is_bad = from%is_bad
      to%used = from%used
      call move_alloc(from%key, to%key)
      call move_alloc(from%setting, to%setting)
      call move_alloc(from%values, to%values)
      from%used = 0
   end subroutine move_entry

   !> Append a record to a list whose first `used` elements are filled; the entries are moved.
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

   !> The entry that contains element `at` of a key (any element if `at` is 0); 0 if there is none.
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

   !> Whether a record contains any element of a key.
   pure logical function is_given(record, key)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      is_given = entry_index(record, key, 0) > 0
   end function is_given

   !> The name of a record as written in the deck: without the prefix of a side.
   pure function own_name(record) result(name)
      type(record_t), intent(in) :: record
      character(:), allocatable :: name

      name = element(record, 'name', 1)
      if (record%twin == single) return
      if (record%group == 'wheel' .and. name == 'right') name = 'left'      ! the wheel of the half deck has the name of its side
      if (index(name, trim(twin_prefix(record%twin))) == 1) name = name(len_trim(twin_prefix(record%twin)) + 1:)
   end function own_name

   !> The location of a record or one of its entries; --set is sorted after all files.
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

   !> 'line 12' of a record; 'line 12 of wheels.nml' if the record with the message is in another file.
   pure function line_words(record, seen_from) result(words)
      type(record_t), intent(in) :: record, seen_from
      character(:), allocatable :: words
      words = 'line '//str(record%line)
      if (record%source /= seen_from%source) words = words//' of '//record%file
   end function line_words

end module ek_record
