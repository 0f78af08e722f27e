!> Parallel coordinates of a study: one line per design across factors and responses.
module ek_parallel_figure
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_gnuplot_text, only: gnuplot_text
   use ek_study_data, only: study_data_t, range_of_values
   use ek_study_sheet, only: sheet_t, new_sheet, two_lines, begin_data, add_numbers, end_data, begin_panels, begin_panel, &
      end_panels, blues
   use ek_sample_figures, only: thinned, cut, add_scale
   use ek_scatter_figure, only: most_columns, leading_factors
   implicit none(type, external)
   private
   public :: parallel_script

   character(*), parameter :: nl = new_line('a')
   integer, parameter :: most_lines = 300            !! largest number of lines of the figure

contains

   !> The script of the parallel coordinates: one line per design across the leading factors and up to four responses,
   !> coloured by the first response. Of more than 300 designs, only some are drawn. Designs without a value of a response are
   !> omitted.
   function parallel_script(study, name, subtitle) result(text)
      type(study_data_t), intent(in) :: study
      character(*), intent(in) :: name, subtitle
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      integer, allocatable :: factors(:)
      real(wp), allocatable :: values(:, :), low(:), span(:)
      real(wp) :: range(2)
      character(:), allocatable :: place
      integer :: k, d, n, every

      allocate (factors(min(most_columns, size(study%factors))))
      factors(:) = leading_factors(study, most_columns)
      n = size(factors) + min(size(study%responses), 4)
      values = reshape([study%x(factors, :)], [size(factors), study%designs])
      allocate (low(n), span(n))
      every = max(1, (study%designs + most_lines - 1)/most_lines)
      sheet = new_sheet(name, 'Factors and responses of each design', subtitle// &
         '; one line per design'//thinned(every, study%designs)// &
         cut(size(factors), size(study%factors), 'factors')//cut(n - size(factors), size(study%responses), 'responses'), 1, &
         height=600)
      sheet%has_scale = .true.
      sheet%right = 95
      sheet%left = 95
      sheet%bottom = 24
      sheet%letters = merge(12, 14, n > 7)
      do k = 1, n
         if (k <= size(factors)) range = range_of_values(values(k, :))
         if (k > size(factors)) range = range_of_values(study%y(k - size(factors), :))
         low(k) = range(1)
         span(k) = max(range(2) - range(1), tiny(1.0_wp))
      end do
      call begin_data(sheet, 'lines')
      do d = 1, study%designs, every
         if (.not. all(ieee_is_finite(study%y(:n - size(factors), d)))) cycle
         do k = 1, n
            if (k <= size(factors)) range(1) = values(k, d)
            if (k > size(factors)) range(1) = study%y(k - size(factors), d)
            call add_numbers(sheet, [real(k, wp), (range(1) - low(k))/span(k), study%y(1, d)])
         end do
         call sheet%text%line('')
      end do
      call end_data(sheet)
      call begin_panels(sheet)
      call sheet%text%line(blues//nl//'unset border; unset grid; unset xzeroaxis; unset yzeroaxis; unset ytics; unset xtics')
      call sheet%text%line('set xrange [0.8:'//str(n + 0.2_wp)//']; set yrange [-0.09:1.25]')
      call add_scale(sheet, study%responses(1)%label, study%y(1, :))
      do k = 1, n
         place = ' at first '//str(k)//', first '
         call sheet%text%line('set arrow '//str(k)//' from first '//str(k)//', first 0 to first '//str(k)// &
            ", first 1 nohead front linewidth 1.5 linecolor rgb '#404040'")
         if (k <= size(factors)) then
            call sheet%text%line('set label '//str(10 + k)//' '//two_lines(study%factors(factors(k))%label, 18)//place// &
               trim(merge('1.21', '1.12', modulo(k, 2) == 1))//" center textcolor rgb '#202020'")
         else
            call sheet%text%line('set label '//str(10 + k)//' '//two_lines(study%responses(k - size(factors))%label, 18)//place// &
               trim(merge('1.21', '1.12', modulo(k, 2) == 1))//" center textcolor rgb '#A04000'")
         end if
         call sheet%text%line('set label '//str(40 + k)//' '//gnuplot_text(str(low(k), 5))//place// &
            "-0.045 center textcolor rgb '#606060'")
         call sheet%text%line('set label '//str(70 + k)//' '//gnuplot_text(str(low(k) + span(k), 5))//place// &
            "1.035 center textcolor rgb '#606060'")
      end do
      call begin_panel(sheet, 1, '', '', '')
      call sheet%text%line("plot $lines using 1:2:3 with lines linewidth 1 linecolor palette notitle")
      call sheet%text%line('set cbtics autofreq; unset label; unset arrow; set border 3; set xrange [*:*]; set yrange [*:*]')
      text = end_panels(sheet)
   end function parallel_script

end module ek_parallel_figure
