!> &mirror: converts a deck of the left half of an axle to the deck of both sides.
!>
!> The conversion uses records before names are looked up, so that the reader does not depend on mirroring. Points off the plane y =
!> 0 and all bodies are duplicated as left_<name> and right_<name>, unless the name is in `shared` or begins with left_ or right_.
!> Every element that refers to a duplicated part is also duplicated. An element is not duplicated if it is in `shared`, if its name
!> has a side, or if it refers to a name with a side.
!>
!> The right side is the image under y → −y: a polar vector v becomes M v with M = diag(1, −1, 1), an axial vector (a moment,
!> the axis of a rotation) becomes −M v. The x and z axes of a bushing are mirrored as directions, so y = z × x becomes
!> −M y: in marker axes, forces change the sign of y, moments the signs of x and z.
module ek_mirror
   use ek_kinds, only: wp, units_t
   use ek_text, only: str, lower, quoted, did_you_mean
   use ek_record, only: deck_errors_t, has_side, left_side, right_side, side_prefix, record_t, entry_t, add_record, &
      add_value, element, entry_index, place_of, line_text, role_of, sign_of_image, turns
   use ek_group, only: group_names, group_number, point_group, word_length, record_head, is_element, can_be_doubled, &
      number, point_group, body_group, measure_group, adjuster_group, align_group, part_group, wheel_group, &
      load_group, polar, axial, curves, wheel_side
   use ek_namelist, only: value_fault
   use ek_attachment, only: units_in_deck
   implicit none(type, external)
   private
   public :: mirror_records

   real(wp), parameter :: in_plane = 1.0e-9_wp      !! a point closer than this to y = 0 exists once [m]

   !> Information about the half deck during duplication, one array element per record.
   type :: half_t
      integer, allocatable :: groups(:)
      character(word_length), allocatable :: names(:)   !! names in lower case; '' if there is no usable name
      logical, allocatable :: is_doubled(:), is_shared(:)
      logical, allocatable :: is_right(:)            !! whether the record is a wheel of the right side, which is rejected
      real(wp) :: length = 1.0e-3_wp                 !! the deck's length unit [m]
      real(wp) :: outboard = -1.0_wp                 !! sign of y on the left
   end type half_t

