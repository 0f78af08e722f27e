!> A figure: panels with axes, and curves of the columns of result files in them.
!>
!> ek_gnuplot writes it as a script and draws it.
module ek_figure
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: figure_t, panel_t, curve_t, new_panel, new_curve, new_figure, add_curve, add_panel

   !> One line or row of marks in a panel.
   type :: curve_t
      character(:), allocatable :: file      !! data file, relative to the script
      !> A column name, or a gnuplot expression in parentheses: `(abs(column("toe_deg")))`
      character(:), allocatable :: x, y
      character(:), allocatable :: title     !! in the legend; '': not in the legend
      character(:), allocatable :: style     !! 'line', 'dashed', 'points' or 'mark' (one special state)
      integer :: colour = 0                  !! index in the palette; 0: by order
   end type curve_t

   !> A pair of axes.
   type :: panel_t
      character(:), allocatable :: title, x_label, y_label
      type(curve_t), allocatable :: curves(:)
      logical :: log_x = .false., log_y = .false.
      logical :: swap = .false.              !! x upward, y to the right, as usual for wheel travel
      real(wp), allocatable :: least_y(:)    !! [low, high] always shown, so that noise is not magnified
   end type panel_t

   !> One script: a panel, or several in two columns.
   type :: figure_t
      character(:), allocatable :: name      !! name of the files, without extension
      character(:), allocatable :: title, subtitle
      type(panel_t), allocatable :: panels(:)
   end type figure_t

contains

   !> A pair of axes without curves.
   pure type(panel_t) function new_panel(title, x_label, y_label) result(panel)
      character(*), intent(in) :: title, x_label, y_label

      panel%title = title
      panel%x_label = x_label
      panel%y_label = y_label
      allocate (panel%curves(0))
   end function new_panel

   !> A curve of y over x.
   pure type(curve_t) function new_curve(file, x, y, title, style, colour) result(curve)
      character(*), intent(in) :: file, x, y
      character(*), intent(in), optional :: title    !! none: not in the legend
      character(*), intent(in), optional :: style    !! none: 'line'
      integer, intent(in), optional :: colour

      curve%file = file
      curve%x = x
      curve%y = y
      curve%title = ''
      if (present(title)) curve%title = title
      curve%style = 'line'
      if (present(style)) curve%style = style
      if (present(colour)) curve%colour = colour
   end function new_curve

   !> A figure without panels.
   pure type(figure_t) function new_figure(name, title, subtitle) result(figure)
      character(*), intent(in) :: name, title
      character(*), intent(in), optional :: subtitle

      figure%name = name
      figure%title = title
      figure%subtitle = ''
      if (present(subtitle)) figure%subtitle = subtitle
      allocate (figure%panels(0))
   end function new_figure

   !> Appends a curve; the first ones are drawn below the later ones.
   pure subroutine add_curve(panel, curve)
      type(panel_t), intent(inout) :: panel
      type(curve_t), intent(in) :: curve
      type(curve_t), allocatable :: grown(:)
      integer :: n

      n = size(panel%curves)
      allocate (grown(n + 1))
      grown(:n) = panel%curves
      grown(n + 1) = curve
      call move_alloc(grown, panel%curves)
   end subroutine add_curve

   !> Appends a pair of axes.
   pure subroutine add_panel(figure, panel)
      type(figure_t), intent(inout) :: figure
      type(panel_t), intent(in) :: panel
      type(panel_t), allocatable :: grown(:)
      integer :: n

      n = size(figure%panels)
      allocate (grown(n + 1))
      grown(:n) = figure%panels
      grown(n + 1) = panel
      call move_alloc(grown, figure%panels)
   end subroutine add_panel

end module ek_figure
