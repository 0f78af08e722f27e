!> The suspension on a turntable of the page: its lines, fixed to its bodies, and the poses of the bodies in states of the
!> travel, of the roll and of the steering. Every state is a solved state of a test; poses are not interpolated between states.
module ek_turntable
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp, pi, millimetre
   use ek_rotation, only: cross
   use ek_measure, only: measure_t, distance
   use ek_joint, only: joint_table, rod_part
   use ek_element, only: element_kinds, coil_shape, damper_shape
   use ek_element_label, only: is_rod
   use ek_suspension, only: suspension_t
   use ek_wheel_side, only: deck_frame
   use ek_skeleton, only: skeleton_t, skeleton_of, first_measure, slides
   use ek_state, only: state_t
   use ek_path, only: path_t
   use ek_test_result, only: test_result_t, wheel_column
   use ek_moving_states, only: moving_test, state_of_path, travel_kinds, roll_kinds, steer_kinds
   use ek_picture_names, only: part_label
   use ek_base64, only: base64_of_numbers
   use ek_json, only: json_t, json_string, json_number
   implicit none(type, external)
   private
   public :: turntable_t, make_turntable, add_turntable

   integer, parameter :: most_states = 25        !! largest number of states of a test, in addition to design
   integer, parameter :: corners = 32            !! corners of the circle of a tread

   !> A line through points, each fixed to a body.
   type :: fixed_line_t
      character(8) :: kind = ''                  !! part to which it belongs: arm, carrier, rod, damper, spring, wheel
      integer, allocatable :: body(:)            !! body of each point; 0: the chassis
      real(wp), allocatable :: arm(:, :)         !! position of each point in its body, body axes (3, points) [m]
      character(63) :: label = ''                !! label of the part at the middle of the line; '' for lines without a label
   end type fixed_line_t

   !> States of one test, as poses of the bodies.
   type :: motion_t
      character(:), allocatable :: test, label   !! name of the test; moved quantity with unit
      real(wp), allocatable :: value(:)          !! value of the moved quantity in each state, in the unit of the label
      real(wp), allocatable :: pose(:, :, :)     !! reference point [m], quaternion q1 to q3 with q0 ≥ 0: (6, body, state)
      integer :: design = 0                      !! index of the state nearest to design
   end type motion_t

   type :: turntable_t
      integer :: bodies = 0
      real(wp) :: frame(3) = 1.0_wp              !! directions of the deck's axes along the axes of the program: 1 or −1
      real(wp) :: turn = -116.0_wp               !! initial direction of the viewer [deg], from the x axis of the deck towards y
      type(fixed_line_t), allocatable :: lines(:)
      type(motion_t), allocatable :: motions(:)
   end type turntable_t

