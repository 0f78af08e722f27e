!> A string that grows piece by piece, used to build pages, scripts and tables.
!>
!> The capacity doubles when it is exhausted, so that appending n characters costs O(n) for pieces of any size. A string has at most
!> 2 GB, as characters are counted in default integers; larger tables are written piece by piece (ek_writer).
module ek_buffer
   use ek_kinds, only: i8
   implicit none(type, external)
   private
   public :: buffer_t

   integer, parameter :: first_room = 4096   !! initial capacity [characters]

   type :: buffer_t
      private
      character(:), allocatable :: letters
      integer :: used = 0
   contains
      procedure :: add => buffer_add, line => buffer_line, text => buffer_text, length => buffer_length, &
         copy => buffer_copy, clear => buffer_clear
   end type buffer_t

contains

   !> Appends characters.
   pure subroutine buffer_add(self, text)
      class(buffer_t), intent(inout) :: self
      character(*), intent(in) :: text
      character(:), allocatable :: grown

      if (.not. allocated(self%letters)) allocate (character(max(first_room, len(text))) :: self%letters)
      if (len(text) > huge(1) - self%used) error stop 'a string of more than 2 GB'
      if (self%used + len(text) > len(self%letters)) then
         allocate (character(int(min(2_i8*(self%used + len(text)), int(huge(1), i8)))) :: grown)
         grown(:self%used) = self%letters(:self%used)
         call move_alloc(grown, self%letters)
      end if
      self%letters(self%used + 1:self%used + len(text)) = text
      self%used = self%used + len(text)
   end subroutine buffer_add

   !> Appends characters and a line end.
   pure subroutine buffer_line(self, text)
      class(buffer_t), intent(inout) :: self
      character(*), intent(in) :: text

      call self%add(text)
      call self%add(new_line('a'))
   end subroutine buffer_line

   !> The string appended so far.
   pure function buffer_text(self) result(text)
      class(buffer_t), intent(in) :: self
      character(:), allocatable :: text

      text = ''
      if (allocated(self%letters)) text = self%letters(:self%used)
   end function buffer_text

   !> Copies the characters of the string from position `first` on to `part`. Pieces of a long string can thus be read without a
   !> copy of the complete string.
   pure subroutine buffer_copy(self, first, part)
      class(buffer_t), intent(in) :: self
      integer, intent(in) :: first
      character(*), intent(inout) :: part       !! its last character must be within the string

      if (len(part) > 0) part = self%letters(first:first + len(part) - 1)
   end subroutine buffer_copy

   !> The number of characters of the string appended so far.
   pure integer function buffer_length(self) result(length)
      class(buffer_t), intent(in) :: self
      length = self%used
   end function buffer_length

   !> Deletes the string, or the part after its first `behind` characters. The capacity is unchanged.
   pure subroutine buffer_clear(self, behind)
      class(buffer_t), intent(inout) :: self
      integer, intent(in), optional :: behind   !! characters that remain, at most the length

      self%used = 0
      if (present(behind)) self%used = behind
   end subroutine buffer_clear

end module ek_buffer
