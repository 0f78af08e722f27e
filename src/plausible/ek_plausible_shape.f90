!> Plausibility of the geometry of a deck: wheels, steering axes, carriers, hardpoints.
module ek_plausible_shape
   use ek_kinds, only: wp, millimetre, degree
   use ek_text, only: str, quoted
   use ek_measure, only: axis_axis, rotation
   use ek_suspension, only: suspension_t, wheel_t, body_name
   use ek_element, only: axial_spring
   use ek_plausible_range, only: doubts_t, size_t, size_of, length
   implicit none(type, external)
   private
   public :: doubt_wheels, doubt_points, point_of, centre_of, vehicle_size

contains

   !> Examines each wheel, and each pair of wheels.
   subroutine doubt_wheels(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: much = 0.05_wp           ! m: more than any staggered axle
      real(wp) :: centre(3, size(suspension%wheels)), height, off
      character(26) :: hint
      integer :: w, v

      do w = 1, size(suspension%wheels)
         associate (wheel => suspension%wheels(w))
            call doubts%examine(wheel%where, 'wheel '//quoted(wheel%name))
            centre(:, w) = point_of(suspension, wheel%body, wheel%centre)
            height = wheel%centre(3) - wheel%contact(3)
            call doubts%judge('half track', centre(2, w))
            call doubts%judge('wheel radius', wheel%radius)
            call doubts%judge('height of centre', height)
            hint = ''
            if (wheel%radius > 1.7_wp*height .and. wheel%radius < 2.3_wp*height) hint = '; looks like the diameter'
            if (wheel%radius > 0.43_wp*height .and. wheel%radius < 0.58_wp*height) hint = '; looks like half of it'
            if (abs(wheel%radius - height) > 0.15_wp*height) call doubts%add('radius', 'radius '// &
               doubts%speak(length, wheel%radius)//', but its centre is '//doubts%speak(length, height)// &
               ' above its contact point'//trim(hint))
            call doubts%judge('contact offset', norm2(wheel%contact(1:2) - wheel%centre(1:2)))
            call doubts%judge('static toe', wheel%toe, rim=2.0_wp*wheel%radius, is_computed=wheel%gives_spin)
            call doubts%judge('static camber', wheel%camber, is_computed=wheel%gives_spin)
            if (wheel%tyre_rate > 0.0_wp) call doubts%judge('tyre rate', wheel%tyre_rate)
            if (wheel%has_steer_axis) call doubt_steer_axis(suspension, wheel, doubts)
            call doubt_carrier(suspension, w, doubts)
            do v = 1, w - 1
               associate (other => suspension%wheels(v))
                  off = max(abs(centre(2, w) + centre(2, v)), maxval(abs(centre([1, 3], w) - centre([1, 3], v))))
                  if (other%body == wheel%body .and. other%side == wheel%side) then
                     call doubts%add('same side', 'body '//quoted(body_name(suspension, wheel%body))// &
                        ' has a second wheel on the same side, '//quoted(other%name)//'; dual tyres count as one wheel')
                  else if (other%side /= wheel%side .and. off > much) then
                     call doubts%add('asymmetric', 'its centre is not opposite to that of wheel '//quoted(other%name)// &
                        ' (off by '//doubts%speak(length, off)//')')
                  end if
               end associate
            end do
         end associate
      end do
   end subroutine doubt_wheels

   !> Examines the geometric steering axis: caster, kingpin inclination, scrub radius, trail.
   subroutine doubt_steer_axis(suspension, wheel, doubts)
      type(suspension_t), intent(in) :: suspension
      type(wheel_t), intent(in) :: wheel
      type(doubts_t), intent(inout) :: doubts
      real(wp) :: up(3), ground(3), low(3), off
      real(wp), parameter :: level = 0.7_wp        ! cosine: more than 45° from the vertical
      real(wp), parameter :: far = 0.9_wp          ! m: the top mount of a large strut is 0.7 m from the wheel centre
      integer :: lower
      logical :: is_front

      lower = merge(1, 2, wheel%steer_axis(3, 1) <= wheel%steer_axis(3, 2))
      low = wheel%steer_axis(:, lower)
      up = wheel%steer_axis(:, 3 - lower) - low
      off = max(norm2(low - wheel%centre), norm2(low + up - wheel%centre))
      if (off > far) call doubts%add('axis point', 'a point of its steer_axis is '//doubts%speak(length, off)// &
         ' from the wheel centre; check the order and the unit of its coordinates')
      if (up(3) < level*norm2(up)) then
         call doubts%add('level axis', 'its steer_axis is nearly horizontal, '//str(nint(acos(min(1.0_wp, &
            up(3)/norm2(up)))/degree))//' deg from the vertical; it runs from the lower ball joint to the upper one or '// &
            'the top mount')
         return
      end if
      is_front = suspension%steering%has_steering .or. (suspension%axle%has_axle .and. suspension%axle%is_front)
      call doubts%judge(trim(merge('caster of a front axle', 'caster                ', is_front)), atan2(up(1), up(3)))
      call doubts%judge('kingpin inclination', atan2(-wheel%side*up(2), up(3)))
      ground = low + up*((wheel%contact(3) - low(3))/up(3))
      call doubts%judge('scrub radius', wheel%side*(wheel%contact(2) - ground(2)))
      call doubts%judge('mechanical trail', wheel%contact(1) - ground(1))
   end subroutine doubt_steer_axis

   !> Checks that a wheel is on the right carrier: no other body has its joints much nearer to the wheel centre.
   subroutine doubt_carrier(suspension, w, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: w
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: beside = 0.2_wp     ! m: the joints of a carrier are nearer to the wheel's centre than this, on average
      integer, parameter :: most = 3             ! least number of joints of a carrier
      real(wp) :: mean(3, 0:size(suspension%bodies)), off(size(suspension%bodies))
      integer :: joints(0:size(suspension%bodies)), b

      associate (wheel => suspension%wheels(w))
         if (count(suspension%wheels%body == wheel%body) > 1) return      ! a beam from wheel to wheel
         call middle_of_joints(suspension, mean, joints)
         off = norm2(mean(:, 1:) - spread(point_of(suspension, wheel%body, wheel%centre), 2, size(off)), dim=1)
         do b = 1, size(off)
            if (b == wheel%body .or. joints(b) < most .or. any(suspension%wheels%body == b)) cycle
            if (2.0_wp*off(b) < off(wheel%body) .and. off(b) < beside) call doubts%add('carrier', &
               'it is on body '//quoted(body_name(suspension, wheel%body))//', but the joints of body '// &
               quoted(body_name(suspension, b))//' surround its centre: which of the two is the carrier?')
         end do
      end associate
   end subroutine doubt_carrier

   !> Computes the mean position of the attachment points of each body (joints and bushings) [m], and the number of these points.
   subroutine middle_of_joints(suspension, mean, joints)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(out) :: mean(:, 0:)
      integer, intent(out) :: joints(0:)
      integer :: k

      mean = 0.0_wp
      joints = 0
      do k = 1, size(suspension%joints)
         associate (m => suspension%terms(suspension%rows(suspension%joints(k)%first_row)%first)%measure)
            if (suspension%joints(k)%is_of_measures) cycle
            if (m%kind == rotation .or. (m%kind == axis_axis .and. suspension%joints(k)%rows < 4)) cycle
            call include(m%body_i, m%arm_i)
            call include(m%body_j, m%arm_j)
         end associate
      end do
      do k = suspension%scalars + 1, size(suspension%elements)
         associate (m => suspension%elements(k)%measure)
            call include(m%body_i, m%arm_i)
            call include(m%body_j, m%arm_j)
         end associate
      end do
      do k = 0, ubound(joints, 1)
         mean(:, k) = mean(:, k)/max(joints(k), 1)
      end do

   contains

      !> Adds an attachment point to the sum of the positions of a body.
      subroutine include(body, arm)
         integer, intent(in) :: body
         real(wp), intent(in) :: arm(3)
         mean(:, body) = mean(:, body) + point_of(suspension, body, arm)
         joints(body) = joints(body) + 1
      end subroutine include

   end subroutine middle_of_joints

   !> Adds a remark on each used hardpoint that is outside the usual space of a suspension.
   subroutine doubt_points(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: tiny_place = 2.0_wp*millimetre   ! but not the origin: metres in a deck of millimetres
      real(wp), parameter :: far = 3.0_wp, tall = 1.7_wp      ! m: from the wheel, above the road
      real(wp), parameter :: beside = 0.02_wp, under = 0.03_wp, outboard = 0.25_wp
      real(wp) :: centres(3, size(suspension%wheels)), heights(size(suspension%wheels)), road, half, off
      integer :: k, w

      if (size(suspension%wheels) == 0) return
      do w = 1, size(suspension%wheels)
         centres(:, w) = point_of(suspension, suspension%wheels(w)%body, suspension%wheels(w)%centre)
         heights(w) = centres(3, w) + suspension%wheels(w)%contact(3) - suspension%wheels(w)%centre(3)
      end do
      half = maxval(abs(centres(2, :)))
      road = minval(heights)
      do k = 1, size(suspension%points)
         associate (p => suspension%points(k))
            if (.not. p%is_used) cycle
            off = norm2(p%at - [centres(1, size(heights)), sign(half, p%at(2)), centres(3, size(heights))])
            call doubts%examine(p%where, 'point '//quoted(p%name))
            if (half > 100.0_wp*tiny_place .and. maxval(abs(p%at)) > 0.0_wp .and. maxval(abs(p%at)) < tiny_place) then
               call doubts%add('tiny', 'all its coordinates are below '//doubts%speak(length, tiny_place)// &
                  '; looks like m')
            else if (p%at(3) < road - under) then
               call doubts%add('under', doubts%speak(length, road - p%at(3))// &
                  ' below the road; check the sign and the origin of z, and the order of the coordinates')
            else if (abs(p%at(2)) > half + outboard) then
               call doubts%add('outboard', doubts%speak(length, abs(p%at(2)) - half)// &
                  ' outboard of the wheel centre; check the order and the unit of the coordinates')
            else if (off > far .or. p%at(3) > road + tall) then
               call doubts%add('far', doubts%speak(length, off)//' from the wheel; check its unit')
            else if (size(suspension%wheels) == 1 .and. suspension%wheels(1)%side*p%at(2) < -beside) then
               call doubts%add('side', 'on the other side of the car than the wheel; check the sign of y')
            end if
         end associate
      end do
   end subroutine doubt_points

   !> Position of a point of a body at design [m].
   pure function point_of(suspension, body, arm) result(at)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: body
      real(wp), intent(in) :: arm(3)
      real(wp) :: at(3)
      at = arm
      if (body > 0) at = at + suspension%bodies(body)%origin
   end function point_of

   !> The position of an element's point on its first body at design [m].
   pure function centre_of(suspension, k) result(at)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k
      real(wp) :: at(3)
      associate (m => suspension%elements(k)%measure)
         at = point_of(suspension, m%body_i, m%arm_i)
      end associate
   end function centre_of

   !> The size of a vehicle, which decides its ranges; of any size if the radius of a wheel contradicts the height of its centre.
   pure type(size_t) function vehicle_size(suspension) result(size_of_car)
      type(suspension_t), intent(in) :: suspension
      real(wp), parameter :: differs = 0.15_wp
      real(wp) :: height, load, rate
      integer :: k, w

      if (size(suspension%wheels) == 0) return
      load = 0.0_wp
      do w = 1, size(suspension%wheels)
         associate (wheel => suspension%wheels(w))
            height = wheel%centre(3) - wheel%contact(3)
            if (abs(wheel%radius - height) > differs*abs(height)) return
            do k = 1, size(suspension%loads)
               if (.not. suspension%loads(k)%is_case .and. suspension%loads(k)%body == wheel%body) &
                  load = max(load, abs(suspension%loads(k)%force(3)))
            end do
         end associate
      end do
      rate = 0.0_wp       ! a rod may be a stiff spring, so that the softest one counts
      do k = 1, suspension%scalars
         associate (spring => suspension%elements(k))
            if (spring%kind /= axial_spring .or. .not. spring%law%rate > 0.0_wp) cycle
            if (.not. rate > 0.0_wp .or. spring%law%rate < rate) rate = spring%law%rate
         end associate
      end do
      size_of_car = size_of(suspension%wheels(1)%radius, merge(suspension%axle%wheelbase, 0.0_wp, suspension%axle%has_axle), &
         load, rate)
   end function vehicle_size

end module ek_plausible_shape
