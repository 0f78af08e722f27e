!> The linear system of an increment: assembly, and factorisation by LAPACK or by a plan of elimination.
!>
!> Parts and assembly of the system: ek_kkt_system, whose procedures are re-exported for callers. A system has two plans of
!> elimination: for the matrix of an increment, and for the matrix with the rig's rows released.
!>
!> The KKT matrix S is scaled symmetrically, D S D, before factorisation; D is computed in ek_scale. Two ways to factorise D S D:
!>
!> - LAPACK (dsytrf) on the dense lower triangle: the reference;
!> - a plan of elimination (ek_plan) on the numbers that are not zero. Where the factors by plan are large or a pivot is zero,
!>   the same matrix is factorised by LAPACK.
module ek_kkt
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t, design_state, move_as_screw
   use ek_load, only: wrench
   use ek_pattern, only: new_pattern, same_pattern, whole_tangent, material_only, residual_only, pattern_t
   use ek_kkt_system, only: kkt_t, assemble, assemble_rows, assemble_gradients, assemble_rate, release, holds, load_factor, &
      whole_matrix, nothing, held, lapack_factors, plan_factors, released, assembled
   use ek_scale, only: characteristic, scale_factors
   use ek_lapack, only: dlacn2, dsytrf, dsytrs2
   use ek_substitution, only: substitute
   use ek_plan_factors, only: substitute_by, soundness_t, gather_and_factorise, solve_by, substitute_several_by, several
   use ek_plan, only: new_plan
   use ek_contract, only: are_checked, require
   use ek_vector, only: multiply
   implicit none(type, external)
   private
   public :: kkt_t, new_kkt, renew_kkt, copy_scales, assemble, assemble_rows, assemble_gradients, assemble_rate, release, &
      factorise, factorise_by_lapack, solve, solve_many, condition, holds, whole_matrix, count_inertia, whole_tangent, &
      material_only, residual_only, nothing, lapack_factors, wrench, load_factor, max_growth

   real(wp), parameter :: max_growth = 1.0e4_wp     !! limit of factors by plan: the error of a solution is some 1e-16 × this
   real(wp), parameter :: vanished = 1.0e-30_wp     !! smallest to largest pivot: below it, the matrix is singular; a quotient could
                                                    !! overflow
   real(wp), parameter :: proven_growth = 100.0_wp  !! limit without correction of solutions: |S − L D Lᵀ| ≈ 1e-16 |S| growth²

