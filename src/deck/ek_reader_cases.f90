!> &case: the load or motion applied to the wheels or to any driver, or a test of the rig, which ek_rig mounts.
module ek_reader_cases
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted
   use ek_units, only: millimetre
   use ek_rig_test, only: rig_test_t, rig_tests, needs_both, of_one_wheel, lifts, rolls, steers, loads_wheels, takes_table
   use ek_case, only: case_t, method_names, follow_names, most_increments
   use ek_record, only: value_t, right_side, element, is_given, own_name
   use ek_namelist, only: value_fault
   use ek_realise, only: steepest_roll
   use ek_blueprint, only: case_plan_t
   use ek_group, only: wheel_group, case_group, load_group, steering_group, number, most_loads, word_length
   use ek_draft, only: draft_t, complain, where_of, line_of, has_key, choice, text_of, texts_of, number_of, whole_of, refuse, &
      slot
   use ek_reference, only: look_up, find_driver, find_wheel, is_driver
   implicit none(type, external)
   private
   public :: read_case, refuse_one_file_for_two

   character(*), parameter :: verticals(4) = [character(6) :: 'centre', 'patch', 'force', 'road']

   ! limits of the tolerance: rounding of a metre is 1e-13 mm, and no case converges below that; above a millimetre
   ! the first guess of every state would be accepted
   real(wp), parameter :: least_tolerance = 1.0e-15_wp, most_tolerance = 1.0e-3_wp      !! m

