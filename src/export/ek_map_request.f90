!> The request for a map: its grid, its second argument, the support of the wheels, and the elements that give its lengths.
module ek_map_request
   use ek_kinds, only: wp
   use ek_wheel_motion, only: lengths, length_choice_t
   implicit none(type, external)
   private
   public :: map_request_t, grid_values, over_none, over_steer, over_opposite

   ! what the second argument of a map is
   integer, parameter :: over_none = 0, over_steer = 1, over_opposite = 2

   !> The definition of the map to be computed.
   type :: map_request_t
      real(wp), allocatable :: travel(:)      !! wheel travels from design, increasing, including 0 [m]
      real(wp), allocatable :: second(:)      !! steer (positive to the left), increasing, including 0 [m]; only over_steer
      integer :: kind = over_none
      character(:), allocatable :: driver     !! joint that steers
      character(:), allocatable :: vertical   !! point whose height is the travel: wheel 'centre', 'patch' or 'road'
      character(:), allocatable :: held       !! how the wheels are held in the compliance: 'road', 'centre' or 'force'
      type(length_choice_t) :: choices(lengths, 2)
   end type map_request_t

contains

   !> A list of values from `from` to `to` that contains 0. On each side of 0 the values are equally spaced.
   pure function grid_values(from, to, count) result(values)
      real(wp), intent(in) :: from, to        !! from ≤ 0 ≤ to
      integer, intent(in) :: count            !! at least 2
      real(wp), allocatable :: values(:)
      integer :: before, k

      before = nint((count - 1)*abs(from)/(to - from))
      if (from < 0.0_wp) before = max(before, 1)
      if (to > 0.0_wp) before = min(before, count - 2)
      allocate (values(count), source=0.0_wp)
      do k = 1, before
         values(k) = from*(real(before + 1 - k, wp)/before)
      end do
      do k = before + 2, count
         values(k) = to*(real(k - before - 1, wp)/(count - 1 - before))
      end do
   end function grid_values

end module ek_map_request
