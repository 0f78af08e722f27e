!> The page of a report, from its tests, gradients and pictures.
module ek_report_page
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t
   use ek_text, only: plural
   use ek_file, only: read_whole, join_path, file_exists
   use ek_path, only: path_t
   use ek_test_result, only: test_result_t, design_row, converged_rows, wheel_word
   use ek_chart, only: chart_t, picture_file
   use ek_gradient, only: gradient_t
   use ek_key_numbers, only: key_number_t, key_numbers
   use ek_page, only: page_t, begin_page, begin_section, add_text, add_warnings, add_facts, &
      begin_table, add_cell, add_group, end_table, begin_charts, end_charts, &
      add_picture, add_data_picture, add_legend, page_text, page_number
   implicit none(type, external)
   private
   public :: report_t, add_fact, report_page, add_charts

   ! headings of the values, and whether they belong to a table with two sides
   character(6), parameter :: values(3) = [character(6) :: '>Left', '>Right', '>Value']
   logical, parameter :: sides(3) = [.true., .true., .false.]

   !> A report: its tests, and what its page shows besides.
   type :: report_t
      character(:), allocatable :: title, folder
      type(message_list_t) :: names, values            !! facts for the head of the page
      type(message_list_t) :: warnings                 !! on the model as a whole
      type(test_result_t), allocatable :: tests(:)
      type(path_t), allocatable :: paths(:)            !! states of each test, for pictures; empty if it was not run
      type(chart_t), allocatable :: charts(:)          !! of all tests
      type(gradient_t), allocatable :: gradients(:)
      logical :: has_pictures = .false., has_animation = .false.     !! those in the folder belong to this report
   end type report_t

