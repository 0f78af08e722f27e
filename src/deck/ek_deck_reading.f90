!> The state of the reader while a blueprint is made: the records, their names and points, the values of their keys, and the
!> messages about the records. ek_reference looks up the names by which a record refers to other records.
!>
!> `k` is the index of the record that is being read. Messages have the form `file:line: group 'name': error`. A rejected value is
!> treated as not given and replaced by a legal default, so that one error gives one message.
module ek_deck_reading
   use ek_kinds, only: wp, i8, units_t
   use ek_text, only: str, lower, quoted
   use ek_decimal, only: checked_number
   use ek_dimension, only: pure_number, unit_size, unit_name, dimension_of
   use ek_record, only: deck_errors_t, place_in, record_t, entry_index, is_given, place_of, line_text
   use ek_group, only: group_names, record_head, word_length, key_t, find_key
   use ek_choices, only: choices_of
   use ek_number_range, only: is_inside, range_text, acute
   use ek_blueprint, only: blueprint_t
   use ek_parameter, only: parameters_t, add_parameter
   implicit none(type, external)
   private
   public :: deck_reading_t, card_t, complain, complain_of_all, where_of, line_of, has_key
   public :: text_of, texts_of, number_of, numbers_of, whole_of, long_of, switch_of, value_count, choice, choice_among, choose
   public :: refuse, is_second, slot, raw, unit_of

   !> The information about one record.
   type :: card_t
      integer :: group = 0                  !! index of its group; 0: an unknown group, or a group of a study
      character(word_length) :: name = ''
      integer :: hash = 0                   !! hash value of the name in lower case: equal names have equal values
      logical :: is_good = .false.          !! no error found so far
      integer :: index = 0                  !! index among the parts of its kind; point: index of its vector
      !> The dimensions of the keys whose dimension is relative (ek_dimension): of measures, drivers, elements and cases.
      integer :: deflection = pure_number, reaction = pure_number, swept = pure_number
      logical :: is_used = .false.          !! point: referenced; body: attached to something; load: scaled by cases
   end type card_t

   type :: deck_reading_t
      character(:), allocatable :: file         !! path of the deck, for messages
      type(record_t), allocatable :: records(:) !! records of the finished deck, for both sides
      type(card_t), allocatable :: cards(:)     !! the card of each record
      integer :: k = 0                          !! index of the record being read
      type(deck_errors_t) :: deck_errors
      type(units_t) :: units
      type(blueprint_t) :: plan
      type(parameters_t) :: parameters
      real(wp), allocatable :: vectors(:, :)    !! (3, 0:n) values of the blueprint's vectors at design [m, -]; 0: zero
   end type deck_reading_t

