!> Whether a result has changed by more than a share of its value, or of the least span of its chart. A difference that is only
!> rounding noise (ek_noise) is not a change: 1e-16 against 1e-17 deg/m, 0 against 1e-6 N.
module ek_change
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_quantity, only: all_quantities, unit_of, unit_text, unit_ending
   use ek_noise, only: widths, noise_of, is_noise, solved
   implicit none(type, external)
   private
   public :: least_of, change_of, verdict_of, letter_of, has_changed, relative_change
   public :: changed, same, unknown, only_in

   character(*), parameter :: changed = 'changed', same = 'same', unknown = 'not a number', only_in = 'only in '

contains

   !> The least span of a chart in a unit (ek_quantity). For the unit of a slope that no quantity has, it is the span of the
   !> numerator over the usual window; 0 for an unknown unit.
   pure real(wp) function least_of(unit)
      character(*), intent(in) :: unit          !! 'deg/m'
      integer :: at, k

      least_of = least_span(unit)
      at = index(unit, '/')
      if (least_of > 0.0_wp .or. at == 0) return
      k = findloc(widths%unit, unit(at + 1:), dim=1)
      if (k > 0) least_of = least_span(unit(:at - 1))/widths(k)%width
   end function least_of

   !> The smallest of the least spans of all quantities in a unit; 0 if no quantity has this unit.
   pure real(wp) function least_span(unit)
      character(*), intent(in) :: unit
      integer :: k

      least_span = huge(1.0_wp)
      do k = 1, size(all_quantities)
         if (.not. all_quantities(k)%span > 0.0_wp) cycle
         if (unit_text(unit_of(trim(all_quantities(k)%name))) == unit) least_span = min(least_span, all_quantities(k)%span)
      end do
      if (least_span >= huge(1.0_wp)) least_span = 0.0_wp
   end function least_span

   !> The change (b − a) as a share of a scale: |a|, or the least span if that is larger. 0 if the difference is only rounding
   !> noise of the usual tolerance of a case (ek_noise); NaN if a or b is missing.
   elemental real(wp) function change_of(a, b, least, unit)
      real(wp), intent(in) :: a, b              !! in the unit
      real(wp), intent(in) :: least             !! least span, in the unit
      character(*), intent(in) :: unit          !! 'deg/m'
      real(wp) :: larger

      change_of = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. (ieee_is_finite(a) .and. ieee_is_finite(b))) return
      change_of = 0.0_wp
      larger = max(abs(a), abs(b))
      if (is_noise(b - a, unit_ending(unit), larger, solved)) return
      change_of = (b - a)/max(abs(a), least, noise_of(unit_ending(unit), 0.0_wp, solved))
   end function change_of

   !> Computes the change of magnitude from a to b in percent of a, whatever the least span: −55.4 for −2 → −0.892. NaN where a
   !> percentage has no meaning, and `reason` is then 'from 0' or 'opposite sign'; '' if a or b is missing. Both 0: 0. A value that
   !> is only rounding noise (ek_noise) counts as 0.
   pure subroutine relative_change(a, b, unit, percent, reason)
      real(wp), intent(in) :: a, b              !! in the unit
      character(*), intent(in) :: unit          !! 'deg/m'
      real(wp), intent(out) :: percent
      character(:), allocatable, intent(out) :: reason
      real(wp) :: nothing                       ! noise of a value 0

      nothing = noise_of(unit_ending(unit), 0.0_wp, solved)
      reason = ''
      percent = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. (ieee_is_finite(a) .and. ieee_is_finite(b))) return
      if (max(abs(a), abs(b)) <= nothing) then
         percent = 0.0_wp
      else if (abs(a) <= nothing) then
         reason = 'from 0'
      else if (abs(b) > nothing .and. a*b < 0.0_wp) then
         reason = 'opposite sign'
      else if (abs(b - a) < huge(1.0_wp)*min(1.0_wp, abs(a))/100) then
         percent = 100*((abs(b) - abs(a))/abs(a))
      end if
   end subroutine relative_change

   !> Whether the magnitude of a change exceeds the threshold.
   elemental logical function has_changed(change, threshold)
      real(wp), intent(in) :: change, threshold

      has_changed = .false.
      if (ieee_is_finite(change)) has_changed = abs(change) > threshold
   end function has_changed

   !> Verdict on a row of the first result and of another result: 'changed', 'same', 'not a number', 'only in A' (or another
   !> letter), or 'in neither'.
   pure function verdict_of(change, threshold, is_in_first, is_in_other, other) result(words)
      real(wp), intent(in) :: change, threshold
      logical, intent(in) :: is_in_first, is_in_other
      integer, intent(in) :: other                 !! index of the other result
      character(12) :: words

      words = same
      if (.not. ieee_is_finite(change)) words = unknown
      if (has_changed(change, threshold)) words = changed
      if (is_in_first .and. .not. is_in_other) words = only_in//letter_of(1)
      if (is_in_other .and. .not. is_in_first) words = only_in//letter_of(other)
      if (.not. is_in_first .and. .not. is_in_other) words = 'in neither'
   end function verdict_of

   !> The letter of a result: A for the first result. After 26 results, the letters begin again at A.
   pure character(1) function letter_of(result)
      integer, intent(in) :: result
      letter_of = achar(iachar('A') + modulo(result - 1, 26))
   end function letter_of

end module ek_change
