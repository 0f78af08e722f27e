!> The parameters: the numbers of a deck, each with a path as `--set` writes it.
!>
!> x(k) is the value of parameter k [SI, axes of the deck]. On a mirrored axle, a number of a duplicated record is two parameters
!> with one path, which has no side. The value of the parameter on the right is `sign` × the value on the left.
module ek_parameter
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_text, only: str, lower, quoted, is_like, did_you_mean
   use ek_record, only: record_t, left_side, right_side, element, own_name, sign_of_image
   use ek_group, only: group_names, group_number, is_deck_group, names_of_groups, is_single, include_group, hardpoints_group, &
      point_group, adjuster_group, part_group, part_name, key_t, find_key
   use ek_number_range, only: is_inside
   implicit none(type, external)
   private
   public :: parameter_t, parameters_t, choice_t, add_parameter, find_parameters, put_value, put_change, in_range
   public :: all_in_range, parameter_path, value_path
   public :: path_t, split_path, is_meant, is_addressed, change_t, changed

   character(*), parameter :: left_wheel_alone = 'left_left'     ! in a path

   !> One number of the deck as a parameter of the model.
   type :: parameter_t
      integer :: record = 0               !! index of its record in the mirrored deck
      character(18) :: key = ''
      integer :: at = 1                   !! subscript of the number in its key
      real(wp) :: unit = 1.0_wp           !! SI value of the deck unit of the number
      integer :: range = 0                !! legal range of the key, see ek_number_range
      logical :: is_given = .true.        !! .false.: the deck omits the number, and x has its default
      real(wp) :: sign = 1.0_wp           !! −1: the value on the right side is minus the value on the left
      integer :: tied = 0                 !! index of the parameter of the left side with the same path; 0: none
   end type parameter_t

   !> All parameters with their values in the deck.
   type :: parameters_t
      integer :: used = 0
      type(parameter_t), allocatable :: list(:)     !! the first `used` are filled
      real(wp), allocatable :: x(:)
   end type parameters_t

   !> A parameter to which a path leads, and its sign.
   type :: choice_t
      integer :: number = 0
      real(wp) :: sign = 1.0_wp           !! −1: the number is minus the value written to the path
   end type choice_t

   !> A path, split into its parts; the name is '' for a group without names.
   type :: path_t
      integer :: group = 0
      character(:), allocatable :: name, key
      type(key_t) :: row                     !! row of the key in the table of keys, if `is_known`
      logical :: is_known = .false.
      integer :: first = 1, last = 1         !! subscripts, if `has_subscript`; equal for one element
      logical :: has_subscript = .false.
      logical :: is_wild = .false.           !! the name contains *
   end type path_t

   !> A change of a number: value ← factor × value + term.
   type :: change_t
      logical :: is_relative = .false.
      real(wp) :: factor = 0.0_wp, term = 0.0_wp     !! term: in the unit of the deck
   end type change_t

