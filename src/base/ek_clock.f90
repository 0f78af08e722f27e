!> Wall-clock time for reports and benchmarks, and the date stamp of output files.
module ek_clock
   use ek_kinds, only: wp, i8
   implicit none(type, external)
   private
   public :: seconds, seconds_since_1970, date_words

contains

   !> Seconds of a monotonic clock; its zero is arbitrary, so only differences are meaningful.
   !> Resolution 1 ns with gfortran on Linux.
   real(wp) function seconds()
      integer(i8) :: ticks, rate

      call system_clock(ticks, rate)
      seconds = real(ticks, wp)/real(rate, wp)
   end function seconds

   !> Seconds since 1970-01-01 00:00 UTC, from the system clock.
   integer(i8) function seconds_since_1970() result(passed)
      integer :: now(8), year, month

      call date_and_time(values=now)
      year = now(1)
      month = now(2)
      if (month < 3) then                       ! the year starts in March, so that the leap day is its last day
         year = year - 1
         month = month + 12
      end if
      passed = 365_i8*year + year/4 - year/100 + year/400 + (153*(month - 3) + 2)/5 + now(3) - 1 - 719468
      passed = 60*(60*(24*passed + now(5)) + now(6) - now(4)) + now(7)
   end function seconds_since_1970

   !> '2026-01-31 17:05': the local time now; if the environment variable SOURCE_DATE_EPOCH is set, that time in UTC, so that
   !> the same input gives the same bytes (https://reproducible-builds.org/specs/source-date-epoch/).
   function date_words() result(words)
      character(16) :: words
      integer(i8) :: epoch, days, left
      integer :: now(8), century, year, month, day
      logical :: is_set

      call read_set_date(epoch, is_set)
      if (is_set) then
         ! days from 0000-03-01, in eras of 400 years: https://howardhinnant.github.io/date_algorithms.html
         days = epoch/86400 + 719468
         left = modulo(days, 146097_i8)
         century = int(days/146097)
         year = int((left - left/1460 + left/36524 - left/146096)/365)
         day = int(left - (365_i8*year + year/4 - year/100))
         month = (5*day + 2)/153
         day = day - (153*month + 2)/5 + 1
         month = merge(month + 3, month - 9, month < 10)
         year = year + 400*century + merge(1, 0, month < 3)
         now = 0
         now(1:3) = [year, month, day]
         now(5) = int(modulo(epoch, 86400_i8)/3600)
         now(6) = int(modulo(epoch, 3600_i8)/60)
      else
         call date_and_time(values=now)
      end if
      write (words, '(i4.4,a,i2.2,a,i2.2,a,i2.2,a,i2.2)') now(1), '-', now(2), '-', now(3), ' ', now(5), ':', now(6)
   end function date_words

   !> Reads SOURCE_DATE_EPOCH if it is a whole number of seconds within the years 1970 to 9999.
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
