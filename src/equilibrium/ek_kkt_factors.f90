!> Factors of the KKT matrix, and solutions with these factors.
!>
!> The KKT matrix S is scaled symmetrically, D S D, before factorisation; D is computed in ek_scale. Two ways to factorise D S D:
!>
!> - LAPACK (dsytrf) on the dense lower triangle: the reference;
!> - a plan of elimination (ek_plan) on the numbers that are not zero. Where the factors by plan are large or a pivot is zero,
!>   the same matrix is factorised by LAPACK.
module ek_kkt_factors
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_vector, only: multiply
   use ek_pattern, only: pattern_t
   use ek_plan_factors, only: soundness_t, gather_and_factorise, solve_by, substitute_several_by, several
   use ek_kkt_system, only: kkt_t, assembled, lapack_factors, plan_factors
   use ek_lapack, only: dsytrf, dsytrs2
   use ek_substitution, only: substitute
   implicit none(type, external)
   private
   public :: allocate_dense, factorise, factorise_within, factorise_by_lapack, solve, solve_many, count_inertia
   public :: max_growth, proven_growth

   real(wp), parameter :: max_growth = 1.0e4_wp     !! limit of factors by plan: the error of a solution is some 1e-16 × this
   real(wp), parameter :: vanished = 1.0e-30_wp     !! smallest to largest pivot: below it, the matrix is singular; a quotient could
                                                    !! overflow
   real(wp), parameter :: proven_growth = 100.0_wp  !! limit without correction of solutions: |S − L D Lᵀ| ≈ 1e-16 |S| growth²

