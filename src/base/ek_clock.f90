!> Wall-clock time for reports and benchmarks.
module ek_clock
   use ek_kinds, only: wp, i8
   implicit none(type, external)
   private
   public :: seconds

contains

   !> Seconds on a clock that only goes forward; the zero is arbitrary, so only differences mean anything.
   !> Resolution 1 ns with gfortran on Linux.
   real(wp) function seconds()
      integer(i8) :: ticks, rate

      call system_clock(ticks, rate)
      seconds = real(ticks, wp)/real(rate, wp)
   end function seconds

end module ek_clock
