!> A text with one change, for tests that read many variants of one file. In a change | stands for a line end,
!> ~ for a carriage return, ^ for a tab.
module ek_changed_text
   use ek_buffer, only: buffer_t
   use ek_error, only: error_t
   use ek_file, only: read_whole
   implicit none(type, external)
   private
   public :: file_text, changed_text

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