contains

   !> Creates the turntable of a report. `table` is not allocated if no test moves the suspension.
   subroutine make_turntable(suspension, tests, paths, table)
      type(suspension_t), intent(in) :: suspension
      type(test_result_t), intent(in) :: tests(:)
      type(path_t), intent(in) :: paths(:)                 !! paths of the tests
      type(turntable_t), allocatable, intent(out) :: table
      integer :: chosen(3), k, n

      chosen = [moving_test(tests, paths, travel_kinds), moving_test(tests, paths, roll_kinds), &
         moving_test(tests, paths, steer_kinds)]
      if (all(chosen == 0)) return
      allocate (table)
      table%bodies = size(suspension%bodies)
      table%frame = deck_frame(suspension)
      table%turn = first_turn(suspension)
      allocate (table%lines(0))
      call add_bodies(suspension, table%lines)
      call add_links(suspension, table%lines)
      call add_wheels(suspension, table%lines)
      allocate (table%motions(count(chosen > 0)))
      n = 0
      do k = 1, size(chosen)
         if (chosen(k) == 0) cycle
         n = n + 1
         call take_motion(suspension, tests(chosen(k)), paths(chosen(k)), table%motions(n))
      end do
   end subroutine make_turntable

   !> The initial angle of view [deg]: an axle is seen from its front left, a single wheel from the middle of the car, ahead of the
   !> wheel.
   pure real(wp) function first_turn(suspension)
      type(suspension_t), intent(in) :: suspension
      real(wp) :: frame(3)

      first_turn = -116.0_wp
      if (size(suspension%wheels) == 1) first_turn = -suspension%wheels(1)%side*116.0_wp
      frame = deck_frame(suspension)
      if (frame(1) < 0.0_wp) first_turn = first_turn - sign(180.0_wp, first_turn)
   end function first_turn

   !> Adds the bars of the skeletons of all bodies.
   subroutine add_bodies(suspension, lines)
      type(suspension_t), intent(in) :: suspension
      type(fixed_line_t), allocatable, intent(inout) :: lines(:)
      type(skeleton_t) :: skeleton
      character(8) :: kind
      real(wp) :: bar(3), longest
      integer :: body, k, named

      do body = 1, size(suspension%bodies)
         skeleton = skeleton_of(suspension, body)
         kind = 'arm'
         if (any(suspension%wheels%body == body)) then
            kind = 'carrier'
         else if (slides(suspension, body)) then
            kind = 'damper'
         end if
         longest = 0.0_wp
         named = 0
         do k = 1, skeleton%count
            call add_line(lines, kind, [body, body], reshape([skeleton%nodes(skeleton%bars(1, k))%arm, &
               skeleton%nodes(skeleton%bars(2, k))%arm], [3, 2]))
            bar = skeleton%nodes(skeleton%bars(2, k))%arm - skeleton%nodes(skeleton%bars(1, k))%arm
            if (norm2(bar) > longest) named = size(lines)
            longest = max(longest, norm2(bar))
         end do
         if (named > 0) lines(named)%label = part_label(suspension%bodies(body)%name)
      end do
   end subroutine add_bodies

   !> Adds rods, springs and dampers.
   subroutine add_links(suspension, lines)
      type(suspension_t), intent(in) :: suspension
      type(fixed_line_t), allocatable, intent(inout) :: lines(:)
      integer :: k, shape

      do k = 1, size(suspension%joints)
         if (joint_table(suspension%joints(k)%number)%part == rod_part) call add_measure(first_measure(suspension, k), &
            'rod', suspension%joints(k)%name)
      end do
      do k = 1, size(suspension%elements)
         shape = element_kinds(suspension%elements(k)%kind)%shape
         if (suspension%elements(k)%measure%kind /= distance) cycle
         if (shape == coil_shape) call add_measure(suspension%elements(k)%measure, &
            trim(merge('rod   ', 'spring', is_rod(suspension%elements, k))), suspension%elements(k)%name)
         if (shape == damper_shape) call add_measure(suspension%elements(k)%measure, 'damper', suspension%elements(k)%name)
      end do

   contains

      !> Adds a line between the two points of a measure.
      subroutine add_measure(measure, kind, name)
         type(measure_t), intent(in) :: measure
         character(*), intent(in) :: kind, name
         call add_line(lines, kind, [measure%body_i, measure%body_j], reshape([measure%arm_i, measure%arm_j], [3, 2]))
         lines(size(lines))%label = part_label(name)
      end subroutine add_measure

   end subroutine add_links

   !> Adds the circles of the tyre treads.
   subroutine add_wheels(suspension, lines)
      type(suspension_t), intent(in) :: suspension
      type(fixed_line_t), allocatable, intent(inout) :: lines(:)
      real(wp) :: circle(3, 0:corners), u(3), v(3)
      integer :: k, n

      do k = 1, size(suspension%wheels)
         associate (wheel => suspension%wheels(k))
            u = [wheel%spin(2), -wheel%spin(1), 0.0_wp]
            u = u/norm2(u)
            v = cross(wheel%spin, u)
            do n = 0, corners
               circle(:, n) = wheel%centre + wheel%radius*(u*cos(2*pi*n/corners) + v*sin(2*pi*n/corners))
            end do
            call add_line(lines, 'wheel', spread(wheel%body, 1, corners + 1), circle)
         end associate
      end do
   end subroutine add_wheels

   subroutine add_line(lines, kind, body, arm)
      type(fixed_line_t), allocatable, intent(inout) :: lines(:)
      character(*), intent(in) :: kind
      integer, intent(in) :: body(:)
      real(wp), intent(in) :: arm(:, :)
      type(fixed_line_t), allocatable :: more(:)
      integer :: n

      n = size(lines)
      allocate (more(n + 1))
      more(:n) = lines
      more(n + 1)%kind = kind
      allocate (more(n + 1)%body, source=body)
      allocate (more(n + 1)%arm, source=arm)
      call move_alloc(more, lines)
   end subroutine add_line

   !> Takes up to 25 states of a test at equal intervals, from the first to the last state that was reached, and the state
   !> nearest to design. States without a value of the abscissa are omitted.
   subroutine take_motion(suspension, test, path, motion)
      type(suspension_t), intent(in) :: suspension
      type(test_result_t), intent(in) :: test
      type(path_t), intent(in) :: path
      type(motion_t), intent(out) :: motion
      type(state_t) :: state
      integer, allocatable :: reached(:), states(:)
      logical, allocatable :: is_chosen(:)
      integer :: place, design, k, b

      motion%test = test%name
      motion%label = test%label
      place = wheel_column(test, 1, test%abscissa)
      reached = pack([(k, k=1, size(path%is_reached))], path%is_reached)
      design = minloc(abs(path%value(reached)), dim=1)
      allocate (is_chosen(size(reached)), source=.false.)
      do k = 1, min(most_states, size(reached))
         is_chosen(1 + nint((k - 1.0_wp)*(size(reached) - 1)/max(1, min(most_states, size(reached)) - 1))) = .true.
      end do
      is_chosen(design) = .true.
      if (place > 0) then
         do k = 1, size(reached)
            if (.not. ieee_is_finite(test%table%values(place, reached(k)))) is_chosen(k) = .false.
         end do
      end if
      states = pack(reached, is_chosen)
      allocate (motion%value(size(states)), motion%pose(6, size(suspension%bodies), size(states)))
      do k = 1, size(states)
         motion%value(k) = path%value(states(k))
         if (place > 0) motion%value(k) = test%table%values(place, states(k))*test%abscissa_size
         if (states(k) == reached(design)) motion%design = k
         call state_of_path(path, states(k), suspension, state)
         do b = 1, size(suspension%bodies)
            associate (pose => state%poses(b + 1))
               motion%pose(:3, b, k) = pose%r
               motion%pose(4:, b, k) = sign(1.0_wp, pose%q(1))*pose%q(2:)
            end associate
         end do
      end do
   end subroutine take_motion

   !> Adds the object "turntable": lengths in mm, axes of the deck, numbers of 32 bits as base64. Both frames are right-handed, so
   !> the axis of a rotation is transformed like any vector.
   subroutine add_turntable(json, table)
      type(json_t), intent(inout) :: json
      type(turntable_t), intent(in) :: table
      real(wp), allocatable :: numbers(:, :)
      integer :: k, n

      call json%open('{', 'turntable')
      call json%item('bodies', json_number(real(table%bodies, wp)))
      call json%item('turn', json_number(table%turn))
      call json%item('front', json_number(-table%frame(1)))
      call json%open('[', 'lines')
      do k = 1, size(table%lines)
         associate (line => table%lines(k))
            allocate (numbers(4, size(line%body)))
            do n = 1, size(line%body)
               numbers(:, n) = [real(line%body(n), wp), table%frame*line%arm(:, n)/millimetre]
            end do
            call json%open('{')
            call json%item('kind', json_string(trim(line%kind)))
            if (line%label /= '') call json%item('label', json_string(trim(line%label)))
            call json%item('at', json_string(base64_of_numbers(reshape(numbers, [size(numbers)]))))
            call json%close('}')
            deallocate (numbers)
         end associate
      end do
      call json%close(']')
      call json%open('[', 'motions')
      do k = 1, size(table%motions)
         associate (motion => table%motions(k))
            call json%open('{')
            call json%item('test', json_string(motion%test))
            call json%item('label', json_string(motion%label))
            call json%item('design', json_number(real(motion%design - 1, wp)))
            call json%open('[', 'values')
            do n = 1, size(motion%value)
               call json%item_of_list(json_number(motion%value(n)))
            end do
            call json%close(']')
            call json%item('poses', json_string(base64_of_numbers(scaled(motion%pose, [table%frame/millimetre, table%frame]))))
            call json%close('}')
         end associate
      end do
      call json%close(']')
      call json%close('}')
   end subroutine add_turntable

   !> Poses as one list. Each of the six numbers of a pose is multiplied by its factor.
   pure function scaled(pose, factors) result(list)
      real(wp), intent(in) :: pose(:, :, :), factors(6)
      real(wp) :: list(size(pose))
      integer :: k
      list = reshape(pose*reshape([(factors, k=1, size(pose)/6)], shape(pose)), [size(pose)])
   end function scaled

end module ek_turntable
