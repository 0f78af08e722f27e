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
      character(:), allocatable :: box
      character(*), parameter :: omitted(5) = [character(7) :: '<script', '<title', '<desc', '<filter', '<!--']
      character(*), parameter :: ends(5) = [character(9) :: '</script>', '</title>', '</desc>', '</filter>', '-->']
      integer :: at, last, finish, head, k

      svg = ''
      at = index(text, '<svg')
      finish = index(text, '</svg>', back=.true.)
      if (at == 0 .or. finish < at) return
      head = at + index(text(at:), '>') - 1
      box = attribute(text(at:head), 'viewBox')
      if (len(box) == 0) box = '0 0 '//number_of(attribute(text(at:head), 'width'))//' '// &
         number_of(attribute(text(at:head), 'height'))
      ! no xmlns: HTML defines svg and xlink
      call out%add('<svg viewBox="'//box//'" role="img" aria-label="'//escape_html(title)//'">')
      at = head + 1
      do while (at < finish)
         last = index(text(at:finish - 1), '<')
         if (last == 0) then
            call out%add(text(at:finish - 1))
            exit
         end if
         call add_words(out, text(at:at + last - 2))
         at = at + last - 1
         do k = 1, size(omitted)
            if (begins(text, at, trim(omitted(k)))) exit
         end do
         if (k <= size(omitted)) then
            at = past(text, at, trim(ends(k)))
         else
            last = past(text, at, '>') - 1
            if (begins(text, at, '<g ')) then            ! gnuplot writes many empty groups
               if (begins(text, last + 2, '</g>') .and. text(last + 1:last + 1) == achar(10)) then
                  at = last + 6
                  cycle
               end if
            end if
            if (.not. is_unused(text, text(at:last))) call add_tag(out, text(at:last), prefix)
            at = last + 1
         end if
      end do
      call out%add('</svg>')
      svg = out%text()
   end function embedded_svg

   !> Whether a point symbol is unused: gnuplot defines all sixteen in every picture.
   pure logical function is_unused(text, tag)
      character(*), intent(in) :: text, tag
      character(:), allocatable :: id

      is_unused = .false.
      if (index(tag, 'gpPt') + index(tag, 'gpDot') == 0 .or. tag(max(1, len(tag) - 1):) /= '/>') return
      id = attribute(tag, 'id')
      if (len(id) > 0) is_unused = index(text, '#'//id//"'") == 0
   end function is_unused

   !> Text between tags; blank text becomes one line end.
   pure subroutine add_words(out, words)
      type(buffer_t), intent(inout) :: out
      character(*), intent(in) :: words

      if (verify(words, ' '//achar(9)//achar(10)//achar(13)) == 0) then
         if (index(words, achar(10)) > 0) call out%add(achar(10))
      else
         call out%add(words)
      end if
   end subroutine add_words

   !> A tag with its ids and references to ids renamed, its mouse events dropped.
   pure recursive subroutine add_tag(out, tag, prefix)
      type(buffer_t), intent(inout) :: out
      character(*), intent(in) :: tag, prefix
      character(*), parameter :: defaults = ' stroke-width="1.00" stroke-linecap="butt" stroke-linejoin="miter"'
      character(*), parameter :: ids(5) = [character(7) :: " id='", ' id="', "href='#", 'href="#', 'url(#']
      integer :: at, last, k

      if (begins(tag, 1, '<g ') .and. index(tag, defaults) > 0) then
         at = index(tag, defaults)
         call add_tag(out, tag(:at - 1)//tag(at + len(defaults):), prefix)
         return
      end if
      if (index(tag, 'id=') + index(tag, 'href=') + index(tag, 'url(#') + index(tag, ' on') + index(tag, ':Bold') == 0) then
         call out%add(tag)                ! most of a picture: long paths
         return
      end if
      at = 1
      do while (at <= len(tag))
         if (begins(tag, at, ' on') .and. at < len(tag) - 6) then      ! onclick="…", onmousemove='…'
            last = index(tag(at:), '=')
            if (last > 0) then
               last = at + last
               last = last + index(tag(last + 1:), tag(last:last))
               if (last > at) then
                  at = last + 1
                  cycle
               end if
            end if
         end if
         do k = 1, size(ids)
            if (begins(tag, at, trim(ids(k)))) exit
         end do
         if (k <= size(ids)) then
            call out%add(trim(ids(k))//prefix//'_')
            at = at + len_trim(ids(k))
         else if (begins(tag, at, ':Bold"')) then          ! the form in which gnuplot writes a bold font
            call out%add('" font-weight="600"')
            at = at + 6
         else
            call out%add(tag(at:at))
            at = at + 1
         end if
      end do
   end subroutine add_tag

   !> Whether a word begins at a position of a text.
   pure logical function begins(text, at, word)
      character(*), intent(in) :: text, word
      integer, intent(in) :: at

      begins = .false.
      if (at + len(word) - 1 <= len(text)) begins = text(at:at + len(word) - 1) == word
   end function begins

   !> The position behind the next `word`, or behind the text.
   pure integer function past(text, at, word)
      character(*), intent(in) :: text, word
      integer, intent(in) :: at

      past = index(text(at:), word)
      if (past == 0) then
         past = len(text) + 1
      else
         past = at + past - 1 + len(word)
      end if
   end function past

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

   !> The leading digits of a text such as '460px'.
   pure function number_of(text) result(digits)
      character(*), intent(in) :: text
      character(verify(text//' ', '0123456789.') - 1) :: digits

      digits = text
   end function number_of

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
