!> The curves of the designs of a study. Each panel is coloured by the factor with the largest effect on its curves.
module ek_family_figure
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_study_data, only: study_data_t, is_geometric, range_of_values
   use ek_study_sheet, only: sheet_t, new_sheet, begin_data, add_numbers, end_data, begin_panels, begin_panel, end_panels, blues
   use ek_sample_figures, only: thinned, add_scale
   implicit none(type, external)
   private
   public :: family_script, curve_leader

   integer, parameter :: most_curves = 300           !! largest number of designs with curves in the figure

contains

   !> The gnuplot script of the curves, with one panel per column. Of more than 300 designs, only some are drawn.
   function family_script(study, name, subtitle, panels) result(text)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:)               !! indices of the columns
      character(*), intent(in) :: name, subtitle
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      integer, allocatable :: leaders(:)
      logical :: is_common
      integer :: c, every

      every = (size(study%drawn) + most_curves - 1)/most_curves
      sheet = new_sheet(name, 'The curves of all designs', '', size(panels))
      if (size(study%drawn)*every < study%designs .or. every > 1) sheet%title = 'The curves of some designs'
      allocate (leaders(sheet%panels))
      do c = 1, sheet%panels
         leaders(c) = curve_leader(study, panels(c))
      end do
      is_common = all(leaders == leaders(1))
      sheet%has_scale = is_common
      sheet%subtitle = subtitle// &
         thinned(every*max(1, study%designs/max(1, size(study%drawn))), study%designs)
      if (.not. is_common) sheet%subtitle = sheet%subtitle//'; colour: from dark to light the factor above each panel'
      call add_curves(sheet, study, panels, leaders, every)
      call begin_panels(sheet)
      call sheet%text%line(blues)
      if (is_common) call add_scale(sheet, study%factors(leaders(1))%label, study%x(leaders(1), :))
      do c = 1, sheet%panels
         call begin_panel(sheet, c, trim(above(c)), study%swept, study%columns(panels(c))%label)
         if (c == 2 .or. .not. is_common) call sheet%text%line('unset colorbox')
         call sheet%text%line('unset logscale cb')
         if (is_geometric(study%x(leaders(c), :))) call sheet%text%line('set logscale cb')
         call sheet%text%line('plot $curves using 1:'//str(1 + sheet%panels + c)//':'//str(1 + c)// &
            ' with lines linewidth 1 linecolor palette notitle')
      end do
      text = end_panels(sheet)

   contains

      !> Title above a panel if the panels have different factors: the factor of the panel and its range. Otherwise ''.
      function above(panel) result(words)
         integer, intent(in) :: panel
         character(:), allocatable :: words
         real(wp) :: range(2)

         words = ''
         if (is_common) return
         range = range_of_values(study%x(leaders(panel), :))
         words = study%factors(leaders(panel))%label//' '//str(range(1), 4)//' … '//str(range(2), 4)
      end function above

   end function family_script

   !> Adds the data of every `every`-th design: swept value, the factor of each panel, and the column of each panel.
   subroutine add_curves(sheet, study, panels, leaders, every)
      type(sheet_t), intent(inout) :: sheet
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: panels(:), leaders(:), every
      integer :: k, j

      call begin_data(sheet, 'curves')
      do k = 1, size(study%drawn), every
         do j = 1, size(study%sweep)
            if (.not. any(ieee_is_finite(study%curves(:, j, k)))) cycle
            call add_numbers(sheet, [study%sweep(j), study%x(leaders, study%drawn(k)), study%curves(panels, j, k)])
         end do
         call sheet%text%line('')
      end do
      call end_data(sheet)
   end subroutine add_curves

   !> Index of the factor that explains most of the scatter of a column. The measure is the squared correlation of factor and column
   !> over all swept values, weighted with the variance of the column at each swept value.
   pure integer function curve_leader(study, column) result(leader)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: column
      real(wp) :: explained(size(study%factors))
      integer :: f, j

      explained = 0.0_wp
      do j = 1, size(study%sweep)
         do f = 1, size(explained)
            explained(f) = explained(f) + explained_variance(study%x(f, study%drawn), study%curves(column, j, :))
         end do
      end do
      leader = maxloc(explained, dim=1)
   end function curve_leader

   !> The part of the variance of y that a straight line over x explains, times the number of designs. Designs without values
   !> are omitted; with less than two designs, the part is 0.
   pure real(wp) function explained_variance(x, y) result(part)
      real(wp), intent(in) :: x(:), y(:)
      logical :: is_used(size(x))
      real(wp) :: xx, xy, mean(2)
      integer :: n

      part = 0.0_wp
      is_used = ieee_is_finite(x) .and. ieee_is_finite(y)
      n = count(is_used)
      if (n < 2) return
      mean = [sum(x, mask=is_used), sum(y, mask=is_used)]/n
      xx = sum((x - mean(1))**2, mask=is_used)
      xy = sum((x - mean(1))*(y - mean(2)), mask=is_used)
      if (xx > 0.0_wp) part = xy**2/xx
   end function explained_variance

end module ek_family_figure
