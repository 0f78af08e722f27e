!> Least squares within bounds: the x between lower and upper limits at which the sum of the squares of r(x) is smallest.
!>
!>     call begin_search(start, lower, upper, scale, search)
!>     do while (.not. search%is_finished)
!>        … r and its Jacobian at search%x …
!>        call advance_search(r, jacobian, is_valid, search)
!>     end do
!>     … search%best, search%residuals, search%jacobian, search%held …
!>
!> Each step is a Gauss-Newton step, the shortest if several are equally good. The bounds are part of the problem (an active set: an
!> unknown stays at a bound if the sum would grow away from the bound). If a step fails, because |r| grows or r has no value, the
!> step is damped as Levenberg and Marquardt do. For as many conditions as unknowns this is Newton's method.
!>
!> Reasons against libraries: the codes of MINPACK (lmder) do not support bounds. With bounds by a change of variable, the
!> derivative is zero at a bound: no step leaves the bound, and no covariance follows. MINPACK does not find the rank of the
!> problem, for which LAPACK is needed anyway. NLopt has bounds, but no method for least squares: NLopt would find from
!> many gradients the curvature that the Jacobian gives at once. This module is short, since LAPACK (dgelsd) does the
!> numerical work.
module ek_bounded_search
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_lapack, only: dgelsd
   implicit none(type, external)
   private
   public :: bounded_search_t, begin_search, advance_search, bounded_step
   public :: step_is_small, gain_is_small, no_step_helps, no_value

   ! how a search ended
   integer, parameter :: step_is_small = 1        !! the next step would change nothing
   integer, parameter :: gain_is_small = 2        !! the next step would not reduce r: a minimum
   integer, parameter :: no_step_helps = 3        !! no step that was tried reduced r: rounding, or a corner of r
   integer, parameter :: no_value = 4             !! r has no value at the start

   !> A search. x and the bounds are in the units of the caller. The scale of each x is a change that counts as large.
   type :: bounded_search_t
      logical :: is_finished = .false.
      integer :: ended = 0                           !! one of the constants above
      integer :: trials = 0, steps = 0               !! number of evaluations; number of steps taken
      real(wp), allocatable :: x(:)                  !! x to be evaluated next
      real(wp), allocatable :: best(:)               !! the best x so far; `residuals` and `jacobian` are r and J at `best`
      real(wp), allocatable :: residuals(:), jacobian(:, :)
      integer, allocatable :: held(:)                !! of each unknown: −1 held at its lower, +1 at its upper bound; 0 free
      real(wp), allocatable, private :: lower(:), upper(:), scale(:)
      real(wp), private :: damping = 0.0_wp          !! μ of bounded_step
      real(wp), private :: predicted = 0.0_wp        !! reduction of |r|² predicted for the last step
   end type bounded_search_t

   real(wp), parameter :: far = 1.0e100_wp                 !! a bound farther away is ignored; far/scale is finite
   real(wp), parameter :: tiny_step = 1.0e-10_wp           !! length of a step that ends the search, as a share of the scale
   real(wp), parameter :: tiny_gain = 1.0e-13_wp           !! predicted gain that ends the search, as a share of |r|²: rounding
   real(wp), parameter :: first_damping = 1.0e-3_wp, most_damping = 1.0e7_wp, least_damping = 1.0e-8_wp
   real(wp), parameter :: rank_share = 1.0e-10_wp          !! singular values below this share of the largest are errors of the
                                                           !! derivatives

