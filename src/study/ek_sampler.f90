!> The kinds of studies. A kind is a sampler: it makes the values of the factors from the number of a design, so that the designs
!> are the same in any order and with any number of workers. Only 'step_size' (ek_step_size) varies the solution, not the deck.
!>
!> A new kind: its own file or procedures; here its row in `kinds`, and its calls in `design_count` and `sample`.
module ek_sampler
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: factor_t, kind_t, kinds, design_count, sample

   !> A number of the deck that takes several values.
   type :: factor_t
      character(:), allocatable :: name, path     !! path as in --set
      real(wp), allocatable :: values(:)          !! in the deck's units
      character(:), allocatable :: where          !! 'file:line', for messages
   end type factor_t

   !> A kind, and what a study of this kind must have.
   type :: kind_t
      character(12) :: name
      integer :: min_factors, max_factors, min_increments
      character(30) :: needs       !! the same, for the message
   end type kind_t

   type(kind_t), parameter :: kinds(*) = [ &
      kind_t('step_size', 0, huge(1), 1, 'increments = …'), &
      kind_t('sweep', 1, 2, 0, 'one or two &factor groups')]

contains

   !> The number of designs.
   pure integer function design_count(kind, factors) result(designs)
      character(*), intent(in) :: kind
      type(factor_t), intent(in) :: factors(:)

      designs = 0
      select case (kind)
      case ('sweep')
         designs = grid_size(factors)
      end select
   end function design_count

   !> The values of the factors of design `number` = 1, 2, …, in the units of the deck.
   pure subroutine sample(kind, factors, number, values, begins_block)
      character(*), intent(in) :: kind
      type(factor_t), intent(in) :: factors(:)
      integer, intent(in) :: number
      real(wp), intent(out) :: values(:)
      logical, intent(out) :: begins_block      !! gnuplot needs an empty line before this design

      select case (kind)
      case ('sweep')
         call grid_design(factors, number, values, begins_block)
      end select
   end subroutine sample

   !> 'sweep': every combination of the values of the factors; those of the last factor change first.
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

end module ek_sampler
