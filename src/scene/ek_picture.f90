!> Picture of a suspension at a state: its parts as solids or as thin lines; the ground.
!>
!> A body has no shape in the model: the skeleton of the body represents it. `plain` selects fewer faces, for animations. All
!> positions are global [m].
module ek_picture
   use ek_kinds, only: wp, pi
   use ek_block, only: rotated
   use ek_wheel_contact, only: contact_arm
   use ek_rotation, only: cross
   use ek_measure, only: measure_t, distance
   use ek_joint, only: joint_table, rod_part, ball_part, hinge_part, slider_part, guide_part
   use ek_element, only: element_t, element_kinds, coil_shape, damper_shape, stop_shape, bushing_shape
   use ek_element_label, only: is_rod
   use ek_suspension, only: suspension_t, wheel_t
   use ek_skeleton, only: skeleton_t, skeleton_of, first_measure, ends_of, place_of, bar_of, slides, same_point
   use ek_state, only: state_t
   use ek_scene, only: scene_t, add_run, add_label, add_tube, add_surface, add_coil, add_ball, part_ground, part_tyre, &
      part_plate, part_carrier, part_arm, part_rod, part_spring, part_damper, part_bushing, part_ball, part_mount, part_stop, &
      line_ground
   implicit none(type, external)
   private
   public :: add_solid, add_ghost, add_ground, add_elastic

   ! Sizes typical of a passenger car [m]
   real(wp), parameter :: arm_radius = 0.011_wp, rod_radius = 0.008_wp, ball_radius = 0.016_wp

