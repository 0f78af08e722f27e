!> The linear system of an increment: assembly, and factorisation by LAPACK or by a plan of elimination.
!>
!> Parts and assembly of the system: ek_kkt_system. Factors and solutions: ek_kkt_factors. Plans: ek_kkt_plans.
!> This module creates the system of a model, and re-exports the procedures for callers.
module ek_kkt
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t
   use ek_load, only: wrench
   use ek_pattern, only: new_pattern, same_pattern, whole_tangent, material_only, residual_only
   use ek_kkt_system, only: kkt_t, assemble, assemble_rows, assemble_gradients, assemble_rate, release, holds, load_factor, &
      whole_matrix, nothing, held, lapack_factors, plan_factors
   use ek_kkt_factors, only: allocate_dense, factorise, factorise_within, proven_growth, factorise_by_lapack, solve, &
      solve_many, count_inertia, max_growth
   use ek_kkt_plans, only: make_plans
   use ek_scale, only: characteristic, scale_factors
   use ek_lapack, only: dlacn2
   use ek_substitution, only: substitute
   use ek_plan_factors, only: substitute_by
   implicit none(type, external)
   private
   public :: kkt_t, new_kkt, renew_kkt, copy_scales, assemble, assemble_rows, assemble_gradients, assemble_rate, release, &
      factorise, factorise_by_lapack, solve, solve_many, condition, holds, whole_matrix, count_inertia
   public :: whole_tangent, material_only, residual_only, nothing, lapack_factors, wrench, load_factor, max_growth

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
      allocate (kkt%gradients(12, size(suspension%terms)), kkt%imbalance(kkt%nq), source=0.0_wp)
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

end module ek_kkt
