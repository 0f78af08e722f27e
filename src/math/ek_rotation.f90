!> Rotations and vectors of three components: quaternions (scalar first), rotation vectors, skew matrices.
!>
!> A unit quaternion q = (cos φ/2, n sin φ/2) represents the rotation matrix A(q), which maps
!> body axes to global axes. Products satisfy A(p⊗q) = A(p) A(q).
module ek_rotation
   use ek_kinds, only: wp, degree
   use ek_number, only: num, mask, zero, one, some
   implicit none(type, external)
   private
   public :: cross, skew, unit_vector, perpendicular, angle_between
   public :: quaternion_product, quaternion_of_vector, rotation_matrix, rotate_quaternion
   public :: identity3

   real(num), parameter :: identity3(3, 3) = &
      reshape([one, zero, zero, zero, one, zero, zero, zero, one], [3, 3])

contains

   !> The vector product a × b.
   pure function cross(a, b) result(c)
      real(num), intent(in) :: a(3), b(3)
      real(num) :: c(3)
      c(1) = a(2)*b(3) - a(3)*b(2)
      c(2) = a(3)*b(1) - a(1)*b(3)
      c(3) = a(1)*b(2) - a(2)*b(1)
   end function cross

   !> The skew matrix p̃, for which p̃ x = p × x.
   pure function skew(p) result(matrix)
      real(num), intent(in) :: p(3)
      real(num) :: matrix(3, 3)
      matrix(1, 1) = 0.0_wp; matrix(1, 2) = -p(3); matrix(1, 3) = p(2)
      matrix(2, 1) = p(3); matrix(2, 2) = 0.0_wp; matrix(2, 3) = -p(1)
      matrix(3, 1) = -p(2); matrix(3, 2) = p(1); matrix(3, 3) = 0.0_wp
   end function skew

   !> The unit vector v/|v|. v must not be zero (checked by the reader).
   pure function unit_vector(v) result(u)
      real(num), intent(in) :: v(3)
      real(num) :: u(3)
      u = v/norm2(v)
   end function unit_vector

   !> A unit vector perpendicular to z, chosen deterministically: the global axis with the smallest
   !> component along z, made perpendicular to z.
   pure function perpendicular(z) result(x)
      real(num), intent(in) :: z(3)   !! unit vector
      real(num) :: x(3)
      real(num) :: size(3)
      logical(mask) :: is_x, is_y

      size = abs(z)
      is_x = size(1) <= size(2) .and. size(1) <= size(3)
      is_y = size(2) <= size(3) .and. .not. is_x
      x(1) = merge(one, zero, is_x)
      x(2) = merge(one, zero, is_y)
      x(3) = merge(zero, one, is_x .or. is_y)
      x = unit_vector(x - dot_product(x, z)*z)
   end function perpendicular

   !> Angle between two unit vectors [deg], also accurate near 0 and 180 deg.
   pure real(num) function angle_between(u, v) result(angle)
      real(num), intent(in) :: u(3), v(3)
      angle = 2.0_wp*atan2(norm2(u - v), norm2(u + v))/degree
   end function angle_between

   !> The quaternion product p ⊗ q.
   !> Equation (R.3) of docs/theory/rotations.md.
   pure function quaternion_product(p, q) result(r)
      real(num), intent(in) :: p(4), q(4)
      real(num) :: r(4)
      r(1) = p(1)*q(1) - p(2)*q(2) - p(3)*q(3) - p(4)*q(4)
      r(2) = p(1)*q(2) + p(2)*q(1) + p(3)*q(4) - p(4)*q(3)
      r(3) = p(1)*q(3) - p(2)*q(4) + p(3)*q(1) + p(4)*q(2)
      r(4) = p(1)*q(4) + p(2)*q(3) - p(3)*q(2) + p(4)*q(1)
   end function quaternion_product

   !> Quaternion of the rotation vector v [rad], exact for any length of v.
   !> Equations (R.1), (R.2) of docs/theory/rotations.md.
   pure function quaternion_of_vector(v) result(q)
      real(num), intent(in) :: v(3)
      real(num) :: q(4), square, s, half, factor
      logical(mask) :: is_small

      square = v(1)**2 + v(2)**2 + v(3)**2
      is_small = square < 1.0e-4_wp
      q(1) = one
      factor = 0.5_wp
      if (some(is_small)) then
         ! Taylor series: the next terms are below 1e-20 here, and no 0/0 at rest
         s = merge(square, zero, is_small)
         q(1) = 1.0_wp - s/8.0_wp*(1.0_wp - s/48.0_wp*(1.0_wp - s/120.0_wp))
         factor = 0.5_wp - s/48.0_wp*(1.0_wp - s/80.0_wp*(1.0_wp - s/168.0_wp))
      end if
      if (some(.not. is_small)) then
         half = 0.5_wp*sqrt(merge(one, square, is_small))
         q(1) = merge(q(1), cos(half), is_small)
         factor = merge(factor, 0.5_wp*sin(half)/half, is_small)
      end if
      q(2:4) = v*factor
   end function quaternion_of_vector

   !> The unit quaternion q(v) ⊗ q, normalised so that rounding does not accumulate over any number of increments.
   !> Equation (R.5) of docs/theory/rotations.md.
   pure function rotate_quaternion(v, q) result(turned)
      real(num), intent(in) :: v(3)     !! rotation vector, global axes [rad]
      real(num), intent(in) :: q(4)
      real(num) :: turned(4), square

      turned = quaternion_product(quaternion_of_vector(v), q)
      square = turned(1)**2 + turned(2)**2 + turned(3)**2 + turned(4)**2
      turned = turned/sqrt(square)
   end function rotate_quaternion

   !> The rotation matrix A(q), from body axes to global axes. q must have unit length.
   !> Equation (R.4) of docs/theory/rotations.md.
   pure function rotation_matrix(q) result(a)
      real(num), intent(in) :: q(4)
      real(num) :: a(3, 3), xx, yy, zz, xy, xz, yz, wx, wy, wz

      xx = 2.0_wp*q(2)*q(2); yy = 2.0_wp*q(3)*q(3); zz = 2.0_wp*q(4)*q(4)
      xy = 2.0_wp*q(2)*q(3); xz = 2.0_wp*q(2)*q(4); yz = 2.0_wp*q(3)*q(4)
      wx = 2.0_wp*q(1)*q(2); wy = 2.0_wp*q(1)*q(3); wz = 2.0_wp*q(1)*q(4)
      a(1, 1) = 1.0_wp - yy - zz; a(1, 2) = xy - wz; a(1, 3) = xz + wy
      a(2, 1) = xy + wz; a(2, 2) = 1.0_wp - xx - zz; a(2, 3) = yz - wx
      a(3, 1) = xz - wy; a(3, 2) = yz + wx; a(3, 3) = 1.0_wp - xx - yy
   end function rotation_matrix

end module ek_rotation
