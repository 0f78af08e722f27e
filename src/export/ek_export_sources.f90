!> The curves with which an exported table should agree: the ordinary tests of the rig, solved separately on their own paths.
module ek_export_sources
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_wheel_side, only: left_and_right, prefix_of, deck_frame
   use ek_case_result, only: case_result_t, solve_options_t, solve_with_remarks
   use ek_table, only: table_t, column
   use ek_kandc_map, only: kandc_map_t
   use ek_map_request, only: map_request_t, over_steer, over_opposite
   use ek_load_response, only: load_table_result_t, solve_loads
   use ek_wheel_motion, only: iso_frame
   use ek_rig_rows, only: rig_case
   implicit none(type, external)
   private
   public :: sources_t, solve_sources, source_values

   type :: sources_t
      type(table_t) :: travel, steer            !! tables of the travel and the steering test
      logical :: has_steer = .false.
      character(:), allocatable :: prefix       !! prefix of the columns of the drawn wheel
      integer :: side = 1                       !! side of the drawn wheel: 1 left, 2 right
      real(wp) :: frame(3) = 1.0_wp             !! signs of x, y, z from the deck to ISO
      type(load_table_result_t) :: loads
   end type sources_t

contains

   !> Solves travel, steering and loads again, with other increments than the map.
   subroutine solve_sources(suspension, request, map, is_at_patch, sources, error)
      type(suspension_t), intent(in) :: suspension
      type(map_request_t), intent(in) :: request
      type(kandc_map_t), intent(in) :: map
      logical, intent(in) :: is_at_patch               !! the forces of the loads act at the contact points
      type(sources_t), intent(out) :: sources
      type(error_t), allocatable, intent(out) :: error
      integer, parameter :: increments = 97
      type(case_t) :: case
      integer :: wheels(2)

      call left_and_right(suspension, wheels)
      sources%side = merge(1, 2, wheels(1) > 0)
      sources%prefix = prefix_of(suspension, wheels(sources%side))
      sources%frame = deck_frame(suspension)*iso_frame
      case = rig_case('parallel_travel', map%vertical)
      case%name = 'source'
      case%increments = increments
      case%has_all = .true.                  ! also the wheel loads
      if (map%kind == over_opposite) case%test = 'single_travel'
      case%wheel = wheels(sources%side)
      case%from = map%travel(1)
      case%to = map%travel(size(map%travel))
      call run(case, sources%travel, error)
      if (allocated(error)) return
      sources%has_steer = map%kind == over_steer
      if (sources%has_steer) then
         case%test = 'steering'
         case%drive = map%driver
         case%from = map%driver_sign*map%second(1)
         case%to = map%driver_sign*map%second(size(map%second))
         call run(case, sources%steer, error)
         if (allocated(error)) return
      end if
      call solve_loads(suspension, request, 1000.0_wp, 100.0_wp, 21, is_at_patch, sources%loads, error)

   contains

      !> Solves a case and returns its table.
      subroutine run(this, table, error)
         type(case_t), intent(in) :: this
         type(table_t), intent(out) :: table
         type(error_t), allocatable, intent(out) :: error
         type(solve_options_t) :: options
         class(case_result_t), allocatable :: result

         allocate (result)
         options%is_compared = .false.
         call solve_with_remarks(suspension, this, options, result, error)
         if (.not. allocated(error)) table = result%table
      end subroutine run

   end subroutine solve_sources

   !> The values of a column of the drawn wheel, in ISO directions.
   function source_values(sources, table, name) result(values)
      type(sources_t), intent(in) :: sources
      type(table_t), intent(in) :: table            !! of the sources
      character(*), intent(in) :: name              !! without the prefix of the wheel
      real(wp), allocatable :: values(:)

      values = column(table, sources%prefix//name)
      if (name == 'wheel_centre_x_mm') values = values*sources%frame(1)
      if (name == 'wheel_centre_y_mm') values = values*sources%frame(2)
   end function source_values

end module ek_export_sources
