!> The load states of tests. Tests of travel and steering hold the wheels at the height of the design position. In all other
!> tests, the wheels settle under the constant loads of the deck. The heights differ if the springs do not carry these loads in the
!> design position (`free_length` or `preload` in the deck, no preload trim, changed loads). The numbers of both kinds of tests
!> then belong to two load states.
module ek_load_state
   use ek_kinds, only: wp, millimetre
   use ek_error, only: message_list_t
   use ek_text, only: str, quoted
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable
   use ek_rig_test, only: rig_test_t, rig_test, moves_heights, rolls
   use ek_rig, only: mounted_case_t, mount_case
   use ek_state, only: state_t, inputs_t, design_state
   use ek_reach, only: settle, failure_t
   use ek_attitude, only: attitude_t, wheel_attitude, vertical_force
   implicit none(type, external)
   private
   public :: holds_height, load_state_remarks, stand_text, differ

   real(wp), parameter :: noticeable = 0.1_wp       !! mm: smaller differences of heights do not change a number noticeably

contains

   !> Whether a case holds the wheels at the height of the design position, or moves them from this height.
   pure logical function holds_height(case)
      type(case_t), intent(in) :: case
      type(rig_test_t) :: test

      holds_height = case%drive == 'wheel_travel'
      if (len(case%test) == 0) return
      test = rig_test(case%test)
      holds_height = test%control /= 'force' .and. test%action /= rolls
      if (case%vertical /= '') holds_height = case%vertical /= 'force' .and. test%action /= rolls
   end function holds_height

   !> Warns if the cases do not stand at one height before a load or a travel is applied. No warning is added without a case of each
   !> kind, for method 'recursive', and if no equilibrium is found under the constant loads.
   subroutine load_state_remarks(suspension, cases, words)
      type(suspension_t), intent(in) :: suspension       !! with trimmed preloads; on no rig
      type(case_t), intent(in) :: cases(:)
      type(message_list_t), intent(inout) :: words
      real(wp), allocatable :: heights(:), loads(:), unused(:), held(:)
      integer :: k, driven, free
      logical :: is_known

      driven = 0
      free = 0
      do k = size(cases), 1, -1
         if (.not. is_mountable(cases(k)) .or. cases(k)%method == 'recursive') cycle
         if (holds_height(cases(k))) driven = k
         if (.not. holds_height(cases(k))) free = k
      end do
      if (driven == 0 .or. free == 0 .or. size(suspension%wheels) == 0) return
      call find_stand(suspension, cases(free), heights, loads, is_known)
      if (.not. is_known) return
      if (.not. maxval(abs(heights)) > noticeable) return
      call find_stand(suspension, cases(driven), unused, held, is_known)
      if (.not. is_known) return
      call words%add('the tests stand at two heights: '//quoted(cases(driven)%name)//' and all tests that hold the wheels at '// &
         'design stand under '//stand_text(held, 'N')//' per wheel; in '//quoted(cases(free)%name)//' and all tests that hold '// &
         'the loads, the wheels settle to a travel of '//stand_text(heights, 'mm')//' under the loads of the deck, '// &
         stand_text(loads, 'N')//' per wheel. Their numbers belong to two load states; loads that hold the design position, '// &
         'or balance = ''spring'', give one')
   end subroutine load_state_remarks

   !> Finds the heights and the vertical forces of the wheels in a case before a load or a travel is applied.
   subroutine find_stand(suspension, case, heights, loads, is_known)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      real(wp), allocatable, intent(out) :: heights(:), loads(:)     !! wheel travel [mm], vertical force [N] of each wheel
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
