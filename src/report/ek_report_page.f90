!> The page of a report, from its tests, gradients and pictures.
module ek_report_page
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t
   use ek_text, only: plural
   use ek_file, only: read_whole, join_path, file_exists
   use ek_test_result, only: test_result_t, design_row, converged_rows, wheel_word
   use ek_chart, only: chart_t, picture_file
   use ek_gradient, only: gradient_t
   use ek_key_numbers, only: key_number_t, key_numbers
   use ek_page, only: page_t, begin_page, begin_section, end_section, add_paragraph, add_heading, add_warnings, add_facts, &
      begin_table, begin_row, add_cell, end_row, add_group, end_table, begin_charts, add_chart_picture, end_charts, &
      add_picture, add_data_picture, add_legend, page_text, page_number
   implicit none(type, external)
   private
   public :: report_page, add_charts

contains

   !> The text of report.html. Pictures are read from the folder if they belong to this report; missing ones are
   !> omitted.
   function report_page(title, subtitle, names, values, warnings, tests, charts, gradients, folder, has_pictures, &
      has_animation) result(text)
      character(*), intent(in) :: title, subtitle
      type(message_list_t), intent(in) :: names, values      !! facts for the head
      type(message_list_t), intent(in) :: warnings           !! on the model as a whole
      type(test_result_t), intent(in) :: tests(:)
      type(chart_t), intent(in) :: charts(:)
      type(gradient_t), intent(in) :: gradients(:)
      character(*), intent(in) :: folder                     !! of the report
      logical, intent(in) :: has_pictures, has_animation     !! those in the folder belong to this report
      character(:), allocatable :: text
      type(page_t) :: page
      integer :: k

      call begin_page(page, title, subtitle)
      call add_facts(page, names, values)
      call add_warnings(page, 'Warnings', warnings)
      if (has_pictures) call add_scene(page, title, folder, has_animation)
      call add_key_numbers(page, tests, gradients)
      do k = 1, size(tests)
         call add_test(page, tests(k), k, charts, gradients, folder, has_pictures)
      end do
      text = page_text(page)
   end function report_page

   !> The picture in space, and the animation.
   subroutine add_scene(page, title, folder, has_animation)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: title, folder
      logical, intent(in) :: has_animation
      type(error_t), allocatable :: error
      character(:), allocatable :: bytes
      logical :: has_svg, has_gif

      has_svg = file_exists(join_path(folder, 'picture.svg'))
      has_gif = has_animation
      if (has_gif) has_gif = file_exists(join_path(folder, 'animation.gif'))
      if (.not. (has_svg .or. has_gif)) return
      call begin_section(page, 'picture', 'The suspension')
      if (has_svg) then
         call read_whole(join_path(folder, 'picture.svg'), bytes, error)
         if (.not. allocated(error)) call add_picture(page, bytes, 'The suspension in space: '//title, &
            'Solid: design. Thin lines: ends of the travel. Bodies have no shape in the model; they are drawn as bars '// &
            'between their attachment points.')
      end if
      if (has_gif) then
         call read_whole(join_path(folder, 'animation.gif'), bytes, error)
         if (.not. allocated(error)) call add_data_picture(page, bytes, 'gif', 'The suspension moving: '//title, '')
      end if
      call end_section(page)
   end subroutine add_scene

   !> One table of the key numbers.
   subroutine add_key_numbers(page, tests, gradients)
      type(page_t), intent(inout) :: page
      type(test_result_t), intent(in) :: tests(:)
      type(gradient_t), intent(in) :: gradients(:)
      type(key_number_t), allocatable :: numbers(:)
      character(:), allocatable :: group
      logical :: has_sides
      integer :: k

      call key_numbers(tests, gradients, numbers)
      if (size(numbers) == 0) return
      has_sides = .false.
      do k = 1, size(tests)
         has_sides = has_sides .or. size(tests(k)%prefixes) > 1
      end do
      call begin_section(page, 'key-numbers', 'Key numbers')
      if (has_sides) then
         call begin_table(page, [character(9) :: 'Quantity', '>Left', '>Right', 'Unit', 'Sign'])
      else
         call begin_table(page, [character(9) :: 'Quantity', '>Value', 'Unit', 'Sign'])
      end if
      group = ''
      do k = 1, size(numbers)
         if (numbers(k)%group /= group) then
            group = numbers(k)%group
            call add_group(page, group)
         end if
         call begin_row(page)
         call add_cell(page, numbers(k)%quantity)
         call add_values(page, has_sides, numbers(k)%is_of_axle, numbers(k)%left, numbers(k)%right)
         call add_cell(page, numbers(k)%unit)
         call add_cell(page, numbers(k)%sign, 's')
         call end_row(page)
      end do
      call end_table(page)
      call end_section(page)
   end subroutine add_key_numbers

   !> One or two cells of numbers; a value of the axle is in the first.
   subroutine add_values(page, has_sides, is_of_axle, left, right)
      type(page_t), intent(inout) :: page
      logical, intent(in) :: has_sides, is_of_axle
      real(wp), intent(in) :: left, right

      call add_cell(page, page_number(left), 'n')
      if (.not. has_sides) return
      if (is_of_axle) then
         call add_cell(page, '', 'n')
      else
         call add_cell(page, page_number(right), 'n')
      end if
   end subroutine add_values

   !> Section of a test: warnings, charts, gradients.
   subroutine add_test(page, test, number, charts, gradients, folder, has_pictures)
      type(page_t), intent(inout) :: page
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: number              !! of the test
      type(chart_t), intent(in) :: charts(:)
      type(gradient_t), intent(in) :: gradients(:)
      character(*), intent(in) :: folder
      logical, intent(in) :: has_pictures
      character(16), allocatable :: names(:)
      type(message_list_t) :: words
      integer :: k, found

      call begin_section(page, 'test-'//test%name, test%title)
      call add_warnings(page, 'Warnings: states that failed or are doubtful', test%remarks)
      if (test%is_run) then
         found = count(converged_rows(test%table))
         call add_paragraph(page, plural(found, 'state', 'states')//' in equilibrium, plotted over '//test%label// &
            '. All columns are in '//test%file//'.')
         allocate (names(size(test%prefixes)))
         do k = 1, size(names)
            names(k) = wheel_word(test%prefixes(k))
            if (len_trim(names(k)) == 0) names(k) = merge('right wheel', 'left wheel ', test%sides(k) > 0)
         end do
         call add_legend(page, names, design_row(test%table) > 0, test%kind == 'table')
      end if
      if (has_pictures) call add_charts(page, charts, number, folder)
      call add_gradients(page, test, gradients, words)
      call end_section(page)
   end subroutine add_test

   !> The charts of a test drawn by gnuplot, side by side.
   subroutine add_charts(page, charts, test, folder)
      type(page_t), intent(inout) :: page
      type(chart_t), intent(in) :: charts(:)
      integer, intent(in) :: test
      character(*), intent(in) :: folder
      type(error_t), allocatable :: error
      character(:), allocatable :: svg, path
      integer :: k

      call begin_charts(page)
      do k = 1, size(charts)
         if (charts(k)%test /= test) cycle
         path = join_path(join_path(folder, 'figures'), picture_file(charts(k)))
         if (.not. file_exists(path)) cycle
         call read_whole(path, svg, error)
         if (allocated(error)) cycle
         call add_chart_picture(page, svg, charts(k)%title//', '//charts(k)%y_label//', over '//charts(k)%x_label)
      end do
      call end_charts(page)
   end subroutine add_charts

   !> The gradients of a test; left and right in one row.
   subroutine add_gradients(page, test, gradients, words)
      type(page_t), intent(inout) :: page
      type(test_result_t), intent(in) :: test
      type(gradient_t), intent(in) :: gradients(:)
      type(message_list_t), intent(inout) :: words        !! why some have no value
      logical :: has_sides, is_axle, has_twin
      integer :: k

      has_sides = .false.
      do k = 1, size(gradients)
         if (gradients(k)%test == test%name) has_sides = has_sides .or. len(gradients(k)%side) > 0
      end do
      if (.not. any([(gradients(k)%test == test%name, k=1, size(gradients))])) return
      call add_heading(page, 'Gradients: least-squares slopes around design')
      if (has_sides) then
         call begin_table(page, [character(9) :: 'Quantity', '>Left', '>Right', 'Unit', 'Window', 'Sign'])
      else
         call begin_table(page, [character(9) :: 'Quantity', '>Value', 'Unit', 'Window', 'Sign'])
      end if
      do k = 1, size(gradients)
         associate (g => gradients(k))
            if (g%test /= test%name) cycle
            if (len(g%note) > 0 .and. is_first_note(gradients(:k))) call words%add(noted(gradients(k:))//': '//g%note)
            if (g%side == 'right') cycle                   ! in the row of its left side
            is_axle = len(g%side) == 0 .and. has_sides
            has_twin = .false.
            if (k < size(gradients)) has_twin = gradients(k + 1)%side == 'right' .and. gradients(k + 1)%quantity == g%quantity
            call begin_row(page)
            call add_cell(page, g%quantity)
            if (has_twin) then
               call add_values(page, has_sides, is_axle, g%value, gradients(k + 1)%value)
            else
               call add_values(page, has_sides, .true., g%value, g%value)
            end if
            call add_cell(page, g%unit)
            call add_cell(page, g%window)
            call add_cell(page, g%sign, 's')
            call end_row(page)
         end associate
      end do
      call end_table(page)
      call add_warnings(page, 'Gradients without a value', words)
   end subroutine add_gradients

   !> Whether the last gradient of a list is the first of its test and side with its note.
   pure logical function is_first_note(list)
      type(gradient_t), intent(in) :: list(:)
      integer :: k, n

      n = size(list)
      is_first_note = .true.
      do k = 1, n - 1
         if (list(k)%test == list(n)%test .and. list(k)%side == list(n)%side .and. list(k)%note == list(n)%note) &
            is_first_note = .false.
      end do
   end function is_first_note

   !> 'right bump toe, bump camber': all gradients of a list with the note, test and side of the first.
   pure function noted(list) result(text)
      type(gradient_t), intent(in) :: list(:)
      character(:), allocatable :: text
      integer :: k

      text = list(1)%quantity
      if (len(list(1)%side) > 0) text = list(1)%side//' '//text
      do k = 2, size(list)
         if (list(k)%test == list(1)%test .and. list(k)%side == list(1)%side .and. list(k)%note == list(1)%note) &
            text = text//', '//list(k)%quantity
      end do
   end function noted

end module ek_report_page
