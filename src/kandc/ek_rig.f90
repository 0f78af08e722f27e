!> The test rig: the rows, loads and actuations that a case of the deck adds to a suspension.
!>
!> `rig_of` makes the rig of a case as a value of its own; it cannot fail, reads no file and changes nothing. The tests are in
!> ek_rig_test.
!>
!> `put_on` makes one flat model of a suspension and a rig, its rows and loads after those of the suspension: an increment needs
!> one list of rows, one of loads and one reaction vector λ. The split is by number: `own_rows` of the suspension come first in Φ
!> and in λ, and "released" means without the rows behind them. In the same way the case on the rig is the case with the
!> actuations of its rig: a rig carried beside both would be one more argument of every procedure and split nothing else.
!>
!> A wheel held by height has a driver on its centre, or on its patch (vertical = 'patch'); on the road (vertical =
!> 'road') that driver is the road's height, on which the patch rests through the rate of its tyre; held by vertical
!> force it is free and keeps its load. In an opposed case (anti phase) the right wheel gets the opposite load. The wheel
!> is fixed to its carrier, as with a locked brake; a freely rolling wheel transmits a force at its centre only.
!> If the drive torque is reacted in a solid axle, traction acts at the patch.
module ek_rig
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_rig_test, only: rig_test_t, rig_test, of_one_wheel, swept_unit, moves_heights, rolls, steers, loads_wheels, takes_table
   use ek_wheel_side, only: side_name, left_and_right, design_track
   use ek_measure, only: measure_t, global_gap, rotation, axis_axis
   use ek_joint, only: joint_t, row_t, term_t, joint_kinds
   use ek_suspension, only: suspension_t, load_t, driver_row
   use ek_kkt, only: kkt_t, new_kkt
   use ek_case, only: case_t, actuation_t, append_actuation, is_mountable, follows_place, follows_tangent, follows_table
   implicit none(type, external)
   private
   public :: rig_t, mounted_case_t, new_rig, rig_of, add_height, put_on, mount, mount_case

   !> What a case adds to a suspension. Its joints, rows, terms and loads count on from those of the suspension.
   type :: rig_t
      type(joint_t), allocatable :: joints(:)            !! drivers of heights, one row each
      type(row_t), allocatable :: rows(:)
      type(term_t), allocatable :: terms(:)
      type(load_t), allocatable :: loads(:)
      type(actuation_t), allocatable :: actuations(:)    !! of its own loads and rows, and of those that the case names
      real(wp) :: from = 0.0_wp, to = 0.0_wp             !! swept values, SI
      integer :: increments = 0
      character(:), allocatable :: unit, place_name      !! of the swept value: 'mm', 'wheel travel'
   end type rig_t

   !> A case on the rig, ready to be solved.
   type :: mounted_case_t
      type(suspension_t) :: suspension             !! on the rig
      type(case_t) :: case                         !! with its actuations, unit and name of the swept value
      type(kkt_t) :: kkt                           !! work space
   end type mounted_case_t

   character(*), parameter :: heights(2) = [character(16) :: 'rig_left_height', 'rig_right_height']   !! no name of a deck begins so
   real(wp), parameter :: up(3) = [0.0_wp, 0.0_wp, 1.0_wp], nothing(3) = 0.0_wp

