!> Tables of hardpoints as people write them: one row for each point, with the columns x, y, z once (and perhaps columns `corner`,
!> `axle`, `side`), or once for each corner, axle or side ('FL x', 'rear_y', 'Left Z [mm]', or a line of corners above the
!> headings).
!> Other columns, as an index or remarks, are not read. The result is data: names are recognised by ek_point_name, numbers are
!> in the columns and the unit of the table.
module ek_point_table
   use ek_kinds, only: wp
   use ek_text, only: str, lower, plural
   use ek_letters, only: with_line_ends
   use ek_sheet, only: sheet_t, parse_sheet, cells_t, new_cells, split_row, plain_cell, cell_of
   use ek_sheet_cell, only: get_cell, cell_fault
   use ek_sheet_columns, only: find_unit_row, find_decimal_marks, is_decimal_comma, row_fault
   use ek_unit_word, only: unit_of, length_unit
   use ek_flaws, only: flaws_t, shown
   use ek_hardpoint, only: take_symmetry, single_point, point_pair, left_point, right_point
   use ek_point_name, only: meaning_t, hints_t, meaning_of, hints_in, nearest_point
   use ek_vote, only: length_names, length_values
   implicit none(type, external)
   private
   public :: table_point_t, point_table_t, not_a_point, parse_points, split_place, take_length, recognise, add_point

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

   !> Splits a heading into corner, axle or side, the letters that remain, and its unit [m]; 0 if it names none: 'FL x [mm]'.
   subroutine split_head(text, axle, side, head, unit)
      character(*), intent(in) :: text
      integer, intent(out) :: axle, side
      character(:), allocatable, intent(out) :: head
      real(wp), intent(out) :: unit
      character(*), parameter :: idle(13) = [character(10) :: 'coordinate', 'coord', 'value', 'position', 'pos', 'location', &
         'loc', 'achse', 'axis', 'wert', 'of', 'the', 'in']
      character(:), allocatable :: folded, word, others
      integer :: at, next, a, s
      logical :: is_place

      axle = 0
      side = 0
      unit = 0.0_wp
      head = ''
      others = ''
      folded = lower(text(:min(len(text), 200)))
      at = 1
      do while (at <= len(folded))
         next = verify(folded(at:), 'abcdefghijklmnopqrstuvwxyz')
         if (next == 0) next = len(folded) - at + 2
         word = folded(at:at + next - 2)
         at = at + max(next, 1)
         if (word == '') cycle
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
      if (others /= '') then
         head = head//others
         do at = 1, size(idle)                    ! xvalue, locx: one word of two
            if (len(head) /= len_trim(idle(at)) + 1) cycle
            if (head(2:) == idle(at) .and. scan(head(1:1), 'xyz') == 1) head = head(1:1)
            if (len(head) == 1) exit
            if (head(:len(head) - 1) == idle(at) .and. scan(head(len(head):), 'xyz') == 1) head = head(len(head):)
            if (len(head) == 1) exit
         end do
      end if
      if (head == '' .and. (axle > 0 .or. side > 0)) head = 'place'
      if (head == '' .and. index(folded, 'achse') > 0) head = 'achse'
   end subroutine split_head

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
      do c = 1, 3
         if (is_good(c)) cycle
         call flaws%add(sheet%lines(row), 'xyz'(c:c)//' of '//shown(name)//': '// &
            cell_fault(plain_cell(sheet, cells, block%columns(c)), is_decimal_comma(sheet)))
      end do
      if (name == '' .and. any(is_good)) call flaws%add(sheet%lines(row), 'expected the name of a hardpoint, found nothing')
      if (name == '' .or. .not. all(is_good)) return
      point%name = name
      point%line = sheet%lines(row)
      point%axle = block%axle
      point%side = block%side
      call take_places(sheet, cells, layout, point, flaws)
      call add_point(point, table, flaws)
   end subroutine take_block

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
