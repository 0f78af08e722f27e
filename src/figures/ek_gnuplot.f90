!> The frame of every gnuplot script: its head, the formats and sizes of its pictures, and the colours. No other module names a
!> terminal of gnuplot or a colour; figures name the role of what they draw.
module ek_gnuplot
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_gnuplot_text, only: gnuplot_text, gnuplot_comment
   implicit none(type, external)
   private
   public :: begin_script, begin_formats, end_formats, begin_charts_file, begin_scene, end_scene, begin_animation
   public :: ink, text_ink, fill, rgb, series_rgb, heading_style, subtitle_style, value_colours, zero_axis, role_name
   public :: on_title, on_label, on_soft, on_frame, on_zero, on_guide, on_grid, on_contact, on_box, on_range, on_design
   public :: on_wide_band, on_narrow_band, on_median, on_limit, on_result, on_dots, on_contour, on_contour_dots, on_low, on_high, &
      on_derivative, on_level, on_limits, on_skeleton, on_point, on_leader, on_swatch, on_part, on_line

   character(*), parameter :: nl = new_line('a')

   ! Roles: what a colour stands for
   integer, parameter :: on_title = 1, on_label = 2, on_soft = 3, on_frame = 4, on_zero = 5, on_guide = 6, on_grid = 7, &
      on_contact = 8, on_box = 9, on_range = 10
   integer, parameter :: on_wide_band = 11      !! 90 % of the curves; interval of a mean
   integer, parameter :: on_narrow_band = 12    !! half of the curves; bars of a histogram
   integer, parameter :: on_median = 13, on_limit = 14
   integer, parameter :: on_result = 15         !! name of a response among factors
   integer, parameter :: on_dots = 16           !! many points, translucent
   integer, parameter :: on_contour = 17, on_contour_dots = 18
   integer, parameter :: on_skeleton = 19       !! lines of a suspension between its hardpoints
   integer, parameter :: on_point = 20          !! hardpoints, names in space
   integer, parameter :: on_leader = 21, on_swatch = 22
   integer, parameter :: on_part = 23           !! first kind of part in space; the others follow in the order of ek_scene
   integer, parameter :: on_line = 35           !! first kind of line in space
   character(9), parameter :: colours(38) = [character(9) :: '#202020', '#404040', '#606060', '#808080', '#909090', '#B0B0B0', &
      '#E6E6E6', '#ECECEC', '#C0C0C0', '#A0A0A0', '#CCE3F0', '#80BAD8', '#00486F', '#B02020', '#A04000', '#600072B2', '#FFFFFF', &
      '#80FFFFFF', '#9AB7D3', '#30343B', '#7C8896', '#CCCCCC', &
      '#E9EEF2', '#4A4A4A', '#3B76B5', '#7C8896', '#3B76B5', '#1B9E8A', '#C8442F', '#A9B4C0', '#E8A33D', '#30343B', '#30343B', &
      '#8E6BBE', '#D55E00', '#009E73', '#C4CCD4', '#30343B']

   !> Okabe and Ito's colours for curves, distinguishable with colour blindness; without the yellow, too light on white.
   character(7), parameter :: palette(8) = ['#0072B2', '#D55E00', '#009E73', '#CC79A7', '#E69F00', '#56B4E9', '#4D4D4D', '#8C510A']
   ! Roles that are colours of the palette, as negative indices
   integer, parameter :: on_level = -1          !! a curve alone; lines of equal first factor
   integer, parameter :: on_design = -1         !! points of a file or of a target
   integer, parameter :: on_low = -1, on_high = -5     !! smallest and largest value of a factor; first and total index
   integer, parameter :: on_derivative = -2     !! computed by derivatives; a result over its target
   integer, parameter :: on_limits = -3         !! limits of a curve

   !> The gnuplot command of the scale of values: viridis without its lightest end.
   character(*), parameter :: value_colours = "set palette defined (0 '#440154', 0.25 '#3B528B', 0.5 '#21918C', "// &
      "0.75 '#5EC962', 1 '#E8D000')"
   !> The style of the axes through 0, and the commands of the grid and of these axes.
   character(*), parameter :: zero_style = " linetype 1 linecolor rgb '"//trim(colours(on_zero))//"' linewidth 1.2"
   character(*), parameter :: axes_style = "set grid linetype 1 linecolor rgb '"//trim(colours(on_grid))//"' linewidth 1"//nl// &
      'set xzeroaxis'//zero_style//nl//'set yzeroaxis'//zero_style

