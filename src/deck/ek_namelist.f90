!> Checks one record against the table of groups: keys, types, counts, subscripts and ranges. Checks the name of a record: an
!> illegal character is an error. The name of an element, a measure or a joint is also an error if one of its columns would have the
!> name of a quantity. input/README.md lists these names.
!>
!> The values are read by ek_deck_reading from the entries that pass. The compiler's namelist read is not used: it silently accepts
!> too few values, a key given twice, `nan` and `1e999`.
module ek_namelist
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted, plural
   use ek_decimal, only: checked_number
   use ek_letters, only: bad_byte, visible
   use ek_quantity, only: column_of_stem
   use ek_record, only: deck_errors_t, record_t, entry_t, value_t, entry_index, is_given, place_of
   use ek_number_range, only: is_inside, range_text, any_number, acute
   use ek_group, only: key_t, keys, find_key, unknown_key, longest, number, &
      whole, long_whole
   implicit none(type, external)
   private
   public :: check_record, value_fault, surplus, name_fault, is_legal_name

   integer, parameter :: largest_exponent = 30      !! numbers from 1e30 are errors and could overflow later
   integer, parameter :: smallest_exponent = -100   !! nonzero numbers below 1e-100 are errors too; some would be read as 0
   character(*), parameter :: digits = '0123456789'
   character(*), parameter :: no_break_space = char(194)//char(160)
   character(*), parameter :: types(long_whole) = [character(18) :: 'a string in quotes', 'a string in quotes', 'a number', &
      'an integer', '.true. or .false.', 'a string in quotes', 'an integer']

