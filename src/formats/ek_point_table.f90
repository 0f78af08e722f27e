!> Tables of hardpoints as people write them: one row for each point, with the columns x, y, z once (and perhaps columns `corner`,
!> `axle`, `side`), or once for each corner, axle or side ('FL x', 'rear_y', 'Left Z [mm]', or a line of corners above the
!> headings).
!> Other columns, as an index or remarks, are not read. The result is data: names are recognised by ek_point_name, numbers are
!> in the columns and the unit of the table.
module ek_point_table
   use ek_kinds, only: wp
   use ek_text, only: str, lower
   use ek_letters, only: with_line_ends
   use ek_sheet, only: sheet_t, parse_sheet, cells_t, new_cells, split_row, plain_cell, cell_of
   use ek_sheet_cell, only: get_cell, cell_fault
   use ek_sheet_columns, only: find_unit_row, find_decimal_marks, is_decimal_comma, row_fault
   use ek_unit_word, only: unit_of, length_unit
   use ek_point_heading, only: split_head, split_place, joined_heads
   use ek_flaws, only: flaws_t, shown
   use ek_hardpoint, only: take_symmetry, single_point, point_pair
   use ek_point_name, only: meaning_t, hints_t, meaning_of, hints_in
   use ek_vote, only: length_names, length_values
   use ek_car_number, only: car_number_t, car_numbers_t, car_number_of, add_car_number, count_of
   implicit none(type, external)
   private
   public :: table_point_t, point_table_t, not_a_point, parse_points, take_length, recognise, add_point

   integer, parameter :: most_blocks = 12        !! most groups of columns x, y, z
   integer, parameter :: most_points = 5000
   integer, parameter :: not_a_point = -2        !! a number of the file that is not read
   real(wp), parameter :: most = 1.0e25_wp       !! larger numbers are errors; smaller numbers are legal in a deck in any unit

   !> A point of the table.
   type :: table_point_t
      character(63) :: name = ''                 !! as in the table
      integer :: point = -1                      !! as in meaning_t
      integer :: axle = 0                        !! 0 not given, 1 front, 2 rear
      integer :: side = single_point             !! single_point, left_point, right_point or point_pair
      real(wp) :: at(3) = 0.0_wp
      integer :: line = 0
   end type table_point_t

   type :: point_table_t
      integer :: used = 0
      type(table_point_t), allocatable :: points(:)
      integer :: length = 0                      !! unit that the table names, index in length_names; 0: none
      type(car_numbers_t) :: numbers             !! numbers of the car and of adjusters
   end type point_table_t

   !> Columns x, y and z of a corner, an axle or a side.
   type :: block_t
      integer :: axle = 0, side = 0
      integer :: columns(3) = 0
   end type block_t

   !> The meaning of the columns.
   type :: layout_t
      integer :: name = 0, corner = 0, axle = 0, side = 0      !! columns; 0 if there is none
      type(block_t) :: blocks(most_blocks)
      integer :: used = 0
   end type layout_t

