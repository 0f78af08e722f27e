!> A test that was run: its table and the data needed to interpret it.
!>
!> Charts, gradients and pages are made only from this result; missing columns are omitted.
module ek_test_result
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_rig_test, only: rig_test_t, rig_test, of_one_wheel, steers, loads_wheels
   use ek_table, only: table_t, name_length, column_index, column_range
   implicit none(type, external)
   private
   public :: test_result_t, test_grid_t
   public :: frame_line, read_frame_line, find_wheels, choose_abscissa, converged_rows, unfolded_rows, design_row, state_range
   public :: wheel_column, has_column, travel_column, min_stroke, wheel_word

   character(*), parameter :: travel_column = 'wheel_travel_mm'
   character(*), parameter :: axes_mark = 'axes ', iso = 'iso', right_mark = ', a right wheel'
   real(wp), parameter :: min_stroke = 1.0_wp   !! least travel [mm] of kind 'other'; with less, the abscissa is the load factor

   !> The grid of a test over travel and steering: its levels in ascending order, and the row of the table at each pair of levels.
   type :: test_grid_t
      real(wp), allocatable :: travel(:)     !! levels of the wheel travel [mm]
      real(wp), allocatable :: steer(:)      !! levels of the driver, in `unit`
      character(:), allocatable :: driver    !! name of the driver
      character(3) :: unit = 'mm'            !! unit of the driver: mm, deg or -
      integer, allocatable :: row(:, :)      !! row of the table: (travel, steer); 0: the state did not converge
   end type test_grid_t

   type :: test_result_t
      type(table_t), allocatable :: read     !! `table` with the states where slopes are read; not allocated: `table` has them
      character(:), allocatable :: name      !! name of the case, unique in a report
      character(:), allocatable :: kind      !! kind of test: 'parallel_travel', 'roll', 'lateral_force', …; 'other'
      character(:), allocatable :: title     !! heading of the test on a page
      character(:), allocatable :: file      !! file of the table, in the folder of the report
      !> Abscissa of the charts: a column of each wheel or of the axle; its label with unit. abscissa_size is the value in the
      !> unit of the label per unit of the column.
      character(:), allocatable :: abscissa, label
      real(wp) :: abscissa_size = 1.0_wp
      real(wp) :: factor_size = 1.0_wp       !! load or displacement at `factor` = 1 [N, N m or mm]
      real(wp) :: reach = huge(1.0_wp)       !! the case covers ± this swept value around design, or one side if it has no other one
      real(wp) :: wheel_size = 0.0_wp        !! steering-wheel angle at `factor` = 1, as a magnitude [deg]; 0: unknown
      character(48) :: held = ''             !! condition of the wheels: 'vertical force held'; '': unknown
      logical :: is_anti = .false.           !! the loads on the right and left wheels are opposite
      real(wp) :: trail = 0.0_wp             !! distance of the lateral force aft of the contact point [m]
      logical :: is_iso = .false.            !! vectors in the table are in ISO 8855 axes (x forward, y left)
      character(name_length), allocatable :: prefixes(:)   !! prefixes of the columns of the wheels: '', or 'left_' and 'right_'
      integer, allocatable :: sides(:)       !! sides of the wheels: −1 left, +1 right
      logical :: is_run = .true.             !! false: the model could not be solved, and the table is empty
      logical :: is_whole = .true.           !! false: the solution lacks a state, so that its extremes are not those of the test
      type(table_t) :: table
      type(test_grid_t), allocatable :: grid !! grid of the states; not allocated: no grid
      character(:), allocatable :: envelope  !! file of the wheel envelope of a grid, in the folder of the report
      type(message_list_t) :: remarks        !! messages on failed or doubtful states
   end type test_result_t

