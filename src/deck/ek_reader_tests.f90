!> &case with a `test`: the keys of each rig test and their legal values. ek_rig mounts the test.
module ek_reader_tests
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted
   use ek_case, only: case_t
   use ek_record, only: element
   use ek_group, only: wheel_group, joint_group, word_length
   use ek_deck, only: deck_t
   use ek_draft, only: draft_t, complain, line_of, has_key, choice
   use ek_twin, only: right_twin
   use ek_case_words, only: words_t, find_driver, find_wheel
   implicit none(type, external)
   private
   public :: read_test

   !> The tests of the rig, see ek_rig.
   character(*), parameter :: test_names(11) = [character(15) :: 'parallel_travel', 'opposite_travel', 'single_travel', &
      'roll', 'steering', 'lateral_force', 'braking', 'traction', 'aligning_torque', 'vertical_force', 'table']
   character(*), parameter :: load_tests(4) = [character(15) :: 'lateral_force', 'braking', 'traction', 'aligning_torque']

contains

   !> Reads a test; checks that it has all keys it needs and no others. Every mistake is reported in the reading.
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
      call refuse('load', .true., 'a test applies its own loads')
      call refuse('drive', this%test /= 'steering', 'only test ''steering'' drives a joint')
      call refuse('phase', .not. any(load_tests == this%test), 'only tests with forces or torques have a phase')
      call refuse('offset', this%test /= 'lateral_force', 'only test ''lateral_force'' has an offset')
      call refuse('file', this%test /= 'table', 'only test ''table'' reads a file')
      call refuse('from', this%test == 'table', 'the table sets the range')
      call refuse('to', this%test == 'table', 'the table sets the range')
      call refuse('increments', this%test == 'table', 'each row of the table is one state')
      call refuse('target', this%test == 'table', 'the rows of a table form no path to search')

      call count_wheels()
      call choice(draft, deck, k, 'vertical', trim(words%vertical), [character(6) :: 'centre', 'patch', 'force', 'road'], c)
      this%vertical = trim(words%vertical)
      if (this%test == 'roll') call refuse('vertical', c == 3, &
         'the test prescribes heights: ''centre'', ''patch'' or ''road''')
      if (this%test == 'vertical_force') call refuse('vertical', c > 0 .and. c /= 3, 'the test prescribes the force')
      if (c == 4) call check_tyres()
      call choice(draft, deck, k, 'phase', trim(words%phase), [character(4) :: 'in', 'anti'], c)
      this%is_anti = c == 2
      if (this%is_anti .or. this%test == 'opposite_travel' .or. this%test == 'roll') then
         if (any(wheels == 0)) call complain(draft, deck, k, 'test', 'a left and a right wheel are needed; the deck has '// &
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
         if (is_wrong .and. has_key(deck, k, key)) call complain(draft, deck, k, key, key//' is not allowed in test '// &
            quoted(this%test)//': '//why)
      end subroutine refuse

      !> At most one wheel per side, and at least one wheel.
      subroutine count_wheels()
         integer :: j, side

         wheels = 0
         do j = 1, deck%used
            if (draft%cards(j)%group /= wheel_group) cycle
            side = merge(2, 1, lower(element(deck%records(j), 'side', 1)) == 'right')
            if (wheels(side) > 0) call complain(draft, deck, k, 'test', &
               'the rig tests one axle, but the deck has two wheels on one side')
            wheels(side) = draft%cards(j)%index
         end do
         if (all(wheels == 0)) call complain(draft, deck, k, 'test', 'the rig needs a &wheel')
      end subroutine count_wheels

      !> With vertical = 'road', each wheel needs a tyre rate.
      subroutine check_tyres()
         integer :: j

         do j = 1, deck%used
            if (draft%cards(j)%group /= wheel_group) cycle
            if (has_key(deck, j, 'tyre_rate') .or. deck%records(j)%twin == right_twin) cycle
            call complain(draft, deck, k, 'vertical', "vertical = 'road' needs the tyre_rate of wheel "// &
               quoted(draft%cards(j)%name)//' in '//line_of(deck, j, k))
         end do
      end subroutine check_tyres

      !> The steered joint: `drive` of the case, or else the driver of &steering, or else the only driver.
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
            call complain(draft, deck, k, 'test', "the steered joint is unknown: give drive = '<driver joint>' or a &steering")
         else
            call find_driver(deck, k, draft, this%drive, [character(1) ::], factor)
         end if
      end subroutine find_steering

   end subroutine read_test

end module ek_reader_tests
