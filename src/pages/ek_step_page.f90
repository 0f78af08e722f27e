!> The page of a step-size study: the error of each method against the number of increments, as a table and on logarithmic axes.
module ek_step_page
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_version, only: version
   use ek_decimal, only: get_decimal
   use ek_text_table, only: text_table_t, cell_of
   use ek_figure_data, only: figures_json
   use ek_figure, only: figure_t, new_figure, add_series, columns_of, as_both
   use ek_page, only: page_t, begin_page, begin_section, add_text, add_warnings, add_facts, put_fact, begin_table, &
      add_cell, add_group, &
      end_table, add_page_figure => add_figure, set_data, page_text, page_number
   implicit none(type, external)
   private
   public :: step_page, step_figure, figure_ending

   character(*), parameter :: figure_ending = '_steps'     !! appended to the name of the study

   !> The number of errors per row of the table, and their columns and labels.
   integer, parameter :: errors = 4
   character(20), parameter :: columns(errors) = [character(20) :: 'constraint_error', 'travel_error_mm', 'toe_error_deg', &
      'camber_error_deg']
   character(32), parameter :: labels(errors) = [character(32) :: '|Φ| of the joints [m, rad]', 'travel error [mm]', &
      'toe error [deg]', 'camber error [deg]']

contains

   !> The content of the page of a step-size study.
   function step_page(title, name, deck, case, table, message) result(text)
      character(*), intent(in) :: title, name, deck, case     !! title, name, deck and case of the study; the title may be ''
      type(text_table_t), intent(in) :: table                 !! table of the study
      character(*), intent(in) :: message                     !! reason for a missing figure; may be ''
      character(:), allocatable :: text
      type(page_t) :: page
      type(message_list_t) :: names, values, trouble

      if (title == '') call begin_page(page, name, name//', a study of '//deck)
      if (title /= '') call begin_page(page, title, name//', a study of '//deck)
      call put_fact(names, values, 'Kind', 'step_size')
      call put_fact(names, values, 'Case', case)
      call put_fact(names, values, 'Program', 'elastokin '//version)
      call add_facts(page, names, values)
      if (message /= '') call trouble%add(message)
      call add_warnings(page, 'Figures', trouble)
      call add_errors(page, table)
      call add_figure(page, name, table)
      text = page_text(page)
   end function step_page

   !> Adds the table of errors, by method.
   subroutine add_errors(page, table)
      type(page_t), intent(inout) :: page
      type(text_table_t), intent(in) :: table
      character(:), allocatable :: method
      integer :: k, e

      call begin_section(page, 'errors', 'Errors at the end of the range', has_text=.true.)
      call add_text(page, 'p', 'Travel, toe and camber: deviation from the equilibrium under the same load. '// &
         'Time: the shortest of five runs on this computer.')
      call begin_table(page, [character(40) :: '>increments', ('>'//labels(e), e=1, errors), '>time [ms]'])
      method = ''
      do k = 1, table%rows
         if (cell_of(table, k, 'method') /= method) then
            method = cell_of(table, k, 'method')
            call add_group(page, method)
         end if
         call add_cell(page, cell_of(table, k, 'increments'))
         do e = 1, errors
            call add_cell(page, short(value_of(table, k, columns(e))))
         end do
         call add_cell(page, page_number(1000.0_wp*value_of(table, k, 'seconds')))
      end do
      call end_table(page)
      if (any([(.not. value_of(table, k, 'reached') > 0.5_wp, k=1, table%rows)])) call add_text(page, 'p', &
         '–: the method did not reach the end of the range with so many increments.')
   end subroutine add_errors

   !> Adds the figure and its data, if an error is drawn.
   subroutine add_figure(page, name, table)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: name
      type(text_table_t), intent(in) :: table
      type(figure_t), allocatable :: figure

      call step_figure(name, table, figure)
      if (.not. allocated(figure)) return
      call begin_section(page, 'figures', 'Figures')
      call add_page_figure(page, figure%name, 'figures/'//figure%name//'.gp draws this figure.')
      call set_data(page, figures_json([figure]), has_figures=.true., has_charts=.false.)
   end subroutine add_figure

   !> Finds the figure: magnitudes of the errors over the number of increments, both on logarithmic axes. An error that is nowhere
   !> drawn has no panel. If there is no panel, the figure is not allocated.
   subroutine step_figure(name, table, figure)
      character(*), intent(in) :: name                        !! name of the study
      type(text_table_t), intent(in) :: table
      type(figure_t), allocatable, intent(out) :: figure
      character(16) :: methods(table%rows)
      character(15) :: why_undrawn
      integer, allocatable :: panels(:), rows(:)
      logical :: has_value(table%rows, errors)     ! (method, error): a value that is drawn
      logical :: has_result(table%rows)
      integer :: used, k, p, m, e

      used = 0
      do k = 1, table%rows
         if (any(methods(:used) == cell_of(table, k, 'method'))) cycle
         used = used + 1
         methods(used) = cell_of(table, k, 'method')
      end do
      has_value = .false.
      has_result = .false.
      do k = 1, table%rows
         m = findloc(methods(:used) == cell_of(table, k, 'method'), .true., dim=1)
         do e = 1, errors
            if (ieee_is_finite(drawn(value_of(table, k, columns(e))))) has_value(m, e) = .true.
            if (ieee_is_finite(value_of(table, k, columns(e)))) has_result(m) = .true.
         end do
      end do
      panels = pack([(e, e=1, errors)], any(has_value, dim=1))
      if (size(panels) == 0) return
      allocate (figure)
      figure = new_figure(name//figure_ending, 'Errors over the number of increments', &
         name//'; magnitudes; errors below 1e-12 are not drawn', size(panels))
      figure%left = 150          ! room for tics such as 0.0001 beside the labels
      do p = 1, size(panels)
         e = panels(p)
         associate (panel => figure%panels(p))
            panel%x%label = 'increments'
            panel%y%label = trim(labels(e))
            panel%x%is_log = .true.
            panel%y%is_log = .true.
            do m = 1, used
               rows = pack([(k, k=1, table%rows)], [(cell_of(table, k, 'method') == methods(m), k=1, table%rows)])
               why_undrawn = ''
               if (.not. any(has_value(m, :))) why_undrawn = merge(' (below 1e-12)', ' (no result)  ', has_result(m))
               call add_series(panel, as_both, -(modulo(m - 1, 8) + 1), columns_of( &
                  [(value_of(table, rows(k), 'increments'), k=1, size(rows))], &
                  [(drawn(value_of(table, rows(k), columns(e))), k=1, size(rows))]), title=trim(methods(m))//trim(why_undrawn))
            end do
         end associate
      end do
   end subroutine step_figure

   !> The magnitude of an error, for a logarithmic axis. NaN below 1e-12, which is only rounding, and for a missing error.
   pure real(wp) function drawn(value)
      real(wp), intent(in) :: value

      drawn = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. ieee_is_finite(value)) return
      if (abs(value) >= 1.0e-12_wp) drawn = abs(value)
   end function drawn

   !> An error with three digits, because it may be as small as rounding; '–' for a missing error.
   function short(value) result(text)
      real(wp), intent(in) :: value
      character(:), allocatable :: text

      text = '–'
      if (ieee_is_finite(value)) text = str(value, 3)
   end function short

   !> A number of the table; NaN if the table does not contain it.
   pure real(wp) function value_of(table, row, column) result(value)
      type(text_table_t), intent(in) :: table
      integer, intent(in) :: row
      character(*), intent(in) :: column
      logical :: is_number

      call get_decimal(cell_of(table, row, trim(column)), value, is_number)
   end function value_of

end module ek_step_page
