!> A map as a parsfile for CarSim (.par): tables of kinematics over jounce, and coefficients of compliance, for both sides.
!>
!> Units and signs of jounce, toe, camber, dive, x and y are written above each table. Facts that are not publicly documented, above
!> all the units of the compliance, have the remark "to be confirmed on a screen" in the file.
module ek_carsim
   use ek_kinds, only: wp, degree, millimetre
   use ek_error, only: error_t
   use ek_text, only: str
   use ek_letters, only: line_count
   use ek_buffer, only: buffer_t
   use ek_decimal, only: decimal
   use ek_version, only: version
   use ek_gnuplot_text, only: one_line
   use ek_monotonic, only: check_monotonic
   use ek_wheel_motion, only: at_tx, at_ty, at_tz, at_ry, at_toe, at_camber, at_lengths, spring_length, damper_length, &
      stop_length, length_names
   use ek_kandc_map, only: kandc_map_t
   use ek_slopes, only: travel_curve, load_response, load_response_t, slope_at_zero, wheel_rate, roll_rates
   implicit none(type, external)
   private
   public :: carsim_text, par_table_lines, carsim_tables

   !> A table over jounce: keyword, quantity of ek_wheel_motion, unit in SI, signs on the left and on the right side, meaning.
   type :: par_table_t
      character(16) :: keyword
      integer :: quantity
      real(wp) :: unit
      real(wp) :: signs(2)
      character(90) :: meaning
   end type par_table_t

   character(*), parameter :: unsure = ' (sign: to be confirmed on a screen)'
   type(par_table_t), parameter :: carsim_tables(5) = [ &
      par_table_t('TOE_TABLE', at_toe, degree, [1.0_wp, 1.0_wp], 'deg, positive: front edge inward'//unsure), &
      par_table_t('CAMBER_TABLE', at_camber, degree, [1.0_wp, 1.0_wp], 'deg, positive: top outward'//unsure), &
      par_table_t('SUSP_X_TABLE', at_tx, millimetre, [1.0_wp, 1.0_wp], 'mm, wheel centre, positive: forward'), &
      par_table_t('SUSP_LAT_TABLE', at_ty, millimetre, [1.0_wp, -1.0_wp], 'mm, wheel centre, positive: outward'//unsure), &
      par_table_t('SUSP_DIVE_TABLE', at_ry, degree, [1.0_wp, 1.0_wp], &
      'deg, rotation of the carrier, positive: top forward'//unsure)]

contains

   !> Writes the .par file of a map as a string.
   subroutine carsim_text(map, checksum, text, error)
      type(kandc_map_t), intent(in) :: map
      character(*), intent(in) :: checksum                  !! of the deck
      character(:), allocatable, intent(out) :: text
      type(error_t), allocatable, intent(out) :: error      !! exit_model: jounce is not monotonic
      type(buffer_t) :: file
      real(wp) :: rates(2)
      integer :: side, k

      call check_monotonic(map, 'CarSim', .false., error)
      if (allocated(error)) return
      rates = roll_rates(map)
      call file%line('PARSFILE')
      call remark('elastokin '//version//', '//one_line(map%title)//', model '//map%model//', deck checksum '//checksum)
      call remark('Tables over jounce: travel of the wheel centre in mm, positive up, 0 at design; steer held at 0;')
      call remark('both wheels at the same travel: the file has no effect of one wheel on the other.')
      call remark('Angles of TOE_TABLE and CAMBER_TABLE contain the static angles; leave A_TOE and A_CAMBER at 0.')
      call remark('Remarks "to be confirmed on a screen" stand where sign or unit is not documented in public.')
      do side = 1, 2
         call file%line('')
         call file%line('iside '//str(side))
         if (map%is_mirrored(side)) call remark('mirror image of the other side: the deck has one wheel')
         do k = 1, size(carsim_tables)
            call add_table(map, carsim_tables(k), side, file)
         end do
         call add_ratios(map, side, file)
         call add_compliance(map, side, file)
      end do
      call file%line('')
      call remark('Of the axle at design: wheel rate left '//number(wheel_rate(map, 1)*millimetre)//' N/mm, right '// &
         number(wheel_rate(map, 2)*millimetre)//' N/mm')
      call remark('part of the bar in the roll stiffness, N m/deg (0 within rounding: no bar)')
      call file%line('MX_AUX_COEFFICIENT '//number((rates(1) - rates(2))*degree))
      call file%line('')
      call file%line('END')
      text = file%text()

   contains

      !> Adds a comment line.
      subroutine remark(words)
         character(*), intent(in) :: words
         call file%line('# '//words)
      end subroutine remark

   end subroutine carsim_text

   subroutine add_table(map, table, side, file)
      type(kandc_map_t), intent(in) :: map
      type(par_table_t), intent(in) :: table
      integer, intent(in) :: side
      type(buffer_t), intent(inout) :: file
      real(wp) :: x(size(map%travel)), y(size(map%travel))
      integer :: i

      x = travel_curve(map, at_tz, side)/millimetre
      y = travel_curve(map, table%quantity, side)*table%signs(side)/table%unit
      call file%line('# '//trim(table%meaning))
      call file%line(trim(table%keyword)//' SPLINE')
      do i = 1, size(x)
         call file%line(number(x(i))//', '//number(y(i)))
      end do
      call file%line('ENDTABLE')
   end subroutine add_table

   !> Adds the ratios of the lengths to jounce at design. A ratio is positive if the element shortens in bump.
   subroutine add_ratios(map, side, file)
      type(kandc_map_t), intent(in) :: map
      integer, intent(in) :: side
      type(buffer_t), intent(inout) :: file
      character(*), parameter :: keys(3) = [character(8) :: 'SPR_SEAT', 'DAMP', 'JSTOP']
      integer, parameter :: which(3) = [spring_length, damper_length, stop_length]
      real(wp) :: x(size(map%travel)), y(size(map%travel))
      integer :: k

      x = travel_curve(map, at_tz, side)
      do k = 1, 3
         y = travel_curve(map, at_lengths + which(k), side)
         call file%line('# compression of the '//trim(length_names(which(k)))//' ('//trim(map%length_labels(which(k), side))// &
            ') per jounce at design')
         call file%line('CMP_'//trim(keys(k))//'_COEFFICIENT '//number(-slope_at_zero(x, y)))
      end do
   end subroutine add_ratios

   !> Adds the coefficients of compliance under loads on the wheel itself, in ISO directions.
   subroutine add_compliance(map, side, file)
      type(kandc_map_t), intent(in) :: map
      integer, intent(in) :: side
      type(buffer_t), intent(inout) :: file
      type(load_response_t) :: fx, fy, my, mz
      real(wp) :: outward

      fx = load_response(map, side, 1, .true.)
      fy = load_response(map, side, 2, .true.)
      my = load_response(map, side, 5, .true.)
      mz = load_response(map, side, 6, .true.)
      outward = merge(1.0_wp, -1.0_wp, side == 1)
      call file%line('# compliance: Fx forward and Fy to the left at the contact point, My about y (to the left), Mz up;')
      call file%line('# deg per N, deg per N m, mm per N: units and signs to be confirmed on a screen')
      call file%line('# toe, positive: front edge inward; steer, positive: to the left; camber, positive: top outward;')
      call file%line('# inclination, positive: top to the right; dive, positive: top forward')
      call add('CT_FX', fx%toe/degree)
      call add('CS_FY', -outward*fy%toe/degree)
      call add('CS_MZ', -outward*mz%toe/degree)
      call add('CC_FX', fx%camber/degree)
      call add('CI_FY', -outward*fy%camber/degree)
      call add('CI_MZ', -outward*mz%camber/degree)
      call add('C_LONG', fx%shift(1)/millimetre)
      call add('C_LAT', fy%shift(2)/millimetre)
      call add('CD_MY', my%spin/degree)

   contains

      subroutine add(keyword, value)
         character(*), intent(in) :: keyword
         real(wp), intent(in) :: value
         call file%line(keyword//'_COEFFICIENT '//number(value))
      end subroutine add

   end subroutine add_compliance

   !> Number of lines of the file before the first row of a table of a side, for plots.
   pure integer function par_table_lines(text, keyword, side) result(lines)
      character(*), intent(in) :: text, keyword
      integer, intent(in) :: side
      integer :: from, last

      from = index(text, 'iside '//merge('1', '2', side == 1))
      last = from + index(text(from:), new_line('a')//keyword//' SPLINE')
      lines = line_count(text(:last))
   end function par_table_lines

   pure function number(value) result(text)
      real(wp), intent(in) :: value
      character(:), allocatable :: text
      character(16) :: short
      real(wp) :: rounded

      write (short, '(es16.8e3)') value
      read (short, *) rounded
      text = decimal(rounded)
   end function number

end module ek_carsim
