!> The plans of elimination of a KKT system: for the matrix of an increment, and for the matrix with the rig's rows released.
module ek_kkt_plans
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t, design_state, move_as_screw
   use ek_pattern, only: whole_tangent
   use ek_kkt_system, only: kkt_t, assemble, release, nothing, held, released
   use ek_plan, only: new_plan
   implicit none(type, external)
   private
   public :: make_plans

contains

   !> Finds the plans from matrices at three states: design, and two states in which every body is moved and every reaction acts, so
   !> that no entry is small by chance. The order depends on the entries of these matrices, never on a state that is solved.
   subroutine make_plans(suspension, kkt)
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(inout) :: kkt
      integer, parameter :: samples = 3
      real(wp) :: values(samples, kkt%pattern%entries)
      type(state_t) :: state
      integer :: way, s, k

      do way = held, released
         do s = 1, samples
            state = design_state(suspension)
            if (s > 1) call displace(state, s - 1, 0.05_wp*kkt%length, 0.1_wp, 0.02_wp*kkt%stiffness*kkt%length)
            call assemble(suspension, state, inputs_t(), whole_tangent, kkt)
            if (way == released) then
               do k = suspension%own_rows() + 1, suspension%constraints()
                  call release(k, kkt)
               end do
            end if
            values(s, :) = kkt%store(kkt%pattern%from)*kkt%scaling
         end do
         call new_plan(kkt%n, kkt%pattern%row, kkt%pattern%column, values, kkt%plan(way))
      end do
      allocate (kkt%planned(maxval(kkt%plan%length)), source=0.0_wp)
      kkt%stage = nothing
   end subroutine make_plans

   !> Moves every body and sets every reaction. The sizes are distance, angle and force times numbers between −1 and 1, which are
   !> equal in every run.
   pure subroutine displace(state, number, distance, angle, force)
      type(state_t), intent(inout) :: state
      integer, intent(in) :: number              !! index of the sequence of numbers
      real(wp), intent(in) :: distance, angle, force   !! m, rad, N
      real(wp) :: step(6*(size(state%poses) - 1))
      real(wp), parameter :: golden = 0.6180339887498949_wp
      integer :: k

      step = [(2.0_wp*modulo(golden*k*(2*number - 1) + 0.3_wp*number, 1.0_wp) - 1.0_wp, k=1, size(step))]
      do k = 0, size(step) - 6, 6
         step(k + 1:k + 3) = distance*step(k + 1:k + 3)
         step(k + 4:k + 6) = angle*step(k + 4:k + 6)
      end do
      call move_as_screw(state, step)
      state%reaction(:) = [(force*(2.0_wp*modulo(golden*k*(2*number + 1) + 0.7_wp, 1.0_wp) - 1.0_wp), k=1, size(state%reaction))]
   end subroutine displace

end module ek_kkt_plans
