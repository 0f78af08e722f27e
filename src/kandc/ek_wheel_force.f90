!> The force of the ground on a wheel: what the deck's loads and the rig bring to it.
module ek_wheel_force
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, demand_t
   use ek_kkt, only: load_factor, wrench
   implicit none(type, external)
   private
   public :: vertical_force

contains

   !> Vertical force on wheel `wheel` [N], upward: the constant and the scaled loads on its carrier, and
   !> what a rig that holds its height exerts. Weights of bodies are not among them. Where one body carries both
   !> wheels, a load belongs to the nearer one.
   pure real(wp) function vertical_force(suspension, state, demand, wheel) result(force)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(demand_t), intent(in) :: demand
      integer, intent(in) :: wheel
      real(wp) :: factor, f(3), moment(3), arm(3)
      integer :: k, t

      force = 0.0_wp
      do k = 1, size(suspension%loads)
         associate (load => suspension%loads(k))
            if (.not. belongs(load%body, load%arm)) cycle
            factor = 1.0_wp
            if (load%is_case) factor = load_factor(demand, k)
            call wrench(load, state%poses(load%body + 1), f, moment, arm)
            force = force + factor*f(3)
         end associate
      end do
      do k = 1, size(suspension%rows)
         if (.not. suspension%joints(suspension%rows(k)%joint)%is_rig) cycle
         do t = suspension%rows(k)%first, suspension%rows(k)%first + suspension%rows(k)%terms - 1
            associate (term => suspension%terms(t))
               if (belongs(term%measure%body_j, term%measure%arm_j)) &
                  force = force - state%reaction(k)*term%coefficient*term%measure%u(3)
            end associate
         end do
      end do

   contains

      pure logical function belongs(body, arm)
         integer, intent(in) :: body
         real(wp), intent(in) :: arm(3)
         integer :: other

         belongs = body == suspension%wheels(wheel)%body
         do other = 1, size(suspension%wheels)
            if (.not. belongs .or. other == wheel .or. suspension%wheels(other)%body /= body) cycle
            belongs = abs(arm(2) - suspension%wheels(wheel)%contact(2)) <= abs(arm(2) - suspension%wheels(other)%contact(2))
         end do
      end function belongs

   end function vertical_force

end module ek_wheel_force
