!> Parts that are made with deviations (&part): a point deviates in one body or rod, and in no other part.
!>
!> What a body carries at the point is that of the body in an axle whose point is moved: the arms of its joints, springs, bushings
!> and loads, and the directions fixed in it that two points give. So if all parts at a point deviate alike, the axle is that with
!> the moved point. A rod (distance joint) has the length of the axle with the moved point. Springs, gaps of bushings, and the
!> targets of all other rows keep the design values of the drawn axle.
!>
!> ek_adjust puts these numbers in place of the drawn ones, after the preload trim.
module ek_made_parts
   use ek_kinds, only: wp
   use ek_elastic, only: set_bushing_axes
   use ek_suspension, only: suspension_t
   use ek_markers, only: find_point, find_direction
   implicit none(type, external)
   private
   public :: begin_made, make_part, put_made

contains

   !> Copies the markers of all parts as drawn.
   pure subroutine begin_made(self)
      type(suspension_t), intent(inout), target :: self
      real(wp), pointer, contiguous :: at(:), direction(:)
      integer :: k

      associate (made => self%made, n => size(self%markers))
         if (.not. allocated(made%at)) &
            allocate (made%at(3, n), made%directions(3, n), made%longer(size(self%rows)), source=0.0_wp)
         made%longer(:) = 0.0_wp
         do k = 1, n
            call find_point(self, self%markers(k), at)
            call find_direction(self, self%markers(k), direction)
            if (associated(at)) made%at(:, k) = at
            if (associated(direction)) made%directions(:, k) = direction
         end do
      end associate
   end subroutine begin_made

   !> Makes one part: a rod if `row` is not 0, otherwise a body. `moved` is the axle whose points are moved as those of the part.
   pure subroutine make_part(moved, body, row, self)
      type(suspension_t), intent(inout), target :: moved   !! only read
      integer, intent(in) :: body              !! 0: the chassis
      integer, intent(in) :: row
      type(suspension_t), intent(inout) :: self
      real(wp), pointer, contiguous :: at(:), direction(:)
      real(wp) :: shift(3)                     ! from the reference point of the drawn body to that of the moved one
      integer :: k

      if (row > 0) then
         self%made%longer(row) = moved%rows(row)%target - self%rows(row)%target
         return
      end if
      shift = 0.0_wp
      if (body > 0) shift = moved%bodies(body)%origin - self%bodies(body)%origin
      do k = 1, size(self%markers)
         if (self%markers(k)%body /= body) cycle
         call find_point(moved, self%markers(k), at)
         call find_direction(moved, self%markers(k), direction)
         if (associated(at) .and. .not. self%markers(k)%only_turns) self%made%at(:, k) = at + shift
         if (associated(direction)) self%made%directions(:, k) = direction
      end do
   end subroutine make_part

   !> Puts the markers of the parts as made in place of the drawn ones.
   pure subroutine put_made(self)
      type(suspension_t), intent(inout), target :: self
      real(wp), pointer, contiguous :: at(:), direction(:)
      integer :: k

      do k = 1, size(self%markers)
         call find_point(self, self%markers(k), at)
         call find_direction(self, self%markers(k), direction)
         if (associated(at)) at = self%made%at(:, k)
         if (associated(direction)) direction = self%made%directions(:, k)
      end do
      do k = self%scalars + 1, size(self%elements)
         call set_bushing_axes(self%elements(k)%bushing)
      end do
      self%rows(:)%target = self%rows%target + self%made%longer
   end subroutine put_made

end module ek_made_parts
