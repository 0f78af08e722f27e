!> A table of a study that is read line by line, because it may be larger than the memory.
module ek_table_lines
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_file
   use ek_text, only: quoted
   use ek_decimal, only: get_decimal
   implicit none(type, external)
   private
   public :: lines_t, open_table, next_line, take_numbers, close_table

   integer, parameter :: longest_line = 4000000      !! length of the longest line of column names [characters]
   integer, parameter :: longest_message = 1000      !! characters stored of the message on a failed design

   !> A table that is read line by line.
   type :: lines_t
      character(:), allocatable :: path
      integer :: unit = -1, line = 0
      character(:), allocatable :: content
      integer :: used = 0
   end type lines_t

contains

   !> Opens a table, rejects a table of another deck (checksum in the header), and reads the names of the columns.
   subroutine open_table(path, deck_sum, lines, names, error)
      character(*), intent(in) :: path
      character(*), intent(in) :: deck_sum           !! checksum of the deck; '': no comparison
      type(lines_t), intent(inout) :: lines
      character(64), allocatable, intent(out) :: names(:)
      type(error_t), allocatable, intent(out) :: error
      integer :: status, first, comma

      lines%path = path
      allocate (character(longest_line) :: lines%content)
      allocate (names(0))
      open (newunit=lines%unit, file=path, status='old', action='read', iostat=status)
      if (status /= 0) then
         lines%unit = -1
         call fail(error, exit_file, 'cannot read '//quoted(path))
         return
      end if
      do
         call next_line(lines, status)
         if (status /= 0) then
            call fail(error, exit_file, path//': the line of column names is missing')
            return
         end if
         if (index(lines%content(:lines%used), '#') /= 1) exit
         if (deck_sum == '' .or. index(lines%content(:lines%used), 'deck checksum ') == 0) cycle
         if (index(lines%content(:lines%used), 'deck checksum '//deck_sum) == 0) then
            call fail(error, exit_file, path//' was computed from another deck, or with other --set; run the study again')
            return
         end if
      end do
      first = 1
      do while (first <= lines%used)
         comma = index(lines%content(first:lines%used)//',', ',') + first - 1
         names = [character(64) :: names, lines%content(first:comma - 1)]
         first = comma + 1
      end do
      ! Fortran fills the text with blanks for every line: no longer than a row of numbers and a message
      deallocate (lines%content)
      allocate (character(28*size(names) + longest_message) :: lines%content)
   end subroutine open_table

   !> Reads the next line that is not empty; status is not 0 at the end of the file.
   subroutine next_line(lines, status)
      type(lines_t), intent(inout) :: lines
      integer, intent(out) :: status

      do
         lines%used = 0
         ! libgfortran stores everything that it reads without advancing; the rest of a long message is not needed
         read (lines%unit, '(a)', iostat=status) lines%content
         if (status /= 0) return
         lines%used = len_trim(lines%content)
         lines%line = lines%line + 1
         if (lines%used > 0) return
      end do
   end subroutine next_line

   !> Reads the first numbers of a line. Other content becomes NaN. `rest` is the position at which the next field begins.
   pure subroutine take_numbers(content, values, rest, are_numbers)
      character(*), intent(in) :: content
      real(wp), intent(out) :: values(:)
      integer, intent(out) :: rest
      logical, intent(out), optional :: are_numbers  !! .false. if a field is missing or is not a number; nan is a number
      logical :: is_number, are_all
      integer :: k, comma

      are_all = .true.
      rest = 1
      do k = 1, size(values)
         comma = index(content(rest:), ',')
         if (comma == 0) comma = len(content) - rest + 2
         call get_decimal(content(rest:rest + comma - 2), values(k), is_number)
         are_all = are_all .and. is_number
         rest = min(rest + comma, len(content) + 1)
      end do
      if (present(are_numbers)) are_numbers = are_all
   end subroutine take_numbers

   !> Closes a table, if it is open.
   subroutine close_table(lines)
      type(lines_t), intent(inout) :: lines

      if (lines%unit /= -1) close (lines%unit)
      lines%unit = -1
   end subroutine close_table

end module ek_table_lines
