!> &case: loads or motions that change over the states of the case, or a test on the rig (ek_rig).
module ek_reader_cases
   use ek_kinds, only: wp, millimetre
   use ek_text, only: str, lower, quoted
   use ek_dimension, only: pure_number, length, force, angle, unit_name
   use ek_rig_test, only: rig_test_t, rig_tests, needs_both, of_one_wheel, lifts, rig_test, rolls, steers, loads_wheels, &
      takes_table, covers_grid, drives_car
   use ek_case, only: case_t, max_increments
   use ek_record, only: value_t, left_side, right_side, element, is_given, own_name
   use ek_suspension, only: of_adjuster
   use ek_namelist, only: value_fault
   use ek_realise, only: steepest_roll
   use ek_blueprint, only: case_plan_t
   use ek_group, only: wheel_group, spring_group, case_group, load_group, steering_group, manoeuvre_group, adjuster_group, number, &
      max_loads, word_length
   use ek_deck_reading, only: deck_reading_t, complain, where_of, line_of, has_key, choice, text_of, texts_of, number_of, &
      whole_of, refuse, slot, unit_of
   use ek_attachment, only: path_of
   use ek_reference, only: look_up, find_driver, find_wheel, is_driver
   implicit none(type, external)
   private
   public :: read_case, refuse_one_file_for_two

   ! limits of the tolerance: rounding of a metre is 1e-13 mm, and no case converges below that; above a millimetre
   ! the first guess of every state would be accepted
   real(wp), parameter :: min_tolerance = 1.0e-15_wp, max_tolerance = 1.0e-3_wp      !! limits [m]

