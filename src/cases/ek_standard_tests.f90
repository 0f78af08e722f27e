!> The standard K&C tests of an axle.
module ek_standard_tests
   use ek_kinds, only: wp, millimetre
   use ek_text, only: str, lower, spaced
   use ek_rig_test, only: rig_test_t, rig_tests, rig_test, needs_both, swept_unit, steers, rolls, moves_heights, covers_grid
   use ek_case, only: case_t, default_tolerance
   use ek_grid, only: is_grid
   use ek_suspension, only: suspension_t, driver_unit
   use ek_kkt, only: kkt_t, new_kkt
   use ek_path, only: path_t, sweep
   use ek_test_result, only: test_result_t
   use ek_rig, only: mount, lacks_springs
   use ek_balance, only: balance
   use ek_start, only: start_space_t, find_start
   use ek_error, only: error_t
   use ek_characteristics, only: trail
   use ek_wheel_side, only: left_and_right
   implicit none(type, external)
   private
   public :: standard_tests, cover_rack_travel, test_title, held_text, describe_sweep, unit_of_swept_value

   character(*), parameter :: of_standard = 'the standard tests'
   real(wp), parameter :: inside = 0.95_wp          !! share of the travel to a lock that a standard test covers
   real(wp), parameter :: too_short = 0.05_wp       !! share of the range: a model that locks earlier is left to the test

