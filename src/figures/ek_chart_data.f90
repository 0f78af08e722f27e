!> A chart as data: its curves, titles and limits.
module ek_chart_data
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: chart_t, trace_t, new_chart, add_trace, append_chart

   !> One curve of a chart.
   type :: trace_t
      character(:), allocatable :: title
      !> Columns of the abscissa and of the values in the table, or an expression of columns in parentheses:
      !> `(abs(column("toe_deg")))`
      character(:), allocatable :: over, column
      real(wp), allocatable :: x(:), y(:)
      real(wp), allocatable :: mark(:)       !! [x, y] of the ring at the design state; not allocated: no ring
      integer :: colour = 1                  !! index in the palette
      integer :: dash = 0                    !! 0 solid, 1 dashed, 2 dotted, 3 dash-dotted
      integer :: design = 0                  !! row of the design state if it differs from the row of the test; 0: row of the test
      logical, allocatable :: in_contact(:)  !! states at which a stop is in contact; not allocated: no stop, or not shown
      integer :: reference = 0               !! index of the curve in the chart with which this curve is compared; 0: none
   end type trace_t

   type :: chart_t
      integer :: test = 0                    !! index of the test of the chart
      character(:), allocatable :: name      !! name of the SVG file, without suffix
      character(:), allocatable :: title     !! name of the quantity
      character(:), allocatable :: y_label   !! unit and sign of the quantity
      character(:), allocatable :: x_label
      type(trace_t), allocatable :: traces(:)
      logical :: has_key = .false.           !! the curves are named in the chart
      logical :: has_points = .false.        !! the states are independent: points without a line
      logical :: is_fixed = .false.          !! the axis ends at `fixed`
      real(wp) :: fixed(2) = 0.0_wp
      logical :: is_level = .false.          !! constant to the printed digits: a row of a table, not drawn
      real(wp) :: noise = 0.0_wp             !! least span of the y axis; curves with a smaller span look flat
      real(wp) :: cap = 0.0_wp               !! limit of the axis on both sides of 0; 0: no limit
   end type chart_t

contains

   !> A chart without curves.
   pure type(chart_t) function new_chart(name, title, y_label, x_label) result(chart)
      character(*), intent(in) :: name, title, y_label, x_label

      chart%name = name
      chart%title = title
      chart%y_label = y_label
      chart%x_label = x_label
      allocate (chart%traces(0))
   end function new_chart

   !> Appends a curve to a chart.
   pure subroutine add_trace(chart, trace)
      type(chart_t), intent(inout) :: chart
      type(trace_t), intent(in) :: trace
      chart%traces = [chart%traces, trace]
   end subroutine add_trace

   !> Appends a chart to a list of which the first `used` entries are in use. The storage doubles when it is full.
   pure subroutine append_chart(charts, used, chart)
      type(chart_t), allocatable, intent(inout) :: charts(:)
      integer, intent(inout) :: used
      type(chart_t), intent(in) :: chart
      type(chart_t), allocatable :: grown(:)

      if (used == size(charts)) then
         allocate (grown(2*used + 16))
         grown(:used) = charts
         call move_alloc(grown, charts)
      end if
      used = used + 1
      charts(used) = chart
   end subroutine append_chart

end module ek_chart_data