contains

   !> Creates the work space for a model, with its scales.
   function new_kkt(suspension, wants_plan) result(kkt)
      type(suspension_t), intent(in) :: suspension
      logical, intent(in), optional :: wants_plan    !! factorise by plan; otherwise by LAPACK
      type(kkt_t) :: kkt

      if (present(wants_plan)) kkt%has_plan = wants_plan
      kkt%pattern = new_pattern(suspension)
      kkt%nq = kkt%pattern%nq
      kkt%nc = kkt%pattern%nc
      kkt%n = kkt%pattern%n
      allocate (kkt%store(kkt%pattern%stored), kkt%scaling(kkt%pattern%entries), source=0.0_wp)
      allocate (kkt%rhs(kkt%n), kkt%scale(kkt%n), kkt%values(kkt%nc), source=0.0_wp)
      allocate (kkt%factor(size(suspension%loads)), kkt%change(kkt%nc), source=0.0_wp)
      allocate (kkt%gradients(12, size(suspension%terms)), kkt%imbalance(kkt%n), source=0.0_wp)
      allocate (kkt%iwork(kkt%n), source=0)
      allocate (kkt%work(64*max(kkt%n, 1)), source=0.0_wp)   ! 64 is LAPACK's block size of dsytrf
      call set_scales(suspension, kkt)
      if (kkt%has_plan) then
         call make_plans(suspension, kkt)
      else
         call allocate_dense(kkt)
      end if
   end function new_kkt

   !> Renews the work space for the next design of a model. The parts that depend on the connections, including the plans, are
   !> unchanged, and nothing is allocated. For a model with other connections, or an empty kkt, the work space is created again.
   subroutine renew_kkt(suspension, wants_plan, kkt, keeps_scales)
      type(suspension_t), intent(in) :: suspension
      logical, intent(in) :: wants_plan
      type(kkt_t), intent(inout) :: kkt
      logical, intent(in), optional :: keeps_scales        !! .true.: keeps length, stiffness and scales of a design close to this one
      logical :: is_same, has_scales

      is_same = allocated(kkt%store) .and. (kkt%has_plan .eqv. wants_plan)
      if (is_same) is_same = same_pattern(kkt%pattern, suspension) .and. size(kkt%factor) == size(suspension%loads)
      if (.not. is_same) then
         kkt = new_kkt(suspension, wants_plan)
         return
      end if
      has_scales = .false.
      if (present(keeps_scales)) has_scales = keeps_scales
      if (.not. has_scales) call set_scales(suspension, kkt)
      kkt%imbalance(:) = 0.0_wp
      kkt%norm = 0.0_wp
      kkt%factorisations = 0
      kkt%fallbacks = 0
      kkt%way = held
      kkt%negative = 0
      kkt%pivot_ratio = 1.0_wp
      kkt%log_determinant = 0.0_wp
      kkt%is_singular = .false.
      kkt%stage = nothing
      kkt%is_at_design = .false.
   end subroutine renew_kkt

   !> Sets the characteristic length and stiffness, and the scale of every entry.
   subroutine set_scales(suspension, kkt)
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(inout) :: kkt
      integer :: k

      call characteristic(suspension, kkt%length, kkt%stiffness)
      call scale_factors(suspension, kkt%length, kkt%stiffness, kkt%scale)
      do k = 1, kkt%pattern%entries
         kkt%scaling(k) = kkt%scale(kkt%pattern%row(k))*kkt%scale(kkt%pattern%column(k))
      end do
   end subroutine set_scales

   !> Copies the scales of a system of the same model.
   pure subroutine copy_scales(from, kkt)
      type(kkt_t), intent(in) :: from
      type(kkt_t), intent(inout) :: kkt

      kkt%length = from%length
      kkt%stiffness = from%stiffness
      kkt%scale(:) = from%scale
      kkt%scaling(:) = from%scaling
   end subroutine copy_scales

   !> Estimates the reciprocal condition number of the scaled matrix at a state (as LAPACK's dsycon). The matrix is factorised by
   !> plan if the factors are small enough to give the estimate for the original matrix; otherwise by LAPACK.
   pure subroutine condition(suspension, state, inputs, kkt, rcond)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(inout) :: kkt
      real(wp), intent(out) :: rcond             !! 0: singular; 1: unit matrix
      real(wp) :: inverse, entry
      integer :: k, kase, kept(3)

      call assemble(suspension, state, inputs, whole_tangent, kkt)
      kkt%work(:kkt%n) = 0.0_wp
      associate (pattern => kkt%pattern)
         do k = 1, pattern%entries
            entry = abs(kkt%store(pattern%from(k))*kkt%scaling(k))
            kkt%work(pattern%column(k)) = kkt%work(pattern%column(k)) + entry
            if (pattern%row(k) /= pattern%column(k)) kkt%work(pattern%row(k)) = kkt%work(pattern%row(k)) + entry
         end do
      end associate
      kkt%norm = 0.0_wp
      if (kkt%n > 0) kkt%norm = maxval(kkt%work(:kkt%n))
      call factorise_within(proven_growth, kkt)
      rcond = merge(1.0_wp, 0.0_wp, kkt%n == 0)
      if (kkt%is_singular .or. kkt%n == 0) return
      inverse = 0.0_wp
      kase = 0
      do
         call dlacn2(kkt%n, kkt%work(kkt%n + 1:2*kkt%n), kkt%work(:kkt%n), kkt%iwork, inverse, kase, kept)
         if (kase == 0) exit
         if (kkt%stage == plan_factors) then     ! the matrix is symmetric
            call substitute_by(kkt%plan(kkt%way), kkt%planned, kkt%work(:kkt%n))
         else
            call substitute(kkt%n, kkt%matrix, kkt%pivots, kkt%work(:kkt%n))
         end if
      end do
      if (inverse > 0.0_wp) rcond = (1.0_wp/inverse)/kkt%norm
   end subroutine condition

   !> Finds the plans from matrices at three states: design, and two states in which every body is moved and every reaction acts, so
   !> that no entry is small by chance. The order depends on the entries of these matrices, never on a state that is solved.
   subroutine make_plans(suspension, kkt)
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(inout) :: kkt
      integer, parameter :: samples = 3
      real(wp) :: values(samples, kkt%pattern%entries)
      type(state_t) :: state
      integer :: way, s, k

      do way = held, released
         do s = 1, samples
            state = design_state(suspension)
            if (s > 1) call displace(state, s - 1, 0.05_wp*kkt%length, 0.1_wp, 0.02_wp*kkt%stiffness*kkt%length)
            call assemble(suspension, state, inputs_t(), whole_tangent, kkt)
            if (way == released) then
               do k = suspension%own_rows() + 1, suspension%constraints()
                  call release(k, kkt)
               end do
            end if
            values(s, :) = kkt%store(kkt%pattern%from)*kkt%scaling
         end do
         call new_plan(kkt%n, kkt%pattern%row, kkt%pattern%column, values, kkt%plan(way))
      end do
      allocate (kkt%planned(maxval(kkt%plan%length)), source=0.0_wp)
      kkt%stage = nothing
   end subroutine make_plans

   !> Moves every body and sets every reaction. The sizes are distance, angle and force times numbers between −1 and 1, which are
   !> equal in every run.
   pure subroutine displace(state, number, distance, angle, force)
      type(state_t), intent(inout) :: state
      integer, intent(in) :: number              !! index of the sequence of numbers
      real(wp), intent(in) :: distance, angle, force   !! m, rad, N
      real(wp) :: step(6*(size(state%poses) - 1))
      real(wp), parameter :: golden = 0.6180339887498949_wp
      integer :: k

      step = [(2.0_wp*modulo(golden*k*(2*number - 1) + 0.3_wp*number, 1.0_wp) - 1.0_wp, k=1, size(step))]
      do k = 0, size(step) - 6, 6
         step(k + 1:k + 3) = distance*step(k + 1:k + 3)
         step(k + 4:k + 6) = angle*step(k + 4:k + 6)
      end do
      call move_as_screw(state, step)
      state%reaction(:) = [(force*(2.0_wp*modulo(golden*k*(2*number + 1) + 0.7_wp, 1.0_wp) - 1.0_wp), k=1, size(state%reaction))]
   end subroutine displace

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

end module ek_kkt
