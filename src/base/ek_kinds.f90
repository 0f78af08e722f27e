!> Number kinds, and units at the interface: decks may use mm, N and deg or other units; inside, everything is SI and radians.
!>
!> A deck value times its factor in `units_t` is in SI. Results are always written in mm, N, deg and N m, regardless of the deck's
!> units.
module ek_kinds
   use, intrinsic :: iso_fortran_env, only: real64, int64
   implicit none(type, external)
   private
   public :: wp, i8, units_t, pi, degree, millimetre, inch, pound, standard_gravity

   integer, parameter :: wp = real64   !! working precision: IEEE double
   integer, parameter :: i8 = int64    !! 64-bit integers for counters and clocks

   real(wp), parameter :: pi = acos(-1.0_wp)
   real(wp), parameter :: degree = pi/180.0_wp      !! one degree [rad]
   real(wp), parameter :: millimetre = 1.0e-3_wp    !! one millimetre [m]
   real(wp), parameter :: inch = 0.0254_wp          !! one inch [m], exact by definition
   real(wp), parameter :: pound = 0.45359237_wp     !! one avoirdupois pound [kg], exact by definition
   real(wp), parameter :: standard_gravity = 9.80665_wp      !! gravity that defines the pound-force and g [m/s²]

   !> Factors from deck units to SI.
   type :: units_t
      real(wp) :: length = millimetre   !! m per deck length unit
      real(wp) :: force = 1.0_wp        !! N per deck force unit
      real(wp) :: angle = degree        !! rad per deck angle unit
      real(wp) :: mass = 1.0_wp         !! kg per deck mass unit
   end type units_t

end module ek_kinds
