!> Writes a deck as a string, group by group, as a person would write it.
module ek_deck_text
   use ek_kinds, only: wp
   use ek_buffer, only: buffer_t
   use ek_decimal, only: put_decimal
   use ek_letters, only: visible
   implicit none(type, external)
   private
   public :: deck_text_t

   integer, parameter :: widest = 118      !! characters of a line after which a list continues on a new line

   !> The deck being written. A group is begun, gets its keys, and is ended.
   type :: deck_text_t
      private
      type(buffer_t) :: buffer
      integer :: column = 0                !! characters of the present line
      logical :: is_first = .true.         !! the group has no key so far
   contains
      procedure :: comment => text_comment, heading => text_heading, blank => text_blank, begin => text_begin, &
         word => text_word, words => text_words, add_word => text_add_word, number => text_number, numbers => text_numbers, &
         end => text_end, text => text_text
   end type deck_text_t

contains

   !> Writes a comment line. Line feeds in the string become blanks, and other invisible characters are shown by their numbers.
   subroutine text_comment(self, words)
      class(deck_text_t), intent(inout) :: self
      character(*), intent(in) :: words

      call self%buffer%add('! ')
      call add_safe(self, words)
      call self%buffer%line('')
   end subroutine text_comment

   !> Writes a comment line as the heading of a section, between two empty lines.
   subroutine text_heading(self, words)
      class(deck_text_t), intent(inout) :: self
      character(*), intent(in) :: words

      call text_blank(self)
      call text_comment(self, '---- '//words//' ----')
      call text_blank(self)
   end subroutine text_heading

   subroutine text_blank(self)
      class(deck_text_t), intent(inout) :: self
      call self%buffer%line('')
   end subroutine text_blank

   subroutine text_begin(self, group)
      class(deck_text_t), intent(inout) :: self
      character(*), intent(in) :: group

      call self%buffer%add('&'//group)
      self%column = len(group) + 1
      self%is_first = .true.
   end subroutine text_begin

   !> Writes a key with a string: key = 'word'.
   subroutine text_word(self, key, word)
      class(deck_text_t), intent(inout) :: self
      character(*), intent(in) :: key, word

      call put_key(self, key)
      call put_quoted(self, word)
   end subroutine text_word

   !> Writes a key with two strings: key = 'first', 'second'.
   subroutine text_words(self, key, first, second)
      class(deck_text_t), intent(inout) :: self
      character(*), intent(in) :: key, first, second

      call put_key(self, key)
      call put_quoted(self, first)
      call self%buffer%add(', ')
      call put_quoted(self, second)
   end subroutine text_words

   !> Writes one string of a list. The key is written with the first string.
   subroutine text_add_word(self, key, word, is_first)
      class(deck_text_t), intent(inout) :: self
      character(*), intent(in) :: key, word
      logical, intent(in) :: is_first

      if (is_first) then
         call put_key(self, key)
      else
         call self%buffer%add(', ')
         if (self%column > widest) call break_line(self)
      end if
      call put_quoted(self, word)
   end subroutine text_add_word

   subroutine text_number(self, key, value)
      class(deck_text_t), intent(inout) :: self
      character(*), intent(in) :: key
      real(wp), intent(in) :: value

      call put_key(self, key)
      call put_number(self, value)
   end subroutine text_number

   !> Writes a key with numbers: key = 1, 2.5, 3.
   subroutine text_numbers(self, key, values)
      class(deck_text_t), intent(inout) :: self
      character(*), intent(in) :: key
      real(wp), intent(in) :: values(:)
      integer :: k

      call put_key(self, key)
      do k = 1, size(values)
         if (k > 1) call self%buffer%add(', ')
         if (self%column > widest) call break_line(self)
         call put_number(self, values(k))
      end do
   end subroutine text_numbers

   subroutine text_end(self)
      class(deck_text_t), intent(inout) :: self
      call self%buffer%line(' /')
   end subroutine text_end

   !> The deck written so far as a string.
   function text_text(self) result(text)
      class(deck_text_t), intent(in) :: self
      character(:), allocatable :: text
      text = self%buffer%text()
   end function text_text

   subroutine put_key(self, key)
      class(deck_text_t), intent(inout) :: self
      character(*), intent(in) :: key

      if (.not. self%is_first) then
         call self%buffer%add(',')
         self%column = self%column + 1
      end if
      if (self%column > 90) call break_line(self)
      self%is_first = .false.
      call self%buffer%add(' '//key//' = ')
      self%column = self%column + len(key) + 4
   end subroutine put_key

   subroutine break_line(self)
      class(deck_text_t), intent(inout) :: self

      call self%buffer%line('')
      call self%buffer%add('        ')
      self%column = 8
   end subroutine break_line

   subroutine put_number(self, value)
      class(deck_text_t), intent(inout) :: self
      real(wp), intent(in) :: value
      character(40) :: digits
      integer :: used

      used = 0
      call put_decimal(value, digits, used)
      call self%buffer%add(digits(:used))
      self%column = self%column + used + 2
   end subroutine put_number

   subroutine put_quoted(self, word)
      class(deck_text_t), intent(inout) :: self
      character(*), intent(in) :: word
      integer :: before

      before = self%buffer%length()
      call self%buffer%add('''')
      call add_safe(self, word)
      call self%buffer%add('''')
      self%column = self%column + self%buffer%length() - before
   end subroutine put_quoted

   !> Adds a string. Line feeds become blanks, and other invisible characters are shown by their numbers. An apostrophe becomes the
   !> typographic apostrophe (’), which does not end a string of the deck.
   subroutine add_safe(self, text)
      class(deck_text_t), intent(inout) :: self
      character(*), intent(in) :: text
      character(*), parameter :: apostrophe = char(226)//char(128)//char(153)
      character(:), allocatable :: seen
      integer :: k

      seen = visible(text)
      do k = 1, len(seen)
         select case (seen(k:k))
         case ('''')
            call self%buffer%add(apostrophe)
         case (achar(10), achar(13))
            call self%buffer%add(' ')
         case default
            call self%buffer%add(seen(k:k))
         end select
      end do
   end subroutine add_safe

end module ek_deck_text
