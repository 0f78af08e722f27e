!> Reads a study from its namelist file, with the scanner and the messages of the deck reader.
!>
!> `&study` defines the study, `&factor` a value of the deck that is varied, `&correlation` ties two factors, `&response` is a
!> value read from the results.
module ek_study_reader
   use ek_kinds, only: wp, i8
   use ek_error, only: error_t, fail, exit_deck
   use ek_text, only: str, lower, quoted
   use ek_case, only: method_names, most_increments
   use ek_complaint, only: place_t
   use ek_record, only: element, place_of
   use ek_group, only: group_number, study_group, factor_group, response_group, correlation_group, record_head, word_length, &
      most_values, most_paths, did_you_mean, is_deck_group, names_of_groups
   use ek_reserved_name, only: is_legal_name
   use ek_namelist, only: check_record
   use ek_deck, only: deck_t, read_deck, include_records
   use ek_draft, only: draft_t, complain, complain_of_all, refuse, choice, choose, has_key, where_of, line_of, text_of, &
      texts_of, number_of, numbers_of, whole_of, switch_of, value_count, raw
   use ek_distribution, only: distribution_kinds, uniform_kind, normal_kind, log_normal_kind
   use ek_sampler_kind, only: sampler_kinds, grid_kind, list_kind
   use ek_study, only: study_t, study_factor_t, response_t, step_size_kind, kind_names, change_names, by_value, not_given, is_given
   implicit none(type, external)
   private
   public :: read_study

   character(*), parameter :: format_names(2) = [character(6) :: 'netcdf', 'csv']
   character(*), parameter :: of_names(6) = [character(5) :: 'value', 'slope', 'span', 'min', 'max', 'rms']

