!> A requested number of the results: a column of a case at a swept value, an entry of its compliance matrix, or a key number of the
!> report. This module defines the requested number, finds the cases that it needs, and reads its value from their tables.
module ek_wanted_number
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_usage
   use ek_text, only: lower, quoted, suggestion
   use ek_quantity, only: unit_of, unit_text
   use ek_table, only: table_t, name_length, column_index
   use ek_case, only: case_t
   use ek_test_result, only: test_result_t
   use ek_table_reading, only: value_at_place, value_where
   use ek_key_number, only: key_number_t, nothing, read_source
   use ek_number_names, only: list_all, find_number, side_of_only_wheel, stems_of
   use ek_number_reach, only: reach_of, reach_of_place
   use ek_compliance_table, only: compliance_columns
   use ek_workspace, only: workspace_t
   use ek_workspace_cases, only: heads_of_case, report_cases
   implicit none(type, external)
   private
   public :: wanted_number_t, find_column, find_key_number, find_wanted, read_number

   !> A requested number of the results, with its sources.
   type :: wanted_number_t
      character(:), allocatable :: name          !! name, as the user gave it
      character(:), allocatable :: unit          !! unit, for instance 'deg'; '' if there is no unit
      character(name_length) :: heading = ''     !! a column heading with this unit, for the noise of the number (ek_noise)
      logical :: is_change = .false.             !! the number is the change of the column against its value at design
      integer :: case = 0 !! index of its case in the workspace; key number: case of the first source with a value
      character(name_length) :: column = ''      !! name of the column; '': a key number
      character(name_length) :: over = 'factor'  !! column to which `at` refers
      real(wp) :: at = 0.0_wp                    !! value of column `over` at which the column is read, in the unit of `over`
      type(key_number_t), allocatable :: key     !! the key number, with its sources
      integer :: wheel = 1                       !! key number: 1 left or single wheel, or axle; 2 right
      integer :: source = 0 !! key number: index of the source that has the value; 0: not yet known, or all sources
      integer, allocatable :: cases(:)           !! index in the workspace of the case of each source
      real(wp), allocatable :: reach(:)          !! swept value [SI] of each source beyond which no state is needed
   end type wanted_number_t

   character(*), parameter :: no_quantities(7) = [character(16) :: 'state', 'factor', 'converged', 'stable', 'near_singular', &
      'iterations', 'constraint_error']

