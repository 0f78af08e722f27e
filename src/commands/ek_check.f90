!> elastokin check: lists the contents of a deck and examines whether its model can be solved.
!>
!> The errors, warnings and remarks have their locations. The last line counts them; --json writes them as JSON.
module ek_check
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_model
   use ek_text, only: str, quoted, plural
   use ek_buffer, only: buffer_t
   use ek_outbox, only: keep_first
   use ek_console, only: print_text
   use ek_deck, only: deck_t
   use ek_deck_writer, only: write_deck_as_used
   use ek_element, only: element_kinds
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, default_tolerance
   use ek_rig, only: lacks_springs
   use ek_examination, only: add_distinct
   use ek_state, only: design_state
   use ek_kkt, only: kkt_t, new_kkt
   use ek_workspace, only: workspace_t, balance_or_explain
   use ek_lone_case, only: examine_on_rig
   use ek_reader, only: definition_t
   use ek_standard_tests, only: standard_tests
   use ek_diagnosis, only: diagnosis_t, diagnose
   use ek_model_remark, only: model_remarks_t, find_model_remarks
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: deck_settings_t, read_deck_settings, load_deck, chosen_cases
   use ek_json, only: json_t, json_string
   use ek_letters, only: as_utf8
   use ek_group, only: key_t, group_number, group_names, find_key
   implicit none(type, external)
   private
   public :: check

   character(*), parameter :: nl = new_line('a')

   !> The messages of each severity, in the order in which they were found.
   type :: check_messages_t
      type(message_list_t) :: errors       !! messages: deck cannot be read, model cannot be solved, preload trim failed
      type(message_list_t) :: warnings     !! messages: results may be unreliable
      type(message_list_t) :: remarks      !! messages: implausible values
   end type check_messages_t

