!> Reads an axle of IPGKinematics (.kin). `parse_kin` lists the values in the order of the file.
module ek_kin_reader
   use ek_kinds, only: wp
   use ek_text, only: str, lower
   use ek_flaws, only: flaws_t, shown
   use ek_fields, only: split_lines, field_t, take_number
   use ek_kin, only: kin_t, kin_curve_t, points, bushings
   use ek_kin_cursor, only: kin_cursor_t, go_to, take_text, take_real, take_mass, take_choice, take_flag, take_choice_of_two, &
      take_point
   implicit none(type, external)
   private
   public :: parse_kin, is_kin

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

end module ek_kin_reader
