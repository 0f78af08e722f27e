!> Units at the interface: decks may use mm, N and deg; inside, everything is SI and radians.
!>
!> A deck value times the factor here is in SI. Results are always written in mm, N, deg and
!> N m, regardless of the deck's units.
module ek_units
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: units_t, new_units, is_length_unit, is_force_unit, is_angle_unit
   public :: pi, degree, millimetre

   real(wp), parameter :: pi = acos(-1.0_wp)
   real(wp), parameter :: degree = pi/180.0_wp      !! rad
   real(wp), parameter :: millimetre = 1.0e-3_wp    !! m

   !> Factors from deck units to SI.
   type :: units_t
      real(wp) :: length = millimetre   !! m per deck length unit
      real(wp) :: force = 1.0_wp        !! N per deck force unit
      real(wp) :: angle = degree        !! rad per deck angle unit
   end type units_t

contains

   !> Units by name; the names must have been checked by the is_* functions.
   pure type(units_t) function new_units(length, force, angle) result(units)
      character(*), intent(in) :: length   !! 'mm' or 'm'
      character(*), intent(in) :: force    !! 'N' or 'kN'
      character(*), intent(in) :: angle    !! 'deg' or 'rad'

      if (length == 'm') then
         units%length = 1.0_wp
      else
         units%length = millimetre
      end if
      if (force == 'kN' .or. force == 'kn') then
         units%force = 1000.0_wp
      else
         units%force = 1.0_wp
      end if
      if (angle == 'rad') then
         units%angle = 1.0_wp
      else
         units%angle = degree
      end if
   end function new_units

   !> Whether a deck may give lengths in this unit.
   pure logical function is_length_unit(name)
      character(*), intent(in) :: name
      is_length_unit = name == 'mm' .or. name == 'm'
   end function is_length_unit

   !> Whether a deck may give forces in this unit; lower case is accepted.
   pure logical function is_force_unit(name)
      character(*), intent(in) :: name
      is_force_unit = name == 'N' .or. name == 'n' .or. name == 'kN' .or. name == 'kn'
   end function is_force_unit

   !> Whether a deck may give angles in this unit.
   pure logical function is_angle_unit(name)
      character(*), intent(in) :: name
      is_angle_unit = name == 'deg' .or. name == 'rad'
   end function is_angle_unit

end module ek_units
