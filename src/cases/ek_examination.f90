!> Examines the cases of a deck before any solution: whether the model of each case can be solved, and errors in tables, targets
!> and headings of the results.
!>
!> The model is examined before the preload trim (`balance`): a preload found by the trim must not count as a stiffness. The full
!> diagnosis runs once per topology and case. A further design of the same case costs one factorisation, unless that factorisation
!> leaves a doubt (ek_soundness).
module ek_examination
   use ek_error, only: message_list_t, error_t, fail, exit_deck, exit_file
   use ek_text, only: quoted
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable
   use ek_rig, only: mount, mounted_case_t, mount_case, mount_again, lacks_springs
   use ek_state, only: design_state
   use ek_kkt, only: kkt_t
   use ek_diagnosis, only: diagnosis_t, diagnose
   use ek_soundness, only: is_surely_sound
   use ek_sweep_table, only: sweep_columns
   use ek_target, only: find_column
   use ek_table, only: name_length, name_index
   implicit none(type, external)
   private
   public :: spring_hint, examination_t, examine_cases, examine_case, recognise_case, known_case_t, add_distinct, check_inputs

   !> Data from a design of a case that was examined before. One variable serves all designs of a case.
   type :: known_case_t
      logical :: is_known = .false.          !! a design of the case had no defect
      integer :: unknowns = 0, constraints = 0   !! numbers of the examined design
      integer :: negative = 0                !! number of negative eigenvalues of the KKT matrix of the examined design
      integer :: diagnoses = 0               !! number of full diagnoses so far
   end type known_case_t

   !> Findings about each case.
   type :: examination_t
      logical, allocatable :: is_solvable(:)     !! also true for a case that cannot be mounted; the run reports the reason
      type(message_list_t) :: faults             !! one message per case; '' for a case that can be solved
      type(message_list_t) :: distinct           !! messages on defects, each once for all cases
   end type examination_t

