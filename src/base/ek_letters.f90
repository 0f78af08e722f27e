!> Characters of strings read from files: encoding, line ends, and invisible characters.
module ek_letters
   implicit none(type, external)
   private
   public :: visible, printable, bad_byte, as_utf8, is_wide, with_line_ends, line_count, save_as_utf8

   !> The message for a file for which is_wide is true.
   character(*), parameter :: save_as_utf8 = &
      "this is not UTF-8 text (it is UTF-16 or not a text file); save it as UTF-8 (in a spreadsheet: 'CSV UTF-8')"

contains

   !> A string in which every invisible character is replaced by its number: `<U+00A0>` for a no-break space, `<U+00AD>` for a soft
   !> hyphen, `<U+200B>` for a zero-width space, `<U+0009>` for a tab. A byte that is not UTF-8 is replaced by its value, as in
   !> `<E4>`. Line feeds and ordinary blanks are unchanged; a carriage return is `<U+000D>`.
   pure function visible(text) result(seen)
      character(*), intent(in) :: text
      character(:), allocatable :: seen
      seen = with_numbers(text, .true.)
   end function visible

   !> A string that is safe on a terminal. Control characters, which could move the cursor or set colours, become numbers such as
   !> `<U+001B>`. Line feeds, tabs and all other bytes are unchanged.
   pure function printable(text) result(shown)
      character(*), intent(in) :: text
      character(:), allocatable :: shown
      shown = with_numbers(text, .false.)
   end function printable

   !> A string in which control characters are replaced by their numbers. With `of_all`, every invisible character and every invalid
   !> byte is replaced.
   pure function with_numbers(text, of_all) result(seen)
      character(*), intent(in) :: text
      logical, intent(in) :: of_all
      character(:), allocatable :: seen
      integer :: k, first, length, code

      seen = ''
      first = 1                    ! first character not yet copied
      k = 1
      do while (k <= len(text))
         code = ichar(text(k:k))
         if (code >= 32 .and. code < 127 .or. text(k:k) == new_line('a')) then
            k = k + 1
            cycle
         end if
         call decode(text, k, code, length)
         if (length == 0 .and. of_all) then
            seen = seen//text(first:k - 1)//'<'//byte_text(ichar(text(k:k)))//'>'
            first = k + 1
         else if (length > 0 .and. is_hidden(code, of_all)) then
            seen = seen//text(first:k - 1)//'<U+'//byte_text(code/256)//byte_text(mod(code, 256))//'>'
            first = k + length
         end if
         k = k + max(length, 1)
      end do
      seen = seen//text(first:)
   end function with_numbers

   !> Position of the first byte that is not valid UTF-8; 0 if there is no such byte.
   pure integer function bad_byte(text) result(k)
      character(*), intent(in) :: text
      integer :: length, code

      k = 1
      do while (k <= len(text))
         length = 1
         if (ichar(text(k:k)) > 127) call decode(text, k, code, length)
         if (length == 0) return
         k = k + length
      end do
      k = 0
   end function bad_byte

   !> A string in which every byte that is not valid UTF-8 is replaced by the replacement character, U+FFFD.
   pure function as_utf8(text) result(sound)
      character(*), intent(in) :: text
      character(:), allocatable :: sound
      integer :: first, bad

      sound = ''
      first = 1
      do
         bad = bad_byte(text(first:))
         if (bad == 0) exit
         sound = sound//text(first:first + bad - 2)//char(239)//char(191)//char(189)
         first = first + bad
      end do
      sound = sound//text(first:)
   end function as_utf8

   !> Whether a string uses two or four bytes per character (UTF-16, UTF-32) or is binary. Such a string begins with the byte order
   !> mark of UTF-16, or contains a zero byte.
   pure logical function is_wide(text)
      character(*), intent(in) :: text

      is_wide = len(text) > 1 .and. &
         (index(text, char(255)//char(254)) == 1 .or. index(text, char(254)//char(255)) == 1 .or. index(text, achar(0)) > 0)
   end function is_wide

   !> A string without a byte order mark and with single-byte line ends: CR LF (Windows) and single CR (old Macs) become a newline.
   pure function with_line_ends(text) result(plain)
      character(*), intent(in) :: text
      character(:), allocatable :: plain
      character, parameter :: return = achar(13), newline = achar(10)
      character(*), parameter :: byte_order_mark = char(239)//char(187)//char(191)
      integer :: first, k, used

      first = 1
      if (index(text(:min(len(byte_order_mark), len(text))), byte_order_mark) == 1) first = len(byte_order_mark) + 1
      do k = first, len(text)                      ! the library's index takes many times longer
         if (text(k:k) == return) exit
      end do
      plain = text(first:)
      if (k > len(text)) return
      used = k - first
      do k = k, len(text)
         if (text(k:k) == newline .and. k > first) then
            if (text(k - 1:k - 1) == return) cycle       ! the newline is already there
         end if
         used = used + 1
         if (text(k:k) == return) plain(used:used) = newline
         if (text(k:k) /= return) plain(used:used) = text(k:k)
      end do
      plain = plain(:used)
   end function with_line_ends

   !> The number of lines of a string. The last line counts even if it is empty.
   pure integer function line_count(text) result(lines)
      character(*), intent(in) :: text
      integer :: k

      lines = 1
      do k = 1, len(text)
         if (text(k:k) == new_line('a')) lines = lines + 1
      end do
   end function line_count

   !> Decodes the character at byte k into its number and its length in bytes. The length is 0 where the bytes are not valid UTF-8.
   pure subroutine decode(text, k, code, length)
      character(*), intent(in) :: text
      integer, intent(in) :: k
      integer, intent(out) :: code, length
      integer, parameter :: least(4) = [0, 128, 2048, 65536]      ! smallest number for each length (longer encodings are invalid)
      integer, parameter :: first(4) = [0, 194, 224, 240], last(4) = [127, 223, 239, 244], mark(4) = [0, 192, 224, 240]
      integer :: j, byte

      code = ichar(text(k:k))
      length = findloc(code >= first .and. code <= last, .true., dim=1)      ! 0: no first byte of a character
      if (length > 1) code = code - mark(length)
      if (k + length - 1 > len(text)) length = 0
      do j = k + 1, k + length - 1
         byte = ichar(text(j:j))
         if (byte < 128 .or. byte > 191) length = 0
         if (length == 0) return
         code = 64*code + byte - 128
      end do
      if (length == 0) return
      if (code < least(length) .or. code > 1114111 .or. (code >= 55296 .and. code < 57344)) length = 0
   end subroutine decode

   !> Whether a character is hidden. Control characters are hidden, except tab and line feed. With `of_all`, tab, other blanks, soft
   !> hyphen, zero-width characters and direction marks are hidden too.
   pure logical function is_hidden(code, of_all)
      integer, intent(in) :: code
      logical, intent(in) :: of_all

      select case (code)
      case (0:8, 11:31, 127:159)
         is_hidden = .true.
      case (9, 160, 173, 847, 1564, 5760, 6155:6158, 8192:8207, 8232:8239, 8287:8303, 12288, 65279)
         is_hidden = of_all
      case default
         is_hidden = .false.
      end select
   end function is_hidden

   !> A byte as two hexadecimal digits.
   pure function byte_text(byte) result(digits)
      integer, intent(in) :: byte
      character(2) :: digits

      write (digits, '(z2.2)') byte
   end function byte_text

end module ek_letters
