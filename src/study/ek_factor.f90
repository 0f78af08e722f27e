!> A factor of a study: a number of the deck that takes several values.
module ek_factor
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: factor_t

   type :: factor_t
      character(:), allocatable :: name, path     !! path as in --set
      real(wp), allocatable :: values(:)          !! in the deck's units
      character(:), allocatable :: where          !! 'file:line', for messages
   end type factor_t

end module ek_factor
