!> Random numbers by index: the generator Philox4x32-10, a function without any state.
!>
!> The same seed, stream, design and factor give the same number on every machine, in any order and with any number of workers.
!> Each use of one seed has its own stream: the designs, permutations, the scrambling of a sequence, trajectories.
!>
!> Source: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, Parallel random numbers: as easy as 1, 2, 3, Proc. SC11 (2011),
!> doi:10.1145/2063384.2063405. The 32-bit integers of the source are held in 64 bits, so that no operation overflows.
module ek_philox
   use ek_kinds, only: wp, i8
   implicit none(type, external)
   private
   public :: philox, uniform, fill_uniforms, fill_words

   integer(i8), parameter :: low_word = int(z'FFFFFFFF', i8)
   integer, parameter :: rounds = 10
   ! the multipliers and the increments of the key (golden ratio, √3 − 1), table 2 of the source and its section 3.3
   integer(i8), parameter :: multipliers(2) = [int(z'D2511F53', i8), int(z'CD9E8D57', i8)]
   integer(i8), parameter :: increments(2) = [int(z'9E3779B9', i8), int(z'BB67AE85', i8)]

contains

   !> Computes four random integers from a key of two and a counter of four integers, all from 0 to 2³² − 1.
   !>
   !> A round replaces (c₁, c₂, c₃, c₄) by (hi(m₂c₃) ⊕ c₂ ⊕ k₁, lo(m₂c₃), hi(m₁c₁) ⊕ c₄ ⊕ k₂, lo(m₁c₁)), where hi and lo are the
   !> upper and lower 32 bits of a product. There are ten rounds; after each round, the key grows by the increments (section 3.3 of
   !> the source).
   pure subroutine philox(key, counter, words)
      integer(i8), intent(in) :: key(2), counter(4)
      integer(i8), intent(out) :: words(4)
      integer(i8) :: k(2), high(2), low(2)
      integer :: round

      words = counter
      k = key
      do round = 1, rounds
         call product_of_words(multipliers(1), words(1), high(1), low(1))
         call product_of_words(multipliers(2), words(3), high(2), low(2))
         words(1) = ieor(ieor(high(2), words(2)), k(1))
         words(3) = ieor(ieor(high(1), words(4)), k(2))
         words(2) = low(2)
         words(4) = low(1)
         k(1) = iand(k(1) + increments(1), low_word)
         k(2) = iand(k(2) + increments(2), low_word)
      end do
   end subroutine philox

   !> Computes the upper and lower 32 bits of a product. b is split into halves, because 64 bits with a sign cannot hold the
   !> product: a b = (a b₁) 2¹⁶ + a b₀, with both products below 2⁴⁸.
   pure subroutine product_of_words(a, b, high, low)
      integer(i8), intent(in) :: a, b
      integer(i8), intent(out) :: high, low
      integer(i8) :: first, second

      first = a*iand(b, 65535_i8)
      second = a*shiftr(b, 16) + shiftr(first, 16)
      high = shiftr(second, 16)
      low = ior(shiftl(iand(second, 65535_i8), 16), iand(first, 65535_i8))
   end subroutine product_of_words

   !> Computes the random integers of one counter: block m = 1, 2, … of a design, which contains the numbers of the factors
   !> 2m − 1 and 2m.
   pure subroutine words_of(seed, stream, design, block, words)
      integer(i8), intent(in) :: seed, design
      integer, intent(in) :: stream, block
      integer(i8), intent(out) :: words(4)
      integer(i8) :: key(2), counter(4)

      key(1) = iand(seed, low_word)
      key(2) = shiftr(seed, 32)
      counter(1) = iand(design, low_word)
      counter(2) = shiftr(design, 32)
      counter(3) = block
      counter(4) = stream
      call philox(key, counter, words)
   end subroutine words_of

   !> A multiple of 2⁻⁵³ in (0, 1) from two random integers; 2⁻⁵⁴ replaces 0. The conversion is exact, and thus equal on every
   !> machine.
   !>
   !> Equation (D.1) of docs/theory/sampling.md.
   pure real(wp) function fraction_of(first, second) result(u)
      integer(i8), intent(in) :: first, second
      real(wp), parameter :: step = 2.0_wp**(-53)

      u = max(real(ior(shiftl(first, 21), shiftr(second, 11)), wp), 0.5_wp)*step
   end function fraction_of

   !> A random number, uniform in (0, 1) with 53 bits.
   pure real(wp) function uniform(seed, stream, design, factor) result(u)
      integer(i8), intent(in) :: seed      !! any number
      integer, intent(in) :: stream        !! from 0
      integer(i8), intent(in) :: design    !! any number
      integer, intent(in) :: factor        !! from 1
      integer(i8) :: words(4)

      call words_of(seed, stream, design, (factor + 1)/2, words)
      if (mod(factor, 2) == 1) then
         u = fraction_of(words(1), words(2))
      else
         u = fraction_of(words(3), words(4))
      end if
   end function uniform

   !> Computes u(j) = uniform(seed, stream, design, j) for all factors of a design, in half the time of single calls.
   pure subroutine fill_uniforms(seed, stream, design, u)
      integer(i8), intent(in) :: seed, design
      integer, intent(in) :: stream
      real(wp), intent(out) :: u(:)
      integer(i8) :: words(4)
      integer :: j

      do j = 1, size(u), 2
         call words_of(seed, stream, design, (j + 1)/2, words)
         u(j) = fraction_of(words(1), words(2))
         if (j < size(u)) u(j + 1) = fraction_of(words(3), words(4))
      end do
   end subroutine fill_uniforms

   !> Fills an array with random integers from 0 to 2³² − 1.
   pure subroutine fill_words(seed, stream, number, words)
      integer(i8), intent(in) :: seed, number
      integer, intent(in) :: stream
      integer(i8), intent(out) :: words(:)
      integer(i8) :: four(4)
      integer :: j, last

      do j = 1, size(words), 4
         call words_of(seed, stream, number, (j + 3)/4, four)
         last = min(j + 3, size(words))
         words(j:last) = four(:last - j + 1)
      end do
   end subroutine fill_words

end module ek_philox
