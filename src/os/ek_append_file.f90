!> A file to which several processes append whole lines at the same time, on one machine or on several.
!>
!> Each string is added by one write to a file opened for appending, so that on a local disk two strings never mix. Network file
!> systems guarantee this only under a lock. The first write takes the lock, which is held until the file is closed. If the lock is
!> not free within 5 s, the string is written without it.
module ek_append_file
   use, intrinsic :: iso_c_binding, only: c_int32_t, c_null_char
   use ek_error, only: error_t, fail, exit_file
   use ek_system_call, only: c_open, c_close, c_lock, c_sleep, to_append, to_try_pipe, done
   use ek_system, only: facts_t, facts_of, regular_file, other_file, folder_exists, write_bytes, system_reason
   implicit none(type, external)
   private
   public :: append_file_t, open_append_file

   integer, parameter :: attempts = 500   !! attempts to get the lock, 10 ms each: a stopped process must not stop others

   type :: append_file_t
      private
      character(:), allocatable :: path
      integer(c_int32_t) :: file = -1       !! descriptor; −1: not open
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
      integer(c_int32_t) :: pipe
      integer :: unit, status, ignored

      pipe = -1
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
      if (facts%kind == other_file) then                     ! to open it for appending would wait for a reader
         pipe = c_open(path//c_null_char, to_try_pipe)
         if (pipe < 0) then
            call fail(error, exit_file, "cannot append to '"//path//"': it is a pipe from which no program reads")
            return
         end if
      end if
      file%file = c_open(path//c_null_char, to_append)
      if (file%file < 0) call fail(error, exit_file, "cannot append to '"//path//"': "//system_reason())
      file%path = path
      if (pipe >= 0) ignored = c_close(pipe)
   end subroutine open_append_file

   logical function is_open(self)
      class(append_file_t), intent(in) :: self
      is_open = self%file >= 0
   end function is_open

   !> Appends a string by one write.
   subroutine append_text(self, text, error)
      class(append_file_t), intent(in) :: self
      character(*), intent(in) :: text                       !! whole lines
      type(error_t), allocatable, intent(out) :: error       !! exit_file
      integer :: k, outcome

      do k = 1, attempts
         if (c_lock(self%file) == done) exit                 ! ends when the file is closed
         call c_sleep(10_c_int32_t)
      end do
      call write_bytes(self%file, text, outcome)
      if (outcome /= done) call fail(error, exit_file, "cannot append to '"//self%path//"': "//system_reason())
   end subroutine append_text

   subroutine close_file(self)
      class(append_file_t), intent(inout) :: self
      integer :: ignored

      if (self%file >= 0) ignored = c_close(self%file)
      self%file = -1
   end subroutine close_file

end module ek_append_file
