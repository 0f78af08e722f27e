!> Follows the paths of four designs at the same time, state after state.
!>
!> All designs of the pack take each step together: prediction, Newton's method, and the tests of ek_reach and ek_branch that the
!> state is on the path. In these tests, the prediction was close or the tangents agree with the motion, and the joints are in the
!> same assembly. A state of a design that does not pass these tests is found by ek_reach, which tests in detail and halves steps.
!> A design that fails in ek_reach, or that the constant loads move out of its design position, is left to the sweep of a single
!> design.
module ek_pack_walk
   use ek_kinds, only: wp
   use ek_lanes, only: lanes_t, lanes
   use ek_suspension, only: has_symmetric_loads
   use ek_case, only: case_t
   use ek_state, only: design_state
   use ek_schedule, only: make_schedule, same_schedule
   use ek_path_states, only: path_t, count_ways, ways
   use ek_path, only: suspect
   use ek_reach, only: failure_t, good_guess, quick
   use ek_newton, only: outcome_t
   use ek_branch, only: even, exact, zero, long
   use ek_predictor, only: forget, depth
   use ek_motion_lanes, only: unpack_poses, pack_poses, extrapolate, squared_distance, smooth
   use ek_pack, only: set_design
   use ek_pack_newton, only: find_equilibria
   use ek_pack_tangents, only: compare_tangents, go_along
   use ek_pack_alone, only: step_alone, is_same_assembly, learn
   use ek_walker, only: member_t, walker_t, place_t, set_inputs, find_lane_weights, remember_place, put_lane, get_lane
   implicit none(type, external)
   private
   public :: member_t, walker_t, walk_pack, can_walk

