!> Number kinds used everywhere.
module ek_kinds
   use, intrinsic :: iso_fortran_env, only: real64, int64
   implicit none(type, external)
   private
   public :: wp, i8

   integer, parameter :: wp = real64   !! working precision: IEEE double
   integer, parameter :: i8 = int64    !! counters and clocks
end module ek_kinds
