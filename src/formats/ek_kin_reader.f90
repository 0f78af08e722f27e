!> Reads an axle of IPGKinematics (.kin). `parse_kin` lists the values in the order of the file.
!>
!> A line of the file has a label in quotes and values. The labels are in a fixed order.
!>
!> A value is found by the form of its label after the line of the previous value, so that headings, comments and further
!> lines do not matter.
module ek_kin_reader
   use ek_kinds, only: wp
   use ek_text, only: str, lower, is_like
   use ek_flaws, only: flaws_t, shown
   use ek_fields, only: split_lines, field_t, take_number, lines_t, split_fields
   use ek_kin, only: kin_t, kin_curve_t, points, bushings
   implicit none(type, external)
   private
   public :: parse_kin, is_kin, kin_cursor_t, go_to, take_text, take_real, take_mass, take_choice, take_flag, take_choice_of_two, &
      take_point

   !> The position up to which the file has been read.
   type :: kin_cursor_t
      type(lines_t) :: lines
      integer :: line = 0
      logical :: is_lost = .false.            !! a value is missing; the values further down are not read
   end type kin_cursor_t

contains

   !> Whether a string is the content of a .kin file: it begins with a single quote, and its first 2000 characters contain
   !> 'kinematics'.
   pure logical function is_kin(text)
      character(*), intent(in) :: text
      character(:), allocatable :: head
      integer :: first

      head = lower(text(:min(len(text), 2000)))
      is_kin = .false.
      if (index(head, 'kinematics') == 0) return
      first = verify(head, ' '//achar(9)//achar(10)//achar(13))
      is_kin = head(first:first) == ''''
   end function is_kin

   !> Reads an axle from the content of a .kin file.
   subroutine parse_kin(text, kin, flaws)
      character(*), intent(in) :: text
      type(kin_t), intent(out) :: kin
      type(flaws_t), intent(inout) :: flaws
      type(kin_cursor_t) :: cursor
      integer :: k

      kin%axle_type = ''
      kin%remark = ''
      kin%position = ''
      kin%main_path = ''
      do k = 1, bushings
         kin%mounts(k)%file = ''
      end do
      call split_lines(text, cursor%lines, flaws)
      if (cursor%lines%count == 0) return
      call take_text(cursor, 'radaufh*', kin%axle_type, flaws)
      call take_text(cursor, 'anmerkung*', kin%remark, flaws)
      call take_flag(cursor, 'kraftfrei*', kin%has_forces, flaws)
      call take_real(cursor, 'maximale einfederung*', kin%bump, flaws)
      call take_real(cursor, 'maximale ausfederung*', kin%rebound, flaws)
      call take_real(cursor, 'maximaler zahnstangenweg*', kin%rack_most, flaws)
      call take_real(cursor, 'minimaler zahnstangenweg*', kin%rack_least, flaws)
      call take_text(cursor, 'vorderachse*', kin%position, flaws)
      call take_real(cursor, 'vorspur*', kin%toe, flaws)
      call take_real(cursor, 'sturz*', kin%camber, flaws)
      call take_real(cursor, 'hoehe*', kin%cg_height, flaws)
      call take_real(cursor, 'radstand*', kin%wheelbase, flaws)
      call take_real(cursor, 'bremskraftanteil*', kin%brake_share, flaws)
      call take_real(cursor, 'antriebsmomentenanteil*', kin%drive_share, flaws)
      call take_real(cursor, 'federbeiwert reifen*', kin%tyre_rate, flaws)
      call take_flag(cursor, 'ohne fahrschemel*', kin%has_subframe, flaws)
      call take_flag(cursor, 'ohne elastische*', kin%has_elastic_gearbox, flaws)
      call take_choice(cursor, 'aus = 0, querlenker*', 3, kin%spring, flaws)
      call take_choice(cursor, 'aus = 0, querlenker*', 3, kin%rod, flaws)
      call take_law(cursor, 'federbeiwert [n/mm*', 'federweg*', kin%coil, flaws)
      call take_choice(cursor, 'aus = 0, qlu*', 3, kin%bar, flaws)
      call take_law(cursor, 'drehfederbeiwert*', 'winkel*', kin%bar_law, flaws)
      call take_law(cursor, 'l*ngs*teifigkeit*n/mm*', 'federweg*', kin%rod_law, flaws)
      call take_choice(cursor, 'aus = 0, linear*', 2, kin%third, flaws)
      call take_choice_of_two(cursor, 'querlenker oben: aufbau*', kin%has_upper_on_subframe, flaws)
      call take_mass(cursor, 'beladung*', kin%load, flaws)
      call take_mass(cursor, 'anteil aufbaumasse*', kin%body, flaws)
      call take_mass(cursor, 'fahrschemel*', kin%subframe, flaws)
      call take_mass(cursor, 'querlenker unten*', kin%lower_arm, flaws)
      call take_mass(cursor, 'radtr*ger*', kin%carrier, flaws)
      call take_mass(cursor, 'rad', kin%wheel, flaws)
      call take_mass(cursor, 'querlenker oben*', kin%upper_arm, flaws)
      call take_mass(cursor, 'spurstange*', kin%tie_rod, flaws)
      call take_mass(cursor, 'zahnstange*', kin%rack, flaws)
      call take_mass(cursor, 'lenkgetriebe*', kin%housing, flaws)
      call take_mass(cursor, 'stabilisator*', kin%bar_mass, flaws)
      call take_mass(cursor, 'stabipendel*', kin%bar_link, flaws)
      call take_mass(cursor, 'kipphebel*', kin%rocker, flaws)
      call take_flag(cursor, '0 = din 70000*', kin%is_iso, flaws)
      kin%is_iso = .not. kin%is_iso           ! 1: x rearward, y to the right
      do k = 1, points
         call take_point(cursor, 'point '//str(k)//' *', kin%at(:, k), flaws)
      end do
      call take_text(cursor, 'hauptpfad*', kin%main_path, flaws)
      do k = 1, bushings
         call take_text(cursor, '* '//str(k), kin%mounts(k)%file, flaws)
         kin%mounts(k)%line = cursor%line
         call take_point(cursor, '*lagermitte*', kin%mounts(k)%centre, flaws)
         call take_point(cursor, '*lagerachse*', kin%mounts(k)%axis, flaws)
         call take_real(cursor, '*winkel um*', kin%mounts(k)%angle, flaws)
      end do
      if (flaws%count() > 0) return
      kin%is_front = lower(trim(kin%position)) == 'va'
      if (.not. (kin%is_front .or. lower(trim(kin%position)) == 'ha')) &
         call flaws%add(0, 'expected the axle VA (front) or HA (rear), found '//shown(kin%position))

   end subroutine parse_kin

   !> Reads a law: the choice between rate and points, the rate, and the points with their factor.
   subroutine take_law(cursor, rate_pattern, pair_pattern, law, flaws)
      type(kin_cursor_t), intent(inout) :: cursor
      character(*), intent(in) :: rate_pattern, pair_pattern
      type(kin_curve_t), intent(inout) :: law
      type(flaws_t), intent(inout) :: flaws
      integer, parameter :: most_pairs = 200
      type(field_t) :: fields(64)
      real(wp) :: kind, count
      integer :: used, k, pairs
      logical :: is_good

      call take_real(cursor, 'federbeiwert(linear)*', kind, flaws)
      law%has_points = nint(min(max(kind, 0.0_wp), 9.0_wp)) == 2
      call take_real(cursor, rate_pattern, law%rate, flaws)
      law%line = cursor%line
      if (law%rate < 0.0_wp) call flaws%add(cursor%line, 'expected a rate of 0 or more, found '//str(law%rate))
      if (pair_pattern /= 'winkel*') call take_real(cursor, 'verst*rkungsfaktor*', law%factor, flaws)
      call take_real(cursor, 'anzahl wertepaare*', count, flaws)
      if (cursor%is_lost) return
      if (count < 0.0_wp .or. count > most_pairs .or. abs(count - aint(count)) > 0.0_wp) then
         call flaws%add(cursor%line, 'expected a number of pairs from 0 to '//str(most_pairs)//', found '//str(count))
         cursor%is_lost = .true.
         return
      end if
      pairs = int(count)
      allocate (law%x(pairs), law%y(pairs), source=0.0_wp)
      do k = 1, pairs
         call go_to(cursor, pair_pattern, 2, fields, used, flaws)
         if (used < 3) cycle
         call take_number(fields(2)%text, cursor%line, 'the abscissa', law%x(k), flaws, is_good)
         call take_number(fields(3)%text, cursor%line, 'the ordinate', law%y(k), flaws, is_good)
      end do
   end subroutine take_law

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

end module ek_kin_reader
