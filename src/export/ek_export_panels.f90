!> The panels of the figure of each kind of exported file. The line numbers of the plotted rows and the plotted slopes are read from
!> the content of the written file.
module ek_export_panels
   use ek_kinds, only: wp, degree, millimetre
   use ek_text, only: str
   use ek_letters, only: line_count
   use ek_decimal, only: decimal
   use ek_gnuplot_text, only: gnuplot_text
   use ek_gnuplot, only: ink, on_design
   use ek_kandc_map, only: kandc_map_t
   use ek_map_request, only: over_opposite
   use ek_slopes, only: zero_of
   use ek_export_sources, only: sources_t, source_values
   use ek_export_figure, only: panel_list_t, add_panel
   use ek_carmaker, only: skc_table_lines, load_names
   use ek_load_response, only: load_parts
   use ek_carsim, only: par_table_lines
   use ek_wheel_motion, only: at_rx, at_tx, at_toe, at_camber, at_lengths
   implicit none(type, external)
   private
   public :: carmaker_panels, carsim_panels, mathworks_panels, csv_panels

   character(*), parameter :: travel_label = 'wheel centre, height [mm]', steer_label = 'steer, driver [mm]'

contains

   !> The style of the points of the written file.
   pure function point_style() result(text)
      character(:), allocatable :: text
      text = ' with points pointtype 6 pointsize 1.1'//ink(on_design)
   end function point_style

   !> The style of a line whose slope is a number of the written file.
   pure function line_style() result(text)
      character(:), allocatable :: text
      text = ' with lines dashtype 2 linewidth 2'//ink(on_design)
   end function line_style

   !> Adds panels of the kinematics of one side over travel, over steer if the map has steer, and of the five diagonal compliances.
   subroutine carmaker_panels(map, sources, file, text, list)
      type(kandc_map_t), intent(in) :: map
      type(sources_t), intent(in) :: sources
      character(*), intent(in) :: file, text            !! name and content of the written file
      type(panel_list_t), intent(out) :: list
      character(1) :: letter
      real(wp) :: signs(2)
      real(wp), allocatable :: x(:), slopes(:)
      integer :: k

      letter = merge('L', 'R', sources%side == 1)
      signs = merge(-1.0_wp, 1.0_wp, sources%side == 1)*[1.0_wp, 1.0_wp]
      x = source_values(sources, sources%travel, 'wheel_travel_mm')
      call over_travel('tx', 'mm', 3, 1.0e3_wp, 'wheel_centre_x_mm', 1.0_wp)
      call over_travel('ty', 'mm', 4, 1.0e3_wp, 'wheel_centre_y_mm', 1.0_wp)
      call over_travel('rx', 'deg', 6, 1.0_wp/degree, 'camber_deg', signs(1))
      call over_travel('rz', 'deg', 8, 1.0_wp/degree, 'toe_deg', signs(2))
      call over_travel('lSpring', 'mm', 9, 1.0e3_wp, trim(map%length_labels(1, sources%side))//'_length_mm', 1.0_wp)
      if (sources%has_steer) then
         x = map%driver_sign*source_factor(sources)
         call over_steering('rz', 8, 'toe_deg', signs(2))
         call over_steering('rx', 6, 'camber_deg', signs(1))
      end if
      do k = 1, 5
         slopes = numbers_behind(text, 'Com.0.'//letter//'.'//load_names(k)//' =', 6)
         associate (place => load_parts(k))
            call add_panel(list, 'Com '//load_names(k)//' → '//trim(merge('t', 'r', place < 4))//load_names(k)(5:5), &
               trim(merge('N  ', 'N m', place < 4)), trim(merge('mm ', 'deg', place < 4)), &
               decimal(slopes(place)*merge(1.0e3_wp, 1.0_wp/degree, place < 4))//'*x'//line_style(), &
               load_values(sources, k), load_changes(sources, k, place))
         end associate
      end do

   contains

      !> Adds a panel of one column over the wheel travel.
      subroutine over_travel(name, unit, column, scale, source, sign)
         character(*), intent(in) :: name, unit, source
         integer, intent(in) :: column
         real(wp), intent(in) :: scale, sign
         real(wp), allocatable :: y(:)

         if (column == 9) then
            y = length_values(sources, source)
         else
            y = source_values(sources, sources%travel, source)
         end if
         if (size(y) /= size(x)) return
         call add_panel(list, name//' over travel, side '//letter, travel_label, name//' ['//unit//']', gnuplot_text(file)// &
            rows_of_table()//' using ($2=='//str(zero_of(map%second) - 1)//' ? $5*1e3 : NaN):($'//str(column)//'*'// &
            decimal(scale)//')'//point_style(), x, sign*y)
      end subroutine over_travel

      !> Adds a panel of one column over steer.
      subroutine over_steering(name, column, source, sign)
         character(*), intent(in) :: name, source
         integer, intent(in) :: column
         real(wp), intent(in) :: sign

         call add_panel(list, name//' over steer, side '//letter, steer_label, name//' [deg]', gnuplot_text(file)// &
            rows_of_table()//' using ($1=='//str(zero_of(map%travel) - 1)//' ? word("'//list_of(map%second/millimetre)// &
            '", int($2)+1)+0 : NaN):($'//str(column)//'*'//decimal(1.0_wp/degree)//')'//point_style(), x, &
            sign*source_values(sources, sources%steer, source))
      end subroutine over_steering

      !> The gnuplot expression for the rows of the table of the side.
      function rows_of_table() result(words)
         character(:), allocatable :: words
         integer :: n

         n = max(size(map%second), 2)      ! as the file has
         words = ' skip '//str(skc_table_lines(text, sources%side))//' every ::0:0:'//str(size(map%travel)*(n + 1) - 2)//':0'
      end function rows_of_table

   end subroutine carmaker_panels

   pure function list_of(values) result(words)
      real(wp), intent(in) :: values(:)
      character(:), allocatable :: words
      integer :: k

      words = decimal(values(1))
      do k = 2, size(values)
         words = words//' '//decimal(values(k))
      end do
   end function list_of

   !> The swept values of the steering test that was solved separately.
   function source_factor(sources) result(values)
      type(sources_t), intent(in) :: sources
      real(wp), allocatable :: values(:)
      values = sources%steer%values(2, :)       ! state, factor, …
   end function source_factor

   !> The values of a length column in the travel test, given by its full name; no values if the test does not have the column.
   function length_values(sources, name) result(values)
      type(sources_t), intent(in) :: sources
      character(*), intent(in) :: name
      real(wp), allocatable :: values(:)
      integer :: k

      allocate (values(0))
      do k = 1, size(sources%travel%columns)
         if (sources%travel%columns(k) == name) values = sources%travel%values(k, :)
      end do
   end function length_values

   !> The values of one load on the drawn wheel, at the points where all other loads are 0 [N, N m].
   function load_values(sources, part) result(values)
      type(sources_t), intent(in) :: sources
      integer, intent(in) :: part               !! Fx, Fy, Mx, My, Mz
      real(wp), allocatable :: values(:)
      integer :: first, count

      call rows_of_load(sources, part, first, count)
      values = sources%loads%load(5*(sources%side - 1) + part, first:first + count - 1)
   end function load_values

   !> The change of a quantity of the drawn wheel under one load on it, relative to the state without load [mm, deg].
   function load_changes(sources, part, quantity) result(values)
      type(sources_t), intent(in) :: sources
      integer, intent(in) :: part, quantity
      real(wp), allocatable :: values(:)
      integer :: first, count

      call rows_of_load(sources, part, first, count)
      values = sources%loads%value(quantity, first:first + count - 1, sources%side)
      values = values - values((count + 1)/2)
      if (quantity < at_rx) then
         values = values/millimetre
      else
         values = values/degree
      end if
   end function load_changes

   !> Finds the rows of a load. The loads are stored one after the other, with the left wheel first.
   pure subroutine rows_of_load(sources, part, first, count)
      type(sources_t), intent(in) :: sources
      integer, intent(in) :: part
      integer, intent(out) :: first, count
      integer :: block

      block = part
      if (size(sources%loads%load, 2) > 5*21) block = part + 5*(sources%side - 1)
      count = 21
      first = (block - 1)*count + 1
   end subroutine rows_of_load

   !> The numbers that follow a key in a string; 0 if the string does not contain the key.
   function numbers_behind(text, key, count) result(values)
      character(*), intent(in) :: text, key
      integer, intent(in) :: count
      real(wp) :: values(count)
      integer :: at, status

      values = 0.0_wp
      at = index(text, key)
      if (at > 0) read (text(at + len(key):), *, iostat=status) values
   end function numbers_behind

   !> Adds panels of four tables over jounce (toe, camber, x, lateral), and of the coefficients of steer under Fy and Mz, camber and
   !> x under Fx, and spring compression. Without a spring length, the panel of spring compression is omitted.
   subroutine carsim_panels(map, sources, file, text, list)
      type(kandc_map_t), intent(in) :: map
      type(sources_t), intent(in) :: sources
      character(*), intent(in) :: file, text
      type(panel_list_t), intent(out) :: list
      character(*), parameter :: words(4) = [character(16) :: 'TOE_TABLE', 'CAMBER_TABLE', 'SUSP_X_TABLE', 'SUSP_LAT_TABLE']
      character(*), parameter :: names(4) = [character(17) :: 'toe_deg', 'camber_deg', 'wheel_centre_x_mm', 'wheel_centre_y_mm']
      real(wp), allocatable :: x(:), y(:)
      real(wp) :: sign, slope(1)
      integer :: k, section

      x = source_values(sources, sources%travel, 'wheel_travel_mm')
      allocate (y(size(x)))
      do k = 1, 4
         y = source_values(sources, sources%travel, trim(names(k)))
         if (k == 4 .and. sources%side == 2) y = -y
         call add_panel(list, trim(words(k))//', iside '//str(sources%side), travel_label, trim(merge('deg', 'mm ', k < 3)), &
            gnuplot_text(file)//' skip '//str(par_table_lines(text, trim(words(k)), sources%side))//' every ::0:0:'// &
            str(size(map%travel) - 1)//':0 using 1:2'//point_style(), x, y)
      end do
      section = index(text, 'iside '//str(sources%side))
      sign = merge(-1.0_wp, 1.0_wp, sources%side == 1)
      slope = numbers_behind(text(section:), 'CS_FY_COEFFICIENT', 1)
      call add_panel(list, 'CS_FY, steer under Fy', 'N', 'deg', decimal(slope(1))//'*x'//line_style(), load_values(sources, 2), &
         sign*load_changes(sources, 2, at_toe))
      slope = numbers_behind(text(section:), 'CS_MZ_COEFFICIENT', 1)
      call add_panel(list, 'CS_MZ, steer under Mz', 'N m', 'deg', decimal(slope(1))//'*x'//line_style(), load_values(sources, 5), &
         sign*load_changes(sources, 5, at_toe))
      slope = numbers_behind(text(section:), 'CC_FX_COEFFICIENT', 1)
      call add_panel(list, 'CC_FX, camber under Fx', 'N', 'deg', decimal(slope(1))//'*x'//line_style(), load_values(sources, 1), &
         load_changes(sources, 1, at_camber))
      slope = numbers_behind(text(section:), 'C_LONG_COEFFICIENT', 1)
      call add_panel(list, 'C_LONG, x under Fx', 'N', 'mm', decimal(slope(1))//'*x'//line_style(), load_values(sources, 1), &
         load_changes(sources, 1, at_tx))
      slope = numbers_behind(text(section:), 'CMP_SPR_SEAT_COEFFICIENT', 1)
      y = length_values(sources, trim(map%length_labels(1, sources%side))//'_length_mm')
      if (size(y) == size(x)) call add_panel(list, 'CMP_SPR_SEAT, compression of the spring', travel_label, 'mm', &
         decimal(slope(1))//'*x'//line_style(), x, -(y - y(minloc(abs(x), dim=1))))
   end subroutine carsim_panels

   !> Adds panels of the tables over travel of the script. Each has its gradient as a line through design, except NrmlWhlRates.
   subroutine mathworks_panels(sources, file, text, corner, points, list)
      type(sources_t), intent(in) :: sources
      character(*), intent(in) :: file, text
      character(2), intent(in) :: corner                !! of the drawn wheel
      integer, intent(in) :: points                     !! number of points of the tables over travel
      type(panel_list_t), intent(out) :: list
      character(*), parameter :: words(5) = [character(16) :: 'BumpSteer', 'BumpCamber', 'BumpCaster', 'LatWhlCtrDisp', &
         'LngWhlCtrDisp']
      character(*), parameter :: names(5) = [character(17) :: 'toe_deg', 'camber_deg', 'caster_deg', 'wheel_centre_y_mm', &
         'wheel_centre_x_mm']
      real(wp), allocatable :: x(:), y(:)
      real(wp) :: slope(1), gradients(4)
      integer :: k, from, line, at, status, number

      x = source_values(sources, sources%travel, 'wheel_travel_mm')
      allocate (y(size(x)))
      number = (index('FLFRRLRR', corner) + 1)/2
      do k = 1, 5
         y = source_values(sources, sources%travel, trim(names(k)))
         if (size(y) == 0) cycle
         if (k == 1 .and. sources%side == 1) y = -y
         y = y - y(minloc(abs(x), dim=1))
         from = index(text, 'KnCTables.'//trim(words(k))//'.'//corner//' = [')
         line = line_count(text(:from))
         gradients = 0.0_wp
         at = index(text, new_line('a')//trim(words(k))//' = [') + len_trim(words(k)) + 5
         read (text(at:), *, iostat=status) gradients(:number)
         slope = gradients(number)
         call add_panel(list, trim(words(k))//'.'//corner, travel_label, trim(merge('deg', 'mm ', k < 4)), &
            decimal(slope(1))//'*x'//line_style()//" title '', "//gnuplot_text(file)//' skip '//str(line)//' every ::0:0:'// &
            str(points - 1)//':0 using 1:2'//point_style(), x, y)
      end do
      y = source_values(sources, sources%travel, 'vertical_force_n')
      from = index(text, 'KnCTables.NrmlWhlRates.'//corner//' = [')
      line = line_count(text(:from))
      call add_panel(list, 'NrmlWhlRates.'//corner, travel_label, 'N', gnuplot_text(file)//' skip '//str(line)//' every ::0:0:'// &
         str(points - 1)//':0 using 1:2'//point_style(), x, y)
   end subroutine mathworks_panels

   !> Adds panels of the kinematics of the left (or only) wheel.
   subroutine csv_panels(map, sources, file, is_sae, list)
      type(kandc_map_t), intent(in) :: map
      type(sources_t), intent(in) :: sources
      character(*), intent(in) :: file
      logical, intent(in) :: is_sae
      type(panel_list_t), intent(out) :: list
      character(*), parameter :: columns(5) = [character(16) :: 'x_mm', 'y_mm', 'toe_deg', 'camber_deg', 'spring_length_mm']
      character(*), parameter :: names(5) = [character(17) :: 'wheel_centre_x_mm', 'wheel_centre_y_mm', 'toe_deg', 'camber_deg', '']
      character(:), allocatable :: side, at_design, up
      real(wp), allocatable :: x(:), y(:)
      integer :: k

      side = trim(merge('left ', 'right', sources%side == 1))//'_'
      up = trim(merge('-', ' ', is_sae))
      at_design = 'steer_mm'
      if (map%kind == over_opposite) at_design = trim(merge('right', 'left ', sources%side == 1))//'_travel_mm'
      x = source_values(sources, sources%travel, 'wheel_travel_mm')
      allocate (y(size(x)))
      do k = 1, 5
         if (k == 5) then
            y = length_values(sources, trim(map%length_labels(1, sources%side))//'_length_mm')
         else
            y = source_values(sources, sources%travel, trim(names(k)))
         end if
         if (k == 2 .and. is_sae) y = -y
         call add_panel(list, side//trim(columns(k)), travel_label, trim(columns(k)), gnuplot_text(file)// &
            ' using (abs(column("'//at_design//'"))<1e-9 ? '//up//'column("'//side//'z_mm") : NaN):(column("'//side// &
            trim(columns(k))//'"))'//point_style(), x, y)
      end do
      if (.not. sources%has_steer) return
      x = map%driver_sign*source_factor(sources)
      do k = 3, 4
         call add_panel(list, side//trim(columns(k))//' over steer', steer_label, trim(columns(k)), gnuplot_text(file)// &
            ' using (abs(column("travel_mm"))<1e-9 ? column("steer_mm") : NaN):(column("'//side//trim(columns(k))//'"))'// &
            point_style(), x, source_values(sources, sources%steer, trim(names(k))))
      end do
   end subroutine csv_panels

end module ek_export_panels
