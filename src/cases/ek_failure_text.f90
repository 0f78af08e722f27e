!> Messages: why a path ended, and which of its states are unstable.
module ek_failure_text
   use ek_kinds, only: wp, millimetre, degree, pi
   use ek_text, only: str, quoted, plural
   use ek_measure, only: measure_t, measure_value, rotation
   use ek_element, only: element_kinds
   use ek_element_label, only: element_label
   use ek_element_force, only: spring_tension
   use ek_suspension, only: suspension_t, body_name, driver_unit
   use ek_rig_test, only: swept_unit
   use ek_case, only: case_t, scales_loads, row_name
   use ek_manoeuvre, only: has_manoeuvres
   use ek_grid, only: is_grid
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: new_schedule, inputs_at
   use ek_kkt, only: kkt_t
   use ek_motion_text, only: motion_text
   use ek_diagnosis, only: diagnosis_t, diagnose
   use ek_break, only: break_t, why_it_ends, lock, limit_point, mechanism
   use ek_path, only: path_t
   use ek_reach, only: failure_t
   use ek_arc_survey, only: stuck, gone_far, gone_round, arrived, max_steps
   use ek_sweep_table, only: nearly_singular
   use ek_remark, only: swept_text, remark_list_t, warning, on_stability
   use ek_free_wheels, only: has_spring
   implicit none(type, external)
   private
   public :: failure_text, stability_remarks

   integer, parameter :: digits = 10      !! digits printed of the swept value at the end of a path, exact to 1e-9 of the range

