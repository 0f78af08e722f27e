!> Picture of a suspension at a state: its parts as solids (ek_part_shape) or as thin lines; the ground; names.
!>
!> A body has no shape in the model: its skeleton represents it.
module ek_picture
   use ek_kinds, only: wp
   use ek_text, only: spaced
   use ek_measure, only: distance
   use ek_joint, only: joint_table, rod_part
   use ek_element, only: element_kinds, stop_shape, damper_shape
   use ek_suspension, only: suspension_t
   use ek_skeleton, only: skeleton_t, skeleton_of, first_measure, ends_of, place_of, bar_of, carries_wheel, slides
   use ek_part_shape, only: add_body, add_joints, add_elastic, add_wheel, add_tread
   use ek_state, only: state_t
   use ek_scene, only: scene_t, add_face, add_line, add_label, part_ground, part_carrier, line_ground
   implicit none(type, external)
   private
   public :: add_solid, add_ghost, add_ground, add_names

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
         call add_elastic(scene, suspension%elements(k), state, is_plain)
      end do
      do k = 1, size(suspension%wheels)
         call add_wheel(scene, suspension, state, k, is_plain)
      end do
   end subroutine add_solid

   !> Adds all parts as thin lines.
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
            call add_line(scene, kind, bar_of(suspension, state, body, skeleton, k))
         end do
      end do
      do k = 1, size(suspension%joints)
         if (joint_table(suspension%joints(k)%number)%part /= rod_part) cycle
         call ends_of(first_measure(suspension, k), state, line(:, 1), line(:, 2))
         call add_line(scene, kind, line)
      end do
      do k = 1, size(suspension%wheels)
         call add_tread(scene, suspension, state, k, kind)
      end do
   end subroutine add_ghost

   !> Adds the road under the wheels, and an arrow to the front of the car.
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
            at = place_of(suspension, state, wheel%body, wheel%contact)
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
      if (.not. is_plain) call add_face(scene, part_ground, face)
      call add_line(scene, line_ground, reshape([face, face(:, 1)], [3, 5]))
      middle = (low(2) + high(2))/2
      if (size(suspension%wheels) == 1) middle = middle - suspension%wheels(1)%side*0.16_wp
      at = [low(1) + 0.16_wp, middle, z]
      arrow = reshape([-0.12_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.045_wp, 0.0_wp, 0.0_wp, -0.045_wp, 0.0_wp], [3, 3])
      call add_face(scene, part_carrier, arrow + spread(at, 2, 3))
      call add_label(scene, at + [0.02_wp, 0.0_wp, 0.0_wp], 'front')
   end subroutine add_ground

   !> Names of bodies, rods and springs, once for left and right.
   subroutine add_names(scene, suspension, state)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(skeleton_t) :: skeleton
      real(wp) :: a(3), b(3), bar(3, 2), longest, at(3)
      integer :: body, k

      do body = 1, size(suspension%bodies)
         skeleton = skeleton_of(suspension, body)
         longest = 0.0_wp
         if (count(skeleton%nodes(:skeleton%used)%is_held) == 2 .and. skeleton%used > 2) then    ! a wishbone: name in its middle
            longest = 1.0_wp
            at = 0.0_wp
            do k = 1, skeleton%used
               at = at + place_of(suspension, state, body, skeleton%nodes(k)%arm)/skeleton%used
            end do
            call name_at(suspension%bodies(body)%name)
            cycle
         end if
         do k = 1, skeleton%count
            bar = bar_of(suspension, state, body, skeleton, k)
            if (norm2(bar(:, 2) - bar(:, 1)) <= longest) cycle
            longest = norm2(bar(:, 2) - bar(:, 1))
            at = (bar(:, 1) + bar(:, 2))/2
         end do
         if (longest > 0.0_wp .and. slides(suspension, body) .and. .not. carries_wheel(suspension, body)) then
            call name_at(suspension%bodies(body)%name, 5.0_wp)       ! name beside the coil around it
         else if (longest > 0.0_wp) then
            call name_at(suspension%bodies(body)%name)
         end if
      end do
      do k = 1, size(suspension%joints)
         if (joint_table(suspension%joints(k)%number)%part /= rod_part) cycle
         call ends_of(first_measure(suspension, k), state, a, b)
         at = 0.8_wp*a + 0.2_wp*b      ! away from the name of a wishbone or a carrier beside it
         call name_at(suspension%joints(k)%name)
      end do
      do k = 1, size(suspension%elements)
         associate (element => suspension%elements(k), shape => element_kinds(suspension%elements(k)%kind)%shape)
            if (element%measure%kind /= distance .or. shape == stop_shape) cycle
            call ends_of(element%measure, state, a, b)
            at = 0.3_wp*a + 0.7_wp*b
            if (shape == damper_shape) at = b         ! name above the coil around it
            call name_at(element%name, 5.0_wp)
         end associate
      end do

   contains

      subroutine name_at(name, aside)
         character(*), intent(in) :: name
         real(wp), intent(in), optional :: aside
         if (index(name, 'right_') /= 1) call add_label(scene, at, spaced(name(merge(6, 1, index(name, 'left_') == 1):)), aside)
      end subroutine name_at

   end subroutine add_names

end module ek_picture
