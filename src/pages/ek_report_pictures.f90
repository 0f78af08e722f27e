!> The pictures of a report that gnuplot draws, in one run: the suspension in space and its animation, and on request the charts of
!> its tests, the carpets and envelopes of tests on a grid, and the three views of its hardpoints.
module ek_report_pictures
   use ek_kinds, only: wp, millimetre
   use ek_error, only: error_t, message_list_t
   use ek_text, only: str
   use ek_file, only: write_whole, join_path, remove_file
   use ek_suspension, only: suspension_t
   use ek_adjust, only: is_adjusted
   use ek_state, only: state_t, design_state
   use ek_moving_states, only: moving_test, state_of_path, standing_state, travel_kinds, steer_kinds
   use ek_chart, only: charts_script, remove_drawn, pictures_of
   use ek_drawing, only: run_gnuplot
   use ek_scene, only: scene_t, line_bump, line_rebound
   use ek_camera, only: camera_t, fit_camera
   use ek_scene_script, only: scene_script, animation_script
   use ek_report_content, only: report_t
   use ek_picture, only: add_solid, add_ghost, add_ground
   use ek_figure, only: figure_t
   use ek_figure_script, only: figure_script
   use ek_views, only: find_views
   use ek_picture_names, only: add_names, add_axes
   use ek_grid_figures, only: grid_carpet, envelope_figure
   implicit none(type, external)
   private
   public :: draw_pictures, find_figures

   integer, parameter :: max_frames = 36        !! largest number of frames of an animation

