!> The verdict of a report: one line per domain of an axle, with its main key numbers and whether they are inside their bands. A
!> band is the target of the deck (&target_band), or else the usual range of road vehicles (ek_plausible_range). A key number
!> without either has no verdict.
module ek_verdict
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str, plural
   use ek_gradient, only: is_of_springs
   use ek_key_number, only: key_number_t, has_value
   use ek_number_words, only: steer_effect, target_verdict, short_name, is_equal, is_opposite, sides_text
   use ek_plausible_range, only: size_t, usual_range
   use ek_load_state, only: differ, stand_text
   use ek_table, only: column_index
   use ek_test_result, only: test_result_t, design_row
   use ek_page, only: page_number
   use ek_report_content, only: report_t
   use ek_tilt_verdict, only: judge_tilts
   implicit none(type, external)
   private
   public :: verdict_t, verdict_lines, plain

   !> One line of the verdict.
   type :: verdict_t
      character(24) :: domain = ''
      character(:), allocatable :: text
      character(7) :: verdict = ''          !! 'inside': all numbers with a band; 'outside': at least one; '': no band
   end type verdict_t

   !> The key numbers of a domain in order. The first `most` key numbers that the report has are shown.
   type :: domain_t
      character(24) :: name
      integer :: most
      character(36) :: numbers(4)
   end type domain_t

   type(domain_t), parameter :: domains(*) = [ &
      domain_t('ride', 3, [character(36) :: 'wheel_rate', 'ride_frequency_hz', 'bump_camber', '']), &
      domain_t('roll', 3, [character(36) :: 'roll_centre_height_mm', 'suspension_roll_rate_nm_per_deg', 'wheel_roll_steer', '']), &
      domain_t('steer', 3, [character(36) :: 'bump_toe', 'steering_ratio', 'smallest_turning_circle_m', '']), &
      domain_t('lateral', 2, [character(36) :: 'lateral_force_steer', 'lateral_deflection', '', '']), &
      domain_t('aligning', 1, [character(36) :: 'aligning_torque_steer', '', '', '']), &
      domain_t('longitudinal', 2, [character(36) :: 'braking_deflection', 'braking_steer', '', '']), &
      domain_t('anti-features', 2, [character(36) :: 'anti_dive_percent', 'anti_lift_brake_percent', 'anti_squat_percent', &
      'anti_lift_drive_percent'])]

   !> Tests whose design states have the same heights of the wheels, with the loads of the first of these tests.
   type :: stand_t
      integer :: tests = 0, wheels = 0
      real(wp) :: heights(2) = 0.0_wp, loads(2) = 0.0_wp      !! wheel travel [mm], vertical force [N]
   end type stand_t

   !> Key numbers with a usual range, and the quantities of these ranges.
   character(*), parameter :: numbers_with_range(*) = [character(36) :: 'wheel_rate', 'ride_frequency_hz', 'bump_toe', &
      'bump_camber']
   character(*), parameter :: range_rows(*) = [character(28) :: 'wheel rate', 'ride frequency', 'bump toe', 'bump camber']

