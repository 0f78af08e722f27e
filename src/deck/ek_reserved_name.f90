!> Names that are not allowed in a deck, with the reason: the column with which each would collide.
!>
!> To add a fixed column: add its row to `columns` if the column of an element could have the same name (a name of the deck
!> with _mm, _deg, _cosine for a measure, _length_mm, _force_n, … for others), and update the list in input/README.md.
module ek_reserved_name
   use ek_text, only: lower
   implicit none(type, external)
   private
   public :: reserved_because, reserved_columns, column_t

   !> A name of an element, and the column name that it would duplicate.
   type :: column_t
      character(32) :: name      !! without left_, right_, instant_
      character(36) :: column
   end type column_t

   type(column_t), parameter :: reserved_columns(*) = [ &
      column_t('state', 'state'), column_t('factor', 'factor'), column_t('converged', 'converged'), &
      column_t('iterations', 'iterations'), column_t('constraint_error', 'constraint_error'), &
      column_t('toe', 'toe_deg'), column_t('camber', 'camber_deg'), column_t('steer', 'steer_deg'), &
      column_t('inclination', 'inclination_deg'), column_t('caster', 'caster_deg'), &
      column_t('kingpin_inclination', 'kingpin_inclination_deg'), column_t('scrub_radius', 'scrub_radius_mm'), &
      column_t('caster_trail', 'caster_trail_mm'), column_t('spindle', 'spindle_length_mm'), &
      column_t('spindle_length', 'spindle_length_mm'), column_t('spindle_offset', 'spindle_offset_mm'), &
      column_t('track_change', 'track_change_mm'), column_t('wheelbase_change', 'wheelbase_change_mm'), &
      column_t('wheel_centre_x', 'wheel_centre_x_mm'), column_t('wheel_centre_y', 'wheel_centre_y_mm'), &
      column_t('wheel_centre_z', 'wheel_centre_z_mm'), column_t('contact_patch_x', 'contact_patch_x_mm'), &
      column_t('contact_patch_y', 'contact_patch_y_mm'), column_t('contact_patch_z', 'contact_patch_z_mm'), &
      column_t('vertical', 'vertical_force_n'), column_t('side_view_arm', 'side_view_arm_length_mm'), &
      column_t('side_view_arm_length', 'side_view_arm_length_mm'), column_t('side_view_arm_angle', 'side_view_arm_angle_deg'), &
      column_t('front_view_arm', 'front_view_arm_length_mm'), column_t('front_view_arm_length', 'front_view_arm_length_mm'), &
      column_t('front_view_arm_angle', 'front_view_arm_angle_deg'), column_t('axle_roll', 'axle_roll_deg'), &
      column_t('roll_centre_y', 'roll_centre_y_mm'), column_t('roll_centre_z', 'roll_centre_z_mm'), &
      column_t('wheel_travel', 'wheel_travel_mm'), column_t('roll', 'roll_moment_nm'), &
      column_t('roll_centre_height', 'roll_centre_height_mm'), &
      column_t('ackermann_error', 'ackermann_error_deg'), column_t('steering_wheel', 'steering_wheel_deg'), &
      column_t('side_view', 'side_view_angle_deg'), column_t('side_view_angle', 'side_view_angle_deg'), &
      column_t('centre_axis_distance', 'centre_axis_distance_mm'), column_t('patch_axis_distance', 'patch_axis_distance_mm'), &
      column_t('along_spindle', 'along_spindle_length_mm'), column_t('along_spindle_length', 'along_spindle_length_mm'), &
      column_t('across_spindle', 'across_spindle_offset_mm'), column_t('across_spindle_offset', 'across_spindle_offset_mm'), &
      column_t('total_track', 'total_track_mm'), column_t('total_track_change', 'total_track_change_mm'), &
      column_t('ideal_outer_steer', 'ideal_outer_steer_deg'), column_t('outer_steer_error', 'outer_steer_error_deg'), &
      column_t('side_view_arm_centre_x', 'side_view_arm_centre_x_mm'), column_t('side_view_arm_centre_z', &
      'side_view_arm_centre_z_mm'), column_t('front_view_arm_centre_y', 'front_view_arm_centre_y_mm'), &
      column_t('front_view_arm_centre_z', 'front_view_arm_centre_z_mm'), &
      column_t('roll_centre_with_tyres_y', 'roll_centre_with_tyres_y_mm'), &
      column_t('roll_centre_with_tyres_height', 'roll_centre_with_tyres_height_mm'), &
      column_t('force_roll_centre_height', 'force_roll_centre_height_mm'), &
      column_t('steering_rack', 'steering_rack_force_n')]

contains

   !> The message for a reserved name; '' if the name is allowed.
   pure function reserved_because(name, has_results) result(words)
      character(*), intent(in) :: name
      logical, intent(in) :: has_results       !! elements of its kind have columns in the results
      character(*), parameter :: rate = '_per'
      character(:), allocatable :: words, head, rest
      integer :: k

      words = ''
      select case (lower(name))
      case ('chassis', 'ground')
         words = 'the name is reserved for the fixed body'
         return
      case ('wheel_travel')
         words = "the name is reserved: drive = 'wheel_travel' prescribes the height of a wheel (column wheel_travel_mm)"
         return
      end select
      if (index(lower(name), 'rig_') == 1) then
         words = 'the name is reserved: names of the test rig begin with rig_, as in the column rig_left_height_reaction_n'
         return
      end if
      if (.not. has_results) return
      if (len(name) > len(rate)) then
         if (lower(name(len(name) - len(rate) + 1:)) == rate) then
            words = 'the name is reserved: names of rates end in _per, as in the column wheel_rate_n_per_mm'
            return
         end if
      end if
      call split(lower(name), head, rest)
      do k = 1, size(reserved_columns)
         if (reserved_columns(k)%name /= rest) cycle
         words = 'the name is reserved: the results have a column '//head//trim(reserved_columns(k)%column)
         return
      end do
   end function reserved_because

   !> Splits off the prefix of a wheel column (the side on an axle, instant_ for its instant steer axis).
   pure subroutine split(name, head, rest)
      character(*), intent(in) :: name
      character(:), allocatable, intent(out) :: head, rest
      character(*), parameter :: heads(3) = [character(8) :: 'left_', 'right_', 'instant_']
      integer :: k

      head = ''
      rest = name
      do k = 1, size(heads)
         if (index(rest, trim(heads(k))) /= 1) cycle
         head = head//trim(heads(k))
         rest = rest(len_trim(heads(k)) + 1:)
      end do
   end subroutine split

end module ek_reserved_name
