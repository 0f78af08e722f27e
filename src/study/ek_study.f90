!> Reads a study from its namelist file, with the scanner and the messages of the deck reader.
!>
!> `&study` defines the study, `&factor` a value of the deck that is varied, `&response` a value read from
!> the results. Kinds: 'step_size' and 'sweep'; a new kind is added as a new file in this folder.
module ek_study
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_deck
   use ek_text, only: str, lower, quoted
   use ek_case, only: method_names, most_increments
   use ek_complaint, only: place_t, place_in
   use ek_record, only: element, place_of
   use ek_group, only: group_number, study_group, factor_group, response_group, record_head, word_length, note_length, &
      most_values, did_you_mean, is_deck_group, names_of_groups, is_legal_name
   use ek_namelist, only: check_record
   use ek_deck, only: deck_t, read_deck
   use ek_draft, only: draft_t, complain, choice, has_key, where_of, line_of
   implicit none(type, external)
   private
   public :: study_t, factor_t, response_t, read_study

   !> A number of the deck that takes several values.
   type :: factor_t
      character(:), allocatable :: name, path     !! path as in --set
      real(wp), allocatable :: values(:)          !! in the deck's units
      character(:), allocatable :: where          !! 'file:line', for messages
   end type factor_t

   !> A number read from the table of a run.
   type :: response_t
      character(:), allocatable :: name, column
      character(:), allocatable :: of             !! 'value', 'slope' or 'span'
      real(wp) :: at = 0.0_wp                     !! factor of the case, for value and slope
      character(:), allocatable :: over           !! column over which the slope is taken; '': the travel of the wheel
      real(wp) :: window = 15.0_wp                !! half width of the slope's window, unit of `over`
      character(:), allocatable :: where          !! 'file:line', for messages
   end type response_t

   !> A study.
   type :: study_t
      character(:), allocatable :: name, title, kind, deck, case, plot
      character(:), allocatable :: end            !! step_size: the end of the case to be compared, 'from' or 'to'
      character(word_length), allocatable :: methods(:), columns(:)
      integer, allocatable :: increments(:)
      type(factor_t), allocatable :: factors(:)
      type(response_t), allocatable :: responses(:)
      character(:), allocatable :: where          !! 'file:line' of the &study, for messages
   end type study_t

   integer, parameter :: unset = -huge(1)
   real(wp), parameter :: unset_number = -huge(1.0_wp)

