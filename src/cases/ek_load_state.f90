!> The load states of tests. All tests of a report start from one state (ek_start), which these procedures describe. A case that
!> names a load or a driver of its own begins at design: with the wheels held there, or under the constant loads of the deck
!> alone. Its numbers may then belong to another load state than the numbers of the tests.
module ek_load_state
   use ek_kinds, only: wp, millimetre
   use ek_noise, only: is_noise, solved
   use ek_error, only: message_list_t
   use ek_text, only: str, quoted
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable, default_tolerance
   use ek_manoeuvre, only: standing_load
   use ek_rig, only: mounted_case_t, mount_case, counts_from_start
   use ek_start, only: needed_force
   use ek_state, only: state_t, inputs_t, design_state
   use ek_reach, only: settle, failure_t
   use ek_attitude, only: attitude_t, wheel_attitude, vertical_force
   implicit none(type, external)
   private
   public :: load_state_remarks, start_text, start_line, stand_text, differ

   real(wp), parameter :: noticeable = 0.1_wp       !! mm: smaller differences of heights do not change a number noticeably

   ! kinds of starts of cases
   integer, parameter :: by_start = 1, by_height = 2, by_loads = 3

contains

   !> Warns if the tests start from a state that neither the preload trim nor the loads of the deck hold at design height, and if
   !> the cases do not stand at one height before a load or a travel is applied. Nothing is added for method 'recursive', and if
   !> no equilibrium is found under the constant loads.
   subroutine load_state_remarks(suspension, cases, words)
      type(suspension_t), intent(in) :: suspension       !! with trimmed preloads and start state; on no rig
      type(case_t), intent(in) :: cases(:)
      type(message_list_t), intent(inout) :: words
      real(wp), allocatable :: heights(:), loads(:), first_heights(:), first_loads(:)
      character(:), allocatable :: text
      integer :: k, kind, first, found(by_start:by_loads)
      logical :: is_known

      if (size(suspension%wheels) == 0) return
      found = 0
      do k = size(cases), 1, -1
         if (.not. is_mountable(cases(k)) .or. cases(k)%method == 'recursive') cycle
         found(kind_of_start(cases(k))) = k
      end do
      if (found(by_start) > 0) then
         text = start_text(suspension)
         if (text /= '') call words%add(text)
      end if
      first = 0
      do kind = by_start, by_loads
         if (found(kind) == 0) cycle
         call find_stand(suspension, cases(found(kind)), heights, loads, is_known)
         if (.not. is_known) cycle
         if (first == 0) then
            first = found(kind)
            first_heights = heights
            first_loads = loads
         else if (maxval(abs(heights - first_heights)) > noticeable) then
            call words%add('the cases stand at two heights: '//stand_of(cases(first), first_heights, first_loads)//'; '// &
               stand_of(cases(found(kind)), heights, loads)//'. Their numbers belong to two load states; loads that hold the '// &
               'design position, or balance = ''spring'', give one')
         end if
      end do
   end subroutine load_state_remarks

   !> How a case begins.
   pure integer function kind_of_start(case) result(kind)
      type(case_t), intent(in) :: case

      kind = by_loads
      if (counts_from_start(case)) then
         kind = by_start
      else if (case%drive == 'wheel_travel') then
         kind = by_height
      end if
   end function kind_of_start

   !> The height and the load of the wheels before a case begins: ''travel' begins at a travel of 0 mm under 1786 N per wheel'.
   function stand_of(case, heights, loads) result(text)
      type(case_t), intent(in) :: case
      real(wp), intent(in) :: heights(:), loads(:)
      character(:), allocatable :: text
      text = quoted(case%name)//' begins at a travel of '//stand_text(heights, 'mm')//' from design under '// &
         stand_text(loads, 'N')//' per wheel'
   end function stand_of

   !> The start state of the tests: 'design height needs 1786 N per wheel; the deck's loads are 0 N; all tests start at design
   !> height, where the rig carries the difference'. '' if the deck holds the design height and the tests start there. If no start
   !> state was found, the text says this.
   function start_text(suspension) result(text)
      type(suspension_t), intent(in) :: suspension       !! with trimmed preloads and start state; on no rig
      character(:), allocatable :: text
      real(wp), dimension(size(suspension%wheels)) :: own, added, rise
      real(wp), allocatable :: needed(:)
      logical :: is_known, has_moved
      integer :: k

      text = ''
      if (suspension%start == '' .or. size(suspension%wheels) == 0) return
      added = 0.0_wp
      do k = 1, size(suspension%loads)
         if (suspension%loads(k)%start_of > 0) added(suspension%loads(k)%start_of) = suspension%loads(k)%force(3)
      end do
      own = [(standing_load(suspension, k), k=1, size(own))] - added
      rise = suspension%wheels%start_rise(1)
      has_moved = any(abs(added) > 0.0_wp) .or. any(abs(rise) > 0.0_wp)
      needed = own + added
      is_known = .true.
      if (any(abs(rise) > 0.0_wp) .or. .not. has_moved) call needed_force(suspension, default_tolerance, needed, is_known)
      if (.not. has_moved) then
         if (.not. is_known) return
         if (all([(is_noise(needed(k) - own(k), 'vertical_force_n', abs(needed(k)), solved), k=1, size(own))])) return
      end if
      if (is_known) then
         text = 'design height needs '//stand_text(needed, 'N')//' per wheel; the deck''s loads are '//stand_text(own, 'N')
      else
         text = 'the deck''s loads are '//stand_text(own, 'N')
      end if
      if (suspension%state /= '') text = 'load state '//quoted(suspension%state)//': '//text
      if (.not. has_moved) then
         text = text//'; no start state was found, so that tests that hold the wheels start at design height, and other tests '// &
            'have values only where the wheels settle under these loads'
      else if (suspension%start == 'loads') then
         text = text//'; all tests start where the wheels settle under them, '//stand_text(rise/millimetre, 'mm')// &
            ' from design height'
      else if (any(abs(rise) > 0.0_wp)) then
         text = text//'; all tests start '//stand_text(rise/millimetre, 'mm')//' from design height under '// &
            stand_text(own + added, 'N')//' per wheel'
      else
         text = text//'; all tests start at design height, where the rig carries the difference'
      end if
   end function start_text

   !> The line on the start state in the table of a case: 'start state: wheels 20 mm from design height, where wheel travel is 0;
   !> the rig adds 500 N per wheel'. '' if the case starts at design without an added force.
   function start_line(suspension) result(text)
      type(suspension_t), intent(in) :: suspension       !! with start state, on the rig of the case
      character(:), allocatable :: text
      real(wp), dimension(size(suspension%wheels)) :: added, rise
      integer :: k

      text = ''
      if (size(suspension%wheels) == 0) return
      added = 0.0_wp
      do k = 1, size(suspension%loads)
         if (suspension%loads(k)%start_of > 0) added(suspension%loads(k)%start_of) = suspension%loads(k)%force(3)
      end do
      rise = suspension%wheels%start_rise(1)
      if (.not. (any(abs(added) > 0.0_wp) .or. any(abs(rise) > 0.0_wp))) return
      text = 'start state: wheels '//stand_text(rise/millimetre, 'mm')//' from design height, where wheel travel is 0; '// &
         'the rig adds '//stand_text(added, 'N')//' per wheel'
   end function start_line

   !> Finds the heights and the vertical forces of the wheels in a case before a load or a travel is applied.
   subroutine find_stand(suspension, case, heights, loads, is_known)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      real(wp), allocatable, intent(out) :: heights(:), loads(:)     !! travel from design [mm], vertical force [N] of each wheel
      logical, intent(out) :: is_known
      type(mounted_case_t) :: mounted
      type(state_t) :: state
      type(failure_t) :: failure
      type(attitude_t) :: attitude
      integer :: k

      allocate (heights(size(suspension%wheels)), loads(size(suspension%wheels)))
      call mount_case(suspension, case, mounted)
      state = design_state(mounted%suspension)
      call settle(mounted%suspension, mounted%case%tolerance, state, mounted%kkt, failure)
      is_known = failure%state == 0
      if (.not. is_known) return
      do k = 1, size(heights)
         attitude = wheel_attitude(mounted%suspension, state, k)
         heights(k) = attitude%centre(3)/millimetre
         loads(k) = vertical_force(mounted%suspension, state, inputs_t(), k)
      end do
   end subroutine find_stand

   !> Whether numbers of two tests belong to two load states: the travels of a wheel in the design state differ noticeably.
   elemental logical function differ(one, other)
      real(wp), intent(in) :: one, other       !! mm
      differ = abs(one - other) > noticeable
   end function differ

   !> The values of one or two wheels with their unit: '1786 N', or 'left 1786 N, right 1700 N' if they differ.
   function stand_text(values, unit) result(text)
      real(wp), intent(in) :: values(:)
      character(*), intent(in) :: unit
      character(:), allocatable :: text

      text = shown(values(1))//' '//unit
      if (size(values) /= 2) return
      if (shown(values(1)) /= shown(values(2))) text = 'left '//text//', right '//shown(values(2))//' '//unit
   end function stand_text

   !> A number with four digits, without a negative zero and without rounding noise.
   function shown(value) result(text)
      real(wp), intent(in) :: value
      character(:), allocatable :: text
      real(wp), parameter :: nothing = 5.0e-4_wp

      text = '0'
      if (abs(value) > nothing) text = str(value, 4)
   end function shown

end module ek_load_state
