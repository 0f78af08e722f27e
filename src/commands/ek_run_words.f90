!> Messages of `run` on its results: settling, preloads, drift, springs, contact points, large travel.
module ek_run_words
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_units, only: degree, millimetre
   use ek_text, only: str, quoted, plural
   use ek_element, only: element_kinds, element_label, axial_spring, torsion_spring
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_state, only: state_t, design_state, unpack_state
   use ek_kkt, only: kkt_t
   use ek_path, only: path_t
   use ek_table, only: table_t, column, row_count
   use ek_attitude, only: attitude_t, wheel_attitude
   use ek_sweep_table, only: factor_unit
   use ek_drift, only: drift_t, drift_at
   use ek_arguments, only: arguments_t
   use ek_words, only: say, warn
   implicit none(type, external)
   private
   public :: say_settled, settled_words, say_preloads, warn_of_drift, warn_of_travel, has_spring
   public :: patch_words, spring_words, rack_words, open_words, add_line

contains

   !> Adds a line to a text; an empty line adds nothing.
   pure subroutine add_line(words, line)
      character(:), allocatable, intent(inout) :: words
      character(*), intent(in) :: line

      if (len(line) == 0) return
      if (len(words) > 0) words = words//new_line('a')
      words = words//line
   end subroutine add_line

   !> Reports the displacement of the wheels under the constant loads.
   subroutine say_settled(arguments, suspension, case, path)
      type(arguments_t), intent(in) :: arguments
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(message_list_t) :: words
      real(wp), parameter :: noticeable = 1.0e-8_wp      ! m
      integer :: k

      call settled_words(suspension, case, path, noticeable, words)
      do k = 1, words%count()
         call say(arguments%quiet, 'case '//quoted(case%name)//': '//words%line(k))
      end do
   end subroutine say_settled

   !> One message per wheel that the constant loads have displaced by more than `least`.
   subroutine settled_words(suspension, case, path, least, words)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      real(wp), intent(in) :: least                      !! m
      type(message_list_t), intent(out) :: words
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
         call words%add('under the constant loads wheel '//quoted(suspension%wheels(k)%name)//' settles by '// &
            str(attitude%centre(3)/millimetre, 4)//' mm (toe '//str((attitude%toe)/degree, 4)//' deg, camber '// &
            str(attitude%camber/degree, 4)//' deg there)')
      end do
   end subroutine settled_words

   !> Warns of a contact point that is not where a wheel of this radius touches the ground. Tests and compliance matrix both
   !> use the contact point of the deck, so that an error in it affects both.
   subroutine patch_words(suspension, words)
      type(suspension_t), intent(in) :: suspension
      type(message_list_t), intent(inout) :: words
      real(wp), parameter :: much = 0.02_wp      ! share of the radius; the camber of a real wheel moves the point by half of this
      real(wp) :: down(3), off
      integer :: k

      do k = 1, size(suspension%wheels)
         associate (w => suspension%wheels(k))
            down = [0.0_wp, 0.0_wp, -1.0_wp] + w%spin(3)*w%spin                        ! in the plane of the wheel
            down = down/max(norm2(down), 0.1_wp)
            off = min(norm2(w%contact - w%centre - w%radius*down), &
               norm2(w%contact - w%centre + w%radius*[0.0_wp, 0.0_wp, 1.0_wp]))
            if (off <= much*w%radius) cycle
            call words%add('wheel '//quoted(w%name)//': its contact point is '//str(off/millimetre, 3)// &
               ' mm away from the point where a wheel of radius '//str(w%radius/millimetre, 4)//' mm touches the ground; all '// &
               'forces at the contact patch act at the contact point')
         end associate
      end do
   end subroutine patch_words

   !> Whether the deck has a spring that carries the car: a spring, or a torsion spring against the chassis.
   pure logical function has_spring(suspension)
      type(suspension_t), intent(in) :: suspension
      integer :: k

      has_spring = .false.
      do k = 1, size(suspension%elements)
         associate (kind => suspension%elements(k)%kind, m => suspension%elements(k)%measure)
            has_spring = has_spring .or. element_kinds(kind)%carries .or. &
               (kind == torsion_spring .and. min(m%body_i, m%body_j) == 0)
         end associate
      end do
   end function has_spring

   !> Warns of a deck without a spring: its equilibrium rests on bushings and stops. Cases that only prescribe a wheel
   !> travel or a driver (kinematics) need no spring.
   subroutine spring_words(suspension, cases, words)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(message_list_t), intent(inout) :: words
      logical :: leads_only
      integer :: k

      if (size(suspension%wheels) == 0 .or. has_spring(suspension)) return
      leads_only = .true.
      do k = 1, size(cases)
         leads_only = leads_only .and. .not. cases(k)%has_all .and. len(cases(k)%drive) > 0
      end do
      if (leads_only) return
      call words%add('the deck has no spring: the wheels are carried by bushings, anti-roll bars and stops alone, '// &
         'and the reported rates are those of these elements')
   end subroutine spring_words

   !> Warns of a steering test that exceeds the travel of the rack.
   subroutine rack_words(suspension, case, words)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(message_list_t), intent(inout) :: words
      real(wp), parameter :: rim = 1.0_wp + 1.0e-9_wp

      if (case%test /= 'steering' .or. .not. suspension%steering%has_steering) return
      if (len(case%drive) > 0 .and. case%drive /= suspension%steering%driver) return
      if (max(abs(case%from), abs(case%to)) <= suspension%steering%travel*rim) return
      call words%add('the rack is moved to '//str(max(abs(case%from), abs(case%to))/millimetre, 4)// &
         ' mm, beyond its travel of '//str(suspension%steering%travel/millimetre, 4)//' mm in &steering')
   end subroutine rack_words

   !> Reports the preloads found by balance.
   subroutine say_preloads(arguments, suspension)
      type(arguments_t), intent(in) :: arguments
      type(suspension_t), intent(in) :: suspension
      integer :: k

      if (suspension%balance == 'none') return
      do k = 1, size(suspension%elements)
         if (suspension%elements(k)%kind /= axial_spring) cycle
         call say(arguments%quiet, 'balance: preload of '//element_label(suspension%elements(k))//' = '// &
            str(suspension%elements(k)%preload, 9)//' N (compression)')
      end do
   end subroutine say_preloads

   !> Compares the linear methods with one equilibrium solution at each end of the sweep.
   !>
   !> `lost` names the end without an equilibrium nearby: the states before it are unreliable.
   subroutine warn_of_drift(suspension, case, path, kkt, lost)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(kkt_t), intent(inout) :: kkt
      character(:), allocatable, intent(out) :: lost    !! '' if both ends have one
      type(drift_t) :: drift
      real(wp), parameter :: much_travel = 1.0e-5_wp     ! m: 0.01 mm, about what a K&C rig resolves
      real(wp), parameter :: much_angle = 1.0e-3_wp*degree
      integer :: k, ends(2), n

      lost = ''
      if (case%method == 'equilibrium' .or. size(suspension%wheels) == 0) return
      ends = [1, path%states]
      do n = 1, 2
         k = ends(n)
         if (.not. path%is_reached(k) .or. k == path%start) cycle
         call drift_at(suspension, case, path, k, kkt, drift)
         if (.not. drift%is_known) then
            call add_line(lost, 'case '//quoted(case%name)//', method '//case%method// &
               ': no equilibrium was found near the state at factor '// &
               str(path%value(k)/factor_unit(suspension, case))// &
               '; the linear method has left the range that the suspension can reach')
         else if (abs(drift%travel) > much_travel .or. max(abs(drift%toe), abs(drift%camber)) > much_angle) then
            call warn('case '//quoted(case%name)//', method '//case%method//': at factor '// &
               str(path%value(k)/factor_unit(suspension, case))//' the state is off equilibrium by '// &
               str(drift%travel/millimetre, 3)//' mm travel, '//str(drift%toe/degree, 3)//' deg toe, '// &
               str(drift%camber/degree, 3)//' deg camber'//advice(case))
         end if
      end do
   end subroutine warn_of_drift

   !> Message on states of a linear method that are marked converged = 0 because they violate the joint constraints;
   !> '' if there are none.
   function open_words(case, table) result(words)
      type(case_t), intent(in) :: case
      type(table_t), intent(in) :: table         !! of sweep_table
      character(:), allocatable :: words
      real(wp) :: gap(row_count(table))
      logical :: is_open(row_count(table))

      words = ''
      gap = column(table, 'constraint_error')
      is_open = ieee_is_finite(gap) .and. column(table, 'converged') < 0.5_wp
      if (.not. any(is_open)) return
      words = 'case '//quoted(case%name)//', method '//case%method//': '//plural(count(is_open), &
         'state violates', 'states violate')//' the joint constraints (constraint_error up to '// &
         str(maxval(gap, mask=is_open), 2)//' m or rad) and '// &
         trim(merge('is ', 'are', count(is_open) == 1))//' marked converged = 0; use more increments, or method ''equilibrium'''
   end function open_words

   !> Advice on drift.
   pure function advice(case) result(text)
      type(case_t), intent(in) :: case
      character(:), allocatable :: text
      text = '; more increments reduce it'
      if (case%method == 'recursive') text = ' (the bias of this method; more increments do not remove it, '// &
         'method = ''equilibrium'' has none)'
   end function advice

   !> Warns of a load that moves a wheel further than any suspension travels: a rate is missing or has the wrong unit.
   subroutine warn_of_travel(suspension, case, path)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(state_t) :: state
      type(attitude_t) :: attitude
      character(:), allocatable :: advice
      real(wp), parameter :: far = 0.25_wp      ! m: half as much again as the travel of an off-road car
      integer :: k, w, ends(2), n

      if (len(case%drive) > 0) return           ! the deck prescribes the travel of a driven wheel
      if (allocated(case%courses)) then
         do k = 1, size(case%courses)
            if (len(case%courses(k)%load) > 0) exit
         end do
         if (k > size(case%courses)) return
      end if
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
            call warn('case '//quoted(case%name)//': at factor '//str(path%value(k)/factor_unit(suspension, case))//' wheel '// &
               quoted(suspension%wheels(w)%name)//' has moved by '//str(norm2(attitude%centre)/millimetre, 3)//' mm'//advice)
            return
         end do
      end do
   end subroutine warn_of_travel

end module ek_run_words
