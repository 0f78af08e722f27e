!> Where the time of an increment goes: assembly, factorisation, solution, and the rest (prediction, moving the bodies, the checks
!> that the step stays on the branch).
module ek_increment_parts
   use ek_kinds, only: wp
   use ek_clock, only: seconds
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_kkt, only: kkt_t, assemble, factorise, solve, whole_tangent, residual_only
   use ek_path, only: path_t, new_path, walk
   implicit none(type, external)
   private
   public :: parts_t, time_walk, time_parts

   integer, parameter :: rounds = 5              !! the minimum counts
   integer, parameter :: most = 20               !! states on which the parts are timed

   !> Times per increment [s].
   type :: parts_t
      real(wp) :: increment = huge(1.0_wp)       !! all of it
      real(wp) :: assembly = 0.0_wp, factor = 0.0_wp, solve = 0.0_wp, rest = 0.0_wp
   end type parts_t

contains

   !> Walks the path of a case and keeps the shortest time of an increment so far.
   subroutine time_walk(suspension, case, path, kkt, parts)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(inout) :: path
      type(kkt_t), intent(inout) :: kkt
      type(parts_t), intent(inout) :: parts
      real(wp) :: start

      call new_path(suspension, case, path)
      start = seconds()
      call walk(suspension, case, path, kkt)
      parts%increment = min(parts%increment, (seconds() - start)/(path%states - 1))
   end subroutine time_walk

   !> Times the parts: one assembly, factorisation and solution at states of the path, as often as an increment has them.
   subroutine time_parts(suspension, case, path, kkt, parts)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(inout) :: path        !! of time_walk
      type(kkt_t), intent(inout) :: kkt          !! likewise
      type(parts_t), intent(inout) :: parts
      type(state_t) :: state
      type(inputs_t) :: inputs
      type(schedule_t) :: schedule
      real(wp) :: whole, residual, factor, solution, lap(4), factorisations, solutions, start
      integer :: k, round, number, count

      state = design_state(suspension)
      schedule = new_schedule(suspension, case)
      factorisations = kkt%factorisations        ! of another walk
      solutions = kkt%solutions
      call walk(suspension, case, path, kkt)
      factorisations = (kkt%factorisations - factorisations)/(path%states - 1)
      solutions = (kkt%solutions - solutions)/(path%states - 1)
      whole = huge(whole)
      residual = huge(whole)
      factor = huge(whole)
      solution = huge(whole)
      count = min(most, path%states)
      do round = 1, rounds
         lap = 0.0_wp
         do k = 1, count
            number = 1 + ((k - 1)*(path%states - 1))/max(count - 1, 1)
            call inputs_at(schedule, path%value(number), inputs)
            call unpack_state(path%packed(:, number), state)
            start = seconds()
            call assemble(suspension, state, inputs, residual_only, kkt)
            call next_lap(1)
            call assemble(suspension, state, inputs, whole_tangent, kkt)
            call next_lap(2)
            call factorise(kkt)
            call next_lap(3)
            call solve(kkt)
            call next_lap(4)
         end do
         lap = lap/count
         residual = min(residual, lap(1))
         whole = min(whole, lap(2))
         factor = min(factor, lap(3))
         solution = min(solution, lap(4))
      end do
      ! a solution with old factors has a new right-hand side
      parts%assembly = factorisations*whole + max(solutions - factorisations, 0.0_wp)*residual
      parts%factor = factorisations*factor
      parts%solve = solutions*solution
      parts%rest = max(parts%increment - parts%assembly - parts%factor - parts%solve, 0.0_wp)

   contains

      subroutine next_lap(part)
         integer, intent(in) :: part
         real(wp) :: now

         now = seconds()
         lap(part) = lap(part) + (now - start)
         start = seconds()
      end subroutine next_lap

   end subroutine time_parts

end module ek_increment_parts
