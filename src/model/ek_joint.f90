!> Joints as lists of measures held at a value: Φ(q) = 0 (Kang 2005, eq. 1).
!>
!> | joint             | rows                                                     | removes |
!> |-------------------|----------------------------------------------------------|---------|
!> | spherical         | 3 global gaps                                            | 3       |
!> | universal         | spherical + axis·axis2                                   | 4       |
!> | constant_velocity | spherical + twist u1·v2 − u2·v1                          | 4       |
!> | revolute          | spherical + 2 axis·axis                                  | 5       |
!> | cylindrical       | 2 axis·axis + 2 gaps across the axis                     | 4       |
!> | translational     | cylindrical + 1 axis·axis                                | 5       |
!> | fixed             | spherical + 3 axis·axis                                  | 6       |
!> | distance          | distance                                                 | 1       |
!> | in_plane          | 1 gap along a direction of the first body                | 1       |
!> | in_line           | 2 gaps across a direction of the first body              | 2       |
!> | perpendicular     | axis·axis2                                               | 1       |
!> | parallel          | 2 axis·axis                                              | 2       |
!> | driver            | a measure = its design value + prescribed change (+ λ/stiffness) | 1 |
!> | coupler           | Σ ratio × measure = its design value                     | 1       |
!>
!> To add a joint: add its rows to `joint_terms`, its name to `joint_kinds`, its row to the table above,
!> and a test. The solver and the output do not depend on the names.
module ek_joint
   use ek_kinds, only: wp
   use ek_measure, only: measure_t, axis_axis, body_gap, global_gap, distance
   use ek_rotation, only: cross, perpendicular, identity3, angle_between
   implicit none(type, external)
   private
   public :: joint_t, row_t, term_t, joint_geometry_t, joint_terms, joint_kinds
   public :: needs_axis, needs_second_axis, max_terms, axes_fit

   integer, parameter :: max_terms = 6   !! largest number of terms of a joint (fixed)

   character(*), parameter :: joint_kinds(14) = [character(17) :: &
      'spherical', 'universal', 'constant_velocity', 'revolute', 'cylindrical', 'translational', &
      'fixed', 'distance', 'in_plane', 'in_line', 'perpendicular', 'parallel', 'driver', 'coupler']

   !> A named joint: its definition in the deck, and its rows of Φ.
   type :: joint_t
      character(:), allocatable :: name
      character(:), allocatable :: kind      !! one of joint_kinds
      character(:), allocatable :: where     !! 'file:line' for messages
      integer :: body_i = 0, body_j = 0
      real(wp) :: arm_j(3) = 0.0_wp          !! point where its force acts on body j, body axes [m]
      integer :: first_row = 0, rows = 0
      integer :: chosen_axis = 0             !! universal: 1 or 2 if the program chose this axis; 0: both given
      real(wp) :: axis(3, 2) = 0.0_wp        !! universal: axis and axis_2, unit vectors, global at design
      logical :: is_of_measures = .false.    !! driver, coupler: its reaction is one number, not a force at a point
      logical :: says_balance = .false.      !! driver with a stiffness: the deck gives `balance`
      logical :: is_balanced = .true.        !! the value of `balance`
   end type joint_t

   !> coefficient × measure
   type :: term_t
      type(measure_t) :: measure
      real(wp) :: coefficient = 1.0_wp
   end type term_t

   !> One equation Σ terms = target.
   type :: row_t
      integer :: first = 0, terms = 1      !! its terms are first … first+terms−1 of the suspension
      real(wp) :: target = 0.0_wp          !! value at design [m, - or rad]
      integer :: joint = 0                 !! number of the joint
      logical :: is_driver = .false.
      real(wp) :: compliance = 0.0_wp      !! driver with a stiffness: Σ terms = target + compliance × λ [m/N, rad/(N m)]
   end type row_t

   !> The geometry that defines a joint: design position, global axes, SI.
   type :: joint_geometry_t
      integer :: body_i = 0, body_j = 0
      real(wp) :: point_i(3) = 0.0_wp, point_j(3) = 0.0_wp   !! equal unless two points are given
      real(wp) :: axis_i(3) = [0.0_wp, 0.0_wp, 1.0_wp]       !! unit, fixed in body i
      real(wp) :: axis_j(3) = [0.0_wp, 0.0_wp, 1.0_wp]       !! unit, fixed in body j
   end type joint_geometry_t

