!> Hardpoints in a file: a table as CSV, or the [HARDPOINT] blocks of a subsystem or an assembly of Adams/Car (.sub, .asy).
!>
!> CSV: the first line has the heads, in any order and with any further columns: `name`, `x`, `y`, `z`, with or without their
!> unit (`x_mm`, `Y [m]`, `z (in)`), perhaps `symmetry` or `side`. Without heads the columns are name, x, y, z. Columns are separated by
!> commas, semicolons or tabs; # begins a comment. With semicolons or tabs a decimal comma is accepted.
!>
!> Adams/Car: rows `name symmetry x y z` below {heads}, or entries HARDPOINT_NAME, SYMMETRY, X_VALUE, Y_VALUE, Z_VALUE.
!> 'left/right' is a pair with the coordinates of its left point.
module ek_hardpoint_sheet
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t
   use ek_text, only: str, lower
   use ek_file, only: read_whole
   use ek_sheet, only: take_record
   use ek_flaws, only: flaws_t, new_flaws, shown
   use ek_fields, only: lines_t, split_lines, take_number, legal_name
   use ek_unit_word, only: unit_of, length_unit
   use ek_teimorbit, only: teimorbit_t, parse_teimorbit, find_block, entry_of, is_teimorbit, units_in, check_units, row, heads
   implicit none(type, external)
   private
   public :: hardpoint_t, hardpoints_t, read_hardpoints, parse_hardpoints, single_point, left_point, right_point, point_pair

   integer, parameter :: single_point = 0, left_point = 1, right_point = 2, point_pair = 3

   integer, parameter :: most_points = 5000
   character, parameter :: tab = achar(9)

   type :: hardpoint_t
      character(63) :: name = ''            !! legal in a deck
      real(wp) :: at(3) = 0.0_wp            !! m; in the frame of the file
      integer :: symmetry = single_point
      integer :: line = 0
   end type hardpoint_t

   type :: hardpoints_t
      integer :: used = 0
      type(hardpoint_t), allocatable :: points(:)
      logical :: is_adams = .false.         !! the frame is that of Adams/Car: x rearward, y to the right
   end type hardpoints_t

