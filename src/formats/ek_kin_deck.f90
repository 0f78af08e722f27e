!> An axle of IPGKinematics as a deck: double wishbones, their bushings, the tie rods on a rack, coil springs directly or by push
!> or pull rods and rockers, a U-shaped anti-roll bar, masses and wheel loads.
!>
!> As there, the design position is an equilibrium under the weights and the wheel loads: the springs get the preloads for it. The
!> mass of an arm is in the middle between its ball joint and its pivots, that of a tie rod in its middle, that of a carrier in the
!> middle between its ball joints and the wheel centre, that of the wheel at its centre, that of a rocker at its pivot.
module ek_kin_deck
   use ek_kinds, only: wp, millimetre, degree
   use ek_text, only: str
   use ek_flaws, only: flaws_t
   use ek_kin_check, only: wheel_load, standard_gravity
   use ek_fields, only: legal_name
   use ek_law_points, only: law_points_t, add_point, finish_law
   use ek_deck_text, only: deck_text_t
   use ek_law_text, only: put_curve, put_curves, put_bushing_law
   use ek_kin, only: kin_t, kin_curve_t, wheel_centre, contact, subframe_front, subframe_rear, lower_ball, upper_ball, &
      tie_rod_outer, lower_front, lower_rear, upper_front, upper_rear, tie_rod_inner, bar_bearing, bar_end, link_end, &
      spring_body, spring_wheel, rocker_pivot, rocker_axis, rod_wheel, rod_rocker, coil_body, coil_rocker, off, on_carrier
   implicit none(type, external)
   private
   public :: mount_law_t, kin_deck

   !> The law of a bushing of the file.
   type :: mount_law_t
      type(law_points_t) :: laws(6)
      character(:), allocatable :: note       !! where it is from
   end type mount_law_t

