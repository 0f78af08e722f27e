!> A text with one change, for tests that read many variants of one file. In a change | stands for a line end,
!> ~ for a carriage return, ^ for a tab. Also the difference of two texts, for tests that compare a whole output.
module ek_changed_text
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_error, only: error_t
   use ek_file, only: read_whole
   implicit none(type, external)
   private
   public :: file_text, changed_text, text_difference

contains

   !> A file of the repository; '' if it is not there.
   function file_text(path) result(text)
      character(*), intent(in) :: path
      character(:), allocatable :: text
      type(error_t), allocatable :: error

      call read_whole(path, text, error)
      if (allocated(error)) text = ''
   end function file_text

   !> The text with `new` in place of the first `old`; '' if it does not have `old`. With old = '' `new` stands before it,
   !> with old = '*' every line end becomes `new`.
   function changed_text(text, old, new) result(changed)
      character(*), intent(in) :: text, old, new
      character(:), allocatable :: changed
      integer :: at

      changed = ''
      if (old == '*') then
         changed = all_ends(text, lines_of(new))
         return
      end if
      at = index(text, lines_of(old))
      if (len(old) > 0 .and. at == 0) return
      if (len(old) == 0) at = 1
      changed = text(:at - 1)//lines_of(new)//text(at + len(old):)
   end function changed_text

   !> The first line in which a text differs from the expected text; '' if they are equal.
   function text_difference(found, expected) result(words)
      character(*), intent(in) :: found, expected
      character(:), allocatable :: words
      integer :: at, k, line, first

      words = ''
      if (len(found) == len(expected)) then
         if (found == expected) return
      end if
      do at = 1, min(len(found), len(expected))
         if (found(at:at) /= expected(at:at)) exit
      end do
      line = 1
      first = 1
      do k = 1, at - 1
         if (found(k:k) /= new_line('a')) cycle
         line = line + 1
         first = k + 1
      end do
      words = 'line '//str(line)//' differs. Expected:'//new_line('a')//first_line(expected(first:))//new_line('a')//'Found:'// &
         new_line('a')//first_line(found(first:))
   end function text_difference

   !> The first line of a text.
   pure function first_line(text) result(line)
      character(*), intent(in) :: text
      character(:), allocatable :: line

      line = text(:index(text//new_line('a'), new_line('a')) - 1)
   end function first_line

   !> A text with | as line end, ~ as carriage return, ^ as tab.
   pure function lines_of(text) result(lines)
      character(*), intent(in) :: text
      character(len(text)) :: lines
      integer :: k

      lines = text
      do k = 1, len(text)
         select case (text(k:k))
         case ('|')
            lines(k:k) = new_line('a')
         case ('~')
            lines(k:k) = achar(13)
         case ('^')
            lines(k:k) = achar(9)
         end select
      end do
   end function lines_of

   !> Every line end replaced.
   pure function all_ends(text, ends) result(changed)
      character(*), intent(in) :: text, ends
      character(:), allocatable :: changed
      type(buffer_t) :: buffer
      integer :: k

      do k = 1, len(text)
         if (text(k:k) == new_line('a')) then
            call buffer%add(ends)
         else
            call buffer%add(text(k:k))
         end if
      end do
      changed = buffer%text()
   end function all_ends

end module ek_changed_text
