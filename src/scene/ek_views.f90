!> Three views of a suspension at design with the names of its hardpoints: from the left, from the front and from above.
!>
!> Of an axle, the left half is shown, and the names of its points are without 'left_'. Axes are the axes of the deck [mm]. In
!> the views from the left and from above, the front of the car is at the left.
module ek_views
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
   use ek_gnuplot, only: ink, on_point, on_skeleton
   use ek_study_sheet, only: sheet_t, new_sheet, begin_data, add_numbers, end_data, begin_panels, begin_panel, end_panels, &
      add_point_names, names_plot
   implicit none(type, external)
   private
   public :: views_script

   character(*), parameter :: nl = new_line('a')
   integer, parameter :: views = 3, name_length = 63
   ! axes of a panel: to the right and upward; their directions in the frame of the program (x rearward, y to the right, z up)
   integer, parameter :: across(views) = [1, 2, 1], upward(views) = [3, 3, 2]
   real(wp), parameter :: sense(views) = [1.0_wp, -1.0_wp, 1.0_wp]      ! of the axis to the right; from the front, left is right
   character(14), parameter :: titles(views) = [character(14) :: 'From the left', 'From the front', 'From above']
   character(1), parameter :: axes(3) = ['x', 'y', 'z']
   real(wp), parameter :: room = 0.12_wp         !! margin around the points, as a share of their span

   !> The hardpoints that are shown, with their names.
   type :: points_t
      character(name_length), allocatable :: names(:)
      real(wp), allocatable :: at(:, :)          !! positions in the frame of the program [m]
   end type points_t

contains

   !> The script that draws <name>.png and <name>.svg; '' for a model that uses no hardpoints.
   function views_script(suspension, name) result(text)
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: name
      character(:), allocatable :: text
      type(sheet_t) :: sheet
      type(points_t) :: points
      type(scene_t) :: scene
      type(state_t) :: state
      real(wp) :: x_range(2), y_range(2), frame(3)
      integer :: v

      text = ''
      call half_of(suspension, points)
      if (size(points%names) == 0) return
      state = design_state(suspension)
      call add_ghost(scene, suspension, state, line_ground)
      call add_springs(scene, suspension, state)
      frame = deck_frame(suspension)
      sheet = new_sheet(name, 'Hardpoints at design', suspension%name//'; axes of the deck, mm', views)
      sheet%width = 1600
      sheet%height = 640
      sheet%letters = 12
      sheet%bottom = 84
      do v = 1, views
         call add_lines(sheet, scene, frame, v)
         call find_ranges(sheet, points, frame, v, x_range, y_range)
         call begin_data(sheet, 'points'//str(v))
         call add_places(sheet, points%at, frame, v)
         call end_data(sheet)
         call add_point_names(sheet, v, points%names, frame(across(v))*points%at(across(v), :)/millimetre, &
            frame(upward(v))*points%at(upward(v), :)/millimetre, x_range, y_range)
      end do
      call begin_panels(sheet)
      do v = 1, views
         call find_ranges(sheet, points, frame, v, x_range, y_range)
         call begin_panel(sheet, v, trim(titles(v)), axes(across(v))//' [mm]', axes(upward(v))//' [mm]')
         call sheet%text%line('set xrange ['//str(x_range(1), 6)//':'//str(x_range(2), 6)//']; set yrange ['// &
            str(y_range(1), 6)//':'//str(y_range(2), 6)//']')
         call sheet%text%line('plot $lines'//str(v)//" using 1:2 with lines linewidth 2"//ink(on_skeleton)//" notitle, \"//nl// &
            '     $points'//str(v)//" using 1:2 with points pointtype 7 pointsize 0.8"//ink(on_point)//" notitle, \"//nl// &
            '     '//names_plot(v))
      end do
      call sheet%text%line('set xrange [*:*]; set yrange [*:*]')
      text = end_panels(sheet)
   end function views_script

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

   !> Adds all lines of the scene in a panel, each followed by an empty line.
   subroutine add_lines(sheet, scene, frame, v)
      type(sheet_t), intent(inout) :: sheet
      type(scene_t), intent(in) :: scene
      real(wp), intent(in) :: frame(3)
      integer, intent(in) :: v
      integer :: k

      call begin_data(sheet, 'lines'//str(v))
      do k = 1, scene%lines%runs
         call add_places(sheet, scene%lines%at(:, scene%lines%first(k):scene%lines%first(k + 1) - 1), frame, v)
         call sheet%text%line('')
      end do
      call end_data(sheet)
   end subroutine add_lines

   !> Adds the two coordinates of points in a panel [mm].
   subroutine add_places(sheet, at, frame, v)
      type(sheet_t), intent(inout) :: sheet
      real(wp), intent(in) :: at(:, :), frame(3)
      integer, intent(in) :: v
      integer :: k

      do k = 1, size(at, 2)
         call add_numbers(sheet, [frame(across(v))*at(across(v), k), frame(upward(v))*at(upward(v), k)]/millimetre)
      end do
   end subroutine add_places

   !> Finds the ranges of a panel, from left to right and upward [mm]. The ranges contain all points, and both axes have one scale.
   subroutine find_ranges(sheet, points, frame, v, x_range, y_range)
      type(sheet_t), intent(in) :: sheet
      type(points_t), intent(in) :: points
      real(wp), intent(in) :: frame(3)
      integer, intent(in) :: v
      real(wp), intent(out) :: x_range(2), y_range(2)
      real(wp) :: low(2), high(2), pixels(2), scale

      associate (x => points%at(across(v), :)/millimetre, y => points%at(upward(v), :)/millimetre)
         low = [minval(x), minval(y)]
         high = [maxval(x), maxval(y)]
      end associate
      pixels = [real(sheet%width, wp)/sheet%columns - sheet%left - sheet%right, &
         real(sheet%height - sheet%top - sheet%bottom, wp)]
      scale = maxval(max(high - low, 1.0_wp)*(1.0_wp + 2.0_wp*room)/pixels)      ! mm per pixel
      x_range = (low(1) + high(1))/2 + [-0.5_wp, 0.5_wp]*scale*pixels(1)
      y_range = (low(2) + high(2))/2 + [-0.5_wp, 0.5_wp]*scale*pixels(2)
      x_range = frame(across(v))*x_range
      y_range = frame(upward(v))*y_range
      if (sense(v) < 0.0_wp) x_range = x_range([2, 1])
   end subroutine find_ranges

end module ek_views
