!> Measures a path from design to the end of a case, finds the limit points on it, and visits the states along it.
!>
!> Two passes: `survey` measures the path, `go_to` finds states at given lengths. Both take the same steps (ek_arc).
module ek_arc_survey
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: inputs_t
   use ek_schedule, only: inputs_at
   use ek_kkt, only: kkt_t, assemble, factorise, whole_tangent
   use ek_arc, only: arc_t, begin, advance, probe, find_tangent, find_motion, inner
   implicit none(type, external)
   private
   public :: survey_t, survey, go_to, length_at, print_limits

   integer, parameter, public :: arrived = 0        !! the path reaches the end of the case
   integer, parameter, public :: stuck = 1          !! no step was accepted
   integer, parameter, public :: gone_far = 2       !! a body, or the swept value, moved further than in any suspension
   integer, parameter, public :: gone_round = 3     !! the path is closed: it returns to design
   integer, parameter, public :: gone_on = 4        !! the path has more than max_steps steps

   integer, parameter, public :: max_limits = 16   !! largest number of limit points, and of bifurcations, reported
   integer, parameter, public :: max_steps = 20000 !! largest number of steps of a path

   real(wp), parameter :: far_away = 10.0_wp        !! limit of the displacement of a body, in sizes of the model; at least
                                                    !! `farthest`
   real(wp), parameter :: farthest = 3.0_wp         !! no body of a suspension moves this far [m]
   real(wp), parameter :: far_off = 100.0_wp        !! limit of the swept value, in ranges
   real(wp), parameter :: same_way = 0.9_wp         !! least cosine of the angle between two tangents of the same direction
   real(wp), parameter :: same = 1.0e-14_wp         !! tolerance of a swept value, as a share of the range
   real(wp), parameter :: flat = 1.0e-10_wp         !! allowed error of a limit point before the correction by a parabola, as a
                                                    !! share of the range

   !> The findings of `survey` about a path.
   type :: survey_t
      integer :: ending = stuck
      real(wp) :: near_length = 0.0_wp, far_length = 0.0_wp      !! length from design to `near`, and to `far` or the path's end
      real(wp) :: last_place = 0.0_wp                            !! swept value to which the path was followed
      integer :: limits = 0
      real(wp) :: limit_place(max_limits) = 0.0_wp, limit_length(max_limits) = 0.0_wp
      integer :: crossings = 0
      real(wp) :: crossing_place(max_limits) = 0.0_wp
   end type survey_t

