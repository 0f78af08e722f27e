!> The definition of a slope as a sentence, from which its value follows: columns, and the factor on the slope of each wheel.
module ek_slope_definition
   use ek_kinds, only: wp
   use ek_text, only: str
   implicit none(type, external)
   private
   public :: slope_definition

contains

   !> The definition of a slope: 'least-squares slope of toe_deg over factor, times −1000 (left wheel), 1000 (right wheel)'. The
   !> value is the slope of the columns as they are in the table of the test, times the factor.
   function slope_definition(column, over, per_factor, unit, times) result(text)
      character(*), intent(in) :: column, over      !! columns of y and x, without the name of the wheel
      real(wp), intent(in) :: per_factor            !! load or displacement at `factor` = 1
      character(*), intent(in) :: unit              !! its unit, with a leading blank
      real(wp), intent(in) :: times(2)              !! factor of each wheel on the slope in the unit of the window; 0: no number
      character(:), allocatable :: text

      text = 'least-squares slope of '//column//' over '//over
      if (over /= 'factor') then
         text = text//times_of(times)
         return
      end if
      if (abs(per_factor - 1.0_wp) > 0.0_wp) text = text//' (1: '//signed(per_factor)//unit//')'
      text = text//times_of(times/per_factor)
   end function slope_definition

   !> The factors on the slopes of the columns of both wheels, which include unit and sign: ', times 1000', or ', times −1000 (left
   !> wheel), 1000 (right wheel)'; '' if both are 1. The factor of a wheel without the number is 0.
   function times_of(times) result(text)
      real(wp), intent(in) :: times(2)
      character(:), allocatable :: text
      real(wp) :: both(2)

      both = times
      where (.not. abs(both) > 0.0_wp) both = times([2, 1])
      text = ''
      if (all(abs(both - 1.0_wp) <= 0.0_wp)) return
      if (abs(both(1) - both(2)) <= 0.0_wp) then
         text = ', times '//signed(both(1))
      else
         text = ', times '//signed(both(1))//' (left wheel), '//signed(both(2))//' (right wheel)'
      end if
   end function times_of

   !> A number with the minus sign of the page.
   function signed(number) result(text)
      real(wp), intent(in) :: number
      character(:), allocatable :: text

      text = str(abs(number), 9)
      if (number < 0.0_wp) text = '−'//text
   end function signed

end module ek_slope_definition
