!> Bodies and joints of an axle with independent wheels, made from its points. ek_solid_deck writes those of a solid axle.
module ek_link_deck
   use ek_kinds, only: wp
   use ek_point_name, only: point_names, lca_front, lca_rear, lower_ball, uca_front, uca_rear, upper_ball, tie_outer, &
      strut_top, strut_low, push_low, push_top, rocker_pivot, rocker_axis, arm_inner, arm_outer, upper_front_in, &
      upper_front_out, upper_rear_in, upper_rear_out, lower_in, lower_out, trailing_front, trailing_rear, damper_outer, arm_ball, &
      upper_lateral_in, upper_lateral_out, lower_lateral_in, lower_lateral_out
   use ek_point_kind, only: double_wishbone, mcpherson, five_link, trailing_arm, lateral_arm
   use ek_frame_votes, only: half_t
   use ek_axle_facts, only: axle_facts_t, upper_slot, lower_slot, rod_slot
   use ek_deck_parts, only: writing_t, put_body, put_joint, put_hinge, put_line_joint, put_axis_joint
   use ek_elastic_deck, only: put_pivot, put_rod_bushings
   implicit none(type, external)
   private
   public :: put_links, put_rack, has_rocker

   real(wp), parameter :: along_x(3) = [1.0_wp, 0.0_wp, 0.0_wp], along_y(3) = [0.0_wp, 1.0_wp, 0.0_wp]

