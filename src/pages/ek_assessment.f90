!> The assessment of a key number: whether it is inside its target or its usual range, and its meaning for an engineer. The strings
!> follow from numbers only, so that terminal, page, JSON and comparison use the same terms.
module ek_assessment
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp, millimetre
   use ek_text, only: str
   use ek_key_number, only: key_number_t, has_value, nothing
   use ek_number_words, only: steer_effect, target_verdict, mean_value, is_equal, is_opposite, sides_text
   use ek_usual_range, only: usual_t, find_usual, place_in, neutral_band, class_words, class_names, has_ranges, word_length, &
      inside, at_edge, outside
   use ek_page, only: page_number
   implicit none(type, external)
   private
   public :: axle_kind_t, assessment_t, assess, assessment_words, meaning_of, kind_words, number_named, is_judged, rank_of

   !> The axle as far as usual ranges depend on it.
   type :: axle_kind_t
      integer :: class = 0                     !! index in class_names; 0: not given
      integer :: position = 0                  !! −1 front, 1 rear, 0 not known
      logical :: is_driven = .true.            !! a share of the driving force acts on this axle
      logical :: gives_drive = .false.         !! the deck gives this share
      logical :: gives_sprung_mass = .false.   !! the deck gives the sprung mass of each wheel
   end type axle_kind_t

   !> The place of a key number relative to its target or its usual range.
   type :: assessment_t
      character(word_length) :: word = ''      !! 'inside', 'at the edge', 'outside'; '' without a target and a usual range
      logical :: is_target = .false.           !! the range is the target of the deck
      type(usual_t) :: usual                   !! the usual range, if there is no target
   end type assessment_t

   character(*), parameter :: driving(*) = [character(24) :: 'anti_lift_drive_percent', 'anti_squat_percent', &
      'drive_lift_mm_per_g', 'drive_squat_mm_per_g']

