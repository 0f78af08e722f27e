!> The standard K&C tests of an axle.
module ek_standard_tests
   use ek_kinds, only: wp
   use ek_units, only: degree, millimetre
   use ek_text, only: str, lower, spaced
   use ek_case, only: case_t
   use ek_suspension, only: suspension_t
   use ek_characteristics, only: trail
   use ek_wheel_side, only: left_and_right
   implicit none(type, external)
   private
   public :: standard_tests, test_title

contains

   !> The standard tests of an axle, or those of a single wheel.
   !>
   !> A test that the deck contains (same test, phase, offset and vertical control) is taken from the deck with its range;
   !> the other cases of the deck follow. A name that the deck uses for another case gets the ending '_test'. Steering
   !> covers the travel of the rack given in &steering.
   subroutine standard_tests(suspension, own, tests)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: own(:)             !! cases of the deck
      type(case_t), allocatable, intent(out) :: tests(:)
      logical :: is_taken(size(own)), is_axle
      integer :: wheels(2), k

      call left_and_right(suspension, wheels)
      is_axle = all(wheels > 0)
      is_taken = .false.
      allocate (tests(0))
      call include('parallel_travel', .false., 0.0_wp, 80.0_wp*millimetre, 80)
      if (is_axle) call include('opposite_travel', .false., 0.0_wp, 60.0_wp*millimetre, 60)
      if (is_axle) call include('roll', .false., 0.0_wp, 3.0_wp*degree, 60)
      if (suspension%steering%has_steering) call include('steering', .false., 0.0_wp, suspension%steering%travel, 60)
      call include_both('lateral_force', 0.0_wp, 2000.0_wp)
      call include_both('lateral_force', trail, 2000.0_wp)
      call include_both('aligning_torque', 0.0_wp, 100.0_wp)
      call include('braking', .false., 0.0_wp, 2000.0_wp, 40)
      call include('traction', .false., 0.0_wp, 2000.0_wp, 40)
      do k = 1, size(own)
         if (.not. is_taken(k)) call append(own(k))
      end do

   contains

      !> Parallel loads, and for an axle also opposed loads.
      subroutine include_both(test, offset, reach)
         character(*), intent(in) :: test
         real(wp), intent(in) :: offset, reach       !! as for include
         call include(test, .false., offset, reach, 40)
         if (is_axle) call include(test, .true., offset, reach, 40)
      end subroutine include_both

      !> The deck's own case of this kind, or the standard one.
      subroutine include(test, is_anti, offset, reach, increments)
         character(*), intent(in) :: test
         logical, intent(in) :: is_anti
         real(wp), intent(in) :: offset              !! distance of the force behind the patch [m]
         real(wp), intent(in) :: reach               !! m, rad, N or N m: from −reach to +reach
         integer, intent(in) :: increments
         type(case_t) :: this
         integer :: k

         do k = 1, size(own)
            if (own(k)%test /= test .or. (own(k)%is_anti .neqv. is_anti)) cycle
            if (abs(own(k)%offset - offset) > 1.0e-6_wp .or. own(k)%vertical /= '') cycle
            is_taken(k) = .true.
            call append(own(k))
            return
         end do
         this%name = test
         if (is_anti) this%name = this%name//'_anti'
         if (abs(offset) > 0.0_wp) this%name = this%name//'_trail'
         do while (is_a_name(this%name))
            this%name = this%name//'_test'
         end do
         this%where = 'the standard tests'
         this%load = ''
         this%drive = ''
         if (test == 'steering') this%drive = suspension%steering%driver
         this%from = -reach
         this%to = reach
         this%increments = increments
         this%method = 'equilibrium'
         this%test = test
         this%vertical = ''
         this%is_anti = is_anti
         this%offset = offset
         this%file = ''
         this%target = ''
         this%has_all = .true.
         call append(this)
      end subroutine include

      !> Whether a case of the deck has this name, ignoring upper and lower case, because names become file names.
      pure logical function is_a_name(name)
         character(*), intent(in) :: name
         integer :: k

         is_a_name = .false.
         do k = 1, size(own)
            is_a_name = is_a_name .or. lower(own(k)%name) == name
         end do
      end function is_a_name

      subroutine append(this)
         type(case_t), intent(in) :: this
         type(case_t), allocatable :: more(:)
         integer :: n

         n = size(tests)
         allocate (more(n + 1))
         more(:n) = tests
         more(n + 1) = this
         call move_alloc(more, tests)
      end subroutine append

   end subroutine standard_tests

   !> A heading for a case: 'Lateral force, opposed (anti phase), 30 mm behind the patch'.
   pure function test_title(this, wheels) result(title)
      type(case_t), intent(in) :: this
      integer, intent(in) :: wheels              !! number of wheels of the model; a single wheel has no phase
      character(:), allocatable :: title

      title = this%name
      if (len(this%test) == 0) return
      title = spaced(this%test)
      title(1:1) = achar(iachar(title(1:1)) - 32)
      if (wheels > 1 .and. any(this%test == [character(15) :: 'lateral_force', 'aligning_torque', 'braking', 'traction'])) then
         if (this%is_anti) then
            title = title//', opposed (anti phase)'
         else
            title = title//', parallel (in phase)'
         end if
      end if
      if (abs(this%offset) > 0.0_wp) title = title//', '//str(this%offset/millimetre)//' mm behind the patch'
      if (this%vertical == 'patch') title = title//', patch heights held'
      if (this%vertical == 'centre') title = title//', wheel centres held'
      if (this%vertical == 'force') title = title//', by vertical force'
      if (this%vertical == 'road') title = title//', on the road'
   end function test_title

end module ek_standard_tests
