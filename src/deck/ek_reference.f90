!> Finds the records to which a record refers by name: points, bodies, directions, measures. An unknown name gives a message.
!>
!> If an entry was already rejected, the searches report nothing.
module ek_reference
   use ek_kinds, only: wp
   use ek_text, only: lower, quoted, did_you_mean
   use ek_record, only: element, own_name, has_side, is_given, single, left_side
   use ek_group, only: group_names, point_group, body_group, wheel_group, joint_group, curve_group, word_length
   use ek_blueprint, only: vector_t, add_vector, along, given
   use ek_design_vector, only: find_vectors
   use ek_deck_reading, only: deck_reading_t, complain, line_of, has_key, text_of, texts_of, numbers_of, refuse, slot
   implicit none(type, external)
   private
   public :: find_card, look_up, find_point, find_place, find_body, find_bodies, find_direction, find_ends, find_points
   public :: check_apart, find_curve
   public :: find_driver, find_wheel, is_driver, find_moving_body, new_vector

contains

   !> Index of the record of a group with a name, in which letter case matters; 0 if there is no such record.
   pure integer function find_card(reading, group, name)
      type(deck_reading_t), intent(in) :: reading
      integer, intent(in) :: group
      character(*), intent(in) :: name

      do find_card = 1, size(reading%cards)
         if (reading%cards(find_card)%group /= group) cycle
         if (reading%cards(find_card)%name == name) return
      end do
      find_card = 0
   end function find_card

   !> The names of a group that may be suggested for the unknown name `wrong`. A record duplicated by &mirror is suggested under its
   !> name in the deck, unless the unknown name has the prefix of a side.
   function names_of(reading, group, wrong) result(names)
      type(deck_reading_t), intent(in) :: reading
      integer, intent(in) :: group
      character(*), intent(in) :: wrong
      character(word_length), allocatable :: names(:)
      logical :: is_sided
      integer :: j

      is_sided = reading%records(reading%k)%side == single .and. (group == wheel_group .or. has_side(wrong))
      allocate (names(size(reading%cards)))
      names = ''
      do j = 1, size(reading%cards)
         if (reading%cards(j)%group /= group) cycle
         if (is_sided .or. reading%records(j)%side == single) then
            names(j) = reading%cards(j)%name
         else if (reading%records(j)%side == left_side) then
            names(j) = own_name(reading%records(j))
         end if
      end do
      if (group == body_group) names = [names, [character(word_length) :: 'chassis']]
   end function names_of

   !> Finds the record to which a key refers. `found` is 0 if the name is blank or there is no such record. A missing record is
   !> reported as an error, unless the error of a rejected record may be its cause.
   subroutine look_up(reading, key, group, name, found)
      type(deck_reading_t), intent(inout) :: reading
      integer, intent(in) :: group
      character(*), intent(in) :: key, name
      integer, intent(out) :: found

      found = 0
      if (name == '') return
      found = find_card(reading, group, name)
      if (found > 0) return
      reading%cards(reading%k)%is_good = .false.
      if (may_be_meant(reading, group, name) .or. reading%deck_errors%lacks(group)) return
      call complain(reading, key, key//': there is no '//trim(group_names(group))//' '//quoted(name)// &
         mirror_or(did_you_mean(name, names_of(reading, group, name))))

   contains

      !> The hint that &mirror is missing, if the deck has no &mirror, the name begins with left_ or right_, and the deck defines
      !> the name without this prefix. Otherwise the given hint.
      function mirror_or(hint) result(words)
         character(*), intent(in) :: hint
         character(:), allocatable :: words
         integer :: first

         words = hint
         first = 0
         if (index(name, 'left_') == 1) first = 6
         if (index(name, 'right_') == 1) first = 7
         if (first == 0 .or. any([(reading%records(found)%group == 'mirror', found=1, size(reading%records))])) then
            found = 0
            return
         end if
         found = 0
         if (find_card(reading, group, name(first:)) > 0) words = ' (without &mirror the deck has only '// &
            quoted(name(first:))//'; &mirror creates left_'//name(first:)//' and right_'//name(first:)//')'
      end function mirror_or

   end subroutine look_up

   !> Whether an unknown name may belong to a record whose own name or group was rejected. Then only the rejection is reported, not
   !> the references to the record.
   pure logical function may_be_meant(reading, group, name)
      type(deck_reading_t), intent(in) :: reading
      integer, intent(in) :: group
      character(*), intent(in) :: name
      may_be_meant = any(reading%cards%group == group .and. reading%cards%name == '') .or. &
         any(reading%cards%group == 0 .and. (reading%cards%name == name .or. reading%cards%name == ''))
   end function may_be_meant

   !> Adds a vector to the blueprint and computes the value of the vector at design.
   subroutine new_vector(reading, vector, number)
      type(deck_reading_t), intent(inout) :: reading
      type(vector_t), intent(in) :: vector
      integer, intent(out) :: number
      logical :: is_good

      call add_vector(reading%plan, vector, number)
      call find_vectors(reading%plan, reading%parameters%x, reading%vectors, is_good, number)
   end subroutine new_vector

   !> Finds the vector of a named point; is_found is .false. if the point is unknown or was rejected.
   subroutine find_point(reading, key, name, vector, is_found)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: key, name
      integer, intent(out) :: vector
      logical, intent(out) :: is_found
      integer :: found

      vector = 0
      is_found = .false.
      if (find_card(reading, point_group, name) == 0 .and. wheel_of_contact(reading, name) > 0) then
         call complain(reading, key, key//': '//quoted(name)//' is the contact point of a wheel; only loads and measures accept it')
         return
      end if
      call look_up(reading, key, point_group, name, found)
      if (found == 0) return
      reading%cards(found)%is_used = .true.
      vector = reading%cards(found)%index
      is_found = reading%cards(found)%is_good
   end subroutine find_point

   !> Finds the point of the key `at` of a load or a measure: a named point, or the contact point of a wheel by the name
   !> <wheel>_contact.
   subroutine find_place(reading, name, vector, wheel, is_found)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: name
      integer, intent(out) :: vector
      integer, intent(out) :: wheel        !! index of the wheel whose contact point moves in its carrier; 0: a point of a body
      logical, intent(out) :: is_found
      character(:), allocatable :: contact
      integer :: found, point

      wheel = 0
      found = wheel_of_contact(reading, name)
      if (found == 0) then
         call find_point(reading, 'at', name, vector, is_found)
         return
      end if
      point = find_card(reading, point_group, name)
      contact = element(reading%records(found), 'contact', 1)
      if (is_given(reading%records(found), 'crown_radius')) then
         if (point > 0 .and. contact /= name) call complain(reading, 'at', 'at: '//quoted(name)//' is a point and the '// &
            'contact point of wheel '//quoted(trim(reading%cards(found)%name))//'; give the point another name')
         vector = 0
         is_found = reading%cards(found)%is_good
         if (.not. is_found) return
         wheel = reading%cards(found)%index
         vector = reading%plan%wheels(wheel)%contact
      else if (point > 0) then
         call find_point(reading, 'at', name, vector, is_found)
      else
         call find_point(reading, 'at', contact, vector, is_found)
      end if
   end subroutine find_place

   !> Index of the record of the wheel in the name <wheel>_contact; 0 if the name is not of this form.
   pure integer function wheel_of_contact(reading, name) result(found)
      type(deck_reading_t), intent(in) :: reading
      character(*), intent(in) :: name
      character(*), parameter :: ending = '_contact'
      integer :: stem

      found = 0
      stem = len(name) - len(ending)
      if (stem <= 0) return
      if (name(stem + 1:) == ending) found = find_card(reading, wheel_group, name(:stem))
   end function wheel_of_contact

   !> Finds the index of a named body. The index 0 is the chassis; it is also 0 if the body is not found.
   subroutine find_body(reading, key, name, body, is_found)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: key, name
      integer, intent(out) :: body
      logical, intent(out) :: is_found
      integer :: found

      body = 0
      is_found = lower(name) == 'chassis' .or. lower(name) == 'ground'
      if (is_found) return
      call look_up(reading, key, body_group, name, found)
      is_found = found > 0
      if (is_found) body = reading%cards(found)%index
   end subroutine find_body

   !> Finds the body named by the key `body`. The chassis is reported as an error, because the body must move.
   subroutine find_moving_body(reading, body, is_found)
      type(deck_reading_t), intent(inout) :: reading
      integer, intent(out) :: body
      logical, intent(out) :: is_found

      call find_body(reading, 'body', text_of(reading, 'body'), body, is_found)
      if (is_found .and. body == 0) &
         call complain(reading, 'body', 'body must be one that moves, found '//quoted(text_of(reading, 'body')))
   end subroutine find_moving_body

   !> Finds both bodies of an element (key `bodies`), and marks the bodies as attached. Two equal bodies are reported as an error.
   subroutine find_bodies(reading, bodies, is_found)
      type(deck_reading_t), intent(inout) :: reading
      integer, intent(out) :: bodies(2)
      logical, intent(out), optional :: is_found
      character(word_length) :: names(2)
      logical :: is_there(2)
      integer :: j, held

      names = texts_of(reading, 'bodies', 2)
      do j = 1, 2
         call find_body(reading, 'bodies', trim(names(j)), bodies(j), is_there(j))
         held = find_card(reading, body_group, names(j))
         if (held > 0 .and. names(j) /= '') reading%cards(held)%is_used = .true.
      end do
      if (all(is_there) .and. bodies(1) == bodies(2)) then
         call complain(reading, 'bodies', 'bodies must be two different ones, found '//quoted(names(1))//' twice')
         is_there = .false.
      end if
      if (present(is_found)) is_found = all(is_there)
   end subroutine find_bodies

   !> Finds the two points of the key `at`. If `may_be_one`, the second point may be omitted and then equals the first. Otherwise
   !> the points must be distinct.
   subroutine find_ends(reading, may_be_one, ends, is_found)
      type(deck_reading_t), intent(inout) :: reading
      logical, intent(in) :: may_be_one
      integer, intent(out) :: ends(2)      !! indices of the vectors
      logical, intent(out), optional :: is_found
      character(word_length) :: at(2)
      logical :: is_there

      at = texts_of(reading, 'at', 2)
      if (at(2) == '' .and. may_be_one) then
         call find_point(reading, 'at', trim(at(1)), ends(1), is_there)
         ends(2) = ends(1)
      else
         call find_points(reading, 'at', ends, is_there)
      end if
      if (present(is_found)) is_found = is_there
      if (is_there .and. .not. may_be_one) call check_apart(reading, 'at', ends, '', is_there)
   end subroutine find_ends

   !> Finds both points of a key.
   subroutine find_points(reading, key, ends, is_found)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: key
      integer, intent(out) :: ends(2)      !! indices of the vectors
      logical, intent(out) :: is_found
      character(word_length) :: names(2)
      logical :: is_there(2)
      integer :: j

      names = texts_of(reading, key, 2)
      do j = 1, 2
         call find_point(reading, key, trim(names(j)), ends(j), is_there(j))
      end do
      is_found = all(is_there)
   end subroutine find_points

   !> Reports the two points of a key if they coincide.
   subroutine check_apart(reading, key, ends, consequence, are_apart)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: key
      integer, intent(in) :: ends(2)       !! indices of the vectors
      character(*), intent(in) :: consequence
      logical, intent(out) :: are_apart
      character(word_length) :: names(2)

      are_apart = norm2(reading%vectors(:, ends(2)) - reading%vectors(:, ends(1))) > 0.0_wp
      if (are_apart) return
      names = texts_of(reading, key, 2)
      call complain(reading, key, key//': the points '//quoted(names(1))//' and '//quoted(names(2))//' coincide'//consequence)
   end subroutine check_apart

   !> Finds a direction given by two points or by a vector.
   subroutine find_direction(reading, points_key, vector_key, direction, is_given, is_good)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: points_key, vector_key
      integer, intent(out) :: direction          !! index of the vector, a unit vector; 0 if not is_good
      logical, intent(out) :: is_given           !! either key is present
      logical, intent(out) :: is_good
      type(vector_t) :: vector
      logical :: has_points, has_vector, is_found
      integer :: ends(2)

      direction = 0
      is_good = .false.
      has_points = has_key(reading, points_key)
      has_vector = has_key(reading, vector_key)
      is_given = has_points .or. has_vector
      if (.not. is_given) return
      if (has_points) then
         call find_points(reading, points_key, ends, is_found)
         if (.not. is_found) return
         call check_apart(reading, points_key, ends, ' and give no direction', is_found)
         if (.not. is_found) return
         vector%kind = along
         vector%a = ends(1)
         vector%b = ends(2)
      end if
      if (has_points .and. has_vector) then
         call complain(reading, vector_key, 'give either '//points_key//' or '//vector_key//', not both')
         return
      end if
      if (has_vector) then
         vector%kind = given
         if (.not. norm2(numbers_of(reading, vector_key, 3)) > 0.0_wp) then
            if (reading%cards(reading%k)%is_good) call complain(reading, vector_key, vector_key//' has zero length')
            return
         end if
         call slot(reading, vector_key, vector%first)
      end if
      call new_vector(reading, vector, direction)
      is_good = .true.
   end subroutine find_direction

   !> Finds the curve named by a key. The index is 0 if no curve is given, or if the curve does not exist or was rejected.
   subroutine find_curve(reading, key, name, curve)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: key, name
      integer, intent(out) :: curve
      integer :: found

      curve = 0
      call look_up(reading, key, curve_group, name, found)
      if (found == 0) return
      if (reading%cards(found)%is_good) curve = reading%cards(found)%index
   end subroutine find_curve

   !> Whether record k is a driver joint.
   pure logical function is_driver(reading, k)
      type(deck_reading_t), intent(in) :: reading
      integer, intent(in) :: k
      is_driver = reading%cards(k)%group == joint_group .and. lower(element(reading%records(k), 'type', 1)) == 'driver'
   end function is_driver

   !> Checks that a case names a driver joint, and finds the dimension of the driven value. A missing joint, and a joint that is not a
   !> driver, are reported as errors.
   subroutine find_driver(reading, name, others, dimension)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: name, others(:)     !! others: other names that may be driven, for suggestions
      integer, intent(inout) :: dimension             !! dimension of the driven value; unchanged if not found
      integer :: j, found

      found = find_card(reading, joint_group, name)
      if (found == 0) then
         if (.not. reading%deck_errors%lacks(joint_group)) &
            call complain(reading, 'drive', 'drive: there is no driver joint '//quoted(name)//did_you_mean(name, &
            [character(word_length) :: pack(reading%cards%name, [(is_driver(reading, j), j=1, size(reading%cards))]), others]))
         return
      end if
      dimension = reading%cards(found)%deflection
      if (.not. is_driver(reading, found)) call complain(reading, 'drive', 'drive: the joint '//quoted(name)//' in '// &
         line_of(reading, found)//' is not a driver')
   end subroutine find_driver

   !> Finds the wheel named by a case. Reports an error if there is no such wheel, or if the case must not name a wheel.
   subroutine find_wheel(reading, may_have_one, which, wheel)
      type(deck_reading_t), intent(inout) :: reading
      logical, intent(in) :: may_have_one
      character(*), intent(in) :: which      !! the cases that take the key `wheel`, for the message
      integer, intent(inout) :: wheel        !! index of the wheel; unchanged if not found
      integer :: found

      if (text_of(reading, 'wheel') == '') return
      call look_up(reading, 'wheel', wheel_group, text_of(reading, 'wheel'), found)
      if (found > 0) wheel = reading%cards(found)%index
      if (.not. may_have_one) call refuse(reading, ['wheel'], 'only a case '//which//' accepts this key')
   end subroutine find_wheel

end module ek_reference
