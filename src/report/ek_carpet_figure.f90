!> Carpet plot of a grid of two factors: each response over an abscissa that is shifted with the second factor, as lines on which one
!> of the factors is constant. Both factors can be read off it at any response, and the response with the accuracy of an axis.
module ek_carpet_figure
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_study_data, only: study_data_t, most_panels, is_geometric, range_of_values
   use ek_study_sheet, only: sheet_t, new_sheet, begin_data, add_numbers, end_data, begin_panels, begin_panel, end_panels
   implicit none(type, external)
   private
   public :: carpet_script

   character(*), parameter :: nl = new_line('a')
   integer, parameter :: most_lines = 7           !! of either factor; of more levels some are drawn
   real(wp), parameter :: shift = 0.8_wp          !! of the abscissa from the first to the last level of factor 2, per width
   character(*), parameter :: colours(2) = ["rgb '#0072B2'", "rgb '#D55E00'"]

   !> The grid: levels in ascending order, and the design at each pair.
   type :: carpet_t
      integer, allocatable :: design(:, :)           !! (level of factor 1, of factor 2)
      real(wp), allocatable :: place(:, :)           !! of a level from 0 to 1; (level, factor)
      integer :: levels(2) = 0
   end type carpet_t

contains

   !> The script of a grid of two factors.
   function carpet_script(study, name, subtitle) result(text)
      type(study_data_t), intent(in) :: study
      character(*), intent(in) :: name, subtitle
      character(:), allocatable :: text
      type(carpet_t) :: carpet
      type(sheet_t) :: sheet
      integer :: r, f

      call lay(study, carpet)
      sheet = new_sheet(name, 'Carpet over two factors', subtitle//'; blue: lines of equal '//study%factors(1)%label// &
         ', orange: of equal '//study%factors(2)%label, min(size(study%responses), most_panels))
      sheet%bottom = 40
      if (sheet%panels == 1) sheet%width = 900
      do r = 1, sheet%panels
         do f = 1, 2
            call add_lines(study, carpet, f, r, sheet)
            call add_ends(study, carpet, f, r, sheet)
         end do
      end do
      call begin_panels(sheet)
      call sheet%text%line('unset xtics; unset xzeroaxis; unset yzeroaxis; set border 2; set grid noxtics')
      call sheet%text%line('set offsets graph 0.16, graph 0.14, graph 0.1, graph 0.1')
      do r = 1, sheet%panels
         call begin_panel(sheet, r, '', '', study%responses(r)%label)
         text = 'plot '
         do f = 1, 2
            if (f == 2) text = text//', \'//nl//'     '
            text = text//'$equal'//str(f)//'_'//str(r)//' using 1:2 with lines linewidth 2 linecolor '//colours(f)//' notitle'// &
               labels(.true.)//labels(.false.)
         end do
         call sheet%text%line(text)
      end do
      call sheet%text%line('set xtics; set border 3; set offsets 0, 0, 0, 0')
      text = end_panels(sheet)

   contains

      !> The values at the ends of the lines, above or below them, outside the carpet.
      function labels(is_above) result(words)
         logical, intent(in) :: is_above
         character(:), allocatable :: words

         words = trim(merge('right offset -0.7,', 'left offset 0.7,  ', is_at_begin(study, carpet, f, r)))// &
            trim(merge(' 0.45 ', ' -0.45', is_above))
         words = ', \'//nl//'     $ends'//str(f)//'_'//str(r)//' using ($3 '//trim(merge('> 0', '< 0', is_above))// &
            ' ? $1 : NaN):2:4 with labels '//words//" font ',12' textcolor "//colours(f)//' notitle'
      end function labels

   end function carpet_script

   !> Finds levels and designs. The grid has the designs of the last factor first.
   subroutine lay(study, carpet)
      type(study_data_t), intent(in) :: study
      type(carpet_t), intent(out) :: carpet
      integer, allocatable :: order(:), other(:)
      real(wp) :: values(study%designs)
      integer :: n(2), f, k

      n(2) = 1
      do k = 2, study%designs
         if (abs(study%x(1, k) - study%x(1, 1)) > 0.0_wp) exit
         n(2) = k
      end do
      n(1) = study%designs/n(2)
      carpet%levels = n
      allocate (carpet%place(maxval(n), 2))
      other = ascending(study%x(1, 1:n(1)*n(2):n(2)))
      order = ascending(study%x(2, :n(2)))
      allocate (carpet%design(n(1), n(2)))
      do k = 1, n(2)
         carpet%design(:, k) = (other - 1)*n(2) + order(k)
      end do
      do f = 1, 2
         values(:n(f)) = study%x(f, carpet%design(:, 1))
         if (f == 2) values(:n(f)) = study%x(f, carpet%design(1, :))
         if (is_geometric(study%x(f, :))) values(:n(f)) = log(values(:n(f)))
         carpet%place(:n(f), f) = (values(:n(f)) - values(1))/max(values(n(f)) - values(1), tiny(1.0_wp))
      end do
   end subroutine lay

   !> The order in which values ascend.
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

   !> Whether the line of a level is drawn: the first, the last, and some between them.
   pure logical function is_drawn(level, levels)
      integer, intent(in) :: level, levels
      integer :: step

      do step = max(1, ceiling((levels - 1.0_wp)/(most_lines - 1))), levels - 1
         if (mod(levels - 1, step) == 0 .and. (levels - 1)/step > 2) exit          ! equal steps, to the last level
      end do
      if (step >= levels - 1) step = max(1, ceiling((levels - 1.0_wp)/(most_lines - 1)))
      is_drawn = mod(level - 1, step) == 0 .or. level == levels
   end function is_drawn

   !> Abscissa and response at a pair of levels.
   pure function point_of(study, carpet, i, j, r) result(point)
      type(study_data_t), intent(in) :: study
      type(carpet_t), intent(in) :: carpet
      integer, intent(in) :: i, j, r                 !! levels of factors 1 and 2; response
      real(wp) :: point(2)

      point = [carpet%place(i, 1) + shift*carpet%place(j, 2), study%y(r, carpet%design(i, j))]
   end function point_of

   !> The lines on which factor f is constant.
   subroutine add_lines(study, carpet, f, r, sheet)
      type(study_data_t), intent(in) :: study
      type(carpet_t), intent(in) :: carpet
      integer, intent(in) :: f, r
      type(sheet_t), intent(inout) :: sheet
      integer :: i, j

      call begin_data(sheet, 'equal'//str(f)//'_'//str(r))
      do i = 1, carpet%levels(f)
         if (.not. is_drawn(i, carpet%levels(f))) cycle
         do j = 1, carpet%levels(3 - f)
            if (f == 1) call add_numbers(sheet, point_of(study, carpet, i, j, r))
            if (f == 2) call add_numbers(sheet, point_of(study, carpet, j, i, r))
         end do
         call sheet%text%line('')
      end do
      call end_data(sheet)
   end subroutine add_lines

   !> Whether the lines of equal factor f carry their values where the other factor is smallest: on that edge of the carpet on which
   !> the response changes most, so that they lie apart.
   pure logical function is_at_begin(study, carpet, f, r)
      type(study_data_t), intent(in) :: study
      type(carpet_t), intent(in) :: carpet
      integer, intent(in) :: f, r
      real(wp) :: first(2), last(2)

      if (f == 1) then
         first = range_of_values(study%y(r, carpet%design(:, 1)))
         last = range_of_values(study%y(r, carpet%design(:, carpet%levels(2))))
      else
         first = range_of_values(study%y(r, carpet%design(1, :)))
         last = range_of_values(study%y(r, carpet%design(carpet%levels(1), :)))
      end if
      is_at_begin = first(2) - first(1) > last(2) - last(1)
   end function is_at_begin

   !> The values of factor f at the ends of its lines, and 1 or −1 for above or below: away from where the line comes from.
   subroutine add_ends(study, carpet, f, r, sheet)
      type(study_data_t), intent(in) :: study
      type(carpet_t), intent(in) :: carpet
      integer, intent(in) :: f, r
      type(sheet_t), intent(inout) :: sheet
      real(wp) :: at(2), inside(2), value
      integer :: i, end, next

      end = merge(1, carpet%levels(3 - f), is_at_begin(study, carpet, f, r))
      next = merge(2, carpet%levels(3 - f) - 1, is_at_begin(study, carpet, f, r))
      call begin_data(sheet, 'ends'//str(f)//'_'//str(r))
      do i = 1, carpet%levels(f)
         if (.not. is_drawn(i, carpet%levels(f))) cycle
         if (f == 1) then
            at = point_of(study, carpet, i, end, r)
            inside = point_of(study, carpet, i, next, r)
            value = study%x(1, carpet%design(i, 1))
         else
            at = point_of(study, carpet, end, i, r)
            inside = point_of(study, carpet, next, i, r)
            value = study%x(2, carpet%design(1, i))
         end if
         if (.not. ieee_is_finite(at(2))) cycle
         if (.not. ieee_is_finite(inside(2))) inside(2) = at(2)
         call add_numbers(sheet, [at, merge(1.0_wp, -1.0_wp, inside(2) < at(2))], short(value))
      end do
      call end_data(sheet)
   end subroutine add_ends

   !> A value with four digits, of which the last ones may be zeros: 10080, 0.125.
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
