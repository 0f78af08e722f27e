!> elastokin compare: results laid over each other, and a table of how their gradients differ.
module ek_compare
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: str, quoted
   use ek_buffer, only: buffer_t
   use ek_decimal, only: put_decimal, longest_decimal
   use ek_version, only: version
   use ek_file, only: make_folder, write_whole, join_path, remove_file, write_standard_output
   use ek_table, only: column_index
   use ek_test_result, only: test_result_t, design_row
   use ek_test_charts, only: quantity_t, all_quantities, quantities_of, quantity_named, quantity_chart
   use ek_chart, only: chart_t, add_trace, append_chart, charts_script
   use ek_gnuplot, only: run_gnuplot, script_name_t
   use ek_gradient, only: windows_t
   use ek_comparison, only: difference_t, gradient_set_t, compare_gradients, difference, percent
   use ek_text_table, only: text_table_t, new_text_table, add_row, text_table_csv
   use ek_page, only: page_t, begin_page, begin_section, end_section, add_paragraph, add_warnings, add_facts, begin_table, &
      begin_row, add_cell, end_row, add_group, end_table, add_legend, page_text, page_number
   use ek_report_files, only: results_t, read_results
   use ek_report_page, only: chart_set_t, add_chart_set
   use ek_report, only: chosen_windows
   use ek_arguments, only: arguments_t
   use ek_words, only: say
   implicit none(type, external)
   private
   public :: compare