contains

   !> Begins a search. The first point to be evaluated is the start, moved between the bounds.
   subroutine begin_search(start, lower, upper, scale, search)
      real(wp), intent(in) :: start(:), lower(:), upper(:), scale(:)
      type(bounded_search_t), intent(out) :: search

      search%lower = max(lower, -far)
      search%upper = min(upper, far)
      search%scale = scale
      search%x = min(max(start, search%lower), search%upper)
      search%best = search%x
      allocate (search%held(size(start)), source=0)
   end subroutine begin_search

   !> Uses r and its Jacobian at search%x: stores both if |r| is the smallest so far, and sets the next x or ends the search.
   subroutine advance_search(r, jacobian, is_valid, search)
      real(wp), intent(in) :: r(:)
      real(wp), intent(in) :: jacobian(:, :)             !! (residual, unknown)
      logical, intent(in) :: is_valid                    !! .false.: r has no value at this x
      type(bounded_search_t), intent(inout) :: search
      logical :: is_first, is_better
      real(wp) :: gain

      search%trials = search%trials + 1
      is_first = .not. allocated(search%residuals)
      is_better = is_valid
      if (is_better) is_better = all(ieee_is_finite(r)) .and. all(ieee_is_finite(jacobian))
      gain = 0.0_wp
      if (is_better .and. .not. is_first) then
         gain = sum(search%residuals**2) - sum(r**2)
         is_better = gain > 0.0_wp
      end if
      if (is_better) then
         if (.not. is_first) then
            search%steps = search%steps + 1
            ! a step that gave half of what it promised was in the range where r is nearly linear
            search%damping = search%damping*merge(0.1_wp, 2.0_wp, gain > 0.5_wp*search%predicted)
            if (search%damping < least_damping) search%damping = 0.0_wp
         end if
         search%best = search%x
         search%residuals = r
         search%jacobian = jacobian
      else if (is_first) then
         call finish(no_value)
         return
      else
         search%damping = max(first_damping, 10.0_wp*search%damping)
      end if
      call next_step()

   contains

      !> Ends the search with a reason.
      subroutine finish(why)
         integer, intent(in) :: why
         search%is_finished = .true.
         search%ended = why
      end subroutine finish

      !> Computes the next step within the bounds from the best x.
      subroutine next_step()
         real(wp) :: d(size(search%x)), low(size(d)), high(size(d)), scaled(size(r), size(d)), before
         integer :: j

         do j = 1, size(d)
            scaled(:, j) = search%jacobian(:, j)*search%scale(j)
         end do
         low = (search%lower - search%best)/search%scale
         high = (search%upper - search%best)/search%scale
         call bounded_step(scaled, search%residuals, low, high, search%damping, d, search%held)
         before = sum(search%residuals**2)
         search%predicted = before - sum((matmul(scaled, d) + search%residuals)**2)
         if (maxval(abs(d)) <= tiny_step) then
            call finish(merge(no_step_helps, step_is_small, search%damping > first_damping))
         else if (search%predicted <= tiny_gain*before) then
            call finish(gain_is_small)
         else if (search%damping > most_damping) then
            call finish(no_step_helps)
         end if
         search%x = search%best + d*search%scale
         where (search%held < 0) search%x = search%lower
         where (search%held > 0) search%x = search%upper
      end subroutine next_step

   end subroutine advance_search

   !> Finds the d with low ≤ d ≤ high and the smallest |J d + r|² + μ s² |d|², with s the largest norm of a column of J.
   !>
   !> An active set: the free unknowns are solved for. If they leave the bounds, d goes as far as the first bound, and the unknown
   !> of this bound is then held. If all are inside, a held unknown is freed if the sum decreases away from its bound. Every cycle
   !> reduces the sum, so that the cycles end.
   !> Equation (E.4) of docs/theory/derivatives.md.
   subroutine bounded_step(jacobian, r, low, high, damping, d, held)
      real(wp), intent(in) :: jacobian(:, :), r(:)
      real(wp), intent(in) :: low(:), high(:)            !! low ≤ 0 ≤ high
      real(wp), intent(in) :: damping                    !! μ
      real(wp), intent(out) :: d(:)
      integer, intent(out) :: held(:)                    !! −1 at low, +1 at high, 0 free
      real(wp), parameter :: rounding = 1.0e-12_wp       !! limit of a scaled slope: smaller slopes free no unknown
      real(wp) :: z(size(d)), slope(size(d)), mu, share, this
      integer :: j, cycles, worst

      mu = damping*maxval([0.0_wp, (sum(jacobian(:, j)**2), j=1, size(d))])
      d = 0.0_wp
      slope = matmul(r, jacobian)
      held = 0
      where (low >= 0.0_wp .and. (slope > 0.0_wp .or. high <= 0.0_wp)) held = -1
      where (high <= 0.0_wp .and. slope < 0.0_wp) held = 1
      do cycles = 1, 10*size(d) + 10
         call solve_free(jacobian, r + matmul(jacobian, merge(d, 0.0_wp, held /= 0)), mu, held == 0, z)
         where (held /= 0) z = d
         if (all(z >= low .and. z <= high)) then
            d = z
            slope = matmul(matmul(jacobian, d) + r, jacobian) + mu*d
            worst = 0
            this = rounding*norm2(r)
            do j = 1, size(d)
               if (held(j) == 0 .or. .not. high(j) > low(j)) cycle
               if (held(j)*slope(j) > this*max(norm2(jacobian(:, j)), tiny(1.0_wp))) then
                  worst = j
                  this = abs(slope(j))/max(norm2(jacobian(:, j)), tiny(1.0_wp))
               end if
            end do
            if (worst == 0) exit
            held(worst) = 0
         else
            share = 1.0_wp
            do j = 1, size(d)
               if (z(j) < low(j)) share = min(share, (low(j) - d(j))/(z(j) - d(j)))
               if (z(j) > high(j)) share = min(share, (high(j) - d(j))/(z(j) - d(j)))
            end do
            do j = 1, size(d)
               if (held(j) /= 0) cycle
               this = d(j) + share*(z(j) - d(j))
               if (z(j) < low(j) .and. this <= low(j) + rounding*(high(j) - low(j))) held(j) = -1
               if (z(j) > high(j) .and. this >= high(j) - rounding*(high(j) - low(j))) held(j) = 1
               d(j) = min(max(this, low(j)), high(j))
               if (held(j) < 0) d(j) = low(j)
               if (held(j) > 0) d(j) = high(j)
            end do
         end if
      end do
   end subroutine bounded_step

   !> Finds the shortest z of the free unknowns with the smallest |J z + r|² + mu |z|². z of the other unknowns is zero.
   subroutine solve_free(jacobian, r, mu, is_free, z)
      real(wp), intent(in) :: jacobian(:, :), r(:), mu
      logical, intent(in) :: is_free(:)
      real(wp), intent(out) :: z(:)
      real(wp), allocatable :: a(:, :), b(:), s(:), work(:)
      integer, allocatable :: places(:), iwork(:)
      real(wp) :: query(1)
      integer :: iquery(1), m, n, j, rank, info

      z = 0.0_wp
      places = pack([(j, j=1, size(z))], is_free .and. any(abs(jacobian) > 0.0_wp, dim=1))     ! others have no effect
      n = size(places)
      if (n == 0) return
      m = size(r) + merge(n, 0, mu > 0.0_wp)
      allocate (a(m, n), b(max(m, n)), s(min(m, n)))
      a = 0.0_wp
      b = 0.0_wp
      a(:size(r), :) = jacobian(:, places)
      b(:size(r)) = -r
      do j = 1, merge(n, 0, mu > 0.0_wp)
         a(size(r) + j, j) = sqrt(mu)
      end do
      call dgelsd(m, n, 1, a, m, b, size(b), s, rank_share, rank, query, -1, iquery, info)
      allocate (work(max(1, int(query(1)))), iwork(max(1, iquery(1))))
      call dgelsd(m, n, 1, a, m, b, size(b), s, rank_share, rank, work, size(work), iwork, info)
      if (info == 0) z(places) = b(:n)
   end subroutine solve_free

end module ek_bounded_search
