!> The C interface (include/elastokin.h): the bodies of a model, and their motion in a state of the last solution.
module ek_c_poses
   use, intrinsic :: iso_c_binding, only: c_double, c_int, c_null_ptr, c_ptr
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_case_result, only: case_result_t
   use ek_session_poses, only: poses_at
   use ek_c_handle, only: handle_t, open_handle, take_array, finish, say, is_position, ek_ok
   use ek_c_results, only: take_solution
   implicit none(type, external)
   private
   public :: ek_body_count, ek_body_name, ek_poses

contains

   !> Number of bodies of the model, without the chassis; 0 without a deck.
   integer(c_int) function ek_body_count(model) bind(c) result(count)
      type(c_ptr), value :: model
      type(handle_t), pointer :: handle

      handle => open_handle(model)
      count = 0
      if (associated(handle)) count = int(size(handle%session%workspace%raw%bodies), c_int)
   end function ek_body_count

   !> Name of body k, from 0, as a C string; NULL outside the list.
   type(c_ptr) function ek_body_name(model, k) bind(c) result(address)
      type(c_ptr), value :: model
      integer(c_int), value :: k
      type(handle_t), pointer :: handle

      handle => open_handle(model)
      address = c_null_ptr
      if (.not. associated(handle)) return
      associate (bodies => handle%session%workspace%raw%bodies)
         if (is_position(handle, k, size(bodies))) address = say(handle, bodies(k + 1)%name)
      end associate
   end function ek_body_name

   !> Exit code after copying the motion of all bodies in a state (elastokin.h).
   integer(c_int) function ek_poses(model, row, n, values) bind(c) result(code)
      type(c_ptr), value :: model, values
      integer(c_int), value :: row, n
      type(handle_t), pointer :: handle
      type(case_result_t), pointer :: last
      type(error_t), allocatable :: error
      real(c_double), pointer :: place(:)
      real(wp), allocatable :: rotation(:, :, :), shift(:, :)
      integer :: bodies, b

      call take_solution(model, handle, last, code)
      if (code /= ek_ok) return
      if (.not. is_position(handle, row, size(last%table%values, 2), code)) return
      bodies = size(last%suspension%bodies)
      call take_array(handle, values, n, 12*bodies, 'the array must have 12 x bodies numbers (ek_body_count)', place, code)
      if (code /= ek_ok) return
      allocate (rotation(3, 3, bodies), shift(3, bodies))
      call poses_at(handle%session, row + 1, rotation, shift, error)
      code = finish(handle, error)
      if (code /= ek_ok) return
      do b = 1, bodies
         place(12*b - 11:12*b - 3) = reshape(transpose(rotation(:, :, b)), [9])
         place(12*b - 2:12*b) = shift(:, b)
      end do
   end function ek_poses

end module ek_c_poses