contains

   !> Prints the findings to standard output. The last line is OK, or the counts of errors, warnings and remarks with the first of
   !> the most severe messages. After an error before the examination, as in a deck that cannot be read, nothing is printed here.
   !> With --json, all messages are always printed, as one object. `error` has the code exit_model if the model cannot be solved.
   subroutine check(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: unprinted
      type(deck_settings_t) :: settings
      type(buffer_t) :: findings
      type(check_messages_t) :: messages
      character(:), allocatable :: model, checksum

      call read_deck_settings(line, settings)
      call examine(settings, line%value('--write-deck'), findings, messages, model, checksum, error)
      if (line%has('--json')) then
         call print_text(check_json(messages, settings%file, model, checksum, status_of(error)), unprinted)
      else
         if (findings%length() > 0) then
            if (settings%is_quiet) call keep_messages(messages, findings)
            call findings%line(last_line(messages))
         end if
         call print_text(findings%text(), unprinted)
      end if
      call keep_first(error, unprinted)
   end subroutine check

   !> Replaces the findings by the warnings and remarks among them, for --quiet.
   subroutine keep_messages(messages, findings)
      type(check_messages_t), intent(in) :: messages
      type(buffer_t), intent(out) :: findings
      integer :: k

      do k = 1, messages%warnings%count()
         call add(findings, 'warning', messages%warnings%line(k))
      end do
      do k = 1, messages%remarks%count()
         call add(findings, 'remark', messages%remarks%line(k))
      end do
   end subroutine keep_messages

   !> The exit status of an error; 0 without an error.
   pure integer function status_of(error)
      type(error_t), allocatable, intent(in) :: error
      status_of = 0
      if (allocated(error)) status_of = error%code
   end function status_of

   !> Reads the deck, writes it to deck_path if given, examines its model, and collects findings and messages. After an error before
   !> the examination, as in a deck that cannot be read, only the error messages are collected.
   subroutine examine(settings, deck_path, findings, messages, model, checksum, error)
      type(deck_settings_t), intent(in) :: settings
      character(*), intent(in) :: deck_path                !! path for the deck as it was used; '': the deck is not written
      type(buffer_t), intent(inout) :: findings
      type(check_messages_t), intent(inout) :: messages
      character(:), allocatable, intent(out) :: model, checksum      !! '' if the deck cannot be read
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: deck
      class(workspace_t), allocatable :: workspace
      type(definition_t), target :: definition
      type(case_t), allocatable :: chosen(:)
      type(case_t) :: on_rig
      type(diagnosis_t) :: diagnosis
      type(error_t), allocatable :: trouble
      type(kkt_t) :: kkt
      type(message_list_t) :: found
      integer :: k

      model = ''
      call load_deck(settings, definition, workspace, checksum, error, needs_tables=.true., used_deck=deck)
      if (.not. allocated(checksum)) checksum = ''
      if (.not. allocated(error) .and. deck_path /= '') call write_deck_as_used(deck, deck_path, error)
      allocate (chosen(0))
      if (.not. allocated(error)) then
         model = workspace%raw%name
         if (size(workspace%deck_cases) > 0 .or. settings%case /= '') &
            call chosen_cases(settings, workspace%raw, workspace%deck_cases, chosen, error)
      end if
      if (allocated(error)) then
         call add_lines(error%message, messages%errors)
         return
      end if
      if (workspace%raw%free_wheels > 0 .and. settings%case == '') call keep_kinematic(workspace%raw, chosen)

      kkt = new_kkt(workspace%raw)
      call diagnose(workspace%raw, design_state(workspace%raw), kkt, diagnosis)
      call add_model(workspace%raw, diagnosis, checksum, findings)
      do k = 1, size(chosen)
         call examine_on_rig(workspace%raw, chosen(k), diagnosis, on_rig)
         call add_case(on_rig, diagnosis, findings)
         if (diagnosis%is_solvable()) cycle
         ! the message on one defect may differ in the last digit between two drives
         call add_distinct(found, diagnosis%words())
      end do
      if (size(chosen) == 0) then
         if (.not. diagnosis%is_solvable()) call add_distinct(found, diagnosis%words())
      end if
      call add(findings, 'warnings', diagnosis%warnings%text())
      call add_lines(diagnosis%warnings%text(), messages%warnings)
      call add_remarks(workspace, chosen, found%count() == 0, diagnosis%warnings%count() > 0, findings, messages, trouble)
      call add_lines(found%text(), messages%errors)
      if (allocated(trouble) .and. size(chosen) > 0) call add_lines(trouble%message, messages%errors)
      if (found%count() > 0) then
         call fail(error, exit_model, settings%file//': the model cannot be solved'//new_line('a')//found%text())
         return
      end if
      if (size(chosen) > 0) call move_alloc(trouble, error)
   end subroutine examine

   !> Leaves only the cases that do not need forces, of a model in which nothing carries the wheels; without any, a travel test.
   subroutine keep_kinematic(suspension, chosen)
      type(suspension_t), intent(in) :: suspension
      type(case_t), allocatable, intent(inout) :: chosen(:)
      type(case_t), allocatable :: tests(:)
      integer :: k

      allocate (tests(0))
      do k = 1, size(chosen)
         if (.not. lacks_springs(suspension, chosen(k))) tests = [tests, chosen(k)]
      end do
      if (size(tests) > 0) then
         call move_alloc(tests, chosen)
         return
      end if
      call standard_tests(suspension, chosen(:0), tests)
      deallocate (chosen)
      allocate (chosen, source=tests(:min(1, size(tests))))
   end subroutine keep_kinematic

   !> Adds each line of a string as a message.
   subroutine add_lines(text, list)
      character(*), intent(in) :: text
      type(message_list_t), intent(inout) :: list
      integer :: first, length

      first = 1
      do while (first <= len(text))
         length = index(text(first:)//new_line('a'), new_line('a')) - 1
         if (length > 0) call list%add(text(first:first + length - 1))
         first = first + length + 1
      end do
   end subroutine add_lines

   !> Adds the warnings and remarks on the model. The preload trim (`balance`) is applied first. If the model cannot be solved or
   !> the trim fails, the model as read is examined. The preloads that the trim finds are results, not findings.
   subroutine add_remarks(workspace, chosen, is_solvable, has_warnings, findings, messages, error)
      type(workspace_t), intent(inout) :: workspace
      type(case_t), intent(in) :: chosen(:)
      logical, intent(in) :: is_solvable, has_warnings
      type(buffer_t), intent(inout) :: findings
      type(check_messages_t), intent(inout) :: messages
      type(error_t), allocatable, intent(out) :: error    !! failure of the preload trim
      type(model_remarks_t) :: remarks
      type(case_t), allocatable :: tests(:)
      real(wp) :: tolerance
      integer :: k

      associate (cases => workspace%deck_cases)
         tolerance = default_tolerance
         if (size(cases) > 0) tolerance = cases(1)%tolerance
         if (is_solvable) call balance_or_explain(tolerance, workspace, error)
         if (is_solvable .and. .not. allocated(error)) then
            call standard_tests(workspace%suspension, cases, tests)
            call find_model_remarks(workspace%suspension, workspace%raw, cases, chosen, .true., remarks, tests)
         else
            call find_model_remarks(workspace%raw, workspace%raw, cases, chosen, .false., remarks)
         end if
      end associate
      if (remarks%warnings%count() > 0) call findings%line(remarks%warnings%text())
      call add_lines(remarks%warnings%text(), messages%warnings)
      do k = 1, remarks%doubts%count()
         if (has_warnings .and. index(remarks%doubts%line(k), 'very soft') == 1) cycle       ! already among the warnings
         call add(findings, 'remark', remarks%doubts%line(k))
         call messages%remarks%add(remarks%doubts%line(k))
      end do
   end subroutine add_remarks

   !> Adds name and checksum, bodies, unknowns, constraints, matrix size, degrees of freedom with the elements that hold them,
   !> chosen axes, and unused points.
   subroutine add_model(suspension, diagnosis, checksum, findings)
      type(suspension_t), intent(in) :: suspension
      type(diagnosis_t), intent(in) :: diagnosis
      character(*), intent(in) :: checksum
      type(buffer_t), intent(inout) :: findings
      character(:), allocatable :: held, unused
      integer :: k, kind

      call add(findings, 'model', suspension%name//' (checksum '//checksum//')')
      call add(findings, 'bodies', str(size(suspension%bodies)))
      call add(findings, 'unknowns', str(diagnosis%unknowns)//' = 6 × '//str(size(suspension%bodies)))
      call add(findings, 'constraints', str(diagnosis%constraints)//' in '//plural(size(suspension%joints), 'joint', 'joints')// &
         ', rank '//str(diagnosis%rank))
      call add(findings, 'matrix', matrix_text(suspension))
      held = ''
      do kind = 1, size(element_kinds)         ! bushings and springs are listed even if there are none
         k = count(suspension%elements%kind == kind)
         if (element_kinds(kind)%one == '' .or. (kind > 2 .and. k == 0)) cycle
         if (kind == 2) held = held//' and '
         if (kind > 2) held = held//', '
         held = held//plural(k, trim(element_kinds(kind)%one), trim(element_kinds(kind)%many))
      end do
      k = count(suspension%rows%compliance > 0.0_wp)
      if (k > 0) held = held//', '//plural(k, 'driver', 'drivers')//' with a stiffness'
      call add(findings, 'degrees of freedom', str(diagnosis%freedoms)//', held by '//held)
      do k = 1, size(suspension%joints)
         if (suspension%joints(k)%chosen_axis > 0) call add(findings, 'chosen axis', axis_text(suspension, k))
      end do
      unused = ''
      do k = 1, size(suspension%points)
         if (suspension%points(k)%is_used) cycle
         unused = unused//', '//suspension%points(k)%name//' ('//suspension%points(k)%where//')'
      end do
      call add(findings, 'unused points', unused(3:))
   end subroutine add_model

   !> Order and number of entries of the KKT matrix without the rows of a rig, as a string: nonzero entries, entries with the fill
   !> of the plan of elimination, and entries of a dense matrix. Only the lower triangle is counted.
   function matrix_text(suspension) result(text)
      type(suspension_t), intent(in) :: suspension
      character(:), allocatable :: text
      type(kkt_t) :: kkt

      kkt = new_kkt(suspension, wants_plan=.true.)
      text = 'order '//str(kkt%n)//', '//plural(kkt%pattern%entries, 'nonzero', 'nonzeros')//', '// &
         str(kkt%plan(1)%length)//' with fill; dense '//str((kkt%n*(kkt%n + 1))/2)
   end function matrix_text

   !> The axis that the program has chosen for a universal joint, in the frame of the deck: "universal 'outer': axis_2_vector = 0,
   !> 1, 0".
   function axis_text(suspension, k) result(text)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k                     !! index of the joint
      character(:), allocatable :: text
      real(wp) :: axis(3)

      associate (joint => suspension%joints(k))
         axis = joint%axis(:, joint%chosen_axis)
         if (suspension%is_iso) axis(1:2) = -axis(1:2)
         axis = axis + 0.0_wp                      ! no negative zero
         text = 'universal '//quoted(joint%name)//': '//trim(merge('axis_vector  ', 'axis_2_vector', joint%chosen_axis == 1))// &
            ' = '//str(axis(1), 6)//', '//str(axis(2), 6)//', '//str(axis(3), 6)
      end associate
   end function axis_text

   !> Adds one case: its test, load or driver, its increments and method, and whether the case can be solved.
   subroutine add_case(case, diagnosis, findings)
      type(case_t), intent(in) :: case
      type(diagnosis_t), intent(in) :: diagnosis
      type(buffer_t), intent(inout) :: findings
      character(:), allocatable :: text

      text = 'drive '//quoted(case%drive)
      if (len(case%load) > 0) text = 'load '//quoted(case%load)
      if (len(case%test) > 0) text = 'test '//case%test
      text = text//', '//plural(case%increments, 'increment', 'increments')//', '//case%method
      if (case%follows_arc) text = text//' along the arc'
      if (diagnosis%is_solvable()) then
         call add(findings, 'case '//case%name, text//': can be solved, reciprocal condition number '//str(diagnosis%rcond, 2))
      else
         call add(findings, 'case '//case%name, text//': CANNOT be solved')
      end if
   end subroutine add_case

   !> Adds a line 'name: text'; adds nothing for an empty string.
   subroutine add(findings, name, text)
      type(buffer_t), intent(inout) :: findings
      character(*), intent(in) :: name, text
      if (len(text) > 0) call findings%line(name//': '//text)
   end subroutine add

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

      call json%begin_record(model, checksum, deck=file)
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

end module ek_check
