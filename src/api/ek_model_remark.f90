!> Messages on a model before its cases are solved. The commands print these messages, and a program that calls elastokin reads them
!> (ek_session).
module ek_model_remark
   use ek_error, only: message_list_t
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_balance, only: balance_remarks
   use ek_load_state, only: load_state_remarks
   use ek_plausibility, only: doubt
   use ek_remark, only: patch_remarks, spring_remarks, half_turn_remarks, preload_remarks
   implicit none(type, external)
   private
   public :: model_remarks_t, find_model_remarks, read_model_remark, doubt_mark

   character(*), parameter :: doubt_mark = 'plausible? '      !! start of a message on an implausible value

   !> The messages on a model. The commands print notes, warnings and implausible values in this order.
   type :: model_remarks_t
      type(message_list_t) :: notes        !! preloads found by the preload trim (`balance`)
      type(message_list_t) :: warnings     !! contact points, missing springs, excluded drivers, preloads that are not unique
      type(message_list_t) :: doubts       !! implausible values: file:line: item: finding
      type(message_list_t) :: faults       !! reasons why no case can be solved; these errors end a command
   contains
      procedure :: count => count_remarks
   end type model_remarks_t

contains

   !> Finds the messages on a model, except the failures. Only one thread at a time may call this procedure.
   subroutine find_model_remarks(suspension, raw, cases, chosen, is_balanced, remarks, tests)
      type(suspension_t), intent(in) :: suspension      !! with trimmed preloads if possible; on no rig
      type(suspension_t), intent(in) :: raw             !! before the trim
      type(case_t), intent(in) :: cases(:), chosen(:)   !! all cases of the deck; cases to be run
      logical, intent(in) :: is_balanced                !! .false.: no messages on the preload trim
      type(model_remarks_t), intent(out) :: remarks
      type(case_t), intent(in), optional :: tests(:)    !! cases whose load states are compared; absent: `chosen`

      if (is_balanced) call preload_remarks(suspension, remarks%notes)
      call patch_remarks(suspension, remarks%warnings)
      call spring_remarks(suspension, chosen, remarks%warnings, cases)
      call half_turn_remarks(suspension, chosen, remarks%warnings)
      if (is_balanced) then
         call balance_remarks(suspension, remarks%warnings)
         if (present(tests)) call load_state_remarks(suspension, tests, remarks%warnings)
         if (.not. present(tests)) call load_state_remarks(suspension, chosen, remarks%warnings)
      end if
      call doubt(suspension, cases, remarks%doubts, raw)
   end subroutine find_model_remarks

   pure integer function count_remarks(self)
      class(model_remarks_t), intent(in) :: self
      count_remarks = self%faults%count() + self%notes%count() + self%warnings%count() + self%doubts%count()
   end function count_remarks

   !> Reads message k: its string, and its severity 'failure', 'note' or 'warning'. The failures come first, then the notes, the
   !> warnings and the implausible values, which have the severity 'warning'. Both are '' if there is no message k.
   subroutine read_model_remark(remarks, k, text, severity)
      type(model_remarks_t), intent(in) :: remarks
      integer, intent(in) :: k
      character(:), allocatable, intent(out) :: text, severity
      integer :: place

      text = ''
      severity = ''
      if (k < 1 .or. k > remarks%count()) return
      severity = 'failure'
      place = k
      if (place <= remarks%faults%count()) then
         text = remarks%faults%line(place)
         return
      end if
      place = place - remarks%faults%count()
      severity = 'note'
      if (place <= remarks%notes%count()) then
         text = remarks%notes%line(place)
         return
      end if
      place = place - remarks%notes%count()
      severity = 'warning'
      if (place <= remarks%warnings%count()) then
         text = remarks%warnings%line(place)
      else
         text = doubt_mark//remarks%doubts%line(place - remarks%warnings%count())
      end if
   end subroutine read_model_remark

end module ek_model_remark
