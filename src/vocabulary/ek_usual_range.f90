!> Usual ranges of key numbers, by class and position of an axle, each with its source; and neutral bands.
!>
!> The ranges are those that the sources call typical. A value beyond a range by at most half of its width is at the edge; farther
!> away, or with the opposite sign (toe-in instead of toe-out in bump), it is outside. A quantity, class or position without a
!> source has no row, and a key number without a row has no assessment. These ranges judge a design; the limits of plausibility,
!> by which `check` finds errors of input, are in ek_plausible_range.
module ek_usual_range
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp, degree
   implicit none(type, external)
   private
   public :: usual_t, find_usual, place_in, neutral_band, class_words, has_ranges
   public :: class_names, word_length, inside, at_edge, outside

   character(*), parameter :: class_names(5) = [character(8) :: 'car', 'sports', 'formula', 'suv', 'truck']

   integer, parameter :: word_length = 11
   character(word_length), parameter :: inside = 'inside', at_edge = 'at the edge', outside = 'outside'

   !> A usual range, with its source.
   type :: usual_t
      logical :: is_known = .false.
      real(wp) :: low = 0.0_wp, high = 0.0_wp      !! in the unit of the key number
      logical :: is_of_position = .false.          !! another range applies to the other axle of the car
      character(:), allocatable :: source
   end type usual_t

   integer, parameter :: front = -1, rear = 1, both = 0

   ! Sources
   integer, parameter :: giraffa = 1, bump_steer = 2, roll_centre = 3, torque = 4, gillespie = 5
   character(*), parameter :: sources(5) = [character(170) :: &
      'M. Giraffa, Springs & Dampers, part 1, OptimumG Tech Tip: passenger cars, sedan race cars and formula cars', &
      'suspensiondesigner.com, KPI - Bump/Roll Steer: production cars', &
      'race.software, Roll Centre Height: production cars; trailing arms have it on the road', &
      'race.software, Tyre Torque Compliance: production cars', &
      'T. D. Gillespie, Fundamentals of Vehicle Dynamics, SAE 1992, chapter 7: anti-dive seldom exceeds 50 %']

   !> The range of a key number for some classes.
   type :: range_t
      character(24) :: number
      character(16) :: classes                     !! names of classes, with a blank after each
      integer :: position                          !! front, rear or both
      real(wp) :: low, high
      integer :: source
      logical :: is_of_travel = .false.            !! per roll angle; the limits are per travel of a wheel in roll [deg/m]
   end type range_t

   ! Bump toe and roll steer: the source gives deg/m, for travel in bump and in roll. Per degree of roll, a wheel at half the track
   ! moves by half the track times pi/180. Roll steer is positive to the left in a right turn: at the front understeer, at the rear
   ! oversteer. Aligning torque: 0.5 to 1.5 deg/(kN m); a smaller compliance is no fault, so the range begins at 0. Roll centre:
   ! front 0 to 100 mm, rear 50 to 150 mm, and 0 for trailing arms whose axes are parallel to the road. Ride frequency: 0.5 to
   ! 1.5 Hz of passenger cars, 1.5 to 2 Hz of sedan race cars and formula cars of moderate downforce, 3 to 5 Hz of high downforce; a
   ! sports car lies between a passenger car and a sedan race car. Trucks have no row: no source with ranges was found.
   type(range_t), parameter :: ranges(*) = [ &
      range_t('ride_frequency_hz', 'car suv ', both, 0.5_wp, 1.5_wp, giraffa), &
      range_t('ride_frequency_hz', 'sports ', both, 0.5_wp, 2.0_wp, giraffa), &
      range_t('ride_frequency_hz', 'formula ', both, 1.5_wp, 5.0_wp, giraffa), &
      range_t('bump_toe', 'car sports suv ', front, -10.0_wp, -2.0_wp, bump_steer), &
      range_t('bump_toe', 'car sports suv ', rear, 0.0_wp, 4.0_wp, bump_steer), &
      range_t('wheel_roll_steer', 'car sports suv ', front, 2.0_wp, 10.0_wp, bump_steer, .true.), &
      range_t('wheel_roll_steer', 'car sports suv ', rear, -4.0_wp, 0.0_wp, bump_steer, .true.), &
      range_t('roll_centre_height_mm', 'car sports suv ', front, 0.0_wp, 100.0_wp, roll_centre), &
      range_t('roll_centre_height_mm', 'car sports suv ', rear, 0.0_wp, 150.0_wp, roll_centre), &
      range_t('aligning_torque_steer', 'car sports suv ', both, 0.0_wp, 0.15_wp, torque), &
      range_t('anti_dive_percent', 'car sports suv ', front, 0.0_wp, 50.0_wp, gillespie)]

   !> The neutral band of a unit: smaller magnitudes have no effect worth a word. An angle of 0.01 deg is the noticeable change of
   !> an angle (ek_noticeable): per degree of roll, per kN, per 100 N m, and in 20 mm of travel.
   type :: neutral_t
      character(12) :: unit
      real(wp) :: half
   end type neutral_t
   type(neutral_t), parameter :: neutrals(*) = [neutral_t('deg/m', 0.5_wp), neutral_t('deg/deg', 0.01_wp), &
      neutral_t('deg/kN', 0.01_wp), neutral_t('deg/100 N m', 0.01_wp), neutral_t('mm', 1.0_wp), neutral_t('%', 1.0_wp)]