contains

   !> Finds the figures of a report: three views of the hardpoints, and carpet and envelope of each test on a grid.
   subroutine find_figures(suspension, report)
      type(suspension_t), intent(in) :: suspension
      type(report_t), intent(inout) :: report
      type(figure_t), allocatable :: views
      integer :: k, used

      call find_views(suspension, 'views', views)
      used = count([(allocated(report%tests(k)%grid), k=1, size(report%tests))])
      allocate (report%figures(2*used + merge(1, 0, allocated(views))))
      used = 0
      if (allocated(views)) then
         used = 1
         report%figures(1) = views
      end if
      do k = 1, size(report%tests)
         if (.not. allocated(report%tests(k)%grid)) cycle
         report%figures(used + 1) = grid_carpet(report%tests(k), suspension%name)
         report%figures(used + 2) = envelope_figure(report%tests(k), suspension)
         used = used + 2
      end do
   end subroutine find_figures

   !> Draws the pictures of a report: picture.svg and .png, animation.gif if requested, and if `wants_figures`, in figures/ the
   !> charts and figures of the page. With --no-plots, deletes the pictures of an earlier report.
   subroutine draw_pictures(report, suspension, wants_plots, wants_figures, wants_animation, message, error)
      type(report_t), intent(inout) :: report                !! has_animation: it was requested, and something moves
      type(suspension_t), intent(in) :: suspension
      logical, intent(in) :: wants_plots, wants_figures, wants_animation
      character(:), allocatable, intent(out) :: message      !! reason for missing pictures, otherwise ''
      type(error_t), allocatable, intent(out) :: error       !! a script cannot be written, or gnuplot failed
      character(13), parameter :: in_space(3) = [character(13) :: 'picture.svg', 'picture.png', 'animation.gif']
      character(4), parameter :: endings(2) = ['.svg', '.png']
      type(message_list_t) :: scripts, pictures
      type(camera_t) :: camera
      integer :: k, e

      message = ''
      if (.not. wants_plots) then
         ! pictures of an earlier report do not belong to this page
         do k = 1, size(in_space)
            call remove_file(join_path(report%folder, trim(in_space(k))))
         end do
         call remove_drawn(report%charts, report%folder)
         do k = 1, size(report%figures)
            do e = 1, size(endings)
               call remove_file(join_path(report%folder, 'figures/'//report%figures(k)%name//endings(e)))
            end do
         end do
         message = 'switched off by --no-plots'
         return
      end if
      call write_picture(report, suspension, camera, error)
      if (allocated(error)) return
      call scripts%add('picture.gp')
      call pictures%add('../picture.svg')
      call pictures%add('../picture.png')
      if (wants_figures) then
         call write_whole(join_path(report%folder, 'figures/charts.gp'), charts_script(report%charts), error, can_be_redrawn=.true.)
         if (allocated(error)) return
         call scripts%add('charts.gp')
         call pictures_of(report%charts, pictures)
         do k = 1, size(report%figures)
            call add_sheet(report%folder, report%figures(k)%name, figure_script(report%figures(k)), scripts, pictures, error)
            if (allocated(error)) return
         end do
      end if
      if (wants_animation) then
         call write_animation(report, suspension, camera, error)
         if (allocated(error)) return
         if (report%has_animation) then
            call scripts%add('animation.gp')
            call pictures%add('../animation.gif')
         end if
      end if
      do k = 1, scripts%count()
         call report%drawn%add('figures/'//scripts%line(k))
      end do
      do k = 1, pictures%count()
         if (index(pictures%line(k), '../') == 1) call report%drawn%add(after(pictures%line(k), '../'))
         if (index(pictures%line(k), '../') /= 1) call report%drawn%add('figures/'//pictures%line(k))
      end do
      call run_gnuplot(scripts, pictures, join_path(report%folder, 'figures'), message, error)
   end subroutine draw_pictures

   !> The rest of a string after its first len(first) characters.
   pure function after(text, first) result(rest)
      character(*), intent(in) :: text, first
      character(:), allocatable :: rest
      rest = text(len(first) + 1:)
   end function after

   !> Writes the script of a figure with its data, and adds the script and its pictures <name>.svg and .png to the lists.
   subroutine add_sheet(folder, name, script, scripts, pictures, error)
      character(*), intent(in) :: folder, name, script
      type(message_list_t), intent(inout) :: scripts, pictures
      type(error_t), allocatable, intent(out) :: error

      call write_whole(join_path(folder, 'figures/'//name//'.gp'), script, error, can_be_redrawn=.true.)
      call scripts%add(name//'.gp')
      call pictures%add(name//'.svg')
      call pictures%add(name//'.png')
   end subroutine add_sheet

   !> Writes the script of the picture: design as solid parts, the ends of the travel as lines.
   subroutine write_picture(report, suspension, camera, error)
      type(report_t), intent(in) :: report
      type(suspension_t), intent(in) :: suspension
      type(camera_t), intent(out) :: camera
      type(error_t), allocatable, intent(out) :: error
      type(scene_t) :: scenes(1)
      type(state_t) :: state
      integer :: test

      camera = view_of(suspension)
      call standing_state(report%tests, report%paths, suspension, state)
      call add_solid(scenes(1), suspension, state, is_plain=.false.)
      call add_ground(scenes(1), suspension, state, is_plain=.false.)
      call add_names(scenes(1), suspension, state)
      call add_axes(scenes(1), suspension, state)
      test = moving_test(report%tests, report%paths, travel_kinds)
      if (test > 0) then
         associate (path => report%paths(test))
            call state_of_path(path, findloc(path%is_reached, .true., dim=1), suspension, state)
            call add_ghost(scenes(1), suspension, state, line_rebound)
            scenes(1)%rebound = end_name(suspension, state)
            call state_of_path(path, findloc(path%is_reached, .true., dim=1, back=.true.), suspension, state)
            call add_ghost(scenes(1), suspension, state, line_bump)
            scenes(1)%bump = end_name(suspension, state)
         end associate
      end if
      call fit_camera(camera, scenes, 3.0_wp, 2.0_wp, footer=0.11_wp)
      call write_whole(join_path(report%folder, 'figures/picture.gp'), scene_script(scenes(1), camera, 'picture', &
         suspension%name//trim(merge(': as set up', ': design   ', is_adjusted(suspension)))// &
         ', and the ends of its travel'), error, can_be_redrawn=.true.)
   end subroutine write_picture

   !> Writes the script of the animation: through the travel and back, then through the steering and back. Writes nothing if
   !> no test moves the suspension; has_animation is then .false.
   subroutine write_animation(report, suspension, camera, error)
      type(report_t), intent(inout) :: report                !! has_animation: something moves
      type(suspension_t), intent(in) :: suspension
      type(camera_t), intent(in) :: camera
      type(error_t), allocatable, intent(out) :: error
      type(scene_t), allocatable :: scenes(:)
      character(64), allocatable :: captions(:)
      type(camera_t) :: fitted
      type(state_t) :: state
      integer :: chosen(2), frames, each, k, f, n, at, first, last

      chosen = [moving_test(report%tests, report%paths, travel_kinds), moving_test(report%tests, report%paths, steer_kinds)]
      frames = max_frames/max(1, count(chosen > 0))
      allocate (scenes(frames*count(chosen > 0)), captions(frames*count(chosen > 0)))
      report%has_animation = size(scenes) > 0
      if (.not. report%has_animation) return
      n = 0
      do f = 1, 2
         if (chosen(f) == 0) cycle
         associate (path => report%paths(chosen(f)))
            first = findloc(path%is_reached, .true., dim=1)
            last = findloc(path%is_reached, .true., dim=1, back=.true.)
            each = frames/2
            do k = 0, frames - 1
               at = first + nint(real(last - first, wp)*(1 - cos(acos(-1.0_wp)*k/each))/2)   ! slow at the ends
               call state_of_path(path, at, suspension, state)
               n = n + 1
               call add_solid(scenes(n), suspension, state, is_plain=.true.)
               call add_ground(scenes(n), suspension, design_state(suspension), is_plain=.true.)
               captions(n) = report%tests(chosen(f))%title
            end do
         end associate
      end do
      fitted = camera
      call fit_camera(fitted, scenes, 4.0_wp, 3.0_wp, footer=0.06_wp)
      call write_whole(join_path(report%folder, 'figures/animation.gp'), &
         animation_script(scenes, captions, fitted, 'animation', suspension%name), error, can_be_redrawn=.true.)
   end subroutine write_animation

   !> Label of an end of the travel: 'bump, +80 mm'. The number is the height of the first wheel's centre above its design
   !> height. Without wheels, the label is 'end of travel'.
   function end_name(suspension, state) result(name)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      character(:), allocatable :: name
      real(wp) :: rise
      integer :: body

      name = 'end of travel'
      if (size(suspension%wheels) == 0) return
      body = suspension%wheels(1)%body
      rise = state%poses(body + 1)%r(3) + dot_product(state%poses(body + 1)%a(3, :), suspension%wheels(1)%centre) - &
         (suspension%bodies(body)%origin(3) + suspension%wheels(1)%centre(3))
      name = 'rebound, '
      if (rise > 0.0_wp) name = 'bump, +'
      name = name//str(anint(rise/millimetre), 3)//' mm'
   end function end_name

   !> Camera with the direction of view: an axle from its front left, a single wheel from the middle of the car.
   pure type(camera_t) function view_of(suspension) result(camera)
      type(suspension_t), intent(in) :: suspension

      camera%turn = 296.0_wp
      camera%tilt = 70.0_wp
      if (size(suspension%wheels) /= 1) return
      camera%turn = 232.0_wp
      if (suspension%wheels(1)%side > 0) camera%turn = 308.0_wp
   end function view_of

end module ek_report_pictures
