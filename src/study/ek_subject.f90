!> What a study varies: the design space of a deck and one case of it. The first design is read from the text; the others are
!> numbers (realise), and only a design outside the range of the blueprint is read again, for the message or another topology.
module ek_subject
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_deck, exit_model
   use ek_text, only: quoted
   use ek_deck, only: deck_t
   use ek_reader, only: design_t, read_design
   use ek_parameter, only: choice_t, put_value, in_range
   use ek_realise, only: new_design, realise, realise_cases
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_balance, only: balance
   use ek_diagnosis, only: diagnosis_t
   use ek_sweep_table, only: observer_t
   use ek_examination, only: check_inputs, examine_case, known_case_t
   implicit none(type, external)
   private
   public :: subject_t, factor_paths_t, make_subject, change_subject

   !> The parameters of one factor.
   type :: factor_paths_t
      type(choice_t), allocatable :: found(:)
   end type factor_paths_t

   !> One design after the other of a deck.
   type :: subject_t
      type(suspension_t) :: suspension     !! of the present design, balanced
      type(case_t) :: case                 !! of the present design, as in the deck
      type(design_t) :: design
      integer :: number = 0                !! of the case in the deck
      type(known_case_t) :: known          !! what the first design has proved about the others
      type(observer_t), allocatable :: observer   !! of the columns of its results, for solve_case
      real(wp), allocatable :: x(:)        !! work space
   end type subject_t

contains

   !> Builds the model of a deck for one case ('': the first case), examines it on the rig, and balances it.
   !>
   !> A study of many designs passes the same one with each: what does not change between designs is then checked once.
   subroutine make_subject(deck, case_name, subject, error)
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: case_name
      type(subject_t), intent(inout) :: subject
      type(error_t), allocatable, intent(out) :: error
      logical :: is_good
      integer :: k

      if (allocated(subject%observer)) deallocate (subject%observer)
      allocate (subject%observer)
      call read_design(deck, subject%design, error)
      if (allocated(error)) return
      call new_design(subject%design%plan, subject%suspension)
      call realise(subject%design%plan, subject%design%parameters%x, subject%suspension, is_good)
      associate (cases => subject%design%cases)
         do k = 1, size(cases)
            if (len(case_name) == 0 .or. cases(k)%name == case_name) exit
         end do
         if (k > size(cases)) then
            call fail(error, exit_deck, deck%file//': there is no case '//quoted(case_name))
            return
         end if
         if (cases(k)%follows_arc) then
            call fail(error, exit_deck, deck%file//': case '//quoted(cases(k)%name)//' has follow = ''arc'', where a factor '// &
               'may have several states; a study needs a case with follow = ''factor''')
            return
         end if
         call check_inputs(subject%suspension, cases(k:k), error, is_whole=.not. subject%known%is_known)
         if (allocated(error)) return
         subject%number = k
         subject%case = cases(k)
      end associate
      call prepare(deck%file, subject, error)
   end subroutine make_subject

   !> The design with these values of the factors, from the numbers alone; is_done is .false. if it must be read from the text.
   subroutine change_subject(file, factors, values, subject, is_done, error)
      character(*), intent(in) :: file                     !! the deck, for messages
      type(factor_paths_t), intent(in) :: factors(:)
      real(wp), intent(in) :: values(:)                    !! in the units of the deck
      type(subject_t), intent(inout) :: subject
      logical, intent(out) :: is_done
      type(error_t), allocatable, intent(out) :: error
      integer :: f

      subject%x = subject%design%parameters%x
      is_done = .true.
      do f = 1, size(factors)
         call put_value(subject%design%parameters, factors(f)%found, values(f), subject%x)
         is_done = is_done .and. size(factors(f)%found) > 0 .and. &
            in_range(subject%design%parameters, factors(f)%found, subject%x)
      end do
      if (is_done) call realise(subject%design%plan, subject%x, subject%suspension, is_done)
      if (is_done) call realise_cases(subject%design%plan, subject%x, subject%design%cases, is_done)
      if (.not. is_done) return
      subject%case = subject%design%cases(subject%number)
      call prepare(file, subject, error)
   end subroutine change_subject

   !> Examines the present design on the rig and balances it.
   subroutine prepare(file, subject, error)
      character(*), intent(in) :: file
      type(subject_t), intent(inout) :: subject
      type(error_t), allocatable, intent(out) :: error
      type(diagnosis_t) :: diagnosis

      call examine_case(subject%suspension, subject%case, diagnosis, subject%known)
      if (diagnosis%is_solvable()) then
         call balance(subject%suspension, subject%case%tolerance, error)
      else
         call fail(error, exit_model, file//': the model cannot be solved'//new_line('a')//diagnosis%words())
      end if
   end subroutine prepare

end module ek_subject
