!> A sheet of panels as a gnuplot script that contains its data: `gnuplot name.gp` draws name.png and name.svg in the folder
!> where gnuplot runs. The caller adds the data blocks, calls begin_panels, calls begin_panel and adds the plot command for
!> each panel, and then calls end_panels.
!> Names of points in a panel are placed without overlap.
module ek_study_sheet
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_chart, only: add_coordinate
   use ek_gnuplot, only: begin_script, begin_formats, end_formats, ink, text_ink, heading_style, subtitle_style, on_guide, on_label
   use ek_gnuplot_text, only: gnuplot_text
   implicit none(type, external)
   private
   public :: sheet_t, new_sheet, two_lines, begin_data, add_numbers, end_data, begin_panels, begin_panel, end_panels, full_height, &
      add_point_names, names_plot, label_place_t, place_labels

   !> The position at which the name of a point begins, as shares of the panel's width and height. With is_left, the name is
   !> to the left of the point and ends at this position.
   type :: label_place_t
      real(wp) :: x = 0.0_wp, y = 0.0_wp
      logical :: is_left = .false.
   end type label_place_t

   real(wp), parameter :: gap = 0.02_wp           !! distance between a point and its name, as a share of the panel's width
   integer, parameter :: most_steps = 80          !! number of trial shifts of a name; the step is a quarter of its height

   character(*), parameter :: nl = new_line('a')
   integer, parameter :: title_height = 88        !! height above the panels [pixels]

   type :: sheet_t
      character(:), allocatable :: name, title, subtitle
      integer :: panels = 1, columns = 1
      integer :: width = 1200                     !! width of the picture [pixels]
      integer :: height = 420                     !! height of a row of panels [pixels]
      integer :: left = 110, right = 30, bottom = 80, top = 34      !! margins of a panel [pixels]
      integer :: letters = 15                     !! size of the font
      logical :: has_scale = .false.              !! a scale of colours is at the right of title and subtitle
      type(buffer_t) :: text
   end type sheet_t

