!> Typing mistakes between two keys that the scanner recognises: a missing = sign and a unit after a number.
module ek_slip
   use ek_text, only: lower
   use ek_cursor, only: cursor_t, key_follows, skip_blanks, take_subscript, take_word, is_word_begin, tab
   use ek_record, only: entry_t
   use ek_group, only: group_number, key_t, find_key
   implicit none(type, external)
   private
   public :: lacks_equals, drop_unit, unit_message

   character(*), parameter :: units(19) = [character(7) :: 'n', 'kn', 'mm', 'cm', 'm', 'nm', 'knm', 'nmm', 'deg', 'degree', &
      'degrees', 'grad', 'rad', 'kg', 'g', 's', 'ms', 'per', '%']
   character(*), parameter :: degree_sign = char(194)//char(176)

contains

   !> Whether a key of a group starts here, followed by a colon or a value instead of an = sign.
   pure logical function lacks_equals(text, cursor, group)
      character(*), intent(in) :: text, group
      type(cursor_t), intent(in) :: cursor
      type(cursor_t) :: ahead
      type(key_t) :: key
      character(:), allocatable :: word

      ahead = cursor
      call take_word(text, ahead, word)
      call find_key(group_number(group), lower(word), key, lacks_equals)
      if (.not. lacks_equals) return
      call skip_blanks(text, ahead)
      lacks_equals = .false.
      if (ahead%at > len(text)) return
      if (text(ahead%at:ahead%at) == '(') then
         call take_subscript(text, ahead, word)
         call skip_blanks(text, ahead)
         if (ahead%at > len(text)) return
      end if
      lacks_equals = index(':+-.0123456789''"', text(ahead%at:ahead%at)) > 0
   end function lacks_equals

   !> Takes the unit after the last value of an entry, as in `30.0 N/mm` and `30.0N/mm`; '' if there is none.
   pure subroutine drop_unit(text, cursor, entry, unit)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor          !! in: after the value; out: after the unit
      type(entry_t), intent(inout) :: entry            !! a unit attached to its last value is removed
      character(:), allocatable, intent(out) :: unit
      type(cursor_t) :: ahead
      character(:), allocatable :: value, more
      integer :: last, first

      unit = ''
      if (entry%used == 0) return
      if (entry%values(entry%used)%is_string) return
      value = entry%values(entry%used)%text
      last = verify(value//' ', '+-.0123456789') - 1
      if (scan(value(:last), '0123456789') == 0) return
      if (last < len(value)) then
         if (is_unit(value(last + 1:))) then
            unit = value(last + 1:)
            entry%values(entry%used)%text = value(:last)
            call take_quotient(text, cursor, unit)
         else if (verify(value, '+-.0123456789eEdD') > 0) then
            return
         end if
      end if
      do
         ahead = cursor
         first = verify(text(ahead%at:), ' '//tab)
         if (first == 0) return
         ahead%at = ahead%at + first - 1
         first = ahead%at
         if (key_follows(text, ahead)) return
         call take_unit_word(text, ahead, more)
         if (.not. is_unit(more)) return
         call take_quotient(text, ahead, more)
         cursor = ahead
         if (unit /= '') unit = unit//' '
         unit = unit//more
      end do
   end subroutine drop_unit

   !> The message about a unit.
   pure function unit_message(entry, unit) result(words)
      type(entry_t), intent(in) :: entry
      character(*), intent(in) :: unit
      character(:), allocatable :: words
      words = entry%key//": found the unit '"//unit//"' after "//entry%values(entry%used)%text// &
         '; write the number alone (&model sets the units)'
   end function unit_message

   !> Letters, the degree sign or % from here on.
   pure subroutine take_unit_word(text, cursor, word)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor
      character(:), allocatable, intent(out) :: word

      word = ''
      if (cursor%at > len(text)) return
      if (index(text(cursor%at:), degree_sign) == 1) then
         word = degree_sign
         cursor%at = cursor%at + len(degree_sign)
      else if (text(cursor%at:cursor%at) == '%') then
         word = '%'
         cursor%at = cursor%at + 1
      else if (is_word_begin(text(cursor%at:cursor%at))) then
         call take_word(text, cursor, word)
      end if
   end subroutine take_unit_word

   !> /mm, *mm, ^2, /(…) following a unit. A / not followed by a letter ends the group.
   pure subroutine take_quotient(text, cursor, unit)
      character(*), intent(in) :: text
      type(cursor_t), intent(inout) :: cursor
      character(:), allocatable, intent(inout) :: unit
      character(:), allocatable :: word
      type(cursor_t) :: ahead

      do while (cursor%at < len(text))
         if (index('/*^', text(cursor%at:cursor%at)) == 0) return
         ahead = cursor
         ahead%at = ahead%at + 1
         if (text(cursor%at:cursor%at) == '^') then
            word = text(ahead%at:ahead%at)
            ahead%at = ahead%at + 1
         else
            call take_unit_word(text, ahead, word)
         end if
         if (word == '') return
         unit = unit//text(cursor%at:cursor%at)//word
         cursor = ahead
      end do
   end subroutine take_quotient

   !> Whether a word is a unit, or begins as a product of units.
   pure logical function is_unit(word)
      character(*), intent(in) :: word
      integer :: mark

      mark = scan(word//'*', '*^')
      is_unit = any(units == lower(word(:mark - 1))) .or. word == degree_sign
   end function is_unit

end module ek_slip
