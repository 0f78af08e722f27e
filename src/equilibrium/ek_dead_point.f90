!> Recognises dead points: positions, such as a crank and its rod in line, in which a constraint is redundant and a motion is free at
!> the same time, but in no neighbouring position. The joints are sound; the position is not.
module ek_dead_point
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: quoted
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t, move
   use ek_kkt, only: kkt_t, assemble, whole_matrix, whole_tangent
   use ek_motion_text, only: motion_text, place
   use ek_singular_values, only: singular_values_t, decompose
   implicit none(type, external)
   private
   public :: recognise_dead_point

   real(wp), parameter :: step = 1.0e-3_wp             !! largest motion to the neighbouring position [m, rad]
   real(wp), parameter :: opens = 3.0e-5_wp            !! limit of the smallest singular value there, as a share of the largest. At a
                                                       !! dead point it grows with the step, otherwise with its square
   real(wp), parameter :: takes_part = 1.0e-3_wp       !! limit, as a share of the largest entry of a left null vector

contains

   !> Replaces the messages on mechanisms and redundant constraints by one on a dead point, if all constraints are independent in a
   !> neighbouring position.
   subroutine recognise_dead_point(suspension, state, rows, left, right, kkt, mechanisms, redundancies)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: rows(:)               !! indices of the rigid rows in the suspension
      real(wp), intent(in) :: left(:, :)           !! left null space of scaled Φq at the state
      real(wp), intent(in) :: right(:, :)          !! right null space
      type(kkt_t), intent(inout) :: kkt            !! work space; overwritten
      type(message_list_t), intent(inout) :: mechanisms, redundancies
      type(singular_values_t) :: parts
      type(message_list_t) :: found
      type(state_t) :: beside
      real(wp) :: motion(kkt%nq)
      character(:), allocatable :: joints
      integer :: k, j

      if (size(rows) > kkt%nq .or. size(right, 2) == 0) return      ! too many constraints in any position
      motion = 0.0_wp
      do k = 1, size(right, 2)                     ! a motion in which all free directions take part, unequally
         motion = motion + right(:, k)/real(k, wp)
      end do
      motion = motion/max(norm2(motion), tiny(1.0_wp))
      beside = state
      motion = motion*kkt%scale(:kkt%nq)
      call move(beside, step*motion/max(maxval(abs(motion)), tiny(1.0_wp)))
      call assemble(suspension, beside, inputs_t(), whole_tangent, kkt)
      call decompose(scaled_rows(rows, kkt), 0.0_wp, parts, wants_null_space=.false.)
      if (.not. parts%is_found) return
      if (parts%values(size(rows)) < opens*parts%values(1)) return
      joints = ''
      do j = 1, size(suspension%joints)
         if (.not. any([(any(abs(pack(left(:, k), suspension%rows(rows)%joint == j)) > takes_part*maxval(abs(left(:, k)))), &
            k=1, size(left, 2))])) cycle
         if (joints /= '') joints = joints//', '
         joints = joints//quoted(suspension%joints(j)%name)//place(suspension%joints(j)%where)
      end do
      call found%add('dead point: only in this position (parts in line, for instance), joints '//joints// &
         ' cannot start this motion: '//motion_text(suspension, state, kkt, right(:, 1))//'; the joints are sound in other '// &
         'positions: choose another design position, or drive this body')
      mechanisms = found
      redundancies = message_list_t()
   end subroutine recognise_dead_point

   !> The scaled Φq of the rigid rows of the last assembled system.
   function scaled_rows(rows, kkt) result(jacobian)
      integer, intent(in) :: rows(:)
      type(kkt_t), intent(in) :: kkt
      real(wp) :: jacobian(size(rows), kkt%nq)
      real(wp) :: whole(kkt%n, kkt%n)
      integer :: j

      whole = whole_matrix(kkt)
      do j = 1, kkt%nq
         jacobian(:, j) = whole(kkt%nq + rows, j)*kkt%scale(kkt%nq + rows)*kkt%scale(j)
      end do
   end function scaled_rows

end module ek_dead_point
