!> The standard charts of a test: one per quantity, in the order of charted (ek_quantity). One chart each follows for the motion
!> ratios, for springs, dampers and stops, for anti-roll bars, and for bushings and joints. Quantities without a column or
!> without a value are omitted. A table in the definitions of another program has one chart per definition instead.
module ek_test_charts
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_rig_test, only: is_scattered
   use ek_table, only: table_t, name_length, column_index, row_count
   use ek_test_result, only: test_result_t, converged_rows, design_row, wheel_column, has_column, wheel_word
   use ek_quantity, only: quantity_t, charted, quantity_named, label_of, without_phase, unit_of, unit_text
   use ek_quantity, only: unit_size
   use ek_definition_rows, only: definition_t, definitions
   use ek_definition, only: rows_of, heading, own_unit_size, definitions_mark
   use ek_contact, only: states_in_contact
   use ek_chart, only: chart_t, trace_t, new_chart, add_trace, set_level, both_sides
   implicit none(type, external)
   private
   public :: test_charts, quantity_chart, ending_chart, bushing_chart, program_of

   real(wp), parameter :: longest_arm = 20000.0_wp   !! longest swing arm that is drawn [mm]: its length passes through infinity
   real(wp), parameter :: widest_circle = 60.0_wp    !! largest turning circle that is drawn [m]: it is infinite without steering
   integer, parameter :: max_curves = 8       !! largest number of elements in one chart, for legibility

