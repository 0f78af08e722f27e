!> The response of wheels and springs to small loads at one equilibrium: the compliance matrix and related responses.
!>
!> With the whole tangent K = [T Φqᵀ; Φq 0] of a state, ports P (displacements) and loads B (unit loads), the
!> response is R = Pᵀ K⁻¹ B. The ports are the six displacements [x y z, rotations about x y z] of every wheel centre in
!> global axes, then the length of every axial spring (not of dampers, stops, torsion springs). Loads are the unit
!> loads of the same ports (virtual work: B = P; for a spring a pair of forces that pushes its ends apart), then a
!> unit displacement of the steering driver. The first 6 × wheels rows and columns are the compliance matrix C
!> [m/N, rad/N, m/(N m), rad/(N m)], car body fixed.
!>
!> Rows of Φ that belong to a rig (a jack that holds a wheel's height) are released: their reaction remains on
!> the wheel as a constant force, with its geometric stiffness λ·Hess(φ), but the row no longer constrains. The gradient of the
!> row is cleared and its diagonal entry set to −1 in the scaled matrix: Δλ = 0, one negative eigenvalue as before.
!>
!> Under a constant moment or a load that rotates with its body, the matrix is not symmetric and is factorised in full
!> (ek_skew_system). The left responses of unit_responses are then solutions with the transpose.
!>
!> If nothing carries the wheels (ek_free_wheels), the matrix without the rows of the rig is singular. The rows of the rig are then
!> not released. The motion n of all bodies per unit of each row needs no force, and C = c Σ n nᵀ describes wheels that the rows
!> carry with the compliance c. c cancels in every column that does not depend on a rate. A displacement of the steering driver
!> moves the bodies with the rows held.
!>
!> The contact point given by the deck is fixed to the carrier at the arm a from the wheel centre: a force F there equals the same
!> force at the centre with the moment a×F, and the point moves by δ + θ×a. Moments and rotations do not depend on the point.
!>
!> The matrix is in the store of ek_pattern.
module ek_compliance
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_measure, only: evaluation_t, evaluate
   use ek_block, only: rotated, add_gradient
   use ek_element, only: element_kinds
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t
   use ek_kkt, only: kkt_t, assemble, release, factorise, solve_many, whole_matrix, whole_tangent, lapack_factors
   use ek_skew_system, only: skew_system_t, has_skew_part, factorise_skew, solve_skew
   implicit none(type, external)
   private
   public :: compliance_t, new_compliance, ask, wheel_compliance, wheel_compliance_nearby, respond, keep_responses, move_of, &
      unit_responses, solve_further

   real(wp), parameter :: stand_in = 1.0e-5_wp    !! m/N: compliance c of the rows of the rig if nothing carries the wheels
   real(wp), parameter :: singular = 1.0e-14_wp   !! pivot ratio up to which the scaled matrix counts as singular

   !> The responses at one state, and the work space for them, allocated once for a model.
   type :: compliance_t
      integer :: wheels = 0, springs = 0
      integer, allocatable :: order(:)          !! wheel of the suspension at each index of C: left before right
      integer, allocatable :: spring(:)         !! element of the suspension at each index of an axial spring
      logical :: is_known = .false.             !! false: the matrix was singular, `response` is NaN
      logical :: has_drive = .false.            !! the last load is a unit displacement of the steering driver
      real(wp), allocatable :: response(:, :)   !! (port, load): displacement of the port per load; NaN if not requested
      ! the loads that are solved, and the ports that are read
      integer, private :: solved = 0
      integer, allocatable, private :: load(:)          !! index of the load of each solved column
      integer, allocatable, private :: column(:)        !! solved column of each load; 0: the load is not solved
      logical, private :: reads_springs = .true.
      ! a port touches the unknowns of one body, or two
      integer, allocatable, private :: at_wheel(:)      !! number of unknowns before the unknowns of the carrier
      real(wp), allocatable, private :: arm(:, :)       !! reference point of the carrier to wheel centre [m], global axes
      integer, allocatable, private :: at_spring(:, :)  !! number of unknowns before those of both bodies; negative: chassis
      real(wp), allocatable, private :: gradient(:, :)  !! gradient of the length of each spring
      real(wp), allocatable, private :: columns(:, :)   !! (unknown, column): loads, after the solution [u; μ]
      type(skew_system_t), private :: skew_system       !! used only if a load has no potential
      logical :: is_skew = .false.                      !! the matrix of the last state is not symmetric
   end type compliance_t

contains

   !> Creates the work space of a model for all loads. `drives`: the steering driver is moved.
   function new_compliance(suspension, drives) result(self)
      type(suspension_t), intent(in) :: suspension
      logical, intent(in) :: drives
      type(compliance_t) :: self
      logical, allocatable :: is_asked(:)
      integer :: n, k, ports, loads

      self%wheels = size(suspension%wheels)
      self%springs = count(element_kinds(suspension%elements%kind)%is_axial_spring)
      allocate (self%spring(self%springs), source=pack([(k, k=1, size(suspension%elements))], &
         element_kinds(suspension%elements%kind)%is_axial_spring))
      self%has_drive = drives
      n = suspension%unknowns() + suspension%constraints()
      ports = 6*self%wheels + self%springs
      loads = ports + merge(1, 0, drives)
      associate (side => suspension%wheels%side)
         self%order = [pack([(k, k=1, self%wheels)], side == -1), pack([(k, k=1, self%wheels)], side == 1)]
      end associate
      allocate (self%columns(n, loads), self%response(ports, loads), self%arm(3, self%wheels), &
         self%gradient(12, self%springs), source=0.0_wp)
      allocate (self%at_wheel(self%wheels), self%at_spring(2, self%springs), self%load(loads), self%column(loads), source=0)
      do k = 1, self%wheels
         self%at_wheel(k) = 6*(suspension%wheels(self%order(k))%body - 1)
      end do
      do k = 1, self%springs
         associate (m => suspension%elements(self%spring(k))%measure)
            self%at_spring(:, k) = [6*(m%body_i - 1), 6*(m%body_j - 1)]
         end associate
      end do
      allocate (is_asked(loads), source=.true.)
      call ask(self, is_asked, .true.)
   end function new_compliance

   !> Restricts the computation to the requested loads, and to the ports of the wheels if springs are not read.
   subroutine ask(self, is_asked, reads_springs)
      type(compliance_t), intent(inout) :: self
      logical, intent(in) :: is_asked(:)          !! of each load
      logical, intent(in) :: reads_springs        !! the lengths of the springs are also requested
      integer :: k

      self%reads_springs = reads_springs
      self%solved = 0
      self%column = 0
      do k = 1, size(is_asked)
         if (.not. is_asked(k)) cycle
         self%solved = self%solved + 1
         self%load(self%solved) = k
         self%column(k) = self%solved
      end do
      self%response = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine ask

   !> Computes `self%response` at an equilibrium under given inputs. The cost is one factorisation and the solutions.
   !> Equations (C.1), (C.3) of docs/theory/compliance.md.
   subroutine wheel_compliance(suspension, state, inputs, steer_row, kkt, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      integer, intent(in) :: steer_row            !! row of the steering driver, 0: none
      type(kkt_t), intent(inout) :: kkt           !! work space
      type(compliance_t), intent(inout) :: self   !! of new_compliance

      if (are_checked) call require(size(self%columns, 1) == kkt%n, 'wheel_compliance: work space of another model')
      call assemble(suspension, state, inputs, whole_tangent, kkt)
      call respond(suspension, state, inputs, steer_row, kkt, self)
   end subroutine wheel_compliance

   !> Stores the solutions [u; μ] for the loads at the wheel centres at the last state (wheel_compliance_nearby); NaN if singular.
   pure subroutine keep_responses(self, kept)
      type(compliance_t), intent(in) :: self
      real(wp), intent(out) :: kept(:, :)         !! (load, unknown)
      kept(:, :) = ieee_value(1.0_wp, ieee_quiet_nan)
      if (self%is_known) kept(:, :) = transpose(self%columns(:, :size(kept, 1)))
   end subroutine keep_responses

   !> Computes the compliance of the wheels alone, without factorising, close to the state and design of the stored responses X:
   !> C ≈ PᵀX + XᵀP − XᵀKX, with K (symmetric) and P of the nearby state. The error is of second order in the distance, and even.
   !> Equation (E.8) of docs/theory/derivatives.md.
   subroutine wheel_compliance_nearby(suspension, state, inputs, kept, kkt, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      real(wp), intent(in) :: kept(:, :)          !! of keep_responses
      type(kkt_t), intent(inout) :: kkt           !! work space
      type(compliance_t), intent(inout) :: self   !! of new_compliance, with all loads
      integer :: j, n

      n = size(kept, 1)
      if (are_checked) call require(self%solved >= n .and. size(kept, 2) == kkt%n, 'wheel_compliance_nearby: of another model')
      call assemble(suspension, state, inputs, whole_tangent, kkt)
      do j = suspension%own_rows() + 1, suspension%constraints()
         call release(j, kkt)
      end do
      call set_ports(suspension, state, self)
      self%columns(:, :n) = transpose(kept)
      do j = 1, n
         call read_ports(j, self)
      end do
      self%response(:n, :n) = self%response(:n, :n) + transpose(self%response(:n, :n)) - &
         quadratic_form(kkt%pattern%entries, kkt%pattern%row, kkt%pattern%column, kkt%pattern%from, kkt%store, n, kkt%n, kept)
      self%is_known = .true.
   end subroutine wheel_compliance_nearby

   !> Computes the responses at a state whose complete tangent is already assembled.
   !> Equations (C.1), (C.3) of docs/theory/compliance.md.
   subroutine respond(suspension, state, inputs, steer_row, kkt, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      integer, intent(in) :: steer_row            !! row of the steering driver, 0: none
      type(kkt_t), intent(inout) :: kkt           !! assembled; on return, with the factorised matrix
      type(compliance_t), intent(inout) :: self   !! of new_compliance
      integer :: j

      call set_ports(suspension, state, self)
      call set_loads(kkt%nq + steer_row, self)
      self%is_skew = has_skew_part(suspension, inputs) .and. suspension%free_wheels == 0
      do j = suspension%own_rows() + 1, merge(suspension%constraints(), 0, suspension%free_wheels == 0)
         call release(j, kkt)
      end do
      if (suspension%free_wheels > 0) then
         call follow_rig(suspension, steer_row, kkt, self)
      else if (self%is_skew) then
         call factorise_skew(suspension, state, inputs, singular, kkt, self%skew_system)
         self%is_known = .not. self%skew_system%is_singular
         if (self%is_known) then
            call spread(self)
            call solve_skew(self%skew_system, kkt, .false., size(self%columns, 2), self%columns)
            call gather(self)
         end if
      else
         call solve_symmetric(kkt, self)
      end if
      if (.not. self%is_known) self%response = ieee_value(1.0_wp, ieee_quiet_nan)
      do j = 1, merge(self%solved, 0, self%is_known)
         call read_ports(j, self)
      end do
   end subroutine respond

   !> Computes the responses of a model in which nothing carries the wheels, from the motion per unit of each row of the rig.
   !> Equation (C.5) of docs/theory/compliance.md.
   subroutine follow_rig(suspension, steer_row, kkt, self)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: steer_row            !! row of the steering driver, 0: none
      type(kkt_t), intent(inout) :: kkt           !! assembled; on return, with the factors of the matrix with all rows
      type(compliance_t), intent(inout) :: self   !! with the loads in `columns`
      real(wp) :: motions(kkt%n, suspension%rig_rows + 1), along_row(suspension%rig_rows)
      integer :: j, k, rows

      rows = suspension%rig_rows
      motions = 0.0_wp
      do j = 1, rows
         k = suspension%own_rows() + j
         kkt%store(kkt%pattern%diagonal + k) = 0.0_wp
         motions(kkt%nq + k, j) = 1.0_wp
      end do
      if (steer_row > 0) motions(kkt%nq + steer_row, rows + 1) = 1.0_wp
      call factorise(kkt)
      self%is_known = rows >= suspension%free_wheels .and. .not. kkt%is_singular .and. kkt%pivot_ratio > singular
      if (.not. self%is_known) return
      call solve_many(kkt, rows + 1, motions)
      do k = 1, self%solved
         if (self%load(k) > size(self%response, 1)) then
            self%columns(:, k) = motions(:, rows + 1)
            cycle
         end if
         do j = 1, rows
            along_row(j) = stand_in*dot_product(motions(:kkt%nq, j), self%columns(:kkt%nq, k))
         end do
         self%columns(:, k) = 0.0_wp
         do j = 1, rows
            self%columns(:kkt%nq, k) = self%columns(:kkt%nq, k) + along_row(j)*motions(:kkt%nq, j)
         end do
      end do
   end subroutine follow_rig

   !> Factorises the assembled matrix and, unless it is singular, solves for the columns. Input and output are not scaled.
   !> Equation (C.3) of docs/theory/compliance.md.
   subroutine solve_symmetric(kkt, self)
      type(kkt_t), intent(inout) :: kkt
      type(compliance_t), intent(inout) :: self

      call factorise(kkt)
      self%is_known = .not. kkt%is_singular .and. kkt%pivot_ratio > singular
      if (.not. self%is_known) return
      if (kkt%stage == lapack_factors) call spread(self)
      call solve_many(kkt, merge(size(self%columns, 2), self%solved, kkt%stage == lapack_factors), self%columns)
      if (kkt%stage == lapack_factors) call gather(self)
   end subroutine solve_symmetric

   !> Moves every requested load to the column with the load's index, with zeros between. On some processors, the last digits of
   !> LAPACK's columns depend on their index and number. Thus a quantity does not depend on the other requested quantities.
   pure subroutine spread(self)
      type(compliance_t), intent(inout) :: self
      integer :: j, k

      do j = self%solved, 1, -1
         k = self%load(j)                        ! never below j
         if (k > j) self%columns(:, k) = self%columns(:, j)
      end do
      do k = 1, size(self%columns, 2)
         if (self%column(k) == 0) self%columns(:, k) = 0.0_wp
      end do
   end subroutine spread

   !> Moves the solved loads back to the first columns.
   pure subroutine gather(self)
      type(compliance_t), intent(inout) :: self
      integer :: j

      do j = 1, self%solved
         if (self%load(j) > j) self%columns(:, j) = self%columns(:, self%load(j))
      end do
   end subroutine gather

   !> Sets the ports at a state: the arms of the wheel centres, and the gradients of the lengths of springs.
   !> Equation (C.2) of docs/theory/compliance.md.
   pure subroutine set_ports(suspension, state, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(compliance_t), intent(inout) :: self
      type(evaluation_t) :: evaluation
      integer :: k

      do k = 1, self%wheels
         associate (wheel => suspension%wheels(self%order(k)))
            self%arm(:, k) = rotated(state%poses(wheel%body + 1)%a, wheel%centre)
         end associate
      end do
      if (.not. self%reads_springs) return
      do k = 1, self%springs
         associate (m => suspension%elements(self%spring(k))%measure)
            call evaluate(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), evaluation)
            self%gradient(:, k) = evaluation%gradient
         end associate
      end do
   end subroutine set_ports

   !> Sets the loads as columns of generalised forces: a unit force e at a wheel centre of arm s is [e; s×e], a moment [0; e].
   !> Equation (C.2) of docs/theory/compliance.md.
   pure subroutine set_loads(driven, self)
      integer, intent(in) :: driven               !! equation of the steering driver
      type(compliance_t), intent(inout) :: self
      integer :: j, w, k, at

      self%columns = 0.0_wp
      do j = 1, self%solved
         w = (self%load(j) + 5)/6
         k = self%load(j) - 6*self%wheels
         if (w <= self%wheels) then
            k = self%load(j) - 6*(w - 1)
            at = self%at_wheel(w)
            self%columns(at + k, j) = 1.0_wp
            associate (s => self%arm(:, w), moment => self%columns(at + 4:at + 6, j))
               select case (k)
               case (1)
                  moment(2) = s(3)
                  moment(3) = -s(2)
               case (2)
                  moment(1) = -s(3)
                  moment(3) = s(1)
               case (3)
                  moment(1) = s(2)
                  moment(2) = -s(1)
               end select
            end associate
         else if (k <= self%springs) then
            call add_gradient(1.0_wp, self%gradient(:, k), self%at_spring(1, k), self%at_spring(2, k), self%columns(:, j))
         else
            self%columns(driven, j) = 1.0_wp
         end if
      end do
   end subroutine set_loads

   !> Reads the displacements of the ports under a solved load from the displacements of the bodies.
   !> Equation (C.3) of docs/theory/compliance.md.
   pure subroutine read_ports(column, self)
      integer, intent(in) :: column
      type(compliance_t), intent(inout) :: self
      integer :: k, at, p

      associate (moves => self%columns(:, column), displacements => self%response(:, self%load(column)))
         do k = 1, self%wheels
            at = self%at_wheel(k)
            p = 6*(k - 1)
            associate (x => moves(at + 1:at + 3), turn => moves(at + 4:at + 6), s => self%arm(:, k))
               displacements(p + 1) = x(1) + (turn(2)*s(3) - turn(3)*s(2))
               displacements(p + 2) = x(2) + (turn(3)*s(1) - turn(1)*s(3))
               displacements(p + 3) = x(3) + (turn(1)*s(2) - turn(2)*s(1))
               displacements(p + 4:p + 6) = turn
            end associate
         end do
         if (.not. self%reads_springs) return
         do k = 1, self%springs
            displacements(6*self%wheels + k) = along(self%gradient(:, k), self%at_spring(1, k), self%at_spring(2, k), moves)
         end do
      end associate
   end subroutine read_ports

   !> Change of a measure of two bodies per unit of a load that was requested and solved, in the unit of the measure.
   pure real(wp) function move_of(self, load, gradient, body_i, body_j) result(change)
      type(compliance_t), intent(in) :: self
      integer, intent(in) :: load
      real(wp), intent(in) :: gradient(12)        !! gradient of the measure
      integer, intent(in) :: body_i, body_j       !! bodies of the measure; 0: the chassis

      if (are_checked) call require(self%column(load) > 0, 'move_of: the load was not asked')
      change = along(gradient, 6*(body_i - 1), 6*(body_j - 1), self%columns(:, self%column(load)))
   end function move_of

   !> The product of a gradient and the displacements of its two bodies. A negative at_i or at_j stands for the chassis.
   pure real(wp) function along(gradient, at_i, at_j, moves) result(change)
      real(wp), intent(in) :: gradient(12)
      integer, intent(in) :: at_i, at_j           !! unknowns before the unknowns of the body
      real(wp), intent(in) :: moves(*)

      change = 0.0_wp
      if (at_i >= 0) change = dot_product(gradient(1:6), moves(at_i + 1:at_i + 6))
      if (at_j >= 0) change = change + dot_product(gradient(7:12), moves(at_j + 1:at_j + 6))
   end function along

   !> Returns the motions of all bodies and the changes of all reactions [u; μ] under the unit loads at the wheel centres (right),
   !> and the solutions with the transpose (left; equal if the matrix is symmetric). The call must follow `respond`, with all these
   !> loads requested. The responses to these loads are refined.
   !> Equation (C.14) of docs/theory/compliance.md.
   subroutine unit_responses(kkt, self, right, left)
      type(kkt_t), intent(inout) :: kkt                     !! with the factors of `respond`
      type(compliance_t), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: right(:, :), left(:, :)     !! (unknown, load)
      real(wp), allocatable :: solved(:, :), loads(:, :), matrix(:, :), rest(:, :)
      integer :: n, j

      n = 6*self%wheels
      if (are_checked) call require(all(self%column(:n) > 0), 'unit_responses: a load was not asked')
      allocate (solved, source=self%columns)
      call set_loads(kkt%nq, self)
      allocate (loads, source=self%columns(:, self%column(:n)))
      self%columns(:, :) = solved
      right = solved(:, self%column(:n))
      ! a step of refinement: entries between both sides of an axle are small beside those of one side
      if (self%is_skew) then
         matrix = self%skew_system%matrix
      else
         matrix = whole_matrix(kkt)
      end if
      rest = loads - matmul(matrix, right)
      call solve_further(kkt, self, n, rest)
      right = right + rest
      do j = 1, n
         self%columns(:, self%column(j)) = right(:, j)
         call read_ports(self%column(j), self)
      end do
      left = right
      if (.not. self%is_skew) return
      left = loads
      call solve_skew(self%skew_system, kkt, .true., n, left)
      rest = loads - matmul(transpose(matrix), left)
      call solve_skew(self%skew_system, kkt, .true., n, rest)
      left = left + rest
   end subroutine unit_responses

   !> Replaces further columns of generalised forces [N, N m; m] by their solutions [u; μ] with the matrix of the last state.
   subroutine solve_further(kkt, self, many, columns)
      type(kkt_t), intent(inout) :: kkt                     !! with the factors of `respond`
      type(compliance_t), intent(in) :: self
      integer, intent(in) :: many
      real(wp), intent(inout) :: columns(kkt%n, many)

      if (self%is_skew) then
         call solve_skew(self%skew_system, kkt, .false., many, columns)
      else
         call solve_many(kkt, many, columns)
      end if
   end subroutine solve_further

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

end module ek_compliance