contains

   !> Whether a kind is defined by a direction.
   pure logical function needs_axis(kind)
      character(*), intent(in) :: kind
      select case (kind)
      case ('spherical', 'fixed', 'distance', 'driver', 'coupler')
         needs_axis = .false.
      case default
         needs_axis = .true.
      end select
   end function needs_axis

   !> Whether a kind needs a direction on each body.
   pure logical function needs_second_axis(kind)
      character(*), intent(in) :: kind
      needs_second_axis = kind == 'universal' .or. kind == 'constant_velocity' .or. kind == 'perpendicular'
   end function needs_second_axis

   !> Whether two axes suit a joint: at a right angle, parallel, or not opposed.
   pure logical function axes_fit(kind, axis_i, axis_j)
      character(*), intent(in) :: kind
      real(wp), intent(in) :: axis_i(3), axis_j(3)      !! unit
      real(wp), parameter :: tolerance = 0.01_wp, widest = 179.0_wp      ! deg
      real(wp) :: angle

      axes_fit = .true.
      select case (kind)
      case ('universal', 'perpendicular')
         axes_fit = abs(angle_between(axis_i, axis_j) - 90.0_wp) <= tolerance
      case ('parallel')
         angle = angle_between(axis_i, axis_j)
         axes_fit = min(angle, 180.0_wp - angle) <= tolerance
      case ('constant_velocity')
         axes_fit = angle_between(axis_i, axis_j) <= widest
      end select
   end function axes_fit

   !> The terms of a joint in row order, and the number of terms of each row.
   !>
   !> Arms are design points (global); `complete` subtracts the reference points of the bodies.
   !> Drivers and couplers are built from named measures by the builder.
   !> Equation (M.19) of docs/theory/measures.md.
   subroutine joint_terms(kind, geometry, terms, terms_of_row, rows)
      character(*), intent(in) :: kind
      type(joint_geometry_t), intent(in) :: geometry
      type(term_t), intent(out) :: terms(max_terms)
      integer, intent(out) :: terms_of_row(max_terms)
      integer, intent(out) :: rows
      real(wp) :: x(3), y(3), z(3), z_j(3)
      integer :: k, used

      rows = 0
      used = 0
      terms_of_row = 1
      z = geometry%axis_i
      z_j = geometry%axis_j
      x = perpendicular(z)
      y = cross(z, x)

      select case (kind)
      case ('spherical', 'universal', 'constant_velocity', 'revolute', 'fixed')
         do k = 1, 3
            call add(global_gap, identity3(:, k))
         end do
      end select

      select case (kind)
      case ('universal', 'perpendicular')
         call add(axis_axis, z, z_j)
      case ('constant_velocity')
         call add(axis_axis, x, cross(z_j, shaft_frame(z, z_j, x)))
         used = used + 1
         terms(used) = terms(used - 1)
         terms(used)%measure%u = y
         terms(used)%measure%v = shaft_frame(z, z_j, x)
         terms(used)%coefficient = -1.0_wp
         terms_of_row(rows) = 2
      case ('revolute')
         call add(axis_axis, x, z)
         call add(axis_axis, y, z)
      case ('parallel')
         call add(axis_axis, x, z_j)
         call add(axis_axis, y, z_j)
      case ('cylindrical', 'translational')
         call add(axis_axis, x, z)
         call add(axis_axis, y, z)
         call add(body_gap, x)
         call add(body_gap, y)
         if (kind == 'translational') call add(axis_axis, x, y)
      case ('fixed')
         call add(axis_axis, identity3(:, 1), identity3(:, 2))
         call add(axis_axis, identity3(:, 2), identity3(:, 3))
         call add(axis_axis, identity3(:, 3), identity3(:, 1))
      case ('distance')
         call add(distance, z)
      case ('in_plane')
         call add(body_gap, z)
      case ('in_line')
         call add(body_gap, x)
         call add(body_gap, y)
      end select

   contains

      subroutine add(measure_kind, u, v)
         integer, intent(in) :: measure_kind
         real(wp), intent(in) :: u(3)
         real(wp), intent(in), optional :: v(3)

         rows = rows + 1
         used = used + 1
         terms(used)%measure%kind = measure_kind
         terms(used)%measure%body_i = geometry%body_i
         terms(used)%measure%body_j = geometry%body_j
         terms(used)%measure%u = u
         if (present(v)) terms(used)%measure%v = v
         terms(used)%measure%arm_i = geometry%point_i
         terms(used)%measure%arm_j = geometry%point_j
      end subroutine add

   end subroutine joint_terms

   !> The direction perpendicular to shaft j obtained from x, perpendicular to shaft i, by the shortest
   !> rotation that carries shaft i onto shaft j. With it u1·v2 − u2·v1 = 0 at design.
   pure function shaft_frame(z_i, z_j, x) result(v)
      real(wp), intent(in) :: z_i(3), z_j(3), x(3)
      real(wp) :: v(3), axis(3), c

      axis = cross(z_i, z_j)
      c = dot_product(z_i, z_j)
      v = x*c + cross(axis, x) + axis*(dot_product(axis, x)/(1.0_wp + c))
   end function shaft_frame

end module ek_joint
