!> A position in a string, with procedures that read blanks, identifiers, subscripts and the rest of a line from this position. They
!> also recognise two typing errors between keys: a missing = sign, and a unit after a number.
!>
!> Each `take_…` procedure moves the cursor to the first character after the characters that it reads. No procedure here can fail;
!> the scanner reports errors.
module ek_cursor
   use ek_text, only: lower
   use ek_record, only: entry_t
   use ek_group, only: group_number, key_t, find_key
   implicit none(type, external)
   private
   public :: cursor_t, skip_blanks, next_character, key_follows, lacks_equals, take_subscript, take_word, take_anything, take_line
   public :: drop_unit, unit_message, is_word_begin, quotes, tab, newline, return

   character(*), parameter :: quotes = '''"'
   character, parameter :: tab = achar(9), newline = achar(10), return = achar(13)
   character(*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_', digits = '0123456789'
   character(*), parameter :: units(19) = [character(7) :: 'n', 'kn', 'mm', 'cm', 'm', 'nm', 'knm', 'nmm', 'deg', 'degree', &
      'degrees', 'grad', 'rad', 'kg', 'g', 's', 'ms', 'per', '%']
   character(*), parameter :: degree_sign = char(194)//char(176)

   !> The position of the scanner.
   type :: cursor_t
      integer :: at = 1, line = 1    !! index of the character in the string, and line number, from 1
   end type cursor_t

contains

   !> Skips blanks, line ends and comments, counting lines.
   pure subroutine skip_blanks(text, cursor)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor

      do while (cursor%at <= len(text))
         select case (text(cursor%at:cursor%at))
         case (newline)
            cursor%line = cursor%line + 1
         case (' ', tab, return)
            continue
         case ('!')
            do while (cursor%at < len(text))
               if (text(cursor%at + 1:cursor%at + 1) == newline) exit
               cursor%at = cursor%at + 1
            end do
         case default
            return
         end select
         cursor%at = cursor%at + 1
      end do
   end subroutine skip_blanks

   !> The character at the cursor; a blank at the end of the string.
   pure character function next_character(text, cursor)
      character(*), intent(in) :: text
      type(cursor_t), intent(in) :: cursor
      next_character = ' '
      if (cursor%at <= len(text)) next_character = text(cursor%at:cursor%at)
   end function next_character

   !> Whether a key starts at the cursor: a word, optionally a subscript, and an = sign.
   pure logical function key_follows(text, cursor)
      character(*), intent(in) :: text
      type(cursor_t), intent(in) :: cursor
      character(:), allocatable :: word
      character :: next

      call look_past_key(text, cursor, word, next)
      key_follows = next == '='
   end function key_follows

   !> Whether a key of a group starts at the cursor but is followed by a colon or a value instead of an = sign.
   pure logical function lacks_equals(text, cursor, group)
      character(*), intent(in) :: text, group
      type(cursor_t), intent(in) :: cursor
      type(key_t) :: key
      character(:), allocatable :: word
      character :: next

      call look_past_key(text, cursor, word, next)
      call find_key(group_number(group), lower(word), key, lacks_equals)
      lacks_equals = lacks_equals .and. index(':+-.0123456789''"', next) > 0
   end function lacks_equals

   !> Reads the word at the cursor without moving the cursor, and the character after the word and its subscript. The character is a
   !> blank at the end of the string.
   pure subroutine look_past_key(text, cursor, word, next)
      character(*), intent(in) :: text
      type(cursor_t), intent(in) :: cursor
      character(:), allocatable, intent(out) :: word
      character, intent(out) :: next
      type(cursor_t) :: ahead
      character(:), allocatable :: skipped

      ahead = cursor
      call take_word(text, ahead, word)
      call skip_blanks(text, ahead)
      next = next_character(text, ahead)
      if (next /= '(') return
      call take_subscript(text, ahead, skipped)
      call skip_blanks(text, ahead)
      next = next_character(text, ahead)
   end subroutine look_past_key

   !> Reads the string between ( and ) without its blanks, and moves the cursor after the ). If a line end, = or / comes before the
   !> ), reading stops there.
   pure subroutine take_subscript(text, cursor, content)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor
      character(:), allocatable, intent(out) :: content
      character :: c

      content = ''
      do
         cursor%at = cursor%at + 1
         if (cursor%at > len(text)) return
         c = text(cursor%at:cursor%at)
         if (c == ')') exit
         if (c == newline .or. c == '=' .or. c == '/') return
         if (c /= ' ' .and. c /= tab) content = content//c
      end do
      cursor%at = cursor%at + 1
   end subroutine take_subscript

   !> Reads the letters, digits, _ and % from the cursor on.
   pure subroutine take_word(text, cursor, word)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor
      character(:), allocatable, intent(out) :: word
      call take(text, cursor, verify(text(cursor%at:), letters//digits//'%') - 1, word)
   end subroutine take_word

   !> Reads the string up to a separator, at least one character.
   pure subroutine take_anything(text, cursor, word)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor
      character(:), allocatable, intent(out) :: word
      integer :: more

      more = scan(text(cursor%at + 1:), ' ,/=!()&''"'//tab//newline//return)
      call take(text, cursor, merge(more, -1, more > 0), word)
   end subroutine take_anything

   !> Reads the rest of a line outside any group, up to the next & or comment. Only the beginning is returned, which is enough to
   !> identify the line.
   pure subroutine take_line(text, cursor, content)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor
      character(:), allocatable, intent(out) :: content

      call take(text, cursor, scan(text(cursor%at:), '&!'//newline//return) - 1, content)
      content = trim(content(:min(len(content), 41)))
   end subroutine take_line

   !> Reads the next `count` characters; with −1, all remaining characters.
   pure subroutine take(text, cursor, count, taken)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor
      integer, intent(in) :: count
      character(:), allocatable, intent(out) :: taken
      integer :: last

      last = cursor%at + count - 1
      if (count < 0) last = len(text)
      taken = text(cursor%at:last)
      cursor%at = last + 1
   end subroutine take

   !> Whether a name can begin with a character.
   pure logical function is_word_begin(c)
      character, intent(in) :: c
      select case (c)
      case ('a':'z', 'A':'Z', '_')
         is_word_begin = .true.
      case default
         is_word_begin = .false.
      end select
   end function is_word_begin

   !> Reads the unit after the last value of an entry, as in `30.0 N/mm` and `30.0N/mm`. `unit` is '' if there is no unit.
   pure subroutine drop_unit(text, cursor, entry, unit)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor          !! in: after the value; out: after the unit
      type(entry_t), intent(inout) :: entry            !! a unit attached to its last value is removed
      character(:), allocatable, intent(out) :: unit
      type(cursor_t) :: ahead
      character(:), allocatable :: value, more
      integer :: last, blanks
      logical :: is_attached

      unit = ''
      if (entry%used == 0) return
      if (entry%values(entry%used)%is_string) return
      value = entry%values(entry%used)%text
      last = verify(value, '+-.'//digits) - 1
      if (last < 0) last = len(value)
      if (scan(value(:last), digits) == 0) return
      is_attached = .false.
      if (last < len(value)) is_attached = is_unit(value(last + 1:))
      if (is_attached) then
         unit = value(last + 1:)
         entry%values(entry%used)%text = value(:last)
         call take_quotient(text, cursor, unit)
      else if (verify(value, '+-.eEdD'//digits) > 0) then
         return
      end if
      do
         ahead = cursor
         blanks = verify(text(ahead%at:), ' '//tab) - 1
         if (blanks < 0) return
         ahead%at = ahead%at + blanks
         if (.not. (is_word_begin(text(ahead%at:ahead%at)) .or. index('%'//degree_sign(:1), text(ahead%at:ahead%at)) > 0)) return
         if (key_follows(text, ahead)) return
         call take_unit_word(text, ahead, more)
         if (.not. is_unit(more)) return
         call take_quotient(text, ahead, more)
         cursor = ahead
         unit = trim(adjustl(unit//' '//more))
      end do
   end subroutine drop_unit

   !> The error message on a unit after a number.
   pure function unit_message(entry, unit) result(words)
      type(entry_t), intent(in) :: entry
      character(*), intent(in) :: unit
      character(:), allocatable :: words
      words = entry%key//": found the unit '"//unit//"' after "//entry%values(entry%used)%text// &
         '; write the number alone (&model sets the units)'
   end function unit_message

   !> Reads a word, the degree sign or % at the cursor; `word` is '' if another character is at the cursor.
   pure subroutine take_unit_word(text, cursor, word)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor
      character(:), allocatable, intent(out) :: word

      word = text(cursor%at:min(cursor%at + 1, len(text)))
      if (word == degree_sign) then
         cursor%at = cursor%at + len(degree_sign)
      else if (next_character(text, cursor) == '%') then
         word = '%'
         cursor%at = cursor%at + 1
      else if (is_word_begin(next_character(text, cursor))) then
         call take_word(text, cursor, word)
      else
         word = ''
      end if
   end subroutine take_unit_word

   !> Appends the parts /mm, *mm and ^2 that follow a unit to the unit. A / that is not followed by a letter, % or the degree sign
   !> is not read, because it ends the group.
   pure subroutine take_quotient(text, cursor, unit)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor
      character(:), allocatable, intent(inout) :: unit
      character(:), allocatable :: word
      type(cursor_t) :: ahead

      do while (cursor%at < len(text))
         if (index('/*^', text(cursor%at:cursor%at)) == 0) return
         ahead = cursor
         ahead%at = ahead%at + 1
         if (text(cursor%at:cursor%at) == '^') then
            word = text(ahead%at:ahead%at)
            ahead%at = ahead%at + 1
         else
            call take_unit_word(text, ahead, word)
         end if
         if (word == '') return
         unit = unit//text(cursor%at:cursor%at)//word
         cursor = ahead
      end do
   end subroutine take_quotient

   !> Whether a word is a unit, or a unit followed by * or ^ and further characters.
   pure logical function is_unit(word)
      character(*), intent(in) :: word
      integer :: mark

      mark = scan(word//'*', '*^')
      is_unit = any(units == lower(word(:mark - 1))) .or. word == degree_sign
   end function is_unit

end module ek_cursor
