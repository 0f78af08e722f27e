!> A load case: one driving thing that goes from one value to another in increments.
module ek_case
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: case_t, method_names, default_tolerance, most_increments

   character(*), parameter :: method_names(3) = [character(11) :: 'recursive', 'corrected', 'equilibrium']
   integer, parameter :: most_increments = 1000000   !! a state takes about 3 kB on its way to the file
   real(wp), parameter :: default_tolerance = 1.0e-10_wp   !! m, that is 1e-7 mm

   !> Exactly one of `load` and `drive` is not empty.
   type :: case_t
      character(:), allocatable :: name, where
      character(:), allocatable :: load     !! name of the load scaled by the case
      character(:), allocatable :: drive    !! 'wheel_travel', or the name of a driver joint
      integer :: wheel = 1                  !! whose travel is driven
      real(wp) :: from = 0.0_wp, to = 0.0_wp   !! factor of the load [-], or change of the driven value [m, rad]
      integer :: increments = 100
      character(:), allocatable :: method   !! one of method_names
      real(wp) :: tolerance = default_tolerance   !! last Newton correction of a state, at most [m]
   end type case_t

end module ek_case
