!> The kinds of studies. A kind is a sampler: it makes the values of the factors from the number of a design, so that the designs
!> are the same in any order and with any number of workers. Only 'step_size' (ek_step_size) varies the solution, not the deck.
!>
!> A new kind: its own file; here its row in `kinds`, and its calls in `design_count` and `sample`.
module ek_sampler
   use ek_kinds, only: wp
   use ek_factor, only: factor_t
   use ek_grid, only: grid_size, grid_design
   implicit none(type, external)
   private
   public :: kind_t, kinds, design_count, sample

   !> A kind, and what a study of this kind must have.
   type :: kind_t
      character(12) :: name
      integer :: least_factors, most_factors, least_increments
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

end module ek_sampler
