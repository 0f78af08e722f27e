!> Kinematics of an axle as a table over wheel travel and steer, or over the travels of both wheels, with its compliance at design
!> and its response to loads. Every number is an equilibrium of the rig (a test 'table'), or the tangent there.
!>
!> Frame ISO 8855, SI and radians: see ek_wheel_motion. A deck with one wheel gives the other side as its mirror image.
module ek_kandc_map
   use ek_kinds, only: wp, millimetre
   use ek_error, only: error_t, fail, exit_usage, exit_model, exit_convergence
   use ek_text, only: str, quoted
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, load_table_t, table_column_t
   use ek_wheel_side, only: left_and_right, prefix_of, side_name, design_track
   use ek_block, only: rotated
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_compliance, only: compliance_t, new_compliance, wheel_compliance
   use ek_diagnosis, only: diagnosis_t
   use ek_examination, only: examine_case
   use ek_case_result, only: case_result_t, solve_options_t, solve_case, not_solvable
   use ek_table, only: name_length
   use ek_wheel_motion, only: wheel_motion, mirrored, iso_loads, iso_frame, mirror_signs, lengths, length_choice_t, &
      quantities, at_rz
   use ek_held_compliance, only: held_compliance
   implicit none(type, external)
   private
   public :: kandc_map_t, map_request_t, load_table_result_t, solve_map, solve_loads, grid_values
   public :: over_steer, over_opposite, over_none

   ! what the second argument of a map is
   integer, parameter :: over_none = 0, over_steer = 1, over_opposite = 2

   !> What is to be computed.
   type :: map_request_t
      real(wp), allocatable :: travel(:)      !! above design, increasing, with 0 [m]
      real(wp), allocatable :: second(:)      !! steer (positive: to the left) or travel of the other wheel, likewise [m, rad]
      integer :: kind = over_none
      character(:), allocatable :: driver     !! joint that steers
      character(:), allocatable :: vertical   !! travel is the height of the wheel 'centre', the 'patch', or the 'road'
      character(:), allocatable :: held       !! how the wheels are held in the compliance: 'road', 'centre' or 'force'
      type(length_choice_t) :: choices(lengths, 2)
   end type map_request_t

   type :: kandc_map_t
      character(:), allocatable :: model, title
      integer :: kind = over_none
      real(wp), allocatable :: travel(:), second(:)
      real(wp) :: driver_sign = 1.0_wp        !! the driver's value is this times steer
      character(:), allocatable :: driver, vertical, held
      real(wp), allocatable :: value(:, :, :, :)   !! (quantity, second, travel, side)
      !> of each side at design, at the wheel centre, wheels held: own loads, opposite loads
      real(wp) :: compliance(6, 12, 2) = 0.0_wp
      real(wp) :: free(12, 12) = 0.0_wp            !! of both wheels, vertical loads held; ISO; left before right
      real(wp) :: arm(3, 2) = 0.0_wp               !! contact point less wheel centre at design, ISO [m]
      real(wp) :: spin(3, 2) = 0.0_wp              !! spin axes at design, outboard, ISO
      logical :: is_mirrored(2) = .false.          !! the deck has no wheel on this side
      real(wp) :: track = 0.0_wp                   !! of the contact points at design [m]
      character(63) :: length_labels(lengths, 2) = ''
   end type kandc_map_t

   !> The response to loads: one row per state.
   type :: load_table_result_t
      real(wp), allocatable :: load(:, :)          !! (component of left, then right wheel: Fx, Fy, Mx, My, Mz; row), ISO [N, N m]
      real(wp), allocatable :: value(:, :, :)      !! (quantity, row, side)
   end type load_table_result_t

