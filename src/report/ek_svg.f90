!> Adapts a picture drawn by gnuplot as SVG for embedding in a page.
!>
!> Many pictures share one page, so the ids of each get a unique prefix; prolog, document type, scripts, mouse events and
!> fixed sizes are removed; the view box is kept, so that the page determines the width.
module ek_svg
   use ek_letters, only: as_utf8
   use ek_buffer, only: buffer_t
   implicit none(type, external)
   private
   public :: embedded_svg, escape_html

contains

   !> The <svg> element of a file, with ids `<prefix>_…` and a title; '' if the text has none.
   pure function embedded_svg(text, prefix, title) result(svg)
      character(*), intent(in) :: text       !! content of the file
      character(*), intent(in) :: prefix     !! unique in the page: letters and digits
      character(*), intent(in) :: title      !! description of the picture, for screen readers
      character(:), allocatable :: svg
      type(buffer_t) :: out
      character(:), allocatable :: used
      ! first letters of the elements that are left out, and their ends
      character(4), parameter :: omitted(5) = ['<scr', '<tit', '<des', '<fil', '<!--']
      character(9), parameter :: ends(5) = ['</script>', '</title> ', '</desc>  ', '</filter>', '-->      ']
      integer :: at, last, finish, k

      svg = ''
      at = index(text, '<svg')
      finish = index(text, '</svg>', back=.true.)
      if (at == 0 .or. finish < at) return
      last = next_of(text, at, '>') + 1
      ! no xmlns: HTML defines svg and xlink
      call out%add('<svg viewBox="'//attribute(text(at:last - 1), 'viewBox')//'" role="img" aria-label="'//escape_html(title)//'">')
      used = used_symbols(text)
      at = last
      do while (at < finish)
         last = next_of(text, at, '<')
         call add_words(out, text(at:last - 1))
         if (last == finish) exit
         at = last
         k = findloc(omitted, text(at:at + 3), dim=1)
         if (k > 0) then
            at = next_of(text, at, trim(ends(k))) + len_trim(ends(k))
         else
            last = next_of(text, at, '>') + 1
            if (text(at:at + 2) == '<g ' .and. text(last:min(last + 4, len(text))) == achar(10)//'</g>') then
               last = last + 5                           ! gnuplot writes many empty groups
            else if (.not. is_unused(text(at:last - 1), used)) then
               call add_tag(out, text(at:last - 1), prefix)
            end if
            at = last
         end if
      end do
      call out%add('</svg>')
      svg = out%text()
   end function embedded_svg

   !> The ids that a picture refers to, each as '#id '.
   pure function used_symbols(text) result(used)
      character(*), intent(in) :: text
      character(:), allocatable :: used
      integer :: at, last

      used = ''
      at = next_of(text, 1, '#')
      do while (at < len(text))
         last = next_of(text, at, "'")
         if (index(used, text(at:last - 1)//' ') == 0) used = used//text(at:last - 1)//' '
         at = next_of(text, last, '#')
      end do
   end function used_symbols

   !> Whether a tag defines a point symbol that is not used: gnuplot defines all sixteen in every picture.
   pure logical function is_unused(tag, used)
      character(*), intent(in) :: tag, used
      character(:), allocatable :: id

      is_unused = .false.
      if (tag(len(tag) - 1:) /= '/>') return
      if (index(tag(:min(len(tag), 40)), " id='gp") == 0) return
      id = attribute(tag, 'id')
      is_unused = index(used, '#'//id//' ') == 0
   end function is_unused

   !> Text between tags; blank text becomes one line end.
   pure subroutine add_words(out, words)
      type(buffer_t), intent(inout) :: out
      character(*), intent(in) :: words

      if (verify(words, ' '//achar(9)//achar(10)//achar(13)) > 0) then
         call out%add(words)
      else if (index(words, achar(10)) > 0) then
         call out%add(achar(10))
      end if
   end subroutine add_words

   !> A tag with its ids and references to ids renamed, its mouse events dropped.
   pure recursive subroutine add_tag(out, tag, prefix)
      type(buffer_t), intent(inout) :: out
      character(*), intent(in) :: tag, prefix
      character(*), parameter :: defaults = ' stroke-width="1.00" stroke-linecap="butt" stroke-linejoin="miter"'
      integer :: from, at, equals, first, last, renamed

      at = 0
      if (tag(:min(len(tag), 3)) == '<g ') at = index(tag, defaults)
      if (at > 0) then
         call add_tag(out, tag(:at - 1)//tag(at + len(defaults):), prefix)
         return
      end if
      from = 1                                           ! the first character that is not yet written
      at = max(1, index(tag, ' '))
      do
         equals = next_of(tag, at, '=')                  ! name="value"
         first = equals + scan(tag(equals + 1:), '"'//"'")
         if (first <= equals) exit
         last = next_of(tag, first + 1, tag(first:first))
         if (last > len(tag)) exit
         at = at - 1 + verify(tag(at:equals), ' '//achar(9)//achar(10))
         renamed = 0                                     ! the character before the id
         if (tag(at:equals - 1) == 'id') then
            renamed = first
         else if (tag(first + 1:first + 1) == '#' .and. index(tag(at:equals), 'href=') > 0) then
            renamed = first + 1
         else if (tag(first + 1:min(last, first + 5)) == 'url(#') then
            renamed = first + 5
         else if (tag(at:at + 1) == 'on') then           ! onclick="…"
            call out%add(tag(from:at - 2))
            from = last + 1
         else if (tag(max(first, last - 5):last) == ':Bold"') then     ! the form in which gnuplot writes a bold font
            call out%add(tag(from:last - 6)//'" font-weight="600"')
            from = last + 1
         end if
         if (renamed > 0) then
            call out%add(tag(from:renamed)//prefix//'_')
            from = renamed + 1
         end if
         at = last + 1
      end do
      call out%add(tag(from:))
   end subroutine add_tag

   !> The next position of a word, at `at` or behind it; behind the text if there is none.
   pure integer function next_of(text, at, word) result(place)
      character(*), intent(in) :: text, word
      integer, intent(in) :: at

      do place = at, len(text) - len(word) + 1      ! the library's index is several times slower
         if (text(place:place) /= word(1:1)) cycle
         if (text(place:place + len(word) - 1) == word) return
      end do
      place = len(text) + 1
   end function next_of

   !> Value of an attribute, '' if it is missing.
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

   !> A text with &, <, > and quotes escaped, for HTML content and attributes. Bytes that are not UTF-8, as in a file
   !> name, would make the page invalid and are replaced.
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
