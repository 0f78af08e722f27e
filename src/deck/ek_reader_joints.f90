!> &measure and &joint: quantities that are constrained, driven, coupled or read out.
module ek_reader_joints
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_rotation, only: angle_between
   use ek_measure, only: axis_axis, body_gap, global_gap, distance, rotation, is_of_angle
   use ek_joint, only: term_t, joint_geometry_t, joint_terms, joint_kinds, joint_table, joint_kind_t, axes_fit, max_terms, &
      no_axis, one_or_two, two_axes, either_axis, right_angle, no_angle, not_opposed
   use ek_suspension, only: readout_t
   use ek_assembly, only: append_joint
   use ek_blueprint, only: vector_t, readout_plan_t, joint_plan_t, across, upright
   use ek_group, only: measure_group, word_length, most_measures
   use ek_draft, only: draft_t, complain, where_of, has_key, choice, text_of, texts_of, switch_of, value_count, refuse, slot
   use ek_reference, only: look_up, find_bodies, find_direction, find_ends, check_apart, new_vector
   implicit none(type, external)
   private
   public :: read_measure, read_joint

   character(*), parameter :: measure_types(5) = [character(10) :: 'axes', 'gap', 'global_gap', 'distance', 'rotation']
   integer, parameter :: measure_kinds(5) = [axis_axis, body_gap, global_gap, distance, rotation]

