!> A deck in memory: read from a file or a string, changed by settings, and identified by a checksum.
!>
!> A syntax error (a group without its end, a key given twice) does not stop the reading. The error is stored in the deck, and
!> `build_model` reports it together with all other errors. Therefore the argument `error` of `read_deck` and `parse_deck` is set
!> only if the file cannot be read (exit_file) or is empty (exit_deck).
!>
!> Order of processing: records of the file or string, included files, &hardpoints, sets of &manoeuvre, settings of records in the
!> deck, property files, &mirror, settings of records that property files and &mirror have created.
module ek_deck
   use, intrinsic :: iso_fortran_env, only: input_unit, iostat_eor
   use ek_buffer, only: buffer_t
   use ek_error, only: error_t, fail, exit_deck, exit_usage, exit_file
   use ek_file, only: read_whole, join_path, folder_name
   use ek_kept_files, only: kept_files_t, add_file, keep_file, read_kept
   use ek_checksum, only: checksum_t, include, digits_of
   use ek_text, only: str, lower, quoted
   use ek_letters, only: visible
   use ek_record, only: place_t, deck_errors_t, place_in, record_t, entry_t, element, entry_index, is_given, add_value, add_entry, &
      add_record, place_of
   use ek_scanner, only: scan_text
   use ek_mirror, only: mirror_records
   use ek_hardpoint_records, only: attach_hardpoints
   use ek_property_records, only: attach_properties
   use ek_manoeuvre_records, only: attach_manoeuvres
   use ek_part_records, only: name_parts, add_part
   use ek_attachment, only: text_of, path_of
   use ek_setting, only: apply_setting, split_setting
   implicit none(type, external)
   private
   public :: deck_t, read_deck, parse_deck, move_deck, set_value, declare_path, finish_deck, split_setting, deck_checksum, &
      include_records

   !> A setting `path=text` of a record that a property file or &mirror will create.
   type :: setting_t
      character(:), allocatable :: path, text
   end type setting_t

   !> A parsed deck: its records, syntax errors and late settings, and the contents of the files that it names.
   type :: deck_t
      character(:), allocatable :: file          !! path as given by the user, for messages
      type(record_t), allocatable :: records(:)  !! the first `used` are filled: in the order of the files, then &hardpoints
      integer :: used = 0
      type(deck_errors_t) :: deck_errors           !! syntax errors
      type(setting_t), allocatable :: late(:)    !! settings to be applied after property files and &mirror
      logical :: is_finished = .false.
      type(kept_files_t) :: kept                 !! contents of the deck and of all files that it names, as first read
   end type deck_t

   ! &include: the record itself stays in the list, so that its keys are checked like all others; the records of the file follow
   ! it. Every record stores its file, which messages then show.
   integer, parameter :: max_nested = 8      !! nesting depth of included files; a greater depth is an error
   integer, parameter :: max_files = 500     !! included files in total: ten files of ten each, eight levels deep, would be 10^8
   integer, parameter :: max_letters = 50000000   !! characters of the deck, and of all included files; known decks have 1 % of it

   type :: file_t
      character(:), allocatable :: path
   end type file_t

   !> The nested files that are being read, and totals of the files read so far.
   type :: files_t
      type(file_t) :: open(0:max_nested)     !! the nested files, from the deck inwards
      integer :: sources = 0, letters = 0     !! number of files read; characters of the included files
   end type files_t