contains

   !> A sheet with a number of panels, in one, two or three columns.
   pure type(sheet_t) function new_sheet(name, title, subtitle, panels, height) result(sheet)
      character(*), intent(in) :: name, title, subtitle
      integer, intent(in) :: panels
      integer, intent(in), optional :: height     !! height of a row of panels [pixels]; chosen here if absent or 0

      sheet%name = name
      sheet%title = title
      sheet%subtitle = subtitle
      sheet%panels = max(1, panels)
      sheet%columns = merge(3, merge(2, 1, panels > 1), panels > 4)
      sheet%height = merge(370, merge(490, 640, panels > 1), panels > 4)
      if (present(height)) then
         if (height > 0) sheet%height = height
      end if
      if (panels > 4) sheet%letters = 13
      call begin_script(sheet%text, name, title, 'whitespace')
      call sheet%text%line('unset key')
   end function new_sheet

   !> Begins a data block, '$name << EOD'.
   pure subroutine begin_data(sheet, name)
      type(sheet_t), intent(inout) :: sheet
      character(*), intent(in) :: name
      call sheet%text%line('$'//name//' << EOD')
   end subroutine begin_data

   !> Adds a row of numbers with seven digits to a data block. A label is added in quotes at the end of the row.
   pure subroutine add_numbers(sheet, values, label)
      type(sheet_t), intent(inout) :: sheet
      real(wp), intent(in) :: values(:)
      character(*), intent(in), optional :: label      !! string; '_' replaces quotes, backslashes and control characters
      integer :: k

      do k = 1, size(values)
         if (k > 1) call sheet%text%add(' ')
         call add_coordinate(sheet%text, values(k), 7)
      end do
      if (present(label)) call sheet%text%add(' "'//field_of(label)//'"')
      call sheet%text%line('')
   end subroutine add_numbers

   !> A string as a field of a data block: '_' replaces quotes, backslashes and control characters.
   pure function field_of(label) result(field)
      character(*), intent(in) :: label
      character(len(label)) :: field
      integer :: k

      field = label
      do k = 1, len(label)
         if (scan(label(k:k), '"\') == 1 .or. iachar(label(k:k)) < 32) field(k:k) = '_'
      end do
   end function field_of

   !> Ends a data block.
   pure subroutine end_data(sheet)
      type(sheet_t), intent(inout) :: sheet
      call sheet%text%line('EOD')
   end subroutine end_data

   !> Adds the names of points in a panel to the data, one row per name: the point, the line from the point to its name, and
   !> whether the name is to the left of the end of the line. If there is enough room, names do not overlap other names or
   !> named points.
   subroutine add_point_names(sheet, panel, names, x, y, x_range, y_range)
      type(sheet_t), intent(inout) :: sheet
      integer, intent(in) :: panel
      character(*), intent(in) :: names(:)           !! names of the first points
      real(wp), intent(in) :: x(:), y(:)             !! coordinates of all points
      real(wp), intent(in) :: x_range(2), y_range(2) !! ranges of the panel, from left to right and from below upward
      type(label_place_t) :: places(size(names))
      real(wp), parameter :: size_in_png = 4.0_wp/3.0_wp     ! pixels per point of a font; 1 in SVG
      real(wp) :: widths(size(names)), letters, cell, to(2)
      integer :: k, n

      n = size(names)
      letters = size_in_png*sheet%letters
      cell = real(sheet%width, wp)/sheet%columns - sheet%left - sheet%right
      do k = 1, n
         widths(k) = 0.64_wp*letters*len_trim(names(k))/cell
      end do
      call place_labels((x(:n) - x_range(1))/(x_range(2) - x_range(1)), (y(:n) - y_range(1))/(y_range(2) - y_range(1)), widths, &
         1.2_wp*letters/(sheet%height - sheet%top - sheet%bottom), places)
      call begin_data(sheet, 'names'//str(panel))
      do k = 1, n
         to = [x_range(1) + places(k)%x*(x_range(2) - x_range(1)), y_range(1) + places(k)%y*(y_range(2) - y_range(1))]
         call add_numbers(sheet, [x(k), y(k), to(1) - x(k), to(2) - y(k), merge(1.0_wp, 0.0_wp, places(k)%is_left)], &
            trim(names(k)))
      end do
      call end_data(sheet)
   end subroutine add_point_names

   !> The last parts of a plot command: they draw the names of points of a panel (`add_point_names`), and the lines from the
   !> points to their names.
   pure function names_plot(panel) result(parts)
      integer, intent(in) :: panel
      character(:), allocatable :: parts, data

      data = '$names'//str(panel)
      parts = data//" using 1:2:3:4 with vectors nohead linewidth 0.8"//ink(on_guide)//" notitle, \"//nl// &
         '     '//data//' using ($5 > 0 ? NaN : $1 + $3):($2 + $4):6 with labels left offset 0.2, 0 notitle, \'//nl// &
         '     '//data//' using ($5 > 0 ? $1 + $3 : NaN):($2 + $4):6 with labels right offset -0.2, 0 notitle'
   end function names_plot

   !> Begins the drawing: format, size, title and subtitle.
   pure subroutine begin_panels(sheet)
      type(sheet_t), intent(inout) :: sheet
      character(:), allocatable :: heading, small

      call begin_formats(sheet%text, sheet%name, sheet%width, full_height(sheet), sheet%letters)
      heading = str(1.0_wp - 30.0_wp/full_height(sheet), 5)
      small = str(1.0_wp - 60.0_wp/full_height(sheet), 5)
      call sheet%text%line('set label 1 '//gnuplot_text(sheet%title)//' at screen 0.02, screen '//heading//heading_style(20))
      call sheet%text%line('set label 2 '//subtitle_of(sheet)//' at screen 0.02, screen '//small//subtitle_style())
      call sheet%text%line('set multiplot')
   end subroutine begin_panels

   !> The subtitle as a gnuplot expression. It is split into two lines if it would reach the scale of colours or the edge of the
   !> picture.
   pure function subtitle_of(sheet) result(expression)
      type(sheet_t), intent(in) :: sheet
      character(:), allocatable :: expression
      real(wp), parameter :: letter = 11.8_wp        ! width of a letter of size 14 in PNG, pixels
      integer :: most, at

      most = int(sheet%width*merge(0.7_wp, 0.96_wp, sheet%has_scale)/letter)
      at = 0
      if (len(sheet%subtitle) > most) at = index(sheet%subtitle(:most), '; ', back=.true.)
      expression = gnuplot_text(sheet%subtitle)
      if (at > 0) expression = gnuplot_text(sheet%subtitle(:at))//'."\n".'//gnuplot_text(sheet%subtitle(at + 2:))
   end function subtitle_of

   !> A label as a gnuplot expression. A label with more letters than `most` is split into two lines, at a blank or '_' near the
   !> middle.
   pure function two_lines(label, most) result(expression)
      character(*), intent(in) :: label
      integer, intent(in) :: most
      character(:), allocatable :: expression
      integer :: k, at

      expression = gnuplot_text(label)
      if (len(label) <= most) return
      at = 0
      do k = 2, len(label) - 1
         if (scan(label(k:k), '_ ') == 0) cycle
         if (at == 0 .or. abs(2*k - len(label)) < abs(2*at - len(label))) at = k
      end do
      if (at == 0) return
      expression = gnuplot_text(trim(label(:at)))//'."\n".'//gnuplot_text(label(at + 1:))
   end function two_lines

   !> Height of the complete picture [pixels].
   pure integer function full_height(sheet)
      type(sheet_t), intent(in) :: sheet
      full_height = title_height + sheet%height*((sheet%panels + sheet%columns - 1)/sheet%columns)
   end function full_height

   !> Begins a panel, and sets its title and axis labels. Panels are numbered row by row from the top.
   pure subroutine begin_panel(sheet, number, title, x_label, y_label, most)
      type(sheet_t), intent(inout) :: sheet
      integer, intent(in) :: number
      character(*), intent(in) :: title, x_label, y_label
      integer, intent(in), optional :: most       !! letters of the x label per line
      integer :: column, row
      real(wp) :: left, right, top, bottom, cell, high

      column = modulo(number - 1, sheet%columns)
      row = (number - 1)/sheet%columns
      cell = real(sheet%width, wp)/sheet%columns
      high = full_height(sheet)
      left = (column*cell + sheet%left)/sheet%width
      right = ((column + 1)*cell - sheet%right)/sheet%width
      top = 1.0_wp - (title_height + row*sheet%height + sheet%top)/high
      bottom = 1.0_wp - (title_height + (row + 1)*sheet%height - sheet%bottom)/high
      if (number == 2) call sheet%text%line('unset label 1; unset label 2; unset label 9')
      call sheet%text%line(nl//'set lmargin at screen '//str(left, 5)//'; set rmargin at screen '//str(right, 5)// &
         '; set bmargin at screen '//str(bottom, 5)//'; set tmargin at screen '//str(top, 5))
      call sheet%text%line('set title '//gnuplot_text(title)//' offset 0, -0.4'//heading_style(sheet%letters))
      if (present(most)) call sheet%text%line('set xlabel '//two_lines(x_label, most)//" offset 0, 0.3"//text_ink(on_label))
      if (.not. present(most)) call sheet%text%line('set xlabel '//gnuplot_text(x_label)//" offset 0, 0.3"//text_ink(on_label))
      call sheet%text%line('set ylabel '//gnuplot_text(y_label)//" offset 0.6, 0"//text_ink(on_label))
   end subroutine begin_panel

   !> The complete script. Its last commands are added to the sheet here.
   function end_panels(sheet) result(text)
      type(sheet_t), intent(inout) :: sheet
      character(:), allocatable :: text

      call sheet%text%line('unset multiplot'//nl//'unset label')
      call end_formats(sheet%text)
      text = sheet%text%text()
   end function end_panels

   !> Places the names of points one after the other, each as near to its point as possible. A name is to the right of its
   !> point, or to the left if it would cross the right edge of the panel. A name is moved up and down in small steps until it
   !> overlaps no other name and no point. If no trial position is free, the last one is used.
   pure subroutine place_labels(x, y, widths, height, places)
      real(wp), intent(in) :: x(:), y(:)          !! shares of the panel
      real(wp), intent(in) :: widths(:), height   !! size of the names, as shares of the panel
      type(label_place_t), intent(out) :: places(:)
      real(wp) :: boxes(4, size(x)), box(4), shift
      integer :: k, step

      do k = 1, size(x)
         places(k)%is_left = x(k) + gap + widths(k) > 1.0_wp
         places(k)%x = x(k) + merge(-gap, gap, places(k)%is_left)
         box(1) = places(k)%x - merge(widths(k), 0.0_wp, places(k)%is_left)
         box(2) = box(1) + widths(k)
         do step = 0, most_steps
            shift = 0.25_wp*height*((step + 1)/2)
            if (mod(step, 2) == 0) shift = -shift
            places(k)%y = min(max(y(k) + shift, 0.5_wp*height), 1.0_wp - 0.5_wp*height)
            box(3:4) = places(k)%y + [-0.5_wp, 0.5_wp]*height
            if (is_free(box, boxes(:, :k - 1))) exit
         end do
         boxes(:, k) = box
      end do

   contains

      !> Whether a box (left, right, bottom, top) overlaps no other box and no point.
      pure logical function is_free(box, others)
         real(wp), intent(in) :: box(4), others(:, :)
         integer :: j

         is_free = .true.
         do j = 1, size(others, 2)
            if (box(1) < others(2, j) .and. others(1, j) < box(2) .and. box(3) < others(4, j) .and. others(3, j) < box(4)) &
               is_free = .false.
         end do
         do j = 1, size(x)
            if (box(1) < x(j) + 0.01_wp .and. x(j) - 0.01_wp < box(2) .and. box(3) < y(j) .and. y(j) < box(4)) is_free = .false.
         end do
      end function is_free

   end subroutine place_labels

end module ek_study_sheet
