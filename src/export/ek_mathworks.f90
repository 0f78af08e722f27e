!> Maps of one or both axles as parameters of the block "Independent Suspension - K and C" of the Vehicle Dynamics Blockset: a
!> script (.m), and the same parameters in JSON.
!>
!> Arrays of wheels are [FL FR RL RR], arrays of axles [F R]. The values of an axle without a deck are NaN (null in JSON). Gradients
!> are slopes at design.
!> Signs of ISO 8855: steer positive to the left, camber positive top outward, caster positive top rearward, x forward, y to the
!> left, z and travel up; forces and Mz act on the wheel in these directions. Units are mm, deg, N, N m; the loaded radius is in m.
module ek_mathworks
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite
   use ek_kinds, only: wp, degree, millimetre
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_decimal, only: decimal
   use ek_json, only: json_t, json_string, json_number, json_numbers
   use ek_version, only: version
   use ek_gnuplot_text, only: one_line
   use ek_wheel_motion, only: at_tx, at_ty, at_tz, at_rz, at_camber, at_caster, at_load, at_lengths, damper_length
   use ek_kandc_map, only: kandc_map_t
   use ek_map_request, only: over_steer
   use ek_slopes, only: travel_curve, steer_curve, slope_at_zero, zero_of, load_response, load_response_t, roll_rates, wheel_rate
   implicit none(type, external)
   private
   public :: kandc_parameters_t, kandc_table_t, find_parameters, mathworks_script, mathworks_json, corner_names

   integer, parameter :: corners = 4
   character(2), parameter :: corner_names(corners) = ['FL', 'FR', 'RL', 'RR']

   !> An array of the block: 1×4, 1×2 (of axles) or 2×4 (braking, driving).
   type :: kandc_array_t
      character(20) :: name = ''
      character(10) :: unit = ''
      integer :: rows = 1, columns = corners
      character(90) :: meaning = ''
      real(wp) :: values(2, corners) = 0.0_wp
   end type kandc_array_t

   !> A table of the block: a struct of n×2 arrays.
   type :: kandc_table_t
      character(20) :: name = ''
      character(34) :: units = ''
      integer :: abscissa = 0, quantity = 0      !! quantities of ek_wheel_motion; abscissa at_rz: over steer
      real(wp) :: abscissa_unit = 1.0_wp, unit = 1.0_wp
      logical :: is_change = .true.              !! the quantity is a change from the value at design
   end type kandc_table_t

   type(kandc_table_t), parameter :: tables(8) = [ &
      kandc_table_t('BumpSteer', 'mm, deg', at_tz, at_rz, millimetre, degree), &
      kandc_table_t('BumpCamber', 'mm, deg', at_tz, at_camber, millimetre, degree), &
      kandc_table_t('BumpCaster', 'mm, deg', at_tz, at_caster, millimetre, degree), &
      kandc_table_t('LatWhlCtrDisp', 'mm, mm', at_tz, at_ty, millimetre, millimetre), &
      kandc_table_t('LngWhlCtrDisp', 'mm, mm', at_tz, at_tx, millimetre, millimetre), &
      kandc_table_t('NrmlWhlRates', 'mm, N', at_tz, at_load, millimetre, 1.0_wp, .false.), &
      kandc_table_t('CambVsSteerAng', 'deg, deg', at_rz, at_camber, degree, degree), &
      kandc_table_t('CastVsSteerAng', 'deg, deg', at_rz, at_caster, degree, degree)]
   integer, parameter :: first_over_steer = 7

   type :: kandc_parameters_t
      type(kandc_array_t) :: arrays(28)
      integer :: used = 0
      type(kandc_map_t) :: maps(2)          !! front, rear
      logical :: has(2) = .false.
      character(16) :: checksums(2) = ''
   end type kandc_parameters_t

