!> Man pages, and completion for bash, zsh and fish, from the tables of commands and options that --help prints (ek_command).
!>
!> `elastokin --help-files DIR` writes these files into subfolders of DIR; the build runs this command.
!> The man pages are in man(7). What is completed: commands, the options of a command, folders after `--out`, the choices of an option
!> such as `--method`, and otherwise files.
module ek_help_files
   use ek_error, only: error_t
   use ek_file, only: join_path, make_folder, write_whole
   use ek_command_line, only: command_t, option_t, option_name
   use ek_version, only: version
   use ek_buffer, only: buffer_t
   use ek_clock, only: date_text
   use ek_option_help, only: belongs, value_name, description, on_one_line, is_repeatable, first_line, choices
   implicit none(type, external)
   private
   public :: write_help_files

   character(*), parameter :: nl = new_line('a'), backslash = achar(92), alternative = '   or   elastokin '

   character(*), parameter :: quote = ''''

   ! What may follow an option
   integer, parameter :: nothing = 0, a_folder = 1, a_file = 2, a_choice = 3, a_text = 4

contains

   !> Writes man pages and completions below a folder: man/man1, bash-completion/completions, zsh/site-functions,
   !> fish/vendor_completions.d.
   subroutine write_help_files(commands, options, exit_status, folder, error)
      type(command_t), intent(in) :: commands(:)
      type(option_t), intent(in) :: options(:)
      character(*), intent(in) :: exit_status             !! description of the exit status of all commands
      character(*), intent(in) :: folder
      type(error_t), allocatable, intent(out) :: error    !! exit_file
      integer :: k

      call write_in('man/man1', 'elastokin.1', main_page(commands, options, exit_status))
      do k = 1, size(commands)
         call write_in('man/man1', 'elastokin-'//trim(commands(k)%name)//'.1', command_page(commands(k), options))
      end do
      call write_in('bash-completion/completions', 'elastokin', bash_completion(commands, options))
      call write_in('zsh/site-functions', '_elastokin', zsh_completion(commands, options))
      call write_in('fish/vendor_completions.d', 'elastokin.fish', fish_completion(commands, options))

   contains

      subroutine write_in(part, name, text)
         character(*), intent(in) :: part, name, text

         if (.not. allocated(error)) call make_folder(join_path(folder, part), error)
         if (.not. allocated(error)) call write_whole(join_path(join_path(folder, part), name), text, error)
      end subroutine write_in

   end subroutine write_help_files

   !> The man page elastokin(1): purpose of the program, commands, options that every command accepts, exit status.
   function main_page(commands, options, exit_status) result(text)
      type(command_t), intent(in) :: commands(:)
      type(option_t), intent(in) :: options(:)
      character(*), intent(in) :: exit_status             !! section on the exit status of all commands
      character(:), allocatable :: text
      type(buffer_t) :: page
      integer :: k

      call begin_page(page, 'elastokin', 'elastokinematics (kinematics and compliance) of vehicle suspensions')
      call page%line('.B elastokin'//nl//'.I COMMAND FILE'//nl//'.RI [ options ]'//nl//'.SH DESCRIPTION')
      call page%line('Computes the kinematics and compliance of the suspension of a vehicle axle from a deck: a text file of')
      call page%line('Fortran namelist groups that lists hardpoints, bodies, joints, bushings, springs, bump stops and load cases.')
      call page%line('Results are CSV files, JSON files and HTML pages. Their paths are printed to standard output. Messages are')
      call page%line('printed to standard error.'//nl//'.SH COMMANDS')
      do k = 1, size(commands)
         call page%line('.TP'//nl//'.BR elastokin'//roff('-')//trim(commands(k)%name)//' (1)')
         call page%line(roff(trim(commands(k)%summary)))
      end do
      call page%line('.SH OPTIONS'//nl//'Every command accepts these options, and the options on the page of the command.')
      call add_options(page, '', options)
      call page%line('.SH "EXIT STATUS"'//nl//roff(on_one_line(exit_status(index(exit_status, ':') + 1:))))
      call page%line('.SH "SEE ALSO"')
      do k = 1, size(commands)
         call page%line('.BR elastokin'//roff('-')//trim(commands(k)%name)//' (1)'//merge(',', ' ', k < size(commands)))
      end do
      text = page%text()
   end function main_page

   !> The man page of a command in roff, such as elastokin-run(1).
   function command_page(command, options) result(text)
      type(command_t), intent(in) :: command
      type(option_t), intent(in) :: options(:)
      character(:), allocatable :: text
      character(:), allocatable :: usage, ending
      type(buffer_t) :: page
      integer :: cut

      call begin_page(page, 'elastokin-'//trim(command%name), trim(command%summary))
      usage = trim(command%usage)
      cut = index(usage, alternative)
      do while (cut > 0)
         call add_usage(page, usage(:cut - 1))
         call page%line('.br')
         usage = usage(cut + len(alternative):)
         cut = index(usage, alternative)
      end do
      call add_usage(page, usage)
      call page%line('.SH DESCRIPTION'//nl//roff(on_one_line(command%text)))
      call page%line('.SH OPTIONS')
      call add_options(page, trim(command%name), options)
      ending = on_one_line(command%ending)
      if (index(ending, 'Exit status') == 1) then
         call page%line('.SH "EXIT STATUS"'//nl//roff(ending))
      else if (len(ending) > 0) then
         call page%line('.SH NOTES'//nl//roff(ending))
      end if
      call page%line('.SH "SEE ALSO"'//nl//'.BR elastokin (1)')
      text = page%text()
   end function command_page

   !> Begins a page with title, name and the heading of the synopsis.
   subroutine begin_page(page, name, summary)
      type(buffer_t), intent(inout) :: page
      character(*), intent(in) :: name, summary
      character(:), allocatable :: date

      date = date_text()
      call page%line('.TH '//upper(name)//' 1 '//date(:10)//' "elastokin '//version//'" "elastokin manual"')
      call page%line('.nh'//nl//'.ad l')                     ! names and examples are not divided
      call page%line('.SH NAME'//nl//roff(name)//' '//backslash//'- '//roff(summary)//nl//'.SH SYNOPSIS')
   end subroutine begin_page

   !> Adds a line of the synopsis: 'run DECK [options]'.
   subroutine add_usage(page, usage)
      type(buffer_t), intent(inout) :: page
      character(*), intent(in) :: usage

      call page%line('.B elastokin '//usage(:index(usage//' ', ' ') - 1))
      call page%line(roff(adjustl(usage(index(usage//' ', ' '):))))
      if (index(usage, '[options]') == 0) call page%line('[options]')
   end subroutine add_usage

   !> Adds the options of a command; the options that every command accepts are last. For the command '', only these options are
   !> added.
   subroutine add_options(page, command, options)
      type(buffer_t), intent(inout) :: page
      character(*), intent(in) :: command
      type(option_t), intent(in) :: options(:)
      character(:), allocatable :: head
      integer :: k

      do k = 1, size(options)
         if (.not. belongs(options(k), command)) cycle
         head = '.BI '//roff(trim(option_name(options(k))))
         if (value_name(options(k)) /= '') head = head//' " '//value_name(options(k))//'"'
         if (value_name(options(k)) == '') head = '.B '//head(5:)
         call page%line('.TP'//nl//head//nl//roff(description(options, k)))
      end do
   end subroutine add_options

   !> A string as roff source. Line ends become breaks. Backslashes, hyphens, the ellipsis, and dots and apostrophes at the
   !> beginning of lines are escaped.
   pure function roff(text) result(source)
      character(*), intent(in) :: text
      character(:), allocatable :: source
      character(*), parameter :: ellipsis = char(226)//char(128)//char(166)      ! in UTF-8
      integer :: k

      source = ''
      k = 1
      do while (k <= len(text))
         select case (text(k:k))
         case ('-')
            source = source//backslash//'-'
         case (backslash)
            source = source//backslash//'e'
         case (nl)
            source = source//nl//'.br'//nl
         case ('.', '''')
            if (source == '') then
               source = backslash//'&'
            else if (source(len(source):) == nl) then
               source = source//backslash//'&'
            end if
            source = source//text(k:k)
         case default
            if (index(text(k:), ellipsis) == 1) then
               source = source//backslash//'&...'
               k = k + 2
            else
               source = source//text(k:k)
            end if
         end select
         k = k + 1
      end do
   end function roff

   pure function upper(name) result(capitals)
      character(*), intent(in) :: name
      character(len(name)) :: capitals
      integer :: k

      capitals = name
      do k = 1, len(name)
         if (name(k:k) >= 'a' .and. name(k:k) <= 'z') capitals(k:k) = achar(iachar(name(k:k)) - 32)
      end do
   end function upper

   !> The completion script for bash.
   function bash_completion(commands, options) result(text)
      type(command_t), intent(in) :: commands(:)
      type(option_t), intent(in) :: options(:)
      character(:), allocatable :: text
      type(buffer_t) :: script
      character(:), allocatable :: names
      integer :: k

      names = command_names(commands, ' ')
      call script%line('# completion of bash for elastokin, made from its tables of commands and options')
      call script%line('_elastokin() {')
      call script%line('  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command= list= k')
      call script%line('  # bash splits --out=DIR into three parts')
      call script%line('  if [[ $word == = ]]; then word=; elif [[ $before == = ]]; then before=${COMP_WORDS[COMP_CWORD-2]}; fi')
      call script%line('  for ((k = 1; k < COMP_CWORD; k++)); do')
      call script%line('    case ${COMP_WORDS[k]} in '//command_names(commands, '|')//') command=${COMP_WORDS[k]}; break ;; esac')
      call script%line('  done')
      call script%line('  COMPREPLY=()')
      call script%line('  case $command:$before in')
      do k = 1, size(options)
         if (options(k)%command == '' .and. options(k)%help == '') cycle
         select case (value_kind(options, k))
         case (a_folder)
            call script%line('    '//bash_case(options(k))//') compopt -o filenames 2>/dev/null')
            call script%line('      mapfile -t COMPREPLY < <(compgen -d -- "$word"); return ;;')
         case (a_choice)
            call script%line('    '//bash_case(options(k))//') mapfile -t COMPREPLY < <(compgen -W "'// &
               choices(description(options, k))//'" -- "$word"); return ;;')
         case (a_text)
            call script%line('    '//bash_case(options(k))//') compopt +o default 2>/dev/null; return ;;')
         case (a_file)
            call script%line('    '//bash_case(options(k))//') return ;;')
         end select
      end do
      call script%line('  esac')
      call script%line('  case $command in')
      call script%line('    "") list="'//names//option_list(options, '')//'" ;;')
      do k = 1, size(commands)
         call script%line('    '//trim(commands(k)%name)//') list="'//trim(choices_of(commands(k))// &
            option_list(options, trim(commands(k)%name)))//'" ;;')
      end do
      call script%line('  esac')
      call script%line('  # the files of a command: by the default of bash')
      call script%line('  if [[ -z $command || $word == -* || $command == @('// &
         command_names(pack(commands, commands%files == -2), '|')//') ]]; then')
      call script%line('    mapfile -t COMPREPLY < <(compgen -W "$list" -- "$word")')
      call script%line('  fi')
      call script%line('}')
      call script%line('complete -o default -F _elastokin elastokin')
      text = script%text()
   end function bash_completion

   !> The choices that a command accepts in place of a file, separated by blanks; '' for other commands.
   pure function choices_of(command) result(list)
      type(command_t), intent(in) :: command
      character(:), allocatable :: list

      list = ''
      if (command%files == -2) list = choices(trim(command%text))
   end function choices_of

   !> The options of a command with blanks in front: ' --out --case'.
   pure function option_list(options, command) result(list)
      type(option_t), intent(in) :: options(:)
      character(*), intent(in) :: command
      character(:), allocatable :: list
      integer :: k

      list = ''
      do k = 1, size(options)
         if (belongs(options(k), command)) list = list//' '//trim(option_name(options(k)))
      end do
   end function option_list

   !> The pattern for an option in the bash script: 'run:--out'; '*:--log' for an option of every command.
   pure function bash_case(option) result(text)
      type(option_t), intent(in) :: option
      character(:), allocatable :: text

      text = trim(option%command)//':'//trim(option_name(option))
      if (option%command == '') text = '*'//text
   end function bash_case

   !> The completion function for zsh.
   function zsh_completion(commands, options) result(text)
      type(command_t), intent(in) :: commands(:)
      type(option_t), intent(in) :: options(:)
      character(:), allocatable :: text
      type(buffer_t) :: script
      integer :: k, j

      call script%line('#compdef elastokin')
      call script%line('# completion of zsh for elastokin, made from its tables of commands and options')
      call script%line('local context state state_descr line')
      call script%line('typeset -A opt_args')
      call script%line('local -a commands=(')
      do k = 1, size(commands)
         call script%line('  '//quoted_word(trim(commands(k)%name)//':'//escaped(trim(commands(k)%summary), ':'//backslash)))
      end do
      call script%line(')')
      call script%add('_arguments -C')
      do j = 1, size(options)
         if (options(j)%command == '' .and. options(j)%help /= '') call add_zsh_option(script, options, j)
      end do
      call script%line(' '//backslash//nl//'  "1:command:->command" "*::argument:->arguments" && return')
      call script%line('case $state in')
      call script%line('  command) _describe -t commands command commands ;;')
      call script%line('  arguments)')
      call script%line('    case $line[1] in')
      do k = 1, size(commands)
         call script%add('      '//trim(commands(k)%name)//') _arguments')
         do j = 1, size(options)
            if (belongs(options(j), trim(commands(k)%name))) call add_zsh_option(script, options, j)
         end do
         if (commands(k)%files >= 0) then
            call script%line(' '//backslash//nl//'  "'//trim(merge(' ', '*', commands(k)%files == 1))//':file:_files" ;;')
         else if (commands(k)%files == -2) then
            call script%line(' '//backslash//nl//'  "1:kind:('//choices_of(commands(k))//')" ;;')
         else
            call script%line(' ;;')
         end if
      end do
      call script%line('    esac ;;')
      call script%line('esac')
      text = script%text()
   end function zsh_completion

   !> Adds an option: '--out=[output folder (default\: out)]:DIR:_files -/'.
   subroutine add_zsh_option(script, options, k)
      type(buffer_t), intent(inout) :: script
      type(option_t), intent(in) :: options(:)
      integer, intent(in) :: k
      character(:), allocatable :: spec

      spec = trim(option_name(options(k)))
      if (value_name(options(k)) /= '') spec = spec//'='
      spec = spec//'['//escaped(first_line(description(options, k)), '[]:'//backslash)//']'
      if (is_repeatable(options(k))) spec = '*'//spec
      if (value_name(options(k)) /= '') spec = spec//':'//value_name(options(k))//':'
      select case (value_kind(options, k))
      case (a_folder)
         spec = spec//'_files -/'
      case (a_file)
         spec = spec//'_files'
      case (a_choice)
         spec = spec//'('//choices(description(options, k))//')'
      case (a_text)
         spec = spec//' '
      end select
      call script%add(' '//backslash//nl//'  '//quoted_word(spec))
   end subroutine add_zsh_option

   !> The completion script for fish.
   function fish_completion(commands, options) result(text)
      type(command_t), intent(in) :: commands(:)
      type(option_t), intent(in) :: options(:)
      character(:), allocatable :: text
      character(:), allocatable :: condition
      character(15) :: name
      type(buffer_t) :: script
      integer :: k

      call script%line('# completion of fish for elastokin, made from its tables of commands and options')
      call script%line('complete -c elastokin -n __fish_use_subcommand -f')
      do k = 1, size(commands)
         call script%line('complete -c elastokin -n __fish_use_subcommand -f -a '//trim(commands(k)%name)//' -d '// &
            quoted_word(trim(commands(k)%summary), is_fish=.true.))
         if (commands(k)%files == -2) call script%line('complete -c elastokin -n "__fish_seen_subcommand_from '// &
            trim(commands(k)%name)//'" -f -a "'//choices_of(commands(k))//'"')
      end do
      do k = 1, size(options)
         if (options(k)%command == '' .and. options(k)%help == '') cycle
         condition = ''
         name = option_name(options(k))
         if (options(k)%command /= '') condition = ' -n "__fish_seen_subcommand_from '//trim(options(k)%command)//'"'
         call script%add('complete -c elastokin'//condition//' -l '//trim(name(3:))//' -d '// &
            quoted_word(first_line(description(options, k)), is_fish=.true.))
         select case (value_kind(options, k))
         case (a_folder)
            call script%line(' -x -a "(__fish_complete_directories)"')
         case (a_file)
            call script%line(' -r -F')
         case (a_choice)
            call script%line(' -x -a "'//choices(description(options, k))//'"')
         case (a_text)
            call script%line(' -x')
         case default
            call script%line('')
         end select
      end do
      text = script%text()
   end function fish_completion

   !> Kind of the value that follows option k; `nothing` for an option without a value.
   pure integer function value_kind(options, k) result(kind)
      type(option_t), intent(in) :: options(:)
      integer, intent(in) :: k

      kind = a_text
      if (value_name(options(k)) == '') then
         kind = nothing
      else if (value_name(options(k)) == 'DIR') then
         kind = a_folder
      else if (index(value_name(options(k)), 'FILE') > 0) then
         kind = a_file
      else if (choices(description(options, k)) /= '') then
         kind = a_choice
      end if
   end function value_kind

   !> The names of all commands with a separator between them: 'run check report'.
   pure function command_names(commands, between) result(text)
      type(command_t), intent(in) :: commands(:)
      character(*), intent(in) :: between
      character(:), allocatable :: text
      integer :: k

      text = trim(commands(1)%name)
      do k = 2, size(commands)
         text = text//between//trim(commands(k)%name)
      end do
   end function command_names

   !> A string with a backslash before each of some characters.
   pure function escaped(text, special) result(word)
      character(*), intent(in) :: text, special
      character(:), allocatable :: word
      integer :: k

      word = ''
      do k = 1, len(text)
         if (index(special, text(k:k)) > 0) word = word//backslash
         word = word//text(k:k)
      end do
   end function escaped

   !> A string in single quotes. A quote within the string ends the quoted part in zsh, and has a backslash before it in fish.
   pure function quoted_word(text, is_fish) result(word)
      character(*), intent(in) :: text
      logical, intent(in), optional :: is_fish
      character(:), allocatable :: word
      integer :: k

      if (present(is_fish)) then
         word = quote//escaped(text, quote//backslash)//quote
         return
      end if
      word = quote
      do k = 1, len(text)
         if (text(k:k) == quote) word = word//quote//backslash//quote
         word = word//text(k:k)
      end do
      word = word//quote
   end function quoted_word

end module ek_help_files