contains

   !> Finds a requested number by its name: first among the columns, then among the entries of the compliance matrix, then among the
   !> key numbers.
   subroutine find_wanted(workspace, k, name, at, wanted, error)
      type(workspace_t), intent(in) :: workspace
      integer, intent(in) :: k                             !! index of the case of a column
      character(*), intent(in) :: name
      real(wp), intent(in) :: at                           !! swept value, in the unit of the case
      type(wanted_number_t), intent(out) :: wanted
      type(error_t), allocatable, intent(out) :: error     !! exit_usage, with suggestions
      character(name_length), allocatable :: heads(:), known(:)
      character(:), allocatable :: hint

      call find_column(workspace, k, name, 'factor', at, wanted, heads)
      if (wanted%case > 0) return
      call find_key_number(workspace, name, wanted, known)
      if (allocated(wanted%key)) return
      hint = suggestion(name, [character(name_length) :: heads, known])
      if (any(no_quantities == name)) hint = '; it describes the solution and is no quantity of the suspension'
      call fail(error, exit_usage, quoted(name)//' is no column of case '//quoted(workspace%cases(k)%case%name)// &
         ', no entry of its compliance matrix and no K&C metric'//hint)
   end subroutine find_wanted

   !> Finds a column of a case, to be read at a value of another column. `wanted%case` is 0 if the case does not have both columns,
   !> or if the column describes only the solution.
   subroutine find_column(workspace, k, name, over, at, wanted, heads)
      type(workspace_t), intent(in) :: workspace
      integer, intent(in) :: k                             !! index of the case
      character(*), intent(in) :: name, over
      real(wp), intent(in) :: at                           !! value of the column `over`, in its unit
      type(wanted_number_t), intent(out) :: wanted
      character(name_length), allocatable, intent(out) :: heads(:)     !! all columns, and entries of the compliance matrix, for
                                                                       !! suggestions
      character(name_length), allocatable :: entries(:)

      call heads_of_case(k, workspace, heads)
      call compliance_columns(workspace%raw, entries)
      heads = [character(name_length) :: heads, entries]
      wanted%name = name
      wanted%unit = unit_text(unit_of(name))
      if (wanted%unit == '–') wanted%unit = ''
      wanted%heading = name
      if (.not. any(heads == name) .or. any(no_quantities == name) .or. .not. any(heads == over)) return
      wanted%case = k
      wanted%column = name
      wanted%over = over
      wanted%at = at
      wanted%cases = [k]
      wanted%reach = [huge(1.0_wp)]
      if (over == 'factor') wanted%reach = reach_of_place(workspace%raw, workspace%cases(k)%case, at)
   end subroutine find_column

   !> Finds a key number; wanted%key is not allocated if the report has no key number of this name.
   subroutine find_key_number(workspace, name, wanted, known)
      type(workspace_t), intent(in) :: workspace
      character(*), intent(in) :: name
      type(wanted_number_t), intent(out) :: wanted
      character(name_length), allocatable, intent(out) :: known(:)     !! names of all key numbers, for suggestions; empty if the
                                                                       !! key number is found
      type(case_t), allocatable :: cases(:)
      type(test_result_t), allocatable :: tests(:)
      type(key_number_t), allocatable :: listed(:)
      character(name_length), allocatable :: heads(:, :)
      integer :: number, k

      allocate (known(0))
      call report_cases(workspace, cases)
      call list_all(workspace%raw, cases, tests, listed, heads, stems_of([name]))
      call find_number(name, heads, number, wanted%wheel, side_of_only_wheel(workspace%raw))
      if (number == 0) then
         call list_all(workspace%raw, cases, tests, listed, heads)
         known = pack(heads, heads /= '')
         return
      end if
      wanted%name = name
      wanted%key = listed(number)
      wanted%unit = listed(number)%unit
      wanted%heading = heading_with(wanted%unit)
      associate (sources => wanted%key%sources)
         allocate (wanted%cases(size(sources)), wanted%reach(size(sources)))
         do k = 1, size(sources)
            wanted%cases(k) = workspace%report_order(sources(k)%test)
            wanted%reach(k) = reach_of(wanted%key%how, workspace%raw, cases(sources(k)%test), sources(k))
         end do
      end associate
   end subroutine find_key_number

   !> Reads the value of a requested number from the table of one of its cases. The value of a column is NaN if the table gives no
   !> value; the value of a key number is then unchanged.
   subroutine read_number(wanted, source, table, value)
      type(wanted_number_t), intent(in) :: wanted
      integer, intent(in) :: source                        !! key number: index of the source to be read
      type(table_t), intent(in) :: table                   !! table of the case
      real(wp), intent(inout) :: value !! on entry, the value from the preceding sources; NaN before the first source
      real(wp) :: both(2)
      logical :: is_final
      integer :: column

      if (allocated(wanted%key)) then
         both = value
         call read_source(wanted%key%how, wanted%key%sources(source), table, both, is_final)
         value = both(wanted%wheel)
      else
         column = column_index(table, trim(wanted%column))
         value = nothing()
         if (column == 0) return
         if (wanted%over == 'factor') then
            value = value_at_place(table, column, wanted%at)
         else
            value = value_where(table, column_index(table, trim(wanted%over)), wanted%at, column)
         end if
         if (wanted%is_change) value = value - value_at_place(table, column, 0.0_wp)
      end if
   end subroutine read_number

   !> A column heading that ends in a unit given as a label: 'x_nm_per_deg' for 'N m/deg'.
   pure function heading_with(unit) result(heading)
      character(*), intent(in) :: unit
      character(:), allocatable :: heading
      integer :: k

      heading = 'x_'
      do k = 1, len(unit)
         select case (unit(k:k))
         case ('/')
            heading = heading//'_per_'
         case ('%')
            heading = heading//'percent'
         case (' ')
            continue
         case default
            heading = heading//lower(unit(k:k))
         end select
      end do
   end function heading_with

end module ek_wanted_number
