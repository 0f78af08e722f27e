!> &measure and &joint: quantities that are constrained, driven, coupled or read out.
module ek_reader_joints
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_measure, only: axis_axis, body_gap, global_gap, distance, rotation
   use ek_joint, only: joint_geometry_t, joint_kinds, needs_axis, needs_second_axis
   use ek_suspension, only: suspension_t, readout_t
   use ek_builder, only: add_readout, add_joint, add_driver, add_coupler
   use ek_group, only: measure_group, joint_group, word_length, most_measures
   use ek_deck, only: deck_t
   use ek_draft, only: draft_t, complain, where_of, has_key, choice, look_up, find_point, find_bodies, &
      find_direction, angle_between
   implicit none(type, external)
   private
   public :: read_measures, read_joints

   character(*), parameter :: measure_types(5) = [character(10) :: 'axes', 'gap', 'global_gap', 'distance', 'rotation']
   integer, parameter :: measure_kinds(5) = [axis_axis, body_gap, global_gap, distance, rotation]
   real(wp), parameter :: angle_tolerance = 0.01_wp   !! deg, for axes that must be perpendicular or parallel

contains

   !> &measure: a named scalar between two bodies.
   subroutine read_measures(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension
      character(word_length) :: name, type, bodies(2), at(2), axis(2), axis_2(2)
      real(wp) :: axis_vector(3), axis_2_vector(3)
      namelist /measure/ name, type, bodies, at, axis, axis_vector, axis_2, axis_2_vector
      type(readout_t) :: readout
      real(wp) :: u(3), v(3), ends(3, 2)
      logical :: has_bodies, has_points, has_u, has_v, is_set
      integer :: k, kind, number(2), used, status

      used = 0
      do k = 1, deck%used
         if (draft%cards(k)%group /= measure_group) cycle
         name = ''
         type = ''
         bodies = ''
         at = ''
         axis = ''
         axis_2 = ''
         axis_vector = 0.0_wp
         axis_2_vector = 0.0_wp
         read (draft%cards(k)%text, nml=measure, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')

         call choice(draft, deck, k, 'type', trim(type), measure_types, kind)
         call find_bodies(draft, deck, k, bodies, number, has_bodies)
         call find_points(draft, deck, k, at, ends, has_points)
         call find_direction(draft, deck, k, 'axis', axis, 'axis_vector', axis_vector, u, has_u, is_set)
         call find_direction(draft, deck, k, 'axis_2', axis_2, 'axis_2_vector', axis_2_vector, v, has_v, is_set)
         if (kind == 0) cycle
         kind = measure_kinds(kind)

         select case (kind)
         case (distance, body_gap, global_gap)
            if (.not. has_key(deck, k, 'at')) call complain(draft, deck, k, '', "'at' is missing")
         case default
            call refuse(draft, deck, k, 'at', 'a measure of type '//quoted(type)//' takes no points')
         end select
         if (kind == distance) call check_apart(draft, deck, k, at, ends, has_points, 'a distance')
         if (kind == distance) then
            call refuse(draft, deck, k, 'axis', 'a distance takes no axis')
            call refuse(draft, deck, k, 'axis_vector', 'a distance takes no axis')
         else if (.not. has_u) then
            call complain(draft, deck, k, '', "give 'axis' or 'axis_vector'")
         end if
         if (kind /= axis_axis) then
            call refuse(draft, deck, k, 'axis_2', 'only a measure of type '//quoted('axes')//' takes a second axis')
            call refuse(draft, deck, k, 'axis_2_vector', 'only a measure of type '//quoted('axes')//' takes a second axis')
         else if (.not. has_v) then
            call complain(draft, deck, k, '', "give 'axis_2' or 'axis_2_vector'")
         end if

         select case (kind)
         case (rotation)
            draft%cards(k)%factor = draft%units%angle
         case (axis_axis)
            draft%cards(k)%factor = 1.0_wp
         case default
            draft%cards(k)%factor = draft%units%length
         end select
         used = used + 1
         draft%cards(k)%index = used
         readout%name = trim(name)
         readout%where = where_of(deck, k)
         readout%measure%kind = kind
         readout%measure%body_i = number(1)
         readout%measure%body_j = number(2)
         readout%measure%u = u
         readout%measure%v = v
         readout%measure%arm_i = ends(:, 1)
         readout%measure%arm_j = ends(:, 2)
         call add_readout(suspension, readout)
      end do
   end subroutine read_measures

   !> &joint.
   subroutine read_joints(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension
      character(word_length) :: name, type, bodies(2), at(2), axis(2), axis_2(2), measure, measures(most_measures)
      real(wp) :: axis_vector(3), axis_2_vector(3), ratios(most_measures), stiffness
      namelist /joint/ name, type, bodies, at, axis, axis_vector, axis_2, axis_2_vector, measure, measures, ratios, &
         stiffness, balance
      logical :: balance
      character(:), allocatable :: kind
      integer :: k, number, status

      do k = 1, deck%used
         if (draft%cards(k)%group /= joint_group) cycle
         name = ''
         type = ''
         bodies = ''
         at = ''
         axis = ''
         axis_2 = ''
         measure = ''
         measures = ''
         axis_vector = 0.0_wp
         axis_2_vector = 0.0_wp
         ratios = 0.0_wp
         stiffness = 1.0_wp
         balance = .true.
         read (draft%cards(k)%text, nml=joint, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')
         call choice(draft, deck, k, 'type', trim(type), joint_kinds, number)
         if (number == 0) then
            call mark_bodies()
            cycle
         end if
         kind = trim(joint_kinds(number))
         call check_keys(draft, deck, k, kind)
         select case (kind)
         case ('driver')
            call make_driver()
         case ('coupler')
            call make_coupler()
         case default
            call make_joint()
         end select
      end do

   contains

      !> Bodies of a joint of unknown type count as attached: no second message about them.
      subroutine mark_bodies()
         integer :: numbers(2)
         logical :: is_found
         call find_bodies(draft, deck, k, bodies, numbers, is_found)
      end subroutine mark_bodies

      subroutine make_joint()
         type(joint_geometry_t) :: geometry
         real(wp) :: ends(3, 2), angle
         integer :: numbers(2)
         logical :: has_bodies, has_points, has_u, has_v, is_u, is_v

         call find_bodies(draft, deck, k, bodies, numbers, has_bodies)
         call find_points(draft, deck, k, at, ends, has_points)
         select case (kind)
         case ('distance')
            call check_apart(draft, deck, k, at, ends, has_points, 'a distance joint')
         case ('in_plane', 'in_line')
            continue
         case default
            if (at(2) /= '') call complain(draft, deck, k, 'at', 'at: a '//kind//' joint has one point, found two')
         end select
         call find_direction(draft, deck, k, 'axis', axis, 'axis_vector', axis_vector, geometry%axis_i, has_u, is_u)
         call find_direction(draft, deck, k, 'axis_2', axis_2, 'axis_2_vector', axis_2_vector, geometry%axis_j, has_v, is_v)
         if (kind == 'universal') then
            if (is_u .and. .not. has_v) geometry%axis_j = across(geometry%axis_i)
            if (is_v .and. .not. has_u) geometry%axis_i = across(geometry%axis_j)
         else if (.not. has_v) then
            geometry%axis_j = geometry%axis_i
         end if
         if (is_u .and. is_v) then
            angle = angle_between(geometry%axis_i, geometry%axis_j)
            select case (kind)
            case ('universal', 'perpendicular')
               if (abs(angle - 90.0_wp) > angle_tolerance) call complain(draft, deck, k, '', &
                  'axis and axis_2 must be at 90 deg to each other, found '//str(angle)//' deg')
            case ('parallel')
               if (min(angle, 180.0_wp - angle) > angle_tolerance) call complain(draft, deck, k, '', &
                  'axis and axis_2 must be parallel, found '//str(angle)//' deg between them')
            case ('constant_velocity')
               if (angle > 179.0_wp) call complain(draft, deck, k, '', &
                  'axis and axis_2 point in opposite directions; reverse one of them')
            end select
         end if
         if (.not. draft%cards(k)%is_good .or. .not. has_bodies) return
         geometry%body_i = numbers(1)
         geometry%body_j = numbers(2)
         geometry%point_i = ends(:, 1)
         geometry%point_j = ends(:, 2)
         call add_joint(suspension, trim(name), where_of(deck, k), kind, geometry)
         if (kind /= 'universal') return
         associate (joint => suspension%joints(size(suspension%joints)))
            joint%axis(:, 1) = geometry%axis_i
            joint%axis(:, 2) = geometry%axis_j
            if (.not. has_u) joint%chosen_axis = 1
            if (.not. has_v) joint%chosen_axis = 2
         end associate
      end subroutine make_joint

      !> Stiffness: force/length, or moment/angle where the measure is an angle.
      subroutine make_driver()
         real(wp) :: reaction_unit
         integer :: found

         call look_up(draft, deck, k, 'measure', measure_group, trim(measure), found)
         if (found == 0) return
         draft%cards(k)%factor = draft%cards(found)%factor
         if (.not. stiffness > 0.0_wp) &
            call complain(draft, deck, k, 'stiffness', 'stiffness must be above 0, found '//str(stiffness))
         associate (readout => draft%cards(found)%index)
            if (.not. draft%cards(k)%is_good .or. readout == 0) return
            if (.not. has_key(deck, k, 'stiffness')) then
               if (has_key(deck, k, 'balance')) call complain(draft, deck, k, 'balance', &
                  'balance: only a driver with a stiffness takes this key')
               call add_driver(suspension, trim(name), where_of(deck, k), readout)
               return
            end if
            reaction_unit = draft%units%force
            if (any(suspension%readouts(readout)%measure%kind == [axis_axis, rotation])) &
               reaction_unit = reaction_unit*draft%units%length
            call add_driver(suspension, trim(name), where_of(deck, k), readout, &
               stiffness*reaction_unit/draft%cards(found)%factor)
            suspension%joints(size(suspension%joints))%says_balance = has_key(deck, k, 'balance')
            suspension%joints(size(suspension%joints))%is_balanced = balance
         end associate
      end subroutine make_driver

      !> Σ ratio × value is constrained in deck units; the row is scaled so that the first ratio is unchanged.
      subroutine make_coupler()
         integer :: found(most_measures), readouts(most_measures), given, j
         real(wp) :: scaled(most_measures)

         given = count(measures /= '')
         if (given == 0) return
         do j = 1, given
            call look_up(draft, deck, k, 'measures', measure_group, trim(measures(j)), found(j))
         end do
         if (.not. draft%cards(k)%is_good) return
         if (ratio_count() /= given) then
            call complain(draft, deck, k, 'ratios', 'ratios needs one value for each of the '//str(given)// &
               ' measures, found '//str(ratio_count()))
         else if (any(abs(ratios(:given)) <= 0.0_wp)) then
            call complain(draft, deck, k, 'ratios', 'ratios must not be zero')
         end if
         if (.not. draft%cards(k)%is_good .or. any(found(:given) == 0)) return
         do j = 1, given
            readouts(j) = draft%cards(found(j))%index
            if (readouts(j) == 0) return      ! a measure that was rejected
            scaled(j) = ratios(j)*draft%cards(found(1))%factor/draft%cards(found(j))%factor
         end do
         call add_coupler(suspension, trim(name), where_of(deck, k), readouts(:given), scaled(:given))
      end subroutine make_coupler

      integer function ratio_count()
         integer :: e
         ratio_count = 0
         do e = 1, deck%records(k)%used
            if (deck%records(k)%entries(e)%key == 'ratios') ratio_count = ratio_count + deck%records(k)%entries(e)%used
         end do
      end function ratio_count

   end subroutine read_joints

   !> The axis of a universal joint that is not given: horizontal and perpendicular to the given one; longitudinal if that one is
   !> vertical. On a mirrored axle it is symmetric.
   pure function across(axis) result(chosen)
      real(wp), intent(in) :: axis(3)                 !! unit
      real(wp) :: chosen(3)
      real(wp), parameter :: upright = 1.0e-3_wp      ! sine of the angle to the vertical: below it, longitudinal

      chosen = [-axis(2), axis(1), 0.0_wp]
      if (norm2(chosen) < upright) chosen = [1.0_wp, 0.0_wp, 0.0_wp] - axis(1)*axis
      chosen = chosen/norm2(chosen)
   end function across

   !> Checks which keys a type of joint requires and which it does not take.
   subroutine check_keys(draft, deck, k, kind)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: kind
      character(*), parameter :: joint_keys(11) = [character(13) :: 'bodies', 'at', 'axis', 'axis_vector', 'axis_2', &
         'axis_2_vector', 'measure', 'measures', 'ratios', 'stiffness', 'balance']
      logical :: is_geometric
      logical :: may(11), must(11)
      integer :: j

      is_geometric = kind /= 'driver' .and. kind /= 'coupler'
      may(1:2) = is_geometric
      may(3:4) = needs_axis(kind)
      may(5:6) = needs_second_axis(kind) .or. kind == 'parallel'
      may(7) = kind == 'driver'
      may(8:9) = kind == 'coupler'
      may(10:11) = kind == 'driver'
      must = may
      must(2) = is_geometric .and. kind /= 'parallel' .and. kind /= 'perpendicular'
      must(3:6) = .false.
      must(10:11) = .false.
      do j = 1, size(joint_keys)
         if (.not. may(j)) call refuse(draft, deck, k, trim(joint_keys(j)), 'a '//kind//' joint does not take this key')
         if (must(j) .and. .not. has_key(deck, k, trim(joint_keys(j)))) &
            call complain(draft, deck, k, '', quoted(joint_keys(j))//' is missing')
      end do
      if (kind == 'universal') then
         if (.not. any([has_key(deck, k, 'axis'), has_key(deck, k, 'axis_vector'), has_key(deck, k, 'axis_2'), &
            has_key(deck, k, 'axis_2_vector')])) call complain(draft, deck, k, '', &
            "a universal joint needs 'axis' or 'axis_2' (the other one is then chosen perpendicular to it)")
         return
      end if
      if (needs_axis(kind) .and. .not. (has_key(deck, k, 'axis') .or. has_key(deck, k, 'axis_vector'))) &
         call complain(draft, deck, k, '', "a "//kind//" joint needs 'axis' or 'axis_vector'")
      if (needs_second_axis(kind) .and. .not. (has_key(deck, k, 'axis_2') .or. has_key(deck, k, 'axis_2_vector'))) &
         call complain(draft, deck, k, '', "a "//kind//" joint needs 'axis_2' or 'axis_2_vector'")
   end subroutine check_keys

   !> Rejects a key that has no meaning here.
   subroutine refuse(draft, deck, k, key, why)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: key, why
      if (has_key(deck, k, key)) call complain(draft, deck, k, key, key//': '//why)
   end subroutine refuse

   !> One or two points; with one point, the second equals the first.
   subroutine find_points(draft, deck, k, at, ends, is_found)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: at(2)
      real(wp), intent(out) :: ends(3, 2)   !! m, x rearward
      logical, intent(out) :: is_found
      logical :: is_there

      call find_point(draft, deck, k, 'at', trim(at(1)), ends(:, 1), is_found)
      ends(:, 2) = ends(:, 1)
      if (at(2) == '') return
      call find_point(draft, deck, k, 'at', trim(at(2)), ends(:, 2), is_there)
      is_found = is_found .and. is_there
   end subroutine find_points

   !> Checks that two distinct points are given.
   subroutine check_apart(draft, deck, k, at, ends, is_found, what)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: at(2), what
      real(wp), intent(in) :: ends(3, 2)
      logical, intent(in) :: is_found

      if (at(1) /= '' .and. at(2) == '') then
         call complain(draft, deck, k, 'at', 'at: '//what//' needs two points, found one')
      else if (is_found .and. .not. norm2(ends(:, 2) - ends(:, 1)) > 0.0_wp) then
         call complain(draft, deck, k, 'at', 'at: the points '//quoted(at(1))//' and '//quoted(at(2))//' coincide')
      end if
   end subroutine check_apart

end module ek_reader_joints
