!> Converts the content of a deck to records.
!>
!> The compiler's namelist read silently accepts misspelt groups, text between groups, keys given twice
!> and records without an end. Therefore this scanner handles groups, keys, subscripts, repeat
!> counts and line numbers; it continues after every error and reports all of them.
!>
!>     &group key = value, value  key(2) = 3*0.0 /     ! a comment
!>
!> Values are separated by commas, blanks or line ends; strings are enclosed in ' or ", doubled inside a string.
module ek_scanner
   use ek_text, only: str, lower, quoted, plural
   use ek_letters, only: is_wide, with_line_ends, save_as_utf8
   use ek_cursor, only: cursor_t, skip_blanks, next_character, key_follows, lacks_equals, take_subscript, take_word, &
      take_anything, take_line, drop_unit, unit_message, is_word_begin, quotes, tab, newline, return
   use ek_record, only: deck_errors_t, place_in, entry_t, record_t, add_value, add_entry, add_record, entry_index
   implicit none(type, external)
   private
   public :: scan_text, scan_values

   integer, parameter :: max_repeats = 1000   !! n in n*value; no key accepts so many values

contains

   !> Scans all records of a string. Errors are added to the list of messages as `file:line: error`. Line ends of any system are
   !> accepted.
   subroutine scan_text(written, file, records, used, deck_errors, source)
      character(*), intent(in) :: written
      character(*), intent(in) :: file                        !! name for messages
      type(record_t), allocatable, intent(out) :: records(:)  !! the first `used` are filled
      integer, intent(out) :: used
      type(deck_errors_t), intent(inout) :: deck_errors
      integer, intent(in), optional :: source                 !! index of the file, in the order of reading; default 1
      type(record_t) :: blank, record
      type(cursor_t) :: cursor
      character(:), allocatable :: text, word
      integer, parameter :: max_mistakes = 1000        ! each takes 2 kB; nobody reads more
      integer :: last_stray

      allocate (records(32))
      used = 0
      last_stray = 0
      blank%file = file
      if (present(source)) blank%source = source
      if (is_wide(written)) then
         call complain(deck_errors, blank, 0, save_as_utf8)
         return
      end if
      text = with_line_ends(written)
      do
         call skip_blanks(text, cursor)
         if (cursor%at > len(text)) exit
         if (deck_errors%count() >= max_mistakes) then
            call complain(deck_errors, blank, cursor%line, 'the file has '//str(max_mistakes)//' errors up to this line; the '// &
               'rest is not read. Is it a deck?')
            call deck_errors%cut()
            exit
         end if
         if (text(cursor%at:cursor%at) == '&') then
            record = blank
            record%line = cursor%line
            cursor%at = cursor%at + 1
            call take_word(text, cursor, word)
            record%group = lower(word)
            if (record%group == 'end') then
               call complain(deck_errors, record, record%line, "'&end' without a group before it")
               cycle
            else if (word == '') then
               call complain(deck_errors, record, record%line, "'&' without a group name")
            end if
            call scan_record(text, cursor, record, deck_errors)
            call add_record(records, used, record)
         else
            call take_line(text, cursor, word)
            ! one message per line is enough
            if (cursor%line /= last_stray) call complain(deck_errors, blank, cursor%line, 'text outside any group: '// &
               quoted(word)//" (a group begins with &, ends with /, a comment begins with !)")
            last_stray = cursor%line
         end if
      end do
   end subroutine scan_text

   !> Scans the values of one key, as written after the = sign (for --set).
   subroutine scan_values(text, entry, message)
      character(*), intent(in) :: text
      type(entry_t), intent(inout) :: entry               !! values are appended
      character(:), allocatable, intent(out) :: message   !! '' if there is no error
      type(deck_errors_t) :: deck_errors
      type(record_t) :: record
      type(cursor_t) :: cursor
      character(:), allocatable :: unit
      logical :: after_comma

      message = ''
      after_comma = .true.
      record%file = ''
      do
         call skip_blanks(text, cursor)
         if (cursor%at > len(text)) exit
         if (index('/&=()', text(cursor%at:cursor%at)) > 0) then
            message = 'unexpected '//quoted(text(cursor%at:cursor%at))
            return
         end if
         call scan_value(text, cursor, record, entry, after_comma, deck_errors)
         call drop_unit(text, cursor, entry, unit)
         if (unit /= '') then
            message = unit_message(entry, unit)
            return
         end if
      end do
      if (deck_errors%count() > 0) message = 'the string has no closing quote, or the repeat count is wrong'
      if (entry%used == 0) message = 'no value'
   end subroutine scan_values

   !> Reads one group, from the end of its name to the end of the group.
   subroutine scan_record(text, cursor, record, deck_errors)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor
      type(record_t), intent(inout) :: record
      type(deck_errors_t), intent(inout) :: deck_errors
      type(entry_t) :: entry, lost
      type(cursor_t) :: start
      character(:), allocatable :: word
      logical :: after_comma, is_open, is_key
      character :: c

      is_open = .false.      ! whether `entry` is being filled
      after_comma = .false.
      do
         call skip_blanks(text, cursor)
         if (cursor%at > len(text)) then
            call complain(deck_errors, record, record%line, '&'//record%group//" is not terminated by '/'")
            exit
         end if
         start = cursor
         c = text(cursor%at:cursor%at)
         if (c == '/') then
            cursor%at = cursor%at + 1
            exit
         else if (c == '&') then
            cursor%at = cursor%at + 1
            call take_word(text, cursor, word)
            if (lower(word) == 'end') exit
            cursor = start
            call complain(deck_errors, record, record%line, '&'//record%group// &
               " is not terminated by '/' before the next group in line "//str(cursor%line))
            exit
         end if
         is_key = .false.
         if (is_word_begin(c)) then
            is_key = key_follows(text, cursor)
            ! after the values of a key, the name of another key is not a value
            if (.not. is_key .and. (.not. is_open .or. entry%used > 0)) is_key = lacks_equals(text, cursor, record%group)
         end if

         if (is_key) then
            if (is_open) call close_entry(entry, record, deck_errors)
            call open_entry(text, cursor, record, entry, deck_errors)
            is_open = .true.
            after_comma = .true.           ! a comma here leaves the first value empty
         else if (.not. is_open) then
            lost%used = 0
            after_comma = .true.
            call scan_value(text, cursor, record, lost, after_comma, deck_errors)
            call complain_of(deck_errors, record, start%line, 'found '//quoted(lost%values(1)%text)// &
               " where a key and '=' were expected")
         else if (c == '(') then
            call take_subscript(text, cursor, word)
            call add_value(entry, '('//word//')', .false.)
         else if (c == '=' .or. c == ')') then
            call complain_of(deck_errors, record, cursor%line, 'unexpected '//quoted(c)//' after '//quoted(entry%key))
            cursor%at = cursor%at + 1
         else
            call scan_value(text, cursor, record, entry, after_comma, deck_errors)
            if (after_comma) cycle
            call drop_unit(text, cursor, entry, word)
            if (word /= '') call complain_of(deck_errors, record, cursor%line, unit_message(entry, word))
         end if
      end do
      if (is_open) call close_entry(entry, record, deck_errors)
   end subroutine scan_record

   !> Reads a key, its subscript (one index, or a range such as 1:3) and the = sign. A missing = sign, or a colon instead, is reported
   !> as an error.
   subroutine open_entry(text, cursor, record, entry, deck_errors)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor
      type(record_t), intent(in) :: record
      type(entry_t), intent(out) :: entry
      type(deck_errors_t), intent(inout) :: deck_errors
      character(:), allocatable :: subscript, word
      logical :: is_good
      integer :: colon

      entry%line = cursor%line
      call take_word(text, cursor, word)
      entry%key = lower(word)
      call skip_blanks(text, cursor)
      if (next_character(text, cursor) == '(') then
         call take_subscript(text, cursor, subscript)
         colon = index(subscript//':', ':')
         is_good = is_subscript(subscript(:colon - 1))
         if (is_good) read (subscript(:colon - 1), *) entry%first
         if (colon <= len(subscript)) then
            is_good = is_good .and. is_subscript(subscript(colon + 1:))
            if (is_good) read (subscript(colon + 1:), *) entry%last
            is_good = is_good .and. entry%last >= entry%first
         end if
         if (.not. is_good .or. entry%first < 1) then
            call complain_of(deck_errors, record, entry%line, 'the subscript of '//quoted(entry%key)// &
               ' must be a positive integer or a range such as 1:3, found ('//subscript//')')
            entry%first = 1
            entry%last = 0
         end if
         call skip_blanks(text, cursor)
      end if
      if (next_character(text, cursor) == ':') then
         call complain_of(deck_errors, record, entry%line, 'expected = after '//quoted(entry%key)//', found :')
         cursor%at = cursor%at + 1
      else if (next_character(text, cursor) /= '=') then
         call complain_of(deck_errors, record, entry%line, 'the = after '//quoted(entry%key)//' is missing')
      end if
      if (next_character(text, cursor) == '=') cursor%at = cursor%at + 1

   contains

      !> Whether a string is an integer of at most six digits.
      pure logical function is_subscript(text)
         character(*), intent(in) :: text
         is_subscript = len(text) > 0 .and. len(text) < 7 .and. verify(text, '0123456789') == 0
      end function is_subscript

   end subroutine open_entry

   !> Adds a complete entry to its record, unless one of its elements was given before; this is an error. An entry without values is
   !> also reported as an error.
   subroutine close_entry(entry, record, deck_errors)
      type(entry_t), intent(inout) :: entry         !! handed over
      type(record_t), intent(inout) :: record
      type(deck_errors_t), intent(inout) :: deck_errors
      integer :: k, before

      if (entry%used == 0) then
         call complain_of(deck_errors, record, entry%line, quoted(entry%key)//' has no value')
      else if (entry%last > 0 .and. entry%used /= entry%last - entry%first + 1) then
         call complain_of(deck_errors, record, entry%line, entry%key//'('//str(entry%first)//':'//str(entry%last)//') needs '// &
            plural(entry%last - entry%first + 1, 'value', 'values')//', found '//str(entry%used))
      end if
      before = 0
      do k = 1, max(entry%used, 1)
         if (before == 0) before = entry_index(record, entry%key, entry%first + k - 1)
      end do
      if (before > 0) then
         call complain_of(deck_errors, record, entry%line, quoted(entry%key)//' is given twice, first in line '// &
            str(record%entries(before)%line))
      else
         call add_entry(record, entry)
      end if
   end subroutine close_entry

   !> Scans one value or comma. Two consecutive commas, or n* alone, define empty values.
   subroutine scan_value(text, cursor, record, entry, after_comma, deck_errors)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor
      type(record_t), intent(in) :: record     !! for messages
      type(entry_t), intent(inout) :: entry
      logical, intent(inout) :: after_comma    !! a comma here would end an empty value
      type(deck_errors_t), intent(inout) :: deck_errors
      character(:), allocatable :: word
      logical :: is_string
      integer :: repeats, star, k, first

      if (text(cursor%at:cursor%at) == ',') then
         if (after_comma) call add_value(entry, '', .false.)
         after_comma = .true.
         cursor%at = cursor%at + 1
         return
      end if
      first = cursor%at
      after_comma = .false.
      repeats = 1
      is_string = scan(text(cursor%at:cursor%at), quotes) > 0
      if (is_string) then
         call take_string(word)
      else
         call take_anything(text, cursor, word)
         star = index(word, '*')
         if (star > 1 .and. verify(word(:max(star, 1) - 1), '0123456789') == 0) then
            repeats = 0
            if (star < 9) read (word(:star - 1), *) repeats
            if (repeats < 1 .or. repeats > max_repeats) then
               call complain(deck_errors, record, cursor%line, 'the repeat count of '//quoted(word)//' must be 1 to '// &
                  str(max_repeats))
               repeats = 1
            end if
            word = word(star + 1:)
            is_string = word == '' .and. scan(next_character(text, cursor), quotes) > 0
            if (is_string) call take_string(word)
         end if
      end if
      do k = 1, repeats
         call add_value(entry, word, is_string)
         if (k > 1) entry%values(entry%used)%before = '*'
      end do
      if (is_tight(first) .and. repeats == 1) entry%values(entry%used)%before = ','

   contains

      !> Whether a value follows a comma, and the comma a value, both without blanks.
      pure logical function is_tight(at)
         integer, intent(in) :: at             !! start of the value
         is_tight = .false.
         if (at > 2) is_tight = text(at - 1:at - 1) == ',' .and. scan(text(at - 2:at - 2), ' ,='//tab//newline//return) == 0
      end function is_tight

      !> Reads a string from its opening to its closing quote, which must be on the same line. A doubled quote is one quote. If the
      !> closing quote is missing, an error is reported, and the content is only the first word.
      subroutine take_string(content)
         character(:), allocatable, intent(out) :: content
         character :: quote
         integer :: k, first, last, length

         quote = text(cursor%at:cursor%at)
         first = cursor%at + 1
         last = first - 2 + scan(text(first:), newline//return)      ! of the line
         if (last < first - 1) last = len(text)
         content = ''
         k = first
         do
            length = index(text(k:last), quote) - 1
            if (length < 0) exit
            content = content//text(k:k + length - 1)
            k = k + length + 1
            if (text(k:min(k, last)) /= quote) then
               cursor%at = k
               return
            end if
            content = content//quote
            k = k + 1
         end do
         call complain(deck_errors, record, cursor%line, 'a string that begins with '//quote// &
            ' is not closed on this line: '//quote//content//text(k:last))
         ! continue after its first word: most strings are names, and the rest of the line is then read as intended
         cursor%at = first - 1 + scan(text(first:last)//' ', ' ,/!'//tab)
         content = text(first:cursor%at - 1)
      end subroutine take_string

   end subroutine scan_value

   !> Reports an error in a group: '&spring: error'.
   subroutine complain_of(deck_errors, record, line, what)
      type(deck_errors_t), intent(inout) :: deck_errors
      type(record_t), intent(in) :: record
      integer, intent(in) :: line
      character(*), intent(in) :: what
      call complain(deck_errors, record, line, '&'//record%group//': '//what)
   end subroutine complain_of

   !> Reports an error at a line of the file that contains a record.
   subroutine complain(deck_errors, record, line, what)
      type(deck_errors_t), intent(inout) :: deck_errors
      type(record_t), intent(in) :: record
      integer, intent(in) :: line
      character(*), intent(in) :: what
      call deck_errors%add(place_in(record%file, record%source, line), what)
   end subroutine complain

end module ek_scanner
