!> Checks that a step of a path ends on the branch on which it started.
!>
!> Newton's method converges to some equilibrium near its guess: beyond a lock, a limit point or a bifurcation this is
!> another assembly or another branch. A step from state a to state b of width h is accepted only if
!>
!> - the tangents dz/ds = N⁻¹ dF/ds at its ends agree with the motion d of the bodies from a to b:
!>   |d − h (t_a + t_b)/2| is small against |d| (trapezoidal rule: third order in h on a smooth path);
!> - the matrix N has as many negative eigenvalues at b as at a: N is regular along a smooth path;
!> - det(Φq(a) Φq(b)ᵀ) > 0: the joints are in the same assembly. Where Φq loses rank, the inertia of N does not
!>   change: its determinant is proportional to the square of that of Φq.
!>
!> A law with a corner bends the path. If a law has a corner between a and b, or if the step was halved often enough,
!> d need only lie between h t_a and h t_b, and the direction of motion of no body may change by more than 60 degrees. No
!> memory is allocated after new_branch.
module ek_branch
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, demand_t, design_state, unpack_state, demand_rate, motion_between, move_as_screw
   use ek_kkt, only: kkt_t, assemble, assemble_rate, factorise, solve, whole_tangent, residual_only
   use ek_law, only: steep, corner
   use ek_bent_law, only: sharpest_bend
   use ek_orientation, only: orientation_t, new_orientation, is_turned_over
   implicit none(type, external)
   private
   public :: branch_t, new_branch, leave, largest_motion, compare, is_overturning, accept, note_crossing, go_along
   public :: same_branch, crossing, doubtful

   integer, parameter :: same_branch = 1   !! the step is accepted
   integer, parameter :: crossing = 2      !! the path continues smoothly, but inertia or assembly changed: a bifurcation
   integer, parameter :: doubtful = 3      !! the tangents disagree with the step: a jump, or a step too long to decide

   integer, parameter, public :: most_crossings = 8   !! largest number of bifurcations reported

   real(wp), parameter :: smooth = 4.0e-3_wp       !! of the motion: allowed error of the trapezoidal rule
   real(wp), parameter :: nothing = 1.0e-9_wp      !! m: ten times the error of Newton's method
   real(wp), parameter :: bent = 5.0e-2_wp         !! likewise at a corner of a law
   real(wp), parameter :: slight = 5.0e-2_wp       !! likewise if the rubber of a stop is steep
   !> Of the least step, 1/8 of the range: no corner is accepted in longer steps
   real(wp), parameter :: widest_corner = 3.125e8_wp
   real(wp), parameter :: fresh = 1.0e-2_wp        !! likewise: factors from no further away give a good tangent
   real(wp), parameter :: exact = 5.0e-4_wp        !! likewise: a jump across a gap exceeds it unless the step is forty times wider
   real(wp), parameter, public :: long = 0.02_wp   !! of the characteristic length: a motion that may pass over a narrow gap
   real(wp), parameter :: takes_part = 5.0e-2_wp   !! of the largest motion: bodies whose direction is checked
   real(wp), parameter :: least_cosine = 0.5_wp    !! between the directions of a body at both ends of a bend

   !> Data of the newest state of the path, and work space.
   type :: branch_t
      integer :: negative = -1              !! negative eigenvalues of N there; −1: not known
      logical :: has_tangent = .false.      !! tangent_a is that of the newest state
      real(wp), allocatable :: tangent_a(:), tangent_b(:)  !! dz/ds: twists of the bodies and reactions per place
      real(wp), allocatable :: motion(:), motion_before(:) !! twists of the bodies from a to b, and from the state before to a [m, rad]
      real(wp) :: width_before = 0.0_wp     !! place of a minus place of the state before; 0: not known
      type(orientation_t) :: orientation
      real(wp), allocatable :: twist(:)                    !! of the bodies, where one is handed on [m, rad]
      real(wp), allocatable :: whole(:), defect(:)         !! [Δq; Δλ] per place, and a right-hand side
      logical :: is_symmetric = .true.      !! no load makes the tangent unsymmetric
      type(state_t) :: before, shifted
      logical :: was_bent = .false.         !! the step compared last passes a corner of a law
      logical :: knows_end = .false.        !! tangent_b belongs to the state evaluated last
      integer :: factorisations = 0         !! number needed by the last comparison
      real(wp) :: least = 0.0_wp            !! shortest step tried before the path is reported to end [place]
      real(wp) :: width = 0.0_wp            !! width of the step across a bifurcation [place]
      integer :: crossings = 0              !! bifurcations met so far
      real(wp) :: crossing_place(most_crossings) = 0.0_wp
   end type branch_t

