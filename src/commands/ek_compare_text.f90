!> What `compare` prints on standard output: the changes of key numbers and curves, the gradients, and the differences of the decks.
module ek_compare_text
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str, plural
   use ek_buffer, only: buffer_t
   use ek_file, only: join_path
   use ek_change, only: change_of, verdict_of, letter_of
   use ek_compare_charts, only: between_states
   use ek_comparison, only: comparison_t, descending, difference, percent
   use ek_deck_difference, only: deck_difference_t, few_changes, difference_size, given, step_text
   use ek_compare_targets, only: target_lines
   use ek_compare_sentence, only: sentences_of
   use ek_compare_page, only: verdicts
   use ek_verdict, only: plain
   implicit none(type, external)
   private
   public :: text_of

contains

   !> The string for standard output: one sentence for each result after A, the paths of the results, the differences of the decks, the counts of changes, the values and
   !> verdicts of the targets, the largest differences of curves, and the table of gradients. Many differences of the decks are last.
   function text_of(this, is_short) result(text)
      type(comparison_t), intent(in) :: this
      logical, intent(in) :: is_short              !! only gradients that changed, or are in some of the results only, are listed
      character(:), allocatable :: text
      type(message_list_t) :: lines
      type(buffer_t) :: out
      integer :: k, r

      call sentences_of(this, lines)
      do k = 1, lines%count()
         call out%line(lines%line(k))
      end do
      call out%line('')
      do r = 1, size(this%results)
         call out%line(letter_of(r)//': '//this%results(r)%path)
      end do
      call out%line('')
      if (size(this%deck) <= few_changes) call add_changes(out, this%facts, this%deck, this%folder)
      call verdicts(this, lines)
      do k = 1, lines%count()
         call out%line(lines%line(k))
      end do
      call target_lines(this%targets, lines)
      do k = 1, lines%count()
         call out%line(plain(lines%line(k)))
      end do
      call add_curves(out, this)
      if (size(this%rows) == 0) then
         call out%line('no gradients to compare')
      else
         call add_gradients(out, this, is_short)
      end if
      if (size(this%deck) > few_changes) then
         call out%line('')
         call add_changes(out, this%facts, this%deck, this%folder)
      end if
      text = out%text()
   end function text_of

   !> Adds the curves with the largest differences above the threshold, at most five: 'Toe, test parallel_travel, right: 0.377 at -80,
   !> deg (+ front edge inward)'.
   subroutine add_curves(out, this)
      type(buffer_t), intent(inout) :: out
      type(comparison_t), intent(in) :: this
      integer, parameter :: most = 5
      real(wp) :: sizes(size(this%curves))
      integer :: order(size(this%curves)), k

      sizes = -1.0_wp
      where (ieee_is_finite(this%curves%change)) sizes = abs(this%curves%change)
      order = descending(sizes)
      do k = 1, min(size(order), most)
         associate (curve => this%curves(order(k)))
            if (.not. sizes(order(k)) > this%threshold) exit
            if (k == 1) call out%line('largest differences of curves:')
            call out%add('  '//curve%title)
            if (curve%curve /= '') call out%add(', '//curve%curve)
            call out%add(': '//str(curve%largest, 4)//' at '//str(curve%at, 4)//' (test '//curve%test)
            if (size(this%results) > 2) call out%add(', '//letter_of(curve%result)//' less A')
            if (curve%compared == between_states) call out%add(', ≈ between states')
            call out%line('), '//curve%label(:index(curve%label//'  ', '  ') - 1))
         end associate
      end do
   end subroutine add_curves

   !> Adds lines such as 'Deck checksum: 12ab → 34cd' or 'point.seat.y: -500 → -520 (-20)'. Of more than 20 values, the 20 largest
   !> differences are added, and the file with the whole list.
   subroutine add_changes(out, facts, values, folder)
      type(buffer_t), intent(inout) :: out
      type(deck_difference_t), intent(in) :: facts(:), values(:)
      character(*), intent(in) :: folder           !! folder of deck-differences.csv
      integer :: k, order(size(values))

      do k = 1, size(facts)
         call add_change(facts(k))
      end do
      if (size(values) > 0) call out%line(plural(size(values), 'parameter of the deck differs:', 'parameters of the deck differ:'))
      order = [(k, k=1, size(values))]
      if (size(values) > few_changes) order = descending([(difference_size(values(k)), k=1, size(values))])
      do k = 1, min(size(values), few_changes)
         call add_change(values(order(k)))
      end do
      if (size(values) > few_changes) call out%line('these are the '//str(few_changes)//' largest; '// &
         join_path(folder, 'deck-differences.csv')//' contains all')
      if (size(facts) + size(values) > 0) call out%line('')

   contains

      !> Adds one line with the values of all results.
      subroutine add_change(change)
         type(deck_difference_t), intent(in) :: change
         character(:), allocatable :: step
         integer :: r

         call out%add(change%path//': '//given(change%texts%line(1)))
         do r = 2, change%texts%count()
            call out%add(' → '//given(change%texts%line(r)))
         end do
         step = ''
         if (change%texts%count() == 2) step = step_text(change%texts%line(1), change%texts%line(2))
         if (step /= '') call out%add(' ('//step//')')
         if (change%sides /= '') call out%add(', '//change%sides)
         call out%line('')
      end subroutine add_change

   end subroutine add_changes

   !> Adds the table of gradients.
   subroutine add_gradients(out, this, is_short)
      type(buffer_t), intent(inout) :: out
      type(comparison_t), intent(in) :: this
      logical, intent(in) :: is_short              !! without gradients that are the same or have no value
      character(:), allocatable :: test
      character(16) :: verdicts(size(this%results))
      integer :: k, r

      test = ''
      do k = 1, size(this%rows)
         associate (row => this%rows(k))
            verdicts(1) = 'same'
            do r = 2, size(this%results)
               verdicts(r) = verdict_of(change_of(row%values(1), row%values(r), row%least, row%unit), this%threshold, &
                  row%is_there(1), row%is_there(r), r)
            end do
            if (is_short .and. all(verdicts == 'same' .or. verdicts == 'not a number')) cycle
            if (row%test /= test) then
               test = row%test
               call out%line('')
               call out%add(padded(test, -42)//padded('A', 12))
               do r = 2, size(this%results)
                  call out%add(padded(letter_of(r), 12)//padded('difference', 12)//padded('percent', 9))
               end do
               call out%line('  unit')
            end if
            call out%add(padded(trim(row%quantity//' '//row%side), -42)//number_text(row%values(1), 6, 12))
            do r = 2, size(this%results)
               call out%add(number_text(row%values(r), 6, 12)//number_text(difference(row%values(1), row%values(r)), 4, 12)// &
                  number_text(percent(row%values(1), row%values(r), row%unit), 3, 9))
            end do
            call out%add('  '//padded(row%unit, -12))
            do r = 2, size(this%results)
               call out%add(' '//trim(verdicts(r)))
            end do
            call out%line('')
         end associate
      end do
   end subroutine add_gradients

   !> A number for the table on the terminal; '-' for a missing value.
   pure function number_text(value, digits, width) result(text)
      real(wp), intent(in) :: value
      integer, intent(in) :: digits, width
      character(:), allocatable :: text

      text = str(value, digits)
      if (text == 'not a number') text = '-'
      text = padded(text, width)
   end function number_text

   !> A string with blanks in front to fill a width; with a negative width, the blanks follow the string. At least one blank is
   !> added.
   pure function padded(text, width) result(filled)
      character(*), intent(in) :: text
      integer, intent(in) :: width
      character(:), allocatable :: filled, blanks

      blanks = repeat(' ', max(1, abs(width) - len(text)))
      filled = blanks//text
      if (width < 0) filled = text//blanks
   end function padded

end module ek_compare_text
