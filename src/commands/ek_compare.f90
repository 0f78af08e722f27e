!> elastokin compare: differences between the decks of results, changes of key numbers and gradients, and the overlaid curves.
module ek_compare
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: str, quoted
   use ek_file, only: make_folder, join_path
   use ek_table, only: column_index, name_index, name_length
   use ek_chart, only: chart_t, charts_script, remove_drawn, pictures_of
   use ek_outbox, only: outbox_t, outbox_in, keep_first
   use ek_report_files, only: results_t, read_results, test_number
   use ek_definition, only: check_program, title_of
   use ek_gradient_definition, only: windows_t
   use ek_command_line, only: command_line_t, refuse_stream, read_windows, read_threshold
   use ek_console, only: print_note, print_text
   use ek_comparison, only: comparison_t, difference_t, compare_gradients, compare_numbers, results_shown, &
      largest_lines
   use ek_compare_charts, only: compare_charts
   use ek_deck_file, only: deck_record_t
   use ek_deck_difference, only: find_differences
   use ek_compare_targets, only: find_targets
   use ek_compare_tables, only: write_tables, gradient_table
   use ek_compare_text, only: text_of
   use ek_compare_page, only: page_of
   use ek_compare_measured, only: compare_measurement
   implicit none(type, external)
   private
   public :: compare

   character(*), parameter :: page_name = 'compare.html'

