!> A table of hardpoints as CSV. The first line has the column headings, in any order and with any further columns: `name`, `x`,
!> `y`, `z`, with or without their unit (`x_mm`, `Y [m]`, `z (in)`), optionally `symmetry` or `side`. Without headings the columns
!> are name, x, y, z. Columns are separated by commas, semicolons or tabs. A line that begins with # is a comment. With semicolons
!> or tabs a decimal comma is accepted.
module ek_hardpoint_table
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str, lower
   use ek_sheet, only: take_record
   use ek_flaws, only: flaws_t, shown
   use ek_fields, only: lines_t, take_number
   use ek_unit_word, only: unit_of, length_unit
   use ek_hardpoint, only: hardpoints_t, single_point, add_hardpoint, take_symmetry
   implicit none(type, external)
   private
   public :: take_table

   character, parameter :: tab = achar(9)

contains

   !> Reads a table: headings, then one hardpoint per line.
   subroutine take_table(lines, length, sheet, flaws)
      type(lines_t), intent(in) :: lines
      real(wp), intent(in) :: length
      type(hardpoints_t), intent(inout) :: sheet
      type(flaws_t), intent(inout) :: flaws
      type(message_list_t) :: cells
      character(:), allocatable :: text
      character :: separator
      integer :: columns(5), k, at, line, j
      real(wp) :: units(3), numbers(3)
      logical :: has_heads, is_closed, is_good(3)
      integer :: symmetry

      has_heads = .false.
      separator = ','
      do k = 1, lines%count
         text = lines%line(k)
         if (index(adjustl(text), '#') == 1 .or. verify(text, ' ,;"'//tab) == 0) cycle
         if (.not. has_heads .and. index(text, 'sep=') == 1 .and. len_trim(text) == 5) cycle      ! a line of Excel
         if (.not. has_heads) separator = separator_of(text)
         at = 1
         line = k
         call take_record(text, separator, at, line, cells, is_closed)
         if (.not. is_closed) then
            call flaws%add(k, 'expected a closing ", found none')
            cycle
         end if
         if (.not. has_heads) then
            has_heads = .true.
            call find_columns(cells, length, columns, units)
            if (any(columns([1, 3, 4, 5]) == 0)) then
               if (.not. is_row(cells, separator)) then
                  call flaws%add(k, 'expected the column headings name, x, y, z, found '//shown(text))
                  return
               end if
               columns = [1, 0, 2, 3, 4]
               units = length
            else
               cycle
            end if
         end if
         if (cells%count() < maxval(columns)) then
            call flaws%add(k, 'expected at least '//str(maxval(columns))//' cells, found '//str(cells%count()))
            cycle
         end if
         symmetry = single_point
         if (columns(2) > 0) call take_symmetry(cells%line(columns(2)), k, symmetry, flaws)
         do j = 1, 3
            call take_number(with_point(cells%line(columns(j + 2)), separator), k, 'xyz'(j:j)//' of '// &
               shown(cells%line(columns(1))), numbers(j), flaws, is_good(j))
         end do
         if (all(is_good) .and. symmetry >= 0) &
            call add_hardpoint(sheet, cells%line(columns(1)), numbers*units, symmetry, k, flaws)
      end do
      if (.not. has_heads) call flaws%add(0, 'expected the column headings name, x, y, z, found no line of text')
   end subroutine take_table

   pure character function separator_of(text) result(separator)
      character(*), intent(in) :: text

      separator = ','
      if (index(text, tab) > 0) separator = tab
      if (index(text, ';') > 0) separator = ';'
   end function separator_of

   !> A number with a decimal point instead of a decimal comma, if the separator of the columns is not a comma.
   pure function with_point(text, separator) result(number)
      character(*), intent(in) :: text
      character, intent(in) :: separator
      character(:), allocatable :: number
      integer :: comma

      number = trim(adjustl(text))
      comma = index(number, ',')
      if (separator /= ',' .and. comma > 0 .and. index(number, '.') == 0) number(comma:comma) = '.'
   end function with_point

   !> Whether a line in a file without headings is already a row: a word, then three numbers.
   logical function is_row(cells, separator)
      type(message_list_t), intent(in) :: cells
      character, intent(in) :: separator
      type(flaws_t) :: ignored
      real(wp) :: value
      integer :: k

      is_row = cells%count() >= 4
      if (.not. is_row) return
      do k = 2, 4
         if (is_row) call take_number(with_point(cells%line(k), separator), 1, '', value, ignored, is_row)
      end do
   end function is_row

   !> Finds the columns of name, symmetry, x, y, z (0 if a column does not exist), and the SI values of the units of x, y and z.
   subroutine find_columns(cells, length, columns, units)
      type(message_list_t), intent(in) :: cells
      real(wp), intent(in) :: length
      integer, intent(out) :: columns(5)
      real(wp), intent(out) :: units(3)
      character(:), allocatable :: head
      real(wp) :: unit
      integer :: k, c

      columns = 0
      units = length
      do k = 1, min(cells%count(), 200)
         call split_head(cells%line(k), length, head, unit)
         select case (head)
         case ('name', 'hardpoint', 'hardpointname', 'point', 'pointname', 'label', 'id', 'marker', 'punkt', 'bezeichnung')
            c = 1
         case ('symmetry', 'side', 'seite')
            c = 2
         case ('x', 'y', 'z')
            c = index('xyz', head) + 2
         case default
            c = 0
         end select
         if (c == 0) cycle
         if (columns(c) > 0) cycle        ! the first of two, as of `name` and `label`
         columns(c) = k
         if (c > 2) units(c - 2) = unit
      end do
      if (columns(1) > 0 .or. any(columns(3:) == 0)) return
      do k = 1, cells%count()             ! the name is the first column that is not one of the others
         if (any(columns == k)) cycle
         columns(1) = k
         return
      end do
   end subroutine find_columns

   !> Splits a column heading into the letters that give its meaning, and its unit: 'x' and 1e-3 for 'X-Coordinate [mm]' and for
   !> 'loc_x_mm'.
   subroutine split_head(text, length, head, unit)
      character(*), intent(in) :: text
      real(wp), intent(in) :: length
      character(:), allocatable, intent(out) :: head
      real(wp), intent(out) :: unit
      character(*), parameter :: idle(13) = [character(10) :: 'coordinate', 'coord', 'value', 'position', 'pos', 'location', &
         'loc', 'achse', 'axis', 'wert', 'in', 'of', 'the']
      character(:), allocatable :: folded, word
      real(wp) :: found
      integer :: at, next

      folded = lower(text(:min(len(text), 200)))
      head = ''
      unit = length
      at = 1
      do while (at <= len(folded))
         next = verify(folded(at:), 'abcdefghijklmnopqrstuvwxyz')
         if (next == 0) next = len(folded) - at + 2
         word = folded(at:at + next - 2)
         at = at + max(next, 1)
         if (word == '') cycle
         found = unit_of(length_unit, word)
         if (found > 0.0_wp .and. head /= '') then
            unit = found
         else if (.not. any(idle == word)) then
            head = head//word
         end if
      end do
      if (len(head) == 1) return
      ! xvalue, locx: one word of two
      do at = 1, size(idle)
         if (head == 'x'//trim(idle(at)) .or. head == 'y'//trim(idle(at)) .or. head == 'z'//trim(idle(at))) then
            head = head(1:1)
            return
         end if
         if (head == trim(idle(at))//'x' .or. head == trim(idle(at))//'y' .or. head == trim(idle(at))//'z') then
            head = head(len(head):)
            return
         end if
      end do
   end subroutine split_head

end module ek_hardpoint_table
