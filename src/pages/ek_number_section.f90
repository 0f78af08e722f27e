!> The key numbers of a report on its page: the summary with the curve of each number, and all other key numbers by group.
!> A sparkline is the curve of a key number over its test, the size of a word.
module ek_number_section
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_key_number, only: key_number_t
   use ek_explanation, only: parts_of
   use ek_number_words, only: steer_effect, target_verdict, short_name, is_equal, is_opposite, sides_text
   use ek_verdict, only: verdict_t, verdict_lines
   use ek_page, only: page_t, begin_section, add_markup, page_number, verdict_html
   use ek_report_content, only: report_t
   use ek_summary, only: summary_numbers, kept_number, relation_to
   use ek_html, only: escape_html
   use ek_text, only: str
   use ek_decimal, only: decimal
   use ek_buffer, only: buffer_t
   use ek_table, only: column_index
   use ek_test_result, only: test_result_t, wheel_column, unfolded_rows, design_row
   use ek_quantity, only: quantity_t, quantity_named
   use ek_key_numbers, only: without_side
   implicit none(type, external)
   private
   public :: add_summary, add_other_numbers, sparkline

   real(wp), parameter :: width = 120.0_wp, height = 30.0_wp, margin = 3.0_wp

contains

   !> Adds the summary at the top of the report: the verdicts, and the main key numbers as cards. Without main key numbers,
   !> adds nothing.
   subroutine add_summary(page, report)
      type(page_t), intent(inout) :: page
      type(report_t), intent(in) :: report
      integer, allocatable :: places(:)
      character(48) :: effect
      integer :: k

      allocate (places, source=summary_numbers(report%numbers))
      if (size(places) == 0) return
      call begin_section(page, 'summary', 'Summary')
      call add_verdicts(page, report)
      call add_markup(page, '<ul class="cards">')
      do k = 1, size(places)
         associate (number => report%numbers(places(k)))
            call add_markup(page, '<li data-number="'//escape_html(number%name)//'"><span class="name">'// &
               escape_html(short_name(number))//'</span>')
            call add_markup(page, '<span class="value">'//values_of(number)//'</span>')
            call add_markup(page, sparkline(number, report%tests))
            effect = steer_effect(number, report%axle%position)
            if (effect /= '') call add_markup(page, '<span class="effect">'//escape_html(trim(effect))//'</span>')
            call add_markup(page, target_of(number))
            if (number%held /= '') call add_markup(page, '<span class="held">'//escape_html(trim(number%held))//'</span>')
            call add_markup(page, taken_apart(report, number%name))
            call add_markup(page, details_of(report%numbers, places(k))//'</li>')
         end associate
      end do
      call add_markup(page, '</ul>')
   end subroutine add_summary

   !> Adds one line per domain with its main key numbers and whether they are inside their bands.
   subroutine add_verdicts(page, report)
      type(page_t), intent(inout) :: page
      type(report_t), intent(in) :: report
      type(verdict_t), allocatable :: lines(:)
      character(:), allocatable :: mark
      integer :: k

      call verdict_lines(report, lines)
      call add_markup(page, '<dl class="verdicts">')
      do k = 1, size(lines)
         mark = ''
         if (lines(k)%verdict /= '') mark = verdict_html(trim(lines(k)%verdict))
         call add_markup(page, '<div><dt>'//escape_html(trim(lines(k)%domain))//'</dt><dd>'//escape_html(lines(k)%text)//mark// &
            '</dd></div>')
      end do
      call add_markup(page, '</dl>')
   end subroutine add_verdicts

   !> The parts of a rate in percent, as HTML; '' for other key numbers, and if the parts are not known.
   function taken_apart(report, name) result(html)
      type(report_t), intent(in) :: report
      character(*), intent(in) :: name
      character(:), allocatable :: html

      html = ''
      if (.not. allocated(report%explanations)) return
      select case (name)
      case ('wheel_rate')
         html = parts_of(report%explanations, 'left_wheel_rate_n_per_mm')
         if (html == '') html = parts_of(report%explanations, 'wheel_rate_n_per_mm')
      case ('suspension_roll_rate_nm_per_deg')
         html = parts_of(report%explanations, name)
      end select
      if (html /= '') html = '<span class="held">'//escape_html(html)//'</span>'
   end function taken_apart

   !> Adds all other key numbers, each once. A number that repeats another is named next to the number that is shown.
   subroutine add_other_numbers(page, report)
      type(page_t), intent(inout) :: page
      type(report_t), intent(in) :: report
      logical, allocatable :: is_shown(:)
      character(:), allocatable :: group
      integer :: k

      allocate (is_shown(size(report%numbers)), source=.true.)
      is_shown(summary_numbers(report%numbers)) = .false.
      do k = 1, size(report%numbers)
         if (kept_number(report%numbers, k) > 0) is_shown(k) = .false.
      end do
      if (.not. any(is_shown)) return
      call begin_section(page, 'key-numbers', 'Key numbers', is_printed=.false.)
      group = ''
      do k = 1, size(report%numbers)
         if (.not. is_shown(k)) cycle
         associate (number => report%numbers(k))
            if (number%group /= group) then
               if (group /= '') call add_markup(page, '</tbody></table></div>')
               group = number%group
               call add_markup(page, '<div class="scroll" tabindex="0"><table class="numbers"><caption>'//escape_html(group)// &
                  '</caption><thead><tr><th scope="col">Quantity</th><th scope="col" class="n">Value</th>'// &
                  '<th scope="col">Unit</th><th scope="col">Sign</th></tr></thead><tbody>')
            end if
            call add_markup(page, '<tr><th scope="row">'//escape_html(short_name(number))//held_of(number)// &
               details_of(report%numbers, k)//'</th><td class="n" data-number="'//escape_html(number%name)//'">'// &
               pair_of(number)//opposite_of(number)//'</td><td>'//escape_html(number%unit)// &
               '</td><td class="s">'//escape_html(number%sign)//target_of(number)//'</td></tr>')
         end associate
      end do
      call add_markup(page, '</tbody></table></div>')
   end subroutine add_other_numbers

   !> Formula and condition of a key number, folded, and the equivalent numbers, as HTML.
   function details_of(numbers, k) result(html)
      type(key_number_t), intent(in) :: numbers(:)
      integer, intent(in) :: k
      character(:), allocatable :: html
      integer :: j

      html = '<details class="how"><summary>how</summary><p>'//escape_html(numbers(k)%definition)//'. '// &
         escape_html(numbers(k)%condition)//'.'
      if (allocated(numbers(k)%reason)) html = html//' No value: '//escape_html(numbers(k)%reason)//'.'
      do j = 1, size(numbers)
         if (kept_number(numbers, j) /= k) cycle
         html = html//' '//relation_to(numbers(j)%name)//' '//escape_html(numbers(j)%quantity)//': '//pair_of(numbers(j))//' '// &
            escape_html(numbers(j)%unit)//opposite_of(numbers(j))//' ('//escape_html(numbers(j)%condition)//').'
      end do
      html = html//' Name: <code>'//escape_html(numbers(k)%name)//'</code></p></details>'
   end function details_of

   !> Value and unit of a key number as HTML: '−3.21 deg/m'. If both wheels have equal or opposite values, the meaning follows
   !> (sides_text): 'both wheels to the left'.
   function values_of(number) result(html)
      type(key_number_t), intent(in) :: number
      character(:), allocatable :: html

      html = '<b>'//pair_of(number)//'</b> '
      if (number%unit /= '–') html = html//escape_html(number%unit)
      if (sides_text(number) /= '') html = html//' <small>'//sides_text(number)//'</small>'
   end function values_of

   !> The value of a key number as HTML. For the axle, or if both wheels have equal or opposite values to the printed digits,
   !> it is one value (`left`). Otherwise it is the left and the right value, or the only value.
   function pair_of(number) result(html)
      type(key_number_t), intent(in) :: number
      character(:), allocatable :: html, right

      html = page_number(number%left)
      if (number%is_of_axle .or. is_equal(number) .or. is_opposite(number)) return
      right = page_number(number%right)
      if (ieee_is_finite(number%left) .and. ieee_is_finite(number%right)) then
         html = '<span title="left">'//html//'</span> <i>|</i> <span title="right">'//right//'</span>'
      else if (ieee_is_finite(number%right)) then
         html = right
      end if
   end function pair_of

   !> The meaning of opposite values of both wheels, as HTML; '' for other values.
   function opposite_of(number) result(html)
      type(key_number_t), intent(in) :: number
      character(:), allocatable :: html

      html = ''
      if (is_opposite(number)) html = ' <small>'//sides_text(number)//'</small>'
   end function opposite_of

   function held_of(number) result(html)
      type(key_number_t), intent(in) :: number
      character(:), allocatable :: html

      html = ''
      if (number%held /= '') html = ' <span class="held">'//escape_html(trim(number%held))//'</span>'
   end function held_of

   !> The verdict on a number with a target in the deck, as HTML; '' without a target.
   function target_of(number) result(html)
      type(key_number_t), intent(in) :: number
      character(:), allocatable :: html, text

      html = ''
      if (target_verdict(number) == '') return
      html = trim(target_verdict(number))
      if (number%target(1) > -huge(1.0_wp) .and. number%target(2) < huge(1.0_wp)) then
         text = page_number(number%target(1))//' … '//page_number(number%target(2))
      else if (number%target(1) > -huge(1.0_wp)) then
         text = '≥ '//page_number(number%target(1))
      else
         text = '≤ '//page_number(number%target(2))
      end if
      html = ' <span class="target '//html//'">'//html//' target '//text//'</span>'
   end function target_of

   !> An SVG element with the curve of the left wheel or of the axle, the curve of the right wheel behind it, and a dot at
   !> design. '' if the key number has no source, or its test has fewer than two states with values.
   function sparkline(number, tests) result(svg)
      type(key_number_t), intent(in) :: number
      type(test_result_t), intent(in) :: tests(:)
      character(:), allocatable :: svg
      type(buffer_t) :: out
      type(quantity_t) :: quantity
      real(wp) :: x_range(2), y_range(2), span
      logical, allocatable :: is_good(:)
      integer :: y(2), x(2), wheel, row

      svg = ''
      if (size(number%sources) == 0) return
      associate (source => number%sources(1), test => tests(number%sources(1)%test))
         if (.not. test%is_run) return
         is_good = unfolded_rows(test%table)
         do wheel = 1, 2
            y(wheel) = column_index(test%table, source%column(wheel))
            x(wheel) = wheel_column(test, min(wheel, max(1, size(test%prefixes))), test%abscissa)
            if (source%column(wheel) == '' .or. x(wheel) == 0) y(wheel) = 0
         end do
         x_range = [huge(1.0_wp), -huge(1.0_wp)]
         y_range = x_range
         do wheel = 1, 2
            if (y(wheel) == 0) cycle
            associate (values => test%table%values)
               is_good = is_good .and. ieee_is_finite(values(y(wheel), :)) .and. ieee_is_finite(values(x(wheel), :))
               x_range = [min(x_range(1), minval(values(x(wheel), :), mask=is_good)), &
                  max(x_range(2), maxval(values(x(wheel), :), mask=is_good))]
               y_range = [min(y_range(1), minval(values(y(wheel), :), mask=is_good)), &
                  max(y_range(2), maxval(values(y(wheel), :), mask=is_good))]
            end associate
         end do
         if (count(is_good) < 2 .or. .not. x_range(2) > x_range(1)) return
         quantity = quantity_named(without_side(trim(source%column(merge(1, 2, y(1) > 0)))))
         span = quantity%span
         if (.not. span > 0.0_wp) span = max(0.05_wp*maxval(abs(y_range)), 1.0e-3_wp)
         if (y_range(2) - y_range(1) < span) y_range = (y_range(1) + y_range(2))/2 + [-span, span]

         call out%add('<svg class="spark" viewBox="0 0 '//str(width)//' '//str(height)//'" '// &
            'preserveAspectRatio="none" aria-hidden="true">')
         do wheel = 2, 1, -1
            if (y(wheel) == 0) cycle
            call out%add('<polyline class="c'//str(wheel)//'" points="')
            do row = 1, size(is_good)
               if (is_good(row)) call out%add(point(row)//' ')
            end do
            call out%add('"/>')
         end do
         row = design_row(test%table)
         wheel = merge(1, 2, y(1) > 0)
         if (row > 0) call out%add('<path class="at" d="M'//across(row)//' '//down(row)//'h0"/>')
         call out%add('</svg>')
         svg = out%text()

      end associate

   contains

      !> The point of a row as 'x,y'.
      function point(row) result(text)
         integer, intent(in) :: row
         character(:), allocatable :: text
         text = across(row)//','//down(row)
      end function point

      !> The horizontal position of a row [pixels].
      function across(row) result(text)
         integer, intent(in) :: row
         character(:), allocatable :: text
         text = pixels(margin + (width - 2*margin)*(tests(number%sources(1)%test)%table%values(x(wheel), row) - x_range(1))/ &
            (x_range(2) - x_range(1)))
      end function across

      !> The vertical position of a row [pixels], positive downward.
      function down(row) result(text)
         integer, intent(in) :: row
         character(:), allocatable :: text
         text = pixels(height - margin - (height - 2*margin)* &
            (tests(number%sources(1)%test)%table%values(y(wheel), row) - y_range(1))/(y_range(2) - y_range(1)))
      end function down

   end function sparkline

   !> A coordinate as a string, to a hundredth of a pixel.
   pure function pixels(coordinate) result(text)
      real(wp), intent(in) :: coordinate
      character(:), allocatable :: text

      text = decimal(anint(100.0_wp*coordinate)/100.0_wp)
   end function pixels

end module ek_number_section
