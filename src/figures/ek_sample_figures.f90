!> Figures of the designs of a study as a sample: bands of curves, histograms, and the convergence of means.
module ek_sample_figures
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_study_data, only: study_data_t, summary_t, range_of_values, is_geometric, tic_step, has_expected, looks_flat
   use ek_figure, only: figure_t, panel_t, new_figure, add_series, add_label, columns_of, as_line, as_band, as_boxes, as_segments
   use ek_gnuplot, only: on_derivative, on_label, on_median, on_narrow_band, on_wide_band, on_limit
   implicit none(type, external)
   private
   public :: fan_figure, histogram_figure, convergence_figure
   public :: thinned, cut, colour_by

   real(wp), parameter :: room_above = 1.16_wp       !! upper edge of a histogram per height of its highest bar
   real(wp), parameter :: mark_height = 1.06_wp      !! upper end of a mark in a histogram

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

   !> Sets the scale of the colours of a panel by value.
   pure subroutine colour_by(panel, values)
      type(panel_t), intent(inout) :: panel
      real(wp), intent(in) :: values(:)              !! values that are coloured

      panel%value%has_range = .true.
      panel%value%range = range_of_values(values)
      if (looks_flat(panel%value%range)) panel%value%range(2) = panel%value%range(1) + max(1.0e-6_wp, abs(panel%value%range(1)))
      panel%value%is_log = is_geometric(pack(values, ieee_is_finite(values)))
      if (.not. panel%value%is_log) panel%value%tics = tic_step(values)
   end subroutine colour_by

   !> A fan figure: the median, and the bands that contain 50 % and 90 % of the curves. If derivatives give a 90 % band, its ends
   !> are dashed lines.
   function fan_figure(study, name, subtitle, panels) result(figure)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the columns
      character(*), intent(in) :: name, subtitle
      type(figure_t) :: figure
      character(:), allocatable :: which
      real(wp), dimension(size(study%sweep)) :: base
      logical, dimension(size(study%sweep)) :: is_there
      integer :: p, c, k

      which = 'the'
      if (2*size(study%drawn) <= study%designs) which = str(size(study%drawn))//' of the'
      figure = new_figure(name, 'The band of the curves', subtitle// &
         '; line: median, dark: 25 to 75 %, light: 5 to 95 % of '//which//' designs'// &
         trim(merge('; dashed: 5, 95 % by derivatives', '                                ', has_expected(study))), size(panels))
      do p = 1, size(panels)
         c = panels(p)
         is_there = ieee_is_finite(study%bands(1, c, :))
         base = 0.0_wp
         associate (panel => figure%panels(p), band => study%bands(:, c, :), sweep => study%sweep)
            panel%x%label = study%swept
            panel%y%label = study%columns(c)%label
            if (is_narrow(study, c)) then
               panel%title = 'deviation from the median'
               base = band(3, :)
            end if
            call add_series(panel, as_band, on_wide_band, columns_of(pack(sweep, is_there), pack(band(1, :) - base, is_there), &
               pack(band(5, :) - base, is_there)))
            call add_series(panel, as_band, on_narrow_band, columns_of(pack(sweep, is_there), pack(band(2, :) - base, is_there), &
               pack(band(4, :) - base, is_there)))
            call add_series(panel, as_line, on_median, columns_of(pack(sweep, is_there), pack(band(3, :) - base, is_there)), &
               weight=2.4_wp)
            if (.not. has_expected(study)) cycle
            is_there = is_there .and. ieee_is_finite(study%expected(2, c, :))
            do k = 4, 5
               call add_series(panel, as_line, on_derivative, columns_of(pack(sweep, is_there), &
                  pack(study%expected(k, c, :) - base, is_there)), weight=1.8_wp, is_dashed=.true.)
            end do
         end associate
      end do
   end function fan_figure

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

   !> A histogram of each response with its percentiles and limits.
   function histogram_figure(study, name, subtitle, panels) result(figure)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, subtitle
      type(figure_t) :: figure
      character(4), parameter :: words(3) = [character(4) :: '5 %', '50 %', '95 %']
      real(wp) :: room, ends(2), top
      integer :: p, r, k

      figure = new_figure(name, 'Distribution of the responses', subtitle// &
         '; lines: 5, 50 and 95 %, dashed: limits'// &
         trim(merge('; orange: by derivatives', '                        ', allocated(study%moments))), size(panels))
      do p = 1, size(panels)
         r = panels(p)
         if (maxval([0, study%summaries(r)%counts]) >= 10000) figure%left = 130
         associate (summary => study%summaries(r), response => study%responses(r), panel => figure%panels(p))
            panel%x%label = response%label
            panel%y%label = 'designs'
            panel%x%has_zero = .false.
            top = highest(study, r)
            call add_bars(panel, summary)
            do k = merge(1, 2, has_scatter(summary)), merge(3, 2, has_scatter(summary))
               call add_mark(panel, summary%percentiles(2*k - 1), mark_height*top, .false.)
               call add_label(panel, trim(words(k)), summary%percentiles(2*k - 1), (mark_height + 0.045_wp)*top, on_label, &
                  is_small=.true.)
            end do
            if (response%lower > summary%lowest - (summary%highest - summary%lowest)) &
               call add_mark(panel, response%lower, mark_height*top, .true.)
            if (response%upper < summary%highest + (summary%highest - summary%lowest)) &
               call add_mark(panel, response%upper, mark_height*top, .true.)
            ! room for the limits, unless they are far away
            ends = [summary%lowest, summary%highest]
            room = ends(2) - ends(1)
            if (.not. has_scatter(summary)) room = room_of_constant(ends(1))
            if (response%lower < ends(1) .and. response%lower > ends(1) - room) ends(1) = response%lower
            if (response%upper > ends(2) .and. response%upper < ends(2) + room) ends(2) = response%upper
            panel%x%tics = tic_step(ends)
            panel%x%has_range = .true.
            panel%x%range = ends + [-0.06_wp, 0.06_wp]*room
            panel%y%has_range = .true.
            panel%y%range = [0.0_wp, room_above*top]
            if (has_density(study, r)) call add_density(study, r, panel)
         end associate
      end do
   end function histogram_figure

   !> Adds the bars of a histogram; of a constant response, one bar.
   pure subroutine add_bars(panel, summary)
      type(panel_t), intent(inout) :: panel
      type(summary_t), intent(in) :: summary
      real(wp), allocatable :: bars(:, :)
      real(wp) :: width, middle
      integer :: k

      width = (summary%highest - summary%lowest)/size(summary%counts)
      if (summary%used > 0 .and. has_scatter(summary) .and. width > 0.0_wp) then
         allocate (bars(4, size(summary%counts)))
         do k = 1, size(summary%counts)
            middle = summary%lowest + (k - 0.5_wp)*width
            bars(:, k) = [middle - 0.47_wp*width, middle + 0.47_wp*width, 0.0_wp, real(summary%counts(k), wp)]
         end do
      else
         width = 0.01_wp*room_of_constant(summary%lowest)
         bars = reshape([summary%lowest - width, summary%lowest + width, 0.0_wp, real(summary%used, wp)], [4, 1])
      end if
      call add_series(panel, as_boxes, on_narrow_band, bars)
   end subroutine add_bars

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

   !> Adds the density that is computed from derivatives over the histogram (normal with skewness, Edgeworth).
   subroutine add_density(study, r, panel)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: r                       !! index of the response
      type(panel_t), intent(inout) :: panel
      integer, parameter :: points = 161
      real(wp) :: x(points), z(points)
      integer :: k

      associate (row => study%moments(2, r), ends => panel%x%range)
         x = [(ends(1) + (k - 1)*(ends(2) - ends(1))/(points - 1), k=1, points)]
         z = (x - row%mean)/row%deviation
         call add_series(panel, as_line, on_derivative, columns_of(x, density_height(study, r)*exp(-0.5_wp*z**2)* &
            (1.0_wp + row%skewness/6.0_wp*(z**3 - 3.0_wp*z))), weight=2.0_wp)
      end associate
   end subroutine add_density

   !> The width that replaces the scatter of a constant response on an axis: |value|, or 1 if the value is 0.
   pure real(wp) function room_of_constant(value)
      real(wp), intent(in) :: value
      room_of_constant = merge(abs(value), 1.0_wp, abs(value) > 1.0e-9_wp)
   end function room_of_constant

   !> Adds a vertical line from 0: dark, or dashed in the colour of a limit.
   pure subroutine add_mark(panel, x, height, is_limit)
      type(panel_t), intent(inout) :: panel
      real(wp), intent(in) :: x, height
      logical, intent(in) :: is_limit

      call add_series(panel, as_segments, merge(on_limit, on_label, is_limit), reshape([x, 0.0_wp, 0.0_wp, height], [4, 1]), &
         weight=1.6_wp, is_dashed=is_limit)
   end subroutine add_mark

   !> The mean of the first n designs with its 95 % interval, over n.
   function convergence_figure(study, name, subtitle, panels) result(figure)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, subtitle
      type(figure_t) :: figure
      real(wp), allocatable :: steps(:)
      integer :: p

      figure = new_figure(name, 'Convergence of the mean', subtitle// &
         '; band: 95 % confidence if the designs were drawn at random', size(panels))
      figure%right = 48
      do p = 1, size(panels)
         associate (summary => study%summaries(panels(p)), panel => figure%panels(p))
            panel%x%label = 'number of designs'
            panel%y%label = 'mean of '//study%responses(panels(p))%label
            panel%x%is_log = .true.
            panel%x%has_zero = .false.
            panel%y%has_zero = .false.
            panel%note = 'no design has a value'
            steps = real(summary%steps, wp)
            call add_series(panel, as_band, on_wide_band, columns_of(steps, summary%running - summary%half, &
               summary%running + summary%half))
            call add_series(panel, as_line, on_median, columns_of(steps, summary%running), weight=2.2_wp)
         end associate
      end do
   end function convergence_figure

end module ek_sample_figures
