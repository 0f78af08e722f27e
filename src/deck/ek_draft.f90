!> The state of the reader while a blueprint is made: the records and what is known about each, the values of their keys,
!> and the messages about them. ek_reference looks up the names to which they refer.
!>
!> `k` is the record that is being read. Messages have the form `file:line: group 'name': what`. A value that was rejected
!> counts as not given, with a legal default: one mistake, one message.
module ek_draft
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted
   use ek_units, only: units_t
   use ek_record, only: complaints_t, place_in, record_t, entry_index, is_given, place_of, line_words
   use ek_group, only: group_names, record_head, word_length
   use ek_blueprint, only: blueprint_t
   use ek_parameter, only: parameters_t, add_parameter
   implicit none(type, external)
   private
   public :: draft_t, card_t, complain, complain_of_all, where_of, line_of, has_key
   public :: text_of, texts_of, number_of, numbers_of, whole_of, switch_of, value_count, choice, choose
   public :: refuse, is_second, slot

   !> The information about one record.
   type :: card_t
      integer :: group = 0                  !! 0: an unknown group
      character(word_length) :: name = ''
      logical :: is_good = .false.          !! no mistake found so far
      integer :: index = 0                  !! its number among the parts of its kind; of a point, its vector
      real(wp) :: factor = 1.0_wp           !! measure, driver: deck unit → SI
      logical :: is_used = .false.          !! point: referenced; body: attached to something; load: scaled by cases
   end type card_t

   type :: draft_t
      character(:), allocatable :: file         !! of the deck
      type(record_t), allocatable :: records(:) !! mirrored
      type(card_t), allocatable :: cards(:)     !! one per record
      integer :: k = 0                          !! the record being read
      type(complaints_t) :: complaints
      type(units_t) :: units
      type(blueprint_t) :: plan
      type(parameters_t) :: parameters
      real(wp), allocatable :: vectors(:, :)    !! (3, 0:n) present values of those of the blueprint [m, -]; 0: zero
   end type draft_t

