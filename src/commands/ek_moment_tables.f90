!> The moments of a tolerance study: takes them from its expansion and from its designs, writes them as tables, and reads the tables
!> back for figures and page.
!>
!>     <study>_moments.csv   one row per response and method: mean, deviation, skewness, percentiles, share within the limits
!>     <study>_shares.csv    one row per response and factor: derivatives and shares of the variance
!>     <study>_bands.csv     one row per column and state: the curve and its band
module ek_moment_tables
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t
   use ek_frame, only: frame_t, new_frame
   use ek_file, only: join_path, write_whole, file_exists
   use ek_table, only: table_t, read_csv
   use ek_sample_statistics, only: mean_and_deviation, ascending_order, percentile, error_of_deviation
   use ek_share_interval, only: share_interval
   use ek_standard_factor, only: value_at, slope_at
   use ek_moments, only: moments_t, normal_yield, normal_percentile
   use ek_tolerance, only: tolerance_t
   use ek_study_data, only: study_data_t, study_axis_t, moment_row_t, methods
   implicit none(type, external)
   private
   public :: take_tolerance, take_sample, write_moments, read_moments

   real(wp), parameter :: normal_95 = 1.959963984540054_wp      !! half width of a 95 % interval [standard errors]
   character(*), parameter :: moment_heads = 'response,method,mean,mean_half_95,deviation,deviation_half_95,skewness,p5,p95,'// &
      'lower,upper,within,within_half_95,within_low_95,within_high_95'
   integer, parameter :: moment_columns = 15
   character(*), parameter :: share_heads = 'response,factor,center,deviation,slope,effect,curvature,first,total,nominal,'// &
      'at_low,at_high'
   character(*), parameter :: band_heads = 'column,factor,nominal,mean,deviation,p5,p95'

