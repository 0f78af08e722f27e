!> A table of strings and numbers to be written, filled cell by cell from left to right and from the first row to the last:
!>
!>     frame = new_frame('element,value,unit')
!>     call frame%put(name)
!>     call frame%put(1.5_wp)
!>     call frame%put('N')
!>     text = frame%csv()
!>
!> As CSV (RFC 4180), a frame has its header lines after `# `, a line of column names, and one line per row. Numbers have 15
!> significant digits; `nan` is a missing value. A cell of text is quoted if it contains a comma, a quote or a line end, or begins
!> with #. A blank precedes text that a spreadsheet would read as a formula: text that begins with =, +, - or @. read_text_table
!> (ek_text_table) removes this blank. As JSON, a frame is a list of objects, one per row.
module ek_frame
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_decimal, only: decimal, get_decimal
   use ek_json, only: json_t, json_string
   implicit none(type, external)
   private
   public :: frame_t, new_frame, is_formula

   character(*), parameter :: line_end = new_line('a')

   type :: frame_t
      type(message_list_t) :: header            !! lines above the column names
      logical :: quotes_text = .false.          !! every cell of text is quoted
      character(:), allocatable, private :: names       !! column names, separated by commas
      integer, private :: columns = 0
      logical, private :: has_begun = .false.   !! the header and the names were taken by next_csv
      type(buffer_t), private :: letters        !! all cells, one after the other
      integer, allocatable, private :: last(:)  !! last character of each cell
      logical, allocatable, private :: is_text(:)
      integer, private :: used = 0              !! number of cells
   contains
      procedure, private :: put_text, put_integer, put_number, put_numbers
      generic :: put => put_text, put_integer, put_number, put_numbers
      procedure :: put_known, length, csv, next_csv, add_json
   end type frame_t

   interface new_frame
      module procedure frame_of_names, frame_of_line
   end interface new_frame

