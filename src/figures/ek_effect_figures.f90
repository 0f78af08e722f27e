!> Figures of the effects of the factors of a study on its responses: maps over two factors, tornado, Sobol indices, Morris'
!> effects.
module ek_effect_figures
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_study_data, only: study_data_t, effects_t, basis_text, range_of_values, is_geometric, tic_step, looks_flat
   use ek_figure, only: figure_t, panel_t, axis_t, new_figure, add_series, add_label, add_point_names, columns_of, as_line, &
      as_both, as_points, as_boxes, as_segments, as_errors, as_heat, at_left
   use ek_gnuplot, only: on_level, on_guide, on_high, on_low, on_range, on_title, on_soft
   implicit none(type, external)
   private
   public :: map_figure, line_figure, tornado_figure, sobol_figure, morris_figure, ranked

   integer, parameter :: most_bars = 15           !! largest number of factors in a panel: the most important ones
   integer, parameter :: named_points = 8         !! factors named in the Morris plot

contains

   !> The contours of some responses over the two factors of a grid.
   function map_figure(study, name, subtitle, panels) result(figure)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, subtitle
      type(figure_t) :: figure
      real(wp), allocatable :: values(:, :)
      integer :: p, r, d, rows

      figure = new_figure(name, 'Responses over two factors', subtitle, size(panels))
      figure%right = 105
      figure%left = 130
      figure%bottom = 92
      if (size(panels) == 1) figure%width = 900
      allocate (values(3, 2*size(study%x, 2)))
      do p = 1, size(panels)
         r = panels(p)
         rows = 0
         do d = 1, size(study%x, 2)
            if (d > 1) then
               if (abs(study%x(1, d) - study%x(1, d - 1)) > 0.0_wp) then
                  rows = rows + 1
                  values(:, rows) = ieee_value(1.0_wp, ieee_quiet_nan)
               end if
            end if
            rows = rows + 1
            values(:, rows) = [study%x(1, d), study%x(2, d), study%y(r, d)]
         end do
         associate (panel => figure%panels(p))
            panel%title = study%responses(r)%label
            panel%has_scale = .true.
            panel%x = axis_over(study, 1)
            panel%y = axis_over(study, 2)
            panel%value%has_range = .true.
            panel%value%range = bounds(study%y(r, :))
            call add_series(panel, as_heat, on_level, values(:, :rows))
         end associate
      end do
   end function map_figure

   !> The axis of a factor of a grid, which ends at the factor's smallest and largest value.
   type(axis_t) function axis_over(study, f) result(axis)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: f                       !! index of the factor

      axis%label = study%factors(f)%label
      axis%is_log = is_geometric(study%x(f, :))
      axis%has_range = .true.
      axis%range = bounds(study%x(f, :))
      axis%tics = tics_of(study%x(f, :))
      axis%has_grid = .false.
      axis%has_zero = .false.
   end function axis_over

   !> Some responses over the only factor of a grid.
   function line_figure(study, name, subtitle, panels) result(figure)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, subtitle
      type(figure_t) :: figure
      integer :: p

      figure = new_figure(name, 'Responses over the factor', subtitle, size(panels))
      do p = 1, size(panels)
         associate (panel => figure%panels(p))
            panel%title = study%responses(panels(p))%label
            panel%x%label = study%factors(1)%label
            panel%x%is_log = is_geometric(study%x(1, :))
            call add_series(panel, as_both, on_level, columns_of(study%x(1, :), study%y(panels(p), :)), weight=2.2_wp)
         end associate
      end do
   end function line_figure

   !> The range of some values. A range without a visible span is extended upward.
   pure function bounds(values) result(range)
      real(wp), intent(in) :: values(:)
      real(wp) :: range(2)

      range = range_of_values(values)
      if (looks_flat(range)) range(2) = range(1) + max(1.0e-6_wp, abs(range(1)))
   end function bounds

   !> The tics of an axis for `set xtics`: for geometric values, at 1, 2 and 5 of every decade; otherwise 'autofreq'.
   pure function tics_of(values) result(text)
      real(wp), intent(in) :: values(:)
      character(:), allocatable :: text
      real(wp), parameter :: steps(3) = [1.0_wp, 2.0_wp, 5.0_wp]
      real(wp) :: at
      integer :: decade, k

      text = 'autofreq'
      if (.not. is_geometric(values)) return
      text = ''
      do decade = floor(log10(minval(values))), ceiling(log10(maxval(values)))
         do k = 1, 3
            at = steps(k)*10.0_wp**decade
            if (at < 0.999_wp*minval(values) .or. at > 1.001_wp*maxval(values)) cycle
            text = text//', '//str(at, 5)
         end do
      end do
      if (len(text) < 3) text = '  autofreq'
      if (text(3:) /= 'autofreq') text = ', ('//text(3:)//')'
      text = text(3:)
   end function tics_of

   !> Indices of the factors in descending order of importance, at most `most`. Factors without a value are last.
   pure function ranked(importance, most) result(order)
      real(wp), intent(in) :: importance(:)
      integer, intent(in) :: most
      integer :: order(min(most, size(importance)))
      logical :: is_free(size(importance))
      integer :: k

      is_free = .true.
      do k = 1, size(order)
         order(k) = maxloc(merge(importance, -1.0_wp, ieee_is_finite(importance)), dim=1, mask=is_free)
         is_free(order(k)) = .false.
      end do
   end function ranked

   !> Width of the margin at the left for the names of the factors [pixels].
   pure integer function name_room(study, letters) result(room)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: letters
      integer :: f

      room = 40 + (2*letters*maxval([(len(study%factors(f)%name), f=1, size(study%factors))]))/3
      room = min(room, 330)
   end function name_room

   !> A figure of horizontal bars, one panel per response.
   function new_bars(study, panels, name, title, subtitle) result(figure)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, title, subtitle
      type(figure_t) :: figure
      integer :: p

      figure = new_figure(name, title, subtitle, size(panels), height=max(170, 110 + 30*min(size(study%factors), most_bars)))
      figure%columns = min(size(figure%panels), 2)
      figure%letters = 14
      figure%left = name_room(study, 14)
      do p = 1, size(panels)
         figure%panels(p)%frame = 1
         figure%panels(p)%y%has_grid = .false.
         figure%panels(p)%y%has_zero = .false.
         figure%panels(p)%x%has_zero = .false.
         figure%panels(p)%note = 'constant, or too few designs'
      end do
   end function new_bars

   !> Sets the bars of a panel: the names of the factors, from above.
   subroutine name_bars(study, order, panel)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: order(:)                !! indices of the factors
      type(panel_t), intent(inout) :: panel
      integer :: k

      do k = 1, size(order)
         call panel%y%names%add(study%factors(order(k))%name)
      end do
      panel%y%has_range = .true.
      panel%y%range = [size(order) + 0.6_wp, 0.4_wp]
   end subroutine name_bars

   !> Bars from one value to others, at 1, 2, … from above: left, right and both edges of each.
   pure function bars_of(from, to, low, high) result(values)
      real(wp), intent(in) :: from, to(:)
      real(wp), intent(in) :: low, high              !! edges of the first bar
      real(wp) :: values(4, size(to))
      integer :: k

      do k = 1, size(to)
         values(:, k) = [min(from, to(k)), max(from, to(k)), k - 1 + low, k - 1 + high]
         if (.not. ieee_is_finite(to(k))) values(:, k) = to(k)
      end do
   end function bars_of

   !> End of a subtitle if only some of the factors are drawn: '; the 15 most important of 20 factors'; '' otherwise.
   pure function cut(study) result(words)
      type(study_data_t), intent(in) :: study
      character(:), allocatable :: words

      words = ''
      if (size(study%factors) > most_bars) words = '; the '//str(most_bars)//' most important of '// &
         str(size(study%factors))//' factors'
   end function cut

   !> The change of some responses when one factor changes alone (tornado).
   function tornado_figure(study, name, subtitle, panels) result(figure)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, subtitle
      type(figure_t) :: figure
      character(:), allocatable :: way
      real(wp), allocatable :: ranges(:, :)
      integer :: order(min(most_bars, size(study%factors)))
      integer :: p, r, k

      way = ''
      if (study%kind == 'tolerance') way = ', to second order by derivatives'
      figure = new_bars(study, panels, name, 'One factor at a time'//way, subtitle// &
         '; blue: the smallest value of the factor, orange: the largest'//cut(study))
      do p = 1, size(panels)             ! not effects(panels): gfortran would not free what that copies
         if (.not. any_gap(study%effects(panels(p):panels(p)))) cycle
         figure%subtitle = figure%subtitle//'; –: the design at this end failed'
         exit
      end do
      do p = 1, size(panels)
         r = panels(p)
         associate (effect => study%effects(r), panel => figure%panels(p))
            order(:) = ranked(effect%highest - effect%lowest, most_bars)
            panel%title = study%responses(r)%label
            panel%x%tics = tic_step([effect%lowest, effect%highest])
            call name_bars(study, order, panel)
            ranges = bars_of(effect%nominal, effect%highest(order), 0.94_wp, 1.06_wp)
            ranges(1, :) = effect%lowest(order)
            ranges(2, :) = effect%highest(order)
            call add_series(panel, as_boxes, on_range, ranges)
            call add_series(panel, as_boxes, on_low, bars_of(effect%nominal, effect%at_low(order), 0.66_wp, 1.34_wp))
            call add_series(panel, as_boxes, on_high, bars_of(effect%nominal, effect%at_high(order), 0.66_wp, 1.34_wp))
            do k = 1, size(order)                    ! the sign of an end without a value: above the middle of the bar, or below
               if (.not. ieee_is_finite(effect%at_low(order(k)))) call add_label(panel, '–', effect%nominal, k - 0.17_wp, &
                  on_title, align=at_left, offset=[0.6_wp, 0.0_wp])
               if (.not. ieee_is_finite(effect%at_high(order(k)))) call add_label(panel, '–', effect%nominal, k + 0.17_wp, &
                  on_title, align=at_left, offset=[0.6_wp, 0.0_wp])
            end do
            call add_series(panel, as_segments, on_title, reshape([effect%nominal, 0.5_wp, 0.0_wp, 1.0_wp*size(order)], [4, 1]), &
               weight=1.5_wp)
         end associate
      end do
   end function tornado_figure

   !> Whether a response at an end of a factor is unknown.
   pure logical function any_gap(effects)
      type(effects_t), intent(in) :: effects(:)
      integer :: r

      any_gap = .false.
      do r = 1, size(effects)
         any_gap = any_gap .or. .not. all(ieee_is_finite(effects(r)%at_low) .and. ieee_is_finite(effects(r)%at_high))
      end do
   end function any_gap

   !> The Sobol indices of some responses with their 95 % intervals. Indices from derivatives (tolerance studies) have no
   !> interval.
   function sobol_figure(study, name, subtitle, panels) result(figure)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, subtitle
      type(figure_t) :: figure
      character(:), allocatable :: way
      integer :: order(min(most_bars, size(study%factors)))
      real(wp) :: at(size(order)), ends(2)
      integer :: p, r, k

      way = '; lines: 95 % confidence'
      if (study%kind == 'tolerance') way = '; to second order by derivatives'
      figure = new_bars(study, panels, name, 'Sobol indices: share of the variance', subtitle// &
         '; blue: the factor alone, orange: with its interactions'//way//cut(study))
      at = [(real(k, wp), k=1, size(at))]
      do p = 1, size(panels)
         r = panels(p)
         associate (effect => study%effects(r), panel => figure%panels(p))
            order(:) = ranked(effect%total, most_bars)
            panel%title = study%responses(r)%label//basis_text(effect, 'base points')
            panel%x%label = 'share of the variance [–]'
            panel%x%has_zero = .true.
            call name_bars(study, order, panel)
            call add_series(panel, as_boxes, on_low, bars_of(0.0_wp, effect%first(order), 0.64_wp, 0.98_wp))
            call add_series(panel, as_boxes, on_high, bars_of(0.0_wp, effect%total(order), 1.02_wp, 1.36_wp))
            call add_series(panel, as_errors, on_title, columns_of(effect%first(order), at - 0.19_wp, effect%first_error(order)), &
               weight=1.5_wp)
            call add_series(panel, as_errors, on_title, columns_of(effect%total(order), at + 0.19_wp, effect%total_error(order)), &
               weight=1.5_wp)
            ends = range_of_values([effect%first(order) - effect%first_error(order), effect%total(order) + &
               effect%total_error(order), effect%first(order) + effect%first_error(order), effect%total(order) - &
               effect%total_error(order), 0.0_wp, 1.0_wp])
            panel%x%has_range = .true.
            panel%x%range = 0.2_wp*[floor(5.0_wp*ends(1) + 1.0e-6_wp), ceiling(5.0_wp*ends(2) - 1.0e-6_wp)]
         end associate
      end do
   end function sobol_figure

   !> Morris' μ* and σ of some responses. A factor far to the right has a large effect; a factor high up acts nonlinearly or
   !> together with others.
   function morris_figure(study, name, subtitle, panels) result(figure)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, subtitle
      type(figure_t) :: figure
      character(63) :: names(min(named_points, size(study%factors)))
      real(wp) :: range(2), ends(2), least
      integer :: order(size(study%factors))
      integer :: p, r, k

      figure = new_figure(name, 'Morris: size and spread of the effects', subtitle// &
         '; effect: change of the response over the full range of the factor; dotted: σ = μ*', size(panels))
      figure%left = 115
      do p = 1, size(panels)
         r = panels(p)
         associate (effect => study%effects(r), panel => figure%panels(p))
            order(:) = ranked(effect%mean_size, size(study%factors))
            range = range_of_values(effect%mean_size)
            ends = [max(1.08_wp*range(2), 1.0e-12_wp), maxval([0.01_wp*range(2), &
               1.3_wp*maxval(effect%deviation, mask=ieee_is_finite(effect%deviation)), 1.0e-12_wp])]
            panel%title = study%responses(r)%label//basis_text(effect, 'effects')
            panel%x%label = 'μ*, mean size of the effect'
            panel%y%label = 'σ, spread of the effect'
            panel%x%has_range = .true.
            panel%y%has_range = .true.
            panel%x%range = [0.0_wp, ends(1)]
            panel%y%range = [0.0_wp, ends(2)]
            panel%x%tics = tic_step(panel%x%range)
            panel%y%tics = tic_step(panel%y%range)
            least = minval(ends)
            call add_series(panel, as_line, on_guide, reshape([0.0_wp, 0.0_wp, least, least], [2, 2]), weight=1.0_wp, &
               is_dashed=.true.)
            call add_series(panel, as_points, on_low, columns_of(effect%mean_size(order), effect%deviation(order)), weight=1.0_wp)
            do k = 1, size(names)
               names(k) = study%factors(order(k))%name
            end do
            call add_point_names(figure, p, names, effect%mean_size(order), effect%deviation(order), on_guide, on_title)
         end associate
      end do
   end function morris_figure

end module ek_effect_figures
