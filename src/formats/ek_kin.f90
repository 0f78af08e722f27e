!> An axle of IPGKinematics (.kin): lines of a label in quotes and values, in a fixed order.
!>
!> A value is found by the form of its label behind the line of the value before it, so that headings, comments and further
!> lines do not matter. Numbers stay in the units of the file: mm, N, deg, kg.
module ek_kin
   use ek_kinds, only: wp
   use ek_text, only: str, lower, is_like
   use ek_flaws, only: flaws_t, shown
   use ek_fields, only: lines_t, split_lines, field_t, split_fields, take_number
   implicit none(type, external)
   private
   public :: kin_t, kin_curve_t, kin_bushing_t, parse_kin, is_kin
   public :: wheel_centre, contact, subframe_front, subframe_rear, lower_ball, upper_ball, tie_rod_outer, lower_front, &
      lower_rear, upper_front, upper_rear, tie_rod_inner, bar_bearing, bar_end, link_end, spring_body, spring_wheel, &
      rocker_pivot, rocker_axis, rod_wheel, rod_rocker, coil_body, coil_rocker
   public :: off, on_lower, on_carrier, on_upper

   !> Numbers of the points in the file
   integer, parameter :: wheel_centre = 1, contact = 2, subframe_front = 4, subframe_rear = 5, lower_ball = 6, upper_ball = 7, &
      tie_rod_outer = 8, lower_front = 9, lower_rear = 10, upper_front = 11, upper_rear = 12, bar_bearing = 13, bar_end = 14, &
      link_end = 15, tie_rod_inner = 16, spring_body = 18, spring_wheel = 19, rocker_pivot = 24, rocker_axis = 25, &
      rod_wheel = 26, rod_rocker = 27, coil_body = 28, coil_rocker = 29
   integer, parameter :: points = 36, bushings = 9

   !> Where the spring, the pushrod or the bar acts
   integer, parameter :: off = 0, on_lower = 1, on_carrier = 2, on_upper = 3

   !> A law: a rate, or points.
   type :: kin_curve_t
      logical :: has_points = .false.
      real(wp) :: rate = 0.0_wp, factor = 1.0_wp
      real(wp), allocatable :: x(:), y(:)
      integer :: line = 0
   end type kin_curve_t

   type :: kin_bushing_t
      character(:), allocatable :: file      !! as written
      real(wp) :: centre(3) = 0.0_wp, axis(3) = 0.0_wp, angle = 0.0_wp     !! axis: a point on it
      integer :: line = 0
   end type kin_bushing_t

   !> The file.
   type :: kin_t
      character(:), allocatable :: axle_type, remark, position, main_path
      logical :: has_forces = .false., has_subframe = .false., has_elastic_gearbox = .false., is_iso = .false., is_front = .false.
      real(wp) :: bump = 0.0_wp, rebound = 0.0_wp, rack_most = 0.0_wp, rack_least = 0.0_wp      !! mm
      real(wp) :: toe = 0.0_wp                !! min
      real(wp) :: camber = 0.0_wp             !! deg
      real(wp) :: cg_height = 0.0_wp, wheelbase = 0.0_wp, brake_share = 0.0_wp, drive_share = 0.0_wp, tyre_rate = 0.0_wp
      integer :: spring = off, rod = off, bar = off, third = off
      type(kin_curve_t) :: coil, bar_law, rod_law
      logical :: has_upper_on_subframe = .false.
      real(wp) :: load = 0.0_wp, body = 0.0_wp, subframe = 0.0_wp, lower_arm = 0.0_wp, carrier = 0.0_wp, wheel = 0.0_wp, &
         upper_arm = 0.0_wp, tie_rod = 0.0_wp, rack = 0.0_wp, housing = 0.0_wp, bar_mass = 0.0_wp, bar_link = 0.0_wp, &
         rocker = 0.0_wp                      !! kg
      real(wp) :: at(3, points) = 0.0_wp      !! mm
      type(kin_bushing_t) :: mounts(bushings)
   end type kin_t

   !> How far the file is read.
   type :: cursor_t
      integer :: line = 0
      logical :: is_lost = .false.            !! a value is missing; those behind it are not looked for
   end type cursor_t

