!> The numbers of a deck that one or several paths match. One procedure decides this for all commands: a path with *, point.a.at(3)
!> and point.a.z, the path of a half deck and the path of one side may match the same number.
!>
!> - Within a factor, a number counts once, also if several paths match it.
!> - A number belongs to one factor only. `claim` returns the factor that already has the number.
module ek_matched_numbers
   use ek_kinds, only: wp
   use ek_text, only: quoted, is_like
   use ek_record, only: record_t, right_side, own_name, sign_of_image, entry_index
   use ek_group, only: group_names
   use ek_parameter, only: parameter_t, parameters_t, choice_t, find_parameters, path_t, split_path, is_meant, parameter_path
   implicit none(type, external)
   private
   public :: match_t, matches_t, match_paths, match_parameters, match_records, choices_of, match_name
   public :: claims_t, new_claims, claim, setting_path_t, separate_settings

   !> A number of the deck: an element of a key of a record of the finished deck.
   type :: match_t
      integer :: record = 0                !! index of the record; with &mirror, each side has its own record
      character(18) :: key = ''
      integer :: at = 1                    !! subscript of the number in its key
      real(wp) :: sign = 1.0_wp            !! −1: the number is minus the value written to the path
      integer :: number = 0                !! index of the parameter; 0: the number is not a parameter
      integer :: path = 0                  !! index of the first path that matches the number
   end type match_t

   !> The numbers that the paths of one factor match, each once.
   type :: matches_t
      type(match_t), allocatable :: list(:)
      logical :: has_repeated = .false.    !! at least one number is matched by more than one path
      logical :: has_text = .false.        !! at least one path leads to no parameter: the deck must be read again to change it
   end type matches_t

   !> The factor of each number that was claimed.
   type :: claims_t
      private
      integer, allocatable :: owner(:)                !! factor of each parameter; 0: none
      type(match_t), allocatable :: others(:)         !! numbers that are not parameters, and their factors as `path`
   end type claims_t

   !> A path that changes numbers in the text of a deck, with the sign of the value to be written.
   type :: setting_path_t
      character(:), allocatable :: path
      real(wp) :: sign = 1.0_wp
   end type setting_path_t

