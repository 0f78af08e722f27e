!> Kinematics of an axle as a table over wheel travel and steer, or over the travels of both wheels, with its compliance at
!> design. Every number comes from an equilibrium on the rig (a test 'table'), or from the tangent at an equilibrium.
!>
!> Frame ISO 8855, SI and radians: see ek_wheel_motion. A deck with one wheel gives the other side as its mirror image.
module ek_kandc_map
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_usage, exit_model
   use ek_text, only: quoted
   use ek_suspension, only: suspension_t
   use ek_free_wheels, only: has_rates
   use ek_case, only: load_table_t
   use ek_wheel_side, only: left_and_right, prefix_of, side_name, design_track
   use ek_wheel_contact, only: contact_lever
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_compliance, only: compliance_t, new_compliance, wheel_compliance
   use ek_table, only: table_t, new_table
   use ek_defined_table, only: defined_table
   use ek_case_result, only: case_result_t
   use ek_wheel_motion, only: mirrored, iso_loads, iso_frame, mirror_signs, lengths, quantities, at_rz
   use ek_held_compliance, only: held_compliance
   use ek_map_request, only: map_request_t, over_none, over_steer, over_opposite
   use ek_rig_rows, only: add_column, solve_table, motions
   implicit none(type, external)
   private
   public :: kandc_map_t, solve_map

   type :: kandc_map_t
      character(:), allocatable :: model, title
      integer :: kind = over_none
      real(wp), allocatable :: travel(:), second(:)
      real(wp) :: driver_sign = 1.0_wp        !! 1 or −1: value of the driver for steer 1
      character(:), allocatable :: driver, vertical, held
      real(wp), allocatable :: value(:, :, :, :)   !! (quantity of ek_wheel_motion, second, travel, side)
      !> Compliance of each side at design, at the wheel centre, with wheels held: own loads, then loads on the other wheel
      real(wp) :: compliance(6, 12, 2) = 0.0_wp
      real(wp) :: free(12, 12) = 0.0_wp            !! compliance of both wheels, vertical loads held; ISO; left before right
      real(wp) :: arm(3, 2) = 0.0_wp               !! contact point less wheel centre at design, ISO [m]
      real(wp) :: spin(3, 2) = 0.0_wp              !! spin axes at design, outboard, ISO
      logical :: is_mirrored(2) = .false.          !! the deck has no wheel on this side
      real(wp) :: track = 0.0_wp                   !! distance of the contact points at design [m]
      character(63) :: length_labels(lengths, 2) = ''
      type(table_t), allocatable :: defined        !! columns of another program; rows as in a table, `second` changes fastest
   end type kandc_map_t

