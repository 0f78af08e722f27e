!> Figures of the designs of a study as a sample: bands of curves, histograms, and the convergence of means.
module ek_sample_figures
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_gnuplot_text, only: gnuplot_text
   use ek_study_data, only: study_data_t, summary_t, range_of_values, is_geometric, tic_step, has_expected, looks_flat
   use ek_study_sheet, only: sheet_t, new_sheet, begin_data, add_numbers, end_data, begin_panels, begin_panel, end_panels, &
      full_height
   use ek_gnuplot, only: ink, text_ink, fill, on_derivative, on_label, on_median, on_narrow_band, on_wide_band, on_limit
   implicit none(type, external)
   private
   public :: fan_script, histogram_script, convergence_script
   public :: thinned, cut, add_scale

   character(*), parameter :: nl = new_line('a')
   real(wp), parameter :: room_above = 1.08_wp       !! upper edge of a histogram per height of its highest bar

contains

   !> Phrase about the drawn designs: '; one in 25 of the 5000 designs is drawn'; '' if all designs are drawn.
   pure function thinned(every, of) result(words)
      integer, intent(in) :: every, of
      character(:), allocatable :: words

      words = ''
      if (every > 1) words = '; one in '//str(every)//' of the '//str(of)//' designs is drawn'
   end function thinned

   !> Phrase about omitted responses, factors or pairs for a subtitle: '; 9 of 12 responses'; '' if all are drawn.
   pure function cut(drawn, of, what) result(words)
      integer, intent(in) :: drawn, of
      character(*), intent(in) :: what
      character(:), allocatable :: words

      words = ''
      if (drawn < of) words = '; '//str(drawn)//' of '//str(of)//' '//what
   end function cut

   !> Adds the scale of the colours, above the panels at the right.
   subroutine add_scale(sheet, label, values)
      type(sheet_t), intent(inout) :: sheet
      character(*), intent(in) :: label
      real(wp), intent(in) :: values(:)              !! values that are coloured

      if (.not. is_geometric(pack(values, ieee_is_finite(values)))) call sheet%text%line('set cbtics '//tic_step(values))
      call sheet%text%line('set colorbox horizontal user origin screen 0.74, screen '//above(sheet, 42)//' size screen 0.22, '// &
         'screen '//str(14.0_wp/full_height(sheet), 4)//" noborder; set cbtics nomirror scale 0.4 font ',12'")
      call sheet%text%line('set label 9 '//gnuplot_text(label)//' at screen 0.74, screen '//above(sheet, 14)// &
         " left font ',13'"//text_ink(on_label))
   end subroutine add_scale

   !> The screen coordinate of a point `pixels` below the upper edge, as a gnuplot string.
   pure function above(sheet, pixels) result(text)
      type(sheet_t), intent(in) :: sheet
      integer, intent(in) :: pixels
      character(:), allocatable :: text
      text = str(1.0_wp - real(pixels, wp)/full_height(sheet), 5)
   end function above

   !> The script of a fan figure: the median, and the bands that contain 50 % and 90 % of the curves. If derivatives give a 90
   !> % band, its ends are dashed lines.
   function fan_script(study, name, subtitle, panels) result(text)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the columns
      character(*), intent(in) :: name, subtitle
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      character(:), allocatable :: data, which
      real(wp) :: base
      integer :: p, c, j

      which = 'the'
      if (2*size(study%drawn) <= study%designs) which = str(size(study%drawn))//' of the'
      sheet = new_sheet(name, 'The band of the curves', subtitle// &
         '; line: median, dark: 25 to 75 %, light: 5 to 95 % of '//which//' designs'// &
         trim(merge('; dashed: 5, 95 % by derivatives', '                                ', has_expected(study))), size(panels))
      do p = 1, size(panels)
         c = panels(p)
         call begin_data(sheet, 'band'//str(c))
         do j = 1, size(study%sweep)
            if (.not. ieee_is_finite(study%bands(1, c, j))) cycle
            base = merge(study%bands(3, c, j), 0.0_wp, is_narrow(study, c))
            call add_numbers(sheet, [study%sweep(j), study%bands(:, c, j) - base])
         end do
         call end_data(sheet)
         if (.not. has_expected(study)) cycle
         call begin_data(sheet, 'expected'//str(c))
         do j = 1, size(study%sweep)
            if (.not. ieee_is_finite(study%bands(1, c, j)) .or. .not. ieee_is_finite(study%expected(2, c, j))) cycle
            base = merge(study%bands(3, c, j), 0.0_wp, is_narrow(study, c))
            call add_numbers(sheet, [study%sweep(j), study%expected(4:5, c, j) - base])
         end do
         call end_data(sheet)
      end do
      call begin_panels(sheet)
      do p = 1, size(panels)
         c = panels(p)
         call begin_panel(sheet, p, trim(merge('deviation from the median', '                         ', is_narrow(study, c))), &
            study%swept, study%columns(c)%label)
         data = '$band'//str(c)
         call sheet%text%line('plot '//data//" using 1:2:6 with filledcurves"//fill(on_wide_band)//" notitle, \"//nl// &
            '     '//data//" using 1:3:5 with filledcurves"//fill(on_narrow_band)//" notitle, \"//nl// &
            '     '//data//" using 1:4 with lines linewidth 2.4"//ink(on_median)//" notitle"//lines_of(c))
      end do
      text = end_panels(sheet)

   contains

      !> The plot commands of both ends of the band computed from derivatives; '' if there is no such band.
      function lines_of(c) result(more)
         integer, intent(in) :: c
         character(:), allocatable :: more
         character(:), allocatable :: dashed

         dashed = " with lines linewidth 1.8 dashtype (6, 5)"//ink(on_derivative)//" notitle"

         more = ''
         if (has_expected(study)) more = ', \'//nl//'     $expected'//str(c)//' using 1:2'//dashed//', \'//nl// &
            '     $expected'//str(c)//' using 1:3'//dashed
      end function lines_of

   end function fan_script

   !> Whether the band of a column is too narrow to be distinguished from the median: everywhere less than 5 % of the range of
   !> the median. The deviation from the median is then drawn.
   pure logical function is_narrow(study, c)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: c                       !! index of the column
      real(wp) :: range(2), width(2)

      range = range_of_values(study%bands(3, c, :))
      width = range_of_values(study%bands(5, c, :) - study%bands(1, c, :))
      is_narrow = width(2) < 0.05_wp*(range(2) - range(1))
   end function is_narrow

   !> Script of a histogram of each response with its percentiles and limits.
   function histogram_script(study, name, subtitle, panels) result(text)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, subtitle
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      character(:), allocatable :: line
      real(wp) :: width, room, ends(2)
      integer :: p, r, k

      sheet = new_sheet(name, 'Distribution of the responses', subtitle// &
         '; lines: 5, 50 and 95 %, dashed: limits'// &
         trim(merge('; orange: by derivatives', '                        ', allocated(study%moments))), size(panels))
      do p = 1, size(panels)
         r = panels(p)
         if (maxval([0, study%summaries(r)%counts]) >= 10000) sheet%left = 130
         associate (summary => study%summaries(r))
            call begin_data(sheet, 'bins'//str(r))
            if (summary%used == 0) call add_numbers(sheet, [0.0_wp, 0.0_wp, 1.0_wp])
            width = (summary%highest - summary%lowest)/size(summary%counts)
            if (.not. has_scatter(summary)) width = 0.0_wp
            if (summary%used > 0 .and. .not. width > 0.0_wp) call add_numbers(sheet, [summary%lowest, real(summary%used, wp), &
               0.02_wp*room_of_constant(summary%lowest)])
            do k = 1, merge(size(summary%counts), 0, summary%used > 0 .and. width > 0.0_wp)
               call add_numbers(sheet, [summary%lowest + (k - 0.5_wp)*width, real(summary%counts(k), wp), 0.94_wp*width])
            end do
            call end_data(sheet)
         end associate
      end do
      call begin_panels(sheet)
      call sheet%text%line('set style fill solid 1 noborder; unset yzeroaxis')
      do p = 1, size(panels)
         r = panels(p)
         associate (summary => study%summaries(r), response => study%responses(r))
            call begin_panel(sheet, p, '', response%label, 'designs')
            call sheet%text%line('unset arrow; unset label 3; unset label 4; unset label 5')
            do k = merge(1, 2, has_scatter(summary)), merge(3, 2, has_scatter(summary))
               call add_mark(sheet, k, summary%percentiles(2*k - 1), '')
               line = merge(' 5 %', '50 %', k == 1)
               if (k == 3) line = '95 %'
               call sheet%text%line('set label '//str(k + 2)//' '//gnuplot_text(trim(adjustl(line)))//' at first '// &
                  str(summary%percentiles(2*k - 1), 7)//", graph 1.035 center font ',12'"//text_ink(on_label))
            end do
            if (response%lower > summary%lowest - (summary%highest - summary%lowest)) &
               call add_mark(sheet, 4, response%lower, ' dashtype (8, 6)')
            if (response%upper < summary%highest + (summary%highest - summary%lowest)) &
               call add_mark(sheet, 5, response%upper, ' dashtype (8, 6)')
            ! room for the limits, unless they are far away
            ends = [summary%lowest, summary%highest]
            room = ends(2) - ends(1)
            if (.not. has_scatter(summary)) room = room_of_constant(ends(1))
            if (response%lower < ends(1) .and. response%lower > ends(1) - room) ends(1) = response%lower
            if (response%upper > ends(2) .and. response%upper < ends(2) + room) ends(2) = response%upper
            call sheet%text%line('set xrange ['//str(ends(1) - 0.06_wp*room, 9)//':'//str(ends(2) + 0.06_wp*room, 9)// &
               ']; set xtics '//tic_step(ends)//nl//'set yrange [0:'//str(room_above*highest(study, r), 7)//']')
            call sheet%text%line('plot $bins'//str(r)//" using 1:2:3 with boxes"//ink(on_narrow_band)//" notitle"// &
               density_of(study, r))
         end associate
      end do
      call sheet%text%line('unset arrow; set yrange [*:*]; set xrange [*:*]; set xtics autofreq')
      text = end_panels(sheet)
   end function histogram_script

   !> Whether a histogram can show the scatter of a response.
   pure logical function has_scatter(summary)
      type(summary_t), intent(in) :: summary
      has_scatter = .not. looks_flat([summary%lowest, summary%highest])
   end function has_scatter

   !> The height of the highest bar of a histogram, or of the density drawn over it if that is higher; 1 without designs.
   pure real(wp) function highest(study, r)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: r                       !! index of the response
      real(wp), parameter :: step = 0.05_wp          ! of the density in standard deviations: its top is flat
      real(wp) :: z
      integer :: k

      associate (summary => study%summaries(r))
         highest = max(1, merge(maxval(summary%counts), summary%used, has_scatter(summary)))
         if (.not. has_density(study, r)) return
         do k = -60, 60
            z = step*k
            highest = max(highest, density_height(study, r)*exp(-0.5_wp*z**2)* &
               (1.0_wp + study%moments(2, r)%skewness/6.0_wp*(z**3 - 3.0_wp*z)))
         end do
      end associate
   end function highest

   !> Whether derivatives give a density that can be drawn over the histogram of a response.
   pure logical function has_density(study, r)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: r                       !! index of the response

      has_density = allocated(study%moments)
      if (has_density) has_density = study%moments(2, r)%deviation > 0.0_wp .and. &
         has_scatter(study%summaries(r))
   end function has_density

   !> The height of the normal density at its mean, in designs per bar of the histogram.
   pure real(wp) function density_height(study, r) result(height)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: r                       !! index of the response

      associate (summary => study%summaries(r))
         height = summary%used*(summary%highest - summary%lowest)/size(summary%counts)/ &
            (study%moments(2, r)%deviation*sqrt(2.0_wp*acos(-1.0_wp)))
      end associate
   end function density_height

   !> The plot command of the density that is computed from derivatives and drawn over the histogram (normal with skewness,
   !> Edgeworth). '' if there is no such density.
   function density_of(study, r) result(more)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: r                       !! index of the response
      character(:), allocatable :: more
      character(:), allocatable :: z

      more = ''
      if (.not. has_density(study, r)) return
      associate (row => study%moments(2, r))
         z = '((x - ('//str(row%mean, 9)//'))/'//str(row%deviation, 9)//')'
         more = ', \'//nl//'     '//str(density_height(study, r), 7)//'*exp(-0.5*'//z//'**2)*(1 + ('// &
            str(row%skewness/6.0_wp, 7)//')*('//z//'**3 - 3*'//z//")) with lines linewidth 2"//ink(on_derivative)//" notitle"
      end associate
   end function density_of

   !> The width that replaces the scatter of a constant response on an axis: |value|, or 1 if the value is 0.
   pure real(wp) function room_of_constant(value)
      real(wp), intent(in) :: value
      room_of_constant = merge(abs(value), 1.0_wp, abs(value) > 1.0e-9_wp)
   end function room_of_constant

   !> Adds a vertical line across a panel: dark, or red if it is dashed.
   subroutine add_mark(sheet, number, x, dash)
      type(sheet_t), intent(inout) :: sheet
      integer, intent(in) :: number
      real(wp), intent(in) :: x
      character(*), intent(in) :: dash

      call sheet%text%line('set arrow '//str(number)//' from first '//str(x, 7)//', graph 0 to first '//str(x, 7)// &
         ", graph 1 nohead front linewidth 1.6"//ink(merge(on_limit, on_label, len(dash) > 0))//dash)
   end subroutine add_mark

   !> Script of the mean of the first n designs with its 95 % interval, over n.
   function convergence_script(study, name, subtitle, panels) result(text)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, subtitle
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      character(:), allocatable :: data
      integer :: p, r, k

      sheet = new_sheet(name, 'Convergence of the mean', subtitle// &
         '; band: 95 % confidence if the designs were drawn at random', size(panels))
      sheet%right = 48
      do p = 1, size(panels)
         r = panels(p)
         associate (summary => study%summaries(r))
            call begin_data(sheet, 'mean'//str(r))
            if (size(summary%steps) == 0) call add_numbers(sheet, [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
            do k = 1, size(summary%steps)
               call add_numbers(sheet, [real(summary%steps(k), wp), summary%running(k), summary%running(k) - summary%half(k), &
                  summary%running(k) + summary%half(k)])
            end do
            call end_data(sheet)
         end associate
      end do
      call begin_panels(sheet)
      call sheet%text%line('set logscale x; unset xzeroaxis; unset yzeroaxis')
      do p = 1, size(panels)
         r = panels(p)
         data = '$mean'//str(r)
         call begin_panel(sheet, p, '', 'number of designs', 'mean of '//study%responses(r)%label)
         call sheet%text%line('plot '//data//" using 1:3:4 with filledcurves"//fill(on_wide_band)//" notitle, \"//nl// &
            '     '//data//" using 1:2 with lines linewidth 2.2"//ink(on_median)//" notitle")
      end do
      call sheet%text%line('unset logscale')
      text = end_panels(sheet)
   end function convergence_script

end module ek_sample_figures
