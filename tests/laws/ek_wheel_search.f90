!> The lowest point of a wheel by a search on its surface, without the formulas of the program.
module ek_wheel_search
   use ek_kinds, only: wp
   use ek_rotation, only: cross
   implicit none(type, external)
   private
   public :: found_by_search

   real(wp), parameter :: up(3) = [0.0_wp, 0.0_wp, 1.0_wp]

contains

   !> The lowest point of a torus about the origin [m]: by the angle t about the axis, and s around the crown.
   pure function found_by_search(axis, core, crown) result(point)
      real(wp), intent(in) :: axis(3)           !! unit vector, not vertical
      real(wp), intent(in) :: core, crown       !! radii of the core circle, of the crown [m]
      real(wp) :: point(3), ahead(3), below(3), t, s, low, high
      integer :: k

      ahead = cross(axis, up)/norm2(cross(axis, up))
      below = cross(ahead, axis)
      if (below(3) > 0.0_wp) below = -below
      low = -1.0_wp
      high = 1.0_wp
      do k = 1, 80
         t = 0.5_wp*(low + high)
         if (-sin(t)*below(3) + cos(t)*ahead(3) > 0.0_wp) then
            high = t
         else
            low = t
         end if
      end do
      point = cos(t)*below + sin(t)*ahead
      low = -1.5_wp
      high = 1.5_wp
      do k = 1, 80
         s = 0.5_wp*(low + high)
         if (-sin(s)*point(3) + cos(s)*axis(3) > 0.0_wp) then
            high = s
         else
            low = s
         end if
      end do
      point = (core + crown*cos(s))*point + (crown*sin(s))*axis
   end function found_by_search

end module ek_wheel_search
