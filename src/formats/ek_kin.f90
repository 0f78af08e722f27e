!> An axle of IPGKinematics, as ek_kin_reader reads it from its file (.kin).
!>
!> Numbers are in the units of the file: mm, N, deg, kg.
module ek_kin
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: kin_t, kin_curve_t, kin_bushing_t, points, bushings
   public :: wheel_centre, contact, subframe_front, subframe_rear, lower_ball, upper_ball, tie_rod_outer, lower_front, &
      lower_rear, upper_front, upper_rear, tie_rod_inner, bar_bearing, bar_end, link_end, spring_body, spring_wheel, &
      rocker_pivot, rocker_axis, rod_wheel, rod_rocker, coil_body, coil_rocker
   public :: off, on_lower, on_carrier, on_upper

   !> Numbers by which the file identifies the points
   integer, parameter :: wheel_centre = 1, contact = 2, subframe_front = 4, subframe_rear = 5, lower_ball = 6, upper_ball = 7, &
      tie_rod_outer = 8, lower_front = 9, lower_rear = 10, upper_front = 11, upper_rear = 12, bar_bearing = 13, bar_end = 14, &
      link_end = 15, tie_rod_inner = 16, spring_body = 18, spring_wheel = 19, rocker_pivot = 24, rocker_axis = 25, &
      rod_wheel = 26, rod_rocker = 27, coil_body = 28, coil_rocker = 29
   integer, parameter :: points = 36, bushings = 9      !! number of points and of bushings in the file

   !> The part on which the spring, the pushrod or the bar acts; `off`: the axle has none.
   integer, parameter :: off = 0, on_lower = 1, on_carrier = 2, on_upper = 3

   !> A law: a rate [N/mm, or N m/deg for the bar], or points (x, y) with a factor of y.
   type :: kin_curve_t
      logical :: has_points = .false.
      real(wp) :: rate = 0.0_wp, factor = 1.0_wp
      real(wp), allocatable :: x(:), y(:)
      integer :: line = 0
   end type kin_curve_t

   type :: kin_bushing_t
      character(:), allocatable :: file      !! path as written in the file of the axle
      real(wp) :: centre(3) = 0.0_wp, axis(3) = 0.0_wp, angle = 0.0_wp     !! axis: a point on the axis [mm]
      integer :: line = 0
   end type kin_bushing_t

   !> The content of a .kin file.
   type :: kin_t
      character(:), allocatable :: axle_type, remark, position, main_path
      logical :: has_forces = .false., has_subframe = .false., has_elastic_gearbox = .false., is_iso = .false., is_front = .false.
      real(wp) :: bump = 0.0_wp, rebound = 0.0_wp, rack_most = 0.0_wp, rack_least = 0.0_wp      !! wheel and rack travel [mm]
      real(wp) :: toe = 0.0_wp                !! toe [minutes of arc]
      real(wp) :: camber = 0.0_wp             !! camber [deg]
      real(wp) :: cg_height = 0.0_wp, wheelbase = 0.0_wp, brake_share = 0.0_wp, drive_share = 0.0_wp, tyre_rate = 0.0_wp
      integer :: spring = off, rod = off, bar = off, third = off
      type(kin_curve_t) :: coil, bar_law, rod_law
      logical :: has_upper_on_subframe = .false.
      real(wp) :: load = 0.0_wp, body = 0.0_wp, subframe = 0.0_wp, lower_arm = 0.0_wp, carrier = 0.0_wp, wheel = 0.0_wp, &
         upper_arm = 0.0_wp, tie_rod = 0.0_wp, rack = 0.0_wp, housing = 0.0_wp, bar_mass = 0.0_wp, bar_link = 0.0_wp, &
         rocker = 0.0_wp                      !! masses [kg]
      real(wp) :: at(3, points) = 0.0_wp      !! coordinates of the points [mm]
      type(kin_bushing_t) :: mounts(bushings)
   end type kin_t

end module ek_kin
