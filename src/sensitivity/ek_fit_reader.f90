!> Reads a fit from its namelist file, with the scanner and the messages of the deck reader. `&fit` names the deck. `&factor`
!> defines numbers that may change, as in a study. `&target` defines a result with its target.
module ek_fit_reader
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_deck
   use ek_text, only: str, lower, quoted, did_you_mean
   use ek_record, only: element, place_of
   use ek_group, only: group_number, fit_groups, fit_group, factor_group, fit_target_group, group_names, record_head, max_paths
   use ek_namelist, only: check_record, is_legal_name
   use ek_deck, only: deck_t, read_deck
   use ek_deck_reading, only: deck_reading_t, complain, complain_of_all, refuse, choice_among, has_key, where_of, line_of, &
      is_second, text_of, number_of, numbers_of, whole_of, switch_of, value_count, raw
   use ek_study, only: max_factors, change_names, by_value, by_part, not_given, is_given
   use ek_study_reader, only: take_bodies
   use ek_fit, only: fit_t, fit_factor_t, fit_target_t
   implicit none(type, external)
   private
   public :: read_fit

contains

   !> Reads a fit file. All errors of the file are reported in one error.
   subroutine read_fit(path, fit, error)
      character(*), intent(in) :: path
      type(fit_t), intent(out) :: fit
      type(error_t), allocatable, intent(out) :: error       !! exit_file, exit_deck
      type(deck_t) :: file
      type(deck_reading_t) :: reading
      integer, allocatable :: groups(:)
      integer :: k, factors, targets

      call read_deck(path, file, error, is_study=.true.)
      if (allocated(error)) return
      reading%file = file%file
      reading%records = file%records(:file%used)
      reading%deck_errors = file%deck_errors
      allocate (reading%cards(file%used))
      groups = [(group_number(reading%records(k)%group), k=1, file%used)]
      allocate (fit%factors(count(groups == factor_group)), fit%targets(count(groups == fit_target_group)))
      factors = 0
      targets = 0
      do k = 1, file%used
         reading%k = k
         associate (card => reading%cards(k), record => reading%records(k))
            card%group = group_number(record%group)
            if (.not. any(fit_groups == card%group)) then
               call reading%deck_errors%add(place_of(record, 0), 'there is no group &'//record%group//' in a fit'// &
                  did_you_mean(record%group, group_names(fit_groups)))
               card%group = 0
               cycle
            end if
            card%name = element(record, 'name', 1)
            call check_record(record, card%group, record_head(card%group, trim(card%name)), reading%deck_errors, card%is_good)
         end associate
         call check_name(reading)
         select case (reading%cards(k)%group)
         case (fit_group)
            call take_fit(reading, fit)
         case (factor_group)
            factors = factors + 1
            call take_factor(reading, fit%factors(factors))
         case (fit_target_group)
            targets = targets + 1
            call take_target(reading, fit%targets(targets))
         end select
      end do
      if (all(reading%cards%group /= fit_group)) call complain_of_all(reading, 'there is no &fit')
      if (size(fit%factors) == 0) call complain_of_all(reading, 'there is no &factor: nothing may change')
      if (size(fit%factors) > max_factors) call complain_of_all(reading, 'a fit has at most '//str(max_factors)// &
         ' factors, found '//str(size(fit%factors))//'; divide them among several fits')
      if (size(fit%targets) == 0) then
         call complain_of_all(reading, 'there is no &target: nothing to fit')
      else if (all(fit%targets%weight <= 0.0_wp)) then
         call complain_of_all(reading, 'all targets have weight 0: nothing to fit; give at least one target a weight above 0')
      end if
      if (reading%deck_errors%count() > 0) call fail(error, exit_deck, reading%deck_errors%text())
   end subroutine read_fit

   !> Checks that a name is legal for columns and files, and unique in its group.
   subroutine check_name(reading)
      type(deck_reading_t), intent(inout) :: reading
      integer :: j

      associate (card => reading%cards(reading%k))
         if (card%name == '') return
         if (.not. is_legal_name(trim(card%name))) &
            call complain(reading, 'name', 'a name must begin with a letter and contain only letters, digits and _')
         do j = 1, reading%k - 1
            if (reading%cards(j)%group /= card%group .or. lower(reading%cards(j)%name) /= lower(card%name)) cycle
            call complain(reading, 'name', 'the name is given twice, first in '//line_of(reading, j))
            exit
         end do
      end associate
   end subroutine check_name

   !> Reads the settings of &fit. A second &fit is an error.
   subroutine take_fit(reading, fit)
      type(deck_reading_t), intent(inout) :: reading
      type(fit_t), intent(inout) :: fit

      if (is_second(reading)) return
      fit%name = text_of(reading, 'name')
      fit%title = text_of(reading, 'title')
      fit%deck = text_of(reading, 'deck')
      fit%case = text_of(reading, 'case')
      fit%iterations = whole_of(reading, 'iterations', fit%iterations)
      if (fit%iterations < 1) call complain(reading, 'iterations', 'iterations must be 1 or more')
      fit%where = where_of(reading)
   end subroutine take_fit

   !> Reads a &factor: paths, change, bounds, prior and weights.
   subroutine take_factor(reading, this)
      type(deck_reading_t), intent(inout) :: reading
      type(fit_factor_t), intent(inout) :: this
      character(*), parameter :: of_studies(6) = [character(12) :: 'distribution', 'values', 'from', 'to', 'count', 'spacing']
      integer :: k

      call refuse(reading, of_studies, 'a fit does not use it; give lower and upper, and deviation for a prior')
      this%name = text_of(reading, 'name')
      allocate (this%paths(min(value_count(reading, 'path'), max_paths)))
      do k = 1, size(this%paths)
         this%paths(k) = raw(reading, 'path', k)
      end do
      this%is_each = switch_of(reading, 'each', .false.)
      call choice_among(reading, 'change', change_names, this%change, default=by_value)
      call take_bodies(reading, this)
      this%lower = number_of(reading, 'lower', not_given())
      this%upper = number_of(reading, 'upper', not_given())
      this%nominal = number_of(reading, 'nominal', not_given())
      this%tolerance = number_of(reading, 'tolerance', not_given())
      this%deviation = number_of(reading, 'deviation', not_given())
      this%where = where_of(reading)
      allocate (this%weights(size(this%paths)), source=1.0_wp)
      if (has_key(reading, 'weights')) then
         if (value_count(reading, 'weights') /= size(this%paths)) then
            call complain(reading, 'weights', 'weights needs one number per path, '//str(size(this%paths))//', found '// &
               str(value_count(reading, 'weights')))
         else if (any(this%change == [by_value, by_part])) then
            call complain(reading, 'weights', 'weights need change = ''delta'' or ''scale''')
         else
            this%weights = numbers_of(reading, 'weights', size(this%paths))
         end if
      end if
      if (is_given(this%lower) .and. is_given(this%upper)) then
         if (this%lower >= this%upper) call complain(reading, 'upper', 'upper must be above lower, found '//str(this%lower)// &
            ' to '//str(this%upper))
      end if
      if (is_given(this%tolerance) .and. is_given(this%deviation)) &
         call complain(reading, 'deviation', 'give tolerance (three standard deviations) or deviation, not both')
   end subroutine take_factor

   !> Reads a &target: the quantity, and its value, limits or file.
   subroutine take_target(reading, this)
      type(deck_reading_t), intent(inout) :: reading
      type(fit_target_t), intent(inout) :: this
      integer :: of

      this%name = text_of(reading, 'name')
      this%quantity = text_of(reading, 'quantity')
      this%case = text_of(reading, 'case')
      call choice_among(reading, 'of', [character(6) :: 'value', 'slope', 'change'], of, default=1)
      this%is_slope = of == 2
      this%is_change = of == 3
      this%over = text_of(reading, 'over', 'factor')
      this%at = number_of(reading, 'at', 0.0_wp)
      this%window = number_of(reading, 'window', 0.0_wp)
      this%value = number_of(reading, 'value', not_given())
      this%low = number_of(reading, 'low', not_given())
      this%high = number_of(reading, 'high', not_given())
      this%file = text_of(reading, 'file')
      this%column = text_of(reading, 'column', this%quantity)
      this%map = text_of(reading, 'map')
      this%deviation = number_of(reading, 'deviation', not_given())
      this%weight = number_of(reading, 'weight', 1.0_wp)
      this%where = where_of(reading)
      if (this%is_slope) then
         if (.not. this%window > 0.0_wp) call complain(reading, '', 'of = ''slope'' needs window, half of its width')
         call refuse(reading, [character(6) :: 'at', 'file', 'column', 'map'], 'a slope is taken around design and is one number')
      else
         call refuse(reading, ['window'], 'only of = ''slope'' has a window')
      end if
      if (this%file /= '') then
         call refuse(reading, [character(5) :: 'at', 'value', 'low', 'high'], 'the file gives the curve; its columns '// &
            'low and high are limits')
         if (this%map /= '') call refuse(reading, [character(6) :: 'column', 'over'], 'the map gives the headings of the file')
      else
         call refuse(reading, [character(6) :: 'column', 'map'], 'only a file has columns')
         if (.not. (is_given(this%value) .or. is_given(this%low) .or. is_given(this%high))) &
            call complain(reading, '', 'needs value, or low or high, or the file of a curve')
         if (is_given(this%value) .and. (is_given(this%low) .or. is_given(this%high))) &
            call complain(reading, 'value', 'give value, or the limits low and high, not both')
         if (is_given(this%low) .and. is_given(this%high)) then
            if (this%low > this%high) call complain(reading, 'high', 'high must not be below low')
         end if
      end if
   end subroutine take_target

end module ek_fit_reader