contains

   !> Solves a map. `suspension` must have its preload trim (`balance`) applied, and must not be on a rig.
   subroutine solve_map(suspension, request, map, error, program)
      type(suspension_t), intent(in) :: suspension
      type(map_request_t), intent(in) :: request
      type(kandc_map_t), intent(out) :: map
      type(error_t), allocatable, intent(out) :: error      !! exit_model, exit_convergence
      character(*), intent(in), optional :: program         !! the map also has the columns of this program (`defined`)
      real(wp), allocatable :: heights(:, :), steer(:)
      integer, allocatable :: at(:, :)
      class(case_result_t), allocatable :: result
      integer :: wheels(2)

      allocate (result)
      call describe(suspension, request, map)
      call left_and_right(suspension, wheels)
      if (map%kind == over_steer) call find_sign(suspension, request, map, error)
      if (allocated(error)) return
      call order_rows(map, wheels, heights, steer, at)
      call solve_rows(suspension, request, heights, steer*map%driver_sign, result, error, program)
      if (allocated(error)) return
      if (present(program)) call take_defined(result, program, at, map)
      call take_values(suspension, request, result, wheels, at, map)
      call take_compliance(result, wheels, map, error)
      if (allocated(error) .or. .not. any(wheels == 0)) return
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
      allocate (map%travel, source=request%travel)
      select case (map%kind)
      case (over_steer)
         allocate (map%second, source=request%second)
      case (over_opposite)
         allocate (map%second, source=request%travel)
      case default
         allocate (map%second(1), source=0.0_wp)
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

   !> Finds the sign of the driver displacement that turns the wheels to the left. A driver that does not steer is an error.
   subroutine find_sign(suspension, request, map, error)
      type(suspension_t), intent(in) :: suspension
      type(map_request_t), intent(in) :: request
      type(kandc_map_t), intent(inout) :: map
      type(error_t), allocatable, intent(out) :: error
      real(wp), parameter :: share = 0.05_wp, least = 1.0e-6_wp      ! of the range of steer; rad
      class(case_result_t), allocatable :: result
      real(wp), allocatable :: motion(:, :)
      integer :: wheels(2), side

      allocate (result)
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

   !> Lists the states to be solved: first the design state, then the grid in alternating direction, so that consecutive rows are
   !> neighbours in the grid.
   pure subroutine order_rows(map, wheels, heights, steer, at)
      type(kandc_map_t), intent(in) :: map
      integer, intent(in) :: wheels(2)
      real(wp), allocatable, intent(out) :: heights(:, :)      !! (side, row)
      real(wp), allocatable, intent(out) :: steer(:)
      integer, allocatable, intent(out) :: at(:, :)            !! (travel, second argument; row): indices in the grid
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

   !> Solves states with given heights of the wheel centres and positions of the steering driver. All states must converge.
   subroutine solve_rows(suspension, request, heights, steer, result, error, program)
      type(suspension_t), intent(in) :: suspension
      type(map_request_t), intent(in) :: request
      real(wp), intent(in) :: heights(:, :)      !! (side, row) [m]
      real(wp), intent(in) :: steer(:)           !! value of the driver [m]
      type(case_result_t), intent(out) :: result
      type(error_t), allocatable, intent(out) :: error
      character(*), intent(in), optional :: program        !! see solve_table
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
      call solve_table(suspension, table, vertical, result, error, program)
   end subroutine solve_rows

   !> Copies the solved rows to their positions in the grid.
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

   !> Copies the columns of another program to the rows of the grid.
   subroutine take_defined(result, program, at, map)
      type(case_result_t), intent(in) :: result
      character(*), intent(in) :: program
      integer, intent(in) :: at(:, :)
      type(kandc_map_t), intent(inout) :: map
      type(table_t) :: solved
      integer, allocatable :: rows(:), columns(:)
      integer :: k

      call defined_table(result%suspension, result%table, program, solved, rows)
      columns = pack([(k, k=1, size(rows))], rows > 0)
      map%defined = new_table(solved%columns(columns), size(map%travel)*size(map%second))
      map%defined%header = solved%header
      do k = 2, size(at, 2)
         map%defined%values(:, (at(1, k) - 1)*size(map%second) + at(2, k)) = solved%values(columns, k)
      end do
   end subroutine take_defined

   !> Computes the compliance at the design state, which is the first row of the result.
   subroutine take_compliance(result, wheels, map, error)
      type(case_result_t), intent(inout) :: result
      integer, intent(in) :: wheels(2)
      type(kandc_map_t), intent(inout) :: map
      type(error_t), allocatable, intent(out) :: error      !! exit_model: the matrix is singular
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
      if (.not. (compliance%is_known .and. has_rates(result%suspension))) then
         call fail(error, exit_model, 'the stiffness matrix of the design state is singular without the rig, so there is no '// &
            'compliance to export: '//trim(merge('no spring carries the wheels                       ', &
            'elastokin check shows the motion that nothing holds', .not. has_rates(result%suspension))))
         return
      end if
      allocate (arm(3, compliance%wheels), rates(compliance%wheels), signs(n))
      signs = [(iso_loads, k=1, compliance%wheels)]
      do w = 1, compliance%wheels
         associate (wheel => result%suspension%wheels(compliance%order(w)))
            arm(:, w) = iso_frame*contact_lever(wheel, state%poses(wheel%body + 1)%a)
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

   !> Fills the other side of a map with the mirror image of the side that the deck defines.
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

end module ek_kandc_map
