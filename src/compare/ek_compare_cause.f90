!> The cause of the differences between two results: the values of their decks that differ, and settings of the runs that differ.
module ek_compare_cause
   use ek_text, only: str, plural
   use ek_deck_file, only: deck_record_t
   use ek_deck_difference, only: deck_difference_t, difference_size, given, step_text
   use ek_comparison, only: descending
   use ek_report_files, only: results_t, test_number
   implicit none(type, external)
   private
   public :: cause_text, settings_text

   integer, parameter :: most_causes = 3

contains

   !> The cause: the values of the deck that differ, the largest difference first: '; cause: tie_rod_inner.z +5 mm'.
   function cause_text(results, deck, r) result(text)
      type(results_t), intent(in) :: results(:)
      type(deck_difference_t), intent(in) :: deck(:)       !! values that differ
      integer, intent(in) :: r
      character(:), allocatable :: text
      integer, allocatable :: order(:)
      integer :: k, shown, many

      text = ''
      if (.not. (results(1)%deck%is_known .and. results(r)%deck%is_known)) then
         text = '; cause not known: no deck.csv'
         return
      end if
      many = count([(is_cause(deck(k), r), k=1, size(deck))])
      if (many == 0) return
      text = '; '//trim(merge('cause: ', 'causes:', many == 1))//' '
      order = descending([(difference_size(deck(k)), k=1, size(deck))])
      shown = 0
      do k = 1, size(order)
         if (.not. is_cause(deck(order(k)), r)) cycle
         if (shown == most_causes) exit
         if (shown > 0) text = text//', '
         text = text//step_of(deck(order(k)), r, length_unit(results(1)%deck))
         shown = shown + 1
      end do
      if (many > shown) text = text//' and '//plural(many - shown, 'more value', 'more values')
   end function cause_text

   !> Whether a value of the deck differs in result r and changes the model.
   logical function is_cause(value, r)
      type(deck_difference_t), intent(in) :: value
      integer, intent(in) :: r

      is_cause = value%texts%line(1) /= value%texts%line(r) .and. .not. is_setting(value%path)
   end function is_cause

   !> Whether a value of the deck is a setting of the run, its tests or its report, not of the model.
   pure logical function is_setting(path)
      character(*), intent(in) :: path

      is_setting = path == 'axle.class' .or. index(path, 'case.') == 1 .or. index(path, 'model.start') == 1 .or. &
         index(path, 'model.balance') == 1 .or. index(path, 'target_band.') == 1
   end function is_setting

   !> A difference as a phrase: 'tie_rod_inner.z +5 mm' of a point, otherwise 'spring.coil.rate 29.77 → 35.72'.
   function step_of(value, r, unit) result(text)
      type(deck_difference_t), intent(in) :: value
      integer, intent(in) :: r
      character(*), intent(in) :: unit                 !! of lengths
      character(:), allocatable :: text, step

      text = value%path
      step = ''
      if (index(text, 'point.') == 1) step = step_text(value%texts%line(1), value%texts%line(r))
      if (step /= '') then
         text = text(len('point.') + 1:)//' '//step//' '//unit
      else
         text = text//' '//given(value%texts%line(1))//' → '//given(value%texts%line(r))
      end if
   end function step_of

   !> The unit of lengths of a deck.
   pure function length_unit(deck) result(unit)
      type(deck_record_t), intent(in) :: deck
      character(:), allocatable :: unit
      integer :: k

      unit = 'mm'
      do k = 1, deck%paths%count()
         if (deck%paths%line(k) == 'model.length') unit = deck%texts%line(k)
      end do
   end function length_unit

   !> The settings that differ: '; other settings: axle.class car → sports, states of parallel_travel 33 → 17'; '' if there are none.
   function settings_text(results, deck, facts, r) result(text)
      type(results_t), intent(in) :: results(:)
      type(deck_difference_t), intent(in) :: deck(:), facts(:)     !! values of the decks and facts of the runs that differ
      integer, intent(in) :: r
      character(:), allocatable :: text
      integer :: k, t, states(2)

      text = ''
      do k = 1, size(deck)
         if (deck(k)%texts%line(1) == deck(k)%texts%line(r) .or. .not. is_setting(deck(k)%path)) cycle
         call add(step_of(deck(k), r, ''))
      end do
      do k = 1, size(facts)
         if (facts(k)%path /= 'Program' .or. facts(k)%texts%line(1) == facts(k)%texts%line(r)) cycle
         call add('program '//facts(k)%texts%line(1)//' → '//facts(k)%texts%line(r))
      end do
      do k = 1, size(results(1)%tests)            ! the first test with other states stands for all
         t = test_number(results(r), results(1)%tests(k)%name)
         if (t == 0) cycle
         states = [size(results(1)%tests(k)%table%values, 2), size(results(r)%tests(t)%table%values, 2)]
         if (states(1) == states(2)) cycle
         call add('states of '//results(1)%tests(k)%name//' '//str(states(1))//' → '//str(states(2)))
         exit
      end do
      if (text /= '') text = '; other settings: '//text

   contains

      subroutine add(words)
         character(*), intent(in) :: words

         if (text /= '') text = text//', '
         text = text//words
      end subroutine add

   end function settings_text

end module ek_compare_cause