contains

   !> Checks one record and marks the entries that are rejected.
   subroutine check_record(record, group, head, deck_errors, is_good)
      type(record_t), intent(inout) :: record
      integer, intent(in) :: group
      character(*), intent(in) :: head                        !! "bushing 'top_mount': " for messages
      type(deck_errors_t), intent(inout) :: deck_errors
      logical, intent(out) :: is_good
      type(key_t) :: key
      logical :: is_known
      integer :: k

      is_good = .true.
      do k = 1, record%used
         call find_key(group, record%entries(k)%key, key, is_known)
         if (is_known) then
            record%entries(k)%is_bad = .not. fits()
         else
            call complain(k, unknown_key(group, record%entries(k)%key))
         end if
      end do
      do k = 1, size(keys)
         if (keys(k)%group /= group .or. .not. keys(k)%is_required) cycle
         if (.not. is_given(record, keys(k)%name)) call complain(0, quoted(keys(k)%name)//' is missing')
      end do

   contains

      !> Whether the type, the number and the values of entry k fit its key. If not, an error is reported.
      logical function fits()
         character(:), allocatable :: name, fault
         logical :: is_same(record%used)
         integer :: given, first, last, j

         fits = .false.
         associate (entry => record%entries(k))
            name = trim(key%name)
            last = entry%first + entry%used - 1
            is_same = [(record%entries(j)%key == entry%key, j=1, record%used)]
            given = sum(record%entries(:record%used)%used, is_same)    ! kt(1)=… kt(2)=… are counted together
            first = findloc(is_same, .true., dim=1)                    ! and checked at the first one
            if (entry%used == 0) then    ! reported by the scanner
               is_good = .false.
               return
            else if (last > key%most .and. entry%first > 1) then
               fault = name//' has '//plural(key%most, 'element', 'elements')//', found element '//str(last)
            else if (last > key%most) then
               fault = name//' '//needs(key)//', found '//str(given)//surplus(key, entry)
            else if (given < key%least .and. first == k) then
               fault = name//' '//needs(key)//', found '//str(given)
            else
               fault = ''
               if (entry%first > 1 .and. given >= key%least) then     ! lists start at their first element and have no gaps
                  if (entry_index(record, entry%key, entry%first - 1) == 0) fault = name//element_text(key, entry%first - 1)// &
                     ' is missing, found '//name//element_text(key, entry%first)
               end if
               do j = 1, entry%used
                  if (fault /= '') exit
                  fault = value_fault(entry%values(j), key%type)
                  if (fault /= '') fault = name//element_text(key, entry%first + j - 1)//' must be '//fault
               end do
            end if
            fits = fault == ''
            if (.not. fits) call complain(k, fault)
            if (.not. fits .or. key%type /= number) return
            do j = 1, entry%used      ! each number outside its range is reported
               fault = out_of_range(key, entry, j)
               if (fault == '') cycle
               call complain(k, fault)
               fits = .false.
               if (key%least /= key%most) return
            end do
         end associate
      end function fits

      !> Reports an error in one entry of the record.
      subroutine complain(entry, what)
         integer, intent(in) :: entry
         character(*), intent(in) :: what

         call deck_errors%add(place_of(record, entry), head//what)
         is_good = .false.
      end subroutine complain

   end subroutine check_record

   !> Message about a number outside the range of its key: 'kt(2) must be 0 or more, found -1'; '' if the number is in the range.
   function out_of_range(key, entry, k) result(words)
      type(key_t), intent(in) :: key
      type(entry_t), intent(in) :: entry
      integer, intent(in) :: k               !! index of the value in the entry
      character(:), allocatable :: words
      real(wp) :: value

      words = ''
      if (key%range == any_number) return
      if (key%range == acute) return         ! here the unit of angles is unknown: `slot` of ek_deck_reading examines it
      value = checked_number(entry%values(k)%text)
      if (is_inside(key%range, value)) return
      if (key%least == key%most) words = element_text(key, entry%first + k - 1)
      words = trim(key%name)//words//' '//range_text(key%range, key%unit, str(value))
   end function out_of_range

   !> Phrase about the number of values that a key requires: 'needs 3 values'.
   pure function needs(key) result(words)
      type(key_t), intent(in) :: key
      character(:), allocatable :: words

      words = 'needs '//str(key%least)//' to '//str(key%most)//' values'
      if (key%least == key%most) words = 'needs '//plural(key%least, 'value', 'values')
   end function needs

   !> Hint about surplus values: a comment that begins with #, a repeated value, decimal commas, a blank between thousands, a
   !> no-break space, or a missing = after a word that may be a key; otherwise ''.
   function surplus(key, entry) result(words)
      type(key_t), intent(in) :: key
      type(entry_t), intent(in) :: entry
      character(:), allocatable :: words
      integer :: j

      words = ''
      do j = 1, entry%used
         associate (value => entry%values(j))
            if (value%is_string .or. value%is_empty) cycle
            if (value%text(:1) == '#') words = ' (a comment begins with !, not #)'
            if (index(value%text, no_break_space) > 0) words = ' ('//quoted(visible(value%text))// &
               ' contains a no-break space; type blanks)'
         end associate
         if (words /= '') return
      end do
      do j = 2, entry%used
         associate (value => entry%values(j), before => entry%values(j - 1)%text)
            if (value%is_string .or. value%is_empty) cycle
            if (scan(lower(value%text(:1)), 'abcdefghijklmnopqrstuvwxyz') == 1 .and. j < entry%used) then
               ! an unclosed string leaves no numbers
               if (.not. entry%values(j + 1)%is_string .and. scan(entry%values(j + 1)%text, digits) == 0) cycle
               words = ' (is the = after '//quoted(value%text)//' missing?)'
               return
            end if
            if (key%type /= number .or. verify(value%text, digits) > 0) cycle
            if (before == '' .or. verify(before, '+-'//digits) > 0) cycle
            if (is_decimal_comma(j)) then
               words = ' (a decimal comma? Write '//before//'.'//value%text//', not '//before//','//value%text//')'
               return
            end if
         end associate
      end do
      if (count(entry%values(:entry%used)%before == '*') > 0) words = ' (n*value stands for n values)'
      if (entry%used /= 2 .or. key%most /= 1 .or. key%type /= number) return
      associate (first => entry%values(1)%text, last => entry%values(2))
         if (last%before == ' ' .and. len(last%text) == 3 .and. verify(last%text, digits) == 0 .and. is_signed(first)) &
            words = ' (write '//first//last%text//' without a blank or comma)'
      end associate

   contains

      !> Whether the comma before value j may be decimal: without blanks around it, where other values are separated in another way
      !> or every second comma is decimal.
      pure logical function is_decimal_comma(j)
         integer, intent(in) :: j
         integer :: i, tight

         tight = count(entry%values(2:entry%used)%before == ',')
         is_decimal_comma = entry%values(j)%before == ','
         if (tight == entry%used - 1 .and. entry%used > 2) then
            is_decimal_comma = is_decimal_comma .and. entry%used == 2*key%most .and. modulo(j, 2) == 0 .and. &
               all([(verify(entry%values(i)%text, digits), i=2, entry%used, 2)] == 0)
         else
            is_decimal_comma = is_decimal_comma .and. tight >= entry%used - key%most
         end if
      end function is_decimal_comma

   end function surplus

   !> The index of an element as written, '(2)'; '' for a key with one element.
   pure function element_text(key, at) result(words)
      type(key_t), intent(in) :: key
      integer, intent(in) :: at
      character(:), allocatable :: words
      words = ''
      if (key%most > 1) words = '('//str(at)//')'
   end function element_text

   !> Phrase about a value that does not fit its type: 'a number, found …'; '' if the value fits.
   pure function value_fault(value, type) result(fault)
      type(value_t), intent(in) :: value
      integer, intent(in) :: type
      character(:), allocatable :: fault
      logical :: is_fit

      fault = ''
      if (value%is_empty) then
         fault = trim(types(type))//', found nothing between the commas'
      else if (longest(type) > 0) then
         if (.not. value%is_string) then
            fault = trim(types(type))//', found '//value%text//' without quotes'//quote_hint(value%text)
         else if (len(value%text) > longest(type)) then
            fault = 'at most '//str(longest(type))//' characters long, found '//str(len(value%text))
         else if (value%text == '') then
            fault = trim(types(type))//', found an empty string'
         else if (bad_byte(value%text) > 0) then
            fault = 'UTF-8 text, found '//quoted(value%text)//'; save the file as UTF-8'
         end if
      else if (value%is_string) then
         fault = trim(types(type))//', found the string '//quoted(value%text)
      else
         select case (type)
         case (number)
            is_fit = is_number(value%text)
         case (whole, long_whole)
            is_fit = is_signed(value%text) .and. len(value%text) - scan(value%text(:1), '+-') <= merge(9, 18, type == whole)
         case default
            is_fit = any(lower(value%text) == [character(7) :: '.true.', '.false.', 'true', 'false', '.t.', '.f.', 't', 'f'])
         end select
         if (.not. is_fit) then
            fault = trim(types(type))//', found '//value%text
            if (type == number) fault = fault//number_hint(value%text)
            if (any(type == [whole, long_whole]) .and. is_signed(value%text)) fault = 'an integer of at most '// &
               trim(merge('9 ', '18', type == whole))//' digits, found '//value%text
         else if (type == number) then
            if (size_exponent(value%text) >= largest_exponent) then
               fault = 'a number below 1e'//str(largest_exponent)//', found '//value%text
            else if (size_exponent(value%text) < smallest_exponent) then
               fault = '0 or a number above 1e'//str(smallest_exponent)//', found '//value%text
            end if
         end if
      end if
   end function value_fault

   !> A hint if a string begins with a typographic quote; otherwise ''.
   pure function quote_hint(text) result(words)
      character(*), intent(in) :: text
      character(:), allocatable :: words
      character(*), parameter :: quotes(7) = ['‘', '’', '‚', '“', '”', '„', '´ ']
      integer :: k

      words = ''
      if (any([(index(text, trim(quotes(k))) == 1, k=1, size(quotes))])) words = " (write straight quotes: ' or "")"
   end function quote_hint

   !> A hint about a typographic minus sign, a semicolon or a no-break space in a number; otherwise ''.
   pure function number_hint(text) result(words)
      character(*), intent(in) :: text
      character(:), allocatable :: words

      words = ''
      if (index(text, '−') == 1 .or. index(text, '–') == 1) then
         words = ' (write the minus sign as -)'
      else if (index(text, ';') > 0) then
         words = ' (separate values by commas or blanks)'
      else if (index(text, no_break_space) > 0) then
         words = ' (contains a no-break space; type blanks)'
      end if
   end function number_hint

   !> Whether a string consists of digits with an optional sign.
   pure logical function is_signed(text)
      character(*), intent(in) :: text
      integer :: first

      first = 1
      if (scan(text, '+-') == 1) first = 2
      is_signed = len(text) >= first .and. verify(text(first:), digits) == 0
   end function is_signed

   !> Whether a string is a number: [sign] digits [. digits] [e|d [sign] digits], with at least one digit before the exponent.
   pure logical function is_number(text)
      character(*), intent(in) :: text
      character(:), allocatable :: mantissa
      integer :: mark

      mark = scan(text//'e', 'eEdD')
      mantissa = text(:mark - 1)
      if (scan(mantissa, '+-') == 1) mantissa = mantissa(2:)
      is_number = scan(mantissa, digits) > 0 .and. verify(mantissa, digits//'.') == 0 .and. &
         index(mantissa, '.') == index(mantissa, '.', back=.true.)
      if (mark <= len(text)) is_number = is_number .and. is_signed(text(mark + 1:))
   end function is_number

   !> The power of ten of the first nonzero digit of a well-formed number; 0 for zero.
   pure integer function size_exponent(text) result(power)
      character(*), intent(in) :: text
      integer :: mark, dot, lead, status

      mark = scan(text//'e', 'eEdD')
      power = 0
      if (mark <= len(text)) then
         status = 1
         if (len(text) - mark < 8) read (text(mark + 1:), *, iostat=status) power
         if (status /= 0) power = merge(-9999999, 9999999, text(mark + 1:mark + 1) == '-')
      end if
      dot = index(text(:mark - 1)//'.', '.')
      lead = scan(text(:mark - 1), '123456789')
      power = power + dot - lead
      if (lead < dot) power = power - 1
      if (lead == 0) power = 0
   end function size_exponent

   !> Whether a name begins with a letter and contains only letters, digits and _. Names appear in messages, paths and
   !> column headings.
   pure logical function is_legal_name(name)
      character(*), intent(in) :: name
      character(*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyz'
      is_legal_name = verify(lower(name), letters//'0123456789_') == 0 .and. scan(lower(name), letters) == 1
   end function is_legal_name

   !> The message for an illegal name. A leading or trailing blank is shown.
   pure function illegal_name(name) result(words)
      character(*), intent(in) :: name     !! as written in the deck
      character(:), allocatable :: words

      words = 'a name must begin with a letter and contain only letters, digits and _'
      if (len(name) == 0) return
      if (name(len(name):) == ' ') then
         words = words//", found '"//visible(trim(name))//"<U+0020>'; remove the trailing blank"
      else if (name(:1) == ' ') then
         words = words//", found '<U+0020>"//visible(trim(adjustl(name)))//"'; remove the leading blank"
      end if
   end function illegal_name

   !> The message for an illegal or reserved name; '' if the name is allowed.
   pure function name_fault(name, has_results) result(words)
      character(*), intent(in) :: name
      logical, intent(in) :: has_results       !! records of its group have columns in the results
      character(*), parameter :: rate = '_per'
      character(:), allocatable :: words, head, column
      integer :: mark

      words = ''
      if (.not. is_legal_name(name)) words = illegal_name(name)
      if (words /= '') return
      select case (lower(name))
      case ('chassis', 'ground')
         words = 'the name is reserved for the fixed body'
         return
      case ('wheel_travel')
         words = "the name is reserved: drive = 'wheel_travel' prescribes the height of a wheel (column wheel_travel_mm)"
         return
      end select
      if (index(lower(name), 'rig_') == 1) then
         words = 'the name is reserved: names of the test rig begin with rig_, as in the column rig_left_height_reaction_n'
         return
      end if
      if (.not. has_results) return
      mark = index(lower(name), rate, back=.true.)
      if (mark > 1 .and. mark == len(name) - len(rate) + 1) then
         words = 'the name is reserved: names of rates end in _per, as in the column wheel_rate_n_per_mm'
         return
      end if
      head = ''
      if (index(lower(name), 'left_') == 1) head = 'left_'
      if (index(lower(name), 'right_') == 1) head = 'right_'
      column = column_of_stem(lower(name(len(head) + 1:)))
      if (column /= '') words = 'the name is reserved: the results have a column '//head//column
   end function name_fault

end module ek_namelist
