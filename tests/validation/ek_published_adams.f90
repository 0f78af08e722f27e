!> Adams/Car 2024.1: the front double wishbone of its shared database, published in the repository 1191415541/open-kinematics (b940230e).
!>
!> Camber and toe are those of --definitions adams. The repository lists positions with x forward and y to the right, and toe with the
!> sign opposite to that of Adams/Car, which is positive for toe-in. Its numbers contain the error of its assembly at design (up to 9e-8 mm,
!> 2.6e-8 deg), which is subtracted at each state: at design nothing is left to compare.
module ek_published_adams
   use ek_kinds, only: wp, degree, pi
   use ek_table, only: table_t, row_count
   use ek_text, only: str
   use ek_comparison, only: comparisons_t, add, solve, read_numbers, pick
   implicit none(type, external)
   private
   public :: compare_adams

   integer, parameter :: design = 5                             !! row of the published states
   real(wp), parameter :: centre(3) = [-267.0_wp, 760.0_wp, 330.0_wp]

contains

   !> Appends all comparable numbers.
   subroutine compare_adams(list)
      type(comparisons_t), intent(inout) :: list
      call compare_states(list)
      call compare_forces(list)
   end subroutine compare_adams

   !> Camber, toe and wheel centre of both wheels at eight states. Tolerance 5e-9 mm and deg: the largest difference, 2.1e-9, is the
   !> tolerance of the published solver, and changes with the last bits of a platform by less than 1e-10.
   subroutine compare_states(list)
      type(comparisons_t), intent(inout) :: list
      character(*), parameter :: sides(2) = [character(5) :: 'left', 'right']
      real(wp), parameter :: tolerance = 5.0e-9_wp
      type(table_t) :: ours, defined, theirs
      character(:), allocatable :: side, place
      real(wp) :: sign
      integer :: k, s

      list%part = 'rigid double wishbone'
      call read_numbers(list, 'adams_states', theirs)
      call solve(list, 'adams_double_wishbone', 'states', [character(1) :: ''], ours, 'adams', defined)
      do k = 1, row_count(theirs)
         if (k == design) cycle
         place = 'travel '//str(nint(pick(theirs, 'travel', k)))//', rack '//str(nint(pick(theirs, 'rack', k)))//' mm'
         do s = 1, 2
            side = trim(sides(s))
            sign = merge(1.0_wp, -1.0_wp, s == 1)                ! of the left wheel's y in an ISO deck
            call add(list, side//' camber', place, 'deg', pick(defined, side//' Camber Angle [deg]', k), &
               moved(side//'_camber', 0.0_wp), tolerance)
            call add(list, side//' toe', place, 'deg', -pick(defined, side//' Toe Angle [deg]', k), &
               moved(side//'_toe', 0.0_wp), tolerance)
            call add(list, side//' wheel centre x', place, 'mm', centre(1) + pick(ours, side//'_wheel_centre_x_mm', k), &
               moved(side//'_x', centre(1)), tolerance)
            call add(list, side//' wheel centre y', place, 'mm', -sign*centre(2) - pick(ours, side//'_wheel_centre_y_mm', k), &
               moved(side//'_y', -sign*centre(2)), tolerance)
         end do
      end do

   contains

      !> A published number without the error at design.
      real(wp) function moved(name, nominal)
         character(*), intent(in) :: name
         real(wp), intent(in) :: nominal         !! the number at design
         moved = pick(theirs, name, k) - pick(theirs, name, design) + nominal
      end function moved

   end subroutine compare_states

   !> Rotation about y per vertical force at the wheel centre (of Adams at -100 N, of an independent Newton solver also at smaller forces), and
   !> displacement along x at -100 N for all rates times a factor.
   !>
   !> Tolerance of rotations 1e-7 of the value: Adams prints 11 digits, and its own error is 4e-8. Added are 1e-15 rad: the last bit of a coordinate of
   !> 760 mm is 1.1e-13 mm, over the 330 mm from the patch to the centre. Displacements have 6 digits: 1e-6 of the value.
   subroutine compare_forces(list)
      type(comparisons_t), intent(inout) :: list
      real(wp), parameter :: adams = 2.4852834326e-5_wp, newton(4) = &
         [2.485283528572e-5_wp, 2.488023192163e-7_wp, 2.488050851658e-9_wp, 2.488050867638e-11_wp], &
         factors(3) = [0.1_wp, 1.0_wp, 10.0_wp], dx(3) = [-0.0107228_wp, -0.000979058_wp, -9.69719e-5_wp]
      character(*), parameter :: forces(4) = [character(9) :: '-100 N', '-1 N', '-0.01 N', '-0.0001 N']
      character(*), parameter :: bushings(4) = [character(9) :: 'lca_front', 'lca_rear', 'uca_front', 'uca_rear']
      character(80) :: settings(8)
      character(6) :: factor
      type(table_t) :: table
      integer :: k, b

      list%part = 'with bushings'
      call solve(list, 'adams_bushings', 'forces', [character(1) :: ''], table)
      call add(list, 'rotation about y (Adams/Car)', 'Fz = -100 N', 'rad', rotation(table, 1), adams, 1.0e-7_wp*adams)
      do k = 1, 4
         call add(list, 'rotation about y (Newton)', 'Fz = '//trim(forces(k)), 'rad', rotation(table, k), newton(k), &
            1.0e-7_wp*newton(k) + 1.0e-15_wp)
      end do
      do k = 1, 3
         do b = 1, 4
            write (settings(b), '(3a, es21.15)') 'bushing.', trim(bushings(b)), '_bush.kt=3*', 1.0e4_wp*factors(k)
            write (settings(b + 4), '(3a, es21.15)') 'bushing.', trim(bushings(b)), '_bush.kr=3*', 1.0e7_wp*factors(k)*degree
         end do
         call solve(list, 'adams_bushings', 'forces', settings, table)
         write (factor, '(f4.1)') factors(k)
         call add(list, 'wheel centre x (Newton)', 'rates times '//adjustl(factor), 'mm', &
            pick(table, 'wheel_centre_x_mm', 1), dx(k), 1.0e-6_wp*abs(dx(k)))
      end do
   end subroutine compare_forces

   !> Component along y of the rotation vector of the carrier [rad]: the spin axis from toe and camber, the line from the centre to the patch
   !> from their positions. For small rotations θ it is half the difference of two direction cosines; the next term is of order θ³ (1e-4³).
   real(wp) function rotation(table, row) result(theta)
      type(table_t), intent(in) :: table
      integer, intent(in) :: row
      real(wp) :: toe, camber, y(3), z(3), x_in_z

      toe = degree*pick(table, 'toe_deg', row)
      camber = degree*pick(table, 'camber_deg', row)
      if (max(abs(toe), abs(camber)) > pi) toe = 0.0_wp                  ! the number is missing
      y = [sin(toe)*cos(camber), cos(toe)*cos(camber), -sin(camber)]     ! x forward, y left: toe-in turns the axis forward
      z(1) = pick(table, 'wheel_centre_x_mm', row) - pick(table, 'contact_patch_x_mm', row)
      z(2) = pick(table, 'wheel_centre_y_mm', row) - pick(table, 'contact_patch_y_mm', row)
      z(3) = centre(3)
      z = z/centre(3)
      x_in_z = y(1)*z(2) - y(2)*z(1)                                     ! third component of y × z, the direction of x
      theta = 0.5_wp*(z(1) - x_in_z)
   end function rotation

end module ek_published_adams
