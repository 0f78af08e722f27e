!> Adapts a picture drawn by gnuplot as SVG for embedding in a page.
!>
!> Many pictures share one page, so the ids of each picture get a unique prefix. Prolog, document type, scripts, mouse events
!> and fixed sizes are removed. The view box is unchanged, so that the page determines the width.
module ek_svg
   use ek_letters, only: as_utf8
   use ek_buffer, only: buffer_t
   use ek_compact_svg, only: compact_svg, next_of
   implicit none(type, external)
   private
   public :: embedded_svg, escape_html

   ! codes of letters
   integer, parameter :: tab = 9, line_feed = 10, carriage_return = 13, blank = 32, quote = 34, apostrophe = 39, less = 60, &
      equal = 61, greater = 62
   integer, parameter :: max_symbols = 32

   !> The point symbols that a picture defines, and the ids that it refers to.
   type :: symbols_t
      integer :: count = 0
      character(24) :: names(max_symbols) = ''
      integer :: first(max_symbols) = 0, last(max_symbols) = 0    !! first and last character of a definition in the output
      character(:), allocatable :: used      !! ids that are referred to, with a blank before and after each
   contains
      procedure :: define, refer
   end type symbols_t

contains

   !> The <svg> element of a file, with ids `<prefix>_…` and a title; '' if the string contains no such element. The string is read
   !> once, because the pictures of a page have megabytes.
   pure function embedded_svg(text, prefix, title) result(svg)
      character(*), intent(in) :: text       !! content of the file
      character(*), intent(in) :: prefix     !! unique in the page: letters and digits
      character(*), intent(in) :: title      !! description of the picture, for screen readers
      character(:), allocatable :: svg
      type(buffer_t) :: out
      type(symbols_t) :: symbols
      ! first letters of the elements that are left out, and their ends
      character(4), parameter :: omitted(5) = ['<scr', '<tit', '<des', '<fil', '<!--']
      character(9), parameter :: ends(5) = ['</script>', '</title> ', '</desc>  ', '</filter>', '-->      ']
      integer :: at, behind, finish, k

      svg = ''
      at = index(text, '<svg')
      finish = index(text, '</svg>', back=.true.)
      if (at == 0 .or. finish < at) return
      behind = next_of(text, at, '>') + 1
      ! no xmlns: HTML defines svg and xlink
      call out%add('<svg viewBox="'//attribute(text(at:behind - 1), 'viewBox')//'" role="img" aria-label="'// &
         escape_html(title)//'">')
      at = behind
      do while (at < finish)
         call add_words(out, text(:finish - 1), at)
         if (at >= finish) exit
         k = 0
         select case (text(at + 1:at + 1))
         case ('s', 't', 'd', 'f', '!')
            k = findloc(omitted, text(at:at + 3), dim=1)
         end select
         if (k > 0) then
            at = next_of(text, at, trim(ends(k))) + len_trim(ends(k))
         else
            call add_tag(out, symbols, text(:finish - 1), prefix, at)
         end if
      end do
      call out%add('</svg>')
      call take_used(out, symbols, svg)
      svg = compact_svg(svg)
   end function embedded_svg

   !> Adds the string up to the next tag, which begins at the new `at`. A blank string becomes one line end, or nothing if it
   !> has no line end.
   pure subroutine add_words(out, text, at)
      type(buffer_t), intent(inout) :: out
      character(*), intent(in) :: text
      integer, intent(inout) :: at           !! position at which the string begins
      logical :: is_blank, has_end
      integer :: first

      is_blank = .true.
      has_end = .false.
      first = at
      do at = first, len(text)
         select case (iachar(text(at:at)))
         case (less)
            exit
         case (line_feed)
            has_end = .true.
         case (blank, tab, carriage_return)
         case default
            is_blank = .false.
         end select
      end do
      if (.not. is_blank) then
         call out%add(text(first:at - 1))
      else if (has_end) then
         call out%add(achar(line_feed))
      end if
   end subroutine add_words

   !> Adds a tag, and moves `at` to the position after the tag. Ids and references to ids are renamed; mouse events and
   !> gnuplot's default style are omitted; a bold font becomes font-weight. An empty group, of which gnuplot writes many, is
   !> omitted with its end.
   pure subroutine add_tag(out, symbols, text, prefix, at)
      type(buffer_t), intent(inout) :: out
      type(symbols_t), intent(inout) :: symbols
      character(*), intent(in) :: text, prefix
      integer, intent(inout) :: at           !! position at which the tag begins
      character(*), parameter :: empty = achar(line_feed)//'</g>', &
         defaults = ' stroke-width="1.00" stroke-linecap="butt" stroke-linejoin="miter"'
      integer :: begin, from, name, first, last, renamed, id(2), code
      logical :: is_group

      begin = out%length()
      is_group = .false.
      if (at + 1 < len(text)) is_group = text(at + 1:at + 1) == 'g' .and. text(at + 2:at + 2) == ' '
      from = at                              ! the first character that is not yet written
      name = at + 1                          ! where the name of an attribute begins
      id = 0                                 ! first and last letter
      do while (at < len(text))
         at = at + 1
         code = iachar(text(at:at))
         if (code > greater) cycle           ! most are the letters of a name
         select case (code)
         case (greater)
            exit
         case (blank, tab, line_feed)
            name = at + 1
            if (.not. is_group .or. text(min(name, len(text)):min(name, len(text))) /= 's') cycle
            if (text(at:min(at + len(defaults) - 1, len(text))) /= defaults) cycle
            call out%add(text(from:at - 1))
            from = at + len(defaults)
            at = from - 1
         case (equal)                        ! name="value"
            first = at + 1
            if (first > len(text)) exit
            code = iachar(text(first:first))
            if (code /= quote .and. code /= apostrophe) cycle
            do last = first + 1, len(text)
               if (iachar(text(last:last)) == code) exit
            end do
            if (last > len(text)) then
               at = len(text)
               exit
            end if
            if (is_plain(text(name:last), first - name + 1)) then
               at = last
               cycle
            end if
            renamed = 0                      ! the character before the id
            if (text(name:at - 1) == 'id') then
               renamed = first
               id = [first + 1, last - 1]
            else if (text(first + 1:first + 1) == '#' .and. text(max(name, at - 4):at) == 'href=') then
               renamed = first + 1
               call symbols%refer(text(first + 2:last - 1))
            else if (text(first + 1:min(last, first + 5)) == 'url(#') then
               renamed = first + 5
            else if (text(name:name + 1) == 'on') then             ! onclick="…"
               call out%add(text(from:name - 2))
               from = last + 1
            else if (text(max(first, last - 5):last) == ':Bold"') then     ! the form in which gnuplot writes a bold font
               call out%add(text(from:last - 6)//'" font-weight="600"')
               from = last + 1
            end if
            if (renamed > 0) then
               call out%add(text(from:renamed)//prefix//'_')
               from = renamed + 1
            end if
            at = last
         end select
      end do
      call out%add(text(from:at))
      at = at + 1
      if (is_group .and. text(at:min(at + len(empty) - 1, len(text))) == empty) then
         call out%clear(behind=begin)
         at = at + len(empty)
      else if (id(1) > 0) then
         if (text(at - 2:at - 2) == '/') call symbols%define(text(id(1):id(2)), begin + 1, out%length())
      end if
   end subroutine add_tag

   !> Whether single letters of an attribute name="value" show that it can be copied unchanged, as most attributes can. All
   !> other attributes are examined in full.
   pure logical function is_plain(attribute, value)
      character(*), intent(in) :: attribute
      integer, intent(in) :: value           !! position of the first quote
      integer :: last

      last = max(1, len(attribute) - 1)
      is_plain = attribute(1:1) /= 'i' .and. attribute(1:1) /= 'o' .and. attribute(value + 1:value + 1) /= '#' .and. &
         attribute(value + 1:value + 1) /= 'u' .and. attribute(last:last) /= 'd'
   end function is_plain

   !> Records where a point symbol (an id that begins with 'gp') is defined. Other ids are skipped.
   pure subroutine define(self, name, first, last)
      class(symbols_t), intent(inout) :: self
      character(*), intent(in) :: name
      integer, intent(in) :: first, last     !! first and last character in the output

      if (index(name, 'gp') /= 1 .or. len(name) > len(self%names) .or. self%count == max_symbols) return
      self%count = self%count + 1
      self%names(self%count) = name
      self%first(self%count) = first
      self%last(self%count) = last
   end subroutine define

   !> Records that an id is referred to.
   pure subroutine refer(self, name)
      class(symbols_t), intent(inout) :: self
      character(*), intent(in) :: name

      if (.not. allocated(self%used)) self%used = ' '
      if (index(self%used, ' '//name//' ') == 0) self%used = self%used//name//' '
   end subroutine refer

   !> Copies a picture without unused point symbols. gnuplot defines all sixteen symbols in every picture.
   pure subroutine take_used(out, symbols, svg)
      type(buffer_t), intent(in) :: out
      type(symbols_t), intent(in) :: symbols
      character(:), allocatable, intent(out) :: svg
      logical :: is_used(symbols%count)
      integer :: k, from, used, length

      is_used = .false.
      do k = 1, symbols%count
         if (allocated(symbols%used)) is_used(k) = index(symbols%used, ' '//trim(symbols%names(k))//' ') > 0
      end do
      associate (first => symbols%first(:symbols%count), last => symbols%last(:symbols%count))
         allocate (character(out%length() - sum(last - first + 1, mask=.not. is_used)) :: svg)
      end associate
      from = 1
      used = 0
      do k = 1, symbols%count
         if (is_used(k)) cycle
         length = symbols%first(k) - from
         call out%copy(from, svg(used + 1:used + length))
         used = used + length
         from = symbols%last(k) + 1
      end do
      call out%copy(from, svg(used + 1:))
   end subroutine take_used

   !> Value of an attribute; '' if the attribute is missing.
   pure function attribute(tag, name) result(value)
      character(*), intent(in) :: tag, name
      character(:), allocatable :: value
      integer :: at, last

      value = ''
      at = index(tag, ' '//name//'=')
      if (at == 0) return
      at = at + len(name) + 2
      last = index(tag(at + 1:), tag(at:at))
      if (last > 0) value = tag(at + 1:at + last - 1)
   end function attribute

   !> A string with &, <, > and quotes escaped, for HTML content and attributes. Bytes that are not UTF-8, as in a file name, would
   !> make the page invalid and are replaced.
   pure function escape_html(words) result(escaped)
      character(*), intent(in) :: words
      character(:), allocatable :: escaped
      character(:), allocatable :: text
      type(buffer_t) :: out
      character(*), parameter :: special = '&<>"'//"'"
      character(*), parameter :: entities(5) = [character(6) :: '&amp;', '&lt;', '&gt;', '&quot;', '&#39;']
      integer :: k, n

      text = as_utf8(words)
      escaped = text
      if (scan(text, special) == 0) return
      do k = 1, len(text)
         n = index(special, text(k:k))
         if (n > 0) call out%add(trim(entities(n)))
         if (n == 0) call out%add(text(k:k))
      end do
      escaped = out%text()
   end function escape_html

end module ek_svg
