!> What a suspension looks like at a state: bodies as bars between the points that hold them, springs, bushings, wheels.
!>
!> A body has no shape in the model: its skeleton stands for it.
module ek_picture
   use ek_kinds, only: wp
   use ek_units, only: pi
   use ek_block, only: rotated
   use ek_measure, only: measure_t, rotation
   use ek_spring, only: axial_spring, stop_spring, damper
   use ek_suspension, only: suspension_t
   use ek_skeleton, only: skeleton_t, skeleton_of, first_measure, ends_of, place_of
   use ek_state, only: state_t
   use ek_scene, only: scene_t, add_face, add_line, add_words, add_tube, add_surface, add_coil, add_ball, &
      part_ground, part_tyre, part_plate, part_carrier, part_arm, part_rod, part_spring, part_damper, part_bushing, &
      part_ball, part_mount, line_bump, line_rebound, line_ground
   implicit none(type, external)
   private
   public :: add_solid, add_ghost, add_ground, add_names

   ! Sizes that look right on a passenger car [m]
   real(wp), parameter :: arm_radius = 0.011_wp, rod_radius = 0.008_wp, ball_radius = 0.016_wp
   real(wp), parameter :: same_point = 1.0e-3_wp

contains

   !> Everything as solid parts.
   subroutine add_solid(scene, suspension, state, is_plain)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      logical, intent(in), optional :: is_plain     !! fewer faces: for animations
      type(skeleton_t) :: skeleton
      real(wp) :: a(3), b(3)
      integer :: body, k, kind, sides
      logical :: plain

      plain = .false.
      if (present(is_plain)) plain = is_plain
      sides = merge(4, 7, plain)
      do body = 1, size(suspension%bodies)
         skeleton = skeleton_of(suspension, body)
         kind = part_arm
         if (carries_wheel(suspension, body)) then
            kind = part_carrier
         else if (slides(suspension, body)) then
            kind = part_damper
         end if
         do k = 1, skeleton%count
            a = place_of(suspension, state, body, skeleton%nodes(skeleton%bars(1, k))%arm)
            b = place_of(suspension, state, body, skeleton%nodes(skeleton%bars(2, k))%arm)
            call add_tube(scene, kind, a, b, merge(1.25_wp, 1.0_wp, kind == part_carrier)*arm_radius, sides)
         end do
         if (kind == part_arm .and. .not. plain) call add_plate(scene, suspension, state, body, skeleton)
      end do
      call add_joints(scene, suspension, state, plain)
      do k = 1, size(suspension%springs)
         call add_elastic(scene, suspension, state, k, plain)
      end do
      do k = 1, size(suspension%bushings)
         associate (bushing => suspension%bushings(k))
            a = place_of(suspension, state, bushing%body_i, bushing%arm_i)
            b = rotated(state%poses(bushing%body_i + 1)%a, bushing%axes(:, 3))
            call add_tube(scene, part_bushing, a - 0.024_wp*b, a + 0.024_wp*b, 0.021_wp, merge(5, 10, plain))
         end associate
      end do
      do k = 1, size(suspension%wheels)
         call add_wheel(scene, suspension, state, k, plain)
      end do
   end subroutine add_solid

   !> A coil, a damper as two tubes, or the rubber of a stop; a torsion spring sits in the bars that it joins.
   subroutine add_elastic(scene, suspension, state, k, plain)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: k
      logical, intent(in) :: plain
      real(wp), parameter :: rubber = 0.045_wp        ! m
      real(wp) :: a(3), b(3), length

      associate (spring => suspension%springs(k))
         if (spring%measure%kind == rotation) return
         call ends_of(spring%measure, state, a, b)
         length = norm2(b - a)
         if (length < same_point) return
         if (spring%kind == axial_spring) then
            call add_coil(scene, part_spring, a, b, 0.052_wp, 0.006_wp, 6, merge(8, 12, plain))
         else if (spring%kind == stop_spring) then
            if (plain) return
            call add_tube(scene, part_bushing, b, b + (a - b)*min(0.4_wp, rubber/length), 0.018_wp, 8)
         else
            call add_tube(scene, part_damper, a, a + 0.58_wp*(b - a), 0.022_wp, merge(5, 10, plain))
            call add_tube(scene, part_damper, a + 0.5_wp*(b - a), b, 0.009_wp, merge(4, 6, plain))
         end if
      end associate
   end subroutine add_elastic

   !> Everything as thin lines.
   subroutine add_ghost(scene, suspension, state, kind)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: kind                   !! line_bump or line_rebound
      type(skeleton_t) :: skeleton
      real(wp) :: line(3, 2)
      integer :: body, k

      do body = 1, size(suspension%bodies)
         skeleton = skeleton_of(suspension, body)
         do k = 1, skeleton%count
            line(:, 1) = place_of(suspension, state, body, skeleton%nodes(skeleton%bars(1, k))%arm)
            line(:, 2) = place_of(suspension, state, body, skeleton%nodes(skeleton%bars(2, k))%arm)
            call add_line(scene, kind, line)
         end do
      end do
      do k = 1, size(suspension%joints)
         if (suspension%joints(k)%kind /= 'distance') cycle
         call ends_of(first_measure(suspension, k), state, line(:, 1), line(:, 2))
         call add_line(scene, kind, line)
      end do
      do k = 1, size(suspension%wheels)
         call add_tread(scene, suspension, state, k, kind)
      end do
   end subroutine add_ghost

   !> The road under the wheels, and an arrow that points to the front of the car.
   subroutine add_ground(scene, suspension, state, is_plain)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      logical, intent(in), optional :: is_plain    !! its outline alone: a GIF has no transparent colours
      real(wp) :: low(2), high(2), z, face(3, 4), arrow(3, 3), at(3), middle
      integer :: k
      logical :: has_face

      if (size(suspension%wheels) == 0) return
      low = huge(1.0_wp)
      high = -huge(1.0_wp)
      z = huge(1.0_wp)
      do k = 1, size(suspension%wheels)
         associate (wheel => suspension%wheels(k))
            at = place_of(suspension, state, wheel%body, wheel%contact)
            low = min(low, [at(1) - 1.15_wp*wheel%radius, at(2) - 0.16_wp])
            high = max(high, [at(1) + 1.15_wp*wheel%radius, at(2) + 0.16_wp])
            z = min(z, at(3))
         end associate
      end do
      if (size(suspension%wheels) == 1) then        ! the inner half of the axle belongs to the picture
         if (suspension%wheels(1)%side < 0) high(2) = max(high(2), low(2) + 0.55_wp)
         if (suspension%wheels(1)%side > 0) low(2) = min(low(2), high(2) - 0.55_wp)
      end if
      face(:, 1) = [low(1), low(2), z]
      face(:, 2) = [high(1), low(2), z]
      face(:, 3) = [high(1), high(2), z]
      face(:, 4) = [low(1), high(2), z]
      has_face = .true.
      if (present(is_plain)) has_face = .not. is_plain
      if (has_face) call add_face(scene, part_ground, face)
      call add_line(scene, line_ground, reshape([face, face(:, 1)], [3, 5]))
      middle = (low(2) + high(2))/2
      if (size(suspension%wheels) == 1) middle = middle - suspension%wheels(1)%side*0.16_wp
      at = [low(1) + 0.16_wp, middle, z]
      arrow(:, 1) = at + [-0.12_wp, 0.0_wp, 0.0_wp]
      arrow(:, 2) = at + [0.0_wp, 0.045_wp, 0.0_wp]
      arrow(:, 3) = at + [0.0_wp, -0.045_wp, 0.0_wp]
      call add_face(scene, part_carrier, arrow)
      call add_words(scene, at + [0.02_wp, 0.0_wp, 0.0_wp], 'front')
   end subroutine add_ground

   !> Names of bodies, rods and springs, once for left and right.
   subroutine add_names(scene, suspension, state)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(skeleton_t) :: skeleton
      real(wp) :: a(3), b(3), length, longest, at(3)
      integer :: body, k

      do body = 1, size(suspension%bodies)
         skeleton = skeleton_of(suspension, body)
         longest = 0.0_wp
         if (count(skeleton%nodes(:skeleton%used)%is_held) == 2 .and. skeleton%used > 2) then    ! a wishbone: in its middle
            longest = 1.0_wp
            at = 0.0_wp
            do k = 1, skeleton%used
               at = at + place_of(suspension, state, body, skeleton%nodes(k)%arm)/skeleton%used
            end do
            call name_at(suspension%bodies(body)%name)
            cycle
         end if
         do k = 1, skeleton%count
            a = place_of(suspension, state, body, skeleton%nodes(skeleton%bars(1, k))%arm)
            b = place_of(suspension, state, body, skeleton%nodes(skeleton%bars(2, k))%arm)
            length = norm2(b - a)
            if (length <= longest) cycle
            longest = length
            at = (a + b)/2
         end do
         if (longest > 0.0_wp .and. slides(suspension, body) .and. .not. carries_wheel(suspension, body)) then
            call name_at(suspension%bodies(body)%name, 5.0_wp)       ! beside the coil around it
         else if (longest > 0.0_wp) then
            call name_at(suspension%bodies(body)%name)
         end if
      end do
      do k = 1, size(suspension%joints)
         if (suspension%joints(k)%kind /= 'distance') cycle
         call ends_of(first_measure(suspension, k), state, a, b)
         at = 0.8_wp*a + 0.2_wp*b      ! not where a wishbone or a carrier beside it has its name
         call name_at(suspension%joints(k)%name)
      end do
      do k = 1, size(suspension%springs)
         if (suspension%springs(k)%measure%kind == rotation .or. suspension%springs(k)%kind == stop_spring) cycle
         call ends_of(suspension%springs(k)%measure, state, a, b)
         at = 0.3_wp*a + 0.7_wp*b
         if (suspension%springs(k)%kind == damper) at = b         ! above the coil that stands around it
         call name_at(suspension%springs(k)%name, 5.0_wp)
      end do

   contains

      subroutine name_at(name, aside)
         character(*), intent(in) :: name
         real(wp), intent(in), optional :: aside
         character(:), allocatable :: words
         integer :: letter

         if (index(name, 'right_') == 1) return
         words = name
         if (index(name, 'left_') == 1) words = name(6:)
         do letter = 1, len(words)
            if (words(letter:letter) == '_') words(letter:letter) = ' '
         end do
         call add_words(scene, at, words, aside)
      end subroutine name_at

   end subroutine add_names

   !> An arm held at two points is a wishbone: a thin plate between them and its furthest other point.
   subroutine add_plate(scene, suspension, state, body, skeleton)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: body
      type(skeleton_t), intent(in) :: skeleton
      real(wp) :: face(3, 3), reach, most
      integer :: held(2), n, k, tip

      n = 0
      do k = 1, skeleton%used
         if (.not. skeleton%nodes(k)%is_held) cycle
         n = n + 1
         if (n <= 2) held(n) = k
      end do
      if (n /= 2) return
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

   !> Rods, ball joints, sliding joints, and what is fixed to the chassis.
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
         select case (suspension%joints(k)%kind)
         case ('distance')
            call add_tube(scene, part_rod, a, b, rod_radius, merge(4, 6, plain))
            call add_end(measure%body_i, a)
            call add_end(measure%body_j, b)
         case ('spherical', 'universal', 'constant_velocity')
            call add_ball(scene, part_ball, b, ball_radius, merge(4, 8, plain))
            if (measure%body_i*measure%body_j == 0) call add_end(0, b)
         case ('revolute')
            call revolute_axis(suspension, k, state, axis)
            call add_tube(scene, part_ball, b - 0.022_wp*axis, b + 0.022_wp*axis, 0.015_wp, merge(4, 8, plain))
         case ('cylindrical', 'translational')
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

      !> A ball where a rod meets a body, a block where it meets the chassis.
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

   !> How far body j reaches from a point along an axis, with its sign: to its furthest attachment point.
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

   !> Axis of a revolute joint: rows 4 and 5 hold two directions of body i square to v, the axis in body j.
   subroutine revolute_axis(suspension, joint, state, axis)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: joint
      type(state_t), intent(in) :: state
      real(wp), intent(out) :: axis(3)

      associate (term => suspension%terms(suspension%rows(suspension%joints(joint)%first_row + 3)%first))
         axis = rotated(state%poses(term%measure%body_j + 1)%a, term%measure%v)
      end associate
   end subroutine revolute_axis

   !> Tyre as a hull of revolution, and a hub.
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
         u = [axis(2), -axis(1), 0.0_wp]         ! level; a spin axis is never vertical
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

   pure logical function carries_wheel(suspension, body)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: body
      integer :: k

      carries_wheel = .false.
      do k = 1, size(suspension%wheels)
         carries_wheel = carries_wheel .or. suspension%wheels(k)%body == body
      end do
   end function carries_wheel

   !> Whether a body slides along another that moves too: a damper's rod.
   pure logical function slides(suspension, body)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: body
      integer :: k

      slides = .false.
      do k = 1, size(suspension%joints)
         associate (joint => suspension%joints(k))
            if (joint%kind /= 'cylindrical' .and. joint%kind /= 'translational') cycle
            if (joint%body_i == 0 .or. joint%body_j == 0) cycle
            slides = slides .or. joint%body_i == body .or. joint%body_j == body
         end associate
      end do
   end function slides

end module ek_picture
