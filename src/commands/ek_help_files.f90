!> Man pages, and completion for bash, zsh and fish, from the tables of commands and options that --help prints (ek_command).
!>
!> `elastokin --help-files DIR` writes these files into subfolders of DIR; the build runs this command.
module ek_help_files
   use ek_error, only: error_t
   use ek_file, only: join_path, make_folder, write_whole
   use ek_command_line, only: command_t, option_t
   use ek_man_page, only: main_page, command_page
   use ek_shell_completion, only: bash_completion, zsh_completion, fish_completion
   implicit none(type, external)
   private
   public :: write_help_files

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

end module ek_help_files
