!> &measure and &joint: quantities that are constrained, driven, coupled or read out.
module ek_reader_joints
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_rotation, only: angle_between
   use ek_dimension, only: unit_size, pure_number, length, angle, force, moment
   use ek_measure, only: axis_axis, body_gap, global_gap, distance, rotation, contact_gap, is_of_angle
   use ek_joint, only: term_t, joint_geometry_t, joint_terms, joint_kinds, joint_table, joint_kind_t, axes_fit, max_terms, &
      no_axis, one_or_two, two_axes, either_axis, right_angle, no_angle, not_opposed, rod_part
   use ek_suspension, only: readout_t, body_name
   use ek_assembly, only: append_joint
   use ek_blueprint, only: vector_t, readout_plan_t, joint_plan_t, across, upright
   use ek_group, only: measure_group, word_length, max_measures
   use ek_deck_reading, only: deck_reading_t, complain, where_of, has_key, choice, text_of, texts_of, switch_of, value_count, &
      refuse, slot
   use ek_reader_ratings, only: rating_t, read_rating, add_tilts
   use ek_reference, only: look_up, find_place, find_bodies, find_direction, find_ends, check_apart, new_vector
   implicit none(type, external)
   private
   public :: read_measure, read_joint

   integer, parameter :: measure_kinds(5) = [axis_axis, body_gap, global_gap, distance, rotation]      !! in the order of ek_choices

