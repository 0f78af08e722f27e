!> Time of the loads on all parts in the manoeuvres of a deck.
module ek_bench_loads
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_kkt, only: kkt_t, assemble, residual_only
   use ek_path, only: path_t, sweep
   use ek_manoeuvre, only: has_manoeuvres
   use ek_part_loads, only: part_load_t, part_loads
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_increment_parts, only: processor_seconds
   implicit none(type, external)
   private
   public :: time_loads

   integer, parameter :: rounds = 10         !! rounds of the measurement; the minimum counts

contains

   !> Times the solution of all manoeuvres of a case and the list of the loads on all parts in each of them [s]. 0 for other cases.
   subroutine time_loads(suspension, case, kkt, time)
      type(suspension_t), intent(in) :: suspension      !! on the rig
      type(case_t), intent(in) :: case
      type(kkt_t), intent(inout) :: kkt                 !! work space
      real(wp), intent(out) :: time
      type(path_t) :: path
      type(state_t) :: state
      type(schedule_t) :: schedule
      type(inputs_t) :: inputs
      type(part_load_t), allocatable :: loads(:)
      real(wp) :: start
      integer :: k, s

      time = 0.0_wp
      if (.not. has_manoeuvres(case)) return
      time = huge(time)
      state = design_state(suspension)
      do k = 1, rounds
         start = processor_seconds()
         call sweep(suspension, case, path, kkt)
         schedule = new_schedule(suspension, case)
         do s = 1, path%states
            call unpack_state(path%packed(:, s), state)
            call inputs_at(schedule, path%value(s), inputs)
            call assemble(suspension, state, inputs, residual_only, kkt)
            call part_loads(suspension, state, kkt, loads)
         end do
         time = min(time, processor_seconds() - start)
      end do
   end subroutine time_loads

end module ek_bench_loads