contains

   !> Reads the points of a table. Errors are added to `flaws`.
   subroutine parse_points(text, table, flaws)
      character(*), intent(in) :: text                 !! content of the file
      type(point_table_t), intent(out) :: table
      type(flaws_t), intent(inout) :: flaws
      type(sheet_t) :: sheet
      type(layout_t) :: layout
      type(cells_t) :: cells
      character(:), allocatable :: fault
      integer, allocatable :: columns(:)
      integer :: row, k

      allocate (table%points(32))
      call parse_sheet(joined_heads(with_line_ends(text)), flaws%file, sheet)
      if (sheet%head_line == 0) then
         call flaws%add(0, 'expected the column headings name, x, y, z, found no line of text')
         return
      end if
      call find_layout(sheet, layout, table, flaws)
      if (layout%used == 0) return
      columns = [(layout%blocks(k)%columns, k=1, layout%used)]
      call find_unit_row(sheet, columns)
      if (sheet%unit_row > 0) call take_unit_row(sheet, columns, table, flaws)
      call find_decimal_marks(sheet, columns)
      cells = new_cells(sheet)
      do row = 1 + sheet%unit_row, sheet%rows
         call split_row(sheet, row, cells)
         fault = row_fault(sheet, row, cells, 1)
         if (fault /= '') then
            call flaws%add(sheet%lines(row), fault)
            cycle
         end if
         do k = 1, layout%used
            call take_block(sheet, row, cells, layout, layout%blocks(k), table, flaws)
         end do
      end do
      call recognise(table, flaws)
      if (table%used == 0 .and. flaws%count() == 0) call flaws%add(0, 'expected hardpoints, found none')
   end subroutine parse_points

   !> Finds the columns.
   subroutine find_layout(sheet, layout, table, flaws)
      type(sheet_t), intent(in) :: sheet
      type(layout_t), intent(out) :: layout
      type(point_table_t), intent(inout) :: table
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: rest
      logical :: is_other(size(sheet%heads)), is_place
      real(wp) :: unit
      integer :: k, axle, side, c

      is_other = .false.
      do k = 1, min(size(sheet%heads), 200)
         call split_head(trim(sheet%heads(k)), axle, side, rest, unit)
         select case (rest)
         case ('corner', 'wheel', 'ecke')
            layout%corner = k
         case ('axle', 'achse')
            layout%axle = k
         case ('symmetry', 'side', 'seite')
            layout%side = k
         case ('x', 'y', 'z')
            c = index('xyz', rest)
            call add_column(k, c)
            call take_length(unit, sheet%head_line, table, flaws)
         case default
            call split_place(trim(sheet%heads(k)), axle, side, is_place)
            is_other(k) = .not. is_place
         end select
      end do
      do k = 1, layout%used
         if (all(layout%blocks(k)%columns > 0)) cycle
         call flaws%add(sheet%head_line, 'expected the columns x, y and z of each corner, axle or side, found one without '// &
            'xyz'(findloc(layout%blocks(k)%columns, 0, dim=1):findloc(layout%blocks(k)%columns, 0, dim=1)))
         layout%used = 0
         return
      end do
      layout%name = name_column(sheet, is_other)
      if (layout%used > 0 .and. layout%name > 0) return
      layout%used = 0
      call flaws%add(sheet%head_line, 'expected the column headings name, x, y, z (x, y, z once for each corner, as FL x), '// &
         'found '//shown(sheet%text(sheet%first(0):sheet%last(0))))

   contains

      !> Adds a column of coordinates to its block.
      subroutine add_column(column, c)
         integer, intent(in) :: column, c
         integer :: b

         do b = 1, layout%used
            if (layout%blocks(b)%axle == axle .and. layout%blocks(b)%side == side) exit
         end do
         if (b > most_blocks) then
            call flaws%add(sheet%head_line, 'expected at most '//str(most_blocks)//' groups of columns x, y, z, found more')
            return
         end if
         layout%used = max(layout%used, b)
         layout%blocks(b)%axle = axle
         layout%blocks(b)%side = side
         if (layout%blocks(b)%columns(c) > 0) call flaws%add(sheet%head_line, 'the column '//'xyz'(c:c)//' is given twice, as '// &
            shown(trim(sheet%heads(layout%blocks(b)%columns(c))))//' and '//shown(trim(sheet%heads(column))))
         layout%blocks(b)%columns(c) = column
      end subroutine add_column

   end subroutine find_layout

   !> The column of the names: one with such a heading, or the first other column; its cells are not all numbers, as those of an
   !> index are. 0 if there is none.
   integer function name_column(sheet, is_other) result(column)
      type(sheet_t), intent(in) :: sheet
      logical, intent(in) :: is_other(:)
      character(*), parameter :: names(11) = [character(15) :: 'name', 'hardpoint', 'hardpoint_name', 'hardpoint name', 'point', &
         'point_name', 'point name', 'label', 'marker', 'punkt', 'bezeichnung']
      integer :: pass, k

      do pass = 1, 2
         do k = 1, min(size(is_other), 200)
            if (.not. is_other(k)) cycle
            if (pass == 1 .and. .not. any(names == lower(sheet%heads(k)))) cycle
            if (.not. has_words(k)) cycle
            column = k
            return
         end do
      end do
      column = 0

   contains

      !> Whether a column has a cell that is neither empty nor a number.
      logical function has_words(place)
         integer, intent(in) :: place
         type(cells_t) :: cells
         character(:), allocatable :: cell
         real(wp) :: value
         logical :: is_good
         integer :: row

         has_words = .true.
         cells = new_cells(sheet)
         do row = 1, sheet%rows
            call split_row(sheet, row, cells)
            cell = plain_cell(sheet, cells, place)
            if (cell == '' .or. cell == '-') cycle
            call get_cell(cell, .true., value, is_good)
            if (.not. is_good) return
         end do
         has_words = .false.
      end function has_words

   end function name_column

   !> Takes the unit of a heading or of the row of units; all must be the same.
   subroutine take_length(unit, line, table, flaws)
      real(wp), intent(in) :: unit                     !! [m]; 0: none
      integer, intent(in) :: line
      type(point_table_t), intent(inout) :: table
      type(flaws_t), intent(inout) :: flaws
      integer :: k

      if (.not. unit > 0.0_wp) return
      do k = 1, size(length_values)
         if (abs(unit - length_values(k)) > 1.0e-9_wp*unit) cycle
         if (table%length > 0 .and. table%length /= k) call flaws%add(line, 'expected one unit for x, y and z, found '// &
            trim(length_names(table%length))//' and '//trim(length_names(k)))
         table%length = k
         return
      end do
      call flaws%add(line, 'expected the unit mm, cm, m, in or ft, found another one')
   end subroutine take_length

   !> Takes the row of units.
   subroutine take_unit_row(sheet, columns, table, flaws)
      type(sheet_t), intent(in) :: sheet
      integer, intent(in) :: columns(:)
      type(point_table_t), intent(inout) :: table
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: cell
      real(wp) :: unit
      integer :: k

      do k = 1, size(columns)
         cell = cell_of(sheet, 1, columns(k))
         if (cell == '' .or. cell == '-') cycle
         unit = unit_of(length_unit, cell(max(1, verify(cell, '[( ')):max(1, verify(cell, ')] ', back=.true.))))
         if (unit > 0.0_wp) then
            call take_length(unit, sheet%lines(1), table, flaws)
         else
            call flaws%add(sheet%lines(1), 'expected a unit of length, found '//shown(cell))
         end if
      end do
   end subroutine take_unit_row

   !> Reads the point of a row in one block of columns. A block whose three cells are empty has no point.
   subroutine take_block(sheet, row, cells, layout, block, table, flaws)
      type(sheet_t), intent(in) :: sheet
      integer, intent(in) :: row
      type(cells_t), intent(in) :: cells
      type(layout_t), intent(in) :: layout
      type(block_t), intent(in) :: block
      type(point_table_t), intent(inout) :: table
      type(flaws_t), intent(inout) :: flaws
      type(table_point_t) :: point
      character(:), allocatable :: cell, name
      logical :: is_good(3), is_empty(3)
      integer :: c

      name = plain_cell(sheet, cells, layout%name)
      do c = 1, 3
         cell = plain_cell(sheet, cells, block%columns(c))
         is_empty(c) = cell == '' .or. cell == '-' .or. cell == '—'
         call get_cell(cell, is_decimal_comma(sheet), point%at(c), is_good(c))
         if (is_good(c)) is_good(c) = abs(point%at(c)) < most
      end do
      if (all(is_empty) .and. (layout%used > 1 .or. name == '')) return
      point%name = name
      point%line = sheet%lines(row)
      point%axle = block%axle
      point%side = block%side
      if (is_car_number(name, is_good, is_empty)) then
         call take_places(sheet, cells, layout, point, flaws)
         call add_car_number(car_number_t(car_number_of(name), point%axle, point%at(:2), point%line), table%numbers, flaws)
         return
      end if
      do c = 1, 3
         if (is_good(c)) cycle
         call flaws%add(sheet%lines(row), 'xyz'(c:c)//' of '//shown(name)//': '// &
            cell_fault(plain_cell(sheet, cells, block%columns(c)), is_decimal_comma(sheet)))
      end do
      if (name == '' .and. any(is_good)) call flaws%add(sheet%lines(row), 'expected the name of a hardpoint, found nothing')
      if (name == '' .or. .not. all(is_good)) return
      call take_places(sheet, cells, layout, point, flaws)
      call add_point(point, table, flaws)
   end subroutine take_block

   !> Whether a row has a number of the car: in its first cells, and the others are empty.
   pure logical function is_car_number(name, is_good, is_empty)
      character(*), intent(in) :: name
      logical, intent(in) :: is_good(3), is_empty(3)
      integer :: slot, n

      slot = car_number_of(name)
      is_car_number = slot > 0
      if (.not. is_car_number) return
      n = count_of(slot)
      is_car_number = all(is_good(:n)) .and. all(is_empty(n + 1:))
   end function is_car_number

   !> Adds a point. More than 5000 points are an error.
   subroutine add_point(point, table, flaws)
      type(table_point_t), intent(in) :: point
      type(point_table_t), intent(inout) :: table
      type(flaws_t), intent(inout) :: flaws

      if (table%used == most_points) then
         call flaws%add(point%line, 'expected at most '//str(most_points)//' hardpoints, found more')
         return
      end if
      if (table%used == size(table%points)) table%points = [table%points, table%points]      ! twice the size
      table%used = table%used + 1
      table%points(table%used) = point
   end subroutine add_point

   !> Takes corner, axle and side of a row. Two that differ are an error.
   subroutine take_places(sheet, cells, layout, point, flaws)
      type(sheet_t), intent(in) :: sheet
      type(cells_t), intent(in) :: cells
      type(layout_t), intent(in) :: layout
      type(table_point_t), intent(inout) :: point
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: cell
      integer :: columns(2), k, axle, side
      logical :: is_place

      columns = [layout%corner, layout%axle]
      do k = 1, 2
         cell = plain_cell(sheet, cells, columns(k))
         if (cell == '') cycle
         call split_place(cell, axle, side, is_place)
         if (.not. is_place) then
            call flaws%add(point%line, 'expected a corner (FL, FR, RL, RR), an axle (front, rear) or a side, found '//shown(cell))
            cycle
         end if
         call unite(axle, point%axle, 'axle', point, flaws)
         call unite(side, point%side, 'side', point, flaws)
      end do
      cell = plain_cell(sheet, cells, layout%side)
      if (layout%side == 0) return
      call split_place(cell, axle, side, is_place)
      if (.not. is_place) call take_symmetry(cell, point%line, side, flaws)
      if (side > 0) call unite(side, point%side, 'side', point, flaws)
   end subroutine take_places

   !> Sets an axle or a side. A second, different one is an error.
   subroutine unite(new, old, what, point, flaws)
      integer, intent(in) :: new
      integer, intent(inout) :: old
      character(*), intent(in) :: what
      type(table_point_t), intent(in) :: point
      type(flaws_t), intent(inout) :: flaws

      if (new == 0) return
      if (old /= 0 .and. old /= new) call flaws%add(point%line, 'expected one '//what//' of '//shown(trim(point%name))// &
         ', found two')
      old = new
   end subroutine unite

   !> Finds the points that the names stand for. Axle and side may be part of a name.
   subroutine recognise(table, flaws)
      type(point_table_t), intent(inout) :: table
      type(flaws_t), intent(inout) :: flaws
      type(hints_t) :: hints
      type(meaning_t) :: meaning
      integer :: k

      do k = 1, table%used
         if (table%points(k)%point /= -1) cycle
         call hints_in(trim(table%points(k)%name), hints)
      end do
      do k = 1, table%used
         associate (this => table%points(k))
            if (this%point /= -1) cycle
            meaning = meaning_of(trim(this%name), hints)
            this%point = meaning%point
            if (meaning%point <= 0) cycle
            call unite(meaning%axle, this%axle, 'axle', this, flaws)
            if (this%side /= point_pair) call unite(meaning%side, this%side, 'side', this, flaws)
         end associate
      end do
   end subroutine recognise

end module ek_point_table
