!> Checksum of bytes: FNV-1a, 64 bits (Fowler, Noll, Vo).
module ek_checksum
   use ek_kinds, only: i8
   implicit none(type, external)
   private
   public :: checksum_t, include, digits_of

   !> The hash in two halves of 32 bits, to avoid overflow.
   type :: checksum_t
      private
      integer(i8) :: high = int(z'cbf29ce4', i8), low = int(z'84222325', i8)
   end type checksum_t

contains

   !> Includes the bytes of a string, each by hash ← (hash xor byte) × (2^40 + 0x1b3).
   pure subroutine include(self, text)
      type(checksum_t), intent(inout) :: self
      character(*), intent(in) :: text
      integer(i8), parameter :: mask = int(z'ffffffff', i8), multiplier = int(z'1b3', i8)
      integer(i8) :: product, high, low
      integer :: c

      high = self%high
      low = self%low
      do c = 1, len(text)
         low = ieor(low, int(ichar(text(c:c)), i8))
         product = low*multiplier
         high = iand(high*multiplier + ishft(product, -32) + ishft(iand(low, int(z'ffffff', i8)), 8), mask)
         low = iand(product, mask)
      end do
      self%high = high
      self%low = low
   end subroutine include

   !> The checksum as 16 hexadecimal digits.
   function digits_of(self) result(digits)
      type(checksum_t), intent(in) :: self
      character(16) :: digits

      write (digits, '(2z8.8)') self%high, self%low
   end function digits_of

end module ek_checksum
