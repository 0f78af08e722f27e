!> Settings from the command line or a study: `group.name.key=value` changes one record.
module ek_setting
   use ek_text, only: str, lower, quoted, plural
   use ek_error, only: error_t, fail, exit_usage
   use ek_record, only: record_t, entry_t, add_entry, add_value, entry_index, element
   use ek_scanner, only: scan_values
   use ek_group, only: group_names, group_number, is_deck_group, names_of_groups, is_single, include_group, point_group, &
      key_t, find_key, did_you_mean, unknown_key, word, prose, word_length
   use ek_namelist, only: value_fault
   implicit none(type, external)
   private
   public :: apply_setting, split_setting

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

   !> Changes the record given by the path; `message` describes a mistake, '' if there is none.
   subroutine apply_setting(records, used, path, text, message, is_found)
      type(record_t), intent(inout) :: records(:)
      integer, intent(in) :: used
      character(*), intent(in) :: path, text
      character(:), allocatable, intent(out) :: message
      logical, intent(out) :: is_found     !! the record exists, even if there is another mistake
      character(:), allocatable :: setting, name, key_name
      type(entry_t) :: given
      type(key_t) :: key
      logical :: is_known, has_subscript
      integer :: group, first, target, k

      is_found = .false.
      message = ''
      setting = trim(adjustl(path))//'='//trim(adjustl(text))
      call split_path(trim(adjustl(path)), group, name, key_name, first, has_subscript, message)
      if (message == '') call find_record()
      is_found = message == ''
      if (message == '') call read_values()
      if (message == '') then
         do k = 1, given%used
            call put_element(records(target), given, k, setting)
         end do
      else
         message = '--set '//setting//': '//message
      end if

   contains

      subroutine find_record()
         character(word_length), allocatable :: names(:)
         integer :: j, found

         target = 0
         found = 0
         do j = 1, used
            if (records(j)%group /= group_names(group)) cycle
            found = found + 1
            if (is_single(group)) then
               target = j
            else if (element(records(j), 'name', 1) == name) then
               target = j
            end if
            if (target > 0) return
         end do
         allocate (names(found))
         found = 0
         do j = 1, used
            if (records(j)%group /= group_names(group)) cycle
            found = found + 1
            names(found) = element(records(j), 'name', 1)
         end do
         if (is_single(group)) then
            message = 'the deck has no &'//trim(group_names(group))
         else
            message = 'there is no '//trim(group_names(group))//' '//quoted(name)//did_you_mean(name, names)
         end if
      end subroutine find_record

      subroutine read_values()
         character(:), allocatable :: fault
         integer :: j

         if (group == point_group .and. len(key_name) == 1 .and. index('xyz', key_name) > 0) then
            first = index('xyz', key_name)
            has_subscript = .true.
            key_name = 'at'
         end if
         call find_key(group, key_name, key, is_known)
         if (.not. is_known) then
            message = unknown_key(group, key_name)
            return
         end if
         given%key = key_name
         given%first = first
         if ((key%type == word .or. key%type == prose) .and. scan(text, '''"') == 0) then
            call take_bare_words()
         else
            call scan_values(trim(text), given, message)
         end if
         if (message /= '') return
         if (first < 1 .or. first + given%used - 1 > key%most) then
            message = key_name//' has '//plural(key%most, 'element', 'elements')//', found element '// &
               str(merge(first, first + given%used - 1, first > key%most .or. first < 1))
         else if (.not. has_subscript .and. given%used < key%least) then
            message = key_name//' needs '//plural(key%least, 'value', 'values')//', found '//str(given%used)
         end if
         do j = 1, given%used
            fault = value_fault(given%values(j), key%type)
            if (fault /= '' .and. message == '') message = key_name//' must be '//fault
         end do
      end subroutine read_values

      !> Texts without quotes, as passed by a shell, split at commas.
      subroutine take_bare_words()
         integer :: begin, comma

         begin = 1
         do
            comma = 0
            if (key%most > 1) comma = index(text(begin:), ',')
            if (comma == 0) exit
            call add_value(given, trim(adjustl(text(begin:begin + comma - 2))), .true., .false.)
            begin = begin + comma
         end do
         call add_value(given, trim(adjustl(text(begin:))), .true., .false.)
      end subroutine take_bare_words

   end subroutine apply_setting

   !> 'bushing.top_mount.kt(1)' → group, name, key and subscript; 'model.length', 'axle.wheelbase' have no name.
   subroutine split_path(path, group, name, key, first, has_subscript, message)
      character(*), intent(in) :: path
      integer, intent(out) :: group, first
      character(:), allocatable, intent(out) :: name, key
      logical, intent(out) :: has_subscript
      character(:), allocatable, intent(inout) :: message
      integer :: dot, last, mark, status

      name = ''
      key = ''
      first = 1
      group = 0
      has_subscript = .false.
      dot = index(path, '.')
      last = index(path, '.', back=.true.)
      if (dot <= 1) then
         message = 'expected group.name.key=value'
         return
      end if
      group = group_number(lower(path(:dot - 1)))
      if (.not. is_deck_group(group)) then
         message = 'there is no group '//quoted(path(:dot - 1))//did_you_mean(path(:dot - 1), names_of_groups(of_deck=.true.))
         return
      end if
      if (group == include_group) then
         message = '--set cannot change an &include'
         return
      end if
      if (is_single(group) .neqv. dot == last) then
         message = 'expected group.name.key=value'
         if (is_single(group)) message = 'expected '//trim(group_names(group))//'.key=value'
         return
      end if
      if (message /= '') return
      if (dot < last) name = path(dot + 1:last - 1)
      key = lower(path(last + 1:))
      mark = index(key, '(')
      if (mark > 0) then
         has_subscript = .true.
         status = 1
         if (key(len(key):) == ')' .and. len(key) - mark < 8 .and. len(key) - mark > 1) then
            if (verify(key(mark + 1:len(key) - 1), '0123456789') == 0) &
               read (key(mark + 1:len(key) - 1), *, iostat=status) first
         end if
         if (status /= 0) then
            message = 'the subscript must be one whole number, found '//key(mark:)
            return
         end if
         key = key(:mark - 1)
      end if
   end subroutine split_path

   !> Value k of `given` replaces the element of the record or is added to it.
   subroutine put_element(record, given, k, setting)
      type(record_t), intent(inout) :: record
      type(entry_t), intent(in) :: given
      integer, intent(in) :: k
      character(*), intent(in) :: setting
      type(entry_t) :: added
      integer :: at, e

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
   end subroutine put_element

end module ek_setting
