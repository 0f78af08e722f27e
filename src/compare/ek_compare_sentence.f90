!> The first line of a comparison: what changed most for an engineer, and why, in one sentence for each result:
!>
!>     bump toe 2.47 → -0.31 deg/m (toe-out in bump now, toe-in in bump before), roll rate +8 %; cause: tie_rod_inner.z +5 mm
!>
!> A change of a word (understeer to oversteer, inside to outside) is before all others. The others are in the order of their sizes
!> in noticeable steps. Numbers that state one fact have one place. A change below one step is not mentioned.
module ek_compare_sentence
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str, lower
   use ek_quantity, only: unit_ending
   use ek_noise, only: is_noise, solved
   use ek_change, only: relative_change, letter_of
   use ek_key_number, only: key_number_t, nothing
   use ek_key_numbers, only: without_side
   use ek_number_words, only: short_name, steer_effect, is_equal, is_opposite
   use ek_usual_range, only: class_names
   use ek_assessment, only: axle_kind_t, assessment_t, assess, meaning_of
   use ek_deck_file, only: deck_record_t
   use ek_compare_cause, only: cause_text, settings_text
   use ek_compare_targets, only: read_target
   use ek_comparison, only: comparison_t, difference_t, descending, largest_lines
   implicit none(type, external)
   private
   public :: sentences_of

   integer, parameter :: most_items = 3

   !> A key number by which changes are ranked, with its noticeable step.
   type :: rank_t
      character(32) :: name            !! '*' at the beginning stands for any letters
      real(wp) :: step                 !! in the unit of the number; as a share of its value in A if is_share
      logical :: is_share
      integer :: fact                  !! numbers of the same fact have one place: the first one that changed
   end type rank_t

   ! Steer: 0.05 deg/m in bump (0.001 deg in 20 mm), 0.005 deg per kN, per 100 N m, per degree of roll. Camber acts on a tyre ten times
   ! less than steer. Rates: 1 %. Roll centre: 5 mm.
   type(rank_t), parameter :: ranks(*) = [ &
      rank_t('bump_toe', 0.05_wp, .false., 1), rank_t('bump_steer', 0.05_wp, .false., 1), &
      rank_t('wheel_roll_steer', 0.005_wp, .false., 2), rank_t('lateral_force_steer', 0.005_wp, .false., 3), &
      rank_t('aligning_torque_steer', 0.005_wp, .false., 4), rank_t('braking_steer', 0.005_wp, .false., 5), &
      rank_t('traction_steer', 0.005_wp, .false., 6), rank_t('roll_centre_height_mm', 5.0_wp, .false., 7), &
      rank_t('wheel_rate', 0.01_wp, .true., 8), rank_t('wheel_rate_n_per_mm', 0.01_wp, .true., 8), &
      rank_t('ride_frequency_hz', 0.01_wp, .true., 8), rank_t('suspension_roll_rate_nm_per_deg', 0.01_wp, .true., 9), &
      rank_t('bump_camber', 0.5_wp, .false., 10), rank_t('wheel_roll_camber', 0.05_wp, .false., 10), &
      rank_t('lateral_force_camber', 0.05_wp, .false., 11), rank_t('lateral_deflection', 0.01_wp, .true., 12), &
      rank_t('braking_deflection', 0.01_wp, .true., 13), rank_t('fore_aft_stiffness_n_per_mm', 0.01_wp, .true., 13), &
      rank_t('traction_deflection', 0.01_wp, .true., 13), rank_t('anti_dive_percent', 1.0_wp, .false., 14), &
      rank_t('anti_lift_brake_percent', 1.0_wp, .false., 15), rank_t('anti_lift_drive_percent', 1.0_wp, .false., 16), &
      rank_t('anti_squat_percent', 1.0_wp, .false., 17), rank_t('vertical_force_n', 0.01_wp, .true., 18), &
      rank_t('toe_deg', 0.02_wp, .false., 19), rank_t('camber_deg', 0.1_wp, .false., 20), &
      rank_t('caster_deg', 0.1_wp, .false., 21), rank_t('kingpin_inclination_deg', 0.1_wp, .false., 22), &
      rank_t('scrub_radius_mm', 1.0_wp, .false., 23), rank_t('caster_trail_mm', 1.0_wp, .false., 21), &
      rank_t('total_track_mm', 1.0_wp, .false., 24), rank_t('half_track_change', 0.01_wp, .false., 7), &
      rank_t('steering_ratio', 0.01_wp, .true., 25), rank_t('largest_steer_deg', 0.2_wp, .false., 26), &
      rank_t('smallest_turning_circle_m', 0.05_wp, .false., 26), rank_t('largest_ackermann_percent', 2.0_wp, .false., 27), &
      rank_t('travel_to_bump_stop', 1.0_wp, .false., 28), rank_t('travel_to_rebound_stop', 1.0_wp, .false., 29), &
      rank_t('*_motion_ratio', 0.01_wp, .true., 30)]

   !> A change of a key number.
   type :: item_t
      character(:), allocatable :: text
      real(wp) :: steps = 0.0_wp       !! size of the change in noticeable steps
      logical :: is_flip = .false.     !! its word changed
      integer :: fact = 0
   end type item_t

