!> Three views of a suspension at design with the names of its hardpoints: from the left, from the front and from above; also of
!> two designs of one model, with the hardpoints that moved.
!>
!> Of an axle, the left half is shown, and the names of its points are without 'left_'. Axes are the axes of the deck [mm]. In
!> the views from the left and from above, the front of the car is at the left.
module ek_views
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp, millimetre
   use ek_text, only: str
   use ek_suspension, only: suspension_t
   use ek_element, only: element_kinds, bushing_shape
   use ek_measure, only: distance
   use ek_wheel_side, only: deck_frame
   use ek_skeleton, only: ends_of
   use ek_state, only: state_t, design_state
   use ek_scene, only: scene_t, add_run, line_ground
   use ek_picture, only: add_ghost
   use ek_gnuplot, only: on_guide, on_point, on_skeleton, on_title, on_level, on_derivative, on_range
   use ek_figure, only: figure_t, new_figure, add_series, add_point_names, as_line, as_points, as_segments
   implicit none(type, external)
   private
   public :: find_views, find_moved_views, moved_points

   integer, parameter :: views = 3, name_length = 63
   ! axes of a panel: to the right and upward; their directions in the frame of the program (x rearward, y to the right, z up)
   integer, parameter :: across(views) = [1, 2, 1], upward(views) = [3, 3, 2]
   real(wp), parameter :: sense(views) = [1.0_wp, -1.0_wp, 1.0_wp]      ! of the axis to the right; from the front, left is right
   character(14), parameter :: titles(views) = [character(14) :: 'From the left', 'From the front', 'From above']
   character(1), parameter :: axes(3) = ['x', 'y', 'z']
   real(wp), parameter :: room = 0.12_wp         !! margin around the points, as a share of their span

   real(wp), parameter :: least_move = 1.0e-9_wp !! shorter moves are rounding noise [m]

   !> The hardpoints that are shown, with their names.
   type :: points_t
      character(name_length), allocatable :: names(:)
      real(wp), allocatable :: at(:, :)          !! positions in the frame of the program [m]
   end type points_t

