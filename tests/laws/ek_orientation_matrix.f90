!> Rotation matrices of rotation vectors, and back to quaternions.
module ek_orientation_matrix
   use ek_kinds, only: wp
   use ek_rotation, only: quaternion_of_vector, rotation_matrix
   implicit none(type, external)
   private
   public :: matrix_of_vector, quaternion_of_matrix

contains

   !> exp(ṽ)
   pure function matrix_of_vector(v) result(a)
      real(wp), intent(in) :: v(3)
      real(wp) :: a(3, 3)
      a = rotation_matrix(quaternion_of_vector(v))
   end function matrix_of_vector

   !> Unit quaternion of a rotation matrix (Shepperd: divide by the largest component).
   pure function quaternion_of_matrix(a) result(q)
      real(wp), intent(in) :: a(3, 3)
      real(wp) :: q(4), trace, pick(4)

      trace = a(1, 1) + a(2, 2) + a(3, 3)
      pick = [trace, a(1, 1), a(2, 2), a(3, 3)]
      select case (maxloc(pick, dim=1))
      case (1)
         q = [1.0_wp + trace, a(3, 2) - a(2, 3), a(1, 3) - a(3, 1), a(2, 1) - a(1, 2)]
      case (2)
         q = [a(3, 2) - a(2, 3), 1.0_wp + 2*a(1, 1) - trace, a(1, 2) + a(2, 1), a(3, 1) + a(1, 3)]
      case (3)
         q = [a(1, 3) - a(3, 1), a(1, 2) + a(2, 1), 1.0_wp + 2*a(2, 2) - trace, a(2, 3) + a(3, 2)]
      case default
         q = [a(2, 1) - a(1, 2), a(3, 1) + a(1, 3), a(2, 3) + a(3, 2), 1.0_wp + 2*a(3, 3) - trace]
      end select
      q = q/norm2(q)
   end function quaternion_of_matrix

end module ek_orientation_matrix
