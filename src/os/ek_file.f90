!> Files and folders. A file is written completely or not at all (ek_writer); no shell is ever started.
!> A pipe is read to its end. A pipe that no program has opened for writing within 10 s is rejected, and so is a pipe that gives more
!> than 100 MB.
module ek_file
   use, intrinsic :: iso_fortran_env, only: output_unit
   use, intrinsic :: iso_c_binding, only: c_int, c_int32_t, c_null_char, c_char
   use ek_kinds, only: i8, wp
   use ek_buffer, only: buffer_t
   use ek_error, only: error_t, fail, exit_file
   use ek_text, only: str
   use ek_system_call, only: c_make_folder, c_remove, c_exists, c_can_start, c_isatty, c_open, c_read, c_close, c_sleep, to_read, &
      done, try_again, broken_pipe, text_of
   use ek_system, only: facts_t, facts_of, device_file, other_file, system_reason, folder_exists, write_bytes
   use ek_writer, only: writer_t, begin_file, remove_stale
   use ek_clock, only: seconds
   implicit none(type, external)
   private
   public :: most_of_input, write_whole, write_standard_output, write_standard_error, read_whole, make_folder, remove_file, &
      file_exists, folder_exists, program_exists, is_terminal, join_path, folder_name, base_name

   integer, parameter :: max_streamed = 100000000        !! limit of the bytes read; the largest known deck has half a percent
   real(wp), parameter :: patience = 10.0_wp             !! time for a program to open the pipe for writing [s]
   integer(c_int32_t), parameter :: nap = 10             !! time before the next read of an empty pipe [ms]

   integer, parameter :: most_of_input = 50000000   !! limit of the bytes of a deck and of the files that it names

