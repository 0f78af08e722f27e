!> Headings of tables of hardpoints: the coordinate, unit, corner, axle and side that a heading names, and a line of corners above
!> the headings.
module ek_point_heading
   use ek_kinds, only: wp
   use ek_text, only: lower
   use ek_unit_word, only: unit_of, length_unit
   implicit none(type, external)
   private
   public :: split_head, split_plain_head, split_place, joined_heads, cut_cell, coordinate_of

   !> Parts of a heading that say nothing.
   character(*), parameter :: idle(13) = [character(10) :: 'coordinate', 'coord', 'value', 'position', 'pos', 'location', 'loc', &
      'achse', 'axis', 'wert', 'of', 'the', 'in']

contains

   !> Splits a heading into corner, axle or side, the letters that remain, and its unit [m]; 0 if it names none: 'FL x [mm]'.
   subroutine split_head(text, axle, side, head, unit)
      character(*), intent(in) :: text
      integer, intent(out) :: axle, side
      character(:), allocatable, intent(out) :: head
      real(wp), intent(out) :: unit
      character(:), allocatable :: word, others
      integer :: at, a, s
      logical :: is_place

      axle = 0
      side = 0
      unit = 0.0_wp
      head = ''
      others = ''
      at = 1
      do
         call next_letters(text, at, word)
         if (word == '') exit
         call split_place(word, a, s, is_place)
         if (is_place) then
            if (a > 0) axle = a
            if (s > 0) side = s
         else if (len(word) == 1 .and. scan(word, 'xyz') == 1) then
            head = head//word
         else if (head /= '' .and. unit_of(length_unit, word) > 0.0_wp) then
            unit = unit_of(length_unit, word)
         else if (.not. any(idle == word)) then
            others = others//word
         end if
      end do
      if (others /= '') head = without_idle(head//others)
      if (head == '' .and. (axle > 0 .or. side > 0)) head = 'place'
      if (head == '' .and. index(lower(text), 'achse') > 0) head = 'achse'
   end subroutine split_head

   !> Splits a heading without corner, axle and side into the letters that give its meaning, and its unit: 'x' and 1e-3 for
   !> 'X-Coordinate [mm]' and for 'loc_x_mm'.
   subroutine split_plain_head(text, length, head, unit)
      character(*), intent(in) :: text
      real(wp), intent(in) :: length                 !! unit without any name of a unit
      character(:), allocatable, intent(out) :: head
      real(wp), intent(out) :: unit
      character(:), allocatable :: word
      real(wp) :: found
      integer :: at

      head = ''
      unit = length
      at = 1
      do
         call next_letters(text, at, word)
         if (word == '') exit
         found = unit_of(length_unit, word)
         if (found > 0.0_wp .and. head /= '') then
            unit = found
         else if (.not. any(idle == word)) then
            head = head//word
         end if
      end do
      head = without_idle(head)
   end subroutine split_plain_head

   !> Finds the next run of letters of a heading, in lower case; '' at its end. A heading has at most 200 characters.
   pure subroutine next_letters(text, at, word)
      character(*), intent(in) :: text
      integer, intent(inout) :: at
      character(:), allocatable, intent(out) :: word
      character(*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ'
      integer :: first, last

      word = ''
      last = min(len(text), 200)
      if (at > last) return
      first = scan(text(at:last), letters)
      if (first == 0) return
      at = at + first - 1
      first = verify(text(at:last), letters)
      if (first == 0) first = last - at + 2
      word = lower(text(at:at + first - 2))
      at = at + first - 1
   end subroutine next_letters

   !> The coordinate of xvalue or locx: a letter and an idle part in one word. Other texts are unchanged.
   pure function without_idle(text) result(head)
      character(*), intent(in) :: text
      character(:), allocatable :: head
      integer :: k

      head = text
      do k = 1, size(idle)
         if (len(text) /= len_trim(idle(k)) + 1 .or. len(text) == 1) cycle
         if (text(2:) == idle(k) .and. scan(text(1:1), 'xyz') == 1) head = text(1:1)
         if (text(:len(text) - 1) == idle(k) .and. scan(text(len(text):), 'xyz') == 1) head = text(len(text):)
         if (len(head) == 1) return
      end do
   end function without_idle

   !> The coordinate that a heading names, 1 to 3; 0 if it names none.
   integer function coordinate_of(text)
      character(*), intent(in) :: text
      character(:), allocatable :: head
      real(wp) :: unit
      integer :: axle, side

      call split_head(text, axle, side, head, unit)
      coordinate_of = 0
      if (len(head) == 1) coordinate_of = index('xyz', head)
   end function coordinate_of

   !> Splits a text that names a corner, an axle or a side: 'FL', 'Front Left', 'rear', 'RH'.
   subroutine split_place(text, axle, side, is_place)
      character(*), intent(in) :: text
      integer, intent(out) :: axle, side            !! 0 if the text names none
      logical, intent(out) :: is_place              !! the text names nothing else
      character(:), allocatable :: word

      axle = 0
      side = 0
      word = plain(text)
      is_place = .true.
      select case (word)
      case ('front', 'vorn', 'vorne', 'va', 'frontaxle', 'axlefront')
         axle = 1
      case ('rear', 'back', 'hinten', 'ha', 'rearaxle', 'axlerear')
         axle = 2
      case ('left', 'l', 'lh', 'lhs', 'links', 'leftside')
         side = 1
      case ('right', 'rh', 'rhs', 'rechts', 'rightside')
         side = 2
      case ('fl', 'lf', 'frontleft', 'leftfront', 'vl', 'frontlh')
         axle = 1
         side = 1
      case ('fr', 'rf', 'frontright', 'rightfront', 'vr', 'frontrh')
         axle = 1
         side = 2
      case ('rl', 'lr', 'rearleft', 'leftrear', 'hl', 'rearlh')
         axle = 2
         side = 1
      case ('rr', 'rearright', 'rightrear', 'hr', 'rearrh')
         axle = 2
         side = 2
      case default
         is_place = .false.
      end select
   end subroutine split_place

   !> A text in lower case without blanks, underscores, hyphens and dots.
   pure function plain(text) result(word)
      character(*), intent(in) :: text
      character(:), allocatable :: word
      integer :: k

      word = ''
      do k = 1, min(len(text), 60)
         if (scan(text(k:k), ' _-./') == 0) word = word//lower(text(k:k))
      end do
   end function plain

   !> Joins a line of corners above the headings with the headings: 'name,FL,,,FR,,' and ',x,y,z,x,y,z' become a comment and
   !> 'name,FL x,FL y, …'. Other texts are unchanged.
   function joined_heads(text) result(joined)
      character(*), intent(in) :: text
      character(:), allocatable :: joined
      character(:), allocatable :: upper, lower_line, block, cell, head
      character :: separator
      integer :: first(2), last(2)

      joined = text
      if (.not. has_block_line(text, first, last, separator)) return
      upper = text(first(1):last(1))
      lower_line = text(first(2):last(2))
      block = ''
      head = ''
      do while (upper /= '' .or. lower_line /= '')
         call cut_cell(upper, separator, cell)
         if (cell /= '') block = cell
         call cut_cell(lower_line, separator, cell)
         if (head /= '') head = head//separator
         if (coordinate_of(cell) == 0) then
            if (cell == '') cell = block
         else if (block /= '') then
            cell = block//' '//cell
         end if
         head = head//cell
      end do
      joined = text(:first(1) - 1)//'#'//text(first(1):last(1))//text(last(1) + 1:first(2) - 1)//head//text(last(2) + 1:)
   end function joined_heads

   !> Whether the first line of a text names corners, axles or sides, and the second line has x, y, z at least twice.
   logical function has_block_line(text, first, last, separator) result(has)
      character(*), intent(in) :: text
      integer, intent(out) :: first(2), last(2)            !! positions of the two lines
      character, intent(out) :: separator
      character(:), allocatable :: line, cell
      integer :: at, n, k, x, places, axle, side
      logical :: is_place

      has = .false.
      separator = ','
      at = 1
      n = 0
      do while (at <= len(text) .and. n < 2)
         k = index(text(at:), new_line('a')) - 1
         if (k < 0) k = len(text) - at + 1
         if (verify(text(at:at + k - 1), ' ,;"'//achar(9)) > 0 .and. index(adjustl(text(at:at + k - 1)), '#') /= 1) then
            n = n + 1
            first(n) = at
            last(n) = at + k - 1
         end if
         at = at + k + 1
      end do
      if (n < 2) return
      line = text(first(2):last(2))
      if (index(line, achar(9)) > 0) separator = achar(9)
      if (index(line, ';') > 0) separator = ';'
      x = 0
      do while (line /= '')
         call cut_cell(line, separator, cell)
         if (coordinate_of(cell) == 1) x = x + 1
      end do
      places = 0
      line = text(first(1):last(1))
      do while (line /= '')
         call cut_cell(line, separator, cell)
         call split_place(cell, axle, side, is_place)
         if (is_place) places = places + 1
      end do
      has = x >= 2 .and. places >= 2
   end function has_block_line

   !> Takes the first cell from a line, without quotes and blanks at its ends.
   subroutine cut_cell(line, separator, cell)
      character(:), allocatable, intent(inout) :: line
      character, intent(in) :: separator
      character(:), allocatable, intent(out) :: cell
      integer :: at

      at = index(line, separator)
      if (at == 0) at = len(line) + 1
      cell = trim(adjustl(line(:at - 1)))
      line = line(min(at + 1, len(line) + 1):)
      if (len(cell) > 1) then
         if (cell(1:1) == '"' .and. cell(len(cell):) == '"') cell = trim(adjustl(cell(2:len(cell) - 1)))
      end if
   end subroutine cut_cell

end module ek_point_heading