contains

   !> Copies the results computed from derivatives for the responses and the curves.
   subroutine take_tolerance(found, columns, data)
      type(tolerance_t), intent(in) :: found
      character(*), intent(in) :: columns(:)         !! columns of the study; the columns of the data lack the swept value
      type(study_data_t), intent(inout) :: data
      integer :: c, f, k, r, s

      allocate (data%moments(size(methods), found%responses))
      data%centers = [(value_at(found%factors(f), 0.0_wp), f=1, size(found%factors))]
      data%deviations = [(slope_at(found%factors(f), 0.0_wp), f=1, size(found%factors))]
      do r = 1, found%responses
         associate (m => found%moments(r), axis => data%responses(r))
            data%moments(1, r) = row_of(found%expansions(r)%value, m%linear, m%linear_skewness, axis)
            data%moments(2, r) = row_of(m%mean, m%deviation, m%skewness, axis)
         end associate
         call take_effects(r)
      end do
      allocate (data%expected(5, size(data%columns), size(found%sweep)))
      do c = 1, size(data%columns)
         do s = 1, size(found%sweep)
            k = found%responses + (findloc(columns == data%columns(c)%name, .true., dim=1) - 1)*size(found%sweep) + s
            associate (m => found%moments(k))
               data%expected(:, c, s) = [found%expansions(k)%value, m%mean, m%deviation, &
                  normal_percentile(m%mean, m%deviation, m%skewness, 0.05_wp), &
                  normal_percentile(m%mean, m%deviation, m%skewness, 0.95_wp)]
            end associate
         end do
      end do

   contains

      !> Copies the effects of the factors on response r.
      subroutine take_effects(r)
         integer, intent(in) :: r
         real(wp) :: ends(2)

         associate (y => found%expansions(r), effects => data%effects(r))
            effects%nominal = y%value
            effects%first = found%moments(r)%first
            effects%total = found%moments(r)%total
            effects%effect = y%slopes
            effects%curvature = [(y%curvatures(f, f), f=1, size(y%slopes))]
            effects%slope = y%slopes
            effects%at_low = y%slopes
            effects%at_high = y%slopes
            do f = 1, size(y%slopes)
               if (data%deviations(f) > 0.0_wp) effects%slope(f) = y%slopes(f)/data%deviations(f)
               ends = found%factors(f)%ends
               ends = y%value + y%slopes(f)*ends + 0.5_wp*effects%curvature(f)*ends**2
               effects%at_low(f) = merge(ends(1), nothing(), found%has_end(r, 1, f))
               effects%at_high(f) = merge(ends(2), nothing(), found%has_end(r, 2, f))
            end do
            call take_ranges(data, r)
         end associate
      end subroutine take_effects

   end subroutine take_tolerance

   !> Sets the smallest and largest value of a response, and errors of 0 for its indices. The figures of one factor at a time and
   !> the figures of the indices need these data.
   pure subroutine take_ranges(data, r)
      type(study_data_t), intent(inout) :: data
      integer, intent(in) :: r
      real(wp) :: ends(3)
      integer :: f

      associate (effects => data%effects(r))
         effects%lowest = effects%at_low
         effects%highest = effects%at_high
         do f = 1, size(effects%at_low)                ! an end without a value is omitted
            ends = [effects%at_low(f), effects%at_high(f), effects%nominal]
            effects%lowest(f) = minval(ends, mask=ieee_is_finite(ends))
            effects%highest(f) = maxval(ends, mask=ieee_is_finite(ends))
         end do
         effects%first_error = 0.0_wp*effects%first
         effects%total_error = 0.0_wp*effects%total
      end associate
   end subroutine take_ranges

   !> The moments, percentiles and share within the limits of a nearly normal response. A constant response that touches a limit is
   !> within the limits.
   pure function row_of(mean, deviation, skewness, axis) result(row)
      real(wp), intent(in) :: mean, deviation, skewness
      type(study_axis_t), intent(in) :: axis
      type(moment_row_t) :: row

      row = moment_row_t(mean, deviation, skewness, normal_percentile(mean, deviation, skewness, 0.05_wp), &
         normal_percentile(mean, deviation, skewness, 0.95_wp), 0.0_wp, 0.0_wp, &
         nothing(), nothing(), nothing())
      if (is_limited(axis)) row%within = normal_yield(mean, deviation, skewness, axis%lower, axis%upper)
      if (.not. deviation > 0.0_wp) then
         row%skewness = nothing()
         if (is_limited(axis)) row%within = normal_yield(mean, deviation, skewness, axis%widened(1), axis%widened(2))
      end if
      row%within_low = row%within
      row%within_high = row%within
   end function row_of

   !> Computes the moments, percentiles and share within the limits of each response from the designs of the study; NaN with fewer
   !> than two values.
   subroutine take_sample(data)
      type(study_data_t), intent(inout) :: data
      real(wp), allocatable :: values(:)
      integer, allocatable :: order(:)
      real(wp) :: ends(2)
      integer :: counted, n, r

      do r = 1, size(data%responses)
         associate (row => data%moments(3, r), axis => data%responses(r))
            values = pack(data%y(r, :), ieee_is_finite(data%y(r, :)))
            n = size(values)
            row = moment_row_t(nothing(), nothing(), nothing(), nothing(), nothing(), nothing(), nothing(), nothing(), nothing(), &
               nothing())
            if (n < 2) cycle
            call mean_and_deviation(values, row%mean, row%deviation)
            row%mean_half = normal_95*row%deviation/sqrt(real(n, wp))
            if (axis%is_constant) then             ! no scatter, so no intervals and no skewness
               row%mean_half = nothing()
            else if (row%deviation > 0.0_wp) then
               row%deviation_half = normal_95*error_of_deviation(values)
               row%skewness = sum((values - row%mean)**3)/n/row%deviation**3
            end if
            if (allocated(order)) deallocate (order)
            allocate (order(n))
            call ascending_order(values, order)
            row%low = percentile(values(order), 0.05_wp)
            row%high = percentile(values(order), 0.95_wp)
            if (.not. is_limited(axis)) cycle
            counted = count(values >= axis%widened(1) .and. values <= axis%widened(2))
            row%within = real(counted, wp)/data%designs
            if (axis%is_constant) cycle            ! no interval
            ends = share_interval(counted, data%designs)
            row%within_low = ends(1)
            row%within_high = ends(2)
         end associate
      end do
   end subroutine take_sample

   !> Whether a response has limits.
   pure logical function is_limited(axis)
      type(study_axis_t), intent(in) :: axis
      is_limited = axis%lower > -huge(1.0_wp) .or. axis%upper < huge(1.0_wp)
   end function is_limited

   !> A quiet NaN, which marks a number without a value.
   pure real(wp) function nothing()
      nothing = ieee_value(1.0_wp, ieee_quiet_nan)
   end function nothing

   !> Writes the tables into a folder. `names` returns their file names.
   subroutine write_moments(data, out, names, error)
      type(study_data_t), intent(in) :: data
      character(*), intent(in) :: out
      type(message_list_t), intent(inout) :: names
      type(error_t), allocatable, intent(out) :: error
      type(frame_t) :: frame
      integer :: c, f, m, r, s

      call begin(moment_heads)
      do r = 1, size(data%responses)
         do m = 1, size(methods)
            call frame%put(data%responses(r)%name)
            call frame%put(trim(methods(m)))
            associate (row => data%moments(m, r), axis => data%responses(r))
               call frame%put_known([row%mean, row%mean_half, row%deviation, row%deviation_half, row%skewness, row%low, row%high, &
                  axis%lower, axis%upper, row%within, 0.5_wp*(row%within_high - row%within_low), row%within_low, row%within_high])
            end associate
         end do
      end do
      if (size(data%responses) > 0) call write_one('_moments.csv')
      call begin(share_heads)
      do r = 1, size(data%responses)
         do f = 1, size(data%factors)
            call frame%put(data%responses(r)%name)
            call frame%put(data%factors(f)%name)
            associate (e => data%effects(r))
               call frame%put_known([data%centers(f), data%deviations(f), e%slope(f), e%effect(f), e%curvature(f), e%first(f), &
                  e%total(f), e%nominal, e%at_low(f), e%at_high(f)])
            end associate
         end do
      end do
      if (size(data%responses) > 0) call write_one('_shares.csv')
      call begin(band_heads)
      do c = 1, size(data%expected, 2)
         do s = 1, min(size(data%expected, 3), size(data%sweep))
            call frame%put(data%columns(c)%name)
            call frame%put_known([data%sweep(s), data%expected(:, c, s)])
         end do
      end do
      if (size(data%expected) > 0 .and. size(data%expected, 3) == size(data%sweep)) call write_one('_bands.csv')

   contains

      !> Begins a table with names in quotes, as in the tables of designs.
      subroutine begin(heads)
         character(*), intent(in) :: heads
         frame = new_frame(heads)
         frame%quotes_text = .true.
      end subroutine begin

      subroutine write_one(ending)
         character(*), intent(in) :: ending
         if (allocated(error)) return
         call write_whole(join_path(out, data%name//ending), frame%csv(), error)
         if (.not. allocated(error)) call names%add(data%name//ending)
      end subroutine write_one

   end subroutine write_moments

   !> Reads the tables of a finished study. If the tables of moments and shares are missing or do not match, `moments` stays
   !> unallocated, and no bands are read. If the table of bands is missing or does not match, `expected` has no columns.
   subroutine read_moments(out, data)
      character(*), intent(in) :: out
      type(study_data_t), intent(inout) :: data
      type(table_t) :: moments, shares, bands
      logical :: is_good
      integer :: c, k, m, r, s

      allocate (data%expected(5, 0, 0))
      is_good = .true.
      if (size(data%responses) > 0) then
         call read_one('_moments.csv', size(data%responses)*size(methods), moments)
         if (is_good) is_good = size(moments%values, 1) == moment_columns       ! not the table of an earlier version
         call read_one('_shares.csv', size(data%responses)*size(data%factors), shares)
         if (.not. is_good) return
         allocate (data%moments(size(methods), size(data%responses)))
         do r = 1, size(data%responses)
            do m = 1, size(methods)
               associate (row => moments%values(:, (r - 1)*size(methods) + m))
                  data%moments(m, r) = moment_row_t(row(3), row(5), row(7), row(8), row(9), row(4), row(6), row(12), row(14), &
                     row(15))
               end associate
            end do
            k = (r - 1)*size(data%factors)
            associate (e => data%effects(r), rows => shares%values(:, k + 1:k + size(data%factors)))
               data%centers = rows(3, :)
               data%deviations = rows(4, :)
               e%slope = rows(5, :)
               e%effect = rows(6, :)
               e%curvature = rows(7, :)
               e%first = rows(8, :)
               e%total = rows(9, :)
               e%nominal = rows(10, 1)
               e%at_low = rows(11, :)
               e%at_high = rows(12, :)
            end associate
            call take_ranges(data, r)
         end do
      end if
      if (size(data%columns) == 0) return
      call read_one('_bands.csv', size(data%columns)*size(data%sweep), bands)
      if (.not. is_good) return
      deallocate (data%expected)
      allocate (data%expected(5, size(data%columns), size(data%sweep)))
      do c = 1, size(data%columns)
         do s = 1, size(data%sweep)
            data%expected(:, c, s) = bands%values(3:7, (c - 1)*size(data%sweep) + s)
         end do
      end do

   contains

      !> Reads one table and checks that it has the expected number of rows.
      subroutine read_one(ending, rows, table)
         character(*), intent(in) :: ending
         integer, intent(in) :: rows
         type(table_t), intent(out) :: table
         type(error_t), allocatable :: error

         if (is_good) is_good = file_exists(join_path(out, data%name//ending))
         if (is_good) call read_csv(join_path(out, data%name//ending), table, error, has_text=.true.)
         is_good = is_good .and. .not. allocated(error)
         if (is_good) is_good = size(table%values, 2) == rows
      end subroutine read_one

   end subroutine read_moments

end module ek_moment_tables
