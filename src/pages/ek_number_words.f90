!> The meaning of a key number for an engineer: understeer or oversteer, inside or outside its target, equal on both sides.
module ek_number_words
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_noise, only: is_within, solved
   use ek_quantity, only: all_quantities, unit_of, unit_text
   use ek_key_number, only: key_number_t, anti_phase
   use ek_usual_range, only: neutral_band
   use ek_page, only: page_number
   implicit none(type, external)
   private
   public :: steer_effect, target_verdict, is_in_band, mean_value, short_name, is_equal, is_opposite, sides_text, wheel_values, &
      limits_text

   character(*), parameter :: fitted = ' (fitted)'

   !> Key numbers that are positive if the wheels steer to the left in a right turn, out of the bend.
   character(*), parameter :: away(*) = [character(44) :: 'wheel_roll_steer', 'lateral_force_steer', 'aligning_torque_steer', &
      'lateral_in_load_held_steer_deg_per_kn', 'lateral_in_height_held_steer_deg_per_kn', &
      'aligning_in_load_held_steer_deg_per_100nm', 'aligning_in_height_held_steer_deg_per_100nm']

contains

   !> The effect of a key number of steer on the car in a bend. A front axle that steers out of the bend understeers, a rear
   !> axle oversteers; steer into the bend has the opposite effect. A value in the neutral band (ek_usual_range) is neutral. If the
   !> axle is not known, the effects of both axles are given. '' for other key numbers, and without a value.
   pure function steer_effect(number, axle) result(effect)
      type(key_number_t), intent(in) :: number
      integer, intent(in) :: axle                   !! −1 front, 1 rear, 0 not known
      character(48) :: effect
      real(wp) :: value

      effect = ''
      if (.not. any(away == number%name)) return
      value = mean_value(number)
      if (.not. ieee_is_finite(value)) return
      if (abs(value) <= neutral_band(number%unit)) then
         effect = 'neutral'
      else if (axle == 0) then
         effect = 'understeer at the front, oversteer at the rear'
         if (value < 0.0_wp) effect = 'oversteer at the front, understeer at the rear'
      else
         effect = merge('understeer', 'oversteer ', axle*value < 0.0_wp)
      end if
   end function steer_effect

   !> The value of the axle, the mean of both wheels, or the value of the only wheel.
   pure real(wp) function mean_value(number) result(value)
      type(key_number_t), intent(in) :: number

      value = number%left
      if (number%is_of_axle .or. .not. ieee_is_finite(number%right)) return
      value = number%right
      if (ieee_is_finite(number%left)) value = (number%left + number%right)/2
   end function mean_value

   !> Verdict on a key number: 'inside' if the values of all wheels satisfy the target, otherwise 'outside'. '' without a
   !> target or a value.
   pure function target_verdict(number) result(verdict)
      type(key_number_t), intent(in) :: number
      character(7) :: verdict
      character(:), allocatable :: unit
      real(wp) :: values(2)
      integer :: k

      verdict = ''
      values = [number%left, number%right]
      if (number%is_of_axle) values(2) = values(1)
      if (.not. number%has_target .or. .not. any(ieee_is_finite(values))) return
      unit = ''
      if (allocated(number%unit)) unit = number%unit
      verdict = 'inside'
      do k = 1, 2
         if (.not. ieee_is_finite(values(k))) cycle
         if (.not. is_in_band(values(k), number%target, unit)) verdict = 'outside'
      end do
   end function target_verdict

   !> Whether a value satisfies the limits of a band. A value that touches a limit but for rounding noise (ek_noise) is inside.
   pure logical function is_in_band(value, limits, unit)
      real(wp), intent(in) :: value
      real(wp), intent(in) :: limits(2)             !! lower and upper limit, ∓huge if not given
      character(*), intent(in) :: unit              !! unit of value and limits as a label: 'deg/m'
      character(:), allocatable :: column
      integer :: k

      column = 'unknown'
      do k = 1, size(all_quantities)                ! a column in this unit
         if (unit_text(unit_of(trim(all_quantities(k)%name))) == unit) column = trim(all_quantities(k)%name)
         if (column /= 'unknown') exit
      end do
      is_in_band = is_within(value, limits(1), limits(2), column, solved)
   end function is_in_band

   !> The limits of a band: '−2.000 … 0.5000', '≥ −2.000', '≤ 0.5000'; '' without limits.
   pure function limits_text(limits) result(text)
      real(wp), intent(in) :: limits(2)             !! ∓huge if not given
      character(:), allocatable :: text

      text = ''
      if (limits(1) > -huge(1.0_wp) .and. limits(2) < huge(1.0_wp)) then
         text = page_number(limits(1))//' … '//page_number(limits(2))
      else if (limits(1) > -huge(1.0_wp)) then
         text = '≥ '//page_number(limits(1))
      else if (limits(2) < huge(1.0_wp)) then
         text = '≤ '//page_number(limits(2))
      end if
   end function limits_text

   !> The values of a key number as they are printed. For the axle, or if both wheels have equal or opposite values to the printed
   !> digits, it is one value (`left`). Otherwise it is the left and the right value, or the only value.
   type(message_list_t) function wheel_values(number) result(values)
      type(key_number_t), intent(in) :: number
      logical :: is_one

      is_one = number%is_of_axle .or. is_equal(number) .or. is_opposite(number) .or. .not. ieee_is_finite(number%right)
      if (is_one .or. ieee_is_finite(number%left)) call values%add(page_number(number%left))
      if (.not. is_one) call values%add(page_number(number%right))
   end function wheel_values

   !> The quantity of a key number, with an initial capital, and without ' (fitted)', the suffix of a fitted slope.
   function short_name(number) result(name)
      type(key_number_t), intent(in) :: number
      character(:), allocatable :: name
      integer :: at

      name = number%quantity
      at = index(name, fitted)
      if (at > 0) name = name(:at - 1)//name(at + len(fitted):)
      name = trim(name)
      if (name(1:1) >= 'a' .and. name(1:1) <= 'z') name(1:1) = achar(iachar(name(1:1)) - 32)
   end function short_name

   !> Whether both wheels have equal numbers to the printed digits.
   pure logical function is_equal(number)
      type(key_number_t), intent(in) :: number

      is_equal = .false.
      if (number%is_of_axle .or. .not. ieee_is_finite(number%left) .or. .not. ieee_is_finite(number%right)) return
      is_equal = page_number(number%left) == page_number(number%right)
   end function is_equal

   !> Whether left and right differ only in sign, to the printed digits.
   pure logical function is_opposite(number)
      type(key_number_t), intent(in) :: number

      is_opposite = .false.
      if (number%is_of_axle .or. .not. ieee_is_finite(number%left) .or. .not. ieee_is_finite(number%right)) return
      is_opposite = page_number(number%left) == page_number(-number%right) .and. .not. is_equal(number)
   end function is_opposite

   !> The meaning of equal or opposite numbers of both wheels: 'both wheels to the left', 'toe-in on both', 'both tops to the
   !> left', and otherwise 'both wheels' or 'left; right wheel opposite'. '' if the numbers differ in size, for the axle and for
   !> a single wheel. A steer angle is positive to the left on both wheels, toe inward, camber outward. Under opposite loads on
   !> the two wheels, a number is per load on the wheel itself, so that equal numbers are opposite motions: without a direction.
   pure function sides_text(number) result(text)
      type(key_number_t), intent(in) :: number
      character(:), allocatable :: text
      logical :: is_same, is_directed

      text = ''
      is_same = is_equal(number)
      if (.not. (is_same .or. is_opposite(number))) return
      text = 'left; right wheel opposite'
      if (is_same) text = 'both wheels'
      is_directed = number%how /= anti_phase .and. index(number%name, '_anti_') == 0 .and. page_number(number%left) /= '0'
      if (.not. is_directed .or. index(number%sign, 'inner wheel') > 0) return
      if (begins('+ steers to the left') .or. begins('+ to the left')) then
         text = trim(merge('toe-out on both', 'toe-in on both ', number%left > 0.0_wp))
         if (is_same) text = 'both wheels to the '//trim(merge('left ', 'right', number%left > 0.0_wp))
      else if (begins('+ front edge')) then
         text = 'both wheels to the '//trim(merge('right', 'left ', number%left > 0.0_wp))
         if (is_same) text = trim(merge('toe-in on both ', 'toe-out on both', number%left > 0.0_wp))
      else if (.not. is_same .and. (begins('+ top outward') .or. begins('+ top moves outward'))) then
         text = 'both tops to the '//trim(merge('left ', 'right', number%left > 0.0_wp))
      end if

   contains

      pure logical function begins(words)
         character(*), intent(in) :: words
         begins = index(number%sign, words) == 1
      end function begins

   end function sides_text

end module ek_number_words