contains

   !> Examines all cases. A defect that several cases share is described only in the first of these cases.
   subroutine examine_cases(base, cases, found)
      type(suspension_t), intent(in) :: base       !! before the preload trim (`balance`)
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
         head = 'case '//quoted(cases(k)%name)//': the model cannot be solved'//spring_hint(base, cases(k))
         call add_distinct(found%distinct, words, is_new)
         if (.not. is_new) words = ', for the reason given above'
         if (is_new) words = new_line('a')//words
         call found%faults%add(head//words)
      end do
   end subroutine examine_cases

   !> The hint that a case needs springs: ', as no spring carries the wheels (…)'; '' if they would not help.
   function spring_hint(base, case) result(hint)
      type(suspension_t), intent(in) :: base
      type(case_t), intent(in) :: case
      character(:), allocatable :: hint

      hint = ''
      if (lacks_springs(base, case)) hint = ', as no spring carries the wheels and this case needs forces (tests of travel, '// &
         'roll and steering do not)'
   end function spring_hint

   !> Adds the lines of a string that are not yet in the list. Numbers are ignored in the comparison, because the message on one
   !> defect may differ in the last digit between two drivers.
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
   !> With `known`, the first design is diagnosed in full. A later design is not diagnosed if it is certainly sound and has the same
   !> number of unknowns and rows and the same inertia; `diagnosis` then contains no message and no rank. A case that cannot be
   !> mounted has no defect here: the run reports the reason.
   subroutine examine_case(base, case, diagnosis, known, mounted)
      type(suspension_t), intent(in) :: base       !! before the preload trim (`balance`)
      type(case_t), intent(in) :: case
      type(diagnosis_t), intent(out) :: diagnosis
      type(known_case_t), intent(inout), optional :: known
      type(mounted_case_t), intent(inout), optional, target :: mounted     !! the case on the rig; unchanged if it cannot be mounted
      type(mounted_case_t), allocatable, target :: own
      type(mounted_case_t), pointer :: this
      logical :: is_sound

      if (.not. is_mountable(case)) return
      if (present(mounted)) then
         this => mounted
      else
         allocate (own)
         this => own
      end if
      call mount_case(base, case, this)
      is_sound = .false.
      if (present(known)) call recognise(known, this%suspension, this%kkt, is_sound)
      if (is_sound) return
      call diagnose(this%suspension, design_state(this%suspension), this%kkt, diagnosis)
      if (.not. present(known)) return
      known%diagnoses = known%diagnoses + 1
      if (known%is_known .or. .not. diagnosis%is_solvable()) return
      known%is_known = .true.
      known%unknowns = this%kkt%nq
      known%constraints = this%kkt%nc
      known%negative = diagnosis%negative
   end subroutine examine_case

   !> Puts a later design of a case on the rig, and finds whether the design is certainly sound, as an earlier design was. Otherwise
   !> examine_case must diagnose the design. No string is created.
   subroutine recognise_case(base, case, known, mounted, is_sound)
      type(suspension_t), intent(in) :: base       !! before the preload trim (`balance`)
      type(case_t), intent(in) :: case             !! is_mountable
      type(known_case_t), intent(in) :: known
      type(mounted_case_t), intent(inout) :: mounted       !! an earlier design of this case on the rig, or empty
      logical, intent(out) :: is_sound

      call mount_again(base, case, mounted)
      call recognise(known, mounted%suspension, mounted%kkt, is_sound)
   end subroutine recognise_case

   !> Finds whether a model on the rig is certainly sound, as an earlier design of the same size was.
   subroutine recognise(known, suspension, kkt, is_sound)
      type(known_case_t), intent(in) :: known
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(inout) :: kkt
      logical, intent(out) :: is_sound

      is_sound = .false.
      if (.not. (known%is_known .and. known%unknowns == kkt%nq .and. known%constraints == kkt%nc)) return
      is_sound = is_surely_sound(suspension, design_state(suspension), known%negative, kkt)
      if (is_sound) kkt%is_at_design = kkt%fallbacks == 0      ! for the first state of its path
   end subroutine recognise

   !> A string without digits, signs, decimal points and capital letters E outside of quoted names.
   pure function without_numbers(text) result(rest)
      character(*), intent(in) :: text
      character(:), allocatable :: rest
      logical :: is_quoted
      integer :: k

      rest = ''
      is_quoted = .false.
      do k = 1, len(text)
         if (text(k:k) == '''') is_quoted = .not. is_quoted
         if (is_quoted .or. index('0123456789.+-E', text(k:k)) == 0) rest = rest//text(k:k)
      end do
   end function without_numbers

   !> Checks the inputs of all cases: collects the errors of every table (tables were read with the deck), finds the column of every
   !> target, and compares all headings of the results. All errors are reported together.
   !>
   !> A message on a table gives the line in the file and the line of the case in the deck: `loads.csv:7: column 'fz_n': expected a
   !> number, found 'two'; in case 'bench' (front.nml:41)`. In a deck with other errors, the cases are checked as far as possible.
   subroutine check_inputs(suspension, cases, error, is_whole)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(error_t), allocatable, intent(out) :: error     !! exit_deck; exit_file if only files are at fault
      logical, intent(in), optional :: is_whole            !! the suspension is complete (default); .false.: only tables are checked
      type(message_list_t) :: mistakes
      integer :: k, unread
      logical :: has_model

      has_model = .true.
      if (present(is_whole)) has_model = is_whole
      unread = 0
      if (has_model) call compare_heads(suspension, cases, mistakes)
      do k = 1, size(cases)
         call collect_table(cases, k, mistakes, unread)
         if (has_model) call look_up_target(suspension, cases(k), mistakes)
      end do
      if (mistakes%count() > 0) call fail(error, merge(exit_file, exit_deck, mistakes%count() == unread), mistakes%text())
   end subroutine check_inputs

   !> Collects the errors in the table of case k, and names all cases that use this table. Does nothing if an earlier case uses the
   !> same table.
   subroutine collect_table(cases, k, mistakes, unread)
      type(case_t), intent(in) :: cases(:)
      integer, intent(in) :: k
      type(message_list_t), intent(inout) :: mistakes
      integer, intent(inout) :: unread            !! number of files that cannot be read
      character(:), allocatable :: users
      integer :: j

      if (cases(k)%table%mistakes%count() == 0) return
      users = ''
      do j = 1, size(cases)
         if (cases(j)%file /= cases(k)%file) cycle
         if (j < k) return
         if (users /= '') users = users//', '
         users = users//'in case '//quoted(cases(j)%name)//' ('//cases(j)%where//')'
      end do
      do j = 1, cases(k)%table%mistakes%count()
         call mistakes%add(cases(k)%table%mistakes%line(j)//'; '//users)
      end do
      if (allocated(cases(k)%table%fault)) unread = unread + 1
   end subroutine collect_table

   !> Checks that the results of a case contain the column of its target.
   subroutine look_up_target(suspension, case, mistakes)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(message_list_t), intent(inout) :: mistakes
      type(suspension_t) :: mounted
      type(case_t) :: this
      type(error_t), allocatable :: error
      character(name_length), allocatable :: columns(:)
      integer :: mark, place

      if (.not. allocated(case%target)) return
      mark = index(case%target, '=')
      if (case%target(:max(mark - 1, 0)) == '') return
      if (.not. case%is_good .and. index(adjustl(case%target), 'rig_') == 1) return     ! the case cannot be mounted on the rig
      if (case%is_good .and. .not. is_mountable(case)) return
      if (case%is_good) then
         call mount(suspension, case, mounted, this)
         call sweep_columns(mounted, this, columns)
      else
         call sweep_columns(suspension, case, columns)
      end if
      call find_column(columns, trim(adjustl(case%target(:mark - 1))), place, error)
      if (allocated(error)) call mistakes%add(case%where//': case '//quoted(case%name)//': target: '//error%message)
   end subroutine look_up_target

   !> Rejects two result columns with the same heading. The names of different elements with their suffixes may coincide.
   subroutine compare_heads(suspension, cases, mistakes)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(message_list_t), intent(inout) :: mistakes
      character(name_length), allocatable :: columns(:)
      type(case_t) :: this
      character(:), allocatable :: owners, place
      integer :: k, m

      if (size(cases) == 0) return
      this%has_all = .true.
      call sweep_columns(suspension, this, columns)
      do k = 2, size(columns)
         if (name_index(columns(:k - 1), columns(k)) == 0) cycle
         owners = ''
         place = cases(1)%where(:index(cases(1)%where, ':', back=.true.) - 1)
         do m = 1, suspension%scalars
            call add_owner(suspension%elements(m)%name, suspension%elements(m)%where)
         end do
         do m = 1, size(suspension%readouts)
            call add_owner(suspension%readouts(m)%name, suspension%readouts(m)%where)
         end do
         do m = suspension%scalars + 1, size(suspension%elements)
            call add_owner(suspension%elements(m)%name, suspension%elements(m)%where)
         end do
         do m = 1, size(suspension%joints)
            call add_owner(suspension%joints(m)%name, suspension%joints(m)%where)
         end do
         call mistakes%add(place//': two columns of the results would have the name '//quoted(columns(k))//owners//'; rename one')
      end do

   contains

      !> Adds an element, a readout or a joint to the list of owners if the column name begins with its name.
      subroutine add_owner(name, where)
         character(*), intent(in) :: name, where

         if (index(columns(k), name//'_') /= 1) return
         owners = owners//trim(merge(', of   ', ' and of', owners == ''))//' '//quoted(name)//' ('//where//')'
         place = where
      end subroutine add_owner

   end subroutine compare_heads

end module ek_examination
