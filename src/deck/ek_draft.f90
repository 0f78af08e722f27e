!> The state of the reader: the information about each record while a suspension is built, and
!> look-ups that convert names to points, bodies and directions, or report a mistake.
!>
!> Messages have the form `file:line: group 'name': what`. If an entry was already rejected (its key
!> is then blank here) the searches report nothing: one mistake, one message.
module ek_draft
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted
   use ek_units, only: units_t
   use ek_curve, only: curve_t
   use ek_rotation, only: unit_vector
   use ek_twin, only: has_side, single, left_twin
   use ek_complaint, only: complaints_t, place_t
   use ek_record, only: entry_index, is_given, place_of, line_words, own_name
   use ek_group, only: group_names, record_head, did_you_mean, point_group, body_group, wheel_group, word_length
   use ek_deck, only: deck_t
   implicit none(type, external)
   private
   public :: draft_t, card_t, complain, where_of, line_of, find_card, names_of, look_up
   public :: find_point, find_body, find_bodies, find_direction, to_internal, choice, has_key, angle_between

   !> The information about one record.
   type :: card_t
      integer :: group = 0                  !! 0: an unknown group
      character(word_length) :: name = ''
      character(:), allocatable :: text     !! its valid entries as a namelist record
      logical :: is_good = .false.          !! no mistake found so far
      integer :: index = 0                  !! its number among the elements of its kind in the suspension
      real(wp) :: at(3) = 0.0_wp            !! point: design position, SI, x rearward
      real(wp) :: factor = 1.0_wp           !! measure: deck unit → SI
      logical :: is_used = .false.          !! point: referenced; body: attached to something
   end type card_t

   type :: draft_t
      type(units_t) :: units
      logical :: is_iso = .false.
      real(wp) :: gravity = 0.0_wp             !! m/s²
      type(complaints_t) :: complaints
      type(card_t), allocatable :: cards(:)    !! one per record of the deck
      type(curve_t), allocatable :: curves(:)  !! the curves of &curve, numbers as in the deck
   end type draft_t

