!> Carpet plot over a grid of two factors: the points of the grid are joined by lines on which one of the factors is constant.
!> The ordinate is a response. The abscissa is the level of the first factor, shifted with the level of the second. At any
!> value of the response, the figure shows the pairs of factors that give this value. The type carpet_t contains only numbers
!> and labels. A study creates a carpet from a grid of designs, a report from a test over travel and steering.
module ek_carpet_figure
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_study_data, only: study_data_t, is_geometric, range_of_values
   use ek_gnuplot, only: on_level, on_derivative
   use ek_figure, only: figure_t, panel_t, new_figure, add_series, add_label, as_line, centred, at_left, at_right
   implicit none(type, external)
   private
   public :: carpet_t, new_carpet, carpet_figure, study_carpet, is_drawn, on_equal

   integer, parameter :: most_lines = 7           !! largest number of lines per factor; with more levels, only some are drawn
   real(wp), parameter :: shift = 0.8_wp          !! shift of the abscissa over the levels of factor 2, per range of factor 1
   !> Roles of the lines of equal factor 1 and of equal factor 2.
   integer, parameter :: on_equal(2) = [on_level, on_derivative]

   !> A grid of two factors, in the order of their levels, and the responses at its points.
   type :: carpet_t
      integer :: levels(2) = 0
      type(message_list_t) :: factors                !! labels of the two factors
      type(message_list_t) :: responses              !! labels of the responses
      real(wp), allocatable :: level(:, :)           !! value of a level in ascending order; (level, factor)
      real(wp), allocatable :: place(:, :)           !! position of a level, from 0 to 1; (level, factor)
      real(wp), allocatable :: value(:, :, :)        !! responses; (level of factor 1, level of factor 2, response); NaN: no value
   end type carpet_t

