!> What a study varies: one case of a deck, prepared for a sweep.
module ek_subject
   use ek_error, only: error_t, fail, exit_deck, exit_model
   use ek_text, only: quoted
   use ek_deck, only: deck_t
   use ek_reader, only: build_model
   use ek_suspension, only: suspension_t
   use ek_rig, only: mount
   use ek_case, only: case_t
   use ek_case_inputs, only: check_inputs
   use ek_kkt, only: kkt_t, new_kkt
   use ek_balance, only: balance
   use ek_diagnosis, only: diagnosis_t
   use ek_examination, only: examine_case, known_case_t
   implicit none(type, external)
   private
   public :: make_subject

contains

   !> Builds the model of a deck for one case ('': the first case), mounts it on the rig, and examines it.
   !>
   !> A study of many designs passes the same `known` with each: what does not change between designs is then checked once.
   subroutine make_subject(deck, case_name, suspension, case, kkt, error, known)
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: case_name
      type(suspension_t), intent(out) :: suspension
      type(case_t), intent(out) :: case
      type(kkt_t), intent(out) :: kkt
      type(error_t), allocatable, intent(out) :: error
      type(known_case_t), intent(inout), optional :: known
      type(case_t), allocatable :: cases(:)
      type(diagnosis_t) :: diagnosis
      logical :: is_checked
      integer :: k

      call build_model(deck, suspension, cases, error)
      if (allocated(error)) return
      do k = 1, size(cases)
         if (len(case_name) == 0 .or. cases(k)%name == case_name) exit
      end do
      if (k > size(cases)) then
         call fail(error, exit_deck, deck%file//': there is no case '//quoted(case_name))
         return
      end if
      if (cases(k)%follows_arc) then
         call fail(error, exit_deck, deck%file//': case '//quoted(cases(k)%name)//' has follow = ''arc'', where a factor may '// &
            'have several states; a study needs a case with follow = ''factor''')
         return
      end if
      is_checked = .false.
      if (present(known)) is_checked = known%is_known
      if (.not. is_checked) call check_inputs(suspension, cases(k:k), error)
      if (allocated(error)) return
      case = cases(k)
      call examine_case(suspension, case, diagnosis, known)
      if (.not. diagnosis%is_solvable()) then
         call fail(error, exit_model, deck%file//': the model cannot be solved'//new_line('a')//diagnosis%words())
         return
      end if
      call balance(suspension, case%tolerance, error)
      if (allocated(error)) return
      call mount(suspension, case, error)
      if (allocated(error)) return
      kkt = new_kkt(suspension)
   end subroutine make_subject

end module ek_subject
