!> Strings from outside in a gnuplot script: the title of a deck, a cell of a foreign table, a path.
!>
!> Every string that is not fixed in this program is converted here. A line end in such a string would begin a command.
module ek_gnuplot_text
   implicit none(type, external)
   private
   public :: gnuplot_text, gnuplot_name, gnuplot_comment, file_letters, one_line

contains

   !> A string between single quotes. gnuplot interprets only a quote and a line end in such a string: quotes are doubled, and
   !> blanks replace control characters.
   pure function gnuplot_text(text) result(literal)
      character(*), intent(in) :: text
      character(:), allocatable :: literal
      integer :: k, first

      literal = "'"
      first = 1                                 ! the first character that is not yet copied
      do k = 1, len(text)
         if (text(k:k) /= "'") cycle
         literal = literal//one_line(text(first:k))//"'"
         first = k + 1
      end do
      literal = literal//one_line(text(first:))//"'"
   end function gnuplot_text

   !> A column name between double quotes. gnuplot interprets a double quote, a backslash and a backquote in such a name: '_'
   !> replaces these characters.
   pure function gnuplot_name(text) result(literal)
      character(*), intent(in) :: text
      character(len(text) + 2) :: literal
      integer :: k

      literal = '"'//one_line(text)//'"'
      do k = 2, len(text) + 1
         if (scan(literal(k:k), '"\`') == 1) literal(k:k) = '_'
      end do
   end function gnuplot_name

   !> A comment of one line. A backslash at the end would continue the comment on the next line: '/' replaces this backslash.
   pure function gnuplot_comment(text) result(comment)
      character(*), intent(in) :: text
      character(len(text) + 2) :: comment

      comment = '# '//one_line(text)
      if (comment(len(comment):) == '\') comment(len(comment):) = '/'
   end function gnuplot_comment

   !> A string as a file name: letters, digits and the other characters of test and column names; any other character becomes '_'.
   !> The result has no folder, is not hidden, and cannot be mistaken for a command option.
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

   !> A string in which blanks replace control characters.
   pure function one_line(text) result(line)
      character(*), intent(in) :: text
      character(len(text)) :: line
      integer :: k

      line = text
      do k = 1, len(text)
         if (iachar(text(k:k)) < 32 .or. iachar(text(k:k)) == 127) line(k:k) = ' '
      end do
   end function one_line

end module ek_gnuplot_text
