!> A table of loads: a CSV file in which every row is one state.
!>
!> | column (two wheels: left_…, right_…)  | quantity                                                 |
!> |---------------------------------------|----------------------------------------------------------|
!> | fx_n, fy_n, fz_n                      | force at the contact patch, frame of the deck            |
!> | mx_nm, my_nm, mz_nm                   | moment on the wheel                                      |
!> | centre_fx_n, centre_fy_n, centre_fz_n | force at the wheel centre                                |
!> | travel_mm                             | height of the wheel centre above design, held            |
!> | <driver>_mm, <driver>_deg             | change of the value prescribed by a driver joint         |
!>
!> Loads and heights act in addition to the constant loads of the deck; quantities without a column stay constant.
module ek_load_table
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_deck
   use ek_text, only: str, quoted, nearest_name, plural
   use ek_units, only: degree, millimetre
   use ek_case, only: case_t, append_course, follows_table
   use ek_measure, only: rotation
   use ek_state, only: most_driven
   use ek_suspension, only: suspension_t, load_t, driver_row
   use ek_builder, only: add_height_driver, add_load
   use ek_table, only: name_length
   use ek_sheet, only: sheet_t, read_sheet, mistakes_of, head_place
   use ek_wheel_side, only: prefix_of, height_name, left_and_right
   implicit none(type, external)
   private
   public :: mount_table, check_table

   character(*), parameter :: load_columns(9) = [character(11) :: 'fx_n', 'fy_n', 'fz_n', 'mx_nm', 'my_nm', 'mz_nm', &
      'centre_fx_n', 'centre_fy_n', 'centre_fz_n']

   character(*), parameter :: passed_over(2) = [character(6) :: 'state', 'factor']      !! columns of result files reused as loads

