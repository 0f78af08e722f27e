!> The designs of a study as points, responses over factors: the pairs with the largest rank correlations, or a matrix.
module ek_scatter_figure
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_study_data, only: study_data_t, tic_step
   use ek_study_sheet, only: sheet_t, new_sheet, begin_data, add_numbers, end_data, begin_panels, begin_panel, end_panels
   use ek_gnuplot, only: ink, on_dots
   use ek_study_panels, only: most_panels
   use ek_effect_figures, only: ranked
   use ek_sample_figures, only: thinned, cut
   implicit none(type, external)
   private
   public :: pairs_script, matrix_script, most_columns, leading_factors

   character(*), parameter :: nl = new_line('a')
   integer, parameter :: most_points = 6000           !! limit on points in all panels: more make the page slow and large
   integer, parameter :: most_rows = 6, most_columns = 7     !! largest numbers of responses and of factors in a matrix
   integer, parameter :: most_cells = 26             !! limit on panels of a matrix: gnuplot has one letter per panel

contains

   !> Script of the pairs of a response and a factor with rank correlations of the largest magnitude, in order, one panel per pair.
   function pairs_script(study, name, subtitle) result(text)
      type(study_data_t), intent(in) :: study
      character(*), intent(in) :: name, subtitle
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      real(wp) :: sizes(size(study%factors)*size(study%responses))
      integer, allocatable :: order(:)
      integer :: k, r, f, d, every

      do r = 1, size(study%responses)
         sizes((r - 1)*size(study%factors) + 1:r*size(study%factors)) = abs(study%effects(r)%correlation)
      end do
      order = ranked(sizes, most_panels)
      every = max(1, (study%designs*size(order) + most_points - 1)/most_points)
      sheet = new_sheet(name, 'Responses over factors', subtitle//'; r: rank correlation'//thinned(every, study%designs)// &
         cut(size(order), size(sizes), 'pairs, those with the largest r'), size(order))
      do k = 1, size(order)
         r = (order(k) - 1)/size(study%factors) + 1
         f = order(k) - (r - 1)*size(study%factors)
         call begin_data(sheet, 'pair'//str(k))
         do d = 1, study%designs, every
            if (ieee_is_finite(study%y(r, d))) call add_numbers(sheet, [study%x(f, d), study%y(r, d)])
         end do
         call end_data(sheet)
      end do
      call begin_panels(sheet)
      call sheet%text%line('unset xzeroaxis; unset yzeroaxis')
      do k = 1, size(order)
         r = (order(k) - 1)/size(study%factors) + 1
         f = order(k) - (r - 1)*size(study%factors)
         call begin_panel(sheet, k, correlation_text(study%effects(r)%correlation(f)), study%factors(f)%label, &
            study%responses(r)%label)
         call sheet%text%line('set xtics '//tic_step(study%x(f, :))//'; set ytics '//tic_step(study%y(r, :))//nl// &
            'plot $pair'//str(k)//" using 1:2 with points pointtype 7 pointsize 0.45"//ink(on_dots)//" notitle")
      end do
      call sheet%text%line('set xtics autofreq; set ytics autofreq')
      text = end_panels(sheet)
   end function pairs_script

   !> A correlation as a label: 'r = 0.87', or 'r = –' without a value.
   function correlation_text(correlation) result(text)
      real(wp), intent(in) :: correlation
      character(:), allocatable :: text

      text = 'r = –'
      if (ieee_is_finite(correlation)) text = 'r = '//str(real(nint(100*correlation), wp)/100, 2)
   end function correlation_text

   !> Script of a matrix of panels: up to six responses over up to seven factors. Of more factors, those with the largest rank
   !> correlations are shown. Of many designs, only some are drawn.
   function matrix_script(study, name, subtitle) result(text)
      type(study_data_t), intent(in) :: study
      character(*), intent(in) :: name, subtitle
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      integer, allocatable :: factors(:)
      integer :: r, f, d, rows, every, number
      character(:), allocatable :: x_label, y_label

      rows = min(size(study%responses), most_rows)
      allocate (factors(min(most_columns, most_cells/rows, size(study%factors))))
      factors(:) = leading_factors(study, min(most_columns, most_cells/rows))
      every = max(1, (study%designs*rows*size(factors) + most_points - 1)/most_points)
      sheet = new_sheet(name, 'Responses over factors', subtitle//'; r: rank correlation'//thinned(every, study%designs)// &
         cut(size(factors), size(study%factors), 'factors, those with the largest r')// &
         cut(rows, size(study%responses), 'responses'), rows*size(factors), height=merge(250, 340, rows*size(factors) > 4))
      sheet%columns = size(factors)
      sheet%width = max(900, min(1700, 120 + 270*size(factors)))
      sheet%letters = 12
      sheet%left = 84
      sheet%right = 20
      sheet%bottom = 76
      call begin_data(sheet, 'rows')
      do d = 1, study%designs, every
         call add_numbers(sheet, [study%x(factors, d), study%y(:rows, d)])
      end do
      call end_data(sheet)
      call begin_panels(sheet)
      call sheet%text%line('unset xzeroaxis; unset yzeroaxis')
      number = 0
      do r = 1, rows
         do f = 1, size(factors)
            number = number + 1
            x_label = study%factors(factors(f))%label
            if (r < rows) x_label = ''
            y_label = study%responses(r)%label
            if (f > 1) y_label = ''
            call begin_panel(sheet, number, correlation_text(study%effects(r)%correlation(factors(f))), x_label, y_label, most=19)
            call sheet%text%line('set xtics '//tic_step(study%x(factors(f), :))//'; set ytics '//tic_step(study%y(r, :))//nl// &
               'plot $rows using '//str(f)//':'// &
               str(size(factors) + r)//" with points pointtype 7 pointsize 0.35"//ink(on_dots)//" notitle")
         end do
      end do
      call sheet%text%line('set xtics autofreq; set ytics autofreq')
      text = end_panels(sheet)
   end function matrix_script

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