contains

   !> Message about where a path ends, and why: joints that lock, a limit point, a mechanism, or the last attempt; with the stops in
   !> contact. For a load table or a grid, the message lists the rows or states that did not converge.
   function failure_text(suspension, case, path, failure, kkt) result(text)
      type(suspension_t), intent(in) :: suspension     !! on the rig
      type(case_t), intent(in) :: case                 !! on the rig
      type(path_t), intent(in) :: path
      type(failure_t), intent(in) :: failure
      type(kkt_t), intent(inout) :: kkt                !! work space
      character(:), allocatable :: text

      if (.not. path%is_settled) then
         text = 'no equilibrium under the constant loads'
      else if (path%is_table) then
         text = row_text(case, path, failure)
         if (is_grid(case)) text = grid_text(suspension, case, path)
      else if (failure%ending /= arrived) then
         text = arc_text(case, path, failure)
         if (failure%ending /= stuck) return
      else if (failure%is_off_path) then
         text = 'method '//case%method//' has left the path from design: its states from '// &
            swept_text(case, path%value(failure%state), digits)//' on are marked converged = 0; use more increments, or '// &
            'method ''equilibrium'''
         return
      else
         text = 'no equilibrium at '//swept_text(case, path%value(failure%state), digits)//' (state '// &
            str(failure%state - 1)//'); the last one is at '//swept_text(case, failure%reached, digits)
      end if
      text = text//reason_text(suspension, case, path, failure, kkt)
   end function failure_text

   !> Message about a path followed by arc length that does not reach its end, with the reason.
   function arc_text(case, path, failure) result(text)
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(failure_t), intent(in) :: failure
      character(:), allocatable :: text

      text = 'the path does not reach '//swept_text(case, path%value(failure%state), digits)//' (state '// &
         str(failure%state - 1)//'): '
      select case (failure%ending)
      case (stuck)
         text = text//'it ends at '//swept_text(case, failure%reached, digits)
      case (gone_round)
         text = text//'it is closed and returns to design; the other states are distributed over one circuit of it'
      case (gone_far)
         text = text//'it was followed to '//swept_text(case, failure%reached, digits)//', where a body or the swept '// &
            'value is further from design than in any suspension'
      case default
         text = text//'it was abandoned at '//swept_text(case, failure%reached, digits)//' after '//str(max_steps)//' steps'
      end select
   end function arc_text

   !> Phrase about the singularity at the last equilibrium. If no singularity is found, the phrase names the body that the last
   !> attempt moved most, and the joint with the largest constraint residual. Then follow the stops in contact and, unless joints
   !> lock, the mechanism or the diagnosis.
   function reason_text(suspension, case, path, failure, kkt) result(text)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(failure_t), intent(in) :: failure
      type(kkt_t), intent(inout) :: kkt
      character(:), allocatable :: text
      type(break_t) :: found
      type(diagnosis_t) :: diagnosis
      type(state_t) :: state
      type(inputs_t) :: inputs

      text = ''
      state = design_state(suspension)
      if (allocated(failure%last)) then
         call unpack_state(failure%last, state)
         if (path%is_settled .and. .not. path%is_table) call inputs_at(new_schedule(suspension, case), failure%reached, inputs)
         call why_it_ends(suspension, state, inputs, kkt, found)
         call diagnose(suspension, state, kkt, diagnosis)
      end if
      select case (found%reason)
      case (lock)
         text = '; there the joints '//joint_list(suspension, found%locks)//' lock: they cannot be assembled any further'
      case (limit_point)
         text = '; there the stiffness vanishes (limit point), body '//quoted(body_name(suspension, found%body))// &
            ' moves without resistance'
         if (path%is_settled .and. scales_loads(case) .and. .not. case%follows_arc) text = text// &
            ': drive the travel instead of the load, or follow the path by its arc length (follow = ''arc'')'
      case (mechanism)
         text = '; the matrix is singular there: nothing holds body '//quoted(body_name(suspension, found%body))
      case default
         if (failure%is_singular) text = '; the matrix is singular there'
         if (failure%body > 0) text = text//'; body '//quoted(body_name(suspension, failure%body))// &
            ' moved most in the last attempt ('//str(failure%moved/millimetre, 3)//' mm)'
         if (failure%row > 0) text = text//'; joint '// &
            quoted(suspension%joints(suspension%rows(failure%row)%joint)%name)//' has the largest constraint residual'
      end select
      text = text//half_turn_text(suspension, state)
      text = text//stop_text(suspension, state)
      if (size(suspension%wheels) > 0 .and. .not. has_spring(suspension)) text = text//'; the deck has no spring'
      if (found%reason == lock) return
      if (found%reason == mechanism) then
         text = text//new_line('a')//'mechanism: '//motion_text(suspension, state, kkt, found%motion)
      else if (.not. diagnosis%is_solvable()) then
         text = text//new_line('a')//diagnosis%words()
      end if
   end function reason_text

   !> Phrase about a driver or spring whose rotation is at the limit of a rotation measure; '' without one.
   function half_turn_text(suspension, state) result(text)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      character(:), allocatable :: text
      real(wp), parameter :: close = 0.95_wp*pi
      integer :: k

      text = ''
      do k = 1, size(suspension%rows)
         associate (m => suspension%terms(suspension%rows(k)%first)%measure)
            if (m%kind /= rotation .or. .not. suspension%joints(suspension%rows(k)%joint)%is_of_measures) cycle
            if (abs(measure_value(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1))) > close) &
               text = limit_of('joint '//quoted(suspension%joints(suspension%rows(k)%joint)%name), m)
         end associate
      end do
      do k = 1, suspension%scalars
         associate (m => suspension%elements(k)%measure)
            if (m%kind /= rotation) cycle
            if (abs(measure_value(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1))) > close) &
               text = limit_of(element_label(suspension%elements(k)), m)
         end associate
      end do

   contains

      function limit_of(thing, m) result(phrase)
         character(*), intent(in) :: thing
         type(measure_t), intent(in) :: m
         character(:), allocatable :: phrase
         phrase = '; the rotation of '//thing//' is '//str(measure_value(m, state%poses(m%body_i + 1), &
            state%poses(m%body_j + 1))/degree, 4)//' deg, and a rotation is limited to less than 180 deg either way'
      end function limit_of

   end function half_turn_text

   !> The names of joints as a phrase: 'a', 'b' and 'c'.
   function joint_list(suspension, is_named) result(text)
      type(suspension_t), intent(in) :: suspension
      logical, intent(in) :: is_named(:)
      character(:), allocatable :: text
      integer :: named(count(is_named)), k

      named = pack([(k, k=1, size(is_named))], is_named)
      text = ''
      do k = 1, size(named)
         if (k > 1) text = text//trim(merge(' and', ',   ', k == size(named)))//' '
         text = text//quoted(suspension%joints(named(k))%name)
      end do
   end function joint_list

   !> Phrase about the stops in contact and their forces.
   function stop_text(suspension, state) result(text)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      character(:), allocatable :: text
      real(wp), parameter :: felt = 1.0e-3_wp     ! N
      real(wp) :: tension, slope
      integer :: k

      text = ''
      do k = 1, size(suspension%elements)
         associate (spring => suspension%elements(k))
            if (.not. element_kinds(spring%kind)%has_gap) cycle
            call spring_tension(spring, measure_value(spring%measure, state%poses(spring%measure%body_i + 1), &
               state%poses(spring%measure%body_j + 1)), tension, slope)
            if (abs(tension) > felt) text = text//'; '//element_label(spring)//' is in contact ('// &
               str(abs(tension), 4)//' N)'
         end associate
      end do
   end function stop_text

   !> Phrase about the rows of a load table that did not converge: 'row 3 of the table did not converge; …', or 'rows 3, 4, 7 … of
   !> the table, 12 in all, did not converge; …'.
   function row_text(case, path, failure) result(text)
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(failure_t), intent(in) :: failure
      character(:), allocatable :: text
      integer, parameter :: max_named = 10
      character(:), allocatable :: of_table, noun
      integer :: lost(count(.not. path%is_reached)), k, row

      of_table = ' of the table'
      noun = 'row'
      if (has_manoeuvres(case)) then
         of_table = ''
         noun = 'manoeuvre'
      end if
      lost = nint(pack(path%value, .not. path%is_reached))
      text = noun//trim(merge('s', ' ', size(lost) > 1))
      do k = 1, min(size(lost), max_named)
         text = text//trim(merge(', ', '  ', k > 1))//' '//word_of(lost(k))
      end do
      if (size(lost) <= max_named) text = text//of_table
      if (size(lost) > max_named) text = text//' …'//of_table//', '//str(size(lost))//' in all,'
      row = nint(path%value(failure%state))
      text = text//' did not converge; the last equilibrium on the way from '
      if (row == 1) text = text//'design'
      if (row > 1) text = text//noun//' '//word_of(row - 1)
      text = text//' to '//noun//' '//word_of(row)//' is at '//str(100.0_wp*(failure%reached - row + 1), 4)//' %'

   contains

      !> The index of a row of a table; the name of a manoeuvre.
      function word_of(row) result(word)
         integer, intent(in) :: row
         character(:), allocatable :: word

         word = str(row)
         if (has_manoeuvres(case)) word = quoted(row_name(case, row))
      end function word_of

   end function row_text

   !> Phrase about the states of a grid that did not converge: their number, and travel and driver value of the first six.
   function grid_text(suspension, case, path) result(text)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case             !! on the rig
      type(path_t), intent(in) :: path
      character(:), allocatable :: text
      integer, parameter :: max_named = 6
      character(3) :: unit
      integer :: lost(count(.not. path%is_reached)), k

      unit = driver_unit(suspension, case%drive)
      lost = nint(pack(path%value, .not. path%is_reached))
      text = 'no equilibrium at '//str(size(lost))//' of '//plural(path%states, 'state', 'states')//' of the grid:'
      associate (travel => case%actuations(1)%values, steer => case%actuations(size(case%actuations))%values)
         do k = 1, min(size(lost), max_named)
            text = text//trim(merge(', ', '  ', k > 1))//' travel '//str(travel(lost(k))/swept_unit('mm'), 6)//' mm with '// &
               case%drive//' '//str(steer(lost(k))/swept_unit(unit), 6)//' '//trim(unit)
         end do
      end associate
      if (size(lost) > max_named) text = text//', …'
      text = text//'; the others are there. Use a shorter range, or more increments'
   end function grid_text

   !> Adds one warning if a matrix is nearly singular, one warning per limit point and per bifurcation of the path, and one if
   !> states have a negative stiffness. For method 'recursive', only a nearly singular matrix gives a warning.
   subroutine stability_remarks(case, path, remarks)
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(remark_list_t), intent(inout) :: remarks
      integer :: unstable, first, k

      first = minloc(path%pivot_ratio, dim=1, mask=path%is_reached)
      if (first > 0) then
         if (path%pivot_ratio(first) < nearly_singular) call report('the matrix is nearly singular (smallest over largest '// &
            'pivot '//str(path%pivot_ratio(first), 2)//') at ', path%value(first), ' (column near_singular); see elastokin check')
      end if
      if (case%method == 'recursive') return     ! its matrix has no geometric stiffness and shows no instability
      do k = 1, path%limits
         if (path%limit_state(k) > 0) call report('limit point at ', path%limit_place(k), ' (near state '// &
            str(path%limit_state(k) - 1)//'): the path turns back there')
      end do
      do k = 1, path%crossings
         call report('bifurcation at ', path%crossing_place(k), &
            ': another branch of equilibria begins there; the results follow the one whose tangent is continuous')
      end do
      unstable = count(path%is_reached .and. .not. path%is_stable)
      if (unstable == 0) return
      first = findloc(path%is_reached .and. .not. path%is_stable, .true., dim=1)
      call report(plural(unstable, 'state is', 'states are')//' unstable (negative stiffness: over centre or buckled; '// &
         'column stable), the first at ', path%value(first), '')

   contains

      !> Adds a warning on stability at a swept value.
      subroutine report(before, place, after)
         character(*), intent(in) :: before, after
         real(wp), intent(in) :: place
         call remarks%add(warning, on_stability, case, before//swept_text(case, place, digits)//after, place)
      end subroutine report

   end subroutine stability_remarks

end module ek_failure_text
