!> Bodies and joints of a solid axle or a de Dion axle, made from its points. The axle tube is one body of both sides.
module ek_solid_deck
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_point_name, only: point_names, kingpin_low, kingpin_top, upper_rod_chassis, upper_rod_axle, lower_rod_chassis, &
      lower_rod_axle, panhard_chassis, panhard_axle, drag_link_chassis, drag_link_crank, crank_tie_rod, crank_axle, &
      triangle_chassis, triangle_axle, axle_pivot, watt_left_chassis, watt_left_lever, watt_right_chassis, watt_right_lever, &
      tie_outer, axle_guide, drag_link_knuckle
   use ek_point_kind, only: kinds, by_links, by_triangle, by_watt, by_slide, by_pipe, crank_and_rod, crank_and_rods, knuckle_link
   use ek_frame_votes, only: half_t
   use ek_deck_parts, only: writing_t, put_point, put_body, put_joint, put_joint_at, put_line_joint, put_axis_joint, &
      put_ends
   implicit none(type, external)
   private
   public :: put_solid_axle, put_shared, put_middle_points

   real(wp), parameter :: along_x(3) = [1.0_wp, 0.0_wp, 0.0_wp], along_y(3) = [0.0_wp, 1.0_wp, 0.0_wp], &
      along_z(3) = [0.0_wp, 0.0_wp, 1.0_wp]

   integer, parameter :: panhard_points(2) = [panhard_chassis, panhard_axle], watt_points(4) = [watt_left_chassis, &
      watt_left_lever, watt_right_chassis, watt_right_lever]

