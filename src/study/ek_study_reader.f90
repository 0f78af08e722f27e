!> Reads a study from its namelist file, with the scanner and the messages of the deck reader.
!>
!> `&study` defines the study, `&factor` a number of the deck that is varied, `&correlation` the correlation of two factors, and
!> `&response` a value read from the results.
module ek_study_reader
   use ek_kinds, only: wp, i8
   use ek_error, only: error_t, fail, exit_deck
   use ek_text, only: str, lower, quoted, did_you_mean
   use ek_definition_rows, only: programs
   use ek_case, only: method_names, max_increments
   use ek_record, only: element, place_of
   use ek_group, only: group_number, study_groups, study_group, factor_group, response_group, correlation_group, record_head, &
      word_length, is_deck_group, names_of_groups, max_values, max_paths, find_key, key_t
   use ek_namelist, only: check_record, is_legal_name
   use ek_deck, only: deck_t, read_deck, include_records
   use ek_deck_reading, only: deck_reading_t, complain, complain_of_all, refuse, choice_among, choose, has_key, where_of, line_of, &
      text_of, texts_of, number_of, whole_of, long_of, switch_of, value_count, raw, numbers_of
   use ek_sampler_kind, only: sampler_kinds, grid_kind, list_kind
   use ek_study, only: study_t, study_factor_t, response_t, surplus_factors, of_names, step_size_kind, kind_names, change_names, &
      by_value, by_part, not_given, is_given
   use ek_distribution, only: distribution_kinds, uniform_kind, normal_kind, log_normal_kind
   implicit none(type, external)
   private
   public :: read_study, take_bodies

   character(*), parameter :: format_names(2) = [character(6) :: 'netcdf', 'csv']

