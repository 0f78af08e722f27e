!> One key number of a report.
module ek_key_number
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: key_number_t

   type :: key_number_t
      character(:), allocatable :: group, quantity, unit, sign
      real(wp) :: left = 0.0_wp, right = 0.0_wp      !! not a number if missing
      logical :: is_of_axle = .false.                !! one number, in `left`
   end type key_number_t

end module ek_key_number