contains

   !> Reads one case and reports its errors. A case with an error is also returned, with `is_good` = .false.
   subroutine read_case(reading, this)
      type(deck_reading_t), intent(inout) :: reading
      type(case_t), intent(out) :: this
      type(case_plan_t) :: plan
      type(rig_test_t) :: test
      real(wp) :: from, to, reach, tolerance
      integer :: c
      logical :: has_grid, has_table

      test = rig_test(lower(text_of(reading, 'test')))
      has_grid = test%action == covers_grid
      has_table = any(test%action == [takes_table, drives_car])
      reach = 0.0_wp
      if (has_grid) reach = test%reach*millimetre/reading%units%length
      this%test = ''
      this%vertical = ''
      this%file = ''
      this%drive = ''
      from = number_of(reading, 'from', -reach)
      to = number_of(reading, 'to', reach)
      if (has_key(reading, 'test')) then
         call read_test(reading, from, to, this)
      else
         call read_drive(reading, this)
      end if
      if (.not. has_table) then
         if (.not. (has_key(reading, 'from') .or. has_grid)) call complain(reading, '', "'from' is missing")
         if (.not. (has_key(reading, 'to') .or. has_grid)) call complain(reading, '', "'to' is missing")
         if (reading%cards(reading%k)%is_good .and. .not. abs(to - from) > 0.0_wp) &
            call complain(reading, 'to', 'from and to must differ, found '//str(from)//' twice')
         if (reading%cards(reading%k)%is_good .and. from > to .and. (has_key(reading, 'from') .neqv. has_key(reading, 'to'))) &
            call complain(reading, trim(merge('from', 'to  ', has_key(reading, 'from'))), 'a range from '//str(from)//' to '// &
            str(to)//', where one end is the default: give from and to')
      end if
      this%increments = whole_of(reading, 'increments', merge(test%increments, this%increments, has_grid))
      if (this%increments < 1 .or. this%increments > max_increments) call complain(reading, 'increments', &
         'increments must be 1 to '//str(max_increments)//', found '//str(this%increments))
      if (has_grid) call read_grid(reading, this, plan)
      call choice(reading, 'method', c)
      this%says_solver = has_key(reading, 'solver')
      call choice(reading, 'solver', c)
      this%uses_plan = c >= 2
      tolerance = number_of(reading, 'tolerance', this%tolerance/unit_of(reading, 'tolerance'))*unit_of(reading, 'tolerance')
      if (has_key(reading, 'tolerance')) this%tolerance = tolerance
      if (tolerance < min_tolerance .or. tolerance > max_tolerance) call complain(reading, 'tolerance', 'tolerance must be '// &
         str(min_tolerance/millimetre)//' to '//str(max_tolerance/millimetre)//' mm, found '// &
         str(tolerance/millimetre)//' mm')
      call choice(reading, 'quantities', c, default=merge(2, 1, has_key(reading, 'test')))
      this%has_all = c == 2
      this%method = lower(text_of(reading, 'method', 'equilibrium'))
      call read_target(reading, this)
      call read_follow(reading, test, this)

      this%name = text_of(reading, 'name')
      this%where = where_of(reading)
      this%is_good = reading%cards(reading%k)%is_good
      if (.not. has_table) call slot(reading, 'from', plan%from, default=-reach)
      if (.not. has_table) call slot(reading, 'to', plan%to, default=reach)
      if (test%has_trail) call slot(reading, 'offset', plan%offset)
      this%from = from*unit_of(reading, 'from')
      this%to = to*unit_of(reading, 'to')
      reading%plan%cases = [reading%plan%cases, plan]
      reading%cards(reading%k)%index = size(reading%plan%cases)
   end subroutine read_case

   !> Reads the range of the driver in a grid. The default is the travel of &steering, which depends on the design, if the driver is
   !> the rack. For any other driver, both ends of the range must be given.
   subroutine read_grid(reading, this, plan)
      type(deck_reading_t), intent(inout) :: reading
      type(case_t), intent(inout) :: this
      type(case_plan_t), intent(inout) :: plan
      character(*), parameter :: keys(2) = [character(10) :: 'steer_from', 'steer_to']
      integer :: k, j
      logical :: is_rack

      this%steer_increments = whole_of(reading, 'steer_increments', this%steer_increments)
      if (this%steer_increments < 1 .or. this%steer_increments > max_increments) then
         call complain(reading, 'steer_increments', 'steer_increments must be 1 to '//str(max_increments)//', found '// &
            str(this%steer_increments))
      else if ((this%increments + 1.0_wp)*(this%steer_increments + 1.0_wp) > max_increments) then
         call complain(reading, 'steer_increments', 'the grid must have at most '//str(max_increments)//' states, found '// &
            str(this%increments + 1)//' x '//str(this%steer_increments + 1)//': use fewer increments')
      end if
      call slot(reading, 'steer_from', plan%steer_from)
      call slot(reading, 'steer_to', plan%steer_to)
      j = findloc(reading%cards%group, steering_group, dim=1)
      is_rack = .false.
      if (j > 0) is_rack = lower(element(reading%records(j), 'driver', 1)) == lower(this%drive)
      if (is_rack .and. .not. any([has_key(reading, keys(1)), has_key(reading, keys(2))])) return
      do k = 1, 2
         if (.not. has_key(reading, trim(keys(k)))) call complain(reading, '', quoted(trim(keys(k)))// &
            ' is missing: give both, or neither for the travel of &steering')
      end do
      this%steer_from = number_of(reading, 'steer_from', 0.0_wp)*unit_of(reading, 'steer_from')
      this%steer_to = number_of(reading, 'steer_to', 0.0_wp)*unit_of(reading, 'steer_to')
      if (reading%cards(reading%k)%is_good .and. .not. abs(this%steer_to - this%steer_from) > 0.0_wp) &
         call complain(reading, 'steer_to', 'steer_from and steer_to must differ, found '// &
         str(number_of(reading, 'steer_to', 0.0_wp))//' twice')
   end subroutine read_grid

   !> Reads target = 'column=value'. The value is in the unit of the column.
   subroutine read_target(reading, this)
      type(deck_reading_t), intent(inout) :: reading
      type(case_t), intent(inout) :: this      !! with its method
      type(value_t) :: value
      character(:), allocatable :: hint, words
      integer :: equals

      words = text_of(reading, 'target')
      this%target = words
      if (words == '') return
      equals = index(words, '=')
      value%text = trim(adjustl(words(equals + 1:)))
      value%is_empty = value%text == ''
      if (equals == 0 .or. words(:max(equals - 1, 0)) == '' .or. value_fault(value, number) /= '') then
         hint = ''
         if (index(value%text, ',') > 0) hint = ' (write the number with a decimal point)'
         call complain(reading, 'target', &
            "target: expected 'column=value', as in 'coil_length_mm=250', found "//quoted(words)//hint)
      else if (this%method /= 'equilibrium') then
         call complain(reading, 'target', "target: only method = 'equilibrium' can search for one, found "// &
            quoted(text_of(reading, 'method')))
      end if
   end subroutine read_target

   !> Reads `follow`. The value 'arc' requires method 'equilibrium', and is not allowed in tests with a table or a grid, or with a
   !> target.
   subroutine read_follow(reading, test, this)
      type(deck_reading_t), intent(inout) :: reading
      type(rig_test_t), intent(in) :: test
      type(case_t), intent(inout) :: this      !! with its method and target
      integer :: c

      call choice(reading, 'follow', c)
      this%follows_arc = c == 2
      if (c /= 2) return
      if (any(test%action == [takes_table, covers_grid, drives_car])) then
         call complain(reading, 'follow', "follow = 'arc' is not allowed in test "//quoted(this%test)//': '//trim(merge( &
            'each row of the table is one state', 'the states of a grid form no path ', test%action /= covers_grid)))
      else if (this%target /= '') then
         call complain(reading, 'follow', "follow = 'arc' is not allowed with a target: a path that turns back "// &
            'passes the same factor more than once')
      end if
      if (this%method /= 'equilibrium') call complain(reading, 'follow', &
         "follow = 'arc' needs method = 'equilibrium', found "//quoted(text_of(reading, 'method')))
   end subroutine read_follow

   !> Rejects a case whose output file would be the file of the target of another case. The target of case <case> has the output
   !> file <case>_target.
   subroutine refuse_one_file_for_two(reading, cases)
      type(deck_reading_t), intent(inout) :: reading
      type(case_t), intent(in) :: cases(:)
      integer :: a, b, k

      do a = 1, size(cases)
         if (cases(a)%target == '') cycle
         do b = 1, size(cases)
            if (lower(cases(b)%name) /= lower(cases(a)%name)//'_target') cycle
            reading%k = findloc(reading%cards%group == case_group .and. reading%cards%index == b, .true., dim=1)
            k = findloc(reading%cards%group == case_group .and. reading%cards%index == a, .true., dim=1)
            call complain(reading, 'name', 'the results of this case would have the same file as the target of case '// &
               quoted(cases(a)%name)//' in '//line_of(reading, k))
         end do
      end do
   end subroutine refuse_one_file_for_two

   !> Reads a case that scales loads or moves a driver directly.
   subroutine read_drive(reading, this)
      type(deck_reading_t), intent(inout) :: reading
      type(case_t), intent(inout) :: this
      character(word_length) :: load(max_loads)
      integer :: j, loads, refused, swept

      if (has_key(reading, 'load') .and. has_key(reading, 'drive')) then
         call complain(reading, 'drive', 'give either load or drive, not both')
      else if (.not. (has_key(reading, 'load') .or. has_key(reading, 'drive'))) then
         call complain(reading, '', "give 'load', 'drive' or 'test'")
      end if
      call refuse(reading, [character(16) :: 'vertical', 'pose', 'phase', 'offset', 'file', 'steer_from', 'steer_to', &
         'steer_increments'], &
         "only a case with a 'test' accepts this key")
      load = texts_of(reading, 'load', max_loads)
      loads = count(load /= '')
      refused = 0
      do j = 1, loads
         if (any(load(:j - 1) == load(j))) then
            call complain(reading, 'load', 'load '//quoted(load(j))//' is named twice')
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
      this%drive = text_of(reading, 'drive')
      swept = pure_number          ! the factor of a load
      if (lower(this%drive) == 'wheel_travel') then
         this%drive = 'wheel_travel'
         swept = length
         if (.not. any(reading%cards%group == wheel_group)) &
            call complain(reading, 'drive', "drive is 'wheel_travel', but there is no &wheel")
      else if (index(this%drive, of_adjuster) == 1) then
         swept = length
         call check_rod(reading, this%drive(len(of_adjuster) + 1:))
      else if (this%drive /= '') then
         call find_driver(reading, this%drive, [character(12) :: 'wheel_travel'], swept)
      end if
      reading%cards(reading%k)%swept = swept
      call find_wheel(reading, this%drive == 'wheel_travel', "with drive = 'wheel_travel'", this%wheel)

   contains

      !> Checks that a load exists and is scaled by cases; a constant load is an error.
      subroutine find_load(name)
         character(*), intent(in) :: name
         integer :: found

         call look_up(reading, 'load', load_group, name, found)
         if (found == 0) return
         if (reading%cards(found)%is_used) return
         ! a load duplicated by &mirror is reported once
         if (.not. (reading%records(found)%side == right_side .and. refused == found - 1)) call complain(reading, 'load', &
            'load '//quoted(own_name(reading%records(found)))//' in '//line_of(reading, found)// &
            " is constant; a case scales loads with factor = 'case'")
         refused = found
      end subroutine find_load

   end subroutine read_drive

   !> Checks the adjuster that a case drives: a rod that is a distance joint, whose row prescribes its length as the row of a driver
   !> does. Its range must contain its value with the range of the case added.
   subroutine check_rod(reading, name)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: name
      real(wp) :: ends(2)
      integer :: found, k

      found = 0
      do k = 1, size(reading%cards)
         if (reading%cards(k)%group == adjuster_group .and. own_name(reading%records(k)) == name .and. &
            reading%records(k)%side == left_side) found = k
      end do
      if (found > 0) then
         call complain(reading, 'drive', 'drive: &mirror duplicates the adjuster '//quoted(name)// &
            "; drive 'adjuster.left_"//name//"' or 'adjuster.right_"//name//"'")
         return
      end if
      call look_up(reading, 'drive', adjuster_group, name, found)
      if (found == 0) return
      if (.not. reading%cards(found)%is_good) reading%cards(reading%k)%is_good = .false.
      if (.not. reading%cards(reading%k)%is_good) return
      associate (adjuster => reading%plan%prototype%adjusters(reading%cards(found)%index))
         if (adjuster%row == 0) then
            call complain(reading, 'drive', 'drive: the adjuster '//quoted(name)//' moves points of a part; a case drives only '// &
               "a rod that is a distance joint. A study of kind 'sweep' with path = 'adjuster."//name//"' solves a case at values")
            return
         end if
         ends = adjuster%value + [number_of(reading, 'from', 0.0_wp), number_of(reading, 'to', 0.0_wp)]*reading%units%length
         if (minval(ends) < adjuster%low .or. maxval(ends) > adjuster%high) call complain(reading, 'drive', &
            'drive: the values from '//str(minval(ends)/reading%units%length)//' to '//str(maxval(ends)/reading%units%length)// &
            ' leave the range of the adjuster, '//str(adjuster%low/reading%units%length)//' to '// &
            str(adjuster%high/reading%units%length)//' '//unit_name(length, reading%units))
      end associate
   end subroutine check_rod

   !> Reads the test of a case. A missing key, and a key that the test does not allow, are reported as errors.
   subroutine read_test(reading, from, to, this)
      type(deck_reading_t), intent(inout) :: reading
      real(wp), intent(in) :: from, to       !! in the unit of the deck
      type(case_t), intent(inout) :: this
      character(*), parameter :: no_grid = 'only test ''travel_and_steering'' has a second range'
      type(rig_test_t) :: test
      integer :: c, swept, steered, wheels(2)

      call choice(reading, 'test', c)
      this%load = ''
      if (c == 0) return
      test = rig_tests(c)
      this%test = trim(test%name)
      call refuse_in_test('load', .true., 'a test applies its own loads')
      call refuse_in_test('drive', .not. any(test%action == [steers, covers_grid]), &
         'only tests ''steering'' and ''travel_and_steering'' drive a joint')
      call refuse_in_test('steer_from', test%action /= covers_grid, no_grid)
      call refuse_in_test('steer_to', test%action /= covers_grid, no_grid)
      call refuse_in_test('steer_increments', test%action /= covers_grid, no_grid)
      call refuse_in_test('phase', .not. test%has_phase, 'only tests with forces or torques have a phase')
      call refuse_in_test('offset', .not. test%has_trail, 'only test ''lateral_force'' has an offset')
      call refuse_in_test('pose', test%action /= drives_car, 'only test ''manoeuvres'' has a pose')
      call refuse_in_test('file', test%action /= takes_table, 'only test ''table'' reads a file')
      call refuse_in_test('from', test%action == takes_table, 'the table sets the range')
      call refuse_in_test('to', test%action == takes_table, 'the table sets the range')
      call refuse_in_test('increments', test%action == takes_table, 'each row of the table is one state')
      call refuse_in_test('from', test%action == drives_car, 'the &manoeuvre records give the loads')
      call refuse_in_test('to', test%action == drives_car, 'the &manoeuvre records give the loads')
      call refuse_in_test('increments', test%action == drives_car, 'each manoeuvre is one state')
      call refuse_in_test('target', test%action == drives_car, 'manoeuvres form no path to search')
      call refuse_in_test('target', test%action == takes_table, 'the rows of a table form no path to search')
      call refuse_in_test('target', test%action == covers_grid, 'the states of a grid form no path to search')

      call count_wheels(reading, wheels)
      call choice(reading, 'vertical', c, word=this%vertical)
      if (any(test%action == [rolls, covers_grid])) call refuse_in_test('vertical', c == 3, &
         'the test prescribes heights: ''centre'', ''patch'' or ''road''')
      if ((test%action == loads_wheels .and. lifts(test)) .or. test%action == drives_car) call refuse_in_test('vertical', &
         c > 0 .and. c /= 3, 'the test prescribes the force')
      if (c == 4) call check_tyres(reading)
      call choice(reading, 'pose', c)
      this%holds_springs = c == 2
      if (this%holds_springs .and. .not. any(reading%cards%group == spring_group)) call complain(reading, 'pose', &
         "pose = 'design' needs a &spring, whose length it keeps")
      call choice(reading, 'phase', c)
      this%is_anti = c == 2
      if (this%is_anti .or. needs_both(test)) then
         if (any(wheels == 0)) call complain(reading, 'test', 'a left and a right wheel are needed; the deck has '// &
            str(count(wheels > 0)))
      end if
      this%offset = number_of(reading, 'offset', 0.0_wp)*unit_of(reading, 'offset')
      this%wheel = max(wheels(1), 1)
      if (wheels(1) == 0) this%wheel = max(wheels(2), 1)
      call find_wheel(reading, of_one_wheel(test), "with test = 'single_travel'", this%wheel)

      swept = pure_number          ! N m, as on every rig
      if (test%unit == 'mm') swept = merge(force, length, this%vertical == 'force')
      if (test%unit == 'deg') swept = angle
      if (test%unit == 'N') swept = force
      if (test%action == steers) call find_steering(reading, this%drive, swept)
      reading%cards(reading%k)%swept = swept
      if (test%action == rolls .and. max(abs(from), abs(to))*unit_of(reading, 'from') > steepest_roll) &
         call complain(reading, 'to', 'the roll angle must stay within 0.5 rad (28.6 deg), found '//str(from)//' to '//str(to))
      if (test%action == covers_grid) then
         steered = pure_number
         call find_steering(reading, this%drive, steered)
         reading%cards(reading%k)%deflection = steered
         reading%cards(reading%k)%swept = length
      end if
      if (test%action == takes_table) then
         if (.not. has_key(reading, 'file')) call complain(reading, '', "'file' is missing")
         this%file = path_of(reading%records(reading%k), text_of(reading, 'file'))
      end if
      if (test%action == drives_car) then
         if (.not. any(reading%cards%group == manoeuvre_group)) call complain(reading, 'test', 'there is no &manoeuvre')
         allocate (this%manoeuvres(size(reading%plan%manoeuvres)))
         do c = 1, size(this%manoeuvres)
            this%manoeuvres(c) = reading%plan%manoeuvres(c)%manoeuvre
         end do
      end if

   contains

      !> Reports an error for a key that is given although the test does not allow it (`is_wrong`). `why` is the reason in the
      !> message.
      subroutine refuse_in_test(key, is_wrong, why)
         character(*), intent(in) :: key, why
         logical, intent(in) :: is_wrong
         if (is_wrong .and. has_key(reading, key)) call complain(reading, key, key//' is not allowed in test '// &
            quoted(this%test)//': '//why)
      end subroutine refuse_in_test

   end subroutine read_test

   !> Finds the left and the right wheel. Reports an error if there is no wheel, or more than one wheel on a side.
   subroutine count_wheels(reading, wheels)
      type(deck_reading_t), intent(inout) :: reading
      integer, intent(out) :: wheels(2)      !! index of the left and of the right wheel; 0: the deck has none
      integer :: j, side

      wheels = 0
      do j = 1, size(reading%cards)
         if (reading%cards(j)%group /= wheel_group) cycle
         side = merge(2, 1, lower(element(reading%records(j), 'side', 1)) == 'right')
         if (wheels(side) > 0) call complain(reading, 'test', &
            'the rig tests one axle, but the deck has two wheels on one side')
         wheels(side) = reading%cards(j)%index
      end do
      if (all(wheels == 0)) call complain(reading, 'test', 'the rig needs a &wheel')
   end subroutine count_wheels

   !> Checks that with vertical = 'road', each wheel has a tyre rate.
   subroutine check_tyres(reading)
      type(deck_reading_t), intent(inout) :: reading
      integer :: j

      do j = 1, size(reading%cards)
         if (reading%cards(j)%group /= wheel_group) cycle
         if (is_given(reading%records(j), 'tyre_rate') .or. reading%records(j)%side == right_side) cycle
         call complain(reading, 'vertical', "vertical = 'road' needs the tyre_rate of wheel "// &
            quoted(reading%cards(j)%name)//' in '//line_of(reading, j))
      end do
   end subroutine check_tyres

   !> Finds the steered joint: the `drive` of the case, otherwise the driver of &steering, otherwise the only driver of the deck. An
   !> error is reported if none of them exists.
   subroutine find_steering(reading, drive, dimension)
      type(deck_reading_t), intent(inout) :: reading
      character(:), allocatable, intent(out) :: drive
      integer, intent(inout) :: dimension    !! dimension of the prescribed value; unchanged if not found
      logical :: is_one(size(reading%cards))
      integer :: j

      drive = text_of(reading, 'drive')
      j = findloc(reading%cards%group, steering_group, dim=1)
      if (drive == '' .and. j > 0) drive = element(reading%records(j), 'driver', 1)
      is_one = [(is_driver(reading, j), j=1, size(reading%cards))]
      if (drive == '' .and. count(is_one) == 1) drive = trim(reading%cards(findloc(is_one, .true., dim=1))%name)
      if (drive == '') then
         call complain(reading, 'test', "the steered joint is unknown: give drive = '<driver joint>' or a &steering")
      else
         call find_driver(reading, drive, [character(1) ::], dimension)
      end if
   end subroutine find_steering

end module ek_reader_cases
