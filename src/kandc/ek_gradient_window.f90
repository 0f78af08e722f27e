!> The windows of gradients: the range around design for the fit, by the abscissa of the test.
module ek_gradient_window
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: windows_t, set_window, window_of

   !> Half widths of the windows, each centred on 0.
   type :: windows_t
      real(wp) :: travel = 15.0_wp      !! mm
      real(wp) :: roll = 1.0_wp         !! deg
      real(wp) :: force = 1000.0_wp     !! N
      real(wp) :: torque = 100.0_wp     !! N m
      real(wp) :: rack = 10.0_wp        !! mm of steering input
      real(wp) :: wheel = 20.0_wp       !! deg of steering wheel
   end type windows_t

contains

   !> Sets the half width of one window by its name: travel, roll, force, torque, rack, wheel.
   pure subroutine set_window(windows, word, half, is_known)
      type(windows_t), intent(inout) :: windows
      character(*), intent(in) :: word
      real(wp), intent(in) :: half         !! mm, deg, N or N m; positive
      logical, intent(out) :: is_known

      is_known = .true.
      select case (word)
      case ('travel')
         windows%travel = half
      case ('roll')
         windows%roll = half
      case ('force')
         windows%force = half
      case ('torque')
         windows%torque = half
      case ('rack')
         windows%rack = half
      case ('wheel')
         windows%wheel = half
      case default
         is_known = .false.
      end select
   end subroutine set_window

   !> The window of a gradient; over `factor` it is that of the quantity scaled by the test.
   pure subroutine window_of(kind, over, windows, half, unit)
      character(*), intent(in) :: kind, over    !! kind of the test; column, without the wheel's name
      type(windows_t), intent(in) :: windows
      real(wp), intent(out) :: half             !! half width, in `unit`
      character(*), intent(out) :: unit         !! mm, deg, N or N m; 3 letters

      select case (over)
      case ('wheel_travel_mm')
         half = windows%travel
         unit = 'mm'
      case ('axle_roll_deg')
         half = windows%roll
         unit = 'deg'
      case ('steering_wheel_deg')
         half = windows%wheel
         unit = 'deg'
      case default
         half = windows%force
         unit = 'N'
         if (kind == 'aligning_torque') then
            half = windows%torque
            unit = 'N m'
         else if (kind == 'steering') then
            half = windows%rack
            unit = 'mm'
         end if
      end select
   end subroutine window_of

end module ek_gradient_window
