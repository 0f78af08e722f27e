!> One key number of a report.
module ek_key_number
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: key_number_t, nothing

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

end module ek_key_number
