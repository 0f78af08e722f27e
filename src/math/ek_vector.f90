!> Vectors of any length, changed in place: no temporary and no reallocation, with any compiler.
!>
!> An assignment to a whole allocatable array checks its shape at run time, and flang allocates memory for the
!> right-hand side if the right-hand side may overlap the left-hand side.
module ek_vector
   use ek_number, only: num
   implicit none(type, external)
   private
   public :: add_multiple, multiply

contains

   !> Computes y ← y + factor × x.
   pure subroutine add_multiple(n, factor, x, y)
      integer, intent(in) :: n
      real(num), intent(in) :: factor, x(n)
      real(num), intent(inout) :: y(n)
      integer :: k

      do k = 1, n
         y(k) = y(k) + factor*x(k)
      end do
   end subroutine add_multiple

   !> Computes y ← x y, component by component.
   pure subroutine multiply(n, x, y)
      integer, intent(in) :: n
      real(num), intent(in) :: x(n)
      real(num), intent(inout) :: y(n)
      integer :: k

      do k = 1, n
         y(k) = x(k)*y(k)
      end do
   end subroutine multiply

end module ek_vector
