!> The tests of the rig, one row each: the loads and heights of the wheels, and how the results are shown.
!>
!> | test                | swept value     | left, right wheel                      | wheels held by   |
!> |---------------------|-----------------|----------------------------------------|------------------|
!> | parallel_travel     | travel          | both up                                | height, driven   |
!> | opposite_travel     | travel          | left up, right down                    | height, driven   |
!> | single_travel       | travel          | one up, the other at rest              | height, driven   |
!> | roll                | axle roll       | height(left) − height(right) = t tan φ | difference only: |
!> |                     |                 |                                        | constant load    |
!> | steering            | rack travel     | constant heights                       | height           |
!> | lateral_force       | force           | +y at the contact point, with trail    | vertical force   |
!> | braking             | force           | rearward at the contact point          | vertical force   |
!> | traction            | force           | forward at the wheel centre            | vertical force   |
!> | aligning_torque     | moment          | about z, counterclockwise from above   | vertical force   |
!> | vertical_force      | force           | upward at the contact point            | vertical force   |
!> | manoeuvres          | manoeuvre       | forces of the road, inertia of masses  | vertical force   |
!> | table               | row of the file | loads and heights in the columns       | vertical force   |
!> | travel_and_steering | state of a grid | both up; the rack moves, too           | height, driven   |
!>
!> In row `roll`, t is the track of the design and φ the roll angle. A new test needs a row here. If the test has charts or
!> gradients of its own, it also needs a list in `charted` and gradients in ek_quantity, and rows in ek_chart_choice. The
!> deck reader, the rig, the standard tests, the usual ranges, the abscissa and the windows follow from the row.
module ek_rig_test
   use ek_kinds, only: wp, degree, millimetre
   implicit none(type, external)
   private
   public :: rig_test_t, rig_tests, rig_test, needs_both, of_one_wheel, lifts, is_scattered, swept_unit
   public :: moves_heights, rolls, steers, loads_wheels, takes_table, covers_grid, drives_car
   public :: of_none, of_travel, of_tilt, of_roll, of_steer, of_lateral, of_braking, of_traction, of_aligning, of_vertical, &
      of_table, of_grid

   ! what a test does
   integer, parameter :: moves_heights = 1, rolls = 2, steers = 3, loads_wheels = 4, takes_table = 5, covers_grid = 6, &
      drives_car = 7

   ! its charts and its gradients
   integer, parameter :: of_none = 0, of_travel = 1, of_tilt = 2, of_roll = 3, of_steer = 4, of_lateral = 5, of_braking = 6, &
      of_traction = 7, of_aligning = 8, of_vertical = 9, of_table = 10, of_grid = 11

   type :: rig_test_t
      character(19) :: name = ''
      integer :: action = 0                  !! one of the constants above; 0: no test of the rig
      integer :: charts = of_none            !! set of charts and gradients, one of the of_… above
      character(6) :: control = ''           !! how the wheels are held if the case does not give `vertical`
      character(3) :: unit = '-'             !! unit of the swept value: mm, deg, N, N m, '-': none, '': unit of the steered joint
      character(48) :: place_name = ''       !! name of the swept value
      character(18) :: abscissa = 'wheel_travel_mm'    !! column over which the charts are drawn and the gradients fitted
      character(56) :: label = 'wheel travel [mm]    (+ bump)'   !! label of the abscissa
      real(wp) :: shares(2) = 0.0_wp         !! moves_heights: height per swept value, left and right
      real(wp) :: force(3) = 0.0_wp          !! loads_wheels: force and moment per swept value, at the left contact point
      real(wp) :: moment(3) = 0.0_wp
      logical :: is_at_centre = .false.      !! the force acts at the wheel centre, except in a solid axle that carries the torque
      logical :: has_phase = .false.         !! the load on the right wheel may be reversed
      logical :: has_trail = .false.         !! the force may act aft of the contact point, at `offset`
      integer :: place = 0                   !! position among the standard tests; 0: not a standard test
      logical :: is_on_request = .false.     !! .true.: as a standard test, the test runs only if it is requested by name
      integer :: phases = 1                  !! 2: the standard tests contain the test in phase and anti-phase; 1: in phase only
      real(wp) :: reach = 0.0_wp             !! range of the standard test: −reach to reach, in `unit`; in a grid in mm
      integer :: increments = 40             !! increments of the standard test
      character(9) :: prefix = ''            !! prefix of the names of the gradients of the test
   end type rig_test_t

   real(wp), parameter :: up(3) = [0.0_wp, 0.0_wp, 1.0_wp], right(3) = [0.0_wp, 1.0_wp, 0.0_wp], rear(3) = [1.0_wp, 0.0_wp, 0.0_wp]

   type(rig_test_t), parameter :: rig_tests(*) = [ &
      rig_test_t('parallel_travel', moves_heights, of_travel, 'centre', 'mm', 'wheel travel', shares=[1.0_wp, 1.0_wp], &
         place=1, reach=80.0_wp, increments=80), &
      rig_test_t('opposite_travel', moves_heights, of_tilt, 'centre', 'mm', 'travel of the left wheel, right wheel opposite', &
         shares=[1.0_wp, -1.0_wp], place=2, reach=60.0_wp, increments=60, prefix='opposite '), &
      rig_test_t('single_travel', moves_heights, of_tilt, 'centre', 'mm', shares=[1.0_wp, 0.0_wp], prefix='single '), &
      rig_test_t('roll', rolls, of_roll, 'patch', 'deg', 'axle roll, left wheel up', 'axle_roll_deg', &
         'axle roll [deg]    (+ left wheel up)', place=3, reach=3.0_wp, increments=60), &
      rig_test_t('steering', steers, of_steer, 'centre', '', '', 'steering_wheel_deg', 'steering wheel [deg]    (+ left)', &
         place=4, increments=60), &
      rig_test_t('lateral_force', loads_wheels, of_lateral, 'force', 'N', 'lateral force at each contact point', 'factor', &
         'lateral force [N]    (+ to the right)', force=right, has_phase=.true., has_trail=.true., place=5, phases=2, &
         reach=2000.0_wp), &
      rig_test_t('braking', loads_wheels, of_braking, 'force', 'N', 'braking force at each contact point', 'factor', &
         'braking force per wheel [N]    (+ rearward)', force=rear, has_phase=.true., place=7, reach=2000.0_wp), &
      rig_test_t('traction', loads_wheels, of_traction, 'force', 'N', 'driving force at each wheel centre', 'factor', &
         'driving force per wheel [N]    (+ forward)', force=-rear, is_at_centre=.true., has_phase=.true., place=8, &
         reach=2000.0_wp), &
      rig_test_t('aligning_torque', loads_wheels, of_aligning, 'force', 'N m', 'aligning torque on each wheel', 'factor', &
         'aligning torque [N m]    (+ to the left)', moment=up, has_phase=.true., place=6, phases=2, reach=100.0_wp), &
      rig_test_t('vertical_force', loads_wheels, of_vertical, 'force', 'N', 'change of vertical force at each contact point', &
         'factor', 'vertical force [N]    (+ up)', force=up), &
      rig_test_t('table', takes_table, of_table, 'force', '-', '', 'factor', 'row of the table'), &
      rig_test_t('manoeuvres', drives_car, of_table, 'force', '-', 'manoeuvre', 'factor', 'manoeuvre'), &
      rig_test_t('travel_and_steering', covers_grid, of_grid, 'centre', '-', 'state of the grid', 'factor', 'state of the grid', &
         place=9, is_on_request=.true., reach=80.0_wp, increments=16)]

