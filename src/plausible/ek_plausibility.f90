!> Plausibility of a deck as a road vehicle: wrong units, swapped points, wrong bodies, a coil in tension, a motion that only
!> preload resists, or a response at design that no vehicle has. Findings are remarks, never errors. `plausible = .false.` in &model
!> suppresses them.
module ek_plausibility
   use ek_kinds, only: wp, degree
   use ek_error, only: message_list_t
   use ek_text, only: str, quoted
   use ek_measure, only: measure_t, axis_axis, rotation, distance
   use ek_element, only: element_t, element_kinds, coil_shape, damper_shape
   use ek_element_label, only: element_label
   use ek_suspension, only: suspension_t, body_name
   use ek_case, only: case_t
   use ek_state, only: design_state
   use ek_kkt, only: kkt_t, new_kkt
   use ek_diagnosis, only: diagnosis_t, diagnose
   use ek_plausible_range, only: doubts_t, length
   use ek_plausible_parts, only: doubt_elements, doubt_loads, doubt_vehicle, doubt_cases
   use ek_plausible_connection, only: doubt_connections
   use ek_plausible_bushing, only: doubt_bushings
   use ek_plausible_ends, only: doubt_rod_ends
   use ek_plausible_names, only: doubt_names
   use ek_plausible_springs, only: doubt_springs, doubt_replaced_preloads
   use ek_plausible_steering, only: doubt_steering
   use ek_plausible_response, only: doubt_response, find_shortening
   use ek_plausible_shape, only: doubt_wheels, doubt_points, point_of, vehicle_size
   implicit none(type, external)
   private
   public :: doubt

