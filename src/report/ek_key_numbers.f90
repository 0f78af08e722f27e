!> The key numbers of a report, from all its tests: attitude at design, rates, ride and roll, compliance,
!> anti-dive, anti-lift, anti-squat, steering. Numbers without a column or test are omitted. Titles, units and signs are those of
!> ek_quantity and ek_gradient_definition.
module ek_key_numbers
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_table, only: column_index
   use ek_quantity, only: quantity_t, quantity_named, without_phase, unit_of, unit_text
   use ek_test_result, only: test_result_t, design_row, unfolded_rows
   use ek_gradient, only: gradient_t
   use ek_gradient_definition, only: fitted
   use ek_place_numbers, only: key_number_t, new_number, nothing, place_numbers
   implicit none(type, external)
   private
   public :: key_number_t, key_numbers

   integer, parameter :: length = 48
   character(*), parameter :: attitude = 'Attitude at design', rates = 'Rates', ride = 'Ride', roll = 'Roll', &
      comply = 'Compliance', held = 'Compliance at design', steer = 'Steering'
   character(*), parameter :: instant(4) = [character(length) :: 'instant_caster_deg', 'instant_kingpin_inclination_deg', &
      'instant_scrub_radius_mm', 'instant_caster_trail_mm']

contains

   !> All key numbers that the tests provide.
   subroutine key_numbers(tests, gradients, numbers)
      type(test_result_t), intent(in) :: tests(:)
      type(gradient_t), intent(in) :: gradients(:)
      type(key_number_t), allocatable, intent(out) :: numbers(:)
      logical :: is_steered, is_pair
      integer :: k

      allocate (numbers(0))
      is_steered = .false.
      is_pair = .false.
      do k = 1, size(tests)
         is_steered = is_steered .or. column_index(tests(k)%table, 'steering_ratio') > 0
         if (allocated(tests(k)%prefixes)) is_pair = is_pair .or. size(tests(k)%prefixes) > 1
      end do
      call design(attitude, [character(length) :: 'toe_deg', 'camber_deg', 'caster_deg', 'kingpin_inclination_deg', &
         'scrub_radius_mm', 'caster_trail_mm', 'spindle_length_mm', 'spindle_offset_mm'])
      if (is_steered) call design(attitude, instant)
      call design(attitude, [character(length) :: 'centre_axis_distance_mm', 'patch_axis_distance_mm', 'along_spindle_length_mm', &
         'across_spindle_offset_mm', 'total_track_mm', 'vertical_force_n', 'roll_centre_height_mm', 'roll_centre_y_mm', &
         'force_roll_centre_height_mm'])
      call design(rates, ['wheel_rate_n_per_mm'])
      call slopes(rates, 'parallel_travel', ['wheel rate'])
      call design(rates, [character(length) :: 'ride_rate_n_per_mm', 'ride_frequency_hz'])
      call slopes(rates, 'vertical_force', ['vertical deflection'])
      call design(rates, [character(length) :: 'suspension_roll_rate_nm_per_deg', 'total_roll_rate_nm_per_deg', &
         'hop_rate_n_per_mm', 'tramp_rate_nm_per_deg', 'fore_aft_stiffness_n_per_mm', 'lateral_stiffness_n_per_mm', &
         'vertical_stiffness_n_per_mm'])
      call slopes(ride, 'parallel_travel', [character(length) :: 'bump steer', 'bump toe', 'bump camber', 'bump caster', &
         'half-track change', 'wheelbase change', 'roll-centre height change'])
      call design(ride, [character(length) :: 'recession_gradient_mm_per_m', 'side_view_arm_length_mm', 'side_view_arm_angle_deg', &
         'front_view_arm_length_mm', 'front_view_arm_angle_deg'])
      call slopes(roll, 'roll', [character(length) :: 'wheel roll steer', 'wheel roll camber', &
         'camber relative to road in roll', 'wheel roll caster', 'wheel load in roll', 'roll rate'])
      do k = 0, 1
         call slopes(comply, 'lateral_force', [character(length) :: 'lateral deflection', 'lateral force steer', &
            'lateral force camber'], is_anti=k == 1)
      end do
      call slopes(comply, 'aligning_torque', [character(length) :: 'aligning torque steer', 'aligning torque camber'], &
         is_anti=.false.)
      call slopes(comply, 'aligning_torque', ['aligning torque steer'], is_anti=.true.)
      call slopes(comply, 'braking', [character(length) :: 'braking deflection', 'braking steer', 'braking caster'])
      call slopes(comply, 'traction', [character(length) :: 'traction deflection', 'traction steer', 'traction caster'])
      call design(held, [character(length) :: &
         'lateral_in_load_held_deflection_mm_per_kn', 'lateral_in_height_held_deflection_mm_per_kn', &
         'lateral_in_load_held_steer_deg_per_kn', 'lateral_in_height_held_steer_deg_per_kn', &
         'lateral_in_load_held_camber_deg_per_kn', 'lateral_in_height_held_camber_deg_per_kn', &
         'aligning_in_load_held_steer_deg_per_100nm', 'aligning_in_height_held_steer_deg_per_100nm', &
         'braking_load_held_deflection_mm_per_kn', 'braking_height_held_deflection_mm_per_kn', &
         'braking_load_held_steer_deg_per_kn', 'braking_height_held_steer_deg_per_kn', &
         'traction_load_held_rotation_y_deg_per_kn', 'lateral_in_jacking_n_per_kn'])
      if (.not. is_steered) call design('Elastic steer axis', instant)
      call design('Anti-dive, anti-lift, anti-squat', [character(length) :: 'anti_dive_percent', 'anti_lift_drive_percent', &
         'anti_lift_brake_percent', 'anti_squat_percent', 'brake_dive_mm_per_g', 'drive_lift_mm_per_g', 'brake_lift_mm_per_g', &
         'drive_squat_mm_per_g'])
      call design(steer, ['steering_ratio'])
      call slopes(steer, 'steering', [character(length) :: 'steer per steering input', 'steer per steering wheel'])
      call extreme('maximum steer to the left', 'steer_deg', 'largest')
      call extreme('maximum steer to the right', 'steer_deg', 'least')
      call extreme('maximum Ackermann', 'ackermann_percent', 'largest')
      call extreme('minimum turning circle', 'turning_circle_m', 'least')
      call extreme('minimum turning circle, curb to curb', 'curb_to_curb_m', 'least')
      call extreme('minimum turning circle, wall to wall', 'wall_to_wall_m', 'least')
      call design(steer, ['steer_camber_deg_per_deg'])
      call slopes(steer, 'steering', ['steer camber'])
      call place_numbers(tests, numbers)

   contains

      !> Columns at design.
      subroutine design(group, columns)
         character(*), intent(in) :: group, columns(:)
         type(key_number_t) :: number
         type(quantity_t) :: quantity
         character(:), allocatable :: title
         integer :: k, at

         do k = 1, size(columns)
            quantity = quantity_named(columns(k))
            title = trim(quantity%title)
            title(1:1) = achar(iachar(title(1:1)) + 32)
            at = index(title, 'instant')
            if (at > 0 .and. .not. is_steered) title(at:at + 6) = 'elastic'
            call new_number(group, title, unit_text(unit_of(trim(columns(k)))), trim(quantity%sign), number)
            call take(number, columns(k), 'design', '')
         end do
      end subroutine design

      !> A column at its maximum or minimum over the steering test.
      subroutine extreme(title, column, how)
         character(*), intent(in) :: title, column, how
         type(key_number_t) :: number

         call new_number(steer, title, unit_text(unit_of(column)), 'over the test', number)
         call take(number, column, how, 'steering')
      end subroutine extreme

      subroutine take(number, column, how, kind)
         type(key_number_t), intent(inout) :: number
         character(*), intent(in) :: column, how, kind
         logical :: is_there

         call from_tables(tests, column, how, kind, number, is_there)
         if (is_there) call append(number)
      end subroutine take

      !> Fitted gradients of a kind of test.
      subroutine slopes(group, kind, quantities, is_anti)
         character(*), intent(in) :: group, kind, quantities(:)
         logical, intent(in), optional :: is_anti      !! absent: the first test of the kind
         type(key_number_t) :: number
         character(:), allocatable :: phase
         logical :: is_there
         integer :: k

         phase = ''
         if (present(is_anti)) phase = merge(', opposed (anti phase) ', ', parallel (in phase)  ', is_anti)
         do k = 1, size(quantities)
            call new_number(group, trim(quantities(k))//trim(phase)//fitted, '', '', number)
            call from_gradients(tests, gradients, trim(quantities(k))//fitted, kind, number, is_there, is_anti)
            if (is_there) call append(number)
         end do
      end subroutine slopes

      subroutine append(number)
         type(key_number_t), intent(inout) :: number
         type(key_number_t), allocatable :: more(:)

         if (.not. is_pair) then
            number%quantity = without_phase(number%quantity)
            number%sign = without_phase(number%sign)
         end if
         allocate (more(size(numbers) + 1))
         more(:size(numbers)) = numbers
         more(size(more)) = number
         call move_alloc(more, numbers)
      end subroutine append

   end subroutine key_numbers

   !> A gradient of the first test of the kind and phase.
   subroutine from_gradients(tests, gradients, quantity, kind, number, is_there, is_anti)
      type(test_result_t), intent(in) :: tests(:)
      type(gradient_t), intent(in) :: gradients(:)
      character(*), intent(in) :: quantity, kind
      type(key_number_t), intent(inout) :: number
      logical, intent(out) :: is_there
      logical, intent(in), optional :: is_anti
      integer :: t, k

      is_there = .false.
      do t = 1, size(tests)
         if (tests(t)%kind /= kind) cycle
         if (present(is_anti)) then
            if (is_anti .neqv. tests(t)%is_anti) cycle
         end if
         do k = 1, size(gradients)
            if (gradients(k)%test /= tests(t)%name .or. gradients(k)%quantity /= quantity) cycle
            is_there = .true.
            number%unit = gradients(k)%unit
            number%sign = gradients(k)%sign//' (over '//gradients(k)%window//')'
            if (gradients(k)%side == 'right') then
               number%right = gradients(k)%value
            else
               number%left = gradients(k)%value
               number%is_of_axle = len(gradients(k)%side) == 0 .and. size(tests(t)%prefixes) > 1
            end if
         end do
         if (is_there) return
      end do
   end subroutine from_gradients

   !> A column at design, or its maximum or minimum, in the first test that has it.
   subroutine from_tables(tests, column, how, kind, number, is_there)
      type(test_result_t), intent(in) :: tests(:)
      character(*), intent(in) :: column, how, kind     !! kind of the test; '': any
      type(key_number_t), intent(inout) :: number
      logical, intent(out) :: is_there
      integer :: t, wheel, place
      real(wp) :: value

      is_there = .false.
      do t = 1, size(tests)
         if (len(kind) > 0 .and. tests(t)%kind /= kind) cycle
         do wheel = 1, size(tests(t)%prefixes)
            place = column_index(tests(t)%table, trim(tests(t)%prefixes(wheel))//column)
            if (place == 0) cycle
            value = value_of(tests(t), place, how)
            if (.not. ieee_is_finite(value)) cycle
            is_there = .true.
            if (tests(t)%sides(wheel) > 0 .and. size(tests(t)%prefixes) > 1) then
               number%right = value
            else
               number%left = value
            end if
         end do
         place = column_index(tests(t)%table, column)
         if (.not. is_there .and. place > 0) then
            value = value_of(tests(t), place, how)
            is_there = ieee_is_finite(value)
            number%left = value
            number%is_of_axle = size(tests(t)%prefixes) > 1
         end if
         if (is_there) return
      end do
   end subroutine from_tables

   !> A column at design, or its maximum or minimum over the converged states; not a number if there is none.
   pure real(wp) function value_of(test, place, how) result(value)
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: place
      character(*), intent(in) :: how
      logical :: is_good(size(test%table%values, 2))
      integer :: row

      value = nothing()
      if (how == 'design') then
         row = design_row(test%table)
         if (row > 0) value = test%table%values(place, row)
         return
      end if
      is_good = unfolded_rows(test%table) .and. ieee_is_finite(test%table%values(place, :))
      if (.not. any(is_good)) return
      if (how == 'largest') value = maxval(test%table%values(place, :), mask=is_good)
      if (how == 'least') value = minval(test%table%values(place, :), mask=is_good)
   end function value_of

end module ek_key_numbers
