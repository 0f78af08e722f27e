!> A file to which several processes append whole lines at the same time, on one machine or on several.
!>
!> Each string is added by one write to a file opened for appending, so that on a local disk two strings never mix. Network file
!> systems guarantee this only under a lock. The first write takes the lock, which is held until the file is closed. If the lock is
!> not free within 5 s, the string is written without it.
module ek_append_file
   use, intrinsic :: iso_c_binding, only: c_associated, c_int, c_long, c_null_char, c_null_ptr, c_ptr
   use ek_error, only: error_t, fail, exit_file
   use ek_posix, only: c_open, c_close, c_fopen, c_fclose, c_fileno, c_poll
   use ek_system, only: facts_t, facts_of, regular_file, other_file, folder_exists, try_lock, write_bytes, system_reason
   implicit none(type, external)
   private
   public :: append_file_t, open_append_file

   integer, parameter :: attempts = 500   !! attempts to get the lock, 10 ms each: a stopped process must not stop others

   type :: append_file_t
      private
      character(:), allocatable :: path
      type(c_ptr) :: stream = c_null_ptr
   contains
      procedure :: is_open, add => append_text, close => close_file
   end type append_file_t

contains

   !> Opens a file for appending. A file that does not exist is created empty. A file that is not empty and does not begin with
   !> `first` is rejected, because it is probably a deck or a table that was named by mistake.
   subroutine open_append_file(path, first, file, error)
      character(*), intent(in) :: path
      character(1), intent(in) :: first                      !! character with which every string begins
      type(append_file_t), intent(out) :: file
      type(error_t), allocatable, intent(out) :: error       !! exit_file
      type(facts_t) :: facts
      character(1) :: byte
      integer(c_int), parameter :: write_at_once = 2049      ! O_WRONLY and O_NONBLOCK of open(2)
      integer(c_int) :: descriptor
      integer :: unit, status, ignored

      descriptor = -1
      facts = facts_of(path, follow=.true.)
      if (facts%kind == regular_file) then
         byte = first
         open (newunit=unit, file=path, access='stream', form='unformatted', action='read', status='old', iostat=status)
         if (status == 0) then
            read (unit, iostat=status) byte                  ! an empty file leaves it as it is
            close (unit, iostat=ignored)
         end if
         if (byte /= first) then
            call fail(error, exit_file, "cannot append to '"//path//"': it has other contents, its first character is not "//first)
            return
         end if
      end if
      if (folder_exists(path)) then
         call fail(error, exit_file, "cannot append to '"//path//"': it is a folder")
         return
      end if
      if (facts%kind == other_file) then                     ! fopen would wait for a reader
         descriptor = c_open(path//c_null_char, write_at_once)
         if (descriptor < 0) then
            call fail(error, exit_file, "cannot append to '"//path//"': it is a pipe from which no program reads")
            return
         end if
      end if
      file%stream = c_fopen(path//c_null_char, 'a'//c_null_char)
      if (.not. c_associated(file%stream)) call fail(error, exit_file, "cannot append to '"//path//"': "//system_reason())
      file%path = path
      if (descriptor >= 0) ignored = c_close(descriptor)
   end subroutine open_append_file

   logical function is_open(self)
      class(append_file_t), intent(in) :: self
      is_open = c_associated(self%stream)
   end function is_open

   !> Appends a string by one write.
   subroutine append_text(self, text, error)
      class(append_file_t), intent(in) :: self
      character(*), intent(in) :: text                       !! whole lines
      type(error_t), allocatable, intent(out) :: error       !! exit_file
      integer(c_int) :: descriptor
      integer :: k, ignored

      descriptor = c_fileno(self%stream)
      do k = 1, attempts
         if (try_lock(descriptor)) exit                      ! ends when the file is closed
         ignored = c_poll(c_null_ptr, 0_c_long, 10_c_int)
      end do
      if (.not. write_bytes(descriptor, text)) &
         call fail(error, exit_file, "cannot append to '"//self%path//"': "//system_reason())
   end subroutine append_text

   subroutine close_file(self)
      class(append_file_t), intent(inout) :: self
      integer :: ignored

      if (c_associated(self%stream)) ignored = c_fclose(self%stream)
      self%stream = c_null_ptr
   end subroutine close_file

end module ek_append_file
