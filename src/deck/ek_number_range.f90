!> Legal ranges of a number of a deck.
module ek_number_range
   use ek_kinds, only: wp, pi
   implicit none(type, external)
   private
   public :: any_number, positive, not_negative, not_zero, share, acute, only_zero, is_inside, range_text

   integer, parameter :: any_number = 0, positive = 1, not_negative = 2, not_zero = 3
   integer, parameter :: share = 4      !! 0 to 1
   integer, parameter :: acute = 5      !! an angle between −90° and 90°: the only range whose nonzero limits have a unit
   integer, parameter :: only_zero = 6  !! the rate of a bushing component that has a curve

contains

   !> Whether a number is inside a legal range.
   pure logical function is_inside(range, value)
      integer, intent(in) :: range
      real(wp), intent(in) :: value            !! SI; in any unit if the range is not acute
      real(wp), parameter :: right_angle = 0.5_wp*pi*(1.0_wp - 4.0_wp*epsilon(1.0_wp))     ! 90 deg may fall short by rounding

      select case (range)
      case (positive)
         is_inside = value > 0.0_wp
      case (not_negative)
         is_inside = value >= 0.0_wp
      case (not_zero)
         is_inside = abs(value) > 0.0_wp
      case (share)
         is_inside = value >= 0.0_wp .and. value <= 1.0_wp
      case (acute)
         is_inside = abs(value) < right_angle
      case (only_zero)
         is_inside = .not. abs(value) > 0.0_wp
      case default
         is_inside = .true.
      end select
   end function is_inside

   !> Message about a number outside the range of its key: 'must be above -90 and below 90 deg, found 95 deg'.
   pure function range_text(range, unit, shown) result(words)
      integer, intent(in) :: range            !! not any_number
      character(*), intent(in) :: unit        !! unit of the limits: ' deg'; '' for none
      character(*), intent(in) :: shown       !! the value as a string
      character(:), allocatable :: words
      character(*), parameter :: ranges(6) = [character(32) :: 'above 0', '0 or more', 'not be zero', '0 to 1', &
         'above -90 and below 90', '0 (the component has a curve)']

      words = 'must be '//trim(ranges(range))//trim(unit)//', found '//shown
      if (range == not_zero) words = 'must not be zero'
   end function range_text

end module ek_number_range
