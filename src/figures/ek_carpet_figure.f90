!> Carpet plot over a grid of two factors: the points of the grid are joined by lines on which one of the factors is constant.
!> The ordinate is a response. The abscissa is the level of the first factor, shifted with the level of the second. At any
!> value of the response, the figure shows the pairs of factors that give this value. The type carpet_t contains only numbers
!> and labels. A study creates a carpet from a grid of designs, a report from a test over travel and steering.
module ek_carpet_figure
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_study_data, only: study_data_t, is_geometric, range_of_values
   use ek_gnuplot, only: ink, text_ink, on_level, on_derivative
   use ek_study_sheet, only: sheet_t, new_sheet, begin_data, add_numbers, end_data, begin_panels, begin_panel, end_panels
   implicit none(type, external)
   private
   public :: carpet_t, new_carpet, carpet_script, study_carpet, is_drawn, on_equal

   character(*), parameter :: nl = new_line('a')
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

   !> The gnuplot script of a carpet, with one panel for each response.
   function carpet_script(carpet, name, title, subtitle) result(text)
      type(carpet_t), intent(in) :: carpet
      character(*), intent(in) :: name, title, subtitle
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      integer :: r, f

      sheet = new_sheet(name, title, subtitle//'; blue: lines of equal '//carpet%factors%line(1)// &
         ', orange: of equal '//carpet%factors%line(2), size(carpet%value, 3))
      sheet%bottom = 40
      if (sheet%panels == 1) sheet%width = 900
      do r = 1, sheet%panels
         do f = 1, 2
            call add_lines(carpet, f, r, sheet)
            call add_ends(carpet, f, r, sheet)
         end do
      end do
      call begin_panels(sheet)
      call sheet%text%line('unset xtics; unset xzeroaxis; unset yzeroaxis; set border 2; set grid noxtics')
      call sheet%text%line('set offsets graph 0.16, graph 0.14, graph 0.1, graph 0.1')
      do r = 1, sheet%panels
         call begin_panel(sheet, r, '', '', carpet%responses%line(r))
         text = 'plot '
         do f = 1, 2
            if (f == 2) text = text//', \'//nl//'     '
            text = text//'$equal'//str(f)//'_'//str(r)//' using 1:2 with lines linewidth 2'//ink(on_equal(f))//' notitle'// &
               labels(1)//labels(-1)
            if (f == 2) text = text//labels(2)//labels(-2)
         end do
         call sheet%text%line(text)
      end do
      call sheet%text%line('set xtics; set border 3; set offsets 0, 0, 0, 0')
      text = end_panels(sheet)

   contains

      !> A part of a plot command: it draws the values at those ends of the lines that have this side (see add_ends), outside
      !> the carpet.
      function labels(side) result(words)
         integer, intent(in) :: side
         character(:), allocatable :: words

         words = trim(merge('right offset -0.7,', 'left offset 0.7,  ', is_at_begin(carpet, f, r)))//' '// &
            str(sign(0.45_wp, real(side, wp)))
         if (abs(side) == 2) words = 'center offset 0, '//str(sign(1.5_wp, real(side, wp)))
         words = ', \'//nl//'     $ends'//str(f)//'_'//str(r)//' using ($3 == '//str(side)// &
            ' ? $1 : NaN):2:4 with labels '//words//" font ',12'"//text_ink(on_equal(f))//' notitle'
      end function labels

   end function carpet_script

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
   subroutine add_lines(carpet, f, r, sheet)
      type(carpet_t), intent(in) :: carpet
      integer, intent(in) :: f, r
      type(sheet_t), intent(inout) :: sheet
      integer :: i, j

      call begin_data(sheet, 'equal'//str(f)//'_'//str(r))
      do i = 1, carpet%levels(f)
         if (.not. is_drawn(i, carpet%levels(f))) cycle
         do j = 1, carpet%levels(3 - f)
            if (f == 1) call add_numbers(sheet, point_of(carpet, i, j, r))
            if (f == 2) call add_numbers(sheet, point_of(carpet, j, i, r))
         end do
         call sheet%text%line('')
      end do
      call end_data(sheet)
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

   !> Adds the values of factor f at the ends of its lines, and the side: 1 for above, −1 for below, away from the mean of the line.
   !> At the corner of the carpet where the values of both factors meet, the side for factor 2 is 2 or −2: further above or below.
   subroutine add_ends(carpet, f, r, sheet)
      type(carpet_t), intent(in) :: carpet
      integer, intent(in) :: f, r
      type(sheet_t), intent(inout) :: sheet
      real(wp) :: at(2), side, line(carpet%levels(3 - f))
      integer :: i, end, corner

      end = merge(1, carpet%levels(3 - f), is_at_begin(carpet, f, r))
      corner = 0
      if (f == 2) corner = merge(1, carpet%levels(2), is_at_begin(carpet, 1, r))
      call begin_data(sheet, 'ends'//str(f)//'_'//str(r))
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
         if (i == corner) side = 2.0_wp*side
         call add_numbers(sheet, [at, side], short(carpet%level(i, f)))
      end do
      call end_data(sheet)
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
