!> The charts of one section of a page, each drawn as figures/<name>.svg in the folder of the page.
module ek_chart_set
   use ek_file, only: join_path, remove_file
   use ek_error, only: message_list_t
   use ek_chart, only: chart_t, picture_file
   implicit none(type, external)
   private
   public :: chart_set_t, gather_charts, remove_drawn, pictures_of

   !> The charts of one test.
   type :: chart_set_t
      type(chart_t), allocatable :: charts(:)
   end type chart_set_t

contains

   !> All charts of all sets in one list, for one gnuplot script.
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

   !> The picture files of these charts. A chart without curves is not drawn; every name is listed once.
   subroutine pictures_of(charts, pictures)
      type(chart_t), intent(in) :: charts(:)
      type(message_list_t), intent(inout) :: pictures
      integer :: k, n

      do k = 1, size(charts)
         if (size(charts(k)%traces) == 0) cycle
         do n = 1, pictures%count()
            if (pictures%line(n) == picture_file(charts(k))) exit
         end do
         if (n > pictures%count()) call pictures%add(picture_file(charts(k)))
      end do
   end subroutine pictures_of

   !> Removes pictures of these charts from an earlier run, for a page without pictures.
   subroutine remove_drawn(sets, folder)
      type(chart_set_t), intent(in) :: sets(:)
      character(*), intent(in) :: folder        !! of the page
      integer :: k, n

      do k = 1, size(sets)
         do n = 1, size(sets(k)%charts)
            call remove_file(join_path(folder, 'figures/'//picture_file(sets(k)%charts(n))))
         end do
      end do
   end subroutine remove_drawn

end module ek_chart_set
