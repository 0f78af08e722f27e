!> The contact point of a wheel with the road.
!>
!> Without `crown_radius`, it is a point of the wheel carrier. With it, it is the lowest point of the tyre, a disc or a torus, and
!> moves in the carrier with the camber of the wheel:
!>
!>     c = p + R e − r_t n       p: wheel centre, R e: see ek_lowest_point, r_t: radius of the crown, n: up
!>
!> All other modules find the contact point at a state here. A force at the contact point acts on the material point of the carrier
!> that is there, so that levers, compliances and forces are those of a point of the carrier at c.
module ek_wheel_contact
   use ek_kinds, only: wp
   use ek_block, only: rotated
   use ek_lowest_point, only: lowest_point
   use ek_measure, only: measure_t, global_gap, contact_gap
   use ek_suspension, only: suspension_t, wheel_t, load_t
   implicit none(type, external)
   private
   public :: contact_arm, contact_lever, contact_at_design, put_at_contact, height_measure, measure_at_contact, set_rim

   real(wp), parameter :: up(3) = [0.0_wp, 0.0_wp, 1.0_wp]

contains

   !> The contact point from the reference point of the carrier [m], global axes.
   pure function contact_arm(wheel, a) result(arm)
      type(wheel_t), intent(in) :: wheel
      real(wp), intent(in) :: a(3, 3)           !! rotation matrix of the carrier
      real(wp) :: arm(3)

      if (wheel%has_crown) then
         arm = rotated(a, wheel%centre) + contact_lever(wheel, a)
      else
         arm = rotated(a, wheel%contact)
      end if
   end function contact_arm

   !> The contact point from the wheel centre [m], global axes.
   !> Equation (M.20) of docs/theory/measures.md.
   pure function contact_lever(wheel, a) result(lever)
      type(wheel_t), intent(in) :: wheel
      real(wp), intent(in) :: a(3, 3)           !! rotation matrix of the carrier
      real(wp) :: lever(3)

      if (wheel%has_crown) then
         lever = lowest_point(rotated(a, wheel%rim)) - wheel%crown*up
      else
         lever = rotated(a, wheel%contact - wheel%centre)
      end if
   end function contact_lever

   !> The lowest point of a wheel at design [m].
   pure function contact_at_design(centre, spin, core, crown) result(contact)
      real(wp), intent(in) :: centre(3)         !! m
      real(wp), intent(in) :: spin(3)           !! unit vector
      real(wp), intent(in) :: core, crown       !! radius of the core circle, of the crown [m]
      real(wp) :: contact(3)
      contact = centre + lowest_point(core*spin) - crown*up
   end function contact_at_design

   !> Sets the core circle of a wheel with a crown.
   pure subroutine set_rim(wheel)
      type(wheel_t), intent(inout) :: wheel     !! radius, crown and spin are set
      wheel%rim = (wheel%radius - wheel%crown)*wheel%spin
   end subroutine set_rim

   !> Puts a load at the contact point of a wheel.
   pure subroutine put_at_contact(wheels, w, load)
      type(wheel_t), intent(in) :: wheels(:)
      integer, intent(in) :: w                  !! index of the wheel
      type(load_t), intent(inout) :: load

      load%arm = wheels(w)%contact
      load%wheel = 0
      if (.not. wheels(w)%has_crown) return
      load%wheel = w
      load%hub = wheels(w)%centre
      load%rim = wheels(w)%rim
      load%crown = wheels(w)%crown
   end subroutine put_at_contact

   !> The height of the centre or of the contact point of a wheel above its height at design, with arms.
   pure function height_measure(suspension, w, is_at_centre) result(measure)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: w                  !! index of the wheel
      logical, intent(in) :: is_at_centre
      type(measure_t) :: measure

      associate (wheel => suspension%wheels(w))
         measure%kind = global_gap
         measure%body_j = wheel%body
         measure%u = up
         measure%arm_j = wheel%contact
         if (is_at_centre) measure%arm_j = wheel%centre
         measure%arm_i = suspension%bodies(wheel%body)%origin + measure%arm_j
         if (wheel%has_crown .and. .not. is_at_centre) call measure_at_contact(wheel, measure)
      end associate
   end function height_measure

   !> Changes a displacement from a point of the chassis to the contact point of a wheel without a crown to that of a wheel with a
   !> crown.
   pure subroutine measure_at_contact(wheel, measure)
      type(wheel_t), intent(in) :: wheel        !! arms or design points, as the measure
      type(measure_t), intent(inout) :: measure

      measure%kind = contact_gap
      measure%arm_i = measure%arm_i + wheel%crown*up
      measure%arm_j = wheel%centre
      measure%v = wheel%rim
   end subroutine measure_at_contact

end module ek_wheel_contact
