!> Reads the factors of a study, the groups &factor, for ek_study_reader.
module ek_factor_reader
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_group, only: max_values, max_paths, find_key, key_t
   use ek_deck_reading, only: deck_reading_t, complain, refuse, choice, has_key, where_of, text_of, number_of, numbers_of, &
      whole_of, switch_of, value_count, raw
   use ek_distribution, only: distribution_kinds, uniform_kind, normal_kind, log_normal_kind
   use ek_sampler_kind, only: list_kind
   use ek_study, only: study_t, study_factor_t, change_names, by_value, not_given, is_given
   implicit none(type, external)
   private
   public :: take_factor, is_lost

contains

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
      call choice(reading, 'change', change_names, this%change, default=by_value)
      call choice(reading, 'distribution', distribution_kinds, this%distribution, default=uniform_kind)
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

   !> Reads from, to, count and spacing, which define values in equal steps, or in equal ratios (spacing = 'log'). One value is `from`.
   subroutine take_steps(reading, this)
      type(deck_reading_t), intent(inout) :: reading
      type(study_factor_t), intent(inout) :: this
      real(wp) :: from, to
      integer :: count, spacing, j

      call choice(reading, 'spacing', [character(6) :: 'linear', 'log'], spacing, default=1)
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

end module ek_factor_reader
