!> Checks one record against the table of groups: keys, types, counts, subscripts, ranges.
!>
!> The values are read by ek_draft from the entries that pass. The compiler's namelist read is not used: it silently accepts
!> too few values, a key given twice, `nan` and `1e999`.
module ek_namelist
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted, plural
   use ek_letters, only: bad_byte
   use ek_complaint, only: place_t, complaints_t
   use ek_record, only: record_t, entry_t, value_t, entry_index, is_given, place_of
   use ek_group, only: key_t, keys, find_key, unknown_key, is_inside, range_words, word, prose, number, whole, switch, &
      word_length, note_length, largest_exponent, smallest_exponent
   implicit none(type, external)
   private
   public :: check_record, value_fault

contains

   !> Checks one record and marks the entries that are rejected.
   subroutine check_record(record, group, head, complaints, is_good)
      type(record_t), intent(inout) :: record
      integer, intent(in) :: group
      character(*), intent(in) :: head                        !! "bushing 'top_mount': " for messages
      type(complaints_t), intent(inout) :: complaints
      logical, intent(out) :: is_good
      type(key_t) :: key
      logical :: is_known
      integer :: k, first

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

      !> Whether type, count and values of entry k fit its key.
      logical function fits()
         character(:), allocatable :: fault
         integer :: given, j, l

         fits = .false.
         associate (entry => record%entries(k))
            given = 0
            first = huge(first)
            do l = 1, record%used        ! kt(1)=… kt(2)=… are counted together and checked at the first one
               if (record%entries(l)%key /= entry%key) cycle
               given = given + record%entries(l)%used
               first = min(first, l)
            end do
            if (entry%used == 0) then    ! reported by the scanner
               is_good = .false.
               return
            end if
            if (entry%first + entry%used - 1 > key%most) then
               if (entry%first > 1) then
                  call complain(k, trim(key%name)//' has '//plural(key%most, 'element', 'elements')//', found element '// &
                     str(entry%first + entry%used - 1))
               else
                  call complain(k, trim(key%name)//' '//needs(key)//', found '//str(given)//surplus(key, entry))
               end if
               return
            end if
            if (given < key%least .and. first == k) then
               call complain(k, trim(key%name)//' '//needs(key)//', found '//str(given))
               return
            end if
            if (entry%first > 1 .and. given >= key%least) then     ! lists start at their first element and have no gaps
               if (entry_index(record, entry%key, entry%first - 1) == 0) then
                  call complain(k, trim(key%name)//element_text(key, entry%first - 1)//' is missing, found '//trim(key%name)// &
                     element_text(key, entry%first))
                  return
               end if
            end if
            do j = 1, entry%used
               fault = value_fault(entry%values(j), key%type)
               if (fault == '') cycle
               call complain(k, trim(key%name)//element_text(key, entry%first + j - 1)//' must be '//fault)
               return
            end do
            fits = .true.
            do j = 1, entry%used      ! each number outside its range is reported
               fault = out_of_range(key, entry, j)
               if (fault == '') cycle
               call complain(k, fault)
               fits = .false.
               if (key%least /= key%most) return
            end do
         end associate
      end function fits

      subroutine complain(entry, what)
         integer, intent(in) :: entry
         character(*), intent(in) :: what
         type(place_t) :: place

         call place_of(record, entry, place)
         call complaints%add(place, head//what)
         is_good = .false.
      end subroutine complain

   end subroutine check_record

   !> 'kt(2) must be 0 or more, found -1'; '' if the number is in the range of its key, or is none.
   function out_of_range(key, entry, k) result(words)
      type(key_t), intent(in) :: key
      type(entry_t), intent(in) :: entry
      integer, intent(in) :: k               !! number of the value in the entry
      character(:), allocatable :: words
      real(wp) :: value

      words = ''
      if (key%type /= number) return
      read (entry%values(k)%text, *) value
      if (is_inside(key%range, value)) return
      words = trim(key%name)//' '//range_words(key, str(value))
      if (key%least == key%most) words = trim(key%name)//element_text(key, entry%first + k - 1)//' '//range_words(key, str(value))
   end function out_of_range

   !> 'needs 3 values'
   pure function needs(key) result(words)
      type(key_t), intent(in) :: key
      character(:), allocatable :: words

      if (key%least == key%most) then
         words = 'needs '//plural(key%least, 'value', 'values')
      else
         words = 'needs '//str(key%least)//' to '//str(key%most)//' values'
      end if
   end function needs

   !> Hints about surplus values: a decimal comma, or an unknown key without = after it.
   function surplus(key, entry) result(words)
      type(key_t), intent(in) :: key
      type(entry_t), intent(in) :: entry
      character(:), allocatable :: words
      integer :: j

      words = ''
      do j = 2, entry%used
         associate (value => entry%values(j), before => entry%values(j - 1)%text)
            if (value%is_string .or. value%is_empty) cycle
            if (scan(lower(value%text(:1)), 'abcdefghijklmnopqrstuvwxyz') == 1 .and. j < entry%used) then
               ! an unclosed string leaves no numbers
               if (.not. entry%values(j + 1)%is_string .and. scan(entry%values(j + 1)%text, '0123456789') == 0) cycle
               words = ' (is the = after '//quoted(value%text)//' missing?)'
               return
            end if
            if (key%type /= number .or. verify(value%text, '0123456789') > 0) cycle
            if (verify(before, '+-0123456789') > 0) cycle
            words = ' (a decimal comma? Write '//before//'.'//value%text//', not '//before//','//value%text//')'
            return
         end associate
      end do
   end function surplus

   !> '(2)' of a key with several elements.
   pure function element_text(key, at) result(words)
      type(key_t), intent(in) :: key
      integer, intent(in) :: at
      character(:), allocatable :: words
      words = ''
      if (key%most > 1) words = '('//str(at)//')'
   end function element_text

   !> 'a number, found …' if a value does not fit its type; '' if it does.
   pure function value_fault(value, type) result(fault)
      type(value_t), intent(in) :: value
      integer, intent(in) :: type
      character(:), allocatable :: fault
      character(:), allocatable :: expected

      select case (type)
      case (word, prose)
         expected = 'a text in quotes'
      case (number)
         expected = 'a number'
      case (whole)
         expected = 'a whole number'
      case default
         expected = '.true. or .false.'
      end select

      fault = ''
      if (value%is_empty) then
         fault = expected//', found nothing between the commas'
         return
      end if
      select case (type)
      case (word, prose)
         if (.not. value%is_string) then
            fault = expected//', found '//value%text//' without quotes'//quote_hint(value%text)
         else if (type == word .and. len(value%text) > word_length) then
            fault = 'at most '//str(word_length)//' characters long, found '//str(len(value%text))
         else if (len(value%text) > note_length) then
            fault = 'at most '//str(note_length)//' characters long, found '//str(len(value%text))
         else if (value%text == '') then
            fault = expected//', found an empty text'
         else if (bad_byte(value%text) > 0) then
            fault = 'UTF-8 text, found '//quoted(value%text)//'; save the file as UTF-8'
         end if
      case default
         if (value%is_string) then
            fault = expected//', found the string '//quoted(value%text)
         else if (type == switch) then
            if (.not. is_switch(value%text)) fault = expected//', found '//value%text
         else if (type == whole) then
            if (.not. is_whole(value%text)) fault = expected//', found '//value%text
         else if (.not. is_number(value%text)) then
            fault = expected//', found '//value%text//number_hint(value%text)
         else if (size_exponent(value%text) > largest_exponent) then
            fault = 'a number below 1e'//str(largest_exponent)//', found '//value%text
         else if (size_exponent(value%text) < smallest_exponent) then
            fault = '0 or a number above 1e'//str(smallest_exponent)//', found '//value%text
         end if
      end select
   end function value_fault

   !> A hint if a text has typographic quotes.
   pure function quote_hint(text) result(words)
      character(*), intent(in) :: text
      character(:), allocatable :: words
      character(*), parameter :: quotes(7) = ['‘', '’', '‚', '“', '”', '„', '´ ']
      integer :: k

      words = ''
      do k = 1, size(quotes)
         if (index(text, trim(quotes(k))) == 1) words = " (write straight quotes: ' or "")"
      end do
   end function quote_hint

   !> A hint about common mistakes in numbers.
   pure function number_hint(text) result(words)
      character(*), intent(in) :: text
      character(:), allocatable :: words

      words = ''
      if (index(text, '−') == 1 .or. index(text, '–') == 1) then
         words = ' (write the minus sign as -)'
      else if (index(text, ';') > 0) then
         words = ' (separate values by commas or blanks)'
      end if
   end function number_hint

   pure logical function is_switch(text)
      character(*), intent(in) :: text
      is_switch = any(lower(text) == [character(7) :: '.true.', '.false.', 'true', 'false', '.t.', '.f.', 't', 'f'])
   end function is_switch

   !> Digits with an optional sign, at most nine of them.
   pure logical function is_whole(text)
      character(*), intent(in) :: text
      integer :: first

      first = 1
      if (text(1:1) == '-' .or. text(1:1) == '+') first = 2
      is_whole = len(text) >= first .and. len(text) < first + 9 .and. verify(text(first:), '0123456789') == 0
   end function is_whole

   !> [sign] digits [. digits] [e|d [sign] digits], at least one digit before the exponent.
   pure logical function is_number(text)
      character(*), intent(in) :: text
      integer :: mark, first, last

      is_number = .false.
      last = scan(text, 'eEdD') - 1
      if (last >= 0) then
         mark = last + 2
         if (mark > len(text)) return
         if (index('+-', text(mark:mark)) > 0) mark = mark + 1
         if (mark > len(text)) return
         if (verify(text(mark:), '0123456789') > 0) return
      else
         last = len(text)
      end if
      if (last < 1) return
      first = 1
      if (index('+-', text(1:1)) > 0) first = 2
      if (scan(text(first:last), '0123456789') == 0) return
      if (verify(text(first:last), '0123456789.') > 0) return
      is_number = index(text(first:last), '.') == index(text(first:last), '.', back=.true.)
   end function is_number

   !> The power of ten of a well-formed number's first digit.
   pure integer function size_exponent(text)
      character(*), intent(in) :: text
      integer :: mark, last, dot, lead, status

      mark = scan(text, 'eEdD')
      size_exponent = 0
      last = len(text)
      if (mark > 0) then
         last = mark - 1
         status = 1
         if (len(text) - mark < 8) read (text(mark + 1:), *, iostat=status) size_exponent
         if (status /= 0) size_exponent = merge(-9999999, 9999999, text(mark + 1:mark + 1) == '-')
      end if
      lead = scan(text(:last), '123456789')
      if (lead == 0) then
         size_exponent = 0
         return
      end if
      dot = index(text(:last), '.')
      if (dot == 0) dot = last + 1
      size_exponent = size_exponent + dot - lead
      if (lead < dot) size_exponent = size_exponent - 1
   end function size_exponent

end module ek_namelist
