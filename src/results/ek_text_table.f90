!> A table of strings that is read from comma-separated values (RFC 4180): a line of column names, then one line per row.
!>
!> Cells may be quoted. Lines of a file that begin with # are skipped, and so are empty lines. The blank that precedes text that a
!> spreadsheet would read as a formula (ek_frame) is removed.
module ek_text_table
   use ek_error, only: error_t, message_list_t, fail, exit_file
   use ek_text, only: str, quoted, plural
   use ek_buffer, only: buffer_t
   use ek_frame, only: bare_cell
   use ek_file, only: read_whole
   use ek_letters, only: with_line_ends
   implicit none(type, external)
   private
   public :: text_table_t, new_text_table, add_row, read_text_table, cell_of

   character(*), parameter :: line_end = new_line('a')

   !> A string with its own length.
   type :: cell_t
      character(:), allocatable :: text
   end type cell_t

   type :: text_table_t
      character(:), allocatable :: file             !! source file, for messages
      character(32), allocatable :: columns(:)
      type(cell_t), allocatable :: cells(:, :)      !! cells: (column, row); the first `rows` rows are in use
      integer, allocatable :: lines(:)              !! line of each row in its file
      integer :: rows = 0
   end type text_table_t

contains

   !> A table without rows.
   pure type(text_table_t) function new_text_table(columns) result(table)
      character(*), intent(in) :: columns(:)

      table%file = ''
      allocate (table%columns(size(columns)), table%cells(size(columns), 8), table%lines(8))
      table%columns = columns
   end function new_text_table

   !> Begins a row of empty cells. The caller must set table%cells(k, table%rows)%text.
   pure subroutine add_row(table, line)
      type(text_table_t), intent(inout) :: table
      integer, intent(in), optional :: line
      type(cell_t), allocatable :: grown(:, :)
      integer :: k

      if (table%rows == size(table%cells, 2)) then
         allocate (grown(size(table%columns), 2*table%rows))
         grown(:, :table%rows) = table%cells
         call move_alloc(grown, table%cells)
         table%lines = [table%lines, table%lines]
      end if
      table%rows = table%rows + 1
      table%lines(table%rows) = 0
      if (present(line)) table%lines(table%rows) = line
      do k = 1, size(table%columns)
         table%cells(k, table%rows)%text = ''
      end do
   end subroutine add_row

   !> The cell of a row in a named column; '' if there is no such column.
   pure function cell_of(table, row, column) result(text)
      type(text_table_t), intent(in) :: table
      integer, intent(in) :: row
      character(*), intent(in) :: column
      character(:), allocatable :: text
      integer :: k

      text = ''
      do k = 1, size(table%columns)
         if (table%columns(k) == column) text = table%cells(k, row)%text
      end do
   end function cell_of

   !> Reads a table from a CSV file, as written by ek_frame, also after a spreadsheet has saved it with semicolons or tabs.
   subroutine read_text_table(path, table, error)
      character(*), intent(in) :: path
      type(text_table_t), intent(out) :: table
      type(error_t), allocatable, intent(out) :: error   !! exit_file, with path and line
      type(message_list_t) :: fields
      character(:), allocatable :: text
      integer :: at, line, first_line, used, k
      character :: separator
      logical :: has_names, is_closed

      table = new_text_table([character(1) ::])
      table%file = path
      call read_whole(path, text, error)
      if (allocated(error)) return
      text = with_line_ends(text)
      separator = ','
      has_names = .false.
      at = 1
      line = 1
      do while (at <= len(text))
         first_line = line
         if (text(at:at) == '#' .or. text(at:at) == line_end) then
            at = at + index(text(at:)//line_end, line_end)
            line = line + 1
            cycle
         end if
         if (.not. has_names) separator = separator_of(text(at:at + index(text(at:)//line_end, line_end) - 2))
         call take_record(text, separator, at, line, fields, is_closed)
         used = fields%count()
         if (.not. is_closed) then
            call fail(error, exit_file, path//':'//str(first_line)//': a quoted cell is not closed')
            return
         end if
         if (.not. has_names) then
            has_names = .true.
            deallocate (table%columns, table%cells)
            allocate (table%columns(used), table%cells(used, 8))
            do k = 1, used
               table%columns(k) = fields%line(k)
               if (findloc(table%columns(:k) == table%columns(k), .true., dim=1) == k) cycle
               call fail(error, exit_file, path//':'//str(first_line)//': the column '//quoted(table%columns(k))// &
                  ' is given twice, as column '//str(findloc(table%columns(:k) == table%columns(k), .true., dim=1))// &
                  ' and column '//str(k)//'; remove or rename one')
               return
            end do
            cycle
         end if
         if (used /= size(table%columns)) then
            call fail(error, exit_file, path//':'//str(first_line)//': '//plural(used, 'cell', 'cells')//' for '// &
               plural(size(table%columns), 'column', 'columns'))
            return
         end if
         call add_row(table, first_line)
         do k = 1, used
            table%cells(k, table%rows)%text = fields%line(k)
         end do
      end do
      if (.not. has_names) call fail(error, exit_file, path//': the line of column names is missing')
   end subroutine read_text_table

   !> The separator of the columns, from the line of column names.
   pure character function separator_of(names) result(separator)
      character(*), intent(in) :: names

      separator = ','
      if (index(names, achar(9)) > 0) separator = achar(9)
      if (index(names, ';') > 0) separator = ';'
   end function separator_of

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
            call fields%add(bare_cell(cell%text()))
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
      call fields%add(bare_cell(cell%text()))
      is_closed = .not. is_quoted
   end subroutine take_record

end module ek_text_table
