!> &adjuster: rods with a thread, shims, slots and spring seats.
module ek_reader_adjusters
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_dimension, only: length, unit_name
   use ek_measure, only: is_of_angle
   use ek_adjuster, only: adjuster_t, place_t, align_t, is_reachable, rod_of_joint, seat
   use ek_suspension, only: of_element, of_centre, of_contact, of_body, of_mass
   use ek_blueprint, only: adjuster_plan_t, align_plan_t, vector_t, along
   use ek_group, only: joint_group, spring_group, wheel_group, adjuster_group, word_length, max_adjusted
   use ek_deck_reading, only: deck_reading_t, complain, where_of, has_key, choice, text_of, texts_of, number_of, value_count, &
      refuse, slot, unit_of, whole_of
   use ek_reference, only: look_up, find_body, find_point, find_direction, check_apart, new_vector
   implicit none(type, external)
   private
   public :: read_adjuster, read_align

   ! types, in the order of ek_choices
   integer, parameter :: rod = 1, shim = 2, slotted = 3, spring_seat = 4

contains

   !> Reads &adjuster. All parts that it moves were read before.
   subroutine read_adjuster(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(adjuster_t) :: adjuster
      type(adjuster_plan_t) :: plan
      type(place_t), allocatable :: places(:)
      real(wp) :: unit
      integer :: type

      allocate (places(0))
      call choice(reading, 'type', type)
      adjuster%name = text_of(reading, 'name')
      adjuster%where = where_of(reading)
      call check_range(reading, adjuster)
      select case (type)
      case (rod)
         if (has_key(reading, 'joint')) then
            call refuse(reading, [character(11) :: 'body', 'at', 'thread', 'spring', 'axis', 'axis_vector', 'pivot'], &
               'joint names the rod; remove one of the two')
            call find_rod(reading, adjuster)
         else
            call refuse(reading, [character(11) :: 'spring', 'axis', 'axis_vector', 'pivot'], &
               'a rod has the direction of its two points')
            call find_rod_body(reading, adjuster, plan, places)
         end if
      case (shim, slotted)
         call refuse(reading, [character(6) :: 'joint', 'spring', 'thread'], 'only a rod or a seat accepts this key')
         if (type == slotted) call refuse(reading, ['pivot'], 'only a shim turns about a pivot')
         call find_moved_points(reading, adjuster, plan, places)
      case (spring_seat)
         call refuse(reading, [character(11) :: 'joint', 'body', 'at', 'thread', 'axis', 'axis_vector', 'pivot'], &
            'a seat moves along its spring')
         call find_seat(reading, adjuster)
      end select
      if (type == 0 .or. .not. reading%cards(reading%k)%is_good) return
      call slot(reading, 'value', plan%value)
      reading%parameters%list(plan%value)%is_given = .true.      ! 0 as drawn: listed, and found by paths with *
      unit = unit_of(reading, 'value')
      adjuster%value = number_of(reading, 'value', 0.0_wp)*unit
      if (adjuster%has_pivot) then
         adjuster%along = reading%vectors(:, plan%along)
         adjuster%bolt = reading%vectors(:, plan%bolt)
         adjuster%pivot = reading%vectors(:, plan%pivot)
         if (.not. is_reachable(adjuster)) call complain(reading, 'pivot', 'pivot: no position of the parts about '// &
            quoted(text_of(reading, 'pivot'))//' gives a shim of '//str(adjuster%value/unit)//' '//unit_name(length, reading%units))
      end if
      associate (model => reading%plan%prototype)
         reading%plan%adjusters = [reading%plan%adjusters, plan]
         model%adjusters = [model%adjusters, adjuster]
         reading%cards(reading%k)%index = size(model%adjusters)
         places%adjuster = size(model%adjusters)
         model%places = [model%places, places]
      end associate
   end subroutine read_adjuster

   !> Reads &align: static angles of a wheel, and one adjuster for each of them.
   subroutine read_align(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(align_t) :: align
      type(align_plan_t) :: plan
      character(word_length) :: names(2)
      integer :: j, k, found

      align%where = where_of(reading)
      call look_up(reading, 'wheel', wheel_group, text_of(reading, 'wheel'), found)
      if (found > 0) align%wheel = reading%cards(found)%index
      align%has_toe = has_key(reading, 'toe')
      align%has_camber = has_key(reading, 'camber')
      align%angles = count([align%has_toe, align%has_camber])
      if (align%angles == 0 .and. reading%cards(reading%k)%is_good) &
         call complain(reading, '', "give 'toe', 'camber' or both, the angles that the wheel must have")
      names = texts_of(reading, 'with', 2)
      if (value_count(reading, 'with') /= align%angles .and. reading%cards(reading%k)%is_good) then
         call complain(reading, 'with', 'with: '//str(align%angles)//' angles need as many adjusters, found '// &
            str(value_count(reading, 'with')))
         return
      end if
      do k = 1, min(value_count(reading, 'with'), 2)
         call look_up(reading, 'with', adjuster_group, trim(names(k)), found)
         if (found == 0) cycle
         if (.not. reading%cards(found)%is_good) reading%cards(reading%k)%is_good = .false.
         align%adjusters(k) = reading%cards(found)%index
         if (any([(any(reading%plan%prototype%aligns(j)%adjusters == align%adjusters(k)), &
            j=1, size(reading%plan%prototype%aligns))]) .or. any(align%adjusters(:k - 1) == align%adjusters(k))) &
            call complain(reading, 'with', 'with: the adjuster '//quoted(names(k))//' is named twice; each angle needs its own')
      end do
      if (.not. reading%cards(reading%k)%is_good .or. align%wheel == 0) return
      call slot(reading, 'toe', plan%toe)
      call slot(reading, 'camber', plan%camber)
      reading%plan%aligns = [reading%plan%aligns, plan]
      reading%plan%prototype%aligns = [reading%plan%prototype%aligns, align]
   end subroutine read_align

   !> Reads the range, and checks that it contains 0 and the value.
   subroutine check_range(reading, adjuster)
      type(deck_reading_t), intent(inout) :: reading
      type(adjuster_t), intent(inout) :: adjuster
      character(:), allocatable :: unit
      real(wp) :: value, low, high

      unit = ' '//unit_name(length, reading%units)
      low = number_of(reading, 'range', 0.0_wp, 1)
      high = number_of(reading, 'range', 0.0_wp, 2)
      adjuster%low = low*unit_of(reading, 'range')
      adjuster%high = high*unit_of(reading, 'range')
      if (.not. reading%cards(reading%k)%is_good) return
      if (.not. (low <= 0.0_wp .and. high >= 0.0_wp .and. low < high)) then
         call complain(reading, 'range', 'range must be a low and a high value with 0, the drawn position, between them, found '// &
            str(low)//' and '//str(high)//unit)
         return
      end if
      value = number_of(reading, 'value', 0.0_wp)
      if (value < low .or. value > high) call complain(reading, 'value', 'value = '//str(value)//unit// &
         ' is outside the range '//str(low)//' to '//str(high)//unit//' of the adjuster')
   end subroutine check_range

   !> Finds the row of the distance joint that is a rod.
   subroutine find_rod(reading, adjuster)
      type(deck_reading_t), intent(inout) :: reading
      type(adjuster_t), intent(inout) :: adjuster
      character(:), allocatable :: name
      integer :: found, k

      name = text_of(reading, 'joint')
      call look_up(reading, 'joint', joint_group, name, found)
      if (found == 0) return
      adjuster%kind = rod_of_joint
      if (.not. reading%cards(found)%is_good) reading%cards(reading%k)%is_good = .false.
      if (.not. reading%cards(reading%k)%is_good) return
      associate (joints => reading%plan%prototype%joints)
         do k = 1, size(joints)
            if (joints(k)%name == name) exit
         end do
         if (joints(k)%kind /= 'distance') then
            call complain(reading, 'joint', 'joint: '//quoted(name)//' is a '//joints(k)%kind// &
               " joint; a rod is a joint of type 'distance', or a body with two points (body, at)")
            return
         end if
         adjuster%row = joints(k)%first_row
      end associate
   end subroutine find_rod

   !> Finds the two points of a body that is a rod. The second point moves away from the first one; with two threads both move.
   subroutine find_rod_body(reading, adjuster, plan, places)
      type(deck_reading_t), intent(inout) :: reading
      type(adjuster_t), intent(inout) :: adjuster
      type(adjuster_plan_t), intent(inout) :: plan
      type(place_t), allocatable, intent(inout) :: places(:)
      type(vector_t) :: vector
      integer :: ends(2), threads
      logical :: is_apart

      if (.not. has_key(reading, 'body')) then
         if (reading%cards(reading%k)%is_good) call complain(reading, '', &
            "give 'joint', a distance joint, or 'body' and 'at', a body and its two points")
         return
      end if
      if (has_key(reading, 'at') .and. value_count(reading, 'at') /= 2) then
         call complain(reading, 'at', 'at: a rod has two points, found '//str(value_count(reading, 'at'))// &
            '; the second one moves away from the first one')
         return
      end if
      call find_points_of_body(reading, adjuster, ends)
      if (.not. reading%cards(reading%k)%is_good) return
      call check_apart(reading, 'at', ends, '', is_apart)
      if (.not. is_apart) return
      threads = whole_of(reading, 'thread', 1)
      if (threads /= 1 .and. threads /= 2) call complain(reading, 'thread', &
         'thread must be 1, at the second point, or 2, at both, found '//str(threads))
      vector%kind = along
      vector%a = ends(1)
      vector%b = ends(2)
      call new_vector(reading, vector, plan%along)
      if (threads == 2) call add_places(reading, adjuster, 'at', ends(1), -0.5_wp, places)
      call add_places(reading, adjuster, 'at', ends(2), merge(0.5_wp, 1.0_wp, threads == 2), places)
   end subroutine find_rod_body

   !> Finds the points that a shim or a slot moves, with the direction, and the pivot of a shim.
   subroutine find_moved_points(reading, adjuster, plan, places)
      type(deck_reading_t), intent(inout) :: reading
      type(adjuster_t), intent(inout) :: adjuster
      type(adjuster_plan_t), intent(inout) :: plan
      type(place_t), allocatable, intent(inout) :: places(:)
      integer, allocatable :: points(:)
      logical :: has_direction, is_good
      integer :: k

      if (.not. (has_key(reading, 'body') .and. has_key(reading, 'at'))) then
         if (reading%cards(reading%k)%is_good) call complain(reading, '', &
            "give 'body' and 'at', the points of this body that move")
         return
      end if
      call find_direction(reading, 'axis', 'axis_vector', plan%along, has_direction, is_good)
      if (.not. has_direction) call complain(reading, '', "give 'axis' or 'axis_vector', the direction of the displacement")
      allocate (points(value_count(reading, 'at')))
      call find_points_of_body(reading, adjuster, points)
      adjuster%has_pivot = has_key(reading, 'pivot')
      if (adjuster%has_pivot) call find_point(reading, 'pivot', text_of(reading, 'pivot'), plan%pivot, is_good)
      if (.not. reading%cards(reading%k)%is_good) return
      plan%bolt = points(1)
      do k = 1, size(points)
         call add_places(reading, adjuster, 'at', points(k), 1.0_wp, places)
      end do
   end subroutine find_moved_points

   !> Finds the body of an adjuster, and points of the key `at`.
   subroutine find_points_of_body(reading, adjuster, points)
      type(deck_reading_t), intent(inout) :: reading
      type(adjuster_t), intent(inout) :: adjuster
      integer, intent(out) :: points(:)      !! indices of the vectors
      character(word_length) :: names(max_adjusted)
      logical :: is_found
      integer :: k

      points = 0
      call find_body(reading, 'body', text_of(reading, 'body'), adjuster%body, is_found)
      names = texts_of(reading, 'at', max_adjusted)
      do k = 1, size(points)
         call find_point(reading, 'at', trim(names(k)), points(k), is_found)
         if (.not. is_found) reading%cards(reading%k)%is_good = .false.
      end do
   end subroutine find_points_of_body

   !> Finds the spring whose seat moves.
   subroutine find_seat(reading, adjuster)
      type(deck_reading_t), intent(inout) :: reading
      type(adjuster_t), intent(inout) :: adjuster
      character(:), allocatable :: name
      integer :: found, k

      name = text_of(reading, 'spring')
      if (name == '') then
         if (reading%cards(reading%k)%is_good) call complain(reading, '', "'spring' is missing: the spring on the seat")
         return
      end if
      call look_up(reading, 'spring', spring_group, name, found)
      if (found == 0) return
      adjuster%kind = seat
      if (.not. reading%cards(found)%is_good) reading%cards(reading%k)%is_good = .false.
      associate (elements => reading%plan%prototype%elements)
         do k = 1, size(elements)
            if (elements(k)%name == name) exit
         end do
         if (k > size(elements)) return
         adjuster%element = k
         if (is_of_angle(elements(k)%measure%kind)) &
            call complain(reading, 'spring', 'spring: '//quoted(name)//' acts on an angle; a seat moves along a length')
      end associate
   end subroutine find_seat

   !> Adds all markers at a point of the body of an adjuster. A point without a marker is reported. With the centre of a wheel with
   !> a crown, its contact point moves, and with it the loads and measures there. Centres of gravity stay.
   recursive subroutine add_places(reading, adjuster, key, point, share, places)
      type(deck_reading_t), intent(inout) :: reading
      type(adjuster_t), intent(in) :: adjuster
      character(*), intent(in) :: key
      integer, intent(in) :: point              !! index of the vector
      real(wp), intent(in) :: share
      type(place_t), allocatable, intent(inout) :: places(:)
      integer :: before, k

      before = size(places)
      do k = 1, size(reading%plan%prototype%markers)
         associate (this => reading%plan%prototype%markers(k), model => reading%plan%prototype)
            if (this%body /= adjuster%body .or. this%point /= point .or. any(this%part == [of_body, of_mass])) cycle
            if (this%only_turns .and. .not. adjuster%has_pivot) cycle
            if (adjuster%has_pivot .and. any(this%part == [of_centre, of_contact])) then
               call complain(reading, key, key//': a wheel cannot turn about the pivot against its own body; let the points of '// &
                  'the suspension on this body turn instead')
               return
            end if
            if (adjuster%has_pivot .and. this%part == of_element .and. this%index > model%scalars .and. this%side == 1) &
               call complain(reading, 'pivot', 'pivot: the bushing '//quoted(model%elements(this%index)%name)// &
               ' has its axes on the body that turns; exchange its two bodies')
            places = [places, place_t(0, k, share)]
            if (this%part /= of_centre) cycle
            if (model%wheels(this%index)%has_crown) &
               call add_places(reading, adjuster, key, reading%plan%wheels(this%index)%contact, share, places)
         end associate
      end do
      if (size(places) == before .and. reading%cards(reading%k)%is_good) call complain(reading, key, key// &
         ': no joint, spring or bushing of the body '//quoted(text_of(reading, 'body'))//' is at a point that the adjuster moves')
   end subroutine add_places

end module ek_reader_adjusters
