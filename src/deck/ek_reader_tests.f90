!> &case with a `test`: the keys of each rig test and their legal values. ek_rig mounts the test.
module ek_reader_tests
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted
   use ek_case, only: case_t
   use ek_record, only: element, is_given
   use ek_group, only: wheel_group, joint_group, word_length
   use ek_realise, only: steepest_roll
   use ek_draft, only: draft_t, complain, line_of, has_key, choice, text_of, number_of
   use ek_complaint, only: right_twin
   use ek_reference, only: find_driver, find_wheel
   implicit none(type, external)
   private
   public :: read_test

   !> The tests of the rig, see ek_rig.
   character(*), parameter :: test_names(11) = [character(15) :: 'parallel_travel', 'opposite_travel', 'single_travel', &
      'roll', 'steering', 'lateral_force', 'braking', 'traction', 'aligning_torque', 'vertical_force', 'table']
   character(*), parameter :: load_tests(4) = [character(15) :: 'lateral_force', 'braking', 'traction', 'aligning_torque']
   character(*), parameter :: verticals(4) = [character(6) :: 'centre', 'patch', 'force', 'road']

contains

   !> Reads a test; checks that it has all keys it needs and no others. Every mistake is reported.
   subroutine read_test(draft, from, to, this, unit)
      type(draft_t), intent(inout) :: draft
      real(wp), intent(in) :: from, to       !! in the unit of the deck
      type(case_t), intent(inout) :: this
      real(wp), intent(inout) :: unit        !! of from and to → SI
      integer :: c, wheels(2)

      call choice(draft, 'test', test_names, c)
      this%load = ''
      if (c == 0) return
      this%test = trim(test_names(c))
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
      call choice(draft, 'vertical', verticals, c)
      if (c > 0) this%vertical = trim(verticals(c))
      if (this%test == 'roll') call refuse('vertical', c == 3, &
         'the test prescribes heights: ''centre'', ''patch'' or ''road''')
      if (this%test == 'vertical_force') call refuse('vertical', c > 0 .and. c /= 3, 'the test prescribes the force')
      if (c == 4) call check_tyres()
      call choice(draft, 'phase', [character(4) :: 'in', 'anti'], c)
      this%is_anti = c == 2
      if (this%is_anti .or. this%test == 'opposite_travel' .or. this%test == 'roll') then
         if (any(wheels == 0)) call complain(draft, 'test', 'a left and a right wheel are needed; the deck has '// &
            str(count(wheels > 0)))
      end if
      this%offset = number_of(draft, 'offset', 0.0_wp)*draft%units%length
      this%wheel = max(wheels(1), 1)
      if (wheels(1) == 0) this%wheel = max(wheels(2), 1)
      call find_wheel(draft, this%test == 'single_travel', "with test = 'single_travel'", this%wheel)

      select case (this%test)
      case ('parallel_travel', 'opposite_travel', 'single_travel')
         unit = merge(draft%units%force, draft%units%length, this%vertical == 'force')
      case ('roll')
         unit = draft%units%angle
         if (max(abs(from), abs(to))*unit > steepest_roll) call complain(draft, 'to', &
            'the roll angle must stay within 0.5 rad (28.6 deg), found '//str(from)//' to '//str(to))
      case ('steering')
         call find_steering(draft, this%drive, unit)
      case ('aligning_torque')
         unit = 1.0_wp          ! N m, as on every rig
      case ('table')
         if (.not. has_key(draft, 'file')) call complain(draft, '', "'file' is missing")
         this%file = text_of(draft, 'file')
         associate (deck_file => draft%records(draft%k)%file)
            if (index(this%file, '/') /= 1) this%file = deck_file(:index(deck_file, '/', back=.true.))//this%file
         end associate
      case default
         unit = draft%units%force
      end select

   contains

      subroutine refuse(key, is_wrong, why)
         character(*), intent(in) :: key, why
         logical, intent(in) :: is_wrong
         if (is_wrong .and. has_key(draft, key)) call complain(draft, key, key//' is not allowed in test '// &
            quoted(this%test)//': '//why)
      end subroutine refuse

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
            if (is_given(draft%records(j), 'tyre_rate') .or. draft%records(j)%twin == right_twin) cycle
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
      character(word_length) :: only
      integer :: j, found

      drive = text_of(draft, 'drive')
      only = ''
      found = 0
      do j = 1, size(draft%cards)
         if (drive /= '') exit
         if (draft%records(j)%group == 'steering') drive = element(draft%records(j), 'driver', 1)
      end do
      do j = 1, size(draft%cards)
         if (drive /= '') exit
         if (draft%cards(j)%group /= joint_group) cycle
         if (lower(element(draft%records(j), 'type', 1)) /= 'driver') cycle
         found = found + 1
         if (found == 1) only = draft%cards(j)%name
      end do
      if (found == 1) drive = trim(only)
      if (drive == '') then
         call complain(draft, 'test', "the steered joint is unknown: give drive = '<driver joint>' or a &steering")
      else
         call find_driver(draft, drive, [character(1) ::], unit)
      end if
   end subroutine find_steering

end module ek_reader_tests
