!> &case: what is done to the wheels, or to anything else that can be driven.
module ek_reader_cases
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted
   use ek_case, only: case_t, method_names, most_increments
   use ek_record, only: element, value_t, own_name, right_twin
   use ek_namelist, only: value_fault
   use ek_group, only: wheel_group, case_group, load_group, joint_group, number, word_length, note_length, most_loads, &
      did_you_mean
   use ek_deck, only: deck_t
   use ek_draft, only: draft_t, complain, where_of, line_of, has_key, choice, look_up, find_card
   implicit none(type, external)
   private
   public :: read_cases, test_names

   !> The tests of the rig, see ek_rig.
   character(*), parameter :: test_names(11) = [character(15) :: 'parallel_travel', 'opposite_travel', 'single_travel', &
      'roll', 'steering', 'lateral_force', 'braking', 'traction', 'aligning_torque', 'vertical_force', 'table']
   character(*), parameter :: load_tests(4) = [character(15) :: 'lateral_force', 'braking', 'traction', 'aligning_torque']

   !> What one &case says, in the deck's words and units.
   type :: words_t
      character(word_length) :: name, load(most_loads), drive, wheel, method, test, vertical, phase, quantities
      character(note_length) :: file, target
      real(wp) :: from, to, offset, tolerance
      integer :: increments
   end type words_t

