!> The command line: one command, one file, options. Every error message states the expected form.
module ek_arguments
   use ek_error, only: error_t, fail, exit_usage
   use ek_text, only: nearest_name, quoted
   implicit none(type, external)
   private
   public :: arguments_t, read_arguments, setting_t

   character(*), parameter :: commands(6) = [character(7) :: 'run', 'check', 'report', 'compare', 'study', 'bench']
   character(*), parameter :: command_words = 'run, check, report, compare, study or bench'
   character(*), parameter :: options(13) = [character(12) :: '--compliance', '--out', '--method', '--increments', '--case', &
      '--set', '--plot', '--no-plots', '--animate', '--window', '--quiet', '--help', '--version']

   !> A text of its own length.
   type :: setting_t
      character(:), allocatable :: text
   end type setting_t

   !> The options of the command line; texts that were not given are empty.
   type :: arguments_t
      character(:), allocatable :: command      !! one of `commands`, or '' for help or version
      character(:), allocatable :: file         !! deck or study; '-' is standard input
      type(setting_t), allocatable :: files(:)  !! all files given; `file` is the first; only compare accepts several
      character(:), allocatable :: out, method, case
      type(setting_t), allocatable :: settings(:)   !! path=value
      type(setting_t), allocatable :: windows(:)    !! window=half width
      integer :: increments = 0                 !! 0: as in the deck
      logical :: compliance = .false.           !! also write the compliance matrix at every state
      logical :: plot = .false., no_plots = .false., animate = .false.
      logical :: quiet = .false., help = .false., version = .false.
   end type arguments_t

