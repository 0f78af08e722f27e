!> Correlated factors of a latin hypercube: assigns one of the n equal intervals of each factor to each design. Every interval of
!> every factor is filled once, and the ranks of the factors have the requested correlations.
!>
!> The method of Iman and Conover (Commun. Stat. Simul. Comput. 11 (1982) 311–334) has four steps:
!> - The intervals of each factor, in a random order, become normal scores z.
!> - The accidental correlations of the scores are removed: z ← Q⁻¹ z, where Q Qᵀ is the correlation matrix of the sample.
!> - The requested correlations are added: z' = L z (ek_copula).
!> - The rank of a design among the values z' of a factor is the interval of the design.
!>
!> The method needs the scores of all designs. The intervals are computed once, and every design reads its own intervals.
module ek_rank_order
   use ek_kinds, only: wp, i8
   use ek_error, only: error_t, fail, exit_deck
   use ek_text, only: str
   use ek_lapack, only: dpotrf
   use ek_normal, only: normal_quantile
   use ek_permutation, only: permutation_t, image_of
   use ek_copula, only: copula_t, correlate
   use ek_sample_statistics, only: ascending_order
   implicit none(type, external)
   private
   public :: order_ranks, most_ranked

   integer(i8), parameter :: most_ranked = 10000000_i8     !! limit of designs: each correlated factor needs 4 bytes of memory per
                                                           !! design

contains

   !> Orders the intervals, 0 … n − 1, of the factors that have a correlation, by rank. The intervals of all other factors follow
   !> from their permutations alone.
   pure subroutine order_ranks(permutations, copula, tied, designs, intervals, error)
      type(permutation_t), intent(in) :: permutations(:)   !! permutation of the intervals of each factor
      type(copula_t), intent(in) :: copula                 !! copula of all factors
      integer, intent(in) :: tied(:)                       !! indices of the factors with a correlation, ascending
      integer(i8), intent(in) :: designs
      integer, allocatable, intent(out) :: intervals(:, :) !! (position in `tied`, design)
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: too many designs
      real(wp), allocatable :: scores(:, :)                ! (design, position)
      integer, allocatable :: order(:)
      integer :: m, n, d

      if (designs > most_ranked) then
         call fail(error, exit_deck, '''latin_hypercube'' with correlations requires at most '//str(int(most_ranked))// &
            ' samples; use kind = ''sobol'' or ''monte_carlo''')
         return
      end if
      n = int(designs)
      allocate (intervals(size(tied), n), scores(n, size(tied)), order(n))
      do m = 1, size(tied)
         do d = 1, n
            scores(d, m) = normal_quantile((image_of(permutations(tied(m)), int(d - 1, i8)) + 0.5_wp)/n)
         end do
      end do
      call tie(copula, tied, size(permutations), scores)
      do m = 1, size(tied)
         call ascending_order(scores(:, m), order)
         do d = 1, n
            intervals(m, order(d)) = d - 1
         end do
      end do
   end subroutine order_ranks

   !> Changes the scores of a sample, which have mean 0, so that the scores have the correlations of the copula. The correlations
   !> are exact if the sample has more designs than correlated factors, and if the correlation matrix of the sample is regular.
   !> Otherwise the accidental correlations of the sample remain in the scores.
   pure subroutine tie(copula, tied, factors, scores)
      type(copula_t), intent(in) :: copula
      integer, intent(in) :: tied(:), factors              !! indices of the correlated factors; number of all factors
      real(wp), intent(inout) :: scores(:, :)              !! (design, position in `tied`)
      real(wp) :: root(size(tied), size(tied)), row(size(tied)), z(factors)
      integer :: info, d, i, m

      m = size(tied)
      do i = 1, m
         do d = 1, i
            root(d, i) = dot_product(scores(:, d), scores(:, i))/size(scores, 1)
         end do
      end do
      call dpotrf('U', m, root, m, info)                   ! Qᵀ. Fewer designs than factors: their correlations stay
      if (info == 0 .and. size(scores, 1) > m) info = merge(0, 1, least(root) > sqrt(epsilon(root)))
      z(:) = 0.0_wp
      do d = 1, size(scores, 1)
         row(:) = scores(d, :)
         if (info == 0 .and. size(scores, 1) > m) then
            do i = 1, m
               row(i) = (row(i) - dot_product(root(:i - 1, i), row(:i - 1)))/root(i, i)
            end do
         end if
         z(tied) = row
         call correlate(copula, z)
         scores(d, :) = z(tied)
      end do
   end subroutine tie

   !> The smallest entry on the diagonal of a matrix.
   pure real(wp) function least(root)
      real(wp), intent(in) :: root(:, :)
      integer :: i

      least = root(1, 1)
      do i = 2, size(root, 1)
         least = min(least, root(i, i))
      end do
   end function least

end module ek_rank_order
