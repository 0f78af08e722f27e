!> A small JSON writer (RFC 8259): objects and lists in order, indented, one item per line.
!>
!>     call json%open('{')
!>     call json%text_item('unit', 'deg/m')
!>     call json%number_item('value', 1.5_wp)
!>     call json%close('}')
!>
!> Numbers have 15 significant digits; values that are not finite are `null`, because JSON cannot represent them.
module ek_json
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_decimal, only: decimal
   implicit none(type, external)
   private
   public :: json_t, json_string, json_number

   character(*), parameter :: line_end = new_line('a')

   type :: json_t
      private
      type(buffer_t) :: buffer
      integer :: depth = 0
      logical :: is_empty = .true.     !! the innermost list or object has no item yet
   contains
      procedure :: open => json_open, close => json_close, text_item => json_text_item, &
         number_item => json_number_item, integer_item => json_integer_item, numbers_item => json_numbers_item, &
         text => json_text
   end type json_t

contains

   !> Begin an object '{' or a list '['; `key` if it is part of an object.
   pure subroutine json_open(self, bracket, key)
      class(json_t), intent(inout) :: self
      character(1), intent(in) :: bracket
      character(*), intent(in), optional :: key

      call begin_item(self, key)
      call self%buffer%add(bracket)
      self%depth = self%depth + 1
      self%is_empty = .true.
   end subroutine json_open

   !> End the innermost object '}' or list ']'.
   pure subroutine json_close(self, bracket)
      class(json_t), intent(inout) :: self
      character(1), intent(in) :: bracket

      self%depth = self%depth - 1
      if (.not. self%is_empty) call self%buffer%add(line_end//repeat('  ', self%depth))
      call self%buffer%add(bracket)
      self%is_empty = .false.
   end subroutine json_close

   pure subroutine json_text_item(self, key, value)
      class(json_t), intent(inout) :: self
      character(*), intent(in) :: key, value

      call begin_item(self, key)
      call self%buffer%add(json_string(value))
   end subroutine json_text_item

   pure subroutine json_number_item(self, key, value)
      class(json_t), intent(inout) :: self
      character(*), intent(in) :: key
      real(wp), intent(in) :: value

      call begin_item(self, key)
      call self%buffer%add(json_number(value))
   end subroutine json_number_item

   pure subroutine json_integer_item(self, key, value)
      class(json_t), intent(inout) :: self
      character(*), intent(in) :: key
      integer, intent(in) :: value

      call begin_item(self, key)
      call self%buffer%add(str(value))
   end subroutine json_integer_item

   !> A list of numbers on one line.
   pure subroutine json_numbers_item(self, key, values)
      class(json_t), intent(inout) :: self
      character(*), intent(in) :: key
      real(wp), intent(in) :: values(:)
      integer :: k

      call begin_item(self, key)
      call self%buffer%add('[')
      do k = 1, size(values)
         if (k > 1) call self%buffer%add(', ')
         call self%buffer%add(json_number(values(k)))
      end do
      call self%buffer%add(']')
   end subroutine json_numbers_item

   !> The complete text, with a line end.
   pure function json_text(self) result(text)
      class(json_t), intent(in) :: self
      character(:), allocatable :: text
      text = self%buffer%text()//line_end
   end function json_text

   !> Comma, line, indent and key before an item.
   pure subroutine begin_item(self, key)
      class(json_t), intent(inout) :: self
      character(*), intent(in), optional :: key

      if (.not. self%is_empty) call self%buffer%add(',')
      if (self%depth > 0) call self%buffer%add(line_end//repeat('  ', self%depth))
      if (present(key)) call self%buffer%add(json_string(key)//': ')
      self%is_empty = .false.
   end subroutine begin_item

   !> A text between quotes: quote, backslash and control characters escaped, all other characters (UTF-8) unchanged.
   pure function json_string(text) result(literal)
      character(*), intent(in) :: text
      character(:), allocatable :: literal
      character(2) :: digits
      integer :: k, code

      literal = '"'
      do k = 1, len(text)
         code = iachar(text(k:k))
         select case (code)
         case (34, 92)                        ! quote, backslash
            literal = literal//achar(92)//text(k:k)
         case (10)
            literal = literal//'\n'
         case (9)
            literal = literal//'\t'
         case (0:8, 11:31, 127)
            write (digits, '(z2.2)') code
            literal = literal//'\u00'//digits
         case default
            literal = literal//text(k:k)
         end select
      end do
      literal = literal//'"'
   end function json_string

   !> A number, or null if it is not finite.
   pure function json_number(value) result(literal)
      real(wp), intent(in) :: value
      character(:), allocatable :: literal

      literal = 'null'
      if (ieee_is_finite(value)) literal = decimal(value)
   end function json_number

end module ek_json
