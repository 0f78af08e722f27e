!> A table of results: named columns, one row per state, and header lines on its origin. As CSV, a table has header lines that
!> begin with `# `, a line of column names, and one line per row. Numbers have 15 significant digits; `nan` is a missing
!> value.
module ek_table
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite, ieee_is_nan
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_file
   use ek_text, only: quoted
   use ek_buffer, only: buffer_t
   use ek_file, only: write_standard_output
   use ek_sheet, only: sheet_t, read_sheet, mistakes_of
   use ek_sheet_columns, only: take_columns, has_numbers, or_nan, or_text
   use ek_unit_row, only: unit_of_heading
   use ek_writer, only: writer_t, begin_file
   use ek_decimal, only: put_decimal, longest_decimal
   use ek_quantity, only: name_length
   implicit none(type, external)
   private
   public :: table_t, stop_t, new_table, keep_rows, insert_row, add_stop, stop_row, scheduled_rows, column_index, name_index, &
      column, column_range, row_count, name_length
   public :: csv_text, csv_head, csv_row, put_csv_row, csv_length, csv_cell, write_csv, print_csv, read_csv

   character(*), parameter :: line_end = new_line('a')

   !> The name of a row. Not a second list of messages in the table: gfortran 12 releases only the first of two components of one
   !> type when it deallocates an object of a class that contains them.
   type :: row_name_t
      character(:), allocatable :: text
   end type row_name_t

   !> A value of a column at which a number is read, and the row of the state that was found there.
   type :: stop_t
      character(name_length) :: column = ''
      real(wp) :: value = 0.0_wp                          !! in the unit of the column
      integer :: row = 0                                  !! each stop has a row of its own; 0: no state was found
   end type stop_t

   type :: table_t
      character(name_length), allocatable :: columns(:)   !! names with unit suffix, e.g. toe_deg
      real(wp), allocatable :: values(:, :)               !! (column, row): a row is contiguous
      logical, allocatable :: is_whole(:)                 !! the column contains integers: state, iterations, …
      logical, allocatable :: is_scheduled(:)             !! .false.: the state of the row is not of the schedule of its case; a
                                                          !! number is read there. Not allocated: all are
      type(stop_t), allocatable :: stops(:)               !! values at which numbers are read; not allocated: none
      logical :: is_along_arc = .false.                   !! the states are at equal distances along a path
      logical :: lacks_springs = .false.                  !! nothing carries the wheels: columns that depend on a rate are NaN
      logical :: rests_on_bushings = .false.              !! only bushings carry the wheels: the same columns are NaN
      logical :: is_of_rows = .false.                     !! the states are those of the rows of a load table or of a grid
      type(message_list_t) :: header                      !! lines above the columns, each written after '# '
      type(row_name_t), allocatable :: names(:)           !! name of each row, in a last column `name`; without names: not allocated
   end type table_t

   character(*), parameter :: whole_names(5) = [character(13) :: 'state', 'converged', 'stable', 'near_singular', 'iterations']