contains

   !> Writes `text` as the content of the file `path`, atomically for other readers. A device (`/dev/stdout`) is written directly.
   subroutine write_whole(path, text, error, can_be_redrawn)
      character(*), intent(in) :: path
      character(*), intent(in) :: text                       !! bytes, written as they are
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with path and reason
      logical, intent(in), optional :: can_be_redrawn        !! if .true., the call does not wait for the disk (ek_writer)
      type(writer_t) :: writer

      call begin_file(writer, path, error, can_be_redrawn)
      if (allocated(error)) return
      call writer%add(text)
      call writer%finish(error)
   end subroutine write_whole

   !> Writes bytes to standard output, after anything Fortran has written there. Unlike a Fortran `write` it reports a full
   !> disk. A reader that has closed the pipe (`| head`) causes an error with an empty message.
   subroutine write_standard_output(text, error)
      character(*), intent(in) :: text                       !! bytes, written as they are
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with the reason
      integer :: outcome

      flush (output_unit, iostat=outcome)
      call write_bytes(1_c_int32_t, text, outcome)
      if (outcome == broken_pipe) then
         call fail(error, exit_file, '')
      else if (outcome /= done) then
         call fail(error, exit_file, 'cannot write to standard output: '//system_reason())
      end if
   end subroutine write_standard_output

   !> Writes bytes to standard error. A failure here cannot be reported anywhere and is ignored.
   subroutine write_standard_error(text)
      character(*), intent(in) :: text
      integer :: ignored

      call write_bytes(2_c_int32_t, text, ignored)
   end subroutine write_standard_error

   !> Reads the whole content of a file, byte for byte.
   !>
   !> A pipe is read only with `may_stream`, which callers set for paths given by the user; /dev/null is then an empty file. Any
   !> other device is rejected, because a device may be endless.
   subroutine read_whole(path, text, error, may_stream, most)
      character(*), intent(in) :: path
      character(:), allocatable, intent(out) :: text         !! '' when the file is empty or unreadable
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with path and reason
      logical, intent(in), optional :: may_stream            !! if absent or .false., the path must be a regular file
      integer, intent(in), optional :: most                  !! limit of the bytes; default 1 GB
      type(facts_t) :: facts
      character(:), allocatable :: reason
      logical :: streams

      text = ''
      reason = ''
      streams = .false.
      if (present(may_stream)) streams = may_stream
      facts = facts_of(path, follow=.true.)
      if (index(path, c_null_char) > 0) then
         reason = 'its name contains a NUL character'
      else if (folder_exists(path)) then
         reason = 'it is a folder'
      else if (streams .and. path == '/dev/null') then
         return
      else if (.not. streams .and. (facts%kind == device_file .or. facts%kind == other_file)) then
         reason = 'it is a pipe or a device, not a regular file'
      else if (facts%kind == device_file) then
         reason = 'it is a device, not a regular file or a pipe'
      else if (facts%kind == other_file) then
         call read_stream(path, text, reason)
      else
         call read_regular(path, text, reason, most)
      end if
      if (reason == '' .and. present(most)) then
         if (len(text) > most) reason = too_large(int(len(text), i8), most)
      end if
      if (reason == '') return
      text = ''
      call fail(error, exit_file, "cannot read '"//path//"': "//reason)
   end subroutine read_whole

   !> Message that a file is larger than the limit.
   function too_large(bytes, most) result(text)
      integer(i8), intent(in) :: bytes
      integer, intent(in) :: most                            !! bytes
      character(:), allocatable :: text
      text = 'it has '//str(int((bytes + 999999)/1000000))//' MB, expected at most '//str(most/1000000)//' MB'
   end function too_large

   !> Reads a regular file of at most 1 GB: what is made of its characters must fit, too. Files of /proc have the size 0 but are not empty.
   subroutine read_regular(path, text, reason, most)
      character(*), intent(in) :: path
      character(:), allocatable, intent(out) :: text
      character(:), allocatable, intent(out) :: reason       !! reason why the file cannot be read; '' if it was read
      integer, intent(in), optional :: most                  !! limit of the bytes; default 1 GB
      type(buffer_t) :: bytes
      character(200) :: words
      character(1) :: byte
      integer(i8) :: size, largest
      integer :: unit, status, ignored

      text = ''
      reason = ''
      open (newunit=unit, file=path, access='stream', form='unformatted', action='read', status='old', iostat=status, iomsg=words)
      if (status == 0) then
         inquire (unit=unit, size=size)
         largest = 1000000000
         if (present(most)) largest = most
         if (size > largest) then
            status = 1
            words = 'it is larger than 1 GB'
            if (present(most)) words = too_large(size, most)
         else if (size > 0) then
            deallocate (text)
            allocate (character(size) :: text, stat=status)
            words = 'there is not enough memory for it'
            if (status == 0) read (unit, iostat=status, iomsg=words) text
         else
            do while (bytes%length() < max_streamed .and. status == 0)
               read (unit, iostat=status) byte
               if (status == 0) call bytes%add(byte)
            end do
            text = bytes%text()
            status = merge(1, 0, len(text) == max_streamed)
            words = 'it is longer than 100 MB'
         end if
         close (unit, iostat=ignored)
      end if
      ! of gfortran's "Cannot open file 'x': No such file or directory" the last part
      if (status /= 0) reason = trim(adjustl(words(index(trim(words), ': ', back=.true.) + 1:)))
   end subroutine read_regular

   !> Creates a folder and its parents. In an existing folder, temporary files of terminated runs are removed.
   subroutine make_folder(path, error)
      character(*), intent(in) :: path
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with path and reason
      character(:), allocatable :: reason
      integer :: k

      reason = 'no name is given'
      do k = 1, len(path)
         if (k < len(path)) then
            if (path(k + 1:k + 1) /= '/' .or. path(k:k) == '/') cycle
         end if
         if (folder_exists(path(:k))) cycle
         if (c_make_folder(path(:k)//c_null_char, 0_c_int32_t) /= done) reason = system_reason()
         if (.not. folder_exists(path(:k))) exit
      end do
      if (.not. folder_exists(path)) then
         call fail(error, exit_file, "cannot create the folder '"//path//"': "//reason)
         return
      end if
      call remove_stale(path)
   end subroutine make_folder

   !> Removes a file or an empty folder; a failure is ignored.
   subroutine remove_file(path)
      character(*), intent(in) :: path
      integer :: ignored

      ignored = c_remove(path//c_null_char)
   end subroutine remove_file

   !> Whether a file or folder with this name exists.
   logical function file_exists(path)
      character(*), intent(in) :: path
      file_exists = c_exists(path//c_null_char) /= 0
   end function file_exists

   !> Whether a program with this name can be started. The program must be in PATH, or exist at its path if the name contains a
   !> slash.
   logical function program_exists(name) result(is_there)
      character(*), intent(in) :: name
      character(:), allocatable :: path
      integer :: length, first, last

      is_there = .false.
      if (index(name, '/') > 0) then
         is_there = is_program(name)
         return
      end if
      call get_environment_variable('PATH', length=length)
      allocate (character(length) :: path)
      call get_environment_variable('PATH', value=path)
      first = 1
      do while (first <= length .and. .not. is_there)
         last = index(path(first:)//':', ':') + first - 2
         if (last >= first) is_there = is_program(join_path(path(first:last), name))
         first = last + 2
      end do
   end function program_exists

   !> Whether a path is an executable file.
   logical function is_program(path)
      character(*), intent(in) :: path

      is_program = .not. folder_exists(path)
      if (is_program) is_program = c_can_start(path//c_null_char) /= 0
   end function is_program

   !> Whether standard output (1) or standard error (2) is a terminal.
   logical function is_terminal(descriptor)
      integer, intent(in) :: descriptor
      is_terminal = c_isatty(int(descriptor, c_int)) == 1
   end function is_terminal

   !> The path folder/name. A name that starts with a slash is returned unchanged.
   pure function join_path(folder, name) result(path)
      character(*), intent(in) :: folder, name
      character(:), allocatable :: path

      if (len(folder) == 0 .or. index(name, '/') == 1) then
         path = name
      else if (folder(len(folder):) == '/') then
         path = folder//name
      else
         path = folder//'/'//name
      end if
   end function join_path

   !> The folder of a path: 'a/b' for 'a/b/c.nml', '.' for 'c.nml', '/' for '/c.nml'.
   pure function folder_name(path) result(folder)
      character(*), intent(in) :: path
      character(:), allocatable :: folder
      integer :: slash

      slash = index(path, '/', back=.true.)
      folder = '.'
      if (slash > 0) folder = path(:max(1, slash - 1))
   end function folder_name

   !> The name of a file without folder and extension: 'c' for 'a/b/c.nml', 'c.x' for 'c.x.nml', '.rc' for 'a/.rc'.
   pure function base_name(path) result(name)
      character(*), intent(in) :: path
      character(:), allocatable :: name
      integer :: dot

      name = path(index(path, '/', back=.true.) + 1:)
      dot = index(name, '.', back=.true.)
      if (dot > 1) name = name(:dot - 1)
   end function base_name

   !> Reads the output of other programs from a pipe, until the last program closes the pipe.
   subroutine read_stream(path, text, reason)
      character(*), intent(in) :: path
      character(:), allocatable, intent(out) :: text
      character(:), allocatable, intent(out) :: reason       !! reason why the pipe cannot be read; '' if it was read
      type(buffer_t) :: bytes
      character(kind=c_char) :: chunk(65536)
      integer(c_int32_t) :: file
      real(wp) :: start
      logical :: has_writer
      integer :: got, ignored

      text = ''
      reason = ''
      start = seconds()
      has_writer = .false.
      file = c_open(path//c_null_char, to_read)
      if (file < 0) reason = system_reason()
      do while (reason == '')
         got = c_read(file, chunk, size(chunk, kind=c_int32_t))
         if (got > 0) then
            has_writer = .true.
            call bytes%add(text_of(chunk, got))
            if (bytes%length() > max_streamed) reason = 'it is longer than 100 MB'
            cycle
         else if (got == 0) then
            if (has_writer) exit
            if (seconds() - start > patience) reason = 'it is a pipe into which no program writes'
         else if (got == try_again) then                     ! a program has opened the pipe and has not written yet
            has_writer = .true.
         else
            reason = system_reason()
         end if
         if (reason == '') call c_sleep(nap)
      end do
      if (file >= 0) ignored = c_close(file)
      if (reason == '') text = bytes%text()
   end subroutine read_stream

end module ek_file
