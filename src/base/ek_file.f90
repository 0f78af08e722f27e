!> Files and folders. A file written here is there whole or not at all; no shell is ever started.
!>
!> What Fortran does not offer (rename, mkdir, isatty, why something failed) is asked of the C
!> library; `__errno_location` is the name glibc and musl give to errno.
module ek_file
   use, intrinsic :: iso_fortran_env, only: output_unit
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char, c_ptr, c_size_t, &
      c_associated, c_f_pointer
   use ek_kinds, only: i8
   use ek_error, only: error_t, fail, exit_file
   implicit none(type, external)
   private
   public :: write_whole, write_standard_output, read_whole, make_folder, remove_file
   public :: file_exists, folder_exists, program_exists, is_terminal
   public :: join_path, folder_name, base_name

   integer, parameter :: most_streamed = 1000000000   !! bytes of a pipe or a device; /dev/zero has no end
   integer(c_int), parameter :: may_exist = 0    !! F_OK of access(2)
   integer(c_int), parameter :: may_execute = 1  !! X_OK
   integer(c_int), parameter :: all_may = 511    !! 0777, the umask takes away

   interface
      type(c_ptr) function c_fopen(path, mode) bind(c, name='fopen')
         import :: c_ptr, c_char
         character(kind=c_char), intent(in) :: path(*), mode(*)
      end function c_fopen
      integer(c_size_t) function c_fwrite(bytes, size, count, stream) bind(c, name='fwrite')
         import :: c_ptr, c_char, c_size_t
         character(kind=c_char), intent(in) :: bytes(*)
         integer(c_size_t), value :: size, count
         type(c_ptr), value :: stream
      end function c_fwrite
      integer(c_size_t) function c_write(descriptor, bytes, count) bind(c, name='write')
         import :: c_int, c_char, c_size_t
         integer(c_int), value :: descriptor
         character(kind=c_char), intent(in) :: bytes(*)
         integer(c_size_t), value :: count
      end function c_write
      integer(c_int) function c_fclose(stream) bind(c, name='fclose')
         import :: c_int, c_ptr
         type(c_ptr), value :: stream
      end function c_fclose
      integer(c_int) function c_rename(from, to) bind(c, name='rename')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: from(*), to(*)
      end function c_rename
      integer(c_int) function c_remove(path) bind(c, name='remove')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function c_remove
      integer(c_int) function c_mkdir(path, mode) bind(c, name='mkdir')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: mode
      end function c_mkdir
      integer(c_int) function c_access(path, mode) bind(c, name='access')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: mode
      end function c_access
      integer(c_int) function c_isatty(descriptor) bind(c, name='isatty')
         import :: c_int
         integer(c_int), value :: descriptor
      end function c_isatty
      integer(c_int) function c_getpid() bind(c, name='getpid')
         import :: c_int
      end function c_getpid
      type(c_ptr) function c_errno() bind(c, name='__errno_location')
         import :: c_ptr
      end function c_errno
      type(c_ptr) function c_strerror(number) bind(c, name='strerror')
         import :: c_ptr, c_int
         integer(c_int), value :: number
      end function c_strerror
      integer(c_size_t) function c_strlen(text) bind(c, name='strlen')
         import :: c_ptr, c_size_t
         type(c_ptr), value :: text
      end function c_strlen
   end interface

