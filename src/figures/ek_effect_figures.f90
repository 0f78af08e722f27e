!> Figures of the effects of the factors of a study on its responses: maps over two factors, tornado, Sobol indices, Morris'
!> effects.
module ek_effect_figures
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_study_data, only: study_data_t, effects_t, basis_text, range_of_values, is_geometric, tic_step, looks_flat
   use ek_study_sheet, only: sheet_t, new_sheet, begin_data, add_numbers, end_data, begin_panels, begin_panel, end_panels, &
      add_point_names, names_plot
   use ek_gnuplot, only: ink, text_ink, value_colours, on_contour, on_contour_dots, on_guide, on_high, on_low, &
      on_range, on_title, on_soft
   implicit none(type, external)
   private
   public :: map_script, line_script, tornado_script, sobol_script, morris_script, ranked

   character(*), parameter :: nl = new_line('a')
   integer, parameter :: most_bars = 15           !! largest number of factors in a panel: the most important ones
   integer, parameter :: named_points = 8         !! factors named in the Morris plot

contains

   !> Script of the contours of some responses over the two factors of a grid.
   function map_script(study, name, subtitle, panels) result(text)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, subtitle
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      character(:), allocatable :: data
      integer :: p, r, d

      sheet = new_sheet(name, 'Responses over two factors', subtitle, size(panels))
      sheet%right = 105
      sheet%left = 130
      sheet%bottom = 92
      if (sheet%panels == 1) sheet%width = 900
      do p = 1, size(panels)
         r = panels(p)
         call begin_data(sheet, 'map'//str(r))
         do d = 1, size(study%x, 2)
            if (d > 1) then
               if (abs(study%x(1, d) - study%x(1, d - 1)) > 0.0_wp) call sheet%text%line('')
            end if
            call add_numbers(sheet, [study%x(1, d), study%x(2, d), study%y(r, d)])
         end do
         call end_data(sheet)
      end do
      call begin_panels(sheet)
      call sheet%text%line(value_colours//nl//'unset grid; unset xzeroaxis; unset yzeroaxis; set xtics offset 0, 0.5')
      if (is_geometric(study%x(1, :))) call sheet%text%line('set logscale x')
      if (is_geometric(study%x(2, :))) call sheet%text%line('set logscale y')
      call sheet%text%line('set xtics '//tics_of(study%x(1, :))//'; set ytics '//tics_of(study%x(2, :)))
      call sheet%text%line('set xrange '//bounds(study%x(1, :))//'; set yrange '//bounds(study%x(2, :)))
      do p = 1, size(panels)
         r = panels(p)
         call begin_panel(sheet, p, study%responses(r)%label, study%factors(1)%label, study%factors(2)%label)
         data = '$map'//str(r)
         ! the lines of equal response are computed first, as a table
         call sheet%text%line('set contour base; set cntrparam levels auto 8; unset surface; set table $lines'//nl// &
            'splot '//data//' using 1:2:3 with lines'//nl//'unset table; unset contour; set surface; set view map')
         call sheet%text%line('set xlabel offset 0, 0.7; set ylabel offset -1, 0; set cbrange '//bounds(study%y(r, :)))
         call sheet%text%line('set pm3d map interpolate 4, 4')
         call sheet%text%line('splot '//data//' using 1:2:3 with pm3d notitle, \'//nl// &
            "      $lines using 1:2:(0) with lines"//ink(on_contour)//" linewidth 1.2 notitle, \"//nl// &
            '      '//data//" using 1:2:(0) with points pointtype 7 pointsize 0.25"//ink(on_contour_dots)//" notitle")
         call sheet%text%line('unset pm3d')
      end do
      call sheet%text%line('unset logscale; set xrange [*:*]; set yrange [*:*]; set cbrange [*:*]; set view 60, 30')
      call sheet%text%line('set xtics autofreq; set ytics autofreq')
      text = end_panels(sheet)
   end function map_script

   !> Script of some responses over the only factor of a grid.
   function line_script(study, name, subtitle, panels) result(text)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, subtitle
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      integer :: p, r, d

      sheet = new_sheet(name, 'Responses over the factor', subtitle, size(panels))
      call begin_data(sheet, 'rows')
      do d = 1, size(study%x, 2)
         call add_numbers(sheet, [study%x(1, d), study%y(panels, d)])
      end do
      call end_data(sheet)
      call begin_panels(sheet)
      if (is_geometric(study%x(1, :))) call sheet%text%line('set logscale x')
      do p = 1, size(panels)
         r = panels(p)
         call begin_panel(sheet, p, study%responses(r)%label, study%factors(1)%label, '')
         call sheet%text%line('plot $rows using 1:'//str(p + 1)// &
            " with linespoints pointtype 7 pointsize 0.7 linewidth 2.2"//ink(on_low)//" notitle")
      end do
      call sheet%text%line('unset logscale')
      text = end_panels(sheet)
   end function line_script

   !> The range of some values as a gnuplot range: '[low:high]'. A range without a visible span is extended upward.
   pure function bounds(values) result(text)
      real(wp), intent(in) :: values(:)
      character(:), allocatable :: text
      real(wp) :: range(2)

      range = range_of_values(values)
      if (looks_flat(range)) range(2) = range(1) + max(1.0e-6_wp, abs(range(1)))
      text = '['//str(range(1), 7)//':'//str(range(2), 7)//']'
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

   !> A sheet of horizontal bars, one panel per response.
   function new_bars(study, panels, name, title, subtitle) result(sheet)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, title, subtitle
      type(sheet_t) :: sheet

      sheet = new_sheet(name, title, subtitle, size(panels), &
         height=max(170, 110 + 30*min(size(study%factors), most_bars)))
      sheet%columns = min(sheet%panels, 2)
      sheet%letters = 14
      sheet%left = name_room(study, 14)
   end function new_bars

   !> End of a subtitle if only some of the factors are drawn: '; the 15 most important of 20 factors'; '' otherwise.
   pure function cut(study) result(words)
      type(study_data_t), intent(in) :: study
      character(:), allocatable :: words

      words = ''
      if (size(study%factors) > most_bars) words = '; the '//str(most_bars)//' most important of '// &
         str(size(study%factors))//' factors'
   end function cut

   !> Script of the change of some responses when one factor changes alone (tornado).
   function tornado_script(study, name, subtitle, panels) result(text)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, subtitle
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      character(:), allocatable :: data, way
      integer :: order(min(most_bars, size(study%factors)))
      integer :: p, r, k

      way = ''
      if (study%kind == 'tolerance') way = ', to second order by derivatives'
      sheet = new_bars(study, panels, name, 'One factor at a time'//way, subtitle// &
         '; blue: the smallest value of the factor, orange: the largest'//cut(study))
      do p = 1, size(panels)             ! not effects(panels): gfortran would not free what that copies
         if (.not. any_gap(study%effects(panels(p):panels(p)))) cycle
         sheet%subtitle = sheet%subtitle//'; –: the design at this end failed'
         exit
      end do
      do p = 1, size(panels)
         r = panels(p)
         associate (effect => study%effects(r))
            order(:) = ranked(effect%highest - effect%lowest, most_bars)
            call begin_data(sheet, 'bars'//str(r))
            do k = 1, size(order)
               call add_numbers(sheet, [real(k, wp), effect%nominal, effect%at_low(order(k)), effect%at_high(order(k)), &
                  effect%lowest(order(k)), effect%highest(order(k))], study%factors(order(k))%name)
            end do
            call end_data(sheet)
            if (.not. any_gap([effect])) cycle
            call begin_data(sheet, 'gaps'//str(r))         ! nominal value, bar, and the ends without a value: offsets of the sign
            do k = 1, size(order)
               if (.not. ieee_is_finite(effect%at_low(order(k)))) call add_numbers(sheet, [effect%nominal, k - 0.17_wp])
               if (.not. ieee_is_finite(effect%at_high(order(k)))) call add_numbers(sheet, [effect%nominal, k + 0.17_wp])
            end do
            call end_data(sheet)
         end associate
      end do
      call sheet%text%line('min2(a,b) = a < b ? a : b; max2(a,b) = a > b ? a : b')
      call begin_panels(sheet)
      call sheet%text%line('set style fill solid 1 noborder; unset xzeroaxis; unset yzeroaxis; set grid noytics')
      call sheet%text%line('set yrange ['//str(size(order) + 0.6_wp)//':0.4]; set border 1; set ytics scale 0')
      do p = 1, size(panels)
         r = panels(p)
         call begin_panel(sheet, p, study%responses(r)%label, '', '')
         call sheet%text%line('set xtics '//tic_step([study%effects(r)%lowest, study%effects(r)%highest]))
         data = '$bars'//str(r)
         call sheet%text%line('plot '//data// &
            " using 5:1:5:6:($1-0.06):($1+0.06):ytic(7) with boxxyerror"//ink(on_range)//" notitle, \"//nl// &
            '     '//data//" using 2:1:(min2($2,$3)):(max2($2,$3)):($1-0.34):($1+0.34) with boxxyerror"//ink(on_low)// &
            ' notitle, \'//nl// &
            '     '//data//" using 2:1:(min2($2,$4)):(max2($2,$4)):($1-0.34):($1+0.34) with boxxyerror"//ink(on_high)// &
            ' notitle, \'//nl// &
            gaps_plot(r, study%effects(r))// &
            '     '//data//" using 2:($1-0.5):(0):(1) with vectors nohead linewidth 1.5"//ink(on_title)//" notitle")
      end do
      call sheet%text%line('set yrange [*:*]; set border 3; set xtics autofreq')
      text = end_panels(sheet)
   end function tornado_script

   !> Whether a response at an end of a factor is unknown.
   pure logical function any_gap(effects)
      type(effects_t), intent(in) :: effects(:)
      integer :: r

      any_gap = .false.
      do r = 1, size(effects)
         any_gap = any_gap .or. .not. all(ieee_is_finite(effects(r)%at_low) .and. ieee_is_finite(effects(r)%at_high))
      end do
   end function any_gap

   !> The part of a plot command that marks ends without a value. The mark is above the middle of the bar for the smallest value and
   !> below for the largest; '' if all ends have values.
   pure function gaps_plot(panel, effects) result(part)
      integer, intent(in) :: panel
      type(effects_t), intent(in) :: effects
      character(:), allocatable :: part

      part = ''
      if (any_gap([effects])) part = '     $gaps'//str(panel)//" using 1:2:('–') with labels offset 1.5, 0 notitle, \"//nl
   end function gaps_plot

   !> Script of the Sobol indices of some responses with their 95 % intervals. Indices from derivatives (tolerance studies)
   !> have no interval.
   function sobol_script(study, name, subtitle, panels) result(text)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, subtitle
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      character(:), allocatable :: data, way
      integer :: order(min(most_bars, size(study%factors)))
      integer :: p, r, k

      way = '; lines: 95 % confidence'
      if (study%kind == 'tolerance') way = '; to second order by derivatives'
      sheet = new_bars(study, panels, name, 'Sobol indices: share of the variance', subtitle// &
         '; blue: the factor alone, orange: with its interactions'//way//cut(study))
      do p = 1, size(panels)
         r = panels(p)
         associate (effect => study%effects(r))
            order(:) = ranked(effect%total, most_bars)
            call begin_data(sheet, 'bars'//str(r))
            do k = 1, size(order)
               call add_numbers(sheet, [real(k, wp), effect%first(order(k)), effect%first_error(order(k)), &
                  effect%total(order(k)), effect%total_error(order(k))], study%factors(order(k))%name)
            end do
            call end_data(sheet)
         end associate
      end do
      call begin_panels(sheet)
      call sheet%text%line('set style fill solid 1 noborder; set grid noytics; unset xzeroaxis')
      call sheet%text%line('set yrange ['//str(size(order) + 0.6_wp)//':0.4]; set border 1; set ytics scale 0')
      call sheet%text%line('set xrange [* < 0:1 < *]')
      do p = 1, size(panels)
         r = panels(p)
         call begin_panel(sheet, p, study%responses(r)%label//basis_text(study%effects(r), 'base points'), &
            'share of the variance [–]', '')
         if (.not. any(ieee_is_finite([study%effects(r)%first, study%effects(r)%total]))) then
            ! gnuplot refuses data without a value
            call sheet%text%line("unset ytics; set label 3 'constant, or too few designs' at graph 0.5, graph 0.5 center"// &
               text_ink(on_soft)//"; plot [0:1] -1 notitle; unset label 3; set ytics scale 0")
            cycle
         end if
         data = '$bars'//str(r)
         call sheet%text%line('plot '//data// &
            " using (0):1:(0):2:($1-0.36):($1-0.02):ytic(6) with boxxyerror"//ink(on_low)//" notitle, \"//nl// &
            '     '//data//" using (0):1:(0):4:($1+0.02):($1+0.36) with boxxyerror"//ink(on_high)//" notitle, \"//nl// &
            '     '//data//" using 2:($1-0.19):3 with xerrorbars pointtype -1 linewidth 1.5"//ink(on_title)//" notitle, \"// &
            nl// &
            '     '//data//" using 4:($1+0.19):5 with xerrorbars pointtype -1 linewidth 1.5"//ink(on_title)//" notitle")
      end do
      call sheet%text%line('set yrange [*:*]; set xrange [*:*]; set border 3')
      text = end_panels(sheet)
   end function sobol_script

   !> Script of Morris' μ* and σ of some responses. A factor far to the right has a large effect; a factor high up acts
   !> nonlinearly or together with others.
   function morris_script(study, name, subtitle, panels) result(text)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      character(*), intent(in) :: name, subtitle
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      character(63) :: names(min(named_points, size(study%factors)))
      real(wp) :: range(2), ends(2, size(study%responses))
      integer :: order(size(study%factors))
      integer :: p, r, k

      sheet = new_sheet(name, 'Morris: size and spread of the effects', subtitle// &
         '; effect: change of the response over the full range of the factor; dotted: σ = μ*', &
         size(panels))
      sheet%left = 115
      do p = 1, size(panels)
         r = panels(p)
         associate (effect => study%effects(r))
            order(:) = ranked(effect%mean_size, size(study%factors))
            range = range_of_values(effect%mean_size)
            ends(:, r) = [max(1.08_wp*range(2), 1.0e-12_wp), maxval([0.01_wp*range(2), &
               1.3_wp*maxval(effect%deviation, mask=ieee_is_finite(effect%deviation)), 1.0e-12_wp])]
            call begin_data(sheet, 'points'//str(r))
            do k = 1, size(order)
               if (k <= size(names)) names(k) = study%factors(order(k))%name
               call add_numbers(sheet, [effect%mean_size(order(k)), effect%deviation(order(k))])
            end do
            call end_data(sheet)
            call add_point_names(sheet, r, names, effect%mean_size(order), effect%deviation(order), &
               [0.0_wp, ends(1, r)], [0.0_wp, ends(2, r)])
         end associate
      end do
      call begin_panels(sheet)
      do p = 1, size(panels)
         r = panels(p)
         call begin_panel(sheet, p, study%responses(r)%label//basis_text(study%effects(r), 'effects'), &
            'μ*, mean size of the effect', 'σ, spread of the effect')
         call sheet%text%line('set ytics '//tic_step([0.0_wp, ends(2, r)])//'; set xtics '//tic_step([0.0_wp, ends(1, r)])// &
            '; set xrange [0:'//str(ends(1, r), 6)//']; set yrange [0:'//str(ends(2, r), 6)//']')
         call sheet%text%line("plot x with lines dashtype (8, 6)"//ink(on_guide)//" notitle, \"//nl// &
            '     $points'//str(r)//" using 1:2 with points pointtype 7 pointsize 1"//ink(on_low)//" notitle, \"//nl// &
            '     '//names_plot(r))
      end do
      call sheet%text%line('set xrange [*:*]; set yrange [*:*]; set xtics autofreq; set ytics autofreq')
      text = end_panels(sheet)
   end function morris_script

end module ek_effect_figures