contains

   !> Allocates work space for LAPACK.
   pure subroutine allocate_dense(kkt)
      type(kkt_t), intent(inout) :: kkt

      if (allocated(kkt%matrix)) return
      allocate (kkt%matrix(kkt%n, kkt%n), source=0.0_wp)
      allocate (kkt%pivots(kkt%n), source=0)
   end subroutine allocate_dense

   !> Scales the matrix, factorises it by plan or by LAPACK, and sets the inertia.
   !>
   !> A zero pivot sets is_singular; the caller obtains the cause from the diagnosis.
   !> Equations (K.5), (K.23) of docs/theory/kkt.md.
   pure subroutine factorise(kkt)
      type(kkt_t), intent(inout) :: kkt
      call factorise_within(max_growth, kkt)
   end subroutine factorise

   !> Factorises by plan if the factors do not grow beyond a limit; otherwise by LAPACK.
   pure subroutine factorise_within(limit, kkt)
      real(wp), intent(in) :: limit
      type(kkt_t), intent(inout) :: kkt
      type(soundness_t) :: soundness

      if (.not. kkt%has_plan) then
         call factorise_by_lapack(kkt)
         return
      end if
      if (are_checked) call require(kkt%stage == assembled, 'factorise: no matrix was assembled')
      call gather_and_factorise(kkt%pattern%entries, kkt%pattern%from, kkt%plan(kkt%way), kkt%store, kkt%scaling, kkt%planned, &
         soundness)
      if (.not. soundness%growth < limit) then
         kkt%fallbacks = kkt%fallbacks + 1
         call factorise_by_lapack(kkt)
         return
      end if
      kkt%stage = plan_factors
      kkt%factorisations = kkt%factorisations + 1
      kkt%negative = nint(soundness%negative)
      kkt%pivot_ratio = 0.0_wp
      if (soundness%most > 0.0_wp) kkt%pivot_ratio = soundness%least/soundness%most
      kkt%log_determinant = soundness%log_determinant
      kkt%is_singular = .not. kkt%pivot_ratio > 0.0_wp
   end subroutine factorise_within

   !> Scales the matrix, factorises it by LAPACK (Bunch–Kaufman, dsytrf), and sets the inertia.
   pure subroutine factorise_by_lapack(kkt)
      type(kkt_t), intent(inout) :: kkt
      integer :: info

      if (are_checked) call require(kkt%stage == assembled, 'factorise: no matrix was assembled')
      if (.not. allocated(kkt%matrix)) call allocate_dense(kkt)
      kkt%stage = lapack_factors
      kkt%factorisations = kkt%factorisations + 1
      call spread_lower(kkt%n, kkt%pattern, kkt%store, kkt%scaling, kkt%matrix)
      call dsytrf('L', kkt%n, kkt%matrix, kkt%n, kkt%pivots, kkt%work, size(kkt%work), info)
      call count_inertia(kkt%n, kkt%matrix, kkt%pivots, kkt%negative, kkt%pivot_ratio, kkt%log_determinant)
      kkt%is_singular = info /= 0 .or. .not. kkt%pivot_ratio > vanished
   end subroutine factorise_by_lapack

   !> Fills the lower triangle of the scaled matrix, D S D.
   pure subroutine spread_lower(n, pattern, store, scaling, matrix)
      integer, intent(in) :: n
      type(pattern_t), intent(in) :: pattern
      real(wp), intent(in) :: store(*), scaling(*)
      real(wp), intent(inout) :: matrix(n, n)
      integer :: k

      do k = 1, n
         matrix(k:n, k) = 0.0_wp
      end do
      do k = 1, pattern%entries
         matrix(pattern%row(k), pattern%column(k)) = store(pattern%from(k))*scaling(k)
      end do
   end subroutine spread_lower

   !> Counts the negative eigenvalues of the block-diagonal factor D of L D Lᵀ. Also finds the ratio of its smallest to its largest
   !> |eigenvalue|, and ln |det D|.
   !>
   !> By Sylvester's law the matrix has as many negative eigenvalues as D. A stable equilibrium has exactly one negative
   !> eigenvalue per constraint row.
   !> Equation (K.6) of docs/theory/kkt.md.
   pure subroutine count_inertia(n, matrix, pivots, negative, ratio, log_determinant)
      integer, intent(in) :: n
      real(wp), intent(in) :: matrix(n, n)
      integer, intent(in) :: pivots(n)
      integer, intent(out) :: negative
      real(wp), intent(out) :: ratio, log_determinant
      integer, parameter :: many = 8              ! blocks whose product neither overflows nor underflows
      real(wp) :: least, most, mean, radius, low, high, product
      integer :: k, blocks

      negative = 0
      least = huge(least)
      most = 0.0_wp
      log_determinant = 0.0_wp
      product = 1.0_wp
      blocks = 0
      k = 1
      do while (k <= n)
         if (pivots(k) > 0) then
            low = matrix(k, k)
            high = low
            if (low < 0.0_wp) negative = negative + 1
            product = product*low
            k = k + 1
         else
            mean = 0.5_wp*(matrix(k, k) + matrix(k + 1, k + 1))
            radius = sqrt((0.5_wp*(matrix(k, k) - matrix(k + 1, k + 1)))**2 + matrix(k + 1, k)**2)
            low = mean - radius
            high = mean + radius
            if (low < 0.0_wp) negative = negative + 1
            if (high < 0.0_wp) negative = negative + 1
            product = product*low*high
            k = k + 2
         end if
         least = min(least, abs(low), abs(high))
         most = max(most, abs(low), abs(high))
         blocks = blocks + 1
         if (mod(blocks, many) == 0 .or. k > n) then
            log_determinant = log_determinant + log(max(abs(product), tiny(product)))
            product = 1.0_wp
         end if
      end do
      ratio = 0.0_wp
      if (most > 0.0_wp) ratio = least/most
   end subroutine count_inertia

   !> Solves with the last factors. On return, kkt%rhs is [Δq; Δλ]. The caller checks kkt%is_singular: a zero pivot is divided by.
   !> Equation (K.5) of docs/theory/kkt.md.
   pure subroutine solve(kkt)
      type(kkt_t), intent(inout) :: kkt

      if (are_checked) call require(kkt%stage >= lapack_factors, 'solve: the matrix is not factorised')
      if (are_checked) call require(.not. kkt%is_singular, 'solve: the matrix is singular')
      kkt%is_at_design = .false.
      kkt%solutions = kkt%solutions + 1
      if (kkt%stage == plan_factors) then
         call solve_by(kkt%plan(kkt%way), kkt%planned, kkt%scale, kkt%rhs)
         return
      end if
      call multiply(kkt%n, kkt%scale, kkt%rhs)
      call substitute(kkt%n, kkt%matrix, kkt%pivots, kkt%rhs)
      call multiply(kkt%n, kkt%scale, kkt%rhs)
   end subroutine solve

   !> Solves for many right-hand sides with the last factors. The caller checks kkt%is_singular.
   !> Equation (K.5) of docs/theory/kkt.md.
   subroutine solve_many(kkt, many, columns)
      type(kkt_t), intent(inout) :: kkt
      integer, intent(in) :: many
      real(wp), intent(inout) :: columns(kkt%n, many)      !! (unknown, right-hand side)
      integer :: j, k, last, info

      if (are_checked) call require(kkt%stage >= lapack_factors, 'solve_many: the matrix is not factorised')
      if (are_checked) call require(.not. kkt%is_singular, 'solve_many: the matrix is singular')
      if (kkt%stage == plan_factors) then
         if (.not. allocated(kkt%turned)) allocate (kkt%turned(several, kkt%n), source=0.0_wp)
         do j = 0, many - 1, several
            last = min(several, many - j)
            do k = 1, kkt%n
               kkt%turned(:last, k) = columns(k, j + 1:j + last)*kkt%scale(k)
               kkt%turned(last + 1:, k) = 0.0_wp
            end do
            call substitute_several_by(kkt%plan(kkt%way), kkt%planned, kkt%turned)
            do k = 1, kkt%n
               columns(k, j + 1:j + last) = kkt%turned(:last, k)*kkt%scale(k)
            end do
         end do
         return
      end if
      do j = 1, many
         columns(:, j) = columns(:, j)*kkt%scale
      end do
      call dsytrs2('L', kkt%n, many, kkt%matrix, kkt%n, kkt%pivots, columns, kkt%n, kkt%work, info)
      do j = 1, many
         columns(:, j) = columns(:, j)*kkt%scale
      end do
   end subroutine solve_many

end module ek_kkt_factors