contains

   !> Writes the key `shared` of &mirror: bodies and points that exist once.
   subroutine put_shared(kind, writing)
      integer, intent(in) :: kind
      type(writing_t), intent(inout) :: writing

      call writing%deck%add_word('shared', 'axle', .true.)
      select case (kinds(kind)%guide)
      case (by_links)
         if (all(writing%is_written(panhard_points))) call add_points(panhard_points)
      case (by_triangle)
         call add('triangle')
      case (by_watt)
         call add('watt_lever')
         call add('watt_pivot')
         call add_points([axle_pivot, watt_points])
      case (by_slide)
         call add('guide')
         call add_points([axle_guide])
      case (by_pipe)
         call add_points([axle_pivot, panhard_points])
      end select
      select case (kinds(kind)%steering)
      case (crank_and_rod)
         call add('tie_rod')
         call add('bell_crank')
         call add_points([drag_link_chassis, drag_link_crank, crank_tie_rod, crank_axle])
      case (crank_and_rods)
         call add('bell_crank')
         call add_points([drag_link_chassis, drag_link_crank, crank_axle])
      case (knuckle_link)
         call add_points([drag_link_chassis, drag_link_knuckle])
      end select

   contains

      subroutine add(word)
         character(*), intent(in) :: word
         call writing%deck%add_word('shared', word, .false.)
      end subroutine add

      subroutine add_points(points)
         integer, intent(in) :: points(:)
         integer :: k

         do k = 1, size(points)
            call add(trim(point_names(points(k))))
         end do
      end subroutine add_points

   end subroutine put_shared

   !> Writes the points in the middle of the car that follow from points of the file.
   subroutine put_middle_points(half, kind, writing)
      type(half_t), intent(in) :: half
      integer, intent(in) :: kind
      type(writing_t), intent(inout) :: writing
      real(wp), parameter :: middle(3) = [1.0_wp, 0.0_wp, 1.0_wp]

      if (kinds(kind)%guide == by_triangle) then
         call put_point('triangle_pivot', middle*half%at(:, triangle_chassis), middle_of(triangle_chassis), writing)
         call put_point('triangle_ball', middle*half%at(:, triangle_axle), middle_of(triangle_axle), writing)
      else if (kinds(kind)%guide == by_watt) then
         call put_point('watt_pivot', 0.5_wp*(half%at(:, watt_left_lever) + half%at(:, watt_right_lever)), &
            'between watt_left_lever and watt_right_lever', writing)
      end if

   contains

      !> The source of a point in the middle plane: a point of the left half in the file.
      function middle_of(point) result(note)
         integer, intent(in) :: point
         character(:), allocatable :: note
         note = 'between the sides, '//writing%file//':'//str(half%line(point))
      end function middle_of

   end subroutine put_middle_points

   !> Writes the bodies and joints of the axle tube, and its steering.
   subroutine put_solid_axle(kind, half, writing)
      integer, intent(in) :: kind
      type(half_t), intent(in) :: half                 !! in the frame of the deck
      type(writing_t), intent(inout) :: writing

      call put_body('axle', writing)
      call put_guide(kind, writing)
      if (kinds(kind)%steering == 0) return
      call put_body('carrier', writing, origin='wheel_centre')
      call put_line_joint('kingpin', 'revolute', 'axle', 'carrier', kingpin_low, kingpin_top, writing)
      select case (kinds(kind)%steering)
      case (crank_and_rod)
         call put_crank_and_rod(writing)
      case (crank_and_rods)
         call put_bell_crank(writing)
         call put_joint('tie_rod', 'distance', 'bell_crank', 'carrier', [crank_tie_rod, tie_outer], writing)
      case (knuckle_link)
         call put_knuckle_link(half, writing)
      end select
   end subroutine put_solid_axle

   !> Writes the guide of the axle tube.
   subroutine put_guide(kind, writing)
      integer, intent(in) :: kind
      type(writing_t), intent(inout) :: writing

      select case (kinds(kind)%guide)
      case (by_links)
         call put_joint('lower_rod', 'distance', 'chassis', 'axle', [lower_rod_chassis, lower_rod_axle], writing)
         if (all(writing%is_written(panhard_points))) call put_joint('panhard_rod', 'distance', 'chassis', &
            'axle', panhard_points, writing)
         if (all(writing%is_written(panhard_points)) .and. kinds(kind)%steering == 0) then
            call put_mean_length(writing)
         else
            call put_joint('upper_rod', 'distance', 'chassis', 'axle', [upper_rod_chassis, upper_rod_axle], writing)
         end if
      case (by_triangle)
         call put_joint('lower_rod', 'distance', 'chassis', 'axle', [lower_rod_chassis, lower_rod_axle], writing)
         call put_body('triangle', writing)
         call put_axis_joint('triangle_hinge', 'revolute', 'chassis', 'triangle', 'triangle_pivot', along_y, writing)
         call put_joint_at('triangle_joint', 'spherical', 'triangle', 'axle', 'triangle_ball', writing)
      case (by_watt)
         call put_joint('tube_ball', 'spherical', 'chassis', 'axle', [axle_pivot], writing)
         call put_body('watt_lever', writing, origin='watt_pivot')
         call put_axis_joint('watt_hinge', 'revolute', 'axle', 'watt_lever', 'watt_pivot', along_x, writing)
         call put_joint('watt_left_rod', 'distance', 'chassis', 'watt_lever', [watt_left_chassis, watt_left_lever], writing)
         call put_joint('watt_right_rod', 'distance', 'chassis', 'watt_lever', [watt_right_chassis, watt_right_lever], writing)
      case (by_slide)
         call put_body('guide', writing)
         call put_axis_joint('guide_hinge', 'revolute', 'chassis', 'guide', trim(point_names(axle_guide)), along_x, writing)
         call put_axis_joint('guide_slide', 'translational', 'guide', 'axle', trim(point_names(axle_guide)), along_z, writing)
      case (by_pipe)
         call put_joint('tube_ball', 'spherical', 'chassis', 'axle', [axle_pivot], writing)
         call put_joint('panhard_rod', 'distance', 'chassis', 'axle', panhard_points, writing)
      end select
   end subroutine put_guide

   !> Writes the upper rods as their mean length: four rigid rods and a Panhard rod would leave one motion.
   subroutine put_mean_length(writing)
      type(writing_t), intent(inout) :: writing

      call writing%deck%comment('assumed: only the mean length of the upper rods is constant, because four rigid rods and a '// &
         'Panhard rod lock the axle in roll')
      call writing%deck%begin('measure')
      call writing%deck%word('name', 'upper_length')
      call writing%deck%word('type', 'distance')
      call writing%deck%words('bodies', 'chassis', 'axle')
      call writing%deck%words('at', trim(point_names(upper_rod_chassis)), trim(point_names(upper_rod_axle)))
      call writing%deck%end()
      call writing%deck%begin('joint')
      call writing%deck%word('name', 'upper_rods')
      call writing%deck%word('type', 'coupler')
      call writing%deck%words('measures', 'left_upper_length', 'right_upper_length')
      call writing%deck%numbers('ratios', [1.0_wp, 1.0_wp])
      call writing%deck%end()
   end subroutine put_mean_length

   !> Writes the tie rod between the knuckles, and the bell crank with the drag link. The tie rod cannot spin in its right joint.
   !> The bell crank moves it by its pin, in a plane across the rod.
   subroutine put_crank_and_rod(writing)
      type(writing_t), intent(inout) :: writing

      call put_body('tie_rod', writing)
      call put_joint_at('left_tie_rod_joint', 'spherical', 'tie_rod', 'left_carrier', 'left_tie_rod_outer', writing)
      call put_axis_joint('right_tie_rod_joint', 'universal', 'tie_rod', 'right_carrier', 'right_tie_rod_outer', along_x, &
         writing, axis_2=along_z)
      call put_bell_crank(writing)
      call put_axis_joint('crank_pin', 'in_plane', 'tie_rod', 'bell_crank', trim(point_names(crank_tie_rod)), along_y, writing)
   end subroutine put_crank_and_rod

   !> Writes the bell crank on the tube, with the drag link from the chassis.
   subroutine put_bell_crank(writing)
      type(writing_t), intent(inout) :: writing

      call put_body('bell_crank', writing)
      call put_axis_joint('crank_hinge', 'revolute', 'axle', 'bell_crank', trim(point_names(crank_axle)), along_z, writing)
      call put_joint('drag_link', 'distance', 'chassis', 'bell_crank', [drag_link_chassis, drag_link_crank], writing)
   end subroutine put_bell_crank

   !> Writes the drag link from the chassis to the knuckle on its side, and the tie rod between the knuckles.
   subroutine put_knuckle_link(half, writing)
      type(half_t), intent(in) :: half
      type(writing_t), intent(inout) :: writing
      real(wp) :: outboard                             !! y of the drag link on the knuckle, positive to the left

      outboard = merge(-1.0_wp, 1.0_wp, writing%is_rear)*half%at(2, drag_link_knuckle)
      call put_ends('tie_rod', 'left_carrier', 'right_carrier', 'left_tie_rod_outer', 'right_tie_rod_outer', writing)
      call put_joint('drag_link', 'distance', 'chassis', trim(merge('left_carrier ', 'right_carrier', outboard > 0.0_wp)), &
         [drag_link_chassis, drag_link_knuckle], writing)
   end subroutine put_knuckle_link

end module ek_solid_deck