contains

   !> Reports an error in record `at` (default: the record being read), at the line of `key` ('': the line of the record).
   subroutine complain(reading, key, what, at)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: key, what
      integer, intent(in), optional :: at
      integer :: k

      k = reading%k
      if (present(at)) k = at
      call reading%deck_errors%add(place_of(reading%records(k), entry_index(reading%records(k), key, 0)), &
         record_head(reading%cards(k)%group, reading%cards(k)%name)//what)
      reading%cards(k)%is_good = .false.
   end subroutine complain

   !> Reports an error for each given key of a list of keys that the record must not have. `why` is the reason in the message.
   subroutine refuse(reading, keys, why)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: keys(:), why
      integer :: k

      do k = 1, size(keys)
         if (has_key(reading, trim(keys(k)))) call complain(reading, trim(keys(k)), trim(keys(k))//': '//why)
      end do
   end subroutine refuse

   !> Reports an error that has no line in the deck.
   subroutine complain_of_all(reading, what)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: what
      call reading%deck_errors%add(place_in(reading%file, 0, 0), what)
   end subroutine complain_of_all

   !> Whether the record being read repeats a group that may occur only once. If so, an error is reported.
   logical function is_second(reading)
      type(deck_reading_t), intent(inout) :: reading
      integer :: first

      first = findloc(reading%cards%group, reading%cards(reading%k)%group, dim=1)
      is_second = first < reading%k
      if (is_second) call complain(reading, '', 'a second &'//trim(group_names(reading%cards(reading%k)%group))// &
         '; the first is in '//line_of(reading, first))
   end function is_second

   !> Location 'file:line' of the record being read.
   pure function where_of(reading) result(place)
      type(deck_reading_t), intent(in) :: reading
      character(:), allocatable :: place
      place = reading%records(reading%k)%file//':'//str(reading%records(reading%k)%line)
   end function where_of

   !> Location of record j for a message about the record being read: 'line 12'; 'line 12 of wheels.nml' if record j is in another
   !> file.
   pure function line_of(reading, j) result(words)
      type(deck_reading_t), intent(in) :: reading
      integer, intent(in) :: j
      character(:), allocatable :: words
      words = line_text(reading%records(j), reading%records(reading%k))
   end function line_of

   !> Whether the record being read contains any element of a key.
   pure logical function has_key(reading, key)
      type(deck_reading_t), intent(in) :: reading
      character(*), intent(in) :: key
      has_key = is_given(reading%records(reading%k), key)
   end function has_key

   !> Index of the entry with element `at` of a key; 0 if the element is not given or was rejected.
   pure integer function entry_of(reading, key, at)
      type(deck_reading_t), intent(in) :: reading
      character(*), intent(in) :: key
      integer, intent(in) :: at

      entry_of = entry_index(reading%records(reading%k), key, at)
      if (entry_of == 0) return
      if (reading%records(reading%k)%entries(entry_of)%is_bad) entry_of = 0
   end function entry_of

   !> The value of an element of a key as written; '' if the element is not given or was rejected.
   pure function raw(reading, key, at) result(text)
      type(deck_reading_t), intent(in) :: reading
      character(*), intent(in) :: key
      integer, intent(in), optional :: at         !! default 1
      character(:), allocatable :: text
      integer :: e, k

      k = 1
      if (present(at)) k = at
      text = ''
      e = entry_of(reading, key, k)
      if (e == 0) return
      associate (entry => reading%records(reading%k)%entries(e))
         text = entry%values(k - entry%first + 1)%text
      end associate
   end function raw

   !> The string of a key; `default` if the key is not given or was rejected.
   pure function text_of(reading, key, default) result(text)
      type(deck_reading_t), intent(in) :: reading
      character(*), intent(in) :: key
      character(*), intent(in), optional :: default     !! default ''
      character(:), allocatable :: text

      text = trim(raw(reading, key))
      if (text == '' .and. present(default)) text = default
   end function text_of

   !> The strings of elements 1 to `most` of a key; blank where an element is not given or was rejected.
   pure function texts_of(reading, key, most) result(texts)
      type(deck_reading_t), intent(in) :: reading
      character(*), intent(in) :: key
      integer, intent(in) :: most
      character(word_length) :: texts(most)
      integer :: k

      do k = 1, most
         texts(k) = raw(reading, key, k)
      end do
   end function texts_of

   !> Element `at` of a number key, in the unit of the deck; `default` if the element is not given or was rejected.
   real(wp) function number_of(reading, key, default, at) result(value)
      type(deck_reading_t), intent(in) :: reading
      character(*), intent(in) :: key
      real(wp), intent(in) :: default
      integer, intent(in), optional :: at         !! default 1
      character(:), allocatable :: text

      value = default
      text = raw(reading, key, at)
      if (text /= '') value = checked_number(text)
   end function number_of

   !> The numbers of elements 1 to `most` of a key, in the unit of the deck; 0 where an element is not given or was rejected.
   function numbers_of(reading, key, most) result(values)
      type(deck_reading_t), intent(in) :: reading
      character(*), intent(in) :: key
      integer, intent(in) :: most
      real(wp) :: values(most)
      integer :: k

      values = [(number_of(reading, key, 0.0_wp, k), k=1, most)]
   end function numbers_of

   !> The integer of element `at` (default 1) of a key; `default` if the element is not given or was rejected.
   integer function whole_of(reading, key, default, at) result(value)
      type(deck_reading_t), intent(in) :: reading
      character(*), intent(in) :: key
      integer, intent(in) :: default
      integer, intent(in), optional :: at
      character(:), allocatable :: text

      value = default
      text = raw(reading, key, at)
      if (text /= '') read (text, *) value
   end function whole_of

   !> The integer of up to 18 digits of a key; `default` if the key is not given or was rejected.
   integer(i8) function long_of(reading, key, default) result(value)
      type(deck_reading_t), intent(in) :: reading
      character(*), intent(in) :: key
      integer(i8), intent(in) :: default
      character(:), allocatable :: text

      value = default
      text = raw(reading, key)
      if (text /= '') read (text, *) value
   end function long_of

   !> The logical value of a key; `default`, or else the default of the table of keys, if the key is not given or was rejected.
   logical function switch_of(reading, key, default) result(value)
      type(deck_reading_t), intent(in) :: reading
      character(*), intent(in) :: key
      logical, intent(in), optional :: default
      character(:), allocatable :: text
      type(key_t) :: row
      logical :: is_known

      if (present(default)) then
         value = default
      else
         call find_key(reading%cards(reading%k)%group, key, row, is_known)
         value = row%default == '.true.'
      end if
      text = raw(reading, key)
      if (text /= '') read (text, *) value
   end function switch_of

   !> The number of values of a key in the record being read, whether given as one list or by subscripts.
   pure integer function value_count(reading, key)
      type(deck_reading_t), intent(in) :: reading
      character(*), intent(in) :: key
      integer :: e

      associate (record => reading%records(reading%k))
         value_count = 0
         do e = 1, record%used                 ! none in '&study /', whose record has no entries
            if (record%entries(e)%key == key) value_count = value_count + record%entries(e)%used
         end do
      end associate
   end function value_count

   !> Finds the index of the string of a key among the strings that the key accepts. Without a string, `number` is `default`, or
   !> else the index of the default of the table of keys, or 0 if there is no default. For a string that is not one of them,
   !> an error is reported and `number` is 0.
   subroutine choice(reading, key, number, default, word)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: key
      integer, intent(out) :: number
      integer, intent(in), optional :: default
      character(:), allocatable, intent(out), optional :: word      !! the string itself; '' if there is none
      character(word_length), allocatable :: words(:)
      type(key_t) :: row
      logical :: is_known

      allocate (words, source=choices_of(reading%cards(reading%k)%group, key))
      call choose(reading, key, text_of(reading, key), words, number)
      call find_key(reading%cards(reading%k)%group, key, row, is_known)
      if (text_of(reading, key) == '') then
         if (row%default /= '') number = findloc(words, row%default, dim=1)
         if (present(default)) number = default
      end if
      if (.not. present(word)) return
      word = trim(row%default)
      if (number > 0) word = trim(words(number))
   end subroutine choice

   !> Finds the index of the string of a key among the strings of the caller, otherwise as `choice`.
   subroutine choice_among(reading, key, choices, number, default)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: key, choices(:)
      integer, intent(out) :: number
      integer, intent(in), optional :: default

      call choose(reading, key, text_of(reading, key), choices, number)
      if (text_of(reading, key) == '' .and. present(default)) number = default
   end subroutine choice_among

   !> Finds the index of a word, which is an element of a key, among the choices. Letter case is ignored. `number` is 0 if the word
   !> is blank; it is also 0, and an error is reported, if the word is not one of the choices.
   subroutine choose(reading, key, word, choices, number)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: key, word, choices(:)
      integer, intent(out) :: number
      character(:), allocatable :: list
      integer :: j

      number = 0
      if (word == '') return
      number = findloc([(lower(choices(j)) == lower(word), j=1, size(choices))], .true., dim=1)
      if (number > 0) return
      list = quoted(trim(choices(1)))
      do j = 2, size(choices)
         list = list//', '//quoted(trim(choices(j)))
      end do
      call complain(reading, key, key//' must be one of '//list//', found '//quoted(word)// &
         imperial_hint(key, word))
   end subroutine choose

   !> A hint if a string is another name of a unit that &model accepts, or a unit that is not supported; otherwise ''.
   pure function imperial_hint(key, word) result(hint)
      character(*), intent(in) :: key, word
      character(:), allocatable :: hint

      hint = ''
      select case (lower(word))
      case ('inch', 'inches', '"')
         if (key == 'length') hint = '; for inches give ''in'''
      case ('lb', 'lbs', 'pound', 'pounds')
         if (key == 'force') hint = '; for pounds-force give ''lbf'''
         if (key == 'mass') hint = '; for pounds give ''lb'''
      case ('lbf')
         if (key == 'mass') hint = '; for pounds give ''lb'''
      case ('ft', 'foot', 'feet', 'kip', 'kips', 'psi', 'slug', 'slugs', 'slinch')
         hint = '; this unit is not supported: convert the parameters of the deck'
      end select
   end function imperial_hint

   !> SI value of the deck's unit of a key of the record being read, by the dimension in the row of the key.
   real(wp) function unit_of(reading, key)
      type(deck_reading_t), intent(in) :: reading
      character(*), intent(in) :: key
      type(key_t) :: row
      logical :: is_known

      call find_key(reading%cards(reading%k)%group, key, row, is_known)
      unit_of = unit_of_row(reading, row)
   end function unit_of

   !> SI value of the deck's unit of a row of the table of keys, in the record being read.
   pure real(wp) function unit_of_row(reading, row)
      type(deck_reading_t), intent(in) :: reading
      type(key_t), intent(in) :: row

      associate (card => reading%cards(reading%k))
         unit_of_row = unit_size(dimension_of(row%dimension, card%deflection, card%reaction, card%swept), reading%units)
      end associate
   end function unit_of_row

   !> Defines parameters: the elements of a number of the record being read, or the first `count` elements of a list, in SI by the
   !> dimension of the key. `number` is the index of the first parameter; 0 if the key is not given and has no default.
   subroutine slot(reading, key, number, default, count)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: key
      integer, intent(out) :: number
      real(wp), intent(in), optional :: default      !! in the unit of the deck; absent: the default of the table of keys, if any
      integer, intent(in), optional :: count         !! default: the least number of values of the key
      type(key_t) :: row
      real(wp) :: usual, unit
      logical :: is_known
      integer :: k, elements

      number = 0
      usual = 0.0_wp
      call find_key(reading%cards(reading%k)%group, key, row, is_known)
      if (present(default)) then
         usual = default
      else if (row%default /= '') then
         usual = checked_number(trim(row%default))
      else if (.not. has_key(reading, key)) then
         return
      end if
      unit = unit_of_row(reading, row)
      elements = row%least
      if (present(count)) elements = count
      number = reading%parameters%used + 1
      do k = 1, elements
         call add_parameter(reading%parameters, reading%records, reading%k, row, k, number_of(reading, key, usual, k)*unit, unit, &
            entry_of(reading, key, k) > 0)
         if (row%range == acute) call check_angle(reading, row)
      end do
   end subroutine slot

   !> Reports the parameter added last if it is an angle outside its range.
   subroutine check_angle(reading, row)
      type(deck_reading_t), intent(inout) :: reading
      type(key_t), intent(in) :: row
      character(:), allocatable :: key

      associate (this => reading%parameters%list(reading%parameters%used), x => reading%parameters%x(reading%parameters%used))
         if (is_inside(acute, x)) return
         key = trim(row%name)
         call complain(reading, key, key//' '//range_text(row%range, row%unit, str(x/this%unit)//' '// &
            unit_name(row%dimension, reading%units)))
      end associate
   end subroutine check_angle

end module ek_deck_reading
