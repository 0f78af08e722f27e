!> Converts an axle of IPGKinematics to a deck: double wishbones, their bushings, the tie rods on a rack, coil springs directly or
!> by push or pull rods and rockers, a U-shaped anti-roll bar, masses and wheel loads.
!>
!> As in IPGKinematics, the design position is an equilibrium under the weights and the wheel loads, if the file contains forces.
!> `balance` = 'all' then finds the preloads that this equilibrium requires.
!>
!> The mass of an arm is in the middle between its ball joint and its pivots, the mass of a tie rod in its middle, the mass of a
!> carrier in the middle between its ball joints and the wheel centre, the mass of the wheel at its centre, and the mass of a
!> rocker at its pivot.
!>
!> The groups of the deck: points and bodies; joints and the driver of the rack; springs, push or pull rods and the anti-roll bar;
!> bushings.
module ek_kin_deck
   use ek_kinds, only: wp, millimetre, degree
   use ek_flaws, only: flaws_t
   use ek_fields, only: legal_name
   use ek_deck_text, only: deck_text_t
   use ek_kin, only: kin_t, wheel_centre, contact, subframe_front, subframe_rear, lower_ball, upper_ball, tie_rod_outer, &
      lower_front, lower_rear, upper_front, upper_rear, tie_rod_inner, bar_bearing, bar_end, link_end, spring_body, spring_wheel, &
      rocker_pivot, rocker_axis, rod_wheel, rod_rocker, coil_body, coil_rocker, off, on_carrier, kin_curve_t
   use ek_kin_check, only: wheel_load, standard_gravity
   use ek_text, only: str
   use ek_law_points, only: law_points_t, add_point, finish_law
   use ek_law_text, only: put_curve, put_curves, put_bushing_law
   implicit none(type, external)
   private
   public :: kin_deck, mount_law_t

   !> The law of a bushing of the file.
   type :: mount_law_t
      type(law_points_t) :: laws(6)
      character(:), allocatable :: note       !! source of the law
   end type mount_law_t

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

   !> Writes the springs of the axle and the torsion spring of the bar into the deck, with the curves of all springs.
   subroutine put_springs(deck, kin, flaws)
      type(deck_text_t), intent(inout) :: deck
      type(kin_t), intent(in) :: kin
      type(flaws_t), intent(inout) :: flaws
      character(*), parameter :: places(3) = [character(9) :: 'lower_arm', 'carrier', 'upper_arm']

      call deck%heading('springs')
      if (kin%spring /= off) then
         call put_spring(deck, 'coil', trim(places(kin%spring)), 'chassis', 'spring_wheel', 'spring_body', kin%coil, flaws)
      else
         call put_spring(deck, 'push_rod', trim(places(kin%rod)), 'rocker', 'push_rod_wheel', 'push_rod_rocker', kin%rod_law, flaws)
         call put_spring(deck, 'coil', 'rocker', 'chassis', 'spring_rocker', 'spring_body', kin%coil, flaws)
      end if
      if (kin%bar == off) return
      call put_curve_of(deck, 'bar_torsion', kin%bar_law, degree, 4, flaws)
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

   subroutine put_spring(deck, name, first, second, from, to, law, flaws)
      type(deck_text_t), intent(inout) :: deck
      character(*), intent(in) :: name, first, second, from, to
      type(kin_curve_t), intent(in) :: law
      type(flaws_t), intent(inout) :: flaws

      call put_curve_of(deck, name, law, millimetre, 1, flaws)
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
   end subroutine put_spring

   !> Writes the curve of a law with points, named <name>_law. Nothing is written for a rate.
   subroutine put_curve_of(deck, name, law, x_unit, component, flaws)
      type(deck_text_t), intent(inout) :: deck
      character(*), intent(in) :: name
      type(kin_curve_t), intent(in) :: law
      real(wp), intent(in) :: x_unit
      integer, intent(in) :: component       !! 1 for a force, 4 for a moment
      type(flaws_t), intent(inout) :: flaws
      type(law_points_t) :: points
      integer :: k

      if (.not. law%has_points) return
      points%line = law%line
      do k = 1, size(law%x)
         call add_point(points, law%x(k)*x_unit, law%y(k)*law%factor, law%line)
      end do
      call finish_law(points, 'the points of '//name, flaws)
      if (.not. points%is_bad) call put_curve(deck, name//'_law', points, component, 'linear')
   end subroutine put_curve_of

   !> Writes the bushings of the axle into the deck. x of the markers is along the axis of each bushing.
   subroutine put_mounts(deck, kin, mounts)
      type(deck_text_t), intent(inout) :: deck
      type(kin_t), intent(in) :: kin
      type(mount_law_t), intent(in) :: mounts(:)
      character(:), allocatable :: upper

      upper = frame_of(kin%has_subframe .and. kin%has_upper_on_subframe)
      call deck%heading('bushings: kt in N/mm, kr in N mm/deg, x along the axis of the bushing')
      call put_mount(deck, kin, mounts, 'lower_front', 3, frame_of(kin%has_subframe), 'lower_arm', 'lower_arm_front')
      call put_mount(deck, kin, mounts, 'lower_rear', 4, frame_of(kin%has_subframe), 'lower_arm', 'lower_arm_rear')
      call put_mount(deck, kin, mounts, 'upper_front', 5, upper, 'upper_arm', 'upper_arm_front')
      call put_mount(deck, kin, mounts, 'upper_rear', 6, upper, 'upper_arm', 'upper_arm_rear')
      call put_mount(deck, kin, mounts, 'tie_rod_bush', 7, 'rack', 'tie_rod', 'tie_rod_inner')
      if (kin%has_subframe) then
         call put_mount(deck, kin, mounts, 'subframe_front', 1, 'chassis', 'subframe', 'subframe_front')
         call put_mount(deck, kin, mounts, 'subframe_rear', 2, 'chassis', 'subframe', 'subframe_rear')
      end if
   end subroutine put_mounts

   !> Writes a bushing of the file at a point of the axle. The position that the file gives in its list of bushings sets only the
   !> axis.
   subroutine put_mount(deck, kin, mounts, name, k, first, second, at)
      type(deck_text_t), intent(inout) :: deck
      type(kin_t), intent(in) :: kin
      type(mount_law_t), intent(in) :: mounts(:)
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
   end subroutine put_mount

   !> Whether a bushing has no rotational stiffness.
   pure logical function turns_freely(law)
      type(mount_law_t), intent(in) :: law
      integer :: j

      turns_freely = .true.
      do j = 4, 6
         turns_freely = turns_freely .and. .not. any(abs(law%laws(j)%y(:law%laws(j)%used)) > 0.0_wp)
      end do
   end function turns_freely

   !> Name of the body that carries an arm or the rack: 'subframe' or 'chassis'.
   pure function frame_of(is_subframe) result(name)
      logical, intent(in) :: is_subframe
      character(:), allocatable :: name

      name = 'chassis'
      if (is_subframe) name = 'subframe'
   end function frame_of

end module ek_kin_deck
