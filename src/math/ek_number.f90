!> The numbers of kernels: the values that differ between designs.
!>
!> A kernel is compiled twice from one source. With this module, the numbers `real(num)` of a kernel are reals. The build also makes
!> a copy of the kernel (src/lanes/make_lanes.cmake) in which the numbers are `type(lanes_t)`, the numbers of four designs, and
!> `ek_lanes` replaces this module.
!> "How a kernel is written" in docs/compilers.md gives the rules.
module ek_number
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: num, mask, piece, zero, one, some, every, pieces_below, entry

   integer, parameter :: num = wp               !! real(num): a number that differs between designs
   integer, parameter :: mask = kind(.true.)    !! logical(mask): a condition on such numbers
   integer, parameter :: piece = kind(1)        !! integer(piece): a position in a table, found by such numbers

   real(num), parameter :: zero = 0.0_num, one = 1.0_num     !! 0 and 1 for initial values of components and for constants

contains

   !> Whether a condition holds for any of the designs.
   elemental logical function some(condition)
      logical(mask), intent(in) :: condition
      some = condition
   end function some

   !> Whether a condition holds for all designs.
   elemental logical function every(condition)
      logical(mask), intent(in) :: condition
      every = condition
   end function every

   !> The number of breaks that are less than or equal to x.
   pure integer(piece) function pieces_below(breaks, x)
      real(num), intent(in) :: breaks(:), x
      pieces_below = count(breaks <= x)
   end function pieces_below

   !> Entry k of a table.
   pure real(num) function entry(table, k)
      real(num), intent(in) :: table(:)
      integer(piece), intent(in) :: k
      entry = table(k)
   end function entry

end module ek_number