contains

   !> Splits a path: 'bushing.top_mount.kt(1)' into group, name, key and subscript. 'model.length' and 'axle.wheelbase' have no
   !> name.
   subroutine split_path(text, path, message)
      character(*), intent(in) :: text
      type(path_t), intent(out) :: path
      character(:), allocatable, intent(out) :: message     !! '' if there is no error
      character(:), allocatable :: inside
      integer :: dot, last, mark, colon, status

      message = ''
      path%name = ''
      path%key = ''
      dot = index(text, '.')
      last = index(text, '.', back=.true.)
      if (dot <= 1) then
         message = 'expected group.name.key=value'
         return
      end if
      path%group = group_number(lower(text(:dot - 1)))
      if (.not. is_deck_group(path%group)) then
         message = 'there is no group '//quoted(text(:dot - 1))//did_you_mean(text(:dot - 1), names_of_groups(of_deck=.true.))
      else if (path%group == include_group) then
         message = '--set cannot change an &include'
      else if (path%group == hardpoints_group) then
         message = '--set cannot change &hardpoints; change the points: point.name.z'
      else if (is_single(path%group) .and. dot /= last) then
         message = 'expected '//trim(group_names(path%group))//'.key=value'
      else if (.not. is_single(path%group) .and. dot == last .and. path%group /= adjuster_group) then
         message = 'expected group.name.key=value'
      end if
      if (message /= '') return
      if (dot < last) path%name = text(dot + 1:last - 1)
      path%key = lower(text(last + 1:))
      if (dot == last .and. path%group == adjuster_group) then      ! its value
         path%name = text(dot + 1:)
         path%key = 'value'
      end if
      path%is_wild = index(path%name, '*') > 0
      mark = index(path%key, '(')
      if (mark > 0) then
         path%has_subscript = .true.
         inside = path%key(mark + 1:len(path%key) - 1)
         colon = index(inside, ':')
         status = 1
         if (path%key(len(path%key):) == ')') then
            call read_subscript(inside(:merge(colon - 1, len(inside), colon > 0)), path%first, status)
            path%last = path%first
            if (colon > 0 .and. status == 0) call read_subscript(inside(colon + 1:), path%last, status)
         end if
         if (status == 0 .and. path%last < path%first) status = 1
         if (status /= 0) then
            message = 'the subscript must be one integer, or a range such as 1:3, found '//path%key(mark:)
            return
         end if
         path%key = path%key(:mark - 1)
      end if
      if (path%group == part_group) path%name = part_name(path%name)
      if (any(path%group == [point_group, part_group]) .and. len(path%key) == 1 .and. index('xyz', path%key) > 0) then
         path%first = index('xyz', path%key)
         path%last = path%first
         path%has_subscript = .true.
         path%key = merge('at       ', 'deviation', path%group == point_group)
         path%key = trim(path%key)
      end if
      call find_key(path%group, path%key, path%row, path%is_known)
   end subroutine split_path

   !> Reads a subscript; status is not 0 if the string is no integer of up to six digits.
   pure subroutine read_subscript(text, subscript, status)
      character(*), intent(in) :: text
      integer, intent(inout) :: subscript
      integer, intent(out) :: status

      status = 1
      if (text == '' .or. len(text) > 6 .or. verify(text, '0123456789') > 0) return
      read (text, *, iostat=status) subscript
   end subroutine read_subscript

   !> Whether a path leads to an element of its key: to every element, unless the path has a subscript.
   pure logical function is_addressed(path, element)
      type(path_t), intent(in) :: path
      integer, intent(in) :: element
      is_addressed = .not. path%has_subscript .or. (element >= path%first .and. element <= path%last)
   end function is_addressed

   !> Whether a path leads to a record. The wheel 'left' of a mirrored axle, whose name on the left is that of the half deck, is also
   !> found as 'left_left': the name of every other record on the left begins with left_.
   pure logical function is_meant(record, path)
      type(record_t), intent(in) :: record
      type(path_t), intent(in) :: path

      is_meant = record%group == group_names(path%group)
      if (.not. is_meant .or. is_single(path%group)) return
      is_meant = is_like(element(record, 'name', 1), path%name)
      if (has_name_of_half(record)) is_meant = is_meant .or. lower(path%name) == left_wheel_alone
   end function is_meant

   !> Whether a record of the left side has the name that the half deck uses for both sides: the wheel 'left'.
   pure logical function has_name_of_half(record)
      type(record_t), intent(in) :: record
      has_name_of_half = record%side == left_side
      if (has_name_of_half) has_name_of_half = own_name(record) == element(record, 'name', 1)
   end function has_name_of_half

   !> The number after a change, rounded to 15 digits, as a string: the number that a person would write into the deck.
   function changed(change, value) result(text)
      type(change_t), intent(in) :: change
      real(wp), intent(in) :: value          !! in the unit of the deck
      character(:), allocatable :: text
      text = str(change%factor*value + change%term, 15)
   end function changed

   !> Adds a number of a record as a parameter. parameters%used becomes the index of the parameter.
   subroutine add_parameter(parameters, records, k, row, at, value, unit, is_given)
      type(parameters_t), intent(inout) :: parameters
      type(record_t), intent(in) :: records(:)
      integer, intent(in) :: k, at
      type(key_t), intent(in) :: row                 !! of the key in the table of keys
      real(wp), intent(in) :: value                  !! SI
      real(wp), intent(in) :: unit
      logical, intent(in) :: is_given
      integer :: n, j

      n = parameters%used
      if (n == size(parameters%x)) then
         parameters%list = [parameters%list, parameters%list]      ! twice the size
         parameters%x = [parameters%x, parameters%x]
      end if
      n = n + 1
      parameters%used = n
      parameters%x(n) = value
      parameters%list(n) = parameter_t(k, row%name, at, unit, row%range, is_given)
      if (records(k)%side /= right_side) return
      parameters%list(n)%sign = sign_of_image(records(k), trim(row%name), at)
      do j = n - 1, 1, -1         ! the left record precedes the right one
         if (parameters%list(j)%record /= k - 1) cycle
         if (parameters%list(j)%key /= row%name .or. parameters%list(j)%at /= at) cycle
         parameters%list(n)%tied = j
         return
      end do
   end subroutine add_parameter

   !> Finds the parameters with a path, which may have * instead of names. No parameter is found if the path is illegal or leads to
   !> a string, or to a number that the deck does not give and that has no default. The path of a half deck leads to both sides of
   !> the axle. As in apply_setting, a path with * leads only to numbers that the deck gives.
   subroutine find_parameters(parameters, records, path_text, found)
      type(parameters_t), intent(in) :: parameters
      type(record_t), intent(in) :: records(:)
      character(*), intent(in) :: path_text
      type(choice_t), allocatable, intent(out) :: found(:)
      type(path_t) :: path
      character(:), allocatable :: message
      integer :: k

      allocate (found(0))
      call split_path(trim(adjustl(path_text)), path, message)
      if (message /= '') return
      do k = 1, parameters%used
         associate (this => parameters%list(k), record => records(parameters%list(k)%record))
            if (record%group /= group_names(path%group) .or. this%key /= path%key) cycle
            if (.not. is_addressed(path, this%at)) cycle
            if (path%is_wild .and. .not. this%is_given) cycle
            if (is_like(own_name(record), path%name)) then      ! of both sides, also if a wild name fits the sided name too
               found = [found, choice_t(k, this%sign)]
            else if (is_meant(record, path)) then
               found = [found, choice_t(k, 1.0_wp)]
            end if
         end associate
      end do
   end subroutine find_parameters

   !> Sets the parameters found by a path to a value, which is in the unit of the deck. With the path of a half deck, the parameter
   !> on the right side gets the mirror image of the value.
   pure subroutine put_value(parameters, found, value, x)
      type(parameters_t), intent(in) :: parameters
      type(choice_t), intent(in) :: found(:)
      real(wp), intent(in) :: value
      real(wp), intent(inout) :: x(:)
      integer :: j

      if (are_checked) call require(all(found%number >= 1 .and. found%number <= min(parameters%used, size(x))), &
         'put_value: the parameters are of another deck')
      do j = 1, size(found)
         x(found(j)%number) = (found(j)%sign*value)*parameters%list(found(j)%number)%unit
      end do
   end subroutine put_value

   !> Changes the parameters found by a path, relative to their values in x. With the path of a half deck, the change on the right
   !> side is the mirror image of the change on the left.
   subroutine put_change(parameters, found, change, x)
      type(parameters_t), intent(in) :: parameters
      type(choice_t), intent(in) :: found(:)
      type(change_t), intent(in) :: change
      real(wp), intent(inout) :: x(:)
      character(:), allocatable :: text
      real(wp) :: value
      integer :: j

      do j = 1, size(found)
         associate (unit => parameters%list(found(j)%number)%unit, at => x(found(j)%number))
            text = changed(change, found(j)%sign*at/unit)
            read (text, *) value
            at = found(j)%sign*value*unit
         end associate
      end do
   end subroutine put_change

   !> Whether the parameters found by a path are inside their legal ranges.
   pure logical function in_range(parameters, found, x)
      type(parameters_t), intent(in) :: parameters
      type(choice_t), intent(in) :: found(:)
      real(wp), intent(in) :: x(:)
      integer :: j

      in_range = all([(is_inside(parameters%list(found(j)%number)%range, x(found(j)%number)), j=1, size(found))])
   end function in_range

   !> Whether all parameters are inside their legal ranges.
   pure logical function all_in_range(parameters, x)
      type(parameters_t), intent(in) :: parameters
      real(wp), intent(in) :: x(:)
      integer :: k

      do k = 1, parameters%used
         all_in_range = is_inside(parameters%list(k)%range, x(k))
         if (.not. all_in_range) return
      end do
      all_in_range = .true.
   end function all_in_range

   !> The path of a parameter: 'point.tie_rod_inner.z', 'bushing.top_mount.kt(1)', 'axle.wheelbase'.
   function parameter_path(this, records, is_of_pair) result(path)
      type(parameter_t), intent(in) :: this
      type(record_t), intent(in) :: records(:)
      logical, intent(in), optional :: is_of_pair      !! .true.: the path of the half deck, which leads to both sides; .false.: a
      !!                                                  path that leads to this parameter alone ('wheel.left_left.camber'); absent:
      !!                                                  the name of the record, also if the path leads to both sides
      character(:), allocatable :: path

      path = value_path(records(this%record), trim(this%key), this%at, is_of_pair)
      if (.not. present(is_of_pair)) return
      if (is_of_pair .or. .not. has_name_of_half(records(this%record))) return
      path = records(this%record)%group//'.'//left_wheel_alone//path(index(path, '.', back=.true.):)
   end function parameter_path

   !> The path of a value of a record: 'point.upper_ball_joint.z', 'bushing.top_mount.kt(1)', 'model.length'.
   function value_path(record, key, at, is_of_pair) result(path)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      integer, intent(in) :: at                        !! subscript
      logical, intent(in), optional :: is_of_pair      !! .true.: the path of the half deck, which leads to both sides
      character(:), allocatable :: path
      character(:), allocatable :: name
      logical :: has_half
      character(*), parameter :: axes = 'xyz'
      type(key_t) :: row
      logical :: is_known

      has_half = .false.
      if (present(is_of_pair)) has_half = is_of_pair
      name = element(record, 'name', 1)
      if (has_half) name = own_name(record)
      path = record%group//'.'
      if (record%group == group_names(adjuster_group) .and. key == 'value') then
         path = path//name
         return
      end if
      if (name /= '' .and. .not. is_single(group_number(record%group))) path = path//name//'.'
      if (((record%group == group_names(point_group) .and. key == 'at') .or. &
         (record%group == group_names(part_group) .and. key == 'deviation')) .and. at <= len(axes)) then
         path = path//axes(at:at)
         return
      end if
      path = path//key
      call find_key(group_number(record%group), key, row, is_known)
      if (is_known .and. row%most > 1) path = path//'('//str(at)//')'
   end function value_path

end module ek_parameter