contains

   !> Finds the numbers that paths match, each once, with the sign of the first path that matches it.
   subroutine match_paths(parameters, records, paths, is_relative, matches, message)
      type(parameters_t), intent(in) :: parameters
      type(record_t), intent(in) :: records(:)             !! records of the finished deck
      character(*), intent(in) :: paths(:)
      logical, intent(in) :: is_relative                   !! the numbers are increased or multiplied, not replaced
      type(matches_t), intent(out) :: matches
      character(:), allocatable, intent(out) :: message    !! two paths change one number in opposite directions; '' otherwise
      type(match_t), allocatable :: these(:), kept(:)
      type(choice_t), allocatable :: found(:)
      integer :: place(parameters%used), k, j, before, used

      message = ''
      place = 0
      allocate (matches%list(0))
      do k = 1, size(paths)
         call match_parameters(parameters, records, trim(paths(k)), is_relative, found)
         if (size(found) > 0) then
            these = matches_of(parameters, found)
         else
            matches%has_text = .true.
            call match_records(records, trim(paths(k)), is_relative, these)
         end if
         these%path = k
         allocate (kept(size(these)))
         used = 0
         do j = 1, size(these)
            if (these(j)%number > 0) then
               before = place(these(j)%number)
            else
               before = same_number(these(j), matches%list)
            end if
            if (before == 0) then
               used = used + 1
               kept(used) = these(j)
               if (these(j)%number > 0) place(these(j)%number) = size(matches%list) + used
               cycle
            end if
            if (before > size(matches%list)) cycle         ! of the same path
            matches%has_repeated = .true.
            if (message == '' .and. abs(matches%list(before)%sign - these(j)%sign) > 0.0_wp) message = 'its paths '// &
               quoted(trim(paths(matches%list(before)%path)))//' and '//quoted(trim(paths(k)))//' change '// &
               match_name(records, these(j))//' in opposite directions; remove one of them'
         end do
         matches%list = [matches%list, kept(:used)]
         deallocate (kept)
      end do
   end subroutine match_paths

   !> Finds the parameters that a path changes, as apply_setting does: a number that the deck does not give is not increased or
   !> multiplied, and one value replaces the first element of a list without a subscript.
   subroutine match_parameters(parameters, records, path_text, is_relative, found)
      type(parameters_t), intent(in) :: parameters
      type(record_t), intent(in) :: records(:)             !! records of the finished deck
      character(*), intent(in) :: path_text
      logical, intent(in) :: is_relative
      type(choice_t), allocatable, intent(out) :: found(:)

      call find_parameters(parameters, records, path_text, found)
      if (size(found) < 2 .and. .not. is_relative) return
      if (is_relative) then
         found = pack(found, parameters%list(found%number)%is_given)
      else if (index(path_text, '(') == 0) then
         if (all([character(2) :: '.x', '.y', '.z'] /= path_text(max(1, len(path_text) - 1):))) &
            found = pack(found, parameters%list(found%number)%at == 1)
      end if
   end subroutine match_parameters

   !> Finds the numbers and strings of the records that a path matches. With &mirror, the path of the half deck matches both sides.
   subroutine match_records(records, path_text, is_relative, matches)
      type(record_t), intent(in) :: records(:)
      character(*), intent(in) :: path_text
      logical, intent(in) :: is_relative
      type(match_t), allocatable, intent(out) :: matches(:)
      type(path_t) :: path
      character(:), allocatable :: message
      integer :: k, e, v

      allocate (matches(0))
      call split_path(trim(adjustl(path_text)), path, message)
      if (message /= '') return
      do k = 1, size(records)
         if (.not. allocated(records(k)%group)) cycle
         if (records(k)%group /= group_names(path%group)) cycle
         if (.not. (is_like(own_name(records(k)), path%name) .or. is_meant(records(k), path))) cycle
         if (path%has_subscript) then
            if (path%is_wild .and. entry_index(records(k), path%key, 0) == 0) cycle
            do v = path%first, path%last
               call add(k, v)
            end do
            cycle
         end if
         do e = 1, records(k)%used
            if (records(k)%entries(e)%key /= path%key) cycle
            do v = 1, records(k)%entries(e)%used
               if (.not. is_relative .and. records(k)%entries(e)%first + v > 2) exit
               call add(k, records(k)%entries(e)%first + v - 1)
            end do
         end do
         if (entry_index(records(k), path%key, 0) == 0 .and. .not. path%is_wild) call add(k, 1)
      end do

   contains

      !> Adds one element of the key of record k.
      subroutine add(k, at)
         integer, intent(in) :: k, at
         type(match_t) :: this

         this%record = k
         this%key = path%key
         this%at = at
         if (records(k)%side == right_side .and. is_like(own_name(records(k)), path%name)) &
            this%sign = sign_of_image(records(k), path%key, at)
         matches = [matches, this]
      end subroutine add

   end subroutine match_records

   !> The parameters of a path as numbers of the deck.
   pure function matches_of(parameters, found) result(matches)
      type(parameters_t), intent(in) :: parameters
      type(choice_t), intent(in) :: found(:)
      type(match_t) :: matches(size(found))
      integer :: k

      do k = 1, size(found)
         associate (this => parameters%list(found(k)%number))
            matches(k) = match_t(this%record, this%key, this%at, found(k)%sign, found(k)%number, 1)
         end associate
      end do
   end function matches_of

   !> The parameters of a factor; empty if one of its paths leads to no parameter, because the deck is then read again.
   pure function choices_of(matches) result(found)
      type(matches_t), intent(in) :: matches
      type(choice_t), allocatable :: found(:)
      integer :: k

      allocate (found(0))
      if (.not. matches%has_text) found = [(choice_t(matches%list(k)%number, matches%list(k)%sign), k=1, size(matches%list))]
   end function choices_of

   !> Index of the first number of a list that is the same number; 0 if there is none.
   pure integer function same_number(this, list) result(k)
      type(match_t), intent(in) :: this, list(:)

      do k = 1, size(list)
         if (list(k)%record == this%record .and. list(k)%at == this%at .and. list(k)%key == this%key) return
      end do
      k = 0
   end function same_number

   !> Prepares the claims on the numbers of a deck.
   pure subroutine new_claims(parameters, claims)
      type(parameters_t), intent(in) :: parameters
      type(claims_t), intent(out) :: claims

      allocate (claims%owner(parameters%used), source=0)
      allocate (claims%others(0))
   end subroutine new_claims

   !> Gives the numbers of a list to a factor. If another factor has one of the numbers, `other` is this factor and `shared` are the
   !> numbers that both have; otherwise `other` is 0.
   pure subroutine claim(claims, list, factor, other, shared)
      type(claims_t), intent(inout) :: claims
      type(match_t), intent(in) :: list(:)
      integer, intent(in) :: factor                        !! index of the factor, above 0
      integer, intent(out) :: other
      type(match_t), allocatable, intent(out) :: shared(:)
      logical :: is_shared(size(list))
      integer :: k, j, owner

      other = 0
      is_shared = .false.
      do k = 1, size(list)
         if (list(k)%number > 0) then
            owner = claims%owner(list(k)%number)
         else
            j = same_number(list(k), claims%others)
            owner = 0
            if (j > 0) owner = claims%others(j)%path
         end if
         if (owner == factor) cycle
         if (owner > 0) then
            if (other == 0) other = owner
            is_shared(k) = owner == other
         else if (list(k)%number > 0) then
            claims%owner(list(k)%number) = factor
         else
            claims%others = [claims%others, list(k)]
            claims%others(size(claims%others))%path = factor
         end if
      end do
      shared = pack(list, is_shared)
   end subroutine claim

   !> The path of a number: 'point.left_tie_rod.z'. If `list` also contains the number of the other side, the path of the half deck:
   !> 'point.tie_rod.z'.
   function match_name(records, this, list) result(path)
      type(record_t), intent(in) :: records(:)
      type(match_t), intent(in) :: this
      type(match_t), intent(in), optional :: list(:)
      character(:), allocatable :: path
      logical :: is_of_pair

      is_of_pair = .false.
      if (present(list)) is_of_pair = opposite(records, this, list) > 0
      path = parameter_path(parameter_t(record=this%record, key=this%key, at=this%at), records, is_of_pair)
   end function match_name

   !> Index of the number of the other side in a list; 0 if the list does not contain it. The left record precedes the right one.
   pure integer function opposite(records, this, list) result(k)
      type(record_t), intent(in) :: records(:)
      type(match_t), intent(in) :: this, list(:)
      type(match_t) :: image

      k = 0
      if (records(this%record)%side == 0) return
      image = this
      image%record = this%record + merge(-1, 1, records(this%record)%side == right_side)
      k = same_number(image, list)
   end function opposite

   !> Finds the paths that change each number of a factor once in the text of the deck: the paths of the factor, unless several of
   !> them match one number.
   subroutine separate_settings(records, matches, paths, settings)
      type(record_t), intent(in) :: records(:)
      type(matches_t), intent(in) :: matches
      character(*), intent(in) :: paths(:)
      type(setting_path_t), allocatable, intent(out) :: settings(:)
      type(setting_path_t) :: this
      integer :: k, j

      allocate (settings(0))
      if (.not. matches%has_repeated) then
         do k = 1, size(paths)
            this%path = trim(paths(k))
            settings = [settings, this]
         end do
         return
      end if
      do k = 1, size(matches%list)
         associate (number => matches%list(k))
            j = opposite(records, number, matches%list)
            if (j > 0) then
               if (is_image(number, matches%list(j))) then
                  if (records(number%record)%side == right_side) cycle         ! with the left side
                  this%path = match_name(records, number, matches%list)
                  this%sign = number%sign
                  settings = [settings, this]
                  cycle
               end if
            end if
            this%path = match_name(records, number)
            this%sign = number%sign
            settings = [settings, this]
         end associate
      end do

   contains

      !> Whether the numbers of both sides change as mirror images of each other.
      pure logical function is_image(one, other)
         type(match_t), intent(in) :: one, other
         real(wp) :: sign

         sign = sign_of_image(records(max(one%record, other%record)), trim(one%key), one%at)
         is_image = abs(one%sign*sign - other%sign) < 0.5_wp
      end function is_image

   end subroutine separate_settings

end module ek_matched_numbers