contains

   !> Reads &measure: a named scalar between two bodies.
   subroutine read_measure(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(readout_t) :: readout
      type(readout_plan_t) :: plan
      character(:), allocatable :: type
      logical :: has_points, has_u, has_v, is_set
      integer :: kind, number(2)

      type = text_of(reading, 'type')
      call choice(reading, 'type', kind)
      call find_bodies(reading, number)
      call find_places(reading, plan%ends, readout%wheel, has_points)
      call find_direction(reading, 'axis', 'axis_vector', plan%u, has_u, is_set)
      call find_direction(reading, 'axis_2', 'axis_2_vector', plan%v, has_v, is_set)
      if (kind == 0) return
      kind = measure_kinds(kind)

      select case (kind)
      case (distance, body_gap, global_gap)
         if (.not. has_key(reading, 'at')) call complain(reading, '', "'at' is missing")
         reading%cards(reading%k)%deflection = length
      case default
         call refuse(reading, ['at'], 'a measure of type '//quoted(type)//' does not accept points')
         reading%cards(reading%k)%deflection = merge(angle, pure_number, kind == rotation)
      end select
      reading%cards(reading%k)%reaction = merge(moment, force, is_of_angle(kind))
      if (kind == distance) then
         call need_two_points(reading, plan%ends, has_points, 'a distance')
         call refuse(reading, ['axis       ', 'axis_vector'], 'a distance does not accept an axis')
      else if (.not. has_u) then
         call complain(reading, '', "give 'axis' or 'axis_vector'")
      end if
      if (kind /= axis_axis) then
         call refuse(reading, ['axis_2       ', 'axis_2_vector'], 'only a measure of type '//quoted('axes')//' takes a second axis')
      else if (.not. has_v) then
         call complain(reading, '', "give 'axis_2' or 'axis_2_vector'")
      end if

      if (readout%wheel > 0) call check_contact(reading, kind, number, readout%wheel)

      plan%u = max(plan%u, upright)
      plan%v = max(plan%v, upright)
      readout%name = text_of(reading, 'name')
      readout%where = where_of(reading)
      readout%measure%kind = merge(contact_gap, kind, readout%wheel > 0)
      readout%measure%body_i = number(1)
      readout%measure%body_j = number(2)
      reading%plan%readouts = [reading%plan%readouts, plan]
      reading%cards(reading%k)%index = size(reading%plan%readouts)
      reading%plan%prototype%readouts = [reading%plan%prototype%readouts, readout]
   end subroutine read_measure

   !> Finds the points of a measure. The second point, or the only one, may be the contact point of a wheel.
   subroutine find_places(reading, ends, wheel, is_found)
      type(deck_reading_t), intent(inout) :: reading
      integer, intent(out) :: ends(2)              !! indices of the vectors
      integer, intent(out) :: wheel                !! index of the wheel whose contact point moves in its carrier; 0: none
      logical, intent(out) :: is_found
      character(word_length) :: at(2)
      logical :: is_first
      integer :: last, other

      at = texts_of(reading, 'at', 2)
      last = merge(1, 2, at(2) == '')
      is_first = .true.
      other = 0
      if (last == 2) call find_place(reading, trim(at(1)), ends(1), other, is_first)
      call find_place(reading, trim(at(last)), ends(2), wheel, is_found)
      if (last == 1) ends(1) = ends(2)
      is_found = is_found .and. is_first
      if (other > 0) call complain(reading, 'at', 'at: the contact point '//quoted(at(1))//' moves in its carrier; give it last')
   end subroutine find_places

   !> Reports a measure that cannot have the contact point of a wheel.
   subroutine check_contact(reading, kind, bodies, wheel)
      type(deck_reading_t), intent(inout) :: reading
      integer, intent(in) :: kind, bodies(2), wheel

      associate (model => reading%plan%prototype)
         if (any(kind == [body_gap, global_gap]) .and. bodies(1) == 0 .and. bodies(2) == model%wheels(wheel)%body) return
         call complain(reading, 'at', 'at: the contact point of wheel '//quoted(model%wheels(wheel)%name)// &
            ' moves in its carrier; a measure at this point has the type '//quoted('global_gap')//' and bodies = '// &
            quoted('chassis')//', '//quoted(body_name(model, model%wheels(wheel)%body)))
      end associate
   end subroutine check_contact

   !> Reads &joint: a driver, a coupler, or a joint defined by points and axes.
   subroutine read_joint(reading)
      type(deck_reading_t), intent(inout) :: reading
      integer :: number, bodies(2)

      call choice(reading, 'type', number)
      if (number == 0) then
         ! bodies of a joint of unknown type count as attached: no second message about them
         call find_bodies(reading, bodies)
         return
      end if
      call check_keys(reading, joint_table(number))
      select case (joint_kinds(number))
      case ('driver')
         call make_driver(reading)
      case ('coupler')
         call make_coupler(reading)
      case default
         call make_joint(reading, joint_table(number))
      end select
   end subroutine read_joint

   !> Builds a joint that is defined by points and axes.
   subroutine make_joint(reading, kind)
      type(deck_reading_t), intent(inout) :: reading
      type(joint_kind_t), intent(in) :: kind
      type(joint_geometry_t) :: geometry
      type(joint_plan_t) :: plan
      type(rating_t) :: rating
      type(term_t) :: terms(max_terms)
      integer :: terms_of_row(max_terms), rows, numbers(2)
      logical :: has_bodies, has_points, has_u, has_v, is_u, is_v

      call find_bodies(reading, numbers, has_bodies)
      call find_ends(reading, .true., plan%ends, has_points)
      if (kind%min_points == 2) then
         call need_two_points(reading, plan%ends, has_points, 'a '//trim(kind%name)//' joint')
      else if (kind%max_points == 1 .and. value_count(reading, 'at') > 1) then
         call complain(reading, 'at', 'at: a '//trim(kind%name)//' joint has one point, found two')
      end if
      call find_direction(reading, 'axis', 'axis_vector', plan%axes(1), has_u, is_u)
      call find_direction(reading, 'axis_2', 'axis_2_vector', plan%axes(2), has_v, is_v)
      if (is_u .and. is_v) call check_axes(reading, kind%angle, plan%axes)
      if (has_stud(kind)) call read_rating(reading, merge(2, 1, kind%part == rod_part), kind%part /= rod_part, rating)
      if (.not. reading%cards(reading%k)%is_good .or. .not. has_bodies) return
      if (kind%axes == either_axis) then
         if (.not. has_v) call new_vector(reading, vector_t(kind=across, a=plan%axes(1)), plan%axes(2))
         if (.not. has_u) call new_vector(reading, vector_t(kind=across, a=plan%axes(2)), plan%axes(1))
      else
         plan%axes(1) = max(plan%axes(1), upright)
         if (.not. has_v) plan%axes(2) = plan%axes(1)
      end if
      reading%plan%joints = [reading%plan%joints, plan]
      geometry%body_i = numbers(1)
      geometry%body_j = numbers(2)
      call joint_terms(trim(kind%name), geometry, terms, terms_of_row, rows)      ! their numbers are set by `realise`
      associate (model => reading%plan%prototype)
         call append_joint(model, text_of(reading, 'name'), where_of(reading), trim(kind%name), &
            terms(:sum(terms_of_row(:rows))), terms_of_row(:rows))
         if (kind%axes == either_axis .and. .not. has_u) model%joints(size(model%joints))%chosen_axis = 1
         if (kind%axes == either_axis .and. .not. has_v) model%joints(size(model%joints))%chosen_axis = 2
         call add_tilts(reading, rating, size(model%joints), 0)
      end associate
   end subroutine make_joint

   !> Reports axes that do not suit the joint.
   subroutine check_axes(reading, needed, axes)
      type(deck_reading_t), intent(inout) :: reading
      integer, intent(in) :: needed        !! required angle, as in joint_table
      integer, intent(in) :: axes(2)       !! indices of the vectors
      real(wp) :: angle

      if (axes_fit(needed, reading%vectors(:, axes(1)), reading%vectors(:, axes(2)))) return
      angle = angle_between(reading%vectors(:, axes(1)), reading%vectors(:, axes(2)))
      select case (needed)
      case (right_angle)
         call complain(reading, '', 'axis and axis_2 must be at 90 deg to each other, found '//str(angle)//' deg')
      case (no_angle)
         call complain(reading, '', 'axis and axis_2 must be parallel, found '//str(angle)//' deg between them')
      case (not_opposed)
         call complain(reading, '', 'axis and axis_2 point in opposite directions; reverse one of them')
      end select
   end subroutine check_axes

   !> Builds a driver. The stiffness is force/length, or moment/angle if the measure is an angle.
   subroutine make_driver(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(joint_plan_t) :: plan
      integer :: found, readout

      call look_up(reading, 'measure', measure_group, text_of(reading, 'measure'), found)
      if (found == 0) return
      reading%cards(reading%k)%deflection = reading%cards(found)%deflection
      reading%cards(reading%k)%reaction = reading%cards(found)%reaction
      readout = reading%cards(found)%index
      if (.not. reading%cards(reading%k)%is_good .or. readout == 0) return
      plan%readouts = [readout]
      plan%units = [unit_size(reading%cards(found)%deflection, reading%units)]
      if (.not. has_key(reading, 'stiffness')) call refuse(reading, ['balance'], 'only a driver with a stiffness accepts this key')
      associate (model => reading%plan%prototype)
         call slot(reading, 'stiffness', plan%stiffness)
         call append_measures(reading, 'driver', plan%readouts)
         model%joints(size(model%joints))%says_balance = has_key(reading, 'balance')
         model%joints(size(model%joints))%is_balanced = switch_of(reading, 'balance', .true.)
      end associate
      reading%plan%joints = [reading%plan%joints, plan]
   end subroutine make_driver

   !> Builds a coupler, which constrains Σ ratio × value in deck units. `realise` scales the row so that the first ratio is
   !> unchanged.
   subroutine make_coupler(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(joint_plan_t) :: plan
      character(word_length) :: measures(max_measures)
      integer :: found(max_measures), given, first, j

      measures = texts_of(reading, 'measures', max_measures)
      given = count(measures /= '')
      if (given == 0) return
      do j = 1, given
         call look_up(reading, 'measures', measure_group, trim(measures(j)), found(j))
      end do
      if (.not. reading%cards(reading%k)%is_good) return
      if (value_count(reading, 'ratios') /= given) call complain(reading, 'ratios', 'ratios needs one value for each of the '// &
         str(given)//' measures, found '//str(value_count(reading, 'ratios')))
      if (.not. reading%cards(reading%k)%is_good .or. any(found(:given) == 0)) return
      plan%readouts = reading%cards(found(:given))%index
      if (any(plan%readouts == 0)) return      ! a measure that was rejected
      plan%units = [(unit_size(reading%cards(found(j))%deflection, reading%units), j=1, given)]
      call slot(reading, 'ratios', first, count=given)
      plan%ratios = [(first + j - 1, j=1, given)]
      call append_measures(reading, 'coupler', plan%readouts)
      reading%plan%joints = [reading%plan%joints, plan]
   end subroutine make_coupler

   !> Adds a joint of one row, with one term per measure.
   subroutine append_measures(reading, kind, readouts)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: kind
      integer, intent(in) :: readouts(:)
      type(term_t) :: terms(size(readouts))

      terms%measure = reading%plan%prototype%readouts(readouts)%measure
      call append_joint(reading%plan%prototype, text_of(reading, 'name'), where_of(reading), kind, terms, [size(terms)])
   end subroutine append_measures

   !> Whether a joint has studs, whose tilt may be rated.
   pure logical function has_stud(kind)
      type(joint_kind_t), intent(in) :: kind
      has_stud = any(kind%name == [character(9) :: 'spherical', 'universal', 'distance'])
   end function has_stud

   !> Checks that a joint has the keys that its type requires, and no other keys.
   subroutine check_keys(reading, kind)
      type(deck_reading_t), intent(inout) :: reading
      type(joint_kind_t), intent(in) :: kind
      character(*), parameter :: joint_keys(13) = [character(18) :: 'bodies', 'at', 'axis', 'axis_vector', 'axis_2', &
         'axis_2_vector', 'measure', 'measures', 'ratios', 'stiffness', 'balance', 'rating_angle', 'rating_axis_vector']
      character(:), allocatable :: a_joint
      logical :: has_axis, has_second, may(13), must(13)
      integer :: j

      a_joint = 'a '//trim(kind%name)//' joint'
      may(1:2) = .not. kind%is_of_measures
      may(3:4) = kind%axes /= no_axis
      may(5:6) = kind%axes >= one_or_two
      may([7, 10, 11]) = kind%name == 'driver'
      may(8:9) = kind%name == 'coupler'
      may(12:13) = has_stud(kind)
      must = may
      must(2) = kind%min_points > 0
      must([3, 4, 5, 6, 10, 11, 12, 13]) = .false.
      do j = 1, size(joint_keys)
         if (.not. may(j)) call refuse(reading, joint_keys(j:j), a_joint//' does not accept this key')
         if (must(j) .and. .not. has_key(reading, trim(joint_keys(j)))) &
            call complain(reading, '', quoted(joint_keys(j))//' is missing')
      end do
      has_axis = has_key(reading, 'axis') .or. has_key(reading, 'axis_vector')
      has_second = has_key(reading, 'axis_2') .or. has_key(reading, 'axis_2_vector')
      if (kind%axes == either_axis) then
         if (.not. (has_axis .or. has_second)) call complain(reading, '', &
            a_joint//" needs 'axis' or 'axis_2' (the other one is then chosen perpendicular to it)")
         return
      end if
      if (kind%axes /= no_axis .and. .not. has_axis) call complain(reading, '', a_joint//" needs 'axis' or 'axis_vector'")
      if (kind%axes == two_axes .and. .not. has_second) call complain(reading, '', a_joint//" needs 'axis_2' or 'axis_2_vector'")
   end subroutine check_keys

   !> Checks that two distinct points are given.
   subroutine need_two_points(reading, ends, is_found, what)
      type(deck_reading_t), intent(inout) :: reading
      integer, intent(in) :: ends(2)       !! indices of the vectors
      logical, intent(in) :: is_found
      character(*), intent(in) :: what
      character(word_length) :: at(2)
      logical :: are_apart

      at = texts_of(reading, 'at', 2)
      if (at(1) /= '' .and. at(2) == '') then
         call complain(reading, 'at', 'at: '//what//' needs two points, found one')
      else if (is_found) then
         call check_apart(reading, 'at', ends, '', are_apart)
      end if
   end subroutine need_two_points

end module ek_reader_joints
