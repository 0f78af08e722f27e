!> Strings and pictures in HTML.
module ek_html
   use ek_letters, only: as_utf8
   use ek_buffer, only: buffer_t
   implicit none(type, external)
   private
   public :: escape_html, svg_address

contains

   !> A picture drawn as SVG as an address for an <img> element, which then contains the picture. Characters that end an attribute
   !> or have a meaning in addresses are written as numbers, and line ends as blanks.
   pure function svg_address(svg) result(address)
      character(*), intent(in) :: svg            !! content of the file
      character(:), allocatable :: address
      type(buffer_t) :: out
      integer :: k, first

      call out%add('data:image/svg+xml,')
      first = 1                                  ! the first character that is not yet copied
      do k = 1, len(svg)
         if (index('<>#%"'//achar(10)//achar(13)//achar(9), svg(k:k)) == 0) cycle
         call out%add(svg(first:k - 1))
         first = k + 1
         select case (svg(k:k))
         case ('<')
            call out%add('%3C')
         case ('>')
            call out%add('%3E')
         case ('#')
            call out%add('%23')
         case ('%')
            call out%add('%25')
         case ('"')
            call out%add('%22')
         case default
            call out%add(' ')
         end select
      end do
      call out%add(svg(first:))
      address = out%text()
   end function svg_address

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

end module ek_html
