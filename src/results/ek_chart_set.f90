!> The charts of one section of a page, each drawn as figures/<name>.svg in the folder of the page.
module ek_chart_set
   use ek_file, only: join_path, remove_file
   use ek_chart, only: chart_t
   implicit none(type, external)
   private
   public :: chart_set_t, gather_charts, remove_drawn

   !> The charts of one test.
   type :: chart_set_t
      type(chart_t), allocatable :: charts(:)
   end type chart_set_t

contains

   !> All charts of all sets in one list, which one script of gnuplot draws.
   pure subroutine gather_charts(sets, charts)
      type(chart_set_t), intent(in) :: sets(:)
      type(chart_t), allocatable, intent(out) :: charts(:)
      integer :: k, n

      n = 0
      do k = 1, size(sets)
         n = n + size(sets(k)%charts)
      end do
      allocate (charts(n))
      n = 0
      do k = 1, size(sets)
         charts(n + 1:n + size(sets(k)%charts)) = sets(k)%charts
         n = n + size(sets(k)%charts)
      end do
   end subroutine gather_charts

   !> Removes what an earlier run has drawn of these charts: it must not slip into a page where gnuplot fails.
   subroutine remove_drawn(sets, folder)
      type(chart_set_t), intent(in) :: sets(:)
      character(*), intent(in) :: folder        !! of the page
      integer :: k, n

      do k = 1, size(sets)
         do n = 1, size(sets(k)%charts)
            call remove_file(join_path(folder, 'figures/'//sets(k)%charts(n)%name//'.svg'))
         end do
      end do
   end subroutine remove_drawn

end module ek_chart_set
