!> Checks that the states of a linear method lie on the path from design.
!>
!> The recursive and the corrected increment take one step without a check, and may step across a lock onto another assembly.
!> Therefore the exact path is followed again in a few long steps checked by ek_reach. At the end of each step, Newton's method
!> is started from the state of the linear method and must converge to the exact path. States beyond the last swept value at which
!> Newton's method converges are marked as not reached.
module ek_confirm
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_case, only: default_tolerance
   use ek_state, only: state_t, inputs_t, design_state, unpack_state, pack_state, motion_between, largest_motion
   use ek_schedule, only: schedule_t, inputs_at
   use ek_kkt, only: kkt_t
   use ek_newton, only: outcome_t, find_equilibrium
   use ek_branch, only: branch_t, new_branch, leave
   use ek_reach, only: failure_t, reach, settle
   implicit none(type, external)
   private
   public :: confirm

   integer, parameter :: max_evaluations = 10          !! largest number of comparisons per direction
   real(wp), parameter :: apart = 1.0e-6_wp       !! equilibria further apart are different [m]

contains

   !> Checks the states from `first` to `last`, outward from design, and marks states that are not on the path as not reached.
   !> Without static equilibrium under the constant loads, nothing is checked.
   subroutine confirm(suspension, schedule, place, packed, first, last, least, kkt, is_reached, failure)
      type(suspension_t), intent(in) :: suspension
      type(schedule_t), intent(in) :: schedule
      real(wp), intent(in) :: place(:)               !! swept value of each state
      real(wp), intent(in) :: packed(:, :)           !! (coordinate, state)
      integer, intent(in) :: first, last
      real(wp), intent(in) :: least                  !! shortest step [swept value]
      type(kkt_t), intent(inout) :: kkt
      logical, intent(inout) :: is_reached(:)
      type(failure_t), intent(inout) :: failure      !! state: the first rejected state
      type(state_t) :: exact, linear
      type(branch_t) :: branch
      type(inputs_t) :: inputs
      type(outcome_t) :: outcome
      type(failure_t) :: lost
      real(wp) :: motion(kkt%nq)
      real(wp), allocatable :: settled(:)
      integer :: k, sure, stride, iterations, end, direction

      direction = sign(1, last - first)
      end = first - direction
      do k = first, last, direction
         if (.not. is_reached(k)) exit
         end = k
      end do
      if ((end - first)*direction < 0) return
      exact = design_state(suspension)
      linear = exact
      call settle(suspension, default_tolerance, exact, kkt, lost)
      if (lost%state > 0) return
      allocate (settled(size(packed, 1)))
      call pack_state(exact, settled)
      branch = new_branch(suspension)
      branch%least = least
      branch%width = 1.0e3_wp*least
      call leave(branch, 0.0_wp, settled, kkt%negative)
      stride = max(1, (abs(end - first) + max_evaluations)/max_evaluations)
      sure = first - direction
      k = first
      if (abs(place(first)) <= 0.0_wp) then       ! design itself
         sure = first
         if (end == first) return
         k = first + sign(min(stride, abs(end - first)), direction)
      end if
      do
         call reach(suspension, schedule, place(k), default_tolerance, branch, exact, kkt, iterations, lost)
         if (lost%state > 0) then
            ! states before the end of the path are kept
            do while (sure /= k)
               if (abs(place(sure + direction)) > abs(lost%reached)) exit
               sure = sure + direction
            end do
            exit
         end if
         call unpack_state(packed(:, k), linear)
         call inputs_at(schedule, place(k), inputs)
         call find_equilibrium(suspension, inputs, default_tolerance, linear, kkt, outcome)
         if (.not. outcome%is_converged) exit
         call motion_between(exact, linear, motion)
         if (.not. largest_motion(motion, kkt%length) <= apart) exit
         sure = k
         if (k == end) return
         k = k + sign(min(stride, abs(end - k)), direction)
      end do
      is_reached(sure + direction:end:direction) = .false.
      if (lost%state == 0) then
         lost%value = place(sure + direction)
         lost%is_off_path = .true.
         if (sure - (first - direction) /= 0) lost%reached = place(sure)
      end if
      failure = lost
      failure%state = sure + direction
   end subroutine confirm

end module ek_confirm
