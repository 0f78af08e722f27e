!> The noticeable change of a result: a difference that an engineer would notice, as weight of a condition of `solve`.
!>
!> The noticeable change follows from the unit of the quantity. For the unit of a slope that is not in the table, it is the change
!> of the numerator over a usual change of the denominator.
module ek_noticeable
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: noticeable_change

   type :: notice_t
      character(8) :: unit
      real(wp) :: change
   end type notice_t

   !> Noticeable changes of values, in their units.
   type(notice_t), parameter :: values(*) = [notice_t('mm', 0.1_wp), notice_t('deg', 0.01_wp), notice_t('N', 10.0_wp), &
      notice_t('N m', 1.0_wp), notice_t('m', 0.01_wp), notice_t('%', 1.0_wp), notice_t('Hz', 0.01_wp), notice_t('N/mm', 0.1_wp), &
      notice_t('N m/deg', 1.0_wp)]
   !> Usual changes of abscissas, in their units.
   type(notice_t), parameter :: abscissas(*) = [notice_t('m', 0.1_wp), notice_t('mm', 10.0_wp), notice_t('deg', 1.0_wp), &
      notice_t('kN', 1.0_wp), notice_t('N', 1.0e3_wp), notice_t('100 N m', 1.0_wp), notice_t('100nm', 1.0_wp), &
      notice_t('N m', 100.0_wp), notice_t('g', 1.0_wp)]
   real(wp), parameter :: share = 0.01_wp           !! noticeable change of other quantities, as a share of their value

contains

   !> The noticeable change of a quantity, in its unit; always positive.
   pure real(wp) function noticeable_change(unit, size) result(change)
      character(*), intent(in) :: unit              !! unit as a label: 'deg/m'
      real(wp), intent(in) :: size                  !! value of the quantity, if its unit is not known; 0 or NaN counts as 1
      integer :: at, k

      change = share
      if (ieee_is_finite(size)) then
         if (abs(size) > 0.0_wp) change = share*abs(size)
      end if
      k = findloc(values%unit, unit, dim=1)
      if (k > 0) then
         change = values(k)%change
         return
      end if
      at = index(unit, '/')
      if (at == 0) return
      k = findloc(values%unit, unit(:at - 1), dim=1)
      if (k == 0) return
      change = values(k)%change
      k = findloc(abscissas%unit, unit(at + 1:), dim=1)
      if (k > 0) change = change/abscissas(k)%change
   end function noticeable_change

end module ek_noticeable
