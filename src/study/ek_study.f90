!> Reads a study from its namelist file, with the scanner and the messages of the deck reader.
!>
!> `&study` defines the study, `&factor` a value of the deck that is varied, `&response` a value read from
!> the results. The kinds of studies are those of ek_sampler.
module ek_study
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_deck
   use ek_text, only: str, lower, quoted
   use ek_case, only: method_names, max_increments
   use ek_sampler, only: factor_t, kind_t, kinds
   use ek_record, only: element, place_of
   use ek_group, only: group_number, study_group, factor_group, response_group, record_head, word_length, max_values, &
      did_you_mean, is_deck_group, names_of_groups
   use ek_namelist, only: check_record, is_legal_name
   use ek_deck, only: deck_t, read_deck
   use ek_deck_reading, only: deck_reading_t, complain, complain_of_all, choice, choose, has_key, where_of, line_of, text_of, &
      texts_of, number_of, numbers_of, whole_of, value_count
   implicit none(type, external)
   private
   public :: study_t, response_t, read_study

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

contains

   !> Reads a study file; all its mistakes are reported in one error.
   subroutine read_study(path, study, error)
      character(*), intent(in) :: path
      type(study_t), intent(out) :: study
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: file
      type(deck_reading_t) :: reading
      integer :: k, studies

      call read_deck(path, file, error, is_study=.true.)
      if (allocated(error)) return
      reading%file = file%file
      reading%records = file%records(:file%used)
      reading%deck_errors = file%deck_errors
      reading%k = 1
      if (file%used == 0) then
         call fail(error, exit_deck, file%deck_errors%text())
         return
      else if (is_deck(file)) then
         call fail(error, exit_deck, where_of(reading)//': this is a deck (&'//file%records(1)%group// &
            '), not a study; use it with: elastokin run, check or report '//file%file// &
            '. A study is a file with a &study, which names its deck')
         return
      end if
      allocate (reading%cards(file%used))
      allocate (study%factors(0), study%responses(0))
      studies = 0
      do k = 1, file%used
         reading%k = k
         associate (card => reading%cards(k), record => reading%records(k))
            card%group = group_number(record%group)
            if (card%group == 0 .or. is_deck_group(card%group)) then
               call reading%deck_errors%add(place_of(record, 0), 'there is no group &'//record%group//' in a study'// &
                  did_you_mean(record%group, names_of_groups(of_deck=.false.)))
               card%group = 0
               cycle
            end if
            card%name = element(record, 'name', 1)
            call check_record(record, card%group, record_head(card%group, trim(card%name)), reading%deck_errors, card%is_good)
         end associate
         call check_name(reading)
         select case (reading%cards(k)%group)
         case (study_group)
            studies = studies + 1
            if (studies > 1) call complain(reading, '', 'a second &study; a file may hold only one')
            call take_study(reading, study)
         case (factor_group)
            call take_factor(reading, study)
         case (response_group)
            call take_response(reading, study)
         end select
      end do
      if (studies == 0) call complain_of_all(reading, 'there is no &study')
      if (studies == 1 .and. reading%deck_errors%count() == 0) call check_whole(reading, study)
      if (reading%deck_errors%count() > 0) call fail(error, exit_deck, reading%deck_errors%text())
   end subroutine read_study

   !> Whether a file contains groups of a deck and none of a study.
   pure logical function is_deck(file)
      type(deck_t), intent(in) :: file
      integer :: groups(file%used), k

      groups = [(group_number(file%records(k)%group), k=1, file%used)]
      is_deck = any(groups > 0) .and. all([(groups(k) == 0 .or. is_deck_group(groups(k)), k=1, file%used)])
   end function is_deck

   !> Checks a name, which appears in paths and must be unique among the column names.
   subroutine check_name(reading)
      type(deck_reading_t), intent(inout) :: reading
      character(*), parameter :: heads(3) = [character(9) :: 'design', 'factor', 'converged']   !! always present
      integer :: j

      associate (card => reading%cards(reading%k))
         if (card%name == '') return
         if (.not. is_legal_name(trim(card%name))) then
            call complain(reading, 'name', 'a name must begin with a letter and contain only letters, digits and _')
         end if
         if (card%group == study_group) return
         if (any(heads == lower(card%name))) &
            call complain(reading, 'name', 'the name is reserved for a column of the results')
         do j = 1, reading%k - 1
            if (reading%cards(j)%group /= factor_group .and. reading%cards(j)%group /= response_group) cycle
            if (reading%cards(j)%name == card%name) call complain(reading, 'name', 'the name is given twice, first in '// &
               line_of(reading, j))
         end do
      end associate
   end subroutine check_name

   !> &study
   subroutine take_study(reading, study)
      type(deck_reading_t), intent(inout) :: reading
      type(study_t), intent(inout) :: study
      character(word_length) :: words(20)
      integer :: c, m

      call choice(reading, 'kind', kinds%name, c)
      study%kind = lower(text_of(reading, 'kind'))
      call choice(reading, 'end', [character(4) :: 'from', 'to'], c)
      study%end = lower(text_of(reading, 'end', 'to'))
      words = texts_of(reading, 'methods', 20)
      study%methods = pack(words, words /= '')
      do m = 1, size(study%methods)
         call choose(reading, 'methods', trim(study%methods(m)), method_names, c)
      end do
      if (size(study%methods) == 0) study%methods = method_names
      study%name = text_of(reading, 'name')
      study%title = text_of(reading, 'title')
      study%deck = text_of(reading, 'deck')
      study%case = text_of(reading, 'case')
      study%plot = text_of(reading, 'plot', 'plot.gp')
      words = texts_of(reading, 'columns', 20)
      study%columns = pack(words, words /= '')
      study%increments = [(whole_of(reading, 'increments', 0, m), m=1, value_count(reading, 'increments'))]
      if (any(study%increments < 1 .or. study%increments > max_increments)) call complain(reading, 'increments', &
         'increments must be 1 to '//str(max_increments))
      do c = 2, size(study%columns)
         if (any(study%columns(:c - 1) == study%columns(c))) call complain(reading, 'columns', &
            'columns: '//quoted(study%columns(c))//' is named twice')
      end do
      study%where = where_of(reading)
   end subroutine take_study

   !> &factor: values given one by one, or from, to, count and spacing.
   subroutine take_factor(reading, study)
      type(deck_reading_t), intent(inout) :: reading
      type(study_t), intent(inout) :: study
      type(factor_t) :: this
      real(wp) :: from, to
      integer :: count, c, j

      call choice(reading, 'spacing', [character(6) :: 'linear', 'log'], c, default=1)
      this%name = text_of(reading, 'name')
      this%path = text_of(reading, 'path')
      if (has_key(reading, 'values')) then
         this%values = numbers_of(reading, 'values', value_count(reading, 'values'))
         if (has_key(reading, 'count') .or. has_key(reading, 'from') .or. has_key(reading, 'to')) &
            call complain(reading, 'values', 'give values, or from, to and count, not both')
      else if (has_key(reading, 'count') .and. has_key(reading, 'from') .and. has_key(reading, 'to')) then
         count = whole_of(reading, 'count', 2)
         from = number_of(reading, 'from', 0.0_wp)
         to = number_of(reading, 'to', 0.0_wp)
         if (count < 2 .or. count > max_values) then
            call complain(reading, 'count', 'count must be 2 to 200')
            return
         end if
         if (c == 2) then
            if (.not. (from > 0.0_wp .and. to > 0.0_wp)) then
               call complain(reading, 'spacing', 'spacing = ''log'' needs from and to above 0')
               return
            end if
            this%values = [(from*(to/from)**(real(j, wp)/(count - 1)), j=0, count - 1)]
         else
            this%values = [(from + (to - from)*real(j, wp)/(count - 1), j=0, count - 1)]
         end if
      else
         call complain(reading, '', 'needs values, or from, to and count')
         return
      end if
      this%where = where_of(reading)
      study%factors = [study%factors, this]
   end subroutine take_factor

   !> &response
   subroutine take_response(reading, study)
      type(deck_reading_t), intent(inout) :: reading
      type(study_t), intent(inout) :: study
      type(response_t) :: this
      integer :: c

      call choice(reading, 'of', [character(5) :: 'value', 'slope', 'span'], c)
      this%name = text_of(reading, 'name')
      this%column = text_of(reading, 'column')
      this%of = lower(text_of(reading, 'of', 'value'))
      this%over = text_of(reading, 'over')
      this%at = number_of(reading, 'at', 0.0_wp)
      this%window = number_of(reading, 'window', this%window)
      this%where = where_of(reading)
      study%responses = [study%responses, this]
   end subroutine take_response

   !> Checks that the parts of a study are consistent.
   subroutine check_whole(reading, study)
      type(deck_reading_t), intent(inout) :: reading
      type(study_t), intent(in) :: study
      type(kind_t) :: kind

      reading%k = findloc(reading%cards%group, study_group, dim=1)
      kind = kinds(findloc(kinds%name == study%kind, .true., dim=1))
      if (size(study%factors) < kind%min_factors .or. size(study%factors) > kind%max_factors .or. &
         size(study%increments) < kind%min_increments) call complain(reading, '', 'kind = '//quoted(kind%name)//' needs '// &
         trim(kind%needs))
   end subroutine check_whole

end module ek_study
