!> The LAPACK and BLAS routines in use, with floating-point traps restricted to our own code.
!>
!> In a build that traps invalid operations (EK_TRAPS, the debug preset) each routine is wrapped so that no trap is active
!> inside the library. Vector kernels also compute on unused lanes: the SSE3 dsymv of OpenBLAS, its fallback for unknown
!> processors, raises SIGFPE on valid numbers. In other builds the names refer to the routines directly, at no cost.
!>
!> A wrapper changes the halting modes, which are restored on return (Fortran 2018, 17.6). Flags raised by the library are
!> cleared first, as they would otherwise trap when the modes are restored. Each wrapper names the module of exceptions itself:
!> gfortran restores the modes of a procedure only if the procedure, not its module, uses that module.
module ek_lapack
#ifdef EK_TRAPS
   use ek_kinds, only: wp
   use ek_lapack_routines, only: lapack_dsytrf => dsytrf, lapack_dsytrs => dsytrs, lapack_dsytrs2 => dsytrs2, &
      lapack_dlacn2 => dlacn2, lapack_dsysv => dsysv, lapack_dgesv => dgesv, lapack_dsyev => dsyev, lapack_dgesvd => dgesvd, &
      lapack_dgelsd => dgelsd, lapack_dpotrf => dpotrf, lapack_dgetrf => dgetrf, lapack_dgetrs => dgetrs, &
      lapack_dgemm => dgemm
#else
   use ek_lapack_routines, only: dsytrf, dsytrs, dsytrs2, dlacn2, dsysv, dgesv, dsyev, dgesvd, dgelsd, dpotrf, dgetrf, dgetrs, &
      dgemm
#endif
   implicit none(type, external)
   private
   public :: dsytrf, dsytrs, dsytrs2, dlacn2, dsysv, dgesv, dsyev, dgesvd, dgelsd, dpotrf, dgetrf, dgetrs, dgemm

