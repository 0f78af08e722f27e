!> The shape of each part in a picture: arms, rods, ball joints, coils, dampers, bushings, tyres.
!>
!> `plain` selects fewer faces, for animations. All positions are global [m].
module ek_part_shape
   use ek_kinds, only: wp
   use ek_units, only: pi
   use ek_block, only: rotated
   use ek_measure, only: measure_t, distance
   use ek_joint, only: joint_table, rod_part, ball_part, hinge_part, slider_part
   use ek_element, only: element_t, element_kinds, coil_shape, damper_shape, stop_shape, bushing_shape
   use ek_suspension, only: suspension_t
   use ek_skeleton, only: skeleton_t, skeleton_of, first_measure, ends_of, place_of, bar_of, carries_wheel, slides, &
      same_point
   use ek_state, only: state_t
   use ek_scene, only: scene_t, add_face, add_line, add_tube, add_surface, add_coil, add_ball, part_tyre, part_plate, &
      part_carrier, part_arm, part_rod, part_spring, part_damper, part_bushing, part_ball, part_mount, line_ground
   implicit none(type, external)
   private
   public :: add_body, add_joints, add_elastic, add_wheel, add_tread

   ! Sizes typical of a passenger car [m]
   real(wp), parameter :: arm_radius = 0.011_wp, rod_radius = 0.008_wp, ball_radius = 0.016_wp

