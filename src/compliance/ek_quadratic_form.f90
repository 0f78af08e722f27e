!> Quadratic forms of a matrix in the store of ek_pattern.
module ek_quadratic_form
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: quadratic_form

contains

   !> The product X K Xᵀ for a symmetric matrix K, given by the entries of its lower triangle. From explicit shapes the compiler
   !> generates tight code.
   pure function quadratic_form(entries, row, column, from, store, many, n, x) result(form)
      integer, intent(in) :: entries, many, n
      integer, intent(in) :: row(entries), column(entries), from(entries)     !! from: positions in the store
      real(wp), intent(in) :: store(*), x(many, n)
      real(wp) :: form(many, many), y(many, n)
      integer :: e, j, k

      y = 0.0_wp
      do e = 1, entries
         y(:, row(e)) = y(:, row(e)) + store(from(e))*x(:, column(e))
         if (row(e) /= column(e)) y(:, column(e)) = y(:, column(e)) + store(from(e))*x(:, row(e))
      end do
      form = 0.0_wp
      do k = 1, n
         do j = 1, many
            form(:, j) = form(:, j) + x(j, k)*y(:, k)
         end do
      end do
   end function quadratic_form

end module ek_quadratic_form
