!> Sets the adjusters of a suspension (ek_adjuster): moves the markers that they carry. The parts are those as made
!> (ek_made_parts).
!>
!> The design position, the design values of springs and measures and the preloads stay those of the drawn axle. The rows of Φ are
!> therefore not satisfied at design if an adjuster has a value; the solution finds the position that satisfies them.
module ek_adjust
   use ek_kinds, only: wp
   use ek_adjuster, only: adjuster_t, moved_point, turned_direction, rod_of_joint, seat
   use ek_made_parts, only: put_made
   use ek_suspension, only: suspension_t, marker_t
   use ek_markers, only: find_point, find_direction
   use ek_wheel_contact, only: put_at_contact
   implicit none(type, external)
   private
   public :: adjust, is_adjusted

contains

   !> Whether an adjuster has a value, or a part a deviation: the bodies then leave the design position.
   pure logical function is_adjusted(suspension)
      type(suspension_t), intent(in) :: suspension
      is_adjusted = suspension%made%has_deviations .or. any(abs(suspension%adjusters%value) > 0.0_wp)
   end function is_adjusted

   !> Makes all parts as they are, and sets all adjusters of a suspension, unless this is done already.
   pure subroutine adjust(suspension)
      type(suspension_t), intent(inout) :: suspension
      integer :: k, w

      if (suspension%has_set_adjusters) return
      suspension%has_set_adjusters = .true.
      if (suspension%made%has_deviations) call put_made(suspension)
      do k = 1, size(suspension%adjusters)
         associate (this => suspension%adjusters(k))
            if (this%kind == rod_of_joint) then
               suspension%rows(this%row)%target = suspension%rows(this%row)%target + this%value
            else if (this%kind == seat) then
               associate (law => suspension%elements(this%element)%law)
                  law%reference = law%reference + this%value
               end associate
            end if
         end associate
      end do
      do k = 1, size(suspension%places)
         associate (place => suspension%places(k))
            if (abs(suspension%adjusters(place%adjuster)%value) > 0.0_wp) &
               call move(suspension%adjusters(place%adjuster), suspension%markers(place%marker), place%share, suspension)
         end associate
      end do
      do k = 1, size(suspension%loads)
         w = max(suspension%loads(k)%wheel, suspension%loads(k)%start_of)
         if (w > 0) call put_at_contact(suspension%wheels, w, suspension%loads(k))
      end do
   end subroutine adjust

   !> Moves the point of a marker, and turns its direction.
   pure subroutine move(adjuster, marker, share, suspension)
      type(adjuster_t), intent(in) :: adjuster
      type(marker_t), intent(in) :: marker                  !! on the body of the adjuster
      real(wp), intent(in) :: share
      type(suspension_t), intent(inout), target :: suspension
      real(wp), pointer, contiguous :: at(:), direction(:)
      real(wp) :: origin(3)

      origin = 0.0_wp
      if (marker%body > 0) origin = suspension%bodies(marker%body)%origin
      call find_point(suspension, marker, at)
      call find_direction(suspension, marker, direction)
      if (associated(at)) at = moved_point(adjuster, origin + at, share) - origin
      if (associated(direction)) direction = turned_direction(adjuster, direction)
   end subroutine move

end module ek_adjust
