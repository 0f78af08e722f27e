!> What the quantities of an axle need beyond the suspension itself: the vehicle around it.
module ek_vehicle
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t, driver_row
   implicit none(type, external)
   private
   public :: vehicle_t, vehicle_of

   type :: vehicle_t
      logical :: has_axle = .false.            !! wheelbase and so on are given
      logical :: is_front = .true.             !! which axle this is
      real(wp) :: wheelbase = 0.0_wp           !! m
      real(wp) :: cg_height = 0.0_wp           !! centre of gravity above the ground [m]
      real(wp) :: brake_share = 0.0_wp         !! share of the whole brake force on the FRONT axle [-]
      real(wp) :: drive_share = 1.0_wp         !! share of the whole drive force on THIS axle [-]
      logical :: drives_at_patch = .false.     !! drive force meets the suspension at the patch (solid axle), not at the centre
      integer :: steer_row = 0                 !! row of Φ of the steering driver, 0: none
      real(wp) :: steer_ratio = 0.0_wp         !! rack travel a revolution of the steering wheel [m]
      real(wp), allocatable :: tyre_rate(:)    !! vertical, of each wheel of the suspension [N/m]; 0: not given
   end type vehicle_t

contains

   !> What the deck says of the vehicle.
   pure type(vehicle_t) function vehicle_of(suspension) result(vehicle)
      type(suspension_t), intent(in) :: suspension

      associate (axle => suspension%axle, steering => suspension%steering)
         vehicle%has_axle = axle%has_axle
         vehicle%is_front = axle%is_front
         vehicle%wheelbase = axle%wheelbase
         vehicle%cg_height = axle%cg_height
         vehicle%brake_share = axle%brake_share
         vehicle%drive_share = axle%drive_share
         vehicle%drives_at_patch = axle%drives_at_patch
         if (steering%has_steering) then
            vehicle%steer_row = driver_row(suspension, steering%driver)
            vehicle%steer_ratio = abs(steering%ratio)
         end if
      end associate
      allocate (vehicle%tyre_rate(size(suspension%wheels)))
      vehicle%tyre_rate = suspension%wheels%tyre_rate
   end function vehicle_of

end module ek_vehicle
