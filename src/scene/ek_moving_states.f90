!> The states in which pictures show a suspension moving: states of its travel and of its steering.
module ek_moving_states
   use ek_adjust, only: is_adjusted
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, design_state, unpack_state
   use ek_path, only: path_t
   use ek_test_result, only: test_result_t
   implicit none(type, external)
   private
   public :: moving_test, state_of_path, standing_state, travel_kinds, roll_kinds, steer_kinds

   character(16), parameter :: travel_kinds(3) = [character(16) :: 'parallel_travel', 'vertical_force', 'single_travel']
   character(16), parameter :: roll_kinds(2) = [character(16) :: 'roll', 'opposite_travel']
   character(16), parameter :: steer_kinds(1) = [character(16) :: 'steering']

contains

   !> Index of a test with more than one reached state: the first such test of the first kind that has one. 0 if no kind in
   !> the list has such a test.
   pure integer function moving_test(tests, paths, kinds) result(test)
      type(test_result_t), intent(in) :: tests(:)
      type(path_t), intent(in) :: paths(:)          !! paths of the tests
      character(*), intent(in) :: kinds(:)
      integer :: kind

      do kind = 1, size(kinds)
         do test = 1, size(tests)
            if (.not. tests(test)%is_run .or. tests(test)%kind /= kinds(kind)) cycle
            if (count(paths(test)%is_reached) > 1) return
         end do
      end do
      test = 0
   end function moving_test

   !> Reads state k of a path. The reactions of joints that the case adds come last in λ and are omitted.
   subroutine state_of_path(path, k, suspension, state)
      type(path_t), intent(in) :: path
      integer, intent(in) :: k
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(out) :: state

      state = design_state(suspension)
      call unpack_state(path%packed(:7*size(suspension%bodies) + suspension%constraints(), k), state)
   end subroutine state_of_path

   !> Returns the state of the axle as it stands: the design position, or, if adjusters have values or parts deviate, the state
   !> of the travel at 0. Without such a test, it is the design position.
   subroutine standing_state(tests, paths, suspension, state)
      type(test_result_t), intent(in) :: tests(:)
      type(path_t), intent(in) :: paths(:)          !! paths of the tests
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(out) :: state
      integer :: test

      state = design_state(suspension)
      if (.not. is_adjusted(suspension)) return
      test = moving_test(tests, paths, travel_kinds(:1))
      if (test > 0) call state_of_path(paths(test), minloc(abs(paths(test)%value), dim=1, mask=paths(test)%is_reached), &
         suspension, state)
   end subroutine standing_state

end module ek_moving_states
