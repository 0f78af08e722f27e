!> Examines whether the cases of a deck can be solved: the diagnosis made first in every command.
!>
!> The model is examined as given in the deck, before balance: a preload found by balance must not count as a stiffness.
!> The full diagnosis is made once per topology and case; a further design of the same case costs one factorisation, unless that
!> leaves a doubt (ek_soundness).
module ek_examination
   use ek_error, only: message_list_t
   use ek_text, only: quoted
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable
   use ek_rig, only: mount
   use ek_state, only: design_state
   use ek_kkt, only: kkt_t, new_kkt
   use ek_diagnosis, only: diagnosis_t, diagnose
   use ek_soundness, only: is_surely_sound
   implicit none(type, external)
   private
   public :: examination_t, examine_cases, examine_case, known_case_t, add_distinct

   !> What is known of a case from a design that was examined before; one value for all designs of a case.
   type :: known_case_t
      logical :: is_known = .false.          !! a design of the case had no defect
      integer :: unknowns = 0, constraints = 0   !! of that design
      integer :: negative = 0                !! its inertia: negative eigenvalues of the KKT matrix at design
      integer :: diagnoses = 0               !! full diagnoses so far
   end type known_case_t

   !> Findings about each case.
   type :: examination_t
      logical, allocatable :: is_solvable(:)     !! true also if a case cannot be mounted: that is reported when it is run
      type(message_list_t) :: faults             !! one per case, '' if it can be solved
      type(message_list_t) :: distinct           !! defects, each once for all cases
   contains
      procedure :: none_solvable
   end type examination_t

contains

   !> Whether no case can be solved.
   pure logical function none_solvable(self)
      class(examination_t), intent(in) :: self
      none_solvable = size(self%is_solvable) > 0 .and. .not. any(self%is_solvable)
   end function none_solvable

   !> Examines all cases. A defect of several cases is described in the first of them only.
   subroutine examine_cases(base, cases, found)
      type(suspension_t), intent(in) :: base       !! not balanced
      type(case_t), intent(in) :: cases(:)
      type(examination_t), intent(out) :: found
      type(diagnosis_t) :: diagnosis
      character(:), allocatable :: words, head
      logical :: is_new
      integer :: k

      allocate (found%is_solvable(size(cases)))
      do k = 1, size(cases)
         call examine_case(base, cases(k), diagnosis)
         found%is_solvable(k) = diagnosis%is_solvable()
         if (found%is_solvable(k)) then
            call found%faults%add('')
            cycle
         end if
         words = diagnosis%words()
         head = 'case '//quoted(cases(k)%name)//': the model cannot be solved'
         call add_distinct(found%distinct, words, is_new)
         if (.not. is_new) words = ', for the reason given above'
         if (is_new) words = new_line('a')//words
         call found%faults%add(head//words)
      end do
   end subroutine examine_cases

   !> Adds the lines of a text that are not in the list yet; the message on one defect may differ in the last digit between two
   !> drives.
   subroutine add_distinct(distinct, words, is_new)
      type(message_list_t), intent(inout) :: distinct
      character(*), intent(in) :: words
      logical, intent(out), optional :: is_new       !! whether a line was added
      integer :: first, last, j

      if (present(is_new)) is_new = .false.
      first = 1
      do while (first <= len(words))
         last = first + index(words(first:)//new_line('a'), new_line('a')) - 2
         do j = 1, distinct%count()
            if (without_numbers(distinct%line(j)) == without_numbers(words(first:last))) exit
         end do
         if (j > distinct%count()) then
            call distinct%add(words(first:last))
            if (present(is_new)) is_new = .true.
         end if
         first = last + 2
      end do
   end subroutine add_distinct

   !> Diagnoses the model on the rig of a case, at design.
   !>
   !> With `known`, the first design is diagnosed in full. A later one that is certainly sound, with the same number of unknowns and
   !> rows and the same inertia, is not: `diagnosis` then contains no message and no rank. A case that cannot be mounted
   !> has no defect here: the run reports the reason.
   subroutine examine_case(base, case, diagnosis, known, on_rig, is_in_doubt)
      type(suspension_t), intent(in) :: base       !! not balanced
      type(case_t), intent(in) :: case
      type(diagnosis_t), intent(out) :: diagnosis
      type(known_case_t), intent(inout), optional :: known
      type(case_t), intent(out), optional :: on_rig      !! the case with its actuations
      logical, intent(out), optional :: is_in_doubt      !! if present, a doubtful design is not diagnosed, which takes text
      type(suspension_t) :: suspension
      type(case_t) :: mounted
      type(kkt_t) :: kkt

      if (present(is_in_doubt)) is_in_doubt = .false.
      if (.not. is_mountable(case)) return
      call mount(base, case, suspension, mounted)
      if (present(on_rig)) on_rig = mounted
      kkt = new_kkt(suspension)
      if (present(known)) then
         if (known%is_known .and. known%unknowns == kkt%nq .and. known%constraints == kkt%nc) then
            if (is_surely_sound(suspension, design_state(suspension), known%negative, kkt)) return
         end if
      end if
      if (present(is_in_doubt)) then
         is_in_doubt = .true.
         return
      end if
      call diagnose(suspension, design_state(suspension), kkt, diagnosis)
      if (.not. present(known)) return
      known%diagnoses = known%diagnoses + 1
      if (known%is_known .or. .not. diagnosis%is_solvable()) return
      known%is_known = .true.
      known%unknowns = kkt%nq
      known%constraints = kkt%nc
      known%negative = diagnosis%negative
   end subroutine examine_case

   !> A text without its digits, signs and points.
   pure function without_numbers(text) result(rest)
      character(*), intent(in) :: text
      character(:), allocatable :: rest
      integer :: k

      rest = ''
      do k = 1, len(text)
         if (index('0123456789.+-E', text(k:k)) == 0) rest = rest//text(k:k)
      end do
   end function without_numbers

end module ek_examination
