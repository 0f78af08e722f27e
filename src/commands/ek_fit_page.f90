!> The page of `elastokin fit --page`: targets and factors before and after, curves, 95 % intervals, contributions, and the
!> hardpoints that moved.
module ek_fit_page
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_clock, only: date_text
   use ek_version, only: version
   use ek_suspension, only: suspension_t
   use ek_workspace, only: workspace_t
   use ek_fit, only: fit_t
   use ek_fit_problem, only: fit_problem_t
   use ek_fit_solver, only: fit_result_t
   use ek_fit_statistics, only: fit_statistics_t
   use ek_fit_files, only: note_of, fit_figure, target_rms_t, rms_of_target
   use ek_figure, only: figure_t
   use ek_figure_data, only: figures_json
   use ek_page, only: page_t, begin_page, begin_section, add_text, add_facts, put_fact, begin_table, add_cell, add_bar, &
      add_group, &
      end_table, add_figure, set_data, page_text
   use ek_moved_section, only: add_moved, append_figure
   implicit none(type, external)
   private
   public :: fit_page

contains

   !> The page as HTML. Numbers have the digits with which `fit` prints them.
   function fit_page(fit, before, workspace, problem, found, statistics, printed) result(html)
      type(fit_t), intent(in) :: fit
      type(suspension_t), intent(in) :: before            !! model at the start
      type(workspace_t), intent(in) :: workspace          !! workspace with the numbers found
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(fit_statistics_t), intent(in) :: statistics
      character(*), intent(in) :: printed                 !! the findings as printed
      character(:), allocatable :: html
      type(page_t) :: page
      type(figure_t), allocatable :: figures(:)
      character(:), allocatable :: title

      title = 'Fit: '//fit%name
      if (fit%title /= '') title = fit%title
      call begin_page(page, title, 'Factors of a deck that fit curves, values and limits best')
      call add_head(page, fit, before%name, found)
      call add_targets(page, fit, problem, found)
      call add_factors(page, problem, found, statistics)
      call begin_section(page, 'curves', 'Curves')
      call append_figure(figures, fit_figure(fit, workspace, problem, found))
      call add_figure(page, fit%name, fit%name//'_points.csv contains the points.')
      call add_moved(page, before, workspace%raw, figures)
      call add_contributions(page, fit, problem, found)
      call begin_section(page, 'printed', 'Findings as printed', has_text=.true.)
      call add_text(page, 'pre', printed)
      call set_data(page, figures_json(figures), has_figures=.true., has_charts=.false.)
      html = page_text(page)
   end function fit_page

   subroutine add_head(page, fit, model, found)
      type(page_t), intent(inout) :: page
      type(fit_t), intent(in) :: fit
      character(*), intent(in) :: model
      type(fit_result_t), intent(in) :: found
      type(message_list_t) :: names, values

      call put_fact(names, values, 'Fit', fit%name)
      call put_fact(names, values, 'Deck', fit%deck)
      call put_fact(names, values, 'Model', model)
      call put_fact(names, values, 'Sum of squares', str(found%sum_before, 6)//' → '//str(found%sum_after, 6))
      call put_fact(names, values, 'Iterations', str(found%steps))
      call put_fact(names, values, 'Program', 'elastokin '//version)
      call put_fact(names, values, 'Date', date_text())
      call add_facts(page, names, values)
   end subroutine add_head

   !> Adds the targets with the root mean squares of their differences.
   subroutine add_targets(page, fit, problem, found)
      type(page_t), intent(inout) :: page
      type(fit_t), intent(in) :: fit
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(target_rms_t) :: rms
      integer :: t

      call begin_section(page, 'targets', 'Targets', has_text=.true.)
      call begin_table(page, [character(24) :: 'Target', '>points', '>rms at start', '>rms of result', 'Unit', '>beyond a limit'])
      do t = 1, size(fit%targets)
         rms = rms_of_target(problem, found, t)
         call add_cell(page, fit%targets(t)%name)
         call add_cell(page, str(rms%points))
         if (rms%points == 0) then
            call add_cell(page, '–')
            call add_cell(page, '–')
            call add_cell(page, 'weight 0')
         else
            call add_cell(page, str(rms%before, 5))
            call add_cell(page, str(rms%after, 5))
            call add_cell(page, problem%wanted(rms%first)%unit)
         end if
         call add_cell(page, str(rms%beyond))
      end do
      call end_table(page)
      call add_text(page, 'p', 'rms: root mean square of the differences of the points of a target.')
   end subroutine add_targets

   !> Adds start, result, bounds and 95 % interval of every factor.
   subroutine add_factors(page, problem, found, statistics)
      type(page_t), intent(inout) :: page
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(fit_statistics_t), intent(in) :: statistics
      integer :: f

      call begin_section(page, 'factors', 'Factors', has_text=.true.)
      call begin_table(page, [character(24) :: 'Factor', '>start', '>result', '>± 95 %', '>95 % from', '>95 % to', &
         '>lower bound', '>upper bound', 'Unit', 'Learned', '~Note'])
      do f = 1, size(problem%variables)
         associate (this => problem%variables(f))
            call add_cell(page, this%name)
            call add_cell(page, str(this%start, 7))
            call add_cell(page, str(found%x(f), 9))
            call add_cell(page, known(statistics%half(f), 4))
            call add_cell(page, known(statistics%low(f), 6))
            call add_cell(page, known(statistics%high(f), 6))
            call add_cell(page, bound(this%lower))
            call add_cell(page, bound(this%upper))
            call add_cell(page, this%direction%unit)
            if (statistics%is_learned(f)) call add_cell(page, 'yes')
            if (.not. statistics%is_learned(f)) call add_cell(page, '', verdict='not from these targets')
            call add_cell(page, note_of(problem, found, statistics, f))
         end associate
      end do
      call end_table(page)

   contains

      !> A number of an interval; a dash if the interval is not known.
      function known(value, digits) result(text)
         real(wp), intent(in) :: value
         integer, intent(in) :: digits
         character(:), allocatable :: text
         text = '–'
         if (ieee_is_finite(value)) text = str(value, digits)
      end function known

      !> A bound; a dash without one.
      function bound(value) result(text)
         real(wp), intent(in) :: value
         character(:), allocatable :: text
         text = '–'
         if (abs(value) < huge(1.0_wp)) text = str(value, 9)
      end function bound

   end subroutine add_factors

   !> Adds the contribution of each factor to the change of each target: the root mean square over the points of derivative times
   !> change.
   subroutine add_contributions(page, fit, problem, found)
      type(page_t), intent(inout) :: page
      type(fit_t), intent(in) :: fit
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      real(wp) :: parts(size(problem%variables))
      integer, allocatable :: points(:)
      integer :: t, f, k

      call begin_section(page, 'contributions', 'Contributions')
      call add_text(page, 'p', 'Contribution of a factor to a target: derivative at the result, multiplied by the change of '// &
         'the factor; root mean square over the points. Contributions with opposite signs may cancel.')
      call begin_table(page, [character(24) :: 'Factor', '>change', 'Unit', '>contribution', 'Unit', 'Contribution'])
      do t = 1, size(fit%targets)
         points = pack([(k, k=1, size(problem%points))], problem%points%target == t)
         if (size(points) == 0) cycle
         do f = 1, size(parts)
            parts(f) = norm2(found%jacobian(points, f)*(found%x(f) - problem%variables(f)%start))/sqrt(real(size(points), wp))
         end do
         call add_group(page, fit%targets(t)%name)
         do f = 1, size(parts)
            call add_cell(page, problem%variables(f)%name)
            call add_cell(page, str(found%x(f) - problem%variables(f)%start, 6))
            call add_cell(page, problem%variables(f)%direction%unit)
            call add_cell(page, str(parts(f), 5))
            call add_cell(page, problem%wanted(points(1))%unit)
            call add_bar(page, parts(f)/max(maxval(parts), tiny(1.0_wp)))
         end do
      end do
      call end_table(page)
   end subroutine add_contributions

end module ek_fit_page
