!> The reader of all tables that a person, a spreadsheet or another program has written: lists of designs, curves, loads,
!> hardpoints, results to be compared. It collects all errors in a table.
!>
!> Lines that begin with # are comments, empty lines (and lines of separators alone) are skipped, and the first other line has the
!> headings. Columns are separated by commas, or by semicolons or tabs if the line of headings contains one. Also accepted are a
!> byte order mark, a first line `sep=;`, line ends of Windows and old Macs, headings and numbers in double quotes, empty cells
!> after the last heading, decimal commas if commas do not separate columns, and a row of units below the headings. Only the cells
!> of requested columns are read (ek_sheet_columns), so that other columns may contain text.
module ek_sheet
   use ek_error, only: error_t, message_list_t
   use ek_text, only: str, quoted, plural
   use ek_letters, only: is_wide, with_line_ends, line_count, save_as_utf8
   use ek_file, only: read_whole
   use ek_kept_files, only: kept_files_t, read_kept
   use ek_quantity, only: name_length
   implicit none(type, external)
   private
   public :: sheet_t, read_sheet, parse_sheet, column_of, cells_t, new_cells, split_row, plain_cell, cell_of
   public :: complain, mistakes_of, head_place

   character(*), parameter :: line_end = new_line('a'), tab = achar(9)
   integer, parameter :: max_reported = 100        !! most errors reported in the rows of one table
   integer, parameter :: max_letters = 250000000   !! most characters of a table

   !> The content of a file, with the positions of its rows. Row 0 is the line of headings.
   type :: sheet_t
      character(:), allocatable :: file
      integer :: head_line = 0                          !! line of the headings; 0: no headings
      character(name_length), allocatable :: heads(:)   !! headings; '' for a column without heading
      integer :: head_cells = 0                         !! number of cells in the line of headings, also of empty cells at its end
      type(message_list_t) :: header                    !! comments, each without its #
      integer :: rows = 0                               !! number of rows, with a row of units
      integer :: unit_row = -1                          !! 1: the first row contains units; −1: not yet known (ek_sheet_columns)
      integer, allocatable :: lines(:)                  !! line of each row
      type(message_list_t) :: head_mistakes, row_mistakes
      integer :: untold = 0                             !! number of errors beyond the largest number reported
      character :: separator = ','
      logical :: has_decimal_points = .false.  !! a comma is then not a decimal mark
      character(:), allocatable :: text
      integer, allocatable :: first(:), last(:)         !! positions of the rows in `text`
   end type sheet_t

   !> The cells of a row: their positions in the text. The arrays are longer than the number of headings.
   type :: cells_t
      integer, allocatable :: first(:), last(:)
      integer :: used = 0                               !! number of cells, without empty cells after the last heading
      integer :: whole = 0                              !! number of cells, with these empty cells
      logical :: is_closed = .true.                     !! .false.: a double quote is not closed
   end type cells_t

