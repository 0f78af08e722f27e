!> Laws of the routines of LAPACK in liblapack.a, at order 60: solutions satisfy their equations, eigenvalues have the trace and
!> the norm of the matrix, singular values of a symmetric matrix are the absolute eigenvalues. Status 1 if one is violated.
program linear_algebra
   implicit none(type, external)
   external :: dsysv, dsyev, dgesvd, dgesv, dpotrf, dgemm
   integer, parameter :: wp = kind(1.0d0), n = 60
   real(wp), parameter :: limit = 1e-12_wp      ! some 60 roundings of numbers of size 60
   real(wp) :: a(n, n), b(n), x(n), work(64*n), values(n), singular(n), none(1, 1), copy(n, n), other(n, n)
   integer :: pivots(n), info, i, j, seed, failures

   failures = 0
   seed = 12345
   do j = 1, n
      do i = 1, j
         seed = mod(seed*16807, 2147483647)
         a(i, j) = real(iand(seed, 65535), wp)/65536 - 0.5_wp
         a(j, i) = a(i, j)
      end do
   end do
   b = 1

   copy = a
   x = b
   call dsysv('U', n, 1, copy, n, pivots, x, n, work, size(work), info)
   call expect('symmetric system', maxval(abs(matmul(a, x) - b))/maxval(abs(x)))
   copy = a
   x = b
   call dgesv(n, 1, copy, n, pivots, x, n, info)
   call expect('system', maxval(abs(matmul(a, x) - b))/maxval(abs(x)))
   copy = a
   call dsyev('N', 'U', n, copy, n, values, work, size(work), info)
   call expect('sum of eigenvalues', abs(sum(values) - sum([(a(i, i), i=1, n)])))
   call expect('norm of eigenvalues', abs(norm2(values) - norm2(a)))
   copy = a
   call dgesvd('N', 'N', n, n, copy, n, singular, none, 1, none, 1, work, size(work), info)
   call expect('largest singular value', abs(singular(1) - maxval(abs(values))))
   call expect('smallest singular value', abs(singular(n) - minval(abs(values))))
   call dgemm('N', 'T', n, n, n, 1.0_wp, a, n, a, n, 0.0_wp, copy, n)
   call expect('product', maxval(abs(copy - matmul(a, transpose(a)))))
   other = copy
   call dpotrf('L', n, other, n, info)
   do j = 2, n
      other(:j - 1, j) = 0
   end do
   call expect('factor', maxval(abs(matmul(other, transpose(other)) - copy)))
   if (failures > 0) error stop 1, quiet=.true.

contains

   subroutine expect(name, difference)
      character(*), intent(in) :: name
      real(wp), intent(in) :: difference

      print '(a,es9.1)', name, difference
      if (info == 0 .and. difference < limit) return
      print '(3a,i0)', name, ': too large', ', info ', info
      failures = failures + 1
   end subroutine expect

end program linear_algebra