contains

   !> Finds the usual range of a key number; `is_known` is .false. without a source for this class and position.
   pure subroutine find_usual(number, class, position, track, usual)
      character(*), intent(in) :: number           !! name without left_ and right_
      integer, intent(in) :: class                 !! index in `class_names`; 0: not given
      integer, intent(in) :: position              !! −1 front, 1 rear, 0 not known
      real(wp), intent(in) :: track                !! total track [m]; NaN if not known
      type(usual_t), intent(out) :: usual
      real(wp) :: factor
      integer :: k

      if (class == 0 .or. position == 0) return
      do k = 1, size(ranges)
         if (ranges(k)%number /= number .or. all(ranges(k)%position /= [both, position])) cycle
         if (index(' '//ranges(k)%classes, ' '//trim(class_names(class))//' ') == 0) cycle
         factor = 1.0_wp
         if (ranges(k)%is_of_travel) then
            if (.not. ieee_is_finite(track)) return
            factor = track/2*degree
         end if
         usual%is_known = .true.
         usual%low = factor*ranges(k)%low
         usual%high = factor*ranges(k)%high
         usual%is_of_position = ranges(k)%position /= both
         usual%source = trim(sources(ranges(k)%source))
         return
      end do
   end subroutine find_usual

   !> Whether any key number of a class has a usual range.
   pure logical function has_ranges(class)
      integer, intent(in) :: class                 !! index in `class_names`
      integer :: k

      has_ranges = .false.
      do k = 1, size(ranges)
         if (index(' '//ranges(k)%classes, ' '//trim(class_names(class))//' ') > 0) has_ranges = .true.
      end do
   end function has_ranges

   !> Assesses a value by a usual range: 'inside', 'at the edge' or 'outside'.
   pure function place_in(value, usual, neutral) result(word)
      real(wp), intent(in) :: value
      type(usual_t), intent(in) :: usual
      real(wp), intent(in) :: neutral              !! half width of the neutral band
      character(word_length) :: word
      real(wp) :: beyond

      word = inside
      beyond = max(usual%low - value, value - usual%high)
      if (usual%low >= 0.0_wp .and. value < -neutral .or. usual%high <= 0.0_wp .and. value > neutral) then
         word = outside
      else if (beyond > (usual%high - usual%low)/2) then
         word = outside
      else if (beyond > 0.0_wp .and. .not. (abs(value) <= neutral .and. abs(usual%low*usual%high) <= 0.0_wp)) then
         word = at_edge
      end if
   end function place_in

   !> Half width of the neutral band of a unit; 0 for a unit without such a band.
   pure real(wp) function neutral_band(unit) result(half)
      character(*), intent(in) :: unit             !! unit as a label: 'deg/kN'
      integer :: k

      half = 0.0_wp
      k = findloc(neutrals%unit, unit, dim=1)
      if (k > 0) half = neutrals(k)%half
   end function neutral_band

   !> The class in a sentence: 'a car', 'an SUV'.
   pure function class_words(class) result(words)
      integer, intent(in) :: class                 !! index in `class_names`
      character(:), allocatable :: words
      character(*), parameter :: names(size(class_names)) = [character(14) :: 'a car', 'a sports car', 'a formula car', 'an SUV', &
         'a truck']

      words = trim(names(class))
   end function class_words

end module ek_usual_range
