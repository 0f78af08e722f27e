!> A position in a text, with procedures that read from it: blanks, identifiers, subscripts, the rest of a line.
!>
!> Each `take_…` moves the cursor behind the text it returns. Nothing here can fail; the scanner reports mistakes.
module ek_cursor
   implicit none(type, external)
   private
   public :: cursor_t, skip_blanks, key_follows, take_subscript, take_word, take_anything, take_line, is_word_begin, is_quote
   public :: tab, newline, return

   character, parameter :: tab = achar(9), newline = achar(10), return = achar(13)

   !> The position of the scanner.
   type :: cursor_t
      integer :: at = 1, line = 1    !! character and line, from 1
      integer :: source = 1          !! number of the file
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

   !> Whether a key starts here: a word, optionally a subscript, and an = sign.
   pure logical function key_follows(text, cursor)
      character(*), intent(in) :: text
      type(cursor_t), intent(in) :: cursor
      type(cursor_t) :: ahead
      character(:), allocatable :: skipped

      key_follows = .false.
      ahead = cursor
      call take_word(text, ahead, skipped)
      call skip_blanks(text, ahead)
      if (ahead%at > len(text)) return
      if (text(ahead%at:ahead%at) == '(') then
         call take_subscript(text, ahead, skipped)
         call skip_blanks(text, ahead)
         if (ahead%at > len(text)) return
      end if
      key_follows = text(ahead%at:ahead%at) == '='
   end function key_follows

   !> The text between ( and ), blanks removed; the cursor moves behind the ).
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

   !> The letters, digits, _ and % from here on.
   pure subroutine take_word(text, cursor, word)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor
      character(:), allocatable, intent(out) :: word
      integer :: first

      first = cursor%at
      do while (cursor%at <= len(text))
         if (.not. (is_word_begin(text(cursor%at:cursor%at)) .or. &
            index('0123456789%', text(cursor%at:cursor%at)) > 0)) exit
         cursor%at = cursor%at + 1
      end do
      word = text(first:cursor%at - 1)
   end subroutine take_word

   !> The text up to a separator, at least one character.
   pure subroutine take_anything(text, cursor, word)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor
      character(:), allocatable, intent(out) :: word
      integer :: first

      first = cursor%at
      cursor%at = cursor%at + 1
      do while (cursor%at <= len(text))
         if (index(' ,/=!()&''"'//tab//newline//return, text(cursor%at:cursor%at)) > 0) exit
         cursor%at = cursor%at + 1
      end do
      word = text(first:cursor%at - 1)
   end subroutine take_anything

   !> The rest of a line outside any group, up to the next & or comment.
   pure subroutine take_line(text, cursor, content)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor
      character(:), allocatable, intent(out) :: content
      integer, parameter :: most = 40   ! enough to identify the line
      integer :: first

      first = cursor%at
      do while (cursor%at <= len(text))
         if (index('&!'//newline//return, text(cursor%at:cursor%at)) > 0) exit
         cursor%at = cursor%at + 1
      end do
      content = trim(text(first:min(cursor%at - 1, first + most)))
   end subroutine take_line

   !> Whether a name can begin with this character.
   pure logical function is_word_begin(c)
      character, intent(in) :: c
      is_word_begin = (c >= 'a' .and. c <= 'z') .or. (c >= 'A' .and. c <= 'Z') .or. c == '_'
   end function is_word_begin

   !> Whether this character is a quote.
   pure logical function is_quote(c)
      character, intent(in) :: c
      is_quote = c == "'" .or. c == '"'
   end function is_quote

end module ek_cursor