contains

   !> The table row of a test. Any other name gives a row without loads and heights, and with wheel travel as abscissa.
   pure type(rig_test_t) function rig_test(name) result(test)
      character(*), intent(in) :: name
      integer :: k

      do k = 1, size(rig_tests)
         if (rig_tests(k)%name == name) test = rig_tests(k)
      end do
   end function rig_test

   !> Whether a test needs a left and a right wheel.
   pure logical function needs_both(test)
      type(rig_test_t), intent(in) :: test
      needs_both = test%action == rolls .or. minval(test%shares) < 0.0_wp
   end function needs_both

   !> Whether a test moves only one wheel, which the case names.
   pure logical function of_one_wheel(test)
      type(rig_test_t), intent(in) :: test
      of_one_wheel = test%action == moves_heights .and. any(.not. abs(test%shares) > 0.0_wp)
   end function of_one_wheel

   !> Whether a test moves or loads the wheels vertically, on average over both wheels: .false. for opposite travel and roll.
   pure logical function lifts(test)
      type(rig_test_t), intent(in) :: test
      lifts = sum(test%shares) > 0.0_wp .or. test%force(3) > 0.0_wp
   end function lifts

   !> Whether the states of a test do not form a path, so that they are drawn as points.
   pure logical function is_scattered(name)
      character(*), intent(in) :: name
      type(rig_test_t) :: test

      test = rig_test(name)
      is_scattered = any(test%action == [takes_table, covers_grid, drives_car])
   end function is_scattered

   !> The SI value of the unit of a swept value: of mm and of deg; 1 for any other unit.
   pure real(wp) function swept_unit(unit)
      character(*), intent(in) :: unit

      swept_unit = 1.0_wp
      if (unit == 'mm') swept_unit = millimetre
      if (unit == 'deg') swept_unit = degree
   end function swept_unit

end module ek_rig_test
