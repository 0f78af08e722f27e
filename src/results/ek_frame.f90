!> A table of strings and numbers to be written, filled cell by cell from left to right and from the first row to the last:
!>
!>     frame = new_frame('element,value,unit')
!>     call frame%put(name)
!>     call frame%put(1.5_wp)
!>     call frame%put('N')
!>     text = frame%csv()
!>
!> `hold` repeats the first cells of a row in all following rows. As CSV (RFC 4180), a frame has its header lines after `# `, a line
!> of column names, and one line per row. Numbers have 15 significant digits; `nan` is a missing value. A cell of text is quoted if
!> it contains a comma, a quote or a line end, or begins with #. A blank precedes text that a spreadsheet would read as a formula:
!> text that begins with =, +, - or @. read_text_table (ek_text_table) removes this blank. As JSON, a frame is a list of objects,
!> one per row.
module ek_frame
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_decimal, only: put_decimal, longest_decimal, get_decimal
   use ek_json, only: json_t, json_string
   implicit none(type, external)
   private
   public :: frame_t, new_frame, bare_cell

   character(*), parameter :: line_end = new_line('a')

   type :: frame_t
      type(message_list_t) :: header            !! lines above the column names
      logical :: quotes_text = .false.          !! every cell of text is quoted; set before the first cell
      character(:), allocatable, private :: names       !! column names, separated by commas
      logical, allocatable, private :: is_text(:)       !! the column contains text
      type(buffer_t), private :: rows           !! as CSV
      integer, private :: place = 0             !! cells of the last row; 0: the row is complete
      integer, private :: begun = 0             !! letters before the last row
      logical, private :: is_taken = .false.    !! the header and the names were taken by next_csv
      character(:), allocatable, private :: lead        !! first cells of all rows until `release`
      integer, private :: led = 0               !! number of these cells
   contains
      procedure, private :: put_text, put_integer, put_number, put_numbers
      generic :: put => put_text, put_integer, put_number, put_numbers
      procedure :: put_known, hold, release, length, csv, next_csv, add_json
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
      allocate (frame%is_text(1 + count([(names(k:k) == ',', k=1, len(names))])), source=.false.)
   end function frame_of_line

   !> Adds a cell of text, in quotes if necessary.
   pure subroutine put_text(self, text)
      class(frame_t), intent(inout) :: self
      character(*), intent(in) :: text
      logical :: is_quoted
      integer :: k

      call begin_cell(self)
      self%is_text(self%place) = .true.
      is_quoted = self%quotes_text
      do k = 1, len(text)
         if (text(k:k) == ',' .or. text(k:k) == '"' .or. text(k:k) == line_end .or. text(k:k) == achar(13)) is_quoted = .true.
      end do
      if (len(text) > 0) is_quoted = is_quoted .or. text(1:1) == '#'
      if (is_quoted) call self%rows%add('"')
      if (is_formula(text)) call self%rows%add(' ')
      if (is_quoted) then
         do k = 1, len(text)
            if (text(k:k) == '"') call self%rows%add('"')
            call self%rows%add(text(k:k))
         end do
         call self%rows%add('"')
      else
         call self%rows%add(text)
      end if
      call end_cell(self)
   end subroutine put_text

   !> Adds a cell with an integer.
   pure subroutine put_integer(self, value)
      class(frame_t), intent(inout) :: self
      integer, intent(in) :: value

      call begin_cell(self)
      call self%rows%add(str(value))
      call end_cell(self)
   end subroutine put_integer

   !> Adds a cell with a number.
   pure subroutine put_number(self, value, digits)
      class(frame_t), intent(inout) :: self
      real(wp), intent(in) :: value
      integer, intent(in), optional :: digits   !! significant digits; default 15
      character(longest_decimal) :: cell
      integer :: used

      call begin_cell(self)
      if (present(digits)) then
         call self%rows%add(str(value, digits))
      else
         used = 0
         call put_decimal(value, cell, used)
         call self%rows%add(cell(:used))
      end if
      call end_cell(self)
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
         if (is_known) cycle
         call begin_cell(self)
         call self%rows%add('nan')
         call end_cell(self)
      end do
   end subroutine put_known

   !> Begins a cell; at the beginning of a row, after the cells that are held.
   pure subroutine begin_cell(self)
      type(frame_t), intent(inout) :: self

      if (self%place == 0) then
         self%begun = self%rows%length()
         if (allocated(self%lead)) call self%rows%add(self%lead)
         if (allocated(self%lead)) self%place = self%led
      end if
      self%place = self%place + 1
   end subroutine begin_cell

   !> Ends a cell, and the row after its last cell.
   pure subroutine end_cell(self)
      type(frame_t), intent(inout) :: self

      if (self%place < size(self%is_text)) then
         call self%rows%add(',')
      else
         call self%rows%add(line_end)
         self%place = 0
      end if
   end subroutine end_cell

   !> Moves the cells of the incomplete row to the beginning of all following rows, until `release`.
   pure subroutine hold(self)
      class(frame_t), intent(inout) :: self

      self%lead = repeat(' ', self%rows%length() - self%begun)
      call self%rows%copy(self%begun + 1, self%lead)
      call self%rows%clear(self%begun)
      self%led = self%place
      self%place = 0
   end subroutine hold

   !> Ends `hold`.
   pure subroutine release(self)
      class(frame_t), intent(inout) :: self
      if (allocated(self%lead)) deallocate (self%lead)
   end subroutine release

   !> Number of characters of the rows as CSV.
   pure integer function length(self)
      class(frame_t), intent(in) :: self
      length = self%rows%length()
   end function length

   !> The frame as CSV.
   pure function csv(self) result(text)
      class(frame_t), intent(in) :: self
      character(:), allocatable :: text
      type(buffer_t) :: head
      integer :: k

      if (self%is_taken) then
         text = self%rows%text()
         return
      end if
      do k = 1, self%header%count()
         call head%line('# '//self%header%line(k))
      end do
      call head%line(self%names)
      allocate (character(head%length() + self%rows%length()) :: text)
      k = head%length()
      call head%copy(1, text(:k))
      call self%rows%copy(1, text(k + 1:))
   end function csv

   !> Takes the rows out of the frame as CSV; the first time, after the header and the column names. For a table that is written
   !> piece by piece: every row is complete.
   pure subroutine next_csv(self, text)
      class(frame_t), intent(inout) :: self
      character(:), allocatable, intent(out) :: text

      text = self%csv()
      self%is_taken = .true.
      call self%rows%clear()
   end subroutine next_csv

   !> Whether a spreadsheet reads a cell as a formula: the cell begins with =, +, - or @, and is neither a number, a percentage nor
   !> this sign alone.
   pure logical function is_formula(text)
      character(*), intent(in) :: text
      real(wp) :: value
      integer :: last
      logical :: is_number

      is_formula = .false.
      if (scan(text(:min(1, len(text))), '=+-@') == 0) return
      last = len_trim(text)
      if (last == 1) return
      if (text(last:last) == '%') last = max(1, len_trim(text(:last - 1)))
      call get_decimal(text(:last), value, is_number)
      is_formula = .not. is_number
   end function is_formula

   !> Adds the rows to a JSON object as the list `key`. A number that is not finite is null.
   pure subroutine add_json(self, key, json)
      class(frame_t), intent(in) :: self
      character(*), intent(in) :: key
      type(json_t), intent(inout) :: json
      character(:), allocatable :: text, name, cell
      integer :: at, place, first

      text = self%rows%text()
      at = 1
      call json%open('[', key)
      do while (at <= len(text))
         call json%open('{')
         first = 1
         do place = 1, size(self%is_text)
            name = self%names(first:first + index(self%names(first:)//',', ',') - 2)
            first = first + len(name) + 1
            call take_cell(text, at, cell)
            if (self%is_text(place)) then
               call json%item(name, json_string(cell))
            else if (scan(cell, 'ni') > 0) then            ! nan, inf
               call json%item(name, 'null')
            else
               call json%item(name, cell)
            end if
         end do
         call json%close('}')
      end do
      call json%close(']')
   end subroutine add_json

   !> Takes the next cell of CSV text, as it was put: without quotes, and without the blank before a formula.
   pure subroutine take_cell(text, at, cell)
      character(*), intent(in) :: text
      integer, intent(inout) :: at                !! first letter of the cell; on return, of the next cell
      character(:), allocatable, intent(out) :: cell
      type(buffer_t) :: letters
      integer :: quote

      if (text(at:at) == '"') then
         do
            at = at + 1
            quote = index(text(at:), '"')
            call letters%add(text(at:at + quote - 2))
            at = at + quote
            if (text(at:at) /= '"') exit
            call letters%add('"')                   ! two quotes are one
         end do
         cell = letters%text()
      else
         cell = text(at:at + scan(text(at:), ','//line_end) - 2)
         at = at + len(cell)
      end if
      at = at + 1
      cell = bare_cell(cell)
   end subroutine take_cell

   !> A cell as it was before it was written: without the blank that precedes a formula.
   pure function bare_cell(cell) result(text)
      character(*), intent(in) :: cell
      character(:), allocatable :: text

      text = cell
      if (index(cell, ' ') /= 1) return
      if (is_formula(cell(2:))) text = cell(2:)
   end function bare_cell

end module ek_frame
