!> The points and bodies of an axle of IPGKinematics as groups of a deck.
!>
!> The mass of an arm is in the middle between its ball joint and its pivots, the mass of a tie rod in its middle, the mass of a
!> carrier in the middle between its ball joints and the wheel centre, the mass of the wheel at its centre, and the mass of a
!> rocker at its pivot.
module ek_kin_points
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_deck_text, only: deck_text_t
   use ek_kin, only: kin_t, wheel_centre, contact, subframe_front, subframe_rear, lower_ball, upper_ball, tie_rod_outer, &
      lower_front, lower_rear, upper_front, upper_rear, tie_rod_inner, bar_bearing, bar_end, link_end, spring_body, spring_wheel, &
      rocker_pivot, rocker_axis, rod_wheel, rod_rocker, coil_body, coil_rocker, off
   implicit none(type, external)
   private
   public :: put_points, put_bodies

contains

   !> Writes the hardpoints of the axle into the deck, with their numbers in the file. Also writes the centre of the rack and the
   !> points of the masses.
   subroutine put_points(deck, kin)
      type(deck_text_t), intent(inout) :: deck
      type(kin_t), intent(in) :: kin

      call deck%heading('hardpoints, design position; numbers as in the file')
      call put_numbered(deck, kin, 'wheel_centre', wheel_centre)
      call put_numbered(deck, kin, 'contact_patch', contact)
      call put_numbered(deck, kin, 'lower_ball_joint', lower_ball)
      call put_numbered(deck, kin, 'upper_ball_joint', upper_ball)
      call put_numbered(deck, kin, 'tie_rod_outer', tie_rod_outer)
      call put_numbered(deck, kin, 'tie_rod_inner', tie_rod_inner)
      call put_numbered(deck, kin, 'lower_arm_front', lower_front)
      call put_numbered(deck, kin, 'lower_arm_rear', lower_rear)
      call put_numbered(deck, kin, 'upper_arm_front', upper_front)
      call put_numbered(deck, kin, 'upper_arm_rear', upper_rear)
      call put_point(deck, 'rack_centre', [kin%at(1, tie_rod_inner), 0.0_wp, kin%at(3, tie_rod_inner)])
      if (kin%has_subframe) then
         call put_numbered(deck, kin, 'subframe_front', subframe_front)
         call put_numbered(deck, kin, 'subframe_rear', subframe_rear)
      end if
      if (kin%spring /= off) then
         call put_numbered(deck, kin, 'spring_body', spring_body)
         call put_numbered(deck, kin, 'spring_wheel', spring_wheel)
      else
         call put_numbered(deck, kin, 'rocker_pivot', rocker_pivot)
         call put_numbered(deck, kin, 'rocker_axis', rocker_axis)
         call put_numbered(deck, kin, 'push_rod_wheel', rod_wheel)
         call put_numbered(deck, kin, 'push_rod_rocker', rod_rocker)
         call put_numbered(deck, kin, 'spring_body', coil_body)
         call put_numbered(deck, kin, 'spring_rocker', coil_rocker)
      end if
      if (kin%bar /= off) then
         call put_numbered(deck, kin, 'bar_bearing', bar_bearing)
         call put_numbered(deck, kin, 'bar_end', bar_end)
         call put_numbered(deck, kin, 'bar_link', link_end)
      end if
      call deck%blank()
      call put_point(deck, 'lower_arm_mass', middle(kin, [lower_ball, lower_ball, lower_front, lower_rear]))
      call put_point(deck, 'upper_arm_mass', middle(kin, [upper_ball, upper_ball, upper_front, upper_rear]))
      call put_point(deck, 'tie_rod_mass', middle(kin, [tie_rod_outer, tie_rod_inner]))
      call put_point(deck, 'carrier_mass', middle(kin, [wheel_centre, wheel_centre, lower_ball, upper_ball]))
   end subroutine put_points

   !> Writes a point, with its number in the .kin file as a note.
   subroutine put_numbered(deck, kin, name, k)
      type(deck_text_t), intent(inout) :: deck
      type(kin_t), intent(in) :: kin
      character(*), intent(in) :: name
      integer, intent(in) :: k

      call put_point(deck, name, kin%at(:, k), 'point '//str(k))
   end subroutine put_numbered

   !> Writes a record &point.
   subroutine put_point(deck, name, at, note)
      type(deck_text_t), intent(inout) :: deck
      character(*), intent(in) :: name
      real(wp), intent(in) :: at(3)
      character(*), intent(in), optional :: note

      call deck%begin('point')
      call deck%word('name', name)
      call deck%numbers('at', at)
      if (present(note)) call deck%word('note', note)
      call deck%end()
   end subroutine put_point

   !> The mean position of several points.
   pure function middle(kin, numbers) result(at)
      type(kin_t), intent(in) :: kin
      integer, intent(in) :: numbers(:)
      real(wp) :: at(3)

      at = sum(kin%at(:, numbers), dim=2)/size(numbers)
   end function middle

   !> Writes the bodies of the axle into the deck, with their masses.
   subroutine put_bodies(deck, kin)
      type(deck_text_t), intent(inout) :: deck
      type(kin_t), intent(in) :: kin

      call deck%heading('bodies')
      call put_body(deck, 'lower_arm', kin%lower_arm, 'lower_arm_mass')
      call put_body(deck, 'upper_arm', kin%upper_arm, 'upper_arm_mass')
      call put_body(deck, 'tie_rod', kin%tie_rod, 'tie_rod_mass')
      call put_body(deck, 'carrier', kin%carrier, 'carrier_mass')
      if (kin%wheel > 0.0_wp) then
         call deck%begin('mass')
         call deck%word('name', 'wheel')
         call deck%word('body', 'carrier')
         call deck%number('kg', kin%wheel)
         call deck%word('at', 'wheel_centre')
         call deck%end()
      end if
      if (kin%rod /= off) call put_body(deck, 'rocker', kin%rocker, 'rocker_pivot')
      call put_body(deck, 'rack', 0.0_wp, '', 'its weight is on the chassis')
      if (kin%has_subframe) call put_body(deck, 'subframe', 0.0_wp, '', 'its weight is on the chassis')
      if (kin%bar /= off) call put_body(deck, 'bar', 0.0_wp, '', 'half of the anti-roll bar, cut in the middle')
   end subroutine put_bodies

   subroutine put_body(deck, name, mass, centre, note)
      type(deck_text_t), intent(inout) :: deck
      character(*), intent(in) :: name, centre
      real(wp), intent(in) :: mass
      character(*), intent(in), optional :: note

      call deck%begin('body')
      call deck%word('name', name)
      if (mass > 0.0_wp) then
         call deck%number('mass', mass)
         call deck%word('centre', centre)
      end if
      if (present(note)) call deck%word('note', note)
      call deck%end()
   end subroutine put_body

end module ek_kin_points
