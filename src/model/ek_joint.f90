!> Joints as lists of measures held at a value: Φ(q) = 0 (Kang 2005, eq. 1).
!>
!> | joint             | rows                                                     | removes |
!> |-------------------|----------------------------------------------------------|---------|
!> | spherical         | 3 global displacements                                   | 3       |
!> | universal         | spherical + axis·axis2                                   | 4       |
!> | constant_velocity | spherical + twist u1·v2 − u2·v1                          | 4       |
!> | revolute          | spherical + 2 axis·axis                                  | 5       |
!> | cylindrical       | 2 axis·axis + 2 displacements across the axis            | 4       |
!> | translational     | cylindrical + 1 axis·axis                                | 5       |
!> | fixed             | spherical + 3 axis·axis                                  | 6       |
!> | distance          | distance                                                 | 1       |
!> | in_plane          | 1 displacement along a direction of the first body       | 1       |
!> | in_line           | 2 displacements across a direction of the first body     | 2       |
!> | perpendicular     | axis·axis2                                               | 1       |
!> | parallel          | 2 axis·axis                                              | 2       |
!> | driver            | a measure = its design value + prescribed change (+ λ/stiffness) | 1 |
!> | coupler           | Σ ratio × measure = its design value                     | 1       |
!>
!> A new joint needs its row in `joint_table` and its terms in `joint_terms`, both here, its row in the table above, and a test.
!> Reader, solver and pictures do not depend on the names.
module ek_joint
   use ek_kinds, only: wp
   use ek_row, only: row_t, term_t
   use ek_measure, only: measure_t, axis_axis, body_gap, global_gap, distance
   use ek_rotation, only: cross, perpendicular, unit_vector, identity3, angle_between
   implicit none(type, external)
   private
   public :: joint_t, row_t, term_t, joint_geometry_t, joint_terms, joint_kinds, joint_table, joint_kind_t, max_terms, axes_fit
   public :: no_axis, one_axis, one_or_two, two_axes, either_axis, any_angle, right_angle, no_angle, not_opposed
   public :: no_part, unseen_part, rod_part, ball_part, hinge_part, slider_part, guide_part

   integer, parameter :: max_terms = 6   !! largest number of terms of a joint (fixed)

   ! directions that define a joint, those of axis and axis_2
   integer, parameter :: no_axis = 0, one_axis = 1, one_or_two = 2, two_axes = 3
   integer, parameter :: either_axis = 4      !! axis or axis_2; the program chooses the other axis perpendicular
   ! angle between axis and axis_2
   integer, parameter :: any_angle = 0, right_angle = 1, no_angle = 2, not_opposed = 3
   ! parts in pictures: without an attachment point; with one that is not drawn; drawn
   integer, parameter :: no_part = 0, unseen_part = 1, rod_part = 2, ball_part = 3, hinge_part = 4, slider_part = 5, guide_part = 6

   !> The properties of a kind of joint.
   type :: joint_kind_t
      character(17) :: name
      integer :: min_points, max_points   !! number of points in `at`; 2 and 2: two points that do not coincide
      integer :: axes, angle                 !! constants above: directions and angle that the joint requires
      integer :: part
      logical :: is_of_measures = .false.    !! made of named measures, not of points and axes
   end type joint_kind_t

   type(joint_kind_t), parameter :: joint_table(*) = [ &
      joint_kind_t('spherical', 1, 1, no_axis, any_angle, ball_part), &
      joint_kind_t('universal', 1, 1, either_axis, right_angle, ball_part), &
      joint_kind_t('constant_velocity', 1, 1, two_axes, not_opposed, ball_part), &
      joint_kind_t('revolute', 1, 1, one_axis, any_angle, hinge_part), &
      joint_kind_t('cylindrical', 1, 1, one_axis, any_angle, slider_part), &
      joint_kind_t('translational', 1, 1, one_axis, any_angle, slider_part), &
      joint_kind_t('fixed', 1, 1, no_axis, any_angle, unseen_part), &
      joint_kind_t('distance', 2, 2, no_axis, any_angle, rod_part), &
      joint_kind_t('in_plane', 1, 2, one_axis, any_angle, guide_part), &
      joint_kind_t('in_line', 1, 2, one_axis, any_angle, guide_part), &
      joint_kind_t('perpendicular', 0, 1, two_axes, right_angle, no_part), &
      joint_kind_t('parallel', 0, 1, one_or_two, no_angle, no_part), &
      joint_kind_t('driver', 0, 0, no_axis, any_angle, no_part, .true.), &
      joint_kind_t('coupler', 0, 0, no_axis, any_angle, no_part, .true.)]

   character(*), parameter :: joint_kinds(*) = joint_table%name

   !> A named joint: its definition in the deck, and its rows of Φ.
   type :: joint_t
      character(:), allocatable :: name
      character(:), allocatable :: kind      !! one of joint_kinds
      integer :: number = 0                  !! index of the kind in joint_table
      character(:), allocatable :: where     !! 'file:line' for messages
      integer :: body_i = 0, body_j = 0
      real(wp) :: arm_j(3) = 0.0_wp          !! point where the joint force acts on body j, body axes [m]
      integer :: first_row = 0, rows = 0
      integer :: chosen_axis = 0             !! universal: 1 or 2 if the program chose this axis; 0: both given
      real(wp) :: axis(3, 2) = 0.0_wp        !! universal: axis and axis_2, unit vectors, global at design
      real(wp) :: across(3) = 0.0_wp         !! direction to which the first row across the axis is nearest; 0: free choice
      logical :: is_of_measures = .false.    !! driver, coupler: its reaction is one number, not a force at a point
      logical :: says_balance = .false.      !! driver with a stiffness: the deck gives `balance`
      logical :: is_balanced = .true.        !! the value of `balance`
   end type joint_t

   !> The geometry that defines a joint: design position, global axes, SI.
   type :: joint_geometry_t
      integer :: body_i = 0, body_j = 0
      real(wp) :: point_i(3) = 0.0_wp, point_j(3) = 0.0_wp   !! points on i and j [m], equal unless two are given
      real(wp) :: axis_i(3) = [0.0_wp, 0.0_wp, 1.0_wp]       !! unit vector fixed in body i
      real(wp) :: axis_j(3) = [0.0_wp, 0.0_wp, 1.0_wp]       !! unit vector fixed in body j
      real(wp) :: across(3) = 0.0_wp                         !! direction of the first row across the axis; 0: free choice
   end type joint_geometry_t

