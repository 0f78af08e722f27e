!> The response of wheels and springs to small loads at one equilibrium: the compliance matrix and related responses.
!>
!> With the whole tangent K = [T Φqᵀ; Φq 0] of a state, ports P (displacements) and loads B (unit loads), the
!> response is R = Pᵀ K⁻¹ B. The ports are the six displacements [x y z, rotations about x y z] of every wheel centre in
!> global axes, then the length of every axial spring (not of dampers, stops, torsion springs). Loads are the unit
!> loads of the same ports (virtual work: B = P; for a spring a pair of forces that pushes its ends apart), then a
!> unit displacement of the steering driver. The first 6 × wheels rows and columns are the compliance matrix C
!> [m/N, rad/N, m/(N m), rad/(N m)], body fixed.
!>
!> Rows of Φ that belong to a rig (a jack that holds a wheel's height) are released: their reaction remains on
!> the wheel as a constant force, with its geometric stiffness λ·Hess(φ), but the row no longer constrains. Its gradient
!> is cleared and its diagonal set to −1 of the scaled matrix: Δλ = 0, one negative eigenvalue as before.
!>
!> A constant moment and a load that rotates with its body have no potential: T lacks their skew part N, which affects
!> not the equilibrium but its derivative. With g = dV/dπ the moment of all terms that have a potential,
!> the derivative of the residual along a rotation is that of the exponential coordinates less ½ g̃ (from the
!> product of two rotations, exp(δ̃)exp(π̃) = exp((δ + π + ½ δ×π + …)~)), and g is the moment M of the rest:
!>
!>     dead moment M:            N_ππ = −½ M̃
!>     follower, force f, moment m about the reference point, arm included:
!>                               N_rπ = N_πr = ½ f̃,  N_ππ = ½ m̃     (½ m̃ = m̃ of its own rotation less ½ g̃)
!>
!> The matrix is then solved in full (LAPACK dgesv), and C is not symmetric.
!>
!> The contact point given by the deck is fixed to the carrier at the arm a from the wheel centre: a force F there equals the same
!> force at the centre with the moment a×F, and the point moves by δ + θ×a. Moments and rotations do not depend on the point.
!> Equation (C.4) of docs/theory/compliance.md.
!> Equation (R.7) of docs/theory/rotations.md.
module ek_compliance
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_measure, only: evaluation_t, evaluate
   use ek_block, only: rotated
   use ek_rotation, only: cross, skew, identity3
   use ek_element, only: element_kinds
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t
   use ek_kkt, only: kkt_t, assemble, factorise, wrench, load_factor, whole_tangent
   use ek_lapack, only: dsytrs2, dgesv
   implicit none(type, external)
   private
   public :: compliance_t, new_compliance, wheel_compliance, load_at_patch, read_at_patch, hold, lock

   real(wp), parameter :: singular = 1.0e-14_wp   !! pivot ratio at which the scaled matrix is singular to rounding

   !> The responses at one state, and the work space for them, allocated once for a model.
   type :: compliance_t
      integer :: wheels = 0, springs = 0
      integer, allocatable :: order(:)          !! wheel of the suspension at each index of C: left before right
      integer, allocatable :: spring(:)         !! axial spring of the suspension at each index
      logical :: is_known = .false.             !! false: the matrix was singular, `response` is not a number
      logical :: has_drive = .false.            !! the last column is that of a unit of the steering driver
      real(wp), allocatable :: response(:, :)   !! (port, load), see above
      real(wp), allocatable :: ports(:, :), columns(:, :)   !! (unknown, port), (unknown, load)
      real(wp), allocatable :: full(:, :)       !! unsymmetric matrix, only if a load requires it
      integer, allocatable :: pivots(:)
   end type compliance_t

contains

   !> Work space for a model; `drives`: a steering driver is moved.
   function new_compliance(suspension, drives) result(self)
      type(suspension_t), intent(in) :: suspension
      logical, intent(in) :: drives
      type(compliance_t) :: self
      integer :: n, k, ports

      self%wheels = size(suspension%wheels)
      self%springs = count(element_kinds(suspension%elements%kind)%is_axial_spring)
      allocate (self%spring(self%springs), source=pack([(k, k=1, size(suspension%elements))], &
         element_kinds(suspension%elements%kind)%is_axial_spring))
      self%has_drive = drives
      n = suspension%unknowns() + suspension%constraints()
      ports = 6*self%wheels + self%springs
      associate (side => suspension%wheels%side)
         self%order = [pack([(k, k=1, self%wheels)], side == -1), pack([(k, k=1, self%wheels)], side == 1)]
      end associate
      allocate (self%ports(n, ports), self%columns(n, ports + merge(1, 0, drives)), source=0.0_wp)
      allocate (self%response(ports, ports + merge(1, 0, drives)), source=0.0_wp)
   end function new_compliance

   !> Fills `self%response` at an equilibrium under given inputs. Costs one factorisation and the solutions.
   !> Equations (C.1), (C.3) of docs/theory/compliance.md.
   subroutine wheel_compliance(suspension, state, inputs, steer_row, kkt, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      integer, intent(in) :: steer_row            !! row of the steering driver, 0: none
      type(kkt_t), intent(inout) :: kkt           !! work space
      type(compliance_t), intent(inout) :: self   !! of new_compliance
      integer :: j, p, info

      if (are_checked) call require(size(self%columns, 1) == kkt%n, 'wheel_compliance: work space of another model')
      call assemble(suspension, state, inputs, whole_tangent, kkt)
      do j = suspension%own_rows() + 1, suspension%constraints()
         call release(j, kkt)
      end do
      call set_ports(suspension, state, self)
      p = size(self%ports, 2)
      self%columns(:, :p) = self%ports
      if (self%has_drive) then
         self%columns(:, p + 1) = 0.0_wp
         self%columns(kkt%nq + steer_row, p + 1) = 1.0_wp
      end if

      do j = 1, size(self%columns, 2)
         self%columns(:, j) = self%columns(:, j)*kkt%scale
      end do
      if (has_skew_part(suspension, inputs)) then
         call solve_full(suspension, state, inputs, kkt, self)
      else
         call factorise(kkt)
         self%is_known = .not. kkt%is_singular .and. kkt%pivot_ratio > singular
         info = 0
         if (self%is_known) call dsytrs2('L', kkt%n, size(self%columns, 2), kkt%matrix, kkt%n, kkt%pivots, self%columns, &
            kkt%n, kkt%work, info)
         if (info /= 0) self%is_known = .false.
      end if
      if (.not. self%is_known) then
         self%response = ieee_value(1.0_wp, ieee_quiet_nan)
         return
      end if
      do j = 1, size(self%columns, 2)
         self%columns(:, j) = self%columns(:, j)*kkt%scale
         do p = 1, size(self%ports, 2)
            self%response(p, j) = dot_product(self%ports(:, p), self%columns(:, j))
         end do
      end do
   end subroutine wheel_compliance

   !> Removes a row of Φ from an assembled matrix.
   !> Equation (C.5) of docs/theory/compliance.md.
   pure subroutine release(row, kkt)
      integer, intent(in) :: row
      type(kkt_t), intent(inout) :: kkt
      integer :: k

      k = kkt%nq + row
      kkt%matrix(k, :k - 1) = 0.0_wp
      kkt%matrix(k, k) = -1.0_wp/kkt%scale(k)**2
   end subroutine release

   !> The ports as columns of generalised forces: a unit load at a point is [e; s×e] on its body, a moment [0; e].
   !> Equation (C.2) of docs/theory/compliance.md.
   pure subroutine set_ports(suspension, state, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(compliance_t), intent(inout) :: self
      type(evaluation_t) :: evaluation
      real(wp) :: arm(3)
      integer :: w, k, at, port

      self%ports = 0.0_wp
      do w = 1, self%wheels
         associate (wheel => suspension%wheels(self%order(w)))
            arm = rotated(state%poses(wheel%body + 1)%a, wheel%centre)
            at = 6*(wheel%body - 1)
         end associate
         do k = 1, 3
            port = 6*(w - 1) + k
            self%ports(at + k, port) = 1.0_wp
            self%ports(at + 4:at + 6, port) = cross(arm, identity3(:, k))
            self%ports(at + 3 + k, port + 3) = 1.0_wp
         end do
      end do
      do k = 1, self%springs
         associate (m => suspension%elements(self%spring(k))%measure)
            port = 6*self%wheels + k
            call evaluate(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), evaluation)
            at = 6*(m%body_i - 1)
            if (at >= 0) self%ports(at + 1:at + 6, port) = evaluation%gradient(1:6)
            at = 6*(m%body_j - 1)
            if (at >= 0) self%ports(at + 1:at + 6, port) = self%ports(at + 1:at + 6, port) + evaluation%gradient(7:12)
         end associate
      end do
   end subroutine set_ports

   !> Scale of load k under given inputs.
   pure real(wp) function factor_of(suspension, inputs, k) result(factor)
      type(suspension_t), intent(in) :: suspension
      type(inputs_t), intent(in) :: inputs
      integer, intent(in) :: k

      factor = 1.0_wp
      if (suspension%loads(k)%is_case) factor = load_factor(inputs, k)
   end function factor_of

   !> Whether an active load has no potential.
   pure logical function has_skew_part(suspension, inputs)
      type(suspension_t), intent(in) :: suspension
      type(inputs_t), intent(in) :: inputs
      integer :: k

      has_skew_part = .false.
      do k = 1, size(suspension%loads)
         if (.not. abs(factor_of(suspension, inputs, k)) > 0.0_wp) cycle
         has_skew_part = has_skew_part .or. suspension%loads(k)%follows .or. any(abs(suspension%loads(k)%moment) > 0.0_wp)
      end do
   end function has_skew_part

   !> Solves with T + N, scaled like T; the columns are scaled on input and output.
   !> Equation (C.4) of docs/theory/compliance.md.
   subroutine solve_full(suspension, state, inputs, kkt, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(in) :: kkt
      type(compliance_t), intent(inout) :: self
      real(wp) :: force(3), moment(3), arm(3), factor, pivots(kkt%n)
      integer :: j, k, at, info

      if (.not. allocated(self%full)) then
         allocate (self%full(kkt%n, kkt%n), source=0.0_wp)
         allocate (self%pivots(kkt%n), source=0)
      end if
      do j = 1, kkt%n
         self%full(j:, j) = kkt%matrix(j:, j)
         self%full(j, j + 1:) = kkt%matrix(j + 1:, j)
      end do
      do k = 1, size(suspension%loads)
         factor = factor_of(suspension, inputs, k)
         associate (load => suspension%loads(k))
            at = 6*(load%body - 1)
            if (load%follows) then
               call wrench(load, state%poses(load%body + 1), force, moment, arm)
               call add(at, at + 3, 0.5_wp*factor*force)
               call add(at + 3, at, 0.5_wp*factor*force)
               call add(at + 3, at + 3, 0.5_wp*factor*moment)
            else
               call add(at + 3, at + 3, -0.5_wp*factor*load%moment)
            end if
         end associate
      end do
      do j = 1, kkt%n
         self%full(:, j) = self%full(:, j)*(kkt%scale*kkt%scale(j))
      end do
      call dgesv(kkt%n, size(self%columns, 2), self%full, kkt%n, self%pivots, self%columns, kkt%n, info)
      pivots = [(abs(self%full(j, j)), j=1, kkt%n)]
      self%is_known = info == 0 .and. minval(pivots) > singular*maxval(pivots)

   contains

      !> full(row+1:row+3, column+1:column+3) += p̃
      subroutine add(row, column, p)
         integer, intent(in) :: row, column
         real(wp), intent(in) :: p(3)
         self%full(row + 1:row + 3, column + 1:column + 3) = self%full(row + 1:row + 3, column + 1:column + 3) + skew(p)
      end subroutine add

   end subroutine solve_full

   !> M = C B: loads at the contact points, displacements at the wheel centres.
   !> Equation (C.7) of docs/theory/compliance.md.
   pure function load_at_patch(c, arm) result(m)
      real(wp), intent(in) :: c(:, :)
      real(wp), intent(in) :: arm(:, :)      !! contact point less wheel centre, of each wheel in the order of C [m]
      real(wp) :: m(size(c, 1), size(c, 2))
      real(wp) :: moment(3)
      integer :: w, k, at

      m = c
      do w = 1, size(arm, 2)
         at = 6*(w - 1)
         do k = 1, 3
            moment = cross(arm(:, w), identity3(:, k))
            m(:, at + k) = c(:, at + k) + moment(1)*c(:, at + 4) + moment(2)*c(:, at + 5) + moment(3)*c(:, at + 6)
         end do
      end do
   end function load_at_patch

   !> Bᵀ M: displacements of the contact points.
   !> Equation (C.7) of docs/theory/compliance.md.
   pure function read_at_patch(m, arm) result(cp)
      real(wp), intent(in) :: m(:, :)
      real(wp), intent(in) :: arm(:, :)
      real(wp) :: cp(size(m, 1), size(m, 2))
      integer :: w, j, at

      cp = m
      do w = 1, size(arm, 2)
         at = 6*(w - 1)
         do j = 1, size(m, 2)
            cp(at + 1:at + 3, j) = m(at + 1:at + 3, j) + cross(m(at + 4:at + 6, j), arm(:, w))
         end do
      end do
   end function read_at_patch

   !> The displacements M while the heights of all wheel centres are held: M − C(:,z) C_zz⁻¹ M(z,:), z one row per wheel.
   !> Equation (C.6) of docs/theory/compliance.md.
   pure function hold(c, m) result(held)
      real(wp), intent(in) :: c(:, :)        !! at the wheel centres
      real(wp), intent(in) :: m(:, :)        !! response at the wheel centres to any loads
      real(wp) :: held(size(m, 1), size(m, 2))
      integer :: k

      held = m
      call lock(c, [(6*k - 3, k=1, size(c, 1)/6)], held)
   end function hold

   !> Takes from displacements M those of the loads at some ports that undo the displacements of these ports.
   !>
   !> The ports are held one after the other, the one that is most compliant then first; a port without compliance once others are
   !> held (wheels that can only move together, two springs on one arm; below 1e-9 of its own compliance is rounding) is held
   !> already.
   !> Equation (C.6) of docs/theory/compliance.md.
   !> Equation (S.8) of docs/theory/suspension.md.
   pure subroutine lock(c, ports, m)
      real(wp), intent(in) :: c(:, :)           !! response to the loads of all ports
      integer, intent(in) :: ports(:)
      real(wp), intent(inout) :: m(:, :)        !! response to any loads
      real(wp) :: left(size(c, 1), size(ports)), own(size(ports)), column(size(c, 1)), compliance, most
      logical :: is_held(size(ports))
      integer :: k, j, next

      left = c(:, ports)
      own = [(abs(left(ports(k), k)), k=1, size(ports))]
      is_held = own <= tiny(own)
      do k = 1, size(ports)
         next = 0
         most = 0.0_wp
         do j = 1, size(ports)
            compliance = abs(left(ports(j), j))
            if (is_held(j) .or. compliance <= 1.0e-9_wp*own(j) .or. compliance <= most) cycle
            next = j
            most = compliance
         end do
         if (next == 0) return
         is_held(next) = .true.
         column = left(:, next)/left(ports(next), next)
         do j = 1, size(m, 2)
            m(:, j) = m(:, j) - column*m(ports(next), j)
         end do
         do j = 1, size(ports)
            if (.not. is_held(j)) left(:, j) = left(:, j) - column*left(ports(next), j)
         end do
      end do
   end subroutine lock

end module ek_compliance
