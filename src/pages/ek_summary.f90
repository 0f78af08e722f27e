!> The key numbers at the top of a report, and the key numbers that repeat another key number.
module ek_summary
   use ek_key_number, only: key_number_t, has_value
   use ek_assessment, only: axle_kind_t, is_judged
   implicit none(type, external)
   private
   public :: summary_numbers, kept_number, relation_to, slope_at_design

   integer, parameter :: most = 16, most_ratios = 3
   character(*), parameter :: ratio = '*_motion_ratio'

   !> Candidates for the key numbers at the top of a report, in order. Key numbers without a value are omitted, and only the
   !> first three motion ratios of the deck are used.
   character(*), parameter :: heads(*) = [character(44) :: 'bump_toe', 'bump_camber', 'wheel_rate', 'roll_centre_height_mm', &
      'wheel_roll_steer', 'camber_relative_to_road_in_roll', 'suspension_roll_rate_nm_per_deg', 'lateral_force_steer', &
      'lateral_deflection', 'aligning_torque_steer', 'braking_steer', ratio, 'anti_dive_percent', 'anti_lift_brake_percent', &
      'anti_squat_percent', 'anti_lift_drive_percent', 'ride_frequency_hz', 'steering_ratio', 'caster_trail_mm', &
      'scrub_radius_mm', 'wheel_roll_camber', 'lateral_force_camber', 'braking_deflection', 'toe_deg', 'camber_deg']

   !> A key number that says nothing new beside another one, which is shown, and its relation to that number.
   type :: pair_t
      character(44) :: repeated = '', kept = ''
      integer :: relation = 0
   end type pair_t

   !> Relations: the slope at design of a slope that is fitted around design, and the reverse; the inverse, deflection per force;
   !> the angle of steer, which is positive to the left on both wheels, instead of toe.
   integer, parameter :: at_design = 1, inverse = 2, as_steer = 3, fitted = 4
   character(*), parameter :: relations(4) = [character(20) :: 'As slope at design,', 'Its inverse,', 'As a steer angle,', &
      'As a fitted slope,']

   type(pair_t), parameter :: pairs(*) = [ &
      pair_t('wheel_rate_n_per_mm', 'wheel_rate', at_design), pair_t('vertical_deflection', 'wheel_rate', inverse), &
      pair_t('roll_rate', 'suspension_roll_rate_nm_per_deg', fitted), pair_t('bump_steer', 'bump_toe', as_steer), &
      pair_t('lateral_in_load_held_deflection_mm_per_kn', 'lateral_deflection', at_design), &
      pair_t('lateral_in_load_held_steer_deg_per_kn', 'lateral_force_steer', at_design), &
      pair_t('lateral_in_load_held_camber_deg_per_kn', 'lateral_force_camber', at_design), &
      pair_t('aligning_in_load_held_steer_deg_per_100nm', 'aligning_torque_steer', at_design), &
      pair_t('braking_load_held_deflection_mm_per_kn', 'braking_deflection', at_design), &
      pair_t('braking_load_held_steer_deg_per_kn', 'braking_steer', at_design), &
      pair_t('steer_per_steering_wheel', 'steering_ratio', inverse)]

contains

   !> The indices of the key numbers at the top of the report, at most 16. Responses to driving are omitted if the axle is not driven,
   !> unless they have a target.
   pure function summary_numbers(numbers, axle) result(places)
      type(key_number_t), intent(in) :: numbers(:)
      type(axle_kind_t), intent(in) :: axle
      integer, allocatable :: places(:)
      integer :: h, k, ratios

      allocate (places(0))
      ratios = 0
      do h = 1, size(heads)
         do k = 1, size(numbers)
            if (.not. has_value(numbers(k)) .or. size(places) == most) cycle
            if (.not. (is_judged(numbers(k)%name, axle) .or. numbers(k)%has_target)) cycle
            if (heads(h) == ratio) then
               if (index(numbers(k)%name, ratio(2:)) == 0 .or. ratios == most_ratios) cycle
               ratios = ratios + 1
            else if (numbers(k)%name /= heads(h)) then
               cycle
            end if
            places = [places, k]
         end do
      end do
   end function summary_numbers

   !> The label that relates a repeated key number to the key number that is shown, with a comma: 'Its inverse,'.
   pure function relation_to(repeated) result(label)
      character(*), intent(in) :: repeated           !! name of a repeated key number
      character(:), allocatable :: label
      integer :: p

      label = ''
      do p = 1, size(pairs)
         if (pairs(p)%repeated == repeated) label = trim(relations(pairs(p)%relation))
      end do
   end function relation_to

   !> The column that is the slope at design of a fitted slope; '' if there is none.
   pure function slope_at_design(fitted_slope) result(column)
      character(*), intent(in) :: fitted_slope       !! name of the key number: 'lateral_force_steer'
      character(:), allocatable :: column
      integer :: p

      column = ''
      do p = 1, size(pairs)
         if (pairs(p)%kept == fitted_slope .and. pairs(p)%relation == at_design) column = trim(pairs(p)%repeated)
      end do
   end function slope_at_design

   !> The index of the key number that is shown instead of key number k; 0 if key number k is not replaced. It is replaced if
   !> it has no target, and an equivalent key number has a value.
   pure integer function kept_number(numbers, k) result(place)
      type(key_number_t), intent(in) :: numbers(:)
      integer, intent(in) :: k
      integer :: p

      place = 0
      do p = size(pairs), 1, -1
         if (pairs(p)%repeated == numbers(k)%name) exit
      end do
      if (p == 0 .or. numbers(k)%has_target) return
      do place = size(numbers), 1, -1
         if (numbers(place)%name == pairs(p)%kept .and. has_value(numbers(place))) return
      end do
   end function kept_number

end module ek_summary
