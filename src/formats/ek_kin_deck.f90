!> Converts an axle of IPGKinematics to a deck: double wishbones, their bushings, the tie rods on a rack, coil springs directly or
!> by push or pull rods and rockers, a U-shaped anti-roll bar, masses and wheel loads.
!>
!> As in IPGKinematics, the design position is an equilibrium under the weights and the wheel loads, if the file contains forces.
!> `balance` = 'all' then finds the preloads that this equilibrium requires.
module ek_kin_deck
   use ek_kinds, only: wp
   use ek_flaws, only: flaws_t
   use ek_fields, only: legal_name
   use ek_deck_text, only: deck_text_t
   use ek_kin, only: kin_t
   use ek_kin_check, only: wheel_load, standard_gravity
   use ek_kin_points, only: put_points, put_bodies
   use ek_kin_mounts, only: mount_law_t, put_mounts
   use ek_kin_joints, only: put_joints
   use ek_kin_springs, only: put_springs
   implicit none(type, external)
   private
   public :: kin_deck

   integer, parameter :: longest_title = 2000      !! characters that a deck accepts

contains

   !> Writes the axle of a .kin file as a deck.
   subroutine kin_deck(kin, mounts, source, text, flaws)
      type(kin_t), intent(in) :: kin
      type(mount_law_t), intent(in) :: mounts(:)
      character(*), intent(in) :: source                    !! the file, for a comment
      character(:), allocatable, intent(out) :: text
      type(flaws_t), intent(inout) :: flaws                 !! errors in the curves
      type(deck_text_t) :: deck
      character(:), allocatable :: name

      name = legal_name(kin%remark)
      if (len_trim(kin%remark) == 0) name = 'axle'
      call deck%comment('Made by elastokin import from '//source//'; check it before you rely on it.')
      call deck%comment('The left half of the axle; &mirror creates the right half. mm, N, deg.')
      call deck%blank()
      call deck%begin('model')
      call deck%word('name', name)
      if (len_trim(kin%remark) > 0) call deck%word('title', kin%remark(:min(len(kin%remark), longest_title)))
      call deck%word('axes', trim(merge('iso   ', 'x-rear', kin%is_iso)))
      if (kin%has_forces) then
         call deck%word('balance', 'all')
         call deck%number('gravity', standard_gravity)
      end if
      call deck%end()
      call deck%begin('mirror')
      call deck%word('shared', 'rack')
      if (kin%has_subframe) call deck%add_word('shared', 'subframe', .false.)
      call deck%end()
      call put_points(deck, kin)
      call put_bodies(deck, kin)
      call put_joints(deck, kin, mounts)
      call put_mounts(deck, kin, mounts)
      call put_springs(deck, kin, flaws)
      call put_wheel(deck, kin)
      call put_cases(deck, kin)
      text = deck%text()
   end subroutine kin_deck

   subroutine put_wheel(deck, kin)
      type(deck_text_t), intent(inout) :: deck
      type(kin_t), intent(in) :: kin

      call deck%heading('wheel, axle, load')
      call deck%begin('wheel')
      call deck%word('name', 'left')
      call deck%word('body', 'carrier')
      call deck%word('side', 'left')
      call deck%word('centre', 'wheel_centre')
      call deck%word('contact', 'contact_patch')
      call deck%number('toe', kin%toe/60)
      call deck%number('camber', kin%camber)
      call deck%number('tyre_rate', kin%tyre_rate)
      call deck%words('steer_axis', 'lower_ball_joint', 'upper_ball_joint')
      call deck%end()
      call deck%begin('axle')
      call deck%word('position', trim(merge('front', 'rear ', kin%is_front)))
      call deck%number('wheelbase', kin%wheelbase)
      call deck%number('cg_height', kin%cg_height)
      call deck%number('brake_share', merge(kin%brake_share, 1 - kin%brake_share, kin%is_front))
      call deck%number('drive_share', kin%drive_share)
      call deck%end()
      if (kin%has_forces) then
         call deck%begin('load')
         call deck%word('name', 'wheel_load')
         call deck%word('body', 'carrier')
         call deck%word('at', 'contact_patch')
         call deck%numbers('force', [0.0_wp, 0.0_wp, wheel_load(kin)])
         call deck%end()
      end if
   end subroutine put_wheel

   subroutine put_cases(deck, kin)
      type(deck_text_t), intent(inout) :: deck
      type(kin_t), intent(in) :: kin

      call deck%heading('cases; the rig holds the wheels by their tyres where vertical is road')
      if (kin%rebound < kin%bump) then
         call put_case(deck, 'parallel_travel', kin%rebound, kin%bump, '')
         call put_case(deck, 'opposite_travel', kin%rebound, kin%bump, '')
      end if
      if (kin%is_front .and. kin%rack_least < kin%rack_most) call put_case(deck, 'steering', kin%rack_least, kin%rack_most, '')
      call put_case(deck, 'lateral_force', -1000.0_wp, 1000.0_wp, 'road')
      call put_case(deck, 'braking', -1000.0_wp, 1000.0_wp, 'road')
      call put_case(deck, 'traction', -1000.0_wp, 1000.0_wp, 'road')
      call put_case(deck, 'aligning_torque', -100.0_wp, 100.0_wp, 'road')
   end subroutine put_cases

   subroutine put_case(deck, name, from, to, vertical)
      type(deck_text_t), intent(inout) :: deck
      character(*), intent(in) :: name, vertical
      real(wp), intent(in) :: from, to

      call deck%begin('case')
      call deck%word('test', name)
      call deck%number('from', from)
      call deck%number('to', to)
      if (vertical /= '') call deck%word('vertical', vertical)
      call deck%end()
   end subroutine put_case

end module ek_kin_deck