contains

   !> Fills the arrays of the parameters from the maps of the axles that have a map.
   subroutine find_parameters(p)
      type(kandc_parameters_t), intent(inout) :: p      !! its maps, has and checksums are set
      character(*), parameter :: brake = 'row 1 braking (Fx < 0 at the contact point), '// &
         'row 2 driving (Fx > 0 at the wheel centre)'

      p%used = 0
      call add('BumpSteer', 'deg/mm', 'steer per travel')
      call add('BumpCamber', 'deg/mm', 'camber per travel')
      call add('BumpCaster', 'deg/mm', 'caster per travel')
      call add('LatWhlCtrDisp', 'mm/mm', 'y of the wheel centre per travel')
      call add('LngWhlCtrDisp', 'mm/mm', 'x of the wheel centre per travel')
      call add('NrmlWhlRates', 'N/mm', 'wheel rate in parallel travel')
      call add('NrmlWhlFrcOff', 'N', 'wheel load at design')
      call add('CambVsSteerAng', 'deg/deg', 'camber per steer of the wheel')
      call add('CastVsSteerAng', 'deg/deg', 'caster per steer of the wheel')
      call add('LngSteerCompl', 'deg/N', brake, 2)
      call add('LngCambCompl', 'deg/N', brake, 2)
      call add('LngCastCompl', 'deg/N', brake, 2)
      call add('LngWhlCtrCompl', 'mm/N', brake, 2)
      call add('LatWhlCtrComplLngBrk', 'mm/N', brake, 2)
      call add('LatSteerCompl', 'deg/N', 'steer per Fy at the contact point')
      call add('LatCambCompl', 'deg/N', 'camber per Fy at the contact point')
      call add('LatWhlCtrComplLat', 'mm/N', 'y of the wheel centre per Fy at the contact point')
      call add('AlgnTrqSteerCompl', 'deg/(N m)', 'steer per Mz')
      call add('AlgnTrqCambCompl', 'deg/(N m)', 'camber per Mz')
      call add('StatToe', 'deg', 'toe at design, positive: front edge inward')
      call add('StatCamber', 'deg', 'camber at design')
      call add('StatCaster', 'deg', 'caster at design')
      call add('StatLdWhlR', 'm', 'height of the wheel centre above the contact point at design')
      call add('MotRatios', '-', 'compression of the damper per travel; axles', 1, 2)
      call add('RollStiffArb', 'N m/deg', 'roll stiffness with the bar; axles', 1, 2)
      call add('RollStiffNoArb', 'N m/deg', 'roll stiffness from the wheel rates in parallel travel, without the bar', 1, 2)

   contains

      subroutine add(name, unit, meaning, rows, columns)
         character(*), intent(in) :: name, unit, meaning
         integer, intent(in), optional :: rows, columns
         integer :: axle, side, row

         p%used = p%used + 1
         associate (a => p%arrays(p%used))
            a%name = name
            a%unit = unit
            a%meaning = meaning
            if (present(rows)) a%rows = rows
            if (present(columns)) a%columns = columns
            a%values = ieee_value(1.0_wp, ieee_quiet_nan)
            do axle = 1, 2
               if (.not. p%has(axle)) cycle
               if (a%columns == 2) then
                  a%values(1, axle) = of_axle(p%maps(axle), name)
                  cycle
               end if
               do side = 1, 2
                  do row = 1, a%rows
                     a%values(row, 2*axle - 2 + side) = of_wheel(p%maps(axle), side, name, row == 1)
                  end do
               end do
            end do
         end associate
      end subroutine add

   end subroutine find_parameters

   !> The value of a wheel in an array, in the unit of the array.
   function of_wheel(map, side, name, is_braking) result(value)
      type(kandc_map_t), intent(in) :: map
      integer, intent(in) :: side
      character(*), intent(in) :: name
      logical, intent(in) :: is_braking
      real(wp) :: value
      type(load_response_t) :: response
      real(wp) :: left      ! toe → steer to the left
      integer :: k, component

      left = merge(-1.0_wp, 1.0_wp, side == 1)
      component = 1
      if (index(name, 'Lat') == 1 .and. name /= 'LatWhlCtrComplLngBrk') component = 2
      if (index(name, 'Algn') == 1) component = 6
      response = load_response(map, side, component, component > 1 .or. is_braking)
      do k = 1, size(tables)
         if (tables(k)%name /= name .or. name == 'NrmlWhlRates') cycle
         value = ieee_value(1.0_wp, ieee_quiet_nan)
         if (k < first_over_steer .or. map%kind == over_steer) value = slope(map, side, tables(k))
         return
      end do
      select case (name)
      case ('NrmlWhlRates')
         value = wheel_rate(map, side)*millimetre
      case ('LngSteerCompl', 'LatSteerCompl', 'AlgnTrqSteerCompl')
         value = left*response%toe/degree
      case ('LngCambCompl', 'LatCambCompl', 'AlgnTrqCambCompl')
         value = response%camber/degree
      case ('LngCastCompl')
         value = -response%spin/degree
      case ('LngWhlCtrCompl')
         value = response%shift(1)/millimetre
      case ('LatWhlCtrComplLngBrk', 'LatWhlCtrComplLat')
         value = response%shift(2)/millimetre
      case ('StatToe')
         value = left*at_design(map, side, at_rz)/degree
      case ('StatCamber')
         value = at_design(map, side, at_camber)/degree
      case ('StatCaster')
         value = at_design(map, side, at_caster)/degree
      case ('StatLdWhlR')
         value = -map%arm(3, side)
      case default       ! NrmlWhlFrcOff
         value = at_design(map, side, at_load)
      end select
   end function of_wheel

   !> The value of an axle in the array `name`, in the unit of the array.
   function of_axle(map, name) result(value)
      type(kandc_map_t), intent(in) :: map
      character(*), intent(in) :: name
      real(wp) :: value
      real(wp) :: x(size(map%travel)), y(size(map%travel)), rates(2)

      rates = roll_rates(map)*degree
      select case (name)
      case ('RollStiffArb')
         value = rates(1)
      case ('RollStiffNoArb')
         value = rates(2)
      case default       ! MotRatios
         x = travel_curve(map, at_tz, 1)
         y = travel_curve(map, at_lengths + damper_length, 1)
         value = -slope_at_zero(x, y)
      end select
   end function of_axle

   !> The value of a quantity of one side at design.
   pure real(wp) function at_design(map, side, quantity)
      type(kandc_map_t), intent(in) :: map
      integer, intent(in) :: side, quantity
      real(wp) :: curve(size(map%travel))

      curve = travel_curve(map, quantity, side)
      at_design = curve(zero_of(map%travel))
   end function at_design

   !> The slope of a table of one side at design.
   function slope(map, side, table) result(value)
      type(kandc_map_t), intent(in) :: map
      integer, intent(in) :: side
      type(kandc_table_t), intent(in) :: table
      real(wp) :: value
      real(wp), allocatable :: x(:), y(:)

      call curve_of(map, side, table, x, y)
      value = slope_at_zero(x, y)
   end function slope

   !> Extracts the two columns of a table of one side in the units of the table. The quantity is a change from design if the block
   !> adds the static value; steer as abscissa always is.
   subroutine curve_of(map, side, table, x, y)
      type(kandc_map_t), intent(in) :: map
      integer, intent(in) :: side
      type(kandc_table_t), intent(in) :: table
      real(wp), allocatable, intent(out) :: x(:), y(:)

      if (table%abscissa == at_rz) then
         x = (steer_curve(map, at_rz, side) - at_design(map, side, at_rz))/table%abscissa_unit
         y = steer_curve(map, table%quantity, side)/table%unit
      else
         x = travel_curve(map, table%abscissa, side)/table%abscissa_unit
         y = travel_curve(map, table%quantity, side)/table%unit
      end if
      if (table%is_change) y = y - at_design(map, side, table%quantity)/table%unit
   end subroutine curve_of

   !> The parameters as a MATLAB script.
   function mathworks_script(p) result(text)
      type(kandc_parameters_t), intent(in) :: p
      character(:), allocatable :: text
      type(buffer_t) :: file
      real(wp), allocatable :: x(:), y(:)
      integer :: k, axle, side, row, i

      call file%line('% Parameters of the block Independent Suspension - K and C (Vehicle Dynamics Blockset)')
      call file%line('% elastokin '//version)
      do axle = 1, 2
         call file%line('% '//axle_line(p, axle))
      end do
      call file%line('% Arrays are [FL FR RL RR], of axles [F R]. Steer positive to the left, camber positive top outward, caster')
      call file%line('% positive top rearward, x forward, y to the left, z and travel up; Mz up. In the block: ISO directions.')
      call file%line('% Units are in the comments; compare them, and the order of the two rows, with the dialog of the block.')
      call file%line('')
      do k = 1, p%used
         associate (a => p%arrays(k))
            call file%add(trim(a%name)//' = [')
            do row = 1, a%rows
               if (row > 1) call file%add('; ')
               do i = 1, a%columns
                  if (i > 1) call file%add(' ')
                  call file%add(matlab_number(a%values(row, i)))
               end do
            end do
            call file%line(']; % '//trim(a%unit)//': '//trim(a%meaning))
         end associate
      end do
      call file%line('')
      call file%line('% The same as tables, for the table-based settings: BumpSteer = KnCTables.BumpSteer; and so on')
      do k = 1, size(tables)
         call file%line('% '//trim(tables(k)%name)//': '//trim(tables(k)%units)// &
            trim(merge(', change from design', '                    ', tables(k)%is_change)))
         do axle = 1, 2
            if (.not. p%has(axle)) cycle
            if (k >= first_over_steer .and. p%maps(axle)%kind /= over_steer) cycle
            do side = 1, 2
               call curve_of(p%maps(axle), side, tables(k), x, y)
               call file%line('KnCTables.'//trim(tables(k)%name)//'.'//corner_names(2*axle - 2 + side)//' = [')
               do i = 1, size(x)
                  call file%line('  '//matlab_number(x(i))//' '//matlab_number(y(i)))
               end do
               call file%line('];')
            end do
         end do
      end do
      text = file%text()
   end function mathworks_script

   function axle_line(p, axle) result(text)
      type(kandc_parameters_t), intent(in) :: p
      integer, intent(in) :: axle
      character(:), allocatable :: text

      text = trim(merge('front: ', 'rear:  ', axle == 1))//' '
      if (.not. p%has(axle)) then
         text = text//'no deck, NaN'
         return
      end if
      text = text//one_line(p%maps(axle)%title)//', model '//p%maps(axle)%model//', deck checksum '//trim(p%checksums(axle))
   end function axle_line

   pure function matlab_number(value) result(text)
      real(wp), intent(in) :: value
      character(:), allocatable :: text

      text = 'NaN'
      if (ieee_is_finite(value)) text = decimal(value)
   end function matlab_number

   !> The parameters as JSON (schema/export-matlab-kc.schema.json). The layout differs from the script.
   function mathworks_json(p) result(text)
      type(kandc_parameters_t), intent(in) :: p
      character(:), allocatable :: text
      type(json_t) :: json
      real(wp), allocatable :: x(:), y(:)
      integer :: k, axle, side

      call json%open('{')
      call json%item('program', json_string('elastokin '//version))
      call json%item('block', json_string('Independent Suspension - K and C'))
      call json%item('signs', json_string('ISO 8855'))
      call json%open('{', 'axles')
      do axle = 1, 2
         call json%open('{', trim(merge('front', 'rear ', axle == 1)))
         if (p%has(axle)) then
            call json%item('model', json_string(p%maps(axle)%model))
            call json%item('deck_checksum', json_string(trim(p%checksums(axle))))
         end if
         call json%close('}')
      end do
      call json%close('}')
      call json%open('{', 'arrays')
      do k = 1, p%used
         associate (a => p%arrays(k))
            call json%open('{', trim(a%name))
            call json%item('unit', json_string(trim(a%unit)))
            call json%item('meaning', json_string(trim(a%meaning)))
            if (a%rows == 1) then
               call json%item('value', json_numbers(a%values(1, :a%columns)))
            else
               call json%item('value', '['//json_numbers(a%values(1, :))//', '//json_numbers(a%values(2, :))//']')
            end if
            call json%close('}')
         end associate
      end do
      call json%close('}')
      call json%open('{', 'tables')
      do k = 1, size(tables)
         call json%open('{', trim(tables(k)%name))
         call json%item('units', json_string(trim(tables(k)%units)))
         do axle = 1, 2
            if (.not. p%has(axle)) cycle
            if (k >= first_over_steer .and. p%maps(axle)%kind /= over_steer) cycle
            do side = 1, 2
               call curve_of(p%maps(axle), side, tables(k), x, y)
               call json%open('{', corner_names(2*axle - 2 + side))
               call json%item('x', json_numbers(x))
               call json%item('y', json_numbers(y))
               call json%close('}')
            end do
         end do
         call json%close('}')
      end do
      call json%close('}')
      call json%close('}')
      text = json%text()
   end function mathworks_json

end module ek_mathworks
