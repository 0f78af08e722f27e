!> A force and a moment at a point of a body, or at the lowest point of a wheel.
!>
!> The lowest point moves in the carrier: the force acts on the material point of the carrier that is there at the state.
module ek_load
   use ek_kinds, only: wp
   use ek_number, only: num, mask, zero, some
   use ek_relative_rotation, only: pose_t
   use ek_block, only: rotated, add_block, add_s_block, r_j, pi_j
   use ek_rotation, only: cross, skew
   use ek_lowest_point, only: lowest_point, add_patch_tangent, patch_moment
   implicit none(type, external)
   private
   public :: load_t, load_numbers_t, load_list_t, wrench, add_load_tangent, has_potential, moment_without_potential

   !> The numbers of a load.
   type :: load_numbers_t
      real(num) :: arm(3) = zero         !! point of application from the reference point, body axes; with `wheel`, at design [m]
      real(num) :: force(3) = zero       !! force [N], global axes at design
      real(num) :: moment(3) = zero      !! moment [N m], global axes at design
      real(num) :: hub(3) = zero         !! with `wheel`: wheel centre from the reference point, body axes [m]
      real(num) :: rim(3) = zero         !! with `wheel`: core radius × axis of the wheel, body axes [m]
      real(num) :: crown = zero          !! with `wheel`: radius of the crown [m]
   end type load_numbers_t

   !> The numbers of a load as a list (see law_list_t).
   type :: load_list_t
      real(num) :: v(storage_size(load_numbers_t())/storage_size(zero)) = zero
   end type load_list_t

   !> A force and a moment at a point of a body.
   type, extends(load_numbers_t) :: load_t
      character(:), allocatable :: name, where
      integer :: body = 0
      logical :: follows = .false.        !! force and moment rotate with the body
      logical :: is_case = .false.        !! scaled by the case that refers to this load; otherwise constant
      logical :: is_weight = .false.      !! gravity of the body, not a load of the deck or the rig
      integer :: wheel = 0                !! index of the wheel at whose lowest point the load acts; 0: at a point of the body
      integer :: start_of = 0             !! index of the wheel that this constant load holds in the start state (ek_start); 0: none
   end type load_t

contains

   !> Computes force and moment of a load about the body's reference point in global axes, and the arm of the load.
   !> Equation (K.1) of docs/theory/kkt.md.
   !> Equation (M.20) of docs/theory/measures.md.
   pure subroutine wrench(load, pose, force, moment, arm)
      type(load_t), intent(in) :: load
      type(pose_t), intent(in) :: pose
      real(num), intent(out) :: force(3), moment(3)   !! N, N m
      real(num), intent(out) :: arm(3)                !! arm of the point of application, global axes [m]

      if (load%wheel > 0) then
         arm = rotated(pose%a, load%hub) + lowest_point(rotated(pose%a, load%rim))
         arm(3) = arm(3) - load%crown
      else
         arm = rotated(pose%a, load%arm)
      end if
      if (load%follows) then
         force = rotated(pose%a, load%force)
         moment = rotated(pose%a, load%moment)
      else
         force = load%force
         moment = load%moment
      end if
      moment = moment + cross(arm, force)
   end subroutine wrench

   !> Adds the stiffness of a load, −d(force, moment)/dz. For a load of constant direction the stiffness is −S(arm, force). For a
   !> load that rotates with its body, δf = π×f gives T_rπ = f̃; ½ f̃ is added to the block rπ, and its transpose to πr.
   !> Equation (K.4) of docs/theory/kkt.md.
   !> Equation (M.23) of docs/theory/measures.md.
   pure subroutine add_load_tangent(load, pose, force, arm, body, blocks)
      type(load_t), intent(in) :: load
      type(pose_t), intent(in) :: pose               !! of the body of the load
      real(num), intent(in) :: force(3), arm(3)      !! of wrench, the force times its factor [N]; [m]
      integer, intent(in) :: body                    !! index of its diagonal block
      real(num), intent(inout) :: blocks(6, 6, *)
      real(num) :: block(3, 3), backward(3)

      if (load%follows) then
         block = 0.5_wp*skew(force)
         call add_block(block, r_j, pi_j, [0, body, 0], blocks)
      else if (load%wheel > 0) then
         backward = rotated(pose%a, load%hub)
         backward = -backward
         call add_s_block(backward, force, body, blocks)
         call add_patch_tangent(force, rotated(pose%a, load%rim), body, blocks)
      else
         backward = -arm
         call add_s_block(backward, force, body, blocks)
      end if
   end subroutine add_load_tangent

   !> Whether a load has a potential, so that its stiffness is symmetric: no moment, a constant direction, and at the lowest point
   !> of a wheel a vertical force.
   pure logical function has_potential(load)
      type(load_t), intent(in) :: load
      logical(mask) :: is_skew
      is_skew = abs(load%moment(1)) + abs(load%moment(2)) + abs(load%moment(3)) > 0.0_wp
      if (load%wheel > 0) is_skew = is_skew .or. abs(load%force(1)) + abs(load%force(2)) > 0.0_wp
      has_potential = .not. (load%follows .or. some(is_skew))
   end function has_potential

   !> The moment m of the skew part N_ππ = ½ m̃ of a load of constant direction: the constant moment, and a force at the
   !> lowest point of a wheel.
   !> Equation (M.23) of docs/theory/measures.md.
   pure function moment_without_potential(load, pose) result(moment)
      type(load_t), intent(in) :: load
      type(pose_t), intent(in) :: pose               !! of the body of the load
      real(num) :: moment(3)

      moment = -load%moment
      if (load%wheel > 0) moment = moment + patch_moment(load%force, rotated(pose%a, load%rim), load%crown)
   end function moment_without_potential

end module ek_load
