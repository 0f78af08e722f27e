!> The two sides of an axle: the left and the right wheel, and the names of their columns.
module ek_wheel_side
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   implicit none(type, external)
   private
   public :: side_name, left_and_right, is_axle, single_side, prefix_of, design_track, deck_frame, share_on_wheel, share_of_mass

contains

   !> The name of a side: 'left' or 'right'.
   pure function side_name(side) result(name)
      integer, intent(in) :: side      !! 1 left, 2 right
      character(5) :: name
      name = merge('left ', 'right', side == 1)
   end function side_name

   !> Finds the indices of the left and the right wheel; 0 for a wheel that the model does not have.
   pure subroutine left_and_right(suspension, wheels)
      type(suspension_t), intent(in) :: suspension
      integer, intent(out) :: wheels(2)
      integer :: k

      wheels = 0
      do k = size(suspension%wheels), 1, -1
         wheels(merge(1, 2, suspension%wheels(k)%side < 0)) = k
      end do
   end subroutine left_and_right

   !> The track of an axle: lateral distance of the contact points at design [m]. All roll angles, roll moments and
   !> Ackermann angles use this track, on the rig and in the columns.
   pure real(wp) function design_track(suspension) result(track)
      type(suspension_t), intent(in) :: suspension      !! an axle
      real(wp) :: y(2)
      integer :: wheels(2), k

      call left_and_right(suspension, wheels)
      do k = 1, 2
         associate (wheel => suspension%wheels(wheels(k)))
            y(k) = suspension%bodies(wheel%body)%origin(2) + wheel%contact(2)
         end associate
      end do
      track = abs(y(2) - y(1))
   end function design_track

   !> Share of a load at a point of a body that counts for a wheel [-]: 1, 0, or ½ at equal distance from both wheels of a body.
   pure real(wp) function share_on_wheel(suspension, wheel, body, arm) result(share)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: wheel, body
      real(wp), intent(in) :: arm(3)      !! point from the reference point of the body, body axes [m]
      real(wp), parameter :: middle = 1.0e-9_wp      ! m: tolerance of equal distance
      real(wp) :: nearer
      integer :: other

      share = merge(1.0_wp, 0.0_wp, body == suspension%wheels(wheel)%body)
      do other = 1, size(suspension%wheels)
         if (other == wheel .or. suspension%wheels(other)%body /= body .or. .not. share > 0.0_wp) cycle
         nearer = abs(arm(2) - suspension%wheels(other)%contact(2)) - abs(arm(2) - suspension%wheels(wheel)%contact(2))
         if (abs(nearer) <= middle) then
            share = 0.5_wp
         else if (nearer < 0.0_wp) then
            share = 0.0_wp
         end if
      end do
   end function share_on_wheel

   !> Share of the mass of a body that moves with the wheels of a side [-]: 1 if its centre of gravity is on this side of the car,
   !> otherwise 0; ½ in the middle of the car, and for a body with both wheels.
   pure real(wp) function share_of_mass(suspension, body, side) result(share)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: body
      integer, intent(in) :: side             !! 1 left, 2 right
      real(wp), parameter :: middle = 1.0e-9_wp      ! m: tolerance of the middle of the car
      real(wp) :: outboard

      outboard = suspension%bodies(body)%origin(2) + suspension%bodies(body)%centre(2)
      if (side == 1) outboard = -outboard
      share = merge(1.0_wp, 0.0_wp, outboard > 0.0_wp)
      if (abs(outboard) <= middle .or. count(suspension%wheels%body == body) > 1) share = 0.5_wp
   end function share_of_mass

   !> Signs of x, y, z from the frame of the program to the frame of the deck.
   pure function deck_frame(suspension) result(frame)
      type(suspension_t), intent(in) :: suspension
      real(wp) :: frame(3)
      frame = 1.0_wp
      if (suspension%is_iso) frame(1:2) = -1.0_wp
   end function deck_frame

   !> Whether a model is an axle: two wheels, one on either side.
   pure logical function is_axle(suspension)
      type(suspension_t), intent(in) :: suspension
      is_axle = .false.
      if (size(suspension%wheels) == 2) is_axle = suspension%wheels(1)%side /= suspension%wheels(2)%side
   end function is_axle

   !> Side of the only wheel: −1 left, +1 right; 0 if the model has no wheel or several wheels.
   pure integer function single_side(suspension) result(side)
      type(suspension_t), intent(in) :: suspension
      side = 0
      if (size(suspension%wheels) == 1) side = suspension%wheels(1)%side
   end function single_side

   !> Prefix of the column names of a wheel: 'left_' or 'right_' on an axle, '' for a single wheel; otherwise the name of the wheel
   !> and '_'.
   pure function prefix_of(suspension, wheel) result(prefix)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: wheel
      character(:), allocatable :: prefix

      prefix = ''
      if (size(suspension%wheels) < 2) return
      if (is_axle(suspension)) then
         prefix = trim(side_name(merge(1, 2, suspension%wheels(wheel)%side < 0)))//'_'
      else
         prefix = suspension%wheels(wheel)%name//'_'
      end if
   end function prefix_of

end module ek_wheel_side
