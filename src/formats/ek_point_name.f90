!> Names of hardpoints as other programs and people write them: the point of a suspension that a name stands for, with its axle
!> and its side.
!>
!> A name is divided into known terms, each of which stands for some letters: 'lower wishbone front pivot' has L, A, F and V. A
!> point of `points` is meant if all letters that it needs are there, and no letter beyond those that it may have. A name with a
!> term that is not in the list stands for no point: nothing is guessed. Steering and guides of a solid axle other than rods have
!> their names of `point_names` only.
!>
!> Letters: L lower, U upper, F front, R rear, I inner or chassis, O outer or wheel carrier, A arm, B ball joint, T tie rod,
!> E toe link, K rack, W wheel, C centre, P contact point, S strut, D damper, G spring, H push or pull rod, X rocker, Z axis,
!> V pivot or bushing, Q trailing, N link, J rod, Y anti-roll bar, M attachment, t axle tube, p Panhard rod, k kingpin,
!> 1 first, 2 second.
module ek_point_name
   use ek_text, only: lower, nearest_name
   implicit none(type, external)
   private
   public :: meaning_t, hints_t, meaning_of, hints_in, nearest_point, point_count, point_names, unused_point
   public :: wheel_centre, contact_patch, lca_front, lca_rear, lower_ball, uca_front, uca_rear, upper_ball, tie_inner, tie_outer, &
      toe_inner, toe_outer, strut_top, strut_low, push_low, push_top, rocker_pivot, rocker_axis, damper_inner, damper_outer, &
      arm_inner, arm_outer, upper_front_in, upper_front_out, upper_rear_in, upper_rear_out, lower_in, lower_out, trailing_front, &
      trailing_rear, rack_centre, damper_top, damper_low, spring_top, spring_low, kingpin_low, kingpin_top, upper_rod_chassis, &
      upper_rod_axle, lower_rod_chassis, lower_rod_axle, panhard_chassis, panhard_axle, drag_link_chassis, drag_link_crank, &
      crank_tie_rod, crank_axle, triangle_chassis, triangle_axle, axle_pivot, watt_left_chassis, watt_left_lever, &
      watt_right_chassis, watt_right_lever, axle_guide, drag_link_knuckle, arm_ball, upper_lateral_in, upper_lateral_out, &
      lower_lateral_in, lower_lateral_out, lower_link_front, lower_link_rear, upper_link_front, upper_link_rear

   integer, parameter :: wheel_centre = 1, contact_patch = 2, lca_front = 3, lca_rear = 4, lower_ball = 5, uca_front = 6, &
      uca_rear = 7, upper_ball = 8, tie_inner = 9, tie_outer = 10, toe_inner = 11, toe_outer = 12, strut_top = 13, &
      strut_low = 14, push_low = 15, push_top = 16, rocker_pivot = 17, rocker_axis = 18, damper_inner = 19, damper_outer = 20, &
      arm_inner = 21, arm_outer = 22, upper_front_in = 23, upper_front_out = 24, upper_rear_in = 25, upper_rear_out = 26, &
      lower_in = 27, lower_out = 28, trailing_front = 29, trailing_rear = 30, rack_centre = 31, damper_top = 32, &
      damper_low = 33, spring_top = 34, spring_low = 35
   !> Points of a solid axle.
   integer, parameter :: kingpin_low = 36, kingpin_top = 37, upper_rod_chassis = 38, upper_rod_axle = 39, &
      lower_rod_chassis = 40, lower_rod_axle = 41, panhard_chassis = 42, panhard_axle = 43, drag_link_chassis = 44, &
      drag_link_crank = 45, crank_tie_rod = 46, crank_axle = 47, triangle_chassis = 48, triangle_axle = 49, &
      axle_pivot = 50, watt_left_chassis = 51, watt_left_lever = 52, watt_right_chassis = 53, watt_right_lever = 54, &
      axle_guide = 55, drag_link_knuckle = 56
   !> Points of a trailing arm on two lateral links.
   integer, parameter :: arm_ball = 57, upper_lateral_in = 58, upper_lateral_out = 59, lower_lateral_in = 60, &
      lower_lateral_out = 61
   !> Ends of the rods of a solid axle in other words: ek_point_set names the end on the tube.
   integer, parameter :: lower_link_front = 62, lower_link_rear = 63, upper_link_front = 64, upper_link_rear = 65
   integer, parameter :: point_count = 65
   integer, parameter :: unused_point = 0      !! a known part that is not read, as an anti-roll bar
   character(20), parameter :: point_names(point_count) = [character(20) :: 'wheel_centre', 'contact_patch', 'lca_front', &
      'lca_rear', 'lower_ball_joint', 'uca_front', 'uca_rear', 'upper_ball_joint', 'tie_rod_inner', 'tie_rod_outer', &
      'toe_inner', 'toe_outer', 'strut_top', 'strut_low', 'push_rod_low', 'push_rod_top', 'rocker_pivot', 'rocker_axis', &
      'damper_inner', 'damper_outer', 'arm_inner', 'arm_outer', 'upper_front_inner', 'upper_front_outer', 'upper_rear_inner', &
      'upper_rear_outer', 'lower_inner', 'lower_outer', 'trailing_front', 'trailing_rear', 'rack_centre', 'damper_top', &
      'damper_low', 'spring_top', 'spring_low', &
      'kingpin_low', 'kingpin_top', 'upper_rod_chassis', 'upper_rod_axle', 'lower_rod_chassis', 'lower_rod_axle', &
      'panhard_chassis', 'panhard_axle', 'drag_link_chassis', 'drag_link_crank', 'crank_tie_rod', 'crank_axle', &
      'triangle_chassis', 'triangle_axle', 'axle_pivot', 'watt_left_chassis', 'watt_left_lever', 'watt_right_chassis', &
      'watt_right_lever', 'axle_guide', 'drag_link_knuckle', 'arm_ball', 'upper_lateral_inner', 'upper_lateral_outer', &
      'lower_lateral_inner', 'lower_lateral_outer', 'lower_link_front', 'lower_link_rear', 'upper_link_front', 'upper_link_rear']

   !> A set of letters that stands for a point.
   type :: rule_t
      integer :: point
      character(4) :: needs
      character(6) :: may
   end type rule_t

   type(rule_t), parameter :: rules(*) = [ &
      rule_t(wheel_centre, 'WC', ''), &
      rule_t(contact_patch, 'P', 'WC'), &
      rule_t(lca_front, 'LAF', 'IV'), rule_t(lca_front, 'LIF', 'V'), rule_t(lca_front, 'LVF', ''), &
      rule_t(lca_rear, 'LAR', 'IV'), rule_t(lca_rear, 'LIR', 'V'), rule_t(lca_rear, 'LVR', ''), &
      rule_t(lower_ball, 'LB', 'AO'), rule_t(lower_ball, 'LO', 'A'), &
      rule_t(uca_front, 'UAF', 'IV'), rule_t(uca_front, 'UIF', 'V'), rule_t(uca_front, 'UVF', ''), &
      rule_t(uca_rear, 'UAR', 'IV'), rule_t(uca_rear, 'UIR', 'V'), rule_t(uca_rear, 'UVR', ''), &
      rule_t(upper_ball, 'UB', 'AO'), rule_t(upper_ball, 'UO', 'A'), &
      rule_t(tie_inner, 'TI', 'KB'), rule_t(tie_inner, 'TK', 'B'), &
      rule_t(tie_outer, 'TO', 'B'), &
      rule_t(toe_inner, 'EI', 'NBVJ'), rule_t(toe_outer, 'EO', 'NBVJ'), &
      rule_t(strut_top, 'SU', 'IV'), rule_t(strut_top, 'SI', 'V'), &
      rule_t(strut_low, 'SL', 'OV'), rule_t(strut_low, 'SO', 'V'), &
      rule_t(push_low, 'HO', 'LBM'), rule_t(push_low, 'HL', ''), rule_t(push_low, 'HA', 'LOU'), &
      rule_t(push_top, 'HX', 'IUJ'), rule_t(push_top, 'HI', ''), rule_t(push_top, 'HU', ''), rule_t(push_top, 'XJ', ''), &
      rule_t(rocker_pivot, 'XV', 'IC'), rule_t(rocker_pivot, 'XZ1', 'IV'), &
      rule_t(rocker_axis, 'XZ', 'I'), rule_t(rocker_axis, 'XZ2', 'IV'), &
      rule_t(damper_inner, 'DI', ''), rule_t(damper_inner, 'IM', ''), rule_t(damper_outer, 'DX', ''), &
      rule_t(damper_outer, 'DO', ''), rule_t(damper_outer, 'GX', ''), &
      rule_t(damper_top, 'DU', 'I'), rule_t(damper_low, 'DL', 'OA'), rule_t(damper_low, 'DA', ''), &
      rule_t(spring_top, 'GU', 'I'), rule_t(spring_top, 'GI', ''), rule_t(spring_low, 'GL', 'OA'), rule_t(spring_low, 'GA', ''), &
      rule_t(spring_low, 'GO', ''), &
      rule_t(arm_inner, 'AI', 'QV'), rule_t(arm_outer, 'AO', 'QV'), &
      rule_t(upper_front_out, 'UOF', 'N'), rule_t(upper_rear_out, 'UOR', 'N'), &
      rule_t(upper_front_in, 'UNFI', ''), rule_t(upper_rear_in, 'UNRI', ''), &
      rule_t(lower_in, 'LI', 'N'), rule_t(lower_out, 'LON', ''), &
      rule_t(trailing_front, 'QF', 'NA'), rule_t(trailing_rear, 'QR', 'NA'), &
      rule_t(rack_centre, 'KC', ''), &
      rule_t(lower_link_front, 'LNF', ''), rule_t(lower_link_front, 'LQF', 'NA'), rule_t(lower_link_rear, 'LNR', ''), &
      rule_t(lower_link_rear, 'LQR', 'NA'), rule_t(upper_link_front, 'UNF', ''), rule_t(upper_link_front, 'UQF', 'NA'), &
      rule_t(upper_link_rear, 'UNR', ''), rule_t(upper_link_rear, 'UQR', 'NA'), &
      rule_t(lower_rod_axle, 'LNt', ''), rule_t(lower_rod_axle, 'LQt', 'AN'), rule_t(lower_rod_axle, 'LJt', ''), &
      rule_t(upper_rod_axle, 'UNt', ''), rule_t(upper_rod_axle, 'UQt', 'AN'), rule_t(upper_rod_axle, 'UJt', ''), &
      rule_t(lower_rod_chassis, 'LQI', 'AN'), rule_t(lower_rod_chassis, 'LJI', ''), rule_t(upper_rod_chassis, 'UNI', ''), &
      rule_t(upper_rod_chassis, 'UQI', 'AN'), rule_t(upper_rod_chassis, 'UJI', ''), rule_t(spring_low, 'Gt', ''), &
      rule_t(panhard_chassis, 'pI', 'JYN'), rule_t(panhard_axle, 'pt', 'JYN'), &
      rule_t(kingpin_low, 'kL', 'BV'), rule_t(kingpin_top, 'kU', 'BV')]

   !> A term and its letters; a term without letters is ignored.
   type :: word_t
      character(12) :: word
      character(3) :: letters
   end type word_t

   type(word_t), parameter :: words(*) = [ &
      word_t('lower', 'L'), word_t('low', 'L'), word_t('lwr', 'L'), word_t('bottom', 'L'), word_t('bot', 'L'), &
      word_t('inferior', 'L'), word_t('unten', 'L'), word_t('untere', 'L'), word_t('unterer', 'L'), &
      word_t('upper', 'U'), word_t('upp', 'U'), word_t('upr', 'U'), word_t('up', 'U'), word_t('top', 'U'), &
      word_t('superior', 'U'), word_t('oben', 'U'), word_t('obere', 'U'), word_t('oberer', 'U'), &
      word_t('front', 'F'), word_t('frt', 'F'), word_t('fore', 'F'), word_t('for', 'F'), word_t('fwd', 'F'), &
      word_t('forward', 'F'), word_t('leading', 'F'), word_t('vorn', 'F'), word_t('vorne', 'F'), word_t('f', 'F'), &
      word_t('rear', 'R'), word_t('aft', 'R'), word_t('back', 'R'), word_t('rearward', 'R'), word_t('hinten', 'R'), &
      word_t('inner', 'I'), word_t('inn', 'I'), word_t('inboard', 'I'), word_t('inbd', 'I'), word_t('inb', 'I'), &
      word_t('in', 'I'), word_t('inr', 'I'), word_t('chassis', 'I'), word_t('chas', 'I'), word_t('body', 'I'), &
      word_t('frame', 'I'), word_t('subframe', 'I'), word_t('innen', 'I'), &
      word_t('outer', 'O'), word_t('outboard', 'O'), word_t('outbd', 'O'), word_t('outb', 'O'), word_t('out', 'O'), &
      word_t('otr', 'O'), word_t('upright', 'O'), word_t('upri', 'O'), word_t('knuckle', 'O'), word_t('carrier', 'O'), &
      word_t('hub', 'O'), word_t('aussen', 'O'), &
      word_t('arm', 'A'), word_t('wishbone', 'A'), word_t('aarm', 'A'), word_t('controlarm', 'A'), word_t('control', ''), &
      word_t('lca', 'LA'), word_t('uca', 'UA'), word_t('lwb', 'LA'), word_t('uwb', 'UA'), word_t('lfca', 'LA'), &
      word_t('ball', 'B'), word_t('bj', 'B'), word_t('balljoint', 'B'), word_t('lbj', 'LB'), word_t('ubj', 'UB'), &
      word_t('tie', 'T'), word_t('tierod', 'T'), word_t('track', 'T'), word_t('trackrod', 'T'), word_t('steering', 'T'), &
      word_t('spurstange', 'T'), &
      word_t('toe', 'E'), word_t('toelink', 'E'), word_t('toerod', 'E'), &
      word_t('rack', 'K'), word_t('wheel', 'W'), word_t('tyre', 'W'), word_t('tire', 'W'), word_t('rad', 'W'), &
      word_t('radmitte', 'WC'), word_t('wc', 'WC'), word_t('centre', 'C'), word_t('center', 'C'), word_t('centrepoint', 'C'), &
      word_t('contact', 'P'), word_t('patch', 'P'), word_t('cp', 'P'), word_t('contactpatch', 'P'), word_t('aufstand', 'P'), &
      word_t('strut', 'S'), word_t('mcpherson', ''), word_t('macpherson', ''), &
      word_t('damper', 'D'), word_t('shock', 'D'), word_t('absorber', ''), word_t('daempfer', 'D'), &
      word_t('spring', 'G'), word_t('coil', 'G'), word_t('coi', 'G'), word_t('feder', 'G'), &
      word_t('push', 'H'), word_t('pushrod', 'H'), word_t('pull', 'H'), word_t('pullrod', 'H'), word_t('nsma', 'HO'), &
      word_t('rocker', 'X'), word_t('bellcrank', 'X'), word_t('rock', 'X'), word_t('roc', 'X'), &
      word_t('axis', 'Z'), word_t('axi', 'Z'), word_t('pivot', 'V'), word_t('piv', 'V'), word_t('bushing', 'V'), &
      word_t('bush', 'V'), word_t('mount', 'V'), word_t('mounting', 'V'), &
      word_t('trailing', 'Q'), word_t('semi', ''), word_t('link', 'N'), word_t('rod', 'J'), &
      word_t('arb', 'Y'), word_t('stabilizer', 'Y'), word_t('stabiliser', 'Y'), word_t('antiroll', 'Y'), &
      word_t('drop', 'Y'), word_t('droplink', 'Y'), word_t('bar', 'Y'), &
      word_t('first', '1'), word_t('1st', '1'), word_t('second', '2'), word_t('2nd', '2'), &
      word_t('point', ''), word_t('pnt', ''), word_t('pt', ''), word_t('pp', ''), word_t('att', 'M'), word_t('joint', ''), &
      word_t('hardpoint', ''), word_t('hp', ''), word_t('hps', ''), word_t('end', ''), word_t('seat', ''), word_t('side', ''), &
      word_t('the', ''), &
      word_t('of', ''), word_t('to', ''), word_t('a', ''), word_t('on', ''), &
      word_t('at', ''), word_t('and', ''), &
      word_t('axle', 't'), word_t('tube', 't'), word_t('panhard', 'p'), word_t('trackbar', 'p'), word_t('kingpin', 'k')]

   !> Terms for a side or a corner: axle (0, 1 front, 2 rear) and side (0, 1 left, 2 right).
   type :: place_t
      character(10) :: word
      integer :: axle, side
   end type place_t

   type(place_t), parameter :: places(*) = [place_t('left', 0, 1), place_t('lh', 0, 1), place_t('lhs', 0, 1), &
      place_t('links', 0, 1), place_t('l', 0, 1), place_t('hpl', 0, 1), place_t('right', 0, 2), place_t('rh', 0, 2), &
      place_t('rhs', 0, 2), place_t('rechts', 0, 2), place_t('hpr', 0, 2), place_t('fl', 1, 1), place_t('fr', 1, 2), &
      place_t('rl', 2, 1), place_t('rr', 2, 2), place_t('lf', 1, 1), place_t('rf', 1, 2), place_t('lr', 2, 1), &
      place_t('frontleft', 1, 1), place_t('frontright', 1, 2), place_t('rearleft', 2, 1), place_t('rearright', 2, 2)]

   !> What the names of a table have together: an `r` is right beside an `l`, and rear beside an `f`.
   type :: hints_t
      logical :: has_l = .false., has_f = .false.
   end type hints_t

   type :: meaning_t
      integer :: point = -1      !! index in point_names; unused_point; −1 if the name is not recognised
      integer :: axle = 0        !! 0 not given, 1 front, 2 rear
      integer :: side = 0        !! 0 not given, 1 left, 2 right
   end type meaning_t