contains

   !> A frame without rows.
   pure type(frame_t) function frame_of_names(names) result(frame)
      character(*), intent(in) :: names(:)      !! column names, without comma, quote and line end
      type(buffer_t) :: heads
      integer :: k

      do k = 1, size(names)
         if (k > 1) call heads%add(',')
         call heads%add(trim(names(k)))
      end do
      frame = frame_of_line(heads%text())
   end function frame_of_names

   !> A frame without rows, with the line of its column names.
   pure type(frame_t) function frame_of_line(names) result(frame)
      character(*), intent(in) :: names         !! separated by commas
      integer :: k

      frame%names = names
      frame%columns = 1 + count([(names(k:k) == ',', k=1, len(names))])
      allocate (frame%last(0:64), source=0)
      allocate (frame%is_text(64))
   end function frame_of_line

   !> Adds a cell of text.
   pure subroutine put_text(self, text)
      class(frame_t), intent(inout) :: self
      character(*), intent(in) :: text
      call put_cell(self, text, .true.)
   end subroutine put_text

   !> Adds a cell with an integer.
   pure subroutine put_integer(self, value)
      class(frame_t), intent(inout) :: self
      integer, intent(in) :: value
      call put_cell(self, str(value), .false.)
   end subroutine put_integer

   !> Adds a cell with a number.
   pure subroutine put_number(self, value, digits)
      class(frame_t), intent(inout) :: self
      real(wp), intent(in) :: value
      integer, intent(in), optional :: digits   !! significant digits; default 15
      if (present(digits)) call put_cell(self, str(value, digits), .false.)
      if (.not. present(digits)) call put_cell(self, decimal(value), .false.)
   end subroutine put_number

   !> Adds one cell for each number.
   pure subroutine put_numbers(self, values, digits)
      class(frame_t), intent(inout) :: self
      real(wp), intent(in) :: values(:)
      integer, intent(in), optional :: digits
      integer :: k

      do k = 1, size(values)
         call self%put_number(values(k), digits)
      end do
   end subroutine put_numbers

   !> Adds one cell for each number: nan for an infinite number, and for a limit that is not given (huge).
   pure subroutine put_known(self, values)
      class(frame_t), intent(inout) :: self
      real(wp), intent(in) :: values(:)
      logical :: is_known
      integer :: k

      do k = 1, size(values)
         is_known = ieee_is_finite(values(k))
         if (is_known) is_known = abs(values(k)) < huge(1.0_wp)
         if (is_known) call self%put_number(values(k))
         if (.not. is_known) call put_cell(self, 'nan', .false.)
      end do
   end subroutine put_known

   pure subroutine put_cell(self, cell, is_text)
      type(frame_t), intent(inout) :: self
      character(*), intent(in) :: cell
      logical, intent(in) :: is_text
      integer, allocatable :: grown(:)

      if (self%used == size(self%is_text)) then
         allocate (grown(0:2*self%used))
         grown(:self%used) = self%last
         call move_alloc(grown, self%last)
         self%is_text = [self%is_text, self%is_text]        ! twice the size
      end if
      self%used = self%used + 1
      call self%letters%add(cell)
      self%last(self%used) = self%letters%length()
      self%is_text(self%used) = is_text
   end subroutine put_cell

   !> Number of characters of the cells.
   pure integer function length(self)
      class(frame_t), intent(in) :: self
      length = self%letters%length()
   end function length

   !> The frame as CSV.
   pure function csv(self) result(text)
      class(frame_t), intent(in) :: self
      character(:), allocatable :: text
      type(buffer_t) :: buffer

      call add_csv(self, buffer)
      text = buffer%text()
   end function csv

   !> Takes the rows out of the frame as CSV; the first time, after the header and the column names. For a table that is written piece
   !> by piece.
   pure subroutine next_csv(self, text)
      class(frame_t), intent(inout) :: self
      character(:), allocatable, intent(out) :: text

      text = self%csv()
      self%has_begun = .true.
      call self%letters%clear()
      self%used = 0
   end subroutine next_csv

   !> Adds header, column names and rows.
   pure subroutine add_csv(self, buffer)
      type(frame_t), intent(in) :: self
      type(buffer_t), intent(inout) :: buffer
      integer :: k

      if (.not. self%has_begun) then
         do k = 1, self%header%count()
            call buffer%line('# '//self%header%line(k))
         end do
         call buffer%line(self%names)
      end if
      do k = 1, self%used
         call add_cell(self, k, buffer)
         call buffer%add(merge(line_end, ',', mod(k, self%columns) == 0))
      end do
   end subroutine add_csv

   !> Adds a cell as written, in quotes if necessary.
   pure subroutine add_cell(self, k, buffer)
      type(frame_t), intent(in) :: self
      integer, intent(in) :: k
      type(buffer_t), intent(inout) :: buffer
      character(self%last(k) - self%last(k - 1)) :: cell
      integer :: i

      call self%letters%copy(self%last(k - 1) + 1, cell)
      if (.not. self%is_text(k)) then
         call buffer%add(cell)
         return
      end if
      if (self%quotes_text .or. scan(cell, ',"'//line_end//achar(13)) > 0 .or. index(cell, '#') == 1) then
         call buffer%add('"')
         if (is_formula(cell)) call buffer%add(' ')
         do i = 1, len(cell)
            if (cell(i:i) == '"') call buffer%add('"')
            call buffer%add(cell(i:i))
         end do
         call buffer%add('"')
      else
         if (is_formula(cell)) call buffer%add(' ')
         call buffer%add(cell)
      end if
   end subroutine add_cell

   !> Whether a spreadsheet reads a cell as a formula: the cell begins with =, +, - or @, and is neither a number, a percentage nor
   !> this sign alone.
   pure logical function is_formula(text)
      character(*), intent(in) :: text
      real(wp) :: value
      integer :: last
      logical :: is_number

      is_formula = .false.
      last = len_trim(text)
      if (scan(text, '=+-@') /= 1 .or. last == 1) return
      if (text(last:last) == '%') last = max(1, len_trim(text(:last - 1)))
      call get_decimal(text(:last), value, is_number)
      is_formula = .not. is_number
   end function is_formula

   !> Adds the rows to a JSON object as the list `key`. A number that is not finite is null.
   pure subroutine add_json(self, key, json)
      class(frame_t), intent(in) :: self
      character(*), intent(in) :: key
      type(json_t), intent(inout) :: json
      character(:), allocatable :: name
      integer :: row, place, first

      call json%open('[', key)
      do row = 1, self%used/self%columns
         call json%open('{')
         first = 1
         do place = 1, self%columns
            name = name_at(self%names(first:))
            call json%item(name, literal_of(self, (row - 1)*self%columns + place))
            first = first + len(name) + 1
         end do
         call json%close('}')
      end do
      call json%close(']')
   end subroutine add_json

   !> The first of the names that are separated by commas.
   pure function name_at(names) result(name)
      character(*), intent(in) :: names
      character(:), allocatable :: name
      name = names(:index(names//',', ',') - 1)
   end function name_at

   !> Cell k as a JSON literal.
   pure function literal_of(self, k) result(literal)
      type(frame_t), intent(in) :: self
      integer, intent(in) :: k
      character(:), allocatable :: literal

      allocate (character(self%last(k) - self%last(k - 1)) :: literal)
      call self%letters%copy(self%last(k - 1) + 1, literal)
      if (self%is_text(k)) then
         literal = json_string(literal)
      else if (scan(literal, 'ni') > 0) then             ! nan, inf
         literal = 'null'
      end if
   end function literal_of

end module ek_frame
