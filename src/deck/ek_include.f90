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

   type :: file_t
      character(:), allocatable :: path
   end type file_t

   !> What has been read so far.
   type :: files_t
      type(file_t) :: open(0:most_nested)     !! from the deck inwards
      integer :: sources = 0, letters = 0     !! files, and their characters
      type(record_t), allocatable :: records(:)
      integer :: used = 0
   end type files_t

contains

   !> Reads all records of a text and of the files it includes. Mistakes are added to the list of messages.
   subroutine read_text(text, file, records, used, complaints)
      character(*), intent(in) :: text
      character(*), intent(in) :: file                        !! its path, or its label in messages
      type(record_t), allocatable, intent(out) :: records(:)  !! the first `used` are filled
      integer, intent(out) :: used
      type(complaints_t), intent(inout) :: complaints
      type(files_t) :: files

      allocate (files%records(32))
      files%open(0)%path = file
      call take_text(text, 0, files, complaints)
      call move_alloc(files%records, records)
      used = files%used
   end subroutine read_text

   !> The text of the innermost open file. An &include without a quoted name is left to the check of its keys.
   recursive subroutine take_text(text, depth, files, complaints)
      character(*), intent(in) :: text
      integer, intent(in) :: depth
      type(files_t), intent(inout) :: files
      type(complaints_t), intent(inout) :: complaints
      type(record_t), allocatable :: own(:)
      type(place_t) :: place
      integer :: k, entry, own_used

      files%sources = files%sources + 1
      call scan_text(text, files%open(depth)%path, own, own_used, complaints, files%sources)
      do k = 1, own_used
         call add_record(files%records, files%used, own(k))
         entry = 0
         if (own(k)%group == 'include') entry = entry_index(own(k), 'file', 1)
         if (entry == 0) cycle
         call place_of(own(k), entry, place)
         associate (file => own(k)%entries(entry))
            if (file%used == 1 .and. file%values(1)%is_string .and. file%values(1)%text /= '') &
               call take_file(trim(file%values(1)%text), place, depth, files, complaints)
         end associate
      end do
   end subroutine take_text

   !> Reads a file named relative to the innermost open one.
   recursive subroutine take_file(name, place, depth, files, complaints)
      character(*), intent(in) :: name
      type(place_t), intent(in) :: place        !! of the &include
      integer, intent(in) :: depth
      type(files_t), intent(inout) :: files
      type(complaints_t), intent(inout) :: complaints
      type(error_t), allocatable :: error
      type(place_t) :: all_of_it
      character(:), allocatable :: text, path
      integer :: k, records_before, complaints_before

      if (files%sources > most_files + 1) return                     ! already reported
      path = name
      if (index(files%open(depth)%path, '/') > 0) path = join_path(folder_name(files%open(depth)%path), name)
      do k = 0, depth
         if (plain_path(files%open(k)%path) /= plain_path(path)) cycle
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
      files%letters = files%letters + min(len(text), most_letters)
      if (files%sources > most_files .or. files%letters > most_letters) then
         call place_in(files%open(0)%path, 0, 0, all_of_it)   ! sorted before all other mistakes, which may be its consequences
         call complaints%add(all_of_it, 'more than '//str(most_files)//' files or '//str(most_letters/1000000)// &
            ' MB are included in total; the last one by '//place%words)
         files%sources = most_files + 2                       ! reported once; the rest is not read
         return
      end if
      records_before = files%used
      complaints_before = complaints%count()
      files%open(depth + 1)%path = path
      call take_text(text, depth + 1, files, complaints)
      if (files%used == records_before .and. complaints%count() == complaints_before) &
         call complaints%add(place, 'include: no group found in '//quoted(path))
   end subroutine take_file

   !> A path without 'x/..' and '.', so that different spellings of one path compare equal.
   pure function plain_path(path) result(plain)
      character(*), intent(in) :: path
      character(:), allocatable :: plain
      character(:), allocatable :: part
      integer :: first, slash, last

      plain = ''
      first = 1
      do while (first <= len(path))
         slash = index(path(first:)//'/', '/')
         part = path(first:first + slash - 2)
         first = first + slash
         last = index(plain, '/', back=.true.)
         if (part == '..' .and. plain /= '' .and. plain(last + 1:) /= '..') then
            plain = plain(:last - 1)
         else if (part /= '.' .and. part /= '') then
            plain = plain//'/'//part
         end if
      end do
      if (index(path, '/') /= 1) plain = '.'//plain
   end function plain_path

end module ek_include