contains

   !> Writes the records of both sides. The right record follows its left record.
   subroutine mirror_records(records, used, whole, whole_used, deck_errors)
      type(record_t), intent(in) :: records(:)
      integer, intent(in) :: used
      type(record_t), allocatable, intent(out) :: whole(:)     !! the first `whole_used` are filled
      integer, intent(out) :: whole_used
      type(deck_errors_t), intent(inout) :: deck_errors
      type(half_t) :: half
      type(record_t) :: copy
      integer :: k, side

      allocate (whole(2*max(used, 1)))
      whole_used = 0
      call survey(records(:used), half, deck_errors)
      do k = 1, used
         if (half%is_doubled(k)) then
            do side = left_side, right_side
               copy = records(k)
               copy%side = side
               call rename(half, side, copy)
               if (side == right_side) call reflect(copy)
               call add_record(whole, whole_used, copy)
            end do
         else if (.not. (half%is_right(k) .and. any(half%is_doubled .and. half%groups == wheel_group))) then
            copy = records(k)
            call keep_single(half, half%is_right(k), copy, deck_errors)
            call add_record(whole, whole_used, copy)
         end if
      end do
   end subroutine mirror_records

   !> Determines which records are duplicated, and reports errors of the half deck.
   subroutine survey(records, half, deck_errors)
      type(record_t), intent(in) :: records(:)
      type(half_t), intent(out) :: half
      type(deck_errors_t), intent(inout) :: deck_errors
      type(units_t) :: units
      logical :: is_iso
      integer :: mirror, pass, k, e

      allocate (half%groups(size(records)), half%names(size(records)))
      allocate (half%is_doubled(size(records)), half%is_shared(size(records)), half%is_right(size(records)), source=.false.)
      half%names = ''
      mirror = 0
      do k = 1, size(records)
         half%groups(k) = group_number(records(k)%group)
         e = entry_index(records(k), 'name', 1)
         if (e > 0) then
            associate (name => records(k)%entries(e)%values(1))
               if (name%is_string .and. len_trim(name%text) <= word_length) half%names(k) = lower(name%text)
            end associate
         end if
         select case (records(k)%group)
         case ('mirror')
            if (mirror > 0) call complain(deck_errors, records(k), '', 'a second &mirror; the first is in '// &
               line_text(records(mirror), records(k)))
            if (mirror == 0) mirror = k
         case ('model')
            call units_in_deck(records(k:k), units, is_iso)
            half%length = units%length
            half%outboard = merge(1.0_wp, -1.0_wp, is_iso)
         case ('wheel')
            half%is_right(k) = lower(element(records(k), 'side', 1)) == 'right'
            if (half%is_right(k)) call complain(deck_errors, records(k), 'side', &
               "a deck with &mirror must describe the left half, found side = 'right'")
         end select
      end do
      if (mirror == 0) return
      call find_shared(records(mirror), half, deck_errors)

      do k = 1, size(records)
         if (is_of_one(half, k)) cycle
         if (half%groups(k) == body_group) half%is_doubled(k) = .not. any(half%names(k) == [character(7) :: 'chassis', 'ground'])
         if (half%groups(k) == point_group) call judge_point(records(k), half, half%is_doubled(k), deck_errors)
      end do
      do pass = 1, 5      ! wheels and measures first, then parts, adjusters of parts, and &align, which refers to adjusters
         do k = 1, size(records)
            if (.not. is_element(half%groups(k)) .or. is_of_one(half, k)) cycle
            if (pass == pass_of(half%groups(k))) half%is_doubled(k) = follows(records(k), half)
         end do
      end do
      do k = 1, size(records)
         if (.not. half%is_doubled(k) .or. len_trim(half%names(k)) <= word_length - len(side_prefix)) cycle
         call complain(deck_errors, records(k), 'name', 'a name that &mirror duplicates must have at most '// &
            str(word_length - len(side_prefix))//' characters, found '//str(len_trim(half%names(k))))
      end do
   end subroutine survey

   !> The pass in which records of a group are judged.
   pure integer function pass_of(group)
      integer, intent(in) :: group

      pass_of = 3
      if (group == wheel_group) pass_of = 1
      if (group == measure_group) pass_of = 2
      if (any(group == [adjuster_group, part_group])) pass_of = 4
      if (group == align_group) pass_of = 5
   end function pass_of

   !> Finds the names in `shared`, each of which must exist. 'none' alone stands for an empty list unless a record has this name.
   subroutine find_shared(mirror, half, deck_errors)
      type(record_t), intent(in) :: mirror
      type(half_t), intent(inout) :: half
      type(deck_errors_t), intent(inout) :: deck_errors
      logical :: is_candidate(size(half%names)), is_it(size(half%names))
      integer :: e, v, k

      is_candidate = [(can_be_doubled(half%groups(k)), k=1, size(half%names))]
      do e = 1, mirror%used
         if (mirror%entries(e)%key /= 'shared') cycle
         do v = 1, mirror%entries(e)%used
            associate (value => mirror%entries(e)%values(v))
               if (.not. value%is_string .or. value%text == '') cycle     ! reported by the check of keys
               is_it = half%names == lower(value%text)
               half%is_shared = half%is_shared .or. (is_it .and. is_candidate)
               if (any(is_it) .or. (mirror%entries(e)%used == 1 .and. lower(value%text) == 'none')) cycle
               if (.not. deck_errors%lacks(point_group)) &
                  call complain(deck_errors, mirror, 'shared', 'shared: there is no body, point or element '// &
                  quoted(value%text)//did_you_mean(value%text, pack(half%names, is_candidate)))
            end associate
         end do
      end do
   end subroutine find_shared

   !> Whether record k exists only once: its name is in `shared` or has a side, or the record is a rejected right wheel.
   pure logical function is_of_one(half, k)
      type(half_t), intent(in) :: half
      integer, intent(in) :: k
      is_of_one = half%is_shared(k) .or. half%is_right(k) .or. has_side(half%names(k))
   end function is_of_one

   !> Decides whether a point is duplicated. A point in the plane is not; any other point must be on the left.
   subroutine judge_point(point, half, is_doubled, deck_errors)
      type(record_t), intent(in) :: point
      type(half_t), intent(in) :: half
      logical, intent(out) :: is_doubled
      type(deck_errors_t), intent(inout) :: deck_errors
      real(wp) :: y
      integer :: e

      is_doubled = .true.
      e = entry_index(point, 'at', 2)
      if (e == 0) return
      associate (given => point%entries(e)%values(3 - point%entries(e)%first))
         if (value_fault(given, number) /= '') return
         read (given%text, *) y
      end associate
      is_doubled = abs(y)*half%length >= in_plane
      ! for a deck of the right half, only the wheel is reported
      if (.not. is_doubled .or. any(half%is_right)) return
      if (y*half%outboard < 0.0_wp) call complain(deck_errors, point, 'at', &
         'a deck with &mirror must describe the left half, found y = '//str(y)//' on the right (y points '// &
         trim(merge('left ', 'right', half%outboard > 0.0_wp))//'); list a point that exists only once in shared')
   end subroutine judge_point

   !> Whether an element is duplicated because it refers to a duplicated record. A reference to a name with a side prevents this.
   logical function follows(record, half)
      type(record_t), intent(in) :: record
      type(half_t), intent(in) :: half
      integer :: e, v, role

      follows = .false.
      do e = 1, record%used
         role = role_of(record, record%entries(e)%key)
         if (role < 1 .or. role > size(group_names)) cycle      ! not the name of a record
         do v = 1, record%entries(e)%used
            associate (text => record%entries(e)%values(v)%text)
               ! a reference has a side: the element exists once
               if (has_side(text) .and. contact_stem(half, role, text) == 0) then
                  follows = .false.
                  return
               end if
               if (is_doubled_name(half, role, text)) follows = .true.
            end associate
         end do
      end do
   end function follows

   !> Whether a name is the name of a duplicated record, whose group is `role`.
   pure logical function is_doubled_name(half, role, name)
      type(half_t), intent(in) :: half
      integer, intent(in) :: role
      character(*), intent(in) :: name

      is_doubled_name = any(half%is_doubled .and. half%groups == role .and. half%names == lower(name)) .and. name /= ''
      if (.not. is_doubled_name) is_doubled_name = contact_stem(half, role, name) > 0
   end function is_doubled_name

   !> Length of the name of a duplicated wheel in <wheel>_contact, if the name is not that of a point; otherwise 0.
   pure integer function contact_stem(half, role, name) result(stem)
      type(half_t), intent(in) :: half
      integer, intent(in) :: role
      character(*), intent(in) :: name
      character(*), parameter :: ending = '_contact'

      stem = len_trim(name) - len(ending)
      if (role /= point_group .or. stem <= 0) then
         stem = 0
      else if (name(stem + 1:) /= ending .or. any(half%groups == point_group .and. half%names == lower(name)) .or. &
         .not. any(half%is_doubled .and. half%groups == wheel_group .and. half%names == lower(name(:stem)))) then
         stem = 0
      end if
   end function contact_stem

   !> Renames a duplicated record for one side, and its references to other duplicated records.
   subroutine rename(half, side, record)
      type(half_t), intent(in) :: half
      integer, intent(in) :: side
      type(record_t), intent(inout) :: record
      integer :: e, v, role, stem

      do e = 1, record%used
         associate (entry => record%entries(e))
            role = role_of(record, entry%key)
            do v = 1, entry%used
               associate (value => entry%values(v))
                  if (.not. value%is_string .or. value%text == '') cycle
                  if (entry%key == 'name' .and. len_trim(value%text) <= word_length) then
                     value%text = name_on_side(group_number(record%group), value%text, side)
                  else if (is_doubled_name(half, role, value%text)) then
                     stem = contact_stem(half, role, value%text)
                     if (stem > 0) then
                        value%text = name_on_side(wheel_group, value%text(:stem), side)//value%text(stem + 1:)
                     else
                        value%text = name_on_side(role, value%text, side)
                     end if
                  end if
               end associate
            end do
         end associate
      end do
   end subroutine rename

   !> The name on one side: left_<name> or right_<name>; the wheel 'left' becomes 'left' and 'right'. A name that is too long is
   !> cut; `survey` reports it.
   pure function name_on_side(group, name, side) result(renamed)
      integer, intent(in) :: group, side
      character(*), intent(in) :: name
      character(:), allocatable :: renamed

      if (group == wheel_group .and. lower(name) == 'left') then
         renamed = trim(merge('left ', 'right', side == left_side))
      else
         renamed = trim(side_prefix(side))//trim(name)
         renamed = renamed(:min(len(renamed), word_length))
      end if
   end function name_on_side

   !> Changes the references of a record that exists once. A reference of a case to a duplicated load is replaced by the loads of
   !> both sides. Any other reference to a duplicated record is an error.
   subroutine keep_single(half, is_refused, record, deck_errors)
      type(half_t), intent(in) :: half
      logical, intent(in) :: is_refused        !! a wheel of the right side, already reported
      type(record_t), intent(inout) :: record
      type(deck_errors_t), intent(inout) :: deck_errors
      type(record_t) :: original
      character(:), allocatable :: left, right
      integer :: e, v, role

      original = record
      do e = 1, record%used
         role = role_of(record, record%entries(e)%key)
         if (role == load_group) then
            do v = 1, original%entries(e)%first - 1     ! load(2) = … moves up if load(1) was duplicated
               if (is_doubled_name(half, role, element(original, original%entries(e)%key, v))) &
                  record%entries(e)%first = record%entries(e)%first + 1
            end do
            call expand(half, role, record%entries(e))
            cycle
         end if
         do v = 1, record%entries(e)%used
            associate (value => record%entries(e)%values(v))
               if (.not. is_doubled_name(half, role, value%text)) cycle
               left = name_on_side(role, value%text, left_side)
               right = name_on_side(role, value%text, right_side)
               if (left == value%text) cycle
               if (.not. is_refused) call complain(deck_errors, record, record%entries(e)%key, record%entries(e)%key// &
                  ': &mirror duplicates the '//trim(group_names(role))//' '//quoted(value%text)//'; use '//quoted(left)// &
                  ' or '//quoted(right))
               value%text = left
            end associate
         end do
      end do
   end subroutine keep_single

   !> Replaces every mirrored load by the loads of both sides.
   subroutine expand(half, role, entry)
      type(half_t), intent(in) :: half
      integer, intent(in) :: role
      type(entry_t), intent(inout) :: entry
      type(entry_t) :: both
      integer :: v, side

      both = entry
      both%used = 0
      do v = 1, entry%used
         associate (value => entry%values(v))
            if (is_doubled_name(half, role, value%text)) then
               do side = left_side, right_side
                  call add_value(both, name_on_side(role, value%text, side), value%is_string)
               end do
            else
               call add_value(both, value%text, value%is_string)
            end if
         end associate
      end do
      entry = both
   end subroutine expand

   !> Turns a record into its mirror image; names are unchanged, and invalid numbers are left for the check of values.
   subroutine reflect(record)
      type(record_t), intent(inout) :: record
      integer :: e, v

      do e = 1, record%used
         associate (entry => record%entries(e))
            do v = 1, entry%used
               select case (role_of(record, entry%key))
               case (polar, axial)
                  if (sign_of_image(record, entry%key, entry%first + v - 1) < 0.0_wp .and. &
                     value_fault(entry%values(v), number) == '') call turn_number(entry%values(v)%text)
               case (curves)
                  call turn_curve(entry%values(v)%text)
               case (wheel_side)
                  if (lower(entry%values(v)%text) == 'left') entry%values(v)%text = 'right'
               end select
            end do
            if (entry%key == 'axis' .and. turns(record)) call exchange_ends(entry)
         end associate
      end do
   end subroutine reflect

   !> Changes the sign of a number: '5' ↔ '-5'; a zero is unchanged.
   subroutine turn_number(text)
      character(:), allocatable, intent(inout) :: text

      if (verify(text(:scan(text//'e', 'eEdD') - 1), '+-0.') == 0) return
      select case (text(1:1))
      case ('-')
         text = text(2:)
      case ('+')
         text = '-'//text(2:)
      case default
         text = '-'//text
      end select
   end subroutine turn_number

   !> Reflects a reference to a curve: 'fy=c' ↔ 'fy=-c'. Only the components whose sign changes in marker axes are reflected.
   subroutine turn_curve(text)
      character(:), allocatable, intent(inout) :: text
      character(:), allocatable :: name, component
      integer :: mark

      mark = index(text, '=')
      component = trim(adjustl(lower(text(:max(mark - 1, 0)))))
      if (.not. any(component == [character(2) :: 'fy', 'mx', 'mz'])) return
      name = '-'//trim(adjustl(text(mark + 1:)))
      if (index(name, '--') == 1) name = trim(adjustl(name(3:)))
      text = component//'='//name
   end subroutine turn_curve

   !> Exchanges the two points of an axis, also if the entry gives only one of them.
   subroutine exchange_ends(entry)
      type(entry_t), intent(inout) :: entry

      if (entry%used == 2 .and. entry%first == 1) then
         entry%values(:2) = entry%values([2, 1])
      else if (entry%used == 1 .and. entry%first <= 2) then
         entry%first = 3 - entry%first
      end if
   end subroutine exchange_ends

   !> Reports an error at a key of a record, or at the record if the key is ''.
   subroutine complain(deck_errors, record, key, what)
      type(deck_errors_t), intent(inout) :: deck_errors
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key, what
      call deck_errors%add(place_of(record, entry_index(record, key, 0)), &
         record_head(group_number(record%group), element(record, 'name', 1))//what)
   end subroutine complain

end module ek_mirror
