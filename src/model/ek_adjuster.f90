!> Adjusters: rods with a thread, shims, slots and spring seats, by which an axle is set up after it was built.
!>
!> The value of an adjuster is 0 as drawn. An adjuster changes parts, not the design position: the joints then hold another
!> position of the bodies, which the solution finds. A rod that is a distance joint becomes longer, a spring on a moved seat has
!> another deflection; all others move points of one body against that body, along a line, or along an arc about a pivot.
!>
!> An arc: a shim of thickness t at the point m, with normal n, turns the points about the pivot p until
!> n·(m' − p) = n·(m − p) + t. With d = m − p and the axis a = d×n/|d×n|, the angle φ is
!>
!>     φ = atan2(|d×n|, n·d) − acos((n·d + t)/|d|)
module ek_adjuster
   use ek_kinds, only: wp
   use ek_rotation, only: cross
   implicit none(type, external)
   private
   public :: adjuster_t, adjuster_numbers_t, place_t, align_t, moved_point, turned_direction, is_reachable
   public :: rod_of_joint, of_points, seat

   ! kinds
   integer, parameter :: rod_of_joint = 1     !! the length of a distance joint
   integer, parameter :: of_points = 2        !! points of a body: a rod that is a body, a shim, a slot
   integer, parameter :: seat = 3             !! the seat of a spring

   !> The numbers of an adjuster. Points and directions are those of the design position.
   type :: adjuster_numbers_t
      real(wp) :: value = 0.0_wp              !! change of length, thickness or displacement [m]; 0: as drawn
      real(wp) :: along(3) = 0.0_wp           !! unit vector along which the points move; of a shim, its normal
      real(wp) :: bolt(3) = 0.0_wp            !! point of the shim [m]
      real(wp) :: pivot(3) = 0.0_wp           !! point about which the points turn [m]
   end type adjuster_numbers_t

   !> An adjuster: its numbers, its range, and the parts that it moves.
   type, extends(adjuster_numbers_t) :: adjuster_t
      character(:), allocatable :: name, where
      integer :: kind = of_points
      integer :: row = 0                      !! row of Φ of the distance joint
      integer :: element = 0                  !! index of the spring
      integer :: body = 0                     !! body whose points move; 0: the chassis
      logical :: has_pivot = .false.
      real(wp) :: low = 0.0_wp, high = 0.0_wp !! range of the value [m]
   end type adjuster_t

   !> A marker that an adjuster moves.
   type :: place_t
      integer :: adjuster = 0
      integer :: marker = 0                   !! index of the marker of the suspension
      real(wp) :: share = 1.0_wp              !! share of the value; a rod with two threads moves both ends by a half
   end type place_t

   !> Static angles that a wheel must have, and the adjusters that give them.
   type :: align_t
      character(:), allocatable :: where
      integer :: wheel = 0
      logical :: has_toe = .false., has_camber = .false.
      integer :: angles = 0                   !! number of angles, and of adjusters
      integer :: adjusters(2) = 0             !! indices
      real(wp) :: toe = 0.0_wp, camber = 0.0_wp      !! rad
   end type align_t

contains

   !> A point of the design position, moved by an adjuster.
   pure function moved_point(self, point, share) result(moved)
      type(adjuster_t), intent(in) :: self
      real(wp), intent(in) :: point(3), share
      real(wp) :: moved(3)

      if (self%has_pivot) then
         moved = self%pivot + turned_direction(self, point - self%pivot)
      else
         moved = point + share*self%value*self%along
      end if
   end function moved_point

   !> A direction that turns with the points of an adjuster; unchanged without a pivot.
   pure function turned_direction(self, direction) result(turned)
      type(adjuster_t), intent(in) :: self
      real(wp), intent(in) :: direction(3)
      real(wp) :: turned(3), axis(3), arm(3), angle, size_of_cross

      turned = direction
      if (.not. self%has_pivot) return
      arm = self%bolt - self%pivot
      axis = cross(arm, self%along)
      size_of_cross = norm2(axis)
      axis = axis/size_of_cross
      angle = atan2(size_of_cross, dot_product(self%along, arm)) - &
         acos((dot_product(self%along, arm) + self%value)/norm2(arm))
      turned = cos(angle)*direction + sin(angle)*cross(axis, direction) + (1.0_wp - cos(angle))*dot_product(axis, direction)*axis
   end function turned_direction

   !> Whether an adjuster has a position at its value: a shim cannot be thicker than the arm to its pivot allows.
   pure logical function is_reachable(self)
      type(adjuster_t), intent(in) :: self
      real(wp) :: arm(3)

      is_reachable = .true.
      if (.not. self%has_pivot) return
      arm = self%bolt - self%pivot
      is_reachable = norm2(cross(arm, self%along)) > 1.0e-3_wp*norm2(arm) .and. &
         abs(dot_product(self%along, arm) + self%value) < norm2(arm)
   end function is_reachable

end module ek_adjuster
