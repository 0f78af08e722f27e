!> Completion of command lines by bash, zsh and fish, from the tables of commands and options: commands, the options of a command,
!> folders after `--out`, the choices of an option such as `--method`, and otherwise files.
module ek_shell_completion
   use ek_buffer, only: buffer_t
   use ek_command_line, only: command_t, option_t, option_name
   use ek_option_help, only: belongs, is_repeatable, value_name, description, first_line, choices
   implicit none(type, external)
   private
   public :: bash_completion, zsh_completion, fish_completion

   character(*), parameter :: nl = new_line('a'), backslash = achar(92), quote = ''''

   ! What may follow an option
   integer, parameter :: nothing = 0, a_folder = 1, a_file = 2, a_choice = 3, a_text = 4

contains

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
         call script%line('    '//trim(commands(k)%name)//') list="'//option_list(options, trim(commands(k)%name))//'" ;;')
      end do
      call script%line('  esac')
      call script%line('  # the files of a command: by the default of bash')
      call script%line('  if [[ -z $command || $word == -* ]]; then mapfile -t COMPREPLY < <(compgen -W "$list" -- "$word"); fi')
      call script%line('}')
      call script%line('complete -o default -F _elastokin elastokin')
      text = script%text()
   end function bash_completion

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
         call script%line(' '//backslash//nl//'  "'//trim(merge(' ', '*', commands(k)%files == 1))//':file:_files" ;;')
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

end module ek_shell_completion
