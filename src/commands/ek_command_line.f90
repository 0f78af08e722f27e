!> The command line: a command, its files and its options. Unless help or the version is requested, the options are checked against
!> the tables of ek_command, so that the command line contains only options of its command.
module ek_command_line
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: suggestion, quoted
   use ek_decimal, only: get_decimal
   use ek_gradient_definition, only: windows_t, set_window
   implicit none(type, external)
   private
   public :: command_t, option_t, option_name, program_prefix, command_line_t, read_command_line, refuse_stream, read_windows
   public :: read_threshold, argument

   !> A command, as --help describes it.
   type :: command_t
      character(11) :: name
      character(80) :: usage      !! usage after 'elastokin'; options without a line of help are appended
      character(18) :: brief      !! usage in the overview
      character(60) :: summary    !! description in the overview
      character(960) :: text      !! description in the help of the command
      character(280) :: ending    !! last paragraph of the help, after the options
      integer :: files = 1        !! code for the number of files: 1: one; 2: two or more; 0: one or more; -1: none;
      !!                              -2: none, or one of the choices in its text: 'a | b | c'
      character(15) :: alone = '' !! option that can replace the files; '' for no such option
   end type command_t

   !> An option of a command.
   type :: option_t
      character(11) :: command    !! name of the command; '' for every command
      character(20) :: label  !! '--plot', '--out DIR': name and form of the value; N: integer of at least 1; a=b: may be repeated
      character(240) :: help      !! description in the help of the command; '' if the line of usage suffices
   end type option_t

   type :: command_line_t
      character(:), allocatable :: command        !! name of the command; '' without a command
      type(message_list_t) :: files
      character(:), allocatable :: build          !! build of this program, set by the main program; not allocated: unknown
      type(message_list_t), private :: names, texts     !! names of the options in order, and their values
   contains
      procedure :: has, value => last_value, values => all_values, number => number_of
   end type command_line_t

