!> The KKT system of an increment: its matrix and right-hand side, and their assembly.
!>
!>     [ T  Φqᵀ ] [Δq]   [ f_ext − f_el − Φqᵀλ ]
!>     [ Φq −C  ] [Δλ] = [ c − Φ(q) + Cλ       ]           one step of Newton's method for f_ext = f_el + Φqᵀλ, Φ = c + Cλ
!>
!> c contains the targets of the rows. C is zero except for drivers with a stiffness k: 1/k on the diagonal. With C ≥ 0 a stable
!> equilibrium still has exactly one negative eigenvalue per row.
!> T is the Hessian of the energy along screw motions (see `move_as_screw` in ek_state): the increment of a
!> body is then independent of its reference point.
!> Unknowns: 6 per body [Δr Δπ], then the rows of Φ. The entries of the matrix are stored in an array, the store (ek_pattern).
!> Equations (K.2), (K.3) of docs/theory/kkt.md.
module ek_kkt_system
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_vector, only: add_multiple
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t, is_design
   use ek_pattern, only: pattern_t, whole_tangent, residual_only
   use ek_measure, only: evaluation_t, evaluate
   use ek_kkt_terms, only: assemble_terms, assemble_rate_terms
   use ek_plan, only: plan_t
   implicit none(type, external)
   private
   public :: kkt_t, assemble, assemble_rows, assemble_gradients, assemble_rate, release, holds, load_factor, whole_matrix
   public :: nothing, assembled, lapack_factors, plan_factors, held, released

   integer, parameter :: nothing = 0, assembled = 1, lapack_factors = 2, plan_factors = 3   !! stages of the matrix

   integer, parameter :: held = 1, released = 2     !! plans: matrix of an increment; matrix with the rows of the rig released

   !> The system and its work space, allocated once per model.
   type :: kkt_t
      integer :: nq = 0, nc = 0, n = 0       !! number of unknowns, of rows, and their sum
      type(pattern_t) :: pattern             !! positions of the entries in the store
      real(wp), allocatable :: store(:)      !! the entries of the matrix, not scaled
      real(wp), allocatable :: scaling(:)    !! scale factor of each entry of the pattern
      logical :: has_plan = .false.          !! factorise by plan
      type(plan_t) :: plan(2)                !! plans `held` and `released`
      real(wp), allocatable :: planned(:)    !! factors by plan
      real(wp), allocatable :: turned(:, :)  !! (right-hand side, unknown): work space of solve_many
      real(wp), allocatable :: matrix(:, :)  !! factors by LAPACK in the lower triangle; allocated when needed
      real(wp), allocatable :: rhs(:)        !! right-hand side [N, N m; m, -, rad]; after `solve` [Δq; Δλ]
      real(wp), allocatable :: gradients(:, :)   !! (12, term): coefficient × gradient of each term
      real(wp), allocatable :: values(:)     !! Φ(q) − c − Cλ of each row [m, -, rad]: constraint violation
      real(wp), allocatable :: scale(:)      !! D: scale factors of the unknowns and of the rows (ek_scale)
      real(wp), allocatable :: factor(:), change(:)   !! factor of each load, change of each row, from the inputs [-; m, -, rad]
      real(wp), allocatable :: imbalance(:)  !! for the homotopy to static equilibrium: f_ext − f_el at design, and c − Φ of
                                             !! the rows of the rig; 0 in all other rows
      integer, allocatable :: pivots(:), iwork(:)
      real(wp), allocatable :: work(:)
      real(wp) :: length = 1.0_wp            !! characteristic length [m]
      real(wp) :: stiffness = 1.0_wp         !! characteristic stiffness [N/m]
      real(wp) :: norm = 0.0_wp              !! 1-norm of the last matrix passed to `condition`
      integer :: factorisations = 0          !! number of factorisations so far
      integer :: solutions = 0               !! number of solutions for a single right-hand side (`solve`) so far
      integer :: fallbacks = 0               !! factorisations repeated by LAPACK, because the factors by plan were not sound
      integer :: way = held                  !! plan of the matrix in the store
      integer :: negative = 0                !! negative eigenvalues of the last matrix
      real(wp) :: pivot_ratio = 1.0_wp       !! smallest over largest pivot of the last matrix: a cheap condition estimate
      real(wp) :: log_determinant = 0.0_wp   !! ln |det| of the last matrix, scaled
      logical :: is_singular = .false.       !! the last factorisation met a zero pivot
      integer :: stage = nothing             !! nothing, assembled, lapack_factors or plan_factors
      logical :: is_at_design = .false.      !! matrix, factors and right-hand side belong to design, see `holds`
   end type kkt_t