contains

   !> Reports a mistake in record `at`, by default the one being read, at the line of `key` ('': the line of the record).
   subroutine complain(draft, key, what, at)
      type(draft_t), intent(inout) :: draft
      character(*), intent(in) :: key, what
      integer, intent(in), optional :: at
      integer :: k

      k = draft%k
      if (present(at)) k = at
      call draft%complaints%add(place_of(draft%records(k), entry_index(draft%records(k), key, 0)), &
         record_head(draft%cards(k)%group, draft%cards(k)%name)//what)
      draft%cards(k)%is_good = .false.
   end subroutine complain

   !> Rejects keys that have no meaning here.
   subroutine refuse(draft, keys, why)
      type(draft_t), intent(inout) :: draft
      character(*), intent(in) :: keys(:), why
      integer :: k

      do k = 1, size(keys)
         if (has_key(draft, trim(keys(k)))) call complain(draft, trim(keys(k)), trim(keys(k))//': '//why)
      end do
   end subroutine refuse

   !> Reports a mistake of the deck as a whole.
   subroutine complain_of_all(draft, what)
      type(draft_t), intent(inout) :: draft
      character(*), intent(in) :: what
      call draft%complaints%add(place_in(draft%file, 0, 0), what)
   end subroutine complain_of_all

   !> Whether a group that may occur once has occurred before; reports it as a mistake.
   logical function is_second(draft)
      type(draft_t), intent(inout) :: draft
      integer :: first

      first = findloc(draft%cards%group, draft%cards(draft%k)%group, dim=1)
      is_second = first < draft%k
      if (is_second) call complain(draft, '', 'a second &'//trim(group_names(draft%cards(draft%k)%group))// &
         '; the first is in '//line_of(draft, first))
   end function is_second

   !> 'file:line' of the record being read.
   pure function where_of(draft) result(place)
      type(draft_t), intent(in) :: draft
      character(:), allocatable :: place
      place = draft%records(draft%k)%file//':'//str(draft%records(draft%k)%line)
   end function where_of

   !> 'line 12' of record j, for a message about the record being read.
   pure function line_of(draft, j) result(words)
      type(draft_t), intent(in) :: draft
      integer, intent(in) :: j
      character(:), allocatable :: words
      words = line_words(draft%records(j), draft%records(draft%k))
   end function line_of

   !> Whether the record being read contains any element of a key.
   pure logical function has_key(draft, key)
      type(draft_t), intent(in) :: draft
      character(*), intent(in) :: key
      has_key = is_given(draft%records(draft%k), key)
   end function has_key

   !> The entry with element `at` of a key; 0 if it is not given or was rejected.
   pure integer function entry_of(draft, key, at)
      type(draft_t), intent(in) :: draft
      character(*), intent(in) :: key
      integer, intent(in) :: at

      entry_of = entry_index(draft%records(draft%k), key, at)
      if (entry_of == 0) return
      if (draft%records(draft%k)%entries(entry_of)%is_bad) entry_of = 0
   end function entry_of

   !> The text of an element of a key as written, '' if it is not given or was rejected.
   pure function raw(draft, key, at) result(text)
      type(draft_t), intent(in) :: draft
      character(*), intent(in) :: key
      integer, intent(in), optional :: at         !! usually 1
      character(:), allocatable :: text
      integer :: e, k

      k = 1
      if (present(at)) k = at
      text = ''
      e = entry_of(draft, key, k)
      if (e == 0) return
      associate (entry => draft%records(draft%k)%entries(e))
         text = entry%values(k - entry%first + 1)%text
      end associate
   end function raw

   !> A text.
   pure function text_of(draft, key, default) result(text)
      type(draft_t), intent(in) :: draft
      character(*), intent(in) :: key
      character(*), intent(in), optional :: default     !! usually ''
      character(:), allocatable :: text

      text = trim(raw(draft, key))
      if (text == '' .and. present(default)) text = default
   end function text_of

   !> A list of texts, blank where not given.
   pure function texts_of(draft, key, most) result(texts)
      type(draft_t), intent(in) :: draft
      character(*), intent(in) :: key
      integer, intent(in) :: most
      character(word_length) :: texts(most)
      integer :: k

      do k = 1, most
         texts(k) = raw(draft, key, k)
      end do
   end function texts_of

   !> A number in the unit of the deck.
   real(wp) function number_of(draft, key, default, at) result(value)
      type(draft_t), intent(in) :: draft
      character(*), intent(in) :: key
      real(wp), intent(in) :: default
      integer, intent(in), optional :: at         !! usually 1
      character(:), allocatable :: text

      value = default
      text = raw(draft, key, at)
      if (text /= '') read (text, *) value
   end function number_of

   !> Some numbers, 0 where not given.
   function numbers_of(draft, key, most) result(values)
      type(draft_t), intent(in) :: draft
      character(*), intent(in) :: key
      integer, intent(in) :: most
      real(wp) :: values(most)
      integer :: k

      values = [(number_of(draft, key, 0.0_wp, k), k=1, most)]
   end function numbers_of

   !> A whole number.
   integer function whole_of(draft, key, default, at) result(value)
      type(draft_t), intent(in) :: draft
      character(*), intent(in) :: key
      integer, intent(in) :: default
      integer, intent(in), optional :: at
      character(:), allocatable :: text

      value = default
      text = raw(draft, key, at)
      if (text /= '') read (text, *) value
   end function whole_of

   !> .true. or .false.
   logical function switch_of(draft, key, default) result(value)
      type(draft_t), intent(in) :: draft
      character(*), intent(in) :: key
      logical, intent(in) :: default
      character(:), allocatable :: text

      value = default
      text = raw(draft, key)
      if (text /= '') read (text, *) value
   end function switch_of

   !> The number of values of a key, however they are written.
   pure integer function value_count(draft, key)
      type(draft_t), intent(in) :: draft
      character(*), intent(in) :: key
      integer :: e

      associate (record => draft%records(draft%k))
         value_count = sum(record%entries(:record%used)%used, [(record%entries(e)%key == key, e=1, record%used)])
      end associate
   end function value_count

   !> The index of a keyword among the choices; 0 if it is not given and has no default, or, with a message, if it is none of them.
   subroutine choice(draft, key, choices, number, default)
      type(draft_t), intent(inout) :: draft
      character(*), intent(in) :: key, choices(:)
      integer, intent(out) :: number
      integer, intent(in), optional :: default

      call choose(draft, key, text_of(draft, key), choices, number)
      if (text_of(draft, key) == '' .and. present(default)) number = default
   end subroutine choice

   !> The index of a word, element of a key, among the choices.
   subroutine choose(draft, key, word, choices, number)
      type(draft_t), intent(inout) :: draft
      character(*), intent(in) :: key, word, choices(:)
      integer, intent(out) :: number
      character(:), allocatable :: list
      integer :: j

      number = 0
      if (word == '') return
      number = findloc([(lower(choices(j)) == lower(word), j=1, size(choices))], .true., dim=1)
      if (number > 0) return
      list = quoted(choices(1))
      do j = 2, size(choices)
         list = list//', '//quoted(choices(j))
      end do
      call complain(draft, key, key//' must be one of '//list//', found '//quoted(word))
   end subroutine choose

   !> Makes a number of the record being read, or the first `count` elements of a list, parameters; `number` is that of the first,
   !> 0 if the key is not given and has no default.
   subroutine slot(draft, key, unit, number, default, count)
      type(draft_t), intent(inout) :: draft
      character(*), intent(in) :: key
      real(wp), intent(in) :: unit                   !! SI value of the unit in the deck
      integer, intent(out) :: number
      real(wp), intent(in), optional :: default      !! in the unit of the deck; absent: the key has none
      integer, intent(in), optional :: count         !! usually 1
      real(wp) :: usual
      integer :: k, elements

      number = 0
      usual = 0.0_wp
      if (present(default)) usual = default
      if (.not. present(default) .and. .not. has_key(draft, key)) return
      elements = 1
      if (present(count)) elements = count
      number = draft%parameters%used + 1
      do k = 1, elements
         call add_parameter(draft%parameters, draft%records, draft%k, key, k, number_of(draft, key, usual, k)*unit, unit, &
            entry_of(draft, key, k) > 0)
      end do
   end subroutine slot

end module ek_draft
