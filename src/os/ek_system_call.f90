!> The functions of elastokin_system.c, which is the only file that depends on the system, and three of the C library.
!>
!> Strings end with c_null_char. `failed` and the numbers below it are failures; the reason is system_reason (ek_system).
module ek_system_call
   use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_int64_t, c_int
   implicit none(type, external)
   private
   public :: done, failed, already_there, try_again, broken_pipe
   public :: to_read, to_write, to_update, to_append, to_try_pipe, to_hold_folder, to_create
   public :: reason, host, working, program_path, has_ended, no_log, not_started, too_late, stopped
   public :: c_facts, c_open, c_read, c_write, c_sync, c_lock, c_is_folder, c_exists, c_can_start, c_make_folder, c_make_link
   public :: c_open_folder, c_next_name, c_close_folder, c_text, c_random, c_time, c_date, c_sleep
   public :: c_has_symbol, c_library_with, c_text_of, c_call, c_run, c_become
   public :: c_watch, c_is_asked, c_stop_signal, c_obey, c_prepare, c_close, c_isatty, c_remove, c_rmdir, c_rename, c_exit_now
   public :: text_of

   ! As in elastokin_system.c: results, purposes of c_open, texts of c_text, outcomes of c_run
   integer, parameter :: done = 0, failed = -1, already_there = -2, try_again = -3, broken_pipe = -4
   integer(c_int32_t), parameter :: to_read = 0, to_write = 1, to_update = 2, to_append = 3, to_try_pipe = 4, to_hold_folder = 5, &
      to_create = 6
   integer(c_int32_t), parameter :: reason = 0, host = 1, working = 2, program_path = 3
   integer, parameter :: has_ended = 0, no_log = 1, not_started = 2, too_late = 3, stopped = 4

   ! Only procedures without `value` arguments: gfortran 12 passes these by reference from the second call on
   abstract interface
      integer(c_int32_t) function of_path(path) bind(c)
         import :: c_int32_t, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function of_path
      integer(c_int32_t) function of_paths(from, to) bind(c)
         import :: c_int32_t, c_char
         character(kind=c_char), intent(in) :: from(*), to(*)
      end function of_paths
      integer(c_int32_t) function of_nothing() bind(c)
         import :: c_int32_t
      end function of_nothing
      subroutine without_arguments() bind(c)
      end subroutine without_arguments
   end interface

   procedure(of_path), bind(c, name='ek_os_is_folder') :: c_is_folder
   procedure(of_path), bind(c, name='ek_os_exists') :: c_exists
   procedure(of_path), bind(c, name='ek_os_can_start') :: c_can_start
   procedure(of_path), bind(c, name='ek_os_has_symbol') :: c_has_symbol
   procedure(of_path), bind(c, name='remove') :: c_remove
   procedure(of_path), bind(c, name='rmdir') :: c_rmdir
   procedure(of_paths), bind(c, name='rename') :: c_rename
   procedure(of_paths), bind(c, name='ek_os_make_link') :: c_make_link
   procedure(of_nothing), bind(c, name='ek_os_is_asked') :: c_is_asked
   procedure(of_nothing), bind(c, name='ek_os_stop_signal') :: c_stop_signal
   procedure(without_arguments), bind(c, name='ek_os_watch') :: c_watch
   procedure(without_arguments), bind(c, name='ek_os_obey') :: c_obey
   procedure(without_arguments), bind(c, name='ek_os_prepare') :: c_prepare

   interface
      integer(c_int32_t) function c_facts(path, follow, facts) bind(c, name='ek_os_facts')
         import :: c_char, c_int32_t, c_int64_t
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int32_t), value :: follow
         integer(c_int64_t), intent(out) :: facts(3)      ! inode, device, last change [s since 1970]
      end function c_facts
      integer(c_int32_t) function c_open(path, purpose) bind(c, name='ek_os_open')
         import :: c_char, c_int32_t
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int32_t), value :: purpose
      end function c_open
      integer(c_int32_t) function c_read(file, bytes, size) bind(c, name='ek_os_read')
         import :: c_char, c_int32_t
         integer(c_int32_t), value :: file, size
         character(kind=c_char), intent(inout) :: bytes(*)
      end function c_read
      integer(c_int32_t) function c_write(file, bytes, count) bind(c, name='ek_os_write')
         import :: c_char, c_int32_t, c_int64_t
         integer(c_int32_t), value :: file
         character(kind=c_char), intent(in) :: bytes(*)
         integer(c_int64_t), value :: count
      end function c_write
      integer(c_int32_t) function c_sync(file) bind(c, name='ek_os_sync')
         import :: c_int32_t
         integer(c_int32_t), value :: file
      end function c_sync
      integer(c_int32_t) function c_lock(file) bind(c, name='ek_os_lock')
         import :: c_int32_t
         integer(c_int32_t), value :: file
      end function c_lock
      integer(c_int) function c_close(file) bind(c, name='close')
         import :: c_int
         integer(c_int), value :: file
      end function c_close
      integer(c_int) function c_isatty(file) bind(c, name='isatty')
         import :: c_int
         integer(c_int), value :: file
      end function c_isatty
      integer(c_int32_t) function c_make_folder(path, is_private) bind(c, name='ek_os_make_folder')
         import :: c_char, c_int32_t
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int32_t), value :: is_private
      end function c_make_folder
      integer(c_int64_t) function c_open_folder(path) bind(c, name='ek_os_open_folder')
         import :: c_char, c_int64_t
         character(kind=c_char), intent(in) :: path(*)
      end function c_open_folder
      integer(c_int32_t) function c_next_name(folder, letters, size) bind(c, name='ek_os_next_name')
         import :: c_char, c_int32_t, c_int64_t
         integer(c_int64_t), value :: folder
         character(kind=c_char), intent(inout) :: letters(*)
         integer(c_int32_t), value :: size
      end function c_next_name
      subroutine c_close_folder(folder) bind(c, name='ek_os_close_folder')
         import :: c_int64_t
         integer(c_int64_t), value :: folder
      end subroutine c_close_folder
      integer(c_int32_t) function c_text(what, letters, size) bind(c, name='ek_os_text')
         import :: c_char, c_int32_t
         integer(c_int32_t), value :: what, size
         character(kind=c_char), intent(inout) :: letters(*)
      end function c_text
      integer(c_int32_t) function c_random(bytes, count) bind(c, name='ek_os_random')
         import :: c_char, c_int32_t
         character(kind=c_char), intent(inout) :: bytes(*)
         integer(c_int32_t), value :: count
      end function c_random
      integer(c_int64_t) function c_time() bind(c, name='ek_os_time')
         import :: c_int64_t
      end function c_time
      integer(c_int32_t) function c_date(seconds, is_local, form, letters, size) bind(c, name='ek_os_date')
         import :: c_char, c_int32_t, c_int64_t
         integer(c_int64_t), value :: seconds             ! since 1970
         integer(c_int32_t), value :: is_local, size
         character(kind=c_char), intent(in) :: form(*)
         character(kind=c_char), intent(inout) :: letters(*)
      end function c_date
      subroutine c_sleep(milliseconds) bind(c, name='ek_os_sleep')
         import :: c_int32_t
         integer(c_int32_t), value :: milliseconds
      end subroutine c_sleep
      integer(c_int32_t) function c_library_with(symbol, letters, size) bind(c, name='ek_os_library_with')
         import :: c_char, c_int32_t
         character(kind=c_char), intent(in) :: symbol(*)
         character(kind=c_char), intent(inout) :: letters(*)
         integer(c_int32_t), value :: size
      end function c_library_with
      integer(c_int32_t) function c_text_of(name, letters, size) bind(c, name='ek_os_text_of')
         import :: c_char, c_int32_t
         character(kind=c_char), intent(in) :: name(*)
         character(kind=c_char), intent(inout) :: letters(*)
         integer(c_int32_t), value :: size
      end function c_text_of
      subroutine c_call(name, argument) bind(c, name='ek_os_call')
         import :: c_char, c_int32_t
         character(kind=c_char), intent(in) :: name(*)
         integer(c_int32_t), value :: argument
      end subroutine c_call
      integer(c_int32_t) function c_run(arguments, count, folder, log, limit, status) bind(c, name='ek_os_run')
         import :: c_char, c_int32_t
         character(kind=c_char), intent(in) :: arguments(*), folder(*), log(*)
         integer(c_int32_t), value :: count, limit        ! limit: s
         integer(c_int32_t), intent(out) :: status
      end function c_run
      subroutine c_become(arguments, count) bind(c, name='ek_os_become')
         import :: c_char, c_int32_t
         character(kind=c_char), intent(in) :: arguments(*)
         integer(c_int32_t), value :: count
      end subroutine c_become
      subroutine c_exit_now(status) bind(c, name='_exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_exit_now
   end interface

contains

   !> The first `length` characters that a function has returned.
   pure function text_of(letters, length) result(text)
      character(kind=c_char), intent(in) :: letters(:)
      integer, intent(in) :: length
      character(:), allocatable :: text
      integer :: k

      allocate (character(length) :: text)
      do k = 1, length
         text(k:k) = letters(k)
      end do
   end function text_of

end module ek_system_call
