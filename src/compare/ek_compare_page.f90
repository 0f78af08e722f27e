!> The page of a comparison: changes of the deck, their effects sorted by size, and a chart of every quantity.
module ek_compare_page
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str, plural
   use ek_version, only: version
   use ek_definition, only: title_of
   use ek_test_result, only: design_row
   use ek_page, only: page_t, begin_page, begin_section, add_warnings, add_facts, begin_table, add_cell, end_table, add_text, &
      add_legend, add_charts, begin_fold, end_fold, end_text, set_data, page_text, page_number
   use ek_change, only: change_of, verdict_of, has_changed, letter_of, relative_change
   use ek_compare_sentence, only: sentences_of
   use ek_compare_targets, only: add_targets
   use ek_comparison, only: comparison_t, difference_t, difference, largest_change, descending, counted
   use ek_deck_difference, only: deck_difference_t, few_changes, step_text
   use ek_report_data, only: comparison_data
   use ek_report_page, only: add_pictures, add_constants
   implicit none(type, external)
   private
   public :: page_of, verdicts

   integer, parameter :: principal = 6        !! number of changed charts of a test that are not folded
   integer, parameter :: most_rows = 40       !! number of rows of a table that are not folded

contains

   !> The content of the page compare.html.
   function page_of(this, why_none) result(text)
      type(comparison_t), intent(in) :: this
      character(*), intent(in) :: why_none          !! reason for missing pictures; '' if there is no message
      character(:), allocatable :: text
      type(page_t) :: page
      type(message_list_t) :: names, values, warnings, sentences
      integer :: r, t, k

      do r = 1, size(this%results)
         call names%add(letter_of(r))
         call values%add(this%results(r)%path)
      end do
      call names%add('Program')
      call values%add('elastokin '//version)
      if (this%results(1)%program /= '') then
         call names%add('Definitions')
         call values%add(title_of(trim(this%results(1)%program)))
      end if
      call begin_page(page, 'Comparison', 'What was changed, and what it did; every result against A', &
         this%is_static)
      call add_facts(page, names, values)
      if (len(why_none) > 0) then
         call warnings%add('The page has no pictures: '//why_none)
         call add_warnings(page, 'Warnings', warnings)
      end if
      call sentences_of(this, sentences)
      do k = 1, sentences%count()
         call add_text(page, 'p', sentences%line(k))
      end do
      if (size(this%deck) <= few_changes) call add_changes(page, this)
      call add_results(page, this)
      do t = 1, size(this%results(1)%tests)
         if (any([(this%charts(k)%test == t, k=1, size(this%charts))])) call add_test(page, this, t)
      end do
      call add_warnings(page, 'Missing from some results', this%missing)
      if (size(this%deck) > few_changes) call add_changes(page, this)
      if (.not. this%is_static) call set_data(page, comparison_data(this%results(1)%tests, this%charts))
      text = page_text(page)
   end function page_of

   !> Adds the differences between the runs (facts) and between the decks (values).
   subroutine add_changes(page, this)
      type(page_t), intent(inout) :: page
      type(comparison_t), intent(in) :: this
      integer :: r

      call begin_section(page, 'changed', 'What was changed', has_text=size(this%deck) <= few_changes)
      if (size(this%facts) + size(this%deck) == 0 .and. all(this%results%deck%is_known)) then
         call add_text(page, 'p', 'Nothing: the decks have the same values and were run with the same settings.')
         return
      end if
      if (.not. all(this%results%deck%is_known)) then
         if (.not. any(this%results%is_report)) then
            call add_text(page, 'p', 'Tables without a report do not contain the values of their decks. Their headers give:')
         else
            do r = 1, size(this%results)
               if (.not. this%results(r)%deck%is_known) call add_text(page, 'p', letter_of(r)// &
                  ' has no deck.csv: it was written by an earlier version, and the values of its deck are not known.')
            end do
         end if
      end if
      if (size(this%deck) > 0) then
         call add_text(page, 'p', plural(size(this%deck), 'parameter of the deck differs', 'parameters of the deck differ')//'.')
         call add_values(page, this, this%deck, 'Value')
      else if (all(this%results%deck%is_known)) then
         call add_text(page, 'p', 'The decks have the same values.')
      end if
      if (size(this%facts) > 0) call add_values(page, this, this%facts, 'Made with')
   end subroutine add_changes

   subroutine add_values(page, this, list, head)
      type(page_t), intent(inout) :: page
      type(comparison_t), intent(in) :: this
      type(deck_difference_t), intent(in) :: list(:)
      character(*), intent(in) :: head
      character(12) :: heads(size(this%results) + merge(2, 1, size(this%results) == 2))
      logical :: has_step
      integer :: k, r

      has_step = size(this%results) == 2
      heads(1) = head
      do r = 1, size(this%results)
         heads(r + 1) = letter_of(r)
      end do
      if (has_step) heads(size(heads)) = '>difference'
      call begin_rows(page, heads)
      do k = 1, size(list)
         if (k == most_rows + 1) call fold_rows(page, heads, size(list) - most_rows, 'more differences')
         call add_cell(page, trim(list(k)%path//' '//bracketed(list(k)%sides)))
         do r = 1, size(this%results)
            if (list(k)%texts%line(r) == '') call add_cell(page, 'not given', is_small=.true.)
            if (list(k)%texts%line(r) /= '') call add_cell(page, list(k)%texts%line(r))
         end do
         if (has_step) call add_cell(page, with_minus(step_text(list(k)%texts%line(1), list(k)%texts%line(2))))
      end do
      call end_table(page)
      if (size(list) > most_rows) call end_fold(page)
   end subroutine add_values

   !> A note in parentheses, such as '(both sides)'; '' for an empty note.
   pure function bracketed(words) result(text)
      character(*), intent(in) :: words
      character(:), allocatable :: text

      text = ''
      if (words /= '') text = '('//words//')'
   end function bracketed

   !> A number with a minus sign instead of a hyphen.
   pure function with_minus(number) result(text)
      character(*), intent(in) :: number
      character(:), allocatable :: text

      text = number
      if (index(number, '-') == 1) text = '−'//number(2:)
   end function with_minus

   !> Begins a table whose rows can be found with the filter of the page.
   subroutine begin_rows(page, heads)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: heads(:)
      call begin_table(page, heads, 'numbers')
   end subroutine begin_rows

   !> Ends a table and begins a folded table with the same column headings.
   subroutine fold_rows(page, heads, rows, what)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: heads(:), what
      integer, intent(in) :: rows

      call end_table(page)
      call begin_fold(page, str(rows)//' '//what)
      call begin_rows(page, heads)
   end subroutine fold_rows

   !> Counts the key numbers, gradients and charts that changed. Adds one line for key numbers and gradients, and one for
   !> charts, if there are any.
   subroutine verdicts(this, lines)
      type(comparison_t), intent(in) :: this
      type(message_list_t), intent(out) :: lines
      real(wp) :: changes(size(this%shown))
      integer :: k, known
      character(:), allocatable :: what

      what = 'gradients'
      if (size(this%numbers) > 0) what = 'K&C metrics and gradients'
      do k = 1, size(changes)
         changes(k) = largest_change(this%shown(k))
      end do
      known = count(ieee_is_finite(changes))
      if (size(changes) > 0) call lines%add(counted(count(has_changed(changes, this%threshold)), known, what, this%threshold)// &
         others(size(changes) - known))
      known = count(this%changes%is_known)
      if (size(this%charts) > 0) call lines%add(counted(count(this%changes%is_changed), known, 'charts', this%threshold)// &
         others(size(this%charts) - known))

   contains

      !> Phrase with the number of rows or charts that cannot be compared; '' if it is 0.
      function others(number) result(text)
         integer, intent(in) :: number
         character(:), allocatable :: text

         text = ''
         if (number > 0) text = '; '//str(number)//' more cannot be compared: without a value, or in one result alone'
      end function others

   end subroutine verdicts

   !> Adds the verdicts, the targets, the key numbers sorted by change, and a table of the charts that changed most.
   subroutine add_results(page, this)
      type(page_t), intent(inout) :: page
      type(comparison_t), intent(in) :: this
      type(message_list_t) :: lines
      integer, allocatable :: order(:)
      integer :: k, shown

      call begin_section(page, 'results', 'What it did', has_text=.true.)
      call verdicts(this, lines)
      do k = 1, lines%count()
         call add_text(page, 'b', lines%line(k))
      end do
      call add_text(page, 'p', 'A change of a number is that of its magnitude in percent of A. Whether it counts, and '// &
         'the order, follow from its share of A, or of the least span of a chart where A is smaller: noise is no change.')
      call add_targets(page, this%targets, [(letter_of(k), k=1, size(this%results))])
      call end_text(page)
      if (size(this%targets) > 0) call add_text(page, 'h3', 'K&C metrics and gradients')
      if (size(this%shown) > 0) call add_numbers(page, this)
      order = descending(merge(abs(this%changes%change), -1.0_wp, this%changes%is_known))
      shown = min(most_rows/2, count(this%changes%is_changed))
      if (shown == 0) return
      call add_text(page, 'h3', trim(merge('Charts that changed most', 'The chart that changed  ', shown > 1)))
      call begin_rows(page, [character(20) :: 'Quantity', 'Test', '>largest difference', '>at', '>change %', '~Unit, sign'])
      do k = 1, shown
         associate (chart => this%charts(order(k)), change => this%changes(order(k)))
            if (this%is_static .or. chart%is_level) then
               call add_cell(page, chart%title)
            else
               call add_cell(page, chart%title, link=chart%name)
            end if
            call add_cell(page, this%results(1)%tests(chart%test)%title)
            call add_cell(page, page_number(change%largest))
            call add_cell(page, page_number(change%at))
            call add_cell(page, page_number(100*change%change))
            call add_cell(page, chart%y_label)
         end associate
      end do
      call end_table(page)
   end subroutine add_results

   !> Adds the table of key numbers and gradients. After 40 changed numbers, the others are in a folded table. Numbers that
   !> are unchanged or cannot be compared are in another folded table.
   subroutine add_numbers(page, this)
      type(page_t), intent(inout) :: page
      type(comparison_t), intent(in) :: this
      character(12) :: heads(3*size(this%results) + 1)
      integer :: k, r, many
      logical :: is_folded

      heads(1) = 'Quantity'
      heads(2) = '>A'
      do r = 2, size(this%results)
         heads(3*r - 3) = '>'//letter_of(r)
         heads(3*r - 2) = '>difference'
         heads(3*r - 1) = '>change %'
      end do
      heads(size(heads) - 1) = 'Unit'
      heads(size(heads)) = '~Where'
      many = 0
      do k = 1, size(this%shown)
         if (has_changed(largest_change(this%shown(k)), this%threshold)) many = many + 1
      end do
      is_folded = .false.
      if (many > 0) call begin_rows(page, heads)
      if (many > most_rows) then
         do k = 1, most_rows
            call add_number(page, this, this%shown(k))
         end do
         call fold_rows(page, heads, many - most_rows, 'more that changed')
         is_folded = .true.
      end if
      do k = merge(most_rows + 1, 1, is_folded), many
         call add_number(page, this, this%shown(k))
      end do
      if (many > 0) call end_table(page)
      if (is_folded) call end_fold(page)
      if (many == size(this%shown)) return
      call begin_fold(page, str(size(this%shown) - many)//' without a change, or not to be compared')
      call begin_rows(page, heads)
      do k = many + 1, size(this%shown)
         call add_number(page, this, this%shown(k))
      end do
      call end_table(page)
      call end_fold(page)
   end subroutine add_numbers

   subroutine add_number(page, this, row)
      type(page_t), intent(inout) :: page
      type(comparison_t), intent(in) :: this
      type(difference_t), intent(in) :: row
      character(:), allocatable :: verdict
      real(wp) :: change, percent
      integer :: r

      call add_cell(page, trim(row%quantity//' '//row%side))
      call add_cell(page, page_number(row%values(1)))
      do r = 2, size(row%values)
         change = change_of(row%values(1), row%values(r), row%least, row%unit)
         verdict = trim(verdict_of(change, this%threshold, row%is_there(1), row%is_there(r), r))
         call add_cell(page, page_number(row%values(r)))
         call add_cell(page, page_number(difference(row%values(1), row%values(r))))
         if (verdict == 'changed' .or. verdict == 'same') then
            call relative_change(row%values(1), row%values(r), row%unit, percent, verdict)
            if (ieee_is_finite(percent)) verdict = page_number(percent)
         end if
         call add_cell(page, verdict)
      end do
      call add_cell(page, row%unit)
      call add_cell(page, row%test//', '//row%window)
   end subroutine add_number

   !> Adds the charts of a test. Changed charts are sorted by the size of the change, and the first six are open. The others
   !> and the unchanged charts are folded. Constant charts are listed in a table.
   subroutine add_test(page, this, test)
      type(page_t), intent(inout) :: page
      type(comparison_t), intent(in) :: this
      integer, intent(in) :: test
      integer, allocatable :: order(:)
      logical :: is_own(size(this%charts)), is_changed(size(this%charts))
      integer :: k, many

      associate (own => this%results(1)%tests(test))
         call begin_section(page, 'test-'//own%name, own%title)
         is_own = this%charts%test == test .and. .not. this%charts%is_level
         is_changed = is_own .and. this%changes%is_changed
         many = count(is_changed)
         call add_text(page, 'p', counted(many, count(is_own), 'charts', this%threshold))
         if (design_row(own%table) > 0) call add_legend(page, [character(1) ::], .true., .false.)
         order = descending(merge(abs(this%changes%change), -1.0_wp, is_changed))
         call add_own_charts(page, this, order(:min(many, principal)))
         if (many > principal) then
            call begin_fold(page, plural(many - principal, 'more chart', 'more charts')//' with a change')
            call add_own_charts(page, this, order(principal + 1:many))
            call end_fold(page)
         end if
         order = pack([(k, k=1, size(is_own))], is_own .and. .not. is_changed)
         if (size(order) > 0) then
            call begin_fold(page, plural(size(order), 'chart', 'charts')//' without a change')
            call add_own_charts(page, this, order)
            call end_fold(page)
         end if
         call add_constants(page, this%charts, test)
      end associate
   end subroutine add_test

   !> Adds charts side by side, each with its largest difference and the magnitude in percent of the scale. The script draws them;
   !> a static page has the pictures drawn by gnuplot.
   !> Without pictures, a static page has no charts.
   subroutine add_own_charts(page, this, numbers)
      type(page_t), intent(inout) :: page
      type(comparison_t), intent(in) :: this
      integer, intent(in) :: numbers(:)
      type(message_list_t) :: names, notes
      integer :: k

      if (size(numbers) == 0) return
      if (this%is_static) then
         if (this%has_pictures) call add_pictures(page, this%charts, numbers, this%folder)
         return
      end if
      do k = 1, size(numbers)
         associate (chart => this%charts(numbers(k)), change => this%changes(numbers(k)))
            call names%add(chart%name)
            if (change%is_known) call notes%add('largest difference '//page_number(change%largest)//' ('// &
               page_number(100*abs(change%change))//' %)')
            if (.not. change%is_known) call notes%add('')
         end associate
      end do
      call add_charts(page, names, notes)
   end subroutine add_own_charts

end module ek_compare_page
