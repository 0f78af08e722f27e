!> Explicit interfaces to the LAPACK routines in use, so that the compiler detects argument mistakes.
!>
!> Call them through ek_lapack, which disables floating-point traps inside the library.
module ek_lapack_routines
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: dsytrf, dsytrs, dsytrs2, dlacn2, dsysv, dsyev, dgesv, dgesvd, dpotrf

   interface
      !> Cholesky factorisation of a symmetric positive definite matrix; info = order of the first minor that is not.
      pure subroutine dpotrf(uplo, n, a, lda, info)
         import :: wp
         implicit none(type, external)
         character, intent(in) :: uplo
         integer, intent(in) :: n, lda
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: info
      end subroutine dpotrf

      !> Bunch–Kaufman factorisation of a symmetric indefinite matrix.
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

      !> Solution with the factors of dsytrf.
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

      !> The same in matrix products: quicker than dsytrs for several right-hand sides. The factors are as before on return.
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

      !> Estimate of the 1-norm of a matrix from its products, by reverse communication (N. J. Higham): as long as kase > 0 on
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

      !> Factor and solve in one call: the unit of the benchmark.
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

      !> Factor (LU, partial pivoting) and solve a general system.
      pure subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         implicit none(type, external)
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: ipiv(*)
         real(wp), intent(inout) :: b(ldb, *)
         integer, intent(out) :: info
      end subroutine dgesv

      !> Eigenvalues and eigenvectors of a symmetric matrix, ascending.
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

      !> Singular value decomposition.
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
   end interface

end module ek_lapack_routines