contains

   !> The deck.
   subroutine kin_deck(kin, mounts, source, text, flaws)
      type(kin_t), intent(in) :: kin
      type(mount_law_t), intent(in) :: mounts(:)
      character(*), intent(in) :: source                    !! the file, for a comment
      character(:), allocatable, intent(out) :: text
      type(flaws_t), intent(inout) :: flaws                 !! mistakes in the curves
      type(deck_text_t) :: deck
      character(:), allocatable :: name

      name = legal_name(kin%remark)
      if (len_trim(kin%remark) == 0) name = 'axle'
      call deck%comment('Made by elastokin import from '//source//'; check it before you rely on it.')
      call deck%comment('The left half of the axle; &mirror makes the right one. mm, N, deg.')
      call deck%blank()
      call deck%begin('model')
      call deck%word('name', name)
      call deck%word('title', kin%remark)
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
      call put_points()
      call put_bodies()
      call put_joints()
      call put_mounts()
      call put_springs()
      call put_wheel()
      text = deck%text()

   contains

      subroutine head(words)
         character(*), intent(in) :: words

         call deck%blank()
         call deck%comment('---- '//words//' ----')
         call deck%blank()
      end subroutine head

      subroutine point(name, at, note)
         character(*), intent(in) :: name
         real(wp), intent(in) :: at(3)
         character(*), intent(in), optional :: note

         call deck%begin('point')
         call deck%word('name', name)
         call deck%numbers('at', at)
         if (present(note)) call deck%word('note', note)
         call deck%end()
      end subroutine point

      subroutine numbered(name, k)
         character(*), intent(in) :: name
         integer, intent(in) :: k
         call point(name, kin%at(:, k), 'point '//str(k))
      end subroutine numbered

      pure function middle(numbers) result(at)
         integer, intent(in) :: numbers(:)
         real(wp) :: at(3)
         at = sum(kin%at(:, numbers), dim=2)/size(numbers)
      end function middle

      subroutine put_points()
         call head('hardpoints, design position; numbers as in the file')
         call numbered('wheel_centre', wheel_centre)
         call numbered('contact_patch', contact)
         call numbered('lower_ball_joint', lower_ball)
         call numbered('upper_ball_joint', upper_ball)
         call numbered('tie_rod_outer', tie_rod_outer)
         call numbered('tie_rod_inner', tie_rod_inner)
         call numbered('lower_arm_front', lower_front)
         call numbered('lower_arm_rear', lower_rear)
         call numbered('upper_arm_front', upper_front)
         call numbered('upper_arm_rear', upper_rear)
         call point('rack_centre', [kin%at(1, tie_rod_inner), 0.0_wp, kin%at(3, tie_rod_inner)])
         if (kin%has_subframe) then
            call numbered('subframe_front', subframe_front)
            call numbered('subframe_rear', subframe_rear)
         end if
         if (kin%spring /= off) then
            call numbered('spring_body', spring_body)
            call numbered('spring_wheel', spring_wheel)
         else
            call numbered('rocker_pivot', rocker_pivot)
            call numbered('rocker_axis', rocker_axis)
            call numbered('push_rod_wheel', rod_wheel)
            call numbered('push_rod_rocker', rod_rocker)
            call numbered('spring_body', coil_body)
            call numbered('spring_rocker', coil_rocker)
         end if
         if (kin%bar /= off) then
            call numbered('bar_bearing', bar_bearing)
            call numbered('bar_end', bar_end)
            call numbered('bar_link', link_end)
         end if
         call deck%blank()
         call point('lower_arm_mass', middle([lower_ball, lower_ball, lower_front, lower_rear]))
         call point('upper_arm_mass', middle([upper_ball, upper_ball, upper_front, upper_rear]))
         call point('tie_rod_mass', middle([tie_rod_outer, tie_rod_inner]))
         call point('carrier_mass', middle([wheel_centre, wheel_centre, lower_ball, upper_ball]))
      end subroutine put_points

      subroutine body(name, mass, centre, note)
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
      end subroutine body

      subroutine put_bodies()
         call head('bodies')
         call body('lower_arm', kin%lower_arm, 'lower_arm_mass')
         call body('upper_arm', kin%upper_arm, 'upper_arm_mass')
         call body('tie_rod', kin%tie_rod, 'tie_rod_mass')
         call body('carrier', kin%carrier, 'carrier_mass')
         if (kin%wheel > 0.0_wp) then
            call deck%begin('mass')
            call deck%word('name', 'wheel')
            call deck%word('body', 'carrier')
            call deck%number('kg', kin%wheel)
            call deck%word('at', 'wheel_centre')
            call deck%end()
         end if
         if (kin%rod /= off) call body('rocker', kin%rocker, 'rocker_pivot')
         call body('rack', 0.0_wp, '', 'its weight is on the chassis')
         if (kin%has_subframe) call body('subframe', 0.0_wp, '', 'its weight is on the chassis')
         if (kin%bar /= off) call body('bar', 0.0_wp, '', 'half of the anti-roll bar, cut in the middle')
      end subroutine put_bodies

      subroutine joint(name, type, first, second, at)
         character(*), intent(in) :: name, type, first, second, at

         call deck%begin('joint')
         call deck%word('name', name)
         call deck%word('type', type)
         call deck%words('bodies', first, second)
         if (at /= '') call deck%word('at', at)
      end subroutine joint

      subroutine put_joints()
         real(wp) :: rod(3), across(3)

         call head('joints')
         call joint('lower_ball', 'spherical', 'lower_arm', 'carrier', 'lower_ball_joint')
         call deck%end()
         call joint('upper_ball', 'spherical', 'upper_arm', 'carrier', 'upper_ball_joint')
         call deck%end()
         ! its bushing does not hold the rotation of the rod about itself, if it has no rotational stiffness
         rod = kin%at(:, tie_rod_outer) - kin%at(:, tie_rod_inner)
         across = [-rod(3)*rod(1), -rod(3)*rod(2), rod(1)**2 + rod(2)**2]
         if (.not. norm2(across) > 0.0_wp) across = [1.0_wp, 0.0_wp, 0.0_wp]
         if (turns_freely(7)) then
            call joint('tie_rod_ball', 'universal', 'tie_rod', 'carrier', 'tie_rod_outer')
            call deck%numbers('axis_vector', across/norm2(across))
            call deck%word('note', 'a ball joint that keeps the rod from turning about itself')
         else
            call joint('tie_rod_ball', 'spherical', 'tie_rod', 'carrier', 'tie_rod_outer')
         end if
         call deck%end()
         if (kin%rod /= off) then
            call joint('rocker_bearing', 'revolute', 'chassis', 'rocker', 'rocker_pivot')
            call deck%words('axis', 'rocker_pivot', 'rocker_axis')
            call deck%end()
         end if
         call joint('rack_guide', 'translational', frame_of(kin%has_subframe), 'rack', 'rack_centre')
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
            call joint('bar_hinge', 'revolute', 'chassis', 'bar', 'bar_bearing')
            call deck%numbers('axis_vector', [0.0_wp, 1.0_wp, 0.0_wp])
            call deck%end()
            call joint('bar_link', 'distance', 'bar', trim(merge('carrier  ', 'lower_arm', kin%bar == on_carrier)), '')
            call deck%words('at', 'bar_end', 'bar_link')
            call deck%word('note', 'rigid: the bushing of the link, number 8 of the file, is left out')
            call deck%end()
         end if
      end subroutine put_joints

      pure logical function turns_freely(k)
         integer, intent(in) :: k
         integer :: j

         turns_freely = .true.
         do j = 4, 6
            turns_freely = turns_freely .and. .not. any(abs(mounts(k)%laws(j)%y(:mounts(k)%laws(j)%used)) > 0.0_wp)
         end do
      end function turns_freely

      !> A bushing of the file, at a point of the axle: the position that the file gives in the list of bushings sets the axis only.
      subroutine mount(name, k, first, second, at)
         character(*), intent(in) :: name, first, second, at
         integer, intent(in) :: k
         real(wp) :: axis(3)

         call put_curves(deck, name, mounts(k)%laws, 'linear')
         call deck%begin('bushing')
         call deck%word('name', name)
         call deck%words('bodies', first, second)
         call deck%word('at', at)
         axis = kin%mounts(k)%axis - kin%mounts(k)%centre
         if (norm2(axis) > 0.0_wp) call deck%numbers('x_vector', axis/norm2(axis))
         call put_bushing_law(deck, name, mounts(k)%laws)
         call deck%word('note', mounts(k)%note)
         call deck%end()
      end subroutine mount

      subroutine put_mounts()
         call head('bushings: kt in N/mm, kr in N mm/deg, x along the axis of the bushing')
         call mount('lower_front', 3, frame_of(kin%has_subframe), 'lower_arm', 'lower_arm_front')
         call mount('lower_rear', 4, frame_of(kin%has_subframe), 'lower_arm', 'lower_arm_rear')
         call mount('upper_front', 5, frame_of(kin%has_subframe .and. kin%has_upper_on_subframe), 'upper_arm', 'upper_arm_front')
         call mount('upper_rear', 6, frame_of(kin%has_subframe .and. kin%has_upper_on_subframe), 'upper_arm', 'upper_arm_rear')
         call mount('tie_rod_bush', 7, 'rack', 'tie_rod', 'tie_rod_inner')
         if (kin%has_subframe) then
            call mount('subframe_front', 1, 'chassis', 'subframe', 'subframe_front')
            call mount('subframe_rear', 2, 'chassis', 'subframe', 'subframe_rear')
         end if
      end subroutine put_mounts

      !> The curve of a law with points, named <name>_law.
      subroutine curve_of(name, law, x_unit, component)
         character(*), intent(in) :: name
         type(kin_curve_t), intent(in) :: law
         real(wp), intent(in) :: x_unit
         integer, intent(in) :: component       !! 4 for a moment
         type(law_points_t) :: points
         integer :: k

         if (.not. law%has_points) return
         points%line = law%line
         do k = 1, size(law%x)
            call add_point(points, law%x(k)*x_unit, law%y(k)*law%factor, law%line)
         end do
         call finish_law(points, 'the points of '//name, flaws)
         if (.not. points%is_bad) call put_curve(deck, name//'_law', points, component, 'linear')
      end subroutine curve_of

      subroutine spring(name, first, second, from, to, law)
         character(*), intent(in) :: name, first, second, from, to
         type(kin_curve_t), intent(in) :: law

         call curve_of(name, law, millimetre, 1)
         call deck%begin('spring')
         call deck%word('name', name)
         call deck%words('bodies', first, second)
         call deck%words('at', from, to)
         if (law%has_points) then
            call deck%word('curve', name//'_law')
         else
            call deck%number('rate', law%rate)
         end if
         call deck%end()
      end subroutine spring

      subroutine put_springs()
         character(*), parameter :: places(3) = [character(9) :: 'lower_arm', 'carrier', 'upper_arm']

         call head('springs')
         if (kin%spring /= off) then
            call spring('coil', trim(places(kin%spring)), 'chassis', 'spring_wheel', 'spring_body', kin%coil)
         else
            call spring('push_rod', trim(places(kin%rod)), 'rocker', 'push_rod_wheel', 'push_rod_rocker', kin%rod_law)
            call spring('coil', 'rocker', 'chassis', 'spring_rocker', 'spring_body', kin%coil)
         end if
         if (kin%bar == off) return
         call curve_of('bar_torsion', kin%bar_law, degree, 4)
         call deck%begin('torsion')
         call deck%word('name', 'bar_torsion')
         call deck%words('bodies', 'left_bar', 'right_bar')
         call deck%numbers('axis_vector', [0.0_wp, 1.0_wp, 0.0_wp])
         if (kin%bar_law%has_points) then
            call deck%word('curve', 'bar_torsion_law')
         else
            call deck%number('rate', kin%bar_law%rate*1000)
         end if
         call deck%end()
      end subroutine put_springs

      subroutine put_wheel()
         call head('wheel, axle, load')
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
         call head('cases; the rig holds the wheels by their tyres where vertical is road')
         if (kin%rebound < kin%bump) then
            call test('parallel_travel', kin%rebound, kin%bump, '')
            call test('opposite_travel', kin%rebound, kin%bump, '')
         end if
         if (kin%is_front .and. kin%rack_least < kin%rack_most) call test('steering', kin%rack_least, kin%rack_most, '')
         call test('lateral_force', -1000.0_wp, 1000.0_wp, 'road')
         call test('braking', -1000.0_wp, 1000.0_wp, 'road')
         call test('traction', -1000.0_wp, 1000.0_wp, 'road')
         call test('aligning_torque', -100.0_wp, 100.0_wp, 'road')
      end subroutine put_wheel

      subroutine test(name, from, to, vertical)
         character(*), intent(in) :: name, vertical
         real(wp), intent(in) :: from, to

         call deck%begin('case')
         call deck%word('test', name)
         call deck%number('from', from)
         call deck%number('to', to)
         if (vertical /= '') call deck%word('vertical', vertical)
         call deck%end()
      end subroutine test

   end subroutine kin_deck

   pure function frame_of(is_subframe) result(name)
      logical, intent(in) :: is_subframe
      character(:), allocatable :: name

      name = 'chassis'
      if (is_subframe) name = 'subframe'
   end function frame_of

end module ek_kin_deck