contains

   !> Reads a study file; all its mistakes are reported in one error.
   subroutine read_study(path, study, error)
      character(*), intent(in) :: path
      type(study_t), intent(out) :: study
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: file
      type(draft_t) :: draft
      type(place_t) :: place
      integer :: k, studies

      call read_deck(path, file, error, is_study=.true.)
      if (allocated(error)) return
      if (file%used == 0 .or. is_deck(file)) then
         if (file%used == 0) then
            call fail(error, exit_deck, file%complaints%text())
         else
            call fail(error, exit_deck, where_of(file, 1)//': this is a deck (&'//file%records(1)%group// &
               '), not a study; use it with: elastokin run, check or report '//file%file// &
               '. A study is a file with a &study, which names its deck')
         end if
         return
      end if
      draft%complaints = file%complaints
      allocate (draft%cards(file%used))
      allocate (study%factors(0), study%responses(0))
      studies = 0
      do k = 1, file%used
         associate (card => draft%cards(k), record => file%records(k))
            card%group = group_number(record%group)
            if (card%group == 0 .or. is_deck_group(card%group)) then
               call place_of(record, 0, place)
               call draft%complaints%add(place, 'there is no group &'//record%group//' in a study'// &
                  did_you_mean(record%group, names_of_groups(of_deck=.false.)))
               card%group = 0
               cycle
            end if
            card%name = element(record, 'name', 1)
            call check_record(record, card%group, record_head(card%group, trim(card%name)), draft%complaints, &
               card%text, card%is_good)
         end associate
         call check_name(file, draft, k)
         select case (draft%cards(k)%group)
         case (study_group)
            studies = studies + 1
            if (studies > 1) call complain(draft, file, k, '', 'a second &study; a file may hold only one')
            call take_study(file, draft, k, study)
         case (factor_group)
            call take_factor(file, draft, k, study)
         case (response_group)
            call take_response(file, draft, k, study)
         end select
      end do
      if (studies == 0) then
         call place_in(file%file, 0, 0, place)
         call draft%complaints%add(place, 'there is no &study')
      end if
      if (studies == 1 .and. draft%complaints%count() == 0) call check_whole(file, draft, study)
      if (draft%complaints%count() > 0) call fail(error, exit_deck, draft%complaints%text())
   end subroutine read_study

   !> Whether a file contains groups of a deck and none of a study.
   pure logical function is_deck(file)
      type(deck_t), intent(in) :: file
      integer :: k, group

      is_deck = .false.
      do k = 1, file%used
         group = group_number(file%records(k)%group)
         if (group > 0 .and. .not. is_deck_group(group)) then
            is_deck = .false.
            return
         end if
         is_deck = is_deck .or. group > 0
      end do
   end function is_deck

   !> Checks a name, which appears in paths and must be unique among the column names.
   subroutine check_name(file, draft, k)
      type(deck_t), intent(in) :: file
      type(draft_t), intent(inout) :: draft
      integer, intent(in) :: k
      character(*), parameter :: heads(3) = [character(9) :: 'design', 'factor', 'converged']   !! always present
      integer :: j

      associate (card => draft%cards(k))
         if (card%name == '') return
         if (.not. is_legal_name(trim(card%name))) then
            call complain(draft, file, k, 'name', 'a name must begin with a letter and contain only letters, digits and _')
         end if
         if (card%group == study_group) return
         if (any(heads == lower(card%name))) &
            call complain(draft, file, k, 'name', 'the name is reserved for a column of the results')
         do j = 1, k - 1
            if (draft%cards(j)%group /= factor_group .and. draft%cards(j)%group /= response_group) cycle
            if (draft%cards(j)%name == card%name) call complain(draft, file, k, 'name', 'the name is given twice, first in '// &
               line_of(file, j, k))
         end do
      end associate
   end subroutine check_name

   !> &study
   subroutine take_study(file, draft, k, study)
      type(deck_t), intent(in) :: file
      type(draft_t), intent(inout) :: draft
      integer, intent(in) :: k
      type(study_t), intent(inout) :: study
      character(note_length) :: title, deck, plot
      character(word_length) :: name, kind, case, end, methods(3), columns(20)
      character(:), allocatable :: text
      integer :: increments(most_values), status, c, m
      namelist /study_nml/ name, title, kind, deck, case, plot, end, methods, columns, increments

      name = ''
      title = ''
      kind = ''
      deck = ''
      case = ''
      plot = 'plot.gp'
      end = 'to'
      methods = ''
      columns = ''
      increments = unset
      ! the namelist cannot be called `study`, which is the dummy argument
      text = '&study_nml'//draft%cards(k)%text(len('&study') + 1:)
      read (text, nml=study_nml, iostat=status)
      if (status /= 0) call complain(draft, file, k, '', 'cannot be read')
      call choice(draft, file, k, 'kind', trim(kind), [character(9) :: 'step_size', 'sweep'], c)
      call choice(draft, file, k, 'end', trim(end), [character(4) :: 'from', 'to'], c)
      do m = 1, 3
         call choice(draft, file, k, 'methods', trim(methods(m)), method_names, c)
      end do
      if (all(methods == '')) methods = method_names
      study%name = trim(name)
      study%title = trim(title)
      study%kind = lower(trim(kind))
      study%deck = trim(deck)
      study%case = trim(case)
      study%plot = trim(plot)
      study%end = lower(trim(end))
      study%methods = pack(methods, methods /= '')
      study%columns = pack(columns, columns /= '')
      study%increments = pack(increments, increments /= unset)
      if (any(study%increments < 1 .or. study%increments > most_increments)) call complain(draft, file, k, 'increments', &
         'increments must be 1 to '//str(most_increments))
      do c = 2, size(study%columns)
         if (any(study%columns(:c - 1) == study%columns(c))) call complain(draft, file, k, 'columns', &
            'columns: '//quoted(study%columns(c))//' is named twice')
      end do
      study%where = where_of(file, k)
   end subroutine take_study

   !> &factor: values given one by one, or from, to, count and spacing.
   subroutine take_factor(file, draft, k, study)
      type(deck_t), intent(in) :: file
      type(draft_t), intent(inout) :: draft
      integer, intent(in) :: k
      type(study_t), intent(inout) :: study
      character(note_length) :: path
      character(word_length) :: name, spacing
      real(wp) :: values(most_values), from, to
      integer :: count, status, c, j
      namelist /factor/ name, path, values, from, to, count, spacing
      type(factor_t) :: this

      name = ''
      path = ''
      spacing = 'linear'
      values = unset_number
      from = 0.0_wp
      to = 0.0_wp
      count = unset
      read (draft%cards(k)%text, nml=factor, iostat=status)
      if (status /= 0) call complain(draft, file, k, '', 'cannot be read')
      call choice(draft, file, k, 'spacing', trim(spacing), [character(6) :: 'linear', 'log'], c)
      this%name = trim(name)
      this%path = trim(path)
      if (has_key(file, k, 'values')) then
         this%values = pack(values, values > unset_number)
         if (has_key(file, k, 'count') .or. has_key(file, k, 'from') .or. has_key(file, k, 'to')) &
            call complain(draft, file, k, 'values', 'give values, or from, to and count, not both')
      else if (has_key(file, k, 'count') .and. has_key(file, k, 'from') .and. has_key(file, k, 'to')) then
         if (count < 2 .or. count > most_values) then
            call complain(draft, file, k, 'count', 'count must be 2 to 200')
            return
         end if
         if (lower(spacing) == 'log') then
            if (.not. (from > 0.0_wp .and. to > 0.0_wp)) then
               call complain(draft, file, k, 'spacing', 'spacing = ''log'' needs from and to above 0')
               return
            end if
            this%values = [(from*(to/from)**(real(j, wp)/(count - 1)), j=0, count - 1)]
         else
            this%values = [(from + (to - from)*real(j, wp)/(count - 1), j=0, count - 1)]
         end if
      else
         call complain(draft, file, k, '', 'needs values, or from, to and count')
         return
      end if
      this%where = where_of(file, k)
      study%factors = [study%factors, this]
   end subroutine take_factor

   !> &response
   subroutine take_response(file, draft, k, study)
      type(deck_t), intent(in) :: file
      type(draft_t), intent(inout) :: draft
      integer, intent(in) :: k
      type(study_t), intent(inout) :: study
      character(word_length) :: name, column, of, over
      real(wp) :: at, window
      integer :: status, c
      namelist /response/ name, column, of, over, at, window
      type(response_t) :: this

      name = ''
      column = ''
      of = 'value'
      over = ''
      at = 0.0_wp
      window = 15.0_wp
      read (draft%cards(k)%text, nml=response, iostat=status)
      if (status /= 0) call complain(draft, file, k, '', 'cannot be read')
      call choice(draft, file, k, 'of', trim(of), [character(5) :: 'value', 'slope', 'span'], c)
      if (.not. window > 0.0_wp) call complain(draft, file, k, 'window', 'window must be above 0')
      this%name = trim(name)
      this%column = trim(column)
      this%of = lower(trim(of))
      this%over = trim(over)
      this%at = at
      this%window = window
      this%where = where_of(file, k)
      study%responses = [study%responses, this]
   end subroutine take_response

   !> Checks that the parts of a study are consistent.
   subroutine check_whole(file, draft, study)
      type(deck_t), intent(in) :: file
      type(draft_t), intent(inout) :: draft
      type(study_t), intent(in) :: study
      integer :: k

      do k = 1, file%used
         if (draft%cards(k)%group == study_group) exit
      end do
      if (study%kind == 'step_size') then
         if (size(study%increments) == 0) call complain(draft, file, k, '', 'kind = ''step_size'' needs increments = …')
      else if (size(study%factors) < 1 .or. size(study%factors) > 2) then
         call complain(draft, file, k, '', 'kind = ''sweep'' needs one or two &factor groups')
      end if
   end subroutine check_whole

end module ek_study