contains

   !> A fact for the head of the page.
   subroutine add_fact(report, name, value)
      type(report_t), intent(inout) :: report
      character(*), intent(in) :: name, value
      call report%names%add(name)
      call report%values%add(value)
   end subroutine add_fact

   !> The text of report.html. Pictures are read from the folder if they belong to this report; missing ones are
   !> omitted.
   function report_page(report) result(text)
      type(report_t), intent(in) :: report
      character(:), allocatable :: text
      type(page_t) :: page
      integer :: k

      call begin_page(page, report%title, 'Kinematics and compliance report')
      call add_facts(page, report%names, report%values)
      call add_warnings(page, 'Warnings', report%warnings)
      if (report%has_pictures) call add_scene(page, report)
      call add_key_numbers(page, report%tests, report%gradients)
      do k = 1, size(report%tests)
         call add_test(page, report, report%tests(k), k)
      end do
      text = page_text(page)
   end function report_page

   !> The picture in space, and the animation.
   subroutine add_scene(page, report)
      type(page_t), intent(inout) :: page
      type(report_t), intent(in) :: report
      type(error_t), allocatable :: error
      character(:), allocatable :: bytes
      logical :: has_svg, has_gif

      has_svg = file_exists(join_path(report%folder, 'picture.svg'))
      has_gif = report%has_animation
      if (has_gif) has_gif = file_exists(join_path(report%folder, 'animation.gif'))
      if (.not. (has_svg .or. has_gif)) return
      call begin_section(page, 'picture', 'The suspension')
      if (has_svg) then
         call read_whole(join_path(report%folder, 'picture.svg'), bytes, error)
         if (.not. allocated(error)) call add_picture(page, bytes, 'The suspension in space: '//report%title, &
            'Solid: design. Thin lines: ends of the travel. Bodies have no shape in the model; they are drawn as bars '// &
            'between their attachment points.')
      end if
      if (has_gif) then
         call read_whole(join_path(report%folder, 'animation.gif'), bytes, error)
         if (.not. allocated(error)) call add_data_picture(page, bytes, 'gif', 'The suspension moving: '//report%title, '')
      end if
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
      has_sides = any([(size(tests(k)%prefixes) > 1, k=1, size(tests))])
      call begin_section(page, 'key-numbers', 'Key numbers')
      call begin_table(page, [character(8) :: 'Quantity', pack(values, sides .eqv. has_sides), 'Unit', 'Sign'])
      group = ''
      do k = 1, size(numbers)
         if (numbers(k)%group /= group) then
            group = numbers(k)%group
            call add_group(page, group)
         end if
         call add_values(page, numbers(k)%quantity, has_sides, numbers(k)%is_of_axle, numbers(k)%left, numbers(k)%right)
         call add_cell(page, numbers(k)%unit)
         call add_cell(page, numbers(k)%sign, 's')
      end do
      call end_table(page)
   end subroutine add_key_numbers

   !> The first cells of a row: a quantity and one or two cells of numbers; a value of the axle is in the first.
   subroutine add_values(page, quantity, has_sides, is_of_axle, left, right)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: quantity
      logical, intent(in) :: has_sides, is_of_axle
      real(wp), intent(in) :: left, right

      call add_cell(page, quantity)
      call add_cell(page, page_number(left), 'n')
      if (.not. has_sides) return
      if (is_of_axle) call add_cell(page, '', 'n')
      if (.not. is_of_axle) call add_cell(page, page_number(right), 'n')
   end subroutine add_values

   !> Section of a test: warnings, charts, gradients.
   subroutine add_test(page, report, test, number)
      type(page_t), intent(inout) :: page
      type(report_t), intent(in) :: report
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: number              !! of the test
      character(16), allocatable :: names(:)
      integer :: k

      call begin_section(page, 'test-'//test%name, test%title)
      call add_warnings(page, 'Warnings: states that failed or are doubtful', test%remarks)
      if (test%is_run) then
         call add_text(page, 'p', plural(count(converged_rows(test%table)), 'state', 'states')//' in equilibrium, '// &
            'plotted over '//test%label//'. All columns are in '//test%file//'.')
         allocate (names(size(test%prefixes)))
         do k = 1, size(names)
            names(k) = wheel_word(test%prefixes(k))
            if (len_trim(names(k)) == 0) names(k) = merge('right wheel', 'left wheel ', test%sides(k) > 0)
         end do
         call add_legend(page, names, design_row(test%table) > 0, test%kind == 'table')
      end if
      if (report%has_pictures) call add_charts(page, report%charts, number, report%folder)
      call add_gradients(page, test%name, report%gradients)
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
         call add_picture(page, svg, charts(k)%title//', '//charts(k)%y_label//', over '//charts(k)%x_label)
      end do
      call end_charts(page)
   end subroutine add_charts

   !> The gradients of a test; left and right in one row.
   subroutine add_gradients(page, test, list)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: test                    !! its name
      type(gradient_t), intent(in) :: list(:)             !! of all tests
      type(gradient_t), allocatable :: gradients(:)
      type(message_list_t) :: unknown                     ! why some have no value
      logical :: has_sides, has_twin
      logical, allocatable :: is_noted(:)                 ! with the note of a gradient, on its side
      integer :: k, n

      gradients = pack(list, [(list(k)%test == test, k=1, size(list))])
      if (size(gradients) == 0) return
      has_sides = any([(len(gradients(k)%side) > 0, k=1, size(gradients))])
      call add_text(page, 'h3', 'Gradients: least-squares slopes around design')
      call begin_table(page, [character(8) :: 'Quantity', pack(values, sides .eqv. has_sides), 'Unit', 'Window', 'Sign'])
      do k = 1, size(gradients)
         associate (g => gradients(k))
            is_noted = [(gradients(n)%side == g%side .and. gradients(n)%note == g%note, n=1, size(gradients))]
            if (len(g%note) > 0 .and. .not. any(is_noted(:k - 1))) &
               call unknown%add(noted(pack(gradients, is_noted))//': '//g%note)
            if (g%side == 'right') cycle                   ! in the row of its left side
            has_twin = .false.
            if (k < size(gradients)) has_twin = gradients(k + 1)%side == 'right' .and. gradients(k + 1)%quantity == g%quantity
            call add_values(page, g%quantity, has_sides, .not. has_twin, g%value, gradients(min(k + 1, size(gradients)))%value)
            call add_cell(page, g%unit)
            call add_cell(page, g%window)
            call add_cell(page, g%sign, 's')
         end associate
      end do
      call end_table(page)
      call add_warnings(page, 'Gradients without a value', unknown)
   end subroutine add_gradients

   !> 'right bump toe, bump camber': the gradients of a list, of one side.
   pure function noted(list) result(text)
      type(gradient_t), intent(in) :: list(:)
      character(:), allocatable :: text
      integer :: k

      text = list(1)%quantity
      if (len(list(1)%side) > 0) text = list(1)%side//' '//text
      do k = 2, size(list)
         text = text//', '//list(k)%quantity
      end do
   end function noted

end module ek_report_page