contains

   !> Compares CSV files of one case, or report folders.
   subroutine compare(arguments, error)
      type(arguments_t), intent(in) :: arguments
      type(error_t), allocatable, intent(out) :: error
      type(results_t), allocatable :: results(:)
      type(gradient_set_t), allocatable :: sets(:)
      type(difference_t), allocatable :: rows(:)
      type(chart_set_t), allocatable :: charts(:)
      type(message_list_t) :: missing
      type(error_t), allocatable :: undrawn
      type(windows_t) :: windows
      character(:), allocatable :: folder, message
      integer :: k, l

      call chosen_windows(arguments, windows, error)
      if (allocated(error)) return
      allocate (results(size(arguments%files)), sets(size(arguments%files)))
      do k = 1, size(results)
         call read_results(arguments%files(k)%text, windows, results(k), error)
         if (allocated(error)) return
         if (results(k)%is_report .neqv. results(1)%is_report) then
            call fail(error, exit_usage, 'compare takes CSV files or report folders, not both: '//quoted(results(1)%path)// &
               ' and '//quoted(results(k)%path))
            return
         end if
         sets(k)%list = results(k)%gradients
      end do
      do k = 1, size(results)         ! equal names: the whole paths tell them apart
         do l = 1, size(results)
            if (l == k .or. results(l)%label /= results(k)%label) cycle
            results(k)%label = results(k)%path
            results(l)%label = results(l)%path
         end do
      end do
      folder = arguments%out
      if (len(folder) == 0) folder = 'out'
      call make_folder(join_path(folder, 'figures'), error)
      if (allocated(error)) return

      call compare_gradients(sets, rows)
      call find_missing(results, rows, missing)
      call write_standard_output(words_of(results, rows), error)
      if (allocated(error)) return
      do k = 1, missing%count()
         call say(arguments%quiet, missing%line(k))
      end do
      call write_differences(results, rows, join_path(folder, 'differences.csv'), error)
      if (allocated(error)) return

      call overlay(results, charts)
      call draw(arguments, charts, folder, message, undrawn)     ! the page comes also without its pictures
      if (len(message) > 0) call say(arguments%quiet, message)
      call write_whole(join_path(folder, 'compare.html'), page_of(results, rows, charts, missing, folder), error)
      if (allocated(error)) return
      call say(arguments%quiet, join_path(folder, 'differences.csv')//', '//join_path(folder, 'compare.html'))
      if (allocated(undrawn)) call move_alloc(undrawn, error)
   end subroutine compare

   !> What one of the results has and another lacks.
   subroutine find_missing(results, rows, missing)
      type(results_t), intent(in) :: results(:)
      type(difference_t), intent(in) :: rows(:)
      type(message_list_t), intent(inout) :: missing
      type(message_list_t) :: lacking
      character(:), allocatable :: name
      integer :: a, b, t, k

      do b = 1, size(results)
         do a = 1, size(results)
            if (a == b) cycle
            do t = 1, size(results(a)%tests)
               name = results(a)%tests(t)%name
               if (test_number(results(b), name) == 0 .and. is_first(a, b, t)) &
                  call missing%add(results(b)%label//' has no test '//quoted(name))
            end do
            lacking = columns_lacking(results(a), results(b))
            if (lacking%count() > 0) call missing%add(results(b)%label//' has no column '//some_of(lacking))
         end do
         lacking = message_list_t()
         do k = 1, size(rows)
            if (rows(k)%is_there(b)) cycle
            name = trim(rows(k)%quantity//' '//rows(k)%side)
            if (results(b)%is_report) name = rows(k)%test//' '//name
            call lacking%add(name)
         end do
         if (lacking%count() > 0) call missing%add(results(b)%label//' has no gradient '//some_of(lacking))
      end do

   contains

      !> Whether no result before a, other than b, has its test t: it is told once.
      pure logical function is_first(a, b, t)
         integer, intent(in) :: a, b, t
         integer :: c

         is_first = .true.
         do c = 1, a - 1
            if (c /= b) is_first = is_first .and. test_number(results(c), results(a)%tests(t)%name) == 0
         end do
      end function is_first

   end subroutine find_missing

   !> The columns of `one` that `other` lacks in the same test; each once, whatever the tests it lacks it in.
   function columns_lacking(one, other) result(lacking)
      type(results_t), intent(in) :: one, other
      type(message_list_t) :: lacking
      integer :: t, u, k, n

      do t = 1, size(one%tests)
         u = test_number(other, one%tests(t)%name)
         if (u == 0) cycle
         associate (columns => one%tests(t)%table%columns)
            do k = 1, size(columns)
               if (column_index(other%tests(u)%table, columns(k)) > 0) cycle
               do n = 1, lacking%count()
                  if (lacking%line(n) == trim(columns(k))) exit
               end do
               if (n > lacking%count()) call lacking%add(trim(columns(k)))
            end do
         end associate
      end do
   end function columns_lacking

   !> The first names of a list, and how many more there are: models of different make share few of a thousand columns.
   function some_of(names) result(text)
      type(message_list_t), intent(in) :: names
      character(:), allocatable :: text
      integer, parameter :: enough = 12
      integer :: k

      text = ''
      do k = 1, min(names%count(), enough)
         if (k > 1) text = text//', '
         text = text//names%line(k)
      end do
      if (names%count() > enough) text = text//' and '//str(names%count() - enough)//' more'
   end function some_of

   pure integer function test_number(results, name) result(number)
      type(results_t), intent(in) :: results
      character(*), intent(in) :: name

      do number = size(results%tests), 1, -1
         if (results%tests(number)%name == name) return
      end do
   end function test_number

   !> The table for standard output.
   function words_of(results, rows) result(text)
      type(results_t), intent(in) :: results(:)
      type(difference_t), intent(in) :: rows(:)
      character(:), allocatable :: text
      type(buffer_t) :: out
      character(:), allocatable :: test
      integer :: k, r

      if (size(rows) == 0) then
         text = 'no gradients to compare'//new_line('a')
         return
      end if
      do r = 1, size(results)
         call out%line(achar(iachar('A') + modulo(r - 1, 26))//': '//results(r)%path)
      end do
      test = ''
      do k = 1, size(rows)
         if (rows(k)%test /= test) then
            test = rows(k)%test
            call out%line('')
            call out%add(left(test, 42)//right('A', 12))
            do r = 2, size(results)
               call out%add(right(achar(iachar('A') + modulo(r - 1, 26)), 12)//right('difference', 12)//right('percent', 9))
            end do
            call out%line('  unit')
         end if
         call out%add(left(trim(rows(k)%quantity//' '//rows(k)%side), 42)//right(number_text(rows(k)%values(1), 6), 12))
         do r = 2, size(results)
            call out%add(right(number_text(rows(k)%values(r), 6), 12)// &
               right(number_text(difference(rows(k)%values(1), rows(k)%values(r)), 4), 12)// &
               right(number_text(percent(rows(k)%values(1), rows(k)%values(r)), 3), 9))
         end do
         call out%line('  '//rows(k)%unit)
      end do
      text = out%text()
   end function words_of

   pure function number_text(value, digits) result(text)
      real(wp), intent(in) :: value
      integer, intent(in) :: digits
      character(:), allocatable :: text

      text = str(value, digits)
      if (text == 'not a number') text = '-'
   end function number_text

   !> Filled with blanks to a width, to the left or to the right.
   pure function left(text, width) result(filled)
      character(*), intent(in) :: text
      integer, intent(in) :: width
      character(:), allocatable :: filled
      filled = text//repeat(' ', max(1, width - len(text)))
   end function left

   pure function right(text, width) result(filled)
      character(*), intent(in) :: text
      integer, intent(in) :: width
      character(:), allocatable :: filled
      filled = repeat(' ', max(1, width - len(text)))//text
   end function right

   !> differences.csv: one row a gradient and a result that is compared with the first.
   subroutine write_differences(results, rows, path, error)
      type(results_t), intent(in) :: results(:)
      type(difference_t), intent(in) :: rows(:)
      character(*), intent(in) :: path
      type(error_t), allocatable, intent(out) :: error
      type(text_table_t) :: table
      integer :: k, r

      table = new_text_table([character(10) :: 'test', 'quantity', 'side', 'unit', 'window', 'a_file', 'b_file', 'a', 'b', &
         'difference', 'percent'])
      do k = 1, size(rows)
         do r = 2, size(results)
            call add_row(table)
            table%cells(1, table%rows)%text = rows(k)%test
            table%cells(2, table%rows)%text = rows(k)%quantity
            table%cells(3, table%rows)%text = rows(k)%side
            table%cells(4, table%rows)%text = rows(k)%unit
            table%cells(5, table%rows)%text = rows(k)%window
            table%cells(6, table%rows)%text = results(1)%path
            table%cells(7, table%rows)%text = results(r)%path
            table%cells(8, table%rows)%text = decimal(rows(k)%values(1))
            table%cells(9, table%rows)%text = decimal(rows(k)%values(r))
            table%cells(10, table%rows)%text = decimal(difference(rows(k)%values(1), rows(k)%values(r)))
            table%cells(11, table%rows)%text = decimal(percent(rows(k)%values(1), rows(k)%values(r)))
         end do
      end do
      call write_whole(path, text_table_csv(table), error)
   end subroutine write_differences

   pure function decimal(value) result(text)
      real(wp), intent(in) :: value
      character(:), allocatable :: text
      character(longest_decimal) :: number
      integer :: used

      used = 0
      call put_decimal(value, number, used)
      text = number(:used)
   end function decimal

   !> Charts of every test of the first result: one a column that another result has too, one curve a result.
   subroutine overlay(results, sets)
      type(results_t), intent(in) :: results(:)
      type(chart_set_t), allocatable, intent(out) :: sets(:)
      character(36), allocatable :: columns(:)
      integer :: t, k

      allocate (sets(size(results(1)%tests)))
      do t = 1, size(sets)
         allocate (sets(t)%charts(0))
         columns = quantities_of(results(1)%tests(t)%kind)
         do k = 1, size(columns)
            call overlay_quantity(results, t, quantity_named(columns(k)), sets(t)%charts)
         end do
         do k = 1, size(all_quantities)
            if (.not. any(columns == all_quantities(k)%column)) &
               call overlay_quantity(results, t, all_quantities(k), sets(t)%charts)
         end do
      end do
   end subroutine overlay

   !> One quantity of a test, left and right apart.
   subroutine overlay_quantity(results, test, quantity, charts)
      type(results_t), intent(in) :: results(:)
      integer, intent(in) :: test
      type(quantity_t), intent(in) :: quantity
      type(chart_t), allocatable, intent(inout) :: charts(:)
      type(chart_t), allocatable :: own(:)
      type(chart_t) :: chart
      integer :: r, side, u, k, drawn

      if (quantity%column == results(1)%tests(test)%abscissa) return
      allocate (own(size(results)))
      own(1) = quantity_chart(results(1)%tests(test), quantity)
      do r = 2, size(results)
         u = test_number(results(r), results(1)%tests(test)%name)
         if (u > 0) own(r) = quantity_chart(results(r)%tests(u), quantity)
      end do
      do side = 1, size(own(1)%traces)
         chart = own(1)
         deallocate (chart%traces)
         allocate (chart%traces(0))
         associate (name => own(1)%traces(side)%title)
            if (len(name) > 0) then
               chart%name = chart%name//'_'//name
               chart%title = chart%title//', '//name
            end if
            drawn = 0
            do r = 1, size(results)
               if (.not. allocated(own(r)%traces)) cycle
               do k = 1, size(own(r)%traces)
                  if (own(r)%traces(k)%title /= name) cycle
                  own(r)%traces(k)%colour = r
                  own(r)%traces(k)%dash = merge(0, 1 + modulo(r - 2, 3), r == 1)
                  call add_trace(chart, own(r)%traces(k))
                  drawn = drawn + 1
               end do
            end do
         end associate
         if (drawn > 1) call append_chart(charts, chart)
      end do
   end subroutine overlay_quantity

   !> All charts by one run of gnuplot.
   subroutine draw(arguments, sets, folder, message, error)
      type(arguments_t), intent(in) :: arguments
      type(chart_set_t), intent(in) :: sets(:)
      character(*), intent(in) :: folder
      character(:), allocatable, intent(out) :: message    !! why there are none
      type(error_t), allocatable, intent(out) :: error
      type(script_name_t) :: scripts(1)
      type(chart_t), allocatable :: charts(:)
      integer :: t, k, n

      message = ''
      n = 0
      do t = 1, size(sets)
         n = n + size(sets(t)%charts)
         do k = 1, size(sets(t)%charts)
            call remove_file(join_path(folder, 'figures/'//sets(t)%charts(k)%name//'.svg'))   ! of an earlier run
         end do
      end do
      if (arguments%no_plots .or. n == 0) return
      allocate (charts(n))
      n = 0
      do t = 1, size(sets)
         charts(n + 1:n + size(sets(t)%charts)) = sets(t)%charts
         n = n + size(sets(t)%charts)
      end do
      call write_whole(join_path(folder, 'figures/compare.gp'), charts_script(charts), error)
      if (allocated(error)) return
      scripts(1)%text = 'compare.gp'
      call run_gnuplot(scripts, join_path(folder, 'figures'), message, error)
   end subroutine draw

   !> compare.html
   function page_of(results, rows, sets, missing, folder) result(text)
      type(results_t), intent(in) :: results(:)
      type(difference_t), intent(in) :: rows(:)
      type(chart_set_t), intent(in) :: sets(:)
      type(message_list_t), intent(in) :: missing
      character(*), intent(in) :: folder
      character(:), allocatable :: text, test
      type(page_t) :: page
      type(message_list_t) :: names, values
      character(longest_label(results)) :: labels(size(results))
      character(longest_label(results) + 1) :: heads(3*size(results) + 1)
      integer :: k, r, t

      do r = 1, size(results)
         labels(r) = results(r)%label
         call names%add(achar(iachar('A') + modulo(r - 1, 26)))
         call values%add(results(r)%path)
      end do
      call names%add('Program')
      call values%add('elastokin '//version)
      call begin_page(page, 'Comparison', 'Results laid over each other; gradients against those of A')
      call add_facts(page, names, values)
      call add_warnings(page, 'Not in all of them', missing)
      if (size(rows) > 0) then
         call begin_section(page, 'gradients', 'Gradients')
         heads(1) = 'Quantity'
         heads(2) = '>'//labels(1)
         do r = 2, size(results)
            heads(3*r - 3) = '>'//labels(r)
            heads(3*r - 2) = '>difference'
            heads(3*r - 1) = '>percent'
         end do
         heads(size(heads) - 1) = 'Unit'
         heads(size(heads)) = 'Window'
         call begin_table(page, heads)
         test = ''
         do k = 1, size(rows)
            if (rows(k)%test /= test) then
               test = rows(k)%test
               call add_group(page, title_of(results(1), test))
            end if
            call begin_row(page)
            call add_cell(page, trim(rows(k)%quantity//' '//rows(k)%side))
            call add_cell(page, page_number(rows(k)%values(1)), 'n')
            do r = 2, size(results)
               call add_cell(page, page_number(rows(k)%values(r)), 'n')
               call add_cell(page, page_number(difference(rows(k)%values(1), rows(k)%values(r))), 'n')
               call add_cell(page, page_number(percent(rows(k)%values(1), rows(k)%values(r))), 'n')
            end do
            call add_cell(page, rows(k)%unit)
            call add_cell(page, rows(k)%window)
            call end_row(page)
         end do
         call end_table(page)
         call end_section(page)
      end if
      do t = 1, size(sets)
         if (size(sets(t)%charts) == 0) cycle
         call begin_section(page, 'test-'//str(t), results(1)%tests(t)%title)
         call add_legend(page, labels, design_row(results(1)%tests(t)%table) > 0)
         call add_chart_set(page, sets(t)%charts, folder)
         call end_section(page)
      end do
      text = page_text(page)
   end function page_of

   !> Room for every label and for 'difference'.
   pure integer function longest_label(results) result(longest)
      type(results_t), intent(in) :: results(:)
      integer :: r

      longest = len('difference')
      do r = 1, size(results)
         longest = max(longest, len(results(r)%label))
      end do
   end function longest_label

   !> Title of a test by its name.
   pure function title_of(results, name) result(title)
      type(results_t), intent(in) :: results
      character(*), intent(in) :: name
      character(:), allocatable :: title
      integer :: k

      title = name
      k = test_number(results, name)
      if (k > 0) title = results%tests(k)%title
   end function title_of

end module ek_compare
