!> Plausibility of a deck as a road vehicle: wrong units, swapped points, wrong bodies, a coil in tension, a motion that only
!> preload resists. Findings are remarks, never errors; none with `plausible = .false.` in &model.
module ek_plausibility
   use ek_error, only: message_list_t
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_state, only: design_state
   use ek_kkt, only: kkt_t, new_kkt
   use ek_diagnosis, only: diagnosis_t, diagnose
   use ek_plausible_range, only: doubts_t
   use ek_plausible_parts, only: doubt_elements, doubt_loads, doubt_vehicle, doubt_cases
   use ek_plausible_shape, only: doubt_wheels, doubt_points
   use ek_plausible_links, only: doubt_links
   implicit none(type, external)
   private
   public :: doubt

contains

   !> One remark per implausible item, `file:line: item: finding`.
   !>
   !> In a model without a wheel, which is no suspension, only the elements are checked.
   subroutine doubt(suspension, cases, remarks)
      type(suspension_t), intent(in) :: suspension       !! balanced if possible; not on a rig
      type(case_t), intent(in) :: cases(:)               !! of the deck
      type(message_list_t), intent(out) :: remarks
      type(doubts_t) :: doubts
      type(diagnosis_t) :: diagnosis
      type(kkt_t) :: kkt
      integer :: k

      if (.not. suspension%is_plausible_wanted) return
      doubts%units = suspension%units
      call doubt_wheels(suspension, doubts)
      call doubt_points(suspension, doubts)
      call doubt_links(suspension, doubts)
      call doubt_elements(suspension, doubts)
      call doubt_vehicle(suspension, doubts)
      call doubt_loads(suspension, doubts)
      call doubt_cases(suspension, cases, doubts)
      kkt = new_kkt(suspension)
      call diagnose(suspension, design_state(suspension), kkt, diagnosis, wants_preload_held=.true.)
      do k = 1, diagnosis%preload_held%count()
         call doubts%add('', diagnosis%preload_held%line(k), diagnosis%preload_held%line(k))
      end do
      do k = 1, diagnosis%warnings%count()
         if (index(diagnosis%warnings%line(k), 'very soft') == 1) &
            call doubts%add('', diagnosis%warnings%line(k), diagnosis%warnings%line(k))
      end do
      remarks = doubts%remarks
   end subroutine doubt

end module ek_plausibility
