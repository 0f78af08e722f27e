!> Messages on the results of a case: displacement under constant loads, drift of linear methods, large travel, rack beyond its
!> travel, violated joint constraints, curves used beyond their points.
module ek_case_remarks
   use ek_kinds, only: wp, degree, millimetre
   use ek_text, only: str, quoted, plural
   use ek_noise, only: is_noise, noise_of
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, scales_loads, default_tolerance
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: new_schedule, inputs_at
   use ek_kkt, only: kkt_t
   use ek_path, only: path_t
   use ek_newton, only: outcome_t, find_equilibrium
   use ek_table, only: table_t, column, row_count
   use ek_sweep_table, only: open_states
   use ek_attitude, only: attitude_t, wheel_attitude
   use ek_remark, only: remark_list_t, note, warning, failure, on_settling, on_drift, on_travel, on_rack, on_closure, on_curve, &
      swept_text
   use ek_free_wheels, only: has_spring
   use ek_curve, only: curve_t
   use ek_law, only: law_t, deflection
   use ek_measure, only: measure_value, rotation
   use ek_element_label, only: element_label
   use ek_elastic, only: deflect_bushing
   implicit none(type, external)
   private
   public :: settling_remarks, drift_remarks, travel_remarks, rack_remarks, closure_remarks, curve_reach_remarks

   !> The range of the deflection of one law over the states of a path, and the states at both ends of this range.
   type :: reach_t
      real(wp) :: least = 0.0_wp, most = 0.0_wp      !! least and greatest deflection [m or rad]
      integer :: at_least = 0, at_most = 0           !! indices of the states with these deflections; 0: no state was evaluated
   end type reach_t

