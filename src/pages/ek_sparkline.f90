!> A sparkline: the curve of a key number over its test, the size of a word.
module ek_sparkline
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_decimal, only: decimal
   use ek_buffer, only: buffer_t
   use ek_table, only: column_index
   use ek_test_result, only: test_result_t, wheel_column, unfolded_rows, design_row
   use ek_quantity, only: quantity_t, quantity_named
   use ek_key_number, only: key_number_t
   use ek_key_numbers, only: without_side
   implicit none(type, external)
   private
   public :: sparkline

   real(wp), parameter :: width = 120.0_wp, height = 30.0_wp, margin = 3.0_wp

contains

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

end module ek_sparkline