contains

   !> A carpet with levels and their positions. It has no labels, and all values are 0.
   pure type(carpet_t) function new_carpet(first, second, responses, is_log) result(carpet)
      real(wp), intent(in) :: first(:), second(:)    !! levels of the factors, ascending
      integer, intent(in) :: responses
      logical, intent(in) :: is_log(2)               !! the levels of a factor are in equal ratios

      carpet%levels = [size(first), size(second)]
      allocate (carpet%level(maxval(carpet%levels), 2), source=0.0_wp)
      allocate (carpet%place(maxval(carpet%levels), 2), source=0.0_wp)
      carpet%level(:size(first), 1) = first
      carpet%level(:size(second), 2) = second
      carpet%place(:size(first), 1) = places(first, is_log(1))
      carpet%place(:size(second), 2) = places(second, is_log(2))
      allocate (carpet%value(size(first), size(second), responses), source=0.0_wp)
   end function new_carpet

   !> Positions of the levels of a factor, from 0 to 1. Distances are proportional to differences of the levels, or of their
   !> logarithms if is_log.
   pure function places(levels, is_log)
      real(wp), intent(in) :: levels(:)
      logical, intent(in) :: is_log
      real(wp) :: places(size(levels))

      places = levels
      if (is_log) places = log(levels)
      places = (places - places(1))/max(places(size(levels)) - places(1), tiny(1.0_wp))
   end function places

   !> A carpet, with one panel for each response.
   function carpet_figure(carpet, name, title, subtitle) result(figure)
      type(carpet_t), intent(in) :: carpet
      character(*), intent(in) :: name, title, subtitle
      type(figure_t) :: figure
      integer :: r, f

      figure = new_figure(name, title, subtitle//'; blue: lines of equal '//carpet%factors%line(1)// &
         ', orange: of equal '//carpet%factors%line(2), size(carpet%value, 3))
      figure%bottom = 40
      if (size(figure%panels) == 1) figure%width = 900
      do r = 1, size(figure%panels)
         associate (panel => figure%panels(r))
            panel%y%label = carpet%responses%line(r)
            panel%frame = 2
            panel%x%has_tics = .false.
            panel%x%has_grid = .false.
            panel%x%has_zero = .false.
            panel%y%has_zero = .false.
            panel%note = 'no design has a value'
            call set_room(carpet, r, panel)
         end associate
         do f = 1, 2
            call add_lines(carpet, f, r, figure%panels(r))
         end do
         do f = 1, 2
            call add_ends(carpet, f, r, figure%panels(r))
         end do
      end do
   end function carpet_figure

   !> Sets the ranges of a panel, with room for the values at the ends of the lines.
   pure subroutine set_room(carpet, r, panel)
      type(carpet_t), intent(in) :: carpet
      integer, intent(in) :: r
      type(panel_t), intent(inout) :: panel
      real(wp) :: range(2), span

      panel%x%has_range = .true.
      panel%x%range = [0.0_wp, 1.0_wp + shift] + (1.0_wp + shift)*[-0.22_wp, 0.2_wp]
      range = range_of_values(reshape(carpet%value(:, :, r), [size(carpet%value(:, :, r))]))
      span = range(2) - range(1)
      if (.not. span > 0.0_wp) span = max(1.0e-6_wp, abs(range(1)))
      panel%y%has_range = .true.
      panel%y%range = range + 0.12_wp*span*[-1, 1]
   end subroutine set_room

   !> The carpet of a study over a grid of two factors. The designs of the study have the last factor varying fastest.
   type(carpet_t) function study_carpet(study, panels) result(carpet)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the responses
      integer, allocatable :: order(:), other(:)
      integer :: n(2), f, i, j, k, r

      n(2) = 1
      do k = 2, study%designs
         if (abs(study%x(1, k) - study%x(1, 1)) > 0.0_wp) exit
         n(2) = k
      end do
      n(1) = study%designs/n(2)
      allocate (other, source=ascending(study%x(1, 1:n(1)*n(2):n(2))))
      allocate (order, source=ascending(study%x(2, :n(2))))
      carpet = new_carpet(study%x(1, (other - 1)*n(2) + 1), study%x(2, order), size(panels), &
         [is_geometric(study%x(1, :)), is_geometric(study%x(2, :))])
      do f = 1, 2
         call carpet%factors%add(study%factors(f)%label)
      end do
      do r = 1, size(carpet%value, 3)
         call carpet%responses%add(study%responses(panels(r))%label)
         do j = 1, n(2)
            do i = 1, n(1)
               carpet%value(i, j, r) = study%y(panels(r), (other(i) - 1)*n(2) + order(j))
            end do
         end do
      end do
   end function study_carpet

   !> The indices of values in ascending order.
   pure function ascending(values) result(order)
      real(wp), intent(in) :: values(:)
      integer :: order(size(values))
      logical :: is_left(size(values))
      integer :: k

      is_left = .true.
      do k = 1, size(values)
         order(k) = minloc(values, dim=1, mask=is_left)
         is_left(order(k)) = .false.
      end do
   end function ascending

   !> Whether the line of a level is drawn: the first level, the last level, and some levels between them.
   pure logical function is_drawn(level, levels)
      integer, intent(in) :: level, levels
      integer :: step

      do step = max(1, ceiling((levels - 1.0_wp)/(most_lines - 1))), levels - 1
         if (mod(levels - 1, step) == 0 .and. (levels - 1)/step > 2) exit          ! equal steps, to the last level
      end do
      if (step >= levels - 1) step = max(1, ceiling((levels - 1.0_wp)/(most_lines - 1)))
      is_drawn = mod(level - 1, step) == 0 .or. level == levels
   end function is_drawn

   !> Abscissa and response at one pair of levels.
   pure function point_of(carpet, i, j, r) result(point)
      type(carpet_t), intent(in) :: carpet
      integer, intent(in) :: i, j, r                 !! levels of factors 1 and 2; response
      real(wp) :: point(2)

      point = [carpet%place(i, 1) + shift*carpet%place(j, 2), carpet%value(i, j, r)]
   end function point_of

   !> Adds the lines on which factor f is constant.
   subroutine add_lines(carpet, f, r, panel)
      type(carpet_t), intent(in) :: carpet
      integer, intent(in) :: f, r
      type(panel_t), intent(inout) :: panel
      real(wp), allocatable :: values(:, :)
      integer :: i, j, rows

      allocate (values(2, carpet%levels(f)*(carpet%levels(3 - f) + 1)))
      rows = 0
      do i = 1, carpet%levels(f)
         if (.not. is_drawn(i, carpet%levels(f))) cycle
         do j = 1, carpet%levels(3 - f)
            rows = rows + 1
            if (f == 1) values(:, rows) = point_of(carpet, i, j, r)
            if (f == 2) values(:, rows) = point_of(carpet, j, i, r)
         end do
         rows = rows + 1
         values(:, rows) = ieee_value(1.0_wp, ieee_quiet_nan)
      end do
      call add_series(panel, as_line, on_equal(f), values(:, :rows))
   end subroutine add_lines

   !> Whether the lines of equal factor f show their values at the smallest value of the other factor. The values are on the edge of
   !> the carpet along which the response changes most, so that the values do not overlap.
   pure logical function is_at_begin(carpet, f, r)
      type(carpet_t), intent(in) :: carpet
      integer, intent(in) :: f, r
      real(wp) :: first(2), last(2)

      if (f == 1) then
         first = range_of_values(carpet%value(:, 1, r))
         last = range_of_values(carpet%value(:, carpet%levels(2), r))
      else
         first = range_of_values(carpet%value(1, :, r))
         last = range_of_values(carpet%value(carpet%levels(1), :, r))
      end if
      is_at_begin = first(2) - first(1) > last(2) - last(1)
   end function is_at_begin

   !> Adds the values of factor f at the ends of its lines, outside the carpet: above or below, away from the mean of the line. At
   !> the corner of the carpet where the values of both factors meet, the value of factor 2 is further above or below.
   subroutine add_ends(carpet, f, r, panel)
      type(carpet_t), intent(in) :: carpet
      integer, intent(in) :: f, r
      type(panel_t), intent(inout) :: panel
      real(wp) :: at(2), side, line(carpet%levels(3 - f))
      integer :: i, end, corner

      end = merge(1, carpet%levels(3 - f), is_at_begin(carpet, f, r))
      corner = 0
      if (f == 2) corner = merge(1, carpet%levels(2), is_at_begin(carpet, 1, r))
      do i = 1, carpet%levels(f)
         if (.not. is_drawn(i, carpet%levels(f))) cycle
         if (f == 1) then
            at = point_of(carpet, i, end, r)
            line = carpet%value(i, :, r)
         else
            at = point_of(carpet, end, i, r)
            line = carpet%value(:, i, r)
         end if
         if (.not. ieee_is_finite(at(2))) cycle
         side = merge(1.0_wp, -1.0_wp, at(2) > sum(line, mask=ieee_is_finite(line))/count(ieee_is_finite(line)))
         if (i == corner) then
            call add_label(panel, short(carpet%level(i, f)), at(1), at(2), on_equal(f), align=centred, &
               offset=[0.0_wp, 1.5_wp*side], is_small=.true.)
         else if (is_at_begin(carpet, f, r)) then
            call add_label(panel, short(carpet%level(i, f)), at(1), at(2), on_equal(f), align=at_right, &
               offset=[-0.7_wp, 0.45_wp*side], is_small=.true.)
         else
            call add_label(panel, short(carpet%level(i, f)), at(1), at(2), on_equal(f), align=at_left, &
               offset=[0.7_wp, 0.45_wp*side], is_small=.true.)
         end if
      end do
   end subroutine add_ends

   !> A value rounded to four significant digits, such as 0.125. From 10000 to 1e8, it is printed without an exponent: 10080.
   function short(value) result(text)
      real(wp), intent(in) :: value
      character(:), allocatable :: text
      real(wp) :: unit

      text = str(value, 4)
      if (abs(value) < 1.0e4_wp .or. abs(value) >= 1.0e8_wp) return
      unit = 10.0_wp**(floor(log10(abs(value))) - 3)
      text = str(nint(nint(value/unit)*unit))
   end function short

end module ek_carpet_figure