contains

   !> Numbers from `from` to `to` with 0 among them, as equally spaced as this allows.
   pure function grid_values(from, to, count) result(values)
      real(wp), intent(in) :: from, to        !! from ≤ 0 ≤ to
      integer, intent(in) :: count            !! at least 2
      real(wp), allocatable :: values(:)
      integer :: before, k

      before = nint((count - 1)*abs(from)/(to - from))
      if (from < 0.0_wp) before = max(before, 1)
      if (to > 0.0_wp) before = min(before, count - 2)
      allocate (values(count), source=0.0_wp)
      do k = 1, before
         values(k) = from*(real(before + 1 - k, wp)/before)
      end do
      do k = before + 2, count
         values(k) = to*(real(k - before - 1, wp)/(count - 1 - before))
      end do
   end function grid_values

   !> Solves a map. `suspension` is balanced and on no rig.
   subroutine solve_map(suspension, request, map, error)
      type(suspension_t), intent(in) :: suspension
      type(map_request_t), intent(in) :: request
      type(kandc_map_t), intent(out) :: map
      type(error_t), allocatable, intent(out) :: error      !! exit_model, exit_convergence
      real(wp), allocatable :: heights(:, :), steer(:)
      integer, allocatable :: at(:, :)
      type(case_result_t) :: result
      integer :: wheels(2)

      call describe(suspension, request, map)
      call left_and_right(suspension, wheels)
      if (map%kind == over_steer) call find_sign(suspension, request, map, error)
      if (allocated(error)) return
      call order_rows(map, wheels, heights, steer, at)
      call solve_rows(suspension, request, heights, steer*map%driver_sign, result, error)
      if (allocated(error)) return
      call take_values(suspension, request, result, wheels, at, map)
      call take_compliance(result, wheels, map)
      if (.not. any(wheels == 0)) return
      call mirror_map(map, merge(2, 1, wheels(2) == 0), error)
   end subroutine solve_map

   subroutine describe(suspension, request, map)
      type(suspension_t), intent(in) :: suspension
      type(map_request_t), intent(in) :: request
      type(kandc_map_t), intent(inout) :: map
      integer :: wheels(2), side, j

      call left_and_right(suspension, wheels)
      map%model = suspension%name
      map%title = suspension%title
      if (len(map%title) == 0) map%title = suspension%name
      map%kind = request%kind
      map%travel = request%travel
      select case (map%kind)
      case (over_steer)
         map%second = request%second
      case (over_opposite)
         map%second = request%travel
      case default
         map%second = [0.0_wp]
      end select
      map%driver = request%driver
      map%held = request%held
      map%vertical = request%vertical
      map%is_mirrored = wheels == 0
      do side = 1, 2
         if (wheels(side) == 0) cycle
         associate (wheel => suspension%wheels(wheels(side)))
            map%arm(:, side) = iso_frame*(wheel%contact - wheel%centre)
            map%spin(:, side) = iso_frame*wheel%spin
            map%track = 2.0_wp*abs(suspension%bodies(wheel%body)%origin(2) + wheel%contact(2))
         end associate
         do j = 1, lengths
            if (allocated(request%choices(j, side)%label)) map%length_labels(j, side) = request%choices(j, side)%label
         end do
      end do
      if (all(wheels > 0)) map%track = design_track(suspension)
      allocate (map%value(quantities, size(map%second), size(map%travel), 2), source=0.0_wp)
   end subroutine describe

   !> The sign of the driver that turns the wheels to the left.
   subroutine find_sign(suspension, request, map, error)
      type(suspension_t), intent(in) :: suspension
      type(map_request_t), intent(in) :: request
      type(kandc_map_t), intent(inout) :: map
      type(error_t), allocatable, intent(out) :: error
      real(wp), parameter :: share = 0.05_wp, least = 1.0e-6_wp      ! of the range of steer; rad
      type(case_result_t) :: result
      real(wp), allocatable :: motion(:, :)
      integer :: wheels(2), side

      call left_and_right(suspension, wheels)
      side = merge(1, 2, wheels(1) > 0)
      call solve_rows(suspension, request, reshape([0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], [2, 2]), &
         [0.0_wp, share*maxval(abs(request%second))], result, error)
      if (allocated(error)) return
      call motions(result, wheels(side), request%choices(:, side), motion)
      if (abs(motion(at_rz, 2) - motion(at_rz, 1)) < least) then
         call fail(error, exit_usage, 'the driver '//quoted(request%driver)//' does not steer the '//trim(side_name(side))// &
            ' wheel: choose another with --driver NAME, or --map opposite')
         return
      end if
      map%driver_sign = sign(1.0_wp, motion(at_rz, 2) - motion(at_rz, 1))
   end subroutine find_sign

   !> The states to solve, the design state first, then the grid there and back, so that neighbouring rows are neighbours of the
   !> grid.
   pure subroutine order_rows(map, wheels, heights, steer, at)
      type(kandc_map_t), intent(in) :: map
      integer, intent(in) :: wheels(2)
      real(wp), allocatable, intent(out) :: heights(:, :)      !! (side, row)
      real(wp), allocatable, intent(out) :: steer(:)
      integer, allocatable, intent(out) :: at(:, :)            !! (travel, second argument; row): place in the grid
      integer :: i, j, k, n, from, to, step

      n = size(map%travel)*size(map%second)
      allocate (heights(2, n + 1), steer(n + 1), source=0.0_wp)
      allocate (at(2, n + 1), source=0)
      k = 1
      do j = 1, size(map%second)
         step = merge(1, -1, mod(j, 2) == 1)
         from = merge(1, size(map%travel), step == 1)
         to = merge(size(map%travel), 1, step == 1)
         do i = from, to, step
            k = k + 1
            heights(:, k) = map%travel(i)
            if (map%kind == over_opposite) heights(2, k) = map%second(j)
            if (map%kind == over_steer) steer(k) = map%second(j)
            at(:, k) = [i, j]
         end do
      end do
      if (wheels(1) == 0) heights(1, :) = 0.0_wp
   end subroutine order_rows

   !> Solves states of given heights of the wheel centres and of the steering driver; all must converge.
   subroutine solve_rows(suspension, request, heights, steer, result, error)
      type(suspension_t), intent(in) :: suspension
      type(map_request_t), intent(in) :: request
      real(wp), intent(in) :: heights(:, :)      !! (side, row) [m]
      real(wp), intent(in) :: steer(:)           !! of the driver [m, rad]
      type(case_result_t), intent(out) :: result
      type(error_t), allocatable, intent(out) :: error
      type(load_table_t) :: table
      character(:), allocatable :: vertical
      integer :: wheels(2), side

      call left_and_right(suspension, wheels)
      allocate (table%columns(0))
      table%rows = size(steer)
      do side = 1, 2
         if (wheels(side) == 0) cycle
         call add_column(table, prefix_of(suspension, wheels(side))//'travel_mm', wheels(side), 0, heights(side, :))
      end do
      if (request%kind == over_steer) call add_column(table, request%driver, 0, 0, steer)
      vertical = request%vertical
      if (vertical == 'centre') vertical = ''        ! the columns of a table hold the centres by themselves
      call solve_table(suspension, table, vertical, result, error)
   end subroutine solve_rows

   pure subroutine add_column(table, name, wheel, component, values)
      type(load_table_t), intent(inout) :: table
      character(*), intent(in) :: name
      integer, intent(in) :: wheel, component
      real(wp), intent(in) :: values(:)
      type(table_column_t) :: column

      column%name = name
      column%wheel = wheel
      column%component = component
      column%values = values
      table%columns = [table%columns, column]
   end subroutine add_column

   !> Solves the rows of a table; the first that does not converge is the error.
   subroutine solve_table(suspension, table, vertical, result, error)
      type(suspension_t), intent(in) :: suspension
      type(load_table_t), intent(in) :: table
      character(*), intent(in) :: vertical                  !! 'centre', 'road'; '': as the columns say
      type(case_result_t), intent(out) :: result
      type(error_t), allocatable, intent(out) :: error      !! exit_model, exit_convergence
      type(case_t) :: case
      type(solve_options_t) :: options
      type(diagnosis_t) :: diagnosis
      character(:), allocatable :: reason
      integer :: row, k

      case%name = 'export'
      case%where = 'export'
      case%load = ''
      case%drive = ''
      case%test = 'table'
      case%file = 'export'
      case%target = ''
      case%vertical = vertical
      case%method = 'equilibrium'
      case%table = table
      call examine_case(suspension, case, diagnosis)
      if (.not. diagnosis%is_solvable()) then
         call fail(error, exit_model, 'the model cannot be solved'//new_line('a')//diagnosis%words())
         return
      end if
      allocate (options%columns(0))
      options%is_compared = .false.
      call solve_case(suspension, case, options, result)
      if (.not. result%is_run()) then
         call fail(error, exit_model, result%remarks%failures())
         return
      end if
      if (all(result%path%is_reached)) return
      row = findloc(result%path%is_reached, .false., dim=1)
      reason = ''
      do k = 1, size(table%columns)
         associate (column => table%columns(k))
            if (column%component > 0 .and. .not. abs(column%values(row)) > 0.0_wp) cycle
            reason = reason//trim(merge(', ', '  ', len(reason) > 0))//' '//column%name//' = '// &
               str(merge(column%values(row), column%values(row)/millimetre, column%component > 0), 6)
         end associate
      end do
      call fail(error, exit_convergence, str(count(.not. result%path%is_reached))//' of '//str(table%rows)// &
         ' states of the export did not converge, so nothing was written; the first:'//reason// &
         '. Use a shorter range (--travel, --steer, --loads), or more points'//new_line('a')//result%remarks%failures())
   end subroutine solve_table

   !> The motions of one wheel in all rows: (quantity, row).
   subroutine motions(result, wheel, choices, values)
      type(case_result_t), intent(in) :: result
      integer, intent(in) :: wheel
      type(length_choice_t), intent(in) :: choices(lengths)
      real(wp), allocatable, intent(out) :: values(:, :)
      type(state_t) :: state
      type(inputs_t) :: inputs
      type(schedule_t) :: schedule
      integer :: k

      allocate (values(quantities, result%path%states))
      state = design_state(result%suspension)
      schedule = new_schedule(result%suspension, result%case)
      do k = 1, result%path%states
         call unpack_state(result%path%packed(:, k), state)
         call inputs_at(schedule, result%path%value(k), inputs)
         values(:, k) = wheel_motion(result%suspension, state, inputs, wheel, choices)
      end do
   end subroutine motions

   !> The solved rows at their places of the grid.
   subroutine take_values(suspension, request, result, wheels, at, map)
      type(suspension_t), intent(in) :: suspension
      type(map_request_t), intent(in) :: request
      type(case_result_t), intent(in) :: result
      integer, intent(in) :: wheels(2), at(:, :)
      type(kandc_map_t), intent(inout) :: map
      real(wp), allocatable :: motion(:, :)
      integer :: side, k

      do side = 1, 2
         if (wheels(side) == 0) cycle
         call motions(result, wheels(side), request%choices(:, side), motion)
         do k = 2, size(at, 2)
            if (map%kind == over_opposite .and. side == 2) then
               map%value(:, at(1, k), at(2, k), side) = motion(:, k)      ! its own travel is the second of the row
            else
               map%value(:, at(2, k), at(1, k), side) = motion(:, k)
            end if
         end do
      end do
      if (size(suspension%wheels) == 0) map%value = 0.0_wp
   end subroutine take_values

   !> Compliance at design, the first row.
   subroutine take_compliance(result, wheels, map)
      type(case_result_t), intent(inout) :: result
      integer, intent(in) :: wheels(2)
      type(kandc_map_t), intent(inout) :: map
      type(compliance_t) :: compliance
      type(state_t) :: state
      type(inputs_t) :: inputs
      type(schedule_t) :: schedule
      real(wp), allocatable :: c(:, :), arm(:, :), rates(:), signs(:)
      integer :: n, w, k, side, at

      compliance = new_compliance(result%suspension, .false.)
      n = 6*compliance%wheels
      state = design_state(result%suspension)
      schedule = new_schedule(result%suspension, result%case)
      call unpack_state(result%path%packed(:, 1), state)
      call inputs_at(schedule, result%path%value(1), inputs)
      call wheel_compliance(result%suspension, state, inputs, 0, result%kkt, compliance)
      allocate (arm(3, compliance%wheels), rates(compliance%wheels), signs(n))
      signs = [(iso_loads, k=1, compliance%wheels)]
      do w = 1, compliance%wheels
         associate (wheel => result%suspension%wheels(compliance%order(w)))
            arm(:, w) = iso_frame*rotated(state%poses(wheel%body + 1)%a, wheel%contact - wheel%centre)
            rates(w) = wheel%tyre_rate
         end associate
      end do
      c = compliance%response(:n, :n)
      do k = 1, n
         c(:, k) = signs*c(:, k)*signs(k)
      end do
      at = 0
      do side = 1, 2
         if (wheels(side) == 0) cycle
         map%arm(:, side) = arm(:, at/6 + 1)
         if (n == 6) map%free(6*side - 5:6*side, 6*side - 5:6*side) = c
         at = at + 6
      end do
      if (n == 12) map%free = c
      c = held_compliance(c, arm, rates, map%held)
      at = 0
      do side = 1, 2
         if (wheels(side) == 0) cycle
         map%compliance(:, :6, side) = c(at + 1:at + 6, at + 1:at + 6)
         if (n == 12) map%compliance(:, 7:, side) = c(at + 1:at + 6, 7 - at:12 - at)
         at = at + 6
      end do
   end subroutine take_compliance

   !> The side that the deck does not have, as the mirror image of the other.
   subroutine mirror_map(map, to, error)
      type(kandc_map_t), intent(inout) :: map
      integer, intent(in) :: to                            !! 1 left, 2 right
      type(error_t), allocatable, intent(out) :: error     !! exit_usage: a range of steer that is not symmetric
      real(wp), parameter :: same = 1.0e-9_wp
      integer :: from, i, j, n, k

      from = 3 - to
      n = size(map%second)
      if (any(abs(map%second + map%second(n:1:-1)) > same)) then
         call fail(error, exit_usage, 'the deck has one wheel, so the other side is its mirror image: give a range of '// &
            'steer that is symmetric about 0, as --steer -40:40:17')
         return
      end if
      do i = 1, size(map%travel)
         do j = 1, n
            map%value(:, j, i, to) = mirrored(map%value(:, n + 1 - j, i, from))
         end do
      end do
      do k = 1, 12
         map%compliance(:, k, to) = mirror_signs*map%compliance(:, k, from)*mirror_signs(mod(k - 1, 6) + 1)
      end do
      do k = 1, 6
         map%free(6*to - 5:6*to, 6*to - 6 + k) = mirror_signs*map%free(6*from - 5:6*from, 6*from - 6 + k)*mirror_signs(k)
      end do
      map%arm(:, to) = map%arm(:, from)*mirror_signs(:3)
      map%spin(:, to) = map%spin(:, from)*mirror_signs(:3)
      map%length_labels(:, to) = map%length_labels(:, from)
   end subroutine mirror_map

   !> The response of both wheels to loads on one of them at a time, the wheels held as in the compliance.
   subroutine solve_loads(suspension, request, force, moment, count, is_at_patch, loads, error)
      type(suspension_t), intent(in) :: suspension
      type(map_request_t), intent(in) :: request
      real(wp), intent(in) :: force, moment            !! largest [N, N m]
      integer, intent(in) :: count                     !! of values of a load, odd
      logical, intent(in) :: is_at_patch               !! forces at the contact patch, otherwise at the wheel centre
      type(load_table_result_t), intent(out) :: loads
      type(error_t), allocatable, intent(out) :: error
      integer, parameter :: parts(5) = [1, 2, 4, 5, 6], at_centre = 6      ! Fx, Fy, Mx, My, Mz of a table_column_t
      character(8), parameter :: heads(5) = [character(8) :: 'fx_n', 'fy_n', 'mx_nm', 'my_nm', 'mz_nm']
      type(load_table_t) :: table
      type(case_result_t) :: result
      real(wp), allocatable :: values(:), motion(:, :)
      character(:), allocatable :: vertical
      integer :: wheels(2), side, part, rows, at, k, component

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
            component = parts(part)
            if (part <= 2 .and. .not. is_at_patch) component = component + at_centre
            ! the rig counts components in the frame of the deck
            if (.not. suspension%is_iso) values = values*iso_loads(parts(part))
            call add_column(table, prefix_of(suspension, wheels(side))//trim(heads(part)), wheels(side), component, values)
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

end module ek_kandc_map
