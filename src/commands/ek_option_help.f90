!> Help from the tables of commands and options: the help of a command, and the entry of one option (name, value and description)
!> for man pages and completion. The description of an option may be in the row of another command.
module ek_option_help
   use ek_command_line, only: command_t, option_t, option_name, program_prefix
   implicit none(type, external)
   private
   public :: command_help, belongs, is_repeatable, value_name, description, first_line, choices, on_one_line

   character(*), parameter :: nl = new_line('a'), bar = ' | '

contains

   !> The help of command n. Neighbouring options with the same description share a line.
   pure function command_help(commands, options, n) result(text)
      type(command_t), intent(in) :: commands(:)
      type(option_t), intent(in) :: options(:)
      integer, intent(in) :: n
      character(:), allocatable :: text, lines, label, shared
      logical :: is_shared
      integer :: k

      text = program_prefix(commands)//trim(commands(n)%usage)
      lines = ''
      shared = ''
      do k = 1, size(options)
         if (.not. belongs(options(k), trim(commands(n)%name))) cycle
         label = trim(options(k)%label)
         is_shared = .false.
         if (k < size(options)) is_shared = options(k + 1)%command == options(k)%command .and. &
            options(k + 1)%help == options(k)%help
         if (options(k)%help == '') then
            text = text//' ['//label//']'
            if (index(label, '=') > 0) text = text//'…'
         else if (is_shared) then
            shared = shared//label//', '
         else
            shared = shared//label
            lines = lines//nl//'  '//shared//repeat(' ', merge(19 - len(shared), 3, len(shared) < 19))//trim(options(k)%help)
            shared = ''
         end if
      end do
      text = text//nl//nl//trim(commands(n)%text)
      if (len(lines) > 0) text = text//nl//lines
      if (len_trim(commands(n)%ending) > 0) text = text//nl//nl//trim(commands(n)%ending)
   end function command_help

   !> Whether an option belongs to a command. An option that every command accepts belongs to each command and to the command '';
   !> without a help string, such an option belongs to no command.
   pure logical function belongs(option, command)
      type(option_t), intent(in) :: option
      character(*), intent(in) :: command

      belongs = option%command == command .or. option%command == ''
      if (option%command == '' .and. option%help == '') belongs = .false.
   end function belongs

   !> Whether an option may be given more than once: --set path=value.
   pure logical function is_repeatable(option)
      type(option_t), intent(in) :: option
      is_repeatable = index(option%label, '=') > 0 .or. index(option%help, 'may be repeated') > 0
   end function is_repeatable

   !> Name of the value of an option: 'DIR' for '--out DIR'; '' for an option without a value.
   pure function value_name(option) result(name)
      type(option_t), intent(in) :: option
      character(:), allocatable :: name
      name = trim(adjustl(option%label(len_trim(option_name(option)) + 1:)))
   end function value_name

   !> The description of option k. If its help refers to another command ('as for run'), the description for that command is
   !> returned. If its help is empty, the first description of an option with the same name is returned. Lines are not indented.
   pure recursive function description(options, k) result(text)
      type(option_t), intent(in) :: options(:)
      integer, intent(in) :: k
      character(:), allocatable :: text
      character(*), parameter :: reference = 'as for '
      integer :: j, other

      text = ''
      other = 0
      if (options(k)%help == '') then
         do j = size(options), 1, -1
            if (option_name(options(j)) == option_name(options(k)) .and. options(j)%help /= '') other = j
         end do
      else if (index(options(k)%help, reference) == 1 .and. index(options(k)%help, ',') == 0) then
         do j = 1, size(options)
            if (option_name(options(j)) == option_name(options(k)) .and. options(j)%command == &
               options(k)%help(len(reference) + 1:)) other = j
         end do
      end if
      if (other > 0 .and. other /= k) then
         text = description(options, other)
      else
         text = without_indent(trim(options(k)%help))
      end if
   end function description

   !> The first line of a string, without a colon at its end.
   pure function first_line(text) result(line)
      character(*), intent(in) :: text
      character(:), allocatable :: line
      integer :: length

      length = index(text//nl, nl) - 1
      if (length > 0) then
         if (text(length:length) == ':') length = length - 1
      end if
      line = text(:length)
   end function first_line

   !> The choices in a description, separated by blanks: 'recursive corrected equilibrium' for 'recursive | corrected |
   !> equilibrium'; '' without such a list.
   pure function choices(text) result(list)
      character(*), intent(in) :: text
      character(:), allocatable :: list, rest
      integer :: last

      list = ''
      rest = on_one_line(text)
      last = index(rest, bar)
      if (last == 0) return
      list = rest(index(rest(:last - 1), ' ', back=.true.) + 1:last - 1)
      do while (last > 0)
         rest = rest(last + len(bar):)
         list = list//' '//rest(:scan(rest//' ', ' ;,.') - 1)
         last = index(rest, bar)
         if (last > scan(rest//' ', ' ;,.')) last = 0
      end do
   end function choices

   !> A string on one line: each sequence of blanks and line ends becomes one blank.
   pure function on_one_line(text) result(line)
      character(*), intent(in) :: text
      character(:), allocatable :: line
      integer :: k

      line = ''
      do k = 1, len(text)
         if (text(k:k) /= nl .and. text(k:k) /= ' ') then
            line = line//text(k:k)
         else if (len(line) > 0) then
            if (line(len(line):) /= ' ') line = line//' '
         end if
      end do
      line = trim(line)
   end function on_one_line

   !> A string whose lines begin without blanks.
   pure function without_indent(text) result(plain)
      character(*), intent(in) :: text
      character(:), allocatable :: plain
      integer :: first, last

      plain = ''
      first = 1
      do while (first <= len(text))
         last = first + index(text(first:)//nl, nl) - 2
         if (first > 1) plain = plain//nl
         plain = plain//trim(adjustl(text(first:last)))
         first = last + 2
      end do
   end function without_indent

end module ek_option_help
