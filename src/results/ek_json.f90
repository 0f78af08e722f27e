!> A small JSON writer (RFC 8259): objects and lists in order, indented, one item per line, or all on one line.
!>
!>     call json%open('{')
!>     call json%item('unit', json_string('deg/m'))
!>     call json%item('value', json_number(1.5_wp))
!>     call json%close('}')
!>
!> Numbers have 15 significant digits; values that are not finite are `null`, because JSON cannot represent them.
module ek_json
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_buffer, only: buffer_t
   use ek_decimal, only: decimal, rounded
   use ek_error, only: message_list_t
   use ek_letters, only: as_utf8
   use ek_version, only: version
   implicit none(type, external)
   private
   public :: json_t, json_string, json_strings, json_number, json_numbers, without_tags

   character(*), parameter :: line_end = new_line('a')

   type :: json_t
      private
      type(buffer_t) :: buffer
      integer :: depth = 0
      logical, public :: is_one_line = .false.     !! blanks instead of lines and indents; set before the first item
      logical :: is_empty = .true.     !! the innermost list or object has no item yet
   contains
      procedure :: begin_record => json_begin_record
      procedure :: open => json_open, close => json_close, item => json_item, item_of_list => json_item_of_list, text => json_text
   end type json_t

contains

   !> Begins the object that a command prints or writes: the program, the file of the deck, the model and the checksum of the deck.
   subroutine json_begin_record(self, model, checksum, deck)
      class(json_t), intent(inout) :: self
      character(*), intent(in) :: model, checksum           !! '' if the deck could not be read
      character(*), intent(in), optional :: deck            !! path of the deck

      call self%open('{')
      call self%item('program', json_string('elastokin '//version))
      if (present(deck)) call self%item('deck', json_string(as_utf8(deck)))
      call self%item('model', json_string(as_utf8(model)))
      call self%item('checksum', json_string(checksum))
   end subroutine json_begin_record

   !> Begins an object '{' or a list '['. `key` is required inside an object.
   pure subroutine json_open(self, bracket, key)
      class(json_t), intent(inout) :: self
      character(1), intent(in) :: bracket
      character(*), intent(in), optional :: key

      call begin_item(self, key)
      call self%buffer%add(bracket)
      self%depth = self%depth + 1
      self%is_empty = .true.
   end subroutine json_open

   !> Ends the innermost object '}' or list ']'.
   pure subroutine json_close(self, bracket)
      class(json_t), intent(inout) :: self
      character(1), intent(in) :: bracket

      self%depth = self%depth - 1
      if (.not. self%is_empty .and. .not. self%is_one_line) call begin_line(self)
      call self%buffer%add(bracket)
      self%is_empty = .false.
   end subroutine json_close

   !> Adds an item of an object. `literal` is created by json_string, json_strings, json_number, json_numbers, or by str for
   !> an integer.
   pure subroutine json_item(self, key, literal)
      class(json_t), intent(inout) :: self
      character(*), intent(in) :: key, literal

      call begin_item(self, key)
      call self%buffer%add(literal)
   end subroutine json_item

   !> Adds an item of a list.
   pure subroutine json_item_of_list(self, literal)
      class(json_t), intent(inout) :: self
      character(*), intent(in) :: literal

      call begin_item(self)
      call self%buffer%add(literal)
   end subroutine json_item_of_list

   !> The complete JSON string, with a line end.
   pure function json_text(self) result(text)
      class(json_t), intent(in) :: self
      character(:), allocatable :: text
      text = self%buffer%text()//line_end
   end function json_text

   !> Writes comma, line, indent and key before an item.
   pure subroutine begin_item(self, key)
      class(json_t), intent(inout) :: self
      character(*), intent(in), optional :: key

      if (.not. self%is_empty) call self%buffer%add(',')
      if (self%depth > 0) call begin_line(self)
      if (present(key)) call self%buffer%add(json_string(key)//': ')
      self%is_empty = .false.
   end subroutine begin_item

   !> Begins a new line, with its indent.
   pure subroutine begin_line(self)
      class(json_t), intent(inout) :: self

      if (.not. self%is_one_line) then
         call self%buffer%add(line_end//repeat('  ', self%depth))
      else if (.not. self%is_empty) then
         call self%buffer%add(' ')
      end if
   end subroutine begin_line

   !> A string between quotes. Quote, backslash and control characters are escaped; all other characters (UTF-8) are unchanged.
   pure function json_string(text) result(literal)
      character(*), intent(in) :: text
      character(:), allocatable :: literal
      character(2) :: digits
      integer :: k, code, first

      literal = '"'
      first = 1                               ! the first character that is not yet copied
      do k = 1, len(text)
         code = iachar(text(k:k))
         select case (code)
         case (34, 92)                        ! quote, backslash
            literal = literal//text(first:k - 1)//achar(92)//text(k:k)
         case (10)
            literal = literal//text(first:k - 1)//'\n'
         case (9)
            literal = literal//text(first:k - 1)//'\t'
         case (0:8, 11:31, 127)
            write (digits, '(z2.2)') code
            literal = literal//text(first:k - 1)//'\u00'//digits
         case default
            cycle
         end select
         first = k + 1
      end do
      literal = literal//text(first:)//'"'
   end function json_string

   !> A number as a literal; null if the number is not finite.
   pure function json_number(value) result(literal)
      real(wp), intent(in) :: value
      character(:), allocatable :: literal

      literal = 'null'
      if (ieee_is_finite(value)) literal = decimal(value)
   end function json_number

   !> A list of strings on one line, each as UTF-8.
   pure function json_strings(texts) result(literal)
      type(message_list_t), intent(in) :: texts
      character(:), allocatable :: literal
      type(buffer_t) :: list
      integer :: k

      call list%add('[')
      do k = 1, texts%count()
         if (k > 1) call list%add(', ')
         call list%add(json_string(as_utf8(texts%line(k))))
      end do
      call list%add(']')
      literal = list%text()
   end function json_strings

   !> A list of numbers on one line; null for a number that is not finite.
   pure function json_numbers(values, digits, separator) result(literal)
      real(wp), intent(in) :: values(:)
      integer, intent(in), optional :: digits               !! significant digits to which the numbers are rounded
      character(*), intent(in), optional :: separator       !! ', ' if not given
      character(:), allocatable :: literal, between
      type(buffer_t) :: buffer
      integer :: k

      between = ', '
      if (present(separator)) between = separator
      call buffer%add('[')
      do k = 1, size(values)
         if (k > 1) call buffer%add(between)
         if (present(digits)) call buffer%add(json_number(rounded(values(k), digits)))
         if (.not. present(digits)) call buffer%add(json_number(values(k)))
      end do
      call buffer%add(']')
      literal = buffer%text()
   end function json_numbers

   !> JSON with every '<' escaped; otherwise '</script' would end the block of data of a page.
   pure function without_tags(json) result(text)
      character(*), intent(in) :: json
      character(:), allocatable :: text
      type(buffer_t) :: out
      integer :: from, at

      from = 1
      do
         at = scan(json(from:), '<')
         if (at == 0) exit
         call out%add(json(from:from + at - 2))
         call out%add('\u003c')
         from = from + at
      end do
      call out%add(json(from:))
      text = out%text()
   end function without_tags

end module ek_json
