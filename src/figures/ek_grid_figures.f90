!> The figures and the table of a test over travel and steering: carpets of toe and camber, and the envelope of the wheels in space.
!> The envelope contains the positions of the wheel centres and the directions of the spin axes.
module ek_grid_figures
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite
   use ek_kinds, only: wp, millimetre
   use ek_text, only: str
   use ek_frame, only: frame_t, new_frame
   use ek_noise, only: is_noise, solved
   use ek_quantity, only: quantity_named, label_of, head_with_unit
   use ek_rig_test, only: swept_unit
   use ek_suspension, only: suspension_t, driver_unit
   use ek_case, only: case_t
   use ek_wheel_side, only: left_and_right
   use ek_grid, only: is_grid, grid_size, grid_levels, grid_place
   use ek_table, only: column_index, row_count
   use ek_test_result, only: test_result_t, converged_rows, wheel_word
   use ek_study_data, only: range_of_values, tic_step
   use ek_figure, only: figure_t, panel_t, axis_t, new_figure, add_series, as_line, as_segments
   use ek_carpet_figure, only: carpet_t, new_carpet, carpet_figure, is_drawn, on_equal
   use ek_gnuplot, only: on_zero
   implicit none(type, external)
   private
   public :: find_grid, grid_carpet, carpet_name, envelope_name, envelope_figure, envelope_text

   character(*), parameter :: carpet_columns(2) = [character(10) :: 'toe_deg', 'camber_deg']
   !> Columns of the envelope. In the table of the test, the wheel centre is a change from design.
   character(*), parameter :: envelope_columns(6) = [character(17) :: 'wheel_centre_x_mm', 'wheel_centre_y_mm', &
      'wheel_centre_z_mm', 'spin_axis_x', 'spin_axis_y', 'spin_axis_z']