contains

   !> Sets what the windows of a test depend on: the range of its swept value around design, and the angle of the steering wheel for
   !> one unit of its driver.
   pure subroutine describe_sweep(suspension, case, test)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(test_result_t), intent(inout) :: test
      real(wp) :: ends(2)

      ends = abs([case%from, case%to])/unit_of_swept_value(suspension, case)
      if (case%from*case%to < 0.0_wp) then
         test%reach = minval(ends)
      else if (case%from*case%to <= 0.0_wp) then
         test%reach = maxval(ends)                    ! one side of design
      end if
      associate (steering => suspension%steering)
         if (steering%has_steering .and. abs(steering%ratio) > 0.0_wp) &
            test%wheel_size = 360.0_wp*swept_unit(driver_unit(suspension, steering%driver))/abs(steering%ratio)
      end associate
   end subroutine describe_sweep

   !> SI value of the unit of the swept value of a case that is not on the rig.
   pure real(wp) function unit_of_swept_value(suspension, case) result(unit)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(rig_test_t) :: test

      if (allocated(case%test)) test = rig_test(case%test)
      if (test%action == 0) then
         unit = 1.0_wp                                ! factor of a load
         if (len(case%load) == 0 .and. .not. allocated(case%actuations)) unit = swept_unit(driver_unit(suspension, case%drive))
      else if (test%action == steers) then
         unit = swept_unit(driver_unit(suspension, case%drive))
      else
         unit = swept_unit(test%unit)
      end if
   end function unit_of_swept_value

   !> Lists the standard tests of an axle, or the standard tests of a single wheel.
   !>
   !> A test that the deck contains (with this kind, phase and offset, and the vertical control of the test) is taken from the deck
   !> with its range. The other cases of the deck follow. A test whose name the deck uses for another case gets the suffix '_test'.
   !> Travel and roll end at 95 % of a lock of the axle inside their range. Steering covers the travel of the rack of &steering;
   !> a grid also covers the range of the parallel travel. A grid costs
   !> as much as several other tests, so a grid is listed only if it is requested. If nothing carries the wheels, only tests that
   !> hold the heights of the wheels are listed.
   subroutine standard_tests(suspension, own, tests, asked)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: own(:)             !! cases of the deck
      type(case_t), allocatable, intent(out) :: tests(:)
      character(*), intent(in), optional :: asked    !! name of a test that runs on request only; '*': all such tests
      type(suspension_t) :: started
      logical :: is_taken(size(own))
      integer :: wheels(2), place, trails, phase, k, t

      call set_heights(suspension, started)
      call left_and_right(suspension, wheels)
      is_taken = .false.
      allocate (tests(0))
      do place = 1, maxval(rig_tests%place)
         k = findloc(rig_tests%place, place, dim=1)
         if (needs_both(rig_tests(k)) .and. any(wheels == 0)) cycle
         if (any(rig_tests(k)%action == [steers, covers_grid]) .and. .not. suspension%steering%has_steering) cycle
         if (rig_tests(k)%is_on_request) then
            if (.not. present(asked)) cycle
            if (asked /= '*' .and. rig_tests(k)%name /= asked) cycle
         end if
         do trails = 0, merge(1, 0, rig_tests(k)%has_trail)
            do phase = 1, merge(rig_tests(k)%phases, 1, all(wheels > 0))
               call include(rig_tests(k), phase == 2, trails*trail)
            end do
         end do
      end do
      do t = 1, size(own)
         if (.not. (is_taken(t) .or. lacks_springs(suspension, own(t)))) call append(own(t))
      end do

   contains

      !> Includes a test: the deck's own case if the deck has one, otherwise the standard test.
      subroutine include(test, is_anti, offset)
         type(rig_test_t), intent(in) :: test
         logical, intent(in) :: is_anti
         real(wp), intent(in) :: offset              !! distance of the force aft of the contact point [m]
         type(case_t) :: this
         integer :: k

         do k = 1, size(own)
            if (own(k)%test /= test%name .or. (own(k)%is_anti .neqv. is_anti)) cycle
            if (abs(own(k)%offset - offset) > 1.0e-6_wp .or. own(k)%vertical /= '') cycle
            is_taken(k) = .true.
            if (.not. lacks_springs(suspension, own(k))) call append(own(k))
            return
         end do
         this%name = trim(test%name)
         if (is_anti) this%name = this%name//'_anti'
         if (abs(offset) > 0.0_wp) this%name = this%name//'_trail'
         do while (any([(lower(own(k)%name) == this%name, k=1, size(own))]))      ! names become file names
            this%name = this%name//'_test'
         end do
         this%where = of_standard
         this%load = ''
         this%drive = ''
         this%to = test%reach*swept_unit(merge('mm ', test%unit, test%action == covers_grid))
         if (any(test%action == [steers, covers_grid])) this%drive = suspension%steering%driver
         this%from = -this%to
         do k = 1, merge(size(tests), 0, test%action == covers_grid)
            if (tests(k)%test /= 'parallel_travel') cycle
            this%from = tests(k)%from
            this%to = tests(k)%to
         end do
         this%increments = test%increments
         this%method = 'equilibrium'
         this%test = trim(test%name)
         call cover_rack_travel(suspension, this)
         this%vertical = ''
         this%is_anti = is_anti
         this%offset = offset
         this%file = ''
         this%target = ''
         if (lacks_springs(suspension, this)) return
         if (any(test%action == [moves_heights, rolls])) call stay_inside_locks(started, this)
         this%has_all = .true.
         call append(this)
      end subroutine include

      subroutine append(this)
         type(case_t), intent(in) :: this
         tests = [tests, this]
      end subroutine append

   end subroutine standard_tests

   !> Copies a suspension and sets the heights of its start state (ek_start), for the ranges of tests. If there is no such state, the
   !> heights are the design heights.
   subroutine set_heights(suspension, started)
      type(suspension_t), intent(in) :: suspension
      type(suspension_t), intent(out) :: started
      type(start_space_t) :: space
      type(error_t), allocatable :: error
      logical :: is_found
      integer :: k

      started = suspension
      do k = 1, size(started%wheels)
         if (any(abs(started%wheels(k)%start_rise) > 0.0_wp)) return
      end do
      if (started%start == 'height') then
         do k = 1, size(started%wheels)
            started%wheels(k)%start_rise = started%start_height
         end do
      else if (started%start /= '') then
         call balance(started, default_tolerance, error)
         if (.not. allocated(error)) call find_start(started, default_tolerance, space, is_found)
      end if
   end subroutine set_heights

   !> Restricts the range of a standard test whose axle locks inside it: to 95 % of the travel or roll that the axle reaches on this
   !> side of design. The numbers are those of the deck, without its preload trim: the wheels are held by height, so that preloads
   !> hardly change what the axle reaches. Of a model that cannot be solved at design, the range is unchanged.
   subroutine stay_inside_locks(suspension, this)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(inout) :: this
      type(suspension_t) :: on_rig
      type(case_t) :: trial
      type(path_t) :: path
      type(kkt_t) :: kkt
      real(wp) :: reached
      integer :: side

      call mount(suspension, this, on_rig, trial)
      trial%increments = 8                           ! steps are divided where they must be
      kkt = new_kkt(on_rig)
      call sweep(on_rig, trial, path, kkt)
      if (path%start == 0) return
      if (.not. path%is_reached(path%start)) return
      do side = 1, 2
         if (path%failure(side)%state == 0) cycle
         reached = path%failure(side)%reached
         if (abs(reached) < too_short*abs(this%to)) cycle
         if (reached > 0.0_wp) this%to = inside*reached
         if (reached < 0.0_wp) this%from = inside*reached
      end do
   end subroutine stay_inside_locks

   !> Sets the range of a standard test of steering, or of a grid, to the whole rack travel. The range of other tests is unchanged.
   pure subroutine cover_rack_travel(suspension, this)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(inout) :: this

      if (is_grid(this)) then
         this%steer_to = suspension%steering%travel
         this%steer_from = -this%steer_to
      end if
      if (.not. any(rig_tests%action == steers .and. rig_tests%name == this%test)) return
      this%to = suspension%steering%travel
      this%from = -this%to
   end subroutine cover_rack_travel

   !> The title of a test: 'Lateral force, anti-phase, 30 mm aft of the contact point'.
   pure function test_title(this, wheels, holds_heave) result(title)
      type(case_t), intent(in) :: this
      integer, intent(in) :: wheels              !! number of wheels of the model; a single wheel has no phase
      logical, intent(in), optional :: holds_heave   !! nothing carries the wheels: a roll test holds their mean height
      character(:), allocatable :: title
      type(rig_test_t) :: test

      title = this%name
      if (len(this%test) == 0) return
      title = spaced(this%test)
      title(1:1) = achar(iachar(title(1:1)) - 32)
      test = rig_test(this%test)
      if (wheels > 1 .and. test%has_phase) &
         title = title//trim(merge(', anti-phase', ', in phase  ', this%is_anti))
      if (abs(this%offset) > 0.0_wp) title = title//', '//str(this%offset/millimetre)//' mm aft of the contact point'
      if (this%vertical == 'patch') title = title//', contact point heights constant'
      if (this%vertical == 'centre') title = title//', wheel centre heights constant'
      if (this%vertical == 'force') title = title//', by vertical force'
      if (this%vertical == 'road') title = title//', on the road'
      if (present(holds_heave)) then
         if (holds_heave .and. test%action == rolls) title = title//', heave constant'
      end if
      if (is_shortened(this, test)) title = title//', '//str(this%from/swept_unit(test%unit), 3)//' to '// &
         str(this%to/swept_unit(test%unit), 3)//' '//trim(test%unit)//' (95 % of the way to the lock)'
   end function test_title

   !> Whether the range of a standard test ends before a lock of the axle.
   pure logical function is_shortened(this, test)
      type(case_t), intent(in) :: this
      type(rig_test_t), intent(in) :: test
      real(wp) :: reach

      reach = 0.999_wp*test%reach*swept_unit(test%unit)
      is_shortened = .false.
      if (allocated(this%where)) is_shortened = this%where == of_standard
      if (.not. any(test%action == [moves_heights, rolls])) is_shortened = .false.
      if (is_shortened) is_shortened = this%to < reach .or. this%from > -reach
   end function is_shortened

   !> The condition of the wheels in a test: 'vertical force held'; '' for a case that is not a test.
   pure function held_text(this, holds_heave) result(held)
      type(case_t), intent(in) :: this
      logical, intent(in) :: holds_heave         !! nothing carries the wheels: a roll test holds their mean height
      character(48) :: held
      type(rig_test_t) :: test
      character(6) :: control
      character(10) :: word

      held = ''
      if (len(this%test) == 0) return
      test = rig_test(this%test)
      control = test%control
      if (this%vertical /= '') control = this%vertical
      word = 'constant'
      if (any(test%action == [moves_heights, covers_grid])) word = 'prescribed'
      select case (control)
      case ('centre')
         held = 'wheel centre heights '//word
      case ('patch')
         held = 'contact point heights '//word
      case ('road')
         held = 'wheels on a rigid road'
      case ('force')
         held = 'vertical force constant'
      end select
      if (test%action /= rolls .or. control == 'force') return
      held = 'height difference prescribed, axle load constant'
      if (holds_heave) held = 'height difference prescribed, heave constant'
   end function held_text

end module ek_standard_tests