contains

   !> The header line of a table that defines its signs: the axes of its vectors, and the side of a single wheel, whose columns have
   !> no prefix.
   pure function frame_line(is_iso, side) result(line)
      logical, intent(in) :: is_iso
      integer, intent(in) :: side           !! side of a single wheel: −1 left, +1 right; 0: two wheels or none
      character(:), allocatable :: line

      line = axes_mark//'x-rear'
      if (is_iso) line = axes_mark//iso
      if (side > 0) line = line//right_mark
   end function frame_line

   !> Reads axes and side from a header line. Other lines change nothing.
   pure subroutine read_frame_line(line, is_iso, side)
      character(*), intent(in) :: line
      logical, intent(inout) :: is_iso
      integer, intent(inout) :: side

      if (index(line, axes_mark) /= 1) return
      is_iso = index(line, axes_mark//iso) == 1
      if (index(line, right_mark) > 0) side = 1
   end subroutine read_frame_line

   !> Sets prefixes and sides from the columns, the left wheel first. A single wheel has no prefix; its side is given.
   pure subroutine find_wheels(test, side)
      type(test_result_t), intent(inout) :: test
      integer, intent(in), optional :: side      !! side of a single wheel; absent: left
      integer :: k, place

      test%prefixes = [character(name_length) ::]
      test%sides = [integer ::]
      do k = 1, size(test%table%columns)
         place = len_trim(test%table%columns(k)) - len(travel_column)
         if (place < 0) cycle
         if (test%table%columns(k) (place + 1:) /= travel_column) cycle
         test%prefixes = [character(name_length) :: test%prefixes, test%table%columns(k) (:place)]
         if (place == 0 .and. present(side)) then
            test%sides = [test%sides, side]
         else
            test%sides = [test%sides, merge(1, -1, index(test%table%columns(k) (:place), 'right') > 0)]
         end if
      end do
      if (size(test%sides) /= 2) return
      if (test%sides(1) < test%sides(2)) return
      test%prefixes = test%prefixes([2, 1])
      test%sides = test%sides([2, 1])
   end subroutine find_wheels

   !> Sets the abscissa of the charts for a kind of test. An abscissa that is already set is unchanged. The abscissa is the
   !> load factor if the table does not have the column of the abscissa, or if a test of kind 'other' has less travel than
   !> min_stroke.
   subroutine choose_abscissa(test)
      type(test_result_t), intent(inout) :: test
      type(rig_test_t) :: kind
      character(:), allocatable :: side
      integer :: at

      if (allocated(test%abscissa)) return
      kind = rig_test(test%kind)
      test%abscissa = trim(kind%abscissa)
      test%label = trim(kind%label)
      test%abscissa_size = 1.0_wp
      if (of_one_wheel(kind)) then
         side = trim(merge('left ', 'right', stroke('right_'//travel_column) <= stroke('left_'//travel_column)))
         test%abscissa = side//'_'//travel_column
         test%label = 'travel of the '//side//' wheel [mm]    (+ bump)'
      else if (kind%action == steers .and. column_index(test%table, test%abscissa) == 0) then
         call set_factor('steering input [mm]    (+ left)')
      else if (kind%action == loads_wheels) then
         at = index(test%label, ' [')
         if (test%is_anti) test%label = test%label(:at - 1)//' on the left wheel'//test%label(at:)
         call set_factor(test%label)
      end if
      if (test%abscissa /= 'factor' .and. .not. has_column(test, test%abscissa)) call set_factor('load factor')
      if (test%kind == 'other' .and. stroke(travel_column) < min_stroke) call set_factor('load factor')

   contains

      !> The largest span of a column of any wheel or of the axle, in the unit of the column; 0 without values.
      pure real(wp) function stroke(name)
         character(*), intent(in) :: name
         real(wp) :: range(2)
         integer :: k

         stroke = 0.0_wp
         range = column_range(test%table, name)
         if (ieee_is_finite(range(1))) stroke = range(2) - range(1)
         do k = 1, size(test%prefixes)
            range = column_range(test%table, trim(test%prefixes(k))//name)
            if (ieee_is_finite(range(1))) stroke = max(stroke, range(2) - range(1))
         end do
      end function stroke

      subroutine set_factor(label)
         character(*), intent(in) :: label
         test%abscissa = 'factor'
         test%label = label
         test%abscissa_size = test%factor_size
      end subroutine set_factor

   end subroutine choose_abscissa

   !> Index of the column of a wheel, or of the axle if the wheel has no column with this name; 0 if neither exists.
   pure integer function wheel_column(test, wheel, name) result(place)
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: wheel
      character(*), intent(in) :: name

      place = 0
      if (wheel <= size(test%prefixes)) place = column_index(test%table, trim(test%prefixes(wheel))//name)
      if (place == 0) place = column_index(test%table, name)
   end function wheel_column

   !> Whether a wheel, or the axle, has a column of this name.
   pure logical function has_column(test, name)
      type(test_result_t), intent(in) :: test
      character(*), intent(in) :: name
      integer :: k

      has_column = any([(wheel_column(test, k, name) > 0, k=1, size(test%prefixes) + 1)])
   end function has_column

   !> Whether each row is a converged state. Without a column `converged`, every row is.
   pure function converged_rows(table) result(is_good)
      type(table_t), intent(in) :: table
      logical :: is_good(size(table%values, 2))
      integer :: place

      is_good = .true.
      place = column_index(table, 'converged')
      if (place == 0) return
      is_good = ieee_is_finite(table%values(place, :))
      where (is_good) is_good = table%values(place, :) > 0.5_wp
   end function converged_rows

   !> Whether each row is a converged state on the branch through design, along which the factor does not turn back. If a path
   !> turns back (limit points, follow = 'arc'), several states have the same factor; slopes and interpolation use only this
   !> branch. Without a column `factor`, every converged row is.
   pure function unfolded_rows(table) result(is_good)
      type(table_t), intent(in) :: table
      logical :: is_good(size(table%values, 2))
      integer :: place, middle, turned(2)

      is_good = converged_rows(table)
      place = column_index(table, 'factor')
      if (place == 0) return
      is_good = is_good .and. ieee_is_finite(table%values(place, :))
      if (.not. any(is_good)) return
      middle = minloc(abs(table%values(place, :)), dim=1, mask=is_good)
      turned = [rotation_behind(middle, -1), rotation_behind(middle, 1)]
      is_good(:turned(1)) = .false.
      is_good(turned(2):) = .false.

   contains

      !> The index of the first row on one side of `middle` at which the factor changes direction. If there is none, it is the
      !> index before the first row or after the last row.
      pure integer function rotation_behind(middle, step) result(row)
         integer, intent(in) :: middle, step
         real(wp) :: before, way, first_way

         before = table%values(place, middle)
         first_way = 0.0_wp
         row = middle + step
         do while (row >= 1 .and. row <= size(is_good))
            if (is_good(row)) then
               way = table%values(place, row) - before
               if (first_way*way < 0.0_wp) return
               if (abs(way) > 0.0_wp) first_way = way
               before = table%values(place, row)
            end if
            row = row + step
         end do
      end function rotation_behind

   end function unfolded_rows

   !> Smallest and largest swept value of the converged states of a table; NaN without such a state.
   pure function state_range(table) result(range)
      type(table_t), intent(in) :: table
      real(wp) :: range(2)
      logical :: is_good(size(table%values, 2))
      integer :: factor

      range = ieee_value(1.0_wp, ieee_quiet_nan)
      factor = column_index(table, 'factor')
      if (factor == 0) return
      is_good = converged_rows(table) .and. ieee_is_finite(table%values(factor, :))
      if (.not. any(is_good)) return
      range(1) = minval(table%values(factor, :), mask=is_good)
      range(2) = maxval(table%values(factor, :), mask=is_good)
   end function state_range

   !> Index of the last converged row with `factor` = 0, the design state; 0 if there is no such row.
   pure integer function design_row(table) result(row)
      type(table_t), intent(in) :: table
      logical :: is_good(size(table%values, 2))
      integer :: place

      row = 0
      place = column_index(table, 'factor')
      if (place == 0) return
      is_good = converged_rows(table) .and. ieee_is_finite(table%values(place, :))
      where (is_good) is_good = abs(table%values(place, :)) <= 0.0_wp
      row = findloc(is_good, .true., dim=1, back=.true.)
   end function design_row

   !> The side in a prefix: 'left' for 'left_'; '' for a single wheel.
   pure function wheel_word(prefix) result(word)
      character(*), intent(in) :: prefix
      character(:), allocatable :: word
      word = prefix(:max(0, len_trim(prefix) - 1))
   end function wheel_word

end module ek_test_result
