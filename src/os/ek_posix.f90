!> Interfaces to the functions of the C library that this program needs and Fortran does not offer.
!>
!> Only POSIX functions without variable argument lists are used (`open` without its third argument), and no structure is accessed
!> except the four addresses of Dl_info. The layout of other structures and processor-dependent constants are therefore not needed.
!> `__errno_location` is the name of errno in glibc and musl. `flock` is not in POSIX, but in every Linux and BSD. Users of this
!> module are ek_system, ek_writer, ek_process, ek_file, ek_append_file, ek_loaded_library, ek_interrupt, ek_clock,
!> ek_drawing, and the main program of elastokin-netcdf.
module ek_posix
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_long, c_funptr, c_ptr, c_size_t
   implicit none(type, external)
   private
   public :: c_fopen, c_open, c_read, c_write, c_fileno, c_fsync, c_fclose, c_rename, c_remove, c_mkdir, c_rmdir
   public :: c_access, c_isatty, c_opendir, c_readdir, c_dirfd, c_closedir, c_symlink, c_flock, c_dup, c_dup2, &
      c_close
   public :: c_fork, c_execvp, c_exit_now, c_chdir, c_setpgid, c_alarm, c_kill, c_waitpid, c_poll, c_getcwd_raw, c_readlink
   public :: c_raise
   public :: c_signal, c_gethostname, c_errno, c_strerror, c_strlen, c_dlsym, c_dladdr, c_time, c_gmtime, c_localtime, c_strftime

   ! Only procedures without `value` arguments: gfortran 12 passes these by reference from the second call on
   abstract interface
      integer(c_int) function of_path(path) bind(c)
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function of_path
      integer(c_int) function of_paths(from, to) bind(c)
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: from(*), to(*)
      end function of_paths
      type(c_ptr) function of_time(time, fields) bind(c)
         import :: c_long, c_ptr
         integer(c_long), intent(in) :: time          ! s since 1970
         integer(c_long), intent(out) :: fields(*)    ! struct tm
      end function of_time
   end interface

   procedure(of_path), bind(c, name='remove') :: c_remove
   procedure(of_path), bind(c, name='rmdir') :: c_rmdir
   procedure(of_path), bind(c, name='chdir') :: c_chdir
   procedure(of_paths), bind(c, name='rename') :: c_rename
   procedure(of_paths), bind(c, name='symlink') :: c_symlink
   procedure(of_time), bind(c, name='gmtime_r') :: c_gmtime
   procedure(of_time), bind(c, name='localtime_r') :: c_localtime

   interface
      type(c_ptr) function c_fopen(path, mode) bind(c, name='fopen')
         import :: c_ptr, c_char
         character(kind=c_char), intent(in) :: path(*), mode(*)
      end function c_fopen
      integer(c_int) function c_fileno(stream) bind(c, name='fileno')
         import :: c_int, c_ptr
         type(c_ptr), value :: stream
      end function c_fileno
      integer(c_int) function c_fclose(stream) bind(c, name='fclose')
         import :: c_int, c_ptr
         type(c_ptr), value :: stream
      end function c_fclose
      integer(c_size_t) function c_write(descriptor, bytes, count) bind(c, name='write')
         import :: c_int, c_char, c_size_t
         integer(c_int), value :: descriptor
         character(kind=c_char), intent(in) :: bytes(*)
         integer(c_size_t), value :: count
      end function c_write
      integer(c_int) function c_open(path, flags) bind(c, name='open')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: flags
      end function c_open
      integer(c_size_t) function c_read(descriptor, bytes, count) bind(c, name='read')
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: descriptor
         character(kind=c_char), intent(inout) :: bytes(*)
         integer(c_size_t), value :: count
      end function c_read
      integer(c_int) function c_fsync(descriptor) bind(c, name='fsync')
         import :: c_int
         integer(c_int), value :: descriptor
      end function c_fsync
      integer(c_int) function c_isatty(descriptor) bind(c, name='isatty')
         import :: c_int
         integer(c_int), value :: descriptor
      end function c_isatty
      integer(c_int) function c_close(descriptor) bind(c, name='close')
         import :: c_int
         integer(c_int), value :: descriptor
      end function c_close
      integer(c_int) function c_dup(descriptor) bind(c, name='dup')
         import :: c_int
         integer(c_int), value :: descriptor
      end function c_dup
      integer(c_int) function c_dup2(from, to) bind(c, name='dup2')
         import :: c_int
         integer(c_int), value :: from, to
      end function c_dup2
      integer(c_int) function c_flock(descriptor, operation) bind(c, name='flock')
         import :: c_int
         integer(c_int), value :: descriptor, operation
      end function c_flock
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
      type(c_ptr) function c_opendir(path) bind(c, name='opendir')
         import :: c_ptr, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function c_opendir
      type(c_ptr) function c_readdir(folder) bind(c, name='readdir')
         import :: c_ptr
         type(c_ptr), value :: folder
      end function c_readdir
      integer(c_int) function c_dirfd(folder) bind(c, name='dirfd')
         import :: c_int, c_ptr
         type(c_ptr), value :: folder
      end function c_dirfd
      integer(c_int) function c_closedir(folder) bind(c, name='closedir')
         import :: c_int, c_ptr
         type(c_ptr), value :: folder
      end function c_closedir
      integer(c_int) function c_fork() bind(c, name='fork')
         import :: c_int
      end function c_fork
      integer(c_int) function c_execvp(file, words) bind(c, name='execvp')
         import :: c_int, c_char, c_ptr
         character(kind=c_char), intent(in) :: file(*)
         type(c_ptr), intent(in) :: words(*)
      end function c_execvp
      subroutine c_exit_now(status) bind(c, name='_exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_exit_now
      type(c_ptr) function c_getcwd_raw(letters, size) bind(c, name='getcwd')
         import :: c_ptr, c_char, c_size_t
         character(kind=c_char), intent(inout) :: letters(*)
         integer(c_size_t), value :: size
      end function c_getcwd_raw
      integer(c_size_t) function c_readlink(path, letters, size) bind(c, name='readlink')
         import :: c_char, c_size_t
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(inout) :: letters(*)
         integer(c_size_t), value :: size
      end function c_readlink
      integer(c_int) function c_setpgid(process, group) bind(c, name='setpgid')
         import :: c_int
         integer(c_int), value :: process, group
      end function c_setpgid
      integer(c_int) function c_alarm(seconds) bind(c, name='alarm')
         import :: c_int
         integer(c_int), value :: seconds
      end function c_alarm
      integer(c_int) function c_kill(process, number) bind(c, name='kill')
         import :: c_int
         integer(c_int), value :: process, number
      end function c_kill
      integer(c_int) function c_waitpid(process, status, options) bind(c, name='waitpid')
         import :: c_int
         integer(c_int), value :: process, options
         integer(c_int), intent(inout) :: status
      end function c_waitpid
      integer(c_int) function c_poll(list, count, milliseconds) bind(c, name='poll')
         import :: c_int, c_long, c_ptr
         type(c_ptr), value :: list
         integer(c_long), value :: count
         integer(c_int), value :: milliseconds
      end function c_poll
      integer(c_int) function c_raise(number) bind(c, name='raise')
         import :: c_int
         integer(c_int), value :: number
      end function c_raise
      type(c_funptr) function c_signal(number, action) bind(c, name='signal')
         import :: c_funptr, c_int
         integer(c_int), value :: number
         type(c_funptr), value :: action
      end function c_signal
      integer(c_int) function c_gethostname(letters, size) bind(c, name='gethostname')
         import :: c_int, c_char, c_size_t
         character(kind=c_char), intent(inout) :: letters(*)
         integer(c_size_t), value :: size
      end function c_gethostname
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
      type(c_funptr) function c_dlsym(handle, name) bind(c, name='dlsym')
         import :: c_char, c_funptr, c_ptr
         type(c_ptr), value :: handle
         character(kind=c_char), intent(in) :: name(*)
      end function c_dlsym
      integer(c_int) function c_dladdr(address, facts) bind(c, name='dladdr')      ! POSIX since 2024
         import :: c_int, c_funptr, c_ptr
         type(c_funptr), value :: address
         type(c_ptr), intent(out) :: facts(4)         ! Dl_info: four addresses on every system
      end function c_dladdr
      integer(c_long) function c_time(place) bind(c, name='time')
         import :: c_long, c_ptr
         type(c_ptr), value :: place
      end function c_time
      integer(c_size_t) function c_strftime(text, size, form, fields) bind(c, name='strftime')
         import :: c_char, c_long, c_size_t
         character(kind=c_char), intent(out) :: text(*)
         integer(c_size_t), value :: size
         character(kind=c_char), intent(in) :: form(*)
         integer(c_long), intent(in) :: fields(*)     ! struct tm
      end function c_strftime
   end interface

end module ek_posix
