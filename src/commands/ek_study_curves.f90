!> The curves of a finished study for its figures: the curves of at most 5,000 designs at common swept values, and their bands.
module ek_study_curves
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_file
   use ek_text, only: str
   use ek_sample_statistics, only: ascending_order, percentile
   use ek_study_data, only: study_data_t, percents
   use ek_study_noise, only: settle_curves
   use ek_study_tables, only: repeated_factors
   use ek_table_lines, only: lines_t, open_table, next_line, take_numbers, close_table
   implicit none(type, external)
   private
   public :: read_curves, curve_step

   integer, parameter :: most_curves = 5000          !! largest number of designs whose curves are stored

contains

   !> The step between designs whose curves are stored: designs 1, 1 + step, …
   pure integer function curve_step(designs)
      integer, intent(in) :: designs
      curve_step = max(1, (designs + most_curves - 1)/most_curves)
   end function curve_step

   !> Reads the curves of the designs that curve_step selects, and finds their bands and the label of the swept value.
   subroutine read_curves(path, deck_sum, tolerance, data, error)
      character(*), intent(in) :: path
      character(*), intent(in) :: deck_sum             !! checksum of the deck
      real(wp), intent(in) :: tolerance                !! tolerance of the cases [m]
      type(study_data_t), intent(inout) :: data
      type(error_t), allocatable, intent(out) :: error
      type(lines_t) :: lines
      character(64), allocatable :: names(:)
      real(wp), allocatable :: values(:), rows(:, :), grown(:, :)
      real(wp) :: before                               ! design of the row before
      logical :: is_row
      integer :: k, c, status, used, every, rest, last

      call open_table(path, deck_sum, lines, names, error)
      k = repeated_factors(size(data%factors))
      c = size(data%columns)
      if (.not. allocated(error) .and. size(names) /= k + c + 2) call fail(error, exit_file, path// &
         ': this is not the table of curves of the study; run the study again')
      if (.not. allocated(error)) then
         every = curve_step(data%designs)
         allocate (values(k + c + 2), rows(c + 2, 1024))
         used = 0
         before = 1.0_wp
         do
            call next_line(lines, status)
            if (status /= 0) exit
            if (every > 1) then
               call take_numbers(lines%content(:lines%used), values(:1), rest)
               if (.not. is_design(values(1))) exit
               if (mod(nint(values(1)) - 1, every) /= 0) cycle
            end if
            call take_numbers(lines%content(:lines%used), values, rest, is_row)
            if (is_row) is_row = is_design(values(1)) .and. rest > lines%used
            if (is_row) is_row = ieee_is_finite(values(k + 2))
            if (is_row) is_row = all(abs(values(2:k + 1) - data%x(:k, nint(values(1)))) <= 0.0_wp)
            if (.not. is_row) exit
            before = values(1)
            used = used + 1
            if (used > size(rows, 2)) then
               last = size(rows, 2)
               allocate (grown(c + 2, 2*last))
               grown(:, :last) = rows
               call move_alloc(grown, rows)
            end if
            rows(:, used) = [values(1), values(k + 2:)]
         end do
         if (status == 0) then
            call fail(error, exit_file, path//':'//str(lines%line)//': this is not a row of the curves of the study; '// &
               'run the study again')
         else
            call sort_curves(rows(:, :used), data)
            call settle_curves(tolerance, data)
            call find_bands(data)
            call name_sweep(data)
         end if
      end if
      call close_table(lines)

   contains

      !> Whether a number is the index of a design, which is not before the design of the row before.
      pure logical function is_design(number)
         real(wp), intent(in) :: number
         is_design = number >= before .and. number <= real(data%designs, wp)
         if (is_design) is_design = abs(number - anint(number)) <= 0.0_wp
      end function is_design

   end subroutine read_curves

   !> Places the states of each design at the swept values of the design that has the most swept values. States at other swept
   !> values are omitted.
   subroutine sort_curves(rows, data)
      real(wp), intent(in) :: rows(:, :)             !! (design, swept value, columns; state)
      type(study_data_t), intent(inout) :: data
      integer, allocatable :: begins(:)
      real(wp) :: near
      integer :: k, j, d, longest

      allocate (begins(0))
      d = 0
      do k = 1, size(rows, 2)
         if (nint(rows(1, k)) == d) cycle
         d = nint(rows(1, k))
         begins = [begins, k]
      end do
      begins = [begins, size(rows, 2) + 1]
      allocate (data%drawn(size(begins) - 1))
      longest = 1
      do d = 1, size(data%drawn)
         data%drawn(d) = nint(rows(1, begins(d)))
         if (begins(d + 1) - begins(d) > begins(longest + 1) - begins(longest)) longest = d
      end do
      if (size(data%drawn) == 0) then
         allocate (data%sweep(0), data%curves(size(data%columns), 0, 0))
         return
      end if
      allocate (data%sweep(begins(longest + 1) - begins(longest)))
      data%sweep(:) = rows(2, begins(longest):begins(longest + 1) - 1)
      allocate (data%curves(size(data%columns), size(data%sweep), size(data%drawn)))
      data%curves = ieee_value(1.0_wp, ieee_quiet_nan)
      near = 1.0e-9_wp*(maxval(data%sweep) - minval(data%sweep))
      do d = 1, size(data%drawn)
         do k = begins(d), begins(d + 1) - 1
            j = k - begins(d) + 1
            if (abs(data%sweep(min(j, size(data%sweep))) - rows(2, k)) > near) &
               j = minloc(abs(data%sweep - rows(2, k)), dim=1)
            if (abs(data%sweep(j) - rows(2, k)) <= near) data%curves(:, j, d) = rows(3:, k)
         end do
      end do
   end subroutine sort_curves

   !> Finds percentiles at each state over the designs that have a value at this state.
   subroutine find_bands(data)
      type(study_data_t), intent(inout) :: data
      real(wp), allocatable :: values(:)
      integer, allocatable :: order(:)
      integer :: c, j, p

      allocate (data%bands(size(percents), size(data%columns), size(data%sweep)))
      data%bands = ieee_value(1.0_wp, ieee_quiet_nan)
      do j = 1, size(data%sweep)
         do c = 1, size(data%columns)
            values = pack(data%curves(c, j, :), ieee_is_finite(data%curves(c, j, :)))
            if (size(values) == 0) cycle
            allocate (order(size(values)))
            call ascending_order(values, order)
            values(:) = values(order)
            deallocate (order)
            do p = 1, size(percents)
               data%bands(p, c, j) = percentile(values, 0.01_wp*percents(p))
            end do
         end do
      end do
   end subroutine find_bands

   !> Removes each column that equals the swept value from the curves, and uses the label of this column for the swept value. If all
   !> columns equal the swept value, none is removed.
   subroutine name_sweep(data)
      type(study_data_t), intent(inout) :: data
      logical :: is_drawn(size(data%columns))
      real(wp) :: near
      integer :: c, j, d

      if (size(data%sweep) == 0) return
      near = 1.0e-6_wp*(maxval(data%sweep) - minval(data%sweep))
      is_drawn = .true.
      do c = 1, size(data%columns)
         do d = 1, size(data%drawn)
            do j = 1, size(data%sweep)
               if (.not. ieee_is_finite(data%curves(c, j, d))) cycle
               if (abs(data%curves(c, j, d) - data%sweep(j)) > near) exit
            end do
            if (j <= size(data%sweep)) exit
         end do
         is_drawn(c) = d <= size(data%drawn)
         if (.not. is_drawn(c)) data%swept = data%columns(c)%label
         if (.not. is_drawn(c) .and. data%columns(c)%note /= '') data%swept = data%swept//'    ('//data%columns(c)%note//')'
      end do
      if (all(is_drawn) .or. .not. any(is_drawn)) return
      data%curves = data%curves(pack([(c, c=1, size(is_drawn))], is_drawn), :, :)
      data%bands = data%bands(:, pack([(c, c=1, size(is_drawn))], is_drawn), :)
      data%columns = pack(data%columns, is_drawn)
   end subroutine name_sweep

end module ek_study_curves