contains

   !> Compares a key number with its target, or else by the usual range of the axle. The word is that of the worse wheel.
   subroutine assess(number, kind, numbers, assessment)
      type(key_number_t), intent(in) :: number
      type(axle_kind_t), intent(in) :: kind
      type(key_number_t), intent(in) :: numbers(:)       !! of the report, for the track
      type(assessment_t), intent(out) :: assessment
      real(wp) :: values(2)
      character(word_length) :: word
      integer :: k

      if (.not. has_value(number)) return
      if (number%has_target) then
         assessment%is_target = .true.
         assessment%word = target_verdict(number)
         return
      end if
      call find_usual(number%name, kind%class, kind%position, track_of(numbers), assessment%usual)
      if (.not. assessment%usual%is_known) return
      values = [number%left, number%right]
      if (number%is_of_axle) values(2) = values(1)
      do k = 1, 2
         if (.not. ieee_is_finite(values(k))) cycle
         word = place_in(values(k), assessment%usual, neutral_band(number%unit))
         if (rank_of(word) < rank_of(assessment%word)) assessment%word = word
      end do
   end subroutine assess

   !> The order of a word in a list: outside first.
   pure integer function rank_of(word) result(rank)
      character(*), intent(in) :: word

      rank = findloc([character(word_length) :: outside, at_edge, inside], word, dim=1)
      if (rank == 0) rank = 4
   end function rank_of

   !> The total track at design [m]; NaN if no key number gives it.
   real(wp) function track_of(numbers) result(track)
      type(key_number_t), intent(in) :: numbers(:)
      integer :: k

      track = nothing()
      k = number_named(numbers, 'total_track_mm')
      if (k > 0) track = numbers(k)%left*millimetre
   end function track_of

   !> The index of a key number that has a value; 0 if there is none.
   pure integer function number_named(numbers, name) result(k)
      type(key_number_t), intent(in) :: numbers(:)
      character(*), intent(in) :: name             !! without left_ and right_

      do k = 1, size(numbers)
         if (numbers(k)%name == name .and. has_value(numbers(k))) return
      end do
      k = 0
   end function number_named

   !> Whether a key number belongs in the assessment of an axle: the response to driving only if the axle is driven.
   pure logical function is_judged(name, kind)
      character(*), intent(in) :: name
      type(axle_kind_t), intent(in) :: kind
      is_judged = kind%is_driven .or. .not. any(driving == name)
   end function is_judged

   !> The range of an assessment as a phrase: 'usual for the front axle of a car (−10 … −2)', 'outside the target ≤ −10'; '' without a
   !> range.
   function assessment_words(number, kind, assessment) result(words)
      type(key_number_t), intent(in) :: number
      type(axle_kind_t), intent(in) :: kind
      type(assessment_t), intent(in) :: assessment
      character(:), allocatable :: words, of

      words = ''
      if (assessment%word == '') return
      if (assessment%is_target) then
         words = trim(assessment%word)//' the target '//limits_words(number%target(1), number%target(2), 4)
         return
      end if
      of = class_words(kind%class)
      if (assessment%usual%is_of_position) of = 'the '//trim(merge('front', 'rear ', kind%position < 0))//' axle of '//of
      select case (assessment%word)
      case (inside)
         words = 'usual for '//of
      case (at_edge)
         words = 'at the edge of the usual range for '//of
      case default
         words = 'outside the usual range for '//of
      end select
      words = words//' ('//limits_words(assessment%usual%low, assessment%usual%high, 3)//')'
   end function assessment_words

   !> Limits as a phrase: '−30 … −20', '≤ −10' or '≥ 2'.
   pure function limits_words(low, high, digits) result(words)
      real(wp), intent(in) :: low, high           !! ∓huge if not given
      integer, intent(in) :: digits
      character(:), allocatable :: words

      if (low <= -huge(1.0_wp)) then
         words = '≤ '//short(high, digits)
      else if (high >= huge(1.0_wp)) then
         words = '≥ '//short(low, digits)
      else
         words = short(low, digits)//' … '//short(high, digits)
      end if
   end function limits_words

   !> A limit without trailing zeros, with the minus sign of the page.
   pure function short(limit, digits) result(text)
      real(wp), intent(in) :: limit
      integer, intent(in) :: digits
      character(:), allocatable :: text

      text = str(abs(limit), digits)
      if (limit < 0.0_wp) text = '−'//text
   end function short

   !> The axle as a phrase: 'car, front axle, driven', or that the class is not given.
   function kind_words(kind) result(words)
      type(axle_kind_t), intent(in) :: kind
      character(:), allocatable :: words

      words = 'class of the axle not given: no usual ranges'
      if (kind%class == 0 .or. kind%position == 0) return
      words = trim(class_names(kind%class))//', '//trim(merge('front', 'rear ', kind%position < 0))//' axle, '// &
         trim(merge('driven  ', 'undriven', kind%is_driven))
      if (.not. kind%gives_drive) words = words//' (assumed: drive_share not given)'
      if (.not. has_ranges(kind%class)) words = words//'; no usual range is known for '//class_words(kind%class)
   end function kind_words

   !> The meaning of a key number: 'toe-out in bump, roll understeer 1.5 %', 'understeer', 'neutral'; '' if the value has no
   !> particular meaning.
   function meaning_of(number, kind, numbers) result(words)
      type(key_number_t), intent(in) :: number
      type(axle_kind_t), intent(in) :: kind
      type(key_number_t), intent(in) :: numbers(:)       !! of the report
      character(:), allocatable :: words
      real(wp) :: value
      logical :: is_neutral

      words = ''
      value = mean_value(number)
      if (.not. ieee_is_finite(value)) return
      is_neutral = abs(largest_of(number)) <= neutral_band(number%unit)
      select case (number%name)
      case ('bump_toe')
         words = one_way(number, is_neutral, 'toe-in in bump', 'toe-out in bump')
         if (.not. is_neutral) words = words//roll_words(numbers, kind%position)
      case ('bump_camber')
         words = one_way(number, is_neutral, 'top outward in bump', 'top inward in bump')
      case ('roll_centre_height_mm')
         if (is_neutral) words = 'on the road'
         if (.not. is_neutral .and. value < 0.0_wp) words = 'under the road'
      case ('braking_steer', 'braking_height_held_steer_deg_per_kn')
         words = sides_text(number)
         if (index(words//'|', ' on both|') > 0) words = words//' wheels'
         if (index(words, 'both wheels') /= 1 .and. index(words, 'toe-') /= 1) words = ''
         if (is_neutral) words = 'neutral'
      case ('anti_dive_percent')
         words = anti_words(value, is_neutral, 'dive')
      case ('anti_lift_brake_percent', 'anti_lift_drive_percent')
         words = anti_words(value, is_neutral, 'lift')
      case ('anti_squat_percent')
         words = anti_words(value, is_neutral, 'squat')
      case ('ride_frequency_hz')
         words = 'of the sprung mass'
         if (.not. kind%gives_sprung_mass) words = 'of the whole wheel load, as sprung_mass is not given'
      case ('wheel_roll_steer')
         words = trim(steer_effect(number, kind%position))
         if (.not. is_neutral .and. words /= '' .and. kind%position /= 0) words = words//' '//percent_words(value)
      case default
         words = trim(steer_effect(number, kind%position))
      end select
   end function meaning_of

   !> One of two phrases by the sign of a value that is equal on both wheels; otherwise the directions of both wheels.
   function one_way(number, is_neutral, positive, negative) result(words)
      type(key_number_t), intent(in) :: number
      logical, intent(in) :: is_neutral
      character(*), intent(in) :: positive, negative
      character(:), allocatable :: words

      words = 'neutral'
      if (is_neutral) return
      words = negative
      if (mean_value(number) > 0.0_wp) words = positive
      if (number%is_of_axle .or. .not. (ieee_is_finite(number%left) .and. ieee_is_finite(number%right))) return
      if (number%left*number%right < 0.0_wp) words = ''
      if (is_opposite(number)) words = sides_text(number)//' in bump'
   end function one_way

   !> The effect of bump toe in roll, from the key number of roll steer: ', roll understeer 1.5 %'; '' if it is not known.
   function roll_words(numbers, position) result(words)
      type(key_number_t), intent(in) :: numbers(:)
      integer, intent(in) :: position
      character(:), allocatable :: words
      integer :: k

      words = ''
      k = number_named(numbers, 'wheel_roll_steer')
      if (k == 0 .or. position == 0) return
      words = ', neutral in roll'
      if (steer_effect(numbers(k), position) /= 'neutral') words = ', roll '//trim(steer_effect(numbers(k), position))//' '// &
         percent_words(mean_value(numbers(k)))
   end function roll_words

   !> The magnitude of a ratio in percent with two digits: '1.5 %'.
   pure function percent_words(ratio) result(words)
      real(wp), intent(in) :: ratio
      character(:), allocatable :: words
      words = str(100*abs(ratio), 2)//' %'
   end function percent_words

   !> 'none' for a feature near 0 %, 'pro-dive' for a negative one.
   pure function anti_words(value, is_neutral, motion) result(words)
      real(wp), intent(in) :: value
      logical, intent(in) :: is_neutral
      character(*), intent(in) :: motion
      character(:), allocatable :: words

      words = ''
      if (is_neutral) then
         words = 'none'
      else if (value < 0.0_wp) then
         words = 'pro-'//motion
      end if
   end function anti_words

   !> The larger magnitude of the values of both wheels.
   pure real(wp) function largest_of(number) result(value)
      type(key_number_t), intent(in) :: number

      value = 0.0_wp
      if (ieee_is_finite(number%left)) value = abs(number%left)
      if (number%is_of_axle .or. .not. ieee_is_finite(number%right)) return
      value = max(value, abs(number%right))
   end function largest_of

end module ek_assessment
