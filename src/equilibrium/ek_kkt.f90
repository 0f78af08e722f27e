!> The dense linear system of an increment: assembly, and factorisation by LAPACK.
!>
!>     [ T  Φqᵀ ] [Δq]   [ f_ext − f_el − Φqᵀλ ]
!>     [ Φq −C  ] [Δλ] = [ c − Φ(q) + Cλ       ]           one step of Newton's method for f_ext = f_el + Φqᵀλ, Φ = c
!>
!> C is zero except for drivers with a stiffness k: 1/k on the diagonal, Φ = c + λ/k. With C ≥ 0 a stable equilibrium still
!> has exactly one negative eigenvalue per row.
!> T is the Hessian of the energy along screw motions (see `move_as_screw` in ek_state): the increment of a
!> body is then independent of its reference point.
!> Unknowns: 6 per body [Δr Δπ], then the rows of Φ. Only the lower triangle is stored. The matrix S is
!> scaled symmetrically, D S D, before factorisation; D is computed in ek_scale.
!> Equations (K.2), (K.3) of docs/theory/kkt.md.
module ek_kkt
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_measure, only: evaluation_t, evaluate, add_measure_hessian
   use ek_relative_rotation, only: pose_t
   use ek_block, only: add_block, add_gradient, add_s_block, rotated
   use ek_element_force, only: element_evaluation_t, evaluate_element, add_element_tangent
   use ek_rotation, only: cross, skew
   use ek_vector, only: add_multiple, multiply
   use ek_suspension, only: suspension_t, load_t
   use ek_state, only: state_t, inputs_t
   use ek_scale, only: characteristic, scale_factors
   use ek_lapack, only: dsytrf, dlacn2
   use ek_substitution, only: substitute
   implicit none(type, external)
   private
   public :: kkt_t, new_kkt, assemble, assemble_rate, factorise, solve, condition, wrench, load_factor, count_inertia
   public :: whole_tangent, material_only, residual_only, nothing

   integer, parameter :: whole_tangent = 1   !! T with geometric stiffness: corrected, equilibrium
   integer, parameter :: material_only = 2   !! K = −(19) of the paper: recursive
   integer, parameter :: residual_only = 3   !! right-hand side only

   integer, parameter :: nothing = 0, assembled = 1, factors = 2   ! stages of the matrix

   !> The system and its work space, allocated once per model.
   type :: kkt_t
      integer :: nq = 0, nc = 0, n = 0       !! number of unknowns, of rows, and their sum
      real(wp), allocatable :: matrix(:, :)  !! lower triangle; after `factorise` its factors
      real(wp), allocatable :: rhs(:)        !! [N, N m; m, -, rad]; after `solve` [Δq; Δλ]
      real(wp), allocatable :: gradients(:, :)   !! (12, term): coefficient × gradient of each term
      real(wp), allocatable :: values(:)     !! Φ(q) − c − Cλ of each row [m, -, rad]: constraint violation
      real(wp), allocatable :: scale(:)      !! D
      real(wp), allocatable :: imbalance(:)  !! f_ext − f_el at design, for the homotopy of settling
      integer, allocatable :: pivots(:), iwork(:)
      real(wp), allocatable :: work(:)
      real(wp) :: length = 1.0_wp            !! characteristic length [m]
      real(wp) :: stiffness = 1.0_wp         !! characteristic stiffness [N/m]
      real(wp) :: norm = 0.0_wp              !! 1-norm of the last matrix passed to `condition`
      integer :: factorisations = 0          !! so far
      integer :: negative = 0                !! negative eigenvalues of the last matrix
      real(wp) :: pivot_ratio = 1.0_wp       !! smallest over largest pivot of the last matrix: a cheap condition estimate
      real(wp) :: log_determinant = 0.0_wp   !! ln |det| of the last matrix, scaled
      logical :: is_singular = .false.       !! the last factorisation met a zero pivot
      integer :: stage = nothing             !! what `matrix` holds
   end type kkt_t

