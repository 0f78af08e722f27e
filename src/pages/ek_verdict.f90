!> The assessment of a report: one line per domain of an axle with its main key numbers, their meaning, and their place in their
!> ranges. The range is the target of the deck (&target_band), or else the usual range of the class of the axle (ek_usual_range). A
!> number outside or at the edge of its range has a line of its own, before the others.
module ek_verdict
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str, plural
   use ek_gradient, only: is_of_springs
   use ek_key_number, only: key_number_t, has_value
   use ek_number_words, only: short_name, is_equal, is_opposite, sides_text
   use ek_usual_range, only: word_length, inside, neutral_band
   use ek_assessment, only: assessment_t, assess, assessment_words, meaning_of, kind_words, number_named, is_judged, rank_of
   use ek_summary, only: slope_at_design
   use ek_explanation, only: cause_of
   use ek_load_state, only: differ, stand_text
   use ek_table, only: column_index
   use ek_test_result, only: test_result_t, design_row
   use ek_page, only: page_number
   use ek_json, only: json_t, json_string
   use ek_letters, only: as_utf8
   use ek_report_content, only: report_t
   use ek_tilt_verdict, only: judge_tilts
   implicit none(type, external)
   private
   public :: verdict_t, verdict_lines, add_assessment, plain

   !> One line of the verdict.
   type :: verdict_t
      character(24) :: domain = ''
      character(:), allocatable :: text
      character(word_length) :: verdict = ''   !! 'outside', 'at the edge' or 'inside' of a range; '': no number has a range
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

