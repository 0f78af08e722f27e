!> The groups of a deck and their keys: the single definition of what is legal.
!>
!> To add a key: add its row here and its variable to the namelist in the reader of the group.
module ek_group
   use ek_kinds, only: wp
   use ek_text, only: lower, quoted, nearest_name
   use ek_letters, only: visible
   implicit none(type, external)
   private
   public :: group_names, group_number, is_deck_group, has_results, names_of_groups, is_single
   public :: key_t, keys, find_key, key_names, record_head, did_you_mean, unknown_key
   public :: model_group, point_group, body_group, measure_group, joint_group, bushing_group, spring_group, spring_groups
   public :: wheel_group, load_group, case_group, study_group, factor_group, response_group, include_group, mirror_group
   public :: curve_group, damper_group, stop_group, torsion_group, axle_group, steering_group, mass_group
   public :: most_values, most_loads, is_legal_name, illegal_name
   public :: word_length, note_length, most_measures, largest_exponent, smallest_exponent
   public :: word, prose, number, whole, switch, is_inside, range_words

   integer, parameter :: model_group = 1, point_group = 2, body_group = 3, measure_group = 4, joint_group = 5, &
      bushing_group = 6, spring_group = 7, wheel_group = 8, load_group = 9, case_group = 10, &
      study_group = 11, factor_group = 12, response_group = 13, include_group = 14, mirror_group = 15, &
      curve_group = 16, damper_group = 17, stop_group = 18, torsion_group = 19, axle_group = 20, steering_group = 21, &
      mass_group = 22
   character(*), parameter :: group_names(22) = [character(8) :: 'model', 'point', 'body', 'measure', 'joint', &
      'bushing', 'spring', 'wheel', 'load', 'case', 'study', 'factor', 'response', 'include', 'mirror', 'curve', 'damper', &
      'stop', 'torsion', 'axle', 'steering', 'mass']

   integer, parameter :: every_group = 0      !! in the table of keys
   integer, parameter :: spring_groups(4) = [spring_group, damper_group, stop_group, torsion_group]   ! elements of one measure
   integer, parameter :: result_groups(*) = [measure_group, joint_group, bushing_group, spring_groups]   ! their names make columns
   integer, parameter :: study_groups(3) = [study_group, factor_group, response_group]   ! all others belong to a deck

   ! types of value
   integer, parameter :: word = 1      !! quoted, at most word_length characters: names and choices
   integer, parameter :: prose = 2     !! quoted, at most note_length characters
   integer, parameter :: number = 3
   integer, parameter :: whole = 4     !! whole number
   integer, parameter :: switch = 5    !! .true. or .false.

   integer, parameter :: word_length = 63      !! longest name
   integer, parameter :: note_length = 2000    !! longest title or note
   integer, parameter :: most_measures = 8     !! per coupler
   integer, parameter :: most_values = 200     !! per factor; also step sizes of a study, points of a curve, names in shared
   integer, parameter :: most_loads = 12       !! scaled together by one case
   integer, parameter :: largest_exponent = 30 !! numbers above 1e30 are mistakes and could overflow later
   integer, parameter :: smallest_exponent = -100   !! numbers below 1e-100 are mistakes too; the smallest would be read as 0

   ! legal ranges of a number
   integer, parameter :: any_number = 0, positive = 1, not_negative = 2, not_zero = 3, share = 4

   type :: key_t
      integer :: group
      character(14) :: name
      integer :: type
      integer :: least, most     !! number of values
      logical :: is_required
      integer :: range = any_number
      character(20) :: unit = ''   !! of the range, in messages
   end type key_t

   type(key_t), parameter :: keys(*) = [ &
      key_t(model_group, 'name', word, 1, 1, .true.), &
      key_t(model_group, 'title', prose, 1, 1, .false.), &
      key_t(model_group, 'length', word, 1, 1, .false.), &
      key_t(model_group, 'force', word, 1, 1, .false.), &
      key_t(model_group, 'angle', word, 1, 1, .false.), &
      key_t(model_group, 'axes', word, 1, 1, .false.), &
      key_t(model_group, 'balance', word, 1, 1, .false.), &
      key_t(model_group, 'gravity', number, 1, 1, .false., not_negative, ' (m/s², downward)'), &
      key_t(model_group, 'plausible', switch, 1, 1, .false.), &
      key_t(point_group, 'name', word, 1, 1, .true.), &
      key_t(point_group, 'at', number, 3, 3, .true.), &
      key_t(body_group, 'name', word, 1, 1, .true.), &
      key_t(body_group, 'origin', word, 1, 1, .false.), &
      key_t(body_group, 'mass', number, 1, 1, .false., positive, ' kg'), &
      key_t(body_group, 'centre', word, 1, 1, .false.), &
      key_t(mass_group, 'name', word, 1, 1, .true.), &
      key_t(mass_group, 'body', word, 1, 1, .true.), &
      key_t(mass_group, 'kg', number, 1, 1, .true., positive), &
      key_t(mass_group, 'at', word, 1, 1, .true.), &
      key_t(measure_group, 'name', word, 1, 1, .true.), &
      key_t(measure_group, 'type', word, 1, 1, .true.), &
      key_t(measure_group, 'bodies', word, 2, 2, .true.), &
      key_t(measure_group, 'at', word, 1, 2, .false.), &
      key_t(measure_group, 'axis', word, 2, 2, .false.), &
      key_t(measure_group, 'axis_vector', number, 3, 3, .false.), &
      key_t(measure_group, 'axis_2', word, 2, 2, .false.), &
      key_t(measure_group, 'axis_2_vector', number, 3, 3, .false.), &
      key_t(joint_group, 'name', word, 1, 1, .true.), &
      key_t(joint_group, 'type', word, 1, 1, .true.), &
      key_t(joint_group, 'bodies', word, 2, 2, .false.), &
      key_t(joint_group, 'at', word, 1, 2, .false.), &
      key_t(joint_group, 'axis', word, 2, 2, .false.), &
      key_t(joint_group, 'axis_vector', number, 3, 3, .false.), &
      key_t(joint_group, 'axis_2', word, 2, 2, .false.), &
      key_t(joint_group, 'axis_2_vector', number, 3, 3, .false.), &
      key_t(joint_group, 'measure', word, 1, 1, .false.), &
      key_t(joint_group, 'measures', word, 1, most_measures, .false.), &
      key_t(joint_group, 'ratios', number, 1, most_measures, .false., not_zero), &
      key_t(joint_group, 'stiffness', number, 1, 1, .false., positive), &
      key_t(joint_group, 'balance', switch, 1, 1, .false.), &
      key_t(bushing_group, 'name', word, 1, 1, .true.), &
      key_t(bushing_group, 'bodies', word, 2, 2, .true.), &
      key_t(bushing_group, 'at', word, 1, 2, .true.), &
      key_t(bushing_group, 'z_axis', word, 2, 2, .false.), &
      key_t(bushing_group, 'z_vector', number, 3, 3, .false.), &
      key_t(bushing_group, 'x_axis', word, 2, 2, .false.), &
      key_t(bushing_group, 'x_vector', number, 3, 3, .false.), &
      key_t(bushing_group, 'kt', number, 3, 3, .false., not_negative), &
      key_t(bushing_group, 'kr', number, 3, 3, .false., not_negative), &
      key_t(bushing_group, 'curve', word, 1, 6, .false.), &
      key_t(bushing_group, 'preload_force', number, 3, 3, .false.), &
      key_t(bushing_group, 'preload_moment', number, 3, 3, .false.), &
      key_t(spring_group, 'name', word, 1, 1, .true.), &
      key_t(spring_group, 'bodies', word, 2, 2, .false.), &
      key_t(spring_group, 'at', word, 2, 2, .false.), &
      key_t(spring_group, 'measure', word, 1, 1, .false.), &
      key_t(spring_group, 'rate', number, 1, 1, .false., not_negative), &
      key_t(spring_group, 'curve', word, 1, 1, .false.), &
      key_t(spring_group, 'preload', number, 1, 1, .false.), &
      key_t(spring_group, 'balance', switch, 1, 1, .false.), &
      key_t(spring_group, 'free_length', number, 1, 1, .false., positive), &
      key_t(curve_group, 'name', word, 1, 1, .true.), &
      key_t(curve_group, 'x', number, 2, most_values, .true.), &
      key_t(curve_group, 'y', number, 2, most_values, .true.), &
      key_t(curve_group, 'kind', word, 1, 1, .false.), &
      key_t(damper_group, 'name', word, 1, 1, .true.), &
      key_t(damper_group, 'bodies', word, 2, 2, .true.), &
      key_t(damper_group, 'at', word, 2, 2, .true.), &
      key_t(damper_group, 'gas_force', number, 1, 1, .false., not_negative), &
      key_t(damper_group, 'gas_rate', number, 1, 1, .false., not_negative), &
      key_t(stop_group, 'name', word, 1, 1, .true.), &
      key_t(stop_group, 'type', word, 1, 1, .true.), &
      key_t(stop_group, 'bodies', word, 2, 2, .true.), &
      key_t(stop_group, 'at', word, 2, 2, .true.), &
      key_t(stop_group, 'clearance', number, 1, 1, .true., not_negative), &
      key_t(stop_group, 'rate', number, 1, 1, .false., not_negative), &
      key_t(stop_group, 'curve', word, 1, 1, .false.), &
      key_t(stop_group, 'rounding', number, 1, 1, .false., positive), &
      key_t(torsion_group, 'name', word, 1, 1, .true.), &
      key_t(torsion_group, 'bodies', word, 2, 2, .true.), &
      key_t(torsion_group, 'axis', word, 2, 2, .false.), &
      key_t(torsion_group, 'axis_vector', number, 3, 3, .false.), &
      key_t(torsion_group, 'rate', number, 1, 1, .false., not_negative), &
      key_t(torsion_group, 'curve', word, 1, 1, .false.), &
      key_t(torsion_group, 'preload', number, 1, 1, .false.), &
      key_t(wheel_group, 'name', word, 1, 1, .true.), &
      key_t(wheel_group, 'body', word, 1, 1, .true.), &
      key_t(wheel_group, 'side', word, 1, 1, .true.), &
      key_t(wheel_group, 'centre', word, 1, 1, .true.), &
      key_t(wheel_group, 'contact', word, 1, 1, .true.), &
      key_t(wheel_group, 'spin_vector', number, 3, 3, .false.), &
      key_t(wheel_group, 'toe', number, 1, 1, .false.), &
      key_t(wheel_group, 'camber', number, 1, 1, .false.), &
      key_t(wheel_group, 'radius', number, 1, 1, .false., positive), &
      key_t(wheel_group, 'tyre_rate', number, 1, 1, .false., positive), &
      key_t(wheel_group, 'tyre_width', number, 1, 1, .false., positive), &
      key_t(wheel_group, 'sprung_mass', number, 1, 1, .false., positive, ' kg'), &
      key_t(wheel_group, 'steer_axis', word, 2, 2, .false.), &
      key_t(axle_group, 'name', word, 1, 1, .false.), &
      key_t(axle_group, 'position', word, 1, 1, .true.), &
      key_t(axle_group, 'wheelbase', number, 1, 1, .true., positive), &
      key_t(axle_group, 'cg_height', number, 1, 1, .true., positive), &
      key_t(axle_group, 'mass', number, 1, 1, .false., positive), &
      key_t(axle_group, 'brake_share', number, 1, 1, .true., share), &
      key_t(axle_group, 'drive_share', number, 1, 1, .false., share), &
      key_t(axle_group, 'drive_reaction', word, 1, 1, .false.), &
      key_t(axle_group, 'front_overhang', number, 1, 1, .false., positive), &
      key_t(axle_group, 'front_width', number, 1, 1, .false., positive), &
      key_t(steering_group, 'name', word, 1, 1, .false.), &
      key_t(steering_group, 'driver', word, 1, 1, .true.), &
      key_t(steering_group, 'ratio', number, 1, 1, .true., not_zero), &
      key_t(steering_group, 'travel', number, 1, 1, .true., positive), &
      key_t(load_group, 'name', word, 1, 1, .true.), &
      key_t(load_group, 'body', word, 1, 1, .true.), &
      key_t(load_group, 'at', word, 1, 1, .true.), &
      key_t(load_group, 'force', number, 3, 3, .false.), &
      key_t(load_group, 'moment', number, 3, 3, .false.), &
      key_t(load_group, 'follows', switch, 1, 1, .false.), &
      key_t(load_group, 'factor', word, 1, 1, .false.), &
      key_t(case_group, 'name', word, 1, 1, .true.), &
      key_t(case_group, 'load', word, 1, most_loads, .false.), &
      key_t(case_group, 'drive', word, 1, 1, .false.), &
      key_t(case_group, 'wheel', word, 1, 1, .false.), &
      key_t(case_group, 'test', word, 1, 1, .false.), &
      key_t(case_group, 'vertical', word, 1, 1, .false.), &
      key_t(case_group, 'phase', word, 1, 1, .false.), &
      key_t(case_group, 'offset', number, 1, 1, .false.), &
      key_t(case_group, 'file', prose, 1, 1, .false.), &
      key_t(case_group, 'target', prose, 1, 1, .false.), &
      key_t(case_group, 'quantities', word, 1, 1, .false.), &
      key_t(case_group, 'from', number, 1, 1, .false.), &
      key_t(case_group, 'to', number, 1, 1, .false.), &
      key_t(case_group, 'increments', whole, 1, 1, .false.), &
      key_t(case_group, 'method', word, 1, 1, .false.), &
      key_t(case_group, 'follow', word, 1, 1, .false.), &
      key_t(case_group, 'tolerance', number, 1, 1, .false., positive), &
      key_t(study_group, 'name', word, 1, 1, .true.), &
      key_t(study_group, 'title', prose, 1, 1, .false.), &
      key_t(study_group, 'kind', word, 1, 1, .true.), &
      key_t(study_group, 'deck', prose, 1, 1, .true.), &
      key_t(study_group, 'case', word, 1, 1, .false.), &
      key_t(study_group, 'plot', prose, 1, 1, .false.), &
      key_t(study_group, 'end', word, 1, 1, .false.), &
      key_t(study_group, 'methods', word, 1, 3, .false.), &
      key_t(study_group, 'increments', whole, 1, most_values, .false.), &
      key_t(study_group, 'columns', word, 1, 20, .false.), &
      key_t(factor_group, 'name', word, 1, 1, .true.), &
      key_t(factor_group, 'path', prose, 1, 1, .true.), &
      key_t(factor_group, 'values', number, 1, most_values, .false.), &
      key_t(factor_group, 'from', number, 1, 1, .false.), &
      key_t(factor_group, 'to', number, 1, 1, .false.), &
      key_t(factor_group, 'count', whole, 1, 1, .false.), &
      key_t(factor_group, 'spacing', word, 1, 1, .false.), &
      key_t(response_group, 'name', word, 1, 1, .true.), &
      key_t(response_group, 'column', word, 1, 1, .true.), &
      key_t(response_group, 'of', word, 1, 1, .false.), &
      key_t(response_group, 'at', number, 1, 1, .false.), &
      key_t(response_group, 'over', word, 1, 1, .false.), &
      key_t(response_group, 'window', number, 1, 1, .false., positive), &
      key_t(include_group, 'file', prose, 1, 1, .true.), &
      key_t(mirror_group, 'shared', word, 1, most_values, .false.), &
      key_t(every_group, 'note', prose, 1, 1, .false.)]

   character(*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyz'

contains

   !> Whether a name begins with a letter and contains only letters, digits and _. Names appear in messages, paths and
   !> column headings.
   pure logical function is_legal_name(name)
      character(*), intent(in) :: name
      is_legal_name = verify(lower(name), letters//'0123456789_') == 0 .and. scan(lower(name), letters) == 1
   end function is_legal_name

   !> The message for an illegal name. A leading or trailing blank is made visible.
   pure function illegal_name(name) result(words)
      character(*), intent(in) :: name     !! as written in the deck
      character(:), allocatable :: words

      words = 'a name must begin with a letter and contain only letters, digits and _'
      if (len(name) == 0) return
      if (name(len(name):) == ' ') then
         words = words//", found '"//visible(trim(name))//"<U+0020>'; remove the trailing blank"
      else if (name(:1) == ' ') then
         words = words//", found '<U+0020>"//visible(trim(adjustl(name)))//"'; remove the leading blank"
      end if
   end function illegal_name

   !> The number of a group, 0 if there is no such group.
   pure integer function group_number(name)
      character(*), intent(in) :: name
      integer :: k

      group_number = 0
      do k = 1, size(group_names)
         if (group_names(k) == name) group_number = k
      end do
   end function group_number

   !> Whether a group belongs to a deck; .false. for groups of a study and for 0.
   pure logical function is_deck_group(group)
      integer, intent(in) :: group
      is_deck_group = group > 0 .and. .not. any(study_groups == group)
   end function is_deck_group

   !> Whether records of a group have columns in the results: their names must differ. &mirror duplicates them.
   pure logical function has_results(group)
      integer, intent(in) :: group
      has_results = any(result_groups == group)
   end function has_results

   !> The group names of a deck or of a study, for suggestions.
   pure function names_of_groups(of_deck) result(names)
      logical, intent(in) :: of_deck
      character(len(group_names)), allocatable :: names(:)
      logical :: is_wanted(size(group_names))
      integer :: k

      do k = 1, size(group_names)
         is_wanted(k) = is_deck_group(k) .eqv. of_deck
      end do
      names = pack(group_names, is_wanted)
   end function names_of_groups

   !> Whether --set addresses a group without a record name: &model, and the other groups without names.
   pure logical function is_single(group)
      integer, intent(in) :: group
      is_single = group == model_group .or. .not. any(keys%group == group .and. keys%name == 'name' .and. keys%is_required)
   end function is_single

   !> The row of a key; is_known is .false. if the group has no such key.
   pure subroutine find_key(group, name, key, is_known)
      integer, intent(in) :: group
      character(*), intent(in) :: name
      type(key_t), intent(out) :: key
      logical, intent(out) :: is_known
      integer :: k

      is_known = .false.
      do k = 1, size(keys)
         if (keys(k)%group /= group .and. keys(k)%group /= every_group) cycle
         if (keys(k)%name /= name) cycle
         key = keys(k)
         is_known = .true.
         return
      end do
   end subroutine find_key

   !> Whether a number is inside a legal range.
   pure logical function is_inside(range, value)
      integer, intent(in) :: range
      real(wp), intent(in) :: value

      is_inside = .true.
      select case (range)
      case (positive)
         is_inside = value > 0.0_wp
      case (not_negative)
         is_inside = value >= 0.0_wp
      case (not_zero)
         is_inside = abs(value) > 0.0_wp
      case (share)
         is_inside = value >= 0.0_wp .and. value <= 1.0_wp
      end select
   end function is_inside

   !> 'must be above 0 kg, found -1': the message about a number outside the range of its key.
   pure function range_words(key, shown) result(words)
      type(key_t), intent(in) :: key
      character(*), intent(in) :: shown       !! the value as text
      character(:), allocatable :: words
      character(*), parameter :: ranges(4) = [character(12) :: 'above 0', '0 or more', 'not be zero', '0 to 1']

      words = 'must be '//trim(ranges(key%range))//trim(key%unit)//', found '//shown
      if (key%range == not_zero) words = 'must not be zero'
   end function range_words

   !> All keys of a group, for suggestions and the manual.
   pure function key_names(group) result(names)
      integer, intent(in) :: group
      character(14), allocatable :: names(:)
      integer :: k, used

      allocate (names(count(keys%group == group) + 1))
      used = 0
      do k = 1, size(keys)
         if (keys(k)%group /= group) cycle
         names(used + merge(1, 2, used == 0)) = keys(k)%name      ! the second is `note`
         used = used + 1
      end do
      names(2) = 'note'
   end function key_names

   !> "bushing 'top_mount': "
   pure function record_head(group, name) result(head)
      integer, intent(in) :: group
      character(*), intent(in) :: name     !! '' if it has none
      character(:), allocatable :: head

      if (name == '') then
         head = trim(group_names(group))//': '
      else
         head = trim(group_names(group))//' '//quoted(name)//': '
      end if
   end function record_head

   !> "there is no key 'rte' in &spring (did you mean 'rate'?)"
   pure function unknown_key(group, name) result(words)
      integer, intent(in) :: group
      character(*), intent(in) :: name
      character(:), allocatable :: words

      words = 'there is no key '//quoted(name)//' in &'//trim(group_names(group))//did_you_mean(name, key_names(group))
   end function unknown_key

   !> " (did you mean 'kt'?)" if one candidate is similar, otherwise all candidates.
   pure function did_you_mean(name, candidates) result(words)
      character(*), intent(in) :: name
      character(*), intent(in) :: candidates(:)    !! blank ones are ignored
      character(:), allocatable :: words
      integer, parameter :: most_listed = 20
      integer :: k

      words = nearest_name(name, candidates)
      if (words /= '') then
         words = ' (did you mean '//quoted(words)//'?)'
      else if (count(candidates /= '') == 0) then
         words = ' (there is none)'
      else if (count(candidates /= '') <= most_listed) then
         do k = 1, size(candidates)
            if (candidates(k) == '') cycle
            if (words /= '') words = words//', '
            words = words//trim(candidates(k))
         end do
         words = ' (known: '//words//')'
      end if
   end function did_you_mean

end module ek_group
