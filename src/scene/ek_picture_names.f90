!> The names of the parts in the picture of a suspension, and the axes of its deck.
module ek_picture_names
   use ek_kinds, only: wp
   use ek_text, only: spaced
   use ek_measure, only: distance
   use ek_joint, only: joint_table, rod_part
   use ek_element, only: element_kinds, damper_shape, stop_shape
   use ek_suspension, only: suspension_t
   use ek_wheel_side, only: deck_frame
   use ek_wheel_contact, only: contact_arm
   use ek_skeleton, only: skeleton_t, skeleton_of, first_measure, ends_of, place_of, bar_of
   use ek_state, only: state_t
   use ek_scene, only: scene_t, add_run, add_label, line_axes
   implicit none(type, external)
   private
   public :: add_names, add_axes, part_label

contains

   !> Adds the axes of the deck at the front right corner of all faces, at the height of the lowest contact point. For a model
   !> without wheels, they are at the height of the lowest face. Adds nothing without faces.
   subroutine add_axes(scene, suspension, state)
      type(scene_t), intent(inout) :: scene      !! with all parts
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      real(wp), parameter :: length = 0.12_wp    ! m
      character(1), parameter :: names(3) = ['x', 'y', 'z']
      real(wp) :: corner(3), tip(3), frame(3), line(3, 6)
      integer :: k

      if (scene%faces%used == 0) return
      associate (at => scene%faces%at(:, :scene%faces%used))
         corner = [minval(at(1, :)), maxval(at(2, :)), minval(at(3, :))]
         if (size(suspension%wheels) > 0) corner(3) = minval([(z_of(k), k=1, size(suspension%wheels))])
      end associate
      frame = deck_frame(suspension)
      do k = 1, 3
         tip = corner
         tip(k) = tip(k) + length*frame(k)
         line(:, 2*k - 1) = corner
         line(:, 2*k) = tip
         tip(k) = tip(k) + 0.15_wp*length*frame(k)
         call add_label(scene, tip, names(k))
      end do
      call add_run(scene%lines, line_axes, line)      ! one line: gnuplot joins lines of as many points to a mesh

   contains

      !> Height of the contact point of wheel k [m].
      real(wp) function z_of(k)
         integer, intent(in) :: k
         real(wp) :: contact(3)
         associate (wheel => suspension%wheels(k))
            contact = state%poses(wheel%body + 1)%r + contact_arm(wheel, state%poses(wheel%body + 1)%a)
         end associate
         z_of = contact(3)
      end function z_of

   end subroutine add_axes

   !> Adds the names of bodies, rods, and elements between two points except stops. Left and right have one name, at the left
   !> part.
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
            at = 0.0_wp
            do k = 1, skeleton%used
               at = at + place_of(state, body, skeleton%nodes(k)%arm)/skeleton%used
            end do
            call name_at(suspension%bodies(body)%name)
            cycle
         end if
         do k = 1, skeleton%count
            bar = bar_of(state, body, skeleton, k)
            if (norm2(bar(:, 2) - bar(:, 1)) <= longest) cycle
            longest = norm2(bar(:, 2) - bar(:, 1))
            at = (bar(:, 1) + bar(:, 2))/2
         end do
         if (longest <= 0.0_wp) cycle
         call name_at(suspension%bodies(body)%name)
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
            call name_at(element%name)
         end associate
      end do

   contains

      subroutine name_at(name)
         character(*), intent(in) :: name
         if (part_label(name) /= '') call add_label(scene, at, part_label(name))
      end subroutine name_at

   end subroutine add_names

   !> The label of a part in a picture: 'tie rod' for left_tie_rod; '' for right_tie_rod, since left and right have one label.
   pure function part_label(name) result(label)
      character(*), intent(in) :: name
      character(:), allocatable :: label

      label = ''
      if (index(name, 'right_') /= 1) label = spaced(name(merge(6, 1, index(name, 'left_') == 1):))
   end function part_label

end module ek_picture_names
