!> Reads the command line by the tables of ek_command. Every error message states the expected form.
module ek_command_line
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_usage
   use ek_text, only: nearest_name, quoted
   use ek_decimal, only: get_decimal
   use ek_gradient_definition, only: windows_t, set_window
   use ek_arguments, only: arguments_t, setting_t
   use ek_command, only: commands, options, uses, option_number, command_names
   implicit none(type, external)
   private
   public :: read_arguments

   integer, parameter :: of_none = -1, of_name = 0     !! what a word is, if not the number of an option

contains

   !> Reads the command line of this process.
   subroutine read_arguments(arguments, error)
      type(arguments_t), intent(out) :: arguments
      type(error_t), allocatable, intent(out) :: error        !! exit_usage
      type(setting_t), allocatable :: texts(:), windows(:)    ! texts: names and values of options
      integer :: kinds(command_argument_count()), k           ! of_none, of_name or the number of the option

      allocate (texts(size(kinds)))
      arguments%command = ''
      arguments%file = ''
      kinds = of_none
      k = 0
      do while (k < size(texts))
         k = k + 1
         texts(k)%text = argument(k)
         if (len(texts(k)%text) > 1 .and. index(texts(k)%text, '-') == 1) then
            call take_option(k, texts, kinds, arguments%increments, error)
         else if (len(arguments%command) == 0) then
            arguments%command = texts(k)%text
            if (.not. any(commands%name == arguments%command)) call fail(error, exit_usage, 'unknown command '// &
               quoted(arguments%command)//suggestion(arguments%command, commands%name)//'; expected '//command_names())
         else if (len(arguments%file) > 0 .and. arguments%command /= 'compare') then
            call fail(error, exit_usage, 'expected one file, found '//quoted(arguments%file)//' and '//quoted(texts(k)%text))
         else
            if (len(arguments%file) == 0) arguments%file = texts(k)%text
            kinds(k) = of_name
         end if
         if (allocated(error)) return
      end do
      arguments%help = has('--help') .or. size(texts) == 0
      arguments%version = has('--version')
      arguments%plot = has('--plot')
      arguments%compliance = has('--compliance')
      arguments%json = has('--json')
      arguments%no_plots = has('--no-plots')
      arguments%animate = has('--animate')
      arguments%quiet = has('--quiet')
      arguments%out = last_of('--out')
      arguments%method = last_of('--method')
      arguments%case = last_of('--case')
      call collect(of_name, arguments%files)
      call collect(option_number('--set'), arguments%settings)
      call collect(option_number('--window'), windows)
      if (arguments%help .or. arguments%version) return
      if (len(arguments%command) == 0) then
         call fail(error, exit_usage, 'no command: expected '//command_names())
      else if (arguments%command == 'compare' .and. size(arguments%files) < 2) then
         call fail(error, exit_usage, 'compare needs at least two results: elastokin compare A.csv B.csv, or two report folders')
      else if (len(arguments%file) == 0) then
         call fail(error, exit_usage, arguments%command//' needs a file: elastokin '//arguments%command//' FILE')
      else
         call check_options(arguments, kinds, error)
      end if
      if (.not. allocated(error)) call read_windows(windows, arguments%windows, error)
      if (len(arguments%out) == 0 .and. arguments%command /= 'study') arguments%out = 'out'

   contains

      pure logical function has(option)
         character(*), intent(in) :: option
         has = any(kinds == option_number(option))
      end function has

      !> The last value of an option, '' if it is not given.
      pure function last_of(option) result(value)
         character(*), intent(in) :: option
         character(:), allocatable :: value
         integer :: k

         value = ''
         do k = 1, size(kinds)
            if (kinds(k) == option_number(option)) value = texts(k)%text
         end do
      end function last_of

      subroutine collect(kind, found)
         integer, intent(in) :: kind
         type(setting_t), allocatable, intent(out) :: found(:)
         integer :: k, n

         allocate (found(count(kinds == kind)))
         n = 0
         do k = 1, size(kinds)
            if (kinds(k) /= kind) cycle
            n = n + 1
            found(n)%text = texts(k)%text
         end do
      end subroutine collect

   end subroutine read_arguments

   !> Takes an option, and its value: --out DIR or --out=DIR.
   subroutine take_option(k, texts, kinds, increments, error)
      integer, intent(inout) :: k                           !! number of the word, then of its value
      type(setting_t), intent(inout) :: texts(:)
      integer, intent(inout) :: kinds(:), increments
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: name
      integer :: equals, number, status

      name = texts(k)%text
      equals = 0
      if (index(name, '--') == 1 .and. index(name, '=') > 3) equals = index(name, '=')
      if (equals > 0) name = name(:equals - 1)
      if (name == '-q') name = '--quiet'
      if (name == '-h') name = '--help'
      number = option_number(name)
      if (number == 0) then
         call fail(error, exit_usage, 'unknown option '//quoted(name)//suggestion(name, options%name))
      else if (options(number)%value == '') then
         if (equals > 0) call fail(error, exit_usage, name//' takes no value, found '//quoted(texts(k)%text(equals + 1:)))
      else if (equals > 0) then
         texts(k)%text = texts(k)%text(equals + 1:)
      else if (k == size(texts)) then
         call fail(error, exit_usage, name//' needs a value after it')
      else
         k = k + 1
         texts(k)%text = argument(k)
      end if
      if (allocated(error)) return
      kinds(k) = number
      if (options(number)%value == '') return
      associate (value => texts(k)%text)
         if (len_trim(value) == 0) then      ! for instance an unset variable of the shell
            call fail(error, exit_usage, name//' needs a value, found an empty one')
         else if (name == '--increments') then
            read (value, *, iostat=status) increments
            if (status /= 0 .or. verify(value, '0123456789') /= 0 .or. increments < 1) &
               call fail(error, exit_usage, '--increments: expected a whole number of at least 1, found '//quoted(value))
         end if
      end associate
   end subroutine take_option

   !> Refuses options that the command does not take, and those that exclude each other.
   subroutine check_options(arguments, kinds, error)
      type(arguments_t), intent(in) :: arguments
      integer, intent(in) :: kinds(:)
      type(error_t), allocatable, intent(out) :: error
      integer :: k

      do k = 1, size(options)
         if (.not. any(kinds == k) .or. any(uses%command == arguments%command .and. uses%option == options(k)%name)) cycle
         call fail(error, exit_usage, arguments%command//' takes no '//trim(options(k)%name))
         return
      end do
      if (arguments%plot .and. arguments%out == '-') then
         call fail(error, exit_usage, '--plot needs an output folder and cannot be used with --out -')
      else if (arguments%compliance .and. arguments%out == '-') then
         call fail(error, exit_usage, '--compliance writes a second file and cannot be used with --out -')
      else if (arguments%out == '-' .and. any(arguments%command == [character(7) :: 'report', 'compare'])) then
         call fail(error, exit_usage, arguments%command// &
            ' writes several files: it needs an output folder and cannot be used with --out -')
      else if (arguments%no_plots .and. arguments%animate) then
         call fail(error, exit_usage, '--no-plots and --animate are mutually exclusive')
      end if
   end subroutine check_options

   !> The half widths of gradient windows: travel=15.
   subroutine read_windows(texts, windows, error)
      type(setting_t), intent(in) :: texts(:)
      type(windows_t), intent(inout) :: windows
      type(error_t), allocatable, intent(out) :: error     !! unknown window, or no positive number
      real(wp) :: half
      integer :: k, equals
      logical :: is_number, is_known

      do k = 1, size(texts)
         associate (text => texts(k)%text)
            equals = index(text, '=')
            call get_decimal(text(equals + 1:), half, is_number)
            if (.not. is_number) half = 0.0_wp      ! it may be no number, which a build with traps does not compare
            if (equals < 2 .or. verify(text(equals + 1:), '0123456789.') > 0 .or. .not. half > 0.0_wp) then
               call fail(error, exit_usage, '--window: expected window=half width with a positive number, as in travel=15, '// &
                  'found '//quoted(text))
               return
            end if
            call set_window(windows, text(:equals - 1), half, is_known)
            if (is_known) cycle
            call fail(error, exit_usage, '--window: expected travel, roll, force, torque, rack or wheel, found '// &
               quoted(text(:equals - 1)))
            return
         end associate
      end do
   end subroutine read_windows

   !> '; did you mean …?', or '' without a similar name.
   function suggestion(word, names) result(text)
      character(*), intent(in) :: word, names(:)
      character(:), allocatable :: text

      text = nearest_name(word, names)
      if (len(text) > 0) text = '; did you mean '//quoted(text)//'?'
   end function suggestion

   !> Argument number k in full length.
   function argument(k) result(text)
      integer, intent(in) :: k
      character(:), allocatable :: text
      integer :: length

      call get_command_argument(k, length=length)
      allocate (character(length) :: text)
      if (length > 0) call get_command_argument(k, value=text)
   end function argument

end module ek_command_line