contains

   !> The colour of a role, for gnuplot: rgb '#202020'.
   pure function rgb(role) result(text)
      integer, intent(in) :: role
      character(:), allocatable :: text

      if (role > 0) text = "rgb '"//trim(colours(role))//"'"
      if (role < 0) text = "rgb '"//palette(-role)//"'"
   end function rgb

   !> The colour of a role in pages: the name of a variable of their style sheet.
   pure function role_name(role) result(name)
      integer, intent(in) :: role
      character(6) :: name
      character(6), parameter :: names(on_point) = [character(6) :: 'ink', 'soft', 'soft', 'zero', 'zero', 'zero', 'grid', 'grid', &
         'grid', 'zero', 'wide', 'narrow', 'median', 'bad', 'c2', 'dots', 'paper', 'paper', 'c6', 'ink']

      name = 'ink'
      if (role < 0) name = 'c'//str(-role)
      if (role > 0 .and. role <= on_point) name = names(role)
   end function role_name

   !> The colour of the k-th curve of a panel; after eight curves the colours repeat.
   pure function series_rgb(k) result(text)
      integer, intent(in) :: k
      character(:), allocatable :: text
      text = rgb(-(modulo(k - 1, size(palette)) + 1))
   end function series_rgb

   !> The option of a line or point in the colour of a role.
   pure function ink(role) result(text)
      integer, intent(in) :: role
      character(:), allocatable :: text
      text = ' linecolor '//rgb(role)
   end function ink

   !> The option of a text in the colour of a role.
   pure function text_ink(role) result(text)
      integer, intent(in) :: role
      character(:), allocatable :: text
      text = ' textcolor '//rgb(role)
   end function text_ink

   !> The option of an area in the colour of a role.
   pure function fill(role) result(text)
      integer, intent(in) :: role
      character(:), allocatable :: text
      text = ' fillcolor '//rgb(role)
   end function fill

   !> The command that shows or hides the line at 0 that is parallel to an axis.
   pure function zero_axis(along, is_shown) result(text)
      character(1), intent(in) :: along          !! 'x', 'y' or 'z'
      logical, intent(in) :: is_shown
      character(:), allocatable :: text

      text = 'unset '//along//'zeroaxis'
      if (is_shown) text = 'set '//along//'zeroaxis'//zero_style
   end function zero_axis

   !> The font and colour of a heading of a size.
   pure function heading_style(letters) result(text)
      integer, intent(in) :: letters
      character(:), allocatable :: text
      text = " font 'sans-serif:Bold,"//str(letters)//"'"//text_ink(on_title)
   end function heading_style

   !> The font and colour of a subtitle.
   pure function subtitle_style() result(text)
      character(:), allocatable :: text
      text = " font 'sans-serif,14'"//text_ink(on_soft)
   end function subtitle_style

   !> Adds the head of a script that draws name.png and name.svg: what it draws and how, and the style of frame, tics and grid.
   pure subroutine begin_script(script, name, title, separator)
      type(buffer_t), intent(inout) :: script
      character(*), intent(in) :: name, title
      character(*), intent(in) :: separator      !! of columns in data: 'comma', 'whitespace'

      call script%line(gnuplot_comment(title)//nl//'#'//nl//gnuplot_comment('    gnuplot '//name//'.gp')//nl//'#')
      call script%line(gnuplot_comment('in this folder draws '//name//'.png and .svg;'))
      call script%line(gnuplot_comment("gnuplot -e ""formats='pdf'"" "//name//'.gp makes a PDF.'))
      call script%line("if (!exists('formats')) formats = 'png svg'"//nl//'reset'//nl//'set encoding utf8')
      call script%line('set datafile separator '//separator//nl//"set datafile missing '"// &
         trim(merge('nan', 'NaN', separator == 'comma'))//"'")
      call script%line('set border 3'//ink(on_frame)//nl//'set tics out nomirror scale 0.6'//text_ink(on_label)//nl//axes_style)
   end subroutine begin_script

   !> Begins the loop over the formats: terminal, size and file of a picture.
   pure subroutine begin_formats(script, name, width, height, letters)
      type(buffer_t), intent(inout) :: script
      character(*), intent(in) :: name
      integer, intent(in) :: width, height       !! pixels; in a PDF, 50 pixels are 1 cm
      integer, intent(in) :: letters             !! size of the font
      character(:), allocatable :: font, pixels

      font = " font 'sans-serif,"//str(letters)//"' noenhanced"
      pixels = ' size '//str(width)//', '//str(height)
      call script%line(nl//'do for [format in formats] {')
      call script%line("if (format eq 'png') { set terminal pngcairo"//pixels//font//' }')
      call script%line("if (format eq 'svg') { set terminal svg"//pixels//font//" background 'white' }")
      call script%line("if (format eq 'pdf') { set terminal pdfcairo size "// &
         str(width/50)//'cm, '//str(height/50)//'cm'//font//' }')
      call script%line('set output '//gnuplot_text(name//'.')//'.format')
   end subroutine begin_formats

   !> Ends the loop over the formats.
   pure subroutine end_formats(script)
      type(buffer_t), intent(inout) :: script
      call script%line('unset output'//nl//'}')
   end subroutine end_formats

   !> Adds the head of a script that draws many small charts, each as an SVG file of its own.
   pure subroutine begin_charts_file(script, width, height)
      type(buffer_t), intent(inout) :: script
      integer, intent(in) :: width, height       !! pixels, at font size 13

      call script%line('# The charts of a page. Run gnuplot in this folder to draw them again.')
      call script%line('reset'//nl//'set encoding utf8')
      call script%line('set terminal svg size '//str(width)//', '//str(height)// &
         " dynamic font 'sans-serif,13' linewidth 1 noenhanced")
      call script%line('set border 3'//ink(on_frame))
      call script%line('set tics out nomirror scale 0.6'//text_ink(on_label)//nl//axes_style)
   end subroutine begin_charts_file

   !> Adds the terminal of a picture in space: name.svg in the folder `to`, or a window with the variable `look`.
   pure subroutine begin_scene(script, name)
      type(buffer_t), intent(inout) :: script
      character(*), intent(in) :: name

      call script%line("if (exists('look')) { set terminal qt size 1200, 800; set mouse } "// &
         "else { set terminal svg size 960, 640 dynamic font 'sans-serif,13' noenhanced; set output "// &
         'to.'//gnuplot_text(name//'.svg')//' }')
   end subroutine begin_scene

   !> Draws the picture in space again, as name.png.
   pure subroutine end_scene(script, name)
      type(buffer_t), intent(inout) :: script
      character(*), intent(in) :: name

      call script%line("if (!exists('look')) { set terminal pngcairo size 1440, 960 font 'sans-serif,13' fontscale 1.25 "// &
         'linewidth 1.5 noenhanced; set output to.'//gnuplot_text(name//'.png')//'; replot; unset output }')
   end subroutine end_scene

   !> Adds the terminal of name.gif, which repeats endlessly, in the folder `to`.
   pure subroutine begin_animation(script, name)
      type(buffer_t), intent(inout) :: script
      character(*), intent(in) :: name

      call script%line('set terminal gif animate delay 7 loop 0 size 720, 540 font ''sans,12'' noenhanced')
      call script%line('set output to.'//gnuplot_text(name//'.gif'))
   end subroutine begin_animation

end module ek_gnuplot
