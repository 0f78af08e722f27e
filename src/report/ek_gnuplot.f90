!> A figure as a gnuplot script that the user can read, edit and run again: `gnuplot name.gp` in
!> its folder draws name.png and name.svg from the data files beside it.
module ek_gnuplot
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t
   use ek_text, only: str
   use ek_file, only: write_whole, join_path
   use ek_figure, only: figure_t, panel_t
   use ek_gnuplot_text, only: gnuplot_text, gnuplot_name, gnuplot_comment
   use ek_drawing, only: run_gnuplot
   implicit none(type, external)
   private
   public :: figure_script, write_figure, render_figures, gnuplot_text, palette

   !> Okabe and Ito's colours, distinguishable with colour blindness; without the yellow, too light on white.
   character(7), parameter :: palette(8) = ['#0072B2', '#D55E00', '#009E73', '#CC79A7', &
      '#E69F00', '#56B4E9', '#4D4D4D', '#8C510A']

   integer, parameter :: width = 1200        !! pixels
   integer, parameter :: legend_on_top = 3   !! most entries of a legend above the panel; a longer one is placed at the right

   character(*), parameter :: label_look = " textcolor rgb '#202020'"

contains

   !> Write folder/name.gp.
   subroutine write_figure(figure, folder, error)
      type(figure_t), intent(in) :: figure
      character(*), intent(in) :: folder
      type(error_t), allocatable, intent(out) :: error   !! exit_file

      call write_whole(join_path(folder, figure%name//'.gp'), figure_script(figure), error, can_be_redrawn=.true.)
   end subroutine write_figure

   !> Runs gnuplot once on the scripts written by write_figure into a folder.
   !> Without gnuplot only the scripts are written; a message reports this and it is no error.
   subroutine render_figures(figures, folder, message, error)
      type(figure_t), intent(in) :: figures(:)
      character(*), intent(in) :: folder
      character(:), allocatable, intent(out) :: message   !! '' if the pictures were drawn
      type(error_t), allocatable, intent(out) :: error    !! exit_file, with gnuplot's message
      type(message_list_t) :: scripts, pictures
      integer :: k

      do k = 1, size(figures)
         call scripts%add(figures(k)%name//'.gp')
         call pictures%add(figures(k)%name//'.png')
         call pictures%add(figures(k)%name//'.svg')
      end do
      call run_gnuplot(scripts, pictures, folder, message, error)
   end subroutine render_figures

   !> The script as text.
   pure function figure_script(figure) result(text)
      type(figure_t), intent(in) :: figure
      character(:), allocatable :: text
      type(message_list_t) :: script
      integer :: k, entries, longest
      real(wp) :: right
      logical :: is_single

      is_single = size(figure%panels) == 1
      call measure_legend(figure, entries, longest)
      right = 0.97_wp
      if (entries > legend_on_top) right = 1.0_wp - real(120 + 11*longest, wp)/width

      call script%add(gnuplot_comment(figure%title))
      call script%add('#')
      call script%add(gnuplot_comment('    gnuplot '//figure%name//'.gp'))
      call script%add('#')
      call script%add(gnuplot_comment('in this folder draws '//figure%name//'.png and .svg;'))
      call script%add(gnuplot_comment("gnuplot -e ""formats='pdf'"" "//figure%name//'.gp makes a PDF.'))
      call script%add("if (!exists('formats')) formats = 'png svg'")
      call script%add('')
      call add_look(script)
      call script%add('')
      if (entries > legend_on_top) then
         call script%add('set key at screen '//str(right + 0.015_wp)//', screen 0.88 left top vertical Left reverse samplen 2.5')
      else if (entries > 0) then
         call script%add('set key at screen 0.975, screen 0.965 right top horizontal Right noreverse samplen 2.5')
      end if
      if (is_single) then
         call script%add('set lmargin at screen 0.115; set rmargin at screen '//str(right))
         call script%add('set tmargin at screen 0.88; set bmargin at screen 0.115')
         call add_axes(script, figure%panels(1), '')
      end if
      call script%add("letters = '"//str(merge(15, 12, is_single))//"'")
      call script%add('')
      call script%add('do for [format in formats] {')
      call script%add("   if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,'.letters noenhanced }")
      call script%add("   if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,'.letters "// &
         "background 'white' noenhanced }")
      call script%add("   if (format eq 'pdf') { set terminal pdfcairo size 24cm, 18cm font 'sans-serif,'.letters noenhanced }")
      call script%add('   set output '//gnuplot_text(figure%name//'.')//'.format')
      call script%add('   set label 1 '//gnuplot_text(figure%title)// &
         " at screen 0.025, screen 0.965 font 'sans-serif:Bold,20' textcolor rgb '#202020'")
      if (len(figure%subtitle) > 0) call script%add('   set label 2 '//gnuplot_text(figure%subtitle)// &
         " at screen 0.025, screen 0.922 font 'sans-serif,14' textcolor rgb '#606060'")
      if (is_single) then
         call add_plot(script, figure%panels(1), entries > 0)
      else
         call script%add('   set multiplot layout '//str((size(figure%panels) + 1)/2)//', 2 margins 0.095, '// &
            str(right)//', 0.085, 0.85 spacing 0.115, 0.155')
         do k = 1, size(figure%panels)
            call script%add('')
            call add_axes(script, figure%panels(k), '   ')
            call add_plot(script, figure%panels(k), k == 1 .and. entries > 0)
            if (k == 1) call script%add('   unset label 1; unset label 2')
         end do
         call script%add('   unset multiplot')
      end if
      call script%add('   unset output')
      call script%add('}')
      text = script%text()//new_line('a')
   end function figure_script

   !> Size of the legend. All panels of a figure share that of the first.
   pure subroutine measure_legend(figure, entries, longest)
      type(figure_t), intent(in) :: figure
      integer, intent(out) :: entries, longest   !! number of titles; characters of the longest
      integer :: k

      entries = 0
      longest = 0
      if (size(figure%panels) == 0) return
      do k = 1, size(figure%panels(1)%curves)
         if (len(figure%panels(1)%curves(k)%title) == 0) cycle
         entries = entries + 1
         longest = max(longest, len(figure%panels(1)%curves(k)%title))
      end do
   end subroutine measure_legend

   !> Settings shared by all figures: data format, grid, zero lines, line styles.
   pure subroutine add_look(script)
      type(message_list_t), intent(inout) :: script
      integer :: k

      call script%add('reset')
      call script%add('set encoding utf8')
      call script%add('set datafile separator comma')
      call script%add('set datafile columnheaders')
      call script%add("set datafile missing 'nan'")
      call script%add("set border 3 linecolor rgb '#808080'")
      call script%add("set tics out nomirror textcolor rgb '#404040'")
      call script%add("set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1")
      call script%add("set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.2")
      call script%add("set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.2")
      do k = 1, size(palette)
         call script%add('set style line '//str(k)//" linecolor rgb '"//palette(k)// &
            "' linewidth 2.6 pointtype 7 pointsize 0.7")
      end do
      call script%add('set style line 20 linecolor rgb ''#202020'' linewidth 2 pointtype 6 pointsize 1.8   # marks')
   end subroutine add_look

   !> Labels and ranges of one panel.
   pure subroutine add_axes(script, panel, indent)
      type(message_list_t), intent(inout) :: script
      type(panel_t), intent(in) :: panel
      character(*), intent(in) :: indent
      character(1) :: x, y

      x = merge('y', 'x', panel%swap)
      y = merge('x', 'y', panel%swap)
      if (len(panel%title) > 0) call script%add(indent//'set title '//gnuplot_text(panel%title)// &
         " font 'sans-serif:Bold,14' textcolor rgb '#202020'")
      call script%add(indent//'set '//x//'label '//label(panel%x_label, panel%swap .and. len(indent) > 0)//label_look)
      call script%add(indent//'set '//y//'label '//label(panel%y_label, .not. panel%swap .and. len(indent) > 0)//label_look)
      if (panel%log_x) call script%add(indent//'set logscale '//x)
      if (panel%log_y) call script%add(indent//'set logscale '//y)
      if (allocated(panel%least_y)) then
         call script%add(indent//'set '//y//'range [* < '//str(panel%least_y(1), 4)//' : '// &
            str(panel%least_y(2), 4)//' < *]')
      else if (len(indent) > 0) then
         call script%add(indent//'set '//y//'range [*:*]')
      end if
   end subroutine add_axes

   !> The text of a label; its sign, '(+ …)' behind a gap, is placed on a separate line in a small panel.
   pure function label(text, is_folded) result(words)
      character(*), intent(in) :: text
      logical, intent(in) :: is_folded
      character(:), allocatable :: words
      integer :: gap

      gap = index(text, '    (')
      if (is_folded .and. gap > 0) then
         words = gnuplot_text(text(:gap - 1))//'."\n".'//gnuplot_text(text(gap + 4:))
      else
         words = gnuplot_text(text)
      end if
   end function label

   !> The plot command.
   pure subroutine add_plot(script, panel, has_legend)
      type(message_list_t), intent(inout) :: script
      type(panel_t), intent(in) :: panel
      logical, intent(in) :: has_legend
      character(:), allocatable :: line
      integer :: k, colour

      colour = 0
      do k = 1, size(panel%curves)
         associate (curve => panel%curves(k))
            line = '        '
            if (k == 1) line = '   plot '
            if (panel%swap) then
               line = line//gnuplot_text(curve%file)//' using '//field(curve%y)//':'//field(curve%x)
            else
               line = line//gnuplot_text(curve%file)//' using '//field(curve%x)//':'//field(curve%y)
            end if
            if (curve%style == 'mark') then
               line = line//' with points linestyle 20'
            else
               colour = colour + 1
               if (curve%colour > 0) colour = curve%colour
               line = line//' with '//drawn(curve%style)//' linestyle '//str(modulo(colour - 1, size(palette)) + 1)
               if (curve%style == 'dashed' .or. colour > size(palette)) line = line//' dashtype (12, 7)'
            end if
            if (has_legend .and. len(curve%title) > 0) then
               line = line//' title '//gnuplot_text(curve%title)
            else
               line = line//' notitle'
            end if
         end associate
         if (k < size(panel%curves)) line = line//', \'
         call script%add(line)
      end do
   end subroutine add_plot

   !> The gnuplot style of a curve.
   pure function drawn(style) result(with)
      character(*), intent(in) :: style
      character(:), allocatable :: with

      with = 'lines'
      if (style == 'points') with = 'points'
   end function drawn

   !> A column by its name, or an expression unchanged.
   pure function field(name) result(text)
      character(*), intent(in) :: name
      character(:), allocatable :: text

      if (index(name, '(') == 1) then
         text = name
      else
         text = gnuplot_name(trim(name))
      end if
   end function field

end module ek_gnuplot
