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
   use ek_case, only: case_t, load_table_t, table_column_t
   use ek_measure, only: rotation
   use ek_state, only: most_driven
   use ek_suspension, only: suspension_t, driver_row
   use ek_table, only: name_length
   use ek_sheet, only: sheet_t, read_sheet, mistakes_of, head_place
   use ek_wheel_side, only: prefix_of, left_and_right
   implicit none(type, external)
   private
   public :: take_table, read_table, has_table, note_unread

   character(*), parameter :: wheel_columns(10) = [character(11) :: 'fx_n', 'fy_n', 'fz_n', 'mx_nm', 'my_nm', 'mz_nm', &
      'centre_fx_n', 'centre_fy_n', 'centre_fz_n', 'travel_mm']
   character(*), parameter :: passed_over(2) = [character(6) :: 'state', 'factor']      !! columns of result files reused as loads

   !> The heads of the wheels of a model, and their meaning.
   type :: heads_t
      integer :: used = 0
      character(name_length) :: names(20) = ''
      integer :: wheel(20) = 0, component(20) = 0      !! of table_column_t
   end type heads_t

contains

   !> Reads the table of a case, before the case is put on the rig; for any other case does nothing.
   subroutine take_table(suspension, case, error)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(inout) :: case
      type(error_t), allocatable, intent(out) :: error   !! exit_file: not readable; exit_deck: all errors in the table
      type(message_list_t) :: mistakes

      if (.not. has_table(case)) return
      call read_table(case%file, case%table, mistakes, error, suspension)
      if (allocated(error)) then
         call note_unread(case, error%message)
         error%message = case%table%fault
      else if (mistakes%count() > 0) then
         call fail(error, exit_deck, mistakes%text())
      end if
   end subroutine take_table

   !> Whether a case names a table.
   pure logical function has_table(case)
      type(case_t), intent(in) :: case

      has_table = .false.
      if (.not. allocated(case%test) .or. .not. allocated(case%file)) return
      has_table = case%test == 'table' .and. case%file /= '' .and. index(case%file, '/', back=.true.) /= len(case%file)
   end function has_table

   !> Keeps the reason why the table of a case cannot be read, for the message when the case is run.
   pure subroutine note_unread(case, message)
      type(case_t), intent(inout) :: case
      character(*), intent(in) :: message

      case%table%fault = message//'; in case '//quoted(case%name)//' ('//case%where//')'
   end subroutine note_unread

   !> Reads a table for a model; all errors in it, as 'table.csv:7: error', in `mistakes`.
   subroutine read_table(file, table, mistakes, error, suspension)
      character(*), intent(in) :: file
      type(load_table_t), intent(out) :: table
      type(message_list_t), intent(inout) :: mistakes
      type(error_t), allocatable, intent(out) :: error           !! exit_file: the file cannot be read
      type(suspension_t), intent(in), optional :: suspension     !! absent: the errors alone, not those of the heads
      type(sheet_t) :: sheet
      type(heads_t) :: known
      integer :: k, used

      call read_sheet(file, sheet, error)
      if (allocated(error)) return
      if (present(suspension)) then
         known = heads_of(suspension)
         call judge_columns(sheet, suspension, known)
      end if
      call mistakes_of(sheet, mistakes)
      if (mistakes%count() > 0 .or. .not. present(suspension)) return
      table%rows = size(sheet%values, 2)
      allocate (table%columns(count([(is_kept(k), k=1, size(sheet%heads))])))
      used = 0
      do k = 1, size(sheet%heads)
         if (.not. is_kept(k)) cycle
         used = used + 1
         call set_column(trim(sheet%heads(k)), sheet%values(k, :), suspension, known, table%columns(used))
      end do

   contains

      !> Whether a column is used: it has a head, other than those passed over.
      pure logical function is_kept(k)
         integer, intent(in) :: k
         is_kept = sheet%heads(k) /= '' .and. .not. any(sheet%heads(k) == passed_over)
      end function is_kept

   end subroutine read_table

   !> The heads of the loads and heights of a model's wheels, the left one first.
   type(heads_t) function heads_of(suspension) result(known)
      type(suspension_t), intent(in) :: suspension
      integer :: wheels(2), side, c

      call left_and_right(suspension, wheels)
      do side = 1, 2
         if (wheels(side) == 0) cycle
         do c = 1, size(wheel_columns)
            known%used = known%used + 1
            known%names(known%used) = prefix_of(suspension, wheels(side))//wheel_columns(c)
            known%wheel(known%used) = wheels(side)
            known%component(known%used) = mod(c, size(wheel_columns))
         end do
      end do
   end function heads_of

   !> What a column acts on, and its values in SI. Its head has a meaning.
   pure subroutine set_column(head, values, suspension, known, column)
      character(*), intent(in) :: head
      real(wp), intent(in) :: values(:)
      type(suspension_t), intent(in) :: suspension
      type(heads_t), intent(in) :: known
      type(table_column_t), intent(out) :: column
      integer :: k

      column%name = head
      column%values = values
      k = findloc(known%names, head, dim=1)
      if (k > 0) then
         column%wheel = known%wheel(k)
         column%component = known%component(k)
         if (column%component == 0) column%values = values*millimetre
      else
         column%name = head(:index(head, '_', back=.true.) - 1)
         column%values = values*merge(degree, millimetre, is_angle_row(suspension, driver_of(head, suspension)))
      end if
   end subroutine set_column

   !> Whether the value of a driver's row is an angle.
   pure logical function is_angle_row(suspension, row)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: row
      is_angle_row = suspension%terms(suspension%rows(row)%first)%measure%kind == rotation
   end function is_angle_row

   !> Adds errors to the sheet: heads unknown in a model, and too many columns.
   subroutine judge_columns(sheet, suspension, known)
      type(sheet_t), intent(inout) :: sheet
      type(suspension_t), intent(in) :: suspension
      type(heads_t), intent(in) :: known
      integer, parameter :: most_told = 10      ! a table for another purpose has many
      integer :: k, unknown

      if (count(sheet%heads /= '') > most_driven) call sheet%head_mistakes%add(head_place(sheet)//'expected at most '// &
         str(most_driven)//' columns, found '//str(count(sheet%heads /= '')))
      unknown = 0
      do k = 1, size(sheet%heads)
         associate (head => sheet%heads(k))
            if (head == '' .or. any(head == passed_over) .or. any(head == known%names)) cycle
            if (driver_of(trim(head), suspension) > 0) cycle
            unknown = unknown + 1
            if (unknown <= most_told) call sheet%head_mistakes%add(head_place(sheet)//'unknown column '//quoted(head)// &
               advice(trim(head), known))
         end associate
      end do
      if (unknown > most_told) call sheet%head_mistakes%add(head_place(sheet)//'and '// &
         plural(unknown - most_told, 'more unknown column', 'more unknown columns'))
   end subroutine judge_columns

   !> The row of the driver joint of a column <driver>_mm or <driver>_deg; 0 if there is none, or it has another unit.
   pure integer function driver_of(name, suspension) result(row)
      character(*), intent(in) :: name
      type(suspension_t), intent(in) :: suspension
      integer :: mark

      row = 0
      mark = index(name, '_', back=.true.)
      if (mark > 1) row = driver_row(suspension, name(:mark - 1))
      if (row == 0) return
      if (name(mark:) /= trim(merge('_deg', '_mm ', is_angle_row(suspension, row)))) row = 0
   end function driver_of

   !> Hint on the known columns.
   function advice(name, known) result(words)
      character(*), intent(in) :: name
      type(heads_t), intent(in) :: known
      character(:), allocatable :: words

      words = nearest_name(name, known%names)
      if (words /= '') then
         words = ' (did you mean '//quoted(words)//'?)'
      else if (index(name, ' ') > 0) then
         words = ' (separate the columns by commas)'
      else if (known%used > 0) then
         words = ' (known: '//trim(known%names(1))//' … '//trim(known%names(known%used))//', <driver>_mm, <driver>_deg)'
      end if
   end function advice

end module ek_load_table
