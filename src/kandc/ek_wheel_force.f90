!> The force of the ground on a wheel, from the deck's loads and the rig.
module ek_wheel_force
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, demand_t
   use ek_kkt, only: load_factor, wrench
   implicit none(type, external)
   private
   public :: vertical_force

contains

   !> Vertical force on wheel `wheel` [N], upward: the constant and the scaled loads on its carrier, and the force of a rig
   !> that holds its height. Weights of bodies are not included. If one body carries both wheels, a load counts for the
   !> nearer wheel, and half for each in the middle.
   pure real(wp) function vertical_force(suspension, state, demand, wheel) result(force)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(demand_t), intent(in) :: demand
      integer, intent(in) :: wheel
      real(wp) :: factor, share, f(3), moment(3), arm(3)
      integer :: k, t

      force = 0.0_wp
      do k = 1, size(suspension%loads)
         associate (load => suspension%loads(k))
            share = share_of(load%body, load%arm)
            if (.not. share > 0.0_wp .or. load%is_weight) cycle
            factor = 1.0_wp
            if (load%is_case) factor = load_factor(demand, k)
            call wrench(load, state%poses(load%body + 1), f, moment, arm)
            force = force + share*factor*f(3)
         end associate
      end do
      do k = suspension%own_rows() + 1, suspension%constraints()
         do t = suspension%rows(k)%first, suspension%rows(k)%first + suspension%rows(k)%terms - 1
            associate (term => suspension%terms(t))
               force = force - share_of(term%measure%body_j, term%measure%arm_j)* &
                  state%reaction(k)*term%coefficient*term%measure%u(3)
            end associate
         end do
      end do

   contains

      !> Share of a load at a point of a body that counts for the wheel: 1, 0 or ½.
      pure real(wp) function share_of(body, arm)
         integer, intent(in) :: body
         real(wp), intent(in) :: arm(3)      !! from the reference point, body axes [m]
         real(wp), parameter :: middle = 1.0e-9_wp      ! m: tolerance of equal distance
         real(wp) :: nearer
         integer :: other

         share_of = merge(1.0_wp, 0.0_wp, body == suspension%wheels(wheel)%body)
         do other = 1, size(suspension%wheels)
            if (other == wheel .or. suspension%wheels(other)%body /= body .or. .not. share_of > 0.0_wp) cycle
            nearer = abs(arm(2) - suspension%wheels(other)%contact(2)) - abs(arm(2) - suspension%wheels(wheel)%contact(2))
            if (abs(nearer) <= middle) then
               share_of = 0.5_wp
            else if (nearer < 0.0_wp) then
               share_of = 0.0_wp
            end if
         end do
      end function share_of

   end function vertical_force

end module ek_wheel_force