contains

   !> Finds the grid of a test if the case has a grid: the levels in ascending order, and the table row of each pair of
   !> levels. The row is 0 if the state did not converge.
   subroutine find_grid(suspension, case, test)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case               !! case without a rig
      type(test_result_t), intent(inout) :: test     !! test with its table
      logical :: is_good(row_count(test%table))
      integer :: levels(2), place(2), k

      if (.not. is_grid(case)) return
      levels = grid_size(case)
      allocate (test%grid)
      associate (grid => test%grid)
         grid%driver = case%drive
         grid%unit = driver_unit(suspension, case%drive)
         grid%travel = grid_levels(case%from, case%to, case%increments)/millimetre
         grid%steer = grid_levels(case%steer_from, case%steer_to, case%steer_increments)/swept_unit(grid%unit)
         allocate (grid%row(levels(1), levels(2)), source=0)
         is_good = converged_rows(test%table)
         do k = 1, size(is_good)
            place = grid_place(levels, k)
            if (is_good(k)) grid%row(place(1), place(2)) = k
         end do
         if (case%from > case%to) then
            grid%travel = grid%travel(levels(1):1:-1)
            grid%row = grid%row(levels(1):1:-1, :)
         end if
         if (case%steer_from > case%steer_to) then
            grid%steer = grid%steer(levels(2):1:-1)
            grid%row = grid%row(:, levels(2):1:-1)
         end if
      end associate
   end subroutine find_grid

   !> Name of the figure of the carpets of a test, without suffix.
   pure function carpet_name(test) result(name)
      type(test_result_t), intent(in) :: test
      character(:), allocatable :: name
      name = test%name//'_carpet'
   end function carpet_name

   !> Name of the figure of the envelope of a test, without suffix.
   pure function envelope_name(test) result(name)
      type(test_result_t), intent(in) :: test
      character(:), allocatable :: name
      name = test%name//'_envelope'
   end function envelope_name

   !> The carpets of toe and camber for every wheel; for the left wheel only if the right wheel is its mirror image.
   function grid_carpet(test, model) result(figure)
      type(test_result_t), intent(in) :: test        !! with a grid
      character(*), intent(in) :: model
      type(figure_t) :: figure
      character(:), allocatable :: side
      type(carpet_t) :: carpet
      integer :: wheels, wheel, c, r

      wheels = size(test%prefixes)
      if (is_symmetric(test)) wheels = 1
      carpet = new_carpet(test%grid%travel, test%grid%steer, size(carpet_columns)*wheels, [.false., .false.])
      call carpet%factors%add('wheel travel [mm]')
      call carpet%factors%add(test%grid%driver//' ['//trim(test%grid%unit)//']')
      r = 0
      do c = 1, size(carpet_columns)
         do wheel = 1, wheels
            r = r + 1
            side = wheel_word(test%prefixes(wheel))
            if (len(side) > 0) side = ', '//side
            associate (quantity => quantity_named(carpet_columns(c)))
               call carpet%responses%add(trim(quantity%title)//side//', '//label_of(quantity))
            end associate
            carpet%value(:, :, r) = values_of(test, wheel, trim(carpet_columns(c)))
         end do
      end do
      side = ''
      if (wheels < size(test%prefixes)) side = '; the right wheel is its mirror image, with the opposite '//test%grid%driver
      figure = carpet_figure(carpet, carpet_name(test), test%title//': carpets of toe and camber', model//side)
   end function grid_carpet

   !> Whether the right wheel has the values of the left wheel at the opposite value of the driver, but for noise (ek_noise).
   pure logical function is_symmetric(test)
      type(test_result_t), intent(in) :: test
      real(wp), dimension(size(test%grid%travel), size(test%grid%steer)) :: left, right
      logical :: is_there(size(test%grid%travel), size(test%grid%steer))
      integer :: n, c

      n = size(test%grid%steer)
      is_symmetric = size(test%prefixes) == 2 .and. all(are_equal(test%grid%steer, &
         -test%grid%steer(n:1:-1), 'steer_'//trim(test%grid%unit)))
      if (.not. is_symmetric) return
      do c = 1, size(carpet_columns)
         left = values_of(test, 1, trim(carpet_columns(c)))
         right = values_of(test, 2, trim(carpet_columns(c)))
         right = right(:, n:1:-1)
         is_there = ieee_is_finite(left)
         is_symmetric = is_symmetric .and. all(is_there .eqv. ieee_is_finite(right))
         is_symmetric = is_symmetric .and. all(are_equal(left, right, trim(carpet_columns(c))) .or. .not. is_there)
      end do
   end function is_symmetric

   !> Whether two values of a result are equal but for noise (ek_noise). .false. if one of them is not a number.
   elemental logical function are_equal(a, b, column)
      real(wp), intent(in) :: a, b
      character(*), intent(in) :: column         !! column heading of the result

      are_equal = .false.
      if (ieee_is_finite(a) .and. ieee_is_finite(b)) are_equal = is_noise(a - b, column, max(abs(a), abs(b)), solved)
   end function are_equal

   !> The values of a column of a wheel on the grid; NaN where the test has no value.
   pure function values_of(test, wheel, column) result(values)
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: wheel
      character(*), intent(in) :: column
      real(wp) :: values(size(test%grid%travel), size(test%grid%steer))
      integer :: place, i, j

      values = ieee_value(1.0_wp, ieee_quiet_nan)
      place = column_index(test%table, trim(test%prefixes(wheel))//column)
      if (place == 0) return
      do j = 1, size(values, 2)
         do i = 1, size(values, 1)
            if (test%grid%row(i, j) > 0) values(i, j) = test%table%values(place, test%grid%row(i, j))
         end do
      end do
   end function values_of

   !> The wheel centres at design in the frame of the deck [mm], left before right. A single wheel is first, and the second is
   !> 0. The table of a test gives changes from these positions.
   pure function design_centres(suspension) result(centres)
      type(suspension_t), intent(in) :: suspension
      real(wp) :: centres(3, 2)
      integer :: wheels(2), k, used

      centres = 0.0_wp
      call left_and_right(suspension, wheels)
      used = 0
      do k = 1, 2
         if (wheels(k) == 0) cycle
         used = used + 1
         associate (wheel => suspension%wheels(wheels(k)))
            centres(:, used) = (suspension%bodies(wheel%body)%origin + wheel%centre)/millimetre
         end associate
      end do
      if (suspension%is_iso) centres(:2, :) = -centres(:2, :)
   end function design_centres

   !> The envelope in space. For each wheel it has the surface of the wheel centre as lines of equal travel and of equal
   !> steering. The spin axis is a stroke outboard of the centre.
   function envelope_figure(test, suspension) result(figure)
      type(test_result_t), intent(in) :: test        !! with a grid
      type(suspension_t), intent(in) :: suspension
      type(figure_t) :: figure
      real(wp), parameter :: stroke = 60.0_wp        ! mm
      real(wp), dimension(size(test%grid%travel), size(test%grid%steer), 3) :: centre, spin
      character(:), allocatable :: side
      real(wp) :: design(3, 2), low(3), high(3), ends(2)     ! low, high: of centres and strokes of a wheel
      integer :: wheel, axis

      design = design_centres(suspension)
      figure = new_figure(envelope_name(test), test%title//': envelope of the wheels', suspension%name// &
         '; blue: wheel centre, lines of equal wheel travel, orange: of equal '// &
         test%grid%driver//'; grey: spin axis, '//str(nint(stroke))//' mm outboard', &
         size(test%prefixes), height=700)
      figure%width = merge(1400, 900, size(figure%panels) > 1)
      do wheel = 1, size(figure%panels)
         do axis = 1, 3
            centre(:, :, axis) = design(axis, wheel) + values_of(test, wheel, trim(envelope_columns(axis)))
            spin(:, :, axis) = stroke*values_of(test, wheel, trim(envelope_columns(3 + axis)))
            ends = range_of_values([centre(:, :, axis), centre(:, :, axis) + spin(:, :, axis)])
            low(axis) = ends(1)
            high(axis) = ends(2)
         end do
         associate (panel => figure%panels(wheel))
            side = wheel_word(test%prefixes(wheel))
            if (len(side) > 0) side = side//' wheel; '
            panel%title = side//'z upward [mm]'
            panel%x%label = 'x [mm]'
            panel%y%label = 'y [mm]'
            panel%is_space = .true.
            panel%turn = merge(320.0_wp, 220.0_wp, test%sides(wheel) < 0)
            panel%note = 'no state was found'
            call set_cube(low, high, panel)
            call add_series(panel, as_segments, on_zero, strokes(centre, spin), weight=1.5_wp)
            call add_series(panel, as_line, on_equal(1), surface_lines(centre, 1))
            call add_series(panel, as_line, on_equal(2), surface_lines(centre, 2))
         end associate
      end do
   end function envelope_figure

   !> The lines of a surface of the wheel centre on which one direction of the grid is constant.
   function surface_lines(centre, constant) result(values)
      real(wp), intent(in) :: centre(:, :, :)        !! (travel, steering, axis) [mm]
      integer, intent(in) :: constant                !! 1: travel, 2: steering
      real(wp), allocatable :: values(:, :)
      integer :: levels(2), i, j, rows

      levels = [size(centre, 1), size(centre, 2)]
      allocate (values(3, levels(constant)*(levels(3 - constant) + 1)))
      rows = 0
      do i = 1, levels(constant)
         if (.not. is_drawn(i, levels(constant))) cycle
         do j = 1, levels(3 - constant)
            rows = rows + 1
            if (constant == 1) values(:, rows) = centre(i, j, :)
            if (constant == 2) values(:, rows) = centre(j, i, :)
         end do
         rows = rows + 1
         values(:, rows) = ieee_value(1.0_wp, ieee_quiet_nan)
      end do
      values = values(:, :rows)
   end function surface_lines

   !> The strokes of the spin axis where the lines of a surface meet.
   function strokes(centre, spin) result(values)
      real(wp), intent(in) :: centre(:, :, :), spin(:, :, :)        !! (travel, steering, axis) [mm]
      real(wp), allocatable :: values(:, :)
      integer :: i, j, rows

      allocate (values(6, size(centre, 1)*size(centre, 2)))
      rows = 0
      do j = 1, size(centre, 2)
         do i = 1, size(centre, 1)
            if (.not. (is_drawn(i, size(centre, 1)) .and. is_drawn(j, size(centre, 2)))) cycle
            if (.not. all(ieee_is_finite(spin(i, j, :)))) cycle
            rows = rows + 1
            values(:, rows) = [centre(i, j, :), spin(i, j, :)]
         end do
      end do
      values = values(:, :rows)
   end function strokes

   !> Sets the ranges of the axes to a cube, so that all three axes have one scale.
   subroutine set_cube(low, high, panel)
      real(wp), intent(in) :: low(3), high(3)        !! mm
      type(panel_t), intent(inout) :: panel
      real(wp) :: middle, half

      half = 0.53_wp*max(maxval(high - low), 1.0_wp)
      middle = anint((low(1) + high(1))/2)
      panel%x = cube_axis(panel%x%label)
      middle = anint((low(2) + high(2))/2)
      panel%y = cube_axis(panel%y%label)
      middle = anint((low(3) + high(3))/2)
      panel%z = cube_axis('')

   contains

      type(axis_t) function cube_axis(label) result(axis)
         character(*), intent(in) :: label

         axis%label = label
         axis%has_range = .true.
         axis%range = middle + [-half, half]
         axis%tics = tic_step([-half, half])
         axis%has_grid = .false.
         axis%has_zero = .false.
      end function cube_axis

   end subroutine set_cube

   !> The envelope as CSV: travel, value of the driver, side, wheel centre and spin axis, in the frame of the deck. There is one row
   !> for each wheel at each state, travel varying fastest. States that did not converge have no row.
   function envelope_text(test, suspension) result(text)
      type(test_result_t), intent(in) :: test        !! with a grid
      type(suspension_t), intent(in) :: suspension
      character(:), allocatable :: text
      type(frame_t) :: frame
      real(wp) :: values(size(envelope_columns)), design(3, 2)
      integer :: columns(size(envelope_columns), size(test%prefixes)), wheel, i, j, k

      design = design_centres(suspension)
      frame = new_frame('travel_mm,'//head_with_unit(test%grid%driver, trim(merge('   ', test%grid%unit, &
         test%grid%unit == '-')))//',side,centre_x_mm,centre_y_mm,centre_z_mm,spin_axis_x,spin_axis_y,spin_axis_z')
      frame%header = test%table%header
      do k = 1, size(envelope_columns)
         do wheel = 1, size(test%prefixes)
            columns(k, wheel) = column_index(test%table, trim(test%prefixes(wheel))//envelope_columns(k))
         end do
      end do
      do j = 1, size(test%grid%steer)
         do i = 1, size(test%grid%travel)
            if (test%grid%row(i, j) == 0) cycle
            call frame%put([test%grid%travel(i), test%grid%steer(j)])
            call frame%hold()
            do wheel = 1, size(test%prefixes)
               values = test%table%values(columns(:, wheel), test%grid%row(i, j))
               values(:3) = values(:3) + design(:, wheel)
               call frame%put(trim(merge('right', 'left ', test%sides(wheel) > 0)))
               call frame%put(values)
            end do
            call frame%release()
         end do
      end do
      text = frame%csv()
   end function envelope_text

end module ek_grid_figures
