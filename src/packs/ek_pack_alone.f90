!> Steps of one design of a pack without the other designs: for a state that the pack does not find, and for checks of a single
!> design.
module ek_pack_alone
   use ek_kinds, only: wp
   use ek_lanes, only: lanes_t, lanes
   use ek_state, only: inputs_t, unpack_state
   use ek_schedule, only: inputs_at
   use ek_kkt, only: kkt_t, assemble, factorise, whole_tangent
   use ek_kkt_system, only: held, plan_factors
   use ek_factors, only: mark, keep
   use ek_path_states, only: path_t, span
   use ek_path, only: suspect, min_step, crossing_step
   use ek_newton, only: outcome_t
   use ek_reach, only: failure_t, reach
   use ek_branch, only: renew_branch, leave
   use ek_orientation, only: compare_orientation
   use ek_predictor, only: predictor_t, remember, forget, judge, depth
   use ek_pack, only: pack_t
   use ek_walker, only: walker_t, member_t, place_t
   implicit none(type, external)
   private
   public :: step_alone, is_same_assembly, learn

contains

   !> Solves the next state of one design as the sweep of a single design does, with the scale of the pack. If the pack has found an
   !> equilibrium, this equilibrium is judged first, with the factors of the pack.
   subroutine step_alone(self, member, place, outcome, lane, k, direction)
      type(walker_t), intent(inout) :: self
      type(member_t), intent(inout) :: member
      type(place_t), intent(inout) :: place
      type(outcome_t), intent(in) :: outcome     !! outcome of the iteration in the pack
      integer, intent(in) :: lane, k, direction
      type(failure_t) :: failure
      type(inputs_t) :: inputs
      logical :: has_factors
      integer :: body

      self%steps_alone = self%steps_alone + 1
      call refresh(self, member, lane)
      call exchange_scales(self%pack, member%kkt)
      associate (path => member%path, branch => self%branch(lane), kkt => member%kkt)
         call leave(branch, path%value(k - direction), path%packed(:, k - direction), place%negative)
         call recall(branch%predictor, path, k, direction, place%trusted)
         branch%log_determinant = place%log_determinant
         branch%was_uneven = place%was_uneven
         branch%least = min_step*span(path)
         branch%width = crossing_step*span(path)
         branch%crossings = 0
         has_factors = has_plan_of(self%pack, kkt)
         if (has_factors .and. place%knows_factors) then
            call take_factors(self%pack%factors_before, lane, place%negative, kkt)
            call mark(branch%factors, kkt%factorisations)
            call keep(branch%factors, kkt)
         end if
         if (outcome%is_converged) then
            call take_state(self, lane)
            self%state%reaction(:) = self%pack%reaction%v(lane)
            branch%predictor%guess(:) = self%pack%guess%v(lane)
            if (has_factors) then
               call take_factors(self%pack%factors, lane, outcome%negative, kkt)
            else
               call inputs_at(place%schedule, path%value(k), inputs)
               call assemble(member%suspension, self%state, inputs, whole_tangent, kkt)
               call factorise(kkt)
            end if
            kkt%pivot_ratio = outcome%pivot_ratio
            call reach(member%suspension, place%schedule, path%value(k), member%case%tolerance, branch, self%state, kkt, &
               path%iterations(k), failure, outcome)
         else
            call unpack_state(path%packed(:, k - direction), self%state)
            call reach(member%suspension, place%schedule, path%value(k), member%case%tolerance, branch, self%state, kkt, &
               path%iterations(k), failure)
         end if
         call exchange_scales(self%pack, kkt)
         member%is_walked = failure%state == 0 .and. branch%crossings == 0 .and. kkt%pivot_ratio > suspect
         if (.not. member%is_walked) return
         place%trusted = branch%predictor%trusted
         place%negative = branch%negative
         place%log_determinant = branch%log_determinant
         place%was_uneven = branch%was_uneven
         path%is_reached(k) = .true.
         path%is_stable(k) = kkt%negative == kkt%nc
         path%pivot_ratio(k) = kkt%pivot_ratio
         do body = 1, self%pack%bodies + 1
            self%pack%poses(body)%r%v(lane) = self%state%poses(body)%r
            self%pack%poses(body)%q%v(lane) = self%state%poses(body)%q
            self%pack%poses(body)%a%v(lane) = self%state%poses(body)%a
         end do
         self%pack%reaction%v(lane) = self%state%reaction
      end associate
   end subroutine step_alone

   !> Exchanges the scale of the pack and the scale of a design.
   pure subroutine exchange_scales(pack, kkt)
      type(pack_t), intent(inout) :: pack
      type(kkt_t), intent(inout) :: kkt
      real(wp), allocatable :: scale(:)

      call move_alloc(pack%scale, scale)
      call move_alloc(kkt%scale, pack%scale)
      call move_alloc(scale, kkt%scale)
      call move_alloc(pack%scaling, scale)
      call move_alloc(kkt%scaling, pack%scaling)
      call move_alloc(scale, kkt%scaling)
   end subroutine exchange_scales

   !> Whether the system of a design is factorised by the plan of the pack.
   pure logical function has_plan_of(pack, kkt) result(has)
      type(pack_t), intent(in) :: pack
      type(kkt_t), intent(in) :: kkt

      has = kkt%has_plan
      if (has) has = kkt%plan(held)%length == pack%plan%length .and. size(kkt%plan(held)%slot) == size(pack%plan%slot)
      if (has) has = all(kkt%plan(held)%slot == pack%plan%slot)
   end function has_plan_of

   !> Copies the factors of a design in the pack to the system of the design.
   pure subroutine take_factors(factors, lane, negative, kkt)
      type(lanes_t), intent(in) :: factors(:)
      integer, intent(in) :: lane, negative                !! number of negative eigenvalues
      type(kkt_t), intent(inout) :: kkt                    !! system of the design, for which has_plan_of is .true.
      integer :: k

      do k = 1, size(factors)
         kkt%planned(k) = factors(k)%v(lane)
      end do
      kkt%stage = plan_factors
      kkt%way = held
      kkt%negative = negative
      kkt%is_singular = .false.
      kkt%is_at_design = .false.
      kkt%factorisations = kkt%factorisations + 1          ! they are not those before
   end subroutine take_factors

   !> Whether the joints of a design have the assembly mode of state `before` at the present state, and are not singular.
   logical function is_same_assembly(self, member, lane, before)
      type(walker_t), intent(inout) :: self
      type(member_t), intent(in) :: member
      integer, intent(in) :: lane, before
      logical :: is_over, is_singular

      call refresh(self, member, lane)
      associate (branch => self%branch(lane))
         call unpack_state(member%path%packed(:, before), branch%before(1))
         call take_state(self, lane)
         call compare_orientation(branch%orientation, member%suspension, branch%before(1)%poses, self%state%poses, &
            self%pack%scale, is_over, is_singular)
      end associate
      is_same_assembly = .not. (is_over .or. is_singular)
   end function is_same_assembly

   !> Copies the present poses of the bodies of a design to self%state.
   pure subroutine take_state(self, lane)
      type(walker_t), intent(inout) :: self
      integer, intent(in) :: lane
      integer :: b

      do b = 2, size(self%state%poses)
         self%state%poses(b)%r = self%pack%poses(b)%r%v(lane)
         self%state%poses(b)%q = self%pack%poses(b)%q%v(lane)
         self%state%poses(b)%a = self%pack%poses(b)%a%v(lane)
      end do
   end subroutine take_state

   !> Finds the number of earlier states that would have predicted the present state of a design best.
   subroutine learn(self, member, k, direction, lane, trusted)
      type(walker_t), intent(inout) :: self
      type(member_t), intent(in) :: member
      integer, intent(in) :: k, direction, lane
      integer, intent(inout) :: trusted

      call refresh(self, member, lane)
      associate (predictor => self%branch(lane)%predictor)
         call recall(predictor, member%path, k, direction, trusted)
         call take_poses(self%pack, lane, predictor%guess)
         call judge(predictor, member%path%value(k), predictor%guess, 7*self%pack%bodies, .false.)
         trusted = predictor%trusted
      end associate
   end subroutine learn

   !> Renews the branch of a lane for its present design, unless this was already done.
   subroutine refresh(self, member, lane)
      type(walker_t), intent(inout) :: self
      type(member_t), intent(in) :: member
      integer, intent(in) :: lane

      if (.not. self%is_fresh(lane)) call renew_branch(member%suspension, self%branch(lane))
      self%is_fresh(lane) = .true.
   end subroutine refresh

   !> Replaces the content of a predictor by the last states of a design before state k, and by the number of trusted states.
   subroutine recall(predictor, path, k, direction, trusted)
      type(predictor_t), intent(inout) :: predictor
      type(path_t), intent(in) :: path
      integer, intent(in) :: k, direction, trusted
      integer :: j

      call forget(predictor)
      do j = k - depth*direction, k - direction, direction
         if (j < 1 .or. j > path%states) cycle
         if (path%is_reached(j)) call remember(predictor, path%value(j), path%packed(:, j))
      end do
      predictor%trusted = trusted
   end subroutine recall

   !> Copies the present poses of a design to a packed state.
   pure subroutine take_poses(pack, lane, packed)
      type(pack_t), intent(in) :: pack
      integer, intent(in) :: lane
      real(wp), intent(inout) :: packed(:)
      integer :: b

      do b = 1, pack%bodies
         packed(7*b - 6:7*b - 4) = pack%poses(b + 1)%r%v(lane)
         packed(7*b - 3:7*b) = pack%poses(b + 1)%q%v(lane)
      end do
   end subroutine take_poses

end module ek_pack_alone
