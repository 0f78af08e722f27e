!> The parsed content of a deck before interpretation: records (namelist groups) of entries (`key = values`). Records and entries
!> store their lines, and records also store their files. The errors of the deck are collected with their locations and reported
!> together.
module ek_record
   use ek_kinds, only: wp
   use ek_text, only: str, lower
   use ek_letters, only: visible
   use ek_group, only: group_names, group_number, key_t, find_key, polar, axial
   implicit none(type, external)
   private
   public :: place_t, deck_errors_t, place_in, single, left_side, right_side, side_prefix, has_side
   public :: value_t, entry_t, record_t
   public :: add_value, add_entry, add_record, hand_over, entry_index, element, is_given, place_of, line_text, own_name
   public :: role_of, sign_of_image, turns, takes_image

   !> Side of a record: left or right for the two records that &mirror creates from one record of the deck, `single` for all others.
   !> The prefix of the side begins the record name.
   integer, parameter :: single = 0, left_side = 1, right_side = 2
   character(*), parameter :: side_prefix(2) = [character(6) :: 'left_', 'right_']

   !> A location in a file or on the command line.
   type :: place_t
      character(:), allocatable :: words  !! 'front.nml:41', '--set point.x.z=-105'
      integer :: source = 0, line = 0     !! index of the file, and line number; messages are sorted by both
      integer :: side = single
   end type place_t

   type :: deck_error_t
      type(place_t) :: place
      character(:), allocatable :: text
   end type deck_error_t

   !> Errors found so far; reported in the order of files and lines.
   !>
   !> An error in an element duplicated by &mirror is reported once, under the name used in the deck. A message about the right side
   !> is dropped if the left side has a message at the same location. The prefix left_ is removed from quoted names in a message
   !> about the left side.
   type :: deck_errors_t
      private
      integer :: used = 0
      logical :: is_cut = .false.         !! a file was not read to its end and may have more errors
      logical :: lost(0:size(group_names)) = .false.      !! groups of which a file was not read; 0: any group
      type(deck_error_t), allocatable :: list(:)
   contains
      procedure :: add => complaints_add, cut => complaints_cut, lose => complaints_lose, lacks => complaints_lacks, &
         count => complaints_count, text => complaints_text
   end type deck_errors_t

   !> One value as written; a string without its quotes.
   type :: value_t
      character(:), allocatable :: text
      logical :: is_string = .false.
      logical :: is_empty = .false.       !! .true.: there is nothing between two commas
      character :: before = ' '           !! ',': after a comma without blanks around it; '*': further value of n*value; ' ': other
   end type value_t

   !> `key = values`, or `key(first) = values`.
   type :: entry_t
      character(:), allocatable :: key    !! key in lower case
      integer :: first = 1                !! subscript of the first value
      integer :: last = 0                 !! while the entry is scanned: last subscript of `key(first:last) = values`; 0: not given
      integer :: line = 0
      character(:), allocatable :: setting   !! 'path=value' if --set has set a value of the entry
      logical :: is_bad = .false.         !! the entry was rejected by check_record
      integer :: used = 0
      type(value_t), allocatable :: values(:)
   end type entry_t

   !> One group, from `&` to `/`.
   type :: record_t
      character(:), allocatable :: group  !! name of the group in lower case, without the &
      character(:), allocatable :: file   !! path of the file, as shown in messages
      integer :: source = 1               !! index of the file, in the order of reading
      integer :: line = 0
      integer :: side = single            !! side of a record duplicated by &mirror
      character(:), allocatable :: origin !! key or group of the deck that names `file`, if the record was created from another
                                          !! file: '&hardpoints', 'property_file'
      integer :: used = 0
      type(entry_t), allocatable :: entries(:)
   end type record_t