contains

   !> Whether two axes are at the angle that a joint requires.
   pure logical function axes_fit(needed, axis_i, axis_j)
      integer, intent(in) :: needed                     !! angle of joint_table
      real(wp), intent(in) :: axis_i(3), axis_j(3)      !! unit
      real(wp), parameter :: tolerance = 0.01_wp, widest = 179.0_wp      ! deg
      real(wp) :: angle

      axes_fit = .true.
      if (all(needed /= [right_angle, no_angle, not_opposed])) return
      angle = angle_between(axis_i, axis_j)
      select case (needed)
      case (right_angle)
         axes_fit = abs(angle - 90.0_wp) <= tolerance
      case (no_angle)
         axes_fit = min(angle, 180.0_wp - angle) <= tolerance
      case (not_opposed)
         axes_fit = angle <= widest
      end select
   end function axes_fit

   !> Lists the terms of a joint in row order, and the number of terms of each row.
   !>
   !> Arms are design points (global); `settle_design` subtracts the reference points of the bodies.
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
      if (norm2(geometry%across) > 0.0_wp) x = unit_vector(geometry%across - dot_product(geometry%across, z)*z)
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
      case ('revolute', 'cylindrical', 'translational')
         call add(axis_axis, x, z)
         call add(axis_axis, y, z)
      case ('parallel')
         call add(axis_axis, x, z_j)
         call add(axis_axis, y, z_j)
      case ('fixed')
         call add(axis_axis, identity3(:, 1), identity3(:, 2))
         call add(axis_axis, identity3(:, 2), identity3(:, 3))
         call add(axis_axis, identity3(:, 3), identity3(:, 1))
      case ('distance')
         call add(distance, z)
      case ('in_plane')
         call add(body_gap, z)
      end select

      select case (kind)
      case ('cylindrical', 'translational', 'in_line')
         call add(body_gap, x)
         call add(body_gap, y)
         if (kind == 'translational') call add(axis_axis, x, y)
      end select

   contains

      !> Appends a row with one term.
      subroutine add(measure_kind, u, v)
         integer, intent(in) :: measure_kind
         real(wp), intent(in) :: u(3)
         real(wp), intent(in), optional :: v(3)

         rows = rows + 1
         used = used + 1
         terms(used)%measure = measure_t(kind=measure_kind, body_i=geometry%body_i, body_j=geometry%body_j, u=u, &
            arm_i=geometry%point_i, arm_j=geometry%point_j)
         if (present(v)) terms(used)%measure%v = v
      end subroutine add

   end subroutine joint_terms

   !> The direction x, which is perpendicular to shaft i, after the shortest rotation that carries shaft i onto shaft j. The result
   !> is perpendicular to shaft j, and u1·v2 − u2·v1 = 0 at design.
   pure function shaft_frame(z_i, z_j, x) result(v)
      real(wp), intent(in) :: z_i(3), z_j(3), x(3)
      real(wp) :: v(3), axis(3), c

      axis = cross(z_i, z_j)
      c = dot_product(z_i, z_j)
      v = x*c + cross(axis, x) + axis*(dot_product(axis, x)/(1.0_wp + c))
   end function shaft_frame

end module ek_joint
