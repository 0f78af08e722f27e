!> The deck of an axle made from its points: a deck of points and links, without springs, as `elastokin new KIND --points-only`
!> prints. Every point has the line of its source as a note. Comments at the beginning list what was taken, assumed and left out.
module ek_point_deck
   use ek_kinds, only: wp, degree
   use ek_text, only: str, lower
   use ek_flaws, only: flaws_t
   use ek_fields, only: legal_name
   use ek_hardpoint, only: left_point, right_point, point_pair
   use ek_deck_text, only: deck_text_t
   use ek_point_name, only: point_count, point_names, unused_point, wheel_centre, contact_patch, lca_front, &
      lca_rear, lower_ball, uca_front, uca_rear, upper_ball, tie_inner, tie_outer, toe_inner, toe_outer, strut_top, strut_low, &
      push_low, push_top, rocker_pivot, rocker_axis, arm_inner, arm_outer, upper_front_in, upper_front_out, upper_rear_in, &
      upper_rear_out, lower_in, lower_out, trailing_front, trailing_rear, rack_centre, damper_inner, damper_outer
   use ek_point_kind, only: kinds, double_wishbone, mcpherson, five_link, trailing_arm, find_kind, incomplete, check_rod, nearest
   use ek_point_table, only: point_table_t, not_a_point
   use ek_point_set, only: choose_points
   use ek_frame_votes, only: point_set_t, half_t, wish_t, frame_t, find_frame
   use ek_vote, only: column_name, length_names
   implicit none(type, external)
   private
   public :: put_points, axle_facts_t

   !> Numbers of an axle besides its points; `has_` marks those that are given.
   type :: axle_facts_t
      character(60) :: title = ''
      logical :: has_toe = .false., has_camber = .false.
      real(wp) :: toe = 0.0_wp, camber = 0.0_wp          !! [deg], signs of the deck
   end type axle_facts_t

   !> The deck being written.
   type :: writing_t
      type(deck_text_t) :: deck
      logical :: is_rear = .false.                  !! axes of the deck: x-rear; otherwise iso
      real(wp) :: factor = 1.0_wp                   !! unit of the table per unit of the deck
      character(2) :: length = 'mm'                 !! unit of the deck
      logical :: is_written(point_count) = .false.
      character(:), allocatable :: file
   end type writing_t

