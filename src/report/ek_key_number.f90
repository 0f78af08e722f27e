!> One key number of a report.
module ek_key_number
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: key_number_t, new_number, nothing

   type :: key_number_t
      character(:), allocatable :: group, quantity, unit, sign
      real(wp) :: left = 0.0_wp, right = 0.0_wp      !! not a number if missing
      logical :: is_of_axle = .false.                !! one number, in `left`
   end type key_number_t

contains

   !> The value of a missing number.
   pure real(wp) function nothing()
      nothing = ieee_value(1.0_wp, ieee_quiet_nan)
   end function nothing

   !> A number without values.
   subroutine new_number(group, quantity, unit, sign, number)
      character(*), intent(in) :: group, quantity, unit, sign
      type(key_number_t), intent(out) :: number

      number%group = group
      number%quantity = quantity
      number%unit = unit
      number%sign = sign
      number%left = nothing()
      number%right = nothing()
   end subroutine new_number

end module ek_key_number
