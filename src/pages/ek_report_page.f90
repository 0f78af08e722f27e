!> The page of a report, from its tests, gradients and pictures.
!> The section of peak loads has one row per member, the loads on its second body.
module ek_report_page
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t
   use ek_text, only: str, plural
   use ek_file, only: read_whole, join_path, file_exists
   use ek_rig_test, only: is_scattered
   use ek_test_result, only: test_result_t, design_row, converged_rows, wheel_word
   use ek_chart, only: chart_t, picture_file
   use ek_gradient, only: gradient_t
   use ek_explanation, only: add_explanations
   use ek_grid_figures, only: carpet_name, envelope_name
   use ek_report_content, only: report_t
   use ek_report_data, only: report_data
   use ek_number_section, only: add_summary, has_summary, add_other_numbers
   use ek_scene_section, only: add_scene, add_panels, has_figures
   use ek_chart_choice, only: open_charts
   use ek_page, only: page_t, begin_page, begin_section, add_text, add_file, add_warnings, add_facts, set_data, begin_table, &
      add_cell, add_numbers, end_table, begin_fold, end_fold, add_charts, begin_pictures, end_pictures, add_picture, &
      add_legend, add_block, page_text, page_number
   use ek_member_loads, only: load_record_t
   use ek_rod_table, only: add_rod_table
   use ek_measured_table, only: add_measured_table
   use ek_defined_numbers, only: add_defined_section
   implicit none(type, external)
   private
   public :: report_page, add_pictures, add_constants, add_peak_loads

   integer, parameter :: forces(4) = [1, 2, 3, 4], resultant = 4, moment = 8, own(3) = [9, 10, 11]     !! components of a record

   ! headings of the values, and whether they belong to a table with two sides
   character(6), parameter :: values(3) = [character(6) :: '>Left', '>Right', '>Value']
   logical, parameter :: sides(3) = [.true., .true., .false.]

