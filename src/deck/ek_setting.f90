!> Settings from the command line or a study: `group.name.key=value` changes numbers and texts of a deck.
!>
!> | path                | meaning                                                  |
!> |---------------------|----------------------------------------------------------|
!> | point.upper.z       | one number; also point.upper.at(3)                       |
!> | bushing.*.kt(1)     | of every bushing that has it; * stands for any characters |
!> | axle.wheelbase      | of a group without names                                 |
!>
!> | value  | meaning                                                    |
!> |--------|------------------------------------------------------------|
!> | 105.5  | replaces the value                                         |
!> | *1.1   | a number: multiplies it                                    |
!> | +2     | a number: adds to it, in the unit of the deck; +-2 subtracts |
module ek_setting
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted, plural, is_like
   use ek_error, only: error_t, fail, exit_usage
   use ek_record, only: record_t, entry_t, add_entry, add_value, entry_index, element
   use ek_scanner, only: scan_values
   use ek_group, only: group_names, group_number, is_deck_group, names_of_groups, is_single, include_group, point_group, &
      key_t, find_key, did_you_mean, unknown_key, word, prose, number, word_length
   use ek_namelist, only: value_fault
   implicit none(type, external)
   private
   public :: path_t, split_path, apply_setting, split_setting, change_t, read_change, changed

   !> A path, split; without a name for a group that has none.
   type :: path_t
      integer :: group = 0
      character(:), allocatable :: name, key
      type(key_t) :: row                     !! of the key, if the group has it
      logical :: is_known = .false.
      integer :: first = 1
      logical :: has_subscript = .false.
      logical :: is_wild = .false.           !! the name contains *
   end type path_t

   !> A change of a number: value ← factor × value + term.
   type :: change_t
      logical :: is_relative = .false.
      real(wp) :: factor = 0.0_wp, term = 0.0_wp     !! term: in the unit of the deck
   end type change_t

