!> Hardpoints in a file: a table as CSV, or the [HARDPOINT] blocks of a subsystem or an assembly of Adams/Car (.sub, .asy). A row
!> with the symmetry 'left/right' is a pair of points and gives the coordinates of the left point.
!>
!> CSV: the first line has the column headings, in any order and with any further columns: `name`, `x`,
!> `y`, `z`, with or without their unit (`x_mm`, `Y [m]`, `z (in)`), optionally `symmetry` or `side`. Without headings the columns
!> are name, x, y, z. A row of units may follow the headings. The table is read by ek_sheet.
!>
!> Adams/Car: rows `name symmetry x y z` below {headings}, or entries
!> HARDPOINT_NAME, SYMMETRY, X_VALUE, Y_VALUE, Z_VALUE.
module ek_hardpoint_sheet
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_file, only: read_whole, most_of_input
   use ek_flaws, only: flaws_t, new_flaws, shown
   use ek_fields, only: lines_t, split_lines, take_number
   use ek_teimorbit, only: teimorbit_t, parse_teimorbit, is_teimorbit, find_block, entry_of, units_in, check_units, row_item, &
      heads_item
   use ek_hardpoint, only: hardpoint_t, hardpoints_t, single_point, left_point, right_point, point_pair, add_hardpoint, &
      take_symmetry
   use ek_text, only: str, lower
   use ek_sheet, only: sheet_t, parse_sheet, cells_t, new_cells, split_row, plain_cell, cell_of, head_place
   use ek_sheet_cell, only: get_cell, cell_fault
   use ek_sheet_columns, only: find_unit_row, find_decimal_marks, is_decimal_comma, row_fault
   use ek_point_heading, only: split_plain_head
   use ek_unit_word, only: unit_of, length_unit
   implicit none(type, external)
   private
   public :: hardpoint_t, hardpoints_t, read_hardpoints, parse_hardpoints, single_point, left_point, right_point, point_pair

   real(wp), parameter :: most = 1.0e25_wp          !! larger numbers are errors; smaller numbers are legal in a deck in any unit

