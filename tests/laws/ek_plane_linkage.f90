!> A wheel carrier that moves in the plane across the vehicle, solved with ruler and compasses.
!>
!> Nothing of the program is used here: points are [y, z] pairs, angles turn y towards z. Below, the carrier hangs on
!> an arm that turns about `lower_inner` and holds it at `lower_ball`. Above, it is held by
!>
!> - an arm about `upper_inner` at `upper_ball` (double wishbone): upper_ball lies where the circle about upper_inner
!>   meets the circle about lower_ball, the carrier between the two being rigid; or
!> - a strut (is_strut): a line of the carrier, through `upper_ball` and `upper_inner` at design, always passes
!>   through the fixed point upper_inner. The line keeps its distance e from lower_ball. With v from lower_ball to
!>   upper_inner, e = |v| sin(angle of v − angle of the line), so the line stands at angle(v) − asin(e/|v|).
module ek_plane_linkage
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: linkage_t, carrier_t, carrier_at, carried, turned, arm_angle_at, instant_centre

   !> Design position [m].
   type :: linkage_t
      real(wp) :: lower_inner(2) = 0.0_wp, lower_ball(2) = 0.0_wp
      real(wp) :: upper_inner(2) = 0.0_wp, upper_ball(2) = 0.0_wp
      logical :: is_strut = .false.
   end type linkage_t

   !> Where the carrier is.
   type :: carrier_t
      real(wp) :: lower_ball(2) = 0.0_wp
      real(wp) :: angle = 0.0_wp               !! turned from design, y towards z [rad]
   end type carrier_t

contains

   !> v turned by an angle, y towards z.
   pure function turned(v, angle) result(w)
      real(wp), intent(in) :: v(2), angle
      real(wp) :: w(2)
      w = [cos(angle)*v(1) - sin(angle)*v(2), sin(angle)*v(1) + cos(angle)*v(2)]
   end function turned

   !> The carrier when the lower arm has turned by `arm` from design.
   pure function carrier_at(linkage, arm) result(carrier)
      type(linkage_t), intent(in) :: linkage
      real(wp), intent(in) :: arm
      type(carrier_t) :: carrier
      real(wp) :: v(2), before(2), e, along, across, r, upright, length

      carrier%lower_ball = linkage%lower_inner + turned(linkage%lower_ball - linkage%lower_inner, arm)
      v = linkage%upper_inner - carrier%lower_ball
      length = norm2(v)
      before = linkage%upper_inner - linkage%lower_ball
      if (linkage%is_strut) then
         e = cross(unit(linkage%upper_inner - linkage%upper_ball), before)
         carrier%angle = angle_between(before, v) - (asin(e/length) - asin(e/norm2(before)))
      else
         ! two circles: the foot of upper_ball on v lies `along` from lower_ball, the ball `across` beside it
         r = norm2(linkage%upper_ball - linkage%upper_inner)
         upright = norm2(linkage%upper_ball - linkage%lower_ball)
         along = (length**2 + upright**2 - r**2)/(2.0_wp*length)
         across = sign(sqrt(upright**2 - along**2), cross(before, linkage%upper_ball - linkage%lower_ball))
         carrier%angle = angle_between(linkage%upper_ball - linkage%lower_ball, &
            along*unit(v) + across*turned(unit(v), acos(0.0_wp)))
      end if
   end function carrier_at

   !> Where a point of the carrier is.
   pure function carried(linkage, carrier, point) result(place)
      type(linkage_t), intent(in) :: linkage
      type(carrier_t), intent(in) :: carrier
      real(wp), intent(in) :: point(2)         !! at design
      real(wp) :: place(2)
      place = carrier%lower_ball + turned(point - linkage%lower_ball, carrier%angle)
   end function carried

   !> The turn of the lower arm that lifts a point of the carrier by `height`: bisection between ±0.6 rad of arm
   !> angle, over which the point of a wheel rises (outboard to the left) all the way.
   pure real(wp) function arm_angle_at(linkage, point, height) result(arm)
      type(linkage_t), intent(in) :: linkage
      real(wp), intent(in) :: point(2), height
      real(wp) :: low, high, lift(2)
      integer :: k

      low = 0.6_wp          ! on the left an arm that turns y towards z goes down
      high = -0.6_wp
      do k = 1, 80          ! 1.2/2**80: below rounding
         arm = 0.5_wp*(low + high)
         lift = carried(linkage, carrier_at(linkage, arm), point) - point
         if (lift(2) < height) then
            low = arm
         else
            high = arm
         end if
      end do
   end function arm_angle_at

   !> Where the two arms' lines meet: about that point the carrier turns at this moment.
   pure function instant_centre(linkage, carrier) result(centre)
      type(linkage_t), intent(in) :: linkage
      type(carrier_t), intent(in) :: carrier
      real(wp) :: centre(2), lower(2), upper(2), ball(2)

      lower = carrier%lower_ball - linkage%lower_inner
      ball = carried(linkage, carrier, linkage%upper_ball)
      upper = ball - linkage%upper_inner
      if (linkage%is_strut) upper = turned(linkage%upper_inner - ball, acos(0.0_wp))   ! square to the strut, through its top
      centre = linkage%lower_inner + lower*(cross(linkage%upper_inner - linkage%lower_inner, upper)/cross(lower, upper))
   end function instant_centre

   pure real(wp) function cross(a, b)
      real(wp), intent(in) :: a(2), b(2)
      cross = a(1)*b(2) - a(2)*b(1)
   end function cross

   pure function unit(v) result(u)
      real(wp), intent(in) :: v(2)
      real(wp) :: u(2)
      u = v/norm2(v)
   end function unit

   !> From a to b, y towards z.
   pure real(wp) function angle_between(a, b)
      real(wp), intent(in) :: a(2), b(2)
      angle_between = atan2(cross(a, b), dot_product(a, b))
   end function angle_between

end module ek_plane_linkage
