!> Statistics of a sample: mean, standard deviation, percentiles with confidence intervals, correlations. All values must be finite.
module ek_sample_statistics
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: mean_and_deviation, error_of_deviation, ascending_order, percentile, percentile_interval, linear_correlation, &
      rank_correlation, ranks

contains

   !> Computes the mean and the standard deviation in two passes: s² = Σ (x − x̄)²/(n − 1). The deviation is 0 for one
   !> value, and exactly 0 for equal values, whose mean is the value.
   pure subroutine mean_and_deviation(values, mean, deviation)
      real(wp), intent(in) :: values(:)            !! sample of at least one value
      real(wp), intent(out) :: mean, deviation
      integer :: k, n

      n = size(values)
      mean = sum(values)/n
      deviation = 0.0_wp
      if (.not. maxval(values) > minval(values)) then
         mean = values(1)
         return
      end if
      do k = 1, n
         deviation = deviation + (values(k) - mean)**2
      end do
      deviation = sqrt(deviation/max(1, n - 1))
   end subroutine mean_and_deviation

   !> Standard error of the standard deviation s of a sample of n values: s √((κ − 1)/4n), where κ s⁴ is the fourth central moment.
   pure real(wp) function error_of_deviation(values) result(error)
      real(wp), intent(in) :: values(:)            !! sample; the values are not all equal
      real(wp) :: mean, deviation
      integer :: n

      n = size(values)
      call mean_and_deviation(values, mean, deviation)
      error = deviation*sqrt(max(0.0_wp, sum((values - mean)**4)/n/deviation**4 - 1.0_wp)/(4.0_wp*n))
   end function error_of_deviation

   !> Finds the order in which values ascend: values(order(1)) is the smallest. Equal values remain in their order (merge sort).
   pure subroutine ascending_order(values, order)
      real(wp), intent(in) :: values(:)
      integer, intent(out) :: order(:)             !! indices of the values, in ascending order of the values
      integer, allocatable :: old(:)
      integer :: n, width, first, middle, last, i, j, k

      n = size(values)
      order = [(k, k=1, n)]
      width = 1
      do while (width < n)
         old = order
         do first = 1, n, 2*width
            middle = min(first + width, n + 1)
            last = min(first + 2*width, n + 1)
            i = first
            j = middle
            do k = first, last - 1
               if (i < middle .and. j < last) then
                  if (values(old(j)) < values(old(i))) then
                     order(k) = old(j)
                     j = j + 1
                  else
                     order(k) = old(i)
                     i = i + 1
                  end if
               else if (i < middle) then
                  order(k) = old(i)
                  i = i + 1
               else
                  order(k) = old(j)
                  j = j + 1
               end if
            end do
         end do
         width = 2*width
      end do
   end subroutine ascending_order

   !> The value below which a share p of the sample lies: the smallest value at p = 0, the largest at p = 1, and a linear
   !> interpolation between neighbours. This is type 7 of R. J. Hyndman, Y. Fan, Sample quantiles in statistical packages, Am. Stat.
   !> 50 (1996), and numpy's default.
   pure real(wp) function percentile(ascending, p) result(value)
      real(wp), intent(in) :: ascending(:)         !! the sample in ascending order, at least one
      real(wp), intent(in) :: p                    !! 0 … 1
      real(wp) :: place
      integer :: k

      place = 1.0_wp + p*(size(ascending) - 1)
      k = max(1, min(size(ascending) - 1, int(place)))
      value = ascending(k)
      if (place > k) value = value + (place - k)*(ascending(k + 1) - value)
   end function percentile

   !> Finds an interval that contains the percentile p of the whole population with a confidence, for any distribution. The ends of
   !> the interval are given as ranks in a sample of n values. The number B of sample values below the percentile is binomial:
   !> P(lower ≤ B < upper) = Σ C(n,b) pᵇ(1 − p)ⁿ⁻ᵇ.
   !>
   !> On either side, the probability outside the interval is at most (1 − confidence)/2. If the sample is too small for this limit,
   !> the interval reaches to the end of the sample, and the coverage is below the confidence. Source: H. A. David, H. N. Nagaraja,
   !> Order statistics, 2003, section 7.1.
   !>
   !> Equation (D.13) of docs/theory/sampling.md.
   pure subroutine percentile_interval(n, p, confidence, lower, upper, coverage)
      integer, intent(in) :: n
      real(wp), intent(in) :: p, confidence        !! share and confidence, both between 0 and 1
      integer, intent(out) :: lower, upper         !! ranks, 1 … n
      real(wp), intent(out) :: coverage            !! probability that the interval contains the percentile
      real(wp) :: below, tail
      integer :: b, first, last

      tail = 0.5_wp*(1.0_wp - confidence)
      first = max(0, floor(n*p - 12.0_wp*sqrt(n*p*(1.0_wp - p)) - 12.0_wp))     ! the rest is below 1e-15
      last = min(n, ceiling(n*p + 12.0_wp*sqrt(n*p*(1.0_wp - p)) + 12.0_wp))
      lower = 0
      upper = n + 1
      below = 0.0_wp                               ! P(B < b)
      coverage = 0.0_wp
      do b = first, last
         ! rank b is above the percentile with the probability P(B < b)
         if (below <= tail) lower = b
         below = below + binomial(n, b, p)
         if (upper > n .and. below >= 1.0_wp - tail) upper = min(n, b + 1)
      end do
      lower = max(1, lower)
      upper = max(lower, min(n, upper))
      do b = max(first, lower), min(last, upper - 1)
         coverage = coverage + binomial(n, b, p)
      end do
      coverage = min(1.0_wp, coverage)
   end subroutine percentile_interval

   !> The binomial probability C(n, b) pᵇ(1 − p)ⁿ⁻ᵇ [-].
   pure real(wp) function binomial(n, b, p)
      integer, intent(in) :: n, b
      real(wp), intent(in) :: p

      binomial = exp(log_gamma(n + 1.0_wp) - log_gamma(b + 1.0_wp) - log_gamma(n - b + 1.0_wp) + b*log(p) + &
         (n - b)*log(1.0_wp - p))
   end function binomial

   !> Pearson's correlation, Σ(x − x̄)(y − ȳ)/√(Σ(x − x̄)² Σ(y − ȳ)²); 0 if x or y is constant.
   pure real(wp) function linear_correlation(x, y) result(r)
      real(wp), intent(in) :: x(:), y(:)           !! the same number of values
      real(wp) :: mean_x, mean_y, xx, yy, xy
      integer :: k

      mean_x = sum(x)/size(x)
      mean_y = sum(y)/size(y)
      xx = 0.0_wp
      yy = 0.0_wp
      xy = 0.0_wp
      do k = 1, size(x)
         xx = xx + (x(k) - mean_x)**2
         yy = yy + (y(k) - mean_y)**2
         xy = xy + (x(k) - mean_x)*(y(k) - mean_y)
      end do
      r = 0.0_wp
      if (.not. (maxval(x) > minval(x) .and. maxval(y) > minval(y))) return      ! their means are rounded, so xx or yy is not 0
      if (xx > 0.0_wp .and. yy > 0.0_wp) r = max(-1.0_wp, min(1.0_wp, xy/(sqrt(xx)*sqrt(yy))))
   end function linear_correlation

   !> Spearman's correlation: the linear correlation of the ranks.
   pure real(wp) function rank_correlation(x, y) result(r)
      real(wp), intent(in) :: x(:), y(:)           !! the same number of values
      real(wp), allocatable :: rank_x(:), rank_y(:)

      allocate (rank_x(size(x)), rank_y(size(y)))
      call ranks(x, rank_x)
      call ranks(y, rank_y)
      r = linear_correlation(rank_x, rank_y)
   end function rank_correlation

   !> Finds the rank of each value, 1 … n; equal values share the mean of their ranks.
   pure subroutine ranks(values, rank)
      real(wp), intent(in) :: values(:)
      real(wp), intent(out) :: rank(:)
      integer, allocatable :: order(:)
      integer :: first, last, k

      allocate (order(size(values)))
      call ascending_order(values, order)
      first = 1
      do while (first <= size(values))
         last = first
         do k = first + 1, size(values)
            if (values(order(k)) > values(order(first))) exit
            last = k
         end do
         do k = first, last
            rank(order(k)) = 0.5_wp*(first + last)
         end do
         first = last + 1
      end do
   end subroutine ranks

end module ek_sample_statistics
