!> Data for the quantities of an axle besides its compliance: vehicle, steering, tyres.
module ek_vehicle
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t, axle_t, driver_row
   implicit none(type, external)
   private
   public :: vehicle_t, vehicle_of

   type :: vehicle_t
      type(axle_t) :: axle                     !! wheelbase, centre of gravity, shares of brake and drive
      integer :: steer_row = 0                 !! row of Φ of the steering driver, 0: none
      real(wp) :: steer_ratio = 0.0_wp         !! rack travel per revolution of the steering wheel [m], never negative
      real(wp), allocatable :: tyre_rate(:)    !! vertical, of each wheel of the suspension [N/m]; 0: not given
   end type vehicle_t

contains

   !> The vehicle data of the deck.
   pure type(vehicle_t) function vehicle_of(suspension) result(vehicle)
      type(suspension_t), intent(in) :: suspension

      vehicle%axle = suspension%axle
      if (suspension%steering%has_steering) then
         vehicle%steer_row = driver_row(suspension, suspension%steering%driver)
         vehicle%steer_ratio = abs(suspension%steering%ratio)
      end if
      allocate (vehicle%tyre_rate(size(suspension%wheels)))
      vehicle%tyre_rate = suspension%wheels%tyre_rate
   end function vehicle_of

end module ek_vehicle
