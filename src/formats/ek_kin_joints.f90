!> The joints of an axle of IPGKinematics, and the driver of its rack, as groups of a deck.
module ek_kin_joints
   use ek_kinds, only: wp
   use ek_deck_text, only: deck_text_t
   use ek_kin, only: kin_t, tie_rod_outer, tie_rod_inner, off, on_carrier
   use ek_kin_mounts, only: mount_law_t, turns_freely, frame_of
   implicit none(type, external)
   private
   public :: put_joints

contains

   !> Writes the joints of the axle into the deck, and the driver of the rack with its measure.
   subroutine put_joints(deck, kin, mounts)
      type(deck_text_t), intent(inout) :: deck
      type(kin_t), intent(in) :: kin
      type(mount_law_t), intent(in) :: mounts(:)
      real(wp) :: rod(3), across(3)

      call deck%heading('joints')
      call begin_joint(deck, 'lower_ball', 'spherical', 'lower_arm', 'carrier', 'lower_ball_joint')
      call deck%end()
      call begin_joint(deck, 'upper_ball', 'spherical', 'upper_arm', 'carrier', 'upper_ball_joint')
      call deck%end()
      ! its bushing does not hold the rotation of the rod about itself, if it has no rotational stiffness
      rod = kin%at(:, tie_rod_outer) - kin%at(:, tie_rod_inner)
      across = [-rod(3)*rod(1), -rod(3)*rod(2), rod(1)**2 + rod(2)**2]
      if (.not. norm2(across) > 0.0_wp) across = [1.0_wp, 0.0_wp, 0.0_wp]
      if (turns_freely(mounts(7))) then
         call begin_joint(deck, 'tie_rod_ball', 'universal', 'tie_rod', 'carrier', 'tie_rod_outer')
         call deck%numbers('axis_vector', across/norm2(across))
         call deck%word('note', 'a ball joint that prevents the rod from rotating about itself')
      else
         call begin_joint(deck, 'tie_rod_ball', 'spherical', 'tie_rod', 'carrier', 'tie_rod_outer')
      end if
      call deck%end()
      if (kin%rod /= off) then
         call begin_joint(deck, 'rocker_bearing', 'revolute', 'chassis', 'rocker', 'rocker_pivot')
         call deck%words('axis', 'rocker_pivot', 'rocker_axis')
         call deck%end()
      end if
      call begin_joint(deck, 'rack_guide', 'translational', frame_of(kin%has_subframe), 'rack', 'rack_centre')
      call deck%numbers('axis_vector', [0.0_wp, 1.0_wp, 0.0_wp])
      call deck%end()
      call deck%begin('measure')
      call deck%word('name', 'rack_travel')
      call deck%word('type', 'gap')
      call deck%words('bodies', frame_of(kin%has_subframe), 'rack')
      call deck%word('at', 'rack_centre')
      call deck%numbers('axis_vector', [0.0_wp, 1.0_wp, 0.0_wp])
      call deck%end()
      call deck%begin('joint')
      call deck%word('name', 'rack_drive')
      call deck%word('type', 'driver')
      call deck%word('measure', 'rack_travel')
      call deck%end()
      if (kin%bar /= off) then
         call begin_joint(deck, 'bar_hinge', 'revolute', 'chassis', 'bar', 'bar_bearing')
         call deck%numbers('axis_vector', [0.0_wp, 1.0_wp, 0.0_wp])
         call deck%end()
         call begin_joint(deck, 'bar_link', 'distance', 'bar', trim(merge('carrier  ', 'lower_arm', kin%bar == on_carrier)), '')
         call deck%words('at', 'bar_end', 'bar_link')
         call deck%word('note', 'rigid: the bushing of the link, number 8 of the file, is omitted')
         call deck%end()
      end if
   end subroutine put_joints

   subroutine begin_joint(deck, name, type, first, second, at)
      type(deck_text_t), intent(inout) :: deck
      character(*), intent(in) :: name, type, first, second, at

      call deck%begin('joint')
      call deck%word('name', name)
      call deck%word('type', type)
      call deck%words('bodies', first, second)
      if (at /= '') call deck%word('at', at)
   end subroutine begin_joint

end module ek_kin_joints
