!> The deck of an axle made from its points, and from the springs and bushings of its file. Without springs it is a deck of points
!> and links, as `elastokin new KIND --points-only` prints. Every number has the line of its source as a note. Comments at the
!> beginning list what was decided, assumed and omitted.
module ek_point_deck
   use ek_kinds, only: wp, degree
   use ek_text, only: str, lower
   use ek_flaws, only: flaws_t
   use ek_fields, only: legal_name
   use ek_hardpoint, only: left_point, right_point, point_pair
   use ek_point_name, only: point_count, point_names, unused_point, wheel_centre, contact_patch, lower_ball, upper_ball, &
      tie_inner, tie_outer, toe_inner, toe_outer, strut_top, push_low, push_top, rocker_pivot, rocker_axis, rack_centre, &
      damper_inner, damper_outer, damper_top, damper_low, spring_top, spring_low, kingpin_low, kingpin_top, &
      panhard_chassis, panhard_axle, triangle_chassis, triangle_axle
   use ek_point_kind, only: kinds, double_wishbone, mcpherson, trailing_arm, lateral_arm, by_links, by_triangle, is_solid, &
      has_knuckles, find_kind, incomplete, check_rod, check_ends, nearest_text
   use ek_point_table, only: point_table_t, not_a_point
   use ek_point_set, only: choose_points
   use ek_frame_votes, only: point_set_t, half_t, wish_t, frame_t, find_frame
   use ek_vote, only: column_name, length_names, length_values
   use ek_axle_facts, only: axle_facts_t, rod_slot
   use ek_deck_parts, only: writing_t, put_point
   use ek_link_deck, only: put_links, put_rack, has_rocker
   use ek_solid_deck, only: put_solid_axle, put_shared, put_middle_points
   use ek_elastic_deck, only: put_springs, has_springs
   use ek_car_deck, only: put_car, missing_groups, unused_numbers
   implicit none(type, external)
   private
   public :: put_points

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
      if (kind > 0) call check_ends(points%half(frame%half), frame%forward, kind, flaws)
      if (flaws%count() > 0) return
      writing%file = path(index(path, '/', back=.true.) + 1:)
      writing%is_rear = frame%forward == -1
      call choose_unit(frame%length, writing)
      if (kind > 0) then
         call put_axle(points, frame, kind, facts, table, writing)
      else
         call put_part(frame, table, writing, flaws)
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
      writing%metre = writing%factor/length_values(length)
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
      character(:), allocatable :: rod_name

      half = points%half(frame%half)
      half%at = 0.0_wp
      call turn_points(points%half(frame%half), frame, writing, half%at)
      is_steered = points%axle == 1 .and. kinds(kind)%has_rod
      rod = [tie_inner, tie_outer]
      if (.not. all(half%has(rod))) rod = [toe_inner, toe_outer]
      is_steered = is_steered .and. rod(1) == tie_inner
      rod_name = ''
      if (kinds(kind)%has_rod .and. .not. facts%bushings(rod_slot)%is_given) rod_name = trim(merge('tie_rod', 'toe_rod', &
         is_steered))
      call put_head(points, frame, kind, facts, is_steered, writing)
      call mark_written(half, kind, rod, is_steered, facts, writing)
      call put_left_out(half, table, frame, facts, writing)
      call put_other_groups(table, points%axle, is_steered, rod_name, has_springs(facts), writing)
      call put_model(title_of(kind, facts), writing)
      call writing%deck%blank()
      call writing%deck%begin('mirror')
      if (is_steered) call writing%deck%word('shared', 'rack')
      if (is_solid(kind)) call put_shared(kind, writing)
      call writing%deck%end()
      call put_all_points(half, kind, frame, facts, is_steered, writing)
      call writing%deck%heading('bodies and joints')
      if (is_solid(kind)) call put_solid_axle(kind, half, writing)
      if (.not. is_solid(kind)) call put_links(half, kind, rod, is_steered, facts, writing)
      if (is_steered) call put_rack(half, writing)
      call put_springs(half%at, facts, writing)
      call put_wheel(half, kind, facts, writing)
      call put_car(table%numbers, points%axle, is_steered, rod_name, writing)
   end subroutine put_axle

   !> The title of the deck.
   pure function title_of(kind, facts) result(title)
      integer, intent(in) :: kind
      type(axle_facts_t), intent(in) :: facts
      character(:), allocatable :: title

      title = trim(kinds(kind)%title)
      if (.not. has_springs(facts)) title = title//', points and links'
   end function title_of

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
   subroutine put_head(points, frame, kind, facts, is_steered, writing)
      type(point_set_t), intent(in) :: points
      type(frame_t), intent(in) :: frame
      integer, intent(in) :: kind
      type(axle_facts_t), intent(in) :: facts
      logical, intent(in) :: is_steered
      type(writing_t), intent(inout) :: writing
      integer :: k

      call writing%deck%comment('Made by elastokin import from '//writing%file//'.')
      if (has_springs(facts)) then
         call writing%deck%comment(title_of(kind, facts)//', with springs. The note of a number is the line of its source.')
      else
         call writing%deck%comment(title_of(kind, facts)//': for kinematics without springs. The note of a point is the line '// &
            'of its source.')
      end if
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
      if (is_steered) call writing%deck%comment('  the tie rods end on a rack, which moves along y')
      do k = 1, facts%assumed%count()
         call writing%deck%comment('  '//facts%assumed%line(k))
      end do
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
   subroutine mark_written(half, kind, rod, is_steered, facts, writing)
      type(half_t), intent(in) :: half
      integer, intent(in) :: kind, rod(2)
      logical, intent(in) :: is_steered
      type(axle_facts_t), intent(in) :: facts
      type(writing_t), intent(inout) :: writing
      integer :: k

      associate (needs => kinds(kind)%needs)
         writing%is_written(pack(needs, needs > 0)) = .true.
      end associate
      writing%is_written(contact_patch) = half%has(contact_patch)
      if (kinds(kind)%guide == by_links) writing%is_written([panhard_chassis, panhard_axle]) = &
         half%has([panhard_chassis, panhard_axle])
      if (kinds(kind)%has_rod) writing%is_written(rod) = .true.
      if (is_steered) writing%is_written(rack_centre) = half%has(rack_centre)
      if (has_rocker(half, kind)) then
         writing%is_written([push_low, push_top, rocker_pivot, rocker_axis]) = .true.
         writing%is_written([damper_inner, damper_outer]) = all(half%has([damper_inner, damper_outer]))
      end if
      do k = 1, size(facts%springs)
         if (facts%springs(k)%is_given) writing%is_written([facts%springs(k)%top, facts%springs(k)%low]) = .true.
      end do
   end subroutine mark_written

   !> Writes what was left out.
   subroutine put_left_out(half, table, frame, facts, writing)
      type(half_t), intent(in) :: half
      type(point_table_t), intent(in) :: table
      type(frame_t), intent(in) :: frame
      type(axle_facts_t), intent(in) :: facts
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
                  nearest_text(trim(this%name)))
            else
               call writing%deck%comment('  line '//str(this%line)//': '//trim(this%name)//why_unused(this%point, half))
            end if
         end associate
      end do
      do k = 1, facts%omitted%count()
         call writing%deck%comment('  '//facts%omitted%line(k))
      end do
   end subroutine put_left_out

   !> Writes the numbers of the car that are not in the deck, and the groups that are missing.
   subroutine put_other_groups(table, axle, is_steered, rod, has_spring, writing)
      type(point_table_t), intent(in) :: table
      integer, intent(in) :: axle
      logical, intent(in) :: is_steered, has_spring
      character(*), intent(in) :: rod
      type(writing_t), intent(inout) :: writing
      character(:), allocatable :: why
      integer :: k

      do k = 1, table%numbers%used
         if (table%numbers%list(k)%axle > 0 .and. table%numbers%list(k)%axle /= axle) cycle
         why = unused_numbers(table%numbers, k, axle, is_steered, rod)
         if (why /= '') call writing%deck%comment('  '//why)
      end do
      call writing%deck%comment('  '//missing_groups(table%numbers, axle, is_steered)// &
         trim(merge('tyre_rate', 'springs  ', has_spring)))
   end subroutine put_other_groups

   !> Why a recognised point is not in the deck.
   pure function why_unused(point, half) result(words)
      integer, intent(in) :: point
      type(half_t), intent(in) :: half
      character(:), allocatable :: words

      if (any([unused_point, damper_top, damper_low, damper_inner, damper_outer, spring_top, spring_low] == point)) then
         words = ': springs, dampers, masses and bars are not read'
      else if (any([push_low, push_top, rocker_pivot] == point) .and. .not. half%has(rocker_axis)) then
         words = ': the axis of the rocker needs a second point, rocker_axis'
      else
         words = ': not a point of this kind of suspension'
      end if
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
   subroutine put_all_points(half, kind, frame, facts, is_steered, writing)
      type(half_t), intent(inout) :: half
      integer, intent(in) :: kind
      type(frame_t), intent(in) :: frame
      type(axle_facts_t), intent(in) :: facts
      logical, intent(in) :: is_steered
      type(writing_t), intent(inout) :: writing
      real(wp) :: at(3)
      integer :: k

      call writing%deck%heading('hardpoints, design position')
      do k = 1, point_count
         if (.not. writing%is_written(k) .or. k == rack_centre) cycle
         if (kinds(kind)%guide == by_triangle .and. any([triangle_chassis, triangle_axle] == k)) cycle
         call put_point(trim(point_names(k)), half%at(:, k), writing%file//':'//str(half%line(k)), writing)
         if (k == wheel_centre .and. .not. half%has(contact_patch)) then
            half%at(:, contact_patch) = contact_point(half%at(:, wheel_centre), frame%road*writing%factor, facts, writing%is_rear)
            call put_point('contact_patch', half%at(:, contact_patch), 'below the wheel centre, on the road', writing)
         end if
      end do
      if (is_solid(kind)) call put_middle_points(half, kind, writing)
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

   !> Writes the wheel and the test of parallel travel.
   subroutine put_wheel(half, kind, facts, writing)
      type(half_t), intent(in) :: half
      integer, intent(in) :: kind
      type(axle_facts_t), intent(in) :: facts
      type(writing_t), intent(inout) :: writing
      real(wp) :: arm(3), camber, radius

      arm = half%at(:, contact_patch) - half%at(:, wheel_centre)
      radius = norm2(arm)
      camber = facts%camber
      ! the deck has the left half: outboard is +y in iso axes and −y in x-rear axes
      if (.not. facts%has_camber) camber = -atan2(merge(-arm(2), arm(2), writing%is_rear), -arm(3))/degree + 0.0_wp
      call writing%deck%heading('wheel, test')
      call writing%deck%begin('wheel')
      call writing%deck%word('name', 'left')
      call writing%deck%word('body', wheel_body(kind))
      call writing%deck%word('side', 'left')
      call writing%deck%word('centre', 'wheel_centre')
      call writing%deck%word('contact', 'contact_patch')
      call writing%deck%number('toe', facts%toe)
      call writing%deck%number('camber', camber)
      call writing%deck%number('radius', radius)
      select case (kind)
      case (double_wishbone)
         call writing%deck%words('steer_axis', trim(point_names(lower_ball)), trim(point_names(upper_ball)))
      case (mcpherson)
         call writing%deck%words('steer_axis', trim(point_names(lower_ball)), trim(point_names(strut_top)))
      end select
      if (has_knuckles(kind)) call writing%deck%words('steer_axis', trim(point_names(kingpin_low)), trim(point_names(kingpin_top)))
      if (facts%has_toe .or. facts%has_camber) call writing%deck%word('note', angle_note(facts, writing%file))
      call writing%deck%end()
      call writing%deck%blank()
      call writing%deck%comment('assumed: the range, a tenth of the loaded radius')
      call writing%deck%begin('case')
      call writing%deck%word('test', 'parallel_travel')
      call writing%deck%number('from', -range_of(radius))
      call writing%deck%number('to', range_of(radius))
      call writing%deck%end()
   end subroutine put_wheel

   !> The lines of the static angles that the file gives.
   pure function angle_note(facts, file) result(note)
      type(axle_facts_t), intent(in) :: facts
      character(*), intent(in) :: file
      character(:), allocatable :: note

      note = file//':'
      if (facts%has_toe) note = note//str(facts%toe_line)
      if (facts%has_toe .and. facts%has_camber) note = note//', '
      if (facts%has_camber) note = note//str(facts%camber_line)
   end function angle_note

   !> The body with the wheel.
   pure function wheel_body(kind) result(body)
      integer, intent(in) :: kind
      character(:), allocatable :: body

      body = 'carrier'
      if (any([trailing_arm, lateral_arm] == kind)) body = 'arm'
      if (is_solid(kind) .and. .not. has_knuckles(kind)) body = 'axle'
   end function wheel_body

   !> A tenth of a radius, with two digits.
   pure real(wp) function range_of(radius)
      real(wp), intent(in) :: radius
      real(wp) :: decade

      decade = 10.0_wp**(floor(log10(max(radius, 1.0e-6_wp))) - 1)
      range_of = nint(radius/decade)*decade/10.0_wp
   end function range_of

   !> Writes the points alone, as a part of a deck, if they are not those of a known kind of suspension.
   subroutine put_part(frame, table, writing, flaws)
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