contains

   !> Adds the loads and drivers of the table's columns, and makes its rows the path of the case.
   subroutine mount_table(suspension, case, wheels, error)
      type(suspension_t), intent(inout) :: suspension
      type(case_t), intent(inout) :: case
      integer, intent(in) :: wheels(2)      !! left, right; 0: none
      type(error_t), allocatable, intent(out) :: error   !! exit_file: not readable; exit_deck: all errors in the table
      type(sheet_t) :: sheet
      type(message_list_t) :: mistakes
      integer :: k

      call read_sheet(case%file, sheet, error)
      if (allocated(error)) then
         error%message = error%message//'; in case '//quoted(case%name)//' ('//case%where//')'
         return
      end if
      call judge_columns(sheet, suspension, wheels)
      call mistakes_of(sheet, mistakes)
      if (mistakes%count() > 0) then
         call fail(error, exit_deck, mistakes%text())
         return
      end if
      do k = 1, size(sheet%heads)
         if (sheet%heads(k) /= '') call take_column(trim(sheet%heads(k)), sheet%values(k, :))
      end do
      case%from = 1.0_wp
      case%to = size(sheet%values, 2)
      case%increments = size(sheet%values, 2) - 1
      if (size(sheet%values, 2) == 1) then      ! from the design state, which is also reported
         case%from = 0.0_wp
         case%increments = 1
      end if

   contains

      subroutine take_column(name, values)
         character(*), intent(in) :: name
         real(wp), intent(in) :: values(:)
         character(:), allocatable :: prefix, stem
         integer :: side, c, row
         logical :: is_angle

         if (any(name == passed_over)) return
         do side = 1, 2
            if (wheels(side) == 0) cycle
            prefix = prefix_of(suspension, wheels(side))
            if (index(name, prefix) /= 1) cycle
            stem = name(len(prefix) + 1:)
            if (stem == 'travel_mm') then
               if (driver_row(suspension, height_name(side)) == 0) call add_height_driver(suspension, height_name(side), &
                  case%where, wheels(side:side), [1.0_wp], .false.)
               call append_course(case%courses, '', height_name(side), 1.0_wp, follows_table, values*millimetre)
               return
            end if
            do c = 1, size(load_columns)
               if (load_columns(c) /= stem) cycle
               call add_unit_load(name, wheels(side), c, values)
               return
            end do
         end do
         row = driver_of(name, suspension)
         if (row == 0) return
         is_angle = suspension%terms(suspension%rows(row)%first)%measure%kind == rotation
         call append_course(case%courses, '', name(:index(name, '_', back=.true.) - 1), 1.0_wp, follows_table, &
            values*merge(degree, millimetre, is_angle))
      end subroutine take_column

      !> A unit force or moment along an axis of the deck, scaled by a column.
      subroutine add_unit_load(name, wheel, c, values)
         character(*), intent(in) :: name
         integer, intent(in) :: wheel, c      !! c: index in load_columns
         real(wp), intent(in) :: values(:)
         type(load_t) :: load
         integer :: axis
         real(wp) :: unit

         axis = mod(c - 1, 3) + 1
         unit = 1.0_wp
         if (suspension%is_iso .and. axis < 3) unit = -1.0_wp
         load%name = 'rig_'//name
         load%where = case%where
         load%body = suspension%wheels(wheel)%body
         load%arm = suspension%wheels(wheel)%contact
         if (c > 6) load%arm = suspension%wheels(wheel)%centre
         if (c >= 4 .and. c <= 6) then
            load%moment(axis) = unit
         else
            load%force(axis) = unit
         end if
         load%is_case = .true.
         call add_load(suspension, load)
         call append_course(case%courses, load%name, '', 1.0_wp, follows_table, values)
      end subroutine add_unit_load

   end subroutine mount_table

   !> All errors in the table of a case, in `mistakes`, as 'table.csv:7: error'.
   subroutine check_table(file, mistakes, error, suspension)
      character(*), intent(in) :: file
      type(message_list_t), intent(inout) :: mistakes
      type(error_t), allocatable, intent(out) :: error           !! exit_file: the file cannot be read
      type(suspension_t), intent(in), optional :: suspension     !! absent: the heads are not compared with a model
      type(sheet_t) :: sheet
      integer :: wheels(2)

      call read_sheet(file, sheet, error)
      if (allocated(error)) return
      if (present(suspension)) then
         call left_and_right(suspension, wheels)
         call judge_columns(sheet, suspension, wheels)
      end if
      call mistakes_of(sheet, mistakes)
   end subroutine check_table

   !> Adds errors to the sheet: heads unknown in a model, and too many columns.
   subroutine judge_columns(sheet, suspension, wheels)
      type(sheet_t), intent(inout) :: sheet
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: wheels(2)
      integer, parameter :: most_told = 10      ! a table for another purpose has many
      integer :: k, unknown

      if (count(sheet%heads /= '') > most_driven) call sheet%head_mistakes%add(head_place(sheet)//'expected at most '// &
         str(most_driven)//' columns, found '//str(count(sheet%heads /= '')))
      unknown = 0
      do k = 1, size(sheet%heads)
         if (sheet%heads(k) == '' .or. has_meaning(trim(sheet%heads(k)), suspension, wheels)) cycle
         unknown = unknown + 1
         if (unknown <= most_told) call sheet%head_mistakes%add(head_place(sheet)//'unknown column '// &
            quoted(sheet%heads(k))//advice(trim(sheet%heads(k)), suspension, wheels))
      end do
      if (unknown > most_told) call sheet%head_mistakes%add(head_place(sheet)//'and '// &
         plural(unknown - most_told, 'more unknown column', 'more unknown columns'))
   end subroutine judge_columns

   !> Whether a column is a drive, a load or a number of a state.
   pure logical function has_meaning(name, suspension, wheels)
      character(*), intent(in) :: name
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: wheels(2)
      character(:), allocatable :: prefix
      integer :: side

      has_meaning = any(name == passed_over) .or. driver_of(name, suspension) > 0
      do side = 1, 2
         if (wheels(side) == 0) cycle
         prefix = prefix_of(suspension, wheels(side))
         if (index(name, prefix) /= 1) cycle
         has_meaning = has_meaning .or. any(name(len(prefix) + 1:) == [character(11) :: load_columns, 'travel_mm'])
      end do
   end function has_meaning

   !> The row of the driver joint of a column <driver>_mm or <driver>_deg; 0 if there is none, or it has another unit.
   pure integer function driver_of(name, suspension) result(row)
      character(*), intent(in) :: name
      type(suspension_t), intent(in) :: suspension
      integer :: mark
      logical :: is_angle

      row = 0
      mark = index(name, '_', back=.true.)
      if (mark > 1) row = driver_row(suspension, name(:mark - 1))
      if (row == 0) return
      is_angle = suspension%terms(suspension%rows(row)%first)%measure%kind == rotation
      if (name(mark:) /= trim(merge('_deg', '_mm ', is_angle))) row = 0
   end function driver_of

   !> Hint on the known columns.
   function advice(name, suspension, wheels) result(words)
      character(*), intent(in) :: name
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: wheels(2)
      character(:), allocatable :: words
      character(name_length) :: known(2*size(load_columns) + 2)
      integer :: side, c, used

      known = ''
      used = 0
      do side = 1, 2
         if (wheels(side) == 0) cycle
         do c = 1, size(load_columns)
            used = used + 1
            known(used) = prefix_of(suspension, wheels(side))//load_columns(c)
         end do
         used = used + 1
         known(used) = prefix_of(suspension, wheels(side))//'travel_mm'
      end do
      words = nearest_name(name, known)
      if (words /= '') then
         words = ' (did you mean '//quoted(words)//'?)'
      else if (index(name, ' ') > 0) then
         words = ' (separate the columns by commas)'
      else if (used > 0) then
         words = ' (known: '//trim(known(1))//' … '//trim(known(used))//', <driver>_mm, <driver>_deg)'
      end if
   end function advice

end module ek_load_table