contains

   !> Looks for the single letters l and f among the terms of a name.
   pure subroutine hints_in(name, hints)
      character(*), intent(in) :: name
      type(hints_t), intent(inout) :: hints
      character(:), allocatable :: word
      integer :: at

      at = 1
      do
         call next_word(name, at, word)
         if (word == '') exit
         if (word == 'l') hints%has_l = .true.
         if (word == 'f') hints%has_f = .true.
      end do
   end subroutine hints_in

   !> The point that a name stands for.
   pure type(meaning_t) function meaning_of(name, hints) result(found)
      character(*), intent(in) :: name
      type(hints_t), intent(in) :: hints
      character(:), allocatable :: word, letters, ends
      type(meaning_t) :: none
      logical :: is_known
      integer :: at

      at = findloc(point_names == lower(name(:min(len(name), len(point_names)))), .true., dim=1)
      if (at >= kingpin_low .and. len_trim(name) <= len(point_names)) then            ! of a solid axle: no other names
         found%point = at
         return
      end if
      letters = ''
      ends = ''                              ! front and rear, in the order of the name
      at = 1
      do
         call next_word(name, at, word)
         if (word == '') exit
         call take_place(word, hints, found, is_known)
         if (.not. is_known) then
            if (word == 'r' .and. hints%has_f .and. .not. hints%has_l) word = 'rear'
            call add_letters(word, letters, ends, is_known)
         end if
         if (.not. is_known) then
            found = none
            return
         end if
      end do
      call find_point(letters, ends, found)
   end function meaning_of

   !> Takes a word for a side or a corner.
   pure subroutine take_place(word, hints, found, is_known)
      character(*), intent(in) :: word
      type(hints_t), intent(in) :: hints
      type(meaning_t), intent(inout) :: found
      logical, intent(out) :: is_known
      integer :: k

      is_known = word == 'r' .and. hints%has_l .and. .not. hints%has_f
      if (is_known) then
         found%side = 2
         return
      end if
      do k = 1, size(places)
         if (word /= places(k)%word) cycle
         if (places(k)%axle > 0) found%axle = places(k)%axle
         found%side = places(k)%side
         is_known = .true.
      end do
   end subroutine take_place

   !> Finds the point of the letters. Of two terms for front and rear the first gives the axle; a single one gives it if the letters
   !> stand for a point without it.
   pure subroutine find_point(letters, ends, found)
      character(*), intent(in) :: letters, ends
      type(meaning_t), intent(inout) :: found

      if (scan(letters, 'Y') > 0 .and. scan(letters, 'p') == 0) then
         found%point = unused_point
         if (len(ends) > 1 .and. found%axle == 0) found%axle = index('FR', ends(1:1))
         return
      end if
      if (len(ends) > 2) return
      if (len(ends) == 2) then
         found%point = point_of(letters//ends(2:2))
         if (found%point > 0 .and. found%axle == 0) found%axle = index('FR', ends(1:1))
         return
      end if
      found%point = point_of(letters//ends)
      if (found%point > 0 .or. ends == '') return
      found%point = point_of(letters)
      if (found%point > 0 .and. found%axle == 0) found%axle = index('FR', ends)
   end subroutine find_point

   !> The point that letters stand for; −1 if they stand for none, or for several.
   pure integer function point_of(letters) result(point)
      character(*), intent(in) :: letters
      integer :: k

      point = -1
      do k = 1, size(rules)
         if (len(letters) == 0) return
         if (verify(trim(rules(k)%needs), letters) > 0) cycle
         if (verify(letters, trim(rules(k)%needs)//trim(rules(k)%may)//ignored_letters(rules(k)%needs)) > 0) cycle
         if (point > 0 .and. point /= rules(k)%point) then
            point = -1
            return
         end if
         point = rules(k)%point
      end do
   end function point_of

   !> Letters that say nothing: that of the axle tube unless a rod of a solid axle may end there, that of a rod beside tie, toe or
   !> push.
   pure function ignored_letters(needs) result(letters)
      character(*), intent(in) :: needs
      character(2) :: letters

      letters = merge('tJ', 't ', scan(needs, 'THE') > 0)
      if (scan(needs, 'LU') > 0 .and. scan(needs, 'NQ') > 0) letters = ''
   end function ignored_letters

   !> Adds the letters of a term, which may consist of several terms without blanks ('lcafront').
   pure recursive subroutine add_letters(word, letters, ends, is_known)
      character(*), intent(in) :: word
      character(:), allocatable, intent(inout) :: letters, ends
      logical, intent(out) :: is_known
      character(:), allocatable :: rest_letters, rest_ends
      integer :: k, length

      is_known = .true.
      if (len(word) == 0) return
      if (len(word) > 60) then
         is_known = .false.
         return
      end if
      do length = min(len(word), len(words(1)%word)), 1, -1         ! the longest word first
         if (length == 1 .and. len(word) > 1) exit
         do k = 1, size(words)
            if (words(k)%word /= word(:length) .or. len_trim(words(k)%word) /= length) cycle
            rest_letters = letters
            rest_ends = ends
            if (scan(words(k)%letters, 'FR') > 0) then
               rest_ends = rest_ends//trim(words(k)%letters)
            else
               rest_letters = rest_letters//trim(words(k)%letters)
            end if
            call add_letters(word(length + 1:), rest_letters, rest_ends, is_known)
            if (.not. is_known) exit
            letters = rest_letters
            ends = rest_ends
            return
         end do
      end do
      is_known = .false.
   end subroutine add_letters

   !> Finds the next run of letters and digits of a name, in lower case; '' at its end.
   pure subroutine next_word(name, at, word)
      character(*), intent(in) :: name
      integer, intent(inout) :: at
      character(:), allocatable, intent(out) :: word
      character(*), parameter :: in_words = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789'
      integer :: first, last

      word = ''
      if (at > len(name)) return
      first = scan(name(at:), in_words)
      if (first == 0) return
      first = at + first - 1
      last = verify(name(first:), in_words)
      last = merge(len(name), first + last - 2, last == 0)
      word = lower(name(first:last))
      at = last + 1
   end subroutine next_word

   !> The name of a point that is similar to a name; '' if there is none.
   pure function nearest_point(name) result(words)
      character(*), intent(in) :: name
      character(:), allocatable :: words
      character(:), allocatable :: plain
      integer :: k

      plain = lower(trim(name(:min(len(name), 40))))
      do k = 1, len(plain)
         if (plain(k:k) == ' ' .or. plain(k:k) == '-' .or. plain(k:k) == '*') plain(k:k) = '_'
      end do
      words = nearest_name(plain, point_names)
   end function nearest_point

end module ek_point_name