contains

   !> Assembles the matrix (by `mode`) and the right-hand side at a state. λ enters T and the residual.
   !>
   !> With material_only, the residual is complete as well; the recursion replaces this residual.
   !> Equation (K.1) of docs/theory/kkt.md.
   pure subroutine assemble(suspension, state, inputs, mode, kkt)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      integer, intent(in) :: mode                !! whole_tangent, material_only or residual_only
      type(kkt_t), intent(inout) :: kkt          !! matrix not yet scaled, rhs, gradients, values
      integer :: k, l

      if (are_checked) then
         call require(kkt%nq == suspension%unknowns() .and. kkt%nc == suspension%constraints() .and. &
            size(kkt%factor) == size(suspension%loads), 'assemble: the system is of another model')
         call require(size(state%poses) == size(suspension%bodies) + 1 .and. size(state%reaction) == kkt%nc, &
            'assemble: the state is of another model')
         call require(inputs%loads <= size(inputs%load) .and. all(inputs%load(:inputs%loads) + inputs%further(:inputs%loads) <= &
            size(suspension%loads)) .and. &
            all(inputs%row(:inputs%rows) <= kkt%nc), 'assemble: the inputs are of another model')
      end if
      kkt%is_at_design = .false.
      kkt%factor = 1.0_wp
      where (suspension%loads%is_case) kkt%factor = 0.0_wp
      do k = 1, inputs%loads
         do l = inputs%load(k), inputs%load(k) + inputs%further(k)
            if (suspension%loads(l)%is_case) kkt%factor(l) = kkt%factor(l) + inputs%factor(k)
         end do
      end do
      call set_change(inputs, kkt%change)
      call assemble_terms(kkt%pattern, suspension%loads, suspension%elements, suspension%rows, suspension%terms, state%poses, &
         state%reaction, kkt%factor, kkt%change, mode, kkt%gradients, kkt%values, kkt%store(1), &
         kkt%store(kkt%pattern%jacobian + 1), kkt%rhs)
      if (mode /= residual_only) then
         kkt%stage = assembled
         kkt%way = held
         do k = 1, kkt%nc
            kkt%store(kkt%pattern%diagonal + k) = -suspension%rows(k)%compliance
         end do
      end if
      if (inputs%homotopy > 0.0_wp) call add_multiple(kkt%n, -inputs%homotopy, kkt%imbalance, kkt%rhs)
   end subroutine assemble

   !> Assembles only the rows of Φ at a state: gradients and violations, equal to the results of `assemble`.
   pure subroutine assemble_rows(suspension, state, inputs, kkt)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(inout) :: kkt          !! gradients, values; the right-hand side is incomplete

      kkt%is_at_design = .false.
      call set_change(inputs, kkt%change)
      call assemble_terms(kkt%pattern, suspension%loads(:0), suspension%elements(:0), suspension%rows, suspension%terms, &
         state%poses, state%reaction, kkt%factor, kkt%change, residual_only, kkt%gradients, kkt%values, kkt%store(1), &
         kkt%store(kkt%pattern%jacobian + 1), kkt%rhs)
   end subroutine assemble_rows

   !> Finds the gradients of some rows of Φ at a state, equal to the results of `assemble`.
   pure subroutine assemble_gradients(suspension, state, first, last, kkt)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: first, last         !! rows
      type(kkt_t), intent(inout) :: kkt          !! gradients of the terms of these rows; all else is unchanged
      type(evaluation_t) :: evaluation
      integer :: t

      kkt%is_at_design = .false.
      do t = suspension%rows(first)%first, suspension%rows(last)%first + suspension%rows(last)%terms - 1
         associate (term => suspension%terms(t))
            call evaluate(term%measure, state%poses(term%measure%body_i + 1), state%poses(term%measure%body_j + 1), evaluation)
            kkt%gradients(:, t) = term%coefficient*evaluation%gradient
         end associate
      end do
   end subroutine assemble_gradients

   !> Sets the change of the value of each row [m, -, rad].
   pure subroutine set_change(inputs, change)
      type(inputs_t), intent(in) :: inputs
      real(wp), intent(out) :: change(:)
      integer :: k

      change = 0.0_wp
      do k = 1, inputs%rows
         change(inputs%row(k)) = change(inputs%row(k)) + inputs%change(k)
      end do
   end subroutine set_change

   !> Assembles the right-hand side for the tangent of the path at a state: the derivative of the right-hand side with respect to
   !> the path coordinate. The solution with the factors of the KKT matrix N is the tangent, [Δq; Δλ] per unit of the path
   !> coordinate.
   !> Equation (K.13) of docs/theory/kkt.md.
   pure subroutine assemble_rate(suspension, state, rate, kkt)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: rate         !! derivative of the inputs with respect to the path coordinate
      type(kkt_t), intent(inout) :: kkt          !! rhs
      integer :: k, l

      kkt%is_at_design = .false.
      kkt%factor = 0.0_wp
      do k = 1, rate%loads
         do l = rate%load(k), rate%load(k) + rate%further(k)
            kkt%factor(l) = kkt%factor(l) + rate%factor(k)
         end do
      end do
      call set_change(rate, kkt%change)
      call assemble_rate_terms(kkt%nq, suspension%loads, state%poses, kkt%factor, kkt%change, kkt%rhs)
      if (abs(rate%homotopy) > 0.0_wp) call add_multiple(kkt%n, -rate%homotopy, kkt%imbalance, kkt%rhs)
   end subroutine assemble_rate

   !> The scale factor of a load that a case scales; 0 if the inputs do not include the load.
   pure real(wp) function load_factor(inputs, load)
      type(inputs_t), intent(in) :: inputs
      integer, intent(in) :: load      !! index of the load
      load_factor = sum(inputs%factor(:inputs%loads), mask=inputs%load(:inputs%loads) <= load .and. &
         load <= inputs%load(:inputs%loads) + inputs%further(:inputs%loads))
   end function load_factor

   !> Removes a row of Φ from an assembled matrix. The diagonal of the row becomes −1 in the scaled matrix.
   !> Equation (C.5) of docs/theory/compliance.md.
   pure subroutine release(row, kkt)
      integer, intent(in) :: row
      type(kkt_t), intent(inout) :: kkt

      associate (pattern => kkt%pattern)
         kkt%store(pattern%jacobian + 6*pattern%first_slot(row) - 5:pattern%jacobian + 6*pattern%first_slot(row + 1) - 6) = 0.0_wp
         kkt%store(pattern%diagonal + row) = -1.0_wp/kkt%scale(kkt%nq + row)**2
      end associate
      kkt%way = released
      kkt%is_at_design = .false.
   end subroutine release

   !> The complete assembled matrix, without scaling.
   pure function whole_matrix(kkt) result(matrix)
      type(kkt_t), intent(in) :: kkt
      real(wp) :: matrix(kkt%n, kkt%n)
      integer :: k

      matrix = 0.0_wp
      associate (pattern => kkt%pattern)
         do k = 1, pattern%entries
            matrix(pattern%row(k), pattern%column(k)) = kkt%store(pattern%from(k))
            matrix(pattern%column(k), pattern%row(k)) = kkt%store(pattern%from(k))
         end do
      end associate
   end function whole_matrix

   !> Whether the system contains matrix, factors and right-hand side of a state under these inputs. The result is .true. only at
   !> design without inputs, after the proof of soundness (is_at_design). After numbers of the model are changed, the system must be
   !> renewed (renew_kkt).
   pure logical function holds(kkt, suspension, state, inputs)
      type(kkt_t), intent(in) :: kkt
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs

      holds = kkt%is_at_design
      if (.not. holds) return
      holds = inputs%loads == 0 .and. inputs%rows == 0 .and. .not. inputs%homotopy > 0.0_wp .and. is_design(suspension, state)
   end function holds

end module ek_kkt_system