contains

   !> Puts a completed suspension on the rig of a case.
   pure subroutine mount(base, given, suspension, this)
      type(suspension_t), intent(in) :: base
      type(case_t), intent(in) :: given               !! is_mountable
      type(suspension_t), intent(out) :: suspension   !! on the rig
      type(case_t), intent(out) :: this               !! with its actuations, range, unit and name of the swept value
      type(rig_t) :: rig

      if (are_checked) call require(is_mountable(given), 'mount: the table of the case was not read')
      rig = rig_of(base, given)
      call put_on(rig, base, suspension)
      this = given
      if (.not. allocated(this%test)) this%test = ''
      this%actuations = rig%actuations
      this%from = rig%from
      this%to = rig%to
      this%increments = rig%increments
      this%unit = swept_unit(rig%unit)
      this%unit_name = rig%unit
      this%place_name = rig%place_name
   end subroutine mount

   !> Puts a completed suspension on the rig of a case, with the work space of its solution.
   subroutine mount_case(base, given, mounted)
      type(suspension_t), intent(in) :: base
      type(case_t), intent(in) :: given                !! is_mountable
      type(mounted_case_t), intent(inout) :: mounted

      call mount(base, given, mounted%suspension, mounted%case)
      mounted%kkt = new_kkt(mounted%suspension)
   end subroutine mount_case

   !> A suspension and a rig as one flat model.
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

   !> A rig without rows and loads.
   pure type(rig_t) function new_rig() result(rig)
      allocate (rig%joints(0), rig%rows(0), rig%terms(0), rig%loads(0), rig%actuations(0))
      rig%unit = '-'
      rig%place_name = ''
   end function new_rig

   !> The rig of a case. A case without a test uses the drive or load that it names.
   pure type(rig_t) function rig_of(suspension, case) result(rig)
      type(suspension_t), intent(in) :: suspension    !! completed, on no rig
      type(case_t), intent(in) :: case                !! a table that was not read has no rows: the rig then moves nothing
      type(rig_test_t) :: test
      character(6) :: control
      integer :: wheels(2), side

      rig = new_rig()
      rig%from = case%from
      rig%to = case%to
      rig%increments = case%increments
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
         call append_actuation(rig%actuations, '', 'rig_roll', design_track(suspension), follows_tangent)
         if (control == 'road') rig%place_name = 'roll of the road, left up'
      case (steers)
         call append_actuation(rig%actuations, '', case%drive, 1.0_wp, follows_place)
         rig%place_name = 'travel of '//case%drive
         call take_unit_of(suspension, case%drive, rig)
      case (loads_wheels)
         call load_wheels(test, suspension, case, wheels, rig)
      case (takes_table)
         call take_rows(suspension, case, control, rig)
      end select
   end function rig_of

   !> The drive or the loads that a case without a test names.
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
      call take_unit_of(suspension, case%drive, rig)
   end subroutine follow_deck

   !> Heights that follow the swept value; with vertical = 'force', vertical forces instead.
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
            call add_load(rig, suspension, case, wheels(side), trim(side_name(side)), up, nothing, .true., shares(side), &
               follows_place)
         else
            call append_actuation(rig%actuations, '', trim(heights(side)), shares(side), follows_place)
         end if
      end do
   end subroutine move_heights

   !> A unit load on each wheel, scaled by the case.
   pure subroutine load_wheels(test, suspension, case, wheels, rig)
      type(rig_test_t), intent(in) :: test
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer, intent(in) :: wheels(2)
      type(rig_t), intent(inout) :: rig
      logical :: is_at_patch
      integer :: side

      is_at_patch = .not. test%is_at_centre .or. suspension%axle%drives_at_patch
      if (test%is_at_centre .and. is_at_patch) rig%place_name = 'traction force at each patch'
      do side = 1, 2
         if (wheels(side) > 0) call add_load(rig, suspension, case, wheels(side), trim(side_name(side)), test%force, &
            test%moment + merge(case%offset, 0.0_wp, test%has_trail)*up, is_at_patch, &
            merge(-1.0_wp, 1.0_wp, case%is_anti .and. side == 2), follows_place)
      end do
   end subroutine load_wheels

   !> The loads and drivers of the columns of a table; its rows become the path of the case.
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
               call add_load(rig, suspension, case, column%wheel, column%name, unit(1:3), unit(4:6), column%component <= 6, &
                  1.0_wp, follows_table, column%values)
            end if
         end associate
      end do
      rig%from = merge(0.0_wp, 1.0_wp, case%table%rows == 1)      ! from the design state, which is also reported
      rig%to = case%table%rows
      rig%increments = max(case%table%rows - 1, 1)
   end subroutine take_rows

   !> Adds a driver of Σ sign × height relative to the vehicle body, of wheel centres, patches, or of the road under the tyres.
   !> Its value is the change from design [m]. The tyres on the road deflect under the loads at the patches, so that
   !> Σ sign × height = value + λ Σ sign²/rate.
   pure subroutine add_height(rig, suspension, name, where, wheels, signs, control)
      type(rig_t), intent(inout) :: rig
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: name, where
      integer, intent(in) :: wheels(:)
      real(wp), intent(in) :: signs(:)         !! one per wheel
      character(*), intent(in) :: control      !! 'centre', 'patch' or 'road'
      type(joint_t) :: joint
      type(row_t) :: row
      type(term_t) :: term
      real(wp) :: arm(3)
      integer :: k

      row%first = size(suspension%terms) + size(rig%terms) + 1
      row%terms = size(wheels)
      row%joint = size(suspension%joints) + size(rig%joints) + 1
      row%is_driver = .true.
      if (control == 'road') row%compliance = sum(signs**2/suspension%wheels(wheels)%tyre_rate)
      do k = 1, size(wheels)
         associate (w => suspension%wheels(wheels(k)))
            arm = w%contact
            if (control == 'centre') arm = w%centre
            term%measure = measure_t(kind=global_gap, body_i=0, body_j=w%body, u=up, arm_i=suspension%bodies(w%body)%origin + arm, &
               arm_j=arm)
         end associate
         term%coefficient = signs(k)
         if (k == 1) joint%arm_j = arm
         rig%terms = [rig%terms, term]
      end do
      joint%name = name
      joint%where = where
      joint%kind = 'driver'
      joint%number = findloc(joint_kinds, 'driver', dim=1)
      joint%body_j = suspension%wheels(wheels(1))%body
      joint%first_row = size(suspension%rows) + size(rig%rows) + 1
      joint%rows = 1
      joint%is_of_measures = .true.
      rig%rows = [rig%rows, row]
      rig%joints = [rig%joints, joint]
   end subroutine add_height

   !> Adds a load 'rig_<name>' on a wheel, and the actuation that scales it.
   pure subroutine add_load(rig, suspension, case, wheel, name, force, moment, is_at_patch, share, law, values)
      type(rig_t), intent(inout) :: rig
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer, intent(in) :: wheel
      character(*), intent(in) :: name
      real(wp), intent(in) :: force(3), moment(3)
      logical, intent(in) :: is_at_patch       !! otherwise at the wheel centre
      real(wp), intent(in) :: share
      integer, intent(in) :: law
      real(wp), intent(in), optional :: values(:)
      type(load_t) :: load

      load%name = 'rig_'//name
      load%where = case%where
      load%body = suspension%wheels(wheel)%body
      load%arm = suspension%wheels(wheel)%centre
      if (is_at_patch) load%arm = suspension%wheels(wheel)%contact
      load%force = force
      load%moment = moment
      load%is_case = .true.
      rig%loads = [rig%loads, load]
      call append_actuation(rig%actuations, load%name, '', share, law, values)
   end subroutine add_load

   !> The unit of the value of a driver; mm for the rig's own.
   pure subroutine take_unit_of(suspension, drive, rig)
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: drive
      type(rig_t), intent(inout) :: rig
      integer :: row

      rig%unit = 'mm'
      row = driver_row(suspension, drive)
      if (row == 0) return
      select case (suspension%terms(suspension%rows(row)%first)%measure%kind)
      case (rotation)
         rig%unit = 'deg'
      case (axis_axis)
         rig%unit = '-'
      end select
   end subroutine take_unit_of

end module ek_rig