contains

   !> Reads a file; errors in its content are in `flaws`.
   subroutine read_hardpoints(path, length, sheet, flaws, error, may_stream)
      character(*), intent(in) :: path
      real(wp), intent(in) :: length                       !! unit of a CSV column whose heading names none [m]
      type(hardpoints_t), intent(out) :: sheet
      type(flaws_t), intent(out) :: flaws
      type(error_t), allocatable, intent(out) :: error     !! exit_file: the file cannot be read
      logical, intent(in), optional :: may_stream
      character(:), allocatable :: text

      flaws = new_flaws(path)
      call read_whole(path, text, error, may_stream, most_of_input)
      if (.not. allocated(error)) call parse_hardpoints(text, length, sheet, flaws)
   end subroutine read_hardpoints

   !> Reads hardpoints from the content of a file.
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
         call take_table(text, length, sheet, flaws)
      end if
      if (sheet%used == 0 .and. flaws%count() == 0) call flaws%add(0, 'expected hardpoints, found none')
   end subroutine parse_hardpoints

   !> Reads a table: headings, then one hardpoint per line.
   subroutine take_table(text, length, sheet, flaws)
      character(*), intent(in) :: text                     !! content of the file
      real(wp), intent(in) :: length
      type(hardpoints_t), intent(inout) :: sheet
      type(flaws_t), intent(inout) :: flaws
      type(sheet_t) :: table
      type(cells_t) :: cells
      character(:), allocatable :: fault, name, cell
      integer :: columns(5), row, j, symmetry
      real(wp) :: units(3), numbers(3)
      logical :: has_commas, is_good(3)

      call parse_sheet(text, flaws%file, table)
      if (table%head_line == 0) then
         call flaws%add(0, 'expected the column headings name, x, y, z, found no line of text')
         return
      end if
      call find_columns(table, length, columns, units, flaws)
      if (any(columns([1, 3, 4, 5]) == 0)) then
         if (.not. is_row(table)) then
            call flaws%add(table%head_line, 'expected the column headings name, x, y, z, found '// &
               shown(table%text(table%first(0):table%last(0))))
            return
         end if
         columns = [1, 0, 2, 3, 4]
         units = length
         row = 0
      else
         call add_head_mistakes(table, flaws)
         call find_unit_row(table, columns(3:))
         if (table%unit_row > 0) call take_units(table, columns(3:), units, length, flaws)
         row = 1 + table%unit_row
      end if
      call find_decimal_marks(table, columns(3:))
      has_commas = is_decimal_comma(table)
      cells = new_cells(table)
      do row = row, table%rows
         call split_row(table, row, cells)
         fault = row_fault(table, row, cells, maxval(columns))
         if (cells%is_closed .and. cells%used > size(table%heads)) then              ! remarks
            if (scan(table%text(cells%first(size(table%heads) + 1):table%last(row)), '0123456789') == 0) fault = ''
         end if
         if (fault /= '') then
            call flaws%add(table%lines(row), fault)
            cycle
         end if
         name = plain_cell(table, cells, columns(1))
         symmetry = single_point
         if (columns(2) > 0) call take_symmetry(plain_cell(table, cells, columns(2)), table%lines(row), symmetry, flaws)
         do j = 1, 3
            cell = plain_cell(table, cells, columns(j + 2))
            call get_cell(cell, has_commas, numbers(j), is_good(j))
            if (is_good(j)) is_good(j) = abs(numbers(j)) < most
            if (.not. is_good(j)) call flaws%add(table%lines(row), 'xyz'(j:j)//' of '//shown(name)//': '// &
               cell_fault(cell, has_commas))
         end do
         if (all(is_good) .and. symmetry >= 0) &
            call add_hardpoint(sheet, name, numbers*units, symmetry, table%lines(row), flaws)
      end do
   end subroutine take_table

   !> Adds the errors of the headings.
   subroutine add_head_mistakes(table, flaws)
      type(sheet_t), intent(in) :: table
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: words
      integer :: k

      do k = 1, table%head_mistakes%count()
         words = table%head_mistakes%line(k)
         if (index(words, head_place(table)) == 1) words = words(len(head_place(table)) + 1:)
         call flaws%add(table%head_line, words)
      end do
   end subroutine add_head_mistakes

   !> Takes the units of x, y and z from the row of units. A unit that contradicts the heading is an error.
   subroutine take_units(table, columns, units, length, flaws)
      type(sheet_t), intent(in) :: table
      integer, intent(in) :: columns(3)
      real(wp), intent(inout) :: units(3)                  !! on entry, units by the headings
      real(wp), intent(in) :: length                       !! unit without any name of a unit
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: cell, head
      real(wp) :: unit
      integer :: j

      do j = 1, 3
         cell = cell_of(table, 1, columns(j))
         unit = unit_of(length_unit, cell(max(1, verify(cell, '[( ')):verify(cell, ')] ', back=.true.)))
         if (cell == '' .or. cell == '-') cycle
         if (.not. unit > 0.0_wp) then
            call flaws%add(table%lines(1), 'expected a unit of length for '//'xyz'(j:j)//', found '//shown(cell))
            cycle
         end if
         head = trim(table%heads(columns(j)))
         if (has_unit(head) .and. abs(unit - units(j)) > 1.0e-9_wp*unit) call flaws%add(table%lines(1), &
            'expected the unit of column '//shown(head)//', found '//shown(cell))
         if (.not. has_unit(head)) units(j) = unit
      end do

   contains

      !> Whether a heading names a unit: two different default units give the same unit.
      logical function has_unit(head)
         character(*), intent(in) :: head
         character(:), allocatable :: ignored
         real(wp) :: one, other

         call split_plain_head(head, length, ignored, one)
         call split_plain_head(head, 2.0_wp*length, ignored, other)
         has_unit = abs(one - other) <= 0.0_wp
      end function has_unit

   end subroutine take_units

   !> Whether the first line of a file is already a row: a word, then three numbers.
   logical function is_row(table)
      type(sheet_t), intent(in) :: table
      real(wp) :: value
      integer :: k

      is_row = size(table%heads) >= 4
      if (.not. is_row) return
      do k = 2, 4
         if (is_row) call get_cell(cell_of(table, 0, k), table%separator /= ',', value, is_row)
      end do
   end function is_row

   !> Finds the columns of name, symmetry, x, y, z (0 if a column does not exist), and the SI values of the units of x, y and z.
   subroutine find_columns(table, length, columns, units, flaws)
      type(sheet_t), intent(in) :: table
      real(wp), intent(in) :: length
      integer, intent(out) :: columns(5)
      real(wp), intent(out) :: units(3)
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: head
      real(wp) :: unit
      integer :: k, c

      columns = 0
      units = length
      do k = 1, min(size(table%heads), 200)
         call split_plain_head(trim(table%heads(k)), length, head, unit)
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
         if (columns(c) > 0 .and. c > 2) then
            if (table%heads(columns(c)) /= table%heads(k)) call flaws%add(table%head_line, 'the column '//head// &
               ' is given twice, as column '//str(columns(c))//' '//shown(table%heads(columns(c)))//' and column '//str(k)//' '// &
               shown(table%heads(k))//'; remove or rename one')
         end if
         if (columns(c) > 0) cycle        ! the first of two, as of `name` and `label`
         columns(c) = k
         if (c > 2) units(c - 2) = unit
      end do
      if (columns(1) > 0 .or. any(columns(3:) == 0)) return
      do k = 1, size(table%heads)         ! the name is the first column that is not one of the others
         if (any(columns == k)) cycle
         columns(1) = k
         return
      end do
   end subroutine find_columns

   !> Reads all [HARDPOINT] blocks.
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

   !> Advice for a file without hardpoints: the subsystems that an assembly names, whose files contain the hardpoints; otherwise ''.
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

   !> Reads the rows of one block.
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
            if (item%kind == heads_item) then
               order = 0
               do j = 1, item%used
                  c = findloc(names == lower(item%fields(j)%text), .true., dim=1)
                  if (c > 0) order(c) = j
               end do
               do c = 1, size(names)
                  if (order(c) == 0) call flaws%add(item%line, 'expected a column '//trim(names(c))//', found none')
               end do
               if (any(order == 0)) return
            else if (item%kind == row_item) then
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

   !> Reads a block with one hardpoint as entries.
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

end module ek_hardpoint_sheet
