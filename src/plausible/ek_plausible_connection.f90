!> Plausibility of the connections of a deck: a spring that no part connects to a wheel, a torsion bar whose hinges turn about
!> another axis, a bushing on the axis of another arm. No equilibrium is solved.
module ek_plausible_connection
   use ek_kinds, only: wp, degree, millimetre
   use ek_text, only: str, quoted
   use ek_measure, only: measure_t, distance
   use ek_element, only: element_kinds, damper, stop_spring, torsion_spring
   use ek_element_label, only: element_label
   use ek_suspension, only: suspension_t, body_name
   use ek_plausible_range, only: doubts_t
   use ek_plausible_shape, only: centre_of
   implicit none(type, external)
   private
   public :: doubt_connections

contains

   !> Adds remarks on the connections of a model with a wheel.
   subroutine doubt_connections(suspension, doubts, carries)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      logical, intent(out) :: carries          !! .false.: a spring is connected to no wheel, which explains any response

      carries = .true.
      if (size(suspension%wheels) == 0) return
      call doubt_bearing(suspension, doubts, carries)
      call doubt_bar_axes(suspension, doubts)
      call doubt_bushing_axes(suspension, doubts)
   end subroutine doubt_connections

   !> Examines springs between the chassis and a body that is not connected to a wheel, either directly or through other bodies.
   subroutine doubt_bearing(suspension, doubts, carries)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      logical, intent(inout) :: carries
      logical :: is_reached(0:size(suspension%bodies))
      integer :: k, body

      call reach_wheels(suspension, is_reached)
      do k = 1, suspension%scalars
         associate (spring => suspension%elements(k))
            body = max(spring%measure%body_i, spring%measure%body_j)
            if (.not. element_kinds(spring%kind)%carries .or. spring%measure%kind /= distance) cycle
            if (min(spring%measure%body_i, spring%measure%body_j) > 0 .or. is_reached(body)) cycle
            carries = .false.
            call doubts%examine(spring%where, element_label(spring))
            call doubts%add('bearing', 'it does not carry a wheel: it acts between body '// &
               quoted(body_name(suspension, body))//' and the chassis, but no rod, joint or bushing connects '// &
               quoted(body_name(suspension, body))//' to a wheel; is the link or rod missing?')
         end associate
      end do
   end subroutine doubt_bearing

   !> Marks the bodies that rods, joints, bushings and springs connect to a wheel without passing through the chassis.
   subroutine reach_wheels(suspension, is_reached)
      type(suspension_t), intent(in) :: suspension
      logical, intent(out) :: is_reached(0:)
      logical :: has_grown
      integer :: k

      is_reached = .false.
      do k = 1, size(suspension%wheels)
         is_reached(suspension%wheels(k)%body) = .true.
      end do
      has_grown = .true.
      do while (has_grown)
         has_grown = .false.
         do k = 1, size(suspension%terms)
            call pass(suspension%terms(k)%measure)
         end do
         do k = 1, size(suspension%elements)
            if (any(suspension%elements(k)%kind == [damper, stop_spring])) cycle
            call pass(suspension%elements(k)%measure)
         end do
      end do

   contains

      !> Marks both bodies of a measure as reached, if one of them is reached.
      subroutine pass(m)
         type(measure_t), intent(in) :: m
         if (min(m%body_i, m%body_j) == 0) return
         if (is_reached(m%body_i) .eqv. is_reached(m%body_j)) return
         is_reached([m%body_i, m%body_j]) = .true.
         has_grown = .true.
      end subroutine pass

   end subroutine reach_wheels

   !> Examines torsion springs between two bodies that are both hinged on the chassis. Each hinge should turn about the axis of the
   !> torsion spring.
   subroutine doubt_bar_axes(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: aslant = 30.0_wp*degree      ! more than the legs of a bent bar are turned from each other
      real(wp) :: hinge(3), off
      integer :: k, j

      do k = 1, suspension%scalars
         associate (bar => suspension%elements(k))
            if (bar%kind /= torsion_spring .or. min(bar%measure%body_i, bar%measure%body_j) == 0) cycle
            do j = 1, size(suspension%joints)
               if (.not. is_hinge_of(suspension, j, bar%measure)) cycle
               hinge = hinge_axis(suspension, j)
               off = acos(min(1.0_wp, abs(dot_product(hinge, bar%measure%u))/(norm2(hinge)*norm2(bar%measure%u))))
               if (off < aslant) cycle
               call doubts%examine(bar%where, element_label(bar))
               call doubts%add('bar axis', 'its axis and that of hinge '//quoted(suspension%joints(j)%name)//' of its body '// &
                  quoted(body_name(suspension, max(suspension%joints(j)%body_i, suspension%joints(j)%body_j)))//' differ by '// &
                  str(nint(off/degree))//' deg, so that the hinge does not twist the bar; give both the same axis')
               exit
            end do
         end associate
      end do
   end subroutine doubt_bar_axes

   !> Whether joint j is a revolute joint between the chassis and a body of the measure.
   pure logical function is_hinge_of(suspension, j, m)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: j
      type(measure_t), intent(in) :: m

      associate (joint => suspension%joints(j))
         is_hinge_of = joint%kind == 'revolute' .and. min(joint%body_i, joint%body_j) == 0 .and. &
            any(max(joint%body_i, joint%body_j) == [m%body_i, m%body_j])
      end associate
   end function is_hinge_of

   !> Axis of a revolute joint at design: the direction that its two rows on directions leave free.
   pure function hinge_axis(suspension, j) result(axis)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: j
      real(wp) :: axis(3)
      axis = suspension%terms(suspension%rows(suspension%joints(j)%first_row + 3)%first)%measure%v
   end function hinge_axis

   !> Examines bushings of bodies with at least three bushings to the chassis. Adds a remark on a bushing that is on the axis of the
   !> only bushing of another body, and off the axes of the other bushings of its own body.
   subroutine doubt_bushing_axes(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      integer :: k, other, first, n

      first = suspension%scalars + 1
      n = size(suspension%elements)
      do k = first, n
         if (on_chassis(suspension, k) == 0) cycle
         do other = first, n
            if (on_chassis(suspension, other) == 0 .or. on_chassis(suspension, other) == on_chassis(suspension, k)) cycle
            if (mounts_of(suspension, on_chassis(suspension, other)) > 1) cycle
            if (mounts_of(suspension, on_chassis(suspension, k)) < 3) cycle
            if (.not. (are_coaxial(suspension, k, other) .and. .not. is_coaxial_with_own(suspension, k))) cycle
            call doubts%examine(suspension%elements(k)%where, element_label(suspension%elements(k)))
            call doubts%add('own axis', 'it is on body '//quoted(body_name(suspension, on_chassis(suspension, k)))// &
               ', but lies on the axis of '//element_label(suspension%elements(other))//', which is the only mount of body '// &
               quoted(body_name(suspension, on_chassis(suspension, other)))//'; should it be on that body?')
         end do
      end do
   end subroutine doubt_bushing_axes

   !> Index of the body that an element connects to the chassis; 0 for an element between two other bodies.
   pure integer function on_chassis(suspension, k) result(body)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k

      associate (m => suspension%elements(k)%measure)
         body = 0
         if (min(m%body_i, m%body_j) == 0) body = max(m%body_i, m%body_j)
      end associate
   end function on_chassis

   !> Number of bushings between a body and the chassis.
   pure integer function mounts_of(suspension, body) result(mounts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: body
      integer :: k

      mounts = 0
      do k = suspension%scalars + 1, size(suspension%elements)
         if (on_chassis(suspension, k) == body) mounts = mounts + 1
      end do
   end function mounts_of

   !> Whether bushing k is coaxial with another bushing between the same body and the chassis.
   pure logical function is_coaxial_with_own(suspension, k)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k
      integer :: j

      is_coaxial_with_own = .false.
      do j = suspension%scalars + 1, size(suspension%elements)
         if (j == k .or. on_chassis(suspension, j) /= on_chassis(suspension, k)) cycle
         is_coaxial_with_own = is_coaxial_with_own .or. are_coaxial(suspension, k, j)
      end do
   end function is_coaxial_with_own

   !> Whether each of two bushings is within 2 mm of the z axis of the other bushing, and both are more than 30 mm apart.
   pure logical function are_coaxial(suspension, a, b)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: a, b
      real(wp), parameter :: near = 2.0_wp*millimetre, apart = 30.0_wp*millimetre
      real(wp) :: to(3)

      to = centre_of(suspension, b) - centre_of(suspension, a)
      are_coaxial = norm2(to) > apart .and. off_axis(suspension, a, to) < near .and. off_axis(suspension, b, to) < near
   end function are_coaxial

   !> Distance of a point from the z axis of a bushing [m].
   pure real(wp) function off_axis(suspension, k, to)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k
      real(wp), intent(in) :: to(3)              !! from the bushing [m]

      associate (axis => suspension%elements(k)%bushing%axes(:, 3))
         off_axis = norm2(to - dot_product(to, axis)*axis)
      end associate
   end function off_axis

end module ek_plausible_connection
