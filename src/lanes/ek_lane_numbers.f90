!> Numbers of four designs, computed together: arithmetic.
!>
!> The result of a lane never depends on its neighbours, and equals the result of the scalar operation to the bit.
module ek_lane_numbers
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: lanes, lanes_t, zero, one
   public :: assignment(=), operator(+), operator(-), operator(*), operator(/), operator(**)

   integer, parameter :: lanes = 4       !! gfortran does not hold eight lanes in registers

   !> One number of each of the designs.
   type :: lanes_t
      real(wp) :: v(lanes)
   end type lanes_t

   type(lanes_t), parameter :: zero = lanes_t([0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
   type(lanes_t), parameter :: one = lanes_t([1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp])

   interface assignment(=)
      procedure :: assign_real
   end interface assignment(=)
   interface operator(+)
      procedure :: add, add_to_real, add_real
   end interface operator(+)
   interface operator(-)
      procedure :: subtract, subtract_from_real, subtract_real, minus
   end interface operator(-)
   interface operator(*)
      procedure :: multiply, multiply_real, multiply_by_real
   end interface operator(*)
   interface operator(/)
      procedure :: divide, divide_real, divide_by_real
   end interface operator(/)
   interface operator(**)
      procedure :: power
   end interface operator(**)

contains

   !> Sets all lanes to one number.
   elemental subroutine assign_real(x, number)
      type(lanes_t), intent(out) :: x
      real(wp), intent(in) :: number
      integer :: l
      !$omp simd
      do l = 1, lanes
         x%v(l) = number
      end do
   end subroutine assign_real

   !> a + b
   elemental type(lanes_t) function add(a, b) result(y)
      type(lanes_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l) + b%v(l)
      end do
   end function add

   !> a + b
   elemental type(lanes_t) function add_to_real(a, b) result(y)
      real(wp), intent(in) :: a
      type(lanes_t), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a + b%v(l)
      end do
   end function add_to_real

   !> a + b
   elemental type(lanes_t) function add_real(a, b) result(y)
      type(lanes_t), intent(in) :: a
      real(wp), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l) + b
      end do
   end function add_real

   !> a − b
   elemental type(lanes_t) function subtract(a, b) result(y)
      type(lanes_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l) - b%v(l)
      end do
   end function subtract

   !> a − b
   elemental type(lanes_t) function subtract_from_real(a, b) result(y)
      real(wp), intent(in) :: a
      type(lanes_t), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a - b%v(l)
      end do
   end function subtract_from_real

   !> a − b
   elemental type(lanes_t) function subtract_real(a, b) result(y)
      type(lanes_t), intent(in) :: a
      real(wp), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l) - b
      end do
   end function subtract_real

   !> a b
   elemental type(lanes_t) function multiply(a, b) result(y)
      type(lanes_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l)*b%v(l)
      end do
   end function multiply

   !> a b
   elemental type(lanes_t) function multiply_real(a, b) result(y)
      real(wp), intent(in) :: a
      type(lanes_t), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a*b%v(l)
      end do
   end function multiply_real

   !> a b
   elemental type(lanes_t) function multiply_by_real(a, b) result(y)
      type(lanes_t), intent(in) :: a
      real(wp), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l)*b
      end do
   end function multiply_by_real

   !> a/b
   elemental type(lanes_t) function divide(a, b) result(y)
      type(lanes_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l)/b%v(l)
      end do
   end function divide

   !> a/b
   elemental type(lanes_t) function divide_real(a, b) result(y)
      real(wp), intent(in) :: a
      type(lanes_t), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a/b%v(l)
      end do
   end function divide_real

   !> a/b
   elemental type(lanes_t) function divide_by_real(a, b) result(y)
      type(lanes_t), intent(in) :: a
      real(wp), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l)/b
      end do
   end function divide_by_real

   !> −a
   elemental type(lanes_t) function minus(a) result(y)
      type(lanes_t), intent(in) :: a
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = -a%v(l)
      end do
   end function minus

   !> a to the power 2, 3 or any n ≥ 0, multiplied in the order of gfortran's scalar powers.
   elemental type(lanes_t) function power(a, n) result(y)
      type(lanes_t), intent(in) :: a
      integer, intent(in) :: n
      integer :: l

      select case (n)
      case (2)
         !$omp simd
         do l = 1, lanes
            y%v(l) = a%v(l)*a%v(l)
         end do
      case (3)
         !$omp simd
         do l = 1, lanes
            y%v(l) = a%v(l)*a%v(l)*a%v(l)
         end do
      case default
         do l = 1, lanes
            y%v(l) = a%v(l)**n
         end do
      end select
   end function power

end module ek_lane_numbers
