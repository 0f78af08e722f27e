!> Runs gnuplot in a temporary folder, for a limited time, on scripts alone. A picture is moved to its folder when it is
!> complete; if gnuplot fails, hangs or draws nothing, earlier pictures stay and an error is returned.
!>
!> gnuplot runs with -d: no settings of the user or of the machine affect a picture.
module ek_drawing
   use, intrinsic :: iso_c_binding, only: c_null_char
   use ek_error, only: error_t, message_list_t, fail, exit_file
   use ek_text, only: str, printable, plural
   use ek_posix, only: c_symlink
   use ek_system, only: facts_of, regular_file, unknown_file, facts_t, folder_names, working_folder, system_reason
   use ek_writer, only: scratch_t, begin_scratch, end_scratch, move_file
   use ek_process, only: run_program
   use ek_file, only: read_whole, join_path, program_exists, file_exists
   use ek_gnuplot_text, only: gnuplot_text
   implicit none(type, external)
   private
   public :: run_gnuplot, run_plot_script

   integer, parameter :: time_limit = 300             !! s for one run; the largest report takes a tenth of it
   integer, parameter :: most_said = 2000             !! characters of gnuplot's own message
   character(*), parameter :: log_name = 'gnuplot.log'

contains

   !> Runs gnuplot once on existing scripts. They find their data beside them and draw into the folder where they run; a
   !> picture of another folder ('../x.svg') is drawn as `to.'x.svg'`, where `to` is '' here.
   subroutine run_gnuplot(scripts, pictures, folder, message, error)
      type(message_list_t), intent(in) :: scripts         !! names in the folder
      type(message_list_t), intent(in) :: pictures        !! paths relative to the folder
      character(*), intent(in) :: folder
      character(:), allocatable, intent(out) :: message   !! '' if the pictures were drawn, otherwise the reason
      type(error_t), allocatable, intent(out) :: error    !! exit_file, with gnuplot's message
      type(scratch_t) :: scratch
      type(message_list_t) :: words
      character(:), allocatable :: home, name, trouble
      integer :: k

      message = ''
      if (scripts%count() == 0) return
      if (.not. program_exists('gnuplot')) then
         message = 'gnuplot is not installed: '//plural(scripts%count(), 'script', 'scripts')// &
            ' written, no pictures (to draw them later: gnuplot *.gp in '//folder//')'
         return
      end if
      call begin_scratch(folder, scratch, error)
      if (allocated(error)) return
      home = whole_path(folder)
      call begin_words(words, "set loadpath '..'; to = ''")
      do k = 1, scripts%count()
         call words%add(join_path(home, scripts%line(k)))
      end do
      call draw_in(scratch, words, trouble)
      do k = 1, pictures%count()
         if (len(trouble) > 0) exit
         name = last_part(pictures%line(k))
         if (.not. is_whole(join_path(scratch%path, name))) trouble = 'it has not completed '//name
      end do
      do k = 1, pictures%count()                          ! all or none: pictures of two runs are not mixed
         if (len(trouble) > 0) exit
         call move_file(join_path(scratch%path, last_part(pictures%line(k))), join_path(folder, pictures%line(k)), error)
         if (allocated(error)) trouble = error%message
      end do
      call end_scratch(scratch)
      if (len(trouble) > 0) call fail(error, exit_file, 'gnuplot could not draw the figures in '//folder//': '//trouble)
   end subroutine run_gnuplot

   !> Runs a script of the user. Its variable `out` is the folder of the tables; every complete file that the script writes
   !> there is moved to `folder`.
   subroutine run_plot_script(script, tables, folder, error)
      character(*), intent(in) :: script                  !! its path
      type(message_list_t), intent(in) :: tables          !! names in the folder
      character(*), intent(in) :: folder
      type(error_t), allocatable, intent(out) :: error    !! exit_file, with gnuplot's message
      type(scratch_t) :: scratch
      type(message_list_t) :: words, names
      type(facts_t) :: facts
      character(:), allocatable :: trouble, name
      integer :: k, moved

      call begin_scratch(folder, scratch, error)
      if (allocated(error)) return
      trouble = ''
      do k = 1, tables%count()
         if (c_symlink('../'//tables%line(k)//c_null_char, &
            join_path(scratch%path, tables%line(k))//c_null_char) /= 0) trouble = 'no link to a table: '//system_reason()
      end do
      if (len(trouble) == 0) then
         call begin_words(words, 'set loadpath '//gnuplot_text(working_folder())//'; out = '// &
            gnuplot_text(whole_path(scratch%path)))
         call words%add(whole_path(script))
         call draw_in(scratch, words, trouble)
      end if
      call folder_names(scratch%path, names)
      moved = 0
      do k = 1, names%count()
         if (len(trouble) > 0) exit
         name = join_path(scratch%path, names%line(k))
         facts = facts_of(name, follow=.false.)
         if (names%line(k) == log_name .or. .not. (facts%kind == regular_file .or. facts%kind == unknown_file)) cycle
         if (.not. is_whole(name)) trouble = 'it has not completed '//names%line(k)
      end do
      do k = 1, names%count()
         if (len(trouble) > 0) exit
         name = join_path(scratch%path, names%line(k))
         facts = facts_of(name, follow=.false.)
         if (names%line(k) == log_name .or. .not. (facts%kind == regular_file .or. facts%kind == unknown_file)) cycle
         call move_file(name, join_path(folder, names%line(k)), error)
         if (allocated(error)) trouble = error%message
         moved = moved + 1
      end do
      if (len(trouble) == 0 .and. moved == 0) trouble = 'it has drawn no picture'
      call end_scratch(scratch)
      if (len(trouble) > 0) call fail(error, exit_file, 'gnuplot could not run '''//script//''': '//trouble)
   end subroutine run_plot_script

   !> The command line of gnuplot, and the commands before any script. C.UTF-8: gnuplot rejects the degree sign in C, and
   !> other locales may write a decimal comma.
   subroutine begin_words(words, before)
      type(message_list_t), intent(out) :: words
      character(*), intent(in) :: before                  !! commands

      call words%add('env')
      call words%add('LC_ALL=C.UTF-8')
      call words%add('gnuplot')
      call words%add('-d')
      call words%add('-e')
      call words%add(before)
   end subroutine begin_words

   !> Runs gnuplot in a scratch folder.
   subroutine draw_in(scratch, words, trouble)
      type(scratch_t), intent(in) :: scratch
      type(message_list_t), intent(in) :: words
      character(:), allocatable, intent(out) :: trouble   !! '' if gnuplot succeeded
      type(error_t), allocatable :: unread
      character(:), allocatable :: said
      integer :: status

      call run_program(words, scratch%path, join_path(scratch%path, log_name), seconds_allowed(), status, trouble)
      if (len(trouble) > 0 .or. status == 0) return
      call read_whole(join_path(scratch%path, log_name), said, unread)
      trouble = printable(trim(said(:min(len(said), most_said))))
      if (len(trouble) == 0) trouble = 'it ended with status '//str(status)
   end subroutine draw_in

   !> The time limit: the environment variable EK_GNUPLOT_SECONDS if set, otherwise the default of this module.
   integer function seconds_allowed() result(limit)
      character(12) :: text
      integer :: status

      limit = time_limit
      call get_environment_variable('EK_GNUPLOT_SECONDS', value=text, status=status)
      if (status /= 0 .or. len_trim(text) == 0 .or. len_trim(text) > 6 .or. verify(trim(text), '0123456789') > 0) return
      read (text, *, iostat=status) limit
      if (status /= 0 .or. limit < 1) limit = time_limit
   end function seconds_allowed

   !> Whether a picture file is complete: on a full disk its end is missing, and gnuplot reports no error. Other files only
   !> have to be non-empty.
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

   !> The absolute path.
   function whole_path(path) result(whole)
      character(*), intent(in) :: path
      character(:), allocatable :: whole

      whole = join_path(working_folder(), path)
   end function whole_path

   !> 'c.svg' for '../c.svg'.
   pure function last_part(path) result(name)
      character(*), intent(in) :: path
      character(:), allocatable :: name

      name = path(index(path, '/', back=.true.) + 1:)
   end function last_part

end module ek_drawing
