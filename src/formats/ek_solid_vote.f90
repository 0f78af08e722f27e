!> Votes of a solid axle on the frame of its table (ek_frame_votes): what holds for every axle tube that rods, a Panhard rod or
!> springs guide.
module ek_solid_vote
   use ek_kinds, only: wp
   use ek_vote, only: ballot_t, add_vote, of_up, of_outboard
   use ek_point_name, only: wheel_centre, spring_top, spring_low, damper_top, damper_low, kingpin_low, kingpin_top, &
      upper_rod_chassis, upper_rod_axle, lower_rod_chassis, lower_rod_axle, panhard_chassis, panhard_axle, triangle_chassis, &
      triangle_axle, axle_guide, axle_pivot
   use ek_point_vote, only: half_t, vote_along, vote_vector, vote_column, vote_sign
   implicit none(type, external)
   private
   public :: vote_on_solid_up, vote_on_solid_outboard, vote_on_solid_forward

contains

   !> Whether the points are those of a solid axle.
   pure logical function has_tube(half)
      type(half_t), intent(in) :: half
      has_tube = any(half%has([upper_rod_axle, lower_rod_axle, panhard_axle, triangle_axle, axle_guide, axle_pivot]))
   end function has_tube

   !> Adds the votes on the upward direction.
   subroutine vote_on_solid_up(half, ballot)
      type(half_t), intent(in) :: half
      type(ballot_t), intent(inout) :: ballot

      call vote_along(ballot, of_up, half, kingpin_low, kingpin_top, 'upper end of the kingpin above the lower one')
      if (.not. has_tube(half)) return
      call vote_along(ballot, of_up, half, spring_low, spring_top, 'spring top above its seat on the axle')
      call vote_along(ballot, of_up, half, damper_low, damper_top, 'damper top above its end on the axle')
   end subroutine vote_on_solid_up

   !> Adds the votes on the outboard direction: the wheel is outboard of everything on the axle tube.
   subroutine vote_on_solid_outboard(half, ballot)
      type(half_t), intent(in) :: half
      type(ballot_t), intent(inout) :: ballot
      real(wp) :: rod(3)
      integer :: column

      if (.not. has_tube(half)) return
      call vote_along(ballot, of_outboard, half, lower_rod_axle, wheel_centre, &
         'wheel centre outboard of the lower rod, at the axle')
      call vote_along(ballot, of_outboard, half, upper_rod_axle, wheel_centre, &
         'wheel centre outboard of the upper rod, at the axle')
      call vote_along(ballot, of_outboard, half, spring_low, wheel_centre, 'wheel centre outboard of the spring seat on the axle')
      if (all(half%has([kingpin_low, kingpin_top, wheel_centre]))) call vote_vector(ballot, of_outboard, &
         2*half%at(:, wheel_centre) - half%at(:, kingpin_low) - half%at(:, kingpin_top), 'wheel centre outboard of the kingpin')
      if (.not. all(half%has([panhard_chassis, panhard_axle, wheel_centre]))) return
      rod = half%at(:, panhard_axle) - half%at(:, panhard_chassis)
      column = maxloc(abs(rod), dim=1)
      call vote_vector(ballot, of_outboard, sign(1.0_wp, rod(column))*sign(1.0_wp, half%at(column, wheel_centre))*rod, &
         'Panhard rod across the car, towards the side of the wheel')
   end subroutine vote_on_solid_outboard

   !> Adds the votes on the forward direction. Rods that are named by their ends give it; the rods of a rear axle are ahead of the
   !> tube, whereas those of a front axle may be ahead or behind.
   subroutine vote_on_solid_forward(half, column, axle, has_front_ends, ballot)
      type(half_t), intent(in) :: half
      integer, intent(in) :: column, axle              !! axle: 1 front, 2 rear, 0 not known
      logical, intent(in) :: has_front_ends
      type(ballot_t), intent(inout) :: ballot
      integer, parameter :: chassis(3) = [lower_rod_chassis, upper_rod_chassis, triangle_chassis], &
         tube(3) = [lower_rod_axle, upper_rod_axle, triangle_axle]
      real(wp) :: ahead
      integer :: k

      if (has_front_ends) then
         call vote_column(ballot, column, half, lower_rod_axle, lower_rod_chassis, &
            'front end of the lower link ahead of the rear end')
         call vote_column(ballot, column, half, upper_rod_axle, upper_rod_chassis, &
            'front end of the upper link ahead of the rear end')
      else if (axle == 2) then
         ahead = 0.0_wp
         do k = 1, size(chassis)
            if (half%has(chassis(k)) .and. half%has(tube(k))) ahead = ahead + half%at(column, chassis(k)) - half%at(column, tube(k))
         end do
         call vote_sign(ballot, column, ahead, 'rods of a rear axle ahead of the tube')
      end if
   end subroutine vote_on_solid_forward

end module ek_solid_vote