contains

   !> &measure: a named scalar between two bodies.
   subroutine read_measure(draft)
      type(draft_t), intent(inout) :: draft
      type(readout_t) :: readout
      type(readout_plan_t) :: plan
      character(:), allocatable :: type
      logical :: has_points, has_u, has_v, is_set
      integer :: kind, number(2)

      type = text_of(draft, 'type')
      call choice(draft, 'type', measure_types, kind)
      call find_bodies(draft, number)
      call find_ends(draft, .true., plan%ends, has_points)
      call find_direction(draft, 'axis', 'axis_vector', plan%u, has_u, is_set)
      call find_direction(draft, 'axis_2', 'axis_2_vector', plan%v, has_v, is_set)
      if (kind == 0) return
      kind = measure_kinds(kind)

      select case (kind)
      case (distance, body_gap, global_gap)
         if (.not. has_key(draft, 'at')) call complain(draft, '', "'at' is missing")
         draft%cards(draft%k)%factor = draft%units%length
      case default
         call refuse(draft, ['at'], 'a measure of type '//quoted(type)//' takes no points')
         draft%cards(draft%k)%factor = merge(draft%units%angle, 1.0_wp, kind == rotation)
      end select
      if (kind == distance) then
         call need_two_points(draft, plan%ends, has_points, 'a distance')
         call refuse(draft, ['axis       ', 'axis_vector'], 'a distance takes no axis')
      else if (.not. has_u) then
         call complain(draft, '', "give 'axis' or 'axis_vector'")
      end if
      if (kind /= axis_axis) then
         call refuse(draft, ['axis_2       ', 'axis_2_vector'], 'only a measure of type '//quoted('axes')//' takes a second axis')
      else if (.not. has_v) then
         call complain(draft, '', "give 'axis_2' or 'axis_2_vector'")
      end if

      plan%u = max(plan%u, upright)
      plan%v = max(plan%v, upright)
      readout%name = text_of(draft, 'name')
      readout%where = where_of(draft)
      readout%measure%kind = kind
      readout%measure%body_i = number(1)
      readout%measure%body_j = number(2)
      draft%plan%readouts = [draft%plan%readouts, plan]
      draft%cards(draft%k)%index = size(draft%plan%readouts)
      draft%plan%prototype%readouts = [draft%plan%prototype%readouts, readout]
   end subroutine read_measure

   !> &joint.
   subroutine read_joint(draft)
      type(draft_t), intent(inout) :: draft
      integer :: number, bodies(2)

      call choice(draft, 'type', joint_kinds, number)
      if (number == 0) then
         ! bodies of a joint of unknown type count as attached: no second message about them
         call find_bodies(draft, bodies)
         return
      end if
      call check_keys(draft, joint_table(number))
      select case (joint_kinds(number))
      case ('driver')
         call make_driver(draft)
      case ('coupler')
         call make_coupler(draft)
      case default
         call make_joint(draft, joint_table(number))
      end select
   end subroutine read_joint

   !> A joint that is defined by points and axes.
   subroutine make_joint(draft, kind)
      type(draft_t), intent(inout) :: draft
      type(joint_kind_t), intent(in) :: kind
      type(joint_geometry_t) :: geometry
      type(joint_plan_t) :: plan
      type(term_t) :: terms(max_terms)
      integer :: terms_of_row(max_terms), rows, numbers(2)
      logical :: has_bodies, has_points, has_u, has_v, is_u, is_v

      call find_bodies(draft, numbers, has_bodies)
      call find_ends(draft, .true., plan%ends, has_points)
      if (kind%least_points == 2) then
         call need_two_points(draft, plan%ends, has_points, 'a '//trim(kind%name)//' joint')
      else if (kind%most_points == 1 .and. value_count(draft, 'at') > 1) then
         call complain(draft, 'at', 'at: a '//trim(kind%name)//' joint has one point, found two')
      end if
      call find_direction(draft, 'axis', 'axis_vector', plan%axes(1), has_u, is_u)
      call find_direction(draft, 'axis_2', 'axis_2_vector', plan%axes(2), has_v, is_v)
      if (is_u .and. is_v) call check_axes(draft, kind%angle, plan%axes)
      if (.not. draft%cards(draft%k)%is_good .or. .not. has_bodies) return
      if (kind%axes == either_axis) then
         if (.not. has_v) call new_vector(draft, vector_t(kind=across, a=plan%axes(1)), plan%axes(2))
         if (.not. has_u) call new_vector(draft, vector_t(kind=across, a=plan%axes(2)), plan%axes(1))
      else
         plan%axes(1) = max(plan%axes(1), upright)
         if (.not. has_v) plan%axes(2) = plan%axes(1)
      end if
      draft%plan%joints = [draft%plan%joints, plan]
      geometry%body_i = numbers(1)
      geometry%body_j = numbers(2)
      call joint_terms(trim(kind%name), geometry, terms, terms_of_row, rows)      ! their numbers are set by `realise`
      associate (model => draft%plan%prototype)
         call append_joint(model, text_of(draft, 'name'), where_of(draft), trim(kind%name), &
            terms(:sum(terms_of_row(:rows))), terms_of_row(:rows))
         if (kind%axes == either_axis .and. .not. has_u) model%joints(size(model%joints))%chosen_axis = 1
         if (kind%axes == either_axis .and. .not. has_v) model%joints(size(model%joints))%chosen_axis = 2
      end associate
   end subroutine make_joint

   !> Reports axes that do not suit the joint.
   subroutine check_axes(draft, needed, axes)
      type(draft_t), intent(inout) :: draft
      integer, intent(in) :: needed        !! angle of joint_table
      integer, intent(in) :: axes(2)       !! vectors
      real(wp) :: angle

      if (axes_fit(needed, draft%vectors(:, axes(1)), draft%vectors(:, axes(2)))) return
      angle = angle_between(draft%vectors(:, axes(1)), draft%vectors(:, axes(2)))
      select case (needed)
      case (right_angle)
         call complain(draft, '', 'axis and axis_2 must be at 90 deg to each other, found '//str(angle)//' deg')
      case (no_angle)
         call complain(draft, '', 'axis and axis_2 must be parallel, found '//str(angle)//' deg between them')
      case (not_opposed)
         call complain(draft, '', 'axis and axis_2 point in opposite directions; reverse one of them')
      end select
   end subroutine check_axes

   !> Stiffness: force/length, or moment/angle where the measure is an angle.
   subroutine make_driver(draft)
      type(draft_t), intent(inout) :: draft
      type(joint_plan_t) :: plan
      real(wp) :: reaction_unit, place_unit
      integer :: found, readout

      call look_up(draft, 'measure', measure_group, text_of(draft, 'measure'), found)
      if (found == 0) return
      place_unit = draft%cards(found)%factor
      draft%cards(draft%k)%factor = place_unit
      readout = draft%cards(found)%index
      if (.not. draft%cards(draft%k)%is_good .or. readout == 0) return
      plan%readouts = [readout]
      plan%units = [place_unit]
      if (.not. has_key(draft, 'stiffness')) call refuse(draft, ['balance'], 'only a driver with a stiffness takes this key')
      associate (model => draft%plan%prototype)
         reaction_unit = draft%units%force
         if (is_of_angle(model%readouts(readout)%measure%kind)) reaction_unit = reaction_unit*draft%units%length
         call slot(draft, 'stiffness', reaction_unit, plan%stiffness)
         call append_measures(draft, 'driver', plan%readouts)
         model%joints(size(model%joints))%says_balance = has_key(draft, 'balance')
         model%joints(size(model%joints))%is_balanced = switch_of(draft, 'balance', .true.)
      end associate
      draft%plan%joints = [draft%plan%joints, plan]
   end subroutine make_driver

   !> Σ ratio × value is constrained in deck units; the row is scaled so that the first ratio is unchanged.
   subroutine make_coupler(draft)
      type(draft_t), intent(inout) :: draft
      type(joint_plan_t) :: plan
      character(word_length) :: measures(most_measures)
      integer :: found(most_measures), given, first, j

      measures = texts_of(draft, 'measures', most_measures)
      given = count(measures /= '')
      if (given == 0) return
      do j = 1, given
         call look_up(draft, 'measures', measure_group, trim(measures(j)), found(j))
      end do
      if (.not. draft%cards(draft%k)%is_good) return
      if (value_count(draft, 'ratios') /= given) call complain(draft, 'ratios', 'ratios needs one value for each of the '// &
         str(given)//' measures, found '//str(value_count(draft, 'ratios')))
      if (.not. draft%cards(draft%k)%is_good .or. any(found(:given) == 0)) return
      plan%readouts = draft%cards(found(:given))%index
      if (any(plan%readouts == 0)) return      ! a measure that was rejected
      plan%units = draft%cards(found(:given))%factor
      call slot(draft, 'ratios', 1.0_wp, first, count=given)
      plan%ratios = [(first + j - 1, j=1, given)]
      call append_measures(draft, 'coupler', plan%readouts)
      draft%plan%joints = [draft%plan%joints, plan]
   end subroutine make_coupler

   !> Adds a joint of one row, a term per measure.
   subroutine append_measures(draft, kind, readouts)
      type(draft_t), intent(inout) :: draft
      character(*), intent(in) :: kind
      integer, intent(in) :: readouts(:)
      type(term_t) :: terms(size(readouts))

      terms%measure = draft%plan%prototype%readouts(readouts)%measure
      call append_joint(draft%plan%prototype, text_of(draft, 'name'), where_of(draft), kind, terms, [size(terms)])
   end subroutine append_measures

   !> Checks which keys a type of joint requires and which it does not take.
   subroutine check_keys(draft, kind)
      type(draft_t), intent(inout) :: draft
      type(joint_kind_t), intent(in) :: kind
      character(*), parameter :: joint_keys(11) = [character(13) :: 'bodies', 'at', 'axis', 'axis_vector', 'axis_2', &
         'axis_2_vector', 'measure', 'measures', 'ratios', 'stiffness', 'balance']
      character(:), allocatable :: a_joint
      logical :: has_axis, has_second, may(11), must(11)
      integer :: j

      a_joint = 'a '//trim(kind%name)//' joint'
      may(1:2) = .not. kind%is_of_measures
      may(3:4) = kind%axes /= no_axis
      may(5:6) = kind%axes >= one_or_two
      may([7, 10, 11]) = kind%name == 'driver'
      may(8:9) = kind%name == 'coupler'
      must = may
      must(2) = kind%least_points > 0
      must([3, 4, 5, 6, 10, 11]) = .false.
      do j = 1, size(joint_keys)
         if (.not. may(j)) call refuse(draft, joint_keys(j:j), a_joint//' does not take this key')
         if (must(j) .and. .not. has_key(draft, trim(joint_keys(j)))) &
            call complain(draft, '', quoted(joint_keys(j))//' is missing')
      end do
      has_axis = has_key(draft, 'axis') .or. has_key(draft, 'axis_vector')
      has_second = has_key(draft, 'axis_2') .or. has_key(draft, 'axis_2_vector')
      if (kind%axes == either_axis) then
         if (.not. (has_axis .or. has_second)) call complain(draft, '', &
            a_joint//" needs 'axis' or 'axis_2' (the other one is then chosen perpendicular to it)")
         return
      end if
      if (kind%axes /= no_axis .and. .not. has_axis) call complain(draft, '', a_joint//" needs 'axis' or 'axis_vector'")
      if (kind%axes == two_axes .and. .not. has_second) call complain(draft, '', a_joint//" needs 'axis_2' or 'axis_2_vector'")
   end subroutine check_keys

   !> Checks that two distinct points are given.
   subroutine need_two_points(draft, ends, is_found, what)
      type(draft_t), intent(inout) :: draft
      integer, intent(in) :: ends(2)       !! vectors
      logical, intent(in) :: is_found
      character(*), intent(in) :: what
      character(word_length) :: at(2)
      logical :: are_apart

      at = texts_of(draft, 'at', 2)
      if (at(1) /= '' .and. at(2) == '') then
         call complain(draft, 'at', 'at: '//what//' needs two points, found one')
      else if (is_found) then
         call check_apart(draft, 'at', ends, '', are_apart)
      end if
   end subroutine need_two_points

end module ek_reader_joints