contains

   !> Report a mistake in record k, at the line of `key` ('': the line of the record).
   subroutine complain(draft, deck, k, key, what)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: key, what
      type(place_t) :: place
      integer :: entry

      entry = 0
      if (key /= '') entry = entry_index(deck%records(k), key, 0)
      call place_of(deck%records(k), entry, place)
      call draft%complaints%add(place, record_head(draft%cards(k)%group, draft%cards(k)%name)//what)
      draft%cards(k)%is_good = .false.
   end subroutine complain

   !> 'file:line' of a record.
   pure function where_of(deck, k) result(place)
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(:), allocatable :: place
      place = deck%records(k)%file//':'//str(deck%records(k)%line)
   end function where_of

   !> 'line 12' of record j, for a message about record k.
   pure function line_of(deck, j, k) result(words)
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: j, k
      character(:), allocatable :: words
      words = line_words(deck%records(j), deck%records(k))
   end function line_of

   !> Whether record k contains any element of a key.
   pure logical function has_key(deck, k, key)
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: key
      has_key = is_given(deck%records(k), key)
   end function has_key

   !> The record of this group with this name; 0 if there is none.
   pure integer function find_card(draft, group, name)
      type(draft_t), intent(in) :: draft
      integer, intent(in) :: group
      character(*), intent(in) :: name

      do find_card = 1, size(draft%cards)
         if (draft%cards(find_card)%group /= group) cycle
         if (draft%cards(find_card)%name == name) return
      end do
      find_card = 0
   end function find_card

   !> The names of a group suggested for an unknown name in record k. A record duplicated by &mirror is
   !> suggested under its name in the deck, unless the unknown name has the prefix of a side.
   function names_of(draft, deck, group, k, wrong) result(names)
      type(draft_t), intent(in) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: group, k
      character(*), intent(in) :: wrong
      character(word_length), allocatable :: names(:)
      logical :: is_sided
      integer :: j

      is_sided = deck%records(k)%twin == single .and. (group == wheel_group .or. has_side(wrong))
      allocate (names(size(draft%cards)))
      names = ''
      do j = 1, size(draft%cards)
         if (draft%cards(j)%group /= group) cycle
         if (is_sided .or. deck%records(j)%twin == single) then
            names(j) = draft%cards(j)%name
         else if (deck%records(j)%twin == left_twin) then
            names(j) = own_name(deck%records(j))
         end if
      end do
   end function names_of

   !> The record to which a key of record k refers; 0, with a message, if there is none.
   subroutine look_up(draft, deck, k, key, group, name, found)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k, group
      character(*), intent(in) :: key, name
      integer, intent(out) :: found

      found = 0
      if (name == '') return
      found = find_card(draft, group, name)
      if (found > 0) return
      draft%cards(k)%is_good = .false.
      if (may_be_meant(draft, group, name)) return
      if (group == body_group) then
         call complain(draft, deck, k, key, key//': there is no body '//quoted(name)// &
            did_you_mean(name, [names_of(draft, deck, group, k, name), [character(word_length) :: 'chassis']]))
      else
         call complain(draft, deck, k, key, key//': there is no '//trim(group_names(group))//' '//quoted(name)// &
            did_you_mean(name, names_of(draft, deck, group, k, name)))
      end if
   end subroutine look_up

   !> Whether an unknown name may belong to a record whose own name or group was already rejected:
   !> then only that is reported, not the references to it.
   pure logical function may_be_meant(draft, group, name)
      type(draft_t), intent(in) :: draft
      integer, intent(in) :: group
      character(*), intent(in) :: name
      may_be_meant = any(draft%cards%group == group .and. draft%cards%name == '') .or. &
         any(draft%cards%group == 0 .and. (draft%cards%name == name .or. draft%cards%name == ''))
   end function may_be_meant

   !> The design position of a named point; is_found is .false. if the point is unknown or was rejected.
   subroutine find_point(draft, deck, k, key, name, at, is_found)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: key, name
      real(wp), intent(out) :: at(3)      !! m, x rearward
      logical, intent(out) :: is_found
      integer :: found

      at = 0.0_wp
      call look_up(draft, deck, k, key, point_group, name, found)
      is_found = .false.
      if (found == 0) return
      draft%cards(found)%is_used = .true.
      at = draft%cards(found)%at
      is_found = draft%cards(found)%is_good
   end subroutine find_point

   !> The number of a named body, 0 for the chassis.
   subroutine find_body(draft, deck, k, key, name, body, is_found)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: key, name
      integer, intent(out) :: body
      logical, intent(out) :: is_found
      integer :: found

      body = 0
      is_found = lower(name) == 'chassis' .or. lower(name) == 'ground'
      if (is_found) return
      call look_up(draft, deck, k, key, body_group, name, found)
      is_found = found > 0
      if (is_found) body = draft%cards(found)%index
   end subroutine find_body

   !> Both bodies of an element; they must differ. Marks them as attached.
   subroutine find_bodies(draft, deck, k, names, bodies, is_found)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: names(2)
      integer, intent(out) :: bodies(2)
      logical, intent(out) :: is_found
      logical :: is_there(2)
      integer :: j, held

      do j = 1, 2
         call find_body(draft, deck, k, 'bodies', names(j), bodies(j), is_there(j))
         held = find_card(draft, body_group, names(j))
         if (held > 0 .and. names(j) /= '') draft%cards(held)%is_used = .true.
      end do
      is_found = all(is_there)
      if (.not. is_found) return
      if (bodies(1) == bodies(2)) then
         call complain(draft, deck, k, 'bodies', 'bodies must be two different ones, found '//quoted(names(1))//' twice')
         is_found = .false.
      end if
   end subroutine find_bodies

   !> A direction given by two points or by a vector.
   subroutine find_direction(draft, deck, k, points_key, points, vector_key, vector, direction, is_given, is_good)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: points_key, points(2)
      character(*), intent(in) :: vector_key
      real(wp), intent(in) :: vector(3)          !! deck axes
      real(wp), intent(out) :: direction(3)      !! unit, x rearward
      logical, intent(out) :: is_given           !! either key is present
      logical, intent(out) :: is_good            !! `direction` is set
      real(wp) :: ends(3, 2)
      logical :: is_there(2), has_points, has_vector
      integer :: j

      direction = [0.0_wp, 0.0_wp, 1.0_wp]
      is_good = .false.
      has_points = has_key(deck, k, points_key)
      has_vector = has_key(deck, k, vector_key)
      is_given = has_points .or. has_vector
      if (has_points) then
         do j = 1, 2
            call find_point(draft, deck, k, points_key, points(j), ends(:, j), is_there(j))
         end do
         if (.not. all(is_there)) return
         direction = ends(:, 2) - ends(:, 1)
         if (.not. norm2(direction) > 0.0_wp) then
            call complain(draft, deck, k, points_key, points_key//': the points '//quoted(points(1))//' and '// &
               quoted(points(2))//' coincide and give no direction')
            return
         end if
      end if
      if (has_points .and. has_vector) then
         call complain(draft, deck, k, vector_key, 'give either '//points_key//' or '//vector_key//', not both')
         return
      end if
      if (has_vector) then
         direction = to_internal(draft, vector)
         if (.not. norm2(direction) > 0.0_wp) then
            if (draft%cards(k)%is_good) call complain(draft, deck, k, vector_key, vector_key//' has zero length')
            return
         end if
      end if
      if (.not. is_given) return
      direction = unit_vector(direction)
      is_good = .true.
   end subroutine find_direction

   !> Transforms a vector from deck axes to x rearward, y right, z up.
   pure function to_internal(draft, vector) result(turned)
      type(draft_t), intent(in) :: draft
      real(wp), intent(in) :: vector(3)
      real(wp) :: turned(3)
      turned = vector
      if (draft%is_iso) turned(1:2) = -vector(1:2)
   end function to_internal

   !> The index of a keyword among the choices; 0, with a message, if it is none of them.
   subroutine choice(draft, deck, k, key, word, choices, number)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: key, word, choices(:)
      integer, intent(out) :: number
      character(:), allocatable :: list
      integer :: j

      number = 0
      if (word == '') return
      list = ''
      do j = 1, size(choices)
         if (lower(word) == lower(choices(j))) number = j
      end do
      if (number > 0) return
      do j = 1, size(choices)
         if (j > 1) list = list//', '
         list = list//quoted(choices(j))
      end do
      call complain(draft, deck, k, key, key//' must be one of '//list//', found '//quoted(word))
   end subroutine choice

   !> Angle between two unit vectors [deg], accurate near 0 and 180 deg too.
   pure real(wp) function angle_between(u, v) result(angle)
      use ek_units, only: degree
      real(wp), intent(in) :: u(3), v(3)
      angle = 2.0_wp*atan2(norm2(u - v), norm2(u + v))/degree
   end function angle_between

end module ek_draft
