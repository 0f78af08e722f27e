!> Reads a pipe to its end. A pipe that no program has opened for writing within 10 s is rejected, and so is a pipe that gives more
!> than 100 MB.
module ek_stream
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_long, c_null_char, c_null_ptr, c_size_t
   use ek_kinds, only: wp
   use ek_buffer, only: buffer_t
   use ek_clock, only: seconds
   use ek_posix, only: c_open, c_read, c_close, c_poll
   use ek_system, only: error_number, system_reason, interrupted
   implicit none(type, external)
   private
   public :: read_stream, max_streamed

   integer, parameter :: max_streamed = 100000000        !! limit of the bytes read; the largest known deck has half a percent
   real(wp), parameter :: patience = 10.0_wp             !! time for a program to open the pipe for writing [s]
   integer(c_int), parameter :: no_wait = 2048           !! O_NONBLOCK of open(2); O_RDONLY is 0
   integer, parameter :: try_again = 11                  !! EAGAIN: a program has opened the pipe and has not written yet
   integer(c_int), parameter :: nap = 10                 !! time before the next read of an empty pipe [ms]

contains

   !> Reads the output of other programs from a pipe, until the last program closes the pipe.
   subroutine read_stream(path, text, reason)
      character(*), intent(in) :: path
      character(:), allocatable, intent(out) :: text
      character(:), allocatable, intent(out) :: reason       !! reason why the pipe cannot be read; '' if it was read
      type(buffer_t) :: bytes
      character(kind=c_char) :: chunk(65536)
      character(len=size(chunk)) :: letters
      integer(c_size_t) :: got
      integer(c_int) :: descriptor, ignored
      real(wp) :: start
      logical :: has_writer
      integer :: k

      text = ''
      reason = ''
      start = seconds()
      has_writer = .false.
      descriptor = c_open(path//c_null_char, no_wait)
      if (descriptor < 0) reason = system_reason()
      do while (reason == '')
         got = c_read(descriptor, chunk, size(chunk, kind=c_size_t))
         if (got > 0) then
            has_writer = .true.
            do k = 1, int(got)
               letters(k:k) = chunk(k)
            end do
            call bytes%add(letters(:int(got)))
            if (bytes%length() > max_streamed) reason = 'it is longer than 100 MB'
            cycle
         else if (got == 0) then
            if (has_writer) exit
            if (seconds() - start > patience) reason = 'it is a pipe into which no program writes'
         else if (error_number() == try_again) then
            has_writer = .true.
         else if (error_number() /= interrupted) then
            reason = system_reason()
         end if
         if (reason == '') ignored = c_poll(c_null_ptr, 0_c_long, nap)
      end do
      if (descriptor >= 0) ignored = c_close(descriptor)
      if (reason == '') text = bytes%text()
   end subroutine read_stream

end module ek_stream