contains

   !> Work space for a model, with its scales.
   function new_kkt(suspension) result(kkt)
      type(suspension_t), intent(in) :: suspension
      type(kkt_t) :: kkt

      kkt%nq = suspension%unknowns()
      kkt%nc = suspension%constraints()
      kkt%n = kkt%nq + kkt%nc
      allocate (kkt%matrix(kkt%n, kkt%n), kkt%rhs(kkt%n), kkt%scale(kkt%n), kkt%values(kkt%nc), source=0.0_wp)
      allocate (kkt%gradients(12, size(suspension%terms)), kkt%imbalance(kkt%nq), source=0.0_wp)
      allocate (kkt%pivots(kkt%n), kkt%iwork(kkt%n), source=0)
      allocate (kkt%work(64*max(kkt%n, 1)), source=0.0_wp)   ! 64 is LAPACK's block size of dsytrf
      call characteristic(suspension, kkt%length, kkt%stiffness)
      call scale_factors(suspension, kkt%length, kkt%stiffness, kkt%scale)
   end function new_kkt

   !> Force and moment of a load about the body's reference point, global axes; and its arm.
   !> Equation (K.1) of docs/theory/kkt.md.
   pure subroutine wrench(load, pose, force, moment, arm)
      type(load_t), intent(in) :: load
      type(pose_t), intent(in) :: pose
      real(wp), intent(out) :: force(3), moment(3)   !! N, N m
      real(wp), intent(out) :: arm(3)                !! arm of the point of application, global axes [m]

      arm = rotated(pose%a, load%arm)
      if (load%follows) then
         force = rotated(pose%a, load%force)
         moment = rotated(pose%a, load%moment)
      else
         force = load%force
         moment = load%moment
      end if
      moment = moment + cross(arm, force)
   end subroutine wrench

   !> Matrix (by `mode`) and right-hand side at a state. λ enters T and the residual.
   !>
   !> The residual is complete for material_only too; the recursion replaces it.
   !> Equation (K.1) of docs/theory/kkt.md.
   pure subroutine assemble(suspension, state, inputs, mode, kkt)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      integer, intent(in) :: mode                !! whole_tangent, material_only or residual_only
      type(kkt_t), intent(inout) :: kkt          !! matrix not yet scaled, rhs, gradients, values

      if (are_checked) then
         call require(kkt%nq == suspension%unknowns() .and. kkt%nc == suspension%constraints(), &
            'assemble: the system is of another model')
         call require(size(state%poses) == size(suspension%bodies) + 1 .and. size(state%reaction) == kkt%nc, &
            'assemble: the state is of another model')
         call require(inputs%loads <= size(inputs%load) .and. all(inputs%load(:inputs%loads) <= size(suspension%loads)) .and. &
            all(inputs%row(:inputs%rows) <= kkt%nc), 'assemble: the inputs are of another model')
      end if
      if (mode /= residual_only) kkt%stage = assembled
      call assemble_into(suspension, state%poses, state%reaction, inputs, mode, kkt%nq, kkt%n, kkt%gradients, &
         kkt%values, kkt%matrix, kkt%rhs)
      if (inputs%homotopy > 0.0_wp) call add_multiple(kkt%nq, -inputs%homotopy, kkt%imbalance, kkt%rhs)
   end subroutine assemble

   !> The same with explicit shapes, which the compiler turns into tight code.
   !> Equations (K.3), (K.4) of docs/theory/kkt.md.
   !> Equation (M.19) of docs/theory/measures.md.
   !> Equation (R.13) of docs/theory/rotations.md.
   pure subroutine assemble_into(suspension, poses, reaction, inputs, mode, nq, n, gradients, values, matrix, rhs)
      type(suspension_t), intent(in) :: suspension
      type(pose_t), intent(in) :: poses(0:*)     !! the chassis, then the bodies
      real(wp), intent(in) :: reaction(*)
      type(inputs_t), intent(in) :: inputs
      integer, intent(in) :: mode, nq, n
      real(wp), intent(inout) :: gradients(12, *), values(*)
      real(wp), intent(inout) :: matrix(n, n), rhs(n)
      type(evaluation_t) :: evaluation
      type(element_evaluation_t) :: element_evaluation
      real(wp) :: value, force(3), moment(3), arm(3), block(3, 3)
      integer :: k, t, i, j, at_i, at_j

      rhs = 0.0_wp
      if (mode /= residual_only) then
         do k = 1, n    ! diagonal 3×3 blocks are added in full, including elements above the diagonal
            matrix(max(k - 2, 1):n, k) = 0.0_wp
         end do
      end if

      do k = 1, size(suspension%loads)
         value = 1.0_wp
         if (suspension%loads(k)%is_case) value = load_factor(inputs, k)
         if (abs(value) <= 0.0_wp) cycle
         j = suspension%loads(k)%body
         at_j = 6*(j - 1)
         call wrench(suspension%loads(k), poses(j), force, moment, arm)
         force = value*force
         rhs(at_j + 1:at_j + 3) = rhs(at_j + 1:at_j + 3) + force
         rhs(at_j + 4:at_j + 6) = rhs(at_j + 4:at_j + 6) + value*moment
         if (mode == whole_tangent) then
            if (suspension%loads(k)%follows) then
               ! δf = π×f: T_rπ = f̃; its symmetric part is distributed half to rπ and half to πr
               block = 0.5_wp*skew(force)
               call add_block(block, at_j, at_j + 3, n, matrix)
            else
               arm = -arm
               call add_s_block(arm, force, at_j + 3, at_j, n, matrix)
            end if
         end if
      end do

      do k = 1, size(suspension%elements)
         associate (element => suspension%elements(k))
            i = element%measure%body_i
            j = element%measure%body_j
            at_i = 6*(i - 1)
            at_j = 6*(j - 1)
            call evaluate_element(element, poses(i), poses(j), element_evaluation)
            call add_gradient(-1.0_wp, element_evaluation%generalised_force, at_i, at_j, rhs)     ! ON the bodies: −dV/dz
            if (mode /= residual_only) &
               call add_element_tangent(element, element_evaluation, mode == material_only, at_i, at_j, n, matrix)
         end associate
      end do

      do k = 1, size(suspension%rows)
         value = 0.0_wp
         do t = suspension%rows(k)%first, suspension%rows(k)%first + suspension%rows(k)%terms - 1
            associate (term => suspension%terms(t))
               i = term%measure%body_i
               j = term%measure%body_j
               at_i = 6*(i - 1)
               at_j = 6*(j - 1)
               call evaluate(term%measure, poses(i), poses(j), evaluation)
               value = value + term%coefficient*evaluation%value
               gradients(:, t) = term%coefficient*evaluation%gradient
               call add_gradient(-reaction(k), gradients(:, t), at_i, at_j, rhs)
               if (mode /= residual_only) then
                  if (i > 0) matrix(nq + k, at_i + 1:at_i + 6) = matrix(nq + k, at_i + 1:at_i + 6) + gradients(1:6, t)
                  if (j > 0) matrix(nq + k, at_j + 1:at_j + 6) = matrix(nq + k, at_j + 1:at_j + 6) + gradients(7:12, t)
                  if (mode == whole_tangent) call add_measure_hessian(term%measure%kind, evaluation, &
                     reaction(k)*term%coefficient, at_i, at_j, n, matrix)
               end if
            end associate
         end do
         values(k) = value - suspension%rows(k)%target - suspension%rows(k)%compliance*reaction(k)
      end do
      do k = 1, inputs%rows
         values(inputs%row(k)) = values(inputs%row(k)) - inputs%change(k)
      end do
      do k = 1, size(suspension%rows)
         rhs(nq + k) = -values(k)
         if (mode /= residual_only) matrix(nq + k, nq + k) = -suspension%rows(k)%compliance
      end do

      if (mode == whole_tangent) then
         ! screw increments: r moves by Δr + ½ Δπ×Δr + …, so the unbalanced force g contributes ½ g̃
         do at_j = 0, nq - 6, 6
            block = -0.5_wp*skew(rhs(at_j + 1:at_j + 3))
            call add_block(block, at_j, at_j + 3, n, matrix)
         end do
      end if
   end subroutine assemble_into

   !> Right-hand side for a unit of the path coordinate: the derivative of the inputs, at a state. The solution with the
   !> factors of T is the tangent of the path, [Δq; Δλ] per unit of the path coordinate.
   !> Equation (K.13) of docs/theory/kkt.md.
   pure subroutine assemble_rate(suspension, state, rate, kkt)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: rate         !! derivative of the inputs with the path coordinate
      type(kkt_t), intent(inout) :: kkt          !! rhs
      real(wp) :: force(3), moment(3), arm(3)
      integer :: k, at

      kkt%rhs = 0.0_wp
      if (abs(rate%homotopy) > 0.0_wp) call add_multiple(kkt%nq, -rate%homotopy, kkt%imbalance, kkt%rhs)
      do k = 1, rate%loads
         associate (load => suspension%loads(rate%load(k)))
            at = 6*(load%body - 1)
            call wrench(load, state%poses(load%body + 1), force, moment, arm)
            kkt%rhs(at + 1:at + 3) = kkt%rhs(at + 1:at + 3) + rate%factor(k)*force
            kkt%rhs(at + 4:at + 6) = kkt%rhs(at + 4:at + 6) + rate%factor(k)*moment
         end associate
      end do
      do k = 1, rate%rows
         kkt%rhs(kkt%nq + rate%row(k)) = kkt%rhs(kkt%nq + rate%row(k)) + rate%change(k)
      end do
   end subroutine assemble_rate

   !> The scale factor of a case load: 0 if the inputs do not include it.
   pure real(wp) function load_factor(inputs, load)
      type(inputs_t), intent(in) :: inputs
      integer, intent(in) :: load      !! number of the load
      load_factor = sum(inputs%factor(:inputs%loads), mask=inputs%load(:inputs%loads) == load)
   end function load_factor

   !> Scales the matrix and factorises it (Bunch–Kaufman, LAPACK dsytrf); sets the inertia.
   !>
   !> A zero pivot sets is_singular; the caller obtains its cause from the diagnosis.
   !> Equation (K.5) of docs/theory/kkt.md.
   pure subroutine factorise(kkt)
      type(kkt_t), intent(inout) :: kkt
      integer :: info

      if (are_checked) call require(kkt%stage == assembled, 'factorise: no matrix was assembled')
      kkt%stage = factors
      kkt%factorisations = kkt%factorisations + 1
      call scale_lower(kkt%n, kkt%nq, kkt%scale, kkt%matrix)
      call dsytrf('L', kkt%n, kkt%matrix, kkt%n, kkt%pivots, kkt%work, size(kkt%work), info)
      call count_inertia(kkt%n, kkt%matrix, kkt%pivots, kkt%negative, kkt%pivot_ratio, kkt%log_determinant)
      kkt%is_singular = info /= 0 .or. .not. kkt%pivot_ratio > 0.0_wp
   end subroutine factorise

   !> Scales the lower triangle: D S D. Behind the unknowns of the bodies only its diagonal is not zero.
   pure subroutine scale_lower(n, nq, scale, matrix)
      integer, intent(in) :: n, nq
      real(wp), intent(in) :: scale(n)
      real(wp), intent(inout) :: matrix(n, n)
      integer :: j

      do j = 1, nq
         matrix(j:n, j) = matrix(j:n, j)*(scale(j)*scale(j:n))
      end do
      do j = nq + 1, n
         matrix(j, j) = matrix(j, j)*(scale(j)*scale(j))
      end do
   end subroutine scale_lower

   !> Number of negative eigenvalues, smallest over largest |eigenvalue| of the block-diagonal factor, and its determinant.
   !>
   !> By Sylvester's law the matrix has as many negative eigenvalues as its factor D. A stable equilibrium has
   !> exactly one per constraint row.
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

   !> Solves with the last factors; on return kkt%rhs is [Δq; Δλ].
   !> Equation (K.5) of docs/theory/kkt.md.
   pure subroutine solve(kkt)
      type(kkt_t), intent(inout) :: kkt

      if (are_checked) call require(kkt%stage == factors, 'solve: the matrix is not factorised')
      call multiply(kkt%n, kkt%scale, kkt%rhs)
      call substitute(kkt%n, kkt%matrix, kkt%pivots, kkt%rhs)
      call multiply(kkt%n, kkt%scale, kkt%rhs)
   end subroutine solve

   !> Reciprocal condition number of the scaled matrix at a state (as LAPACK's dsycon). Factorises.
   pure subroutine condition(suspension, state, inputs, kkt, rcond)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(inout) :: kkt
      real(wp), intent(out) :: rcond             !! 0: singular; 1: unit matrix
      real(wp) :: column, inverse
      integer :: i, j, kase, kept(3)

      call assemble(suspension, state, inputs, whole_tangent, kkt)
      kkt%norm = 0.0_wp
      do j = 1, kkt%n
         column = 0.0_wp
         do i = 1, kkt%n
            column = column + abs(kkt%matrix(max(i, j), min(i, j))*kkt%scale(i)*kkt%scale(j))
         end do
         kkt%norm = max(kkt%norm, column)
      end do
      call factorise(kkt)
      rcond = merge(1.0_wp, 0.0_wp, kkt%n == 0)
      if (kkt%is_singular .or. kkt%n == 0) return
      inverse = 0.0_wp
      kase = 0
      do
         call dlacn2(kkt%n, kkt%work(kkt%n + 1:2*kkt%n), kkt%work(:kkt%n), kkt%iwork, inverse, kase, kept)
         if (kase == 0) exit
         call substitute(kkt%n, kkt%matrix, kkt%pivots, kkt%work(:kkt%n))     ! the matrix is symmetric
      end do
      if (inverse > 0.0_wp) rcond = (1.0_wp/inverse)/kkt%norm
   end subroutine condition

end module ek_kkt
