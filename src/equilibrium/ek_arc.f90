!> Follows a path by its arc length across limit points, where the load or the driven value reaches an extremum and the
!> path turns back.
!>
!> The swept value s is an unknown in addition to the bodies z and the reactions λ. Along a step of length Δl
!>
!>     F(z, λ, s) = 0,    t·(Δz, Δs) = Δl        t the unit tangent at the start of the step (pseudo arc length)
!>
!> and each correction solves the bordered system
!>
!>     [ N  −∂F/∂s ] [Δz Δλ]   [ F ]
!>     [ t     t_s ] [Δs   ] = [ 0 ]
!>
!> which is regular at a limit point, where N alone is not. Lengths follow from the scalar product
!>
!>     a·b = Σ over bodies (a_r·b_r/L² + a_π·b_π) + a_s b_s/range²        L the size of the model
!>
!> and are therefore dimensionless; reactions are ignored. The tangent has the sense of the previous tangent, which
!> carries the path across a fold. A position where joints lock is passed likewise; the reactions at this position are unbounded.
!>
!> A step is accepted if the tangents at its ends agree with the motion and differ by a small angle, or at a corner of a law.
!> Steps are reproducible: followed again from the same state, a path has the same lengths.
!> No memory is allocated after new_arc.
module ek_arc
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_measure, only: distance
   use ek_suspension, only: suspension_t, has_symmetric_loads
   use ek_state, only: state_t, inputs_t, design_state, coordinates, pack_state, unpack_state, inputs_rate, &
      motion_between, move_as_screw
   use ek_schedule, only: schedule_t, inputs_at
   use ek_kkt, only: kkt_t, assemble, assemble_rate, factorise, whole_tangent, residual_only
   use ek_lapack, only: dgesv
   implicit none(type, external)
   private
   public :: arc_t, new_arc, begin, advance, probe, find_tangent, find_motion, inner

   real(wp), parameter :: first_step = 1.0e-2_wp      !! length of the first step in the norm above [-]
   real(wp), parameter :: longest_step = 1.0e-1_wp
   real(wp), parameter :: corner_step = 1.0e-5_wp     !! longest step that may have a larger angle: the corner of a law [-]
   real(wp), parameter :: min_step = 1.0e-9_wp      !! if no step down to this length is accepted, the path has ended [-]
   real(wp), parameter :: max_rotation = 0.17_wp         !! largest angle between the tangents at the ends of a step [rad]: 10 deg
   real(wp), parameter :: good_turn = 0.1_wp          !! angle between the tangents at which the next step aims [rad]
   real(wp), parameter :: max_of_corner = 1.5_wp     !! largest angle at a corner of a law [rad]; above it, another path
   real(wp), parameter :: smooth = 1.0e-2_wp          !! allowed error of the trapezoidal rule, as a share of the step [-]
   integer, parameter :: max_iterations = 10         !! largest number of iterations: Newton's method does not need more

   !> A segment of the path from a to b, the position of a probe on it, and work space.
   type :: arc_t
      type(schedule_t) :: schedule
      real(wp) :: range = 1.0_wp                     !! range of swept values: a change by the range has the length 1
      real(wp) :: size = 1.0_wp                      !! L [m]: the larger of the characteristic length and the longest spring,
                                                     !! stop or damper on a distance at design
      real(wp) :: tolerance = 0.0_wp                 !! limit of the last correction [m]
      logical :: is_symmetric = .true.               !! no load makes the true matrix unsymmetric
      real(wp) :: length = 0.0_wp                    !! length of the path from design to a [-]
      real(wp) :: width = 0.0_wp                     !! length of the segment [-]; 0: at the start, or at the end of the path
      real(wp) :: step = first_step                  !! length of the next step to be tried [-]
      real(wp) :: place_a = 0.0_wp, place_b = 0.0_wp
      integer :: negative_a = 0, negative_b = 0      !! negative eigenvalues of N at a, at b
      real(wp), allocatable :: packed_a(:), packed_b(:)      !! packed states a and b, see ek_state
      real(wp), allocatable :: tangent_a(:), tangent_b(:)    !! unit tangents at a and b: [twists; reactions; swept value]
      real(wp), allocatable :: tangent_0(:)                  !! tangent at the start of the path
      type(state_t) :: state                         !! state of the last probe
      real(wp) :: place = 0.0_wp                     !! swept value of the last probe
      real(wp), allocatable :: tangent(:)            !! unit tangent at the last probe, from find_tangent
      integer :: factorisations = 0                  !! number of factorisations of the bordered matrix so far
      type(state_t) :: other
      real(wp), allocatable :: motion(:)             !! step to the last probe (find_motion): [twists; 0; swept value]
      real(wp), allocatable :: residual(:)
      real(wp), allocatable :: matrix(:, :), rhs(:, :)       !! the bordered system, scaled: matrix and right-hand side
      integer, allocatable :: pivots(:)
   end type arc_t