contains

   !> Lists one remark per implausible item, `file:line: item: finding`.
   !>
   !> In a model without a wheel, which is not a suspension, connections, points and response are not checked.
   subroutine doubt(suspension, cases, remarks, raw)
      type(suspension_t), intent(in) :: suspension       !! after the preload trim (`balance`) if possible; not on a rig
      type(case_t), intent(in) :: cases(:)               !! of the deck
      type(message_list_t), intent(out) :: remarks
      type(suspension_t), intent(in), optional :: raw    !! before the trim; without it, replaced preloads are not examined
      type(doubts_t) :: doubts
      type(diagnosis_t) :: diagnosis
      type(kkt_t) :: kkt
      logical :: carries, shortens(suspension%scalars)
      integer :: k

      if (.not. suspension%is_plausible_wanted) return
      doubts%units = suspension%units
      doubts%size = vehicle_size(suspension)
      kkt = new_kkt(suspension)
      call diagnose(suspension, design_state(suspension), kkt, diagnosis, wants_preload_held=.true.)
      call doubt_connections(suspension, doubts, carries)
      call doubt_wheels(suspension, doubts)
      call doubt_points(suspension, doubts)
      call doubt_names(suspension, doubts)
      shortens = .false.
      if (diagnosis%is_solvable()) call find_shortening(suspension, kkt, shortens)
      call doubt_links(suspension, shortens, doubts)
      call doubt_rod_ends(suspension, doubts)
      call doubt_bushings(suspension, doubts)
      call doubt_steering(suspension, doubts)
      carries = carries .and. index(diagnosis%warnings%text(), 'can steer freely') == 0      ! this explains any response, too
      if (carries .and. diagnosis%is_solvable()) call doubt_response(suspension, kkt, doubts)
      call doubt_elements(suspension, doubts)
      call doubt_springs(suspension, doubts)
      if (present(raw)) call doubt_replaced_preloads(suspension, raw, doubts)
      call doubt_vehicle(suspension, doubts)
      call doubt_loads(suspension, doubts)
      call doubt_cases(suspension, cases, doubts)
      call doubts%examine('', '')
      do k = 1, diagnosis%preload_held%count()
         call doubts%add(diagnosis%preload_held%line(k), diagnosis%preload_held%line(k))
      end do
      do k = 1, diagnosis%warnings%count()
         if (index(diagnosis%warnings%line(k), 'very soft') == 1) &
            call doubts%add(diagnosis%warnings%line(k), diagnosis%warnings%line(k))
      end do
      remarks = doubts%remarks
   end subroutine doubt

   !> Examines joints, links, bushings, springs and dampers: length, body at each end, direction.
   subroutine doubt_links(suspension, shortens, doubts)
      type(suspension_t), intent(in) :: suspension
      logical, intent(in) :: shortens(:)          !! of find_shortening
      type(doubts_t), intent(inout) :: doubts
      real(wp) :: ends(3, 2), apart(3)
      integer :: k

      do k = 1, size(suspension%joints)
         associate (joint => suspension%joints(k), &
               m => suspension%terms(suspension%rows(suspension%joints(k)%first_row)%first)%measure)
            call doubts%examine(joint%where, 'joint '//quoted(joint%name))
            call doubt_own_points(suspension, m, doubts)
            if (joint%kind == 'cylindrical') call doubt_slider(suspension, m, doubts)
            if (joint%kind /= 'distance') cycle
            ends(:, 1) = point_of(suspension, m%body_i, m%arm_i)
            ends(:, 2) = point_of(suspension, m%body_j, m%arm_j)
            apart = ends(:, 2) - ends(:, 1)
            call doubts%judge('link length', norm2(apart))
            call doubt_ends(suspension, m, ends, doubts)
         end associate
      end do
      do k = suspension%scalars + 1, size(suspension%elements)
         call doubts%examine(suspension%elements(k)%where, element_label(suspension%elements(k)))
         call doubt_own_points(suspension, suspension%elements(k)%measure, doubts)
      end do
      do k = 1, suspension%scalars
         if (shortens(k)) cycle
         if (any(element_kinds(suspension%elements(k)%kind)%shape == [coil_shape, damper_shape])) &
            call doubt_upright(suspension, suspension%elements(k), doubts)
      end do
   end subroutine doubt_links

   !> Checks that a joint of a wheel carrier is on the same side of the car as the wheel and, if the wheel has a steering axis, near
   !> the wheel centre.
   subroutine doubt_own_points(suspension, m, doubts)
      type(suspension_t), intent(in) :: suspension
      type(measure_t), intent(in) :: m
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: beyond = 0.05_wp     ! m: over the middle of the car
      real(wp), parameter :: far = 0.9_wp         ! m: from the centre of a wheel that steers
      real(wp) :: at(3)
      integer :: w, own

      if (m%kind == axis_axis .or. m%kind == rotation) return
      do w = 1, size(suspension%wheels)
         associate (wheel => suspension%wheels(w))
            if (count(suspension%wheels%body == wheel%body) > 1) cycle
            own = findloc([m%body_i, m%body_j], wheel%body, dim=1)
            if (own == 0) cycle
            at = merge(m%arm_i, m%arm_j, own == 1)
            if (wheel%has_steer_axis .and. norm2(at - wheel%centre) > far) call doubts%add('far joint', &
               'on the carrier, but '//doubts%speak(length, norm2(at - wheel%centre))//' from the wheel centre; check '// &
               'the order and the unit of its coordinates')
            at = point_of(suspension, wheel%body, at)
            if (wheel%side*at(2) < -beyond) call doubts%add('other side', 'on the carrier of wheel '// &
               quoted(wheel%name)//', but on the other side of the car; check the sign of y')
         end associate
      end do
   end subroutine doubt_own_points

   !> Checks that the end of a link on the wheel carrier is outboard of the other end of the link.
   subroutine doubt_ends(suspension, m, ends, doubts)
      type(suspension_t), intent(in) :: suspension
      type(measure_t), intent(in) :: m
      real(wp), intent(in) :: ends(3, 2)           !! m, on body i and body j
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: clearly = 0.06_wp     ! m: longitudinal links may slant by this
      integer :: w, own

      do w = 1, size(suspension%wheels)
         associate (wheel => suspension%wheels(w))
            if (count(suspension%wheels%body == wheel%body) > 1) cycle
            if (any(suspension%wheels%body == m%body_i) .and. any(suspension%wheels%body == m%body_j)) cycle
            own = findloc([m%body_i, m%body_j], wheel%body, dim=1)
            if (own == 0) cycle
            if (wheel%side*(ends(2, own) - ends(2, 3 - own)) < -clearly) call doubts%add('swapped', &
               'its end on body '//quoted(body_name(suspension, wheel%body))//' lies inboard of its end on '// &
               quoted(body_name(suspension, merge(m%body_j, m%body_i, own == 1)))//': are the two points swapped?')
         end associate
      end do
   end subroutine doubt_ends

   !> Checks that the axis of a strut is within 45° of the vertical.
   subroutine doubt_slider(suspension, m, doubts)
      type(suspension_t), intent(in) :: suspension
      type(measure_t), intent(in) :: m
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: upright = 0.7_wp      ! cosine: 45°

      if (.not. (any(suspension%wheels%body == m%body_i) .or. any(suspension%wheels%body == m%body_j))) return
      if (m%kind /= axis_axis) return
      if (abs(m%v(3)) < upright) call doubts%add('slider', 'the axis of the strut is '// &
         str(nint(acos(min(1.0_wp, abs(m%v(3))))/degree))//' deg from the vertical; check the signs of its coordinates')
   end subroutine doubt_slider

   !> Checks the bodies at the ends of a spring or damper within 45° of the vertical that does not get shorter when the wheel moves
   !> up. The rank of the body at the upper end must not be below the rank of the body at the lower end (rank_of). A rocker or lever
   !> pushes the upper end of its spring down, towards the chassis: such a spring gets shorter.
   subroutine doubt_upright(suspension, spring, doubts)
      type(suspension_t), intent(in) :: suspension
      type(element_t), intent(in) :: spring
      type(doubts_t), intent(inout) :: doubts
      real(wp) :: up(3)
      integer :: order

      associate (m => spring%measure)
         order = rank_of(m%body_j) - rank_of(m%body_i)
         if (order == 0 .or. m%kind /= distance) return
         up = point_of(suspension, m%body_j, m%arm_j) - point_of(suspension, m%body_i, m%arm_i)
         if (sign(1, order)*up(3) > -0.7_wp*norm2(up)) return      ! within 45 deg of the vertical
         call doubts%examine(spring%where, element_label(spring))
         call doubts%add('upside down', &
            'its upper end is on '//quoted(body_name(suspension, merge(m%body_i, m%body_j, order > 0)))// &
            ', its lower end on '//quoted(body_name(suspension, merge(m%body_j, m%body_i, order > 0)))// &
            ': are the two points swapped?')
      end associate

   contains

      !> Rank of a body for comparing upper and lower ends: 1 for the chassis, −1 for the body of a wheel, 0 for other bodies.
      pure integer function rank_of(body)
         integer, intent(in) :: body
         rank_of = 0
         if (body == 0) rank_of = 1
         if (any(suspension%wheels%body == body)) rank_of = -1
      end function rank_of

   end subroutine doubt_upright

end module ek_plausibility
