!> The curve of a target of a fit, from a table: abscissa, required value and limits.
module ek_fit_curve
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t
   use ek_sheet, only: sheet_t, read_sheet, column_of, mistakes_of, complain
   use ek_sheet_columns, only: take_columns, find_unit_row, or_empty
   use ek_unit_row, only: unit_of_heading
   use ek_study, only: not_given, is_given
   use ek_fit, only: fit_target_t
   implicit none(type, external)
   private
   public :: read_curve

contains

   !> Reads the curve of a target. Each row needs the abscissa. If the table has the column of the required values, each row needs
   !> the required value; otherwise each row needs a limit.
   subroutine read_curve(target, home, swept_unit, rows, mistakes)
      type(fit_target_t), intent(in) :: target
      character(*), intent(in) :: home                     !! folder of the fit, with its slash
      character(*), intent(in) :: swept_unit               !! unit of the swept value of the case
      real(wp), allocatable, intent(out) :: rows(:, :)     !! (abscissa, value, low, high; row); nan if not given
      type(message_list_t), intent(inout) :: mistakes      !! receives all errors of the table
      character(*), parameter :: limit(2) = [character(4) :: 'low', 'high']
      type(sheet_t) :: sheet
      type(error_t), allocatable :: error
      character(16) :: units(2)
      character(:), allocatable :: path
      real(wp), allocatable :: values(:, :), limits(:, :)
      integer, allocatable :: of_limits(:)
      integer :: places(2), of(2), k

      allocate (rows(4, 0))
      path = target%file
      if (index(path, '/') /= 1) path = home//path
      call read_sheet(path, sheet, error)
      if (allocated(error)) then
         call mistakes%add(error%message)
         return
      end if
      places = [column_of(sheet, trim(target%over)), column_of(sheet, trim(target%column))]
      of = [(column_of(sheet, trim(limit(k))), k=1, 2)]
      of_limits = pack(of, of > 0)
      units(1) = unit_of_heading(trim(target%over))
      units(2) = unit_of_heading(trim(target%quantity))
      if (target%over == 'factor') units(1) = swept_unit
      if (sheet%head_mistakes%count() == 0 .and. (places(1) == 0 .or. (places(2) == 0 .and. size(of_limits) == 0))) &
         call sheet%head_mistakes%add(path//' must have the columns '//trim(target%over)//' and '//trim(target%column)// &
         ', or low, or high')
      if (sheet%head_mistakes%count() == 0) then
         call find_unit_row(sheet, [pack(places, places > 0), of_limits])
         call take_columns(sheet, pack(places, places > 0), values, pack(units, places > 0))
         call take_columns(sheet, [places(1), of_limits], limits, [units(1), spread(units(2), 1, size(of_limits))], or_empty)
         if (places(2) == 0) then
            do k = 1, size(limits, 2)
               if (.not. any(is_given(limits(2:, k)))) call complain(sheet, sheet%unit_row + k, &
                  'expected a limit in column low or high, found none')
            end do
         end if
      end if
      call mistakes_of(sheet, mistakes)
      if (mistakes%count() > 0) return
      deallocate (rows)
      allocate (rows(4, size(values, 2)), source=not_given())
      rows(1, :) = values(1, :)
      if (places(2) > 0) rows(2, :) = values(2, :)
      do k = 1, 2
         if (of(k) > 0) rows(2 + k, :) = limits(1 + findloc(of_limits, of(k), dim=1), :)
      end do
   end subroutine read_curve

end module ek_fit_curve
