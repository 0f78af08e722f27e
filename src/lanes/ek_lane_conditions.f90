!> Conditions on the numbers of four designs, and functions of these conditions.
!>
!> A condition is stored as 1 or 0 in a real: SSE2 has no comparison of 64-bit integers.
module ek_lane_conditions
   use ek_kinds, only: wp
   use ek_lane_numbers, only: lanes, lanes_t
   implicit none(type, external)
   private
   public :: mask_t, piece_t
   public :: operator(<), operator(<=), operator(>), operator(>=), operator(.and.), operator(.or.), operator(.not.)
   public :: some, every, merge, min, max, abs, pieces_below, entry

   !> One condition for each of the four designs: 1 if the condition holds, 0 otherwise.
   type :: mask_t
      real(wp) :: v(lanes)
   end type mask_t

   !> One position in a table for each of the four designs.
   type :: piece_t
      integer :: v(lanes)
   end type piece_t

   interface operator(<)
      procedure :: less, less_real
   end interface operator(<)
   interface operator(<=)
      procedure :: less_or_equal, less_or_equal_real
   end interface operator(<=)
   interface operator(>)
      procedure :: greater, greater_real
   end interface operator(>)
   interface operator(>=)
      procedure :: greater_or_equal, greater_or_equal_real
   end interface operator(>=)
   interface operator(.and.)
      procedure :: both
   end interface operator(.and.)
   interface operator(.or.)
      procedure :: either
   end interface operator(.or.)
   interface operator(.not.)
      procedure :: opposite
   end interface operator(.not.)
   interface merge
      procedure :: merge_lanes
   end interface merge
   interface min
      procedure :: min_lanes
   end interface min
   interface max
      procedure :: max_lanes
   end interface max
   interface abs
      procedure :: abs_lanes
   end interface abs

contains

   !> The condition a < b, lane by lane.
   elemental type(mask_t) function less(a, b) result(y)
      type(lanes_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = merge(1.0_wp, 0.0_wp, a%v(l) < b%v(l))
      end do
   end function less

   !> The condition a < b, lane by lane, with one b for all designs.
   elemental type(mask_t) function less_real(a, b) result(y)
      type(lanes_t), intent(in) :: a
      real(wp), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = merge(1.0_wp, 0.0_wp, a%v(l) < b)
      end do
   end function less_real

   !> The condition a ≤ b, lane by lane.
   elemental type(mask_t) function less_or_equal(a, b) result(y)
      type(lanes_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = merge(1.0_wp, 0.0_wp, a%v(l) <= b%v(l))
      end do
   end function less_or_equal

   !> The condition a ≤ b, lane by lane, with one b for all designs.
   elemental type(mask_t) function less_or_equal_real(a, b) result(y)
      type(lanes_t), intent(in) :: a
      real(wp), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = merge(1.0_wp, 0.0_wp, a%v(l) <= b)
      end do
   end function less_or_equal_real

   !> The condition a > b, lane by lane.
   elemental type(mask_t) function greater(a, b) result(y)
      type(lanes_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = merge(1.0_wp, 0.0_wp, a%v(l) > b%v(l))
      end do
   end function greater

   !> The condition a > b, lane by lane, with one b for all designs.
   elemental type(mask_t) function greater_real(a, b) result(y)
      type(lanes_t), intent(in) :: a
      real(wp), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = merge(1.0_wp, 0.0_wp, a%v(l) > b)
      end do
   end function greater_real

   !> The condition a ≥ b, lane by lane.
   elemental type(mask_t) function greater_or_equal(a, b) result(y)
      type(lanes_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = merge(1.0_wp, 0.0_wp, a%v(l) >= b%v(l))
      end do
   end function greater_or_equal

   !> The condition a ≥ b, lane by lane, with one b for all designs.
   elemental type(mask_t) function greater_or_equal_real(a, b) result(y)
      type(lanes_t), intent(in) :: a
      real(wp), intent(in) :: b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = merge(1.0_wp, 0.0_wp, a%v(l) >= b)
      end do
   end function greater_or_equal_real

   !> The condition a .and. b, lane by lane.
   elemental type(mask_t) function both(a, b) result(y)
      type(mask_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = a%v(l)*b%v(l)
      end do
   end function both

   !> The condition a .or. b, lane by lane.
   elemental type(mask_t) function either(a, b) result(y)
      type(mask_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = max(a%v(l), b%v(l))
      end do
   end function either

   !> The condition .not. a, lane by lane.
   elemental type(mask_t) function opposite(a) result(y)
      type(mask_t), intent(in) :: a
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = 1.0_wp - a%v(l)
      end do
   end function opposite

   !> Whether a condition holds in any lane.
   elemental logical function some(condition)
      type(mask_t), intent(in) :: condition
      some = (condition%v(1) + condition%v(2)) + (condition%v(3) + condition%v(4)) > 0.0_wp
   end function some

   !> Whether a condition holds in every lane.
   elemental logical function every(condition)
      type(mask_t), intent(in) :: condition
      every = (condition%v(1) + condition%v(2)) + (condition%v(3) + condition%v(4)) > 3.5_wp
   end function every

   !> The value a if the condition holds, otherwise b, lane by lane. Both values are read first, because gfortran branches lane by
   !> lane if a read depends on a condition.
   elemental type(lanes_t) function merge_lanes(a, b, condition) result(y)
      type(lanes_t), intent(in) :: a, b
      type(mask_t), intent(in) :: condition
      real(wp) :: here, there
      integer :: l
      !$omp simd private(here, there)
      do l = 1, lanes
         here = a%v(l)
         there = b%v(l)
         y%v(l) = merge(here, there, condition%v(l) > 0.0_wp)
      end do
   end function merge_lanes

   !> The smaller of two numbers, lane by lane.
   elemental type(lanes_t) function min_lanes(a, b) result(y)
      type(lanes_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = min(a%v(l), b%v(l))
      end do
   end function min_lanes

   !> The larger of two numbers, lane by lane.
   elemental type(lanes_t) function max_lanes(a, b) result(y)
      type(lanes_t), intent(in) :: a, b
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = max(a%v(l), b%v(l))
      end do
   end function max_lanes

   !> The absolute value |a|, lane by lane.
   elemental type(lanes_t) function abs_lanes(a) result(y)
      type(lanes_t), intent(in) :: a
      integer :: l
      !$omp simd
      do l = 1, lanes
         y%v(l) = abs(a%v(l))
      end do
   end function abs_lanes

   !> The number of breaks that are less than or equal to x, lane by lane.
   pure type(piece_t) function pieces_below(breaks, x) result(k)
      type(lanes_t), intent(in) :: breaks(:), x
      integer :: l, n

      k%v = 0
      do n = 1, size(breaks)
         !$omp simd
         do l = 1, lanes
            k%v(l) = k%v(l) + merge(1, 0, breaks(n)%v(l) <= x%v(l))
         end do
      end do
   end function pieces_below

   !> Entry k of a table, lane by lane.
   pure type(lanes_t) function entry(table, k) result(y)
      type(lanes_t), intent(in) :: table(:)
      type(piece_t), intent(in) :: k
      integer :: l

      do l = 1, lanes
         y%v(l) = table(k%v(l))%v(l)
      end do
   end function entry

end module ek_lane_conditions
