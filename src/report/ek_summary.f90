!> The key numbers at the top of a report, and the key numbers that repeat another key number.
module ek_summary
   use ek_key_number, only: key_number_t, has_value
   implicit none(type, external)
   private
   public :: summary_numbers, kept_number

   integer, parameter :: most = 16, most_ratios = 3
   character(*), parameter :: ratio = '*_motion_ratio'

   !> Candidates for the key numbers at the top of a report, in order. Key numbers without a value are omitted, and only the
   !> first three motion ratios of the deck are used.
   character(*), parameter :: heads(*) = [character(44) :: 'bump_toe', 'bump_camber', 'wheel_rate', 'roll_centre_height_mm', &
      'wheel_roll_steer', 'camber_relative_to_road_in_roll', 'suspension_roll_rate_nm_per_deg', 'lateral_force_steer', &
      'lateral_deflection', 'aligning_torque_steer', 'braking_steer', ratio, 'anti_dive_percent', 'anti_lift_brake_percent', &
      'anti_squat_percent', 'anti_lift_drive_percent', 'ride_frequency_hz', 'steering_ratio', 'caster_trail_mm', &
      'scrub_radius_mm', 'wheel_roll_camber', 'lateral_force_camber', 'braking_deflection', 'toe_deg', 'camber_deg']

   !> A repeated key number and the equivalent key number that is shown: a slope fitted around design and its value at design;
   !> a load and its inverse; an angle as toe and as steer angle.
   type :: pair_t
      character(44) :: repeated = '', kept = ''
   end type pair_t

   type(pair_t), parameter :: pairs(*) = [ &
      pair_t('wheel_rate_n_per_mm', 'wheel_rate'), pair_t('vertical_deflection', 'wheel_rate'), &
      pair_t('roll_rate', 'suspension_roll_rate_nm_per_deg'), pair_t('bump_steer', 'bump_toe'), &
      pair_t('lateral_in_load_held_deflection_mm_per_kn', 'lateral_deflection'), &
      pair_t('lateral_in_load_held_steer_deg_per_kn', 'lateral_force_steer'), &
      pair_t('lateral_in_load_held_camber_deg_per_kn', 'lateral_force_camber'), &
      pair_t('aligning_in_load_held_steer_deg_per_100nm', 'aligning_torque_steer'), &
      pair_t('braking_load_held_deflection_mm_per_kn', 'braking_deflection'), &
      pair_t('braking_load_held_steer_deg_per_kn', 'braking_steer'), pair_t('steer_camber_deg_per_deg', 'steer_camber'), &
      pair_t('steer_per_steering_wheel', 'steering_ratio')]

contains

   !> The indices of the key numbers at the top of the report, at most 16.
   pure function summary_numbers(numbers) result(places)
      type(key_number_t), intent(in) :: numbers(:)
      integer, allocatable :: places(:)
      integer :: h, k, ratios

      allocate (places(0))
      ratios = 0
      do h = 1, size(heads)
         do k = 1, size(numbers)
            if (.not. has_value(numbers(k)) .or. size(places) == most) cycle
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
