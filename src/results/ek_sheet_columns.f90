!> The numbers in columns of a table (ek_sheet), with all errors in the cells of these columns. Cells of other columns are not read.
module ek_sheet_columns
   use ek_kinds, only: wp
   use ek_text, only: str, quoted, plural
   use ek_sheet, only: sheet_t, cells_t, new_cells, split_row, plain_cell, cell_of, complain
   use ek_sheet_cell, only: get_cell, cell_fault
   use ek_unit_row, only: is_unit, is_same_unit
   implicit none(type, external)
   private
   public :: take_columns, find_unit_row, find_decimal_marks, is_decimal_comma, has_numbers, row_fault

   !> Cells that take_columns accepts besides finite numbers; all of them are read as nan, except inf.
   integer, parameter, public :: numbers_only = 0, or_nan = 1, or_empty = 2, or_text = 3

contains

   !> Finds whether the first row contains units: one of the given columns contains a unit, and the others a unit, '-' or nothing.
   pure subroutine find_unit_row(sheet, places)
      type(sheet_t), intent(inout) :: sheet
      integer, intent(in) :: places(:)             !! columns
      character(:), allocatable :: cell
      integer :: k, count

      sheet%unit_row = 0
      if (sheet%rows < 1) return
      count = 0
      do k = 1, size(places)
         cell = cell_of(sheet, 1, places(k))
         if (cell == '' .or. cell == '-') cycle
         if (.not. is_unit(cell)) return
         count = count + 1
      end do
      if (count > 0) sheet%unit_row = 1
   end subroutine find_unit_row

   !> Reads the numbers of columns. An empty cell, a string or nan in one of these columns is an error, as is a row with too few or
   !> too many cells; errors are stored in the sheet. A row of units is checked and has no values.
   subroutine take_columns(sheet, places, values, units, accepts)
      type(sheet_t), intent(inout) :: sheet
      integer, intent(in) :: places(:)                     !! columns
      real(wp), allocatable, intent(out) :: values(:, :)   !! (place, row)
      character(*), intent(in), optional :: units(:)       !! expected unit of each column; '': not checked
      integer, intent(in), optional :: accepts             !! numbers_only (default), or_nan, or_empty, or_text
      type(cells_t) :: cells
      character(:), allocatable :: fault
      logical :: is_good, has_commas
      integer :: accepted
      integer :: row, k

      accepted = numbers_only
      if (present(accepts)) accepted = accepts
      cells = new_cells(sheet)
      if (sheet%unit_row < 0) call find_unit_row(sheet, places)
      if (sheet%unit_row > 0 .and. present(units)) call check_units(sheet, places, units)
      call find_decimal_marks(sheet, places)
      has_commas = is_decimal_comma(sheet)
      allocate (values(size(places), sheet%rows - sheet%unit_row))
      do row = sheet%unit_row + 1, sheet%rows
         call split_row(sheet, row, cells)
         fault = row_fault(sheet, row, cells, maxval(places))
         if (fault /= '') then
            call complain(sheet, row, fault)
            values(:, row - sheet%unit_row) = 0.0_wp
            cycle
         end if
         do k = 1, size(places)
            associate (value => values(k, row - sheet%unit_row), first => cells%first(places(k)), last => cells%last(places(k)))
               if (first > last) then
                  call get_cell('', has_commas, value, is_good)
                  is_good = accepted >= or_empty
               else if (sheet%text(first:first) == '"') then
                  call get_cell(plain_cell(sheet, cells, places(k)), has_commas, value, is_good, accepted >= or_nan)
               else
                  call get_cell(sheet%text(first:last), has_commas, value, is_good, accepted >= or_nan)
               end if
               if (is_good .or. accepted == or_text) cycle
               call complain(sheet, row, 'column '//quoted(sheet%heads(places(k)))//': '// &
                  cell_fault(plain_cell(sheet, cells, places(k)), has_commas))
            end associate
         end do
      end do
      if (sheet%rows > 0 .and. sheet%rows == sheet%unit_row) call sheet%row_mistakes%add(sheet%file//': the table has no rows')
   end subroutine take_columns

   !> Describes a row with too few or too many cells; '' if the row has as many cells as there are headings. Empty cells after the
   !> last heading do not count, and cells after the last requested column may be missing. A row in which commas may be both
   !> separators and decimal marks is an error.
   function row_fault(sheet, row, cells, last) result(fault)
      type(sheet_t), intent(in) :: sheet
      integer, intent(in) :: row
      type(cells_t), intent(in) :: cells
      integer, intent(in) :: last                  !! last requested column
      character(:), allocatable :: fault

      fault = ''
      if (cells%is_closed .and. cells%used <= size(sheet%heads) .and. cells%used >= last) then
         fault = comma_fault(sheet, cells, last)
         return
      end if
      if (.not. cells%is_closed) then
         fault = 'a double quote is not closed'
         return
      end if
      fault = 'expected '//plural(size(sheet%heads), 'value', 'values')//', found '//str(cells%used)
      if (cells%used > size(sheet%heads) .and. sheet%separator == ',' .and. &
         index(sheet%text(sheet%first(row):sheet%last(row)), '.') == 0) fault = fault//' (if some of the commas are '// &
         'decimal commas: write decimal points, or separate the columns by semicolons)'
   end function row_fault

   !> Describes a row whose commas may be decimal commas: without a decimal point in the columns that are read, 1,5,20, may be 1.5 and
   !> 20 or 1, 5 and 20 where the last column is empty, and 1,05 may be 1.05. '' for other rows.
   function comma_fault(sheet, cells, last) result(fault)
      type(sheet_t), intent(in) :: sheet           !! after find_decimal_marks
      type(cells_t), intent(in) :: cells           !! of a row with enough cells
      integer, intent(in) :: last                  !! last requested column
      character(:), allocatable :: fault
      integer :: k

      fault = ''
      if (sheet%separator /= ',' .or. sheet%has_decimal_points) return
      if (cells%whole /= sheet%head_cells .and. cells%whole > last) then
         fault = 'expected '//plural(sheet%head_cells, 'cell', 'cells')//', found '//str(cells%whole)
      else
         do k = 2, last
            if (cells%last(k) <= cells%first(k) .or. cells%last(k - 1) < cells%first(k - 1)) cycle
            associate (cell => sheet%text(cells%first(k):cells%last(k)), mark => cells%last(k - 1))
               if (verify(cell, '0123456789') > 0 .or. cell(1:1) /= '0') cycle
               if (verify(sheet%text(mark:mark), '0123456789') > 0) cycle
               fault = 'column '//quoted(sheet%heads(k))//': expected a number, found '//quoted(cell)
               exit
            end associate
         end do
      end if
      if (fault /= '') fault = fault//' (commas may be separators or decimal commas: write decimal points, for example 1.0, or '// &
         'separate the columns by semicolons)'
   end function comma_fault

   !> Adds an error for each unit of the row of units that is not the expected unit.
   subroutine check_units(sheet, places, units)
      type(sheet_t), intent(inout) :: sheet
      integer, intent(in) :: places(:)
      character(*), intent(in) :: units(:)
      character(:), allocatable :: found
      integer :: k

      do k = 1, size(places)
         found = cell_of(sheet, 1, places(k))
         if (units(k) == '' .or. units(k) == '-' .or. found == '' .or. found == '-') cycle
         if (.not. is_same_unit(found, trim(units(k)))) call complain(sheet, 1, 'column '// &
            quoted(sheet%heads(places(k)))//': expected the unit '//quoted(trim(units(k)))//', found '//quoted(found)// &
            '; convert the numbers of the column')
      end do
   end subroutine check_units

   !> Finds whether the cells of columns contain decimal points. If they contain none, commas that do not separate columns are
   !> decimal commas, and commas that separate columns may be decimal commas (row_fault).
   subroutine find_decimal_marks(sheet, places)
      type(sheet_t), intent(inout) :: sheet
      integer, intent(in) :: places(:)
      type(cells_t) :: cells
      integer :: row, k

      cells = new_cells(sheet)
      sheet%has_decimal_points = .false.
      if (sheet%rows == 0) return
      associate (content => sheet%text(sheet%first(1):))
         if (index(content, ',') == 0 .or. index(content, '.') == 0) return
      end associate
      do row = sheet%unit_row + 1, sheet%rows
         call split_row(sheet, row, cells)
         do k = 1, size(places)
            if (places(k) > cells%used .or. places(k) < 1) cycle
            if (index(sheet%text(cells%first(places(k)):cells%last(places(k))), '.') == 0) cycle
            sheet%has_decimal_points = .true.
            return
         end do
      end do
   end subroutine find_decimal_marks

   !> Whether a comma in a number is a decimal mark, known after find_decimal_marks.
   pure logical function is_decimal_comma(sheet)
      type(sheet_t), intent(in) :: sheet
      is_decimal_comma = sheet%separator /= ',' .and. .not. sheet%has_decimal_points
   end function is_decimal_comma

   !> Whether each column contains a number. A column of text does not.
   function has_numbers(sheet, may_be_nan) result(has)
      type(sheet_t), intent(in) :: sheet
      logical, intent(in), optional :: may_be_nan          !! nan and inf are numbers; default .false.
      logical :: has(size(sheet%heads))
      type(cells_t) :: cells
      real(wp) :: value
      logical :: is_good
      integer :: row, k

      has = .false.
      cells = new_cells(sheet)
      do row = 1, sheet%rows
         if (all(has)) return
         call split_row(sheet, row, cells)
         do k = 1, min(size(has), cells%used)
            if (has(k)) cycle
            call get_cell(plain_cell(sheet, cells, k), sheet%separator /= ',', value, is_good, may_be_nan)
            if (is_good) has(k) = .true.
         end do
      end do
   end function has_numbers

end module ek_sheet_columns
