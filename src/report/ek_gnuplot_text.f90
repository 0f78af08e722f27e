!> Text from outside in a gnuplot script: the title of a deck, a cell of a foreign table, a path.
!>
!> Every text that is not fixed in this program is converted here. A line end in it would begin a command.
module ek_gnuplot_text
   implicit none(type, external)
   private
   public :: gnuplot_text, gnuplot_name, gnuplot_comment, file_letters

contains

   !> A text between single quotes, in which gnuplot interprets only a quote and the end of the line.
   pure function gnuplot_text(text) result(literal)
      character(*), intent(in) :: text
      character(:), allocatable :: literal
      integer :: k

      literal = "'"
      do k = 1, len(text)
         literal = literal//one_line(text(k:k))
         if (text(k:k) == "'") literal = literal//"'"
      end do
      literal = literal//"'"
   end function gnuplot_text

   !> A column name between double quotes; gnuplot accepts no quote and no backslash in it.
   pure function gnuplot_name(text) result(literal)
      character(*), intent(in) :: text
      character(:), allocatable :: literal
      integer :: k

      literal = '"'
      do k = 1, len(text)
         if (text(k:k) == '"' .or. text(k:k) == '\' .or. text(k:k) == '`') then
            literal = literal//'_'
         else
            literal = literal//one_line(text(k:k))
         end if
      end do
      literal = literal//'"'
   end function gnuplot_name

   !> A comment of one line. A backslash at its end would continue it on the next line.
   pure function gnuplot_comment(text) result(comment)
      character(*), intent(in) :: text
      character(:), allocatable :: comment
      integer :: k

      comment = '# '
      do k = 1, len(text)
         comment = comment//one_line(text(k:k))
      end do
      if (len(text) == 0) return
      if (text(len(text):) == '\') comment(len(comment):) = '/'
   end function gnuplot_comment

   !> A file name: letters, digits and the other characters of test and column names; any other character becomes '_'. The
   !> result has no folder, is not hidden, and is not mistaken for an option of a command.
   pure function file_letters(text) result(name)
      character(*), intent(in) :: text
      character(:), allocatable :: name
      character(*), parameter :: plain = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_'
      integer :: k

      name = text
      do k = 1, len(text)
         if (index(plain, text(k:k)) > 0 .or. iachar(text(k:k)) > 127) cycle
         if (k > 1 .and. index('.-+ ', text(k:k)) > 0) cycle
         name(k:k) = '_'
      end do
   end function file_letters

   !> A character, or a blank for a control character.
   pure character(1) function one_line(letter)
      character(1), intent(in) :: letter

      one_line = letter
      if (iachar(letter) < 32 .or. iachar(letter) == 127) one_line = ' '
   end function one_line

end module ek_gnuplot_text
