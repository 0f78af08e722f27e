!> The gradients of each test, from the rows of ek_quantity, and their windows around design, by the abscissa.
!>
!> ek_gradient computes the value of a gradient, and slope_unit of ek_unit_suffix gives its unit.
module ek_gradient_definition
   use ek_kinds, only: wp
   use ek_quantity, only: definition_t => gradient_row_t, gradient_rows
   use ek_rig_test, only: rig_test_t, rig_test, steers, of_travel, of_tilt
   implicit none(type, external)
   private
   public :: definition_t, definitions_of, fitted, windows_t, set_window, window_of

   !> Suffix of the name of every gradient: a least-squares slope over a window differs from the slope at a state, which a column of
   !> the compliance matrix gives.
   character(*), parameter :: fitted = ' (fitted)'

   integer, parameter :: travel = 1, roll = 2, force = 3, torque = 4, rack = 5, wheel = 6
   character(*), parameter :: names(6) = [character(6) :: 'travel', 'roll', 'force', 'torque', 'rack', 'wheel']
   character(*), parameter :: units(6) = [character(3) :: 'mm', 'deg', 'N', 'N m', 'mm', 'deg']

   !> Half widths of the windows, in the units of `units`; each window is centred on 0. `rack` is the window of the steering input,
   !> `wheel` of the steering-wheel angle.
   type :: windows_t
      real(wp) :: half(6) = [15.0_wp, 1.0_wp, 1000.0_wp, 100.0_wp, 10.0_wp, 20.0_wp]
      logical :: is_given(6) = .false.       !! a user gives the window; otherwise it ends where the range of a test ends
   end type windows_t

contains

   !> The gradients of a test; empty for a test without gradients.
   pure function definitions_of(kind) result(list)
      character(*), intent(in) :: kind
      type(definition_t), allocatable :: list(:)
      type(rig_test_t) :: test
      integer :: k

      test = rig_test(kind)
      list = pack(gradient_rows, gradient_rows%set == merge(of_travel, test%charts, test%charts == of_tilt))
      do k = 1, size(list)
         list(k)%quantity = test%prefix(:len_trim(test%prefix) + merge(1, 0, test%prefix /= ''))//trim(list(k)%quantity)//fitted
         if (list(k)%over == '') list(k)%over = merge('factor            ', test%abscissa, test%action == steers)
      end do
   end function definitions_of

   !> Sets the half width of the window with a given name.
   pure subroutine set_window(windows, word, half, is_known)
      type(windows_t), intent(inout) :: windows
      character(*), intent(in) :: word
      real(wp), intent(in) :: half         !! mm, deg, N or N m; positive
      logical, intent(out) :: is_known

      is_known = any(names == word)
      where (names == word) windows%half = half
      where (names == word) windows%is_given = .true.
   end subroutine set_window

   !> Finds the window of a gradient. Over `factor`, this is the window of the quantity that the test scales: force, torque or rack.
   pure subroutine window_of(kind, over, windows, half, unit, is_given)
      character(*), intent(in) :: kind, over    !! kind of the test; column, without the wheel's name
      type(windows_t), intent(in) :: windows
      real(wp), intent(out) :: half             !! half width, in `unit`
      character(*), intent(out) :: unit         !! mm, deg, N or N m; 3 letters
      logical, intent(out), optional :: is_given        !! a user gives the window
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
      if (present(is_given)) is_given = windows%is_given(which)
   end subroutine window_of

end module ek_gradient_definition