contains

   !> Lists the lines, first those outside and at the edge of their ranges: start state if the deck does not hold it, class of the
   !> axle, incomplete tests, load at design, heights of the tests if they differ, domains, tilt of joints, largest load. A line is
   !> omitted if the report does not have its numbers.
   subroutine verdict_lines(report, lines)
      type(report_t), intent(in) :: report
      type(verdict_t), allocatable, intent(out) :: lines(:)
      type(verdict_t) :: line
      integer :: d

      allocate (lines(0))
      if (allocated(report%start)) call add_fact('start state', report%start)
      if (size(report%numbers) > 0) call add_fact('axle', kind_words(report%axle))
      call add_fact('tests', tests_words(report%incomplete, size(report%tests)))
      call add_fact('load state', load_state(report%numbers))
      call add_fact('heights', heights_text(report%tests))
      do d = 1, size(domains)
         call judge(report, domains(d), lines)
      end do
      if (allocated(report%tilts)) then
         line%domain = 'tilt of joints'
         call judge_tilts(report%tilts, report%tests, line%text, line%verdict)
         if (line%text /= '') call append(lines, line)
      end if
      call add_fact('loads', largest_load(report))
      call sort_lines(lines)

   contains

      !> Adds a line without a verdict, unless it is empty.
      subroutine add_fact(domain, text)
         character(*), intent(in) :: domain, text
         type(verdict_t) :: fact

         fact%domain = domain
         fact%text = text
         if (text /= '') call append(lines, fact)
      end subroutine add_fact

   end subroutine verdict_lines

   !> The tests as a phrase: 'all 13 complete', or '2 of 13 incomplete'.
   pure function tests_words(incomplete, tests) result(words)
      integer, intent(in) :: incomplete, tests
      character(:), allocatable :: words

      words = str(tests)//' complete'
      if (tests > 1) words = 'all '//words
      if (incomplete > 0) words = str(incomplete)//' of '//str(tests)//' incomplete'
   end function tests_words

   !> Moves the lines outside and at the edge of their ranges to the front; lines of equal rank keep their order.
   subroutine sort_lines(lines)
      type(verdict_t), allocatable, intent(inout) :: lines(:)
      type(verdict_t), allocatable :: sorted(:)
      integer :: rank, k, used

      allocate (sorted(size(lines)))
      used = 0
      do rank = 1, rank_of(inside)
         do k = 1, size(lines)
            if (min(rank_of(lines(k)%verdict), rank_of(inside)) /= rank) cycle
            used = used + 1
            sorted(used) = lines(k)
         end do
      end do
      call move_alloc(sorted, lines)
   end subroutine sort_lines

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
         if (.not. (tests(t)%is_run .and. allocated(tests(t)%prefixes))) cycle
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

   !> Adds the lines of a domain: one for each number that is outside or at the edge of its range, and one for the other numbers.
   subroutine judge(report, domain, lines)
      type(report_t), intent(in) :: report
      type(domain_t), intent(in) :: domain
      type(verdict_t), allocatable, intent(inout) :: lines(:)
      type(verdict_t) :: line, one
      integer :: n, used

      line%domain = domain%name
      line%text = ''
      one%domain = domain%name
      used = 0
      do n = 1, size(domain%numbers)
         if (domain%numbers(n) == '' .or. used == domain%most) exit
         if (.not. is_judged(domain%numbers(n), report%axle)) cycle
         call speak_of(report, domain%numbers(n), one%text, one%verdict)
         if (one%text == '') cycle
         used = used + 1
         if (rank_of(one%verdict) < rank_of(inside)) then
            call append(lines, one)
            cycle
         end if
         if (line%text /= '') line%text = line%text//'; '
         line%text = line%text//one%text
         call join_reasons(line%text)
         if (one%verdict /= '') line%verdict = one%verdict
      end do
      if (line%text /= '') call append(lines, line)
   end subroutine judge

   !> Creates the string of a key number by its name: its value, or the reason of a missing value; '' if the report has neither.
   subroutine speak_of(report, name, words, verdict)
      type(report_t), intent(in) :: report
      character(*), intent(in) :: name
      character(:), allocatable, intent(out) :: words
      character(word_length), intent(out) :: verdict
      integer :: k

      words = ''
      verdict = ''
      do k = 1, size(report%numbers)
         if (report%numbers(k)%name /= name) cycle
         call speak(report%numbers(k), report, words, verdict)
         if (words /= '') return
         exit
      end do
      if (.not. allocated(report%missing)) return
      do k = 1, size(report%missing)
         if (report%missing(k)%name /= name) cycle
         words = reason_of(report%missing(k))
         return
      end do
   end subroutine speak_of

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

   !> The reason of a missing value: 'no value of ride frequency (…)'; '' if nobody expects the number, or without a reason.
   function reason_of(number) result(words)
      type(key_number_t), intent(in) :: number
      character(:), allocatable :: words

      words = ''
      if (.not. allocated(number%reason)) return
      if (is_of_springs(number%reason)) return
      words = 'no value of '//without_capital(short_name(number))//' ('//number%reason//')'
   end function reason_of

   !> Creates the string of a key number: 'bump toe −2.470 deg/m: toe-out in bump, roll understeer 1.5 %, usual for the front axle of a
   !> car (−10 … −2)'. Its reason is the element that contributes more than half. A response to braking that is mostly wheel travel
   !> has the number at held wheel height first.
   subroutine speak(number, report, words, verdict)
      type(key_number_t), intent(in) :: number
      type(report_t), intent(in) :: report
      character(:), allocatable, intent(out) :: words
      character(word_length), intent(out) :: verdict
      type(assessment_t) :: assessment
      character(:), allocatable :: parts
      logical :: is_explained
      integer :: k

      verdict = ''
      words = ''
      if (.not. has_value(number)) then
         words = reason_of(number)
         return
      end if
      k = 0
      if (.not. number%has_target) k = held_number(number, report%numbers)
      if (k > 0) then
         words = without_capital(short_name(number))//' '//value_words(report%numbers(k))//' at constant wheel height'
         parts = meaning_of(report%numbers(k), report%axle, report%numbers)
         if (parts /= '') words = words//': '//parts
         words = words//' ('//value_words(number)//' at constant vertical force, which includes the travel of the wheel)'
         return
      end if
      call assess(number, report%axle, report%numbers, assessment)
      verdict = assessment%word
      parts = meaning_of(number, report%axle, report%numbers)
      is_explained = allocated(report%explanations) .and. parts /= 'neutral'
      call add_part(assessment_words(number, report%axle, assessment))
      if (is_explained) call add_part(cause_of(report%explanations, slope_at_design(number%name)))
      words = without_capital(short_name(number))//' '//value_words(number)
      if (parts /= '') words = words//': '//parts

   contains

      !> Adds a phrase after a comma; adds nothing if it is empty.
      subroutine add_part(part)
         character(*), intent(in) :: part

         if (parts /= '' .and. part /= '') parts = parts//', '
         parts = parts//part
      end subroutine add_part

   end subroutine speak

   !> The value of a key number with its unit; 'left 3.1, right 3.3 N/mm' if the wheels differ.
   function value_words(number) result(words)
      type(key_number_t), intent(in) :: number
      character(:), allocatable :: words

      if (number%is_of_axle .or. is_equal(number) .or. .not. ieee_is_finite(number%right)) then
         words = page_number(number%left)
      else if (is_opposite(number)) then
         words = page_number(number%left)
         if (index(sides_text(number), 'left; ') == 1) words = 'left '//words//', right '//page_number(number%right)
      else
         words = 'left '//page_number(number%left)//', right '//page_number(number%right)
      end if
      if (number%unit /= '–') words = words//' '//number%unit
   end function value_words

   !> The index of the response at held wheel height, if a response to braking at held vertical force consists mostly of wheel travel:
   !> the two differ by more than half. 0 otherwise.
   pure integer function held_number(number, numbers) result(k)
      type(key_number_t), intent(in) :: number, numbers(:)
      real(wp) :: values(2)          ! at held vertical force, at held height; of the left wheel if it has both

      select case (number%name)
      case ('braking_deflection')
         k = number_named(numbers, 'braking_height_held_deflection_mm_per_kn')
      case ('braking_steer')
         k = number_named(numbers, 'braking_height_held_steer_deg_per_kn')
      case default
         k = 0
      end select
      if (k == 0) return
      values = [number%left, numbers(k)%left]
      if (.not. all(ieee_is_finite(values))) values = [number%right, numbers(k)%right]
      if (.not. all(ieee_is_finite(values))) then
         k = 0
      else if (abs(values(1) - values(2)) <= max(0.5_wp*abs(values(1)), neutral_band(number%unit))) then
         k = 0
      end if
   end function held_number

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
            text = 'largest rack force '//page_number(report%numbers(k)%left)//' N'
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

   !> Adds the lines as the JSON list 'assessment': domain, text and verdict of each.
   subroutine add_assessment(json, report)
      type(json_t), intent(inout) :: json
      type(report_t), intent(in) :: report
      type(verdict_t), allocatable :: lines(:)
      integer :: k

      call verdict_lines(report, lines)
      call json%open('[', 'assessment')
      do k = 1, size(lines)
         call json%open('{')
         call json%item('domain', json_string(trim(lines(k)%domain)))
         call json%item('text', json_string(as_utf8(lines(k)%text)))
         call json%item('verdict', json_string(trim(lines(k)%verdict)))
         call json%close('}')
      end do
      call json%close(']')
   end subroutine add_assessment

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
