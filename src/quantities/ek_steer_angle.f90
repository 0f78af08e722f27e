!> Steer angles of an axle and derived quantities: roll, camber relative to the road, Ackermann, turning circle.
!>
!> Steer is positive to the left on both wheels, axle roll positive with the left wheel up. SI, rad.
module ek_steer_angle
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp, degree
   implicit none(type, external)
   private
   public :: steer_of, steer_rate, steer_gradient, axle_roll, inclination_of
   public :: ackermann_angle, ackermann_percent, ackermann_error, turning_circle, ideal_outer_steer, outer_wheel, wall_to_wall

   ! Below one degree the static toe, not the linkage, determines the difference of the two wheels: (δA − δo) is then
   ! 0.01 deg, a toe of 0.1 deg ten times that
   real(wp), parameter :: min_steer = degree
   real(wp), parameter :: widest_circle = 1000.0_wp   !! limit of the turning circle [m]: beyond, the car drives straight ahead

contains

   !> Steer angle [rad, positive to the left]: −toe on the left, toe on the right.
   pure real(wp) function steer_of(toe, side)
      real(wp), intent(in) :: toe
      integer, intent(in) :: side     !! −1 left, +1 right
      steer_of = side*toe
   end function steer_of

   !> Change of the steer angle [rad, positive to the left] under a small rotation θ of the carrier; w is the spin axis (unit,
   !> outboard).
   !>
   !>     steer = side·atan2(−w_x, side·w_y),  δw = θ×w:   δsteer = θ_z − w_z (θ_x w_x + θ_y w_y)/(w_x² + w_y²)
   !>
   !> Equation (C.10) of docs/theory/compliance.md.
   pure real(wp) function steer_rate(spin, turn) result(rate)
      real(wp), intent(in) :: spin(3), turn(3)
      rate = dot_product(steer_gradient(spin), turn)
   end function steer_rate

   !> The factors of the components of θ in the change of the steer angle (steer_rate). They serve many rotations of one carrier.
   !> Equation (C.10) of docs/theory/compliance.md.
   pure function steer_gradient(spin) result(gradient)
      real(wp), intent(in) :: spin(3)
      real(wp) :: gradient(3), lean

      lean = spin(3)/(spin(1)**2 + spin(2)**2)
      gradient(1) = -lean*spin(1)
      gradient(2) = -lean*spin(2)
      gradient(3) = 1.0_wp
   end function steer_gradient

   !> Roll of the axle against the body: atan((z_left − z_right)/track), with the track at design, as driven by the rig's test
   !> `roll`.
   pure real(wp) function axle_roll(left, right, track) result(roll)
      real(wp), intent(in) :: left(3), right(3)   !! contact points [m]
      real(wp), intent(in) :: track               !! distance of the contact points at design [m]
      roll = atan2(left(3) - right(3), track)
   end function axle_roll

   !> Camber relative to the road [rad]. The road rolls with the wheels by θ_x = −roll, which changes camber by −side·θ_x.
   pure real(wp) function inclination_of(camber, side, roll) result(inclination)
      real(wp), intent(in) :: camber, roll
      integer, intent(in) :: side
      inclination = camber - side*roll
   end function inclination_of

   !> Finds the steer angles, positive into the turn, and the side of the outer wheel.
   pure subroutine outer_wheel(left, right, inner, outer, side)
      real(wp), intent(in) :: left, right      !! positive to the left
      real(wp), intent(out) :: inner, outer
      integer, intent(out) :: side             !! of the outer wheel: 1 left, 2 right

      inner = left
      outer = right
      side = 2
      if (left + right >= 0.0_wp) return
      inner = -right
      outer = -left
      side = 1
   end subroutine outer_wheel

   !> Steer angle δA of the inner wheel [rad] at which both wheels roll about one point on the line of the rear axle, from the steer
   !> angle δo of the outer wheel, wheelbase L and track t:
   !>
   !>     δA = atan(L/(L/tan δo − t)), written as atan2(L tan δo, L − t tan δo): 0 at 0, no division
   pure real(wp) function ackermann_angle(outer, wheelbase, track) result(inner)
      real(wp), intent(in) :: outer, wheelbase, track
      inner = atan2(wheelbase*tan(outer), wheelbase - track*tan(outer))
   end function ackermann_angle

   !> The Ackermann percentage 100 (δi − δo)/(δA − δo) [%], δi of the inner and δo of the outer wheel: 100 for wheels that roll
   !> about one point, 0 for parallel steer. NaN if δo is below one degree, and if δA = δo: without a track, or with an infinite
   !> wheelbase.
   pure real(wp) function ackermann_percent(left, right, wheelbase, track) result(percent)
      real(wp), intent(in) :: left, right, wheelbase, track
      real(wp) :: inner, outer, wanted
      integer :: side

      call outer_wheel(left, right, inner, outer, side)
      percent = ieee_value(1.0_wp, ieee_quiet_nan)
      if (outer < min_steer) return
      wanted = ackermann_angle(outer, wheelbase, track) - outer
      if (abs(wanted) > 0.0_wp) percent = 100.0_wp*(inner - outer)/wanted
   end function ackermann_percent

   !> The Ackermann error δi − δA [rad]: positive if the inner wheel steers more than for pure rolling.
   pure real(wp) function ackermann_error(left, right, wheelbase, track) result(error)
      real(wp), intent(in) :: left, right, wheelbase, track
      real(wp) :: inner, outer
      integer :: side

      call outer_wheel(left, right, inner, outer, side)
      error = inner - ackermann_angle(outer, wheelbase, track)
   end function ackermann_error

   !> Diameter of the circle of the outer wheel, 2L/sin δo [m]: all wheels roll, the centre is on the line of the
   !> rear axle. NaN from one kilometre.
   pure real(wp) function turning_circle(left, right, wheelbase) result(diameter)
      real(wp), intent(in) :: left, right, wheelbase
      real(wp) :: inner, outer
      integer :: side

      call outer_wheel(left, right, inner, outer, side)
      diameter = ieee_value(1.0_wp, ieee_quiet_nan)
      if (sin(outer)*widest_circle <= 2.0_wp*wheelbase) return
      diameter = 2.0_wp*wheelbase/sin(outer)
   end function turning_circle

   !> Steer angle of the outer wheel [rad] at which both wheels roll about one point on the line of the rear axle, from the steer
   !> angle of the inner wheel: atan(L/(L/tan δi + t)), written without a division.
   pure real(wp) function ideal_outer_steer(inner, wheelbase, track) result(outer)
      real(wp), intent(in) :: inner, wheelbase, track
      outer = atan2(wheelbase*tan(inner), wheelbase + track*tan(inner))
   end function ideal_outer_steer

   !> Diameter of the circle of the outer front corner of the car [m]. The corner is the overhang f ahead of the wheels and half the
   !> width b from the middle. NaN if the turning circle is one kilometre or more.
   !>
   !>     2 √((L/tan δo − t/2 + b/2)² + (L + f)²)        about a point on the line of the rear axle
   pure real(wp) function wall_to_wall(outer, wheelbase, track, overhang, width) result(diameter)
      real(wp), intent(in) :: outer                             !! steer of the outer wheel into the turn, including static toe
      real(wp), intent(in) :: wheelbase, track, overhang, width
      diameter = ieee_value(1.0_wp, ieee_quiet_nan)
      if (sin(outer)*widest_circle <= 2.0_wp*wheelbase) return
      diameter = 2.0_wp*sqrt((wheelbase/tan(outer) - 0.5_wp*track + 0.5_wp*width)**2 + (wheelbase + overhang)**2)
   end function wall_to_wall

end module ek_steer_angle
