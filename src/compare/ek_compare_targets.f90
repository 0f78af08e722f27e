!> The key numbers of compared reports against the target bands of their decks (&target_band): each report is judged by the bands of
!> its own deck.
module ek_compare_targets
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_decimal, only: get_decimal
   use ek_deck_file, only: deck_record_t
   use ek_number_words, only: is_in_band, limits_text
   use ek_report_files, only: results_t
   use ek_page, only: page_t, add_text, begin_table, add_cell, end_table, page_number
   implicit none(type, external)
   private
   public :: target_t, find_targets, add_targets, target_lines, read_target

   character(*), parameter :: band = 'target_band.', low = '.low', high = '.high'     !! parts of the paths in deck.csv

   !> A key number for which one or more of the decks have a band.
   type :: target_t
      character(:), allocatable :: title, unit
      type(message_list_t) :: values, verdicts, bands      !! one per result: '−13.83', 'inside', '−30 … −20'
   end type target_t

contains

   !> Lists the key numbers that have a band, in the order of the decks. A band of a number that no report has is omitted, because
   !> the report has given a warning about it.
   subroutine find_targets(results, targets)
      type(results_t), intent(in) :: results(:)
      type(target_t), allocatable, intent(out) :: targets(:)
      type(target_t) :: this
      type(message_list_t) :: names, none
      integer :: r, k

      allocate (targets(0))
      do r = 1, size(results)
         do k = 1, results(r)%deck%paths%count()
            call add_name(results(r)%deck%paths%line(k), names)
         end do
      end do
      do k = 1, names%count()
         this = target_t('', '', none, none, none)
         do r = 1, size(results)
            call judge(results(r), names%line(k), this)
         end do
         if (this%title /= '') targets = [targets, this]
      end do
   end subroutine find_targets

   !> Adds the key number of a path such as 'target_band.bump_camber.low' to a list, unless it is already listed. Other paths
   !> are skipped.
   subroutine add_name(path, names)
      character(*), intent(in) :: path
      type(message_list_t), intent(inout) :: names
      integer :: last, k

      last = index(path, '.', back=.true.) - 1
      if (index(path, band) /= 1 .or. last <= len(band)) return
      do k = 1, names%count()
         if (names%line(k) == path(len(band) + 1:last)) return
      end do
      call names%add(path(len(band) + 1:last))
   end subroutine add_name

   !> Adds the value, verdict and band of one result to a target. The verdict is 'outside' if the value of either wheel is
   !> outside the band; '' without a band or a value.
   subroutine judge(result, name, this)
      type(results_t), intent(in) :: result
      character(*), intent(in) :: name
      type(target_t), intent(inout) :: this
      character(:), allocatable :: value, verdict, number
      real(wp) :: limits(2)
      logical :: is_given(2)
      integer :: k

      call read_limit(result%deck, band//name//low, -huge(1.0_wp), limits(1), is_given(1))
      call read_limit(result%deck, band//name//high, huge(1.0_wp), limits(2), is_given(2))
      value = ''
      verdict = ''
      do k = 1, size(result%numbers)
         associate (row => result%numbers(k))
            if (row%column /= name .and. row%column /= 'left_'//name .and. row%column /= 'right_'//name) cycle
            this%title = trim(row%quantity)
            this%unit = trim(row%unit)
            if (.not. ieee_is_finite(row%value)) cycle
            number = page_number(row%value)
            if (value == '') value = number
            if (value /= number) value = value//' / '//number
            if (.not. any(is_given)) cycle
            if (verdict == '') verdict = 'inside'
            if (.not. is_in_band(row%value, limits, trim(row%unit))) verdict = 'outside'
         end associate
      end do
      if (value == '') value = '–'
      call this%values%add(value)
      call this%verdicts%add(verdict)
      call this%bands%add(limits_text(limits)//trim(merge('no band', '       ', .not. any(is_given))))
   end subroutine judge

   !> Reads the band of a key number from the values of a deck.
   subroutine read_target(deck, name, limits, has_target)
      type(deck_record_t), intent(in) :: deck
      character(*), intent(in) :: name                 !! without left_ and right_
      real(wp), intent(out) :: limits(2)               !! ∓huge for a limit that is not given
      logical, intent(out) :: has_target
      logical :: is_given(2)

      call read_limit(deck, band//name//low, -huge(1.0_wp), limits(1), is_given(1))
      call read_limit(deck, band//name//high, huge(1.0_wp), limits(2), is_given(2))
      has_target = any(is_given)
   end subroutine read_target

   !> Reads a limit of a band from the values of a deck.
   subroutine read_limit(deck, path, default, limit, is_given)
      type(deck_record_t), intent(in) :: deck
      character(*), intent(in) :: path
      real(wp), intent(in) :: default                  !! value of `limit` if the deck does not give it
      real(wp), intent(out) :: limit
      logical, intent(out) :: is_given
      integer :: k

      limit = default
      is_given = .false.
      do k = 1, deck%paths%count()                     ! the last band of a number counts
         if (deck%paths%line(k) /= path) cycle
         call get_decimal(deck%texts%line(k), limit, is_given)
         if (.not. is_given) limit = default
      end do
   end subroutine read_limit

   !> Adds the table of targets; adds nothing if there are no targets.
   subroutine add_targets(page, targets, letters)
      type(page_t), intent(inout) :: page
      type(target_t), intent(in) :: targets(:)
      character(*), intent(in) :: letters(:)           !! letters of the results
      character(12) :: heads(size(letters) + 3)
      integer :: k, r

      if (size(targets) == 0) return
      call add_text(page, 'h3', 'Targets of the decks')
      heads(1) = 'Quantity'
      heads(2:size(letters) + 1) = letters
      heads(size(letters) + 2:) = [character(12) :: 'Unit', 'Band']
      call begin_table(page, heads, 'numbers')
      do k = 1, size(targets)
         call add_cell(page, targets(k)%title)
         do r = 1, size(letters)
            call add_cell(page, targets(k)%values%line(r), verdict=targets(k)%verdicts%line(r))
         end do
         call add_cell(page, targets(k)%unit)
         call add_cell(page, bands_text(targets(k), ' → '))
      end do
      call end_table(page)
   end subroutine add_targets

   !> The bands of all results, separated by `arrow`; one band if all bands are equal.
   function bands_text(this, arrow) result(text)
      type(target_t), intent(in) :: this
      character(*), intent(in) :: arrow
      character(:), allocatable :: text
      integer :: r

      text = this%bands%line(1)
      if (all([(this%bands%line(r) == text, r=1, this%bands%count())])) return
      do r = 2, this%bands%count()
         text = text//arrow//this%bands%line(r)
      end do
   end function bands_text

   !> Lists one line per target for a terminal: 'target bump camber: −13.83 inside → −35.00 outside deg/m (−30 … −20)'.
   subroutine target_lines(targets, lines)
      type(target_t), intent(in) :: targets(:)
      type(message_list_t), intent(out) :: lines
      character(:), allocatable :: line
      integer :: k, r

      do k = 1, size(targets)
         line = 'target '//targets(k)%title//': '
         do r = 1, targets(k)%values%count()
            if (r > 1) line = line//' → '
            line = line//targets(k)%values%line(r)//trim(' '//targets(k)%verdicts%line(r))
         end do
         call lines%add(line//trim(' '//targets(k)%unit)//' ('//bands_text(targets(k), ' → ')//')')
      end do
   end subroutine target_lines

end module ek_compare_targets
