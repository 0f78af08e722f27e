!> The messages of elastokin check: errors, warnings and remarks with their locations, counted in its last line and written as JSON.
module ek_check_messages
   use ek_error, only: error_t, message_list_t
   use ek_text, only: str, plural
   use ek_version, only: version
   use ek_json, only: json_t, json_string
   use ek_letters, only: as_utf8
   use ek_group, only: key_t, group_number, group_names, find_key
   implicit none(type, external)
   private
   public :: check_messages_t, check_json, last_line

   character(*), parameter :: nl = new_line('a')

   !> The messages of each severity, in the order in which they were found.
   type :: check_messages_t
      type(message_list_t) :: errors       !! messages: deck cannot be read, model cannot be solved, preload trim failed
      type(message_list_t) :: warnings     !! messages: results may be unreliable
      type(message_list_t) :: remarks      !! messages: implausible values
   end type check_messages_t

contains

   !> The last line of check: 'OK', or '1 warning, 3 remarks, the worst: text' with the first line of the first message of the worst
   !> severity, truncated after 240 characters.
   function last_line(messages) result(text)
      type(check_messages_t), intent(in) :: messages
      character(:), allocatable :: text
      integer, parameter :: longest = 240      ! characters of the message; it stands above in full

      text = ''
      call count(messages%errors, 'error', 'errors')
      call count(messages%warnings, 'warning', 'warnings')
      call count(messages%remarks, 'remark', 'remarks')
      if (len(text) == 0) then
         text = 'OK'
         return
      end if
      text = text(3:)//', the worst: '
      if (messages%errors%count() > 0) then
         call add_first(messages%errors)
      else if (messages%warnings%count() > 0) then
         call add_first(messages%warnings)
      else
         call add_first(messages%remarks)
      end if

   contains

      !> Appends the number of messages of a list; appends nothing for an empty list.
      subroutine count(list, one, many)
         type(message_list_t), intent(in) :: list
         character(*), intent(in) :: one, many
         if (list%count() > 0) text = text//', '//plural(list%count(), one, many)
      end subroutine count

      !> Appends the first line of the first message, truncated if it is long.
      subroutine add_first(list)
         type(message_list_t), intent(in) :: list
         character(:), allocatable :: first
         first = list%line(1)
         if (index(first, nl) > 0) first = first(:index(first, nl) - 1)
         if (len(first) > longest) first = first(:index(first(:longest), ' ', back=.true.) - 1)//' …'
         text = text//first
      end subroutine add_first

   end function last_line

   !> The messages as one JSON object (schema/check.schema.json).
   function check_json(messages, file, model, checksum, status) result(text)
      type(check_messages_t), intent(in) :: messages
      character(*), intent(in) :: file, model, checksum   !! model and checksum: '' if the deck could not be read
      integer, intent(in) :: status                       !! exit status of the program
      character(:), allocatable :: text
      type(json_t) :: json

      call json%open('{')
      call json%item('program', json_string('elastokin '//version))
      call json%item('deck', json_string(as_utf8(file)))
      call json%item('model', json_string(as_utf8(model)))
      call json%item('checksum', json_string(checksum))
      call json%open('[', 'messages')
      call add(messages%errors, 'error')
      call add(messages%warnings, 'warning')
      call add(messages%remarks, 'remark')
      call json%close(']')
      call json%item('summary', json_string(as_utf8(last_line(messages))))
      call json%item('status', str(status))
      call json%close('}')
      text = json%text()

   contains

      !> Adds all messages of a list with one severity.
      subroutine add(list, severity)
         type(message_list_t), intent(in) :: list
         character(*), intent(in) :: severity
         integer :: k

         do k = 1, list%count()
            call add_message(json, list%line(k), severity)
         end do
      end subroutine add

   end function check_json

   !> Adds one message: severity, file, line, group, key, and the message without a location at its start.
   subroutine add_message(json, message, severity)
      type(json_t), intent(inout) :: json
      character(*), intent(in) :: message, severity
      character(:), allocatable :: file, text
      integer :: line, group

      call split_place(message, file, line, text)
      group = group_of(text)
      call json%open('{')
      call json%item('severity', json_string(severity))
      call json%item('file', json_string(as_utf8(file)))
      if (line > 0) call json%item('line', str(line))
      if (line == 0) call json%item('line', 'null')
      if (group > 0) call json%item('group', json_string(trim(group_names(group))))
      if (group == 0) call json%item('group', json_string(''))
      call json%item('key', json_string(key_of(text, group)))
      call json%item('text', json_string(as_utf8(text)))
      call json%close('}')
   end subroutine add_message

   !> Splits 'file:41: text' into three parts. A location in brackets is read as well, as in "mechanism: body 'arm' (file:41) turns
   !> freely", and stays in `text`. Without a location, `line` is 0 and `file` is ''.
   pure subroutine split_place(message, file, line, text)
      character(*), intent(in) :: message
      character(:), allocatable, intent(out) :: file, text
      integer, intent(out) :: line
      integer :: at, first, next, status

      file = ''
      line = 0
      text = message
      first = 1
      do
         at = index(message(first:), ':')
         if (at == 0) exit
         at = first + at - 1                                ! a file name may hold colons
         if (index(message(:at), "'") > 0) at = 0           ! a name: the location stands ahead of it
         if (at == 0) exit
         next = at + verify(message(at + 1:)//' ', '0123456789')
         if (next > at + 1 .and. next <= len(message)) then
            if (message(next:next) == ':') exit
         end if
         first = at + 1
      end do
      if (at > 0) then
         read (message(at + 1:next - 1), *, iostat=status) line
         file = message(:at - 1)
         text = message(min(next + 2, len(message) + 1):)
         return
      end if
      next = 0
      do                                                   ! "mechanism: body 'arm' (file:41) turns freely"
         if (index(message(next + 1:), ' (') == 0) return
         first = next + index(message(next + 1:), ' (') + 2
         next = first + index(message(first:), ')') - 1
         if (next < first) return
         at = index(message(:next - 1), ':', back=.true.)
         if (at <= first .or. at == next - 1) cycle
         if (verify(message(at + 1:next - 1), '0123456789') == 0) exit
      end do
      read (message(at + 1:next - 1), *, iostat=status) line
      file = message(first:at - 1)
   end subroutine split_place

   !> Index of the group named at the start of a message, after 'mechanism: ' or 'redundant: ' if present: "spring 'coil': …" or
   !> "&model: …". 0 if no group is named at this position.
   pure integer function group_of(text) result(group)
      character(*), intent(in) :: text
      character(*), parameter :: free = 'mechanism: ', doubled = 'redundant: '
      integer :: first, last

      first = 1
      if (index(text, free) == 1) first = len(free) + 1
      if (index(text, doubled) == 1) first = len(doubled) + 1
      if (text(first:min(first, len(text))) == '&') first = first + 1
      last = first - 1 + scan(text(first:)//' ', " :'")
      group = group_number(text(first:last - 1))
      if (group > 0 .and. index(text, '&') /= 1 .and. index(text(min(last, len(text)):), " '") /= 1) group = 0
   end function group_of

   !> The key with which a finding begins after its first colon: rate in "spring 'coil': rate has 1 element". A key in quotation
   !> marks is accepted, and a blank in place of an underscore: 'tyre rate' for tyre_rate. '' if the finding does not begin with
   !> a key of the group.
   function key_of(text, group) result(name)
      character(*), intent(in) :: text
      integer, intent(in) :: group
      character(:), allocatable :: name
      character(32) :: words(4)
      type(key_t) :: key
      integer :: k, first, last
      logical :: is_known

      name = ''
      first = index(text, ': ') + 2
      if (group == 0 .or. first == 2) return
      words = ''
      do k = 1, size(words)
         if (first > len(text)) exit
         last = first + scan(text(first:)//' ', ' ,:;') - 2
         words(k) = text(first:last)
         first = last + 2
      end do
      words(1) = unquoted(words(1))
      if (words(1) == group_names(group)) words(:3) = words(2:)             ! 'spring rate', 'bushing rate kt'
      call look_up(trim(words(1))//'_'//trim(words(2)))
      call look_up(trim(words(1)))
      if (words(1) == 'rate') call look_up(trim(words(2)))

   contains

      !> Accepts a candidate as the key if the group has this key and no key was found before.
      subroutine look_up(candidate)
         character(*), intent(in) :: candidate
         if (len(name) > 0) return
         call find_key(group, candidate, key, is_known)
         if (is_known) name = candidate
      end subroutine look_up

   end function key_of

   !> A name without its quotation marks.
   pure function unquoted(word) result(inner)
      character(*), intent(in) :: word
      character(len(word)) :: inner
      inner = word
      if (word(1:1) == "'") inner = word(2:len_trim(word) - 1)
   end function unquoted

end module ek_check_messages
