!> OptimumKinematics, Lotus, Rill, open-kinematics and a racing game: sources with one or two rigid mechanisms each.
module ek_published_small
   use ek_kinds, only: wp, degree
   use ek_table, only: table_t, row_count
   use ek_text, only: str
   use ek_comparison, only: comparisons_t, add, solve, read_numbers, pick
   implicit none(type, external)
   private
   public :: compare_optimum, compare_lotus, compare_rill, compare_boxster, compare_open_kinematics

contains

   !> OptimumKinematics, case study of a Formula Student car (OptimumG, May 2015): both axles at design, as printed.
   !>
   !> Tolerance: half a unit of the last printed digit. The front view swing arm of the front axle is 921.38 mm here and printed as 921.3: it has
   !> one unit. All numbers are those of --definitions optimumk.
   subroutine compare_optimum(list)
      type(comparisons_t), intent(inout) :: list
      character(*), parameter :: axles(2) = [character(5) :: 'front', 'rear'], &
         names(5) = [character(24) :: 'kingpin inclination', 'caster', 'scrub radius', 'caster trail', 'roll centre height'], &
         units(5) = [character(3) :: 'deg', 'deg', 'mm', 'mm', 'mm'], &
         columns(5) = [character(40) :: 'left King Pin Angle [deg]', 'left Caster Angle [deg]', 'left Scrub Radius [mm]', &
         'left Mechanical Trail [mm]', 'Kinematic Roll Center Height [mm]']
      real(wp), parameter :: printed(5, 2) = reshape([4.0_wp, 6.0_wp, 38.2_wp, 24.7_wp, 28.3_wp, &
         0.0_wp, 11.6_wp, 61.0_wp, 63.0_wp, 37.2_wp], [5, 2]), arm(2) = [921.3_wp, 972.5_wp], half = 0.05_wp + 1.0e-9_wp
      integer, parameter :: design = 2
      type(table_t) :: own, table
      integer :: a, k

      do a = 1, 2
         list%part = trim(axles(a))//' axle'
         call solve(list, 'optimum_'//trim(axles(a)), 'design', [character(1) :: ''], own, 'optimumk', table)
         do k = 1, 5
            call add(list, trim(names(k)), 'design', trim(units(k)), pick(table, trim(columns(k)), design), printed(k, a), half)
         end do
         call add(list, 'front view swing arm', 'design', 'mm', &
            pick(table, 'left Front View Swing Arm Length [mm]', design), arm(a), merge(0.1_wp, half, a == 1))
      end do
   end subroutine compare_optimum

   !> Lotus Suspension Analysis: static values of two double wishbones, as printed in listings with their hardpoints (4x4V23.shk, v4.03;
   !> bat.shk, v5.01), by --definitions lotus.
   !>
   !> Tolerance: half a unit of the last printed digit, and half a unit of the last digit of the hardpoints times the lever: 0.01 mm, 0.01 deg.
   !> Roll centre 0.1 mm: it differs by up to 0.06 mm, for a reason that the listing does not show.
   subroutine compare_lotus(list)
      type(comparisons_t), intent(inout) :: list
      character(*), parameter :: axles(2) = [character(3) :: '4x4', 'bat'], names(8) = [character(24) :: 'Castor Angle', &
         'Castor Trail (hub)', 'Castor Offset (grnd)', 'Kingpin Angle', 'Kingpin Offset (w/c)', 'Kingpin Offset (grnd)', &
         'Mechanical Trail (grnd)', 'Roll Centre Height'], &
         units(8) = [character(3) :: 'deg', 'mm', 'mm', 'deg', 'mm', 'mm', 'mm', 'mm']
      real(wp), parameter :: printed(8, 2) = reshape([16.22_wp, 5.00_wp, 76.31_wp, 9.75_wp, 98.13_wp, 50.13_wp, 73.27_wp, &
         293.64_wp, 15.71_wp, 1.16_wp, 62.11_wp, 17.53_wp, 92.47_wp, 21.39_wp, 59.79_wp, 196.89_wp], [8, 2])
      integer, parameter :: design = 2
      character(:), allocatable :: head
      type(table_t) :: own, table
      integer :: a, k

      do a = 1, 2
         list%part = axles(a)
         call solve(list, 'lotus_'//axles(a), 'design', [character(1) :: ''], own, 'lotus', table)
         do k = 1, 8
            head = trim(names(k))//' ['//trim(units(k))//']'
            if (k < 8) head = 'left '//head
            call add(list, trim(names(k)), 'design', trim(units(k)), pick(table, head, design), printed(k, a), &
               merge(0.1_wp, 0.01_wp, k == 8))
         end do
      end do
   end subroutine compare_lotus

   !> G. Rill, Road Vehicle Dynamics (2012), listing 5.6: what its program prints at design, and six states by the same
   !> construction, computed outside this program.
   !>
   !> Tolerance of the states: published lengths have 12 digits after the point in m, 1e-9 mm; angles 10 digits. The closed mechanism is
   !> found to 1e-10 mm. Of printed numbers: half a unit of the last digit.
   subroutine compare_rill(list)
      type(comparisons_t), intent(inout) :: list
      type(table_t) :: table, curve

      list%part = 'rigid double wishbone'
      call solve(list, 'rill', 'travel', [character(1) :: ''], table)
      call add(list, 'kingpin inclination', 'design', 'deg', pick(table, 'kingpin_inclination_deg', 3), 10.5182_wp, 5.0e-5_wp)
      call add(list, 'caster', 'design', 'deg', pick(table, 'caster_deg', 3), 7.0561_wp, 5.0e-5_wp)
      call add(list, 'caster offset', 'design', 'mm', pick(table, 'caster_trail_mm', 3), 30.326_wp, 5.0e-4_wp)
      call add(list, 'scrub radius', 'design', 'mm', pick(table, 'scrub_radius_mm', 3), 1.0327_wp, 5.0e-5_wp)
      call read_numbers(list, 'rill', curve)
      call solve(list, 'rill', 'states', [character(1) :: ''], table)
      call compare_curve(list, table, curve, 2.0e-9_wp)
   end subroutine compare_rill

   !> A McPherson axle as entered in a racing game; the curve was computed outside this program by closed forms. Tolerance as in compare_rill; the strut length is measured along
   !> a strut of 0.6 m to the same digits.
   subroutine compare_boxster(list)
      type(comparisons_t), intent(inout) :: list
      type(table_t) :: table, curve
      integer :: k

      list%part = 'McPherson'
      call read_numbers(list, 'boxster', curve)
      call solve(list, 'boxster', 'states', [character(1) :: ''], table)
      call compare_curve(list, table, curve, 2.0e-9_wp)
      do k = 1, row_count(curve)
         call add(list, 'strut length', state(curve, k), 'mm', pick(table, 'strut_length_mm', k), &
            1000*pick(curve, 'strut_length', k), 2.0e-9_wp)
      end do
   end subroutine compare_boxster

   !> Wheel centre x, camber and toe-in over the height of the wheel centre and the rack.
   subroutine compare_curve(list, table, curve, tolerance)
      type(comparisons_t), intent(inout) :: list
      type(table_t), intent(in) :: table, curve      !! of this program; published, in m and deg
      real(wp), intent(in) :: tolerance              !! mm, deg
      integer :: k

      do k = 1, row_count(curve)
         call add(list, 'wheel centre x', state(curve, k), 'mm', pick(table, 'wheel_centre_x_mm', k), &
            1000*pick(curve, 'x', k), tolerance)
         call add(list, 'camber', state(curve, k), 'deg', pick(table, 'camber_deg', k), pick(curve, 'camber', k), tolerance)
         call add(list, 'toe', state(curve, k), 'deg', pick(table, 'toe_deg', k), pick(curve, 'toe', k), tolerance)
      end do
   end subroutine compare_curve

   !> A state of a published curve in words.
   function state(curve, k) result(text)
      type(table_t), intent(in) :: curve
      integer, intent(in) :: k
      character(:), allocatable :: text
      character(32) :: words

      write (words, '(a, f0.2, a, i0, a)') 'travel ', 1000*pick(curve, 'z', k), ', rack ', nint(1000*pick(curve, 'rack', k)), ' mm'
      text = trim(words)
   end function state

   !> nickmccleery/open-kinematics (3cfc66af): nine states in which rack and wheel move together.
   !>
   !> Its camber is that of the spin axis in the y-z plane, its contact point the lowest point of the wheel disc, its scrub radius is measured
   !> along the spin axis and positive with the steering axis inboard; these follow here from toe, camber, wheel centre and steering axis. Tolerance 2e-5 mm and deg: its own solver leaves residuals of up to 3.4e-6 mm, and the points are up to
   !> some 4 lever arms apart (the toe follows 0.4 deg/mm). Slopes: differences over ±0.05 mm; 5e-7 is the residual's part and the third derivative.
   subroutine compare_open_kinematics(list)
      type(comparisons_t), intent(inout) :: list
      real(wp), parameter :: same = 2.0e-5_wp, same_slope = 5.0e-7_wp, h = 0.05_wp, radius = 313.6_wp
      integer, parameter :: rack = 1, up = 3               !! rows behind a state: of the rack, of the height
      type(table_t) :: table, theirs
      character(:), allocatable :: place
      real(wp) :: camber, toe, s(3), down(3), patch(3), ground(2)
      integer :: k, row

      list%part = 'rigid double wishbone'
      call read_numbers(list, 'open_kinematics', theirs)
      call solve(list, 'open_kinematics', 'states', [character(1) :: ''], table)
      if (allocated(list%trouble)) return
      do k = 1, row_count(theirs)
         row = 5*k - 4
         place = 'rack '//str(nint(pick(theirs, 'rack_y', k)))//', height '//str(nint(pick(theirs, 'wz', k)))//' mm'
         toe = degree*pick(table, 'toe_deg', row)
         camber = degree*pick(table, 'camber_deg', row)
         s = [sin(toe)*cos(camber), cos(toe)*cos(camber), -sin(camber)]
         down = (s(3)*s - [0.0_wp, 0.0_wp, 1.0_wp])/cos(camber)
         patch = [pick(table, 'wheel_centre_x_mm', row) - 20, pick(table, 'wheel_centre_y_mm', row) + 950, &
            pick(table, 'wheel_centre_z_mm', row) + 313.426_wp]
         call add(list, 'wheel centre x', place, 'mm', patch(1), pick(theirs, 'wx', k), same)
         call add(list, 'wheel centre y', place, 'mm', patch(2), pick(theirs, 'wy', k), same)
         ! the steering axis at the height of the centre, then on the ground
         ground = patch(:2) + [pick(table, 'spindle_offset_mm', row), -pick(table, 'spindle_length_mm', row)] + &
            radius*abs(down(3))* &
            [tan(degree*pick(table, 'caster_deg', row)), tan(degree*pick(table, 'kingpin_inclination_deg', row))]
         patch = patch + radius*down
         call add(list, 'toe', place, 'deg', toe/degree, pick(theirs, 'toe', k), same)
         call add(list, 'camber', place, 'deg', projected(row), pick(theirs, 'camber', k), same)
         call add(list, 'caster', place, 'deg', pick(table, 'caster_deg', row), pick(theirs, 'caster', k), same)
         call add(list, 'kingpin inclination', place, 'deg', pick(table, 'kingpin_inclination_deg', row), &
            pick(theirs, 'kpi', k), same)
         call add(list, 'contact point x', place, 'mm', patch(1), pick(theirs, 'patch_x', k), same)
         call add(list, 'contact point y', place, 'mm', patch(2), pick(theirs, 'patch_y', k), same)
         call add(list, 'contact point z', place, 'mm', patch(3), pick(theirs, 'patch_z', k), same)
         call add(list, 'caster trail', place, 'mm', ground(1) - patch(1), pick(theirs, 'trail', k), same)
         call add(list, 'scrub radius', place, 'mm', -dot_product(ground - patch(:2), [sin(toe), cos(toe)]), &
            pick(theirs, 'scrub', k), same)
         call add(list, 'camber per travel', place, 'deg/mm', (projected(row + up) - projected(row + up + 1))/(2*h), &
            pick(theirs, 'd_camber_dz', k), same_slope)
         call add(list, 'camber per rack', place, 'deg/mm', (projected(row + rack) - projected(row + rack + 1))/(2*h), &
            pick(theirs, 'd_camber_drack', k), same_slope)
         call add(list, 'toe per travel', place, 'deg/mm', slope('toe_deg', up), pick(theirs, 'd_toe_dz', k), same_slope)
         call add(list, 'toe per rack', place, 'deg/mm', slope('toe_deg', rack), pick(theirs, 'd_toe_drack', k), same_slope)
         call add(list, 'caster per travel', place, 'deg/mm', slope('caster_deg', up), pick(theirs, 'd_caster_dz', k), same_slope)
         call add(list, 'kingpin inclination per travel', place, 'deg/mm', slope('kingpin_inclination_deg', up), &
            pick(theirs, 'd_kpi_dz', k), same_slope)
         call add(list, 'wheel centre x per travel', place, 'mm/mm', slope('wheel_centre_x_mm', up), pick(theirs, 'd_wx_dz', k), &
            same_slope)
      end do

   contains

      !> Camber in the y-z plane [deg].
      real(wp) function projected(row)
         integer, intent(in) :: row
         projected = atan(tan(degree*pick(table, 'camber_deg', row))/cos(degree*pick(table, 'toe_deg', row)))/degree
      end function projected

      !> Difference quotient of a column over the rows of a state.
      real(wp) function slope(name, first)
         character(*), intent(in) :: name
         integer, intent(in) :: first
         slope = (pick(table, name, row + first) - pick(table, name, row + first + 1))/(2*h)
      end function slope

   end subroutine compare_open_kinematics

end module ek_published_small