contains

   !> Whether packs can solve a case: its states are equilibria along the swept value, on a path through design that no table
   !> defines.
   pure logical function can_walk(case, path)
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      can_walk = case%method == 'equilibrium' .and. .not. case%follows_arc .and. path%start > 0 .and. .not. path%is_table
   end function can_walk

   !> Walks the paths of all members, which new_path has created with the same swept values. is_walked of a member is .true. if its
   !> path is complete. Members that are not wanted or that cannot walk are skipped.
   subroutine walk_pack(self, members)
      type(walker_t), intent(inout) :: self      !! walker with a pack that was created for these designs
      type(member_t), intent(inout) :: members(lanes)
      type(place_t), allocatable :: places(:)

      call move_alloc(self%places, places)
      if (.not. allocated(places)) allocate (places(lanes))
      if (.not. allocated(self%branch)) allocate (self%branch(lanes))
      call walk_together(self, members, places)
      call move_alloc(places, self%places)
   end subroutine walk_pack

   !> Walks the paths of the members from design to both ends of the range.
   subroutine walk_together(self, members, places)
      type(walker_t), intent(inout) :: self
      type(member_t), intent(inout) :: members(lanes)
      type(place_t), intent(inout) :: places(lanes)
      integer :: ends(2, 2)
      logical :: is_common, is_alike
      integer :: l, w, k, direction, first_of_them

      is_alike = allocated(self%state%poses)
      if (is_alike) is_alike = size(self%state%poses) == self%pack%bodies + 1 .and. size(self%state%reaction) == self%pack%rows
      if (.not. is_alike) self%state = design_state(members(1)%suspension)
      self%is_fresh = .false.
      do l = 1, lanes
         associate (this => members(l))
            call set_design(this%suspension, l, self%pack)
            this%is_walked = this%is_wanted .and. can_walk(this%case, this%path) .and. this%path%states == size(self%pack%places)
            if (this%is_walked) this%is_walked = all(abs(this%path%value - self%pack%places) <= 0.0_wp)
            if (.not. this%is_walked) cycle
            call make_schedule(this%suspension, this%case, places(l)%schedule)
            places(l)%is_symmetric = has_symmetric_loads(this%suspension)
         end associate
      end do
      if (.not. any(members%is_walked)) return
      l = findloc(members%is_walked, .true., dim=1)
      self%tolerance = members(l)%case%tolerance
      first_of_them = l
      is_common = all(members%is_walked)
      do l = 2, lanes
         if (is_common) is_common = same_schedule(places(1)%schedule, places(l)%schedule)
      end do
      call settle_all(self, members, places, is_common)
      ends = ways(members(first_of_them)%path)
      do w = 1, count_ways(members(first_of_them)%path)
         if (ends(1, w) == ends(2, w)) cycle
         direction = sign(1, ends(2, w) - ends(1, w))
         call begin_way(self, members, ends(1, w), direction, places)
         do k = ends(1, w) + direction, ends(2, w), direction
            if (.not. any(members%is_walked)) return
            call step_to(self, members, places, is_common, k, direction)
         end do
      end do
   end subroutine walk_together

   !> Finds the equilibria under the constant loads. A design is left to the sweep of a single design if its equilibrium is not
   !> found, is nearly singular, or is more than 10 tolerances from the design position. The factors at the equilibria remain in the
   !> pack for the first step.
   subroutine settle_all(self, members, places, is_common)
      type(walker_t), intent(inout) :: self
      type(member_t), intent(inout) :: members(lanes)
      type(place_t), intent(inout) :: places(lanes)
      logical, intent(in) :: is_common
      type(outcome_t) :: outcome(lanes)
      type(lanes_t) :: moved, length
      integer :: l, k

      associate (pack => self%pack)
         do k = 1, pack%bodies
            pack%poses(k + 1)%r = pack%origin(:, k)
            pack%poses(k + 1)%q = pack%poses(1)%q
            pack%poses(k + 1)%a = pack%poses(1)%a
         end do
         do k = 1, pack%rows
            pack%reaction(k)%v = 0.0_wp
         end do
         call pack_poses(pack%bodies, pack%rows, pack%poses, pack%reaction, pack%guess)
         call set_inputs(members, places, is_common, 0.0_wp, pack)
         call find_equilibria(pack, self%tolerance, members%is_walked, outcome)
         length%v = pack%length
         moved = squared_distance(pack%bodies, pack%poses, pack%guess, length)
         call forget(self%history)
         call remember_place(self%history, 0.0_wp)
         call pack_poses(pack%bodies, pack%rows, pack%poses, pack%reaction, pack%packed(:, self%history%newest))
         do l = 1, lanes
            if (.not. members(l)%is_walked) cycle
            associate (path => members(l)%path, this => outcome(l))
               members(l)%is_walked = this%is_converged .and. moved%v(l) <= (10.0_wp*members(l)%case%tolerance)**2 .and. &
                  this%pivot_ratio > suspect
               path%failure = failure_t()
               path%limits = 0
               path%crossings = 0
               path%is_reached = .false.
               path%is_settled = members(l)%is_walked
               call get_lane(l, pack%packed(:, self%history%newest), path%settled)
               path%packed(:, path%start) = path%settled
               path%is_reached(path%start) = .true.
               path%is_stable(path%start) = this%negative == pack%rows
               path%pivot_ratio(path%start) = this%pivot_ratio
               path%iterations(path%start) = 0
               places(l)%settled = this%negative
               places(l)%beginning = this%log_determinant
            end associate
         end do
      end associate
   end subroutine settle_all

   !> Begins the way from design to one end of the range: stores the design state, and the states on the other side of design, in
   !> the history.
   subroutine begin_way(self, members, first, direction, places)
      type(walker_t), intent(inout) :: self
      type(member_t), intent(in) :: members(lanes)
      integer, intent(in) :: first, direction
      type(place_t), intent(inout) :: places(lanes)
      integer :: k, l

      call forget(self%history)
      do k = first - (depth - 1)*direction, first, direction
         if (k < 1 .or. k > size(self%pack%places)) cycle
         if (.not. all(members%is_walked .eqv. has_state(members, k))) cycle
         call remember_place(self%history, self%pack%places(k))
         do l = 1, lanes
            if (members(l)%is_walked) call put_lane(l, members(l)%path%packed(:, k), self%pack%packed(:, self%history%newest))
         end do
      end do
      places%trusted = depth
      places%negative = places%settled
      places%log_determinant = places%beginning
      places%was_uneven = .false.
      places%knows_factors = .false.
   end subroutine begin_way

   !> For each design: whether the pack still solves the design and has reached state k.
   function has_state(members, k) result(has)
      type(member_t), intent(in) :: members(lanes)
      integer, intent(in) :: k
      logical :: has(lanes)
      integer :: l

      do l = 1, lanes
         has(l) = members(l)%is_walked
         if (has(l)) has(l) = members(l)%path%is_reached(k)
      end do
   end function has_state

   !> Solves state k of all designs that the pack still solves.
   subroutine step_to(self, members, places, is_common, k, direction)
      type(walker_t), intent(inout) :: self
      type(member_t), intent(inout) :: members(lanes)
      type(place_t), intent(inout) :: places(lanes)
      logical, intent(in) :: is_common           !! all designs have the same inputs
      integer, intent(in) :: k, direction
      type(outcome_t) :: outcome(lanes)
      type(lanes_t), allocatable :: factors(:)
      type(lanes_t) :: weight(depth), moved, missed, length
      real(wp) :: rest(lanes)
      logical :: is_smooth(lanes), is_foreseen(lanes), is_uneven(lanes)
      integer :: slot(depth), states, l

      associate (pack => self%pack, value => self%pack%places(k))
         if (self%history%count > 1) then
            call find_lane_weights(self%history, value, places%trusted, weight, slot, states)
            call extrapolate(size(pack%guess), states, weight, slot, pack%packed, pack%guess)
            call unpack_poses(pack%bodies, pack%rows, pack%guess, pack%poses, pack%reaction)
         else
            call go_along(self, members, places, is_common, value)      ! the poses are those of design
         end if
         call set_inputs(members, places, is_common, value, pack)
         call move_alloc(pack%factors_before, factors)
         call move_alloc(pack%factors, pack%factors_before)
         call move_alloc(factors, pack%factors)
         call find_equilibria(pack, self%tolerance, members%is_walked, outcome)
         length%v = pack%length
         moved = squared_distance(pack%bodies, pack%poses, pack%packed(:, self%history%newest), length)
         missed = squared_distance(pack%bodies, pack%poses, pack%guess, length)
         do l = 1, lanes
            associate (this => outcome(l), place => places(l))
               is_smooth(l) = members(l)%is_walked .and. this%is_converged .and. this%negative == place%negative .and. &
                  this%pivot_ratio > suspect .and. .not. this%log_determinant < place%log_determinant - zero
               is_uneven(l) = place%was_uneven .or. abs(this%log_determinant - place%log_determinant) > even
               if (is_uneven(l) .and. this%factorisations > quick) is_smooth(l) = .false.
               is_foreseen(l) = missed%v(l) <= good_guess**2*moved%v(l) .or. moved%v(l) <= (10.0_wp*members(l)%case%tolerance)**2
            end associate
         end do
         rest = 0.0_wp
         if (any(is_smooth .and. .not. is_foreseen)) then
            call compare_tangents(self, members, places, is_common, is_smooth .and. .not. is_foreseen, value, rest)
            where (is_foreseen) rest = 0.0_wp
            is_foreseen = is_foreseen .or. rest <= smooth
         end if
         do l = 1, lanes
            if (.not. (is_smooth(l) .and. is_foreseen(l))) cycle
            if (rest(l) <= exact .and. .not. is_uneven(l) .and. moved%v(l) <= (long*pack%length)**2) cycle
            is_smooth(l) = is_same_assembly(self, members(l), l, k - direction)
         end do
         do l = 1, lanes
            if (.not. members(l)%is_walked) cycle
            self%steps = self%steps + 1
            associate (this => outcome(l), place => places(l), path => members(l)%path)
               if (is_smooth(l) .and. is_foreseen(l)) then
                  if (this%factorisations == 1) then
                     place%trusted = min(place%trusted + 1, depth)
                  else
                     call learn(self, members(l), k, direction, l, place%trusted)
                  end if
                  place%was_uneven = abs(this%log_determinant - place%log_determinant) > even
                  place%log_determinant = this%log_determinant
                  path%is_reached(k) = .true.
                  path%is_stable(k) = this%negative == pack%rows
                  path%pivot_ratio(k) = this%pivot_ratio
                  path%iterations(k) = this%factorisations
               else
                  call step_alone(self, members(l), place, this, l, k, direction)
               end if
               place%knows_factors = is_smooth(l) .and. is_foreseen(l)
            end associate
         end do
         call remember_place(self%history, value)
         call pack_poses(pack%bodies, pack%rows, pack%poses, pack%reaction, pack%packed(:, self%history%newest))
         do l = 1, lanes
            if (members(l)%is_walked) call get_lane(l, pack%packed(:, self%history%newest), members(l)%path%packed(:, k))
         end do
      end associate
   end subroutine step_to

end module ek_pack_walk
