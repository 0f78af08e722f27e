!> A random permutation of 0 … n − 1 that is computed, not stored: the image of one number takes some 50 ns regardless of n.
!>
!> The numbers are written as pairs (l, r), i = l b + r, with l below a = ⌈√n⌉ and r below b = ⌈n/a⌉. Every round adds a keyed
!> hash of one half to the other half, modulo the size of the other half, and can therefore be undone. A result of n or more (there
!> are fewer than √n such results) is permuted again. Source: J. Black, P. Rogaway, Ciphers with arbitrary finite domains, CT-RSA
!> 2002, sections 3 and 5.
module ek_permutation
   use ek_kinds, only: wp, i8
   use ek_philox, only: fill_words
   implicit none(type, external)
   private
   public :: permutation_t, new_permutation, image_of, largest_permutation

   integer, parameter :: rounds = 6
   integer(i8), parameter :: low_word = int(z'FFFFFFFF', i8)
   integer(i8), parameter :: largest_permutation = 2_i8**40    !! largest n: a half fits a word, and √n is exact

   type :: permutation_t
      private
      integer(i8) :: n = 1, a = 1, b = 1
      integer(i8) :: keys(rounds) = 0
   end type permutation_t

contains

   !> The permutation of n numbers that is defined by a seed, a stream and an index.
   pure function new_permutation(n, seed, stream, number) result(permutation)
      integer(i8), intent(in) :: n             !! 1 … largest_permutation
      integer(i8), intent(in) :: seed, number
      integer, intent(in) :: stream
      type(permutation_t) :: permutation

      permutation%n = n
      permutation%a = ceiling(sqrt(real(n, wp)), i8)
      permutation%b = (n + permutation%a - 1)/permutation%a
      call fill_words(seed, stream, number, permutation%keys)
   end function new_permutation

   !> The image of i, from 0 to n − 1.
   !>
   !> Equation (D.2) of docs/theory/sampling.md.
   pure integer(i8) function image_of(permutation, i) result(image)
      type(permutation_t), intent(in) :: permutation
      integer(i8), intent(in) :: i             !! 0 … n − 1
      integer(i8) :: left, right
      integer :: k

      image = i
      do
         left = image/permutation%b
         right = image - left*permutation%b
         do k = 1, rounds, 2
            left = left + below(permutation%a, right, permutation%keys(k))
            if (left >= permutation%a) left = left - permutation%a
            right = right + below(permutation%b, left, permutation%keys(k + 1))
            if (right >= permutation%b) right = right - permutation%b
         end do
         image = left*permutation%b + right
         if (image < permutation%n) return
      end do
   end function image_of

   !> A number from 0 to n − 1, mixed from a number and a key: n w / 2³² with a word w. With multipliers below 2³¹, all products are
   !> within 63 bits. The multipliers and the shifts are from C. Wellons, Hash Prospector (public domain),
   !> https://github.com/skeeto/hash-prospector.
   pure integer(i8) function below(n, number, key)
      integer(i8), intent(in) :: n             !! up to 2³¹
      integer(i8), intent(in) :: number, key
      integer(i8) :: word

      word = iand(number + key, low_word)
      word = iand(ieor(word, shiftr(word, 15))*int(z'2C1B3C6D', i8), low_word)
      word = iand(ieor(word, shiftr(word, 12))*int(z'297A2D39', i8), low_word)
      word = ieor(word, shiftr(word, 15))
      below = shiftr(word*n, 32)
   end function below

end module ek_permutation
