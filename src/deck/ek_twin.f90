!> The two records that &mirror creates from a record of the left half, one per side, with the side in their names.
module ek_twin
   use ek_text, only: lower
   implicit none(type, external)
   private
   public :: single, left_twin, right_twin, twin_prefix, has_side

   integer, parameter :: single = 0, left_twin = 1, right_twin = 2
   character(*), parameter :: twin_prefix(2) = [character(6) :: 'left_', 'right_']

contains

   !> Whether a name begins with left_ or right_.
   pure logical function has_side(name)
      character(*), intent(in) :: name
      has_side = index(lower(name), trim(twin_prefix(left_twin))) == 1 .or. &
         index(lower(name), trim(twin_prefix(right_twin))) == 1
   end function has_side

end module ek_twin
