!> The designs of a study as points, responses over factors: the pairs with the largest rank correlations, or a matrix.
module ek_scatter_figure
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_study_data, only: study_data_t, tic_step
   use ek_figure, only: figure_t, panel_t, new_figure, add_series, columns_of, as_points
   use ek_gnuplot, only: on_dots
   use ek_study_panels, only: most_panels
   use ek_effect_figures, only: ranked
   use ek_sample_figures, only: thinned, cut
   implicit none(type, external)
   private
   public :: pairs_figure, matrix_figure, most_columns, leading_factors

   integer, parameter :: most_points = 6000           !! limit on points in all panels: more make the page slow and large
   integer, parameter :: most_rows = 6, most_columns = 7     !! largest numbers of responses and of factors in a matrix
   integer, parameter :: most_cells = 26             !! limit on panels of a matrix

contains

   !> The pairs of a response and a factor with rank correlations of the largest magnitude, in order, one panel per pair.
   function pairs_figure(study, name, subtitle) result(figure)
      type(study_data_t), intent(in) :: study
      character(*), intent(in) :: name, subtitle
      type(figure_t) :: figure
      real(wp) :: sizes(size(study%factors)*size(study%responses))
      integer, allocatable :: order(:)
      integer :: k, r, f, every

      do r = 1, size(study%responses)
         sizes((r - 1)*size(study%factors) + 1:r*size(study%factors)) = abs(study%effects(r)%correlation)
      end do
      order = ranked(sizes, most_panels)
      every = max(1, (study%designs*size(order) + most_points - 1)/most_points)
      figure = new_figure(name, 'Responses over factors', subtitle//'; r: rank correlation'//thinned(every, study%designs)// &
         cut(size(order), size(sizes), 'pairs, those with the largest r'), size(order))
      do k = 1, size(order)
         r = (order(k) - 1)/size(study%factors) + 1
         f = order(k) - (r - 1)*size(study%factors)
         call add_dots(study, r, f, every, 0.45_wp, figure%panels(k))
         figure%panels(k)%x%label = study%factors(f)%label
         figure%panels(k)%y%label = study%responses(r)%label
      end do
   end function pairs_figure

   !> Adds some designs as points, a response over a factor.
   subroutine add_dots(study, r, f, every, size_of_point, panel)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: r, f                       !! indices of response and factor
      integer, intent(in) :: every                      !! one of so many designs is drawn
      real(wp), intent(in) :: size_of_point
      type(panel_t), intent(inout) :: panel
      logical :: is_drawn(study%designs)
      integer :: d

      is_drawn = [(modulo(d - 1, every) == 0, d=1, study%designs)] .and. ieee_is_finite(study%y(r, :study%designs))
      panel%title = correlation_text(study%effects(r)%correlation(f))
      panel%x%has_zero = .false.
      panel%y%has_zero = .false.
      panel%x%tics = tic_step(study%x(f, :))
      panel%y%tics = tic_step(study%y(r, :))
      call add_series(panel, as_points, on_dots, columns_of(pack(study%x(f, :study%designs), is_drawn), &
         pack(study%y(r, :study%designs), is_drawn)), weight=size_of_point)
   end subroutine add_dots

   !> A correlation as a label: 'r = 0.87', or 'r = –' without a value.
   function correlation_text(correlation) result(text)
      real(wp), intent(in) :: correlation
      character(:), allocatable :: text

      text = 'r = –'
      if (ieee_is_finite(correlation)) text = 'r = '//str(real(nint(100*correlation), wp)/100, 2)
   end function correlation_text

   !> A matrix of panels: up to six responses over up to seven factors. Of more factors, those with the largest rank
   !> correlations are shown. Of many designs, only some are drawn.
   function matrix_figure(study, name, subtitle) result(figure)
      type(study_data_t), intent(in) :: study
      character(*), intent(in) :: name, subtitle
      type(figure_t) :: figure
      integer, allocatable :: factors(:)
      integer :: r, f, rows, every, number

      rows = min(size(study%responses), most_rows)
      allocate (factors(min(most_columns, most_cells/rows, size(study%factors))))
      factors(:) = leading_factors(study, min(most_columns, most_cells/rows))
      every = max(1, (study%designs*rows*size(factors) + most_points - 1)/most_points)
      figure = new_figure(name, 'Responses over factors', subtitle//'; r: rank correlation'//thinned(every, study%designs)// &
         cut(size(factors), size(study%factors), 'factors, those with the largest r')// &
         cut(rows, size(study%responses), 'responses'), rows*size(factors), height=merge(250, 340, rows*size(factors) > 4))
      figure%columns = size(factors)
      figure%width = max(900, min(1700, 120 + 270*size(factors)))
      figure%letters = 12
      figure%left = 84
      figure%right = 20
      figure%bottom = 76
      number = 0
      do r = 1, rows
         do f = 1, size(factors)
            number = number + 1
            call add_dots(study, r, factors(f), every, 0.35_wp, figure%panels(number))
            figure%panels(number)%folds_after = 19
            if (r == rows) figure%panels(number)%x%label = study%factors(factors(f))%label
            if (f == 1) figure%panels(number)%y%label = study%responses(r)%label
         end do
      end do
   end function matrix_figure

   !> Indices of at most `most` factors, in the order of the study. Of more factors, those with the largest rank correlation
   !> with any response are selected.
   pure function leading_factors(study, most) result(factors)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: most
      integer, allocatable :: factors(:)
      real(wp) :: size_of(size(study%factors))
      logical :: is_used(size(study%factors))
      integer :: f, r, at

      size_of = 0.0_wp
      do r = 1, size(study%responses)
         do f = 1, size(size_of)
            if (ieee_is_finite(study%effects(r)%correlation(f))) &
               size_of(f) = max(size_of(f), abs(study%effects(r)%correlation(f)))
         end do
      end do
      is_used = .false.
      do f = 1, min(most, size(size_of))
         at = maxloc(size_of, dim=1, mask=.not. is_used)
         is_used(at) = .true.
      end do
      factors = pack([(f, f=1, size(size_of))], is_used)
   end function leading_factors

end module ek_scatter_figure
