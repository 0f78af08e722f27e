!> The core of the model: six scalar functions of the poses of two bodies, with gradient and Hessian.
!>
!> A joint is a list of measures held at a value, an elastic element is a list of measures with
!> a law, a driver is a measure with a prescribed value, a readout is a measure written to the results.
!>
!> Coordinates: z = [Δr_i Δπ_i Δr_j Δπ_j], translation and rotation vector in GLOBAL axes,
!> r ← r + Δr, A ← exp(Δπ̃) A (Kang 2005, eq. 4). A point on arm s moves by Δr − s̃ Δπ (eq. 12).
!>
!> | kind       | value   | gradient in z                     |
!> |------------|---------|-----------------------------------|
!> | axis_axis  | u·v     | [0, u×v, 0, v×u]                  |
!> | body_gap   | u·d     | [−u, −(a+d)×u, u, b×u]            |
!> | global_gap | n·d     | [−n, −a×n, n, b×n]                |
!> | distance   | \|d\|   | Jᵀe, J = [−I, ã, I, −b̃], e = d/\|d\| |
!> | rotation   | m·θ     | [0, −A_i g, 0, A_i g]             |
!> | contact_gap | n·(d + R e) | [−n, −a×n, n, b×n + V×(f_K z + f_m n)], see ek_lowest_point |
!>
!> u is fixed in body i and v in body j, n is a global direction; a, b are the arms of the two
!> points, d = x_j − x_i; θ = log(A_iᵀ A_j) in the axes of body i, m a constant vector there. R e is the arm of the lowest point of
!> a wheel on body j, whose centre is the point x_j.
!> S(p,g) = ½(p gᵀ + g pᵀ) − (p·g) I, p̃ the skew matrix of p. Hessians refer to the
!> exponential coordinates above and are therefore symmetric; every block was derived by hand and is checked
!> against central differences in tests/model/test_measure.pf.
module ek_measure
   use ek_kinds, only: wp
   use ek_number, only: num, zero
   use ek_rotation, only: cross, identity3
   use ek_block, only: add_block, add_s_block, add_link_stiffness, add_gap_hessian, rotated, dyad, dyad_rest, pi_i, pi_j
   use ek_relative_rotation, only: pose_t, relative_rotation_t, relative_rotation, rotation_gradient, add_rotation_hessian
   use ek_lowest_point, only: lowest_point, lowest_gradient, add_lowest_hessian
   implicit none(type, external)
   private
   public :: measure_t, measure_numbers_t, measure_list_t, evaluation_t
   public :: axis_axis, body_gap, global_gap, distance, rotation, contact_gap
   public :: evaluate, measure_value, is_of_angle, add_measure_hessian

   integer, parameter :: axis_axis = 1    !! cosine between an axis of i and an axis of j [-]
   integer, parameter :: body_gap = 2     !! displacement between two points along a direction fixed in i [m]
   integer, parameter :: global_gap = 3   !! displacement between two points along a global direction [m]
   integer, parameter :: distance = 4     !! distance of two points [m]
   integer, parameter :: rotation = 5     !! component of the relative rotation vector [rad]
   integer, parameter :: contact_gap = 6  !! as global_gap, to the lowest point of a wheel on j [m]

   !> The numbers of a measure. At design all body axes are parallel to the global axes, so directions and arms are given in the
   !> design position.
   type :: measure_numbers_t
      real(num) :: u(3) = zero           !! direction in i (body_gap, axis_axis: unit), n, or m
      real(num) :: v(3) = zero           !! direction in j (axis_axis), or core radius × axis of the wheel (contact_gap) [m]
      real(num) :: arm_i(3) = zero       !! point on i from its reference point, body axes [m]
      real(num) :: arm_j(3) = zero       !! point on j from its reference point, body axes [m]
   end type measure_numbers_t

   !> The numbers of a measure as a list (see law_list_t).
   type :: measure_list_t
      real(num) :: v(storage_size(measure_numbers_t())/storage_size(zero)) = zero
   end type measure_list_t

   !> One scalar measure between body i and body j (0 is the chassis).
   type, extends(measure_numbers_t) :: measure_t
      integer :: kind = 0                 !! one of the six above
      integer :: body_i = 0, body_j = 0
   end type measure_t

   !> An evaluation: the vectors of a measure in global axes at one pair of poses, computed once and used for
   !> value, gradient and Hessian.
   type :: evaluation_t
      real(num) :: value = zero
      real(num) :: gradient(12) = zero
      real(num) :: u(3) = zero, v(3) = zero   !! directions; distance: u = e; rotation: u = m, v = A_i g
      real(num) :: a(3) = zero, b(3) = zero, d(3) = zero
      real(num) :: frame(3, 3) = zero           !! A_i, stored for `rotation`
      type(relative_rotation_t) :: rotation
   end type evaluation_t