contains

   !> Whether push rod and rocker are complete, with the axis of the rocker.
   pure logical function has_rocker(half, kind)
      type(half_t), intent(in) :: half
      integer, intent(in) :: kind
      has_rocker = kind == double_wishbone .and. all(half%has([push_low, push_top, rocker_pivot, rocker_axis]))
   end function has_rocker

   !> Writes bodies and joints.
   subroutine put_links(half, kind, rod, is_steered, facts, writing)
      type(half_t), intent(in) :: half
      integer, intent(in) :: kind, rod(2)
      logical, intent(in) :: is_steered
      type(axle_facts_t), intent(in) :: facts
      type(writing_t), intent(inout) :: writing

      if (kind == trailing_arm) then
         call put_body('arm', writing, origin='wheel_centre')
         call put_pivot('arm', arm_inner, arm_outer, half%at, facts%bushings(lower_slot), writing)
         return
      else if (kind == lateral_arm) then
         call put_body('arm', writing, origin='wheel_centre')
         call put_joint('arm_ball', 'spherical', 'chassis', 'arm', [arm_ball], writing)
         call put_joint('upper_link', 'distance', 'chassis', 'arm', [upper_lateral_in, upper_lateral_out], writing)
         call put_joint('lower_link', 'distance', 'chassis', 'arm', [lower_lateral_in, lower_lateral_out], writing)
         return
      end if
      call put_body('carrier', writing, origin='wheel_centre')
      if (kind /= five_link) then
         call put_body('lca', writing)
         call put_pivot('lca', lca_front, lca_rear, half%at, facts%bushings(lower_slot), writing)
         call put_joint('lower_ball', 'spherical', 'lca', 'carrier', [lower_ball], writing)
      end if
      select case (kind)
      case (double_wishbone)
         call put_body('uca', writing)
         call put_pivot('uca', uca_front, uca_rear, half%at, facts%bushings(upper_slot), writing)
         call put_joint('upper_ball', 'spherical', 'uca', 'carrier', [upper_ball], writing)
         if (has_rocker(half, kind)) call put_rocker(half, writing)
      case (mcpherson)
         call put_strut(writing)
      case (five_link)
         call put_five_links(facts, writing)
      end select
      call put_rod(rod, is_steered, facts, writing)
   end subroutine put_links

   !> Writes the links of a five-link axle. The trailing link is a body if a spring may act on it.
   subroutine put_five_links(facts, writing)
      type(axle_facts_t), intent(in) :: facts
      type(writing_t), intent(inout) :: writing

      call put_joint('upper_front_link', 'distance', 'chassis', 'carrier', [upper_front_in, upper_front_out], writing)
      call put_joint('upper_rear_link', 'distance', 'chassis', 'carrier', [upper_rear_in, upper_rear_out], writing)
      call put_joint('lower_link', 'distance', 'chassis', 'carrier', [lower_in, lower_out], writing)
      if (.not. facts%has_link_axes) then
         call put_joint('trailing_link', 'distance', 'chassis', 'carrier', [trailing_front, trailing_rear], writing)
         return
      end if
      call put_body('trailing_link', writing)
      call put_axis_joint('trailing_pivot', 'universal', 'chassis', 'trailing_link', trim(point_names(trailing_front)), &
         facts%link_axes(:, 1), writing, axis_2=facts%link_axes(:, 2))
      call put_joint('trailing_ball', 'spherical', 'trailing_link', 'carrier', [trailing_rear], writing)
   end subroutine put_five_links

   !> Writes the tie rod or the toe link: a rod, or a body on two bushings.
   subroutine put_rod(rod, is_steered, facts, writing)
      integer, intent(in) :: rod(2)
      logical, intent(in) :: is_steered
      type(axle_facts_t), intent(in) :: facts
      type(writing_t), intent(inout) :: writing
      character(:), allocatable :: name, first

      name = trim(merge('tie_rod', 'toe_rod', is_steered))
      first = trim(merge('rack   ', 'chassis', is_steered))
      if (facts%bushings(rod_slot)%is_given) then
         call put_body(name, writing)
         call put_rod_bushings(name, first, rod, facts%bushings(rod_slot), writing)
      else
         call put_joint(name, 'distance', first, 'carrier', rod, writing)
      end if
   end subroutine put_rod

   !> Writes the strut of a McPherson axle: its tube is part of the carrier, its rod cannot spin in the top mount.
   subroutine put_strut(writing)
      type(writing_t), intent(inout) :: writing

      call put_body('strut', writing, origin='strut_top')
      call put_line_joint('slider', 'cylindrical', 'carrier', 'strut', strut_low, strut_top, writing)
      call put_axis_joint('top_mount', 'universal', 'chassis', 'strut', 'strut_top', along_x, writing, axis_2=along_y)
   end subroutine put_strut

   !> Writes push rod and rocker, and the length of the damper as a measure. The rod is on the arm whose ball joint is nearer.
   subroutine put_rocker(half, writing)
      type(half_t), intent(in) :: half
      type(writing_t), intent(inout) :: writing
      logical :: is_lower

      is_lower = norm2(half%at(:, push_low) - half%at(:, lower_ball)) <= norm2(half%at(:, push_low) - half%at(:, upper_ball))
      call put_body('rocker', writing, origin='rocker_pivot')
      call put_hinge('rocker_hinge', 'rocker', rocker_pivot, rocker_axis, writing)
      call writing%deck%comment('assumed: the rod is on the arm whose ball joint is nearer')
      call put_joint('push_rod', 'distance', trim(merge('lca', 'uca', is_lower)), 'rocker', [push_low, push_top], writing)
      if (.not. writing%is_written(damper_outer)) return
      call writing%deck%begin('measure')
      call writing%deck%word('name', 'damper_length')
      call writing%deck%word('type', 'distance')
      call writing%deck%words('bodies', 'rocker', 'chassis')
      call writing%deck%words('at', 'damper_outer', 'damper_inner')
      call writing%deck%end()
   end subroutine put_rocker

   !> Writes the rack. Its travel is positive where it turns the wheels to the left.
   subroutine put_rack(half, writing)
      type(half_t), intent(in) :: half
      type(writing_t), intent(inout) :: writing
      real(wp) :: axis(3), ahead, left
      integer :: top

      top = merge(upper_ball, strut_top, half%has(upper_ball))
      axis = half%at(:, top) - half%at(:, lower_ball)
      ahead = half%at(1, tie_outer) - half%at(1, lower_ball)
      if (abs(axis(3)) > 0.0_wp) ahead = ahead - axis(1)*(half%at(3, tie_outer) - half%at(3, lower_ball))/axis(3)
      if (writing%is_rear) ahead = -ahead
      left = merge(-1.0_wp, 1.0_wp, writing%is_rear)*merge(1.0_wp, -1.0_wp, ahead > 0.0_wp)
      call writing%deck%heading('steering; rack travel is positive to the '// &
         trim(merge('left ', 'right', ahead > 0.0_wp))//', which turns the wheels to the left')
      call put_body('rack', writing)
      call put_axis_joint('rack_guide', 'translational', 'chassis', 'rack', 'rack_centre', left*along_y, writing)
      call writing%deck%begin('measure')
      call writing%deck%word('name', 'rack_travel')
      call writing%deck%word('type', 'gap')
      call writing%deck%words('bodies', 'chassis', 'rack')
      call writing%deck%word('at', 'rack_centre')
      call writing%deck%numbers('axis_vector', left*along_y)
      call writing%deck%end()
      call writing%deck%begin('joint')
      call writing%deck%word('name', 'rack_drive')
      call writing%deck%word('type', 'driver')
      call writing%deck%word('measure', 'rack_travel')
      call writing%deck%end()
   end subroutine put_rack

end module ek_link_deck
