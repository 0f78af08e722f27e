!> A table of numbers written by hand or by a spreadsheet; the reader collects all errors in it.
!>
!> Lines that begin with # are comments, empty lines (and lines of separators alone) are skipped, and the first other line has the
!> headings. Columns are separated by commas, or by semicolons or tabs if the line of headings contains one. Also accepted are a
!> byte order mark, a first line `sep=;`, line ends of Windows and old Macs, headings and numbers in double quotes, empty cells
!> after the last heading, and decimal commas if commas do not separate columns.
module ek_sheet
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t
   use ek_text, only: str, quoted, plural
   use ek_letters, only: is_wide, with_line_ends, line_count, save_as_utf8
   use ek_file, only: read_whole
   use ek_kept_files, only: kept_files_t, read_kept
   use ek_decimal, only: get_decimal
   use ek_buffer, only: buffer_t
   use ek_quantity, only: name_length
   implicit none(type, external)
   private
   public :: sheet_t, read_sheet, mistakes_of, head_place, take_record

   character(*), parameter :: line_end = new_line('a'), tab = achar(9)
   real(wp), parameter :: most = 1.0e31_wp      !! numbers of this size are errors, and could overflow later
   integer, parameter :: max_reported = 100        !! most errors reported in the rows of one table

   !> The content of a file. Rows with an error are omitted from the values.
   type :: sheet_t
      character(:), allocatable :: file
      integer :: head_line = 0                          !! line of the headings; 0: no headings
      character(name_length), allocatable :: heads(:)   !! headings; '' for a column without heading
      real(wp), allocatable :: values(:, :)             !! numbers (column, row)
      type(message_list_t) :: head_mistakes, row_mistakes
      integer :: untold = 0                             !! number of errors beyond the largest number reported
      character :: separator = ','
      logical :: has_decimal_points = .false.            !! a comma is then not a decimal mark
   end type sheet_t

