!> The test rig: the rows, loads and actuations that a case of the deck adds to a suspension.
!>
!> `rig_of` returns the rig of a case as a separate value. This function cannot fail, does not read a file and does not change other
!> data. The tests are in ek_rig_test.
!>
!> `put_on` builds one flat model of a suspension and a rig. The rows and loads of the rig follow the rows and loads of the
!> suspension, because an increment needs one list of rows, one list of loads and one reaction vector λ. The first `own_rows` rows
!> of Φ and of λ belong to the suspension; "released" means without the rows after these. The case on the rig is the case with the
!> actuations of its rig. A separate rig would be one more argument of every procedure, without any other benefit.
!>
!> A wheel held by height has a driver on its centre, or on its contact point (vertical = 'patch'). On the road (vertical =
!> 'road') this driver is the height of the road, on which the contact point rests through the tyre rate. Held by vertical
!> force, the wheel is free and its load is constant. In an anti-phase case the right wheel gets the opposite load. The wheel
!> is fixed to its carrier, as with a locked brake; a freely rolling wheel transmits a force at its centre only.
!> If a solid axle reacts the drive torque, the driving force acts at the contact point.
!>
!> In a roll test, the wheels find their mean height by their loads. If nothing carries the wheels (ek_free_wheels), a second driver
!> holds this height at design.
!>
!> The parts of a rig are created once, with their names. `set_rig_numbers` computes every number of these parts that a design can
!> change: the points of its heights and loads, the tyres on its road, the range of the swept value.
module ek_rig
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_rig_test, only: rig_test_t, rig_test, of_one_wheel, swept_unit, moves_heights, rolls, steers, loads_wheels, takes_table, &
      covers_grid, drives_car, of_braking
   use ek_wheel_side, only: side_name, left_and_right, design_track, share_of_mass
   use ek_suspension, only: suspension_t, driver_unit, copy_numbers
   use ek_free_wheels, only: has_rates, unsprung_wheels
   use ek_kkt, only: kkt_t, renew_kkt
   use ek_path, only: walk_t, empty_walk
   use ek_grid, only: is_grid, grid_size, set_grid_values
   use ek_manoeuvre, only: has_manoeuvres, set_manoeuvre_values
   use ek_held_springs, only: hold_springs
   use ek_manoeuvre_loads, only: load_wheel, load_masses, hold_steering
   use ek_rig_parts, only: rig_t, acting_t, new_rig, add_height, add_load
   use ek_case, only: case_t, append_actuation, copy_case_numbers, is_mountable, follows_place, follows_tangent, follows_table
   use ek_wheel_contact, only: height_measure, put_at_contact
   implicit none(type, external)
   private
   public :: rig_t, mounted_case_t, new_rig, rig_of, add_height, put_on, mount, mount_case, mount_again, take_off, &
      set_rig_numbers, lacks_springs, counts_from_start

   real(wp), parameter :: up(3) = [0.0_wp, 0.0_wp, 1.0_wp]

   !> A case on the rig, ready to be solved.
   type :: mounted_case_t
      type(suspension_t) :: suspension             !! suspension on the rig
      type(case_t) :: case                         !! case with its actuations, and unit and name of the swept value
      type(kkt_t) :: kkt                           !! work space
      type(walk_t) :: space                        !! work space of the paths of the case
      logical, private :: is_mounted = .false.
      type(rig_t), private :: rig                  !! rig of the case
   end type mounted_case_t

   character(*), parameter :: heights(2) = [character(16) :: 'rig_left_height', 'rig_right_height']   !! deck names do not begin so
   real(wp), parameter :: nothing(3) = 0.0_wp

