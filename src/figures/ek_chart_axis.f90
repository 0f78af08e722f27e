!> Ends of the y axis of a chart: the range of the curves, limited at poles. If the values with a stop in contact reach far
!> beyond the free travel, it is the range of the free travel.
module ek_chart_axis
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_chart_data, only: chart_t, trace_t
   implicit none(type, external)
   private
   public :: range_of, view_of, cut_of, free_range, extremes, contact_spans

   !> Without cutting the axis: the largest span of all states, in spans of the free travel, and the steepest part of a curve with
   !> a stop in contact, in steepest parts of the free travel.
   real(wp), parameter :: much = 3.0_wp

contains

   !> The range of the y axis, as gnuplot reads it. The fixed range of a chart comes first, then the range of the free travel
   !> (free_range). Otherwise it is the range of the curves within ±cut_of(chart). If the curves are constant or span less
   !> than the noise, the range surrounds their middle.
   pure function range_of(chart) result(range)
      type(chart_t), intent(in) :: chart
      character(:), allocatable :: range
      real(wp) :: low, high, margin, cut
      logical :: is_cut

      range = '['//str(chart%fixed(1), 6)//' : '//str(chart%fixed(2), 6)//']'
      if (chart%is_fixed) return
      cut = cut_of(chart)
      range = '[*:*]'
      if (cut > 0.0_wp) range = '['//str(-cut, 6)//' < * : * < '//str(cut, 6)//']'
      call free_range(chart, low, high, is_cut)
      if (is_cut) range = '['//str(low, 6)//' : '//str(high, 6)//']'
      if (is_cut) return
      call extremes(chart, huge(1.0_wp), low, high)
      if (low > high) return
      margin = max(abs(low)/10, 1.0e-6_wp)
      if (high - low <= 0.0_wp) range = '['//str(low - margin, 6)//' : '//str(low + margin, 6)//']'
      if (high - low < chart%noise) &
         range = '[* < '//str((low + high)/2 - chart%noise, 6)//' : '//str((low + high)/2 + chart%noise, 6)//' < *]'
   end function range_of

   !> Returns the range of the y axis (range_of) as two numbers, for a page that draws the chart itself; low > high if the
   !> chart has no value.
   pure subroutine view_of(chart, low, high)
      type(chart_t), intent(in) :: chart
      real(wp), intent(out) :: low, high
      real(wp) :: cut, middle, half
      logical :: is_cut

      low = chart%fixed(1)
      high = chart%fixed(2)
      if (chart%is_fixed) return
      call free_range(chart, low, high, is_cut)
      if (is_cut) return
      cut = cut_of(chart)
      if (.not. cut > 0.0_wp) cut = huge(1.0_wp)
      call extremes(chart, cut, low, high)
      if (low > high) return
      half = chart%noise
      if (.not. half > 0.0_wp) half = max(abs(low)/10, 1.0e-6_wp)
      if (high - low >= chart%noise .and. high > low) return
      middle = (low + high)/2
      low = middle - half
      high = middle + half
   end subroutine view_of

   !> Finds the smallest and the largest value of all curves, with values beyond ±cut moved to ±cut; low > high if no curve
   !> has a value.
   pure subroutine extremes(chart, cut, low, high)
      type(chart_t), intent(in) :: chart
      real(wp), intent(in) :: cut
      real(wp), intent(out) :: low, high
      integer :: k

      low = huge(1.0_wp)
      high = -huge(1.0_wp)
      do k = 1, size(chart%traces)
         associate (y => chart%traces(k)%y)
            if (.not. any(ieee_is_finite(y))) cycle
            low = min(low, max(-cut, minval(y, mask=ieee_is_finite(y))))
            high = max(high, min(cut, maxval(y, mask=ieee_is_finite(y))))
         end associate
      end do
   end subroutine extremes

   !> The limit of the axis on both sides of 0; 0 if there is no limit. The limit is the cap of the chart, if a value lies within
   !> the cap. If a curve has a pole, the limit is 8 times the geometric mean of the magnitudes of all curves, unless the cap is smaller. At a pole, the
   !> value changes sign between two adjacent states and jumps by more than half of the whole span. Curves of less than 12
   !> states are not examined for poles.
   pure real(wp) function cut_of(chart) result(cut)
      type(chart_t), intent(in) :: chart
      real(wp), parameter :: usual = 8.0_wp      ! times the mean of the magnitudes on a logarithmic scale
      integer, parameter :: least_states = 12
      real(wp) :: low, high
      integer :: k, row
      logical :: has_pole

      cut = 0.0_wp
      do k = 1, size(chart%traces)
         associate (y => chart%traces(k)%y)
            if (any(abs(pack(y, ieee_is_finite(y))) <= chart%cap)) cut = chart%cap
         end associate
      end do
      call extremes(chart, huge(1.0_wp), low, high)
      has_pole = .false.
      do k = 1, size(chart%traces)
         associate (y => chart%traces(k)%y)
            if (size(y) < least_states) cycle
            do row = 2, size(y)
               if (.not. (ieee_is_finite(y(row)) .and. ieee_is_finite(y(row - 1)))) cycle
               if (y(row) < 0.0_wp .eqv. y(row - 1) < 0.0_wp) cycle
               has_pole = has_pole .or. abs(y(row)/2 - y(row - 1)/2) > (high/2 - low/2)/2
            end do
         end associate
      end do
      if (.not. has_pole) return
      low = 0.0_wp
      row = 0
      do k = 1, size(chart%traces)
         associate (y => chart%traces(k)%y)
            low = low + sum(log(max(abs(y), 1.0e-9_wp)), mask=ieee_is_finite(y))
            row = row + count(ieee_is_finite(y))
         end associate
      end do
      high = usual*exp(low/row)
      if (.not. cut > 0.0_wp .or. high < cut) cut = high
   end function cut_of

   !> Finds the range of the free travel, with a margin of a quarter of this range, if all states together span more than
   !> three times the range, and a curve is more than three times as steep with a stop in contact. Otherwise, is_cut is .false.: a
   !> quantity on which stops have no effect, such as the half-track over opposite travel, is shown in full. It is also .false. if a
   !> curve has no data on contact or no free state. A range smaller than the noise counts as the noise.
   pure subroutine free_range(chart, low, high, is_cut)
      type(chart_t), intent(in) :: chart
      real(wp), intent(out) :: low, high
      logical, intent(out) :: is_cut
      real(wp) :: all(2), margin, steepest(2), width
      logical, allocatable :: is_free(:)
      integer :: k

      is_cut = .false.
      low = huge(1.0_wp)
      high = -huge(1.0_wp)
      do k = 1, size(chart%traces)
         associate (trace => chart%traces(k))
            if (.not. allocated(trace%in_contact)) return
            if (size(trace%in_contact) /= size(trace%y)) return
            is_free = ieee_is_finite(trace%y) .and. .not. trace%in_contact
            if (.not. any(is_free)) return
            low = min(low, minval(trace%y, mask=is_free))
            high = max(high, maxval(trace%y, mask=is_free))
         end associate
      end do
      if (low > high) return
      call extremes(chart, huge(1.0_wp), all(1), all(2))
      margin = max(high - low, chart%noise)
      if (.not. margin > 0.0_wp .or. all(2) - all(1) <= much*margin) return
      steepest = 0.0_wp
      width = 0.0_wp
      do k = 1, size(chart%traces)
         steepest = max(steepest, steepest_parts(chart%traces(k)))
         associate (x => chart%traces(k)%x)
            width = max(width, maxval(x, mask=ieee_is_finite(x)) - minval(x, mask=ieee_is_finite(x)))
         end associate
      end do
      if (width > 0.0_wp) steepest(1) = max(steepest(1), chart%noise/width)
      if (steepest(2) <= much*steepest(1)) return
      is_cut = .true.
      low = max(all(1), low - margin/4)
      high = min(all(2), high + margin/4)
   end subroutine free_range

   !> The largest magnitudes of the slope between adjacent states of a curve: in the free travel, and with a stop in contact.
   pure function steepest_parts(trace) result(steepest)
      type(trace_t), intent(in) :: trace
      real(wp) :: steepest(2), step
      integer :: k, part

      steepest = 0.0_wp
      do k = 2, size(trace%y)
         if (.not. all(ieee_is_finite([trace%x(k - 1:k), trace%y(k - 1:k)]))) cycle
         step = abs(trace%x(k) - trace%x(k - 1))
         if (.not. step > 0.0_wp) cycle
         part = merge(2, 1, any(trace%in_contact(k - 1:k)))
         steepest(part) = max(steepest(part), abs(trace%y(k) - trace%y(k - 1))/step)
      end do
   end function steepest_parts

   !> The ranges of the abscissa in which a stop is in contact along a curve: (2, range), from the first to the last state in
   !> contact.
   pure function contact_spans(trace) result(spans)
      type(trace_t), intent(in) :: trace
      real(wp), allocatable :: spans(:, :)
      integer :: k, first, n

      allocate (spans(2, size(trace%x)))
      n = 0
      first = 0
      if (allocated(trace%in_contact)) then
         do k = 1, size(trace%in_contact)
            if (.not. ieee_is_finite(trace%x(k))) cycle
            if (trace%in_contact(k) .and. first == 0) then
               n = n + 1
               first = k
               spans(1, n) = trace%x(k)
            end if
            if (trace%in_contact(k)) spans(2, n) = trace%x(k)
            if (.not. trace%in_contact(k)) first = 0
         end do
      end if
      spans = spans(:, :n)
   end function contact_spans

end module ek_chart_axis
