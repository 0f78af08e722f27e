!> The compliance of wheels that are held. A simulator adds this compliance to the kinematics.
!>
!> The travel of a wheel is a coordinate of the simulator, and the springs of the simulator act along this coordinate. The
!> compliance must therefore not contain the travel. The wheels are held as on the rig: at the height of their centres ('centre'),
!> on the road through their tyres ('road'), or not at all ('force': the vertical loads are constant).
module ek_held_compliance
   use ek_kinds, only: wp
   use ek_port_response, only: hold, load_at_patch, read_at_patch
   implicit none(type, external)
   private
   public :: held_compliance

contains

   !> The response at the wheel centres to loads at the wheel centres, with the wheels held.
   !>
   !> On the road, the tyre of rate kt pushes the contact point up with F = −kt·(rise of the contact point). With the unit vertical
   !> loads B on the contact points, the response is C − C B (Bᵀ C B + 1/kt)⁻¹ Bᵀ C.
   pure function held_compliance(c, arm, tyre_rate, held) result(response)
      real(wp), intent(in) :: c(:, :)          !! at the wheel centres, vertical loads held; six rows and columns per wheel
      real(wp), intent(in) :: arm(:, :)        !! contact point less wheel centre of each wheel [m]
      real(wp), intent(in) :: tyre_rate(:)     !! of each wheel [N/m]
      character(*), intent(in) :: held         !! 'road', 'centre' or 'force'
      real(wp) :: response(size(c, 1), size(c, 2))
      real(wp) :: raised(size(c, 1), size(c, 2)), heights(size(c, 1), size(c, 2)), both(size(c, 1), size(c, 2)), own
      integer :: w, z

      response = c
      if (held == 'centre') response = hold(c, c)
      if (held /= 'road') return
      do w = 1, size(arm, 2)       ! one tyre after the other: the second acts on what the first has left
         z = 6*w - 3
         raised = load_at_patch(response, arm)
         heights = read_at_patch(response, arm)
         both = read_at_patch(raised, arm)
         own = both(z, z) + 1.0_wp/tyre_rate(w)
         response = response - outer(raised(:, z), heights(z, :)/own)
      end do
   end function held_compliance

   pure function outer(a, b) result(m)
      real(wp), intent(in) :: a(:), b(:)
      real(wp) :: m(size(a), size(b))
      integer :: j

      do j = 1, size(b)
         m(:, j) = a*b(j)
      end do
   end function outer

end module ek_held_compliance