contains

   !> Reads the command line of this process.
   subroutine read_arguments(arguments, error)
      type(arguments_t), intent(out) :: arguments
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: word, value
      integer :: k, equals, status
      logical :: has_value

      arguments%command = ''
      arguments%file = ''
      arguments%out = ''
      arguments%method = ''
      arguments%case = ''
      allocate (arguments%settings(0), arguments%windows(0), arguments%files(0))
      if (command_argument_count() == 0) arguments%help = .true.
      value = ''
      k = 0
      do while (k < command_argument_count())
         k = k + 1
         word = argument(k)
         has_value = .false.
         equals = index(word, '=')
         if (len(word) > 2 .and. equals > 3) then
            if (word(1:2) == '--') then         ! --out=DIR
               value = word(equals + 1:)
               word = word(:equals - 1)
               has_value = .true.
            end if
         end if
         if (has_value .and. any(word == [character(12) :: '--plot', '--compliance', '--no-plots', '--animate', '--quiet', &
            '--help', '--version'])) then
            call fail(error, exit_usage, word//' takes no value, found '//quoted(value))
            return
         end if
         select case (word)
         case ('--plot')
            arguments%plot = .true.
         case ('--compliance')
            arguments%compliance = .true.
         case ('--no-plots')
            arguments%no_plots = .true.
         case ('--animate')
            arguments%animate = .true.
         case ('--quiet', '-q')
            arguments%quiet = .true.
         case ('--help', '-h')
            arguments%help = .true.
         case ('--version')
            arguments%version = .true.
         case ('--out', '--method', '--case', '--increments', '--set', '--window')
            if (.not. has_value) then
               if (k == command_argument_count()) then
                  call fail(error, exit_usage, word//' needs a value after it')
                  return
               end if
               k = k + 1
               value = argument(k)
            end if
            if (len_trim(value) == 0) then      ! for instance an unset variable of the shell
               call fail(error, exit_usage, word//' needs a value, found an empty one')
               return
            end if
            select case (word)
            case ('--out')
               arguments%out = value
            case ('--method')
               arguments%method = value
            case ('--case')
               arguments%case = value
            case ('--set')
               call add_setting(arguments%settings, value)
            case ('--window')
               call add_setting(arguments%windows, value)
            case ('--increments')
               read (value, *, iostat=status) arguments%increments
               if (status /= 0 .or. verify(value, '0123456789') /= 0 .or. arguments%increments < 1) then
                  call fail(error, exit_usage, '--increments: expected a whole number of at least 1, found '//quoted(value))
                  return
               end if
            end select
         case default
            if (len(word) > 1 .and. word(1:1) == '-') then
               call fail(error, exit_usage, 'unknown option '//quoted(word)//suggestion(word, options))
               return
            else if (len(arguments%command) == 0) then
               if (.not. any(commands == word)) then
                  call fail(error, exit_usage, 'unknown command '//quoted(word)//suggestion(word, commands)// &
                     '; expected '//command_words)
                  return
               end if
               arguments%command = word
            else if (len(arguments%file) == 0) then
               arguments%file = word
               call add_setting(arguments%files, word)
            else if (arguments%command == 'compare') then
               call add_setting(arguments%files, word)
            else
               call fail(error, exit_usage, 'expected one file, found '//quoted(arguments%file)//' and '//quoted(word))
               return
            end if
         end select
      end do
      if (arguments%help .or. arguments%version) return
      if (len(arguments%command) == 0) then
         call fail(error, exit_usage, 'no command: expected '//command_words)
      else if (arguments%command == 'compare' .and. size(arguments%files) < 2) then
         call fail(error, exit_usage, 'compare needs at least two results: elastokin compare A.csv B.csv, or two report folders')
      else if (len(arguments%file) == 0) then
         call fail(error, exit_usage, arguments%command//' needs a file: elastokin '//arguments%command//' FILE')
      else
         call refuse_unused(arguments, error)
      end if
   end subroutine read_arguments

   !> Refuses options that the command does not use.
   subroutine refuse_unused(arguments, error)
      type(arguments_t), intent(in) :: arguments
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: unused

      unused = ''
      if (arguments%command /= 'run') then
         if (arguments%plot) unused = '--plot'
         if (arguments%compliance) unused = '--compliance'
         if (len(arguments%method) > 0 .and. arguments%command /= 'report') unused = '--method'
         if (len(arguments%out) > 0 .and. any(arguments%command == [character(5) :: 'check', 'bench'])) unused = '--out'
      end if
      if (arguments%command /= 'report') then
         if (arguments%animate) unused = '--animate'
         if (size(arguments%windows) > 0 .and. arguments%command /= 'compare') unused = '--window'
         if (arguments%no_plots .and. arguments%command /= 'compare') unused = '--no-plots'
      end if
      if (arguments%command == 'compare') then
         if (size(arguments%settings) > 0) unused = '--set'
         if (len(arguments%case) > 0) unused = '--case'
         if (arguments%increments > 0) unused = '--increments'
      end if
      if (arguments%command == 'study') then
         if (len(arguments%case) > 0) unused = '--case'
         if (arguments%increments > 0) unused = '--increments'
      end if
      if (arguments%command == 'check') then
         if (arguments%quiet) unused = '--quiet'
         if (arguments%increments > 0) unused = '--increments'
      end if
      if (len(unused) > 0) then
         call fail(error, exit_usage, arguments%command//' takes no '//unused)
      else if (arguments%plot .and. arguments%out == '-') then
         call fail(error, exit_usage, '--plot needs an output folder and cannot be used with --out -')
      else if (arguments%compliance .and. arguments%out == '-') then
         call fail(error, exit_usage, '--compliance writes a second file and cannot be used with --out -')
      else if (arguments%out == '-' .and. any(arguments%command == [character(7) :: 'report', 'compare'])) then
         call fail(error, exit_usage, arguments%command// &
            ' writes several files: it needs an output folder and cannot be used with --out -')
      else if (arguments%no_plots .and. arguments%animate) then
         call fail(error, exit_usage, '--no-plots and --animate are mutually exclusive')
      end if
   end subroutine refuse_unused

   !> Appends a text. (gfortran 12 leaks the component of a constructor within an array constructor.)
   subroutine add_setting(settings, text)
      type(setting_t), allocatable, intent(inout) :: settings(:)
      character(*), intent(in) :: text
      type(setting_t), allocatable :: more(:)

      allocate (more(size(settings) + 1))
      more(:size(settings)) = settings
      more(size(more))%text = text
      call move_alloc(more, settings)
   end subroutine add_setting

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

end module ek_arguments
