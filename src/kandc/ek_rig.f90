!> The test rig: the loads and drivers that a case of the deck applies to the wheels.
!>
!> `mount` puts a suspension on the rig for one case: it adds the loads and the drivers of the test, and
!> an actuation for each that defines how it follows the swept value.
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
   use ek_error, only: error_t
   use ek_units, only: degree, millimetre
   use ek_wheel_side, only: side_name, height_name, left_and_right, design_track
   use ek_measure, only: rotation, axis_axis
   use ek_suspension, only: suspension_t, load_t, driver_row
   use ek_builder, only: add_travel_driver, add_height_driver, add_load
   use ek_case, only: case_t, append_course, follows_place, follows_tangent
   use ek_load_table, only: mount_table
   implicit none(type, external)
   private
   public :: mount

contains

   !> Puts a completed suspension on the rig for a case. A case without a test uses the drive or load that it names.
   subroutine mount(suspension, this, error)
      type(suspension_t), intent(inout) :: suspension
      type(case_t), intent(inout) :: this
      type(error_t), allocatable, intent(out) :: error      !! exit_deck: the test does not fit the model; exit_file
      integer :: wheels(2), row

      if (.not. allocated(this%test)) this%test = ''
      if (len(this%test) == 0) then
         if (this%drive == 'wheel_travel') call add_travel_driver(suspension, this%wheel)
         call name_place()
         return
      end if
      call left_and_right(suspension, wheels)
      if (allocated(this%courses)) deallocate (this%courses)
      allocate (this%courses(0))
      this%unit = 1.0_wp
      this%unit_name = 'N'

      select case (this%test)
      case ('parallel_travel')
         call drive_heights([1.0_wp, 1.0_wp], 'wheel travel')
      case ('opposite_travel')
         call drive_heights([1.0_wp, -1.0_wp], 'travel of the left wheel, right wheel opposed')
      case ('single_travel')
         row = merge(1, 2, this%wheel == wheels(1))
         call drive_heights(merge([1.0_wp, 0.0_wp], [0.0_wp, 1.0_wp], row == 1), 'travel of the '// &
            trim(merge('left ', 'right', row == 1))//' wheel')
      case ('roll')
         if (control('patch') == 'road') then
            call add_height_driver(suspension, 'rig_roll', this%where, wheels, [1.0_wp, -1.0_wp], .true., &
               suspension%wheels(wheels)%tyre_rate)
         else
            call add_height_driver(suspension, 'rig_roll', this%where, wheels, [1.0_wp, -1.0_wp], control('patch') == 'patch')
         end if
         call append_course(this%courses, '', 'rig_roll', design_track(suspension), follows_tangent)
         this%unit = degree
         this%unit_name = 'deg'
         this%place_name = trim(merge('roll of the road, left up', 'axle roll, left wheel up ', control('patch') == 'road'))
      case ('steering')
         call hold_heights('centre')
         call append_course(this%courses, '', this%drive, 1.0_wp, follows_place)
         row = driver_row(suspension, this%drive)
         this%place_name = 'travel of '//this%drive
         call take_unit_of(row)
      case ('lateral_force')
         call hold_heights('force')
         call load_wheels([0.0_wp, 1.0_wp, 0.0_wp], [0.0_wp, 0.0_wp, this%offset], .true.)
         this%place_name = 'lateral force at each patch'
      case ('braking')
         call hold_heights('force')
         call load_wheels([1.0_wp, 0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp, 0.0_wp], .true.)
         this%place_name = 'braking force at each patch'
      case ('traction')
         call hold_heights('force')
         call load_wheels([-1.0_wp, 0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp, 0.0_wp], suspension%axle%drives_at_patch)
         this%place_name = 'traction force at each '//trim(merge('patch       ', 'wheel centre', suspension%axle%drives_at_patch))
      case ('aligning_torque')
         call hold_heights('force')
         call load_wheels([0.0_wp, 0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp, 1.0_wp], .true.)
         this%place_name = 'aligning torque on each wheel'
         this%unit_name = 'N m'
      case ('vertical_force')
         call load_wheels([0.0_wp, 0.0_wp, 1.0_wp], [0.0_wp, 0.0_wp, 0.0_wp], .true.)
         this%place_name = 'change of vertical force at each patch'
      case ('table')
         call hold_heights('force')
         this%place_name = 'row of '//this%file
         this%unit_name = '-'
         call mount_table(suspension, this, wheels, error)
      end select

   contains

      !> The vertical control of the wheels: from the deck, or the default of the test.
      function control(default) result(word)
         character(*), intent(in) :: default
         character(:), allocatable :: word
         word = default
         if (allocated(this%vertical)) then
            if (len(this%vertical) > 0) word = this%vertical
         end if
      end function control

      !> Heights or vertical forces that follow the swept value.
      subroutine drive_heights(shares, place_name)
         real(wp), intent(in) :: shares(2)        !! left, right; of a single wheel the first or second alone
         character(*), intent(in) :: place_name
         integer :: side

         this%place_name = place_name
         if (control('centre') == 'force') then
            this%place_name = 'change of vertical force, in place of '//place_name
            do side = 1, 2
               if (wheels(side) == 0) cycle
               call add_wheel_load(side, [0.0_wp, 0.0_wp, 1.0_wp], [0.0_wp, 0.0_wp, 0.0_wp], .true., shares(side))
            end do
            return
         end if
         this%unit = millimetre
         this%unit_name = 'mm'
         if (control('centre') == 'road') this%place_name = 'height of the road, in place of '//place_name
         call hold_heights('centre')
         do side = 1, 2
            if (wheels(side) > 0) call append_course(this%courses, '', height_name(side), shares(side), follows_place)
         end do
      end subroutine drive_heights

      !> A driver of the height of each wheel's centre or patch, or of the road under it, unless the vertical force is held.
      subroutine hold_heights(default)
         character(*), intent(in) :: default
         integer :: side

         if (control(default) == 'force') return
         do side = 1, 2
            if (wheels(side) == 0) cycle
            if (control(default) == 'road') then
               call add_height_driver(suspension, height_name(side), this%where, wheels(side:side), [1.0_wp], .true., &
                  suspension%wheels(wheels(side:side))%tyre_rate)
            else
               call add_height_driver(suspension, height_name(side), this%where, wheels(side:side), [1.0_wp], &
                  control(default) == 'patch')
            end if
         end do
      end subroutine hold_heights

      !> A unit load on each wheel, scaled by the case.
      subroutine load_wheels(force, moment, is_at_patch)
         real(wp), intent(in) :: force(3), moment(3)
         logical, intent(in) :: is_at_patch
         integer :: side

         do side = 1, 2
            if (wheels(side) > 0) call add_wheel_load(side, force, moment, is_at_patch, &
               merge(-1.0_wp, 1.0_wp, this%is_anti .and. side == 2))
         end do
      end subroutine load_wheels

      subroutine add_wheel_load(side, force, moment, is_at_patch, share)
         integer, intent(in) :: side
         real(wp), intent(in) :: force(3), moment(3), share
         logical, intent(in) :: is_at_patch
         type(load_t) :: load

         associate (wheel => suspension%wheels(wheels(side)))
            load%name = 'rig_'//trim(side_name(side))
            load%where = this%where
            load%body = wheel%body
            load%arm = wheel%centre
            if (is_at_patch) load%arm = wheel%contact
         end associate
         load%force = force
         load%moment = moment
         load%is_case = .true.
         call add_load(suspension, load)
         call append_course(this%courses, load%name, '', share, follows_place)
      end subroutine add_wheel_load

      !> Unit and name of the swept value of a case without a test.
      subroutine name_place()
         this%unit = 1.0_wp
         this%unit_name = '-'
         if (allocated(this%courses)) then
            this%place_name = 'factor of the loads'
         else if (len(this%load) > 0) then
            this%place_name = 'factor of load '//this%load
         else
            this%place_name = 'change of '//this%drive
            call take_unit_of(driver_row(suspension, this%drive))
         end if
      end subroutine name_place

      !> The unit of the measure of a row.
      subroutine take_unit_of(row)
         integer, intent(in) :: row

         this%unit = millimetre
         this%unit_name = 'mm'
         if (row == 0) return
         select case (suspension%terms(suspension%rows(row)%first)%measure%kind)
         case (rotation)
            this%unit = degree
            this%unit_name = 'deg'
         case (axis_axis)
            this%unit = 1.0_wp
            this%unit_name = '-'
         end select
      end subroutine take_unit_of

   end subroutine mount

end module ek_rig
