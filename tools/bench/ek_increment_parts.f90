!> Times of the parts of an increment: assembly, factorisation, solution, and the rest (prediction, moving the bodies, the checks
!> that the step stays on the branch).
module ek_increment_parts
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_kkt, only: kkt_t, assemble, factorise, solve, whole_tangent, residual_only
   use ek_path, only: path_t, new_path, walk
   implicit none(type, external)
   private
   public :: parts_t, time_walk, time_parts, processor_seconds

   integer, parameter :: rounds = 30             !! rounds of a measurement; the minimum counts
   integer, parameter :: most = 20               !! largest number of states at which the parts are timed

   ! Work at a state; each of the last three needs the one before. The clock of the processor counts microseconds, so the times of
   ! many states are compared, not single steps.
   integer, parameter :: unpacking = 1, reacting = 2, assembling = 3, factorising = 4, solving = 5

   !> Processor times per increment [s].
   type :: parts_t
      real(wp) :: increment = huge(1.0_wp)       !! time of the whole increment
      real(wp) :: assembly = 0.0_wp, factor = 0.0_wp, solve = 0.0_wp, rest = 0.0_wp
   end type parts_t

contains

   !> Processor time of this process in all its threads [s]. Waiting for a busy processor does not count. The resolution is 1 us
   !> with gfortran on Linux.
   real(wp) function processor_seconds()
      call cpu_time(processor_seconds)
   end function processor_seconds

   !> Walks the path of a case and stores the shortest time of an increment so far.
   subroutine time_walk(suspension, case, path, kkt, parts)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(inout) :: path
      type(kkt_t), intent(inout) :: kkt
      type(parts_t), intent(inout) :: parts
      real(wp) :: start

      call new_path(suspension, case, path)
      start = processor_seconds()
      call walk(suspension, case, path, kkt)
      parts%increment = min(parts%increment, (processor_seconds() - start)/(path%states - 1))
   end subroutine time_walk

   !> Times the parts of an increment: assembly, factorisation and solution, measured at states of the path. Each time is multiplied
   !> by the mean number of these operations per increment.
   subroutine time_parts(suspension, case, path, kkt, parts)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(inout) :: path        !! path of time_walk
      type(kkt_t), intent(inout) :: kkt          !! system of time_walk
      type(parts_t), intent(inout) :: parts
      type(state_t) :: state
      type(inputs_t) :: inputs
      type(schedule_t) :: schedule
      real(wp) :: least(unpacking:solving), spent, factorisations, solutions
      integer :: round, work

      state = design_state(suspension)
      schedule = new_schedule(suspension, case)
      factorisations = kkt%factorisations        ! of another walk
      solutions = kkt%solutions
      call walk(suspension, case, path, kkt)
      factorisations = (kkt%factorisations - factorisations)/(path%states - 1)
      solutions = (kkt%solutions - solutions)/(path%states - 1)
      least = huge(spent)
      do round = 1, rounds
         do work = unpacking, solving
            call time_work(work, spent)
            least(work) = min(least(work), spent)
         end do
      end do
      ! a solution with old factors has a new right-hand side
      parts%assembly = max(factorisations*(least(assembling) - least(unpacking)) + &
         max(solutions - factorisations, 0.0_wp)*(least(reacting) - least(unpacking)), 0.0_wp)
      parts%factor = factorisations*max(least(factorising) - least(assembling), 0.0_wp)
      parts%solve = solutions*max(least(solving) - least(factorising), 0.0_wp)
      parts%rest = max(parts%increment - parts%assembly - parts%factor - parts%solve, 0.0_wp)

   contains

      !> Measures the time per state of one kind of work, including all work required before it.
      subroutine time_work(work, spent)
         integer, intent(in) :: work
         real(wp), intent(out) :: spent
         real(wp) :: start
         integer :: k, count, number

         count = min(most, path%states)
         start = processor_seconds()
         do k = 1, count
            number = 1 + ((k - 1)*(path%states - 1))/max(count - 1, 1)
            call inputs_at(schedule, path%value(number), inputs)
            call unpack_state(path%packed(:, number), state)
            if (work == reacting) call assemble(suspension, state, inputs, residual_only, kkt)
            if (work >= assembling) call assemble(suspension, state, inputs, whole_tangent, kkt)
            if (work >= factorising) call factorise(kkt)
            if (work >= solving .and. .not. kkt%is_singular) call solve(kkt)
         end do
         spent = (processor_seconds() - start)/count
      end subroutine time_work

   end subroutine time_parts

end module ek_increment_parts
