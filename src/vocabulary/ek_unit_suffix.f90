!> Units of columns. The unit of a column is the end of its name: 'toe_deg', 'wheel_rate_n_per_mm'. A column of another program has
!> its unit in brackets: 'Toe Angle [deg]'.
module ek_unit_suffix
   use ek_kinds, only: wp, degree, millimetre
   implicit none(type, external)
   private
   public :: unit_of, unit_text, unit_ending, unit_size, slope_unit, head_with_unit

   character(*), parameter :: travel = 'wheel_travel_mm'

   !> A unit as the suffix of a column name and as a label, with its SI value.
   type :: unit_t
      character(13) :: ending
      character(12) :: text
      real(wp) :: size = 1.0_wp
   end type unit_t

   type(unit_t), parameter :: units(*) = [unit_t('mm', 'mm', millimetre), unit_t('deg', 'deg', degree), unit_t('n', 'N'), &
      unit_t('nm', 'N m'), unit_t('m', 'm'), unit_t('percent', '%'), unit_t('hz', 'Hz'), unit_t('n_per_mm', 'N/mm', 1.0e3_wp), &
      unit_t('nm_per_deg', 'N m/deg', 1.0_wp/degree), unit_t('deg_per_m', 'deg/m', degree), unit_t('deg_per_deg', 'deg/deg'), &
      unit_t('deg_per_kn', 'deg/kN', degree/1.0e3_wp), unit_t('mm_per_kn', 'mm/kN', 1.0e-6_wp), &
      unit_t('deg_per_100nm', 'deg/100 N m', degree/100.0_wp), unit_t('n_per_kn', 'N/kN', 1.0e-3_wp), &
      unit_t('mm_per_m', 'mm/m'), unit_t('mm_per_g', 'mm/g', millimetre), unit_t('mm_per_mm', 'mm/mm'), &
      unit_t('deg_per_mm', 'deg/mm'), unit_t('n_per_deg', 'N/deg'), unit_t('deg_per_nmm', 'deg/(N mm)')]

contains

   !> The unit of a column name as a suffix: 'mm', 'n_per_mm'; '' if the name has no unit.
   pure function unit_of(column) result(unit)
      character(*), intent(in) :: column
      character(:), allocatable :: unit
      integer :: mark, last

      last = len_trim(column)
      mark = 0
      if (last > 0) mark = merge(index(column, ' [', back=.true.), 0, column(last:last) == ']')
      if (mark > 0) then
         unit = unit_ending(column(mark + 2:last - 1))
         return
      end if
      mark = index(column, '_per_')
      if (mark > 0) then
         unit = column(index(column(:mark - 1), '_', back=.true.) + 1:)
      else
         unit = column(index(column, '_', back=.true.) + 1:)
         if (.not. any(units%ending == unit)) unit = ''
      end if
   end function unit_of

   !> A unit as a label: 'N/mm' for 'n_per_mm'; '–' for no unit and for an unknown unit.
   pure function unit_text(unit) result(text)
      character(*), intent(in) :: unit
      character(:), allocatable :: text
      integer :: k

      k = findloc(units%ending, unit, dim=1)
      text = '–'
      if (k > 0) text = trim(units(k)%text)
   end function unit_text

   !> The suffix of the column names that have a unit: 'n_per_mm' for 'N/mm'; '' for an unknown unit.
   pure function unit_ending(text) result(ending)
      character(*), intent(in) :: text              !! unit as a label
      character(:), allocatable :: ending
      integer :: k

      k = findloc(units%text, text, dim=1)
      ending = ''
      if (k > 0) ending = trim(units(k)%ending)
   end function unit_ending

   !> SI value of the unit of a column. The value is 1 for a column without a known unit, for %, mm/m, deg/deg and mm/mm, and for
   !> deg/mm, N/deg and deg/(N mm), which are not converted.
   pure real(wp) function unit_size(column) result(size_of)
      character(*), intent(in) :: column
      integer :: k

      k = findloc(units%ending, unit_of(column), dim=1)
      size_of = 1.0_wp
      if (k > 0) size_of = units(k)%size
   end function unit_size

   !> Finds the unit of a slope as the suffix of a column name, 'deg_per_m', and the factor that converts the slope from the units
   !> of its two columns. Angles over wheel travel are in deg/m. Slopes over a force are per kN, except slopes of a force. Slopes
   !> over a moment are per 100 N m, except slopes of a moment. All other slopes have the units of the columns.
   pure subroutine slope_unit(column, over, factor_unit, unit, factor)
      character(*), intent(in) :: column, over
      character(*), intent(in) :: factor_unit             !! unit of the column `factor`: 'mm', 'deg', 'N', 'N m', '-'
      character(:), allocatable, intent(out) :: unit
      real(wp), intent(out) :: factor
      character(:), allocatable :: upper, lower
      integer :: k

      upper = unit_of(column)
      lower = unit_of(over)
      if (over == 'factor') then
         k = findloc(units%text, factor_unit, dim=1)
         if (k > 0) lower = trim(units(k)%ending)
      end if
      factor = 1.0_wp
      if (lower == 'mm' .and. upper == 'deg' .and. index(over//' ', travel//' ') > 0) then
         lower = 'm'
         factor = 1.0e3_wp
      else if (lower == 'n' .and. upper /= 'n') then
         lower = 'kn'
         factor = 1.0e3_wp
      else if (lower == 'nm' .and. upper /= 'nm') then
         lower = '100nm'
         factor = 100.0_wp
      else if (lower == '') then
         lower = over
      end if
      unit = 'per_'//lower
      if (upper /= '') unit = upper//'_'//unit
   end subroutine slope_unit

   !> A column heading with a unit as suffix: 'seat_mm' for 'seat' and 'mm'. The heading 'seat_mm' is unchanged.
   pure function head_with_unit(name, ending) result(head)
      character(*), intent(in) :: name
      character(*), intent(in) :: ending             !! unit as in column names; '': no unit
      character(:), allocatable :: head
      integer :: at

      head = name
      if (ending == '') return
      at = len(name) - len(ending)
      if (at > 0) then
         if (name(at:) == '_'//ending) return
      end if
      head = name//'_'//ending
   end function head_with_unit

end module ek_unit_suffix
