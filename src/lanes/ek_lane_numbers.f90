!> Numbers of four designs that are computed together: arithmetic.
!>
!> The result in a lane never depends on the other lanes, and is identical bit for bit to the result of the scalar operation.
module ek_lane_numbers
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: lanes, lanes_t, zero, one
   public :: assignment(=), operator(+), operator(-), operator(*), operator(/), operator(**)

   integer, parameter :: lanes = 4       !! number of designs: gfortran does not hold eight lanes in registers

   !> One number for each of the four designs.
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

   !> The sum a + b, lane by lane.
   elemental type(lanes_t) function add(a, b) result(y)
      type(lanes_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l) + b%v(l)
      end do
   end function add

   !> The sum a + b, lane by lane, with one a for all designs.
   elemental type(lanes_t) function add_to_real(a, b) result(y)
      real(wp), intent(in) :: a
      type(lanes_t), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a + b%v(l)
      end do
   end function add_to_real

   !> The sum a + b, lane by lane, with one b for all designs.
   elemental type(lanes_t) function add_real(a, b) result(y)
      type(lanes_t), intent(in) :: a
      real(wp), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l) + b
      end do
   end function add_real

   !> The difference a − b, lane by lane.
   elemental type(lanes_t) function subtract(a, b) result(y)
      type(lanes_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l) - b%v(l)
      end do
   end function subtract

   !> The difference a − b, lane by lane, with one a for all designs.
   elemental type(lanes_t) function subtract_from_real(a, b) result(y)
      real(wp), intent(in) :: a
      type(lanes_t), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a - b%v(l)
      end do
   end function subtract_from_real

   !> The difference a − b, lane by lane, with one b for all designs.
   elemental type(lanes_t) function subtract_real(a, b) result(y)
      type(lanes_t), intent(in) :: a
      real(wp), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l) - b
      end do
   end function subtract_real

   !> The product a b, lane by lane.
   elemental type(lanes_t) function multiply(a, b) result(y)
      type(lanes_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l)*b%v(l)
      end do
   end function multiply

   !> The product a b, lane by lane, with one a for all designs.
   elemental type(lanes_t) function multiply_real(a, b) result(y)
      real(wp), intent(in) :: a
      type(lanes_t), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a*b%v(l)
      end do
   end function multiply_real

   !> The product a b, lane by lane, with one b for all designs.
   elemental type(lanes_t) function multiply_by_real(a, b) result(y)
      type(lanes_t), intent(in) :: a
      real(wp), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l)*b
      end do
   end function multiply_by_real

   !> The quotient a/b, lane by lane.
   elemental type(lanes_t) function divide(a, b) result(y)
      type(lanes_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l)/b%v(l)
      end do
   end function divide

   !> The quotient a/b, lane by lane, with one a for all designs.
   elemental type(lanes_t) function divide_real(a, b) result(y)
      real(wp), intent(in) :: a
      type(lanes_t), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a/b%v(l)
      end do
   end function divide_real

   !> The quotient a/b, lane by lane, with one b for all designs.
   elemental type(lanes_t) function divide_by_real(a, b) result(y)
      type(lanes_t), intent(in) :: a
      real(wp), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l)/b
      end do
   end function divide_by_real

   !> The negative −a, lane by lane.
   elemental type(lanes_t) function minus(a) result(y)
      type(lanes_t), intent(in) :: a
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = -a%v(l)
      end do
   end function minus

   !> The power aⁿ, lane by lane, for n ≥ 0, multiplied in the order of gfortran's scalar powers.
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
