!> The page of `elastokin solve --page`: conditions and numbers before and after, contributions, the compromise of two conditions,
!> and the hardpoints that moved.
module ek_solve_page
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_clock, only: date_text
   use ek_version, only: version
   use ek_suspension, only: suspension_t
   use ek_workspace, only: workspace_t
   use ek_condition_search, only: unknown_t, search_t
   use ek_condition_solver, only: findings_t
   use ek_compromise, only: compromise_t
   use ek_figure, only: figure_t, new_figure, add_series, as_both, as_points
   use ek_figure_data, only: figures_json
   use ek_gnuplot, only: on_level, on_derivative
   use ek_page, only: page_t, begin_page, begin_section, add_text, add_facts, put_fact, begin_table, add_cell, add_bar, &
      add_group, &
      end_table, add_figure, set_data, page_text
   use ek_moved_section, only: add_moved, append_figure
   use ek_solve_text, only: label_of, add_explanation, has_no_effect
   implicit none(type, external)
   private
   public :: solve_page

contains

   !> The page as HTML. Numbers have the digits with which `solve` prints them.
   function solve_page(deck, before, workspace, unknowns, search, found, compromise, records) result(html)
      character(*), intent(in) :: deck                    !! path of the deck
      type(suspension_t), intent(in) :: before            !! model at the start
      type(workspace_t), intent(in) :: workspace          !! workspace with the numbers found
      type(unknown_t), intent(in) :: unknowns(:)
      type(search_t), intent(in) :: search
      type(findings_t), intent(in) :: found
      type(compromise_t), intent(in) :: compromise
      character(*), intent(in) :: records                 !! the numbers found as records of the deck
      character(:), allocatable :: html
      type(page_t) :: page
      type(figure_t), allocatable :: figures(:)

      call begin_page(page, 'Solve: '//before%name, 'Parameters of the deck for which quantities have wanted values')
      call add_head(page, deck, before%name, found)
      call add_conditions(page, workspace, search, found)
      call add_unknowns(page, unknowns, found)
      call add_reasons(page, unknowns, search, found)
      call add_moved(page, before, workspace%raw, figures)
      call add_contributions(page, workspace, unknowns, search, found)
      if (size(compromise%x, 2) > 0) call add_compromise(page, workspace, unknowns, search, compromise, figures)
      call begin_section(page, 'records', 'As records of the deck', has_text=.true.)
      call add_text(page, 'pre', records)
      if (allocated(figures)) call set_data(page, figures_json(figures), has_figures=.true., has_charts=.false.)
      html = page_text(page)
   end function solve_page

   subroutine add_head(page, deck, model, found)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: deck, model
      type(findings_t), intent(in) :: found
      type(message_list_t) :: names, values

      call put_fact(names, values, 'Deck', deck)
      call put_fact(names, values, 'Model', model)
      call put_fact(names, values, 'Conditions', str(count(found%is_reached))//' of '//str(size(found%is_reached))//' reached')
      call put_fact(names, values, 'Sum of squares', str(found%sum_before, 6)//' → '//str(found%sum_after, 6))
      call put_fact(names, values, 'Designs solved', str(found%sweeps))
      call put_fact(names, values, 'Program', 'elastokin '//version)
      call put_fact(names, values, 'Date', date_text())
      call add_facts(page, names, values)
   end subroutine add_head

   !> Adds the table of conditions: target, values before and after, weight.
   subroutine add_conditions(page, workspace, search, found)
      type(page_t), intent(inout) :: page
      type(workspace_t), intent(in) :: workspace
      type(search_t), intent(in) :: search
      type(findings_t), intent(in) :: found
      integer :: i

      call begin_section(page, 'conditions', 'Conditions', has_text=.true.)
      call begin_table(page, [character(16) :: 'Quantity', '>wanted', '>before', '>after', 'Unit', '>weight', 'Result'])
      do i = 1, size(found%after)
         associate (wanted => search%values%wanted(i))
            call add_cell(page, label_of(workspace, wanted))
            call add_values(page, [search%targets(i), found%before(i), found%after(i)])
            call add_cell(page, wanted%unit)
            call add_values(page, [search%weights(i)])
            if (found%is_reached(i)) call add_cell(page, 'reached')
            if (.not. found%is_reached(i)) call add_cell(page, '', verdict='not reached')
         end associate
      end do
      call end_table(page)
      call add_text(page, 'p', 'Weight: the deviation that counts as 1 in the sum of squares, if not all conditions can be met.')
   end subroutine add_conditions

   !> Adds the table of the numbers that vary.
   subroutine add_unknowns(page, unknowns, found)
      type(page_t), intent(inout) :: page
      type(unknown_t), intent(in) :: unknowns(:)
      type(findings_t), intent(in) :: found
      integer :: j

      call begin_section(page, 'numbers', 'Parameters of the deck', has_text=.true.)
      call begin_table(page, [character(16) :: 'Number', '>before', '>after', '>change', '>lower bound', '>upper bound', 'Unit', &
         '~Note'])
      do j = 1, size(unknowns)
         associate (number => unknowns(j)%direction)
            call add_cell(page, number%path)
            call add_values(page, [number%value, found%x(j), found%x(j) - number%value, unknowns(j)%lower, unknowns(j)%upper])
            call add_cell(page, number%unit)
            call add_cell(page, note_of(j))
         end associate
      end do
      call end_table(page)
      if (found%begins_at_bound) call add_text(page, 'p', &
         'A parameter of the deck is outside its bounds; the search began at the bound.')

   contains

      function note_of(j) result(note)
         integer, intent(in) :: j
         character(:), allocatable :: note

         note = ''
         if (found%held(j) < 0) note = 'at its lower bound'
         if (found%held(j) > 0) note = 'at its upper bound'
         if (has_no_effect(found, j)) note = 'no effect on the conditions'
      end function note_of

   end subroutine add_unknowns

   !> Adds what solve prints on other solutions, or on conditions that are not met.
   subroutine add_reasons(page, unknowns, search, found)
      type(page_t), intent(inout) :: page
      type(unknown_t), intent(in) :: unknowns(:)
      type(search_t), intent(in) :: search
      type(findings_t), intent(in) :: found
      type(buffer_t) :: text

      call add_explanation(unknowns, search, found, text)
      if (text%length() > 0) call add_text(page, 'pre', text%text())
   end subroutine add_reasons

   !> Adds the contribution of each number to the change of each quantity, by its derivative at the numbers found; the rest of the
   !> change is nonlinear.
   subroutine add_contributions(page, workspace, unknowns, search, found)
      type(page_t), intent(inout) :: page
      type(workspace_t), intent(in) :: workspace
      type(unknown_t), intent(in) :: unknowns(:)
      type(search_t), intent(in) :: search
      type(findings_t), intent(in) :: found
      real(wp) :: parts(size(unknowns)), slopes(size(unknowns)), change
      integer :: i, j

      call begin_section(page, 'contributions', 'Contributions')
      call add_text(page, 'p', 'Contribution: derivative at the numbers found, multiplied by the change of the number. The '// &
         'rest of the change of a quantity is nonlinear.')
      call begin_table(page, [character(24) :: 'Number', '>derivative per unit', '>change of the number', '>contribution', 'Unit', &
         'Contribution'])
      do i = 1, size(found%after)
         associate (wanted => search%values%wanted(i))
            change = found%after(i) - found%before(i)
            slopes = found%effect(i, :)/search%width
            parts = slopes*(found%x - search%start)
            call add_group(page, label_of(workspace, wanted)//': change '//str(change, 9)//' '//wanted%unit)
            do j = 1, size(unknowns)
               call add_cell(page, unknowns(j)%direction%path)
               call add_values(page, [slopes(j), found%x(j) - search%start(j), parts(j)])
               call add_row_end(parts(j))
            end do
            call add_cell(page, 'nonlinear rest')
            call add_cell(page, '')
            call add_cell(page, '')
            call add_values(page, [change - sum(parts)])
            call add_row_end(change - sum(parts))
         end associate
      end do
      call end_table(page)

   contains

      subroutine add_row_end(part)
         real(wp), intent(in) :: part
         real(wp) :: longest

         longest = max(maxval(abs(parts)), abs(change - sum(parts)), tiny(1.0_wp))
         call add_cell(page, search%values%wanted(i)%unit)
         call add_bar(page, part/longest)
      end subroutine add_row_end

   end subroutine add_contributions

   !> Adds the compromise of two conditions that exclude each other: a figure, and the table of designs.
   subroutine add_compromise(page, workspace, unknowns, search, compromise, figures)
      type(page_t), intent(inout) :: page
      type(workspace_t), intent(in) :: workspace
      type(unknown_t), intent(in) :: unknowns(:)
      type(search_t), intent(in) :: search
      type(compromise_t), intent(in) :: compromise
      type(figure_t), allocatable, intent(inout) :: figures(:)
      type(figure_t) :: figure
      character(80) :: heads(size(unknowns) + 6)
      integer :: j, k

      call begin_section(page, 'compromise', 'Compromise')
      call add_text(page, 'p', 'In each design, neither condition can be satisfied better without the other one.')
      figure = new_figure('compromise', 'Compromise of two conditions', 'designs of which none is better in both conditions', 1)
      associate (panel => figure%panels(1), wanted => search%values%wanted)
         panel%x%label = label_of(workspace, wanted(1))//' ['//wanted(1)%unit//']'
         panel%y%label = label_of(workspace, wanted(2))//' ['//wanted(2)%unit//']'
         call add_series(panel, as_both, on_level, compromise%values(:2, :), title='designs')
         call add_series(panel, as_points, on_derivative, reshape(search%targets(:2), [2, 1]), title='wanted')
      end associate
      call append_figure(figures, figure)
      call add_figure(page, figure%name, 'The first and the last design satisfy one condition best.')
      heads(1) = '>design'
      do j = 1, size(unknowns)
         heads(j + 1) = '>'//unknowns(j)%direction%path
      end do
      heads(size(unknowns) + 2:) = [character(80) :: '>value 1', '>value 2', '>deviation 1', '>deviation 2', '>sum of squares']
      call begin_table(page, heads)
      do k = 1, size(compromise%x, 2)
         call add_cell(page, str(k))
         call add_values(page, [compromise%x(:, k), compromise%values(:2, k), compromise%deviations(:2, k), &
            sum(compromise%deviations(:, k)**2)])
      end do
      call end_table(page)
   end subroutine add_compromise

   !> Adds cells with nine digits, as `solve` prints numbers.
   subroutine add_values(page, values)
      type(page_t), intent(inout) :: page
      real(wp), intent(in) :: values(:)
      integer :: k

      do k = 1, size(values)
         call add_cell(page, str(values(k), 9))
      end do
   end subroutine add_values

end module ek_solve_page
