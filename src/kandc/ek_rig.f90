!> The test rig: the loads and drivers that a case of the deck applies to the wheels.
!>
!> `mount` puts a suspension on the rig for one case: it returns a copy of the suspension with the loads and the drivers of the
!> test, and a copy of the case with an actuation for each that defines how it follows the swept value.
!>
!> | test            | swept value     | left, right wheel                      | wheels held by   |
!> |-----------------|-----------------|----------------------------------------|------------------|
!> | parallel_travel | travel          | both up                                | height, driven   |
!> | opposite_travel | travel          | left up, right down                    | height, driven   |
!> | single_travel   | travel          | one up, the other at rest              | height, driven   |
!> | roll            | axle roll       | height(left) − height(right) = t tan φ | difference only: |
!> |                 |                 |                                        | constant load    |
!> | steering        | rack travel     | constant heights                       | height           |
!> | lateral_force   | force           | +y at the patch, moment force × trail  | vertical force   |
!> | braking         | force           | rearward at the patch                  | vertical force   |
!> | traction        | force           | forward at the wheel centre            | vertical force   |
!> | aligning_torque | moment          | about z, counterclockwise from above   | vertical force   |
!> | vertical_force  | force           | upward at the patch                    | vertical force   |
!> | table           | row of the file | its columns                            | vertical force   |
!>
!> A wheel held by height has a driver on its centre, or on its patch (vertical = 'patch'); on the road (vertical =
!> 'road') that driver is the road's height, on which the patch rests through the rate of its tyre; held by vertical
!> force it is free and keeps its load. In an opposed case (anti phase) the right wheel gets the opposite load. The wheel
!> is fixed to its carrier, as with a locked brake; a freely rolling wheel transmits a force at its centre only.
!> If the drive torque is reacted in a solid axle, traction acts at the patch.
module ek_rig
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_units, only: degree, millimetre
   use ek_wheel_side, only: side_name, height_name, left_and_right, design_track
   use ek_measure, only: rotation, axis_axis
   use ek_suspension, only: suspension_t, load_t, driver_row
   use ek_assembly, only: add_travel_driver, add_height_driver
   use ek_case, only: case_t, append_course, is_mountable, follows_place, follows_tangent, follows_table
   implicit none(type, external)
   private
   public :: mount

   integer, parameter :: moves_heights = 1, rolls = 2, steers = 3, loads_wheels = 4, takes_table = 5

   !> A test: what it does with the wheels.
   type :: test_t
      character(15) :: name
      integer :: kind                        !! one of those above
      character(6) :: control                !! how the wheels are held, unless the case says otherwise
      character(3) :: unit_name              !! of the swept value
      character(45) :: place_name            !! of the swept value, for moves_heights and loads_wheels
      real(wp) :: shares(2) = 1.0_wp         !! moves_heights: height per swept value, left and right
      real(wp) :: force(3) = 0.0_wp          !! loads_wheels: force and moment per swept value on the left wheel, at the patch
      real(wp) :: moment(3) = 0.0_wp
   end type test_t

   character(*), parameter :: wheel_travel = 'wheel travel'
   real(wp), parameter :: up(3) = [0.0_wp, 0.0_wp, 1.0_wp], right(3) = [0.0_wp, 1.0_wp, 0.0_wp], rear(3) = [1.0_wp, 0.0_wp, 0.0_wp]

   type(test_t), parameter :: tests(11) = [ &
      test_t('parallel_travel', moves_heights, 'centre', 'mm', wheel_travel), &
      test_t('opposite_travel', moves_heights, 'centre', 'mm', 'travel of the left wheel, right wheel opposed', &
         shares=[1.0_wp, -1.0_wp]), &
      test_t('single_travel', moves_heights, 'centre', 'mm', ''), &
      test_t('roll', rolls, 'patch', 'deg', 'axle roll, left wheel up'), &
      test_t('steering', steers, 'centre', '', ''), &
      test_t('lateral_force', loads_wheels, 'force', 'N', 'lateral force at each patch', force=right), &
      test_t('braking', loads_wheels, 'force', 'N', 'braking force at each patch', force=rear), &
      test_t('traction', loads_wheels, 'force', 'N', 'traction force at each wheel centre', force=-rear), &
      test_t('aligning_torque', loads_wheels, 'force', 'N m', 'aligning torque on each wheel', moment=up), &
      test_t('vertical_force', loads_wheels, 'force', 'N', 'change of vertical force at each patch', force=up), &
      test_t('table', takes_table, 'force', '-', '')]