contains

   !> Write `text` as the content of `path`, in one step for every reader: into a temporary file of the
   !> same folder first, which then takes the name. A device (`/dev/stdout`) is written directly.
   subroutine write_whole(path, text, error)
      character(*), intent(in) :: path
      character(*), intent(in) :: text                       !! bytes, written as they are
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with path and reason
      character(:), allocatable :: temporary, reason
      character(12) :: pid
      integer(c_int) :: ignored
      logical :: is_device

      is_device = index(path, '/dev/') == 1 .or. index(path, '/proc/') == 1
      temporary = path
      if (.not. is_device) then
         write (pid, '(i0)') c_getpid()
         temporary = path//'.'//trim(pid)//'.tmp'
      end if
      if (folder_exists(path)) then
         reason = 'it is a folder'
      else
         call put_bytes(temporary, text, reason)
         if (is_device .and. len(reason) == 0) return
      end if
      if (len(reason) == 0) then
         if (c_rename(temporary//c_null_char, path//c_null_char) == 0) return
         reason = system_reason()
      end if
      if (.not. is_device) ignored = c_remove(temporary//c_null_char)
      call fail(error, exit_file, "cannot write '"//path//"': "//reason)
   end subroutine write_whole

   !> Write bytes to standard output, after what Fortran has put there. Unlike a Fortran `write` it tells
   !> when the disk is full.
   subroutine write_standard_output(text, error)
      character(*), intent(in) :: text                       !! bytes, written as they are
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with the reason
      integer(c_size_t) :: done, now

      flush (output_unit)
      done = 0
      do while (done < len(text, c_size_t))
         now = c_write(1_c_int, text(done + 1:), len(text, c_size_t) - done)
         if (now < 1) then                                   ! a ssize_t: negative on failure
            call fail(error, exit_file, 'cannot write to standard output: '//system_reason())
            return
         end if
         done = done + now
      end do
   end subroutine write_standard_output

   !> Write bytes through the C library: gfortran's flush and close do not tell that a disk is full.
   subroutine put_bytes(path, text, reason)
      character(*), intent(in) :: path, text
      character(:), allocatable, intent(out) :: reason       !! '' when every byte is out
      type(c_ptr) :: stream
      integer(c_size_t) :: length

      reason = ''
      stream = c_fopen(path//c_null_char, 'wb'//c_null_char)
      if (.not. c_associated(stream)) then
         reason = system_reason()
         return
      end if
      length = len(text, c_size_t)
      if (c_fwrite(text, 1_c_size_t, length, stream) /= length) reason = system_reason()
      if (c_fclose(stream) /= 0 .and. len(reason) == 0) reason = system_reason()
   end subroutine put_bytes

   !> The whole content of a file, byte for byte.
   subroutine read_whole(path, text, error)
      character(*), intent(in) :: path
      character(:), allocatable, intent(out) :: text         !! '' when the file is empty or unreadable
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with path and reason
      character(200) :: reason
      integer(i8) :: size
      integer :: unit, status, ignored

      text = ''
      if (folder_exists(path)) then
         call fail(error, exit_file, "cannot read '"//path//"': it is a folder")
         return
      end if
      open (newunit=unit, file=path, access='stream', form='unformatted', action='read', &
         status='old', iostat=status, iomsg=reason)
      if (status == 0) then
         inquire (unit=unit, size=size)
         if (size > huge(1)) then         ! its letters are counted in default integers
            status = 1
            reason = 'it is larger than 2 GB'
         else if (size > 0) then
            deallocate (text)
            allocate (character(size) :: text)
            read (unit, iostat=status, iomsg=reason) text
         else
            call read_stream(unit, text)
            if (len(text) == most_streamed) then
               status = 1
               reason = 'it does not end within 1 GB'
            end if
         end if
         close (unit, iostat=ignored)
      end if
      if (status /= 0) then
         text = ''
         call fail(error, exit_file, "cannot read '"//path//"': "//short_reason(reason))
      end if
   end subroutine read_whole

   !> What a pipe delivers, which has no size beforehand; not more than `most_streamed`.
   subroutine read_stream(unit, text)
      integer, intent(in) :: unit
      character(:), allocatable, intent(inout) :: text
      character(:), allocatable :: grown
      character(1) :: letter
      integer :: status, used

      used = 0
      do
         read (unit, iostat=status) letter
         if (status /= 0 .or. used == most_streamed) exit
         if (used == len(text)) then
            allocate (character(min(max(4096, 2*used), most_streamed)) :: grown)
            grown(:used) = text
            call move_alloc(grown, text)
         end if
         used = used + 1
         text(used:used) = letter
      end do
      text = text(:used)
   end subroutine read_stream

   !> Make a folder and those above it; one that is there already is fine.
   subroutine make_folder(path, error)
      character(*), intent(in) :: path
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with path and reason
      character(:), allocatable :: reason
      integer :: k, ignored

      reason = 'no name given'
      do k = 1, len(path)
         if (k < len(path)) then
            if (path(k + 1:k + 1) /= '/' .or. path(k:k) == '/') cycle
         end if
         if (folder_exists(path(:k))) cycle
         ignored = c_mkdir(path(:k)//c_null_char, all_may)
         if (ignored /= 0) reason = system_reason()
         if (.not. folder_exists(path(:k))) exit
      end do
      if (.not. folder_exists(path)) then
         call fail(error, exit_file, "cannot make the folder '"//path//"': "//reason)
      end if
   end subroutine make_folder

   !> Remove a file; that it was not there is no error.
   subroutine remove_file(path)
      character(*), intent(in) :: path
      integer :: ignored

      ignored = c_remove(path//c_null_char)
   end subroutine remove_file

   !> Is there a file or folder of this name?
   logical function file_exists(path)
      character(*), intent(in) :: path
      file_exists = c_access(path//c_null_char, may_exist) == 0
   end function file_exists

   !> Is this name a folder?
   logical function folder_exists(path)
      character(*), intent(in) :: path

      folder_exists = .false.
      if (len(path) > 0) folder_exists = c_access(path//'/.'//c_null_char, may_exist) == 0
   end function folder_exists

   !> Can a program of this name be started: is it in PATH, or, given with a slash, there?
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

   !> Whether a path is a file that may be run.
   logical function is_program(path)
      character(*), intent(in) :: path

      is_program = .not. folder_exists(path)
      if (is_program) is_program = c_access(path//c_null_char, may_execute) == 0
   end function is_program

   !> Does a person read this: is standard output (1) or standard error (2) a terminal?
   logical function is_terminal(descriptor)
      integer, intent(in) :: descriptor
      is_terminal = c_isatty(int(descriptor, c_int)) == 1
   end function is_terminal

   !> folder/name; a name that starts with a slash stands for itself.
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

   !> 'a/b' of 'a/b/c.nml', '.' of 'c.nml', '/' of '/c.nml'.
   pure function folder_name(path) result(folder)
      character(*), intent(in) :: path
      character(:), allocatable :: folder
      integer :: slash

      slash = index(path, '/', back=.true.)
      if (slash == 0) then
         folder = '.'
      else
         folder = path(:max(1, slash - 1))
      end if
   end function folder_name

   !> The name without folder and extension: 'c' of 'a/b/c.nml', 'c.x' of 'c.x.nml', '.rc' of 'a/.rc'.
   pure function base_name(path) result(name)
      character(*), intent(in) :: path
      character(:), allocatable :: name
      integer :: dot

      name = path(index(path, '/', back=.true.) + 1:)
      dot = index(name, '.', back=.true.)
      if (dot > 1) name = name(:dot - 1)
   end function base_name

   !> Why the last call of the C library failed, in its own words.
   function system_reason() result(reason)
      character(:), allocatable :: reason
      integer(c_int), pointer :: number
      character(kind=c_char), pointer :: letters(:)
      type(c_ptr) :: text
      integer :: k

      call c_f_pointer(c_errno(), number)
      text = c_strerror(number)
      reason = 'unknown reason'
      if (.not. c_associated(text)) return
      call c_f_pointer(text, letters, [c_strlen(text)])
      reason = repeat(' ', size(letters))
      do k = 1, size(letters)
         reason(k:k) = letters(k)
      end do
   end function system_reason

   !> The last part of gfortran's "Cannot open file 'x': No such file or directory".
   pure function short_reason(message) result(reason)
      character(*), intent(in) :: message
      character(:), allocatable :: reason

      reason = trim(message(index(message, ': ', back=.true.) + 1:))
      reason = trim(adjustl(reason))
   end function short_reason

end module ek_file
