!> The lines of a file of IPGKinematics (.kin), and the index of the line that was read last. A line has a label in quotes and
!> values. The labels are in a fixed order.
!>
!> A value is found by the form of its label after the line of the previous value, so that headings, comments and further
!> lines do not matter.
module ek_kin_cursor
   use ek_kinds, only: wp
   use ek_text, only: str, lower, is_like
   use ek_flaws, only: flaws_t, shown
   use ek_fields, only: lines_t, field_t, split_fields, take_number
   implicit none(type, external)
   private
   public :: kin_cursor_t, go_to, take_text, take_real, take_mass, take_choice, take_flag, take_choice_of_two, take_point

   !> The position up to which the file has been read.
   type :: kin_cursor_t
      type(lines_t) :: lines
      integer :: line = 0
      logical :: is_lost = .false.            !! a value is missing; the values further down are not read
   end type kin_cursor_t

contains

   !> Moves to the next line whose label matches `pattern`; the values are `fields(2:used)`. A missing line, or fewer than `least`
   !> values, is reported as an error. If `least` is 1, a line without a value is skipped.
   subroutine go_to(cursor, pattern, least, fields, used, flaws)
      type(kin_cursor_t), intent(inout) :: cursor
      character(*), intent(in) :: pattern
      integer, intent(in) :: least
      type(field_t), intent(inout) :: fields(64)
      integer, intent(out) :: used          !! 0: no line with enough values was found
      type(flaws_t), intent(inout) :: flaws
      integer :: k

      used = 0
      if (cursor%is_lost) return
      do k = cursor%line + 1, cursor%lines%count
         if (.not. has_label(cursor%lines%line(k), pattern)) cycle
         call split_fields(cursor%lines%line(k), k, fields, used, flaws)
         if (used < 1) cycle
         if (used - 1 < least) then
            if (used == 1 .and. least == 1) then     ! the second line of a label
               used = 0
               cycle
            end if
            call flaws%add(k, 'expected '//str(least)//' values after '//shown(trim(adjustl(fields(1)%text)))//', found '// &
               str(used - 1))
            used = 0
            cursor%line = k
            return
         end if
         cursor%line = k
         return
      end do
      cursor%is_lost = .true.
      call flaws%add(min(cursor%line + 1, cursor%lines%count), 'expected a line '//shown(plain(pattern))//' with a value here '// &
         'or further down, found none')
   end subroutine go_to

   !> Reads the string on the next line with a label of this form. `text` is unchanged if there is no such line.
   subroutine take_text(cursor, pattern, text, flaws)
      type(kin_cursor_t), intent(inout) :: cursor
      character(*), intent(in) :: pattern
      character(:), allocatable, intent(inout) :: text
      type(flaws_t), intent(inout) :: flaws
      type(field_t) :: fields(64)
      integer :: used

      call go_to(cursor, pattern, 1, fields, used, flaws)
      if (used > 1) text = trim(adjustl(fields(2)%text))
   end subroutine take_text

   !> Reads the number on the next line with a label of this form; 0 if there is no such line.
   subroutine take_real(cursor, pattern, value, flaws)
      type(kin_cursor_t), intent(inout) :: cursor
      character(*), intent(in) :: pattern
      real(wp), intent(out) :: value
      type(flaws_t), intent(inout) :: flaws
      type(field_t) :: fields(64)
      integer :: used
      logical :: is_good

      value = 0.0_wp
      call go_to(cursor, pattern, 1, fields, used, flaws)
      if (used > 1) call take_number(fields(2)%text, cursor%line, plain(pattern), value, flaws, is_good)
   end subroutine take_real

   !> Reads a number as take_real does; a negative mass is an error.
   subroutine take_mass(cursor, pattern, value, flaws)
      type(kin_cursor_t), intent(inout) :: cursor
      character(*), intent(in) :: pattern
      real(wp), intent(out) :: value
      type(flaws_t), intent(inout) :: flaws

      call take_real(cursor, pattern, value, flaws)
      if (value < 0.0_wp) call flaws%add(cursor%line, 'expected a mass of 0 or more, found '//str(value))
   end subroutine take_mass

   !> Reads an integer from 0 to `most`. Any other value is reported, and `choice` is then 0.
   subroutine take_choice(cursor, pattern, most, choice, flaws)
      type(kin_cursor_t), intent(inout) :: cursor
      character(*), intent(in) :: pattern
      integer, intent(in) :: most
      integer, intent(out) :: choice
      type(flaws_t), intent(inout) :: flaws
      real(wp) :: value
      integer :: before

      before = flaws%count()
      call take_real(cursor, pattern, value, flaws)
      choice = 0
      if (flaws%count() > before .or. cursor%is_lost) return
      if (value < 0.0_wp .or. value > most .or. abs(value - aint(value)) > 0.0_wp) then
         call flaws%add(cursor%line, 'expected an integer from 0 to '//str(most)//', found '//str(value))
         return
      end if
      choice = int(value)
   end subroutine take_choice

   !> Reads an integer from 0 to 1; `flag` is .true. for 1.
   subroutine take_flag(cursor, pattern, flag, flaws)
      type(kin_cursor_t), intent(inout) :: cursor
      character(*), intent(in) :: pattern
      logical, intent(out) :: flag
      type(flaws_t), intent(inout) :: flaws
      integer :: choice

      call take_choice(cursor, pattern, 1, choice, flaws)
      flag = choice == 1
   end subroutine take_flag

   !> Reads an integer from 0 to 2; `is_second` is .true. for 2.
   subroutine take_choice_of_two(cursor, pattern, is_second, flaws)
      type(kin_cursor_t), intent(inout) :: cursor
      character(*), intent(in) :: pattern
      logical, intent(out) :: is_second
      type(flaws_t), intent(inout) :: flaws
      integer :: choice

      call take_choice(cursor, pattern, 2, choice, flaws)
      is_second = choice == 2
   end subroutine take_choice_of_two

   !> Reads the three coordinates of a point; zeros if there is no such line.
   subroutine take_point(cursor, pattern, at, flaws)
      type(kin_cursor_t), intent(inout) :: cursor
      character(*), intent(in) :: pattern
      real(wp), intent(out) :: at(3)
      type(flaws_t), intent(inout) :: flaws
      type(field_t) :: fields(64)
      integer :: used, j
      logical :: is_good

      at = 0.0_wp
      call go_to(cursor, pattern, 3, fields, used, flaws)
      if (used < 4) return
      do j = 1, 3
         call take_number(fields(j + 1)%text, cursor%line, 'xyz'(j:j), at(j), flaws, is_good)
      end do
   end subroutine take_point

   !> Whether the label of a line matches a pattern with *. Letter case is ignored, and several blanks count as one.
   pure logical function has_label(line, pattern)
      character(*), intent(in) :: line, pattern
      integer, parameter :: longest = 200
      character(:), allocatable :: label
      integer :: first, last, k

      has_label = .false.
      first = verify(line, ' '//achar(9))
      if (first == 0) return
      if (line(first:first) /= '''') return
      last = index(line(first + 1:), '''')
      if (last == 0 .or. last > longest) return
      label = lower(trim(adjustl(line(first + 1:first + last - 1))))
      do
         k = index(label, '  ')
         if (k == 0) exit
         label = label(:k)//label(k + 2:)
      end do
      has_label = is_like(label, pattern)
      if (pattern(len(pattern) - 1:) == ' *' .and. .not. has_label) has_label = label == pattern(:len(pattern) - 2)
   end function has_label

   !> A form of label as shown in a message.
   pure function plain(pattern) result(words)
      character(*), intent(in) :: pattern
      character(:), allocatable :: words
      integer :: k

      words = pattern
      do
         k = index(words, '*')
         if (k == 0) exit
         words = words(:k - 1)//' '//words(k + 1:)
      end do
      words = trim(adjustl(words))
   end function plain

end module ek_kin_cursor
