!> Sobol' points by index: each coordinate directly from the index, without the points before it.
!>
!> Coordinate j of point n is the sum (exclusive or) of the direction numbers v_j,k for which bit k of g = n ⊕ ⌊n/2⌋ is set:
!>
!>     x_n,j = (g₁ v_j,1 ⊕ g₂ v_j,2 ⊕ …) 2⁻³² + 2⁻³³
!>
!> The Gray code g of n gives the points the order of other programs (scipy, SALib); it only permutes them within blocks of 2ᵐ
!> points. With the half step 2⁻³³, all coordinates are inside (0, 1), including point 0. The first 2ᵐ points, and every later
!> block of 2ᵐ, have exactly one coordinate in each of 2ᵐ equal intervals, in every dimension.
!>
!> Sources: P. Bratley, B. L. Fox, Algorithm 659, ACM TOMS 14 (1988) 88–100; the direction numbers: ek_sobol_numbers.
!> Scrambling: J. Matoušek, On the L2-discrepancy for anchored boxes, J. Complexity 14 (1998) 527–556: a random linear map of the
!> digits (lower triangular with a unit diagonal, so that the intervals above stay filled) and a random digital shift.
module ek_sobol
   use ek_kinds, only: wp, i8
   use ek_philox, only: fill_words
   use ek_sobol_numbers, only: largest_dimension, polynomials, initial_numbers
   implicit none(type, external)
   private
   public :: sobol_t, new_sobol, sobol_point, sobol_coordinate, largest_dimension, largest_index

   integer, parameter :: digits = 32
   integer(i8), parameter :: largest_index = 2_i8**digits - 1

   type :: sobol_t
      private
      integer(i8), allocatable :: directions(:, :)   !! (k, j): v_j,k as an integer below 2³²
      integer(i8), allocatable :: shift(:)           !! random digital shift of each dimension; 0 without a seed
   end type sobol_t

contains

   !> Creates a sequence with 1 … largest_dimension dimensions. If a seed is given, the sequence is scrambled.
   pure subroutine new_sobol(dimensions, sobol, seed, stream)
      integer, intent(in) :: dimensions
      type(sobol_t), intent(out) :: sobol
      integer(i8), intent(in), optional :: seed
      integer, intent(in), optional :: stream        !! of the random numbers, with a seed
      integer :: j, first, degree

      allocate (sobol%directions(digits, dimensions), sobol%shift(dimensions))
      sobol%shift(:) = 0
      first = 1
      do j = 1, dimensions
         degree = degree_of(j)
         call set_directions(j, degree, first, sobol%directions(:, j))
         first = first + degree
         if (present(seed)) call scramble(seed, stream, j, sobol%directions(:, j), sobol%shift(j))
      end do
   end subroutine new_sobol

   !> The degree of the polynomial of a dimension; the first dimension has no polynomial.
   pure integer function degree_of(dimension) result(degree)
      integer, intent(in) :: dimension

      degree = 0
      if (dimension > 1) degree = bit_size(0) - 1 - leadz(polynomials(dimension - 1))
   end function degree_of

   !> Computes the direction numbers of one dimension: v_k = m_k 2³²⁻ᵏ. Beyond the degree s of its polynomial
   !> xˢ + a₁xˢ⁻¹ + … + 1 they are
   !>
   !>     v_k = a₁v_{k−1} ⊕ … ⊕ a_{s−1}v_{k−s+1} ⊕ v_{k−s} ⊕ v_{k−s} 2⁻ˢ      (Bratley and Fox, equation 2)
   !>
   !> Equation (D.3) of docs/theory/sampling.md.
   pure subroutine set_directions(dimension, degree, first, v)
      integer, intent(in) :: dimension, degree
      integer, intent(in) :: first                   !! index of m₁ of this dimension in initial_numbers
      integer(i8), intent(out) :: v(digits)
      integer :: i, k

      do k = 1, digits
         if (dimension == 1) then
            v(k) = shiftl(1_i8, digits - k)
         else if (k <= degree) then
            v(k) = shiftl(int(initial_numbers(first + k - 1), i8), digits - k)
         else
            v(k) = ieor(v(k - degree), shiftr(v(k - degree), degree))
            do i = 1, degree - 1
               if (btest(polynomials(dimension - 1), degree - i)) v(k) = ieor(v(k), v(k - i))
            end do
         end if
      end do
   end subroutine set_directions

   !> Scrambles one dimension. Digit i of a number (i = 1 is the first after the point) becomes the sum modulo 2 of itself and of a
   !> random choice of the digits before it. The shift is random.
   !>
   !> Equation (D.5) of docs/theory/sampling.md.
   pure subroutine scramble(seed, stream, dimension, v, shift)
      integer(i8), intent(in) :: seed
      integer, intent(in) :: stream, dimension
      integer(i8), intent(inout) :: v(digits)
      integer(i8), intent(out) :: shift
      integer(i8) :: row, old(digits), words(digits + 1)
      integer :: i, k

      call fill_words(seed, stream, int(dimension, i8), words)
      shift = words(digits + 1)
      old = v
      v = 0
      do i = 1, digits
         ! bits of digits 1 … i − 1 at random, the bit of digit i
         row = ior(shiftl(shiftr(words(i), digits - i + 1), digits - i + 1), &
            shiftl(1_i8, digits - i))
         do k = 1, digits
            if (poppar(iand(row, old(k))) == 1) v(k) = ibset(v(k), digits - i)
         end do
      end do
   end subroutine scramble

   !> One coordinate of a point: a multiple of 2⁻³³ in (0, 1).
   !>
   !> Equation (D.4) of docs/theory/sampling.md.
   pure real(wp) function sobol_coordinate(sobol, index, dimension) result(x)
      type(sobol_t), intent(in) :: sobol
      integer(i8), intent(in) :: index               !! 0 … largest_index
      integer, intent(in) :: dimension
      real(wp), parameter :: step = 2.0_wp**(-digits)
      integer(i8) :: bits, sum
      integer :: k

      sum = sobol%shift(dimension)
      bits = ieor(index, shiftr(index, 1))
      do while (bits /= 0)
         k = trailz(bits)
         sum = ieor(sum, sobol%directions(k + 1, dimension))
         bits = ibclr(bits, k)
      end do
      x = (real(sum, wp) + 0.5_wp)*step
   end function sobol_coordinate

   !> Computes all coordinates of a point that x can hold.
   pure subroutine sobol_point(sobol, index, x)
      type(sobol_t), intent(in) :: sobol
      integer(i8), intent(in) :: index               !! 0 … largest_index
      real(wp), intent(out) :: x(:)                  !! up to the dimensions of the sequence
      integer :: j

      do j = 1, size(x)
         x(j) = sobol_coordinate(sobol, index, j)
      end do
   end subroutine sobol_point

end module ek_sobol
