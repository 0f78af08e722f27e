!> Hardpoints as data, and the rules that hold for them in any file: a name is legal and unique, and a symmetry is known.
module ek_hardpoint
   use ek_kinds, only: wp
   use ek_text, only: str, lower
   use ek_flaws, only: flaws_t, shown
   use ek_fields, only: legal_name
   implicit none(type, external)
   private
   public :: hardpoint_t, hardpoints_t, single_point, left_point, right_point, point_pair, add_hardpoint, take_symmetry

   integer, parameter :: single_point = 0, left_point = 1, right_point = 2, point_pair = 3
   integer, parameter :: most_points = 5000

   type :: hardpoint_t
      character(63) :: name = ''            !! name that is legal in a deck
      real(wp) :: at(3) = 0.0_wp            !! position [m], in the frame of the file
      integer :: symmetry = single_point
      integer :: line = 0
   end type hardpoint_t

   type :: hardpoints_t
      integer :: used = 0
      type(hardpoint_t), allocatable :: points(:)
      logical :: is_adams = .false.         !! the file uses the frame of Adams/Car: x rearward, y right
   end type hardpoints_t

contains

   !> Adds a point. Two points with the same name must be a left and a right point; otherwise, the second is reported and not added.
   subroutine add_hardpoint(sheet, name, at, symmetry, line, flaws)
      type(hardpoints_t), intent(inout) :: sheet
      character(*), intent(in) :: name
      real(wp), intent(in) :: at(3)
      integer, intent(in) :: symmetry, line
      type(flaws_t), intent(inout) :: flaws
      type(hardpoint_t) :: point
      integer :: k

      if (len_trim(name) == 0) then
         call flaws%add(line, 'expected the name of a hardpoint, found nothing')
         return
      end if
      point%name = legal_name(name)
      point%at = at
      point%symmetry = symmetry
      point%line = line
      do k = 1, sheet%used
         if (lower(sheet%points(k)%name) /= lower(point%name)) cycle
         if (all([sheet%points(k)%symmetry, symmetry] /= single_point) .and. &
            sheet%points(k)%symmetry + symmetry == left_point + right_point .and. symmetry /= point_pair) cycle
         call flaws%add(line, 'expected each hardpoint once, found '//shown(name)//' again (first in line '// &
            str(sheet%points(k)%line)//')')
         return
      end do
      if (sheet%used == most_points) then
         call flaws%add(line, 'expected at most '//str(most_points)//' hardpoints, found more')
         return
      end if
      if (sheet%used == size(sheet%points)) sheet%points = [sheet%points, sheet%points]      ! twice the size
      sheet%used = sheet%used + 1
      sheet%points(sheet%used) = point
   end subroutine add_hardpoint

   !> The symmetry that a string names; -1 if the string is not the name of a symmetry.
   pure integer function symmetry_of(text)
      character(*), intent(in) :: text

      select case (lower(trim(adjustl(text))))
      case ('', 'single', 'none', 'no', 'center', 'centre')
         symmetry_of = single_point
      case ('left', 'l')
         symmetry_of = left_point
      case ('right', 'r')
         symmetry_of = right_point
      case ('left/right', 'both', 'symmetric', 'pair', 'yes')
         symmetry_of = point_pair
      case default
         symmetry_of = -1
      end select
   end function symmetry_of

   !> Reads a symmetry. A string that is not the name of a symmetry is reported, and `symmetry` is then −1.
   subroutine take_symmetry(text, line, symmetry, flaws)
      character(*), intent(in) :: text
      integer, intent(in) :: line
      integer, intent(out) :: symmetry
      type(flaws_t), intent(inout) :: flaws

      symmetry = symmetry_of(text)
      if (symmetry < 0) call flaws%add(line, 'expected the symmetry left, right, single or left/right, found '//shown(text))
   end subroutine take_symmetry

end module ek_hardpoint
