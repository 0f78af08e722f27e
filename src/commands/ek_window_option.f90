!> The option --window: half widths of the gradient windows.
module ek_window_option
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_usage
   use ek_text, only: quoted
   use ek_gradient_window, only: windows_t, set_window
   use ek_arguments, only: arguments_t
   implicit none(type, external)
   private
   public :: chosen_windows

contains

   !> The gradient windows with --window applied.
   subroutine chosen_windows(arguments, windows, error)
      type(arguments_t), intent(in) :: arguments
      type(windows_t), intent(out) :: windows
      type(error_t), allocatable, intent(out) :: error     !! exit_usage: unknown window, or no positive number
      real(wp) :: half
      integer :: k, equals, status
      logical :: is_known

      do k = 1, size(arguments%windows)
         associate (text => arguments%windows(k)%text)
            equals = index(text, '=')
            status = 1
            half = 0.0_wp
            if (equals > 1 .and. verify(text(equals + 1:), '0123456789.') == 0 .and. equals < len(text)) &
               read (text(equals + 1:), *, iostat=status) half
            if (status /= 0 .or. .not. half > 0.0_wp) then
               call fail(error, exit_usage, '--window: expected window=half width with a positive number, as in travel=15, '// &
                  'found '//quoted(text))
               return
            end if
            call set_window(windows, text(:equals - 1), half, is_known)
            if (.not. is_known) then
               call fail(error, exit_usage, '--window: expected travel, roll, force, torque, rack or wheel, found '// &
                  quoted(text(:equals - 1)))
               return
            end if
         end associate
      end do
   end subroutine chosen_windows

end module ek_window_option
