!> Checks that a step of a path ends on the branch on which it started.
!>
!> Newton's method converges to some equilibrium near its guess: beyond a lock, a limit point or a bifurcation, this
!> equilibrium may belong to another assembly or another branch. A step from state a to state b of width h is accepted only if
!>
!> - the tangents t = dz/ds = N⁻¹ ∂F/∂s at its ends agree with the motion d of the bodies from a to b (z: bodies and reactions,
!>   s: swept value, F: loads and driven values): |d − h (t_a + t_b)/2| is small against |d| (trapezoidal rule: third order in h on
!>   a smooth path);
!> - the matrix N has as many negative eigenvalues at b as at a: N is regular along a smooth path;
!> - det(Φq(a) Φq(b)ᵀ) > 0: the joints are in the same assembly mode. Where Φq loses rank, the inertia of N does not
!>   change: det N is proportional to det(Φq Φqᵀ), which has a double zero there.
!>
!> Where laws bend between a and b, the tangents with the chords of these laws must agree instead (ek_chord). If the step was halved
!> often enough, d need only lie between h t_a and h t_b, and the direction of motion of no body may change by more than 60
!> degrees. No memory is allocated after new_branch.
module ek_branch
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t, design_state, return_to_design, coordinates, unpack_state, inputs_rate, motion_between, &
      move_as_screw, largest_motion
   use ek_kkt, only: kkt_t, assemble, factorise, whole_tangent
   use ek_newton, only: outcome_t
   use ek_predictor, only: predictor_t, new_predictor, forget, remember, depth
   use ek_tangent, only: tangent_t, new_tangent, renew_tangent, find_tangent, is_bend
   use ek_motion, only: trapezoidal_rest, smooth
   use ek_chord, only: chord_t, new_chord, renew_chord, straighten, evaluate_along_chord, at_a, at_b
   use ek_factors, only: factors_t, new_factors, mark, exchange
   use ek_orientation, only: orientation_t, new_orientation, renew_orientation, compare_orientation
   implicit none(type, external)
   private
   public :: branch_t, new_branch, renew_branch, leave, compare, is_overturning, is_uneven, is_near_zero, accept
   public :: note_crossing, go_along, even, exact, zero
   public :: same_branch, crossing, doubtful

   integer, parameter :: same_branch = 1   !! the step is accepted
   integer, parameter :: crossing = 2      !! the path continues smoothly, but inertia or assembly changed: a bifurcation
   integer, parameter :: doubtful = 3      !! the tangents disagree with the step: a jump, or a step too long to decide

   real(wp), parameter :: same_place = 20.0_wp      !! closer crossings are one bifurcation: limit in widths of a step across a
                                                    !! bifurcation

   integer, parameter, public :: max_crossings = 8   !! largest number of bifurcations reported

   real(wp), parameter :: shortest = 2.5e3_wp      !! times the least step, 1e-6 of the range: shorter steps may bend without a law
   real(wp), parameter :: even = 0.3_wp            !! limit of the change of ln |det N| in a step; near a loss of rank: over 0.7
   real(wp), parameter, public :: tiny_step = 1.0e3_wp     !! times the least step: near a lock, only shorter steps are accepted
   real(wp), parameter :: zero = 9.2_wp            !! fall of ln |det N| after which 1e-4 of |det N| is left
   real(wp), parameter :: fresh = 1.0e-2_wp        !! distance from which factors give a good tangent, as a share of the motion
   real(wp), parameter :: exact = 5.0e-4_wp        !! error as a share of the motion: larger in a jump over a gap, unless the
                                                   !! step is 40 times wider than the gap
   real(wp), parameter, public :: long = 0.02_wp   !! motion that may pass over a narrow gap, as a share of the characteristic
                                                   !! length

   !> Data of a step from a to b.
   type :: step_t
      type(inputs_t) :: inputs_a, inputs_b, rate
      real(wp) :: width = 0.0_wp            !! h: swept value of b minus swept value of a
      real(wp) :: rest = 0.0_wp             !! error of the trapezoidal rule, as a share of the motion [-]
      integer :: negative_b = 0             !! negative eigenvalues of N at b
      logical :: is_explained = .false.     !! the tangents at a and b agree with the motion
      logical :: is_past = .false.          !! the step is accepted across a bend, although the tangents disagree
      logical :: is_bent = .false.          !! laws bend between a and b
      logical :: is_regular(2) = .false.    !! N at a, at b, is regular with all slopes of these laws between a and b
      logical :: is_new_at_a = .false.      !! the tangents at a are from new factors at a
   end type step_t

   !> Data of the newest state of a path and of the step compared last.
   type :: known_t
      integer :: negative = -1              !! negative eigenvalues of N at the newest state; −1: not known
      real(wp) :: log_determinant = huge(1.0_wp)   !! ln |det N| at the newest state; huge: not known
      logical :: was_uneven = .true.        !! |det N| changed by more than `even` in the step to the newest state
      logical :: has_tangent = .false.      !! tangent_a belongs to the newest state
      logical :: is_at_end = .false.        !! N at the newest state is singular to the last bit: this state has no tangent
      real(wp) :: width_before = 0.0_wp     !! swept value of a minus swept value of the state before; 0: unknown
      integer :: serial = -1                !! serial number of the last factorisation at or near b
      real(wp) :: missed = 0.0_wp           !! distance of this factorisation from b [m]
      logical :: is_singular = .false.      !! the joints lose rank at or too near to the end of the step compared last
      logical :: is_over = .false.          !! the joints are in another assembly mode at the end of the step compared last
      logical :: was_bent = .false.         !! the step compared last was accepted across a bend (the corner of a law)
      logical :: knows_end = .false.        !! tangent_b is good: it was computed with factors from near the end of the step
                                            !! compared last
      integer :: factorisations = 0         !! number of factorisations made by the last comparison
      real(wp) :: least = 0.0_wp            !! shortest step tried before the path is reported to end [swept value]
      real(wp) :: width = 0.0_wp            !! width of the step across a bifurcation [swept value]
      integer :: crossings = 0              !! number of bifurcations so far
      real(wp) :: crossing_place(max_crossings) = 0.0_wp
   end type known_t

   !> The last states of the path, data of the newest state, and work space.
   type, extends(known_t) :: branch_t
      type(predictor_t) :: predictor
      real(wp), allocatable :: tangent_a(:), tangent_b(:)  !! dz/ds: twists of the bodies and reactions per swept value
      real(wp), allocatable :: motion(:), motion_before(:) !! twists of the bodies [m, rad]: from a to b; from the state before to a
      real(wp), allocatable :: chord_a(:), chord_b(:)      !! tangents at a, at b, with the laws replaced by their chords
      real(wp), allocatable :: twist(:)                    !! twists of the bodies [m, rad]: work space of go_along
      type(orientation_t) :: orientation
      type(tangent_t) :: work
      type(chord_t) :: chord
      type(factors_t) :: factors            !! stored factors of N at the newest state
      type(state_t) :: before(2)            !! the newest state, and the state before it. One component: of two of one type, gfortran
                                            !! 12 may release only the first with an object of a class
   end type branch_t