contains

   !> Compares CSV files of one case, or report folders; with --measured, decks with measured curves.
   subroutine compare(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(windows_t) :: windows             !! of gradients, if they are computed from CSV files
      class(comparison_t), allocatable :: this
      type(error_t), allocatable :: unprinted
      type(outbox_t) :: box, figures
      character(:), allocatable :: reason
      integer :: k, l
      type(deck_record_t), allocatable :: decks(:)
      logical :: is_quiet, has_plots

      if (line%has('--definitions') .and. (line%has('--measured') .or. line%has('--map'))) then
         call fail(error, exit_usage, '--definitions compares results, and cannot be used with --measured and --map')
         return
      end if
      if (line%has('--measured') .or. line%has('--map')) then
         call compare_measurement(line, error)
         return
      end if
      allocate (this)
      is_quiet = line%has('--quiet')
      has_plots = (line%has('--plots') .or. line%has('--static')) .and. .not. line%has('--no-plots')
      call refuse_stream(line, error)
      if (.not. allocated(error) .and. line%has('--definitions')) call check_program(line%value('--definitions'), error)
      if (.not. allocated(error)) call read_windows(line, windows, error)
      if (.not. allocated(error)) call read_threshold(line, this%threshold, error)
      if (.not. allocated(error) .and. line%has('--plots') .and. line%has('--no-plots')) &
         call fail(error, exit_usage, '--no-plots and --plots are mutually exclusive')
      if (.not. allocated(error) .and. line%has('--json')) call fail(error, exit_usage, &
         '--json requires --measured; the tables of a comparison of reports are CSV files')
      if (allocated(error)) return
      this%is_static = line%has('--static')
      allocate (this%results(line%files%count()))
      do k = 1, size(this%results)
         call read_results(line%files%line(k), windows, this%results(k), error, line%value('--definitions'))
         if (allocated(error)) return
         if (this%results(k)%is_report .neqv. this%results(1)%is_report) then
            call fail(error, exit_usage, 'compare takes CSV files or report folders, not both: '//quoted(this%results(1)%path)// &
               ' and '//quoted(this%results(k)%path))
            return
         end if
      end do
      call check_definitions(line, this%results, error)
      if (allocated(error)) return
      do k = 1, size(this%results)         ! equal names: the full paths distinguish them
         do l = 1, size(this%results)
            if (l == k .or. this%results(l)%label /= this%results(k)%label) cycle
            this%results(k)%label = this%results(k)%path
            this%results(l)%label = this%results(l)%path
         end do
      end do
      this%folder = line%value('--out', 'out')
      call make_folder(this%folder, error)
      if (.not. allocated(error)) call make_folder(join_path(this%folder, 'figures'), error)
      if (allocated(error)) return

      decks = this%results%deck
      call find_differences(decks, this%facts, this%deck)
      call compare_gradients(this%results, this%rows)
      call compare_numbers(this%results, this%numbers)
      call find_targets(this%results, this%targets)
      this%shown = results_shown(this%numbers, this%rows)
      call compare_charts(this%results, this%threshold, this%charts, this%changes, this%curves)
      if (.not. (any(this%changes%is_known) .or. any([(count(this%rows(k)%is_there) > 1, k=1, size(this%rows))]) .or. &
         any([(count(this%numbers(k)%is_there) > 1, k=1, size(this%numbers))]))) then
         call fail(error, exit_usage, this%results(1)%path//' has no curve, slope or K&C metric in common with the other '// &
            'results: there is nothing to compare')
         return
      end if
      call find_missing(this%results, this%rows, this%missing)
      call print_text(text_of(this, line%has('--threshold')), unprinted)     ! the files are written even if it is closed
      do k = 1, this%missing%count()
         call print_note(is_quiet, this%missing%line(k))
      end do
      call print_largest(is_quiet, this)
      box = outbox_in(this%folder)
      figures = outbox_in(join_path(this%folder, 'figures'))
      call write_tables(this, error)
      if (allocated(error)) return
      ! a static page is first written without its pictures: it then exists even if gnuplot fails or hangs
      reason = ''
      if (has_plots .and. this%is_static) reason = 'gnuplot has not finished'
      call box%write(page_name, page_of(this, reason))
      call box%take(error)
      if (allocated(error)) return
      call draw(has_plots, is_quiet, this, figures, reason)
      if (this%is_static) call box%write(page_name, page_of(this, reason))
      call box%take(error)
      if (allocated(error)) return
      call print_note(is_quiet, join_path(this%folder, gradient_table)//', '//join_path(this%folder, page_name))
      call figures%finish(error)
      call keep_first(error, unprinted)
   end subroutine compare

   !> Rejects results in different definitions, and tables in other definitions than those of --definitions.
   subroutine check_definitions(line, results, error)
      type(command_line_t), intent(in) :: line
      type(results_t), intent(in) :: results(:)
      type(error_t), allocatable, intent(out) :: error     !! exit_usage
      character(:), allocatable :: wanted, like
      integer :: k

      like = ''
      if (.not. line%has('--definitions')) like = ', as in '//results(1)%path
      wanted = line%value('--definitions', trim(results(1)%program))
      do k = 1, size(results)
         if (results(k)%program == wanted .or. allocated(error)) cycle
         call fail(error, exit_usage, results(k)%path//' is in the definitions of '//name_of(trim(results(k)%program))// &
            ', expected '//name_of(wanted)//like//'; write all results with the same --definitions')
      end do

   contains

      !> The name of a program for a message.
      function name_of(program) result(name)
         character(*), intent(in) :: program
         character(:), allocatable :: name

         name = 'elastokin'
         if (program /= '') name = title_of(program)
      end function name_of

   end subroutine check_definitions

   !> Prints the largest changes to standard error, at most ten.
   subroutine print_largest(is_quiet, this)
      logical, intent(in) :: is_quiet
      type(comparison_t), intent(in) :: this
      integer, parameter :: most = 10
      type(message_list_t) :: lines
      integer :: k

      if (size(this%shown) == 0) return
      lines = largest_lines(this%shown, this%threshold, most)
      if (lines%count() == 0) call print_note(is_quiet, 'no K&C metric or gradient changed by more than '// &
         str(100*this%threshold, 4)//' %')
      if (lines%count() > 0) call print_note(is_quiet, 'largest changes:')
      do k = 1, lines%count()
         call print_note(is_quiet, '  '//lines%line(k))
      end do
   end subroutine print_largest

   !> Lists the tests, columns and gradients of one result that another result lacks.
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
               if (a == 1 .and. test_number(results(b), name) > 0) call compare_states(results(1), results(b), t, missing)
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

      !> Whether no result before a, other than b, has test t of result a, so that each test that b lacks is listed once.
      pure logical function is_first(a, b, t)
         integer, intent(in) :: a, b, t
         integer :: c

         is_first = .true.
         do c = 1, a - 1
            if (c /= b) is_first = is_first .and. test_number(results(c), results(a)%tests(t)%name) == 0
         end do
      end function is_first

   end subroutine find_missing

   !> Notes a test that has different numbers of states in two results.
   subroutine compare_states(one, other, t, missing)
      type(results_t), intent(in) :: one, other
      integer, intent(in) :: t                         !! index of the test in `one`
      type(message_list_t), intent(inout) :: missing
      integer :: states(2)

      states = [size(one%tests(t)%table%values, 2), &
         size(other%tests(test_number(other, one%tests(t)%name))%table%values, 2)]
      if (states(1) /= states(2)) call missing%add('test '//quoted(one%tests(t)%name)//' has '//str(states(1))//' states in '// &
         one%label//' and '//str(states(2))//' in '//other%label//': curves are compared where both have a state')
   end subroutine compare_states

   !> The columns of `one` that the same test of `other` lacks. A column missing in several tests is listed once.
   function columns_lacking(one, other) result(lacking)
      type(results_t), intent(in) :: one, other
      type(message_list_t) :: lacking
      character(name_length), allocatable :: names(:)      ! those of the list, for the search
      integer :: t, u, k

      allocate (names(sum([(size(one%tests(t)%table%columns), t=1, size(one%tests))])))
      do t = 1, size(one%tests)
         u = test_number(other, one%tests(t)%name)
         if (u == 0) cycle
         associate (columns => one%tests(t)%table%columns)
            do k = 1, size(columns)
               if (column_index(other%tests(u)%table, columns(k)) > 0) cycle
               if (columns(k) == '' .or. name_index(names(:lacking%count()), columns(k)) > 0) cycle
               call lacking%add(trim(columns(k)))
               names(lacking%count()) = columns(k)
            end do
         end associate
      end do
   end function columns_lacking

   !> The first names of a list, and the number of the other names. Models of different types share few of a thousand columns.
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

   !> Draws all charts in one run of gnuplot. If no charts are wanted, deletes the files of charts drawn earlier.
   subroutine draw(is_wanted, is_quiet, this, figures, reason)
      logical, intent(in) :: is_wanted, is_quiet
      type(comparison_t), intent(inout) :: this
      type(outbox_t), intent(inout) :: figures
      character(:), allocatable, intent(out) :: reason     !! reason for missing charts; '' if drawn
      type(message_list_t) :: pictures

      reason = ''
      if (.not. is_wanted) call remove_drawn(this%charts, this%folder)
      if (.not. is_wanted .or. size(this%charts) == 0) return
      call pictures_of(this%charts, pictures)
      call figures%add_script('compare', charts_script(this%charts), pictures)
      call figures%draw(is_quiet, reason)
      this%has_pictures = len(reason) == 0
   end subroutine draw

end module ek_compare