contains

   !> Allocates the work space for a model.
   function new_branch(suspension) result(self)
      type(suspension_t), intent(in) :: suspension
      type(branch_t) :: self
      integer :: k

      self%orientation = new_orientation(suspension)
      allocate (self%tangent_a(suspension%unknowns() + suspension%constraints()), &
         self%tangent_b(suspension%unknowns() + suspension%constraints()), self%motion(suspension%unknowns()), &
         self%motion_before(suspension%unknowns()), self%twist(suspension%unknowns()), source=0.0_wp)
      allocate (self%whole(suspension%unknowns() + suspension%constraints()), &
         self%defect(suspension%unknowns() + suspension%constraints()), source=0.0_wp)
      self%before = design_state(suspension)
      self%shifted = self%before
      do k = 1, size(suspension%loads)
         if (suspension%loads(k)%follows .or. norm2(suspension%loads(k)%moment) > 0.0_wp) self%is_symmetric = .false.
      end do
   end function new_branch

   !> Continues from another state, of which only the inertia may be known.
   pure subroutine leave(self, negative)
      type(branch_t), intent(inout) :: self
      integer, intent(in) :: negative     !! −1: not known

      self%negative = negative
      self%has_tangent = .false.
   end subroutine leave

   !> The largest |Δr|, or |Δπ| × characteristic length, of any body [m].
   pure real(wp) function largest_motion(motion, length)
      real(wp), contiguous, intent(in) :: motion(:)    !! twists
      real(wp), intent(in) :: length                   !! m
      integer :: k

      largest_motion = 0.0_wp
      do k = 1, size(motion), 6
         largest_motion = max(largest_motion, body_motion(motion(k:k + 5), length))
      end do
   end function largest_motion

   !> The same for one body.
   pure real(wp) function body_motion(twist, length)
      real(wp), intent(in) :: twist(6), length
      body_motion = sqrt(max(sum(twist(1:3)**2), length**2*sum(twist(4:6)**2)))
   end function body_motion

   !> Compares both ends of a step. kkt must contain the factors of N at or near b.
   !>
   !> It first uses these factors and a tangent at a that may be old; if the step disagrees with them, new ones. On
   !> return self%tangent_b belongs to b; `accept` makes it that of the newest state.
   subroutine compare(self, suspension, packed_a, demand_a, demand_b, width, packed_before, width_before, state_b, &
      is_short, missed, kkt, verdict)
      type(branch_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      real(wp), contiguous, intent(in) :: packed_a(:)        !! state a
      type(demand_t), intent(in) :: demand_a, demand_b
      real(wp), intent(in) :: width                          !! h: place of b minus place of a
      real(wp), contiguous, intent(in) :: packed_before(:)   !! the state before a
      real(wp), intent(in) :: width_before                   !! place of a minus place of the state before; 0: there is none
      type(state_t), intent(in) :: state_b
      logical, intent(in) :: is_short                        !! halved often enough for a bend
      real(wp), intent(in) :: missed                         !! distance from b at which the factors were computed [m]
      type(kkt_t), intent(inout) :: kkt
      integer, intent(out) :: verdict
      type(demand_t) :: rate
      integer :: negative_b
      real(wp) :: rest, allowed
      integer :: bend
      logical :: is_explained

      rate = demand_rate(demand_a, demand_b, width)
      negative_b = kkt%negative
      self%factorisations = 0
      call unpack_state(packed_a, self%before)
      call motion_between(self%before, state_b, self%motion)
      self%width_before = width_before
      if (abs(width_before) > 0.0_wp .and. .not. self%has_tangent) then
         call unpack_state(packed_before, self%shifted)
         call motion_between(self%shifted, self%before, self%motion_before)
      end if
      call find_tangent(self, suspension, state_b, demand_b, rate, kkt, self%tangent_b)
      if (self%has_tangent) then
         rest = trapezoidal_rest(self, kkt%nq, width, kkt%length)
      else
         rest = three_point_rest(self, kkt%nq, width, kkt%length)
         ! the step to a approximates its tangent
         if (rest > smooth .and. abs(width_before) > 0.0_wp) self%tangent_a(:kkt%nq) = self%motion_before/width_before
      end if
      is_explained = rest <= smooth
      allowed = 0.0_wp
      if (.not. is_explained) then
         bend = sharpest_bend(suspension, self%before, state_b)
         if (bend == steep) allowed = slight
         if (is_short .or. (bend == corner .and. abs(width) <= widest_corner*self%least)) allowed = huge(allowed)
         if (rest <= allowed .and. (self%has_tangent .or. abs(width_before) > 0.0_wp)) &
            is_explained = is_bend(self, width, kkt%length)
      end if
      if (.not. (is_explained .or. self%has_tangent)) then
         call at_beginning()
         rest = trapezoidal_rest(self, kkt%nq, width, kkt%length)
         is_explained = rest <= smooth
         if (rest <= allowed .and. .not. is_explained) is_explained = is_bend(self, width, kkt%length)
      end if
      if (.not. is_explained) then
         call assemble(suspension, state_b, demand_b, whole_tangent, kkt)
         call factorise(kkt)
         negative_b = kkt%negative
         call find_tangent(self, suspension, state_b, demand_b, rate, kkt, self%tangent_b)
         if (self%factorisations == 0) call at_beginning()
         self%factorisations = self%factorisations + 1
         rest = trapezoidal_rest(self, kkt%nq, width, kkt%length)
         is_explained = rest <= smooth
         if (.not. is_explained .and. rest <= allowed) is_explained = is_bend(self, width, kkt%length)
      end if
      verdict = doubtful
      if (is_explained) then
         verdict = same_branch
         if (negative_b /= self%negative) then
            verdict = crossing
         else if (rest > exact .or. largest_motion(self%motion, kkt%length) > long*kkt%length) then
            if (is_turned_over(self%orientation, suspension, self%before, state_b, demand_a, demand_b, kkt)) verdict = crossing
         end if
      end if
      kkt%negative = negative_b
      self%was_bent = is_explained .and. rest > smooth
      self%knows_end = self%factorisations > 1 .or. missed <= fresh*largest_motion(self%motion, kkt%length)

   contains

      !> The tangent at a, from new factors at a.
      subroutine at_beginning()
         call assemble(suspension, self%before, demand_a, whole_tangent, kkt)
         call factorise(kkt)
         self%negative = kkt%negative
         call find_tangent(self, suspension, self%before, demand_a, rate, kkt, self%tangent_a)
         self%factorisations = self%factorisations + 1
         self%has_tangent = .true.
      end subroutine at_beginning

   end subroutine compare

   !> dz/ds = N⁻¹ dF/ds at a state, with the current factors; the part for the bodies.
   !>
   !> With a constant moment, a load that rotates with its body, or the imbalance at design, the true matrix is not
   !> symmetric and N is its symmetric part. The derivative of the residual along the tangent then corrects it.
   !> Equation (K.13) of docs/theory/kkt.md.
   subroutine find_tangent(self, suspension, state, demand, rate, kkt, tangent)
      type(branch_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(demand_t), intent(in) :: demand, rate
      type(kkt_t), intent(inout) :: kkt
      real(wp), intent(out) :: tangent(:)
      integer, parameter :: most_refinements = 6
      real(wp), parameter :: small_motion = 1.0e-6_wp     ! of the characteristic length: the difference's step
      real(wp) :: step, largest
      integer :: k

      call assemble_rate(suspension, state, rate, kkt)
      call solve(kkt)
      self%whole = kkt%rhs
      if (self%is_symmetric .and. .not. abs(rate%relief) > 0.0_wp) then
         tangent = self%whole
         return
      end if
      do k = 1, most_refinements
         largest = largest_motion(self%whole(:kkt%nq), kkt%length)
         if (.not. (largest > 0.0_wp .and. largest < huge(largest))) exit
         step = small_motion*kkt%length/largest
         call shifted_residual(step)
         self%defect = kkt%rhs
         call shifted_residual(-step)
         self%defect = (self%defect - kkt%rhs)/(2.0_wp*step)
         call assemble_rate(suspension, state, rate, kkt)
         kkt%rhs = kkt%rhs + self%defect
         call solve(kkt)
         self%whole = self%whole + kkt%rhs
         if (largest_motion(kkt%rhs(:kkt%nq), kkt%length) <= 0.1_wp*smooth*largest) exit
      end do
      tangent = self%whole

   contains

      !> The residual at a small distance along the tangent, with the same inputs.
      subroutine shifted_residual(distance)
         real(wp), intent(in) :: distance     !! place

         self%shifted = state
         self%shifted%reaction = state%reaction + distance*self%whole(kkt%nq + 1:)
         self%twist = distance*self%whole(:kkt%nq)
         call move_as_screw(self%shifted, self%twist)
         call assemble(suspension, self%shifted, demand, residual_only, kkt)
      end subroutine shifted_residual

   end subroutine find_tangent

   !> Accepts the step: b becomes the newest state.
   pure subroutine accept(self, negative, was_compared)
      type(branch_t), intent(inout) :: self
      integer, intent(in) :: negative            !! negative eigenvalues of N at b
      logical, intent(in) :: was_compared

      self%negative = negative
      self%has_tangent = was_compared .and. self%knows_end
      if (self%has_tangent) self%tangent_a = self%tangent_b
   end subroutine accept

   !> Extrapolates from the newest state along its tangent.
   pure subroutine go_along(self, width, state)
      type(branch_t), intent(inout) :: self
      real(wp), intent(in) :: width              !! place
      type(state_t), intent(inout) :: state      !! the newest → the guess
      integer :: nq

      nq = size(self%motion)
      state%reaction = state%reaction + width*self%tangent_a(nq + 1:)
      self%twist = width*self%tangent_a(:nq)
      call move_as_screw(state, self%twist)
   end subroutine go_along

   !> Records a bifurcation at a swept value.
   pure subroutine note_crossing(self, place)
      type(branch_t), intent(inout) :: self
      real(wp), intent(in) :: place

      self%crossings = min(self%crossings + 1, most_crossings)
      self%crossing_place(self%crossings) = place
   end subroutine note_crossing

   !> The error of the trapezoidal rule as a share of the motion; huge if it is not a number.
   !> Equation (K.14) of docs/theory/kkt.md.
   pure real(wp) function trapezoidal_rest(self, nq, width, length) result(rest)
      type(branch_t), intent(in) :: self
      integer, intent(in) :: nq
      real(wp), intent(in) :: width, length
      real(wp) :: twist(6), part
      integer :: k

      rest = 0.0_wp
      do k = 1, nq, 6
         twist = self%motion(k:k + 5) - 0.5_wp*width*(self%tangent_a(k:k + 5) + self%tangent_b(k:k + 5))
         part = body_motion(twist, length)
         if (.not. part < huge(rest)) part = huge(rest)
         rest = max(rest, part)
      end do
      if (rest <= nothing*smooth) then
         rest = 0.0_wp
      else if (rest < huge(rest)) then
         rest = rest/max(largest_motion(self%motion, length), nothing)
      end if
   end function trapezoidal_rest

   !> The same for the parabola through the state before a, a and b: the difference of its slope at b from the tangent there.
   !> Equation (K.15) of docs/theory/kkt.md.
   pure real(wp) function three_point_rest(self, nq, width, length) result(rest)
      type(branch_t), intent(in) :: self
      integer, intent(in) :: nq
      real(wp), intent(in) :: width, length
      real(wp) :: twist(6), part, bow
      integer :: k

      rest = huge(rest)
      if (.not. abs(self%width_before) > 0.0_wp) return
      rest = 0.0_wp
      bow = width/(width + self%width_before)
      do k = 1, nq, 6
         twist = (1.0_wp + bow)*self%motion(k:k + 5) - (bow*width/self%width_before)*self%motion_before(k:k + 5) &
            - width*self%tangent_b(k:k + 5)
         part = body_motion(twist, length)
         if (.not. part < huge(rest)) part = huge(rest)
         rest = max(rest, part)
      end do
      if (rest < huge(rest)) rest = rest/max(largest_motion(self%motion, length), nothing)
   end function three_point_rest

   !> Whether the motion lies between the tangents at both ends and no body changes direction.
   pure logical function is_bend(self, width, length)
      type(branch_t), intent(in) :: self
      real(wp), intent(in) :: width, length
      real(wp) :: share, rest, along, square, twist(6), change(6), scale(6), largest, a, b
      integer :: k

      is_bend = .false.
      scale = [1.0_wp, 1.0_wp, 1.0_wp, length, length, length]
      largest = largest_motion(self%motion, length)
      along = 0.0_wp
      square = 0.0_wp
      do k = 1, size(self%motion), 6
         twist = (self%motion(k:k + 5) - width*self%tangent_b(k:k + 5))*scale
         change = width*(self%tangent_a(k:k + 5) - self%tangent_b(k:k + 5))*scale
         along = along + dot_product(twist, change)
         square = square + dot_product(change, change)
      end do
      if (.not. square < huge(square)) return
      share = 0.5_wp
      if (square > 0.0_wp) share = min(max(along/square, 0.0_wp), 1.0_wp)
      rest = 0.0_wp
      do k = 1, size(self%motion), 6
         twist = self%motion(k:k + 5) - width*(share*self%tangent_a(k:k + 5) + (1.0_wp - share)*self%tangent_b(k:k + 5))
         rest = max(rest, body_motion(twist, length))
         if (body_motion(self%motion(k:k + 5), length) < takes_part*largest) cycle
         a = norm2(self%tangent_a(k:k + 5)*scale)
         b = norm2(self%tangent_b(k:k + 5)*scale)
         if (dot_product(self%tangent_a(k:k + 5)*scale, self%tangent_b(k:k + 5)*scale) < least_cosine*a*b) return
      end do
      is_bend = rest <= bent*largest
   end function is_bend

   !> Whether the assembly of the joints changes in a predicted step that was not passed to `compare`.
   logical function is_overturning(self, suspension, packed_a, demand_a, state_b, demand_b, kkt)
      type(branch_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      real(wp), contiguous, intent(in) :: packed_a(:)
      type(demand_t), intent(in) :: demand_a, demand_b
      type(state_t), intent(in) :: state_b
      type(kkt_t), intent(inout) :: kkt

      call unpack_state(packed_a, self%before)
      is_overturning = is_turned_over(self%orientation, suspension, self%before, state_b, demand_a, demand_b, kkt)
   end function is_overturning

end module ek_branch