contains

   !> Adds one note per wheel whose centre the constant loads have displaced by more than `least`; none for method 'recursive'.
   subroutine settling_remarks(suspension, case, path, least, remarks)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      real(wp), intent(in) :: least                      !! m
      type(remark_list_t), intent(inout) :: remarks
      type(state_t) :: state
      type(attitude_t) :: attitude
      integer :: k

      if (case%method == 'recursive') return
      if (count(path%is_reached) == 0) return
      state = design_state(suspension)
      call unpack_state(path%settled, state)
      do k = 1, size(suspension%wheels)
         attitude = wheel_attitude(suspension, state, k)
         if (norm2(attitude%centre) <= least) cycle
         call remarks%add(note, on_settling, case, 'under the constant loads wheel '// &
            quoted(suspension%wheels(k)%name)//' settles by '// &
            str(without_noise(attitude%centre(3)/millimetre, 'mm', case%tolerance), 4)//' mm (toe '// &
            str(without_noise(attitude%toe/degree, 'deg', case%tolerance), 4)//' deg, camber '// &
            str(without_noise(attitude%camber/degree, 'deg', case%tolerance), 4)//' deg there)', 0.0_wp)
      end do
   end subroutine settling_remarks

   !> Warns of a steering test whose range exceeds the travel of the rack.
   subroutine rack_remarks(suspension, case, remarks)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(remark_list_t), intent(inout) :: remarks
      real(wp), parameter :: rim = 1.0_wp + 1.0e-9_wp
      real(wp) :: furthest

      if (case%test /= 'steering' .or. .not. suspension%steering%has_steering) return
      if (len(case%drive) > 0 .and. case%drive /= suspension%steering%driver) return
      furthest = merge(case%from, case%to, abs(case%from) > abs(case%to))
      if (abs(furthest) <= suspension%steering%travel*rim) return
      call remarks%add(warning, on_rack, case, 'the rack is moved to '//str(abs(furthest)/millimetre, 4)// &
         ' mm, beyond its travel of '//str(suspension%steering%travel/millimetre, 4)//' mm in &steering', furthest)
   end subroutine rack_remarks

   !> Warns of a linear method whose states are off equilibrium, compared at the first wheel. At each end of the sweep, an
   !> equilibrium is solved from the state of the linear method. If this solution does not converge, adds a failure, because the
   !> states before this end are unreliable.
   subroutine drift_remarks(suspension, case, path, kkt, remarks)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(kkt_t), intent(inout) :: kkt
      type(remark_list_t), intent(inout) :: remarks
      type(state_t) :: state
      type(inputs_t) :: inputs
      type(outcome_t) :: outcome
      type(attitude_t) :: linear, exact
      real(wp) :: travel, toe, camber, tolerance
      real(wp), parameter :: much_travel = 1.0e-5_wp     ! m: 0.01 mm, about what a K&C rig resolves
      real(wp), parameter :: much_angle = 1.0e-3_wp*degree
      character(:), allocatable :: place, advice
      integer :: k, ends(2), n

      if (case%method == 'equilibrium' .or. size(suspension%wheels) == 0) return
      advice = '; more increments reduce it'
      if (case%method == 'recursive') advice = ' (the bias of this method; more increments do not remove it, '// &
         'method = ''equilibrium'' has none)'
      ends = [1, path%states]
      do n = 1, 2
         k = ends(n)
         if (.not. path%is_reached(k) .or. k == path%start) cycle
         state = design_state(suspension)
         call unpack_state(path%packed(:, k), state)
         call inputs_at(new_schedule(suspension, case), path%value(k), inputs)
         linear = wheel_attitude(suspension, state, 1)
         call find_equilibrium(suspension, inputs, min(case%tolerance, default_tolerance), state, kkt, outcome)
         exact = wheel_attitude(suspension, state, 1)
         tolerance = min(case%tolerance, default_tolerance)
         travel = millimetre*without_noise((linear%centre(3) - exact%centre(3))/millimetre, 'mm', tolerance)
         toe = degree*without_noise((linear%toe - exact%toe)/degree, 'deg', tolerance)
         camber = degree*without_noise((linear%camber - exact%camber)/degree, 'deg', tolerance)
         place = str(path%value(k)/case%unit)
         if (.not. outcome%is_converged) then
            call remarks%add(failure, on_drift, case, 'no equilibrium was found near the state at factor '//place// &
               '; the linear method has left the range that the suspension can reach', path%value(k), is_of_method=.true.)
         else if (abs(travel) > much_travel .or. max(abs(toe), abs(camber)) > much_angle) then
            call remarks%add(warning, on_drift, case, 'at factor '//place//' the state is off equilibrium by '// &
               str(travel/millimetre, 3)//' mm travel, '//str(toe/degree, 3)//' deg toe, '// &
               str(camber/degree, 3)//' deg camber'//advice, path%value(k), is_of_method=.true.)
         end if
      end do
   end subroutine drift_remarks

   !> A length or angle; 0 if it is only rounding noise (ek_noise), such as the travel of a wheel whose height is held.
   pure real(wp) function without_noise(value, unit, tolerance)
      real(wp), intent(in) :: value                !! in the unit
      character(*), intent(in) :: unit             !! 'mm' or 'deg'
      real(wp), intent(in) :: tolerance            !! tolerance of the solution [m]
      without_noise = merge(0.0_wp, value, is_noise(value, unit, 0.0_wp, tolerance))
   end function without_noise

   !> Adds a failure if states of a linear method are marked converged = 0 because they violate the joint constraints.
   subroutine closure_remarks(case, table, remarks)
      type(case_t), intent(in) :: case
      type(table_t), intent(in) :: table         !! of sweep_table
      type(remark_list_t), intent(inout) :: remarks
      real(wp) :: gap(row_count(table))
      logical :: is_open(row_count(table))

      is_open = open_states(table)
      if (.not. any(is_open)) return
      gap = column(table, 'constraint_error')
      call remarks%add(failure, on_closure, case, plural(count(is_open), &
         'state violates', 'states violate')//' the joint constraints (constraint_error up to '// &
         str(maxval(gap, mask=is_open), 2)//' m or rad) and '// &
         trim(merge('is ', 'are', count(is_open) == 1))//' marked converged = 0; use more increments, or method ''equilibrium''', &
         table%values(2, findloc(is_open, .true., dim=1))*case%unit, is_of_method=.true.)
   end subroutine closure_remarks

   !> Warns of a load that, at an end of the path, moves a wheel further than any suspension travels. The likely cause is a missing
   !> rate, or a rate in the wrong unit.
   subroutine travel_remarks(suspension, case, path, remarks)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(remark_list_t), intent(inout) :: remarks
      type(state_t) :: state
      type(attitude_t) :: attitude
      character(:), allocatable :: advice
      real(wp), parameter :: far = 0.25_wp      ! m: half as much again as the travel of an off-road car
      integer :: k, w, ends(2), n

      if (.not. scales_loads(case)) return      ! the deck prescribes the travel of a driven wheel
      advice = '; check the rates and their units'
      if (.not. has_spring(suspension)) advice = '; the deck has no spring'
      ends = [findloc(path%is_reached, .true., dim=1), findloc(path%is_reached, .true., dim=1, back=.true.)]
      state = design_state(suspension)
      do n = 1, 2
         k = ends(n)
         if (k == 0) return
         call unpack_state(path%packed(:, k), state)
         do w = 1, size(suspension%wheels)
            attitude = wheel_attitude(suspension, state, w)
            if (.not. norm2(attitude%centre) > far) cycle
            call remarks%add(warning, on_travel, case, 'at factor '//str(path%value(k)/case%unit)// &
               ' wheel '//quoted(suspension%wheels(w)%name)//' has moved by '//str(norm2(attitude%centre)/millimetre, 3)// &
               ' mm'//advice, path%value(k))
            return
         end do
      end do
   end subroutine travel_remarks

   !> Warns of curves used beyond their first or last point. Beyond these points, curves are extrapolated linearly, without data of
   !> the deck.
   !>
   !> Adds one message for each end of a curve that was exceeded by more than a thousandth of the span of the curve. Elements from
   !> one line of the deck (both sides of a mirrored element) with the same curve give one message, for the largest excess.
   subroutine curve_reach_remarks(suspension, case, path, remarks)
      type(suspension_t), intent(in) :: suspension       !! on the rig
      type(case_t), intent(in) :: case                   !! on the rig
      type(path_t), intent(in) :: path
      type(remark_list_t), intent(inout) :: remarks
      type(reach_t) :: reach(6, size(suspension%elements))      ! of an element of one measure: the first
      type(state_t) :: state
      real(wp) :: gap(3), theta(3)
      type(curve_t) :: curve
      logical :: is_reported(2), is_angle
      integer :: s, k, c

      if (.not. (any(suspension%elements%law%has_curve) .or. any(suspension%elements%bushing%has_curves))) return
      state = design_state(suspension)
      do s = 1, path%states
         if (.not. path%is_reached(s)) cycle
         call unpack_state(path%packed(:, s), state)
         do k = 1, size(suspension%elements)
            associate (element => suspension%elements(k), b => suspension%elements(k)%bushing, &
                  pose_i => state%poses(suspension%elements(k)%measure%body_i + 1), &
                  pose_j => state%poses(suspension%elements(k)%measure%body_j + 1))
               if (element%law%has_curve) &
                  call extend(reach(1, k), element%law, measure_value(element%measure, pose_i, pose_j), s)
               if (.not. b%has_curves) cycle
               call deflect_bushing(b, element%measure, pose_i, pose_j, gap, theta)
               do c = 1, 3
                  if (b%laws(c)%has_curve) &
                     call extend(reach(c, k), b%laws(c), dot_product(b%axes(:, c), gap), s)
                  if (b%laws(c + 3)%has_curve) &
                     call extend(reach(c + 3, k), b%laws(c + 3), dot_product(b%axes(:, c), theta), s)
               end do
            end associate
         end do
      end do
      do k = 1, size(suspension%elements)
         do c = 1, 6
            if (reach(c, k)%at_most == 0) cycle
            is_reported = .false.
            is_angle = suspension%elements(k)%measure%kind == rotation .or. c > 3
            do s = 1, size(suspension%elements)
               if (s == k .or. suspension%elements(s)%where /= suspension%elements(k)%where .or. reach(c, s)%at_most == 0) cycle
               is_reported = is_reported .or. further(reach(c, s), reach(c, k), s < k, is_angle, case%tolerance)
            end do
            associate (element => suspension%elements(k))
               if (element%law%has_curve) then
                  curve = element%law%curve
               else
                  curve = element%bushing%laws(c)%curve
               end if
               call report(case, path, curve, reach(c, k), element_label(element), is_angle, is_reported, remarks)
            end associate
         end do
      end do
   end subroutine curve_reach_remarks

   !> Includes the deflection of a law at a state in a range. The deflection of a stop without contact is 0.
   subroutine extend(reach, law, value, state)
      type(reach_t), intent(inout) :: reach
      type(law_t), intent(in) :: law
      real(wp), intent(in) :: value
      integer, intent(in) :: state
      real(wp) :: e

      e = deflection(law, value)
      if (law%is_one_sided) e = max(e, 0.0_wp)
      if (reach%at_least == 0 .or. e < reach%least) then
         reach%least = e
         reach%at_least = state
      end if
      if (reach%at_most == 0 .or. e > reach%most) then
         reach%most = e
         reach%at_most = state
      end if
   end subroutine extend

   !> Whether another element of the same line of the deck has a larger excess: (1) below the curve, (2) above. If two excesses are
   !> equal but for noise (ek_noise), the result is .true. for the later element, so that only the first is reported.
   pure function further(other, own, is_before, is_angle, tolerance) result(is_further)
      type(reach_t), intent(in) :: other, own
      logical, intent(in) :: is_before
      logical, intent(in) :: is_angle              !! the deflections are angles
      real(wp), intent(in) :: tolerance            !! tolerance of the solution [m]
      logical :: is_further(2)
      real(wp) :: slack, unit

      unit = merge(degree, millimetre, is_angle)
      slack = unit*noise_of(trim(merge('deg', 'mm ', is_angle)), &
         max(abs(own%most), abs(own%least), abs(other%most), abs(other%least))/unit, tolerance)
      is_further(1) = other%least < own%least - slack .or. (is_before .and. other%least < own%least + slack)
      is_further(2) = other%most > own%most + slack .or. (is_before .and. other%most > own%most - slack)
   end function further

   !> Adds the warnings on one curve: used before its first point, used beyond its last point.
   subroutine report(case, path, curve, reach, thing, is_angle, is_reported, remarks)
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(curve_t), intent(in) :: curve
      type(reach_t), intent(in) :: reach
      character(*), intent(in) :: thing
      logical, intent(in) :: is_angle
      logical, intent(in) :: is_reported(2)           !! below the first point, beyond the last: reported for another element
      type(remark_list_t), intent(inout) :: remarks
      character(:), allocatable :: head, unit_name
      real(wp) :: unit, slack
      integer :: n

      n = size(curve%breaks)
      slack = 1.0e-3_wp*(curve%breaks(n) - curve%breaks(1))
      unit = merge(degree, millimetre, is_angle)
      unit_name = trim(merge(' deg', ' mm ', is_angle))
      head = 'curve'
      if (allocated(curve%name)) head = head//' '//quoted(curve%name)
      head = head//' of '//thing
      if (reach%least < curve%breaks(1) - slack .and. .not. is_reported(1)) &
         call warn('begins', curve%breaks(1), reach%least, reach%at_least, 'before its first')
      if (reach%most > curve%breaks(n) + slack .and. .not. is_reported(2)) &
         call warn('ends', curve%breaks(n), reach%most, reach%at_most, 'beyond its last')

   contains

      !> Adds a warning that a curve was used beyond one of its ends.
      subroutine warn(verb, limit, used, state, beyond)
         character(*), intent(in) :: verb, beyond
         real(wp), intent(in) :: limit, used
         integer, intent(in) :: state
         call remarks%add(warning, on_curve, case, head//' '//verb//' at '//str(limit/unit, 4)//unit_name//' and was used to '// &
            str(used/unit, 4)//unit_name//', at '//swept_text(case, path%value(state), 4)//'; '//beyond// &
            ' point it is extrapolated linearly', path%value(state))
      end subroutine warn

   end subroutine report

end module ek_case_remarks