contains

   !> Lists one sentence for each result after A; with more than two results, each begins with its letter.
   subroutine sentences_of(this, lines)
      type(comparison_t), intent(in) :: this
      type(message_list_t), intent(out) :: lines
      type(item_t), allocatable :: items(:)
      character(:), allocatable :: line, effects
      integer :: r

      line = ''
      do r = 2, size(this%results)
         call find_items(this, r, items)
         effects = effects_text(items)
         if (size(this%numbers) == 0) effects = gradient_text(this)
         if (this%results(1)%program /= '') effects = program_text(this)
         line = effects//cause_text(this%results, this%deck, r)//settings_text(this%results, this%deck, this%facts, r)
         if (size(this%results) > 2) line = letter_of(r)//': '//line
         call lines%add(line)
      end do
   end subroutine sentences_of

   !> The changes as a phrase: at most three, or that nothing noticeable changed.
   function effects_text(items) result(text)
      type(item_t), intent(in) :: items(:)             !! sorted
      character(:), allocatable :: text
      integer :: k

      text = 'no main K&C metric changed noticeably'
      do k = 1, min(size(items), most_items)
         if (k == 1) text = items(1)%text
         if (k > 1) text = text//', '//items(k)%text
      end do
   end function effects_text

   !> The largest change of a gradient, for results without key numbers.
   function gradient_text(this) result(text)
      type(comparison_t), intent(in) :: this
      character(:), allocatable :: text
      type(message_list_t) :: largest

      largest = largest_lines(this%shown, this%threshold, 1)
      text = 'no gradient changed by more than '//str(100*this%threshold, 4)//' %'
      if (largest%count() > 0) text = largest%line(1)
   end function gradient_text

   !> The largest change of a number in the definitions of another program, or the number of curves that changed.
   function program_text(this) result(text)
      type(comparison_t), intent(in) :: this
      character(:), allocatable :: text
      type(message_list_t) :: largest

      largest = largest_lines(this%shown, this%threshold, 1)
      text = str(count(this%changes%is_changed))//' of '//str(size(this%changes))//' charts changed by more than '// &
         str(100*this%threshold, 4)//' %'
      if (largest%count() > 0) text = largest%line(1)
   end function program_text

   !> Finds the changes of result r, sorted: changes of a word first, then by size; one for each fact.
   subroutine find_items(this, r, items)
      type(comparison_t), intent(in) :: this
      integer, intent(in) :: r
      type(item_t), allocatable, intent(out) :: items(:)
      type(key_number_t), allocatable :: before(:), after(:)
      type(axle_kind_t) :: kinds(2)
      type(item_t) :: item
      integer :: rank, k, l, used

      allocate (items(size(ranks) + size(this%numbers)))
      used = 0
      before = numbers_of(this%numbers, 1, this%results(1)%deck)
      after = numbers_of(this%numbers, r, this%results(r)%deck)
      kinds = [kind_of(this%results(1)%deck), kind_of(this%results(r)%deck)]
      do rank = 1, size(ranks)
         do k = 1, size(before)
            if (.not. is_named(before(k)%name, ranks(rank)%name)) cycle
            call make_item(before, after, k, kinds, ranks(rank), item)
            if (item%steps < 1.0_wp .and. .not. item%is_flip) cycle
            do l = 1, used
               if (items(l)%fact == item%fact) exit
            end do
            if (l <= used) then
               if (items(l)%is_flip .or. .not. item%is_flip) cycle
            else
               used = l
            end if
            items(l) = item
         end do
      end do
      items = items(:used)
      items = items(descending([(items(k)%steps + merge(1.0e9_wp, 0.0_wp, items(k)%is_flip), k=1, used)]))
   end subroutine find_items

   !> Whether a name is that of a row of the table.
   pure logical function is_named(name, row)
      character(*), intent(in) :: name, row
      integer :: length

      is_named = name == row
      if (row(1:1) /= '*') return
      length = len_trim(row) - 1
      if (len(name) >= length) is_named = name(len(name) - length + 1:) == row(2:length + 1)
   end function is_named

   !> Creates the item of key number k. The steps are those of the wheel that changed more; Differences that are NaN or noise do not count.
   subroutine make_item(before, after, k, kinds, rank, item)
      type(key_number_t), intent(in) :: before(:), after(:)
      integer, intent(in) :: k
      type(axle_kind_t), intent(in) :: kinds(2)
      type(rank_t), intent(in) :: rank
      type(item_t), intent(out) :: item
      real(wp), parameter :: like = 1.001_wp
      real(wp) :: a(2), b(2), steps
      character(:), allocatable :: flip
      integer :: w, worst

      item%fact = rank%fact
      item%text = ''
      a = [before(k)%left, before(k)%right]
      b = [after(k)%left, after(k)%right]
      worst = 1
      do w = 1, merge(1, 2, before(k)%is_of_axle)
         if (.not. (ieee_is_finite(a(w)) .and. ieee_is_finite(b(w)))) cycle
         if (is_noise(b(w) - a(w), unit_ending(before(k)%unit), max(abs(a(w)), abs(b(w))), solved)) cycle
         steps = abs(b(w) - a(w))/rank%step
         if (rank%is_share) steps = abs(b(w) - a(w))/max(rank%step*abs(a(w)), tiny(1.0_wp))
         if (steps <= like*item%steps) cycle      ! opposite values of both wheels: the left one
         item%steps = steps
         worst = w
      end do
      if (.not. item%steps > 0.0_wp) return
      call find_flip(before, after, k, kinds, flip)
      item%is_flip = flip /= ''
      item%text = name_of(before(k), after(k), worst)//' '//change_text(a(worst), b(worst), before(k)%unit, rank%is_share)//flip
   end subroutine make_item

   !> The name of a key number in the sentence, with its wheel if the wheels differ.
   function name_of(before, after, wheel) result(name)
      type(key_number_t), intent(in) :: before, after
      integer, intent(in) :: wheel
      character(:), allocatable :: name

      name = short_name(before)
      if (name(2:2) < 'A' .or. name(2:2) > 'Z') then
         if (name(1:1) >= 'A' .and. name(1:1) <= 'Z') name(1:1) = achar(iachar(name(1:1)) + 32)
      end if
      if (before%is_of_axle .or. .not. (ieee_is_finite(before%left) .and. ieee_is_finite(before%right))) return
      if ((is_equal(before) .or. is_opposite(before)) .and. (is_equal(after) .or. is_opposite(after))) return
      name = trim(merge('left ', 'right', wheel == 1))//' '//name
   end function name_of

   !> A change: '+8 %' of a rate, otherwise '2.47 → 0.31 deg/m'. Where a percentage has no meaning, both values.
   function change_text(a, b, unit, is_share) result(text)
      real(wp), intent(in) :: a, b
      character(*), intent(in) :: unit
      logical, intent(in) :: is_share
      character(:), allocatable :: text, reason
      real(wp) :: percent
      integer :: digits

      if (is_share) then
         call relative_change(a, b, unit, percent, reason)
         if (ieee_is_finite(percent)) then
            text = str(percent, 2)//' %'
            if (percent > 0.0_wp) text = '+'//text
            return
         end if
      end if
      digits = 3
      do while (digits < 6 .and. str(a, digits) == str(b, digits))
         digits = digits + 1
      end do
      text = str(a, digits)//' → '//str(b, digits)
      if (unit /= '–') text = text//' '//unit
   end function change_text

   !> Finds the change of the phrases of key number k, in parentheses: ' (oversteer now, understeer before)'; '' if they are equal.
   subroutine find_flip(before, after, k, kinds, flip)
      type(key_number_t), intent(in) :: before(:), after(:)
      integer, intent(in) :: k
      type(axle_kind_t), intent(in) :: kinds(2)
      character(:), allocatable, intent(out) :: flip
      character(:), allocatable :: now, earlier
      type(assessment_t) :: was, is

      flip = ''
      earlier = word_of(before(k), kinds(1))
      now = word_of(after(k), kinds(2))
      if (now == earlier) then
         now = ''
         earlier = ''
      end if
      call assess(before(k), kinds(1), before, was)
      call assess(after(k), kinds(2), after, is)
      if (was%word /= '' .and. is%word /= '' .and. was%word /= is%word) then
         now = joined(now, trim(is%word))
         earlier = joined(earlier, trim(was%word))
      end if
      if (now == '' .or. earlier == '') return
      flip = ' ('//now//' now, '//earlier//' before)'

   contains

      !> Two phrases joined by 'and'; one if the first is empty.
      pure function joined(one, other) result(words)
         character(*), intent(in) :: one, other
         character(:), allocatable :: words

         words = other
         if (one /= '') words = one//' and '//other
      end function joined

   end subroutine find_flip

   !> The word of a key number, without sizes: 'understeer', 'toe-in in bump', 'pro-dive'; '' if it has none.
   function word_of(number, kind) result(word)
      type(key_number_t), intent(in) :: number
      type(axle_kind_t), intent(in) :: kind
      character(:), allocatable :: word
      type(key_number_t) :: none(0)

      word = ''
      select case (number%name)
      case ('ride_frequency_hz')
      case ('wheel_roll_steer', 'lateral_force_steer', 'aligning_torque_steer')
         word = trim(steer_effect(number, kind%position))
      case ('roll_centre_height_mm')
         word = meaning_of(number, kind, none)
         if (word == '') word = 'above the road'
      case ('anti_dive_percent', 'anti_lift_brake_percent', 'anti_lift_drive_percent', 'anti_squat_percent')
         word = meaning_of(number, kind, none)
         if (word == '') word = 'positive'
      case default
         word = meaning_of(number, kind, none)
      end select
   end function word_of

   !> The key numbers of a result, both wheels in one, with the targets of its deck.
   function numbers_of(rows, r, deck) result(numbers)
      type(difference_t), intent(in) :: rows(:)
      integer, intent(in) :: r
      type(deck_record_t), intent(in) :: deck
      type(key_number_t), allocatable :: numbers(:)
      character(:), allocatable :: name
      integer :: k, l, used

      allocate (numbers(size(rows)))
      used = 0
      do k = 1, size(rows)
         name = trim(without_side(trim(rows(k)%column)))
         do l = 1, used
            if (numbers(l)%name == name) exit
         end do
         if (l > used) then
            used = l
            numbers(l)%name = name
            numbers(l)%quantity = trim(rows(k)%quantity)
            numbers(l)%unit = trim(rows(k)%unit)
            numbers(l)%sign = ''
            numbers(l)%left = nothing()
            numbers(l)%right = nothing()
            numbers(l)%is_of_axle = rows(k)%side == ''
            call read_target(deck, name, numbers(l)%target, numbers(l)%has_target)
         end if
         if (rows(k)%side == 'right') numbers(l)%right = rows(k)%values(r)
         if (rows(k)%side /= 'right') numbers(l)%left = rows(k)%values(r)
      end do
      numbers = numbers(:used)
   end function numbers_of

   !> The class and position of the axle, as the deck of a result gives them.
   type(axle_kind_t) function kind_of(deck) result(kind)
      type(deck_record_t), intent(in) :: deck
      integer :: k, l

      do k = 1, deck%paths%count()
         select case (deck%paths%line(k))
         case ('axle.class')
            do l = 1, size(class_names)
               if (class_names(l) == lower(deck%texts%line(k))) kind%class = l
            end do
         case ('axle.position')
            kind%position = merge(-1, 1, lower(deck%texts%line(k)) == 'front')
         end select
      end do
   end function kind_of

end module ek_compare_sentence