contains

   !> Appends all charts of a test. The chart of a quantity is named <test>_<column>; the others are named
   !> <test>_motion_ratio, <test>_force, <test>_torsion and <test>_bushings. Curves of both sides are joined if they are
   !> equal.
   subroutine test_charts(test, charts, number)
      type(test_result_t), intent(in) :: test
      type(chart_t), allocatable, intent(inout) :: charts(:)
      integer, intent(in), optional :: number         !! index of the test
      character(48), allocatable :: columns(:)
      type(chart_t), allocatable :: drawn(:)
      logical, allocatable :: is_in_contact(:)
      integer, allocatable :: rows(:)
      integer :: k, used

      allocate (columns, source=charted(test%kind))
      call states_in_contact(test%table, is_in_contact)
      rows = rows_of(program_of(test%table))
      if (size(rows) > 0) deallocate (columns)
      if (size(rows) > 0) allocate (columns(0))
      allocate (drawn(size(columns) + size(rows) + 4))
      used = 0
      do k = 1, size(rows)
         call take(defined_chart(test, definitions(rows(k))))
      end do
      do k = 1, size(columns)
         if (columns(k) == test%abscissa) cycle
         if (columns(k) == 'toe_deg' .and. has_column(test, 'steer_deg') .and. any(columns == 'steer_deg')) cycle
         call take(quantity_chart(test, quantity_named(columns(k))))
         if (used > 0 .and. allocated(is_in_contact)) call set_contact(drawn(used), is_in_contact)
      end do
      call take(ending_chart(test, 'motion_ratio', '_motion_ratio', 'Motion ratio', &
         'd(length)/d(wheel travel)    (− shortens in bump)', 0.02_wp))
      call take(ending_chart(test, 'force', '_force_n', 'Springs, dampers, stops', 'force, N    (+ compression)', 20.0_wp))
      call take(ending_chart(test, 'torsion', '_moment_nm', 'Anti-roll bar', 'moment, N m', 2.0_wp))
      call take(bushing_chart(test))
      if (.not. allocated(charts)) allocate (charts(0))
      if (present(number)) drawn%test = number
      charts = [charts, drawn(:used)]

   contains

      !> Stores a chart that has a curve, joins its equal sides, and sets is_level.
      subroutine take(chart)
         type(chart_t), intent(in) :: chart

         if (size(chart%traces) == 0) return
         used = used + 1
         drawn(used) = chart
         call join_sides(drawn(used))
         call set_level(drawn(used))
      end subroutine take

   end subroutine test_charts

   !> Sets on every curve of a chart the states at which a stop is in contact.
   pure subroutine set_contact(chart, is_in_contact)
      type(chart_t), intent(inout) :: chart
      logical, intent(in) :: is_in_contact(:)
      integer :: k

      do k = 1, size(chart%traces)
         chart%traces(k)%in_contact = is_in_contact
      end do
   end subroutine set_contact

   !> Joins the curves of the two sides if they are equal within a thousandth of the least span. Either both have the same
   !> abscissa, or one has the abscissa of the other in reverse order.
   pure subroutine join_sides(chart)
      type(chart_t), intent(inout) :: chart
      logical :: is_twin(size(chart%traces))
      real(wp) :: near
      integer :: k, l, n

      is_twin = .false.
      do k = 2, size(chart%traces)
         do l = 1, k - 1
            if (is_twin(l) .or. is_twin(k)) cycle
            associate (left => chart%traces(l), right => chart%traces(k))
               if (index(left%title, 'left') /= 1 .or. index(right%title, 'right') /= 1) cycle
               if (left%title(5:) /= right%title(6:)) cycle
               n = size(right%x)
               near = 1.0e-6_wp*maxval(abs(left%x), mask=ieee_is_finite(left%x))
               is_twin(k) = all_same(left%x, right%x, near) .and. all_same(left%y, right%y, 1.0e-3_wp*chart%noise)
               ! each over its own travel, one up while the other goes down
               if (.not. is_twin(k)) is_twin(k) = all_same(left%x, right%x(n:1:-1), near) .and. &
                  all_same(left%y, right%y(n:1:-1), 1.0e-3_wp*chart%noise)
               if (.not. is_twin(k)) cycle
               if (left%title == 'left') left%title = both_sides
               if (index(left%title, 'left_') == 1) left%title = left%title(6:)//' ('//both_sides//')'
            end associate
         end do
      end do
      if (any(is_twin)) chart%traces = pack(chart%traces, .not. is_twin)
   end subroutine join_sides

   !> Whether two curves are equal within a tolerance, at all points with values.
   pure logical function all_same(a, b, tolerance)
      real(wp), intent(in) :: a(:), b(:), tolerance
      integer :: k

      all_same = size(a) == size(b)
      if (.not. all_same) return
      do k = 1, size(a)
         if (ieee_is_finite(a(k)) .neqv. ieee_is_finite(b(k))) all_same = .false.
         if (ieee_is_finite(a(k)) .and. ieee_is_finite(b(k))) all_same = all_same .and. abs(a(k) - b(k)) <= tolerance
      end do
   end function all_same

   !> A chart of a test, still without curves. States that do not form a path, such as the rows of a load table, are drawn as
   !> points.
   pure type(chart_t) function chart_of(test, name, title, label) result(chart)
      type(test_result_t), intent(in) :: test
      character(*), intent(in) :: name, title, label

      chart = new_chart(test%name//'_'//name, title, label, test%label)
      chart%has_points = is_scattered(test%kind)
   end function chart_of

   !> The chart of a quantity of every wheel, or of the axle, over the abscissa of the test. The chart has no curves if there
   !> is no such column.
   pure type(chart_t) function quantity_chart(test, quantity) result(chart)
      type(test_result_t), intent(in) :: test
      type(quantity_t), intent(in) :: quantity
      character(:), allocatable :: title, label
      integer :: wheel, place, at

      title = trim(quantity%title)
      label = label_of(quantity)
      if (size(test%prefixes) < 2) then
         title = without_phase(title)
         label = without_phase(label)
      end if
      at = index(title, ', in phase')
      if (at > 0) then                ! too long for a heading
         label = unit_text(unit_of(trim(quantity%name)))//'    ('//title(at + 2:)//')'
         title = title(:at - 1)
      end if
      chart = chart_of(test, trim(quantity%name), title, label)
      chart%noise = quantity%span
      if (index(quantity%name, '_arm_length_mm') > 0) chart%cap = longest_arm
      if (unit_of(trim(quantity%name)) == 'm') chart%cap = widest_circle
      place = column_index(test%table, quantity%name)
      if (place > 0) then
         call add_column(chart, test, 1, place, '', merge(1, 3, size(test%prefixes) < 2), 0)
         return
      end if
      do wheel = 1, size(test%prefixes)
         place = column_index(test%table, trim(test%prefixes(wheel))//quantity%name)
         if (place > 0) call add_column(chart, test, wheel, place, wheel_word(test%prefixes(wheel)), wheel, merge(1, 0, wheel > 1))
      end do
   end function quantity_chart

   !> The program whose definitions a table has, from its header; '' for a table of elastokin.
   pure function program_of(table) result(program)
      type(table_t), intent(in) :: table
      character(:), allocatable :: program
      integer :: k

      program = ''
      do k = 1, table%header%count()
         if (index(table%header%line(k), definitions_mark) /= 1) cycle
         program = table%header%line(k)
         program = program(len(definitions_mark) + 1:)
         program = program(:index(program//' ', ' ') - 1)
         return
      end do
   end function program_of

   !> The chart of a definition of another program: a curve for each wheel or element, or for the axle. The least span is that of
   !> the nearest quantity of elastokin.
   pure type(chart_t) function defined_chart(test, row) result(chart)
      type(test_result_t), intent(in) :: test
      type(definition_t), intent(in) :: row
      character(:), allocatable :: label, name, of, head
      type(quantity_t) :: nearest
      integer :: k, last

      label = trim(row%unit)
      if (row%positive /= '') label = label//'    (+ '//trim(row%positive)//')'
      name = trim(row%name)
      do k = 1, len(name)
         if (verify(name(k:k), '0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz') > 0) name(k:k) = '_'
      end do
      chart = chart_of(test, name, trim(row%name), label)
      nearest = quantity_named(trim(row%ours))
      chart%noise = nearest%span*unit_size(trim(row%ours))/own_unit_size(row%unit)
      head = heading(row, '')
      do k = 1, size(test%table%columns)
         last = len_trim(test%table%columns(k)) - len(head)
         if (last < 0) cycle
         if (test%table%columns(k) (last + 1:) /= head) cycle
         of = trim(test%table%columns(k) (:last))
         if (last > 0) then
            if (test%table%columns(k) (last:last) /= ' ' .or. scan(of, ' ') > 0) cycle      ! another name with the same ending
         end if
         chart%has_key = chart%has_key .or. .not. any(of == [character(5) :: '', 'left', 'right'])
         call add_column(chart, test, side_of(test, of), k, of, merge(2, 1, index(of, 'right') == 1), &
            merge(1, 0, index(of, 'right') == 1))
      end do
      do k = 1, merge(size(chart%traces), 0, chart%has_key)
         chart%traces(k)%colour = k
      end do
   end function defined_chart

   !> The chart of all columns with a suffix, labelled by the name before the suffix. Only the first eight columns are drawn.
   !> The columns of wheels and axle are omitted.
   pure type(chart_t) function ending_chart(test, name, ending, title, label, noise) result(chart)
      type(test_result_t), intent(in) :: test
      character(*), intent(in) :: name, ending, title, label
      real(wp), intent(in) :: noise              !! least span of the y axis, in the unit of the column
      character(name_length) :: stem
      integer :: k, place, columns

      columns = 0
      chart = chart_of(test, name, title, label)
      chart%has_key = .true.
      chart%noise = noise
      do k = 1, size(test%table%columns)
         place = len_trim(test%table%columns(k)) - len(ending)
         if (place < 1) cycle
         if (test%table%columns(k) (place + 1:) /= ending) cycle
         stem = test%table%columns(k) (:place)
         if (any(stem == [character(14) :: 'vertical', 'roll', 'left_vertical', 'right_vertical'])) cycle   ! of the wheel, the axle
         columns = columns + 1
         if (size(chart%traces) >= max_curves) cycle
         call add_column(chart, test, side_of(test, stem), k, trim(stem), colour_of(chart, trim(stem)), &
            merge(1, 0, index(stem, 'right_') == 1))
      end do
      if (size(chart%traces) >= max_curves .and. columns > max_curves) chart%y_label = chart%y_label//'    (the first '// &
         str(max_curves)//' of '//str(columns)//')'
   end function ending_chart

   !> The index of a colour: for a right element the colour of the corresponding left element, otherwise the next free colour.
   pure integer function colour_of(chart, name) result(colour)
      type(chart_t), intent(in) :: chart
      character(*), intent(in) :: name
      integer :: k

      colour = maxval([0, chart%traces%colour]) + 1
      if (index(name, 'right_') /= 1) return
      do k = 1, size(chart%traces)
         if (chart%traces(k)%title == 'left_'//name(7:)) colour = chart%traces(k)%colour
      end do
   end function colour_of

   !> The chart of the force magnitude of every bushing and joint that carries a force. Of more than eight, the elements with
   !> the largest force are drawn.
   pure type(chart_t) function bushing_chart(test, elements) result(chart)
      type(test_result_t), intent(in) :: test
      character(*), intent(in), optional :: elements(:)    !! restriction to these elements; absent: all with _fx_n, _fy_n, _fz_n
      real(wp), allocatable :: force(:, :)
      character(name_length), allocatable :: names(:)
      integer :: k, carrying

      chart = chart_of(test, 'bushings', 'Bushings and joints', 'force, magnitude, N')
      chart%has_key = .true.
      chart%noise = 20.0_wp
      call largest_forces(test%table, converged_rows(test%table), names, force, carrying, elements)
      if (size(names) < carrying) chart%y_label = chart%y_label//'    (the '//str(size(names))//' largest of '// &
         str(carrying)//')'
      do k = 1, size(names)
         call add_curve(chart, test, side_of(test, names(k)), '(sqrt(column("'//trim(names(k))//'_fx_n")**2 + column("'// &
            trim(names(k))//'_fy_n")**2 + column("'//trim(names(k))//'_fz_n")**2))', force(:, k), trim(names(k)), k, 0)
      end do
   end function bushing_chart

   !> Finds the elements with columns _fx_n, _fy_n and _fz_n that carry a force, in the order of the columns, and the
   !> magnitudes of their forces. If there are more elements than fit in a chart, the elements with the largest force are
   !> returned.
   pure subroutine largest_forces(table, is_good, names, force, carrying, elements)
      type(table_t), intent(in) :: table
      logical, intent(in) :: is_good(:)                    !! rows to consider
      character(name_length), allocatable, intent(out) :: names(:)
      real(wp), allocatable, intent(out) :: force(:, :)    !! [N] (row, name); NaN in rows that are not considered
      integer, intent(out) :: carrying                     !! number of elements that carry a force
      character(*), intent(in), optional :: elements(:)    !! restriction to these elements
      character(*), parameter :: ending = '_fx_n'
      real(wp) :: peak(size(table%columns)), least
      integer :: places(3), k, row, n, at

      n = size(table%columns)
      allocate (names(n), force(row_count(table), n))
      force = ieee_value(1.0_wp, ieee_quiet_nan)
      n = 0
      do k = 1, size(table%columns)
         at = len_trim(table%columns(k)) - len(ending)
         if (at < 1) cycle
         if (table%columns(k) (at + 1:) /= ending) cycle
         if (present(elements)) then
            if (.not. any(elements == table%columns(k) (:at))) cycle
         end if
         places = [k, column_index(table, table%columns(k) (:at)//'_fy_n'), column_index(table, table%columns(k) (:at)//'_fz_n')]
         if (any(places == 0)) cycle
         n = n + 1
         names(n) = table%columns(k) (:at)
         peak(n) = 0.0_wp
         do row = 1, row_count(table)
            if (.not. is_good(row) .or. .not. all(ieee_is_finite(table%values(places, row)))) cycle
            force(row, n) = norm2(table%values(places, row))
            peak(n) = max(peak(n), force(row, n))
         end do
      end do
      least = 0.0_wp
      carrying = count(peak(:n) > least)
      do while (count(peak(:n) > least) > max_curves)
         least = minval(peak(:n), mask=peak(:n) > least)
      end do
      names = pack(names(:n), peak(:n) > least)
      force = force(:, pack([(k, k=1, n)], peak(:n) > least))
   end subroutine largest_forces

   !> Adds a column as a curve.
   pure subroutine add_column(chart, test, wheel, place, title, colour, dash)
      type(chart_t), intent(inout) :: chart
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: wheel, place, colour, dash
      character(*), intent(in) :: title

      call add_curve(chart, test, wheel, trim(test%table%columns(place)), test%table%values(place, :), title, colour, dash)
   end subroutine add_column

   !> Adds a curve over the abscissa of a wheel. Nothing is added if the curve has no value in a converged state, or if the table
   !> lacks the abscissa.
   pure subroutine add_curve(chart, test, wheel, column, y, title, colour, dash)
      type(chart_t), intent(inout) :: chart
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: wheel, colour, dash
      character(*), intent(in) :: column, title      !! column, or expression of columns
      real(wp), intent(in) :: y(:)
      type(trace_t) :: trace
      logical :: is_good(size(y))
      integer :: over, design

      over = wheel_column(test, wheel, test%abscissa)
      if (over == 0) return
      trace%title = title                            ! gfortran 12 leaks it in a structure constructor
      trace%over = trim(test%table%columns(over))
      trace%column = column
      trace%colour = colour
      trace%dash = dash
      trace%x = test%table%values(over, :)
      where (ieee_is_finite(trace%x)) trace%x = trace%x*test%abscissa_size
      trace%y = y
      is_good = converged_rows(test%table)
      where (.not. is_good) trace%y = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. any(ieee_is_finite(trace%y))) return
      design = design_row(test%table)
      if (design > 0) trace%mark = [trace%x(design), trace%y(design)]
      call add_trace(chart, trace)
   end subroutine add_curve

   !> Index of the wheel on the side of an element, from the name of the element; 1 if the name has no side.
   pure integer function side_of(test, name) result(wheel)
      type(test_result_t), intent(in) :: test
      character(*), intent(in) :: name
      integer :: k

      wheel = 1
      do k = 2, size(test%prefixes)
         if (index(name, trim(test%prefixes(k))) == 1) wheel = k
      end do
   end function side_of

end module ek_test_charts