contains

   !> Reads a file; errors in its content are stored in the sheet.
   subroutine read_sheet(path, sheet, error, files, may_stream)
      character(*), intent(in) :: path
      type(sheet_t), intent(out) :: sheet
      type(error_t), allocatable, intent(out) :: error      !! exit_file: the file cannot be read
      type(kept_files_t), intent(in), optional :: files     !! files already read, which are not read again
      logical, intent(in), optional :: may_stream           !! see read_whole
      character(:), allocatable :: text

      if (present(files)) then
         call read_kept(files, path, text, error)
      else
         call read_whole(path, text, error, may_stream)
      end if
      if (.not. allocated(error)) call parse_sheet(text, path, sheet)
      if (allocated(error)) call parse_sheet('', path, sheet)
   end subroutine read_sheet

   !> Splits the content of a file into headings and rows.
   subroutine parse_sheet(text, file, sheet)
      character(*), intent(in) :: text, file                !! file: for messages
      type(sheet_t), intent(out) :: sheet
      integer :: first, last, line, length, lines

      sheet%file = file
      sheet%text = ''
      allocate (sheet%heads(0))
      allocate (sheet%lines(0:0), sheet%first(0:0), sheet%last(0:0), source=0)
      if (index(text, 'PK'//achar(3)//achar(4)) == 1) then
         call sheet%head_mistakes%add(file//': this is a workbook, not text; save the sheet as CSV')
         return
      else if (is_wide(text)) then
         call sheet%head_mistakes%add(file//': '//save_as_utf8)
         return
      else if (len(text) > max_letters) then
         call sheet%head_mistakes%add(file//': it has '//str(len(text)/1000000)//' MB, expected at most '// &
            str(max_letters/1000000)//' MB')
         return
      end if
      sheet%text = with_line_ends(text)
      lines = line_count(sheet%text)
      deallocate (sheet%lines, sheet%first, sheet%last)
      allocate (sheet%lines(0:lines), sheet%first(0:lines), sheet%last(0:lines), source=0)
      length = len(sheet%text)
      first = 1
      line = 0
      do while (first <= length)
         do last = first, length                       ! the library's index takes many times longer
            if (sheet%text(last:last) == line_end) exit
         end do
         last = last - 1
         line = line + 1
         call take_line(sheet, first, last, line)
         first = last + 2
      end do
      call judge_heads(sheet)
   end subroutine parse_sheet

   !> Stores one line as comment, heading or row.
   subroutine take_line(sheet, first, last, line)
      type(sheet_t), intent(inout) :: sheet
      integer, intent(in) :: first, last, line
      integer :: from, to

      if (verify(sheet%text(first:last), ' ,;"'//tab) == 0) return
      if (is_comment(sheet%text(first:last), sheet%head_line > 0)) then
         from = first + index(sheet%text(first:last), '#')
         if (from <= last) then
            if (sheet%text(from:from) == ' ') from = from + 1
         end if
         to = verify(sheet%text(:last), ' ,;"'//tab, back=.true.)       ! a spreadsheet adds separators to a comment
         call sheet%header%add(sheet%text(from:to))
      else if (sheet%head_line == 0 .and. index(sheet%text(first:last), 'sep=') == 1 .and. &
         len_trim(sheet%text(first:last)) == 5) then
         sheet%separator = sheet%text(first + 4:first + 4)          ! a line of Excel; the line of heads decides
      else if (sheet%head_line == 0) then
         sheet%head_line = line
         sheet%first(0) = first
         sheet%last(0) = last
         sheet%lines(0) = line
         call take_heads(sheet)
      else
         sheet%rows = sheet%rows + 1
         sheet%first(sheet%rows) = first
         sheet%last(sheet%rows) = last
         sheet%lines(sheet%rows) = line
      end if
   end subroutine take_line

   !> Whether a line is a comment: it begins with # or "#. After the headings, a line that begins with the error value of a
   !> spreadsheet, such as #REF!, is not a comment.
   pure logical function is_comment(content, has_heads)
      character(*), intent(in) :: content
      logical, intent(in) :: has_heads
      character(*), parameter :: cell_errors(8) = [character(7) :: '#REF!', '#DIV/0!', '#NAME?', '#VALUE!', '#N/A', '#NUM!', &
         '#NULL!', '#SPILL!']
      integer :: at, k

      at = verify(content, ' '//tab)
      is_comment = .false.
      if (at == 0) return
      if (content(at:at) == '"') at = min(at + 1, len(content))
      is_comment = content(at:at) == '#'
      if (.not. is_comment .or. .not. has_heads) return
      is_comment = .not. any([(index(content(at:), trim(cell_errors(k))) == 1, k=1, size(cell_errors))])
   end function is_comment

   !> Reads the line of headings, which also defines the separator of the columns.
   subroutine take_heads(sheet)
      type(sheet_t), intent(inout) :: sheet
      type(cells_t) :: cells
      integer :: k, columns

      associate (content => sheet%text(sheet%first(0):sheet%last(0)))
         if (index(content, ',') > 0) sheet%separator = ','
         if (index(content, tab) > 0) sheet%separator = tab
         if (index(content, ';') > 0) sheet%separator = ';'
         allocate (cells%first(len(content) + 1), cells%last(len(content) + 1))
      end associate
      call split_row(sheet, 0, cells)
      if (.not. cells%is_closed) call sheet%head_mistakes%add(head_place(sheet)//'a double quote is not closed')
      sheet%head_cells = cells%whole
      columns = cells%used
      do while (columns > 1)                         ! separators behind the last head; the line has other characters too
         if (plain_cell(sheet, cells, columns) /= '') exit
         columns = columns - 1
      end do
      deallocate (sheet%heads)
      allocate (sheet%heads(columns))
      do k = 1, columns
         sheet%heads(k) = plain_cell(sheet, cells, k)
      end do
   end subroutine take_heads

   !> Checks that no heading is given twice, and that the file has rows.
   subroutine judge_heads(sheet)
      type(sheet_t), intent(inout) :: sheet
      integer :: k, j

      if (sheet%head_line == 0) then
         call sheet%head_mistakes%add(sheet%file//': the line of column names is missing')
         return
      end if
      do k = 2, size(sheet%heads)
         if (sheet%heads(k) == '') cycle
         do j = 1, k - 1
            if (sheet%heads(j) (:16) /= sheet%heads(k) (:16)) cycle          ! quicker than whole names, mostly blanks
            if (sheet%heads(j) == sheet%heads(k)) exit
         end do
         if (j < k) call sheet%head_mistakes%add(head_place(sheet)//'the column '//quoted(sheet%heads(k))// &
            ' is given twice, as column '//str(j)//' and column '//str(k)//'; remove or rename one')
      end do
      if (sheet%rows == 0) call sheet%row_mistakes%add(sheet%file//': the table has no rows')
   end subroutine judge_heads

   !> Index of the column with a heading; 0 if there is none. Letter case matters.
   pure integer function column_of(sheet, heading) result(place)
      type(sheet_t), intent(in) :: sheet
      character(*), intent(in) :: heading

      do place = 1, size(sheet%heads)
         if (heading /= '' .and. sheet%heads(place) == heading) return
      end do
      place = 0
   end function column_of

   !> Room for the cells of a row.
   pure type(cells_t) function new_cells(sheet) result(cells)
      type(sheet_t), intent(in) :: sheet
      allocate (cells%first(size(sheet%heads) + 1), cells%last(size(sheet%heads) + 1))
   end function new_cells

   !> Finds the positions of the cells of a row, without blanks at both ends. Cells beyond the arrays are counted if they are not
   !> empty.
   pure subroutine split_row(sheet, row, cells)
      type(sheet_t), intent(in) :: sheet
      integer, intent(in) :: row
      type(cells_t), intent(inout) :: cells
      logical :: is_quoted
      integer :: at, begin, last, used

      is_quoted = .false.
      begin = sheet%first(row)
      last = sheet%last(row)
      used = 0
      cells%used = 0
      do at = begin, last + 1
         if (at <= last) then
            if (sheet%text(at:at) == '"') is_quoted = .not. is_quoted
            if (is_quoted .or. sheet%text(at:at) /= sheet%separator) cycle
         end if
         used = used + 1
         call add_cell(begin, at - 1, cells)
         begin = at + 1
      end do
      cells%whole = used
      cells%is_closed = .not. is_quoted

   contains

      !> Adds a cell without the blanks at both ends.
      pure subroutine add_cell(from, to, cells)
         integer, intent(in) :: from, to
         type(cells_t), intent(inout) :: cells
         integer :: a, b

         a = from
         b = to
         do while (a <= b)
            if (sheet%text(a:a) /= ' ' .and. sheet%text(a:a) /= tab) exit
            a = a + 1
         end do
         do while (b >= a)
            if (sheet%text(b:b) /= ' ' .and. sheet%text(b:b) /= tab) exit
            b = b - 1
         end do
         if (used <= size(cells%first)) then
            cells%first(used) = a
            cells%last(used) = b
         end if
         if (used <= size(sheet%heads) .or. sheet%text(a:b) /= '') cells%used = used
      end subroutine add_cell

   end subroutine split_row

   !> The text of a cell without its quotes.
   pure function plain_cell(sheet, cells, place) result(text)
      type(sheet_t), intent(in) :: sheet
      type(cells_t), intent(in) :: cells
      integer, intent(in) :: place
      character(:), allocatable :: text
      character(:), allocatable :: raw
      integer :: k
      logical :: is_quoted

      text = ''
      if (place < 1 .or. place > min(cells%used, size(cells%first))) return
      raw = sheet%text(cells%first(place):cells%last(place))
      text = raw
      if (index(raw, '"') == 0) return
      text = ''
      is_quoted = .false.
      k = 1
      do while (k <= len(raw))
         if (raw(k:k) == '"') then
            if (is_quoted .and. raw(k:min(k + 1, len(raw))) == '""') then
               text = text//'"'
               k = k + 1
            else
               is_quoted = .not. is_quoted
            end if
         else
            text = text//raw(k:k)
         end if
         k = k + 1
      end do
      text = trim(adjustl(text))
   end function plain_cell

   !> The text of a cell, without quotes; '' if the row is too short. Row 0 is the line of headings.
   pure function cell_of(sheet, row, place) result(text)
      type(sheet_t), intent(in) :: sheet
      integer, intent(in) :: row, place
      character(:), allocatable :: text
      type(cells_t) :: cells

      cells = new_cells(sheet)
      call split_row(sheet, row, cells)
      text = plain_cell(sheet, cells, place)
   end function cell_of

   !> Adds an error in a row, with its location. Only the first 100 errors are stored; further errors are counted.
   subroutine complain(sheet, row, what)
      type(sheet_t), intent(inout) :: sheet
      integer, intent(in) :: row
      character(*), intent(in) :: what

      if (sheet%row_mistakes%count() < max_reported) then
         call sheet%row_mistakes%add(sheet%file//':'//str(sheet%lines(row))//': '//what)
      else
         sheet%untold = sheet%untold + 1
      end if
   end subroutine complain

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

end module ek_sheet