contains

   !> Splits 'path=value' at its first = sign.
   subroutine split_setting(setting, path, value, error)
      character(*), intent(in) :: setting
      character(:), allocatable, intent(out) :: path, value
      type(error_t), allocatable, intent(out) :: error
      integer :: mark

      mark = index(setting, '=')
      if (mark <= 1 .or. mark == len_trim(setting)) then
         path = ''
         value = ''
         call fail(error, exit_usage, '--set '//trim(setting)//': expected group.name.key=value')
         return
      end if
      path = trim(adjustl(setting(:mark - 1)))
      value = trim(adjustl(setting(mark + 1:)))
   end subroutine split_setting

   !> Changes the records given by the path; `message` describes a mistake, '' if there is none.
   subroutine apply_setting(records, used, path_text, text, message, is_found)
      type(record_t), intent(inout) :: records(:)
      integer, intent(in) :: used
      character(*), intent(in) :: path_text, text
      character(:), allocatable, intent(out) :: message
      logical, intent(out) :: is_found     !! a record exists, even if there is another mistake
      character(:), allocatable :: setting
      type(path_t) :: path
      type(entry_t) :: given
      type(change_t) :: change
      logical :: is_changed
      integer :: j

      is_found = .false.
      setting = trim(adjustl(path_text))//'='//trim(adjustl(text))
      call split_path(trim(adjustl(path_text)), path, message)
      if (message == '') call check_target(records(:used), path, is_found, message)
      if (message == '') message = key_fault(path)
      if (message == '' .and. path%row%type == number) call read_change(text, change)
      if (message == '' .and. .not. change%is_relative) call read_values(text, path, given, message)
      is_changed = .false.
      if (message == '') then
         do j = 1, used
            if (.not. is_meant(records(j), path)) cycle
            if (change%is_relative) then
               call change_numbers(records(j), path, change, setting, is_changed)
            else if (.not. path%is_wild .or. entry_index(records(j), path%key, 0) > 0) then
               call put_values(records(j), given, setting)
               is_changed = .true.
            end if
            if (.not. path%is_wild) exit
         end do
         if (.not. is_changed) message = path%key//' is not given in the deck'// &
            trim(merge(', so it cannot be changed by '//trim(text), repeat(' ', 30 + len_trim(text)), change%is_relative))
      end if
      if (message /= '') message = '--set '//setting//': '//message
   end subroutine apply_setting

   !> Whether a path leads to this record.
   pure logical function is_meant(record, path)
      type(record_t), intent(in) :: record
      type(path_t), intent(in) :: path

      is_meant = record%group == group_names(path%group)
      if (is_meant .and. .not. is_single(path%group)) is_meant = is_like(element(record, 'name', 1), path%name)
   end function is_meant

   !> The message if a path leads to no record.
   subroutine check_target(records, path, is_found, message)
      type(record_t), intent(in) :: records(:)
      type(path_t), intent(in) :: path
      logical, intent(out) :: is_found
      character(:), allocatable, intent(out) :: message
      character(word_length), allocatable :: names(:)
      integer :: j

      message = ''
      is_found = .false.
      allocate (names(size(records)))
      names = ''
      do j = 1, size(records)
         is_found = is_found .or. is_meant(records(j), path)
         if (records(j)%group == group_names(path%group)) names(j) = element(records(j), 'name', 1)
      end do
      if (is_found) return
      if (is_single(path%group)) then
         message = 'the deck has no &'//trim(group_names(path%group))
      else
         message = 'there is no '//trim(group_names(path%group))//' '//quoted(path%name)//did_you_mean(path%name, names)
      end if
   end subroutine check_target

   !> The message if the group has no such key.
   pure function key_fault(path) result(message)
      type(path_t), intent(in) :: path
      character(:), allocatable :: message

      message = ''
      if (.not. path%is_known) message = unknown_key(path%group, path%key)
   end function key_fault

   !> '*1.1' or '+2'; anything else is not relative.
   subroutine read_change(text, change)
      character(*), intent(in) :: text
      type(change_t), intent(out) :: change
      type(entry_t) :: entry
      character(:), allocatable :: message
      real(wp) :: value

      if (len_trim(text) < 2) return
      if (scan(text(:1), '*+') == 0) return
      call scan_values(trim(text(2:)), entry, message)
      if (message /= '' .or. entry%used /= 1) return
      if (value_fault(entry%values(1), number) /= '') return
      read (entry%values(1)%text, *) value
      change%is_relative = .true.
      if (text(:1) == '*') then
         change%factor = value
      else
         change%factor = 1.0_wp
         change%term = value
      end if
   end subroutine read_change

   !> The number after a change, rounded to 15 digits: the number that a person would write into the deck.
   function changed(change, value) result(text)
      type(change_t), intent(in) :: change
      real(wp), intent(in) :: value          !! in the unit of the deck
      character(:), allocatable :: text
      text = str(change%factor*value + change%term, 15)
   end function changed

   !> Changes the numbers of a record that the path means and the deck gives.
   subroutine change_numbers(record, path, change, setting, is_changed)
      type(record_t), intent(inout) :: record
      type(path_t), intent(in) :: path
      type(change_t), intent(in) :: change
      character(*), intent(in) :: setting
      logical, intent(inout) :: is_changed
      real(wp) :: old
      integer :: e, v

      do e = 1, record%used
         associate (entry => record%entries(e))
            if (entry%key /= path%key) cycle
            do v = 1, entry%used
               if (path%has_subscript .and. entry%first + v - 1 /= path%first) cycle
               if (value_fault(entry%values(v), number) /= '') cycle      ! reported by check_record
               read (entry%values(v)%text, *) old
               entry%values(v)%text = changed(change, old)
               entry%setting = setting
               is_changed = .true.
            end do
         end associate
      end do
   end subroutine change_numbers

   !> The values of a setting; `message` if they do not fit the key.
   subroutine read_values(text, path, given, message)
      character(*), intent(in) :: text
      type(path_t), intent(in) :: path
      type(entry_t), intent(out) :: given
      character(:), allocatable, intent(out) :: message
      character(:), allocatable :: fault
      integer :: j, first

      message = ''
      first = path%first
      given%key = path%key
      given%first = first
      associate (key => path%row)
         if ((key%type == word .or. key%type == prose) .and. scan(text, '''"') == 0) then
            call take_bare_words()
         else
            call scan_values(trim(text), given, message)
         end if
         if (message /= '') return
         if (first < 1 .or. first + given%used - 1 > key%most) then
            message = path%key//' has '//plural(key%most, 'element', 'elements')//', found element '// &
               str(merge(first, first + given%used - 1, first > key%most .or. first < 1))
         else if (.not. path%has_subscript .and. given%used < key%least) then
            message = path%key//' needs '//plural(key%least, 'value', 'values')//', found '//str(given%used)
         end if
         do j = 1, given%used
            fault = value_fault(given%values(j), key%type)
            if (fault /= '' .and. message == '') message = path%key//' must be '//fault
         end do
      end associate

   contains

      !> Texts without quotes, as passed by a shell, split at commas.
      subroutine take_bare_words()
         integer :: begin, comma

         begin = 1
         do
            comma = 0
            if (path%row%most > 1) comma = index(text(begin:), ',')
            if (comma == 0) exit
            call add_value(given, trim(adjustl(text(begin:begin + comma - 2))), .true., .false.)
            begin = begin + comma
         end do
         call add_value(given, trim(adjustl(text(begin:))), .true., .false.)
      end subroutine take_bare_words

   end subroutine read_values

   !> 'bushing.top_mount.kt(1)' → group, name, key and subscript; 'model.length', 'axle.wheelbase' have no name.
   subroutine split_path(text, path, message)
      character(*), intent(in) :: text
      type(path_t), intent(out) :: path
      character(:), allocatable, intent(out) :: message
      integer :: dot, last, mark, status

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
      else if (is_single(path%group) .and. dot /= last) then
         message = 'expected '//trim(group_names(path%group))//'.key=value'
      else if (.not. is_single(path%group) .and. dot == last) then
         message = 'expected group.name.key=value'
      end if
      if (message /= '') return
      if (dot < last) path%name = text(dot + 1:last - 1)
      path%is_wild = index(path%name, '*') > 0
      path%key = lower(text(last + 1:))
      mark = index(path%key, '(')
      if (mark > 0) then
         path%has_subscript = .true.
         status = 1
         if (path%key(len(path%key):) == ')' .and. len(path%key) - mark < 8 .and. len(path%key) - mark > 1) then
            if (verify(path%key(mark + 1:len(path%key) - 1), '0123456789') == 0) &
               read (path%key(mark + 1:len(path%key) - 1), *, iostat=status) path%first
         end if
         if (status /= 0) then
            message = 'the subscript must be one whole number, found '//path%key(mark:)
            return
         end if
         path%key = path%key(:mark - 1)
      end if
      if (path%group == point_group .and. len(path%key) == 1 .and. index('xyz', path%key) > 0) then
         path%first = index('xyz', path%key)
         path%has_subscript = .true.
         path%key = 'at'
      end if
      call find_key(path%group, path%key, path%row, path%is_known)
   end subroutine split_path

   !> The values replace elements of the record or are added to it.
   subroutine put_values(record, given, setting)
      type(record_t), intent(inout) :: record
      type(entry_t), intent(in) :: given
      character(*), intent(in) :: setting
      type(entry_t) :: added
      integer :: at, e, k

      do k = 1, given%used
         at = given%first + k - 1
         e = entry_index(record, given%key, at)
         if (e > 0) then
            associate (entry => record%entries(e))
               entry%values(at - entry%first + 1)%text = given%values(k)%text
               entry%values(at - entry%first + 1)%is_string = given%values(k)%is_string
               entry%values(at - entry%first + 1)%is_empty = .false.
               entry%setting = setting
            end associate
         else
            added%key = given%key
            added%first = at
            added%line = record%line
            added%setting = setting
            call add_value(added, given%values(k)%text, given%values(k)%is_string, .false.)
            call add_entry(record, added)
         end if
      end do
   end subroutine put_values

end module ek_setting
