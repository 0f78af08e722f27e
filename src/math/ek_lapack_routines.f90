!> Explicit interfaces to the LAPACK and BLAS routines in use, so that the compiler detects wrong arguments.
!>
!> Call them through ek_lapack, which disables floating-point traps inside the library.
module ek_lapack_routines
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: dsytrf, dsytrs, dsytrs2, dlacn2, dsysv, dsyev, dgesv, dgetrf, dgetrs, dgesvd, dgelsd, dpotrf, dgemm

   interface
      !> Computes c ← alpha op(a) op(b) + beta c, where op(a) has m rows and k columns; op is 'N' for the matrix itself, 'T' for its
      !> transpose.
      pure subroutine dgemm(transa, transb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc)
         import :: wp
         implicit none(type, external)
         character, intent(in) :: transa, transb
         integer, intent(in) :: m, n, k, lda, ldb, ldc
         real(wp), intent(in) :: alpha, beta
         real(wp), intent(in) :: a(lda, *), b(ldb, *)
         real(wp), intent(inout) :: c(ldc, *)
      end subroutine dgemm

      !> Factorises a symmetric positive definite matrix by Cholesky's method. info is the order of the first minor that is not
      !> positive, or 0.
      pure subroutine dpotrf(uplo, n, a, lda, info)
         import :: wp
         implicit none(type, external)
         character, intent(in) :: uplo
         integer, intent(in) :: n, lda
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: info
      end subroutine dpotrf

      !> Factorises a symmetric indefinite matrix by Bunch and Kaufman's method.
      pure subroutine dsytrf(uplo, n, a, lda, ipiv, work, lwork, info)
         import :: wp
         implicit none(type, external)
         character, intent(in) :: uplo
         integer, intent(in) :: n, lda, lwork
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: ipiv(*)
         real(wp), intent(out) :: work(*)
         integer, intent(out) :: info
      end subroutine dsytrf

      !> Solves with the factors of dsytrf.
      pure subroutine dsytrs(uplo, n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         implicit none(type, external)
         character, intent(in) :: uplo
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(in) :: a(lda, *)
         integer, intent(in) :: ipiv(*)
         real(wp), intent(inout) :: b(ldb, *)
         integer, intent(out) :: info
      end subroutine dsytrs

      !> Solves as dsytrs does, but with matrix products, which is faster for several right-hand sides. On return, the factors are
      !> unchanged.
      pure subroutine dsytrs2(uplo, n, nrhs, a, lda, ipiv, b, ldb, work, info)
         import :: wp
         implicit none(type, external)
         character, intent(in) :: uplo
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(in) :: ipiv(*)
         real(wp), intent(inout) :: b(ldb, *)
         real(wp), intent(out) :: work(*)          !! n
         integer, intent(out) :: info
      end subroutine dsytrs2

      !> Estimates the 1-norm of a matrix from its products, by reverse communication (N. J. Higham): as long as kase > 0 on
      !> return, the caller multiplies x by the matrix (kase 1) or its transpose (2) and calls again; the first call has kase = 0.
      pure subroutine dlacn2(n, v, x, isgn, est, kase, isave)
         import :: wp
         implicit none(type, external)
         integer, intent(in) :: n
         real(wp), intent(inout) :: v(n), x(n)
         integer, intent(inout) :: isgn(n)
         real(wp), intent(inout) :: est            !! the estimate, never above the norm, if kase = 0 on return
         integer, intent(inout) :: kase
         integer, intent(inout) :: isave(3)
      end subroutine dlacn2

      !> Factorises a symmetric indefinite matrix and solves in one call. The time of this routine is the unit of the benchmark.
      pure subroutine dsysv(uplo, n, nrhs, a, lda, ipiv, b, ldb, work, lwork, info)
         import :: wp
         implicit none(type, external)
         character, intent(in) :: uplo
         integer, intent(in) :: n, nrhs, lda, ldb, lwork
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: ipiv(*)
         real(wp), intent(inout) :: b(ldb, *)
         real(wp), intent(out) :: work(*)
         integer, intent(out) :: info
      end subroutine dsysv

      !> Factorises (LU, partial pivoting) and solves a general system.
      pure subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         implicit none(type, external)
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: ipiv(*)
         real(wp), intent(inout) :: b(ldb, *)
         integer, intent(out) :: info
      end subroutine dgesv

      !> Factorises by LU with partial pivoting. info > 0 if a pivot is zero.
      pure subroutine dgetrf(m, n, a, lda, ipiv, info)
         import :: wp
         implicit none(type, external)
         integer, intent(in) :: m, n, lda
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: ipiv(*)
         integer, intent(out) :: info
      end subroutine dgetrf

      !> Solves with the factors of dgetrf. With trans = 'T', solves with the transpose of the matrix.
      pure subroutine dgetrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         implicit none(type, external)
         character, intent(in) :: trans
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(in) :: a(lda, *)
         integer, intent(in) :: ipiv(*)
         real(wp), intent(inout) :: b(ldb, *)
         integer, intent(out) :: info
      end subroutine dgetrs

      !> Finds the eigenvalues of a symmetric matrix in ascending order, and the eigenvectors.
      pure subroutine dsyev(jobz, uplo, n, a, lda, w, work, lwork, info)
         import :: wp
         implicit none(type, external)
         character, intent(in) :: jobz, uplo
         integer, intent(in) :: n, lda, lwork
         real(wp), intent(inout) :: a(lda, *)
         real(wp), intent(out) :: w(*)
         real(wp), intent(out) :: work(*)
         integer, intent(out) :: info
      end subroutine dsyev

      !> Computes the singular value decomposition of a matrix.
      pure subroutine dgesvd(jobu, jobvt, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, info)
         import :: wp
         implicit none(type, external)
         character, intent(in) :: jobu, jobvt
         integer, intent(in) :: m, n, lda, ldu, ldvt, lwork
         real(wp), intent(inout) :: a(lda, *)
         real(wp), intent(out) :: s(*), u(ldu, *), vt(ldvt, *)
         real(wp), intent(out) :: work(*)
         integer, intent(out) :: info
      end subroutine dgesvd

      !> Solves a least-squares problem for the solution of minimum norm, by singular values. Singular values below rcond times the
      !> largest count as zero.
      pure subroutine dgelsd(m, n, nrhs, a, lda, b, ldb, s, rcond, rank, work, lwork, iwork, info)
         import :: wp
         implicit none(type, external)
         integer, intent(in) :: m, n, nrhs, lda, ldb, lwork
         real(wp), intent(inout) :: a(lda, *)
         real(wp), intent(inout) :: b(ldb, *)      !! max(m, n) rows: right-hand sides, then solutions
         real(wp), intent(out) :: s(*)
         real(wp), intent(in) :: rcond
         integer, intent(out) :: rank
         real(wp), intent(out) :: work(*)
         integer, intent(out) :: iwork(*)
         integer, intent(out) :: info
      end subroutine dgelsd
   end interface

end module ek_lapack_routines