contains

   !> A table with a number of rows, in which all values are NaN.
   pure type(table_t) function new_table(columns, rows) result(table)
      character(*), intent(in) :: columns(:)    !! names without comma, quote or line end
      integer, intent(in) :: rows
      integer :: k

      allocate (table%columns(size(columns)))
      table%columns = columns
      allocate (table%is_whole, source=[(any(whole_names == columns(k)), k=1, size(columns))])
      allocate (table%values(size(columns), rows), source=ieee_value(1.0_wp, ieee_quiet_nan))
   end function new_table

   !> Whether the state of each row is of the schedule of its case. The other states are those where numbers are read.
   pure function scheduled_rows(table) result(is_scheduled)
      type(table_t), intent(in) :: table
      logical :: is_scheduled(size(table%values, 2))

      is_scheduled = .true.
      if (allocated(table%is_scheduled)) is_scheduled = table%is_scheduled
   end function scheduled_rows

   !> Reduces a table to some of its rows.
   pure subroutine keep_rows(is_kept, table)
      logical, intent(in) :: is_kept(:)         !! of each row
      type(table_t), intent(inout) :: table
      integer, allocatable :: rows(:)
      integer :: k

      rows = pack([(k, k=1, size(is_kept))], is_kept)
      table%values = table%values(:, rows)
      if (allocated(table%names)) table%names = table%names(rows)
      if (allocated(table%is_scheduled)) table%is_scheduled = table%is_scheduled(rows)
      if (.not. allocated(table%stops)) return
      do k = 1, size(table%stops)
         if (table%stops(k)%row > 0) table%stops(k)%row = findloc(rows, table%stops(k)%row, dim=1)
      end do
   end subroutine keep_rows

   !> Inserts a row that is not of the schedule.
   pure subroutine insert_row(after, values, table)
      integer, intent(in) :: after              !! index of the row before
      real(wp), intent(in) :: values(:)         !! of each column
      type(table_t), intent(inout) :: table     !! without names of rows
      integer :: k

      if (.not. allocated(table%is_scheduled)) allocate (table%is_scheduled(size(table%values, 2)), source=.true.)
      table%is_scheduled = [table%is_scheduled(:after), .false., table%is_scheduled(after + 1:)]
      table%values = reshape([table%values(:, :after), values, table%values(:, after + 1:)], &
         [size(values), size(table%values, 2) + 1])
      if (.not. allocated(table%stops)) return
      do k = 1, size(table%stops)
         if (table%stops(k)%row > after) table%stops(k)%row = table%stops(k)%row + 1
      end do
   end subroutine insert_row

   !> Adds a value of a column to a list, unless the list contains it.
   pure subroutine add_stop(column, value, stops)
      character(*), intent(in) :: column
      real(wp), intent(in) :: value             !! in the unit of the column
      type(stop_t), allocatable, intent(inout) :: stops(:)

      if (.not. allocated(stops)) allocate (stops(0))
      if (any(stops%column == column .and. abs(stops%value - value) <= 0.0_wp)) return
      stops = [stops, stop_t(column, value)]
   end subroutine add_stop

   !> The row of the state that was found where a column has a value; 0 without such a state.
   pure integer function stop_row(table, column, value) result(row)
      type(table_t), intent(in) :: table
      integer, intent(in) :: column             !! index of the column; 0: none
      real(wp), intent(in) :: value
      integer :: k

      row = 0
      if (column == 0 .or. .not. allocated(table%stops)) return
      do k = 1, size(table%stops)
         if (abs(table%stops(k)%value - value) > 0.0_wp) cycle
         if (table%stops(k)%column == table%columns(column)) row = table%stops(k)%row
      end do
   end function stop_row

   !> Index of a column; 0 if no column has the name. Names are case-sensitive. (libgfortran's findloc of strings reads beyond the
   !> array with back = .true.)
   pure integer function column_index(table, name) result(place)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: name

      place = name_index(table%columns, name)
   end function column_index

   !> The last index of a name in a list of column names; 0 if the name is blank or is not in the list.
   pure integer function name_index(names, name) result(place)
      character(name_length), intent(in) :: names(:)
      character(*), intent(in) :: name
      integer :: last

      place = 0
      last = len_trim(name)
      if (last == 0 .or. last > name_length) return
      do place = size(names), 1, -1
         ! two letters first: a comparison of whole names, mostly blanks, takes many times longer
         if (names(place) (last:last) /= name(last:last)) cycle
         if (last < name_length) then
            if (names(place) (last + 1:last + 1) /= ' ') cycle
         end if
         if (names(place) (:last) /= name(:last)) cycle
         if (len_trim(names(place)) == last) return
      end do
   end function name_index

   !> The values of a column from the first to the last row; empty if no column has the name.
   pure function column(table, name) result(values)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: name
      real(wp), allocatable :: values(:)
      integer :: place

      place = column_index(table, name)
      allocate (values(0))
      if (place > 0) values = table%values(place, :)
   end function column

   !> Minimum and maximum finite value of a column; both nan if the column has no finite value or does not exist.
   pure function column_range(table, name) result(range)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: name
      real(wp) :: range(2)
      integer :: place

      range = ieee_value(1.0_wp, ieee_quiet_nan)
      place = column_index(table, name)
      if (place == 0) return
      associate (values => table%values(place, :))
         if (any(ieee_is_finite(values))) &
            range = [minval(values, mask=ieee_is_finite(values)), maxval(values, mask=ieee_is_finite(values))]
      end associate
   end function column_range

   !> Number of rows of the table.
   pure integer function row_count(table)
      type(table_t), intent(in) :: table
      row_count = size(table%values, 2)
   end function row_count

   !> The table as a CSV string, for tests and benchmarks. Files are written row by row.
   pure function csv_text(table) result(text)
      type(table_t), intent(in) :: table
      character(:), allocatable :: text
      type(buffer_t) :: buffer
      integer :: row

      call buffer%add(csv_head(table))
      do row = 1, size(table%values, 2)
         call buffer%add(row_text(table, row))
      end do
      text = buffer%text()
   end function csv_text

   !> Row k of a table as a CSV line, with the name of the row if the table has names.
   pure function row_text(table, k) result(text)
      type(table_t), intent(in) :: table
      integer, intent(in) :: k
      character(:), allocatable :: text

      text = csv_row(table%values(:, k), table%is_whole)
      if (allocated(table%names)) text = text(:len(text) - 1)//','//csv_cell(table%names(k)%text)//line_end
   end function row_text

   !> A string as a cell of a CSV file: in double quotes if it contains a comma, a quote or a line end.
   pure function csv_cell(text) result(cell)
      character(*), intent(in) :: text
      character(:), allocatable :: cell
      integer :: k

      cell = text
      if (scan(text, ',";'//line_end) == 0) return
      cell = '"'
      do k = 1, len(text)
         cell = cell//text(k:k)
         if (text(k:k) == '"') cell = cell//'"'
      end do
      cell = cell//'"'
   end function csv_cell

   !> One row of a table as a CSV line, with line end.
   pure function csv_row(values, is_whole) result(text)
      real(wp), intent(in) :: values(:)
      logical, intent(in) :: is_whole(:)        !! the columns of integers
      character(:), allocatable :: text
      character(csv_length(size(values))) :: line
      integer :: filled

      call put_csv_row(values, is_whole, line, filled)
      text = line(:filled)
   end function csv_row

   !> Greatest length of a CSV line of numbers.
   pure integer function csv_length(numbers)
      integer, intent(in) :: numbers
      csv_length = max(numbers*(longest_decimal + 1), 1)
   end function csv_length

   !> Writes one row of a table as a CSV line, with line end, into a string.
   pure subroutine put_csv_row(values, is_whole, line, filled)
      real(wp), intent(in) :: values(:)
      logical, intent(in) :: is_whole(:)        !! the columns of integers
      character(*), intent(inout) :: line       !! at least csv_length(size(values)) long
      integer, intent(out) :: filled            !! length of the CSV line
      integer :: k
      real(wp) :: value

      filled = 0
      do k = 1, size(values)
         value = values(k)
         if (is_whole(k)) value = whole(value)
         call put_decimal(value, line, filled)
         filled = filled + 1
         line(filled:filled) = ','
      end do
      filled = max(filled, 1)     ! replaces the last comma, if any
      line(filled:filled) = line_end
   end subroutine put_csv_row

   !> The nearest integer, for magnitudes below 1e15; larger values, which have no fraction, and NaN are unchanged.
   elemental real(wp) function whole(value)
      real(wp), intent(in) :: value

      whole = value
      if (ieee_is_nan(value)) return                ! debug builds trap comparisons with it
      if (abs(value) < 1e15_wp) whole = anint(value)
   end function whole

   !> The header lines and the line of column names, as in a CSV file.
   pure function csv_head(table) result(text)
      type(table_t), intent(in) :: table
      character(:), allocatable :: text
      character(:), allocatable :: lines
      type(buffer_t) :: buffer
      integer :: k

      if (table%header%count() > 0) then
         lines = table%header%text()
         call buffer%add('# ')
         do k = 1, len(lines)
            call buffer%add(lines(k:k))
            if (lines(k:k) == line_end) call buffer%add('# ')
         end do
         call buffer%add(line_end)
      end if
      do k = 1, size(table%columns)
         if (k > 1) call buffer%add(',')
         call buffer%add(trim(table%columns(k)))
      end do
      if (allocated(table%names)) call buffer%add(',name')
      text = buffer%text()//line_end
   end function csv_head

   !> Writes the table as a CSV file. An error leaves an older file unchanged and no incomplete file. A column name with a
   !> comma, a quote or a line end is an error.
   subroutine write_csv(table, path, error)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: path
      type(error_t), allocatable, intent(out) :: error   !! exit_file
      type(writer_t) :: writer
      integer :: k

      do k = 1, size(table%columns)
         if (scan(trim(table%columns(k)), ',"'//line_end) == 0) cycle
         call fail(error, exit_file, "cannot write '"//path//"': the column name "// &
            quoted(table%columns(k))//' contains a comma, a quote or a line end')
         return
      end do
      call begin_file(writer, path, error)
      if (allocated(error)) return
      call writer%add(csv_head(table))
      do k = 1, size(table%values, 2)
         call writer%add(row_text(table, k))
      end do
      call writer%finish(error)
   end subroutine write_csv

   !> Writes the table to standard output, row by row.
   subroutine print_csv(table, error)
      type(table_t), intent(in) :: table
      type(error_t), allocatable, intent(out) :: error   !! exit_file; with an empty message if the reader closed the pipe
      integer, parameter :: enough = 60000               ! characters written at a time
      type(buffer_t) :: buffer
      integer :: k

      call buffer%add(csv_head(table))
      do k = 1, size(table%values, 2)
         call buffer%add(row_text(table, k))
         if (buffer%length() < enough) cycle
         call write_standard_output(buffer%text(), error)
         if (allocated(error)) return
         call buffer%clear()
      end do
      call write_standard_output(buffer%text(), error)
   end subroutine print_csv

   !> Reads a table of numbers from a file (ek_sheet). Comments are header lines. A column of text is omitted.
   subroutine read_csv(path, table, error, may_stream, has_text)
      character(*), intent(in) :: path
      type(table_t), intent(out) :: table
      type(error_t), allocatable, intent(out) :: error   !! exit_file, with path and line; all errors of the file
      logical, intent(in), optional :: may_stream        !! see read_whole
      logical, intent(in), optional :: has_text          !! .true.: text, also a column of text, and empty cells are read as nan
      type(sheet_t) :: sheet
      type(message_list_t) :: mistakes
      real(wp), allocatable :: values(:, :)
      character(16), allocatable :: units(:)
      integer, allocatable :: places(:)
      integer :: k, accepts

      table = new_table([character(1) ::], 0)
      call read_sheet(path, sheet, error, may_stream=may_stream)
      if (allocated(error)) return
      accepts = or_nan
      if (present(has_text)) accepts = merge(or_text, or_nan, has_text)
      if (sheet%rows > 0) then
         places = pack([(k, k=1, size(sheet%heads))], has_numbers(sheet, may_be_nan=.true.))
         if (accepts == or_text) places = [(k, k=1, size(sheet%heads))]
         allocate (units(size(places)))
         do k = 1, size(places)
            units(k) = unit_of_heading(trim(sheet%heads(places(k))))
         end do
         call take_columns(sheet, places, values, units, accepts)
      else if (sheet%head_mistakes%count() == 0) then
         sheet%row_mistakes = message_list_t()           ! a table without rows
         places = [(k, k=1, size(sheet%heads))]
         allocate (values(size(places), 0))
      end if
      call mistakes_of(sheet, mistakes)
      if (mistakes%count() > 0) then
         call fail(error, exit_file, mistakes%text())
         return
      end if
      table = new_table(sheet%heads(places), 0)
      table%header = sheet%header
      call move_alloc(values, table%values)
   end subroutine read_csv

end module ek_table
