!> The gradients of several results compared with those of the first, one row per quantity.
module ek_comparison
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_gradient, only: gradient_t
   implicit none(type, external)
   private
   public :: difference_t, gradient_set_t, compare_gradients, difference, percent

   !> The gradients of one result.
   type :: gradient_set_t
      type(gradient_t), allocatable :: list(:)
   end type gradient_set_t

   type :: difference_t
      character(:), allocatable :: test, quantity, side, unit, window
      real(wp), allocatable :: values(:)      !! one per result; not a number if it lacks the gradient
      logical, allocatable :: is_there(:)
   end type difference_t

contains

   !> All gradients of all results; the same test, quantity and side are one row. Rows are in the order of the first
   !> result, followed by gradients of the others only.
   subroutine compare_gradients(sets, rows)
      type(gradient_set_t), intent(in) :: sets(:)
      type(difference_t), allocatable, intent(out) :: rows(:)
      integer :: s, k, row, used

      used = 0
      do s = 1, size(sets)
         used = used + size(sets(s)%list)
      end do
      allocate (rows(used))
      used = 0
      do s = 1, size(sets)
         do k = 1, size(sets(s)%list)
            associate (g => sets(s)%list(k))
               do row = 1, used
                  if (rows(row)%test == g%test .and. rows(row)%quantity == g%quantity .and. rows(row)%side == g%side) exit
               end do
               if (row > used) then
                  used = row
                  rows(row)%test = g%test
                  rows(row)%quantity = g%quantity
                  rows(row)%side = g%side
                  rows(row)%unit = g%unit
                  rows(row)%window = g%window
                  allocate (rows(row)%values(size(sets)), rows(row)%is_there(size(sets)))
                  rows(row)%values = ieee_value(1.0_wp, ieee_quiet_nan)
                  rows(row)%is_there = .false.
               end if
               rows(row)%values(s) = g%value
               rows(row)%is_there(s) = .true.
               if (rows(row)%window /= g%window) rows(row)%window = 'different windows'
            end associate
         end do
      end do
      rows = rows(:used)
   end subroutine compare_gradients

   !> b − a; not a number if one is missing.
   elemental real(wp) function difference(a, b)
      real(wp), intent(in) :: a, b

      difference = ieee_value(1.0_wp, ieee_quiet_nan)
      if (ieee_is_finite(a) .and. ieee_is_finite(b)) difference = b - a
   end function difference

   !> 100 (b − a)/|a|; not a number if a is zero to rounding.
   elemental real(wp) function percent(a, b)
      real(wp), intent(in) :: a, b
      real(wp), parameter :: nothing = 1.0e-9_wp     ! in the unit of any gradient: rounding of a zero

      percent = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. (ieee_is_finite(a) .and. ieee_is_finite(b))) return
      if (abs(a) <= nothing) return
      if (abs(b - a) < huge(1.0_wp)*min(1.0_wp, abs(a))/100) percent = 100*((b - a)/abs(a))
   end function percent

end module ek_comparison
