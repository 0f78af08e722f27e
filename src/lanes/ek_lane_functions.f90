!> Functions of the numbers of four designs. Each lane has the value of the intrinsic function with the same name.
module ek_lane_functions
   use ek_kinds, only: wp
   use ek_lane_numbers, only: lanes, lanes_t, zero, operator(+), operator(*)
   implicit none(type, external)
   private
   public :: sqrt, sin, cos, atan2, log, dot_product, sum, norm2

   interface sqrt
      procedure :: sqrt_lanes
   end interface sqrt
   interface sin
      procedure :: sin_lanes
   end interface sin
   interface cos
      procedure :: cos_lanes
   end interface cos
   interface log
      procedure :: log_lanes
   end interface log
   interface atan2
      procedure :: atan2_lanes
   end interface atan2
   interface dot_product
      procedure :: dot_product_lanes, dot_product_real
   end interface dot_product
   interface sum
      procedure :: sum_lanes
   end interface sum
   interface norm2
      procedure :: norm2_lanes
   end interface norm2

contains

   !> The square root of a, lane by lane.
   elemental type(lanes_t) function sqrt_lanes(a) result(y)
      type(lanes_t), intent(in) :: a
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = sqrt(a%v(l))
      end do
   end function sqrt_lanes

   ! these loops are not vectorised: gfortran would use sin, cos, atan2 and log of a vector library, whose last bits differ from the
   ! scalar functions

   !> The sine of an angle a [rad], lane by lane.
   elemental type(lanes_t) function sin_lanes(a) result(y)
      type(lanes_t), intent(in) :: a
      integer :: l
      !GCC$ novector
      do l = 1, lanes
         y%v(l) = sin(a%v(l))
      end do
   end function sin_lanes

   !> The natural logarithm of a, lane by lane.
   elemental type(lanes_t) function log_lanes(a) result(y)
      type(lanes_t), intent(in) :: a
      integer :: l
      !GCC$ novector
      do l = 1, lanes
         y%v(l) = log(a%v(l))
      end do
   end function log_lanes

   !> The cosine of an angle a [rad], lane by lane.
   elemental type(lanes_t) function cos_lanes(a) result(y)
      type(lanes_t), intent(in) :: a
      integer :: l
      !GCC$ novector
      do l = 1, lanes
         y%v(l) = cos(a%v(l))
      end do
   end function cos_lanes

   !> The angle of the point (x, y) from the x axis [rad], lane by lane.
   elemental type(lanes_t) function atan2_lanes(y, x) result(angle)
      type(lanes_t), intent(in) :: y, x
      integer :: l
      !GCC$ novector
      do l = 1, lanes
         angle%v(l) = atan2(y%v(l), x%v(l))
      end do
   end function atan2_lanes

   !> The scalar product a·b, summed from the first component on, as in the intrinsic function.
   pure type(lanes_t) function dot_product_lanes(a, b) result(y)
      type(lanes_t), intent(in) :: a(:), b(:)
      integer :: k
      y = zero
      do k = 1, size(a)
         y = y + a(k)*b(k)
      end do
   end function dot_product_lanes

   !> The scalar product a·b, with one a for all designs.
   pure type(lanes_t) function dot_product_real(a, b) result(y)
      real(wp), intent(in) :: a(:)
      type(lanes_t), intent(in) :: b(:)
      integer :: k
      y = zero
      do k = 1, size(b)
         y = y + a(k)*b(k)
      end do
   end function dot_product_real

   !> The sum of all components of a vector, from the first component on, lane by lane.
   pure type(lanes_t) function sum_lanes(a) result(y)
      type(lanes_t), intent(in) :: a(:)
      integer :: k
      y = zero
      do k = 1, size(a)
         y = y + a(k)
      end do
   end function sum_lanes

   !> The Euclidean norm |a| of a vector, lane by lane.
   pure type(lanes_t) function norm2_lanes(a) result(y)
      type(lanes_t), intent(in) :: a(:)
      real(wp) :: x(size(a))
      integer :: k, l
      do l = 1, lanes
         do k = 1, size(a)
            x(k) = a(k)%v(l)
         end do
         y%v(l) = norm2(x)
      end do
   end function norm2_lanes

end module ek_lane_functions
