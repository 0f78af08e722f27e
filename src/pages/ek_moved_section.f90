!> The section of a page of `solve` or `fit` with the hardpoints that moved: a table, and a picture of both designs.
module ek_moved_section
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_suspension, only: suspension_t
   use ek_figure, only: figure_t
   use ek_views, only: find_moved_views, moved_points
   use ek_page, only: page_t, begin_section, add_text, begin_table, add_cell, end_table, add_figure
   implicit none(type, external)
   private
   public :: add_moved, append_figure

contains

   !> Adds the section, and its picture to the figures of the page. The picture of an axle shows its left half.
   subroutine add_moved(page, before, after, figures)
      type(page_t), intent(inout) :: page
      type(suspension_t), intent(in) :: before, after      !! designs of one model
      type(figure_t), allocatable, intent(inout) :: figures(:)
      type(figure_t), allocatable :: figure
      character(63), allocatable :: names(:)
      real(wp), allocatable :: from(:, :), to(:, :)
      integer :: k, c

      call begin_section(page, 'moved', 'What moved', has_text=.true.)
      call moved_points(before, after, names, from, to)
      if (size(names) == 0) then
         call add_text(page, 'p', 'No hardpoint moved, because no coordinate changed.')
         return
      end if
      call add_text(page, 'p', 'Hardpoints that moved, in the axes of the deck [mm].')
      call begin_table(page, [character(12) :: 'Point', '>x before', '>y before', '>z before', '>x after', '>y after', '>z after', &
         '>distance'])
      do k = 1, size(names)
         call add_cell(page, trim(names(k)))
         do c = 1, 3
            call add_cell(page, str(from(c, k), 9))
         end do
         do c = 1, 3
            call add_cell(page, str(to(c, k), 9))
         end do
         call add_cell(page, str(norm2(to(:, k) - from(:, k)), 4))
      end do
      call end_table(page)
      call find_moved_views(before, after, 'moved', figure)
      if (.not. allocated(figure)) return
      call append_figure(figures, figure)
      call add_figure(page, figure%name, 'Dashed: before. Solid: after. Of an axle, the left half.')
   end subroutine add_moved

   !> Appends a figure to a list, by copies that leave the other figures unchanged.
   subroutine append_figure(figures, figure)
      type(figure_t), allocatable, intent(inout) :: figures(:)
      type(figure_t), intent(in) :: figure
      type(figure_t), allocatable :: grown(:)
      integer :: n

      n = 0
      if (allocated(figures)) n = size(figures)
      allocate (grown(n + 1))
      if (n > 0) grown(:n) = figures
      grown(n + 1) = figure
      call move_alloc(grown, figures)
   end subroutine append_figure

end module ek_moved_section