contains

   !> The content of report.html. Pictures are read from the folder if they belong to this report; missing pictures are omitted.
   function report_page(report) result(text)
      type(report_t), intent(in) :: report
      character(:), allocatable :: text
      type(page_t) :: page
      integer :: k
      logical :: is_live

      call begin_page(page, report%title, 'Kinematics and compliance report', report%is_static)
      call add_facts(page, report%names, report%values)
      call add_warnings(page, 'Warnings', report%warnings)
      call add_summary(page, report)
      is_live = .false.
      if (allocated(report%live)) is_live = allocated(report%live%rates)
      if (is_live) call add_rates(page)
      call add_scene(page, report, has_summary(report))
      call add_other_numbers(page, report)
      if (allocated(report%defined)) then
         if (report%defined%test /= '') call add_defined_section(page, report%defined)
      end if
      if (allocated(report%explanations)) call add_explanations(page, report%explanations)
      if (allocated(report%measured)) call add_measured_table(page, report%measured)
      do k = 1, size(report%tests)
         if (pair_of(report%tests, k) == 0) call add_test(page, report, k)
      end do
      if (allocated(report%parts)) call add_rod_table(page, report%parts)
      if (allocated(report%loads)) call add_peak_loads(page, report%loads)
      if (.not. report%is_static) call set_data(page, report_data(report), is_live, allocated(report%turntable), &
         has_figures(report))
      text = page_text(page)
   end function report_page

   !> Adds the section in which a reader changes rates. The page script fills the section.
   subroutine add_rates(page)
      type(page_t), intent(inout) :: page

      call begin_section(page, 'what-if', 'What if: other rates', is_printed=.false.)
      call add_text(page, 'p', 'A slider multiplies a rate of the deck by 0.1 to 10, on both sides of an axle. The field '// &
         'next to it accepts any number. Compliances, stiffnesses and their curves are updated without a new solution, '// &
         'exactly for each state as shown (formula of Woodbury). The text below the sliders states the difference from '// &
         'a run of the deck with these rates.')
      call add_block(page, 'place', '"rates"')
   end subroutine add_rates

   !> Adds the first cells of a row: a quantity and one or two cells with values. A value of the axle is in the first of two cells.
   subroutine add_values(page, quantity, has_sides, is_of_axle, left, right)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: quantity
      logical, intent(in) :: has_sides, is_of_axle
      real(wp), intent(in) :: left, right

      call add_cell(page, quantity)
      call add_cell(page, page_number(left))
      if (.not. has_sides) return
      if (is_of_axle) call add_cell(page, '')
      if (.not. is_of_axle) call add_cell(page, page_number(right))
   end subroutine add_values

   !> The index of the test of which test k is a variant with the force aft of the contact point; 0 if there is none.
   pure integer function pair_of(tests, k) result(pair)
      type(test_result_t), intent(in) :: tests(:)
      integer, intent(in) :: k

      pair = 0
      if (.not. abs(tests(k)%trail) > 0.0_wp) return
      do pair = size(tests), 1, -1
         if (abs(tests(pair)%trail) > 0.0_wp .or. tests(pair)%kind /= tests(k)%kind) cycle
         if ((tests(pair)%is_anti .eqv. tests(k)%is_anti) .and. tests(pair)%held == tests(k)%held) return
      end do
   end function pair_of

   !> Adds the section of a test: warnings and content. Variants of the test are folded at the end of the section; their warnings
   !> are above the fold.
   subroutine add_test(page, report, number)
      type(page_t), intent(inout) :: page
      type(report_t), intent(in) :: report
      integer, intent(in) :: number              !! index of the test
      character(*), parameter :: heading = 'Warnings: states that failed or are doubtful'
      integer :: k

      associate (tests => report%tests)
         call begin_section(page, 'test-'//tests(number)%name, tests(number)%title, trim(tests(number)%held))
         call add_warnings(page, heading, tests(number)%remarks)
         call add_content(page, report, tests(number), number)
         do k = 1, size(tests)
            if (pair_of(tests, k) /= number) cycle
            call add_warnings(page, heading//' ('//tests(k)%title//')', tests(k)%remarks)
            call begin_fold(page, tests(k)%title, 'test-'//tests(k)%name)
            call add_content(page, report, tests(k), k)
            call end_fold(page)
         end do
      end associate
   end subroutine add_test

   !> Adds the charts or the figures of a grid, constant quantities, and gradients of a test.
   subroutine add_content(page, report, test, number)
      type(page_t), intent(inout) :: page
      type(report_t), intent(in) :: report
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: number              !! index of the test
      character(16), allocatable :: names(:)
      integer :: k

      if (test%is_run) then
         call add_file(page, plural(count(converged_rows(test%table)), 'state', 'states')//' in equilibrium, '// &
            over_what(test)//'. All columns: ', test%file)
         allocate (names(size(test%prefixes)))
         do k = 1, size(names)
            names(k) = wheel_word(test%prefixes(k))
            if (len_trim(names(k)) == 0) names(k) = merge('right wheel', 'left wheel ', test%sides(k) > 0)
         end do
         if (report%is_static .and. .not. allocated(test%grid)) call add_legend(page, names, design_row(test%table) > 0, &
            is_scattered(test%kind))
      end if
      if (allocated(test%grid)) then
         call add_panels(page, report, carpet_name(test), test%title//': toe and camber', &
            'A line of equal travel meets a line of equal steering at a state; its height is the value there.')
         call add_panels(page, report, envelope_name(test), test%title//': envelope of the wheels', &
            'Positions of the wheel centre, and the spin axis outboard of it, in the frame of the deck. As numbers: '// &
            test%envelope)
      end if
      call add_test_charts(page, report, test, number)
      call add_constants(page, report%charts, number)
      call add_gradients(page, test%name, report%gradients)
   end subroutine add_content

   !> Phrase about the abscissa of a test: 'plotted over ...', or 'on a grid of ...'.
   function over_what(test) result(words)
      type(test_result_t), intent(in) :: test
      character(:), allocatable :: words

      words = 'plotted over '//test%label
      if (allocated(test%grid)) words = 'on a grid of '//plural(size(test%grid%travel), 'value', 'values')// &
         ' of the wheel travel and '//str(size(test%grid%steer))//' of '//test%grid%driver
   end function over_what

   !> Adds the charts of a test, open or folded (ek_chart_choice): drawn by the script of the page, or on a static page by gnuplot.
   subroutine add_test_charts(page, report, test, number)
      type(page_t), intent(inout) :: page
      type(report_t), intent(in) :: report
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: number              !! index of the test
      integer, allocatable :: places(:)
      logical :: is_drawn(size(report%charts))
      integer :: opened, folded, k

      is_drawn = .not. report%is_static
      do k = 1, merge(size(is_drawn), 0, report%is_static .and. report%has_pictures)
         is_drawn(k) = file_exists(figure_of(report%charts(k), report%folder))
      end do
      call open_charts(report%charts, test, number, places, opened)
      folded = count(is_drawn(places(opened + 1:)))
      opened = count(is_drawn(places(:opened)))
      places = pack(places, is_drawn(places))
      if (opened > 0) call add_side_by_side(page, report, places(:opened))
      if (folded == 0) return
      call begin_fold(page, plural(folded, trim(merge('more chart', 'chart     ', opened > 0)), &
         trim(merge('more charts', 'charts     ', opened > 0))))
      call add_side_by_side(page, report, places(opened + 1:))
      call end_fold(page)
   end subroutine add_test_charts

   !> Adds charts side by side.
   subroutine add_side_by_side(page, report, places)
      type(page_t), intent(inout) :: page
      type(report_t), intent(in) :: report
      integer, intent(in) :: places(:)           !! indices of charts
      type(message_list_t) :: names
      integer :: k

      if (report%is_static) then
         call add_pictures(page, report%charts, places, report%folder)
         return
      end if
      do k = 1, size(places)
         call names%add(report%charts(places(k))%name)
      end do
      call add_charts(page, names)
   end subroutine add_side_by_side

   !> Adds the quantities that do not change over a test as numbers, instead of charts.
   subroutine add_constants(page, charts, test)
      type(page_t), intent(inout) :: page
      type(chart_t), intent(in) :: charts(:)
      integer, intent(in) :: test
      integer :: k, l

      if (.not. any([(charts(k)%test == test .and. charts(k)%is_level, k=1, size(charts))])) return
      call begin_fold(page, 'Constant over the test: '// &
         plural(count([(charts(k)%test == test .and. charts(k)%is_level, k=1, size(charts))]), 'quantity', 'quantities'))
      call begin_table(page, [character(12) :: 'Quantity', 'Curve', '>Value', '~Unit, sign'])
      do k = 1, size(charts)
         if (charts(k)%test /= test .or. .not. charts(k)%is_level) cycle
         do l = 1, size(charts(k)%traces)
            call add_cell(page, charts(k)%title)
            call add_cell(page, charts(k)%traces(l)%title)
            call add_cell(page, page_number(level_of(charts(k)%traces(l)%y, charts(k)%noise)))
            call add_cell(page, charts(k)%y_label)
         end do
      end do
      call end_table(page)
      call end_fold(page)
   end subroutine add_constants

   !> Mean of the smallest and the largest value of a nearly constant curve; 0 if its magnitude is below 1e-4 of the least
   !> span.
   pure real(wp) function level_of(y, span) result(value)
      real(wp), intent(in) :: y(:), span

      value = (minval(y, mask=ieee_is_finite(y)) + maxval(y, mask=ieee_is_finite(y)))/2
      if (abs(value) < 1.0e-4_wp*span) value = 0.0_wp
   end function level_of

   function figure_of(chart, folder) result(path)
      type(chart_t), intent(in) :: chart
      character(*), intent(in) :: folder
      character(:), allocatable :: path
      path = join_path(join_path(folder, 'figures'), picture_file(chart))
   end function figure_of

   !> Adds charts drawn by gnuplot, side by side. Constant charts, and charts without a file, are omitted.
   subroutine add_pictures(page, charts, numbers, folder)
      type(page_t), intent(inout) :: page
      type(chart_t), intent(in) :: charts(:)
      integer, intent(in) :: numbers(:)              !! indices of the charts that are shown
      character(*), intent(in) :: folder
      type(error_t), allocatable :: error
      character(:), allocatable :: svg
      logical :: is_begun
      integer :: k

      is_begun = .false.
      do k = 1, size(numbers)
         associate (chart => charts(numbers(k)))
            if (chart%is_level) cycle
            if (.not. file_exists(figure_of(chart, folder))) cycle
            call read_whole(figure_of(chart, folder), svg, error)
            if (allocated(error)) cycle
            if (.not. is_begun) call begin_pictures(page)
            is_begun = .true.
            call add_picture(page, svg, chart%title//', '//chart%y_label//', over '//chart%x_label)
         end associate
      end do
      if (is_begun) call end_pictures(page)
   end subroutine add_pictures

   !> Adds the gradients of a test, with left and right in one row, and the reasons for gradients without a value.
   subroutine add_gradients(page, test, list)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: test                    !! name of the test
      type(gradient_t), intent(in) :: list(:)             !! gradients of all tests
      type(gradient_t), allocatable :: gradients(:)
      type(message_list_t) :: unknown                     ! why some have no value
      logical :: has_sides, has_twin
      logical, allocatable :: is_noted(:)                 ! with the note of a gradient, on its side
      integer :: k, n

      gradients = pack(list, [(list(k)%test == test, k=1, size(list))])
      if (size(gradients) == 0) return
      has_sides = any([(len(gradients(k)%side) > 0, k=1, size(gradients))])
      call begin_fold(page, 'Gradients: least-squares slopes around design')
      call begin_table(page, [character(8) :: 'Quantity', pack(values, sides .eqv. has_sides), 'Unit', 'Window', '~Sign'])
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
            call add_cell(page, g%sign)
         end associate
      end do
      call end_table(page)
      call end_fold(page)
      call add_warnings(page, 'Gradients without a value', unknown)
   end subroutine add_gradients

   !> Names of the gradients of a list, for one side: 'right bump toe, bump camber'.
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

   !> Adds the section. Members whose largest force and moment are printed as 0 are omitted. The last two columns belong to the
   !> largest force, or to the largest moment if the force is printed as 0: beside a joint, a bushing has a force of some 1e-9 N.
   subroutine add_peak_loads(page, record)
      type(page_t), intent(inout) :: page
      type(load_record_t), intent(in) :: record
      integer :: e, c, leader

      call begin_section(page, 'peak-loads', 'Peak loads', is_printed=.false.)
      call add_text(page, 'p', 'Largest value of each component over all tests: force and moment on the body in the frame of '// &
         'the deck, with the moment about the hardpoint. The columns "own" give the force of a bushing along its own axes. '// &
         'The forces on the first body of each member are opposite. '// &
         'peak-loads.csv contains both bodies and the state of every component; loads.csv contains all states.')
      call begin_table(page, [character(15) :: 'Member', 'On body', 'At', '>Fx [N]', '>Fy [N]', '>Fz [N]', '>Force [N]', &
         '>Moment [N m]', '>own Fx [N]', '>own Fy [N]', '>own Fz [N]', 'Largest load in', '>at'])
      do e = 2, size(record%ends), 2
         if (record%case(resultant, e) == 0) cycle
         leader = merge(moment, resultant, page_number(record%peaks(resultant, e)) == '0')
         if (page_number(record%peaks(leader, e)) == '0') cycle
         call add_cell(page, record%ends(e)%member)
         call add_cell(page, record%ends(e)%body)
         call add_cell(page, record%ends(e)%point)
         call add_numbers(page, record%peaks([forces, moment], e))
         do c = 1, size(own)
            if (record%case(own(c), e) == 0) call add_cell(page, '–')
            if (record%case(own(c), e) > 0) call add_cell(page, page_number(record%peaks(own(c), e)))
         end do
         call add_cell(page, trim(record%cases(record%case(leader, e))))
         call add_cell(page, page_number(record%factor(leader, e)))
      end do
      call end_table(page)
   end subroutine add_peak_loads

end module ek_report_page
