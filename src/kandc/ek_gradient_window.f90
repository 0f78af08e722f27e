!> The windows of gradients: the range around design for the fit, by the abscissa of the test.
module ek_gradient_window
   use ek_kinds, only: wp
   use ek_rig_test, only: rig_test_t, rig_test, steers
   implicit none(type, external)
   private
   public :: windows_t, set_window, window_of

   integer, parameter :: travel = 1, roll = 2, force = 3, torque = 4, rack = 5, wheel = 6
   character(*), parameter :: names(6) = [character(6) :: 'travel', 'roll', 'force', 'torque', 'rack', 'wheel']
   character(*), parameter :: units(6) = [character(3) :: 'mm', 'deg', 'N', 'N m', 'mm', 'deg']

   !> Half widths of the windows in these units, each centred on 0; rack: of steering input, wheel: of the steering wheel.
   type :: windows_t
      real(wp) :: half(6) = [15.0_wp, 1.0_wp, 1000.0_wp, 100.0_wp, 10.0_wp, 20.0_wp]
   end type windows_t

contains

   !> Sets the half width of one window by its name.
   pure subroutine set_window(windows, word, half, is_known)
      type(windows_t), intent(inout) :: windows
      character(*), intent(in) :: word
      real(wp), intent(in) :: half         !! mm, deg, N or N m; positive
      logical, intent(out) :: is_known

      is_known = any(names == word)
      where (names == word) windows%half = half
   end subroutine set_window

   !> The window of a gradient; over `factor` it is that of the quantity scaled by the test.
   pure subroutine window_of(kind, over, windows, half, unit)
      character(*), intent(in) :: kind, over    !! kind of the test; column, without the wheel's name
      type(windows_t), intent(in) :: windows
      real(wp), intent(out) :: half             !! half width, in `unit`
      character(*), intent(out) :: unit         !! mm, deg, N or N m; 3 letters
      type(rig_test_t) :: test
      integer :: which

      test = rig_test(kind)
      which = force
      if (test%unit == 'N m') which = torque
      if (test%action == steers) which = rack
      if (over == 'wheel_travel_mm') which = travel
      if (over == 'axle_roll_deg') which = roll
      if (over == 'steering_wheel_deg') which = wheel
      half = windows%half(which)
      unit = units(which)
   end subroutine window_of

end module ek_gradient_window
