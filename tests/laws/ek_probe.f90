!> The slopes of the columns of a wheel by solving again: a model at rest, small loads, fourth-order differences.
!>
!> What is read off a state is what the columns are made of (ek_attitude), never the compliance matrix.
module ek_probe
   use ek_kinds, only: wp
   use ek_orientation_matrix, only: quaternion_of_matrix
   use ek_suspension, only: suspension_t, load_t
   use ek_parts, only: add_load
   use ek_example, only: hold_height
   use ek_kkt, only: kkt_t, new_kkt
   use ek_newton, only: outcome_t, find_equilibrium
   use ek_state, only: state_t, inputs_t
   use ek_attitude, only: attitude_t, wheel_attitude
   implicit none(type, external)
   private
   public :: rest_t, push_t, slope_t, hold_heights, slopes_under, slopes_over

   !> A model at rest under its demand, which the probes leave alone.
   type :: rest_t
      type(suspension_t) :: suspension
      type(state_t) :: state
      type(inputs_t) :: inputs
      integer :: order(2) = 0            !! wheels, left before right
      integer :: wheels = 0
      integer :: holder(2) = 0           !! rows that hold the heights, 0: none
   end type rest_t

   !> Forces and moments on the wheels, each per unit of the load.
   type :: push_t
      real(wp) :: force(3, 2) = 0.0_wp, moment(3, 2) = 0.0_wp
      logical :: is_at_patch = .true.
   end type push_t

   !> Derivatives per unit of the load, left and right. SI, rad.
   type :: slope_t
      real(wp) :: toe(2) = 0.0_wp, camber(2) = 0.0_wp, caster(2) = 0.0_wp
      real(wp) :: centre(3, 2) = 0.0_wp, patch(3, 2) = 0.0_wp, rotation(3, 2) = 0.0_wp
      real(wp) :: lift(2) = 0.0_wp       !! what the ground exerts to hold the heights [N]
      logical :: is_found = .true.
   end type slope_t

   ! m, rad: about what a load moves the most compliant of what it moves by; see test_library_compliance for why so little
   real(wp), parameter :: step = 1.0e-6_wp
   real(wp), parameter :: found = 1.0e-11_wp
   integer, parameter :: place(4) = [-2, -1, 1, 2]
   real(wp), parameter :: weight(4) = [1.0_wp, -8.0_wp, 8.0_wp, -1.0_wp]/12.0_wp

contains

   !> The same rest with the heights of wheel centres or patches held where they are.
   subroutine hold_heights(rest, wheels, is_at_patch, held)
      type(rest_t), intent(in) :: rest
      integer, intent(in) :: wheels(:)            !! 1 left, 2 right
      logical, intent(in) :: is_at_patch
      type(rest_t), intent(out) :: held
      type(attitude_t) :: now
      integer :: k, rows

      held = rest
      do k = 1, size(wheels)
         call hold_height(held%suspension, 'hold'//achar(48 + k), rest%order(wheels(k)), merge('patch ', 'centre', is_at_patch))
         rows = size(held%suspension%rows)
         now = wheel_attitude(rest%suspension, rest%state, rest%order(wheels(k)))
         held%holder(wheels(k)) = rows
         held%inputs%rows = held%inputs%rows + 1
         held%inputs%row(held%inputs%rows) = rows
         held%inputs%change(held%inputs%rows) = now%centre(3)
         if (is_at_patch) held%inputs%change(held%inputs%rows) = now%contact(3)
      end do
      held%state%reaction = [rest%state%reaction, (0.0_wp, k=1, size(wheels))]
   end subroutine hold_heights

   !> Slopes of everything over a load.
   subroutine slopes_under(rest, push, compliance, slope)
      type(rest_t), intent(in) :: rest
      type(push_t), intent(in) :: push
      real(wp), intent(in) :: compliance          !! about what a unit moves, m or rad: settles the size of a step alone
      type(slope_t), intent(out) :: slope
      type(suspension_t) :: probed
      type(load_t) :: load
      real(wp) :: amount
      integer :: p, w, first

      probed = rest%suspension
      first = size(probed%loads)
      load%where = ''
      do w = 1, rest%wheels
         associate (wheel => rest%suspension%wheels(rest%order(w)))
            load%name = 'probe'//achar(48 + w)
            load%body = wheel%body
            load%arm = wheel%centre
            if (push%is_at_patch) load%arm = wheel%contact
         end associate
         call add_load(probed, load)
      end do
      amount = step/compliance
      do p = 1, 4
         do w = 1, rest%wheels
            probed%loads(first + w)%force = place(p)*amount*push%force(:, w)
            probed%loads(first + w)%moment = place(p)*amount*push%moment(:, w)
         end do
         call add_state(probed, rest, rest%inputs, weight(p)/amount, slope)
      end do
   end subroutine slopes_under

   !> Slopes of everything over what a driver of the deck prescribes [per m].
   subroutine slopes_over(rest, row, slope)
      type(rest_t), intent(in) :: rest
      integer, intent(in) :: row                  !! of the driver
      type(slope_t), intent(out) :: slope
      type(inputs_t) :: inputs
      integer :: p, k

      do p = 1, 4
         inputs = rest%inputs
         do k = 1, inputs%rows
            if (inputs%row(k) == row) exit
         end do
         if (k > inputs%rows) then
            inputs%rows = k
            inputs%row(k) = row
            inputs%change(k) = 0.0_wp
         end if
         inputs%change(k) = inputs%change(k) + 10.0_wp*place(p)*step
         call add_state(rest%suspension, rest, inputs, weight(p)/(10.0_wp*step), slope)
      end do
   end subroutine slopes_over

   !> Adds what one equilibrium has to slopes, times its share.
   subroutine add_state(probed, rest, inputs, share, slope)
      type(suspension_t), intent(in) :: probed
      type(rest_t), intent(in) :: rest
      type(inputs_t), intent(in) :: inputs
      real(wp), intent(in) :: share
      type(slope_t), intent(inout) :: slope
      type(state_t) :: near
      type(kkt_t) :: kkt
      type(outcome_t) :: outcome
      type(attitude_t) :: now
      real(wp) :: q(4)
      integer :: w, body

      kkt = new_kkt(probed)
      near = rest%state
      call find_equilibrium(probed, inputs, found, near, kkt, outcome)
      slope%is_found = slope%is_found .and. outcome%is_converged
      do w = 1, rest%wheels
         now = wheel_attitude(probed, near, rest%order(w))
         slope%toe(w) = slope%toe(w) + share*now%toe
         slope%camber(w) = slope%camber(w) + share*now%camber
         slope%caster(w) = slope%caster(w) + share*now%axis%caster
         slope%centre(:, w) = slope%centre(:, w) + share*now%centre
         slope%patch(:, w) = slope%patch(:, w) + share*now%contact
         body = probed%wheels(rest%order(w))%body + 1
         q = quaternion_of_matrix(matmul(near%poses(body)%a, transpose(rest%state%poses(body)%a)))
         q = q*sign(1.0_wp, q(1))
         slope%rotation(:, w) = slope%rotation(:, w) + share*2.0_wp*q(2:4)      ! sin for the angle itself
         if (rest%holder(w) > 0) slope%lift(w) = slope%lift(w) - share*near%reaction(rest%holder(w))
      end do
   end subroutine add_state

end module ek_probe