contains

   !> Reads a deck from a file; '-' is standard input.
   subroutine read_deck(path, deck, error, is_study)
      character(*), intent(in) :: path
      type(deck_t), intent(out) :: deck
      type(error_t), allocatable, intent(out) :: error
      logical, intent(in), optional :: is_study     !! the file of a study, which includes no other files; default .false.
      character(:), allocatable :: text, name

      name = path
      if (path == '-') then
         name = 'standard input'
         call read_standard_input(text, error)
      else
         call read_whole(path, text, error, may_stream=.true.)
      end if
      if (.not. allocated(error) .and. len(text) > max_letters) call fail(error, exit_file, 'cannot read '//quoted(name)// &
         ': it has '//str(len(text)/1000000)//' MB, expected at most '//str(max_letters/1000000)//' MB')
      if (.not. allocated(error)) call parse_deck(text, name, deck, error, is_study)
   end subroutine read_deck

   !> Parses a deck from a string. `name` is the file name for messages, and included files are relative to its folder.
   subroutine parse_deck(text, name, deck, error, is_study, kept)
      character(*), intent(in) :: text, name
      type(deck_t), intent(out) :: deck
      type(error_t), allocatable, intent(out) :: error
      logical, intent(in), optional :: is_study     !! default .false.
      type(kept_files_t), intent(in), optional :: kept      !! files that are not read again
      type(files_t) :: files
      logical :: is_alone

      deck%file = trim(name)
      allocate (deck%late(0))
      is_alone = .false.
      if (present(is_study)) is_alone = is_study
      if (is_alone) then
         call scan_text(text, deck%file, deck%records, deck%used, deck%deck_errors)
      else
         allocate (deck%records(32))
         files%open(0)%path = deck%file
         if (present(kept)) deck%kept = kept
         call add_file(deck%kept, deck%file, text)
         call take_text(text, 0, files, deck)
         call attach_hardpoints(deck%kept, deck%records, deck%used, deck%deck_errors)
         call attach_manoeuvres(deck%records, deck%used)
         call keep_named(deck)
      end if
      call name_tests(deck)
      call name_parts(deck%records, deck%used)
      if (deck%used == 0 .and. deck%deck_errors%count() == 0) &
         call fail(error, exit_deck, deck%file//': the deck is empty')
   end subroutine parse_deck

   !> Stores in `deck%kept` the contents of the property files and load tables that records name.
   subroutine keep_named(deck)
      type(deck_t), intent(inout) :: deck
      character(:), allocatable :: name
      integer :: k

      do k = 1, deck%used
         name = text_of(deck%records(k), 'property_file')
         if (deck%records(k)%group == 'case') name = text_of(deck%records(k), 'file')
         if (name /= '') call keep_file(deck%kept, path_of(deck%records(k), name))
      end do
   end subroutine keep_named

   !> Names a rig case without a name after its test: parallel_travel, aligning_torque_anti.
   subroutine name_tests(deck)
      type(deck_t), intent(inout) :: deck
      type(entry_t) :: name
      character(:), allocatable :: text
      integer :: k

      do k = 1, deck%used
         if (deck%records(k)%group /= 'case' .or. is_given(deck%records(k), 'name')) cycle
         text = lower(element(deck%records(k), 'test', 1))
         if (text == '') cycle
         if (lower(element(deck%records(k), 'phase', 1)) == 'anti') text = text//'_anti'
         name%key = 'name'
         name%line = deck%records(k)%line
         name%used = 0
         call add_value(name, text, .true.)
         call add_entry(deck%records(k), name)
      end do
   end subroutine name_tests

   !> Sets one value, as `--set path=value` does: `point.lower_ball_joint.z`, `bushing.top_mount.kt(1)`, `spring.coil.rate`,
   !> `model.length`. A key that the record does not give is added, unless the path contains *. Ranges are checked by `build_model`,
   !> whose messages then give this setting as the location.
   !>
   !> With &mirror, a record of the deck is changed before it is duplicated, so that both sides change;
   !> `point.left_lower_ball_joint.z` changes one side.
   subroutine set_value(deck, path, text, error)
      type(deck_t), intent(inout) :: deck
      character(*), intent(in) :: path    !! group.name.key or model.key
      character(*), intent(in) :: text    !! the value as in a deck; quotes around strings may be omitted
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: message, late_message
      type(deck_t) :: whole
      type(setting_t) :: late
      logical :: is_found

      call add_part(deck%records, deck%used, path, '--set '//trim(adjustl(path)), message)
      if (message /= '') then
         call fail(error, exit_usage, visible('--set '//trim(adjustl(path))//'='//trim(adjustl(text))//': '//message))
         return
      end if
      call apply_setting(deck%records, deck%used, path, text, message, is_found)
      if (message == '') return
      if (.not. is_found) then
         call finish_deck(deck, whole)
         call apply_setting(whole%records, whole%used, path, text, late_message, is_found)
         if (late_message == '') then
            late%path = path
            late%text = text
            deck%late = [deck%late, late]
            return
         end if
         ! the intended name may be that of either kind of record
         if (is_found .or. index(message, 'did you mean') == 0) message = late_message
      end if
      if (deck%deck_errors%count() > 0) message = deck%deck_errors%text()//new_line('a')//message
      call fail(error, exit_usage, visible(message))
   end subroutine set_value

   !> Prepares the deck for a path that will be varied: a path of a part that the deck does not give becomes a record, as drawn.
   subroutine declare_path(deck, path, where, error)
      type(deck_t), intent(inout) :: deck
      character(*), intent(in) :: path
      character(*), intent(in) :: where        !! location of the path, for messages
      type(error_t), allocatable, intent(inout) :: error      !! exit_usage
      character(:), allocatable :: message

      call add_part(deck%records, deck%used, path, where, message)
      if (message /= '') call fail(error, exit_usage, visible(where//': '//trim(adjustl(path))//': '//message))
   end subroutine declare_path

   !> Copies the deck and finishes the copy: reads property files, creates the records of both sides (&mirror), and applies the
   !> settings of records that these steps have created. Errors are added to the errors of the copy.
   subroutine finish_deck(deck, whole)
      type(deck_t), intent(in) :: deck
      type(deck_t), intent(out) :: whole
      type(record_t), allocatable :: half(:)
      character(:), allocatable :: message
      type(place_t) :: place
      logical :: is_found
      integer :: k, half_used

      whole = deck
      if (deck%is_finished) return
      whole%is_finished = .true.
      call attach_properties(whole%kept, whole%records, whole%used, whole%deck_errors)
      if (any([(whole%records(k)%group == 'mirror', k=1, whole%used)])) then
         half_used = whole%used
         call move_alloc(whole%records, half)
         call mirror_records(half, half_used, whole%records, whole%used, whole%deck_errors)
      end if
      do k = 1, size(deck%late)
         call apply_setting(whole%records, whole%used, deck%late(k)%path, deck%late(k)%text, message, is_found)
         if (index(deck%late(k)%path, '.property_') > 0) message = '--set '//trim(deck%late(k)%path)//'='// &
            trim(deck%late(k)%text)//': a property file belongs to both sides; omit left_ or right_'
         if (message == '') cycle      ! a later setting has removed the record to which this one refers
         place%words = '--set '//trim(deck%late(k)%path)//'='//trim(deck%late(k)%text)
         place%source = huge(place%source)
         call whole%deck_errors%add(place, message(len(place%words) + 3:))
      end do
   end subroutine finish_deck

   !> Moves a deck to another variable. The original deck has no records afterwards.
   subroutine move_deck(from, to)
      type(deck_t), intent(inout) :: from
      type(deck_t), intent(out) :: to

      call move_alloc(from%file, to%file)
      call move_alloc(from%records, to%records)
      call move_alloc(from%late, to%late)
      to%used = from%used
      to%deck_errors = from%deck_errors
      to%is_finished = from%is_finished
      to%kept = from%kept
      from%used = 0
   end subroutine move_deck

   !> Checksum of everything that can change a result, 16 hexadecimal digits (FNV-1a, 64 bits). Settings and load tables are
   !> included. Comments, notes, titles, layout, target bands, the class of the axle and the division of the deck into files are
   !> ignored.
   function deck_checksum(deck) result(digits)
      type(deck_t), intent(in) :: deck
      character(16) :: digits
      type(deck_t) :: whole
      type(checksum_t) :: sum

      call finish_deck(deck, whole)
      call include_records(whole%records(:whole%used), sum)
      call include_tables(whole%kept, whole%records(:whole%used), sum)
      digits = digits_of(sum)
   end function deck_checksum

   !> Adds the bytes of the load tables named by cases to a checksum. A table that cannot be read is not added, because its case
   !> cannot be run.
   subroutine include_tables(files, records, sum)
      type(kept_files_t), intent(in) :: files      !! files already read, which are not read again
      type(record_t), intent(in) :: records(:)
      type(checksum_t), intent(inout) :: sum
      type(error_t), allocatable :: unread
      character(:), allocatable :: text
      integer :: k

      do k = 1, size(records)
         if (records(k)%group /= 'case' .or. .not. is_given(records(k), 'file')) cycle
         call read_kept(files, path_of(records(k), element(records(k), 'file', 1)), text, unread)
         if (.not. allocated(unread)) call include(sum, '<'//str(len(text))//'>'//text)
      end do
   end subroutine include_tables

   !> Adds the groups, keys and values of records to a checksum, without the groups &include, &hardpoints and &target_band, and
   !> without the keys note, title, format (of a study), property_file and class (of an axle).
   subroutine include_records(records, sum)
      type(record_t), intent(in) :: records(:)
      type(checksum_t), intent(inout) :: sum
      integer :: k, e, v

      do k = 1, size(records)
         if (any([character(11) :: 'include', 'hardpoints', 'target_band'] == records(k)%group)) cycle
         call include(sum, '&'//records(k)%group)
         do e = 1, records(k)%used
            associate (entry => records(k)%entries(e))
               if (any([character(13) :: 'note', 'title', 'format', 'property_file', 'class'] == entry%key)) cycle
               call include(sum, ';'//entry%key//'('//str(entry%first)//')')
               do v = 1, entry%used
                  call include(sum, merge("'", ',', entry%values(v)%is_string)//entry%values(v)%text)
               end do
            end associate
         end do
      end do
   end subroutine include_records

   !> Reads all of standard input line by line, because it may be a pipe of unknown size.
   subroutine read_standard_input(text, error)
      character(:), allocatable, intent(out) :: text
      type(error_t), allocatable, intent(out) :: error      !! exit_file: the input is too long
      type(buffer_t) :: buffer
      character(4096) :: chunk
      integer :: status, got

      do
         read (input_unit, '(a)', advance='no', iostat=status, size=got) chunk
         if (status /= 0 .and. status /= iostat_eor) exit
         call buffer%add(chunk(:got))
         if (status == iostat_eor) call buffer%add(new_line('a'))
         if (buffer%length() > max_letters) then
            call fail(error, exit_file, 'cannot read standard input: it is longer than '//str(max_letters/1000000)//' MB')
            return
         end if
      end do
      text = buffer%text()
   end subroutine read_standard_input

   !> Scans the content of the innermost open file, and reads the files that it includes. An &include without a quoted name is left
   !> to the check of its keys.
   recursive subroutine take_text(text, depth, files, deck)
      character(*), intent(in) :: text
      integer, intent(in) :: depth
      type(files_t), intent(inout) :: files
      type(deck_t), intent(inout) :: deck
      type(record_t), allocatable :: own(:)
      type(record_t) :: include
      integer :: k, entry, own_used

      files%sources = files%sources + 1
      call scan_text(text, files%open(depth)%path, own, own_used, deck%deck_errors, files%sources)
      do k = 1, own_used
         entry = 0
         if (own(k)%group == 'include') entry = entry_index(own(k), 'file', 1)
         if (entry > 0) include = own(k)
         call add_record(deck%records, deck%used, own(k))
         if (entry == 0) cycle
         associate (file => include%entries(entry))
            if (file%used == 1 .and. file%values(1)%is_string .and. file%values(1)%text /= '') &
               call take_file(trim(file%values(1)%text), place_of(include, entry), depth, files, deck)
         end associate
      end do
   end subroutine take_text

   !> Reads an included file, whose name is relative to the folder of the innermost open file.
   recursive subroutine take_file(name, place, depth, files, deck)
      character(*), intent(in) :: name
      type(place_t), intent(in) :: place        !! location of the &include
      integer, intent(in) :: depth
      type(files_t), intent(inout) :: files
      type(deck_t), intent(inout) :: deck
      type(error_t), allocatable :: error
      character(:), allocatable :: text, path
      integer :: k, records_before, complaints_before

      if (files%sources > max_files + 1) return                     ! already reported
      path = name
      if (index(files%open(depth)%path, '/') > 0) path = join_path(folder_name(files%open(depth)%path), name)
      do k = 0, depth
         if (plain_path(files%open(k)%path) /= plain_path(path)) cycle
         call deck%deck_errors%add(place, 'include: '//quoted(path)//' includes itself')
         call deck%deck_errors%lose(0)
         return
      end do
      if (depth == max_nested) then
         call deck%deck_errors%add(place, 'include: files are nested more than '//str(max_nested)//' deep')
         call deck%deck_errors%lose(0)
         return
      end if
      call read_kept(deck%kept, path, text, error)
      if (allocated(error)) then
         call deck%deck_errors%add(place, 'include: '//error%message)
         call deck%deck_errors%lose(0)
         return
      end if
      files%letters = files%letters + min(len(text), max_letters)
      if (files%sources > max_files .or. files%letters > max_letters) then
         ! sorted before all other mistakes, which may be its consequences
         call deck%deck_errors%add(place_in(deck%file, 0, 0), 'more than '//str(max_files)//' files or '// &
            str(max_letters/1000000)//' MB are included in total; the last one by '//place%words)
         call deck%deck_errors%cut()
         call deck%deck_errors%lose(0)
         files%sources = max_files + 2                       ! reported once; the rest is not read
         return
      end if
      records_before = deck%used
      complaints_before = deck%deck_errors%count()
      call add_file(deck%kept, path, text)
      files%open(depth + 1)%path = path
      call take_text(text, depth + 1, files, deck)
      if (deck%used == records_before .and. deck%deck_errors%count() == complaints_before) &
         call deck%deck_errors%add(place, 'include: no group found in '//quoted(path))
   end subroutine take_file

   !> A path without 'x/..' and '.', so that two spellings of a path compare equal.
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

end module ek_deck