contains

   !> Reads a file; mistakes in its content are in `flaws`.
   subroutine read_hardpoints(path, length, sheet, flaws, error, may_stream)
      character(*), intent(in) :: path
      real(wp), intent(in) :: length                       !! m: unit of a column of a CSV file that names none
      type(hardpoints_t), intent(out) :: sheet
      type(flaws_t), intent(out) :: flaws
      type(error_t), allocatable, intent(out) :: error     !! exit_file: it cannot be read
      logical, intent(in), optional :: may_stream
      character(:), allocatable :: text

      flaws = new_flaws(path)
      call read_whole(path, text, error, may_stream)
      if (.not. allocated(error)) call parse_hardpoints(text, length, sheet, flaws)
   end subroutine read_hardpoints

   !> Reads a text.
   subroutine parse_hardpoints(text, length, sheet, flaws)
      character(*), intent(in) :: text
      real(wp), intent(in) :: length
      type(hardpoints_t), intent(out) :: sheet
      type(flaws_t), intent(inout) :: flaws
      type(lines_t) :: lines
      type(teimorbit_t) :: file

      allocate (sheet%points(32))
      call split_lines(text, lines, flaws)
      if (lines%count == 0) return
      sheet%is_adams = is_teimorbit(lines%text)
      if (sheet%is_adams) then
         call parse_teimorbit(lines, file, flaws)
         call take_blocks(file, sheet, flaws)
      else
         call take_table(lines, length, sheet, flaws)
      end if
      if (sheet%used == 0 .and. flaws%count() == 0) call flaws%add(0, 'expected hardpoints, found none')
   end subroutine parse_hardpoints

   !> Adds a point. Two rows of one name must be a left and a right one.
   subroutine add_hardpoint(sheet, name, at, symmetry, line, flaws)
      type(hardpoints_t), intent(inout) :: sheet
      character(*), intent(in) :: name
      real(wp), intent(in) :: at(3)
      integer, intent(in) :: symmetry, line
      type(flaws_t), intent(inout) :: flaws
      type(hardpoint_t) :: point
      integer :: k

      if (len_trim(name) == 0) then
         call flaws%add(line, 'expected the name of a hardpoint, found nothing')
         return
      end if
      point%name = legal_name(name)
      point%at = at
      point%symmetry = symmetry
      point%line = line
      do k = 1, sheet%used
         if (lower(sheet%points(k)%name) /= lower(point%name)) cycle
         if (all([sheet%points(k)%symmetry, symmetry] /= single_point) .and. &
            sheet%points(k)%symmetry + symmetry == left_point + right_point .and. symmetry /= point_pair) cycle
         call flaws%add(line, 'expected each hardpoint once, found '//shown(name)//' again (first in line '// &
            str(sheet%points(k)%line)//')')
         return
      end do
      if (sheet%used == most_points) then
         call flaws%add(line, 'expected at most '//str(most_points)//' hardpoints, found more')
         return
      end if
      if (sheet%used == size(sheet%points)) sheet%points = [sheet%points, sheet%points]      ! twice the size
      sheet%used = sheet%used + 1
      sheet%points(sheet%used) = point
   end subroutine add_hardpoint

   !> The symmetry that a word names; -1 if none.
   pure integer function symmetry_of(text)
      character(*), intent(in) :: text

      select case (lower(trim(adjustl(text))))
      case ('', 'single', 'none', 'no', 'center', 'centre')
         symmetry_of = single_point
      case ('left', 'l')
         symmetry_of = left_point
      case ('right', 'r')
         symmetry_of = right_point
      case ('left/right', 'both', 'symmetric', 'pair', 'yes')
         symmetry_of = point_pair
      case default
         symmetry_of = -1
      end select
   end function symmetry_of

   subroutine take_symmetry(text, line, symmetry, flaws)
      character(*), intent(in) :: text
      integer, intent(in) :: line
      integer, intent(out) :: symmetry
      type(flaws_t), intent(inout) :: flaws

      symmetry = symmetry_of(text)
      if (symmetry < 0) call flaws%add(line, 'expected the symmetry left, right, single or left/right, found '//shown(text))
   end subroutine take_symmetry

   ! ---- Adams/Car -------------------------------------------------------------------------------

   !> All [HARDPOINT] blocks.
   subroutine take_blocks(file, sheet, flaws)
      type(teimorbit_t), intent(in) :: file
      type(hardpoints_t), intent(inout) :: sheet
      type(flaws_t), intent(inout) :: flaws
      real(wp) :: units(5)
      integer :: block, order(5)

      call units_in(file, units, flaws)
      call check_units(file, units, [length_unit], flaws)
      block = find_block(file, 'hardpoint')
      if (block == 0) then
         call flaws%add(0, 'expected a block [HARDPOINT], found none'//advice(file))
         return
      end if
      do while (block > 0)
         order = [1, 2, 3, 4, 5]
         if (entry_of(file, block, 'hardpoint_name') > 0) then
            call take_entries(file, block, units(length_unit), sheet, flaws)
         else
            call take_rows(file, block, units(length_unit), order, sheet, flaws)
         end if
         block = find_block(file, 'hardpoint', after=block)
      end do
   end subroutine take_blocks

   !> An assembly names its subsystems, whose files have the hardpoints.
   function advice(file) result(words)
      type(teimorbit_t), intent(in) :: file
      character(:), allocatable :: words
      integer :: block, item

      words = ''
      block = find_block(file, 'subsystem')
      do while (block > 0 .and. len(words) < 300)
         item = entry_of(file, block, 'usage')
         if (item > 0) then
            if (file%items(item)%used > 0) words = words//' '//shown(file%items(item)%fields(1)%text)
         end if
         block = find_block(file, 'subsystem', after=block)
      end do
      if (words /= '') words = '; read its subsystems instead:'//words
   end function advice

   !> The rows of one block.
   subroutine take_rows(file, block, unit, order, sheet, flaws)
      type(teimorbit_t), intent(in) :: file
      integer, intent(in) :: block
      real(wp), intent(in) :: unit
      integer, intent(inout) :: order(5)           !! columns of name, symmetry, x, y, z
      type(hardpoints_t), intent(inout) :: sheet
      type(flaws_t), intent(inout) :: flaws
      character(*), parameter :: names(5) = [character(14) :: 'hardpoint_name', 'symmetry', 'x_value', 'y_value', 'z_value']
      real(wp) :: at(3)
      integer :: k, j, c, symmetry
      logical :: is_good(3)

      do k = 1, file%used
         associate (item => file%items(k))
            if (item%block /= block) cycle
            if (item%kind == heads) then
               order = 0
               do j = 1, item%used
                  c = findloc([(lower(item%fields(j)%text) == names(c), c=1, 5)], .true., dim=1)
                  if (c > 0) order(c) = j
               end do
               do c = 1, 5
                  if (order(c) == 0) call flaws%add(item%line, 'expected a column '//trim(names(c))//', found none')
               end do
               if (any(order == 0)) return
            else if (item%kind == row) then
               if (item%used < maxval(order)) then
                  call flaws%add(item%line, 'expected '//str(maxval(order))//' values (name, symmetry, x, y, z), found '// &
                     str(item%used))
                  cycle
               end if
               call take_symmetry(item%fields(order(2))%text, item%line, symmetry, flaws)
               do j = 1, 3
                  call take_number(item%fields(order(j + 2))%text, item%line, 'xyz'(j:j)//' of '// &
                     shown(item%fields(order(1))%text), at(j), flaws, is_good(j))
               end do
               if (all(is_good) .and. symmetry >= 0) &
                  call add_hardpoint(sheet, item%fields(order(1))%text, at*unit, symmetry, item%line, flaws)
            else
               call flaws%add(item%line, 'expected rows of hardpoints, found '//shown(trim(item%key)//' ='))
            end if
         end associate
      end do
   end subroutine take_rows

   !> A block with one hardpoint as entries.
   subroutine take_entries(file, block, unit, sheet, flaws)
      type(teimorbit_t), intent(in) :: file
      integer, intent(in) :: block
      real(wp), intent(in) :: unit
      type(hardpoints_t), intent(inout) :: sheet
      type(flaws_t), intent(inout) :: flaws
      character(*), parameter :: names(3) = ['x_value', 'y_value', 'z_value']
      character(:), allocatable :: name
      real(wp) :: at(3)
      integer :: j, item, line, symmetry
      logical :: is_good(3)

      item = entry_of(file, block, 'hardpoint_name')
      line = file%items(item)%line
      name = ''
      if (file%items(item)%used > 0) name = file%items(item)%fields(1)%text
      symmetry = single_point
      item = entry_of(file, block, 'symmetry')
      if (item > 0) then
         if (file%items(item)%used > 0) call take_symmetry(file%items(item)%fields(1)%text, file%items(item)%line, symmetry, flaws)
      end if
      do j = 1, 3
         item = entry_of(file, block, names(j))
         is_good(j) = item > 0
         if (is_good(j)) is_good(j) = file%items(item)%used > 0
         if (.not. is_good(j)) then
            call flaws%add(line, 'expected '//names(j)//' of '//shown(name)//', found none')
         else
            call take_number(file%items(item)%fields(1)%text, file%items(item)%line, names(j), at(j), flaws, is_good(j))
         end if
      end do
      if (all(is_good) .and. symmetry >= 0) call add_hardpoint(sheet, name, at*unit, symmetry, line, flaws)
   end subroutine take_entries

   ! ---- CSV -------------------------------------------------------------------------------------

   !> A table: heads, then a hardpoint a line.
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
                  call flaws%add(k, 'expected the heads name, x, y, z, found '//shown(text))
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
      if (.not. has_heads) call flaws%add(0, 'expected the heads name, x, y, z, found no line of text')
   end subroutine take_table

   pure character function separator_of(text) result(separator)
      character(*), intent(in) :: text

      separator = ','
      if (index(text, tab) > 0) separator = tab
      if (index(text, ';') > 0) separator = ';'
   end function separator_of

   !> A number with a decimal point in place of a decimal comma.
   pure function with_point(text, separator) result(number)
      character(*), intent(in) :: text
      character, intent(in) :: separator
      character(:), allocatable :: number
      integer :: comma

      number = trim(adjustl(text))
      comma = index(number, ',')
      if (separator /= ',' .and. comma > 0 .and. index(number, '.') == 0) number(comma:comma) = '.'
   end function with_point

   !> Whether a line without heads is a row already: a word, then three numbers.
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

   !> The columns of name, symmetry, x, y, z (0: none), and the units of the last three.
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
      do k = 1, cells%count()             ! the name is the first column that is none of the others
         if (any(columns == k)) cycle
         columns(1) = k
         return
      end do
   end subroutine find_columns

   !> The letters of a column heading that give its meaning, and its unit: 'x', 1e-3 for 'X-Coordinate [mm]', 'loc_x_mm'.
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

end module ek_hardpoint_sheet