contains

   !> Appends one value to an entry. A value that is blank and not a string is empty.
   pure subroutine add_value(entry, text, is_string)
      type(entry_t), intent(inout) :: entry
      character(*), intent(in) :: text
      logical, intent(in) :: is_string

      if (.not. allocated(entry%values)) allocate (entry%values(3))
      if (entry%used == size(entry%values)) entry%values = [entry%values, entry%values]      ! twice the size
      entry%used = entry%used + 1
      entry%values(entry%used)%text = text
      entry%values(entry%used)%is_string = is_string
      entry%values(entry%used)%is_empty = .not. is_string .and. text == ''
   end subroutine add_value

   !> Appends an entry to a record.
   pure subroutine add_entry(record, entry)
      type(record_t), intent(inout) :: record
      type(entry_t), intent(inout) :: entry         !! moved: without its strings afterwards

      if (.not. allocated(record%entries)) allocate (record%entries(8))
      if (record%used == size(record%entries)) record%entries = [record%entries, record%entries]      ! twice the size
      record%used = record%used + 1
      associate (to => record%entries(record%used))
         call move_alloc(entry%key, to%key)
         call move_alloc(entry%setting, to%setting)
         call move_alloc(entry%values, to%values)
         to%first = entry%first
         to%line = entry%line
         to%is_bad = entry%is_bad
         to%used = entry%used
      end associate
      entry%used = 0
   end subroutine add_entry

   !> Appends a record to a list whose first `used` elements are filled.
   pure subroutine add_record(records, used, record)
      type(record_t), allocatable, intent(inout) :: records(:)
      integer, intent(inout) :: used
      type(record_t), intent(inout) :: record       !! handed over: empty afterwards
      type(record_t), allocatable :: before(:)

      if (.not. allocated(records)) allocate (records(32))
      if (used == size(records)) then
         call move_alloc(records, before)
         call hand_over(before, used, records, room=2*used)
      end if
      used = used + 1
      call move_record(record, records(used))
   end subroutine add_record

   !> Moves the first `used` records out of the list `from`, which is deallocated, into a new list. Copying a deck instead would
   !> allocate memory hundreds of times.
   pure subroutine hand_over(from, used, to, room)
      type(record_t), allocatable, intent(inout) :: from(:)
      integer, intent(in) :: used
      type(record_t), allocatable, intent(out) :: to(:)
      integer, intent(in), optional :: room         !! size of the new list; default `used`
      integer :: k, n

      n = used
      if (present(room)) n = room
      allocate (to(n))
      do k = 1, used
         call move_record(from(k), to(k))
      end do
      if (allocated(from)) deallocate (from)
   end subroutine hand_over

   pure subroutine move_record(from, to)
      type(record_t), intent(inout) :: from         !! empty afterwards
      type(record_t), intent(inout) :: to

      call move_alloc(from%group, to%group)
      call move_alloc(from%file, to%file)
      call move_alloc(from%origin, to%origin)
      call move_alloc(from%entries, to%entries)
      to%source = from%source
      to%line = from%line
      to%side = from%side
      to%used = from%used
      from%used = 0
   end subroutine move_record

   !> Index of the first entry that contains element `at` of a key (any element if `at` is 0). The index is 0 if there is no such
   !> entry, and for the key ''.
   pure integer function entry_index(record, key, at)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      integer, intent(in) :: at
      integer :: k

      do k = 1, record%used
         associate (entry => record%entries(k))
            if (entry%key /= key) cycle
            if (at /= 0 .and. (at < entry%first .or. at >= entry%first + entry%used)) cycle
         end associate
         entry_index = k
         return
      end do
      entry_index = 0
   end function entry_index

   !> The value of element `at` of a key as a string; '' if the element is not given.
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
      if (record%side == single) return
      if (record%group == 'wheel' .and. name == 'right') name = 'left'      ! the wheel of the half deck has the name of its side
      if (index(name, trim(side_prefix(record%side))) == 1) name = name(len_trim(side_prefix(record%side)) + 1:)
   end function own_name

   !> The location of a record or of one of its entries. Locations of --set are sorted after all files.
   pure type(place_t) function place_of(record, entry) result(place)
      type(record_t), intent(in) :: record
      integer, intent(in) :: entry            !! 0: the record itself

      place = place_in(record%file, record%source, record%line)
      if (entry > 0) place = place_in(record%file, record%source, record%entries(entry)%line)
      place%side = record%side
      if (entry == 0) return
      if (allocated(record%entries(entry)%setting)) then
         place%words = '--set '//record%entries(entry)%setting
         place%source = huge(place%source)
      end if
   end function place_of

   !> Location of a record: 'line 12'; 'line 12 of wheels.nml' if the record with the message is in another file.
   pure function line_text(record, seen_from) result(words)
      type(record_t), intent(in) :: record, seen_from
      character(:), allocatable :: words
      words = 'line '//str(record%line)
      if (record%source /= seen_from%source) words = words//' of '//record%file
   end function line_text

   !> The role of a key under y → −y, as in the table of keys; 0 if the value is equal on both sides. The vector of a rotation axis
   !> is axial.
   pure integer function role_of(record, key) result(role)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      type(key_t) :: row
      logical :: is_known

      role = 0
      call find_key(group_number(record%group), key, row, is_known)
      if (is_known) role = row%role
      if (role == polar .and. key == 'axis_vector' .and. turns(record)) role = axial
   end function role_of

   !> The sign (1 or −1) of element `at` of a key in the mirror image of its record.
   pure real(wp) function sign_of_image(record, key, at) result(sign)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      integer, intent(in) :: at

      sign = 1.0_wp
      if (role_of(record, key) == merge(polar, axial, modulo(at, 3) == 2)) sign = -1.0_wp
   end function sign_of_image

   !> Whether the axis of a record is a rotation axis, so that the sense of rotation determines the sign of the value.
   pure logical function turns(record)
      type(record_t), intent(in) :: record
      turns = record%group == 'torsion' .or. (record%group == 'measure' .and. lower(element(record, 'type', 1)) == 'rotation')
   end function turns

   !> Whether the marker axis that the program chooses for a bushing is the mirror image of its ordinary choice: on the right side of
   !> a mirrored axle, or with `mirrored = .true.`. Both together cancel each other.
   pure logical function takes_image(record)
      type(record_t), intent(in) :: record
      character(:), allocatable :: text

      text = lower(adjustl(element(record, 'mirrored', 1)))
      takes_image = (index(text, 't') == 1 .or. index(text, '.t') == 1) .neqv. record%side == right_side
   end function takes_image

   !> Whether a name begins with left_ or right_.
   pure logical function has_side(name)
      character(*), intent(in) :: name
      has_side = index(lower(name), 'left_') == 1 .or. index(lower(name), 'right_') == 1
   end function has_side

   !> Records an error. An error of the right side is not recorded if the left side has an error at the same location. Invisible
   !> characters in the message are shown by their numbers, as in <U+00A0>.
   pure subroutine complaints_add(self, place, what)
      class(deck_errors_t), intent(inout) :: self
      type(place_t), intent(in) :: place
      character(*), intent(in) :: what
      character(:), allocatable :: text
      integer :: k

      text = visible(what)
      if (place%side == right_side) then
         do k = 1, self%used
            if (self%list(k)%place%side == left_side .and. self%list(k)%place%words == place%words) return
         end do
      else if (place%side == left_side) then
         do
            k = index(text, "'left_")
            if (k == 0) exit
            text = text(:k)//text(k + len("'left_"):)
         end do
      end if
      if (.not. allocated(self%list)) allocate (self%list(8))
      if (self%used == size(self%list)) self%list = [self%list, self%list]      ! twice the size
      self%used = self%used + 1
      self%list(self%used)%place = place
      self%list(self%used)%text = place%words//': '//text
   end subroutine complaints_add

   !> Records that a file was not read to its end, so that the number of errors is unknown.
   pure subroutine complaints_cut(self)
      class(deck_errors_t), intent(inout) :: self
      self%is_cut = .true.
   end subroutine complaints_cut

   !> Records that a file with records of a group, or of any group, was not read: a reference to an unknown record of the group is
   !> then no error of its own.
   pure subroutine complaints_lose(self, group)
      class(deck_errors_t), intent(inout) :: self
      integer, intent(in) :: group                 !! 0: any group
      self%lost(group) = .true.
   end subroutine complaints_lose

   !> Whether records of a group may be missing because their file was not read.
   pure logical function complaints_lacks(self, group) result(lacks)
      class(deck_errors_t), intent(in) :: self
      integer, intent(in) :: group
      lacks = self%lost(0) .or. self%lost(group)
   end function complaints_lacks

   !> The number of recorded errors.
   pure integer function complaints_count(self)
      class(deck_errors_t), intent(in) :: self
      complaints_count = self%used
   end function complaints_count

   !> The messages as one string, one per line, sorted by file and line number. Messages about one line are in the order of
   !> insertion. Only the first 100 messages are included, because a file with more errors is probably not a deck.
   pure function complaints_text(self) result(text)
      class(deck_errors_t), intent(in) :: self
      character(:), allocatable :: text
      integer, parameter :: most = 100
      integer :: order(self%used), k, j

      do k = 1, self%used
         do j = k - 1, 1, -1
            associate (this => self%list(k)%place, other => self%list(order(j))%place)
               if (this%source > other%source .or. (this%source == other%source .and. this%line >= other%line)) exit
            end associate
            order(j + 1) = order(j)
         end do
         order(j + 1) = k
      end do
      text = ''
      do k = 1, min(self%used, most)
         if (k > 1) text = text//new_line('a')
         text = text//self%list(order(k))%text
      end do
      if (self%used <= most) return
      text = text//new_line('a')//'and '//str(self%used - most)
      if (self%is_cut) text = text//' or more'
      text = text//' other error'
      if (self%used > most + 1 .or. self%is_cut) text = text//'s'
      text = text//'; is this a deck?'
   end function complaints_text

   !> The location of a line of a file; line 0 is the file itself.
   pure type(place_t) function place_in(file, source, line) result(place)
      character(*), intent(in) :: file
      integer, intent(in) :: source, line

      place%words = file
      if (line > 0) place%words = file//':'//str(line)
      place%source = source
      place%line = line
   end function place_in

end module ek_record
