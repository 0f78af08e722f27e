!> A figure as a value: panels with axes, and series with roles in place of colours. ek_figure_script writes a figure as a gnuplot
!> script, ek_figure_data writes it as data from which the script of a page draws the same picture.
!>
!>     figure = new_figure('s_line', 'Responses over the factor', 's, 9 designs', 2)
!>     figure%panels(1)%x%label = 'rate'
!>     call add_series(figure%panels(1), as_line, on_level, reshape([x, y], [2, n], order=[2, 1]))
!>
!> The columns of the values of a series depend on its kind:
!>
!>     kind          columns
!>     as_line       x, y; of a line coloured by value also the value; in space x, y, z
!>     as_points     x, y
!>     as_both       x, y: a line with points
!>     as_band       x, low, high
!>     as_boxes      left, right, bottom, top: rectangles
!>     as_segments   x, y, dx, dy; in space x, y, z, dx, dy, dz
!>     as_errors     x, y, half-width of an interval of x
!>     as_labels     x, y; one label for each row
!>     as_heat       x, y, value on a grid; a gap after each value of x
!>
!> A row of NaN is a gap in a line.
module ek_figure
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   implicit none(type, external)
   private
   public :: figure_t, panel_t, axis_t, series_t, new_figure, add_series, add_source, add_label, add_point_names
   public :: label_place_t, place_labels, drawn_range
   public :: as_line, as_points, as_both, as_band, as_boxes, as_segments, as_errors, as_labels, as_heat, kinds, gap_row, &
      full_height, title_height, has_values, centred, at_left, at_right, columns_of, fold_at

   integer, parameter :: as_line = 1, as_points = 2, as_both = 3, as_band = 4, as_boxes = 5, as_segments = 6, as_errors = 7, &
      as_labels = 8, as_heat = 9
   character(8), parameter :: kinds(9) = [character(8) :: 'line', 'points', 'both', 'band', 'boxes', 'segments', 'errors', &
      'labels', 'heat']
   integer, parameter :: centred = 0, at_left = 1, at_right = 2     !! a label is centred on, begins at, ends at its point
   integer, parameter :: title_height = 88            !! height above the panels [pixels]
   real(wp), parameter :: gap = 0.02_wp               !! distance between a point and its name, as a share of the panel's width
   integer, parameter :: most_steps = 80              !! number of trial shifts of a name; the step is a quarter of its height

   !> One axis of a panel.
   type :: axis_t
      character(:), allocatable :: label
      logical :: has_range = .false.
      real(wp) :: range(2) = 0.0_wp                   !! from left to right or upward, if has_range
      character(:), allocatable :: free_range         !! range of gnuplot with a least span; not allocated: all values
      logical :: is_log = .false.
      character(:), allocatable :: tics               !! distance or list of tics for gnuplot; not allocated: chosen by it
      type(message_list_t) :: names                   !! names at 1, 2, … in place of numbers
      logical :: has_tics = .true., has_grid = .true., has_zero = .true.     !! tics; lines at the tics; line at 0
   end type axis_t

   !> One series of a panel.
   type :: series_t
      integer :: kind = as_line
      integer :: role = 1                             !! what its colour stands for (ek_gnuplot)
      real(wp), allocatable :: values(:, :)           !! (column, row)
      character(:), allocatable :: source             !! in place of values: gnuplot's file, rows, columns and style
      real(wp) :: weight = 2.0_wp                     !! width of a line or size of a point
      logical :: is_dashed = .false.
      logical :: is_by_value = .false.                !! the colour of a line is that of its last column
      character(:), allocatable :: title              !! entry of the legend, which the first panel has; not allocated: none
      type(message_list_t) :: labels
      integer :: align = centred
      real(wp) :: offset(2) = 0.0_wp                  !! of labels from their points, in letters to the right and upward
      logical :: is_small = .false.                   !! labels have a smaller font
   end type series_t

   type :: panel_t
      character(:), allocatable :: title
      type(axis_t) :: x, y, z, value                  !! value: scale of the colours by value
      type(series_t), allocatable :: series(:)
      integer :: frame = 3                            !! sides with a line: 1 below, 2 at the left, 3 both
      logical :: has_scale = .false.                  !! a scale of its own colours, at its right
      logical :: is_space = .false.                   !! in space, in a box with equal scales
      real(wp) :: turn = 0.0_wp, tilt = 68.0_wp       !! direction of view in space [deg], as of `set view` of gnuplot
      character(:), allocatable :: note               !! shown if no series has a value
      integer :: folds_after = 0                      !! letters of the x label per line; 0: one line
   end type panel_t

   type :: figure_t
      character(:), allocatable :: name, title, subtitle
      type(panel_t), allocatable :: panels(:)         !! row by row from the top
      integer :: columns = 1
      integer :: width = 1200                         !! width of the picture [pixels]
      integer :: height = 420                         !! height of a row of panels [pixels]
      integer :: left = 110, right = 30, bottom = 80, top = 34      !! margins of a panel [pixels]
      integer :: letters = 15                         !! size of the font
      integer :: key_width = 0                        !! width of a legend at the right of the panels [pixels]; 0: above them
      logical :: has_heads = .false.                  !! files of the sources have column headings
      character(1) :: separator = ' '                 !! of the columns of data, as in the files of its sources
      character(:), allocatable :: scale_label        !! label of one scale for the colours of all panels; not allocated: none
   end type figure_t

   !> The position at which the name of a point begins, as shares of the panel's width and height. With is_left, the name is
   !> to the left of the point and ends at this position.
   type :: label_place_t
      real(wp) :: x = 0.0_wp, y = 0.0_wp
      logical :: is_left = .false.
   end type label_place_t

