!> Tangents of the paths of four designs at a time. The tangents give the first prediction, and show whether a step follows the path
!> (ek_branch).
module ek_pack_tangents
   use ek_kinds, only: wp
   use ek_lanes, only: lanes_t, mask_t, lanes
   use ek_predictor, only: depth
   use ek_relative_rotation_lanes, only: pose_t
   use ek_motion_lanes, only: pack_poses, unpack_poses, find_motion, trapezoidal_rest, take_step, smooth
   use ek_kkt_terms_lanes, only: assemble_rate_terms
   use ek_plan_factors_lanes, only: solve_by
   use ek_walker, only: walker_t, member_t, place_t, set_inputs
   implicit none(type, external)
   private
   public :: compare_tangents, go_along

contains

   !> Finds the error of the trapezoidal rule in the step to the present states, like `compare` of ek_branch, from the last factors
   !> and the state before the last. If this error is too large or unknown, the tangent at the beginning of the step is used instead
   !> of the state before the last.
   subroutine compare_tangents(self, members, places, is_common, is_asked, value, rest)
      type(walker_t), intent(inout) :: self
      type(member_t), intent(in) :: members(lanes)
      type(place_t), intent(in) :: places(lanes)
      logical, intent(in) :: is_common
      logical, intent(in) :: is_asked(lanes)
      real(wp), intent(in) :: value
      real(wp), intent(out) :: rest(lanes)       !! error of the trapezoidal rule of each design; huge: not known
      logical :: is_closer(lanes)
      real(wp) :: width, before, bow
      type(lanes_t) :: length, error
      integer :: older, b, k, l

      associate (pack => self%pack, newest => self%history%newest)
         rest = huge(rest)
         older = modulo(newest - 2, depth) + 1
         width = value - self%history%abscissa(newest)
         before = 0.0_wp
         if (self%history%count > 1) before = self%history%abscissa(newest) - self%history%abscissa(older)
         if (self%history%count > 1 .and. .not. abs(before) > 0.0_wp) return
         call find_tangents(self, members, places, is_common, self%history%abscissa(newest), value, pack%poses, pack%factors, &
            pack%tangent_b)
         do b = 1, pack%bodies
            call find_motion(pack%packed(7*b - 6:7*b - 4, newest), pack%packed(7*b - 3:7*b, newest), pack%poses(b + 1)%r, &
               pack%poses(b + 1)%q, pack%motion(6*b - 5:6*b))
         end do
         if (self%history%count > 1) then      ! otherwise the tangents at design are there
            do b = 1, pack%bodies
               call find_motion(pack%packed(7*b - 6:7*b - 4, older), pack%packed(7*b - 3:7*b, older), &
                  pack%packed(7*b - 6:7*b - 4, newest), pack%packed(7*b - 3:7*b, newest), pack%motion_before(6*b - 5:6*b))
            end do
            bow = width/(width + before)
            do k = 1, 6*pack%bodies
               pack%tangent_a(k)%v = pack%tangent_b(k)%v &
                  + (2.0_wp*bow)*(pack%motion_before(k)%v/before - pack%motion(k)%v/width)
            end do
         end if
         length%v = pack%length
         error = trapezoidal_rest(pack%motion, pack%tangent_a(:6*pack%bodies), pack%tangent_b(:6*pack%bodies), width, length)
         do l = 1, lanes
            if (places(l)%is_symmetric) rest(l) = error%v(l)
            is_closer(l) = is_asked(l) .and. places(l)%is_symmetric .and. places(l)%knows_factors .and. .not. rest(l) <= smooth
         end do
         if (self%history%count == 1 .or. .not. any(is_closer)) return
         self%tangents_again = self%tangents_again + 1
         call unpack_poses(pack%bodies, pack%rows, pack%packed(:, newest), pack%poses_before, pack%reaction_before)
         call find_tangents(self, members, places, is_common, self%history%abscissa(newest), value, pack%poses_before, &
            pack%factors_before, pack%tangent_a)
         error = trapezoidal_rest(pack%motion, pack%tangent_a(:6*pack%bodies), pack%tangent_b(:6*pack%bodies), width, length)
         do l = 1, lanes
            if (is_closer(l)) rest(l) = error%v(l)
         end do
      end associate
   end subroutine compare_tangents

   !> Computes dz/ds, the tangents of the states z by the swept value s, at poses with the factors at these poses. The derivative of
   !> the inputs is the difference quotient between two swept values.
   subroutine find_tangents(self, members, places, is_common, from, to, poses, factors, tangent)
      type(walker_t), intent(inout) :: self
      type(member_t), intent(in) :: members(lanes)
      type(place_t), intent(in) :: places(lanes)
      logical, intent(in) :: is_common
      real(wp), intent(in) :: from, to
      type(pose_t), contiguous, intent(in) :: poses(:)
      type(lanes_t), contiguous, intent(in) :: factors(:)
      type(lanes_t), intent(out) :: tangent(:)           !! twists of the bodies and reactions per swept value
      integer :: k

      associate (pack => self%pack)
         call set_inputs(members, places, is_common, to, pack)
         pack%rate_factor = pack%factor
         pack%rate_change = pack%change
         call set_inputs(members, places, is_common, from, pack)
         do k = 1, size(pack%factor)
            pack%rate_factor(k)%v = (pack%rate_factor(k)%v - pack%factor(k)%v)/(to - from)
         end do
         do k = 1, size(pack%change)
            pack%rate_change(k)%v = (pack%rate_change(k)%v - pack%change(k)%v)/(to - from)
         end do
         call assemble_rate_terms(6*pack%bodies, pack%loads, poses, pack%rate_factor, pack%rate_change, tangent)
         call solve_by(pack%plan, factors, pack%scale, tangent)
      end associate
   end subroutine find_tangents

   !> Predicts the first state: from design along the tangent at design. Poses and factors belong to the design state.
   subroutine go_along(self, members, places, is_common, value)
      type(walker_t), intent(inout) :: self
      type(member_t), intent(in) :: members(lanes)
      type(place_t), intent(in) :: places(lanes)
      logical, intent(in) :: is_common
      real(wp), intent(in) :: value
      type(mask_t) :: all_of_them
      integer :: k

      associate (pack => self%pack)
         call find_tangents(self, members, places, is_common, self%history%abscissa(self%history%newest), value, pack%poses, &
            pack%factors, pack%tangent_a)
         do k = 1, pack%n
            pack%rhs(k)%v = (value - self%history%abscissa(self%history%newest))*pack%tangent_a(k)%v
         end do
         all_of_them%v = 1.0_wp
         call take_step(pack%bodies, pack%rows, pack%rhs, all_of_them, pack%poses, pack%reaction)
         call pack_poses(pack%bodies, pack%rows, pack%poses, pack%reaction, pack%guess)
      end associate
   end subroutine go_along

end module ek_pack_tangents