contains

   !> Reads a file; errors in its content are stored in the sheet.
   subroutine read_sheet(path, sheet, error, files)
      character(*), intent(in) :: path
      type(sheet_t), intent(out) :: sheet
      type(error_t), allocatable, intent(out) :: error      !! exit_file: the file cannot be read
      type(kept_files_t), intent(in), optional :: files     !! files already read, which are not read again
      character(:), allocatable :: text, content
      integer :: first, last, line, rows
      logical, allocatable :: is_unnamed(:)

      sheet%file = path
      allocate (sheet%heads(0), sheet%values(0, 0), is_unnamed(0))
      if (present(files)) then
         call read_kept(files, path, text, error)
      else
         call read_whole(path, text, error)
      end if
      if (allocated(error)) return
      if (index(text, 'PK'//achar(3)//achar(4)) == 1) then
         call sheet%head_mistakes%add(path//': this is a workbook, not text; save the sheet as CSV')
         return
      else if (is_wide(text)) then
         call sheet%head_mistakes%add(path//': '//save_as_utf8)
         return
      end if
      text = with_line_ends(text)
      first = 1
      line = 0
      rows = 0
      do while (first <= len(text))
         last = index(text(first:), line_end) + first - 2
         if (last < first - 1) last = len(text)
         line = line + 1
         content = text(first:last)
         if (is_comment(content, sheet) .or. verify(content, ' ,;"'//tab) == 0) then
            continue
         else if (sheet%head_line == 0 .and. index(content, 'sep=') == 1 .and. len_trim(content) == 5) then
            sheet%separator = content(5:5)               ! a line of Excel; the line of heads decides
         else if (sheet%head_line == 0) then
            sheet%head_line = line
            call take_heads(content, sheet)
            call find_decimal_marks(text(last + 1:), sheet)
            deallocate (is_unnamed, sheet%values)
            allocate (is_unnamed(size(sheet%heads)), source=.false.)
            allocate (sheet%values(size(sheet%heads), line_count(text(last + 1:))), source=0.0_wp)
         else
            call take_row(content, line, sheet, rows, is_unnamed)
         end if
         first = last + 2
      end do
      call judge_heads(sheet, rows, is_unnamed)
   end subroutine read_sheet

   !> Adds all errors of a sheet to a list of messages; errors of the headings come first.
   subroutine mistakes_of(sheet, mistakes)
      type(sheet_t), intent(in) :: sheet
      type(message_list_t), intent(inout) :: mistakes
      integer :: k

      do k = 1, sheet%head_mistakes%count()
         call mistakes%add(sheet%head_mistakes%line(k))
      end do
      do k = 1, sheet%row_mistakes%count()
         call mistakes%add(sheet%row_mistakes%line(k))
      end do
      if (sheet%untold > 0) call mistakes%add(sheet%file//': and '//plural(sheet%untold, 'more error', 'more errors'))
   end subroutine mistakes_of

   !> Location for a message about the headings: 'table.csv:1: '.
   pure function head_place(sheet) result(words)
      type(sheet_t), intent(in) :: sheet
      character(:), allocatable :: words
      words = sheet%file//':'//str(sheet%head_line)//': '
   end function head_place

   !> Whether a line is a comment: it begins with # or "#. After the headings, a line that begins with the error value of a
   !> spreadsheet, such as #REF!, is not a comment.
   pure logical function is_comment(content, sheet)
      character(*), intent(in) :: content
      type(sheet_t), intent(in) :: sheet
      character(*), parameter :: cell_errors(8) = [character(7) :: '#REF!', '#DIV/0!', '#NAME?', '#VALUE!', '#N/A', '#NUM!', &
         '#NULL!', '#SPILL!']
      integer :: k

      is_comment = index(content, '#') == 1 .or. index(content, '"#') == 1
      if (.not. is_comment .or. sheet%head_line == 0) return
      is_comment = .not. any([(index(content(:min(9, len(content))), trim(cell_errors(k))) > 0, k=1, size(cell_errors))])
   end function is_comment

   !> Reads the line of headings, which also defines the separator of the columns.
   subroutine take_heads(content, sheet)
      character(*), intent(in) :: content
      type(sheet_t), intent(inout) :: sheet
      type(message_list_t) :: cells
      integer :: at, line, k, columns
      logical :: is_closed

      if (index(content, ',') > 0) sheet%separator = ','
      if (index(content, tab) > 0) sheet%separator = tab
      if (index(content, ';') > 0) sheet%separator = ';'
      at = 1
      line = sheet%head_line
      call take_record(content, sheet%separator, at, line, cells, is_closed)
      if (.not. is_closed) call sheet%head_mistakes%add(head_place(sheet)//'a double quote is not closed')
      columns = cells%count()
      do while (cells%line(columns) == '')         ! separators behind the last head; the line has other characters too
         columns = columns - 1
      end do
      deallocate (sheet%heads)
      allocate (sheet%heads(columns))
      do k = 1, columns
         sheet%heads(k) = adjustl(cells%line(k))
      end do
   end subroutine take_heads

   !> Records whether the lines after the headings, other than comments, contain decimal points. If they contain none, commas that
   !> do not separate columns are decimal commas.
   pure subroutine find_decimal_marks(text, sheet)
      character(*), intent(in) :: text
      type(sheet_t), intent(inout) :: sheet
      integer :: first, last

      if (sheet%separator == ',') return
      first = 1
      do while (first <= len(text))
         last = index(text(first:), line_end) + first - 2
         if (last < first - 1) last = len(text)
         if (text(first:min(first, len(text))) /= '#') then
            sheet%has_decimal_points = sheet%has_decimal_points .or. index(text(first:last), '.') > 0
         end if
         first = last + 2
      end do
   end subroutine find_decimal_marks

   !> Reads one line of numbers and adds the line to the rows if it has no error.
   subroutine take_row(content, line, sheet, rows, is_unnamed)
      character(*), intent(in) :: content
      integer, intent(in) :: line
      type(sheet_t), intent(inout) :: sheet
      integer, intent(inout) :: rows
      logical, intent(inout) :: is_unnamed(:)     !! columns without a heading that have values
      type(message_list_t) :: cells
      character(:), allocatable :: fault, where, cell
      real(wp) :: row(size(sheet%heads))
      integer :: at, next, k, n, columns
      logical :: is_good

      where = sheet%file//':'//str(line)//': '
      at = 1
      next = line
      call take_record(content, sheet%separator, at, next, cells, is_good)
      if (.not. is_good) then
         call complain(sheet, where//'a double quote is not closed')
         return
      end if
      columns = size(sheet%heads)
      do n = cells%count(), columns + 1, -1        ! empty cells behind the last head are ignored
         if (cells%line(n) /= '') exit
      end do
      if (n /= columns) then
         fault = where//'expected '//plural(columns, 'value', 'values')//', found '//str(n)
         if (n > columns .and. sheet%separator == ',' .and. index(content, '.') == 0) fault = fault// &
            ' (if some of the commas are decimal commas: write decimal points, or separate the columns by semicolons)'
         call complain(sheet, fault)
         return
      end if
      row = 0.0_wp
      do k = 1, columns
         cell = trim(adjustl(cells%line(k)))
         if (sheet%heads(k) == '') then
            is_unnamed(k) = is_unnamed(k) .or. cell /= ''
            cycle
         end if
         call read_number(cell, sheet, row(k), fault)
         if (fault == '') cycle
         call complain(sheet, where//'column '//quoted(sheet%heads(k))//': '//fault)
         is_good = .false.
      end do
      if (.not. is_good) return
      rows = rows + 1
      sheet%values(:, rows) = row
   end subroutine take_row

   !> Reads the number in a cell, or describes the error in the cell.
   subroutine read_number(cell, sheet, value, fault)
      character(*), intent(in) :: cell
      type(sheet_t), intent(in) :: sheet
      real(wp), intent(out) :: value
      character(:), allocatable, intent(out) :: fault
      character(:), allocatable :: text
      real(wp) :: ignored
      logical :: is_number
      integer :: comma, blank

      value = 0.0_wp
      fault = ''
      text = cell
      comma = index(text, ',')
      if (comma > 0 .and. comma == index(text, ',', back=.true.) .and. index(text, '.') == 0 .and. &
         sheet%separator /= ',' .and. .not. sheet%has_decimal_points) text(comma:comma) = '.'
      call get_decimal(text, value, is_number)
      if (is_number) then
         if (.not. ieee_is_finite(value)) then
            fault = 'expected a finite number, found '//quoted(cell)
         else if (abs(value) >= most) then
            fault = 'expected a number below '//str(most)//', found '//quoted(cell)
         end if
         return
      end if
      if (cell == '') then
         fault = 'expected a number, found an empty cell'
      else if (verify(cell, '+-.0123456789eEdD') == 0 .and. scan(cell, '0123456789') > 0 .and. scan(cell, 'eEdD') > 1) then
         fault = 'expected a number below '//str(most)//', found '//quoted(cell)
      else
         fault = 'expected a number, found '//quoted(cell)
         blank = scan(cell, ' abcdfghijklmnopqrstuvwxyzABCDFGHIJKLMNOPQRSTUVWXYZ%')
         if (index(cell, ',') > 0 .and. index(cell, '.') > 0) then
            fault = fault//' (write numbers without thousands separators)'
         else if (index(cell, ',') > 0) then
            fault = fault//' (write a decimal point, here and in all numbers of the file)'
         else if (index(cell, char(226)//char(136)//char(146)) == 1 .or. index(cell, char(226)//char(128)//char(147)) == 1) then
            fault = fault//' (write the minus sign as -)'
         else if (blank > 1) then
            call get_decimal(cell(:blank - 1), ignored, is_number)
            if (is_number) fault = fault//' (write the number alone; its unit is given in the column name)'
         end if
      end if
   end subroutine read_number

   !> Checks the headings, and that the file has rows.
   subroutine judge_heads(sheet, rows, is_unnamed)
      type(sheet_t), intent(inout) :: sheet
      integer, intent(in) :: rows
      logical, intent(in) :: is_unnamed(:)
      integer :: k, j

      if (sheet%head_line == 0) then
         call sheet%head_mistakes%add(sheet%file//': the line of column names is missing')
         return
      end if
      do k = 1, size(sheet%heads)
         if (sheet%heads(k) == '') then
            if (is_unnamed(k)) call sheet%head_mistakes%add(head_place(sheet)//'column '//str(k)//' has no name')
            cycle
         end if
         j = findloc(sheet%heads(:k) == sheet%heads(k), .true., dim=1)
         if (j < k) call sheet%head_mistakes%add(head_place(sheet)//'the column '//quoted(sheet%heads(k))// &
            ' is given twice, as column '//str(j)//' and column '//str(k)//'; remove or rename one')
      end do
      sheet%values = sheet%values(:, :rows)
      if (rows == 0 .and. sheet%row_mistakes%count() == 0) &
         call sheet%row_mistakes%add(sheet%file//': the table has no rows')
   end subroutine judge_heads

   !> Adds an error in a row. Only the first 100 errors are stored; further errors are counted.
   subroutine complain(sheet, what)
      type(sheet_t), intent(inout) :: sheet
      character(*), intent(in) :: what

      if (sheet%row_mistakes%count() < max_reported) then
         call sheet%row_mistakes%add(what)
      else
         sheet%untold = sheet%untold + 1
      end if
   end subroutine complain

   !> Reads the cells of one record, which may span several lines. A quoted cell that is not closed ends with the file.
   subroutine take_record(text, separator, at, line, fields, is_closed)
      character(*), intent(in) :: text
      character, intent(in) :: separator
      integer, intent(inout) :: at, line          !! position and line where the record begins; on return, of the next record
      type(message_list_t), intent(out) :: fields
      logical, intent(out) :: is_closed
      type(buffer_t) :: cell
      logical :: is_quoted

      is_quoted = .false.
      do while (at <= len(text))
         if (is_quoted) then
            if (text(at:at) /= '"') then
               call cell%add(text(at:at))
               if (text(at:at) == line_end) line = line + 1
            else if (text(at:min(at + 1, len(text))) == '""') then
               call cell%add('"')
               at = at + 1
            else
               is_quoted = .false.
            end if
         else if (text(at:at) == '"') then
            is_quoted = .true.
         else if (text(at:at) == separator) then
            call fields%add(cell%text())
            call cell%clear()
         else if (text(at:at) == line_end) then
            line = line + 1
            at = at + 1
            exit
         else if (text(at:at) /= achar(13)) then
            call cell%add(text(at:at))
         end if
         at = at + 1
      end do
      call fields%add(cell%text())
      is_closed = .not. is_quoted
   end subroutine take_record

end module ek_sheet
