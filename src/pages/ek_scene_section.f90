!> The suspension in space on the page of a report: the 3-D picture, the 3-D view that a reader turns, the views with hardpoints, and
!> the animation.
module ek_scene_section
   use ek_error, only: error_t
   use ek_file, only: read_whole, join_path, file_exists
   use ek_report_content, only: report_t
   use ek_page, only: page_t, begin_section, add_block, add_data_picture, add_picture, add_figure
   implicit none(type, external)
   private
   public :: add_scene, add_panels, has_figures, has_view_in_space, add_view_in_space

contains

   !> Whether the page has figures of panels.
   pure logical function has_figures(report)
      type(report_t), intent(in) :: report

      has_figures = allocated(report%figures)
      if (has_figures) has_figures = size(report%figures) > 0
   end function has_figures

   !> Whether the 3-D picture of this report is in its folder.
   logical function has_picture(report)
      type(report_t), intent(in) :: report

      has_picture = report%has_pictures
      if (has_picture) has_picture = file_exists(join_path(report%folder, 'picture.png'))
   end function has_picture

   !> Whether the page has the 3-D view that a reader turns.
   pure logical function has_turntable(report)
      type(report_t), intent(in) :: report
      has_turntable = allocated(report%turntable) .and. .not. report%is_static
   end function has_turntable

   !> Whether the page has the suspension in space: the 3-D picture, or without it the 3-D view.
   logical function has_view_in_space(report)
      type(report_t), intent(in) :: report
      has_view_in_space = has_picture(report) .or. has_turntable(report)
   end function has_view_in_space

   !> Adds the 3-D picture, or without it the 3-D view.
   subroutine add_view_in_space(page, report)
      type(page_t), intent(inout) :: page
      type(report_t), intent(in) :: report
      type(error_t), allocatable :: error
      character(:), allocatable :: bytes

      if (.not. has_picture(report)) then
         if (has_turntable(report)) call add_block(page, 'place', '"turntable"')
         return
      end if
      call read_whole(join_path(report%folder, 'picture.png'), bytes, error)
      if (.not. allocated(error)) call add_data_picture(page, bytes, 'png', 'The suspension in space: '//report%title, &
         'Solid: design. Thin lines: ends of the travel. Bodies have no shape in the model; they are drawn as bars '// &
         'between their attachment points.')
   end subroutine add_view_in_space

   !> Adds the section with the suspension in space, without the picture or the view that is above, in the summary.
   subroutine add_scene(page, report, has_view_above)
      type(page_t), intent(inout) :: page
      type(report_t), intent(in) :: report
      logical, intent(in) :: has_view_above      !! the page has add_view_in_space in its summary
      type(error_t), allocatable :: error
      character(:), allocatable :: bytes
      logical :: has_gif, has_views, shows_turntable, shows_first

      has_gif = report%has_pictures .and. report%has_animation
      if (has_gif) has_gif = file_exists(join_path(report%folder, 'animation.gif'))
      has_views = has_figures(report)
      if (has_views) has_views = report%figures(1)%name == 'views' .and. (report%has_pictures .or. .not. report%is_static)
      shows_first = has_view_in_space(report) .and. .not. has_view_above
      shows_turntable = has_turntable(report)
      if (shows_turntable) shows_turntable = has_picture(report)              ! otherwise it is the first view
      if (.not. (shows_first .or. shows_turntable .or. has_gif .or. has_views)) return
      call begin_section(page, 'picture', 'The suspension')
      if (shows_first) call add_view_in_space(page, report)
      if (shows_turntable) call add_block(page, 'place', '"turntable"')
      if (has_views) call add_panels(page, report, 'views', 'Hardpoints at design from the left, the front and above: '// &
         report%title, 'Hardpoints at design; of an axle its left half, names without left_.')
      if (has_gif) then
         call read_whole(join_path(report%folder, 'animation.gif'), bytes, error)
         if (.not. allocated(error)) call add_data_picture(page, bytes, 'gif', 'The suspension moving: '//report%title, '')
      end if
   end subroutine add_scene

   !> Adds the place of a figure, which the script of the page draws. On a static page, adds the picture drawn by gnuplot, if its
   !> file exists.
   subroutine add_panels(page, report, name, title, caption)
      type(page_t), intent(inout) :: page
      type(report_t), intent(in) :: report
      character(*), intent(in) :: name, title, caption
      type(error_t), allocatable :: error
      character(:), allocatable :: path, svg

      if (.not. report%is_static) then
         call add_figure(page, name, caption)
         return
      end if
      path = join_path(report%folder, 'figures/'//name//'.svg')
      if (.not. report%has_pictures) return
      if (.not. file_exists(path)) return
      call read_whole(path, svg, error)
      if (.not. allocated(error)) call add_picture(page, svg, title, caption)
   end subroutine add_panels

end module ek_scene_section