contains

   !> Evaluates a measure: value and gradient, and its vectors for the Hessian.
   !>
   !> Degenerate cases: a distance of 0 has no direction (checked when the model is built); a rotation
   !> of exactly π has no unique axis.
   !> Equations (M.1), (M.4), (M.5), (M.6), (M.7), (M.12), (M.20), (M.21) of docs/theory/measures.md.
   pure subroutine evaluate(measure, pose_i, pose_j, evaluation)
      type(measure_t), intent(in) :: measure
      type(pose_t), intent(in) :: pose_i, pose_j
      type(evaluation_t), intent(inout) :: evaluation     !! only the components that this kind needs are set
      real(num) :: a(3), b(3), d(3), g(3), u(3), v(3), w(3)

      select case (measure%kind)
      case (axis_axis)
         u = rotated(pose_i%a, measure%u)
         v = rotated(pose_j%a, measure%v)
         w = cross(u, v)
         evaluation%u = u
         evaluation%v = v
         evaluation%value = dot_product(u, v)
         evaluation%gradient(1:3) = 0.0_wp
         evaluation%gradient(4:6) = w
         evaluation%gradient(7:9) = 0.0_wp
         evaluation%gradient(10:12) = -w
      case (rotation)
         call relative_rotation(pose_i, pose_j, evaluation%rotation)
         evaluation%value = dot_product(measure%u, evaluation%rotation%theta)
         g = rotation_gradient(evaluation%rotation, measure%u)
         v = rotated(pose_i%a, g)
         evaluation%u = measure%u
         evaluation%v = v
         evaluation%frame = pose_i%a
         evaluation%gradient(1:3) = 0.0_wp
         evaluation%gradient(4:6) = -v
         evaluation%gradient(7:9) = 0.0_wp
         evaluation%gradient(10:12) = v
      case default
         a = rotated(pose_i%a, measure%arm_i)
         b = rotated(pose_j%a, measure%arm_j)
         d = (pose_j%r - pose_i%r) + (b - a)
         w = a
         select case (measure%kind)
         case (body_gap)
            u = rotated(pose_i%a, measure%u)
            evaluation%value = dot_product(u, d)
            w = a + d
         case (global_gap)
            u = measure%u
            evaluation%value = dot_product(u, d)
         case (contact_gap)
            u = measure%u
            v = rotated(pose_j%a, measure%v)
            evaluation%v = v
            evaluation%value = dot_product(u, d) + dot_product(u, lowest_point(v))
         case default
            evaluation%value = sqrt(d(1)**2 + d(2)**2 + d(3)**2)
            u = d/evaluation%value
         end select
         evaluation%a = a
         evaluation%b = b
         evaluation%d = d
         evaluation%u = u
         evaluation%gradient(1:3) = -u
         evaluation%gradient(4:6) = -cross(w, u)
         evaluation%gradient(7:9) = u
         evaluation%gradient(10:12) = cross(b, u)
         if (measure%kind == contact_gap) evaluation%gradient(10:12) = evaluation%gradient(10:12) + lowest_gradient(u, v)
      end select
   end subroutine evaluate

   !> The value of a measure [m or rad or -], without its derivatives.
   pure real(num) function measure_value(measure, pose_i, pose_j) result(value)
      type(measure_t), intent(in) :: measure
      type(pose_t), intent(in) :: pose_i, pose_j
      type(evaluation_t) :: evaluation
      call evaluate(measure, pose_i, pose_j, evaluation)
      value = evaluation%value
   end function measure_value

   !> Whether the generalised force of a kind of measure is a moment (rotation, cosine). Such a measure has no points.
   elemental logical function is_of_angle(kind)
      integer, intent(in) :: kind
      is_of_angle = kind == rotation .or. kind == axis_axis
   end function is_of_angle

   !> Adds weight × Hessian to the blocks of a matrix (see ek_block).
   !> Equations (M.1), (M.4), (M.6), (M.7), (M.21) of docs/theory/measures.md.
   pure subroutine add_measure_hessian(kind, evaluation, weight, at, blocks)
      integer, intent(in) :: kind
      type(evaluation_t), intent(in) :: evaluation          !! from `evaluate`, at the same poses
      real(num), intent(in) :: weight
      integer, intent(in) :: at(3)
      real(num), intent(inout) :: blocks(6, 6, *)
      real(num) :: u(3), m(3, 3)
      real(num), parameter :: none(3, 3) = zero

      u = weight*evaluation%u
      select case (kind)
      case (rotation)
         call add_rotation_hessian(evaluation%rotation, u, none, evaluation%frame, at, blocks)
      case (axis_axis)
         call add_s_block(u, evaluation%v, at(1), blocks)
         call add_s_block(u, evaluation%v, at(2), blocks)
         if (at(3) /= 0) call add_block(dyad_rest(evaluation%v, u), pi_i, pi_j, at, blocks)
      case (body_gap)
         call add_gap_hessian(u, evaluation%a, evaluation%b, evaluation%d, at, blocks)
      case (global_gap, distance, contact_gap)
         if (kind == contact_gap) call add_lowest_hessian(u, evaluation%v, at(2), blocks)
         if (kind == distance) then
            m = (weight/evaluation%value)*(identity3 - dyad(evaluation%u, evaluation%u))
            call add_link_stiffness(m, evaluation%a, evaluation%b, at, blocks)
         end if
         call add_s_block(evaluation%b, u, at(2), blocks)
         u = -u
         call add_s_block(evaluation%a, u, at(1), blocks)
      end select
   end subroutine add_measure_hessian

end module ek_measure
