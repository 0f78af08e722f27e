!> data.json: the content of the page of a report, without repetition: facts, key numbers, and the curves of every test. The page
!> contains the same object as a block of data, from which its charts are drawn. schema/data.schema.json describes the object.
module ek_report_data
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_decimal, only: rounded
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_letters, only: as_utf8
   use ek_json, only: json_t, json_string, json_strings, json_number, json_numbers, without_tags
   use ek_test_result, only: test_result_t, design_row, wheel_column, unfolded_rows, converged_rows
   use ek_measurement, only: measurement_t
   use ek_table, only: table_t, column_index
   use ek_chart_axis, only: free_range, extremes
   use ek_contact, only: contact_t, contacts_of
   use ek_chart, only: chart_t, trace_t, view_of
   use ek_explanation, only: parts_of
   use ek_key_number, only: key_number_t, key_source_t
   use ek_key_numbers, only: without_side
   use ek_assessment, only: assessment_t, assess, meaning_of
   use ek_verdict, only: add_assessment
   use ek_number_words, only: steer_effect, is_opposite, sides_text, wheel_values, limits_text
   use ek_quantity, only: quantity_t, quantity_named
   use ek_summary, only: summary_numbers, kept_number, relation_to
   use ek_report_content, only: report_t
   use ek_figure_data, only: add_figures
   use ek_live_data, only: add_live_data
   use ek_turntable, only: add_turntable
   implicit none(type, external)
   private
   public :: report_data, comparison_data, format_name

   character(*), parameter :: format_name = 'elastokin report data 1', comparison_name = 'elastokin comparison data 1'
   integer, parameter :: figures = 6            !! significant digits of a curve: more than a screen resolves

