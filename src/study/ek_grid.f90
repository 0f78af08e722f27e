!> The sampler of kind 'sweep': every combination of the values of the factors; those of the last factor change first.
module ek_grid
   use ek_kinds, only: wp
   use ek_factor, only: factor_t
   implicit none(type, external)
   private
   public :: grid_size, grid_design

contains

   !> The number of designs.
   pure integer function grid_size(factors)
      type(factor_t), intent(in) :: factors(:)
      integer :: f

      grid_size = product([(size(factors(f)%values), f=1, size(factors))])
   end function grid_size

   !> Design `number`. A block is a row of the grid of two factors.
   pure subroutine grid_design(factors, number, values, begins_block)
      type(factor_t), intent(in) :: factors(:)
      integer, intent(in) :: number
      real(wp), intent(out) :: values(:)
      logical, intent(out) :: begins_block
      integer :: f, rest

      rest = number - 1
      do f = size(factors), 1, -1
         values(f) = factors(f)%values(1 + mod(rest, size(factors(f)%values)))
         rest = rest/size(factors(f)%values)
      end do
      begins_block = size(factors) > 1 .and. mod(number - 1, size(factors(size(factors))%values)) == 0
   end subroutine grid_design

end module ek_grid
