!> Determines why a path ends: at its last equilibrium either the joints lock or the tangent stiffness vanishes.
!>
!> Near the end of a path N is nearly singular, and so is one of two matrices, scaled as in ek_scale:
!>
!> - Φq: its smallest singular value tends to zero where the joints cannot be assembled further (a lock).
!> - Zᵀ T Z, with Z a basis of the motions that the joints allow: its eigenvalue closest to zero vanishes where the load has its
!>   maximum (a limit point) or a body is released (a mechanism: a slide leaves the stop that held it).
!>
!> Both values are compared with the values at design.
module ek_break
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t, design_state
   use ek_kkt, only: kkt_t, assemble, whole_tangent
   use ek_diagnosis, only: scaled_parts, modes
   use ek_motion_text, only: main_body
   use ek_singular_values, only: singular_values_t, decompose
   implicit none(type, external)
   private
   public :: break_t, why_it_ends, no_reason, lock, limit_point, mechanism

   integer, parameter :: no_reason = 0, lock = 1, limit_point = 2, mechanism = 3

   real(wp), parameter :: vanished = 1.0e-2_wp     !! limit, as a share of the value at design; 1e-9 of the range before the end,
                                                   !! the share is about 1e-4
   real(wp), parameter :: gone = 1.0e-6_wp         !! limit, as a share of the value at design: below it nothing holds a body (a
                                                   !! load maximum leaves more)
   real(wp), parameter :: takes_part = 0.3_wp      !! limit, as a share of the largest force of a joint in a left singular vector:
                                                   !! joints with larger forces are listed
   real(wp), parameter :: no_force = 1.0e-6_wp     !! limit, as a share of the largest moment over the characteristic length: smaller
                                                   !! forces count as zero

   !> The reason why a path ends, and the joints or the motion of the null vector.
   type :: break_t
      integer :: reason = no_reason
      logical, allocatable :: locks(:)      !! of each joint: whether the joint is involved in a lock
      integer :: body = 0                   !! limit point or mechanism: index of the body that moves most without stiffness
      real(wp), allocatable :: motion(:)    !! limit point or mechanism: motion without stiffness, scaled unknowns
   end type break_t

contains

   !> Examines the last equilibrium of a path. The cost is a few dense decompositions.
   subroutine why_it_ends(suspension, state, inputs, kkt, found)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state            !! the last equilibrium
      type(inputs_t), intent(in) :: inputs          !! inputs at the state
      type(kkt_t), intent(inout) :: kkt             !! work space of this model
      type(break_t), intent(out) :: found
      real(wp) :: parts(size(suspension%joints)), motion(kkt%nq), closing(2), stiffness(2)

      allocate (found%locks(size(suspension%joints)), source=.false.)
      call examine(suspension, design_state(suspension), inputs_t(), kkt, closing(1), stiffness(1), parts, motion)
      call examine(suspension, state, inputs, kkt, closing(2), stiffness(2), parts, motion)
      if (closing(2) < vanished*closing(1)) then
         found%reason = lock
         found%locks = parts > takes_part*maxval(parts)
      else if (abs(stiffness(2)) < vanished*abs(stiffness(1))) then
         found%reason = merge(mechanism, limit_point, abs(stiffness(2)) < gone*abs(stiffness(1)))
         found%motion = motion
         found%body = main_body(motion)
      end if
   end subroutine why_it_ends

   !> Finds the smallest singular value of Φq with the parts of the joints in its left vector, and the eigenvalue of Zᵀ T Z closest to zero with its motion.
   !> A value that cannot be found is 1 (no rigid rows, no motion, a decomposition that failed).
   subroutine examine(suspension, state, inputs, kkt, closing, stiffness, parts_of_joints, motion)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(inout) :: kkt
      real(wp), intent(out) :: closing, stiffness
      real(wp), intent(out) :: parts_of_joints(:)   !! of joint_parts
      real(wp), intent(out) :: motion(:)            !! scaled unknowns
      type(singular_values_t) :: parts
      real(wp), allocatable :: jacobian(:, :), tangent(:, :), motions(:, :), value(:), noise(:)
      integer, allocatable :: rows(:)
      logical :: is_found
      integer :: i, m, n

      call assemble(suspension, state, inputs, whole_tangent, kkt)
      call scaled_parts(suspension, kkt, rows, jacobian, tangent)
      call decompose(jacobian, 0.0_wp, parts, wants_null_space=.true.)
      parts_of_joints = 0.0_wp
      motion = 0.0_wp
      closing = 1.0_wp
      stiffness = 1.0_wp
      m = size(rows)
      n = kkt%nq - m
      if (.not. parts%is_found .or. n < 0) return
      if (m > 0) then
         closing = parts%values(m)
         parts_of_joints = joint_parts(suspension, rows, parts%left(:, m), jacobian)
      end if
      if (n == 0) return
      allocate (motions(kkt%nq, n), value(n), noise(n))
      call modes(tangent, parts%right(:, m + 1:), 0.0_wp, motions, value, noise, is_found)
      if (.not. is_found) return
      i = minloc(abs(value), dim=1)
      stiffness = value(i)
      motion = motions(:, i)
   end subroutine examine

   !> The largest force of each joint on a body in a left singular vector, scaled. A force does not depend on the point of the joint,
   !> whereas a moment grows with the distance of this point: only if no joint has a force, moments are compared instead.
   pure function joint_parts(suspension, rows, left, jacobian) result(forces)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: rows(:)                !! indices of the rigid rows
      real(wp), intent(in) :: left(:)               !! left singular vector, one element per rigid row
      real(wp), intent(in) :: jacobian(:, :)        !! scaled Φq
      real(wp) :: forces(size(suspension%joints))
      real(wp) :: load(size(jacobian, 2)), moments(size(suspension%joints))
      integer :: j, b

      forces = 0.0_wp
      moments = 0.0_wp
      do j = 1, size(forces)
         load = matmul(pack(left, suspension%rows(rows)%joint == j), jacobian(pack([(b, b=1, size(rows))], &
            suspension%rows(rows)%joint == j), :))
         do b = 0, size(load) - 6, 6
            forces(j) = max(forces(j), norm2(load(b + 1:b + 3)))
            moments(j) = max(moments(j), norm2(load(b + 4:b + 6)))
         end do
      end do
      if (maxval(forces) <= no_force*maxval(moments)) forces = moments
   end function joint_parts

end module ek_break
