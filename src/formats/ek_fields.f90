!> Lines of a file, and the fields of a line: entries separated by blanks, tabs or commas, and strings in quotes.
module ek_fields
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: lower
   use ek_letters, only: is_wide, with_line_ends, line_count, save_as_utf8
   use ek_decimal, only: get_decimal
   use ek_flaws, only: flaws_t, shown
   implicit none(type, external)
   private
   public :: lines_t, split_lines, field_t, split_fields, take_number, legal_name

   character, parameter :: tab = achar(9)
   real(wp), parameter :: most = 1.0e25_wp          !! larger numbers are errors; smaller numbers are legal in a deck in any unit
   integer, parameter :: max_fields = 64            !! most fields of a line; no format has more

   !> The content of a file with the positions of its lines.
   type :: lines_t
      character(:), allocatable :: text
      integer :: count = 0
      integer, allocatable :: first(:), last(:)
   contains
      procedure :: line => lines_line
   end type lines_t

   !> A word of a line, or a string without its quotes.
   type :: field_t
      character(:), allocatable :: text
      logical :: is_quoted = .false.
   end type field_t

contains

   !> Splits the content of a file into lines, with the line ends of any system. Reports a file that is empty or not a text file.
   subroutine split_lines(text, lines, flaws)
      character(*), intent(in) :: text
      type(lines_t), intent(out) :: lines
      type(flaws_t), intent(inout) :: flaws
      integer :: at, length, rows

      lines%text = ''
      allocate (lines%first(0), lines%last(0))
      if (index(text, 'PK'//achar(3)//achar(4)) == 1) then
         call flaws%add(0, 'expected text, found a workbook or an archive; save the sheet as CSV')
         return
      else if (is_wide(text)) then
         call flaws%add(0, save_as_utf8)
         return
      else if (verify(text, ' '//tab//achar(10)//achar(13)) == 0) then
         call flaws%add(0, 'the file is empty')
         return
      end if
      lines%text = with_line_ends(text)
      rows = line_count(lines%text)
      deallocate (lines%first, lines%last)
      allocate (lines%first(rows), lines%last(rows))
      at = 1
      do while (at <= len(lines%text))
         length = index(lines%text(at:), new_line('a')) - 1
         if (length < 0) length = len(lines%text) - at + 1
         lines%count = lines%count + 1
         lines%first(lines%count) = at
         lines%last(lines%count) = at + length - 1
         at = at + length + 1
      end do
   end subroutine split_lines

   !> Line k of the file, without its line end.
   pure function lines_line(self, k) result(text)
      class(lines_t), intent(in) :: self
      integer, intent(in) :: k
      character(:), allocatable :: text
      text = self%text(self%first(k):self%last(k))
   end function lines_line

   !> Splits a line into fields. A quote that is not closed is reported, and its string ends with the line. More than 64 fields are
   !> reported, and only the first 64 are returned.
   subroutine split_fields(text, line, fields, used, flaws, commas_separate)
      character(*), intent(in) :: text
      integer, intent(in) :: line
      type(field_t), intent(inout) :: fields(:)     !! of size 64 (max_fields)
      integer, intent(out) :: used
      type(flaws_t), intent(inout) :: flaws
      logical, intent(in), optional :: commas_separate   !! default .true.
      character(:), allocatable :: separators
      integer :: at, last

      separators = ' '//tab//','
      if (present(commas_separate)) then
         if (.not. commas_separate) separators = ' '//tab
      end if
      used = 0
      at = 1
      do while (at <= len(text))
         if (index(separators, text(at:at)) > 0) then
            at = at + 1
            cycle
         end if
         if (used == min(max_fields, size(fields))) then
            call flaws%add(line, 'expected at most 64 values in a line, found more')
            return
         end if
         used = used + 1
         fields(used)%is_quoted = index('''"', text(at:at)) > 0
         if (fields(used)%is_quoted) then
            last = index(text(at + 1:), text(at:at))
            if (last == 0) then
               call flaws%add(line, 'expected a closing '//text(at:at)//', found '//shown(text(at:)))
               last = len(text) - at + 1
            end if
            fields(used)%text = text(at + 1:at + last - 1)
            at = at + last + 1
         else
            last = scan(text(at:), separators)
            if (last == 0) last = len(text) - at + 2
            fields(used)%text = text(at:at + last - 2)
            at = at + last
         end if
      end do
   end subroutine split_fields

   !> Reads the number in a string. Reports a string that is not a number, and a number that is not finite or is too large.
   subroutine take_number(text, line, what, value, flaws, is_good)
      character(*), intent(in) :: text, what      !! what: 'x of hardpoint', for the message
      integer, intent(in) :: line
      real(wp), intent(out) :: value              !! 0 if an error is reported
      type(flaws_t), intent(inout) :: flaws
      logical, intent(out) :: is_good

      call get_decimal(text, value, is_good)
      if (is_good) is_good = ieee_is_finite(value)
      if (is_good) is_good = abs(value) < most
      if (is_good) return
      value = 0.0_wp
      if (len_trim(text) == 0) then
         call flaws%add(line, 'expected a number for '//what//', found nothing')
      else if (index(text, ',') > 0) then
         call flaws%add(line, 'expected a number for '//what//', found '//shown(text)//' (write a decimal point)')
      else
         call flaws%add(line, 'expected a finite number for '//what//', found '//shown(text))
      end if
   end subroutine take_number

   !> A name of the file converted to a legal name of a deck: letters, digits and _, with a letter first. A longer name is cut after
   !> 50 characters; a name that begins with a digit or _ then gets a p in front. A blank name becomes 'unnamed'.
   pure function legal_name(text) result(name)
      character(*), intent(in) :: text
      character(:), allocatable :: name
      integer, parameter :: longest = 50      ! with left_, right_ or the name of a component it is still a name
      character(*), parameter :: fixed_body(2) = ['chassis', 'ground ']      ! no other part of a deck may have these names
      integer :: k

      name = trim(adjustl(text))
      if (len(name) > longest) name = name(:longest)
      do k = 1, len(name)
         if (verify(name(k:k), 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789') > 0) name(k:k) = '_'
      end do
      if (len(name) == 0) name = 'unnamed'
      if (verify(name(1:1), '0123456789_') == 0 .or. any(lower(name) == fixed_body)) name = 'p'//name
   end function legal_name

end module ek_fields
