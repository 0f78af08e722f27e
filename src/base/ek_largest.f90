!> The largest numbers of a list.
module ek_largest
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: largest

contains

   !> Finds the indices of the numbers with the largest magnitudes, the largest first; zeros are omitted.
   pure subroutine largest(values, most, places)
      real(wp), intent(in) :: values(:)
      integer, intent(in) :: most                      !! largest number of results
      integer, allocatable, intent(out) :: places(:)
      logical :: is_left(size(values))
      integer :: k, n

      is_left = abs(values) > 0.0_wp
      n = min(most, count(is_left))
      allocate (places(n))
      do k = 1, n
         places(k) = maxloc(abs(values), dim=1, mask=is_left)
         is_left(places(k)) = .false.
      end do
   end subroutine largest

end module ek_largest
