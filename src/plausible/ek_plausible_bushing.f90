!> Plausibility of the bushings of a deck: rates along the wrong axis, rates in another order than x, y, z, and an arm whose two
!> bushings are on different bodies.
!>
!> An arm turns about the line through its two bushings. The axial rate of a bushing, along this line, is the third of kt (z) and
!> much the smallest; the third of kr is the torsional rate, also the smallest.
module ek_plausible_bushing
   use ek_kinds, only: wp, degree, millimetre
   use ek_text, only: str, quoted
   use ek_element, only: element_t, bushing_element
   use ek_element_label, only: element_label
   use ek_suspension, only: suspension_t, body_name
   use ek_plausible_range, only: doubts_t, rate, rotation_rate
   use ek_plausible_shape, only: centre_of, point_of
   implicit none(type, external)
   private
   public :: doubt_bushings

   real(wp), parameter :: soft = 0.5_wp                   !! an axial rate is below this share of both radial rates
   real(wp), parameter :: apart = 30.0_wp*millimetre      !! least distance between the two bushings of an arm

contains

   !> Adds remarks on the bushings of a model.
   subroutine doubt_bushings(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      logical :: has_axes
      integer :: k

      has_axes = any(suspension%elements%gives_z .or. suspension%elements%gives_x)
      do k = suspension%scalars + 1, size(suspension%elements)
         if (suspension%elements(k)%kind /= bushing_element) cycle
         call doubts%examine(suspension%elements(k)%where, element_label(suspension%elements(k)))
         call doubt_missing_axis(suspension, k, has_axes, doubts)
         call doubt_order(suspension%elements(k), doubts)
         call doubt_voided_order(suspension, k, doubts)
         call doubt_partner(suspension, k, doubts)
      end do
   end subroutine doubt_bushings

   !> Examines a bushing of an arm without axes of its own: its axial rate should act along the pivot of the arm, not along the z
   !> axis of the deck. The pivot is the line to the other bushing of the arm, or to its only ball joint on the same body. A deck in
   !> which no bushing has axes may use the axes of the deck on purpose; there, both bushings of the arm must have an axial rate.
   subroutine doubt_missing_axis(suspension, k, has_axes, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k
      logical, intent(in) :: has_axes              !! any bushing of the deck has axes
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: aslant = 30.0_wp*degree
      real(wp) :: line(3), off
      character(:), allocatable :: partner
      integer :: twin
      logical :: is_of_kr

      associate (bushing => suspension%elements(k))
         if (bushing%gives_z .or. bushing%gives_x) return
         is_of_kr = .not. is_axial(bushing, .false.)
         if (is_of_kr .and. .not. is_axial(bushing, .true.)) return
         twin = twin_of(suspension, k)
         if (twin > 0) then
            if (.not. has_axes .and. .not. is_axial(suspension%elements(twin), is_of_kr)) return
            line = centre_of(suspension, twin) - centre_of(suspension, k)
            partner = element_label(suspension%elements(twin))
         else
            if (.not. has_axes) return
            twin = ball_joint_of(suspension, k)
            if (twin == 0) return
            line = ball_of(suspension, twin) - centre_of(suspension, k)
            partner = 'joint '//quoted(suspension%joints(twin)%name)
         end if
         off = acos(min(1.0_wp, abs(line(3))/norm2(line)))
         if (off < aslant) return
         call doubts%add('no axis', 'it has no z_axis, so that the third of '//trim(merge('kr', 'kt', is_of_kr))// &
            third_rate(bushing, is_of_kr, doubts)//' acts '//trim(merge('about', 'along', is_of_kr))// &
            ' z of the deck, '//str(nint(off/degree))//' deg from the line to '//partner// &
            ', about which body '//quoted(body_name(suspension, arm_of(suspension, k)))//' turns; give z_axis or z_vector '// &
            '(z_vector = 0, 0, 1 if the bushing is upright)')
      end associate
   end subroutine doubt_missing_axis

   !> The third rate in parentheses: ' (800 N/mm)'; '' if a curve replaces it.
   pure function third_rate(bushing, is_of_kr, doubts) result(text)
      type(element_t), intent(in) :: bushing
      logical, intent(in) :: is_of_kr
      type(doubts_t), intent(in) :: doubts
      character(:), allocatable :: text

      text = ''
      if (is_of_kr) then
         if (bushing%bushing%kr(3) > 0.0_wp) text = ' ('//doubts%speak(rotation_rate, bushing%bushing%kr(3))//')'
      else
         if (bushing%bushing%kt(3) > 0.0_wp) text = ' ('//doubts%speak(rate, bushing%bushing%kt(3))//')'
      end if
   end function third_rate

   !> Whether the third rate is axial: soft against both others. A curve along z beside two rates is axial, too.
   pure logical function is_axial(bushing, is_of_kr)
      type(element_t), intent(in) :: bushing
      logical, intent(in) :: is_of_kr              !! judge kr instead of kt
      real(wp) :: k(3)

      k = bushing%bushing%kt
      if (is_of_kr) k = bushing%bushing%kr
      is_axial = k(3) > 0.0_wp .and. k(3) <= soft*min(k(1), k(2))
      if (is_of_kr .or. .not. bushing%bushing%has_curves) return
      is_axial = is_axial .or. (bushing%bushing%laws(3)%has_curve .and. min(k(1), k(2)) > 0.0_wp)
   end function is_axial

   !> Examines the order of the rates of a bushing whose z axis alone is given: two rates that are equal are the radial ones, so the
   !> softer third rate must stand last.
   subroutine doubt_order(bushing, doubts)
      type(element_t), intent(in) :: bushing
      type(doubts_t), intent(inout) :: doubts
      integer :: odd

      if (bushing%gives_x .or. .not. bushing%gives_z) return
      odd = odd_rate(bushing%bushing%kt)
      if (odd == 1 .or. odd == 2) call doubts%add('order of kt', 'the '//trim(merge('first ', 'second', odd == 1))// &
         ' of kt, '//doubts%speak(rate, bushing%bushing%kt(odd))//', is much softer than the other two, which are equal; the '// &
         'order is x, y, z, with the axial rate along z_axis last')
      odd = odd_rate(bushing%bushing%kr)
      if (odd == 1 .or. odd == 2) call doubts%add('order of kr', 'the '//trim(merge('first ', 'second', odd == 1))// &
         ' of kr, '//doubts%speak(rotation_rate, bushing%bushing%kr(odd))//', is much softer than the other two, which are '// &
         'equal; the order is x, y, z, with the torsional rate about z_axis last')
   end subroutine doubt_order

   !> Index of the rate that is soft against the other two, which agree within 2 %; 0 if there is none, or if a rate is 0.
   pure integer function odd_rate(k) result(odd)
      real(wp), intent(in) :: k(3)
      real(wp), parameter :: same = 0.02_wp
      integer :: j

      odd = 0
      if (.not. minval(k) > 0.0_wp) return
      do j = 1, 3
         associate (a => k(modulo(j, 3) + 1), b => k(modulo(j + 1, 3) + 1))
            if (abs(a - b) <= same*max(a, b) .and. k(j) <= soft*min(a, b)) odd = j
         end associate
      end do
   end function odd_rate

   !> Examines the order of the rates of an arm's bushing with unequal radial rates. Its kr shows which direction is the axis: the
   !> torsional rate is the odd one. No bushing with voids is five times softer in one radial direction than along its axis.
   subroutine doubt_voided_order(suspension, k, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: void = 0.2_wp
      integer :: low

      associate (bushing => suspension%elements(k), kt => suspension%elements(k)%bushing%kt)
         if (.not. (bushing%gives_z .and. minval(kt) > 0.0_wp)) return
         if (odd_rate(bushing%bushing%kr) /= 3 .or. twin_of(suspension, k) == 0) return
         low = minloc(kt, dim=1)
         if (low == 3) return
         if (kt(low) > void*min(kt(3 - low), kt(3)) .or. kt(3) < soft*kt(3 - low)) return
         if (abs(kt(3) - kt(3 - low)) < 0.02_wp*kt(3)) return      ! stiff in all directions but one, as chosen by x_axis
         call doubts%add('order of kt', 'the '//trim(merge('first ', 'second', low == 1))//' of kt, '// &
            doubts%speak(rate, kt(low))//', is much softer than the third, '//doubts%speak(rate, kt(3))// &
            ', along its axis; the order is x, y, z, with the axial rate along z_axis last')
      end associate
   end subroutine doubt_voided_order

   !> Examines a bushing between an arm and the chassis. A bushing of this arm on a subframe with the same axis belongs to the same
   !> body.
   subroutine doubt_partner(suspension, k, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k
      type(doubts_t), intent(inout) :: doubts
      integer :: arm, j, twin, frame, partner

      arm = arm_of(suspension, k)
      if (arm == 0 .or. partner_of(suspension, k, arm) /= 0) return
      twin = 0
      frame = 0
      do j = suspension%scalars + 1, size(suspension%elements)
         partner = partner_of(suspension, j, arm)
         if (j == k .or. partner < 0) cycle
         if (partner == 0) return                  ! a further bushing on the chassis
         if (.not. is_subframe(suspension, partner)) cycle
         if (twin > 0) return
         twin = j
         frame = partner
      end do
      if (twin == 0) return
      if (.not. is_coaxial(suspension, k, twin)) return
      call doubts%add('one on the chassis', 'it is on the chassis, but '//element_label(suspension%elements(twin))// &
         ', with the same axis and also on body '//quoted(body_name(suspension, arm))//', is on body '// &
         quoted(body_name(suspension, frame))//': both bushings of an arm are usually on the same body; check bodies')
   end subroutine doubt_partner

   !> Whether two bushings of an arm have the same axis: the line between both. A bushing without axes has any axis.
   pure logical function is_coaxial(suspension, a, b)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: a, b
      real(wp), parameter :: along = 0.94_wp       ! cosine: 20°
      real(wp) :: line(3)

      line = centre_of(suspension, b) - centre_of(suspension, a)
      is_coaxial = norm2(line) > apart
      if (.not. is_coaxial) return
      line = line/norm2(line)
      is_coaxial = is_along(a) .and. is_along(b)

   contains

      pure logical function is_along(k)
         integer, intent(in) :: k
         is_along = .not. suspension%elements(k)%gives_z .or. &
            abs(dot_product(line, suspension%elements(k)%bushing%axes(:, 3))) > along
      end function is_along

   end function is_coaxial

   !> Whether a body is a subframe: bushings or joints connect it to the chassis at two points or more, and it carries no wheel.
   pure logical function is_subframe(suspension, body)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: body
      integer :: k, mounts

      is_subframe = .false.
      if (any(suspension%wheels%body == body)) return
      mounts = 0
      do k = suspension%scalars + 1, size(suspension%elements)
         if (partner_of(suspension, k, body) == 0) mounts = mounts + 1
      end do
      do k = 1, size(suspension%joints)
         associate (joint => suspension%joints(k))
            if (joint%is_of_measures .or. joint%kind == 'distance') cycle
            if (min(joint%body_i, joint%body_j) == 0 .and. max(joint%body_i, joint%body_j) == body) mounts = mounts + 1
         end associate
      end do
      is_subframe = mounts > 1
   end function is_subframe

   !> Index of the only other bushing between the same two bodies, on the same side of the car; 0 if there is none, or more.
   pure integer function twin_of(suspension, k) result(twin)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k
      real(wp) :: here(3), there(3)
      integer :: j, twins

      twin = 0
      twins = 0
      associate (m => suspension%elements(k)%measure)
         do j = suspension%scalars + 1, size(suspension%elements)
            associate (other => suspension%elements(j)%measure)
               if (j == k .or. min(m%body_i, m%body_j) /= min(other%body_i, other%body_j) .or. &
                  max(m%body_i, m%body_j) /= max(other%body_i, other%body_j)) cycle
               twins = twins + 1
               twin = j
            end associate
         end do
      end associate
      if (twins == 1) then
         here = centre_of(suspension, k)
         there = centre_of(suspension, twin)
         if (here(2)*there(2) > 0.0_wp .and. norm2(there - here) > apart) return
      end if
      twin = 0
   end function twin_of

   !> Index of the only ball joint between the bodies of bushing k, on the same side of the car; 0 if there is none, or if another
   !> joint or bushing connects the two bodies.
   pure integer function ball_joint_of(suspension, k) result(ball)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k
      real(wp) :: here(3), there(3)
      integer :: j, connections

      ball = 0
      connections = 0
      associate (m => suspension%elements(k)%measure)
         do j = suspension%scalars + 1, size(suspension%elements)
            associate (other => suspension%elements(j)%measure)
               if (j /= k .and. min(m%body_i, m%body_j) == min(other%body_i, other%body_j) .and. &
                  max(m%body_i, m%body_j) == max(other%body_i, other%body_j)) return
            end associate
         end do
         do j = 1, size(suspension%joints)
            associate (joint => suspension%joints(j))
               if (min(m%body_i, m%body_j) /= min(joint%body_i, joint%body_j) .or. &
                  max(m%body_i, m%body_j) /= max(joint%body_i, joint%body_j)) cycle
               connections = connections + 1
               if (joint%kind == 'spherical') ball = j
            end associate
         end do
      end associate
      if (connections == 1 .and. ball > 0) then
         here = centre_of(suspension, k)
         there = ball_of(suspension, ball)
         if (here(2)*there(2) > 0.0_wp .and. norm2(there - here) > apart) return
      end if
      ball = 0
   end function ball_joint_of

   !> Centre of a ball joint at design [m].
   pure function ball_of(suspension, joint) result(at)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: joint
      real(wp) :: at(3)

      associate (m => suspension%terms(suspension%rows(suspension%joints(joint)%first_row)%first)%measure)
         at = point_of(suspension, m%body_i, m%arm_i)
      end associate
   end function ball_of

   !> Index of the body of a bushing that is the arm: the body that is farther from the chassis, which is not a subframe.
   pure integer function arm_of(suspension, k) result(arm)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k

      associate (m => suspension%elements(k)%measure)
         arm = m%body_j
         if (m%body_j == 0) arm = m%body_i
         if (min(m%body_i, m%body_j) == 0) return
         if (is_subframe(suspension, m%body_j)) arm = m%body_i
      end associate
   end function arm_of

   !> The other body of a bushing of a body; −1 if element k is not a bushing of this body.
   pure integer function partner_of(suspension, k, body) result(partner)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k, body

      partner = -1
      associate (element => suspension%elements(k))
         if (element%kind /= bushing_element) return
         if (element%measure%body_i == body) partner = element%measure%body_j
         if (element%measure%body_j == body) partner = element%measure%body_i
      end associate
   end function partner_of

end module ek_plausible_bushing
