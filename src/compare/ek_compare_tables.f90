!> The tables of a comparison for programs: differences.csv of the gradients, number-differences.csv of the key numbers,
!> curve-differences.csv of the charts, deck-differences.csv of the decks. No table of a report has one of these names.
!> `change` is in percent of A; where A is smaller than the least span of a chart, in percent of that span. `verdict` is
!> changed, same, not a number, in neither, or only in a result: only in A, only in B and so on.
module ek_compare_tables
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_decimal, only: decimal
   use ek_file, only: write_whole, join_path
   use ek_text_table, only: text_table_t, new_text_table, add_row, text_table_csv
   use ek_change, only: change_of, verdict_of, letter_of
   use ek_comparison, only: comparison_t, difference_t, difference, percent
   use ek_deck_difference, only: deck_difference_t, step_text
   implicit none(type, external)
   private
   public :: write_tables, gradient_table

   character(*), parameter :: gradient_table = 'differences.csv'
   character(*), parameter :: value_columns(8) = [character(10) :: 'a_file', 'b_file', 'a', 'b', 'difference', 'percent', &
      'change', 'verdict']

contains

   !> Writes all tables into the folder of a comparison.
   subroutine write_tables(this, error)
      type(comparison_t), intent(in) :: this
      type(error_t), allocatable, intent(out) :: error

      call write_whole(join_path(this%folder, gradient_table), differences_csv(this, this%rows, .false.), error)
      if (.not. allocated(error)) call write_whole(join_path(this%folder, 'number-differences.csv'), &
         differences_csv(this, this%numbers, .true.), error)
      if (.not. allocated(error)) call write_whole(join_path(this%folder, 'curve-differences.csv'), curves_csv(this), error)
      if (.not. allocated(error)) call write_whole(join_path(this%folder, 'deck-differences.csv'), deck_csv(this), error)
   end subroutine write_tables

   !> The table of gradients, or of key numbers if is_by_name, as CSV: one row per gradient or key number, and per result
   !> compared with the first.
   function differences_csv(this, rows, is_by_name) result(text)
      type(comparison_t), intent(in) :: this
      type(difference_t), intent(in) :: rows(:)
      logical, intent(in) :: is_by_name            !! the rows are key numbers
      character(:), allocatable :: text
      type(text_table_t) :: table
      real(wp) :: change
      integer :: k, r, first

      if (is_by_name) then
         table = new_text_table([character(10) :: 'name', 'group', 'quantity', 'side', 'unit', 'condition', value_columns])
      else
         table = new_text_table([character(10) :: 'test', 'quantity', 'side', 'unit', 'window', value_columns])
      end if
      first = merge(6, 5, is_by_name)
      do k = 1, size(rows)
         do r = 2, size(this%results)
            call add_row(table)
            associate (row => rows(k))
               if (is_by_name) call put(table, 1, row%column)
               call put(table, first - 4, row%test)
               call put(table, first - 3, row%quantity)
               call put(table, first - 2, row%side)
               call put(table, first - 1, row%unit)
               call put(table, first, row%window)
               call put(table, first + 1, this%results(1)%path)
               call put(table, first + 2, this%results(r)%path)
               call put(table, first + 3, decimal(row%values(1)))
               call put(table, first + 4, decimal(row%values(r)))
               call put(table, first + 5, decimal(difference(row%values(1), row%values(r))))
               call put(table, first + 6, decimal(percent(row%values(1), row%values(r), row%unit)))
               change = change_of(row%values(1), row%values(r), row%least, row%unit)
               call put(table, first + 7, decimal(100*change))
               call put(table, first + 8, trim(verdict_of(change, this%threshold, row%is_there(1), row%is_there(r), r)))
            end associate
         end do
      end do
      text = text_table_csv(table)
   end function differences_csv

   !> The table of curves as CSV, one row per curve and per result compared with the first. A row gives the largest
   !> difference, in the unit of the label, and the value of the test's abscissa at this difference.
   function curves_csv(this) result(text)
      type(comparison_t), intent(in) :: this
      character(:), allocatable :: text
      type(text_table_t) :: table
      integer :: k

      table = new_text_table([character(18) :: 'test', 'quantity', 'title', 'curve', 'label', 'a_file', 'b_file', &
         'largest_difference', 'at', 'change', 'verdict'])
      do k = 1, size(this%curves)
         call add_row(table)
         associate (curve => this%curves(k))
            call put(table, 1, curve%test)
            call put(table, 2, curve%chart)
            call put(table, 3, curve%title)
            call put(table, 4, curve%curve)
            call put(table, 5, curve%label)
            call put(table, 6, this%results(1)%path)
            call put(table, 7, this%results(curve%result)%path)
            call put(table, 8, decimal(curve%largest))
            call put(table, 9, decimal(curve%at))
            call put(table, 10, decimal(100*curve%change))
            call put(table, 11, trim(curve%verdict))
         end associate
      end do
      text = text_table_csv(table)
   end function curves_csv

   !> The table of decks as CSV, one row per value or fact that differs: the strings of all results; for two results, also the
   !> difference of a number from A to B.
   function deck_csv(this) result(text)
      type(comparison_t), intent(in) :: this
      character(:), allocatable :: text
      character(10) :: heads(size(this%results))
      type(text_table_t) :: table
      integer :: r

      do r = 1, size(heads)
         heads(r) = achar(iachar(letter_of(r)) + 32)        ! a, b, …
      end do
      table = new_text_table([character(10) :: 'kind', 'path', 'sides', heads, 'difference'])
      call add_rows('fact', this%facts)
      call add_rows('value', this%deck)
      text = text_table_csv(table)

   contains

      subroutine add_rows(kind, list)
         character(*), intent(in) :: kind
         type(deck_difference_t), intent(in) :: list(:)
         integer :: k, j

         do k = 1, size(list)
            call add_row(table)
            call put(table, 1, kind)
            call put(table, 2, list(k)%path)
            call put(table, 3, list(k)%sides)
            do j = 1, size(heads)
               call put(table, 3 + j, list(k)%texts%line(j))
            end do
            if (size(heads) == 2) call put(table, 6, step_text(list(k)%texts%line(1), list(k)%texts%line(2)))
         end do
      end subroutine add_rows

   end function deck_csv

   !> Writes a cell of the last row.
   subroutine put(table, column, text)
      type(text_table_t), intent(inout) :: table
      integer, intent(in) :: column
      character(*), intent(in) :: text
      table%cells(column, table%rows)%text = text
   end subroutine put

end module ek_compare_tables
