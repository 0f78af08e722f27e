!> The grid of a test over wheel travel and steering: its levels, and the order in which its states are solved.
!>
!> The states run up and down over the travel, for one value of the steering driver after the other. Consecutive states are
!> therefore neighbours in the grid, and each solution starts from the previous state.
module ek_grid
   use ek_kinds, only: wp
   use ek_case, only: case_t
   implicit none(type, external)
   private
   public :: is_grid, grid_size, grid_levels, grid_place, set_grid_values

contains

   !> Whether the states of a case form a grid.
   pure logical function is_grid(case)
      type(case_t), intent(in) :: case

      is_grid = .false.
      if (allocated(case%test)) is_grid = case%test == 'travel_and_steering'
   end function is_grid

   !> The numbers of levels of travel and of the driver.
   pure function grid_size(case) result(levels)
      type(case_t), intent(in) :: case
      integer :: levels(2)
      levels = [case%increments, case%steer_increments] + 1
   end function grid_size

   !> The levels of one direction, in SI. Both ends are exact.
   pure function grid_levels(from, to, increments) result(levels)
      real(wp), intent(in) :: from, to
      integer, intent(in) :: increments
      real(wp) :: levels(increments + 1)
      integer :: k

      do k = 0, increments
         levels(k + 1) = level(from, to, increments, k)
      end do
   end function grid_levels

   !> The value of level k of a range that is divided into `increments`.
   pure real(wp) function level(from, to, increments, k)
      real(wp), intent(in) :: from, to
      integer, intent(in) :: increments, k
      level = (from*(increments - k) + to*k)/increments
   end function level

   !> The indices of the levels of travel and of the driver for state `row` of the grid, from 1.
   pure function grid_place(levels, row) result(place)
      integer, intent(in) :: levels(2), row
      integer :: place(2)

      place(2) = (row - 1)/levels(1) + 1
      place(1) = row - (place(2) - 1)*levels(1)
      if (mod(place(2), 2) == 0) place(1) = levels(1) + 1 - place(1)
   end function grid_place

   !> Sets the travel or the driver value in every state of a grid. Memory of a suitable size is used again.
   pure subroutine set_grid_values(case, is_of_driver, values)
      type(case_t), intent(in) :: case
      logical, intent(in) :: is_of_driver
      real(wp), allocatable, intent(inout) :: values(:)     !! m, or rad of a driver that turns
      integer :: levels(2), place(2), k

      levels = grid_size(case)
      if (allocated(values)) then
         if (size(values) /= product(levels)) deallocate (values)
      end if
      if (.not. allocated(values)) allocate (values(product(levels)))
      do k = 1, size(values)
         place = grid_place(levels, k)
         if (is_of_driver) then
            values(k) = level(case%steer_from, case%steer_to, case%steer_increments, place(2) - 1)
         else
            values(k) = level(case%from, case%to, case%increments, place(1) - 1)
         end if
      end do
   end subroutine set_grid_values

end module ek_grid