contains

   !> Bars along the skeleton of a body; an arm attached at two points gets a plate between them.
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
      if (carries_wheel(suspension, body)) then
         kind = part_carrier
      else if (slides(suspension, body)) then
         kind = part_damper
      end if
      do k = 1, skeleton%count
         bar = bar_of(suspension, state, body, skeleton, k)
         call add_tube(scene, kind, bar(:, 1), bar(:, 2), &
            merge(1.25_wp, 1.0_wp, kind == part_carrier)*arm_radius, merge(4, 7, plain))
      end do
      if (kind == part_arm .and. .not. plain) call add_plate(scene, suspension, state, body, skeleton)
   end subroutine add_body

   !> An arm attached at two points is a wishbone: a thin plate between them and its furthest other point.
   subroutine add_plate(scene, suspension, state, body, skeleton)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: body
      type(skeleton_t), intent(in) :: skeleton
      real(wp) :: face(3, 3), reach, most
      integer :: held(2), k, tip

      if (count(skeleton%nodes(:skeleton%used)%is_held) /= 2) return
      held = pack([(k, k=1, skeleton%used)], skeleton%nodes(:skeleton%used)%is_held)
      tip = 0
      most = 0.05_wp
      do k = 1, skeleton%used
         if (skeleton%nodes(k)%is_held .or. skeleton%nodes(k)%is_spring) cycle
         reach = min(norm2(skeleton%nodes(k)%arm - skeleton%nodes(held(1))%arm), &
            norm2(skeleton%nodes(k)%arm - skeleton%nodes(held(2))%arm))
         if (reach <= most) cycle
         most = reach
         tip = k
      end do
      if (tip == 0) return
      face(:, 1) = place_of(suspension, state, body, skeleton%nodes(held(1))%arm)
      face(:, 2) = place_of(suspension, state, body, skeleton%nodes(held(2))%arm)
      face(:, 3) = place_of(suspension, state, body, skeleton%nodes(tip)%arm)
      call add_face(scene, part_plate, face)
   end subroutine add_plate

   !> Rods, ball joints, sliding joints, and attachments to the chassis.
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
         case (hinge_part)
            call revolute_axis(suspension, k, state, axis)
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

      !> A sphere at the end of a rod on a body, a block at its end on the chassis.
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

   !> Signed distance along an axis from a point to the furthest attachment point of body j.
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

   !> Axis of a revolute joint: rows 4 and 5 keep two directions of body i perpendicular to v, the axis in body j.
   subroutine revolute_axis(suspension, joint, state, axis)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: joint
      type(state_t), intent(in) :: state
      real(wp), intent(out) :: axis(3)

      associate (term => suspension%terms(suspension%rows(suspension%joints(joint)%first_row + 3)%first))
         axis = rotated(state%poses(term%measure%body_j + 1)%a, term%measure%v)
      end associate
   end subroutine revolute_axis

   !> A coil, a damper as two tubes, the rubber of a stop, or the sleeve of a bushing; a torsion spring is part of the bars that
   !> it connects.
   subroutine add_elastic(scene, element, state, plain)
      type(scene_t), intent(inout) :: scene
      type(element_t), intent(in) :: element
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
         call add_coil(scene, part_spring, a, b, 0.052_wp, 0.006_wp, 6, merge(8, 12, plain))
      case (stop_shape)
         if (plain) return
         call add_tube(scene, part_bushing, b, b + (a - b)*min(0.4_wp, rubber/length), 0.018_wp, 8)
      case (damper_shape)
         call add_tube(scene, part_damper, a, a + 0.58_wp*(b - a), 0.022_wp, merge(5, 10, plain))
         call add_tube(scene, part_damper, a + 0.5_wp*(b - a), b, 0.009_wp, merge(4, 6, plain))
      case (bushing_shape)                            ! along the z axis of its first marker
         axis = rotated(state%poses(element%measure%body_i + 1)%a, element%bushing%axes(:, 3))
         call add_tube(scene, part_bushing, a - 0.024_wp*axis, a + 0.024_wp*axis, 0.021_wp, merge(5, 10, plain))
      end select
   end subroutine add_elastic

   !> Tyre as a surface of revolution, and a hub.
   subroutine add_wheel(scene, suspension, state, k, plain)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: k
      logical, intent(in) :: plain
      real(wp) :: centre(3), axis(3), half
      integer :: sides

      associate (wheel => suspension%wheels(k))
         centre = place_of(suspension, state, wheel%body, wheel%centre)
         axis = rotated(state%poses(wheel%body + 1)%a, wheel%spin)
         half = 0.32_wp*wheel%radius
         sides = merge(18, 44, plain)
         call add_tube(scene, part_carrier, centre - 0.02_wp*axis, centre + 0.05_wp*axis, 0.055_wp, merge(6, 14, plain))
         if (plain) then
            call add_tread(scene, suspension, state, k, line_ground)
            return
         end if
         call add_surface(scene, part_tyre, centre, axis, half*[-0.8_wp, -1.0_wp, -0.78_wp, 0.0_wp, 0.78_wp, 1.0_wp, 0.8_wp], &
            wheel%radius*[0.66_wp, 0.82_wp, 0.965_wp, 1.0_wp, 0.965_wp, 0.82_wp, 0.66_wp], sides)
      end associate
   end subroutine add_wheel

   !> Circles of the tread and the rim, in the wheel plane.
   subroutine add_tread(scene, suspension, state, k, kind)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: k, kind
      integer, parameter :: corners = 48
      real(wp) :: circle(3, corners + 1), centre(3), axis(3), u(3), v(3)
      integer :: n

      associate (wheel => suspension%wheels(k))
         centre = place_of(suspension, state, wheel%body, wheel%centre)
         axis = rotated(state%poses(wheel%body + 1)%a, wheel%spin)
         u = [axis(2), -axis(1), 0.0_wp]         ! horizontal; a spin axis is never vertical
         u = u/norm2(u)
         v = [axis(2)*u(3) - axis(3)*u(2), axis(3)*u(1) - axis(1)*u(3), axis(1)*u(2) - axis(2)*u(1)]
         do n = 0, corners
            circle(:, n + 1) = centre + wheel%radius*(u*cos(2*pi*n/corners) + v*sin(2*pi*n/corners))
         end do
         call add_line(scene, kind, circle)
         do n = 0, corners
            circle(:, n + 1) = centre + 0.66_wp*(circle(:, n + 1) - centre)
         end do
         if (kind == line_ground) call add_line(scene, kind, circle)
      end associate
   end subroutine add_tread

end module ek_part_shape
