!> A deck opened for a program that calls elastokin: the poses of the bodies in a state of the last solution. Part of the Fortran
!> interface (ek_api).
module ek_session_poses
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_usage
   use ek_text, only: str
   use ek_state, only: state_t, design_state, unpack_state
   use ek_case_result, only: case_result_t
   use ek_wheel_side, only: deck_frame
   use ek_session, only: session_t
   use ek_session_solution, only: find_row
   implicit none(type, external)
   private
   public :: poses_at

contains

   !> Returns the motion of each body from design to a state of the last solution, in the axes of the deck. A point of body b that
   !> is at p at design [m] is at rotation(:, :, b) p + shift(:, b) in the state. All values are NaN if the state was not reached.
   subroutine poses_at(session, row, rotation, shift, error)
      type(session_t), intent(inout), target :: session
      integer, intent(in) :: row                           !! row of the table of the last solution
      real(wp), intent(out) :: rotation(:, :, :)           !! (3, 3, bodies)
      real(wp), intent(out) :: shift(:, :)                 !! (3, bodies) [m]
      type(error_t), allocatable, intent(out) :: error     !! exit_usage: no solution or row, wrong shape, other numbers since
      type(case_result_t), pointer :: result
      type(state_t) :: state
      real(wp) :: frame(3)
      integer :: number, b, i, j

      rotation = ieee_value(1.0_wp, ieee_quiet_nan)
      shift = ieee_value(1.0_wp, ieee_quiet_nan)
      call find_row(session, row, result, number, error)
      if (allocated(error)) return
      associate (model => result%suspension)
         if (any(shape(rotation) /= [3, 3, size(model%bodies)]) .or. any(shape(shift) /= [3, size(model%bodies)])) then
            call fail(error, exit_usage, 'expected 3 x 3 and 3 numbers for each of '//str(size(model%bodies))//' bodies')
            return
         end if
         if (.not. result%path%is_reached(number)) return
         state = design_state(model)
         call unpack_state(result%path%packed(:, number), state)
         frame = deck_frame(model)
         do b = 1, size(model%bodies)
            associate (pose => state%poses(b + 1))
               do j = 1, 3
                  do i = 1, 3
                     rotation(i, j, b) = frame(i)*frame(j)*pose%a(i, j)
                  end do
               end do
               shift(:, b) = frame*(pose%r - matmul(pose%a, model%bodies(b)%origin))
            end associate
         end do
      end associate
   end subroutine poses_at

end module ek_session_poses