contains

   !> Puts a completed suspension on the rig of a case.
   pure subroutine mount(base, given, suspension, this)
      type(suspension_t), intent(in) :: base
      type(case_t), intent(in) :: given               !! is_mountable
      type(suspension_t), intent(out) :: suspension   !! on the rig
      type(case_t), intent(out) :: this               !! case with its actuations, and range, unit and name of the swept value
      type(rig_t) :: rig

      call mount_on(base, given, rig, suspension, this)
   end subroutine mount

   !> Puts a completed suspension on the rig of a case as mount does, and also returns the rig.
   pure subroutine mount_on(base, given, rig, suspension, this)
      type(suspension_t), intent(in) :: base
      type(case_t), intent(in) :: given
      type(rig_t), intent(out) :: rig
      type(suspension_t), intent(out) :: suspension
      type(case_t), intent(out) :: this

      if (are_checked) call require(is_mountable(given), 'mount: the table of the case was not read')
      rig = rig_of(base, given)
      call put_on(rig, base, suspension)
      if (given%holds_springs) call hold_springs(suspension)
      call leave_start(given, suspension)
      this = given
      if (.not. allocated(this%test)) this%test = ''
      this%actuations = rig%actuations
      this%from = rig%from
      this%to = rig%to
      this%increments = rig%increments
      this%unit = swept_unit(rig%unit)
      this%unit_name = rig%unit
      this%place_name = rig%place_name
   end subroutine mount_on

   !> Puts a completed suspension on the rig of a case, together with the work space for its solution.
   subroutine mount_case(base, given, mounted)
      type(suspension_t), intent(in) :: base
      type(case_t), intent(in) :: given                !! is_mountable
      type(mounted_case_t), intent(inout) :: mounted

      call mount_on(base, given, mounted%rig, mounted%suspension, mounted%case)
      call renew_kkt(mounted%suspension, given%uses_plan, mounted%kkt)
      call empty_walk(mounted%space)
      mounted%is_mounted = .true.
   end subroutine mount_case

   !> Puts the next design of a blueprint on the rig, like mount_case. Since `mounted` was put on the rig, only numbers of the
   !> suspension and of the case may have changed. Numbers are replaced in the existing variables: no name is copied, and no memory
   !> is allocated after the first design.
   subroutine mount_again(base, given, mounted, keeps_scales)
      type(suspension_t), intent(in) :: base
      type(case_t), intent(in) :: given                !! is_mountable
      type(mounted_case_t), intent(inout) :: mounted   !! from mount_case or mount_again; if empty, filled by mount_case
      logical, intent(in), optional :: keeps_scales    !! as for renew_kkt
      integer :: k

      if (.not. stands_there(base, given, mounted)) then
         call mount_case(base, given, mounted)
         return
      end if
      associate (rig => mounted%rig, suspension => mounted%suspension, this => mounted%case)
         call copy_numbers(base, suspension)
         if (given%holds_springs) call hold_springs(suspension)
         call leave_start(given, suspension)
         call set_rig_numbers(base, given, rig)
         call copy_rig_numbers(rig, suspension)
         do k = 1, size(rig%actuations)
            this%actuations(k)%share = rig%actuations(k)%share
            if (is_grid(given) .or. has_manoeuvres(given)) this%actuations(k)%values = rig%actuations(k)%values
         end do
         call copy_case_numbers(given, this)
         this%from = rig%from
         this%to = rig%to
         this%increments = rig%increments
         call renew_kkt(suspension, given%uses_plan, mounted%kkt, keeps_scales)
      end associate
   end subroutine mount_again

   !> Whether a case of this name was put on the rig with the same solver, and with a suspension of as many parts.
   pure logical function stands_there(base, given, mounted)
      type(suspension_t), intent(in) :: base
      type(case_t), intent(in) :: given
      type(mounted_case_t), intent(in) :: mounted

      stands_there = mounted%is_mounted
      if (.not. stands_there) return
      associate (rig => mounted%rig, on_rig => mounted%suspension)
         stands_there = size(base%bodies) == size(on_rig%bodies) .and. size(base%elements) == size(on_rig%elements) .and. &
            size(base%rows) + size(rig%rows) == size(on_rig%rows) .and. size(base%terms) + size(rig%terms) == size(on_rig%terms) &
            .and. size(base%loads) + size(rig%loads) == size(on_rig%loads) .and. given%name == mounted%case%name .and. &
            (given%uses_plan .eqv. mounted%kkt%has_plan)
      end associate
   end function stands_there

   !> Whether the states of a case count from the heights of the start state (ek_start). A case that names a load or a driver of its
   !> own begins at design, and so does the recursion of the paper.
   pure logical function counts_from_start(case)
      type(case_t), intent(in) :: case

      counts_from_start = is_test(case)
      if (counts_from_start .and. allocated(case%method)) counts_from_start = case%method /= 'recursive'
   end function counts_from_start

   !> Whether a case is a test of the rig.
   pure logical function is_test(case)
      type(case_t), intent(in) :: case
      is_test = .false.
      if (allocated(case%test)) is_test = len(case%test) > 0
   end function is_test

   !> Removes the start state from a suspension on the rig of a case that begins at design. The forces of a start state at design
   !> height remain in a test.
   pure subroutine leave_start(case, suspension)
      type(case_t), intent(in) :: case
      type(suspension_t), intent(inout) :: suspension
      logical :: is_at_design
      integer :: k

      if (counts_from_start(case)) return
      is_at_design = .true.
      do k = 1, size(suspension%wheels)
         is_at_design = is_at_design .and. .not. any(abs(suspension%wheels(k)%start_rise) > 0.0_wp)
         suspension%wheels(k)%start_rise = 0.0_wp
      end do
      if (is_at_design .and. is_test(case)) return
      do k = 1, size(suspension%loads)
         if (suspension%loads(k)%start_of > 0) suspension%loads(k)%force = 0.0_wp
      end do
   end subroutine leave_start

   !> Marks a case as not on the rig. It may then be put on the rig again with another model.
   pure subroutine take_off(mounted)
      type(mounted_case_t), intent(inout) :: mounted
      mounted%is_mounted = .false.
   end subroutine take_off

   !> Joins a suspension and a rig to one model without nesting.
   pure subroutine put_on(rig, base, suspension)
      type(rig_t), intent(in) :: rig                  !! made for this suspension
      type(suspension_t), intent(in) :: base
      type(suspension_t), intent(out) :: suspension

      suspension = base
      suspension%joints = [base%joints, rig%joints]
      suspension%rows = [base%rows, rig%rows]
      suspension%terms = [base%terms, rig%terms]
      suspension%loads = [base%loads, rig%loads]
      suspension%rig_rows = base%rig_rows + size(rig%rows)
   end subroutine put_on

   !> Whether a case needs the springs that a model lacks: its rig does not hold the height of every wheel without a spring. A
   !> case that cannot be mounted has its own reason.
   pure logical function lacks_springs(suspension, case)
      type(suspension_t), intent(in) :: suspension    !! completed, not on a rig
      type(case_t), intent(in) :: case
      type(rig_t) :: rig

      lacks_springs = .false.
      if (has_rates(suspension) .or. .not. is_mountable(case)) return
      rig = rig_of(suspension, case)
      lacks_springs = size(rig%rows) < unsprung_wheels(suspension)
   end function lacks_springs

   !> The rig of a case. A case without a test uses the driver or load that it names.
   pure type(rig_t) function rig_of(suspension, case) result(rig)
      type(suspension_t), intent(in) :: suspension    !! completed, not on a rig
      type(case_t), intent(in) :: case                !! a table that was not read has no rows: the rig then moves nothing

      rig = new_rig()
      call add_parts(suspension, case, rig)
      call set_rig_numbers(suspension, case, rig)
   end function rig_of

   !> Adds the drivers, loads and actuations of the rig of a case.
   pure subroutine add_parts(suspension, case, rig)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(rig_t), intent(inout) :: rig
      type(rig_test_t) :: test
      character(6) :: control
      integer :: wheels(2), side

      if (allocated(case%test)) test = rig_test(case%test)
      if (test%action == 0) then
         call follow_deck(suspension, case, rig)
         return
      end if
      call left_and_right(suspension, wheels)
      control = test%control
      if (allocated(case%vertical)) then
         if (len(case%vertical) > 0) control = case%vertical
      end if
      rig%unit = trim(test%unit)
      rig%place_name = trim(test%place_name)
      if (test%action /= rolls .and. control /= 'force') then
         do side = 1, 2
            if (wheels(side) > 0) call add_height(rig, suspension, trim(heights(side)), case%where, wheels(side:side), [1.0_wp], &
               control)
         end do
      end if
      select case (test%action)
      case (moves_heights)
         call move_heights(test, suspension, case, wheels, control, rig)
      case (rolls)
         call add_height(rig, suspension, 'rig_roll', case%where, wheels, [1.0_wp, -1.0_wp], control)
         if (.not. has_rates(suspension)) &
            call add_height(rig, suspension, 'rig_heave', case%where, wheels, [1.0_wp, 1.0_wp], control)
         call append_actuation(rig%actuations, '', 'rig_roll', 1.0_wp, follows_tangent)      ! times the track
         if (control == 'road') rig%place_name = 'roll of the road, left up'
         if (.not. has_rates(suspension)) rig%place_name = rig%place_name//', heave constant'
      case (steers)
         call append_actuation(rig%actuations, '', case%drive, 1.0_wp, follows_place)
         rig%place_name = 'travel of '//case%drive
         rig%unit = trim(driver_unit(suspension, case%drive))
      case (loads_wheels)
         call load_wheels(test, suspension, case, wheels, rig)
      case (takes_table)
         call take_rows(suspension, case, control, rig)
      case (covers_grid)
         do side = 1, 2
            if (wheels(side) > 0) call append_actuation(rig%actuations, '', trim(heights(side)), 1.0_wp, follows_table)
         end do
         call append_actuation(rig%actuations, '', case%drive, 1.0_wp, follows_table)
         rig%is_table = .true.
      case (drives_car)
         do side = 1, 2
            if (wheels(side) > 0) call load_wheel(suspension, case, wheels(side), side, rig)
         end do
         call load_masses(suspension, case, rig)
         call hold_steering(case, rig)
         rig%is_table = .true.
      end select
   end subroutine add_parts

   !> Adds the driver or the loads that a case without a test names.
   pure subroutine follow_deck(suspension, case, rig)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(rig_t), intent(inout) :: rig

      if (allocated(case%actuations)) then
         rig%actuations = case%actuations
         rig%place_name = 'factor of the loads'
         return
      end if
      call append_actuation(rig%actuations, case%load, case%drive, 1.0_wp, follows_place)
      rig%place_name = 'factor of load '//case%load
      if (len(case%load) > 0) return
      rig%place_name = 'change of '//case%drive
      if (case%drive == 'wheel_travel') call add_height(rig, suspension, case%drive, suspension%wheels(case%wheel)%where, &
         [case%wheel], [1.0_wp], 'centre')
      rig%unit = trim(driver_unit(suspension, case%drive))
   end subroutine follow_deck

   !> Adds the actuations that move the heights of the wheels with the swept value. With vertical = 'force', adds vertical forces
   !> instead.
   pure subroutine move_heights(test, suspension, case, wheels, control, rig)
      type(rig_test_t), intent(in) :: test
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer, intent(in) :: wheels(2)
      character(*), intent(in) :: control
      type(rig_t), intent(inout) :: rig
      real(wp) :: shares(2)
      integer :: side

      shares = test%shares
      if (of_one_wheel(test)) then
         shares = merge([1.0_wp, 0.0_wp], [0.0_wp, 1.0_wp], case%wheel == wheels(1))
         rig%place_name = 'travel of the '//trim(side_name(merge(1, 2, case%wheel == wheels(1))))//' wheel'
      end if
      if (control == 'force') then
         rig%unit = 'N'
         rig%place_name = 'change of vertical force, in place of '//rig%place_name
      else if (control == 'road') then
         rig%place_name = 'height of the road, in place of '//rig%place_name
      end if
      do side = 1, 2
         if (wheels(side) == 0) cycle
         if (control == 'force') then
            call add_load(rig, suspension, case, trim(side_name(side)), acting_t(wheels(side), .true., up, nothing), &
               shares(side), follows_place)
         else
            call append_actuation(rig%actuations, '', trim(heights(side)), shares(side), follows_place)
         end if
      end do
   end subroutine move_heights

   !> Adds a unit load on each wheel, scaled by the case.
   pure subroutine load_wheels(test, suspension, case, wheels, rig)
      type(rig_test_t), intent(in) :: test
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer, intent(in) :: wheels(2)
      type(rig_t), intent(inout) :: rig
      logical :: is_at_patch
      integer :: side

      is_at_patch = .not. test%is_at_centre .or. suspension%axle%drives_at_patch
      if (test%is_at_centre .and. is_at_patch) rig%place_name = 'driving force at each contact point'
      if (test%charts == of_braking .and. suspension%axle%brakes_at_centre) then
         is_at_patch = .false.
         rig%place_name = 'braking force at each wheel centre'
      end if
      do side = 1, 2
         if (wheels(side) > 0) call add_load(rig, suspension, case, trim(side_name(side)), &
            acting_t(wheels(side), is_at_patch, test%force, test%moment, test%has_trail), &
            merge(-1.0_wp, 1.0_wp, case%is_anti .and. side == 2), follows_place)
      end do
   end subroutine load_wheels

   !> Adds the loads and drivers of the columns of a load table. The rows of the table become the path of the case.
   pure subroutine take_rows(suspension, case, control, rig)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      character(*), intent(in) :: control
      type(rig_t), intent(inout) :: rig
      real(wp) :: unit(6)
      integer :: k, side

      rig%place_name = 'row of '//case%file
      if (.not. is_mountable(case)) return
      do k = 1, size(case%table%columns)
         associate (column => case%table%columns(k))
            if (column%wheel == 0) then
               call append_actuation(rig%actuations, '', column%name, 1.0_wp, follows_table, column%values)
            else if (column%component == 0) then
               side = merge(1, 2, suspension%wheels(column%wheel)%side < 0)
               if (control == 'force') &
                  call add_height(rig, suspension, trim(heights(side)), case%where, [column%wheel], [1.0_wp], 'centre')
               call append_actuation(rig%actuations, '', trim(heights(side)), 1.0_wp, follows_table, column%values)
            else
               unit = 0.0_wp
               unit(mod(column%component - 1, 6) + 1) = merge(-1.0_wp, 1.0_wp, &
                  suspension%is_iso .and. mod(column%component, 3) > 0)      ! x and y of the deck
               call add_load(rig, suspension, case, column%name, &
                  acting_t(column%wheel, column%component <= 6, unit(1:3), unit(4:6)), 1.0_wp, follows_table, column%values)
            end if
         end associate
      end do
      rig%is_table = .true.
   end subroutine take_rows

   !> Sets the numbers of a rig for a design of the suspension and of the case. Memory is allocated only for the first values of a
   !> grid.
   pure subroutine set_rig_numbers(suspension, case, rig)
      type(suspension_t), intent(in) :: suspension       !! completed, not on a rig
      type(case_t), intent(in) :: case
      type(rig_t), intent(inout) :: rig
      integer :: h, k, t, rows

      rig%from = case%from
      rig%to = case%to
      rig%increments = case%increments
      if (rig%is_table) then
         rows = case%table%rows
         if (is_grid(case)) rows = product(grid_size(case))
         if (has_manoeuvres(case)) rows = size(case%manoeuvres)
         rig%from = merge(0.0_wp, 1.0_wp, rows == 1)      ! from the design state, which is also reported
         rig%to = rows
         rig%increments = max(rows - 1, 1)
      end if
      t = 0
      do h = 1, size(rig%heights)
         associate (this => rig%heights(h), row => rig%rows(h), joint => rig%joints(h))
            row%compliance = 0.0_wp
            row%target = 0.0_wp
            if (counts_from_start(case)) row%target = sum(this%signs(:row%terms)* &
               suspension%wheels(this%wheels(:row%terms))%start_rise(merge(1, 2, this%is_at_centre)))
            if (this%is_road) row%compliance = sum(this%signs(:row%terms)**2/suspension%wheels(this%wheels(:row%terms))%tyre_rate)
            do k = 1, row%terms
               t = t + 1
               rig%terms(t)%measure = height_measure(suspension, this%wheels(k), this%is_at_centre)
               rig%terms(t)%coefficient = this%signs(k)
               if (k == 1) joint%arm_j = merge(suspension%wheels(this%wheels(k))%centre, &
                  suspension%wheels(this%wheels(k))%contact, this%is_at_centre)
            end do
         end associate
      end do
      do k = 1, size(rig%acting)
         associate (this => rig%acting(k), load => rig%loads(k))
            if (this%mass > 0) then
               load%arm = suspension%bodies(this%mass)%centre
               load%force = suspension%bodies(this%mass)%mass*this%force
               if (this%side > 0) load%force = share_of_mass(suspension, this%mass, this%side)*load%force
               cycle
            end if
            load%arm = suspension%wheels(this%wheel)%centre
            if (this%is_at_patch) call put_at_contact(suspension%wheels, this%wheel, load)
            load%force = this%force
            load%moment = this%moment + merge(case%offset, 0.0_wp, this%has_trail)*up
         end associate
      end do
      do k = 1, size(rig%actuations)
         if (rig%actuations(k)%law == follows_tangent) rig%actuations(k)%share = design_track(suspension)
         if (rig%actuations(k)%law == follows_table .and. is_grid(case)) &
            call set_grid_values(case, rig%actuations(k)%drive == case%drive, rig%actuations(k)%values)
         if (rig%actuations(k)%column > 0) &
            call set_manoeuvre_values(suspension, case, rig%actuations(k)%column, rig%actuations(k)%values)
      end do
   end subroutine set_rig_numbers

   !> Copies the numbers of a rig to a suspension that is already on this rig.
   pure subroutine copy_rig_numbers(rig, suspension)
      type(rig_t), intent(in) :: rig
      type(suspension_t), intent(inout) :: suspension    !! of put_on
      integer :: joints, loads, k

      joints = size(suspension%joints) - size(rig%joints)
      loads = size(suspension%loads) - size(rig%loads)
      do k = 1, size(rig%joints)
         suspension%joints(joints + k)%arm_j = rig%joints(k)%arm_j
      end do
      suspension%rows(size(suspension%rows) - size(rig%rows) + 1:) = rig%rows
      suspension%terms(size(suspension%terms) - size(rig%terms) + 1:) = rig%terms
      do k = 1, size(rig%loads)
         suspension%loads(loads + k)%load_numbers_t = rig%loads(k)%load_numbers_t
         suspension%loads(loads + k)%wheel = rig%loads(k)%wheel
      end do
   end subroutine copy_rig_numbers

end module ek_rig