contains

   !> Writes the deck of the points of a table.
   subroutine put_points(table, wish, facts, path, text, flaws)
      type(point_table_t), intent(inout) :: table
      type(wish_t), intent(in) :: wish
      type(axle_facts_t), intent(in) :: facts
      character(*), intent(in) :: path
      character(:), allocatable, intent(out) :: text
      type(flaws_t), intent(inout) :: flaws
      type(point_set_t) :: points
      type(frame_t) :: frame
      type(writing_t) :: writing
      integer :: kind, missing

      text = ''
      call choose_points(table, wish, points, flaws)
      if (flaws%count() > 0) return
      call find_kind(points, kind, missing)
      if (kind > 0 .and. missing > 0) call flaws%add(0, incomplete(points, kind, table))
      if (flaws%count() == 0 .and. kind > 0) call check_rod(points, kind, flaws)
      if (flaws%count() > 0) return
      call find_frame(points, wish, frame)
      if (frame%problem /= '') then
         call flaws%add(0, frame%problem)
         return
      end if
      writing%file = path(index(path, '/', back=.true.) + 1:)
      writing%is_rear = frame%forward == -1
      call choose_unit(frame%length, writing)
      if (kind > 0) then
         call put_axle(points, frame, kind, facts, table, writing)
      else
         call put_part(points, frame, table, writing, flaws)
      end if
      if (flaws%count() == 0) text = writing%deck%text()
   end subroutine put_points

   !> Chooses the unit of the deck: that of the table, if decks have it.
   subroutine choose_unit(length, writing)
      integer, intent(in) :: length
      type(writing_t), intent(inout) :: writing

      writing%length = length_names(length)
      if (writing%length == 'cm') then
         writing%length = 'mm'
         writing%factor = 10.0_wp
      else if (writing%length == 'ft') then
         writing%length = 'in'
         writing%factor = 12.0_wp
      end if
   end subroutine choose_unit

   !> Writes the axle.
   subroutine put_axle(points, frame, kind, facts, table, writing)
      type(point_set_t), intent(in) :: points
      type(frame_t), intent(in) :: frame
      integer, intent(in) :: kind
      type(axle_facts_t), intent(in) :: facts
      type(point_table_t), intent(in) :: table
      type(writing_t), intent(inout) :: writing
      type(half_t) :: half
      logical :: is_steered
      integer :: rod(2)

      half = points%half(frame%half)
      half%at = 0.0_wp
      call turn_points(points%half(frame%half), frame, writing, half%at)
      is_steered = points%axle == 1 .and. kind /= trailing_arm
      rod = [tie_inner, tie_outer]
      if (.not. all(half%has(rod))) rod = [toe_inner, toe_outer]
      is_steered = is_steered .and. rod(1) == tie_inner
      call put_head(points, frame, kind, facts, writing)
      call mark_written(half, kind, rod, is_steered, writing)
      call put_left_out(half, table, frame, writing)
      call put_model(trim(kinds(kind)%title), writing)
      call writing%deck%blank()
      call writing%deck%begin('mirror')
      if (is_steered) call writing%deck%word('shared', 'rack')
      call writing%deck%end()
      call put_all_points(half, frame, facts, is_steered, writing)
      call put_links(half, kind, rod, is_steered, writing)
      if (is_steered) call put_rack(half, writing)
      call put_wheel(half, kind, facts, writing)
   end subroutine put_axle

   !> Turns the points to the axes of the deck. The half is written as the left half.
   subroutine turn_points(half, frame, writing, at)
      type(half_t), intent(in) :: half
      type(frame_t), intent(in) :: frame
      type(writing_t), intent(in) :: writing
      real(wp), intent(out) :: at(:, :)
      integer :: from(3), c

      from = [frame%forward, frame%outboard, frame%up]
      if (writing%is_rear) from(:2) = -from(:2)
      do c = 1, 3
         at(c, :) = sign(1, from(c))*half%at(abs(from(c)), :)*writing%factor + 0.0_wp
      end do
   end subroutine turn_points

   !> Writes the comments on the source and on the decisions.
   subroutine put_head(points, frame, kind, facts, writing)
      type(point_set_t), intent(in) :: points
      type(frame_t), intent(in) :: frame
      integer, intent(in) :: kind
      type(axle_facts_t), intent(in) :: facts
      type(writing_t), intent(inout) :: writing
      character(:), allocatable :: title

      title = trim(kinds(kind)%title)
      call writing%deck%comment('Made by elastokin import from '//writing%file//'.')
      call writing%deck%comment(title//': for kinematics without springs. The note of a point is the line of its source.')
      call writing%deck%blank()
      call writing%deck%comment('Decided:')
      call put_lines(frame%how, writing)
      if (points%is_sided .and. all(points%half(:)%has(wheel_centre))) then
         call writing%deck%comment('  both sides are given, and are mirror images; the deck has the left half')
      else if (frame%is_image) then
         call writing%deck%comment('  the right side is given; the deck has its mirror image, the left half')
      end if
      call writing%deck%comment('Assumed:')
      call writing%deck%comment('  the middle of the car is at 0 in the column '//column_name(abs(frame%outboard))//', and the '// &
         'other side is the mirror image')
      if (.not. facts%has_toe) call writing%deck%comment('  static toe 0: the source does not give it')
      if (.not. facts%has_camber) then
         if (points%half(frame%half)%has(contact_patch)) then
            call writing%deck%comment('  static camber: the contact point lies in the plane of the wheel')
         else
            call writing%deck%comment('  static camber 0: the source does not give it')
         end if
      end if
   end subroutine put_head

   subroutine put_lines(text, writing)
      character(*), intent(in) :: text
      type(writing_t), intent(inout) :: writing
      integer :: at, length

      at = 1
      do while (at <= len(text))
         length = index(text(at:), new_line('a')) - 1
         if (length < 0) length = len(text) - at + 1
         call writing%deck%comment('  '//text(at:at + length - 1))
         at = at + length + 1
      end do
   end subroutine put_lines

   !> Marks the points that the deck has.
   subroutine mark_written(half, kind, rod, is_steered, writing)
      type(half_t), intent(in) :: half
      integer, intent(in) :: kind, rod(2)
      logical, intent(in) :: is_steered
      type(writing_t), intent(inout) :: writing

      associate (needs => kinds(kind)%needs)
         writing%is_written(pack(needs, needs > 0)) = .true.
      end associate
      writing%is_written(contact_patch) = half%has(contact_patch)
      if (kinds(kind)%has_rod) writing%is_written(rod) = .true.
      if (is_steered) writing%is_written(rack_centre) = half%has(rack_centre)
      if (has_rocker(half, kind)) then
         writing%is_written([push_low, push_top, rocker_pivot, rocker_axis]) = .true.
         writing%is_written([damper_inner, damper_outer]) = all(half%has([damper_inner, damper_outer]))
      end if
   end subroutine mark_written

   !> Whether push rod and rocker are complete, with the axis of the rocker.
   pure logical function has_rocker(half, kind)
      type(half_t), intent(in) :: half
      integer, intent(in) :: kind
      has_rocker = kind == double_wishbone .and. all(half%has([push_low, push_top, rocker_pivot, rocker_axis]))
   end function has_rocker

   !> Writes what was left out.
   subroutine put_left_out(half, table, frame, writing)
      type(half_t), intent(in) :: half
      type(point_table_t), intent(in) :: table
      type(frame_t), intent(in) :: frame
      type(writing_t), intent(inout) :: writing
      integer :: k

      call writing%deck%comment('Omitted:')
      do k = 1, table%used
         associate (this => table%points(k))
            if (this%point > 0) then
               if (writing%is_written(this%point)) cycle
            end if
            if (this%side == merge(left_point, right_point, frame%half == 2)) cycle       ! its image is listed
            if (this%point == not_a_point) then
               call writing%deck%comment('  line '//str(this%line)//': '//trim(this%name)//' is not a point')
            else if (this%point == -1) then
               call writing%deck%comment('  line '//str(this%line)//': '//trim(this%name)//': name not recognised'// &
                  nearest(trim(this%name)))
            else
               call writing%deck%comment('  line '//str(this%line)//': '//trim(this%name)//why_unused(this%point, half))
            end if
         end associate
      end do
      call writing%deck%comment('  &axle (heights and shares of the car), &steering (ratio and travel of the rack), springs')
   end subroutine put_left_out

   !> Why a recognised point is not in the deck.
   pure function why_unused(point, half) result(words)
      integer, intent(in) :: point
      type(half_t), intent(in) :: half
      character(:), allocatable :: words

      words = ': springs, dampers, masses and bars are not read'
      if (point == unused_point) return
      if (any([push_low, push_top, rocker_pivot] == point) .and. .not. half%has(rocker_axis)) &
         words = ': the axis of the rocker needs a second point, rocker_axis'
   end function why_unused

   subroutine put_model(title, writing)
      character(*), intent(in) :: title
      type(writing_t), intent(inout) :: writing
      character(:), allocatable :: name
      integer :: dot

      name = writing%file
      dot = index(name, '.', back=.true.)
      if (dot > 1) name = name(:dot - 1)
      call writing%deck%blank()
      call writing%deck%begin('model')
      call writing%deck%word('name', legal_name(name))
      call writing%deck%word('title', title)
      call writing%deck%word('length', trim(writing%length))
      call writing%deck%word('force', 'N')
      call writing%deck%word('angle', 'deg')
      call writing%deck%word('axes', trim(merge('x-rear', 'iso   ', writing%is_rear)))
      call writing%deck%end()
   end subroutine put_model

   !> Writes the points, each with the line of its source.
   subroutine put_all_points(half, frame, facts, is_steered, writing)
      type(half_t), intent(inout) :: half
      type(frame_t), intent(in) :: frame
      type(axle_facts_t), intent(in) :: facts
      logical, intent(in) :: is_steered
      type(writing_t), intent(inout) :: writing
      real(wp) :: at(3)
      integer :: k

      call writing%deck%heading('hardpoints, design position')
      do k = 1, point_count
         if (.not. writing%is_written(k) .or. k == rack_centre) cycle
         call put_point(trim(point_names(k)), half%at(:, k), writing%file//':'//str(half%line(k)), writing)
         if (k == wheel_centre .and. .not. half%has(contact_patch)) then
            half%at(:, contact_patch) = contact_point(half%at(:, wheel_centre), frame%road*writing%factor, facts, writing%is_rear)
            call put_point('contact_patch', half%at(:, contact_patch), 'below the wheel centre, on the road', writing)
         end if
      end do
      if (.not. is_steered) return
      at = half%at(:, tie_inner)
      at(2) = 0.0_wp
      if (writing%is_written(rack_centre)) then
         call put_point('rack_centre', half%at(:, rack_centre), writing%file//':'//str(half%line(rack_centre)), writing)
      else
         call put_point('rack_centre', at, 'between the inner ends of the tie rods', writing)
      end if
   end subroutine put_all_points

   !> The lowest point of a wheel with static toe and camber, on the road: a point of the plane of the wheel, whose axis is
   !> (sin t cos c, cos t cos c, -sin c) forward, outboard and up.
   pure function contact_point(centre, road, facts, is_rear) result(at)
      real(wp), intent(in) :: centre(3), road
      type(axle_facts_t), intent(in) :: facts
      logical, intent(in) :: is_rear
      real(wp) :: at(3), drop

      drop = (centre(3) - road)*tan(facts%camber*degree)
      at = [-drop*sin(facts%toe*degree), -drop*cos(facts%toe*degree), 0.0_wp]
      if (is_rear) at = -at
      at = [centre(1) + at(1), centre(2) + at(2), road]
   end function contact_point

   subroutine put_point(name, at, note, writing)
      character(*), intent(in) :: name, note
      real(wp), intent(in) :: at(3)
      type(writing_t), intent(inout) :: writing

      call writing%deck%begin('point')
      call writing%deck%word('name', name)
      call writing%deck%numbers('at', at)
      call writing%deck%word('note', note)
      call writing%deck%end()
   end subroutine put_point

   !> Writes bodies and joints.
   subroutine put_links(half, kind, rod, is_steered, writing)
      type(half_t), intent(in) :: half
      integer, intent(in) :: kind, rod(2)
      logical, intent(in) :: is_steered
      type(writing_t), intent(inout) :: writing

      call writing%deck%heading('bodies and joints')
      if (kind == trailing_arm) then
         call put_body('arm', writing, origin='wheel_centre')
         call put_hinge('arm_hinge', 'arm', arm_inner, arm_outer, writing)
         return
      end if
      call put_body('carrier', writing, origin='wheel_centre')
      if (kind /= five_link) then
         call put_body('lca', writing)
         call put_hinge('lca_hinge', 'lca', lca_front, lca_rear, writing)
         call put_joint('lower_ball', 'spherical', 'lca', 'carrier', [lower_ball], writing)
      end if
      select case (kind)
      case (double_wishbone)
         call put_body('uca', writing)
         call put_hinge('uca_hinge', 'uca', uca_front, uca_rear, writing)
         call put_joint('upper_ball', 'spherical', 'uca', 'carrier', [upper_ball], writing)
         if (has_rocker(half, kind)) call put_rocker(half, writing)
      case (mcpherson)
         call put_strut(writing)
      case (five_link)
         call put_joint('upper_front_link', 'distance', 'chassis', 'carrier', [upper_front_in, upper_front_out], writing)
         call put_joint('upper_rear_link', 'distance', 'chassis', 'carrier', [upper_rear_in, upper_rear_out], writing)
         call put_joint('lower_link', 'distance', 'chassis', 'carrier', [lower_in, lower_out], writing)
         call put_joint('trailing_link', 'distance', 'chassis', 'carrier', [trailing_front, trailing_rear], writing)
      end select
      call put_joint(trim(merge('tie_rod', 'toe_rod', is_steered)), 'distance', trim(merge('rack   ', 'chassis', is_steered)), &
         'carrier', rod, writing)
   end subroutine put_links

   subroutine put_body(name, writing, origin)
      character(*), intent(in) :: name
      type(writing_t), intent(inout) :: writing
      character(*), intent(in), optional :: origin

      call writing%deck%begin('body')
      call writing%deck%word('name', name)
      if (present(origin)) call writing%deck%word('origin', origin)
      call writing%deck%end()
   end subroutine put_body

   !> Writes a joint between two bodies at one or two points.
   subroutine put_joint(name, type, first, second, at, writing)
      character(*), intent(in) :: name, type, first, second
      integer, intent(in) :: at(:)
      type(writing_t), intent(inout) :: writing

      call writing%deck%begin('joint')
      call writing%deck%word('name', name)
      call writing%deck%word('type', type)
      call writing%deck%words('bodies', first, second)
      if (size(at) == 1) then
         call writing%deck%word('at', trim(point_names(at(1))))
      else
         call writing%deck%words('at', trim(point_names(at(1))), trim(point_names(at(2))))
      end if
      call writing%deck%end()
   end subroutine put_joint

   !> Writes the hinge of an arm on the chassis.
   subroutine put_hinge(name, body, one, other, writing)
      character(*), intent(in) :: name, body
      integer, intent(in) :: one, other
      type(writing_t), intent(inout) :: writing

      call writing%deck%begin('joint')
      call writing%deck%word('name', name)
      call writing%deck%word('type', 'revolute')
      call writing%deck%words('bodies', 'chassis', body)
      call writing%deck%word('at', trim(point_names(one)))
      call writing%deck%words('axis', trim(point_names(one)), trim(point_names(other)))
      call writing%deck%end()
   end subroutine put_hinge

   !> Writes the strut of a McPherson axle: its tube is part of the carrier, its rod cannot spin in the top mount.
   subroutine put_strut(writing)
      type(writing_t), intent(inout) :: writing

      call put_body('strut', writing, origin='strut_top')
      call writing%deck%begin('joint')
      call writing%deck%word('name', 'slider')
      call writing%deck%word('type', 'cylindrical')
      call writing%deck%words('bodies', 'carrier', 'strut')
      call writing%deck%word('at', 'strut_low')
      call writing%deck%words('axis', 'strut_low', 'strut_top')
      call writing%deck%end()
      call writing%deck%begin('joint')
      call writing%deck%word('name', 'top_mount')
      call writing%deck%word('type', 'universal')
      call writing%deck%words('bodies', 'chassis', 'strut')
      call writing%deck%word('at', 'strut_top')
      call writing%deck%numbers('axis_vector', [1.0_wp, 0.0_wp, 0.0_wp])
      call writing%deck%numbers('axis_2_vector', [0.0_wp, 1.0_wp, 0.0_wp])
      call writing%deck%end()
   end subroutine put_strut

   !> Writes push rod and rocker, and the length of the damper as a measure. The rod is on the arm whose ball joint is nearer.
   subroutine put_rocker(half, writing)
      type(half_t), intent(in) :: half
      type(writing_t), intent(inout) :: writing
      logical :: is_lower

      is_lower = norm2(half%at(:, push_low) - half%at(:, lower_ball)) <= norm2(half%at(:, push_low) - half%at(:, upper_ball))
      call put_body('rocker', writing, origin='rocker_pivot')
      call put_hinge('rocker_hinge', 'rocker', rocker_pivot, rocker_axis, writing)
      call writing%deck%comment('assumed: the rod is on the arm whose ball joint is nearer')
      call put_joint('push_rod', 'distance', trim(merge('lca', 'uca', is_lower)), 'rocker', [push_low, push_top], writing)
      if (.not. writing%is_written(damper_outer)) return
      call writing%deck%begin('measure')
      call writing%deck%word('name', 'damper_length')
      call writing%deck%word('type', 'distance')
      call writing%deck%words('bodies', 'rocker', 'chassis')
      call writing%deck%words('at', 'damper_outer', 'damper_inner')
      call writing%deck%end()
   end subroutine put_rocker

   !> Writes the rack. Its travel is positive where it turns the wheels to the left.
   subroutine put_rack(half, writing)
      type(half_t), intent(in) :: half
      type(writing_t), intent(inout) :: writing
      real(wp) :: axis(3), ahead, left
      integer :: top

      top = merge(upper_ball, strut_top, half%has(upper_ball))
      axis = half%at(:, top) - half%at(:, lower_ball)
      ahead = half%at(1, tie_outer) - half%at(1, lower_ball)
      if (abs(axis(3)) > 0.0_wp) ahead = ahead - axis(1)*(half%at(3, tie_outer) - half%at(3, lower_ball))/axis(3)
      if (writing%is_rear) ahead = -ahead
      left = merge(-1.0_wp, 1.0_wp, writing%is_rear)*merge(1.0_wp, -1.0_wp, ahead > 0.0_wp)
      call writing%deck%heading('steering; rack travel is positive to the '// &
         trim(merge('left ', 'right', ahead > 0.0_wp))//', which turns the wheels to the left')
      call put_body('rack', writing)
      call writing%deck%begin('joint')
      call writing%deck%word('name', 'rack_guide')
      call writing%deck%word('type', 'translational')
      call writing%deck%words('bodies', 'chassis', 'rack')
      call writing%deck%word('at', 'rack_centre')
      call writing%deck%numbers('axis_vector', [0.0_wp, left, 0.0_wp])
      call writing%deck%end()
      call writing%deck%begin('measure')
      call writing%deck%word('name', 'rack_travel')
      call writing%deck%word('type', 'gap')
      call writing%deck%words('bodies', 'chassis', 'rack')
      call writing%deck%word('at', 'rack_centre')
      call writing%deck%numbers('axis_vector', [0.0_wp, left, 0.0_wp])
      call writing%deck%end()
      call writing%deck%begin('joint')
      call writing%deck%word('name', 'rack_drive')
      call writing%deck%word('type', 'driver')
      call writing%deck%word('measure', 'rack_travel')
      call writing%deck%end()
   end subroutine put_rack

   !> Writes the wheel and the test of parallel travel.
   subroutine put_wheel(half, kind, facts, writing)
      type(half_t), intent(in) :: half
      integer, intent(in) :: kind
      type(axle_facts_t), intent(in) :: facts
      type(writing_t), intent(inout) :: writing
      real(wp) :: arm(3), camber, radius
      integer :: top

      arm = half%at(:, contact_patch) - half%at(:, wheel_centre)
      radius = norm2(arm)
      camber = facts%camber
      ! the deck has the left half: outboard is +y in iso axes and −y in x-rear axes
      if (.not. facts%has_camber) camber = -atan2(merge(-arm(2), arm(2), writing%is_rear), -arm(3))/degree + 0.0_wp
      call writing%deck%heading('wheel, test')
      call writing%deck%begin('wheel')
      call writing%deck%word('name', 'left')
      call writing%deck%word('body', trim(merge('arm    ', 'carrier', kind == trailing_arm)))
      call writing%deck%word('side', 'left')
      call writing%deck%word('centre', 'wheel_centre')
      call writing%deck%word('contact', 'contact_patch')
      call writing%deck%number('toe', facts%toe)
      call writing%deck%number('camber', camber)
      call writing%deck%number('radius', radius)
      top = merge(upper_ball, strut_top, kind == double_wishbone)
      if (any([double_wishbone, mcpherson] == kind)) call writing%deck%words('steer_axis', trim(point_names(lower_ball)), &
         trim(point_names(top)))
      call writing%deck%end()
      call writing%deck%blank()
      call writing%deck%comment('assumed: the range, a tenth of the loaded radius')
      call writing%deck%begin('case')
      call writing%deck%word('test', 'parallel_travel')
      call writing%deck%number('from', -range_of(radius))
      call writing%deck%number('to', range_of(radius))
      call writing%deck%end()
   end subroutine put_wheel

   !> A tenth of a radius, with two digits.
   pure real(wp) function range_of(radius)
      real(wp), intent(in) :: radius
      real(wp) :: decade

      decade = 10.0_wp**(floor(log10(max(radius, 1.0e-6_wp))) - 1)
      range_of = nint(radius/decade)*decade/10.0_wp
   end function range_of

   !> Writes the points alone, as a part of a deck, if they are not those of a known kind of suspension.
   subroutine put_part(points, frame, table, writing, flaws)
      type(point_set_t), intent(in) :: points
      type(frame_t), intent(in) :: frame
      type(point_table_t), intent(in) :: table
      type(writing_t), intent(inout) :: writing
      type(flaws_t), intent(inout) :: flaws
      character(63) :: names(2*table%used)
      real(wp) :: at(3)
      integer :: k, c, from(3), used

      call writing%deck%comment('Made by elastokin import; a part of a deck: bodies, joints and elements are missing.')
      call writing%deck%comment('The points are not those of a known kind of suspension. Decided:')
      call put_lines(frame%how, writing)
      call put_model('Points of '//writing%file, writing)
      call writing%deck%blank()
      used = 0
      from = [frame%forward, merge(-frame%outboard, frame%outboard, frame%is_image), frame%up]
      if (writing%is_rear) from(:2) = -from(:2)
      do k = 1, table%used
         associate (this => table%points(k))
            if (this%point == not_a_point) cycle
            do c = 1, 3
               at(c) = sign(1, from(c))*this%at(abs(from(c)))*writing%factor + 0.0_wp
            end do
            if (this%side == left_point .or. this%side == point_pair) call put_one('left_')
            if (this%side == right_point) call put_one('right_')
            if (this%side == point_pair) at(2) = -at(2)
            if (this%side == point_pair) call put_one('right_')
            if (this%side == 0) call put_one('')
         end associate
      end do

   contains

      subroutine put_one(prefix)
         character(*), intent(in) :: prefix
         character(:), allocatable :: name

         name = prefix//legal_name(plain_name(table%points(k)%name, prefix))
         if (any(names(:used) == lower(name))) call flaws%add(table%points(k)%line, 'expected each hardpoint once, found '// &
            name//' again')
         used = used + 1
         names(used) = lower(name)
         call put_point(name, at, writing%file//':'//str(table%points(k)%line), writing)
      end subroutine put_one

   end subroutine put_part

   !> A name without the side at its beginning, which the prefix gives.
   pure function plain_name(name, prefix) result(plain)
      character(*), intent(in) :: name, prefix
      character(:), allocatable :: plain

      plain = trim(name)
      if (prefix /= '' .and. index(lower(plain), prefix) == 1 .and. len(plain) > len(prefix)) plain = plain(len(prefix) + 1:)
   end function plain_name

end module ek_point_deck
