!> A state of a suspension (poses of the bodies and reactions of the joints) and the inputs to it.
module ek_state
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_relative_rotation, only: pose_t
   use ek_rotation, only: rotate_quaternion, rotation_matrix
   use ek_motion, only: largest_motion, move_all, find_motion
   use ek_suspension, only: suspension_t, design_poses
   use ek_case, only: max_driven
   implicit none(type, external)
   private
   public :: state_t, inputs_t, design_state, return_to_design, is_design, coordinates, pack_state, unpack_state, move, &
      move_as_screw
   public :: inputs_rate, motion_between, largest_motion

   !> Poses of bodies 0 … n (index 1 is the chassis, which is fixed) and the reactions λ.
   type :: state_t
      type(pose_t), allocatable :: poses(:)
      real(wp), allocatable :: reaction(:)   !! λ, one per constraint row [N; N m for rows of cosines and angles]
   end type state_t

   !> The inputs of one state: scaled loads and prescribed values, in addition to the constant loads. The size
   !> is fixed, so that passing it allocates no memory.
   type :: inputs_t
      integer :: loads = 0, rows = 0               !! number of scaled loads, of driven rows
      integer :: load(max_driven) = 0             !! indices of the scaled loads
      integer :: further(max_driven) = 0          !! number of loads after each of these loads that have the same factor
      integer :: row(max_driven) = 0              !! indices of the driven constraint rows
      real(wp) :: factor(max_driven) = 0.0_wp     !! factor of each load [-]
      real(wp) :: change(max_driven) = 0.0_wp     !! change of the value of each row [m, -, rad]
      real(wp) :: homotopy = 0.0_wp       !! share of the design imbalance removed: 1 at design, 0 in the real problem
   end type inputs_t

contains

   !> The difference of two sets of inputs per unit of the path coordinate. Both sets have the same loads and rows.
   pure function inputs_rate(a, b, width) result(rate)
      type(inputs_t), intent(in) :: a, b
      real(wp), intent(in) :: width      !! swept value of b minus swept value of a; not 0
      type(inputs_t) :: rate

      rate = b
      rate%factor = (b%factor - a%factor)/width
      rate%change = (b%change - a%change)/width
      rate%homotopy = (b%homotopy - a%homotopy)/width
   end function inputs_rate

   !> Finds the motion of every body between two states: Δr of its reference point, and its rotation vector, global axes.
   pure subroutine motion_between(a, b, motion)
      type(state_t), intent(in) :: a, b
      real(wp), contiguous, intent(out) :: motion(:)   !! [Δr Δπ] of each body [m, rad]
      integer :: k

      do k = 2, size(a%poses)
         call find_motion(a%poses(k)%r, a%poses(k)%q, b%poses(k)%r, b%poses(k)%q, motion(6*k - 11:6*k - 6))
      end do
   end subroutine motion_between

   !> The state at design, without reactions.
   function design_state(suspension) result(state)
      type(suspension_t), intent(in) :: suspension
      type(state_t) :: state

      allocate (state%poses, source=design_poses(suspension))
      allocate (state%reaction(suspension%constraints()), source=0.0_wp)
   end function design_state

   !> Resets a state of this model to the design state, in place.
   pure subroutine return_to_design(suspension, state)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(inout) :: state
      integer :: k

      state%poses(1) = pose_t()
      do k = 1, size(suspension%bodies)
         state%poses(k + 1) = pose_t(r=suspension%bodies(k)%origin)
      end do
      state%reaction(:) = 0.0_wp
   end subroutine return_to_design

   !> Whether a state equals the design state exactly.
   pure logical function is_design(suspension, state)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(pose_t) :: at_rest
      integer :: k

      is_design = .not. any(abs(state%reaction) > 0.0_wp)
      do k = 1, size(suspension%bodies)
         associate (pose => state%poses(k + 1))
            is_design = is_design .and. all(abs(pose%r - suspension%bodies(k)%origin) <= 0.0_wp) .and. &
               all(abs(pose%a - at_rest%a) <= 0.0_wp)
         end associate
      end do
   end function is_design

   !> Length of a packed state: 7 numbers per body, and the number of reactions.
   pure integer function coordinates(suspension)
      type(suspension_t), intent(in) :: suspension
      coordinates = 7*size(suspension%bodies) + suspension%constraints()
   end function coordinates

   !> Packs a state: [r, q] of each body, then λ.
   pure subroutine pack_state(state, packed)
      type(state_t), intent(in) :: state
      real(wp), contiguous, intent(out) :: packed(:)
      integer :: k, at

      at = 0
      do k = 2, size(state%poses)
         packed(at + 1:at + 3) = state%poses(k)%r
         packed(at + 4:at + 7) = state%poses(k)%q
         at = at + 7
      end do
      packed(at + 1:) = state%reaction
   end subroutine pack_state

   !> Unpacks a state; quaternions are normalised.
   pure subroutine unpack_state(packed, state)
      real(wp), contiguous, intent(in) :: packed(:)
      type(state_t), intent(inout) :: state
      integer :: k, at

      if (are_checked) call require(size(packed) == 7*(size(state%poses) - 1) + size(state%reaction), &
         'unpack_state: the packed state is of another model')
      at = 0
      do k = 2, size(state%poses)
         associate (pose => state%poses(k), q => packed(at + 4:at + 7))
            pose%r = packed(at + 1:at + 3)
            pose%q = q/sqrt(q(1)**2 + q(2)**2 + q(3)**2 + q(4)**2)
            pose%a = rotation_matrix(pose%q)
         end associate
         at = at + 7
      end do
      state%reaction(:) = packed(at + 1:)
   end subroutine unpack_state

   !> Moves every body: r ← r + Δr, A ← exp(Δπ̃) A (Kang 2005, eq. 4).
   !> Equation (R.5) of docs/theory/rotations.md.
   pure subroutine move(state, step)
      type(state_t), intent(inout) :: state
      real(wp), contiguous, intent(in) :: step(:)   !! [Δr Δπ] of each body [m, rad]
      integer :: k, at

      at = 0
      do k = 2, size(state%poses)
         associate (pose => state%poses(k))
            pose%r = pose%r + step(at + 1:at + 3)
            pose%q = rotate_quaternion(step(at + 4:at + 6), pose%q)
            pose%a = rotation_matrix(pose%q)
         end associate
         at = at + 6
      end do
   end subroutine move

   !> Moves every body by a screw motion (see ek_motion).
   pure subroutine move_as_screw(state, step)
      type(state_t), intent(inout) :: state
      real(wp), contiguous, intent(in) :: step(:)   !! [Δr Δπ] of each body [m, rad]
      call move_all(size(state%poses) - 1, step, state%poses)
   end subroutine move_as_screw

end module ek_state
