!> Correlation between factors of any distributions by a Gaussian copula, through standard normal numbers (scores).
!>
!> The vector z' = L z has the correlations R if z contains independent scores and L Lᵀ = R. Factor j is then x_j = F_j⁻¹(Φ(z'_j)).
!> A correlation r is therefore a correlation of the scores. For normal factors, r is also the linear correlation of the factors.
!> For any continuous distributions, the rank correlation of the factors is ρ = (6/π) asin(r/2) (Kruskal, J. Am. Stat. Assoc. 53
!> (1958) 827).
!>
!> Source: R. B. Nelsen, An introduction to copulas, 2006, section 2.3.
module ek_copula
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_deck
   use ek_text, only: str
   use ek_lapack, only: dpotrf
   implicit none(type, external)
   private
   public :: copula_t, new_copula, correlate

   type :: copula_t
      private
      real(wp), allocatable :: root(:, :)      !! transpose of L, upper triangle, so that a row of L is contiguous
   end type copula_t

contains

   !> Creates the copula of n factors from pairs of factors and their correlations. All other pairs are independent. Correlations
   !> that contradict each other are an error.
   pure subroutine new_copula(n, pairs, correlations, copula, error)
      integer, intent(in) :: n
      integer, intent(in) :: pairs(:, :)          !! (2, m): two different factors each
      real(wp), intent(in) :: correlations(:)     !! (m), between −1 and 1
      type(copula_t), intent(out) :: copula
      type(error_t), allocatable, intent(out) :: error
      integer :: i, j, m, info
      logical :: is_given(n, n)

      is_given = .false.
      allocate (copula%root(n, n))
      copula%root(:, :) = 0.0_wp
      do i = 1, n
         copula%root(i, i) = 1.0_wp
      end do
      do m = 1, size(correlations)
         i = minval(pairs(:, m))
         j = maxval(pairs(:, m))
         if (i < 1 .or. j > n .or. i == j) then
            call fail(error, exit_deck, 'correlation '//str(m)//' requires two different factors, found '//str(i)//' and '//str(j))
         else if (is_given(i, j)) then
            call fail(error, exit_deck, 'the correlation of factors '//str(i)//' and '//str(j)//' is given twice')
         else if (.not. abs(correlations(m)) < 1.0_wp) then
            call fail(error, exit_deck, 'the correlation of factors '//str(i)//' and '//str(j)// &
               ' must be between -1 and 1, found '//str(correlations(m)))
         end if
         if (allocated(error)) return
         copula%root(i, j) = correlations(m)
         is_given(i, j) = .true.
      end do
      ! R = UᵀU, U = Lᵀ
      call dpotrf('U', n, copula%root, n, info)
      if (info > 0) call fail(error, exit_deck, 'the correlations contradict each other: those of factor '//str(info)// &
         ' are impossible together with those among the factors before it (the matrix is not positive definite)')
   end subroutine new_copula

   !> Computes z ← L z, in place: independent scores become scores with the correlations of the copula.
   !>
   !> Equation (D.9) of docs/theory/sampling.md.
   pure subroutine correlate(copula, z)
      type(copula_t), intent(in) :: copula
      real(wp), intent(inout) :: z(:)
      real(wp) :: sum
      integer :: i, j

      do i = size(z), 1, -1
         sum = 0.0_wp
         do j = 1, i
            sum = sum + copula%root(j, i)*z(j)
         end do
         z(i) = sum
      end do
   end subroutine correlate

end module ek_copula
