!> Base64 encoding of bytes and of lists of numbers.
module ek_base64
   use, intrinsic :: iso_fortran_env, only: int32, real32
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: base64, base64_of_numbers

contains

   !> Bytes in Base64 encoding (RFC 4648).
   pure function base64(bytes) result(text)
      character(*), intent(in) :: bytes
      character(:), allocatable :: text
      character(*), parameter :: letters = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/'
      integer :: k, l, three, at

      text = repeat('=', 4*((len(bytes) + 2)/3))
      at = 0
      do k = 1, len(bytes), 3
         three = 0
         do l = k, k + 2
            three = 256*three
            if (l <= len(bytes)) three = three + iachar(bytes(l:l))
         end do
         do l = 1, min(4, len(bytes) - k + 2)
            text(at + l:at + l) = letters(ibits(three, 24 - 6*l, 6) + 1:ibits(three, 24 - 6*l, 6) + 1)
         end do
         at = at + 4
      end do
   end function base64

   !> Numbers with about 7 digits (IEEE 754 of 32 bits, lowest byte first) in Base64 encoding.
   pure function base64_of_numbers(values) result(text)
      real(wp), intent(in) :: values(:)
      character(:), allocatable :: text
      character(4*size(values)) :: bytes
      integer(int32) :: bits
      integer :: k, b

      do k = 1, size(values)
         bits = transfer(real(values(k), real32), bits)
         do b = 0, 3
            bytes(4*k - 3 + b:4*k - 3 + b) = char(ibits(bits, 8*b, 8))
         end do
      end do
      text = base64(bytes)
   end function base64_of_numbers

end module ek_base64
