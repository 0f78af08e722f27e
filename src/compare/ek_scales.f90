!> The axes of another report, for the charts of a report. Reports whose charts have the same scales can be compared side by
!> side.
module ek_scales
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_chart, only: chart_t, view_of
   use ek_gradient_definition, only: windows_t
   use ek_report_files, only: results_t, read_results
   use ek_test_charts, only: test_charts
   implicit none(type, external)
   private
   public :: read_scales, take_scales

contains

   !> Reads the tables of a report folder and creates the charts of that report from them.
   subroutine read_scales(folder, windows, charts, error)
      character(*), intent(in) :: folder
      type(windows_t), intent(in) :: windows
      type(chart_t), allocatable, intent(out) :: charts(:)
      type(error_t), allocatable, intent(out) :: error       !! exit_file
      type(results_t) :: results
      integer :: k

      allocate (charts(0))
      call read_results(folder, windows, results, error)
      if (allocated(error)) return
      do k = 1, size(results%tests)
         call test_charts(results%tests(k), charts, k)
      end do
   end subroutine read_scales

   !> Sets the axes of charts to the axes of the charts with the same name in another report. The axes of all other charts are
   !> unchanged.
   subroutine take_scales(from, charts)
      type(chart_t), intent(in) :: from(:)
      type(chart_t), intent(inout) :: charts(:)
      real(wp) :: low, high
      integer :: j, k

      do k = 1, size(charts)
         do j = 1, size(from)
            if (from(j)%name /= charts(k)%name) cycle
            call view_of(from(j), low, high)
            charts(k)%is_fixed = low <= high
            charts(k)%fixed = [low, high]
         end do
      end do
   end subroutine take_scales

end module ek_scales