contains

   !> Reads a study file; all its mistakes are reported in one error.
   subroutine read_study(path, study, error)
      character(*), intent(in) :: path
      type(study_t), intent(out) :: study
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: file
      type(draft_t) :: draft
      type(place_t) :: place
      integer :: k

      call read_deck(path, file, error, is_study=.true.)
      if (allocated(error)) return
      draft%file = file%file
      draft%records = file%records(:file%used)
      draft%complaints = file%complaints
      draft%k = 1
      if (file%used == 0) then
         call fail(error, exit_deck, file%complaints%text())
         return
      else if (is_deck(file)) then
         call fail(error, exit_deck, where_of(draft)//': this is a deck (&'//file%records(1)%group// &
            '), not a study; use it with: elastokin run, check or report '//file%file// &
            '. A study is a file with a &study, which names its deck')
         return
      end if
      allocate (draft%cards(file%used))
      allocate (study%factors(0), study%responses(0))
      allocate (study%settings%pairs(2, 0), study%settings%correlations(0))
      do k = 1, file%used
         draft%k = k
         associate (card => draft%cards(k), record => draft%records(k))
            card%group = group_number(record%group)
            if (card%group == 0 .or. is_deck_group(card%group)) then
               call place_of(record, 0, place)
               call draft%complaints%add(place, 'there is no group &'//record%group//' in a study'// &
                  did_you_mean(record%group, names_of_groups(of_deck=.false.)))
               card%group = 0
               cycle
            end if
            card%name = element(record, 'name', 1)
            call check_record(record, card%group, record_head(card%group, trim(card%name)), draft%complaints, card%is_good)
         end associate
         call check_name(draft)
      end do
      do k = 1, file%used      ! a factor and a response depend on the kind of the study
         draft%k = k
         if (draft%cards(k)%group == study_group) call take_study(draft, study)
      end do
      do k = 1, file%used
         draft%k = k
         if (draft%cards(k)%group == factor_group) call take_factor(draft, study)
         if (draft%cards(k)%group == response_group) call take_response(draft, study)
      end do
      do k = 1, file%used
         draft%k = k
         if (draft%cards(k)%group == correlation_group) call take_correlation(draft, study)
      end do
      draft%k = findloc(draft%cards%group, study_group, dim=1)
      if (draft%k == 0) then
         call complain_of_all(draft, 'there is no &study')
      else if (draft%complaints%count() == 0) then
         call check_whole(draft, study)
      end if
      if (draft%complaints%count() > 0) call fail(error, exit_deck, draft%complaints%text())
      call include_records(draft%records, study%sum)
   end subroutine read_study

   !> Whether a file contains groups of a deck and none of a study.
   pure logical function is_deck(file)
      type(deck_t), intent(in) :: file
      integer :: groups(file%used), k

      groups = [(group_number(file%records(k)%group), k=1, file%used)]
      is_deck = any(groups > 0) .and. all([(groups(k) == 0 .or. is_deck_group(groups(k)), k=1, file%used)])
   end function is_deck

   !> Checks a name, which appears in paths and must be unique among the column names.
   subroutine check_name(draft)
      type(draft_t), intent(inout) :: draft
      character(*), parameter :: heads(6) = [character(9) :: 'design', 'factor', 'converged', 'status', 'reason', 'state']
      integer :: j

      associate (card => draft%cards(draft%k))
         if (card%name == '') return
         if (.not. is_legal_name(trim(card%name))) then
            call complain(draft, 'name', 'a name must begin with a letter and contain only letters, digits and _')
         end if
         if (card%group == study_group) return
         if (any(heads == lower(card%name))) &
            call complain(draft, 'name', 'the name is reserved for a column of the results')
         do j = 1, draft%k - 1
            if (draft%cards(j)%group /= factor_group .and. draft%cards(j)%group /= response_group) cycle
            if (draft%cards(j)%name == card%name) call complain(draft, 'name', 'the name is given twice, first in '// &
               line_of(draft, j))
         end do
      end associate
   end subroutine check_name

   !> &study
   subroutine take_study(draft, study)
      type(draft_t), intent(inout) :: draft
      type(study_t), intent(inout) :: study
      character(word_length) :: texts(20)
      integer :: c, m

      if (findloc(draft%cards%group, study_group, dim=1) < draft%k) then
         call complain(draft, '', 'a second &study; a file may hold only one')
         return
      end if
      call choice(draft, 'kind', kind_names, c)
      study%kind = c
      if (c > step_size_kind) study%kind = grid_kind                  ! 'sweep', its older name
      study%settings%kind = study%kind
      call choice(draft, 'end', [character(4) :: 'from', 'to'], c)
      study%end = lower(text_of(draft, 'end', 'to'))
      texts = texts_of(draft, 'methods', size(texts))
      study%methods = pack(texts, texts /= '')
      do m = 1, size(study%methods)
         call choose(draft, 'methods', trim(study%methods(m)), method_names, c)
      end do
      if (size(study%methods) == 0) study%methods = method_names
      study%name = text_of(draft, 'name')
      study%title = text_of(draft, 'title')
      study%deck = text_of(draft, 'deck')
      study%case = text_of(draft, 'case')
      study%plot = text_of(draft, 'plot', 'plot.gp')
      study%list = text_of(draft, 'list')
      call choice(draft, 'format', format_names, c)
      study%format = lower(text_of(draft, 'format'))
      texts = texts_of(draft, 'columns', size(texts))
      study%columns = pack(texts, texts /= '')
      study%increments = [(whole_of(draft, 'increments', 0, m), m=1, value_count(draft, 'increments'))]
      if (any(study%increments < 1 .or. study%increments > most_increments)) call complain(draft, 'increments', &
         'increments must be 1 to '//str(most_increments))
      do c = 2, size(study%columns)
         if (any(study%columns(:c - 1) == study%columns(c))) call complain(draft, 'columns', &
            'columns: '//quoted(study%columns(c))//' is named twice')
      end do
      study%chunk = whole_of(draft, 'chunk', 0)
      if (has_key(draft, 'chunk') .and. study%chunk < 1) call complain(draft, 'chunk', 'chunk must be 1 or more')
      call take_settings(draft, study)
      study%where = where_of(draft)
   end subroutine take_study

   !> The settings of the sampler, and none that its kind does not use.
   subroutine take_settings(draft, study)
      type(draft_t), intent(inout) :: draft
      type(study_t), intent(inout) :: study
      character(:), allocatable :: why

      study%settings%size = whole_of(draft, 'samples', 0)
      study%settings%levels = whole_of(draft, 'levels', study%settings%levels)
      study%settings%seed = whole_of(draft, 'seed', 1)
      study%settings%is_scrambled = switch_of(draft, 'scrambled', .true.)
      if (study%kind == 0) return
      why = 'kind = '//quoted(trim(kind_names(study%kind)))//' does not use it'
      if (study%kind /= list_kind) call refuse(draft, ['list'], why)
      if (study%kind == list_kind .and. study%list == '') call complain(draft, '', 'kind = ''list'' needs list, a CSV file '// &
         'with one row per design and one column per factor')
      if (study%kind == step_size_kind) then
         call refuse(draft, [character(9) :: 'samples', 'levels', 'seed', 'scrambled', 'chunk', 'format'], why)
         if (size(study%increments) == 0) call complain(draft, '', 'kind = ''step_size'' needs increments = …')
         return
      end if
      call refuse(draft, [character(10) :: 'increments', 'methods', 'end'], why)
      associate (kind => sampler_kinds(study%kind))
         if (.not. kind%has_size) call refuse(draft, ['samples'], why)
         if (.not. kind%has_levels) call refuse(draft, ['levels'], why)
         if (.not. kind%has_seed) call refuse(draft, [character(9) :: 'seed', 'scrambled'], why)
         if (kind%has_size .and. study%settings%size < 1) call complain(draft, merge('samples', '       ', &
            has_key(draft, 'samples')), 'kind = '//quoted(trim(kind%name))//' needs samples = 1 or more')
      end associate
   end subroutine take_settings

   !> &factor: values one by one; or from, to, count and spacing; or a range.
   subroutine take_factor(draft, study)
      type(draft_t), intent(inout) :: draft
      type(study_t), intent(inout) :: study
      character(*), parameter :: range_keys(6) = [character(12) :: 'lower', 'upper', 'nominal', 'tolerance', 'deviation', &
         'distribution']
      type(study_factor_t) :: this
      integer :: k

      this%name = text_of(draft, 'name')
      allocate (this%paths(min(value_count(draft, 'path'), most_paths)))
      do k = 1, size(this%paths)
         this%paths(k) = raw(draft, 'path', k)
      end do
      call choice(draft, 'change', change_names, this%change, default=by_value)
      call choice(draft, 'distribution', distribution_kinds, this%distribution, default=uniform_kind)
      this%lower = number_of(draft, 'lower', not_given())
      this%upper = number_of(draft, 'upper', not_given())
      this%nominal = number_of(draft, 'nominal', not_given())
      this%tolerance = number_of(draft, 'tolerance', not_given())
      this%deviation = number_of(draft, 'deviation', not_given())
      this%where = where_of(draft)
      if (has_key(draft, 'values')) then
         this%values = numbers_of(draft, 'values', value_count(draft, 'values'))
         call refuse(draft, [character(5) :: 'from', 'to', 'count'], 'give values, or from, to and count, not both')
      else if (has_key(draft, 'from') .or. has_key(draft, 'to') .or. has_key(draft, 'count')) then
         call take_steps(draft, this)
      else
         call check_range(draft, study, this)
      end if
      if (allocated(this%values)) call refuse(draft, [range_keys(:2), range_keys(4:)], &
         'a factor has values, or a range of its own, not both')
      study%factors = [study%factors, this]
   end subroutine take_factor

   !> from, to, count and spacing: evenly spaced values.
   subroutine take_steps(draft, this)
      type(draft_t), intent(inout) :: draft
      type(study_factor_t), intent(inout) :: this
      real(wp) :: from, to
      integer :: count, spacing, j

      call choice(draft, 'spacing', [character(6) :: 'linear', 'log'], spacing, default=1)
      count = whole_of(draft, 'count', 2)
      from = number_of(draft, 'from', 0.0_wp)
      to = number_of(draft, 'to', 0.0_wp)
      if (.not. (has_key(draft, 'count') .and. has_key(draft, 'from') .and. has_key(draft, 'to'))) then
         call complain(draft, '', 'needs values, or from, to and count')
      else if (count < 2 .or. count > most_values) then
         call complain(draft, 'count', 'count must be 2 to '//str(most_values))
      else if (spacing == 2 .and. .not. (from > 0.0_wp .and. to > 0.0_wp)) then
         call complain(draft, 'spacing', 'spacing = ''log'' needs from and to above 0')
      else if (spacing == 2) then
         this%values = [(from*(to/from)**(real(j, wp)/(count - 1)), j=0, count - 1)]
      else
         this%values = [(from + (to - from)*real(j, wp)/(count - 1), j=0, count - 1)]
      end if
   end subroutine take_steps

   !> lower and upper, or nominal ± tolerance, or a distribution and its deviation.
   subroutine check_range(draft, study, this)
      type(draft_t), intent(inout) :: draft
      type(study_t), intent(in) :: study
      type(study_factor_t), intent(in) :: this

      if (study%kind == list_kind) return        ! its values are in the list
      if (is_given(this%lower) .and. is_given(this%upper) .and. .not. this%lower < this%upper) then
         call complain(draft, 'upper', 'upper must be above lower, found '//str(this%lower)//' to '//str(this%upper))
      else if (is_given(this%tolerance) .and. is_given(this%deviation)) then
         call complain(draft, 'deviation', 'give tolerance or deviation, not both')
      else if (is_given(this%deviation) .and. this%distribution /= normal_kind .and. this%distribution /= log_normal_kind) then
         call complain(draft, 'deviation', 'deviation needs distribution = ''normal'' or ''log_normal''')
      else if (is_given(this%tolerance) .or. is_given(this%deviation)) then
         continue
      else if (this%distribution == normal_kind .or. this%distribution == log_normal_kind) then
         call complain(draft, '', 'a normal distribution needs tolerance (three standard deviations) or deviation')
      else if (.not. (is_given(this%lower) .and. is_given(this%upper))) then
         call complain(draft, '', 'needs lower and upper, or tolerance, or values, or from, to and count')
      end if
   end subroutine check_range

   !> &correlation
   subroutine take_correlation(draft, study)
      type(draft_t), intent(inout) :: draft
      type(study_t), intent(inout) :: study
      character(word_length) :: names(2)
      integer :: pair(2), j, k

      names = texts_of(draft, 'factors', 2)
      pair = 0
      do k = 1, 2
         do j = 1, size(study%factors)
            if (study%factors(j)%name == names(k)) pair(k) = j
         end do
         if (pair(k) == 0 .and. names(k) /= '') call complain(draft, 'factors', 'there is no factor '//quoted(names(k)))
      end do
      if (pair(1) > 0 .and. pair(1) == pair(2)) call complain(draft, 'factors', 'name two different factors')
      if (study%kind > 0 .and. study%kind < step_size_kind) then
         if (.not. sampler_kinds(study%kind)%has_correlations) call complain(draft, '', 'kind = '// &
            quoted(trim(kind_names(study%kind)))//' needs independent factors')
      end if
      study%settings%pairs = reshape([study%settings%pairs, pair], [2, size(study%settings%correlations) + 1])
      study%settings%correlations = [study%settings%correlations, number_of(draft, 'value', 0.0_wp)]
   end subroutine take_correlation

   !> &response
   subroutine take_response(draft, study)
      type(draft_t), intent(inout) :: draft
      type(study_t), intent(inout) :: study
      type(response_t) :: this
      integer :: c

      call choice(draft, 'of', of_names, c)
      this%name = text_of(draft, 'name')
      this%column = text_of(draft, 'column')
      this%case = text_of(draft, 'case')
      this%of = lower(text_of(draft, 'of', 'value'))
      this%over = text_of(draft, 'over')
      this%at = number_of(draft, 'at', 0.0_wp)
      this%window = number_of(draft, 'window', this%window)
      this%file = text_of(draft, 'file')
      this%lower = number_of(draft, 'lower', this%lower)
      this%upper = number_of(draft, 'upper', this%upper)
      this%where = where_of(draft)
      if ((this%of == 'rms') .neqv. (this%file /= '')) call complain(draft, merge('file', '    ', has_key(draft, 'file')), &
         'of = ''rms'' and file, a CSV of the curve from which the column deviates, belong together')
      if (this%lower > this%upper) &
         call complain(draft, 'upper', 'the limits leave no value: lower is above upper')
      study%responses = [study%responses, this]
   end subroutine take_response

   !> Checks that the parts of a study are consistent.
   subroutine check_whole(draft, study)
      type(draft_t), intent(inout) :: draft
      type(study_t), intent(in) :: study

      if (study%kind == step_size_kind) return
      if (size(study%factors) == 0) call complain(draft, '', 'kind = '//quoted(trim(kind_names(study%kind)))// &
         ' needs a &factor')
      if (size(study%responses) == 0 .and. size(study%columns) == 0) call complain(draft, '', &
         'nothing is asked of the designs: give columns, or a &response')
   end subroutine check_whole

end module ek_study_reader
