!> What a deck says, before anybody asks what it means: records (namelist groups) of entries
!> (`key = values`), with the line of each.
module ek_record
   use ek_text, only: str
   implicit none(type, external)
   private
   public :: value_t, entry_t, record_t, complaints_t
   public :: add_value, add_entry, add_record, entry_index, element, is_given, place_of

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
      integer :: line = 0
      integer :: used = 0
      type(entry_t), allocatable :: entries(:)
   end type record_t

   type :: complaint_t
      integer :: line = 0
      character(:), allocatable :: text
   end type complaint_t

   !> Mistakes found so far; handed out in the order of their lines.
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

   !> Note a mistake; `text` names its place already.
   pure subroutine complaints_add(self, line, text)
      class(complaints_t), intent(inout) :: self
      integer, intent(in) :: line      !! sorts the messages
      character(*), intent(in) :: text
      type(complaint_t), allocatable :: grown(:)
      integer :: k

      if (.not. allocated(self%list)) allocate (self%list(8))
      if (self%used == size(self%list)) then
         allocate (grown(2*self%used))
         do k = 1, self%used
            grown(k)%line = self%list(k)%line
            call move_alloc(self%list(k)%text, grown(k)%text)
         end do
         call move_alloc(grown, self%list)
      end if
      self%used = self%used + 1
      self%list(self%used)%line = line
      self%list(self%used)%text = text
   end subroutine complaints_add

   pure integer function complaints_count(self)
      class(complaints_t), intent(in) :: self
      complaints_count = self%used
   end function complaints_count

   !> All messages, one a line, by line number; those of one line in the order they came.
   pure function complaints_text(self) result(text)
      class(complaints_t), intent(in) :: self
      character(:), allocatable :: text
      integer :: order(self%used), k, j, this

      do k = 1, self%used
         this = k
         do j = k - 1, 1, -1
            if (self%list(order(j))%line <= self%list(this)%line) exit
            order(j + 1) = order(j)
         end do
         order(j + 1) = this
      end do
      text = ''
      do k = 1, self%used
         if (k > 1) text = text//new_line('a')
         text = text//self%list(order(k))%text
      end do
   end function complaints_text

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
      to%used = from%used
      call move_alloc(from%group, to%group)
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

   pure logical function is_given(record, key)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      is_given = entry_index(record, key, 0) > 0
   end function is_given

   !> 'front.nml:41', or '--set point.x.z=-105', and the line by which messages are sorted.
   pure subroutine place_of(record, entry, file, place, line)
      type(record_t), intent(in) :: record
      integer, intent(in) :: entry            !! 0: the record itself
      character(*), intent(in) :: file
      character(:), allocatable, intent(out) :: place
      integer, intent(out) :: line

      line = record%line
      if (entry > 0) then
         line = record%entries(entry)%line
         if (allocated(record%entries(entry)%setting)) then
            place = '--set '//record%entries(entry)%setting
            line = huge(line)
            return
         end if
      end if
      place = file//':'//str(line)
   end subroutine place_of

end module ek_record
