!> Settings from the command line or a study: `group.name.key=value` changes numbers and strings of a deck.
!>
!> | path                | meaning                                                  |
!> |---------------------|----------------------------------------------------------|
!> | point.upper.z       | one number; also point.upper.at(3)                       |
!> | bushing.*.kt(1)     | number of every bushing that gives it; * stands for any characters |
!> | axle.wheelbase      | number of a group without names                          |
!>
!> | value  | meaning                                                    |
!> |--------|------------------------------------------------------------|
!> | 105.5  | replaces the value                                         |
!> | *1.1   | multiplies a number                                        |
!> | +2     | adds to a number, in the unit of the deck; +-2 subtracts   |
module ek_setting
   use ek_kinds, only: wp
   use ek_text, only: str, quoted, plural, did_you_mean
   use ek_error, only: error_t, fail, exit_usage
   use ek_record, only: record_t, entry_t, value_t, add_entry, add_value, entry_index, element
   use ek_scanner, only: scan_values
   use ek_group, only: group_names, is_single, unknown_key, longest, number, word_length, key_t
   use ek_namelist, only: value_fault, surplus
   use ek_parameter, only: path_t, split_path, is_meant, is_addressed, change_t, changed
   implicit none(type, external)
   private
   public :: apply_setting, split_setting, change_t, read_change

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

   !> Applies a setting to the records to which a path leads. `message` describes an error; '' if there is no error.
   subroutine apply_setting(records, used, path_text, text, message, is_found)
      type(record_t), intent(inout) :: records(:)
      integer, intent(in) :: used
      character(*), intent(in) :: path_text, text
      character(:), allocatable, intent(out) :: message
      logical, intent(out) :: is_found     !! a record exists, even if there is another error
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
      if (message == '' .and. .not. path%is_known) message = unknown_key(path%group, path%key)
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
               if (path%row%has_zeros) call put_zeros(records(j), path%row, setting)
               is_changed = .true.
            end if
            if (.not. path%is_wild) exit
         end do
         if (.not. is_changed) message = path%key//' is not given in the deck'
         if (.not. is_changed .and. change%is_relative) message = message//', so it cannot be changed by '//trim(text)
      end if
      if (message /= '') message = '--set '//setting//': '//message
   end subroutine apply_setting

   !> Finds whether a path leads to a record. `message` is '' if it does; otherwise it describes the error.
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
      message = 'the deck has no &'//trim(group_names(path%group))
      if (.not. is_single(path%group)) &
         message = 'there is no '//trim(group_names(path%group))//' '//quoted(path%name)//did_you_mean(path%name, names)
   end subroutine check_target

   !> Reads a relative value, '*1.1' or '+2'. Any other string is not relative.
   subroutine read_change(text, change)
      character(*), intent(in) :: text
      type(change_t), intent(out) :: change
      type(entry_t) :: entry
      character(:), allocatable :: message
      real(wp) :: value

      if (len_trim(text) < 2 .or. scan(text, '*+') /= 1) return
      call scan_values(trim(text(2:)), entry, message)
      if (message /= '' .or. entry%used /= 1) return
      if (value_fault(entry%values(1), number) /= '') return
      read (entry%values(1)%text, *) value
      change%is_relative = .true.
      change%factor = merge(value, 1.0_wp, text(:1) == '*')
      change%term = merge(0.0_wp, value, text(:1) == '*')
   end subroutine read_change

   !> Changes the numbers of a record to which the path leads, if the record gives them. `is_changed` becomes .true. if a number was
   !> changed.
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
               if (.not. is_addressed(path, entry%first + v - 1)) cycle
               if (value_fault(entry%values(v), number) /= '') cycle      ! reported by check_record
               read (entry%values(v)%text, *) old
               entry%values(v)%text = changed(change, old)
               entry%setting = setting
               is_changed = .true.
            end do
         end associate
      end do
   end subroutine change_numbers

   !> Reads the values of a setting. `message` describes values that do not fit the key.
   subroutine read_values(text, path, given, message)
      character(*), intent(in) :: text
      type(path_t), intent(in) :: path
      type(entry_t), intent(out) :: given
      character(:), allocatable, intent(out) :: message
      type(value_t) :: factor
      character(:), allocatable :: fault
      integer :: j, last

      message = ''
      given%key = path%key
      given%first = path%first
      associate (key => path%row)
         if (longest(key%type) > 0 .and. scan(text, '''"') == 0) then
            call take_bare_words()
         else
            call scan_values(trim(text), given, message)
         end if
         if (message /= '') return
         last = max(path%first + given%used - 1, path%last)
         if (path%first < 1 .or. last > key%most) then
            if (path%first < 1 .or. path%first > key%most) last = path%first
            if (path%last > key%most) last = path%last
            message = path%key//' has '//plural(key%most, 'element', 'elements')//', found element '//str(last)// &
               surplus(key, given)
         else if (path%last > path%first .and. given%used /= path%last - path%first + 1) then
            message = path%key//'('//str(path%first)//':'//str(path%last)//') needs '//str(path%last - path%first + 1)// &
               ' values, found '//str(given%used)
         else if (.not. path%has_subscript .and. given%used < key%least) then
            message = path%key//' needs '//plural(key%least, 'value', 'values')//', found '//str(given%used)
         end if
         do j = 1, given%used
            if (message /= '') return
            fault = value_fault(given%values(j), key%type)
            if (fault == '') cycle
            message = path%key//' must be '//fault
            if (key%type /= number .or. given%values(j)%text(:1) /= '*' .or. len(given%values(j)%text) < 2) cycle
            factor = given%values(j)
            factor%text = factor%text(2:)
            if (value_fault(factor, number) /= '') message = path%key//': * must be followed by '//value_fault(factor, number)
         end do
      end associate

   contains

      !> Reads strings without quotes, as passed by a shell, separated by commas.
      subroutine take_bare_words()
         integer :: begin, comma

         begin = 1
         do
            comma = index(text(begin:), ',')
            if (comma == 0 .or. path%row%most == 1) exit
            call add_value(given, trim(adjustl(text(begin:begin + comma - 2))), .true.)
            begin = begin + comma
         end do
         call add_value(given, trim(adjustl(text(begin:))), .true.)
      end subroutine take_bare_words

   end subroutine read_values

   !> Replaces the elements of a key of the record by the values of a setting. Elements that the record does not give are added.
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
            record%entries(e)%values(at - record%entries(e)%first + 1) = given%values(k)
            record%entries(e)%setting = setting
         else
            added = given
            added%used = 0
            added%first = at
            added%line = record%line
            added%setting = setting
            call add_value(added, given%values(k)%text, given%values(k)%is_string)
            call add_entry(record, added)
         end if
      end do
   end subroutine put_values

   !> Sets the elements of a vector that a record does not give to 0, their default, because a deck gives all elements or none.
   subroutine put_zeros(record, row, setting)
      type(record_t), intent(inout) :: record
      type(key_t), intent(in) :: row
      character(*), intent(in) :: setting
      type(entry_t) :: zero
      integer :: at

      do at = 1, row%least
         if (entry_index(record, trim(row%name), at) > 0) cycle
         zero%key = trim(row%name)
         zero%first = at
         zero%used = 0
         call add_value(zero, '0', .false.)
         call put_values(record, zero, setting)
      end do
   end subroutine put_zeros

end module ek_setting