contains

   !> Whether a text is such a file: its first lines name the program.
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

   !> Reads a text.
   subroutine parse_kin(text, kin, flaws)
      character(*), intent(in) :: text
      type(kin_t), intent(out) :: kin
      type(flaws_t), intent(inout) :: flaws
      type(lines_t) :: lines
      type(cursor_t) :: cursor
      integer :: k

      kin%axle_type = ''
      kin%remark = ''
      kin%position = ''
      kin%main_path = ''
      do k = 1, bushings
         kin%mounts(k)%file = ''
      end do
      call split_lines(text, lines, flaws)
      if (lines%count == 0) return
      call take_text('radaufh*', kin%axle_type)
      call take_text('anmerkung*', kin%remark)
      call take_flag('kraftfrei*', kin%has_forces)
      call take_real('maximale einfederung*', kin%bump)
      call take_real('maximale ausfederung*', kin%rebound)
      call take_real('maximaler zahnstangenweg*', kin%rack_most)
      call take_real('minimaler zahnstangenweg*', kin%rack_least)
      call take_text('vorderachse*', kin%position)
      call take_real('vorspur*', kin%toe)
      call take_real('sturz*', kin%camber)
      call take_real('hoehe*', kin%cg_height)
      call take_real('radstand*', kin%wheelbase)
      call take_real('bremskraftanteil*', kin%brake_share)
      call take_real('antriebsmomentenanteil*', kin%drive_share)
      call take_real('federbeiwert reifen*', kin%tyre_rate)
      call take_flag('ohne fahrschemel*', kin%has_subframe)
      call take_flag('ohne elastische*', kin%has_elastic_gearbox)
      call take_choice('aus = 0, querlenker*', 3, kin%spring)
      call take_choice('aus = 0, querlenker*', 3, kin%rod)
      call take_law('federbeiwert [n/mm*', 'federweg*', kin%coil)
      call take_choice('aus = 0, qlu*', 3, kin%bar)
      call take_law('drehfederbeiwert*', 'winkel*', kin%bar_law)
      call take_law('l*ngs*teifigkeit*n/mm*', 'federweg*', kin%rod_law)
      call take_choice('aus = 0, linear*', 2, kin%third)
      call take_choice_of_two('querlenker oben: aufbau*', kin%has_upper_on_subframe)
      call take_mass('beladung*', kin%load)
      call take_mass('anteil aufbaumasse*', kin%body)
      call take_mass('fahrschemel*', kin%subframe)
      call take_mass('querlenker unten*', kin%lower_arm)
      call take_mass('radtr*ger*', kin%carrier)
      call take_mass('rad', kin%wheel)
      call take_mass('querlenker oben*', kin%upper_arm)
      call take_mass('spurstange*', kin%tie_rod)
      call take_mass('zahnstange*', kin%rack)
      call take_mass('lenkgetriebe*', kin%housing)
      call take_mass('stabilisator*', kin%bar_mass)
      call take_mass('stabipendel*', kin%bar_link)
      call take_mass('kipphebel*', kin%rocker)
      call take_flag('0 = din 70000*', kin%is_iso)
      kin%is_iso = .not. kin%is_iso           ! 1: x rearward, y to the right
      do k = 1, points
         call take_point('point '//str(k)//' *', kin%at(:, k))
      end do
      call take_text('hauptpfad*', kin%main_path)
      do k = 1, bushings
         call take_text('* '//str(k), kin%mounts(k)%file)
         kin%mounts(k)%line = cursor%line
         call take_point('*lagermitte*', kin%mounts(k)%centre)
         call take_point('*lagerachse*', kin%mounts(k)%axis)
         call take_real('*winkel um*', kin%mounts(k)%angle)
      end do
      if (flaws%count() > 0) return
      kin%is_front = lower(trim(kin%position)) == 'va'
      if (.not. (kin%is_front .or. lower(trim(kin%position)) == 'ha')) &
         call flaws%add(0, 'expected the axle VA (front) or HA (rear), found '//shown(kin%position))

   contains

      !> Goes to the next line with a label of this form and at least `least` values; the values are `fields(2:used)`.
      subroutine go_to(pattern, least, fields, used)
         character(*), intent(in) :: pattern
         integer, intent(in) :: least
         type(field_t), intent(inout) :: fields(64)
         integer, intent(out) :: used          !! 0: not found
         integer :: k

         used = 0
         if (cursor%is_lost) return
         do k = cursor%line + 1, lines%count
            if (.not. has_label(lines%line(k), pattern)) cycle
            call split_fields(lines%line(k), k, fields, used, flaws)
            if (used < 1) cycle
            if (used - 1 < least) then
               if (used == 1 .and. least == 1) then     ! the second line of a label
                  used = 0
                  cycle
               end if
               call flaws%add(k, 'expected '//str(least)//' values behind '//shown(trim(adjustl(fields(1)%text)))//', found '// &
                  str(used - 1))
               used = 0
               cursor%line = k
               return
            end if
            cursor%line = k
            return
         end do
         cursor%is_lost = .true.
         call flaws%add(min(cursor%line + 1, lines%count), 'expected a line '//shown(plain(pattern))//' with a value here '// &
            'or further down, found none')
      end subroutine go_to

      subroutine take_text(pattern, text)
         character(*), intent(in) :: pattern
         character(:), allocatable, intent(inout) :: text
         type(field_t) :: fields(64)
         integer :: used

         call go_to(pattern, 1, fields, used)
         if (used > 1) text = trim(adjustl(fields(2)%text))
      end subroutine take_text

      subroutine take_real(pattern, value)
         character(*), intent(in) :: pattern
         real(wp), intent(out) :: value
         type(field_t) :: fields(64)
         integer :: used
         logical :: is_good

         value = 0.0_wp
         call go_to(pattern, 1, fields, used)
         if (used > 1) call take_number(fields(2)%text, cursor%line, plain(pattern), value, flaws, is_good)
      end subroutine take_real

      subroutine take_mass(pattern, value)
         character(*), intent(in) :: pattern
         real(wp), intent(out) :: value

         call take_real(pattern, value)
         if (value < 0.0_wp) call flaws%add(cursor%line, 'expected a mass of 0 or more, found '//str(value))
      end subroutine take_mass

      !> A whole number from 0 to `most`.
      subroutine take_choice(pattern, most, choice)
         character(*), intent(in) :: pattern
         integer, intent(in) :: most
         integer, intent(out) :: choice
         real(wp) :: value
         integer :: before

         before = flaws%count()
         call take_real(pattern, value)
         choice = 0
         if (flaws%count() > before .or. cursor%is_lost) return
         if (value < 0.0_wp .or. value > most .or. abs(value - aint(value)) > 0.0_wp) then
            call flaws%add(cursor%line, 'expected a whole number from 0 to '//str(most)//', found '//str(value))
            return
         end if
         choice = int(value)
      end subroutine take_choice

      subroutine take_flag(pattern, flag)
         character(*), intent(in) :: pattern
         logical, intent(out) :: flag
         integer :: choice

         call take_choice(pattern, 1, choice)
         flag = choice == 1
      end subroutine take_flag

      !> 1 or 2.
      subroutine take_choice_of_two(pattern, is_second)
         character(*), intent(in) :: pattern
         logical, intent(out) :: is_second
         integer :: choice

         call take_choice(pattern, 2, choice)
         is_second = choice == 2
      end subroutine take_choice_of_two

      subroutine take_point(pattern, at)
         character(*), intent(in) :: pattern
         real(wp), intent(out) :: at(3)
         type(field_t) :: fields(64)
         integer :: used, j
         logical :: is_good

         at = 0.0_wp
         call go_to(pattern, 3, fields, used)
         if (used < 4) return
         do j = 1, 3
            call take_number(fields(j + 1)%text, cursor%line, 'xyz'(j:j), at(j), flaws, is_good)
         end do
      end subroutine take_point

      !> A choice of rate or points, the rate, and the points with their factor.
      subroutine take_law(rate_pattern, pair_pattern, law)
         character(*), intent(in) :: rate_pattern, pair_pattern
         type(kin_curve_t), intent(inout) :: law
         integer, parameter :: most_pairs = 200
         type(field_t) :: fields(64)
         real(wp) :: kind, count
         integer :: used, k, pairs
         logical :: is_good

         call take_real('federbeiwert(linear)*', kind)
         law%has_points = nint(min(max(kind, 0.0_wp), 9.0_wp)) == 2
         call take_real(rate_pattern, law%rate)
         law%line = cursor%line
         if (law%rate < 0.0_wp) call flaws%add(cursor%line, 'expected a rate of 0 or more, found '//str(law%rate))
         if (pair_pattern /= 'winkel*') call take_real('verst*rkungsfaktor*', law%factor)
         call take_real('anzahl wertepaare*', count)
         if (cursor%is_lost) return
         if (count < 0.0_wp .or. count > most_pairs .or. abs(count - aint(count)) > 0.0_wp) then
            call flaws%add(cursor%line, 'expected a number of pairs from 0 to '//str(most_pairs)//', found '//str(count))
            cursor%is_lost = .true.
            return
         end if
         pairs = int(count)
         allocate (law%x(pairs), law%y(pairs), source=0.0_wp)
         do k = 1, pairs
            call go_to(pair_pattern, 2, fields, used)
            if (used < 3) cycle
            call take_number(fields(2)%text, cursor%line, 'the abscissa', law%x(k), flaws, is_good)
            call take_number(fields(3)%text, cursor%line, 'the ordinate', law%y(k), flaws, is_good)
         end do
      end subroutine take_law

   end subroutine parse_kin

   !> Whether the label of a line has a form; blanks count once.
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

   !> A form as text for a message.
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

end module ek_kin
