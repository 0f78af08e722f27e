!> The tables of a comparison for programs: differences.csv of the gradients, number-differences.csv of the key numbers,
!> curve-differences.csv of the charts, deck-differences.csv of the decks. No table of a report has one of these names.
!> `change` is in percent of A; where A is smaller than the least span of a chart, in percent of that span. `verdict` is
!> changed, same, not a number, in neither, or only in a result: only in A, only in B and so on.
module ek_compare_tables
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_file, only: write_whole, join_path
   use ek_frame, only: frame_t, new_frame
   use ek_change, only: change_of, verdict_of, letter_of
   use ek_comparison, only: comparison_t, difference_t, difference, percent
   use ek_deck_difference, only: deck_difference_t, step_text
   implicit none(type, external)
   private
   public :: write_tables, gradient_table

   character(*), parameter :: gradient_table = 'differences.csv'
   character(*), parameter :: value_names = 'a_file,b_file,a,b,difference,percent,change,verdict'

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
      type(frame_t) :: frame
      real(wp) :: change
      integer :: k, r

      frame = new_frame('test,quantity,side,unit,window,'//value_names)
      if (is_by_name) frame = new_frame('name,group,quantity,side,unit,condition,'//value_names)
      do k = 1, size(rows)
         do r = 2, size(this%results)
            associate (row => rows(k))
               if (is_by_name) call frame%put(row%column)
               call frame%put(row%test)
               call frame%put(row%quantity)
               call frame%put(row%side)
               call frame%put(row%unit)
               call frame%put(row%window)
               call frame%put(this%results(1)%path)
               call frame%put(this%results(r)%path)
               call frame%put(row%values(1))
               call frame%put(row%values(r))
               call frame%put(difference(row%values(1), row%values(r)))
               call frame%put(percent(row%values(1), row%values(r), row%unit))
               change = change_of(row%values(1), row%values(r), row%least, row%unit)
               call frame%put(100*change)
               call frame%put(trim(verdict_of(change, this%threshold, row%is_there(1), row%is_there(r), r)))
            end associate
         end do
      end do
      text = frame%csv()
   end function differences_csv

   !> The table of curves as CSV, one row per curve and per result compared with the first. A row gives the largest
   !> difference, in the unit of the label, and the value of the test's abscissa at this difference. `compared` is states, common
   !> states (the abscissae where both have a state) or between states (A on a curve through its states); empty if nothing is
   !> compared.
   function curves_csv(this) result(text)
      type(comparison_t), intent(in) :: this
      character(:), allocatable :: text
      type(frame_t) :: frame
      integer :: k

      frame = new_frame('test,quantity,title,curve,label,a_file,b_file,largest_difference,at,change,verdict,compared')
      do k = 1, size(this%curves)
         associate (curve => this%curves(k))
            call frame%put(curve%test)
            call frame%put(curve%chart)
            call frame%put(curve%title)
            call frame%put(curve%curve)
            call frame%put(curve%label)
            call frame%put(this%results(1)%path)
            call frame%put(this%results(curve%result)%path)
            call frame%put(curve%largest)
            call frame%put(curve%at)
            call frame%put(100*curve%change)
            call frame%put(trim(curve%verdict))
            call frame%put(trim(curve%compared))
         end associate
      end do
      text = frame%csv()
   end function curves_csv

   !> The table of decks as CSV, one row per value or fact that differs: the strings of all results; for two results, also the
   !> difference of a number from A to B.
   function deck_csv(this) result(text)
      type(comparison_t), intent(in) :: this
      character(:), allocatable :: text
      character(10) :: heads(size(this%results))
      type(frame_t) :: frame
      integer :: r

      do r = 1, size(heads)
         heads(r) = achar(iachar(letter_of(r)) + 32)        ! a, b, …
      end do
      frame = new_frame([character(10) :: 'kind', 'path', 'sides', heads, 'difference'])
      call add_rows('fact', this%facts)
      call add_rows('value', this%deck)
      text = frame%csv()

   contains

      subroutine add_rows(kind, list)
         character(*), intent(in) :: kind
         type(deck_difference_t), intent(in) :: list(:)
         integer :: k, j

         do k = 1, size(list)
            call frame%put(kind)
            call frame%put(list(k)%path)
            call frame%put(list(k)%sides)
            do j = 1, size(heads)
               call frame%put(list(k)%texts%line(j))
            end do
            if (size(heads) == 2) call frame%put(step_text(list(k)%texts%line(1), list(k)%texts%line(2)))
            if (size(heads) /= 2) call frame%put('')
         end do
      end subroutine add_rows

   end function deck_csv

end module ek_compare_tables
