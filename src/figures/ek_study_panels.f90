!> The panels of a figure of a study: responses or columns, sorted by the size of their scatter. The first sheet shows the six
!> strongest panels, the second sheet the others, at most 24.
module ek_study_panels
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_change, only: least_of
   use ek_study_data, only: study_data_t, study_axis_t, range_of_values
   use ek_effect_figures, only: ranked
   implicit none(type, external)
   private
   public :: most_panels, sheets_of, response_panels, column_panels, panels_text

   integer, parameter :: most_panels = 6          !! largest number of panels on the first sheet
   integer, parameter :: most_others = 24         !! largest number of panels on the second sheet

contains

   !> Number of sheets of a figure: 2 if the figure has more panels than fit on the first sheet, otherwise 1.
   pure integer function sheets_of(panels)
      integer, intent(in) :: panels
      sheets_of = merge(2, 1, panels > most_panels)
   end function sheets_of

   !> The indices of the responses on a sheet, sorted by standard deviation. The deviation is a share of the mean's magnitude,
   !> or of the least span of a chart in the unit of the response if the latter is larger.
   pure function response_panels(study, sheet) result(panels)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: sheet
      integer, allocatable :: panels(:)
      real(wp) :: sizes(size(study%responses))
      integer :: r

      do r = 1, size(sizes)
         sizes(r) = share_of(study%summaries(r)%deviation, abs(study%summaries(r)%mean), study%responses(r))
      end do
      panels = part_of(ranked(sizes, size(sizes)), sheet)
   end function response_panels

   !> The indices of the columns on a sheet, sorted by the widest part of the band of 90 % of the curves. The width is a share
   !> of the range of the median curve, or of the least span of the column's unit if the latter is larger.
   pure function column_panels(study, sheet) result(panels)
      type(study_data_t), intent(in) :: study
      integer, intent(in) :: sheet
      integer, allocatable :: panels(:)
      real(wp) :: sizes(size(study%columns)), range(2), width(2)
      integer :: c

      sizes = 0.0_wp
      do c = 1, size(sizes)
         if (.not. any(ieee_is_finite(study%bands(1, c, :)))) cycle
         range = range_of_values(study%bands(3, c, :))
         width = range_of_values(study%bands(5, c, :) - study%bands(1, c, :))
         sizes(c) = share_of(width(2), range(2) - range(1), study%columns(c))
      end do
      panels = part_of(ranked(sizes, size(sizes)), sheet)
   end function column_panels

   !> Scatter as a share of the size of a value, or of the least span of its unit if the latter is larger; at most 1.
   pure real(wp) function share_of(scatter, value, axis)
      real(wp), intent(in) :: scatter, value
      type(study_axis_t), intent(in) :: axis
      real(wp) :: least

      share_of = 0.0_wp
      if (.not. scatter > 0.0_wp) return
      least = 0.0_wp
      if (allocated(axis%unit)) least = least_of(axis%unit)
      share_of = scatter/max(scatter, value, least)
   end function share_of

   !> The panels on a sheet, from all panels in order.
   pure function part_of(order, sheet) result(panels)
      integer, intent(in) :: order(:), sheet
      integer, allocatable :: panels(:)

      if (sheet == 1) panels = order(:min(size(order), most_panels))
      if (sheet == 2) panels = order(most_panels + 1:min(size(order), most_panels + most_others))
   end function part_of

   !> Phrase about the panels on a sheet: '; 6 of 9 responses, those with the largest scatter', or '; responses 7 to 9 of 9 by
   !> scatter'. '' if one sheet shows all.
   pure function panels_text(of, sheet, noun) result(text)
      integer, intent(in) :: of, sheet
      character(*), intent(in) :: noun           !! 'responses', 'columns'
      character(:), allocatable :: text

      text = ''
      if (of <= most_panels) return
      text = '; '//str(most_panels)//' of '//str(of)//' '//noun//', those with the largest scatter'
      if (sheet == 2) text = '; '//noun//' '//str(most_panels + 1)//' to '//str(min(of, most_panels + most_others))//' of '// &
         str(of)//' by scatter'
   end function panels_text

end module ek_study_panels
