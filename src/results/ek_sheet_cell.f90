!> The number in a cell of a table that a person or a spreadsheet has written, and the reason why a cell contains none.
module ek_sheet_cell
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_decimal, only: get_decimal
   implicit none(type, external)
   private
   public :: get_cell, cell_fault

   real(wp), parameter :: most = 1.0e31_wp      !! numbers of this size are errors, and could overflow later

contains

   !> Reads the number in a cell without quotes. A comma is a decimal mark if `has_commas`.
   pure subroutine get_cell(cell, has_commas, value, is_good, may_be_nan)
      character(*), intent(in) :: cell
      logical, intent(in) :: has_commas
      real(wp), intent(out) :: value             !! nan if the cell contains no number
      logical, intent(out) :: is_good            !! the cell contains a finite number below 1e31
      logical, intent(in), optional :: may_be_nan      !! 'nan' and 'inf' are good too; default .false.
      character(len(cell)) :: text
      integer :: comma

      comma = 0
      if (has_commas) comma = index(cell, ',')
      if (comma > 0) then
         if (index(cell, '.') > 0 .or. index(cell(comma + 1:), ',') > 0) comma = 0
      end if
      if (comma > 0) then
         text = cell
         text(comma:comma) = '.'
         call get_decimal(text, value, is_good)
      else
         call get_decimal(cell, value, is_good)
      end if
      if (.not. is_good) return
      if (present(may_be_nan)) then
         if (may_be_nan) return
      end if
      is_good = ieee_is_finite(value)
      if (is_good) is_good = abs(value) < most
   end subroutine get_cell

   !> Describes a cell in which get_cell finds no good number: expected, found, and the remedy.
   pure function cell_fault(cell, has_commas) result(fault)
      character(*), intent(in) :: cell
      logical, intent(in) :: has_commas
      character(:), allocatable :: fault
      real(wp) :: value
      logical :: is_good
      integer :: blank

      call get_cell(cell, has_commas, value, is_good, may_be_nan=.true.)
      if (is_good) then
         fault = 'expected a finite number, found '//quoted(cell)
         if (ieee_is_finite(value)) fault = 'expected a number below '//str(most)//', found '//quoted(cell)
      else if (cell == '') then
         fault = 'expected a number, found an empty cell'
      else if (verify(cell, '+-.0123456789eEdD') == 0 .and. scan(cell, '0123456789') > 0 .and. scan(cell, 'eEdD') > 1) then
         fault = 'expected a number below '//str(most)//', found '//quoted(cell)
      else
         fault = 'expected a number, found '//quoted(cell)
         blank = scan(cell, ' abcdfghijklmnopqrstuvwxyzABCDFGHIJKLMNOPQRSTUVWXYZ%')
         if (index(cell, ',') > 0 .and. index(cell, '.') > 0) then
            fault = fault//' (write numbers without thousands separators)'
         else if (index(cell, ',') > 0) then
            fault = fault//' (write a decimal point, here and in all numbers of the file)'
         else if (index(cell, char(226)//char(136)//char(146)) == 1 .or. index(cell, char(226)//char(128)//char(147)) == 1) then
            fault = fault//' (write the minus sign as -)'
         else if (blank > 1) then
            call get_cell(cell(:blank - 1), has_commas, value, is_good)
            if (is_good) fault = fault//' (write the number alone; its unit is given in the column name)'
         end if
      end if
   end function cell_fault

end module ek_sheet_cell
