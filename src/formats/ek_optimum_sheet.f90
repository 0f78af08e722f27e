!> A sheet of a workbook of OptimumKinematics, saved as CSV: titles of sections, and rows of a name with x, y, z of the left side,
!> an empty cell, and x, y, z of the right side. There are no headings of columns.
!>
!> The sheet is converted to a table with headings and the same lines, which ek_point_table reads. Rows with one number, as
!> 'Half Track' or 'Static Toe', are listed as not read.
module ek_optimum_sheet
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_decimal, only: get_decimal
   use ek_kinds, only: wp
   use ek_fields, only: lines_t
   use ek_car_number, only: car_number_of
   use ek_point_heading, only: cut_cell, coordinate_of
   implicit none(type, external)
   private
   public :: is_optimum_sheet, as_point_table

   integer, parameter :: least = 4             !! rows with names of OptimumKinematics, from which a text is such a sheet

   !> A row: its name, and up to six numbers as they are written.
   type :: row_t
      character(:), allocatable :: name
      character(:), allocatable :: cells       !! x, y, z of both sides, each with the separator in front
      integer :: numbers = 0
   end type row_t

contains

   !> Whether lines are such a sheet: the first two have no heading x, y or z, and some have a name such as CHAS_LowFor and numbers.
   logical function is_optimum_sheet(lines)
      type(lines_t), intent(in) :: lines
      type(row_t) :: row
      integer :: k, found
      character :: separator

      is_optimum_sheet = .false.
      if (lines%count < least) return
      separator = separator_of(lines)
      if (has_headings(lines%line(1), separator)) return
      if (has_headings(lines%line(2), separator)) return
      found = 0
      do k = 1, lines%count
         call split_row(lines%line(k), separator, row)
         if (row%numbers >= 3 .and. is_own_name(row%name)) found = found + 1
      end do
      is_optimum_sheet = found >= least
   end function is_optimum_sheet

   !> Whether a line has a heading x, y or z.
   logical function has_headings(line, separator)
      character(*), intent(in) :: line
      character, intent(in) :: separator
      character(:), allocatable :: rest, cell

      rest = line
      has_headings = .false.
      do while (rest /= '' .and. .not. has_headings)
         call cut_cell(rest, separator, cell)
         has_headings = coordinate_of(cell) > 0
      end do
   end function has_headings

   !> Converts a sheet to a table with headings in its first line. Numbers that are not read are listed.
   subroutine as_point_table(lines, text, omitted)
      type(lines_t), intent(in) :: lines
      character(:), allocatable, intent(out) :: text
      type(message_list_t), intent(inout) :: omitted
      type(row_t) :: row
      character :: separator
      integer :: k

      separator = separator_of(lines)
      text = 'name'//separator//'left x'//separator//'left y'//separator//'left z'//separator//'right x'//separator//'right y'// &
         separator//'right z'
      do k = 2, lines%count
         text = text//new_line('a')
         call split_row(lines%line(k), separator, row)
         if (row%numbers == 6) then
            text = text//without_side(row%name)//row%cells
         else if (row%numbers == 3) then
            text = text//row%name//row%cells//repeat(separator, 3)
         else if (row%numbers > 0 .and. car_number_of(row%name) > 0) then
            text = text//row%name//row%cells//repeat(separator, 6 - row%numbers)
         else if (row%numbers > 0) then
            call omitted%add('line '//str(k)//': '//row%name//' is not a point')
         end if
      end do
      text = text//new_line('a')
   end subroutine as_point_table

   !> Splits a line into its first text and the numbers behind it. Empty cells between numbers are skipped.
   subroutine split_row(line, separator, row)
      character(*), intent(in) :: line
      character, intent(in) :: separator
      type(row_t), intent(out) :: row
      character(:), allocatable :: rest, cell

      row%name = ''
      row%cells = ''
      rest = line
      do while (rest /= '' .and. row%numbers < 7)
         call cut_cell(rest, separator, cell)
         if (cell == '') cycle
         if (row%name == '') then
            if (is_number(cell, separator)) return
            row%name = cell
         else if (is_number(cell, separator)) then
            row%numbers = row%numbers + 1
            row%cells = row%cells//separator//cell
         end if
      end do
      if (row%numbers > 6) row%numbers = 0
   end subroutine split_row

   !> Whether a cell is a number, with a decimal comma unless commas separate the cells.
   logical function is_number(cell, separator)
      character(*), intent(in) :: cell
      character, intent(in) :: separator
      character(:), allocatable :: text
      real(wp) :: value
      integer :: comma

      text = cell
      comma = index(text, ',')
      if (comma > 0 .and. separator /= ',') text(comma:comma) = '.'
      call get_decimal(text, value, is_number)
   end function is_number

   !> The separator of the first line with a name of OptimumKinematics.
   character function separator_of(lines)
      type(lines_t), intent(in) :: lines
      integer :: k

      separator_of = ','
      do k = 1, lines%count
         if (index(lines%line(k), 'CHAS_') == 0) cycle
         if (index(lines%line(k), achar(9)) > 0) separator_of = achar(9)
         if (index(lines%line(k), ';') > 0) separator_of = ';'
         return
      end do
   end function separator_of

   pure logical function is_own_name(name)
      character(*), intent(in) :: name
      is_own_name = index(name, 'CHAS_') == 1 .or. index(name, 'UPRI_') == 1
   end function is_own_name

   !> A name without _L or _R at its end: its row has both sides.
   pure function without_side(name) result(short)
      character(*), intent(in) :: name
      character(:), allocatable :: short

      short = name
      if (len(name) < 4) return
      if (any(['_L', '_R'] == name(len(name) - 1:))) short = name(:len(name) - 2)
   end function without_side

end module ek_optimum_sheet
