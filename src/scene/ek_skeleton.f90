!> The skeleton of a body: it represents the body in a picture, as bodies have no shape in the model.
!>
!> It is the shortest tree through the attachment points. Two points on the chassis are joined directly only if the body has
!> no other point (a wishbone is an A, not a bar along its own pivots).
module ek_skeleton
   use ek_kinds, only: wp
   use ek_measure, only: measure_t, distance
   use ek_joint, only: joint_table, no_part, rod_part, slider_part
   use ek_block, only: rotated
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t
   implicit none(type, external)
   private
   public :: skeleton_t, node_t, skeleton_of, first_measure, ends_of, place_of, bar_of, slides, same_point

   real(wp), parameter :: same_point = 1.0e-3_wp    !! distance below which points are drawn as one [m]
   integer, parameter :: max_points = 64           !! largest number of points of a body; further points are omitted

   !> A point of a body.
   type :: node_t
      real(wp) :: arm(3) = 0.0_wp           !! position in body axes [m]
      logical :: is_held = .false.          !! attached to the chassis by a joint or a bushing; not by a rod or spring
      logical :: is_spring = .false.        !! the point is the seat of a spring, damper or stop only
   end type node_t

   !> The points of a body and the bars between them.
   type :: skeleton_t
      type(node_t) :: nodes(max_points)
      integer :: bars(2, max_points) = 0
      integer :: used = 0, count = 0        !! number of nodes, number of bars
   end type skeleton_t

contains

   !> The attachment points and the wheel centre of a body, and the shortest tree through these points.
   function skeleton_of(suspension, body) result(skeleton)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: body
      type(skeleton_t) :: skeleton
      type(measure_t) :: measure
      logical :: is_in(max_points), is_rigid, is_spring
      real(wp) :: best, cost
      integer :: k, n, part, from, to, bar(2)

      do k = 1, size(suspension%joints)
         part = joint_table(suspension%joints(k)%number)%part
         if (part == no_part) cycle                  ! it has no attachment point
         measure = first_measure(suspension, k)
         is_rigid = part /= rod_part
         if (measure%body_i == body) call add_node(measure%arm_i, is_rigid .and. measure%body_j == 0, .false.)
         if (measure%body_j == body) call add_node(measure%arm_j, is_rigid .and. measure%body_i == 0, .false.)
      end do
      do n = 1, size(suspension%elements)             ! those of one measure, springs and stops, last
         k = modulo(n - 1 + suspension%scalars, size(suspension%elements)) + 1
         measure = suspension%elements(k)%measure
         is_spring = k <= suspension%scalars
         if (is_spring .and. measure%kind /= distance) cycle           ! it has no attachment point
         if (measure%body_i == body) call add_node(measure%arm_i, .not. is_spring .and. measure%body_j == 0, is_spring)
         if (measure%body_j == body) call add_node(measure%arm_j, .not. is_spring .and. measure%body_i == 0, is_spring)
      end do
      do k = 1, size(suspension%wheels)
         if (suspension%wheels(k)%body == body) call add_node(suspension%wheels(k)%centre, .false., .false.)
      end do
      if (skeleton%used == 0) return

      is_in = .false.
      is_in(1) = .true.
      do while (count(is_in(:skeleton%used)) < skeleton%used)
         best = huge(1.0_wp)
         bar = 1
         do from = 1, skeleton%used
            if (.not. is_in(from)) cycle
            do to = 1, skeleton%used
               if (is_in(to)) cycle
               cost = norm2(skeleton%nodes(to)%arm - skeleton%nodes(from)%arm)
               if (skeleton%nodes(to)%is_held .and. skeleton%nodes(from)%is_held) cost = cost + 100.0_wp
               if (cost >= best) cycle
               best = cost
               bar = [from, to]
            end do
         end do
         is_in(bar(2)) = .true.
         skeleton%count = skeleton%count + 1
         skeleton%bars(:, skeleton%count) = bar
      end do

   contains

      !> Adds a node, or merges it with a node at the same point.
      subroutine add_node(arm, is_held, is_spring)
         real(wp), intent(in) :: arm(3)
         logical, intent(in) :: is_held, is_spring
         integer :: n

         do n = 1, skeleton%used
            if (norm2(skeleton%nodes(n)%arm - arm) > same_point) cycle
            skeleton%nodes(n)%is_held = skeleton%nodes(n)%is_held .or. is_held
            skeleton%nodes(n)%is_spring = skeleton%nodes(n)%is_spring .and. is_spring
            return
         end do
         if (skeleton%used == max_points) return
         skeleton%used = skeleton%used + 1
         skeleton%nodes(skeleton%used) = node_t(arm, is_held, is_spring)
      end subroutine add_node

   end function skeleton_of

   !> The first measure of a joint. For every kind of joint, this measure has the joint's points.
   pure function first_measure(suspension, joint) result(measure)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: joint
      type(measure_t) :: measure
      measure = suspension%terms(suspension%rows(suspension%joints(joint)%first_row)%first)%measure
   end function first_measure

   !> Finds the two points of a measure, global [m].
   pure subroutine ends_of(measure, state, a, b)
      type(measure_t), intent(in) :: measure
      type(state_t), intent(in) :: state
      real(wp), intent(out) :: a(3), b(3)

      a = place_of(state, measure%body_i, measure%arm_i)
      b = place_of(state, measure%body_j, measure%arm_j)
   end subroutine ends_of

   !> Position of a point of a body, or of the chassis (body 0), global [m].
   pure function place_of(state, body, arm) result(at)
      type(state_t), intent(in) :: state
      integer, intent(in) :: body
      real(wp), intent(in) :: arm(3)
      real(wp) :: at(3)
      at = state%poses(body + 1)%r + rotated(state%poses(body + 1)%a, arm)
   end function place_of

   !> The ends of bar k of a body's skeleton, global [m].
   pure function bar_of(state, body, skeleton, k) result(ends)
      type(state_t), intent(in) :: state
      type(skeleton_t), intent(in) :: skeleton
      integer, intent(in) :: body, k
      real(wp) :: ends(3, 2)

      ends(:, 1) = place_of(state, body, skeleton%nodes(skeleton%bars(1, k))%arm)
      ends(:, 2) = place_of(state, body, skeleton%nodes(skeleton%bars(2, k))%arm)
   end function bar_of

   !> Whether a body is one of two moving bodies that slide along each other: the rod or the tube of a damper.
   pure logical function slides(suspension, body)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: body

      associate (j => suspension%joints)
         slides = any(joint_table(j%number)%part == slider_part .and. j%body_i*j%body_j > 0 .and. &
            (j%body_i == body .or. j%body_j == body))
      end associate
   end function slides

end module ek_skeleton
