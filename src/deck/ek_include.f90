!> &include: a deck in several files, read like a single text.
!>
!> The &include record itself stays in the list, so that its keys are checked like all others; the records
!> of the file follow it. Every record stores its file, which messages then show.
module ek_include
   use ek_error, only: error_t
   use ek_file, only: read_whole, join_path, folder_name
   use ek_text, only: str, quoted
   use ek_complaint, only: place_t, complaints_t, place_in
   use ek_record, only: record_t, add_record, entry_index, place_of
   use ek_scanner, only: scan_text
   implicit none(type, external)
   private
   public :: read_text

   integer, parameter :: most_nested = 8      !! nesting depth of files; more is a mistake
   integer, parameter :: most_files = 500     !! total: ten files that include ten each, eight levels deep, would be 10^8
   integer, parameter :: most_letters = 50000000   !! total; the largest known deck has 1 % of it

   !> The open files, from the deck inwards.
   type :: file_t
      character(:), allocatable :: path
   end type file_t

contains

   !> Reads all records of a text and of the files it includes. Mistakes are added to the list of messages.
   subroutine read_text(text, file, records, used, complaints)
      character(*), intent(in) :: text
      character(*), intent(in) :: file                        !! its path, or its label in messages
      type(record_t), allocatable, intent(out) :: records(:)  !! the first `used` are filled
      integer, intent(out) :: used
      type(complaints_t), intent(inout) :: complaints
      type(file_t) :: open_files(0:most_nested)
      integer :: sources, letters

      allocate (records(32))
      used = 0
      sources = 0
      letters = 0
      open_files(0)%path = file
      call take_text(text, 0, open_files, sources, letters, records, used, complaints)
   end subroutine read_text

   !> The text of the innermost open file.
   recursive subroutine take_text(text, depth, open_files, sources, letters, records, used, complaints)
      character(*), intent(in) :: text
      integer, intent(in) :: depth
      type(file_t), intent(inout) :: open_files(0:)
      integer, intent(inout) :: sources, letters              !! files read so far, and their characters
      type(record_t), allocatable, intent(inout) :: records(:)
      integer, intent(inout) :: used
      type(complaints_t), intent(inout) :: complaints
      type(record_t), allocatable :: own(:)
      type(place_t) :: place
      character(:), allocatable :: name
      integer :: k, own_used

      sources = sources + 1
      call scan_text(text, open_files(depth)%path, own, own_used, complaints, sources)
      do k = 1, own_used
         name = ''
         if (own(k)%group == 'include') call find_name(own(k), name, place)
         call add_record(records, used, own(k))
         if (name /= '') call take_file(name, place, depth, open_files, sources, letters, records, used, complaints)
      end do
   end subroutine take_text

   !> The file named by an &include; '' if no quoted name is given, which the check of its keys reports.
   subroutine find_name(record, name, place)
      type(record_t), intent(in) :: record
      character(:), allocatable, intent(out) :: name
      type(place_t), intent(out) :: place
      integer :: entry

      name = ''
      entry = entry_index(record, 'file', 1)
      if (entry == 0) return
      call place_of(record, entry, place)
      if (record%entries(entry)%values(1)%is_string .and. record%entries(entry)%used == 1) &
         name = trim(record%entries(entry)%values(1)%text)
   end subroutine find_name

   !> Reads a file named relative to the innermost open one.
   recursive subroutine take_file(name, place, depth, open_files, sources, letters, records, used, complaints)
      character(*), intent(in) :: name
      type(place_t), intent(in) :: place        !! of the &include
      integer, intent(in) :: depth
      type(file_t), intent(inout) :: open_files(0:)
      integer, intent(inout) :: sources, letters
      type(record_t), allocatable, intent(inout) :: records(:)
      integer, intent(inout) :: used
      type(complaints_t), intent(inout) :: complaints
      type(error_t), allocatable :: error
      type(place_t) :: all_of_it
      character(:), allocatable :: text, path
      integer :: k, records_before, complaints_before

      if (sources > most_files + 1) return                     ! already reported
      path = beside(open_files(depth)%path, name)
      do k = 0, depth
         if (plain_path(open_files(k)%path) /= plain_path(path)) cycle
         call complaints%add(place, 'include: '//quoted(path)//' includes itself')
         return
      end do
      if (depth == most_nested) then
         call complaints%add(place, 'include: files are nested more than '//str(most_nested)//' deep')
         return
      end if
      call read_whole(path, text, error)
      if (allocated(error)) then
         call complaints%add(place, 'include: '//error%message)
         return
      end if
      letters = letters + min(len(text), most_letters)
      if (sources > most_files .or. letters > most_letters) then
         call place_in(open_files(0)%path, 0, 0, all_of_it)     ! sorted before all other mistakes, which may be its consequences
         call complaints%add(all_of_it, 'more than '//str(most_files)//' files or '//str(most_letters/1000000)// &
            ' MB are included in total; the last one by '//place%words)
         sources = most_files + 2                              ! reported once; the rest is not read
         return
      end if
      records_before = used
      complaints_before = complaints%count()
      open_files(depth + 1)%path = path
      call take_text(text, depth + 1, open_files, sources, letters, records, used, complaints)
      if (used == records_before .and. complaints%count() == complaints_before) &
         call complaints%add(place, 'include: no group found in '//quoted(path))
   end subroutine take_file

   !> The path of a file named in another file, relative to the folder of the latter or the working folder.
   pure function beside(file, name) result(path)
      character(*), intent(in) :: file, name
      character(:), allocatable :: path

      path = name
      if (index(file, '/') > 0) path = join_path(folder_name(file), name)
   end function beside

   !> A path without 'x/..' and '.', so that different spellings of one path compare equal.
   pure function plain_path(path) result(plain)
      character(*), intent(in) :: path
      character(:), allocatable :: plain
      character(:), allocatable :: part
      integer :: first, slash, last

      plain = ''
      first = 1
      do
         slash = index(path(first:), '/')
         if (slash == 0) then
            part = path(first:)
         else
            part = path(first:first + slash - 2)
         end if
         last = index(plain, '/', back=.true.)
         if (part == '..' .and. plain /= '' .and. plain(last + 1:) /= '..') then
            plain = plain(:max(last - 1, 0))
         else if (part /= '.' .and. (part /= '' .or. first == 1)) then
            if (plain /= '' .or. (first > 1 .and. path(1:1) == '/')) plain = plain//'/'
            plain = plain//part
         end if
         if (slash == 0) exit
         first = first + slash
      end do
   end function plain_path

end module ek_include