contains

   !> Lists the lines: start state if the deck does not hold it, incomplete tests, load at design, heights of the tests if they
   !> differ, one line per domain, tilt of joints, largest load. A line is omitted if the report does not have the numbers of this
   !> line.
   subroutine verdict_lines(report, lines)
      type(report_t), intent(in) :: report
      type(verdict_t), allocatable, intent(out) :: lines(:)
      type(verdict_t) :: line
      integer :: d

      allocate (lines(0))
      if (allocated(report%start)) then
         line%domain = 'start state'
         line%text = report%start
         if (line%text /= '') call append(lines, line)
      end if
      line%domain = 'tests'
      line%text = str(report%incomplete)//' of '//str(size(report%tests))//' incomplete'
      call append(lines, line)
      line%domain = 'load state'
      line%text = load_state(report%numbers)
      if (line%text /= '') call append(lines, line)
      line%domain = 'heights'
      line%text = heights_text(report%tests)
      if (line%text /= '') call append(lines, line)
      do d = 1, size(domains)
         call judge(report, domains(d), line)
         if (line%text /= '') call append(lines, line)
      end do
      if (allocated(report%tilts)) then
         line%domain = 'tilt of joints'
         call judge_tilts(report%tilts, report%tests, line%text, line%verdict)
         if (line%text /= '') call append(lines, line)
      end if
      line%domain = 'loads'
      line%verdict = ''
      line%text = largest_load(report)
      if (line%text /= '') call append(lines, line)
   end subroutine verdict_lines

   subroutine append(lines, line)
      type(verdict_t), allocatable, intent(inout) :: lines(:)
      type(verdict_t), intent(in) :: line
      type(verdict_t), allocatable :: longer(:)

      allocate (longer(size(lines) + 1))
      longer(:size(lines)) = lines
      longer(size(longer)) = line
      call move_alloc(longer, lines)
   end subroutine append

   !> The load at design: '3550 N per wheel', 'left 3550 N, right 3400 N', or 'unloaded axle'; '' if the load is not known.
   function load_state(numbers) result(text)
      type(key_number_t), intent(in) :: numbers(:)
      character(:), allocatable :: text
      real(wp), parameter :: nothing = 0.5_wp       ! N
      real(wp) :: load(2)
      integer :: k

      text = ''
      do k = 1, size(numbers)
         if (numbers(k)%name /= 'vertical_force_n' .or. .not. has_value(numbers(k))) cycle
         load = numbers(k)%left
         if (.not. numbers(k)%is_of_axle .and. ieee_is_finite(numbers(k)%right)) load(2) = numbers(k)%right
         if (.not. ieee_is_finite(load(1))) load(1) = load(2)
         if (maxval(abs(load)) < nothing) then
            text = 'unloaded axle'
         else if (page_number(load(1)) == page_number(load(2))) then
            text = page_number(load(1))//' N per wheel'
         else
            text = 'left '//page_number(load(1))//' N, right '//page_number(load(2))//' N'
         end if
         return
      end do
   end function load_state

   !> The heights and loads in the design states of the tests, if the tests do not stand at one height: '2 tests at 0 mm under
   !> 1786 N, 9 tests at −83.93 mm under 0 N per wheel: numbers of two load states'; '' if the heights are equal or not known.
   function heights_text(tests) result(text)
      type(test_result_t), intent(in) :: tests(:)
      character(:), allocatable :: text
      integer, parameter :: most = 4         ! groups of tests that are listed
      character(*), parameter :: travel = 'wheel_travel_mm', force = 'vertical_force_n'
      type(stand_t) :: groups(most)
      real(wp) :: heights(2)
      integer :: t, w, g, row, wheels, used, at(2, 2)

      text = ''
      used = 0
      do t = 1, size(tests)
         row = design_row(tests(t)%table)
         wheels = size(tests(t)%prefixes)
         if (row == 0 .or. wheels < 1 .or. wheels > 2) cycle
         do w = 1, wheels
            at(1, w) = column_index(tests(t)%table, trim(tests(t)%prefixes(w))//travel)
            at(2, w) = column_index(tests(t)%table, trim(tests(t)%prefixes(w))//force)
         end do
         if (any(at(:, :wheels) == 0)) cycle
         heights(:wheels) = tests(t)%table%values(at(1, :wheels), row)
         if (.not. all(ieee_is_finite(heights(:wheels)))) cycle
         do g = 1, used
            if (.not. any(differ(groups(g)%heights(:wheels), heights(:wheels)))) exit
         end do
         if (g > most) cycle
         if (g > used) then
            used = g
            groups(g)%heights(:wheels) = heights(:wheels)
            groups(g)%loads(:wheels) = tests(t)%table%values(at(2, :wheels), row)
         end if
         groups(g)%tests = groups(g)%tests + 1
         groups(g)%wheels = wheels
      end do
      if (used < 2) return
      do g = 1, used
         if (g > 1) text = text//', '
         associate (of => groups(g))
            text = text//plural(of%tests, 'test', 'tests')//' at '//stand_text(of%heights(:of%wheels), 'mm')//' under '// &
               stand_text(of%loads(:of%wheels), 'N')
         end associate
      end do
      text = text//' per wheel: numbers of '//str(used)//' load states'
   end function heights_text

   !> Creates the line of a domain. The string of the line is '' if the report has no key number of this domain.
   subroutine judge(report, domain, line)
      type(report_t), intent(in) :: report
      type(domain_t), intent(in) :: domain
      type(verdict_t), intent(out) :: line
      character(:), allocatable :: words
      character(7) :: verdict
      integer :: n, k, used
      logical :: is_spoken

      line%domain = domain%name
      line%text = ''
      used = 0
      do n = 1, size(domain%numbers)
         if (domain%numbers(n) == '' .or. used == domain%most) exit
         is_spoken = .false.
         do k = 1, size(report%numbers)
            if (report%numbers(k)%name /= domain%numbers(n)) cycle
            call speak(report%numbers(k), report%axle, report%vehicle, words, verdict)
            is_spoken = words /= ''
            exit
         end do
         if (.not. is_spoken .and. allocated(report%missing)) then
            do k = 1, size(report%missing)
               if (report%missing(k)%name /= domain%numbers(n)) cycle
               call speak(report%missing(k), report%axle, report%vehicle, words, verdict)
               is_spoken = words /= ''
               exit
            end do
         end if
         if (.not. is_spoken) cycle
         if (used > 0) line%text = line%text//'; '
         line%text = line%text//words
         call join_reasons(line%text)
         if (verdict == 'outside' .or. line%verdict == '') line%verdict = verdict
         used = used + 1
      end do
   end subroutine judge

   !> Joins two numbers at the end of a string that have no value for the same reason: 'no value of a, b (reason)'.
   pure subroutine join_reasons(text)
      character(:), allocatable, intent(inout) :: text
      character(*), parameter :: lost = 'no value of '
      integer :: first, second, reason(2)

      second = index(text, '; '//lost, back=.true.)
      if (second == 0) return
      first = index(text(:second - 1), lost, back=.true.)
      if (first == 0) return
      reason(1) = first - 1 + index(text(first:), ' (')
      reason(2) = second + 1 + index(text(second + 2:), ' (')
      if (text(reason(1):second - 1) /= text(reason(2):)) return
      text = text(:reason(1) - 1)//', '//text(second + 2 + len(lost):)
   end subroutine join_reasons

   !> Creates the string of a key number, '' for a number without a value and without a reason: 'bump camber −13.83 deg/m (inside the target −30 … −20)', or 'lateral force steer 0.108
   !> deg/kN: understeer'.
   subroutine speak(number, axle, vehicle, words, verdict)
      type(key_number_t), intent(in) :: number
      integer, intent(in) :: axle
      type(size_t), intent(in) :: vehicle
      character(:), allocatable, intent(out) :: words
      character(7), intent(out) :: verdict
      character(:), allocatable :: band, unit
      character(48) :: effect

      verdict = ''
      if (.not. has_value(number)) then
         words = ''
         if (allocated(number%reason)) then
            if (is_of_springs(number%reason)) return         ! nobody expects this number
            words = 'no value of '//without_capital(short_name(number))//' ('//number%reason//')'
         end if
         return
      end if
      words = without_capital(short_name(number))
      unit = ''
      if (number%unit /= '–') unit = ' '//number%unit
      if (number%is_of_axle .or. is_equal(number) .or. .not. ieee_is_finite(number%right)) then
         words = words//' '//page_number(number%left)//unit
      else if (is_opposite(number)) then
         words = words//' '//page_number(number%left)//unit//' ('//sides_text(number)//')'
      else
         words = words//' left '//page_number(number%left)//', right '//page_number(number%right)//unit
      end if
      effect = steer_effect(number, axle)
      if (effect /= '') words = words//': '//trim(effect)
      if (is_equal(number) .and. effect == '' .and. index(sides_text(number), 'both wheels to') == 1) &
         words = words//' ('//sides_text(number)//')'
      call find_band(number, vehicle, verdict, band)
      if (verdict /= '') words = words//' ('//trim(verdict)//' '//band//')'
   end subroutine speak

   !> Finds the band of a key number, and the verdict 'inside' or 'outside'. The verdict is '' without a band or a value.
   subroutine find_band(number, vehicle, verdict, band)
      type(key_number_t), intent(in) :: number
      type(size_t), intent(in) :: vehicle
      character(7), intent(out) :: verdict
      character(:), allocatable, intent(out) :: band
      type(key_number_t) :: judged
      logical :: is_known
      integer :: k

      judged = number
      band = 'the target '
      verdict = ''
      if (.not. number%has_target) then
         band = 'the usual range '
         do k = size(numbers_with_range), 1, -1
            if (numbers_with_range(k) == number%name) exit
         end do
         if (k == 0) return
         call usual_range(trim(range_rows(k)), vehicle, judged%target(1), judged%target(2), is_known)
         if (.not. is_known) return
         judged%has_target = .true.
      end if
      verdict = target_verdict(judged)
      if (judged%target(1) <= -huge(1.0_wp)) then
         band = band//'≤ '//short(judged%target(2))
      else if (judged%target(2) >= huge(1.0_wp)) then
         band = band//'≥ '//short(judged%target(1))
      else
         band = band//short(judged%target(1))//' … '//short(judged%target(2))
      end if
   end subroutine find_band

   !> A limit without trailing zeros, with the minus sign of the page.
   pure function short(limit) result(text)
      real(wp), intent(in) :: limit
      character(:), allocatable :: text

      text = str(abs(limit), 4)
      if (limit < 0.0_wp) text = '−'//text
   end function short

   !> Phrase about the largest force on a member if the loads of the members are requested; otherwise about the largest force
   !> on the rack. '' if this force is not known.
   function largest_load(report) result(text)
      type(report_t), intent(in) :: report
      character(:), allocatable :: text
      integer, parameter :: resultant = 4
      real(wp), parameter :: nothing = 1.0e-6_wp    ! N: links without load
      integer :: e, k

      text = ''
      if (.not. allocated(report%loads)) then
         do k = 1, size(report%numbers)
            if (report%numbers(k)%name /= 'largest_rack_force_n' .or. .not. has_value(report%numbers(k))) cycle
            text = 'largest rack force '//page_number(report%numbers(k)%left)//' N; --loads adds the members'
         end do
         return
      end if
      if (size(report%loads%ends) == 0) return
      e = maxloc(report%loads%peaks(resultant, :size(report%loads%ends)), dim=1)
      if (report%loads%case(resultant, e) == 0 .or. .not. report%loads%peaks(resultant, e) > nothing) return
      text = 'largest force on a member '//page_number(report%loads%peaks(resultant, e))//' N: '// &
         trim(report%loads%ends(e)%member)//' at '//trim(report%loads%ends(e)%point)//', '// &
         trim(report%loads%cases(report%loads%case(resultant, e)))
   end function largest_load

   !> A line of the verdict for a terminal, with hyphens as minus signs.
   pure function plain(text) result(ascii)
      character(*), intent(in) :: text
      character(:), allocatable :: ascii
      character(*), parameter :: minus = '−'
      integer :: at

      ascii = text
      do
         at = index(ascii, minus)
         if (at == 0) exit
         ascii = ascii(:at - 1)//'-'//ascii(at + len(minus):)
      end do
   end function plain

   !> A title in the middle of a sentence: 'bump toe' for 'Bump toe'; an abbreviation keeps its capitals.
   pure function without_capital(title) result(words)
      character(*), intent(in) :: title
      character(:), allocatable :: words

      words = title
      if (words(2:2) < 'A' .or. words(2:2) > 'Z') words(1:1) = lowered(words(1:1))
   end function without_capital

   pure character(1) function lowered(letter)
      character(1), intent(in) :: letter
      lowered = letter
      if (letter >= 'A' .and. letter <= 'Z') lowered = achar(iachar(letter) + 32)
   end function lowered

end module ek_verdict
