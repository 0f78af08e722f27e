!> The keys of one &case, in the deck's units, and the wheels and drivers to which it refers.
module ek_case_words
   use ek_kinds, only: wp
   use ek_text, only: lower, quoted
   use ek_case, only: case_t
   use ek_record, only: element
   use ek_group, only: wheel_group, joint_group, word_length, note_length, most_loads, did_you_mean
   use ek_deck, only: deck_t
   use ek_draft, only: draft_t, complain, line_of, has_key, look_up, find_card
   implicit none(type, external)
   private
   public :: words_t, read_words, find_driver, find_wheel

   !> The values of the keys of one &case, in the deck's units.
   type :: words_t
      character(word_length) :: name, load(most_loads), drive, wheel, method, test, vertical, phase, quantities, follow
      character(note_length) :: file, target
      real(wp) :: from, to, offset, tolerance
      integer :: increments
   end type words_t

contains

   !> Reads the namelist; a missing key keeps its default value. An unreadable record is reported.
   subroutine read_words(deck, k, draft, words)
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k               !! record of the case
      type(draft_t), intent(inout) :: draft
      type(words_t), intent(out) :: words    !! `test`, `vertical` and `follow` in lower case
      character(word_length) :: name, load(most_loads), drive, wheel, method, test, vertical, phase, quantities, follow
      character(note_length) :: file, target
      real(wp) :: from, to, tolerance, offset
      integer :: increments, status
      namelist /case/ name, load, drive, wheel, from, to, increments, method, tolerance, test, vertical, phase, offset, &
         file, target, quantities, follow
      type(case_t) :: usual

      name = ''
      load = ''
      drive = ''
      wheel = ''
      method = 'equilibrium'
      follow = 'factor'
      test = ''
      vertical = ''
      phase = 'in'
      quantities = 'basic'
      if (has_key(deck, k, 'test')) quantities = 'all'
      file = ''
      target = ''
      from = 0.0_wp
      to = 0.0_wp
      tolerance = usual%tolerance/draft%units%length
      offset = 0.0_wp
      increments = usual%increments
      read (draft%cards(k)%text, nml=case, iostat=status)
      if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')
      words = words_t(name=name, load=load, drive=drive, wheel=wheel, method=method, test=lower(test), vertical=lower(vertical), &
         phase=phase, quantities=quantities, file=file, target=target, from=from, to=to, offset=offset, tolerance=tolerance, &
         increments=increments, follow=lower(follow))
   end subroutine read_words

   !> Finds the driver joint named by a case; reports a mistake if there is none.
   subroutine find_driver(deck, k, draft, name, others, factor)
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      type(draft_t), intent(inout) :: draft
      character(*), intent(in) :: name, others(:)     !! others: other names that may be driven, for suggestions
      real(wp), intent(inout) :: factor               !! deck unit of the driven value → SI; unchanged if not found
      character(word_length), allocatable :: names(:)
      integer :: j, found

      found = find_card(draft, joint_group, name)
      if (found > 0) then
         factor = draft%cards(found)%factor
         if (lower(element(deck%records(found), 'type', 1)) /= 'driver') call complain(draft, deck, k, 'drive', &
            'drive: the joint '//quoted(name)//' in '//line_of(deck, found, k)//' is not a driver')
         return
      end if
      allocate (names(deck%used + size(others)))
      names = ''
      do j = 1, size(others)
         names(deck%used + j) = others(j)
      end do
      do j = 1, deck%used
         if (draft%cards(j)%group /= joint_group) cycle
         if (lower(element(deck%records(j), 'type', 1)) == 'driver') names(j) = draft%cards(j)%name
      end do
      call complain(draft, deck, k, 'drive', 'drive: there is no driver joint '//quoted(name)//did_you_mean(name, names))
   end subroutine find_driver

   !> Finds the wheel named by a case; reports a mistake if there is none, or if the case takes no wheel.
   subroutine find_wheel(deck, k, draft, words, may_have_one, which, this)
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      type(draft_t), intent(inout) :: draft
      type(words_t), intent(in) :: words
      logical, intent(in) :: may_have_one
      character(*), intent(in) :: which      !! the cases that take the key `wheel`, for the message
      type(case_t), intent(inout) :: this    !! receives the number of the wheel
      integer :: found

      call look_up(draft, deck, k, 'wheel', wheel_group, trim(words%wheel), found)
      if (found > 0) this%wheel = draft%cards(found)%index
      if (.not. may_have_one) call complain(draft, deck, k, 'wheel', 'wheel: only a case '//which//' takes this key')
   end subroutine find_wheel

end module ek_case_words