contains

   !> Adds all parts as solids.
   subroutine add_solid(scene, suspension, state, is_plain)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      logical, intent(in) :: is_plain               !! fewer faces: for animations
      integer :: k

      do k = 1, size(suspension%bodies)
         call add_body(scene, suspension, state, k, is_plain)
      end do
      call add_joints(scene, suspension, state, is_plain)
      do k = 1, size(suspension%elements)
         call add_elastic(scene, suspension%elements(k), is_rod(suspension%elements, k), state, is_plain)
      end do
      do k = 1, size(suspension%wheels)
         call add_wheel(scene, suspension%wheels(k), state, is_plain)
      end do
   end subroutine add_solid

   !> Adds the bodies, the rods of rod joints and the wheels (see add_tread) as thin lines. Other joints and elements are
   !> omitted.
   subroutine add_ghost(scene, suspension, state, kind)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: kind                   !! kind of line: line_bump, line_rebound or line_ground
      type(skeleton_t) :: skeleton
      real(wp) :: line(3, 2)
      integer :: body, k

      do body = 1, size(suspension%bodies)
         skeleton = skeleton_of(suspension, body)
         do k = 1, skeleton%count
            call add_run(scene%lines, kind, bar_of(state, body, skeleton, k))
         end do
      end do
      do k = 1, size(suspension%joints)
         if (joint_table(suspension%joints(k)%number)%part /= rod_part) cycle
         call ends_of(first_measure(suspension, k), state, line(:, 1), line(:, 2))
         call add_run(scene%lines, kind, line)
      end do
      do k = 1, size(suspension%wheels)
         call add_tread(scene, suspension%wheels(k), state, kind)
      end do
   end subroutine add_ghost

   !> Adds the road under the wheels, and an arrow that points to the front of the car. Adds nothing for a model without
   !> wheels.
   subroutine add_ground(scene, suspension, state, is_plain)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      logical, intent(in) :: is_plain              !! only the outline: a GIF has no transparent colours
      real(wp) :: low(2), high(2), z, face(3, 4), arrow(3, 3), at(3), middle
      integer :: k

      if (size(suspension%wheels) == 0) return
      low = huge(1.0_wp)
      high = -huge(1.0_wp)
      z = huge(1.0_wp)
      do k = 1, size(suspension%wheels)
         associate (wheel => suspension%wheels(k))
            at = state%poses(wheel%body + 1)%r + contact_arm(wheel, state%poses(wheel%body + 1)%a)
            low = min(low, [at(1) - 1.15_wp*wheel%radius, at(2) - 0.16_wp])
            high = max(high, [at(1) + 1.15_wp*wheel%radius, at(2) + 0.16_wp])
            z = min(z, at(3))
         end associate
      end do
      if (size(suspension%wheels) == 1) then        ! the picture includes the inner half of the axle
         if (suspension%wheels(1)%side < 0) high(2) = max(high(2), low(2) + 0.55_wp)
         if (suspension%wheels(1)%side > 0) low(2) = min(low(2), high(2) - 0.55_wp)
      end if
      face = reshape([low(1), low(2), z, high(1), low(2), z, high(1), high(2), z, low(1), high(2), z], [3, 4])
      if (.not. is_plain) call add_run(scene%faces, part_ground, face)
      call add_run(scene%lines, line_ground, reshape([face, face(:, 1)], [3, 5]))
      middle = (low(2) + high(2))/2
      if (size(suspension%wheels) == 1) middle = middle - suspension%wheels(1)%side*0.16_wp
      at = [low(1) + 0.16_wp, middle, z]
      arrow = reshape([-0.12_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.045_wp, 0.0_wp, 0.0_wp, -0.045_wp, 0.0_wp], [3, 3])
      call add_run(scene%faces, part_carrier, arrow + spread(at, 2, 3))
      call add_label(scene, at, 'front')
   end subroutine add_ground

   !> Adds bars along the skeleton of a body. Unless `plain`, an arm attached at two points also has a plate between them.
   subroutine add_body(scene, suspension, state, body, plain)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: body
      logical, intent(in) :: plain
      type(skeleton_t) :: skeleton
      real(wp) :: bar(3, 2)
      integer :: k, kind

      skeleton = skeleton_of(suspension, body)
      kind = part_arm
      if (any(suspension%wheels%body == body)) then
         kind = part_carrier
      else if (slides(suspension, body)) then
         kind = part_damper
      end if
      do k = 1, skeleton%count
         bar = bar_of(state, body, skeleton, k)
         call add_tube(scene, kind, bar(:, 1), bar(:, 2), &
            merge(1.25_wp, 1.0_wp, kind == part_carrier)*arm_radius, merge(4, 7, plain))
      end do
      if (kind == part_arm .and. .not. plain) call add_plate(scene, state, body, skeleton)
   end subroutine add_body

   !> Adds the plate of an arm attached at two points (a wishbone). The thin plate is between the two points and the point of
   !> the arm that is furthest from both. Adds no plate if no point is further than 5 cm from both.
   subroutine add_plate(scene, state, body, skeleton)
      type(scene_t), intent(inout) :: scene
      type(state_t), intent(in) :: state
      integer, intent(in) :: body
      type(skeleton_t), intent(in) :: skeleton
      real(wp) :: face(3, 3), reach, most
      integer :: corners(3), k

      associate (nodes => skeleton%nodes(:skeleton%used))
         if (count(nodes%is_held) /= 2) return
         corners = [pack([(k, k=1, size(nodes))], nodes%is_held), 0]
         most = 0.05_wp
         do k = 1, size(nodes)
            if (nodes(k)%is_held .or. nodes(k)%is_spring) cycle
            reach = min(norm2(nodes(k)%arm - nodes(corners(1))%arm), norm2(nodes(k)%arm - nodes(corners(2))%arm))
            if (reach <= most) cycle
            most = reach
            corners(3) = k
         end do
         if (corners(3) == 0) return
         do k = 1, 3
            face(:, k) = place_of(state, body, nodes(corners(k))%arm)
         end do
      end associate
      call add_run(scene%faces, part_plate, face)
   end subroutine add_plate

   !> Adds rods, ball joints, hinges, sliding joints, and attachments to the chassis.
   subroutine add_joints(scene, suspension, state, plain)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      logical, intent(in) :: plain
      type(measure_t) :: measure
      real(wp) :: a(3), b(3), axis(3), reach
      integer :: k

      do k = 1, size(suspension%joints)
         measure = first_measure(suspension, k)
         call ends_of(measure, state, a, b)
         select case (joint_table(suspension%joints(k)%number)%part)
         case (rod_part)
            call add_tube(scene, part_rod, a, b, rod_radius, merge(4, 6, plain))
            call add_end(measure%body_i, a)
            call add_end(measure%body_j, b)
         case (ball_part)
            call add_ball(scene, part_ball, b, ball_radius, merge(4, 8, plain))
            if (measure%body_i*measure%body_j == 0) call add_end(0, b)
         case (guide_part)                             ! a point that is led along a line or a plane
            call add_end(measure%body_i*measure%body_j, a)
         case (hinge_part)
            ! rows 4 and 5 keep two directions of body i perpendicular to v, the axis in body j
            measure = suspension%terms(suspension%rows(suspension%joints(k)%first_row + 3)%first)%measure
            axis = rotated(state%poses(measure%body_j + 1)%a, measure%v)
            call add_tube(scene, part_ball, b - 0.022_wp*axis, b + 0.022_wp*axis, 0.015_wp, merge(4, 8, plain))
         case (slider_part)
            ! rows: x·z and y·z first, so v of the first row is the axis, fixed in body j
            axis = rotated(state%poses(measure%body_j + 1)%a, measure%v)
            if (measure%body_i == 0 .or. measure%body_j == 0) then
               call add_tube(scene, part_damper, a - 0.05_wp*axis, a + 0.05_wp*axis, 0.022_wp, merge(5, 9, plain))
            else
               reach = reach_along(suspension, measure%body_j, measure%arm_j, measure%v)
               call add_tube(scene, part_damper, a - 0.02_wp*axis, a + 0.58_wp*reach*axis, 0.026_wp, merge(6, 11, plain))
            end if
         end select
      end do

   contains

      !> Adds the end of a rod: a sphere on a body, a block on the chassis.
      subroutine add_end(body, at)
         integer, intent(in) :: body
         real(wp), intent(in) :: at(3)
         if (body == 0) then
            call add_surface(scene, part_mount, at, [0.0_wp, 0.0_wp, 1.0_wp], 0.02_wp*[-1.0_wp, -1.0_wp, 1.0_wp, 1.0_wp], &
               0.026_wp*[0.0_wp, 1.0_wp, 1.0_wp, 0.0_wp], 4)
         else
            call add_ball(scene, part_ball, at, 0.8_wp*ball_radius, merge(4, 7, plain))
         end if
      end subroutine add_end

   end subroutine add_joints

   !> Signed distance along an axis from a point of a body to the attachment point of the body that is furthest along the
   !> axis, in either direction [m].
   real(wp) function reach_along(suspension, body, arm, axis) result(reach)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: body
      real(wp), intent(in) :: arm(3), axis(3)
      type(skeleton_t) :: skeleton
      real(wp) :: now
      integer :: k

      skeleton = skeleton_of(suspension, body)
      reach = 0.0_wp
      do k = 1, skeleton%used
         now = dot_product(skeleton%nodes(k)%arm - arm, axis)
         if (abs(now) > abs(reach)) reach = now
      end do
   end function reach_along

   !> Adds an elastic element: a coil or a rod, a damper as two tubes, the rubber of a stop (unless `plain`), or the sleeve of
   !> a bushing. An element with another measure than a distance is not drawn: a torsion spring is part of the bars that it
   !> connects.
   subroutine add_elastic(scene, element, is_a_rod, state, plain)
      type(scene_t), intent(inout) :: scene
      type(element_t), intent(in) :: element
      logical, intent(in) :: is_a_rod                 !! a spring that is drawn as a rod
      type(state_t), intent(in) :: state
      logical, intent(in) :: plain
      real(wp), parameter :: rubber = 0.045_wp        ! m
      real(wp) :: a(3), b(3), length, axis(3)
      integer :: shape

      shape = element_kinds(element%kind)%shape
      if (shape /= bushing_shape .and. element%measure%kind /= distance) return      ! other measures have no shape
      call ends_of(element%measure, state, a, b)
      length = norm2(b - a)
      if (shape /= bushing_shape .and. length < same_point) return
      select case (shape)
      case (coil_shape)
         if (is_a_rod) then
            call add_tube(scene, part_rod, a, b, rod_radius, merge(4, 6, plain))
         else
            call add_coil(scene, part_spring, a, b, 0.052_wp, 0.006_wp, 6, merge(8, 12, plain))
         end if
      case (stop_shape)
         if (plain) return
         call add_tube(scene, part_stop, b, b + (a - b)*min(0.4_wp, rubber/length), 0.018_wp, 8)
      case (damper_shape)
         call add_tube(scene, part_damper, a, a + 0.58_wp*(b - a), 0.022_wp, merge(5, 10, plain))
         call add_tube(scene, part_damper, a + 0.5_wp*(b - a), b, 0.009_wp, merge(4, 6, plain))
      case (bushing_shape)                            ! along the z axis of its first marker
         axis = rotated(state%poses(element%measure%body_i + 1)%a, element%bushing%axes(:, 3))
         call add_tube(scene, part_bushing, a - 0.024_wp*axis, a + 0.024_wp*axis, 0.021_wp, merge(5, 10, plain))
      end select
   end subroutine add_elastic

   !> Adds a hub, and a tyre as a surface of revolution. If `plain`, circles of tread and rim represent the tyre.
   subroutine add_wheel(scene, wheel, state, plain)
      type(scene_t), intent(inout) :: scene
      type(wheel_t), intent(in) :: wheel
      type(state_t), intent(in) :: state
      logical, intent(in) :: plain
      real(wp) :: centre(3), axis(3), half

      centre = place_of(state, wheel%body, wheel%centre)
      axis = rotated(state%poses(wheel%body + 1)%a, wheel%spin)
      half = 0.32_wp*wheel%radius
      call add_tube(scene, part_carrier, centre - 0.02_wp*axis, centre + 0.05_wp*axis, 0.055_wp, merge(6, 14, plain))
      if (plain) then
         call add_tread(scene, wheel, state, line_ground)
      else
         call add_surface(scene, part_tyre, centre, axis, half*[-0.8_wp, -1.0_wp, -0.78_wp, 0.0_wp, 0.78_wp, 1.0_wp, 0.8_wp], &
            wheel%radius*[0.66_wp, 0.82_wp, 0.965_wp, 1.0_wp, 0.965_wp, 0.82_wp, 0.66_wp], 44)
      end if
   end subroutine add_wheel

   !> Adds the circle of the tread in the wheel plane; for the kind line_ground, also the circle of the rim.
   subroutine add_tread(scene, wheel, state, kind)
      type(scene_t), intent(inout) :: scene
      type(wheel_t), intent(in) :: wheel
      type(state_t), intent(in) :: state
      integer, intent(in) :: kind
      integer, parameter :: corners = 48
      real(wp) :: circle(3, corners + 1), centre(3), axis(3), u(3), v(3)
      integer :: n

      centre = place_of(state, wheel%body, wheel%centre)
      axis = rotated(state%poses(wheel%body + 1)%a, wheel%spin)
      u = [axis(2), -axis(1), 0.0_wp]         ! horizontal; a spin axis is never vertical
      u = u/norm2(u)
      v = cross(axis, u)
      do n = 0, corners
         circle(:, n + 1) = centre + wheel%radius*(u*cos(2*pi*n/corners) + v*sin(2*pi*n/corners))
      end do
      call add_run(scene%lines, kind, circle)
      circle = spread(centre, 2, corners + 1) + 0.66_wp*(circle - spread(centre, 2, corners + 1))
      if (kind == line_ground) call add_run(scene%lines, kind, circle)
   end subroutine add_tread

end module ek_picture
