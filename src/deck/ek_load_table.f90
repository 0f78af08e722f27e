!> A table of loads: a CSV file in which every row is one state.
!>
!> | column (two wheels: left_…, right_…)  | quantity                                                 |
!> |---------------------------------------|----------------------------------------------------------|
!> | fx_n, fy_n, fz_n                      | force at the contact point, frame of the deck            |
!> | mx_nm, my_nm, mz_nm                   | moment on the wheel                                      |
!> | centre_fx_n, centre_fy_n, centre_fz_n | force at the wheel centre                                |
!> | travel_mm                             | height of the wheel centre above design, held            |
!> | <driver>_mm, <driver>_deg             | change of the value prescribed by a driver joint         |
!> | name                                  | name of the state in the results, as a string            |
!>
!> The loads of the table act in addition to the constant loads of the deck. Loads and drivers without a column stay constant.
module ek_load_table
   use ek_kinds, only: wp, degree, millimetre
   use ek_error, only: error_t
   use ek_text, only: str, quoted, suggestion, plural, lower
   use ek_kept_files, only: kept_files_t
   use ek_case, only: case_t, load_table_t, table_column_t, max_driven
   use ek_measure, only: rotation
   use ek_suspension, only: suspension_t, driver_row
   use ek_quantity, only: name_length
   use ek_sheet, only: sheet_t, read_sheet, mistakes_of, head_place, cell_of
   use ek_sheet_columns, only: take_columns, has_numbers
   use ek_unit_row, only: unit_of_heading
   use ek_wheel_side, only: prefix_of, left_and_right
   implicit none(type, external)
   private
   public :: read_tables

   !> Columns of a wheel: loads, in the order of the components of table_column_t, and the height of the wheel.
   character(*), parameter :: wheel_columns(10) = [character(11) :: 'fx_n', 'fy_n', 'fz_n', 'mx_nm', 'my_nm', 'mz_nm', &
      'centre_fx_n', 'centre_fy_n', 'centre_fz_n', 'travel_mm']
   integer, parameter :: height = 10
   character(*), parameter :: passed_over(2) = [character(6) :: 'state', 'factor']      !! columns of results files, ignored

