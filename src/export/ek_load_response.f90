!> The response of both wheels of an axle to loads on one wheel at a time, as a table of states.
module ek_load_response
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_suspension, only: suspension_t
   use ek_case, only: load_table_t
   use ek_wheel_side, only: left_and_right, prefix_of
   use ek_case_result, only: case_result_t
   use ek_wheel_motion, only: iso_loads, quantities
   use ek_map_request, only: map_request_t
   use ek_rig_rows, only: add_column, solve_table, motions
   implicit none(type, external)
   private
   public :: load_table_result_t, solve_loads, load_parts, load_heads

   !> The loads on a wheel that springs do not support: Fx, Fy, Mx, My, Mz as indices among the six components, and the headings of
   !> their columns.
   integer, parameter :: load_parts(5) = [1, 2, 4, 5, 6]
   character(*), parameter :: load_heads(5) = [character(5) :: 'fx_n', 'fy_n', 'mx_nm', 'my_nm', 'mz_nm']

   !> The response to loads: one row per state.
   type :: load_table_result_t
      real(wp), allocatable :: load(:, :)          !! (component of left, then right wheel: Fx, Fy, Mx, My, Mz; row), ISO [N, N m]
      real(wp), allocatable :: value(:, :, :)      !! (quantity of ek_wheel_motion, row, side)
   end type load_table_result_t

contains

   !> Solves the response of both wheels to loads on one wheel at a time. The wheels are held as in the compliance.
   subroutine solve_loads(suspension, request, force, moment, count, is_at_patch, loads, error)
      type(suspension_t), intent(in) :: suspension
      type(map_request_t), intent(in) :: request
      real(wp), intent(in) :: force, moment            !! greatest force and moment [N, N m]
      integer, intent(in) :: count                     !! number of values of a load, odd
      logical, intent(in) :: is_at_patch               !! forces at the contact point, otherwise at the wheel centre
      type(load_table_result_t), intent(out) :: loads
      type(error_t), allocatable, intent(out) :: error
      integer, parameter :: at_centre = 6              ! added to the component of a table_column_t
      type(load_table_t) :: table
      class(case_result_t), allocatable :: result
      real(wp), allocatable :: values(:), motion(:, :)
      character(:), allocatable :: vertical
      integer :: wheels(2), side, part, rows, at, k, component

      allocate (result)
      call left_and_right(suspension, wheels)
      rows = 5*count*merge(2, 1, all(wheels > 0))
      allocate (table%columns(0), loads%load(10, rows), loads%value(quantities, rows, 2), values(rows))
      loads%load = 0.0_wp
      loads%value = 0.0_wp
      table%rows = rows
      at = 0
      do side = 1, 2
         if (wheels(side) == 0) cycle
         do part = 1, 5
            values = 0.0_wp
            do k = 1, count
               values(at + k) = merge(force, moment, part <= 2)*(2.0_wp*real(k - 1, wp)/(count - 1) - 1.0_wp)
            end do
            loads%load(5*(side - 1) + part, :) = values
            component = load_parts(part)
            if (part <= 2 .and. .not. is_at_patch) component = component + at_centre
            ! the rig counts components in the frame of the deck
            if (.not. suspension%is_iso) values = values*iso_loads(load_parts(part))
            call add_column(table, prefix_of(suspension, wheels(side))//trim(load_heads(part)), wheels(side), component, values)
            at = at + count
         end do
      end do
      vertical = request%held
      call solve_table(suspension, table, vertical, result, error)
      if (allocated(error)) return
      do side = 1, 2
         if (wheels(side) == 0) cycle
         call motions(result, wheels(side), request%choices(:, side), motion)
         loads%value(:, :, side) = motion
      end do
   end subroutine solve_loads

end module ek_load_response