contains

   !> A figure with a number of panels without series, in one, two or three columns.
   pure type(figure_t) function new_figure(name, title, subtitle, panels, height) result(figure)
      character(*), intent(in) :: name, title, subtitle
      integer, intent(in) :: panels
      integer, intent(in), optional :: height         !! height of a row of panels [pixels]; chosen here if absent
      integer :: k

      figure%name = name
      figure%title = title
      figure%subtitle = subtitle
      allocate (figure%panels(max(1, panels)))
      do k = 1, size(figure%panels)
         associate (panel => figure%panels(k))
            panel%title = ''
            panel%note = ''
            panel%x%label = ''
            panel%y%label = ''
            panel%z%label = ''
            panel%value%label = ''
            allocate (panel%series(0))
         end associate
      end do
      figure%columns = merge(3, merge(2, 1, panels > 1), panels > 4)
      figure%height = merge(370, merge(490, 640, panels > 1), panels > 4)
      if (present(height)) figure%height = height
      if (panels > 4) figure%letters = 13
   end function new_figure

   !> Appends a series to a panel.
   pure subroutine add_series(panel, kind, role, values, weight, is_dashed, is_by_value, title)
      type(panel_t), intent(inout) :: panel
      integer, intent(in) :: kind, role
      real(wp), intent(in) :: values(:, :)            !! (column, row)
      real(wp), intent(in), optional :: weight
      logical, intent(in), optional :: is_dashed, is_by_value
      character(*), intent(in), optional :: title
      type(series_t) :: series

      series%kind = kind
      series%role = role
      allocate (series%values, source=values)
      if (present(weight)) series%weight = weight
      if (present(is_dashed)) series%is_dashed = is_dashed
      if (present(is_by_value)) series%is_by_value = is_by_value
      if (present(title)) series%title = title
      call append(panel, series)
   end subroutine add_series

   !> Appends a series that gnuplot reads from a file or computes.
   pure subroutine add_source(panel, source, title)
      type(panel_t), intent(inout) :: panel
      character(*), intent(in) :: source              !! element of a plot command
      character(*), intent(in), optional :: title
      type(series_t) :: series

      series%source = source
      allocate (series%values(0, 0))
      if (present(title)) series%title = title
      call append(panel, series)
   end subroutine add_source

   !> Appends a series to a panel, by copies that keep the other series.
   pure subroutine append(panel, series)
      type(panel_t), intent(inout) :: panel
      type(series_t), intent(in) :: series
      type(series_t), allocatable :: grown(:)
      integer :: n

      n = size(panel%series)
      allocate (grown(n + 1))
      grown(:n) = panel%series
      grown(n + 1) = series
      call move_alloc(grown, panel%series)
   end subroutine append

   !> Adds a label at a point of a panel. Labels of the same role, alignment, offset and size are one series.
   pure subroutine add_label(panel, label, x, y, role, align, offset, is_small)
      type(panel_t), intent(inout) :: panel
      character(*), intent(in) :: label
      real(wp), intent(in) :: x, y
      integer, intent(in) :: role
      integer, intent(in), optional :: align
      real(wp), intent(in), optional :: offset(2)
      logical, intent(in), optional :: is_small
      type(series_t) :: look
      real(wp), allocatable :: values(:, :)
      integer :: n

      look%kind = as_labels
      look%role = role
      if (present(align)) look%align = align
      if (present(offset)) look%offset = offset
      if (present(is_small)) look%is_small = is_small
      n = size(panel%series)
      do n = size(panel%series), 1, -1
         associate (last => panel%series(n))
            if (last%kind == as_labels .and. last%role == role .and. last%align == look%align .and. &
               all(abs(last%offset - look%offset) < 1.0e-9_wp) .and. (last%is_small .eqv. look%is_small)) exit
         end associate
      end do
      if (n == 0) then
         allocate (look%values(2, 0))
         call append(panel, look)
         n = size(panel%series)
      end if
      associate (last => panel%series(n))
         allocate (values(2, size(last%values, 2) + 1))
         values(:, :size(last%values, 2)) = last%values
         values(:, size(last%values, 2) + 1) = [x, y]
         call move_alloc(values, last%values)
         call last%labels%add(label)
      end associate
   end subroutine add_label

   !> Values that were given as columns, as (column, row).
   pure function columns_of(a, b, c, d) result(values)
      real(wp), intent(in) :: a(:), b(:)
      real(wp), intent(in), optional :: c(:), d(:)
      real(wp), allocatable :: values(:, :)
      integer :: n

      n = 2 + count([present(c), present(d)])
      allocate (values(n, size(a)))
      values(1, :) = a
      values(2, :) = b
      if (present(c)) values(3, :) = c
      if (present(d)) values(4, :) = d
   end function columns_of

   !> Whether a row of values is a gap.
   pure logical function gap_row(values)
      real(wp), intent(in) :: values(:)
      gap_row = .not. any(ieee_is_finite(values))
   end function gap_row

   !> Whether a series has a point that can be drawn.
   pure logical function has_values(series)
      type(series_t), intent(in) :: series
      integer :: k

      has_values = allocated(series%source)
      if (has_values) return
      do k = 1, size(series%values, 2)
         if (all(ieee_is_finite(series%values(:2, k)))) has_values = .true.
      end do
   end function has_values

   !> Where a label with more letters than `most` is split into two lines: after the blank or '_' next to its middle. 0 if it is
   !> not split.
   pure integer function fold_at(label, most) result(at)
      character(*), intent(in) :: label
      integer, intent(in) :: most
      integer :: k

      at = 0
      if (len(label) <= most) return
      do k = 2, len(label) - 1
         if (scan(label(k:k), '_ ') == 0) cycle
         if (at == 0 .or. abs(2*k - len(label)) < abs(2*at - len(label))) at = k
      end do
   end function fold_at

   !> Height of the complete picture [pixels].
   pure integer function full_height(figure)
      type(figure_t), intent(in) :: figure
      full_height = title_height + figure%height*((size(figure%panels) + figure%columns - 1)/figure%columns)
   end function full_height

   !> The range of an axis as it is drawn. Ends that differ by rounding only, as of a constant result, are moved apart, because
   !> gnuplot draws nothing in an empty range.
   pure function drawn_range(axis) result(range)
      type(axis_t), intent(in) :: axis               !! has_range
      real(wp) :: range(2)
      real(wp), parameter :: least = 1.0e-7_wp       ! width, as a share of the ends
      real(wp) :: size_of_ends

      range = axis%range
      size_of_ends = maxval(abs(range))
      if (abs(range(2) - range(1)) > least*size_of_ends) return
      range = range + max(1.0e-6_wp, 0.1_wp*size_of_ends)*[-1, 1]
   end function drawn_range

   !> Adds the names of the first points of a panel, with lines from the points to their names. If there is enough room, names
   !> do not overlap other names or points. The panel must have its ranges.
   subroutine add_point_names(figure, number, names, x, y, leader, role)
      type(figure_t), intent(inout) :: figure
      integer, intent(in) :: number                  !! index of the panel
      character(*), intent(in) :: names(:)           !! names of the first points
      real(wp), intent(in) :: x(:), y(:)             !! coordinates of all points
      integer, intent(in) :: leader, role            !! roles of the lines and of the names
      type(label_place_t) :: places(size(names))
      real(wp), parameter :: size_in_png = 4.0_wp/3.0_wp     ! pixels per point of a font; 1 in SVG
      real(wp) :: widths(size(names)), lines(4, size(names)), letters, cell, to(2)
      integer :: k, n

      n = size(names)
      letters = size_in_png*figure%letters
      cell = real(figure%width, wp)/figure%columns - figure%left - figure%right
      do k = 1, n
         widths(k) = 0.64_wp*letters*len_trim(names(k))/cell
      end do
      associate (panel => figure%panels(number))
         associate (across => panel%x%range, upward => panel%y%range)
            call place_labels((x(:n) - across(1))/(across(2) - across(1)), (y(:n) - upward(1))/(upward(2) - upward(1)), widths, &
               1.2_wp*letters/(figure%height - figure%top - figure%bottom), places)
            do k = 1, n
               to = [across(1) + places(k)%x*(across(2) - across(1)), upward(1) + places(k)%y*(upward(2) - upward(1))]
               lines(:, k) = [x(k), y(k), to(1) - x(k), to(2) - y(k)]
            end do
         end associate
         call add_series(panel, as_segments, leader, lines, weight=0.8_wp)
         do k = 1, n
            call add_label(panel, trim(names(k)), lines(1, k) + lines(3, k), lines(2, k) + lines(4, k), role, &
               align=merge(at_right, at_left, places(k)%is_left), offset=[merge(-0.2_wp, 0.2_wp, places(k)%is_left), 0.0_wp])
         end do
      end associate
   end subroutine add_point_names

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

end module ek_figure