contains

   !> Finds the three views. Not allocated for a model that uses no hardpoints.
   subroutine find_views(suspension, name, figure)
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: name
      type(figure_t), allocatable, intent(out) :: figure
      type(points_t) :: points
      type(scene_t) :: scene
      real(wp) :: frame(3)
      integer :: v

      call half_of(suspension, points)
      if (size(points%names) == 0) return
      call draw_design(suspension, scene)
      frame = deck_frame(suspension)
      allocate (figure)
      figure = new_figure(name, 'Hardpoints at design', suspension%name//'; axes of the deck, mm', views, height=640)
      call begin_views(points, frame, figure)
      do v = 1, views
         associate (panel => figure%panels(v))
            call add_series(panel, as_line, on_skeleton, lines_of(scene, frame, v))
            call add_series(panel, as_points, on_point, places(points%at, frame, v), weight=0.8_wp)
         end associate
         call add_point_names(figure, v, points%names, frame(across(v))*points%at(across(v), :)/millimetre, &
            frame(upward(v))*points%at(upward(v), :)/millimetre, on_guide, on_title)
      end do
   end subroutine find_views

   !> Sets size, titles, labels and ranges of the views.
   subroutine begin_views(points, frame, figure)
      type(points_t), intent(in) :: points
      real(wp), intent(in) :: frame(3)
      type(figure_t), intent(inout) :: figure
      integer :: v

      figure%width = 1600
      figure%columns = views
      figure%letters = 12
      figure%bottom = 84
      do v = 1, views
         associate (panel => figure%panels(v))
            panel%title = trim(titles(v))
            panel%x%label = axes(across(v))//' [mm]'
            panel%y%label = axes(upward(v))//' [mm]'
            panel%x%has_range = .true.
            panel%y%has_range = .true.
            call find_ranges(figure, points, frame, v, panel%x%range, panel%y%range)
         end associate
      end do
   end subroutine begin_views

   !> Draws a suspension at design: its skeletons, and its springs, dampers and stops.
   subroutine draw_design(suspension, scene)
      type(suspension_t), intent(in) :: suspension
      type(scene_t), intent(inout) :: scene
      type(state_t) :: state

      state = design_state(suspension)
      call add_ghost(scene, suspension, state, line_ground)
      call add_springs(scene, suspension, state)
   end subroutine draw_design

   !> Finds the views of two designs of one model, one above the other. The moves of the hardpoints are drawn larger, and their
   !> names are given. Not allocated if no hardpoint that is shown moved.
   subroutine find_moved_views(before, after, name, figure)
      type(suspension_t), intent(in) :: before, after
      character(*), intent(in) :: name
      type(figure_t), allocatable, intent(out) :: figure
      type(points_t) :: old, new
      type(scene_t) :: scenes(2)
      integer, allocatable :: order(:), moved(:)
      real(wp), allocatable :: from(:, :), to(:, :)
      real(wp) :: frame(3)
      character(:), allocatable :: factor
      integer :: k, v, larger

      call half_of(before, old)
      call half_of(after, new)
      moved = pack([(k, k=1, size(old%names))], [(norm2(new%at(:, k) - old%at(:, k)) > least_move, k=1, size(old%names))])
      if (size(moved) == 0) return
      order = [moved, pack([(k, k=1, size(old%names))], [(all(moved /= k), k=1, size(old%names))])]      ! names are of the first
      larger = magnification(old, new)
      call draw_design(before, scenes(1))
      call draw_design(after, scenes(2))
      frame = deck_frame(after)
      factor = 'moves'
      if (larger > 1) factor = 'moves, '//str(larger)//' times larger'
      allocate (figure)
      figure = new_figure(name, 'Design before and after', after%name//'; axes of the deck, mm', views, height=640)
      call begin_views(new, frame, figure)
      do v = 1, views
         associate (panel => figure%panels(v))
            call add_series(panel, as_line, on_range, lines_of(scenes(1), frame, v), is_dashed=.true., title='before')
            call add_series(panel, as_line, on_level, lines_of(scenes(2), frame, v), title='after')
            from = places(old%at(:, moved), frame, v)
            to = places(new%at(:, moved), frame, v)
            call add_series(panel, as_segments, on_derivative, reshape([(from(:, k), larger*(to(:, k) - from(:, k)), &
               k=1, size(moved))], [4, size(moved)]), weight=3.0_wp, title=factor)
            call add_series(panel, as_points, on_point, from, weight=0.8_wp)
         end associate
         call add_point_names(figure, v, old%names(moved), frame(across(v))*old%at(across(v), order)/millimetre, &
            frame(upward(v))*old%at(upward(v), order)/millimetre, on_guide, on_title)
      end do
   end subroutine find_moved_views

   !> The factor by which moves are drawn larger: 1, 2, 5, 10, …, so that the longest move is at most a fifth of the suspension.
   pure integer function magnification(old, new) result(larger)
      type(points_t), intent(in) :: old, new
      integer, parameter :: factors(*) = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000]
      real(wp) :: span, longest

      span = maxval(maxval(new%at, dim=2) - minval(new%at, dim=2))
      longest = maxval(norm2(new%at - old%at, dim=1))
      larger = maxval(factors, factors*longest <= 0.2_wp*span)
      larger = max(1, larger)
   end function magnification

   !> Lists the hardpoints that moved between two designs of one model, with their positions in the axes of the deck [mm].
   subroutine moved_points(before, after, names, from, to)
      type(suspension_t), intent(in) :: before, after
      character(name_length), allocatable, intent(out) :: names(:)
      real(wp), allocatable, intent(out) :: from(:, :), to(:, :)
      real(wp) :: frame(3)
      integer, allocatable :: moved(:)
      integer :: k

      moved = pack([(k, k=1, size(before%points))], [(norm2(after%points(k)%at - before%points(k)%at) > least_move .and. &
         after%points(k)%is_used, k=1, size(before%points))])
      frame = deck_frame(after)
      allocate (names(size(moved)), from(3, size(moved)), to(3, size(moved)))
      do k = 1, size(moved)
         names(k) = after%points(moved(k))%name
         from(:, k) = frame*before%points(moved(k))%at/millimetre
         to(:, k) = frame*after%points(moved(k))%at/millimetre
      end do
   end subroutine moved_points

   !> Lists the hardpoints that are used, without the right side of an axle.
   subroutine half_of(suspension, points)
      type(suspension_t), intent(in) :: suspension
      type(points_t), intent(out) :: points
      logical :: is_left
      integer :: k, n
      logical, allocatable :: is_shown(:)

      is_left = any([(index(suspension%points(k)%name, 'left_') == 1, k=1, size(suspension%points))])
      allocate (is_shown(size(suspension%points)))
      do k = 1, size(is_shown)
         is_shown(k) = suspension%points(k)%is_used .and. .not. (is_left .and. index(suspension%points(k)%name, 'right_') == 1)
      end do
      allocate (points%names(count(is_shown)), points%at(3, count(is_shown)))
      n = 0
      do k = 1, size(is_shown)
         if (.not. is_shown(k)) cycle
         n = n + 1
         points%names(n) = suspension%points(k)%name
         if (is_left .and. index(points%names(n), 'left_') == 1) points%names(n) = points%names(n)(6:)
         points%at(:, n) = suspension%points(k)%at
      end do
   end subroutine half_of

   !> Adds springs, dampers and stops, as lines between their ends.
   subroutine add_springs(scene, suspension, state)
      type(scene_t), intent(inout) :: scene
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      real(wp) :: line(3, 2)
      integer :: k

      do k = 1, size(suspension%elements)
         associate (element => suspension%elements(k))
            if (element_kinds(element%kind)%shape == bushing_shape .or. element%measure%kind /= distance) cycle
            call ends_of(element%measure, state, line(:, 1), line(:, 2))
            call add_run(scene%lines, line_ground, line)
         end associate
      end do
   end subroutine add_springs

   !> All lines of the scene in a panel, each followed by a gap.
   function lines_of(scene, frame, v) result(values)
      type(scene_t), intent(in) :: scene
      real(wp), intent(in) :: frame(3)
      integer, intent(in) :: v
      real(wp), allocatable :: values(:, :)
      integer :: k, rows, n

      allocate (values(2, scene%lines%used + scene%lines%runs))
      rows = 0
      do k = 1, scene%lines%runs
         n = scene%lines%first(k + 1) - scene%lines%first(k)
         values(:, rows + 1:rows + n) = places(scene%lines%at(:, scene%lines%first(k):scene%lines%first(k + 1) - 1), frame, v)
         rows = rows + n + 1
         values(:, rows) = ieee_value(1.0_wp, ieee_quiet_nan)
      end do
      values = values(:, :rows)
   end function lines_of

   !> The two coordinates of points in a panel [mm].
   pure function places(at, frame, v) result(values)
      real(wp), intent(in) :: at(:, :), frame(3)
      integer, intent(in) :: v
      real(wp) :: values(2, size(at, 2))

      values(1, :) = frame(across(v))*at(across(v), :)/millimetre
      values(2, :) = frame(upward(v))*at(upward(v), :)/millimetre
   end function places

   !> Finds the ranges of a panel, from left to right and upward [mm]. The ranges contain all points, and both axes have one scale.
   subroutine find_ranges(figure, points, frame, v, x_range, y_range)
      type(figure_t), intent(in) :: figure
      type(points_t), intent(in) :: points
      real(wp), intent(in) :: frame(3)
      integer, intent(in) :: v
      real(wp), intent(out) :: x_range(2), y_range(2)
      real(wp) :: low(2), high(2), pixels(2), scale

      associate (x => points%at(across(v), :)/millimetre, y => points%at(upward(v), :)/millimetre)
         low = [minval(x), minval(y)]
         high = [maxval(x), maxval(y)]
      end associate
      pixels = [real(figure%width, wp)/figure%columns - figure%left - figure%right, &
         real(figure%height - figure%top - figure%bottom, wp)]
      scale = maxval(max(high - low, 1.0_wp)*(1.0_wp + 2.0_wp*room)/pixels)      ! mm per pixel
      x_range = (low(1) + high(1))/2 + [-0.5_wp, 0.5_wp]*scale*pixels(1)
      y_range = (low(2) + high(2))/2 + [-0.5_wp, 0.5_wp]*scale*pixels(2)
      x_range = frame(across(v))*x_range
      y_range = frame(upward(v))*y_range
      if (sense(v) < 0.0_wp) x_range = x_range([2, 1])
   end subroutine find_ranges

end module ek_views