#ifdef EK_TRAPS
contains

   ! what each does, and its arguments: see ek_lapack_routines

   pure subroutine dgemm(transa, transb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc)
      use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_set_flag, ieee_usual
      character, intent(in) :: transa, transb
      integer, intent(in) :: m, n, k, lda, ldb, ldc
      real(wp), intent(in) :: alpha, beta
      real(wp), intent(in) :: a(lda, *), b(ldb, *)
      real(wp), intent(inout) :: c(ldc, *)

      call ieee_set_halting_mode(ieee_usual, .false.)
      call lapack_dgemm(transa, transb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc)
      call ieee_set_flag(ieee_usual, .false.)
   end subroutine dgemm

   pure subroutine dpotrf(uplo, n, a, lda, info)
      use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_set_flag, ieee_usual
      character, intent(in) :: uplo
      integer, intent(in) :: n, lda
      real(wp), intent(inout) :: a(lda, *)
      integer, intent(out) :: info

      call ieee_set_halting_mode(ieee_usual, .false.)
      call lapack_dpotrf(uplo, n, a, lda, info)
      call ieee_set_flag(ieee_usual, .false.)
   end subroutine dpotrf

   pure subroutine dsytrf(uplo, n, a, lda, ipiv, work, lwork, info)
      use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_set_flag, ieee_usual
      character, intent(in) :: uplo
      integer, intent(in) :: n, lda, lwork
      real(wp), intent(inout) :: a(lda, *)
      integer, intent(out) :: ipiv(*)
      real(wp), intent(out) :: work(*)
      integer, intent(out) :: info

      call ieee_set_halting_mode(ieee_usual, .false.)
      call lapack_dsytrf(uplo, n, a, lda, ipiv, work, lwork, info)
      call ieee_set_flag(ieee_usual, .false.)
   end subroutine dsytrf

   pure subroutine dsytrs(uplo, n, nrhs, a, lda, ipiv, b, ldb, info)
      use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_set_flag, ieee_usual
      character, intent(in) :: uplo
      integer, intent(in) :: n, nrhs, lda, ldb
      real(wp), intent(in) :: a(lda, *)
      integer, intent(in) :: ipiv(*)
      real(wp), intent(inout) :: b(ldb, *)
      integer, intent(out) :: info

      call ieee_set_halting_mode(ieee_usual, .false.)
      call lapack_dsytrs(uplo, n, nrhs, a, lda, ipiv, b, ldb, info)
      call ieee_set_flag(ieee_usual, .false.)
   end subroutine dsytrs

   pure subroutine dsytrs2(uplo, n, nrhs, a, lda, ipiv, b, ldb, work, info)
      use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_set_flag, ieee_usual
      character, intent(in) :: uplo
      integer, intent(in) :: n, nrhs, lda, ldb
      real(wp), intent(inout) :: a(lda, *)
      integer, intent(in) :: ipiv(*)
      real(wp), intent(inout) :: b(ldb, *)
      real(wp), intent(out) :: work(*)
      integer, intent(out) :: info

      call ieee_set_halting_mode(ieee_usual, .false.)
      call lapack_dsytrs2(uplo, n, nrhs, a, lda, ipiv, b, ldb, work, info)
      call ieee_set_flag(ieee_usual, .false.)
   end subroutine dsytrs2

   pure subroutine dlacn2(n, v, x, isgn, est, kase, isave)
      use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_set_flag, ieee_usual
      integer, intent(in) :: n
      real(wp), intent(inout) :: v(n), x(n)
      integer, intent(inout) :: isgn(n)
      real(wp), intent(inout) :: est
      integer, intent(inout) :: kase
      integer, intent(inout) :: isave(3)

      call ieee_set_halting_mode(ieee_usual, .false.)
      call lapack_dlacn2(n, v, x, isgn, est, kase, isave)
      call ieee_set_flag(ieee_usual, .false.)
   end subroutine dlacn2

   pure subroutine dsysv(uplo, n, nrhs, a, lda, ipiv, b, ldb, work, lwork, info)
      use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_set_flag, ieee_usual
      character, intent(in) :: uplo
      integer, intent(in) :: n, nrhs, lda, ldb, lwork
      real(wp), intent(inout) :: a(lda, *)
      integer, intent(out) :: ipiv(*)
      real(wp), intent(inout) :: b(ldb, *)
      real(wp), intent(out) :: work(*)
      integer, intent(out) :: info

      call ieee_set_halting_mode(ieee_usual, .false.)
      call lapack_dsysv(uplo, n, nrhs, a, lda, ipiv, b, ldb, work, lwork, info)
      call ieee_set_flag(ieee_usual, .false.)
   end subroutine dsysv

   pure subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
      use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_set_flag, ieee_usual
      integer, intent(in) :: n, nrhs, lda, ldb
      real(wp), intent(inout) :: a(lda, *)
      integer, intent(out) :: ipiv(*)
      real(wp), intent(inout) :: b(ldb, *)
      integer, intent(out) :: info

      call ieee_set_halting_mode(ieee_usual, .false.)
      call lapack_dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
      call ieee_set_flag(ieee_usual, .false.)
   end subroutine dgesv

   pure subroutine dgetrf(m, n, a, lda, ipiv, info)
      use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_set_flag, ieee_usual
      integer, intent(in) :: m, n, lda
      real(wp), intent(inout) :: a(lda, *)
      integer, intent(out) :: ipiv(*)
      integer, intent(out) :: info

      call ieee_set_halting_mode(ieee_usual, .false.)
      call lapack_dgetrf(m, n, a, lda, ipiv, info)
      call ieee_set_flag(ieee_usual, .false.)
   end subroutine dgetrf

   pure subroutine dgetrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
      use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_set_flag, ieee_usual
      character, intent(in) :: trans
      integer, intent(in) :: n, nrhs, lda, ldb
      real(wp), intent(in) :: a(lda, *)
      integer, intent(in) :: ipiv(*)
      real(wp), intent(inout) :: b(ldb, *)
      integer, intent(out) :: info

      call ieee_set_halting_mode(ieee_usual, .false.)
      call lapack_dgetrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
      call ieee_set_flag(ieee_usual, .false.)
   end subroutine dgetrs

   pure subroutine dsyev(jobz, uplo, n, a, lda, w, work, lwork, info)
      use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_set_flag, ieee_usual
      character, intent(in) :: jobz, uplo
      integer, intent(in) :: n, lda, lwork
      real(wp), intent(inout) :: a(lda, *)
      real(wp), intent(out) :: w(*)
      real(wp), intent(out) :: work(*)
      integer, intent(out) :: info

      call ieee_set_halting_mode(ieee_usual, .false.)
      call lapack_dsyev(jobz, uplo, n, a, lda, w, work, lwork, info)
      call ieee_set_flag(ieee_usual, .false.)
   end subroutine dsyev

   pure subroutine dgesvd(jobu, jobvt, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, info)
      use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_set_flag, ieee_usual
      character, intent(in) :: jobu, jobvt
      integer, intent(in) :: m, n, lda, ldu, ldvt, lwork
      real(wp), intent(inout) :: a(lda, *)
      real(wp), intent(out) :: s(*), u(ldu, *), vt(ldvt, *)
      real(wp), intent(out) :: work(*)
      integer, intent(out) :: info

      call ieee_set_halting_mode(ieee_usual, .false.)
      call lapack_dgesvd(jobu, jobvt, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, info)
      call ieee_set_flag(ieee_usual, .false.)
   end subroutine dgesvd

   pure subroutine dgelsd(m, n, nrhs, a, lda, b, ldb, s, rcond, rank, work, lwork, iwork, info)
      use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_set_flag, ieee_usual
      integer, intent(in) :: m, n, nrhs, lda, ldb, lwork
      real(wp), intent(inout) :: a(lda, *), b(ldb, *)
      real(wp), intent(out) :: s(*)
      real(wp), intent(in) :: rcond
      integer, intent(out) :: rank
      real(wp), intent(out) :: work(*)
      integer, intent(out) :: iwork(*)
      integer, intent(out) :: info

      call ieee_set_halting_mode(ieee_usual, .false.)
      call lapack_dgelsd(m, n, nrhs, a, lda, b, ldb, s, rcond, rank, work, lwork, iwork, info)
      call ieee_set_flag(ieee_usual, .false.)
   end subroutine dgelsd
#endif

end module ek_lapack