contains

   !> Reads a study file. All errors of the file are reported in one error.
   subroutine read_study(path, study, error)
      character(*), intent(in) :: path
      type(study_t), intent(out) :: study
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: file
      type(deck_reading_t) :: reading
      type(study_factor_t), allocatable :: factors(:)
      integer :: k, f, r

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
      allocate (study%settings%pairs(2, 0), study%settings%correlations(0))
      do k = 1, file%used
         reading%k = k
         associate (card => reading%cards(k), record => reading%records(k))
            card%group = group_number(record%group)
            if (.not. any(study_groups == card%group)) then
               call reading%deck_errors%add(place_of(record, 0), 'there is no group &'//record%group//' in a study'// &
                  did_you_mean(record%group, names_of_groups(of_deck=.false.)))
               card%group = 0
               cycle
            end if
            card%name = element(record, 'name', 1)
            call check_record(record, card%group, record_head(card%group, trim(card%name)), reading%deck_errors, card%is_good)
         end associate
         call check_name(reading)
      end do
      allocate (factors(count(reading%cards%group == factor_group)))
      allocate (study%responses(count(reading%cards%group == response_group)))
      do k = 1, file%used      ! a factor and a response depend on the kind of the study
         reading%k = k
         if (reading%cards(k)%group == study_group) call take_study(reading, study)
      end do
      f = 0
      r = 0
      do k = 1, file%used
         reading%k = k
         if (reading%cards(k)%group == factor_group) then
            f = f + 1
            call take_factor(reading, study, factors(f))
         else if (reading%cards(k)%group == response_group) then
            r = r + 1
            call take_response(reading, study%responses(:r - 1), study%responses(r))
         end if
      end do
      call move_alloc(factors, study%factors)
      do k = 1, file%used
         reading%k = k
         if (reading%cards(k)%group == correlation_group) call take_correlation(reading, study)
      end do
      reading%k = findloc(reading%cards%group, study_group, dim=1)
      if (reading%k == 0) then
         call complain_of_all(reading, 'there is no &study')
      else if (reading%deck_errors%count() == 0) then
         call check_whole(reading, study)
      end if
      if (reading%deck_errors%count() > 0) call fail(error, exit_deck, reading%deck_errors%text())
      call include_records(reading%records, study%sum)
   end subroutine read_study

   !> Whether a file contains groups of a deck and no groups of a study.
   pure logical function is_deck(file)
      type(deck_t), intent(in) :: file
      integer :: groups(file%used), k

      groups = [(group_number(file%records(k)%group), k=1, file%used)]
      is_deck = any(groups > 0) .and. all([(groups(k) == 0 .or. is_deck_group(groups(k)), k=1, file%used)])
   end function is_deck

   !> Checks the name of a record. A name appears in paths; names of factors and responses must be unique and not reserved for a
   !> column.
   subroutine check_name(reading)
      type(deck_reading_t), intent(inout) :: reading
      character(*), parameter :: heads(6) = [character(9) :: 'design', 'factor', 'converged', 'status', 'reason', 'state']
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
            if (reading%cards(j)%name /= card%name) cycle
            call complain(reading, 'name', 'the name is given twice, first in '//line_of(reading, j))
            exit
         end do
      end associate
   end subroutine check_name

   !> Reads the settings of &study. A second &study is an error.
   subroutine take_study(reading, study)
      type(deck_reading_t), intent(inout) :: reading
      type(study_t), intent(inout) :: study
      character(word_length) :: texts(3)
      integer :: c, m

      if (findloc(reading%cards%group, study_group, dim=1) < reading%k) then
         call complain(reading, '', 'a second &study; a file may hold only one')
         return
      end if
      call choice_among(reading, 'kind', kind_names, c)
      study%kind = c
      if (c > step_size_kind) study%kind = grid_kind                  ! 'sweep', its older name
      study%settings%kind = study%kind
      call choice_among(reading, 'end', [character(4) :: 'from', 'to'], c)
      study%end = lower(text_of(reading, 'end', 'to'))
      texts = texts_of(reading, 'methods', size(texts))
      study%methods = pack(texts, texts /= '')
      do m = 1, size(study%methods)
         call choose(reading, 'methods', trim(study%methods(m)), method_names, c)
      end do
      if (size(study%methods) == 0) study%methods = method_names
      study%name = text_of(reading, 'name')
      study%title = text_of(reading, 'title')
      study%deck = text_of(reading, 'deck')
      study%case = text_of(reading, 'case')
      study%plot = text_of(reading, 'plot', 'plot.gp')
      study%list = text_of(reading, 'list')
      call choice_among(reading, 'format', format_names, c)
      study%format = lower(text_of(reading, 'format'))
      call choice_among(reading, 'definitions', programs, c)
      study%definitions = lower(text_of(reading, 'definitions'))
      allocate (study%columns(value_count(reading, 'columns')))
      do c = 1, size(study%columns)
         study%columns(c) = raw(reading, 'columns', c)
      end do
      study%columns = pack(study%columns, study%columns /= '')
      study%increments = [(whole_of(reading, 'increments', 1, m), m=1, value_count(reading, 'increments'))]
      if (any(study%increments < 1 .or. study%increments > max_increments)) call complain(reading, 'increments', &
         'increments must be 1 to '//str(max_increments))
      do c = 2, size(study%columns)
         if (any(study%columns(:c - 1) == study%columns(c))) call complain(reading, 'columns', &
            'columns: '//quoted(study%columns(c))//' is named twice')
      end do
      study%chunk = whole_of(reading, 'chunk', merge(1, 0, has_key(reading, 'chunk')))
      if (has_key(reading, 'chunk') .and. study%chunk < 1) call complain(reading, 'chunk', 'chunk must be 1 or more')
      call take_settings(reading, study)
      study%where = where_of(reading)
   end subroutine take_study

   !> Reads the settings of the sampler. Settings that the kind of the study does not use are errors.
   subroutine take_settings(reading, study)
      type(deck_reading_t), intent(inout) :: reading
      type(study_t), intent(inout) :: study
      character(:), allocatable :: why

      study%settings%size = whole_of(reading, 'samples', 0)
      study%settings%levels = whole_of(reading, 'levels', study%settings%levels)
      study%settings%seed = long_of(reading, 'seed', 1_i8)
      study%settings%is_scrambled = switch_of(reading, 'scrambled', .true.)
      if (study%kind == 0) return
      why = 'kind = '//quoted(trim(kind_names(study%kind)))//' does not use it'
      if (study%kind /= list_kind) call refuse(reading, ['list'], why)
      if (study%kind == list_kind .and. study%list == '' .and. .not. is_lost(reading, 'list')) call complain(reading, '', &
         'kind = ''list'' needs list, a CSV file with one row per design and one column per factor')
      if (study%kind == step_size_kind) then
         call refuse(reading, [character(11) :: 'samples', 'levels', 'seed', 'scrambled', 'chunk', 'format', 'definitions'], why)
         if (size(study%increments) == 0 .and. .not. is_lost(reading, 'increments')) call complain(reading, '', &
            'kind = ''step_size'' needs increments = …')
         return
      end if
      call refuse(reading, [character(7) :: 'methods', 'end'], why)
      if (size(study%increments) > 1) call complain(reading, 'increments', 'a study of designs takes one number of increments')
      associate (kind => sampler_kinds(study%kind))
         if (.not. kind%has_size) call refuse(reading, ['samples'], why)
         if (.not. kind%has_levels) call refuse(reading, ['levels'], why)
         if (.not. kind%has_seed) call refuse(reading, ['seed'], why)
         if (.not. kind%has_scrambling) call refuse(reading, ['scrambled'], why)
         if (kind%has_size .and. study%settings%size < 1 .and. .not. is_lost(reading, 'samples')) call complain(reading, &
            merge('samples', '       ', has_key(reading, 'samples')), &
            'kind = '//quoted(trim(kind%name))//' needs samples = 1 or more')
      end associate
   end subroutine take_settings

   !> Reads a &correlation: two factors and their correlation.
   subroutine take_correlation(reading, study)
      type(deck_reading_t), intent(inout) :: reading
      type(study_t), intent(inout) :: study
      character(word_length) :: names(2)
      integer :: pair(2), j, k

      names = texts_of(reading, 'factors', 2)
      pair = 0
      do k = 1, 2
         do j = 1, size(study%factors)
            if (study%factors(j)%name == names(k) .and. names(k) /= '') pair(k) = j
         end do
         if (pair(k) > 0) then
            if (study%factors(pair(k))%is_each) call complain(reading, 'factors', 'a factor with each = .true. has no correlation')
         end if
         if (pair(k) == 0 .and. names(k) /= '') call complain(reading, 'factors', 'there is no factor '//quoted(names(k)))
      end do
      if (pair(1) > 0 .and. pair(1) == pair(2)) call complain(reading, 'factors', 'name two different factors')
      if (study%kind > 0 .and. study%kind < step_size_kind) then
         if (.not. sampler_kinds(study%kind)%has_correlations) call complain(reading, '', 'kind = '// &
            quoted(trim(kind_names(study%kind)))//' needs independent factors')
      end if
      study%settings%pairs = reshape([study%settings%pairs, pair], [2, size(study%settings%correlations) + 1])
      study%settings%correlations = [study%settings%correlations, number_of(reading, 'value', 0.0_wp)]
   end subroutine take_correlation

   !> Reads a &response: the column, and the number to be read from the column.
   subroutine take_response(reading, former, this)
      type(deck_reading_t), intent(inout) :: reading
      type(response_t), intent(in) :: former(:)            !! responses that precede this response
      type(response_t), intent(inout) :: this
      character(*), parameter :: of_slopes(2) = [character(4) :: 'at', 'over']
      logical :: is_known                                  ! the kind of the response
      integer :: c

      call choice_among(reading, 'of', of_names, c)
      is_known = c > 0 .or. (text_of(reading, 'of') == '' .and. .not. is_lost(reading, 'of'))
      this%name = text_of(reading, 'name')
      this%column = text_of(reading, 'column')
      this%case = text_of(reading, 'case')
      this%of = lower(text_of(reading, 'of', 'value'))
      this%over = text_of(reading, 'over')
      this%at = number_of(reading, 'at', 0.0_wp)
      this%window = number_of(reading, 'window', merge(0.0_wp, this%window, this%of == 'gradient'))
      this%has_window = has_key(reading, 'window')
      this%side = lower(text_of(reading, 'side'))
      call choice_among(reading, 'side', [character(5) :: 'left', 'right'], c)
      do c = 1, size(of_slopes)
         if (this%of == 'gradient' .and. has_key(reading, trim(of_slopes(c)))) call complain(reading, trim(of_slopes(c)), &
            'a gradient has no '//quoted(trim(of_slopes(c)))//', it is taken at design over the input of its test')
      end do
      if (is_known .and. this%of /= 'gradient' .and. this%side /= '') call complain(reading, 'side', &
         'only a gradient has a side; the name of a column begins with it')
      this%file = text_of(reading, 'file')
      this%lower = number_of(reading, 'lower', this%lower)
      this%upper = number_of(reading, 'upper', this%upper)
      this%where = where_of(reading)
      if (is_known .and. .not. is_lost(reading, 'file') .and. ((this%of == 'rms') .neqv. (this%file /= ''))) &
         call complain(reading, merge('file', '    ', has_key(reading, 'file')), &
         'of = ''rms'' and file, a CSV of the curve from which the column deviates, belong together')
      if (this%lower > this%upper) &
         call complain(reading, 'upper', 'the limits leave no value: lower is above upper')
      if (is_known) call take_difference(reading, former, this)
   end subroutine take_response

   !> Reads the two responses of a difference. Any other response must have a column.
   subroutine take_difference(reading, former, this)
      type(deck_reading_t), intent(inout) :: reading
      type(response_t), intent(in) :: former(:)            !! responses that precede this response
      type(response_t), intent(inout) :: this
      character(*), parameter :: others(7) = [character(6) :: 'column', 'case', 'side', 'at', 'over', 'window', 'file']
      integer :: j, k

      if (this%of /= 'difference') then
         call refuse(reading, ['responses'], 'only of = ''difference'' has two responses')
         if (.not. (has_key(reading, 'column') .or. is_lost(reading, 'column'))) call complain(reading, '', '''column'' is missing')
         return
      end if
      call refuse(reading, others, 'a difference has what its two responses have')
      this%names = texts_of(reading, 'responses', 2)
      if (.not. (has_key(reading, 'responses') .or. is_lost(reading, 'responses'))) call complain(reading, '', &
         'of = ''difference'' needs responses, the names of two')
      do k = 1, 2
         do j = 1, size(former)
            if (former(j)%name == this%names(k)) this%less(k) = j
         end do
         if (this%less(k) == 0 .and. this%names(k) /= '') call complain(reading, 'responses', 'there is no response '// &
            quoted(trim(this%names(k)))//' before this one')
      end do
   end subroutine take_difference

   !> Checks that a study of designs has a factor, and a column or a response.
   subroutine check_whole(reading, study)
      type(deck_reading_t), intent(inout) :: reading
      type(study_t), intent(in) :: study

      if (study%kind == step_size_kind .or. study%kind == 0) return
      if (size(study%factors) == 0) call complain(reading, '', 'kind = '//quoted(trim(kind_names(study%kind)))// &
         ' needs a &factor')
      if (surplus_factors(study) /= '') call complain(reading, '', surplus_factors(study))
      if (size(study%responses) == 0 .and. size(study%columns) == 0) call complain(reading, '', &
         'the study has no output: give columns, or a &response')
   end subroutine check_whole

   !> Reads a &factor. Its values are a list, or steps (from, to, count and spacing), or a range.
   subroutine take_factor(reading, study, this)
      type(deck_reading_t), intent(inout) :: reading
      type(study_t), intent(in) :: study
      type(study_factor_t), intent(inout) :: this
      character(*), parameter :: range_keys(6) = [character(12) :: 'lower', 'upper', 'nominal', 'tolerance', 'deviation', &
         'distribution']
      integer :: k

      this%name = text_of(reading, 'name')
      allocate (this%paths(min(value_count(reading, 'path'), max_paths)))
      do k = 1, size(this%paths)
         this%paths(k) = raw(reading, 'path', k)
      end do
      this%is_each = switch_of(reading, 'each', .false.)
      call choice_among(reading, 'change', change_names, this%change, default=by_value)
      call take_bodies(reading, this)
      call choice_among(reading, 'distribution', distribution_kinds, this%distribution, default=uniform_kind)
      this%lower = number_of(reading, 'lower', not_given())
      this%upper = number_of(reading, 'upper', not_given())
      this%nominal = number_of(reading, 'nominal', not_given())
      this%tolerance = number_of(reading, 'tolerance', not_given())
      this%deviation = number_of(reading, 'deviation', not_given())
      this%where = where_of(reading)
      call refuse(reading, ['weights'], 'only the factors of a fit have weights')
      if (has_key(reading, 'values')) then
         this%values = numbers_of(reading, 'values', value_count(reading, 'values'))
         call refuse(reading, [character(7) :: 'from', 'to', 'count', 'spacing'], 'give values, or from, to and count, not both')
      else if (has_key(reading, 'from') .or. has_key(reading, 'to') .or. has_key(reading, 'count')) then
         call take_steps(reading, this)
      else
         call refuse(reading, ['spacing'], 'only from, to and count have a spacing')
         call check_range(reading, study, this)
      end if
      if (allocated(this%values)) call refuse(reading, [range_keys(:2), range_keys(4:)], &
         'a factor has values, or a range of its own, not both')
   end subroutine take_factor

   !> Reads the parts of a factor with change = 'part'.
   subroutine take_bodies(reading, this)
      type(deck_reading_t), intent(inout) :: reading
      class(study_factor_t), intent(inout) :: this
      integer :: k

      allocate (this%bodies(value_count(reading, 'bodies')))
      do k = 1, size(this%bodies)
         this%bodies(k) = raw(reading, 'bodies', k)
      end do
      if (this%change /= by_part) call refuse(reading, ['bodies'], "only a factor with change = 'part' names parts")
   end subroutine take_bodies

   !> Reads from, to, count and spacing, which define values in equal steps, or in equal ratios (spacing = 'log'). One value is `from`.
   subroutine take_steps(reading, this)
      type(deck_reading_t), intent(inout) :: reading
      type(study_factor_t), intent(inout) :: this
      real(wp) :: from, to
      integer :: count, spacing, j

      call choice_among(reading, 'spacing', [character(6) :: 'linear', 'log'], spacing, default=1)
      count = whole_of(reading, 'count', 2)
      from = number_of(reading, 'from', 1.0_wp)
      to = number_of(reading, 'to', 1.0_wp)
      if (.not. (has_key(reading, 'count') .and. has_key(reading, 'from') .and. has_key(reading, 'to'))) then
         if (.not. is_lost(reading, '')) call complain(reading, '', 'needs values, or from, to and count')
      else if (count < 1 .or. count > max_values) then
         call complain(reading, 'count', 'count must be 1 to '//str(max_values))
      else if (spacing == 2 .and. .not. (from > 0.0_wp .and. to > 0.0_wp)) then
         call complain(reading, 'spacing', 'spacing = ''log'' needs from and to above 0')
      else if (count == 1) then
         this%values = [from]
      else if (spacing == 2) then
         this%values = [(from*(to/from)**(real(j, wp)/(count - 1)), j=0, count - 1)]
      else
         this%values = [(from + (to - from)*real(j, wp)/(count - 1), j=0, count - 1)]
      end if
   end subroutine take_steps

   !> Checks the range of a factor: lower and upper, nominal ± tolerance, or a distribution and its deviation.
   subroutine check_range(reading, study, this)
      type(deck_reading_t), intent(inout) :: reading
      type(study_t), intent(in) :: study
      type(study_factor_t), intent(in) :: this
      logical :: is_normal

      if (study%kind == list_kind) return        ! its values are in the list
      is_normal = this%distribution == normal_kind .or. this%distribution == log_normal_kind
      if (is_reversed(this%lower, this%upper)) then
         call complain(reading, 'upper', 'upper must be above lower, found '//str(this%lower)//' to '//str(this%upper))
      else if (has_key(reading, 'tolerance') .and. has_key(reading, 'deviation')) then
         call complain(reading, 'deviation', 'give tolerance or deviation, not both')
      else if (has_key(reading, 'deviation')) then
         if (.not. (is_normal .or. this%distribution == 0 .or. is_lost(reading, 'distribution'))) call complain(reading, &
            'deviation', 'deviation needs distribution = ''normal'' or ''log_normal''')
      else if (has_key(reading, 'tolerance') .or. is_lost(reading, 'tolerance')) then
         continue
      else if (is_normal) then
         call complain(reading, '', 'a normal distribution needs tolerance (three standard deviations) or deviation')
      else if (.not. (has_key(reading, 'lower') .and. has_key(reading, 'upper'))) then
         call complain(reading, '', 'needs lower and upper, or tolerance, or values, or from, to and count')
      end if
   end subroutine check_range

   !> Whether both ends of a range are given and are not in ascending order.
   pure logical function is_reversed(lower, upper)
      real(wp), intent(in) :: lower, upper

      is_reversed = .false.
      if (is_given(lower) .and. is_given(upper)) is_reversed = lower >= upper
   end function is_reversed

   !> Whether the record being read has no value for a key because of an error that is already reported: the value was rejected, or
   !> the record has an unknown key, which may be this key misspelt. Then it is not an error that the value is missing.
   pure logical function is_lost(reading, key)
      type(deck_reading_t), intent(in) :: reading
      character(*), intent(in) :: key
      type(key_t) :: row
      integer :: k

      is_lost = has_key(reading, key) .and. raw(reading, key) == ''
      if (has_key(reading, key)) return
      associate (record => reading%records(reading%k))
         do k = 1, record%used
            call find_key(reading%cards(reading%k)%group, record%entries(k)%key, row, is_lost)
            is_lost = .not. is_lost
            if (is_lost) return
         end do
      end associate
   end function is_lost

end module ek_study_reader