contains

   !> Follows the path from design until the swept value `far` is reached for the first time, or until the path ends. Records the
   !> limit points and the bifurcations on the way.
   subroutine survey(arc, suspension, settled, near, far, kkt, found)
      type(arc_t), intent(inout) :: arc
      type(suspension_t), intent(in) :: suspension
      real(wp), contiguous, intent(in) :: settled(:)     !! packed state at swept value 0
      real(wp), intent(in) :: near, far                  !! swept values on one side of 0; near may be 0
      type(kkt_t), intent(inout) :: kkt
      type(survey_t), intent(out) :: found
      real(wp) :: top, place
      logical :: is_found, is_past_near, has_top
      integer :: k

      is_past_near = .not. abs(near) > 0.0_wp
      call begin(arc, suspension, settled, 0.0_wp, far > 0.0_wp, kkt, is_found)
      do k = 1, max_steps
         if (is_found) call advance(arc, suspension, kkt, is_found)
         found%far_length = arc%length
         found%last_place = arc%place_a
         if (.not. is_found) then
            found%ending = stuck
            return
         end if
         found%far_length = arc%length + arc%width
         found%last_place = arc%place_b
         if (k > 1) then
            found%ending = ending()
            if (found%ending /= arrived) return
         end if
         top = arc%width
         place = arc%place_b
         has_top = arc%tangent_a(kkt%n + 1)*arc%tangent_b(kkt%n + 1) < 0.0_wp
         if (has_top) call find_limit(arc, suspension, kkt, top, place)
         ! a limit point of a load changes the inertia by one; any other change is a bifurcation
         if (arc%negative_a /= arc%negative_b .and. .not. has_top) then
            found%crossings = min(found%crossings + 1, max_limits)
            call find_crossing(arc, suspension, kkt, found%crossing_place(found%crossings))
         end if
         call evaluate_between(0.0_wp, arc%place_a, top, place)
         if (found%ending == arrived) return
         if (.not. has_top) cycle
         found%limits = min(found%limits + 1, max_limits)
         found%limit_place(found%limits) = place
         found%limit_length(found%limits) = arc%length + top
         call evaluate_between(top, place, arc%width, arc%place_b)
         if (found%ending == arrived) return
      end do
      found%ending = gone_on

   contains

      !> Reason for the end of the path: gone_far (outside the useful range) or gone_round (closed); `arrived` if the path has not
      !> ended. The last probe must be b.
      integer function ending()
         real(wp) :: moved, behind

         ending = arrived
         call find_motion(arc, kkt, settled, 0.0_wp, moved)
         if (moved > max(far_away*arc%size, farthest) .or. abs(arc%place_b) > far_off*arc%range) ending = gone_far
         behind = sqrt(inner(arc, kkt, arc%motion, arc%motion))
         if (behind > 1.01_wp*arc%width .or. inner(arc, kkt, arc%motion, arc%tangent_0) < 0.0_wp) return
         if (inner(arc, kkt, arc%tangent_b, arc%tangent_0) < same_way) return
         ending = gone_round
         found%far_length = arc%length + max(arc%width - behind, 0.0_wp)
      end function ending

      !> Finds the lengths at which the path passes `near` and `far`, on a part of the segment with a monotonic swept value.
      subroutine evaluate_between(low, place_low, high, place_high)
         real(wp), intent(in) :: low, place_low, high, place_high
         real(wp) :: width

         found%ending = gone_on
         if (.not. is_past_near .and. (place_low - near)*(place_high - near) <= 0.0_wp) then
            call find_place(arc, suspension, kkt, near, low, place_low, high, place_high, width)
            found%near_length = arc%length + width
            is_past_near = .true.
         end if
         if (.not. is_past_near .or. (place_low - far)*(place_high - far) > 0.0_wp) return
         call find_place(arc, suspension, kkt, far, low, place_low, high, place_high, width)
         found%far_length = arc%length + width
         found%last_place = far
         found%ending = arrived
      end subroutine evaluate_between

   end subroutine survey

   !> The length of the path from design to state k. States `first` to `last` are at equal distances.
   pure real(wp) function length_at(found, k, first, last) result(length)
      type(survey_t), intent(in) :: found
      integer, intent(in) :: k, first, last

      length = found%far_length
      if (k /= last) length = found%near_length + (found%far_length - found%near_length)*real(k - first, wp)/(last - first)
   end function length_at

   !> Adds the limit points to a list, each with the nearest state between `first` and `last`.
   pure subroutine print_limits(found, first, last, limits, places, states)
      type(survey_t), intent(in) :: found
      integer, intent(in) :: first, last
      integer, intent(inout) :: limits
      real(wp), intent(inout) :: places(:)
      integer, intent(inout) :: states(:)    !! 0: the limit point is closer to design than state `first`
      real(wp) :: share
      integer :: k

      do k = 1, found%limits
         limits = limits + 1
         places(limits) = found%limit_place(k)
         share = (found%limit_length(k) - found%near_length)/(found%far_length - found%near_length)
         states(limits) = 0
         if (share >= 0.0_wp) states(limits) = first + nint(share*(last - first))
      end do
   end subroutine print_limits

   !> Finds the limit point on the current segment: the root of ds/dl.
   !> Equation (K.20) of docs/theory/kkt.md.
   subroutine find_limit(arc, suspension, kkt, width, place)
      type(arc_t), intent(inout) :: arc
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(inout) :: kkt
      real(wp), intent(inout) :: width       !! in: length of the segment; out: length to the limit point
      real(wp), intent(inout) :: place       !! in: at the end of the segment; out: at the limit point
      integer, parameter :: max_probes = 60
      real(wp) :: low, high, f_low, f_high, f, x, slope, before, f_before
      logical :: is_found
      integer :: k, side

      low = 0.0_wp
      high = width
      f_low = arc%tangent_a(kkt%n + 1)/arc%range
      f_high = arc%tangent_b(kkt%n + 1)/arc%range
      before = high
      f_before = f_high
      side = 0
      do k = 1, max_probes
         x = low - f_low*((high - low)/(f_high - f_low))
         call probe(arc, suspension, x, kkt, is_found)
         if (is_found) call find_tangent(arc, suspension, kkt, is_found)
         if (.not. is_found) return
         f = arc%tangent(kkt%n + 1)/arc%range
         slope = (f - f_before)/(x - before)
         width = x
         place = arc%place
         if (abs(f)*(high - low) <= flat) exit
         before = x
         f_before = f
         call narrow(x, f, low, f_low, high, f_high, side)
      end do
      ! the remaining distance is a piece of a parabola
      if (abs(slope)*(high - low) > abs(f)) place = place - 0.5_wp*arc%range*f**2/slope
   end subroutine find_limit

   !> Finds the swept value on the current segment at which the inertia changes, by bisection.
   subroutine find_crossing(arc, suspension, kkt, place)
      type(arc_t), intent(inout) :: arc
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(inout) :: kkt
      real(wp), intent(out) :: place
      integer, parameter :: max_probes = 20     ! 1e-6 of a step
      real(wp) :: low, high, place_low, place_high, width
      logical :: is_found
      integer :: k

      low = 0.0_wp
      high = arc%width
      place_low = arc%place_a
      place_high = arc%place_b
      do k = 1, max_probes
         width = 0.5_wp*(low + high)
         call probe(arc, suspension, width, kkt, is_found)
         if (is_found) call find_tangent(arc, suspension, kkt, is_found)
         if (.not. is_found) exit
         if (kkt%negative == arc%negative_a) then
            low = width
            place_low = arc%place
         else
            high = width
            place_high = arc%place
         end if
      end do
      place = 0.5_wp*(place_low + place_high)
   end subroutine find_crossing

   !> Finds the length at which a part of the current segment has a given swept value.
   subroutine find_place(arc, suspension, kkt, goal, from, place_from, to, place_to, width)
      type(arc_t), intent(inout) :: arc
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(inout) :: kkt
      real(wp), intent(in) :: goal
      real(wp), intent(in) :: from, place_from, to, place_to     !! lengths beyond a, and swept values, at both ends of the part
      real(wp), intent(out) :: width                             !! length beyond a
      integer, parameter :: max_probes = 80
      real(wp) :: low, high, f_low, f_high, f
      logical :: is_found
      integer :: k, side

      low = from
      high = to
      f_low = (place_from - goal)/arc%range
      f_high = (place_to - goal)/arc%range
      width = high
      if (abs(f_high) <= same) return
      width = low
      if (abs(f_low) <= same) return
      side = 0
      do k = 1, max_probes
         width = low - f_low*((high - low)/(f_high - f_low))
         call probe(arc, suspension, width, kkt, is_found)
         if (.not. is_found) return
         f = (arc%place - goal)/arc%range
         if (abs(f) <= same .or. high - low <= spacing(high)) return
         call narrow(width, f, low, f_low, high, f_high, side)
      end do
   end subroutine find_place

   !> Computes one step of root finding between two values of different sign, by false position. The value at an end that
   !> stays for the second time in succession is halved (Illinois method).
   pure subroutine narrow(x, f, low, f_low, high, f_high, side)
      real(wp), intent(in) :: x, f
      real(wp), intent(inout) :: low, f_low, high, f_high
      integer, intent(inout) :: side         !! end moved last: 1 `high`, −1 `low`, 0 neither

      if ((f < 0.0_wp) .eqv. (f_high < 0.0_wp)) then
         high = x
         f_high = f
         if (side == 1) f_low = 0.5_wp*f_low
         side = 1
      else
         low = x
         f_low = f
         if (side == -1) f_high = 0.5_wp*f_high
         side = -1
      end if
   end subroutine narrow

   !> Moves to the state at a length from design, in arc%state and arc%place. The factors of N at this state are in kkt.
   !>
   !> `begin` must be called first; lengths must increase from call to call.
   subroutine go_to(arc, suspension, length, kkt, is_found)
      type(arc_t), intent(inout) :: arc
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: length
      type(kkt_t), intent(inout) :: kkt
      logical, intent(out) :: is_found
      type(inputs_t) :: inputs

      is_found = .true.
      do while (is_found .and. arc%length + arc%width < length)
         call advance(arc, suspension, kkt, is_found)
      end do
      if (is_found) call probe(arc, suspension, length - arc%length, kkt, is_found)
      if (.not. is_found) return
      call inputs_at(arc%schedule, arc%place, inputs)
      call assemble(suspension, arc%state, inputs, whole_tangent, kkt)
      call factorise(kkt)
   end subroutine go_to

end module ek_arc_survey
