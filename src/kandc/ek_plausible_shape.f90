!> The geometry of a deck, held against what road vehicles look like: wheels, steer axes, hardpoints, links, and what is
!> fixed to which body.
module ek_plausible_shape
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_units, only: millimetre
   use ek_measure, only: measure_t, axis_axis, rotation, distance
   use ek_spring, only: axial_spring, damper
   use ek_suspension, only: suspension_t, wheel_t, body_name
   use ek_plausible_range, only: doubts_t, judge, speak, length
   implicit none(type, external)
   private
   public :: doubt_wheels, doubt_points, doubt_links

contains

   !> Wheels, one by one and against each other.
   subroutine doubt_wheels(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: much = 0.05_wp           ! m: more than any staggered axle
      real(wp) :: centre(3, size(suspension%wheels)), height
      character(:), allocatable :: thing
      integer :: w, v

      do w = 1, size(suspension%wheels)
         associate (wheel => suspension%wheels(w))
            thing = 'wheel '//quoted(wheel%name)
            centre(:, w) = place(suspension, wheel%body, wheel%centre)
            height = wheel%centre(3) - wheel%contact(3)
            call judge(doubts, wheel%where, thing, 'half track', centre(2, w))
            call judge(doubts, wheel%where, thing, 'wheel radius', wheel%radius)
            call judge(doubts, wheel%where, thing, 'height of centre', height)
            if (abs(wheel%radius - height) > 0.15_wp*height) call doubts%add(wheel%where, 'radius', thing//': radius '// &
               speak(doubts, length, wheel%radius)//', but its centre is '//speak(doubts, length, height)// &
               ' above its contact point'//diameter(wheel%radius/height))
            call judge(doubts, wheel%where, thing, 'contact offset', norm2(wheel%contact(1:2) - wheel%centre(1:2)))
            call judge(doubts, wheel%where, thing, 'static toe', wheel%toe)
            call judge(doubts, wheel%where, thing, 'static camber', wheel%camber)
            if (wheel%tyre_rate > 0.0_wp) call judge(doubts, wheel%where, thing, 'tyre rate', wheel%tyre_rate)
            if (wheel%has_steer_axis) call doubt_steer_axis(suspension, wheel, thing, doubts)
            call doubt_carrier(suspension, w, doubts)
            do v = 1, w - 1
               associate (other => suspension%wheels(v))
                  if (other%body == wheel%body .and. other%side == wheel%side) then
                     call doubts%add(wheel%where, 'same side', thing//': body '//quoted(body_name(suspension, wheel%body))// &
                        ' has a second wheel on the same side, '//quoted(other%name)//'; twin tyres are one wheel')
                  else if (other%side /= wheel%side .and. max(abs(centre(2, w) + centre(2, v)), &
                        maxval(abs(centre([1, 3], w) - centre([1, 3], v)))) > much) then
                     call doubts%add(wheel%where, 'asymmetric', thing//': its centre is not opposite to that of wheel '// &
                        quoted(other%name)//' (off by '//speak(doubts, length, max(abs(centre(2, w) + centre(2, v)), &
                        maxval(abs(centre([1, 3], w) - centre([1, 3], v)))))//')')
                  end if
               end associate
            end do
         end associate
      end do
   end subroutine doubt_wheels

   !> What a wrong radius may be.
   pure function diameter(ratio) result(text)
      real(wp), intent(in) :: ratio
      character(:), allocatable :: text
      text = ''
      if (ratio > 1.7_wp .and. ratio < 2.3_wp) text = '; looks like the diameter'
      if (ratio > 0.43_wp .and. ratio < 0.58_wp) text = '; looks like half of it'
   end function diameter

   !> The geometric steer axis: caster, kingpin inclination, scrub radius, trail.
   subroutine doubt_steer_axis(suspension, wheel, thing, doubts)
      type(suspension_t), intent(in) :: suspension
      type(wheel_t), intent(in) :: wheel
      character(*), intent(in) :: thing
      type(doubts_t), intent(inout) :: doubts
      real(wp) :: up(3), ground(3), low(3)
      real(wp), parameter :: level = 0.7_wp        ! cosine: more than 45° from the vertical
      real(wp), parameter :: far = 0.9_wp          ! m: the top mount of a large strut is 0.7 m from the wheel centre
      integer :: lower

      lower = merge(1, 2, wheel%steer_axis(3, 1) <= wheel%steer_axis(3, 2))
      low = wheel%steer_axis(:, lower)
      up = wheel%steer_axis(:, 3 - lower) - low
      if (maxval([norm2(low - wheel%centre), norm2(low + up - wheel%centre)]) > far) call doubts%add(wheel%where, &
         'axis point', thing//': a point of its steer_axis is '//speak(doubts, length, max(norm2(low - wheel%centre), &
         norm2(low + up - wheel%centre)))//' from the wheel centre: are its coordinates swapped, or in another unit?')
      if (up(3) < level*norm2(up)) then
         call doubts%add(wheel%where, 'level axis', thing//': its steer_axis is nearly level, '//str(nint(acos(min(1.0_wp, &
            up(3)/norm2(up)))*57.29578_wp))//' deg from the vertical; it leads from the lower ball joint to the upper one or '// &
            'the top mount')
         return
      end if
      if (suspension%steering%has_steering .or. (suspension%axle%has_axle .and. suspension%axle%is_front)) then
         call judge(doubts, wheel%where, thing, 'caster of a front axle', atan2(up(1), up(3)))
      else
         call judge(doubts, wheel%where, thing, 'caster', atan2(up(1), up(3)))
      end if
      call judge(doubts, wheel%where, thing, 'kingpin inclination', atan2(-wheel%side*up(2), up(3)))
      ground = low + up*((wheel%contact(3) - low(3))/up(3))
      call judge(doubts, wheel%where, thing, 'scrub radius', wheel%side*(wheel%contact(2) - ground(2)))
      call judge(doubts, wheel%where, thing, 'caster trail', wheel%contact(1) - ground(1))
   end subroutine doubt_steer_axis

   !> Whether a wheel is on its carrier: no other body has its joints that much nearer to the wheel's centre.
   subroutine doubt_carrier(suspension, w, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: w
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: beside = 0.2_wp     ! m: joints of a carrier surround the wheel's centre nearer than that
      integer, parameter :: most = 3             ! joints at least that a carrier has
      real(wp) :: mean(3, 0:size(suspension%bodies)), off(size(suspension%bodies))
      integer :: joints(0:size(suspension%bodies)), b

      associate (wheel => suspension%wheels(w))
         if (count(suspension%wheels%body == wheel%body) > 1) return      ! a beam from wheel to wheel
         call middle_of_joints(suspension, mean, joints)
         do b = 1, size(off)
            off(b) = norm2(mean(:, b) - place(suspension, wheel%body, wheel%centre))
         end do
         do b = 1, size(off)
            if (b == wheel%body .or. joints(b) < most .or. any(suspension%wheels%body == b)) cycle
            if (2.0_wp*off(b) < off(wheel%body) .and. off(b) < beside) call doubts%add(wheel%where, 'carrier', 'wheel '// &
               quoted(wheel%name)//': it is on body '//quoted(body_name(suspension, wheel%body))//', but the joints of body '// &
               quoted(body_name(suspension, b))//' surround its centre: which of the two is the carrier?')
         end do
      end associate
   end subroutine doubt_carrier

   !> The middle of the points at which a body is held, and how many there are.
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
      do k = 1, size(suspension%bushings)
         call include(suspension%bushings(k)%body_i, suspension%bushings(k)%arm_i)
         call include(suspension%bushings(k)%body_j, suspension%bushings(k)%arm_j)
      end do
      do k = 0, ubound(joints, 1)
         mean(:, k) = mean(:, k)/max(joints(k), 1)
      end do

   contains

      subroutine include(body, arm)
         integer, intent(in) :: body
         real(wp), intent(in) :: arm(3)
         mean(:, body) = mean(:, body) + place(suspension, body, arm)
         joints(body) = joints(body) + 1
      end subroutine include

   end subroutine middle_of_joints

   !> Hardpoints that lie where no suspension is.
   subroutine doubt_points(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: tiny_place = 2.0_wp*millimetre   ! but not the origin: metres in a deck of millimetres
      real(wp), parameter :: far = 3.0_wp, tall = 1.7_wp      ! m: from the wheel, above the road
      real(wp), parameter :: beside = 0.02_wp, under = 0.03_wp, outboard = 0.25_wp
      real(wp) :: centre(3), road, half
      character(:), allocatable :: thing
      integer :: k, w

      if (size(suspension%wheels) == 0) return
      half = 0.0_wp
      centre = 0.0_wp
      road = huge(road)
      do w = 1, size(suspension%wheels)
         centre = place(suspension, suspension%wheels(w)%body, suspension%wheels(w)%contact)
         road = min(road, centre(3))
         centre = place(suspension, suspension%wheels(w)%body, suspension%wheels(w)%centre)
         half = max(half, abs(centre(2)))
      end do
      do k = 1, size(suspension%points)
         associate (p => suspension%points(k))
            if (.not. p%is_used) cycle
            thing = 'point '//quoted(p%name)//': '
            if (half > 100.0_wp*tiny_place .and. maxval(abs(p%at)) > 0.0_wp .and. maxval(abs(p%at)) < tiny_place) then
               call doubts%add(p%where, 'tiny', thing//'all its coordinates are below '//speak(doubts, length, tiny_place)// &
                  '; looks like m')
            else if (p%at(3) < road - under) then
               call doubts%add(p%where, 'under', thing//speak(doubts, length, road - p%at(3))// &
                  ' below the road: z has another sign or origin, or coordinates are swapped')
            else if (abs(p%at(2)) > half + outboard) then
               call doubts%add(p%where, 'outboard', thing//speak(doubts, length, abs(p%at(2)) - half)// &
                  ' outboard of the wheel centre: are coordinates swapped, or in another unit?')
            else if (norm2(p%at - [centre(1), sign(half, p%at(2)), centre(3)]) > far .or. p%at(3) > road + tall) then
               call doubts%add(p%where, 'far', thing//speak(doubts, length, norm2(p%at - [centre(1), sign(half, p%at(2)), &
                  centre(3)]))//' from the wheel: is it in another unit?')
            else if (size(suspension%wheels) == 1 .and. suspension%wheels(1)%side*p%at(2) < -beside) then
               call doubts%add(p%where, 'side', thing//'on the other side of the car than the wheel: has y the right sign?')
            end if
         end associate
      end do
   end subroutine doubt_points

   !> Links and springs: how long, which end is on which body, which way.
   subroutine doubt_links(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      character(:), allocatable :: thing
      real(wp) :: ends(3, 2), apart(3)
      integer :: k, rack

      rack = rack_body(suspension)
      if (rack > 0) call doubt_rack(suspension, rack, doubts)
      do k = 1, size(suspension%joints)
         associate (joint => suspension%joints(k), &
               m => suspension%terms(suspension%rows(suspension%joints(k)%first_row)%first)%measure)
            thing = 'joint '//quoted(joint%name)
            call doubt_own_points(suspension, m, joint%where, thing, doubts)
            if (joint%kind == 'cylindrical') call doubt_slider(suspension, m, joint%where, thing, doubts)
            if (joint%kind /= 'distance') cycle
            ends(:, 1) = place(suspension, m%body_i, m%arm_i)
            ends(:, 2) = place(suspension, m%body_j, m%arm_j)
            apart = ends(:, 2) - ends(:, 1)
            call judge(doubts, joint%where, thing, 'link length', norm2(apart))
            call doubt_ends(suspension, m, joint%where, thing, ends, doubts)
            if (rack == 0 .or. (m%body_i /= rack .and. m%body_j /= rack)) cycle
            if (abs(apart(2)) < 0.85_wp*norm2(apart)) call doubts%add(joint%where, 'askew', thing// &
               ': a tie rod more than 32 deg out of the lateral direction: has a coordinate of its ends another sign?')
         end associate
      end do
      do k = 1, size(suspension%bushings)
         associate (b => suspension%bushings(k))
            call doubt_own_points(suspension, measure_t(body_i=b%body_i, body_j=b%body_j, arm_i=b%arm_i, arm_j=b%arm_j), &
               b%where, 'bushing '//quoted(b%name), doubts)
         end associate
      end do
      do k = 1, size(suspension%springs)
         if (all(suspension%springs(k)%kind /= [axial_spring, damper])) cycle
         call doubt_upright(suspension, k, doubts)
      end do
   end subroutine doubt_links

   !> Something leads from the rack to the wheels.
   subroutine doubt_rack(suspension, rack, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: rack
      type(doubts_t), intent(inout) :: doubts
      integer :: k

      do k = 1, size(suspension%terms)
         if (leads(suspension%terms(k)%measure%body_i, suspension%terms(k)%measure%body_j)) return
      end do
      do k = 1, size(suspension%bushings)
         if (leads(suspension%bushings(k)%body_i, suspension%bushings(k)%body_j)) return
      end do
      do k = 1, size(suspension%springs)
         if (leads(suspension%springs(k)%measure%body_i, suspension%springs(k)%measure%body_j)) return
      end do
      call doubts%add(suspension%steering%where, 'no tie rod', '&steering: nothing leads from its rack, body '// &
         quoted(body_name(suspension, rack))//', to a wheel: is a tie rod missing?')

   contains

      pure logical function leads(i, j)
         integer, intent(in) :: i, j
         leads = (i == rack .or. j == rack) .and. min(i, j) > 0
      end function leads

   end subroutine doubt_rack

   !> A joint of the body of one wheel lies near that wheel, on its side of the car.
   subroutine doubt_own_points(suspension, m, where, thing, doubts)
      type(suspension_t), intent(in) :: suspension
      type(measure_t), intent(in) :: m
      character(*), intent(in) :: where, thing
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: beyond = 0.05_wp     ! m: beyond the middle of the car
      real(wp), parameter :: far = 0.9_wp         ! m: from the centre of a wheel that steers
      real(wp) :: at(3)
      integer :: w

      if (m%kind == axis_axis .or. m%kind == rotation) return
      do w = 1, size(suspension%wheels)
         associate (wheel => suspension%wheels(w))
            if (count(suspension%wheels%body == wheel%body) > 1) cycle
            if (m%body_i == wheel%body) then
               at = m%arm_i
            else if (m%body_j == wheel%body) then
               at = m%arm_j
            else
               cycle
            end if
            if (wheel%has_steer_axis .and. norm2(at - wheel%centre) > far) call doubts%add(where, 'far joint', thing// &
               ': on the carrier, but '//speak(doubts, length, norm2(at - wheel%centre))//' from the wheel centre: are '// &
               'coordinates swapped, or in another unit?')
            at = place(suspension, wheel%body, at)
            if (wheel%side*at(2) < -beyond) call doubts%add(where, 'other side', thing//': on the carrier of wheel '// &
               quoted(wheel%name)//', but on the other side of the car: has y the right sign?')
         end associate
      end do
   end subroutine doubt_own_points

   !> The end of a link that is on a carrier lies outboard of the one that is not.
   subroutine doubt_ends(suspension, m, where, thing, ends, doubts)
      type(suspension_t), intent(in) :: suspension
      type(measure_t), intent(in) :: m
      character(*), intent(in) :: where, thing
      real(wp), intent(in) :: ends(3, 2)           !! m, on body i and body j
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: clearly = 0.06_wp     ! m: links that lie along the car lean so much
      integer :: w, own

      do w = 1, size(suspension%wheels)
         associate (wheel => suspension%wheels(w))
            if (count(suspension%wheels%body == wheel%body) > 1) cycle
            if (any(suspension%wheels%body == m%body_i) .and. any(suspension%wheels%body == m%body_j)) cycle
            own = 0
            if (m%body_i == wheel%body) own = 1
            if (m%body_j == wheel%body) own = 2
            if (own == 0) cycle
            if (wheel%side*(ends(2, own) - ends(2, 3 - own)) < -clearly) call doubts%add(where, 'swapped', thing// &
               ': its end on body '//quoted(body_name(suspension, wheel%body))//' lies inboard of its end on '// &
               quoted(body_name(suspension, merge(m%body_j, m%body_i, own == 1)))//': are the two points swapped?')
         end associate
      end do
   end subroutine doubt_ends

   !> The axis of a strut is upright.
   subroutine doubt_slider(suspension, m, where, thing, doubts)
      type(suspension_t), intent(in) :: suspension
      type(measure_t), intent(in) :: m
      character(*), intent(in) :: where, thing
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: upright = 0.7_wp      ! cosine: 45°

      if (.not. (any(suspension%wheels%body == m%body_i) .or. any(suspension%wheels%body == m%body_j))) return
      if (m%kind /= axis_axis) return
      if (abs(m%v(3)) < upright) call doubts%add(where, 'slider', thing//': a strut that lies '// &
         str(nint(acos(min(1.0_wp, abs(m%v(3))))*57.29578_wp))//' deg from the vertical: has a coordinate another sign?')
   end subroutine doubt_slider

   !> The lower end of an upright spring is on the wheel's body, the upper one on the chassis.
   subroutine doubt_upright(suspension, k, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k
      type(doubts_t), intent(inout) :: doubts
      real(wp) :: up(3)
      integer :: order

      associate (spring => suspension%springs(k), m => suspension%springs(k)%measure)
         order = rank_of(m%body_j) - rank_of(m%body_i)
         if (order == 0 .or. m%kind /= distance) return
         up = place(suspension, m%body_j, m%arm_j) - place(suspension, m%body_i, m%arm_i)
         if (order*up(3) > -0.7_wp*norm2(up)) return
         call doubts%add(spring%where, 'upside down', merge('spring ', 'damper ', spring%kind == axial_spring)// &
            quoted(spring%name)//': its upper end is on '//quoted(body_name(suspension, merge(m%body_i, m%body_j, order > 0)))// &
            ', its lower end on '//quoted(body_name(suspension, merge(m%body_j, m%body_i, order > 0)))// &
            ': are the two points swapped?')
      end associate

   contains

      !> What is above: the chassis; below: a wheel's body.
      pure integer function rank_of(body)
         integer, intent(in) :: body
         rank_of = 0
         if (body == 0) rank_of = 1
         if (any(suspension%wheels%body == body)) rank_of = -1
      end function rank_of

   end subroutine doubt_upright

   !> The body that the driver of &steering moves; 0 where there is none.
   pure integer function rack_body(suspension)
      type(suspension_t), intent(in) :: suspension
      integer :: k

      rack_body = 0
      if (.not. suspension%steering%has_steering) return
      do k = 1, size(suspension%joints)
         if (suspension%joints(k)%kind == 'driver' .and. suspension%joints(k)%name == suspension%steering%driver) &
            rack_body = max(suspension%joints(k)%body_i, suspension%joints(k)%body_j)
      end do
   end function rack_body

   !> A point of a body at design [m].
   pure function place(suspension, body, arm) result(at)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: body
      real(wp), intent(in) :: arm(3)
      real(wp) :: at(3)
      at = arm
      if (body > 0) at = at + suspension%bodies(body)%origin
   end function place

end module ek_plausible_shape