contains

   !> All cases, in the order of the deck.
   subroutine read_cases(deck, draft, cases)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(case_t), allocatable, intent(out) :: cases(:)
      type(words_t) :: words
      real(wp) :: factor
      integer :: k, c, used

      allocate (cases(count(draft%cards%group == case_group)))
      used = 0
      do k = 1, deck%used
         if (draft%cards(k)%group /= case_group) cycle
         used = used + 1
         call read_words(deck, k, draft, words)

         factor = 1.0_wp
         cases(used)%wheel = 1
         cases(used)%test = ''
         cases(used)%vertical = ''
         cases(used)%file = ''
         cases(used)%drive = ''
         if (has_key(deck, k, 'test')) then
            call read_test(deck, k, draft, words, cases(used), factor)
         else
            call read_drive(deck, k, draft, words, cases(used), factor)
         end if
         if (words%test /= 'table') then
            call require('from')
            call require('to')
            if (draft%cards(k)%is_good .and. .not. abs(words%to - words%from) > 0.0_wp) &
               call complain(draft, deck, k, 'to', 'from and to must differ, found '//str(words%from)//' twice')
         end if
         if (words%increments < 1 .or. words%increments > most_increments) &
            call complain(draft, deck, k, 'increments', 'increments must be 1 to '//str(most_increments)//', found '// &
               str(words%increments))
         call choice(draft, deck, k, 'method', trim(words%method), method_names, c)
         if (.not. words%tolerance > 0.0_wp) &
            call complain(draft, deck, k, 'tolerance', 'tolerance must be above 0, found '//str(words%tolerance))
         call choice(draft, deck, k, 'quantities', trim(words%quantities), [character(5) :: 'basic', 'all'], c)
         cases(used)%has_all = c == 2
         call read_target()

         cases(used)%name = trim(words%name)
         cases(used)%where = where_of(deck, k)
         cases(used)%from = words%from*factor
         cases(used)%to = words%to*factor
         cases(used)%increments = words%increments
         cases(used)%method = lower(trim(words%method))
         if (has_key(deck, k, 'tolerance')) cases(used)%tolerance = words%tolerance*draft%units%length
      end do

   contains

      subroutine require(key)
         character(*), intent(in) :: key
         if (.not. has_key(deck, k, key)) call complain(draft, deck, k, '', quoted(key)//' is missing')
      end subroutine require

      !> target = 'column=value', the value in the unit of the column.
      subroutine read_target()
         type(value_t) :: value
         integer :: equals

         cases(used)%target = trim(words%target)
         if (words%target == '') return
         equals = index(words%target, '=')
         value%text = trim(adjustl(words%target(equals + 1:)))
         value%is_empty = value%text == ''
         if (equals == 0 .or. words%target(:max(equals - 1, 0)) == '' .or. value_fault(value, number) /= '') then
            call complain(draft, deck, k, 'target', &
               "target: expected 'column=value', as in 'coil_length_mm=250', found "//quoted(words%target))
         else if (words%method /= '' .and. lower(words%method) /= 'equilibrium') then
            call complain(draft, deck, k, 'target', "target: only method 'equilibrium' can look for one, found "// &
               quoted(words%method))
         end if
      end subroutine read_target

   end subroutine read_cases

   !> The namelist itself.
   subroutine read_words(deck, k, draft, words)
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      type(draft_t), intent(inout) :: draft
      type(words_t), intent(out) :: words
      character(word_length) :: name, load(most_loads), drive, wheel, method, test, vertical, phase, quantities
      character(note_length) :: file, target
      real(wp) :: from, to, tolerance, offset
      integer :: increments, status
      namelist /case/ name, load, drive, wheel, from, to, increments, method, tolerance, test, vertical, phase, offset, &
         file, target, quantities
      type(case_t) :: usual

      name = ''
      load = ''
      drive = ''
      wheel = ''
      method = 'equilibrium'
      test = ''
      vertical = ''
      phase = 'in'
      quantities = 'basic'
      if (has_key(deck, k, 'test')) quantities = 'all'
      file = ''
      target = ''
      from = 0.0_wp
      to = 0.0_wp
      tolerance = usual%tolerance/draft%units%length
      offset = 0.0_wp
      increments = usual%increments
      read (draft%cards(k)%text, nml=case, iostat=status)
      if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')
      words = words_t(name=name, load=load, drive=drive, wheel=wheel, method=method, test=lower(test), vertical=lower(vertical), &
         phase=phase, quantities=quantities, file=file, target=target, from=from, to=to, offset=offset, tolerance=tolerance, &
         increments=increments)
   end subroutine read_words

   !> A case that names what it scales or drives.
   subroutine read_drive(deck, k, draft, words, this, factor)
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      type(draft_t), intent(inout) :: draft
      type(words_t), intent(inout) :: words
      type(case_t), intent(inout) :: this
      real(wp), intent(inout) :: factor      !! unit of from and to → SI
      character(8), parameter :: test_keys(4) = [character(8) :: 'vertical', 'phase', 'offset', 'file']
      integer :: j, loads, refused

      if (has_key(deck, k, 'load') .and. has_key(deck, k, 'drive')) then
         call complain(draft, deck, k, 'drive', 'give either load or drive, not both')
      else if (.not. (has_key(deck, k, 'load') .or. has_key(deck, k, 'drive'))) then
         call complain(draft, deck, k, '', "'load' or 'drive' is missing (or 'test')")
      end if
      do j = 1, size(test_keys)
         if (has_key(deck, k, trim(test_keys(j)))) call complain(draft, deck, k, trim(test_keys(j)), &
            trim(test_keys(j))//": only a case with a 'test' has one")
      end do
      loads = count(words%load /= '')
      refused = 0
      do j = 1, loads
         if (any(words%load(:j - 1) == words%load(j))) then
            call complain(draft, deck, k, 'load', 'load '//quoted(words%load(j))//' is named twice')
            exit
         end if
         call find_load(trim(words%load(j)))
      end do
      this%load = trim(words%load(1))
      if (loads > 1) then
         allocate (this%courses(loads))
         do j = 1, loads
            this%courses(j)%load = trim(words%load(j))
            this%courses(j)%drive = ''
            if (j > 1) this%load = this%load//', '//trim(words%load(j))
         end do
      end if
      if (words%drive /= '') then
         if (lower(words%drive) == 'wheel_travel') then
            words%drive = 'wheel_travel'
            factor = draft%units%length
            if (.not. any(draft%cards%group == wheel_group)) &
               call complain(draft, deck, k, 'drive', "drive is 'wheel_travel', but there is no &wheel")
         else
            call find_driver(deck, k, draft, trim(words%drive), [character(12) :: 'wheel_travel'], factor)
         end if
      end if
      this%drive = trim(words%drive)
      if (words%wheel /= '') call find_wheel(deck, k, draft, words, words%drive == 'wheel_travel', &
         "with drive = 'wheel_travel'", this)

   contains

      subroutine find_load(name)
         character(*), intent(in) :: name
         integer :: found

         call look_up(draft, deck, k, 'load', load_group, name, found)
         if (found == 0) return
         if (draft%cards(found)%is_used) return
         ! of a load that &mirror doubled, once
         if (.not. (deck%records(found)%twin == right_twin .and. refused == found - 1)) call complain(draft, deck, k, 'load', &
            'load '//quoted(own_name(deck%records(found)))//' in '//line_of(deck, found, k)// &
            " is constant; a case scales loads with factor = 'case'")
         refused = found
      end subroutine find_load

   end subroutine read_drive

   !> A test of the rig: what it needs, and nothing else.
   subroutine read_test(deck, k, draft, words, this, factor)
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      type(draft_t), intent(inout) :: draft
      type(words_t), intent(inout) :: words
      type(case_t), intent(inout) :: this
      real(wp), intent(inout) :: factor      !! unit of from and to → SI
      integer :: c, wheels(2), slash

      call choice(draft, deck, k, 'test', trim(words%test), test_names, c)
      this%load = ''
      if (c == 0) return
      this%test = trim(words%test)
      call refuse('load', .true., 'a test brings its own loads')
      call refuse('drive', this%test /= 'steering', 'only the test ''steering'' drives one')
      call refuse('phase', .not. any(load_tests == this%test), 'only tests with forces or torques have one')
      call refuse('offset', this%test /= 'lateral_force', 'only the test ''lateral_force'' has one')
      call refuse('file', this%test /= 'table', 'only the test ''table'' has one')
      call refuse('from', this%test == 'table', 'a table says itself where it goes')
      call refuse('to', this%test == 'table', 'a table says itself where it goes')
      call refuse('increments', this%test == 'table', 'each of its rows is a state')
      call refuse('target', this%test == 'table', 'a table has no path to search')

      call count_wheels()
      call choice(draft, deck, k, 'vertical', trim(words%vertical), [character(6) :: 'centre', 'patch', 'force'], c)
      this%vertical = trim(words%vertical)
      if (this%test == 'roll') call refuse('vertical', c == 3, 'the heights of a rolling axle are driven: ''centre'' or ''patch''')
      if (this%test == 'vertical_force') call refuse('vertical', c == 1 .or. c == 2, 'this test sets the force')
      call choice(draft, deck, k, 'phase', trim(words%phase), [character(4) :: 'in', 'anti'], c)
      this%is_anti = c == 2
      if (this%is_anti .or. this%test == 'opposite_travel' .or. this%test == 'roll') then
         if (any(wheels == 0)) call complain(draft, deck, k, 'test', 'a left and a right wheel are needed, the deck has '// &
            str(count(wheels > 0)))
      end if
      this%offset = words%offset*draft%units%length
      this%wheel = max(wheels(1), 1)
      if (wheels(1) == 0) this%wheel = max(wheels(2), 1)
      if (words%wheel /= '') call find_wheel(deck, k, draft, words, this%test == 'single_travel', &
         "with test = 'single_travel'", this)

      select case (this%test)
      case ('parallel_travel', 'opposite_travel', 'single_travel')
         factor = merge(draft%units%force, draft%units%length, this%vertical == 'force')
      case ('roll')
         factor = draft%units%angle
         if (max(abs(words%from), abs(words%to))*factor > 0.5_wp) call complain(draft, deck, k, 'to', &
            'the roll angle must stay within 0.5 rad (28.6 deg), found '//str(words%from)//' to '//str(words%to))
      case ('steering')
         call find_steering()
      case ('aligning_torque')
         factor = 1.0_wp          ! N m, as on every rig
      case ('table')
         if (.not. has_key(deck, k, 'file')) call complain(draft, deck, k, '', "'file' is missing")
         this%file = trim(words%file)
         slash = index(deck%records(k)%file, '/', back=.true.)
         if (index(this%file, '/') /= 1) this%file = deck%records(k)%file(:slash)//this%file
      case default
         factor = draft%units%force
      end select

   contains

      subroutine refuse(key, is_wrong, why)
         character(*), intent(in) :: key, why
         logical, intent(in) :: is_wrong
         if (is_wrong .and. has_key(deck, k, key)) call complain(draft, deck, k, key, key//' has no place in test '// &
            quoted(this%test)//': '//why)
      end subroutine refuse

      !> At most one wheel a side, at least one.
      subroutine count_wheels()
         integer :: j, side

         wheels = 0
         do j = 1, deck%used
            if (draft%cards(j)%group /= wheel_group) cycle
            side = merge(2, 1, lower(element(deck%records(j), 'side', 1)) == 'right')
            if (wheels(side) > 0) call complain(draft, deck, k, 'test', &
               'the rig takes one axle, the deck has two wheels on one side')
            wheels(side) = draft%cards(j)%index
         end do
         if (all(wheels == 0)) call complain(draft, deck, k, 'test', 'the rig needs a &wheel')
      end subroutine count_wheels

      !> What is steered: the case's own word, else that of &steering, else the only driver.
      subroutine find_steering()
         character(word_length) :: only
         integer :: j, found

         this%drive = trim(words%drive)
         only = ''
         found = 0
         do j = 1, deck%used
            if (this%drive /= '') exit
            if (deck%records(j)%group == 'steering') this%drive = element(deck%records(j), 'driver', 1)
         end do
         do j = 1, deck%used
            if (this%drive /= '') exit
            if (draft%cards(j)%group /= joint_group) cycle
            if (lower(element(deck%records(j), 'type', 1)) /= 'driver') cycle
            found = found + 1
            if (found == 1) only = draft%cards(j)%name
         end do
         if (found == 1) this%drive = trim(only)
         if (this%drive == '') then
            call complain(draft, deck, k, 'test', "what is steered? Give drive = '<driver joint>' or a &steering")
         else
            call find_driver(deck, k, draft, this%drive, [character(1) ::], factor)
         end if
      end subroutine find_steering

   end subroutine read_test

   !> The driver joint of this name, and the unit of what it drives.
   subroutine find_driver(deck, k, draft, name, others, factor)
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      type(draft_t), intent(inout) :: draft
      character(*), intent(in) :: name, others(:)     !! others: what else may be driven, for the hint
      real(wp), intent(inout) :: factor
      character(word_length), allocatable :: names(:)
      integer :: j, found

      found = find_card(draft, joint_group, name)
      if (found > 0) then
         factor = draft%cards(found)%factor
         if (lower(element(deck%records(found), 'type', 1)) /= 'driver') call complain(draft, deck, k, 'drive', &
            'drive: the joint '//quoted(name)//' in '//line_of(deck, found, k)//' is not a driver')
         return
      end if
      allocate (names(deck%used + size(others)))
      names = ''
      do j = 1, size(others)
         names(deck%used + j) = others(j)
      end do
      do j = 1, deck%used
         if (draft%cards(j)%group /= joint_group) cycle
         if (lower(element(deck%records(j), 'type', 1)) == 'driver') names(j) = draft%cards(j)%name
      end do
      call complain(draft, deck, k, 'drive', 'drive: there is no driver joint '//quoted(name)//did_you_mean(name, names))
   end subroutine find_driver

   !> The wheel that a case names.
   subroutine find_wheel(deck, k, draft, words, may_have_one, which, this)
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      type(draft_t), intent(inout) :: draft
      type(words_t), intent(in) :: words
      logical, intent(in) :: may_have_one
      character(*), intent(in) :: which      !! the cases that have one
      type(case_t), intent(inout) :: this
      integer :: found

      call look_up(draft, deck, k, 'wheel', wheel_group, trim(words%wheel), found)
      if (found > 0) this%wheel = draft%cards(found)%index
      if (.not. may_have_one) call complain(draft, deck, k, 'wheel', 'wheel: only a case '//which//' has one')
   end subroutine find_wheel

end module ek_reader_cases