contains

   !> The data of a report as JSON. The string has no '<', so that it can be inserted into a page unchanged.
   function report_data(report) result(text)
      type(report_t), intent(in) :: report
      character(:), allocatable :: text
      type(json_t) :: json
      type(key_number_t), allocatable :: shown(:)     ! a copy: gfortran 12 leaks the components of an argument numbers(cards)
      integer, allocatable :: cards(:)
      integer :: k

      allocate (cards, source=summary_numbers(report%numbers, report%axle))
      allocate (shown(size(cards)))
      do k = 1, size(cards)
         shown(k) = report%numbers(cards(k))
      end do
      json%is_one_line = .true.
      call json%open('{')
      call json%item('format', json_string(format_name))
      call json%item('title', json_string(as_utf8(report%title)))
      call json%open('{', 'facts')
      do k = 1, report%names%count()
         call json%item(report%names%line(k), json_string(as_utf8(report%values%line(k))))
      end do
      call json%close('}')
      call json%open('[', 'deck')
      do k = 1, report%deck_paths%count()
         call json%item_of_list('['//json_string(as_utf8(report%deck_paths%line(k)))//', '// &
            json_string(as_utf8(report%deck_texts%line(k)))//']')
      end do
      call json%close(']')
      call add_assessment(json, report)
      call json%open('[', 'numbers')
      do k = 1, size(report%numbers)
         call add_number(json, report, k, any(cards == k))
      end do
      call json%close(']')
      call json%open('[', 'tests')
      do k = 1, size(report%tests)
         if (report%tests(k)%is_run) call add_test(json, report%tests(k), report%charts, k, '', &
            shown, report%measured)
      end do
      call json%close(']')
      if (allocated(report%figures)) call add_figures(json, report%figures)
      if (allocated(report%turntable)) call add_turntable(json, report%turntable)
      if (allocated(report%live)) call add_live_data(json, report%live, report%numbers)
      call json%close('}')
      text = without_tags(json%text())
   end function report_data

   !> The data of a comparison for its page: the tests of the first result with the charts of all results.
   function comparison_data(tests, charts) result(text)
      type(test_result_t), intent(in) :: tests(:)      !! tests of the first result
      type(chart_t), intent(in) :: charts(:)
      character(:), allocatable :: text
      type(json_t) :: json
      integer :: k

      json%is_one_line = .true.
      call json%open('{')
      call json%item('format', json_string(comparison_name))
      call json%open('[', 'tests')
      do k = 1, size(tests)
         if (any(charts%test == k)) call add_test(json, tests(k), charts, k, 'A, ')      ! the stops of the first result
      end do
      call json%close(']')
      call json%close('}')
      text = without_tags(json%text())
   end function comparison_data

   !> Adds a key number: its values, and the strings with which a page shows them.
   subroutine add_number(json, report, k, is_card)
      type(json_t), intent(inout) :: json
      type(report_t), intent(in) :: report
      integer, intent(in) :: k
      logical, intent(in) :: is_card                  !! the number is one of the summary, with its curve
      type(message_list_t) :: values
      type(assessment_t) :: assessment
      integer :: kept

      associate (number => report%numbers(k))
         call json%open('{')
         call json%item('name', json_string(number%name))
         call json%item('group', json_string(number%group))
         call json%item('title', json_string(number%quantity))
         call json%item('unit', json_string(number%unit))
         call json%item('left', json_number(number%left))
         if (.not. number%is_of_axle .and. ieee_is_finite(number%right)) call json%item('right', json_number(number%right))
         values = wheel_values(number)
         if (values%count() == 1) call json%item('shown', json_string(values%line(1)))
         if (values%count() > 1) call json%item('shown', json_strings(values))
         call add_words('sides', sides_text(number))
         if (is_opposite(number)) call json%item('is_opposite', 'true')
         call json%item('sign', json_string(number%sign))
         call json%item('held', json_string(trim(number%held)))
         call json%item('condition', json_string(number%condition))
         call json%item('definition', json_string(number%definition))
         if (allocated(number%reason)) call add_words('reason', number%reason)
         call add_words('effect', trim(steer_effect(number, report%axle%position)))
         call add_words('meaning', meaning_of(number, report%axle, report%numbers))
         call assess(number, report%axle, report%numbers, assessment)
         if (number%has_target) then
            call json%item('target', json_numbers([limit_of(number%target(1)), limit_of(number%target(2))]))
         else if (assessment%usual%is_known) then
            call json%item('usual', json_numbers([assessment%usual%low, assessment%usual%high]))
            call json%item('source', json_string(assessment%usual%source))
         end if
         if (number%has_target .or. assessment%usual%is_known) call json%item('verdict', json_string(trim(assessment%word)))
         if (number%has_target .and. assessment%word /= '') call add_words('band', limits_text(number%target))
         if (.not. number%has_target .and. assessment%usual%is_known) call add_words('band', &
            limits_text([assessment%usual%low, assessment%usual%high]))
         call add_words('parts', parts_of_rate(report, number%name))
         kept = kept_number(report%numbers, k)
         if (kept > 0) then
            call json%item('instead', str(kept - 1))
            call json%item('relation', json_string(relation_to(number%name)))
         end if
         if (is_card .and. size(number%sources) > 0) then
            if (report%tests(number%sources(1)%test)%is_run) &
               call add_curve(json, report%tests(number%sources(1)%test), number%sources(1))
         end if
         call json%close('}')
      end associate

   contains

      subroutine add_words(key, words)
         character(*), intent(in) :: key, words
         if (words /= '') call json%item(key, json_string(words))
      end subroutine add_words

   end subroutine add_number

   !> The parts of a rate in percent; '' for other key numbers, and if the parts are not known.
   function parts_of_rate(report, name) result(words)
      type(report_t), intent(in) :: report
      character(*), intent(in) :: name
      character(:), allocatable :: words

      words = ''
      if (.not. allocated(report%explanations)) return
      if (name == 'wheel_rate') words = parts_of(report%explanations, 'left_wheel_rate_n_per_mm')
      if (name == 'wheel_rate' .and. words == '') words = parts_of(report%explanations, 'wheel_rate_n_per_mm')
      if (name == 'suspension_roll_rate_nm_per_deg') words = parts_of(report%explanations, name)
   end function parts_of_rate

   !> Adds the curve of a key number over its test: the columns of the left and the right wheel, the states on the branch through
   !> design, and the least span of its axis.
   subroutine add_curve(json, test, source)
      type(json_t), intent(inout) :: json
      type(test_result_t), intent(in) :: test
      type(key_source_t), intent(in) :: source
      type(message_list_t) :: names(2)
      type(quantity_t) :: quantity
      logical :: is_shown(size(test%table%values, 2))
      integer :: wheel, column, pass

      do pass = 1, 2
         do wheel = 1, 2
            column = column_of_card(test, source, wheel, pass)
            if (column > 0) call names(pass)%add(trim(test%table%columns(column)))
            if (column == 0) call names(pass)%add('')
         end do
      end do
      is_shown = unfolded_rows(test%table)
      call json%open('{', 'curve')
      call json%item('test', json_string(test%name))
      call json%item('x', json_strings(names(1)))
      call json%item('y', json_strings(names(2)))
      call json%item('first', str(findloc(is_shown, .true., dim=1) - 1))
      call json%item('last', str(findloc(is_shown, .true., dim=1, back=.true.) - 1))
      quantity = quantity_named(without_side(trim(source%column(merge(1, 2, source%column(1) /= '')))))
      if (quantity%span > 0.0_wp) call json%item('span', json_number(quantity%span))
      call json%close('}')
   end subroutine add_curve

   !> A limit of a target; NaN, which is written as null, if there is no limit.
   pure real(wp) function limit_of(target)
      real(wp), intent(in) :: target

      limit_of = target
      if (.not. abs(target) < huge(1.0_wp)) limit_of = ieee_value(1.0_wp, ieee_quiet_nan)
   end function limit_of

   !> Adds a test: its abscissae and columns, each once, and the charts, which refer to columns by name.
   subroutine add_test(json, test, charts, number, of, cards, measured)
      type(json_t), intent(inout) :: json
      type(test_result_t), intent(in) :: test
      type(chart_t), intent(in) :: charts(:)
      integer, intent(in) :: number                   !! index of the test
      character(*), intent(in) :: of                  !! prefix of the names of stops: the result to which they belong
      type(key_number_t), intent(in), optional :: cards(:)      !! key numbers of the summary, whose curves are columns, too
      type(measurement_t), intent(in), optional :: measured(:)
      type(message_list_t) :: written
      integer :: k, l, pass

      call json%open('{')
      call json%item('name', json_string(test%name))
      call json%item('title', json_string(as_utf8(test%title)))
      call json%item('held', json_string(trim(test%held)))
      call json%item('file', json_string(as_utf8(test%file)))
      call json%item('label', json_string(as_utf8(test%label)))
      call json%item('design', str(design_row(test%table) - 1))
      call add_contacts(json, test, of)
      call json%open('[', 'charts')
      do k = 1, size(charts)
         if (charts(k)%test == number) call add_chart(json, charts(k))
      end do
      call json%close(']')
      if (present(measured)) call add_measured(json, test, charts, number, measured)
      do pass = 1, 2
         written = message_list_t()
         call json%open('{', trim(merge('x', 'y', pass == 1)))
         do k = 1, size(charts)
            if (charts(k)%test /= number) cycle
            do l = 1, size(charts(k)%traces)
               associate (trace => charts(k)%traces(l))
                  if (is_new(merge_name(trace, pass), written)) call json%item(merge_name(trace, pass), &
                     merge_numbers(trace, pass, charts(k)%noise))
               end associate
            end do
         end do
         if (present(cards)) then
            do k = 1, size(cards)
               call add_columns_of_card(json, test, cards(k), number, pass, written)
            end do
         end if
         call json%close('}')
      end do
      call json%close('}')
   end subroutine add_test

   !> Adds the measured curves of a test: the abscissa of the chart and the values at the measured points, in their order.
   subroutine add_measured(json, test, charts, number, measured)
      type(json_t), intent(inout) :: json
      type(test_result_t), intent(in) :: test
      type(chart_t), intent(in) :: charts(:)
      integer, intent(in) :: number                   !! index of the test
      type(measurement_t), intent(in) :: measured(:)
      character(:), allocatable :: over
      type(table_t) :: table
      integer :: k, l, place

      if (.not. any(measured%place == number)) return
      table = test%table
      if (allocated(test%read)) table = test%read
      call json%open('[', 'measured')
      do k = 1, size(measured)
         if (measured(k)%place /= number) cycle
         do l = 1, size(measured(k)%channels)
            associate (channel => measured(k)%channels(l), rows => measured(k)%rows)
               over = abscissa_of(trim(channel%column), charts, number)
               place = column_index(table, over)
               if (place == 0) cycle
               call json%open('{')
               call json%item('y', json_string(trim(channel%column)))
               call json%item('at', json_numbers(test%abscissa_size* &
                  pack(table%values(place, max(rows, 1)), rows > 0), figures, ','))
               call json%item('values', json_numbers(pack(channel%y, rows > 0), figures, ','))
               call json%close('}')
            end associate
         end do
      end do
      call json%close(']')
   end subroutine add_measured

   !> The column of the abscissa of the chart that shows a column; where only the left wheel is drawn, the right column belongs to the
   !> same chart. '' without a chart.
   function abscissa_of(column, charts, number) result(over)
      character(*), intent(in) :: column
      type(chart_t), intent(in) :: charts(:)
      integer, intent(in) :: number                   !! index of the test
      character(:), allocatable :: over
      integer :: k, l, pass

      over = ''
      do pass = 1, 2
         do k = 1, size(charts)
            if (charts(k)%test /= number) cycle
            do l = 1, size(charts(k)%traces)
               associate (trace => charts(k)%traces(l))
                  if (pass == 1 .and. column_of(trace) == column) over = trace%over
                  if (pass == 2 .and. index(column, 'right_') == 1) then
                     if (column_of(trace) == 'left_'//column(7:)) over = trace%over
                  end if
               end associate
               if (over /= '') return
            end do
         end do
      end do
   end function abscissa_of

  !> Adds the abscissae (pass 1) or the values (pass 2) of the curve of a card that no chart has, if it is a curve of the test.
   subroutine add_columns_of_card(json, test, card, number, pass, written)
      type(json_t), intent(inout) :: json
      type(test_result_t), intent(in) :: test
      type(key_number_t), intent(in) :: card
      integer, intent(in) :: number, pass             !! index of the test; pass
      type(message_list_t), intent(inout) :: written  !! names of abscissae or of values in the data
      real(wp) :: values(size(test%table%values, 2))
      integer :: wheel, column

      if (size(card%sources) == 0) return
      if (card%sources(1)%test /= number) return
      do wheel = 1, 2
         column = column_of_card(test, card%sources(1), wheel, pass)
         if (column == 0) cycle
         if (.not. is_new(trim(test%table%columns(column)), written)) cycle
         values = test%table%values(column, :)
         if (pass == 1) then
            where (ieee_is_finite(values)) values = values*test%abscissa_size
         else
            where (.not. converged_rows(test%table)) values = ieee_value(1.0_wp, ieee_quiet_nan)
         end if
         call json%item(trim(test%table%columns(column)), json_numbers(values, figures, ','))
      end do
   end subroutine add_columns_of_card

   !> The column of the abscissa (pass 1) or of the values (pass 2) of a wheel in the curve of a key number; 0 if the wheel has none.
   integer function column_of_card(test, source, wheel, pass) result(column)
      type(test_result_t), intent(in) :: test
      type(key_source_t), intent(in) :: source
      integer, intent(in) :: wheel, pass

      column = 0
      if (source%column(wheel) /= '') column = column_index(test%table, source%column(wheel))
      if (column > 0 .and. pass == 1) column = wheel_column(test, min(wheel, max(1, size(test%prefixes))), test%abscissa)
   end function column_of_card

   !> Adds the ranges of states in which stops are in contact; adds nothing if there are none.
   subroutine add_contacts(json, test, of)
      type(json_t), intent(inout) :: json
      type(test_result_t), intent(in) :: test
      character(*), intent(in) :: of
      type(contact_t), allocatable :: contacts(:)
      integer :: k

      allocate (contacts, source=contacts_of(test%table))
      if (size(contacts) == 0) return
      call json%open('[', 'contacts')
      do k = 1, size(contacts)
         call json%open('{')
         call json%item('stop', json_string(as_utf8(of//trim(contacts(k)%stop))))
         call json%item('first', str(contacts(k)%first - 1))
         call json%item('last', str(contacts(k)%last - 1))
         call json%close('}')
      end do
      call json%close(']')
   end subroutine add_contacts

   subroutine add_chart(json, chart)
      type(json_t), intent(inout) :: json
      type(chart_t), intent(in) :: chart
      real(wp) :: low, high
      logical :: is_cut
      integer :: k

      call view_of(chart, low, high)
      call json%open('{')
      call json%item('id', json_string(chart%name))
      call json%item('title', json_string(as_utf8(chart%title)))
      call json%item('label', json_string(as_utf8(chart%y_label)))
      call json%item('low', json_number(rounded(low, figures)))
      call json%item('high', json_number(rounded(high, figures)))
      call json%item('span', json_number(chart%noise))
      call free_range(chart, low, high, is_cut)
      if (is_cut .and. .not. chart%is_fixed) then
         call extremes(chart, huge(1.0_wp), low, high)
         call json%open('[', 'beyond')
         call json%item_of_list(json_number(rounded(low, figures)))
         call json%item_of_list(json_number(rounded(high, figures)))
         call json%close(']')
      end if
      if (chart%has_points) call json%item('points', 'true')
      if (chart%is_level) call json%item('level', 'true')
      call json%open('[', 'curves')
      do k = 1, size(chart%traces)
         associate (trace => chart%traces(k))
            call json%open('{')
            call json%item('name', json_string(as_utf8(trace%title)))
            call json%item('x', json_string(trace%over))
            call json%item('y', json_string(column_of(trace)))
            call json%item('colour', str(trace%colour))
            call json%item('dash', str(trace%dash))
            if (trace%reference > 0) call json%item('from', str(trace%reference - 1))
            if (trace%design > 0) call json%item('design', str(trace%design - 1))
            call json%close('}')
         end associate
      end do
      call json%close(']')
      call json%close('}')
   end subroutine add_chart

   !> The name of the abscissa (pass 1) or of the values (pass 2) of a curve.
   function merge_name(trace, pass) result(name)
      type(trace_t), intent(in) :: trace
      integer, intent(in) :: pass
      character(:), allocatable :: name

      if (pass == 1) then
         name = trace%over
      else
         name = column_of(trace)
      end if
   end function merge_name

   !> The column name of a curve. For an expression, which is the magnitude of a force, it is the element name with the suffix
   !> _force_magnitude_n; a curve for both sides has the name of the left element.
   function column_of(trace) result(name)
      type(trace_t), intent(in) :: trace
      character(:), allocatable :: name
      integer :: at

      name = trace%column
      if (index(name, '(') /= 1) return
      name = trace%title
      at = index(name, ' (left = right)')
      if (at > 0) name = 'left_'//name(:at - 1)
      name = name//'_force_magnitude_n'
   end function column_of

   !> The numbers of an abscissa (pass 1) or of the values of a curve (pass 2) as a JSON list. Values of a curve smaller than
   !> a millionth of the least span are rounding, and are written as 0.
   function merge_numbers(trace, pass, span) result(literal)
      type(trace_t), intent(in) :: trace
      integer, intent(in) :: pass
      real(wp), intent(in) :: span
      character(:), allocatable :: literal
      real(wp) :: values(size(trace%x))
      integer :: k

      values = trace%x
      if (pass == 2) values = trace%y
      do k = 1, merge(size(values), 0, pass == 2)
         if (.not. ieee_is_finite(values(k))) cycle
         if (abs(values(k)) < 1.0e-6_wp*span) values(k) = 0.0_wp
      end do
      literal = json_numbers(values, figures, ',')
   end function merge_numbers

   !> Whether a name is not yet in a list; a new name is appended.
   logical function is_new(name, list)
      character(*), intent(in) :: name
      type(message_list_t), intent(inout) :: list
      integer :: k

      is_new = .true.
      do k = 1, list%count()
         if (list%line(k) == name) is_new = .false.
      end do
      if (is_new) call list%add(name)
   end function is_new

end module ek_report_data
