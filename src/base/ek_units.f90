!> Units at the interface: decks may use mm, N and deg; inside, everything is SI and radians.
!>
!> A deck value times the factor here is in SI. Results are always written in mm, N, deg and
!> N m, regardless of the deck's units.
module ek_units
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: units_t, pi, degree, millimetre

   real(wp), parameter :: pi = acos(-1.0_wp)
   real(wp), parameter :: degree = pi/180.0_wp      !! rad
   real(wp), parameter :: millimetre = 1.0e-3_wp    !! m

   !> Factors from deck units to SI.
   type :: units_t
      real(wp) :: length = millimetre   !! m per deck length unit
      real(wp) :: force = 1.0_wp        !! N per deck force unit
      real(wp) :: angle = degree        !! rad per deck angle unit
   end type units_t

end module ek_units
