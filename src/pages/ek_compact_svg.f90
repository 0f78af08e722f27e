!> Shortens an SVG picture drawn by gnuplot. gnuplot writes thousands of empty groups, many blanks around polygons, coordinates to a
!> hundredth of a pixel, and colours as three numbers.
module ek_compact_svg
   implicit none(type, external)
   private
   public :: compact_svg, next_of

   integer, parameter :: line_feed = 10

contains

   !> A picture without empty groups and meaningless blanks, with short coordinates and colours. The string between two changes is
   !> copied as one piece, because pictures have megabytes.
   pure function compact_svg(svg) result(short)
      character(*), intent(in) :: svg
      character(:), allocatable :: short
      integer :: at, from, used, here

      allocate (character(len(svg)) :: short)
      used = 0
      from = 1                                   ! the first letter that is not copied yet
      at = 1
      do while (at <= len(svg))
         here = at
         select case (svg(at:at))
         case ('<')
            call skip_empty_group(svg, at)
            if (at > here) call copy(svg(from:here - 1), short, used)
         case (' ')
            if (starts(svg, at, " = '")) then
               call copy(svg(from:at - 1), short, used)
               call copy("='", short, used)
               at = at + 4
            else if (starts(svg, at, " '/>")) then
               call copy(svg(from:at - 1), short, used)
               call copy("'/>", short, used)
               at = at + 4
            else if (starts(svg, at, " d='")) then
               at = at + 4
               call copy(svg(from:at - 1), short, used)
               call copy_coordinates(svg, at, short, used)
            end if
         case ('p')
            if (starts(svg, at, "points = '")) then
               call copy(svg(from:at - 1), short, used)
               call copy("points='", short, used)
               at = at + 10
               call copy_coordinates(svg, at, short, used)
            end if
         case ('r')
            if (starts(svg, at, 'rgb(')) then
               call copy(svg(from:at - 1), short, used)
               call copy_colour(svg, at, short, used)
            end if
         end select
         if (at > here) from = at
         if (at == here) at = at + 1
      end do
      call copy(svg(from:), short, used)
      short = short(:used)
   end function compact_svg

   !> Whether a picture has the string `word` at the position `at`.
   pure logical function starts(svg, at, word)
      character(*), intent(in) :: svg, word
      integer, intent(in) :: at

      starts = .false.
      if (at + len(word) - 1 <= len(svg)) starts = svg(at:at + len(word) - 1) == word
   end function starts

   !> Appends a string to the first `used` characters of another string.
   pure subroutine copy(text, to, used)
      character(*), intent(in) :: text
      character(*), intent(inout) :: to
      integer, intent(inout) :: used

      to(used + 1:used + len(text)) = text
      used = used + len(text)
   end subroutine copy

   !> Appends coordinates up to the next apostrophe, or up to the blank before it. Digits after the first decimal, a tenth of
   !> a pixel, are omitted.
   pure subroutine copy_coordinates(svg, at, to, used)
      character(*), intent(in) :: svg
      integer, intent(inout) :: at, used
      character(*), intent(inout) :: to
      integer :: digits                          ! since the point; -1: there was none

      digits = -1
      do at = at, len(svg)
         select case (svg(at:at))
         case ('0':'9')
            if (digits >= 0) digits = digits + 1
            if (digits > 1) cycle
         case ('.')
            digits = 0
         case ("'")
            return
         case (' ')
            if (svg(at:min(at + 1, len(svg))) == " '") return
            digits = -1
         case default
            digits = -1
         end select
         used = used + 1
         to(used:used) = svg(at:at)
      end do
   end subroutine copy_coordinates

   !> Appends a colour rgb(1, 2, 3) as #010203; leaves a colour of another form unchanged.
   pure subroutine copy_colour(svg, at, to, used)
      character(*), intent(in) :: svg
      integer, intent(inout) :: at, used
      character(*), intent(inout) :: to
      character(*), parameter :: digits = '0123456789abcdef'
      character(7) :: colour
      integer :: parts(3), part, k

      part = 1
      parts = 0
      do k = at + 4, len(svg)
         select case (svg(k:k))
         case ('0':'9')
            parts(part) = min(1000, 10*parts(part) + index(digits, svg(k:k)) - 1)
         case (',')
            part = part + 1
         case (' ')
            continue
         case default
            exit
         end select
         if (part > 3) exit
      end do
      if (k > len(svg) .or. part /= 3 .or. any(parts > 255)) then
         call copy('rgb(', to, used)
         at = at + 4
         return
      end if
      if (svg(k:k) /= ')') then
         call copy('rgb(', to, used)
         at = at + 4
         return
      end if
      colour(1:1) = '#'
      do part = 1, 3
         colour(2*part:2*part) = digits(parts(part)/16 + 1:parts(part)/16 + 1)
         colour(2*part + 1:2*part + 1) = digits(mod(parts(part), 16) + 1:mod(parts(part), 16) + 1)
      end do
      call copy(colour, to, used)
      at = k + 1
   end subroutine copy_colour

   !> Moves `at` to the position after a group that has only an id and contains only line ends; leaves it unchanged at any
   !> other string.
   pure subroutine skip_empty_group(svg, at)
      character(*), intent(in) :: svg
      integer, intent(inout) :: at
      character(*), parameter :: head = '<g id="', tail = '</g>'
      integer :: last

      if (svg(at:min(at + len(head) - 1, len(svg))) /= head) return
      last = next_of(svg, at, '>') + 1
      do while (last < len(svg))
         if (svg(last:last) /= achar(line_feed)) exit
         last = last + 1
      end do
      if (svg(last:min(last + len(tail) - 1, len(svg))) == tail) at = last + len(tail)
   end subroutine skip_empty_group

   !> The next position of a string, at `at` or after it; the position after the end if the string does not occur.
   pure integer function next_of(text, at, word) result(place)
      character(*), intent(in) :: text, word
      integer, intent(in) :: at

      do place = at, len(text) - len(word) + 1      ! the library's index is several times slower
         if (text(place:place) /= word(1:1)) cycle
         if (text(place:place + len(word) - 1) == word) return
      end do
      place = len(text) + 1
   end function next_of

end module ek_compact_svg