contains

   !> One case; also one with a mistake, which is reported.
   subroutine read_case(draft, this)
      type(draft_t), intent(inout) :: draft
      type(case_t), intent(out) :: this
      type(case_plan_t) :: plan
      real(wp) :: unit, from, to, tolerance
      integer :: c

      unit = 1.0_wp
      this%test = ''
      this%vertical = ''
      this%file = ''
      this%drive = ''
      from = number_of(draft, 'from', 0.0_wp)
      to = number_of(draft, 'to', 0.0_wp)
      if (has_key(draft, 'test')) then
         call read_test(draft, from, to, this, unit)
      else
         call read_drive(draft, this, unit)
      end if
      if (this%test /= 'table' .and. lower(text_of(draft, 'test')) /= 'table') then
         if (.not. has_key(draft, 'from')) call complain(draft, '', "'from' is missing")
         if (.not. has_key(draft, 'to')) call complain(draft, '', "'to' is missing")
         if (draft%cards(draft%k)%is_good .and. .not. abs(to - from) > 0.0_wp) &
            call complain(draft, 'to', 'from and to must differ, found '//str(from)//' twice')
      end if
      this%increments = whole_of(draft, 'increments', this%increments)
      if (this%increments < 1 .or. this%increments > most_increments) call complain(draft, 'increments', &
         'increments must be 1 to '//str(most_increments)//', found '//str(this%increments))
      call choice(draft, 'method', method_names, c)
      tolerance = number_of(draft, 'tolerance', this%tolerance/draft%units%length)*draft%units%length
      if (has_key(draft, 'tolerance')) this%tolerance = tolerance
      if (tolerance < least_tolerance .or. tolerance > most_tolerance) call complain(draft, 'tolerance', 'tolerance must be '// &
         str(least_tolerance/millimetre)//' to '//str(most_tolerance/millimetre)//' mm, found '// &
         str(tolerance/millimetre)//' mm')
      call choice(draft, 'quantities', [character(5) :: 'basic', 'all'], c, default=merge(2, 1, has_key(draft, 'test')))
      this%has_all = c == 2
      this%method = lower(text_of(draft, 'method', 'equilibrium'))
      call read_target()
      call read_follow()

      this%name = text_of(draft, 'name')
      this%where = where_of(draft)
      this%is_good = draft%cards(draft%k)%is_good
      call slot(draft, 'from', unit, plan%from, default=0.0_wp)
      call slot(draft, 'to', unit, plan%to, default=0.0_wp)
      call slot(draft, 'offset', draft%units%length, plan%offset, default=0.0_wp)
      this%from = from*unit
      this%to = to*unit
      draft%plan%cases = [draft%plan%cases, plan]
      draft%cards(draft%k)%index = size(draft%plan%cases)

   contains

      !> target = 'column=value', the value in the unit of the column.
      subroutine read_target()
         type(value_t) :: value
         character(:), allocatable :: hint, words
         integer :: equals

         words = text_of(draft, 'target')
         this%target = words
         if (words == '') return
         equals = index(words, '=')
         value%text = trim(adjustl(words(equals + 1:)))
         value%is_empty = value%text == ''
         if (equals == 0 .or. words(:max(equals - 1, 0)) == '' .or. value_fault(value, number) /= '') then
            hint = ''
            if (index(value%text, ',') > 0) hint = ' (write the number with a decimal point)'
            call complain(draft, 'target', &
               "target: expected 'column=value', as in 'coil_length_mm=250', found "//quoted(words)//hint)
         else if (this%method /= 'equilibrium') then
            call complain(draft, 'target', "target: only method = 'equilibrium' can search for one, found "// &
               quoted(text_of(draft, 'method')))
         end if
      end subroutine read_target

      !> follow = 'arc': needs method 'equilibrium'; tables and targets, which need a unique factor, are not allowed.
      subroutine read_follow()
         integer :: c

         call choice(draft, 'follow', follow_names, c)
         this%follows_arc = c == 2
         if (c /= 2) return
         if (this%test == 'table') then
            call complain(draft, 'follow', "follow = 'arc' is not allowed in test 'table': each row of the table is one state")
         else if (this%target /= '') then
            call complain(draft, 'follow', "follow = 'arc' is not allowed with a target: a path that turns back "// &
               'passes the same factor more than once')
         end if
         if (this%method /= 'equilibrium') call complain(draft, 'follow', &
            "follow = 'arc' needs method = 'equilibrium', found "//quoted(text_of(draft, 'method')))
      end subroutine read_follow

   end subroutine read_case

   !> The target of a case has its own file, <case>_target: no other case may have this name.
   subroutine refuse_one_file_for_two(draft, cases)
      type(draft_t), intent(inout) :: draft
      type(case_t), intent(in) :: cases(:)
      integer :: a, b, k

      do a = 1, size(cases)
         if (cases(a)%target == '') cycle
         do b = 1, size(cases)
            if (lower(cases(b)%name) /= lower(cases(a)%name)//'_target') cycle
            draft%k = findloc(draft%cards%group == case_group .and. draft%cards%index == b, .true., dim=1)
            k = findloc(draft%cards%group == case_group .and. draft%cards%index == a, .true., dim=1)
            call complain(draft, 'name', 'the results of this case would have the same file as the target of case '// &
               quoted(cases(a)%name)//' in '//line_of(draft, k))
         end do
      end do
   end subroutine refuse_one_file_for_two

   !> A case that scales loads or drives a joint directly.
   subroutine read_drive(draft, this, unit)
      type(draft_t), intent(inout) :: draft
      type(case_t), intent(inout) :: this
      real(wp), intent(inout) :: unit      !! of from and to → SI
      character(word_length) :: load(most_loads)
      integer :: j, loads, refused

      if (has_key(draft, 'load') .and. has_key(draft, 'drive')) then
         call complain(draft, 'drive', 'give either load or drive, not both')
      else if (.not. (has_key(draft, 'load') .or. has_key(draft, 'drive'))) then
         call complain(draft, '', "give 'load', 'drive' or 'test'")
      end if
      call refuse(draft, [character(8) :: 'vertical', 'phase', 'offset', 'file'], "only a case with a 'test' takes this key")
      load = texts_of(draft, 'load', most_loads)
      loads = count(load /= '')
      refused = 0
      do j = 1, loads
         if (any(load(:j - 1) == load(j))) then
            call complain(draft, 'load', 'load '//quoted(load(j))//' is named twice')
            exit
         end if
         call find_load(trim(load(j)))
      end do
      this%load = trim(load(1))
      if (loads > 1) then
         allocate (this%actuations(loads))
         do j = 1, loads
            this%actuations(j)%load = trim(load(j))
            this%actuations(j)%drive = ''
            if (j > 1) this%load = this%load//', '//trim(load(j))
         end do
      end if
      this%drive = text_of(draft, 'drive')
      if (lower(this%drive) == 'wheel_travel') then
         this%drive = 'wheel_travel'
         unit = draft%units%length
         if (.not. any(draft%cards%group == wheel_group)) &
            call complain(draft, 'drive', "drive is 'wheel_travel', but there is no &wheel")
      else if (this%drive /= '') then
         call find_driver(draft, this%drive, [character(12) :: 'wheel_travel'], unit)
      end if
      call find_wheel(draft, this%drive == 'wheel_travel', "with drive = 'wheel_travel'", this%wheel)

   contains

      subroutine find_load(name)
         character(*), intent(in) :: name
         integer :: found

         call look_up(draft, 'load', load_group, name, found)
         if (found == 0) return
         if (draft%cards(found)%is_used) return
         ! a load duplicated by &mirror is reported once
         if (.not. (draft%records(found)%side == right_side .and. refused == found - 1)) call complain(draft, 'load', &
            'load '//quoted(own_name(draft%records(found)))//' in '//line_of(draft, found)// &
            " is constant; a case scales loads with factor = 'case'")
         refused = found
      end subroutine find_load

   end subroutine read_drive

   !> Reads a test; checks that it has all keys it needs and no others. Every mistake is reported.
   subroutine read_test(draft, from, to, this, unit)
      type(draft_t), intent(inout) :: draft
      real(wp), intent(in) :: from, to       !! in the unit of the deck
      type(case_t), intent(inout) :: this
      real(wp), intent(inout) :: unit        !! of from and to → SI
      type(rig_test_t) :: test
      integer :: c, wheels(2)

      call choice(draft, 'test', rig_tests%name, c)
      this%load = ''
      if (c == 0) return
      test = rig_tests(c)
      this%test = trim(test%name)
      call refuse_in_test('load', .true., 'a test applies its own loads')
      call refuse_in_test('drive', test%action /= steers, 'only test ''steering'' drives a joint')
      call refuse_in_test('phase', .not. test%has_phase, 'only tests with forces or torques have a phase')
      call refuse_in_test('offset', .not. test%has_trail, 'only test ''lateral_force'' has an offset')
      call refuse_in_test('file', test%action /= takes_table, 'only test ''table'' reads a file')
      call refuse_in_test('from', test%action == takes_table, 'the table sets the range')
      call refuse_in_test('to', test%action == takes_table, 'the table sets the range')
      call refuse_in_test('increments', test%action == takes_table, 'each row of the table is one state')
      call refuse_in_test('target', test%action == takes_table, 'the rows of a table form no path to search')

      call count_wheels()
      call choice(draft, 'vertical', verticals, c)
      if (c > 0) this%vertical = trim(verticals(c))
      if (test%action == rolls) call refuse_in_test('vertical', c == 3, &
         'the test prescribes heights: ''centre'', ''patch'' or ''road''')
      if (test%action == loads_wheels .and. lifts(test)) call refuse_in_test('vertical', c > 0 .and. c /= 3, &
         'the test prescribes the force')
      if (c == 4) call check_tyres()
      call choice(draft, 'phase', [character(4) :: 'in', 'anti'], c)
      this%is_anti = c == 2
      if (this%is_anti .or. needs_both(test)) then
         if (any(wheels == 0)) call complain(draft, 'test', 'a left and a right wheel are needed; the deck has '// &
            str(count(wheels > 0)))
      end if
      this%offset = number_of(draft, 'offset', 0.0_wp)*draft%units%length
      this%wheel = max(wheels(1), 1)
      if (wheels(1) == 0) this%wheel = max(wheels(2), 1)
      call find_wheel(draft, of_one_wheel(test), "with test = 'single_travel'", this%wheel)

      unit = 1.0_wp          ! N m, as on every rig
      if (test%unit == 'mm') unit = merge(draft%units%force, draft%units%length, this%vertical == 'force')
      if (test%unit == 'deg') unit = draft%units%angle
      if (test%unit == 'N') unit = draft%units%force
      if (test%action == rolls .and. max(abs(from), abs(to))*unit > steepest_roll) call complain(draft, 'to', &
         'the roll angle must stay within 0.5 rad (28.6 deg), found '//str(from)//' to '//str(to))
      if (test%action == steers) call find_steering(draft, this%drive, unit)
      if (test%action == takes_table) then
         if (.not. has_key(draft, 'file')) call complain(draft, '', "'file' is missing")
         this%file = text_of(draft, 'file')
         associate (deck_file => draft%records(draft%k)%file)
            if (index(this%file, '/') /= 1) this%file = deck_file(:index(deck_file, '/', back=.true.))//this%file
         end associate
      end if

   contains

      subroutine refuse_in_test(key, is_wrong, why)
         character(*), intent(in) :: key, why
         logical, intent(in) :: is_wrong
         if (is_wrong .and. has_key(draft, key)) call complain(draft, key, key//' is not allowed in test '// &
            quoted(this%test)//': '//why)
      end subroutine refuse_in_test

      !> At most one wheel per side, and at least one wheel.
      subroutine count_wheels()
         integer :: j, side

         wheels = 0
         do j = 1, size(draft%cards)
            if (draft%cards(j)%group /= wheel_group) cycle
            side = merge(2, 1, lower(element(draft%records(j), 'side', 1)) == 'right')
            if (wheels(side) > 0) call complain(draft, 'test', &
               'the rig tests one axle, but the deck has two wheels on one side')
            wheels(side) = draft%cards(j)%index
         end do
         if (all(wheels == 0)) call complain(draft, 'test', 'the rig needs a &wheel')
      end subroutine count_wheels

      !> With vertical = 'road', each wheel needs a tyre rate.
      subroutine check_tyres()
         integer :: j

         do j = 1, size(draft%cards)
            if (draft%cards(j)%group /= wheel_group) cycle
            if (is_given(draft%records(j), 'tyre_rate') .or. draft%records(j)%side == right_side) cycle
            call complain(draft, 'vertical', "vertical = 'road' needs the tyre_rate of wheel "// &
               quoted(draft%cards(j)%name)//' in '//line_of(draft, j))
         end do
      end subroutine check_tyres

   end subroutine read_test

   !> The steered joint: `drive` of the case, or else the driver of &steering, or else the only driver.
   subroutine find_steering(draft, drive, unit)
      type(draft_t), intent(inout) :: draft
      character(:), allocatable, intent(out) :: drive
      real(wp), intent(inout) :: unit        !! deck unit of its value → SI
      logical :: is_one(size(draft%cards))
      integer :: j

      drive = text_of(draft, 'drive')
      j = findloc(draft%cards%group, steering_group, dim=1)
      if (drive == '' .and. j > 0) drive = element(draft%records(j), 'driver', 1)
      is_one = [(is_driver(draft, j), j=1, size(draft%cards))]
      if (drive == '' .and. count(is_one) == 1) drive = trim(draft%cards(findloc(is_one, .true., dim=1))%name)
      if (drive == '') then
         call complain(draft, 'test', "the steered joint is unknown: give drive = '<driver joint>' or a &steering")
      else
         call find_driver(draft, drive, [character(1) ::], unit)
      end if
   end subroutine find_steering

end module ek_reader_cases
