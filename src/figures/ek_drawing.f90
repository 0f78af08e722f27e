!> Runs gnuplot on scripts in a temporary folder, for a limited time. A picture is moved to its folder when all pictures are
!> complete. If gnuplot fails, hangs or draws nothing, earlier pictures are not replaced and an error is returned. gnuplot
!> runs with -d and without the environment variables of gnuplot: no settings of the user or of the machine affect a picture.
module ek_drawing
   use ek_error, only: error_t, message_list_t, fail, exit_file
   use ek_text, only: str, printable, plural
   use ek_system, only: facts_of, regular_file, unknown_file, facts_t, folder_names, working_folder, system_reason, make_link
   use ek_writer, only: scratch_t, begin_scratch, end_scratch, move_file
   use ek_process, only: run_program
   use ek_interrupt, only: obey_stop
   use ek_file, only: read_whole, join_path, program_exists, file_exists
   use ek_gnuplot_text, only: gnuplot_text
   implicit none(type, external)
   private
   public :: run_gnuplot, run_plot_script

   integer, parameter :: time_limit = 300             !! limit on one run [s]; the largest report takes a tenth of the limit
   integer, parameter :: longest_log = 2000           !! limit on the characters of gnuplot's own message
   character(*), parameter :: log_name = 'gnuplot.log'

