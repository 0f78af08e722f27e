!> Units below the headings of a table, as measuring programs write them: 'mm', '[N/mm]', '(deg)', '-'.
module ek_unit_row
   use ek_text, only: lower
   use ek_quantity, only: unit_of, unit_text
   implicit none(type, external)
   private
   public :: is_unit, is_same_unit, unit_of_heading

   !> Units, in lower case and without blanks and points. A quotient of two of them is a unit too.
   character(*), parameter :: known(*) = [character(7) :: 'mm', 'cm', 'm', 'km', 'in', 'inch', 'ft', 'n', 'kn', 'lbf', 'lb', &
      'nm', 'nmm', 'knm', '100nm', 'kg', 'g', 't', 's', 'ms', 'min', 'h', 'hz', 'deg', 'degree', 'degrees', 'rad', 'mrad', '%', &
      'percent', '1', 'm2', 's2', 'k', 'c', 'degc', 'v', 'bar']

contains

   !> Whether a string is a unit. The strings '' and '-' mean "no unit" and are not units.
   pure logical function is_unit(text)
      character(*), intent(in) :: text
      character(:), allocatable :: unit
      integer :: mark

      unit = plain(text)
      mark = index(unit, '/')
      if (mark > 0) then
         is_unit = any(known == unit(:mark - 1)) .and. any(known == unit(mark + 1:))
      else
         is_unit = any(known == unit) .and. unit /= '1'
      end if
   end function is_unit

   !> Whether two strings are the same unit.
   pure logical function is_same_unit(one, other)
      character(*), intent(in) :: one, other

      is_same_unit = plain(one) == plain(other)
   end function is_same_unit

   !> The unit at the end of a column heading as a label: 'N/mm' for 'rate_n_per_mm'; '' for a heading without a known unit.
   pure function unit_of_heading(heading) result(unit)
      character(*), intent(in) :: heading
      character(:), allocatable :: unit

      unit = unit_text(unit_of(heading))
      if (unit_of(heading) == '' .or. .not. is_unit(unit)) unit = ''
   end function unit_of_heading

   !> A unit in lower case, without brackets, blanks and multiplication signs, with one spelling of deg and %.
   pure function plain(text) result(unit)
      character(*), intent(in) :: text
      character(:), allocatable :: unit
      character(*), parameter :: degree_sign = char(194)//char(176), point = char(194)//char(183), square = char(194)//char(178)
      integer :: k

      unit = ''
      k = 1
      do while (k <= len(text))
         select case (text(k:k))
         case ('[', ']', '(', ')', ' ', '*', '.', '^', '"')
            continue
         case (char(194))
            if (text(k:min(k + 1, len(text))) == degree_sign) unit = unit//'deg'
            if (text(k:min(k + 1, len(text))) == square) unit = unit//'2'
            if (text(k:min(k + 1, len(text))) == point) unit = unit//''
            k = k + 1
         case default
            unit = unit//lower(text(k:k))
         end select
         k = k + 1
      end do
      if (unit == 'degree' .or. unit == 'degrees') unit = 'deg'
      if (unit == 'percent') unit = '%'
      if (unit == 'inch') unit = 'in'
   end function plain

end module ek_unit_row