contains

   !> An empty branch with the work space for a model.
   function new_branch(suspension) result(self)
      type(suspension_t), intent(in) :: suspension
      type(branch_t) :: self

      self%predictor = new_predictor(coordinates(suspension))
      self%orientation = new_orientation(suspension)
      self%work = new_tangent(suspension)
      self%chord = new_chord(suspension)
      self%factors = new_factors()
      allocate (self%tangent_a(suspension%unknowns() + suspension%constraints()), &
         self%tangent_b(suspension%unknowns() + suspension%constraints()), self%motion(suspension%unknowns()), &
         self%motion_before(suspension%unknowns()), self%twist(suspension%unknowns()), source=0.0_wp)
      allocate (self%chord_a(size(self%tangent_a)), self%chord_b(size(self%tangent_a)), source=0.0_wp)
      self%before(1) = design_state(suspension)
      self%before(2) = self%before(1)
   end function new_branch

   !> Renews a branch in place for other numbers of the same model. An empty branch, or a branch of another size, is created again.
   subroutine renew_branch(suspension, self)
      type(suspension_t), intent(in) :: suspension
      type(branch_t), intent(inout) :: self
      logical :: is_alike

      is_alike = allocated(self%motion)
      if (is_alike) is_alike = size(self%motion) == suspension%unknowns() .and. &
         size(self%tangent_a) == suspension%unknowns() + suspension%constraints()
      if (.not. is_alike) then
         self = new_branch(suspension)
         return
      end if
      self%known_t = known_t()
      call forget(self%predictor)
      call renew_orientation(suspension, self%orientation)
      call renew_tangent(suspension, self%work)
      call renew_chord(suspension, self%chord)
      call mark(self%factors, -1)
      call return_to_design(suspension, self%before(1))
      call return_to_design(suspension, self%before(2))
      self%tangent_a(:) = 0.0_wp
      self%tangent_b(:) = 0.0_wp
      self%motion_before(:) = 0.0_wp
      self%chord_a(:) = 0.0_wp
      self%chord_b(:) = 0.0_wp
   end subroutine renew_branch

   !> Continues from another state, of which the tangent and the factors are unknown. The inertia of this
   !> state may be known.
   pure subroutine leave(self, place, packed, negative)
      type(branch_t), intent(inout) :: self
      real(wp), intent(in) :: place                 !! swept value of this state
      real(wp), contiguous, intent(in) :: packed(:)
      integer, intent(in) :: negative               !! −1: not known

      call forget(self%predictor)
      call remember(self%predictor, place, packed)
      self%negative = negative
      self%has_tangent = .false.
      self%is_at_end = .false.
      self%log_determinant = huge(1.0_wp)
      call mark(self%factors, -1)
   end subroutine leave

   !> Compares both ends of a step. kkt must contain the factors of N at or near b.
   !>
   !> `compare` first uses these factors and a tangent at a that may be old. If the step disagrees with them, it uses new factors
   !> and a new tangent. On return, self%tangent_b is the tangent at b. `accept` stores this tangent for the newest state if the
   !> factors are from near b.
   !> Equation (K.15) of docs/theory/kkt.md: three states and the tangent at b, as long as the tangent at a is not known.
   subroutine compare(self, suspension, inputs_a, inputs_b, place, state_b, outcome, kkt, verdict)
      type(branch_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(inputs_t), intent(in) :: inputs_a, inputs_b
      real(wp), intent(in) :: place                          !! swept value of b
      type(state_t), intent(in) :: state_b
      type(outcome_t), intent(in) :: outcome                 !! of the iteration to b
      type(kkt_t), intent(inout) :: kkt
      integer, intent(out) :: verdict
      type(step_t) :: step
      real(wp) :: width, bow
      logical :: is_found
      integer :: older

      width = place - self%predictor%abscissa(self%predictor%newest)
      step = step_t(inputs_a, inputs_b, inputs_rate(inputs_a, inputs_b, width), width, huge(width), kkt%negative)
      self%factorisations = 0
      self%serial = kkt%factorisations
      self%missed = outcome%missed
      self%is_over = .false.
      self%is_singular = .false.
      call unpack_state(self%predictor%packed(:, self%predictor%newest), self%before(1))
      call motion_between(self%before(1), state_b, self%motion)
      older = modulo(self%predictor%newest - 2, depth) + 1
      self%width_before = 0.0_wp
      if (self%predictor%count > 1) &
         self%width_before = self%predictor%abscissa(self%predictor%newest) - self%predictor%abscissa(older)
      if (abs(self%width_before) > 0.0_wp .and. .not. self%has_tangent) then
         call unpack_state(self%predictor%packed(:, older), self%before(2))
         call motion_between(self%before(2), self%before(1), self%motion_before)
      end if
      call find_tangent(self%work, suspension, state_b, inputs_b, step%rate, kkt, self%tangent_b, is_found)
      verdict = doubtful
      if (.not. is_found) return
      if (self%is_at_end) then
         step%rest = huge(step%rest)
      else if (self%has_tangent) then
         step%rest = trapezoidal_rest(self%motion, self%tangent_a, self%tangent_b, width, kkt%length)
      else if (abs(self%width_before) > 0.0_wp) then
         ! with this tangent at a, the error of the trapezoidal rule is that of the parabola
         bow = width/(width + self%width_before)
         self%tangent_a(:kkt%nq) = self%tangent_b(:kkt%nq) &
            + (2.0_wp*bow)*(self%motion_before/self%width_before - self%motion/width)
         step%rest = trapezoidal_rest(self%motion, self%tangent_a, self%tangent_b, width, kkt%length)
         ! the step to a approximates its tangent
         if (step%rest > smooth) self%tangent_a(:kkt%nq) = self%motion_before/self%width_before
      end if
      step%is_explained = step%rest <= smooth
      if (.not. step%is_explained) call evaluate_closer(self, step, suspension, state_b, kkt)
      if (step%is_explained .or. step%is_past) then
         verdict = same_branch
         if (step%negative_b /= self%negative) then
            verdict = crossing
         else if (step%rest > exact .or. is_uneven(self, outcome) .or. &
            largest_motion(self%motion, kkt%length) > long*kkt%length) then
            call compare_orientation(self%orientation, suspension, self%before(1)%poses, state_b%poses, kkt%scale, self%is_over, &
               self%is_singular)
            if (self%is_over) verdict = crossing
            if (self%is_singular .and. abs(width) > tiny_step*self%least) verdict = doubtful
         end if
      end if
      kkt%negative = step%negative_b
      self%was_bent = step%is_past
      self%knows_end = self%missed <= fresh*largest_motion(self%motion, kkt%length)
   end subroutine compare

   !> Evaluates a step in full, with the parts that the first evaluation omits: the tangent at a, the chords of bent laws, and new
   !> factors at b. Ends as soon as the step is accepted.
   subroutine evaluate_closer(self, step, suspension, state_b, kkt)
      type(branch_t), intent(inout) :: self
      type(step_t), intent(inout) :: step
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state_b
      type(kkt_t), intent(inout) :: kkt          !! factors at or near b
      logical :: knows_a, is_found

      call straighten(self%chord, suspension, self%before(1), state_b, step%is_bent)
      knows_a = self%negative >= 0 .and. self%factors%is_kept
      if (knows_a) then
         call exchange(self%factors, kkt)
         call evaluate_beginning(self, step, suspension, .false., kkt)
         call exchange(self%factors, kkt)
         if (step%is_explained) return
      end if
      if (step%is_bent) call evaluate_along_chord(self%chord, suspension, self%work, at_b, state_b, step%inputs_b, step%rate, kkt, &
         self%chord_b, step%is_regular(at_b))
      if (knows_a) call decide(self, step, kkt%length)
      if (step%is_past) return
      if (self%negative < 0) call evaluate_beginning(self, step, suspension, .true., kkt)
      if (abs(step%width) <= shortest*self%least .and. .not. self%is_at_end .and. &
         (self%has_tangent .or. abs(self%width_before) > 0.0_wp)) &
         step%is_past = is_bend(self%motion, self%tangent_a, self%tangent_b, step%width, kkt%length)
      if (step%is_past) return
      if (.not. step%is_new_at_a) call evaluate_beginning(self, step, suspension, .true., kkt)
      call decide(self, step, kkt%length)
      if (step%is_explained .or. step%is_past) return
      call assemble(suspension, state_b, step%inputs_b, whole_tangent, kkt)
      call factorise(kkt)
      step%negative_b = kkt%negative
      self%factorisations = self%factorisations + 1
      self%serial = kkt%factorisations
      self%missed = 0.0_wp
      call find_tangent(self%work, suspension, state_b, step%inputs_b, step%rate, kkt, self%tangent_b, is_found)
      if (.not. is_found) return
      if (step%is_bent) call evaluate_along_chord(self%chord, suspension, self%work, at_b, state_b, step%inputs_b, step%rate, kkt, &
         self%chord_b, step%is_regular(at_b))
      call decide(self, step, kkt%length)
   end subroutine evaluate_closer

   !> Evaluates the tangent at a. If this tangent does not explain the step, also evaluates the tangent along the chords of bent
   !> laws.
   subroutine evaluate_beginning(self, step, suspension, is_anew, kkt)
      type(branch_t), intent(inout) :: self
      type(step_t), intent(inout) :: step
      type(suspension_t), intent(in) :: suspension
      logical, intent(in) :: is_anew             !! from new factors at a, not from the current factors
      type(kkt_t), intent(inout) :: kkt

      if (is_anew) then
         call assemble(suspension, self%before(1), step%inputs_a, whole_tangent, kkt)
         call factorise(kkt)
         self%factorisations = self%factorisations + 1
         self%negative = kkt%negative
         step%is_new_at_a = .true.
      end if
      call find_tangent(self%work, suspension, self%before(1), step%inputs_a, step%rate, kkt, self%tangent_a, self%has_tangent)
      self%is_at_end = .not. self%has_tangent
      step%rest = huge(step%rest)
      step%is_regular(at_a) = .false.
      step%is_explained = .false.
      if (self%is_at_end) return
      step%rest = trapezoidal_rest(self%motion, self%tangent_a, self%tangent_b, step%width, kkt%length)
      step%is_explained = step%rest <= smooth
      if (step%is_bent .and. .not. step%is_explained) call evaluate_along_chord(self%chord, suspension, self%work, at_a, &
         self%before(1), step%inputs_a, step%rate, kkt, self%chord_a, step%is_regular(at_a))
   end subroutine evaluate_beginning

   !> Decides whether the tangents agree with the motion. If the tangents do not agree, decides whether the tangents along the
   !> chords of bent laws agree, N stays regular, and N has as many negative eigenvalues at b as at a.
   pure subroutine decide(self, step, length)
      type(branch_t), intent(in) :: self
      type(step_t), intent(inout) :: step
      real(wp), intent(in) :: length             !! m

      if (self%is_at_end) return
      step%rest = trapezoidal_rest(self%motion, self%tangent_a, self%tangent_b, step%width, length)
      step%is_explained = step%rest <= smooth
      if (step%is_explained .or. .not. step%is_bent) return
      step%is_past = all(step%is_regular) .and. step%negative_b == self%negative .and. &
         trapezoidal_rest(self%motion, self%chord_a, self%chord_b, step%width, length) <= smooth
   end subroutine decide

   !> Accepts the step: b becomes the newest state.
   pure subroutine accept(self, outcome, kkt, was_compared)
      type(branch_t), intent(inout) :: self
      type(outcome_t), intent(in) :: outcome     !! of the iteration to b
      type(kkt_t), intent(in) :: kkt             !! factors at or near b, unless the step was compared
      logical, intent(in) :: was_compared

      if (.not. was_compared) self%serial = kkt%factorisations
      call mark(self%factors, self%serial)
      self%was_uneven = abs(outcome%log_determinant - self%log_determinant) > even
      self%log_determinant = outcome%log_determinant
      self%negative = outcome%negative
      self%is_at_end = .false.
      self%has_tangent = was_compared .and. self%knows_end
      if (self%has_tangent) self%tangent_a = self%tangent_b
   end subroutine accept

   !> Whether the joints may lose rank in a step. |det N| is proportional to det(Φq Φqᵀ) and changes much on the way to zero: in
   !> this step, or in the step before. For two states on either side of the zero the result has no meaning.
   pure logical function is_uneven(self, outcome)
      type(branch_t), intent(in) :: self
      type(outcome_t), intent(in) :: outcome     !! of the iteration to b
      is_uneven = self%was_uneven .or. abs(outcome%log_determinant - self%log_determinant) > even
   end function is_uneven

   !> Whether N at b is nearly singular in comparison with N at a.
   pure logical function is_near_zero(self, outcome)
      type(branch_t), intent(in) :: self
      type(outcome_t), intent(in) :: outcome     !! of the iteration to b
      is_near_zero = self%log_determinant < huge(1.0_wp) .and. outcome%log_determinant < self%log_determinant - zero
   end function is_near_zero

   !> Extrapolates from the newest state along its tangent.
   pure subroutine go_along(self, place, state)
      type(branch_t), intent(inout) :: self
      real(wp), intent(in) :: place
      type(state_t), intent(inout) :: state
      real(wp) :: width
      integer :: nq

      nq = size(self%motion)
      call unpack_state(self%predictor%packed(:, self%predictor%newest), state)
      width = place - self%predictor%abscissa(self%predictor%newest)
      state%reaction = state%reaction + width*self%tangent_a(nq + 1:)
      self%twist = width*self%tangent_a(:nq)
      call move_as_screw(state, self%twist)
   end subroutine go_along

   !> Records a bifurcation at a swept value, unless the last record is within `same_place` widths. With max_crossings records, the
   !> last record is replaced.
   pure subroutine note_crossing(self, place)
      type(branch_t), intent(inout) :: self
      real(wp), intent(in) :: place

      if (self%crossings > 0) then
         if (abs(place - self%crossing_place(self%crossings)) <= same_place*self%width) return
      end if
      self%crossings = min(self%crossings + 1, max_crossings)
      self%crossing_place(self%crossings) = place
   end subroutine note_crossing

   !> Whether the assembly mode of the joints changes in a predicted step that was not compared. Also .true. if the joints lose
   !> rank at the end of the step, where the mode cannot be determined.
   logical function is_overturning(self, suspension, state_b, scale)
      type(branch_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state_b
      real(wp), intent(in) :: scale(:)                       !! D of ek_scale
      logical :: is_singular

      call unpack_state(self%predictor%packed(:, self%predictor%newest), self%before(1))
      call compare_orientation(self%orientation, suspension, self%before(1)%poses, state_b%poses, scale, is_overturning, &
         is_singular)
      is_overturning = is_overturning .or. is_singular
   end function is_overturning

end module ek_branch
