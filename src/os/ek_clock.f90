!> Wall-clock time for reports, and the date stamp of output files.
module ek_clock
   use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_null_char
   use ek_kinds, only: wp, i8
   use ek_error, only: error_t, fail, exit_usage
   use ek_system_call, only: c_time, c_date, text_of
   implicit none(type, external)
   private
   public :: seconds, seconds_since_1970, date_text, universal_time, check_set_date

contains

   !> Seconds of a monotonic clock. The zero of the clock is arbitrary, so that only differences are meaningful. The resolution is 1
   !> ns with gfortran on Linux.
   real(wp) function seconds()
      integer(i8) :: ticks, rate

      call system_clock(ticks, rate)
      seconds = real(ticks, wp)/real(rate, wp)
   end function seconds

   !> Seconds since 1970-01-01 00:00 UTC, from the system clock.
   integer(i8) function seconds_since_1970()
      seconds_since_1970 = c_time()
   end function seconds_since_1970

   !> The local time now with its distance from UTC: '2026-01-31 17:05 +0100'. If the environment variable SOURCE_DATE_EPOCH gives a
   !> time, the result is this time in UTC ('2026-01-31 16:05 UTC'), so that equal input gives equal bytes (https://reproducible-builds.org/specs/source-date-epoch/).
   function date_text() result(words)
      character(:), allocatable :: words
      integer(i8) :: epoch
      logical :: is_set

      call read_set_date(epoch, is_set)
      if (.not. is_set) epoch = c_time()
      words = date_of(epoch, .not. is_set, '%Y-%m-%d %H:%M %z')
      if (is_set) words = words(:16)//' UTC'
   end function date_text

   !> The time now in UTC as '2026-01-31T16:05:09Z' (ISO 8601), to compare records of several machines.
   function universal_time() result(words)
      character(20) :: words
      words = date_of(seconds_since_1970(), .false., '%Y-%m-%dT%H:%M:%SZ')
   end function universal_time

   !> A moment, in seconds since 1970, as local time or UTC in a form of strftime.
   function date_of(moment, is_local, form) result(words)
      integer(i8), intent(in) :: moment
      logical, intent(in) :: is_local
      character(*), intent(in) :: form
      character(:), allocatable :: words
      character(kind=c_char) :: letters(32)
      integer :: length

      length = c_date(moment, merge(1_c_int32_t, 0_c_int32_t, is_local), form//c_null_char, letters, size(letters, kind=c_int32_t))
      words = text_of(letters, length)
   end function date_of

   !> Checks that SOURCE_DATE_EPOCH is not set or is a date. With another text, files would contain the current date without a
   !> message.
   subroutine check_set_date(error)
      type(error_t), allocatable, intent(out) :: error     !! exit_usage
      character(64) :: text
      integer(i8) :: epoch
      integer :: status
      logical :: is_set

      call get_environment_variable('SOURCE_DATE_EPOCH', value=text, status=status)
      if ((status /= 0 .and. status /= -1) .or. text == '') return         ! not set; −1: longer than 64 characters
      call read_set_date(epoch, is_set)
      if (.not. is_set) call fail(error, exit_usage, 'SOURCE_DATE_EPOCH: expected an integer number of seconds since 1970, '// &
         'at most 253402300799, found '''//trim(text)//'''')
   end subroutine check_set_date

   !> Reads SOURCE_DATE_EPOCH. `is_set` is .true. only if the value is an integer number of seconds within the years 1970 to 9999.
   subroutine read_set_date(epoch, is_set)
      integer(i8), intent(out) :: epoch
      logical, intent(out) :: is_set
      character(20) :: text
      integer :: status

      epoch = 0
      call get_environment_variable('SOURCE_DATE_EPOCH', value=text, status=status)
      is_set = status == 0 .and. len_trim(text) > 0 .and. len_trim(text) <= 12 .and. verify(trim(text), '0123456789') == 0
      if (is_set) read (text, *, iostat=status) epoch
      is_set = is_set .and. status == 0 .and. epoch < 253402300800_i8
   end subroutine read_set_date

end module ek_clock
