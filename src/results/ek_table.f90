!> A table of results: named columns, one row per state, and header lines on its origin.
module ek_table
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_quantity, only: name_length
   implicit none(type, external)
   private
   public :: table_t, new_table, column_index, column, column_range, row_count, name_length

   type :: table_t
      character(name_length), allocatable :: columns(:)   !! names with unit suffix, e.g. toe_deg
      real(wp), allocatable :: values(:, :)               !! (column, row): a row is contiguous
      logical, allocatable :: is_whole(:)                 !! column of whole numbers: state, iterations
      type(message_list_t) :: header                      !! written above the table, each with '# '
   end type table_t

   character(*), parameter :: whole_names(5) = [character(13) :: 'state', 'converged', 'stable', 'near_singular', 'iterations']

contains

   !> A table of `rows` rows with all values "not a number".
   pure type(table_t) function new_table(columns, rows) result(table)
      character(*), intent(in) :: columns(:)    !! without comma, quote or line end
      integer, intent(in) :: rows
      integer :: k

      allocate (table%columns(size(columns)), table%is_whole(size(columns)))
      allocate (table%values(size(columns), rows))
      table%values = ieee_value(1.0_wp, ieee_quiet_nan)
      do k = 1, size(columns)
         table%columns(k) = columns(k)
         table%is_whole(k) = any(whole_names == columns(k))
      end do
   end function new_table

   !> Index of a column, 0 if there is none of this name. Names are case-sensitive.
   pure integer function column_index(table, name) result(place)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: name

      do place = size(table%columns), 1, -1
         if (table%columns(place) == name) return
      end do
   end function column_index

   !> The values of a column from the first row to the last; empty if there is no such column.
   pure function column(table, name) result(values)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: name
      real(wp), allocatable :: values(:)
      integer :: place

      place = column_index(table, name)
      if (place > 0) then
         values = table%values(place, :)
      else
         allocate (values(0))
      end if
   end function column

   !> Minimum and maximum finite value of a column; both nan if it has none or does not exist.
   pure function column_range(table, name) result(range)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: name
      real(wp) :: range(2)
      integer :: place

      range = ieee_value(1.0_wp, ieee_quiet_nan)
      place = column_index(table, name)
      if (place == 0) return
      associate (values => table%values(place, :))
         if (any(ieee_is_finite(values))) &
            range = [minval(values, mask=ieee_is_finite(values)), maxval(values, mask=ieee_is_finite(values))]
      end associate
   end function column_range

   !> Number of rows of the table.
   pure integer function row_count(table)
      type(table_t), intent(in) :: table
      row_count = size(table%values, 2)
   end function row_count

end module ek_table