contains

   !> Whether an option is given.
   pure logical function has(self, name)
      class(command_line_t), intent(in) :: self
      character(*), intent(in) :: name
      integer :: k

      has = .false.
      do k = 1, self%names%count()
         has = has .or. self%names%line(k) == name
      end do
   end function has

   !> The last value of an option; `default` (or '') if the option is not given.
   pure function last_value(self, name, default) result(value)
      class(command_line_t), intent(in) :: self
      character(*), intent(in) :: name
      character(*), intent(in), optional :: default
      character(:), allocatable :: value
      integer :: k

      value = ''
      if (present(default)) value = default
      do k = 1, self%names%count()
         if (self%names%line(k) == name) value = self%texts%line(k)
      end do
   end function last_value

   !> All values of an option, in order.
   pure type(message_list_t) function all_values(self, name) result(values)
      class(command_line_t), intent(in) :: self
      character(*), intent(in) :: name
      integer :: k

      do k = 1, self%names%count()
         if (self%names%line(k) == name) call values%add(self%texts%line(k))
      end do
   end function all_values

   !> The integer value of an option; 0 if the option is not given.
   pure integer function number_of(self, name) result(number)
      class(command_line_t), intent(in) :: self
      character(*), intent(in) :: name

      number = 0
      if (self%has(name)) call read_number(self%value(name), number)
   end function number_of

   !> Reads an integer of at least 1; returns 0 if the string is anything else.
   pure subroutine read_number(text, number)
      character(*), intent(in) :: text
      integer, intent(out) :: number
      integer :: status

      number = 0
      status = 1
      if (len(text) > 0 .and. verify(text, '0123456789') == 0) read (text, *, iostat=status) number
      if (status /= 0) number = 0
   end subroutine read_number

   !> The name of an option: '--out' of '--out DIR'.
   elemental character(15) function option_name(option) result(name)
      type(option_t), intent(in) :: option
      name = option%label(:index(option%label, ' ') - 1)
   end function option_name

   !> The beginning of a command line before the name of the command. A program with one command is named after its command:
   !> 'elastokin-bench DECK'.
   pure function program_prefix(commands) result(prefix)
      type(command_t), intent(in) :: commands(:)
      character(:), allocatable :: prefix

      prefix = 'elastokin '
      if (size(commands) == 1) prefix = 'elastokin-'
   end function program_prefix

   !> Reads the command line of this process. In a program with one command, the name of the command is not an argument. Without
   !> arguments, or if help or the version is requested, the files and options are not checked against the command.
   subroutine read_command_line(commands, options, line, error)
      type(command_t), intent(in) :: commands(:)
      type(option_t), intent(in) :: options(:)
      type(command_line_t), intent(out) :: line
      type(error_t), allocatable, intent(out) :: error        !! exit_usage
      character(:), allocatable :: word
      integer :: k, n

      line%command = ''
      n = 0
      if (size(commands) == 1) n = 1
      if (n == 1) line%command = trim(commands(1)%name)
      k = 0
      do while (k < command_argument_count())
         k = k + 1
         word = argument(k)
         if (len(word) > 1 .and. index(word, '-') == 1) then
            call take_option(options, word, k, line, error)
         else if (n == 0 .and. word == 'help' .and. .not. line%has('--help')) then      ! help COMMAND: as COMMAND --help
            call take_option(options, '--help', k, line, error)
         else if (n == 0) then
            line%command = word
            n = findloc(commands%name == word, .true., dim=1)
            if (word == 'bench') then
               call fail(error, exit_usage, 'bench is a program of its own: elastokin-bench, built with the sources'// &
                  ' (docs/performance.md)')
            else if (n == 0) then
               call fail(error, exit_usage, 'unknown command '//quoted(word)//suggestion(word, commands%name)// &
                  '; expected '//names_of(commands))
            end if
         else if (commands(n)%files == -1) then
            call fail(error, exit_usage, line%command//' does not accept a file, found '//quoted(word))
         else if (line%files%count() > 0 .and. any(commands(n)%files == [1, -2])) then
            call fail(error, exit_usage, 'expected one '//merge('file', 'kind', commands(n)%files == 1)//', found '// &
               quoted(line%files%line(1))//' and '//quoted(word))
         else
            call line%files%add(word)
         end if
         if (allocated(error)) return
      end do
      if (k == 0 .or. line%has('--help') .or. line%has('--version') .or. line%has('--help-files')) return
      if (n == 0) then
         call fail(error, exit_usage, 'no command: expected '//names_of(commands))
      else if (line%files%count() < least_files(commands(n)) .and. .not. line%has(trim(commands(n)%alone))) then
         call fail(error, exit_usage, line%command//' needs '//trim(merge('a file              ', 'at least two results', &
            commands(n)%files < 2))//': '//program_prefix(commands)//trim(commands(n)%brief))
      end if
      do k = 1, line%names%count()
         word = line%names%line(k)
         if (allocated(error)) return
         if (.not. any((options%command == line%command .or. options%command == '') .and. option_name(options) == word)) &
            call fail(error, exit_usage, line%command//' does not accept '//word)
      end do
   end subroutine read_command_line

   !> The least number of files of a command.
   pure integer function least_files(command)
      type(command_t), intent(in) :: command

      least_files = max(command%files, 1)
      if (command%files < 0) least_files = 0
   end function least_files

   !> Reads an option with its value: --out DIR or --out=DIR.
   subroutine take_option(options, word, k, line, error)
      type(option_t), intent(in) :: options(:)
      character(*), intent(in) :: word
      integer, intent(inout) :: k                           !! index of the option, then of its value
      type(command_line_t), intent(inout) :: line
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: name, value, expected
      integer :: equals, n, number

      name = word
      equals = 0
      if (index(word, '--') == 1 .and. index(word, '=') > 3) equals = index(word, '=')
      if (equals > 0) name = word(:equals - 1)
      if (name == '-q') name = '--quiet'
      if (name == '-h') name = '--help'
      n = findloc(option_name(options) == name .and. options%command == line%command, .true., dim=1)
      if (n == 0) n = findloc(option_name(options) == name, .true., dim=1)      ! a slip, or before the command
      if (n == 0) then
         call fail(error, exit_usage, 'unknown option '//quoted(name)//suggestion(name, option_name(options)))
         return
      end if
      expected = trim(options(n)%label(len(name) + 2:))
      value = ''
      if (equals > 0) then
         value = word(equals + 1:)
         if (expected == '') call fail(error, exit_usage, name//' does not accept a value, found '//quoted(value))
      else if (expected /= '' .and. k == command_argument_count()) then
         call fail(error, exit_usage, name//' needs a value after it')
      else if (expected /= '') then
         k = k + 1
         value = argument(k)
      end if
      if (allocated(error)) return
      call read_number(value, number)
      if (expected /= '' .and. len_trim(value) == 0) then      ! for instance an unset variable of the shell
         call fail(error, exit_usage, name//' needs a value, found an empty one')
      else if (expected == 'N' .and. number < 1) then
         call fail(error, exit_usage, name//': expected an integer of at least 1, found '//quoted(value))
      end if
      call line%names%add(name)
      call line%texts%add(value)
   end subroutine take_option

   !> Rejects --out - for a command that writes several files.
   subroutine refuse_stream(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error

      if (line%value('--out') == '-') call fail(error, exit_usage, line%command// &
         ' writes several files: it needs an output folder and cannot be used with --out -')
   end subroutine refuse_stream

   !> Reads the half widths of gradient windows: --window travel=15.
   subroutine read_windows(line, windows, error)
      type(command_line_t), intent(in) :: line
      type(windows_t), intent(inout) :: windows
      type(error_t), allocatable, intent(out) :: error     !! unknown window, or no positive number
      type(message_list_t) :: texts
      character(:), allocatable :: text
      real(wp) :: half
      integer :: k, equals
      logical :: is_number, is_known

      texts = line%values('--window')
      do k = 1, texts%count()
         text = texts%line(k)
         equals = index(text, '=')
         call get_decimal(text(equals + 1:), half, is_number)
         if (.not. is_number) half = 0.0_wp      ! it may be no number, which a build with traps does not compare
         if (equals < 2 .or. verify(text(equals + 1:), '0123456789.') > 0 .or. .not. half > 0.0_wp) then
            call fail(error, exit_usage, '--window: expected window=half width with a positive number, as in travel=15, '// &
               'found '//quoted(text))
            return
         end if
         call set_window(windows, text(:equals - 1), half, is_known)
         if (.not. is_known) call fail(error, exit_usage, &
            '--window: expected travel, roll, force, torque, rack or wheel, found '//quoted(text(:equals - 1)))
         if (allocated(error)) return
      end do
   end subroutine read_windows

   !> Reads --threshold, a change in percent with or without '%', as a share. Without the option, `threshold` is unchanged.
   subroutine read_threshold(line, threshold, error)
      type(command_line_t), intent(in) :: line
      real(wp), intent(inout) :: threshold
      type(error_t), allocatable, intent(out) :: error     !! no number, or a negative one
      character(:), allocatable :: text
      real(wp) :: value
      integer :: last
      logical :: is_number

      if (.not. line%has('--threshold')) return
      text = trim(line%value('--threshold'))
      last = len(text)
      if (last > 1) then
         if (text(last:) == '%') last = len_trim(text(:last - 1))
      end if
      is_number = verify(text(:last), '0123456789.eE+-') == 0
      if (is_number) call get_decimal(text(:last), value, is_number)
      if (.not. is_number) value = -1.0_wp
      if (value >= 0.0_wp) then
         threshold = value/100
      else
         call fail(error, exit_usage, '--threshold: expected a change in percent, as in 1% or 0.2%, found '//quoted(text))
      end if
   end subroutine read_threshold

   !> The names of all commands as a phrase: 'run, check, … or fit'.
   pure function names_of(commands) result(text)
      type(command_t), intent(in) :: commands(:)
      character(:), allocatable :: text
      integer :: k

      text = trim(commands(1)%name)
      do k = 2, size(commands)
         text = text//trim(merge(' or', ',  ', k == size(commands)))//' '//trim(commands(k)%name)
      end do
   end function names_of

   !> Argument k of the command line in full length.
   function argument(k) result(text)
      integer, intent(in) :: k
      character(:), allocatable :: text
      integer :: length

      call get_command_argument(k, length=length)
      allocate (character(length) :: text)
      if (length > 0) call get_command_argument(k, value=text)
   end function argument

end module ek_command_line