contains

   !> The work space for a model, before `begin`.
   function new_arc(suspension, schedule, length, range, tolerance) result(self)
      type(suspension_t), intent(in) :: suspension
      type(schedule_t), intent(in) :: schedule
      real(wp), intent(in) :: length         !! characteristic length from ek_scale [m]
      real(wp), intent(in) :: range          !! swept value, above 0
      real(wp), intent(in) :: tolerance      !! m
      type(arc_t) :: self
      integer :: n

      n = suspension%unknowns() + suspension%constraints() + 1
      allocate (self%tangent_a(n), self%tangent_b(n), self%tangent_0(n), self%tangent(n), self%motion(n), &
         self%residual(n - 1), self%matrix(n, n), self%rhs(n, 1), source=0.0_wp)
      allocate (self%packed_a(coordinates(suspension)), self%packed_b(coordinates(suspension)), source=0.0_wp)
      allocate (self%pivots(n), source=0)
      self%state = design_state(suspension)
      self%other = self%state
      self%schedule = schedule
      self%range = range
      self%size = max(length, maxval(suspension%elements%design_length, mask=suspension%elements%measure%kind == distance))
      self%tolerance = tolerance
      self%is_symmetric = has_symmetric_loads(suspension)
   end function new_arc

   !> Starts at an equilibrium on the path, in the direction of rising or falling swept value.
   subroutine begin(self, suspension, packed, place, upward, kkt, is_found)
      type(arc_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      real(wp), contiguous, intent(in) :: packed(:)
      real(wp), intent(in) :: place
      logical, intent(in) :: upward              !! the swept value increases at first
      type(kkt_t), intent(inout) :: kkt
      logical, intent(out) :: is_found           !! the direction of the path is unique

      self%length = 0.0_wp
      self%width = 0.0_wp
      self%step = first_step
      self%packed_a = packed
      self%place_a = place
      call unpack_state(packed, self%state)
      self%place = place
      self%tangent_a = 0.0_wp
      self%tangent_a(kkt%n + 1) = merge(self%range, -self%range, upward)
      call find_tangent(self, suspension, kkt, is_found)
      self%negative_a = kkt%negative
      self%tangent_a = self%tangent
      self%tangent_0 = self%tangent
   end subroutine begin

   !> Moves to the next segment: b becomes a, and the next b is found. The step is halved until the tangents at its ends agree.
   subroutine advance(self, suspension, kkt, is_found)
      type(arc_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(inout) :: kkt
      logical, intent(out) :: is_found           !! .false.: the path ends at a
      real(wp) :: turn

      if (self%width > 0.0_wp) then
         self%length = self%length + self%width
         self%packed_a = self%packed_b
         self%tangent_a = self%tangent_b
         self%place_a = self%place_b
         self%negative_a = self%negative_b
      end if
      do
         call probe(self, suspension, self%step, kkt, is_found)
         if (is_found) call find_tangent(self, suspension, kkt, is_found)
         if (is_found) then
            turn = acos(min(max(inner(self, kkt, self%tangent_a, self%tangent), -1.0_wp), 1.0_wp))
            is_found = turn <= max_rotation
            if (is_found) is_found = rest() <= smooth
            if (.not. is_found .and. self%step <= corner_step) is_found = turn <= max_of_corner
         end if
         if (is_found) exit
         self%step = 0.5_wp*self%step
         if (self%step < min_step) then
            self%width = 0.0_wp
            return
         end if
      end do
      call pack_state(self%state, self%packed_b)
      self%place_b = self%place
      self%tangent_b = self%tangent
      self%negative_b = kkt%negative
      self%width = self%step
      self%step = min(longest_step, self%step*min(4.0_wp, good_turn/max(turn, 0.1_wp*good_turn)))

   contains

      !> The error of the trapezoidal rule, as a share of the step [-].
      real(wp) function rest()
         real(wp) :: largest
         call find_motion(self, kkt, self%packed_a, self%place_a, largest)
         self%motion = self%motion - 0.5_wp*self%step*(self%tangent_a + self%tangent)
         rest = sqrt(inner(self, kkt, self%motion, self%motion))/self%step
      end function rest

   end subroutine advance

   !> Finds the equilibrium at a length along the tangent of a. The result is in self%state and self%place (swept value).
   !> Equation (K.18) of docs/theory/kkt.md.
   subroutine probe(self, suspension, width, kkt, is_found)
      type(arc_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: width              !! length along the tangent of a
      type(kkt_t), intent(inout) :: kkt
      logical, intent(out) :: is_found
      type(inputs_t) :: inputs
      real(wp) :: length, longest, before
      integer :: iteration

      call unpack_state(self%packed_a, self%state)
      self%place = self%place_a
      self%rhs(:, 1) = width*self%tangent_a
      call move_all(self, kkt, self%rhs(:, 1), self%state, self%place)
      is_found = .false.
      longest = max(merge(20.0_wp, 1.0_wp, width <= corner_step)*width, self%tolerance/self%size)
      before = huge(before)
      do iteration = 1, max_iterations
         call inputs_at(self%schedule, self%place, inputs)
         call assemble(suspension, self%state, inputs, whole_tangent, kkt)
         self%residual = kkt%rhs
         call solve_bordered(self, suspension, 0.0_wp, kkt, is_found)
         if (.not. is_found) return
         length = sqrt(inner(self, kkt, self%rhs(:, 1), self%rhs(:, 1)))
         is_found = .false.
         ! reject a correction that is not a number, as long as the step (except beyond a corner), or longer than the one before
         if (.not. ieee_is_finite(length)) return
         if (length > longest .or. 0.5_wp*length > before) return
         call move_all(self, kkt, self%rhs(:, 1), self%state, self%place)
         is_found = length*self%size <= self%tolerance
         if (is_found) return
         before = max(length, tiny(length))
      end do
   end subroutine probe

   !> Finds the unit tangent at self%state, in self%tangent, with the sense of the tangent at a. N is factorised for its inertia.
   !>
   !> If N is only the symmetric part of the true matrix, the derivative of the residual along the tangent corrects the tangent.
   subroutine find_tangent(self, suspension, kkt, is_found)
      type(arc_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(inout) :: kkt
      logical, intent(out) :: is_found
      type(inputs_t) :: inputs
      integer, parameter :: max_refinements = 8
      real(wp), parameter :: small = 1.0e-6_wp, exact = 1.0e-9_wp
      real(wp) :: length
      integer :: k

      call inputs_at(self%schedule, self%place, inputs)
      self%residual = 0.0_wp
      self%tangent = 0.0_wp
      do k = 0, merge(0, max_refinements, self%is_symmetric)
         if (k > 0) then
            call shifted_residual(small)
            self%residual = kkt%rhs
            call shifted_residual(-small)
            self%residual = (self%residual - kkt%rhs)/(2.0_wp*small)
         end if
         call assemble(suspension, self%state, inputs, whole_tangent, kkt)
         call solve_bordered(self, suspension, merge(1.0_wp, 0.0_wp, k == 0), kkt, is_found)
         if (.not. is_found) return
         length = sqrt(inner(self, kkt, self%rhs(:, 1), self%rhs(:, 1)))
         self%tangent = self%tangent + self%rhs(:, 1)
         self%tangent = self%tangent/sqrt(inner(self, kkt, self%tangent, self%tangent))
         if (k > 0 .and. length <= exact) exit
      end do
      is_found = abs(self%tangent(kkt%n + 1)) < huge(length)      ! a number
      call factorise(kkt)

   contains

      !> Computes the residual at a small distance along the tangent.
      subroutine shifted_residual(by)
         real(wp), intent(in) :: by
         type(inputs_t) :: there
         real(wp) :: place

         self%other%poses(:) = self%state%poses
         self%other%reaction(:) = self%state%reaction
         place = self%place
         self%rhs(:, 1) = by*self%tangent
         call move_all(self, kkt, self%rhs(:, 1), self%other, place)
         call inputs_at(self%schedule, place, there)
         call assemble(suspension, self%other, there, residual_only, kkt)
      end subroutine shifted_residual

   end subroutine find_tangent

   !> Solves the bordered system for self%residual and the length `along`, with the matrix of the last assembly at
   !> self%state: self%rhs(:, 1) becomes [Δz Δλ Δs].
   !> Equation (K.19) of docs/theory/kkt.md.
   subroutine solve_bordered(self, suspension, along, kkt, is_found)
      type(arc_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: along
      type(kkt_t), intent(inout) :: kkt
      logical, intent(out) :: is_found
      real(wp), parameter :: part = 1.0e-5_wp      ! of the range: the inputs are smooth, most of them linear
      type(inputs_t) :: low, high
      integer :: j, k, n, info

      call inputs_at(self%schedule, self%place - part*self%range, low)
      call inputs_at(self%schedule, self%place + part*self%range, high)
      call assemble_rate(suspension, self%state, inputs_rate(low, high, 2.0_wp*part*self%range), kkt)
      n = kkt%n
      self%matrix(:n, :n) = 0.0_wp
      associate (pattern => kkt%pattern)
         do k = 1, pattern%entries
            self%matrix(pattern%row(k), pattern%column(k)) = kkt%store(pattern%from(k))*kkt%scaling(k)
            self%matrix(pattern%column(k), pattern%row(k)) = self%matrix(pattern%row(k), pattern%column(k))
         end do
      end associate
      do j = 1, n
         self%matrix(j, n + 1) = -kkt%rhs(j)*kkt%scale(j)*self%range
         self%matrix(n + 1, j) = 0.0_wp
         if (j <= kkt%nq) self%matrix(n + 1, j) = self%tangent_a(j)*weight(j)*kkt%scale(j)
         self%rhs(j, 1) = self%residual(j)*kkt%scale(j)
      end do
      self%matrix(n + 1, n + 1) = self%tangent_a(n + 1)/self%range
      self%rhs(n + 1, 1) = along
      call dgesv(n + 1, 1, self%matrix, n + 1, self%pivots, self%rhs, n + 1, info)
      self%factorisations = self%factorisations + 1
      is_found = info == 0
      self%rhs(:n, 1) = self%rhs(:n, 1)*kkt%scale
      self%rhs(n + 1, 1) = self%rhs(n + 1, 1)*self%range

   contains

      !> The weight of unknown j in the scalar product: 1/L² for displacements, 1 for rotations.
      pure real(wp) function weight(j)
         integer, intent(in) :: j
         weight = 1.0_wp
         if (mod(j - 1, 6) < 3) weight = 1.0_wp/self%size**2
      end function weight

   end subroutine solve_bordered

   !> Moves bodies, reactions and swept value by a step.
   pure subroutine move_all(self, kkt, step, state, place)
      type(arc_t), intent(in) :: self
      type(kkt_t), intent(in) :: kkt
      real(wp), contiguous, intent(in) :: step(:)
      type(state_t), intent(inout) :: state
      real(wp), intent(inout) :: place

      state%reaction = state%reaction + step(kkt%nq + 1:kkt%n)
      call move_as_screw(state, step(:kkt%nq))
      place = place + step(size(self%rhs, 1))
   end subroutine move_all

   !> Weighted scalar product of two steps [twists; reactions; swept value] [-]: translations are divided by the size L of the
   !> model, the swept value by its range. Reactions are omitted.
   !> Equation (K.18) of docs/theory/kkt.md.
   pure real(wp) function inner(self, kkt, a, b)
      type(arc_t), intent(in) :: self
      type(kkt_t), intent(in) :: kkt
      real(wp), contiguous, intent(in) :: a(:), b(:)
      integer :: k

      inner = a(kkt%n + 1)*b(kkt%n + 1)/self%range**2
      do k = 1, kkt%nq, 6
         inner = inner + dot_product(a(k:k + 2), b(k:k + 2))/self%size**2 + dot_product(a(k + 3:k + 5), b(k + 3:k + 5))
      end do
   end function inner

   !> Finds the step from a state and its swept value to the last probe, in self%motion, and the largest displacement of the
   !> reference point of a body.
   subroutine find_motion(self, kkt, packed, place, largest)
      type(arc_t), intent(inout) :: self
      type(kkt_t), intent(in) :: kkt
      real(wp), contiguous, intent(in) :: packed(:)
      real(wp), intent(in) :: place
      real(wp), intent(out) :: largest       !! m
      integer :: k

      call unpack_state(packed, self%other)
      call motion_between(self%other, self%state, self%motion(:kkt%nq))
      self%motion(kkt%n + 1) = self%place - place
      largest = 0.0_wp
      do k = 1, kkt%nq, 6
         largest = max(largest, norm2(self%motion(k:k + 2)))
      end do
   end subroutine find_motion

end module ek_arc