contains

   !> Puts a completed suspension on the rig for a case. A case without a test uses the drive or load that it names.
   pure subroutine mount(base, given, suspension, this)
      type(suspension_t), intent(in) :: base
      type(case_t), intent(in) :: given               !! is_mountable
      type(suspension_t), intent(out) :: suspension   !! on the rig
      type(case_t), intent(out) :: this               !! with its actuations, unit and name of the swept value
      integer :: k

      if (are_checked) call require(is_mountable(given), 'mount: the table of the case was not read')
      suspension = base
      this = given
      if (.not. allocated(this%test)) this%test = ''
      if (len(this%test) == 0) then
         if (this%drive == 'wheel_travel') call add_travel_driver(suspension, this%wheel)
         call name_place(suspension, this)
         return
      end if
      if (allocated(this%courses)) deallocate (this%courses)
      allocate (this%courses(0))
      do k = 1, size(tests)
         if (tests(k)%name == this%test) call apply(tests(k), suspension, this)
      end do
   end subroutine mount

   !> The loads, drivers and actuations of a test.
   pure subroutine apply(test, suspension, this)
      type(test_t), intent(in) :: test
      type(suspension_t), intent(inout) :: suspension
      type(case_t), intent(inout) :: this
      character(:), allocatable :: control
      integer :: wheels(2)

      call left_and_right(suspension, wheels)
      control = trim(test%control)
      if (allocated(this%vertical)) then
         if (len(this%vertical) > 0) control = this%vertical
      end if
      this%unit = unit_of(test%unit_name)
      this%unit_name = trim(test%unit_name)
      this%place_name = trim(test%place_name)
      if (test%kind /= rolls) call hold_heights(suspension, this, wheels, control)
      select case (test%kind)
      case (moves_heights)
         call move_heights(test, suspension, this, wheels, control)
      case (rolls)
         call add_height(suspension, this, 'rig_roll', wheels, [1.0_wp, -1.0_wp], control)
         call append_course(this%courses, '', 'rig_roll', design_track(suspension), follows_tangent)
         if (control == 'road') this%place_name = 'roll of the road, left up'
      case (steers)
         call append_course(this%courses, '', this%drive, 1.0_wp, follows_place)
         this%place_name = 'travel of '//this%drive
         call take_unit_of(suspension, driver_row(suspension, this%drive), this)
      case (loads_wheels)
         call load_wheels(test, suspension, this, wheels)
      case (takes_table)
         call take_rows(suspension, this)
      end select
   end subroutine apply

   !> Heights that follow the swept value; with vertical = 'force', vertical forces instead.
   pure subroutine move_heights(test, suspension, this, wheels, control)
      type(test_t), intent(in) :: test
      type(suspension_t), intent(inout) :: suspension
      type(case_t), intent(inout) :: this
      integer, intent(in) :: wheels(2)
      character(*), intent(in) :: control
      real(wp) :: shares(2)
      integer :: side

      shares = test%shares
      if (test%name == 'single_travel') then
         shares = merge([1.0_wp, 0.0_wp], [0.0_wp, 1.0_wp], this%wheel == wheels(1))
         this%place_name = 'travel of the '//trim(side_name(merge(1, 2, this%wheel == wheels(1))))//' wheel'
      end if
      if (control == 'force') then
         this%unit = 1.0_wp
         this%unit_name = 'N'
         this%place_name = 'change of vertical force, in place of '//this%place_name
      else if (control == 'road') then
         this%place_name = 'height of the road, in place of '//this%place_name
      end if
      do side = 1, 2
         if (wheels(side) == 0) cycle
         if (control == 'force') then
            call add_wheel_load(suspension, this, wheels(side), trim(side_name(side)), up, [0.0_wp, 0.0_wp, 0.0_wp], .true., &
               shares(side), follows_place)
         else
            call append_course(this%courses, '', height_name(side), shares(side), follows_place)
         end if
      end do
   end subroutine move_heights

   !> A driver of the height of each wheel's centre or patch, or of the road under it, unless the vertical force is held.
   pure subroutine hold_heights(suspension, this, wheels, control)
      type(suspension_t), intent(inout) :: suspension
      type(case_t), intent(in) :: this
      integer, intent(in) :: wheels(2)
      character(*), intent(in) :: control
      integer :: side

      if (control == 'force') return
      do side = 1, 2
         if (wheels(side) > 0) call add_height(suspension, this, height_name(side), wheels(side:side), [1.0_wp], control)
      end do
   end subroutine hold_heights

   !> A driver of Σ sign × height of wheel centres, patches, or of the road under the tyres.
   pure subroutine add_height(suspension, this, name, wheels, signs, control)
      type(suspension_t), intent(inout) :: suspension
      type(case_t), intent(in) :: this
      character(*), intent(in) :: name
      integer, intent(in) :: wheels(:)
      real(wp), intent(in) :: signs(:)         !! one per wheel
      character(*), intent(in) :: control      !! 'centre', 'patch' or 'road'
      real(wp) :: tyre_rate(size(wheels))

      if (control == 'road') then
         tyre_rate = suspension%wheels(wheels)%tyre_rate
         call add_height_driver(suspension, name, this%where, wheels, signs, .true., tyre_rate)
      else
         call add_height_driver(suspension, name, this%where, wheels, signs, control == 'patch')
      end if
   end subroutine add_height

   !> A unit load on each wheel, scaled by the case.
   pure subroutine load_wheels(test, suspension, this, wheels)
      type(test_t), intent(in) :: test
      type(suspension_t), intent(inout) :: suspension
      type(case_t), intent(inout) :: this
      integer, intent(in) :: wheels(2)
      real(wp) :: moment(3)
      logical :: is_at_patch
      integer :: side

      moment = test%moment
      if (test%name == 'lateral_force') moment(3) = this%offset
      is_at_patch = test%name /= 'traction' .or. suspension%axle%drives_at_patch
      if (test%name == 'traction' .and. is_at_patch) this%place_name = 'traction force at each patch'
      do side = 1, 2
         if (wheels(side) == 0) cycle
         call add_wheel_load(suspension, this, wheels(side), trim(side_name(side)), test%force, moment, is_at_patch, &
            merge(-1.0_wp, 1.0_wp, this%is_anti .and. side == 2), follows_place)
      end do
   end subroutine load_wheels

   !> The loads and drivers of the columns of a table; its rows become the path of the case.
   pure subroutine take_rows(suspension, this)
      type(suspension_t), intent(inout) :: suspension
      type(case_t), intent(inout) :: this
      real(wp) :: unit(6), direction
      character(:), allocatable :: height
      integer :: k

      this%place_name = 'row of '//this%file
      if (.not. is_mountable(this)) return
      do k = 1, size(this%table%columns)
         associate (column => this%table%columns(k))
            if (column%wheel == 0) then
               call append_course(this%courses, '', column%name, 1.0_wp, follows_table, column%values)
            else if (column%component == 0) then
               height = height_name(merge(1, 2, suspension%wheels(column%wheel)%side < 0))
               if (driver_row(suspension, height) == 0) &
                  call add_height(suspension, this, height, [column%wheel], [1.0_wp], 'centre')
               call append_course(this%courses, '', height, 1.0_wp, follows_table, column%values)
            else
               direction = 1.0_wp
               if (suspension%is_iso .and. mod(column%component, 3) > 0) direction = -1.0_wp      ! x and y of the deck
               unit = 0.0_wp
               unit(mod(column%component - 1, 6) + 1) = direction
               call add_wheel_load(suspension, this, column%wheel, column%name, unit(1:3), unit(4:6), column%component <= 6, &
                  1.0_wp, follows_table, column%values)
            end if
         end associate
      end do
      this%from = 1.0_wp
      this%to = this%table%rows
      this%increments = this%table%rows - 1
      if (this%table%rows == 1) then      ! from the design state, which is also reported
         this%from = 0.0_wp
         this%increments = 1
      end if
   end subroutine take_rows

   !> A load 'rig_<name>' on a wheel, and the actuation that scales it.
   pure subroutine add_wheel_load(suspension, this, wheel, name, force, moment, is_at_patch, share, law, values)
      type(suspension_t), intent(inout) :: suspension
      type(case_t), intent(inout) :: this
      integer, intent(in) :: wheel
      character(*), intent(in) :: name
      real(wp), intent(in) :: force(3), moment(3)
      logical, intent(in) :: is_at_patch       !! otherwise at the wheel centre
      real(wp), intent(in) :: share
      integer, intent(in) :: law
      real(wp), intent(in), optional :: values(:)
      type(load_t) :: load

      load%name = 'rig_'//name
      load%where = this%where
      load%body = suspension%wheels(wheel)%body
      load%arm = suspension%wheels(wheel)%centre
      if (is_at_patch) load%arm = suspension%wheels(wheel)%contact
      load%force = force
      load%moment = moment
      load%is_case = .true.
      suspension%loads = [suspension%loads, load]
      call append_course(this%courses, load%name, '', share, law, values)
   end subroutine add_wheel_load

   !> Unit and name of the swept value of a case without a test.
   pure subroutine name_place(suspension, this)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(inout) :: this

      this%unit = 1.0_wp
      this%unit_name = '-'
      if (allocated(this%courses)) then
         this%place_name = 'factor of the loads'
      else if (len(this%load) > 0) then
         this%place_name = 'factor of load '//this%load
      else
         this%place_name = 'change of '//this%drive
         call take_unit_of(suspension, driver_row(suspension, this%drive), this)
      end if
   end subroutine name_place

   !> The unit of the measure of a row.
   pure subroutine take_unit_of(suspension, row, this)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: row
      type(case_t), intent(inout) :: this

      this%unit_name = 'mm'
      if (row > 0) then
         select case (suspension%terms(suspension%rows(row)%first)%measure%kind)
         case (rotation)
            this%unit_name = 'deg'
         case (axis_axis)
            this%unit_name = '-'
         end select
      end if
      this%unit = unit_of(this%unit_name)
   end subroutine take_unit_of

   !> The SI value of a unit of the swept value.
   pure real(wp) function unit_of(name) result(unit)
      character(*), intent(in) :: name

      select case (name)
      case ('mm')
         unit = millimetre
      case ('deg')
         unit = degree
      case default
         unit = 1.0_wp
      end select
   end function unit_of

end module ek_rig