contains

   !> Reads the tables that cases name. Errors in a table, as 'table.csv:7: error', are stored in its case, because only a command
   !> that uses the case reports them.
   subroutine read_tables(files, cases, suspension, is_whole)
      type(kept_files_t), intent(in) :: files          !! files already read, which are not read again
      type(case_t), intent(inout) :: cases(:)
      type(suspension_t), intent(in) :: suspension     !! wheels and drivers, which determine the headings
      logical, intent(in) :: is_whole                  !! the suspension is complete; otherwise the headings are not checked
      integer :: j, k

      do k = 1, size(cases)
         if (cases(k)%test /= 'table' .or. cases(k)%file == '') cycle
         if (index(cases(k)%file, '/', back=.true.) == len(cases(k)%file)) cycle
         do j = 1, k - 1
            if (cases(j)%file == cases(k)%file) exit
         end do
         if (j < k) then
            cases(k)%table = cases(j)%table
         else
            call read_table(cases(k)%file, files, suspension, is_whole, cases(k)%table)
         end if
         if (allocated(cases(k)%table%fault)) cases(k)%table%fault = cases(k)%table%mistakes%line(1)//'; in case '// &
            quoted(cases(k)%name)//' ('//cases(k)%where//')'
      end do
   end subroutine read_tables

   !> Reads one table of loads. Errors are stored in the table, which then has no rows.
   subroutine read_table(file, files, suspension, is_whole, table)
      character(*), intent(in) :: file
      type(kept_files_t), intent(in) :: files
      type(suspension_t), intent(in) :: suspension
      logical, intent(in) :: is_whole
      type(load_table_t), intent(out) :: table
      type(error_t), allocatable :: error
      type(sheet_t) :: sheet
      type(table_column_t), allocatable :: columns(:)
      real(wp), allocatable :: unit(:), values(:, :)
      character(16), allocatable :: units(:)
      logical, allocatable :: is_kept(:), is_number(:)
      integer, allocatable :: places(:)
      integer :: wheels(2), k, name_place

      call read_sheet(file, sheet, error, files)
      if (allocated(error)) then
         table%fault = error%message
         call table%mistakes%add(error%message)
         return
      end if
      allocate (columns(size(sheet%heads)), unit(size(sheet%heads)))
      is_number = has_numbers(sheet)
      is_kept = [(sheet%heads(k) /= '' .and. .not. any(sheet%heads(k) == passed_over), k=1, size(sheet%heads))]
      name_place = findloc([(lower(trim(sheet%heads(k))) == 'name', k=1, size(sheet%heads))], .true., dim=1)
      if (name_place > 0) is_kept(name_place) = .false.
      do k = 2, size(sheet%heads)                          ! the first one is the index that other programs write
         if (sheet%heads(k) == '' .and. is_number(k)) call sheet%head_mistakes%add(head_place(sheet)//'column '//str(k)// &
            ' has no name')
      end do
      if (is_whole) then
         call left_and_right(suspension, wheels)
         do k = 1, size(sheet%heads)
            call find_meaning(trim(sheet%heads(k)), suspension, wheels, columns(k), unit(k))
         end do
         call omit_text(unit > 0.0_wp .or. is_number)
         call judge_columns(sheet, suspension, wheels, is_kept .and. .not. unit > 0.0_wp)
      else
         call omit_text(is_number .or. [(unit_of_heading(trim(sheet%heads(k))) /= '', k=1, size(columns))])
      end if
      places = pack([(k, k=1, size(columns))], is_kept)
      allocate (units(size(places)))
      do k = 1, size(places)
         units(k) = unit_of_heading(trim(sheet%heads(places(k))))
      end do
      call take_columns(sheet, places, values, units)
      call mistakes_of(sheet, table%mistakes)
      if (table%mistakes%count() > 0 .or. .not. is_whole) return
      table%rows = size(values, 2)
      do k = 1, merge(table%rows, 0, name_place > 0)
         call table%names%add(cell_of(sheet, k + max(sheet%unit_row, 0), name_place))
      end do
      do k = 1, size(places)
         columns(places(k))%values = values(k, :)*unit(places(k))
      end do
      table%columns = columns(places)

   contains

      !> Removes columns of text, such as remarks, unless the table has no other columns.
      subroutine omit_text(may_be_load)
         logical, intent(in) :: may_be_load(:)

         if (any(is_kept .and. may_be_load)) is_kept = is_kept .and. may_be_load
      end subroutine omit_text

   end subroutine read_table

   !> Finds the meaning of a column by its heading, and the SI value of its unit. The unit is 0 if the heading has no meaning in the
   !> model.
   pure subroutine find_meaning(head, suspension, wheels, column, unit)
      character(*), intent(in) :: head
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: wheels(2)      !! indices of the left and of the right wheel; 0: none
      type(table_column_t), intent(out) :: column
      real(wp), intent(out) :: unit
      character(:), allocatable :: prefix
      integer :: side, mark, row
      logical :: is_angle

      column%name = head
      do side = 1, 2
         if (wheels(side) == 0) cycle
         prefix = prefix_of(suspension, wheels(side))
         if (index(head, prefix) /= 1) cycle
         column%component = findloc(wheel_columns, head(len(prefix) + 1:), dim=1)
         if (column%component == 0) cycle
         column%wheel = wheels(side)
         unit = merge(millimetre, 1.0_wp, column%component == height)
         if (column%component == height) column%component = 0
         return
      end do
      unit = 0.0_wp
      mark = index(head, '_', back=.true.)
      if (mark < 2) return
      row = driver_row(suspension, head(:mark - 1))
      if (row == 0) return
      column%name = head(:mark - 1)
      is_angle = suspension%terms(suspension%rows(row)%first)%measure%kind == rotation
      if (is_angle .and. head(mark:) == '_deg') unit = degree
      if (.not. is_angle .and. head(mark:) == '_mm') unit = millimetre
   end subroutine find_meaning

   !> Adds errors to the sheet: headings without a meaning in the model, and too many columns.
   subroutine judge_columns(sheet, suspension, wheels, is_unknown)
      type(sheet_t), intent(inout) :: sheet
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: wheels(2)
      logical, intent(in) :: is_unknown(:)
      integer, parameter :: max_reported = 10      ! a table for another purpose has many
      integer :: k

      if (count(sheet%heads /= '') > max_driven) call sheet%head_mistakes%add(head_place(sheet)//'expected at most '// &
         str(max_driven)//' columns, found '//str(count(sheet%heads /= '')))
      do k = 1, size(sheet%heads)
         if (is_unknown(k) .and. count(is_unknown(:k)) <= max_reported) call sheet%head_mistakes%add(head_place(sheet)// &
            'unknown column '//quoted(sheet%heads(k))//advice(trim(sheet%heads(k)), suspension, wheels))
      end do
      if (count(is_unknown) > max_reported) call sheet%head_mistakes%add(head_place(sheet)//'and '// &
         plural(count(is_unknown) - max_reported, 'more unknown column', 'more unknown columns'))
   end subroutine judge_columns

   !> Advice on an unknown column: a similar name; otherwise a hint on separators if the heading contains a blank; otherwise the
   !> known columns. It is '' if there is no wheel, and neither a similar name nor a blank.
   function advice(name, suspension, wheels) result(words)
      character(*), intent(in) :: name
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: wheels(2)
      character(:), allocatable :: words
      character(name_length) :: known(20)
      integer :: side, used

      known = ''
      used = 0
      do side = 1, 2
         if (wheels(side) == 0) cycle
         known(used + 1:used + 10) = prefix_of(suspension, wheels(side))//wheel_columns
         used = used + 10
      end do
      words = suggestion(name, known)
      if (words /= '') return
      if (index(name, ' ') > 0) then
         words = ' (separate the columns by commas)'
      else if (used > 0) then
         words = ' (known: '//trim(known(1))//' … '//trim(known(used))//', <driver>_mm, <driver>_deg)'
      end if
   end function advice

end module ek_load_table