contains

   !> Runs gnuplot once on existing scripts. The scripts read data from their folder and draw into the working folder. A
   !> script names a picture of another folder ('../x.svg') as `to.'x.svg'`; `to` is '' here, so that this picture is also
   !> drawn into the working folder. If gnuplot is not installed, `message` says so, and this is not an error.
   subroutine run_gnuplot(scripts, pictures, folder, message, error)
      type(message_list_t), intent(in) :: scripts         !! names in the folder
      type(message_list_t), intent(in) :: pictures        !! paths relative to the folder
      character(*), intent(in) :: folder
      character(:), allocatable, intent(out) :: message   !! reason if gnuplot is not installed, otherwise ''
      type(error_t), allocatable, intent(out) :: error    !! exit_file, with gnuplot's message
      type(scratch_t) :: scratch
      character(:), allocatable :: trouble

      message = ''
      if (scripts%count() == 0) return
      if (.not. program_exists('gnuplot')) then
         message = 'gnuplot is not installed: '//plural(scripts%count(), 'script', 'scripts')// &
            ' written, no pictures (to draw them later: gnuplot *.gp in '//folder//')'
         return
      end if
      call begin_scratch(folder, scratch, error)
      if (allocated(error)) return
      call draw_in(scratch, "set loadpath '..'; to = ''", scripts, join_path(working_folder(), folder), trouble)
      call take_pictures(scratch, pictures, folder, trouble)
      if (len(trouble) > 0) call fail(error, exit_file, 'gnuplot could not draw the figures in '//folder//': '//trouble)
   end subroutine run_gnuplot

   !> Runs a plot script of the user in a temporary folder. The gnuplot variable `out` is this folder, which has links to the
   !> tables. If all files that the script writes there are complete, they are moved to `folder`. An incomplete file, or no
   !> file, is an error, and no file is moved.
   subroutine run_plot_script(script, tables, folder, error)
      character(*), intent(in) :: script                  !! path of the script
      type(message_list_t), intent(in) :: tables          !! names in the folder
      character(*), intent(in) :: folder
      type(error_t), allocatable, intent(out) :: error    !! exit_file, with gnuplot's message
      type(scratch_t) :: scratch
      type(message_list_t) :: scripts, names, pictures
      type(facts_t) :: facts
      character(:), allocatable :: trouble
      logical :: is_made
      integer :: k

      call begin_scratch(folder, scratch, error)
      if (allocated(error)) return
      trouble = ''
      do k = 1, tables%count()
         call make_link('../'//tables%line(k), join_path(scratch%path, tables%line(k)), is_made)
         if (.not. is_made) trouble = 'no link to a table: '//system_reason()
      end do
      if (len(trouble) == 0) then
         call scripts%add(script)
         call draw_in(scratch, 'set loadpath '//gnuplot_text(working_folder())//'; out = '// &
            gnuplot_text(join_path(working_folder(), scratch%path)), scripts, working_folder(), trouble)
      end if
      call folder_names(scratch%path, names)
      do k = 1, names%count()
         facts = facts_of(join_path(scratch%path, names%line(k)), follow=.false.)
         if (names%line(k) == log_name .or. .not. (facts%kind == regular_file .or. facts%kind == unknown_file)) cycle
         call pictures%add(names%line(k))
      end do
      if (len(trouble) == 0 .and. pictures%count() == 0) trouble = 'it has drawn no picture'
      call take_pictures(scratch, pictures, folder, trouble)
      if (len(trouble) > 0) call fail(error, exit_file, 'gnuplot could not run '''//script//''': '//trouble)
   end subroutine run_plot_script

   !> Moves all pictures to their folder if all are complete, otherwise none, so that pictures of two runs are not mixed.
   !> Removes the temporary folder.
   subroutine take_pictures(scratch, pictures, folder, trouble)
      type(scratch_t), intent(inout) :: scratch           !! temporary folder; it is removed
      type(message_list_t), intent(in) :: pictures        !! paths relative to the folder
      character(*), intent(in) :: folder
      character(:), allocatable, intent(inout) :: trouble !! '' so far, or nothing is moved
      type(error_t), allocatable :: error
      character(:), allocatable :: name
      integer :: k

      do k = 1, pictures%count()
         if (len(trouble) > 0) exit
         name = pictures%line(k)
         name = name(index(name, '/', back=.true.) + 1:)
         if (.not. is_whole(join_path(scratch%path, name))) trouble = 'it has not completed '//name
      end do
      do k = 1, pictures%count()
         if (len(trouble) > 0) exit
         name = pictures%line(k)
         name = name(index(name, '/', back=.true.) + 1:)
         call move_file(join_path(scratch%path, name), join_path(folder, pictures%line(k)), error)
         if (allocated(error)) trouble = error%message
      end do
      call end_scratch(scratch)
      call obey_stop()
   end subroutine take_pictures

   !> Runs gnuplot on scripts in a scratch folder, in the locale C.UTF-8: gnuplot rejects the degree sign in the locale C, and other
   !> locales may write a decimal comma.
   subroutine draw_in(scratch, before, scripts, folder, trouble)
      type(scratch_t), intent(in) :: scratch
      character(*), intent(in) :: before                  !! commands that run before the scripts
      type(message_list_t), intent(in) :: scripts         !! paths relative to the folder
      character(*), intent(in) :: folder
      character(:), allocatable, intent(out) :: trouble   !! '' if gnuplot succeeded
      ! GNUTERM is a command of gnuplot that fails where the terminal is missing
      character(24), parameter :: first(*) = [character(24) :: 'env', '-u', 'GNUTERM', '-u', 'FIT_LOG', '-u', 'FIT_SCRIPT', &
         '-u', 'GNUPLOT_LIB', '-u', 'GNUPLOT_DEFAULT_GDFONT', '-u', 'GNUPLOT_FONTPATH', '-u', 'GNUPLOT_DRIVER_DIR', &
         'LC_ALL=C.UTF-8', 'gnuplot', '-d', '-e']
      type(message_list_t) :: command
      type(error_t), allocatable :: unread
      character(:), allocatable :: log
      integer :: k, status

      do k = 1, size(first)
         call command%add(trim(first(k)))
      end do
      call command%add(before)
      do k = 1, scripts%count()
         call command%add(join_path(folder, scripts%line(k)))
      end do
      call run_program(command, scratch%path, join_path(scratch%path, log_name), seconds_allowed(), status, trouble)
      if (len(trouble) > 0 .or. status == 0) return
      call read_whole(join_path(scratch%path, log_name), log, unread)
      trouble = printable(trim(log(:min(len(log), longest_log))))
      if (len(trouble) == 0) trouble = 'it ended with status '//str(status)
   end subroutine draw_in

   !> The time limit of gnuplot [s]: the environment variable EK_GNUPLOT_SECONDS if it is a positive integer of up to 6
   !> digits, otherwise the default of this module.
   integer function seconds_allowed() result(limit)
      character(12) :: text
      integer :: status

      limit = time_limit
      call get_environment_variable('EK_GNUPLOT_SECONDS', value=text, status=status)
      if (status /= 0 .or. len_trim(text) == 0 .or. len_trim(text) > 6 .or. verify(trim(text), '0123456789') > 0) return
      read (text, *, iostat=status) limit
      if (status /= 0 .or. limit < 1) limit = time_limit
   end function seconds_allowed

   !> Whether a picture file is complete. On a full disk the end of the file is missing, and gnuplot reports no error. A file that
   !> is not a picture must only be non-empty.
   logical function is_whole(path)
      character(*), intent(in) :: path
      character(:), allocatable :: bytes
      type(error_t), allocatable :: error
      character(*), parameter :: png_end = 'IEND'//char(174)//'B`'//char(130)
      integer :: n

      is_whole = .false.
      if (.not. file_exists(path)) return
      call read_whole(path, bytes, error)
      if (allocated(error)) return
      n = len(bytes)
      if (n == 0) return
      select case (path(index(path, '.', back=.true.):))
      case ('.svg')
         is_whole = index(bytes(max(1, n - 15):), '</svg>') > 0
      case ('.png')
         is_whole = index(bytes(max(1, n - 7):), png_end) > 0
      case ('.gif')
         is_whole = index(bytes, 'GIF8') == 1 .and. bytes(n:) == ';'
      case ('.pdf')
         is_whole = index(bytes(max(1, n - 15):), '%%EOF') > 0
      case default
         is_whole = .true.
      end select
   end function is_whole

end module ek_drawing
